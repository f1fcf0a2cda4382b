"""Charts of what goes with what: bars for sensitivities (a tornado), a sweep's distribution and scatter, histories."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.drawing.axes import axis_label, label_axes, readable, scaled, show_axis
from mjcont.errors import ParameterError
from mjcont.outside.escapes import for_picture
from mjcont.results.model import units as unit_of
from mjcont.results.points import Column, SpecialPoint, show

if TYPE_CHECKING:
    from mjcont.results.certificates import Certificate
    from mjcont.results.choices.holds import Hold
    from mjcont.results.choices.targets import Design
    from mjcont.results.histories import History
    from mjcont.results.search import Equilibria
    from mjcont.results.sensitivities import Sensitivities
    from mjcont.results.stiffness import StiffnessStudy
    from mjcont.results.sweeps import SweepTable

_SEEN = 1e-4  # of the widest bar
_MORE, _LESS = "#1b4f8a", "#c4541a"


def draw_tornado(s: Sensitivities, quantity: str, most: int, ax: Any) -> Any:
    """Draw a bar for each parameter from the change at minus its tolerance to that at plus, the widest on top."""
    from mjcont.drawing.notes import LEGEND, place_legend
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
    labels = [f"{readable(n)}  \u00b1{show(s.tolerances[n], s.units[n], 3)}" for n in names]
    axes.set_yticks(at, labels)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel(f"change of {axis_label(quantity, unit, False)}")
    rest = len(s.parameters) - len(names)
    where = f"{s.point.label} of {for_picture(s.point.model.name)}" if isinstance(s.point, SpecialPoint) else \
        f"equilibrium of {for_picture(s.point.model.name)}"
    title = f"{where}: {readable(quantity)} = {show(s.values[quantity], s.units[quantity], 6)}"
    axes.set_title(title + (f"\n{rest} more move it less or not" if rest else ""), loc="left", fontsize=9.5)
    if names:
        axes.legend(frameon=True, framealpha=0.9, edgecolor="none").set_label(LEGEND)
        place_legend(axes, ax is None)
    return axes


def draw_histogram(table: SweepTable, column: Column, ax: Any) -> Any:
    """Draw the distribution of a column with its 2.5 %, 50 % and 97.5 % points and the nominal value."""
    from mjcont.drawing.plotting import COLORS, new_figure

    axes = new_figure()[1] if ax is None else ax
    values = scaled(column.values[np.isfinite(column.values)], column.unit)
    if not len(values):
        label_axes(axes, (column.name, column.unit), ("cases", ""))
        return axes
    bins: str | int = "auto" if len(values) > 1 else 1
    axes.hist(values, bins=bins, color=COLORS[0], alpha=0.75, edgecolor="white", linewidth=0.4)
    for k, point in enumerate(np.percentile(values, (2.5, 50.0, 97.5))):
        label = {0: "2.5 % and 97.5 %", 1: "median"}.get(k)
        axes.axvline(point, color="#333333", linestyle="-" if k == 1 else "--", linewidth=1.0, label=label)
    nominal = float(scaled(np.array(table.nominal[column.name]), column.unit))
    axes.axvline(nominal, color=COLORS[1], linestyle=":", linewidth=1.6, label="nominal")
    label_axes(axes, (column.name, column.unit), ("cases", ""))
    axes.legend(loc="best", fontsize=7.5)
    return axes


def draw_scatter(table: SweepTable, x: Column, y: Column, ax: Any) -> Any:
    """Draw a column against another, with the nominal case."""
    from mjcont.drawing.plotting import COLORS, new_figure

    axes = new_figure()[1] if ax is None else ax
    size = 14.0 if len(table) < 300 else 5.0
    axes.scatter(scaled(x.values, x.unit), scaled(y.values, y.unit), s=size, color=COLORS[0], alpha=0.55, linewidths=0)
    at = [float(scaled(np.array(table.nominal[c.name]), c.unit)) for c in (x, y)]
    axes.plot(*at, "D", color=COLORS[1], markersize=6.0, markeredgecolor="white", linestyle="none", label="nominal")
    label_axes(axes, (x.name, x.unit), (y.name, y.unit))
    axes.legend(loc="best", fontsize=7.5)
    return axes


def draw_history(history: History, columns: Sequence[str]) -> Any:
    """Draw columns of a history against time, one below the other, and return the figure."""
    from mjcont.drawing.plotting import COLORS, new_figure

    shown = [(name, history.unit(name), scaled(history[name], history.unit(name))) for name in columns]
    figure, axes = new_figure(len(shown), 1, (5.2, 0.9 + 1.7 * len(shown)), sharex=True, squeeze=False)
    for i, (ax, (name, unit, values)) in enumerate(zip(axes[:, 0], shown, strict=True)):
        ax.plot(history["time"], values, color=COLORS[i % len(COLORS)])
        show_axis(ax.yaxis, name, unit)
    axes[-1, 0].set_xlabel("time [s]")
    figure.align_ylabels()
    return figure


def draw_stiffness(study: StiffnessStudy, ax: Any) -> Any:
    """Draw a special point's deviation from its limit against the stiffness of bushes, both logarithmic."""
    from mjcont.drawing.plotting import new_figure

    axes = new_figure()[1] if ax is None else ax
    axes.loglog(study.locus[study.parameter], np.maximum(study.deviation, 1e-16), color="black")
    axes.axhline(study.tol, color="0.6", linestyle="--", linewidth=0.8)
    if study.converged_from is not None:
        axes.axvline(study.converged_from, color="0.6", linestyle=":", linewidth=1.0)
    show_axis(axes.xaxis, study.parameter, study.locus.unit(study.parameter))
    axes.set_ylabel(f"relative deviation of {readable(study.quantity)} from its limit")
    return axes


