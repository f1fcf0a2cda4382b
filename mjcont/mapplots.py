"""Pictures of a special point over a grid of parameters: a line, contours, a surface."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.collect import units as unit_of
from mjcont.numerics.problem import Array
from mjcont.pathplots import axis_label

if TYPE_CHECKING:
    from mjcont.maps import SpecialMap


def scaled(values: Array, unit: str) -> Array:
    """Return values as they are shown: radians in degrees."""
    return np.degrees(values) if unit == "rad" else values


def draw_line(found: SpecialMap, quantity: str, ax: Any) -> Any:
    """Draw a quantity against the one parameter of a map."""
    from mjcont.plotting import COLORS, new_figure

    ((name, values),) = found.axes.items()
    units = unit_of(found.point.problem)
    axes = new_figure()[1] if ax is None else ax
    axes.plot(scaled(values, units[name]), scaled(found[quantity], units[quantity]), ".-", color=COLORS[0])
    axes.set(xlabel=axis_label(name, units[name]), ylabel=axis_label(quantity, units[quantity]))
    return axes


def draw_map(found: SpecialMap, quantity: str, kind: str, ax: Any) -> Any:
    """Draw a quantity over the two parameters of a map: contours with their values, or a surface."""
    from mjcont.plotting import new_figure

    units = unit_of(found.point.problem)
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
        ax.clabel(lines, fontsize=7.0, fmt=_tick)
        ax.get_figure().colorbar(filled, ax=ax, label=axis_label(quantity, units[quantity]))
        low, high = (found.largest(quantity, smallest=s) for s in (True, False))
        for p, marker, word in ((low, "v", "smallest"), (high, "^", "largest")):
            ax.plot(*(float(scaled(np.array(p[n]), units[n])) for n in (first, second)), marker, color="black",
                    markersize=7.0, markeredgecolor="white", clip_on=False, label=word, linestyle="none")
        ax.legend(loc="upper center", bbox_to_anchor=(0.5, 1.1), ncols=2, frameon=False)
        ax.grid(visible=False)
    ax.set(xlabel=axis_label(first, units[first]), ylabel=axis_label(second, units[second]))
    return ax


def _tick(value: float) -> str:
    return f"{value:.4g}" if abs(value) < 1e4 or not math.isfinite(value) else f"{value:.0f}"
