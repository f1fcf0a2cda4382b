"""Gradients of a bordered condition with its null vectors frozen, by products of its matrix with them alone.

A condition g that a bordered matrix A defines has dg = -p' dA q, p and q its left and right vectors. The matrix of a
Hopf point is that of P(s) = s^2 M + s C + K over R[s]/(s^2 + k), and P(s) q = -dF, the derivative of F(x, v, a) =
f(x, v) - M(x) a along the motion v = s x, a = s^2 x that q = q0 + s q1 stands for:

    even part    dx = q0,  dv = -k q1,  da = -k q0
    odd part     dx = q1,  dv =    q0,  da = -k q1

so that every coordinate is moved once, at four evaluations a part, instead of differences of K, C and M as a whole.
Those of a branch point are derivatives of H v, H = [f_x f_p], likewise, v in its kernel.

Their error with stiff bushes is about k step^2. It matters where Newton's method moves, along the curves that the free
parameters make of the equilibrium: there the derivative is replaced by one of sixth order.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from mjcont.numerics.equations.bends import reach_of
from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.differences import FIRST, NODES, SECOND, length_of
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Local, System

# steps in scaled unknowns: beside a coordinate, and along vectors where derivatives are of sixth order
_MIXED, _ALONG = 3e-4, 1e-2


@dataclass(frozen=True, slots=True)
class Motion:
    """Steps of position, velocity and acceleration, (n,) each in physical units; `rate` relates them, in 1/s."""

    position: Array
    velocity: Array
    acceleration: Array
    rate: float

    def length(self, scale: Array) -> float:
        """Return the largest component in units of its coordinate's scale, 1 for no motion."""
        parts = self.position, self.velocity / self.rate, self.acceleration / self.rate / self.rate
        return length_of(np.concatenate(parts), np.tile(scale, 3))

    def forces(self, local: Local, aside: Array, along: Array) -> Array | None:
        """Return F at a point moved by steps (m, n) and by parts (m,) of the motion, (m, n)."""
        t = along[:, None]
        return local.problem.left_forces(
            local.x, local.values, aside + t * self.position, t * self.velocity, t * self.acceleration
        )


def hopf_motions(q: Array, square: float, rate: float) -> tuple[Motion, Motion]:
    """Return the even and odd parts of the motion of q (2, n), with s^2 = -square in units of a rate."""
    even, odd = q
    return (
        Motion(even, -square * rate * odd, -square * rate * rate * even, rate),
        Motion(odd, rate * even, -square * rate * rate * odd, rate),
    )


def gradient(local: Local, system: System, y: Array, motions: Sequence[Motion], left: Array) -> Array | None:
    """Return the sum of p . d(dF) over the parts of a motion, (rows, n + number free), p = left (rows, parts, n).

    None where the problem does not tell F.
    """
    n, exact = system.n, local.problem.second_order
    out = np.zeros((len(left), n + len(system.free)))
    ways = _ways(local, system, y) if exact else np.zeros((n, 0))
    for part, motion in enumerate(motions):
        slopes = _beside(local, motion)
        if slopes is None:
            return None
        rows = left[:, part] @ slopes.T
        if ways.size:
            known = left[:, part] @ np.column_stack([_mixed(local, motion, way) for way in ways.T])
            rows = rows + (known - rows @ ways) @ np.linalg.pinv(ways)
        out[:, :n] += rows
        for i, free in enumerate(system.free):
            moved = parameter_slope(partial(_product, motion=motion, exact=exact), local, free.name)
            out[:, n + i] += left[:, part] @ moved * free.slope(float(y[i]))
    return out


def _ways(local: Local, system: System, y: Array) -> Array:
    """Return unit vectors along which equilibria move with the free parameters, in scaled unknowns, (n, count)."""
    slopes = local.par * np.array([p.slope(u) for p, u in zip(system.free, y.tolist(), strict=False)])
    moves = Factored(local.jac).solve(slopes)
    sizes = np.linalg.norm(moves, axis=0)
    known = np.isfinite(sizes) & (sizes > 0.0)
    found: Array = moves[:, known] / sizes[known]
    return found


def _beside(local: Local, motion: Motion) -> Array | None:
    """Return the derivatives of dF in each scaled coordinate, (n, n_f): 4 n evaluations, of second order."""
    n, scale = local.problem.n, local.problem.typical
    h, e = _MIXED / motion.length(scale), _MIXED * np.diag(scale)
    rows = motion.forces(local, np.concatenate([e, e, -e, -e]), h * np.repeat([1.0, -1.0, 1.0, -1.0], n))
    if rows is None:
        return None
    pp, pm, mp, mm = rows.reshape(4, n, -1)
    found: Array = (pp - pm - mp + mm) / (4.0 * _MIXED * h) * (local.problem.state_scale / scale)[:, None]
    return found


def _mixed(local: Local, motion: Motion, way: Array) -> Array:
    """Return the derivative of dF along a unit vector in scaled unknowns, (n_f,), of sixth order, by polarization."""
    scale = local.problem.state_scale
    h, reach = _ALONG / motion.length(scale), _ALONG / float(np.abs(way).max())
    aside = (reach * NODES)[:, None] * (way * scale)
    both, against = motion.forces(local, aside, h * NODES), motion.forces(local, aside, -h * NODES)
    assert both is not None and against is not None
    found: Array = SECOND @ (both - against) / (4.0 * h * reach)
    return found


