"""Interpolation along a curve: weights of Hermite's polynomial (values and slopes) and of Lagrange's (values)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from mjcont.numerics.problem import Array


def lagrange(nodes: Sequence[float], at: Any) -> list[Any]:
    """Return the weight of each node's value in the polynomial through all, at one parameter or an array of them."""
    weights = []
    for i, a in enumerate(nodes):
        weight: Any = 1.0
        for j, b in enumerate(nodes):
            if j != i:
                weight = weight * ((at - b) / (a - b))
        weights.append(weight)
    return weights


def hermite(nodes: Sequence[float], at: Any) -> tuple[list[Any], list[Any]]:
    """Return the weights of the nodes' values and of their slopes in Hermite's polynomial of degree 2 k - 1.

    Source: Quarteroni, Sacco, Saleri, Numerical Mathematics (Springer 2007), section 8.5.
    """
    values, slopes = [], []
    for i, (a, weight) in enumerate(zip(nodes, lagrange(nodes, at), strict=True)):
        bend = 2.0 * sum(1.0 / (a - b) for j, b in enumerate(nodes) if j != i)
        away, square = at - a, weight * weight
        values.append(square - bend * away * square)
        slopes.append(away * square)
    return values, slopes


def arc(chord: float, cosine: float) -> float:
    """Return the length of the circle's arc over a chord whose end tangents make an angle of given cosine."""
    half = 0.5 * math.acos(min(max(cosine, -1.0), 1.0))
    return chord * half / math.sin(half) if half > 1e-4 else chord


def combine(weights: Sequence[Any], parts: Sequence[Array]) -> Array:
    """Return sum_i weights[i] * parts[i]; weights are numbers, or (m,) arrays that give (m, *shape of a part)."""
    stack, factors = np.array(parts), np.array(weights)
    out = factors.T @ stack.reshape(len(parts), -1)
    return out.reshape((*factors.shape[1:], *stack.shape[1:]))
