"""Study files: what they compute, and that every mistake in one is a single line naming the file, key and choices."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import mjcont as mc
from mjcont.curves.collect import Found
from mjcont.studies.reporter import Range, Reporter
from mjcont.studies.schema import quantity
from mjcont.studies.study import load_study, run_study

STUDIES = Path(__file__).parent.parent.parent / "studies"

GOOD = """
model = "overcentre"
[parameters]
k_j = "1 kN/m"
[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
"""
PLOT = '[[plot]]\nfile = "fig.png"\nx = "F"\ny = "theta_1"\n'
FALLING = """<mujoco model="falling">
<worldbody><body><joint name="z" type="slide" axis="0 0 1"/><geom size="0.1"/></body></worldbody>
<actuator><general name="lift" joint="z" ctrllimited="true" ctrlrange="-1 2"/></actuator></mujoco>"""


def write(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def message(folder: Path, text: str) -> str:
    """The message that a study's text is refused with: one line, naming the file."""
    path = write(folder, text)
    with pytest.raises(mc.StudyError) as caught:
        load_study(path)
    said = str(caught.value)
    assert "\n" not in said
    assert str(path) in said
    return said


@pytest.mark.slow
def test_a_study_computes_stores_and_draws_what_it_asks_for(tmp_path: Path) -> None:
    study = load_study(write(tmp_path, GOOD + "csv = true\nzeros = { theta_1 = 0 }\n" + PLOT))
    (branch,) = run_study(study, tmp_path / "out")
    assert [p.label for p in branch.special_points] == ["LP1", "UZ1", "LP2"]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["equilibria.csv", "equilibria.h5", "fig.png"]
    stored = mc.load(tmp_path / "out" / "equilibria.h5")
    np.testing.assert_array_equal(stored["theta_1"], branch["theta_1"])


@pytest.mark.slow
def test_a_study_may_ask_for_several_values_of_a_column(tmp_path: Path) -> None:
    study = load_study(write(tmp_path, GOOD + 'zeros = { theta_1 = [0, "10 deg"] }\n'))
    (branch,) = run_study(study, tmp_path)
    assert sorted(p["theta_1"] for p in branch.of_kind("UZ")) == pytest.approx([0.0, np.radians(10.0)], abs=1e-10)


@pytest.mark.slow
def test_folds_of_a_study_equal_the_reference(tmp_path: Path) -> None:
    (branch,) = run_study(load_study(write(tmp_path, GOOD)), tmp_path)
    assert branch.point("LP1")["F"] == pytest.approx(24.077406008, abs=1e-8)
    assert branch.point("LP2")["F"] == pytest.approx(15.162603207, abs=1e-8)


def test_start_and_parameters_of_a_branch_come_over_those_of_the_study(tmp_path: Path) -> None:
    study = load_study(write(tmp_path, GOOD.replace("{ F = 50 }", '{ F = "0.05 kN", k_j = 200 }')))
    assert dict(study.branches[0].start) == {"k_j": 200.0, "F": 50.0}


def test_the_model_is_looked_up_beside_the_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "study").mkdir()
    (tmp_path / "study" / "falling.xml").write_text(FALLING)
    monkeypatch.chdir(tmp_path)
    text = 'model = "falling.xml"\n[[branch]]\nname = "a"\nparameter = "lift"\nbounds = [0, 1]\n'
    assert load_study(write(tmp_path / "study", text)).mechanism.name == "falling"


def test_a_parameter_declared_in_the_study_is_one_of_the_models(tmp_path: Path) -> None:
    text = """
    model = "overcentre"
    [declare.k_A]
    targets = ["actuator:bush_A_*.biasprm[1]*-1"]
    unit = "N/m"
    bounds = ["0.1 kN/m", 1e6]
    [[branch]]
    name = "soft"
    parameter = "k_A"
    """
    study = load_study(write(tmp_path, text))
    assert study.branches[0].bounds == (100.0, 1e6)
    assert study.mechanism.parameter("k_A").value == 1000.0


