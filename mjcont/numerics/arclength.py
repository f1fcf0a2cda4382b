"""Pseudo-arclength continuation: one step, and the loop that repeats it.

The stepper predicts on the cubic through the last two points with their tangents and corrects orthogonally to the
tangent. Steps are chosen from the contraction of the corrector and from the angle between successive tangents; a step
is refused when the tangent turns too far or the corrector wanders, so that a neighbouring branch is not jumped to.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.bordered import Factored, border, null_vectors
from mjcont.numerics.newton import Corrected, correct, length, undefined, with_row
from mjcont.numerics.problem import Array
from mjcont.numerics.settings import Settings
from mjcont.numerics.system import Local, System

_WANDER = 0.5
_CONTRACTION = 0.1
_GROWTH = 2.0
# a parameter that moves by less along the tangent has no direction: the start is a fold, and noise would decide
_AT_FOLD = 1e-5
_PAST = 2
# the contraction of the last corrector counts as this many times worse for the next
_TRUST = 3.0


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
    back : (n + k,) scaled step from here to the point before, and its tangent; None at the start.
    past : (s, G_z) of up to two points before, the latest first.
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
    back: tuple[Array, Array] | None = None
    past: tuple[tuple[float, Array], ...] = ()
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
    """Return the scaled step to the point h ahead on the cubic through the last two points and their tangents.

    Its error is of fourth order in h. With bushes of stiffness k a prediction that opens the pins by d loads them
    with k d, so a high order is what allows long steps with stiff joints.
    """
    if point.back is None:
        return h * point.tangent
    chord, before = point.back
    size = length(chord)
    bend = (chord + size * point.tangent) / size**2
    cubic = (before - point.tangent) / size**2 + (2.0 / size) * bend
    return h * point.tangent + h**2 * (bend + size * cubic) + h**3 * cubic


def _matrix_ahead(point: CurvePoint, h: float) -> Array:
    """Return G_z extrapolated to a step h ahead by the polynomial through the last points.

    Bushes turn with the mechanism: the last point's derivatives are off by stiffness times angle at the next one.
    """
    if not point.past:
        return point.jac
    (s1, j1), *older = point.past
    ahead, a = point.s + h, point.s
    if not older:
        t = h / (a - s1)
        return point.jac + t * (point.jac - j1)
    s2, j2 = older[0]
    w0 = (ahead - s1) * (ahead - s2) / ((a - s1) * (a - s2))
    w1 = (ahead - a) * (ahead - s2) / ((s1 - a) * (s1 - s2))
    return w0 * point.jac + w1 * j1 + (1.0 - w0 - w1) * j2


def advance(
    system: System, point: CurvePoint, h: float, settings: Settings, *, fresh: bool = False
) -> CurvePoint | str:
    """Return the next point a step h along the curve, or a sentence that says why the step is refused.

    `fresh` takes derivatives at the prediction instead of those of the last point: dearer, but with stiff bushes
    the soft direction turns by more than the last point's derivatives can tell.
    """
    prediction = system.admissible(point.x, predict(point, h))
    x, y = system.move(point.x, point.y, prediction)
    extrapolated = not (fresh or system.conditions or sparse.issparse(point.jac))
    expected = _TRUST * point.rate if extrapolated and len(point.past) == _PAST else math.inf
    lu = None if fresh else Factored(with_row(_matrix_ahead(point, h) if extrapolated else point.jac, point.tangent))
    c = correct(system, x, y, point.tangent, lu, settings, expected)
    if c.failure:
        return c.failure
    chord = system.difference(c.x, c.y, point.x, point.y)
    wandered = length(chord - prediction)
    if wandered > _WANDER * abs(h):
        return "the corrector wandered off the prediction"
    new = point_from(c, point.tangent, point.s + abs(h))
    new.back = (-chord, point.tangent)
    if extrapolated:
        new.past = ((point.s, point.jac), *point.past[: _PAST - 1])
    if new.angle > settings.angle_max:
        return f"the tangent turns by more than {math.degrees(settings.angle_max):.0f} deg"
    return new


def next_step(h: float, new: CurvePoint, settings: Settings) -> float:
    """Return the next step from the turning angle and the contraction seen."""
    by_angle = settings.angle / max(new.angle, 1e-3 * settings.angle)
    return min(h * min(by_angle, by_contraction(new), _GROWTH), settings.ds_max)


def may_turn_twice(system: System, old: CurvePoint, new: CurvePoint, index: int) -> bool:
    """Whether y[index] could have two extrema between points at which it moves the same way.

    Judged on the cubic through both points with their tangents.
    """
    i = system.n + index
    a, b = old.tangent[i], new.tangent[i]
    if a * b <= 0:
        return False
    chord = system.difference(new.x, new.y, old.x, old.y) if new.back is None else -new.back[0]
    mean = chord[i] / (new.s - old.s)
    # derivative of the cubic: a + 2 (3 mean - 2 a - b) t + 3 (a + b - 2 mean) t^2
    p, q = 3.0 * mean - 2.0 * a - b, 3.0 * (a + b - 2.0 * mean)
    t = -p / q if q else -1.0
    return bool(0.0 < t < 1.0 and (a + p * t) * a < 0)


def by_contraction(new: CurvePoint) -> float:
    """Return the factor by which the contraction of the corrector lets the step grow."""
    return math.sqrt(_CONTRACTION / max(new.contraction, 1e-3)) if new.iterations > 1 else _GROWTH


def land(system: System, point: CurvePoint, index: int, target: float, settings: Settings) -> CurvePoint | str:
    """Return the point near `point` at which y[index] = target."""
    row = np.zeros(system.n + system.k)
    row[system.n + index] = 1.0
    slope = point.tangent[system.n + index]
    h = (target - point.y[index]) / slope
    x, y = system.move(point.x, point.y, h * point.tangent)
    y = y.copy()
    y[index] = target
    c = correct(system, x, y, row, None, settings)
    if c.failure:
        return c.failure
    return point_from(c, point.tangent, point.s + float(np.linalg.norm(system.difference(c.x, c.y, point.x, point.y))))
