"""The verb `continue_modes`: families of periodic motions of a mechanism without damping, one from each linear mode.

The small orbits of a mode with shape z and rate omega are u = u0 + a Re(z exp(i omega t)) (Lyapunov); they are
followed in energy or frequency. Source: Kerschen, Peeters, Golinval and Vakakis, Nonlinear normal modes, part I
(Mechanical Systems and Signal Processing 23, 2009).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mjcont.curves.collect import Progress
from mjcont.curves.continuation import start_from
from mjcont.errors import BoundsError, MjcontError, ParameterError, StartError, unknown_name
from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.starts import find_start
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.conserved import ENERGY, FREQUENCY
from mjcont.numerics.orbits.follow import Follower, entered, laid, orbit_near, trace_orbits
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.points import path_at
from mjcont.numerics.points.events import Detector
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.walk.steps import Status
from mjcont.oscillation.conserving import CHOICES, Conserving, conserving, keeps_energy, loses
from mjcont.oscillation.fields import FieldFlow
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.onward import bounded, entries_at, flow_at, orbit_at
from mjcont.oscillation.starts import harmonic_orbit
from mjcont.oscillation.walks import Entry, Options, Stop, along_parameter, flow_of, read_options, run
from mjcont.results.model import Model, check_bounds
from mjcont.results.orbits import MODES, CycleBranch, Orbit, OrbitPoint, SpecialOrbit
from mjcont.results.points import Point
from mjcont.vectorfield import VectorField

# size of the first orbit beside rest, and of one that tells how energy grows, relative to the state's scales
_FIRST, _SMALL = 1e-2, 1e-3
# squares of rates, of the largest, below which a mode does not swing; real parts that are rounding
_STILL, _REAL = 1e-12, 1e-6
# energies that are walked through before a frequency comes within its bounds, times the first
_SPAN = 1e12


@dataclass(frozen=True, slots=True)
class _Mode:
    """A linear mode: its complex vector (d,) of largest component one scale, and its rate, rad/s."""

    vector: Array
    omega: float


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
        potential. A BPC or PD of such a curve: the other branch, or the orbits of twice the period (internal
        resonances). Any other orbit of one: its own curve.
    parameter : {"energy", "frequency"}
        What varies: the energy beyond that at rest (J), or 1 / period (Hz).
    bounds : (low, high), positive
    start : dict of parameter values, or a point of any result, optional
    mode : int
        Which linear mode, counted from 1 by rising frequency among those that swing.
    keyframe, state : optional
        Near which state the equilibrium is looked for.
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
    if isinstance(origin, SpecialOrbit | OrbitPoint | Orbit):
        if any(given is not None for given in (start, keyframe, state)):
            raise MjcontError("an orbit is its own start: give the parameter and bounds alone")
        return _from_orbit(origin, parameter, bounds, stop, progress, options)
    if not isinstance(origin, Model):
        raise MjcontError(f"modes begin at a model, or at an orbit of a curve of modes; got {type(origin).__name__}")
    inner = _unforced(origin)
    x, values = start_from(origin, _plain(start), keyframe, state)
    flow, values, notes = _without_losses(inner, x, values, parameter)
    read = read_options(flow, {"scheme": "gauss", **options})
    low, high = check_bounds(flow, parameter, bounds)
    free = Free(parameter, low, high, flow.parameter(parameter).unit)
    modes = _linear_modes(flow, values)
    if isinstance(mode, bool) or not isinstance(mode, int) or not 1 <= mode <= len(modes):
        known = ", ".join(f"{i} ({m.omega / (2.0 * math.pi):.6g} Hz)" for i, m in enumerate(modes, 1))
        raise ParameterError(f"mode must be one of those that swing: {known or 'there is none'}; got {mode!r}")
    chosen = modes[mode - 1]
    system, entry = (_in_energy if parameter == ENERGY else _in_frequency)(flow, values, chosen, free, read)
    where = f"small motions in mode {mode}, {chosen.omega / (2.0 * math.pi):.6g} Hz"
    return run(MODES, system, [entry], read, where, stop, progress, notes)


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


# -- what is left out ------------------------------------------------------------------------------------------


def _without_losses(
    inner: ModelFlow, x: Array, values: Values, chosen_by: str
) -> tuple[Conserving, dict[str, float], list[str]]:
    """Return the motion that keeps energy, its parameter values, and sentences on what is left out.

    Raises
    ------
    MjcontError, StartError
        If none does, or nothing rests.
    """
    flow, even = _conserving(inner, x, values, chosen_by)
    left = _names_of_losses(inner, values) if even else []
    if not keeps_energy(flow, values):
        controls = [n for n, p in inner.model.parameters.items() if p.kind == "control" and values[n] != 0.0]
        still = {**values, **dict.fromkeys(controls, 0.0)}
        bad = [n for n in controls if not _keeps(inner, x, {**still, n: values[n]}, chosen_by)]
        values = {**values, **dict.fromkeys(bad, 0.0)}
        left += [f"input {n}, which has no potential" for n in bad]
        flow, _ = _conserving(inner, x, values, chosen_by)
        if not bad or not keeps_energy(flow, values):
            raise MjcontError(f"the energy of {inner.model.name} changes along its motions, also without what resists "
                              "them: modes want forces with a potential")
    notes = [f"left out: {'; '.join(left)}"] if left else []
    return flow, dict(values), notes


def _keeps(inner: ModelFlow, x: Array, values: Values, chosen_by: str) -> bool:
    try:
        return keeps_energy(_conserving(inner, x, values, chosen_by)[0], values)
    except StartError:
        return False


def _conserving(inner: ModelFlow, x: Array, values: Values, chosen_by: str) -> tuple[Conserving, bool]:
    found = find_start(inner.model, x, values)
    if found.failure is not None:
        raise StartError(f"no equilibrium found at which modes could begin: {found.failure}")
    rest = inner.resting(found.x, values)
    even = loses(inner, rest, values)
    return conserving(inner, chosen_by, even, rest), even


def _names_of_losses(inner: ModelFlow, values: Values) -> list[str]:
    otherwise = ["what depends on the direction of motion"]
    if isinstance(inner, FieldFlow):
        return otherwise
    from mjcont.mechanism.losses import losses  # MuJoCo is imported only where there is a Mechanism

    return losses(inner.model, values) or otherwise


# -- the first orbit -------------------------------------------------------------------------------------------


def _linear_modes(flow: Conserving, values: Values) -> list[_Mode]:
    """Return the linear modes at rest that swing, the slowest first."""
    jac = flow.derivatives(flow.rest[None], np.zeros(1), values, (), True).jac[0]
    found = []
    if flow.order == 2:
        squares, shapes = np.linalg.eig(-jac[:, : flow.c])
        for square, shape in zip(squares, shapes.T, strict=True):
            if square.real > _STILL * np.abs(squares).max() and abs(square.imag) <= _REAL * square.real:
                omega = math.sqrt(square.real)
                vector = oriented(shape).real
                found.append(_Mode(np.concatenate([vector, 1j * omega * vector]), omega))
    else:
        rates, vectors = np.linalg.eig(jac)
        for rate, vector in zip(rates, vectors.T, strict=True):
            if rate.imag > math.sqrt(_STILL) * np.abs(rates).max() and abs(rate.real) <= _REAL * rate.imag:
                found.append(_Mode(oriented(vector), float(rate.imag)))
    c = flow.c
    sized = [replace(m, vector=m.vector / np.abs(m.vector[:c] / flow.scale[:c]).max()) for m in found]
    return sorted(sized, key=lambda m: m.omega)


def _stiffness(flow: Conserving, values: Values, mode: _Mode) -> float:
    """Return the energy of a small orbit over the square of its size."""
    states = np.array([flow.rest + sign * _SMALL * mode.vector.real for sign in (1.0, -1.0)])
    return float(flow.energies(states, values).mean()) / _SMALL**2


def _small_orbit(flow: Conserving, mode: _Mode, size: float, read: Options) -> tuple[Any, Array, Array]:
    meshes = read.meshes
    orbits, x, along = harmonic_orbit(flow, meshes.scheme, meshes.first, flow.rest, mode.vector, mode.omega, size)
    row = along / orbits.state_scale
    return orbits, x, row / np.linalg.norm(row)


def _in_energy(
    flow: Conserving, values: dict[str, float], mode: _Mode, free: Free, read: Options
) -> tuple[System, Entry]:
    """Return the curve in energy, entered at the lower bound."""
    stiffness = _stiffness(flow, values, mode)
    first = min(free.low, stiffness * _FIRST**2)
    orbits, x, _ = _small_orbit(flow, mode, math.sqrt(first / stiffness), read)
    values = {**values, ENERGY: first}
    if first < free.low:
        path = _walked(flow, orbits, x, values, Free(ENERGY, first, free.low), read, None)
        values = {**values, ENERGY: free.low}
        orbits = laid(flow, path, np.zeros(flow.d))
        x = orbits.joined(path)
    system = System(orbits, values, [free])
    return system, Entry(1.0, x, system.start_y(), None)


def _in_frequency(
    flow: Conserving, values: dict[str, float], mode: _Mode, free: Free, read: Options
) -> tuple[System, Entry]:
    """Return the curve in frequency, entered beside rest, or where it first comes within the bounds."""
    linear = mode.omega / (2.0 * math.pi)
    by_energy = flow.chosen(ENERGY)
    first = _stiffness(flow, values, mode) * _FIRST**2
    orbits, x, _ = _small_orbit(by_energy, mode, _FIRST, read)
    near = orbit_near(by_energy, orbits.path(x, {}), {**values, ENERGY: first}, np.zeros(flow.d), read.meshes)
    if near is None:
        raise StartError(f"no small orbit found beside the mode of {linear:.6g} Hz")
    path = path_at(near)
    if free.low <= 1.0 / path.period <= free.high:
        sign = math.copysign(1.0, 1.0 / path.period - linear)
    else:
        sign = 1.0 if 1.0 / path.period < free.low else -1.0

        def inside(system: System, point: CurvePoint) -> str | None:
            del system
            return "inside" if free.low <= 1.0 / path_at(point).period <= free.high else None

        orbits = laid(by_energy, path, np.zeros(flow.d))
        energies = Free(ENERGY, first, _SPAN * first)
        path = _walked(by_energy, orbits, orbits.joined(path), {**values, ENERGY: first}, energies, read, inside)
        bound = free.low if sign > 0.0 else free.high
        near = orbit_near(flow, path, {**values, FREQUENCY: bound}, np.zeros(flow.d), read.meshes)
        if near is None:
            raise StartError(f"no orbit of the mode found at {free.show(bound)}")
        path = path_at(near)
    orbits = laid(flow, path, np.zeros(flow.d))
    x, system = orbits.joined(path), System(orbits, {**values, FREQUENCY: 1.0 / path.period}, [free])
    small = 1.0 / path.period
    del small
    return system, Entry(sign, x, system.start_y(), _outwards(system, x, path, flow))


def _outwards(system: System, x: Array, path: Path, flow: Conserving) -> Array:
    """Return the row (n + 1,) along which the amplitude grows."""
    orbits = system.problem
    deviation = replace(path, s=path.s - flow.rest, period=0.0)
    row = np.append(deviation.s.ravel(), np.append(deviation.w.ravel(), [0.0, 0.0])) / orbits.state_scale
    return np.append(row, 0.0) / np.linalg.norm(row)


def _walked(
    flow: Conserving, orbits: Any, x: Array, values: Values, free: Free, read: Options, stop: Any
) -> Path:
    """Return the orbit at the end of a walk in energy, or where `stop` says so.

    Raises
    ------
    StartError
        If the walk ends before.
    """
    system = System(orbits, values, [free])
    y = system.start_y()
    settings = Settings(tol=read.settings.tol)  # limits are those of the curve that is asked for
    first = entered(system, x, y, along_parameter(system, x, y, 1.0), settings)
    if isinstance(first, Refused):
        raise StartError(f"no small orbit found beside rest: {first}")
    trace = trace_orbits(Follower(settings, read.meshes, stop, detectors=_nothing), system, first)
    if trace.end.status not in (Status.AT_BOUND, Status.STOPPED):
        raise StartError(f"the mode was lost on the way to the bounds: {trace.end.message}")
    return path_at(trace.points[-1])


def _nothing(system: System, settings: Any) -> list[Detector]:
    del system, settings
    return []


# -- from an orbit of a curve of modes -------------------------------------------------------------------------


def _from_orbit(
    point: SpecialOrbit | OrbitPoint | Orbit,
    parameter: str,
    bounds: tuple[float, float] | None,
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
    flow = motion.chosen(parameter)
    twice = parameter == FREQUENCY and isinstance(point, SpecialOrbit) and point.kind == "PD"
    value = float(orbit.energy or 0.0) if parameter == ENERGY else orbit.frequency
    turned = _told_by(point, orbit, flow, value)
    free = bounded(flow, turned, parameter, bounds)
    system, entries, origin = entries_at(flow, turned, free)
    if twice:
        entries = [replace(e, y=np.array([free.coordinate(0.5 * value)])) for e in entries]
    return run(MODES, system, entries, read, origin, stop, progress)


def _told_by(
    point: SpecialOrbit | OrbitPoint | Orbit, orbit: Orbit, flow: Conserving, value: float
) -> SpecialOrbit | Orbit:
    """Return the point with the number by which the flow tells orbits apart."""
    own = replace(orbit, parameters={**flow.theirs(orbit.constants()), flow.chosen_by: value}, forcing=flow.record())
    if not isinstance(point, SpecialOrbit):
        return own
    vectors = dict(point.vectors)
    if "tangent" in vectors and flow.chosen_by not in point.free:
        tangent = np.array(vectors["tangent"])
        slope = flow.energy_slopes(orbit.path.s[:1], own.parameters)[0]
        along = float(slope @ tangent[: flow.d]) if flow.chosen_by == ENERGY else -tangent[-2] / orbit.period**2
        vectors["tangent"] = np.append(tangent[:-1], along)
    return replace(point, orbit=own, vectors=vectors)
