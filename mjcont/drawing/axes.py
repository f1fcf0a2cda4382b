"""Axes of diagrams: labels with units, and values as they are shown."""

from __future__ import annotations

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.outside.escapes import for_picture


def axis_label(name: str, unit: str, degrees: bool = True) -> str:
    """Return an axis label with its unit."""
    unit = "deg" if degrees and unit == "rad" else unit.replace("*", " ")
    shown = for_picture(name)
    return f"{shown} [{for_picture(unit)}]" if unit not in ("", "1") else shown


def scaled(values: Array, unit: str) -> Array:
    """Return values as they are shown: radians in degrees."""
    return np.degrees(values) if unit == "rad" else values
