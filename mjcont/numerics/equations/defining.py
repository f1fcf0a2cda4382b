"""Conditions that define special points, as minimally augmented (bordered) systems.

With J = df/dx in scaled unknowns, rows equilibrated, and borders b, c near its left and right null vectors:

    fold            [J b; c' 0] [v; g] = [0; 1],                         g = 0
    Hopf            [P(s) b; c' 0] [q; g] = [0; 1] over R[s]/(s^2 + k),  g = g0 + s g1 = 0
    branch point    [J f_p b; C' 0] [V; g1 g2] = [0; I],                 g1 = g2 = 0, with f + a d = 0
    cusp            fold and w . B(v, v) = 0
    Bogdanov-Takens fold and w . C v = 0  (w . v for a first-order system)
    generalised Hopf, zero-Hopf, Hopf-Hopf: the conditions together

The Hopf condition is analytic in k = omega^2 and so passes k = 0; for k < 0 it describes neutral saddles. Source:
Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria (SIAM 2000), chapters 3, 4 and 6, written here
for the quadratic pencil P(s) = s^2 M + s C + K.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.algebra import singular
from mjcont.numerics.equations.bordered import Factored, border, null_vectors, row_scale
from mjcont.numerics.equations.differences import (
    bilinear_gradient,
    directional,
    product,
    product_slopes,
    second_form,
)
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import ROW_GUARD, Condition, Local, System, equation_scale

# step of a mixed difference, in scaled unknowns
_BEND_STEP = 3e-4
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

    def _scaled(self, local: Local) -> Array:
        dense = not sparse.issparse(local.jac)
        found: Array = self.rows[:, None] * local.jac if dense else sparse.diags(self.rows) @ local.jac
        return found

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
        out = np.empty(system.n + len(system.free))
        out[: system.n] = -bilinear_gradient(local.problem, local.x, local.values, w, v)
        for i, p in enumerate(system.free):
            slope = parameter_slope(lambda at: w @ directional(at.problem, at.x, at.values, v, 1), local, p.name)
            out[system.n + i] = -slope * p.slope(float(y[i]))
        return out[None]

    def update(self, local: Local, aux: Array) -> None:
        """Take the present null vectors, normalised, as borders."""
        v, w, _ = self.vectors(local)
        self.b, self.c = w / np.linalg.norm(w), v / np.linalg.norm(v)
        self._cache = None


def parameter_slope(function: Callable[[Local], Any], local: Local, name: str) -> Any:
    """Return d function / d p, a number or an array, for a parameter, in physical units, by differences in p."""
    bounds = local.ranges[local.wrt.index(name)] if local.ranges else None
    rule, h = local.problem.parameter_stencil(name, local.values[name], bounds)
    total: Any = 0.0
    for offset, weight in zip(rule.offsets, rule.weights, strict=True):
        values = {**local.values, name: local.values[name] + offset * h}
        total += weight * function(Local(local.problem, local.x, values, local.wrt, local.accurate, local.ranges))
    return total / h


def _bend(system: System, local: Local, y: Array, v: Array) -> Array | None:
    """Return the derivatives of (f_x, f_u) v in every scaled coordinate and free parameter, (n + number free, n).

    u is the coordinate of the first free parameter, v (n + 1,). 4 n evaluations and four for each parameter; None where
    one would leave its bounds.
    """
    n, scale = system.n, system.problem.state_scale
    h = _BEND_STEP / float(np.abs(v).max())
    unit, along = np.eye(system.k), h * v[:n] * scale
    ahead = h * v[n] * unit[0]
    sides = [system.gradient_step(i, y) * unit[i] for i in range(len(system.free))]
    reach = np.abs(ahead) + np.sum(sides, axis=0)
    if np.any((y - reach < system.lowest) | (y + reach > system.highest)):
        return None

    def across(aside: Array, rows: Array) -> Array:
        plus, minus = (
            system.problem.residuals(local.x, system.values(y + sign * ahead + aside), rows + sign * along)
            for sign in (1.0, -1.0)
        )
        return plus - minus

    e = _BEND_STEP * np.diag(scale)
    change, found = across(np.zeros(system.k), np.concatenate([e, -e])), np.empty((n + len(sides), n))
    found[:n] = (change[:n] - change[n:]) / (4.0 * _BEND_STEP * h)
    for i, side in enumerate(sides):
        found[n + i] = (across(side, np.zeros((1, n))) - across(-side, np.zeros((1, n))))[0] / (4.0 * side[i] * h)
    return found


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
        return sparse.diags(self.rows) @ local.jac if sparse.issparse(local.jac) else self.rows[:, None] * local.jac

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
        if local.problem.second_order or local.problem.own_jacobian or sparse.issparse(local.jac):
            return None
        right, left, _ = self._solve(local)
        bends = [_bend(system, local, y, v) for v in right.T]
        found = [-bend @ (left * self.rows) for bend in bends if bend is not None]
        return np.array(found) if len(found) == len(bends) else None

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
        mass, damping, stiffness = (float(np.abs(m).max()) for m in dense_pencil(local))
        typical = np.sqrt(stiffness / mass) if mass > 0 else stiffness / max(damping, _SLOWEST)
        return max(float(np.hypot(np.sqrt(abs(square)), _SLOW_TIME * min(typical, self.rate))), _SLOWEST)

    def _row_scale(self, local: Local) -> Array:
        mass, damping, stiffness = self._unscaled(local)
        return row_scale(np.abs(stiffness) + np.abs(damping) + np.abs(mass), ROW_GUARD)

    def _unscaled(self, local: Local) -> tuple[Array, Array, Array]:
        scale = local.problem.state_scale
        mass, damping, stiffness = dense_pencil(local)
        return self.inner * self.inner * mass * scale, self.inner * damping * scale, stiffness * scale

    def _block(self, local: Local, k: float) -> Array:
        mass, damping, stiffness = (self.rows[:, None] * a for a in self._unscaled(local))
        even, odd = stiffness - k * mass, damping
        blocks = [[even, -k * odd], [odd, even]]
        return np.concatenate([np.concatenate(row, axis=1) for row in blocks])  # np.block takes ten times as long

    def _bordered(self, local: Local, k: float) -> Array:
        columns = np.concatenate([self.b0, self.b1, -k * self.b1, self.b0]).reshape(2, -1).T
        rows = np.concatenate([self.c0, -k * self.c1, self.c1, self.c0]).reshape(2, -1)
        found: Array = border(self._block(local, k), columns, rows)
        return found

    def value(self, local: Local, aux: Array) -> Array:
        """Return (g0, g1)."""
        return self._solve(local, self.square(aux) / self.inner / self.inner)

    def _solve(self, local: Local, k: float) -> Array:
        rhs = np.zeros(2 * len(self.b0) + 2)
        rhs[-2] = 1.0
        return Factored(self._bordered(local, k)).solve(rhs)[-2:]

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return dg = -p' dA q over x, parameters and the auxiliary unknown, (2, n + k), by products of J with q alone.

        None where differences of the matrices themselves are to be taken: with a mass matrix, and where J is given.
        """
        problem, n = local.problem, system.n
        if problem.second_order or problem.own_jacobian:
            return None
        at = system.place(self)
        k = self.square(y[at : at + 1]) / self.inner / self.inner
        factored = Factored(self._bordered(local, k))
        ends = np.eye(2 * n + 2)[-2:]
        right, left = factored.solve(ends[0]), np.array([factored.solve_transposed(e) for e in ends])
        q = right[: 2 * n].reshape(2, n) * problem.state_scale
        p = left[:, : 2 * n].reshape(2, 2, n) * self.rows
        out = np.zeros((2, n + system.k))
        for j in range(2):
            out[:, :n] += p[:, j] @ product_slopes(problem, local.x, local.values, q[j]).T
        def products(beside: Local) -> Array:
            return np.array([product(problem, beside.x, beside.values, v) for v in q])

        for i, free in enumerate(system.free):
            moved = parameter_slope(products, local, free.name) * free.slope(float(y[i]))
            out[:, n + i] = np.einsum("ijk,jk->i", p, moved)
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
        return np.asarray(singular(even)[2][0])
    a = float(np.sqrt(-k))
    one, other = (singular(even + s * odd)[2][0] for s in (a, -a))
    middle = one + other if one @ other >= 0.0 else one - other
    return np.asarray(middle / np.linalg.norm(middle))


