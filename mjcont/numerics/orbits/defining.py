"""Conditions that define special orbits, as bordered systems over the equations of collocation.

K(mu) is the matrix of the equations with the relation s_N = mu s_0 for the ends; with borders b, c near its null
vectors

    fold (LPC)              [K b; c' 0] [v; g] = [0; 1],  K = J, the period among the unknowns,      g = 0
    period doubling (PD)    the same with K(-1), without period and phase condition,                 g = 0
    Neimark-Sacker (NS)     the same with K(exp(i theta)), complex; theta is unknown,                g = 0
    branch point (BPC)      [J f_p b; C' 0] [V; g1 g2] = [0; I],                                     g1 = g2 = 0

With the left vector w the gradient is dg = -w' dK v. Second derivatives are symmetric, so that it costs two matrices of
the equations, at the orbit moved along v to both sides, whatever the number of unknowns. Source: Doedel, Govaerts and
Kuznetsov, Computation of periodic solution bifurcations in ODEs using bordered systems (SIAM J. Numer. Anal. 41, 2003).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.bordered import Factored, border, row_scale
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Condition, Local, System
from mjcont.numerics.orbits.collocation import Orbits

# how far an orbit is moved for the derivative of a matrix, relative to its sizes
_MOVED = 1e-4
_UNFOLDED = 1e-6


def orbits_of(local: Local) -> Orbits:
    """Return the equations of the orbits that an evaluation belongs to."""
    assert isinstance(local.problem, Orbits)
    return local.problem


def bend(local: Local, system: System, y: Array, w: Array, along: Array) -> Array:
    """Return d/de of w' [J f_p] at the orbit moved by e along a scaled direction (n + number free,)."""
    n, count = system.n, len(system.free)
    largest = float(np.abs(along[:n] * system.problem.state_scale / _sizes(orbits_of(local))).max())
    e = _MOVED / max(largest, float(np.abs(along[n:]).max(initial=0.0)), 1e-300)
    sides = []
    for sign in (1.0, -1.0):
        step = np.zeros(n + system.k)
        step[: n + count] = sign * e * along
        x, moved = system.move(local.x, y, step)
        at = system.problem.linearize(x, system.values(moved), system.names, ranges=system.ranges)
        slopes = np.array([p.slope(u) for p, u in zip(system.free, moved, strict=False)])
        sides.append(np.concatenate([(at.jac.T @ w) * system.problem.state_scale, (w @ at.par) * slopes]))
    found: Array = (sides[0] - sides[1]) / (2.0 * e)
    return found


def _null_pair(matrix: Any) -> tuple[Array, Array]:
    """Return unit vectors v, w with A v and w' A nearly zero, by inverse iteration from a fixed start."""
    factored = Factored(matrix)
    v = np.cos(1.0 + np.arange(matrix.shape[0], dtype=float)).astype(matrix.dtype)
    w = v
    for _ in range(3):
        w = factored.solve_transposed(np.conj(v))
        w = w / np.linalg.norm(w)
        v = factored.solve(np.conj(w))
        v = v / np.linalg.norm(v)
    return v, w


def _sizes(orbits: Orbits) -> Array:
    """Return the typical size of each unknown, (n,)."""
    inside = np.tile(orbits.sizes[: orbits.flow.c], orbits.intervals * orbits.m)
    return np.concatenate([np.tile(orbits.sizes, orbits.intervals + 1), inside, orbits.last_scales])


class Multiplier(Condition):
    """Base of LPC, PD and NS: K(mu) is singular."""

    def __init__(self, local: Local, aux: tuple[float, ...] = ()) -> None:
        self.aux = aux
        self.rows = row_scale(self._matrix(local, np.array(aux)))
        v, w = _null_pair(self._scaled(local, np.array(aux)))
        self.b, self.c = np.conj(w), np.conj(v)
        self._cache: tuple[Local, bytes, Array, Array, Any] | None = None

    def _mu(self, aux: Array) -> Any:
        raise NotImplementedError

    def _matrix(self, local: Local, aux: Array) -> Any:
        """Return K over scaled unknowns: without the period and its equation, s_N = mu s_0 at the ends."""
        orbits, matrix = orbits_of(local), local.jac
        size = orbits.ends + orbits.inside
        first, d = orbits.inside + orbits.intervals * orbits.flow.d, orbits.flow.d
        mu = self._mu(aux)
        at = np.arange(d)
        change = sparse.csc_matrix(((1.0 - mu) * orbits.state_scale[:d], (first + at, at)), shape=(size, size))
        return (matrix[:size, :size] + change).tocsc()

    def _scaled(self, local: Local, aux: Array) -> Any:
        return sparse.csc_matrix(sparse.diags(self.rows) @ self._matrix(local, aux))

    def vectors(self, local: Local, aux: Array) -> tuple[Array, Array, Any]:
        """Return v (scaled unknowns), w (equations) and g."""
        key = np.asarray(aux).tobytes()
        if self._cache is None or self._cache[0] is not local or self._cache[1] != key:
            lu = Factored(border(self._scaled(local, aux), self.b[:, None], self.c[None]))
            rhs = np.zeros(len(self.b) + 1, dtype=self.b.dtype)
            rhs[-1] = 1.0
            right, left = lu.solve(rhs), lu.solve_transposed(rhs)
            self._cache = (local, key, right[:-1], left[:-1], right[-1])
        return self._cache[2], self._cache[3] * self.rows, self._cache[4]

    def value(self, local: Local, aux: Array) -> Array:
        """Return g, its real and imaginary part where it is complex."""
        g = self.vectors(local, aux)[2]
        return np.array([g.real, g.imag])[: self.count]

    def gradient(self, local: Local, system: System, y: Array) -> Array:
        """Return dg = -w' dK v over the unknowns, the free parameters, and theta where there is one."""
        aux = y[len(system.free) : len(system.free) + len(self.aux)]
        v, w, _ = self.vectors(local, aux)
        n, size, count = system.n, len(v), len(system.free)
        whole = np.zeros((2, n), dtype=complex)
        whole[0, :size], whole[1, :size] = v, w
        parts = [np.concatenate([part, np.zeros(count)]) for part in (whole[0].real, whole[0].imag)]
        along_real = self._bend(local, system, y, whole[1], parts[0])
        along_imag = self._bend(local, system, y, whole[1], parts[1]) if np.iscomplexobj(v) else 0.0
        found = -(along_real + 1j * along_imag)
        rows = np.array([found.real, found.imag])[: self.count]
        return np.hstack([rows, self._over_aux(local, v, w, aux)])

    def _bend(self, local: Local, system: System, y: Array, w: Array, along: Array) -> Array:
        found: Array = bend(local, system, y, w, along)
        return found

    def _over_aux(self, local: Local, v: Array, w: Array, aux: Array) -> Array:
        del local, v, w, aux
        return np.zeros((self.count, 0))

    def update(self, local: Local, aux: Array) -> None:
        """Take the present null vectors, normalised, as borders."""
        v, w, _ = self.vectors(local, aux)
        left = w / self.rows
        self.b, self.c = np.conj(left) / np.linalg.norm(left), np.conj(v) / np.linalg.norm(v)
        self._cache = None


