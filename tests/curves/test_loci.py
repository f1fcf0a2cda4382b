"""Loci of special points in two and three parameters, and the points of higher codimension on them.

Closed forms where there are any; the generalised Hopf point of the AUTO demo ab was solved with 30 digits. Normal
forms: Kuznetsov, Elements of Applied Bifurcation Theory, 3rd ed., chapter 8.
"""

from __future__ import annotations

import itertools
import math
from functools import cache

import numpy as np
import pytest
from problems.fields import ab, branch_of_ab, branch_of_brusselator, cusp
from problems.reference import ELASTIC_FOLDS

import mjcont as mc

UPPER, LOWER = 0, 1
FOLD_LABELS = {UPPER: "LP2", LOWER: "LP1"}


def kinds(branch):
    return [p.kind for p in branch.special_points]


def only(branch, kind):
    (point,) = branch.of_kind(kind)
    return point


# -- folds of ab in (D, B) ------------------------------------------------------------------------------------


@cache
def folds_of_ab(label="LP1"):
    return mc.continue_special(branch_of_ab(18.0).point(label), "B", bounds=(8.0, 40.0))


def test_the_fold_curve_of_ab_has_one_cusp_and_one_bogdanov_takens_point_and_nothing_else():
    assert sorted(kinds(folds_of_ab())) == ["BT", "CP"]


def test_the_cusp_of_ab_lies_where_its_closed_form_has_it():
    point = only(folds_of_ab(), "CP")
    found = [point["u"], point["B"], point["D"]]
    assert found == pytest.approx([0.5, 16.0, math.exp(-2.0)], rel=1e-8)


def test_the_bogdanov_takens_point_of_ab_lies_where_its_closed_form_has_it():
    point = only(folds_of_ab(), "BT")
    found = [point["u"], point["B"], point["D"]]
    assert found == pytest.approx([0.25, 64.0 / 3.0, math.exp(-4.0 / 3.0) / 3.0], rel=1e-8)


def test_every_point_of_the_fold_curve_of_ab_obeys_its_closed_form():
    locus = folds_of_ab()
    u, B = locus["u"], locus["B"]
    assert u * (1.0 - u) == pytest.approx(4.0 / B, abs=1e-8)
    assert locus["D"] == pytest.approx(u / (1.0 - u) * np.exp(-B * u / 4.0), abs=1e-8)


def test_the_fold_curve_of_ab_reaches_its_bound_at_both_ends():
    assert folds_of_ab()["B"][[0, -1]] == pytest.approx([40.0, 40.0], rel=1e-12)
    assert folds_of_ab().status == "at bound"


def test_the_fold_curve_of_ab_is_the_same_from_its_other_fold():
    for kind in ("CP", "BT"):
        one, other = only(folds_of_ab("LP1"), kind), only(folds_of_ab("LP2"), kind)
        assert [one["D"], one["B"]] == pytest.approx([other["D"], other["B"]], rel=1e-10)


def test_points_of_a_fold_curve_say_how_well_they_are_located():
    assert [p.converged for p in folds_of_ab().special_points] == [True, True]
    assert max(p.tolerance for p in folds_of_ab().special_points) < 1e-8


# -- Hopf points of ab in (D, B) ------------------------------------------------------------------------------


@cache
def hopfs_of_ab(label="HB2", high=24.0, **options):
    return mc.continue_special(branch_of_ab(18.0).point(label), "B", bounds=(8.0, high), **options)


def test_the_hopf_curve_of_ab_has_one_bogdanov_takens_and_one_generalised_hopf_point_and_nothing_else():
    assert sorted(kinds(hopfs_of_ab())) == ["BT", "GH"]


def test_the_bogdanov_takens_point_on_the_hopf_curve_is_that_on_the_fold_curve():
    point = only(hopfs_of_ab(), "BT")
    found = [point["u"], point["B"], point["D"]]
    assert found == pytest.approx([0.25, 64.0 / 3.0, math.exp(-4.0 / 3.0) / 3.0], rel=1e-8)


def test_the_generalised_hopf_point_of_ab_is_the_known_one():
    point = only(hopfs_of_ab(), "GH")
    found = [point["u"], point["B"], point["D"]]
    assert found == pytest.approx([0.578464834591373, 11.0158490926599, 0.278985414468441], rel=1e-8)


