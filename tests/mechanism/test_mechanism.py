"""Mechanism: sources, refusals, observables, starts, and derivatives against hand-written energies."""

from __future__ import annotations

import copy
import math

import mujoco
import numpy as np
import pytest
from problems import reference
from problems.poses import random_rest
from problems.reference import GRAVITY

import mjcont as mc
from mjcont.models.loading import models_folder

XML_PATH = models_folder() / "overcentre.xml"


def worst(found, expected):
    """Return the largest error relative to the largest entry."""
    return np.abs(found - expected).max() / np.abs(expected).max()


# -- sources -------------------------------------------------------------------------------------------------

SOURCES = {
    "path": lambda: mc.Mechanism.from_xml(XML_PATH),
    "path as text": lambda: mc.Mechanism.from_xml(str(XML_PATH)),
    "XML text": lambda: mc.Mechanism.from_xml(XML_PATH.read_text(encoding="utf-8")),
    "MjSpec": lambda: mc.Mechanism.from_spec(mujoco.MjSpec.from_file(str(XML_PATH))),
    "compiled model": lambda: mc.Mechanism.from_model(mujoco.MjModel.from_xml_path(str(XML_PATH))),
}


@pytest.mark.parametrize("make", SOURCES.values(), ids=SOURCES.keys())
def test_every_source_gives_the_accelerations_of_the_shipped_model(overcentre, make):
    mechanism = make()
    for q, p in random_rest(5):
        v = np.linspace(-1.0, 2.0, 6)
        assert mechanism.acceleration(q, v, p) == pytest.approx(overcentre.acceleration(q, v, p), rel=1e-13)


def test_a_compiled_model_is_copied():
    model = mujoco.MjModel.from_xml_path(str(XML_PATH))
    before = copy.copy(model)
    mechanism = mc.Mechanism.from_model(model)
    mechanism.acceleration(mechanism.qpos0, np.zeros(6), {"k_j": 5.0, "m_1": 2.0, "gravity_angle": 1.0})
    assert np.array_equal(model.actuator_biasprm, before.actuator_biasprm)
    assert np.array_equal(model.body_mass, before.body_mass)
    assert np.array_equal(model.opt.gravity, before.opt.gravity)


def test_a_file_that_does_not_exist_is_an_error_that_lists_the_shipped_models():
    with pytest.raises(mc.ModelError, match=r"model 'nowhere\.xml': no such file\. .*overcentre"):
        mc.Mechanism.from_xml("nowhere.xml")


def test_a_folder_is_an_error(tmp_path):
    with pytest.raises(mc.ModelError, match="is a folder, not a file"):
        mc.Mechanism.from_xml(tmp_path)


def test_a_binary_file_is_an_error(tmp_path):
    (tmp_path / "model.xml").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(mc.ModelError, match="cannot be read as text"):
        mc.Mechanism.from_xml(tmp_path / "model.xml")


def test_xml_that_does_not_parse_is_an_error_with_its_line():
    with pytest.raises(mc.ModelError, match=r"MuJoCo rejects it: .*Line number=1"):
        mc.Mechanism.from_xml("<mujoco><worldbody></mujoco>")


def test_a_model_that_does_not_compile_is_an_error_with_the_reason():
    with pytest.raises(mc.ModelError, match="mass and inertia of moving bodies must be larger"):
        mc.Mechanism.from_xml("<mujoco><worldbody><body><joint/></body></worldbody></mujoco>")


# -- refusals ------------------------------------------------------------------------------------------------

SPHERE = '<geom type="sphere" size="0.1" pos="0 0 1"/>'
REFUSED = {
    "sleep": ({"flag": 'sleep="enable"'}, "sleeping bodies make equilibria path dependent"),
    "plastic spring": ({"joint": 'stiffness="1" springyield="0.1"'}, r"plastic springs \(springyield\)"),
}


