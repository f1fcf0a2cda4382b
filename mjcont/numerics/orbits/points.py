"""What is known of an orbit on a curve: its multipliers and the estimate of its error, each found out once."""

from __future__ import annotations

import numpy as np

from mjcont.numerics.orbits.collocation import OrbitLinearization, Orbits
from mjcont.numerics.orbits.conserved import ConservedOrbits, own_multipliers
from mjcont.numerics.orbits.floquet import Multipliers, multipliers
from mjcont.numerics.orbits.mesh import error_of
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note

MULTIPLIERS, ERROR = Note[Multipliers](), Note[float]()


def orbits_at(point: CurvePoint) -> Orbits:
    """Return the equations of the orbits that a point is one of."""
    found = point.local.problem
    assert isinstance(found, Orbits)
    return found


def path_at(point: CurvePoint) -> Path:
    """Return a point's orbit."""
    return orbits_at(point).path(point.x, point.local.values)


def multipliers_at(point: CurvePoint) -> Multipliers:
    """Return the multipliers of a point's orbit."""

    def find() -> Multipliers:
        orbits, linear, path = orbits_at(point), point.local.linearization, path_at(point)
        assert isinstance(linear, OrbitLinearization)
        velocity = path.s[0, path.c :]  # of second order; q' is the first half of u'
        if orbits.own_period:  # from the flow: the polynomial's own slope is of lower order at its ends
            rates = orbits.flow.rates(path.s[:1], np.zeros(1), point.local.values)[0]
            velocity = np.concatenate([velocity, rates]) if path.order == 2 else rates
        if isinstance(orbits, ConservedOrbits):
            slope = orbits.flow.energy_slopes(path.s[:1], point.local.values)[0]
            return own_multipliers(orbits, linear.blocks, path.period, velocity, slope)
        return multipliers(orbits, linear.blocks, path.period, velocity)

    return MULTIPLIERS.of(point, find)


def error_at(point: CurvePoint) -> float:
    """Return the estimate of the error of a point's orbit, relative."""
    return ERROR.of(point, lambda: error_of(path_at(point), orbits_at(point).sizes))


def unstable(m: Multipliers, margin: float = 0.0) -> int:
    """Return how many multipliers lie outside the unit circle, the trivial one aside."""
    return int(np.count_nonzero(np.abs(m.own) > 1.0 + margin))
