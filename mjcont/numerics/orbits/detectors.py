"""Folds and branch points on a curve of orbits: LPC and BPC (`passing` has PD and NS).

A fold is told by the tangent, a branch point by the orientation of the curve. What is told is followed to its own
defining system and counts when it is found within its step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.newton import Corrected, known_to, solve
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Condition, System
from mjcont.numerics.orbits.defining import CycleBranch, CycleFold
from mjcont.numerics.points.events import (
    ByOrientation,
    Found,
    Located,
    approximate,
    bisect,
    point_at,
    within,
    zero_fraction,
)
from mjcont.numerics.points.on_equilibria import square_system
from mjcont.numerics.step.arclength import CurvePoint

# as for equilibria: an unfolding larger than the first is no error of location, the second vanishes with its square
_IMPERFECT, _UNFOLDED = 1e-8, 1e-12
# along a vertical family the parameter does not move, but for rounding
_VERTICAL = 1e-9
_OTHER_BRANCH = Refused(Why.OTHER_BRANCH, "the orientation changes without a branch point: another branch is near")


@dataclass(slots=True)
class FoldOfCycles:
    """LPC: the free parameter turns."""

    structural = True

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> float:
        """Return the tangent's component along the parameter."""
        return float(point.tangent[self.system.n])

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether it changes sign."""
        a, b = self.value(old), self.value(new)
        return max(abs(a), abs(b)) > _VERTICAL and (a * b < 0.0 or (a == 0.0) != (b == 0.0))

    def _settle(self, old: CurvePoint, new: CurvePoint) -> Located | Refused | None:
        near = approximate(self.system, old, new, zero_fraction(self.value(old), self.value(new)), self.settings)
        if near.failure is not None:
            return None
        found = located(self.system, old, new, near, "LPC", CycleFold(near.local))
        return None if found is None else found[0]

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the fold between the points; a branch point at which another branch turns is none."""
        if any(e.kind == "BPC" for e in found):
            return Found()
        result = bisect(self.system, old, new, self.crossed, self._settle, self.settings)
        return Found() if result is None else Found([result])


class BranchOfCycles(ByOrientation):
    """BPC: the curve's orientation changes; where it does so without a branch point a shorter step is asked for."""

    def _settle(self, old: CurvePoint, new: CurvePoint) -> Located | Refused | None:
        near = approximate(self.system, old, new, 0.5, self.settings)
        if near.failure is not None:
            return None
        condition = CycleBranch(near.local, self.system.free[0])
        both = located(self.system, old, new, near, "BPC", condition)
        if both is None:
            return None
        found, unfolding = both[0], abs(float(both[1][0]))
        if unfolding > _IMPERFECT:
            return _OTHER_BRANCH
        slope = self.system.free[0].slope(float(found.point.y[0]))
        found.data["tangent"] = found.point.tangent * np.append(self.system.problem.state_scale, slope)
        return found if unfolding <= _UNFOLDED else None

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the branch point between the points."""
        result = bisect(self.system, old, new, self.crossed, self._settle, self.settings)
        if result is None and old.sign * new.sign < 0:
            return _OTHER_BRANCH
        return Found() if result is None else Found([result])


def located(
    system: System, old: CurvePoint, new: CurvePoint, near: Corrected, kind: str, condition: Condition
) -> tuple[Located, Array] | None:
    """Return the point of a kind that a corrected point is near to, if it lies between two points of the curve.

    Beside it stand the auxiliary unknowns of its condition.
    """
    full, y = square_system(system, [condition], near)
    c = solve(full, near.x, y)
    s = within(system, old, new, c) if c.failure is None else None
    if s is None:
        return None
    return Located(kind, point_at(system, old, new, c, s), known_to(full, c), True, {}), c.y[system.k :]