def test_every_point_of_the_hopf_curve_of_ab_obeys_its_closed_form():
    u, B = hopfs_of_ab()["u"], hopfs_of_ab()["B"]
    assert -1.0 / (1.0 - u) + B * u - 4.0 == pytest.approx(0.0 * u, abs=1e-8)


def test_the_hopf_curve_of_ab_ends_at_its_bogdanov_takens_point():
    locus = hopfs_of_ab()
    assert sorted(word for word, _ in locus.ends) == ["at bound", "at special point"]
    assert only(locus, "BT").index in (0, len(locus) - 1)


def test_the_hopf_curve_of_ab_goes_on_into_neutral_saddles_when_asked():
    locus = hopfs_of_ab(end_at=())
    assert [word for word, _ in locus.ends] == ["at bound", "at bound"]
    assert sorted(kinds(locus)) == ["BT", "GH"]
    beyond = locus["u"] < 0.25 - 1e-6
    assert beyond.any()
    # there two real eigenvalues have sum zero
    assert np.abs(locus.eigenvalues[beyond].imag).max() == 0.0
    assert np.abs(locus.eigenvalues[beyond].sum(axis=1)).max() < 1e-7


def test_the_hopf_curve_of_ab_is_the_same_from_its_other_hopf_point():
    for kind in ("BT", "GH"):
        one, other = only(hopfs_of_ab("HB1"), kind), only(hopfs_of_ab("HB2"), kind)
        assert [one["D"], one["B"]] == pytest.approx([other["D"], other["B"]], rel=1e-8)


def test_the_hopf_curve_of_ab_takes_as_many_points_whichever_hopf_point_it_starts_from():
    # omega is ten times larger at the second
    assert len(hopfs_of_ab("HB1")) < 2 * len(hopfs_of_ab("HB2"))


def test_the_hopf_curve_of_ab_reaches_its_bound_where_D_is_a_3000th_of_its_range():
    locus = hopfs_of_ab(high=50.0, direction=1, lyapunov=False)
    assert locus.status == "at bound", locus.message
    u, B = locus["u"], locus["B"]
    assert -1.0 / (1.0 - u) + B * u - 4.0 == pytest.approx(0.0 * u, abs=1e-8)


def test_no_generalised_hopf_point_is_sought_when_l1_is_not_wanted():
    assert kinds(hopfs_of_ab(lyapunov=False)) == ["BT"]


def test_the_hopf_curve_of_the_brusselator_is_1_plus_A_squared():
    locus = mc.continue_special(branch_of_brusselator().point("HB1"), "A", bounds=(0.2, 3.0))
    assert locus["B"] == pytest.approx(1.0 + locus["A"] ** 2, abs=1e-8)
    assert locus.special_points == ()
    assert locus.status == "at bound"


# -- cusps ----------------------------------------------------------------------------------------------------


def test_the_fold_curve_of_the_cusp_normal_form_is_its_semicubical_parabola():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0))
    locus = mc.continue_special(branch.point("LP1"), "la", bounds=(-1.0, 2.0))
    assert 27.0 * locus["mu"] ** 2 == pytest.approx(4.0 * locus["la"] ** 3, abs=1e-8)
    assert kinds(locus) == ["CP"]
    assert [only(locus, "CP")[name] for name in ("mu", "la", "x")] == pytest.approx([0.0, 0.0, 0.0], abs=1e-8)


def tilted_cusp():
    """x' = mu + la x + e x^2 - x^3: three equal roots r = e / 3 at la = -3 r^2, mu = r^3."""

    def f(u, p):
        return [p["mu"] + p["la"] * u[0] + p["e"] * u[0] ** 2 - u[0] ** 3]

    return mc.VectorField(f, [-1.2098], {"mu": -1.0, "la": 1.0, "e": 0.3}, names=["x"])


@cache
def curve_of_cusps():
    branch = mc.continue_equilibria(tilted_cusp(), "mu", bounds=(-2.0, 2.0))
    folds = mc.continue_special(branch.point("LP1"), "la", bounds=(-2.0, 2.0))
    return mc.continue_special(only(folds, "CP"), "e", bounds=(-2.0, 2.0))


def test_cusps_in_three_parameters_follow_their_closed_form():
    locus = curve_of_cusps()
    assert locus["x"] == pytest.approx(locus["e"] / 3.0, abs=1e-8)
    assert locus["la"] == pytest.approx(-locus["e"] ** 2 / 3.0, abs=1e-8)
    assert locus["mu"] == pytest.approx(locus["e"] ** 3 / 27.0, abs=1e-8)


