"""What a page shows where: labels at their own points, the whole mechanism, axes that follow, panels one can read."""

import copy

import numpy as np
import pytest

import mjcont as mc
from mjcont.explorer.document import document_of
from mjcont.explorer.page import page, write_page

pytestmark = pytest.mark.browser
# each label without a line, the point that is nearest to its box, and the labels of that
READ = """
    const plot = e.plots.diagram.plot, box = plot.svg.getBoundingClientRect();
    const lines = [...plot.layers.labels.querySelectorAll('line')].map((l) =>
        ['x1', 'y1', 'x2', 'y2'].map((k) => Number(l.getAttribute(k))));
    const at = plot.content.points.map((p) => [p.label, plot.x(p.x), plot.y(p.y)]);
    const off = (b, x, y) => Math.hypot(Math.max(b.left - x, 0, x - b.right), Math.max(b.top - y, 0, y - b.bottom));
    return [...plot.layers.labels.querySelectorAll('text')].map((t) => {
        const r = t.getBoundingClientRect(), b = { left: r.left - box.left, right: r.right - box.left,
            top: r.top - box.top, bottom: r.bottom - box.top };
        const led = lines.find(([, , x, y]) => off(b, x, y) < 6);
        const near = led ? at.map(([l, x, y]) => [l, Math.hypot(x - led[0], y - led[1])])
                         : at.map(([l, x, y]) => [l, off(b, x, y)]);
        return [t.textContent, near.sort((p, q) => p[1] - q[1])[0][0]];
    });"""
SEEN = """
    const m = e.mechanism, found = [];
    m.camera.updateMatrixWorld();
    const see = (o) => { const p = o.clone().project(m.camera); found.push(Math.abs(p.x), Math.abs(p.y)); };
    const c = e.store.curves[0], V = m.camera.position.constructor;
    for (let i = 0; i < c.tendons.length; i += 3) see(new V(c.tendons[i], c.tendons[i + 1], c.tendons[i + 2]));
    for (let i = 0; i < c.poses.length; i += 7) see(new V(c.poses[i], c.poses[i + 1], c.poses[i + 2]));
    return Math.max(...found);"""
SPRUNG = """<mujoco model="sprung"><option gravity="0 0 0"/><worldbody><site name="far" pos="3 0 2"/>
    <body><joint name="turn" axis="0 1 0" stiffness="1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
    <site name="tip" pos="0.3 0 0"/></body></worldbody>
    <tendon><spatial name="spring" stiffness="5"><site site="tip"/><site site="far"/></spatial></tendon>
    <actuator><motor name="M" joint="turn" ctrllimited="true" ctrlrange="-1 1"/></actuator></mujoco>"""


@pytest.mark.parametrize("apart", [5, 12, 25])
@pytest.mark.parametrize("size", [(1440, 900), (1024, 768), (390, 844)], ids=str)
def test_a_label_is_nearest_to_its_own_point_or_has_a_line_to_it(opened, results, tmp_path, apart, size):
    document = document_of({"equilibria": results["equilibria"]})
    (curve,) = document["curves"]
    fold, row = curve["specials"][0], curve["specials"][0]["row"]
    curve["specials"] = [{**copy.deepcopy(fold), "label": f"{kind}{k}", "kind": kind, "row": row + apart * k}
                         for k, kind in enumerate(["LP", "HB", "BP", "CP", "LP", "HB"])]
    place = tmp_path / "crowded.html"
    place.write_text(page(document), encoding="utf-8")
    read = opened(place, *size)(READ)
    assert len(read) >= 1
    assert all(near in text.split(", ") for text, near in read), read


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (1024, 768), (1280, 640), (390, 844)])
def test_the_mechanism_and_the_diagram_have_room(opened, results_page, width, height):
    tab = opened(results_page, width, height)
    for panel in ("mechanism", "diagram"):
        assert tab.page.locator(f"[data-panel={panel}] .panel-body").bounding_box()["height"] >= 180


def test_a_name_that_does_not_break_makes_no_page_wider_than_the_screen(opened, results, tmp_path):
    place = write_page(tmp_path / "long.html", {"e" * 60: results["equilibria"], "f" * 60: results["equilibria"]},
                       title="n" * 120)
    assert opened(place, 390, 844)("return document.documentElement.scrollWidth;") == 390


def test_a_curve_keeps_its_row_while_another_is_looked_at(opened, results_page):
    tab = opened(results_page)
    tab("e.store.select(e.store.curves.find((c) => c.id === 'equilibria'), 123);")
    tab.page.get_by_role("button", name="path", exact=True).click()
    assert tab.selected()[0] == "path"
    tab.page.get_by_role("button", name="equilibria", exact=True).click()
    assert tab.selected() == ("equilibria", 123)


def test_the_diagram_turns_to_the_parameter_of_the_curve_that_is_selected(opened, results, tmp_path):
    branch = results["equilibria"]
    other = mc.continue_equilibria(branch.model, "k_sp", bounds=(5, 20), start=branch.row(0))
    tab = opened(write_page(tmp_path / "two.html", {"one": branch, "other": other}))
    axis = tab.page.get_by_label("Horizontal axis of the diagram")
    for name, parameter in (("other", "k_sp"), ("one", "F")):
        tab.page.get_by_role("button", name=name, exact=True).click()
        assert axis.input_value() == parameter
        wide = tab("const l = e.plots.diagram.lines.find((l) => l.curve === e.store.curve);"
                   "return Math.max(...l.px) - Math.min(...l.px);")
        assert wide > 200


def test_the_view_holds_a_spring_that_leads_far_away(opened, tmp_path):
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(SPRUNG), "M", bounds=(-1, 1))
    assert opened(mc.to_html(tmp_path / "sprung.html", branch))(SEEN) <= 1.0


def test_a_page_without_a_curve_has_no_husks_at_its_side(opened, results, tmp_path):
    tab = opened(write_page(tmp_path / "s.html", {"s": results["sensitivities"]}), drawn=".tornado .bar")
    visible = tab("return [...document.querySelectorAll('.side > *')].filter((x) => x.getClientRects().length)"
                  ".map((x) => x.className);")
    assert [name for name in visible if name != "visually-hidden"] == ["made"]


def test_one_parameter_that_is_held_is_one_parameter(opened, tmp_path):
    field = mc.VectorField(lambda u, p: [p["a"] - p["b"] * u[0]], [0.0], {"a": 0.0, "b": 1.0})
    tab = opened(mc.to_html(tmp_path / "one.html", mc.continue_equilibria(field, "a", bounds=(-1, 1))))
    assert tab.page.inner_text(".held summary") == "Held: 1 parameter"


def test_rows_are_found_again_by_what_they_are(opened, results, overcentre_branch, tmp_path):
    tab = opened(write_page(tmp_path / "one.html", {"equilibria": results["equilibria"]}))
    changed = document_of({"equilibria": overcentre_branch(k_j=1e3, k_sp=12.0)})
    load = tab("const i = e.store.curve.columns.F.findIndex((v) => v < 30); e.store.select(e.store.curve, i);"
               "return e.store.curve.columns.F[i];")
    found = tab("e.store.replace(a); return e.store.curve.columns.F[e.store.row];", changed)
    assert found == pytest.approx(load, abs=np.ptp(results["equilibria"]["F"]) / 200)
