"""Fields whose periodic orbits, multipliers and special points are in closed form, seen through other coordinates.

In the coordinates v of a normal form the orbit is a circle z = r exp(i t), or rest under forcing of period 2 pi; what
happens across it is a normal form of its own. Where the plane of deviations turns by half a turn in a period, a
deviation xi comes back as -xi: multipliers are then negative. The fields are those of u = N(A v): A is a matrix that
nothing is aligned with, N bends one coordinate after the other, and so periods, multipliers and special points stay.
"""

from __future__ import annotations

import math
from operator import mul

import numpy as np

import mjcont as mc

_BENT = 0.1


class Seen:
    """Other coordinates: u_0 = w_0, u_i = w_i + 0.1 w_{i-1}^2, w = A v."""

    def __init__(self, n, seed):
        rng = np.random.default_rng(seed)
        q, _ = np.linalg.qr(rng.normal(size=(n, n)))
        self.matrix = q @ np.diag(np.linspace(0.7, 1.4, n)) + 0.05 * rng.normal(size=(n, n))
        self.inverse = np.linalg.inv(self.matrix)

    def bent(self, v):
        w = self.matrix @ v
        u = w.copy()
        u[1:] += _BENT * w[:-1] ** 2
        return u

    def field(self, g):
        """Return u' of v' = g(v, p, t)."""
        there, back, later = self.matrix.tolist(), self.inverse.tolist(), range(1, len(self.matrix))

        def f(u, p, t):
            w = list(u)
            for i in later:
                w[i] = u[i] - _BENT * w[i - 1] ** 2
            v = [sum(map(mul, row, w)) for row in back]
            g_v = g(v, p, t)
            rates = [sum(map(mul, row, g_v)) for row in there]
            bent = rates[:1]
            for i in later:
                bent.append(rates[i] + 2.0 * _BENT * w[i - 1] * rates[i - 1])
            return bent

        return f


def _turned(angle, a, b):
    c, s = math.cos(angle), math.sin(angle)
    return c * a - s * b, s * a + c * b


def around(g, n, parameters, start, seed=1, forced=False, turn=0.0):
    """Return the field with v' = g beside a circle of period 2 pi, or under forcing of that period.

    `g(y, p)` are the rates of the n deviations y; the first two turn by `turn` times the angle of the circle.
    """
    seen = Seen(n if forced else n + 2, seed)

    def deviations(y, p, angle):
        inner = list(y)
        if turn:
            inner[:2] = _turned(-turn * angle, *y[:2])
        rates = list(g(inner, p))
        if turn:
            a, b = _turned(turn * angle, *rates[:2])
            rates[:2] = a - turn * y[1], b + turn * y[0]
        return rates

    def whole(v, p, t):
        if forced:
            return deviations(v, p, t)
        z, r2 = v[:2], v[0] ** 2 + v[1] ** 2
        return [(1.0 - r2) * z[0] - z[1], (1.0 - r2) * z[1] + z[0], *deviations(v[2:], p, math.atan2(z[1], z[0]))]

    at = np.array(start if forced else [1.0, 0.0, *start], dtype=float)
    period = (lambda p: 2.0 * math.pi) if forced else None
    return mc.VectorField(seen.field(whole), seen.bent(at), parameters, period=period)


def fork(count=1, steady=1.0):
    """y' = y (p - |y|^2), `count` of them, and one that decays."""

    def g(y, p):
        size = sum(a * a for a in y[:count])
        return [a * (p["p"] - size) for a in y[:count]] + [-steady * y[count]]

    return g


def crossing(y, p):
    """y' = y (p - y): two curves of orbits that cross."""
    return [y[0] * (p["p"] - y[0]), -y[1]]


def ring(omega, slope=0.0):
    """y' = (p - |y|^2 + i (omega + slope p)) y: a torus is born at p = 0, where multipliers are exp(+-2 pi i omega)."""

    def g(y, p):
        grows = p["p"] - y[0] ** 2 - y[1] ** 2
        w = omega + slope * p["p"]
        return [grows * y[0] - w * y[1], w * y[0] + grows * y[1], *(-a for a in y[2:])]

    return g


def cusp(y, p):
    """y' = p + q y - y^3: folds at 27 p^2 = 4 q^3, a cusp at p = q = 0."""
    return [p["p"] + p["q"] * y[0] - y[0] ** 3, -y[1]]


def fork_along_a_parabola(y, p):
    """y' = y (p - q^2 - y^2): the point at p = q^2."""
    return [y[0] * (p["p"] - p["q"] ** 2 - y[0] ** 2), -y[1]]


def fork_that_changes_side(y, p):
    """y' = y (p + q y^2 - y^4): at p = 0, super- or subcritical with the sign of q."""
    return [y[0] * (p["p"] + p["q"] * y[0] ** 2 - y[0] ** 4), -y[1]]


def ring_that_turns_faster(y, p):
    """y' = (p - q^2 - |y|^2 + i (0.2 + q)) y: a torus at p = q^2, of angle 2 pi (0.2 + q)."""
    grows, w = p["p"] - p["q"] ** 2 - y[0] ** 2 - y[1] ** 2, 0.2 + p["q"]
    return [grows * y[0] - w * y[1], w * y[0] + grows * y[1]]


def ring_that_changes_side(y, p):
    """y' = (p + q |y|^2 - |y|^4 + 0.3 i) y: a torus at p = 0, super- or subcritical with the sign of q."""
    r2 = y[0] ** 2 + y[1] ** 2
    grows = p["p"] + p["q"] * r2 - r2**2
    return [grows * y[0] - 0.3 * y[1], 0.3 * y[0] + grows * y[1]]
