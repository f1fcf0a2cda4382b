"""What a study writes for others: tables in degrees, whichever table it is, and pictures that show something."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from problems.pictures import colored, meeting, watched

from mjcont.studies.study import load_study, run_study

# one of every table that writes a CSV file or a picture, with angles among parameters and observables
STUDY = """
model = "overcentre"
[[searches]]
name = "found"
region = { theta_1 = ["-90 deg", "90 deg"] }
starts = 20
[[branch]]
name = "rests"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
csv = true
[[loci]]
name = "fold"
point = "rests:LP1"
parameter = "gravity_angle"
bounds = ["-10 deg", "10 deg"]
csv = true
[[sensitivities]]
name = "influence"
point = "rests:LP1"
parameters = ["gravity_angle", "m_1"]
quantities = ["F", "theta_1"]
[[worst_cases]]
name = "worst"
point = "rests:LP1"
quantity = "F"
ranges = { gravity_angle = ["-5 deg", "5 deg"] }
[[maps]]
name = "map"
point = "rests:LP1"
grid = { gravity_angle = { from = "-10 deg", to = "10 deg", count = 5 }, m_1 = { from = 0.8, to = 1.2, count = 3 } }
[[maps]]
name = "line"
point = "rests:LP1"
grid = { gravity_angle = { from = "-10 deg", to = "10 deg", count = 3 } }
[[paths]]
name = "path"
parameter = "F"
values = [50, 30]
from = "rests:start"
csv = true
[[histories]]
name = "swing"
duration = 0.1
samples = 20
from = "rests:start"
inputs = { F = 40 }
columns = ["theta_1", "height"]
csv = true
[[certificates]]
name = "checked"
branch = "rests"
n = 2
[[barriers]]
name = "barrier"
branch = "rests"
search = false
[[modes]]
name = "small"
point = "rests:start"
png = true
[[transfers]]
name = "bode"
point = "rests:start"
input = "F"
output = ["theta_1"]
frequencies = [0.1, 10]
count = 30
[[plot]]
file = "rests.png"
branches = ["rests", "path"]
x = "F"
y = "theta_1"
[[plot]]
file = "fold.png"
branches = ["fold"]
x = "gravity_angle"
y = "F"
"""
TABLES = ["found", "rests", "fold", "influence", "worst", "map", "line", "path", "swing", "checked", "barrier", "small",
          "bode"]
PICTURES = ["influence", "map", "line", "swing", "barrier", "small", "bode", "rests", "fold"]


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, Any]]:
    folder = tmp_path_factory.mktemp("study")
    (folder / "study.toml").write_text(STUDY)
    study = load_study(folder / "study.toml")
    with pytest.MonkeyPatch.context() as patch:
        figures = watched(patch)
        found = run_study(study, folder / "out")
    return folder / "out", {**dict(zip([p.name for p in study.plans], found, strict=True)), "figures": figures}


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as f:
        return list(csv.DictReader(f))


@pytest.mark.slow
@pytest.mark.parametrize("name", TABLES)
def test_no_table_has_an_angle_in_radians(done: tuple[Path, dict[str, Any]], name: str) -> None:
    heads = list(rows(done[0] / f"{name}.csv")[0])
    assert not [h for h in heads if "[rad]" in h or "rad/N" in h]


@pytest.mark.slow
def test_every_table_and_picture_is_looked_at(done: tuple[Path, dict[str, Any]]) -> None:
    assert {p.stem for p in done[0].glob("*.csv")} == set(TABLES)
    assert {p.stem for p in done[0].glob("*.png")} == set(PICTURES)


@pytest.mark.slow
@pytest.mark.parametrize("name", PICTURES)
def test_every_picture_shows_something(done: tuple[Path, dict[str, Any]], name: str) -> None:
    assert colored(done[0] / f"{name}.png") > 1500


@pytest.mark.slow
def test_no_texts_of_a_picture_meet(done: tuple[Path, dict[str, Any]]) -> None:
    assert len(done[1]["figures"]) == len(PICTURES)
    assert [meeting(figure) for figure in done[1]["figures"]] == [[]] * len(PICTURES)


@pytest.mark.slow
def test_a_map_and_the_improvements_of_a_worst_case_are_in_degrees(done: tuple[Path, dict[str, Any]]) -> None:
    found = rows(done[0] / "map.csv")
    assert [float(r["gravity_angle [deg]"]) for r in found[::3]] == pytest.approx([-10.0, -5.0, 0.0, 5.0, 10.0])
    assert [float(r["m_1 [kg]"]) for r in found[:3]] == pytest.approx([0.8, 1.0, 1.2])
    theta = np.degrees(done[1]["map"]["theta_1"]).ravel()
    assert [float(r["theta_1 [deg]"]) for r in found] == pytest.approx(theta, rel=1e-14)
    last, at = rows(done[0] / "worst.csv")[-1], done[1]["worst"].parameters["gravity_angle"]
    assert float(last["gravity_angle [deg]"]) == pytest.approx(math.degrees(at))


@pytest.mark.slow
def test_derivatives_are_per_degree_and_in_degrees(done: tuple[Path, dict[str, Any]]) -> None:
    found = done[1]["influence"]
    angle, mass = rows(done[0] / "influence.csv")
    assert (angle["unit"], mass["unit"]) == ("deg", "kg")
    assert float(angle["d F [N / unit]"]) == pytest.approx(found["F", "gravity_angle"] * math.radians(1.0))
    assert float(mass["d theta_1 [deg / unit]"]) == pytest.approx(math.degrees(found["theta_1", "m_1"]))
    assert float(angle["d theta_1 [deg / unit]"]) == pytest.approx(found["theta_1", "gravity_angle"])
    assert float(angle["tolerance"]) == pytest.approx(math.degrees(found.tolerances["gravity_angle"]))


@pytest.mark.slow
def test_a_gain_is_in_degrees_per_newton(done: tuple[Path, dict[str, Any]]) -> None:
    found = rows(done[0] / "bode.csv")
    gain = [float(r["gain of theta_1 [deg/N]"]) for r in found]
    assert gain == pytest.approx(np.degrees(done[1]["bode"].gain("theta_1")))
    assert [float(r["phase of theta_1 [deg]"]) for r in found] == pytest.approx(
        np.degrees(done[1]["bode"].phase("theta_1")))


@pytest.mark.slow
def test_radians_on_request_are_those_of_the_attributes(done: tuple[Path, dict[str, Any]], tmp_path: Path) -> None:
    found = rows(done[1]["map"].to_csv(tmp_path / "radians.csv", degrees=False))
    assert [float(r["gravity_angle [rad]"]) for r in found[::3]] == list(done[1]["map"].axes["gravity_angle"])
