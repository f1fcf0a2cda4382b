"""The study tables [[cycles]] and [[responses]]: what they store, and a line for each mistake."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.studies.study import check_study, load_study, run_study, summary

STUDY = """
model = "ziegler_rods"

[[branch]]
name = "rest"
parameter = "P"
bounds = [1.5, 2.0]
start = { P = 1.5 }

[[cycles]]
name = "flutter"
point = "rest:HB1"
csv = true
settings = { max_points = 4 }

[[responses]]
name = "shaken"
parameter = "frequency"
bounds = ["0.1 Hz", 0.2]
forcing = { P = { amplitude = 0.1, phase = "90 deg" } }
start = { P = 1.0 }
settings = { max_points = 3, mesh = 5 }

[[histories]]
name = "on"
from = "shaken:last"
samples = 200

[[plot]]
file = "flutter.png"
branches = ["rest", "flutter"]
x = "P"
y = "q1"

[[plot]]
file = "shaken.png"
x = "frequency"
y = "q1.amplitude"
"""


def study(folder: Path, text: str = STUDY) -> Path:
    path = folder / "orbits.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    folder = tmp_path_factory.mktemp("orbits")
    loaded = load_study(study(folder))
    return loaded, run_study(loaded, folder / "out"), folder / "out"


@pytest.mark.slow
def test_a_study_stores_its_orbits_and_pictures(done):
    _, (_, flutter, shaken, _), out = done
    names = sorted(p.name for p in out.iterdir())
    assert names == ["flutter.csv", "flutter.h5", "flutter.png", "on.h5", "rest.h5", "shaken.h5", "shaken.png"]
    loaded = mc.load(out / "flutter.h5")
    assert (loaded.kind, len(loaded)) == ("cycles", len(flutter))
    assert np.array_equal(loaded[1].orbit.states, flutter[1].orbit.states)
    assert shaken.forcing["inputs"]["P"] == [0.1, pytest.approx(np.pi / 2), 1]
    assert shaken["frequency"][0] == pytest.approx(0.1)


@pytest.mark.slow
def test_a_history_goes_on_from_an_orbit_for_ten_periods(done):
    _, (_, _, shaken, motion), _ = done
    orbit = shaken[-1].orbit
    assert motion["time"][-1] == pytest.approx(10.0 * orbit.period, rel=1e-2)
    assert motion["q1"][0] == pytest.approx(orbit["q1"][0], abs=1e-9)
    assert motion["q1"].max() == pytest.approx(orbit["q1"].max(), rel=0.05)


@pytest.mark.slow
def test_a_summary_says_what_would_be_computed(done):
    text = summary(done[0])
    assert "flutter: cycles: from rest:HB1" in text
    assert "shaken: response: frequency from 0.1 Hz to 0.2 Hz, P moving" in text


@pytest.mark.slow
def test_a_plot_of_a_column_of_orbits_shows_orbits_alone(done):
    shown = {p.file: p.branches for p in done[0].plots}
    assert shown["shaken.png"] == ("flutter", "shaken")


@pytest.mark.slow
def test_files_of_orbits_are_inspected_plotted_and_exported(done, capsys):
    file = str(done[2] / "flutter.h5")
    assert main(["inspect", file]) == 0
    assert "ziegler: cycles in P" in capsys.readouterr().out
    assert main(["plot", file, "-x", "P", "-y", "q1", "-o", str(done[2] / "a.png")]) == 0
    assert main(["plot", file, "-x", "P", "-y", "period", "-o", str(done[2] / "b.png")]) == 0
    assert main(["export", file, "-o", str(done[2] / "c.csv")]) == 0
    assert main(["plot", file, "-x", "P", "-y", "hip", "-o", str(done[2] / "d.png")]) == 2
    assert "unknown column 'hip'" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('point = "rest:HB1"', 'point = "rest:LP1"', "cycles[0].point: 'LP1': limit cycles begin at Hopf points"),
        ('point = "rest:HB1"', 'point = "rust:HB1"', "cycles[0].point: unknown branch, cycles or response 'rust'"),
        ('point = "rest:HB1"', "", "cycles[0].parameter: this key is missing"),
        ('point = "rest:HB1"', 'point = "rest:HB1"\nstart = { P = 1.7 }', "cycles[0].start: 'point' says where"),
        ("max_points = 4", "mesh = 1", "cycles[0].settings: mesh must be a whole number from 2"),
        ("max_points = 4", 'scheme = "lobatto"', "cycles[0].settings: unknown scheme 'lobatto'. Valid: gauss, radau"),
        ("max_points = 4", "meshes = 7", "cycles[0].settings.meshes: unknown key 'meshes'. Did you mean mesh"),
        ("forcing = { P = {", "forcing = { Q = {", "responses[0].forcing.Q: unknown parameter 'Q'"),
        ("amplitude = 0.1,", "", "responses[0].forcing.P.amplitude: this key is missing"),
        ('phase = "90 deg"', "turn = 1", "responses[0].forcing.P.turn: unknown key 'turn'"),
        ('phase = "90 deg"', "harmonic = 0", "harmonic must be a whole number, 1 or more, got 0"),
        ('parameter = "frequency"', 'parameter = "P.amplitud"', "responses[0].parameter: unknown parameter"),
        ('parameter = "frequency"', 'parameter = "P.amplitude"', "responses[0].bounds[0]: \"0.1 Hz\" does not fit"),
        ('["0.1 Hz", 0.2]', "[0.2, 0.1]", "responses[0].bounds"),
        ('["0.1 Hz", 0.2]', '["0.1 N", 0.2]', "does not fit a quantity in Hz. Valid units: Hz"),
        ('y = "q1.amplitude"', 'y = "q1.size"', "plot[1].y: unknown column 'q1.size'"),
        ('y = "q1"', 'y = "q1.max"', "plot[0].y: 'q1.max' is a column of periodic motion, which 'rest' is not"),
    ],
)
def test_each_mistake_is_named_with_its_place(tmp_path, old, new, message):
    assert old in STUDY
    found, lines = check_study(study(tmp_path, STUDY.replace(old, new, 1)))
    assert found is None
    assert any(message in line for line in lines), lines


@pytest.mark.parametrize(("label", "fits"), [("LPC1", True), ("PD1", True), ("LP1", False), ("BPC1", False)])
def test_loci_follow_folds_doublings_and_tori_of_orbits(tmp_path, label, fits):
    locus = f'\n[[loci]]\nname = "locus"\npoint = "flutter:{label}"\nparameter = "c"\nbounds = [0.05, 0.2]\n'
    found, lines = check_study(study(tmp_path, STUDY + locus))
    assert (found is not None) == fits
    assert fits or f"loci[0].point: '{label}'" in lines[0]
