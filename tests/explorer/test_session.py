"""A session's state is a study: what a click appends, what undo drops, what its text reproduces."""

import numpy as np
import pytest

import mjcont as mc
from mjcont.explorer.opening import Opened, opened
from mjcont.explorer.session import Session
from mjcont.studies.study import load_study, run_study

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


SLOW = {"point": "rest:LP1", "parameter": "k_sp", "bounds": [9, 11], "settings": {"ds_max": 6e-3, "ds": 6e-3}}


@pytest.fixture
def study(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def begun(tmp_path_factory):
    """The study's own branch, computed once."""
    path = tmp_path_factory.mktemp("begun") / "study.toml"
    path.write_text(STUDY, encoding="utf-8")
    made = Session(opened(str(path)), lambda event: None)
    made.begin()
    return Opened(made.now.tables, made.now.results, made.mechanism, computes=False)


@pytest.fixture
def session(begun):
    """A session with one branch, and in `events` what it told."""
    events = []
    made = Session(begun, events.append)
    made.events = events
    return made


def again(session, folder):
    """The results of the study that a session writes, by name, computed by the study's runner."""
    path = folder / "again.toml"
    path.write_text(session.toml(), encoding="utf-8")
    study = load_study(path)
    return dict(zip((p.name for p in study.plans), run_study(study, folder / "out"), strict=True))


def row(curve, number):
    return {"curve": curve, "row": number}


def unstable_row(session):
    rows = np.flatnonzero(session.now.results["rest"].stability == "unstable")
    return int(rows[len(rows) // 2])


# -- what is opened -------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_model_opens_with_a_branch_of_the_parameter_that_moves_it():
    session = Session(opened("overcentre"), lambda event: None)
    session.begin()
    (branch,) = session.now.results.values()
    assert [p.label for p in branch.special_points] == ["LP1", "LP2"]
    with pytest.raises(mc.MjcontError, match="nothing to undo"):
        session.undo()


@pytest.mark.slow
def test_a_result_opens_as_it_is_and_its_study_computes_it_again(tmp_path, overcentre_branch):
    branch = overcentre_branch(k_j=800.0)
    branch.save(tmp_path / "upper.h5")
    session = Session(opened(str(tmp_path / "upper.h5")), lambda event: None)
    session.begin()
    np.testing.assert_array_equal(session.now.results["upper"]["theta_1"], branch["theta_1"])
    found = again(session, tmp_path)["upper"]
    assert [p.label for p in found.special_points] == [p.label for p in branch.special_points]
    for one, other in zip(found.special_points, branch.special_points, strict=True):
        assert one["F"] == pytest.approx(other["F"], rel=1e-9)


@pytest.mark.slow
def test_zeros_of_a_stored_branch_are_found_again(tmp_path):
    mechanism = mc.Mechanism.from_xml("overcentre")
    mc.continue_equilibria(mechanism, "F", (-50, 50), {"F": 50}, zeros={"theta_1": 0.0}).save(tmp_path / "upper.h5")
    session = Session(opened(str(tmp_path / "upper.h5")), lambda event: None)
    session.begin()
    assert [p.label for p in again(session, tmp_path)["upper"].special_points] == ["LP1", "UZ1", "LP2"]


def test_orbits_of_a_file_are_shown_but_nothing_goes_on_from_them(tmp_path):
    column = mc.continue_equilibria(mc.Mechanism.from_xml("ziegler_rods"), "P", (0.0, 4.0))
    mc.continue_cycles(column.point("HB1"), "P", max_points=5).save(tmp_path / "flutter.h5")
    session = Session(opened(str(tmp_path / "flutter.h5")), lambda event: None)
    session.begin()
    with pytest.raises(mc.MjcontError, match="'flutter' is of a file"):
        session.add("histories", {"row": row("flutter", 0)})


@pytest.mark.slow
def test_a_result_that_no_table_computes_is_shown_and_asked_on_from_its_rows(tmp_path, overcentre_branch):
    mc.load_path(overcentre_branch(k_j=1000.0), "F", [-50, 0], landing="creep").save(tmp_path / "my path.h5")
    session = Session(opened(str(tmp_path / "my path.h5")), lambda event: None)
    session.begin()
    with pytest.raises(mc.MjcontError, match="nothing to compute anew"):
        session.set("k_sp", 11.0)
    session.add("branch", {"row": row("result", 3), "parameter": "F", "bounds": [-50, 50]})
    assert [p.label for p in session.now.results["equilibria"].special_points] == ["LP1", "LP2"]
    session.set("k_sp", 11.0)
    assert [*session.now.results] == ["result", "equilibria"]


@pytest.mark.slow
def test_what_a_model_warns_of_is_a_note_said_once(tmp_path):
    (tmp_path / "bare.xml").write_text("""<mujoco model="bare"><asset><mesh name="m" file="missing.stl"/></asset>
        <worldbody><body><joint name="z" axis="0 1 0" stiffness="10"/><geom size="0.1" pos="1 0 0"/>
        <geom type="mesh" mesh="m" mass="0" contype="0" conaffinity="0"/></body></worldbody></mujoco>""")
    session = Session(opened(str(tmp_path / "bare.xml")), lambda event: None)
    assert ["missing.stl" in note for note in session.now.notes] == [True]
    session.begin()
    assert ["missing.stl" in note for note in session.now.notes][0]
    session.add("branch", {"parameter": "load_factor", "bounds": [0.5, 2]})
    assert not any("missing.stl" in note for note in session.now.notes)


def test_a_result_without_a_model_is_refused(tmp_path):
    field = mc.VectorField(lambda u, p: p["a"] - u * u, [1.0], {"a": 1.0})
    mc.continue_equilibria(field, "a", (-1, 2)).save(tmp_path / "field.h5")
    with pytest.raises(mc.ResultFileError, match=r"field.h5' carries no model of a mechanism"):
        opened(str(tmp_path / "field.h5"))


@pytest.mark.parametrize("source", ["nothing.xml", "nothing.toml", "nothing.h5", "nothing"])
def test_what_is_not_there_is_named(source):
    with pytest.raises(mc.MjcontError, match=rf"{source}'?: no such file|'{source}'"):
        opened(source)


def test_a_study_with_a_mistake_is_refused_with_its_first_problem(study):
    study.write_text(STUDY.replace('"F"', '"G"'), encoding="utf-8")
    with pytest.raises(mc.StudyError, match=r"branch\[0\].parameter: unknown parameter 'G'"):
        opened(str(study))


# -- what a click appends -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_study_of_a_session_reproduces_what_was_clicked(session, tmp_path):
    session.add("loci", {"point": "rest:LP1", "parameter": "k_sp", "bounds": [0.5, 12]})
    session.add("branch", {"row": row("rest", 5), "parameter": "k_sp", "bounds": [5, 15]})
    found = again(session, tmp_path)
    assert found.keys() == session.now.results.keys() == {"rest", "locus_1", "equilibria"}
    for name in ("rest", "locus_1", "equilibria"):
        old, new = session.now.results[name], found[name]
        assert [p.label for p in old.special_points] == [p.label for p in new.special_points]
        np.testing.assert_array_equal(old.states, new.states)


def test_a_row_that_has_no_label_becomes_a_start_and_a_state(session):
    session.add("branch", {"row": row("rest", 5), "parameter": "k_sp", "bounds": [5, 15]})
    (_, table) = session.now.tables["branch"]
    branch = session.now.results["rest"]
    assert table["start"] == {"F": branch["F"][5]}
    assert table["state"] == branch.states[5].tolist()
    assert session.now.parents["equilibria"] == "rest"


@pytest.mark.slow
def test_a_motion_from_an_unstable_row_leaves_it_though_nobody_asks_for_a_nudge(session):
    place = row("rest", unstable_row(session))
    (history,) = session.add("histories", {"row": place, "duration": 3}).values()
    assert np.ptp(history["theta_1"]) > 0.1


@pytest.mark.parametrize("sign", [1, -1])
def test_a_nudge_of_either_sign_leaves_to_its_own_side(session, sign):
    place = row("rest", unstable_row(session))
    (history,) = session.add("histories", {"row": place, "nudge": sign * 0.001, "duration": 0.3}).values()
    (other,) = session.add("histories", {"row": place, "nudge": -sign * 0.001, "duration": 0.3}).values()
    began = session.now.results["rest"]["theta_1"][place["row"]]
    assert (history["theta_1"][-1] - began) * (other["theta_1"][-1] - began) < 0


@pytest.mark.slow
def test_a_load_begins_to_change_where_the_row_has_it_and_jumps_at_the_fold(session):
    branch = session.now.results["rest"]
    first = next(i for i in (0, len(branch) - 1) if branch["theta_1"][i] < 0)  # the lower of the two ends
    (path,) = session.add("paths", {"row": row("rest", first), "parameter": "F", "values": [50]}).values()
    assert path.vertices[0]["F"] == branch["F"][first]
    assert [j.kind for j in path.jumps] == ["LP"]
    assert path.jumps[0].before["F"] == pytest.approx(branch.point("LP1")["F"], rel=1e-9)


def test_a_load_does_not_begin_at_an_unstable_row(session):
    with pytest.raises(mc.MjcontError, match="nothing rests at an unstable row"):
        session.add("paths", {"row": row("rest", unstable_row(session)), "parameter": "F", "values": [50]})


@pytest.mark.slow
def test_a_load_that_begins_at_a_fold_begins_at_the_stable_row_beside_it(session):
    fold = session.now.results["rest"].special_points[0]
    (path,) = session.add("paths", {"row": row("rest", fold.index), "parameter": "F", "values": [50]}).values()
    assert path.done


@pytest.mark.slow
def test_results_are_named_after_what_they_are_and_counted(session):
    for value in (8, 9):
        session.add("loci", {"point": "rest:LP1", "parameter": "k_sp", "bounds": [value, 12]})
    session.add("branch", {"row": row("rest", 5), "parameter": "k_sp", "bounds": [5, 15]})
    session.add("branch", {"row": row("rest", 5), "parameter": "k_sp", "bounds": [5, 15]})
    assert [*session.now.results] == ["rest", "locus_1", "locus_2", "equilibria", "equilibria_2"]


@pytest.mark.parametrize(
    ("table", "args", "said"),
    [
        ("plots", {}, "unknown table 'plots'"),
        ("loci", {"point": "rest:LP9", "parameter": "k_sp"}, "'rest:LP9': unknown special point 'LP9'.*LP1, LP2"),
        ("loci", {"point": "rest:LP1", "parameter": "k"}, r"loci\[0\].parameter: unknown parameter 'k'"),
        ("loci", {"point": "rest:LP1", "parameter": "k_sp", "file": "x"}, r"loci\[0\].file: unknown key 'file'"),
        ("loci", {"point": 3, "parameter": "k_sp"}, "expected a string"),
        ("loci", {"name": "../x"}, "'name' is not for a page to say"),
        ("sensitivities", {"csv": True}, "'csv' is not for a page to say"),
        ("branch", {"row": {"curve": "other", "row": 0}, "parameter": "F"}, "unknown curve 'other'. Valid: rest"),
        ("branch", {"row": {"curve": "rest", "row": 10**6}, "parameter": "F"}, "row 1000000 of"),
        ("branch", {"row": {"curve": "rest", "row": -1}, "parameter": "F"}, "row -1 of"),
        ("branch", {"row": 5, "parameter": "F"}, "a row is given as"),
        ("branch", {"parameter": "F", "settings": {"max_points": 10**6}}, "more than a page may ask for: up to 10000"),
        ("branch", {"parameter": "F", "settings": {"chord": 1e-8}}, "less than a page may ask for"),
        ("histories", {"duration": 1e9}, "more than a page may ask for: up to 10000"),
        ("maps", {"point": "rest:LP1", "grid": {"k_sp": {"from": 1, "to": 2, "count": 9999}}}, "9999 nodes are more"),
        ("histories", {"row": {"curve": "rest", "row": 5}, "nudge": 50}, "a nudge is a number"),
    ],
)
def test_a_click_that_cannot_be_is_refused_and_the_study_stays(session, table, args, said):
    before = session.toml()
    with pytest.raises(mc.MjcontError, match=said) as caught:
        session.add(table, args)
    assert "study.toml" not in str(caught.value)
    assert session.toml() == before
    assert session.running == ""


# -- undo, sliders, stopping ----------------------------------------------------------------------------------


def test_undo_drops_the_last_click(session):
    before = session.toml()
    session.add("sensitivities", {"point": "rest:LP1"})
    session.undo()
    assert session.toml() == before
    assert [*session.now.results] == ["rest"]
    assert session.events[-1]["can_undo"] is False


@pytest.mark.slow
def test_a_slider_computes_everything_at_another_value(session, overcentre_branch):
    session.add("sensitivities", {"point": "rest:LP1"})
    session.set("k_sp", 12.0)
    expected = overcentre_branch(k_sp=12.0, k_j=1000.0).point("LP1")["F"]
    assert session.now.results["rest"].point("LP1")["F"] == pytest.approx(expected, rel=1e-9)
    assert session.now.results["sensitivities_1"].point["F"] == pytest.approx(expected, rel=1e-9)
    assert session.now.tables["parameters"]["k_sp"] == 12.0


@pytest.mark.slow
def test_a_slider_that_goes_on_is_one_click(session):
    before = session.now
    for value in (11.0, 12.0, 13.0):
        session.set("k_sp", value)
    session.undo()
    assert session.now is before


def test_what_a_slider_loses_is_left_out_with_a_note(session):
    session.add("sensitivities", {"point": "rest:LP1"})
    session.set("load_factor", 5.0)  # the folds lie beyond the bounds
    assert [*session.now.results] == ["rest"]
    assert session.now.notes[-1].startswith("left out: sensitivity 'sensitivities_1': 'rest:LP1': unknown special")
    assert "sensitivities" not in session.now.tables


@pytest.mark.parametrize(("name", "value"), [("nothing", 1.0), ("F", 1e9), ("F", 10**400), ("k_sp", "3"), ("F", True)])
def test_a_slider_refuses_what_cannot_be(session, name, value):
    with pytest.raises(mc.MjcontError):
        session.set(name, value)


def test_stopping_keeps_the_points_so_far(session):
    def tell(event):
        if event["event"] == "progress" and event["done"]:
            session.stop.set()

    session._tell = tell
    args = {"row": row("rest", 5), "parameter": "k_sp", "bounds": [0.1, 1e6], "settings": {"ds_max": 1e-4, "ds": 1e-4}}
    (branch,) = session.add("branch", args).values()
    assert branch.interrupted
    assert 1 < len(branch) < 10_000
    assert "# equilibria was stopped; here it is computed whole." in session.toml()


@pytest.mark.slow
def test_what_runs_tells_its_points_with_their_observables(session):
    told = []
    session._tell = told.append
    session.add("loci", SLOW)
    partial = [e["curve"] for e in told if e["event"] == "curve"]
    locus = session.now.results["locus_1"]
    assert partial and partial[-1]["id"] == "locus_1"
    columns = partial[-1]["columns"]
    assert {*locus.free, *locus.problem.observables, "direction"} <= columns.keys()
    at = int(np.argmin(np.abs(locus["k_sp"] - columns["k_sp"][-1])))
    assert columns["theta_1"][-1] == pytest.approx(locus["theta_1"][at], rel=1e-9)
    assert {e["what"].partition(":")[0].split(", ")[-1] for e in told if e["event"] == "progress"} == {"locus"}


@pytest.mark.slow
def test_while_something_runs_others_get_a_word_in(begun):
    words = []
    session = Session(begun, lambda event: None, between=lambda: words.append("word"))
    session.add("loci", SLOW)
    assert words