def test_cusps_in_three_parameters_are_followed_from_bound_to_bound():
    assert curve_of_cusps().kind == "CP locus"
    assert curve_of_cusps()["e"][[0, -1]] == pytest.approx([-2.0, 2.0], abs=1e-12)


# -- Bogdanov-Takens and zero-Hopf points in three parameters --------------------------------------------------------


def test_bogdanov_takens_points_in_three_parameters_follow_their_closed_form():
    # x'' = b1 + b2 x + x^2 + (b3 + x) x': trace and determinant vanish at x = -b3, b2 = 2 b3, b1 = b3^2
    def f(u, p):
        return [u[1], p["b1"] + p["b2"] * u[0] + u[0] ** 2 + (p["b3"] + u[0]) * u[1]]

    field = mc.VectorField(f, [-1.0, 0.0], {"b1": 0.0, "b2": 1.0, "b3": 0.0}, names=["x", "y"])
    branch = mc.continue_equilibria(field, "b1", bounds=(-2.0, 2.0))
    folds = mc.continue_special(only(branch, "LP"), "b2", bounds=(-2.0, 2.0))
    locus = mc.continue_special(only(folds, "BT"), "b3", bounds=(-0.7, 0.9))
    assert locus["x"] == pytest.approx(-locus["b3"], abs=1e-8)
    assert locus["b2"] == pytest.approx(2.0 * locus["b3"], abs=1e-8)
    assert locus["b1"] == pytest.approx(locus["b3"] ** 2, abs=1e-8)
    assert sorted(locus["b3"][[0, -1]]) == pytest.approx([-0.7, 0.9], abs=1e-12)


def test_zero_hopf_points_in_three_parameters_follow_their_closed_form():
    def f(u, p):
        growth = p["b2"] + u[0] + p["d"] * u[0] + p["d"] ** 2
        return [p["b1"] + u[0] ** 2 + u[1] ** 2 + u[2] ** 2, growth * u[1] - u[2], u[1] + growth * u[2]]

    field = mc.VectorField(f, [-1.0, 0.0, 0.0], {"b1": -1.0, "b2": 0.3, "d": 0.0}, names=["x", "y", "z"])
    branch = mc.continue_equilibria(field, "b1", bounds=(-1.5, 1.0))
    folds = mc.continue_special(only(branch, "LP"), "b2", bounds=(-0.6, 0.6))
    locus = mc.continue_special(only(folds, "ZH"), "d", bounds=(-0.5, 0.7))
    assert locus["b1"] == pytest.approx(0.0 * locus["d"], abs=1e-8)
    assert locus["b2"] == pytest.approx(-locus["d"] ** 2, abs=1e-8)
    assert sorted(locus["d"][[0, -1]]) == pytest.approx([-0.5, 0.7], abs=1e-12)


# -- points at which a fold curve turns without a cusp ------------------------------------------------------------


def conic(sign):
    """x' = x^2 + sign la^2 - mu: circles about an isola centre, or hyperbolas about a crossing, at the origin."""

    def f(u, p):
        return [u[0] ** 2 + sign * p["la"] ** 2 - p["mu"]]

    state, values = ([1.0], {"la": 0.0, "mu": 1.0}) if sign > 0 else ([1.4], {"la": 1.5, "mu": -0.3})
    return mc.VectorField(f, state, values, names=["x"])


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["isola centre", "crossing"])
def test_a_fold_curve_has_a_branch_point_where_its_first_parameter_does_not_move_the_equation(sign):
    branch = mc.continue_equilibria(conic(sign), "la", bounds=(-2.0, 2.0))
    locus = mc.continue_special(branch.point("LP1"), "mu", bounds=(-1.5, 1.5))
    (point,) = locus.special_points
    assert point.kind == "BP"
    assert [point["la"], point["mu"], point["x"]] == pytest.approx([0.0, 0.0, 0.0], abs=1e-8)
    assert "turns without a cusp" in point.note


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["isola centre", "crossing"])
def test_a_fold_curve_passes_its_branch_point(sign):
    branch = mc.continue_equilibria(conic(sign), "la", bounds=(-2.0, 2.0))
    locus = mc.continue_special(branch.point("LP1"), "mu", bounds=(-1.5, 1.5))
    assert locus["mu"] == pytest.approx(sign * locus["la"] ** 2, abs=1e-8)
    assert sorted(locus["la"][[0, -1]]) == pytest.approx([-math.sqrt(1.5), math.sqrt(1.5)], rel=1e-10)


