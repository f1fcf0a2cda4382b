"""Where a free parameter turns between two points of a curve, and whether it could turn twice or leave its bounds.

Judged on the cubic through both points with their tangents, and where that cannot tell, on the curve itself.
"""

from __future__ import annotations

import math

import numpy as np

from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.newton import with_row
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note

# part of the smaller of its slopes at two points to which a function's slope may fall between them, where it is not
# farther below the larger one than this; distance at which the curve is asked how it turns
_DIP, _FAR_BELOW, _PROBE = 0.7, 0.1, 1e-3

_TURNING_RATE = Note[Array]()


def _slope(system: System, old: CurvePoint, new: CurvePoint, index: int) -> tuple[float, float, float]:
    """Return a, p, q of the slope a + 2 p t + q t^2 of y[index] on the cubic through two points, t from 0 to 1."""
    i = system.n + index
    a, b = float(old.tangent[i]), float(new.tangent[i])
    mean = float(system.difference(new.x, new.y, old.x, old.y)[i]) / (new.s - old.s)
    return a, 3.0 * mean - 2.0 * a - b, 3.0 * (a + b - 2.0 * mean)


def may_turn_twice(system: System, old: CurvePoint, new: CurvePoint, index: int) -> bool:
    """Whether y[index] could have two extrema between points at which it moves the same way.

    Where its slopes at both points are of a size, the cubic through both with their tangents decides: its slope is to
    have no minimum far below them. Where one is far below the other the cubic errs by more than that slope, and the
    curve itself is asked whether its slope falls further from there.
    """
    i = system.n + index
    slopes = np.array([old.tangent[i], new.tangent[i]])
    if new.s <= old.s:
        return False
    if far_below(slopes)[0]:
        return falls_between(system, old, new, index)
    values = np.array([0.0, float(system.difference(new.x, new.y, old.x, old.y)[i])])
    return bool(pairs_may_turn_twice(slopes, values, np.array([old.s, new.s]))[0])


def far_below(slopes: Array) -> Array:
    """Return for each pair of successive slopes whether they have one sign and one is far below the other."""
    size = np.abs(slopes)
    small, large = np.minimum(size[:-1], size[1:]), np.maximum(size[:-1], size[1:])
    return (slopes[1:] * slopes[:-1] > 0.0) & (small < _FAR_BELOW * large)


def pairs_may_turn_twice(slopes: Array, values: Array, s: Array) -> Array:
    """Return for pairs of successive points of a function, its slopes and values at arclengths s, `may_turn_twice`.

    Pairs with one slope far below the other are left to `falls_between`.
    """
    a, b, mean = slopes[:-1], slopes[1:], np.diff(values) / np.diff(s)
    p, q = 3.0 * mean - 2.0 * a - b, 3.0 * (a + b - 2.0 * mean)
    t = -p / np.where(q != 0.0, q, np.inf)
    floor = _DIP * np.minimum(np.abs(a), np.abs(b))
    decided = (a * b > 0.0) & ~far_below(slopes)
    return decided & (t > 0.0) & (t < 1.0) & ((a + p * t) * np.sign(a) < floor)


def falls_between(system: System, old: CurvePoint, new: CurvePoint, index: int = 0) -> bool:
    """Whether the slope of y[index], far smaller at one of two points, falls further from there to the other."""
    i = system.n + index
    (low, way) = (old, 1.0) if abs(old.tangent[i]) < abs(new.tangent[i]) else (new, -1.0)
    return bool(way * _turning_rate(system, low)[i] * low.tangent[i] < 0.0)


def _turning_rate(system: System, point: CurvePoint) -> Array:
    """Return the derivative of the tangent along the curve, (n + k,): from G_zz(t, t) by differences."""

    def find() -> Array:
        ahead, here, behind = (
            system.local(*system.move(point.x, point.y, h * point.tangent)).f for h in (_PROBE, 0.0, -_PROBE)
        )
        bent = np.append((ahead - 2.0 * here + behind) / _PROBE**2, 0.0)
        return -Factored(with_row(point.jac, point.tangent)).solve(bent)

    return _TURNING_RATE.of(point, find)


def turning_fraction(system: System, old: CurvePoint, new: CurvePoint, index: int) -> float:
    """Return where in a step y[index] turns, on the cubic through both points with their tangents."""
    a, p, q = _slope(system, old, new, index)
    root = math.sqrt(max(p * p - a * q, 0.0))
    candidates = [a / d for d in (-p - root, -p + root) if d]  # the roots of a + 2 p t + q t^2, without cancellation
    inside = [t for t in candidates if 0.0 <= t <= 1.0]
    return inside[0] if len(inside) == 1 else 0.5


def may_turn_beyond(system: System, old: CurvePoint, new: CurvePoint) -> bool:
    """Whether a free parameter may leave its bounds and come back between two points within them.

    Judged on the cubic through both, which is not trusted by more than what it goes beyond the points.
    """
    for i in range(len(system.free)):
        a, b = float(old.tangent[system.n + i]), float(new.tangent[system.n + i])
        if a * b >= 0.0:
            continue
        bound = system.highest[i] if a > 0.0 else system.lowest[i]
        _, p, q = _slope(system, old, new, i)
        t = turning_fraction(system, old, new, i)
        ahead = abs((a + (p + q * t / 3.0) * t) * t * (new.s - old.s))
        if abs(bound - old.y[i]) <= 2.0 * ahead:
            return True
    return False
