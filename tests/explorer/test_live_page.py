"""A live session in the browser: what is clicked is computed, and the study says so."""

import re

import pytest
from problems.explorer import exploring, page, until

import mjcont as mc
from mjcont.studies.study import load_study, run_study

pytestmark = pytest.mark.browser

STUDY = """
model = "overcentre"
[parameters]
k_j = 1000.0
[[branch]]
name = "rest"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
"""
CURVES = "return e.store.curves.map((c) => ({ id: c.id, kind: c.kind, rows: c.rows, specials: c.specials }));"
IDLE = "return !e.live.busy && document.querySelector('button.stop').hidden;"


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    study = tmp_path_factory.mktemp("live") / "study.toml"
    study.write_text(STUDY, encoding="utf-8")
    with exploring(study) as (_, found), page(found):  # which keeps the session for the tests between
        yield found


@pytest.fixture
def live(address, opened):
    """A page on the session, in which all that was clicked before is undone."""
    tab = opened(address)
    until(lambda: tab(IDLE))
    tab.page.evaluate("""async () => {
        const { live } = document.getElementById("explorer").explorer;
        while (await live.transport.request("undo").catch(() => null)) continue;
        await live.reload();
    }""")
    assert [c["id"] for c in tab(CURVES)] == ["rest"]
    return tab


def choose(tab, label="LP1", curve="rest"):
    """Select a special point, as a click on it does."""
    tab("const c = e.store.curves.find((c) => c.id === a[0]);"
        "e.store.select(c, c.specials.find((s) => s.label === a[1]).row);", [curve, label])


def click(tab, action, **fields):
    """Fill the fields of an action, click it, and wait until it is done."""
    entry = tab.page.locator(f".entry:has([data-action={action}])")
    for name, value in fields.items():
        field = entry.get_by_label(name, exact=True)
        if isinstance(value, str):
            field.select_option(value)
        else:
            field.fill(str(value))
            field.press("Tab")
    entry.locator(f"[data-action={action}]").click()
    done(tab)


def done(tab):
    until(lambda: tab(IDLE))
    tab.settle()


def curves(tab):
    return {c["id"]: c for c in tab(CURVES)}


def words(tab):
    return tab.page.locator(".status .words").inner_text()


def unstable_row(tab):
    """Select a row amid the unstable ones, and return it."""
    row = tab("const c = e.store.curves[0], s = [...c.stability].flatMap((v, i) => v < 0 ? [i] : []);"
              "return s[s.length >> 1];")
    tab("e.store.select(e.store.curves[0], a);", row)
    return row


def test_folds_have_the_values_that_python_computes(live, overcentre_branch):
    branch = overcentre_branch(k_j=1000.0)
    found = {s["label"]: s["values"]["F"] for s in curves(live)["rest"]["specials"]}
    assert found == {p.label: pytest.approx(p["F"], rel=1e-9) for p in branch.special_points}


def test_a_fold_is_followed_in_two_parameters_to_a_cusp(live, overcentre_branch):
    x, y = live.where(0, curves(live)["rest"]["specials"][0]["row"])
    live.page.mouse.click(x, y)
    click(live, "locus", **{"second parameter": "l_us"})
    cusp = next(s for s in curves(live)["locus_1"]["specials"] if s["label"] == "CP1")
    expected = mc.continue_special(overcentre_branch(k_j=1000.0).point("LP1"), "l_us").point("CP1")
    assert cusp["values"]["F"] == pytest.approx(expected["F"], rel=1e-8)
    assert cusp["values"]["l_us"] == pytest.approx(expected["l_us"], rel=1e-8)
    assert live.page.locator("[data-panel=locus]").is_visible()


def test_a_bar_of_the_tornado_follows_its_parameter(live):
    choose(live)
    click(live, "sensitivities")
    bars = live.page.locator("[data-panel=tornado] button.bar")
    assert bars.count() > 3
    live.page.get_by_role("button", name=re.compile("^k_sp .* moves F")).click()
    done(live)
    assert curves(live).keys() == {"rest", "sensitivities_1", "locus_1"}
    assert live("return Object.keys(e.store.curves[2].free);") == ["F", "k_sp"]


def test_a_branch_begins_at_a_pose_of_the_model(live):
    click(live, "begin", parameter="F")
    assert curves(live).keys() == {"rest", "equilibria"}
    assert [s["label"] for s in curves(live)["equilibria"]["specials"]] == ["LP1", "LP2"]


def test_a_model_that_nothing_moves_is_shown_and_says_so(opened, tmp_path):
    (tmp_path / "still.xml").write_text("""<mujoco model="still"><worldbody><body><joint name="z" type="slide"
        axis="0 0 1" stiffness="10"/><geom size="0.1"/></body></worldbody>
        <actuator><general name="idle" joint="z" gainprm="0" ctrllimited="true" ctrlrange="-1 2"/></actuator>
        <option gravity="0 0 0"/></mujoco>""", encoding="utf-8")
    with exploring(tmp_path / "still.xml") as (_, address):
        tab = opened(address, drawn="[data-panel=mechanism]")
        until(lambda: "choose a parameter" in words(tab))
        click(tab, "begin", parameter="idle")
        assert curves(tab).keys() == {"equilibria"}
        assert tab.console == []


