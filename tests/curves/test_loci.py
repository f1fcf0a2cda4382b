"""Loci of special points in two and three parameters, and the points of higher codimension on them.

Closed forms where there are any; the generalised Hopf point of the AUTO demo ab was solved with 30 digits. Normal
forms: Kuznetsov, Elements of Applied Bifurcation Theory, 3rd ed., chapter 8.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from problems.fields import branch_of_brusselator, cusp
from problems.loci import folds_of_ab, hopfs_of_ab, kinds, only
from problems.locusfields import conic, pitchfork, tilted_cusp
from problems.marks import long
from problems.reference import ELASTIC_FOLDS

import mjcont as mc

UPPER, LOWER = 0, 1
FOLD_LABELS = {UPPER: "LP2", LOWER: "LP1"}


# -- folds of ab in (D, B) ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_fold_curve_of_ab_has_one_cusp_and_one_bogdanov_takens_point_and_nothing_else():
    assert sorted(kinds(folds_of_ab())) == ["BT", "CP"]


@pytest.mark.slow
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


@pytest.mark.slow
def test_the_fold_curve_of_ab_is_the_same_from_its_other_fold():
    for kind in ("CP", "BT"):
        one, other = only(folds_of_ab("LP1"), kind), only(folds_of_ab("LP2"), kind)
        assert [one["D"], one["B"]] == pytest.approx([other["D"], other["B"]], rel=1e-10)


def test_points_of_a_fold_curve_say_how_well_they_are_located():
    assert [p.converged for p in folds_of_ab().special_points] == [True, True]
    assert max(p.tolerance for p in folds_of_ab().special_points) < 1e-8


# -- Hopf points of ab in (D, B) ------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_hopf_curve_of_ab_has_one_bogdanov_takens_and_one_generalised_hopf_point_and_nothing_else():
    assert sorted(kinds(hopfs_of_ab())) == ["BT", "GH"]


@pytest.mark.slow
def test_the_bogdanov_takens_point_on_the_hopf_curve_is_that_on_the_fold_curve():
    point = only(hopfs_of_ab(), "BT")
    found = [point["u"], point["B"], point["D"]]
    assert found == pytest.approx([0.25, 64.0 / 3.0, math.exp(-4.0 / 3.0) / 3.0], rel=1e-8)


@pytest.mark.slow
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


@pytest.mark.slow
def test_the_hopf_curve_of_ab_goes_on_into_neutral_saddles_when_asked():
    locus = hopfs_of_ab(end_at=())
    assert [word for word, _ in locus.ends] == ["at bound", "at bound"]
    assert sorted(kinds(locus)) == ["BT", "GH"]
    beyond = locus["u"] < 0.25 - 1e-6
    assert beyond.any()
    # there two real eigenvalues have sum zero
    assert np.abs(locus.eigenvalues[beyond].imag).max() == 0.0
    assert np.abs(locus.eigenvalues[beyond].sum(axis=1)).max() < 1e-7


@pytest.mark.long
def test_the_hopf_curve_of_ab_is_the_same_from_its_other_hopf_point():
    for kind in ("BT", "GH"):
        one, other = only(hopfs_of_ab("HB1"), kind), only(hopfs_of_ab("HB2"), kind)
        assert [one["D"], one["B"]] == pytest.approx([other["D"], other["B"]], rel=1e-8)


@pytest.mark.long
def test_the_hopf_curve_of_ab_takes_as_many_points_whichever_hopf_point_it_starts_from():
    # omega is ten times larger at the second
    assert len(hopfs_of_ab("HB1")) < 2 * len(hopfs_of_ab("HB2"))


@pytest.mark.slow
def test_the_hopf_curve_of_ab_reaches_its_bound_where_D_is_a_3000th_of_its_range():
    locus = hopfs_of_ab(high=50.0, direction=1, lyapunov=False)
    assert locus.status == "at bound", locus.message
    u, B = locus["u"], locus["B"]
    assert -1.0 / (1.0 - u) + B * u - 4.0 == pytest.approx(0.0 * u, abs=1e-8)


@pytest.mark.slow
def test_no_generalised_hopf_point_is_sought_when_l1_is_not_wanted():
    assert kinds(hopfs_of_ab(lyapunov=False)) == ["BT"]


@pytest.mark.slow
def test_the_hopf_curve_of_the_brusselator_is_1_plus_A_squared():
    locus = mc.continue_special(branch_of_brusselator().point("HB1"), "A", bounds=(0.2, 3.0))
    assert locus["B"] == pytest.approx(1.0 + locus["A"] ** 2, abs=1e-8)
    assert locus.special_points == ()
    assert locus.status == "at bound"


# -- cusps ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_fold_curve_of_the_cusp_normal_form_is_its_semicubical_parabola():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0))
    locus = mc.continue_special(branch.point("LP1"), "la", bounds=(-1.0, 2.0))
    assert 27.0 * locus["mu"] ** 2 == pytest.approx(4.0 * locus["la"] ** 3, abs=1e-8)
    assert kinds(locus) == ["CP"]
    assert [only(locus, "CP")[name] for name in ("mu", "la", "x")] == pytest.approx([0.0, 0.0, 0.0], abs=1e-8)


@cache
def curve_of_cusps():
    branch = mc.continue_equilibria(tilted_cusp(), "mu", bounds=(-2.0, 2.0))
    folds = mc.continue_special(branch.point("LP1"), "la", bounds=(-2.0, 2.0))
    return mc.continue_special(only(folds, "CP"), "e", bounds=(-2.0, 2.0))


@pytest.mark.slow
def test_cusps_in_three_parameters_follow_their_closed_form():
    locus = curve_of_cusps()
    assert locus["x"] == pytest.approx(locus["e"] / 3.0, abs=1e-8)
    assert locus["la"] == pytest.approx(-locus["e"] ** 2 / 3.0, abs=1e-8)
    assert locus["mu"] == pytest.approx(locus["e"] ** 3 / 27.0, abs=1e-8)


def test_cusps_in_three_parameters_are_followed_from_bound_to_bound():
    assert curve_of_cusps().kind == "CP locus"
    assert curve_of_cusps()["e"][[0, -1]] == pytest.approx([-2.0, 2.0], abs=1e-12)


# -- Bogdanov-Takens and zero-Hopf points in three parameters --------------------------------------------------------


@pytest.mark.slow
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


@pytest.mark.slow
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


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["isola centre", "crossing"])
def test_a_fold_curve_has_a_branch_point_where_its_first_parameter_does_not_move_the_equation(sign):
    branch = mc.continue_equilibria(conic(sign), "la", bounds=(-2.0, 2.0))
    locus = mc.continue_special(branch.point("LP1"), "mu", bounds=(-1.5, 1.5))
    (point,) = locus.special_points
    assert point.kind == "BP"
    assert [point["la"], point["mu"], point["x"]] == pytest.approx([0.0, 0.0, 0.0], abs=1e-8)
    assert "turns without a cusp" in point.note


@pytest.mark.slow
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


@pytest.mark.slow
def test_the_branch_point_of_the_pendulum_persists_in_the_stiffness_of_its_spring(pendulum):
    locus = mc.continue_special(upright(pendulum).point("BP1"), "k", bounds=(0.5, 1.5))
    assert locus["load_factor"] * 9.81 == pytest.approx(locus["k"], rel=1e-8)
    assert locus["k"][[0, -1]] == pytest.approx([0.5, 1.5], rel=1e-12)
    assert locus.status == "at bound"


@pytest.mark.slow
def test_the_branch_point_of_the_pendulum_does_not_persist_when_its_spring_is_turned(pendulum):
    locus = mc.continue_special(upright(pendulum).point("BP1"), "rest", bounds=(-0.3, 0.3))
    assert locus.status == "stopped"
    assert "does not persist" in locus.message
    assert np.abs(locus["rest"]).max() < 1e-3


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


# -- folds of the overcentre mechanism in (F, k_j) ----------------------------------------------------------------


@pytest.fixture(scope="session")
def overcentre_folds(overcentre_branch):
    """Return a function: a fold of the overcentre at k_j = 1e6, followed down to 8 N/m and up to 1e8."""

    @cache
    def folds(which, mark=1000.0):
        point = overcentre_branch(k_j=1e6).point(FOLD_LABELS[which])
        return mc.continue_special(point, "k_j", bounds=(8.0, 1e8), zeros={"k_j": mark})

    return folds


@pytest.mark.slow
@pytest.mark.parametrize("which", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", [1000.0, long(200.0), 100.0])
def test_a_fold_curve_of_the_overcentre_passes_the_reference(overcentre_folds, k_j, which):
    point = only(overcentre_folds(which, k_j), "UZ")
    force, angle = ELASTIC_FOLDS[k_j][which]
    assert point["k_j"] == pytest.approx(k_j, rel=1e-12)
    assert point["F"] == pytest.approx(force, rel=1e-8)
    assert math.degrees(point["theta_1"]) == pytest.approx(angle, abs=1e-7)


@pytest.mark.slow
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
