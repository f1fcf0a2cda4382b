"""`mjcont check`: every problem of a study at once, each on a line that names the file, the key and the choices."""

import datetime
import importlib.util
import itertools
import re
from pathlib import Path
from typing import Any

import pytest

from mjcont.commands.cli import main
from mjcont.studies.keys import Context, read
from mjcont.studies.plans import TOP, check_study
from mjcont.studies.plots import PLOT
from mjcont.studies.schema import Table
from mjcont.studies.tables import KINDS, known

ROOT = Path(__file__).parent.parent.parent
BASE = """
model = "von_mises_truss"
[[searches]]
name = "found"
[[branch]]
name = "equilibria"
parameter = "P"
bounds = [-200, 200]
keyframe = "unloaded"
zeros = { z = 0 }
[[diagrams]]
name = "ways"
parameter = "P"
from = "found"
[[loci]]
name = "fold"
point = "equilibria:LP1"
parameter = "H"
[[paths]]
name = "cycle"
parameter = "P"
values = [0, 200, 0]
[[histories]]
name = "push"
inputs = { P = { shape = "ramp", from = 0, to = 60, duration = 1 } }
[[sensitivities]]
name = "influence"
point = "equilibria:LP1"
[[worst_cases]]
name = "worst"
point = "equilibria:LP1"
ranges = { k = [900, 1100] }
[[maps]]
name = "map"
point = "equilibria:LP1"
grid = { k = [900, 1100] }
[[holds]]
name = "held"
pose = "unloaded"
[[designs]]
name = "better"
points = { fold = "equilibria:LP1" }
change = { k = [900, 1200] }
targets = ["fold.P >= 50"]
[[certificates]]
name = "certified"
branch = "ways_1"
[[modes]]
name = "small"
point = "equilibria:start"
[[transfers]]
name = "bode"
point = "equilibria:start"
input = "P"
[[barriers]]
name = "barrier"
branch = "equilibria"
[[plot]]
file = "all.png"
x = "P"
y = "z"
"""


def problems(folder: Path, text: str) -> list[str]:
    """What a check says: lines that begin with the file."""
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    study, lines = check_study(path)
    assert (study is None) == bool(lines)
    assert all(line.startswith(f"{path}: ") and "\n" not in line for line in lines)
    return [line.removeprefix(f"{path}: ") for line in lines]


def test_nothing_is_wrong_with_a_study_of_every_table(tmp_path: Path) -> None:
    assert problems(tmp_path, BASE) == []


