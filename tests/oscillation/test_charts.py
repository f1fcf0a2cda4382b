"""Charts of ball and free joints, against MuJoCo's own steps of poses and rotations written out by hand."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest
from problems.balls import matrix
from problems.rotations import right_jacobian

from mjcont.models.manifold import chart_of
from mjcont.results.orbits import Chart

MIXED = """<mujoco><worldbody>
    <body><joint name="slide" type="slide"/><geom size="0.1"/>
      <body pos="1 0 0"><joint name="ball" type="ball"/><geom size="0.1"/>
        <body pos="1 0 0"><joint name="hinge"/><geom size="0.1"/></body></body></body>
    <body pos="0 3 0"><joint name="free" type="free"/><geom size="0.1"/></body>
</worldbody></mujoco>"""
MODEL = mujoco.MjModel.from_xml_string(MIXED)
ANGLES = (0.0, 1e-9, 1e-4, 0.3, 0.9999, 1.0001, 2.0, 3.1, 4.5, 5.9)
BALL = slice(1, 4)


def rows(seed=0, count=6, size=0.8):
    return size * np.random.default_rng(seed).standard_normal((count, MODEL.nv))


def pose(seed=7):
    """A pose with rotations of its own."""
    found = MODEL.qpos0.copy()
    mujoco.mj_integratePos(MODEL, found, rows(seed, 1, 1.0)[0], 1.0)
    return found


def single(angle, seed=3):
    """A rotation vector of an angle, as coordinates of a chart with one ball joint."""
    x = np.random.default_rng(seed).standard_normal(3)
    return angle * x / np.linalg.norm(x)


def ball():
    return Chart(("ball",), np.array([[0, 0]]), np.array([[1.0, 0.0, 0.0, 0.0]]))


def test_a_model_of_hinges_and_slides_needs_no_chart():
    text = '<mujoco><worldbody><body><joint/><geom size="1"/></body></worldbody></mujoco>'
    assert chart_of(mujoco.MjModel.from_xml_string(text)) is None


def test_a_chart_knows_its_joints():
    assert chart_of(MODEL).joints == ("ball", "free")


def test_poses_are_where_mujoco_steps_to():
    chart, reference = chart_of(MODEL).about(pose()), pose()
    plain = np.array([0, 5, 6, 7, 8])  # entries of a pose that are no quaternions: slide, hinge, the free body's place
    for xi, found in zip(rows(), chart.poses(rows()), strict=True):
        stepped = reference.copy()
        mujoco.mj_integratePos(MODEL, stepped, xi, 1.0)
        stepped[plain] -= reference[plain]
        assert found == pytest.approx(stepped, abs=1e-14)


def test_coordinates_are_those_of_their_poses():
    chart = chart_of(MODEL).about(pose())
    assert chart.coordinates(chart.poses(rows())) == pytest.approx(rows(), abs=1e-13)
    assert chart.coordinates(-chart.poses(rows()))[:, BALL] == pytest.approx(rows()[:, BALL], abs=1e-13)


@pytest.mark.parametrize("angle", ANGLES)
def test_speeds_are_the_right_jacobian_times_the_rates(angle):
    x, v = single(angle), single(1.3, seed=4)
    assert ball().speeds(x[None], v[None])[0] == pytest.approx(right_jacobian(x) @ v, abs=1e-7)
    assert ball().slopes(x[None], ball().speeds(x[None], v[None]))[0] == pytest.approx(v, abs=1e-13)


@pytest.mark.parametrize("angle", ANGLES[3:])
def test_accelerations_are_the_derivative_of_speeds(angle):
    x, v, a, h = single(angle), single(1.3, seed=4), single(0.7, seed=5), 1e-5
    ends = [right_jacobian(x + t * v + 0.5 * t * t * a) @ (v + t * a) for t in (h, -h)]
    found = ball().accelerations(x[None], v[None], a[None])
    assert found[0] == pytest.approx((ends[0] - ends[1]) / (2.0 * h), abs=1e-9)
    assert ball().moving(x[None], v[None]).bends(found)[0] == pytest.approx(a, abs=1e-12)


def test_accelerations_at_the_reference_are_the_second_rates():
    v, a = single(1.3, seed=4)[None], single(0.7, seed=5)[None]
    assert ball().accelerations(np.zeros((1, 3)), v, a) == pytest.approx(a, abs=1e-15)


def test_another_chart_has_the_same_poses_beyond_half_a_turn_too():
    one, other = ball(), Chart(("ball",), np.array([[0, 0]]), np.array([[math.cos(1.0), math.sin(1.0), 0.0, 0.0]]))
    angles = np.array([[-3.0, 0.0, 0.0], [0.5, 0.0, 0.0], [5.5, 0.0, 0.0]])
    assert other.taken(angles, one) == pytest.approx(angles - [2.0, 0.0, 0.0], abs=1e-13)
    for a, b in zip(one.poses(angles), other.poses(other.taken(angles, one)), strict=True):
        assert matrix(a) == pytest.approx(matrix(b), abs=1e-14)


def test_a_chart_near_its_edge_is_laid_amid_the_motion():
    xi = np.linspace(-1.0, 5.4, 33)[:, None] * np.array([0.6, 0.0, 0.8])
    moved = ball().centred(xi)
    assert moved.angles(moved.taken(xi, ball())).max() == pytest.approx(3.2, abs=0.2)


def test_a_chart_off_its_edge_or_in_the_middle_stays():
    chart = ball()
    for most in (4.0, 5.5):
        xi = np.linspace(-most, most, 33)[:, None] * np.array([0.6, 0.0, 0.8])
        assert chart.centred(xi) is chart


def test_motion_that_circles_is_centred_where_it_never_is():
    around = np.linspace(0.0, 2.0 * math.pi, 40)
    xi = np.column_stack([3.0 + 2.0 * np.cos(around), 2.0 * np.sin(around), 0.0 * around])
    chart = ball().about(np.array([math.cos(0.1), math.sin(0.1), 0.0, 0.0]))
    moved = chart.centred(xi)
    assert moved.angles(moved.taken(xi, chart)).max() < chart.angles(xi).max() - 1.0


def test_half_a_turn_from_where_a_spring_rests_is_seen_from_any_reference():
    spring = np.array([[math.cos(0.4), math.sin(0.4), 0.0, 0.0]])
    chart = ball().about(np.array([-math.cos(-0.2), math.sin(0.2), 0.0, 0.0]))
    angles = np.array([[math.pi + 1.15], [math.pi + 1.25], [1.2 - math.pi + 0.05], [1.2 - math.pi - 0.05]])
    xi = np.hstack([angles, np.zeros((4, 2))])
    assert chart.moving(xi, xi).past(spring)[:, 0].tolist() == [False, True, False, True]
