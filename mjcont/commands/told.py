"""What the run of a study tells: on a terminal how each result goes, and summaries as they are done."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from mjcont.commands.progress import Gauge
from mjcont.curves.collect import Found
from mjcont.results.points import show
from mjcont.studies.reporter import Range, Reporter, Swept


class Told(Reporter):
    """Tells how a study goes: on a terminal each result as it comes, and summaries as they are done.

    Parameters
    ----------
    shown : Gauge
    say : callable, optional
        Prints lines; default nothing is printed.

    Attributes
    ----------
    results, plots : what there is so far, results with their files.
    """

    def __init__(self, shown: Gauge, say: Callable[[str], None] | None = None) -> None:
        self._shown, self._say = shown, say or (lambda text: None)
        self._swept = Swept({})
        self._found: Counter[str] = Counter()
        self.results: list[tuple[Any, Sequence[Path]]] = []
        self.plots: list[Path] = []

    def started(self, name: str, task: str, place: tuple[int, int], ranges: Mapping[str, Range]) -> None:
        """Print what is going to be computed."""
        self._swept, self._found = Swept(ranges), Counter()
        self._say(f"{name}: {task}")
        number, count = place
        self._shown.begin(f"{name} (result {number} of {count})" if count > 1 else name)

    def point(self, count: int, found: Found) -> None:
        """Show the number of points, where the curve is, and what was found on it."""
        self._found[found.kind] += bool(found.kind)
        words, ranges = [f"{count} points"], self._swept.ranges
        words += [f"{name} = {show(value, ranges[name].unit, 4)}"
                  for name, value in found.parameters.items() if name in ranges]
        words += [f"{number} {kind}" for kind, number in self._found.items() if kind and number]
        self._shown.tell(", ".join(words), self._swept.share(found.parameters))

    def step(self, done: float, total: float) -> None:
        """Show how much of a known amount is done."""
        if total:
            self._shown.tell(f"{done:.12g} of {total:.12g}" if done == int(done) else f"{100.0 * done / total:.0f} %",
                             done / total)

    def finished(self, result: Any, files: Sequence[Path]) -> None:
        """Print the result's summary and where it is stored."""
        self.stopped()
        self.results.append((result, files))
        self._say(str(result))
        self._say("  written: " + (", ".join(str(f) for f in files) or "nothing") + "\n")

    def plotted(self, file: Path) -> None:
        """Print where the plot is."""
        self.plots.append(file)
        self._say(f"plot: {file}")

    def stopped(self) -> None:
        """Wipe the line."""
        self._shown.end()
