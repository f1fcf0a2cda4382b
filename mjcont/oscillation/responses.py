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
from mjcont.numerics.orbits.points import path_at
from mjcont.oscillation.cycles import from_orbit
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.forced import FREQUENCY, Harmonic, check_forcing, check_inputs, make_forcing
from mjcont.oscillation.starts import response_path
from mjcont.oscillation.walks import Entry, Options, Stop, flow_of, read_options, run
from mjcont.results.model import Model, check_bounds
from mjcont.results.orbits import RESPONSES, CycleBranch, Orbit, OrbitPoint, SpecialOrbit
from mjcont.results.points import Point, show
from mjcont.vectorfield import VectorField


@checked
@np.errstate(all="ignore")
def continue_response(
    problem: Model | OrbitPoint | SpecialOrbit | Orbit,
    parameter: str | None = None,
    bounds: tuple[float, float] | None = None,
    forcing: Mapping[str, Harmonic] | None = None,
    start: Mapping[str, float] | Point | None = None,
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
    start : dict of parameter values, or a point of any result
        Other parameters keep the model's values.
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
    if isinstance(problem, OrbitPoint | SpecialOrbit | Orbit):
        if any(given is not None for given in (forcing, start, frequency, keyframe, state)):
            raise MjcontError("an orbit has its forcing and is its own start: give the parameter and bounds alone")
        return from_orbit(problem, parameter, bounds, direction, stop, progress, options)
    if parameter is None:
        raise MjcontError("name the parameter to vary: frequency, NAME.amplitude, or one of the model's")
    flow, values = _driven(problem, parameter, bounds, forcing, start, frequency)
    read = read_options(flow, options)
    low, high = _range(flow, parameter, bounds, values)
    unit = flow.parameter(parameter).unit
    x, _ = start_from(problem, None, keyframe, start.state if isinstance(start, Point) and state is None else state)
    orbits, x = _first(flow, x, values, read)
    system = System(orbits, values, [Free(parameter, low, high, unit)])
    entries = [Entry(sign, x, system.start_y(), None) for sign in check_direction(direction)]
    return run(RESPONSES, system, entries, read, "the motion settled from its start", stop, progress)


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


def _first(flow: ModelFlow, x: Array, values: dict[str, float], read: Options) -> tuple[Orbits, Array]:
    """Return the response near a state, with the equations on its mesh.

    Raises
    ------
    StartError
        If there is none.
    """
    shift = np.zeros(flow.d)
    point = orbit_near(flow, response_path(flow, x, values, read.meshes), values, shift, read.meshes)
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
    start: Mapping[str, float] | Point | None,
    frequency: float | None,
) -> tuple[ModelFlow, dict[str, float]]:
    """Return the motion under its forcing, and the start's parameter values."""
    given = dict(start.parameters if isinstance(start, Point) else start or {})
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
    known = {k: v for k, v in given.items() if not isinstance(start, Point) or k in flow.values() or ":" in k}
    return flow, flow.values({**known, FREQUENCY: frequency})
