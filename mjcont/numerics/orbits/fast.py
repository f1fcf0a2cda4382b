"""Modes that turn or decay too fast for an orbit's mesh: their multipliers from the derivatives along the orbit.

Where |lambda| h exceeds about 3 collocation tells nothing of a mode: Gauss puts it on the unit circle, Radau IIA at
zero. But the derivatives J(t) of the rates are smooth along the orbit, which is slow, and known at its points. As long
as there are not too many turns the deviations are integrated by steps of their own, s(t + h) = exp(Omega) s(t), with
Magnus's series for J at Gauss's three points of the step,

    Omega = a_1 + a_3 / 12 + [-20 a_1 - a_3 + c_1, a_2 + c_2] / 240,
    c_1 = [a_1, a_2],   c_2 = -[a_1, 2 a_3 + c_1] / 60,
    a_1 = h J_2,   a_2 = sqrt(15) h (J_3 - J_1) / 3,   a_3 = 10 h (J_3 - 2 J_2 + J_1) / 3,

which is of sixth order in how J changes and exact where it does not (Blanes, Casas and Ros, Improved high order
integrators based on the Magnus expansion, BIT 40, 2000). Modes with more turns than that follow their eigenvalue,

    mu = exp(integral of lambda(t) over a period),

and count as not resolved.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander
from scipy.linalg import eig

from mjcont.numerics.equations.algebra import eigenvalues as eigenvalues_of
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.collocation import Blocks, Orbits
from mjcont.numerics.orbits.scheme import GAUSS, RADAU

# |lambda| h from which on a scheme of degree 5 errs by 1e-6 in a period, and the part of it that is to be exceeded all
# along the orbit; factor between the sizes of fast and slow modes
_FAST = {RADAU: 1.0, GAUSS: 3.0}
_EVERYWHERE, _GAP = 0.3, 1.3
# |lambda| h of a step of its own, how many of these are taken in all, and how many are multiplied at once
_STEP, _MOST = 2.0, 1500
_TOGETHER = 4
_ROOT = np.sqrt(15.0)


@dataclass(frozen=True, slots=True)
class FastModes:
    """The fast modes of an orbit.

    Attributes
    ----------
    count : how many.
    space : (d, count) an orthonormal basis of theirs at the beginning, over scaled states.
    scale : (d,) the states' sizes.
    steps : (k, d, d) what takes deviations over short steps, one after the other; None where they would be too many.
    adiabatic : (count,) multipliers from eigenvalues; empty where there are steps.
    """

    count: int
    space: Array
    scale: Array
    steps: Array | None
    adiabatic: Array

    def _shares(self, vectors: Array) -> Array:
        scaled = vectors / self.scale[:, None]
        found: Array = np.linalg.norm(self.space.T @ scaled, axis=0) / np.linalg.norm(scaled, axis=0)
        return found

    def least(self, vectors: Array, count: int) -> Array:
        """Return the indices of the `count` vectors (d, n) that lie least in the fast space."""
        return np.sort(np.argsort(self._shares(vectors), kind="stable")[:count])

    def most(self, vectors: Array, count: int) -> Array:
        """Return the indices of the `count` vectors (d, n) that lie most in the fast space."""
        return np.sort(np.argsort(-self._shares(vectors), kind="stable")[:count])


def fast_modes(orbits: Orbits, blocks: Blocks, period: float) -> FastModes | None:
    """Return the modes that are too fast for an orbit's mesh, None where there are none."""
    lengths = period * orbits.lengths
    bound = _FAST[orbits.scheme.name]
    if _bound(blocks.jac, orbits.flow.c) * float(lengths.max()) < bound:
        return None
    middle = orbits.m // 2  # one point of each interval tells how many modes are fast, and how fast
    rates = _rates(blocks.jac[:, middle : middle + 1])
    if not np.isfinite(rates).all():
        return None
    sizes = np.abs(rates)
    turns = float((lengths * sizes[:, 0]).sum())
    unresolved = int((sizes * lengths[:, None] > bound).any(axis=0).sum())
    if not unresolved:
        return None
    few = turns / _STEP <= _MOST
    count = _count(sizes, unresolved, few, bound / float(lengths.min()))
    if not count:
        return None
    space = _space(first_order_each(blocks.jac[:1, :1])[0], count, orbits.sizes)
    if few:
        return FastModes(count, space, orbits.sizes, _magnus(orbits, blocks.jac, lengths, sizes[:, 0]), np.zeros(0))
    every = _rates(blocks.jac)[:, :count]
    return FastModes(count, space, orbits.sizes, None, _adiabatic(orbits, every, period))


def _rates(jac: Array) -> Array:
    """Return the eigenvalues at points, the largest first, from derivatives of the rates (N, m, c, d): (N m, d)."""
    rates = eigenvalues_of(first_order_each(jac))
    return np.take_along_axis(rates, np.argsort(-np.abs(rates), axis=1, kind="stable"), axis=1)


def _count(sizes: Array, unresolved: int, few: bool, bound: float) -> int:
    """Return how many modes are told apart as fast, given their sizes along the orbit (k, d), the largest first.

    None are where a mode is fast here and slow there: the orbit itself is as fast then, and its mesh made for it.
    """
    d, least, most = sizes.shape[1], sizes.min(axis=0), sizes.max(axis=0)
    apart = [k for k in range(1, d + 1) if k == d or least[k - 1] > _GAP * most[k]]
    if few:
        return next(k for k in apart if k >= unresolved) if least[unresolved - 1] > _EVERYWHERE * bound else 0
    return max((k for k in apart if least[k - 1] > bound), default=0)


