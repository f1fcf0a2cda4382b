"""Random fields and oscillators whose orbits are in closed form, each seen through coordinates of its own."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.exactorbits import Seen

import mjcont as mc


def circle(seed):
    """Return the field of r' = r (p - r^2), angle' = omega + a r^2, one to three modes that decay, and its numbers."""
    rng = np.random.default_rng(seed)
    n = 2 + int(rng.integers(1, 4))
    omega, bend, decays = rng.uniform(0.5, 2.0), rng.uniform(-0.3, 0.3), rng.uniform(0.2, 3.0, n - 2)

    def g(v, p, t):
        r2 = v[0] ** 2 + v[1] ** 2
        grows, turns = p["p"] - r2, omega + bend * r2
        return [grows * v[0] - turns * v[1], grows * v[1] + turns * v[0], *(-decays * v[2:])]

    seen = Seen(n, seed)
    return mc.VectorField(seen.field(g), [0.0] * n, {"p": -0.5}), omega, bend, decays


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, *(pytest.param(k, marks=pytest.mark.fuzz) for k in range(2, 40))])
def test_a_random_circle_has_its_period_and_multipliers(seed):
    field, omega, bend, decays = circle(seed)
    hopf = mc.continue_equilibria(field, "p", (-0.5, 0.6)).point("HB1")
    cycles = mc.continue_cycles(hopf)
    assert cycles.special_points == ()
    assert cycles.status == "at bound"
    orbit = cycles.orbits[-1]
    period = 2.0 * math.pi / (omega + 0.6 * bend)
    assert orbit.period == pytest.approx(period, rel=1e-9)
    for rate in (0.0, -2.0 * 0.6, *-decays):
        assert np.abs(orbit.multipliers - math.exp(rate * period)).min() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, *(pytest.param(k, marks=pytest.mark.fuzz) for k in range(2, 40))])
def test_a_random_linear_oscillator_answers_as_it_must(seed):
    """m x'' + c x' + k x = F cos(2 pi f t): amplitude F / |k - m w^2 + i c w|, multipliers exp(s / f)."""
    rng = np.random.default_rng(seed)
    mass, damping, stiffness, force = rng.uniform([0.5, 0.05, 0.5, 0.1], [2.0, 1.0, 4.0, 1.0])
    model = mc.Mechanism.from_xml(f"""
    <mujoco>
      <option gravity="0 0 0"/>
      <worldbody><body>
        <joint name="x" type="slide" axis="1 0 0" damping="{damping}" stiffness="{stiffness}"/>
        <inertial pos="0 0 0" mass="{mass}" diaginertia="1 1 1"/>
      </body></worldbody>
      <actuator><motor name="F" joint="x"/></actuator>
    </mujoco>""")
    response = mc.continue_response(model, "frequency", (0.1, 0.5), {"F": mc.Harmonic(force)}, frequency=0.1)
    assert response.special_points == ()
    assert set(response.stability) == {"stable"}
    w = 2.0 * math.pi * response["frequency"]
    exact = force / np.abs(stiffness - mass * w**2 + 1j * damping * w)
    assert response["x.amplitude"] == pytest.approx(exact, rel=1e-7)
    s = np.roots([mass, damping, stiffness])
    for orbit in response.orbits[:: max(len(response) // 3, 1)]:
        for mu in np.exp(s * orbit.period):
            assert np.abs(orbit.multipliers - mu).min() < 1e-6


@pytest.mark.slow
def test_a_mode_that_decays_at_once_is_no_bifurcation():
    """Gauss's |R(z)| -> 1 would put its multiplier on the unit circle."""

    def f(u, p, t):
        return [-u[0] + p["A"] * math.cos(t), -1e5 * (u[1] - u[0] ** 2)]

    field = mc.VectorField(f, [0.0, 0.0], {"A": 1.0}, period=lambda p: 2.0 * math.pi)
    response = mc.continue_response(field, "A", (0.5, 2.0))
    assert response.special_points == ()
    assert set(response.stability) == {"stable"}
    for orbit in response.orbits:
        assert np.sort(np.abs(orbit.multipliers)) == pytest.approx([0.0, math.exp(-2.0 * math.pi)], abs=1e-9)
