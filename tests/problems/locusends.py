"""Cycles that shrink to points of codimension two of equilibria, all at p = q = 0, with exact curves of special orbits.

Source of the forms: Kuznetsov, Elements of Applied Bifurcation Theory, chapter 8; Carr, Applications of Centre Manifold
Theory (1981), for the symmetric Bogdanov-Takens point.
"""

from __future__ import annotations

import math

import mjcont as mc
from problems.exactorbits import Seen


def _field(g, v, parameters):
    seen = Seen(len(v), 3)
    return mc.VectorField(seen.field(g), seen.bent(v), parameters)


def tori_at_a_zero_hopf_point(p=-0.04, w=-0.1):
    """z' = (q - w + w^2 + i) z, w' = p + w^2 + |z|^2: cycles with w - w^2 = q, tori at q = 0, p < 0."""

    def g(v, p, t):
        a, b, w = v
        grows = p["q"] - w + w * w
        return [grows * a - b, a + grows * b, p["p"] + w * w + a * a + b * b]

    return _field(g, [math.sqrt(-p - w * w), 0.0, w], {"p": p, "q": w - w * w})


def folds_at_a_zero_hopf_point(q=0.2, w=0.3):
    """z' = (q - |z|^2 + i) z, w' = p - w^2 + 0.3 |z|^2: folds at w = 0, p = -0.3 q, q > 0."""

    def g(v, p, t):
        a, b, w = v
        grows = p["q"] - a * a - b * b
        return [grows * a - b, a + grows * b, p["p"] - w * w + 0.3 * (a * a + b * b)]

    return _field(g, [math.sqrt(q), 0.0, w], {"p": w * w - 0.3 * q, "q": q})


def tori_at_a_double_hopf_point(p=0.2, q=-0.3):
    """z' = (p - |z|^2 - |y|^2 / 2 + i) z, y' = (q + |z|^2 - |y|^2 + 0.3 i) y: tori of y = 0 at q = -p, p > 0."""

    def g(v, p, t):
        r1, r2 = v[0] ** 2 + v[1] ** 2, v[2] ** 2 + v[3] ** 2
        a, b = p["p"] - r1 - 0.5 * r2, p["q"] + r1 - r2
        return [a * v[0] - v[1], v[0] + a * v[1], b * v[2] - 0.3 * v[3], 0.3 * v[2] + b * v[3]]

    return _field(g, [math.sqrt(p), 0.0, 0.0, 0.0], {"p": p, "q": q})


def doublings_at_a_double_hopf_point(p=0.04, q=-0.3):
    """z' = (p - |z|^2 + i) z, y' = (q + i / 2) y + z y* - |y|^2 y: exponents q +- |z|, doublings at q = -sqrt(p)."""

    def g(v, p, t):
        a, b = p["p"] - v[0] ** 2 - v[1] ** 2, p["q"] - v[2] ** 2 - v[3] ** 2
        return [a * v[0] - v[1], v[0] + a * v[1],
                b * v[2] - 0.5 * v[3] + v[0] * v[2] + v[1] * v[3], 0.5 * v[2] + b * v[3] + v[1] * v[2] - v[0] * v[3]]

    return _field(g, [math.sqrt(p), 0.0, 0.0, 0.0], {"p": p, "q": q})


def folds_at_a_symmetric_double_zero():
    """x'' = p x + q x' - x^3 - x^2 x': cycles round both wells fold at q = 0.752 p as p > 0 vanishes (Carr)."""

    def g(v, p, t):
        x, y = v
        return [y, p["p"] * x + p["q"] * y - x**3 - x * x * y]

    return _field(g, [1.6, 0.0], {"p": 1.0, "q": 0.9})