# -- branch points in two parameters ------------------------------------------------------------------------------


@pytest.fixture
def pendulum(pendulum_xml):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(joint='stiffness="1" damping="1"'))
    mechanism.declare("k", "joint:hip.stiffness[0]", unit="N*m/rad", bounds=(0.1, 3.0))
    mechanism.declare("rest", "joint:hip.springref", unit="rad", bounds=(-0.5, 0.5))
    return mechanism


def upright(pendulum):
    return mc.continue_equilibria(pendulum, "load_factor", bounds=(0.0, 0.2), start={"load_factor": 0.0})


def test_the_branch_point_of_the_pendulum_persists_in_the_stiffness_of_its_spring(pendulum):
    locus = mc.continue_special(upright(pendulum).point("BP1"), "k", bounds=(0.5, 1.5))
    assert locus["load_factor"] * 9.81 == pytest.approx(locus["k"], rel=1e-8)
    assert locus["k"][[0, -1]] == pytest.approx([0.5, 1.5], rel=1e-12)
    assert locus.status == "at bound"


def test_the_branch_point_of_the_pendulum_does_not_persist_when_its_spring_is_turned(pendulum):
    locus = mc.continue_special(upright(pendulum).point("BP1"), "rest", bounds=(-0.3, 0.3))
    assert locus.status == "stopped"
    assert "does not persist" in locus.message
    assert np.abs(locus["rest"]).max() < 1e-3


def pitchfork():
    def f(u, p):
        return [(p["mu"] + p["k"]) * u[0] - u[0] ** 3 + p["e"]]

    return mc.VectorField(f, [0.0], {"mu": -1.0, "k": 0.0, "e": 0.0}, names=["x"])


def test_the_branch_point_of_a_scalar_pitchfork_persists_where_every_derivative_vanishes():
    branch = mc.continue_equilibria(pitchfork(), "mu", bounds=(-1.0, 1.0))
    locus = mc.continue_special(branch.point("BP1"), "k", bounds=(-0.5, 0.5))
    assert locus.status == "at bound", locus.message
    assert locus["mu"] == pytest.approx(-locus["k"], abs=1e-8)


def test_the_branch_point_of_a_scalar_pitchfork_does_not_persist_under_an_imperfection():
    branch = mc.continue_equilibria(pitchfork(), "mu", bounds=(-1.0, 1.0))
    locus = mc.continue_special(branch.point("BP1"), "e", bounds=(-0.5, 0.5))
    assert locus.status == "stopped"
    assert "does not persist" in locus.message


# -- zero-Hopf and double Hopf normal forms -----------------------------------------------------------------------

SPACE = np.array([[1.0, 0.5, 0.0], [-0.3, 1.0, 0.4], [0.2, -0.6, 1.0]])
SHIFT = np.array([0.7, -0.4, 0.2])
OMEGA = 2.0


def zero_hopf(s, a, c):
    """x' = b1 + x^2 + s r^2, growth of the oscillation b2 + a x - c r^2, seen through a linear change of coordinates.

    Folds at b1 = 0; Hopf points at x = -b2 / a, b1 = -x^2, where l1 is in proportion to -a s / (2 x) - c: it has a
    pole at the zero-Hopf point b1 = b2 = 0 and vanishes at x = -a s / (2 c).
    """
    back = np.linalg.inv(SPACE)

    def f(u, p):
        x, y, z = back @ (u - SHIFT)
        r2 = y * y + z * z
        growth = p["b2"] + a * x - c * r2
        return SPACE @ [p["b1"] + x * x + s * r2, growth * y - OMEGA * z, OMEGA * y + growth * z]

    return mc.VectorField(f, SHIFT + SPACE @ [-1.0, 0.0, 0.0], {"b1": -1.0, "b2": 0.3})


@cache
def zero_hopf_branch(s, a, c):
    return mc.continue_equilibria(zero_hopf(s, a, c), "b1", bounds=(-1.5, 1.0))


FORMS = [(1.0, 1.0, 0.0), (-1.0, 2.0, -2.0)]


