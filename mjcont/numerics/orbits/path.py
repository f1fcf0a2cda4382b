"""An orbit as polynomials on the intervals of its mesh: states and rates anywhere, means over a period."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.scheme import Scheme


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """One period of an orbit.

    Attributes
    ----------
    scheme : Scheme
    order : 1 for u' = f, 2 for q'' = a, where states are (q, v).
    mesh : (N + 1,) from 0 to 1.
    s : (N + 1, d) states at the mesh.
    w : (N, m, c) rates at the points times h^order, h the length of the interval in time.
    period : in s.
    """

    scheme: Scheme
    order: int
    mesh: Array
    s: Array
    w: Array
    period: float

    @property
    def lengths(self) -> Array:
        """Lengths of the intervals, parts of the period, (N,)."""
        return np.diff(self.mesh)

    @property
    def c(self) -> int:
        """Number of coordinates."""
        return int(self.w.shape[2])

    @property
    def points(self) -> Array:
        """Places of the collocation points, (N m,)."""
        found: Array = (self.mesh[:-1, None] + self.lengths[:, None] * self.scheme.c).ravel()
        return found

    @property
    def weights(self) -> Array:
        """Weights of the points in a mean over the period, (N m,)."""
        found: Array = (self.lengths[:, None] * self.scheme.b).ravel()
        return found

    def _places(self, tau: Array) -> tuple[Array, Array, Array]:
        i = np.clip(np.searchsorted(self.mesh, tau, side="right") - 1, 0, len(self.w) - 1)
        lengths = self.lengths[i]
        return i, (tau - self.mesh[i]) / lengths, (self.period * lengths)[:, None]

    def states(self, tau: Array) -> Array:
        """Return the states at places tau (k,) in the period, (k, d)."""
        i, theta, h = self._places(tau)
        b, s, w, c = self.scheme.integrals(theta), self.s[i], self.w[i], self.c
        moved: Array = np.einsum("kl,klc->kc", b, w)
        if self.order == 1:
            return s + moved
        q = s[:, :c] + theta[:, None] * h * s[:, c:] + np.einsum("kl,klc->kc", b @ self.scheme.a, w)
        return np.hstack([q, s[:, c:] + moved / h])

    def rates(self, tau: Array) -> Array:
        """Return the highest derivatives in time at places tau (k,), (k, c)."""
        i, theta, h = self._places(tau)
        values = legvander(2.0 * theta - 1.0, self.scheme.degree - 1) @ self.scheme.coefficients
        found: Array = np.einsum("kl,klc->kc", values, self.w[i]) / h**self.order
        return found

    def slopes(self, tau: Array) -> Array:
        """Return the derivatives of the states in tau at places tau (k,), (k, d)."""
        rates = self.rates(tau)
        if self.order == 1:
            return self.period * rates
        return self.period * np.hstack([self.states(tau)[:, self.c :], rates])

    def carried(self, mesh: Array) -> Path:
        """Return the orbit on another mesh, by interpolation."""
        lengths = np.diff(mesh)
        points = (mesh[:-1, None] + lengths[:, None] * self.scheme.c).ravel()
        h = (self.period * lengths)[:, None, None] ** self.order
        w = h * self.rates(points).reshape(len(lengths), self.scheme.degree, self.c)
        return Path(self.scheme, self.order, mesh, self.states(mesh), w, self.period)

    def repeated(self, shift: Array, factors: Sequence[complex] = (1.0, 1.0)) -> Path:
        """Return the orbit several times over, as one of so many periods; `shift` (d,) is what it gains in one.

        A deviation may have a factor of its own in each, such as -1 where it changes its sign over a period.
        """
        times = len(factors)
        mesh = np.concatenate([self.mesh[:1], *((j + self.mesh[1:]) / times for j in range(times))])
        s = np.concatenate([factors[0] * self.s[:1], *(f * self.s[1:] + j * shift for j, f in enumerate(factors))])
        w = np.concatenate([f * self.w for f in factors])
        return Path(self.scheme, self.order, mesh, s, w, times * self.period)
