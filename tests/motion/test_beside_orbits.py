"""Motion of vector fields and on orbits, and stability held against motions beside orbits."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from problems.oscillators import circles, flutter, linear, resonance

import mjcont as mc

TURN = mc.VectorField(lambda u, p: [p["w"] * u[1], -p["w"] * u[0]], [1.0, 0.0], {"w": 2.0}, names=["x", "y"])


# -- motion ---------------------------------------------------------------------------------------------------


def test_a_field_moves_as_its_solution_says():
    history = mc.simulate(TURN, duration=3.0, tol=1e-8, samples=31)
    time = history["time"]
    assert len(time) == 31
    assert history["x"] == pytest.approx(np.cos(2.0 * time), abs=1e-7)
    assert history.velocities[:, 0] == pytest.approx(-2.0 * np.sin(2.0 * time), abs=1e-6)
    assert history.settings["error"] < 1e-8


def test_inputs_of_a_field_are_functions_of_time():
    history = mc.simulate(TURN, {"w": lambda t: t}, 2.0, samples=11)
    assert history["w"] == pytest.approx(history["time"])
    assert history["x"] == pytest.approx(np.cos(0.5 * history["time"] ** 2), abs=1e-7)


def test_a_field_that_blows_up_is_a_status():
    blows = mc.VectorField(lambda u, p: [u[0] ** 2], [1.0], {"p": 0.0})
    history = mc.simulate(blows, duration=2.0)
    assert history.status in ("diverged", "stalled")
    assert history["time"][-1] < 1.0001


def test_a_field_comes_to_rest():
    decays = mc.VectorField(lambda u, p: [-u[0]], [1.0], {"p": 0.0})
    history = mc.simulate(decays, duration=100.0, until_rest=1e-3, samples=1001)
    assert history.status == "at rest"
    assert history["time"][-1] == pytest.approx(1.0 - math.log(1e-3), abs=1.0)


def test_what_a_field_does_not_take_is_named():
    with pytest.raises(mc.ParameterError, match="timestep is for a Mechanism"):
        mc.simulate(TURN, timestep=0.1)
    with pytest.raises(mc.ParameterError, match="integrator is for a Mechanism"):
        mc.simulate(TURN, integrator="RK4")
    with pytest.raises(mc.ParameterError, match="input 'w' is a controller"):
        mc.simulate(TURN, {"w": lambda t, seen: 0.0})


@pytest.mark.slow
def test_a_motion_on_an_orbit_stays_on_it():
    row = flutter()[-1]
    history = mc.simulate(row, tol=1e-4, integrator="RK4", timestep=0.02, samples=11)
    assert history["time"][-1] == pytest.approx(10.0 * row.orbit.period, abs=0.5)
    expected = [row.orbit.at(t)[0] for t in history["time"]]
    assert history["q1"] == pytest.approx(expected, abs=1e-4)


@pytest.mark.slow
def test_a_motion_on_a_response_of_a_field_keeps_its_forcing():
    orbit = resonance()[0].orbit
    history = mc.simulate(orbit, duration=5.5 * orbit.period, samples=12)
    assert history["x"] == pytest.approx([orbit.at(t)[0] for t in history["time"]], abs=1e-6)


@pytest.mark.slow
def test_a_motion_on_a_response_of_a_mechanism_has_its_inputs():
    rods = mc.Mechanism.from_xml("ziegler_rods")
    curve = mc.continue_response(
        rods, "frequency", (0.1, 0.11), {"P": mc.Harmonic(0.1)}, {"P": 1.0}, max_points=2, mesh=5
    )
    orbit = curve[0].orbit
    history = mc.simulate(orbit, duration=1.5 * orbit.period, samples=7)
    assert history["P"] == pytest.approx(1.0 + 0.1 * np.cos(2.0 * math.pi * history["time"] / orbit.period))


def test_an_orbit_says_where_its_motion_begins():
    with pytest.raises(mc.ParameterError, match="an orbit begins on itself"):
        mc.simulate(flutter()[0].orbit, start={"P": 1.0})


# -- stability held against motions ---------------------------------------------------------------------------


@pytest.mark.slow
def test_motions_beside_cycles_grow_and_shrink_as_multipliers_say():
    cycles = circles()[1]
    certificate = mc.verify_stability(cycles, n=6).certificate
    assert certificate.holds
    for check in certificate.of("confirmed"):
        r2 = float(cycles["u[0].max"][check.index]) ** 2
        assert check.rate == pytest.approx(2.0 * r2 * (1.0 - 2.0 * r2), rel=1e-2)


def test_a_wrong_verdict_is_contradicted():
    cycles = circles()[1]
    wrong = replace(cycles, stability=np.where(cycles.stability == "stable", "unstable", "stable"))
    (check,) = mc.verify_stability(wrong, rows=[5]).certificate
    assert check.verdict == "contradicted"


def test_an_orbit_that_does_not_close_is_contradicted():
    curve = resonance()
    orbit = curve.orbits[3]
    off = replace(orbit, path=replace(orbit.path, s=orbit.path.s + 0.01))
    wrong = replace(curve, orbits=[*curve.orbits[:3], off, *curve.orbits[4:]])
    (check,) = mc.verify_stability(wrong, rows=[3]).certificate
    assert check.verdict == "contradicted"
    assert "misses its start" in check.sentence


def test_motions_beside_flutter_shrink_to_it():
    (check,) = mc.verify_stability(flutter(), rows=[len(flutter()) - 1]).certificate
    assert check.verdict == "confirmed"
    assert "motions beside it shrink" in check.sentence


@pytest.mark.slow
def test_rests_of_a_field_are_checked_as_those_of_a_mechanism():
    certificate = mc.verify_stability(circles()[0], n=5).certificate
    assert certificate.holds
    for check in certificate:
        assert check.rate == pytest.approx(check.parameters["b1"], rel=1e-6)


def test_a_certificate_of_orbits_is_kept_in_their_file(tmp_path):
    checked = mc.verify_stability(resonance(), rows=[0])
    assert mc.load(checked.save(tmp_path / "checked.h5")).certificate.headline == checked.certificate.headline


def test_a_curve_loaded_without_its_field_cannot_be_checked(tmp_path):
    loaded = mc.load(resonance().save(tmp_path / "curve.h5"))
    with pytest.raises(mc.MjcontError, match="loaded with its problem"):
        mc.verify_stability(loaded)
    assert mc.verify_stability(mc.load(tmp_path / "curve.h5", problem=linear()), rows=[0]).certificate.holds