@pytest.mark.parametrize("form", FORMS)
def test_a_fold_curve_has_one_zero_hopf_point_and_nothing_else(form):
    locus = mc.continue_special(only(zero_hopf_branch(*form), "LP"), "b2", bounds=(-0.6, 0.6))
    (point,) = locus.special_points
    assert point.kind == "ZH"
    assert [point["b1"], point["b2"]] == pytest.approx([0.0, 0.0], abs=1e-8)
    assert point.coefficients["omega"] == pytest.approx(OMEGA, rel=1e-8)


@pytest.mark.parametrize("form", FORMS)
def test_the_pole_of_l1_at_a_zero_hopf_point_is_no_generalised_hopf_point(form):
    locus = mc.continue_special(only(zero_hopf_branch(*form), "HB"), "b2", bounds=(-0.6, 0.6))
    (point,) = locus.special_points
    assert point.kind == "ZH"
    assert [point["b1"], point["b2"]] == pytest.approx([0.0, 0.0], abs=1e-8)


def test_a_generalised_hopf_point_beside_a_zero_hopf_point_is_found():
    locus = mc.continue_special(only(zero_hopf_branch(1.0, 1.0, 1.0), "HB"), "b2", bounds=(-0.8, 0.8))
    assert sorted(kinds(locus)) == ["GH", "ZH"]
    point = only(locus, "GH")
    assert [point["b1"], point["b2"]] == pytest.approx([-0.25, 0.5], rel=1e-8)


def test_the_hopf_curve_of_the_zero_hopf_normal_form_follows_its_closed_form():
    locus = mc.continue_special(only(zero_hopf_branch(*FORMS[0]), "HB"), "b2", bounds=(-0.6, 0.6), lyapunov=False)
    assert locus["b1"] == pytest.approx(-locus["b2"] ** 2, abs=1e-8)


@pytest.mark.parametrize(("s", "a", "c"), FORMS)
def test_zero_hopf_coefficients_are_those_of_the_normal_form(s, a, c):
    locus = mc.continue_special(only(zero_hopf_branch(s, a, c), "LP"), "b2", bounds=(-0.6, 0.6))
    point = only(locus, "ZH")
    assert point.coefficients["s"] == s
    assert point.coefficients["theta"] == pytest.approx(a / 2.0, rel=1e-6)


HYPERSPACE = np.array([[1.2, 0.3, 0.1, -0.5], [0.4, 1.2, 0.2, 0.2], [0.1, 0.1, 1.0, 0.2], [-0.3, -0.1, -0.2, 1.2]])
FREQUENCIES = (1.0, math.sqrt(7.0))
# mu = nu^2 and mu = 1 - nu
MEETING = (-1.0 + math.sqrt(5.0)) / 2.0


def double_hopf():
    """Two oscillations with growth mu - nu^2 and mu + nu - 1 about an equilibrium that moves with mu."""
    back, way = np.linalg.inv(HYPERSPACE), np.array([0.3, -0.2, 0.5, 0.1])

    def f(u, p):
        z = back @ (u - p["mu"] * way)
        r1, r2 = z[0] ** 2 + z[1] ** 2, z[2] ** 2 + z[3] ** 2
        g1 = p["mu"] - p["nu"] ** 2 - r1 - 0.5 * r2
        g2 = p["mu"] + p["nu"] - 1.0 - 0.3 * r1 - r2
        (o1, o2) = FREQUENCIES
        return HYPERSPACE @ [g1 * z[0] - o1 * z[1], o1 * z[0] + g1 * z[1], g2 * z[2] - o2 * z[3], o2 * z[2] + g2 * z[3]]

    return mc.VectorField(f, np.zeros(4), {"mu": 0.0, "nu": 0.2})


@cache
def double_hopf_branch():
    return mc.continue_equilibria(double_hopf(), "mu", bounds=(-1.0, 1.5))


@pytest.mark.parametrize("label", ["HB1", "HB2"])
def test_a_double_hopf_point_is_found_on_both_hopf_curves_and_nothing_else(label):
    locus = mc.continue_special(double_hopf_branch().point(label), "nu", bounds=(0.0, 1.0))
    (point,) = locus.special_points
    assert point.kind == "HH"
    assert [point["mu"], point["nu"]] == pytest.approx([1.0 - MEETING, MEETING], rel=1e-8)


@pytest.mark.parametrize(("label", "own", "other"), [("HB1", 0, 1), ("HB2", 1, 0)])
def test_a_double_hopf_point_states_both_frequencies(label, own, other):
    locus = mc.continue_special(double_hopf_branch().point(label), "nu", bounds=(0.0, 1.0))
    coefficients = only(locus, "HH").coefficients
    assert coefficients["omega"] == pytest.approx(FREQUENCIES[own], rel=1e-8)
    assert coefficients["omega2"] == pytest.approx(FREQUENCIES[other], rel=1e-8)


