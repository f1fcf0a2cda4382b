"""Forces that are smooth in pieces, in models without constraints: slack cables, saturation, wrapping; closed forms."""

import math

import mujoco
import numpy as np
import pytest
from problems.kinked import CABLE, SLACK, SPRING, cable, slider
from scipy.optimize import brentq

import mjcont as mc

GUY, UNSTRETCHED = 60.0, 1.5
GRAVITY, KP, TORQUE = 9.81, 20.0, 5.0


def pendulum(joint: str = "", world: str = "", tendon: str = "", actuator: str = "") -> mc.Mechanism:
    """An inverted pendulum, m = l = 1, turned by a moment M."""
    return mc.Mechanism.from_xml(
        f"""<mujoco model="mast"><option gravity="0 0 {-GRAVITY}"/><worldbody>{world}
        <body><joint name="q" axis="0 1 0" damping="0.1" {joint}/>
        <inertial pos="0 0 1" mass="1" diaginertia="1e-9 1e-9 1e-9"/><site name="tip" pos="0 0 1"/></body></worldbody>
        <tendon>{tendon}</tendon><actuator><general name="M" joint="q"/>{actuator}</actuator></mujoco>"""
    )


SERVO = f'<position name="servo" joint="q" kp="{KP}" kv="1" {{}}/>'


def test_a_cable_goes_taut_where_the_closed_form_has_it_and_adds_its_stiffness():
    branch = mc.continue_equilibria(slider(cable()), "F", bounds=(-4.0, 10.0))
    (corner,) = branch.of_kind("CO")
    assert corner.note == "tendon cable goes taut"
    assert corner["F"] == pytest.approx(SPRING * SLACK, abs=1e-10)
    taut = branch["F"] > SPRING * SLACK
    expected = np.where(taut, (branch["F"] + CABLE * SLACK) / (SPRING + CABLE), branch["F"] / SPRING)
    assert branch["x"] == pytest.approx(expected, abs=1e-9)


def test_a_frequency_rises_as_a_cable_goes_taut():
    branch = mc.continue_equilibria(slider(cable()), "F", bounds=(-4.0, 10.0))
    for force, stiffness in ((1.99999, SPRING), (2.00001, SPRING + CABLE)):
        (point,) = branch.at(F=force)
        assert point.stability == "stable"
        assert np.abs(point.eigenvalues) == pytest.approx(math.sqrt(stiffness), rel=1e-8)


def test_a_branch_that_starts_taut_says_that_the_cable_goes_slack():
    branch = mc.continue_equilibria(slider(cable()), "F", bounds=(-4.0, 10.0), start={"F": 9.0})
    assert [p.note for p in branch.of_kind("CO")] == ["tendon cable goes slack"]


def test_a_dead_band_has_a_corner_at_each_end():
    play = '<fixed name="play" stiffness="30" springlength="-0.1 0.2"><joint joint="x" coef="1"/></fixed>'
    branch = mc.continue_equilibria(slider(play), "F", bounds=(-4.0, 4.0))
    assert [p.note for p in branch.of_kind("CO")] == ["tendon play is compressed", "tendon play goes taut"]
    assert [p["x"] for p in branch.of_kind("CO")] == pytest.approx([-0.1, 0.2], abs=1e-9)


def test_a_mast_turns_back_where_its_guy_goes_slack():
    guy = cable(band=f"0 {UNSTRETCHED}", stiffness=GUY)
    mechanism = pendulum(world='<site name="O" pos="-1 0 0"/>', tendon=guy)

    def length(q: float) -> float:
        return math.sqrt(2.0 + 2.0 * math.sin(q))

    slack = math.asin(UNSTRETCHED**2 / 2.0 - 1.0)
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-6.0, 6.0), start={"M": 1.0}, state=[0.35])
    (corner,) = [p for p in branch.of_kind("CO") if abs(p["q"] - slack) < 0.1]
    assert corner.note == "tendon cable goes slack; M turns back: a non-smooth fold"
    assert corner["q"] == pytest.approx(slack, abs=1e-8)
    assert corner["M"] == pytest.approx(-GRAVITY * math.sin(slack), abs=1e-7)
    for q, expected in ((slack + 0.01, "stable"), (slack - 0.01, "unstable")):
        near = min((branch.row(i) for i in range(len(branch["q"]))), key=lambda p: abs(p["q"] - q))
        pull = GUY * max(length(near["q"]) - UNSTRETCHED, 0.0) * math.cos(near["q"]) / length(near["q"])
        assert near["M"] == pytest.approx(pull - GRAVITY * math.sin(near["q"]), abs=1e-8)
        assert near.stability == expected