def _product(local: Local, motion: Motion, exact: bool) -> Array:
    """Return dF, (n_f,): to sixth order, or to second at two evaluations."""
    step, nodes, weights = (_ALONG, NODES, FIRST) if exact else (_MIXED, np.array([1.0, -1.0]), np.array([0.5, -0.5]))
    h = step / motion.length(local.problem.typical)
    rows = motion.forces(local, np.zeros((len(nodes), local.problem.n)), h * nodes)
    assert rows is not None
    found: Array = weights @ rows / h
    return found


def crossing(local: Local, system: System, y: Array, kernel: Array, left: Array) -> Array | None:
    """Return w . d(H v) for vectors v, the columns of a kernel (n + 1, k) of H = [f_x f_u], (k, n + number free).

    Of a second-order problem the derivatives along these vectors are of sixth order: in the plane that they span
    Newton's method moves to a crossing of curves. None where parameters would leave their bounds.
    """
    bends = [_bend(local, system, y, v) for v in kernel.T]
    found = np.array([bend @ left for bend in bends if bend is not None])
    if len(found) < len(bends):
        return None
    if local.problem.second_order:
        known = _curvatures(local, system, y, kernel)
        if known is None:
            return None
        ways = np.zeros((system.n + len(system.free), kernel.shape[1]))
        ways[: system.n + 1] = kernel
        found = found + (known @ left - found @ ways) @ np.linalg.pinv(ways)
    return found


def _curvatures(local: Local, system: System, y: Array, kernel: Array) -> Array | None:
    """Return the second derivatives of f in pairs of vectors of (x, u), (k, k, n), of sixth order, by polarization."""
    n, free = system.n, system.free[0]
    every = [v / (float(np.abs(v).max()) or 1.0) for v in kernel.T]
    reach = float(NODES.max()) * _ALONG * 2.0
    if not np.isfinite(kernel).all() or y[0] - reach < system.lowest[0] or y[0] + reach > system.highest[0]:
        return None

    def along(v: Array) -> Array:
        t = _ALONG * NODES
        states = local.problem.retract_each(local.x, t[:, None] * v[:n] * local.problem.state_scale)
        column = np.array([free.value(float(y[0]) + part * float(v[n])) for part in t])
        rows = local.problem.residuals_along(states, local.values, {free.name: column})
        curvature: Array = SECOND @ rows / _ALONG**2
        return curvature

    sizes = np.abs(kernel).max(axis=0)
    found = np.empty((len(every), len(every), n))
    for i, j in itertools.combinations_with_replacement(range(len(every)), 2):
        u, v = every[i], every[j]
        mixed = along(u) if i == j else 0.25 * (along(u + v) - along(u - v))
        found[i, j] = found[j, i] = sizes[i] * sizes[j] * mixed
    return found


def _bend(local: Local, system: System, y: Array, v: Array) -> Array | None:
    """Return the derivatives of (f_x, f_u) v in every scaled coordinate and free parameter, (n + number free, n).

    u is the coordinate of the first free parameter, v (n + 1,). 4 n evaluations and four for each parameter; None where
    one would leave its bounds.
    """
    n, scale, typical = system.n, system.problem.state_scale, system.problem.typical
    h = _MIXED / (max(reach_of(local, v[:n]), abs(float(v[n]))) or 1.0)
    unit, along = np.eye(system.k), h * v[:n] * scale
    ahead = h * v[n] * unit[0]
    sides = [system.gradient_step(i, y) * unit[i] for i in range(len(system.free))]
    reach = np.abs(ahead) + np.sum(sides, axis=0)
    if np.any((y - reach < system.lowest) | (y + reach > system.highest)):
        return None

    def across(aside: Array, rows: Array) -> Array:
        plus, minus = (
            system.problem.residuals(local.x, system.values(y + sign * ahead + aside), rows + sign * along)
            for sign in (1.0, -1.0)
        )
        return plus - minus

    e = _MIXED * np.diag(typical)
    change, found = across(np.zeros(system.k), np.concatenate([e, -e])), np.empty((n + len(sides), n))
    found[:n] = (change[:n] - change[n:]) / (4.0 * _MIXED * h) * (scale / typical)[:, None]
    for i, side in enumerate(sides):
        found[n + i] = (across(side, np.zeros((1, n))) - across(-side, np.zeros((1, n))))[0] / (4.0 * side[i] * h)
    return found


def parameter_slope(function: Callable[[Local], Any], local: Local, name: str) -> Any:
    """Return d function / d p, a number or an array, for a parameter, in physical units, by differences in p."""
    bounds = local.ranges[local.wrt.index(name)] if local.ranges else None
    rule, h = local.problem.parameter_stencil(name, local.values[name], bounds)
    total: Any = 0.0
    for offset, weight in zip(rule.offsets, rule.weights, strict=True):
        values = {**local.values, name: local.values[name] + offset * h}
        total += weight * function(Local(local.problem, local.x, values, local.wrt, local.accurate, local.ranges))
    return total / h
