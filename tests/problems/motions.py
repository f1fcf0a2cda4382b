"""Periodic motions whose periods, multipliers and special points are known to twelve digits.

The numbers are those of independent shooting in 80-bit arithmetic, or exact where a closed form is stated.
"""

from __future__ import annotations

import math

import mjcont as mc


def brusselator():
    """Two reactants; Hopf at B = 2, omega = 1."""

    def f(u, p):
        x, y = u
        return [p["A"] - (p["B"] + 1.0) * x + x * x * y, p["B"] * x - x * x * y]

    return mc.VectorField(f, [1.0, 1.5], {"A": 1.0, "B": 1.5}, names=["x", "y"])


def bautin():
    """Normal form: cycles at r^2 = (b2 +- sqrt(b2^2 + 4 b1)) / 2, multiplier exp(4 pi r^2 (b2 - 2 r^2))."""

    def f(u, p, t):
        r2 = u[0] ** 2 + u[1] ** 2
        h = p["b1"] + p["b2"] * r2 - r2**2
        return [h * u[0] - u[1], h * u[1] + u[0]]

    return mc.VectorField(f, [0.0, 0.0], {"b1": -0.5, "b2": 1.0})


def duffing():
    """A hardening oscillator under a cosine; its response has two folds in the frequency."""

    def f(u, p, t):
        force = p["g"] * math.cos(p["w"] * t)
        return [u[1], -p["d"] * u[1] - p["a"] * u[0] - p["b"] * u[0] ** 3 + force]

    values = {"d": 0.1, "a": 1.0, "b": 1.0, "g": 0.3, "w": 0.8}
    return mc.VectorField(f, [0.0, 0.0], values, period=lambda p: 2.0 * math.pi / p["w"], names=["x", "v"])


def parametric_pendulum(w):
    """A pendulum with a shaken support; its rest loses stability where it doubles the period."""

    def f(u, p, t):
        return [u[1], -0.1 * u[1] - (1.0 + p["A"] * math.cos(p["w"] * t)) * math.sin(u[0])]

    return mc.VectorField(f, [0.0, 0.0], {"A": 0.1, "w": w}, period=lambda p: 2.0 * math.pi / p["w"])
