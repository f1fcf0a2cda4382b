"""Detectors on a curve of equilibria: folds, branch points, Hopf points, user zeros."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.defining import BranchPoint, Fold, Hopf
from mjcont.numerics.equations.newton import Corrected, known_to, solve
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.points import normalform
from mjcont.numerics.points.events import (
    ByOrientation,
    Found,
    Located,
    ScalarZero,
    Solved,
    ZeroDetector,
    approximate,
    bisect,
    point_at,
    within,
    zero_fraction,
)
from mjcont.numerics.spectra.large import nearest
from mjcont.numerics.spectra.spectrum import Spectrum
from mjcont.numerics.spectra.stability import local_spectrum, negative_stiffness, spectrum_of
from mjcont.numerics.step.arclength import CurvePoint, advance
from mjcont.numerics.step.turning import turning_fraction

_NOT_TRANSVERSE = 1e-6
# the unfolding of a true branch point vanishes with the square of the error of its location, down to the rounding of f:
# below the first it counts; below the second where nothing else is found, as between two branch points beside the curve
_UNFOLDED, _NEARLY = 1e-14, 1e-12
# an unfolding larger than this is no error of location
_IMPERFECT = 1e-8
_OTHER_BRANCH = Refused(Why.OTHER_BRANCH, "the orientation changes without a branch point: another branch is near")
_CLOSE = 1e-6
_BRACKET = 1e-9
# where in a step it is asked whether an oscillation without damping at its end is one beside it, too
_JUST_INSIDE = 0.1
# the zero eigenvalue of a fold is a double one where w . v is this small a part of |w| |v|
_DOUBLE = 1e-5
# eigenvalues of a large sparse matrix about a frequency among which a pair on the axis is sought
_ABOUT = 6


def square_system(system: System, conditions: Sequence[Any], at: Corrected) -> tuple[System, Array]:
    """Return the accurate system with `conditions` added at a corrected point, and its start y."""
    base = system.values(at.y)
    full = System(system.problem, base, system.free, (*system.conditions, *conditions), accurate=True)
    extra = [a for c in conditions for a in c.aux]
    return full, np.concatenate([at.y, extra])


class BranchPointDetector(ByOrientation):
    """Simple branch points, by the sign of det [G_z; t]; a change with no point behind it asks for a shorter step."""

    def _settle(
        self, old: CurvePoint, new: CurvePoint, unfolded: float, nearly: list[float]
    ) -> Located | Refused | None:
        near = approximate(self.system, old, new, 0.5, self.settings)
        if near.failure is not None:
            return None
        condition = BranchPoint(near.local, self.system.free[0])
        full, y = square_system(self.system, [condition], near)
        c = solve(full, near.x, y)
        s = within(self.system, old, new, c) if c.failure is None else None
        if s is None:
            return None
        unfolding = abs(float(c.y[self.system.k]))
        if unfolding > _IMPERFECT:  # two branches pass each other here: halving the bracket finds the same
            return _OTHER_BRANCH
        if unfolding > unfolded:
            nearly += [unfolding] if unfolding <= _NEARLY else []
            return None
        kernel, w = condition.null(c.local)
        slope = self.system.free[0].slope(float(c.y[0]))
        crossing = normalform.crossing(c.local, kernel, w, slope)
        point = point_at(self.system, old, new, c, s)
        data: dict[str, Any] = {"type": crossing.kind, "tangents": np.array(crossing.tangents), "w": w}
        if crossing.kind == "pitchfork":
            data["c"] = normalform.pitchfork_coefficient(c.local, w)
            data["type"] = f"{'super' if data['c'] < 0 else 'sub'}critical pitchfork"
        return Located("BP", point, known_to(full, c), True, data)

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the branch point between the points.

        Refused if the orientation changes without one. Where it vanishes a matrix is singular by chance.
        """
        nearly, result = list[float](), None
        for unfolded in (_UNFOLDED, _NEARLY):
            if result is None and (unfolded == _UNFOLDED or nearly):
                settle = partial(self._settle, unfolded=unfolded, nearly=nearly)
                result = bisect(self.system, old, new, self.crossed, settle, self.settings)
        if result is None and old.sign * new.sign < 0:
            return _OTHER_BRANCH
        return Found() if result is None else Found([result])


def _balanced(system: System, fold: Fold, c: Corrected) -> Corrected:
    """Return a fold with the parameter at which w . f = 0 for its state as it stands.

    Rounding of the state loads stiff bushes with about 1e-16 k; the left null vector, a motion of the mechanism that
    leaves the pins closed, does not feel those forces.
    """
    if c.failure is not None:
        return c
    _, w = fold.physical(c.local)
    slope = float(w @ c.local.par[:, 0]) * system.free[0].slope(float(c.y[0]))
    shift = -float(w @ c.local.f) / slope if slope else 0.0
    if not abs(shift) < 1e-6:
        return c
    y = c.y.copy()
    y[0] += shift
    return replace(c, y=y)


