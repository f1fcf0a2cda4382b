"""Pictures of a sweep: how a quantity is distributed, and how it goes with a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.branch import Column
from mjcont.mapplots import scaled
from mjcont.pathplots import axis_label

if TYPE_CHECKING:
    from mjcont.sweeptable import SweepTable


def draw_histogram(table: SweepTable, column: Column, ax: Any) -> Any:
    """Draw the distribution of a column with its 2.5 %, 50 % and 97.5 % points and the nominal value."""
    from mjcont.plotting import COLORS, new_figure

    axes = new_figure()[1] if ax is None else ax
    values = scaled(column.values[np.isfinite(column.values)], column.unit)
    if not len(values):
        axes.set(xlabel=axis_label(column.name, column.unit), ylabel="cases")
        return axes
    bins: str | int = "auto" if len(values) > 1 else 1
    axes.hist(values, bins=bins, color=COLORS[0], alpha=0.75, edgecolor="white", linewidth=0.4)
    for k, point in enumerate(np.percentile(values, (2.5, 50.0, 97.5))):
        label = {0: "2.5 % and 97.5 %", 1: "median"}.get(k)
        axes.axvline(point, color="#333333", linestyle="-" if k == 1 else "--", linewidth=1.0, label=label)
    nominal = float(scaled(np.array(table.nominal[column.name]), column.unit))
    axes.axvline(nominal, color=COLORS[1], linestyle=":", linewidth=1.6, label="nominal")
    axes.set(xlabel=axis_label(column.name, column.unit), ylabel="cases")
    axes.legend(loc="best", fontsize=7.5)
    return axes


def draw_scatter(table: SweepTable, x: Column, y: Column, ax: Any) -> Any:
    """Draw a column against another, with the nominal case."""
    from mjcont.plotting import COLORS, new_figure

    axes = new_figure()[1] if ax is None else ax
    size = 14.0 if len(table) < 300 else 5.0
    axes.scatter(scaled(x.values, x.unit), scaled(y.values, y.unit), s=size, color=COLORS[0], alpha=0.55, linewidths=0)
    at = [float(scaled(np.array(table.nominal[c.name]), c.unit)) for c in (x, y)]
    axes.plot(*at, "D", color=COLORS[1], markersize=6.0, markeredgecolor="white", linestyle="none", label="nominal")
    axes.set(xlabel=axis_label(x.name, x.unit), ylabel=axis_label(y.name, y.unit))
    axes.legend(loc="best", fontsize=7.5)
    return axes
