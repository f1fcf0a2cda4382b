"""Equality constraints as springs: stiffness, damping and added mass against the forces that MuJoCo returns."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.models.loading import models_folder

# two free bodies side by side; two hinges and two slides on the ground, with tendons
MODEL = """
<mujoco><compiler angle="radian"/><option timestep="0.005" gravity="0 0 0"><flag contact="disable" {flag}/></option>
<worldbody>
  <body name="a"><freejoint/><geom size="0.1" mass="2"/></body>
  <body name="b" pos="0.3 0 0"><freejoint/><geom type="box" size="0.1 0.2 0.3" mass="5"/></body>
  <body name="c" pos="3 0 0"><joint name="h1" axis="0 1 0"/><geom size="0.1" pos="0.5 0 0" mass="2"/></body>
  <body name="d" pos="5 0 0"><joint name="h2" axis="0 1 0"/><geom size="0.2" pos="0.4 0 0" mass="3"/></body>
  <body name="e" pos="7 0 0"><joint name="s1" type="slide" axis="1 0 0"/><geom size="0.1" mass="4"/>
    <site name="e"/></body>
  <body name="f" pos="8 0 0"><joint name="s2" type="slide" axis="1 0 0"/><geom size="0.1" mass="1"/>
    <site name="f"/></body>
  <site name="left" pos="6 0 0"/><site name="right" pos="9 0 0"/>
</worldbody>
<tendon>
  <fixed name="turn"><joint joint="h1" coef="0.5"/></fixed>
  <fixed name="turn_2"><joint joint="h2" coef="0.8"/></fixed>
  <spatial name="rope"><site site="left"/><site site="e"/></spatial>
  <spatial name="rope_2"><site site="f"/><site site="right"/></spatial>
</tendon>
<equality>{equality}</equality></mujoco>"""

CONNECT = '<connect name="eq" body1="a" body2="b" anchor="0 0 0" {s}/>'
WELD = '<weld name="eq" body1="a" body2="b" torquescale="0.7" {s}/>'
HINGES = '<joint name="eq" joint1="h1" joint2="h2" polycoef="0 2 0.5 0 0" {s}/>'
SLIDE = '<joint name="eq" joint1="s1" {s}/>'
ROPES = '<tendon name="eq" tendon1="rope" tendon2="rope_2" {s}/>'
TURNS = '<tendon name="eq" tendon1="turn" tendon2="turn_2" {s}/>'

# what is moved: the coordinate of qpos and of qvel, and how far the constraint opens per unit of it
CASES = {
    "connect": (CONNECT, 1, 1, 1.0, "connect", "N/m"),
    "weld": (WELD, 1, 1, 1.0, "weld", "N/m"),
    "two hinges": (HINGES, 14, 12, 1.0, "joint", "N*m/rad"),
    "a slide": (SLIDE, 16, 14, 1.0, "joint", "N/m"),
    "ropes": (ROPES, 16, 14, 1.0, "tendon", "N/m"),
    "tendons on hinges": (TURNS, 14, 12, 0.5, "tendon", "N*m/rad"),
}
SOLVERS = {
    "direct, constant impedance": 'solref="-2e4 -100" solimp="0.9 0.9 0.001"',
    "direct, growing impedance": 'solref="-2e4 -100" solimp="0.5 0.8 0.02 0.3 3"',
    "direct, falling impedance": 'solref="-2e4 -100" solimp="0.9 0.6 0.02 0.5 1"',
    "direct, impedance of no width": 'solref="-2e4 -100" solimp="0.5 0.8 0 0.5 2"',
    "direct, impedance beyond its range": 'solref="-2e4 -100" solimp="-1 2 0.02"',
    "standard": 'solref="0.05 0.7" solimp="0.9 0.95 0.02"',
    "standard, clamped by the timestep": 'solref="0.001 1" solimp="0.9 0.95 0.001"',
    "of mixed signs": 'solref="0.05 -1"',
    "MuJoCo's own": "",
}
GAPS = [1e-6, 1e-4, 5e-3, 0.015, 0.03]


def text_of(equality, solver="", flag=""):
    return MODEL.format(equality=equality.format(s=solver), flag=flag)


def model_of(equality, solver="", flag=""):
    return mujoco.MjModel.from_xml_string(text_of(equality, solver, flag))


def force(model, *, qpos=None, qvel=None, qacc=None):
    """Return MuJoCo's generalised constraint forces with one coordinate of each displaced."""
    data = mujoco.MjData(model)
    for array, change in ((data.qpos, qpos), (data.qvel, qvel), (data.qacc, qacc)):
        if change is not None:
            array[change[0]] += change[1]
    mujoco.mj_inverse(model, data)
    return data.qfrc_constraint


