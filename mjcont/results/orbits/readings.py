"""Observables along an orbit: polynomials through what is read, their extremes, means and first harmonic.

On each interval of the mesh an observable is the polynomial through its values at the collocation points and the ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.step.hermite import lagrange_each

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
    if not values.shape[2]:
        return np.zeros(0), np.zeros(0)
    fine = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, _READ))
    weights = _weights(nodes, fine)
    read = np.einsum("tl,ilo->ito", weights, values)
    return _peaks(read, fine, values, nodes), -_peaks(-read, fine, -values, nodes)


def _pieces(path: Path, reading: Reading) -> tuple[Array, Array]:
    """Return the nodes of an interval, from 0 to 1, and the observables there, (N, number of nodes, observables)."""
    m, count = path.scheme.degree, len(path.w)
    nodes, values = path.scheme.c, reading.points.reshape(count, m, -1)
    if nodes[-1] < 1.0:
        nodes, values = np.append(nodes, 1.0), np.concatenate([values, reading.ends[1:, None]], axis=1)
    return np.append(0.0, nodes), np.concatenate([reading.ends[:-1, None], values], axis=1)


def _weights(nodes: Array, places: Array) -> Array:
    """Return the weights of the values at nodes (m,) in the polynomial at places (..., m)."""
    rows = np.broadcast_to(nodes, (places.size, len(nodes)))
    return lagrange_each(rows, places.ravel()).reshape(*places.shape, len(nodes))


def _peaks(read: Array, fine: Array, values: Array, nodes: Array) -> Array:
    """Return the largest value of each polynomial, by parabolas through the largest of what is read."""
    every = np.arange(read.shape[2])
    i, t = np.divmod(read.reshape(-1, len(every)).argmax(axis=0), read.shape[1])
    place, best, own = fine[t], read[i, t, every], values[i, :, every]
    reach = 0.5 * (fine[np.minimum(t + 1, _READ - 1)] - fine[np.maximum(t - 1, 0)])
    for _ in range(3):
        around = np.clip(place[:, None] + reach[:, None] * np.array([-1.0, 0.0, 1.0]), 0.0, 1.0)
        y = np.einsum("okm,om->ok", _weights(nodes, around), own)
        best = np.maximum(best, y.max(axis=1))
        widths = np.diff(around, axis=1)
        rises = np.diff(y, axis=1) / np.where(widths > 0.0, widths, np.inf)
        bend = (rises[:, 1] - rises[:, 0]) / widths.sum(axis=1)
        slope = rises[:, 0] + bend * (2.0 * place - around[:, 0] - around[:, 1])
        bends = (bend < 0.0) & (widths > 0.0).all(axis=1)  # the others are at an end, where nothing is larger inside
        place = np.clip(place - np.where(bends, slope / np.where(bends, 2.0 * bend, 1.0), 0.0), 0.0, 1.0)
        best = np.maximum(best, np.einsum("om,om->o", _weights(nodes, place), own))
        reach = 0.1 * reach
    found: Array = best
    return found
