"""Floquet multipliers: how deviations from an orbit grow over a period.

Interval i takes a deviation s_i to s_{i+1} = A_i s_i. The product of the A_i would lose what is small; instead the
relations -A_i s_i + s_{i+1} = 0 are condensed to one, L s_0 + R s_N = 0, by orthogonal transformations, and the
multipliers are the eigenvalues of the pencil (-L, R). Source: Fairgrieve and Jepson, O.K. Floquet multipliers (SIAM J.
Numer. Anal. 28, 1991). The multiplier 1 of a free period is deflated with its vector, the velocity.

Radau IIA damps modes with |lambda| h beyond about 3, whatever they do. Such modes follow their eigenvalue
adiabatically,

    mu = exp(integral of lambda(t) over a period),

which is told from the derivatives of the rates along the orbit; they count as not resolved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eig, qr

from mjcont.numerics.equations.algebra import eigenvalues as eigenvalues_of
from mjcont.numerics.equations.algebra import inverses
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.collocation import Blocks, Orbits

# |lambda| h from which on a mode is not resolved, at every point of the orbit; factor to the next slower mode
_FAST, _GAP = 3.0, 1.5


@dataclass(frozen=True, slots=True)
class Multipliers:
    """The multipliers of an orbit.

    Attributes
    ----------
    values : (d,) complex, the largest first.
    resolved : (d,) bool, whether they are those of the collocation; the others are adiabatic.
    trivial : index of the multiplier 1 of a free period, -1 where there is none.
    """

    values: Array
    resolved: Array
    trivial: int

    @property
    def own(self) -> Array:
        """Those that say whether the orbit is stable: without the trivial one."""
        found: Array = self.values[np.arange(len(self.values)) != self.trivial]
        return found

    @property
    def tested(self) -> Array:
        """The resolved ones among these: special points are told by them."""
        keep = self.resolved & (np.arange(len(self.values)) != self.trivial)
        found: Array = self.values[keep]
        return found


def transfers(blocks: Blocks) -> Array:
    """Return the matrices A_i that take a deviation over each interval, (N, d, d)."""
    found: Array = blocks.end_s - blocks.end_w @ (inverses(blocks.over_w) @ blocks.over_s)
    return found


def condensed(matrices: Array) -> tuple[Array, Array]:
    """Return L, R (d, d) with L s_0 + R s_N = 0 for s_{i+1} = A_i s_i."""
    d = matrices.shape[1]
    left, right = -matrices, np.broadcast_to(np.eye(d), matrices.shape)
    while len(left) > 1:
        pairs = len(left) // 2
        rest = slice(2 * pairs, None)
        l0, r0, l1, r1 = (a[k : 2 * pairs : 2] for k in (0, 1) for a in (left, right))
        q = np.linalg.qr(np.concatenate([r0, l1], axis=1), mode="complete")[0][:, :, d:].transpose(0, 2, 1)
        left = np.concatenate([q[:, :, :d] @ l0, left[rest]])
        right = np.concatenate([q[:, :, d:] @ r1, right[rest]])
    return left[0], right[0]


def multipliers(orbits: Orbits, blocks: Blocks, period: float, velocity: Array) -> Multipliers:
    """Return the multipliers of an orbit; `velocity` (d,) is u' at its beginning."""
    matrices = transfers(blocks)
    d = orbits.flow.d
    if not np.isfinite(matrices).all():
        return Multipliers(np.full(d, complex(np.nan, np.nan)), np.ones(d, dtype=bool), -1)
    scale = orbits.sizes
    left, right = condensed(matrices * scale[None, None, :] / scale[None, :, None])
    fast, space = _fast(orbits, blocks, period)
    known: list[complex] = []
    if orbits.own_period:
        left, right, trivial, basis = _deflated(left, right, velocity / scale)
        known.append(trivial)
    else:
        basis = np.eye(d)
    values, vectors = eig(-left, right)
    values = np.where(np.isfinite(values), values, complex(np.inf))
    keep = _slow(basis @ vectors, space, len(fast))
    every = np.concatenate([known, values[keep], fast])
    resolved = np.arange(len(every)) < len(every) - len(fast)
    order = np.argsort(-np.abs(every), kind="stable")
    trivial_at = int(np.flatnonzero(order == 0)[0]) if known else -1
    return Multipliers(every[order], resolved[order], trivial_at)


