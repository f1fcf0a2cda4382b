"""Linear solves with (n+k) x (n+k) matrices, dense or sparse, that also tell the sign of the determinant."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import lapack
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu

from mjcont.numerics.equations.algebra import singular
from mjcont.numerics.equations.columns import bordered, largest_entries, scaled
from mjcont.numerics.equations.problem import Array

_TINY = 1e-300
# part of a vector's largest component from which on another one is as large
AS_LARGE = 0.99
# part of a sparse matrix's entries that have a partner across the diagonal, and least pivot in parts of its column
_PAIRED, _PIVOT = 0.9, 0.1


def largest_in_rows(matrix: Any) -> Array:
    """Return the largest absolute value in each row, (m,)."""
    if not isinstance(matrix, np.ndarray):
        return largest_entries(matrix)
    found: Array = np.abs(matrix).max(axis=1)
    return found


def row_scale(matrix: Any, guard: float = 1e-8) -> Array:
    """Return 1 / (largest entry of each row), rows below `guard` of the largest counting as that large, (m,)."""
    largest = largest_in_rows(matrix)
    top = float(largest.max()) if largest.size else 1.0
    return 1.0 / np.maximum(largest, max(guard * top, _TINY))


class Factored:
    """LU factors of a square matrix, rows equilibrated: a vanishing pivot is replaced by a tiny one."""

    def __init__(self, matrix: Any) -> None:
        self._rows = row_scale(matrix)
        self._sparse = sparse.issparse(matrix)
        if self._sparse:
            balanced = scaled(matrix, self._rows)
            self._lu, self._singular = sparse_factors(balanced), False
            if self._lu is None:
                shift = 1e-14 * sparse.identity(balanced.shape[0], format="csc")
                self._lu, self._singular = sparse_factors(sparse.csc_matrix(balanced + shift)), True
        else:
            self._lu, self._pivots, info = lapack.dgetrf(self._rows[:, None] * matrix)
            self._singular = info > 0
            if self._singular:
                pivots = self._lu.diagonal()
                self._lu[pivots == 0.0, pivots == 0.0] = 1e-16

    @property
    def sign(self) -> float:
        """Sign of the determinant (0 where a pivot vanished)."""
        if self._singular:
            return 0.0
        if self._sparse:
            negative = np.count_nonzero(self._lu.U.diagonal() < 0)
            return _parity(self._lu.perm_r) * _parity(self._lu.perm_c) * (1.0 - 2.0 * (negative % 2))
        swaps = sum(i != p for i, p in enumerate(self._pivots.tolist()))
        return 1.0 - 2.0 * (int(swaps + np.count_nonzero(self._lu.diagonal() < 0.0)) % 2)

    def solve(self, rhs: Array) -> Array:
        """Return the solution of A z = rhs."""
        scaled = self._rows * rhs if rhs.ndim == 1 else self._rows[:, None] * rhs
        if self._sparse:
            return self._solve_sparse(scaled)
        found: Array = lapack.dgetrs(self._lu, self._pivots, scaled)[0]
        return found

    def last_column(self) -> Array:
        """Return the last column of the inverse, up to a positive factor: z with A z = e, e the last unit vector."""
        rhs = np.zeros(len(self._rows))
        rhs[-1] = 1.0
        return self._solve_sparse(rhs) if self._sparse else lapack.dgetrs(self._lu, self._pivots, rhs)[0]

    def solve_transposed(self, rhs: Array) -> Array:
        """Return the solution of A^T z = rhs."""
        if self._sparse:
            return self._rows * self._solve_sparse(rhs, trans="T")
        found: Array = self._rows * lapack.dgetrs(self._lu, self._pivots, rhs, trans=1)[0]
        return found

    def _solve_sparse(self, rhs: Array, trans: str = "N") -> Array:
        """Return the solution with the sparse factors; NaN where there are none."""
        return np.full(rhs.shape, np.nan) if self._lu is None else self._lu.solve(rhs, trans=trans)


def sparse_factors(matrix: Any) -> Any:
    """Return SuperLU's factors of a sparse matrix, None where a pivot vanishes or is no number.

    Where most entries have a partner across the diagonal, as on a grid, pivots that are not small beside their column
    are taken on the diagonal: that fills in several times less.
    """
    given = matrix.tocsc()
    pattern = sparse.csc_matrix((np.ones(given.nnz, dtype=bool), given.indices, given.indptr), shape=given.shape)
    paired = pattern.multiply(pattern.T).nnz >= _PAIRED * given.nnz
    options = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": _PIVOT} if paired else {}
    try:
        return splu(given, **options)
    except RuntimeError:
        return None


def _parity(permutation: Array) -> float:
    """Return +1 for an even permutation, -1 for an odd one."""
    count = len(permutation)
    steps = sparse.csr_matrix((np.ones(count), permutation, np.arange(count + 1)), shape=(count, count))
    cycles = int(connected_components(steps, directed=False, return_labels=False))
    return -1.0 if (count - cycles) % 2 else 1.0


def border(matrix: Any, columns: Array, rows: Array, corner: Array | None = None) -> Any:
    """Return [[A, B], [C, D]] with columns B (m, k), rows C (l, n) and corner D (l, k), zero by default."""
    corner = np.zeros((rows.shape[0], columns.shape[1])) if corner is None else corner
    if sparse.issparse(matrix):
        return bordered(matrix, columns, rows, corner)
    m, n = matrix.shape
    out = np.empty((m + rows.shape[0], n + columns.shape[1]))
    out[:m, :n], out[:m, n:], out[m:, :n], out[m:, n:] = matrix, columns, rows, corner
    return out


def oriented(v: Array) -> Array:
    """Return a vector of either sign, or any phase, turned so that the first of its largest components is positive.

    Components nearly as large as the largest count as such: rounding may choose between them.
    """
    sizes = np.abs(v)
    first = v[np.argmax(sizes >= AS_LARGE * sizes.max())]
    return v * (np.conj(first) / abs(first)) if first else v


def null_pair(matrix: Any) -> tuple[Array, Array]:
    """Return unit vectors v, w with A v and w' A nearly zero, by inverse iteration from a fixed start."""
    factored = Factored(matrix)
    v = np.cos(1.0 + np.arange(matrix.shape[0], dtype=float)).astype(matrix.dtype)
    w = v
    for _ in range(3):
        w = factored.solve_transposed(np.conj(v))
        w = w / np.linalg.norm(w)
        v = factored.solve(np.conj(w))
        v = v / np.linalg.norm(v)
    return v, w


def null_vectors(matrix: Any, count: int = 1) -> tuple[Array, Array]:
    """Return the right (n, count) and left (m, count) singular vectors of the smallest singular values.

    `matrix` is m x n with n >= m; for n > m the right space includes the kernel (count + n - m columns). Sparse
    square matrices use inverse iteration on A A^T from a fixed start.
    """
    if not sparse.issparse(matrix):
        u, _, vt = singular(matrix)
        m, n = matrix.shape
        return vt[n - count - (n - m) :].T[:, ::-1].copy(), u[:, m - count :][:, ::-1].copy()
    n = matrix.shape[0]
    factored = Factored(matrix)
    v = np.cos(1.0 + np.arange(n * count, dtype=float)).reshape(n, count)
    w = v
    for _ in range(4):
        w = np.linalg.qr(np.column_stack([factored.solve_transposed(c) for c in v.T]))[0]
        v = np.linalg.qr(np.column_stack([factored.solve(c) for c in w.T]))[0]
    return v, w