def test_double_hopf_coefficients_are_those_of_the_normal_form():
    locus = mc.continue_special(double_hopf_branch().point("HB1"), "nu", bounds=(0.0, 1.0))
    coefficients = only(locus, "HH").coefficients
    assert coefficients["theta"] == pytest.approx(0.5, rel=1e-6)
    assert coefficients["delta"] == pytest.approx(0.3, rel=1e-6)


@pytest.mark.parametrize(("label", "growth"), [("HB1", lambda m, n: m - n**2), ("HB2", lambda m, n: m + n - 1.0)])
def test_hopf_curves_that_cross_each_other_are_followed_through_the_crossing(label, growth):
    locus = mc.continue_special(double_hopf_branch().point(label), "nu", bounds=(0.0, 1.0), lyapunov=False)
    assert growth(locus["mu"], locus["nu"]) == pytest.approx(0.0 * locus["mu"], abs=1e-8)


# -- folds of the overcentre mechanism in (F, k_j) ----------------------------------------------------------------


@pytest.fixture(scope="session")
def overcentre_folds(overcentre_branch):
    """Return a function: a fold of the overcentre at k_j = 1e6, followed down to 8 N/m and up to 1e8."""

    @cache
    def folds(which, mark=1000.0):
        point = overcentre_branch(k_j=1e6).point(FOLD_LABELS[which])
        return mc.continue_special(point, "k_j", bounds=(8.0, 1e8), zeros={"k_j": mark})

    return folds


@pytest.mark.parametrize("which", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", [1000.0, 200.0, 100.0])
def test_a_fold_curve_of_the_overcentre_passes_the_reference(overcentre_folds, k_j, which):
    point = only(overcentre_folds(which, k_j), "UZ")
    force, angle = ELASTIC_FOLDS[k_j][which]
    assert point["k_j"] == pytest.approx(k_j, rel=1e-12)
    assert point["F"] == pytest.approx(force, rel=1e-8)
    assert math.degrees(point["theta_1"]) == pytest.approx(angle, abs=1e-7)


@pytest.mark.parametrize("which", [UPPER, LOWER])
def test_a_fold_curve_of_the_overcentre_ends_at_the_reference_for_8_newtons_per_metre(overcentre_folds, which):
    locus = overcentre_folds(which)
    end = 0 if locus["k_j"][0] < locus["k_j"][-1] else -1
    force, angle = ELASTIC_FOLDS[8.0][which]
    assert locus["k_j"][end] == pytest.approx(8.0, rel=1e-12)
    assert locus["F"][end] == pytest.approx(force, rel=1e-8)
    assert math.degrees(locus["theta_1"][end]) == pytest.approx(angle, abs=1e-7)


@pytest.mark.parametrize("which", [UPPER, LOWER])
def test_a_fold_curve_of_the_overcentre_has_no_cusp_and_reaches_both_bounds(overcentre_folds, which):
    locus = overcentre_folds(which)
    assert kinds(locus) == ["UZ"]
    assert sorted(locus["k_j"][[0, -1]]) == pytest.approx([8.0, 1e8], rel=1e-12)
    assert locus.status == "at bound"


@pytest.mark.parametrize("which", [UPPER, LOWER])
def test_a_fold_curve_of_the_overcentre_is_followed_over_seven_decades_in_little_more_than_a_hundred_points(
    overcentre_folds, which
):
    assert len(overcentre_folds(which)) < 110


# -- starts and ends ----------------------------------------------------------------------------------------------


def test_user_zeros_on_a_locus_are_located_to_1e_10():
    locus = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(15.0, 30.0), zeros={"u": 0.2})
    points = locus.of_kind("UZ")
    assert [p["u"] for p in points] == pytest.approx([0.2], rel=1e-10)
    assert [p["B"] for p in points] == pytest.approx([25.0], rel=1e-9)


@pytest.mark.parametrize("direction", [1, -1])
def test_a_locus_in_one_direction_first_moves_its_new_parameter_that_way(direction):
    point = branch_of_ab(18.0).point("LP1")
    locus = mc.continue_special(point, "B", bounds=(15.0, 22.0), direction=direction)
    away = locus["B"][locus.start_index + 1 :] if direction > 0 else locus["B"][: locus.start_index][::-1]
    assert locus["B"][locus.start_index] == pytest.approx(18.0, rel=1e-10)
    assert (away[0] - 18.0) * direction > 0


