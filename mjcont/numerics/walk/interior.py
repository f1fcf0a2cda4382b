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

from mjcont.numerics.equations.algebra import inverses
from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.newton import LARGEST_ERROR, length, with_row
from mjcont.numerics.equations.problem import Array, Linearization
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System, equation_sizes
from mjcont.numerics.step.arclength import INSIDE, CurvePoint, Earlier
from mjcont.numerics.step.hermite import hermite_each, mixed, node_windows
from mjcont.numerics.step.turning import falls_between, far_below, pairs_may_turn_twice

# points inside a step at most, and points through which they are interpolated
MOST, _NODES = 95, 6
# points nearer to each other than this part of a gap are a cluster: a curve begins with steps that grow threefold, all
# of which stiff bushes need, and at this ratio rounding is amplified to 1e-8 of the step. A polynomial that leaves the
# chord by more than this part of its length swings
_CLUSTER, _SWINGS = 0.02, 0.5
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
        return float((_ERROR / max(self.error, 1e-12)) ** 0.25)

    def growth_of_matrices(self) -> float:
        """Return the factor by which the error of interpolated matrices lets the step grow."""
        return float((_RATE / max(self.rate, 1e-6)) ** (1.0 / 3.0))


@dataclass(frozen=True, slots=True)
class Gap:
    """A step to be filled: its ends, and how many points are to lie inside."""

    old: CurvePoint
    new: CurvePoint
    count: int


@dataclass(slots=True)
class _Rows:
    """The points inside several steps side by side: arclengths (m,), states, coordinates, tangents and matrices.

    `astray` is the first step whose points lie far from its chord, the number of steps if there is none. `own` are the
    points' own f, df/dx and df/dp, where they are taken.
    """

    at: Array
    states: Array
    coordinates: Array
    tangents: Array
    jacs: Array
    astray: int
    own: tuple[Array, Array, Array] | None = None


def count_inside(length: float, angle: float, settings: Settings) -> int:
    """Return how many points a step of some length and turning angle needs inside."""
    needed = max(length / settings.ds_max, angle / settings.angle) - 1.0
    return math.ceil(min(needed, MOST + 1.0)) if needed > _SLACK else 0


def fill(
    system: System, gaps: Sequence[Gap], settings: Settings, *, exact: bool, own: bool = False
) -> list[Interior | Refused]:
    """Return the points inside steps that follow each other, up to the first that is refused.

    The points' tangents and matrices are interpolated, except around what `changed` tells; with `exact` they are
    taken at the interpolated states. Stiff bushes need that: what they push along turns with the mechanism, and
    interpolation errs by stiffness times the square of the angle by which it misses. With `own` they are those of the
    points, which are looked at one by one then: interpolation does not see what happens between the steps' ends.
    """
    if not any(g.count for g in gaps):
        return _checked(system, gaps, [Interior([]) for _ in gaps], settings)
    rows = _interpolated(system, gaps)
    if rows.astray < len(gaps):
        found = fill(system, gaps[: rows.astray], settings, exact=exact, own=own) if rows.astray else []
        refused = any(isinstance(f, Refused) for f in found)
        swings = Refused(Why.SWINGS, "the polynomial through the points around the step swings")
        return found if refused else [*found, swings]
    first: Array | None = None
    if exact:
        first, *rates = _linearized(system, rows.states, rows.coordinates)
        rows.jacs = _in_unknowns(system, rows.coordinates, *rates)
    matrix = _bordered(rows)
    inverse = inverses(matrix)
    residuals, sizes = _corrected(system, rows, [g.count for g in gaps], inverse, first, exact)
    errors = np.max(np.abs(residuals) / equation_sizes(rows.jacs), axis=1)
    if own:
        rows.own = _linearized(system, rows.states, rows.coordinates)
        rows.jacs = _in_unknowns(system, rows.coordinates, *rows.own[1:])
        matrix = _bordered(rows)
        inverse = inverses(matrix)
    columns = inverse[:, :, -1]
    rows.tangents = columns / np.sqrt((columns * columns).sum(axis=1))[:, None]
    errors[~np.isfinite(rows.tangents).all(axis=1)] = math.inf  # f has no derivatives there
    signs, settled, start = np.sign(np.linalg.det(matrix)), list[Interior](), 0
    refusal: list[Refused] = []
    for gap, history in zip(gaps, sizes, strict=False):
        part = slice(start, start + gap.count)
        start += gap.count
        if not gap.count:
            settled.append(Interior([]))
        elif not _settled(history):
            refusal.append(Refused(Why.UNSETTLED, "the points within the step do not settle between its ends"))
        elif not errors[part].max() < LARGEST_ERROR:
            refusal.append(Refused(Why.STALLED, "the points within the step stall away from the curve"))
        else:
            points = _points(system, rows, part, residuals, errors, signs)
            settled.append(Interior(points, history[0], history[1] / max(history[0], _ROUNDING)))
        if refusal:
            break
    checked = _checked(system, gaps[: len(settled)], settled, settings, own)
    complete = len(checked) == len(settled) and not any(isinstance(c, Refused) for c in checked)
    return [*checked, *refusal] if complete else checked


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
    base = after + behind
    at = s[base] + part * (s[base + 1] - s[base])
    nodes, sizes = node_windows(s, np.unique(base), _NODES, _CLUSTER)
    steps, turned, matrices = np.empty((len(at), ways.shape[1])), np.empty((len(at), ways.shape[1])), []
    for size in np.unique(sizes[base]).tolist():
        rows = np.flatnonzero(sizes[base] == size)
        here, windows = base[rows], nodes[base[rows], :size]
        values, slopes, weights = hermite_each(s[windows] - s[here][:, None], at[rows] - s[here])
        steps[rows] = (values[:, :, None] * (ways[windows] - ways[here][:, None])).sum(axis=1)
        steps[rows] += (slopes[:, :, None] * tangents[windows]).sum(axis=1)
        turned[rows] = (weights[:, :, None] * tangents[windows]).sum(axis=1)
        matrices.append((rows, mixed(weights, jacs, windows)))
    turned /= np.sqrt((turned * turned).sum(axis=1))[:, None]
    jacs = matrices[0][1] if len(matrices) == 1 else _in_order(matrices)
    starts = [g.old for g in gaps]
    states, coordinates = system.move_each(
        np.array([p.x for p in starts])[after], np.array([p.y for p in starts])[after], steps
    )
    off = steps - part[:, None] * chords[after]
    swings = after[(off * off).sum(axis=1) > (_SWINGS * (s[base + 1] - s[base])) ** 2]
    return _Rows(at, states, coordinates, turned, jacs, int(swings.min()) if len(swings) else len(gaps))


