"""Interpolation along a curve: weights of Hermite's polynomial (values and slopes) and of Lagrange's (values)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from mjcont.numerics.problem import Array


def lagrange(nodes: Sequence[float], at: Any) -> Any:
    """Return the weight of each node's value in the polynomial through all: (k,) for a number, (k, m) for an array."""
    if isinstance(at, np.ndarray):
        places = np.array(nodes)
        gaps = places[:, None] - places
        np.fill_diagonal(gaps, 1.0)
        parts = (at - places[:, None])[None] / gaps[:, :, None]
        parts[np.arange(len(places)), np.arange(len(places))] = 1.0
        return parts.prod(axis=1)
    weights = []
    for i, a in enumerate(nodes):
        weight = 1.0
        for j, b in enumerate(nodes):
            if j != i:
                weight *= (at - b) / (a - b)
        weights.append(weight)
    return np.array(weights)


def hermite(nodes: Sequence[float], at: Any, weights: Any = None) -> tuple[Any, Any]:
    """Return the weights of the nodes' values and of their slopes in Hermite's polynomial of degree 2 k - 1.

    `weights` are those of `lagrange`, if they are known. Source: Quarteroni, Sacco, Saleri, Numerical Mathematics
    (Springer 2007), section 8.5.
    """
    found = lagrange(nodes, at) if weights is None else weights
    bends = np.array([2.0 * sum(1.0 / (a - b) for j, b in enumerate(nodes) if j != i) for i, a in enumerate(nodes)])
    away = np.array([at - a for a in nodes])
    square = found * found
    if square.ndim > 1:
        bends = bends[:, None]
    return square - bends * away * square, away * square


def arc(chord: float, cosine: float) -> float:
    """Return the length of the circle's arc over a chord whose end tangents make an angle of given cosine."""
    half = 0.5 * math.acos(min(max(cosine, -1.0), 1.0))
    return chord * half / math.sin(half) if half > 1e-4 else chord


def combine(weights: Array, parts: Sequence[Array]) -> Array:
    """Return sum_i weights[i] * parts[i]; weights are (k,), or (k, m) and give (m, *shape of a part)."""
    stack = np.array(parts)
    out = weights.T @ stack.reshape(len(parts), -1)
    return out.reshape((*weights.shape[1:], *stack.shape[1:]))
