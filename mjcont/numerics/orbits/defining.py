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

import math
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations import bends
from mjcont.numerics.equations.bordered import Factored, border, null_pair, row_scale
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Condition, Local, System
from mjcont.numerics.orbits.collocation import Orbits

# how far an orbit is moved for the derivative of a matrix, relative to its sizes
_MOVED = 1e-4
_UNFOLDED = 1e-6
# imaginary parts of null vectors below this part of the real ones vanish with the sine of the angle
_REAL = 0.1
_TINY = 1e-100


def orbits_of(local: Local) -> Orbits:
    """Return the equations of the orbits that an evaluation belongs to."""
    assert isinstance(local.problem, Orbits)
    return local.problem


def bend(local: Local, system: System, y: Array, w: Array, along: Array) -> Array:
    """Return d/de of w' [J f_p] at the orbit moved by e along a scaled direction (n + number free,)."""
    n = system.n
    largest = float(np.abs(along[:n] * system.problem.state_scale / _sizes(orbits_of(local))).max())
    e = _MOVED / max(largest, float(np.abs(along[n:]).max(initial=0.0)), 1e-300)
    return bends.bend(local, system, y, w, along, step=e)


def turned(local: Local, mu: complex, periods: bool = False) -> Any:
    """Return K(mu) over scaled unknowns, with or without the period and its equation."""
    orbits = orbits_of(local)
    size, d = orbits.n if periods else orbits.ends + orbits.inside, orbits.flow.d
    first, at = orbits.inside + orbits.intervals * d, np.arange(d)
    change = sparse.csc_matrix(((1.0 - mu) * orbits.state_scale[:d], (first + at, at)), shape=(size, size))
    return (local.jac[:size, :size] + change).tocsc()


def _sizes(orbits: Orbits) -> Array:
    """Return the typical size of each unknown, (n,)."""
    inside = np.tile(orbits.sizes[: orbits.flow.c], orbits.intervals * orbits.m)
    return np.concatenate([np.tile(orbits.sizes, orbits.intervals + 1), inside, orbits.last_scales])


