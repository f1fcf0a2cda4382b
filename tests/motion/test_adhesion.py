"""Adhesion that lets go: the force drops to nothing, equilibria break off, and the door that it held swings open."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

import mjcont as mc

SPRING, PULL, ARM = 20.0, 40.0, 0.9

# a sprung door of 0.1 m half thickness, held to a post 0.9 m from its hinge; M opens it, clockwise
DOOR = f"""<mujoco><option gravity="0 0 0"/><worldbody>
  <geom name="post" type="sphere" size=".05" pos="{ARM} .15 0" friction="0" condim="1" {{margin}}/>
  <body name="door"><joint name="q" axis="0 0 1" stiffness="{SPRING}" damping="2"/>
    <geom name="leaf" type="box" size=".5 .1 .4" pos=".5 0 0" mass="5" friction="0" condim="1" {{margin}}/></body>
  </worldbody><actuator><adhesion name="hold" body="door" ctrlrange="0 1" gain="{PULL}"/>
  <motor name="M" joint="q" gear="-1"/></actuator></mujoco>"""


def door(margin=""):
    return mc.Mechanism.from_xml(DOOR.format(margin=margin))


@pytest.mark.slow
def test_equilibria_end_where_the_adhesion_lets_go():
    branch = mc.continue_equilibria(door(), "M", bounds=(0.0, 80.0), start={"hold": 1.0})
    status, sentence = branch.ends[-1]
    assert status == "breaks off"
    assert sentence == "contact of post and leaf releases: forces jump, and no equilibria follow at M = 36"
    (corner,) = branch.special_points
    assert corner["M"] == pytest.approx(PULL * ARM, abs=1e-6)
    assert corner["q"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.slow
def test_a_load_path_jumps_to_where_the_door_swings():
    path = mc.load_path(door(), "M", [0.0, 60.0], start={"hold": 1.0})
    (jump,) = path.jumps
    assert path.status == "done"
    assert jump.before["M"] == pytest.approx(PULL * ARM, abs=1e-6)
    assert jump.after["q"] == pytest.approx(-PULL * ARM / SPRING, rel=1e-5)
    assert jump.energy == pytest.approx(0.5 * (PULL * ARM) ** 2 / SPRING, rel=1e-4)
    assert path["q"][-1] == pytest.approx(-60.0 / SPRING, rel=1e-9)


def test_mujocos_own_door_swings_open_there():
    model = mujoco.MjModel.from_xml_string(DOOR.format(margin=""))
    data = mujoco.MjData(model)
    for load, angle in ((PULL * ARM - 0.1, 0.0), (PULL * ARM + 0.1, -(PULL * ARM + 0.1) / SPRING)):
        mujoco.mj_resetData(model, data)
        data.ctrl[:] = 1.0, load
        mujoco.mj_step(model, data, 20000)
        assert data.qpos[0] == pytest.approx(angle, abs=1e-4)


@pytest.mark.slow
def test_a_lesser_pull_lets_go_at_a_lesser_load():
    path = mc.load_path(door(), "M", [0.0, 60.0], start={"hold": 0.5})
    assert path.jumps[0].before["M"] == pytest.approx(0.5 * PULL * ARM, abs=1e-6)


@pytest.mark.slow
def test_a_contact_with_a_gap_holds_until_it_is_as_wide_as_its_margin():
    # the margins and gaps of both geoms add up: adhesion acts until the faces are 0.04 m apart
    path = mc.load_path(door('margin=".01" gap=".01"'), "M", [0.0, 60.0], start={"hold": 1.0})
    (jump,) = path.jumps
    gap = mujoco.MjData(model := mujoco.MjModel.from_xml_string(DOOR.format(margin='margin=".01" gap=".01"')))
    gap.qpos[:] = jump.before.state - 1e-7 * np.array([-1.0])
    mujoco.mj_forward(model, gap)
    assert gap.contact.dist[0] == pytest.approx(0.04, abs=1e-6)
    assert jump.after["q"] == pytest.approx(-jump.before["M"] / SPRING, rel=1e-5)


def test_without_adhesion_the_door_just_opens():
    branch = mc.continue_equilibria(door(), "M", bounds=(0.0, 20.0), start={"hold": 0.0, "M": 10.0})
    assert [word for word, _ in branch.ends] == ["at bound", "at bound"]
    assert math.isclose(branch["q"][-1], -20.0 / SPRING, rel_tol=1e-9)
