"""Sensitivities shown: a table, a CSV file, a tornado chart."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.errors import ParameterError
from mjcont.outside.escapes import for_picture
from mjcont.results.points import show

if TYPE_CHECKING:
    from mjcont.results.sensitivities import Sensitivities

_SEEN = 1e-4  # of the widest bar
_MORE, _LESS = "#1b4f8a", "#c4541a"


def draw_tornado(s: Sensitivities, quantity: str, most: int, ax: Any) -> Any:
    """Draw a bar for each parameter from the change at minus its tolerance to that at plus, the widest on top."""
    from mjcont.drawing.plotting import new_figure

    if most < 1:
        raise ParameterError(f"most must be at least 1, got {most}")
    j = s.quantities.index(quantity)
    size = np.nan_to_num(np.abs(s.changes[:, j]))
    names = [n for n in s.ordered(quantity) if size[s.parameters.index(n)] > _SEEN * size.max(initial=0.0)][:most]
    unit = "deg" if s.units[quantity] == "rad" else s.units[quantity]
    factor = math.degrees(1.0) if s.units[quantity] == "rad" else 1.0
    axes = ax if ax is not None else new_figure(size=(6.2, 1.3 + 0.27 * max(len(names), 3)))[1]
    at = np.arange(len(names))[::-1]
    change = factor * np.array([s.changes[s.parameters.index(n), j] for n in names])
    axes.barh(at, change, height=0.62, color=_MORE, label="parameter up")
    axes.barh(at, -change, height=0.62, color=_LESS, hatch="////", edgecolor="white", linewidth=0.0,
              label="parameter down")
    axes.axvline(0.0, color="#333333", linewidth=0.8)
    labels = [f"{for_picture(n)}  \u00b1{show(s.tolerances[n], s.units[n], 3)}" for n in names]
    axes.set_yticks(at, labels)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel(f"change of {for_picture(quantity)}" + (f" [{unit}]" if unit not in ("", "1") else ""))
    rest = len(s.parameters) - len(names)
    title = f"{for_picture(quantity)} = {show(s.values[quantity], s.units[quantity], 6)}"
    axes.set_title(title + (f"   ({rest} more move it less or not)" if rest else ""), loc="left", fontsize=9.5)
    if names:
        axes.legend(loc="lower right", frameon=True, framealpha=0.9, edgecolor="none")
    return axes