@pytest.mark.parametrize("gap", GAPS)
@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
@pytest.mark.parametrize("case", CASES)
def test_the_stiffness_is_mujocos_force_over_the_gap(case, solver, gap):
    equality, position, velocity, lever, kind, unit = CASES[case]
    model = model_of(equality, solver)
    spring = mc.constraint_stiffness(model)[0]
    assert (spring.name, spring.kind, spring.unit) == ("eq", kind, unit)
    found = force(model, qpos=(position, gap / lever))[velocity] / -lever
    assert found == pytest.approx(spring.at(gap) * gap, rel=1e-9, abs=1e-30)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
def test_the_stiffness_of_the_closed_constraint_is_the_slope_of_its_force(case, solver):
    equality, position, velocity, lever, *_ = CASES[case]
    model = model_of(equality, solver)
    slope = force(model, qpos=(position, 1e-12 / lever))[velocity] / -lever / 1e-12
    assert slope == pytest.approx(mc.constraint_stiffness(model)[0].stiffness, rel=1e-3 if "rope" in case else 1e-9)


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
@pytest.mark.parametrize("angle", [1e-6, 1e-3, 0.05, 0.5, 3.0])
def test_the_rotational_stiffness_of_a_weld_is_mujocos_torque_over_the_angle(solver, angle):
    model = model_of(WELD, solver)
    _, turning = mc.constraint_stiffness(model)
    assert (turning.kind, turning.unit) == ("weld rotation", "N*m/rad")
    data = mujoco.MjData(model)
    axis = np.array([1.0, -2.0, 2.0]) / 3.0  # turns the second body about its own centre, where the anchor is
    mujoco.mju_axisAngle2Quat(data.qpos[10:14], axis, angle)
    mujoco.mj_inverse(model, data)
    torque = data.qfrc_constraint[9:12] @ axis
    assert -torque == pytest.approx(turning.at(angle) * angle, rel=1e-9)


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
@pytest.mark.parametrize("case", CASES)
def test_damping_and_added_mass_are_what_velocity_and_acceleration_add_to_the_force(case, solver):
    equality, _, velocity, lever, *_ = CASES[case]
    model = model_of(equality, solver)
    spring = mc.constraint_stiffness(model)[0]
    damping = -force(model, qvel=(velocity, 1.0))[velocity] / lever**2
    mass = -force(model, qacc=(velocity, 1.0))[velocity] / lever**2
    assert damping == pytest.approx(spring.damping, rel=1e-9)
    assert mass == pytest.approx(spring.added_mass, rel=1e-9)


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
def test_damping_and_added_mass_of_a_welds_rotation_are_those_of_the_force(solver):
    model = model_of(WELD, solver)
    _, turning = mc.constraint_stiffness(model)
    assert -force(model, qvel=(10, 1.0))[10] == pytest.approx(turning.damping, rel=1e-9)
    assert -force(model, qacc=(10, 1.0))[10] == pytest.approx(turning.added_mass, rel=1e-9)


@pytest.mark.parametrize("case", ["two hinges", "tendons on hinges"])
def test_the_weights_are_those_of_qpos0_at_every_pose(case):
    equality, position, velocity, lever, *_ = CASES[case]
    model = model_of(equality, SOLVERS["direct, constant impedance"])
    data = mujoco.MjData(model)
    rates = []
    for turn in (0.0, 1.3):
        data.qpos[14:16] = turn, turn
        at = []
        for small in (0.0, 1e-5):
            data.qpos[position] += small
            mujoco.mj_inverse(model, data)
            at.append(data.qfrc_constraint[velocity])
        data.qpos[position] -= 1e-5
        rates.append((at[0] - at[1]) / 1e-5 / lever**2)
    assert rates == pytest.approx([mc.constraint_stiffness(model)[0].stiffness] * 2, rel=1e-6)


