"""States and switches in MuJoCo's data: activations, mocap poses, equality switches; against closed forms."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

import mjcont as mc

WEIGHT = 9.81


def slider(actuator: str, joint: str = 'stiffness="100" damping="20"') -> mc.Mechanism:
    """A mass of 1 kg on a vertical spring, with an actuator on the slide `z`."""
    return mc.Mechanism.from_xml(
        f"""<mujoco model="slider"><option gravity="0 0 -{WEIGHT}"/><worldbody><body>
        <joint name="z" type="slide" axis="0 0 1" {joint}/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
        <actuator>{actuator}</actuator></mujoco>"""
    )


def rest(mechanism: mc.Mechanism, **values: float) -> float:
    """Return where the slider rests."""
    return mc.find_equilibrium(mechanism, values)["z"]


# -- activations ---------------------------------------------------------------------------------------------

FILTERED = {
    "filter": '<general name="u" joint="z" dyntype="filter" dynprm="0.3" gainprm="50" biastype="affine" '
    'biasprm="0 -50 0"/>',
    "filterexact": '<position name="u" joint="z" kp="50" timeconst="0.3"/>',
    "filter that acts early": '<general name="u" joint="z" dyntype="filter" dynprm="0.3" actearly="true" '
    'gainprm="50" biastype="affine" biasprm="0 -50 0"/>',
}


@pytest.mark.parametrize("actuator", FILTERED.values(), ids=FILTERED.keys())
def test_a_filtered_servo_rests_where_the_unfiltered_one_does(actuator):
    assert rest(slider(actuator), u=0.4) == pytest.approx((50 * 0.4 - WEIGHT) / 150, abs=1e-12)


@pytest.mark.parametrize("actuator", FILTERED.values(), ids=FILTERED.keys())
def test_a_motion_from_rest_under_a_filtered_servo_stays_at_rest(actuator):
    mechanism = slider(actuator)
    point = mc.find_equilibrium(mechanism, {"u": 0.4})
    history = mc.simulate(mechanism, duration=1.0, start=point)
    assert np.ptp(history["z"]) < 1e-12


def test_an_activation_follows_its_control_with_its_time_constant():
    mechanism = slider('<general name="u" joint="z" dyntype="filterexact" dynprm="0.3"/>', 'damping="1e6"')
    history = mc.simulate(mechanism, {"u": lambda t: 1e6 * (t > 0), "load_factor": 0.0}, duration=2.0, timestep=1e-3)
    t = history["time"]
    travelled = t - 0.3 * (1 - np.exp(-t / 0.3))
    assert history["z"] == pytest.approx(travelled, abs=2e-3)


def test_an_activation_leaves_mass_damping_and_stiffness_as_they_are():
    plain = slider('<position name="u" joint="z" kp="50" kv="3"/>')
    filtered = slider('<position name="u" joint="z" kp="50" kv="3" timeconst="0.3"/>')
    for mechanism in (plain, filtered):
        point = mc.find_equilibrium(mechanism, {"u": 0.4})
        values = mechanism.values({"u": 0.4})
        pencil = mechanism.pencil(point.state, values, mechanism.linearize(point.state, values, ()).jac)
        assert (pencil.mass.item(), pencil.damping.item()) == pytest.approx((1.0, 23.0), rel=1e-12)
        assert pencil.stiffness.item() == pytest.approx(150.0, rel=1e-8)


def test_a_filtered_control_keeps_to_the_ranges_of_control_and_activation():
    mechanism = slider(
        '<general name="u" joint="z" dyntype="filter" dynprm="0.1" ctrlrange="-1 1" actlimited="true" '
        'actrange="-0.5 3"/>'
    )
    assert mechanism.parameter("u").hard_bounds == (-0.5, 1.0)
    with pytest.raises(mc.BoundsError, match=r"u = -0\.7 lies outside the actuator's .*actrange \[-0\.5, 1\]"):
        mechanism.values({"u": -0.7})


def test_an_integrated_velocity_servo_rests_at_its_setpoint():
    mechanism = slider('<intvelocity name="u" joint="z" kp="50" actrange="-1 2"/>')
    setpoint = mechanism.parameter("u")
    assert (setpoint.unit, setpoint.bounds, setpoint.hard_bounds) == ("m", (-1.0, 2.0), (-1.0, 2.0))
    assert rest(mechanism, u=0.4) == pytest.approx((50 * 0.4 - WEIGHT) / 150, abs=1e-12)
    with pytest.raises(mc.BoundsError, match=r"u = 3 lies outside the actuator's actrange \[-1, 2\]"):
        mechanism.values({"u": 3.0})


@pytest.mark.slow
def test_an_integrated_setpoint_can_be_continued_and_moved_in_time():
    mechanism = slider('<intvelocity name="u" joint="z" kp="50" actrange="-1 2"/>')
    branch = mc.continue_equilibria(mechanism, "u")
    assert branch["z"] == pytest.approx((50 * branch["u"] - WEIGHT) / 150, abs=1e-10)
    assert branch.status == "at bound"
    history = mc.simulate(mechanism, {"u": ([0.0, 1.0], [0.0, 1.0])}, duration=4.0, start={"u": 0.0})
    assert history["z"][-1] == pytest.approx((50 - WEIGHT) / 150, abs=1e-6)


def test_an_integrated_angle_is_in_radians():
    mechanism = mc.Mechanism.from_xml(
        """<mujoco><worldbody><body><joint name="hip" axis="0 1 0"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
        <actuator><intvelocity name="u" joint="hip" kp="5" actrange="-3 3"/></actuator></mujoco>"""
    )
    assert mechanism.parameter("u").unit == "rad"
    assert mc.find_equilibrium(mechanism, {"u": 0.7})["hip"] == pytest.approx(0.7, abs=1e-12)


def muscle_force(mechanism: mc.Mechanism, z: float, activation: float) -> float:
    """Return a muscle's force on the slide from MuJoCo's own gain and bias functions."""
    model = mechanism.simulation_model()
    args = model.actuator_lengthrange[0], float(model.actuator_acc0[0])
    gain = mujoco.mju_muscleGain(z, 0.0, *args, model.actuator_gainprm[0, :9])
    return float(gain * activation + mujoco.mju_muscleBias(z, *args, model.actuator_biasprm[0, :9]))


MUSCLE = '<muscle name="u" joint="z" lengthrange="-0.5 0.5" force="40"/>'


def test_a_muscle_balances_spring_and_weight_along_its_branch():
    mechanism = slider(MUSCLE)
    branch = mc.continue_equilibria(mechanism, "u")
    assert (branch["u"].min(), branch["u"].max()) == pytest.approx((0.0, 1.0))
    for u, z in zip(branch["u"], branch["z"], strict=True):
        assert muscle_force(mechanism, z, u) - 100 * z == pytest.approx(WEIGHT, abs=1e-7)


def test_a_muscle_moves_to_the_equilibrium_of_its_control():
    mechanism = slider(MUSCLE)
    history = mc.simulate(mechanism, {"u": 0.8}, duration=5.0, start={"u": 0.8})
    assert history["z"][-1] == pytest.approx(rest(mechanism, u=0.8), abs=1e-8)


def test_a_muscle_takes_no_more_than_full_excitation():
    with pytest.raises(mc.BoundsError, match=r"u = 1\.2 lies outside the actuator's muscle range \[0, 1\]"):
        slider(MUSCLE).values({"u": 1.2})


def test_an_actuator_sensor_reads_the_force_at_rest():
    mechanism = mc.Mechanism.from_xml(
        f"""<mujoco><option gravity="0 0 -{WEIGHT}"/><worldbody><body><joint name="z" type="slide" axis="0 0 1"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
        <actuator><position name="u" joint="z" kp="50" timeconst="0.3"/></actuator>
        <sensor><actuatorfrc name="force" actuator="u"/></sensor></mujoco>"""
    )
    assert mc.find_equilibrium(mechanism, {"u": 0.4})["force"] == pytest.approx(WEIGHT, abs=1e-9)


def test_notes_say_what_an_activation_is_at_rest():
    mechanism = slider(FILTERED["filter"] + '<intvelocity name="drive" joint="z" kp="50" actrange="-1 2"/>')
    assert "the activation of u equals the control" in mechanism.notes[0]
    assert "the control of drive is zero and its integral stays as it is" in mechanism.notes[1]
    assert all(note in str(mechanism) for note in mechanism.notes)


def test_a_delayed_control_has_arrived_at_rest_and_in_time_histories():
    mechanism = slider('<position name="u" joint="z" kp="50" delay="0.02" nsample="12"/>')
    point = mc.find_equilibrium(mechanism, {"u": 0.4})
    assert point["z"] == pytest.approx((50 * 0.4 - WEIGHT) / 150, abs=1e-12)
    assert np.ptp(mc.simulate(mechanism, duration=0.5, start=point)["z"]) < 1e-12


def test_an_actuator_with_several_inputs_has_a_parameter_for_each():
    mechanism = slider('<pid name="u" joint="z" kp="50" kv="2" input="pos ff"/><motor name="after" joint="z"/>')
    assert {"u.pos", "u.ff", "after"} <= set(mechanism.parameters)
    values = {"u.pos": 0.4, "u.ff": 3.0, "after": 2.0}
    assert rest(mechanism, **values) == pytest.approx((50 * 0.4 + 3 + 2 - WEIGHT) / 150, abs=1e-12)
    assert mechanism.declare("push", "control:u.ff", unit="N").targets[0].index == (1,)


def test_a_control_that_may_not_be_zero_starts_at_the_end_of_its_range():
    mechanism = slider('<motor name="u" joint="z" ctrlrange="2 5"/>')
    assert mechanism.parameter("u").value == 2.0
    assert rest(mechanism) == pytest.approx((2 - WEIGHT) / 100, abs=1e-12)


# -- mocap bodies --------------------------------------------------------------------------------------------

STIFF, LENGTH = 30.0, 1.0


def dragged(rest_of_it: str = "", joint: str = "") -> mc.Mechanism:
    """A weightless link of 1 m on a hinge with a spring of 30 N/m from its tip to a mocap body."""
    return mc.Mechanism.from_xml(
        f"""<mujoco model="dragged"><compiler angle="radian"/><option gravity="0 0 0"/><worldbody>
        <body name="hand" mocap="true" pos="2 0 0"><site name="grip"/><geom size="0.05" contype="0" conaffinity="0"/>
        </body>
        <body name="link"><joint name="hip" axis="0 -1 0" damping="1" {joint}/><site name="tip" pos="{LENGTH} 0 0"/>
        <inertial pos="1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/></body></worldbody>
        <tendon><spatial name="spring" stiffness="{STIFF}" springlength="0"><site site="grip"/><site site="tip"/>
        </spatial></tendon>
        <sensor><tendonpos name="stretch" tendon="spring"/><framepos name="hand" objtype="site" objname="grip"/>
        </sensor>{rest_of_it}</mujoco>"""
    )


@pytest.mark.parametrize("limits", ["", 'range="-3 3"'], ids=["free", "constrained"])
def test_a_link_on_a_spring_points_to_the_mocap_body_that_drags_it(limits):
    branch = mc.continue_equilibria(dragged(joint=limits), "mocap:hand.pos[2]", bounds=(-3.0, 3.0))
    height = branch["mocap:hand.pos[2]"]
    assert branch["hip"] == pytest.approx(np.arctan2(height, 2.0), abs=1e-9)
    assert branch["stretch"] == pytest.approx(np.hypot(height, 2.0) - LENGTH, abs=1e-9)
    assert branch["hand[2]"] == pytest.approx(height, abs=1e-14)
    assert set(branch.stability) == {"stable"}


@pytest.mark.slow
def test_the_link_swings_to_where_the_mocap_body_moves():
    mechanism = dragged()
    history = mc.simulate(mechanism, {"mocap:hand.pos[2]": ([0.0, 1.0], [0.0, 2.0])}, duration=30.0)
    assert history["hip"][-1] == pytest.approx(math.pi / 4, abs=1e-5)


def test_a_mocap_body_turns_what_it_carries():
    mechanism = mc.Mechanism.from_xml(
        """<mujoco><compiler angle="radian"/><option gravity="0 0 0"/><worldbody><body name="base" mocap="true">
        <site name="lug" pos="2 0 0"/></body>
        <body><joint name="hip" axis="0 -1 0" damping="1"/><site name="tip" pos="1 0 0"/>
        <inertial pos="1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/></body></worldbody>
        <tendon><spatial stiffness="30" springlength="0"><site site="lug"/><site site="tip"/></spatial></tendon>
        </mujoco>"""
    )
    mechanism.parameter("mocap:base.quat[2]")
    point = mc.find_equilibrium(mechanism, {"mocap:base.quat[2]": -math.tan(0.3)})
    assert point["hip"] == pytest.approx(0.6, abs=1e-9)


def test_poses_are_seen_with_the_mocap_body_in_place():
    from mjcont.drawing.viewer import posed

    mechanism = dragged()
    point = mc.find_equilibrium(mechanism, {"mocap:hand.pos[2]": 2.0})
    _, data = posed(mechanism, point.state, point.parameters)
    assert data.body("hand").xpos == pytest.approx([2.0, 0.0, 2.0])


def test_potential_energy_is_that_of_the_spring_to_the_mocap_body():
    from mjcont.mechanism.energy import potential_energy

    mechanism = dragged()
    found = potential_energy(mechanism, np.zeros((1, 1)), mechanism.values({"mocap:hand.pos[2]": 2.0}))
    assert found == pytest.approx([0.5 * STIFF * 5.0], rel=1e-12)


def test_a_stored_branch_along_a_mocap_body_finds_its_points_when_loaded(tmp_path):
    mc.continue_equilibria(dragged(), "mocap:hand.pos[2]", bounds=(-3.0, 3.0)).save(tmp_path / "a.h5")
    (point,) = mc.load(tmp_path / "a.h5").at(**{"mocap:hand.pos[2]": 2.0})
    assert point["hip"] == pytest.approx(math.pi / 4, abs=1e-9)


MOCAP_MISTAKES = {
    "its pose as a body": ("body:hand.pos[2]", r"mocap body 'hand' lives elsewhere: use mocap:hand\.pos"),
    "a body that is none": ("mocap:link.pos[0]", r"matches no mocap of the model\. Its mocap names: hand\."),
    "no such attribute": ("mocap:hand.mass", r"unknown attribute of a mocap body 'mass'.* Valid: pos, quat\."),
    "index too large": ("mocap:hand.pos[3]", r"index 3 is outside 0\.\.2"),
}


@pytest.mark.parametrize(("path", "message"), MOCAP_MISTAKES.values(), ids=MOCAP_MISTAKES.keys())
def test_a_wrong_mocap_path_is_an_error_that_says_what_is_right(path, message):
    with pytest.raises(mc.MjcontError, match=message):
        dragged().parameter(path)


# -- equality switches ---------------------------------------------------------------------------------------


def latched(active: str = "true") -> mc.Mechanism:
    """Two sliders on springs under weight, the second tied to the first by an equality."""
    return mc.Mechanism.from_xml(
        f"""<mujoco model="latch"><option gravity="0 0 -{WEIGHT}"/><worldbody>
        <body><joint name="a" type="slide" axis="0 0 1" stiffness="100" damping="5"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
        <body><joint name="b" type="slide" axis="0 0 1" stiffness="300" damping="5"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body></worldbody>
        <equality><joint name="latch" joint1="a" joint2="b" active="{active}" solref="-1e4 -100"
        solimp="0.9 0.9 0.001 0.5 2"/></equality>
        <actuator><motor name="push" joint="a"/></actuator></mujoco>"""
    )


def tied() -> np.ndarray:
    """Return where the sliders rest, tied by the spring k / ((1 - d) A) that MuJoCo's constraint is at rest."""
    spring = 1e4 / ((1 - 0.9) * 2.0)
    return np.linalg.solve([[100 + spring, -spring], [-spring, 300 + spring]], [-WEIGHT, -WEIGHT])


