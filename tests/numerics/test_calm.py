"""Steps between which many unknowns are proven to do nothing: the proof is right, and what happens is still found."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from problems.fields import ab, adaptx, brusselator, cusp
from scipy import linalg

import mjcont as mc
from mjcont.numerics.equations import bordered
from mjcont.numerics.spectra import inertia, tracks

sys.path.insert(0, str(Path(__file__).parent.parent.parent))
from benchmarks.dense import cells  # noqa: E402

# what dense linear algebra costs, in LU factors of the same size
COSTS = {"eig": 120.0, "eigvals": 70.0, "svd": 40.0, "inv": 8.0, "solve": 2.0, "dgetrf": 1.0, "dpotrf": 0.5}


def matrix(n, seed):
    return np.random.default_rng(seed).normal(size=(n, n)) / np.sqrt(n)


def basis_of(jac):
    values, left, right = linalg.eig(jac, left=True)
    left = left / np.einsum("ij,ij->j", left.conj(), right).conj()
    return inertia.Basis.of(tracks.Modes(jac, values, right, left, np.full(len(jac), 1e-12), np.ones(len(jac), bool)))


def among_many(field, n, seed=1):
    """A field beside n unknowns that follow it, all seen through a rotation; its Jacobian is given."""
    k, (q, _) = field.n, np.linalg.qr(matrix(field.n + n, seed))
    coupling, decay = matrix(k + n, seed + 1)[k:, :k], 1.0 + np.arange(n) / 3.0

    def f(u, p):
        x, z = np.split(q.T @ u, [k])
        return q @ np.concatenate([field.residual(x, p), coupling @ x - decay * z])

    def jacobian(u, p):
        inner = np.zeros((k + n, k + n))
        inner[:k, :k] = field.linearize(q.T[:k] @ u, p, ()).jac
        inner[k:, :k], inner[k:, k:] = coupling, -np.diag(decay)
        return q @ inner @ q.T

    start = q @ np.append(field.u0, coupling @ field.u0 / decay)
    values = {name: p.value for name, p in field.parameters.items()}
    return mc.VectorField(f, start, values, jacobian=jacobian, scale=np.full(k + n, 3.0))


# -- the proof -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(12))
def test_what_is_proven_of_the_ends_and_the_middle_holds_all_along(seed):
    n = 9
    first = matrix(n, seed) - 0.2 * np.eye(n)
    basis = basis_of(first)
    proven = 0
    for size in (1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0):
        parts = [first, size * matrix(n, seed + 100), size * matrix(n, seed + 200)]
        places = np.array([-0.7, 0.0, 1.0])
        stack = [sum(part * t**k for k, part in enumerate(parts)) for t in places]
        seen = [basis.seen(jac) for jac in stack]
        middle = seen[1] + 0.5 * inertia.slope(places[0], *seen)
        if not all(basis.keeps(each) for each in (seen[1], seen[2], middle)):
            continue
        proven += 1
        for t in np.linspace(0.0, 1.0, 101):
            values = np.linalg.eigvals(sum(part * t**k for k, part in enumerate(parts)))
            assert np.count_nonzero(values.real > 0.0) == basis.unstable
    assert proven


def test_a_matrix_whose_eigenvalue_has_passed_the_axis_is_not_proven():
    basis = basis_of(np.diag([-1.0, -2.0, 3.0]))
    assert basis.keeps(basis.seen(np.diag([-0.5, -2.0, 3.0])))
    for other in ([0.1, -2.0, 3.0], [-1.0, -2.0, -0.1], [-0.1, -2.0, 3.0]):
        assert not basis.keeps(basis.seen(np.diag(other)))


def test_eigenvalues_in_the_basis_are_those_of_its_matrix():
    jac = matrix(8, 3)
    basis = basis_of(jac)
    found, expected = basis.values(basis.seen(jac)), np.linalg.eigvals(jac)
    assert np.sort(found.real) == pytest.approx(np.sort(expected.real[expected.imag >= 0.0]), abs=1e-12)
    right, rows = basis.complex
    assert rows @ jac @ right == pytest.approx(np.diag(np.diag(rows @ jac @ right)), abs=1e-12)
    assert np.diag(rows @ right) == pytest.approx(1.0)


def test_two_real_eigenvalues_whose_sum_changes_sign_are_noticed():
    basis = basis_of(np.diag([-1.0, 2.0, -5.0]))
    assert basis.sums_keep(*(basis.values(basis.seen(np.diag(d))) for d in ([-1.0, 2.0, -5.0], [-1.1, 2.1, -5.0])))
    assert not basis.sums_keep(*(basis.values(basis.seen(np.diag(d))) for d in ([-1.0, 2.0, -5.0], [-1.6, 1.5, -5.0])))


# -- what is found -------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    ("field", "name", "bounds"),
    [
        (lambda: ab(18.0), "D", (0.0, 0.6)), (cusp, "mu", (-1.0, 1.0)), (adaptx, "alpha", (0.1, 2.0)),
        (brusselator, "B", (0.5, 8.0)),
    ],
    ids=["ab", "cusp", "adaptx", "brusselator"],
)
def test_special_points_and_stability_among_many_are_those_of_the_few(field, name, bounds):
    few, many = (mc.continue_equilibria(f, name, bounds) for f in (field(), among_many(field(), 28)))
    assert [p.kind for p in many.special_points] == [p.kind for p in few.special_points]
    for one, other in zip(many.special_points, few.special_points, strict=True):
        assert one[name] == pytest.approx(other[name], abs=1e-7)
    told = np.array(many.stability) != "marginal"
    grows = many.eigenvalues.real.max(axis=1) > 0.0
    assert grows[told].tolist() == (np.array(many.stability) == "unstable")[told].tolist()


@pytest.mark.slow
def test_a_bump_between_two_points_is_found_among_many():
    """An eigenvalue reaches zero and goes back within a part of the longest step."""

    def f(u, p):
        bump = 1.5 * np.exp(-(((p["a"] - 0.53) / 0.01) ** 2))
        return [(bump - 1.0) * u[0] - u[0] ** 3, -2.0 * u[1]]

    def field():
        return mc.VectorField(f, [0.0, 0.0], {"a": 0.0})

    few, many = (mc.continue_equilibria(each, "a", (0.0, 1.0)) for each in (field(), among_many(field(), 28)))
    expected = 0.53 + 0.01 * np.sqrt(np.log(1.5)) * np.array([-1.0, 1.0])
    for branch in (few, many):
        assert [p["a"] for p in branch.of_kind("BP")] == pytest.approx(expected, abs=1e-6)


# -- what it costs -------------------------------------------------------------------------------------------------


@pytest.fixture
def spent(monkeypatch):
    """Dense linear algebra so far, by its name, for matrices of a hundred unknowns; a stack counts as many."""
    counts = dict.fromkeys(COSTS, 0.0)

    def count(owner, name):
        inner = getattr(owner, name)

        def counted(a, *args, **given):
            shape = np.shape(a)
            counts[name] += np.prod(shape[:-2]) * (shape[-1] / 100.0) ** 3
            return inner(a, *args, **given)

        monkeypatch.setattr(owner, name, counted)

    for name in ("eig", "eigvals"):
        count(linalg, name)
    for name in ("eig", "eigvals", "svd", "inv", "solve"):
        count(np.linalg, name)
    count(bordered.lapack, "dgetrf")
    count(inertia.lapack, "dpotrf")
    return counts


@pytest.mark.slow
@pytest.mark.parametrize("vectorized", [False, True], ids=["one state", "vectorized"])
def test_a_hundred_coupled_cells_cost_at_most_thirty_dense_solves_a_row(spent, vectorized):
    branch = mc.continue_equilibria(cells(100, vectorized), "a", (-2.0, -1.0), ds_max=0.01)
    assert len(branch) > 80
    assert sum(COSTS[name] * count for name, count in spent.items()) < 30.0 * len(branch)
