"""Scalar fields and small systems whose folds, isolas and oscillations are known in closed form."""

from __future__ import annotations

import math

import numpy as np

import mjcont as mc
from problems.curves import scalar


def circle(radius=1.0):
    return scalar(lambda x, p: x**2 + p["la"] ** 2 - radius**2, -radius, la=0.0)


def circle_branch(radius=1.0, **options):
    return mc.continue_equilibria(circle(radius), "la", bounds=(-2.0, 2.0), **options)


def hyperbolas(gap, sign):
    return scalar(lambda x, p: p["la"] ** 2 + sign * gap**2 - x**2, math.sqrt(0.81 + sign * gap**2), la=-0.9)


def imperfect(eps):
    return scalar(lambda x, p: p["mu"] * x - x**3 + eps, -eps, mu=-1.0)


def twin_waves(gap):
    """Return two curves x = sin(5 t) and x = sin(5 t) + gap, with sharp turns, side by side."""

    def f(x, p):
        wave = math.sin(5.0 * p["t"])
        return -(x - wave) * (x - wave - gap)

    return scalar(f, 0.0, t=0.0)


def two_oscillations(apart, at):
    """Return two oscillations that lose their damping at mu = at and at + apart, with frequencies 1 and 2."""

    def f(u, p):
        a, b, c, d = u
        g1, g2 = p["mu"] - at - a * a - b * b, p["mu"] - at - apart - c * c - d * d
        return [g1 * a - b, a + g1 * b, g2 * c - 2.0 * d, 2.0 * c + g2 * d]

    return mc.VectorField(f, np.zeros(4), {"mu": -1.0})


def neutral_saddle():
    """Return a saddle with eigenvalues 1 and -mu, mixed: their sum vanishes at mu = 1."""
    mix = np.array([[1.0, 0.4], [-0.3, 0.8]])
    back = np.linalg.inv(mix)

    def f(u, p):
        return mix @ (np.array([1.0, -p["mu"]]) * (back @ u))

    return mc.VectorField(f, [0.0, 0.0], {"mu": 0.2})
