"""Newton's method on a `System`: with a row beside it for a point of a curve, without for a special point."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.algebra import least_squares
from mjcont.numerics.equations.algebra import solve as solve_dense
from mjcont.numerics.equations.bordered import Factored, border
from mjcont.numerics.equations.problem import Array, Equations, Values
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local, System

_SLOW = 0.5
_FIRST, _LATER = 1e5, 1e2
_POLISH = 3
_DIVERGING = 2.0
_NOISE = 1e-6
LARGEST_ERROR = 1e-7
_LARGEST_STEP = 2.0
# implicit steps from a start: the largest, in scaled units, most corrections, and the part of the step they end at
_LARGEST_START, _CORRECTIONS, _CLOSE = 0.1, 4, 0.03
_DIVERGED = Refused(Why.DIVERGED, "the corrector diverged")
_NEWTON_DIVERGED = Refused(Why.DIVERGED, "Newton's method diverged")


@dataclass(frozen=True, slots=True)
class Corrected:
    """A corrected point.

    Attributes
    ----------
    x, y : the point.
    local : the evaluation there, with derivatives.
    factored : LU of the Jacobian there (with the row).
    jac : the system's Jacobian there (without the row).
    iterations : corrector steps before the last.
    contraction : ratio of the last two steps before the last Newton step.
    rate : ratio of the last Newton step to the step before it.
    step : size of the last step: the tolerance reached.
    error : scaled residual.
    failure : why it is no point of the curve, None where it is one.
    """

    x: Array
    y: Array
    local: Local
    factored: Factored | None
    iterations: int
    contraction: float
    step: float
    error: float
    failure: Refused | None = None
    jac: Any = None
    rate: float = np.inf


def with_row(jac: Any, row: Array | None) -> Any:
    """Return a Jacobian with `row` below it."""
    if row is None:
        return jac
    if not isinstance(jac, np.ndarray):
        return border(jac, np.zeros((jac.shape[0], 0)), row[None])
    out = np.empty((jac.shape[0] + 1, jac.shape[1]))
    out[:-1], out[-1] = jac, row
    return out


def length(step: Array) -> float:
    """Return the Euclidean norm of a vector."""
    return math.sqrt(step @ step)


def matrix_with_row(system: System, local: Local, y: Array, row: Array | None) -> Any:
    """Return the Jacobian of the system, with `row` below it."""
    return with_row(system.jacobian(local, y), row)


def _newton_step(system: System, local: Local, y: Array, lu: Factored, row: Array | None) -> tuple[Array, Array]:
    r = system.residual(local, y)
    if row is not None:
        padded = np.zeros(len(r) + 1)
        padded[:-1] = r
        return -lu.solve(padded), r
    return -lu.solve(r), r


def _broyden(step: Array, steps: list[Array]) -> Array:
    """Return the step of Broyden's method from the chord step and the steps taken since the matrix was formed.

    Source: Kelley, Iterative Methods for Linear and Nonlinear Equations (SIAM 1995), section 7.3.
    """
    for before, after in zip(steps, steps[1:], strict=False):
        step = step + after * (before @ step) / (before @ before)
    if steps:
        cosine = (steps[-1] @ step) / (steps[-1] @ steps[-1])
        if cosine < 0.9:
            step = step / (1.0 - cosine)
    return step


def undefined(system: System) -> Refused:
    """Say why f has no value, by the problem's own `failure` where it knows more."""
    return Refused(Why.UNDEFINED, system.problem.failure or "f is not finite there")


