"""The verb `special_map`: where a special point lies over a grid of one or two parameters, and its pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Amount
from mjcont.errors import MjcontError, ParameterError
from mjcont.influence.critical import check_targets, follow_point
from mjcont.numerics.equations.problem import Array
from mjcont.results.maps import SpecialMap
from mjcont.results.points import SpecialPoint

_SHORTEST = 1e-3


@checked
def special_map(
    point: SpecialPoint, grid: Mapping[str, Sequence[float] | Array], *, progress: Amount | None = None
) -> SpecialMap:
    """Follow a special point over a grid of one or two parameters.

    Every node is reached from a neighbour that has been, the one nearest to the point first; where the way from one
    neighbour fails, the others are tried.

    Parameters
    ----------
    point : SpecialPoint
    grid : mapping of parameter to increasing values, SI and radians
    progress : called as progress(nodes reached, all)

    Returns
    -------
    SpecialMap

    Raises
    ------
    MjcontError, ParameterError, NameLookupError, BoundsError
        If there are not one or two parameters with increasing values, or see `follow_point`.
    """
    if len(grid) not in (1, 2):
        raise ParameterError(f"a map has one or two parameters, got {len(grid)}")
    axes = {name: _axis(name, values) for name, values in grid.items()}
    for end in (0, -1):
        check_targets(point, {name: float(a[end]) for name, a in axes.items()})
    before = point.model.evaluations
    shape = tuple(len(a) for a in axes.values())
    points, messages = np.full(shape, None, dtype=object), np.full(shape, "", dtype=object)
    here = point.model.values(point.parameters)
    nearest = tuple(int(np.argmin(np.abs(a - here[name]))) for name, a in axes.items())
    _reach(point, axes, nearest, points, messages)
    front = [nearest] if points[nearest] is not None else []
    while front:
        reached = []
        for node in front:
            for other in _neighbours(node, shape):
                if points[other] is None:
                    _reach(points[node], axes, other, points, messages)
                    reached += [other] if points[other] is not None else []
                    if progress is not None:
                        progress(sum(p is not None for p in points.flat), points.size)
        front = reached
    messages[np.vectorize(lambda p: p is None)(points) & (messages == "")] = "no neighbour was reached"
    return SpecialMap(point, axes, points, messages, point.model.evaluations - before)


def _axis(name: str, values: Sequence[float] | Array) -> Array:
    try:
        axis = np.array(values, dtype=float)
    except (TypeError, ValueError) as error:
        raise ParameterError(f"the grid of {name} must be numbers, got {values!r}") from error
    if axis.ndim != 1 or len(axis) < 2 or not np.all(np.isfinite(axis)) or not np.all(np.diff(axis) > 0):
        raise ParameterError(f"the grid of {name} must be at least two finite, increasing numbers")
    axis.flags.writeable = False
    return axis


def _reach(start: SpecialPoint, axes: Mapping[str, Array], node: tuple[int, ...], points: Any, messages: Any) -> None:
    values = {name: float(a[i]) for (name, a), i in zip(axes.items(), node, strict=True)}
    try:
        found = follow_point(start, values, shortest=_SHORTEST)
    except MjcontError as error:  # a point that is not continuable from here: data, as the others are
        messages[node] = str(error)
        return
    points[node], messages[node] = (found.point, "") if found.reached else (None, found.message)


def _neighbours(node: tuple[int, ...], shape: tuple[int, ...]) -> list[tuple[int, ...]]:
    steps = [tuple(int(s) * (axis == k) for k in range(len(shape))) for axis in range(len(shape)) for s in (-1, 1)]
    moved = [tuple(i + d for i, d in zip(node, step, strict=True)) for step in steps]
    return [m for m in moved if all(0 <= i < n for i, n in zip(m, shape, strict=True))]
