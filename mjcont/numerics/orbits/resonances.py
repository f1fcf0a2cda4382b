"""Special points of families of orbits that keep an energy: internal resonances (IR), and folds told by the energy.

Multipliers of stable orbits lie on the unit circle. Where a pair passes exp(+-2 pi i / k), another mode swings 1 / k
times, or a whole number more or less, in a period: an internal resonance, at which orbits of k periods begin
(`switch`). Where the energy turns a pair passes 1, whatever the family is followed in.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.conserved import ConservedOrbits
from mjcont.numerics.orbits.points import multipliers_at, orbits_at, path_at
from mjcont.numerics.points.events import Found, Located
from mjcont.numerics.step.arclength import CurvePoint, advance
from mjcont.numerics.step.notes import Note

ORDERS = (3, 4)
# how far from the unit circle a multiplier counts as on it
_ON_CIRCLE = 1e-6
# places are known to this part of a step
_PLACE = 1e-13
SLOPE = Note[float]()


def angles(point: CurvePoint) -> Array:
    """Return the angles of the resolved pairs on the unit circle, the smallest first, rad."""
    m = multipliers_at(point).tested
    m = m[(np.abs(np.abs(m) - 1.0) < _ON_CIRCLE) & (m.imag > 0.0)]
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
class InternalResonance:
    """IR: a pair passes a third or a fourth root of one."""

    structural = False

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> tuple[int, ...]:
        """Return how many pairs there are on the circle, and of these how many on the side of 1 of each root."""
        found = angles(point)
        return len(found), *(int(np.count_nonzero(found < 2.0 * math.pi / k)) for k in ORDERS)

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
        for i, k in enumerate(ORDERS, 1):
            first, last = sorted((self.value(old)[i], self.value(new)[i]))
            for pair in range(first, last):
                there = self._passing(old, new, pair, 2.0 * math.pi / k)
                if there is not None:
                    results.append(Located("IR", *there, True, {"order": str(k)}, f"orbits of {k} periods begin here"))
        return Found(sorted(results, key=lambda e: e.point.s))

    def _passing(self, old: CurvePoint, new: CurvePoint, pair: int, angle: float) -> tuple[CurvePoint, float] | None:
        count = self.value(old)[0]

        def read(point: CurvePoint) -> float:
            found = angles(point)
            if len(found) != count:
                raise ValueError
            return float(found[pair]) - angle

        return _zero_along(self.system, old, new, self.settings, read)
