"""Study files that compute more than branches: what each table stores, what it starts from, how it is interrupted."""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.commands.told import Told
from mjcont.studies.reporter import Reporter
from mjcont.studies.study import load_study, run_study
from mjcont.studies.waveforms import Shape

ROOT = Path(__file__).parent.parent.parent
TRUSS = 'model = "von_mises_truss"\n'
# snap-through load of a truss of half span a, bars of stiffness k and length L0: at length l, l^3 = L0 a^2
FOLD = 2000.0 * (1.25 / (1.25) ** (1.0 / 3.0) - 1.0) * math.sqrt(1.25 ** (2.0 / 3.0) - 1.0)


def run(folder: Path, text: str, reporter: Reporter | None = None) -> list[Any]:
    """The results of a study's text, with files in `folder`/out."""
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return run_study(load_study(path), folder / "out", reporter)


def rows(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file."""
    with path.open(newline="") as f:
        return list(csv.DictReader(f))


@pytest.mark.slow
def test_a_diagram_starts_from_every_equilibrium_that_a_search_found(tmp_path: Path) -> None:
    found, ways = run(
        tmp_path,
        TRUSS
        + """
    [parameters]
    a = "0.35 m"
    [[searches]]
    name = "found"
    region = { z = [-1.3, 1.3], x = [-1, 1] }
    starts = 40
    [[diagrams]]
    name = "ways"
    parameter = "P"
    bounds = [-900, 900]
    from = "found"
    """,
    )
    assert sorted(found.column("z")) == pytest.approx([-1.2, 0.0, 1.2], abs=1e-9)
    written = sorted(float(r["z [m]"]) for r in rows(tmp_path / "out" / "found.csv"))
    assert written == pytest.approx([-1.2, 0.0, 1.2], abs=1e-9)
    assert len(ways) == 4
    stored = [mc.load(tmp_path / "out" / f"ways_{i}.h5") for i in range(1, 5)]
    np.testing.assert_array_equal(stored[2]["z"], ways[2]["z"])
    # the truss goes sideways where the stiffness across vanishes: l^2 (L0 - l) = L0 a^2
    lengths = np.array([p["length_left"] for b in ways for p in b.of_kind("BP")])
    assert len(lengths) == 4
    np.testing.assert_allclose(lengths**2 * (1.25 - lengths), 1.25 * 0.35**2, rtol=1e-9)


@pytest.mark.slow
def test_a_locus_and_a_map_of_a_fold_agree_with_its_closed_form(tmp_path: Path) -> None:
    _, locus, grid = run(
        tmp_path,
        TRUSS
        + """
    [[branch]]
    name = "equilibria"
    parameter = "P"
    bounds = [-50, 300]
    keyframe = "unloaded"
    direction = 1
    [[loci]]
    name = "fold"
    point = "equilibria:LP1"
    parameter = "k"
    bounds = ["0.8 kN/m", "1.2 kN/m"]
    csv = true
    [[maps]]
    name = "map"
    point = "equilibria:LP1"
    grid = { k = { from = 900, to = 1100, count = 3 } }
    """,
    )
    np.testing.assert_allclose(locus["P"], FOLD * locus["k"] / 1000.0, rtol=1e-8)
    np.testing.assert_allclose(grid["P"], FOLD * np.array([0.9, 1.0, 1.1]), rtol=1e-8)
    assert [float(r["P [N]"]) for r in rows(tmp_path / "out" / "map.csv")] == pytest.approx(list(grid["P"]), rel=1e-12)
    names = ["equilibria.h5", "fold.csv", "fold.h5", "map.csv", "map.png"]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == names


@pytest.mark.slow
def test_sensitivity_and_worst_case_of_a_fold_are_those_of_its_closed_form(tmp_path: Path) -> None:
    _, found, worst = run(
        tmp_path,
        TRUSS
        + """
    [[branch]]
    name = "equilibria"
    parameter = "P"
    bounds = [-50, 300]
    keyframe = "unloaded"
    direction = 1
    [[sensitivities]]
    name = "influence"
    point = "equilibria:LP1"
    parameters = ["k"]
    tolerances = { k = "50 N/m" }
    [[worst_cases]]
    name = "worst"
    point = "equilibria:LP1"
    ranges = { k = [900, "1.1 kN/m"] }
    maximise = false
    """,
    )
    assert found["P", "k"] == pytest.approx(FOLD / 1000.0, rel=1e-7)
    assert found.tolerances["k"] == 50.0
    assert worst.value == pytest.approx(0.9 * FOLD, rel=1e-7)
    assert float(rows(tmp_path / "out" / "worst.csv")[-1]["P [N]"]) == pytest.approx(0.9 * FOLD, rel=1e-7)
    assert (tmp_path / "out" / "influence.png").stat().st_size > 5000


@pytest.mark.slow
def test_a_history_begins_at_a_point_and_follows_its_inputs(tmp_path: Path) -> None:
    branch, history = run(
        tmp_path,
        TRUSS
        + """
    [[branch]]
    name = "equilibria"
    parameter = "P"
    bounds = [20, 120]
    start = { P = 50 }
    keyframe = "unloaded"
    [[histories]]
    name = "push"
    from = "equilibria:start"
    duration = 1
    samples = 100
    columns = ["P", "z"]
    csv = true
    [histories.inputs]
    P = { shape = "one_minus_cos", base = 50, amplitude = 40, start = "200 ms", duration = 0.4 }
    H = { times = [0, 1], values = [0, "2 N"] }
    """,
    )
    t = history["time"]
    gust = 50 + 20 * (1 - np.cos(2 * np.pi * (t - 0.2) / 0.4)) * ((t >= 0.2) & (t <= 0.6))
    np.testing.assert_allclose(history["P"], gust, atol=1e-6)
    np.testing.assert_allclose(history["H"], 2 * t, atol=1e-12)
    assert history["z"][0] == pytest.approx(branch.row(branch.start_index)["z"], abs=1e-12)
    assert sorted(p.name for p in (tmp_path / "out").iterdir() if "push" in p.name) == [
        "push.csv",
        "push.h5",
        "push.png",
    ]


@pytest.mark.parametrize(
    ("name", "given", "expected"),
    [
        ("ramp", {"from": 1.0, "to": 5.0, "start": 1.0, "duration": 2.0}, {0.0: 1.0, 2.0: 3.0, 9.0: 5.0}),
        ("step", {"from": 1.0, "to": 5.0, "start": 1.0}, {0.999: 1.0, 1.0: 5.0}),
        (
            "one_minus_cos",
            {"base": 1.0, "amplitude": 4.0, "start": 1.0, "duration": 2.0},
            {0.5: 1.0, 2.0: 5.0, 3.5: 1.0},
        ),
        ("sine", {"base": 1.0, "amplitude": 4.0, "start": 0.0, "period": 4.0}, {0.0: 1.0, 1.0: 5.0, 3.0: -3.0}),
    ],
)
def test_shapes_have_their_values_and_extremes(
    name: str, given: dict[str, float], expected: dict[float, float]
) -> None:
    shape = Shape(name, given)
    assert [shape(t) for t in expected] == pytest.approx(list(expected.values()))
    series = [shape(t) for t in np.linspace(0.0, 10.0, 4001)]
    assert shape.extremes == pytest.approx((min(series), max(series)), abs=1e-9)


@pytest.mark.long
def test_a_path_a_certificate_and_a_barrier_are_stored_and_drawn(tmp_path: Path) -> None:
    branch, path, certificate, barrier = run(
        tmp_path,
        TRUSS
        + """
    [[branch]]
    name = "equilibria"
    parameter = "P"
    bounds = [-200, 200]
    keyframe = "unloaded"
    [[paths]]
    name = "cycle"
    parameter = "P"
    values = ["0 kN", 0.2e3, -200]
    keyframe = "unloaded"
    landing = "creep"
    csv = true
    [[certificates]]
    name = "certified"
    branch = "equilibria"
    n = 4
    [[barriers]]
    name = "barrier"
    branch = "equilibria"
    search = false
    [[plot]]
    file = "cycle.svg"
    branches = ["cycle"]
    x = "P"
    y = "z"
    """,
    )
    assert [j.before["P"] for j in path.jumps] == pytest.approx([FOLD, -FOLD], rel=1e-7)
    assert certificate.holds
    assert mc.load(tmp_path / "out" / "certified.h5").certificate.holds
    assert {r["verdict"] for r in rows(tmp_path / "out" / "certified.csv")} == {"confirmed"}
    # at P = 0 the pass lies at z = 0, where both bars are 0.25 m short: k 0.25^2 J
    at_zero = np.argmin(np.abs(barrier.values))
    assert barrier.values[at_zero] == 0.0
    assert barrier.energy[at_zero] == pytest.approx(1000.0 * 0.25**2, rel=1e-6)
    names = ["barrier.csv", "barrier.png", "certified.csv", "certified.h5", "cycle.csv", "cycle.h5", "cycle.svg"]
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == [*names, "equilibria.h5"]
    assert len(branch) > 10


@pytest.mark.slow
def test_a_point_that_a_result_turns_out_not_to_have_is_named_and_what_came_before_is_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (
        TRUSS + '[[branch]]\nname = "equilibria"\nparameter = "P"\nbounds = [-200, 200]\nkeyframe = "unloaded"\n'
        '[[loci]]\nname = "fold"\npoint = "equilibria:LP7"\nparameter = "k"\n'
    )
    (tmp_path / "study.toml").write_text(text)
    assert main(["run", str(tmp_path / "study.toml"), "-o", str(tmp_path / "out"), "-q"]) == 2
    said = capsys.readouterr().err
    assert "locus 'fold': 'equilibria:LP7': unknown special point 'LP7'" in said
    assert "LP1" in said
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["equilibria.h5"]


def test_an_interrupted_search_is_stored_and_ends_the_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def impatient(self: Told, count: int, special: object) -> None:
        if count >= 20:
            raise KeyboardInterrupt

    monkeypatch.setattr(Told, "point", impatient)
    path = tmp_path / "study.toml"
    path.write_text(
        TRUSS + '[[searches]]\nname = "found"\n[[diagrams]]\nname = "ways"\nparameter = "P"\nfrom = "found"\n'
    )
    assert main(["run", str(path), "-o", str(tmp_path / "out"), "-q"]) == 130
    assert "'found' has the" in capsys.readouterr().err
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["found.csv"]
    assert len(rows(tmp_path / "out" / "found.csv")) >= 1


@pytest.mark.slow
def test_branches_start_from_points_of_earlier_results(tmp_path: Path) -> None:
    found, branch = run(
        tmp_path,
        TRUSS
        + """
    [[searches]]
    name = "found"
    start = { P = 30 }
    region = { x = [-0.1, 0.1], z = [0, 1] }
    starts = 20
    [[branch]]
    name = "from_found"
    from = "found:E1"
    parameter = "P"
    bounds = [20, 40]
    """,
    )
    assert branch.row(branch.start_index)["z"] == pytest.approx(found.point("E1")["z"], abs=1e-10)
    assert branch.row(branch.start_index)["P"] == 30.0


@pytest.mark.slow
def test_modes_and_transfer_functions_of_a_point_are_tabled_and_drawn(tmp_path: Path) -> None:
    branch, found, bode = run(
        tmp_path,
        TRUSS
        + """
    [[branch]]
    name = "equilibria"
    parameter = "P"
    bounds = [-50, 300]
    keyframe = "unloaded"
    direction = 1
    [[modes]]
    name = "small"
    point = "equilibria:LP1"
    png = true
    [[transfers]]
    name = "bode"
    point = "equilibria:start"
    input = "P"
    output = ["z"]
    frequencies = ["0.1 Hz", 10]
    count = 5
    """,
    )
    start = branch.row(branch.start_index)
    np.testing.assert_array_equal(bode["z"], mc.transfer(start, "P", "z", np.geomspace(0.1, 10, 5))["z"])
    assert len(rows(tmp_path / "out" / "bode.csv")) == 5
    assert (tmp_path / "out" / "bode.png").stat().st_size > 2000
    assert found.point.parameters["P"] == branch.point("LP1").parameters["P"]
    slowest = rows(tmp_path / "out" / "small.csv")[0]
    assert float(slowest["frequency [Hz]"]) == found[0].frequency
    assert abs(found[0].eigenvalue) < 1e-3 * abs(found[1].eigenvalue)  # at a fold K is singular
    assert (tmp_path / "out" / "small.png").stat().st_size > 2000
