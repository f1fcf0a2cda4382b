"""Derivatives of a special point in parameters, as a table and as CSV."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.errors import ParameterError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import name_of
from mjcont.results.points import Point, SpecialPoint, show
from mjcont.results.text import Cells, Shown, Tabular
from mjcont.results.units import displayed, per


@dataclass(frozen=True, slots=True, repr=False)
class Sensitivities(Tabular, Shown):
    """Derivatives of a point's quantities in parameters, SI and radians.

    Attributes
    ----------
    point : Point
    parameters, quantities : names of the rows and columns of `derivatives`.
    derivatives : (number of parameters, number of quantities) array.
    values : mapping of every name to its value at the point.
    units : mapping of every name to its unit.
    tolerances : mapping of parameter to the change that `changes` and the chart are for.
    evaluations : int
        Evaluations of the forces that it took; observables are measured beside that.
    notes : sentences.
    """

    point: Point
    parameters: tuple[str, ...]
    quantities: tuple[str, ...]
    derivatives: Array
    values: Mapping[str, float] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    tolerances: Mapping[str, float] = field(repr=False)
    evaluations: int = 0
    notes: Sequence[str] = ()

    def __getitem__(self, key: str | tuple[str, str]) -> Any:
        """Return d quantity / d parameter for (quantity, parameter); for one name its derivatives by name."""
        if isinstance(key, tuple):
            return float(self.derivatives[self._row(key[1]), self._column(key[0])])
        if key in self.quantities:
            return dict(zip(self.parameters, (float(v) for v in self.derivatives[:, self._column(key)]), strict=True))
        if key in self.parameters:
            return dict(zip(self.quantities, (float(v) for v in self.derivatives[self._row(key)]), strict=True))
        raise unknown_name("quantity or parameter", key, [*self.quantities, *self.parameters])

    def _row(self, name: str) -> int:
        if name not in self.parameters:
            raise unknown_name("parameter", name, self.parameters)
        return self.parameters.index(name)

    def _column(self, name: str) -> int:
        if name not in self.quantities:
            raise unknown_name("quantity", name, self.quantities)
        return self.quantities.index(name)

    @property
    def elasticities(self) -> Array:
        """Relative change of each quantity per relative change of each parameter; NaN where either is zero."""
        p = np.array([self.values[n] for n in self.parameters])[:, None]
        q = np.array([self.values[n] for n in self.quantities])
        return self.derivatives * np.where(p == 0.0, np.nan, p) / np.where(q == 0.0, np.nan, q)

    @property
    def changes(self) -> Array:
        """First-order change of each quantity for each parameter's tolerance."""
        return np.asarray(self.derivatives * np.array([self.tolerances[n] for n in self.parameters])[:, None])

    def predict(self, changes: Mapping[str, float]) -> dict[str, float]:
        """Return the quantities, to first order, after parameters change by the amounts given."""
        moved = np.array([self.values[n] for n in self.quantities])
        for name, change in changes.items():
            moved = moved + self.derivatives[self._row(name)] * change
        return dict(zip(self.quantities, (float(v) for v in moved), strict=True))

    def ordered(self, quantity: str | None = None) -> list[str]:
        """Return the parameters by falling influence on a quantity (default the first) within their tolerances."""
        column = self._column(quantity or self.quantities[0])
        size = np.abs(self.changes[:, column])
        return [self.parameters[i] for i in np.lexsort((np.arange(len(size)), -size))]

    def with_tolerances(self, tolerances: Mapping[str, float]) -> Sensitivities:
        """Return the same derivatives with other tolerances for some parameters."""
        return Sensitivities(
            self.point, self.parameters, self.quantities, self.derivatives, self.values, self.units,
            {**self.tolerances, **checked_tolerances(tolerances, self.parameters)}, self.evaluations, self.notes,
        )

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        shown = [displayed(self.units[n], (), degrees) for n in self.parameters]
        sizes = np.array([size for _, size in shown])
        yield "parameter", "", self.parameters
        yield "unit", "", [unit or "1" for unit, _ in shown]
        yield "value", "", sizes * [self.values[n] for n in self.parameters]
        yield "tolerance", "", sizes * [self.tolerances[n] for n in self.parameters]
        for j, name in enumerate(self.quantities):
            unit, size = displayed(self.units[name], (), degrees)
            yield f"d {name} [{unit or '1'} / unit]", "", self.derivatives[:, j] * (size / sizes)
            yield f"elasticity of {name}", "", self.elasticities[:, j]
            yield f"change of {name}", self.units[name], self.changes[:, j]

    def plot(
        self, quantity: str | None = None, tolerances: Mapping[str, float] | None = None, *, most: int = 15,
        ax: Any = None,
    ) -> Any:
        """Draw a tornado chart: how far a quantity moves within each parameter's tolerance; return the axes.

        Parameters
        ----------
        quantity : str, optional
            Default the first.
        tolerances : mapping of parameter to change, optional
            In place of those that the changes are for.
        most : int
            The most influential parameters only.
        ax : matplotlib Axes, optional
        """
        from mjcont.drawing.charts import draw_tornado

        shown = self.with_tolerances(tolerances or {})
        return draw_tornado(shown, self.quantities[self._column(quantity or self.quantities[0])], most, ax)

    def __str__(self) -> str:
        """Return a table, the most influential parameter first."""
        from mjcont.results.sensitivities import table

        return table(self)