def test_one_model_is_latched_and_unlatched():
    mechanism = latched()
    closed = mc.find_equilibrium(mechanism, {"equality:latch.active": 1})
    opened = mc.find_equilibrium(mechanism, {"equality:latch.active": 0})
    assert (closed["a"], closed["b"]) == pytest.approx(tied(), abs=1e-9)
    assert (opened["a"], opened["b"]) == pytest.approx((-WEIGHT / 100, -WEIGHT / 300), abs=1e-12)


@pytest.mark.parametrize(("written", "value"), [("true", 1.0), ("false", 0.0)])
def test_a_switch_is_as_the_model_has_it(written, value):
    assert latched(written).parameter("equality:latch.active").value == value


def test_a_branch_unlatched_is_that_of_a_model_without_the_latch():
    branch = mc.continue_equilibria(
        latched(), "push", bounds=(-5, 5), start={"equality:latch.active": 0, "push": 0.0}
    )
    assert branch["a"] == pytest.approx((branch["push"] - WEIGHT) / 100, abs=1e-10)
    assert branch["b"] == pytest.approx(np.full(len(branch), -WEIGHT / 300), abs=1e-10)


@pytest.mark.slow
def test_opening_the_latch_lets_the_sliders_part_in_time():
    mechanism = latched()
    start = mc.find_equilibrium(mechanism, {"equality:latch.active": 1})
    history = mc.simulate(mechanism, {"equality:latch.active": lambda t: float(t < 1.0)}, duration=15.0, start=start)
    early = history["time"] < 0.9
    assert history.states[early] == pytest.approx(np.tile(tied(), (early.sum(), 1)), abs=1e-6)
    assert (history["a"][-1], history["b"][-1]) == pytest.approx((-WEIGHT / 100, -WEIGHT / 300), abs=1e-6)


