"""Controls that hold a pose: closed forms, MuJoCo's inverse dynamics, and the sentences where none does."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.inverse import unbalanced

import mjcont as mc
from mjcont.numerics.search.leastnorm import least_norm

GRAVITY = 9.81
MOTOR = '<motor name="motor" joint="hip" {}/>'


@pytest.fixture
def pendulum(pendulum_xml):
    """Return a function: an inverted pendulum of 1 kg, 1 m with actuators at its hinge."""
    return lambda *actuators: mc.Mechanism.from_xml(pendulum_xml(actuator="".join(actuators)))


def test_a_motor_holds_a_leaning_pendulum_against_its_weight(pendulum):
    found = mc.hold(pendulum(MOTOR.format("")), {"hip": 0.3})
    assert found.status == "held"
    assert abs(found.controls["motor"]) == pytest.approx(GRAVITY * math.sin(0.3), rel=1e-10)
    assert found.stability == "unstable"
    assert found.point["hip"] == pytest.approx(0.3, abs=1e-12)


def test_controls_are_those_of_least_norm(pendulum):
    strong, weak = (f'<motor name="{n}" joint="hip" gear="{g}"/>' for n, g in (("strong", 3.0), ("weak", 1.0)))
    found = mc.hold(pendulum(strong, weak), [0.3])
    share = GRAVITY * math.sin(0.3) / 10.0  # 3 u_1 + u_2 = moment: u is a tenth of it along (3, 1)
    assert [abs(v) for v in found.controls.values()] == pytest.approx([3.0 * share, share], rel=1e-10)
    assert found.norm == pytest.approx(math.sqrt(10.0) * share, rel=1e-10)


def test_a_control_at_its_limit_leaves_the_rest_to_others(pendulum):
    strong = '<motor name="strong" joint="hip" gear="3" ctrllimited="true" ctrlrange="-0.5 0.5"/>'
    found = mc.hold(pendulum(strong, '<motor name="weak" joint="hip"/>'), [0.3])
    assert found.held
    assert found.at_limit.keys() == {"strong"}
    assert abs(found.controls["strong"]) == 0.5
    assert abs(found.controls["weak"]) == pytest.approx(GRAVITY * math.sin(0.3) - 1.5, rel=1e-10)


def test_a_servo_that_is_saturated_where_it_begins_is_found(pendulum):
    """At a control of 0 the servo of 20 N m/rad is beyond its 5 N m: none is lost by a little more control."""
    servo = '<position name="servo" joint="hip" kp="20" forcerange="-5 5" ctrlrange="-3 3"/>'
    found = mc.hold(pendulum(servo), [0.3])
    assert found.held
    assert abs(found.controls["servo"] - 0.3) == pytest.approx(GRAVITY * math.sin(0.3) / 20.0, rel=1e-9)


def test_a_range_that_is_too_small_is_named_with_what_is_left(pendulum):
    found = mc.hold(pendulum(MOTOR.format('ctrllimited="true" ctrlrange="-1 1"')), [0.3])
    assert (found.status, found.point) == ("beyond range", None)
    assert abs(found.wanted["motor"]) == pytest.approx(GRAVITY * math.sin(0.3), rel=1e-10)
    assert abs(found.left["hip"]) == pytest.approx(GRAVITY * math.sin(0.3) - 1.0, rel=1e-10)
    assert "it takes motor = " in found.message
    assert "hip is left with 1.899 N m" in found.message


def test_a_joint_that_no_control_pushes_is_named_with_its_force(pendulum_xml):
    """Weight 1 kg at 1 m on the hip, and 0.5 kg at 0.4 m beyond it on a joint without a motor, level."""
    elbow = """<body name="fore" pos="0 0 1"><joint name="elbow" type="hinge" axis="0 -1 0"/>
      <inertial pos="0.4 0 0" mass="0.5" diaginertia="0.01 0.01 0.01"/></body>"""
    arm = mc.Mechanism.from_xml(pendulum_xml(body=elbow, actuator=MOTOR.format("")))
    found = mc.hold(arm, [0.0, 0.0])
    assert found.status == "not held"
    assert found.left.keys() == {"elbow"}
    assert abs(found.left["elbow"]) == pytest.approx(0.5 * GRAVITY * 0.4, rel=1e-9)
    assert "no control holds this pose: elbow is left with" in found.message


@pytest.mark.slow
def test_bushes_yield_until_they_carry_the_load_of_a_keyframe():
    gear = mc.Mechanism.from_xml("nose_gear")
    found = mc.hold(gear, "uplock_above", controls=["F_ret"])
    assert found.held
    assert 0.0 < abs(found.shift["theta_ov"]) < math.radians(0.1)
    assert unbalanced(gear, found)[0] < 1e-6
    branch = mc.continue_equilibria(gear, "F_ret", bounds=(4.5e5, 4.75e5), start=found.point)
    assert min(abs(p["theta_ov"] - found.point["theta_ov"]) for p in branch.at(F_ret=found.controls["F_ret"])) < 1e-9


def test_an_observable_is_held_and_the_rest_of_the_state_follows():
    gear = mc.Mechanism.from_xml("nose_gear")
    found = mc.hold(gear, {"theta_ov": math.radians(20.0)}, controls=["F_ret"], keyframe="uplock_above")
    assert found.point["theta_ov"] == pytest.approx(math.radians(20.0), abs=1e-11)
    assert found.stability == "stable"
    assert unbalanced(gear, found)[0] < 1e-6


@pytest.mark.slow
def test_controls_that_load_it_least_are_taken_where_those_of_least_norm_make_bushes_give_way():
    gear = mc.Mechanism.from_xml("nose_gear")
    found = mc.hold(gear, "uplock_above")
    assert found.held
    assert "give way" in found.message
    assert unbalanced(gear, found)[0] < 1e-6


def test_slides_that_stand_for_a_pin_yield():
    tree = mc.Mechanism.from_xml("overcentre_tree")
    found = mc.hold(tree, tree.qpos0)
    assert found.held
    assert unbalanced(tree, found)[0] < 1e-9


def test_rigid_loops_are_held_by_their_constraints():
    linkage = mc.Mechanism.from_xml("four_bar")
    found = mc.hold(linkage, linkage.qpos0)
    assert found.held
    assert found.point["crank"] == pytest.approx(math.pi / 2, abs=1e-6)


def test_a_vector_field_is_held_by_its_parameters():
    field = mc.VectorField(lambda u, p: [p["a"] - u[0] ** 2, p["b"] - u[1]], [1.0, 1.0], {"a": 0.0, "b": 0.0})
    found = mc.hold(field, [2.0, 3.0], controls=["a", "b"])
    assert found.controls == pytest.approx({"a": 4.0, "b": 3.0}, rel=1e-12)
    assert found.stability == "stable"


def test_a_hold_prints_its_controls_and_is_a_table(pendulum, tmp_path):
    found = mc.hold(pendulum(MOTOR.format("")), [0.3])
    assert str(found).startswith("the pose is held, unstable (")
    assert "\n  motor = " in str(found)
    header, row = found.to_csv(tmp_path / "hold.csv").read_text().splitlines()
    assert header.startswith("control,unit,value")
    assert row.startswith("motor,")


@pytest.mark.parametrize(
    ("pose", "options", "error", "said"),
    [
        ("upright", {}, mc.NameLookupError, "unknown keyframe 'upright'"),
        ({"knee": 1.0}, {}, mc.NameLookupError, "unknown joint or observable 'knee'"),
        ({}, {}, mc.ParameterError, "at least one joint"),
        ([0.0, 1.0], {}, mc.ParameterError, "shape"),
        ([0.0], {"controls": ["arm"]}, mc.NameLookupError, "unknown parameter 'arm'"),
        ([0.0], {"controls": []}, mc.ParameterError, "no control"),
        ([0.0], {"controls": {"motor": (1.0, -1.0)}}, mc.BoundsError, "low < high"),
        ([0.0], {"keyframe": "upright"}, mc.ParameterError, "keyframe goes with a pose"),
    ],
)
def test_mistakes_name_the_valid_choices(pendulum, pose, options, error, said):
    with pytest.raises(error, match=said):
        mc.hold(pendulum(MOTOR.format("")), pose, **options)


# -- the shortest vector within bounds --------------------------------------------------------------------------


def test_the_shortest_vector_within_bounds_satisfies_its_optimality_conditions():
    """u = A'y + multipliers of bounds, those with the sign that keeps them: for 50 random problems."""
    rng = np.random.default_rng(3)
    for _ in range(50):
        a = rng.normal(size=(2, 5))
        low, high = -rng.uniform(0.1, 1.0, 5), rng.uniform(0.1, 1.0, 5)
        b = a @ rng.uniform(low, high)
        found = least_norm(a, b, low, high, 1e-9)
        assert np.abs(found.left).max() < 1e-9
        inside = (found.u > low + 1e-9) & (found.u < high - 1e-9)
        y = np.linalg.lstsq(a[:, inside].T, found.u[inside], rcond=None)[0]
        push = found.u - a.T @ y
        assert np.abs(push[inside]).max(initial=0.0) < 1e-7
        assert np.all(push[found.u >= high - 1e-9] <= 1e-7) and np.all(push[found.u <= low + 1e-9] >= -1e-7)


def test_equations_that_bounds_exclude_are_left_as_little_as_can_be():
    found = least_norm(np.array([[1.0, 2.0]]), np.array([10.0]), np.full(2, -1.0), np.ones(2), 1e-9)
    assert found.u == pytest.approx([1.0, 1.0])
    assert found.left == pytest.approx([7.0])
    assert found.wanted == pytest.approx([2.0, 4.0])
