"""The verb `backbone`: the responses whose phase says that they resonate, followed as the input grows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Progress
from mjcont.curves.continuation import check_direction
from mjcont.errors import MjcontError, ParameterError, StartError, unknown_name
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import solve
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.follow import laid
from mjcont.numerics.orbits.quadrature import InQuadrature
from mjcont.numerics.points.events import Detector
from mjcont.oscillation.at import between
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.walks import Entry, Special, Stop, flow_for, read_options, run
from mjcont.results.model import check_bounds
from mjcont.results.orbits import BACKBONE, RESPONSES, CycleBranch, Orbit
from mjcont.results.quantities import column_of

# entries of a force, of the largest, that count as none
_NONE = 1e-9


@checked
@np.errstate(all="ignore")
def backbone(
    response: CycleBranch,
    parameter: str | None = None,
    bounds: tuple[float, float] | None = None,
    *,
    observable: str | None = None,
    direction: int | None = None,
    stop: Stop | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> CycleBranch:
    """Follow the resonance of a response by its phase: where an observable is a quarter of a turn from its input.

    There the input makes up for what damping takes, and the motion is nearly that of a nonlinear mode.

    Parameters
    ----------
    response : CycleBranch
        A curve of responses in frequency, which passes such a resonance.
    parameter : str, optional
        What varies beside the frequency; default the input's amplitude.
    bounds : (low, high), optional
        Its range; default the parameter's own.
    observable : str, optional
        Whose phase tells; default the coordinate on which the input acts, where that is one.
    direction, stop, progress, **options
        As for `continue_cycles`.

    Returns
    -------
    CycleBranch
        In `parameter` and frequency; of several resonances that with the largest amplitude.

    Raises
    ------
    MjcontError, NameLookupError, BoundsError, ParameterError, StartError
        See their messages.
    """
    if not isinstance(response, CycleBranch) or response.kind != RESPONSES or len(response.free) != 1:
        raise MjcontError("a backbone belongs to a curve of responses in frequency (continue_response)")
    flow = flow_for(response.model, response.forcing, response.orbits[0].chart)
    free, condition, begin = _sought(flow, response, parameter, bounds, observable)
    flow = flow_for(response.model, response.forcing, begin.chart)
    own = {"scheme": begin.path.scheme.name, "degree": begin.path.scheme.degree}
    read = read_options(flow, {**own, **options})
    lead, tuned = free
    (orbits, x), values = _settled(flow, begin, tuned, condition)
    if not lead.low <= values[lead.name] <= lead.high:
        raise StartError(f"the response has {lead.name} = {lead.show(values[lead.name])}, outside the bounds "
                         f"{lead.show(lead.low)} .. {lead.show(lead.high)}")
    system = System(orbits, values, free, [condition])
    entries = [Entry(sign, x, system.start_y(), None) for sign in check_direction(direction)]
    special = Special(_nothing, _held(condition), frozenset())
    where = f"a quarter of a turn from the input at {tuned.name} = {tuned.show(values[tuned.name])}"
    return run(BACKBONE, system, entries, read, where, stop, progress, (), special)


def _sought(
    flow: ModelFlow,
    response: CycleBranch,
    parameter: str | None,
    bounds: tuple[float, float] | None,
    observable: str | None,
) -> tuple[tuple[Free, Free], InQuadrature, Orbit]:
    """Return the free parameters, the condition, and an orbit that nearly fulfils it."""
    (tuned,), (name, harmonic) = response.free, _input(flow)
    parameter = parameter or (f"{name}.amplitude" if name else None)
    if parameter is None or parameter == tuned:
        raise ParameterError(f"name the parameter that varies beside {tuned}, such as the amplitude of the input")
    low, high = check_bounds(flow, parameter, bounds)
    seen = _observable(flow, response, name, observable)
    begin = _resonance(response, seen, _turns(flow) * harmonic, f"{name}.phase" if name else None)
    free = Free(parameter, low, high, flow.parameter(parameter).unit)
    free_too = Free(tuned, *response.free[tuned], flow.parameter(tuned).unit, False)
    return (free, free_too), _quarter_turn(flow, begin, seen, name, harmonic), begin


def _turns(flow: ModelFlow) -> int:
    """Return how many periods of the forcing make one of the orbit."""
    return int(flow.record().get("periods", 1))


def _quarter_turn(flow: ModelFlow, orbit: Orbit, seen: str, name: str, harmonic: int) -> InQuadrature:
    """Return the condition that an observable is a quarter of a turn from an input; its size is an orbit's."""
    column, turns = list(flow.model.observables).index(seen), _turns(flow) * harmonic

    def read(states: Array, phases: Array, values: Values) -> Array:
        return flow.measured(states, phases, values)[:, column]

    def angle(phases: Array, values: Values) -> Array:
        found: Array = 2.0 * np.pi * turns * phases + (values[f"{name}.phase"] if name else 0.0)
        return found

    return InQuadrature(read, angle, float(abs(orbit.harmonics(seen, turns)[-1])))


