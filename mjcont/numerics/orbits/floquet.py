"""Floquet multipliers: how deviations from an orbit grow over a period.

Interval i takes a deviation s_i to s_{i+1} = A_i s_i. The product of the A_i would lose what is small; instead the
relations -A_i s_i + s_{i+1} = 0 are condensed to one, L s_0 + R s_N = 0, by orthogonal transformations, and the
multipliers are the eigenvalues of the pencil (-L, R). Source: Fairgrieve and Jepson, O.K. Floquet multipliers (SIAM J.
Numer. Anal. 28, 1991). The multiplier 1 of a free period is deflated with its vector, the velocity.

Multipliers of modes that turn or decay too fast for the mesh are told from the derivatives of the rates (`fast`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eig, qr

from mjcont.numerics.equations.algebra import inverses
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.collocation import Blocks, Orbits
from mjcont.numerics.orbits.fast import fast_modes


@dataclass(frozen=True, slots=True)
class Multipliers:
    """The multipliers of an orbit.

    Attributes
    ----------
    values : (d,) complex, the largest first.
    resolved : (d,) bool, whether they are those of the collocation; the others are adiabatic.
    trivial : index of the multiplier 1 of a free period, -1 where there is none.
    times : how often it is there, one after the other: twice where the motion keeps an energy.
    """

    values: Array
    resolved: Array
    trivial: int
    times: int = 1

    @property
    def own(self) -> Array:
        """Those that say whether the orbit is stable: without the trivial one."""
        found: Array = self.values[self._others]
        return found

    @property
    def _others(self) -> Array:
        at = np.arange(len(self.values))
        found: Array = (at < self.trivial) | (at >= self.trivial + self.times) if self.trivial >= 0 else at >= 0
        return found

    @property
    def tested(self) -> Array:
        """The resolved ones among these: special points are told by them."""
        found: Array = self.values[self.resolved & self._others]
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
    fast = fast_modes(orbits, blocks, period)
    scale, own = orbits.sizes, velocity if orbits.own_period else None
    values, vectors, trivial = _spectrum(matrices, scale, own)
    known = [] if trivial is None else [trivial]
    if fast is None or fast.count > len(values):  # of all modes none can be told apart from the velocity
        every, resolved = [known, values], np.ones(d, dtype=bool)
    else:
        slow = values[fast.least(vectors, len(values) - fast.count)]
        if fast.steps is None:
            quick = fast.adiabatic
        else:
            every_one, along, _ = _spectrum(fast.steps, scale, own)
            quick = every_one[fast.most(along, fast.count)]
        every = [known, slow, quick]
        resolved = np.arange(d) < d - (fast.count if fast.steps is None else 0)
    together = np.concatenate([np.asarray(part, dtype=complex) for part in every])
    order = np.argsort(-np.abs(together), kind="stable")
    return Multipliers(together[order], resolved[order], int(np.flatnonzero(order == 0)[0]) if known else -1)


def _spectrum(matrices: Array, scale: Array, velocity: Array | None) -> tuple[Array, Array, complex | None]:
    """Return the multipliers of deviations (N, d, d), their vectors, and the one of the velocity, deflated."""
    left, right = condensed(matrices * scale[None, None, :] / scale[None, :, None])
    basis, trivial = np.eye(len(scale)), None
    if velocity is not None:
        left, right, trivial, basis = _deflated(left, right, velocity / scale)
    values, vectors = eig(-left, right)
    return np.where(np.isfinite(values), values, complex(np.inf)), scale[:, None] * (basis @ vectors), trivial


def _deflated(left: Array, right: Array, velocity: Array) -> tuple[Array, Array, complex, Array]:
    """Return the pencil without the multiplier 1, that one as it is found, and the basis that is left."""
    z = qr(velocity[:, None])[0]
    image = right @ z[:, 0]
    trivial = complex(-(image @ (left @ z[:, 0])) / (image @ image))
    q = qr(image[:, None])[0]
    return q[:, 1:].T @ left @ z[:, 1:], q[:, 1:].T @ right @ z[:, 1:], trivial, z[:, 1:]
