"""Multipliers that pass the unit circle on a curve of orbits: PD and NS, and several that pass together.

What is counted is how many resolved multipliers lie outside, and how many of these are real and negative; so two that
pass -1 together are seen, where det(M + I) only touches zero. A step is halved until one multiplier, or one pair,
passes in each piece; that is followed to its own defining system. Pieces that do not come apart hold several that pass
together, as a symmetry or a strong resonance has it: such a point is where the mean of their log |mu| vanishes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from mjcont.numerics.equations.newton import Corrected
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.defining import PeriodDoubling, Torus
from mjcont.numerics.orbits.detectors import BranchOfCycles, FoldOfCycles, located
from mjcont.numerics.orbits.points import multipliers_at
from mjcont.numerics.points.events import (
    Detector,
    Found,
    Located,
    approximate,
    bisect,
    point_at,
    within,
    zero_fraction,
)
from mjcont.numerics.step.arclength import BEFORE, CurvePoint, advance

# farther outside the circle than rounding of multipliers that stay on it
ON_CIRCLE = 1e-7
# how near to -1 or 1 a pair may pass to count as passing there, rad; how near a resonance is named
_ON_AXIS, _RESONANT = 1e-6, 1e-3
# pieces shorter than this are not halved; what is nearer than this to a fold is that fold's own multiplier
_TOGETHER, _OWN = 1e-6, 1e-5
# imaginary parts below this are rounding of a double real multiplier
_REAL = 1e-5
_UNSEEN = Refused(Why.CROWDED_POINTS, "multipliers pass the unit circle and no point is found where they do")
_RESONANCES = {1: 0.0, 2: math.pi, 3: 2.0 * math.pi / 3.0, 4: math.pi / 2.0}
Piece = tuple[CurvePoint, CurvePoint]


@dataclass(slots=True)
class Crossing:
    """PD and NS: resolved multipliers pass the unit circle."""

    structural = False

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> tuple[int, int]:
        """Return how many resolved multipliers lie outside, and how many of these are real and negative."""
        outside = _outside(point)
        return len(outside), int(np.count_nonzero((outside.imag == 0.0) & (outside.real < 0.0)))

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether another number lies outside, one passed -1 while another came back, or one may have been outside."""
        return self._differs(old, new) or _peak(old, new) is not None

    def _differs(self, old: CurvePoint, new: CurvePoint) -> bool:
        (a, p), (b, q) = self.value(old), self.value(new)
        return a != b or (p - q) % 2 == 1

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the points at which multipliers pass, but for those that folds and branch points account for."""
        places = [e.point.s for e in found if e.kind in ("LPC", "BPC")]
        results = list[Located]()
        for piece in self._pieces(old, new, _peak(old, new)):
            explained = [s for s in places if piece[0].s - _OWN <= s <= piece[1].s + _OWN]
            result = self._in(piece, len(explained))
            if isinstance(result, Refused):
                return result
            results += [] if result is None else [result]
        return Found(results)

    def _pieces(self, old: CurvePoint, new: CurvePoint, at: float | None = None) -> list[Piece]:
        """Return the pieces of a step in which something passes: one multiplier or pair, or several together."""
        if at is None and not self._differs(old, new):
            return []
        if at is None and (self._one_passes(old, new) or new.s - old.s < _TOGETHER):
            return [(old, new)]
        middle = advance(self.system, old, (0.5 if at is None else at) * (new.s - old.s), self.settings)
        if isinstance(middle, Refused):
            return [(old, new)] if self._differs(old, new) else []
        return self._pieces(old, middle) + self._pieces(middle, new)

    def _one_passes(self, old: CurvePoint, new: CurvePoint) -> bool:
        (a, p), (b, q) = self.value(old), self.value(new)
        if abs(a - b) == 2:
            few, many = (old, new) if a < b else (new, old)
            extra = _changed(few, many)
            return bool((np.abs(extra.imag) > _REAL).all()) and (p - q) % 2 == 0
        return abs(a - b) == 1 and abs(p - q) <= 1

    def _in(self, piece: Piece, explained: int) -> Located | Refused | None:
        """Return the point in a piece, None where what passes there is that of folds and branch points."""
        old, new = piece
        (a, p), (b, q) = self.value(old), self.value(new)
        if p == q and abs(a - b) == explained:
            return None
        if abs(a - b) == 1 or new.s - old.s >= _TOGETHER:
            result = bisect(self.system, old, new, self._differs, self._settle, self.settings)
            if result is not None:
                return result
        if abs(a - b) < 2:
            return _UNSEEN
        return _several(self.system, old, new, self.settings) or _UNSEEN

    def _settle(self, old: CurvePoint, new: CurvePoint) -> Located | Refused | None:
        near = approximate(self.system, old, new, _fraction(old, new), self.settings)
        mu = None if near.failure is not None else _nearest(near, self.system)
        if mu is None or (mu.imag == 0.0 and mu.real > 0.0):
            return None
        if mu.imag == 0.0:
            doubling = located(self.system, old, new, near, "PD", PeriodDoubling(near.local))
            return None if doubling is None else doubling[0]
        pair = located(self.system, old, new, near, "NS", Torus(near.local, abs(float(np.angle(mu)))))
        return None if pair is None else _with_angle(pair[0], float(pair[1][0]))


def _outside(point: CurvePoint) -> Array:
    """Return the resolved multipliers outside the circle."""
    m = multipliers_at(point).tested
    found: Array = m[np.abs(m) > 1.0 + ON_CIRCLE]
    return found


def _sizes(point: CurvePoint) -> Array:
    """Return log |mu| of the resolved multipliers, the largest first."""
    m = np.abs(multipliers_at(point).tested)
    found: Array = np.log(np.maximum(np.sort(m)[::-1], 1e-300))
    return found


def _changed(few: CurvePoint, many: CurvePoint) -> Array:
    """Return the multipliers that are outside at one point, and inside at another with fewer."""
    return _outside(many)[len(_outside(few)) :]


def _fraction(old: CurvePoint, new: CurvePoint) -> float:
    """Return where in a step a multiplier passes the circle."""
    a, b = _sizes(old), _sizes(new)
    i = min(int(np.count_nonzero(a > ON_CIRCLE)), int(np.count_nonzero(b > ON_CIRCLE)))
    if not i < min(len(a), len(b)):
        return 0.5
    return zero_fraction(float(a[i]), float(b[i]))


def _peak(old: CurvePoint, new: CurvePoint) -> float | None:
    """Return where in a step the multiplier nearest to the circle may turn beyond it, None where none does.

    A parabola through log |mu| at three points tells.
    """
    before = BEFORE.get(old)
    if before is None or not before.s < old.s < new.s:
        return None
    sizes = [_sizes(p) for p in (before, old, new)]
    counts = {len(s) for s in sizes} | {int(np.count_nonzero(s > ON_CIRCLE)) for s in sizes[1:]}
    if len({len(s) for s in sizes}) > 1 or not len(sizes[0]) or len(counts) > 2:
        return None
    outside = int(np.count_nonzero(sizes[1] > ON_CIRCLE))
    s = np.array([before.s, old.s, new.s])
    for i in (outside - 1, outside):  # the last outside, the first inside
        if not 0 <= i < len(sizes[0]):
            continue
        y = np.array([float(v[i]) for v in sizes])
        bend, slope, _ = np.polyfit((s - old.s) / (new.s - old.s), y, 2)
        at = -0.5 * slope / bend if bend else math.inf
        if 0.05 < at < 0.95 and (y[1] + 0.5 * slope * at) * y[1] < -ON_CIRCLE * abs(y[1]):
            return float(at)
    return None


def _nearest(near: Corrected, system: System) -> complex | None:
    """Return the multiplier nearest to the unit circle at a corrected point."""
    m = multipliers_at(_point(near, system)).tested
    if not len(m) or not np.isfinite(m).all():
        return None
    return complex(m[np.argmin(np.abs(np.log(np.maximum(np.abs(m), 1e-300))))])


def _point(near: Corrected, system: System) -> CurvePoint:
    return CurvePoint(near.x, near.y, np.zeros(system.n + system.k), 1.0, near.local, near.jac)


def _with_angle(found: Located, theta: float) -> Located | None:
    """Return a Neimark-Sacker point with its angle, None where that is of a point of another kind."""
    theta = abs(math.remainder(theta, 2.0 * math.pi))
    if theta < _ON_AXIS or math.pi - theta < _ON_AXIS:
        return None
    found.data.update(theta=theta, rotation=theta / (2.0 * math.pi))
    found.note = _resonance(theta)
    return found


def _several(system: System, old: CurvePoint, new: CurvePoint, settings: Settings) -> Located | None:
    """Return the point at which several multipliers pass together: the mean of their log |mu| vanishes there."""
    first, last = sorted((len(_outside(old)), len(_outside(new))))
    reached: dict[float, Corrected] = {}

    def mean(fraction: float) -> float:
        near = approximate(system, old, new, fraction, settings)
        if near.failure is not None:
            return math.nan
        reached[fraction] = near
        return float(_sizes(_point(near, system))[first:last].mean())

    a, b = (float(_sizes(p)[first:last].mean()) for p in (old, new))
    if not a * b < 0.0:
        return None
    try:
        at = float(brentq(lambda t: a if t <= 0.0 else b if t >= 1.0 else mean(t), 0.0, 1.0, xtol=1e-12))
    except ValueError:
        return None
    near = reached.get(at) or approximate(system, old, new, min(max(at, 1e-9), 1.0 - 1e-9), settings)
    s = within(system, old, new, near) if near.failure is None else None
    if s is None:
        return None
    few, many = (old, new) if len(_outside(old)) < len(_outside(new)) else (new, old)
    return _named(point_at(system, old, new, near, s), _changed(few, many), near.step)


def _named(point: CurvePoint, passing: Array, tolerance: float) -> Located:
    """Return the located point at which multipliers pass together, by the kind that these tell."""
    how = f"{len(passing)} multipliers pass together"
    if (np.abs(passing.imag) > _REAL).any():
        theta = float(np.abs(np.angle(passing)).mean())
        data: dict[str, Any] = {"theta": theta, "rotation": theta / (2.0 * math.pi)}
        resonance = _resonance(theta)
        return Located("NS", point, tolerance, True, data, f"{how}; {resonance}" if resonance else how)
    kind, where = ("PD", "-1") if passing.real.mean() < 0.0 else ("BPC", "1")
    return Located(kind, point, tolerance, False, {}, f"{len(passing)} multipliers pass {where} together")


def _resonance(theta: float) -> str:
    """Return the sentence that names a strong resonance."""
    for k, at in _RESONANCES.items():
        if abs(theta - at) < _RESONANT:
            return f"strong resonance 1:{k}"
    return ""


def cycle_detectors(system: System, settings: Settings) -> list[Detector]:
    """Return the detectors of a curve of orbits, the one that guards against other branches first."""
    return [BranchOfCycles(system, settings), FoldOfCycles(system, settings), Crossing(system, settings)]
