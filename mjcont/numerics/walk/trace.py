"""The driver: follows a curve in one direction, or both, and yields points and special points as they come."""

from __future__ import annotations

import itertools
import math
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mjcont.numerics.equations.newton import length
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.corner import NEAR, cross
from mjcont.numerics.points.events import Detector, Located
from mjcont.numerics.spectra.stability import tell
from mjcont.numerics.step.arclength import (
    OUTSIDE,
    CurvePoint,
    advance,
    aim,
    by_contraction,
    land,
    may_turn_beyond,
    may_turn_twice,
    next_step,
    predict,
)
from mjcont.numerics.walk.guard import guarded
from mjcont.numerics.walk.interior import Interior
from mjcont.numerics.walk.longsteps import LongSteps
from mjcont.numerics.walk.steps import End, Leap, Status, Step

# below this step a pair of folds, or a fold beyond a bound, is not looked for between two points
_SMALL_FOLDS = 1e-5
# a curve that ends on the bound where it is already adds no second point there
_SAME_POINT = 1e-9
# special points of a kind nearer than this are one
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

    def walk(self, start: CurvePoint, known: Sequence[Located] = ()) -> Iterator[CurvePoint | Located | End]:
        """Yield the curve's points after `start`, special points before the point that follows them, and the end.

        `known` are special points of the same curve found before, in the other direction: none is found twice.
        """
        settings, began = self.settings, time.monotonic()
        point, h, count = start, settings.ds, 1
        steps, self._leaps = deque[Step | End](), []
        if start.past:
            h = max(h, -0.5 * start.past[-1].s)
        elif self.long is not None:
            self.long.begin()
        for detector in self.detectors:
            detector.changed(point, point)
        every = list(known)
        periods = self._periods(start)
        largest = settings.max_size * max(1.0, self._size(start))
        while True:
            if self._size(point) > largest:
                yield End(Status.RUNS_OFF, f"a state coordinate exceeds {largest:g} times its scale (max_size)")
                return
            limit = self._limit(point, count, began)
            if not (limit or steps):
                steps.extend(self._steps(point, h))
            step = limit or steps.popleft()
            if isinstance(step, End):
                yield step
                return
            passes = step.ending is None and self._may_pass(start, point, step, periods)
            for item in step.items:
                if isinstance(item, Located):
                    if any(self._same(item, other, periods) for other in every):
                        continue
                    every.append(item)
                    yield item
                    if item.kind in self.end_at:
                        yield End(Status.AT_SPECIAL_POINT, f"the curve was to end at a point of kind {item.kind}")
                        return
                    continue
                turns = self._passes(start, point, item, periods) if passes else None
                if turns is not None:
                    sentence = "the curve closes on itself" + (", full turns apart" if turns else "")
                    yield End(Status.CLOSED, sentence, turns)
                    return
                ended = step.ending is not None and item is step.items[-1]
                if not ended or item.s - point.s > _SAME_POINT:
                    yield item
                point, count = item, count + 1
                limit = None if item is step.items[-1] else self._limit(point, count, began)
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

    def _same(self, one: Located, other: Located, periods: Array) -> bool:
        """Whether a point was located twice: from both sides of a step's end, or at both ends of a closed curve."""
        if one.kind != other.kind or one.data.get("monitor") != other.data.get("monitor"):
            return False
        return length(self._less_turns(one.point, other.point, periods)[0]) < _SAME_LOCATED

    def _less_turns(self, to: CurvePoint, origin: CurvePoint, periods: Array) -> tuple[Array, Array]:
        """Return the scaled step between points less full turns, (n + k,), and how many turns these are, (n,)."""
        step, turns = self.system.difference(to.x, to.y, origin.x, origin.y), np.zeros(self.system.n)
        finite = np.isfinite(periods)
        part = step[: self.system.n]
        turns[finite] = np.round(part[finite] / periods[finite])
        part[finite] -= turns[finite] * periods[finite]
        return step, turns

    def _limit(self, point: CurvePoint, count: int, began: float) -> End | None:
        settings = self.settings
        if count >= settings.max_points:
            return End(Status.MAX_POINTS, f"the limit of {settings.max_points} points was reached")
        if point.s >= settings.max_arclength:
            return End(Status.MAX_ARCLENGTH, f"the limit of {settings.max_arclength:g} in arclength was reached")
        if time.monotonic() - began > settings.max_seconds:
            return End(Status.MAX_TIME, f"the limit of {settings.max_seconds:g} s was reached")
        message = self.stop(point) if self.stop is not None else None
        if not message:
            return None
        OUTSIDE.put(point, True)
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
                return [*found, self._step(leap.old, step.shorter or 0.0)]
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
                return leap.shorter or 0.0
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
            h = tried.shorter or 0.0
            if h < NEAR and not self.system.conditions:
                crossed = cross(self.system, point, self.settings)
                if crossed is not None:
                    return Step([crossed[1], crossed[0]], self.settings.ds)
            if h < self.settings.ds_min:
                return End(Status.STEP_TOO_SMALL, f"step below ds_min at {self._where(point)}: {tried}")

    def _try(self, point: CurvePoint, h: float) -> Step | Refused:
        """Return the step of length h with what lies within, or why it is refused and the length to try instead."""
        leap = self._leap(point, h)
        if not isinstance(leap, Leap):
            return leap
        inside = self.long.inside([(point, leap.new)])[0] if self.long is not None else Interior([])
        return self._completed(leap, inside)

    def _leap(self, point: CurvePoint, h: float) -> Leap | Refused:
        """Return a step of length h, or why it is refused and the length to try instead."""
        settings = self.long.limits(h) if self.long is not None else self.settings
        far = h > self.settings.ds_max
        prediction = predict(point, h)
        aimed = aim(self.system, point, h, prediction)
        if aimed is not None:
            return self._landed(point, h, *aimed)
        new = advance(self.system, point, h, settings, fresh=self._fresh and not far, prediction=prediction)
        if isinstance(new, Refused) and far:
            new = advance(self.system, point, h, settings, fresh=True, prediction=prediction)
        if isinstance(new, Refused):
            shorter = 0.4 * h if self._fresh or far else h
            self._fresh |= not far
            return replace(new, shorter=shorter)
        return Leap(point, new, h, None)

    def _landed(self, point: CurvePoint, h: float, index: int, bound: float, ahead: float) -> Leap | Refused:
        """Return the step that ends on a bound which its prediction meets, or why not and the length to try instead."""
        settings = self.long.limits(h) if self.long is not None else self.settings
        landed = land(self.system, point, index, bound, ahead, settings)
        if isinstance(landed, Refused):
            return replace(landed, shorter=0.4 * min(h, max(ahead, 0.1 * h)))
        p = self.system.free[index]
        return Leap(point, landed, h, End(Status.AT_BOUND, f"{p.name} reached its bound {p.show(p.value(bound))}"))

    def _completed(self, leap: Leap, inside: Interior | Refused) -> Step | Refused:
        """Return a step with what lies within, or why it is refused and the length to try instead."""
        old, new, h = leap.old, leap.new, leap.h
        if isinstance(inside, Refused):
            return replace(inside, shorter=0.5 * h)
        if not inside.points and not self.system.conditions and h > _SMALL_FOLDS and (
            may_turn_twice(self.system, old, new, 0)
        ):
            return Refused(Why.TURNS_TWICE, "the parameter may turn twice", 0.4 * h)
        items = self._items(old, inside, new)
        if isinstance(items, Refused):
            return replace(items, shorter=0.4 * h)
        stale = bool(self.system.conditions) and new.contraction > _STALE
        short = h <= self.settings.ds_max
        self._fresh |= short and by_contraction(new) < 1.0 and (new.iterations > 4 or stale)
        after = next_step(h, new, self.settings) if self.long is None else self.long.next(h, new, inside)
        return Step(items, after, leap.ending)

    def _items(self, old: CurvePoint, inside: Interior, new: CurvePoint) -> list[CurvePoint | Located] | Refused:
        """Return the points of a step after the first, with the special points between them."""
        if not inside.points or self.long is None:
            found = self._between(old, new, self.detectors)
            return found if isinstance(found, Refused) else [*found, new]
        every = [old, *inside.points, new]
        located: list[Located] = []
        for i, j in self.long.spans(old, new, inside):
            found = self._between(every[i], every[j], self.detectors)
            if isinstance(found, Refused):
                return found
            located += found
            if j > i + 1 and not found:
                tell(every[i], every[i + 1 : j], every[j])
        others = [d for d in self.detectors if not d.structural]
        for a, b in itertools.pairwise(every) if others else ():
            found = self._between(a, b, others)
            if isinstance(found, Refused):
                return found
            located += found
        if not located:
            return every[1:]  # type: ignore[return-value]
        return sorted([*located, *every[1:]], key=lambda e: e.point.s if isinstance(e, Located) else e.s)

    def _between(
        self, old: CurvePoint, new: CurvePoint, detectors: Sequence[Detector]
    ) -> list[Located] | Refused:
        """Return the special points between two points of the curve, or why the step is to be shorter."""
        located: list[Located] = []
        for detector in detectors:
            found = detector.locate(old, new, located) if detector.changed(old, new) else []
            if isinstance(found, Refused):
                return found
            located += found
        located = _distinct(located)
        if not located and new.s - old.s > _SMALL_FOLDS and may_turn_beyond(self.system, old, new):
            return Refused(Why.TURNS_TWICE, "a parameter may turn beyond its bound")
        return sorted(located, key=lambda e: e.point.s)

    def _periods(self, start: CurvePoint) -> Array:
        """Return the periods of the scaled state coordinates, infinite where a coordinate has none, (n,)."""
        problem = self.system.problem
        if self.system.conditions:
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
        return length(self._less_turns(start, point, periods)[0]) < 3.0 * (new.s - point.s)

    def _passes(self, start: CurvePoint, old: CurvePoint, new: CurvePoint, periods: Array) -> bool | None:
        """Return whether the step from old to new passes the start a full turn away; None if it does not pass it."""
        if old.s < 2.0 * (new.s - old.s) or start.tangent @ new.tangent < math.cos(2.0 * self.settings.angle_max):
            return None
        chord = self.system.difference(new.x, new.y, old.x, old.y)
        to_start, turns = self._less_turns(start, old, periods)
        size = length(chord)
        if not size > 0.0:
            return None
        along = float(to_start @ chord) / size
        aside = length(to_start - along * chord / size)
        # a step that ends on the start but for rounding meets it, or the next one would miss it as narrowly
        return bool(turns.any()) if 0.0 < along <= size + _SAME_LOCATED and aside <= 0.1 * size else None

    def _where(self, point: CurvePoint) -> str:
        free = zip(self.system.free, point.y, strict=False)
        return ", ".join(f"{p.name} = {p.show(p.value(float(u)))}" for p, u in free)


def _distinct(located: list[Located]) -> list[Located]:
    """Drop a fold that is the same point as a branch point (a pitchfork's turning side branch)."""
    branch_points = [e for e in located if e.kind == "BP"]
    return [
        e for e in located if e.kind != "LP" or all(abs(e.point.s - b.point.s) > 1e-5 for b in branch_points)
    ]


def trace(
    walker: Walker,
    start: CurvePoint,
    progress: Callable[[CurvePoint | Located | End], None] | None,
    known: Sequence[Located] = (),
) -> Trace:
    """Collect a walk; an interrupt (Ctrl-C) ends it and keeps what there is. `known` as for `Walker.walk`."""
    result = Trace([start])
    try:
        for item in guarded(walker.walk(start, known)):
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
