"""The driver: follows a curve in one direction, or both, and yields points and special points as they come."""

from __future__ import annotations

import itertools
import math
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mjcont.numerics import clock
from mjcont.numerics.arclength import CurvePoint, advance, by_contraction, land, land_beside, may_turn_twice, next_step
from mjcont.numerics.corner import NEAR, break_off, cross
from mjcont.numerics.events import Detector, Located, Retry
from mjcont.numerics.interior import Interior
from mjcont.numerics.longsteps import LongSteps
from mjcont.numerics.newton import length
from mjcont.numerics.problem import Array
from mjcont.numerics.settings import Settings
from mjcont.numerics.stability import tell
from mjcont.numerics.steps import End, Leap, Status, Step
from mjcont.numerics.system import System

# below this step a pair of folds is not looked for between two points
_SMALL_FOLDS = 1e-5
# a curve that ends on the bound where it is already adds no second point there
_SAME_POINT = 1e-9
_SAME_LOCATED = 1e-7
# long steps that are filled together
_AHEAD = 6
# along a locus, whose matrices are not extrapolated, contraction that tells that they turn with the mechanism
_STALE = 0.25


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
    long : takes steps longer than the distance of points, which it fills; None for one step a point.
    """

    system: System
    settings: Settings
    detectors: Sequence[Detector] = ()
    stop: Stop | None = None
    end_at: frozenset[str] = frozenset()
    long: LongSteps | None = None
    _fresh: bool = field(default=False, init=False)
    _turns: Array | None = field(default=None, init=False)
    _leaps: list[Leap] = field(default_factory=list, init=False)

    def walk(self, start: CurvePoint) -> Iterator[CurvePoint | Located | End]:
        """Yield the curve's points after `start`, special points before the point that follows them, and the end."""
        settings = self.settings
        point, h, count = start, settings.ds, 1
        steps, self._leaps = deque[Step | End](), []
        if start.past:
            h = max(h, -0.5 * start.past[-1].s)
        elif self.long is not None:
            self.long.begin()
        for detector in self.detectors:
            detector.changed(point, point)
        last: dict[str, Located] = {}
        periods = self._periods(start)
        largest = settings.max_size * max(1.0, self._size(start))
        while True:
            if self._size(point) > largest:
                yield End(Status.RUNS_OFF, f"a state coordinate exceeds {largest:g} times its scale (max_size)")
                return
            limit = self._limit(point, count)
            if not (limit or steps):
                steps.extend(self._steps(point, h))
            step = limit or steps.popleft()
            if isinstance(step, End):
                yield step
                return
            passes = step.ending is None and self._may_pass(start, point, step, periods)
            for item in step.items:
                if isinstance(item, Located):
                    if self._known(item, last):
                        continue
                    last[item.kind] = item
                    yield item
                    if item.kind in self.end_at:
                        yield End(Status.AT_SPECIAL_POINT, f"the curve was to end at a point of kind {item.kind}")
                        return
                    continue
                turns = self._passes(start, point, item, periods) if passes else None
                if turns is not None:
                    yield End(Status.CLOSED, "the curve closes on itself" + (", full turns apart" if turns else ""))
                    return
                ended = step.ending is not None and item is step.items[-1]
                if not ended or item.s - point.s > _SAME_POINT:
                    yield item
                point, count = item, count + 1
                limit = None if item is step.items[-1] else self._limit(point, count)
                if limit is not None:
                    yield limit
                    return
            if step.ending is not None:
                yield step.ending
                return
            self.system.update(point.local, point.y)
            h = step.next

    def _size(self, point: CurvePoint) -> float:
        n = self.system.n  # positions of a free body carry a quaternion beside n coordinates: measure those alone
        return float(np.max(np.abs(point.x[:n]) / self.system.problem.state_scale))

    def _known(self, special: Located, last: dict[str, Located]) -> bool:
        """Whether a point was located just before: on both sides of a step's end, or twice in a flat stretch."""
        if special.kind not in last or special.data.get("monitor") != last[special.kind].data.get("monitor"):
            return False
        p, q = special.point, last[special.kind].point
        return float(np.linalg.norm(self.system.difference(p.x, p.y, q.x, q.y))) < _SAME_LOCATED

    def _limit(self, point: CurvePoint, count: int) -> End | None:
        settings = self.settings
        if count >= settings.max_points:
            return End(Status.MAX_POINTS, f"the limit of {settings.max_points} points was reached")
        if point.s >= settings.max_arclength:
            return End(Status.MAX_ARCLENGTH, f"the limit of {settings.max_arclength:g} in arclength was reached")
        if clock.expired():
            return time_up(settings)
        message = self.stop(point) if self.stop is not None else None
        if not message:
            return None
        point.extra["outside"] = True
        return End(Status.STOPPED, message)

    def _steps(self, point: CurvePoint, h: float) -> list[Step | End]:
        """Return the next step or steps, or the end of a curve that cannot be followed.

        Long steps are taken several at a time and filled together. The last one waits for the next: what lies inside a
        step is known better with points on both sides.
        """
        if self.long is None or not (self._leaps or self.long.runs_ahead(h)):
            return [self._step(point, h)]
        shorter = self._run_ahead(point, h)
        leaps, self._leaps = self._leaps, []
        if not leaps:
            return [self._step(point, shorter)]
        if len(leaps) > 1 and leaps[-1].ending is None and not shorter:
            self._leaps = [leaps.pop()]
        found: list[Step | End] = []
        for leap, inside in zip(leaps, self.long.inside([(s.old, s.new) for s in leaps]), strict=False):
            step = self._completed(leap, inside)
            if not isinstance(step, Step):
                self.long.refused(leap.h)
                self._leaps = []
                return [*found, self._step(leap.old, step[1])]
            found.append(replace(step, next=shorter) if shorter and leap is leaps[-1] else step)
        return found

    def _run_ahead(self, point: CurvePoint, h: float) -> float:
        """Add long steps to those that wait to be filled; return what length to try where one is refused, else 0."""
        assert self.long is not None
        if self._leaps:
            point, h = self._leaps[-1].new, self.long.next(self._leaps[-1].h, self._leaps[-1].new, Interior([]))
        while len(self._leaps) <= _AHEAD and self.long.runs_ahead(h):
            leap = self._leap(point, h)
            if not isinstance(leap, Leap):
                self.long.refused(h)
                return leap[1]
            self._leaps.append(leap)
            if leap.ending is not None:
                break
            point, h = leap.new, self.long.next(h, leap.new, Interior([]))
        return 0.0

    def _step(self, point: CurvePoint, h: float) -> Step | End:
        """Return the next step, or the end of a curve that cannot be followed."""
        while True:
            far = self.long is not None and h > self.settings.ds_max
            tried = self._try(point, h)
            if isinstance(tried, Step):
                return tried
            if far and self.long is not None:
                self.long.refused(h)
            reason, h = tried
            if h < NEAR and not self.system.conditions:
                crossed = cross(self.system, point, self.settings)
                if crossed is not None:
                    return self._crossed(*crossed)
            if h < self.settings.ds_min:
                broken = None if self.system.conditions else break_off(self.system, point)
                if broken is not None:
                    return Step([broken], 0.0, End(Status.BREAKS_OFF, f"{broken.note} at {self._where(broken.point)}"))
                return End(Status.STEP_TOO_SMALL, f"step below ds_min at {self._where(point)}: {reason}")

    def _crossed(self, new: CurvePoint, corner: Located) -> Step:
        """Return the step across a corner; where it leads over a bound, it ends there."""
        outside = self._outside(new)
        if outside is None:
            return Step([corner, new], self.settings.ds)
        index, target, message = outside
        end = End(Status.AT_BOUND, message)
        inside = self._outside(corner.point) is None
        base = new if inside else corner.point
        landed = land_beside(self.system, base, index, target, self.settings)
        items: list[CurvePoint | Located] = [corner] if inside else []
        return Step(items if isinstance(landed, str) else [*items, landed], 0.0, end)

    def _try(self, point: CurvePoint, h: float) -> Step | tuple[str, float]:
        """Return the step of length h with what lies within, or why it is refused and the length to try instead."""
        leap = self._leap(point, h)
        if not isinstance(leap, Leap):
            return leap
        inside = self.long.inside([(point, leap.new)])[0] if self.long is not None else Interior([])
        return self._completed(leap, inside)

    def _leap(self, point: CurvePoint, h: float) -> Leap | tuple[str, float]:
        """Return a step of length h, or why it is refused and the length to try instead."""
        settings = self.long.limits(h) if self.long is not None else self.settings
        far = h > self.settings.ds_max
        new = advance(self.system, point, h, settings, fresh=self._fresh and not far)
        if isinstance(new, str) and far:
            new = advance(self.system, point, h, settings, fresh=True)
        if isinstance(new, str):
            shorter = 0.4 * h if self._fresh or far else h
            self._fresh |= not far
            return new, shorter
        outside = self._outside(new)
        if outside is None:
            return Leap(point, new, h, None)
        landed = land(self.system, point, new, *outside[:2], settings)
        if isinstance(landed, str):
            return landed, 0.4 * h
        if landed.s - point.s > 3.0 * h or landed.angle > settings.angle_max:
            return "the bound was not met along the curve", 0.4 * h
        return Leap(point, landed, h, End(Status.AT_BOUND, outside[2]))

    def _completed(self, leap: Leap, inside: Interior | str) -> Step | tuple[str, float]:
        """Return a step with what lies within, or why it is refused and the length to try instead."""
        old, new, h = leap.old, leap.new, leap.h
        if isinstance(inside, str):
            return inside, 0.5 * h
        if not inside.points and not self.system.conditions and h > _SMALL_FOLDS and (
            may_turn_twice(self.system, old, new, 0)
        ):
            return "the parameter may turn twice", 0.4 * h
        try:
            items = self._items(old, inside, new)
        except Retry as retry:
            return str(retry), 0.4 * h
        stale = bool(self.system.conditions) and new.contraction > _STALE
        short = h <= self.settings.ds_max
        self._fresh |= short and by_contraction(new) < 1.0 and (new.iterations > 4 or stale)
        after = next_step(h, new, self.settings) if self.long is None else self.long.next(h, new, inside)
        return Step(items, after, leap.ending)

    def _items(self, old: CurvePoint, inside: Interior, new: CurvePoint) -> list[CurvePoint | Located]:
        """Return the points of a step after the first, with the special points between them."""
        if not inside.points or self.long is None:
            return [*self._between(old, new, self.detectors), new]
        every = [old, *inside.points, new]
        located: list[Located] = []
        for i, j in self.long.spans(old, new, inside):
            found = self._between(every[i], every[j], self.detectors)
            located += found
            if j > i + 1 and not found:
                tell(every[i], every[i + 1 : j], every[j])
        others = [d for d in self.detectors if not d.structural]
        for a, b in itertools.pairwise(every) if others else ():
            located += self._between(a, b, others)
        if not located:
            return every[1:]  # type: ignore[return-value]
        return sorted([*located, *every[1:]], key=lambda e: e.point.s if isinstance(e, Located) else e.s)

    def _outside(self, new: CurvePoint) -> tuple[int, float, str] | None:
        for i, p in enumerate(self.system.free):
            value = p.value(float(new.y[i]))
            for bound, beyond in ((p.low, value < p.low), (p.high, value > p.high)):
                if beyond:
                    return i, p.coordinate(bound), f"{p.name} reached its bound {p.show(bound)}"
        return None

    def _between(
        self, old: CurvePoint, new: CurvePoint, detectors: Sequence[Detector]
    ) -> list[Located]:
        located: list[Located] = []
        for detector in detectors:
            if detector.changed(old, new):
                located += detector.locate(old, new, located)
        located = _distinct(located)
        return sorted(located, key=lambda e: e.point.s)

    def _periods(self, start: CurvePoint) -> Array:
        """Return the periods of the scaled state coordinates, infinite where a coordinate has none, (n,)."""
        problem: Any = self.system.problem
        if not hasattr(problem, "periods"):
            return np.full(self.system.n, np.inf)
        if self._turns is None:
            self._turns = problem.periods(start.x, self.system.values(start.y)) / problem.state_scale
        return self._turns

    def _may_pass(self, start: CurvePoint, point: CurvePoint, step: Step, periods: Array) -> bool:
        """Whether the start, or a full turn of it, is as near as a step could pass it."""
        new = step.items[-1]
        assert isinstance(new, CurvePoint)
        if len(step.items) == 1:
            return True
        to_start = self.system.difference(start.x, start.y, point.x, point.y)
        finite = np.isfinite(periods)
        part = to_start[: self.system.n]
        part[finite] -= np.round(part[finite] / periods[finite]) * periods[finite]
        return length(to_start) < 3.0 * (new.s - point.s)

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
        size = length(chord)
        along = float(to_start @ chord) / size
        aside = length(to_start - along * chord / size)
        return bool(turns.any()) if 0.0 < along <= size and aside <= 0.1 * size else None

    def _where(self, point: CurvePoint) -> str:
        free = zip(self.system.free, point.y, strict=False)
        return ", ".join(f"{p.name} = {p.show(p.value(float(u)))}" for p, u in free)


def _distinct(located: list[Located]) -> list[Located]:
    """Drop a fold that is the same point as a branch point (a pitchfork's turning side branch)."""
    branch_points = [e for e in located if e.kind == "BP"]
    return [
        e for e in located if e.kind != "LP" or all(abs(e.point.s - b.point.s) > 1e-5 for b in branch_points)
    ]


def time_up(settings: Settings) -> End:
    """Return the end of a curve that takes too long."""
    return End(Status.MAX_TIME, f"the limit of {settings.max_seconds:g} s was reached")


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
    except clock.TimeUp:
        result.end = time_up(walker.settings)
    except KeyboardInterrupt:
        result.end = End(Status.INTERRUPTED, f"stopped by the user after {len(result.points)} points")
    return result
