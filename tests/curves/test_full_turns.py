"""A wheel between two equal springs (Zeeman's catastrophe machine): poses that differ by full turns are one."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc

R, REST, K, ANCHOR = 0.4, 0.8, 2.0, -1.5
X, Y = "mocap:hand.pos[0]", "mocap:hand.pos[1]"
XML = f"""<mujoco><option gravity="0 0 0"/><worldbody><site name="a" pos="{ANCHOR} 0 0"/>
  <body name="hand" mocap="true" pos="1 0 0"><site name="h"/></body>{{beside}}
  <body><joint name="q" axis="0 0 1" damping=".1"/><geom type="cylinder" size="{R} .02" mass="1" contype="0"
    conaffinity="0"/><site name="p" pos="{R} 0 0"/></body></worldbody>
  <tendon><spatial springlength="{REST}" stiffness="{K}"><site site="a"/><site site="p"/></spatial>
    <spatial springlength="{REST}" stiffness="{K}"><site site="p"/><site site="h"/></spatial></tendon></mujoco>"""
BALL = """<body name="ball" pos="3 0 0"><joint type="ball" stiffness="1" damping="1"/>
  <geom size=".1" pos="0 0 -.1" contype="0" conaffinity="0"/></body>"""


def wheel(beside=""):
    return mc.Mechanism.from_xml(XML.format(beside=beside))


def torque(q, x, y):
    """Return minus the slope of the energy of both springs in the angle."""
    point, along = R * np.array([np.cos(q), np.sin(q)]), R * np.array([-np.sin(q), np.cos(q)])
    total = np.zeros_like(q)
    for end in (np.array([ANCHOR, 0.0]), np.array([x, y])):
        away = point - end.reshape(2, *[1] * np.ndim(q))
        length = np.linalg.norm(away, axis=0)
        total = total - K * (length - REST) / length * np.einsum("i...,i...->...", away, along)
    return total


def rests(x, y=0.0):
    """Return the angles in [0, 2 pi) at which the torque changes sign."""
    q = np.linspace(0.0, 2.0 * np.pi, 100001) + 1e-3
    t = torque(q, x, y)
    return np.sort(q[:-1][t[:-1] * t[1:] < 0] % (2.0 * np.pi))


@pytest.mark.slow
@pytest.mark.parametrize("x", [1.4, 1.5, 1.6])
@pytest.mark.parametrize("beside", ["", BALL])
def test_each_pose_is_found_once_also_where_even_angles_are_poses(x, beside):
    found = mc.find_equilibria(wheel(beside), {X: x}, starts=60)
    angles = np.sort([float(e["q"]) % (2.0 * np.pi) for e in found])
    assert len(angles) == 4
    # 1e-4: the step of the scan; an angle of zero may be found as a full turn
    np.testing.assert_allclose(np.exp(1j * angles).sum(), np.exp(1j * rests(x)).sum(), atol=1e-3)


@pytest.mark.slow
def test_a_locus_that_comes_back_a_full_turn_later_is_closed():
    branch = mc.continue_equilibria(wheel(), Y, bounds=(-1.2, 1.2), start={X: 1.5, Y: 0.0}, state=[np.pi / 2])
    locus = mc.continue_special(branch.of_kind("LP")[0], X, bounds={X: (0.8, 2.5), Y: (-1.6, 1.6)}, max_points=400)
    assert locus.ends == [("closed", "the curve closes on itself, full turns apart")]
    assert abs(locus["q"][-1] - locus["q"][0]) == pytest.approx(2.0 * np.pi, abs=0.1)
    cusps = locus.of_kind("CP")
    assert len(cusps) == 4
    assert {(p.stability, p.n_unstable) for p in cusps} == {("marginal", 0)}
    # at a cusp torque, its slope and its curvature vanish; two lie on the axis of symmetry, two are mirror images
    for p in cusps:
        values = torque(p["q"] + 1e-3 * np.arange(-2.0, 3.0), p[X], p[Y])
        assert abs(values[2]) < 1e-9
        assert abs(values[3] - values[1]) / 2e-3 < 1e-5
        assert abs(values[3] - 2.0 * values[2] + values[1]) / 1e-6 < 1e-5
    heights = np.sort([p[Y] for p in cusps])
    np.testing.assert_allclose(heights, -heights[::-1], atol=1e-9)
    np.testing.assert_allclose(heights[1:3], 0.0, atol=1e-9)


def test_a_wheel_beside_a_ball_joint_has_full_turns_too():
    mechanism = wheel(BALL)
    periods = mechanism.periods(mechanism.start_state(), mechanism.values())
    np.testing.assert_array_equal(periods, [np.inf, np.inf, np.inf, 2.0 * np.pi])
