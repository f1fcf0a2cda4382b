"""A mechanism with one degree of freedom whose pins are rigid: the limit of its elastic one, as one equation.

On the states q(s) in which every pin is closed, t = dq/ds, the bushes do no work, so that M(q) q'' = f - C q' becomes,
in the way y with dy = sqrt(t . M t) ds, along which the moving mass is 1,

    y'' + c(y) y' = Q(y, p),   c = t . C t / t . M t,   Q = t . f(q(s), p) / sqrt(t . M t)

with M, C and f of the model. Loads are those in which f is affine: Q = Q_0 + sum p_i Q_i.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.optimize import brentq

import mjcont as mc
from mjcont.numerics.equations.problem import Array, Values

_CLOSED, _ROUNDS, _STEP = 1e-13, 30, 1e-6


class Pins:
    """The gaps of a model's bushes, which are its actuators named bush_*."""

    def __init__(self, mechanism: mc.Mechanism) -> None:
        self._model = mechanism.simulation_model()
        self._data = mujoco.MjData(self._model)
        names = [self._model.actuator(i).name for i in range(self._model.nu)]
        self._bushes = [i for i, name in enumerate(names) if name.startswith("bush_")]

    def gaps(self, q: Array) -> Array:
        """Return the gaps in m along each bush's axis, (k,)."""
        self._data.qpos = q
        mujoco.mj_fwdPosition(self._model, self._data)
        return np.array(self._data.actuator_length[self._bushes])

    def slopes(self, q: Array) -> Array:
        """Return their derivatives, (k, n)."""
        steps = _STEP * np.eye(len(q))
        return np.array([(self.gaps(q + h) - self.gaps(q - h)) / (2.0 * _STEP) for h in steps]).T

    def closed(self, q: Array, index: int, value: float) -> Array:
        """Return the state near q in which a coordinate has a value and every pin is closed, by Newton's method."""
        q = q.copy()
        q[index] = value
        others = np.delete(np.arange(len(q)), index)
        for _ in range(_ROUNDS):
            step = np.linalg.lstsq(self.slopes(q)[:, others], -self.gaps(q), rcond=None)[0]
            q[others] += step
            if np.abs(step).max() < _CLOSED:
                break
        return q

    def tangent(self, q: Array, index: int) -> Array:
        """Return dq/ds for s the coordinate of an index, (n,)."""
        slopes = self.slopes(q)
        others = np.delete(np.arange(len(q)), index)
        found = np.ones(len(q))
        found[others] = np.linalg.lstsq(slopes[:, others], -slopes[:, index], rcond=None)[0]
        return found


class Table:
    """Splines of several quantities on one even grid, read together: one product a place."""

    def __init__(self, s: Array, columns: Array) -> None:
        spline = make_interp_spline(s, columns, 5)
        self._breaks = np.unique(spline.t)[:-1]
        parts = [spline.derivative(j)(self._breaks) / math.factorial(j) for j in range(6)]
        self._pieces = np.moveaxis(np.array(parts), 0, 1).copy()

    def at(self, s: float) -> tuple[Array, Array]:
        """Return the quantities (k,) at a place and their derivatives."""
        i = max(int(np.searchsorted(self._breaks, s, "right")) - 1, 0)
        x = s - self._breaks[i]
        powers = np.array([1.0, x, x * x, x**3, x**4, x**5])
        slopes = np.array([0.0, 1.0, 2.0 * x, 3.0 * x * x, 4.0 * x**3, 5.0 * x**4])
        return powers @ self._pieces[i], slopes @ self._pieces[i]


