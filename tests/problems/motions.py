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


def van_der_pol(mu=1.0):
    """Relaxation oscillator; all its linear cycles at mu = 0 have one period."""

    def f(u, p):
        return [u[1], p["mu"] * (1.0 - u[0] ** 2) * u[1] - u[0]]

    return mc.VectorField(f, [2.0, 0.0], {"mu": mu}, names=["x", "v"])


def rossler():
    """A spiral that doubles its period, again and again, as c grows."""

    def f(u, p):
        return [-u[1] - u[2], u[0] + p["a"] * u[1], p["b"] + u[2] * (u[0] - p["c"])]

    start = [4.733558125388612, -0.9420533365782291, 0.9420533365782291]
    return mc.VectorField(f, start, {"a": 0.2, "b": 0.2, "c": 2.5}, names=["x", "y", "z"])


def pendulum_under_torque(damping, torque):
    """A pendulum that goes round and round; multiplier exp(-c T)."""

    def f(u, p):
        return [u[1], -p["c"] * u[1] - math.sin(u[0]) + p["torque"]]

    return mc.VectorField(f, [0.0, 3.0], {"c": damping, "torque": torque}, names=["angle", "speed"])


def reactions():
    """The demo abc of AUTO: A -> B -> C in a stirred tank, with a steep relaxation cycle."""

    def f(u, p):
        e = math.exp(u[2])
        return [
            -u[0] + p["D"] * (1.0 - u[0]) * e,
            -u[1] + p["D"] * e * (1.0 - u[0] - 0.04 * u[1]),
            -u[2] - 1.55 * u[2] + p["D"] * 8.0 * e * (1.0 - u[0] + 0.04 * u[1]),
        ]

    return mc.VectorField(f, [0.2, 0.1, 1.0], {"D": 0.24}, names=["a", "b", "heat"])


def ziegler_rods():
    """The column of two rods under a follower load, as a vector field."""

    def f(u, p):
        q1, q2, w1, w2 = u
        c, coupling, s, v2 = 0.1, 0.5 * math.cos(q2), math.sin(q2), w1 + w2
        forces = (
            -q1 - c * w1 + q2 + c * w2 - p["P"] * s + 0.5 * s * v2**2,
            -q2 - c * w2 - 0.5 * s * w1**2,
        )
        det = 4.0 / 9.0 - coupling**2
        a1 = (forces[0] / 3.0 - forces[1] * coupling) / det
        a2 = (forces[1] * 4.0 / 3.0 - forces[0] * coupling) / det
        return [w1, w2, a1, a2 - a1]

    return mc.VectorField(f, [0.0] * 4, {"P": 1.5}, names=["q1", "q2", "w1", "w2"])
