"""Special points of orbits at which they are in closed form: none missed, none false, none twice."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.exactorbits import around, crossing, fork, ring
from problems.marks import long

import mjcont as mc

TWO_PI = 2.0 * math.pi


def followed(g, n, forced=False, turn=0.0, seed=1, bounds=(-0.3, 0.2)):
    field = around(g, n, {"p": bounds[0]}, [0.0] * n, seed, forced, turn)
    if forced:
        return mc.continue_response(field, "p", bounds)
    return mc.continue_cycles(field, "p", bounds)


def only_point(curve):
    (point,) = curve.special_points
    assert {status for status, _ in curve.ends} == {"at bound"}
    return point


BOTH = pytest.mark.parametrize("forced", [long(False), True], ids=["free", "forced"])


@pytest.mark.slow
@BOTH
def test_a_pair_of_orbits_leaves_a_symmetric_one(forced):
    curve = followed(fork(), 2, forced)
    point = only_point(curve)
    assert point.kind == "BPC"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    other = (mc.continue_response if forced else mc.continue_cycles)(point)
    orbit = other.at(p=0.1)[0].orbit
    assert len(other.at(p=0.1)) == 2
    assert np.abs(orbit.multipliers - math.exp(-2.0 * 0.1 * TWO_PI)).min() < 1e-6


@pytest.mark.slow
@BOTH
def test_two_curves_of_orbits_cross(forced):
    point = only_point(followed(crossing, 2, forced))
    assert point.kind == "BPC"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    other = (mc.continue_response if forced else mc.continue_cycles)(point)
    for p in (-0.1, 0.1):
        (at,) = other.at(p=p)
        assert np.abs(at.orbit.multipliers - math.exp(-p * TWO_PI)).min() < 1e-6


@pytest.mark.slow
@BOTH
def test_an_orbit_doubles_its_period(forced):
    curve = followed(fork(), 2, forced, turn=0.5)
    point = only_point(curve)
    assert point.kind == "PD"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    assert point.coefficients["type"] == "supercritical"
    double = (mc.continue_response if forced else mc.continue_cycles)(point)
    orbit = double.at(p=0.1)[0].orbit
    assert orbit.period == pytest.approx(2.0 * TWO_PI, rel=1e-9)
    assert np.abs(orbit.multipliers - math.exp(-2.0 * 0.1 * 2.0 * TWO_PI)).min() < 1e-6


@pytest.mark.slow
@BOTH
@pytest.mark.parametrize("omega", [long(0.13), 0.31, long(0.47)])
def test_a_torus_is_born(forced, omega):
    point = only_point(followed(ring(omega), 3, forced))
    assert point.kind == "NS"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    assert point.coefficients["rotation"] == pytest.approx(omega, abs=1e-8)
    assert point.coefficients["type"] == "supercritical"
    assert point.note == ""


@pytest.mark.slow
@BOTH
@pytest.mark.parametrize(("omega", "order"), [long(0.5, 2), long(1.0 / 3.0, 3), long(0.25, 4), (1.0, 1)])
def test_a_strong_resonance_is_named(forced, omega, order):
    """At 1:2 det(M + I) touches zero and changes no sign, at 1:1 det(M - I)."""
    point = only_point(followed(ring(omega, 0.1), 3, forced))
    assert point.kind == "NS"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    assert f"strong resonance 1:{order}" in point.note


@pytest.mark.slow
@BOTH
def test_two_multipliers_pass_one_together(forced):
    point = only_point(followed(fork(2), 3, forced, bounds=(-0.1, 0.1)))
    assert point.kind == "BPC"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    assert "2 multipliers pass 1 together" in point.note


@pytest.mark.slow
@BOTH
def test_two_multipliers_pass_minus_one_together(forced):
    point = only_point(followed(fork(2), 3, forced, turn=0.5, bounds=(-0.1, 0.1)))
    assert point.kind == "PD"
    assert point["p"] == pytest.approx(0.0, abs=1e-8)
    assert "2 multipliers pass -1 together" in point.note
