"""How results show themselves: summaries, tables of parameters, and rows as CSV and as frames."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.errors import MjcontError
from mjcont.outside.csvfiles import write_table
from mjcont.results.quantities import Parameter
from mjcont.results.units import displayed

_LONGEST = 160
# a column's name, its unit, and its cells: an array of numbers, or words
Cells = tuple[str, str, Sequence[Any] | np.ndarray]


def table(rows: list[list[str]]) -> list[str]:
    """Return lines with aligned columns; the first row is the heading."""
    widths = [max(len(r[k]) for r in rows) for k in range(len(rows[0]))]
    return ["  " + "  ".join(c.ljust(w) for c, w in zip(r, widths, strict=True)).rstrip() for r in rows]


def number(value: float, unit: str) -> str:
    """Return a number as shown; angles in degrees."""
    if not math.isfinite(value):
        return "-" if value < 0 else "+"
    return f"{math.degrees(value) if unit == 'rad' else value:.6g}"


def unit_shown(unit: str) -> str:
    """Return the unit in which a number is shown."""
    return "deg" if unit == "rad" else unit


class ParameterTable(dict[str, Parameter]):
    """Parameters by name; printed, a table of values, bounds, what a change costs, and what each acts on."""

    def __str__(self) -> str:
        """Return the table."""
        rows = [["name", "value", "unit", "from", "to", "a change costs", "acts on"]]
        for p in self.values():
            cells = [number(v, p.unit) for v in (p.value, *p.bounds)]
            rows.append([p.name, cells[0], unit_shown(p.unit), cells[1], cells[2], p.cost, p.acts_on])
        return "\n".join(table(rows))

    __repr__ = __str__

    def _repr_html_(self) -> str:
        """Return the table as a notebook shows it."""
        return f"<pre>{escape(str(self))}</pre>"


class Shown:
    """A result whose repr is the first line of its summary; a notebook shows all of it, and completes its columns."""

    def __repr__(self) -> str:
        """Return the kind of result and the first line of its summary."""
        line = str(self).partition("\n")[0]
        return f"<{type(self).__name__} {line if len(line) <= _LONGEST else line[: _LONGEST - 3] + '...'}>"

    def _repr_html_(self) -> str:
        """Return the summary as a notebook shows it."""
        return f"<pre>{escape(str(self))}</pre>"

    def _ipython_key_completions_(self) -> list[str]:
        """Return the names that [...] takes."""
        found: list[str] = []
        for each in ("columns", "fixed", "quantities", "parameters", "observables", "outputs"):
            found += [n for n in getattr(self, each, ()) if n not in found]
        return found


class Tabular:
    """A result that is a table, as CSV for others and as a frame: `_cells` says what is in it."""

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        """Return the columns, SI and radians; `degrees` is whether ratios of angles are shown in degrees."""
        raise NotImplementedError

    def to_csv(self, path: str | Path, *, degrees: bool = True) -> Path:
        """Write the table as CSV with units in the header, angles in degrees unless told otherwise."""
        return write_cells(path, self._cells(degrees), degrees)

    def to_dataframe(self) -> Any:
        """Return a pandas DataFrame, SI and radians; `attrs["units"]` has the unit of each column.

        Raises
        ------
        MjcontError
            If pandas is not installed.
        """
        try:
            import pandas as pd
        except ImportError as error:
            raise MjcontError("to_dataframe needs pandas: pip install 'mjcont[notebook]'") from error
        cells = list(self._cells(False))
        frame = pd.DataFrame({name: values for name, _, values in cells})
        frame.attrs["units"] = {name: unit for name, unit, _ in cells}
        return frame


def to_xarray(dimensions: Mapping[str, tuple[str, Any]], variables: Mapping[str, tuple[str, Any]]) -> Any:
    """Return an xarray Dataset of variables over dimensions, units in `attrs`; both map names to (unit, values).

    Raises
    ------
    MjcontError
        If xarray is not installed.
    """
    try:
        import xarray
    except ImportError as error:
        raise MjcontError("to_xarray needs xarray: pip install 'mjcont[notebook]'") from error
    over = tuple(dimensions)
    return xarray.Dataset(
        {name: (over[: np.ndim(values)], values, {"units": unit}) for name, (unit, values) in variables.items()},
        {name: (name, values, {"units": unit}) for name, (unit, values) in dimensions.items()},
    )


def write_cells(path: str | Path, columns: Iterable[Cells], degrees: bool = True) -> Path:
    """Write columns as CSV, their units as shown; what is no number is an empty cell."""
    heads, cells = [], []
    for name, unit, values in columns:
        shown, factor = displayed(unit, (), degrees)
        heads.append(f"{name} [{shown}]" if shown not in ("", "1") else name)
        turned = (values if factor == 1.0 else values * factor).tolist() if isinstance(values, np.ndarray) else values
        cells.append(["" if isinstance(v, float) and math.isnan(v) else v for v in turned])
    return write_table(path, heads, zip(*cells, strict=True))
