"""Normal-form coefficients of special points.

    fold          a  = w . B(v, v) / 2                         with w . v = 1, |v| = 1
    cusp          c  = w . (C(v, v, v) - 3 B(v, h)) / 6,       J h = B(v, v) - <w, B(v, v)> v, w . h = 0
    Hopf          l1 = Re <p, C(q, q, q*) - 2 B(q, J^-1 B(q, q*)) + B(q*, (2 i omega - J)^-1 B(q, q))> / (2 omega)
    branch point  roots of w . F''(phi, phi) = 0 on the kernel of [J f_p]

Source: Kuznetsov, Elements of Applied Bifurcation Theory, 3rd ed., sections 3.3, 5.4 and 8.2. Coefficients of a
second-order problem are those in its n positions (|v| = 1 there).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.algebra import least_squares, singular, solve
from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.differences import (
    FOURTH_ORDER,
    directional,
    jacobian_from_rows,
    jacobian_steps,
    second_form,
    settled_combine,
)
from mjcont.numerics.equations.problem import Array, Equations, Values
from mjcont.numerics.equations.system import Local

# second derivatives of fourth order, as nodes and weights: centred, and to one side
_SECOND = np.arange(-2.0, 3.0), np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0
_SECOND_ASIDE = np.arange(6.0), np.array([45.0, -154.0, 214.0, -156.0, 61.0, -10.0]) / 12.0
# a coefficient counts as zero below this, for amplitudes of the state's scale and in the time of the oscillation
_DEGENERATE = 1e-9
# a coefficient with a larger relative error says so
_KNOWN = 1e-4
# relative errors of differences from which on a coefficient is computed again with other steps
_POOR = 1e-6


def fold_coefficient(local: Local, v: Array, w: Array) -> float:
    """Return a for null vectors in physical units (any length)."""
    v = v / np.linalg.norm(v)
    w = w / (w @ v)
    return float(0.5 * w @ second_form(local.problem, local.x, local.values, v, v))


def cusp_coefficient(local: Local, v: Array, w: Array) -> float:
    """Return c for null vectors in physical units (any length)."""
    problem, x, values = local.problem, local.x, local.values
    v = v / np.linalg.norm(v)
    w = w / (w @ v)
    b = second_form(problem, x, values, v, v)
    h = _bordered_solve(local.raw_jac, w, v, b - (w @ b) * v if not problem.second_order else b)
    third = directional(problem, x, values, v, 3, 2e-2)
    return float(w @ (third - 3.0 * second_form(problem, x, values, v, h)) / 6.0)


def _bordered_solve(jac: Any, w: Array, v: Array, rhs: Array) -> Array:
    """Return h with J h = rhs up to the left null direction and v . h = 0."""
    matrix = jac.toarray() if sparse.issparse(jac) else jac
    full = np.block([[matrix, w[:, None]], [v[None], np.zeros((1, 1))]])
    return least_squares(full, np.append(rhs, 0.0))[:-1]


class FirstOrder:
    """The first-order form around an equilibrium, with multilinear forms by sixth-order differences.

    They are the problem's own, or differences of df/dx where it computes that itself, else of f, with steps shortened
    until their error, as differences of lower orders through the same places tell it, is small or grows by rounding.

    Attributes
    ----------
    error : the largest of these errors so far, relative to the form.
    """

    def __init__(self, problem: Equations, x: Array, values: Values, *, shorter: float = 1.0) -> None:
        self._f = partial(problem.first_order, x, values)
        self._problem, self._x, self._values, self._shorter = problem, x, values, shorter
        scale = problem.state_scale
        self.scale = np.concatenate([scale, scale]) if problem.second_order else scale
        self.error = 0.0

    def jacobian(self) -> Array:
        """Return the Jacobian of the first-order form."""
        rows = self._f(jacobian_steps(self.scale, FOURTH_ORDER))
        return jacobian_from_rows(rows, self.scale, FOURTH_ORDER)

    def size(self, v: Array) -> float:
        """Return the largest component of a vector in units of its coordinate's scale."""
        return float(np.max(np.abs(v) / self.scale))

    def _along(self, order: int, *vectors: Array) -> list[Array]:
        """Return the derivatives of an order along some vectors; those of first-order systems in one go."""
        stack = np.array(vectors)
        found, lengths = np.zeros(stack.shape), (np.abs(stack) / self.scale).max(axis=1)
        chosen = np.flatnonzero(lengths != 0.0)
        units = stack[chosen] / lengths[chosen, None]
        own, step = self._problem.own_jacobian, self._shorter * {2: 1e-2, 3: 2e-2}[order]
        if self._problem.second_order or own:
            own = own and not self._problem.second_order
            each = [
                settled_combine(partial(self._slopes, u) if own else self._f, u[None], order - own, step) for u in units
            ]
            parts, errors = np.array([a[0] for a, _ in each]).reshape(units.shape), np.array([e[0] for _, e in each])
        else:
            parts, errors = settled_combine(self._f, units, order, step)
        self.error = max(self.error, float(errors.max(initial=0.0)))
        found[chosen] = parts * lengths[chosen, None] ** order
        return list(found)

    def _slopes(self, v: Array, rows: Array) -> Array:
        """Return J v at steps (m, n), from the problem's own Jacobian."""
        at = (self._problem.retract(self._x, row) for row in rows)
        return np.array([directional(self._problem, x, self._values, v, 1) for x in at])

    def second(self, u: Array, v: Array) -> Array:
        """Return B(u, v) for complex vectors."""
        if not (np.iscomplexobj(u) or np.iscomplexobj(v)):
            return self._seconds((u, v))[0]
        ur, ui, vr, vi = np.real(u), np.imag(u), np.real(v), np.imag(v)
        one, two, three, four = self._seconds((ur, vr), (ui, vi), (ur, vi), (ui, vr))
        return one - two + 1j * (three + four)

    def _seconds(self, *pairs: tuple[Array, Array]) -> list[Array]:
        """Return B(u, v) for some pairs of real vectors."""
        own = [f for u, v in pairs if (f := self._own(u, v)) is not None]
        if own:
            return own
        both = self._along(2, *(w for u, v in pairs for w in (u + v, u - v)))
        return [0.25 * (plus - minus) for plus, minus in zip(both[::2], both[1::2], strict=True)]

    def trilinear(self, u: Array, v: Array, w: Array) -> Array:
        """Return C(u, v, w) for complex vectors."""
        total = np.zeros(len(u), dtype=complex)
        for i, a in enumerate((u.real, u.imag)):
            for j, b in enumerate((v.real, v.imag)):
                for k, c in enumerate((w.real, w.imag)):
                    if a.any() and b.any() and c.any():
                        total += 1j ** (i + j + k) * self._polarized(a, b, c)
        return total

    def _own(self, *vectors: Array) -> Array | None:
        """Return a form that the problem computes itself."""
        return None if self._problem.second_order else self._problem.derivative_along(self._x, self._values, *vectors)

    def _polarized(self, u: Array, v: Array, w: Array) -> Array:
        own = self._own(u, v, w)
        if own is not None:
            return own
        one, two, three, four = self._along(3, u + v + w, u + v - w, u - v + w, u - v - w)
        return (one - two - three + four) / 24.0

    def third(self, u: Array, v: Array) -> Array:
        """Return C(u, u, v) for real vectors."""
        own = self._own(u, u, v)
        if own is not None:
            return own
        plus, minus, alone = self._along(3, u + v, u - v, v)
        return (plus - minus - 2.0 * alone) / 6.0