class CycleFold(Multiplier):
    """J is singular, the period among the unknowns."""

    def _matrix(self, local: Local, aux: Array) -> Any:
        del aux
        return local.jac


class PeriodDoubling(Multiplier):
    """A multiplier is -1."""

    def _mu(self, aux: Array) -> float:
        del aux
        return -1.0


class Torus(Multiplier):
    """A pair of multipliers is exp(+-i theta); theta is its auxiliary unknown."""

    count = 2

    def __init__(self, local: Local, theta: float) -> None:
        super().__init__(local, (theta,))

    def _mu(self, aux: Array) -> complex:
        return complex(np.exp(1j * aux[0]))

    def _over_aux(self, local: Local, v: Array, w: Array, aux: Array) -> Array:
        orbits = orbits_of(local)
        first, d = orbits.inside + orbits.intervals * orbits.flow.d, orbits.flow.d
        ends = w[first : first + d] * orbits.state_scale[:d] * v[:d]
        found = complex(1j * self._mu(aux) * ends.sum())  # dK = -i mu at the ends
        return np.array([[found.real], [found.imag]])


class CycleBranch(Condition):
    """[J f_p] has rank n - 1, the equations unfolded by a: G + a d = 0."""

    count, aux = 2, (0.0,)

    def __init__(self, local: Local, parameter: Free) -> None:
        self.parameter = parameter
        self.rows = row_scale(local.jac)
        self._prepare(local)

    def _wide(self, local: Local) -> Any:
        slope = self.parameter.slope(self.parameter.coordinate(local.values[self.parameter.name]))
        column = (local.par[:, 0] * slope * self.rows)[:, None]
        return border(sparse.csc_matrix(sparse.diags(self.rows) @ local.jac), column, np.zeros((0, len(self.rows))))

    def _prepare(self, local: Local) -> None:
        wide = self._wide(local)
        n = wide.shape[0]
        last = np.zeros((1, n + 1))
        last[0, -1] = 1.0
        square = sparse.vstack([wide, sparse.csc_matrix(last)], format="csc")
        kernel, left = _null_pair(square)
        w = left[:n] / np.linalg.norm(left[:n])
        rows = np.vstack([kernel, last])
        lu = Factored(border(wide, w[:, None], rows))
        rhs = np.zeros((n + 2, 2))
        rhs[n, 0] = rhs[n + 1, 1] = 1.0
        right = np.column_stack([lu.solve(r) for r in rhs.T])
        self.c, self.b = np.linalg.qr(right[: n + 1])[0].T.copy(), w
        self.direction = self.b / self.rows

    def _solve(self, local: Local) -> tuple[Array, Array, Array]:
        n = len(self.b)
        lu = Factored(border(self._wide(local), self.b[:, None], self.c))
        rhs = np.zeros((n + 2, 2))
        rhs[n, 0] = rhs[n + 1, 1] = 1.0
        right = np.column_stack([lu.solve(r) for r in rhs.T])
        left = lu.solve_transposed(np.append(np.zeros(n + 1), 1.0))
        return right[: n + 1], left[:n] * self.rows, right[n + 1]

    def null(self, local: Local) -> tuple[Array, Array]:
        """Return the kernel of [J f_p] in scaled unknowns, orthonormal (n + 1, 2), and the left vector (n,)."""
        right, left, _ = self._solve(local)
        return np.linalg.qr(right)[0], left

    def value(self, local: Local, aux: Array) -> Array:
        """Return (g1, g2)."""
        return self._solve(local)[2]

    def gradient(self, local: Local, system: System, y: Array) -> Array:
        """Return their gradients, as for the multipliers."""
        right, w, _ = self._solve(local)
        others = np.zeros(len(system.free) - 1)
        return np.array([-bend(local, system, y, w, np.concatenate([v, others])) for v in right.T])

    def exists(self, aux: Array) -> bool:
        """Whether it is not unfolded."""
        return not abs(aux[0]) > _UNFOLDED
