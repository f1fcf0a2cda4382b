"""Sparse matrices in compressed columns: scaled, bordered and mixed by their arrays, without other formats on the way.

Zeros of borders are entries like others, so that bordered matrices of one pattern have one pattern.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.problem import Array


def largest_entries(matrix: Any) -> Array:
    """Return the largest absolute value in each row of a sparse matrix, (m,)."""
    given = matrix.tocsc()
    found = np.zeros(given.shape[0])
    np.maximum.at(found, given.indices, np.abs(given.data))
    return found


def scaled(matrix: Any, rows: Array | None = None, columns: Array | None = None) -> Any:
    """Return a sparse matrix with its rows times `rows` (m,) and its columns times `columns` (n,)."""
    given = matrix.tocsc()
    data = given.data if rows is None else given.data * rows[given.indices]
    if columns is not None:
        data = data * np.repeat(columns, np.diff(given.indptr))
    return _like(given, data)


def weighted(matrix: Any, rows: Array | None = None, columns: Array | None = None) -> Any:
    """Return `scaled` of a sparse matrix, and the same of a dense one."""
    if not isinstance(matrix, np.ndarray):
        return scaled(matrix, rows, columns)
    found = matrix if rows is None else rows[:, None] * matrix
    return found if columns is None else found * columns


def bordered(matrix: Any, columns: Array, rows: Array, corner: Array) -> Any:
    """Return [[A, B], [C, D]] for sparse A (m, n) and dense B (m, k), C (l, n), D (l, k)."""
    given = matrix.tocsc()
    (m, n), k, below, count = given.shape, columns.shape[1], len(rows), given.nnz
    pointers = np.concatenate([
        given.indptr + below * np.arange(n + 1), count + below * n + (m + below) * np.arange(1, k + 1)
    ])
    total = int(pointers[-1])
    data, indices = np.empty(total, np.result_type(given.data, columns, rows, corner)), np.empty(total, np.int32)
    old = np.arange(count) + below * np.repeat(np.arange(n), np.diff(given.indptr))
    new = pointers[1 : n + 1, None] - below + np.arange(below)
    data[old], indices[old] = given.data, given.indices
    data[new], indices[new] = rows.T, m + np.arange(below)
    data[count + below * n :] = np.vstack([columns, corner]).T.ravel()
    indices[count + below * n :] = np.tile(np.arange(m + below), k)
    return sparse.csc_matrix((data, indices, pointers), shape=(m + below, n + k))


def weighted_sum(weights: Sequence[float], matrices: Sequence[Any]) -> Any:
    """Return the sum of weights times sparse matrices."""
    first, *others = (m.tocsc() for m in matrices)
    if all(_same_pattern(first, other) for other in others):
        data = sum(w * other.data for w, other in zip(weights[1:], others, strict=True)) + weights[0] * first.data
        return _like(first, data)
    return sum(w * other for w, other in zip(weights[1:], others, strict=True)) + weights[0] * first


def _like(matrix: Any, data: Array) -> Any:
    """Return a matrix of the same pattern with other entries."""
    return sparse.csc_matrix((data, matrix.indices, matrix.indptr), shape=matrix.shape)


def _same_pattern(one: Any, other: Any) -> bool:
    return one.nnz == other.nnz and np.array_equal(one.indptr, other.indptr) and np.array_equal(
        one.indices, other.indices
    )
