"""Systems of equations G(x, y) = 0 whose solutions are points or curves: equilibria with conditions on them.

The unknowns are the state x and the vector y = (free parameters, auxiliary unknowns of the conditions). The
equations are f(x, p) = 0 and those of the conditions (`defining.py`). With one more unknown than equations the
solutions form a curve; with as many, a special point. Unknowns are scaled throughout: a step is
(dx / state_scale, dy), and a parameter's coordinate runs over about one unit within its bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from scipy import sparse

from mjcont.numerics.bordered import border, largest_in_rows
from mjcont.numerics.differences import pieces
from mjcont.numerics.problem import Array, Pencil, Problem, Values

_LOG_SPAN = 1e3
_GRADIENT_STEP = 1e-3
# a row of J may vanish at a special point: it must not be blown up on the way there
ROW_GUARD = 1e-3
_VANISHES = 1e-10
_BATCHES = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)


@dataclass(frozen=True, slots=True)
class Free:
    """A free parameter and its coordinate: linear, or logarithmic where positive bounds span three decades."""

    name: str
    low: float
    high: float
    unit: str = ""

    def show(self, value: float) -> str:
        """Return a value as a sentence shows it, radians in degrees."""
        return f"{math.degrees(value):.6g} deg" if self.unit == "rad" else f"{value:.6g} {self.unit}".rstrip()

    @property
    def log(self) -> bool:
        """Whether the coordinate is logarithmic."""
        return self.low > 0 and self.high / self.low >= _LOG_SPAN

    def coordinate(self, value: float) -> float:
        """Return the coordinate of a value."""
        if self.log:
            return math.log(value) / math.log(self.high / self.low)
        return value / (self.high - self.low)

    def value(self, coordinate: float) -> float:
        """Return the value at a coordinate."""
        if self.log:
            return math.exp(min(coordinate * math.log(self.high / self.low), 700.0))
        return coordinate * (self.high - self.low)

    def values(self, coordinates: Array) -> Array:
        """Return the values at many coordinates."""
        if self.log:
            return np.exp(np.minimum(coordinates * math.log(self.high / self.low), 700.0))
        return coordinates * (self.high - self.low)

    def slope(self, coordinate: float) -> float:
        """Return d value / d coordinate."""
        if self.log:
            return self.value(coordinate) * math.log(self.high / self.low)
        return self.high - self.low


class Local:
    """What is known of the problem at one (x, p): computed on demand, once."""

    __slots__ = ("_jac", "_lin", "_pencil", "_piece", "_residual", "accurate", "problem", "spans", "values", "wrt", "x")

    def __init__(
        self,
        problem: Problem,
        x: Array,
        values: Values,
        wrt: Sequence[str],
        accurate: bool,
        spans: Sequence[float] = (),
    ) -> None:
        self.problem, self.x, self.values, self.wrt, self.accurate = problem, x, values, wrt, accurate
        self.spans = spans
        self._jac: Any = None
        self._lin: Any = None
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
            self._piece = next(iter(pieces(self.problem)), b"")
        return self._piece

    def keep(self, residual: Array) -> None:
        """Take the residual, (n,), computed elsewhere."""
        self._residual = residual

    def _linearize(self) -> Any:
        if self._lin is None:
            self._lin = self.problem.linearize(
                self.x, self.values, self.wrt, accurate=self.accurate, spans=self.spans
            )
        return self._lin

    @property
    def jac(self) -> Any:
        """df/dx times the state scale: derivatives in scaled unknowns, (n, n)."""
        if self._jac is None:
            jac, scale = self._linearize().jac, self.problem.state_scale
            self._jac = jac * scale if isinstance(jac, np.ndarray) else (jac @ sparse.diags(scale)).tocsc()
        return self._jac

    @property
    def raw_jac(self) -> Any:
        """df/dx in physical units, (n, n)."""
        return self._linearize().jac

    @property
    def par(self) -> Array:
        """df/dp in physical units, (n, k)."""
        return self._linearize().par

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
    if top < _VANISHES:  # a degenerate point: take the sizes a little beside it
        beside = local.problem.residual(local.problem.retract(local.x, 0.1 * local.problem.state_scale), local.values)
        top = max(10.0 * float(np.abs(beside).max()), 1e-300)
    return 1.0 / np.maximum(largest, ROW_GUARD * top)


def equation_sizes(jacs: Array) -> Array:
    """Return the size of each equation, guarded as in `equation_scale`, from matrices (m, n, n + 1), shape (m, n)."""
    n = jacs.shape[1]
    largest = np.abs(jacs[:, :, :n]).max(axis=2)
    top = np.maximum(largest.max(axis=1), ROW_GUARD * np.abs(jacs[:, :, n]).max(axis=1))
    return np.maximum(largest, ROW_GUARD * top[:, None])


class Condition(Protocol):
    """Equations beside f = 0.

    Attributes
    ----------
    count : number of equations.
    aux : starting values of the auxiliary unknowns it adds to y.
    unfolds : whether its first auxiliary unknown adds `direction` to f (see `BranchPoint`).
    """

    count: int
    aux: tuple[float, ...]
    unfolds: bool

    def value(self, local: Local, aux: Array) -> Array:
        """Return the equations' values, (count,)."""
        ...

    def update(self, local: Local, aux: Array) -> None:
        """Renew the borders at a solution, so that the system stays regular along a curve."""
        ...


