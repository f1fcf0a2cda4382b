"""The verbs: `find_equilibrium`, `continue_equilibria`, and the points of a branch at a value."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Progress, collect, make_point, mark_of, run_directions
from mjcont.curves.walkers import Zeros, equilibrium_walker, point_stop, zero_values
from mjcont.errors import BoundsError, BranchWarning, MjcontError, ParameterError, StartError, warn
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import LARGEST_ERROR
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import make_settings
from mjcont.numerics.equations.starts import Start, find_start
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.events import Located
from mjcont.numerics.step.arclength import CurvePoint, first_point
from mjcont.numerics.walk.guard import guarded
from mjcont.numerics.walk.steps import End, Item, Status
from mjcont.numerics.walk.trace import Walker
from mjcont.results.branch import Branch
from mjcont.results.model import Model, check_bounds, model_of, warn_outside
from mjcont.results.points import Point, SpecialPoint, show
from mjcont.results.quantities import meant_each

M = TypeVar("M", bound=Model)
# how often a curve is followed anew at most, with the scale that its states tell
_SCALES = 4


def check_limits(name: str, ends: Any) -> None:
    """Raise a BoundsError unless the limits of a column are two numbers low <= high; either may be infinite."""
    try:
        low, high = (float(e) for e in ends)
    except (TypeError, ValueError) as error:
        raise BoundsError(f"limits of {name} must be two numbers (low, high), got {ends!r}") from error
    if not low <= high:
        raise BoundsError(f"limits of {name} must have low <= high, got ({low:g}, {high:g})")


def start_from(
    problem: Model, start: Mapping[str, float] | Point | None, keyframe: str | None, state: Any
) -> tuple[Array, dict[str, float]]:
    """Return the state and parameter values that `start`, `keyframe` and `state` describe."""
    if isinstance(start, Point):
        known = {k: v for k, v in start.parameters.items() if k in problem.parameters or ":" in k}
        return problem.start_state(keyframe, start.state if state is None else state), problem.values(known)
    if start is not None and not isinstance(start, Mapping):
        raise ParameterError(f"start must be a dict of parameter values or a point, got {type(start).__name__}")
    values = problem.values(start)
    warn_outside(problem, start or {})
    return problem.start_state(keyframe, state), values


@checked
@np.errstate(all="ignore")
def find_equilibrium(
    problem: Model, start: Mapping[str, float] | Point | None = None, *, keyframe: str | None = None, state: Any = None
) -> Point:
    """Return the equilibrium that a start belongs to: by Newton if it is near, else the one it flows to.

    Raises
    ------
    StartError
        If none is found.
    """
    x, values = start_from(problem, start, keyframe, state)
    problem, _ = hold_rigid_modes(problem, x, values)
    found = settled(problem, start if state is keyframe is None else None, x, values)
    if found.failure is not None:
        raise _no_start(problem, _start_name(problem, start, keyframe, state), found.failure)
    return make_point(problem, found.x, values)


def settled(problem: Model, start: Any, x: Array, values: Values) -> Start:
    """Return the equilibrium that a state belongs to. A located special point is one as it stands.

    At its parameters Newton's method would meet a singular matrix and go astray by rounding.
    """
    if isinstance(start, SpecialPoint) and start.converged:
        system, no_y = System(problem, values, ()), np.zeros(0)
        error = system.error(system.local(x, no_y), x, no_y)
        if error < LARGEST_ERROR:
            return Start(x, "located", 0.0, error)
    return find_start(problem, x, values)


def _no_start(problem: Model, origin: str, failure: Refused) -> StartError:
    """Return the error that says why no equilibrium was found from a start, and what to do."""
    more = "give a state nearer to one" if problem.second_order else "give u0 or a state nearer to one"
    return StartError(
        f"no equilibrium found from {origin}: {failure}. find_equilibria searches without a start; or {more}"
    )


def _start_name(problem: Model, start: Any, keyframe: str | None, state: Any) -> str:
    if state is not None:
        return "the given state"
    if keyframe is not None:
        return f"keyframe '{keyframe}'"
    if isinstance(start, Point):
        return "the given point"
    return "the model's initial pose" if problem.second_order else "u0"


@checked
@np.errstate(all="ignore")
def continue_equilibria(
    problem: Model,
    parameter: str,
    bounds: tuple[float, float] | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    direction: int | None = None,
    zeros: Zeros | None = None,
    limits: Mapping[str, tuple[float, float]] | None = None,
    stop: Callable[[Point], str | None] | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Branch:
    """Follow a curve of equilibria in one parameter, locating and verifying its special points.

    Parameters
    ----------
    problem : Mechanism or VectorField
    parameter : str
        The parameter to vary, by name or path.
    bounds : (low, high), optional
        Its range; default the parameter's own.
    start : dict of parameter values, or a point of any result
        Other parameters keep the model's values. At a branch point of a curve in this parameter, a BranchWarning.
    keyframe, state : optional
        Where to look for the first equilibrium; default the start point's state, or qpos0 (u0).
    direction : {None, +1, -1}
        Both directions from the start, or only that in which the parameter first grows or falls.
    zeros : dict of column to value, or to several values, optional
        Columns whose passing of a value is located and labelled UZ.
    limits : mapping of column to (low, high), optional
        The curve ends at the first point at which an observable leaves its range.
    stop : callable, optional
        `stop(point)` returns a sentence to end the curve there.
    progress : callable, optional
        `progress(count, found)` after each point; `found.kind` is that of a special point, empty at others.
    **options
        Fields of `Settings`: ds, ds_min, ds_max, angle, max_points, ...

    Returns
    -------
    Branch

    Raises
    ------
    NameLookupError, BoundsError, StartError, ParameterError
        See their messages. Failure of the continuation itself is no exception but the branch's status.
    """
    directions = check_direction(direction)
    _warn_of_others(start, parameter)

    def follow(scaled: Model) -> tuple[Branch, Model | None]:
        prepared = _prepare(scaled, parameter, bounds, start, keyframe, state, zeros, limits, stop, options)
        return _followed(prepared, directions, progress, "max_size" in options)

    with clock.limited(make_settings(options).max_seconds):
        branch = _in_its_scale(follow, problem)
    return replace(branch, settings={**branch.settings, "zeros": dict(zeros)}) if zeros else branch


def _warn_of_others(start: Any, parameter: str) -> None:
    """Give a BranchWarning where a curve begins at a branch point of one in the same parameter."""
    if isinstance(start, SpecialPoint) and start.kind == "BP" and parameter in start.free:
        said = (f"several branches meet in {start.label or 'this branch point'}, and the one that it was found on is "
                "followed: mc.switch_branches(point) follows all of them, a diagram ([[diagrams]] in a study) whatever "
                "they reach")
        warn(said, BranchWarning)


def _in_its_scale(follow: Callable[[Model], tuple[Branch, Model | None]], problem: Model) -> Branch:
    """Return what is followed in the scale that its own states tell; the first that ran off, if that does not help."""
    ran_off: Branch | None = None
    for _ in range(_SCALES):
        branch, fitting = follow(problem)
        ran_off = ran_off or (branch if _runs_off(branch) else None)
        if fitting is None:
            break
        problem = fitting
    if ran_off and (_runs_off(branch) or len(branch.special_points) < len(ran_off.special_points)):
        return ran_off
    return branch


def _runs_off(branch: Branch) -> bool:
    """Whether a branch ends because its states grow beyond bounds, as far as its scale tells."""
    return any(word == Status.RUNS_OFF.value for word, _ in branch.ends)


def _followed(
    prepared: _Prepared, directions: Sequence[float], progress: Progress | None, sized: bool
) -> tuple[Branch, Model | None]:
    """Return a branch, and its problem with the scale that its states tell: None where it fits, or a user ended it.

    Where it runs off, and the user has not `sized` it, its states may be large numbers by their unit alone.
    """
    walker = prepared.walker
    traces = run_directions(walker, prepared.x, walker.system.start_y(), directions, progress)
    branch = collect(
        "equilibria", walker.system, traces, directions, prepared.origin, walker.settings, prepared.notes
    )
    kept = (Status.INTERRUPTED, Status.STOPPED, Status.FAILED, *([Status.RUNS_OFF] if sized else []))
    if not branch.model.follows_scale or any(t.end.status in kept for t in traces):
        return branch, None
    return branch, branch.model.rescaled(np.abs(branch.states).max(axis=0))


@checked
def iterate_equilibria(
    problem: Model,
    parameter: str,
    bounds: tuple[float, float] | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    direction: int = 1,
    zeros: Zeros | None = None,
    limits: Mapping[str, tuple[float, float]] | None = None,
    **options: Any,
) -> Iterator[Point]:
    """Yield the points of a curve of equilibria one by one, special points among them, for callers who drive it.

    Arguments as for `continue_equilibria`, in one direction. Special points are of the class `SpecialPoint`, without
    a label; the iterator ends where the curve does.
    """
    within = clock.allowance(make_settings(options).max_seconds)
    with within():
        prepared = _prepare(problem, parameter, bounds, start, keyframe, state, zeros, limits, None, options)
        (sign,) = check_direction(int(direction))
        walker = prepared.walker
        system = walker.system
    first = first_point(system, prepared.x, system.start_y(), sign, walker.settings)
    if isinstance(first, Refused):
        raise StartError(f"the curve could not be entered: {first}")
    yield make_point(model_of(system.problem), first.x, system.values(first.y))
    walk = guarded(walker.walk(first))
    item: Item | None = None
    while not isinstance(item, End):
        try:
            with within():  # not across a yield: the caller's own time has no limit
                item = next(walk)
        except clock.TimeUp:
            return
        if isinstance(item, End) and item.status is Status.FAILED:
            raise MjcontError(item.message)
        if isinstance(item, CurvePoint):
            yield make_point(model_of(system.problem), item.x, system.values(item.y))
        elif isinstance(item, Located):
            row = make_point(model_of(system.problem), item.point.x, system.values(item.point.y), item.kind)
            yield mark_of(item).on(row, {p.name: (p.low, p.high) for p in system.free}, "equilibria")


@dataclass(frozen=True, slots=True)
class _Prepared:
    """A walk along a curve of equilibria, ready to start."""

    walker: Walker
    x: Array
    origin: str
    notes: tuple[str, ...]


def _prepare(
    problem: Model,
    parameter: str,
    bounds: tuple[float, float] | None,
    start: Mapping[str, float] | Point | None,
    keyframe: str | None,
    state: Any,
    zeros: Zeros | None,
    limits: Mapping[str, tuple[float, float]] | None,
    stop: Callable[[Point], str | None] | None,
    options: Mapping[str, Any],
) -> _Prepared:
    settings = make_settings(options)
    low, high = check_bounds(problem, parameter, bounds)
    x, values = start_from(problem, start, keyframe, state)
    if not low <= values[parameter] <= high:
        unit = problem.parameter(parameter).unit
        raise BoundsError(
            f"the start has {parameter} = {show(values[parameter], unit)}, outside the bounds "
            f"{show(low, unit)} .. {show(high, unit)}: give start={{'{parameter}': ...}} inside them"
        )
    zeros = meant_each(zeros, (parameter,), problem.observables)
    limits = meant_each(limits, (parameter,), problem.observables)
    for name in (*zeros, *limits):
        if name not in problem.parameters:
            problem.observable(name)
    zero_values(zeros)
    for name, ends in limits.items():
        check_limits(name, ends)
    with clock.unlimited():  # a dozen states tell, whatever the limit on time
        problem, notes = hold_rigid_modes(problem, x, values)
        refuse_pushing(problem, parameter, x, values)
        if notes:
            problem, notes = hold_rigid_modes(problem, x, values, {parameter: (low, high)})
    try:
        found = settled(problem, start if state is keyframe is None else None, x, values)
    except clock.TimeUp:
        raise StartError(f"no equilibrium found: the limit of {settings.max_seconds:g} s was reached") from None
    if found.failure is None and problem.follows_scale:
        problem = problem.rescaled(np.abs(found.x), grow=True) or problem
    origin = _start_name(problem, start, keyframe, state)
    if found.failure is not None:
        raise _no_start(problem, origin, found.failure)
    system = System(problem, values, [Free(parameter, low, high, problem.parameter(parameter).unit)])
    walker = equilibrium_walker(system, settings, zeros, point_stop(problem, system, stop, limits))
    way = {"newton": ", by Newton", "located": ""}.get(found.method, ", by damped motion to rest")
    return _Prepared(walker, found.x, f"from {origin}{way}", notes)


def hold_rigid_modes(
    problem: M, x: Array, values: Values, ranges: Mapping[str, tuple[float, float]] | None = None
) -> tuple[M, tuple[str, ...]]:
    """Return the problem with its rigid-body zero modes held, and a note that names them.

    A motion that something opposes elsewhere in the `ranges` of parameters is not held.
    """
    modes = found = problem.rigid_modes(x, values)
    for name, ends in (ranges or {}).items():
        for end in ends:
            beside = {**values, name: 0.7 * end + 0.3 * values[name]}
            modes = problem.rigid_modes(x, beside, modes) if modes else ()
    lost = [m for m in found if m not in modes]
    notes = [f"rigid-body zero modes held: {', '.join(modes)}"] if modes else []
    notes += [f"zero modes at the start that something opposes elsewhere, not held: {', '.join(lost)}"] if lost else []
    return problem.holding(modes) if modes or lost else problem, tuple(notes)


def refuse_pushing(problem: Model, parameter: str, x: Array, values: Values) -> None:
    """Raise a StartError if a parameter pushes along a held rigid-body mode: there is no equilibrium then."""
    if not problem.held:
        return
    local = problem.linearize(x, values, (parameter,))
    push = local.par[:, 0]
    noise = 1e-12 * np.abs(local.jac).max()
    directions = problem.rigid_directions(x)
    for name in problem.held:
        z = directions.get(name)
        if z is not None and abs(z @ push) > (1e-9 * np.abs(push).max() + noise) * np.abs(z).max():
            raise StartError(
                f"{parameter} pushes along the rigid-body mode '{name}', which nothing opposes: "
                "there is no equilibrium unless it is zero"
            )


def check_direction(direction: int | None) -> tuple[float, ...]:
    """Return the directions to walk in: both for None.

    Raises
    ------
    ParameterError
        If it is not None, +1 or -1.
    """
    if direction not in (None, 1, -1):
        raise ParameterError(f"direction must be None, +1 or -1, got {direction!r}")
    return (-1.0, 1.0) if direction is None else (float(direction),)
