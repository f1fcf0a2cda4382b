"""Creep: motion without inertia, M x' = f(x), from a state to the rest it leads to.

Steps are those of the exponential Rosenbrock-Euler method,

    dx = dt phi_1(dt A) M^-1 f,   A = M^-1 df/dx,   phi_1(z) = (e^z - 1) / z,

exact for linear f however stiff, so the length of a step is bounded by the distance alone. An unstable direction is
left along itself: unlike a linearly implicit step, this one never turns back to a saddle.
Source: Hochbruck and Ostermann, Exponential integrators, Acta Numerica 19 (2010), section 2.3.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.numerics.equations.algebra import dense, eigenvectors, full, solve
from mjcont.numerics.equations.problem import Array, Equations, Values
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.system import Local

_REACH = 0.05
_RESTS = 1e-9
_LONGEST = 60.0
# rates below this count as it: the longest dt is a number still
_SLOWEST = 1e-100
_MOST = 1000


@dataclass(frozen=True, slots=True)
class Crept:
    """Where a creeping motion ended: the state, the number of steps, and why it did not come to rest, if so."""

    x: Array
    steps: int
    failure: Refused | None = None


def rates(local: Local) -> tuple[Array, Array, Array]:
    """Return the eigenvalues of A = M^-1 df/dx, its eigenvectors in columns, and M^-1 f in their basis."""
    jac = dense(local.raw_jac)
    mass = None if not local.problem.second_order else full(local.pencil).mass
    a, g = (jac, local.f) if mass is None else (solve(mass, jac), solve(mass, local.f))
    values, vectors = eigenvectors(a)
    return values, vectors, solve(vectors, g.astype(complex))


def _phi(values: Array, dt: float) -> Array:
    """Return dt phi_1(dt s) for eigenvalues s; for infinite dt its limit -1 / s."""
    if np.isinf(dt):
        return -1.0 / values
    z = np.minimum(dt * values.real, _LONGEST) + 1j * dt * values.imag
    small = np.abs(z) < 1e-8
    return np.where(small, dt, dt * np.expm1(z) / np.where(small, 1.0, z))


def creep(
    problem: Equations, x: Array, values: Values, *, reach: float = _REACH, most: int = 2000, away: float = np.inf
) -> Crept:
    """Follow M x' = f until it rests.

    Parameters
    ----------
    reach : largest change of a scaled coordinate in a step.
    most : number of steps after which it is given up.
    away : distance from the start, scaled, at which to stop.
    """
    start = x
    for steps in range(most):
        if np.max(np.abs(problem.difference(x, start)) / problem.state_scale) >= away:
            return Crept(x, steps)
        local = Local(problem, x, values, (), False)
        if not np.all(np.isfinite(local.f)):
            return Crept(x, steps, Refused(Why.UNDEFINED, "the creeping motion left the domain of f"))
        if problem.n > _MOST:
            sentence = f"the creeping motion takes all modes, of up to {_MOST} unknowns; there are {problem.n}"
            return Crept(x, steps, Refused(Why.UNSETTLED, sentence))
        s, vectors, g = rates(local)
        if not (np.isfinite(s).all() and np.isfinite(g).all()):
            sentence = "the creeping motion has no rates where it is: df/dx or the mass is singular there"
            return Crept(x, steps, Refused(Why.UNDEFINED, sentence))

        def step(dt: float, s: Array = s, vectors: Array = vectors, g: Array = g) -> Array:
            moved: Array = (vectors @ (_phi(s, dt) * g)).real
            return moved

        dx = step(np.inf) if np.all(s.real < 0.0) else np.full(problem.n, np.inf)
        size = float(np.max(np.abs(dx) / problem.state_scale))
        if size < _RESTS:
            return Crept(x, steps)
        if not size <= reach:
            dx = step(_longest(lambda dt, f=step: float(np.max(np.abs(f(dt)) / problem.state_scale)), s, reach))
        x = problem.retract(x, dx)
    return Crept(x, most, Refused(Why.UNSETTLED, f"the creeping motion had not come to rest after {most} steps"))


def _longest(size: Any, s: Array, reach: float) -> float:
    """Return the longest dt, to a few per cent, at which a step is no larger than `reach`."""
    rate = max(float(np.abs(s).max()), _SLOWEST)
    low, high = 1e-6 / rate, 1e12 / max(float(np.abs(s).min()), 1e-12 * rate)
    if np.any(s.real > 0.0):  # an unstable mode must not outgrow what an exponential can hold
        high = min(high, _LONGEST / float(s.real.max()))
    if size(high) <= reach:
        return high
    while high / low > 1.05:
        middle = float(np.sqrt(low * high))
        low, high = (middle, high) if size(middle) <= reach else (low, middle)
    return low
