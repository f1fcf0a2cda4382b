"""Models that none of us wrote, from the packages in `thirdparty.py`.

Stability is held against motion: from beside each equilibrium, along an eigenvector of s^2 M + s C + K, the model moves
as exp(s t) says, by MuJoCo's own time steps. Tendon lengths are written by hand.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest
from problems.thirdparty import FOLDER, WHEELS, fetch, unpacked
from scipy import optimize

import mjcont as mc

pytestmark = pytest.mark.thirdparty

if any(not unpacked(p).is_dir() for p in WHEELS):
    pytest.skip("models of other packages are not there: make test-thirdparty", allow_module_level=True)

DATA = unpacked("mujoco_warp") / "mujoco_warp" / "test_data"
SOURCE = unpacked("playground") / "mujoco_playground" / "_src"
SUITE = SOURCE / "dm_control_suite" / "xmls"
PANDA = SOURCE / "manipulation" / "franka_emika_panda_robotiq" / "xmls" / "panda_updated_robotiq_2f85.xml"
RIGID_MODES = tuple(f"{kind} {axis}" for kind in ("translation along", "rotation about") for axis in "xyz")
NOISE = 1e-12


def load(path):
    return mc.Mechanism.from_xml(path)


def tendon_model(name):
    return load(DATA / "tendon" / f"{name}.xml")


def modes(point):
    """Eigenvalues and eigenvectors (columns, position part) of the pencil at a point."""
    problem, x, n = point.problem, point.state, point.problem.n
    pencil = problem.pencil(x, point.parameters, problem.linearize(x, point.parameters, ()).jac)
    block = np.zeros((2 * n, 2 * n))
    block[:n, n:] = np.eye(n)
    block[n:] = -np.linalg.solve(pencil.mass, np.hstack([pencil.stiffness, pencil.damping]))
    rates, vectors = np.linalg.eig(block)
    return rates, vectors[:n] / np.abs(vectors[:n]).max(axis=0)


def motion(point, away, speed, duration, timestep=2e-4):
    """Tangent step from the point after a time, by MuJoCo's RK4 with its solver run to the end."""
    problem = point.problem
    model = problem.simulation_model()
    model.opt.integrator, model.opt.timestep = mujoco.mjtIntegrator.mjINT_RK4, timestep
    model.opt.iterations, model.opt.ls_iterations, model.opt.tolerance = 100, 50, 0.0
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    writer = problem.writer(model)
    writer.write(problem.parameters, point.parameters)
    data = mujoco.MjData(model)
    writer.inputs.put(data)
    data.qpos[:], data.qvel[:] = problem.retract(point.state, away), speed
    for _ in range(round(duration / timestep)):
        mujoco.mj_step(model, data)
    return problem.difference(data.qpos, point.state)


def assert_moves_as_its_eigenvalues_say(point, pick=np.argmax, amplitude=1e-5, tolerance=0.02):
    """Follow one mode for half a turn, or until it has changed by a factor of three."""
    rates, vectors = modes(point)
    k = pick(np.where(rates.imag >= 0, rates.real, -np.inf))
    rate, vector = rates[k], amplitude * vectors[:, k]
    duration = min(math.pi / max(abs(rate.imag), 1e-9), 1.1 / max(abs(rate.real), 1e-9))
    found = motion(point, vector.real, (rate * vector).real, duration)
    expected = (np.exp(rate * duration) * vector).real
    envelope = amplitude * math.exp(rate.real * duration)
    assert np.abs(found - expected).max() < tolerance * envelope


def assert_ends_at_bounds_in_equilibrium(branch):
    assert [status for status, _ in branch.ends] == ["at bound", "at bound"]
    assert branch.residuals.max() < NOISE


# -- a box on a connect -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def box():
    return load(DATA / "jdotv" / "connect_2d.xml")


def test_the_box_hangs_below_its_pin_and_turns_freely_about_the_vertical(box):
    point = mc.find_equilibrium(box)
    assert point.state[:3] == pytest.approx([0.5, 0.0, 0.5], abs=1e-3)
    assert point.problem.held == ("rotation about z through (0.5, 0, 0)",)


def test_the_box_swings_as_a_physical_pendulum(box):
    """Without joint damping only the pin's softness damps the swing, at a rate of 1e-4 of its frequency."""
    rates, _ = modes(mc.find_equilibrium(box))
    swing = rates[(rates.imag > 0) & (rates.imag < 10) & (np.abs(rates.real) < 1)]
    about_pin = [(0.04 + 1.0) / 12 + 0.25, (0.04 + 1.0) / 12 + 0.25]
    assert sorted(swing.imag) == pytest.approx(np.sqrt(0.5 * 9.81 / np.array(about_pin)), rel=1e-3)
    assert np.all(np.abs(swing.real) < 1e-4 * swing.imag)


