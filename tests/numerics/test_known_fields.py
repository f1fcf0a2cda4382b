"""Nothing missed, nothing false: fields whose special points and stability are known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.fields import ab
from problems.knownfields import run
from problems.marks import long

import mjcont as mc

SHORT, ALL, BLOCK = 12, 600, 20


def go(seeds):
    wrong = {}
    for seed in seeds:
        print(f"seed {seed}")
        wrong |= {seed: found} if (found := run(seed)) else {}
    assert wrong == {}


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, SHORT, 4))
def test_random_fields_have_the_points_and_the_stability_that_they_are_known_to_have(first):
    go(range(first, first + 4))


@pytest.mark.fuzz
@pytest.mark.parametrize("first", range(0, ALL, BLOCK))
def test_many_random_fields_have_the_points_and_the_stability_that_they_are_known_to_have(first):
    go(range(first, first + BLOCK))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [84, 530, 531])
def test_points_beside_each_other_are_told_apart_or_as_one_wherever_a_step_ends(seed):
    """Branch points 3e-5 apart; two in one place, and two Hopf points, where a step ends within rounding of them."""
    assert run(seed) == []


# -- two points within one step ---------------------------------------------------------------------------------


def crossings(first, second, sign):
    """Return a field of two pitchforks, at p = first and second; at the second stability is gained for sign < 0."""

    def f(u, p):
        return [(p["p"] - first) * u[0] - u[0] ** 3, sign * (p["p"] - second) * u[1] - u[1] ** 3]

    return mc.VectorField(f, [0.0, 0.0], {"p": -0.93})


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("gap", [0.02, 1e-3, 1e-6])
def test_two_branch_points_within_a_step_are_both_found_whatever_their_directions(gap, sign):
    branch = mc.continue_equilibria(crossings(0.011, 0.011 + gap, sign), "p", bounds=(-1.0, 1.0))
    assert [(p.kind, p.converged) for p in branch.special_points] == [("BP", True), ("BP", True)]
    assert [p["p"] for p in branch.special_points] == pytest.approx([0.011, 0.011 + gap], abs=1e-3 * gap)


@pytest.mark.parametrize("sign", [1, -1])
def test_two_branch_points_in_one_place_are_one_multiple_point(sign):
    (point,) = mc.continue_equilibria(crossings(0.011, 0.011, sign), "p", bounds=(-1.0, 1.0)).special_points
    assert (point.kind, point.converged) == ("BP", False)
    assert "2 eigenvalues vanish together" in point.note
    assert point["p"] == pytest.approx(0.011, abs=1e-6)


def oscillators(first, second):
    """Return two oscillators of rates (one, other)(p) and frequencies 1 and 2.3."""

    def f(u, p):
        a, b = first(p["p"]) - u[0] ** 2 - u[1] ** 2, second(p["p"]) - u[2] ** 2 - u[3] ** 2
        return [a * u[0] - u[1], u[0] + a * u[1], b * u[2] - 2.3 * u[3], 2.3 * u[2] + b * u[3]]

    return mc.VectorField(f, [0.0] * 4, {"p": -0.93})


def test_two_hopf_points_in_opposite_directions_within_a_step_are_both_found():
    field = oscillators(lambda p: p - 0.011, lambda p: 0.021 - p)
    branch = mc.continue_equilibria(field, "p", bounds=(-1.0, 1.0))
    assert [p.kind for p in branch.special_points] == ["HB", "HB"]
    assert [p["p"] for p in branch.special_points] == pytest.approx([0.011, 0.021], abs=1e-10)


@pytest.mark.parametrize("centre", [0.003, 0.0155, 0.027])
def test_a_narrow_bump_of_a_growth_rate_is_not_stepped_over(centre):
    field = oscillators(lambda p: 2.0 * math.exp(-(((p - centre) / 0.02) ** 2)) - 1.0, lambda p: -1.0)
    half = 0.02 * math.sqrt(math.log(2.0))
    branch = mc.continue_equilibria(field, "p", bounds=(-1.0, 1.0))
    assert [p["p"] for p in branch.of_kind("HB")] == pytest.approx([centre - half, centre + half], abs=1e-9)


# -- nothing false ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("start", "bounds"), [(-0.3, (-1, 1)), (0.0, (-1, 1)), (1e-12, (-1, 1)), (0.25, (0, 1))])
def test_a_hopf_point_on_which_a_point_of_the_curve_lies_is_a_regular_one(start, bounds):
    # l1 = -3/2: the mean of -(cos^4 + sin^4) over a turn is -3/4, and |q| = 1
    def f(u, p):
        return [p["p"] * u[0] - u[1] - u[0] ** 3, u[0] + p["p"] * u[1] - u[1] ** 3]

    (point,) = mc.continue_equilibria(mc.VectorField(f, [0.0, 0.0], {"p": start}), "p", bounds).special_points
    assert (point.kind, point.converged) == ("HB", True)
    assert point["p"] == pytest.approx(0.0, abs=1e-12)
    assert point.coefficients["l1"] == pytest.approx(-1.5, rel=1e-9)


@pytest.mark.slow
def test_folds_without_damping_are_no_hopf_points_and_their_coefficient_is_refused_with_a_sentence():
    field = mc.VectorField(lambda u, p: [u[1], p["p"] - (u[0] ** 3 - 0.6 * u[0])], [-1.1, 0.0], {"p": -0.671})
    branch = mc.continue_equilibria(field, "p", bounds=(-1.0, 1.0))
    assert [p.kind for p in branch.special_points] == ["LP", "LP"]
    for point in branch.special_points:
        assert abs(point["p"]) == pytest.approx(0.4 * math.sqrt(0.2), rel=1e-9)
        assert math.isnan(point.coefficients["a"])
        assert point.note == "the eigenvalue zero is double: no coefficient a"


@pytest.mark.slow
def test_a_linear_field_has_no_generalised_hopf_points():
    def f(u, p):
        rate, omega = p["a"], 1.0 + p["b"]
        return [rate * u[0] - omega * u[1], omega * u[0] + rate * u[1]]

    branch = mc.continue_equilibria(mc.VectorField(f, [0.0, 0.0], {"a": -0.5, "b": 0.2}), "a", bounds=(-1.0, 1.0))
    with_coefficient, without = (
        mc.continue_special(branch.point("HB1"), "b", bounds=(-0.5, 1.0), lyapunov=lyapunov)
        for lyapunov in (True, False)
    )
    assert with_coefficient.special_points == without.special_points == ()


# -- diagrams -----------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("slope", [0.5, 2.0, 5.0])
def test_a_diagram_has_both_of_two_steep_lines_that_cross_at_a_small_angle(slope):
    one, other = slope / 6.0, math.tan(math.atan(slope) - math.radians(2.0)) / 6.0

    def f(u, p):
        return [(u[0] - one * (p["p"] - 0.31)) * (u[0] - other * (p["p"] - 0.31))]

    field = mc.VectorField(f, [one * -3.21], {"p": -2.9})
    assert len(mc.bifurcation_diagram(field, "p", bounds=(-3.0, 3.0))) == 2


# -- scale --------------------------------------------------------------------------------------------------------


def ab_times(size):
    """Return the branch of `ab` with its state multiplied by a size."""
    plain = ab(18.0)
    f = plain.function
    given = {name: p.value for name, p in plain.parameters.items()}
    field = mc.VectorField(lambda u, p: size * np.asarray(f(np.asarray(u) / size, p)), size * plain.u0, given)
    return mc.continue_equilibria(field, "D", bounds=(0.0, 0.6))


@pytest.mark.slow
@pytest.mark.parametrize("size", [1e-3, *map(long, (1e-2, 10.0, 1e2, 1e3))])
def test_points_and_coefficients_do_not_depend_on_the_units_of_the_state(size):
    plain, other = ab_times(1.0), ab_times(size)
    for one, two in zip(plain.special_points, other.special_points, strict=True):
        assert (two.kind, two["D"]) == (one.kind, pytest.approx(one["D"], rel=1e-10))
        power = {"LP": ("a", 1), "HB": ("l1", 2)}[one.kind]
        assert two.coefficients[power[0]] * size ** power[1] == pytest.approx(one.coefficients[power[0]], rel=1e-6)


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("width", [1.0, 0.1, 0.01])
def test_the_coefficient_of_a_steep_field_is_known_whatever_its_width(width, own):
    # the growth w sin(u / w) - u has the cubic -u^3 / (6 w^2): l1 = -3/2 / (6 w^2), as for -u^3
    def f(u, p):
        bend = [width * math.sin(v / width) - v for v in u]
        return [p["p"] * u[0] - u[1] + bend[0], u[0] + p["p"] * u[1] + bend[1]]

    def derivative(u, p):
        bend = [math.cos(v / width) - 1.0 for v in u]
        return [[p["p"] + bend[0], -1.0], [1.0, p["p"] + bend[1]]]

    given = {"jacobian": derivative} if own else {}
    field = mc.VectorField(f, [0.0, 0.0], {"p": -0.3}, **given)
    (hopf,) = mc.continue_equilibria(field, "p", bounds=(-1.0, 1.0)).special_points
    assert hopf.coefficients["l1"] == pytest.approx(-0.25 / width**2, rel=1e-6)
