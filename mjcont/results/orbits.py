"""Periodic orbits: one period of a motion, its multipliers, and what is read along it. Immutable once made.

An orbit u(t + T) = u(t) is stable where every Floquet multiplier, the 1 of a free period aside, lies inside the unit
circle.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any

import numpy as np

from mjcont.errors import MjcontError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.path import Path
from mjcont.results.branch import Branch
from mjcont.results.histories import History
from mjcont.results.model import Model, model_of, provenance
from mjcont.results.points import Column, Point, SpecialPoint

CYCLES, RESPONSES = "cycles", "responses"
# places at which an interval's polynomial is read for extremes
_READ = 33


@dataclass(frozen=True, slots=True)
class Reading:
    """Observables at the points of an orbit.

    Attributes
    ----------
    names, units : of the observables.
    points : (k, number of names) at the collocation points.
    ends : (N + 1, number of names) at the mesh.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    points: Array
    ends: Array


@dataclass(frozen=True, slots=True, eq=False)
class Orbit:
    """One period of a periodic motion.

    Attributes
    ----------
    path : its polynomials.
    reading : its observables.
    parameters, units : values, and units of parameters and observables.
    multipliers : (d,) complex, the largest first.
    resolved : (d,) bool: False for multipliers of modes too fast for the mesh, which are told adiabatically.
    trivial : index of the multiplier 1 of a free period, -1 where there is none.
    error : estimate of the discretisation's error, relative.
    name : the model's.
    problem : the Mechanism or VectorField, or None for a loaded file without one.
    shift : what coordinates gain in a period, (d,): zero but for running orbits.
    forcing : what drives it, as `CycleBranch.forcing`.
    """

    path: Path
    reading: Reading
    parameters: Mapping[str, float]
    units: Mapping[str, str]
    multipliers: Array
    resolved: Array
    trivial: int
    error: float
    name: str
    problem: Model | None = field(repr=False, default=None)
    shift: Array = field(repr=False, default_factory=lambda: np.zeros(0))
    forcing: Mapping[str, Any] = field(repr=False, default_factory=dict)

    @property
    def period(self) -> float:
        """The period, s."""
        return self.path.period

    @property
    def frequency(self) -> float:
        """1 / period, Hz."""
        return 1.0 / self.path.period

    @property
    def exponents(self) -> Array:
        """Floquet exponents log(multiplier) / period, 1/s."""
        with np.errstate(divide="ignore"):
            found: Array = np.log(self.multipliers.astype(complex)) / self.period
        return found

    @property
    def times(self) -> Array:
        """Times of the samples, from 0 to the period, (n,)."""
        return self._places * self.period

    @property
    def _places(self) -> Array:
        return np.unique(np.concatenate([self.path.mesh, self.path.points]))

    @property
    def states(self) -> Array:
        """States at `times`: qpos (n, nq), or a VectorField's u."""
        found = self.path.states(self._places)
        return found[:, : self.path.c]

    @property
    def velocities(self) -> Array:
        """Velocities at `times`, (n, nv): qvel, or a VectorField's u'."""
        places = self._places
        return self.path.states(places)[:, self.path.c :] if self.path.order == 2 else self.path.rates(places)

    def at(self, time: float) -> Array:
        """Return the state at a time, taken into the period: u, or qpos and qvel one after the other."""
        turns, tau = divmod(time / self.period, 1.0)
        state: Array = self.path.states(np.array([tau]))[0]
        return state + turns * self.shift if len(self.shift) else state

    def __getitem__(self, name: str) -> Array:
        """Return an observable at `times`, (n,)."""
        k, places = self._column(name), self._places
        known = {**dict(zip(self.path.points.tolist(), self.reading.points[:, k].tolist(), strict=True)),
                 **dict(zip(self.path.mesh.tolist(), self.reading.ends[:, k].tolist(), strict=True))}
        return np.array([known[tau] for tau in places.tolist()])

    def _column(self, name: str) -> int:
        if name not in self.reading.names:
            raise unknown_name("observable", name, self.reading.names)
        return self.reading.names.index(name)

    def harmonics(self, name: str, count: int = 5) -> Array:
        """Return the complex harmonics 0 .. count of an observable, (count + 1,).

        The observable is Re sum_k c_k exp(2 pi i k t / T): |c_k| is an amplitude, c_0 the mean.
        """
        values, path = self.reading.points[:, self._column(name)], self.path
        waves = np.exp(-2j * np.pi * np.arange(count + 1)[:, None] * path.points)
        found: Array = 2.0 * waves @ (path.weights * values)
        found[0] *= 0.5
        return found

    def history(self) -> History:
        """Return the period as a time history: it plots, animates and is stored like any other."""
        model_of(self.problem, "the orbit")
        columns = {"time": Column("time", "s", "input", self.times)}
        for name, unit in zip(self.reading.names, self.reading.units, strict=True):
            columns[name] = Column(name, unit, "observable", self[name])
        settings = {"integrator": f"{self.path.scheme.name} collocation", "duration": self.period, "error": self.error,
                    "timestep": self.period / len(self.path.w), "steps": len(self.path.w), "tol": None,
                    "control_step": None}
        assert self.problem is not None
        return History(
            columns, self.states, self.velocities, "done", "one period of a periodic orbit", settings, self.name,
            self.problem, provenance(self.problem), dict(self.parameters),
        )

    def __str__(self) -> str:
        """Return a one-line summary."""
        largest = np.abs(np.delete(self.multipliers, self.trivial) if self.trivial >= 0 else self.multipliers)
        size = f"{largest.max():.6g}" if len(largest) else "none"
        return (
            f"{self.name}: orbit of period {self.period:.9g} s, {len(self.path.w)} intervals of degree "
            f"{self.path.scheme.degree}, largest multiplier {size}, error about {self.error:.1e}"
        )