def test_settings_and_direction_reach_the_continuation(tmp_path: Path) -> None:
    text = GOOD + 'direction = -1\n[branch.settings]\nmax_points = 5\nangle = "3 deg"\nchord = inf\n'
    (branch,) = run_study(load_study(write(tmp_path, text)), tmp_path)
    assert len(branch) == 5
    assert branch["F"].max() == 50.0
    assert branch.settings["angle"] == pytest.approx(math.radians(3.0))


def test_an_interrupt_stores_the_points_so_far_and_ends_the_run(tmp_path: Path) -> None:
    class Impatient(Reporter):
        def point(self, count: int, special: object) -> None:
            if count == 7:
                raise KeyboardInterrupt

    study = load_study(write(tmp_path, GOOD + '[[branch]]\nname = "next"\nparameter = "F"\n' + PLOT))
    (branch,) = run_study(study, tmp_path / "out", Impatient())
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["equilibria.h5"]
    stored = mc.load(tmp_path / "out" / "equilibria.h5")
    assert stored.interrupted
    assert len(stored) == len(branch) == 8


@pytest.mark.slow
def test_a_run_tells_each_result_and_where_its_curve_is(tmp_path: Path) -> None:
    class Listening(Reporter):
        started_: ClassVar[list[object]] = []
        found: ClassVar[list[Found]] = []

        def started(self, name: str, task: str, place: tuple[int, int], ranges: Mapping[str, Range]) -> None:
            self.started_.append((name, place, ranges))

        def point(self, count: int, found: Found) -> None:
            self.found.append(found)

    run_study(load_study(write(tmp_path, GOOD + PLOT)), tmp_path, Listening())
    assert Listening.started_ == [("equilibria", (1, 1), {"F": Range(-50.0, 50.0, "N")})]
    assert all(-50.0 <= f.parameters["F"] <= 50.0 for f in Listening.found)
    assert [f.kind for f in Listening.found if f.kind] == ["LP", "LP"]


SLOW = ("overcentre_cycle.toml", "overcentre_design.toml", "overcentre_shaken.toml")


@pytest.mark.slow
@pytest.mark.parametrize(
    "study",
    [pytest.param(p.name, marks=[pytest.mark.long] * (p.name in SLOW)) for p in sorted(STUDIES.glob("*.toml"))],
)
def test_the_studies_that_come_with_mjcont_run(study: str, tmp_path: Path) -> None:
    plan = load_study(STUDIES / study)
    results = run_study(plan, tmp_path)
    assert len(results) == len(plan.plans)
    branches = [b for r in results for b in getattr(r, "branches", [r]) if isinstance(b, mc.Branch)]
    assert all(set(b.ends) and b.status in ("at bound", "closed") for b in branches)
    assert all((tmp_path / p.file).stat().st_size > 5000 for p in plan.plots)


