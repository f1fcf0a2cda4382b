"""The verb `continue_modes`: families of periodic motions of a mechanism without damping, one from each linear mode.

The small orbits of a mode with shape z and rate omega are u = u0 + a Re(z exp(i omega t)) (Lyapunov); they are
followed in energy or frequency. Source: Kerschen, Peeters, Golinval and Vakakis, Nonlinear normal modes, part I
(Mechanical Systems and Signal Processing 23, 2009).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Progress
from mjcont.curves.continuation import start_from
from mjcont.errors import BoundsError, MjcontError, ParameterError, StartError, unknown_name
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.conserved import ENERGY, FREQUENCY
from mjcont.numerics.orbits.follow import laid
from mjcont.numerics.orbits.resonances import ORDERS, family_detectors
from mjcont.numerics.orbits.switch import departures, system_at
from mjcont.oscillation.conserving import CHOICES, Conserving, without_losses
from mjcont.oscillation.families import LinearMode, in_energy, in_frequency, linear_modes
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.onward import entries_at, flow_at, orbit_at
from mjcont.oscillation.walks import Entry, Options, Special, Stop, flow_of, read_options, run
from mjcont.results.model import Model, check_bounds
from mjcont.results.orbits import MODES, CycleBranch, Orbit, OrbitPoint, SpecialOrbit
from mjcont.results.points import Point
from mjcont.vectorfield import VectorField

# energies within which a curve in frequency is entered, times that of its orbit
_LEAST, _MOST = 1e-2, 1e2
# periods of orbits at internal resonances: two are told by a PD, many by nothing that could be seen
_FEWEST, _MANY = 3, 12


@checked
@np.errstate(all="ignore")
def continue_modes(
    origin: Model | SpecialOrbit | OrbitPoint | Orbit,
    parameter: str = ENERGY,
    bounds: tuple[float, float] | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    mode: int = 1,
    keyframe: str | None = None,
    state: Any = None,
    resonances: Sequence[int] = ORDERS,
    stop: Stop | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> CycleBranch:
    """Follow a nonlinear normal mode: the periodic motions without damping that begin as a linear mode.

    Parameters
    ----------
    origin : model or orbit
        A mechanism, or a VectorField that keeps an energy: the family begins at rest, at an equilibrium. What resists
        the motion is left out, and named in the branch's notes; loads stay at their values, unless they have no
        potential. A BPC, PD or IR of such a curve: the other branch, or orbits of two, three or four periods, where
        modes resonate. Any other orbit of one: its own curve.
    parameter : {"energy", "frequency"}
        What varies: the energy beyond that at rest (J), or 1 / period (Hz).
    bounds : (low, high)
        Positive; of an orbit's own curve by default those it has.
    start : dict of parameter values, or a point of any result, optional
    mode : int
        Which linear mode, counted from 1 by rising frequency among those that swing.
    keyframe, state : optional
        Near which state the equilibrium is looked for.
    resonances : sequence of int
        Numbers of periods of the orbits whose beginnings are located, IR; none of them where it is empty.
    stop, progress, **options
        As for `continue_cycles`; the scheme is "gauss" unless given.

    Returns
    -------
    CycleBranch
        Columns as for cycles, and `energy`. An orbit is stable where its multipliers are on the unit circle.

    Raises
    ------
    MjcontError, NameLookupError, BoundsError, ParameterError, StartError
        See their messages.
    """
    if parameter not in CHOICES:
        raise unknown_name("parameter of modes", str(parameter), CHOICES)
    special = _special(resonances)
    if isinstance(origin, SpecialOrbit | OrbitPoint | Orbit):
        if any(given is not None for given in (start, keyframe, state)):
            raise MjcontError("an orbit is its own start: give the parameter and bounds alone")
        return _from_orbit(origin, parameter, bounds, special, stop, progress, options)
    if not isinstance(origin, Model):
        raise MjcontError(f"modes begin at a model, or at an orbit of a curve of modes; got {type(origin).__name__}")
    return _from_rest(origin, parameter, bounds, start, mode, keyframe, state, special, stop, progress, options)


def _special(resonances: Sequence[int]) -> Special:
    """Return what is looked for along a family.

    Raises
    ------
    ParameterError
        If a number of periods is none of three or more.
    """
    orders = tuple(resonances)
    if not all(isinstance(k, int) and not isinstance(k, bool) and _FEWEST <= k <= _MANY for k in orders):
        raise ParameterError(f"resonances must be whole numbers from {_FEWEST} to {_MANY}, got {resonances!r}")
    return Special(partial(family_detectors, orders=orders), None, frozenset())


def _from_rest(
    origin: Model,
    parameter: str,
    bounds: tuple[float, float] | None,
    start: Mapping[str, float] | Point | None,
    mode: int,
    keyframe: str | None,
    state: Any,
    special: Special,
    stop: Stop | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> CycleBranch:
    x, values = start_from(origin, _plain(start), keyframe, state)
    loose = origin.rigid_modes(x, values)
    if loose:
        raise MjcontError(f"{origin.name} moves freely: nothing opposes {' and '.join(loose)}, which would make every "
                          "orbit one of many; let a spring do it")
    flow, values, notes = without_losses(_unforced(origin), x, values, parameter)
    read = read_options(flow, {"scheme": "gauss", **options})
    if bounds is None:
        raise BoundsError(f"give the range of the {parameter}: bounds=(low, high), in {flow.parameter(parameter).unit}")
    low, high = check_bounds(flow, parameter, bounds)
    free = Free(parameter, low, high, flow.parameter(parameter).unit)
    number, chosen = _checked_mode(linear_modes(flow, values), mode)
    system, entry = (in_energy if parameter == ENERGY else in_frequency)(flow, values, chosen, free, read)
    where = f"small motions in mode {number}, {chosen.omega / (2.0 * math.pi):.6g} Hz"
    return run(MODES, system, [entry], read, where, stop, progress, notes, special)


def _checked_mode(modes: Sequence[LinearMode], mode: Any) -> tuple[int, LinearMode]:
    if isinstance(mode, bool) or not isinstance(mode, int) or not 1 <= mode <= len(modes):
        known = ", ".join(f"{i} ({m.omega / (2.0 * math.pi):.6g} Hz)" for i, m in enumerate(modes, 1))
        raise ParameterError(f"mode must be one of those that swing: {known or 'there is none'}; got {mode!r}")
    return mode, modes[mode - 1]


def _plain(start: Mapping[str, float] | Point | None) -> Mapping[str, float] | Point | None:
    """Return a start; of an orbit's point only the parameters: its state is one in motion."""
    if isinstance(start, OrbitPoint | SpecialOrbit):
        orbit = orbit_at(start)
        return dict(orbit.constants()) | {n: orbit.parameters[n] for n in orbit.forcing.get("inputs", {})}
    return start


