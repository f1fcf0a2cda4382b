"""Interpolation along a curve: weights of Hermite's polynomial (values and slopes) and of Lagrange's (values).

Source: Quarteroni, Sacco, Saleri, Numerical Mathematics (Springer 2007), sections 8.1 and 8.5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mjcont.numerics.problem import Array


def lagrange(nodes: Sequence[float], at: float) -> list[float]:
    """Return the weight of each node's value in the polynomial through all."""
    weights = []
    for a in nodes:
        weight = 1.0
        for b in nodes:
            if b != a:
                weight *= (at - b) / (a - b)
        weights.append(weight)
    return weights


def hermite(nodes: Sequence[float], at: float) -> tuple[list[float], list[float]]:
    """Return the weights of the nodes' values and of their slopes in Hermite's polynomial of degree 2 k - 1."""
    values, slopes = [], []
    for a, weight in zip(nodes, lagrange(nodes, at), strict=True):
        bend, square = 2.0 * sum(1.0 / (a - b) for b in nodes if b != a), weight * weight
        values.append(square - bend * (at - a) * square)
        slopes.append(square * (at - a))
    return values, slopes


def weights_along(nodes: Sequence[float], at: Array) -> tuple[Array, Array, Array]:
    """Return the weights of `lagrange`, and those of values and slopes of `hermite`, at places (m,), (m, k) each."""
    places = np.array(nodes)
    away = at[:, None] - places
    shares, found = _lagrange(places - places[:, None], away)
    square = found * found
    slopes = away * square
    return found, square - (2.0 * shares.sum(axis=0) - 2.0) * slopes, slopes


def lagrange_each(nodes: Array, at: Array) -> Array:
    """Return the weights of `lagrange`, (m, k), for rows of nodes (m, k) and one place each (m,)."""
    return _lagrange(nodes[:, None] - nodes[:, :, None], at[:, None] - nodes)[1]


def _lagrange(gaps: Array, away: Array) -> tuple[Array, Array]:
    """Return 1 / gaps, ones where a node meets itself, and the weights of nodes that lie `away` (m, k) from places.

    `gaps` [..., j, i] are node i minus node j; they are overwritten.
    """
    own = np.arange(away.shape[1])
    gaps[..., own, own] = 1.0
    shares = 1.0 / gaps
    parts = away[:, :, None] * shares
    parts[:, own, own] = 1.0
    return shares, parts.prod(axis=1)


def arc(chord: float, cosine: float) -> float:
    """Return the length of the circle's arc over a chord whose end tangents make an angle of given cosine."""
    half = 0.5 * math.acos(min(max(cosine, -1.0), 1.0))
    return chord * half / math.sin(half) if half > 1e-4 else chord


def combine(weights: Array | Sequence[float], parts: Sequence[Array]) -> Array:
    """Return sum_i weights[i] * parts[i]; weights are (k,), or (m, k) and give (m, *shape of a part)."""
    stack, table = np.array(parts), np.asarray(weights)
    out = table @ stack.reshape(len(parts), -1)
    return out.reshape((*table.shape[:-1], *stack.shape[1:]))