MISTAKES = {
    "not TOML": ("model = x", ["not valid TOML", "line 1, column 9"]),
    "no model": ('[[branch]]\nname = "a"\n', ["model: this key is missing"]),
    "no branch": ('model = "overcentre"\n', ["branch: this key is missing"]),
    "empty branch": ('model = "overcentre"\nbranch = []\n', ["branch", "at least one [[branch]]"]),
    "one branch without brackets": ('model = "overcentre"\n[branch]\nname = "a"\n', ["branch: expected", "[[branch]]"]),
    "model of wrong type": (GOOD.replace('"overcentre"', "3"), ["model: expected a string, got the number 3"]),
    "model not there": (GOOD.replace("overcentre", "gear.xml"), ["model: ", "gear.xml", "no such file", "overcentre"]),
    "newer schema": ("version = 2\n" + GOOD, ["version: this mjcont reads version 1", "2"]),
    "unknown top key": (GOOD.replace("[parameters]", "[parameter]"), ["parameter: unknown key", "mean parameters?"]),
    "unknown branch key": (GOOD.replace("bounds", "bound"), ["branch[0].bound: unknown key", "Did you mean bounds?"]),
    "missing branch key": (GOOD.replace('parameter = "F"', ""), ["branch[0].parameter: this key is missing"]),
    "unknown parameter": (GOOD.replace("k_j =", "k_jj ="), ["parameters.k_jj: unknown parameter", "Did you mean k_j?"]),
    "unknown free parameter": (GOOD.replace('"F"', '"G"'), ["branch[0].parameter: unknown parameter 'G'", "Valid: F"]),
    "unknown start": (GOOD.replace("{ F", "{ H"), ["branch[0].start.H: unknown parameter 'H'", "Valid: F"]),
    "value of wrong type": (GOOD.replace('"1 kN/m"', "true"), ["parameters.k_j: expected a number", "true"]),
    "value not finite": (GOOD.replace('"1 kN/m"', "nan"), ["parameters.k_j: expected a finite number", "nan"]),
    "unknown unit": (GOOD.replace("kN/m", "kN/n"), ["parameters.k_j: unknown unit 'kN/n'", "Did you mean kN/m"]),
    "wrong dimension": (GOOD.replace("kN/m", "deg"), ["parameters.k_j", "does not fit", "N/m, kN/m, MN/m, N/mm"]),
    "bounds of wrong type": (GOOD.replace("[-50, 50]", "50"), ["branch[0].bounds: expected two numbers", "number 50"]),
    "one bound": (GOOD.replace("[-50, 50]", "[50]"), ["branch[0].bounds: expected two numbers such as [-50, 50]"]),
    "bound of wrong type": (GOOD.replace("[-50,", "[[],"), ["branch[0].bounds[0]: expected a number"]),
    "bounds reversed": (GOOD.replace("[-50, 50]", "[50, -50]"), ["branch[0].bounds: ", "low < high"]),
    "start outside": (GOOD.replace("{ F = 50 }", "{ F = 60 }"), ["branch[0].start: F = 60 N", "-50 N .. 50 N"]),
    "unknown keyframe": (GOOD + 'keyframe = "up"\n', ["branch[0].keyframe: unknown keyframe 'up'"]),
    "short state": (GOOD + "state = [1, 2]\n", ["branch[0].state: expected 6 numbers (x_1, z_1, theta_1"]),
    "direction": (GOOD + "direction = 2\n", ["branch[0].direction: expected 1 or -1"]),
    "direction of wrong type": (GOOD + "direction = true\n", ["branch[0].direction: expected a whole number"]),
    "unknown zero": (
        GOOD + "zeros = { theta = 0 }\n",
        ["branch[0].zeros.theta: unknown column", "Did you mean theta_"],
    ),
    "csv of wrong type": (GOOD + 'csv = "yes"\n', ['branch[0].csv: expected true or false, got the string "yes"']),
    "unknown setting": (GOOD + "settings = { dsmax = 1 }\n", ["branch[0].settings.dsmax: unknown key", "mean ds_max"]),
    "setting of wrong type": (GOOD + "settings = { max_points = 1.5 }\n", ["max_points: expected a whole number"]),
    "settings that disagree": (GOOD + "settings = { ds = 1.0 }\n", ["branch[0].settings: ", "ds_min <= ds <= ds_max"]),
    "branch name no file name": (GOOD.replace('"equilibria"', '"../a"'), ["branch[0].name: '../a' names a file"]),
    "branch names twice": (GOOD + GOOD[GOOD.index("[[") :], ["branch[1].name: 'equilibria'", "branch[0] already"]),
    "plot of unknown branch": (
        GOOD + PLOT + 'branches = ["equ"]\n',
        ["plot[0].branches[0]: unknown branch", "Valid: eq"],
    ),
    "plot of no branch": (GOOD + PLOT + "branches = []\n", ["plot[0].branches: expected at least one branch"]),
    "plot of unknown column": (
        GOOD + PLOT.replace('"theta_1"', '"theta"'),
        ["plot[0].y: unknown column 'theta'", "theta_1"],
    ),
    "plot without column": (GOOD + PLOT.replace('x = "F"\n', ""), ["plot[0].x: this key is missing"]),
    "plot in a folder": (GOOD + PLOT.replace("fig", "a/fig"), ["plot[0].file: 'a/fig.png' names a folder"]),
    "plot of unknown format": (GOOD + PLOT.replace("png", "bmp"), ["plot[0].file", ".png, .pdf, .svg"]),
    "plot files twice": (GOOD + PLOT + PLOT, ["plot[1].file: 'fig.png' is the file of plot[0] already"]),
    "declared twice": (GOOD + '[declare.k_j]\ntargets = ["joint:x_1.stiffness"]\n', ["declare.k_j: the model has"]),
    "no targets": (GOOD + "[declare.k]\ntargets = []\n", ["declare.k.targets: expected at least one target"]),
    "targets of wrong type": (
        GOOD + '[declare.k]\ntargets = "x"\n',
        ["declare.k.targets: expected an array of strings"],
    ),
    "target not in model": (
        GOOD + '[declare.k]\ntargets = ["joint:q.stiffness"]\n',
        ["declare.k.targets", "joint names: x_1"],
    ),
    "declared with unknown key": (GOOD + '[declare.k]\ntarget = ["a"]\n', ["declare.k.target: unknown key", "targets"]),
    "name that needs quotes": (GOOD + '[declare."a b"]\ntargets = ["x"]\n', ['declare."a b": a parameter\'s name']),
}