def _unforced(problem: Model) -> ModelFlow:
    if isinstance(problem, VectorField) and problem.period is not None:
        raise MjcontError(f"{problem.name} is forced: modes are motions without inputs; give the field without them")
    found = flow_of(problem)
    if found.activated:
        raise MjcontError(f"{problem.name} has actuators with states of their own (filters, muscles), which keep no "
                          "energy: make them motors")
    return found


# -- from an orbit of a curve of modes -------------------------------------------------------------------------


def _from_orbit(
    point: SpecialOrbit | OrbitPoint | Orbit,
    parameter: str,
    bounds: tuple[float, float] | None,
    special: Special,
    stop: Stop | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> CycleBranch:
    orbit = orbit_at(point)
    motion = flow_at(orbit)
    if not isinstance(motion, Conserving):
        raise MjcontError("the orbit loses energy or is driven: modes begin at a model, or at an orbit of a curve of "
                          "modes")
    read = read_options(motion, {"scheme": orbit.path.scheme.name, "degree": orbit.path.scheme.degree, **options})
    flow = motion.chosen(ENERGY)
    turned = _in_terms_of_energy(point, orbit, flow)
    if bounds is None and not (isinstance(point, SpecialOrbit) and parameter in point.free):
        raise BoundsError(f"give the range of the {parameter}: bounds=(low, high)")
    known = point.free.get(parameter) if isinstance(point, SpecialOrbit) else None
    low, high = check_bounds(motion.chosen(parameter), parameter, bounds if bounds is not None else known)
    free = Free(parameter, low, high, motion.chosen(parameter).parameter(parameter).unit)
    own = float(orbit.energy or 0.0)
    energies = free if parameter == ENERGY else Free(ENERGY, _LEAST * own, _MOST * own)
    if isinstance(turned, SpecialOrbit) and turned.kind == "IR":
        system, entries, origin = _several_periods(flow, turned, energies, read)
    else:
        system, entries, origin = entries_at(flow, turned, energies)
    if parameter == FREQUENCY:
        system, entries = _in_terms_of_frequency(system, entries, free)
    _check_inside(system, entries, free)
    return run(MODES, system, entries, read, origin, stop, progress, (), special, _periods(turned))


def _periods(point: SpecialOrbit | Orbit) -> int:
    """Return how many periods the orbits have that begin at a point."""
    kind = point.kind if isinstance(point, SpecialOrbit) else ""
    if isinstance(point, SpecialOrbit) and kind == "IR":
        return int(str(point.coefficients["order"]))
    return 2 if kind == "PD" else 1


def _several_periods(
    flow: Conserving, point: SpecialOrbit, free: Free, read: Options
) -> tuple[System, list[Entry], str]:
    """Return the curve of orbits of several periods that begins at an internal resonance."""
    orbit, order = orbit_at(point), _periods(point)
    system, x, y = system_at(flow, orbit.path, orbit.shift, dict(orbit.parameters), (free,))
    root = order, int(str(point.coefficients["turns"]))
    found = departures(flow, orbit.path, orbit.shift, system, x, y, root, read.settings)
    if not found:
        raise StartError(f"{point.label}: no orbits of {order} periods were found beside it")
    entries = [Entry(sign, d.x, d.y, d.row) for sign, d in zip((-1.0, 1.0), found, strict=False)]
    return found[0].system, entries, f"orbits of {order} periods at {point.label}"


def _in_terms_of_frequency(system: System, entries: Sequence[Entry], free: Free) -> tuple[System, list[Entry]]:
    """Return a curve in energy, and where it is entered, as one in frequency."""
    orbits, others = system.problem, list[Entry]()
    assert isinstance(orbits, Orbits) and isinstance(orbits.flow, Conserving)
    flow = orbits.flow.chosen(FREQUENCY)
    paths = [orbits.path(e.x, {}) for e in entries]
    new = laid(flow, paths[0], orbits.shift)
    for e, path in zip(entries, paths, strict=True):
        row = None if e.row is None else np.append(e.row[:-1] * orbits.state_scale / new.state_scale, 0.0)
        row = None if row is None else row / np.linalg.norm(row)
        others.append(Entry(e.direction, new.joined(path), np.array([free.coordinate(1.0 / path.period)]), row))
    values = {**flow.theirs(system.base), FREQUENCY: 1.0 / paths[0].period}
    values.pop(ENERGY, None)
    return System(new, values, [free]), others


def _check_inside(system: System, entries: Sequence[Entry], free: Free) -> None:
    """Raise a BoundsError unless a curve begins within its bounds."""
    value = free.value(float(entries[0].y[0])) if free.log else float(entries[0].y[0]) * (free.high - free.low)
    slack = 1e-9 * abs(value)
    if not free.low - slack <= value <= free.high + slack:
        raise BoundsError(f"the curve begins at {free.name} = {free.show(value)}, outside the bounds "
                          f"{free.show(free.low)} .. {free.show(free.high)}")


def _in_terms_of_energy(
    point: SpecialOrbit | OrbitPoint | Orbit, orbit: Orbit, flow: Conserving
) -> SpecialOrbit | Orbit:
    """Return the point as one of a curve in energy."""
    parameters = {**flow.theirs(orbit.constants()), ENERGY: float(orbit.energy or 0.0)}
    own = replace(orbit, parameters=parameters, forcing=flow.record())
    if not isinstance(point, SpecialOrbit):
        return own
    vectors = dict(point.vectors)
    if "tangent" in vectors and ENERGY not in point.free:
        tangent = np.array(vectors["tangent"])
        slope = flow.energy_slopes(orbit.path.s[:1], own.parameters)[0]
        vectors["tangent"] = np.append(tangent[:-1], float(slope @ tangent[: flow.d]))
    return replace(point, orbit=own, vectors=vectors)
