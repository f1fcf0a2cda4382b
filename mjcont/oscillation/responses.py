"""The verb `continue_response`: periodic motion under periodic inputs."""

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
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.follow import laid, orbit_near
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.points import path_at
from mjcont.oscillation.cycles import from_orbit
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.forced import FREQUENCY, Harmonic, check_forcing, check_inputs, make_forcing
from mjcont.oscillation.onward import flow_at, orbit_at
from mjcont.oscillation.starts import response_path, sampled_path
from mjcont.oscillation.walks import Entry, Options, Stop, flow_of, read_options, run
from mjcont.results.model import Model, check_bounds
from mjcont.results.orbits import RESPONSES, CycleBranch, Orbit, OrbitPoint, SpecialOrbit
from mjcont.results.points import Point, show
from mjcont.vectorfield import VectorField

AnyOrbit = OrbitPoint | SpecialOrbit | Orbit
Start = Mapping[str, float] | Point | AnyOrbit


@checked
@np.errstate(all="ignore")
def continue_response(
    problem: Model | AnyOrbit,
    parameter: str | None = None,
    bounds: tuple[float, float] | None = None,
    forcing: Mapping[str, Harmonic] | None = None,
    start: Start | None = None,
    *,
    frequency: float | None = None,
    keyframe: str | None = None,
    state: Any = None,
    direction: int | None = None,
    stop: Stop | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> CycleBranch:
    """Follow periodic motion under periodic inputs in one parameter.

    Parameters
    ----------
    problem : Mechanism or VectorField, or an orbit
        A field with a `period` is forced as it stands. A PD of a response begins the curve of twice the period, a BPC
        the other branch, any other orbit its own curve; its forcing is known.
    parameter : str
        The parameter to vary: "frequency" (1 / period, Hz), "NAME.amplitude" or "NAME.phase" of an input, or any
        parameter of the model; that of an input is its mean.
    bounds : (low, high), optional
        Its range; default the parameter's own.
    forcing : mapping of parameter to Harmonic
        What moves in time, unless the field has a period.
    start : dict of parameter values, a point of any result, or an orbit
        Other parameters keep the model's values. Near an orbit the first motion is looked for: one of another model
        with as many coordinates, of another forcing, or on another curve.
    frequency : float, optional
        Of the forcing, in Hz; default where the bounds begin if it is the parameter that varies.
    keyframe, state : optional
        Near which state the first motion is looked for.
    direction, stop, progress, **options
        As for `continue_cycles`.

    Raises
    ------
    MjcontError, NameLookupError, BoundsError, ParameterError, StartError
        See their messages.
    """
    if isinstance(problem, AnyOrbit):
        if any(given is not None for given in (forcing, start, frequency, keyframe, state)):
            raise MjcontError("an orbit has its forcing and is its own start: give the parameter and bounds alone")
        return from_orbit(problem, parameter, bounds, direction, stop, progress, options)
    if parameter is None:
        raise MjcontError("name the parameter to vary: frequency, NAME.amplitude, or one of the model's")
    flow, values = _driven(problem, parameter, bounds, forcing, start, frequency)
    read = read_options(flow, options)
    low, high = _range(flow, parameter, bounds, values)
    unit = flow.parameter(parameter).unit
    orbits, x = _first(flow, _pose(problem, start, keyframe, state), start, values, read)
    system = System(orbits, values, [Free(parameter, low, high, unit)])
    entries = [Entry(sign, x, system.start_y(), None) for sign in check_direction(direction)]
    return run(RESPONSES, system, entries, read, "the motion settled from its start", stop, progress)


def _values_of(start: Start | None) -> Mapping[str, float]:
    """Return the parameter values that a start has."""
    if isinstance(start, AnyOrbit):
        return orbit_at(start).parameters
    return start.parameters if isinstance(start, Point) else start or {}


def _range(
    flow: ModelFlow, parameter: str, bounds: tuple[float, float] | None, values: dict[str, float]
) -> tuple[float, float]:
    """Return the bounds of the free parameter.

    Raises
    ------
    BoundsError
        If the start lies outside, or an input would leave its range within them.
    """
    low, high = check_bounds(flow, parameter, bounds)
    unit = flow.parameter(parameter).unit
    if not low <= values[parameter] <= high:
        raise BoundsError(
            f"the start has {parameter} = {show(values[parameter], unit)}, outside the bounds {show(low, unit)} .. "
            f"{show(high, unit)}: give start={{'{parameter}': ...}} inside them"
        )
    if flow.forcing is not None:
        for end in (low, high):
            check_inputs(flow.model, flow.forcing, {**values, parameter: end})
    return low, high


def _like(start: AnyOrbit, flow: ModelFlow, values: dict[str, float], read: Options) -> tuple[Path, Array]:
    """Return an orbit as a motion of another flow, and what it gains in a period.

    Raises
    ------
    MjcontError
        If it has another number of coordinates.
    """
    orbit = orbit_at(start)
    if orbit.path.s.shape[1] != flow.d:
        raise MjcontError(f"the orbit given as start has states of {orbit.path.s.shape[1]} numbers, {flow.model.name} "
                          f"moves in {flow.d}")
    own, meshes = flow_at(orbit), read.meshes
    states = flow.taken(orbit.path, own).states if own.chart is not None else orbit.path.states
    path = sampled_path(flow, meshes.scheme, max(meshes.first, len(orbit.path.w)), states, flow.period(values), values)
    return path, orbit.shift if len(orbit.shift) else np.zeros(flow.d)


def _pose(problem: Model, start: Start | None, keyframe: str | None, state: Any) -> Array:
    """Return the state (nq,) near which a response is looked for."""
    if isinstance(start, AnyOrbit):
        return orbit_at(start).states[0]
    return start_from(problem, None, keyframe, start.state if isinstance(start, Point) and state is None else state)[0]


def _first(
    flow: ModelFlow, x: Array, start: Start | None, values: dict[str, float], read: Options
) -> tuple[Orbits, Array]:
    """Return the response near a state, or near an orbit given as start, with the equations on its mesh.

    Raises
    ------
    StartError
        If there is none.
    """
    flow = flow.about(x)
    if isinstance(start, AnyOrbit):
        path, shift = _like(start, flow, values, read)
    else:
        path, shift = response_path(flow, x, values, read.meshes), np.zeros(flow.d)
    point = orbit_near(flow, path, values, shift, read.meshes)
    if point is None:
        why = f": {flow.touches}" if flow.touches else ""
        raise StartError(f"no periodic response found at the start{why}; give state=, or begin at a smaller amplitude")
    path = path_at(point)
    orbits = laid(flow, path, shift)
    return orbits, orbits.joined(path)


def _driven(
    problem: Model,
    parameter: str,
    bounds: tuple[float, float] | None,
    forcing: Mapping[str, Harmonic] | None,
    start: Start | None,
    frequency: float | None,
) -> tuple[ModelFlow, dict[str, float]]:
    """Return the motion under its forcing, and the start's parameter values."""
    given = dict(_values_of(start))
    if isinstance(problem, VectorField) and problem.period is not None:
        if forcing is not None or frequency is not None:
            raise ParameterError(f"{problem.name} has a period of its own: forcing= and frequency= say it twice")
        flow = flow_of(problem)
        return flow, flow.values({k: v for k, v in given.items() if k in problem.parameters})
    inputs = check_forcing(problem, forcing)
    if frequency is None:
        frequency = given.get(FREQUENCY)
    if frequency is None and parameter == FREQUENCY and bounds is not None:
        frequency = check_bounds(flow_of(problem, make_forcing(problem, inputs, 1.0)), FREQUENCY, bounds)[0]
    if frequency is None:
        raise ParameterError("frequency= of the forcing is needed, in Hz")
    flow = flow_of(problem, make_forcing(problem, inputs, frequency))
    known = {k: v for k, v in given.items() if isinstance(start, Mapping) or k in flow.values() or ":" in k}
    return flow, flow.values({**known, FREQUENCY: frequency})
