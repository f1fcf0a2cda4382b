"""Starts: the equilibrium that a guess belongs to.

Newton's method finds it where it is near. From farther away a vector field is solved by damped Newton steps, since its
motion may circle for ever, and a mechanism is let move as its damping would let it, since that is where it comes to
rest; each way is the other's second choice.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.clock import unlimited
from mjcont.numerics.equations.newton import solve, solve_linear
from mjcont.numerics.equations.problem import Array, Equations, Values
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.system import Local, System

_NO_Y = np.zeros(0)
# damped Newton steps: most of them, the least part of one, the scaled step at which they end
_DAMPED, _LEAST, _DONE = 100, 1e-6, 1e-7
# an implicit step of the motion: its largest size, the part of it at which corrections end, and most of these, where
# contact is made or broken and where it is not
_LARGEST, _CLOSE, _AT_KINKS, _ELSEWHERE = 0.1, 0.03, 15, 4


@dataclass(frozen=True, slots=True)
class Start:
    """An equilibrium reached from a guess: how, how far away, the residual there, and why it is none."""

    x: Array
    method: str
    distance: float
    error: float
    failure: Refused | None = None


def find_start(problem: Equations, x0: Array, values: Values) -> Start:
    """Return the equilibrium that `x0` belongs to: by Newton's method if it is near, else as the module says."""
    system = System(problem, values, ())
    with unlimited():  # a start that is near is found whatever the limit on time
        near = solve(system, x0, _NO_Y, most=8, reach=0.1)
    if near.failure is None:
        distance = float(np.linalg.norm(system.difference(near.x, _NO_Y, x0, _NO_Y)))
        if distance < 0.1:
            return Start(near.x, "newton", distance, near.error)
    ways = [("pseudo-transient", _pseudo_transient), ("newton", _damped_newton)]
    first, second = ways if problem.second_order else reversed(ways)
    found = _by(system, x0, *first)
    if found.failure is None:
        return found
    other = _by(system, x0, *second)
    moved = found if problem.second_order else other
    return other if other.failure is None else moved


def _by(system: System, x0: Array, method: str, way: Callable[[System, Array], tuple[Array, Refused | None]]) -> Start:
    """Return the equilibrium to which one way leads from `x0`."""
    x, failure = way(system, x0)
    if failure is not None:
        return Start(x, method, np.inf, np.inf, failure)
    final = solve(system, x, _NO_Y, most=20, reach=0.2)
    distance = float(np.linalg.norm(system.difference(final.x, _NO_Y, x0, _NO_Y)))
    return Start(final.x, method, distance, final.error, final.failure)


def _damped_newton(system: System, x: Array) -> tuple[Array, Refused | None]:
    """Take Newton steps, shortened until the next one with the same matrix is shorter (the natural monotonicity test).

    Source: Deuflhard, Newton Methods for Nonlinear Problems (Springer 2004), section 3.3.
    """
    scale, part = system.problem.state_scale, 1.0
    for _ in range(_DAMPED):
        local = system.local(x, _NO_Y)
        step = _solved(local.raw_jac, -local.f)
        size = float(np.linalg.norm(step / scale))
        if not np.isfinite(size):
            return x, Refused(Why.UNDEFINED, "Newton's method met a point at which f has no derivatives")
        if size < _DONE:
            return system.problem.retract(x, step), None

        def following(t: float, x: Array = x, step: Array = step, jac: Any = local.raw_jac) -> float:
            f = system.local(system.problem.retract(x, t * step), _NO_Y).f
            return float(np.linalg.norm(_solved(jac, -f) / scale))

        part = _part(size, following, part)
        if not part:
            return x, Refused(Why.STALLED, "Newton's method came to a halt where the derivatives of f are singular")
        x, part = system.problem.retract(x, part * step), min(1.0, 2.0 * part)
    return x, Refused(Why.UNSETTLED, f"Newton's method had not converged after {_DAMPED} steps")


def _part(size: float, following: Callable[[float], float], part: float = 1.0) -> float:
    """Return the part of a step after which the `following` one, of the same matrix, is shorter; 0 if there is none."""
    while part >= _LEAST:
        if following(part) <= (1.0 - 0.25 * part) * size:
            return part
        part *= 0.5
    return 0.0


