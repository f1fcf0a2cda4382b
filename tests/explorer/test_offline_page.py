"""The page that needs no server, in a headless browser: what is seen there are the numbers that Python has."""

import json

import numpy as np
import pytest
from problems.browsers import NO_GRAPHICS

import mjcont as mc
from mjcont.explorer.document import document_of
from mjcont.explorer.page import page

pytestmark = pytest.mark.browser
OVERLAPS = """
    const boxes = [...document.querySelectorAll('.plot .labels text, .plot .axis-title, .plot .tick text')]
        .filter((t) => getComputedStyle(t).visibility !== 'hidden' && t.getBoundingClientRect().width)
        .map((t) => [t.textContent, t.getBoundingClientRect()]);
    return boxes.flatMap(([a, p], i) => boxes.slice(i + 1)
        .filter(([, q]) => p.left + 1 < q.right && q.left + 1 < p.right && p.top + 1 < q.bottom && q.top + 1 < p.bottom)
        .map(([b]) => `${a} on ${b}`));"""


def drag(tab, rows, line=0):
    """Drag along rows of a line of the diagram, and return the rows that were selected on the way."""
    tab.page.mouse.move(*tab.where(line, rows[0]))
    tab.page.mouse.down()
    seen = []
    for row in rows:
        tab.page.mouse.move(*tab.where(line, row))
        seen.append(tab.selected()[1])
    tab.page.mouse.up()
    return seen


def branch_line(tab):
    return tab("return e.plots.diagram.lines.findIndex((l) => l.curve.id === 'equilibria');")


def test_it_asks_for_itself_alone_and_logs_nothing(opened, results_page):
    tab = opened(results_page)
    assert tab.requests == [results_page.as_uri()]
    assert tab.console == []


def test_a_fold_that_is_clicked_shows_the_values_that_python_has(opened, results_page, results):
    tab, fold = opened(results_page), results["equilibria"].point("LP1")
    tab.page.mouse.click(*tab.where(branch_line(tab), fold.index))
    assert tab.page.inner_text(".selection span") == "LP1, fold"
    assert tab("return e.store.special.values;") == {**fold.parameters, **fold.observables}
    shown = dict(tab("return [...document.querySelectorAll('.side > .values tbody tr')].map((r) =>"
                     "[...r.cells].map((c) => c.textContent));"))
    assert float(shown["F"].replace(" N", "")) == pytest.approx(fold["F"], rel=1e-5)
    degrees = float(shown["θ1"].replace("°", "").replace("\N{MINUS SIGN}", "-"))
    assert degrees == pytest.approx(np.degrees(fold["theta_1"]), rel=1e-5)


def test_a_drag_goes_through_a_fold_and_not_across_it(opened, results_page, results):
    tab, fold = opened(results_page), results["equilibria"].point("LP1")
    seen = drag(tab, list(range(fold.index - 80, fold.index + 80, 4)), branch_line(tab))
    assert np.all(np.diff(seen) >= 0) and seen[0] < fold.index < seen[-1]


def test_dragging_moves_the_bodies_to_where_the_document_has_them(opened, results_page, results):
    tab = opened(results_page)
    drag(tab, [400, 420, 440], branch_line(tab))
    seen = tab("const p = [], m = e.mechanism; m.bodies.forEach((b) => p.push(b.position.toArray()));"
               "return [p, Array.from(e.store.curve.poses.subarray(7 * m.bodies.length * e.store.row)).slice(0, 3)];")
    assert seen[0][0] == pytest.approx(seen[1], abs=1e-7)
    assert tab.selected()[1] == pytest.approx(440, abs=3)


def test_the_mechanism_is_drawn_with_webgl(opened, results_page):
    assert opened(results_page).page.get_attribute("[data-panel=mechanism] .panel-body", "data-drawn") == "webgl"


def test_without_webgl_a_drawing_takes_its_place_and_moves(launched, opened, results_page):
    tab = opened(results_page, browser=launched(NO_GRAPHICS))
    figure = "[data-panel=mechanism] svg.stick"
    assert tab.page.locator(f"{figure} line").count() >= 2
    assert tab.console == []
    before = tab.page.inner_html(figure)
    tab.page.keyboard.press("Home")
    assert tab.page.inner_html(figure) != before


def test_arrows_go_along_the_curve_and_n_to_the_next_special_point(opened, results_page, results):
    tab, branch = opened(results_page), results["equilibria"]
    last, first, second = len(branch) - 1, branch.point("LP1").index, branch.point("LP2").index
    for key, row in (("Home", 0), ("ArrowRight", 1), ("Shift+ArrowRight", 11), ("ArrowLeft", 10), ("End", last),
                     ("p", second), ("p", first), ("n", second)):
        tab.page.keyboard.press(key)
        assert tab.selected() == ("equilibria", row), key


