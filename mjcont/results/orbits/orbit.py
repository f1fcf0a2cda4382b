"""One period of a periodic motion: its polynomials, its multipliers, and what is read along it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.path import Path
from mjcont.results.histories import History
from mjcont.results.model import Model, provenance
from mjcont.results.orbits.charts import Chart
from mjcont.results.orbits.readings import Reading, along, readings
from mjcont.results.points import Column
from mjcont.results.quantities import column_of
from mjcont.results.text import Shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Orbit(Shown):
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
    activated : how many of a state's last entries are activations of actuators.
    energy : of a motion that keeps it, beyond that at rest; None of others.
    chart : what the path's coordinates are where a mechanism has ball or free joints.
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
    activated: int = field(repr=False, default=0)
    energy: float | None = None
    chart: Chart | None = field(repr=False, default=None)

    @property
    def period(self) -> float:
        """The period, s."""
        return self.path.period

    @property
    def frequency(self) -> float:
        """1 / period, Hz."""
        return 1.0 / self.path.period

    @property
    def forced(self) -> bool:
        """Whether the period is that of a forcing."""
        return self.trivial < 0

    @property
    def own(self) -> Array:
        """Which multipliers tell stability: not the 1 of a free period, there twice where energy is kept, (d,) bool."""
        at, times = np.arange(len(self.multipliers)), 1 + ("conserves" in self.forcing)
        found: Array = (at < self.trivial) | (at >= self.trivial + times) if self.trivial >= 0 else at >= 0
        return found

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
        return self._moving(self._places)[0]

    @property
    def velocities(self) -> Array:
        """Velocities at `times`, (n, nv): qvel, or a VectorField's u'."""
        return self._moving(self._places)[1]

    @property
    def activations(self) -> Array:
        """States of actuators at `times`, (n, na)."""
        found = self.path.states(self._places)
        return found[:, found.shape[1] - self.activated :]

    def _moving(self, places: Array) -> tuple[Array, Array]:
        """Return states and velocities at places in the period."""
        found, c = self.path.states(places), self.path.c
        if self.activated:
            c = (c - self.activated) // 2
        halves = self.path.order == 2 or self.activated
        states, rates = found[:, :c], found[:, c : 2 * c] if halves else self.path.rates(places)
        if self.chart is None:
            return states, rates
        moving = self.chart.moving(states, rates)
        return moving.poses, moving.speeds

    @checked
    def at(self, time: float) -> Array:
        """Return the state at a time, taken into the period: u, or qpos, qvel and activations one after the other."""
        turns, tau = divmod(time / self.period, 1.0)
        state: Array = self.path.states(np.array([tau]))[0]
        state = state + turns * self.shift if len(self.shift) else state
        if self.chart is None:
            return state
        n = (len(state) - self.activated) // 2
        moving = self.chart.moving(state[None, :n], state[None, n : 2 * n])
        return np.concatenate([moving.poses[0], moving.speeds[0], state[2 * n :]])

    def __getitem__(self, name: str) -> Array:
        """Return an observable at `times`, (n,)."""
        return self.read(name, self.times)

    def _ipython_key_completions_(self) -> list[str]:
        """Return the names that [...] takes."""
        return list(self.reading.names)

    @checked
    def read(self, name: str, times: float | Sequence[float] | Array) -> Array:
        """Return an observable at times in the period, (m,): the polynomials through its values at the points."""
        tau = np.atleast_1d(np.asarray(times, dtype=float)) / self.period
        return along(self.path, self.reading, self._column(name), tau)[0]

    @checked
    def rate(self, name: str, times: float | Sequence[float] | Array) -> Array:
        """Return the derivative of an observable in time, at times in the period, (m,)."""
        tau = np.atleast_1d(np.asarray(times, dtype=float)) / self.period
        return along(self.path, self.reading, self._column(name), tau)[1] / self.period

    def numbers(self) -> dict[str, float]:
        """Return period, frequency and, of each observable, what the columns of a curve of orbits hold, by name."""
        read = readings(self.path, self.reading, self.forced)
        each = {f"{n}.{what}": float(v[k]) for k, n in enumerate(self.reading.names) for what, v in read.items()}
        kept = {} if self.energy is None else {"energy": self.energy}
        return {"period": self.period, "frequency": self.frequency, **kept, **each}

    def _column(self, name: str) -> int:
        own = column_of(name, self.reading.names)
        if own is None:
            raise unknown_name("observable", name, self.reading.names)
        return self.reading.names.index(own)

    def unit(self, name: str) -> str:
        """Return the unit of an observable or a parameter."""
        own = column_of(name, self.units)
        if own is None:
            raise unknown_name("observable or parameter", name, self.units)
        return self.units[own]

    @checked
    def harmonics(self, name: str, count: int = 5) -> Array:
        """Return the complex harmonics 0 .. count of an observable, (count + 1,).

        The observable is Re sum_k c_k exp(2 pi i k t / T): |c_k| is an amplitude, c_0 the mean.
        """
        values, path = self.reading.points[:, self._column(name)], self.path
        waves = np.exp(-2j * np.pi * np.arange(count + 1)[:, None] * path.points)
        found: Array = 2.0 * waves @ (path.weights * values)
        found[0] *= 0.5
        return found

    def inputs(self, times: Array) -> dict[str, Array]:
        """Return the parameters that a forcing drives at times (m,), (m,) each."""
        p, periods = self.parameters, int(self.forcing.get("periods", 1))
        angle = 2.0 * np.pi * periods * np.asarray(times, dtype=float) / self.period
        return {
            name: p[name] + p[f"{name}.amplitude"] * np.cos(harmonic * angle + p[f"{name}.phase"])
            for name, (_, _, harmonic) in self.forcing.get("inputs", {}).items()
        }

    def constants(self) -> dict[str, float]:
        """Return the values of the model's parameters that do not move."""
        driven = self.forcing.get("inputs", {})
        own = {"frequency", *(f"{n}{part}" for n in driven for part in ("", ".amplitude", ".phase"))} if driven else ()
        own = (*own, self.forcing.get("conserves", {}).get("chosen_by"))
        return {n: v for n, v in self.parameters.items() if n not in own}

    @checked
    def history(self, samples: int | None = None) -> History:
        """Return the period as a time history: it plots, animates and is stored like any other.

        `samples` are evenly spaced; without them it has the orbit's own `times`.
        """
        places = self._places if samples is None else np.linspace(0.0, 1.0, max(int(samples), 2))
        times = places * self.period
        columns = {"time": Column("time", "s", "time", times)}
        for name, values in self.inputs(times).items():
            columns[name] = Column(name, self.units.get(name, ""), "parameter", values)
        for name, unit in zip(self.reading.names, self.reading.units, strict=True):
            columns[name] = Column(name, unit, "observable", self.read(name, times))
        settings = {"integrator": f"{self.path.scheme.name} collocation", "duration": self.period, "error": self.error,
                    "timestep": self.period / len(self.path.w), "steps": len(self.path.w), "tol": None,
                    "control_step": None}
        return History(
            columns, *self._moving(places), "done", "one period of a periodic orbit", settings, self.name,
            self.problem, provenance(self.problem), self.constants(),
        )

    @checked
    def plot(self, x: str = "", y: str | None = None, **options: Any) -> Axes:
        """Draw y (by default the rate of x) against x (by default the first observable); "time" may be either.

        Options as for `plot_orbits`.
        """
        from mjcont.drawing.orbits import plot_orbits

        axes: Axes = plot_orbits(self, x=x or self.reading.names[0], y=y, **options)
        return axes

    def __str__(self) -> str:
        """Return a one-line summary."""
        largest = np.abs(self.multipliers[self.own])
        size = f"{largest.max():.6g}" if len(largest) else "none"
        return (
            f"{self.name}: orbit of period {self.period:.9g} s, {len(self.path.w)} intervals of degree "
            f"{self.path.scheme.degree}, largest multiplier {size}, error about {self.error:.1e}"
        )


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
