"""Motions that keep an energy, whose families of orbits are known."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import mjcont as mc

TWO_PI = 2.0 * math.pi


def cubic_pair(damping=0.0):
    """Return the two masses of Kerschen et al. (2009): one on a hardening spring."""
    def rates(u, p):
        x, y, v, w = u
        return [v, w, -2.0 * x + y - 0.5 * x**3 - p["c"] * v, -2.0 * y + x]

    def energy(u, p):
        x, y, v, w = u
        return 0.5 * (x * x + (x - y) ** 2 + y * y + v * v + w * w) + x**4 / 8.0

    return mc.VectorField(rates, np.zeros(4), {"c": damping}, names=["x", "y", "v", "w"], energy=energy)


CUBIC_PAIR = """
<mujoco model="cubic pair">
  <option gravity="0 0 0"/>
  <worldbody>
    <body>
      <joint name="x" type="slide" axis="1 0 0" stiffness="1 0 0.5"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
    </body>
    <body>
      <joint name="y" type="slide" axis="1 0 0" stiffness="1" damping="0.1"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
    </body>
  </worldbody>
  <tendon>
    <fixed name="between" stiffness="1" damping="0.2" springlength="0">
      <joint joint="x" coef="1"/>
      <joint joint="y" coef="-1"/>
    </fixed>
  </tendon>
</mujoco>
"""

# omega, energy and the sum of the nontrivial multipliers of orbits at rest at time zero: 80-bit shooting, closed again
# to 1e-12 by DOP853
IN_PHASE = [
    (1.02, 0.23555309584171552, -0.35555114301650514),
    (1.05, 0.6917517548206723, -0.49735883710947293),
    (1.1, 1.885525167687427, -0.5759273686302093),
    (1.15, 4.135389691806495, -0.4158682798850567),
    (1.2, 8.943353863998285, 0.08682623106114155),
]
OUT_OF_PHASE = [
    (1.8, 3.012080990224304, -1.1847611261288373),
    (1.9, 6.201867420133076, -0.904477215762431),
    (2.2, 15.673915022807357, -1.4274242750199173),
    (2.5, 29.24781544545513, -1.8782639497720237),
    (3.0, 66.53200480772675, -1.9559073642839435),
]
RESONANCE = (1.28153428993296, 40.9748106147101)


def duffing():
    """Return x'' = -x - x^3, its energy left to be found."""
    return mc.VectorField(lambda u, p: [u[1], -u[0] - u[0] ** 3], [0.0, 0.0], {"k": 1.0}, names=["x", "v"])


def period_of_duffing(energy):
    """Return 4 K(m) / sqrt(1 + a^2) with m = a^2 / (2 (1 + a^2)) at the amplitude a of an energy."""
    square = math.sqrt(1.0 + 4.0 * energy) - 1.0
    return 4.0 * ellipk(0.5 * square / (1.0 + square)) / math.sqrt(1.0 + square)


PENDULUM = """
<mujoco model="pendulum">
  <option gravity="0 0 -9.81"/>
  <worldbody>
    <body>
      <joint name="theta" type="hinge" axis="0 1 0" damping="0.3"/>
      <inertial pos="0 0 -0.5" mass="2" diaginertia="0.01 0.01 0.01"/>
    </body>
  </worldbody>
</mujoco>
"""


def period_of_pendulum(energy):
    """Return 4 K(m) / omega with m = E / (2 m g l)."""
    load, inertia = 2.0 * 9.81 * 0.5, 2.0 * 0.25 + 0.01
    return 4.0 * ellipk(0.5 * energy / load) / math.sqrt(load / inertia)


SPRING, LENGTH = 4.4, 1.0


def elastic_pendulum():
    """Return a unit mass that hangs from a spring of length one at rest, in unit gravity: x across, z along it."""
    free = LENGTH - 1.0 / SPRING

    def rates(u, p):
        x, z, v, w = u
        r = math.hypot(x, LENGTH + z)
        pull = SPRING * (r - free) / r
        return [v, w, -pull * x, 1.0 - pull * (LENGTH + z)]

    return mc.VectorField(rates, np.zeros(4), {"k": SPRING}, names=["x", "z", "v", "w"])


def swing_of_a_bounce(amplitude):
    """Return the trace of the swing's multipliers while the mass bounces, z = a cos(sqrt(k) t): Hill's equation."""
    rate, free = math.sqrt(SPRING), LENGTH - 1.0 / SPRING

    def hill(t, y):
        r = LENGTH + amplitude * math.cos(rate * t)
        pull = SPRING * (r - free) / r
        return [y[1], -pull * y[0], y[3], -pull * y[2]]

    run = solve_ivp(hill, (0.0, TWO_PI / rate), [1.0, 0.0, 0.0, 1.0], method="DOP853", rtol=1e-13, atol=1e-14)
    return run.y[0, -1] + run.y[3, -1]