def test_the_box_swings_as_its_eigenvalues_say(box):
    assert_moves_as_its_eigenvalues_say(mc.find_equilibrium(box))


def test_the_box_is_followed_under_growing_weight(box):
    assert_ends_at_bounds_in_equilibrium(mc.continue_equilibria(box, "load_factor", bounds=(0.1, 3.0)))


def test_two_falling_boxes_have_no_equilibrium():
    for name in ("connect_3d", "weld_3d"):
        with pytest.raises(mc.StartError, match="no equilibrium found from the model's initial pose"):
            mc.find_equilibrium(load(DATA / "jdotv" / f"{name}.xml"))


@pytest.mark.parametrize(("name", "stability"), [("connect_3d", "marginal"), ("weld_3d", "stable")])
def test_without_weight_only_the_pinned_boxes_have_motions_of_their_own(name, stability):
    """Six modes of the whole are held; a pin leaves three turns of one box against the other, a weld none."""
    point = mc.find_equilibrium(load(DATA / "jdotv" / f"{name}.xml"), {"load_factor": 0.0})
    assert point.problem.held == RIGID_MODES
    assert (point.stability, point.n_unstable) == (stability, 0)


# -- tendons ----------------------------------------------------------------------------------------------------

MASS = 1000.0 * 4.0 / 3.0 * math.pi * 0.2**3


@pytest.mark.parametrize(("name", "stability"), [("armature", "marginal"), ("damping", "stable")])
def test_a_ball_on_a_tendon_spring_hangs_as_in_closed_form(name, stability):
    """V = -m g sin(q) + k (2 sin(q/2))^2 / 2, so that tan(q) = m g / k; a tendon's inertia damps nothing."""
    mechanism = tendon_model(name)
    mechanism.declare("k", "tendon:*.stiffness", unit="N/m")
    branch = mc.continue_equilibria(mechanism, "k", bounds=(0.0, 1000.0))
    assert_ends_at_bounds_in_equilibrium(branch)
    assert branch.states[:, 0] == pytest.approx(np.arctan2(MASS * 9.81, branch["k"]), rel=1e-9)
    assert set(branch.stability) == {stability}
    assert_moves_as_its_eigenvalues_say(mc.find_equilibrium(mechanism))


def spatial_lengths(q, name):
    """Lengths of the tendons of `site` and `pulley_site` (the last three through pulleys or not)."""
    first = np.array([q[0], 0.0, 0.1])
    second = np.array([q[0] + q[1] + 0.2 * math.sin(q[2]), 0.0, 0.2 * math.cos(q[2])])
    a, b, c = np.linalg.norm(first), np.linalg.norm(second - first), np.linalg.norm(second)
    return np.array([(a + b) / 2, a, c, b / 3] if name == "pulley_site" else [a + b, a, c, b])


@pytest.mark.parametrize("name", ["site", "pulley_site"])
def test_forces_on_spatial_tendons_balance_springs(name):
    """k q = sum u_i dL_i/dq with lengths written by hand; the hinge's spring has the slides' number."""
    mechanism = tendon_model(name)
    mechanism.declare("k", "joint:*.stiffness")
    forces = {"actuator0": 0.5, "actuator1": -0.3, "actuator2": -0.4, "actuator3": 0.2}
    branch = mc.continue_equilibria(
        mechanism, "actuator1", bounds=(-0.5, 0.5), start={"k": 2.0, **forces}, keyframe="key0"
    )
    assert_ends_at_bounds_in_equilibrium(branch)
    for i in range(0, len(branch), 5):
        u = np.array(list({**forces, "actuator1": branch["actuator1"][i]}.values()))
        gradient = optimize.approx_fprime(branch.states[i], lambda q, u=u: u @ spatial_lengths(q, name), 1e-7)
        assert 2.0 * branch.states[i] == pytest.approx(gradient, abs=1e-6)


def test_a_pushed_tendon_buckles_where_its_hand_written_stiffness_vanishes():
    mechanism = tendon_model("site")
    mechanism.declare("k", "joint:*.stiffness")
    branch = mc.continue_equilibria(mechanism, "actuator0", bounds=(-1.0, 1.0), start={"k": 10.0})
    (point,) = branch.of_kind("BP")

    def least(u):
        h, signs = 1e-4, [(1, 1), (1, -1), (-1, 1), (-1, -1)]

        def second(a, b):
            return sum(s * r * spatial_lengths(h * (s * a + r * b), "site")[0] for s, r in signs) / (4 * h * h)

        return np.linalg.eigvalsh([[10.0 * (a @ b) - u * second(a, b) for a in np.eye(3)] for b in np.eye(3)])[0]

    assert point["actuator0"] == pytest.approx(optimize.brentq(least, 1e-3, 1.0), rel=1e-4)
    assert_moves_as_its_eigenvalues_say(mc.find_equilibrium(mechanism, {"k": 10.0, "actuator0": 1.0}))


