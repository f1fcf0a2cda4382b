"""Damping at rest of actuators whose force depends on velocity, against closed forms and MuJoCo's own accelerations."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import mjcont as mc

MASS_ON_MUSCLE = """<mujoco><option gravity="0 0 0"/><worldbody><site name="a"/><body pos="1 0 0">
  <joint name="x" type="slide" axis="1 0 0" stiffness="2000" {joint}/><geom size=".1" mass="1"/><site name="b"/>
  </body></worldbody>
  <tendon><spatial name="t"><site site="a"/><site site="b"/></spatial></tendon>
  <actuator><muscle name="m" tendon="t" lengthrange=".9 1.1" force="100" {muscle}/></actuator></mujoco>"""
STOP = 'range="-.3 .3" limited="true"'

# a driven hinge beside a pin whose stiffness and damping make the forces noisy, and one that a muscle pulls
ARM = """<mujoco><option {option}/><worldbody><site name="a" pos="0 0 .3"/>
  <body><joint name="s" axis="0 1 0" damping=".3" {joint}/><geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/>
    <site name="b" pos=".1 0 .01"/>
    <body pos=".3 0 0"><joint name="e" axis="0 1 0" stiffness="1e6" damping="1e4"/>
      <geom type="capsule" size=".02" fromto="0 0 0 .3 0 0"/><site name="c" pos=".1 0 .01"/></body></body></worldbody>
  <tendon><spatial name="t"><site site="a"/><site site="b"/></spatial>
    <spatial name="u"><site site="a"/><site site="c"/></spatial></tendon>
  <actuator>{actuator}</actuator></mujoco>"""
MUSCLES = (
    '<muscle name="m" tendon="t" lengthrange=".1 .5" force="100"/>'
    '<muscle name="n" tendon="u" lengthrange=".1 .6" force="50" vmax=".4"/>'
)


def damping(mechanism, state, **values):
    values = mechanism.values(values)
    jac = mechanism.linearize(np.array(state), values, ()).jac
    return mechanism.pencil(np.array(state), values, jac).damping


def measured(xml, state, h, **controls):
    """Return -M d(qacc)/dv of MuJoCo itself at rest, extrapolated from centred steps 2 h and h, (nv, nv)."""
    model = mujoco.MjModel.from_xml_string(xml)
    data, mass = mujoco.MjData(model), np.empty((model.nv, model.nv))

    def acceleration(velocity):
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = state, velocity
        for name, value in controls.items():
            actuator = model.actuator(name).id
            data.ctrl[actuator] = value
            if model.actuator_actadr[actuator] >= 0:
                data.act[model.actuator_actadr[actuator]] = value
        mujoco.mj_forward(model, data)
        return data.qacc.copy()

    def centred(h):
        return np.array([acceleration(-h * e) - acceleration(h * e) for e in np.eye(model.nv)]).T / (2.0 * h)

    rates = 2.0 * centred(h) - centred(2.0 * h)
    mujoco.mj_fullM(model, data, mass)
    return mass @ rates


@pytest.mark.parametrize("activation", [0.2, 1.0])
@pytest.mark.parametrize("joint", ["", STOP])
def test_a_muscle_resists_by_the_slope_of_its_force_velocity_curve(activation, joint):
    # FV'(0) = 2 and V = v / (L_0 v_max): c = 2 a |F| / (L_0 v_max), the force itself being that at rest
    mechanism = mc.Mechanism.from_xml(MASS_ON_MUSCLE.format(joint=joint, muscle=""))
    point = mc.find_equilibrium(mechanism, {"m": activation})
    model = mechanism.simulation_model()
    prm, reach = model.actuator_gainprm[0], model.actuator_lengthrange[0]
    optimum = (reach[1] - reach[0]) / (prm[1] - prm[0])
    passive = mujoco.mju_muscleBias(1.0 + point["x"], reach, model.actuator_acc0[0], model.actuator_biasprm[0, :9])
    active = -2000.0 * point["x"] + passive
    assert damping(mechanism, point.state, m=activation) == pytest.approx(2.0 * active / (optimum * prm[6]), rel=1e-6)


@pytest.mark.slow
def test_motions_of_a_mass_on_a_muscle_decay_as_its_eigenvalues_say():
    mechanism = mc.Mechanism.from_xml(MASS_ON_MUSCLE.format(joint="", muscle=""))
    branch = mc.continue_equilibria(mechanism, "m", bounds=(0.1, 1.0), start={"m": 0.5})
    assert [check.verdict for check in mc.verify_stability(branch, n=3).certificate] == ["confirmed"] * 3


@pytest.mark.parametrize("option", ["", 'density="1.2" viscosity="1e-3"', 'density="1000" viscosity="1"'])
@pytest.mark.parametrize("joint", ["", 'range="-60 30" limited="true"'])
def test_muscles_beside_stiff_dampers_in_a_fluid(option, joint):
    xml, state = ARM.format(option=option, actuator=MUSCLES, joint=joint), [0.04, 0.001]
    found = damping(mc.Mechanism.from_xml(xml), state, m=0.7, n=0.4)
    np.testing.assert_allclose(found, measured(xml, state, 1e-4, m=0.7, n=0.4), rtol=1e-5, atol=1e-6)


def test_a_dc_motor_brakes_by_its_back_emf():
    motor = '<dcmotor name="m" joint="s" motorconst=".05" resistance=".4" gear="50"/>'
    mechanism = mc.Mechanism.from_xml(ARM.format(option="", joint="", actuator=motor))
    assert damping(mechanism, [0.1, 0.0], m=3.0)[0, 0] == pytest.approx(0.3 + (50 * 0.05) ** 2 / 0.4, rel=1e-9)


@pytest.mark.parametrize("state", [0.0, 0.001, 0.1])
def test_a_dc_motor_whose_voltage_saturates_in_motion_resists_as_at_rest(state):
    # torque K/R v with v = clip((R/K)(-kp l - kd dl), +-1 V) + K dl: kp |l| beyond K/R = 0.125 N m is clipped
    motor = (
        '<dcmotor name="m" joint="s" motorconst=".05" resistance=".4" gear="50" input="pos" controller="2 0 .3 0 0 1"/>'
    )
    xml = ARM.format(option="", joint="", actuator=motor)
    found = damping(mc.Mechanism.from_xml(xml), [state, 0.0], m=0.0)
    np.testing.assert_allclose(found, measured(xml, [state, 0.0], 1e-6, m=0.0), rtol=1e-5, atol=1e-4)


def test_an_affine_gain_resists_in_proportion_to_its_control():
    servo = (
        '<general name="m" joint="s" gaintype="affine" gainprm="1 2 -3" biastype="affine" biasprm="1 -2 -5" gear="2"/>'
    )
    mechanism = mc.Mechanism.from_xml(ARM.format(option="", joint="", actuator=servo))
    assert damping(mechanism, [0.1, 0.0], m=1.3)[0, 0] == pytest.approx(0.3 + 4 * (3 * 1.3 + 5), rel=1e-12)


def test_a_gain_that_drives_with_velocity_makes_a_hopf_point():
    # q'' + (c - g u) q' + k q = 0 crosses the axis at u = c / g
    drive = '<general name="u" joint="q" gaintype="affine" gainprm="0 0 4" biastype="none"/>'
    mechanism = mc.Mechanism.from_xml(f"""<mujoco><option gravity="0 0 0"/><worldbody><body>
      <joint name="q" axis="0 1 0" stiffness="5" damping="2"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      </body></worldbody><actuator>{drive}</actuator></mujoco>""")
    (point,) = mc.continue_equilibria(mechanism, "u", bounds=(0.0, 1.0)).of_kind("HB")
    assert point["u"] == pytest.approx(0.5, abs=1e-9)
    assert point.coefficients["omega"] == pytest.approx(5.0**0.5, rel=1e-9)


@pytest.mark.parametrize("path", ["actuator:drive.biasprm[2]", "joint:x.damping"])
def test_a_parameter_that_turns_a_damper_into_a_drive_makes_rest_unstable(path):
    driven = mc.Mechanism.from_xml("""<mujoco><option gravity="0 0 0"/><worldbody><body>
        <joint name="x" type="slide" stiffness="5" damping="0.1"/><geom size=".1" mass="1"/></body></worldbody>
        <actuator><general name="drive" joint="x" biastype="affine" biasprm="0 0 0"/></actuator></mujoco>""")
    driven.declare("c", path, bounds=(-1.0, 1.0))
    unstable = 0.1 if "drive" in path else 0.0
    rest = mc.continue_equilibria(driven, "c", (-1.0, 1.0))
    assert rest.point("HB1")["c"] == pytest.approx(unstable, abs=1e-9)
    assert {rest.stability[0], rest.stability[-1]} == {"stable", "unstable"}