class System:
    """f = 0 and conditions, as equations in (x, y).

    Parameters
    ----------
    problem : Problem
    base : Values
        A value for every parameter; the free ones are replaced.
    free : sequence of Free
    conditions : sequence of Condition
    accurate : bool
        Whether derivatives are those for locating special points.
    """

    def __init__(
        self,
        problem: Problem,
        base: Values,
        free: Sequence[Free],
        conditions: Sequence[Condition] = (),
        accurate: bool = False,
    ) -> None:
        self.problem, self.base, self.free = problem, dict(base), tuple(free)
        self.conditions, self.accurate = tuple(conditions), accurate
        self.names = tuple(p.name for p in self.free)
        self.spans = tuple(p.high - p.low for p in self.free)
        self.n = problem.n
        self.k = len(self.free) + sum(len(c.aux) for c in self.conditions)
        self.equations = self.n + sum(c.count for c in self.conditions)

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

    def local(self, x: Array, y: Array) -> Local:
        """Return the evaluation at (x, y)."""
        return Local(self.problem, x, self.values(y), self.names, self.accurate, self.spans)

    def locals_along(self, states: Array, column: Array) -> list[Local]:
        """Return the evaluations at states (m, nq) of a system with one free parameter, with its values (m,)."""
        (name,), found = self.names, []
        for x, value in zip(states, column.tolist(), strict=True):
            merged = self.base.copy()
            merged[name] = value
            found.append(Local(self.problem, x, merged, self.names, self.accurate, self.spans))
        return found

    def residuals_at(self, states: Array, coordinates: Array) -> Array:
        """Return f at states (m, nq) of a system with one free parameter, with its coordinates (m, k), shape (m, n)."""
        (p,) = self.free
        found, values = np.empty((len(states), self.n)), p.values(coordinates[:, 0])
        first, count = 0, len(states)
        while first < count:  # in batches of few sizes, so that they are kept
            size = next((s for s in _BATCHES if s >= count - first), _BATCHES[-1])
            rows = np.minimum(np.arange(first, first + size), count - 1)
            here = self.problem.residuals_along(states[rows], self.base, p.name, values[rows])
            found[first : first + size] = here[: count - first]
            first += size
        return found

    def _aux(self, y: Array) -> list[Array]:
        parts, at = [], len(self.free)
        for c in self.conditions:
            parts.append(y[at : at + len(c.aux)])
            at += len(c.aux)
        return parts

    def residual(self, local: Local, y: Array) -> Array:
        """Return G, (equations,)."""
        if not self.conditions:
            return local.f
        parts = [local.f]
        for c, aux in zip(self.conditions, self._aux(y), strict=True):
            if c.unfolds:
                parts[0] = parts[0] + aux[0] * c.direction  # type: ignore[attr-defined]
            parts.append(c.value(local, aux))
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
            if c.unfolds:
                columns[:, at] = c.direction  # type: ignore[attr-defined]
            at += len(c.aux)
        rows = self._condition_rows(local, y)
        return border(local.jac, columns, rows[:, : self.n], rows[:, self.n :])

    def _condition_rows(self, local: Local, y: Array) -> Array:
        rows = np.zeros((self.equations - self.n, self.n + self.k))
        at, rest = 0, []
        for c, aux in zip(self.conditions, self._aux(y), strict=True):
            gradient: Callable[..., Array] | None = getattr(c, "gradient", None)
            if gradient is not None:
                rows[at : at + c.count, : self.n + len(self.free)] = gradient(local, self, y)
            else:
                rest.append((at, c, aux))
            at += c.count
        if rest:
            self._difference_rows(rows, rest, local, y)
        return rows

    def _difference_rows(self, rows: Array, rest: Sequence[Any], local: Local, y: Array) -> None:
        """Fill the rows of conditions without a gradient by centred differences: good enough for Newton's matrix."""

        def conditions_at(step: Array) -> Array:
            x, y1 = self.move(local.x, y, step)
            moved = self.local(x, y1)
            parts = self._aux(y1)
            return np.concatenate([c.value(moved, parts[self.conditions.index(c)]) for _, c, _ in rest])

        gradient = np.empty((sum(c.count for _, c, _ in rest), self.n + self.k))
        for j in range(self.n + self.k):
            h = self._gradient_step(j - self.n, y)
            step = np.zeros(self.n + self.k)
            step[j] = h
            gradient[:, j] = (conditions_at(step) - conditions_at(-step)) / (2.0 * h)
        done = 0
        for at, c, _ in rest:
            rows[at : at + c.count] = gradient[done : done + c.count]
            done += c.count

    def _gradient_step(self, i: int, y: Array) -> float:
        """Return the difference step for y[i]: smaller where a parameter is small in its range; i < 0 for the state."""
        if not 0 <= i < len(self.free):
            return _GRADIENT_STEP
        p, u = self.free[i], float(y[i])
        _, h = self.problem.parameter_stencil(p.name, p.value(u), p.high - p.low)
        return float(min(_GRADIENT_STEP, max(abs(h / p.slope(u)), 1e-7)))

    def move(self, x: Array, y: Array, step: Array) -> tuple[Array, Array]:
        """Return (x, y) moved by a scaled step (n + k,)."""
        return self.problem.retract(x, step[: self.n] * self.problem.state_scale), y + step[self.n :]

    def move_each(self, states: Array, coordinates: Array, steps: Array) -> tuple[Array, Array]:
        """Return states (m, nq), or one (nq,), and coordinates (m, k) moved by the rows of scaled steps (m, n + k)."""
        moves = steps[:, : self.n] * self.problem.state_scale
        return self.problem.retract_each(states, moves), coordinates + steps[:, self.n :]

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a scaled step without motions that the problem holds (see `rigid`)."""
        problem: Any = self.problem
        if not hasattr(problem, "admissible"):
            return step
        scale = problem.state_scale
        return np.concatenate([problem.admissible(x, step[: self.n] * scale) / scale, step[self.n :]])

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
            if c.unfolds:
                f = f + aux[0] * c.direction  # type: ignore[attr-defined]
        return float(np.max(np.abs(f) * equation_scale(local)))
