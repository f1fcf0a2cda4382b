"""Fields whose branches cross in known points."""

from __future__ import annotations

import mjcont as mc


def pitchfork():
    return mc.VectorField(lambda u, p: [p["mu"] * u[0] - u[0] ** 3], [0.0], {"mu": -1.0}, names=["x"])


def transcritical():
    return mc.VectorField(lambda u, p: [p["mu"] * u[0] - u[0] ** 2], [0.0], {"mu": -1.0}, names=["x"])


HEIGHT = 0.3


def circle_and_line():
    """The unit circle, crossed by the line x = 0.3 at mu = -WIDTH and WIDTH."""

    def f(u, p):
        return [-(u[0] ** 2 + p["mu"] ** 2 - 1.0) * (u[0] - HEIGHT)]

    return mc.VectorField(f, [HEIGHT], {"mu": -1.5}, names=["x"])


def circle_and_two_lines():
    """The unit circle, crossed by x = 0.3 and x = mu / 2, which cross each other at mu = 0.6."""

    def f(u, p):
        return [-(u[0] ** 2 + p["mu"] ** 2 - 1.0) * (u[0] - HEIGHT) * (u[0] - 0.5 * p["mu"])]

    return mc.VectorField(f, [HEIGHT], {"mu": -1.5}, names=["x"])


def two_modes():
    """Two modes that buckle at mu = 1 and 2, the first again at mu = 3, where x = +-sqrt(2): five branches."""

    def f(u, p):
        x, y = u
        return [
            (p["mu"] - 1.0) * x - x**3 - 0.5 * x * y**2,
            (p["mu"] - 2.0) * y - y**3 - 0.5 * y * x**2,
        ]

    return mc.VectorField(f, [0.0, 0.0], {"mu": 0.0}, names=["x", "y"])
