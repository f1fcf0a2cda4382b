"""Observables along an orbit: polynomials through what is read, their extremes, means and first harmonic.

On each interval of the mesh an observable is the polynomial through its values at the collocation points and the ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.path import Path

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


def readings(path: Path, reading: Reading, harmonic: bool) -> dict[str, Array]:
    """Return the numbers of all observables of an orbit by what they are, (number of observables,) each."""
    points = reading.points
    high, low = extremes(path, reading)
    found = {"max": high, "min": low, "amplitude": 0.5 * (high - low)}
    found["mean"] = path.weights @ points
    found["rms"] = np.sqrt(path.weights @ points**2)
    if harmonic:
        first = 2.0 * (path.weights * np.exp(-2j * np.pi * path.points)) @ points
        found["h1"], found["phase"] = np.abs(first), np.angle(first)
    return found


def along(path: Path, reading: Reading, k: int, tau: Array) -> tuple[Array, Array]:
    """Return observable number k at places tau (m,) in the period, and its rate in tau, (m,) each."""
    nodes, values = _pieces(path, reading)
    i = np.clip(np.searchsorted(path.mesh, tau, side="right") - 1, 0, len(path.w) - 1)
    theta = (tau - path.mesh[i]) / path.lengths[i]
    powers = np.linalg.solve(np.vander(2.0 * nodes - 1.0, increasing=True), values[i, :, k].T)
    s = 2.0 * theta - 1.0
    raised = s[:, None] ** np.arange(len(nodes))
    value: Array = np.einsum("mj,jm->m", raised, powers)
    slope = np.einsum("mj,jm->m", raised[:, :-1], powers[1:] * np.arange(1, len(nodes))[:, None])
    return value, 2.0 * slope / path.lengths[i]


def extremes(path: Path, reading: Reading) -> tuple[Array, Array]:
    """Return the largest and smallest values of all observables, of the polynomials through what is read."""
    nodes, values = _pieces(path, reading)
    fine = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, _READ))
    weights = np.array([_lagrange(nodes, t) for t in fine])
    read = np.einsum("tl,ilo->ito", weights, values)
    return _peaks(read, fine, values, nodes), -_peaks(-read, fine, -values, nodes)


def _pieces(path: Path, reading: Reading) -> tuple[Array, Array]:
    """Return the nodes of an interval, from 0 to 1, and the observables there, (N, number of nodes, observables)."""
    m, count = path.scheme.degree, len(path.w)
    nodes, values = path.scheme.c, reading.points.reshape(count, m, -1)
    if nodes[-1] < 1.0:
        nodes, values = np.append(nodes, 1.0), np.concatenate([values, reading.ends[1:, None]], axis=1)
    return np.append(0.0, nodes), np.concatenate([reading.ends[:-1, None], values], axis=1)


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