def test_a_locus_ends_at_a_kind_of_point_that_is_named():
    locus = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(8.0, 40.0), end_at=["CP"], direction=-1)
    assert locus.status == "at special point"
    assert kinds(locus) == ["CP"]


def test_a_locus_keeps_the_bounds_of_the_first_parameter_unless_others_are_given():
    point = branch_of_ab(18.0).point("LP1")
    assert mc.continue_special(point, "B", bounds=(17.0, 19.0)).free["D"] == (0.0, 0.6)
    wider = mc.continue_special(point, "B", bounds={"B": (17.0, 19.0), "D": (0.0, 1.0)})
    assert wider.free["D"] == (0.0, 1.0)


def test_the_same_locus_is_the_same_to_the_bit():
    once, again = (mc.continue_special(branch_of_ab(18.0).point("HB2"), "B", bounds=(10.0, 20.0)) for _ in range(2))
    assert np.array_equal(once.states, again.states)
    assert np.array_equal(once["D"], again["D"])
    assert [p.coefficients for p in once.special_points] == [p.coefficients for p in again.special_points]


def test_points_of_a_locus_do_not_depend_on_the_step():
    fine = mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds=(8.0, 40.0), ds_max=0.01)
    assert len(fine) > 1.5 * len(folds_of_ab())
    for a, b in zip(fine.special_points, folds_of_ab().special_points, strict=True):
        assert a.label == b.label
        assert [a["D"], a["B"]] == pytest.approx([b["D"], b["B"]], rel=1e-9)


# -- mistakes -----------------------------------------------------------------------------------------------------


@cache
def marked_ab():
    return mc.continue_equilibria(ab(18.0), "D", bounds=(0.0, 0.1), zeros={"u": 0.1})


def test_a_user_zero_has_no_curve_to_follow():
    with pytest.raises(mc.MjcontError, match=r"kind UZ has no curve to follow.*LP, HB, BP, CP, BT, ZH"):
        mc.continue_special(marked_ab().point("UZ1"), "B")


def test_a_parameter_that_is_free_already_cannot_be_freed():
    with pytest.raises(mc.ParameterError, match="D is already free on the curve of LP1"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "D")


def test_bounds_of_a_parameter_that_is_not_free_are_refused():
    bounds = {"B": (8.0, 40.0), "C": (0.0, 1.0)}
    with pytest.raises(mc.ParameterError, match=r"bounds are given for 'C', which is not free here\. Free: D, B"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds)


def test_bounds_that_exclude_the_special_point_are_refused():
    with pytest.raises(mc.BoundsError, match=r"LP1 has B = 18, outside the bounds 20 \.\. 30"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (20.0, 30.0))


@pytest.mark.parametrize("bounds", [(30.0, 10.0), (8.0, math.inf), (8.0, 8.0)])
def test_bounds_of_a_locus_that_are_no_increasing_finite_pair_are_refused(bounds):
    with pytest.raises(mc.BoundsError, match="bounds of B must be finite with low < high"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", bounds)


def test_an_unknown_parameter_of_a_locus_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown parameter 'b'.*B"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "b")


def test_an_unknown_option_of_a_locus_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown option 'dsmax'.*Did you mean ds_max"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (8.0, 40.0), dsmax=0.1)


def test_a_direction_of_a_locus_other_than_up_or_down_is_refused():
    with pytest.raises(mc.ParameterError, match=r"direction must be None, \+1 or -1, got 0"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (8.0, 40.0), direction=0)


def test_an_unknown_kind_to_end_at_is_refused():
    with pytest.raises(mc.MjcontError, match="XX"):
        mc.continue_special(branch_of_ab(18.0).point("LP1"), "B", (8.0, 40.0), end_at=["XX"])


def test_a_generalised_hopf_point_has_no_curve_to_follow():
    with pytest.raises(mc.MjcontError, match="kind GH has no curve to follow"):
        mc.continue_special(only(hopfs_of_ab(), "GH"), "B")


def test_special_points_stand_in_order_along_a_locus():
    rows = [p.index for p in folds_of_ab().special_points]
    assert all(a < b for a, b in itertools.pairwise(rows))
