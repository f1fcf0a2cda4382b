"""Long steps, filled: `OneByOne` with steps longer than the distance of points, and points inside them."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.points.events import Located
from mjcont.numerics.points.glance import glance
from mjcont.numerics.points.looking import look
from mjcont.numerics.spectra.stability import negative_stiffness, tell
from mjcont.numerics.step.arclength import CurvePoint, advance, aim, follows, predict, turned_back
from mjcont.numerics.walk.interior import Interior
from mjcont.numerics.walk.longsteps import LongSteps
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.steps import End, Leap, Step

# long steps that are filled together
_AHEAD = 6
# parts of a long step that are tried next where it, or what lies inside, is refused
_SHORTER, _UNFILLED = 0.4, 0.5
# points that are looked at one by one
_FEW = 3


@dataclass(slots=True)
class Filled(OneByOne):
    """Steps along a curve of equilibria, as long as the corrector allows, filled with points.

    Several are taken and filled together; the last of them waits for the next: what lies inside a step is known better
    with points on both sides. Short ones are `OneByOne`'s.
    """

    _long: LongSteps = field(init=False)
    _leaps: list[Leap] = field(default_factory=list, init=False)

    def __post_init__(self) -> None:
        self._long = LongSteps(self.system, self.settings, negative_stiffness)

    def begin(self, start: CurvePoint) -> float:
        """Return the length of the first step: a long one from a start with a past."""
        self._leaps = []
        if start.past:
            return max(self.settings.ds, -0.5 * start.past[-1].s)
        self._long.begin()
        return self.settings.ds

    def other_way(self, points: Sequence[CurvePoint]) -> CurvePoint | None:
        """Return the first point turned back, the points of the first direction behind it."""
        return turned_back(self.system, points) if points else None

    def steps(self, point: CurvePoint, h: float) -> Sequence[Step | End]:
        """Return the next steps, several where the walk runs ahead."""
        if not (self._leaps or self._long.runs_ahead(h)):
            return [self.step(point, h)]
        shorter = self._run_ahead(point, h)
        leaps, self._leaps = self._leaps, []
        if not leaps:
            return [self.step(point, shorter)]
        if len(leaps) > 1 and leaps[-1].ending is None and not shorter:
            self._leaps = [leaps.pop()]
        found: list[Step | End] = []
        for leap, inside in zip(leaps, self._inside(leaps), strict=False):
            step = self._filled(leap, inside)
            if isinstance(step, Refused):
                self._long.refused(leap.h)
                self._leaps = []
                return [*found, self.step(leap.old, step.shorter or 0.0)]
            found.append(replace(step, next=shorter) if shorter and leap is leaps[-1] else step)
        return found

    def _inside(self, leaps: Sequence[Leap]) -> list[Interior | Refused]:
        """Return the points inside steps, up to the first that is refused; note between which points nothing lies."""
        insides, chain = self._long.inside([(s.old, s.new) for s in leaps]), [leaps[0].old]
        for leap, inside in zip(leaps, insides, strict=False):
            if isinstance(inside, Refused):
                break
            every = [leap.old, *inside.points, leap.new]
            chain += [every[j] for _, j in self._long.spans(leap.old, leap.new, inside)]
        if len(chain) > _FEW:
            glance(self.system, chain, self.settings)
        return insides

    def _run_ahead(self, point: CurvePoint, h: float) -> float:
        """Add long steps to those that wait to be filled; return what length to try where one is refused, else 0."""
        if self._leaps:
            point, h = self._leaps[-1].new, self._long.next(self._leaps[-1].h, self._leaps[-1].new, Interior([]))
        while len(self._leaps) <= _AHEAD and self._long.runs_ahead(h):
            leap = self.leap(point, h)
            if isinstance(leap, Refused):
                self._long.refused(h)
                return leap.shorter or 0.0
            self._leaps.append(leap)
            if leap.ending is not None:
                break
            point, h = leap.new, self._long.next(h, leap.new, Interior([]))
        return 0.0

    def attempt(self, point: CurvePoint, h: float) -> Step | Refused:
        """Return a step of length h with the points inside, or why it is refused."""
        leap = self.leap(point, h)
        step = leap if isinstance(leap, Refused) else self._filled(leap, self._inside([leap])[0])
        if isinstance(step, Refused) and h > self.settings.ds_max:
            self._long.refused(h)
        return step

    def leap(self, point: CurvePoint, h: float) -> Leap | Refused:
        """Predict and correct; a long step is tried again at once with derivatives at the prediction."""
        if h <= self.settings.ds_max:
            return OneByOne.leap(self, point, h)
        prediction = predict(point, h, steady=True)
        aimed = aim(self.system, point, h, prediction, steady=True)
        if aimed is not None:
            return self.landed(point, h, *aimed, self._long.far)
        new = advance(self.system, point, h, self._long.far, prediction=prediction)
        if isinstance(new, Refused):
            new = advance(self.system, point, h, self._long.far, fresh=True, prediction=prediction)
        return replace(new, shorter=_SHORTER * h) if isinstance(new, Refused) else Leap(point, new, h, None)

    def _filled(self, leap: Leap, inside: Interior | Refused) -> Step | Refused:
        """Return a step with what lies within, or why it is refused."""
        if isinstance(inside, Refused):
            return replace(inside, shorter=_UNFILLED * leap.h)
        step = self._looked_inside(leap, inside) if inside.points else self.looked(leap)
        if isinstance(step, Refused):
            return step
        return replace(step, next=self._long.next(leap.h, leap.new, inside))

    def _looked_inside(self, leap: Leap, inside: Interior) -> Step | Refused:
        """Look for special points between the points of a step: between all of them, or where something changes."""
        every = [leap.old, *inside.points, leap.new]
        located, neutral = list[Located](), list[Located]()
        for i, j in self._long.spans(leap.old, leap.new, inside):
            follows(every[j], every[i])
            found = look(self.system, every[i], every[j], self.detectors, self.settings)
            if isinstance(found, Refused):
                return replace(found, shorter=_SHORTER * leap.h)
            located += found.located
            neutral += found.neutral
            if j > i + 1 and not found.located:
                tell(every[i], every[i + 1 : j], every[j])
        others = [d for d in self.detectors if not d.structural]
        for a, b in itertools.pairwise(every) if others else ():
            found = look(self.system, a, b, others, self.settings)
            if isinstance(found, Refused):
                return replace(found, shorter=_SHORTER * leap.h)
            located += found.located
        self.learn(leap)
        items: list[CurvePoint | Located] = [*every[1:]]
        if located:
            items = sorted([*located, *items], key=lambda e: e.point.s if isinstance(e, Located) else e.s)
        return Step(items, 0.0, leap.ending, neutral)
