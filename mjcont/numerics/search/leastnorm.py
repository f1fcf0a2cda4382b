"""The shortest vector within bounds that solves linear equations, or the one that leaves the least of them.

Among all u with A u = b, low <= u <= high the one of least Euclidean norm is a least distance problem in the null space
of A: min |w| so that G w >= h. It is solved through non-negative least squares, exactly but for rounding (Lawson and
Hanson, Solving Least Squares Problems, 1974, chapter 23).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear, nnls

from mjcont.numerics.equations.algebra import singular, solve
from mjcont.numerics.equations.problem import Array

# singular values below this part of the largest are zero: forces are known to about ten digits
_RANK = 1e-9
# of a range's width, or of the vector: within this a bound is met
_ON_BOUND = 1e-9


@dataclass(frozen=True, slots=True)
class Shortest:
    """What was found.

    Attributes
    ----------
    u : (m,) the shortest solution; where there is none, that which leaves the least.
    left : (k,) b - A u.
    wanted : (m,) the shortest solution without bounds.
    left_unbounded : (k,) b - A wanted.
    """

    u: Array
    left: Array
    wanted: Array
    left_unbounded: Array


@np.errstate(all="ignore")
def least_norm(
    a: Array, b: Array, low: Array, high: Array, tol: float, metric: tuple[Array, Array] | None = None
) -> Shortest:
    """Return the shortest u within [low, high] with |b - A u| <= tol, A (k, m); bounds may be infinite.

    With `metric` (C, c), C (r, m) of full column rank, r >= m, |C u + c| is what is least instead. All is NaN where A,
    b or the metric is not finite, or C is of lower rank, or no number lies within a bound.
    """
    turn, base = np.eye(len(low)), np.zeros(len(low))
    if metric is not None:  # u = turn v + base, where |v| is least
        q, r = np.linalg.qr(metric[0])
        turn = solve(r, turn)
        base = -turn @ (q.T @ metric[1])
    turned, rest = a @ turn, b - a @ base
    if not (_finite(turn, base, turned, rest) and np.all(low < np.inf) and np.all(high > -np.inf)):
        return _undefined(len(low), len(b))
    left_vectors, sizes, right_vectors = singular(turned)
    rank = int(np.sum(sizes > _RANK * sizes.max(initial=0.0)))
    v = right_vectors[:rank].T @ ((left_vectors[:, :rank].T @ rest) / sizes[:rank])
    wanted = turn @ v + base
    over = b - a @ wanted
    if not _finite(sizes, wanted, over):  # too large for a number
        return _undefined(len(low), len(b))
    slack = _ON_BOUND * np.maximum(1.0, np.abs(wanted))
    if np.all(wanted >= low - slack) and np.all(wanted <= high + slack):
        u = np.clip(wanted, low, high)
        return Shortest(u, b - a @ u, wanted, over)
    if np.linalg.norm(over) <= tol:
        basis = turn @ right_vectors[rank:].T
        w = _least_distance(basis, wanted, low, high)
        if w is not None:
            u = np.clip(wanted + basis @ w, low, high)
            if np.linalg.norm(b - a @ u) <= max(tol, _ON_BOUND * float(np.linalg.norm(b))):
                return Shortest(u, b - a @ u, wanted, over)
    try:
        u = lsq_linear(a, b, (low, np.maximum(high, np.nextafter(low, np.inf))), tol=1e-14).x
    except (np.linalg.LinAlgError, ValueError):  # sums of squares too large for a number
        u = np.full(len(low), np.nan)
    return Shortest(u, b - a @ u, wanted, over)


def _finite(*arrays: Array) -> bool:
    return all(bool(np.isfinite(a).all()) for a in arrays)


def _undefined(m: int, k: int) -> Shortest:
    u, left = np.full(m, np.nan), np.full(k, np.nan)
    return Shortest(u, left, u.copy(), left.copy())


def _least_distance(basis: Array, base: Array, low: Array, high: Array) -> Array | None:
    """Return the shortest w with low <= base + basis w <= high, None if there is none."""
    below, above = np.isfinite(low), np.isfinite(high)
    g = np.vstack([basis[below], -basis[above]])
    h = np.concatenate([(low - base)[below], (base - high)[above]])
    size = max(float(np.abs(h).max(initial=0.0)), 1e-300)
    e = np.vstack([g.T, h / size])
    target = np.zeros(len(e))
    target[-1] = 1.0
    if not _finite(e):  # SciPy writes where it may not, or does not return
        return None
    try:
        z, distance = nnls(e, target)
    except RuntimeError:  # too many steps: no answer is known
        return None
    if distance <= _RANK:
        return None
    r = e @ z - target
    found: Array = -size * r[:-1] / r[-1]
    return found
