"""Rigid pins made elastic: the folds of four linkages against equations written by hand, and what survives the edit."""

from __future__ import annotations

import math
from functools import cache

import mujoco
import numpy as np
import pytest
from problems.linkages import LINKAGES, QUICK_FIRST, elastic_folds, rigid_folds

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.models.bushes import add_bushes, bushed_xml

TURNS = {"four_bar": (-3.0, 3.0), "slider_crank": (-3.0, 3.0), "watt_six_bar": (-3.0, 3.0), "rssr": (-1.2, 1.6)}
FOLDS = {"four_bar": 2, "slider_crank": 3, "watt_six_bar": 4, "rssr": 3}

# two bars, A-B and C-B, in the plane at right angles to (1, 1, 0), that meet at B; not along any axis of the ground
ROOF = """
<mujoco model="roof">
  <!-- a comment that stays -->
  <compiler angle="radian"/>
  <default>{default}</default>
  <worldbody>
    <body name="left">
      <joint name="A" axis="1 1 0"/>
      <geom size="0.1" pos="0.5 -0.5 1"/>
      <body name="left_end" pos="0.5 -0.5 1"><joint name="mid" axis="1 1 0"/><geom size="0.1" pos="0.5 -0.5 1"/></body>
    </body>
    <body name="right" pos="2 -2 0">
      <joint name="C" axis="1 1 0"/>
      <geom size="0.1" pos="-1 1 2"/>
    </body>
  </worldbody>
  <contact><exclude name="apart" body1="left_end" body2="right"/></contact>
  <equality>{equality}</equality>
  <actuator><motor name="push" joint="C"/></actuator>
  <sensor><jointpos name="angle" joint="C"/></sensor>
  {rest}
</mujoco>"""
CONNECT = '<connect name="B" body1="left_end" body2="right" anchor="0.5 -0.5 1"/>'


def roof(*, default="", equality=CONNECT, rest=""):
    return ROOF.format(default=default, equality=equality, rest=rest)


@cache
def rigid(name):
    return rigid_folds(LINKAGES[name], TURNS[name])


@cache
def elastic(name, stiffness):
    return elastic_folds(LINKAGES[name], stiffness, rigid(name)[:, 0])


def folds(name, stiffness, **options):
    """Return (turn, M) of the folds that mjcont finds on a linkage with bushes."""
    mechanism = mc.Mechanism.from_xml(bushed_xml(name, stiffness=stiffness, **options))
    start = mechanism.qpos0[mechanism.state_labels.index(("crank", "rad"))]
    window = tuple(start + t for t in TURNS[name])
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), start={"M": 0.0}, limits={"crank": window})
    return np.array(sorted((p["crank"] - start, p["M"]) for p in branch.of_kind("LP")))


def model_of(text):
    return mujoco.MjModel.from_xml_string(text)


# -- folds -----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK_FIRST)
def test_folds_equal_those_of_the_equations_written_by_hand(name):
    found = folds(name, 1e6)
    assert len(found) == FOLDS[name]
    np.testing.assert_allclose(found, elastic(name, 1e6), rtol=0, atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK_FIRST)
def test_folds_approach_those_of_the_rigid_linkage_at_rate_1_over_k(name):
    errors = [folds(name, k) - rigid(name) for k in (1e5, 1e6)]
    assert np.abs(errors[1][:, 1]).max() < 0.02
    np.testing.assert_allclose(errors[0] / errors[1], 10.0, rtol=0.02)


@pytest.mark.slow
def test_more_elastic_pins_than_needed_keep_the_rigid_limit_and_the_rate():
    errors = [folds("four_bar", k, joints=["crank", "pin_B", "rocker"]) - rigid("four_bar") for k in (1e5, 1e6)]
    assert np.abs(errors[1][:, 1]).max() < 1e-3
    np.testing.assert_allclose(errors[0] / errors[1], 10.0, rtol=0.02)


@pytest.mark.slow
def test_equal_stiffness_along_all_axes_makes_the_frame_indifferent():
    world, parent = (folds("four_bar", 1e4, joints=["pin_B"], frame=frame) for frame in ("world", "parent"))
    np.testing.assert_allclose(world, parent, rtol=0, atol=1e-8)


@pytest.mark.slow
def test_an_elastic_ball_joint_keeps_the_rigid_limit():
    soft, stiff = (folds("rssr", k, joints=["ball_B"]) - rigid("rssr") for k in (1e5, 1e6))
    np.testing.assert_allclose(soft / stiff, 10.0, rtol=0.02)


# -- what is added ---------------------------------------------------------------------------------------------------


def test_a_planar_pin_becomes_two_slides_before_its_hinge():
    model = model_of(bushed_xml("four_bar", joints=["pin_B"], stiffness=2e5, damping=30.0))
    names = [model.joint(j).name for j in range(model.njnt)]
    assert names == ["crank", "bush_pin_B_x", "bush_pin_B_z", "pin_B", "rocker"]
    np.testing.assert_array_equal(model.jnt_stiffness[1:3], 2e5)
    np.testing.assert_array_equal(model.dof_damping[1:3], 30.0)