@pytest.mark.parametrize(("text", "parts"), MISTAKES.values(), ids=MISTAKES.keys())
def test_a_mistake_names_the_file_the_key_and_the_choices(tmp_path: Path, text: str, parts: list[str]) -> None:
    said = message(tmp_path, text)
    for part in parts:
        assert part in said


def test_bounds_and_values_outside_a_ctrlrange_are_refused_before_anything_runs(tmp_path: Path) -> None:
    (tmp_path / "falling.xml").write_text(FALLING)
    text = 'model = "falling.xml"\n[[branch]]\nname = "a"\nparameter = "lift"\nbounds = [0, 5]\n'
    assert "branch[0].bounds" in message(tmp_path, text)
    assert "ctrlrange [-1, 2]" in message(tmp_path, text)
    text = text.replace("[0, 5]", "[0, 1]") + "start = { lift = 3 }\n"
    assert "branch[0].start.lift: lift = 3 lies outside the actuator's ctrlrange" in message(tmp_path, text)


def test_a_study_that_is_not_there_or_not_text_says_so(tmp_path: Path) -> None:
    with pytest.raises(mc.StudyError, match="no such file"):
        load_study(tmp_path / "none.toml")
    with pytest.raises(mc.StudyError, match="is a folder"):
        load_study(tmp_path)
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(mc.StudyError, match="cannot be read as text"):
        load_study(tmp_path / "binary.toml")


@pytest.mark.parametrize(
    ("value", "unit", "expected"),
    [
        (3, "N", 3.0),
        ("3", "N", 3.0),
        ("20 deg", "rad", math.radians(20.0)),
        ("20deg", "rad", math.radians(20.0)),
        ("-1.5e3 mm", "m", -1.5),
        ("2 N/mm", "N/m", 2000.0),
        ("2 kN", "", 2000.0),
        ("2 m", "mm", 2000.0),
        ("2 Pa", "Pa", 2.0),
    ],
)
def test_quantities_are_read_in_the_unit_of_what_they_set(value: object, unit: str, expected: float) -> None:
    assert quantity(value, unit) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("value", "unit", "part"),
    [
        ("20 kg", "rad", "Valid units: rad, deg."),
        ("20 deg", "1", "Valid units: 1."),
        ("20 N", "Pa", "Valid units: Pa."),
        ("twenty", "rad", '"20 deg"'),
        ("", "m", "expected a number"),
        ([1], "m", "array"),
        (math.inf, "m", "finite"),
        (10**400, "m", "finite"),
    ],
)
def test_quantities_that_do_not_fit_are_refused(value: object, unit: str, part: str) -> None:
    with pytest.raises(ValueError, match=".") as caught:
        quantity(value, unit)
    assert part in str(caught.value)