@pytest.mark.parametrize(("parts", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_a_feature_that_cannot_be_treated_is_refused_with_the_reason(pendulum_xml, parts, message):
    with pytest.raises(mc.ModelError, match=message):
        mc.Mechanism.from_xml(pendulum_xml(**parts))


def test_a_model_without_a_degree_of_freedom_is_refused():
    with pytest.raises(mc.ModelError, match="the model has no degree of freedom"):
        mc.Mechanism.from_xml('<mujoco><worldbody><geom size="1"/></worldbody></mujoco>')


ALLOWED = {
    "limits switched off": {"joint": 'range="-1 1"', "flag": 'limit="disable"'},
    "contacts switched off": {
        "world": '<geom type="plane" size="1 1 1"/>',
        "body": SPHERE,
        "flag": 'contact="disable"',
    },
    "friction switched off": {"joint": 'frictionloss="1"', "flag": 'frictionloss="disable"'},
    "equality switched off": {
        "world": '<site name="wall"/>',
        "rest": '<equality><connect site1="tip" site2="wall"/></equality>',
        "flag": 'equality="disable"',
    },
    "constraints switched off": {"joint": 'range="-1 1" frictionloss="1"', "flag": 'constraint="disable"'},
    "geoms that cannot touch": {
        "world": '<geom type="plane" size="1 1 1" contype="2" conaffinity="2"/>',
        "body": SPHERE,
    },
}


@pytest.mark.parametrize("parts", ALLOWED.values(), ids=ALLOWED.keys())
def test_a_feature_that_is_switched_off_is_no_hindrance(pendulum_xml, parts):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(**parts))
    x = np.array([0.3])
    moment = -GRAVITY * math.cos(math.pi / 2 + 0.3)
    assert mechanism.residual(x, mechanism.values()) == pytest.approx([moment], rel=1e-12)


# -- derivatives ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("accurate", "error"), [(False, 1e-6), (True, 1e-9)])
def test_the_jacobian_equals_that_of_the_hand_written_energies(overcentre, accurate, error):
    for q, p in random_rest(30):
        found = overcentre.linearize(q, overcentre.values(p), (), accurate=accurate)
        assert worst(found.jac, -reference.stiffness(q, p)) < error


def test_the_residual_equals_the_hand_written_forces(overcentre):
    for q, p in random_rest(30):
        assert worst(overcentre.residual(q, overcentre.values(p)), reference.forces(q, p)) < 1e-12


def derivative(name, q, p):
    """Return d forces / d parameter of the hand-written energies, (6,)."""
    size, angle = p["load_factor"] * GRAVITY, p["gravity_angle"]
    gx, gz = reference.gravity_vector(p)
    m1, m2 = p["m_1"], p["m_2"]
    return {
        "F": np.array([0.0, 1.0, 0.0, 0.0, 0.0, 0.0]),
        "k_j": -reference.gap_jacobian(q).T @ reference.gaps(q),
        "k_sp": -(reference.SPRING @ q - p["l_us"]) * reference.SPRING,
        "l_us": p["k_sp"] * reference.SPRING,
        "m_1": np.array([gx, gz, 0.0, 0.0, 0.0, 0.0]),
        "gravity_angle": size
        * np.array(
            [-m1 * math.cos(angle), m1 * math.sin(angle), 0, -m2 * math.cos(angle), m2 * math.sin(angle), 0]
        ),
        "load_factor": np.array([m1 * gx, m1 * gz, 0.0, m2 * gx, m2 * gz, 0.0]) / p["load_factor"],
    }[name]


@pytest.mark.parametrize("name", ["F", "k_j", "k_sp", "l_us", "m_1", "gravity_angle", "load_factor"])
def test_the_derivative_in_a_parameter_equals_its_closed_form(overcentre, name):
    for q, p in random_rest(20):
        found = overcentre.linearize(q, overcentre.values(p), [name]).par[:, 0]
        noise = 1e-12 * p["k_j"] / max(1.0, abs(p[name]))
        assert (
            np.abs(found - derivative(name, q, p)).max() < 1e-9 * np.abs(derivative(name, q, p)).max() + noise
        )


@pytest.mark.parametrize("name", ["c_j", "c_sp"])
def test_damping_constants_do_not_act_at_rest(overcentre, name):
    q, p = next(random_rest(1))
    assert not np.any(overcentre.linearize(q, overcentre.values(p), [name]).par)


def test_derivatives_in_several_parameters_stand_in_their_order(overcentre):
    q, p = next(random_rest(1))
    found = overcentre.linearize(q, overcentre.values(p), ["l_us", "F"]).par
    assert found[:, 0] == pytest.approx(derivative("l_us", q, p), abs=1e-8)
    assert found[:, 1] == pytest.approx(derivative("F", q, p), abs=1e-8)


def test_mass_matrix_is_that_of_two_uniform_rods(overcentre):
    for q, p in random_rest(5):
        found = overcentre.pencil(q, overcentre.values(p), np.zeros((6, 6))).mass
        assert found == pytest.approx(reference.mass(p), abs=1e-13)


def test_damping_matrix_is_that_of_spring_and_bush_dampers(overcentre):
    for q, p in random_rest(20):
        found = overcentre.pencil(q, overcentre.values(p), np.zeros((6, 6))).damping
        noise = 1e-13 * p["k_j"]
        assert np.abs(found - reference.damping(q, p)).max() < 1e-10 + noise


def test_stiffness_of_the_pencil_is_minus_the_jacobian(overcentre):
    q, p = next(random_rest(1))
    values = overcentre.values(p)
    jac = overcentre.linearize(q, values, ()).jac
    assert np.array_equal(overcentre.pencil(q, values, jac).stiffness, -jac)


def test_steps_are_evaluated_as_single_states_are(overcentre):
    q, p = next(random_rest(1))
    values = overcentre.values(p)
    steps = np.random.default_rng(0).normal(0.0, 0.1, (7, 6))
    single = np.array([overcentre.residual(q + step, values) for step in steps])
    assert np.array_equal(overcentre.residuals(q, values, steps), single)


def test_every_row_of_a_batch_counts_as_one_evaluation(overcentre):
    before = overcentre.evaluations
    overcentre.residuals(overcentre.qpos0, overcentre.values(), np.zeros((7, 6)))
    assert overcentre.evaluations - before == 7


# -- states on a manifold ------------------------------------------------------------------------------------

BALL = """<mujoco><worldbody><body><joint name="socket" type="ball" stiffness="3"/>
  <inertial pos="0 0 1" mass="1" diaginertia="1 1 1"/></body></worldbody></mujoco>"""


def test_a_step_on_a_ball_joint_is_undone_by_the_difference():
    mechanism = mc.Mechanism.from_xml(BALL)
    step = np.array([0.4, -0.2, 0.7])
    moved = mechanism.retract(mechanism.qpos0, step)
    assert np.linalg.norm(moved) == pytest.approx(1.0, abs=1e-15)
    assert mechanism.difference(moved, mechanism.qpos0) == pytest.approx(step, rel=1e-12)


def test_the_jacobian_on_a_ball_joint_is_taken_in_the_tangent_space():
    mechanism = mc.Mechanism.from_xml(BALL)
    found = mechanism.linearize(mechanism.qpos0, mechanism.values({"load_factor": 0.0}), ())
    assert found.jac == pytest.approx(-3.0 * np.eye(3), abs=1e-8)


# -- starts --------------------------------------------------------------------------------------------------

KEYS = '<keyframe><key name="leaning" qpos="0.25"/><key qpos="-0.5"/></keyframe>'


def test_the_default_start_is_the_initial_pose(overcentre):
    assert np.array_equal(overcentre.start_state(), overcentre.qpos0)


def test_a_keyframe_is_a_start_by_its_name_or_number(pendulum_xml):
    mechanism = mc.Mechanism.from_xml(pendulum_xml(rest=KEYS))
    assert list(mechanism.keyframes) == ["leaning", "key1"]
    assert mechanism.start_state("leaning") == pytest.approx([0.25])
    assert mechanism.start_state("key1") == pytest.approx([-0.5])


def test_an_unknown_keyframe_is_an_error_with_the_keyframes(pendulum_xml):
    with pytest.raises(mc.NameLookupError, match=r"unknown keyframe 'leanin'\. Did you mean leaning\?.*key1"):
        mc.Mechanism.from_xml(pendulum_xml(rest=KEYS)).start_state("leanin")


def test_a_state_of_the_wrong_size_is_an_error(overcentre):
    with pytest.raises(
        mc.ParameterError, match=r"state must have shape \(6,\) for model 'overcentre', got \(2,\)"
    ):
        overcentre.start_state(state=[1.0, 2.0])


@pytest.mark.slow
def test_a_start_that_flows_to_no_equilibrium_is_an_error():
    falling = mc.Mechanism.from_xml(
        '<mujoco><worldbody><body><joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass="1" '
        'diaginertia="1 1 1"/></body></worldbody></mujoco>'
    )
    with pytest.raises(mc.StartError, match="no equilibrium found from the model's initial pose"):
        mc.find_equilibrium(falling)


# -- what is shown --------------------------------------------------------------------------------------------


def test_dir_shows_what_a_user_may_use_and_no_internals(overcentre):
    assert [n for n in dir(overcentre) if not n.startswith("_")] == [
        "acceleration", "bushes", "copy", "declare", "declared", "difference", "evaluations",
        "from_model", "from_spec", "from_xml", "keyframes", "linearize", "measure", "mjcf", "n", "name", "notes", "nq",
        "observable", "observables", "observe", "parameter", "parameters", "pencil", "qpos0", "residual", "retract",
        "simulation_model", "start_state", "state_labels", "state_scale", "values",
    ]
