"""Points inside long steps, corrected side by side.

Long steps of the corrector are filled with points as close together as the settings ask for. They are interpolated by
Hermite's polynomial through the steps' ends and the points before with their tangents, and corrected together by chord
steps, with matrices interpolated likewise, down to the noise floor. That costs few evaluations a point, all in one
batch, and checks the steps themselves: had one gone over to another branch, the points between would not settle on the
polynomial.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from mjcont.numerics.algebra import inverses
from mjcont.numerics.arclength import CurvePoint, Earlier, falls_between, far_below, pairs_may_turn_twice
from mjcont.numerics.bordered import Factored
from mjcont.numerics.hermite import hermite_each, mixed
from mjcont.numerics.newton import LARGEST_ERROR, length, with_row
from mjcont.numerics.problem import Array
from mjcont.numerics.settings import Settings
from mjcont.numerics.system import System, equation_sizes

# points inside a step at most, and points through which they are interpolated
MOST, _NODES = 95, 6
# a step that is longer than asked for by less than this part needs no point inside
_SLACK = 0.1
_ROUNDS = 5
_LARGEST_CORRECTION = 0.05
# contraction of the corrections at worst, and of the first where matrices are interpolated
_CONTRACTION, _INTERPOLATED = 0.3, 2e-2
_ROUNDING = 1e-11
_REMAINS = 1e-13
_NOISE = 1e-9
# where the parameter moves by less along the tangent than that may be in error, at least and at most by so much,
# derivatives of the points themselves decide where it turns
_UNSURE, _TURNING = 5e-3, 0.02
# interpolation errors aimed at: the size of the first correction
_ERROR = 1e-4
# contraction aimed at where matrices are interpolated
_RATE = 3e-3


@dataclass(slots=True)
class Interior:
    """The points inside a step.

    Attributes
    ----------
    points : in order.
    error : size of their largest first correction: the error of the interpolation.
    rate : contraction of the corrections after the first.
    changed : i for each pair (i, i + 1) of the step's points, ends included, between which the curve turns back or its
        orientation changes.
    """

    points: list[CurvePoint]
    error: float = 0.0
    rate: float = 0.0
    changed: list[int] = field(default_factory=list)

    def growth(self) -> float:
        """Return the factor by which the error of the interpolated states lets the step grow."""
        return (_ERROR / max(self.error, 1e-12)) ** 0.25

    def growth_of_matrices(self) -> float:
        """Return the factor by which the error of interpolated matrices lets the step grow."""
        return (_RATE / max(self.rate, 1e-6)) ** (1.0 / 3.0)


@dataclass(frozen=True, slots=True)
class Gap:
    """A step to be filled: its ends, and how many points are to lie inside."""

    old: CurvePoint
    new: CurvePoint
    count: int


@dataclass(slots=True)
class _Rows:
    """The points inside several steps side by side: arclengths (m,), states, coordinates, tangents and matrices."""

    at: Array
    states: Array
    coordinates: Array
    tangents: Array
    jacs: Array


def count_inside(length: float, angle: float, settings: Settings) -> int:
    """Return how many points a step of some length and turning angle needs inside."""
    needed = max(length / settings.ds_max, angle / settings.angle) - 1.0
    return math.ceil(min(needed, MOST + 1.0)) if needed > _SLACK else 0


def fill(system: System, gaps: Sequence[Gap], settings: Settings, *, exact: bool) -> list[Interior | str]:
    """Return the points inside steps that follow each other, up to the first that is refused: a sentence says why.

    The points' tangents and matrices are interpolated, except around what `changed` tells; with `exact` they are
    taken at the interpolated states. Stiff bushes need that: what they push along turns with the mechanism, and
    interpolation errs by stiffness times the square of the angle by which it misses.
    """
    n = system.n
    rows = _interpolated(system, gaps)
    first: Array | None = None
    if exact:
        first, rows.jacs = _linearized(system, rows.states, rows.coordinates)
    matrix = np.empty((len(rows.at), n + 1, n + 1))
    matrix[:, :n], matrix[:, n] = rows.jacs, rows.tangents
    inverse = inverses(matrix)
    residuals, sizes = _corrected(system, rows, [g.count for g in gaps], inverse, first, exact)
    errors = np.max(np.abs(residuals) / equation_sizes(rows.jacs), axis=1)
    columns = inverse[:, :, -1]
    rows.tangents = columns / np.sqrt((columns * columns).sum(axis=1))[:, None]
    signs, found, start = np.sign(np.linalg.det(matrix)), list[Interior](), 0
    refused: list[str] = []
    for gap, history in zip(gaps, sizes, strict=False):
        part = slice(start, start + gap.count)
        start += gap.count
        if not gap.count:
            found.append(Interior([]))
        elif not _settled(history):
            refused.append("the points within the step do not settle between its ends")
        elif not errors[part].max() < LARGEST_ERROR:
            refused.append("the points within the step stall away from the curve")
        else:
            points = _points(system, rows, part, residuals, errors, signs)
            found.append(Interior(points, history[0], history[1] / max(history[0], _ROUNDING)))
        if refused:
            break
    checked = _checked(system, gaps[: len(found)], found, settings)
    complete = len(checked) == len(found) and not any(isinstance(c, str) for c in checked)
    return [*checked, *refused] if complete else checked


def _interpolated(system: System, gaps: Sequence[Gap]) -> _Rows:
    """Return the points inside steps on the polynomials through the ends of these and the points before them."""
    ends: list[CurvePoint | Earlier] = [*gaps[0].old.past[::-1], gaps[0].old, *(g.new for g in gaps)]
    s, behind = np.array([e.s for e in ends]), len(gaps[0].old.past)
    chords = np.array([-g.new.past[0].step for g in gaps])
    ways = np.array([*(e.step for e in gaps[0].old.past[::-1]), np.zeros(chords.shape[1]), *np.cumsum(chords, axis=0)])
    tangents, jacs = np.array([e.tangent for e in ends]), np.array([e.jac for e in ends])
    counts = np.array([g.count for g in gaps])
    after = np.repeat(np.arange(len(gaps)), counts)
    part = (np.arange(len(after)) - np.repeat(np.cumsum(counts) - counts, counts) + 1.0) / (counts[after] + 1.0)
    base, width = after + behind, min(_NODES, len(s))
    at = s[base] + part * (s[base + 1] - s[base])
    windows = np.clip(base - (width // 2 - 1), 0, len(s) - width)[:, None] + np.arange(width)
    values, slopes, weights = hermite_each(s[windows] - s[base][:, None], at - s[base])
    steps = (values[:, :, None] * (ways[windows] - ways[base][:, None])).sum(axis=1)
    steps += (slopes[:, :, None] * tangents[windows]).sum(axis=1)
    starts = [g.old for g in gaps]
    states, coordinates = system.move_each(
        np.array([p.x for p in starts])[after], np.array([p.y for p in starts])[after], steps
    )
    turned = (weights[:, :, None] * tangents[windows]).sum(axis=1)
    turned /= np.sqrt((turned * turned).sum(axis=1))[:, None]
    return _Rows(at, states, coordinates, turned, mixed(weights, jacs, windows))


def _corrected(
    system: System, rows: _Rows, counts: Sequence[int], inverse: Array, first: Array | None, exact: bool
) -> tuple[Array, list[list[float]]]:
    """Correct points in place until those of each step settle, or the first step is refused.

    Returns their residuals (m, n), and for each step up to a refused one the sizes of its largest corrections.
    `first` are the residuals at the start, where they are known.
    """
    n, ends = system.n, np.cumsum(counts)
    residuals = np.zeros((len(rows.at), n)) if first is None else first
    sizes: list[list[float]] = [[] for _ in counts]
    parts = [np.arange(e - c, e) for e, c in zip(ends, counts, strict=True)]
    open_ = [g for g, c in enumerate(counts) if c]
    while open_:
        chosen = np.concatenate([parts[g] for g in open_])
        if first is None:
            residuals[chosen] = system.residuals_at(rows.states[chosen], rows.coordinates[chosen])
        first = None
        open_ = [g for g in open_ if not _settled(sizes[g])]
        if not open_:
            break
        chosen = np.concatenate([parts[g] for g in open_])
        moves = (inverse[chosen, :, :n] @ residuals[chosen][:, :, None])[:, :, 0]
        starts = np.cumsum([0, *(counts[g] for g in open_[:-1])])
        largest = np.sqrt(np.maximum.reduceat((moves * moves).sum(axis=1), starts))
        for g, size in zip(open_, largest.tolist(), strict=True):
            sizes[g].append(size)
            if not _contracting(sizes[g], exact):
                sizes[g].append(math.inf)
                sizes, open_ = sizes[: g + 1], [k for k in open_ if k < g]
                break
        rows.states[chosen], rows.coordinates[chosen] = system.move_each(
            rows.states[chosen], rows.coordinates[chosen], -moves
        )
    return residuals, sizes


def _points(
    system: System, rows: _Rows, part: slice, residuals: Array, errors: Array, signs: Array
) -> list[CurvePoint]:
    """Return the points inside one step."""
    states, coordinates = rows.states[part], rows.coordinates[part]
    every = system.locals_along(states, system.free[0].values(coordinates[:, 0]))
    points = []
    for i, local in enumerate(every, part.start):
        local.keep(residuals[i])
        point = CurvePoint(
            rows.states[i], rows.coordinates[i], rows.tangents[i], float(signs[i]), local, rows.jacs[i],
            float(rows.at[i]), float(errors[i]),
        )
        point.extra["interior"] = True
        points.append(point)
    return points


def _linearized(system: System, states: Array, coordinates: Array) -> tuple[Array, Array]:
    """Return f (m, n) and G_z in scaled unknowns (m, n, n + 1) at states."""
    (p,) = system.free
    column = p.values(coordinates[:, 0])
    found = system.problem.linearize_along(states, system.base, p.name, column)
    if found is None:
        every = system.locals_along(states, column)
        jacs = [system.jacobian(local, y) for local, y in zip(every, coordinates, strict=True)]
        return np.array([local.f for local in every]), np.array(jacs)
    f, jac, par = found
    out = np.empty((len(states), system.n, system.n + 1))
    out[:, :, :-1] = jac * system.problem.state_scale
    out[:, :, -1] = par * np.array([p.slope(u) for u in coordinates[:, 0].tolist()])[:, None]
    return f, out


def _settled(sizes: list[float]) -> bool:
    """Whether what the last correction leaves is below the noise floor, or the corrections are noise."""
    if len(sizes) < 2 or sizes[-1] > _NOISE:
        return False
    ratio = sizes[-1] / max(sizes[-2], 1e-300)
    return sizes[-1] * ratio <= _REMAINS or (ratio > _CONTRACTION and len(sizes) > 2)


def _contracting(sizes: list[float], exact: bool) -> bool:
    """Whether corrections are small, grow smaller as matrices of that kind should make them, and are not too many."""
    if not sizes[-1] < _LARGEST_CORRECTION or len(sizes) > _ROUNDS:
        return False
    if len(sizes) == 1 or sizes[-1] <= _ROUNDING:
        return True
    return sizes[-1] <= sizes[-2] * (_CONTRACTION if exact or len(sizes) > 2 else _INTERPOLATED)


def _checked(
    system: System, gaps: Sequence[Gap], insides: Sequence[Interior], settings: Settings
) -> list[Interior | str]:
    """Return the insides with changes told, up to the first step that is refused: a sentence says why."""
    if not gaps:
        return []
    every, ends, unsure = [gaps[0].old], [0], [0.0]
    for gap, inside in zip(gaps, insides, strict=True):
        every += [*inside.points, gap.new]
        ends.append(len(every) - 1)
        unsure += [min(max(5.0 * inside.rate, _UNSURE), _TURNING)] * len(inside.points) + [0.0]
    tangents = np.array([p.tangent for p in every])
    turned = (tangents[1:] * tangents[:-1]).sum(axis=1) < math.cos(settings.angle_max)
    changes, twice = _settled_changes(system, every, tangents[:, system.n].copy(), np.array(unsure))
    done: list[Interior | str] = []
    for inside, first, last in zip(insides, ends, ends[1:], strict=False):
        if inside.points and turned[first:last].any():
            return [*done, f"the tangent turns by more than {math.degrees(settings.angle_max):.0f} deg between points"]
        if twice[first:last].any():
            return [*done, "the parameter may turn twice between two points"]
        for i in np.flatnonzero(changes[first:last]).tolist() if inside.points else ():
            a, b = every[first + i], every[first + i + 1]
            inside.changed.append(i)
            if first + i + 1 != last:  # what is looked for between these two starts from a
                b.past = (Earlier(a.s, system.difference(a.x, a.y, b.x, b.y), a.tangent, a.jac),)
        done.append(inside)
    return done


def _settled_changes(
    system: System, points: Sequence[CurvePoint], along: Array, unsure: Array
) -> tuple[Array, Array]:
    """Return for each pair of points whether the curve changes between them, and whether its parameter may turn twice.

    `along` (m,) are the components of the tangents along the parameter. Interpolated ones below `unsure` (m,), zero at
    points with derivatives of their own, and those that decide a change, are replaced by the points' own.
    """
    signs, values, s = np.array([(p.sign, p.y[0], p.s) for p in points]).T
    own = unsure == 0.0
    while True:
        changes, twice = _changes(along, signs), pairs_may_turn_twice(along, values, s)
        pairs = changes | twice | far_below(along)
        asked = np.abs(along) < unsure
        asked[1:] |= pairs
        asked[:-1] |= pairs
        asked &= ~own
        if not asked.any():
            break
        for i in np.flatnonzero(asked).tolist():
            _refine(system, points[i])
            along[i], signs[i] = points[i].tangent[system.n], points[i].sign
        own |= asked
    for i in np.flatnonzero(far_below(along)).tolist():
        twice[i] = falls_between(system, points[i], points[i + 1])
    return changes, twice


def _changes(along: Array, signs: Array) -> Array:
    """Return for each pair of points whether the parameter turns between them or the orientation changes."""
    return (along[1:] * along[:-1] <= 0.0) | (signs[1:] * signs[:-1] <= 0.0)


def _refine(system: System, point: CurvePoint) -> None:
    """Replace the interpolated matrix, tangent and sign of a point by its own."""
    point.jac = system.jacobian(point.local, point.y)
    factored = Factored(with_row(point.jac, point.tangent))
    tangent = factored.last_column()
    point.tangent, point.sign = tangent / length(tangent), factored.sign
