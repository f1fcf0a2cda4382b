"""Special points of families of orbits that keep an energy: internal resonances (IR), and folds told by the energy.

Multipliers of stable orbits lie on the unit circle. Where a pair passes exp(+-2 pi i p / k), another mode swings
p / k times, or a whole number more or less, in a period: an internal resonance, at which orbits of k periods begin
(`switch`). Where the energy turns a pair passes 1, whatever the family is followed in.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.newton import Corrected
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.conserved import ENERGY, ConservedOrbits, blur
from mjcont.numerics.orbits.defining import PeriodDoubling
from mjcont.numerics.orbits.detectors import BranchOfCycles, FoldOfCycles, located
from mjcont.numerics.orbits.points import multipliers_at, orbits_at, path_at
from mjcont.numerics.points.events import Detector, Found, Located
from mjcont.numerics.step.arclength import CurvePoint, advance
from mjcont.numerics.step.notes import Note

ORDERS = (3, 4)
# how small an imaginary part is rounding
_REAL = 1e-6
# places are known to this part of a step
_PLACE = 1e-10
SLOPE = Note[float]()


def angles(point: CurvePoint) -> Array:
    """Return the angles of the resolved pairs on the unit circle, the smallest first, rad."""
    m = multipliers_at(point).tested
    m = m[(np.abs(np.abs(m) - 1.0) <= blur(m)) & (m.imag > 0.0)]
    return np.sort(np.angle(m))


def energy_slope(point: CurvePoint) -> float:
    """Return how the energy grows along the curve, with its arclength."""

    def find() -> float:
        orbits = orbits_at(point)
        assert isinstance(orbits, ConservedOrbits)
        slope = orbits.flow.energy_slopes(path_at(point).s[:1], point.local.values)[0]
        d = orbits.flow.d
        return float(slope @ (point.tangent[:d] * orbits.state_scale[:d]))

    return SLOPE.of(point, find)


def _zero_along(
    system: System, old: CurvePoint, new: CurvePoint, settings: Settings, read: Callable[[CurvePoint], float]
) -> tuple[CurvePoint, float] | None:
    """Return the point between two of a curve at which what is read vanishes, and to what it is known."""
    reached: dict[float, CurvePoint] = {0.0: old, 1.0: new}

    def at(fraction: float) -> float:
        if fraction not in reached:
            ahead = advance(system, old, fraction * (new.s - old.s), settings)
            if isinstance(ahead, Refused):
                raise ValueError
            reached[fraction] = ahead
        return read(reached[fraction])

    place = root(at, 0.0, 1.0, _PLACE)
    if not math.isfinite(place):
        return None
    nearest = min(reached, key=lambda f: abs(f - place))
    return reached[nearest], max(_PLACE * (new.s - old.s), settings.tol**2)


@dataclass(slots=True)
class EnergyTurns:
    """LPC on a family followed in frequency: its energy turns."""

    structural = False

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> float:
        """Return how the energy grows along the curve."""
        return energy_slope(point)

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether it turns between two points."""
        return energy_slope(old) * energy_slope(new) < 0.0

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the point where it does."""
        if not self.crossed(old, new) or any(e.kind == "BPC" for e in found):
            return Found()
        there = _zero_along(self.system, old, new, self.settings, energy_slope)
        return Found() if there is None else Found([Located("LPC", *there)])


@dataclass(slots=True)
class Leaving:
    """PD and NS: pairs leave the unit circle, one at -1, or two that meet elsewhere on it.

    Of a pair mu + 1 / mu is smooth where they meet, of two pairs the square of half the distance of log mu.
    """

    structural = False

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> tuple[int, int]:
        """Return how many multipliers outside the circle are real and negative, and how many pairs there are."""
        return len(_doubling(point)), len(_turning(point))

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether one of them left, or came back."""
        return self.value(old) != self.value(new)

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the points where they do."""
        del found
        (a, p), (b, q) = self.value(old), self.value(new)
        results = []
        if abs(a - b) == 1 and (there := _zero_along(self.system, old, new, self.settings, _at_minus_one)):
            near = Corrected(there[0].x, there[0].y, there[0].local, None, 0, 0.0, 0.0, 0.0)
            sharp = located(self.system, old, new, near, "PD", PeriodDoubling(near.local))
            results.append(Located("PD", *there) if sharp is None else sharp[0])
        if abs(p - q) == 1:
            theta = float(np.angle(_turning(new if q > p else old)[0]))
            meeting = _zero_along(self.system, old, new, self.settings, lambda point: _meeting(point, theta))
            if meeting is not None:
                results.append(Located("NS", *meeting, True, {"theta": theta}, "two pairs meet on the unit circle"))
        return Found(sorted(results, key=lambda e: e.point.s))


def _doubling(point: CurvePoint) -> Array:
    """Return the real negative multipliers outside the circle."""
    m = multipliers_at(point).tested
    found: Array = m[(np.abs(m) > 1.0 + blur(m)) & (np.abs(m.imag) < _REAL * np.abs(m)) & (m.real < 0.0)]
    return found


def _turning(point: CurvePoint) -> Array:
    """Return the complex multipliers outside the circle with positive imaginary parts, the largest first."""
    m = multipliers_at(point).tested
    found: Array = m[(np.abs(m) > 1.0 + blur(m)) & (m.imag > _REAL * np.abs(m))]
    return found


def _at_minus_one(point: CurvePoint) -> float:
    """Return the least mu + 1 / mu + 2 of the pairs on the circle or the real axis: smooth where one passes -1."""
    m = multipliers_at(point).tested
    sums = m + 1.0 / m
    sums = sums[np.abs(sums.imag) < _REAL * np.maximum(np.abs(sums), 1.0)].real
    if not len(sums):
        raise ValueError
    return float(sums.min() + 2.0)


def _meeting(point: CurvePoint, theta: float) -> float:
    """Return the square of half the distance of log mu of the two pairs that meet near an angle."""
    outside, on = _turning(point), angles(point)
    if len(outside):
        return float(np.log(np.abs(outside)).min() ** 2)
    if len(on) < 2:
        raise ValueError
    middles, gaps = 0.5 * (on[1:] + on[:-1]), np.diff(on)
    k = int(np.argmin(np.abs(middles - theta) + gaps))
    return -float((0.5 * gaps[k]) ** 2)


@dataclass(slots=True)
class InternalResonance:
    """IR: a pair passes a root of one, exp(2 pi i p / k) with k of the given orders."""

    structural = False

    system: System
    settings: Settings
    orders: Sequence[int] = ORDERS

    @property
    def _roots(self) -> list[tuple[int, int]]:
        return [(k, p) for k in self.orders for p in range(1, (k + 1) // 2) if math.gcd(k, p) == 1]

    def value(self, point: CurvePoint) -> tuple[int, ...]:
        """Return how many pairs there are on the circle, and of these how many on the side of 1 of each root."""
        found = angles(point)
        return len(found), *(int(np.count_nonzero(found < 2.0 * math.pi * p / k)) for k, p in self._roots)

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether a pair passes one."""
        a, b = self.value(old), self.value(new)
        return a[0] == b[0] and a != b

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the points where pairs do."""
        del found
        if not self.crossed(old, new):
            return Found()
        results = []
        for i, (k, p) in enumerate(self._roots, 1):
            first, last = sorted((self.value(old)[i], self.value(new)[i]))
            for pair in range(first, last):
                there = self._passing(old, new, pair, 2.0 * math.pi * p / k)
                if there is not None:
                    data = {"order": str(k), "turns": str(p)}
                    results.append(Located("IR", *there, True, data, f"orbits of {k} periods begin here"))
        return Found(sorted(results, key=lambda e: e.point.s))

    def _passing(self, old: CurvePoint, new: CurvePoint, pair: int, angle: float) -> tuple[CurvePoint, float] | None:
        count = self.value(old)[0]

        def read(point: CurvePoint) -> float:
            found = angles(point)
            if len(found) != count:
                raise ValueError
            return float(found[pair]) - angle

        return _zero_along(self.system, old, new, self.settings, read)


def family_detectors(system: System, settings: Settings, orders: Sequence[int] = ORDERS) -> list[Detector]:
    """Return the detectors of a family of orbits that keep an energy, for internal resonances of some orders."""
    folds = FoldOfCycles if system.free[0].name == ENERGY else EnergyTurns
    found: list[Detector] = [BranchOfCycles(system, settings), folds(system, settings), Leaving(system, settings)]
    return [*found, InternalResonance(system, settings, orders)] if orders else found
