"""Sparse Jacobians by a few evaluations, and what sparse matrices of motion say of stability, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import sparse

from mjcont.numerics.equations.algebra import full
from mjcont.numerics.equations.coloured import Coloured
from mjcont.numerics.equations.differences import FOURTH_ORDER, SECOND_ORDER
from mjcont.numerics.equations.problem import Pencil
from mjcont.numerics.spectra.spectrum import settles, spectrum


def neighbours(count, reach=1):
    """The pattern in which each unknown acts on those beside it."""
    return sparse.diags([np.ones(count - abs(k)) for k in range(-reach, reach + 1)], range(-reach, reach + 1))


def jacobian(f, x, pattern, scale, rule):
    coloured = Coloured.of(pattern)
    rows = np.array([f(x + step) for step in coloured.steps(scale, rule)])
    return coloured, coloured.jacobian(rows, scale, rule)


def test_a_band_takes_as_many_groups_as_it_is_wide():
    assert Coloured.of(neighbours(500)).groups == 3
    assert Coloured.of(neighbours(500, reach=2)).groups == 5


def test_no_two_columns_of_a_group_share_a_row():
    pattern = sparse.random(200, 200, 0.02, random_state=1) + sparse.identity(200)
    coloured = Coloured.of(pattern)
    assert coloured.groups < 60
    for g in range(coloured.groups):
        assert (coloured.pattern.toarray()[:, coloured.group == g] != 0).sum(axis=1).max() <= 1


@pytest.mark.parametrize(("rule", "error"), [(SECOND_ORDER, 1e-8), (FOURTH_ORDER, 1e-10)])
def test_the_jacobian_of_a_chain_is_that_of_its_closed_form(rule, error):
    # f_i = sin(x_i) x_(i+1): d f_i / d x_i = cos(x_i) x_(i+1), d f_i / d x_(i+1) = sin(x_i)
    x = np.cos(np.arange(300.0))
    following = np.append(x[1:], 1.0)
    scale = 1.0 + np.arange(300.0) / 100.0
    _, found = jacobian(lambda u: np.sin(u) * np.append(u[1:], 1.0), x, neighbours(300), scale, rule)
    expected = np.diag(np.cos(x) * following) + np.diag(np.sin(x[:-1]), 1)
    assert np.abs(found.toarray() - expected).max() < error


def test_zeros_of_the_pattern_stay_entries():
    coloured, found = jacobian(lambda u: u, np.ones(50), neighbours(50), np.ones(50), SECOND_ORDER)
    assert found.nnz == coloured.pattern.nnz == 148


# -- motion -------------------------------------------------------------------------------------------------------

MASSES, STIFFNESS, DAMPING = 400, 1e4, 0.3


def string(softer=0.0, damping=DAMPING):
    """Equal unit masses in a row between walls, springs between them, each on a negative spring: -x'' = K x + c x'."""
    k = STIFFNESS * sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(MASSES, MASSES))
    one = sparse.identity(MASSES, format="csc")
    return Pencil(one, damping * one, (k - softer * one).tocsc())


def squares(count=6):
    return 4.0 * STIFFNESS * np.sin(np.arange(1, count + 1) * np.pi / (2 * (MASSES + 1))) ** 2


def test_the_slowest_modes_of_a_string_are_those_of_the_closed_form():
    found = spectrum(string())
    rates = np.sqrt(squares(3) - 0.25 * DAMPING**2)
    expected = -0.5 * DAMPING + 1j * np.concatenate([-rates[::-1], rates])
    assert found.stability == "stable" and found.conservative and not found.complete
    assert found.eigenvalues[np.argsort(found.eigenvalues.imag)] == pytest.approx(expected, rel=1e-9)


def test_without_damping_a_string_is_marginal():
    assert spectrum(string(damping=0.0)).stability == "marginal"


@pytest.mark.parametrize("count", [1, 7, 40])
def test_every_unstable_mode_is_counted(count):
    between = 0.5 * (squares(count)[-1] + squares(count + 1)[-1])
    found = spectrum(string(softer=between))
    assert (found.stability, found.n_unstable) == ("unstable", count)


def test_at_a_fold_a_string_is_marginal():
    assert spectrum(string(softer=squares(1)[0])).stability == "marginal"


@pytest.mark.parametrize(
    ("softer", "damping", "known"), [(0.0, DAMPING, True), (0.0, 0.0, False), (squares(1)[0], DAMPING, False)]
)
def test_stability_is_told_without_eigenvalues_where_nothing_is_near_the_axis(softer, damping, known):
    pencil = full(string(softer, damping))
    softest = np.linalg.eigvalsh(pencil.stiffness)[0]
    assert settles(pencil, softest) is known


def test_a_mode_that_its_damper_drives_is_seen_in_full():
    count = 100
    one, end = sparse.identity(count, format="csc"), sparse.csc_matrix(([4.0], ([5], [5])), shape=(count, count))
    found = spectrum(Pencil(one, DAMPING * one - end, STIFFNESS * neighbours(count).multiply(one).tocsc()))
    # masses on springs of their own: the driven one grows, s^2 + (c - 4) s + k = 0
    assert found.complete and not found.conservative and len(found.eigenvalues) == 2 * count
    assert found.n_unstable == 2
    assert found.eigenvalues[0].real == pytest.approx(2.0 - 0.5 * DAMPING, rel=1e-12)
