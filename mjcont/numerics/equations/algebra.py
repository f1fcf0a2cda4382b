"""Dense linear algebra that is defined for every matrix: what LAPACK refuses is NaN.

NumPy raises `LinAlgError` for a singular matrix, for one that holds NaN or infinity, and where an iteration does not
converge. Along a curve each of these is met sooner or later and means that a step, a test or a coefficient has no value
there. The rest of `mjcont.numerics` calls these functions, and no other that raises.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import brentq

from mjcont.numerics.equations.problem import Array


def solve(matrix: Array, rhs: Array) -> Array:
    """Return the solution of A z = rhs; NaN where A is singular, of a stack (m, k, k) for those that are."""
    if matrix.ndim < 3:
        return _defined(np.linalg.solve, matrix, rhs, like=rhs)
    try:
        return np.linalg.solve(matrix, rhs)
    except np.linalg.LinAlgError:
        return np.array([solve(a, b) for a, b in zip(matrix, rhs, strict=True)])


def solve_each(matrices: Array, rhs: Array) -> Array:
    """Return the solutions of A z = rhs for matrices (m, k, k) and vectors (m, k), NaN for singular ones."""
    return solve(matrices, rhs[..., None])[..., 0]


def determinant_signs(matrices: Array) -> Array:
    """Return the signs of the determinants of matrices (m, k, k): 0 for singular ones, NaN where they hold NaN."""
    found: Array = np.linalg.slogdet(matrices)[0]
    return found


def inverses(matrices: Array) -> Array:
    """Return the inverses of matrices (m, k, k), NaN for singular ones."""
    return _each(np.linalg.inv, matrices, like=matrices)


def kernels(matrices: Array) -> Array:
    """Return orthonormal vectors (m, l - k, l) that matrices (m, k, l) take to zero, l > k; NaN where they have none.

    Rows count alike, whatever their size.
    """
    sizes = np.abs(matrices).max(axis=2, initial=0.0)[:, :, None]
    found: Array = singular(matrices / np.where(sizes > 0.0, sizes, 1.0))[2][:, matrices.shape[1] :]
    return found


def least_squares(matrix: Array, rhs: Array) -> Array:
    """Return the shortest z with the least |A z - rhs|; NaN where A or rhs is not finite."""
    columns = np.full((matrix.shape[1], *rhs.shape[1:]), np.nan)
    if not (np.isfinite(matrix).all() and np.isfinite(rhs).all()):  # LAPACK would print a complaint
        return columns
    return _defined(lambda a, b: np.linalg.lstsq(a, b, rcond=None)[0], matrix, rhs, like=columns)


def singular(matrix: Array) -> tuple[Array, Array, Array]:
    """Return u, sigma, vt of the singular value decomposition of a matrix (m, n) or a stack; NaN where it has none."""
    try:
        return np.linalg.svd(matrix)
    except np.linalg.LinAlgError:
        if matrix.ndim > 2:
            u, sigma, vt = (np.array(parts) for parts in zip(*map(singular, matrix), strict=True))
            return u, sigma, vt
        m, n = matrix.shape
        u, vt = (np.full((k, k), np.nan, dtype=matrix.dtype) for k in (m, n))
        return u, np.full(min(m, n), np.nan), vt


def eigenvalues(matrix: Array) -> Array:
    """Return the eigenvalues of a matrix (n, n) or a stack, complex; NaN where it has none."""
    return _stacked(np.linalg.eigvals, matrix).astype(complex)


def symmetric_eigenvalues(matrix: Array) -> Array:
    """Return the eigenvalues, in order, of a symmetric matrix (n, n) or a stack; NaN where it has none."""
    return _stacked(np.linalg.eigvalsh, matrix)


def eigenvectors(matrix: Array) -> tuple[Array, Array]:
    """Return eigenvalues (n,) and eigenvectors in columns (n, n), or stacks of them; NaN where there are none."""
    try:
        values, vectors = np.linalg.eig(matrix)
    except np.linalg.LinAlgError:
        if matrix.ndim > 2:
            every = [eigenvectors(one) for one in matrix]
            return np.array([v for v, _ in every]), np.array([v for _, v in every])
        return np.full(len(matrix), np.nan, dtype=complex), np.full(matrix.shape, np.nan, dtype=complex)
    return values, vectors


def cholesky(matrices: Array) -> Array:
    """Return the lower factors of symmetric matrices (m, k, k), NaN where one is not positive definite."""
    return _each(np.linalg.cholesky, matrices, like=matrices)


def _defined(function: Callable[..., Array], *given: Array, like: Array) -> Array:
    """Return a function's value, or NaN in the shape of `like`."""
    try:
        return function(*given)
    except np.linalg.LinAlgError:
        return np.full(like.shape, np.nan, dtype=np.result_type(*given, float))


def _each(function: Callable[[Array], Array], matrices: Array, like: Array) -> Array:
    """Return a function of a stack, NaN for those of its matrices for which it is not defined."""
    try:
        return function(matrices)
    except np.linalg.LinAlgError:
        return np.array([_defined(function, one, like=part) for one, part in zip(matrices, like, strict=True)])


def _stacked(function: Callable[[Array], Any], matrix: Array) -> Array:
    """Return eigenvalues of a matrix or a stack, NaN for those that have none."""
    if matrix.ndim == 2:
        return _defined(function, matrix, like=matrix[0])
    return _each(function, matrix, like=matrix[:, 0])


def root(function: Callable[[float], float], low: float, high: float, tolerance: float = 2e-12) -> float:
    """Return where a function vanishes between two places (Brent); NaN where its signs there are equal.

    Also where it raises ValueError. SciPy wraps the function in one that refers to itself, so that what it knows would
    be held, a whole mechanism perhaps, until cycles are looked for.
    """
    held = [function]
    try:
        return float(brentq(lambda at: held[0](at), low, high, xtol=tolerance))  # noqa: PLW0108
    except ValueError:
        return float("nan")
    finally:
        held.clear()
