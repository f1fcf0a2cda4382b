"""The noise of the shaken suite: what it is relative to, that it is as large as rounding, that it reaches Newton."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
from problems.fields import ab, bratu
from problems.shaking import UNITS, Noise, elimination_size, shaken
from scipy import sparse

import mjcont as mc
from mjcont.numerics.equations import newton
from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.system import System

EPS = float(np.finfo(float).eps)
STIFF = {"F": 20.0, "k_j": 1e6}


@pytest.fixture(scope="module")
def stiff():
    """The overcentre mechanism at rest on bushes of 1e6 N/m."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    point = mc.find_equilibrium(mechanism, STIFF)
    return mechanism, point.state, mechanism.values(point.parameters)


def test_noise_is_one_to_four_units_in_the_last_place():
    ones = np.ones(4000)
    units = (Noise(0).off(ones) - ones) / EPS
    assert set(np.abs(units)) == set(range(1, UNITS + 1))


def test_noise_is_the_same_for_a_seed_and_differs_from_call_to_call(stiff):
    mechanism, x, values = stiff

    def drawn(seed):
        with shaken(seed):
            return [mechanism.residual(x, values) for _ in range(2)]

    assert np.array_equal(drawn(3), drawn(3))
    assert not np.array_equal(drawn(3), drawn(4))
    once, again = drawn(3)
    assert not np.array_equal(once, again)


def test_nothing_is_left_behind(stiff):
    mechanism, x, values = stiff
    before = mechanism.residual(x, values)
    with shaken(0):
        mechanism.residual(x, values)
    assert np.array_equal(mechanism.residual(x, values), before)


def test_noise_of_a_field_is_relative_to_its_jacobian_times_the_state_and_to_itself():
    field, x, values = ab(18.0), np.array([0.3, 1.2]), {"D": 0.1, "B": 18.0}
    f, lin = field.residual(x, values), field.linearize(x, values, ("D", "B"))
    bound = np.abs(lin.jac) @ np.abs(x) + np.abs(lin.par) @ np.array([0.1, 18.0]) + np.abs(f)
    with shaken(0):
        off = np.array([field.residual(x, values) - f for _ in range(200)])
    assert np.all(np.abs(off) <= UNITS * EPS * bound * 1.01)
    assert np.all(np.abs(off).max(axis=0) > 0.3 * UNITS * EPS * bound)


def _rounding(mechanism, x, values, count=300):
    """Return by how much rounding alone changes the residual, (count, n): states some units apart, less what is linear.

    Derivatives are good to 1e-9, so what is linear is known to 1e-24 of the stiffness.
    """
    lin = mechanism.linearize(x, values, (), accurate=True)
    states = x + 3e-15 * np.random.default_rng(0).normal(size=(count, len(x)))
    return np.array([mechanism.residual(y, values) - lin.f - lin.jac @ (y - x) for y in states])


def test_noise_is_as_large_as_rounding_where_bushes_are_stiff_and_where_the_mechanism_is_soft(stiff):
    mechanism, x, values = stiff
    left, sizes, _ = np.linalg.svd(mechanism.linearize(x, values, (), accurate=True).jac)
    assert sizes[0] > 1e6 * sizes[-1]
    with shaken(0):
        noise = np.array([mechanism.residual(x, values) for _ in range(300)])
    ratios = np.std(noise @ left, axis=0) / np.std(_rounding(mechanism, x, values) @ left, axis=0)
    assert np.all(ratios > 1.0), ratios
    assert np.all(ratios < 200.0), ratios


def test_noise_moves_the_last_newton_step(stiff):
    mechanism, x, values = stiff
    system, none = System(mechanism, values, ()), np.zeros(0)

    def last_step():
        local = system.local(x, none)
        lu = Factored(system.jacobian(local, none))
        return newton._newton_step(system, local, none, lu, None)[0]

    plain = last_step()
    assert np.array_equal(last_step(), plain)
    steps = []
    for seed in range(10):
        with shaken(seed):
            steps.append(last_step())
    moved = [float(np.linalg.norm(s - plain)) for s in steps]
    assert min(moved) > EPS, moved
    assert max(moved) < 1e-12, moved
    assert len({s.tobytes() for s in steps}) == len(steps)


def test_derivatives_by_differences_have_the_noise_over_the_step(stiff):
    mechanism, x, values = stiff
    jac = mechanism.linearize(x, values, ()).jac
    with shaken(0):
        off = mechanism.linearize(x, values, ()).jac - jac
    step = 2e-6
    assert EPS / step * 0.1 < np.abs(off).max() / np.abs(jac).max() < EPS / step * 10.0 * UNITS


def test_elimination_sizes_are_those_of_the_factors():
    matrices = np.random.default_rng(1).normal(size=(3, 6, 6))
    expected = np.array([p @ (np.abs(low) @ np.abs(up)) for p, low, up in map(scipy.linalg.lu, matrices)])
    assert elimination_size(matrices) == pytest.approx(expected, rel=1e-12)
    assert np.array([elimination_size(m) for m in matrices]) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("dense", [True, False])
def test_solutions_have_residuals_relative_to_the_matrix_times_the_solution(dense):
    matrix = np.random.default_rng(2).normal(size=(8, 8)) * 10.0 ** np.arange(8)
    rhs = np.ones(8)
    given = matrix if dense else sparse.csc_matrix(matrix)
    with shaken(0):
        solutions = [Factored(given).solve(rhs) for _ in range(20)]
    off = np.array([np.abs(matrix @ z - rhs) / (np.abs(matrix) @ np.abs(z)) for z in solutions])
    assert 0.2 * EPS < np.median(off) < 2.0 * UNITS * EPS


def test_solvers_that_the_tests_call_themselves_are_left_alone():
    matrix = np.random.default_rng(3).normal(size=(5, 5))
    with shaken(0):
        found = np.linalg.inv(matrix)
    assert np.array_equal(found, np.linalg.inv(matrix))


def test_a_sparse_jacobian_that_is_given_is_off_by_units_in_the_last_place():
    field, x = bratu(50), np.linspace(0.0, 0.5, 50)
    plain = field.linearize(x, {"la": 1.0}, ()).jac
    with shaken(0):
        noisy = field.linearize(x, {"la": 1.0}, ()).jac
    assert noisy.nnz == plain.nnz
    ratio = np.abs(noisy.data - plain.data) / np.abs(plain.data)
    assert 0.0 < ratio.min() <= ratio.max() <= UNITS * EPS
