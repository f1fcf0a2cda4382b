"""From which neighbour each of many points is reached: a spanning tree that does not grow deep."""

from __future__ import annotations

import math

import numpy as np

from mjcont.numerics.equations.problem import Array


def spanning_tree(points: Array, deepest: int) -> Array:
    """Return the parent of each point in a short spanning tree whose root is the origin, itself no point.

    Prim's algorithm, with points at the depth `deepest` as leaves: without that limit it is the minimum spanning tree.
    The first of several equal distances counts, so that the tree is a function of the points alone.

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
    count = len(points)
    parents, depth = np.full(count, -1), np.ones(count, dtype=int)
    near, left = np.einsum("ij,ij->i", points, points), np.ones(count, dtype=bool)
    for _ in range(count):
        i = int(np.argmin(np.where(left, near, math.inf)))
        left[i] = False
        if parents[i] >= 0:
            depth[i] = depth[parents[i]] + 1
        if depth[i] >= deepest:
            continue
        apart = points - points[i]
        distance = np.einsum("ij,ij->i", apart, apart)
        closer = left & (distance < near)
        near[closer], parents[closer] = distance[closer], i
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