def fold_detector(system: System, settings: Settings) -> ZeroDetector:
    """Return the detector of folds: the tangent's parameter component changes sign."""

    def test(point: CurvePoint) -> float:
        return float(point.tangent[system.n])

    def solve_fold(near: Corrected) -> Solved:
        fold = Fold(near.local)
        full, y = square_system(system, [fold], near)
        return _balanced(full, fold, solve(full, near.x, y)), full

    def finish(c: Corrected, full: System) -> tuple[dict[str, Any], str] | None:
        (fold,) = full.conditions
        assert isinstance(fold, Fold)
        v, w = fold.physical(c.local)
        f_p = c.local.par[:, 0]
        if abs(w @ f_p) <= _NOT_TRANSVERSE * (np.abs(w) @ np.abs(f_p)):
            return None
        v = oriented(v / np.linalg.norm(v))
        if not abs(w @ v) > _DOUBLE * np.linalg.norm(w):
            w = w / np.linalg.norm(w)
            return {"a": math.nan, "v": v, "w": w}, "the eigenvalue zero is double: no coefficient a"
        w = w / (w @ v)
        a = normalform.fold_coefficient(c.local, v, w)
        return {"a": a, "v": v, "w": w}, ""

    def fraction(old: CurvePoint, new: CurvePoint) -> float:
        return turning_fraction(system, old, new, 0)

    return ZeroDetector("LP", system, test, solve_fold, finish, settings, structural=True, fraction=fraction)


@dataclass(slots=True)
class HopfDetector:
    """Hopf points, by the number of eigenvalue pairs with positive sum; neutral saddles are told apart."""

    structural = True

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> int:
        """Return the number of eigenvalue pairs with positive sum."""
        return spectrum_of(point).pair_count()

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether the count changes; symmetric K and C exclude it."""
        return not self._excluded(old, new) and self._differs(old, new)

    @staticmethod
    def _excluded(old: CurvePoint, new: CurvePoint) -> bool:
        if negative_stiffness(old) is not None and negative_stiffness(new) is not None:
            return True
        return spectrum_of(old).conservative and spectrum_of(new).conservative

    def _differs(self, old: CurvePoint, new: CurvePoint) -> bool:
        a, b = spectrum_of(old), spectrum_of(new)
        return a.pairs_passing(b) > 0 or abs(a.n_unstable - b.n_unstable) > 1

    def _settle(self, old: CurvePoint, new: CurvePoint) -> Located | None:
        near = approximate(self.system, old, new, self._fraction(old, new), self.settings)
        if near.failure is not None:
            return None
        square = _square_between(near.local, spectrum_of(old), spectrum_of(new))
        if square is None:
            return None
        condition = Hopf(near.local, square)
        full, y = square_system(self.system, [condition], near)
        c = solve(full, near.x, y)
        if c.failure is not None:
            return None
        s = within(self.system, old, new, c)
        if s is None:
            return None
        point = point_at(self.system, old, new, c, s)
        square = condition.square(c.y[self.system.k :])
        if square <= 0:
            return Located("NS", point, c.step, True, {"square": square})
        omega = float(np.sqrt(square))
        found = normalform.lyapunov(self.system.problem, c.x, c.local.values, omega)
        l1 = found.l1
        kind = "degenerate" if l1 == 0.0 or math.isnan(l1) else "supercritical" if l1 < 0 else "subcritical"
        note = "" if found.known else f"l1 is known to {found.error / abs(l1):.0e} of itself only"
        return Located("HB", point, known_to(full, c), True, {"omega": omega, "l1": l1, "type": kind}, note)

    @staticmethod
    def _fraction(old: CurvePoint, new: CurvePoint) -> float:
        a, b = critical_sum(spectrum_of(old)), critical_sum(spectrum_of(new))
        return zero_fraction(a, b) if a * b < 0 else 0.5

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the Hopf points between the points; several are separated by bisection."""
        difference = spectrum_of(old).pairs_passing(spectrum_of(new))
        if difference == 0 and new.s - old.s <= _CLOSE:
            return Found()
        if difference != 1 and new.s - old.s > _CLOSE:  # several points here, or a Hopf point and a neutral saddle
            middle = advance(self.system, old, 0.5 * (new.s - old.s), self.settings)
            if not isinstance(middle, Refused):
                return self._halves(old, middle, new, found)
        if self._undamped(old, new, _JUST_INSIDE) or self._undamped(new, old, 1.0 - _JUST_INSIDE):
            return Found([self._meeting(old, new)])
        result = bisect(self.system, old, new, self._differs, self._settle, self.settings)
        if result is None:
            return Found()
        if difference > 1 and not spectrum_of(old).complete:
            result.note = f"{difference} pairs of eigenvalues reach the axis here together: l1 is that of one motion"
        return Found((), [result]) if result.kind == "NS" else Found([result])

    def _halves(
        self, old: CurvePoint, middle: CurvePoint, new: CurvePoint, found: Sequence[Located]
    ) -> Found | Refused:
        """Return the Hopf points of both halves of a step."""
        every = Found()
        for a, b in ((old, middle), (middle, new)):
            here = self.locate(a, b, found) if self._differs(a, b) else Found()
            if isinstance(here, Refused):
                return here
            every = Found([*every.located, *here.located], [*every.neutral, *here.neutral])
        return every

    def _undamped(self, end: CurvePoint, other: CurvePoint, fraction: float) -> bool:
        """Whether a complex pair lies on the axis at one end of a step and beside it: no Hopf condition singles it out.

        At one end alone it is a Hopf point on which a point of the curve happens to lie.
        """
        if not _on_axis(spectrum_of(end)):
            return False
        old, new = (end, other) if end.s < other.s else (other, end)
        beside = approximate(self.system, old, new, fraction, self.settings)
        return beside.failure is None and _on_axis(local_spectrum(beside.local))

    def _meeting(self, old: CurvePoint, new: CurvePoint) -> Located:
        """Return where undamped pairs meet and leave the axis, bracketed."""
        while new.s - old.s > _BRACKET:
            middle = advance(self.system, old, 0.5 * (new.s - old.s), self.settings)
            if isinstance(middle, Refused) or not old.s < middle.s < new.s:
                break
            old, new = (old, middle) if self._differs(old, middle) else (middle, new)
        omega = _frequency(critical_pair(spectrum_of(old)) or (0.0, 0.0))
        data = {"omega": omega, "type": "degenerate"}
        return Located("HB", new, new.s - old.s, False, data, "undamped oscillations meet here: bracketed only")


