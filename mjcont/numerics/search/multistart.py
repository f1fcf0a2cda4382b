"""Levenberg-Marquardt from many starts at once: evaluations of all states go through the problem in batches.

Each run minimises |D f|^2, D the size of each equation at its start, by steps

    s = -(J'J + lambda sigma_1^2)^-1 J' f

from the singular values of the scaled D J, and has converged when Newton's step (lambda = 0) is short.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.algebra import dense, singular
from mjcont.numerics.equations.differences import SECOND_ORDER, jacobian_steps
from mjcont.numerics.equations.problem import Array, Equations, Values

_LARGEST_STEP = 1.0
_ROWS = 200
_SMALLEST = 1e-14


@dataclass(frozen=True, slots=True)
class Runs:
    """Where the runs ended: states, whether each converged, and the sign of det J there."""

    states: Array
    converged: Array
    sign: Array


@dataclass(frozen=True, slots=True)
class Many:
    """f and its derivatives at many states of one problem.

    Attributes
    ----------
    problem : Equations
    values : Values
    flat : bool
        Whether states are vectors of the tangent space, so that steps add.
    single : bool
        Whether states are linearised one by one by the problem itself (it has a Jacobian, or holds rigid modes).
    centre, reach : (nq,) arrays
        A run that leaves centre -+ reach is given up; inf where a coordinate has no end.
    """

    problem: Equations
    values: Values
    flat: bool
    single: bool
    centre: Array
    reach: Array

    def near(self, states: Array) -> Array:
        """Whether states are where the search is, (m,)."""
        found: Array = np.all(np.abs(states - self.centre) <= self.reach, axis=1)
        return found

    def move(self, states: Array, steps: Array) -> Array:
        """Return states moved by scaled steps, (m, nq)."""
        steps = steps * self.problem.state_scale
        if self.flat:
            return states + steps
        return np.array([self.problem.retract(x, s) for x, s in zip(states, steps, strict=True)]).reshape(states.shape)

    def residuals(self, states: Array) -> Array:
        """Return f at every state, (m, n)."""
        out = np.empty((len(states), self.problem.n))
        for i in range(0, len(states), _ROWS):
            out[i : i + _ROWS] = self._batch(states[i : i + _ROWS])
        return out

    def _batch(self, states: Array) -> Array:
        origin = np.zeros(self.problem.n) if self.flat else states[0]
        steps = states if self.flat else np.array([self.problem.difference(x, origin) for x in states])
        return self.problem.residuals(origin, self.values, steps)

    def linearize(self, states: Array) -> tuple[Array, Array]:
        """Return f, (m, n), and its derivatives in scaled unknowns, (m, n, n), at every state."""
        n, scale = self.problem.n, self.problem.state_scale
        f, jac = np.empty((len(states), n)), np.empty((len(states), n, n))
        if self.single:
            f[:], jac[:] = np.nan, np.nan
            for i, x in enumerate(states):
                if np.all(np.isfinite(x)):
                    lin = self.problem.linearize(x, self.values, ())
                    f[i], jac[i] = lin.f, dense(lin.jac) * scale
            return f, jac
        offsets = np.concatenate([np.zeros((1, n)), jacobian_steps(scale, SECOND_ORDER)])
        size = max(_ROWS // len(offsets), 1)
        for i in range(0, len(states), size):
            part = states[i : i + size]
            # lengths are rounded up to powers of two, since a problem keeps an evaluator for each
            padded = part[np.minimum(np.arange(min(size, 1 << (len(part) - 1).bit_length())), len(part) - 1)]
            moved = self.move(np.repeat(padded, len(offsets), axis=0), np.tile(offsets / scale, (len(padded), 1)))
            rows = self._batch(moved).reshape(len(padded), len(offsets), n)[: len(part)]
            f[i : i + size] = rows[:, 0]
            jac[i : i + size] = np.swapaxes(rows[:, 1 : n + 1] - rows[:, n + 1 :], 1, 2) / (2.0 * SECOND_ORDER.step)
        return f, jac


def shortened(steps: Array) -> Array:
    """Return steps of limited length, (m, n); those that are no numbers become zero."""
    steps = np.where(np.all(np.isfinite(steps), axis=1)[:, None], steps, 0.0)
    found: Array = steps * np.minimum(1.0, _LARGEST_STEP / np.maximum(np.linalg.norm(steps, axis=1), 1e-300))[:, None]
    return found


def _rows_scaled(f: Array, jac: Array, weights: Array) -> tuple[Array, Array]:
    return f * weights, jac * weights[:, :, None]


def _weights(jac: Array) -> Array:
    """Return 1 / (size of each equation), guarded where an equation's row of J is small."""
    largest = np.max(np.abs(jac), axis=2)
    found: Array = 1.0 / np.maximum(largest, np.maximum(1e-3 * largest.max(axis=1, keepdims=True), 1e-300))
    return found