def test_a_spatial_closure_becomes_three_elements_and_a_planar_one_two():
    assert model_of(bushed_xml("rssr")).nu == 4
    assert model_of(bushed_xml("four_bar")).nu == 3


def test_the_parameters_of_the_bushes_act_on_all_of_them():
    mechanism = mc.Mechanism.from_spec(add_bushes("four_bar", joints=["crank"], stiffness=3e5, damping=7.0))
    assert mechanism.parameters["k_bush"].value == 3e5
    assert mechanism.parameters["c_bush"].value == 7.0
    assert len(mechanism.parameters["k_bush"].entries) == 4


def test_a_bush_resists_with_stiffness_times_gap_in_a_plane_of_any_direction():
    mechanism = mc.Mechanism.from_xml(bushed_xml(roof(), stiffness=1e4))
    values = mechanism.values({"load_factor": 0.0})
    turn, arm = 1e-3, math.sqrt(6.0)  # from C to B
    moment = mechanism.residual(mechanism.qpos0 + [0.0, 0.0, turn], values)[2]
    assert moment == pytest.approx(-1e4 * arm * turn * arm, rel=1e-5)


def test_axes_of_a_tilted_plane_are_unit_vectors_in_it():
    model = model_of(bushed_xml(roof(), frame="parent"))
    gear = model.actuator_gear[1:, :3]
    np.testing.assert_allclose(gear @ gear.T, np.eye(2), atol=1e-15)
    np.testing.assert_allclose(gear @ [1, 1, 0], 0.0, atol=1e-15)


def test_a_weld_becomes_two_translations_and_one_rotation_in_a_plane():
    weld = '<weld name="B" body1="left_end" body2="right" anchor="-1 1 2"/>'
    mechanism = mc.Mechanism.from_xml(bushed_xml(roof(equality=weld), stiffness=1e5))
    assert mechanism.bushes == ["bush_B_u", "bush_B_v", "bush_B_rw"]
    values = mechanism.values({"load_factor": 0.0, "k_bush": 1.0, "k_turn": 1e5})
    moment = mechanism.residual(mechanism.qpos0 + [0.0, 0.0, 0.01], values)
    np.testing.assert_allclose(moment, [1e3, 1e3, -1e3], rtol=1e-3)


def test_a_weld_in_space_is_relaxed_in_its_pose():
    text = """<mujoco><worldbody>
      <body name="a" quat="0.9 0.1 0.3 0.2"><freejoint/><geom size="0.1"/></body>
      <body name="b" pos="1 2 3" quat="0.5 -0.5 0.1 0.7"><freejoint/><geom size="0.1"/></body></worldbody>
      <equality><weld body1="a" body2="b" anchor="0.1 0.2 0.3"/></equality></mujoco>"""
    model = model_of(bushed_xml(text))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert model.nu == 6
    np.testing.assert_allclose(data.actuator_length, 0.0, atol=1e-14)


def test_the_models_own_defaults_do_not_reach_the_bushes():
    default = '<joint ref="0.1" armature="3" damping="9" stiffness="5" limited="true" range="-1 1"/>'
    default += '<motor ctrllimited="true" ctrlrange="-1 1" forcelimited="true" forcerange="-1 1"/>'
    with pytest.warns(UserWarning):  # ref turns the pins off the pose that the connect is for
        text = bushed_xml(roof(default=default, rest='<keyframe><key qpos="1 1 1"/></keyframe>'), joints=["mid"])
    model = model_of(text)
    slides = [model.joint(f"bush_mid_{s}") for s in "uv"]
    assert [(s.stiffness[0], s.armature[0], s.qpos0[0], model.jnt_limited[s.id]) for s in slides] == [
        (1e6, 0, 0, 0)
    ] * 2
    assert not model.actuator_forcelimited[1:].any() and not model.actuator_ctrllimited[1:].any()


# -- what survives ---------------------------------------------------------------------------------------------------


def test_keyframes_get_zeros_for_the_slides():
    text = roof(rest='<keyframe><key name="k" qpos="0.1 0.2 0.3" ctrl="5"/></keyframe>')
    with pytest.warns(UserWarning, match="open by"):
        model = model_of(bushed_xml(text, joints=["mid", "C"]))
    at = [model.joint(n).qposadr[0] for n in ("A", "mid", "C")]
    np.testing.assert_array_equal(model.key_qpos[0, at], [0.1, 0.2, 0.3])
    assert np.count_nonzero(model.key_qpos) == 3
    np.testing.assert_array_equal(model.key_ctrl[0], [5.0, 0.0, 0.0])


