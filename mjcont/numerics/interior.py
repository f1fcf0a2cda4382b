"""Points inside a long step, corrected side by side.

A long step of the corrector is filled with points as close together as the settings ask for. They are interpolated
by Hermite's polynomial through the last points with their tangents and corrected together by chord steps, with
matrices interpolated likewise, down to the noise floor. That costs few evaluations a point, all in one batch, and
checks the step itself: had it gone over to another branch, the points between would not settle on the polynomial.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from mjcont.numerics.arclength import DIP, CurvePoint, Earlier
from mjcont.numerics.bordered import Factored
from mjcont.numerics.hermite import combine, weights_along
from mjcont.numerics.newton import LARGEST_ERROR, length, with_row
from mjcont.numerics.problem import Array
from mjcont.numerics.settings import Settings
from mjcont.numerics.system import System, equation_sizes

# numbers of interior points, so that few sizes of batches are needed
_COUNTS = (1, 2, 3, 4, 6, 8, 12, 16, 23, 31, 47, 63, 95)
MOST = _COUNTS[-1]
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


def count_inside(length: float, angle: float, settings: Settings) -> int:
    """Return how many points a step of some length and turning angle needs inside; more than `MOST` if too many."""
    needed = max(length / settings.ds_max, angle / settings.angle) - 1.0
    return next((c for c in _COUNTS if c >= needed), MOST + 1) if needed > _SLACK else 0


def fill(
    system: System, old: CurvePoint, new: CurvePoint, count: int, settings: Settings, *, exact: bool
) -> Interior | str:
    """Return `count` points between two, or a sentence that says why the step is refused.

    The points' tangents and matrices are interpolated, except around what `changed` tells; with `exact` they are
    taken at the interpolated states. Stiff bushes need that: what they push along turns with the mechanism, and
    interpolation errs by stiffness times the square of the angle by which it misses.
    """
    n = system.n
    at = old.s + (new.s - old.s) * np.arange(1, count + 1) / (count + 1)
    steps, tangents, jacs = _interpolated(new, at)
    states, coordinates = system.move_each(new.x, new.y, steps)
    first: Array | None = None
    if exact:
        first, jacs = _linearized(system, states, coordinates)
    matrix = np.empty((count, n + 1, n + 1))
    matrix[:, :n], matrix[:, n] = jacs, tangents
    try:
        inverse = np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return "the curve has no single tangent within the step"
    sizes: list[float] = []
    while True:
        residuals = _residuals(system, states, coordinates) if first is None else first
        first = None
        if _settled(sizes):
            break
        moves = (inverse[:, :, :n] @ residuals[:, :, None])[:, :, 0]
        sizes.append(math.sqrt(float((moves * moves).sum(axis=1).max())))
        if not _contracting(sizes, exact):
            return "the points within the step do not settle between its ends"
        states, coordinates = system.move_each(states, coordinates, -moves)
    errors = np.max(np.abs(residuals) / equation_sizes(jacs), axis=1)
    if not errors.max() < LARGEST_ERROR:
        return "the points within the step stall away from the curve"
    found = inverse[:, :, -1]
    found = found / np.sqrt((found * found).sum(axis=1))[:, None]
    signs = np.sign(np.linalg.det(matrix)).tolist()
    every = system.locals_along(states, system.free[0].values(coordinates[:, 0]))
    points = []
    for i, (local, s, error) in enumerate(zip(every, at.tolist(), errors.tolist(), strict=True)):
        local.keep(residuals[i])
        point = CurvePoint(states[i], coordinates[i], found[i], signs[i], local, jacs[i], s, error)
        point.extra["interior"] = True
        points.append(point)
    inside = Interior(points, sizes[0], sizes[1] / max(sizes[0], _ROUNDING))
    return _checked(system, old, new, inside, settings)


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


def _residuals(system: System, states: Array, coordinates: Array) -> Array:
    (p,) = system.free
    return system.problem.residuals_along(states, system.base, p.name, p.values(coordinates[:, 0]))


def _interpolated(new: CurvePoint, at: Array) -> tuple[Array, Array, Array]:
    """Return steps from `new` (m, n + 1), unit tangents and matrices (m, n, n + 1) at arclengths (m,) before it."""
    nodes = [0.0, *(e.s - new.s for e in new.past)]
    there = at - new.s
    weights, values, slopes = weights_along(nodes, there)
    tangents = [new.tangent, *(e.tangent for e in new.past)]
    steps = slopes @ np.array(tangents) + values[:, 1:] @ np.array([e.step for e in new.past])
    turned = combine(weights, tangents)
    turned /= np.sqrt((turned * turned).sum(axis=1))[:, None]
    return steps, turned, combine(weights, [new.jac, *(e.jac for e in new.past)])


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


def _checked(system: System, old: CurvePoint, new: CurvePoint, inside: Interior, settings: Settings) -> Interior | str:
    """Return the interior with changes told, or why the step is refused."""
    every = [old, *inside.points, new]
    tangents = np.array([p.tangent for p in every])
    cosines = (tangents[1:] * tangents[:-1]).sum(axis=1)
    if cosines.min() < math.cos(settings.angle_max):
        return f"the tangent turns by more than {math.degrees(settings.angle_max):.0f} deg between points"
    along = tangents[:, system.n]
    signs, values, s = np.array([(p.sign, p.y[0], p.s) for p in every]).T
    unsure = min(max(5.0 * inside.rate, _UNSURE), _TURNING)
    own = np.zeros(len(inside.points), dtype=bool)
    while True:
        changes, twice = _changes(along, signs), _may_turn_twice(along, values, s)
        pairs = changes | twice
        asked = ((np.abs(along[1:-1]) < unsure) | pairs[1:] | pairs[:-1]) & ~own
        if not asked.any():
            break
        for i in (np.flatnonzero(asked) + 1).tolist():
            _refine(system, every[i])
            along[i], signs[i] = every[i].tangent[system.n], every[i].sign
        own |= asked
    if twice.any():
        return "the parameter may turn twice between two points"
    for i in np.flatnonzero(changes).tolist():
        a, b = every[i], every[i + 1]
        inside.changed.append(i)
        if b is not new:  # what is looked for between these two starts from a
            b.past = (Earlier(a.s, system.difference(a.x, a.y, b.x, b.y), a.tangent, a.jac),)
    return inside


def _changes(along: Array, signs: Array) -> Array:
    """Return for each pair of points whether the parameter turns between them or the orientation changes."""
    return (along[1:] * along[:-1] <= 0.0) | (signs[1:] * signs[:-1] <= 0.0)


def _may_turn_twice(slopes: Array, values: Array, s: Array) -> Array:
    """Return `may_turn_twice` for each pair of points, of a function with given slopes and values at arclengths s."""
    a, b, mean = slopes[:-1], slopes[1:], np.diff(values) / np.diff(s)
    p, q = 3.0 * mean - 2.0 * a - b, 3.0 * (a + b - 2.0 * mean)
    t = -p / np.where(q != 0.0, q, np.inf)
    least = (a + p * t) * np.sign(a)
    return (a * b > 0.0) & (t > 0.0) & (t < 1.0) & (least < DIP * np.minimum(np.abs(a), np.abs(b)))


def _refine(system: System, point: CurvePoint) -> None:
    """Replace the interpolated matrix, tangent and sign of a point by its own."""
    point.jac = system.jacobian(point.local, point.y)
    factored = Factored(with_row(point.jac, point.tangent))
    tangent = factored.last_column()
    point.tangent, point.sign = tangent / length(tangent), factored.sign
