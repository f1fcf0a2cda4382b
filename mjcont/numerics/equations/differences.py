"""Centred difference stencils, as offsets and weights, and the directional derivatives built on them.

The error of a first derivative is noise/step + step^order. With stiff bushes the noise of f is about 1e-15 k L;
`FIRST` is used while stepping, `FOURTH` where a special point is located.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from mjcont.numerics.equations.problem import Array, Equations, Stencil, Values

SECOND_ORDER = Stencil((1.0, -1.0), (0.5, -0.5), 2e-6)
FOURTH_ORDER = Stencil((1.0, -1.0, 2.0, -2.0), (2 / 3, -2 / 3, -1 / 12, 1 / 12), 1e-4)
CENTRED = Stencil((1.0, -1.0), (0.5, -0.5), 1e-3)
FORWARD = Stencil((0.0, 1.0), (-1.0, 1.0), 1e-3)
PARAMETER = Stencil((1.0, -1.0, 2.0, -2.0), (2 / 3, -2 / 3, -1 / 12, 1 / 12), 1e-3)
_ONE_SIDED = Stencil((0.0, 1.0, 2.0, 3.0, 4.0), (-25 / 12, 4.0, -3.0, 4 / 3, -1 / 4), 1e-3)


def stencil(accurate: bool) -> Stencil:
    """Return the stencil for stepping or for locating special points."""
    return FOURTH_ORDER if accurate else SECOND_ORDER


def inward(value: float, step: float, bounds: tuple[float, float]) -> float:
    """Return a difference step, smaller or of the other sign where it would leave bounds."""
    low, high = bounds
    if value + step <= high:
        return step
    return max(-step, low - value) if value - low > high - value else high - value


def kept_within(rule: Stencil, step: float, value: float, bounds: tuple[float, float]) -> tuple[Stencil, float]:
    """Return a difference rule and step, one-sided of the same order where the centred one would leave bounds.

    A value beyond the bounds is not kept within them.
    """
    low, high = bounds
    reach = max(rule.offsets) * step
    if low <= value - reach and value + reach <= high or not low <= value <= high:
        return rule, step
    if len(rule.offsets) == 2:
        return FORWARD, inward(value, step, bounds)
    return _ONE_SIDED, 0.25 * inward(value, 4.0 * step, bounds)


@cache
def _unit_steps(n: int, rule: Stencil) -> Array:
    steps = np.concatenate([o * rule.step * np.eye(n) for o in rule.offsets])
    steps.flags.writeable = False
    return steps


def jacobian_steps(scale: Array, rule: Stencil) -> Array:
    """Return the tangent steps of all columns, (len(offsets) * n, n), each scaled by its coordinate's size."""
    return _unit_steps(len(scale), rule) * scale


def jacobian_from_rows(rows: Array, scale: Array, rule: Stencil) -> Array:
    """Combine f at `jacobian_steps` into df/dx, (n_f, n)."""
    found: Array = jacobians_from_rows(rows[None], scale, rule)[0]
    return found


def jacobians_from_rows(rows: Array, scale: Array, rule: Stencil) -> Array:
    """Combine f at the `jacobian_steps` of several points, (m, len(offsets) * n, n_f), into df/dx, (m, n_f, n)."""
    (m, _, size), n = rows.shape, len(scale)
    if len(rule.offsets) == 2:
        columns = rows[:, :n] - rows[:, n:]
        columns *= (rule.weights[0] / (rule.step * scale))[:, None]
    else:
        mixed = np.asarray(rule.weights) @ rows.reshape(m, len(rule.offsets), n * size)
        columns = mixed.reshape(m, n, size) / (rule.step * scale)[:, None]
    return np.ascontiguousarray(columns.transpose(0, 2, 1))


# part of its step to which a higher derivative is narrowed where f is smooth in pieces
_SMALLEST = 1e-4

