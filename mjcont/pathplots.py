"""Load paths with arrows, energy barriers along a parameter, and maps of them, in matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.escapes import for_picture
from mjcont.numerics.problem import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from mjcont.margins import BarrierCurve, BarrierMap
    from mjcont.pathresults import LoadPath

_SHORTEST = 0.04


def draw_path(ax: Axes, path: LoadPath, x: str, y: str, *, degrees: bool, color: str, labels: bool) -> None:
    """Draw a load path: its segments with arrows half-way along, jumps as dotted arrows with the label of the loss."""
    from mjcont.plotting import mark

    drawn = [tuple(_column(path, s[n], n, degrees) for n in (x, y)) for s in path.segments]
    spans = [max(float(np.ptp(np.concatenate([d[k] for d in drawn]))), 1e-300) for k in (0, 1)]
    for xs, ys in drawn:
        ax.plot(xs, ys, color=color, linewidth=2.6, alpha=0.55, solid_capstyle="round", label="_path", zorder=2.5)
        _arrow(ax, xs / spans[0], ys / spans[1], xs, ys, color)
    xs, ys = (_column(path, path[n], n, degrees) for n in (x, y))
    for jump in path.jumps:
        i = jump.index
        if jump.after is not None and i + 1 < len(xs):
            ax.annotate("", (xs[i + 1], ys[i + 1]), (xs[i], ys[i]), zorder=3,
                        arrowprops={"arrowstyle": "-|>", "color": color, "linestyle": (0, (2, 1.5)), "linewidth": 1.4,
                                    "shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 13})
        mark(ax, xs[i], ys[i], jump.kind, jump.label if labels else "", color=color, hollow=jump.after is None)


def _arrow(ax: Axes, u: Array, v: Array, xs: Array, ys: Array, color: str) -> None:
    """Put an arrow head half-way along a segment, by its length as drawn; none on a short one."""
    s = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(u), np.diff(v)))])
    if s[-1] < _SHORTEST:
        return
    ends = np.array([0.5 * s[-1] - 0.005, 0.5 * s[-1] + 0.005])
    (x0, x1), (y0, y1) = np.interp(ends, s, xs), np.interp(ends, s, ys)
    ax.annotate("", (x1, y1), (x0, y0), zorder=3,
                arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 0.0, "mutation_scale": 15,
                            "shrinkA": 0.0, "shrinkB": 0.0})


def _column(path: Any, values: Array, name: str, degrees: bool) -> Array:
    return np.degrees(values) if degrees and path.unit(name) == "rad" else values


def axis_label(name: str, unit: str, degrees: bool = True) -> str:
    """Return an axis label with its unit."""
    unit = "deg" if degrees and unit == "rad" else unit.replace("*", " ")
    shown = for_picture(name)
    return f"{shown} [{for_picture(unit)}]" if unit not in ("", "1") else shown


def draw_barriers(curve: BarrierCurve, ax: Axes | None = None) -> Axes:
    """Draw energy barriers along a parameter, each stable piece of the branch a line."""
    from mjcont.plotting import COLORS, new_figure

    if ax is None:
        _, ax = new_figure()
    values = np.degrees(curve.values) if curve.unit == "rad" else curve.values
    energy = np.where(np.isfinite(curve.energy), curve.energy, np.nan)
    apart = np.flatnonzero(np.diff(curve.rows) > 1) + 1
    for i, run in enumerate(np.split(np.arange(len(values)), apart)):
        ax.plot(values[run], energy[run], color=COLORS[i % len(COLORS)], linewidth=1.8)
    ax.set(xlabel=axis_label(curve.name, curve.unit), ylabel="energy barrier [J]")
    ax.set_ylim(bottom=0.0)
    return ax


def draw_map(barriers: BarrierMap, ax: Axes | None = None, levels: Any = 10) -> Axes:
    """Draw contours of energy barriers over two parameters; blank where there is no rest or no pass is known."""
    from mjcont.plotting import new_figure

    if ax is None:
        _, ax = new_figure()
    scales = [np.degrees(1.0) if u == "rad" else 1.0 for u in barriers.units]
    energy = np.ma.masked_invalid(barriers.energy)
    shades = ax.contourf(scales[0] * barriers.x, scales[1] * barriers.y, energy, levels=levels, cmap="Blues")
    lines = ax.contour(shades, colors="#333333", linewidths=0.7)
    ax.clabel(lines, fontsize=7.5, fmt="%g")
    ax.set(xlabel=axis_label(barriers.names[0], barriers.units[0]),
           ylabel=axis_label(barriers.names[1], barriers.units[1]))
    figure: Any = ax.get_figure(root=True)
    figure.colorbar(shades, ax=ax, label="energy barrier [J]")
    return ax