class Multiplier(Condition):
    """Base of LPC, PD and NS: K(mu) is singular."""

    def __init__(self, local: Local, aux: tuple[float, ...] = ()) -> None:
        self.aux = aux
        self.rows = row_scale(self._matrix(local, np.array(aux)))
        v, w = null_pair(self._scaled(local, np.array(aux)))
        self.b, self.c = np.conj(w), np.conj(v)
        self._cache: tuple[Local, bytes, Array, Array, Any] | None = None

    def _mu(self, aux: Array) -> Any:
        raise NotImplementedError

    def _matrix(self, local: Local, aux: Array) -> Any:
        """Return K over scaled unknowns: without the period and its equation, s_N = mu s_0 at the ends."""
        return turned(local, self._mu(aux))

    def _scaled(self, local: Local, aux: Array) -> Any:
        return sparse.csc_matrix(sparse.diags(self.rows) @ self._matrix(local, aux))

    def vectors(self, local: Local, aux: Array) -> tuple[Array, Array, Any]:
        """Return v (scaled unknowns), w (equations) and g."""
        key = np.asarray(aux).tobytes()
        if self._cache is None or self._cache[0] is not local or self._cache[1] != key:
            b, c = self._borders(aux)
            lu = Factored(border(self._scaled(local, aux), b[:, None], c[None]))
            rhs = np.zeros(len(b) + 1, dtype=b.dtype)
            rhs[-1] = 1.0
            right, left = lu.solve(rhs), lu.solve_transposed(rhs)
            self._cache = (local, key, right[:-1], left[:-1], right[-1])
        return self._cache[2], self._cache[3] * self.rows, self._cache[4]

    def _borders(self, aux: Array) -> tuple[Array, Array]:
        """Return the column and the row."""
        del aux
        return self.b, self.c

    def _rows(self, local: Local, aux: Array, g: Any) -> Array:
        """Return the real equations, (count, ...), of g or of its derivatives."""
        del local, aux
        return np.array([g])

    def value(self, local: Local, aux: Array) -> Array:
        """Return g, its real and imaginary part where it is complex."""
        return self._rows(local, aux, self.vectors(local, aux)[2])

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
        found = -(along_real + 1j * along_imag) if np.iscomplexobj(v) else -along_real.real
        return self._rows(local, aux, np.append(found, self._over_aux(local, v, w, aux)))

    def _bend(self, local: Local, system: System, y: Array, w: Array, along: Array) -> Array:
        found: Array = bend(local, system, y, w, along)
        return found

    def _over_aux(self, local: Local, v: Array, w: Array, aux: Array) -> Array:
        del local, v, w, aux
        return np.zeros(0)

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
    """A pair of multipliers is mu, 1 / mu with mu = exp(i theta); theta is its auxiliary unknown.

    At a strong resonance 1:1 or 1:2 the pair meets on the real axis in one real vector. Borders that are real but for
    multiples of i sin theta make g(-theta) the conjugate of g(theta): Im g vanishes with sin theta, on the curve or
    not, and Re g = Im g / sin theta = 0 are regular equations, of which the curve beyond is the mirror image. Small
    imaginary parts are as accurate as in derivatives by complex steps. The multiplier 1 of a free period would make
    K(1) singular as well: for angles below a right one the period and its equation are left in, which deflates it.
    """

    count = 2

    def __init__(self, local: Local, theta: float, deflates: bool = True) -> None:
        self.deflates = deflates
        self._prepare(local, theta)

    def _prepare(self, local: Local, theta: float) -> None:
        self.deflated = self._to_deflate(local, theta)
        super().__init__(local, (theta,))
        self._mirrored(theta)

    def _to_deflate(self, local: Local, theta: float) -> bool:
        return self.deflates and orbits_of(local).own_period and math.cos(theta) > 0.0

    def _mirrored(self, theta: float) -> None:
        """Make the borders as real as they can be; note sin theta, zero where that is not nearly so."""
        self.b, self.c = _nearly_real(self.b), _nearly_real(self.c)
        real = all(np.linalg.norm(v.imag) <= _REAL * np.linalg.norm(v.real) for v in (self.b, self.c))
        self.sine = _sine(theta) if real else 0.0

    def _matrix(self, local: Local, aux: Array) -> Any:
        return turned(local, self._mu(aux), self.deflated)

    def _mu(self, aux: Array) -> complex:
        return complex(math.cos(aux[0]), _sine(aux[0]))

    def _borders(self, aux: Array) -> tuple[Array, Array]:
        part = 1j * (_sine(aux[0]) / self.sine if self.sine else 1.0)
        return self.b.real + part * self.b.imag, self.c.real + part * self.c.imag

    def _rows(self, local: Local, aux: Array, g: Any) -> Array:
        del local
        return np.array([g.real, g.imag / (_sine(aux[0]) if self.sine else 1.0)])

    def _over_aux(self, local: Local, v: Array, w: Array, aux: Array) -> Array:
        orbits = orbits_of(local)
        first, d = orbits.inside + orbits.intervals * orbits.flow.d, orbits.flow.d
        ends = w[first : first + d] * orbits.state_scale[:d] * v[:d]
        return np.array([1j * self._mu(aux) * ends.sum()])  # dK = -i mu at the ends

    def update(self, local: Local, aux: Array) -> None:
        """Take the present null vectors as borders, as real as they can be."""
        theta = float(aux[0])
        if self._to_deflate(local, theta) is not self.deflated:
            self._prepare(local, theta)
        else:
            super().update(local, aux)
            self._mirrored(theta)


def _sine(theta: float) -> float:
    """Return sin theta, at 0 a tiny number: what is divided by it has a limit there."""
    return math.sin(theta) or _TINY


def _nearly_real(v: Array) -> Array:
    """Return a complex vector turned, by less than a right angle, so that its imaginary part is least."""
    found: Array = v * np.exp(-0.5j * np.angle((v * v).sum()))
    return found


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
        kernel, left = null_pair(square)
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
