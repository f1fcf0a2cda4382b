"""Zero-Hopf and double Hopf points, on normal forms with known coefficients seen in other coordinates."""

from __future__ import annotations

import math
from functools import cache

import pytest
from problems.loci import kinds, only
from problems.locusforms import FORMS, FREQUENCIES, OMEGA, double_hopf, zero_hopf

import mjcont as mc


@cache
def zero_hopf_branch(s, a, c):
    return mc.continue_equilibria(zero_hopf(s, a, c), "b1", bounds=(-1.5, 1.0))


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
def test_a_fold_curve_has_one_zero_hopf_point_and_nothing_else(form):
    locus = mc.continue_special(only(zero_hopf_branch(*form), "LP"), "b2", bounds=(-0.6, 0.6))
    (point,) = locus.special_points
    assert point.kind == "ZH"
    assert [point["b1"], point["b2"]] == pytest.approx([0.0, 0.0], abs=1e-8)
    assert point.coefficients["omega"] == pytest.approx(OMEGA, rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("form", [FORMS[0], *(pytest.param(f, marks=pytest.mark.long) for f in FORMS[1:])])
def test_the_pole_of_l1_at_a_zero_hopf_point_is_no_generalised_hopf_point(form):
    locus = mc.continue_special(only(zero_hopf_branch(*form), "HB"), "b2", bounds=(-0.6, 0.6))
    (point,) = locus.special_points
    assert point.kind == "ZH"
    assert [point["b1"], point["b2"]] == pytest.approx([0.0, 0.0], abs=1e-8)


@pytest.mark.long
def test_a_generalised_hopf_point_beside_a_zero_hopf_point_is_found():
    locus = mc.continue_special(only(zero_hopf_branch(1.0, 1.0, 1.0), "HB"), "b2", bounds=(-0.8, 0.8))
    assert sorted(kinds(locus)) == ["GH", "ZH"]
    point = only(locus, "GH")
    assert [point["b1"], point["b2"]] == pytest.approx([-0.25, 0.5], rel=1e-8)


@pytest.mark.slow
def test_the_hopf_curve_of_the_zero_hopf_normal_form_follows_its_closed_form():
    locus = mc.continue_special(only(zero_hopf_branch(*FORMS[0]), "HB"), "b2", bounds=(-0.6, 0.6), lyapunov=False)
    assert locus["b1"] == pytest.approx(-locus["b2"] ** 2, abs=1e-8)


@pytest.mark.parametrize(("s", "a", "c"), FORMS)
def test_zero_hopf_coefficients_are_those_of_the_normal_form(s, a, c):
    locus = mc.continue_special(only(zero_hopf_branch(s, a, c), "LP"), "b2", bounds=(-0.6, 0.6))
    point = only(locus, "ZH")
    assert point.coefficients["s"] == s
    assert point.coefficients["theta"] == pytest.approx(a, rel=1e-6)


# mu = nu^2 and mu = 1 - nu
MEETING = (-1.0 + math.sqrt(5.0)) / 2.0


@cache
def double_hopf_branch():
    return mc.continue_equilibria(double_hopf(), "mu", bounds=(-1.0, 1.5))


@pytest.mark.slow
@pytest.mark.parametrize("label", ["HB1", "HB2"])
def test_a_double_hopf_point_is_found_on_both_hopf_curves_and_nothing_else(label):
    locus = mc.continue_special(double_hopf_branch().point(label), "nu", bounds=(0.0, 1.0))
    (point,) = locus.special_points
    assert point.kind == "HH"
    assert [point["mu"], point["nu"]] == pytest.approx([1.0 - MEETING, MEETING], rel=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize(("label", "own", "other"), [("HB1", 0, 1), ("HB2", 1, 0)])
def test_a_double_hopf_point_states_both_frequencies(label, own, other):
    locus = mc.continue_special(double_hopf_branch().point(label), "nu", bounds=(0.0, 1.0))
    coefficients = only(locus, "HH").coefficients
    assert coefficients["omega"] == pytest.approx(FREQUENCIES[own], rel=1e-8)
    assert coefficients["omega2"] == pytest.approx(FREQUENCIES[other], rel=1e-8)


@pytest.mark.slow
def test_double_hopf_coefficients_are_those_of_the_normal_form():
    locus = mc.continue_special(double_hopf_branch().point("HB1"), "nu", bounds=(0.0, 1.0))
    coefficients = only(locus, "HH").coefficients
    assert coefficients["theta"] == pytest.approx(0.5, rel=1e-6)
    assert coefficients["delta"] == pytest.approx(0.3, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("label", "growth"), [("HB1", lambda m, n: m - n**2), ("HB2", lambda m, n: m + n - 1.0)])
def test_hopf_curves_that_cross_each_other_are_followed_through_the_crossing(label, growth):
    locus = mc.continue_special(double_hopf_branch().point(label), "nu", bounds=(0.0, 1.0), lyapunov=False)
    assert growth(locus["mu"], locus["nu"]) == pytest.approx(0.0 * locus["mu"], abs=1e-8)
