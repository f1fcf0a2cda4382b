"""Systems of equations G(x, y) = 0 whose solutions are points or curves: equilibria with conditions on them.

The unknowns are the state x and the vector y = (free parameters, auxiliary unknowns of the conditions). The
equations are f(x, p) = 0 and those of the conditions (`defining`). With one more unknown than equations the
solutions form a curve; with as many, a special point. Unknowns are scaled throughout: a step is
(dx / state_scale, dy), and a parameter's coordinate runs over about one unit within its bounds.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np

from mjcont.numerics.equations.bordered import border, largest_in_rows
from mjcont.numerics.equations.columns import scaled
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Equations, Linearization, Pencil, Ranges, Values

_GRADIENT_STEP = 1e-3
_SLOPE_STEP = 5e-3  # the noise of a condition with stiff bushes over it and the truncation balance there
# a row of J may vanish at a special point: it must not be blown up on the way there
ROW_GUARD = 1e-3
VANISHES = 1e-10
_EVERYWHERE = (-math.inf, math.inf)


class Local:
    """What is known of the problem at one (x, p): computed on demand, once."""

    __slots__ = (
        "_jac", "_lin", "_pencil", "_piece", "_residual", "accurate", "problem", "ranges", "values", "wrt", "x",
    )

    def __init__(
        self, problem: Equations, x: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> None:
        self.problem, self.x, self.values, self.wrt, self.accurate = problem, x, values, wrt, accurate
        self.ranges = ranges
        self._jac: Any = None
        self._lin: Linearization | None = None
        self._pencil: Pencil | None = None
        self._residual: Array | None = None
        self._piece: bytes | None = None

    @property
    def f(self) -> Array:
        """Residual, (n,)."""
        if self._lin is not None:
            return self._lin.f
        if self._residual is None:
            self._residual = self.problem.residual(self.x, self.values)
        return self._residual

    @property
    def piece(self) -> bytes:
        """The smooth piece of f on which the point lies; the same everywhere where f is smooth."""
        if self._lin is not None:
            return self._lin.piece
        if self._piece is None:
            self._residual = self.problem.residual(self.x, self.values)
            self._piece = next(iter(self.problem.pieces), b"")
        return self._piece

    def keep(self, residual: Array) -> None:
        """Take the residual, (n,), computed elsewhere."""
        self._residual = residual

    def take(self, linearization: Linearization) -> None:
        """Take the derivatives computed elsewhere."""
        self._lin = linearization

    def forget(self) -> None:
        """Let matrices go: they are computed again where somebody asks for them."""
        self._residual, self._lin, self._jac, self._pencil = self.f, None, None, None

    @property
    def jac(self) -> Any:
        """df/dx times the state scale: derivatives in scaled unknowns, (n, n)."""
        if self._jac is None:
            jac, scale = self.linearization.jac, self.problem.state_scale
            full, same = isinstance(jac, np.ndarray), bool(np.all(scale == 1.0))  # of hinges it is kept once only
            self._jac = jac if same else jac * scale if full else scaled(jac, columns=scale)
        return self._jac

    @property
    def linearization(self) -> Linearization:
        """What the problem returned: f and its derivatives."""
        if self._lin is None:
            self._lin = self.problem.linearize(
                self.x, self.values, self.wrt, accurate=self.accurate, ranges=self.ranges
            )
        return self._lin

    @property
    def raw_jac(self) -> Any:
        """df/dx in physical units, (n, n)."""
        return self.linearization.jac

    @property
    def par(self) -> Array:
        """df/dp in physical units, (n, k)."""
        return self.linearization.par

    def forget_pencil(self) -> None:
        """Drop M, C and K, which are computed anew when they are asked for."""
        self._pencil = None

    @property
    def pencil(self) -> Pencil:
        """M, C, K."""
        if self._pencil is None:
            self._pencil = self.problem.pencil(self.x, self.values, self.raw_jac)
        return self._pencil


def equation_scale(local: Local) -> Array:
    """Return 1 / (size of each equation) from the rows of J, guarded where they (or all of J) vanish, (n,)."""
    largest = largest_in_rows(local.jac)
    by_parameters = float(np.abs(local.par).max()) if local.par.size else 0.0
    top = max(float(largest.max()), ROW_GUARD * by_parameters)
    if top < VANISHES:  # a degenerate point: take the sizes a little beside it
        beside = local.problem.residual(local.problem.retract(local.x, 0.1 * local.problem.state_scale), local.values)
        top = max(10.0 * float(np.abs(beside).max()), 1e-300)
    return 1.0 / np.maximum(largest, ROW_GUARD * top)


def equation_sizes(jacs: Array) -> Array:
    """Return the size of each equation, guarded as in `equation_scale`, from matrices (m, n, n + 1 or more), (m, n)."""
    n = jacs.shape[1]
    largest = np.abs(jacs[:, :, :n]).max(axis=2)
    top: Array = np.maximum(largest.max(axis=1), ROW_GUARD * np.abs(jacs[:, :, n:]).max(axis=(1, 2)))
    found: Array = np.maximum(largest, ROW_GUARD * top[:, None])
    return found


class Condition(ABC):
    """Equations beside f = 0.

    Attributes
    ----------
    count : number of equations.
    aux : starting values of the auxiliary unknowns it adds to y.
    direction : (n,) what its first auxiliary unknown adds to f, None where it adds nothing (see `BranchPoint`).
    """

    count: int = 1
    aux: tuple[float, ...] = ()
    direction: Array | None = None

    @abstractmethod
    def value(self, local: Local, aux: Array) -> Array:
        """Return the equations' values, (count,)."""

    def error(self, local: Local, aux: Array) -> Array:
        """Return what differences of their own leave open of the values, (count,)."""
        del local, aux
        return np.zeros(self.count)

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return the derivatives over (x, free parameters), (count, n + number free), or all unknowns, (count, n + k).

        None: by differences.
        """
        del local, system, y
        return None

    def update(self, local: Local, aux: Array) -> None:
        """Renew the borders at a solution, so that the system stays regular along a curve."""
        del local, aux

    def exists(self, aux: Array) -> bool:
        """Whether a solution with these auxiliary unknowns is a point of its kind."""
        del aux
        return True


class System:
    """f = 0 and conditions, as equations in (x, y).

    Parameters
    ----------
    problem : Equations
    base : Values
        A value for every parameter; the free ones are replaced.
    free : sequence of Free
    conditions : sequence of Condition
    accurate : bool
        Whether derivatives are those for locating special points.
    """

    def __init__(
        self,
        problem: Equations,
        base: Values,
        free: Sequence[Free],
        conditions: Sequence[Condition] = (),
        accurate: bool = False,
    ) -> None:
        self.problem, self.base, self.free = problem, dict(base), tuple(free)
        self.conditions, self.accurate = tuple(conditions), accurate
        self.names = tuple(p.name for p in self.free)
        self.ranges = tuple((p.low, p.high) for p in self.free)
        self.n = problem.n
        self.k = len(self.free) + sum(len(c.aux) for c in self.conditions)
        self.equations = self.n + sum(c.count for c in self.conditions)
        ends = [(p.coordinate(p.low), p.coordinate(p.high)) if p.bounded else _EVERYWHERE for p in self.free]
        ends += [_EVERYWHERE] * (self.k - len(self.free))
        self.lowest, self.highest = np.array(ends).reshape(-1, 2).T

    def start_y(self) -> Array:
        """Return y with parameters at their base values and auxiliary unknowns at their starts, (k,)."""
        aux = [a for c in self.conditions for a in c.aux]
        return np.array([p.coordinate(self.base[p.name]) for p in self.free] + aux)

    def values(self, y: Array) -> dict[str, float]:
        """Return the value of every parameter at y."""
        merged = self.base.copy()
        for p, u in zip(self.free, y.tolist(), strict=False):
            merged[p.name] = p.value(u)
        return merged

    def where(self, y: Array) -> str:
        """Return the free parameters at y as a sentence shows them."""
        return ", ".join(f"{p.name} = {p.show(p.value(u))}" for p, u in zip(self.free, y.tolist(), strict=False))

    def local(self, x: Array, y: Array) -> Local:
        """Return the evaluation at (x, y)."""
        return Local(self.problem, x, self.values(y), self.names, self.accurate, self.ranges)

    def locals_along(self, states: Array, column: Array) -> list[Local]:
        """Return the evaluations at states (m, nq) of a system with one free parameter, with its values (m,)."""
        (name,), found = self.names, []
        for x, value in zip(states, column.tolist(), strict=True):
            merged = self.base.copy()
            merged[name] = value
            found.append(Local(self.problem, x, merged, self.names, self.accurate, self.ranges))
        return found

    def residuals_at(self, states: Array, coordinates: Array) -> Array:
        """Return f at states (m, nq) with coordinates (m, k), shape (m, n)."""
        columns = {p.name: p.values(coordinates[:, i]) for i, p in enumerate(self.free)}
        return self.problem.residuals_along(states, self.base, columns)

    def _aux(self, y: Array) -> list[Array]:
        parts, at = [], len(self.free)
        for c in self.conditions:
            parts.append(y[at : at + len(c.aux)])
            at += len(c.aux)
        return parts

    def place(self, condition: Condition) -> int:
        """Return where in y the auxiliary unknowns of a condition begin."""
        before = self.conditions[: self.conditions.index(condition)]
        return len(self.free) + sum(len(c.aux) for c in before)

    def residual(self, local: Local, y: Array) -> Array:
        """Return G, (equations,)."""
        if not self.conditions:
            return local.f
        parts = [local.f]
        for c, aux in zip(self.conditions, self._aux(y), strict=True):
            if c.direction is not None:
                parts[0] = parts[0] + aux[0] * c.direction
            parts.append(c.value(local, aux))
        return np.concatenate(parts)

    def left_open(self, local: Local, y: Array) -> Array:
        """Return what differences leave open of G, (equations,)."""
        parts = [np.zeros(self.n)]
        parts += [c.error(local, aux) for c, aux in zip(self.conditions, self._aux(y), strict=True)]
        return np.concatenate(parts)

    def jacobian(self, local: Local, y: Array) -> Any:
        """Return dG in scaled unknowns, (equations, n + k)."""
        slopes = [p.slope(u) for p, u in zip(self.free, y, strict=False)]
        if not self.conditions and isinstance(local.jac, np.ndarray):
            out = np.empty((self.n, self.n + self.k))
            out[:, : self.n] = local.jac
            np.multiply(local.par, slopes, out=out[:, self.n :])
            return out
        columns = np.zeros((self.n, self.k))
        columns[:, : len(self.free)] = local.par * np.array(slopes)
        at = len(self.free)
        for c in self.conditions:
            if c.direction is not None:
                columns[:, at] = c.direction
            at += len(c.aux)
        rows = self._condition_rows(local, y)
        return border(local.jac, columns, rows[:, : self.n], rows[:, self.n :])

    def _condition_rows(self, local: Local, y: Array) -> Array:
        rows = np.zeros((self.equations - self.n, self.n + self.k))
        at, rest = 0, list[tuple[int, Condition]]()
        for c in self.conditions:
            gradient = c.gradient(local, self, y)
            if gradient is not None:
                rows[at : at + c.count, : gradient.shape[1]] = gradient
            else:
                rest.append((at, c))
            at += c.count
        if rest:
            found, done = self.gradients([c for _, c in rest], local, y), 0
            for at, c in rest:
                rows[at : at + c.count] = found[done : done + c.count]
                done += c.count
        return rows

    def gradients(self, conditions: Sequence[Condition], local: Local, y: Array) -> Array:
        """Return the gradients of conditions by centred differences, (count, n + k): good enough for most of Newton."""
        gradient = np.empty((sum(c.count for c in conditions), self.n + self.k))
        for j in range(self.n + self.k):
            h = self.gradient_step(j - self.n, y)
            step = np.zeros(self.n + self.k)
            step[j] = h
            (after, beyond), (before, behind) = (self._conditions_at(conditions, local, y, s) for s in (step, -step))
            apart = 2.0 * h if j < self.n else beyond[j - self.n] - behind[j - self.n]  # one-sided at a bound
            gradient[:, j] = (after - before) / apart
        return gradient

    def slope(self, condition: Condition, local: Local, y: Array, direction: Array) -> Array:
        """Return the derivative of a condition along a scaled direction (n + k,), fourth order, (count,)."""
        h = _SLOPE_STEP / float(np.abs(direction).max())
        near, far = (
            self._conditions_at([condition], local, y, s * direction)[0]
            - self._conditions_at([condition], local, y, -s * direction)[0]
            for s in (h, 2.0 * h)
        )
        return np.asarray((8.0 * near - far) / (12.0 * h))

    def _conditions_at(
        self, conditions: Sequence[Condition], local: Local, y: Array, step: Array
    ) -> tuple[Array, Array]:
        """Return the conditions at a scaled step, (count,), and the y there, which stays within its bounds."""
        x, moved = self.move(local.x, y, step)
        at, parts = self.local(x, moved), self._aux(moved)
        return np.concatenate([c.value(at, parts[self.conditions.index(c)]) for c in conditions]), moved

    def gradient_step(self, i: int, y: Array) -> float:
        """Return the difference step for y[i]: smaller where a parameter is small in its range; i < 0 for the state."""
        if not 0 <= i < len(self.free):
            return _GRADIENT_STEP
        p, u = self.free[i], float(y[i])
        _, h = self.problem.parameter_stencil(p.name, p.value(u), (p.low, p.high))
        return float(min(_GRADIENT_STEP, max(abs(h / p.slope(u)), 1e-7)))

    def move(self, x: Array, y: Array, step: Array) -> tuple[Array, Array]:
        """Return (x, y) moved by a scaled step (n + k,); free parameters stay within their bounds."""
        moved = np.minimum(np.maximum(y + step[self.n :], self.lowest), self.highest)
        return self.problem.retract(x, step[: self.n] * self.problem.state_scale), moved

    def move_each(self, states: Array, coordinates: Array, steps: Array) -> tuple[Array, Array]:
        """Return states (m, nq), or one (nq,), and coordinates (m, k) moved by the rows of scaled steps (m, n + k).

        Free parameters stay within their bounds.
        """
        moves = steps[:, : self.n] * self.problem.state_scale
        moved = np.minimum(np.maximum(coordinates + steps[:, self.n :], self.lowest), self.highest)
        return self.problem.retract_each(states, moves), moved

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a scaled step without motions that the problem holds (see `rigid`)."""
        scale = self.problem.state_scale
        return np.concatenate([self.problem.admissible(x, step[: self.n] * scale) / scale, step[self.n :]])

    def difference(self, x1: Array, y1: Array, x0: Array, y0: Array) -> Array:
        """Return the scaled step from (x0, y0) to (x1, y1), (n + k,)."""
        step = np.empty(self.n + self.k)
        step[: self.n] = self.problem.difference(x1, x0)
        step[: self.n] /= self.problem.state_scale
        step[self.n :] = y1 - y0
        return step

    def chords(self, states: Array, coordinates: Array) -> Array:
        """Return the scaled steps from each point to the next, (m - 1, n + k), for states (m, nq) and y (m, k)."""
        moves = self.problem.difference_each(states[1:], states[:-1]) / self.problem.state_scale
        return np.hstack([moves, np.diff(coordinates, axis=0)])

    def update(self, local: Local, y: Array) -> None:
        """Renew the conditions' borders at a solution."""
        for c, aux in zip(self.conditions, self._aux(y), strict=True):
            c.update(local, aux)

    def error(self, local: Local, x: Array, y: Array) -> float:
        """Return the largest residual of the equilibrium equations at (x, y), relative to the size of each equation.

        `local` is an evaluation nearby, whose derivatives give those sizes.
        """
        f = self.problem.residual(x, self.values(y))
        for c, aux in zip(self.conditions, self._aux(y), strict=True):
            if c.direction is not None:
                f = f + aux[0] * c.direction
        return float(np.max(np.abs(f) * equation_scale(local)))
