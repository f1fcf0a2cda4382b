"""Multipliers that pass the unit circle on a curve of orbits: PD and NS, and several that pass together.

What is counted is how many resolved multipliers lie outside, and how many of these are real and negative; so two that
pass -1 together are seen, where det(M + I) only touches zero. A step is halved until one multiplier, or one pair,
passes in each piece; that is followed to its own defining system. Pieces that do not come apart hold several that pass
together, as a symmetry or a strong resonance has it: such a point is where the mean of their log |mu| vanishes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.newton import Corrected, length
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.conserved import ConservedOrbits
from mjcont.numerics.orbits.defining import PeriodDoubling, Torus
from mjcont.numerics.orbits.detectors import BranchOfCycles, FoldOfCycles, located
from mjcont.numerics.orbits.forms import cubic_of_doubling, cubic_of_torus, side_of
from mjcont.numerics.orbits.points import multipliers_at
from mjcont.numerics.orbits.resonances import family_detectors
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
# a parameter that moves by less along the tangent turns there: the point is a fold itself, as a start may be
_TURNS = 1e-6
# sine of the angle of a pair below which its matrix is nearly singular twice
_AT_RESONANCE = 1e-3
# imaginary parts below this are rounding of a double real multiplier
_REAL = 1e-5
# around several that pass together: halvings of the step, part of it and number of orbits to interpolate from
_HALVINGS, _AROUND, _SAMPLES = 6, 0.1, 6
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
        places += [p.s for p in (old, new) if self._turns(p) and all(abs(p.s - s) > _OWN for s in places)]
        results = list[Located]()
        for piece in self._pieces(old, new, _peak(old, new)):
            explained = [s for s in places if piece[0].s - _OWN <= s <= piece[1].s + _OWN]
            result = self._in(piece, len(explained), (old, new))
            if isinstance(result, Refused):
                return result
            results += [] if result is None else [result]
        return Found(results)

    def _turns(self, point: CurvePoint) -> bool:
        """Whether a point is a fold, whose own multiplier is 1 but for rounding."""
        return abs(float(point.tangent[self.system.n])) <= _TURNS

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
        return _pair(old, new) or (abs(a - b) == 1 and abs(p - q) <= 1)

    def _in(self, piece: Piece, explained: int, step: Piece) -> Located | Refused | None:
        """Return the point in a piece of a step, None where what passes there is that of folds and branch points."""
        old, new = piece
        (a, p), (b, q) = self.value(old), self.value(new)
        if p == q and abs(a - b) == explained:
            return None
        if abs(a - b) == 1 or new.s - old.s >= _TOGETHER:
            settle = partial(self._pair_passes, step=step) if _pair(old, new) else self._one_doubles
            result = bisect(self.system, old, new, self._differs, settle, self.settings)
            if result is not None:
                return result
        if abs(a - b) < 2:
            return _UNSEEN
        return _several(self.system, old, new, self.settings, step) or _UNSEEN

    def _near(self, old: CurvePoint, new: CurvePoint) -> tuple[Corrected, complex] | None:
        near = approximate(self.system, old, new, _fraction(old, new), self.settings)
        mu = None if near.failure is not None else _nearest(near, self.system)
        return None if mu is None else (near, mu)

    def _one_doubles(self, old: CurvePoint, new: CurvePoint) -> Located | Refused | None:
        near = self._near(old, new)
        if near is None or near[1].imag != 0.0 or near[1].real > 0.0:
            return None
        found = located(self.system, old, new, near[0], "PD", PeriodDoubling(near[0].local))
        if found is None:
            return None
        found[0].data["type"] = side_of(cubic_of_doubling(found[0].point))
        return found[0]

    def _pair_passes(self, old: CurvePoint, new: CurvePoint, step: Piece) -> Located | Refused | None:
        near = self._near(old, new)
        if near is None:
            return None
        theta = abs(float(np.angle(near[1])))
        if math.sin(theta) < _AT_RESONANCE:
            return _several(self.system, old, new, self.settings, step)
        found = located(self.system, old, new, near[0], "NS", Torus(near[0].local, theta))
        return None if found is None else _with_angle(found[0], float(found[1][0]))


def _pair(old: CurvePoint, new: CurvePoint) -> bool:
    """Whether it is one complex pair that passes between two points."""
    few, many = sorted((old, new), key=lambda p: len(_outside(p)))
    passing = _changed(few, many)
    return len(passing) == 2 and bool((np.abs(passing.imag) > _REAL).all())


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
    found.data["type"] = side_of(cubic_of_torus(found.point, theta))
    found.note = _resonance(theta)
    return found


def _several(
    system: System, old: CurvePoint, new: CurvePoint, settings: Settings, step: Piece
) -> Located | None:
    """Return the point at which several multipliers pass together: the mean of their log |mu| vanishes there.

    The ends of the whole step tell better of what kind it is than those of the piece in which it lies. The curve's
    equations may be singular at the point itself: it is interpolated from orbits around it.
    """
    first, last = sorted((len(_outside(old)), len(_outside(new))))

    def at(fraction: float) -> tuple[float, Corrected] | None:
        near = approximate(system, old, new, fraction, settings)
        return None if near.failure is not None else (_mean(_point(near, system), first, last), near)

    low, high = 0.0, 1.0
    rises = _mean(old, first, last) < 0.0
    for _ in range(_HALVINGS):
        middle = at(0.5 * (low + high))
        if middle is None:
            break
        low, high = (0.5 * (low + high), high) if (middle[0] < 0.0) == rises else (low, 0.5 * (low + high))
    begin = min(max(0.5 * (low + high) - 0.5 * _AROUND, 0.0), 1.0 - _AROUND)
    places = begin + _AROUND * np.linspace(0.02, 0.98, _SAMPLES)
    seen = [(t, *found) for t in places.tolist() if (found := at(t)) is not None]
    if len(seen) < _SAMPLES - 2:
        return None
    means = np.array([m for _, m, _ in seen])
    if means[0] * means[-1] > 0.0:
        return None
    fractions = np.array([t for t, _, _ in seen])
    root = _root(fractions, means)
    inner = slice(1, -1)  # what leaving the outermost out changes is the error
    told = means[inner][0] * means[inner][-1] < 0.0
    doubt = abs(_root(fractions[inner], means[inner]) - root) if told else _AROUND
    known = max(doubt * length(system.difference(new.x, new.y, old.x, old.y)), settings.tol)
    x, y = (_interpolated(fractions, np.array(v), root) for v in zip(*((c.x, c.y) for _, _, c in seen), strict=True))
    c = Corrected(x, y, system.local(x, y), None, 0, 0.0, known, 0.0)
    c = replace(c, error=system.error(c.local, x, y))
    passing = max((_changed(*sorted(ends, key=lambda p: len(_outside(p)))) for ends in ((old, new), step)),
                  key=lambda m: float(np.abs(m.imag).max(initial=0.0)))
    there = multipliers_at(_point(c, system)).tested
    there = there[np.argsort(-np.abs(there), kind="stable")][first:last]
    s = within(system, old, new, c)
    return None if s is None else _named(point_at(system, old, new, c, s), passing, there, c.step)


def _mean(point: CurvePoint, first: int, last: int) -> float:
    """Return the mean of log |mu| of some of the resolved multipliers, the largest being the first."""
    return float(_sizes(point)[first:last].mean())


def _root(fractions: Array, means: Array) -> float:
    """Return where the polynomial through means vanishes between the outermost fractions."""
    return root(lambda t: float(_interpolated(fractions, means, t)), fractions[0], fractions[-1], 1e-14)


def _interpolated(places: Array, values: Array, at: float) -> Array:
    """Return the polynomial through values (k, ...) at places (k,), read at another."""
    apart = places[:, None] - places
    np.fill_diagonal(apart, 1.0)
    parts = np.tile(at - places, (len(places), 1)) / apart
    np.fill_diagonal(parts, 1.0)
    found: Array = np.tensordot(parts.prod(axis=1), values, axes=1)
    return found


def _named(point: CurvePoint, passing: Array, there: Array, tolerance: float) -> Located:
    """Return the located point at which multipliers pass together, by the kind that these tell beside it."""
    how = f"{len(passing)} multipliers pass together"
    if (np.abs(passing.imag) > _REAL).any():
        theta = float(np.abs(np.angle(there)).mean())
        data: dict[str, Any] = {"theta": theta, "rotation": theta / (2.0 * math.pi)}
        return Located("NS", point, tolerance, True, data, _resonance(theta) or how)
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
    if isinstance(system.problem, ConservedOrbits):
        return family_detectors(system, settings)
    return [BranchOfCycles(system, settings), FoldOfCycles(system, settings), Crossing(system, settings)]
