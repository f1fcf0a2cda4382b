"""Pseudo-arclength continuation: one step, and the loop that repeats it.

The stepper predicts on Hermite's polynomial through the last points with their tangents and corrects orthogonally to
the tangent. Steps are chosen from the contraction of the corrector and from the angle between successive tangents; a
step is refused when the tangent turns too far or the corrector wanders, so that a neighbouring branch is not jumped to.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import brentq

from mjcont.numerics.bordered import Factored, border, null_vectors
from mjcont.numerics.hermite import arc, combine, hermite, lagrange
from mjcont.numerics.newton import Corrected, correct, length, undefined, with_row
from mjcont.numerics.problem import Array
from mjcont.numerics.settings import Settings
from mjcont.numerics.system import Local, System

_WANDER = 0.5
_CONTRACTION = 0.1
_GROWTH = 2.0
# a parameter that moves by less along the tangent has no direction: the start is a fold, and noise would decide
_AT_FOLD = 1e-5
_PAST = 4
# part of the smaller of its slopes at two points to which a function's slope may fall between them, where it is not far
# below the larger one
_DIP, _FAR_BELOW = 0.7, 0.1
# points nearer to each other than this part of a step, or this far, are a cluster
_CLUSTER, _NOISY = 0.2, 1e-5
# how far behind a start the points lie from which the other direction is predicted
_BEHIND = 0.16
# the contraction of the last corrector counts as this many times worse for the next
_TRUST = 3.0


@dataclass(frozen=True, slots=True)
class Earlier:
    """A point before another on the same curve.

    Attributes
    ----------
    s : its arclength.
    step : (n + k,) scaled step to it from the later point.
    tangent, jac : as in `CurvePoint`.
    """

    s: float
    step: Array
    tangent: Array
    jac: Any


@dataclass(slots=True)
class CurvePoint:
    """A point of a curve.

    Attributes
    ----------
    x, y : state and (free parameters, auxiliary unknowns) as coordinates.
    tangent : (n + k,) unit tangent in scaled unknowns, in the direction of travel.
    sign : sign of det [G_z; t], which changes at simple branch points and nowhere else.
    local : the evaluation there.
    jac : G_z there, in scaled unknowns, (n + k - 1, n + k).
    s : arclength from the start of its direction.
    error : scaled residual.
    angle : turning of the tangent since the last point, rad.
    rate : contraction of the corrector's last step.
    past : up to four points before (one on a locus), the latest first.
    extra : what detectors keep of the point (test values, spectrum).
    """

    x: Array
    y: Array
    tangent: Array
    sign: float
    local: Local
    jac: Any
    s: float = 0.0
    error: float = 0.0
    angle: float = 0.0
    contraction: float = 0.0
    iterations: int = 0
    rate: float = math.inf
    past: tuple[Earlier, ...] = ()
    extra: dict[str, Any] = field(default_factory=dict)


def point_from(c: Corrected, reference: Array, s: float) -> CurvePoint:
    """Return the curve point of a corrected one; the tangent makes an acute angle with `reference`."""
    assert c.factored is not None
    tangent = c.factored.last_column()
    along = float(tangent @ reference)
    tangent *= math.copysign(1.0, along) / math.sqrt(tangent @ tangent)
    cosine = min(max(float(tangent @ reference), -1.0), 1.0)
    # with the row r, the tangent is z / |z| for [G_z; r] z = e, so that det [G_z; t] = |z| det [G_z; r]
    sign = c.factored.sign * math.copysign(1.0, along)
    return CurvePoint(
        c.x, c.y, tangent, sign, c.local, c.jac, s, c.error, math.acos(cosine), c.contraction, c.iterations, c.rate
    )


def first_point(
    system: System, x: Array, y: Array, direction: float, settings: Settings, lead: int = 0
) -> CurvePoint | str:
    """Return the point of the curve nearest to (x, y), the free parameter `lead` growing for direction > 0.

    Returns a sentence where the corrector fails.
    """
    tangent = tangent_at(system, system.local(x, y), y)
    if np.any(np.isnan(tangent)):
        return undefined(system)
    lead += system.n
    row = tangent
    if abs(tangent[lead]) > 1e-3:  # keeps the parameter at the start's value exactly
        row = np.zeros_like(tangent)
        row[lead] = 1.0
    c = correct(system, x, y, row, None, settings)
    if c.failure:
        return c.failure
    component = tangent[lead] if abs(tangent[lead]) > _AT_FOLD else tangent[np.argmax(np.abs(tangent))]
    return point_from(c, tangent if component * direction > 0 else -tangent, 0.0)


def tangent_at(system: System, local: Local, y: Array) -> Array:
    """Return a unit tangent (n + k,) of the curve through a point near it; NaN where f has no derivatives."""
    jac = system.jacobian(local, y)
    size = system.n + system.k
    if isinstance(jac, np.ndarray):
        if not np.all(np.isfinite(jac)):
            return np.full(size, np.nan)
        rows = 1.0 / np.maximum(np.abs(jac).max(axis=1), 1e-300)
        return null_vectors(rows[:, None] * jac, 0)[0][:, 0]
    best: Array | None = None
    for i in (size - 1, 0):
        row = np.zeros((1, size))
        row[0, i] = 1.0
        t = Factored(border(jac, np.zeros((size - 1, 0)), row)).solve(np.append(np.zeros(size - 1), 1.0))
        if np.all(np.isfinite(t)) and (best is None or np.linalg.norm(t) < np.linalg.norm(best)):
            best = t
    return np.full(size, np.nan) if best is None else best / np.linalg.norm(best)


def predict(point: CurvePoint, h: float) -> Array:
    """Return the scaled step to the point h ahead on Hermite's polynomial through the last points and their tangents.

    With bushes of stiffness k a prediction that opens the pins by d loads them with k d, so a high order is what
    allows long steps with stiff joints.
    """
    past = _apart(point, h)
    if not past:
        return h * point.tangent
    values, slopes = hermite([0.0, *(e.s - point.s for e in past)], h)
    steps, tangents = (e.step for e in past), (e.tangent for e in past)
    return combine([*slopes, *values[1:]], [point.tangent, *tangents, *steps])


def _apart(point: CurvePoint, h: float) -> list[Earlier]:
    """Return the last point and those before it that are far enough apart: a polynomial through a cluster is noise."""
    chosen = list(point.past[:1])
    for e in point.past[1:]:
        if chosen[-1].s - e.s >= max(_CLUSTER * h, _NOISY):
            chosen.append(e)
    return chosen


def _matrix_ahead(point: CurvePoint, h: float) -> Array:
    """Return G_z extrapolated to a step h ahead by the polynomial through the last points.

    Bushes turn with the mechanism: the last point's derivatives are off by stiffness times angle at the next one.
    """
    past = _apart(point, h)
    if not past:
        return point.jac
    return combine(lagrange([0.0, *(e.s - point.s for e in past)], h), [point.jac, *(e.jac for e in past)])


def remembered(point: CurvePoint, step: Array) -> tuple[Earlier, ...]:
    """Return the past of a point that lies a scaled step from `point`."""
    older = (Earlier(e.s, e.step - step, e.tangent, e.jac) for e in point.past[: _PAST - 1])
    return (Earlier(point.s, -step, point.tangent, point.jac), *older)


def advance(
    system: System, point: CurvePoint, h: float, settings: Settings, *, fresh: bool = False
) -> CurvePoint | str:
    """Return the next point a step h along the curve, or a sentence that says why the step is refused.

    `fresh` takes derivatives at the prediction instead of those of the last point: dearer, but with stiff bushes
    the soft direction turns by more than the last point's derivatives can tell.
    """
    prediction = system.admissible(point.x, predict(point, h))
    x, y = system.move(point.x, point.y, prediction)
    local = system.local(x, y)
    fresh = fresh and not _beyond_a_kink(system, point, local)
    extrapolated = not (fresh or system.conditions or sparse.issparse(point.jac))
    expected = _TRUST * point.rate if extrapolated and len(point.past) == _PAST else math.inf
    lu = None if fresh else Factored(with_row(_matrix_ahead(point, h) if extrapolated else point.jac, point.tangent))
    c = correct(system, x, y, point.tangent, lu, settings, expected, _WANDER * abs(h), local)
    if c.failure:
        return c.failure
    chord = system.difference(c.x, c.y, point.x, point.y)
    wandered = length(chord - prediction)
    if wandered > _WANDER * abs(h):
        return "the corrector wandered off the prediction"
    new = point_from(c, point.tangent, point.s)
    new.s += length(chord) if system.conditions else arc(length(chord), math.cos(new.angle))
    new.past = remembered(point, chord)[: 1 if system.conditions else _PAST]
    if new.angle > settings.angle_max:
        return f"the tangent turns by more than {math.degrees(settings.angle_max):.0f} deg"
    return new


def _beyond_a_kink(system: System, point: CurvePoint, local: Local) -> bool:
    """Whether an evaluation lies on another smooth piece of f than a point: its derivatives are not the curve's."""
    return bool(getattr(system.problem, "nonsmooth", False)) and local.piece != point.local.piece


