"""Who hears how a computation goes, tells a page of it, and stops it when the page asks, between two points."""

from __future__ import annotations

import math
import threading
import time
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from mjcont.curves.collect import Found
from mjcont.mechanism.mechanism import Mechanism
from mjcont.numerics.equations.problem import Array, Values
from mjcont.studies.reporter import Range, Reporter, Swept

Event = dict[str, Any]
Tell = Callable[[Event], None]
# between two messages, and after which a computation is stopped though nobody asks
_EVERY, _LONGEST = 0.12, 600.0


class Hearing(Reporter):
    """Tells how a computation goes, with the points so far, and stops it.

    Parameters
    ----------
    mechanism : whose observables the points are told with.
    tell : called with each event, a dict.
    stop : set from another thread to stop; looked at whenever a point is reached, so that points so far are kept.
    between : called now and then, in the computation's own thread.
    """

    def __init__(
        self, mechanism: Mechanism, tell: Tell, stop: threading.Event, between: Callable[[], None] = lambda: None
    ) -> None:
        self._mechanism, self._tell, self._stop, self._between = mechanism, tell, stop, between
        self._name = self._task = ""
        self._begun = self._told = time.monotonic()
        self._swept = Swept({})
        self._found: Counter[str] = Counter()
        self._points = _Points(mechanism)

    def started(self, name: str, task: str, place: tuple[int, int], ranges: Mapping[str, Range]) -> None:
        """Begin with a result."""
        self._name, self._task = name, task
        self._begun = self._told = time.monotonic()
        self._swept, self._found, self._points = Swept(ranges), Counter(), _Points(self._mechanism)
        self._send(0, math.nan)

    def point(self, count: int, found: Found) -> None:
        """Hear of a point."""
        self._found[found.kind] += bool(found.kind)
        self._points.add(found)
        share = self._swept.share(found.parameters)
        if self._due():
            self._send(count, share)
            columns = self._points.columns()
            if columns:
                self._tell({"event": "curve", "partial": True, "curve": {"id": self._name, "columns": columns}})

    def step(self, done: float, total: float) -> None:
        """Hear of a share of a known amount."""
        if self._due():
            self._send(done, done / total if total else math.nan)

    def _due(self) -> bool:
        """Whether there is time to tell something; raises KeyboardInterrupt where the computation is to end."""
        now = time.monotonic()
        if self._stop.is_set() or now - self._begun > _LONGEST:
            raise KeyboardInterrupt
        if now - self._told < _EVERY:
            return False
        self._between()
        self._told = time.monotonic()
        return True

    def _send(self, done: float, share: float) -> None:
        self._tell({
            "event": "progress", "name": self._name, "what": self._task, "done": done,
            "share": share if math.isfinite(share) else None, "seconds": round(time.monotonic() - self._begun, 2),
            "found": {kind: n for kind, n in self._found.items() if n},
        })


class _Points:
    """The points of a curve so far, with their observables, which are read many at a time."""

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism = mechanism
        self._open: list[tuple[Array, Values]] = []
        self._names: tuple[str, ...] = ()
        self._free: list[list[float]] = []
        self._read: list[Array] = []

    def add(self, found: Found) -> None:
        """Add a point that has a state."""
        if found.state is None:
            return
        self._names = ("direction", *found.parameters)
        self._open.append((found.state.copy(), found.values))
        self._free.append([float(found.direction), *found.parameters.values()])

    def columns(self) -> dict[str, Array]:
        """Return the columns so far: parameters, observables, and "direction", the number of directions before."""
        if not self._free:
            return {}
        if self._open:
            states = np.array([x for x, _ in self._open])
            self._read.append(self._mechanism.measure(states, [dict(v) for _, v in self._open]))
            self._open = []
        found = dict(zip(self._names, np.array(self._free).T, strict=True))
        measured = dict(zip(self._mechanism.observables, np.concatenate(self._read).T, strict=True))
        return {**measured, **found}