def _in_order(parts: Sequence[tuple[Array, Array]]) -> Array:
    """Return matrices that are given with their places, by place."""
    places, every = (np.concatenate(a) for a in zip(*parts, strict=True))
    return every[np.argsort(places)]


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


def _bordered(rows: _Rows) -> Array:
    """Return matrices with the tangents below them, (m, n + 1, n + 1)."""
    return np.concatenate([rows.jacs, rows.tangents[:, None]], axis=1)


def _points(
    system: System, rows: _Rows, part: slice, residuals: Array, errors: Array, signs: Array
) -> list[CurvePoint]:
    """Return the points inside one step."""
    states, coordinates = rows.states[part], rows.coordinates[part]
    every = system.locals_along(states, system.free[0].values(coordinates[:, 0]))
    points = []
    for i, local in enumerate(every, part.start):
        local.keep(residuals[i])
        if rows.own is not None:
            f, jac, par = (part[i] for part in rows.own)
            local.take(Linearization(f, jac, par[:, None]))
        point = CurvePoint(
            rows.states[i], rows.coordinates[i], rows.tangents[i], float(signs[i]), local, rows.jacs[i],
            float(rows.at[i]), float(errors[i]),
        )
        INSIDE.put(point, True)
        points.append(point)
    return points


def _linearized(system: System, states: Array, coordinates: Array) -> tuple[Array, Array, Array]:
    """Return f (m, n), df/dx (m, n, n) and df/dp (m, n) at states."""
    (p,) = system.free
    column = p.values(coordinates[:, 0])
    found = system.problem.linearize_along(states, system.base, p.name, column, (p.low, p.high))
    if found is not None:
        return found
    every = [local.linearization for local in system.locals_along(states, column)]
    return np.array([e.f for e in every]), np.array([e.jac for e in every]), np.array([e.par[:, 0] for e in every])


def _in_unknowns(system: System, coordinates: Array, jac: Array, par: Array) -> Array:
    """Return G_z in scaled unknowns (m, n, n + 1) for derivatives in physical units."""
    (p,) = system.free
    slopes = np.array([p.slope(u) for u in coordinates[:, 0].tolist()])
    return np.concatenate([jac * system.problem.state_scale, (par * slopes[:, None])[:, :, None]], axis=2)


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
    system: System, gaps: Sequence[Gap], insides: Sequence[Interior], settings: Settings, own: bool = False
) -> list[Interior | Refused]:
    """Return the insides with changes told, up to the first step that is refused; `own` as for `fill`."""
    if not gaps:
        return []
    every, ends, unsure = [gaps[0].old], [0], [0.0]
    for gap, inside in zip(gaps, insides, strict=True):
        every += [*inside.points, gap.new]
        ends.append(len(every) - 1)
        off = 0.0 if own else min(max(5.0 * inside.rate, _UNSURE), _TURNING)
        unsure += [off] * len(inside.points) + [0.0]
    tangents = np.array([p.tangent for p in every])
    turned = (tangents[1:] * tangents[:-1]).sum(axis=1) < math.cos(settings.angle_max)
    changes, twice = _settled_changes(system, every, tangents[:, system.n].copy(), np.array(unsure))
    done: list[Interior | Refused] = []
    for inside, first, last in zip(insides, ends, ends[1:], strict=False):
        if inside.points and turned[first:last].any():
            turn = math.degrees(settings.angle_max)
            return [*done, Refused(Why.TURNED, f"the tangent turns by more than {turn:.0f} deg between points")]
        if twice[first:last].any():
            return [*done, Refused(Why.TURNS_TWICE, "the parameter may turn twice between two points")]
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
