"""Internal resonances of nonlinear modes, and the orbits of several periods that begin there, against DOP853."""

from __future__ import annotations

import numpy as np
import pytest
from problems.conservative import SPRING, TWO_PI, cubic_pair, elastic_pendulum, swing_of_a_bounce
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import mjcont as mc


def moved(field, state, time):
    run = solve_ivp(lambda t, u: field.function(u, field.values()), (0.0, time), state, method="DOP853", rtol=1e-12,
                    atol=1e-13)
    return run.y[:, -1]


def monodromy(field, orbit, step=1e-4):
    sides = [[moved(field, orbit.at(0.0) + s * step * e, orbit.period) for e in np.eye(4)] for s in (1.0, -1.0)]
    return ((np.array(sides[0]) - np.array(sides[1])) / (2.0 * step)).T


@pytest.fixture(scope="module")
def out_of_phase():
    return mc.continue_modes(cubic_pair(), "energy", (3.0, 12.0), mode=2)


@pytest.mark.slow
def test_a_mode_resonates_where_its_pair_passes_a_third_root_of_one(out_of_phase):
    points = out_of_phase.special_points
    assert [(p.kind, p.coefficients["order"]) for p in points] == [("IR", "3"), ("IR", "3")]
    for p in points:
        assert p.orbit.multipliers[p.orbit.own].sum() == pytest.approx(-1.0, abs=1e-10)
        assert np.trace(monodromy(cubic_pair(), p.orbit)) == pytest.approx(2.0 - 1.0, abs=1e-6)


@pytest.mark.slow
@pytest.mark.long
def test_a_family_in_frequency_has_the_same_resonances(out_of_phase):
    curve = mc.continue_modes(cubic_pair(), "frequency", (1.8 / TWO_PI, 2.05 / TWO_PI), mode=2)
    other = [p["energy"] for p in curve.special_points]
    assert other == pytest.approx([p["energy"] for p in out_of_phase.special_points], rel=1e-9)


@pytest.mark.slow
def test_a_stable_and_an_unstable_family_of_three_periods_begin_at_a_resonance(out_of_phase):
    curve = mc.continue_modes(out_of_phase.point("IR1"), "energy", (4.3, 5.5))
    assert not curve.special_points
    found = curve.at(energy=5.0)
    assert {p.stability for p in found} == {"stable", "unstable"}
    for p in found:
        start = p.orbit.at(0.0)
        assert moved(cubic_pair(), start, p.orbit.period) == pytest.approx(start, abs=1e-7)
        assert np.abs(moved(cubic_pair(), start, p.orbit.period / 3.0) - start).max() > 0.05
        assert abs(p.orbit.harmonics("x", 3)[2]) > 0.1  # the slower mode swings twice in three periods


@pytest.mark.slow
def test_a_bouncing_mass_begins_to_swing_where_hills_equation_says():
    curve = mc.continue_modes(elastic_pendulum(), "energy", (1e-3, 0.2), mode=2)
    (point,) = curve.special_points
    amplitude = brentq(lambda a: swing_of_a_bounce(a) + 2.0, 0.05, 0.25, xtol=1e-14)
    assert point.kind == "PD"
    assert point["energy"] == pytest.approx(0.5 * SPRING * amplitude**2, rel=1e-8)
    assert point["z.max"] == pytest.approx(amplitude, rel=1e-8)
    swinging = mc.continue_modes(point, "energy", (1e-3, 0.1), max_points=30)
    orbit = swinging.orbits[int(np.argmax(swinging["x.max"]))]
    assert moved(elastic_pendulum(), orbit.at(0.0), orbit.period) == pytest.approx(orbit.at(0.0), abs=1e-7)
    assert abs(orbit.harmonics("x", 2)[1]) > 0.05


@pytest.mark.long
def test_a_fold_is_told_by_the_energy_also_in_frequency():
    """The energy of the unsymmetric motions of two masses turns; in frequency they pass there."""
    begin = mc.continue_modes(cubic_pair(), "energy", (38.0, 42.0)).point("BPC1")
    by_energy = mc.continue_modes(
        begin, "energy", (40.0, 200.0), stop=lambda p: "far" if p["frequency"] > 0.2194 else ""
    )
    by_frequency = mc.continue_modes(begin, "frequency", (0.2, 0.2194))
    folds = [[p for p in curve.special_points if p.kind == "LPC"] for curve in (by_energy, by_frequency)]
    assert len(folds[0]) == len(folds[1]) == 2
    assert folds[1][0]["energy"] == pytest.approx(folds[0][0]["energy"], rel=1e-9)
    assert folds[1][0]["period"] == pytest.approx(folds[0][0]["period"], rel=1e-6)
