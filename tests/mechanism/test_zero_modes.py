"""What a model of others taught: motions that nothing opposes or damps, drag, stops and forces that saturate."""

from __future__ import annotations

import numpy as np
import pytest

import mjcont as mc

BODY = '<inertial pos="0 0 0" mass="2" diaginertia="0.1 0.2 0.3"/>'


def model(world, rest="", option=""):
    return mc.Mechanism.from_xml(f"<mujoco><option {option}/><worldbody>{world}</worldbody>{rest}</mujoco>")


def hanging():
    """A box pinned by a corner of its own at (0.5, 0.2, 1)."""
    body = '<body name="box" pos="1 0.2 1"><freejoint/><geom type="box" size="0.5 0.1 0.15" mass="1"/></body>'
    return model(body, '<equality><connect body1="box" anchor="-0.5 0 0"/></equality>')


# -- zero modes about axes anywhere --------------------------------------------------------------------------------


def test_a_body_on_a_pin_turns_freely_about_the_vertical_through_the_pin():
    point = mc.find_equilibrium(hanging())
    assert point.problem.held == ("rotation about z through (0.5, 0.2, 0)",)
    assert (point.stability, point.n_unstable) == ("stable", 0)


def test_a_turntable_away_from_the_origin_is_free():
    mechanism = model(f'<body pos="0.5 -2 0"><joint name="turn" axis="0 0 1"/>{BODY}</body>')
    assert mechanism.rigid_modes(mechanism.start_state(), mechanism.values()) == (
        "rotation about z through (0.5, -2, 0)",
    )


def test_a_sprung_turntable_is_not_free():
    mechanism = model(f'<body pos="0.5 -2 0"><joint name="turn" axis="0 0 1" stiffness="1"/>{BODY}</body>')
    assert mechanism.rigid_modes(mechanism.start_state(), mechanism.values()) == ()


def test_bodies_that_cannot_move_do_not_hide_zero_modes():
    world = f"""
    <body name="target" mocap="true" pos="1 1 1"><geom size="0.1" contype="0" conaffinity="0"/></body>
    <body name="rock" pos="3 1 1"><geom size="0.1" contype="0" conaffinity="0"/></body>
    <body name="fish"><freejoint/>{BODY}</body>"""
    mechanism = model(world, option='gravity="0 0 0"')
    assert len(mechanism.rigid_modes(mechanism.start_state(), mechanism.values())) == 6


def test_a_mode_that_the_parameter_comes_to_oppose_is_not_held():
    """A sprung turntable whose spring is off at the start."""
    mechanism = model(f'<body><joint name="turn" axis="0 0 1"/>{BODY}</body>')
    mechanism.declare("k", "joint:turn.stiffness")
    branch = mc.continue_equilibria(mechanism, "k", bounds=(0.0, 2.0))
    assert branch.notes == ("zero modes at the start that something opposes elsewhere, not held: rotation about z",)


def test_tilting_gravity_does_not_push_where_gravity_is_compensated():
    """Rounding of the weights and their compensation is no push."""
    world = f'<body name="arm" gravcomp="1"><joint name="turn" axis="0 0 1"/>{BODY.replace("0 0 0", "1 0.3 0")}</body>'
    branch = mc.continue_equilibria(model(world), "gravity_angle", bounds=(-1.0, 1.0))
    assert branch.notes == ("rigid-body zero modes held: rotation about z",)


@pytest.mark.slow
def test_motions_against_each_other_that_nothing_opposes_are_held():
    """Two bodies pinned together, free in space: three turns of one against the other are no motion of the whole."""
    world = """
    <body name="a"><freejoint/><geom type="box" size="0.2 0.1 0.1" mass="1" contype="0" conaffinity="0"/></body>
    <body name="b" pos="0.4 0 0"><freejoint/>
      <geom type="box" size="0.2 0.1 0.1" mass="1" contype="0" conaffinity="0"/></body>"""
    pin = '<equality><connect body1="a" body2="b" anchor="0.2 0 0"/></equality>'
    point = mc.find_equilibrium(model(world, pin, 'gravity="0 0 0"'))
    assert [name.startswith("rotation of a about") for name in point.problem.held] == [False] * 6 + [True] * 3
    assert (point.stability, point.n_unstable) == ("stable", 0)


@pytest.mark.slow
def test_a_body_that_nothing_holds_is_marginal_without_a_warning():
    mechanism = model(f'<body><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>{BODY}</body>'
                      f'<body><joint type="slide" axis="1 0 0"/>{BODY}</body>')
    point = mc.find_equilibrium(mechanism)
    assert (point.stability, point.n_unstable) == ("marginal", 0)


# -- damping -----------------------------------------------------------------------------------------------------


def test_drag_that_grows_with_the_square_of_the_speed_damps_no_small_motion():
    """In a fluid without viscosity a sprung plate's small motion is damped by its joint alone: c / 2m."""
    world = """<body><joint name="x" type="slide" axis="1 0 0" stiffness="50" damping="0.4"/>
      <geom type="box" size="0.01 0.5 0.5" mass="2" contype="0" conaffinity="0"/></body>"""
    point = mc.find_equilibrium(model(world, option='density="1000"'))
    assert point.eigenvalues.real == pytest.approx(-0.4 / (2 * 2.0), rel=1e-3)


def test_a_stop_damps_as_its_reference_says():
    """With impedance d = dmax a stop of time constant T and damping ratio z gives s^2 + 2 s / T + 1 / (T z)^2 = 0."""
    world = f"""<body><joint name="x" type="slide" axis="0 0 1" limited="true" range="0 1"
      solreflimit="0.05 0.5" solimplimit="0.9 0.9 0.1"/>{BODY}</body>"""
    mechanism = model(world)
    point = mc.find_equilibrium(mechanism)
    assert mechanism.active(point.state, point.parameters) == {"lower limit of x"}
    expected = np.roots([1.0, 2.0 / 0.05, 1.0 / (0.05 * 0.5) ** 2])
    assert point.eigenvalues.real == pytest.approx(expected.real, rel=1e-5)
    assert sorted(point.eigenvalues.imag) == pytest.approx(sorted(expected.imag), rel=1e-5)


# -- parameters --------------------------------------------------------------------------------------------------


def test_a_servo_of_limited_force_is_followed_to_its_limit():
    """100 (c - q) = q while the force stays below 5."""
    world = f'<body><joint name="q" axis="0 1 0" stiffness="1" damping="1"/>{BODY}</body>'
    servo = '<actuator><position name="c" joint="q" kp="100" forcerange="-5 5"/></actuator>'
    branch = mc.continue_equilibria(model(world, servo), "c", bounds=(0.0, 4.0), start={"c": 2.0}, state=[2.0])
    assert [status for status, _ in branch.ends] == ["at bound", "at bound"]
    assert branch["q"] == pytest.approx(branch["c"] * 100.0 / 101.0, abs=1e-9)


def test_what_has_no_name_is_called_by_its_place():
    tip = f'<body><joint axis="0 1 0" stiffness="4"/>{BODY}</body>'
    mechanism = model(f'<body><joint axis="0 0 1" stiffness="3"/>{BODY}{tip}</body>')
    assert mechanism.declare("k", "joint:joint1.stiffness").value == 4.0
    with pytest.raises(mc.ParameterError, match=r"Its joint names: joint0, joint1\."):
        mechanism.declare("k2", "joint:hip.stiffness")
