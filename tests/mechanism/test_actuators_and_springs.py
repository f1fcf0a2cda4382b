"""Servos, springs, tendons, gravity compensation, turns and keyframes of MuJoCo models against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mjcont as mc

WEIGHT = 9.81


def rod(joint: str = "", actuator: str = "", body: str = "", rest: str = "", inner: str = "") -> mc.Mechanism:
    """A rod of 1 kg, upright at zero, its mass 1 m above its hinge `q`."""
    return mc.Mechanism.from_xml(
        f"""<mujoco model="rod"><compiler angle="radian"/><option gravity="0 0 -{WEIGHT}"/><worldbody>
        <body name="rod" {body}><joint name="q" axis="0 1 0" {joint}/>
        <inertial pos="0 0 1" mass="1" diaginertia="1e-3 1e-3 1e-3"/>{inner}</body></worldbody>
        <actuator>{actuator}</actuator>{rest}</mujoco>"""
    )


# -- servos --------------------------------------------------------------------------------------------------


def test_a_position_servo_holds_the_rod_where_its_torque_balances_the_weight():
    branch = mc.continue_equilibria(rod('damping="1"', '<position name="u" joint="q" kp="30"/>'), "u", bounds=(-1, 1))
    q = branch["q"]
    assert branch["u"] == pytest.approx(q - WEIGHT * np.sin(q) / 30, abs=1e-9)
    assert set(branch.stability) == {"stable"}


def test_a_soft_position_servo_buckles_where_its_stiffness_no_longer_holds_the_rod():
    mechanism = rod('damping="1"', '<position name="u" joint="q" kp="5"/>')
    branch = mc.continue_equilibria(mechanism, "u", bounds=(-2, 2), start={"u": -2.0}, state=[-2.5])
    folds = sorted(p["q"] for p in branch.of_kind("LP"))
    expected = math.acos(5 / WEIGHT)
    assert folds == pytest.approx([-expected, expected], abs=1e-7)


def test_a_velocity_servo_asked_for_a_speed_pushes_and_damps():
    mechanism = rod('stiffness="30"', '<velocity name="u" joint="q" kv="4"/>')
    point = mc.find_equilibrium(mechanism, {"u": 0.5})
    q = point["q"]
    assert 30 * q - WEIGHT * math.sin(q) == pytest.approx(4 * 0.5, abs=1e-9)
    values = mechanism.values({"u": 0.5})
    assert mechanism.pencil(point.state, values, np.zeros((1, 1))).damping == pytest.approx(np.array([[4.0]]), rel=1e-9)


# -- gravity compensation and springs ------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.25, 1.0])
def test_gravity_compensation_carries_its_share_of_the_weight(share):
    mechanism = rod('stiffness="1"', body=f'gravcomp="{share}"')
    for q in (0.3, 2.0):
        expected = (1 - share) * WEIGHT * math.sin(q) - q
        assert mechanism.residual(np.array([q]), mechanism.values()) == pytest.approx([expected], rel=1e-12)


@pytest.mark.slow
def test_a_polynomial_spring_folds_where_its_force_turns():
    """Force a x + b x^2 + c x^3, snapping through where a + 2 b x + 3 c x^2 = 0."""
    a, b, c = 100.0, -300.0, 200.0
    mechanism = mc.Mechanism.from_xml(
        f"""<mujoco><option gravity="0 0 0"/><worldbody><body>
        <joint name="x" type="slide" axis="1 0 0" stiffness="{a} {b} {c}" damping="1"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
        <actuator><motor name="F" joint="x"/></actuator></mujoco>"""
    )
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-20, 40))
    x = branch["x"]
    assert branch["F"] == pytest.approx(a * x + b * x**2 + c * x**3, abs=1e-8)
    turning = np.sort(np.roots([3 * c, 2 * b, a]).real)
    folds = sorted(branch.of_kind("LP"), key=lambda p: p["x"])
    assert [p["x"] for p in folds] == pytest.approx(turning, abs=1e-8)
    assert [p["F"] for p in folds] == pytest.approx(a * turning + b * turning**2 + c * turning**3, abs=1e-9)


# -- a tendon that wraps -------------------------------------------------------------------------------------

RADIUS, REACH, ANCHOR = 0.2, 1.0, 1.0


def wrapped_length(q: float) -> float:
    """Return the length from an anchor at (-1, 0), round a cylinder at the hinge, to the rod's tip at angle q."""
    tangents = math.sqrt(ANCHOR**2 - RADIUS**2) + math.sqrt(REACH**2 - RADIUS**2)
    between = math.pi / 2 + q  # from the anchor, on -x, over the top to the tip
    arc = between - math.acos(RADIUS / ANCHOR) - math.acos(RADIUS / REACH)
    return tangents + RADIUS * arc


