"""Equality constraints as springs: stiffness, damping and added mass against the forces that MuJoCo returns."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from problems.equalities import CASES, CONNECT, SOLVERS, WELD, text_of

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.models.loading import models_folder

GAPS = [1e-6, 1e-4, 5e-3, 0.015, 0.03]


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


@pytest.mark.slow
def test_a_branch_says_which_springs_its_constraints_are(tmp_path):
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), max_points=20)
    line = "connect C is a spring of 1e+06 N/m at rest"
    assert line in branch.notes and f"note: {line}" in str(branch)
    branch.save(tmp_path / "branch.h5")
    assert line in str(mc.load(tmp_path / "branch.h5"))


@pytest.mark.slow
def test_a_branch_in_the_stiffness_says_its_range():
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(mechanism, "equality:C.stiffness", bounds=(1e5, 1e7))
    assert "connect C is a spring of 1e+05 to 1e+07 N/m at rest" in branch.notes


@pytest.mark.slow
def test_the_note_is_on_the_stiffness_at_the_parameters_of_the_branch():
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    branch = mc.continue_equilibria(
        mechanism, "M", bounds=(-20, 20), max_points=20, start={"equality:C.stiffness": 3e4}
    )
    assert "connect C is a spring of 3e+04 N/m at rest" in branch.notes


@pytest.mark.slow
def test_the_note_follows_a_mass_that_the_constraint_weighs():
    mechanism = mc.Mechanism.from_spec(mc.set_constraint_stiffness("four_bar", 1e6))
    values = {"body:rocker.mass": 1.0}
    (note,) = mc.continue_equilibria(mechanism, "M", bounds=(-20, 20), max_points=5, start=values).notes
    lighter = (models_folder() / "four_bar.xml").read_text().replace(
        'mass="2" diaginertia="0.1004 0.1004 0.1004"', 'mass="1" diaginertia="0.0502 0.0502 0.0502"'
    )
    loaded = [mc.constraint_stiffness(mc.Mechanism.from_xml(m))[0] for m in ("four_bar", lighter)]
    assert f"a spring of {1e6 * loaded[1].stiffness / loaded[0].stiffness:.4g} N/m" in note
