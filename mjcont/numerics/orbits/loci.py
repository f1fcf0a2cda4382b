"""Curves of special orbits in one more parameter, and the points of codimension two on them.

Along a curve of LPC, PD or NS one multiplier, or a pair, is held. The others, mu_j, tell where it meets another curve:

    prod (1 - mu_j) = 0      a fold beside:  R1 on LPC, LPPD on PD, LPNS on NS
    prod (1 + mu_j) = 0      a doubling:     LPPD on LPC, R2 on PD, PDNS on NS
    prod (1 - mu_i mu_j) = 0 a pair:         LPNS on LPC, PDNS on PD, NSNS on NS  (unless it is real)

and coefficients of normal forms (`forms`) where the point itself degenerates: CPC, GPD, CH. On NS the angle passes
2 pi / k at R1 .. R4.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.newton import Corrected
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Condition, Local, System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.defining import CycleFold, PeriodDoubling, Torus
from mjcont.numerics.orbits.forms import cubic_of_doubling, cubic_of_torus, square_of_fold
from mjcont.numerics.orbits.linger import is_rest
from mjcont.numerics.orbits.points import multipliers_at, orbits_at, path_at
from mjcont.numerics.points.events import Detector, Found, Located, approximate, point_at, within
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note

# what remains of a test at a zero, in parts of its values at the ends of the step
_VANISHES = 1e-3
# a test that grows by this between the ends of the step has a pole there
_POLE = 10.0
_CLOSE = 1e-11
Test = Callable[[CurvePoint], float]


@dataclass(slots=True)
class Meeting:
    """A point of codimension two, where a scalar test changes sign without growing beyond bounds."""

    kind: str
    system: System
    settings: Settings
    test: Test
    counts: Callable[[CurvePoint], bool] = lambda point: True
    structural: bool = False
    _note: Note[float] = field(default_factory=Note, init=False)

    def value(self, point: CurvePoint) -> float:
        """Return the test's value."""
        return self._note.of(point, lambda: self.test(point))

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether it changes sign."""
        a, b = self.value(old), self.value(new)
        return a * b < 0.0 or (a == 0.0) != (b == 0.0)

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found:
        """Return the zero between the points."""
        seen: dict[float, tuple[float, Corrected]] = {}
        ends = {0.0: self.value(old), 1.0: self.value(new)}
        largest = max(abs(v) for v in ends.values())

        def at(fraction: float) -> float:
            if fraction in ends:
                return ends[fraction]
            near = approximate(self.system, old, new, fraction, self.settings)
            if near.failure is not None:
                raise ValueError(near.failure.message)
            value = self.test(point_at(self.system, old, new, near, old.s))
            if not abs(value) <= _POLE * largest:  # it changes sign where it grows beyond bounds
                raise ValueError
            seen[fraction] = (value, near)
            return value

        if math.isnan(root(at, 0.0, 1.0, _CLOSE)) or not seen:
            return Found()
        rest, near = min(seen.values(), key=lambda pair: abs(pair[0]))
        s = within(self.system, old, new, near)
        if s is None or not abs(rest) <= _VANISHES * largest:
            return Found()
        point = point_at(self.system, old, new, near, s)
        if is_rest(orbits_at(point), path_at(point)) or not self.counts(point):
            return Found()
        return Found([Located(self.kind, point, near.step)])


def held(kind: str, point: CurvePoint) -> Array:
    """Return the resolved multipliers but for those that a kind of point holds on the circle."""
    m = multipliers_at(point).tested
    if kind == "NS":
        theta = float(point.y[-1])
        for mu in (np.exp(1j * theta), np.exp(-1j * theta)):
            m = np.delete(m, int(np.argmin(np.abs(m - mu)))) if len(m) else m
        return m
    mu = -1.0 if kind == "PD" else 1.0
    return np.delete(m, int(np.argmin(np.abs(m - mu)))) if len(m) else m


def _towards(kind: str, sign: float) -> Test:
    """Return prod (1 - sign mu_j), the sign of which tells on which side a real multiplier lies."""
    return lambda point: float(np.prod(1.0 - sign * held(kind, point)).real)


def _pairs(kind: str) -> Test:
    """Return prod (1 - mu_i mu_j) over pairs."""

    def test(point: CurvePoint) -> float:
        m = held(kind, point)
        i, j = np.triu_indices(len(m), 1)
        return float(np.prod(1.0 - m[i] * m[j]).real)

    return test


def _complex_pair(kind: str) -> Callable[[CurvePoint], bool]:
    """Return whether the pair on the circle is a complex one, and not two real multipliers mu and 1 / mu."""

    def check(point: CurvePoint) -> bool:
        m = held(kind, point)
        nearest = m[np.argsort(np.abs(np.abs(m) - 1.0))[:2]]
        return bool((nearest.imag != 0.0).all())

    return check


def locus_detectors(kind: str) -> Callable[[System, Settings], list[Detector]]:
    """Return what makes the detectors of a curve of special orbits of a kind."""
    names = {"LPC": ("R1", "LPPD", "LPNS"), "PD": ("LPPD", "R2", "PDNS"), "NS": ("LPNS", "PDNS", "NSNS")}
    own = {"LPC": "CPC", "PD": "GPD", "NS": "CH"}

    def make(system: System, settings: Settings) -> list[Detector]:
        if kind not in names:
            return []
        fold, doubling, pair = names[kind]
        found: list[Detector] = [
            Meeting(own[kind], system, settings, _coefficient(kind, system)),
            Meeting(fold, system, settings, _towards(kind, 1.0)),
            Meeting(doubling, system, settings, _towards(kind, -1.0)),
            Meeting(pair, system, settings, _pairs(kind), _complex_pair(kind)),
        ]
        if kind == "NS":
            found += [Meeting(f"R{k}", system, settings, _angle(at)) for k, at in RESONANT.items()]
        return found

    return make


def _coefficient(kind: str, system: System) -> Test:
    """Return the coefficient of the normal form of a kind of special orbit."""
    if kind == "LPC":
        return lambda point: square_of_fold(point, system.conditions[0])
    return cubic_of_doubling if kind == "PD" else lambda point: cubic_of_torus(point, float(point.y[-1]))


# the angles of strong resonances, as (cos - cos(angle)) or sin tells them
RESONANT = {1: 0.0, 2: math.pi, 3: 2.0 * math.pi / 3.0, 4: math.pi / 2.0}


def _angle(at: float) -> Test:
    """Return how far the angle of the pair is from one, with the sign of the side on which it lies."""
    if at in (0.0, math.pi):
        return lambda point: math.sin(0.5 * (float(point.y[-1]) - at))
    return lambda point: math.cos(float(point.y[-1])) - math.cos(at)


def conditions_for(kind: str, local: Local, aux: Array) -> list[Condition]:
    """Return the condition that holds a kind of special orbit, with borders from an evaluation at or near one."""
    if kind == "NS":
        return [Torus(local, float(aux[0]))]
    return [CycleFold(local) if kind == "LPC" else PeriodDoubling(local)]


def held_system(kind: str, plain: System, x: Array, y: Array) -> System:
    """Return the equations of a curve of special orbits; y has the free parameters and the condition's unknowns."""
    assert isinstance(plain.problem, Orbits)
    count = len(plain.free)
    local = Local(plain.problem, x, plain.values(y[:count]), plain.names, True, plain.ranges)
    return System(plain.problem, plain.values(y[:count]), plain.free, conditions_for(kind, local, y[count:]), True)
