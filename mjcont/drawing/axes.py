"""Axes of diagrams: names as people write them, labels with units, and values as they are shown."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.outside.escapes import for_picture
from mjcont.results.units import check_wished, displayed, sized

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

_GREEK = dict(zip(
    ("alpha beta gamma delta epsilon zeta eta theta kappa lambda mu nu xi rho sigma tau phi chi psi omega "
     "Gamma Delta Theta Lambda Phi Psi Omega").split(), "αβγδεζηθκλμνξρστφχψωΓΔΘΛΦΨΩ", strict=True))
_WORD = re.compile(r"(?P<head>[A-Za-z][A-Za-z0-9]*)(?P<tail>(?:_[A-Za-z0-9]+)*)(?P<index>\[\d+\])?")


def readable(name: str) -> str:
    """Return a name as it stands in a picture: F_ret and theta_1 with subscripts, gravity_angle in words.

    What is no plain name, such as the path of a parameter, stays as it is.
    """
    plain = for_picture(name)
    parts = symbol(name)
    return plain if len(plain) != len(name) or parts == [(name, "", "")] else " ".join(_word(*p) for p in parts)


def symbol(name: str) -> list[tuple[str, str, str]]:
    """Return a name's parts, each with what stands below it and behind: F_ret is ("F", "ret", "").

    What is no plain name is one part.
    """
    found = [_WORD.fullmatch(part) for part in name.split(".")]
    return [_parts(**f.groupdict()) for f in found if f is not None] if all(found) else [(name, "", "")]


def _parts(head: str, tail: str, index: str | None) -> tuple[str, str, str]:
    letter = _GREEK.get(head, head if len(head) == 1 else "")
    behind = index or ""
    return (letter, tail[1:].replace("_", " "), behind) if letter else (head + tail.replace("_", " "), "", behind)


def _word(letter: str, below: str, behind: str) -> str:
    spaced = below.replace(" ", r"\,")
    return f"{letter}$_{{\\mathrm{{{spaced}}}}}${behind}" if below else f"{letter}{behind}"


def axis_label(name: str, unit: str, degrees: bool = True) -> str:
    """Return an axis label with its unit."""
    unit = "deg" if degrees and unit == "rad" else unit.replace("*", " ")
    return f"{readable(name)} [{for_picture(unit)}]" if unit not in ("", "1") else readable(name)


def scaled(values: Array, unit: str) -> Array:
    """Return values as they are shown: radians in degrees."""
    return np.degrees(values) if unit == "rad" else values


def label_axes(ax: Axes, x: tuple[str, str], y: tuple[str, str]) -> None:
    """Label both axes with a name and a unit each, whose numbers are drawn as `scaled` has them."""
    show_axis(ax.xaxis, *x)
    show_axis(ax.yaxis, *y)


def show_axis(axis: Axis, name: str, unit: str, wished: str | Sequence[str] = (), degrees: bool = True) -> None:
    """Label an axis, whose numbers are in `unit` (radians as degrees, if so asked), and show them in a unit wished for.

    Without a wish that fits, large forces are shown in kN or MN and short lengths in mm, unless the axis is
    logarithmic. When somebody changes the scale or the numbers, the label is that of the numbers drawn again; when
    somebody writes another label, the numbers are those drawn.

    Raises
    ------
    ParameterError
        If a unit is unknown.
    """
    wished = [wished] if isinstance(wished, str) else wished
    check_wished(wished)
    drawn, shown = displayed(unit, (), degrees), displayed(unit, wished, degrees)
    if shown == drawn and axis.get_scale() == "linear":
        larger, size = sized(drawn[0], float(np.abs(axis.get_view_interval()).max()))
        shown = larger, drawn[1] * size
    label, plain = (axis_label(name, u, False) for u in (shown[0], drawn[0]))
    axis.set_label_text(label)
    which: str = axis.axis_name  # type: ignore[attr-defined]
    for old in [a for a in axis.axes.artists if a.get_label() == f"_unit of {which}"]:
        old.remove()
    if shown != drawn:
        _show_times(axis, which, shown[1] / drawn[1], label)
        _keep(axis, which, label, plain)


def _keep(axis: Axis, which: str, label: str, plain: str) -> None:
    """Take a label back where its numbers have been taken back, by a logarithmic scale or other ticks."""
    from matplotlib.artist import Artist

    formatter = axis.get_major_formatter()

    class Keeper(Artist):
        """Draws nothing, before anything else is drawn."""

        zorder = -1e6

        def draw(self, renderer: Any) -> None:
            if axis.get_major_formatter() is not formatter and axis.get_label_text() == label:
                axis.set_label_text(plain)

    keeper = Keeper()
    keeper.set_label(f"_unit of {which}")
    keeper.set_in_layout(False)
    axis.axes.add_artist(keeper)


def _show_times(axis: Axis, which: str, factor: float, label: str) -> None:
    """Show the numbers of an axis times a factor, as long as it, or one that it shares its scale with, has a label."""
    from matplotlib.ticker import AutoLocator, FuncFormatter

    def size() -> float:
        together = getattr(axis.axes, f"get_shared_{which}_axes")().get_siblings(axis.axes)
        labels = {getattr(a, f"{which}axis").get_label_text() for a in together}
        return factor if label in labels else 1.0

    class Round(AutoLocator):
        """Ticks at numbers that are round in the unit shown."""

        def tick_values(self, vmin: float, vmax: float) -> list[float]:
            k = size()
            return [float(v) / k for v in super().tick_values(vmin * k, vmax * k)]

    axis.set_major_locator(Round())
    axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v * size():.6g}".replace("-", "\N{MINUS SIGN}")))


def spread_ticks(ax: Axes) -> None:
    """Take fewer ticks where numbers below the axes would touch; axes must have their final size."""
    from matplotlib.ticker import MaxNLocator

    locator = ax.xaxis.get_major_locator()
    if not isinstance(locator, MaxNLocator):
        return
    for most in range(len(ax.get_xticks()), 1, -1):
        low, high = sorted(ax.get_xlim())
        boxes = [t.label1.get_window_extent() for t in ax.xaxis.get_major_ticks() if low <= t.get_loc() <= high]
        boxes = sorted((b for b in boxes if b.width > 0.0), key=lambda b: b.x0)
        if all(a.x1 + 0.4 * a.height < b.x0 for a, b in pairwise(boxes)):
            return
        locator.set_params(nbins=most - 1)