def correct(
    system: System,
    x: Array,
    y: Array,
    row: Array,
    lu: Factored | None,
    settings: Settings,
    expected: float = np.inf,
) -> Corrected:
    """Return to the curve from a prediction, moving orthogonally to `row`.

    Broyden steps from `lu` while they contract, renewed derivatives when they do not; a last Newton step with
    derivatives at the solution takes the point to the noise floor. `expected` is the contraction of the first step
    with `lu`, where the last points tell it: one step may then be enough.
    """
    size, ratio = np.inf, 0.0
    failure: Refused | None = Refused(Why.UNSETTLED, "the corrector did not converge")
    tol = settings.tol
    local, iterations = system.local(x, y), 0
    steps: list[Array] = []
    while iterations < settings.max_corrections:
        iterations += 1
        if lu is None:
            lu, steps = Factored(matrix_with_row(system, local, y, row)), []
        step = _broyden(_newton_step(system, local, y, lu, row)[0], steps)
        last, size = size, length(step)
        if not size < _LARGEST_STEP:
            failure = _DIVERGED if np.isfinite(size) else undefined(system)
            break
        ratio = size / last if np.isfinite(last) else 0.0
        x, y = system.move(x, y, step)
        local = system.local(x, y)
        rate, most = (expected, _FIRST) if iterations == 1 else (ratio, _LATER)
        if size <= tol or (rate > 0.0 and size <= most * tol and size * rate <= 0.1 * tol):
            failure = None
            break
        if ratio > _SLOW and size <= _NOISE and iterations > 2:  # as close as the noise of f allows
            failure = None
            break
        if ratio > _DIVERGING:
            failure = _DIVERGED
            break
        steps.append(step)
        if ratio > _SLOW and len(steps) > 2:
            lu = None
    if failure is not None:
        return Corrected(x, y, local, lu, iterations, ratio, size, np.inf, failure)
    for _ in range(_POLISH):  # derivatives are to be those of the point itself
        jac = system.jacobian(local, y)
        factored = Factored(with_row(jac, row))
        step, _ = _newton_step(system, local, y, factored, row)
        x, y = system.move(x, y, step)
        last, size = size, length(step)
        if size <= tol:
            break
        local = system.local(x, y)
    error = system.error(local, x, y)
    if not error < LARGEST_ERROR:
        failure = Refused(Why.STALLED, "the corrector stalled away from the curve")
    return Corrected(x, y, local, factored, iterations, ratio, size, error, failure, jac, size / max(last, 1e-300))


def solve(system: System, x: Array, y: Array, *, tol: float = 1e-12, most: int = 25, reach: float = 0.5) -> Corrected:
    """Solve a system with as many equations as unknowns by full Newton steps, down to the noise floor.

    Parameters
    ----------
    tol : scaled step at which to stop.
    reach : a solution farther away than this (scaled) counts as not found.
    """
    x0, y0 = x, y
    best, size, ratio, local = np.inf, np.inf, 0.0, system.local(x, y)
    since_best, factored, near = 0, None, local
    best_at = (x, y)
    for iteration in range(1, most + 1):
        factored, near = Factored(system.jacobian(local, y)), local
        step, _ = _newton_step(system, local, y, factored, None)
        last, size = size, length(step)
        if not np.isfinite(size) or (size > _LARGEST_STEP and iteration > 2):
            return Corrected(x, y, local, factored, iteration, np.inf, size, np.inf, _NEWTON_DIVERGED)
        step *= min(1.0, reach / size) if size > 0 else 1.0
        ratio = size / last if np.isfinite(last) else 0.0
        x, y = system.move(x, y, step)
        local = system.local(x, y)
        if size < best:
            best, best_at, since_best = size, (x, y), 0
        else:
            since_best += 1
        if size <= tol or (best < 1e-6 and since_best >= (1 if best < 1e-9 else 2)):
            break
    x, y = best_at
    local = system.local(x, y)
    failure = None if best < 1e-6 else Refused(Why.UNSETTLED, "Newton's method did not converge")
    if failure is None and np.linalg.norm(system.difference(x, y, x0, y0)) > 2.0 * reach:
        failure = Refused(Why.WANDERED, "Newton's method left the neighbourhood")
    return Corrected(x, y, local, factored, iteration, ratio, best, system.error(near, x, y), failure)


@dataclass(frozen=True, slots=True)
class Start:
    """An equilibrium reached from a guess: how, how far away, the residual there, and why it is none."""

    x: Array
    method: str
    distance: float
    error: float
    failure: Refused | None = None