def _bound(jac: Array, c: int) -> float:
    """Return a bound of the eigenvalues along an orbit from the derivatives of its rates (N, m, c, d)."""
    if jac.shape[3] == c:
        return float(np.abs(jac).sum(axis=3).max())
    stiffness, damping = (float(np.abs(part).sum(axis=3).max()) for part in (jac[..., :c], jac[..., c:]))
    return math.sqrt(stiffness) + damping


def first_order_each(jac: Array) -> Array:
    """Return the matrices of the first-order form at all points, (N m, d, d)."""
    c, d = jac.shape[2:]
    matrices = jac.reshape(-1, c, d)
    if d == c:
        return matrices
    upper = np.zeros((len(matrices), c, d))
    upper[:, :, c:] = np.eye(c)
    return np.concatenate([upper, matrices], axis=1)


def _magnus(orbits: Orbits, jac: Array, lengths: Array, fastest: Array) -> Array:
    """Return what takes deviations over short steps, (k, d, d); intervals have lengths and largest |lambda| (N,)."""
    n, m, c, d = jac.shape
    nodes, known = orbits.scheme.c, jac.reshape(n, m, c * d)
    if nodes[-1] == 1.0:  # the end of the interval before is the beginning of this one
        nodes = np.append(0.0, nodes)
        known = np.concatenate([np.roll(known[:, -1:], 1, axis=0), known], axis=1)
    counts = np.ceil(lengths * fastest / _STEP).astype(int)
    steps = 1.0 / np.repeat(counts, counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    middles = (np.arange(counts.sum()) - first + 0.5) * steps
    places = middles[:, None] + steps[:, None] * np.array([-0.1 * _ROOT, 0.0, 0.1 * _ROOT])
    last = len(nodes) - 1
    weights = legvander(2.0 * places - 1.0, last) @ np.linalg.inv(legvander(2.0 * nodes - 1.0, last))
    at = (weights @ np.repeat(known, counts, axis=0)).reshape(-1, 3, c, d)
    h = (np.repeat(lengths, counts) * steps)[:, None, None]
    unit = np.ones(d)  # velocities as large as positions, so that norms are as small as they can be
    unit[c:] = max(float(fastest.max()), 1e-300)
    before, here, after = (first_order_each(at[:, k : k + 1]) * unit / unit[:, None] for k in range(3))
    found: Array = _joined(exponentials(_series(h, before, here, after))) * unit[:, None] / unit
    return found


def _joined(steps: Array) -> Array:
    """Return the products of four steps each: in so few nothing that is small is lost."""
    short = -len(steps) % _TOGETHER
    padded = np.concatenate([steps, np.broadcast_to(np.eye(steps.shape[1]), (short, *steps.shape[1:]))])
    first, *others = (padded[k::_TOGETHER] for k in range(_TOGETHER))
    for other in others:
        first = other @ first
    return first


def _series(h: Array, before: Array, here: Array, after: Array) -> Array:
    """Return Omega of steps h (k, 1, 1), given J at Gauss's points of each (k, d, d)."""
    one, two, three = h * here, _ROOT / 3.0 * h * (after - before), 10.0 / 3.0 * h * (after - 2.0 * here + before)
    first = _commutator(one, two)
    second = -_commutator(one, 2.0 * three + first) / 60.0
    found: Array = one + three / 12.0 + _commutator(-20.0 * one - three + first, two + second) / 240.0
    return found


def _commutator(a: Array, b: Array) -> Array:
    found: Array = a @ b - b @ a
    return found


def exponentials(matrices: Array) -> Array:
    """Return the exponentials of matrices (k, d, d), by the Pade approximant of degree 6 of halves of them, squared.

    They are NaN where one of them is not finite.
    """
    if not np.isfinite(matrices).all():
        return np.full_like(matrices, np.nan)
    norms = np.abs(matrices).sum(axis=1).max(axis=1)
    halvings = max(int(np.ceil(np.log2(max(float(norms.max()), 1e-300) / 0.5))), 0)
    a, eye = matrices / 2.0**halvings, np.eye(matrices.shape[1])
    even, odd, power, weight = np.zeros_like(a), np.zeros_like(a), np.broadcast_to(eye, a.shape), 1.0
    for k in range(7):
        if k:
            power, weight = power @ a, weight * (7 - k) / (k * (13 - k))
        if k % 2:
            odd = odd + weight * power
        else:
            even = even + weight * power
    found: Array = np.linalg.solve(even - odd, even + odd)
    for _ in range(halvings):
        found = found @ found
    return found


def _adiabatic(orbits: Orbits, rates: Array, period: float) -> Array:
    """Return exp of the integrals of the fast eigenvalues (N m, k), followed along the orbit."""
    weights = (orbits.lengths[:, None] * orbits.scheme.b).ravel()
    by_size = np.take_along_axis(rates, np.lexsort((rates.imag, np.abs(rates))), axis=1)
    found: Array = np.exp(period * (weights @ by_size))
    return found


def _space(matrix: Array, count: int, scale: Array) -> Array:
    """Return an orthonormal basis of the space of the `count` fastest modes of a matrix (d, d), over scaled states."""
    values, vectors = eig(matrix / scale[:, None] * scale)
    chosen = vectors[:, np.argsort(-np.abs(values), kind="stable")[:count]]
    found: Array = np.linalg.svd(np.hstack([chosen.real, chosen.imag]), full_matrices=False)[0][:, :count]
    return found
