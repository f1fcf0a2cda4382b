"""A free parameter: its bounds and the coordinate that stands for it among the unknowns."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array

_LOG_SPAN = 1e3


@dataclass(frozen=True, slots=True)
class Free:
    """A free parameter and its coordinate: linear, or logarithmic where positive bounds span three decades.

    `bounded` says whether it is kept within its bounds, or these only tell its size.
    """

    name: str
    low: float
    high: float
    unit: str = ""
    bounded: bool = True

    def show(self, value: float) -> str:
        """Return a value as a sentence shows it, radians in degrees."""
        return f"{math.degrees(value):.6g} deg" if self.unit == "rad" else f"{value:.6g} {self.unit}".rstrip()

    @property
    def log(self) -> bool:
        """Whether the coordinate is logarithmic."""
        return self.low > 0 and self.high / self.low >= _LOG_SPAN

    def coordinate(self, value: float) -> float:
        """Return the coordinate of a value."""
        if self.log:
            return math.log(value) / math.log(self.high / self.low)
        return value / (self.high - self.low)

    def value(self, coordinate: float) -> float:
        """Return the value at a coordinate."""
        if self.log:
            value = math.exp(min(coordinate * math.log(self.high / self.low), 700.0))
        else:
            value = coordinate * (self.high - self.low)
        return min(max(value, self.low), self.high) if self.bounded else value  # no bound is left by rounding

    def values(self, coordinates: Array) -> Array:
        """Return the values at many coordinates."""
        if self.log:
            values = np.exp(np.minimum(coordinates * math.log(self.high / self.low), 700.0))
        else:
            values = coordinates * (self.high - self.low)
        return values.clip(self.low, self.high) if self.bounded else values

    def slope(self, coordinate: float) -> float:
        """Return d value / d coordinate."""
        if self.log:
            return self.value(coordinate) * math.log(self.high / self.low)
        return self.high - self.low
