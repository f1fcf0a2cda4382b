"""Newton's method on a `System`: with a row beside it for a point of a curve, without for a special point."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.algebra import least_squares
from mjcont.numerics.equations.algebra import solve as solve_dense
from mjcont.numerics.equations.bordered import Factored, border
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local, System

_SLOW = 0.5
_FIRST, _LATER = 1e5, 1e2
_POLISH = 3
_DIVERGING = 2.0
_NOISE = 1e-6
# a step this many times the last Newton step is not made by noise
_FIRM = 3.0
LARGEST_ERROR = 1e-7
_LARGEST_STEP = 2.0
# steps that grow twice in a row, and so much, are not those of noise: one was small by chance, between two solutions
_GROWS = 2.0
_DIVERGED = Refused(Why.DIVERGED, "the corrector diverged")
_NEWTON_DIVERGED = Refused(Why.DIVERGED, "Newton's method diverged")
_STANDS_STILL = Refused(Why.UNSETTLED, "the corrector stands still")
# a step that was to be the last and is followed by one so many times longer did not lead to the curve
_JUMPS = 10.0
# chord steps that differ by less are the same one again; how often it is lengthened, and how far points may be lifted
_SAME_STEP, _TIMES, _LIFT = 0.1, 10, 5e-4


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
    contraction : ratio of the last two steps before the last Newton step that are well above the noise.
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
    reach: float = np.inf,
    local: Local | None = None,
) -> Corrected:
    """Return to the curve from a prediction, moving orthogonally to `row`.

    Broyden steps from `lu` while they contract, renewed derivatives when they do not; a last Newton step with
    derivatives at the solution takes the point to the noise floor. `expected` is the contraction of the first step
    with `lu`, where the last points tell it: one step may then be enough. A point farther than `reach` from the
    prediction would be refused. `local` is the evaluation at the prediction, where there is one.
    """
    size, ratio, tol = np.inf, 0.0, settings.tol
    failure: Refused | None = Refused(Why.UNSETTLED, "the corrector did not converge")
    local, iterations = local or system.local(x, y), 0
    steps, sizes, creeps = list[Array](), list[float](), False
    chord: Array | None = None
    while iterations < settings.max_corrections:
        iterations += 1
        if lu is None:
            lu, steps, chord = Factored(matrix_with_row(system, local, y, row)), [], None
        before, chord = chord, _newton_step(system, local, y, lu, row)[0]
        same = before is not None and length(chord - before) <= _SAME_STEP * length(before)
        if same and system.problem.nonsmooth:
            if creeps:
                failure = _STANDS_STILL
                break
            x, y, local = _crept(system, x, y, chord, lu, row, reach)
            creeps, chord, steps, size = True, None, [], np.inf
            continue
        step = _broyden(chord, steps)
        last, size = size, length(step)
        sizes.append(size)
        if not size < _LARGEST_STEP:
            failure = _DIVERGED if np.isfinite(size) else undefined(system)
            break
        ratio = size / last if np.isfinite(last) else 0.0
        x, y = system.move(x, y, step)
        local = system.local(x, y)
        rate, most = (expected, _FIRST) if iterations == 1 else (ratio, _LATER)
        converged = size <= tol or (rate > 0.0 and size <= most * tol and size * rate <= 0.1 * tol)
        if converged or (ratio > _SLOW and size <= _NOISE and iterations > 2):  # as close as the noise of f allows
            found = _polished(system, x, y, local, row, size, tol)
            if found is not None:
                return replace(found, iterations=iterations, contraction=_contraction(sizes, found.step))
            steps = []
            continue
        if ratio > _DIVERGING:
            failure = _DIVERGED
            break
        steps.append(step)
        if ratio > _SLOW and len(steps) > 2:
            lu = None
    return Corrected(x, y, local, lu, iterations, ratio, size, np.inf, failure)


def _contraction(sizes: Sequence[float], noise: float) -> float:
    """Return the ratio of the last two steps that noise has not made, 0 if there are none: of that it tells nothing."""
    firm = [size > _FIRM * noise for size in sizes[1:]]
    told = [after / before for before, after, tells in zip(sizes, sizes[1:], firm, strict=False) if tells]
    return told[-1] if told else 0.0


def _polished(
    system: System, x: Array, y: Array, local: Local, row: Array, size: float, tol: float
) -> Corrected | None:
    """Return a point taken to the noise floor by Newton steps with derivatives of its own, after a step of a size.

    None where f is smooth in pieces and the point lies on another piece than the curve, so that they lead away.
    """
    before = size
    for k in range(_POLISH):  # derivatives are to be those of the point itself
        jac = system.jacobian(local, y)
        factored = Factored(with_row(jac, row))
        step, _ = _newton_step(system, local, y, factored, row)
        last, size = size, length(step)
        if not k and size > _JUMPS * max(before, tol) and system.problem.nonsmooth:
            return None
        x, y = system.move(x, y, step)
        if size <= tol:
            break
        local = system.local(x, y)
    error = system.error(local, x, y)
    failure = None if error < LARGEST_ERROR else Refused(Why.STALLED, "the corrector stalled away from the curve")
    return Corrected(x, y, local, factored, 0, 0.0, size, error, failure, jac, size / max(last, 1e-300))


def _crept(
    system: System, x: Array, y: Array, chord: Array, lu: Factored, row: Array, reach: float
) -> tuple[Array, Array, Local]:
    """Return (x, y) moved by as many chord steps as leave the next one the same, four times as many each time.

    A prediction that lifts a stiff contact off by many times its yield is brought back by that yield in each step: a
    contact that is open has no force, however far it is open. Points farther than `reach` away are of no use.
    """
    for k in range(_TIMES):
        x, y = system.move(x, y, 4.0**k * chord)
        local = system.local(x, y)
        following = _newton_step(system, local, y, lu, row)[0]
        if length(following - chord) > _SAME_STEP * length(chord) or 4.0**k * length(chord) > min(reach, _LIFT):
            break
    return x, y, local


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
        elif since_best and size > max(last, _GROWS * best):  # it has not been there yet
            best, best_at, since_best = size, (x, y), 0
        else:
            since_best += 1
        if size <= tol or (best < 1e-6 and since_best >= (1 if best < 1e-9 else 3)):
            break
    x, y = best_at
    local = system.local(x, y)
    failure = None if best < 1e-6 else Refused(Why.UNSETTLED, "Newton's method did not converge")
    if failure is None and np.linalg.norm(system.difference(x, y, x0, y0)) > 2.0 * reach:
        failure = Refused(Why.WANDERED, "Newton's method left the neighbourhood")
    return Corrected(x, y, local, factored, iteration, ratio, best, system.error(near, x, y), failure)


def known_to(system: System, c: Corrected) -> float:
    """Return to what a solution is known (scaled): noise and errors of its equations over their slopes.

    A last step may be small by chance: that which follows tells the noise once more.
    """
    if c.factored is None:
        return c.step
    y = c.y[: system.k]
    following, _ = _newton_step(system, c.local, y, c.factored, None)
    return max(c.step, length(following), length(c.factored.solve(system.left_open(c.local, y))))


def solve_linear(matrix: Any, rhs: Array) -> Array:
    """Return the solution of a linear system, dense or sparse; where it is singular the shortest of the nearest."""
    if sparse.issparse(matrix):
        return Factored(matrix).solve(rhs)
    found = solve_dense(matrix, rhs)
    return found if np.isfinite(found).all() else least_squares(matrix, rhs)
