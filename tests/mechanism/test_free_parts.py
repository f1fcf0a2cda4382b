"""Free motions of parts: a wheel, a rod between two balls, a block on a rail. They are named and held."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc

APART = 'contype="0" conaffinity="0"'
LEVER = f"""<body name="lever"><joint name="lever" axis="0 1 0" stiffness="2" damping=".1"/>
  <geom type="capsule" size=".02" fromto="0 0 0 .3 0 0" mass="1" {APART}/>{{}}</body>"""
WHEEL = f"""<body name="wheel" pos="{{}}"><joint name="wheel" axis="0 1 0" damping=".1"/>
  <geom type="sphere" size=".1" mass="1" {APART}/>{{}}</body>"""
DRIVE = '<motor name="T" joint="lever" ctrlrange="-1 1" ctrllimited="true"/>'


def model(world, actuator=DRIVE, rest=""):
    return mc.Mechanism.from_xml(
        f"<mujoco><worldbody>{world}</worldbody><actuator>{actuator}</actuator>{rest}</mujoco>"
    )


def held(mechanism):
    return mechanism.rigid_modes(mechanism.start_state(), mechanism.values())


@pytest.mark.slow
def test_a_lever_beside_a_balanced_wheel_is_followed_and_the_wheel_is_held():
    branch = mc.continue_equilibria(model(LEVER.format("") + WHEEL.format("1 0 0", "")), "T")
    assert branch.notes == ("rigid-body zero modes held: rotation of wheel about (0, 1, 0)",)
    assert set(branch.stability) == {"stable"}
    # 2 q = T + m g r cos q, by hand
    q = branch["lever"]
    np.testing.assert_allclose(2.0 * q, branch["T"] + 9.81 * 0.15 * np.cos(q), atol=1e-9)
    np.testing.assert_array_equal(branch["wheel"], 0.0)
    assert [word for word, _ in branch.ends] == ["at bound", "at bound"]


@pytest.mark.slow
def test_a_wheel_on_a_lever_is_free_about_its_axle_wherever_that_is():
    branch = mc.continue_equilibria(model(LEVER.format(WHEEL.format(".3 0 0", ""))), "T")
    assert "rotation of wheel about (0, 1, 0)" in branch.notes[0]
    q = branch["lever"]
    np.testing.assert_allclose(2.0 * q, branch["T"] + 9.81 * (0.15 + 0.3) * np.cos(q), atol=1e-9)
    assert set(branch.stability) == {"stable"}


@pytest.mark.parametrize(
    "hub",
    [
        '<geom type="sphere" size=".01" pos=".05 0 0" mass=".1" contype="0" conaffinity="0"/>',
        '<site name="rim" pos=".1 0 0"/>',
    ],
)
def test_a_wheel_that_something_turns_back_is_not_free(hub):
    spring = '<tendon><spatial stiffness="3"><site site="post"/><site site="rim"/></spatial></tendon>'
    world = LEVER.format("") + WHEEL.format("1 0 0", hub) + '<site name="post" pos="1 0 .5"/>'
    assert held(model(world, rest=spring if "rim" in hub else "")) == ()


def test_a_motor_that_turns_a_free_wheel_is_refused_by_the_wheels_name():
    mechanism = model(LEVER.format("") + WHEEL.format("1 0 0", ""), '<motor name="T" joint="wheel"/>')
    with pytest.raises(mc.StartError, match=r"T pushes along .* mode 'rotation of wheel about \(0, 1, 0\)'"):
        mc.continue_equilibria(mechanism, "T", bounds=(-1, 1))


@pytest.mark.slow
def test_a_rod_between_two_balls_spins_about_its_own_axis():
    rod = f"""<body name="rod" pos="0 0 1"><joint type="ball" damping=".1"/>
      <geom type="capsule" size=".02" fromto="0 0 0 .3 .4 0" mass="1" {APART}/></body>"""
    arm = f"""<body name="arm" pos=".3 .9 1"><joint name="arm" axis="0 0 1" damping=".1" stiffness="5"/>
      <geom type="capsule" size=".02" fromto="0 0 0 0 -.5 0" mass="1" {APART}/></body>"""
    tie = '<equality><connect body1="rod" body2="arm" anchor=".3 .4 0"/></equality>'
    mechanism = model(rod + arm, '<motor name="T" joint="arm"/>', tie)
    assert held(mechanism) == ("rotation of rod about (0.6, 0.8, 0)",)
    point = mc.find_equilibrium(mechanism)
    assert (point.stability, point.n_unstable) == ("stable", 0)
    branch = mc.continue_equilibria(mechanism, "T", bounds=(-0.5, 0.5))
    assert [word for word, _ in branch.ends] == ["at bound", "at bound"]
    assert set(branch.stability) == {"stable"}


@pytest.mark.slow
def test_a_rod_between_ball_joints_of_a_chain_spins_too():
    chain = f"""<body name="rod" pos="0 0 1"><joint type="ball" damping=".1"/>
      <geom type="capsule" size=".02" fromto="0 0 0 0 0 -.5" mass="1" {APART}/>
      <body name="bob" pos="0 0 -.5"><joint type="ball" damping=".1"/><geom size=".1" pos=".1 0 -.2" mass="1" {APART}/>
      </body></body>"""
    mechanism = model(chain + LEVER.format(""))
    assert "rotation of rod about (0, 0, 1)" in held(mechanism)
    assert mc.find_equilibrium(mechanism).stability == "stable"


def test_a_block_on_a_level_rail_slides():
    block = f"""<body name="block" pos="0 1 0"><joint name="s" type="slide" axis="0 1 0" damping="1"/>
      <geom type="box" size=".1 .1 .1" mass="1" {APART}/></body>"""
    mechanism = model(LEVER.format("") + block)
    assert held(mechanism) == ("translation of block along (0, 1, 0)",)
    tilted = model(LEVER.format("") + block.replace('axis="0 1 0" damping="1"', 'axis="0 1 .1" damping="1"'))
    assert held(tilted) == ()


@pytest.mark.slow
def test_a_turntable_with_a_load_is_free_as_one():
    table = f"""<body name="table" pos="2 0 0"><joint name="turn" axis="0 0 1" damping="1"/>
      <geom type="cylinder" size=".5 .02" mass="1" {APART}/>
      <body name="mast" pos=".3 0 0"><joint name="mast" axis="0 1 0" stiffness="30" damping="1"/>
        <geom size=".05" pos="0 0 .3" mass="1" {APART}/></body></body>"""
    mechanism = model(LEVER.format("") + table)
    assert held(mechanism) == ("rotation of table and what it carries about (0, 0, 1)",)
    assert mc.find_equilibrium(mechanism).stability == "stable"


@pytest.mark.long
def test_equilibria_of_the_lever_are_told_apart_and_places_of_the_wheel_are_not():
    # an inverted pendulum on a soft spring: 2 (q - 0) = m g r sin q has three solutions
    lever = LEVER.format(WHEEL.format("0 0 .3", "")).replace("fromto=\"0 0 0 .3 0 0\"", 'fromto="0 0 0 0 0 .3"')
    found = mc.find_equilibria(model(lever), starts=40)
    assert len(found) == 3
    assert sorted(e.n_unstable for e in found) == [0, 0, 1]


def test_the_name_of_a_body_without_one_is_its_joints():
    mechanism = model(LEVER.format("") + WHEEL.format("1 0 0", "").replace('body name="wheel"', "body"))
    assert held(mechanism) == ("rotation of wheel about (0, 1, 0)",)


@pytest.mark.slow
def test_a_pendulum_on_a_ball_joint_turns_about_the_vertical_wherever_the_lever_carries_it():
    hanging = f"""<body name="bob" pos=".3 0 0"><joint name="ball" type="ball" damping=".1"/>
      <geom type="capsule" size=".02" fromto="0 0 0 .1 0 -.3" mass="1" {APART}/></body>"""
    branch = mc.continue_equilibria(model(LEVER.format(hanging)), "T", state=[0.6, 1.0, 0.0, 0.3, 0.0])
    assert "rotation of bob about the ground's (0, 0, 1)" in branch.notes[0]
    # 2 q = T + g r cos q with the bob's mass at the lever's end, by hand
    q = branch["lever"]
    np.testing.assert_allclose(2.0 * q, branch["T"] + 9.81 * (0.15 + 0.3) * np.cos(q), atol=1e-9)
    assert set(branch.stability) == {"stable"}
    assert [word for word, _ in branch.ends] == ["at bound", "at bound"]