@dataclass(frozen=True, slots=True)
class Lyapunov:
    """The first Lyapunov coefficient of a Hopf point.

    Attributes
    ----------
    value : as the differences give it.
    error : what they leave open of it.
    floor : below which rounding alone is left.
    """

    value: float
    error: float
    floor: float

    @property
    def l1(self) -> float:
        """The coefficient, zero where rounding alone is left of it."""
        return 0.0 if abs(self.value) < self.floor else self.value

    @property
    def known(self) -> bool:
        """Whether its error is small beside it."""
        return self.l1 == 0.0 or not self.error > _KNOWN * abs(self.value)


def lyapunov(problem: Equations, x: Array, values: Values, omega: float) -> Lyapunov:
    """Return l1 at a Hopf point of frequency omega; poor differences have what half the steps change for an error.

    |q| = 1 in the unknowns of a first-order problem, in the positions of a second-order one.
    """
    form = FirstOrder(problem, x, values)
    found = _lyapunov(form, problem, omega)
    if not form.error > _POOR:
        return found
    half = FirstOrder(problem, x, values, shorter=0.5)
    again = _lyapunov(half, problem, omega)
    best = again if half.error < form.error else found
    return replace(best, error=abs(again.value - found.value))


def _lyapunov(form: FirstOrder, problem: Equations, omega: float) -> Lyapunov:
    jac = form.jacobian()
    q, p = eigenvectors(jac, omega)
    if problem.second_order:
        q = q / np.linalg.norm(q[: problem.n])
        p = p / np.vdot(q, p).conj()
    qr, qi = q.real, q.imag
    c = form.third(qr, qr) + 1j * form.third(qi, qi)
    c += form.third(qi, qr) + 1j * form.third(qr, qi)
    b = form.second(q, q.conj()).real
    identity = np.eye(len(jac))
    h11 = solve(jac, b)
    h20 = solve(2j * omega * identity - jac, form.second(q, q))
    terms = np.array([c, -2.0 * form.second(q, h11), form.second(q.conj(), h20)])
    found = float(np.real(np.vdot(p, terms.sum(axis=0))) / (2.0 * omega))
    size = np.abs(p) @ np.abs(terms).sum(axis=0) / (2.0 * np.float64(abs(omega)))
    return Lyapunov(found, float(form.error * size), _DEGENERATE * form.size(q) ** 2)


def eigenvectors(jac: Array, omega: float) -> tuple[Array, Array]:
    """Return q and p with J q = i omega q, J' p = -i omega p, |q| = 1 and <p, q> = 1."""
    u, _, vh = singular(jac - 1j * omega * np.eye(len(jac)))
    q, p = vh[-1].conj(), u[:, -1]
    return q, p / np.vdot(q, p)


