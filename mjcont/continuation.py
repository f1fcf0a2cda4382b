"""The verbs: `find_equilibrium`, `continue_equilibria`, and the points of a branch at a value."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from mjcont.branch import Branch, Point, show
from mjcont.collect import Progress, collect, make_point, run_directions, special_point
from mjcont.errors import BoundsError, MjcontError, ParameterError, StartError, unknown_name
from mjcont.numerics import clock
from mjcont.numerics.arclength import CurvePoint, first_point
from mjcont.numerics.equilibria import square_system
from mjcont.numerics.events import Located, ScalarZero
from mjcont.numerics.newton import Corrected, solve
from mjcont.numerics.problem import Array, Values
from mjcont.numerics.settings import Settings
from mjcont.numerics.starts import find_start
from mjcont.numerics.steps import End
from mjcont.numerics.system import Free, System
from mjcont.numerics.trace import Walker
from mjcont.quantities import column_of, meant_each
from mjcont.walkers import equilibrium_walker, monitor_of, point_stop


def make_settings(options: Mapping[str, Any]) -> Settings:
    """Return Settings from keyword options.

    Raises
    ------
    NameLookupError
        If an option does not exist; the message lists those that do.
    """
    valid = [f.name for f in fields(Settings)]
    for name in options:
        if name not in valid:
            raise unknown_name("option", name, valid)
    given = dict(options)
    if "ds" not in given and "ds_max" in given:
        given["ds"] = min(Settings().ds, given["ds_max"])
    if "ds_min" not in given and "ds" in given:
        given["ds_min"] = min(Settings().ds_min, given["ds"])
    return Settings(**given)


def check_bounds(problem: Any, name: str, bounds: tuple[float, float] | None) -> tuple[float, float]:
    """Return the bounds of a parameter: those given, or its own.

    Raises
    ------
    BoundsError
        If they are not two increasing finite numbers, or lie outside a control's range.
    """
    parameter = problem.parameter(name)
    if parameter.kind == "switch":
        raise BoundsError(f"'{name}' is a switch, 0 or 1, and cannot vary along a curve: give it as a start value")
    if bounds is None:
        own, hard = parameter.bounds, parameter.hard_bounds
        return max(own[0], hard[0]), min(own[1], hard[1])
    try:
        low, high = (float(b) for b in bounds)
    except (TypeError, ValueError) as error:
        raise BoundsError(f"bounds of {name} must be two numbers (low, high), got {bounds!r}") from error
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise BoundsError(f"bounds of {name} must be finite with low < high, got ({low:g}, {high:g})")
    hard_low, hard_high = parameter.hard_bounds
    if low < hard_low or high > hard_high:
        raise BoundsError(
            f"bounds ({low:g}, {high:g}) of {name} leave {parameter.limits}: narrow the bounds"
            + ("" if parameter.springs else " or widen the range in the XML")
        )
    return low, high


def start_from(
    problem: Any, start: Mapping[str, float] | Point | None, keyframe: str | None, state: Any
) -> tuple[Array, dict[str, float]]:
    """Return the state and parameter values that `start`, `keyframe` and `state` describe."""
    if isinstance(start, Point):
        known = {k: v for k, v in start.parameters.items() if k in problem.parameters or ":" in k}
        return problem.start_state(keyframe, start.state if state is None else state), problem.values(known)
    if start is not None and not isinstance(start, Mapping):
        raise ParameterError(f"start must be a dict of parameter values or a point, got {type(start).__name__}")
    return problem.start_state(keyframe, state), problem.values(start)


def find_equilibrium(
    problem: Any, start: Mapping[str, float] | Point | None = None, *, keyframe: str | None = None, state: Any = None
) -> Point:
    """Return the equilibrium that a start belongs to: by Newton if it is near, else the one it flows to.

    Raises
    ------
    StartError
        If none is found.
    """
    x, values = start_from(problem, start, keyframe, state)
    problem, _ = hold_rigid_modes(problem, x, values)
    found = find_start(problem, x, values)
    if found.failure:
        raise _no_start(problem, _start_name(problem, start, keyframe, state), found.failure)
    return make_point(problem, found.x, values)


def _no_start(problem: Any, origin: str, failure: str) -> StartError:
    """Return the error that says why no equilibrium was found from a start, and what to do."""
    more = "give a state nearer to one" if problem.second_order else "give u0 or a state nearer to one"
    return StartError(
        f"no equilibrium found from {origin}: {failure}. find_equilibria searches without a start; or {more}"
    )


def _start_name(problem: Any, start: Any, keyframe: str | None, state: Any) -> str:
    if state is not None:
        return "the given state"
    if keyframe is not None:
        return f"keyframe '{keyframe}'"
    if isinstance(start, Point):
        return "the given point"
    return "the model's initial pose" if problem.second_order else "u0"


def continue_equilibria(
    problem: Any,
    parameter: str,
    bounds: tuple[float, float] | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    direction: int | None = None,
    zeros: Mapping[str, float] | None = None,
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
        Other parameters keep the model's values.
    keyframe, state : optional
        Where to look for the first equilibrium; default the start point's state, or qpos0 (u0).
    direction : {None, +1, -1}
        Both directions from the start, or only that in which the parameter first grows or falls.
    zeros : dict of column to value, optional
        Observables whose passing of a value is located and labelled UZ.
    limits : mapping of column to (low, high), optional
        The curve ends at the first point at which an observable leaves its range.
    stop : callable, optional
        `stop(point)` returns a sentence to end the curve there.
    progress : callable, optional
        `progress(count, special)` after each point and special point.
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
    with clock.limited(make_settings(options).max_seconds):
        prepared = _prepare(problem, parameter, bounds, start, keyframe, state, zeros, limits, stop, options)
        directions = check_direction(direction)
        walker = prepared.walker
        traces = run_directions(walker, prepared.x, walker.system.start_y(), directions, progress)
        branch = collect(
            "equilibria", walker.system, traces, directions, prepared.origin, walker.settings, prepared.neutral,
            prepared.notes,
        )
    return replace(branch, settings={**branch.settings, "zeros": dict(zeros)}) if zeros else branch


def iterate_equilibria(
    problem: Any,
    parameter: str,
    bounds: tuple[float, float] | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    direction: int = 1,
    zeros: Mapping[str, float] | None = None,
    limits: Mapping[str, tuple[float, float]] | None = None,
    **options: Any,
) -> Iterator[Point]:
    """Yield the points of a curve of equilibria one by one, special points among them, for callers who drive it.

    Arguments as for `continue_equilibria`, in one direction. Special points are `SpecialPoint`s without a label;
    the iterator ends where the curve does.
    """
    within = clock.allowance(make_settings(options).max_seconds)
    with within():
        prepared = _prepare(problem, parameter, bounds, start, keyframe, state, zeros, limits, None, options)
        (sign,) = check_direction(int(direction))
        walker = prepared.walker
        system = walker.system
    first = first_point(system, prepared.x, system.start_y(), sign, walker.settings)
    if isinstance(first, str):
        raise StartError(f"the curve could not be entered: {first}")
    yield make_point(system.problem, first.x, system.values(first.y))
    walk, item = walker.walk(first), None
    while not isinstance(item, End):
        try:
            with within():  # not across a yield: the caller's own time has no limit
                item = next(walk)
        except clock.TimeUp:
            return
        if isinstance(item, CurvePoint):
            yield make_point(system.problem, item.x, system.values(item.y))
        elif isinstance(item, Located):
            row = make_point(system.problem, item.point.x, system.values(item.point.y))
            yield special_point(row, item, "", 0, {p.name: (p.low, p.high) for p in system.free}, "equilibria")


@dataclass(frozen=True, slots=True)
class _Prepared:
    """A walk along a curve of equilibria, ready to start."""

    walker: Walker
    x: Array
    origin: str
    neutral: list[Located]
    notes: tuple[str, ...]


def _prepare(
    problem: Any,
    parameter: str,
    bounds: tuple[float, float] | None,
    start: Mapping[str, float] | Point | None,
    keyframe: str | None,
    state: Any,
    zeros: Mapping[str, float] | None,
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
    problem, notes = hold_rigid_modes(problem, x, values)
    refuse_pushing(problem, parameter, x, values)
    if notes:
        problem, notes = hold_rigid_modes(problem, x, values, {parameter: (low, high)})
    try:
        found = find_start(problem, x, values)
    except clock.TimeUp:
        raise StartError(f"no equilibrium found: the limit of {settings.max_seconds:g} s was reached") from None
    origin = _start_name(problem, start, keyframe, state)
    if found.failure:
        raise _no_start(problem, origin, found.failure)
    system = System(problem, values, [Free(parameter, low, high, problem.parameter(parameter).unit)])
    neutral: list[Located] = []
    walker = equilibrium_walker(
        system, settings, neutral, zeros, point_stop(problem, system, stop, limits)
    )
    origin = f"{origin}, by Newton" if found.method == "newton" else f"{origin}, by damped motion to rest"
    return _Prepared(walker, found.x, f"from {origin}", neutral, notes)


def hold_rigid_modes(
    problem: Any, x: Array, values: Values, ranges: Mapping[str, tuple[float, float]] | None = None
) -> tuple[Any, tuple[str, ...]]:
    """Return the problem with its rigid-body zero modes held, and a note that names them.

    A motion that something opposes elsewhere in the `ranges` of parameters is not held.
    """
    modes = found = problem.rigid_modes(x, values) if hasattr(problem, "rigid_modes") else ()
    for name, ends in (ranges or {}).items():
        for end in ends:
            beside = {**values, name: 0.7 * end + 0.3 * values[name]}
            modes = problem.rigid_modes(x, beside, modes) if modes else ()
    lost = [m for m in found if m not in modes]
    notes = [f"rigid-body zero modes held: {', '.join(modes)}"] if modes else []
    notes += [f"zero modes at the start that something opposes elsewhere, not held: {', '.join(lost)}"] if lost else []
    return problem.holding(modes) if modes or lost else problem, tuple(notes)


def refuse_pushing(problem: Any, parameter: str, x: Array, values: Values) -> None:
    """Raise a StartError if a parameter pushes along a held rigid-body mode: there is no equilibrium then."""
    held = getattr(problem, "held", ())
    if not held:
        return
    local = problem.linearize(x, values, (parameter,))
    push = local.par[:, 0]
    noise = 1e-12 * np.abs(local.jac).max()
    directions = problem.rigid_directions(x)
    for name in held:
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


def points_at(branch: Branch, name: str, value: float) -> list[Point]:
    """Return the points of a branch of equilibria at which a column has a value, corrected to it."""
    if branch.problem is None:
        raise MjcontError("the branch was loaded without its problem: mc.load(path, problem=...)")
    if branch.kind != "equilibria":
        raise MjcontError("at() works on branches of equilibria; on a locus use its special points or rows")
    name = column_of(name, branch.columns) or name
    column = branch[name] - value
    held, _ = hold_rigid_modes(branch.problem, branch.states[0], branch.parameters_at(0))
    branch = replace(branch, problem=held)
    found: list[Point] = []
    for i in range(len(branch) - 1):
        a, b = column[i], column[i + 1]
        if a == 0.0 or a * b < 0:
            point = _point_between(branch, i, a / (a - b) if a else 0.0, name, value)
            if point is not None:
                found.append(point)
    if len(branch) and column[-1] == 0.0:
        found.append(branch.row(len(branch) - 1))
    return found


def _point_between(branch: Branch, i: int, fraction: float, name: str, value: float) -> Point | None:
    problem = branch.problem
    step = problem.difference(branch.states[i + 1], branch.states[i])
    x = problem.retract(branch.states[i], fraction * step)
    free = [Free(n, *b) for n, b in branch.free.items()]
    between = {n: float((1 - fraction) * branch[n][i] + fraction * branch[n][i + 1]) for n in branch.free}
    base = {**branch.fixed, **between}
    if name in branch.free:
        system, y = System(problem, {**base, name: value}, ()), np.zeros(0)
    else:
        equilibria = System(problem, base, free)
        at = Corrected(x, equilibria.start_y(), equilibria.local(x, equilibria.start_y()), None, 0, 0.0, 0.0, 0.0)
        system, y = square_system(equilibria, [ScalarZero(monitor_of(problem, name, value))], at)
    c = solve(system, x, y)
    return None if c.failure else make_point(problem, c.x, system.values(c.y))
