"""A special point at other parameter values: moved there, mapped over a grid, at its worst in a box."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.results.model import units as unit_of
from mjcont.results.points import SpecialPoint, show
from mjcont.results.text import Cells, Shown, Tabular, to_xarray

_KINDS = ("contour", "surface")


@dataclass(frozen=True, slots=True, repr=False)
class SpecialMap(Tabular, Shown):
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
        return np.asarray(np.vectorize(lambda p: p is not None, otypes=[bool])(self.points))

    def __getitem__(self, name: str) -> Array:
        """Return a parameter or observable of the points, NaN where there is none, in the grid's shape."""
        if name not in self.point.parameters and name not in self.point.observables:
            raise unknown_name("quantity", name, [*self.point.free, *self.point.observables])
        return np.asarray(np.vectorize(lambda p: math.nan if p is None else p[name], otypes=[float])(self.points))

    def _ipython_key_completions_(self) -> list[str]:
        """Return the names that [...] takes."""
        return [*self.point.parameters, *self.point.observables]

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
        from mjcont.drawing.maps import draw_line, draw_map

        name = quantity or next(iter(self.point.free))
        if kind not in _KINDS:
            raise unknown_name("kind of map", kind, _KINDS)
        _ = self[name]
        if len(self.axes) == 1:
            return draw_line(self, name, ax)
        return draw_map(self, name, kind, ax)

    def to_xarray(self) -> Any:
        """Return the grid as an xarray Dataset, SI and radians, units in `attrs`.

        Raises
        ------
        MjcontError
            If xarray is not installed.
        """
        units = unit_of(self.point.model)
        own = (*(n for n in self.point.free if n not in self.axes), *self.point.observables)
        return to_xarray({n: (units[n], a) for n, a in self.axes.items()}, {n: (units[n], self[n]) for n in own})

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        units = unit_of(self.point.model)
        for name, grid in zip(self.axes, np.meshgrid(*self.axes.values(), indexing="ij"), strict=True):
            yield name, units[name], grid.ravel()
        own = (n for n in self.point.free if n not in self.axes)
        yield from ((n, units[n], self[n].ravel()) for n in (*own, *self.point.observables))
        yield "message", "", self.messages.ravel().tolist()

    def __str__(self) -> str:
        """Return the grid, and the range of the point's parameters with where the ends are."""
        shape = " x ".join(str(len(a)) for a in self.axes.values())
        there = self.exists
        lines = [
            f"{self.point.label} over {shape} values of {', '.join(self.axes)}: exists at {int(there.sum())} of "
            f"{there.size}; {self.evaluations} evaluations"
        ]
        units = unit_of(self.point.model)
        for name in self.point.free:
            ends = [(word, self.largest(name, smallest=low)) for word, low in (("from", True), ("to", False))]
            lines.append(f"  {name}: " + " ".join(
                f"{word} {show(p[name], units[name])} at ("
                + ", ".join(f"{n} = {show(p[n], units[n], 4)}" for n in self.axes) + ")" for word, p in ends))
        lines += [f"  {m}" for m in dict.fromkeys(m for m in self.messages.ravel() if m)]
        return "\n".join(lines)


@dataclass(frozen=True, slots=True, repr=False)
class WorstCase(Tabular, Shown):
    """The extreme of a special point over a box of parameters.

    Attributes
    ----------
    point : SpecialPoint
        Where the quantity is extreme.
    quantity : str
    value : float
        SI and radians.
    maximise : bool
    parameters : mapping of parameter to its value there.
    active : mapping of parameter to "low" or "high", for those at a bound that holds the extreme there.
    kkt : float
        Largest component of the projected gradient, relative to the quantity: by how much of itself the quantity
        would still change over the width of the box.
    status : {"stationary", "at the edge", "not converged"}
    message : str
        A sentence.
    evaluations : int
    path : values of the box's parameters and the quantity, at each improvement of the run that led here.
    starts : number of runs that ended at this extreme, and number of runs.
    grid : SpecialMap or None
    """

    point: SpecialPoint
    quantity: str
    value: float
    maximise: bool
    parameters: Mapping[str, float]
    active: Mapping[str, str]
    kkt: float
    status: str
    message: str
    evaluations: int
    path: Sequence[Mapping[str, float]] = field(repr=False)
    starts: tuple[int, int] = (1, 1)
    grid: SpecialMap | None = field(repr=False, default=None)

    def plot(self, parameter: str | None = None, *, ax: Any = None) -> Any:
        """Draw the quantity over the grid if there is one, else on its way against a parameter; return the axes."""
        from mjcont.drawing.charts import draw_steps

        if self.grid is not None and parameter is None:
            return self.grid.plot(self.quantity, ax=ax)
        name = parameter or next(iter(self.parameters))
        if name not in self.parameters:
            raise unknown_name("parameter", name, self.parameters)
        return draw_steps(self._steps(), name, self.quantity, unit_of(self.point.model), ax)

    def _steps(self) -> list[Mapping[str, float]]:
        """Return the improvements, the extreme last."""
        last = {**self.parameters, self.quantity: self.value}
        return [*self.path, *([last] if not self.path or dict(self.path[-1]) != last else [])]

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        return _steps(self._steps(), [*self.parameters, self.quantity], self.point)

    def __str__(self) -> str:
        """Return the extreme, where it is, and the sentence."""
        units = unit_of(self.point.model)
        word = "largest" if self.maximise else "smallest"
        where = ", ".join(
            f"{n} = {show(v, units[n], 6)}" + (f" ({self.active[n]})" if n in self.active else "")
            for n, v in self.parameters.items()
        )
        head = f"{word} {self.quantity} at {self.point.label}: {show(self.value, units[self.quantity])} at {where}"
        return f"{head}\n  {self.message}; {self.evaluations} evaluations\n  {self.point}"


@dataclass(frozen=True, slots=True, repr=False)
class FollowedPoint(Tabular, Shown):
    """A special point that was moved to other parameter values.

    Attributes
    ----------
    point : SpecialPoint
        Where it is now: at the values asked for, or the last one on the way there.
    reached : bool
    status : {"reached", "ceased", "at bound", "stuck"}
    message : str
        A sentence.
    path : values of the parameters moved and of the point's own, at every step from the start on.
    evaluations : int
    """

    point: SpecialPoint
    reached: bool
    status: str
    message: str
    path: Sequence[Mapping[str, float]] = field(repr=False)
    evaluations: int = 0

    def plot(self, x: str | None = None, y: str | None = None, *, ax: Any = None) -> Any:
        """Draw the way: the point's own parameter (or y) against the first that was moved (or x); return the axes."""
        from mjcont.drawing.charts import draw_steps

        names = list(self.path[0])
        own = [n for n in names if n in self.point.free]
        moved = [n for n in names if n not in own]
        chosen = (x or (moved or names)[0], y or (own or names)[0])
        for name in chosen:
            if name not in names:
                raise unknown_name("parameter", name, names)
        return draw_steps(self.path, *chosen, unit_of(self.point.model), ax)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        return _steps(self.path, list(self.path[0]), self.point)

    def __str__(self) -> str:
        """Return the sentence and the point."""
        return f"{self.message} ({len(self.path) - 1} steps, {self.evaluations} evaluations)\n  {self.point}"


def _steps(path: Sequence[Mapping[str, float]], names: Sequence[str], point: SpecialPoint) -> Iterable[Cells]:
    """Return a row for each step of a path."""
    units = unit_of(point.model)
    return ((n, units[n], np.array([step[n] for step in path])) for n in names)