@dataclass(frozen=True, slots=True)
class OrbitPoint(Point):
    """A point of a curve of orbits: `eigenvalues` are its multipliers, `state` that at time zero."""

    orbit: Orbit | None = field(repr=False, default=None)


@dataclass(frozen=True, slots=True)
class SpecialOrbit(SpecialPoint):
    """A special point of a curve of orbits."""

    orbit: Orbit | None = field(repr=False, default=None)


def orbit_of(point: Any) -> Orbit:
    """Return the orbit of an orbit or of a point of a curve of orbits.

    Raises
    ------
    MjcontError
        If there is none.
    """
    found = point if isinstance(point, Orbit) else getattr(point, "orbit", None)
    if not isinstance(found, Orbit):
        raise MjcontError(f"a periodic orbit is needed, or a point of a curve of orbits; got {type(point).__name__}")
    return found


@dataclass(frozen=True)
class CycleBranch(Branch):
    """A curve of periodic orbits.

    Columns beside the parameters: period, frequency, and for each observable NAME its extremes NAME.max and NAME.min,
    half their distance NAME.amplitude, NAME.mean and NAME.rms; along forced responses its first harmonic's amplitude
    NAME.h1 and phase NAME.phase. A file keeps the columns, multipliers and special points, not the orbits.

    Attributes
    ----------
    orbits : the orbit of each row.
    forcing : what drives a response: by input its amplitude, phase and harmonic.
    resolving : scheme, degree, tolerance and size of meshes, as given.
    """

    orbits: Sequence[Orbit] = field(repr=False, default=())
    forcing: dict[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: Any) -> Any:
        """Return a column by name, (N,), or a row by index, an `OrbitPoint`."""
        if isinstance(name, int | np.integer):
            return self.row(range(len(self))[int(name)])
        return Branch.__getitem__(self, name)

    def row(self, index: int) -> OrbitPoint:
        """Return a row, an `OrbitPoint`."""
        p = Branch.row(self, index)
        return OrbitPoint(**{f.name: getattr(p, f.name) for f in fields(p)}, orbit=self.orbits[index])

    @cached_property
    def special_points(self) -> Sequence[SpecialPoint]:
        """The rows that are special points, each a `SpecialOrbit`."""
        found = (m.on(Branch.row(self, m.index), self.free, self.kind) for m in self.marks)
        return tuple(
            SpecialOrbit(**{f.name: getattr(p, f.name) for f in fields(p)}, orbit=self.orbits[p.index]) for p in found
        )

    def at(self, **target: float) -> list[Point]:
        """Return the orbits at which a free parameter has a value, corrected to it (there may be several).

        Raises
        ------
        MjcontError
            If not exactly one parameter is given, or another column.
        """
        from mjcont.oscillation.at import orbits_at_value

        if len(target) != 1:
            raise MjcontError("at() takes exactly one parameter and value, such as at(P=2.0)")
        ((name, value),) = target.items()
        return list(orbits_at_value(self, name, value))


