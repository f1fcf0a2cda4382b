"""Fields whose loci are known in closed form."""

from __future__ import annotations

import mjcont as mc


def tilted_cusp():
    """x' = mu + la x + e x^2 - x^3: three equal roots r = e / 3 at la = -3 r^2, mu = r^3."""

    def f(u, p):
        return [p["mu"] + p["la"] * u[0] + p["e"] * u[0] ** 2 - u[0] ** 3]

    return mc.VectorField(f, [-1.2098], {"mu": -1.0, "la": 1.0, "e": 0.3}, names=["x"])


def conic(sign):
    """x' = x^2 + sign la^2 - mu: circles about an isola centre, or hyperbolas about a crossing, at the origin."""

    def f(u, p):
        return [u[0] ** 2 + sign * p["la"] ** 2 - p["mu"]]

    state, values = ([1.0], {"la": 0.0, "mu": 1.0}) if sign > 0 else ([1.4], {"la": 1.5, "mu": -0.3})
    return mc.VectorField(f, state, values, names=["x"])


def pitchfork():
    def f(u, p):
        return [(p["mu"] + p["k"]) * u[0] - u[0] ** 3 + p["e"]]

    return mc.VectorField(f, [0.0], {"mu": -1.0, "k": 0.0, "e": 0.0}, names=["x"])
