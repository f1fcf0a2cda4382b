"""Eigenvalues of large sparse matrices right of the axis and near it, and a proof that there are no others.

Eigenvalues near a place are found by shift and invert. What all of them span, with orthonormal columns V, J maps to
itself; so the others are the eigenvalues of J on the complement of V, and no real part there exceeds the largest value
of x'Sx, S = (J + J')/2 (Bendixson). How many directions of the complement have positive x'Sx tells the inertia

    positive(S on the complement) = positive(S) + positive(-V' S^-1 V) - columns of V                (Haynsworth)

by one symmetric factorisation. With none left, nothing was missed; otherwise J on those directions tells where to look
next. J is balanced first, since S depends on the units of the unknowns and eigenvalues do not.

Sources: Haynsworth, Determination of the inertia of a partitioned Hermitian matrix (Linear Algebra Appl. 1, 1968);
Meerbergen, Spence, Roose, Shift-invert and Cayley transforms for detection of rightmost eigenvalues of nonsymmetric
matrices (BIT 34, 1994); Osborne, On pre-conditioning of matrices (J. ACM 7, 1960).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order, connected_components
from scipy.sparse.linalg import ArpackError, LinearOperator, eigs, eigsh, splu

from mjcont.numerics.equations.algebra import eigenvalues, solve, symmetric_eigenvalues
from mjcont.numerics.equations.bordered import sparse_factors
from mjcont.numerics.equations.problem import Array

# eigenvalues nearest zero that are always sought; most at a place; places looked at; directions left to look along
NEAREST, _MOST, _PLACES, _OUTWARD = 6, 40, 8, 64
# noise of an eigenvalue in parts of the largest entry; what V may miss of an invariant space; what is a new direction
NOISE, _INVARIANT, _NEW = 1e-12, 1e-11, 1e-5
# shifts of a symmetric matrix that are tried in turn, in parts of the noise, and residual with its factors
_SHIFTS, _ACCURATE = (1.0, 1.4, 2.3), 1e-6
_SWEEPS, _EVEN = 12, 1e-3
# unknowns up to which all eigenvalues are computed, and up to which they are where nothing else is proven
SMALL, _DENSE = 128, 500
# eigenvalues that are listed beside those right of the axis
_LISTED = 128
# how far from a place that is told factors are taken, in parts of its distance from zero: it may be an eigenvalue
_BESIDE = 1e-3


@dataclass(frozen=True, slots=True)
class Rightmost:
    """Eigenvalues (m,) of a sparse matrix: those nearest zero, and those right of the axis.

    Attributes
    ----------
    noise : how far from the axis one must be to be told from it.
    unstable : how many lie right of it, for certain where `proven`, else at least.
    proven : whether no other one may.
    symmetric : whether the matrix is.
    touching : whether one is known to lie on the axis within the noise, listed or not.
    """

    values: Array
    noise: float
    unstable: int
    proven: bool
    symmetric: bool
    touching: bool = False


def rightmost(jac: Any, symmetric: bool) -> Rightmost:
    """Return the eigenvalues of a sparse matrix (n, n) that decide on stability; `symmetric` where it is known to be.

    Of a matrix that falls into parts, each acting on later ones only, they are those of its parts. NaN, and nothing
    proven, where the matrix is not finite.
    """
    jac = sparse.csc_matrix(jac)
    size = float(abs(jac).max())
    if not np.isfinite(size):
        return Rightmost(np.full(NEAREST, complex(np.nan, np.nan)), np.inf, 0, False, False)
    if symmetric:
        return _of_symmetric(jac, size)
    noise = NOISE * size
    values, proven = list[Array](), True
    for part in _parts(jac):
        found, sure = _of_part(part, noise)
        values.append(found)
        proven &= sure
    every = np.concatenate(values)
    unstable = int(np.count_nonzero(every.real > noise))
    kept = every[np.lexsort((np.abs(every.real), every.real <= noise))[: unstable + _LISTED]]
    return Rightmost(kept, noise, unstable, proven, False)


def _of_symmetric(jac: Any, size: float) -> Rightmost:
    """Return the eigenvalues of a symmetric matrix that are nearest zero, and how many are positive by its pivots."""
    noise = NOISE * size
    space = _Space(jac, size)
    space.look_near_zero()
    told, below = _factored(jac, -noise), _factored(jac, noise)
    values = space.values()
    count = int(np.count_nonzero(values.real > noise)) if told is None else told[1]
    touching = told is not None and below is not None and below[1] > told[1]
    return Rightmost(values, noise, count, told is not None, True, touching)


def _of_part(jac: Any, noise: float) -> tuple[Array, bool]:
    """Return eigenvalues of a part of a matrix, and whether none right of the axis is missing."""
    if jac.shape[0] <= SMALL:
        return eigenvalues(jac.toarray()), True
    balanced = _balanced(jac)
    size = float(abs(balanced).max())
    space = _Space(balanced, size)
    space.look_near_zero()
    proven = _prove(space, noise)
    if not proven and jac.shape[0] <= _DENSE:
        return eigenvalues(jac.toarray()), True
    return space.values(), proven


def _parts(jac: Any) -> Iterator[Any]:
    """Yield the diagonal blocks of a matrix whose parts act on later ones only, those of one unknown as one block."""
    jac = jac.copy()
    jac.eliminate_zeros()
    count, labels = connected_components(jac, directed=True, connection="strong")
    if count == 1:
        yield jac
        return
    sizes = np.bincount(labels)
    alone = jac.diagonal()[sizes[labels] == 1]
    for first in range(0, len(alone), SMALL):
        yield sparse.diags(alone[first : first + SMALL], format="csc")
    order = np.argsort(labels, kind="stable")
    for own in np.split(order, np.cumsum(sizes)[:-1]):
        if len(own) > 1:
            yield sparse.csc_matrix(jac[own][:, own])


def nearest(jac: Any, place: complex, count: int = 2) -> Array:
    """Return eigenvalues of a sparse matrix nearest to a place; none where they are not found."""
    return _shift_invert(sparse.csc_matrix(jac), place, count)[0]


def _prove(space: _Space, noise: float) -> bool:
    """Whether nothing right of the axis lies outside the space, which grows until that is so or nothing helps."""
    jac = space.jac
    half = sparse.csc_matrix(0.5 * (jac + jac.T))
    told = _factored(half, noise)
    if told is None:
        return False
    for _ in range(_PLACES):
        rest = _Rest(space, *told)
        if rest.outward == 0:
            return space.invariant()
        if not 0 < rest.outward <= min(_OUTWARD, jac.shape[0] // 4):
            return False
        known = space.basis.shape[1]
        for place in rest.places():
            space.look(place, min(rest.outward + NEAREST, _MOST))
            if space.basis.shape[1] > known:
                break
        else:
            return False
    return False


class _Space:
    """What the eigenvectors of a matrix that are known span."""

    def __init__(self, jac: Any, size: float) -> None:
        self.jac, self.size = jac, size
        self.basis = np.zeros((jac.shape[0], 0))

    def look(self, place: complex, count: int) -> None:
        """Add the eigenvectors of the `count` eigenvalues nearest to a place."""
        values, vectors = _shift_invert(self.jac, place, count)
        missed = np.abs(self.jac @ vectors - vectors * values).max(axis=0, initial=0.0)
        vectors = vectors[:, missed <= _INVARIANT * self.size]
        new = np.column_stack([vectors.real, vectors.imag])
        for _ in range(2):
            new = new - self.basis @ (self.basis.T @ new)
        if new.size and np.all(np.isfinite(new)):
            left, sizes, _ = np.linalg.svd(new, full_matrices=False)
            self.basis = np.linalg.qr(np.column_stack([self.basis, left[:, sizes > _NEW]]))[0]

    def look_near_zero(self) -> None:
        """Add the eigenvectors of some eigenvalues near zero: from nearer where many are small beside the largest."""
        for place in (1e-3 * self.size / self.jac.shape[0], 10.0 * NOISE * self.size):
            self.look(place, NEAREST)
            if self.basis.size:
                return

    def values(self) -> Array:
        """Return the eigenvalues that are known, complex."""
        if not self.basis.size:
            return np.zeros(0, dtype=complex)
        return eigenvalues(self.basis.T @ (self.jac @ self.basis))

    def invariant(self) -> bool:
        """Whether the matrix maps the space to itself, as far as rounding lets it."""
        image = self.jac @ self.basis
        missed = image - self.basis @ (self.basis.T @ image)
        return bool(np.abs(missed).max(initial=0.0) <= _INVARIANT * self.size)


class _Rest:
    """The symmetric part of a matrix, shifted by the noise, on the complement of a space."""

    def __init__(self, space: _Space, factors: Any, positive: int) -> None:
        self._space, self._factors = space, factors
        self._solved = factors.solve(space.basis)
        self._inner = space.basis.T @ self._solved
        sizes = np.sqrt(np.maximum(np.abs(np.diag(self._inner)), 1e-300))
        signs = symmetric_eigenvalues(0.5 * (self._inner + self._inner.T) / sizes / sizes[:, None])
        self.outward = positive + int(np.count_nonzero(signs < 0.0)) - len(signs)

    def _inverse(self, x: Array) -> Array:
        """Return the inverse on the complement, zero on the space, times a vector."""
        basis = self._space.basis
        x = x.ravel() - basis @ (basis.T @ x.ravel())
        found = self._factors.solve(x)
        found = found - self._solved @ solve(self._inner, basis.T @ found)
        return np.asarray(found - basis @ (basis.T @ found))

    def places(self) -> list[complex]:
        """Return where eigenvalues may lie that point outward, the most unstable first."""
        jac, basis, n = self._space.jac, self._space.basis, self._space.jac.shape[0]
        inverse = LinearOperator((n, n), self._inverse, dtype=float)
        try:
            _, along = eigsh(inverse, k=self.outward, which="LA", v0=_start(n), tol=1e-3)
        except (ArpackError, RuntimeError, ValueError):
            return []
        image = jac @ along
        both = np.column_stack([along, image - basis @ (basis.T @ image)])
        both = np.linalg.qr(both / np.maximum(np.linalg.norm(both, axis=0), 1e-300))[0]
        found = eigenvalues(both.T @ (jac @ both))
        found = found[np.isfinite(found) & (found.imag >= 0.0)]
        return [complex(found[i]) for i in np.argsort(-found.real)[:3]]


def _shift_invert(jac: Any, place: complex, count: int) -> tuple[Array, Array]:
    """Return the eigenvalues (m,) nearest to a place and their vectors (n, m), those that settle."""
    n = jac.shape[0]
    count = min(count, n - 2)
    shift = place + _BESIDE * abs(place)
    if abs(shift.imag) <= _BESIDE * abs(shift):
        shift = shift.real
    shifted = sparse.csc_matrix(jac - shift * sparse.identity(n, format="csc"))
    factors = sparse_factors(shifted)
    if factors is None:
        return np.zeros(0, dtype=complex), np.zeros((n, 0), dtype=complex)
    try:
        inverse = LinearOperator((n, n), factors.solve, dtype=shifted.dtype)
        inverted, vectors = eigs(inverse, k=count, v0=_start(n).astype(shifted.dtype))
    except (ArpackError, RuntimeError, ValueError):
        return np.zeros(0, dtype=complex), np.zeros((n, 0), dtype=complex)
    return shift + 1.0 / inverted, vectors


def _start(n: int) -> Array:
    """Return a vector that is orthogonal to no eigenvector, the same each time."""
    found: Array = np.random.default_rng(0).standard_normal(n)
    return found


def _factored(matrix: Any, shift: float) -> tuple[Any, int] | None:
    """Return factors of a symmetric matrix plus a shift and how many of its eigenvalues are positive.

    The shift is made a little larger where a pivot vanishes; None where no factors are accurate.
    """
    n = matrix.shape[0]
    rhs = _start(n)
    for part in _SHIFTS:
        moved = sparse.csc_matrix(matrix + part * shift * sparse.identity(n, format="csc"))
        try:
            lu = splu(moved, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        except RuntimeError:  # exactly singular
            continue
        found = lu.solve(rhs)
        left = np.abs(moved @ found - rhs).max()
        accurate = left <= _ACCURATE * (np.abs(rhs).max() + float(abs(moved).max()) * np.abs(found).max())
        if accurate and np.array_equal(lu.perm_r, lu.perm_c):
            return lu, int(np.count_nonzero(lu.U.diagonal() > 0.0))
    return None


def positive_count(matrix: Any) -> int | None:
    """Return how many eigenvalues of a sparse symmetric matrix are positive, from its pivots; None where they fail."""
    told = _factored(matrix, 0.0)
    return None if told is None else told[1]


@np.errstate(all="ignore")
def _balanced(jac: Any) -> Any:
    """Return D J D^-1, D diagonal, with rows about as large as columns: nearer to its symmetric part.

    First along a tree of entries, which makes symmetric what can be made so, then by Osborne's sweeps.
    """
    given = sparse.coo_matrix(jac)
    rows, columns = given.row, given.col
    squares = np.where(rows == columns, 0.0, given.data**2)
    powers = _along_a_tree(jac)
    for _ in range(_SWEEPS):
        found = squares * np.exp(2.0 * (powers[rows] - powers[columns]))
        out, into = (np.bincount(i, found, jac.shape[0]) for i in (rows, columns))
        told = (out > 0.0) & (into > 0.0)
        change = np.where(told, 0.125 * np.log(np.where(told, into / np.where(told, out, 1.0), 1.0)), 0.0)
        powers = powers + change
        if not np.abs(change).max() > _EVEN:
            break
    data = given.data * np.exp(powers[rows] - powers[columns])
    better = np.all(np.isfinite(data)) and np.linalg.norm(data) < np.linalg.norm(given.data)
    return sparse.csc_matrix((data, (rows, columns)), shape=jac.shape) if better else jac


def _along_a_tree(jac: Any) -> Array:
    """Return logarithms of D with D J D^-1 as large above the diagonal as below, on a tree of entries, (n,)."""
    sizes = sparse.csr_matrix(abs(jac))
    order, before = breadth_first_order(sizes, 0, directed=False)
    inner, outer = order[1:], before[order[1:]]
    own, other = (np.asarray(sizes[a, b]).ravel() for a, b in ((inner, outer), (outer, inner)))
    told = (own > 0.0) & (other > 0.0)
    changes = np.where(told, 0.5 * np.log(np.where(told, other / np.where(told, own, 1.0), 1.0)), 0.0)
    powers = np.zeros(len(order))
    for node, parent, change in zip(inner.tolist(), outer.tolist(), changes.tolist(), strict=True):
        powers[node] = powers[parent] + change
    return powers
