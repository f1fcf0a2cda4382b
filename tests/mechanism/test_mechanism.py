"""Mechanism: sources, refusals, observables, starts, and derivatives against hand-written energies."""

from __future__ import annotations

import copy
import math

import mujoco
import numpy as np
import pytest
from problems import reference
from problems.reference import GRAVITY, PARAMETERS

import mjcont as mc
from mjcont.models.loading import models_folder

XML_PATH = models_folder() / "overcentre.xml"


def random_rest(count, seed=7):
    """Yield states and parameters at rest: any angles, pins open by about 5 cm, bushes from soft to stiff."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        angle = rng.uniform(-np.pi, np.pi)
        q = reference.assembled_pose(angle) + rng.normal(0.0, 0.05, 6)
        p = {
            "k_j": 10.0 ** rng.uniform(1.0, 7.0),
            "c_j": rng.uniform(0.0, 5.0),
            "k_sp": rng.uniform(1.0, 50.0),
            "c_sp": rng.uniform(0.0, 20.0),
            "l_us": rng.uniform(0.0, 2.0),
            "m_1": rng.uniform(0.2, 5.0),
            "m_2": rng.uniform(0.2, 5.0),
            "F": rng.uniform(-50.0, 50.0),
            "gravity_angle": rng.uniform(-1.0, 1.0),
            "load_factor": rng.uniform(0.5, 2.5),
        }
        yield q, p


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


def test_a_start_that_flows_to_no_equilibrium_is_an_error():
    falling = mc.Mechanism.from_xml(
        '<mujoco><worldbody><body><joint type="slide" axis="0 0 1"/><inertial pos="0 0 0" mass="1" '
        'diaginertia="1 1 1"/></body></worldbody></mujoco>'
    )
    with pytest.raises(mc.StartError, match="no equilibrium found from the model's initial pose"):
        mc.find_equilibrium(falling)


# -- observables ---------------------------------------------------------------------------------------------


def test_height_is_another_name_for_the_z_of_joint_b(overcentre):
    q, p = next(random_rest(1))
    found = overcentre.measure(q[None], overcentre.values(p), ["height", "joint_B[2]"])[0]
    assert found == pytest.approx([q[1] + 0.5 * math.sin(q[2])] * 2, rel=1e-13)
    assert overcentre.observable("height").unit == "m"


def test_every_joint_position_is_an_observable(overcentre):
    q, p = next(random_rest(1))
    names = ["x_1", "z_1", "theta_1", "x_2", "z_2", "theta_2"]
    assert overcentre.measure(q[None], overcentre.values(p), names)[0] == pytest.approx(q, abs=1e-15)
    assert [overcentre.observable(n).unit for n in names] == ["m", "m", "rad", "m", "m", "rad"]


def test_a_sensor_comes_before_the_joint_of_its_name(pendulum_xml):
    sensor = '<framepos name="tip" objtype="site" objname="tip"/><tendonpos name="hip" tendon="twice"/>'
    twice = '<tendon><fixed name="twice"><joint joint="hip" coef="2"/></fixed></tendon>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(sensor=sensor, rest=twice))
    assert mechanism.measure(np.array([[0.3]]), mechanism.values(), ["hip"])[0, 0] == pytest.approx(0.6)


def test_a_vector_sensor_gives_one_observable_for_each_component(pendulum_xml):
    sensor = '<framepos name="top" objtype="site" objname="tip"/>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(sensor=sensor))
    found = mechanism.measure(np.array([[0.3]]), mechanism.values(), ["top[0]", "top[1]", "top[2]"])[0]
    assert found == pytest.approx([-math.sin(0.3), 0.0, math.cos(0.3)], abs=1e-14)


SENSORS = {
    "jointpos": ('<jointpos name="s" joint="hip"/>', "rad"),
    "framepos": ('<framepos name="s" objtype="site" objname="tip"/>', "m"),
    "fixed tendon over hinges": ('<tendonpos name="s" tendon="turn"/>', "rad"),
    "spatial tendon": ('<tendonpos name="s" tendon="line"/>', "m"),
    "actuator on a hinge": ('<actuatorfrc name="s" actuator="torque"/>', "N*m"),
    "force": ('<force name="s" site="tip"/>', "N"),
    "torque": ('<torque name="s" site="tip"/>', "N*m"),
    "potential energy": ('<e_potential name="s"/>', "J"),
}


@pytest.mark.parametrize(("sensor", "unit"), SENSORS.values(), ids=SENSORS.keys())
def test_the_unit_of_an_observable_follows_the_type_of_its_sensor(pendulum_xml, sensor, unit):
    tendons = """<tendon><fixed name="turn"><joint joint="hip" coef="1"/></fixed>
      <spatial name="line"><site site="wall"/><site site="tip"/></spatial></tendon>"""
    mechanism = mc.Mechanism.from_xml(
        pendulum_xml(
            sensor=sensor,
            rest=tendons,
            world='<site name="wall"/>',
            actuator='<motor name="torque" joint="hip"/>',
        )
    )
    assert next(iter(mechanism.observables.values())).unit == unit


def test_cutoff_and_noise_of_a_sensor_are_ignored(pendulum_xml):
    sensor = '<jointpos name="angle" joint="hip" cutoff="0.2" noise="0.1"/>'
    mechanism = mc.Mechanism.from_xml(pendulum_xml(sensor=sensor))
    assert mechanism.measure(np.array([[1.5]]), mechanism.values(), ["angle"])[0, 0] == 1.5


def test_a_python_function_is_an_observable(overcentre):
    overcentre.observe("gap_A", lambda model, data: float(np.linalg.norm(data.site("A_1").xpos)), "m")
    q, p = next(random_rest(1))
    found = overcentre.measure(q[None], overcentre.values(p), ["gap_A"])[0, 0]
    assert found == pytest.approx(np.hypot(*reference.gaps(q)[:2]), rel=1e-12)
    assert overcentre.observable("gap_A").unit == "m"


def test_an_observable_added_is_a_column_of_the_branch(overcentre):
    overcentre.observe("lean", lambda model, data: float(data.qpos[2] + data.qpos[5]), "rad")
    branch = mc.continue_equilibria(overcentre, "F", bounds=(45.0, 55.0), start={"F": 50.0})
    assert branch["lean"] == pytest.approx(branch["theta_1"] + branch["theta_2"], abs=1e-15)
    assert branch.unit("lean") == "rad"


def test_an_unknown_observable_is_an_error_with_close_matches(overcentre):
    with pytest.raises(mc.NameLookupError, match=r"observable 'thetta_1'\. Did you mean theta_1"):
        overcentre.observable("thetta_1")


def test_an_alias_of_an_unknown_sensor_is_an_error_with_close_matches(pendulum_xml):
    custom = '<text name="mjcont/lean" data="unit=rad : sensor:angel"/>'
    with pytest.raises(mc.NameLookupError, match=r"unknown sensor 'angel'\. Did you mean angle\?"):
        mc.Mechanism.from_xml(pendulum_xml(custom=custom, sensor='<jointpos name="angle" joint="hip"/>'))


def test_observables_follow_the_parameters(overcentre):
    q, p = next(random_rest(1))
    rows = [overcentre.values({"k_j": 10.0}), overcentre.values({"k_j": 40.0})]
    found = overcentre.measure(np.array([q, q]), rows, ["R_A_x"])[:, 0]
    assert found == pytest.approx([-10.0 * reference.gaps(q)[0], -40.0 * reference.gaps(q)[0]], rel=1e-12)


# -- what is printed -----------------------------------------------------------------------------------------


def test_printing_lists_freedoms_parameters_observables_and_starts(overcentre):
    text = str(overcentre)
    assert "overcentre: 6 degrees of freedom, 5 bush elements" in text
    lines = [line.split() for line in text.splitlines()]
    assert ["k_j", "1000", "N/m", "1", "1e+12", "field", "actuator:bush_*.biasprm[1]*-1"] in lines
    assert ["gravity_angle", "0", "deg", "-180", "180", "field", "gravity"] in lines
    assert ["theta_1", "60", "deg"] in lines
    assert ["height", "0.866025", "m"] in lines
    assert ["qpos0"] in lines


def test_all_parameters_of_the_reference_can_be_varied(overcentre):
    assert set(PARAMETERS) == set(overcentre.parameters)
