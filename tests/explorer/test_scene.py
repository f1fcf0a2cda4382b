"""Shapes and poses: where a browser puts a shape is where MuJoCo has it."""

import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.explorer.meshes import Mesh, lightened
from mjcont.explorer.scene import Scene

TENDON = """<spatial name="spring" stiffness="5"><site site="tip"/><site site="post"/></spatial>"""


def turned(quat, vector):
    out = np.zeros(3)
    mujoco.mju_rotVecQuat(out, np.asarray(vector, dtype=float), np.asarray(quat, dtype=float))
    return out


def placed(pose, geom):
    """Where a shape is: its place on its body, and the body's."""
    if geom["body"] < 0:
        return np.array(geom["pos"])
    place = pose[geom["body"]]
    return place[:3] + turned(place[3:], geom["pos"])


@pytest.mark.parametrize("model", ["overcentre", "nose_gear", "nose_gear_full", "rssr"])
def test_every_shape_is_where_mujoco_has_it(model):
    mechanism = mc.Mechanism.from_xml(model)
    scene = Scene(mechanism)
    rng = np.random.default_rng(0)
    state = mechanism.retract(mechanism.qpos0, 0.2 * rng.standard_normal(mechanism.n))
    poses = scene.poses(state[None], [mechanism.values()], [])
    data = mujoco.MjData(scene.model)
    data.qpos[:] = state
    mujoco.mj_forward(scene.model, data)
    for geom in scene.described()["geoms"]:
        if geom["name"]:
            expected = data.geom_xpos[mujoco.mj_name2id(scene.model, mujoco.mjtObj.mjOBJ_GEOM, geom["name"])]
            assert placed(poses.bodies[0], geom) == pytest.approx(expected, abs=1e-12)
    assert poses.shapes is None


def test_a_model_that_moves_in_a_plane_is_seen_across_it():
    found = Scene(mc.Mechanism.from_xml("overcentre")).described()
    assert found["planar"] and np.abs(found["toward"]) == pytest.approx([0, 1, 0])


def test_bodies_without_shapes_are_links_to_what_hangs_on_them(pendulum_xml):
    scene = Scene(mc.Mechanism.from_xml(pendulum_xml()))
    (ball, link) = scene.described()["geoms"]
    assert (ball["type"], link["type"]) == ("sphere", "capsule")
    assert (link["pos"], link["size"][1]) == ([0, 0, 0.5], 0.5)


def test_shapes_in_groups_that_the_viewer_hides_are_left_out(pendulum_xml):
    body = '<geom name="seen" size=".1"/><geom name="hidden" group="3" size=".1"/><geom rgba="1 0 0 0" size=".1"/>'
    scene = Scene(mc.Mechanism.from_xml(pendulum_xml(body=body)))
    assert [g["name"] for g in scene.described()["geoms"]] == ["seen"]


def test_a_parameter_of_the_geometry_brings_the_shapes_of_every_row(pendulum_xml):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(body='<geom name="rod" size=".1 1" type="capsule"/>'))
    mechanism.declare("thick", "spec:geom:rod.size[0]")
    values = [mechanism.values({"thick": t}) for t in (0.1, 0.2, 0.3)]
    poses = Scene(mechanism).poses(np.zeros((3, 1)), values, ["thick"])
    assert poses.shapes[:, 0, 7] == pytest.approx([0.1, 0.2, 0.3])


def test_a_spring_runs_between_its_sites(pendulum_xml):
    model = pendulum_xml(world='<site name="post" pos="0.5 0 0"/>', rest=f"<tendon>{TENDON}</tendon>")
    mechanism = mc.Mechanism.from_xml(model)
    scene = Scene(mechanism)
    path = scene.poses(np.array([[np.pi / 2]]), [mechanism.values()], []).tendons[0]
    assert path[0] == pytest.approx([-1, 0, 0]) and path[-1] == pytest.approx([0.5, 0, 0])
    assert scene.described()["tendons"][0]["spring"]


@pytest.mark.slow
def test_heavy_meshes_become_light_and_keep_their_size():
    n = 60
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    faces = np.concatenate([np.column_stack([corner, corner + 1, corner + n]),
                            np.column_stack([corner + 1, corner + n + 1, corner + n])])
    mesh = Mesh(np.column_stack([x.ravel(), y.ravel(), (x * y).ravel()]), faces)
    light, whole = lightened([mesh, mesh], 2000)[0], lightened([mesh], 10**6)[0]
    assert len(light.faces) <= 1000 and whole is mesh
    assert np.ptp(light.vertices, axis=0) == pytest.approx(np.ptp(mesh.vertices, axis=0), abs=0.15)
    assert light.faces.max() < len(light.vertices)
