"""Long steps of the corrector with points inside them: when they are taken, how long, and when they are given up."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.spectra.stability import COUNT, NEGATIVE
from mjcont.numerics.step.arclength import CurvePoint, next_step
from mjcont.numerics.walk.interior import MOST, Gap, Interior, count_inside, fill

# steps aim at this turning angle, never exceed the other, and never this length
_ANGLE, _ANGLE_MAX, _REACH = math.radians(25.0), math.radians(45.0), 0.6
_SHORTER, _LONGER, _GROWTH = 0.7, 1.2, 3.0
# interpolated matrices are taken where they allow steps of so many distances of points; a limit found once is raised
# from step to step
_WORTH, _LONGER_INTERPOLATED = 0.6, 1.1
# unknowns up to which the walk runs ahead
_SMALL = 40


@dataclass(slots=True)
class LongSteps:
    """Steps longer than the distance of points asked for.

    Attributes
    ----------
    index : from a point to its number of unstable eigenvalues, None where it does not tell stability.
    """

    system: System
    settings: Settings
    index: Callable[[CurvePoint], int | None]
    far: Settings = field(init=False)
    _longest: float = field(default=_REACH, init=False)
    _interpolated: float = field(default=_REACH, init=False)

    def __post_init__(self) -> None:
        given = self.settings
        reach = max(min(_REACH, MOST * given.ds_max), given.ds_max)
        angle, angle_max = max(_ANGLE, given.angle), max(_ANGLE_MAX, given.angle_max)
        self.far = replace(given, ds_max=reach, angle=angle, angle_max=angle_max)

    def begin(self) -> None:
        """Forget what another curve allowed."""
        self._longest = self._interpolated = _REACH

    def limits(self, h: float) -> Settings:
        """Return the settings that hold for a step: a short one is as the user asked for."""
        return self.far if h > self.settings.ds_max else self.settings

    def runs_ahead(self, h: float) -> bool:
        """Whether a step is one of several that are taken before they are filled: that pays where they cost little."""
        return h > self.settings.ds_max and not self._exact and self.system.n <= _SMALL

    def inside(self, steps: Sequence[tuple[CurvePoint, CurvePoint]]) -> list[Interior | Refused]:
        """Return the points inside steps that follow each other, up to the first refused."""
        gaps = [Gap(a, b, count_inside(b.s - a.s, b.angle, self.settings)) for a, b in steps]
        fit = list(itertools.takewhile(lambda g: g.count <= MOST, gaps))
        if not fit:
            return [Refused(Why.CROWDED, "the step needs too many points inside")]
        if not any(g.count for g in fit):
            return [Interior([]) for _ in fit]
        own = any(self.index(g.old) is None for g in fit)  # every point inside is looked at
        if self._exact:
            self._interpolated *= _LONGER_INTERPOLATED
            return fill(self.system, fit, self.settings, exact=True, own=own)
        found = fill(self.system, fit, self.settings, exact=False, own=own)
        # a step without points inside tells nothing of interpolated matrices, even where it is refused
        limits = [self._limit(g, inside) for g, inside in zip(fit, found, strict=False) if g.count]
        self._interpolated = min(limits, default=self._interpolated)
        again = isinstance(found[0], Refused) and fit[0].count > 0 and self._exact
        return fill(self.system, fit[:1], self.settings, exact=True, own=own) if again else found

    @staticmethod
    def _limit(gap: Gap, inside: Interior | Refused) -> float:
        """Return how long steps may be for interpolated matrices, as one step tells."""
        span = gap.new.s - gap.old.s
        return _SHORTER * span if isinstance(inside, Refused) else span * inside.growth_of_matrices()

    @property
    def _exact(self) -> bool:
        """Whether matrices of the points themselves are taken: interpolated ones would allow short steps only."""
        return self._interpolated < _WORTH * self.settings.ds_max

    def spans(self, old: CurvePoint, new: CurvePoint, inside: Interior) -> list[tuple[int, int]]:
        """Return the pairs of a step's points, by their indices, between which special points are to be looked for.

        Where the ends tell the number of unstable eigenvalues of all points, those are told it, and only pairs in which
        the curve changes remain. Where they do not, pairs lie as far apart as points would without long steps.
        """
        before, after, last = self.index(old), self.index(new), len(inside.points) + 1
        changed = [(i, i + 1) for i in inside.changed]
        if before is not None and before == after and not changed:
            turn = last
        elif before is not None and after is not None and abs(after - before) == 1 == len(changed):
            turn = changed[0][1]
        else:
            return self._apart(new.s - old.s, new.angle, inside.changed, last)
        for i, p in enumerate(inside.points, 1):
            count = before if i < turn else after
            NEGATIVE.put(p, count)
            COUNT.put(p, count)
        return changed

    def _apart(self, length: float, angle: float, changed: list[int], last: int) -> list[tuple[int, int]]:
        """Return pairs of indices 0 .. last as far apart as points asked for, each change in a pair of its own."""
        count = math.ceil(max(length / self.settings.ds_max, angle / self.settings.angle) - 0.1)
        marks = {round(k * last / count) for k in range(count + 1)} if count > 1 else {0, last}
        for i in changed:
            marks |= {i, i + 1}
        return list(itertools.pairwise(sorted(marks)))

    def next(self, h: float, new: CurvePoint, inside: Interior) -> float:
        """Return the next step."""
        grown = next_step(h, new, self.far, _GROWTH)
        if inside.points:
            grown = min(grown, h * inside.growth())
        if not self._exact:
            grown = min(grown, self._interpolated)
        self._longest = min(self._longest * _LONGER, self.far.ds_max)
        return min(grown, self._longest)

    def refused(self, h: float) -> None:
        """Remember that a step was too long."""
        self._longest = max(_SHORTER * h, self.settings.ds)
