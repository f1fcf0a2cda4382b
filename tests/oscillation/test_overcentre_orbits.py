"""Forced motion of the overcentre mechanism, stiff and soft: verdicts against MuJoCo's own stepping, and cost."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.growth import fastest_mode, grown
from problems.marks import long

import mjcont as mc

TWO_PI = 2.0 * math.pi
SOFT_AND_STIFF = pytest.mark.parametrize("stiffness", [1e3, 1e6])


def response(parameter, bounds, stiffness, damping=0.0, mean=30.0, amplitude=5.0, omega=2.0, model=None, **options):
    model = model or mc.Mechanism.from_xml("overcentre")
    start = {"F": mean, "k_j": stiffness, "c_j": damping}
    forcing = {"F": mc.Harmonic(amplitude)}
    return mc.continue_response(model, parameter, bounds, forcing, start, frequency=omega / TWO_PI, **options)


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [long(1e3), 1e6])
def test_an_orbit_with_its_stability_costs_about_one_jacobian_a_point(stiffness):
    """20 intervals of degree 4 have 80 points, at each of which a Jacobian of 12 columns takes 25 evaluations."""
    model, counts = mc.Mechanism.from_xml("overcentre"), []
    bounds = (2.0 / TWO_PI, 2.6 / TWO_PI)
    options = {"mesh": 20, "degree": 4, "ds_max": 0.02, "direction": 1}
    response("frequency", bounds, stiffness, model=model, **options,
             progress=lambda count, special: counts.append(model.evaluations))
    costs = np.diff(counts)
    assert len(costs) > 5
    assert np.median(costs) <= 2500


@pytest.mark.long
@SOFT_AND_STIFF
@pytest.mark.parametrize("damping", [0.0, 100.0])
def test_every_verdict_is_that_of_a_motion_beside_the_orbit(stiffness, damping):
    curve = response("frequency", (1.0 / TWO_PI, 6.0 / TWO_PI), stiffness, damping)
    assert curve.special_points == ()
    for i in np.linspace(0, len(curve) - 1, 10).astype(int):
        orbit = curve.orbits[i]
        growth = grown(curve.model, orbit, fastest_mode(orbit))
        assert (growth < 1.0) == (curve.stability[i] == "stable")


@pytest.mark.long
def test_doublings_of_the_soft_mechanism_are_those_of_its_motion():
    curve = response("F.amplitude", (0.0, 20.0), 1e3, mean=20.0, amplitude=15.0, omega=1.5)
    doublings = curve.of_kind("PD")
    assert [p.kind for p in curve.special_points] == ["PD"] * len(doublings)
    for p in doublings:
        outside = [abs(o.multipliers[0]) > 1.0 for o in (curve.orbits[p.index - 1], curve.orbits[p.index + 1])]
        assert sorted(outside) == [False, True]
        for i in (p.index - 2, p.index + 2):
            orbit = curve.orbits[i]
            growth = grown(curve.model, orbit, fastest_mode(orbit))
            assert (growth < 1.0) == (curve.stability[i] == "stable")


@pytest.mark.long
def test_the_gear_under_a_small_harmonic_force_is_stable():
    gear = mc.Mechanism.from_xml("nose_gear_full")
    bounds = (0.5, 1.0)
    curve = mc.continue_response(gear, "frequency", bounds, {"F_ul": mc.Harmonic(1.0)}, frequency=0.5, direction=1)
    assert set(curve.stability) == {"stable"}
    assert curve.special_points == ()
