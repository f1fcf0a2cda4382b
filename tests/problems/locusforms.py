"""Normal forms of points on loci, with their coefficients."""

from __future__ import annotations

import math

import numpy as np

import mjcont as mc

SPACE = np.array([[1.0, 0.5, 0.0], [-0.3, 1.0, 0.4], [0.2, -0.6, 1.0]])
SHIFT = np.array([0.7, -0.4, 0.2])
OMEGA = 2.0


def zero_hopf(s, a, c):
    """x' = b1 + x^2 + s r^2, growth of the oscillation b2 + a x - c r^2, seen through a linear change of coordinates.

    Folds at b1 = 0; Hopf points at x = -b2 / a, b1 = -x^2, where l1 is in proportion to -a s / (2 x) - c: it has a
    pole at the zero-Hopf point b1 = b2 = 0 and vanishes at x = -a s / (2 c).
    """
    back = np.linalg.inv(SPACE)

    def f(u, p):
        x, y, z = back @ (u - SHIFT)
        r2 = y * y + z * z
        growth = p["b2"] + a * x - c * r2
        return SPACE @ [p["b1"] + x * x + s * r2, growth * y - OMEGA * z, OMEGA * y + growth * z]

    return mc.VectorField(f, SHIFT + SPACE @ [-1.0, 0.0, 0.0], {"b1": -1.0, "b2": 0.3})


FORMS = [(1.0, 1.0, 0.0), (-1.0, 2.0, -2.0)]
HYPERSPACE = np.array([[1.2, 0.3, 0.1, -0.5], [0.4, 1.2, 0.2, 0.2], [0.1, 0.1, 1.0, 0.2], [-0.3, -0.1, -0.2, 1.2]])
FREQUENCIES = (1.0, math.sqrt(7.0))


def double_hopf():
    """Two oscillations with growth mu - nu^2 and mu + nu - 1 about an equilibrium that moves with mu."""
    back, way = np.linalg.inv(HYPERSPACE), np.array([0.3, -0.2, 0.5, 0.1])

    def f(u, p):
        z = back @ (u - p["mu"] * way)
        r1, r2 = z[0] ** 2 + z[1] ** 2, z[2] ** 2 + z[3] ** 2
        g1 = p["mu"] - p["nu"] ** 2 - r1 - 0.5 * r2
        g2 = p["mu"] + p["nu"] - 1.0 - 0.3 * r1 - r2
        (o1, o2) = FREQUENCIES
        return HYPERSPACE @ [g1 * z[0] - o1 * z[1], o1 * z[0] + g1 * z[1], g2 * z[2] - o2 * z[3], o2 * z[2] + g2 * z[3]]

    return mc.VectorField(f, np.zeros(4), {"mu": 0.0, "nu": 0.2})