@pytest.mark.parametrize(
    ("name", "coefficients"),
    [("fixed", [0.25, 0.5, 0.75]), ("fixed_site", [0.1, 0.2, 0.3]), ("pulley_fixed_site", [0.1, 0.2, 0.3])],
)
def test_a_fixed_tendon_moves_its_joints_in_proportion(name, coefficients):
    mechanism = tendon_model(name)
    mechanism.declare("k", "joint:*.stiffness")
    branch = mc.continue_equilibria(mechanism, "actuator0", bounds=(-1.0, 1.0), start={"k": 10.0})
    assert_ends_at_bounds_in_equilibrium(branch)
    assert branch.states == pytest.approx(np.outer(branch["actuator0"], coefficients) / 10.0, abs=1e-12)
    assert set(branch.stability) == {"marginal"}


@pytest.mark.parametrize("name", ["site_fixed", "pulley_site_fixed", "wrap", "pulley_wrap"])
def test_tendons_without_stiffness_leave_springs_and_tilted_weight_alone(name):
    mechanism = tendon_model(name)
    mechanism.declare("k", "joint:*.stiffness")
    # from the keyframe the springs draw the wrapped ones against a contact, where they stay
    where = {"state": [0.0, 1.0]} if name.endswith("wrap") else {"keyframe": "key0"}
    branch = mc.continue_equilibria(mechanism, "gravity_angle", bounds=(-1.0, 1.0), start={"k": 1000.0}, **where)
    assert_ends_at_bounds_in_equilibrium(branch)
    ball = 1000.0 * 4.0 / 3.0 * math.pi * 0.1**3
    carried = 2 * ball if name.endswith("fixed") else ball
    expected = -carried * 9.81 * np.sin(branch["gravity_angle"]) / 1000.0
    assert branch.states[:, 0] == pytest.approx(expected, abs=1e-9)
    assert set(branch.stability) == {"marginal"}


def test_a_tendon_limit_engages_at_a_corner():
    """The limited length is 0.25 q0 + 0.5 q1 + 0.75 q2 = 1.5 r for springs at r: corners at r = 0 and 1/3."""
    mechanism = tendon_model("tendon_limit")
    mechanism.declare("k", "joint:*.stiffness")
    mechanism.declare("r", "joint:*.springref", unit="rad")
    branch = mc.continue_equilibria(mechanism, "r", bounds=(-1.0, 1.0), start={"k": 10.0, "r": 0.2})
    assert_ends_at_bounds_in_equilibrium(branch)
    assert [p["r"] for p in branch.of_kind("CO")] == pytest.approx([0.0, 1.0 / 3.0], abs=1e-7)
    between = (branch["r"] > 0.01) & (branch["r"] < 0.33)
    assert branch.states[between] == pytest.approx(np.outer(branch["r"][between], np.ones(3)), abs=1e-12)


# -- ball in cup ------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cup():
    return load(SUITE / "ball_in_cup.xml")


def test_the_ball_hangs_on_its_string(cup):
    point = mc.find_equilibrium(cup)
    assert point.stability == "stable"
    assert cup.active(point.state, point.parameters) == {"upper limit of string"}
    weight = sum(cup.simulation_model().body_mass[1:]) * 9.81
    assert point.state[1] == pytest.approx(-weight / 20.0, rel=1e-9)
    assert_moves_as_its_eigenvalues_say(point)


def test_the_stretch_of_the_string_decays_as_its_eigenvalues_say(cup):
    """The fastest mode, which the string's limit damps: the motion must stay where the limit carries load."""

    def fastest(rates):
        return int(np.argmin(np.where(np.isfinite(rates), rates, 0.0)))

    assert_moves_as_its_eigenvalues_say(mc.find_equilibrium(cup), pick=fastest, amplitude=1e-7)


@pytest.mark.parametrize("control", ["x", "z"])
def test_the_cup_is_moved_by_its_controls(cup, control):
    branch = mc.continue_equilibria(cup, control, bounds=(-0.3, 1.0))
    assert_ends_at_bounds_in_equilibrium(branch)
    rest = mc.find_equilibrium(cup)[f"cup_{control}"]
    assert branch[f"cup_{control}"] == pytest.approx(rest + 5.0 * branch[control] / 20.0, abs=1e-9)
    assert set(branch.stability) == {"stable"}


def test_the_ball_comes_to_lie_on_the_ground(cup):
    branch = mc.continue_equilibria(cup, "z", bounds=(-1.0, 0.5))
    assert_ends_at_bounds_in_equilibrium(branch)
    assert "contact of ground and ball engages" in str(branch)
    lying = branch["z"] < branch.of_kind("CO")[0]["z"]
    assert set(branch.stability[lying]) == {"marginal"}


