"""How a curve is followed: no jumps, every special point once, an ending with a sentence, and at what cost.

The curves are known in closed form. "Default step" is ds_max of `mjcont.Settings`.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.curves import labels, scalar
from problems.fields import ab, branch_of_ab, branch_of_cusp, cusp
from problems.folding import circle, circle_branch, hyperbolas, imperfect, neutral_saddle, twin_waves, two_oscillations

import mjcont as mc

# -- closed curves --------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("radius", [1.0, 0.1, 1e-3])
def test_an_isola_closes_on_itself_and_says_so(radius):
    branch = circle_branch(radius)
    assert branch.status == "closed"
    assert branch.message == "the curve closes on itself"


@pytest.mark.slow
@pytest.mark.parametrize("radius", [1.0, 0.1, 1e-3])
def test_an_isola_is_followed_exactly_once(radius):
    branch = circle_branch(radius)
    turning = np.unwrap(np.arctan2(branch["x"], branch["la"]))
    assert abs(turning[-1] - turning[0]) == pytest.approx(2.0 * math.pi, abs=1e-9)
    assert abs(np.sum(np.sign(np.diff(turning)))) == len(branch) - 1


@pytest.mark.slow
@pytest.mark.parametrize("radius", [1.0, 0.1, 1e-3])
def test_an_isola_has_its_two_folds_and_nothing_else(radius):
    found = [(p.kind, p["la"]) for p in circle_branch(radius).special_points]
    assert [kind for kind, _ in found] == ["LP", "LP"]
    assert sorted(la for _, la in found) == pytest.approx([-radius, radius], rel=1e-10)


def test_an_isola_cut_by_its_bounds_is_not_closed():
    branch = mc.continue_equilibria(circle(), "la", bounds=(-0.5, 0.5))
    assert branch.status == "at bound"
    assert branch["la"][[0, -1]] == pytest.approx([-0.5, 0.5], abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("label", ["LP1", "LP2"])
def test_an_isola_entered_at_a_fold_closes_with_both_folds(label):
    branch = circle_branch(start=circle_branch().point(label))
    assert branch.status == "closed"
    assert labels(branch) == ["LP1", "LP2"]


@pytest.mark.slow
@pytest.mark.parametrize("label", ["LP1", "LP2"])
def test_a_fold_at_which_an_isola_begins_and_closes_is_marginal_in_each_of_its_rows(label):
    branch = circle_branch(1e-3, start=circle_branch(1e-3).point(label))
    assert [branch.stability[i] for i in (0, -1)] == ["marginal", "marginal"]
    assert not branch.notes


# -- no jumps -------------------------------------------------------------------------------------------------

GAPS = [0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3]


@pytest.mark.parametrize("gap", GAPS)
def test_upper_and_lower_hyperbolas_are_not_jumped_between(gap):
    branch = mc.continue_equilibria(hyperbolas(gap, 1.0), "la", bounds=(-1.0, 1.0))
    assert branch["x"] == pytest.approx(np.sqrt(branch["la"] ** 2 + gap**2), abs=1e-9)
    assert branch["la"][[0, -1]] == pytest.approx([-1.0, 1.0], abs=1e-12)
    assert labels(branch) == []


@pytest.mark.parametrize("gap", GAPS)
def test_left_and_right_hyperbolas_are_not_jumped_between(gap):
    branch = mc.continue_equilibria(hyperbolas(gap, -1.0), "la", bounds=(-1.0, 1.0))
    assert branch["la"] == pytest.approx(-np.sqrt(branch["x"] ** 2 + gap**2), abs=1e-9)
    assert branch["la"][[0, -1]] == pytest.approx([-1.0, -1.0], abs=1e-12)
    assert [(p.kind, p["la"]) for p in branch.special_points] == [("LP", pytest.approx(-gap, rel=1e-10))]


IMPERFECTIONS = [0.1, 0.01, 1e-3, -1e-3]


@pytest.mark.parametrize("eps", IMPERFECTIONS)
def test_the_connected_branch_of_an_imperfect_pitchfork_is_followed_round_its_bend(eps):
    branch = mc.continue_equilibria(imperfect(eps), "mu", bounds=(-1.0, 1.0))
    assert branch["mu"] == pytest.approx(branch["x"] ** 2 - eps / branch["x"], abs=1e-8)
    assert np.all(branch["x"] * eps > 0.0)
    assert branch["mu"][[0, -1]] == pytest.approx([-1.0, 1.0], abs=1e-12)
    assert labels(branch) == []


@pytest.mark.parametrize("eps", IMPERFECTIONS)
def test_the_separate_branch_of_an_imperfect_pitchfork_has_its_one_fold(eps):
    start, state = {"mu": 1.0}, [-math.copysign(1.0, eps)]
    branch = mc.continue_equilibria(imperfect(eps), "mu", bounds=(-1.0, 1.0), start=start, state=state)
    assert np.all(branch["x"] * eps < 0.0)
    assert branch["mu"][[0, -1]] == pytest.approx([1.0, 1.0], abs=1e-12)
    ((kind, mu),) = [(p.kind, p["mu"]) for p in branch.special_points]
    assert kind == "LP"
    assert mu == pytest.approx(3.0 * (abs(eps) / 2.0) ** (2.0 / 3.0), rel=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("gap", [0.3, 0.03, 1e-3, *(pytest.param(g, marks=pytest.mark.long) for g in (0.1, 0.01))])
@pytest.mark.parametrize("upper", [False, True], ids=["lower", "upper"])
def test_curves_side_by_side_are_not_jumped_between(gap, upper):
    shift = gap if upper else 0.0
    branch = mc.continue_equilibria(twin_waves(gap), "t", bounds=(-1.0, 1.0), state=[shift])
    assert branch["x"] == pytest.approx(np.sin(5.0 * branch["t"]) + shift, abs=0.1 * gap)
    assert branch["t"][[0, -1]] == pytest.approx([-1.0, 1.0], abs=1e-12)
    assert labels(branch) == []


# -- every special point once ---------------------------------------------------------------------------------


@pytest.mark.parametrize("ds_max", [0.1, 0.05, 0.02])
@pytest.mark.parametrize("B", [18.0, 14.0])
def test_labels_and_special_points_do_not_change_with_the_step(B, ds_max):
    branch = mc.continue_equilibria(ab(B), "D", bounds=(0.0, 0.6), ds_max=ds_max)
    assert labels(branch) == labels(branch_of_ab(B))
    expected = [p["D"] for p in branch_of_ab(B).special_points]
    assert [p["D"] for p in branch.special_points] == pytest.approx(expected, rel=1e-10)


@pytest.mark.slow
def test_a_larger_step_takes_fewer_points():
    sizes = [len(mc.continue_equilibria(ab(18.0), "D", bounds=(0.0, 0.6), ds_max=d)) for d in (0.1, 0.05, 0.02)]
    assert sizes == sorted(sizes)
    assert sizes[-1] > 1.5 * sizes[0]


@pytest.mark.parametrize("la", [0.1, 1e-2, 1e-3, 10**-3.25, 1e-4, 1e-5, 10**-5.25, 1e-6])
def test_two_folds_within_one_default_step_are_both_found_once(la):
    field = scalar(lambda x, p: p["mu"] + la * x - x**3, -1.0, mu=-1.0)
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0))
    assert [p.kind for p in branch.special_points] == ["LP", "LP"]
    root = math.sqrt(la / 3.0)
    assert [p["x"] for p in branch.special_points] == pytest.approx([-root, root], rel=1e-8)


@pytest.mark.parametrize("unit", [1.0, 1e-6, 1e6])
def test_the_unit_of_a_parameter_does_not_matter(unit):
    # folds where exp(3 m) - 2 is an extremum of x^3 - x
    field = scalar(lambda x, p: math.exp(3.0 * p["m"] / unit) - 2.0 - x**3 + x, -1.3, m=0.0)
    branch = mc.continue_equilibria(field, "m", bounds=(0.0, unit), max_points=200)
    extremum = 2.0 / (3.0 * math.sqrt(3.0))
    expected = [unit * math.log(2.0 + e) / 3.0 for e in (extremum, -extremum)]
    assert [p["m"] for p in branch.special_points] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("la", [0.0, -1e-6, -1e-3])
def test_no_fold_is_reported_where_a_curve_comes_close_to_one(la):
    field = scalar(lambda x, p: p["mu"] + la * x - x**3 - 1e-7 * x, -1.0, mu=-1.0)
    assert labels(mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0))) == []


@pytest.mark.parametrize("at", [0.0, 0.111, -0.5])
@pytest.mark.parametrize("apart", [1e-2, 1e-4])
def test_two_hopf_points_of_different_modes_close_together_are_both_found_once(apart, at):
    branch = mc.continue_equilibria(two_oscillations(apart, at), "mu", bounds=(-1.0, 1.0))
    points = branch.special_points
    assert [p.kind for p in points] == ["HB", "HB"]
    assert [p["mu"] for p in points] == pytest.approx([at, at + apart], abs=1e-10)
    assert [p.coefficients["omega"] for p in points] == pytest.approx([1.0, 2.0], rel=1e-8)


@pytest.mark.parametrize("apart", [0.2, 0.05, 0.02])
def test_a_mode_that_loses_its_damping_and_gains_it_back_has_two_hopf_points(apart):
    def f(u, p):
        growth = 100.0 * (p["mu"] - 0.3) * (0.3 + apart - p["mu"]) - u[0] ** 2 - u[1] ** 2
        return [growth * u[0] - u[1], u[0] + growth * u[1]]

    branch = mc.continue_equilibria(mc.VectorField(f, [0.0, 0.0], {"mu": -1.0}), "mu", bounds=(-1.0, 1.0))
    assert [p.kind for p in branch.special_points] == ["HB", "HB"]
    assert [p["mu"] for p in branch.special_points] == pytest.approx([0.3, 0.3 + apart], abs=1e-9)


def test_a_neutral_saddle_is_no_hopf_point():
    branch = mc.continue_equilibria(neutral_saddle(), "mu", bounds=(0.2, 3.0))
    assert labels(branch) == []


def test_a_neutral_saddle_is_listed_with_its_parameter():
    branch = mc.continue_equilibria(neutral_saddle(), "mu", bounds=(0.2, 3.0))
    assert branch.neutral_saddles == [{"mu": pytest.approx(1.0, rel=1e-9)}]


@pytest.mark.parametrize("apart", [0.3, 0.01])
def test_a_hopf_point_beside_a_neutral_saddle_is_found(apart):
    def f(u, p):
        growth = p["mu"] - 1.0 - apart
        return [u[0], -p["mu"] * u[1], growth * u[2] - 3.0 * u[3], 3.0 * u[2] + growth * u[3]]

    branch = mc.continue_equilibria(mc.VectorField(f, np.zeros(4), {"mu": 0.2}), "mu", bounds=(0.2, 3.0))
    assert [(p.kind, p["mu"]) for p in branch.special_points] == [("HB", pytest.approx(1.0 + apart, rel=1e-9))]
    assert branch.neutral_saddles == [{"mu": pytest.approx(1.0, rel=1e-9)}]


# -- user zeros -----------------------------------------------------------------------------------------------


def marked_cusp(**zeros):
    field = cusp()
    field.observe("area", lambda u, p: u[0] ** 2 * p["mu"])
    field.observe("pole", lambda u, p: 1.0 / (u[0] - 0.123))
    return mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0), zeros=zeros)


def test_zeros_of_a_state_are_located_to_1e_10():
    (point,) = marked_cusp(x=0.25).of_kind("UZ")
    assert point["x"] == pytest.approx(0.25, abs=1e-10)
    assert point["mu"] == pytest.approx(0.25**3 - 0.25, abs=1e-10)


def test_zeros_of_a_parameter_are_located_on_every_passage_to_1e_10():
    points = marked_cusp(mu=0.1).of_kind("UZ")
    assert [p["mu"] for p in points] == pytest.approx([0.1, 0.1, 0.1], abs=1e-10)
    roots = sorted(np.roots([-1.0, 0.0, 1.0, 0.1]).real)
    assert [p["x"] for p in points] == pytest.approx(roots, abs=1e-10)


def test_zeros_of_an_observable_are_located_to_1e_10():
    (point,) = marked_cusp(area=-0.2).of_kind("UZ")
    assert point["area"] == pytest.approx(-0.2, abs=1e-10)
    assert point["x"] ** 2 * (point["x"] ** 3 - point["x"]) == pytest.approx(-0.2, abs=1e-9)


def test_a_column_may_have_several_values_to_be_located_at():
    points = marked_cusp(x=(-0.5, 0.25, 0.5)).of_kind("UZ")
    assert sorted(p["x"] for p in points) == pytest.approx([-0.5, 0.25, 0.5], abs=1e-10)


def test_zeros_exactly_at_zero_are_found():
    points = marked_cusp(x=0.0).of_kind("UZ")
    assert [p["x"] for p in points] == pytest.approx([0.0], abs=1e-10)


def test_a_pole_is_no_zero():
    assert labels(marked_cusp(pole=0.0)) == labels(branch_of_cusp())


def test_a_user_zero_says_what_vanishes():
    (point,) = marked_cusp(x=0.25).of_kind("UZ")
    assert point.coefficients["monitor"] == "x = 0.25"


# -- starts ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("offset", [1e-12, 1e-6, 1e-3, 0.1, 0.5, -0.5])
def test_a_start_beside_the_branch_is_corrected_to_it(offset):
    field = cusp()
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0), state=field.u0 + offset)
    assert branch["mu"] == pytest.approx(branch["x"] ** 3 - branch["x"], abs=1e-10)
    assert labels(branch) == ["LP1", "LP2"]


def test_the_start_keeps_the_value_of_the_parameter_that_was_given():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), start={"mu": -0.7})
    assert branch["mu"][branch.start_index] == -0.7


def test_a_start_exactly_on_a_bound_adds_no_point_twice():
    branch = branch_of_ab(18.0)
    steps = np.abs(np.diff(branch["D"])) + np.abs(np.diff(branch["u"])) + np.abs(np.diff(branch["v"]))
    assert steps.min() > 0.0


@pytest.mark.parametrize("label", ["HB1", "LP1", "LP2", "HB2"])
def test_a_start_at_a_special_point_gives_the_same_branch(label):
    branch = mc.continue_equilibria(ab(18.0), "D", bounds=(0.0, 0.6), start=branch_of_ab(18.0).point(label))
    assert labels(branch) == labels(branch_of_ab(18.0))


@pytest.mark.parametrize("direction", [1, -1])
def test_one_direction_first_moves_the_parameter_that_way(direction):
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-2.0, 2.0), direction=direction)
    row = branch.start_index
    assert row == (0 if direction > 0 else len(branch) - 1)
    assert (branch["mu"][row + direction] - branch["mu"][row]) * direction > 0.0
