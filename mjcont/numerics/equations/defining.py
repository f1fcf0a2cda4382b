"""Conditions that define special points, as minimally augmented (bordered) systems.

With J = df/dx in scaled unknowns, rows equilibrated, and borders b, c near its left and right null vectors:

    fold            [J b; c' 0] [v; g] = [0; 1],                         g = 0
    Hopf            [P(s) b; c' 0] [q; g] = [0; 1] over R[s]/(s^2 + k),  g = g0 + s g1 = 0
    branch point    [J f_p b; C' 0] [V; g1 g2] = [0; I],                 g1 = g2 = 0, with f + a d = 0

What may hold on a fold besides is in `onfolds`. Generalised Hopf, zero-Hopf, Hopf-Hopf: the conditions together.

The Hopf condition is analytic in k = omega^2 and so passes k = 0; for k < 0 it describes neutral saddles. Source:
Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria (SIAM 2000), chapters 3, 4 and 6, written here
for the quadratic pencil P(s) = s^2 M + s C + K.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations import frozen
from mjcont.numerics.equations.algebra import right_singular
from mjcont.numerics.equations.bends import bend, bends_itself
from mjcont.numerics.equations.bordered import Factored, border, null_vectors, row_scale
from mjcont.numerics.equations.columns import weighted
from mjcont.numerics.equations.differences import bilinear_gradient, directional
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import ROW_GUARD, Condition, Local, System, equation_scale

_SLOW_TIME = 0.1
# rates below this, in 1/s, count as it: their squares are numbers still
_SLOWEST = 1e-150
_UNFOLDED = 1e-6


class Fold(Condition):
    """J is singular: g = 0 with [J b; c' 0] [v; g] = [0; 1]."""

    def __init__(self, local: Local) -> None:
        self.rows = equation_scale(local)
        v, w = null_vectors(self._scaled(local))
        self.b, self.c = w[:, 0], v[:, 0]
        self._cache: tuple[Local, Array, Array, float] | None = None

    def _scaled(self, local: Local) -> Any:
        return weighted(local.jac, self.rows)

    def vectors(self, local: Local) -> tuple[Array, Array, float]:
        """Return (v, w, g) in equilibrated scaled unknowns."""
        if self._cache is None or self._cache[0] is not local:
            lu = self.factored(local)
            rhs = np.zeros(len(self.b) + 1)
            rhs[-1] = 1.0
            right, left = lu.solve(rhs), lu.solve_transposed(rhs)
            self._cache = (local, right[:-1], left[:-1], float(right[-1]))
        return self._cache[1:]

    def factored(self, local: Local) -> Factored:
        """Return the factors of [J b; c' 0]."""
        return Factored(border(self._scaled(local), self.b[:, None], self.c[None]))

    def physical(self, local: Local) -> tuple[Array, Array]:
        """Return the null vectors v and w of df/dx in physical units."""
        v, w, _ = self.vectors(local)
        return v * local.problem.state_scale, w * self.rows

    def value(self, local: Local, aux: Array) -> Array:
        """Return g."""
        return np.array([self.vectors(local)[2]])

    def gradient(self, local: Local, system: System, y: Array) -> Array:
        """Return dg = -w' dJ v over (x, free parameters), (1, n + number free)."""
        v, w = self.physical(local)
        if bends_itself(local):
            return -bend(local, system, y, w, self.vectors(local)[0])[None]
        out = np.empty(system.n + len(system.free))
        out[: system.n] = -bilinear_gradient(local.problem, local.x, local.values, w, v)
        for i, p in enumerate(system.free):
            slope = frozen.parameter_slope(lambda at: w @ directional(at.problem, at.x, at.values, v, 1), local, p.name)
            out[system.n + i] = -slope * p.slope(float(y[i]))
        return out[None]

    def update(self, local: Local, aux: Array) -> None:
        """Take the present null vectors, normalised, as borders."""
        v, w, _ = self.vectors(local)
        self.b, self.c = w / np.linalg.norm(w), v / np.linalg.norm(v)
        self._cache = None


class BranchPoint(Condition):
    """[J f_p] has rank n - 1, with the equilibrium equations unfolded by a: f + a d = 0.

    Without symmetry no curve of branch points in two parameters exists; a then leaves zero, which callers check.
    """

    count, aux = 2, (0.0,)

    def __init__(self, local: Local, parameter: Free) -> None:
        self.parameter = parameter
        self.rows = equation_scale(local)
        if sparse.issparse(local.jac):
            v, w = null_vectors(self._square(local))
            self.c = np.zeros((2, len(v) + 1))
            self.c[0, :-1], self.c[1, -1] = v[:, 0], 1.0
        else:
            v, w = null_vectors(self._wide(local))
            self.c = v.T
        self.b = w[:, 0]
        self.direction = self.b / self.rows

    def _square(self, local: Local) -> Any:
        return weighted(local.jac, self.rows)

    def _wide(self, local: Local) -> Any:
        slope = self.parameter.slope(self.parameter.coordinate(local.values[self.parameter.name]))
        column = (local.par[:, 0] * slope * self.rows)[:, None]
        return border(self._square(local), column, np.zeros((0, len(self.rows))))

    def _solve(self, local: Local) -> tuple[Array, Array, Array]:
        n = len(self.b)
        lu = Factored(border(self._wide(local), self.b[:, None], self.c))
        rhs = np.zeros((n + 2, 2))
        rhs[n, 0] = rhs[n + 1, 1] = 1.0
        right = np.column_stack([lu.solve(r) for r in rhs.T])
        left = lu.solve_transposed(np.append(np.zeros(n + 1), 1.0))
        return right[: n + 1], left[:n], right[n + 1]

    def null(self, local: Local) -> tuple[Array, Array]:
        """Return the kernel of [J f_p] in scaled unknowns, orthonormal (n + 1, 2), and the left vector (n,)."""
        right, left, _ = self._solve(local)
        return np.linalg.qr(right)[0], left * self.rows

    def value(self, local: Local, aux: Array) -> Array:
        """Return (g1, g2)."""
        return self._solve(local)[2]

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return dg = -w' dH V over (x, free parameters) by products of H with V alone, (2, n + number free).

        None where differences of the matrices themselves are to be taken, or a product would leave the bounds.
        """
        problem, itself = local.problem, bends_itself(local)
        if not itself and (problem.own_jacobian or (problem.second_order and problem.nonsmooth)):
            return None
        right, left, _ = self._solve(local)
        if itself:
            w = left * self.rows
            ahead = self._ahead(local, system, y, w)
            return np.array([-bend(local, system, y, w, v[:-1]) - v[-1] * ahead for v in right.T])
        found = frozen.crossing(local, system, y, right, left * self.rows)
        return None if found is None else -found

    @staticmethod
    def _ahead(local: Local, system: System, y: Array, w: Array) -> Array:
        """Return the derivative in the coordinate of the first free parameter of w'[J f_p], (n + number free,)."""
        slopes = np.array([p.slope(float(u)) for p, u in zip(system.free, y, strict=False)])
        lead = system.free[0]

        def whole(at: Local) -> Array:
            return np.append(at.jac.T @ w, (w @ at.par) * slopes)

        found = frozen.parameter_slope(whole, local, lead.name) * slopes[0]
        if lead.log:  # the slope itself changes
            found[system.n] += float(w @ local.par[:, 0]) * slopes[0] ** 2 / local.values[lead.name]
        return np.asarray(found)

    def update(self, local: Local, aux: Array) -> None:
        """Take the present null vectors as borders."""
        right, left, _ = self._solve(local)
        self.c, self.b = np.linalg.qr(right)[0].T.copy(), left / np.linalg.norm(left)

    def exists(self, aux: Array) -> bool:
        """Whether it is not unfolded."""
        return not abs(aux[0]) > _UNFOLDED


class Hopf(Condition):
    """P(s) is singular over R[s]/(s^2 + k): a pair of eigenvalues with sum zero and product k = omega^2.

    The auxiliary unknown is asinh(k / rate^2): smooth through k = 0, and logarithmic where k grows by decades.
    """

    count = 2

    def __init__(self, local: Local, square: float) -> None:
        self.rate = max(float(np.sqrt(abs(square))), _SLOWEST) if square else 1.0
        self.aux = (float(np.arcsinh(square / self.rate / self.rate)),)
        self._prepare(local, square)

    def _prepare(self, local: Local, square: float) -> None:
        """Choose time and row scales and borders for the point at hand.

        Of the two-dimensional null space of the block matrix that q = q0 + s q1 is taken which generates the others
        over the algebra best; likewise the left vector p = w1 + s w0. The borders are the conjugates (s -> -s) of q
        and p, or themselves where s is real: c'q and b'p are then units.
        """
        self.inner = self._time_scale(local, square)
        self.rows = self._row_scale(local)
        n, k = local.problem.n, square / self.inner / self.inner
        v, w = null_vectors(self._block(local, k), 2)
        v, w = v @ _generator(v[:n], v[n:], k), w @ _generator(w[n:], w[:n], k)
        sign = -1.0 if k >= 0 else 1.0
        self.c0, self.c1, self.b0, self.b1 = v[:n], sign * v[n:], w[n:], sign * w[:n]

    def _time_scale(self, local: Local, square: float) -> float:
        """Return omega, or where that vanishes a tenth of the rate at which the system moves."""
        mass, damping, stiffness = (float(abs(m).max()) for m in pencil_of(local))
        typical = np.sqrt(stiffness / mass) if mass > 0 else stiffness / max(damping, _SLOWEST)
        return max(float(np.hypot(np.sqrt(abs(square)), _SLOW_TIME * min(typical, self.rate))), _SLOWEST)

    def _row_scale(self, local: Local) -> Array:
        mass, damping, stiffness = self._unscaled(local)
        return row_scale(abs(stiffness) + abs(damping) + abs(mass), ROW_GUARD)

    def _unscaled(self, local: Local) -> tuple[Any, Any, Any]:
        scale = local.problem.state_scale
        mass, damping, stiffness = pencil_of(local)
        factors = (self.inner * self.inner * scale, self.inner * scale, scale)
        return tuple(weighted(m, columns=f) for m, f in zip((mass, damping, stiffness), factors, strict=True))

    def _block(self, local: Local, k: float) -> Any:
        mass, damping, stiffness = (weighted(a, self.rows) for a in self._unscaled(local))
        even, odd = stiffness - k * mass, damping
        blocks = [[even, -k * odd], [odd, even]]
        if sparse.issparse(even):
            return sparse.bmat(blocks, format="csc")
        return np.concatenate([np.concatenate(row, axis=1) for row in blocks])  # np.block takes ten times as long

    def _bordered(self, local: Local, k: float) -> Any:
        columns = np.concatenate([self.b0, self.b1, -k * self.b1, self.b0]).reshape(2, -1).T
        rows = np.concatenate([self.c0, -k * self.c1, self.c1, self.c0]).reshape(2, -1)
        return border(self._block(local, k), columns, rows)

    def value(self, local: Local, aux: Array) -> Array:
        """Return (g0, g1)."""
        return self._solve(local, self.square(aux) / self.inner / self.inner)

    def _solve(self, local: Local, k: float) -> Array:
        rhs = np.zeros(2 * len(self.b0) + 2)
        rhs[-2] = 1.0
        return Factored(self._bordered(local, k)).solve(rhs)[-2:]

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return dg = -p' dA q over x, parameters and the auxiliary unknown, (2, n + k), by products with q alone.

        None where differences of the matrices themselves are to be taken: the problem does not tell forces of motions.
        """
        problem, n = local.problem, system.n
        at = system.place(self)
        k = self.square(y[at : at + 1]) / self.inner / self.inner
        factored = Factored(self._bordered(local, k))
        ends = np.zeros((2, 2 * n + 2))
        ends[0, -2] = ends[1, -1] = 1.0
        right, left = factored.solve(ends[0]), np.array([factored.solve_transposed(e) for e in ends])
        q = right[: 2 * n].reshape(2, n)
        p = left[:, : 2 * n].reshape(2, 2, n) * self.rows
        if bends_itself(local):
            known: Array | None = bend(local, system, y, p[:, 0], q[0]) + bend(local, system, y, p[:, 1], q[1])
        else:
            known = frozen.gradient(local, system, y, frozen.hopf_motions(q * problem.state_scale, k, self.inner), p)
        if known is None:
            return None
        out = np.zeros((2, n + system.k))
        out[:, : known.shape[1]] = known
        ahead = self._bordered(local, k + 0.5) - self._bordered(local, k - 0.5)  # it is linear in k
        rate = (self.rate / self.inner) ** 2 * float(np.cosh(y[at]))
        out[:, n + at] = -left @ ahead @ right * rate
        return out

    def square(self, aux: Array) -> float:
        """Return omega^2 (negative at a neutral saddle), in 1/s^2."""
        return float(np.sinh(aux[0])) * self.rate * self.rate

    def update(self, local: Local, aux: Array) -> None:
        """Take the present null vectors as borders."""
        self._prepare(local, self.square(aux))

    def exists(self, aux: Array) -> bool:
        """Whether it is no neutral saddle."""
        return self.square(aux) > 0.0


def _generator(even: Array, odd: Array, k: float) -> Array:
    """Return the combination (2,) of null vectors even + s odd, both (n, 2), that is farthest from a zero divisor.

    For k >= 0 that with the largest even part. R[s]/(s^2 + k), k = -a^2 < 0, has zero divisors: what vanishes at s = a
    or at s = -a. The vectors there are multiples of one real eigenvector each, and half way between the combinations
    for which one or the other multiple is largest both are large; as k vanishes it becomes the first choice.
    """
    if k >= 0.0:
        return np.asarray(right_singular(even)[0])
    a = float(np.sqrt(-k))
    one, other = (right_singular(even + s * odd)[0] for s in (a, -a))
    middle = one + other if one @ other >= 0.0 else one - other
    return np.asarray(middle / np.linalg.norm(middle))


def pencil_of(local: Local) -> tuple[Any, Any, Any]:
    """Return (M, C, K), with zeros and the identity for a first-order system; sparse where K is."""
    pencil, n = local.pencil, local.problem.n
    thin = sparse.issparse(pencil.stiffness)
    mass, damping = pencil.mass, pencil.damping
    if mass is None:
        mass = sparse.csc_matrix((n, n)) if thin else np.zeros((n, n))
    if damping is None:
        damping = sparse.identity(n, format="csc") if thin else np.eye(n)
    return mass, damping, pencil.stiffness
