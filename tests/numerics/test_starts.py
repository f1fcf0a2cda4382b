"""Starts: the equilibrium that a guess belongs to, by Newton's method, damped Newton steps, or motion to rest."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

import mjcont as mc

# the repressilator with three equal genes, which oscillates (a case reported to the authors of BifurcationKit.jl)
REPRESSILATOR = {"v": 10.0, "K": 20.0, "d": 0.1}


def repressilator(u, p):
    made = [p["v"] * p["K"] ** 3 / (p["K"] ** 3 + z**3) for z in u]
    return [made[2] - p["d"] * u[0], made[0] - p["d"] * u[1], made[1] - p["d"] * u[2]]


@pytest.mark.parametrize("scale", [None, 10.0, 1000.0])
def test_a_field_that_oscillates_at_its_start_is_solved(scale):
    # the equal state solves v K^3 = d x (K^3 + x^3)
    scales = None if scale is None else [scale] * 3
    field = mc.VectorField(repressilator, [25.0, 15.0, 15.0], REPRESSILATOR, names=list("XYZ"), scale=scales)
    roots = np.roots([0.1, 0.0, 0.0, 0.1 * 20.0**3, -10.0 * 20.0**3])
    (x,) = roots[(abs(roots.imag) < 1e-9) & (roots.real > 0)].real
    point = mc.find_equilibrium(field)
    assert point.n_unstable == 2
    np.testing.assert_allclose(point.state, x, rtol=1e-10)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("far", [0.1, 1.0, 1e4])
def test_a_linear_field_is_one_newton_step_away_however_far_that_is(sign, far):
    field = mc.VectorField(lambda u, p: [sign * (u[0] - p["a"])], [far], {"a": 0.0})
    assert mc.find_equilibrium(field).state[0] == pytest.approx(0.0, abs=1e-10)


def test_damped_steps_follow_a_curved_valley():
    # Rosenbrock's gradient from (-1.2, 1): full Newton steps leave the valley
    def gradient(u, p):
        x, y = u
        return [-2.0 * (p["a"] - x) - 400.0 * x * (y - x * x), 200.0 * (y - x * x)]

    field = mc.VectorField(gradient, [-1.2, 1.0], {"a": 1.0})
    np.testing.assert_allclose(mc.find_equilibrium(field).state, 1.0, atol=1e-10)


def test_a_field_without_equilibrium_says_so_and_names_the_search():
    field = mc.VectorField(lambda u, p: [1.0 + u[0] ** 2], [0.3], {"a": 0.0})
    with pytest.raises(mc.StartError, match=r"no equilibrium found from u0: .*find_equilibria searches") as caught:
        mc.find_equilibrium(field)
    assert "pose" not in str(caught.value)


def test_a_mechanism_goes_where_its_motion_would_come_to_rest():
    # from 100 deg a pendulum swings down, though the upright rest is nearer
    xml = """<mujoco><worldbody><body><joint name="q" axis="0 -1 0" damping="1"/>
      <geom type="sphere" size=".1" mass="1" pos="0 0 1"/></body></worldbody></mujoco>"""
    point = mc.find_equilibrium(mc.Mechanism.from_xml(xml), state=[math.radians(80.0)])
    assert (point.stability, point.state[0]) == ("stable", pytest.approx(math.pi))


@pytest.mark.slow
def test_a_mechanism_that_drifts_names_its_pose():
    xml = """<mujoco><worldbody><body><joint type="slide" axis="0 0 1"/><geom size=".1"/></body></worldbody></mujoco>"""
    with pytest.raises(mc.StartError, match="the model's initial pose: the motion from the start"):
        mc.find_equilibrium(mc.Mechanism.from_xml(xml))


LEG = """<mujoco><option gravity="0 0 -9.81"/><worldbody>
  <geom name="floor" type="plane" size="5 5 .1" pos="0 0 {h}" friction="0" condim="1"/>
  <body><joint name="a" axis="0 1 0" stiffness="8" damping=".5"/>
    <geom type="capsule" fromto="0 0 0 .6 0 0" size=".03" mass="1" contype="0" conaffinity="0"/>
    <body pos=".6 0 0"><joint name="b" axis="0 1 0" stiffness="8" damping=".5"/>
      <geom type="capsule" fromto="0 0 0 .5 0 .1" size=".03" mass="1" contype="0" conaffinity="0"/>
      <geom name="foot" type="sphere" size=".06" pos=".5 0 .1" mass=".1" friction="0" condim="1" solref="-{k} -30"/>
    </body></body></worldbody><actuator><motor name="M" joint="a"/></actuator></mujoco>"""


@pytest.mark.slow
@pytest.mark.parametrize("h", [-0.05, -0.2, -0.3, -0.4])
@pytest.mark.parametrize("k", [1000, 10000, 100000])
def test_a_leg_that_falls_on_a_floor_comes_to_rest(h, k):
    xml = LEG.format(h=h, k=k)
    point = mc.find_equilibrium(mc.Mechanism.from_xml(xml))
    assert point.stability == "stable"
    m = mujoco.MjModel.from_xml_string(xml)
    d = mujoco.MjData(m)
    d.qpos[:] = point.state
    mujoco.mj_inverse(m, d)
    assert np.abs(d.qfrc_inverse).max() < 1e-9
    # beside the rest MuJoCo's own steps lead back to it, where they do not chatter
    d.qpos[:] = point.state + 1e-4
    m.opt.timestep = 1e-4
    mujoco.mj_step(m, d, 60000)
    if np.abs(d.qvel).max() < 1e-6:
        np.testing.assert_allclose(d.qpos, point.state, atol=1e-6)
