"""Plain pseudo-arclength continuation, one step a point: predict, correct, look, choose the next step.

Read this first. Predictor, corrector and choice of steps are in `step`; what is looked for between two points
in `points`. `filled` takes longer steps on top of this; `trace` is the loop, with limits, closing and duplicates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.events import Detector
from mjcont.numerics.points.looking import SMALL_FOLDS, look
from mjcont.numerics.step.arclength import CurvePoint, advance, aim, by_contraction, follows, land, next_step, predict
from mjcont.numerics.step.turning import may_turn_twice
from mjcont.numerics.walk.kinks import across, at_bound, broken_off
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
            crossing = across(self.system, point, h, self.settings)
            if crossing is not None:
                return crossing
            if h < self.settings.ds_min:
                sentence = f"step below ds_min at {self.system.where(point.y)}: {tried}"
                return broken_off(self.system, point) or End(Status.STEP_TOO_SMALL, sentence)

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
        return Leap(point, new, h, at_bound(self.system, index, bound))

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