def rod_with_wrapped_spring(stiffness: float) -> mc.Mechanism:
    return mc.Mechanism.from_xml(
        f"""<mujoco model="wrap"><compiler angle="radian"/><option gravity="0 0 -{WEIGHT}"/><worldbody>
        <site name="anchor" pos="{-ANCHOR} 0 0"/><site name="top" pos="0 0 0.5"/>
        <geom name="drum" type="cylinder" size="{RADIUS} 0.1" zaxis="0 1 0" contype="0" conaffinity="0"/>
        <body name="rod"><joint name="q" axis="0 1 0" damping="1"/><site name="tip" pos="0 0 {REACH}"/>
        <inertial pos="0 0 1" mass="1" diaginertia="1e-3 1e-3 1e-3"/></body></worldbody>
        <tendon><spatial name="rope" stiffness="{stiffness}" springlength="1"><site site="anchor"/>
        <geom geom="drum" sidesite="top"/><site site="tip"/></spatial></tendon>
        <sensor><tendonpos name="length" tendon="rope"/></sensor>
        <actuator><motor name="M" joint="q"/></actuator></mujoco>"""
    )


def test_a_tendon_round_a_cylinder_has_the_length_of_tangents_and_arc():
    mechanism = rod_with_wrapped_spring(50.0)
    angles = np.linspace(1.3, 2.2, 7)
    found = mechanism.measure(angles[:, None], mechanism.values(), ["length"])[:, 0]
    assert found == pytest.approx([wrapped_length(q) for q in angles], rel=1e-12)


@pytest.mark.slow
def test_a_wrapped_spring_holds_the_rod_with_the_drums_radius_as_lever():
    branch = mc.continue_equilibria(rod_with_wrapped_spring(50.0), "M", bounds=(0.2, 4), start={"M": 1.5}, state=[1.9])
    wrapped = branch["q"] > 2 * math.acos(RADIUS) - math.pi / 2
    q = branch["q"][wrapped]
    assert np.ptp(q) > 0.9
    tension = 50 * (np.array([wrapped_length(v) for v in q]) - 1)
    assert branch["M"][wrapped] == pytest.approx(RADIUS * tension - WEIGHT * np.sin(q), abs=1e-8)
    fold = min(branch.of_kind("LP"), key=lambda p: abs(p["q"] - 1.4))
    assert fold["q"] == pytest.approx(math.acos(RADIUS**2 * 50 / WEIGHT), abs=1e-7)


# -- several turns, and starts -------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_branch_winds_through_several_turns():
    """A torsion spring of 0.5 N m/rad wound up by its control: k (u - q) + m g l sin q = 0 for |q| up to 4 turns."""
    mechanism = rod('damping="1"', '<position name="u" joint="q" kp="0.5"/>')
    branch = mc.continue_equilibria(mechanism, "u", bounds=(-30, 30), ds_max=0.1, max_points=5000)
    q = branch["q"]
    assert q.max() - q.min() > 4 * math.pi
    assert branch["u"] == pytest.approx(q - WEIGHT / 0.5 * np.sin(q), abs=1e-6)
    folds = np.array([p["q"] for p in branch.of_kind("LP")])
    assert np.cos(folds) == pytest.approx(np.full(len(folds), 0.5 / WEIGHT), abs=1e-7)
    assert np.abs(folds).max() > 2 * math.pi


KEYS = '<keyframe><key name="left" qpos="-3"/><key name="right" qpos="3" ctrl="0.4"/></keyframe>'


@pytest.mark.parametrize(("key", "side"), [("left", -1), ("right", 1)])
def test_a_keyframe_leads_to_the_equilibrium_on_its_side(key, side):
    mechanism = rod('damping="1" stiffness="2"', '<motor name="M" joint="q"/>', rest=KEYS)
    point = mc.find_equilibrium(mechanism, keyframe=key)
    q = point["q"]
    assert side * q > 2.0
    assert 2 * q == pytest.approx(WEIGHT * math.sin(q), abs=1e-9)