def next_step(h: float, new: CurvePoint, settings: Settings, growth: float = _GROWTH) -> float:
    """Return the next step from the turning angle and the contraction seen."""
    by_angle = settings.angle / max(new.angle, 1e-3 * settings.angle)
    return min(h * min(by_angle, by_contraction(new, growth), growth), settings.ds_max)


def _slope(system: System, old: CurvePoint, new: CurvePoint, index: int) -> tuple[float, float, float]:
    """Return a, p, q of the slope a + 2 p t + q t^2 of y[index] on the cubic through two points, t from 0 to 1."""
    i = system.n + index
    a, b = float(old.tangent[i]), float(new.tangent[i])
    mean = float(system.difference(new.x, new.y, old.x, old.y)[i]) / (new.s - old.s)
    return a, 3.0 * mean - 2.0 * a - b, 3.0 * (a + b - 2.0 * mean)


def may_turn_twice(system: System, old: CurvePoint, new: CurvePoint, index: int) -> bool:
    """Whether y[index] could have two extrema between points at which it moves the same way.

    Judged on the cubic through both points with their tangents, whose slope is to have no minimum far below those at
    both points (none at all where one is far below the other), and on the point before: the slope at `old` is not to
    be far below those on both sides.
    """
    i = system.n + index
    a, b = float(old.tangent[i]), float(new.tangent[i])
    if a * b <= 0 or new.s <= old.s:
        return False
    slopes = [float(old.past[0].tangent[i]), a, b] if old.past else [a, b]
    values = np.array([0.0, float(system.difference(new.x, new.y, old.x, old.y)[i])])
    twice = pairs_may_turn_twice(np.array([a, b]), values, np.array([old.s, new.s]))
    return bool(twice[0] or dips(np.array(slopes)).any())


