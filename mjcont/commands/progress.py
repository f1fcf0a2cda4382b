"""What a run tells while it goes: a table with a line for each special point, and on a terminal a live count."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from mjcont.outside.terminal import Live
from mjcont.studies.reporter import Reporter

if TYPE_CHECKING:
    from mjcont.curves.collect import Found

_REDRAW_SECONDS = 0.1


class Table(Reporter):
    """Prints AUTO's kind of table: one line for each special point as it is found, then the branch's summary.

    Parameters
    ----------
    say : callable
        Prints one line.
    live : text stream, optional
        A terminal whose last line shows the number of points so far.
    """

    def __init__(self, say: Callable[[str], None], live: TextIO | None = None) -> None:
        self._say = say
        self._live = Live(live) if live is not None else None
        self._columns: Sequence[tuple[str, str]] = ()
        self._name = ""
        self._headed = False
        self._began = self._drawn = 0.0

    def started(self, name: str, task: str, columns: Sequence[tuple[str, str]]) -> None:
        """Print what is going to be computed."""
        self._name, self._columns, self._headed = name, columns, False
        self._began, self._drawn = time.monotonic(), 0.0
        self._say(f"{name}: {task}")

    def point(self, count: int, special: Found | None) -> None:
        """Print a line for a special point; rewrite the live count ten times a second."""
        if special is not None:
            self.stopped()
            if not self._headed:
                self._headed = True
                self._say("  kind  points  " + "  ".join(h.rjust(_width(h)) for h in self._headings()))
            self._say(f"  {special.kind:<4}  {count:>6}  " + "  ".join(self._cells(special)))
        now = time.monotonic()
        if self._live is not None and (special is not None or now - self._drawn >= _REDRAW_SECONDS):
            self._drawn = now
            self._live.show(f"{self._name}: {count} points, {now - self._began:.0f} s")

    def finished(self, result: Any, files: Sequence[Path]) -> None:
        """Print the result's summary and where it is stored."""
        self.stopped()
        self._say(str(result))
        self._say("  written: " + (", ".join(str(f) for f in files) or "nothing") + "\n")

    def plotted(self, file: Path) -> None:
        """Print where the plot is."""
        self._say(f"plot: {file}")

    def stopped(self) -> None:
        """Wipe the live count."""
        if self._live is not None:
            self._live.show()

    def _headings(self) -> list[str]:
        return [f"{n} [{'deg' if u == 'rad' else u}]" if u not in ("", "1") else n for n, u in self._columns]

    def _cells(self, special: Found) -> list[str]:
        values = {**special.observables, **special.parameters}
        cells = []
        for (name, unit), heading in zip(self._columns, self._headings(), strict=True):
            value = values.get(name, math.nan)
            cells.append(f"{math.degrees(value) if unit == 'rad' else value:.7g}".rjust(_width(heading)))
        return cells


def _width(heading: str) -> int:
    return max(13, len(heading))
