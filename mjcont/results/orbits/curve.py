"""Curves of periodic orbits: branches whose rows are orbits, and their points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import name_of
from mjcont.results.branch import Branch
from mjcont.results.orbits.orbit import Orbit
from mjcont.results.points import Point, SpecialPoint, show
from mjcont.results.quantities import column_of

CYCLES, RESPONSES, MODES, BACKBONE = "cycles", "responses", "nonlinear modes", "backbone"
# observables that a summary line shows
_SHOWN = 3


@dataclass(frozen=True, slots=True, repr=False)
class OrbitPoint(Point):
    """A point of a curve of orbits: `eigenvalues` are its multipliers, `state` that at time zero.

    `observables` are the numbers that the curve's columns hold: period, frequency, NAME.max, ...
    """

    orbit: Orbit | None = field(repr=False, default=None)

    def __str__(self) -> str:
        """Return stability, period and the largest values of observables."""
        return f"{self.stability} ({self.n_unstable} unstable): {_shown(self, [])}"


@dataclass(frozen=True, slots=True, repr=False)
class SpecialOrbit(SpecialPoint):
    """A special point of a curve of orbits."""

    orbit: Orbit | None = field(repr=False, default=None)

    def __str__(self) -> str:
        """Return kind, parameters, period, largest values of observables and the tolerance reached."""
        extra = "".join(f", {k} = {v:.6g}" if isinstance(v, float) else f", {k} = {v}"
                        for k, v in self.coefficients.items())
        state = f"located to {self.tolerance:.1e}" if self.converged else "not converged: a guess"
        note = f" ({self.note})" if self.note else ""
        return f"{self.label} ({name_of(self.kind)}): {_shown(self, list(self.free))}{extra}; {state}{note}"


def _shown(point: Point, names: list[str]) -> str:
    largest = [n for n in point.observables if n.endswith(".max")][:_SHOWN]
    names = [*names, "period", *largest]
    return ", ".join(f"{n} = {show(point[n], point.units.get(n, ''))}" for n in names)


def point_of(orbit: Orbit, state: Array, stability: str, n_unstable: int) -> OrbitPoint:
    """Return an orbit as a point of a curve that it may be on."""
    numbers = {n: v for n, v in orbit.numbers().items() if n not in orbit.parameters}
    units = {**{n: unit_of(n, orbit.units) for n in numbers}, **orbit.units}
    return OrbitPoint(
        orbit.parameters, numbers, state, orbit.multipliers, stability, n_unstable, orbit.problem, units, orbit=orbit
    )


def unit_of(name: str, units: Any) -> str:
    """Return the unit of a number of an orbit, such as period or NAME.max, from those of observables."""
    if name in ("period", "frequency"):
        return "s" if name == "period" else "Hz"
    stem, _, what = name.rpartition(".")
    return "rad" if what == "phase" else str(units.get(stem, ""))


@dataclass(frozen=True, repr=False)
class CycleBranch(Branch):
    """A curve of periodic orbits.

    Columns beside the parameters: period, frequency, and for each observable NAME its extremes NAME.max and NAME.min,
    half their distance NAME.amplitude, NAME.mean and NAME.rms; along forced responses its first harmonic's amplitude
    NAME.h1 and phase NAME.phase. `eigenvalues` are the Floquet multipliers.

    Attributes
    ----------
    orbits : the orbit of each row.
    forcing : what drives a response: by input its amplitude, phase and harmonic.
    """

    orbits: Sequence[Orbit] = field(repr=False, default=())
    forcing: dict[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: Any) -> Any:
        """Return a column by name, (N,), or a row by index, an `OrbitPoint`."""
        if isinstance(name, int | np.integer):
            return self.row(int(name))
        if isinstance(name, str) and self.envelope(name) and name not in self.fixed:
            raise unknown_name("column", name, [f"{self.envelope(name)}.{what}" for what in self._numbers])
        return Branch.__getitem__(self, name)

    def envelope(self, name: str) -> str:
        """Return the observable that a name means, of which there are the columns .max and .min; empty if none."""
        return column_of(name, {c.removesuffix(".max") for c in self.columns if c.endswith(".max")}) or ""

    def drawn(self, name: str) -> list[str]:
        """Return the columns that a diagram shows for a name: for an observable its envelope, .max and .min."""
        own = "" if name in self.columns or name in self.fixed else self.envelope(name)
        return [f"{own}.max", f"{own}.min"] if own else [name]

    @property
    def _numbers(self) -> list[str]:
        return list(dict.fromkeys(n.rpartition(".")[2] for n, c in self.columns.items() if c.role == "observable"))

    @checked
    def row(self, index: int) -> OrbitPoint:
        """Return a row, an `OrbitPoint`."""
        p = Branch.row(self, index)
        index %= len(self)
        own = {f.name: getattr(p, f.name) for f in fields(p)}
        numbers = {c.name: float(c.values[index]) for c in self.columns.values() if c.role == "orbit"}
        own["observables"] = {**numbers, **p.observables}
        return OrbitPoint(**own, orbit=self.orbits[index] if len(self.orbits) else None)

    @cached_property
    def special_points(self) -> Sequence[SpecialPoint]:
        """The rows that are special points, each a `SpecialOrbit`."""
        found = []
        for m in self.marks:
            row = self.row(m.index)
            plain = Point(**{f.name: getattr(row, f.name) for f in fields(Point)})
            p = m.on(plain, self.free, self.kind)
            found.append(SpecialOrbit(**{f.name: getattr(p, f.name) for f in fields(p)}, orbit=row.orbit))
        return tuple(found)

    @checked
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

    def save(self, path: str | Path) -> Path:
        """Write the curve with its orbits to an HDF5 file (replacing it whole or not at all) and return the path."""
        from mjcont.results.orbits.files import save

        return save(self, path)


def with_orbits(branch: Branch, orbits: Sequence[Orbit], forcing: dict[str, Any]) -> CycleBranch:
    """Return a branch as the curve of orbits that it is."""
    own = {f.name: getattr(branch, f.name) for f in fields(Branch)}
    return replace(CycleBranch(**own), orbits=tuple(orbits), forcing=forcing)
