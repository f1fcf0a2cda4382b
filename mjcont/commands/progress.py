"""What long work tells a terminal while it goes, in one line: what it does, how far, how long still.

A thread writes the line, so that it goes on also where the work says nothing for a while. In a pipe there is none.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import TextIO

from mjcont.outside.terminal import Live, live_stream

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
        self._began = self._since = clock()
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
        self._began = self._since = self._clock()
        self._before = self._share = math.nan
        self._what, self._details = what, ""

    def tell(self, details: str, share: float = math.nan) -> None:
        """Say how far it is: in words, and which share is done where that is known."""
        now = self._clock()
        if math.isnan(self._before) and now - self._began >= _GUESS_SECONDS:  # it was done since the beginning
            self._before, self._since = 0.0, self._began
        elif math.isnan(self._before) or share < self._share:  # it was there, or is a share of other work
            self._before, self._since = share, now
        self._details, self._share = details, share

    def count(self, done: float, total: float, noun: str = "", more: str = "") -> None:
        """Say how many of all are done."""
        self.tell(f"{done:.12g} of {total:.12g}{noun}{more}", done / total if total else math.nan)

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
        left = time_left(self._share, self._clock() - self._since, self._before)
        return f"{self._what}: {details}{spoken(seconds)}{left}"

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
