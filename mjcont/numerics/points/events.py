"""Special points along a curve: tests between two points, location on the defining system, verification.

A detector compares two successive points. A change is followed to the point itself by Newton on its own defining
system, started from a bracket that is bisected along the curve as often as needed; a point counts when it is found
within its bracket. A sign change with no point behind it (a pole, or another branch) does not count.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Protocol

import numpy as np

from mjcont.numerics.equations.newton import Corrected, correct, known_to
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Condition, Local, System
from mjcont.numerics.step.arclength import CurvePoint, advance
from mjcont.numerics.step.notes import Note

_MOST_BISECTIONS = 40
_OUTSIDE = 1e-6
# a test that grows by this while its sign change is bracketed has a pole there
_POLE = 3.0
# what remains of a test at a zero, in parts of its values at the ends of the step in which it is found
_VANISHES = 1e-3


@dataclass(slots=True)
class Located:
    """A special point found between two points of a curve.

    Attributes
    ----------
    kind : "LP", "HB", ...
    point : curve point there, on the same curve.
    tolerance : to what its place is known: the last Newton step on the defining system, or the noise of that.
    converged : whether the defining system was solved; otherwise the point is a guess from its bracket.
    data : coefficients and vectors by name.
    note : a sentence, where there is something to say.
    """

    kind: str
    point: CurvePoint
    tolerance: float
    converged: bool = True
    data: dict[str, Any] = field(default_factory=dict)
    note: str = ""


@dataclass(frozen=True, slots=True)
class Found:
    """What lies between two points of a curve: special points, and neutral saddles, which are none."""

    located: Sequence[Located] = ()
    neutral: Sequence[Located] = ()


class Detector(Protocol):
    """Finds points of one kind between two successive points of a curve: it reads a value at each, and changes nothing.

    Attributes
    ----------
    structural : whether nothing changes without a change of the curve's direction, orientation or stability.
    """

    structural: bool

    def value(self, point: CurvePoint) -> Hashable:
        """Return what is read at a point."""
        ...

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether what is read says that there is something between the points."""
        ...

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found | Refused:
        """Return the points there, or why the step is to be shorter.

        `found` are those of earlier detectors on the same step.
        """
        ...


def bisect(
    system: System,
    old: CurvePoint,
    new: CurvePoint,
    changed: Callable[[CurvePoint, CurvePoint], bool],
    settle: Callable[[CurvePoint, CurvePoint], Located | Refused | None],
    settings: Settings,
) -> Located | None:
    """Return what `settle` finds in a bracket, halving the bracket while it finds nothing.

    None if it never does, or is sure that there is nothing.
    """
    for _ in range(_MOST_BISECTIONS):
        result = settle(old, new)
        if result is not None:
            return None if isinstance(result, Refused) else result
        length = new.s - old.s
        if length < 1e-7:
            return None
        middle = advance(system, old, 0.5 * length, settings)
        if isinstance(middle, Refused):
            return None
        if changed(old, middle):
            new = middle
        else:
            old = middle
    return None


def within(system: System, old: CurvePoint, new: CurvePoint, c: Corrected) -> float | None:
    """Return the arclength of a solution if it lies on the piece of curve from old to new, else None."""
    x, y = c.x, c.y[: system.k]
    length = new.s - old.s
    chord = system.difference(new.x, new.y, old.x, old.y)
    step = system.difference(x, y, old.x, old.y)
    size = float(np.linalg.norm(chord))
    if not size > 0.0:
        return None
    along = float(step @ chord) / size
    aside = float(np.linalg.norm(step - along * chord / size))
    slack = _OUTSIDE * length + 1e-9 + 10.0 * min(c.step, 1e-6)
    if -slack <= along <= size + slack and aside <= 0.3 * length + 1e-9:
        return old.s + min(max(along / size, 0.0), 1.0) * length
    return None


def between(system: System, old: CurvePoint, new: CurvePoint, fraction: float) -> tuple[Array, Array, Array]:
    """Return a point at a fraction of the step, on the cubic through both points with their tangents, and a tangent."""
    h, t = new.s - old.s, fraction
    chord = system.difference(new.x, new.y, old.x, old.y)
    step = cubic(t, chord, h * old.tangent, h * new.tangent)
    tangent = (1.0 - t) * old.tangent + t * new.tangent
    x, y = system.move(old.x, old.y, step)
    return x, y, _unit(tangent, new.tangent)


def cubic(t: Any, chord: Array, first: Array, last: Array) -> Array:
    """Return the way to a place t from 0 to 1 along a chord, on the cubic with these slopes at its ends."""
    rest = 1.0 - t
    found: Array = t * t * (3.0 - 2.0 * t) * chord + t * rest * rest * first - t * t * rest * last
    return found


def _unit(vector: Array, otherwise: Array) -> Array:
    """Return a vector at length one, or another where it vanishes: halfway between opposite tangents."""
    size = np.linalg.norm(vector)
    return vector / size if size > 1e-8 else otherwise


