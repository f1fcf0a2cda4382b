"""Plain pseudo-arclength continuation, one step a point: predict, correct, look, choose the next step.

Read this first. Predictor, corrector and choice of steps are in `step`; what is looked for between two points
in `points`. `filled` takes longer steps on top of this; `trace` is the loop, with limits, closing and duplicates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.corner import NEAR, break_off, cross
from mjcont.numerics.points.events import Detector, Located
from mjcont.numerics.points.looking import SMALL_FOLDS, look
from mjcont.numerics.step.arclength import (
    CurvePoint,
    advance,
    aim,
    by_contraction,
    follows,
    land,
    land_beside,
    next_step,
    predict,
)
from mjcont.numerics.step.turning import may_turn_twice
from mjcont.numerics.walk.steps import End, Leap, Status, Step

# parts of a refused step that are tried next; corrections after which derivatives are taken at the prediction; along a
# locus, whose matrices are not extrapolated, contraction that tells that they turn with the mechanism
_SHORTER, _MANY, _STALE = 0.4, 4, 0.25


@dataclass(slots=True)
class OneByOne:
    """Steps along a curve, one a point.

    Attributes
    ----------
    detectors : in the order in which they look at a step; the first may ask for a shorter one.
    """

    system: System
    settings: Settings
    detectors: Sequence[Detector] = ()
    _fresh: bool = field(default=False, init=False)

    def begin(self, start: CurvePoint) -> float:
        """Return the length of the first step from a start."""
        del start
        return self.settings.ds

    def other_way(self, points: Sequence[CurvePoint]) -> CurvePoint | None:
        """Return the start of the other direction, given the points of the first; None: as the first one's."""
        del points
        return None

    def steps(self, point: CurvePoint, h: float) -> Sequence[Step | End]:
        """Return the next steps, or the end of a curve that cannot be followed."""
        return [self.step(point, h)]

    def step(self, point: CurvePoint, h: float) -> Step | End:
        """Return the next step, of length h or as much shorter as it must be, or the end of the curve."""
        while True:
            tried = self.attempt(point, h)
            if isinstance(tried, Step):
                return tried
            h = tried.shorter or 0.0
            if h < NEAR and not self.system.conditions:
                crossed = cross(self.system, point, self.settings)
                if crossed is not None:
                    return self._crossed(*crossed)
            if h < self.settings.ds_min:
                broken = None if self.system.conditions else break_off(self.system, point)
                if broken is not None:
                    where = self.system.where(broken.point.y)
                    return Step([broken], 0.0, End(Status.BREAKS_OFF, f"{broken.note} at {where}"))
                return End(Status.STEP_TOO_SMALL, f"step below ds_min at {self.system.where(point.y)}: {tried}")

    def _crossed(self, new: CurvePoint, corner: Located) -> Step:
        """Return the step across a corner; where it leads to a bound, or over it, it ends there."""
        system = self.system
        met = np.flatnonzero((new.y <= system.lowest) | (new.y >= system.highest))
        if not len(met):
            return Step([corner, new], self.settings.ds)
        index = int(met[0])
        bound = float(system.lowest[index] if new.y[index] <= system.lowest[index] else system.highest[index])
        landed = land_beside(system, new, index, bound, self.settings)
        items: list[CurvePoint | Located] = [corner] if isinstance(landed, Refused) else [corner, landed]
        return Step(items, 0.0, self._at_bound(index, bound))

    def _at_bound(self, index: int, bound: float) -> End:
        p = self.system.free[index]
        return End(Status.AT_BOUND, f"{p.name} reached its bound {p.show(p.value(bound))}")

    def attempt(self, point: CurvePoint, h: float) -> Step | Refused:
        """Return a step of length h with the special points within, or why it is refused."""
        leap = self.leap(point, h)
        return leap if isinstance(leap, Refused) else self.looked(leap)

    def leap(self, point: CurvePoint, h: float) -> Leap | Refused:
        """Predict and correct; a prediction beyond a bound is corrected on that bound, where the curve ends."""
        prediction = predict(point, h)
        aimed = aim(self.system, point, h, prediction, steady=False)
        if aimed is not None:
            return self.landed(point, h, *aimed, self.settings)
        new = advance(self.system, point, h, self.settings, fresh=self._fresh, prediction=prediction)
        if isinstance(new, Refused):  # first with derivatives at the prediction, then shorter
            shorter, self._fresh = _SHORTER * h if self._fresh else h, True
            return replace(new, shorter=shorter)
        return Leap(point, new, h, None)

    def landed(
        self, point: CurvePoint, h: float, index: int, bound: float, ahead: float, settings: Settings
    ) -> Leap | Refused:
        """Return the step to a bound of y[index], which the prediction meets after a length `ahead`."""
        far = h > self.settings.ds_max
        new = land(self.system, point, index, bound, ahead, settings, fresh=self._fresh, steady=far)
        if isinstance(new, Refused) and not self._fresh:
            new = land(self.system, point, index, bound, ahead, settings, fresh=True, steady=far)
        if isinstance(new, Refused):
            return replace(new, shorter=_SHORTER * min(h, max(ahead, 0.1 * h)))
        return Leap(point, new, h, self._at_bound(index, bound))

    def looked(self, leap: Leap) -> Step | Refused:
        """Look for special points within a step, and choose the next."""
        old, new, h = leap.old, leap.new, leap.h
        if not self.system.conditions and h > SMALL_FOLDS and may_turn_twice(self.system, old, new, 0):
            return Refused(Why.TURNS_TWICE, "the parameter may turn twice", _SHORTER * h)
        follows(new, old)
        found = look(self.system, old, new, self.detectors, self.settings)
        if isinstance(found, Refused):
            return replace(found, shorter=_SHORTER * h)
        self.learn(leap)
        return Step([*found.located, new], next_step(h, new, self.settings), leap.ending, found.neutral)

    def learn(self, leap: Leap) -> None:
        """Take derivatives at the predictions from now on where the last point's did not serve a short step."""
        new, short = leap.new, leap.h <= self.settings.ds_max
        stale = bool(self.system.conditions) and new.contraction > _STALE
        self._fresh |= short and by_contraction(new) < 1.0 and (new.iterations > _MANY or stale)
