"""Where families of orbits begin: the linear modes at rest, and small orbits beside it.

At an equilibrium u0 with rates i omega and shapes z they are u = u0 + a Re(z exp(i omega t)) (Lyapunov).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mjcont.errors import StartError
from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.conserved import ENERGY, FREQUENCY
from mjcont.numerics.orbits.follow import Follower, entered, laid, orbit_near, trace_orbits
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.points import path_at
from mjcont.numerics.points.events import Detector
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.walk.steps import Status
from mjcont.oscillation.conserving import Conserving
from mjcont.oscillation.starts import harmonic_orbit
from mjcont.oscillation.walks import Entry, Options, along_parameter

# sizes of the first orbit beside rest, and of one that tells how energy grows, relative to the state's scales
_SIZES, _SMALL = (1e-2, 1e-3, 1e-4, 1e-5), 1e-3
# how far the period of a small orbit may be from the linear one, relative
_NEAR = 0.05
# squares of rates, of the largest, below which a mode does not swing; real parts that are rounding
_STILL, _REAL = 1e-12, 1e-6
# energies that are walked through before a frequency comes within its bounds, times the first
_SPAN = 1e12


@dataclass(frozen=True, slots=True)
class LinearMode:
    """A linear mode: its complex vector (d,) of largest component one scale, and its rate, rad/s."""

    vector: Array
    omega: float


def linear_modes(flow: Conserving, values: Values) -> list[LinearMode]:
    """Return the linear modes at rest that swing, the slowest first."""
    jac = flow.derivatives(flow.rest[None], np.zeros(1), values, (), True).jac[0]
    found = []
    if flow.order == 2:
        squares, shapes = np.linalg.eig(-jac[:, : flow.c])
        for square, shape in zip(squares, shapes.T, strict=True):
            if square.real > _STILL * np.abs(squares).max() and abs(square.imag) <= _REAL * square.real:
                omega = math.sqrt(square.real)
                vector = oriented(shape).real
                found.append(LinearMode(np.concatenate([vector, 1j * omega * vector]), omega))
    else:
        rates, vectors = np.linalg.eig(jac)
        for rate, vector in zip(rates, vectors.T, strict=True):
            if rate.imag > math.sqrt(_STILL) * np.abs(rates).max() and abs(rate.real) <= _REAL * rate.imag:
                found.append(LinearMode(oriented(vector), float(rate.imag)))
    c = flow.c
    sized = [replace(m, vector=m.vector / np.abs(m.vector[:c] / flow.scale[:c]).max()) for m in found]
    return sorted(sized, key=lambda m: m.omega)


def _stiffness(flow: Conserving, values: Values, mode: LinearMode) -> float:
    """Return the energy of a small orbit over the square of its size."""
    states = np.array([flow.rest + sign * _SMALL * mode.vector.real for sign in (1.0, -1.0)])
    return float(flow.energies(states, values).mean()) / _SMALL**2


def _small_orbit(flow: Conserving, mode: LinearMode, size: float, read: Options) -> tuple[Any, Array, Array]:
    meshes = read.meshes
    orbits, x, along = harmonic_orbit(flow, meshes.scheme, meshes.first, flow.rest, mode.vector, mode.omega, size)
    row = along / orbits.state_scale
    return orbits, x, row / np.linalg.norm(row)


def _first_orbit(
    flow: Conserving, values: Values, mode: LinearMode, most: float, read: Options
) -> tuple[Path, float]:
    """Return a small orbit beside rest, and its energy, `most` at most: where bushes are stiff only very small ones.

    Raises
    ------
    StartError
        If none is found.
    """
    stiffness = _stiffness(flow, values, mode)
    if not stiffness > 0.0:
        raise StartError(f"the energy of {flow.model.name} does not grow along the mode of "
                         f"{mode.omega / (2.0 * math.pi):.6g} Hz: modes are oscillations about a least energy")
    for size in _SIZES:
        energy = min(most, stiffness * size**2)
        orbits, x, _ = _small_orbit(flow, mode, math.sqrt(energy / stiffness), read)
        near = orbit_near(flow, orbits.path(x, {}), {**values, ENERGY: energy}, np.zeros(flow.d), read.meshes)
        if near is not None and abs(path_at(near).period * mode.omega / (2.0 * math.pi) - 1.0) < _NEAR:
            return path_at(near), energy
    raise StartError(f"no small orbit found beside the mode of {mode.omega / (2.0 * math.pi):.6g} Hz")


def in_energy(
    flow: Conserving, values: dict[str, float], mode: LinearMode, free: Free, read: Options
) -> tuple[System, Entry]:
    """Return the curve in energy, entered at the lower bound."""
    path, first = _first_orbit(flow, values, mode, free.low, read)
    if first < free.low:
        path = _walked(flow, path, {**values, ENERGY: first}, Free(ENERGY, first, free.low), read, None)
    orbits = laid(flow, path, np.zeros(flow.d))
    system = System(orbits, {**values, ENERGY: free.low}, [free])
    return system, Entry(1.0, orbits.joined(path), system.start_y(), None)


def in_frequency(
    flow: Conserving, values: dict[str, float], mode: LinearMode, free: Free, read: Options
) -> tuple[System, Entry]:
    """Return the curve in frequency, entered beside rest, or where it first comes within the bounds."""
    linear = mode.omega / (2.0 * math.pi)
    by_energy = flow.chosen(ENERGY)
    path, first = _first_orbit(by_energy, values, mode, math.inf, read)
    if free.low <= 1.0 / path.period <= free.high:
        sign = math.copysign(1.0, 1.0 / path.period - linear)
    else:
        sign = 1.0 if 1.0 / path.period < free.low else -1.0

        def inside(system: System, point: CurvePoint) -> str | None:
            del system
            return "inside" if free.low <= 1.0 / path_at(point).period <= free.high else None

        energies = Free(ENERGY, first, _SPAN * first)
        path = _walked(by_energy, path, {**values, ENERGY: first}, energies, read, inside)
        bound = free.low if sign > 0.0 else free.high
        near = orbit_near(flow, path, {**values, FREQUENCY: bound}, np.zeros(flow.d), read.meshes)
        if near is None:
            raise StartError(f"no orbit of the mode found at {free.show(bound)}")
        path = path_at(near)
    orbits = laid(flow, path, np.zeros(flow.d))
    x, system = orbits.joined(path), System(orbits, {**values, FREQUENCY: 1.0 / path.period}, [free])
    return system, Entry(sign, x, system.start_y(), _outwards(system, x, path, flow))


def _outwards(system: System, x: Array, path: Path, flow: Conserving) -> Array:
    """Return the row (n + 1,) along which the amplitude grows."""
    orbits = system.problem
    deviation = replace(path, s=path.s - flow.rest, period=0.0)
    row = np.append(deviation.s.ravel(), np.append(deviation.w.ravel(), [0.0, 0.0])) / orbits.state_scale
    return np.append(row, 0.0) / np.linalg.norm(row)


def _walked(flow: Conserving, path: Path, values: Values, free: Free, read: Options, stop: Any) -> Path:
    """Return the orbit at the end of a walk in energy, or where `stop` says so.

    Raises
    ------
    StartError
        If the walk ends before.
    """
    orbits = laid(flow, path, np.zeros(flow.d))
    system, x = System(orbits, values, [free]), orbits.joined(path)
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
