"""Axes of diagrams: labels with units, and values as they are shown."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.outside.escapes import for_picture
from mjcont.results.units import check_wished, displayed

if TYPE_CHECKING:
    from matplotlib.axis import Axis


def axis_label(name: str, unit: str, degrees: bool = True) -> str:
    """Return an axis label with its unit."""
    unit = "deg" if degrees and unit == "rad" else unit.replace("*", " ")
    shown = for_picture(name)
    return f"{shown} [{for_picture(unit)}]" if unit not in ("", "1") else shown


def scaled(values: Array, unit: str) -> Array:
    """Return values as they are shown: radians in degrees."""
    return np.degrees(values) if unit == "rad" else values


def show_axis(axis: Axis, name: str, unit: str, wished: str | Sequence[str] = (), degrees: bool = True) -> None:
    """Label an axis, whose numbers are in `unit` (radians as degrees, if so asked), and show them in a unit wished for.

    Raises
    ------
    ParameterError
        If a unit is unknown.
    """
    wished = [wished] if isinstance(wished, str) else wished
    check_wished(wished)
    drawn = displayed(unit, (), degrees)
    shown = displayed(unit, wished, degrees)
    axis.set_label_text(axis_label(name, shown[0], False))
    if shown != drawn:
        from matplotlib.ticker import AutoLocator, FuncFormatter

        factor = shown[1] / drawn[1]

        class Round(AutoLocator):
            """Ticks at numbers that are round in the unit shown."""

            def tick_values(self, vmin: float, vmax: float) -> list[float]:
                return [float(v) / factor for v in super().tick_values(vmin * factor, vmax * factor)]

        axis.set_major_locator(Round())
        axis.set_major_formatter(FuncFormatter(lambda v, _: f"{v * factor:.6g}".replace("-", "\N{MINUS SIGN}")))