def find_start(problem: Equations, x0: Array, values: Values) -> Start:
    """Return the equilibrium that `x0` belongs to: by Newton if it is near, else the one it flows to.

    Far from an equilibrium implicit steps M dx = dt f(x + dx) follow the damped motion with growing dt.
    """
    system = System(problem, values, ())
    no_y = np.zeros(0)
    near = solve(system, x0, no_y, most=8, reach=0.1)
    if not near.failure:
        distance = float(np.linalg.norm(system.difference(near.x, no_y, x0, no_y)))
        if distance < 0.1:
            return Start(near.x, "newton", distance, near.error)
    x, failure = _pseudo_transient(system, x0)
    if failure is not None:
        return Start(x, "pseudo-transient", np.inf, np.inf, failure)
    final = solve(system, x, no_y, most=20, reach=0.2)
    distance = float(np.linalg.norm(system.difference(final.x, no_y, x0, no_y)))
    return Start(final.x, "pseudo-transient", distance, final.error, final.failure)


def _pseudo_transient(system: System, x: Array, most: int = 600) -> tuple[Array, Refused | None]:
    """Follow M x' = f by implicit steps whose length grows while the motion is smooth."""
    problem, no_y = system.problem, np.zeros(0)
    scale = problem.state_scale
    local = system.local(x, no_y)
    mass = _mass_like(local)
    dt = _first_dt(local, mass)
    for _ in range(most):
        dx = _implicit(system, local, mass, dt)
        size = float(np.max(np.abs(dx) / scale))
        if not size <= _LARGEST_START:
            dt *= 0.25
            if dt < 1e-14:
                sentence = "the motion from the start could not be followed: steps became too short"
                return x, Refused(Why.DIVERGED, sentence)
            continue
        x = problem.retract(x, dx)
        local = system.local(x, no_y)
        newton = _solve(-local.raw_jac, local.f)
        if size < 1e-3 and np.max(np.abs(newton) / scale) < 1e-9:
            return x, None
        dt *= 2.0 if size < 0.5 * _LARGEST_START else 1.0
    if np.abs(local.f).max() <= 1e-9 * abs(local.raw_jac).max() * np.max(scale):
        sentence = "the motion from the start came to rest, but equilibria are not isolated there: K is singular"
    else:
        sentence = f"the motion from the start had not come to rest after {most} steps"
        sentence += ": it may drift or have no equilibrium"
    return x, Refused(Why.UNSETTLED, sentence)


def _implicit(system: System, local: Local, mass: Any, dt: float) -> Array:
    """Return the step that solves M dx = dt f(x + dx), NaN where dt is too large for it.

    Steps that are long beside a growing motion damp it and would end at an unstable equilibrium: the determinant of
    M/dt - df/dx has another sign there. And corrections have to settle: one Newton step alone opens stiff pins by the
    square of the angle that it turns, and what closes them again is so much larger than what moves a mechanism near a
    fold that the motion would wander.
    """
    problem = system.problem
    ahead = Factored(mass / dt - local.raw_jac)
    dx = ahead.solve(local.f)
    for _ in range(_CORRECTIONS):
        if ahead.sign < 0.0 or not float(np.max(np.abs(dx) / problem.state_scale)) <= _LARGEST_START:
            break
        there = system.local(problem.retract(local.x, dx), np.zeros(0))
        more = _solve(mass / dt - there.raw_jac, there.f - mass @ dx / dt)
        dx = dx + more
        if np.max(np.abs(more) / problem.state_scale) <= _CLOSE * np.max(np.abs(dx) / problem.state_scale):
            return dx
    return np.full(problem.n, np.nan)


def _solve(matrix: Any, rhs: Array) -> Array:
    if sparse.issparse(matrix):
        return Factored(matrix).solve(rhs)
    found = solve_dense(matrix, rhs)
    return found if np.isfinite(found).all() else least_squares(matrix, rhs)


def _mass_like(local: Local) -> Any:
    """Return the mass matrix, or the identity for a first-order system (sparse where its Jacobian is)."""
    if sparse.issparse(local.raw_jac):
        return sparse.identity(local.problem.n, format="csc")
    pencil = local.pencil
    return np.eye(local.problem.n) if pencil.mass is None else pencil.mass


def _first_dt(local: Local, mass: Any) -> float:
    """Return a step over which the fastest motion is well resolved."""
    stiffest = abs(local.raw_jac).max(axis=1)
    stiffest = stiffest.toarray().ravel() if sparse.issparse(stiffest) else stiffest
    fast = np.max(stiffest / np.maximum(np.abs(mass.diagonal()), 1e-300))
    return max(float(1.0 / max(fast, 1e-12)), 1e-300)