# -- fish -------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def fish():
    return load(SUITE / "fish.xml")


def test_the_fish_swims_anywhere(fish):
    assert fish.rigid_modes(fish.start_state(), fish.values()) == RIGID_MODES


def test_the_fish_moves_as_its_eigenvalues_say(fish):
    point = mc.find_equilibrium(fish, {"tail": 0.5})
    assert point.stability == "stable"
    rates, vectors = modes(point)
    bends = np.abs(vectors[6:]).max(axis=0) > 0.1
    own = next(k for k in np.argsort(-rates.real) if bends[k] and rates[k].imag > 0)
    assert_moves_as_its_eigenvalues_say(point, pick=lambda _: own)


@pytest.mark.parametrize("control", ["tail", "tail_twist", "fins_flap", "finleft_pitch"])
def test_the_fish_is_bent_by_its_controls(fish, control):
    branch = mc.continue_equilibria(fish, control)
    assert_ends_at_bounds_in_equilibrium(branch)
    assert set(branch.stability) == {"stable"}
    assert branch.notes == (f"rigid-body zero modes held: {', '.join(RIGID_MODES)}",)


def test_a_servo_of_the_fish_reaches_its_command_against_no_spring(fish):
    branch = mc.continue_equilibria(fish, "tail")
    assert branch["tail1"] == pytest.approx(branch["tail"], abs=1e-9)


# -- a gripper on an arm ------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def panda():
    """The arm as it is, without its meshes, and springs that hold it."""
    mechanism = load(PANDA)
    mechanism.declare("k_arm", "joint:joint*.stiffness", unit="N m/rad")
    return mechanism


START = {"k_arm": 100.0, "fingers_actuator": 0.4}
REACH = np.array([0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.4, 0.4, -0.4, 0.4, 0.4, -0.4])


def test_the_gripper_loses_its_meshes_but_no_mass_unnoticed(panda):
    assert panda.n == 13
    assert "files are not there: base.stl, base_coupling.stl, c-a01-85-open.stl and 75 more" in panda.notes[0]
    assert any("mass of these geoms is not there: of base_mount, fts300_sensor_body" in note for note in panda.notes)


def test_the_gripper_closes_with_its_command(panda):
    branch = mc.continue_equilibria(panda, "fingers_actuator", bounds=(0.0, 0.8), start=START, state=REACH)
    assert_ends_at_bounds_in_equilibrium(branch)
    assert set(branch.stability) == {"stable"}
    assert branch["left_driver_joint"] == pytest.approx(branch["fingers_actuator"], abs=0.01)
    assert branch["right_driver_joint"] == pytest.approx(branch["left_driver_joint"], abs=1e-3)


def test_the_arm_settles_as_its_eigenvalues_say(panda):
    point = mc.find_equilibrium(panda, START, state=REACH)
    assert point.stability == "stable"
    assert_moves_as_its_eigenvalues_say(point)


def test_the_arm_without_springs_rests_anywhere_and_says_so(panda):
    with pytest.raises(mc.StartError, match="equilibria are not isolated"):
        mc.find_equilibrium(panda, {"fingers_actuator": 0.4}, state=REACH)


def test_a_branch_of_the_gripper_reloads(panda, tmp_path):
    branch = mc.continue_equilibria(panda, "k_arm", bounds=(50.0, 200.0), start=START, state=REACH)
    again = mc.load(branch.save(tmp_path / "gripper.h5"))
    assert again.problem.notes == panda.notes
    assert np.array_equal(again.problem.residual(branch.states[0], branch.row(0).parameters),
                          branch.problem.residual(branch.states[0], branch.row(0).parameters))


# -- all the others -------------------------------------------------------------------------------------------------

EVERY = sorted(path for package in WHEELS for path in unpacked(package).rglob("*.xml"))


@pytest.mark.filterwarnings("ignore:dry friction:mjcont.errors.ModelWarning")
@pytest.mark.parametrize("path", EVERY, ids=lambda p: "/".join(p.relative_to(FOLDER).parts[-3:]))
def test_every_model_loads_or_is_refused_with_a_sentence(path):
    try:
        mechanism = load(path)
    except mc.ModelError as error:
        assert len(str(error)) > 20
        return
    assert mechanism.name in str(mechanism)
    again = mc.Mechanism.from_xml(mechanism.mjcf)
    assert again.notes == mechanism.notes
    before, after = mechanism.simulation_model(), again.simulation_model()
    for field in ("body_mass", "body_inertia", "body_ipos", "dof_damping", "jnt_range", "actuator_biasprm", "eq_data"):
        assert getattr(after, field) == pytest.approx(getattr(before, field), rel=1e-12, abs=1e-15)


def test_the_wheels_are_those_that_were_pinned():
    assert [fetch(package) for package in WHEELS] == ["", ""]
    assert len(EVERY) > 100
