"""How a curve ends: always with a sentence, reproducibly, and at what cost."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from problems.curves import scalar
from problems.fields import ab, branch_of_cusp, brusselator, cusp

import mjcont as mc

# -- endings --------------------------------------------------------------------------------------------------


def test_a_curve_ends_exactly_at_its_bounds():
    branch = branch_of_cusp()
    assert list(branch["mu"][[0, -1]]) == [-1.0, 1.0]
    assert branch.ends == [("at bound", "mu reached its bound -1"), ("at bound", "mu reached its bound 1")]


def test_a_curve_of_many_points_ends_at_its_limit():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), max_points=7, direction=1)
    assert len(branch) == 7
    assert branch.ends == [("max points", "the limit of 7 points was reached")]


def test_a_long_curve_ends_at_its_limit():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), max_arclength=0.5, direction=1)
    assert branch.status == "max arclength"
    assert branch.message == "the limit of 0.5 in arclength was reached"


def test_a_slow_curve_ends_at_its_limit():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), max_seconds=0.0, direction=1)
    assert branch.ends == [("max time", "the limit of 0 s was reached")]


def test_a_curve_ends_where_the_user_says_with_his_sentence():
    def stop(point):
        return "x has become positive" if point["x"] > 0.0 else None

    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), stop=stop)
    assert branch.ends[1] == ("stopped", "x has become positive")
    assert branch["x"][-1] > 0.0 > branch["x"][-2]


def test_a_curve_ends_where_a_limit_of_an_observable_is_left():
    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), limits={"x": (-2.0, 0.5)})
    word, sentence = branch.ends[1]
    assert word == "stopped"
    assert "left its limits -2 .. 0.5" in sentence
    assert branch["x"][-1] > 0.5 >= branch["x"][-2]


@pytest.mark.slow
def test_a_curve_that_runs_to_infinity_ends_with_a_sentence():
    field = scalar(lambda x, p: 1.0 - p["mu"] * x, 1.0, mu=1.0)
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 2.0), max_size=20.0)
    assert branch.ends[0] == ("runs off", "a state coordinate exceeds 20 times its scale (max_size)")
    assert branch["mu"] * branch["x"] == pytest.approx(np.ones(len(branch)), abs=1e-9)


def test_a_curve_with_a_corner_ends_there_and_says_why():
    field = scalar(lambda x, p: p["mu"] - abs(x) - 0.5 * x, 2.0 / 3.0, mu=1.0)
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.5))
    word, sentence = branch.ends[0]
    assert word == "step too small"
    assert sentence.startswith("step below ds_min at mu = ")
    assert branch["mu"][0] == pytest.approx(0.0, abs=1e-4)


def test_a_curve_that_leaves_where_its_equations_are_defined_ends_there_and_says_why():
    field = scalar(lambda x, p: (math.nan if p["mu"] < 0.2 else p["mu"]) - x, 0.5, mu=0.5)
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0))
    word, sentence = branch.ends[0]
    assert word == "step too small"
    assert sentence.startswith("step below ds_min at mu = 0.20")
    assert branch["mu"][0] == pytest.approx(0.2, abs=1e-3)


def test_a_larger_ds_min_ends_a_difficult_curve_sooner():
    field = scalar(lambda x, p: p["mu"] - abs(x) - 0.5 * x, 2.0 / 3.0, mu=1.0)
    rough, fine = (mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.5), ds_min=d) for d in (5e-3, 1e-9))
    assert rough.status == "step too small"
    assert rough["mu"][0] > fine["mu"][0]


def test_an_interrupted_curve_keeps_its_points_and_says_so():
    def interrupt(count, special):
        if count == 5:
            raise KeyboardInterrupt

    branch = mc.continue_equilibria(cusp(), "mu", bounds=(-1.0, 1.0), progress=interrupt, direction=1)
    assert branch.interrupted
    assert 4 <= len(branch) <= 6
    assert "stopped by the user" in branch.message


# -- reproducibility and cost ---------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("problem", "name", "bounds"),
    [(ab(18.0), "D", (0.0, 0.6)), (brusselator(), "B", (0.5, 8.0)), (cusp(), "mu", (-1.0, 1.0))],
    ids=["ab", "brusselator", "cusp"],
)
def test_the_same_input_gives_the_same_output_to_the_bit(problem, name, bounds):
    once, again = (mc.continue_equilibria(problem, name, bounds=bounds) for _ in range(2))
    assert np.array_equal(once.states, again.states)
    assert np.array_equal(once[name], again[name])
    assert np.array_equal(once.eigenvalues, again.eigenvalues)
    assert [p.coefficients for p in once.special_points] == [p.coefficients for p in again.special_points]


@cache
def cost(name):
    """Return evaluations of f in a whole branch, and its number of points."""
    if name == "overcentre":
        problem, parameter, bounds, start = mc.Mechanism.from_xml("overcentre"), "F", (-50.0, 60.0), {"F": 50.0}
    elif name == "ab":
        problem, parameter, bounds, start = ab(18.0), "D", (0.0, 0.6), None
    else:
        problem, parameter, bounds, start = brusselator(), "B", (0.5, 8.0), None
    branch = mc.continue_equilibria(problem, parameter, bounds=bounds, start=start)
    return problem.evaluations, len(branch)


# evaluations in all, and per point: 15 % above the median of what five kernels of OpenBLAS cost when they were set; the
# places where a brusselator's eigenvalues might stray between points (`Balance`) are 14 % of its own, 2,465 in all.
# Rounding decides how many Newton steps a special point takes at the noise floor, 117 evaluations each for a Hopf point
# of `ab` (from 3,890 to 4,475 in all).
CEILINGS = {"ab": (4866, 44.2), "brusselator": (2835, 34.2), "overcentre": (4050, 4.81)}


@pytest.mark.slow
@pytest.mark.parametrize("name", CEILINGS)
def test_a_branch_costs_no_more_evaluations_than_its_ceiling(name):
    assert cost(name)[0] <= CEILINGS[name][0]


@pytest.mark.parametrize("name", CEILINGS)
def test_a_point_costs_no_more_evaluations_than_its_ceiling(name):
    evaluations, points = cost(name)
    assert evaluations / points <= CEILINGS[name][1]


# -- mistakes -------------------------------------------------------------------------------------------------


def follow_cusp(**arguments):
    return mc.continue_equilibria(cusp(), "mu", **{"bounds": (-1.0, 1.0), **arguments})


@pytest.mark.parametrize("direction", [0, 2, -3])
def test_a_direction_other_than_up_or_down_is_refused(direction):
    with pytest.raises(mc.ParameterError, match=rf"direction must be None, \+1 or -1, got {direction}"):
        follow_cusp(direction=direction)


def test_an_unknown_option_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown option 'dsmax'.*Did you mean ds_max.*max_points"):
        follow_cusp(dsmax=0.1)


def test_an_unknown_parameter_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown parameter 'nu'.*Valid: la, mu"):
        mc.continue_equilibria(cusp(), "nu", bounds=(-1.0, 1.0))


def test_an_unknown_start_parameter_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown parameter 'nu'.*Valid: la, mu"):
        follow_cusp(start={"nu": 1.0})


def test_an_unknown_column_of_zeros_is_named_with_those_that_exist():
    with pytest.raises(mc.NameLookupError, match=r"unknown observable 'y'.*Valid: x"):
        follow_cusp(zeros={"y": 0.0})


@pytest.mark.parametrize("bounds", [(1.0, -1.0), (0.0, math.inf), (math.nan, 1.0)])
def test_bounds_that_are_no_increasing_finite_pair_are_refused(bounds):
    with pytest.raises(mc.BoundsError, match="bounds of mu must be finite with low < high"):
        follow_cusp(bounds=bounds)


@pytest.mark.parametrize("bounds", [1.0, (1.0,), ("low", "high")])
def test_bounds_that_are_no_pair_of_numbers_are_refused(bounds):
    with pytest.raises(mc.BoundsError, match=r"bounds of mu must be two numbers \(low, high\)"):
        follow_cusp(bounds=bounds)


def test_bounds_that_exclude_the_start_are_refused():
    with pytest.raises(mc.BoundsError, match=r"the start has mu = -1, outside the bounds 0 \.\. 1"):
        follow_cusp(bounds=(0.0, 1.0))


def test_a_start_that_is_neither_values_nor_a_point_is_refused():
    with pytest.raises(mc.ParameterError, match="start must be a dict or a Point, got the float 0.5"):
        follow_cusp(start=0.5)


def test_a_state_of_the_wrong_size_is_refused():
    with pytest.raises(mc.ParameterError, match=r"state must have shape \(1,\), got \(2,\)"):
        follow_cusp(state=[0.0, 0.0])


def test_a_start_without_an_equilibrium_is_an_error_that_says_where_it_looked():
    field = scalar(lambda x, p: 1.0 + p["mu"] ** 2 + x**2, 0.0, mu=0.0)
    with pytest.raises(mc.StartError, match="no equilibrium found from u0"):
        mc.continue_equilibria(field, "mu", bounds=(-1.0, 1.0))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"ds_min": 0.1, "ds": 0.01}, "0 < ds_min <= ds <= ds_max"),
        ({"ds": 1.0}, "0 < ds_min <= ds <= ds_max"),
        ({"angle": 1.0}, "angles must satisfy 0 < angle < angle_max"),
        ({"max_points": 1}, "max_points and max_corrections must be at least 2"),
        ({"max_points": math.inf}, "max_points must be finite"),
        ({"max_seconds": -1.0}, "max_seconds and max_arclength not negative, got 5000, -1 and inf"),
    ],
)
def test_settings_that_contradict_each_other_are_refused(options, message):
    with pytest.raises(mc.ParameterError, match=message):
        follow_cusp(**options)


@pytest.mark.parametrize("root", [math.sqrt, np.sqrt], ids=["math", "numpy"])
def test_a_curve_that_meets_the_edge_of_its_function_ends_there_and_keeps_what_came_before(root):
    field = mc.VectorField(lambda u, p: [root(1.0 - p["mu"]) - u[0]], [1.0], {"mu": 0.0})
    branch = mc.continue_equilibria(field, "mu", bounds=(-1.0, 2.0))
    word, sentence = branch.ends[-1]
    assert word == "step too small"
    assert "f is not finite there" in sentence
    assert 0.9 < branch["mu"].max() < 1.0
