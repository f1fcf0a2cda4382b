"""Loops, freedoms and closures of mechanisms whose mobility is known."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.models.bushes import bushed_xml
from mjcont.models.loading import models_folder
from mjcont.models.topology import describe_topology, freedom, loops, plane_normal, softening


def shipped(name):
    return mujoco.MjModel.from_xml_path(str(models_folder() / f"{name}.xml"))


# -- freedom and loops -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "coordinates", "rows", "rank", "mobility"),
    [("four_bar", 3, 3, 2, 1), ("slider_crank", 3, 3, 2, 1), ("watt_six_bar", 5, 6, 4, 1), ("rssr", 5, 3, 3, 2)],
)
def test_mobility_is_that_of_the_textbook(name, coordinates, rows, rank, mobility):
    # rssr: the coupler's spin is its second freedom
    count = freedom(shipped(name))
    assert (count.coordinates, count.constraint_rows, count.constraint_rank) == (coordinates, rows, rank)
    assert count.mobility == mobility


@pytest.mark.parametrize("name", ["overcentre", "overcentre_tree", "nose_gear", "nose_gear_full"])
def test_elastic_pins_do_not_count_as_freedoms_of_the_mechanism(name):
    assert freedom(shipped(name)).mobility == 1


@pytest.mark.parametrize("joints", [[], ["pin_B"], ["crank", "pin_B", "rocker"]])
def test_bushes_leave_the_mobility_as_it_is(joints):
    model = mujoco.MjModel.from_xml_string(bushed_xml("four_bar", joints=joints))
    count = freedom(model)
    assert (count.coordinates, count.elastic_pins, count.bush_rows, count.mobility) == (3, 2 * len(joints), 2, 1)


def test_each_connect_of_the_six_bar_closes_one_loop():
    first, second = loops(shipped("watt_six_bar"))
    assert (first.closure.name, first.bodies) == ("C", ("coupler", "crank", "ground", "rocker"))
    assert (second.closure.name, second.bodies) == ("F", ("coupler_2", "rocker", "ground", "lever"))
    assert second.joints == ("pin_E", "rocker", "lever")


def test_free_bodies_joined_by_bushes_make_one_loop_where_the_linkage_has_one():
    (loop,) = loops(shipped("overcentre"))
    assert loop.closure.name == "C"


def test_a_bush_closes_the_loop_that_its_connect_closed():
    (loop,) = loops(mujoco.MjModel.from_xml_string(bushed_xml("rssr")))
    assert (loop.closure.kind, loop.closure.name) == ("bush", "C")
    assert set(loop.bodies) == {"coupler", "crank", "ground", "rocker"}


def test_one_closure_a_loop_is_to_be_softened():
    assert softening(shipped("watt_six_bar")) == ["C", "F"]
    assert softening(shipped("nose_gear")) == []


def test_the_plane_of_motion_is_found():
    np.testing.assert_array_equal(np.abs(plane_normal(shipped("slider_crank"), [1, 2, 3])), [0, 1, 0])
    assert plane_normal(shipped("rssr"), [1, 2, 3]) is None


def test_mobility_is_counted_at_the_pose_asked_for():
    # a rhombus, folded flat: all four bars lie on one line, where a second freedom opens
    bar = '<joint axis="0 -1 0"/><geom size="0.1" mass="1" pos="0.5 0 0"/>'
    end = f'<body pos="1 0 0">{bar}<site name="end" pos="1 0 0"/></body>'
    model = mujoco.MjModel.from_xml_string(f"""<mujoco>
      <worldbody><body>{bar}<body pos="1 0 0">{bar}{end}</body></body><site name="D" pos="1 0 0"/></worldbody>
      <equality><connect name="D" site1="end" site2="D"/></equality></mujoco>""")
    assert freedom(model, np.array([0.0, 0.0, np.pi])).mobility == 2
    assert freedom(model, np.array([0.5, -0.5, np.pi + 0.5])).mobility == 1


# -- summary ---------------------------------------------------------------------------------------------------------


def test_inspect_says_what_closes_the_loop_and_how_to_make_an_ode_of_it():
    text = "\n".join(describe_topology(shipped("four_bar")))
    assert "3 coordinates, mobility 1" in text
    assert "3 constraint rows, 1 of them redundant" in text
    assert "coupler - crank - ground - rocker, closed by connect C" in text
    assert "elastic C: mjcont bush" in text


def test_inspect_says_where_a_loop_is_open():
    text = (
        (models_folder() / "four_bar.xml")
        .read_text()
        .replace('"C_rocker" pos="0.2 0 0.75"', '"C_rocker" pos="0.2 0 0.8"')
    )
    assert "connect C is open by 0.05 m at qpos0" in "\n".join(describe_topology(mujoco.MjModel.from_xml_string(text)))


def test_a_tree_has_no_loops(pendulum_xml):
    assert "no loops" in str(mc.Mechanism.from_xml(pendulum_xml()))


def test_a_coupling_of_joints_is_listed():
    text = (models_folder() / "four_bar.xml").read_text()
    text = text.replace("</equality>", '<joint name="gears" joint1="crank" joint2="rocker"/></equality>')
    assert "coupling: joint gears" in "\n".join(describe_topology(mujoco.MjModel.from_xml_string(text)))