def _nothing(system: System, settings: Settings) -> list[Detector]:
    del system, settings
    return []


def _held(condition: InQuadrature) -> Callable[[System, Array, Array], System]:
    """Return what makes the curve's equations on another mesh."""

    def held(plain: System, x: Array, y: Array) -> System:
        del x, y
        return System(plain.problem, plain.base, plain.free, [condition])

    return held


def _input(flow: ModelFlow) -> tuple[str, int]:
    """Return the name of the one input and its harmonic; of a field with a period of its own nothing, and 1."""
    if flow.forcing is None:
        return "", 1
    inputs = flow.forcing.inputs
    if len(inputs) != 1:
        raise MjcontError(f"the response has {len(inputs)} inputs: its phase can be told from one only")
    ((name, harmonic),) = inputs.items()
    return name, harmonic.harmonic


def _observable(flow: ModelFlow, response: CycleBranch, name: str, given: str | None) -> str:
    """Return the observable whose phase tells."""
    known = flow.model.observables
    if given is not None:
        found = column_of(given, known)
        if found is None:
            raise unknown_name("observable", given, known)
        return found
    own = _driven_coordinate(flow, response, name) if name else None
    found = None if own is None else column_of(own, known)
    if found is None:
        raise ParameterError("the input acts on no one coordinate: name the observable whose phase is to tell, "
                             f"observable=... Valid: {', '.join(known)}.")
    return found


def _driven_coordinate(flow: ModelFlow, response: CycleBranch, name: str) -> str | None:
    """Return the coordinate on which an input acts, None where it acts on several, or on none."""
    model, orbit = flow.model, response.orbits[0]
    n = model.n
    values = orbit.constants() | {name: orbit.parameters[name]}
    force = model.linearize(flow.state(orbit.path.s[0]), values, (name,)).par
    acts = np.flatnonzero(np.abs(force[:, 0]) > _NONE * np.abs(force).max())
    if len(acts) != 1 or flow.chart is not None:  # a rotation is no coordinate of the model
        return None
    i = int(acts[0]) - (0 if model.second_order else n // 2)
    return model.state_labels[i][0] if 0 <= i < n else None


def _resonance(response: CycleBranch, seen: str, harmonic: int, phase: str | None) -> Orbit:
    """Return an orbit near to where an observable is a quarter of a turn from its input, of the largest amplitude.

    Raises
    ------
    StartError
        If the curve has none.
    """
    lag = np.array([
        o.harmonics(seen, harmonic)[-1] * np.exp(-1j * (o.parameters[phase] if phase else 0.0)) for o in response.orbits
    ])
    found = [
        i for i in range(len(lag) - 1)  # ahead, where the input works against the observable's own sign
        if lag[i].real * lag[i + 1].real <= 0.0 and lag[i].imag * lag[i + 1].imag > 0.0
    ]
    if not found:
        raise StartError(f"{seen} is a quarter of a turn from the input nowhere on the response: follow it through its "
                         "resonance, or name another observable")
    i = max(found, key=lambda k: float(abs(lag[k])))
    a, b = lag[i].real, lag[i + 1].real
    fraction = float(a / (a - b)) if a != b else 0.0
    (name,) = response.free
    one, other = response.orbits[i], response.orbits[i + 1]
    value = (1.0 - fraction) * one.parameters[name] + fraction * other.parameters[name]
    path = between(flow_for(response.model, response.forcing, one.chart), one, other, fraction)
    return replace(one, path=path, parameters={**one.parameters, name: value})


def _settled(
    flow: ModelFlow, near: Orbit, frequency: Free, condition: InQuadrature
) -> tuple[tuple[Orbits, Array], dict[str, float]]:
    """Return the resonant orbit with the equations on its mesh, and its parameters.

    Raises
    ------
    StartError
        If it is lost.
    """
    orbits = laid(flow, near.path, near.shift)
    system = System(orbits, near.parameters, [frequency], [condition])
    c = solve(system, orbits.joined(near.path), system.start_y(), reach=10.0)
    if c.failure is not None:
        raise StartError(f"the resonance was lost as it was corrected: {c.failure}")
    return (orbits, c.x), system.values(c.y)
