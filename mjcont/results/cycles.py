"""Curves of periodic orbits: a `Branch` whose rows are orbits.

Columns beside the parameters: period, frequency, and for each observable NAME its extremes NAME.max and NAME.min, half
their distance NAME.amplitude, NAME.mean and NAME.rms; along forced responses its first harmonic's amplitude NAME.h1 and
phase NAME.phase. Stability is that of the multipliers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.errors import MjcontError
from mjcont.numerics.equations.problem import Array
from mjcont.results.branch import Branch
from mjcont.results.orbits import Orbit, OrbitPoint, SpecialOrbit
from mjcont.results.points import Point, special_from_row

CYCLES, RESPONSES = "cycles", "responses"
# places at which an interval's polynomial is read for extremes
_READ = 33


@dataclass(frozen=True)
class CycleBranch(Branch):
    """A curve of periodic orbits.

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

    def row_with(self, index: int, eigenvalues: Array) -> OrbitPoint:
        """Return a row, an `OrbitPoint`."""
        p = Branch.row_with(self, index, eigenvalues)
        return OrbitPoint(p.parameters, p.observables, p.state, p.eigenvalues, p.stability, p.n_unstable, p.problem,
                          p.units, self.orbits[index])

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


def special_orbit(branch: CycleBranch, index: int, **details: Any) -> SpecialOrbit:
    """Return a special point from its row of a curve of orbits and what is known beside it."""
    p = special_from_row(branch.row(index), index=index, **details)
    return SpecialOrbit(
        p.parameters, p.observables, p.state, p.eigenvalues, p.stability, p.n_unstable, p.problem, p.units, p.kind,
        p.label, p.index, p.tolerance, p.converged, p.coefficients, p.vectors, p.note, p.free, p.curve,
        branch.orbits[index],
    )


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