@pytest.mark.slow
@pytest.mark.parametrize(
    ("actuator", "joint", "note"),
    [
        (f'forcerange="{-TORQUE} {TORQUE}"', "", "actuator servo saturates"),
        ("", f'actuatorfrcrange="{-TORQUE} {TORQUE}"', "actuation of joint q saturates"),
    ],
)
def test_a_servo_that_saturates_lets_an_inverted_pendulum_fall(actuator, joint, note):
    mechanism = pendulum(joint=joint, actuator=SERVO.format(actuator))
    branch = mc.continue_equilibria(mechanism, "gravity_angle", bounds=(-1.0, 1.0))
    q = TORQUE / KP
    tilt = math.asin(TORQUE / GRAVITY) - q
    corners = branch.of_kind("CO")
    assert [p.note for p in corners] == [f"{note}; gravity_angle turns back: a non-smooth fold"] * 2
    assert sorted(abs(p["q"]) for p in corners) == pytest.approx([q, q], abs=1e-8)
    assert sorted(p["gravity_angle"] for p in corners) == pytest.approx([-tilt, tilt], abs=1e-8)
    inside = np.abs(branch["q"]) < q - 1e-6
    assert {p.stability for p, i in zip(map(branch.row, range(len(inside))), inside, strict=True) if i} == {"stable"}
    beyond = [branch.row(i) for i in np.flatnonzero(np.abs(branch["q"]) > q + 1e-6)]
    assert len(beyond) > 10
    assert {p.stability for p in beyond} == {"unstable"}


@pytest.mark.slow
def test_a_saturated_servo_goes_on_with_constant_force_and_no_longer_damps():
    servo = '<position name="servo" joint="x" kp="40" kv="3" forcerange="-8 8"/>'
    branch = mc.continue_equilibria(slider(actuator=servo), "F", bounds=(-20.0, 20.0))
    assert [p["F"] for p in branch.of_kind("CO")] == pytest.approx([-10.0, 10.0], abs=1e-9)
    beyond = branch["F"] > 10.0
    assert branch["x"][beyond] == pytest.approx((branch["F"][beyond] - 8.0) / SPRING, abs=1e-9)
    for force, damping in ((9.99, 4.0), (10.01, 1.0)):
        (point,) = branch.at(F=force)
        assert point.eigenvalues.real == pytest.approx(-damping / 2.0, rel=1e-6)


@pytest.mark.slow
def test_a_control_ceases_to_act_where_its_servo_saturates():
    servo = '<position name="servo" joint="x" kp="40" forcerange="-8 8"/>'
    branch = mc.continue_equilibria(slider(actuator=servo), "servo", bounds=(-2.0, 2.0))
    assert [p["servo"] for p in branch.of_kind("CO")] == pytest.approx([-1.0, 1.0], abs=1e-9)
    beyond = np.abs(branch["servo"]) > 1.0
    assert np.abs(branch["x"][beyond]) == pytest.approx(8.0 / SPRING, abs=1e-9)


def test_actuators_of_a_tendon_saturate_together():
    motors = '<general name="a" tendon="cable"/><general name="b" tendon="cable"/>'
    mechanism = slider(cable(band="0.5", more='actuatorfrcrange="-2 2"'), motors)
    branch = mc.continue_equilibria(mechanism, "a", bounds=(0.0, 4.0), start={"b": 0.5, "a": 0.5})
    (corner,) = branch.of_kind("CO")
    assert corner.note == "actuation of tendon cable saturates"
    assert corner["a"] == pytest.approx(1.5, abs=1e-7)
    assert branch["x"][-1] == pytest.approx(2.0 / (SPRING + CABLE), abs=1e-9)


