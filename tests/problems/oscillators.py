"""Small curves of orbits whose every column is known in closed form, for what a user does with results."""

from __future__ import annotations

import math
from functools import cache

import mjcont as mc
from problems.motions import bautin

# fewer intervals and larger steps: these orbits are harmonic
QUICK = {"mesh": 10, "ds": 0.3, "ds_max": 0.5}


@cache
def circles():
    """Cycles of radius r at r^2 = (1 + sqrt(1 + 4 b1)) / 2, period 2 pi, on both sides of their fold at b1 = -1/4."""
    equilibria = mc.continue_equilibria(bautin(), "b1", (-0.5, 0.2))
    return equilibria, mc.continue_cycles(equilibria.point("HB1"))


def linear(names=("x", "v")):
    """The oscillator x'' + 0.2 x' + x = cos(w t)."""

    def f(u, p, t):
        return [u[1], -0.2 * u[1] - u[0] + math.cos(p["w"] * t)]

    return mc.VectorField(
        f, [0.0, 0.0], {"w": 0.5}, period=lambda p: 2.0 * math.pi / p["w"], names=list(names),
        units={names[0]: "rad", names[1]: "rad/s", "w": "rad/s"}, name="linear oscillator",
    )


@cache
def resonance():
    """Its response over 0.5 < w < 2: amplitude 1 / |1 - w^2 + 0.2 i w|."""
    return mc.continue_response(linear(), "w", (0.5, 2.0), **QUICK)


@cache
def flutter():
    """A few cycles of the column of two rods under a follower load beyond its Hopf point."""
    rods = mc.Mechanism.from_xml("ziegler_rods")
    hopf = mc.continue_equilibria(rods, "P", (1.5, 2.2), start={"P": 1.5}).point("HB1")
    return mc.continue_cycles(hopf, max_points=4)
