"""Branch switching and whole bifurcation diagrams: every branch that branch points connect, each once."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Progress, build_branch, completed, ordered_rows, reporter
from mjcont.curves.continuation import continue_equilibria, find_equilibrium
from mjcont.curves.walkers import Zeros, equilibrium_walker
from mjcont.errors import BoundsError, BranchWarning, MjcontError, ParameterError
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import correct
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings, make_settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.balance import MULTIPLE
from mjcont.numerics.points.events import Located
from mjcont.numerics.search.sphere import ways_through
from mjcont.numerics.spectra.stability import spectrum_of
from mjcont.numerics.step.arclength import CurvePoint, point_from
from mjcont.numerics.step.hermite import lagrange
from mjcont.numerics.walk.steps import End, Status
from mjcont.numerics.walk.trace import Trace, time_up, trace
from mjcont.results.branch import Branch, Diagram
from mjcont.results.model import Model, check_bounds, model_of
from mjcont.results.points import Point, SpecialPoint
from mjcont.results.search import same_spectrum

_OFFSET = 1e-2
# first steps along a branch from a point on it, one way and the other
_Way = tuple[Array, Array | None]
_SAME = 1e-5
# arclengths are sums over steps: those of halves that are images of each other agree to this part
_AS_LONG = 1e-3
# rows nearer to each other than this part of their distances are a cluster
_CLUSTER = 0.05


@checked
@np.errstate(all="ignore")
def switch_branches(
    point: SpecialPoint,
    bounds: tuple[float, float] | None = None,
    *,
    zeros: Zeros | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> list[Branch]:
    """Return every branch through a branch point, each followed in both directions from it.

    Parameters
    ----------
    point : SpecialPoint
        A BP of a branch of equilibria.
    bounds : (low, high), optional
        Range of the parameter; default that of the point's branch.
    zeros : dict of column to value, or to several values, optional
        Columns whose passing of a value is located and labelled UZ.

    Raises
    ------
    MjcontError
        If the point is no branch point of equilibria, or was loaded without its problem.
    """
    if point.kind != "BP" or point.curve != "equilibria":
        raise MjcontError(f"{point.label or 'this point'} is no branch point of equilibria: only those have branches")
    settings = make_settings(options)
    system = _system_at(point, bounds)
    with clock.limited(settings.max_seconds):
        found = [_through(point, system, way, settings, zeros, progress) for way in _ways(point, system)]
    return [b for b in found if b is not None]


def _system_at(point: SpecialPoint, bounds: tuple[float, float] | None) -> System:
    ((name, own),) = point.free.items()
    low, high = check_bounds(point.model, name, own if bounds is None else bounds)
    if not low <= point.parameters[name] <= high:
        value = point.parameters[name]
        raise BoundsError(f"{point.label} has {name} = {value:g}, outside the bounds {low:g} .. {high:g}")
    problem = point.model
    return System(problem, problem.values(point.parameters), [Free(name, low, high, problem.parameter(name).unit)])


def _ways(point: SpecialPoint, system: System) -> list[_Way]:
    """Return first steps along the branches through a branch point: one way, and the other where one leaves it.

    Those through a multiple point are searched for.
    """
    if point.coefficients.get("type") != MULTIPLE:
        return [(_OFFSET * t, -_OFFSET * t) for t in point.vectors.get("tangents", ())]
    vanishing = int(point.coefficients.get("vanishing", 2))
    return ways_through(system, point.state, system.start_y(), vanishing, _OFFSET)


def _leave(system: System, x: Array, y: Array, step: Array, settings: Settings) -> CurvePoint | Refused:
    """Return a point of the curve a small step from a branch point."""
    (x1, y1), tangent = system.move(x, y, step), step / np.linalg.norm(step)
    c = correct(system, x1, y1, tangent, None, settings)
    if c.failure is not None:
        return c.failure
    if np.linalg.norm(system.difference(c.x, c.y, x1, y1)) > 0.5 * _OFFSET:
        return Refused(Why.WANDERED, "the corrector wandered to another branch")
    return point_from(c, tangent, _OFFSET)


def _through(
    point: SpecialPoint,
    system: System,
    way: _Way,
    settings: Settings,
    zeros: Zeros | None,
    progress: Progress | None,
) -> Branch | None:
    """Return the branch that leaves a branch point one way and the other, or None if it cannot be entered."""
    x, y = point.state, system.start_y()
    walker = equilibrium_walker(system, settings, zeros or {})
    halves: list[Trace] = []
    for step in way[::-1]:
        if step is None:
            halves.append(Trace([], end=End(Status.NO_START, f"no branch leaves {point.label} the other way")))
            continue
        if halves and halves[0].end.status in (Status.CLOSED, Status.INTERRUPTED):
            halves.append(Trace([], end=halves[0].end))
            break
        try:
            first = _leave(system, x, y, step, settings)
        except clock.TimeUp:
            halves.append(Trace([], end=time_up(settings)))
            continue
        if isinstance(first, Refused):
            halves.append(Trace([], end=End(Status.NO_START, f"the branch could not be entered: {first}")))
            continue
        halves.append(trace(walker, first, reporter(system, progress), [e for h in halves for e in h.special]))
    if not any(h.points for h in halves):
        return None
    local = system.local(x, y)
    with clock.unlimited():
        tangent = way[0] / np.linalg.norm(way[0])
        bp_point = CurvePoint(x, y, tangent, 0.0, local, system.jacobian(local, y))
    known = {k: v for k, v in {**point.coefficients, **point.vectors}.items() if k in ("type", "c", "tangents", "w")}
    located = Located("BP", bp_point, point.tolerance, point.converged, known)
    for half in halves:  # a curve that closes comes back to the point it left
        half.special = [e for e in half.special if _away(system, e.point, bp_point)]
    minus, plus = (ordered_rows(h) if h.points else [] for h in halves)
    rows: list[tuple[CurvePoint, Located | None]] = [*minus[::-1], (bp_point, located), *plus]
    notes = ["its two halves are mirror images"] if _mirrored(system, minus, plus) else []
    table = completed(system, rows, settings, halves)
    index = next(i for i, e in enumerate(table.located) if e is located)
    return build_branch("equilibria", table, halves, f"through {point.label}", index, settings, notes)


def _away(system: System, a: CurvePoint, b: CurvePoint) -> bool:
    return float(np.linalg.norm(system.difference(a.x, a.y, b.x, b.y))) > _SAME


def _mirrored(system: System, minus: Sequence[Any], plus: Sequence[Any]) -> bool:
    """Whether two halves are images of each other: as long, with equal parameters and spectra at both ends.

    How many points they have is left to rounding.
    """
    if not minus or not plus or abs(minus[-1][0].s - plus[-1][0].s) > _AS_LONG * plus[-1][0].s:
        return False
    for (a, _), (b, _) in ((minus[0], plus[0]), (minus[-1], plus[-1])):
        if abs(a.y[0] - b.y[0]) > 1e-6 or not same_spectrum(spectrum_of(a), spectrum_of(b)):
            return False
    return True


@checked
@np.errstate(all="ignore")
def bifurcation_diagram(
    problem: Model,
    parameter: str,
    bounds: tuple[float, float] | None = None,
    starts: Sequence[Mapping[str, float] | Point] | Mapping[str, float] | Point | None = None,
    *,
    keyframes: Sequence[str] = (),
    max_branches: int = 50,
    zeros: Zeros | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Diagram:
    """Return every branch that is reachable from the starts through branch points, each once.

    Parameters
    ----------
    starts : a start (dict or point), or several; default the model's own values and pose.
    keyframes : further starts by keyframe, all at the first start's parameters, or the model's without one.
    max_branches : limit on the number of branches.
    zeros : columns whose passing of a value, or of several, is located and labelled UZ.
    """
    first: Sequence[Any] = [starts] if starts is None or isinstance(starts, Mapping | Point) else list(starts)
    if not first and not keyframes:
        raise ParameterError("starts is empty: give a start, or leave it out for the model's own values and pose")
    if max_branches < 1:
        raise ParameterError(f"max_branches must be at least 1, got {max_branches}")
    tries: list[tuple[Any, str | None]] = [(s, None) for s in first] if not keyframes or starts is not None else []
    tries += [(first[0] if first else None, k) for k in keyframes]
    branches: list[Branch] = []
    reached = ""
    try:
        with clock.limited(make_settings(options).max_seconds):
            reached = _reach(problem, parameter, bounds, tries, branches, max_branches, zeros, progress, options)
    except clock.TimeUp:
        reached = f"the limit of {make_settings(options).max_seconds:g} s was reached"
    return Diagram(tuple(branches), (reached,) if reached else ())


def _reach(
    problem: Any,
    parameter: str,
    bounds: tuple[float, float] | None,
    tries: Sequence[tuple[Any, str | None]],
    branches: list[Branch],
    max_branches: int,
    zeros: Zeros | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> str:
    """Add every branch that is reached from the starts to `branches`; return which limit was met, or nothing."""
    for start, keyframe in tries:
        if any(b.interrupted for b in branches):
            break
        located = isinstance(start, SpecialPoint) and start.converged and keyframe is None
        point = start if located else find_equilibrium(problem, start, keyframe=keyframe)
        if not any(covers(b, point) for b in branches):
            given = {"zeros": zeros, "progress": progress, **options}
            with warnings.catch_warnings():  # the other branches through it come next
                warnings.simplefilter("ignore", BranchWarning)
                branches.append(continue_equilibria(problem, parameter, bounds, point, **given))
            problem = branches[-1].model if problem.follows_scale else problem
    queue = [p for b in branches for p in b.of_kind("BP")]
    done: list[SpecialPoint] = []
    while queue and not any(b.interrupted for b in branches):
        point = queue.pop(0)
        if any(_same(point.model, point, other, bounds or point.free[parameter]) for other in done):
            continue
        done.append(point)
        for branch in _new_branches(point, branches, bounds, zeros, progress, options):
            if len(branches) >= max_branches:
                return f"the limit of {max_branches} branches was reached"
            branches.append(branch)
            queue += branch.of_kind("BP")
    return ""


def _new_branches(
    point: SpecialPoint,
    branches: Sequence[Branch],
    bounds: tuple[float, float] | None,
    zeros: Zeros | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> Iterator[Branch]:
    """Yield the branches through a point that none of `branches` contains."""
    settings, system = make_settings(options), _system_at(point, bounds)
    x, y = point.state, system.start_y()
    for way in _ways(point, system):
        sides = [_leave(system, x, y, step, settings) for step in way if step is not None]
        probes = [_as_point(system, s) for s in sides if not isinstance(s, Refused)]
        if probes and all(any(covers(b, p) for b in branches) for p in probes):
            continue
        branch = _through(point, system, way, settings, zeros, progress)
        if branch is not None:
            yield branch


def _as_point(system: System, p: CurvePoint) -> Point:
    unread = np.zeros(0, dtype=complex)
    return Point(system.values(p.y), {}, p.x, unread, "marginal", 0, model_of(system.problem))


def _same(problem: Model, a: Point, b: Point, bounds: tuple[float, float]) -> bool:
    width = bounds[1] - bounds[0]
    moved = np.max(np.abs(problem.difference(a.state, b.state)) / problem.state_scale)
    spread = max(abs(a.parameters[n] - b.parameters[n]) for n in a.parameters)
    return bool(moved < _SAME and spread < _SAME * width)


def covers(branch: Branch, point: Point) -> bool:
    """Whether an equilibrium lies on a branch of equilibria.

    It does where the branch, corrected from the rows around in the plane across its chord, meets that very point. At
    the point's own parameters a steep branch would be met far from there, and on another one that crosses it.
    """
    problem = branch.model
    ((name, (low, high)),) = branch.free.items()
    free = Free(name, low, high)
    system = System(problem, point.parameters, [free])
    at, column = system.start_y(), np.array([[free.coordinate(v)] for v in branch[name].tolist()])
    z = np.column_stack([problem.difference_each(point.state, branch.states) / problem.state_scale, at - column])
    chords = z[:-1] - z[1:]
    lengths = np.linalg.norm(chords, axis=1)
    along = np.clip(np.einsum("ij,ij->i", z[:-1], chords) / np.maximum(lengths**2, 1e-300), 0.0, 1.0)
    aside = np.linalg.norm(z[:-1] - along[:, None] * chords, axis=1)
    for i in np.flatnonzero((aside < 0.05 * lengths + 1e-9) & (lengths > 0.0)).tolist():
        if aside[i] < 1e-7:
            return True
        step = _from_row(z, i, float(along[i]))
        x, y = system.move(branch.states[i], column[i], step)
        c = correct(system, x, y, chords[i] / lengths[i], None, Settings())
        if c.failure is None and np.linalg.norm(system.difference(c.x, c.y, point.state, at)) < _SAME:
            return True
    return False


def _from_row(z: Array, i: int, fraction: float) -> Array:
    """Return the step from row i along a part of its chord, on the cubic through the rows around.

    `z` (N, n + 1) are the scaled steps from each row to one point.
    """
    first = min(max(i - 1, 0), max(len(z) - 4, 0))
    near = z[first : first + 4]
    steps = np.linalg.norm(np.diff(near, axis=0), axis=1)
    if len(near) < 4 or steps.min() < _CLUSTER * steps.max():
        straight: Array = fraction * (z[i] - z[i + 1])
        return straight
    s = np.append(0.0, np.cumsum(steps))
    weights = lagrange(s.tolist(), float(s[i - first] + fraction * steps[i - first]))
    found: Array = z[i] - np.asarray(weights) @ near
    return found
