"""Interpolation along a curve, and what its slopes tell of turns between points."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.step.arclength import first_point
from mjcont.numerics.step.hermite import combine, hermite, hermite_each, lagrange, lagrange_each, mixed
from mjcont.numerics.step.turning import falls_between, far_below, pairs_may_turn_twice

NODES = np.array([[0.0, 0.3, -0.2, 0.7], [0.1, -0.4, 0.25, 0.9]])
AT = np.array([0.15, 0.6])


def test_weights_of_values_reproduce_polynomials_through_the_nodes():
    polynomial = np.polynomial.Polynomial([1.0, -2.0, 0.5, 3.0])
    found = (lagrange_each(NODES, AT) * polynomial(NODES)).sum(axis=1)
    assert found == pytest.approx(polynomial(AT), abs=1e-13)
    for nodes, at in zip(NODES.tolist(), AT.tolist(), strict=True):
        assert np.dot(lagrange(nodes, at), polynomial(np.array(nodes))) == pytest.approx(polynomial(at), abs=1e-13)


def test_weights_of_values_and_slopes_reproduce_polynomials_of_twice_the_degree():
    polynomial = np.polynomial.Polynomial([1.0, -2.0, 0.5, 3.0, -1.0, 0.7, 2.0, -3.0])
    values, slopes, weights = hermite_each(NODES, AT)
    found = (values * polynomial(NODES) + slopes * polynomial.deriv()(NODES)).sum(axis=1)
    assert found == pytest.approx(polynomial(AT), abs=1e-12)
    assert weights == pytest.approx(lagrange_each(NODES, AT), abs=0.0)
    for nodes, at in zip(NODES, AT.tolist(), strict=True):
        of_values, of_slopes = hermite(nodes.tolist(), at)
        there = np.dot(of_values, polynomial(nodes)) + np.dot(of_slopes, polynomial.deriv()(nodes))
        assert there == pytest.approx(polynomial(at), abs=1e-12)


def test_a_weighted_sum_of_parts_keeps_their_shape():
    parts = [np.arange(6.0).reshape(2, 3) + k for k in range(3)]
    assert combine([0.5, -1.0, 2.0], parts) == pytest.approx(0.5 * parts[0] - parts[1] + 2.0 * parts[2])


def test_matrices_are_mixed_row_by_row():
    matrices = np.random.default_rng(1).standard_normal((5, 2, 3))
    windows, weights = np.array([[0, 2], [4, 1]]), np.array([[0.3, 0.7], [-1.0, 2.0]])
    expected = [0.3 * matrices[0] + 0.7 * matrices[2], -matrices[4] + 2.0 * matrices[1]]
    assert mixed(weights, matrices, windows) == pytest.approx(np.array(expected))


@pytest.mark.parametrize(("epsilon", "twice"), [(1e-4, True), (1e-9, True), (-1e-6, True), (-0.6, False)])
def test_a_cubic_next_to_its_cusp_may_turn_twice(epsilon, twice):
    """y = s^3 - epsilon s has two extrema for epsilon > 0; a little below, nobody can exclude them from two points."""
    s = np.array([-0.21, 0.3])
    assert pairs_may_turn_twice(3.0 * s**2 - epsilon, s**3 - epsilon * s, s).tolist() == [twice]


def test_a_function_that_turns_once_is_no_case_of_two():
    s = np.array([-0.2, 0.3])
    assert pairs_may_turn_twice(2.0 * s, s**2, s).tolist() == [False]


@pytest.mark.parametrize(
    ("slopes", "expected"), [([1.0, 0.01], True), ([-0.01, -1.0], True), ([1.0, 0.5], False), ([1.0, -0.01], False)]
)
def test_a_slope_far_below_its_neighbour_is_seen(slopes, expected):
    assert far_below(np.array(slopes)).tolist() == [expected]


@pytest.mark.parametrize(("at", "falls"), [(0.01, True), (-0.01, False)])
def test_the_curve_itself_tells_whether_a_small_slope_falls_further(at, falls):
    """p = x^3 / 3 + 1e-8 x has its least slope at x = 0: between -0.3 and 0.01, and not between -0.3 and -0.01."""
    cubic = mc.VectorField(lambda u, p: [u[0] ** 3 / 3.0 + 1e-8 * u[0] - p["p"]], [0.0], {"p": 0.0})
    system, settings = System(cubic, cubic.values(), [Free("p", -1.0, 1.0)]), Settings()
    old, new = (
        first_point(system, np.array([x]), np.array([0.5 * (x**3 / 3.0 + 1e-8 * x)]), 1.0, settings) for x in (-0.3, at)
    )
    new.s = 0.3
    assert far_below(np.array([old.tangent[1], new.tangent[1]])).tolist() == [True]
    assert falls_between(system, old, new) == falls
