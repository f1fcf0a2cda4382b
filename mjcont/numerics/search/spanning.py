"""From which neighbour each of many points is reached: a spanning tree that does not grow deep."""

from __future__ import annotations

import math

import numpy as np

from mjcont.numerics.equations.problem import Array


def spanning_tree(points: Array, deepest: int) -> Array:
    """Return the parent of each point in a spanning tree whose root is the origin, itself no point.

    Each point hangs on the nearest of the origin and the points before it, points at the depth `deepest` left out; the
    first of several equal distances counts. So the tree of the first points is the beginning of that of more.

    Parameters
    ----------
    points : (N, d) array, scaled.
    deepest : int
        Edges from the origin to any point, at most.

    Returns
    -------
    (N,) int array
        Row of the parent, -1 for the origin.
    """
    count, columns = len(points), np.ascontiguousarray(points.T)
    parents, depth = np.full(count, -1), np.ones(count, dtype=int)
    full, apart, distance = np.zeros(count), np.empty(count), np.empty(count)
    from_origin = sum((column * column for column in columns), np.zeros(count))
    for i in range(count):
        before, away = apart[:i], distance[:i]
        away[:] = full[:i]
        for column in columns:  # in place: a large design spends its time here
            np.subtract(column[:i], column[i], out=before)
            np.multiply(before, before, out=before)
            np.add(away, before, out=away)
        nearest = int(away.argmin()) if i else 0
        if i and away[nearest] < from_origin[i]:
            parents[i], depth[i] = nearest, depth[nearest] + 1
        full[i] = math.inf if depth[i] >= deepest else 0.0
    return parents


def heights(parents: Array) -> Array:
    """Return for each point of a tree the length of the longest chain that hangs on it, (N,) int."""
    found = np.zeros(len(parents), dtype=int)
    depth = np.zeros(len(parents), dtype=int)
    for i in range(len(parents)):
        k = int(parents[i])
        while k >= 0:
            depth[i] += 1
            k = int(parents[k])
    for i in np.argsort(-depth, kind="stable"):
        if parents[i] >= 0:
            found[parents[i]] = max(found[parents[i]], found[i] + 1)
    return found