# -- what it depends on ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("solver", "gap", "timestep"),
    [
        ("direct, constant impedance", False, False),
        ("direct, growing impedance", True, False),
        ("direct, impedance of no width", False, False),
        ("standard", True, False),
        ("standard, clamped by the timestep", True, True),
        ("MuJoCo's own", True, False),
    ],
)
def test_it_is_known_what_the_stiffness_depends_on(solver, gap, timestep):
    spring = mc.constraint_stiffness(model_of(CONNECT, SOLVERS[solver]))[0]
    assert (spring.depends_on_gap, spring.depends_on_timestep, spring.depends_on_pose) == (gap, timestep, False)


def test_the_clamp_ends_at_two_timesteps():
    for factor, clamped in ((1.99, True), (2.0, False)):
        spring = mc.constraint_stiffness(model_of(CONNECT, f'solref="{0.005 * factor} 1"'))[0]
        assert spring.depends_on_timestep is clamped


def test_without_refsafe_nothing_is_clamped():
    solver = SOLVERS["standard, clamped by the timestep"]
    model = model_of(CONNECT, solver, flag='refsafe="disable"')
    spring = mc.constraint_stiffness(model)[0]
    assert not spring.depends_on_timestep
    assert -force(model, qpos=(1, 1e-4))[1] == pytest.approx(spring.at(1e-4) * 1e-4, rel=1e-9)


def test_diagexact_makes_the_stiffness_depend_on_the_pose_and_the_softest_direction_is_stated():
    aside = CONNECT.replace("0 0 0", "1 0 0")
    model = model_of(aside, SOLVERS["direct, constant impedance"], flag='diagexact="enable"')
    spring = mc.constraint_stiffness(model)[0]
    assert spring.depends_on_pose
    opened = [-force(model, qpos=(k, 1e-6))[k] / 1e-6 for k in range(3)]
    assert min(opened) == pytest.approx(spring.stiffness, rel=1e-9)
    assert max(opened) > 2.0 * min(opened)


def test_inactive_and_disabled_equalities_are_no_springs():
    assert mc.constraint_stiffness(model_of(CONNECT, 'active="false"')) == []
    assert mc.constraint_stiffness(model_of(CONNECT, flag='equality="disable"')) == []


HANGING = """<mujoco><option timestep="0.005" integrator="{integrator}"/><worldbody><site name="top"/>
  <body><joint name="z" type="slide"/><geom size="0.1" mass="2"/><site name="hook"/></body></worldbody>
  <equality><connect name="hook" site1="hook" site2="top" solref="{solref}" solimp="0.9 0.9 0.001"/></equality>
</mujoco>"""


@pytest.mark.parametrize("integrator", ["Euler", "implicitfast", "discrete"])
@pytest.mark.parametrize("solref", ["0.002 1", "0.05 1", "-1e4 -300"])
def test_a_hanging_weight_comes_to_rest_where_the_stiffness_says(integrator, solref):
    # time histories with "discrete" do not clamp the time constant, others do: the equilibria follow them
    mechanism = mc.Mechanism.from_xml(HANGING.format(integrator=integrator, solref=solref))
    model = mechanism.simulation_model()
    data = mujoco.MjData(model)
    for _ in range(1000):
        mujoco.mj_step(model, data)
    (spring,) = mc.constraint_stiffness(mechanism)
    assert data.qpos[0] == pytest.approx(-2.0 * 9.81 / spring.stiffness, rel=1e-7)
    assert mc.find_equilibrium(mechanism)["z"] == pytest.approx(data.qpos[0], rel=1e-7)
    assert spring.depends_on_timestep == (solref == "0.002 1" and integrator != "discrete")


# -- in words --------------------------------------------------------------------------------------------------------


def shown(equality, solver="", **more):
    return str(mc.Mechanism.from_xml(text_of(equality, solver, **more)))


