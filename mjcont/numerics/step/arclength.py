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

from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.bordered import Factored, border, null_vectors, oriented
from mjcont.numerics.equations.newton import Corrected, correct, length, undefined, with_row
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.step.hermite import arc, combine, hermite, lagrange
from mjcont.numerics.step.notes import Note

_WANDER = 0.5
_CONTRACTION = 0.1
_GROWTH = 2.0
# a parameter that moves by less along the tangent has no direction: the start is a fold, and noise would decide
_AT_FOLD = 1e-5
_PAST = 4
# points nearer to each other than this part of a step, or this far, are a cluster
_CLUSTER, _NOISY = 0.2, 1e-5
# how far behind a start the points lie from which the other direction is predicted
_BEHIND = 0.16
# a step whose prediction ends within this part of its way from a bound is one to the bound
_ALMOST = 1.1
# the contraction of the last corrector counts as this many times worse for the next
_TRUST = 3.0

# whether a point lies inside a long step; whether the user's stop or a limit ended the curve there
INSIDE, OUTSIDE = Note[bool](), Note[bool]()
# the point from which a step led to a point; that one's own is forgotten, so that no chain of all points is kept
BEFORE: Note[CurvePoint] = Note()


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
    notes : what is found out about the point once, see `Note`.
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
    notes: dict[Any, Any] = field(default_factory=dict)


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
) -> CurvePoint | Refused:
    """Return the point of the curve nearest to (x, y), the free parameter `lead` growing for direction > 0.

    Refused where the corrector fails.
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
    if c.failure is not None:
        return c.failure
    at_fold = abs(tangent[lead]) <= _AT_FOLD
    upwards = oriented(tangent) if at_fold else math.copysign(1.0, tangent[lead]) * tangent
    first = point_from(c, upwards if direction > 0 else -upwards, 0.0)
    if at_fold:  # on the fold as far as can be told: it belongs to both directions, whatever the sign of the noise
        first.tangent[lead] = 0.0
    return first


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


def predict(point: CurvePoint, h: float, *, steady: bool = False) -> Array:
    """Return the scaled step to the point h ahead on Hermite's polynomial through the last points and their tangents.

    With bushes of stiffness k a prediction that opens the pins by d loads them with k d, so a high order is what
    allows long steps with stiff joints. Where it swings, so far that the tangent would be left by half of h, `steady`
    takes fewer points; without, a corner is ahead, which the corrector is to see.
    """
    past, straight = _apart(point, h), h * point.tangent
    while past:
        values, slopes = hermite([0.0, *(e.s - point.s for e in past)], h)
        steps, tangents = (e.step for e in past), (e.tangent for e in past)
        step = combine([*slopes, *values[1:]], [point.tangent, *tangents, *steps])
        if not steady or length(step - straight) <= _WANDER * abs(h):
            return step
        past = past[:-1]
    return straight


def _apart(point: CurvePoint, h: float) -> list[Earlier]:
    """Return the last point and those before it that are far enough apart: a polynomial through a cluster is noise."""
    chosen = list(point.past[:1])
    for e in point.past[1:]:
        if chosen[-1].s - e.s >= max(_CLUSTER * h, _NOISY):
            chosen.append(e)
    return chosen


def _extrapolates(system: System, point: CurvePoint) -> bool:
    """Whether the matrices of the last points tell that of the next: sparse ones only where all have one pattern."""
    return system.problem.one_pattern or not sparse.issparse(point.jac)


def _matrix_ahead(point: CurvePoint, h: float) -> Array:
    """Return G_z extrapolated to a step h ahead by the polynomial through the last points.

    Bushes turn with the mechanism: the last point's derivatives are off by stiffness times angle at the next one.
    """
    past = _apart(point, h)
    if not past:
        jac: Array = point.jac
        return jac
    return combine(lagrange([0.0, *(e.s - point.s for e in past)], h), [point.jac, *(e.jac for e in past)])


def remembered(point: CurvePoint, step: Array) -> tuple[Earlier, ...]:
    """Return the past of a point that lies a scaled step from `point`."""
    older = (Earlier(e.s, e.step - step, e.tangent, e.jac) for e in point.past[: _PAST - 1])
    return (Earlier(point.s, -step, point.tangent, point.jac), *older)


def aim(
    system: System, point: CurvePoint, h: float, prediction: Array, *, steady: bool
) -> tuple[int, float, float] | None:
    """Return where the prediction of a step h leaves the bounds of a free parameter, None where it does not.

    That is the index in y, the bound as a coordinate, and how far ahead it is met: a little more than h where the step
    would end just before, too near for its corrector.
    """
    ahead, reach = point.y + _ALMOST * prediction[system.n :], _ALMOST * h
    met: list[tuple[float, int, float]] = []
    for i in np.flatnonzero((ahead < system.lowest) | (ahead > system.highest)).tolist():
        bound = float(system.lowest[i] if ahead[i] < system.lowest[i] else system.highest[i])

        def missing(t: float, i: int = i, bound: float = bound) -> float:
            return float(point.y[i] + predict(point, t, steady=steady)[system.n + i]) - bound

        at_start, at_end = missing(0.0), missing(reach)
        if at_start == 0.0 or at_start * at_end < 0.0:
            met.append((root(missing, 0.0, reach) if at_start else 0.0, i, bound))
    if not met:
        return None
    t, i, bound = min(met)
    return i, bound, t


def advance(
    system: System,
    point: CurvePoint,
    h: float,
    settings: Settings,
    *,
    fresh: bool = False,
    prediction: Array | None = None,
) -> CurvePoint | Refused:
    """Return the next point a step h along the curve, or why the step is refused.

    `fresh` takes derivatives at the prediction instead of those of the last point: dearer, but with stiff bushes
    the soft direction turns by more than the last point's derivatives can tell. `prediction` is `predict`'s, where it
    is known.
    """
    prediction = system.admissible(point.x, predict(point, h) if prediction is None else prediction)
    x, y = system.move(point.x, point.y, prediction)
    local = system.local(x, y)
    fresh = fresh and not _beyond_a_kink(system, point, local)
    extrapolated = not (fresh or system.conditions) and _extrapolates(system, point)
    expected = _TRUST * point.rate if extrapolated and len(point.past) == _PAST else math.inf
    lu = None if fresh else Factored(with_row(_matrix_ahead(point, h) if extrapolated else point.jac, point.tangent))
    c = correct(system, x, y, point.tangent, lu, settings, expected, _WANDER * abs(h), local)
    if c.failure is not None:
        return c.failure
    chord = system.difference(c.x, c.y, point.x, point.y)
    wandered = length(chord - prediction)
    if wandered > _WANDER * abs(h):
        return Refused(Why.WANDERED, "the corrector wandered off the prediction")
    new = point_from(c, point.tangent, point.s)
    new.s += length(chord) if system.conditions else arc(length(chord), math.cos(new.angle))
    new.past = remembered(point, chord)[: 1 if system.conditions else _PAST]
    if new.angle > settings.angle_max:
        return Refused(Why.TURNED, f"the tangent turns by more than {math.degrees(settings.angle_max):.0f} deg")
    return new


def _beyond_a_kink(system: System, point: CurvePoint, local: Local) -> bool:
    """Whether an evaluation lies on another smooth piece of f than a point: its derivatives are not the curve's."""
    return system.problem.nonsmooth and local.piece != point.local.piece