def readings(orbit: Orbit, harmonic: bool) -> dict[str, Array]:
    """Return the numbers of all observables of an orbit by what they are, (number of observables,) each."""
    path, r = orbit.path, orbit.reading
    high, low = extremes(orbit)
    found = {"max": high, "min": low, "amplitude": 0.5 * (high - low)}
    found["mean"] = path.weights @ r.points
    found["rms"] = np.sqrt(path.weights @ r.points**2)
    if harmonic:
        first = 2.0 * (path.weights * np.exp(-2j * np.pi * path.points)) @ r.points
        found["h1"], found["phase"] = np.abs(first), np.angle(first)
    return found


def extremes(orbit: Orbit) -> tuple[Array, Array]:
    """Return the largest and smallest values of all observables, of the polynomials through what is read."""
    path, r = orbit.path, orbit.reading
    m, count = path.scheme.degree, len(path.w)
    inner = r.points.reshape(count, m, -1)
    nodes, values = path.scheme.c, inner
    if nodes[-1] < 1.0:
        nodes, values = np.append(nodes, 1.0), np.concatenate([values, r.ends[1:, None]], axis=1)
    nodes, values = np.append(0.0, nodes), np.concatenate([r.ends[:-1, None], values], axis=1)
    fine = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, _READ))
    weights = np.array([_lagrange(nodes, t) for t in fine])
    read = np.einsum("tl,ilo->ito", weights, values)
    return _peaks(read, fine, values, nodes), -_peaks(-read, fine, -values, nodes)


def _lagrange(nodes: Array, at: float) -> Array:
    apart = nodes[:, None] - nodes
    np.fill_diagonal(apart, 1.0)
    parts = (at - nodes) / apart
    np.fill_diagonal(parts, 1.0)
    found: Array = parts.prod(axis=1)
    return found


def _peaks(read: Array, fine: Array, values: Array, nodes: Array) -> Array:
    """Return the largest value of each polynomial, by parabolas through the largest of what is read."""
    found = np.empty(read.shape[2])
    for o in range(read.shape[2]):
        i, t = divmod(int(np.argmax(read[:, :, o])), read.shape[1])
        place, best = float(fine[t]), float(read[i, t, o])
        reach = float(fine[min(t + 1, _READ - 1)] - fine[max(t - 1, 0)]) / 2.0
        for _ in range(3):
            around = np.clip(place + reach * np.array([-1.0, 0.0, 1.0]), 0.0, 1.0)
            y = np.array([_lagrange(nodes, a) @ values[i, :, o] for a in around])
            best = max(best, float(y.max()))
            bend = np.polyfit(around - place, y, 2) if around[0] < around[1] < around[2] else np.zeros(3)
            if not bend[0] < 0.0:
                break
            place = float(np.clip(place - bend[1] / (2.0 * bend[0]), 0.0, 1.0))
            best = max(best, float(_lagrange(nodes, place) @ values[i, :, o]))
            reach *= 0.1
        found[o] = best
    return found
