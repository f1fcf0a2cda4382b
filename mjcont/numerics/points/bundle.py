"""The defining systems of folds and cusps of many variants of a problem, linearised side by side.

A point X = (state, free parameters) of a variant p solves G(X, p) = 0 (`Fold`, `FoldCoefficient`). In the bordered
matrix A of J = f_x, with its null vectors v and w where g = 0, and B = f_xx,

    F(p) = (f, -w . f_x v, w . B(v, v) / 2 - w . f_x d - a . f_x v),     A d = B(v, v) / 2,  A' a = (w . B(v, .))'

has the derivatives of G while v, w, d and a are frozen. Derivatives in a free parameter, and what changes from one
variant to another, are differences of F: seven evaluations of f, thirteen for a cusp.

As in `directions` arrays begin with the number of points, and LAPACK gets one matrix at a time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Self

import numpy as np

from mjcont.numerics.equations.algebra import determinant_signs, singular, solve_each
from mjcont.numerics.equations.differences import FOURTH_ORDER, inward, jacobian_steps
from mjcont.numerics.equations.directions import Directions, corrected, dot, orient, weighted
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Equations, Variants
from mjcont.numerics.equations.system import ROW_GUARD, VANISHES


@dataclass(slots=True)
class Linear:
    """G and its linearisation, one row for each member of a bundle or of a part of it.

    Attributes
    ----------
    x, y : states (K, nq) and coordinates of the free parameters (K, k).
    value, matrix : G (K, N) and its Jacobian (K, N, N) in scaled unknowns, equations of f scaled.
    frozen : F here, (K, N).
    v, w : null vectors in physical units, (K, n).
    d, a : of a cusp, as above, (K, n); of a fold zero.
    """

    x: Array
    y: Array
    value: Array
    matrix: Array
    frozen: Array
    v: Array
    w: Array
    d: Array
    a: Array

    def of(self, members: Array) -> Self:
        """Return that of some members."""
        return type(self)(*(getattr(self, f.name)[members] for f in fields(self)))

    def put(self, members: Array, other: Linear) -> None:
        """Take that of some members."""
        for f in fields(self):
            getattr(self, f.name)[members] = getattr(other, f.name)

    def solved(self, rhs: Array) -> Array:
        """Return the solutions of dG z = rhs, (K, N)."""
        sizes = np.abs(self.matrix).max(axis=2)
        return solve_each(self.matrix / sizes[:, :, None], rhs / sizes)

    @property
    def sign(self) -> Array:
        """The signs of the determinants, (K,)."""
        return determinant_signs(self.matrix / np.abs(self.matrix).max(axis=2)[:, :, None])


@dataclass(frozen=True, slots=True)
class _About:
    """f about states x (K, nq) of members of a bundle, free parameters at coordinates y and values `columns` (K, k)."""

    bundle: Bundle
    members: Array
    ahead: bool
    x: Array
    y: Array
    columns: Array
    f: Array
    jac: Array

    def at(self, *groups: Array) -> list[Array]:
        """Return f at groups of steps, (K, m, n) each."""
        found = self.shifted(np.concatenate(groups, axis=1))
        return np.split(found, np.cumsum([s.shape[1] for s in groups])[:-1], axis=1)

    def shifted(self, steps: Array, shifts: Array | None = None) -> Array:
        """Return f at steps, with free parameters other by `shifts`."""
        return self.bundle.f(self.members, self.ahead, self.x, steps, self.columns, shifts)


class Bundle:
    """Folds or cusps, each of a variant of a problem, that move to other variants.

    Parameters
    ----------
    problem : Equations
        Smooth, and affine in the free parameters.
    variants : Variants
        First those that the points lie on, (K of them), then those that they move to.
    x : (K, nq) states.
    free : the free parameters of each point, one for a fold, two for a cusp, none of them bounded.
    values : those of the free parameters, (K, k).

    Attributes
    ----------
    counts : evaluations of f so far, (K,).
    """

    def __init__(
        self, problem: Equations, variants: Variants, x: Array, free: Sequence[Sequence[Free]], values: Array
    ) -> None:
        self.problem, self._variants, self.free = problem, variants, [tuple(f) for f in free]
        self.n, self.k, self.count = problem.n, values.shape[1], len(x)
        self.cusp, self.x = self.k == 2, x
        pairs = [list(zip(f, row, strict=True)) for f, row in zip(free, values.tolist(), strict=True)]
        self.y = np.array([[p.coordinate(v) for p, v in own] for own in pairs]).reshape(values.shape)
        self._steps = np.array([[self._step(p, v) for p, v in own] for own in pairs]).reshape(values.shape)
        self.counts = np.zeros(self.count, dtype=int)
        self._scale, self._along = problem.state_scale, Directions(problem.state_scale)
        self._every_step = np.vstack([np.zeros((1, self.n)), jacobian_steps(self._scale, FOURTH_ORDER)])[None]
        self._rows, self._b, self._c = (np.ones((self.count, self.n)) for _ in range(3))
        self._weight = np.ones(self.count)

    def _step(self, p: Free, value: float) -> float:
        """Return the difference step of a parameter in which f is affine."""
        _, h = self.problem.parameter_stencil(p.name, value)
        return inward(value, h, self.problem.parameter(p.name).hard_bounds)

    # -- where members are -------------------------------------------------------------------------------------

    def values(self, members: Array, y: Array) -> Array:
        """Return the values of the free parameters at coordinates (K, k)."""
        pairs = zip(members.tolist(), y.tolist(), strict=True)
        found = [[p.value(u) for p, u in zip(self.free[i], row, strict=True)] for i, row in pairs]
        return np.array(found).reshape(len(members), self.k)

    def _slopes(self, members: Array, y: Array) -> Array:
        pairs = zip(members.tolist(), y.tolist(), strict=True)
        found = [[p.slope(u) for p, u in zip(self.free[i], row, strict=True)] for i, row in pairs]
        return np.array(found).reshape(len(members), self.k)

    def moved(self, x: Array, y: Array, steps: Array) -> tuple[Array, Array]:
        """Return states and coordinates moved by scaled steps (K, n + k)."""
        return self.problem.retract_each(x, steps[:, : self.n] * self._scale), y + steps[:, self.n :]

    def difference(self, x1: Array, y1: Array, x0: Array, y0: Array) -> Array:
        """Return the scaled steps from points to others, (K, n + k)."""
        return np.hstack([self.problem.difference_each(x1, x0) / self._scale, y1 - y0])

    def f(
        self, members: Array, ahead: bool, x: Array, steps: Array, columns: Array, shifts: Array | None = None
    ) -> Array:
        """Return f (K, m, n) at states moved by tangent steps (K, m, n), and parameters by `shifts` (K, m, k)."""
        k, m = steps.shape[:2]
        if not k:
            return np.zeros((0, m, self.n))
        states = self.problem.retract_each(np.repeat(x, m, axis=0), steps.reshape(k * m, self.n)).reshape(k, m, -1)
        own = np.repeat(columns[:, None], m, axis=1)
        self.counts[members] += m
        chosen = members + self.count if ahead else members
        return self._variants.residuals(chosen, states, own if shifts is None else own + shifts)

    def _about(self, members: Array, ahead: bool, x: Array, y: Array) -> _About:
        """Return f and its derivatives in scaled coordinates, as special points are located with, (K, n, n)."""
        columns = self.values(members, y)
        found = self.f(members, ahead, x, np.repeat(self._every_step, len(members), axis=0), columns)
        blocks = found[:, 1:].reshape(len(members), len(FOURTH_ORDER.offsets), self.n, self.n)
        slopes = weighted(np.array(FOURTH_ORDER.weights), blocks) / FOURTH_ORDER.step
        jac = np.ascontiguousarray(slopes.transpose(0, 2, 1))
        return _About(self, members, ahead, x, y, columns, found[:, 0], jac)

    # -- what the equations are ------------------------------------------------------------------------------

    def begin(self, members: Array) -> tuple[Linear, Array]:
        """Choose scales and borders at the points of members; return G linearised, and which have any, (K,) bool."""
        here, h = self._about(members, False, self.x[members], self.y[members]), self._steps[members]
        beside = here.shifted(np.zeros((len(members), self.k, self.n)), h[:, None] * np.eye(self.k))
        slopes = np.abs(beside - here.f[:, None]).max(axis=2) / np.abs(h)
        largest = np.abs(here.jac).max(axis=2)
        top = np.maximum(largest.max(axis=1), ROW_GUARD * slopes.max(axis=1))
        self._rows[members] = 1.0 / np.maximum(largest, ROW_GUARD * top[:, None])
        u, _, vt = singular(self._rows[members][:, :, None] * here.jac)
        self._b[members], self._c[members] = u[:, :, -1], vt[:, -1]
        if self.cusp:
            v, w, _ = self._null(self._bordered(members, here.jac), members)
            v, w = v / self._scale, w / self._rows[members]
            self._weight[members] = dot(v, v) * np.sqrt(dot(w, w))
        return self._linear(here), top > VANISHES

    def share(self, members: Array, like: Array) -> None:
        """Give members the scales and borders of others that lie on the same point, and what they cost."""
        for array in (self._rows, self._b, self._c, self._weight, self.counts):
            array[members] = array[like]

    def _bordered(self, members: Array, jac: Array) -> Array:
        n = self.n
        matrix = np.zeros((len(members), n + 1, n + 1))
        matrix[:, :n, :n] = self._rows[members][:, :, None] * jac
        matrix[:, :n, n], matrix[:, n, :n] = self._b[members], self._c[members]
        return matrix

    def _null(self, bordered: Array, members: Array) -> tuple[Array, Array, Array]:
        """Return v and w in physical units, (K, n), and g, (K,)."""
        end = np.zeros((len(members), self.n + 1))
        end[:, -1] = 1.0
        right, left = solve_each(bordered, end), solve_each(bordered.transpose(0, 2, 1), end)
        return right[:, :-1] * self._scale, left[:, :-1] * self._rows[members], right[:, -1]

    def value(self, members: Array, x: Array, y: Array) -> Array:
        """Return G (K, N) at states and coordinates of the variants ahead."""
        here, along = self._about(members, True, x, y), self._along
        v, w, g = self._null(self._bordered(members, here.jac), members)
        parts = [here.f * self._rows[members], g[:, None]]
        if self.cusp:
            second = along.curvature(here.f, here.at(along.along(v))[0], v)
            parts.append((0.5 * dot(w, second) / self._weight[members])[:, None])
        return np.hstack(parts)

    def finished(self, members: Array, near: Linear, x: Array, y: Array) -> tuple[Array, Array]:
        """Return coordinates (K, k) and normal form coefficients (K,), |v| = w . v = 1, at points of variants ahead.

        `near` are linearisations nearby. The parameter of a fold is taken from w . f = 0: rounding of the state loads
        stiff springs, but the left null vector does not feel it.
        """
        here, along, n = self._about(members, True, x, y), self._along, self.n
        v, w, _ = self._null(self._bordered(members, here.jac), members)
        v = orient(v / np.sqrt(dot(v, v))[:, None])
        w = w / dot(w, v)[:, None]
        second = along.curvature(here.f, here.at(along.along(v))[0], v)
        if not self.cusp:
            slope = near.matrix[:, :n, n] / self._rows[members]
            return y - (dot(w, here.f) / dot(w, slope))[:, None], dot(0.5 * w, second)
        matrix = np.zeros((len(v), n + 1, n + 1))
        matrix[:, :n, :n], matrix[:, :n, n], matrix[:, n, :n] = here.jac / self._scale, w, v
        rhs = second if self.problem.second_order else second - dot(w, second)[:, None] * v
        h = solve_each(matrix, np.hstack([rhs, np.zeros((len(v), 1))]))[:, :n]
        far, *polar = here.at(along.far(v), *along.polar(h, v))
        crossed = along.polarized(here.f, (polar[0], polar[1]), h, v)
        return y, dot(w, along.thrice(far, v) - 3.0 * crossed) / 6.0

    # -- linearised ------------------------------------------------------------------------------------------

    def linear(self, members: Array, x: Array, y: Array) -> Linear:
        """Return G and its linearisation at states and coordinates of variants ahead."""
        return self._linear(self._about(members, True, x, y))

    def _linear(self, here: _About) -> Linear:
        members, n, along, size = here.members, self.n, self._along, self.n + self.k
        bordered = self._bordered(members, here.jac)
        v, w, g = self._null(bordered, members)
        value, frozen = np.empty((2, len(v), size))
        matrix = np.zeros((len(v), size, size))
        value[:, :n], value[:, n], matrix[:, :n, :n] = here.f * self._rows[members], g, bordered[:, :n, :n]
        found = Linear(here.x, here.y, value, matrix, frozen, v, w, np.zeros_like(v), np.zeros_like(v))
        steps = along.along(v), along.mixed(v)
        beside, mixed, *more = here.at(*steps, *((along.aside(v), along.far(v)) if self.cusp else ()))
        second = along.curvature(here.f, beside, v)
        form = along.form(mixed, v, second)
        matrix[:, n, :n] = -dot(w[:, None], form)
        known = [here.f[:, None], beside]
        if self.cusp:
            known.append(self._cusp_row(here, found, bordered, second, form, more))
        found.frozen[:] = self._frozen(members, found, np.concatenate(known, axis=1))
        self._parameter_columns(here, found)
        return found

    def _cusp_row(
        self, here: _About, found: Linear, bordered: Array, second: Array, form: Array, more: Sequence[Array]
    ) -> Array:
        """Fill in what a cusp has beside a fold; return f along d."""
        members, v, w, n, along = here.members, found.v, found.w, self.n, self._along
        rows, nothing = self._rows[members], np.zeros((len(v), 1))
        d = solve_each(bordered, np.hstack([0.5 * second * rows, nothing]))[:, :n] * self._scale
        a = solve_each(bordered.transpose(0, 2, 1), np.hstack([dot(w[:, None], form), nothing]))[:, :n] * rows
        crossed, beside, *polar = here.at(along.mixed(d), along.along(d), *along.polar(d, v))
        row = 0.5 * dot(w[:, None], along.third(more[0], v))
        row -= dot(w[:, None], along.form(crossed, d)) + dot(a[:, None], form)
        # centred differences are wrong by about k step^2, which along v, where little changes, is too much
        exact = 0.5 * dot(w, along.thrice(more[1], v)) - dot(a, second)
        exact -= dot(w, along.polarized(here.f, (polar[0], polar[1]), d, v))
        weight = self._weight[members]
        found.matrix[:, n + 1, :n] = corrected(row, exact, v / self._scale) / weight[:, None]
        found.value[:, n + 1] = 0.5 * dot(w, second) / weight
        found.d[:], found.a[:] = d, a
        return beside

    def _parameter_columns(self, here: _About, found: Linear) -> None:
        """Fill in the derivatives in the free parameters, from F at other values of each."""
        members, steps, slopes = here.members, self._frozen_steps(found), self._slopes(here.members, found.y)
        for i in range(self.k):
            h, shifts = self._steps[members, i], np.zeros((len(members), 1, self.k))
            shifts[:, 0, i] = h
            change = self._frozen(members, found, here.shifted(steps, shifts)) - found.frozen
            found.matrix[:, :, self.n + i] = change * (slopes[:, i] / h)[:, None]

    def change(self, members: Array, at: Linear, ahead: bool) -> Array:
        """Return by how much F changes at a linearisation from its own variants to the others, (K, N)."""
        rows = self.f(members, ahead, at.x, self._frozen_steps(at), self.values(members, at.y))
        return self._frozen(members, at, rows) - at.frozen

    def _frozen_steps(self, at: Linear) -> Array:
        """Return the steps at which f is to be known for F, (K, m, n)."""
        vectors = (at.v, at.d) if self.cusp else (at.v,)
        return np.concatenate([np.zeros((len(at.v), 1, self.n)), *map(self._along.along, vectors)], axis=1)

    def _frozen(self, members: Array, at: Linear, rows: Array) -> Array:
        """Return F from f at the steps, (K, N)."""
        along, v, w, f = self._along, at.v, at.w, rows[:, 0]
        slope = along.slope(rows[:, 1:7], v)
        parts = [f * self._rows[members], -dot(w, slope)[:, None]]
        if self.cusp:
            last = 0.5 * dot(w, along.curvature(f, rows[:, 1:7], v)) - dot(at.a, slope)
            last -= dot(w, along.slope(rows[:, 7:], at.d))
            parts.append((last / self._weight[members])[:, None])
        return np.hstack(parts)