def test_no_load_runs_from_an_unstable_row(live):
    unstable_row(live)
    button = live.page.locator("[data-action=path]")
    assert button.is_disabled()
    live("e.store.select(e.store.curves[0], 3);")
    assert button.is_enabled()


def test_the_load_runs_from_a_row_and_jumps_at_the_fold(live):
    row = live("const c = e.store.curves[0], t = c.columns.theta_1; return t[0] < t[c.rows - 1] ? 0 : c.rows - 1;")
    live("e.store.select(e.store.curves[0], a);", row)
    click(live, "path", way="up" if row == 0 else "loop")
    (path,) = (c for c in curves(live).values() if c["kind"] == "loadpath")
    assert path["rows"] > 10


def test_a_motion_from_an_unstable_row_begins_beside_it_and_leaves(live):
    unstable_row(live)
    click(live, "history", duration=3, nudge=0.001)
    moved = live("const t = e.store.curves.find((c) => c.kind === 'history').columns.theta_1;"
                 "return Math.max(...t) - Math.min(...t);")
    assert moved > 0.1
    assert live.page.locator("[data-panel=motion]").is_visible()


def test_a_motion_from_a_stable_row_moves_unless_told_otherwise(live):
    live("e.store.select(e.store.curves[0], 3);")
    click(live, "history", duration=2)
    thetas = "const t = e.store.curves.find((c) => c.kind === 'history').columns.theta_1;"
    assert live(thetas + "return Math.max(...t) - Math.min(...t);") > 0.01


def test_a_branch_in_another_parameter_goes_between_the_bounds_that_are_typed(live):
    live("e.store.select(e.store.curves[0], 3);")
    click(live, "branch", parameter="k_sp", low=5, high=20)
    found = live("const c = e.store.curve; return [c.id, c.free.k_sp, e.plots.diagram.axes.x];")
    assert found == ["equilibria", [5, 20], "k_sp"]


def test_a_value_that_is_typed_is_the_one_that_is_computed(live, overcentre_branch):
    live.page.locator(".sliders summary").click()
    field = live.page.get_by_label("k_sp in N/m")
    assert float(field.input_value()) == 10.0
    field.fill("12.34")
    field.press("Enter")
    done(live)
    fold = curves(live)["rest"]["specials"][0]["values"]["F"]
    assert fold == pytest.approx(overcentre_branch(k_j=1000.0, k_sp=12.34).point("LP1")["F"], rel=1e-9)
    live.page.get_by_role("slider", name="m_1").press("ArrowRight")
    done(live)
    value = live("return e.store.document.sliders.find((p) => p.name === 'm_1').value;")
    assert value == float(f"{value:.3g}") != 1.0


def test_undo_takes_back_what_was_clicked(live):
    choose(live)
    click(live, "sensitivities")
    assert "sensitivities_1" in curves(live)
    live.page.get_by_role("button", name="Undo").click()
    done(live)
    assert curves(live).keys() == {"rest"}
    assert live.page.get_by_role("button", name="Undo").is_disabled()


def test_the_study_that_is_downloaded_computes_the_same_folds(live, tmp_path):
    choose(live)
    click(live, "locus", **{"second parameter": "l_us"})
    with live.page.expect_download() as download:
        live.page.get_by_role("button", name="study.toml").click()
    download.value.save_as(tmp_path / "study.toml")
    study = load_study(tmp_path / "study.toml")
    results = dict(zip((p.name for p in study.plans), run_study(study, tmp_path / "out"), strict=True))
    for name, curve in curves(live).items():
        assert [p.label for p in results[name].special_points] == [s["label"] for s in curve["specials"]]
        for p, s in zip(results[name].special_points, curve["specials"], strict=True):
            assert p["F"] == pytest.approx(s["values"]["F"], rel=1e-9)


def test_a_slider_moves_the_folds(live, overcentre_branch):
    before = curves(live)["rest"]["specials"][0]["values"]["F"]
    live.page.locator(".sliders summary").click()
    slider = live.page.get_by_role("slider", name="load_factor")
    assert live.page.get_by_role("slider", name="F", exact=True).count() == 0  # it varies along the branch
    slider.press("ArrowRight")
    done(live)
    found = curves(live)["rest"]["specials"][0]["values"]["F"]
    value = live("return e.store.document.sliders.find((p) => p.name === 'load_factor').value;")
    assert value != 1.0
    assert found != pytest.approx(before, rel=1e-6)
    assert found == pytest.approx(overcentre_branch(k_j=1000.0, load_factor=value).point("LP1")["F"], rel=1e-9)