# what is replaced in BASE, by what, and the parts of the line that this gives
WRONG = {
    "syntax": ('model = "von', "model = von", ["not valid TOML", "line 2"]),
    "unknown table": ("[[histories]]", "[[history]]", ["history: unknown key", "Did you mean histories?"]),
    "unknown key": ("bounds = [-200", "bound = [-200", ["branch[0].bound: unknown key", "mean bounds?", "direction"]),
    "missing file": ('"von_mises_truss"', '"gear.xml"', ["model: ", "gear.xml", "no such file", "von_mises_truss"]),
    "wrong dimension": ("bounds = [-200, ", 'bounds = ["20 deg", ', ["branch[0].bounds[0]", "does not fit", "N, kN"]),
    "unknown parameter": (
        'parameter = "H"',
        'parameter = "G"',
        ["loci[0].parameter: unknown parameter 'G'", "gravity_"],
    ),
    "own parameter": ('parameter = "H"', 'parameter = "P"', ["loci[0].parameter: P is free already", "equilibria:LP1"]),
    "unknown keyframe": ('"unloaded"', '"unload"', ["branch[0].keyframe", "mean unloaded", "steep"]),
    "start outside": ("bounds = [-200, 200]", "bounds = [10, 200]", ["branch[0].start: P = 0 N", "10 N .. 200 N"]),
    "unknown branch": ('branch = "equilibria"', 'branch = "equilibrium"', ["barriers[0].branch", "mean equilibria?"]),
    "diagram for a branch": (
        '"ways_1"', '"ways"', ["certificates[0].branch: unknown branch, cycles or response 'ways'", "ways_1"],
    ),
    "label kind": (
        'point = "equilibria:LP1"',
        'point = "equilibria:CP1"',
        ["loci[0].point: 'CP1', a cusp,", "LP1, HB1"],
    ),
    "no label": ('point = "equilibria:LP1"', 'point = "equilibria"', ["loci[0].point: expected a result and a point"]),
    "no zeros": (
        'point = "equilibria:LP1"\nranges',
        'point = "fold:UZ1"\nranges',
        ["worst_cases[0].point: 'UZ1'", "no zeros"],
    ),
    "later result": (
        'keyframe = "unloaded"',
        'from = "cycle:final"',
        ["branch[0].from: unknown search, branch", "found"],
    ),
    "both starts": ('from = "found"', 'from = "found"\nstart = { P = 1 }', ["diagrams[0].start: 'from' says where"]),
    "unknown column": ('y = "z"', 'y = "zz"', ["plot[0].y: unknown column 'zz'", "Did you mean z?"]),
    "repeated name": ('name = "map"', 'name = "Fold"', ["maps[0].name: 'Fold' is the name of loci[0] already"]),
    "picture twice": ('"all.png"', '"map.png"', ["plot[0].file: 'map.png' is the file of maps[0] already"]),
    "name of a part": ('"barrier"', '"ways_2"', ["barriers[0].name: 'ways_2' is what a branch of the diagram 'ways'"]),
    "name of a part before it": (
        'name = "found"',
        'name = "ways_1"',
        ["searches[0].name: 'ways_1' is what a branch of the diagram 'ways'"],
    ),
    "name of a sweep's table": (
        'name = "map"',
        'name = "Sweep"\n[sweep]\n[[nothing]]',
        ["maps[0].name: 'Sweep' is what the table of the study's sweep is called"],
    ),
    "negative step": (
        'from = "found"',
        'from = "found"\nsettings = { ds = -1 }',
        ["diagrams[0].settings", "0 < ds_min"],
    ),
    "unknown setting": ("values =", "settings = { ds_mx = 1 }\nvalues =", ["paths[0].settings.ds_mx", "mean ds_max"]),
    "path that stands": ("[0, 200, 0]", "[5, 5]", ["paths[0].values: a path needs at least two different loads"]),
    "path outside": ("[0, 200, 0]", '["0 N", "2 m"]', ["paths[0].values[1]", "does not fit", "N, kN, MN"]),
    "unknown shape": ('"ramp"', '"rmap"', ["histories[0].inputs.P.shape: unknown shape 'rmap'", "mean ramp?", "sine"]),
    "shape without key": (", duration = 1", "", ["histories[0].inputs.P.duration: this key is missing", "from, to"]),
    "times falling": (
        '{ shape = "ramp", from = 0, to = 60, duration = 1 }',
        "{ times = [1, 0], values = [1, 2] }",
        ["histories[0].inputs.P.times: expected increasing times"],
    ),
    "code in a file": (
        '{ shape = "ramp", from = 0, to = 60, duration = 1 }',
        '"lambda t: 3"',
        ["histories[0].inputs.P: expected a number"],
    ),
    "range of own": ("ranges = { k = [900, 1100] }", "ranges = { P = [0, 1] }", ["worst_cases[0].ranges: P is free"]),
    "three in a grid": (
        "grid = { k = [900, 1100] }",
        "grid = { k = [9, 10], a = [1, 2], H = [0, 1] }",
        ["maps[0].grid: expected one or two parameters", "got 3"],
    ),
    "grid falling": ("grid = { k = [900, 1100] }", "grid = { k = [9, 8] }", ["maps[0].grid.k: expected increasing"]),
    "negative count": (
        'branch = "ways_1"',
        'branch = "ways_1"\nn = -3',
        ["certificates[0].n: expected a whole number", "-3"],
    ),
    "integrator": (
        "inputs =",
        'integrator = "rk4"\ninputs =',
        ["histories[0].integrator", "unknown integrator 'rk4'", "Valid: Euler, RK4"],
    ),
    "duration": ("inputs =", 'duration = "0 s"\ninputs =', ["histories[0].duration: expected a positive value"]),
}


@pytest.mark.parametrize(("old", "new", "parts"), WRONG.values(), ids=WRONG.keys())
def test_one_mistake_gives_one_line_with_key_and_choices(tmp_path: Path, old: str, new: str, parts: list[str]) -> None:
    assert old in BASE
    lines = problems(tmp_path, BASE.replace(old, new, 1))
    matching = [line for line in lines if all(part in line for part in parts)]
    assert len(matching) == 1, lines


def test_all_mistakes_are_told_at_once_and_a_wrong_table_causes_no_further_ones(tmp_path: Path) -> None:
    text = BASE.replace('parameter = "P"\nbounds', 'parameter = "PP"\nboundz').replace('y = "z"', 'y = "q"')
    text = text.replace("[900, 1100]", '["a", 1100]').replace("version", "v") + 'colour = "red"\n'
    keys = [line.partition(": ")[0] for line in problems(tmp_path, text)]
    assert sorted(keys) == sorted(
        [
            "branch[0].boundz",
            "branch[0].parameter",
            "worst_cases[0].ranges.k[0]",
            "maps[0].grid.k[0]",
            "plot[0].colour",
            "plot[0].y",
        ]
    )