def test_a_switch_can_be_turned_round():
    mechanism = latched()
    mechanism.declare("free", "equality:latch.active*-1+1")
    opened = mc.find_equilibrium(mechanism, {"free": 1})
    assert opened["a"] == pytest.approx(-WEIGHT / 100, abs=1e-12)


def test_a_switch_cannot_be_continued():
    with pytest.raises(mc.BoundsError, match=r"'equality:latch\.active' is a switch, 0 or 1, and cannot vary along"):
        mc.continue_equilibria(latched(), "equality:latch.active")


def test_a_switch_is_on_or_off():
    with pytest.raises(mc.ParameterError, match=r"'equality:latch\.active' is a switch: its value must be 0 or 1"):
        mc.find_equilibrium(latched(), {"equality:latch.active": 0.5})


@pytest.mark.slow
def test_other_values_stay_while_a_field_of_the_model_varies_in_time():
    mechanism = slider('<motor name="u" joint="z"/>')
    inputs = {"joint:z.stiffness": ([0.0, 1.0], [100.0, 200.0])}
    history = mc.simulate(mechanism, inputs, duration=5.0, start={"u": 4.0})
    assert history["z"][-1] == pytest.approx((4.0 - WEIGHT) / 200, abs=1e-6)


def test_a_study_that_would_vary_a_switch_is_told_where(tmp_path):
    (tmp_path / "latch.xml").write_text(latched().mjcf, encoding="utf-8")
    branch = '[[branch]]\nname = "a"\nparameter = "equality:latch.active"\n'
    (tmp_path / "latch.toml").write_text(f'model = "latch.xml"\n{branch}', encoding="utf-8")
    with pytest.raises(mc.StudyError, match=r"branch\[0\]\.parameter: 'equality:latch\.active' is a switch"):
        mc.load_study(tmp_path / "latch.toml")