def _square_between(local: Local, one: Spectrum, other: Spectrum) -> float | None:
    """Return omega^2 of the pair that passes the axis at an evaluation between two points with their spectra.

    Where not all eigenvalues are known the pair is sought where it is unstable, on the axis beside it.
    """
    if one.complete and other.complete:
        return critical_square(local_spectrum(local))
    told = max(one, other, key=lambda s: s.n_unstable)
    pairs = told.eigenvalues[(told.eigenvalues.imag > 0) & (told.eigenvalues.real > told.noise)]
    if not len(pairs):
        return critical_square(local_spectrum(local))
    return square_near(local, float(pairs[np.argmin(pairs.real)].imag))


def square_near(local: Local, omega: float) -> float | None:
    """Return omega^2 of the pair of a sparse matrix that is nearest the axis among those about a frequency."""
    found = nearest(local.raw_jac, 1j * omega, _ABOUT)
    pairs = found[found.imag > 0]
    return float(abs(pairs[np.argmin(np.abs(pairs.real))]) ** 2) if len(pairs) else None


def _on_axis(s: Spectrum) -> bool:
    """Whether a complex pair lies on the axis as far as can be told."""
    return bool(np.any((s.eigenvalues.imag > 0) & (np.abs(s.eigenvalues.real) <= s.noise)))


def critical_pairs(s: Spectrum) -> list[tuple[float, float]]:
    """Return (sum, product) of every complex pair and of every two real eigenvalues."""
    ev = s.eigenvalues
    pairs = [(2.0 * float(e.real), float(abs(e) ** 2)) for e in ev if e.imag > 0]
    real = [float(e.real) for e in ev if e.imag == 0]
    pairs += [(a + b, a * b) for i, a in enumerate(real) for b in real[:i]]
    return pairs


def critical_pair(s: Spectrum) -> tuple[float, float] | None:
    """Return (sum, product) of the pair whose sum is nearest zero, relative to its size."""
    pairs = critical_pairs(s)
    return min(pairs, key=lambda p: abs(p[0]) / max(abs(p[1]) ** 0.5, 1e-12)) if pairs else None


def _frequency(pair: tuple[float, float]) -> float:
    """Return the imaginary part of a complex pair given by sum and product, zero for a real one."""
    return float(np.sqrt(max(pair[1] - 0.25 * pair[0] * pair[0], 0.0)))


def critical_square(s: Spectrum) -> float | None:
    """Return the product of the critical pair: omega^2 of a Hopf point."""
    pair = critical_pair(s)
    return None if pair is None else pair[1]


def critical_sum(s: Spectrum) -> float:
    """Return the sum of the critical pair."""
    pair = critical_pair(s)
    return 0.0 if pair is None else pair[0]


def zero_detector(
    system: System, monitor: Callable[[Array, Values], float], name: str, settings: Settings
) -> ZeroDetector:
    """Return the detector of user zeros of a monitor function."""

    def test(point: CurvePoint) -> float:
        return monitor(point.x, system.values(point.y))

    def solve_zero(near: Corrected) -> Solved:
        full, y = square_system(system, [ScalarZero(monitor)], near)
        return solve(full, near.x, y), full

    return ZeroDetector("UZ", system, test, solve_zero, lambda c, full: ({"monitor": name}, ""), settings)