def test_stopping_keeps_the_points_so_far(live):
    live("e.live.add('loci', { point: 'rest:LP1', parameter: 'l_us', settings: { ds: 1e-4, ds_max: 1e-4 } });")
    stop = live.page.get_by_role("button", name="Stop")
    until(lambda: "points" in words(live))
    stop.click()
    done(live)
    assert 1 < curves(live)["locus_1"]["rows"] < 10_000
    assert "stopped" in words(live)


def test_a_page_that_is_loaded_anew_goes_on(live):
    choose(live)
    click(live, "sensitivities")
    live.page.reload()
    live.page.wait_for_selector("[data-panel=diagram] .plot .line")
    assert curves(live).keys() == {"rest", "sensitivities_1"}
    assert "#" not in live.page.url


def test_what_cannot_be_computed_is_said(live):
    live("e.live.add('loci', { point: 'rest:LP7', parameter: 'k_sp' });")
    until(lambda: "LP7" in words(live))
    assert "Valid: LP1, LP2" in words(live)
    assert curves(live).keys() == {"rest"}


def test_the_page_that_is_handed_out_needs_no_session(live, opened, tmp_path):
    choose(live)
    click(live, "sensitivities")
    with live.page.expect_download() as download:
        live.page.get_by_role("button", name="page.html").click()
    download.value.save_as(tmp_path / "page.html")
    alone = opened(tmp_path / "page.html")
    assert alone.requests == [(tmp_path / "page.html").as_uri()]
    assert alone.console == []
    assert {c["id"] for c in alone(CURVES)} == {"rest", "sensitivities_1"}


def test_a_live_page_asks_for_nothing_but_itself_and_logs_nothing(live):
    address = live.page.url
    choose(live)
    click(live, "sensitivities")
    assert live.requests == [address]
    assert live.console == []


def test_without_the_token_the_page_shows_nothing_of_the_model(address, chromium):
    context = chromium.new_context()
    tab = context.new_page()
    tab.goto(address.partition("#")[0])
    until(lambda: "lacks its token" in tab.inner_text("body"))
    assert "overcentre" not in tab.content().partition('<script type="module">')[0]
    tab.goto(address[:-3] + "xyz")
    tab.reload()
    until(lambda: "open the one that mjcont printed" in tab.inner_text("body"))
    context.close()


def test_a_page_from_elsewhere_gets_no_socket_though_it_knows_the_token(address, chromium):
    host, _, token = address.partition("/#")
    context = chromium.new_context()
    tab = context.new_page()
    tab.goto("data:text/html,elsewhere")
    said = tab.evaluate("""([url, protocols]) => new Promise((done) => {
        const socket = new WebSocket(url, protocols);
        socket.onopen = () => done("open");
        socket.onclose = () => done("refused");
    })""", [host.replace("http", "ws") + "/socket", ["mjcont", f"token.{token}"]])
    assert said == "refused"
    context.close()


def test_cycles_begin_at_a_hopf_point_and_carry_their_motion(opened):
    with exploring("studies/flutter.toml") as (_, address):
        tab = opened(address)
        until(lambda: "flutter" in curves(tab), 120)
        done(tab)
        choose(tab, "HB1")
        click(tab, "cycles")
        assert curves(tab)["cycles_1"]["rows"] > 5
        assert tab("return e.store.curves.find((c) => c.id === 'cycles_1').orbit.poses.length;") > 0


def test_eigenvalues_come_after_the_curve_and_are_those_of_its_rows(live, overcentre_branch):
    live("e.live.add('branch', { parameter: 'F', bounds: [-50, 50], start: { F: 50 } });")
    done(live)
    until(lambda: live("const c = e.store.curves[1]; return c && c.eigenvalues && c.eigenvalues.every(isFinite);"))
    row = live("const c = e.store.curves[1]; return c.specials[0].row;")
    found = live("const v = e.store.curves[1].eigenvalues, m = v.shape[1];"
                 "return [...v.slice(2 * m * a, 2 * m * (a + 1))].filter((_, i) => i % 2 === 0);", row)
    branch = overcentre_branch(k_j=1000.0)
    expected = branch.special_points[0].eigenvalues.real
    assert sorted(found) == pytest.approx(sorted(expected), rel=1e-3, abs=1e-3)


def test_what_a_study_cannot_name_is_not_offered(opened, overcentre_branch, tmp_path):
    mc.continue_special(overcentre_branch(k_j=1000.0).point("LP1"), "l_us").save(tmp_path / "folds.h5")
    with exploring(tmp_path / "folds.h5") as (_, address):
        tab = opened(address, drawn="[data-panel=locus] .plot .line")
        until(lambda: tab(IDLE))
        choose(tab, "CP1", "folds")
        for action, there in (("locus", False), ("sensitivities", False), ("branch", True)):
            assert tab.page.locator(f"[data-action={action}]").is_enabled() is there, action
