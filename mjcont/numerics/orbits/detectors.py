"""Special points on a curve of orbits: LPC, PD, NS and BPC.

A fold is told by the tangent, a branch point by the orientation of the curve, and whatever passes the unit circle by
the number of resolved multipliers outside, so that two that pass -1 together are seen, too. What is told is followed
to its own defining system and counts when it is found within its step.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.numerics.equations.newton import Corrected, solve
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Condition, System
from mjcont.numerics.orbits.defining import CycleBranch, CycleFold, PeriodDoubling, Torus
from mjcont.numerics.orbits.points import multipliers_at
from mjcont.numerics.points.events import Detector, Found, Located, approximate, bisect, point_at, within, zero_fraction
from mjcont.numerics.points.on_equilibria import square_system
from mjcont.numerics.step.arclength import CurvePoint

# as for equilibria: an unfolding larger than the first is no error of location, the second vanishes with its square
_IMPERFECT, _UNFOLDED = 1e-8, 1e-12
# how near to -1 or 1 a multiplier of a pair may be to count as passing there, rad; how near a resonance is named
_ON_AXIS, _RESONANT = 1e-3, 1e-3
# along a vertical family the parameter does not move, and multipliers stay at 1, but for rounding
_VERTICAL, _ON_CIRCLE = 1e-9, 1e-7
_OTHER_BRANCH = Refused(Why.OTHER_BRANCH, "the orientation changes without a branch point: another branch is near")
_UNSEEN = Refused(Why.CROWDED_POINTS, "multipliers pass the unit circle and no point is found where they do")
_RESONANCES = {1: 0.0, 2: math.pi, 3: 2.0 * math.pi / 3.0, 4: math.pi / 2.0}


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
        return None if near.failure is not None else located(self.system, old, new, near, "LPC", CycleFold(near.local))

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the fold between the points; a branch point at which another branch turns is none."""
        if any(e.kind == "BPC" for e in found):
            return Found()
        result = bisect(self.system, old, new, self.crossed, self._settle, self.settings)
        return Found() if result is None else Found([result])


@dataclass(slots=True)
class BranchOfCycles:
    """BPC: the curve's orientation changes; where it does so without a branch point a shorter step is asked for."""

    structural = True

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> float:
        """Return the orientation."""
        return point.sign

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether it changes."""
        return old.sign != new.sign

    def _settle(self, old: CurvePoint, new: CurvePoint) -> Located | Refused | None:
        near = approximate(self.system, old, new, 0.5, self.settings)
        if near.failure is not None:
            return None
        condition = CycleBranch(near.local, self.system.free[0])
        found = located(self.system, old, new, near, "BPC", condition)
        if found is None:
            return None
        unfolding = abs(float(found.data.pop("unfolding")))
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


@dataclass(slots=True)
class Crossing:
    """PD and NS: resolved multipliers pass the unit circle."""

    structural = False

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> tuple[int, int]:
        """Return how many resolved multipliers lie outside, and how many of these are real and negative."""
        m = multipliers_at(point).tested
        outside = m[np.abs(m) > 1.0 + _ON_CIRCLE]
        return len(outside), int(np.count_nonzero((outside.imag == 0.0) & (outside.real < 0.0)))

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether another number lies outside, or one passed -1 while another came back."""
        (a, p), (b, q) = self.value(old), self.value(new)
        return a != b or (p - q) % 2 == 1

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the points at which multipliers pass, but for those that folds and branch points account for."""
        (a, p), (b, q) = self.value(old), self.value(new)
        through_one = sum(e.kind in ("LPC", "BPC") for e in found)
        if (p - q) % 2 == 0 and abs(a - b) <= through_one and (abs(a - b) - through_one) % 2 == 0:
            return Found()
        if through_one:  # two kinds of points in one step: each gets its own
            return Refused(Why.CROWDED_POINTS, "several points lie in one step") if new.s - old.s > 1e-6 else Found()
        result = bisect(self.system, old, new, self.crossed, self._settle, self.settings)
        return _UNSEEN if result is None else Found([result])

    def _settle(self, old: CurvePoint, new: CurvePoint) -> Located | Refused | None:
        fraction, _ = _passing(multipliers_at(old).tested, multipliers_at(new).tested)
        near = approximate(self.system, old, new, fraction, self.settings)
        if near.failure is not None:
            return None
        mu = _nearest(near, self.system)
        if mu is None:
            return None
        theta = abs(float(np.angle(mu)))
        if mu.imag == 0.0 and mu.real > 0.0:
            return None
        if mu.imag == 0.0:
            return located(self.system, old, new, near, "PD", PeriodDoubling(near.local))
        return located(self.system, old, new, near, "NS", Torus(near.local, theta))


def _passing(before: Array, after: Array) -> tuple[float, complex]:
    """Return where between two points a multiplier passes the unit circle, as a fraction, and which."""
    outside = [m[np.abs(m) > 1.0 + _ON_CIRCLE] for m in (before, after)]
    few, many, start = (before, after, 0.0) if len(outside[0]) <= len(outside[1]) else (after, before, 1.0)
    sizes = np.log(np.maximum(np.abs(many), 1e-300))
    others = np.log(np.maximum(np.abs(few), 1e-300))
    over, under = sizes[sizes > _ON_CIRCLE], others[others <= _ON_CIRCLE]
    if not (len(over) and len(under)):
        return 0.5, complex(many[0])
    a, b = float(under.max()), float(over.min())
    fraction = zero_fraction(a, b)
    return (fraction if start == 0.0 else 1.0 - fraction), complex(many[np.argmin(np.where(sizes > 0, sizes, np.inf))])


def _nearest(near: Corrected, system: System) -> complex | None:
    """Return the multiplier nearest to the unit circle at a corrected point."""
    point = CurvePoint(near.x, near.y, np.zeros(system.n + system.k), 1.0, near.local, near.jac)
    m = multipliers_at(point).tested
    if not len(m) or not np.isfinite(m).all():
        return None
    return complex(m[np.argmin(np.abs(np.log(np.maximum(np.abs(m), 1e-300))))])


def located(
    system: System, old: CurvePoint, new: CurvePoint, near: Corrected, kind: str, condition: Condition
) -> Located | None:
    """Return the point of a kind that a corrected point is near to, if it lies between two points of the curve."""
    full, y = square_system(system, [condition], near)
    c = solve(full, near.x, y)
    s = within(system, old, new, c) if c.failure is None else None
    if s is None:
        return None
    point = point_at(system, old, new, c, s)
    data: dict[str, Any] = {}
    note = ""
    if kind == "BPC":
        data["unfolding"] = float(c.y[system.k])
    if kind == "NS":
        theta = abs(math.remainder(float(c.y[system.k]), 2.0 * math.pi))
        if theta < _ON_AXIS or (math.pi - theta < 1e-8):
            return None
        data["theta"], data["rotation"] = theta, theta / (2.0 * math.pi)
        note = _resonance(theta)
    return Located(kind, point, c.step, True, data, note)


def _resonance(theta: float) -> str:
    """Return the sentence that names a strong resonance."""
    for k, at in _RESONANCES.items():
        if abs(theta - at) < _RESONANT:
            return f"strong resonance 1:{k}"
    return ""


def cycle_detectors(system: System, settings: Settings) -> list[Detector]:
    """Return the detectors of a curve of orbits, the one that guards against other branches first."""
    return [BranchOfCycles(system, settings), FoldOfCycles(system, settings), Crossing(system, settings)]
