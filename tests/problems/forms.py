"""Normal forms seen through linear changes of coordinates, so that nothing is aligned with the axes."""

from __future__ import annotations

import numpy as np

import mjcont as mc

SPACE = np.array([[1.0, 0.5, 0.0], [-0.3, 1.0, 0.4], [0.2, -0.6, 1.0]])
SHIFT = np.array([0.7, -0.4, 0.2])


def seen_through(matrix, g, parameters, z0):
    """Return u' = f(u) for z' = g(z) with u = shift + matrix z."""
    shift, back = SHIFT[: len(matrix)], np.linalg.inv(matrix)

    def f(u, p):
        return matrix @ np.asarray(g(back @ (u - shift), p))

    return mc.VectorField(f, shift + matrix @ np.asarray(z0, dtype=float), parameters)


def oscillator(cubic, omega, slaved=0.0):
    """Return z1 + i z2 with growth mu + cubic |z|^2; z3 relaxes to |z|^2 and adds `slaved` of itself to the growth."""

    def g(z, p):
        r2 = z[0] ** 2 + z[1] ** 2
        growth = p["mu"] + cubic * r2 + slaved * z[2]
        return [growth * z[0] - omega * z[1], omega * z[0] + growth * z[1], -z[2] + r2]

    return g
