"""Collocation points on an interval, and what follows from them: Gauss and Radau IIA as implicit Runge-Kutta methods.

With stage derivatives k_l the polynomial is u(theta) = u_0 + h sum_l B_l(theta) k_l, B_l the integral of Lagrange's
l-th polynomial from 0 to theta. Gauss is symplectic and of order 2 m; Radau IIA is stiffly accurate (its last point is
the interval's end, so that R(z) -> 0 for stiff modes) and of order 2 m - 1. Source: Hairer and Wanner, Solving Ordinary
Differential Equations II (Springer 1996), section IV.5.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.polynomial import legendre

from mjcont.numerics.equations.problem import Array

GAUSS, RADAU = "gauss", "radau"
SCHEMES = (GAUSS, RADAU)


@dataclass(frozen=True, slots=True, eq=False)
class Scheme:
    """A collocation method of m points on [0, 1].

    Attributes
    ----------
    name : "gauss" or "radau".
    c : (m,) the points.
    a : (m, m) B_l(c_j); `b` : (m,) B_l(1).
    aa, ba : a @ a and b @ a, what second-order equations need once velocities at the points are eliminated.
    coefficients : (m, m) from values at the points to Legendre coefficients.
    order : of the error at the ends of the intervals.
    """

    name: str
    c: Array
    a: Array
    b: Array
    aa: Array
    ba: Array
    coefficients: Array
    order: int

    @property
    def degree(self) -> int:
        """Number of points, and degree of the polynomials."""
        return len(self.c)

    def integrals(self, theta: Array) -> Array:
        """Return B_l(theta) for places theta (k,) in an interval, (k, m)."""
        m = self.degree
        whole = np.stack([legendre.legint(np.eye(m)[l], lbnd=-1) for l in range(m)])  # noqa: E741
        found: Array = 0.5 * legendre.legvander(2.0 * np.asarray(theta) - 1.0, m) @ whole.T @ self.coefficients
        return found


def _points(name: str, degree: int) -> Array:
    if name == GAUSS:
        return 0.5 * (1.0 + legendre.leggauss(degree)[0])
    found: Array = 0.5 * (1.0 + np.sort(legendre.legroots([0.0] * (degree - 1) + [-1.0, 1.0]).real))
    found[-1] = 1.0  # the end of the interval, exactly
    return found


@cache
def scheme(name: str, degree: int) -> Scheme:
    """Return the Gauss or Radau IIA method of a degree."""
    c = _points(name, degree)
    coefficients = np.linalg.inv(legendre.legvander(2.0 * c - 1.0, degree - 1))
    half = Scheme(name, c, np.zeros((0, 0)), c, c, c, coefficients, 0)
    a, b = half.integrals(c), half.integrals(np.ones(1))[0]
    order = 2 * degree - (name == RADAU)
    return Scheme(name, c, a, b, a @ a, b @ a, coefficients, order)