def test_inspect_states_the_stiffness_of_each_equality():
    # A = 1/2 + 1/5, K = 2e4 / (0.1 A)
    text = shown(CONNECT, SOLVERS["direct, constant impedance"])
    assert "connect eq: 2.857e+05 N/m at rest, damping 1.43e+03 N*s/m, adds 12.9 kg" in text
    assert "depends on" not in text and "clamped" not in text


def test_inspect_says_that_the_stiffness_depends_on_the_gap_and_how_to_make_it_constant():
    text = shown(CONNECT, 'solref="-2e4 -100" solimp="0.9 0.95 0.002"')
    low, high = (2e4 / 0.95**2 * d**2 / ((1 - d) * 0.7) for d in (0.9, 0.95))
    assert f"stiffness depends on the gap: {low:.3g} to {high:.3g} N/m over solimp's width 0.002" in text
    assert 'solimp="0.9 0.9 0.002" makes it constant' in text


def test_inspect_says_that_the_timestep_clamps_solref():
    text = shown(CONNECT, SOLVERS["standard, clamped by the timestep"])
    assert "solref is clamped by the timestep: its time constant 0.001 s acts as 0.01 s" in text


DAMPED = HANGING.replace('type="slide"', 'type="slide" damping="2000"').replace("{solref}", "-1e4 -200")


@pytest.mark.parametrize("integrator", ["Euler", "discrete"])
def test_inspect_says_where_time_histories_have_a_stiffer_constraint(integrator):
    # with "discrete" the weight is 1 / (m + h c) in place of 1 / m
    mechanism = mc.Mechanism.from_xml(DAMPED.format(integrator=integrator))
    model = mechanism.simulation_model()
    data = mujoco.MjData(model)
    for _ in range(4000):
        mujoco.mj_step(model, data)
    ratio = 2.0 * 9.81 / -data.qpos[0] / mc.constraint_stiffness(mechanism)[0].stiffness
    assert ratio == pytest.approx(1.0 if integrator == "Euler" else (2.0 + 0.005 * 2000.0) / 2.0, rel=1e-6)
    assert ("stiffer in time histories" in str(mechanism)) == (ratio > 1.1)


def test_inspect_says_that_the_stiffness_depends_on_the_pose():
    assert "depends on the pose (diagexact)" in shown(CONNECT, flag='diagexact="enable"')


def test_inspect_shows_both_springs_of_a_weld_and_names_for_nameless_equalities():
    text = shown(WELD.replace('name="eq"', ""))
    assert "weld equality0: " in text and "weld rotation equality0: " in text


def test_the_command_inspect_prints_it(capsys):
    assert main(["inspect", "watt_six_bar"]) == 0
    assert "connect F: " in capsys.readouterr().out.split("constraints as springs")[1]


def test_a_branch_says_which_springs_its_constraints_are(tmp_path):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), max_points=20)
    line = "connect C is a spring of 1e+06 N/m at rest"
    assert line in branch.notes and f"note: {line}" in str(branch)
    branch.save(tmp_path / "branch.h5")
    assert line in str(mc.load(tmp_path / "branch.h5"))


def test_a_branch_in_the_stiffness_says_its_range():
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(mechanism, "equality:C.stiffness", bounds=(1e5, 1e7))
    assert "connect C is a spring of 1e+05 to 1e+07 N/m at rest" in branch.notes


def test_the_note_is_on_the_stiffness_at_the_parameters_of_the_branch():
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(
        mechanism, "M", bounds=(-20, 20), max_points=20, start={"equality:C.stiffness": 3e4}
    )
    assert "connect C is a spring of 3e+04 N/m at rest" in branch.notes


def test_the_note_follows_a_mass_that_the_constraint_weighs():
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    values = {"body:rocker.mass": 1.0}
    (note,) = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), max_points=5, start=values).notes
    lighter = (models_folder() / "four_bar.xml").read_text().replace(
        'mass="2" diaginertia="0.1004 0.1004 0.1004"', 'mass="1" diaginertia="0.0502 0.0502 0.0502"'
    )
    loaded = [mc.constraint_stiffness(mc.Mechanism.from_xml(m))[0] for m in ("four_bar", lighter)]
    assert f"a spring of {1e6 * loaded[1].stiffness / loaded[0].stiffness:.4g} N/m" in note