def dense_pencil(local: Local) -> tuple[Array, Array, Array]:
    """Return (M, C, K) as dense arrays, with zeros and the identity for a first-order system."""
    pencil, n = local.pencil, local.problem.n
    stiffness = pencil.stiffness.toarray() if sparse.issparse(pencil.stiffness) else pencil.stiffness
    mass = np.zeros((n, n)) if pencil.mass is None else pencil.mass
    damping = np.eye(n) if pencil.damping is None else pencil.damping
    return mass, damping, stiffness


class FoldCoefficient(Condition):
    """Cusp: w . B(v, v) / 2 = 0 for the null vectors of a `Fold` of the same system."""

    def __init__(self, fold: Fold, local: Local) -> None:
        self.fold = fold
        v, w, _ = fold.vectors(local)
        self.weight = float(np.linalg.norm(v) ** 2 * np.linalg.norm(w))

    def value(self, local: Local, aux: Array) -> Array:
        """Return the coefficient with the borders' normalisation."""
        v, w = self.fold.physical(local)
        return np.array([0.5 * w @ second_form(local.problem, local.x, local.values, v, v)]) / self.weight

    def gradient(self, local: Local, system: System, y: Array) -> Array:
        """Return the gradient over (x, free parameters), (1, n + number free).

        Centred differences are wrong by about k step^2 with stiff bushes, which cancels only in part along the null
        vector v, where the coefficient itself changes little; along v they are replaced by a fourth-order difference.
        """
        v = self.fold.vectors(local)[0]
        gradient = system.gradients([self], local, y)[:, : system.n + len(system.free)]
        ahead = np.append(v, np.zeros(system.k))
        off = system.slope(self, local, y, ahead) - gradient[:, : system.n] @ v
        gradient[:, : system.n] += off[:, None] * v / (v @ v)
        return gradient


class DoubleZero(Condition):
    """Bogdanov-Takens: w . C v = 0 on a fold (C = I for a first-order system)."""

    def __init__(self, fold: Fold, local: Local) -> None:
        self.fold = fold
        v, w = fold.physical(local)
        damping = dense_pencil(local)[1]
        self.weight = float(np.abs(w) @ np.abs(damping) @ np.abs(v)) or 1.0

    def value(self, local: Local, aux: Array) -> Array:
        """Return w . C v."""
        v, w = self.fold.physical(local)
        return np.array([w @ dense_pencil(local)[1] @ v]) / self.weight

class Transversality(Condition):
    """w . f_p = 0 on a fold locus, p its first parameter: the locus turns in the second without a cusp."""

    def __init__(self, fold: Fold, local: Local) -> None:
        self.fold = fold
        _, w = fold.physical(local)
        self.weight = float(np.abs(w) @ np.abs(local.par[:, 0])) or 1.0

    def value(self, local: Local, aux: Array) -> Array:
        """Return w . f_p."""
        _, w = self.fold.physical(local)
        return np.array([w @ local.par[:, 0]]) / self.weight