# Sixth-order stencils in t for f(x + t v): values at t = -3h..3h.
NODES = np.array([-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
FIRST = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
SECOND = np.array([2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0]) / 180.0
# Eighth-wide stencil for the third derivative, sixth order.
FAR_NODES = np.arange(-4.0, 5.0)
THIRD = np.array([-7.0, 72.0, -338.0, 488.0, 0.0, -488.0, 338.0, -72.0, 7.0]) / 240.0


def length_of(v: Array, scale: Array) -> float:
    """Return the largest component of v in units of its coordinate's scale, 1 for a zero vector."""
    size = float(np.max(np.abs(v) / scale)) if v.any() else 1.0
    return size


def directional(problem: Equations, x: Array, values: Values, v: Array, order: int, step: float = 1e-2) -> Array:
    """Return the `order`-th derivative (1, 2 or 3) of f along v at x, (n,): the problem's own, or of sixth order.

    The step is `step` of the coordinates' scale for the largest component of v, smaller where f is smooth in pieces
    and one of them is smaller.
    """
    own = problem.derivative_along(x, values, *(v,) * order)
    if own is not None:
        return own
    h, smallest = step / length_of(v, problem.state_scale), _SMALLEST * step / length_of(v, problem.state_scale)
    while True:
        found = combine(lambda rows: problem.residuals(x, values, rows), v, order, h)
        if h <= smallest or len(set(problem.pieces)) <= 1:
            return found
        h *= 0.25


def combine(f: Callable[[Array], Array], v: Array, order: int, h: float) -> Array:
    """Return the `order`-th derivative of t -> f(t v) at 0 from a batched f."""
    nodes, weights = {1: (NODES, FIRST), 2: (NODES, SECOND), 3: (FAR_NODES, THIRD)}[order]
    rows = f((nodes * h)[:, None] * v)
    return weights @ rows / np.float64(h) ** order  # a power of Python's own raises where it overflows


# weights of lower orders on the nodes of `combine`, by the order of the derivative: of fourth and of second order
_LOWER = {
    1: (np.array([0.0, 1.0, -8.0, 0.0, 8.0, -1.0, 0.0]) / 12.0, np.array([0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0]) / 2.0),
    2: (
        np.array([0.0, -1.0, 16.0, -30.0, 16.0, -1.0, 0.0]) / 12.0,
        np.array([0.0, 0.0, 1.0, -2.0, 1.0, 0.0, 0.0]),
    ),
    3: (
        np.array([0.0, 1.0, -8.0, 13.0, 0.0, -13.0, 8.0, -1.0, 0.0]) / 8.0,
        np.array([0.0, 0.0, -1.0, 2.0, 0.0, -2.0, 1.0, 0.0, 0.0]) / 2.0,
    ),
}
_SHORTER, _ROUNDS, _SMALL = 0.3, 8, 1e-7
# rounding in parts of f, and how many times larger a derivative is than that leaves of it, to be told from zero
_ROUNDING, _TOLD = 1e-15, 1e2


def by_orders(rows: Array, order: int, h: float | Array) -> tuple[Array, Array, Array]:
    """Return a derivative of f from its rows (..., nodes, n) at `NODES`, of the third order at `FAR_NODES`, times h.

    Of sixth, fourth and second order, (..., n) each; h is a number or (..., 1).
    """
    weights, power = {1: FIRST, 2: SECOND, 3: THIRD}[order], np.asarray(h, dtype=float) ** order
    sixth, fourth, second = (w @ rows / power for w in (weights, *_LOWER[order]))
    return sixth, fourth, second


def settled_combine(f: Callable[[Array], Array], vectors: Array, order: int, h: float) -> tuple[Array, Array]:
    """Return `combine` along vectors (k, n), (k, n), with steps that suit f, and relative errors (k,).

    These are zero where rounding alone is left. What an order of two more changes falls from order to order by a
    factor, by which the last change falls once more. Along all vectors f is evaluated in one call.
    """
    (count, n), nodes = vectors.shape, FAR_NODES if order == 3 else NODES
    best, least, relative = np.zeros((count, n)), np.full(count, np.inf), np.zeros(count)
    steps, going = np.full(count, h), np.arange(count)
    for turn in range(_ROUNDS):
        rows = f(((nodes * steps[going, None])[:, :, None] * vectors[going, None]).reshape(-1, n))
        rows = rows.reshape(len(going), len(nodes), n)
        sixth, fourth, second = by_orders(rows, order, steps[going, None])
        size, last, first = (np.abs(a).max(axis=1) for a in (sixth, sixth - fourth, fourth - second))
        noise = _ROUNDING * np.abs(rows).max(axis=(1, 2)) / steps[going] ** order
        error = last * np.minimum(1.0, last / np.maximum(first, 1e-300))
        better = (error < least[going]) | (turn == 0)
        chosen = going[better]
        best[chosen], least[chosen] = sixth[better], error[better]
        relative[chosen] = np.where(size > _TOLD * noise, np.maximum(error, noise) / size, 0.0)[better]
        going = going[(noise < error) & (error <= least[going]) & (error > _SMALL * size)]
        if not len(going):
            break
        steps[going] *= _SHORTER
    return best, relative


def second_form(problem: Equations, x: Array, values: Values, u: Array, v: Array, step: float = 1e-2) -> Array:
    """Return B(u, v), the second derivative of f in two directions, the problem's own or by polarization, (n,)."""
    own = problem.derivative_along(x, values, u, v)
    if own is not None:
        return own
    if np.array_equal(u, v):
        return directional(problem, x, values, u, 2, step)
    scale = problem.state_scale
    a, b = u / length_of(u, scale), v / length_of(v, scale)
    plus = directional(problem, x, values, a + b, 2, step)
    minus = directional(problem, x, values, a - b, 2, step)
    return 0.25 * (plus - minus) * length_of(u, scale) * length_of(v, scale)


def bilinear_gradient(
    problem: Equations, x: Array, values: Values, w: Array, v: Array, step: float = 3e-4
) -> Array:
    """Return the gradient in scaled x of w . (df/dx) v, (n,): 4 n + 7 evaluations.

    Centred differences, whose error with stiff bushes is about k step^2, replaced along v itself by the sixth-order
    w . B(v, v): a null vector v is the direction in which a curve of folds or a Newton step to a fold moves. Columns
    whose points straddle a kink of f are one-sided, to first order.
    """
    n, scale = problem.n, problem.state_scale
    length = length_of(v, scale)
    dv = (step / length) * v
    f = problem.residuals(x, values, _mixed_steps(dv, scale, step)) @ w
    pp, pm, mp, mm = f.reshape(4, n)
    gradient = (pp - pm - mp + mm) / (4.0 * step * (step / length))
    if len(set(problem.pieces)) > 1:
        rows = np.array(problem.pieces).reshape(4, n).T
        _one_sided_gradient(problem, x, values, w, dv, gradient, rows, (f.reshape(4, n), step, step / length))
    u = v / scale
    exact = float(w @ directional(problem, x, values, v, 2))
    found: Array = gradient + (exact - gradient @ u) / (u @ u) * u
    return found


def _mixed_steps(dv: Array, scale: Array, step: float) -> Array:
    """Return the steps of a mixed difference along dv and every coordinate, (4 n, n)."""
    e = step * np.diag(scale)
    return np.concatenate([e + dv, e - dv, -e + dv, -e - dv])


def product_slopes(problem: Equations, x: Array, values: Values, v: Array, step: float = 3e-4) -> Array:
    """Return the derivatives of (df/dx) v in each scaled coordinate, (n, n_f), where f is smooth: 4 n evaluations."""
    length = length_of(v, problem.state_scale)
    rows = problem.residuals(x, values, _mixed_steps((step / length) * v, problem.state_scale, step))
    pp, pm, mp, mm = rows.reshape(4, problem.n, -1)
    found: Array = (pp - pm - mp + mm) / (4.0 * step * (step / length))
    return found


def product(problem: Equations, x: Array, values: Values, v: Array, step: float = 3e-4) -> Array:
    """Return (df/dx) v to second order, (n_f,): two evaluations."""
    h = step / length_of(v, problem.state_scale)
    ahead, back = problem.residuals(x, values, h * np.array([v, -v]))
    found: Array = (ahead - back) / (2.0 * h)
    return found


def _one_sided_gradient(
    problem: Equations,
    x: Array,
    values: Values,
    w: Array,
    dv: Array,
    gradient: Array,
    rows: Array,
    known: tuple[Array, float, float],
) -> None:
    """Replace the entries of a gradient whose points, `rows` (n, 4) by their pieces, do not all lie on that of x.

    `known` are w . f at the points, (4, n), and the steps along a coordinate and along v.
    """
    f, step, along = known
    ahead, back, _ = problem.residuals(x, values, np.array([dv, -dv, np.zeros_like(dv)])) @ w
    here = problem.pieces[2]
    for j in np.flatnonzero(np.any(rows != here, axis=1)):
        if np.all(rows[j, :2] == here):  # both points beyond +e_j
            gradient[j] = (f[0, j] - f[1, j] - ahead + back) / (2.0 * step * along)
        elif np.all(rows[j, 2:] == here):
            gradient[j] = (ahead - back - f[2, j] + f[3, j]) / (2.0 * step * along)