# -- as a parameter --------------------------------------------------------------------------------------------------


def measured(mechanism, values, case):
    """Return the stiffness of a mechanism's constraint from its residual."""
    _, position, velocity, lever, *_ = CASES[case]
    moved = mechanism.qpos0.copy()
    moved[position] += 1e-4 / lever
    return -mechanism.residual(moved, mechanism.values(values))[velocity] / lever / 1e-4


@pytest.mark.parametrize("value", [1.0, 2.5e5, 1e10])
@pytest.mark.parametrize("solver", ['solref="-2e4 -100"', 'solref="0.05 0.7"', 'solref="0.001 1"'])
@pytest.mark.parametrize("case", CASES)
def test_the_parameter_is_the_stiffness_in_newtons_per_metre(case, solver, value):
    text = text_of(CASES[case][0], solver + ' solimp="0.8 0.8 0.01"')
    mechanism = mc.Mechanism.from_xml(text)
    parameter = mechanism.parameter("equality:eq.stiffness")
    assert parameter.unit == CASES[case][-1]
    assert parameter.value == pytest.approx(measured(mechanism, {}, case), rel=1e-9)
    assert measured(mechanism, {parameter.name: value}, case) == pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize("case", ["connect", "two hinges"])
def test_a_damping_ratio_stays_as_the_stiffness_changes(case):
    text = text_of(CASES[case][0], 'solref="0.05 0.7" solimp="0.8 0.8 0.01"')
    mechanism = mc.Mechanism.from_xml(text)
    loaded = mechanism.parameter("equality:eq.stiffness").value
    x, velocity = mechanism.qpos0, CASES[case][2]
    found = []
    for stiffness in (loaded, 4.0 * loaded, 1e8):
        values = mechanism.values({"equality:eq.stiffness": stiffness})
        pencil = mechanism.pencil(x, values, mechanism.linearize(x, values, ()).jac)
        found.append(pencil.damping[velocity, velocity] / math.sqrt(pencil.stiffness[velocity, velocity]))
    assert found == pytest.approx([found[0]] * 3, rel=1e-6)


def test_a_damping_in_the_direct_form_stays_as_it_is():
    mechanism = mc.Mechanism.from_xml("four_bar")
    x = mechanism.qpos0
    dampings = []
    for stiffness in (1e4, 1e8):
        values = mechanism.values({"equality:C.stiffness": stiffness})
        dampings.append(mechanism.pencil(x, values, mechanism.linearize(x, values, ()).jac).damping)
    np.testing.assert_allclose(dampings[0], dampings[1], rtol=1e-9, atol=1e-9)


def test_the_derivative_in_the_stiffness_is_that_of_differences():
    mechanism = mc.Mechanism.from_xml("four_bar")
    name = "equality:C.stiffness"
    mechanism.parameter(name)
    x = mechanism.qpos0 + [0.01, 0.0, -0.02]
    values = mechanism.values({name: 1e5})
    exact = mechanism.linearize(x, values, (name,)).par[:, 0]
    f = [mechanism.residual(x, mechanism.values({name: k})) for k in (0.9e5, 1.1e5)]
    np.testing.assert_allclose(exact, (f[1] - f[0]) / 0.2e5, rtol=1e-9)


def test_factors_and_declarations_in_the_xml_act_on_the_stiffness():
    text = (models_folder() / "four_bar.xml").read_text()
    text = text.replace("</custom>", '<text name="mjcont/soft" data="unit=kN/m : equality:C.stiffness*1e3"/></custom>')
    mechanism = mc.Mechanism.from_xml(text)
    assert mechanism.parameters["soft"].value == pytest.approx(mc.constraint_stiffness(mechanism)[0].stiffness / 1e3)
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), max_points=5, start={"soft": 50.0})
    assert "connect C is a spring of 5e+04 N/m at rest" in branch.notes


def test_a_file_brings_the_parameter_back(tmp_path):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(mechanism, "equality:C.stiffness", bounds=(1e5, 1e7))
    branch.save(tmp_path / "branch.h5")
    again = mc.load(tmp_path / "branch.h5")
    parameters = branch.row(0).parameters
    np.testing.assert_array_equal(
        again.problem.residual(again.states[0], again.problem.values(parameters)),
        mechanism.residual(branch.states[0], mechanism.values(parameters)),
    )


