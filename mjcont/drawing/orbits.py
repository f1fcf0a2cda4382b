"""Phase portraits: orbits drawn as closed lines, one observable against another or against its own rate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.arguments import checked
from mjcont.drawing.axes import axis_label, show_axis
from mjcont.drawing.plotting import COLORS, LINE_STYLES, new_figure
from mjcont.errors import MjcontError, ParameterError
from mjcont.numerics.equations.problem import Array
from mjcont.results.orbits import CycleBranch, Orbit, orbit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TIME = "time"
# places at which each interval of a mesh is drawn
_FINE = 16
_TEXT = 9.0


@checked
def plot_orbits(
    *orbits: Any,
    x: str,
    y: str | None = None,
    n: int = 12,
    ax: Axes | None = None,
    degrees: bool = True,
    colors: Sequence[str] | None = None,
) -> Axes:
    """Draw orbits in a plane: solid, or dashed where they are points of curves on which they are not stable.

    Parameters
    ----------
    *orbits : Orbit, a point of a curve of orbits, or CycleBranch
        Of a curve `n` orbits are drawn, evenly spread over its rows and coloured by its parameter.
    x, y : str
        Observables, or "time"; without `y` the rate of `x`.
    n : number of orbits of a curve.
    ax : matplotlib Axes, optional
        Where to draw; default a new figure.
    degrees : whether angles are drawn in degrees.
    colors : sequence of matplotlib colours, optional
        One an orbit, repeated if there are fewer.

    Raises
    ------
    MjcontError, NameLookupError, ParameterError
        If there is no orbit, no such observable, or n is no positive number.
    """
    if not orbits:
        raise MjcontError("plot_orbits needs at least one orbit, or a curve of orbits")
    if isinstance(n, bool) or not isinstance(n, int) or n < 1:
        raise ParameterError(f"n must be a whole number, 1 or more, got {n!r}")
    given: list[tuple[Orbit, str, Any]] = []
    scales: list[tuple[CycleBranch, Any]] = []
    for item in orbits:
        if isinstance(item, CycleBranch):
            given += _of_curve(item, n, colors is None, scales)
        else:
            given.append((orbit_of(item), str(getattr(item, "stability", "stable")), None))
    # everything is read before anything is drawn
    lines = [_line(orbit, x, y, degrees) for orbit, _, _ in given]
    if ax is None:
        _, ax = new_figure()
    palette = colors or COLORS
    for i, ((_, word, color), (xs, ys)) in enumerate(zip(given, lines, strict=True)):
        ax.plot(xs, ys, color=color if color is not None else palette[i % len(palette)], label="_orbit",
                linestyle=LINE_STYLES[word], linewidth=1.4)
    for branch, scale in scales:
        name = next(iter(branch.free))
        figure: Any = ax.figure
        bar = figure.colorbar(scale, ax=ax)
        bar.set_label(axis_label(name, branch.unit(name), degrees), fontsize=_TEXT)
        bar.ax.tick_params(labelsize=_TEXT)
    first = given[0][0]
    _label(ax, first, x, y, degrees)
    return ax


def _of_curve(branch: CycleBranch, n: int, colored: bool, scales: list[tuple[CycleBranch, Any]]) -> list[Any]:
    """Return orbits of a curve, evenly spread, with their stability and colour; note the colours' scale."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    name = next(iter(branch.free))
    values = branch[name]
    low, high = float(values.min()), float(values.max())
    turned = np.degrees if branch.unit(name) == "rad" else float
    scale = ScalarMappable(Normalize(float(turned(low)), float(turned(high))), colormaps["viridis"])
    if colored and high > low:
        scales.append((branch, scale))
    rows = sorted({round(i) for i in np.linspace(0, len(branch) - 1, min(n, len(branch)))})
    color = scale.to_rgba(np.array([turned(values[i]) for i in rows])) if colored else [None] * len(rows)
    return [(branch.orbits[i], str(branch.stability[i]), c) for i, c in zip(rows, color, strict=True)]


def _line(orbit: Orbit, x: str, y: str | None, degrees: bool) -> tuple[Array, Array]:
    mesh = orbit.path.mesh
    inside = np.linspace(0.0, 1.0, _FINE, endpoint=False)
    tau = np.append((mesh[:-1, None] + np.diff(mesh)[:, None] * inside).ravel(), 1.0)
    times = tau * orbit.period
    xs = _values(orbit, x, times, degrees)
    if y is not None:
        return xs, _values(orbit, y, times, degrees)
    if x == TIME:
        raise MjcontError("name an observable to draw against time: y=...")
    rate = orbit.rate(x, times)
    return xs, np.degrees(rate) if degrees and orbit.unit(x) == "rad" else rate


def _values(orbit: Orbit, name: str, times: Array, degrees: bool) -> Array:
    if name == TIME:
        return times
    values = orbit.read(name, times)
    return np.degrees(values) if degrees and orbit.unit(name) == "rad" else values


def _label(ax: Axes, orbit: Orbit, x: str, y: str | None, degrees: bool) -> None:
    show_axis(ax.xaxis, x, _unit(orbit, x), (), degrees)
    if y is not None:
        show_axis(ax.yaxis, y, _unit(orbit, y), (), degrees)
    else:
        ax.set_ylabel(f"rate of {axis_label(x, _per_second(orbit.unit(x), degrees), degrees)}")


def _unit(orbit: Orbit, name: str) -> str:
    return "s" if name == TIME else orbit.unit(name)


def _per_second(unit: str, degrees: bool) -> str:
    unit = "deg" if degrees and unit == "rad" else unit
    return f"{unit}/s" if unit not in ("", "1") else "1/s"