def test_everything_to_press_says_what_it_is(opened, results_page):
    tab = opened(results_page)
    silent = tab("return [...document.querySelectorAll('button, select, input, svg[role=img], canvas')].filter((b) =>"
                 "!(b.getAttribute('aria-label') || b.textContent.trim() || b.title)).map((b) => b.outerHTML);")
    assert silent == []
    snapshot = tab.page.locator("#explorer").aria_snapshot()
    for words in ('heading "mjcont', 'region "Diagram"', 'slider "Row of the curve"', 'button "LP1, fold"'):
        assert words in snapshot


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (820, 1180), (390, 844)])
@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_no_two_texts_of_a_diagram_meet_and_nothing_is_wider_than_the_screen(opened, results_page, width, height, dark):
    tab = opened(results_page, width, height, dark)
    assert tab(OVERLAPS) == []
    assert tab("return document.documentElement.scrollWidth;") <= width


def test_a_branch_of_ten_thousand_rows_drags_in_less_than_two_milliseconds_a_step(opened, results, tmp_path):
    document = json.loads(json.dumps(document_of({"equilibria": results["equilibria"]})))
    longer(document["curves"][0], 10_000)
    place = tmp_path / "long.html"
    place.write_text(page(document), encoding="utf-8")
    tab = opened(place)
    tab("e.store.timings.length = 0; return 0;")
    seen = drag(tab, list(range(2000, 8000, 100)))
    assert seen[0] < 2100 and seen[-1] > 7700
    assert np.median(tab("return e.store.timings;")) < 2.0


def longer(curve, count):
    """Give a curve more rows, each one of its own some times over."""
    from mjcont.explorer.arrays import packed, unpacked

    rows = np.sort(np.arange(count) % len(unpacked(curve["stability"])))
    types = {"poses": "f4", "tendons": "f4", "eigenvalues": "f4", "stability": "i1", "unstable": "i4"}
    curve |= {key: packed(unpacked(curve[key])[rows], dtype) for key, dtype in types.items()}
    curve["columns"] = {n: packed(unpacked(c)[rows]) for n, c in curve["columns"].items()}
    curve["specials"] = []


def test_the_browser_runs_no_script_but_the_one_whose_hash_is_stated(opened, results_page, tmp_path):
    place, more = tmp_path / "changed.html", "<script>window.ran = 1</script></body>"
    place.write_text(results_page.read_text(encoding="utf-8").replace("</body>", more), encoding="utf-8")
    tab = opened(place)
    assert tab("return window.ran ?? null;") is None
    assert any("Content Security Policy" in line for line in tab.console)


def test_markup_in_a_name_stays_text(opened, results, tmp_path):
    name = "<img src=x onerror=alert(1)></script><script>window.ran=1</script>"
    place = tmp_path / "named.html"
    place.write_text(page(document_of({"b": results["equilibria"]}, title=name)), encoding="utf-8")
    tab = opened(place)
    assert tab.page.inner_text(".model") == name
    assert (tab("return window.ran ?? null;"), tab.console) == (None, [])


def test_names_that_javascript_has_uses_for_are_names_like_others(opened, tmp_path):
    field = mc.VectorField(lambda u, p: [p["constructor"] - u[0] ** 3 + u[0], p["toString"] - u[1]], [1.0, 0.0],
                           {"constructor": 0.0, "toString": 2.0}, names=["__proto__", "hasOwnProperty"], name="valueOf")
    branch = mc.continue_equilibria(field, "constructor", bounds=(-1, 1))
    place = mc.to_html(tmp_path / "names.html", branch)
    tab = opened(place)
    assert tab.page.locator(".side > .values th[scope=row]").all_inner_texts() == list(branch.columns)
    tab.page.keyboard.press("Home")
    tab.page.keyboard.press("n")
    assert tab.page.inner_text(".selection span") == "LP1, fold"
    assert tab.console == []


def test_a_load_path_plays_through_its_jumps(opened, results_page):
    tab = opened(results_page)
    words = tab("const c = e.store.curves.find((c) => c.id === 'path'), i = c.stability.indexOf(2);"
                "e.store.select(c, i); return document.querySelector('.badge').textContent;")
    assert words == "jumping"


def test_a_history_and_a_locus_have_panels_in_which_one_drags(opened, results_page):
    tab = opened(results_page)
    for panel, curve in (("motion", "history"), ("locus", "locus")):
        x, y = tab("const l = e.plots[a].lines[0], b = e.plots[a].plot.svg.getBoundingClientRect();"
                   "return [b.left + l.px[5], b.top + l.py[5]];", panel)
        tab.page.mouse.click(x, y)
        assert tab.selected()[0] == curve


def test_the_picture_of_a_panel_is_svg_that_stands_by_itself(opened, results_page):
    tab = opened(results_page)
    for panel in ("mechanism", "diagram", "spectrum"):
        with tab.page.expect_download() as download:
            tab.page.click(f"[data-panel={panel}] button[title='picture.svg']")
        text = download.value.path().read_text(encoding="utf-8")
        assert download.value.suggested_filename == f"{panel}.svg"
        assert text.startswith("<?xml") and "stroke" in text and "class=" not in text


def test_the_theme_can_be_changed_by_hand(opened, results_page):
    tab = opened(results_page)
    colour = "return getComputedStyle(document.getElementById('explorer')).backgroundColor;"
    before = tab(colour)
    tab.page.click("button.theme")
    assert tab(colour) != before