def follows(new: CurvePoint, old: CurvePoint) -> None:
    """Note that a step led from one point to another."""
    BEFORE.put(new, old)
    before = BEFORE.get(old)
    if before is not None:
        BEFORE.drop(before)


def next_step(h: float, new: CurvePoint, settings: Settings, growth: float = _GROWTH) -> float:
    """Return the next step from the turning angle and the contraction seen."""
    by_angle = settings.angle / max(new.angle, 1e-3 * settings.angle)
    return min(h * min(by_angle, by_contraction(new, growth), growth), settings.ds_max)


def by_contraction(new: CurvePoint, growth: float = _GROWTH) -> float:
    """Return the factor by which the contraction of the corrector lets the step grow."""
    return math.sqrt(_CONTRACTION / max(new.contraction, 1e-3)) if new.iterations > 1 else growth


def turned_back(system: System, points: Sequence[CurvePoint]) -> CurvePoint:
    """Return the first of a curve's points as the start of the other direction, those behind it as its past."""
    start = points[0]
    firm = [p for p in points[1:] if not INSIDE.known(p) and p.s <= _BEHIND]
    chosen = [firm[(len(firm) - 1) // 2], firm[-1]] if len(firm) > 1 else firm
    past = tuple(Earlier(-p.s, system.difference(p.x, p.y, start.x, start.y), -p.tangent, p.jac) for p in chosen)
    return CurvePoint(
        start.x, start.y, -start.tangent, -start.sign, start.local, start.jac, 0.0, start.error, past=past
    )


def land(
    system: System,
    point: CurvePoint,
    index: int,
    target: float,
    h: float,
    settings: Settings,
    *,
    fresh: bool = False,
    steady: bool = False,
) -> CurvePoint | Refused:
    """Return the point about h ahead at which y[index] = target, or why it is not met there.

    `fresh` as in `advance`, `steady` as in `predict`.
    """
    row = np.zeros(system.n + system.k)
    row[system.n + index] = 1.0
    prediction = system.admissible(point.x, predict(point, h, steady=steady))
    x, y = system.move(point.x, point.y, prediction)
    y[index] = target
    extrapolated = not (fresh or system.conditions) and _extrapolates(system, point)
    lu = Factored(with_row(_matrix_ahead(point, h), row)) if extrapolated else None
    c = correct(system, x, y, row, lu, settings)
    if c.failure is not None:
        return c.failure
    chord = system.difference(c.x, c.y, point.x, point.y)
    new = point_from(c, point.tangent, point.s)
    if length(chord - prediction) > _WANDER * h + _NOISY or new.angle > settings.angle_max:
        return Refused(Why.MISSED, "the bound was not met along the curve")
    new.s += arc(length(chord), math.cos(new.angle))
    new.past = remembered(point, chord)
    return new


def land_beside(
    system: System, point: CurvePoint, index: int, target: float, settings: Settings
) -> CurvePoint | Refused:
    """Return the point of the curve at which y[index] = target, a hair away from one of its points."""
    row = np.zeros(system.n + system.k)
    row[system.n + index] = 1.0
    y = point.y.copy()
    y[index] = target
    c = correct(system, point.x, y, row, None, settings)
    if c.failure is not None:
        return c.failure
    new = point_from(c, point.tangent, point.s)
    new.s += length(system.difference(c.x, c.y, point.x, point.y))
    return new