def approximate(system: System, old: CurvePoint, new: CurvePoint, fraction: float, settings: Settings) -> Corrected:
    """Return a corrected point of the curve at about a fraction of the step."""
    x, y, tangent = between(system, old, new, fraction)
    return correct(system, x, y, tangent, None, replace(settings, tol=1e-6))


def guessed(system: System, old: CurvePoint, new: CurvePoint, fraction: float) -> Corrected:
    """Return the point at a fraction of a short step as it is interpolated."""
    x, y, _ = between(system, old, new, fraction)
    return Corrected(x, y, system.local(x, y), None, 0, 0.0, 0.0, np.inf)


def zero_fraction(a: float, b: float) -> float:
    """Return where a linear function with values a, b at 0, 1 vanishes, kept off the ends."""
    fraction = a / (a - b) if a != b else math.nan
    return min(max(fraction, 0.02), 0.98) if math.isfinite(fraction) else 0.5


def point_at(system: System, old: CurvePoint, new: CurvePoint, c: Corrected, s: float) -> CurvePoint:
    """Return a curve point for a located solution; its tangent is interpolated (at a branch point none is unique)."""
    fraction = (s - old.s) / (new.s - old.s) if new.s > old.s else 0.5
    tangent = _unit((1.0 - fraction) * old.tangent + fraction * new.tangent, new.tangent)
    return CurvePoint(c.x, c.y[: system.k], tangent, old.sign, c.local, new.jac, s, c.error)


Solved = tuple[Corrected, System]


@dataclass(slots=True)
class ByOrientation:
    """What a branch point is suspected by: the sign of det [G_z; t] at the ends of a step."""

    structural = True

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> float:
        """Return the orientation."""
        return point.sign

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether the orientation changes; it is zero on a branch point, which belongs to the steps on both sides."""
        return old.sign != new.sign


@dataclass(slots=True)
class ZeroDetector:
    """Zeros of a scalar function of a curve point: user zeros, and tests on loci without a system of their own.

    `solve` follows a point near a zero to the zero itself and returns it with the system that it solves, from which
    `finish` has data and a note, or None where it is no such point after all. A test that `counts` changes by whole
    numbers. `fraction` tells better than a linear function through the test's values where in a step a zero lies. With
    `vanishes` a zero counts where the test itself is far smaller than at the ends of the step.
    """

    kind: str
    system: System
    test: Callable[[CurvePoint], float]
    solve: Callable[[Corrected], Solved]
    finish: Callable[[Corrected, System], tuple[dict[str, Any], str] | None]
    settings: Settings
    counts: bool = False
    structural: bool = False
    fraction: Callable[[CurvePoint, CurvePoint], float] | None = None
    vanishes: bool = False
    _note: Note[float] = field(default_factory=Note, init=False)

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether the test changes sign, or counts more or less."""
        a, b = self.value(old), self.value(new)
        if self.counts:
            return a != b
        return a * b < 0 or (a == 0.0) != (b == 0.0)  # a point on a zero belongs to the steps on both sides

    def value(self, point: CurvePoint) -> float:
        """Return the test's value, computed once."""
        return self._note.of(point, lambda: self.test(point))

    def _settle(self, old: CurvePoint, new: CurvePoint, largest: float) -> Located | Refused | None:
        a, b = self.value(old), self.value(new)
        if not self.counts and min(abs(a), abs(b)) > _POLE * largest:
            return Refused(Why.POLE, f"the test of {self.kind} grows beyond bounds where it changes sign")
        c = s = None
        if self.fraction is not None and new.s - old.s <= self.settings.ds_max:
            c, full = self.solve(guessed(self.system, old, new, self.fraction(old, new)))
            s = None if c.failure is not None else within(self.system, old, new, c)
        if c is None or s is None:
            near = approximate(self.system, old, new, zero_fraction(a, b), self.settings)
            if near.failure is not None:
                return None
            c, full = self.solve(near)
            s = None if c.failure is not None else within(self.system, old, new, c)
            if s is None:
                return None
        point = point_at(self.system, old, new, c, s)
        if self.vanishes and not abs(self.test(point)) <= _VANISHES * largest:
            return None
        done = self.finish(c, full)
        if done is None:
            return None
        data, note = done
        return Located(self.kind, point, known_to(full, c), True, data, note)

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found:
        """Return the zero between the points, if there is one; a pole is none."""
        largest = max(abs(self.value(old)), abs(self.value(new)))
        settle = partial(self._settle, largest=largest)
        result = bisect(self.system, old, new, self.crossed, settle, self.settings)
        return Found() if result is None else Found([result])


class ScalarZero(Condition):
    """The condition monitor(x, p) = 0 on an equilibrium curve."""

    def __init__(self, monitor: Callable[[Array, Values], float]) -> None:
        self.monitor = monitor

    def value(self, local: Local, aux: Array) -> Array:
        """Return the monitor's value."""
        return np.array([self.monitor(local.x, local.values)])
