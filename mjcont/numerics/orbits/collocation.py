"""Periodic orbits as equations: collocation on a mesh of one period, time in units of the period.

On interval i of length h = T (tau_{i+1} - tau_i), with s_i the state at its left end and points c_j, a_jl, b_l:

    first order    u_j = s_i + sum_l a_jl w_l,             w_j = h f(u_j),     s_{i+1} = s_i + sum_l b_l w_l
    second order   q_j = q_i + c_j h v_i + sum_l (aa)_jl w_l,   v_j = v_i + sum_l a_jl w_l / h,   w_j = h^2 a(q_j, v_j)

so that velocities at the points are eliminated: the same polynomials from half the unknowns. The unknowns are the
states s_0 .. s_N at the ends of the intervals, the w, and the period T where it is free; the equations are those of
the points, continuity, periodicity s_N = s_0 + shift, and for a free period the phase condition sum_i weight_i s_i .
r_i' = 0 on a reference orbit r (Doedel, Lecture Notes on Numerical Analysis of Nonlinear Equations, 2007).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.problem import (
    Array,
    Equations,
    Linearization,
    Matrix,
    Pencil,
    Range,
    Ranges,
    Stencil,
    Values,
    Varied,
)
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.scheme import Scheme

# intervals shorter than this part of their mean count as that long where sizes are measured
_SHORTEST = 0.1


@dataclass(frozen=True, slots=True)
class Blocks:
    """Derivatives of the equations, interval by interval.

    Attributes
    ----------
    over_w, over_s : (N, m c, m c) and (N, m c, d), of the equations at the points.
    over_h : (N, m c), in the interval's length.
    end_w, end_s, end_h : (N, d, m c), (N, d, d) and (N, d), of the state that an interval ends in.
    jac : (N, m, c, d), of the rates at the points.
    """

    over_w: Array
    over_s: Array
    over_h: Array
    end_w: Array
    end_s: Array
    end_h: Array
    jac: Array


@dataclass(frozen=True, slots=True)
class OrbitLinearization(Linearization):
    """The equations of an orbit and their derivatives, with the blocks from which they are put together."""

    blocks: Blocks = field(kw_only=True)


class Orbits(Equations):
    """The equations of the periodic orbits of a flow on one mesh.

    Parameters
    ----------
    flow : Flow
    scheme : Scheme
    mesh : (N + 1,) array
        From 0 to 1.
    reference : (N + 1, d) array
        Derivatives in tau of the reference orbit at the mesh; not used where the period is known.
    shift : (d,) array
        What a running orbit gains in a period.
    sizes : (d,) array
        Typical sizes of the state's entries along the orbit.
    period_scale : float
    """

    second_order = False

    def __init__(
        self,
        flow: Flow,
        scheme: Scheme,
        mesh: Array,
        reference: Array,
        shift: Array,
        sizes: Array,
        period_scale: float,
    ) -> None:
        self.flow, self.scheme, self.mesh, self.shift = flow, scheme, mesh, shift
        self.sizes, self.period_scale = sizes, period_scale
        self.lengths = np.diff(mesh)
        self.intervals, self.m = len(self.lengths), scheme.degree
        self.own_period = not flow.forced
        self.ends = (self.intervals + 1) * flow.d
        self.inside = self.intervals * self.m * flow.c
        self.n = self.ends + self.inside + self.own_period
        self.phases = (mesh[:-1, None] + self.lengths[:, None] * scheme.c).ravel()
        self.state_scale = self._scales()
        weights = np.concatenate([self.lengths, [0.0]]) + np.concatenate([[0.0], self.lengths])
        row = 0.5 * weights[:, None] * reference / sizes**2
        largest = np.abs(row).max()
        self.phase_row = row / largest if largest > 0.0 else row
        self.reference = reference

    def _scales(self) -> Array:
        """Return the unknowns' scales: a step's length is about the mean of its size along the orbit."""
        share = np.maximum(self.lengths, _SHORTEST / self.intervals) / (self.m + 1)
        beside = np.concatenate([share[:1], np.minimum(share[1:], share[:-1]), share[-1:]])
        ends = self.sizes / np.sqrt(beside)[:, None]
        inside = np.broadcast_to(self.sizes[: self.flow.c] / np.sqrt(share)[:, None, None], self.w_shape)
        return np.concatenate([ends.ravel(), inside.ravel(), self.last_scales])

    @property
    def last_scales(self) -> list[float]:
        """Scales of the unknowns behind those of the orbit: of its period where that is free."""
        return [self.period_scale] if self.own_period else []

    @property
    def w_shape(self) -> tuple[int, int, int]:
        """Shape of the unknowns inside the intervals, (N, m, c)."""
        return self.intervals, self.m, self.flow.c

    # -- the orbit ---------------------------------------------------------------------------------------------

    def path(self, x: Array, values: Values) -> Path:
        """Return an orbit taken apart."""
        period = float(x[-1]) if self.own_period else self.flow.period(values)
        s, w = x[: self.ends].reshape(-1, self.flow.d), x[self.ends : self.ends + self.inside].reshape(self.w_shape)
        return Path(self.scheme, self.flow.order, self.mesh, s, w, period)

    def joined(self, p: Path) -> Array:
        """Return an orbit put together, (n,)."""
        return np.concatenate([p.s.ravel(), p.w.ravel(), [p.period] if self.own_period else []])

    def stages(self, p: Path) -> Array:
        """Return the states at the points, (N, m, d)."""
        a, s = self.scheme.a, p.s[:-1, None, :]
        if self.flow.order == 1:
            first: Array = s + a @ p.w
            return first
        c, h = self.flow.c, (p.period * self.lengths)[:, None, None]
        q = s[..., :c] + h * self.scheme.c[:, None] * s[..., c:] + self.scheme.aa @ p.w
        return np.concatenate([q, s[..., c:] + (a @ p.w) / h], axis=2)

    def reached(self, p: Path) -> Array:
        """Return the states in which the intervals end, (N, d)."""
        b, s = self.scheme.b, p.s[:-1]
        if self.flow.order == 1:
            first: Array = s + b @ p.w
            return first
        c, h = self.flow.c, (p.period * self.lengths)[:, None]
        return np.hstack([s[:, :c] + h * s[:, c:] + self.scheme.ba @ p.w, s[:, c:] + (b @ p.w) / h])

    @property
    def one_pattern(self) -> bool:
        """Whether the matrix has the same entries everywhere: it has."""
        return True

    # -- equations ---------------------------------------------------------------------------------------------

    @property
    def evaluations(self) -> int:
        """Number of evaluations of the flow so far."""
        return self.flow.evaluations

    @property
    def failure(self) -> str:
        """Why the flow had no value, a clause."""
        return self.flow.failure

    def parameter(self, name: str) -> Varied:
        """Return a parameter by its name."""
        return self.flow.parameter(name)

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter."""
        return self.flow.values(given)

    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        return self.flow.parameter_stencil(name, value, bounds)

    def residual(self, x: Array, values: Values) -> Array:
        """Return the equations' values, (n,)."""
        p = self.path(x, values)
        rates = self.flow.rates(self.stages(p).reshape(-1, self.flow.d), self.phases, values)
        return self._equations(p, rates)

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the equations' values at x moved by each row of `steps`."""
        return np.array([self.residual(x + step, values) for step in steps]).reshape(len(steps), self.n)

    def _equations(self, p: Path, rates: Array) -> Array:
        h = (p.period * self.lengths)[:, None, None] ** self.flow.order
        inside = p.w - h * rates.reshape(self.w_shape)
        ends, closed = p.s[1:] - self.reached(p), p.s[-1] - p.s[0] - self.shift
        phase = [float((self.phase_row * p.s).sum())] if self.own_period else []
        return np.concatenate([inside.ravel(), ends.ravel(), closed, phase])

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> OrbitLinearization:
        """Return the equations with their derivatives, a sparse matrix."""
        p = self.path(x, values)
        states = self.stages(p)
        r = self.flow.derivatives(states.reshape(-1, self.flow.d), self.phases, values, wrt, accurate, ranges)
        blocks = self._blocks(p, r.value.reshape(self.w_shape), r.jac.reshape(*self.w_shape, self.flow.d))
        over_period = self._over_period(blocks)
        par = np.zeros((self.n, len(wrt)))
        h = (p.period * self.lengths)[:, None, None, None] ** self.flow.order
        par[: self.inside] = (-h * r.par.reshape(*self.w_shape, -1)).reshape(self.inside, -1)
        if self.flow.forced:
            for k, name in enumerate(wrt):
                par[:, k] += self.flow.period_rate(values, name) * over_period
        jac = self.assembled(blocks, over_period)
        return OrbitLinearization(self._equations(p, r.value), jac, par, blocks=blocks)

    def _blocks(self, p: Path, rates: Array, jac: Array) -> Blocks:
        """Return the derivatives from the rates (N, m, c) and theirs (N, m, c, d)."""
        k, c, a = self.m * self.flow.c, self.flow.c, self.scheme.a
        n, m, h = self.intervals, self.m, p.period * self.lengths
        eye, one = np.eye(c), np.eye(k)
        if self.flow.order == 1:
            inside = a[None, :, None, :, None] * jac[:, :, :, None, :]
            over_w = one - h[:, None, None] * inside.reshape(n, k, k)
            over_s, over_h = -h[:, None, None] * jac.reshape(n, k, c), -rates.reshape(n, k)
            end_w = np.broadcast_to(np.kron(self.scheme.b, eye), (n, c, k))
            return Blocks(over_w, over_s, over_h, end_w, np.broadcast_to(eye, (n, c, c)), np.zeros((n, c)), jac)
        jq, jv, v = jac[..., :c], jac[..., c:], p.s[:-1, c:]
        hh, aw, bw = h[:, None, None, None, None], a @ p.w, self.scheme.b @ p.w
        inside = hh**2 * self.scheme.aa[None, :, None, :, None] * jq[:, :, :, None, :]
        inside = inside + hh * a[None, :, None, :, None] * jv[:, :, :, None, :]
        over_w = one - inside.reshape(n, k, k)
        h4, at = h[:, None, None, None], self.scheme.c[None, :, None, None]
        over_s = -np.concatenate([h4**2 * jq, h4**2 * (h4 * at * jq + jv)], axis=3).reshape(n, k, 2 * c)
        h3 = h[:, None, None]
        moved = np.einsum("ijcd,ijd->ijc", jq, self.scheme.c[:, None] * v[:, None, :]) * h3**2
        over_h = -2.0 * h3 * rates - moved + np.einsum("ijcd,ijd->ijc", jv, aw)
        slow = np.broadcast_to(np.kron(self.scheme.ba, eye), (n, c, k))
        end_w = np.concatenate([slow, np.kron(self.scheme.b, eye) / h[:, None, None]], axis=1)
        end_s = np.zeros((n, 2 * c, 2 * c))
        end_s[:] = np.eye(2 * c)
        end_s[:, :c, c:] = h[:, None, None] * eye
        end_h = np.hstack([v, -bw / h[:, None] ** 2])
        return Blocks(over_w, over_s, over_h.reshape(n, m * c), end_w, end_s, end_h, jac)

    def _over_period(self, blocks: Blocks) -> Array:
        """Return the derivative of the equations in the period, (n,)."""
        found, length = np.zeros(self.n), self.lengths[:, None]
        found[: self.inside] = (length * blocks.over_h).ravel()
        found[self.inside : self.inside + self.intervals * self.flow.d] = -(length * blocks.end_h).ravel()
        return found

    # -- the matrix --------------------------------------------------------------------------------------------

    @cached_property
    def _pattern(self) -> tuple[Array, Array, Array]:
        """Return the matrix's column pointers, row indices, and the order in which entries fill them."""
        n, k, d, first = self.intervals, self.m * self.flow.c, self.flow.d, self.inside
        i = np.arange(n)[:, None, None]
        at_k, at_d = np.arange(k), np.arange(d)
        w_rows, w_columns = i * k + at_k[:, None], self.ends + i * k + at_k
        s_rows, s_columns = first + i * d + at_d[:, None], i * d + at_d
        closed = first + n * d + at_d
        rows = [np.broadcast_to(w_rows, (n, k, k)), np.broadcast_to(w_rows, (n, k, d))]
        columns = [np.broadcast_to(w_columns, (n, k, k)), np.broadcast_to(s_columns, (n, k, d))]
        rows += [np.broadcast_to(s_rows, (n, d, k)), np.broadcast_to(s_rows, (n, d, d))]
        columns += [np.broadcast_to(w_columns, (n, d, k)), np.broadcast_to(s_columns, (n, d, d))]
        rows += [s_rows[..., 0], closed, closed]
        columns += [s_columns[:, 0] + d, at_d, n * d + at_d]
        if self.own_period:
            last = self.n - 1
            rows += [np.arange(last), np.full(self.ends, last)]
            columns += [np.full(last, last), np.arange(self.ends)]
        row, column = (np.concatenate([np.ravel(part) for part in parts]) for parts in (rows, columns))
        order = np.lexsort((row, column))
        pointers = np.concatenate([[0], np.cumsum(np.bincount(column, minlength=self.n))])
        return pointers, row[order], order

    def assembled(self, blocks: Blocks, over_period: Array) -> Matrix:
        """Return the matrix of the equations, (n, n) in compressed columns."""
        ones, d = np.ones(self.intervals * self.flow.d), np.ones(self.flow.d)
        parts = [blocks.over_w, blocks.over_s, -blocks.end_w, -blocks.end_s, ones, -d, d]
        if self.own_period:
            parts += [over_period[:-1], self.phase_row]
        entries = np.concatenate([np.ravel(part) for part in parts])
        pointers, rows, order = self._pattern
        found: Any = sparse.csc_matrix((entries[order], rows, pointers), shape=(self.n, self.n))
        return found

    # -- what a curve of equilibria asks ---------------------------------------------------------------------------

    def pencil(self, x: Array, values: Values, jac: Matrix) -> Pencil:
        """Return the matrices of a first-order system, which have no meaning beyond where they are singular."""
        del x, values
        return Pencil(None, None, -jac)

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the equations at x moved by each row of `steps`."""
        return self.residuals(x, values, steps)