def _solved(matrix: Any, rhs: Array) -> Array:
    """Return the solution of a linear system, no numbers where f or its derivatives are none."""
    finite = np.isfinite(rhs).all() and np.isfinite(matrix.data if sparse.issparse(matrix) else matrix).all()
    return solve_linear(matrix, rhs) if finite else np.full(len(rhs), np.nan)


def _pseudo_transient(system: System, x: Array, most: int = 600) -> tuple[Array, Refused | None]:
    """Follow M x' = f by implicit steps whose length grows while the motion is smooth."""
    problem, no_y = system.problem, _NO_Y
    scale = problem.state_scale
    local = system.local(x, no_y)
    mass = _mass_like(local)
    dt = _first_dt(local, mass)
    for _ in range(most):
        dx = _implicit(system, local, mass, dt)
        size = float(np.max(np.abs(dx) / scale))
        if not size <= _LARGEST:
            dt *= 0.3  # no power of two: the same dt, and what is singular for it, does not come again
            if dt < 1e-14:
                sentence = "the motion from the start could not be followed: steps became too short"
                return x, Refused(Why.DIVERGED, sentence)
            continue
        x = problem.retract(x, dx)
        local = system.local(x, no_y)
        newton = solve_linear(-local.raw_jac, local.f)
        if size < 1e-3 and np.max(np.abs(newton) / scale) < 1e-9:
            return x, None
        slow = size < 0.05 * _LARGEST and not problem.nonsmooth  # far below what a step may be, and nothing to strike
        dt *= 4.0 if slow else 2.0 if size < 0.5 * _LARGEST else 1.0
    if np.abs(local.f).max() <= 1e-9 * abs(local.raw_jac).max() * np.max(scale):
        sentence = "the motion from the start came to rest, but equilibria are not isolated there: K is singular"
    else:
        sentence = f"the motion from the start had not come to rest after {most} steps"
        sentence += ": it may drift or have no equilibrium"
    return x, Refused(Why.UNSETTLED, sentence)


def _implicit(system: System, local: Local, mass: Any, dt: float) -> Array:
    """Return the step that solves M dx = dt f(x + dx), by Newton steps; NaN where these do not settle.

    One Newton step alone opens stiff pins by the square of the angle that it turns, or throws what touches off, and
    what makes up for it at the next one is so much larger than what moves a mechanism near a fold that the motion would
    wander. The motion of a stiff contact is convex for any dt: steps shortened at the kink, as damped ones are, lead
    across it.
    """
    problem, scale, x = system.problem, system.problem.state_scale, local.x
    here, dx = local, np.zeros(problem.n)
    for _ in range(_AT_KINKS if problem.nonsmooth else _ELSEWHERE):
        matrix = mass / dt - here.raw_jac
        step = _solved(matrix, here.f - mass @ dx / dt)
        size, whole = float(np.linalg.norm(step / scale)), float(np.linalg.norm(dx / scale))
        if not np.isfinite(size):
            break
        if size <= _CLOSE * whole:
            return dx + step

        def following(t: float, matrix: Array = matrix, step: Array = step, dx: Array = dx) -> float:
            moved = dx + t * step
            f = system.local(problem.retract(x, moved), _NO_Y).f
            return float(np.linalg.norm(_solved(matrix, f - mass @ moved / dt) / scale))

        part = _part(size, following) if problem.nonsmooth else 1.0
        if not part or not problem.nonsmooth and not np.max(np.abs(dx + step) / scale) <= _LARGEST:
            break
        dx = dx + part * step
        here = system.local(problem.retract(x, dx), _NO_Y)
    return np.full(problem.n, np.nan)


def _mass_like(local: Local) -> Any:
    """Return the mass matrix, or the identity for a first-order system (sparse where its Jacobian is)."""
    if local.problem.second_order:
        return local.pencil.mass
    n = local.problem.n
    return sparse.identity(n, format="csc") if sparse.issparse(local.raw_jac) else np.eye(n)


def _first_dt(local: Local, mass: Any) -> float:
    """Return a step over which the fastest motion is well resolved."""
    stiffest = abs(local.raw_jac).max(axis=1)
    stiffest = stiffest.toarray().ravel() if sparse.issparse(stiffest) else stiffest
    fast = np.max(stiffest / np.maximum(np.abs(mass.diagonal()), 1e-300))
    return max(float(1.0 / max(fast, 1e-12)), 1e-300)
