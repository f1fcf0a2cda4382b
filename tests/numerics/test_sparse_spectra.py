"""Unstable eigenvalues of sparse matrices are counted, with a proof that there are no others, or it is said."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.fields import far_from_normal
from scipy import sparse

from mjcont.numerics.equations.problem import Pencil
from mjcont.numerics.spectra.large import nearest
from mjcont.numerics.spectra.spectrum import spectrum

MANY = 200


def of(jac):
    """Return the spectrum of x' = J x."""
    return spectrum(Pencil(None, None, -sparse.csc_matrix(jac)))


def sheared(jac, size=0.3):
    """Return T J T^-1 for a matrix T with a few entries beside its diagonal: nothing is aligned or normal."""
    n = jac.shape[0]
    t = sparse.identity(n) + size * sparse.random(n, n, 2.0 / n, random_state=1)
    return sparse.csc_matrix(np.linalg.solve(t.toarray().T, (t @ jac).toarray().T).T)


def blocks(*parts):
    return sparse.block_diag(parts, format="csc")


def pair(growth, omega):
    return [[growth, -omega], [omega, growth]]


def slow(n):
    return sparse.diags(-np.linspace(0.01, 3.0, n))


@pytest.mark.parametrize("n", [20, MANY])
@pytest.mark.parametrize(("growth", "count"), [(1e-3, 2), (-1e-3, 0)])
@pytest.mark.parametrize("turn", [lambda j: j, sheared])
def test_a_pair_far_out_on_the_axis_is_seen_beside_slow_modes(n, growth, count, turn):
    s = of(turn(blocks(slow(n), pair(growth, 10.0))))
    assert (s.n_unstable, s.stability, s.proven) == (count, "unstable" if count else "stable", True)