def test_every_pin_of_the_nose_gear_can_be_elastic_and_its_locked_pose_stays_assembled():
    names = ["theta_1", "theta_2", "angle_B", "angle_Bb", "theta_ov"]
    mechanism = mc.Mechanism.from_xml(bushed_xml("nose_gear", joints=names))
    assert mechanism.n == 15
    model = mujoco.MjModel.from_xml_string(mechanism.mjcf)
    data = mujoco.MjData(model)
    data.qpos[:] = mechanism.keyframes["downlock_below"]
    mujoco.mj_forward(model, data)
    bushes = [i for i in range(model.nu) if model.actuator(i).name.startswith("bush_")]
    np.testing.assert_allclose(data.actuator_length[bushes], 0.0, atol=1e-12)


def test_a_model_with_bushes_of_its_own_gets_parameters_for_the_new_ones_only():
    mechanism = mc.Mechanism.from_xml(bushed_xml("nose_gear", joints=["theta_2"], stiffness=5e5))
    assert mechanism.parameters["k_bush"].value == 5e5
    assert len(mechanism.parameters["k_bush"].entries) == 2


def test_sensors_actuators_excludes_and_comments_stay():
    text = bushed_xml(roof())
    model = model_of(text)
    assert "a comment that stays" in text
    assert model.sensor("angle").objid[0] == model.joint("C").id
    assert model.actuator("push").trnid[0] == model.joint("C").id
    assert model.nexclude == 1 and model.neq == 0


def test_a_spec_and_its_text_give_the_same_model():
    spec = mujoco.MjSpec.from_string(roof())
    a, b = model_of(bushed_xml(roof())), add_bushes(spec).compile()
    for field in ("actuator_gear", "actuator_biasprm", "site_pos", "body_pos", "body_mass", "jnt_axis"):
        np.testing.assert_allclose(getattr(a, field), getattr(b, field), atol=1e-15)


def test_a_model_made_of_included_files_gets_bushes_too(tmp_path):
    whole = roof()
    start, end = whole.index("<worldbody>"), whole.index("</worldbody>") + len("</worldbody>")
    (tmp_path / "bodies.xml").write_text(f"<mujoco>{whole[start:end]}</mujoco>")
    (tmp_path / "roof.xml").write_text(f'{whole[:start]}<include file="bodies.xml"/>{whole[end:]}')
    with_include = model_of(bushed_xml(tmp_path / "roof.xml", joints=["mid"]))
    in_one = model_of(bushed_xml(whole, joints=["mid"]))
    np.testing.assert_allclose(with_include.jnt_axis, in_one.jnt_axis, atol=1e-15)


def test_bushes_can_be_added_in_two_goes():
    once = bushed_xml("four_bar", stiffness=1e5)
    twice = mc.Mechanism.from_xml(bushed_xml(once, joints=["pin_B"], stiffness=2e5))
    assert (twice.parameters["k_bush"].value, twice.parameters["k_bush_2"].value) == (1e5, 2e5)


# -- mistakes --------------------------------------------------------------------------------------------------------


def test_a_connect_between_bodies_that_a_keyframe_opens_is_reported():
    text = roof(rest='<keyframe><key name="closed" qpos="0 0 0.1"/></keyframe>')
    with pytest.warns(UserWarning, match="connect 'B' is open by 0.245 m at keyframe 'closed'.*second point at qpos0"):
        bushed_xml(text)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"joints": ["pin_b"]}, "unknown joint 'pin_b'. Did you mean pin_B?"),
        ({"connects": ["D"]}, "unknown connect or weld 'D'. Valid: C."),
        ({"stiffness": 0.0}, "stiffness must be a positive number"),
        ({"damping": -1.0}, "damping not negative"),
        ({"frame": "body"}, "unknown frame 'body'. Valid: parent, world."),
        ({"connects": []}, "nothing to make elastic"),
    ],
)
def test_a_mistake_is_an_error_that_names_the_choices(options, message):
    with pytest.raises(mc.MjcontError) as caught:
        bushed_xml("four_bar", **options)
    assert message in str(caught.value)


def test_a_slide_cannot_be_made_elastic():
    with pytest.raises(mc.ModelError, match="joint 'slider' is neither a hinge nor a ball joint"):
        bushed_xml("slider_crank", joints=["slider"])


def test_a_coupling_of_joints_cannot_be_made_elastic():
    text = roof(equality='<joint name="gears" joint1="A" joint2="C"/>')
    with pytest.raises(mc.ModelError, match="equality 'gears' is not an active connect or weld"):
        bushed_xml(text, connects=["gears"])


# -- the command -----------------------------------------------------------------------------------------------------


def test_the_command_writes_a_model_that_inspect_understands(tmp_path, capsys):
    out = tmp_path / "elastic.xml"
    assert main(["bush", "four_bar", "-o", str(out), "--joint", "pin_B", "--stiffness", "1e5"]) == 0
    assert main(["inspect", str(out)]) == 0
    printed = capsys.readouterr().out
    assert "k_bush" in printed and "closed by bush C" in printed


def test_the_command_does_not_overwrite_its_model(tmp_path, capsys):
    model = tmp_path / "roof.xml"
    model.write_text(roof())
    assert main(["bush", str(model), "-o", str(model)]) == 2
    assert "is the model itself" in capsys.readouterr().err
    assert model.read_text() == roof()