def double_zero_coefficients(problem: Equations, x: Array, values: Values) -> dict[str, float]:
    """Return a, b of the Bogdanov-Takens normal form x'' = a x^2 + b x x' of the first-order form.

    a = p1 . B(q0, q0) / 2, b = p0 . B(q0, q0) + p1 . B(q0, q1) with the generalised eigenvectors J q0 = 0,
    J q1 = q0, J' p1 = 0, J' p0 = p1, <p0, q0> = <p1, q1> = 1, <p0, q1> = 0 (Kuznetsov, section 8.4).
    """
    form = FirstOrder(problem, x, values)
    jac = form.jacobian()
    u, _, vt = singular(jac)
    q0, p1 = vt[-1], u[:, -1]
    full = np.block([[jac, p1[:, None]], [q0[None], np.zeros((1, 1))]])
    q1 = solve(full, np.append(q0, 0.0))[:-1]
    p1 = p1 / (p1 @ q1)
    p0 = solve(full.T, np.append(p1, 0.0))[:-1]
    p0 = p0 - (p0 @ q1) * p1
    b00, b01 = form.second(q0, q0), form.second(q0, q1)
    return {"a": float(0.5 * p1 @ b00), "b": float(p0 @ b00 + p1 @ b01)}


def pitchfork_coefficient(local: Local, w: Array) -> float:
    """Return the cubic coefficient c of x' = b mu x + c x^3: supercritical for c < 0."""
    jac = local.raw_jac.toarray() if sparse.issparse(local.raw_jac) else local.raw_jac
    v = singular(jac)[2][-1]
    return cusp_coefficient(local, v, w)


@dataclass(frozen=True, slots=True)
class Crossing:
    """What happens at a simple branch point.

    Attributes
    ----------
    tangents : directions of the two branches, (n + 1,) each, in scaled unknowns, the parameter growing along them; that
        along which it moves most comes first.
    kind : "transcritical", "pitchfork" (with "supercritical" or "subcritical"), or "isola centre".
    """

    tangents: tuple[Array, ...]
    kind: str


def crossing(local: Local, kernel: Array, w: Array, slope: float) -> Crossing:
    """Return the branches through a branch point.

    Parameters
    ----------
    kernel : (n + 1, 2) orthonormal kernel of [J f_p] in scaled unknowns.
    w : (n,) left null vector in physical units.
    slope : d value / d coordinate of the parameter.
    """
    name = local.wrt[0]
    problem, value = local.problem, local.values[name]

    low, high = (local.ranges[0] if local.ranges else None) or (-math.inf, math.inf)

    def along(direction: Array) -> float:
        h, rate = 5e-3, slope * float(direction[-1])
        nodes, weights = _SECOND
        reach = h * abs(rate) * nodes.max()
        if not low <= value - reach <= value + reach <= high:  # on a bound, which the parameter does not leave
            nodes, weights = _SECOND_ASIDE
            h = math.copysign(h, rate if high - value > value - low else -rate)
        total = 0.0
        for t, weight in zip(nodes * h, weights, strict=True):
            x = problem.retract(local.x, t * direction[:-1] * problem.state_scale)
            total += weight * float(w @ problem.residual(x, {**local.values, name: value + t * rate}))
        return total / h**2

    p0, p1 = kernel.T
    b00, b11 = along(p0), along(p1)
    b01 = 0.25 * (along(p0 + p1) - along(p0 - p1))
    discriminant = b01 * b01 - b00 * b11
    size = max(abs(b00), abs(b01), abs(b11), 1e-300)
    if discriminant < -1e-6 * size * size:
        return Crossing((), "isola centre")
    root = np.sqrt(max(discriminant, 0.0))
    if abs(b00) > abs(b11):
        pairs = [((-b01 + s * root) / b00, 1.0) for s in (1.0, -1.0)]
    else:
        pairs = [(1.0, (-b01 + s * root) / b11) for s in (1.0, -1.0)] if b11 else [(1.0, 0.0), (0.0, 1.0)]
    tangents = sorted((_upwards(a * p0 + b * p1) for a, b in pairs), key=_steepness)
    return Crossing(tuple(tangents), "pitchfork" if any(_flat(t) for t in tangents) else "transcritical")


def _flat(tangent: Array) -> bool:
    """Whether the parameter does not move along a tangent."""
    return bool(abs(tangent[-1]) < 1e-4)


def _upwards(direction: Array) -> Array:
    """Return a unit tangent along which the parameter grows; a flat one in the sense of its largest component."""
    unit: Array = direction / np.linalg.norm(direction)
    return oriented(unit) if _flat(unit) else math.copysign(1.0, unit[-1]) * unit


def _steepness(tangent: Array) -> list[float]:
    """Return what orders tangents: that along which the parameter moves most comes first. Rounded: it is no choice."""
    order: list[float] = np.round(-np.append(tangent[-1], tangent), 3).tolist()
    return order