@pytest.mark.parametrize("stiffness", [1e3, 1e6])
def test_every_closure_can_be_given_one_stiffness(stiffness):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("watt_six_bar", stiffness))
    assert [s.stiffness for s in mc.constraint_stiffness(mechanism)] == pytest.approx([stiffness] * 2, rel=1e-12)
    assert mechanism.parameter("equality:*.stiffness").value == pytest.approx(stiffness)


@pytest.mark.parametrize("solver", SOLVERS.values(), ids=SOLVERS)
@pytest.mark.parametrize("case", CASES)
def test_a_stiffness_given_to_any_equality_is_constant_and_critically_damped(case, solver):
    text = text_of(CASES[case][0], solver)
    (spring, *_) = mc.constraint_stiffness(mc.set_constraint_stiffness(text, 3e4, ["eq"]).compile())
    assert (spring.stiffness, spring.at(0.01)) == pytest.approx((3e4, 3e4), rel=1e-12)
    d = spring.solimp[0]
    # the manual: damping = 2 sqrt(stiffness) of the direct form is critical
    stiffness, damping = (v * (1 - d) * spring.weight for v in (spring.stiffness, spring.damping))
    assert damping == pytest.approx(2.0 * math.sqrt(stiffness), rel=1e-12)


# -- mistakes --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("equality", "solver", "more", "path", "message"),
    [
        (CONNECT, "", {}, "eq.stiffness", "depends on its gap.*solimp=\"0.9 0.9 0.001\".*set_constraint_stiffness"),
        (CONNECT, 'active="false" solimp="0.9 0.9 0.001"', {}, "eq.stiffness", "'eq' is not an active connect"),
        (CONNECT, 'solimp="0.9 0.9 1"', {"flag": 'diagexact="enable"'}, "eq.stiffness", "diagexact.*remove the flag"),
        (CONNECT, 'solimp="0.9 0.9 0.001"', {}, "eqq.stiffness", "matches no equality.*names: eq"),
        (CONNECT, 'solimp="0.9 0.9 0.001"', {}, "eq.stiffnes", "unknown attribute of a equality 'stiffnes'.*stiffness"),
        (CONNECT, 'solimp="0.9 0.9 0.001"', {}, "eq.stiffness[0]", "equality:NAME.stiffness has no index"),
    ],
)
def test_a_stiffness_that_cannot_be_set_is_an_error_that_says_what_to_do(equality, solver, more, path, message):
    text = text_of(equality, solver, **more)
    with pytest.raises(mc.MjcontError, match=message):
        mc.Mechanism.from_xml(text).parameter(f"equality:{path}")


def test_stiffnesses_that_differ_need_to_be_made_equal_first():
    with pytest.raises(mc.ParameterError, match="its targets disagree"):
        mc.Mechanism.from_xml("watt_six_bar").parameter("equality:*.stiffness")


def test_a_stiffness_must_be_positive():
    mechanism = mc.Mechanism.from_xml("four_bar")
    with pytest.raises(mc.BoundsError, match=r"equality:C.stiffness = -1 lies outside the positive numbers"):
        mechanism.values({"equality:C.stiffness": -1.0})
    with pytest.raises(mc.BoundsError, match=r"leave the positive numbers.*narrow the bounds"):
        mc.continue_equilibria(mechanism, "equality:C.stiffness", bounds=(-1.0, 1e6))


@pytest.mark.parametrize(
    ("model", "arguments", "message"),
    [
        ("four_bar", {"stiffness": -1.0}, "must be a positive number"),
        ("four_bar", {"equalities": ["D"]}, "unknown equality 'D'. Valid: C."),
        ("overcentre", {}, "nothing to give stiffness"),
    ],
)
def test_a_mistake_in_giving_stiffness_is_an_error_that_names_the_choices(model, arguments, message):
    with pytest.raises(mc.MjcontError, match=message):
        mc.set_constraint_stiffness(model, **arguments)
