"""The driver: follows a curve in one direction, or both, and yields points and special points as they come."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np

from mjcont.numerics.arclength import CurvePoint, advance, by_contraction, land, may_turn_twice, next_step
from mjcont.numerics.corner import NEAR, cross
from mjcont.numerics.events import Detector, Located, Retry
from mjcont.numerics.problem import Array
from mjcont.numerics.settings import Settings
from mjcont.numerics.system import System

# below this step a pair of folds is not looked for between two points
_SMALL_FOLDS = 1e-5
# a curve that ends on the bound where it is already adds no second point there
_SAME_POINT = 1e-9
_SAME_LOCATED = 1e-7


class Status(Enum):
    """Why a curve ends."""

    AT_BOUND = "at bound"
    CLOSED = "closed"
    STEP_TOO_SMALL = "step too small"
    MAX_POINTS = "max points"
    MAX_ARCLENGTH = "max arclength"
    MAX_TIME = "max time"
    RUNS_OFF = "runs off"
    STOPPED = "stopped"
    AT_SPECIAL_POINT = "at special point"
    INTERRUPTED = "interrupted"
    NO_START = "no start"


@dataclass(frozen=True, slots=True)
class End:
    """The end of a curve: a status and a sentence."""

    status: Status
    message: str


@dataclass(slots=True)
class Trace:
    """One direction of a curve: its points from the start on, special points, and how it ended."""

    points: list[CurvePoint] = field(default_factory=list)
    special: list[Located] = field(default_factory=list)
    end: End = field(default_factory=lambda: End(Status.STOPPED, "not started"))


Stop = Callable[[CurvePoint], str | None]


@dataclass(slots=True)
class Walker:
    """What a walk along a curve needs.

    Attributes
    ----------
    detectors : in the order in which they look at a step; the first may ask for a shorter one.
    stop : returns a sentence to end the curve at a point (limits on observables, a user's callback).
    end_at : kinds of special points that end the curve.
    """

    system: System
    settings: Settings
    detectors: Sequence[Detector] = ()
    stop: Stop | None = None
    end_at: frozenset[str] = frozenset()
    _fresh: bool = field(default=False, init=False)

    def walk(self, start: CurvePoint) -> Iterator[CurvePoint | Located | End]:
        """Yield the curve's points after `start`, special points before the point that follows them, and the end."""
        settings, began = self.settings, time.monotonic()
        point, h, count = start, settings.ds, 1
        for detector in self.detectors:
            detector.changed(point, point)
        last: dict[str, Located] = {}
        periods = self._periods(start)
        largest = settings.max_size * max(1.0, self._size(start))
        while True:
            limit = self._limit(point, count, began)
            if limit is None and self._size(point) > largest:
                limit = End(Status.RUNS_OFF, f"a state coordinate exceeds {largest:g} times its scale (max_size)")
            if limit is not None:
                yield limit
                return
            step = self._step(point, h)
            if isinstance(step, End):
                yield step
                return
            new, h, located, ending = step
            located = [e for e in located if not self._known(e, last)]
            for special in located:
                last[special.kind] = special
                yield special
                if special.kind in self.end_at:
                    yield End(Status.AT_SPECIAL_POINT, f"the curve was to end at a point of kind {special.kind}")
                    return
            if ending is None:
                turns = self._passes(start, point, new, periods)
                if turns is not None:
                    yield End(Status.CLOSED, "the curve closes on itself" + (", full turns apart" if turns else ""))
                    return
            if ending is None or new.s - point.s > _SAME_POINT:
                yield new
            if ending is not None:
                yield ending
                return
            self.system.update(new.local, new.y)
            point, count = new, count + 1

    def _size(self, point: CurvePoint) -> float:
        n = self.system.n  # positions of a free body carry a quaternion beside n coordinates: measure those alone
        return float(np.max(np.abs(point.x[:n]) / self.system.problem.state_scale))

    def _known(self, special: Located, last: dict[str, Located]) -> bool:
        """Whether a point was located just before: on both sides of a step's end, or twice in a flat stretch."""
        if special.kind not in last or special.data.get("monitor") != last[special.kind].data.get("monitor"):
            return False
        p, q = special.point, last[special.kind].point
        return float(np.linalg.norm(self.system.difference(p.x, p.y, q.x, q.y))) < _SAME_LOCATED

    def _limit(self, point: CurvePoint, count: int, began: float) -> End | None:
        settings = self.settings
        if count >= settings.max_points:
            return End(Status.MAX_POINTS, f"the limit of {settings.max_points} points was reached")
        if point.s >= settings.max_arclength:
            return End(Status.MAX_ARCLENGTH, f"the limit of {settings.max_arclength:g} in arclength was reached")
        if time.monotonic() - began > settings.max_seconds:
            return End(Status.MAX_TIME, f"the limit of {settings.max_seconds:g} s was reached")
        message = self.stop(point) if self.stop is not None else None
        return End(Status.STOPPED, message) if message else None

    def _step(self, point: CurvePoint, h: float) -> tuple[CurvePoint, float, list[Located], End | None] | End:
        """Return the next point, the step after it, what lies between, and the end if a bound is met."""
        while True:
            new = advance(self.system, point, h, self.settings, fresh=self._fresh)
            reason = new if isinstance(new, str) else ""
            ending = None
            if not isinstance(new, str):
                outside = self._outside(new)
                if outside is not None:
                    landed = land(self.system, point, *outside[:2], self.settings)
                    if isinstance(landed, str):
                        reason = landed
                    elif landed.s - point.s > 3.0 * h or landed.angle > self.settings.angle_max:
                        reason = "the bound was not met along the curve"
                    else:
                        new, ending = landed, End(Status.AT_BOUND, outside[2])
            if not reason and not isinstance(new, str):
                if not self.system.conditions and h > _SMALL_FOLDS and may_turn_twice(self.system, point, new, 0):
                    h *= 0.4
                    continue
                try:
                    located = self._between(point, new)
                except Retry as retry:
                    reason = str(retry)
                else:
                    self._fresh |= new.iterations > 4 and by_contraction(new) < 1.0
                    return new, next_step(h, new, self.settings), located, ending
            if h < NEAR and not self.system.conditions:
                crossed = cross(self.system, point, self.settings)
                if crossed is not None:
                    return crossed[0], self.settings.ds, [crossed[1]], None
            if self._fresh or not isinstance(new, str):
                h *= 0.4
            self._fresh |= isinstance(new, str)
            if h < self.settings.ds_min:
                return End(Status.STEP_TOO_SMALL, f"step below ds_min at {self._where(point)}: {reason}")

    def _outside(self, new: CurvePoint) -> tuple[int, float, str] | None:
        for i, p in enumerate(self.system.free):
            value = p.value(float(new.y[i]))
            for bound, beyond in ((p.low, value < p.low), (p.high, value > p.high)):
                if beyond:
                    return i, p.coordinate(bound), f"{p.name} reached its bound {p.show(bound)}"
        return None

    def _between(self, old: CurvePoint, new: CurvePoint) -> list[Located]:
        located: list[Located] = []
        for detector in self.detectors:
            if detector.changed(old, new):
                located += detector.locate(old, new, located)
        located = _distinct(located)
        return sorted(located, key=lambda e: e.point.s)

    def _periods(self, start: CurvePoint) -> Array:
        """Return the periods of the scaled state coordinates, infinite where a coordinate has none, (n,)."""
        problem: Any = self.system.problem
        if self.system.conditions or not hasattr(problem, "periods"):
            return np.full(self.system.n, np.inf)
        return problem.periods(start.x, self.system.values(start.y)) / problem.state_scale

    def _passes(self, start: CurvePoint, old: CurvePoint, new: CurvePoint, periods: Array) -> bool | None:
        """Return whether the step from old to new passes the start a full turn away; None if it does not pass it."""
        if old.s < 2.0 * (new.s - old.s) or start.tangent @ new.tangent < math.cos(2.0 * self.settings.angle_max):
            return None
        chord = self.system.difference(new.x, new.y, old.x, old.y)
        to_start = self.system.difference(start.x, start.y, old.x, old.y)
        finite = np.isfinite(periods)
        turns = np.zeros(self.system.n)
        turns[finite] = np.round(to_start[: self.system.n][finite] / periods[finite])
        to_start[: self.system.n][finite] -= turns[finite] * periods[finite]
        length = float(np.linalg.norm(chord))
        along = float(to_start @ chord) / length
        aside = float(np.linalg.norm(to_start - along * chord / length))
        return bool(turns.any()) if 0.0 < along <= length and aside <= 0.1 * length else None

    def _where(self, point: CurvePoint) -> str:
        free = zip(self.system.free, point.y, strict=False)
        return ", ".join(f"{p.name} = {p.show(p.value(float(u)))}" for p, u in free)


def _distinct(located: list[Located]) -> list[Located]:
    """Drop a fold that is the same point as a branch point (a pitchfork's turning side branch)."""
    branch_points = [e for e in located if e.kind == "BP"]
    return [
        e for e in located if e.kind != "LP" or all(abs(e.point.s - b.point.s) > 1e-5 for b in branch_points)
    ]


def trace(walker: Walker, start: CurvePoint, progress: Callable[[CurvePoint | Located | End], None] | None) -> Trace:
    """Collect a walk; an interrupt (Ctrl-C) ends it and keeps what there is."""
    result = Trace([start])
    try:
        for item in walker.walk(start):
            if isinstance(item, End):
                result.end = item
            elif isinstance(item, Located):
                result.special.append(item)
            else:
                result.points.append(item)
            if progress is not None:
                progress(item)
    except KeyboardInterrupt:
        result.end = End(Status.INTERRUPTED, f"stopped by the user after {len(result.points)} points")
    return result