@dataclass(frozen=True, slots=True)
class RigidLinkage:
    """The equation of a mechanism with rigid pins over a range of one coordinate s, in the way y along it.

    Attributes
    ----------
    name : of s, rad.
    loads : the values of all loads, the means of those that move among them.
    table : of y: s, c, Q_0 and each Q_i.
    way : y as a spline of s, from 0.
    """

    name: str
    loads: Mapping[str, float]
    table: Table
    way: Any

    @classmethod
    def of(
        cls, mechanism: mc.Mechanism, name: str, start: Array, span: tuple[float, float], loads: Sequence[str],
        values: Values, count: int = 801,
    ) -> RigidLinkage:
        """Return it for a joint's coordinate over a span (rad), from a state nearby; `values` of the parameters."""
        pins, index = Pins(mechanism), [label for label, _ in mechanism.state_labels].index(name)
        s = np.linspace(*span, count)
        first = int(np.argmin(np.abs(s - start[index])))
        states = np.empty((count, len(start)))
        for way in (range(first, count), range(first - 1, -1, -1)):
            q = states[first] if way.step < 0 else start
            for i in way:
                q = states[i] = pins.closed(q, index, s[i])
        slopes = np.array([pins.tangent(q, index) for q in states])
        at = mechanism.values(values)
        pencils = [mechanism.pencil(q, at, mechanism.linearize(q, at, ()).jac) for q in states]
        mass, damping = (np.einsum("mi,mij,mj->m", slopes, np.array(part), slopes)
                         for part in ([p.mass for p in pencils], [p.damping for p in pencils]))

        def work(given: Values) -> Array:
            return np.array([t @ mechanism.residual(q, given) for q, t in zip(states, slopes, strict=True)])

        none = {**at, **dict.fromkeys(loads, 0.0)}
        basis, sizes = work(none), {n: max(abs(at[n]), 1.0) for n in loads}
        each = [(work({**none, n: sizes[n]}) - basis) / sizes[n] for n in loads]
        forces = np.column_stack([basis, *each]) / np.sqrt(mass)[:, None]
        way_along = make_interp_spline(s, np.sqrt(mass), 5).antiderivative()
        table = Table(way_along(s), np.column_stack([s, damping / mass, forces]))
        return cls(name, {n: at[n] for n in loads}, table, way_along)

    def force(self, y: float, **loads: float) -> float:
        """Return Q under loads, those not given at their values."""
        row, _ = self.table.at(y)
        return float(row[2] + row[3:] @ [{**self.loads, **loads}[n] for n in self.loads])

    def rest(self, low: float, high: float, **loads: float) -> float:
        """Return y where the loads balance, between two values of s."""
        return float(brentq(lambda y: self.force(y, **loads), *map(float, self.way([low, high])), xtol=1e-14))

    def angle(self, y: Array) -> Array:
        """Return s at ways (m,)."""
        return np.array([self.table.at(float(v))[0][0] for v in y])

    def response(self, y: float, load: str, frequencies: Array) -> Array:
        """Return ds/dp of small swings about a rest under a load that moves, complex, at frequencies in Hz."""
        (row, slopes), w = self.table.at(y), 2.0 * np.pi * np.asarray(frequencies)
        stiffness = -(slopes[2] + slopes[3:] @ list(self.loads.values()))
        push = slopes[0] * row[3 + list(self.loads).index(load)]
        return np.asarray(push / (stiffness + 1j * w * row[1] - w**2))

    def field(self, load: str) -> mc.VectorField:
        """Return y' = v, v' = Q - c v with a load that moves by amplitude cos(2 pi f t)."""
        names, which = list(self.loads), list(self.loads).index(load)

        def motion(u: Array, p: Values, t: float) -> list[float]:
            y, v = float(u[0]), float(u[1])
            row, _ = self.table.at(y)
            loads = np.array([p[n] for n in names])
            loads[which] += p["amplitude"] * math.cos(2.0 * math.pi * p["f"] * t)
            return [v, float(row[2] + row[3:] @ loads) - float(row[1]) * v]

        return mc.VectorField(
            motion, [0.0, 0.0], {**self.loads, "amplitude": 0.0, "f": 1.0}, names=["y", "v"], units={"f": "Hz"},
            period=lambda p: 1.0 / p["f"], name="rigid pins",
        )
