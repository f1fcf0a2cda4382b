"""What long work tells a terminal while it goes, in one line: what it does, how far, how long still.

A thread writes the line, so that it goes on also where the work says nothing for a while. In a pipe there is none.
"""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, TextIO

from mjcont.outside.terminal import Live, live_stream
from mjcont.results.points import show
from mjcont.studies.reporter import Range, Reporter

if TYPE_CHECKING:
    from mjcont.curves.collect import Found

_REDRAW_SECONDS = 0.2
# what is over sooner says nothing, and nobody guesses from less
_QUIET_SECONDS, _GUESS_SECONDS = 1.0, 2.0


def spoken(seconds: float) -> str:
    """Return a time as people say it."""
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 100 else f"{minutes // 60} h {minutes % 60} min"


def time_left(share: float, seconds: float, before: float = 0.0) -> str:
    """Return how long the rest may take, as a clause; empty where nobody knows.

    `share` of the work is done, of which `before` was there already, the rest of it in `seconds`.
    """
    done = share - before
    if seconds < _GUESS_SECONDS or not 0.0 < done or not share < 1.0:
        return ""
    return f", about {spoken(seconds * (1.0 - share) / done)} left"


class Gauge:
    """The line on a terminal; a context manager, and silent without a terminal.

    Parameters
    ----------
    stream : text stream, optional
    clock : callable
        The time in s.
    """

    def __init__(self, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        self._live = Live(stream) if stream is not None else None
        self._clock = clock
        self._began = clock()
        self._over = threading.Event()
        self._writing = threading.Lock()
        self._thread: threading.Thread | None = None
        self._what, self._details, self._share, self._before = "", "", math.nan, math.nan

    def __enter__(self) -> Gauge:
        """Begin to write."""
        if self._live is not None:
            self._thread = threading.Thread(target=self._write, daemon=True)
            self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Wipe the line and write no more."""
        self._over.set()
        self.end()
        if self._thread is not None:
            self._thread.join()

    def begin(self, what: str) -> None:
        """Begin with another piece of work."""
        self._began, self._before, self._share = self._clock(), math.nan, math.nan
        self._what, self._details = what, ""

    def tell(self, details: str, share: float = math.nan) -> None:
        """Say how far it is: in words, and which share is done where that is known."""
        if math.isnan(self._before):
            self._before = share
        self._details, self._share = details, share

    def count(self, done: float, total: float, noun: str = "", more: str = "") -> None:
        """Say how many of all are done."""
        self.tell(f"{done:g} of {total:g}{noun}{more}", done / total if total else math.nan)

    def end(self) -> None:
        """Wipe the line: that piece of work is over."""
        with self.aside():
            self._what = ""

    @contextmanager
    def aside(self) -> Iterator[None]:
        """Wipe the line, for others to write; it comes back."""
        with self._writing:
            if self._live is not None:
                self._live.show()
            yield

    def line(self) -> str:
        """Return what the line says now; empty at the beginning."""
        seconds = self._clock() - self._began
        if not self._what or seconds < _QUIET_SECONDS:
            return ""
        details = f"{self._details}, " if self._details else ""
        return f"{self._what}: {details}{spoken(seconds)}{time_left(self._share, seconds, self._before)}"

    def _write(self) -> None:
        while not self._over.wait(_REDRAW_SECONDS):
            with self._writing:
                text = self.line()
                if text and self._live is not None:
                    self._live.show(text)


@contextmanager
def gauge(what: str = "", *, quiet: bool = False) -> Iterator[Gauge]:
    """Show how work goes on the terminal, if there is one and `quiet` is false."""
    with Gauge(None if quiet else live_stream()) as shown:
        if what:
            shown.begin(what)
        yield shown


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
        self._ranges: Mapping[str, Range] = {}
        self._reached: dict[str, tuple[float, float]] = {}
        self._found: Counter[str] = Counter()
        self.results: list[tuple[Any, Sequence[Path]]] = []
        self.plots: list[Path] = []

    def started(self, name: str, task: str, place: tuple[int, int], ranges: Mapping[str, Range]) -> None:
        """Print what is going to be computed."""
        self._ranges, self._reached, self._found = ranges, {}, Counter()
        self._say(f"{name}: {task}")
        number, count = place
        self._shown.begin(f"{name} (result {number} of {count})" if count > 1 else name)

    def point(self, count: int, found: Found) -> None:
        """Show the number of points, where the curve is, and what was found on it."""
        self._found[found.kind] += bool(found.kind)
        words = [f"{count} points"]
        shares = [self._swept(name, value) for name, value in found.parameters.items() if name in self._ranges]
        words += [f"{name} = {show(value, self._ranges[name].unit, 4)}"
                  for name, value in found.parameters.items() if name in self._ranges]
        words += [f"{number} {kind}" for kind, number in self._found.items() if kind and number]
        self._shown.tell(", ".join(words), max(shares, default=math.nan))

    def _swept(self, name: str, value: float) -> float:
        """Return which share of a parameter's range a curve has been through: a guess of how far it is."""
        low, high = self._reached.get(name, (value, value))
        self._reached[name] = low, high = min(low, value), max(high, value)
        span = self._ranges[name]
        return (high - low) / (span.high - span.low)

    def step(self, done: float, total: float) -> None:
        """Show how much of a known amount is done."""
        if total:
            self._shown.tell(f"{done:g} of {total:g}" if done == int(done) else f"{100.0 * done / total:.0f} %",
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
