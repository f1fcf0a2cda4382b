"""The verbs `continue_cycles` and `find_cycle`: limit cycles from Hopf points, motions and other orbits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Progress
from mjcont.curves.continuation import check_direction, start_from
from mjcont.errors import BoundsError, MjcontError, ParameterError, StartError
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.follow import laid, orbit_near
from mjcont.numerics.orbits.path import Path
from mjcont.oscillation.collect import make_orbit
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.motions import cycle_of
from mjcont.oscillation.onward import bounded, entries_at, flow_at, orbit_at, parameter_at
from mjcont.oscillation.starts import harmonic_orbit, hopf_vector
from mjcont.oscillation.walks import Entry, Options, Stop, flow_of, read_options, run
from mjcont.results.histories import History
from mjcont.results.model import Model, check_bounds
from mjcont.results.orbits import CYCLES, CycleBranch, Orbit, OrbitPoint, SpecialOrbit
from mjcont.results.points import Point, SpecialPoint
from mjcont.vectorfield import VectorField

# size of the first orbit beside a Hopf point, relative to the state's scales
_FIRST = 1e-2
Start = Mapping[str, float] | Point | History


@np.errstate(all="ignore")
@checked
def continue_cycles(
    origin: SpecialPoint | OrbitPoint | Orbit | Model,
    parameter: str | None = None,
    bounds: tuple[float, float] | None = None,
    start: Start | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    direction: int | None = None,
    stop: Stop | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> CycleBranch:
    """Follow a curve of limit cycles in one parameter, with their Floquet multipliers and special points.

    Parameters
    ----------
    origin : point, orbit or model
        A Hopf point of a branch, or any special point of a Hopf locus: its cycles are followed towards larger ones. A
        PD of a curve of orbits: those of twice the period. A BPC: the other branch. Any other orbit: its own curve. A
        model: the cycle on which its motion from `start` settles.
    parameter : str, optional
        The parameter to vary; default that of the point's curve (of a locus its first).
    bounds : (low, high), optional
        Its range; default that of the point's curve.
    start : dict of parameter values, a point, or a History, optional
        With a model: where the motion begins; at the end of a History.
    keyframe, state : optional
        As for `continue_equilibria`.
    direction : {None, +1, -1}
        Both directions, or only that in which the parameter first grows or falls; not at points where curves begin.
    stop : callable, optional
        `stop(point)` returns a sentence to end the curve there; `point.orbit` is its orbit.
    progress : callable, optional
        `progress(count, found)` after each orbit; `found.kind` is that of a special one, empty at others.
    **options
        `mesh`, `degree`, `scheme`, `tol`, `mesh_max`, `period_max`, and fields of `Settings` (ds, ds_max, ...).

    Raises
    ------
    MjcontError, NameLookupError, BoundsError, ParameterError, StartError
        See their messages. Failure of the continuation itself is no exception but the branch's status.
    """
    if isinstance(origin, Model):
        return _from_motion(origin, parameter, bounds, start, keyframe, state, direction, stop, progress, options)
    if start is not None or keyframe is not None or state is not None:
        raise MjcontError("start=, keyframe= and state= say where a model's motion begins: a point begins at itself")
    if isinstance(origin, SpecialOrbit | OrbitPoint | Orbit):
        return from_orbit(origin, parameter, bounds, direction, stop, progress, options)
    if not isinstance(origin, SpecialPoint):
        raise MjcontError(f"cycles begin at a point of kind HB, PD or BPC, an orbit or a model; got "
                          f"{type(origin).__name__}")
    if origin.kind != "HB" and origin.curve != "HB locus":
        raise MjcontError(f"{origin.label or 'the point'} is of kind {origin.kind or 'regular'}: limit cycles begin at "
                          "points of kind HB")
    flow = flow_of(origin.model).about(origin.state)
    read = read_options(flow, options)
    name = parameter if parameter is not None else next(iter(origin.free))
    low, high = check_bounds(flow, name, bounds if bounds is not None else origin.free.get(name))
    return _from_hopf(flow, origin, Free(name, low, high, flow.parameter(name).unit), read, stop, progress)


def from_orbit(
    point: SpecialOrbit | OrbitPoint | Orbit,
    parameter: str | None,
    bounds: tuple[float, float] | None,
    direction: int | None,
    stop: Stop | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> CycleBranch:
    """Return the curve that begins at an orbit, of cycles or of responses."""
    orbit, name = orbit_at(point), parameter_at(point, parameter)
    flow = flow_at(orbit)
    read = read_options(flow, {"scheme": orbit.path.scheme.name, "degree": orbit.path.scheme.degree, **options})
    free = bounded(flow, point, name, bounds)
    system, entries, origin = entries_at(flow, point, free)
    if all(e.row is None for e in entries):
        entries = [e for e in entries if e.direction in check_direction(direction)]
    return run(flow.curve, system, entries, read, origin, stop, progress)


def _from_hopf(
    flow: ModelFlow, point: SpecialPoint, free: Free, options: Options, stop: Stop | None, progress: Progress | None
) -> CycleBranch:
    values = flow.values({k: v for k, v in point.parameters.items() if k in flow.values()})
    if not free.low <= values[free.name] <= free.high:
        raise ParameterError(f"{point.label} has {free.name} = {free.show(values[free.name])}, outside the bounds "
                             f"{free.show(free.low)} .. {free.show(free.high)}")
    mean, vector, omega = hopf_vector(flow, point)
    orbits, x, along = harmonic_orbit(flow, options.meshes.scheme, options.meshes.first, mean, vector, omega, _FIRST)
    system = System(orbits, values, [free])
    row = np.concatenate([along / orbits.state_scale, [0.0]])
    entry = Entry(1.0, x, system.start_y(), row / np.linalg.norm(row))
    origin = f"small orbits at {point.label}, {free.name} = {free.show(values[free.name])}"
    return run(CYCLES, system, [entry], options, origin, stop, progress)


def _from_motion(
    problem: Model,
    parameter: str | None,
    bounds: tuple[float, float] | None,
    start: Start | None,
    keyframe: str | None,
    state: Any,
    direction: int | None,
    stop: Stop | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> CycleBranch:
    if parameter is None:
        raise MjcontError(f"name the parameter to vary. Valid: {', '.join(problem.parameters)}.")
    flow = _unforced(problem)
    read, directions = read_options(flow, options), check_direction(direction)
    low, high = check_bounds(flow, parameter, bounds)
    free = Free(parameter, low, high, flow.parameter(parameter).unit)
    state, values, duration = _motion(problem, start, keyframe, state)
    if not low <= values[parameter] <= high:
        raise BoundsError(f"the start has {parameter} = {free.show(values[parameter])}, outside the bounds "
                          f"{free.show(low)} .. {free.show(high)}")
    flow = flow.about(state)
    path, shift = _cycle(flow, state, values, read, duration)
    orbits = laid(flow, path, shift)
    system = System(orbits, values, [free])
    entries = [Entry(sign, orbits.joined(path), system.start_y(), None) for sign in directions]
    return run(CYCLES, system, entries, read, "the cycle on which a motion settles", stop, progress)


@np.errstate(all="ignore")
@checked
def find_cycle(
    problem: Model, start: Start | None = None, *, keyframe: str | None = None, state: Any = None, **options: Any
) -> Orbit:
    """Return the limit cycle on which the motion from a start settles, corrected.

    Parameters
    ----------
    problem : Mechanism or VectorField
    start, keyframe, state, **options : as for `continue_cycles`.

    Raises
    ------
    MjcontError, StartError
        If the model is forced, or its motion comes to rest, diverges or does not come back to where it was.
    """
    flow = _unforced(problem)
    read = read_options(flow, options)
    state, values, duration = _motion(problem, start, keyframe, state)
    flow = flow.about(state)
    path, shift = _cycle(flow, state, values, read, duration)
    point = orbit_near(flow, path, values, shift, read.meshes)
    if point is None:
        raise StartError("the cycle was lost as it was corrected")
    return make_orbit(point)


def _cycle(
    flow: ModelFlow, state: Array, values: dict[str, float], read: Options, duration: float | None
) -> tuple[Path, Array]:
    """Return the cycle on which a motion settles, and what it gains in a period."""
    whole = flow.resting(state, values)
    if flow.undamped(whole, values):
        raise MjcontError(f"{flow.model.name} has no damping: its orbits form a family, one for each energy, and no "
                          "motion settles on one; follow the family (continue_modes), or force it (continue_response)")
    return cycle_of(flow, whole, values, read.meshes, duration)


def _unforced(problem: Model) -> ModelFlow:
    if isinstance(problem, VectorField) and problem.period is not None:
        raise MjcontError(f"{problem.name} is forced: continue_response follows its periodic motion")
    return flow_of(problem)


def _motion(
    problem: Model, start: Start | None, keyframe: str | None, state: Any
) -> tuple[Array, dict[str, float], float | None]:
    """Return the state, or state and velocity, where a motion begins, parameter values, and a time to follow it for."""
    if not isinstance(start, History):
        x, values = start_from(problem, start, keyframe, state)
        return x, values, None
    moved = (c for c in start.columns.values() if c.role == "parameter" and c.name in problem.parameters)
    given = {c.name: float(c.values[-1]) for c in moved}
    values = problem.values({k: v for k, v in {**start.fixed, **given}.items() if k in problem.parameters})
    last = [start.states[-1], start.velocities[-1]] if problem.second_order else [start.states[-1]]
    time = start["time"]
    return np.concatenate(last), values, float(time[-1] - time[0]) or None
