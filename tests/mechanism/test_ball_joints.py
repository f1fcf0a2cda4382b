"""A chain on ball joints under an axial load, against its buckling load and the elastica of its angles."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.rotations import right_jacobian
from scipy import optimize
from scipy.spatial.transform import Rotation

import mjcont as mc


def ball_chain(*, guide=0.0, gravity=0.0):
    """Two rods of unit length on ball joints with springs (2 at the clamp, 1 above), dead loads P, H at the tip.

    `guide` is the stiffness of springs across, along y, at the joint between the rods and at the tip.
    """
    return f"""
    <mujoco model="ball_chain">
      <option gravity="0 0 {-gravity}"/>
      <statistic extent="2"/>
      <default><joint damping="0.1"/></default>
      <worldbody>
        <site name="ground"/>
        <body name="lower">
          <joint name="clamp" type="ball" stiffness="2"/>
          <inertial pos="0 0 1" mass="0.1" diaginertia="0.01 0.01 0.01"/>
          <body name="upper" pos="0 0 1">
            <joint name="middle" type="ball" stiffness="1"/>
            <inertial pos="0 0 1" mass="0.1" diaginertia="0.01 0.01 0.01"/>
            <site name="middle"/>
            <site name="tip" pos="0 0 1"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <general name="P" site="tip" refsite="ground" gear="0 0 -1 0 0 0"/>
        <general name="H" site="tip" refsite="ground" gear="1 0.5 0 0 0 0"/>
        <general name="bush_tip" site="tip" refsite="ground" gear="0 1 0 0 0 0"
                 gainprm="0" biastype="affine" biasprm="0 {-guide} 0"/>
        <general name="bush_middle" site="middle" refsite="ground" gear="0 1 0 0 0 0"
                 gainprm="0" biastype="affine" biasprm="0 {-guide} 0"/>
      </actuator>
      <sensor><framepos name="tip" objtype="site" objname="tip"/></sensor>
    </mujoco>"""


# smallest root of 3 - 4 p + p^2 - 1 = 0: springs 2 and 1 between links at absolute angles
BALL_BUCKLING = 2.0 - math.sqrt(2.0)


def chain_angles(ratio, guess):
    """Absolute angles of two links: 3 t1 - t2 = P sin(t1), t2 - t1 = P sin(t2)."""
    found = optimize.root(
        lambda t: [3 * t[0] - t[1] - ratio * np.sin(t[0]), t[1] - t[0] - ratio * np.sin(t[1])], guess, tol=1e-14
    )
    return found.x


@pytest.fixture(scope="module")
def guided():
    return mc.Mechanism.from_xml(ball_chain(guide=5.0))


def test_the_derivative_of_a_ball_spring_is_the_inverse_jacobian_of_its_rotation_vector():
    xml = """
    <mujoco model="ball">
      <option gravity="0 0 0"/>
      <worldbody><body name="top"><joint name="top" type="ball" stiffness="3"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 2 2.5"/></body></worldbody>
    </mujoco>"""
    mechanism = mc.Mechanism.from_xml(xml)
    for v in ([0.3, -0.2, 0.5], [1.0, 1.0, -0.8]):
        state = np.roll(Rotation.from_rotvec(v).as_quat(), 1)
        lin = mechanism.linearize(state, mechanism.values(), [], accurate=True)
        assert lin.f == pytest.approx(-3.0 * np.array(v), abs=1e-13)
        assert lin.jac == pytest.approx(-3.0 * np.linalg.inv(right_jacobian(np.array(v))), abs=1e-9)


def test_a_chain_on_ball_joints_buckles_at_the_load_of_the_chain_on_hinges(guided):
    branch = mc.continue_equilibria(guided, "P", bounds=(0.0, 1.0))
    (point,) = branch.special_points
    assert point.coefficients["type"] == "supercritical pitchfork"
    assert point["P"] == pytest.approx(BALL_BUCKLING, rel=1e-10)


def test_the_buckling_of_a_chain_free_to_lean_either_way_is_reported():
    # without guides the chain buckles in every direction at once: two eigenvalues of K are zero
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(ball_chain()), "P", bounds=(0.0, 1.0))
    assert set(branch.n_unstable) == {0, 2}
    assert any(p["P"] == pytest.approx(BALL_BUCKLING, rel=1e-6) for p in branch.special_points)


def test_the_buckled_chain_on_ball_joints_has_the_angles_of_the_one_on_hinges(guided):
    branch = mc.continue_equilibria(guided, "P", bounds=(0.0, 1.5))
    (buckled,) = [b for b in mc.switch_branches(branch.point("BP1")) if np.abs(b["tip[0]"]).max() > 0.1]
    for p in buckled.at(P=1.2):
        lower = Rotation.from_quat(np.roll(p.state[:4], -1)).as_rotvec()
        upper = Rotation.from_quat(np.roll(p.state[4:], -1)).as_rotvec()
        assert [*lower[[0, 2]], *upper[[0, 2]]] == pytest.approx([0.0] * 4, abs=1e-9)
        angles = np.array([lower[1], lower[1] + upper[1]])
        assert angles == pytest.approx(chain_angles(1.2, angles * 1.02), abs=1e-9)
    assert np.linalg.norm(buckled.states[:, :4], axis=1) == pytest.approx(np.ones(len(buckled)), abs=1e-14)


@pytest.mark.slow
def test_a_chain_on_ball_joints_hangs_where_its_energy_is_least():
    mechanism = mc.Mechanism.from_xml(ball_chain(guide=0.5, gravity=9.81))
    branch = mc.continue_equilibria(mechanism, "H", bounds=(0.0, 3.0), start={"P": -1.0})

    def chain_energy(u, h):
        one, two = Rotation.from_rotvec(u[:3]), Rotation.from_rotvec(u[3:])
        elbow = one.apply([0.0, 0.0, 1.0])
        tip = elbow + (one * two).apply([0.0, 0.0, 1.0])
        springs = 1.0 * u[:3] @ u[:3] + 0.5 * u[3:] @ u[3:] + 0.25 * (elbow[1] ** 2 + tip[1] ** 2)
        return springs + 0.1 * 9.81 * (elbow[2] + tip[2]) - h * (tip[0] + 0.5 * tip[1]) - 1.0 * tip[2]

    for h in (0.5, 1.5, 3.0):
        (p,) = branch.at(H=h)
        assert p.stability == "stable"
        found = optimize.minimize(chain_energy, np.full(6, 0.1), args=(h,), method="BFGS", tol=1e-8)
        vectors = [Rotation.from_quat(np.roll(q, -1)).as_rotvec() for q in (p.state[:4], p.state[4:])]
        assert np.concatenate(vectors) == pytest.approx(found.x, abs=1e-5)


def test_a_ball_joint_has_an_upper_limit_alone():
    limited = mc.Mechanism.from_xml("""<mujoco><worldbody><body>
        <joint name="hip" type="ball" range="0 150" limited="true"/><geom size="0.1" pos="0 0 1"/></body></worldbody>
        </mujoco>""")
    angle = np.radians(160.0)
    pose = np.array([np.cos(angle / 2), np.sin(angle / 2), 0.0, 0.0])
    assert limited.active(pose, limited.values()) == {"upper limit of hip"}