def draw_steps(steps: Sequence[Mapping[str, float]], x: str, y: str, units: Mapping[str, str], ax: Any) -> Any:
    """Draw the way of a special point that was moved: y against x, its end marked."""
    from mjcont.drawing.plotting import COLORS, new_figure

    axes = new_figure()[1] if ax is None else ax
    xs, ys = (scaled(np.array([step[n] for step in steps]), units[n]) for n in (x, y))
    axes.plot(xs, ys, ".-", color=COLORS[0], label="_way")
    axes.plot(xs[-1:], ys[-1:], "o", color=COLORS[1], markersize=7.0, markeredgecolor="white", label="_end")
    label_axes(axes, (x, units[x]), (y, units[y]))
    return axes


def draw_equilibria(found: Equilibria, x: str, y: str, ax: Any) -> Any:
    """Draw equilibria by two of their columns, the stable ones filled, each with its label."""
    from mjcont.drawing.notes import LEGEND, place_labels, place_legend
    from mjcont.drawing.plotting import COLORS, mark, new_figure

    axes = new_figure()[1] if ax is None else ax
    units = {**unit_of(found.problem), "energy": "J"}
    xs, ys = (scaled(found.column(n), units[n]) for n in (x, y))
    for p, at, height in zip(found, xs, ys, strict=True):
        mark(axes, float(at), float(height), "EQ", p.label, hollow=p.stability != "stable")
    for word, face in (("stable", "black"), ("not stable", "white")):
        axes.plot([], [], "p", color="black", markerfacecolor=face, label=word)
    axes.margins(0.15)
    label_axes(axes, (x, units[x]), (y, units[y]))
    axes.legend(frameon=True, framealpha=0.85, edgecolor=COLORS[-1], fontsize=8.5).set_label(LEGEND)
    place_legend(axes, ax is None)
    place_labels(axes)
    return axes


def draw_certificate(found: Certificate, ax: Any) -> Any:
    """Draw growth rates of simulated motions beside real parts of the critical eigenvalues, by the first parameter."""
    from mjcont.drawing.plotting import COLORS, new_figure

    axes = new_figure()[1] if ax is None else ax
    (name, unit), *_ = found.units.items()
    at = scaled(np.array([c.parameters[name] for c in found]), unit)
    axes.plot(at, [c.eigenvalue.real for c in found], "o", markerfacecolor="none", color=COLORS[0], markersize=8.0,
              label="Re s of the critical eigenvalue")
    for k, verdict in enumerate(dict.fromkeys(c.verdict for c in found), 1):
        those = [i for i, c in enumerate(found) if c.verdict == verdict]
        axes.plot(at[those], [found.checks[i].rate for i in those], "x", color=COLORS[k], label=f"simulated: {verdict}")
    axes.axhline(0.0, color="#333333", linewidth=0.8)
    label_axes(axes, (name, unit), ("rate", "1/s"))
    axes.legend(loc="best", fontsize=7.5)
    return axes


def draw_changes(found: Design, ax: Any) -> Any:
    """Draw every parameter's change in its scale, with its old and new value, and return the axes."""
    from mjcont.drawing.plotting import COLORS, new_figure

    names = list(found.parameters)
    axes = new_figure(1, 1, (5.6, 0.9 + 0.42 * len(names)))[1] if ax is None else ax
    changes = np.array([(found.parameters[n] - found.before[n]) / found.scales[n] for n in names])
    axes.barh(range(len(names)), changes, color=[COLORS[0] if c >= 0 else COLORS[1] for c in changes], height=0.6)
    axes.axvline(0.0, color="#333333", linewidth=0.8)
    units = [found.problem.parameters[n].unit for n in names]
    old, new = ([show(v[n], u, 4) for n, u in zip(names, units, strict=True)] for v in (found.before, found.parameters))
    axes.set_yticks(range(len(names)), [f"{n}: {a} to {b}" for n, a, b in zip(names, old, new, strict=True)])
    axes.invert_yaxis()
    axes.margins(x=0.1)
    axes.set_xlabel("change, in the parameter's scale")
    return axes


def draw_controls(found: Hold, ax: Any) -> Any:
    """Draw the controls that hold a pose, as parts of the largest, and return the axes."""
    from mjcont.drawing.plotting import COLORS, new_figure

    names = list(found.controls)
    axes = new_figure(1, 1, (5.6, 0.9 + 0.42 * len(names)))[1] if ax is None else ax
    size = max((abs(v) for v in found.controls.values()), default=0.0) or 1.0
    axes.barh(range(len(names)), [v / size for v in found.controls.values()], color=COLORS[0], height=0.6)
    axes.axvline(0.0, color="#333333", linewidth=0.8)
    units = found.problem.parameters
    axes.set_yticks(range(len(names)), [f"{n}: {show(found.controls[n], units[n].unit, 4)}" for n in names])
    axes.invert_yaxis()
    axes.margins(x=0.1)
    axes.set_xlabel("control, of the largest")
    return axes
