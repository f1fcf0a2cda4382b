"""Interpolation along a curve: weights of Hermite's polynomial (values and slopes) and of Lagrange's (values).

Polynomials go through the points around a gap, none of them a cluster.

Source: Quarteroni, Sacco, Saleri, Numerical Mathematics (Springer 2007), sections 8.1 and 8.5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.columns import weighted_sum
from mjcont.numerics.equations.problem import Array


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


def lagrange_each(nodes: Array, at: Array) -> Array:
    """Return the weights of `lagrange`, (m, k), for rows of nodes (m, k) and one place each (m,)."""
    return _each(nodes, at)[1]


def hermite_each(nodes: Array, at: Array) -> tuple[Array, Array, Array]:
    """Return the weights of values and slopes of `hermite` and those of `lagrange`, (m, k) each, as `lagrange_each`."""
    shares, found = _each(nodes, at)
    square = found * found
    slopes = (at[:, None] - nodes) * square
    return square - (2.0 * shares.sum(axis=1) - 2.0) * slopes, slopes, found


def _each(nodes: Array, at: Array) -> tuple[Array, Array]:
    """Return 1 / (node i - node j), (m, j, i) with ones where they are the same, and the weights of `lagrange_each`."""
    shares = nodes[:, None] - nodes[:, :, None]
    own = np.arange(nodes.shape[1])
    shares[:, own, own] = 1.0
    shares = 1.0 / shares
    parts = (at[:, None] - nodes)[:, :, None] * shares
    parts[:, own, own] = 1.0
    return shares, parts.prod(axis=1)


def mixed(weights: Array, matrices: Array, windows: Array) -> Array:
    """Return sums of matrices (N, a, b) at indices (m, k) with weights (m, k), (m, a, b)."""
    out = np.zeros((len(windows), *matrices.shape[1:]))
    for k in range(windows.shape[1]):
        out += weights[:, k, None, None] * matrices[windows[:, k]]
    return out


def node_windows(s: Array, gaps: Array, most: int, cluster: float) -> tuple[Array, Array]:
    """Return the points through which gaps are interpolated, and how many they are, by the point before the gap.

    They are (N - 1, k) and (N - 1,): of each row of points the first so many count. Points nearer to each other than a
    part `cluster` of the gap do not count twice: a polynomial through them is noise.
    """
    lengths, count = np.diff(s), min(most, len(s))
    first = np.clip(gaps - (count // 2 - 1), 0, len(s) - count)
    windows, sizes = np.zeros((len(lengths), count), dtype=int), np.zeros(len(lengths), dtype=int)
    windows[gaps], sizes[gaps] = first[:, None] + np.arange(count), count
    shortest = np.lib.stride_tricks.sliding_window_view(lengths, count - 1).min(axis=1)
    for i in gaps[shortest[first] < cluster * lengths[gaps]].tolist():
        chosen = _apart(s, i, most, cluster)
        windows[i, : len(chosen)], sizes[i] = chosen, len(chosen)
    return windows, sizes


def _apart(s: Array, i: int, most: int, cluster: float) -> list[int]:
    """Return the points nearest to the gap after i, no cluster among them."""
    chosen, gap = [i, i + 1], s[i + 1] - s[i]
    low, high = i - 1, i + 2
    while len(chosen) < most and (low >= 0 or high < len(s)):
        before = s[i] - s[low] if low >= 0 else math.inf
        behind = s[high] - s[i + 1] if high < len(s) else math.inf
        k = low if before <= behind else high
        if min(abs(s[k] - s[j]) for j in chosen) >= cluster * gap:
            chosen.append(k)
        low, high = (low - 1, high) if k == low else (low, high + 1)
    return chosen


def arc(chord: float, cosine: float) -> float:
    """Return the length of the circle's arc over a chord whose end tangents make an angle of given cosine."""
    half = 0.5 * math.acos(min(max(cosine, -1.0), 1.0))
    return chord * half / math.sin(half) if half > 1e-4 else chord


def combine(weights: Sequence[float], parts: Sequence[Array]) -> Array:
    """Return sum_i weights[i] * parts[i], for arrays or sparse matrices."""
    if sparse.issparse(parts[0]):
        found: Array = weighted_sum(weights, parts)
        return found
    stack = np.array(parts)
    found = (np.array(weights) @ stack.reshape(len(parts), -1)).reshape(stack.shape[1:])
    return found