def _deflated(left: Array, right: Array, velocity: Array) -> tuple[Array, Array, complex, Array]:
    """Return the pencil without the multiplier 1, that one as it is found, and the basis that is left."""
    z = qr(velocity[:, None])[0]
    image = right @ z[:, 0]
    trivial = complex(-(image @ (left @ z[:, 0])) / (image @ image))
    q = qr(image[:, None])[0]
    return q[:, 1:].T @ left @ z[:, 1:], q[:, 1:].T @ right @ z[:, 1:], trivial, z[:, 1:]


def _fast(orbits: Orbits, blocks: Blocks, period: float) -> tuple[Array, Array]:
    """Return the adiabatic multipliers of modes that are not resolved, and their space at the beginning (d, k)."""
    c, d = orbits.flow.c, orbits.flow.d
    nothing = np.zeros(0, dtype=complex), np.zeros((d, 0))
    if orbits.scheme.name != "radau":
        return nothing
    step = period * float(orbits.lengths.min())
    jac = blocks.jac
    bound = np.abs(jac[..., :c]).sum(axis=3).max() ** 0.5 + np.abs(jac[..., c:]).sum(axis=3).max() if d > c else (
        np.abs(jac).sum(axis=3).max())
    if bound * period * float(orbits.lengths.max()) < _FAST:
        return nothing
    matrices = jac.reshape(-1, c, d)
    if d > c:
        upper = np.zeros((len(matrices), c, d))
        upper[:, :, c:] = np.eye(c)
        matrices = np.concatenate([upper, matrices], axis=1)
    found = eigenvalues_of(matrices)
    if not np.isfinite(found).all():
        return nothing
    order = np.argsort(-np.abs(found), axis=1, kind="stable")
    found = np.take_along_axis(found, order, axis=1)
    sizes = np.abs(found)
    least, most = sizes.min(axis=0), sizes.max(axis=0)
    counts = [k for k in range(1, d + 1) if least[k - 1] * step > _FAST and (k == d or least[k - 1] > _GAP * most[k])]
    if not counts:
        return nothing
    k = max(counts)
    return _adiabatic(orbits, found[:, :k], period), _fast_space(matrices[0], k)


def _adiabatic(orbits: Orbits, rates: Array, period: float) -> Array:
    """Return exp of the integrals of the fast eigenvalues (N m, k), followed along the orbit."""
    weights = (orbits.lengths[:, None] * orbits.scheme.b).ravel()
    by_size = np.take_along_axis(rates, np.lexsort((rates.imag, np.abs(rates))), axis=1)
    decay = weights @ by_size.real
    turning = weights @ by_size.imag
    found: Array = np.exp(period * (decay + 1j * turning))
    return found


def _fast_space(matrix: Array, count: int) -> Array:
    """Return an orthonormal basis of the space of the `count` fastest modes, (d, count)."""
    values, vectors = eig(matrix)
    chosen = vectors[:, np.argsort(-np.abs(values), kind="stable")[:count]]
    found: Array = np.linalg.svd(np.hstack([chosen.real, chosen.imag]), full_matrices=False)[0][:, :count]
    return found


def _slow(vectors: Array, space: Array, count: int) -> Array:
    """Return the indices of the eigenvectors that lie least in the fast space, all but `count`."""
    if not count:
        return np.arange(vectors.shape[1])
    share = np.linalg.norm(space.T @ vectors, axis=0) / np.linalg.norm(vectors, axis=0)
    return np.sort(np.argsort(share, kind="stable")[: vectors.shape[1] - count])
