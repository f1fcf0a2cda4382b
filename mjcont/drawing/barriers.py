"""Energy barriers along a parameter, and over two of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing.axes import label_axes, show_axis
from mjcont.drawing.maps import write_levels

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from mjcont.results.barriers import BarrierCurve, BarrierMap


def draw_barriers(curve: BarrierCurve, ax: Axes | None = None) -> Axes:
    """Draw energy barriers along a parameter, each stable piece of the branch a line."""
    from mjcont.drawing.notes import LEGEND, place_legend
    from mjcont.drawing.plotting import COLORS, new_figure

    own = ax is None
    if ax is None:
        _, ax = new_figure()
    values = np.degrees(curve.values) if curve.unit == "rad" else curve.values
    energy = np.where(np.isfinite(curve.energy), curve.energy, np.nan)
    for i in range(int(curve.pieces[-1]) + 1):
        on = curve.pieces == i
        ax.plot(values[on], energy[on], color=COLORS[i % len(COLORS)], linewidth=1.8, label=f"stable piece {i + 1}")
    ax.set_ylim(bottom=0.0)
    label_axes(ax, (curve.name, curve.unit), ("energy barrier", "J"))
    if curve.pieces[-1] > 0:
        ax.legend(frameon=True, framealpha=0.9, edgecolor="none").set_label(LEGEND)
        place_legend(ax, own)
    return ax


def draw_map(barriers: BarrierMap, ax: Axes | None = None, levels: Any = 10) -> Axes:
    """Draw contours of energy barriers over two parameters; blank where there is no rest or no pass is known."""
    from mjcont.drawing.plotting import new_figure

    if ax is None:
        _, ax = new_figure()
    scales = [np.degrees(1.0) if u == "rad" else 1.0 for u in barriers.units]
    energy = np.ma.masked_invalid(barriers.energy)
    shades = ax.contourf(scales[0] * barriers.x, scales[1] * barriers.y, energy, levels=levels, cmap="Blues")
    lines = ax.contour(shades, colors="#333333", linewidths=0.7)
    label_axes(ax, (barriers.names[0], barriers.units[0]), (barriers.names[1], barriers.units[1]))
    figure: Any = ax.get_figure(root=True)
    show_axis(figure.colorbar(shades, ax=ax).ax.yaxis, "energy barrier", "J")
    write_levels(ax, lines)
    return ax
