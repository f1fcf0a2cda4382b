"""Derivatives of a special point in parameters that its defining system does not solve for, by adjoints.

A special point solves G(X; p) = 0, X = (state, free parameters, auxiliary unknowns) and p any other parameter. For a
quantity Q(X, p) one adjoint solve G_X' psi = Q_X serves all parameters:

    dQ/dp = Q_p - psi . G_p.

For the free parameter of a fold psi is the left null vector: d lambda/dp = -(w . f_p) / (w . f_lambda). The rows of G_X
and G_p that belong to a fold and a cusp are derivatives of f along frozen vectors: with the bordered matrix A, its
null vectors v, w and B = f_xx,

    dg = -w . dJ v,    dc = w . dB(v, v) / 2 - w . dJ d - a . dJ v,    A d = B(v, v) / 2,    A' a = (w . B(v, .))'

so that a parameter costs a few evaluations of f instead of a solution. Other conditions are differenced as they stand.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.errors import MjcontError
from mjcont.numerics.equations.bends import bend, bends_itself
from mjcont.numerics.equations.bordered import Factored, border
from mjcont.numerics.equations.defining import BranchPoint, Fold, Hopf
from mjcont.numerics.equations.differences import (
    FIRST,
    NODES,
    PARAMETER,
    SECOND,
    inward,
    kept_within,
    length_of,
    second_form,
)
from mjcont.numerics.equations.onfolds import FoldCoefficient
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.system import Condition, Local, System

_RAY = 1e-2
_STATE_STEP = 3e-3
_NODES = NODES[NODES != 0.0]
_FIRST = FIRST[NODES != 0.0]


class Adjoint:
    """The linearisation of a square system at its solution.

    Attributes
    ----------
    system, x, y : the system and its solution.
    local : the evaluation there.
    """

    def __init__(self, system: System, x: Array, y: Array) -> None:
        if system.equations != system.n + system.k:
            raise MjcontError(f"{system.equations} equations for {system.n + system.k} unknowns: no square system")
        self.system, self.x, self.y = system, x, y
        self.local = system.local(x, y)
        self._frozen = _Frozen(system, self.local, self.y)
        self._factored: Factored | None = None
        self._base: dict[bool, Array] = {}

    def weights(self, gradient: Array) -> Array:
        """Return psi with G_X' psi = `gradient`, a quantity's derivative in scaled (x, y), (equations,)."""
        plain = self._plain_fold(gradient)
        if plain is not None:
            return plain
        return self._factors().solve_transposed(gradient)

    def moves(self, slopes: Array) -> Array:
        """Return how the scaled (x, y) move with parameters whose slopes G_p (equations, m) are given, (n + k, m)."""
        factors = self._factors()
        return np.column_stack([-factors.solve(column) for column in slopes.T])

    def correction(self, residual: Array) -> Array:
        """Return the chord step -G_X^-1 G, (n + k,), for G (equations,) at a solution nearby."""
        return -self._factors().solve(residual)

    def _factors(self) -> Factored:
        if self._factored is None:
            self._factored = Factored(self._jacobian())
        return self._factored

    def _plain_fold(self, gradient: Array) -> Array | None:
        """Return psi for the parameter of a fold, for which no second derivative is needed."""
        fold, n = self._frozen.fold, self.system.n
        if fold is None or len(self.system.conditions) > 1 or len(self.system.free) != 1 or gradient[:n].any():
            return None
        _, w = fold.physical(self.local)
        slope = float(w @ self.local.par[:, 0]) * self.system.free[0].slope(float(self.y[0]))
        return np.append(w * (gradient[n] / slope if slope else math.nan), 0.0)

    def _jacobian(self) -> Any:
        system, n = self.system, self.system.n
        columns, rows = np.zeros((n, system.k)), np.zeros((system.equations - n, n + system.k))
        rows[:, :n] = self._frozen.state_rows(self.y)
        for i, p in enumerate(system.free):
            whole = self.equations_slope(p.name, True) * p.slope(float(self.y[i]))
            columns[:, i], rows[:, n + i] = self.local.par[:, i] * p.slope(float(self.y[i])), whole[n:]
        for j in range(len(system.free), system.k):
            rows[:, n + j] = _sixth(lambda t, j=j: self._conditions_at(j, t), _RAY)  # type: ignore[misc]
        at = len(system.free)
        for c in system.conditions:
            if c.direction is not None:
                columns[:, at] = c.direction
            at += len(c.aux)
        return border(self.local.jac, columns, rows[:, :n], rows[:, n:])

    def _conditions_at(self, j: int, change: float) -> Array:
        y = self.y.copy()
        y[j] += change
        return self.system.residual(self.local, y)[self.system.n :]

    def equations_slope(self, name: str, conditions: bool) -> Array:
        """Return G_p for a parameter, (equations,); without `conditions` their rows are zero."""
        system = self.system
        bounds = system.ranges[system.names.index(name)] if name in system.names else None
        here = self.local.values

        def equations(value: float) -> Array:
            return self._frozen.equations({**here, name: value}, self.y, conditions)

        problem, value = system.problem, here[name]
        parameter = problem.parameter(name)
        rule, h = problem.parameter_stencil(name, value, bounds)
        if parameter.affine and conditions and not self._frozen.all_frozen:  # only forces are affine, not conditions
            low, high = bounds or parameter.bounds
            size = max(abs(value), 1e-2 * (high - low))
            rule, h = kept_within(PARAMETER, PARAMETER.step * size, value, parameter.hard_bounds)
        elif parameter.affine:
            if conditions not in self._base:
                self._base[conditions] = self._frozen.equations(here, self.y, conditions)
            h = inward(value, h, parameter.hard_bounds)
            return (equations(value + h) - self._base[conditions]) / h
        parts = [w * equations(value + o * h) for o, w in zip(rule.offsets, rule.weights, strict=True)]
        found: Array = np.sum(parts, axis=0) / h
        return found


class _Frozen:
    """The equations at other parameter values with null vectors frozen, and their gradients in the state."""

    def __init__(self, system: System, local: Local, y: Array) -> None:
        self.system, self.local, self.y = system, local, y
        self.conditions = system.conditions
        self.fold: Fold | None = next((c for c in self.conditions if isinstance(c, Fold)), None)
        self.cusp: FoldCoefficient | None = next((c for c in self.conditions if isinstance(c, FoldCoefficient)), None)
        self._vectors: Mapping[str, Array] | None = None

    @property
    def all_frozen(self) -> bool:
        """Whether all conditions are those of a fold or cusp, whose frozen form is linear in the forces."""
        return all(c is self.fold or c is self.cusp for c in self.conditions)

    @property
    def vectors(self) -> Mapping[str, Array]:
        """The fold's v and w, the cusp's d and a of the cusp, in physical units, and B(v, .) in scaled unknowns."""
        if self._vectors is None and self.fold is not None:
            self._vectors = self._prepared(self.fold)
        return self._vectors or {}

    def _prepared(self, fold: Fold) -> Mapping[str, Array]:
        local, problem = self.local, self.local.problem
        v, w = fold.physical(local)
        itself = bends_itself(local)
        form = np.zeros((0, 0)) if itself else self._form(v)
        if self.cusp is None:
            return {"v": v, "w": w, "form": form}
        along = bend(local, self.system, self.y, w, v / problem.state_scale)[: problem.n] if itself else w @ form
        scale = problem.state_scale
        lu = fold.factored(local)
        half = 0.5 * second_form(problem, local.x, local.values, v, v)
        d = lu.solve(np.append(fold.rows * half, 0.0))[:-1] * scale
        a = lu.solve_transposed(np.append(along, 0.0))[:-1] * fold.rows
        return {"v": v, "w": w, "form": form, "d": d, "a": a}

    def _form(self, u: Array) -> Array:
        """Return B(u, e_j) for the scaled coordinates e_j as columns, (n, n), sixth order."""
        problem, x, values = self.local.problem, self.local.x, self.local.values
        return np.column_stack([second_form(problem, x, values, u, e) for e in np.diag(problem.state_scale)])

    def equations(self, values: Values, y: Array, conditions: bool) -> Array:
        """Return G at other parameter values; what null vectors enter is linearised with them frozen."""
        system, local, n = self.system, self.local, self.system.n
        problem = local.problem
        out = np.zeros(system.equations)
        if not conditions:
            out[:n] = problem.residual(local.x, values)
            return out
        ahead = [self.vectors[name] for name in ("v", "d") if name in self.vectors]
        steps = [np.zeros((1, n))]
        sizes = [_RAY / length_of(u, problem.state_scale) for u in ahead]
        steps += [(_NODES * h)[:, None] * u for u, h in zip(ahead, sizes, strict=True)]
        rows = problem.residuals(local.x, values, np.concatenate(steps))
        out[:n] = rows[0]
        first = [
            _FIRST @ rows[1 + 6 * i : 7 + 6 * i] / h for i, h in enumerate(sizes)
        ]
        at, position = n, len(system.free)
        moved = Local(problem, local.x, values, system.names, local.accurate, system.ranges)
        for c in self.conditions:
            aux = y[position : position + len(c.aux)]
            if c is self.fold:
                out[at] = -self.vectors["w"] @ first[0]
            elif c is self.cusp:
                second = (SECOND[NODES != 0.0] @ rows[1:7] + SECOND[NODES == 0.0] @ rows[:1]) / sizes[0] ** 2
                out[at] = self._coefficient(0.5 * self.vectors["w"] @ second, first)
            else:
                out[at : at + c.count] = c.value(moved, aux)
            at, position = at + c.count, position + len(c.aux)
        return out

    def _coefficient(self, own: float, first: Sequence[Array]) -> float:
        assert self.cusp is not None
        return float(own - self.vectors["w"] @ first[1] - self.vectors["a"] @ first[0]) / self.cusp.weight

    def state_rows(self, y: Array) -> Array:
        """Return the conditions' gradients in scaled x, (number of conditions, n)."""
        system, n = self.system, self.system.n
        rows, at, position = np.zeros((system.equations - n, n)), 0, len(system.free)
        for c in self.conditions:
            aux = y[position : position + len(c.aux)]
            if isinstance(c, Fold | FoldCoefficient | BranchPoint | Hopf) and bends_itself(self.local):
                rows[at : at + c.count] = np.asarray(c.gradient(self.local, system, y))[:, :n]
            elif c is self.fold:
                rows[at] = -self.vectors["w"] @ self.vectors["form"]
            elif c is self.cusp:
                rows[at] = self._coefficient_row()
            else:
                rows[at : at + c.count] = self._by_differences(c, aux)
            at, position = at + c.count, position + len(c.aux)
        return rows

    def _coefficient_row(self) -> Array:
        assert self.cusp is not None
        known = self.vectors
        own = 0.5 * np.array([self._third(e) for e in np.diag(self.local.problem.state_scale)])
        row: Array = own - known["w"] @ self._form(known["d"]) - known["a"] @ known["form"]
        return row / self.cusp.weight

    def _third(self, e: Array) -> float:
        """Return w . f_xxx(v, v, e), the problem's own or of sixth order: 42 evaluations."""
        problem, local, v = self.local.problem, self.local, self.vectors["v"]
        own = problem.derivative_along(local.x, local.values, v, v, e)
        if own is not None:
            return float(self.vectors["w"] @ own)
        h = _RAY / length_of(v, problem.state_scale)
        steps = (_NODES * _RAY)[:, None, None] * e + (NODES * h)[None, :, None] * v
        rows = problem.residuals(local.x, local.values, steps.reshape(-1, len(e))) @ self.vectors["w"]
        return float((_FIRST @ rows.reshape(len(_NODES), len(NODES)) @ SECOND) / (_RAY * h * h))

    def _by_differences(self, condition: Condition, aux: Array) -> Array:
        system, local = self.system, self.local
        problem = local.problem

        def value(step: Array) -> Array:
            x = problem.retract(local.x, step)
            return condition.value(Local(problem, x, local.values, system.names, True, system.ranges), aux)

        columns = [
            _sixth(lambda t, e=e: value(t * e), _STATE_STEP)  # type: ignore[misc]
            for e in np.diag(problem.state_scale)
        ]
        return np.column_stack(columns)


def _sixth(function: Callable[[float], Array], step: float) -> Array:
    """Return the derivative at 0 of a vector function, sixth order."""
    parts = [w * function(o * step) for o, w in zip(_NODES, _FIRST, strict=True)]
    found: Array = np.sum(parts, axis=0) / step
    return found
