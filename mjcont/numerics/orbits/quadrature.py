"""Phase resonance: a reading's harmonic stands at right angles to the input that drives it.

    sum_k weight_k y(u_k) cos(2 pi n tau_k + phi) = 0

over the collocation points, with the input cos(2 pi n tau + phi): it then only makes up for damping, and the motion is
that of a mode. Source: Peeters, Kerschen and Golinval, Dynamic testing of nonlinear vibrating structures
using nonlinear normal modes (Journal of Sound and Vibration 330, 2011).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.differences import FOURTH_ORDER, jacobian_steps
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.system import Condition, Local, System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.defining import orbits_of

# step in a free parameter's coordinate
_STEP = 1e-4


@dataclass(slots=True)
class InQuadrature(Condition):
    """The condition, over a size of the reading.

    Attributes
    ----------
    read : from states (m, d), phases (m,) and parameters to the reading (m,).
    angle : from phases (m,) and parameters to the input's angle, 2 pi n tau + phi, (m,).
    size : typical of the reading.
    """

    read: Callable[[Array, Array, Values], Array]
    angle: Callable[[Array, Values], Array]
    size: float

    def value(self, local: Local, aux: Array) -> Array:
        """Return the mean of the reading times the input, (1,)."""
        del aux
        return np.array([self._mean(orbits_of(local), local.x, local.values)])

    def _weights(self, orbits: Orbits, values: Values) -> Array:
        """Return weights times the input's cosine at the points, (N m,)."""
        weights = (orbits.lengths[:, None] * orbits.scheme.b).ravel()
        found: Array = weights * np.cos(self.angle(orbits.phases, values)) / self.size
        return found

    def _mean(self, orbits: Orbits, x: Array, values: Values) -> float:
        states = orbits.stages(orbits.path(x, values)).reshape(-1, orbits.flow.d)
        return float(self._weights(orbits, values) @ self.read(states, orbits.phases, values))

    def gradient(self, local: Local, system: System, y: Array) -> Array:
        """Return its derivatives over the unknowns and the free parameters, (1, n + number free)."""
        orbits, values = orbits_of(local), local.values
        d = orbits.flow.d
        p = orbits.path(local.x, values)
        states, rule = orbits.stages(p).reshape(-1, d), FOURTH_ORDER
        steps = jacobian_steps(orbits.sizes, rule)
        moved = (states[:, None, :] + steps).reshape(-1, d)
        rows = self.read(moved, np.repeat(orbits.phases, len(steps)), values)
        slopes = np.einsum("o,mod->md", np.array(rule.weights), rows.reshape(len(states), len(rule.offsets), d))
        slopes = self._weights(orbits, values)[:, None] * slopes / (rule.step * orbits.sizes)
        over_x = self._drawn_back(orbits, p.period, slopes.reshape(orbits.intervals, orbits.m, d))
        over_y = np.zeros(len(system.free))
        for k in range(len(system.free)):
            ends = []
            for sign in (1.0, -1.0):
                at = y.copy()
                at[k] += sign * _STEP
                ends.append((self._mean(orbits, local.x, system.values(at)), at[k]))
            over_y[k] = (ends[0][0] - ends[1][0]) / (ends[0][1] - ends[1][1])
        return np.concatenate([over_x * orbits.state_scale, over_y])[None]

    def _drawn_back(self, orbits: Orbits, period: float, slopes: Array) -> Array:
        """Return derivatives over the unknowns (n,) from those over the states at the points (N, m, d)."""
        found, c, a = np.zeros(orbits.n), orbits.flow.c, orbits.scheme.a
        ends = np.zeros((orbits.intervals + 1, orbits.flow.d))
        ends[:-1] = slopes.sum(axis=1)
        if orbits.flow.order == 1:
            inside = a.T @ slopes
        else:
            h = (period * orbits.lengths)[:, None, None]
            ends[:-1, c:] += (h * orbits.scheme.c[:, None] * slopes[..., :c]).sum(axis=1)
            inside = orbits.scheme.aa.T @ slopes[..., :c] + a.T @ slopes[..., c:] / h
        found[: orbits.ends] = ends.ravel()
        found[orbits.ends : orbits.ends + orbits.inside] = inside.ravel()
        return found
