"""Who hears how the run of a study goes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mjcont.curves.collect import Found


@dataclass(frozen=True, slots=True)
class Range:
    """Where a parameter goes while a curve is followed: from, to, and its unit."""

    low: float
    high: float
    unit: str


class Swept:
    """Which share of its range the parameter of a curve has been through: a guess of how far the curve is."""

    def __init__(self, ranges: Mapping[str, Range]) -> None:
        self.ranges = ranges
        self._reached: dict[str, tuple[float, float]] = {}

    def share(self, parameters: Mapping[str, float]) -> float:
        """Return the share once a point is reached, NaN where nobody knows."""
        shares = [self._share(name, value) for name, value in parameters.items() if name in self.ranges]
        return max(shares, default=math.nan)

    def _share(self, name: str, value: float) -> float:
        low, high = self._reached.get(name, (value, value))
        self._reached[name] = low, high = min(low, value), max(high, value)
        span = self.ranges[name]
        return (high - low) / (span.high - span.low)


class Reporter:
    """Hears what a run does, and keeps quiet; the base of those that tell."""

    def started(self, name: str, task: str, place: tuple[int, int], ranges: Mapping[str, Range]) -> None:
        """Hear that a result is begun, the how manieth of how many, and between which bounds its curve will run."""

    def point(self, count: int, found: Found) -> None:
        """Hear that a curve has `count` points, and of the latest; its kind is empty unless it is special."""

    def step(self, done: float, total: float) -> None:
        """Hear that so much of a known amount is done."""

    def finished(self, result: Any, files: Sequence[Path]) -> None:
        """Hear that a result is done and stored in `files`."""

    def plotted(self, file: Path) -> None:
        """Hear that a plot is stored."""

    def stopped(self) -> None:
        """Hear that a result has ended, well or not."""