def test_a_rope_touches_a_drum_where_the_geometry_has_it():
    mechanism = mc.Mechanism.from_xml(
        """<mujoco model="drum"><option gravity="0 0 0"/><worldbody><site name="O" pos="-1 0 0"/>
        <site name="above" pos="0 0 0.3"/>
        <geom name="drum" type="cylinder" size="0.2 0.1" pos="0 0 -0.3" euler="90 0 0" contype="0" conaffinity="0"/>
        <body pos="1 0 0"><joint name="z" type="slide" axis="0 0 1" stiffness="10" damping="1"/>
        <geom size="0.05" contype="0" conaffinity="0"/><site name="B"/></body></worldbody>
        <tendon><spatial name="rope" stiffness="50" springlength="1.9">
        <site site="O"/><geom geom="drum" sidesite="above"/><site site="B"/></spatial></tendon>
        <actuator><general name="F" joint="z"/></actuator></mujoco>"""
    )
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-10.0, 5.0))
    (corner,) = branch.of_kind("CO")
    assert corner.note == "contact of tendon rope and drum engages"
    z = brentq(lambda z: 0.3 + 0.5 * z - 0.2 * math.hypot(1.0, 0.5 * z), -0.5, 0.0, xtol=1e-14)
    tension = 50.0 * (math.hypot(2.0, z) - 1.9)
    assert corner["z"] == pytest.approx(z, abs=1e-8)
    assert corner["F"] == pytest.approx(10.0 * z + tension * z / math.hypot(2.0, z), abs=1e-7)


def test_a_stop_and_a_cable_make_corners_of_one_branch():
    stop = f'stiffness="{SPRING}" range="-1 0.4" solreflimit="-1e5 -100" solimplimit="0.9 0.9 0.001 0.5 2"'
    branch = mc.continue_equilibria(slider(cable(), joint=stop), "F", bounds=(0.0, 20.0))
    assert [p.note for p in branch.of_kind("CO")] == ["tendon cable goes taut", "upper limit of x engages"]
    assert [p["F"] for p in branch.of_kind("CO")] == pytest.approx([2.0, 4.0 + CABLE * 0.2], abs=1e-6)


def test_a_model_whose_forces_are_smooth_is_told_so_when_it_is_loaded():
    for name in ("overcentre", "nose_gear", "von_mises_truss"):
        mechanism = mc.Mechanism.from_xml(name)
        assert not mechanism.nonsmooth
        assert mechanism.active(mechanism.qpos0, mechanism.values()) == frozenset()


def test_disabled_springs_and_actuators_have_no_kinks():
    text = slider(cable(), '<position joint="x" forcerange="-1 1"/>').mjcf
    assert mc.Mechanism.from_xml(text).nonsmooth
    off = text.replace("<option", '<option><flag spring="disable" actuation="disable"/></option><option')
    assert not mc.Mechanism.from_xml(off).nonsmooth


@pytest.mark.slow
def test_a_corner_is_an_equilibrium_to_the_residual_that_its_row_states():
    # a bob on a stiff stop, turned by gravity: each corner is a row of the branch, and MuJoCo's own inverse dynamics
    # ask for no torque there
    xml = """<mujoco><worldbody><body><joint name="q" axis="0 1 0" stiffness="3" damping="1" limited="true"
      range="-40 30" solreflimit="-2000 -50"/><geom type="sphere" size=".1" mass="1" pos=".5 0 .3"/></body></worldbody>
      </mujoco>"""
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(xml), "gravity_angle", bounds=(-3.1, 3.1))
    corners = branch.of_kind("CO")
    assert len(corners) == 4
    m = mujoco.MjModel.from_xml_string(xml)
    for corner in corners:
        d = mujoco.MjData(m)
        angle = corner["gravity_angle"]
        m.opt.gravity[:] = -9.81 * np.sin(angle), 0.0, -9.81 * np.cos(angle)
        d.qpos[:] = corner.state
        mujoco.mj_inverse(m, d)
        assert abs(d.qfrc_inverse[0]) < 1e-12
        assert branch.residuals[corner.index] < 1e-14
        limit = np.radians(-40.0 if "lower" in corner.note else 30.0)
        assert corner.state[0] == pytest.approx(limit, abs=1e-9)