def pairs_may_turn_twice(slopes: Array, values: Array, s: Array) -> Array:
    """Return `may_turn_twice` for pairs of successive points of a function with slopes and values at arclengths s."""
    a, b, mean = slopes[:-1], slopes[1:], np.diff(values) / np.diff(s)
    p, q = 3.0 * mean - 2.0 * a - b, 3.0 * (a + b - 2.0 * mean)
    t = -p / np.where(q != 0.0, q, np.inf)
    small, large = np.minimum(np.abs(a), np.abs(b)), np.maximum(np.abs(a), np.abs(b))
    floor = np.where(small < _FAR_BELOW * large, 1.0, _DIP) * small
    return (a * b > 0.0) & (t > 0.0) & (t < 1.0) & ((a + p * t) * np.sign(a) < floor)


def dips(slopes: Array) -> Array:
    """Return for each slope but the first and the last whether it is far below those on both sides."""
    size, same = np.abs(slopes), slopes[1:] * slopes[:-1] > 0.0
    return same[1:] & same[:-1] & (size[1:-1] < _FAR_BELOW * np.minimum(size[:-2], size[2:]))


def turning_fraction(system: System, old: CurvePoint, new: CurvePoint, index: int) -> float:
    """Return where in a step y[index] turns, on the cubic through both points with their tangents."""
    a, p, q = _slope(system, old, new, index)
    root = math.sqrt(max(p * p - a * q, 0.0))
    candidates = [a / d for d in (-p - root, -p + root) if d]  # the roots of a + 2 p t + q t^2, without cancellation
    inside = [t for t in candidates if 0.0 <= t <= 1.0]
    return inside[0] if len(inside) == 1 else 0.5