@pytest.mark.parametrize("n", [20, MANY])
@pytest.mark.parametrize("turn", [lambda j: j, sheared])
def test_an_eigenvalue_of_50_is_seen_in_a_matrix_that_is_not_symmetric(n, turn):
    diagonal = -np.arange(1.0, n + 1)
    diagonal[n // 2] = 50.0
    s = of(turn(sparse.diags([diagonal, 5.0 * np.ones(n - 1)], [0, 1])))
    assert (s.n_unstable, s.stability, s.proven) == (1, "unstable", True)
    assert s.eigenvalues[0] == pytest.approx(50.0, rel=1e-9)


def test_a_chain_that_diagonal_scaling_makes_normal_is_settled_by_it():
    """The eigenvalues of tridiag(c, a, b) are a + 2 sqrt(b c) cos(k pi / (n + 1)); here they are complex."""
    a, b, c, n = 0.1, 4.0, -1.0, 2000
    s = of(sparse.diags([np.full(n - 1, b), np.full(n, a), np.full(n - 1, c)], [1, 0, -1]) - 0.2 * sparse.identity(n))
    assert (s.n_unstable, s.stability, s.proven, s.complete) == (0, "stable", True, False)


def brusselator(n, B, A=2.0, d=(0.008, 0.004)):
    """Return the matrix of the Brusselator with diffusion on n cells, at its uniform state."""
    laplacian = sparse.diags([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], [1, 0, -1]) * (n + 1.0) ** 2
    one = sparse.identity(n)
    return sparse.bmat([[d[0] * laplacian + (B - 1.0) * one, A**2 * one], [-B * one, d[1] * laplacian - A**2 * one]])


def waves(n, B, A=2.0, d=(0.008, 0.004)):
    """Return its eigenvalues, wave by wave."""
    mu = 4.0 * (n + 1) ** 2 * np.sin(np.arange(1, n + 1) * math.pi / (2 * (n + 1))) ** 2
    trace, det = B - 1.0 - A**2 - sum(d) * mu, (B - 1.0 - d[0] * mu) * (-(A**2) - d[1] * mu) + A**2 * B
    root = np.sqrt(trace**2 - 4.0 * det + 0j)
    return np.concatenate([trace + root, trace - root]) / 2.0


@pytest.mark.parametrize("B", [1.0, 4.9, 5.2, 6.5, 9.0])
def test_the_waves_of_the_brusselator_are_all_counted(B):
    s, true = of(brusselator(400, B)), waves(400, B)
    assert s.proven and not s.complete
    assert s.n_unstable == np.count_nonzero(true.real > 0.0)
    unstable = s.eigenvalues[s.eigenvalues.real > 0.0]
    assert np.sort_complex(unstable) == pytest.approx(np.sort_complex(true[true.real > 0.0]), rel=1e-8)


@pytest.mark.parametrize("B", [5.2, 9.0])
def test_what_is_listed_is_an_eigenvalue(B):
    s, true = of(brusselator(400, B)), waves(400, B)
    assert max(np.abs(true - e).min() for e in s.eigenvalues) < 1e-7


def test_double_eigenvalues_of_a_square_are_counted_twice():
    """Convection and diffusion on a square, with a source: a wave (j, k) has the eigenvalue of (k, j)."""
    m, source, drift = 20, 80.0, 0.3
    one = sparse.identity(m)
    line = (m + 1.0) ** 2 * sparse.diags([np.ones(m - 1) + drift, np.full(m, -2.0), np.ones(m - 1) - drift], [1, 0, -1])
    jac = sparse.kron(line, one) + sparse.kron(one, line) + source * sparse.identity(m * m)
    along = (m + 1.0) ** 2 * (2.0 * math.sqrt(1.0 - drift**2) * np.cos(np.arange(1, m + 1) * math.pi / (m + 1)) - 2.0)
    s, count = of(jac), np.count_nonzero(along[:, None] + along + source > 0.0)
    assert (s.n_unstable, s.proven) == (count, True)


@pytest.mark.parametrize("unstable", [0, 1, 7])
def test_of_a_symmetric_matrix_the_pivots_count(unstable):
    jac = sparse.diags(np.concatenate([np.linspace(1.0, 2.0, unstable), -np.linspace(1.0, 90.0, MANY)]))
    s = of(jac + sparse.diags([0.1, 0.1], [1, -1], shape=jac.shape))
    assert (s.n_unstable, s.proven, s.conservative) == (unstable, True, True)


@pytest.mark.parametrize("n", [1, 2, 40, MANY])
def test_a_singular_matrix_is_marginal(n):
    laplacian = sparse.diags([np.ones(n - 1), np.full(n, -2.0), np.ones(n - 1)], [1, 0, -1])
    first = sparse.csc_matrix(([1.0], ([0], [0])), shape=(n, n)) * ((n + 1.0) / n if n > 1 else 2.0)
    s = of(laplacian + first)  # det = 0: the first row is taken off until the chain has a mode of rate zero
    assert (s.n_unstable, s.stability, s.proven) == (0, "marginal", True)


@pytest.mark.slow
@pytest.mark.parametrize(("decay", "stability"), [(5.0, "marginal"), (4.0, "unstable")])
def test_where_it_cannot_be_proven_it_is_said(decay, stability):
    s = of(far_from_normal(700) - decay * sparse.identity(700))
    assert not s.proven and s.stability == stability


def test_eigenvalues_about_a_frequency_are_found():
    jac = sheared(blocks(slow(MANY), pair(-0.1, 10.0), pair(0.2, 11.0)))
    found = nearest(jac, 10.2j)
    assert np.sort(found.imag) == pytest.approx([10.0, 11.0], rel=1e-8)


def test_pairs_that_pass_are_told_by_the_number_of_unstable_ones():
    counts = [of(blocks(slow(MANY), pair(growth, 10.0), [[fold]])) for growth, fold in (
        (-0.1, -0.5), (0.1, -0.5), (0.1, 0.5), (-0.1, 0.5))]
    stable, oscillates, both, folded = counts
    assert stable.pairs_passing(oscillates) == oscillates.pairs_passing(stable) == 1
    assert oscillates.pairs_passing(both) == stable.pairs_passing(folded) == 0
    assert oscillates.pairs_passing(folded) == 1  # a fold and a Hopf point in one step


@pytest.mark.parametrize("n", [3, 20, 130, 200])
def test_one_stiff_unknown_makes_nothing_symmetric(n):
    decay = -np.linspace(0.01, 1.0, n)
    decay[-1] = -1e8
    found = of(sparse.diags([decay, np.ones(n - 1)], [0, 1]))  # triangular: its eigenvalues are the decay rates
    assert (found.stability, found.n_unstable) == ("stable", 0)
    assert found.eigenvalues[0] == pytest.approx(-0.01, abs=1e-6)


def test_a_pair_beside_a_stiff_unknown_is_counted():
    found = of(blocks(pair(1.0, 1.0), [[-1e9]]))
    assert (found.stability, found.n_unstable) == ("unstable", 2)
    assert found.eigenvalues[:2] == pytest.approx([1.0 - 1.0j, 1.0 + 1.0j])


@pytest.mark.parametrize("n", [100, 200])
def test_a_symmetric_matrix_whose_smallest_eigenvalues_drown_in_rounding_is_marginal(n):
    decay = -np.logspace(-12, 8, n)
    decay[3] = 1e-7
    assert of(sparse.diags(decay)).stability == "marginal"