def spectral_step(f: Array, jac: Array) -> tuple[Array, Array, Array]:
    """Return Newton's step, the singular values of the row-scaled J and the sign of det J, for every state."""
    finite = np.all(np.isfinite(f), axis=1) & np.all(np.isfinite(jac), axis=(1, 2))
    jac = np.where(finite[:, None, None], jac, 0.0)
    f, jac = _rows_scaled(f, jac, _weights(jac))
    u, sigma, vt = singular(jac)
    step = _damped(u, sigma, vt, f, np.zeros(len(f)))
    return step, sigma, np.sign(np.linalg.det(u) * np.linalg.det(vt))


def _damped(u: Array, sigma: Array, vt: Array, f: Array, damping: Array) -> Array:
    """Return -(J'J + damping)^-1 J' f from the singular values of J."""
    along = np.einsum("mji,mj->mi", u, f)
    floor = np.maximum(sigma, _SMALLEST * np.maximum(sigma[:, :1], 1e-300))
    found: Array = -np.einsum("mij,mi->mj", vt, along * floor / (floor**2 + damping[:, None]))
    return found


def levenberg_marquardt(many: Many, states: Array, *, most: int = 80, tol: float = 1e-7) -> Runs:
    """Run Levenberg-Marquardt from every state at once.

    Parameters
    ----------
    most : iterations.
    tol : length of Newton's step, scaled, at which a run has converged.
    """
    x, active = states.copy(), np.arange(len(states))
    converged, sign = np.zeros(len(x), dtype=bool), np.zeros(len(x))
    damping = np.full(len(x), 1e-3)
    f, jac = many.linearize(x)
    weights = _weights(jac)
    for _ in range(most):
        usable = np.all(np.isfinite(f), axis=1) & np.all(np.isfinite(jac), axis=(1, 2)) & many.near(x[active])
        active, f, jac = active[usable], f[usable], jac[usable]
        if not len(active):
            break
        fs, js = _rows_scaled(f, jac, weights[active])
        u, sigma, vt = singular(js)
        if not sigma[:, 0].any():
            break
        newton = _damped(u, sigma, vt, fs, np.zeros(len(fs)))
        done = np.linalg.norm(newton, axis=1) < tol
        if done.any():
            x[active[done]] = many.move(x[active[done]], newton[done])
            converged[active[done]] = True
            sign[active[done]] = np.sign(np.linalg.det(u[done]) * np.linalg.det(vt[done]))
        left = ~done
        active, f, jac, fs = active[left], f[left], jac[left], fs[left]
        if not len(active):
            break
        step = _damped(u[left], sigma[left], vt[left], fs, damping[active] * sigma[left, 0] ** 2)
        tried = many.move(x[active], shortened(step))
        f1, jac1 = many.linearize(tried)
        better = np.sum((f1 * weights[active]) ** 2, axis=1) < np.sum(fs**2, axis=1)
        damping[active] = np.clip(np.where(better, 0.2, 5.0) * damping[active], 1e-20, 1e3)
        x[active[better]] = tried[better]
        f, jac = np.where(better[:, None], f1, f), np.where(better[:, None, None], jac1, jac)
    return Runs(x, converged, sign)