def by_contraction(new: CurvePoint, growth: float = _GROWTH) -> float:
    """Return the factor by which the contraction of the corrector lets the step grow."""
    return math.sqrt(_CONTRACTION / max(new.contraction, 1e-3)) if new.iterations > 1 else growth


def turned_back(system: System, points: Sequence[CurvePoint]) -> CurvePoint:
    """Return the first of a curve's points as the start of the other direction, those behind it as its past."""
    start = points[0]
    firm = [p for p in points[1:] if "interior" not in p.extra and p.s <= _BEHIND]
    chosen = [firm[(len(firm) - 1) // 2], firm[-1]] if len(firm) > 1 else firm
    past = tuple(Earlier(-p.s, system.difference(p.x, p.y, start.x, start.y), -p.tangent, p.jac) for p in chosen)
    return CurvePoint(
        start.x, start.y, -start.tangent, -start.sign, start.local, start.jac, 0.0, start.error, past=past
    )


def land(
    system: System, point: CurvePoint, beyond: CurvePoint, index: int, target: float, settings: Settings
) -> CurvePoint | str:
    """Return the point between two at which y[index] = target, sought on the cubic through both."""
    row = np.zeros(system.n + system.k)
    row[system.n + index] = 1.0
    chord = system.difference(beyond.x, beyond.y, point.x, point.y)
    span = beyond.s - point.s

    def step(t: float) -> Array:
        values, slopes = hermite([0.0, 1.0], t)
        return values[1] * chord + span * (slopes[0] * point.tangent + slopes[1] * beyond.tangent)

    missing = target - float(point.y[index])
    ends = (-missing, float(step(1.0)[system.n + index]) - missing)
    t = brentq(lambda t: float(step(t)[system.n + index]) - missing, 0.0, 1.0) if ends[0] * ends[1] < 0 else 0.0
    x, y = system.move(point.x, point.y, step(t))
    y = y.copy()
    y[index] = target
    c = correct(system, x, y, row, None, settings)
    if c.failure:
        return c.failure
    new = point_from(c, point.tangent, point.s)
    chord = system.difference(c.x, c.y, point.x, point.y)
    new.s += arc(length(chord), math.cos(new.angle))
    new.past = remembered(point, chord)
    return new


def land_beside(
    system: System, point: CurvePoint, index: int, target: float, settings: Settings
) -> CurvePoint | str:
    """Return the point of the curve at which y[index] = target, a hair away from one of its points."""
    row = np.zeros(system.n + system.k)
    row[system.n + index] = 1.0
    y = point.y.copy()
    y[index] = target
    c = correct(system, point.x, y, row, None, settings)
    if c.failure:
        return c.failure
    new = point_from(c, point.tangent, point.s)
    new.s += length(system.difference(c.x, c.y, point.x, point.y))
    return new