def test_keys_are_checked_also_where_the_model_is_not_there(tmp_path: Path) -> None:
    text = BASE.replace("von_mises_truss", "gear.xml").replace("bounds =", "bound =")
    assert [line.partition(": ")[0] for line in problems(tmp_path, text)] == ["model", "branch[0].bound"]


def test_a_model_that_mujoco_rejects_and_a_range_of_a_control_are_told(tmp_path: Path) -> None:
    (tmp_path / "bad.xml").write_text("<mujoco><worldbody><bdy/></worldbody></mujoco>")
    (line,) = problems(tmp_path, 'model = "bad.xml"\n[[searches]]\nname = "a"\n')
    assert line.startswith("model: ")
    assert "bdy" in line
    (tmp_path / "lift.xml").write_text(
        '<mujoco><worldbody><body><joint name="z" type="slide" stiffness="1"/><geom size="0.1"/></body></worldbody>'
        '<actuator><general name="lift" joint="z" ctrllimited="true" ctrlrange="-1 2"/></actuator></mujoco>'
    )
    text = (
        'model = "lift.xml"\n[[branch]]\nname = "a"\nparameter = "lift"\nbounds = [0, 5]\n[[paths]]\nname = "b"\n'
        'parameter = "lift"\nvalues = [0, 3]\n[[histories]]\nname = "c"\n'
        'inputs = { lift = { shape = "sine", amplitude = 3, period = 1 } }\n'
    )
    lines = problems(tmp_path, text)
    assert [line.partition(": ")[0] for line in lines] == [
        "branch[0].bounds",
        "paths[0].values",
        "histories[0].inputs.lift",
    ]
    assert all("ctrlrange [-1, 2]" in line for line in lines)


ORBITS = """
[[cycles]]
name = "flutter"
point = "equilibria:HB1"
[[responses]]
name = "shaken"
parameter = "frequency"
bounds = [1, 2]
forcing = { P = { amplitude = 1 } }
[[nonlinear_modes]]
name = "large"
bounds = [0.1, 1]
"""
ODD: list[Any] = [
    3,
    -1,
    0,
    True,
    1.5,
    "x",
    "",
    "a:b",
    ":",
    [],
    [1],
    ["x"],
    [[]],
    {},
    {"x": 1},
    {"F": []},
    {"P": {}},
    datetime.date(2020, 1, 1),
    float("nan"),
    {"shape": 3},
    {"P": "x"},
    ["found:E1"],
    "found:",
]


@pytest.mark.parametrize("kind", [*KINDS, "plot"])
def test_no_value_of_any_key_breaks_the_check(kind: str) -> None:
    import tomllib

    from mjcont.mechanism.mechanism import Mechanism

    mechanism = Mechanism.from_xml("von_mises_truss")
    spec = PLOT if kind == "plot" else KINDS[kind]
    data = tomllib.loads(BASE + ORBITS)
    for key, value in itertools.product(spec.keys, ODD):
        context = Context(mechanism)
        for earlier, other in KINDS.items():
            for row in data[other.table]:
                context.known[row["name"]] = known(earlier, {}, row, context)
        table = Table("file", {**data[spec.table][0], key: value}, f"{spec.table}[0]")
        given = read(table, spec, context)
        assert (given is None) == bool(context.problems)


def test_the_command_prints_all_problems_and_ends_with_status_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "study.toml"
    path.write_text(BASE.replace('y = "z"', 'y = "q"').replace("[0, 200, 0]", "[]"))
    assert main(["check", str(path)]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert len(told.err.splitlines()) == 2
    assert all(line.startswith(f"{path}: ") for line in told.err.splitlines())


@pytest.mark.parametrize("study", sorted((ROOT / "studies").glob("*.toml")), ids=lambda p: p.stem)
def test_the_summary_of_a_study_names_everything_it_would_compute(
    study: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(study)]) == 0
    told = capsys.readouterr().out.splitlines()
    assert "nothing wrong" in told[0]
    named = re.findall(r'^(?:name|file) = "(.+?)"', study.read_text(), re.MULTILINE)
    assert sorted(line.strip().partition(":")[0] for line in told[1:]) == sorted(named)


def test_the_docs_have_every_key_with_its_default() -> None:
    spec = importlib.util.spec_from_file_location("study_tables", ROOT / "scripts" / "study_tables.py")
    assert spec is not None and spec.loader is not None
    written = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(written)
    page = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    assert written.rewritten(page) == page, "run scripts/study_tables.py"
    assert all(f"| `{key}` |" in page or f"## `[{key}" in page or f"## `[[{key}]]`" in page for key in TOP)


def test_the_docs_name_every_example() -> None:
    page = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    assert set(re.findall(r"^\| `(\w+\.toml)`", page, re.MULTILINE)) == {p.name for p in (ROOT / "studies").glob("*")}
