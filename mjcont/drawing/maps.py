"""Pictures of a special point over a grid of parameters: a line, contours, a surface."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing.axes import axis_label, label_axes, scaled, show_axis
from mjcont.numerics.equations.problem import Array
from mjcont.results.model import units as unit_of

_MARK = 7.0

if TYPE_CHECKING:
    from mjcont.results.maps import SpecialMap


def draw_line(found: SpecialMap, quantity: str, ax: Any) -> Any:
    """Draw a quantity against the one parameter of a map."""
    from mjcont.drawing.plotting import COLORS, new_figure

    ((name, values),) = found.axes.items()
    units = unit_of(found.point.model)
    axes = new_figure()[1] if ax is None else ax
    axes.plot(scaled(values, units[name]), scaled(found[quantity], units[quantity]), ".-", color=COLORS[0])
    label_axes(axes, (name, units[name]), (quantity, units[quantity]))
    return axes


def draw_map(found: SpecialMap, quantity: str, kind: str, ax: Any) -> Any:
    """Draw a quantity over the two parameters of a map: contours with their values, or a surface."""
    from mjcont.drawing.plotting import new_figure

    units = unit_of(found.point.model)
    (first, xs), (second, ys) = ((n, scaled(a, units[n])) for n, a in found.axes.items())
    z = np.ma.masked_invalid(scaled(found[quantity], units[quantity]).T)
    if ax is None:
        options: dict[str, Any] = {"subplot_kw": {"projection": "3d"}} if kind == "surface" else {}
        ax = new_figure(size=(5.6, 4.2), **options)[1]
    if kind == "surface":
        ax.plot_surface(*np.meshgrid(xs, ys), z, cmap="viridis", edgecolor="#333333", linewidth=0.25, antialiased=True)
        ax.set_zlabel(axis_label(quantity, units[quantity]), labelpad=8)
        if ax.get_figure().axes == [ax]:  # the automatic layout leaves no room for the label of the third axis
            ax.get_figure().set_layout_engine("none")
            ax.set_position((0.02, 0.06, 0.84, 0.92))
    else:
        filled = ax.contourf(xs, ys, z, levels=14, cmap="viridis")
        lines = ax.contour(xs, ys, z, levels=filled.levels, colors="white", linewidths=0.6, linestyles="solid")
        bar = ax.get_figure().colorbar(filled, ax=ax)
        show_axis(bar.ax.yaxis, quantity, units[quantity])
        low, high = (found.largest(quantity, smallest=s) for s in (True, False))
        for p, marker, word in ((low, "v", "smallest"), (high, "^", "largest")):
            x, y = (float(scaled(np.array(p[n]), units[n])) for n in (first, second))
            ax.plot(x, y, marker, color="black", markersize=_MARK, markeredgecolor="white", label=word,
                    linestyle="none", transform=_inside(ax, (x, xs), (y, ys)), zorder=3)
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, frameon=False, borderaxespad=0.2)
        ax.grid(visible=False)
        write_levels(ax, lines)
    label_axes(ax, (first, units[first]), (second, units[second]))
    return ax


def _inside(ax: Any, *at: tuple[float, Array]) -> Any:
    """Return where a marker is drawn: at its place, but no part of it beyond the edge of the grid."""
    from matplotlib.transforms import ScaledTranslation

    inward = [float(v == values[0]) - float(v == values[-1]) for v, values in at]
    shift = (0.5 * _MARK + 1.5) / 72.0
    return ax.transData + ScaledTranslation(shift * inward[0], shift * inward[1], ax.get_figure().dpi_scale_trans)


def write_levels(ax: Any, lines: Any) -> None:
    """Write the levels on contours, none of them where the edge would cut it or a marker or another lies."""
    ax.get_figure(root=True).draw_without_rendering()  # lays out
    taken, places = [line.get_window_extent().padded(2.0) for line in ax.lines], []
    for text in ax.clabel(lines, fontsize=7.0, fmt=_tick, inline=False):
        box = text.get_window_extent().padded(1.0)
        whole = ax.bbox.x0 < box.x0 and box.x1 < ax.bbox.x1 and ax.bbox.y0 < box.y0 and box.y1 < ax.bbox.y1
        if whole and not any(box.overlaps(other) for other in taken):
            taken.append(box)
            places.append(text.get_position())
        text.remove()
    if places:
        ax.clabel(lines, fontsize=7.0, fmt=_tick, inline=True, manual=places)


def _tick(value: float) -> str:
    return f"{value:.4g}" if abs(value) < 1e4 or not math.isfinite(value) else f"{value:.0f}"