def checked_tolerances(tolerances: Mapping[str, float], names: Sequence[str]) -> dict[str, float]:
    """Return tolerances as positive floats.

    Raises
    ------
    NameLookupError, ParameterError
        If a name is none of `names` or a tolerance is not positive.
    """
    for name, value in tolerances.items():
        if name not in names:
            raise unknown_name("parameter", name, names)
        if not (math.isfinite(value) and value > 0):
            raise ParameterError(f"the tolerance of {name} must be positive, got {value:g}")
    return {name: float(value) for name, value in tolerances.items()}


def table(s: Sensitivities) -> str:
    """Return the sensitivities as text, the most influential parameter first."""
    heads = ["parameter", "value", "tolerance"]
    for name in s.quantities:
        heads += [f"d {name}", "elasticity", "change"]
    rows = [heads]
    for name in s.ordered():
        i, unit = s.parameters.index(name), s.units[name]
        row = [name, show(s.values[name], unit, 6), "+-" + show(s.tolerances[name], unit, 3)]
        for j, quantity in enumerate(s.quantities):
            row += [_slope(s, i, j), _ratio(s.elasticities[i, j]), _signed(s.changes[i, j], s.units[quantity])]
        rows.append(row)
    widths = [max(len(r[c]) for r in rows) for c in range(len(heads))]
    lines = [headline(s)]
    for row in rows:
        lines.append(("  " + "  ".join([row[0].ljust(widths[0]), *(
            text.rjust(w) for text, w in zip(row[1:], widths[1:], strict=True))])).rstrip())
    return "\n".join([*lines, *(f"  note: {n}" for n in s.notes)])


def headline(s: Sensitivities) -> str:
    """Return what the derivatives are of."""
    p = s.point
    name = f"{p.label} ({name_of(p.kind)})" if isinstance(p, SpecialPoint) and p.kind else "equilibrium"
    shown = ", ".join(f"{q} = {show(s.values[q], s.units[q])}" for q in s.quantities)
    return f"{name} of {p.model.name}: {shown}; {s.evaluations} evaluations"


def _slope(s: Sensitivities, i: int, j: int) -> str:
    """Return a derivative with its unit, per degree and in degrees for angles."""
    top, bottom = s.units[s.quantities[j]], s.units[s.parameters[i]]
    unit, factor = per(top, bottom)
    return f"{factor * float(s.derivatives[i, j]):.6g} {unit}".rstrip()


def _ratio(value: float) -> str:
    return f"{value:+.4g}" if math.isfinite(value) else "-"


def _signed(value: float, unit: str) -> str:
    text = show(abs(value), unit, 4)
    return text if value == 0 or not math.isfinite(value) else f"{'-' if value < 0 else '+'}{text}"
