"""Who hears how the run of a study goes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mjcont.curves.collect import Found


class Reporter:
    """Hears what a run does, and keeps quiet; the base of those that tell."""

    def started(self, name: str, task: str, columns: Sequence[tuple[str, str]]) -> None:
        """Hear that a branch is started; `columns` are names and units worth showing."""

    def point(self, count: int, special: Found | None) -> None:
        """Hear that there are `count` points, the latest of them special where `special` is given."""

    def finished(self, result: Any, files: Sequence[Path]) -> None:
        """Hear that a result is done and stored in `files`."""

    def plotted(self, file: Path) -> None:
        """Hear that a plot is stored."""

    def stopped(self) -> None:
        """Hear that a branch has ended, well or not."""
