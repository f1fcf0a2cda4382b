"""Derivatives of f along vectors at many points at once, as steps to take and sums of f there.

As `differences`, whose stencils these are, with a vector at each point. All arrays begin with the number of points, and
nothing is summed over it: what is found at a point does not depend, to the bit, on which others are beside it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.bordered import AS_LARGE
from mjcont.numerics.equations.differences import FAR_NODES, FIRST, NODES, SECOND, THIRD
from mjcont.numerics.equations.problem import Array

# steps in scaled unknowns: along a vector, along it and a coordinate, along a coordinate in a third derivative, and
# along a vector in a third derivative
_ALONG, _MIXED, _ASIDE, _FAR = 1e-2, 3e-4, 1e-3, 2e-2
_AROUND = NODES != 0.0  # the nodes but for the middle one
_MIDDLE = float(SECOND[~_AROUND][0])
_OUTER = THIRD != 0.0
_SIGNS = ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0))


def dot(a: Array, b: Array) -> Array:
    """Return the products of the last axes of two arrays."""
    found: Array = (a * b).sum(axis=-1)
    return found


def weighted(weights: Array, rows: Array) -> Array:
    """Return the sums of rows (K, m, ...) with weights (m,), one after the other, (K, ...)."""
    found: Array = weights[0] * rows[:, 0]
    for i in range(1, len(weights)):
        found += weights[i] * rows[:, i]
    return found


def orient(v: Array) -> Array:
    """Return vectors (K, n) of either sign turned as `bordered.oriented` turns one."""
    sizes = np.abs(v)
    first = np.argmax(sizes >= AS_LARGE * sizes.max(axis=1)[:, None], axis=1)
    found: Array = v * np.sign(v[np.arange(len(v)), first])[:, None]
    return found


def corrected(slopes: Array, exact: Array, u: Array) -> Array:
    """Return derivatives in every coordinate (K, ..., n) with that along u (K, n) as it is known, (K, ...)."""
    if slopes.ndim == 3:
        u = u[:, None]
    apart = exact - dot(slopes, u)
    found: Array = slopes + apart[..., None] * u / dot(u, u)[..., None]
    return found


@dataclass(frozen=True, slots=True)
class Directions:
    """Derivatives along vectors (K, n) in physical units; coordinates e_j are scaled by `scale` (n,)."""

    scale: Array

    def lengths(self, v: Array) -> Array:
        """Return the largest component of each vector in units of its coordinate's scale, 1 for a zero vector, (K,)."""
        found = (np.abs(v) / self.scale).max(axis=-1)
        return np.where(found == 0.0, 1.0, found)

    def _unit(self, v: Array, step: float = _ALONG) -> Array:
        found: Array = step / self.lengths(v)
        return found

    def along(self, v: Array) -> Array:
        """Return the steps for `slope` and `curvature`, (K, 6, n)."""
        found: Array = (self._unit(v)[:, None] * NODES[_AROUND])[:, :, None] * v[:, None]
        return found

    def slope(self, rows: Array, v: Array) -> Array:
        """Return f_x v, (K, n), of sixth order."""
        return weighted(FIRST[_AROUND], rows) / self._unit(v)[:, None]

    def curvature(self, f: Array, rows: Array, v: Array) -> Array:
        """Return B(v, v), (K, n), of sixth order."""
        found: Array = (weighted(SECOND[_AROUND], rows) + _MIDDLE * f) / (self._unit(v) ** 2)[:, None]
        return found

    def far(self, v: Array) -> Array:
        """Return the steps for `thrice`, (K, 8, n)."""
        found: Array = (self._unit(v, _FAR)[:, None] * FAR_NODES[_OUTER])[:, :, None] * v[:, None]
        return found

    def thrice(self, rows: Array, v: Array) -> Array:
        """Return f_xxx(v, v, v), (K, n), of sixth order."""
        found: Array = weighted(THIRD[_OUTER], rows) / (self._unit(v, _FAR) ** 3)[:, None]
        return found

    def polar(self, u: Array, v: Array) -> tuple[Array, Array]:
        """Return the steps for `polarized`, (K, 6, n) each."""
        one, other = (a / self.lengths(a)[:, None] for a in (u, v))
        return self.along(one + other), self.along(one - other)

    def polarized(self, f: Array, rows: tuple[Array, Array], u: Array, v: Array) -> Array:
        """Return B(u, v), (K, n), of sixth order."""
        sizes = self.lengths(u)[:, None], self.lengths(v)[:, None]
        one, other = u / sizes[0], v / sizes[1]
        apart = self.curvature(f, rows[0], one + other) - self.curvature(f, rows[1], one - other)
        found: Array = 0.25 * apart * sizes[0] * sizes[1]
        return found

    def mixed(self, u: Array) -> Array:
        """Return the steps for `form`, (K, 4 n, n)."""
        ahead, e = self._unit(u, _MIXED)[:, None, None] * u[:, None], _MIXED * np.diag(self.scale)
        return np.concatenate([s * e + t * ahead for s, t in _SIGNS], axis=1)

    def form(self, rows: Array, u: Array, exact: Array | None = None) -> Array:
        """Return B(u, e_j), (K, n, n), of second order; along u as B(u, u) is known, where it is."""
        pp, pm, mp, mm = np.split(rows, 4, axis=1)
        found: Array = (pp - pm - mp + mm) / (4.0 * _MIXED * self._unit(u, _MIXED))[:, None, None]
        if exact is None:
            return found
        found = corrected(found.transpose(0, 2, 1), exact, u / self.scale).transpose(0, 2, 1)
        return found

    def aside(self, v: Array) -> Array:
        """Return the steps for `third`, (K, 14 n, n): seven along v, beside each coordinate on both sides."""
        along = (self._unit(v)[:, None] * NODES)[:, :, None] * v[:, None]
        e = _ASIDE * np.diag(self.scale)
        steps = np.stack([e, -e])[None, :, :, None] + along[:, None, None]
        found: Array = steps.reshape(len(v), 2 * len(e) * len(NODES), len(e))
        return found

    def third(self, rows: Array, v: Array) -> Array:
        """Return f_xxx(v, v, e_j), (K, n, n), of second order in the coordinates."""
        n = len(self.scale)
        ahead, back = rows.reshape(len(v), 2, n, len(NODES), n).transpose(1, 0, 3, 2, 4)
        found: Array = weighted(SECOND, ahead - back) / (2.0 * _ASIDE * self._unit(v) ** 2)[:, None, None]
        return found
