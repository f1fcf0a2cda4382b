"""Energy barriers that guard a rest: of one, along a branch, over two parameters."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.results.points import Point, show
from mjcont.results.text import Cells, Shown, Tabular, to_xarray


@dataclass(frozen=True, slots=True, repr=False)
class Barrier(Shown):
    """The energy barrier that guards a rest.

    Attributes
    ----------
    energy : in J; infinite where no pass is known, zero at a fold.
    rest : the equilibrium at rest.
    saddle : the pass, or None.
    beyond : the state at which the descent on its far side ends, or None.
    tried : number of passes looked at.
    message : a sentence.
    """

    energy: float
    rest: Point
    saddle: Point | None
    beyond: Array | None = field(repr=False)
    tried: int = 0
    message: str = ""

    def __str__(self) -> str:
        """Return the energy and where the pass is."""
        where = f" over the pass at {self.saddle}" if self.saddle is not None else ""
        return f"energy barrier {self.energy:.6g} J{where}: {self.message}"


@dataclass(frozen=True, slots=True, repr=False)
class BarrierCurve(Tabular, Shown):
    """Energy barriers along the stable part of a branch.

    Attributes
    ----------
    name, unit : the parameter.
    values, energy : (m,) its values, and the barriers in J, in order along the branch.
    rows : (m,) rows of the branch that they belong to: stable ones some way apart, and the folds.
    barriers : one a value.
    pieces : (m,) number of the piece of the branch, stable throughout, that each belongs to.
    """

    name: str
    unit: str
    values: Array
    energy: Array
    rows: Array
    barriers: Sequence[Barrier] = field(repr=False)
    pieces: Array = field(repr=False)

    def plot(self, ax: Any = None) -> Any:
        """Draw the barrier against the parameter and return the axes."""
        from mjcont.drawing.barriers import draw_barriers

        return draw_barriers(self, ax)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        yield "row", "", self.rows
        yield self.name, self.unit, self.values
        yield "energy", "J", self.energy
        yield "message", "", [b.message for b in self.barriers]

    def __str__(self) -> str:
        """Return the range of the parameter and of the barrier."""
        known = self.energy[np.isfinite(self.energy)]
        span = f"{show(self.values.min(), self.unit)} .. {show(self.values.max(), self.unit)}"
        levels = f"{known.min():.6g} .. {known.max():.6g} J" if len(known) else "no pass known"
        return f"energy barrier, {self.name} = {span} ({len(self.values)} rests): {levels}"


@dataclass(frozen=True, slots=True, repr=False)
class BarrierMap(Tabular, Shown):
    """Energy barriers over a grid of two parameters.

    Attributes
    ----------
    names, units : of the two parameters.
    x, y : (nx,) and (ny,) their values.
    energy : (ny, nx) barriers in J: NaN where the rest does not exist, infinite where no pass is known.
    """

    names: tuple[str, str]
    units: tuple[str, str]
    x: Array
    y: Array
    energy: Array

    def plot(self, ax: Any = None, *, levels: Any = 10) -> Any:
        """Draw contours of the barrier and return the axes."""
        from mjcont.drawing.barriers import draw_map

        return draw_map(self, ax, levels)

    def to_xarray(self) -> Any:
        """Return the grid as an xarray Dataset, SI and radians, units in `attrs`.

        Raises
        ------
        MjcontError
            If xarray is not installed.
        """
        (x, y), (unit_x, unit_y) = self.names, self.units
        return to_xarray({y: (unit_y, self.y), x: (unit_x, self.x)}, {"energy": ("J", self.energy)})

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        for name, unit, grid in zip(self.names, self.units, np.meshgrid(self.x, self.y), strict=True):
            yield name, unit, grid.ravel()
        yield "energy", "J", self.energy.ravel()

    def __str__(self) -> str:
        """Return the grid and the range of the barrier."""
        known = self.energy[np.isfinite(self.energy)]
        levels = f"{known.min():.6g} .. {known.max():.6g} J" if len(known) else "none known"
        lost = int(np.count_nonzero(np.isnan(self.energy)))
        return f"energy barrier over {self.names[0]} and {self.names[1]}, {self.energy.shape[1]} x " \
               f"{self.energy.shape[0]}: {levels}; no rest at {lost}"
