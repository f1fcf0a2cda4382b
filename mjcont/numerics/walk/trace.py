"""The driver: follows a curve in one direction, or both, and yields points and special points as they come.

It is told what steps (`OneByOne`, `Filled`), and knows limits, when a curve has closed, and what was found before.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy import sparse

from mjcont.numerics.equations import clock
from mjcont.numerics.equations.newton import length
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.events import Located
from mjcont.numerics.spectra.stability import SPECTRUM
from mjcont.numerics.step.arclength import OUTSIDE, CurvePoint
from mjcont.numerics.walk.guard import guarded
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.steps import End, Item, Neutral, Status, Step

# a curve that ends on the bound where it is already adds no second point there
_SAME_POINT = 1e-9
# special points of a kind nearer than this are one
_SAME_LOCATED = 1e-7


@dataclass(slots=True)
class Trace:
    """One direction of a curve: its points from the start on, special points, neutral saddles, and how it ended."""

    points: list[CurvePoint] = field(default_factory=list)
    special: list[Located] = field(default_factory=list)
    neutral: list[Located] = field(default_factory=list)
    end: End = field(default_factory=lambda: End(Status.STOPPED, "not started"))


Stop = Callable[[CurvePoint], str | None]


@dataclass(slots=True)
class Walker:
    """A walk along a curve.

    Attributes
    ----------
    stepper : what steps.
    stop : returns a sentence to end the curve at a point (limits on observables, a user's callback).
    end_at : kinds of special points that end the curve.
    """

    stepper: OneByOne
    stop: Stop | None = None
    end_at: frozenset[str] = frozenset()
    _turns: Array | None = field(default=None, init=False)

    @property
    def system(self) -> System:
        """The equations of the curve."""
        return self.stepper.system

    @property
    def settings(self) -> Settings:
        """The settings of the walk."""
        return self.stepper.settings

    def walk(self, start: CurvePoint, known: Sequence[Located] = ()) -> Iterator[Item]:
        """Yield the curve's points after `start`, special points before the point that follows them, and the end.

        `known` are special points of the same curve found before, in the other direction: none is found twice.
        """
        settings = self.settings
        point, h, count = start, self.stepper.begin(start), 1
        steps = deque[Step | End]()
        every = list(known)
        periods = self._periods(start)
        largest = settings.max_size * max(1.0, self._size(start))
        while True:
            if self._size(point) > largest:
                yield End(Status.RUNS_OFF, f"a state coordinate exceeds {largest:g} times its scale (max_size)")
                return
            limit = self._limit(point, count)
            if not (limit or steps):
                steps.extend(self.stepper.steps(point, h))
            step = limit or steps.popleft()
            if isinstance(step, End):
                yield step
                return
            yield from map(Neutral, step.neutral)
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
                _left_behind(point)
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
        return float(np.max(np.abs(point.x[:n]) / self.system.problem.typical))

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
        OUTSIDE.put(point, True)
        return End(Status.STOPPED, message)

    def _periods(self, start: CurvePoint) -> Array:
        """Return the periods of the scaled state coordinates, infinite where a coordinate has none, (n,)."""
        problem = self.system.problem
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


def _left_behind(point: CurvePoint) -> None:
    """Let go of the matrices of a point of which they tell nothing more, where they are sparse: a curve has many."""
    if sparse.issparse(point.jac) and SPECTRUM.known(point):
        point.local.forget()
        point.jac, point.past = None, ()


def time_up(settings: Settings) -> End:
    """Return the end of a curve that takes too long."""
    return End(Status.MAX_TIME, f"the limit of {settings.max_seconds:g} s was reached")


def trace(
    walker: Walker,
    start: CurvePoint,
    progress: Callable[[Item], None] | None,
    known: Sequence[Located] = (),
) -> Trace:
    """Collect a walk; an interrupt (Ctrl-C) ends it and keeps what there is. `known` as for `Walker.walk`."""
    result = Trace([start])
    try:
        for item in guarded(walker.walk(start, known)):
            if isinstance(item, End):
                result.end = item
            elif isinstance(item, Neutral):
                result.neutral.append(item.located)
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
