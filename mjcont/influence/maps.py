"""The verb `special_map`: where a special point lies over a grid of one or two parameters, and its pictures."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.curves.collect import units as unit_of
from mjcont.errors import MjcontError, ParameterError, unknown_name
from mjcont.influence.critical import check_targets, follow_point
from mjcont.numerics.equations.problem import Array
from mjcont.results.branch import SpecialPoint, show

_SHORTEST = 1e-3
_KINDS = ("contour", "surface")


@dataclass(frozen=True, slots=True)
class SpecialMap:
    """A special point over a grid of parameters, SI and radians.

    Attributes
    ----------
    point : SpecialPoint
        The one that was followed.
    axes : mapping of parameter to its grid.
    points : array of SpecialPoint, None where it does not exist, in the grid's shape.
    messages : array of str, empty where it exists, in the grid's shape.
    evaluations : int
    """

    point: SpecialPoint
    axes: Mapping[str, Array]
    points: Any = field(repr=False)
    messages: Any = field(repr=False)
    evaluations: int = 0

    @property
    def exists(self) -> Array:
        """Where the point was reached, bool in the grid's shape."""
        return np.vectorize(lambda p: p is not None, otypes=[bool])(self.points)

    def __getitem__(self, name: str) -> Array:
        """Return a parameter or observable of the points, NaN where there is none, in the grid's shape."""
        if name not in self.point.parameters and name not in self.point.observables:
            raise unknown_name("quantity", name, [*self.point.free, *self.point.observables])
        return np.vectorize(lambda p: math.nan if p is None else p[name], otypes=[float])(self.points)

    def largest(self, name: str, *, smallest: bool = False) -> SpecialPoint:
        """Return the point at which a quantity is largest on the grid (or smallest)."""
        values = self[name]
        at = np.nanargmin(values) if smallest else np.nanargmax(values)
        found: SpecialPoint = self.points.ravel()[at]
        return found

    def plot(self, quantity: str | None = None, *, kind: str = "contour", ax: Any = None) -> Any:
        """Draw a quantity (default the point's first parameter) over the grid and return the axes.

        Parameters
        ----------
        quantity : str, optional
        kind : {"contour", "surface"}
            Over two parameters; over one it is a line.
        ax : matplotlib Axes, optional
            A three-dimensional one for a surface.
        """
        from mjcont.drawing.mapplots import draw_line, draw_map

        name = quantity or next(iter(self.point.free))
        if kind not in _KINDS:
            raise unknown_name("kind of map", kind, _KINDS)
        _ = self[name]
        if len(self.axes) == 1:
            return draw_line(self, name, ax)
        return draw_map(self, name, kind, ax)

    def __str__(self) -> str:
        """Return the grid, and the range of the point's parameters with where the ends are."""
        shape = " x ".join(str(len(a)) for a in self.axes.values())
        there = self.exists
        lines = [
            f"{self.point.label} over {shape} values of {', '.join(self.axes)}: exists at {int(there.sum())} of "
            f"{there.size}; {self.evaluations} evaluations"
        ]
        units = unit_of(self.point.problem)
        for name in self.point.free:
            ends = [(word, self.largest(name, smallest=low)) for word, low in (("from", True), ("to", False))]
            lines.append(f"  {name}: " + " ".join(
                f"{word} {show(p[name], units[name])} at ("
                + ", ".join(f"{n} = {show(p[n], units[n], 4)}" for n in self.axes) + ")" for word, p in ends))
        lines += [f"  {m}" for m in dict.fromkeys(m for m in self.messages.ravel() if m)]
        return "\n".join(lines)


def special_map(point: SpecialPoint, grid: Mapping[str, Sequence[float] | Array]) -> SpecialMap:
    """Follow a special point over a grid of one or two parameters.

    Every node is reached from a neighbour that has been, the one nearest to the point first; where the way from one
    neighbour fails, the others are tried.

    Parameters
    ----------
    point : SpecialPoint
    grid : mapping of parameter to increasing values, SI and radians

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
    before = point.problem.evaluations
    shape = tuple(len(a) for a in axes.values())
    points, messages = np.full(shape, None, dtype=object), np.full(shape, "", dtype=object)
    here = point.problem.values(point.parameters)
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
        front = reached
    messages[np.vectorize(lambda p: p is None)(points) & (messages == "")] = "no neighbour was reached"
    return SpecialMap(point, axes, points, messages, point.problem.evaluations - before)


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
