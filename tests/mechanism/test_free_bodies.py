"""Bodies on free and ball joints, where a state has more coordinates than degrees of freedom.

The tethered float against its equations written by hand: with r the centre of gravity, R the rotation, s_i and a_i the
corners and anchors, d_i = r + R s_i - a_i, L_i = |d_i| and loads F_j (dead: fixed to the ground) at s_j,

    V = sum k max(0, L_i - l_0)^2 / 2 + m g r_z - sum F_j . (r + R s_j)
    force  f = -sum T_i d_i / L_i + sum F_j - m g e_z,     T_i = k max(0, L_i - l_0)
    moment t = sum s x R'F over all forces, in the body's frame,

and a tangent step is (dr, w): r + dr, R exp(w), as for a free joint of MuJoCo.

A body free in space is the same mechanism as one held to the ground, with six motions that no force opposes.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from problems.rotations import cross, right_jacobian
from scipy import optimize
from scipy.spatial.transform import Rotation

import mjcont as mc

CORNERS = np.array([[0.5, 0.3, -0.5], [-0.5, 0.3, -0.5], [-0.5, -0.3, -0.5], [0.5, -0.3, -0.5]])
ANCHORS = CORNERS * [1.0, 1.0, 0.0]
HULL = np.array([0.1, 0.05, -0.3])
VALUES = {"B": 200.0, "F_x": 0.0, "F_y": 0.0, "k": 50.0, "l_0": 2.0, "m": 10.0, "h_B": -0.3}
GRAVITY = 9.81


def rotation(state):
    """Rotation of a free joint's state x y z w i j k."""
    return Rotation.from_quat(np.roll(state[3:7], -1))


def pulls(r, turn, p):
    """Vectors from anchor to corner, their lengths and tensions."""
    d = r + CORNERS @ turn.T - ANCHORS
    lengths = np.linalg.norm(d, axis=1)
    return d, lengths, p["k"] * np.maximum(0.0, lengths - p["l_0"])


def loads(p):
    """Dead loads and the points of the body on which they act."""
    yield np.array([0.0, 0.0, -p["m"] * GRAVITY]), np.zeros(3)
    yield np.array([0.0, 0.0, p["B"]]), np.array([0.0, 0.0, p["h_B"]])
    yield np.array([p["F_x"], p["F_y"], 0.0]), HULL


def energy(r, turn, p):
    stretch = np.maximum(0.0, pulls(r, turn, p)[1] - p["l_0"])
    return 0.5 * p["k"] * np.sum(stretch**2) - sum(f @ (r + turn @ s) for f, s in loads(p))


def forces(r, turn, p):
    """Force (ground) and moment (body frame), (6,)."""
    d, lengths, tension = pulls(r, turn, p)
    acting = [(-t * e / n, s) for t, e, n, s in zip(tension, d, lengths, CORNERS, strict=True)] + list(loads(p))
    return np.concatenate([sum(f for f, _ in acting), sum(np.cross(s, turn.T @ f) for f, s in acting)])


def stiffness(r, turn, p):
    """-d forces / d (dr, w), (6, 6), equilibrium or not."""
    total = np.zeros((6, 6))
    for f, s in loads(p):
        total[3:, 3:] -= cross(s) @ cross(turn.T @ f)
    for e, n, t, s in zip(*pulls(r, turn, p), CORNERS, strict=True):
        u = e / n
        spring = (p["k"] if t > 0 else 0.0) * np.outer(u, u) + t / n * (np.eye(3) - np.outer(u, u))
        moved = np.hstack([np.eye(3), -turn @ cross(s)])  # of the corner
        total[:3] += spring @ moved
        total[3:] += cross(s) @ turn.T @ spring @ moved
        total[3:, 3:] += cross(s) @ cross(turn.T @ (t * u))
    return total


def least_energy(p, r, turn):
    """Position and rotation of least energy near a start, by BFGS in position and rotation vector."""

    def split(u):
        return u[:3], Rotation.from_rotvec(u[3:]).as_matrix()

    def gradient(u):
        f = forces(*split(u), p)
        return -np.concatenate([f[:3], right_jacobian(u[3:]).T @ f[3:]])

    start = np.concatenate([r, Rotation.from_matrix(turn).as_rotvec()])
    found = optimize.minimize(lambda u: energy(*split(u), p), start, jac=gradient, method="BFGS", tol=1e-9)
    return split(optimize.root(gradient, found.x, tol=1e-14).x)


@pytest.fixture(scope="module")
def tethered():
    return mc.Mechanism.from_xml("tethered_body")


@pytest.fixture(scope="module")
def upright(tethered):
    return mc.continue_equilibria(tethered, "B", bounds=(105.0, 400.0), start={"B": 200.0}, keyframe="upright")


@pytest.fixture(scope="module")
def loaded(tethered):
    start = {"B": 200.0, "F_x": 10.0, "F_y": 2.0}
    return mc.continue_equilibria(tethered, "B", bounds=(105.0, 400.0), start=start, keyframe="upright")


def random_poses(count):
    rng = np.random.default_rng(11)
    for turn in Rotation.random(count, rng=rng):
        quat = np.roll(turn.as_quat(), 1)
        yield np.concatenate([rng.uniform([-1, -1, 2], [1, 1, 4]), quat]), turn.as_matrix()


# -- the float's equations -------------------------------------------------------------------------------------


LOADED = {**VALUES, "B": 180.0, "F_x": 12.0, "F_y": -7.0}


def test_the_hand_written_forces_are_the_gradient_of_the_hand_written_energy():
    for x, turn in random_poses(3):
        for i, e in enumerate(np.eye(6)):
            h = 1e-6 * e
            ends = [
                energy(x[:3] + sign * h[:3], turn @ Rotation.from_rotvec(sign * h[3:]).as_matrix(), LOADED)
                for sign in (1, -1)
            ]
            assert -(ends[0] - ends[1]) / 2e-6 == pytest.approx(forces(x[:3], turn, LOADED)[i], rel=1e-6, abs=1e-6)


def test_forces_on_the_float_are_those_written_by_hand(tethered):
    for x, turn in random_poses(10):
        residual = tethered.residual(x, tethered.values(LOADED))
        assert residual == pytest.approx(forces(x[:3], turn, LOADED), rel=1e-12, abs=1e-11)


@pytest.mark.parametrize("accurate", [False, True])
def test_derivatives_on_the_manifold_are_those_written_by_hand(tethered, accurate):
    for x, turn in random_poses(10):
        jac = tethered.linearize(x, tethered.values(LOADED), ["B"], accurate=accurate).jac
        assert jac == pytest.approx(-stiffness(x[:3], turn, LOADED), abs=1e-6 if not accurate else 1e-8)


def test_the_derivative_in_a_load_is_the_load_and_its_moment(tethered):
    for x, turn in random_poses(3):
        par = tethered.linearize(x, tethered.values(LOADED), ["F_x", "l_0"]).par
        e = np.array([1.0, 0.0, 0.0])
        assert par[:, 0] == pytest.approx(np.concatenate([e, np.cross(HULL, turn.T @ e)]), abs=1e-10)
        ends = [forces(x[:3], turn, {**LOADED, "l_0": 2.0 + h}) for h in (1e-6, -1e-6)]
        assert par[:, 1] == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-5)


def test_mass_and_damping_of_the_float_are_those_of_the_xml(tethered):
    (x, _), *_ = random_poses(1)
    values = tethered.values(VALUES)
    pencil = tethered.pencil(x, values, tethered.linearize(x, values, []).jac)
    assert pencil.mass == pytest.approx(np.diag([10.0, 10.0, 10.0, 1.2, 1.6, 1.4]), abs=1e-12)
    assert pencil.damping == pytest.approx(5.0 * np.eye(6), abs=1e-9)


def test_a_tangent_step_and_the_difference_of_states_are_inverse_to_each_other(tethered):
    rng = np.random.default_rng(5)
    for x, turn in random_poses(5):
        step = rng.uniform(-1.0, 1.0, 6)
        moved = tethered.retract(x, step)
        assert tethered.difference(moved, x) == pytest.approx(step, abs=1e-12)
        assert moved[:3] == pytest.approx(x[:3] + step[:3], abs=1e-15)
        expected = turn @ Rotation.from_rotvec(step[3:]).as_matrix()
        assert rotation(moved).as_matrix() == pytest.approx(expected, abs=1e-14)


# -- the float upright -----------------------------------------------------------------------------------------


def capsize_load():
    """Zero of the stiffness in roll, 4 k q^2 + (B - m g) c + B h_B with q = 0.3 m, c = 0.5 m."""
    return (10.0 * GRAVITY * 0.5 - 4 * 50.0 * 0.3**2) / (0.5 - 0.3)


def test_upright_the_tethers_carry_the_excess_of_buoyancy(upright):
    assert upright["upright"] == pytest.approx(np.ones(len(upright)), abs=1e-12)
    assert upright["z"] == pytest.approx(2.5 + (upright["B"] - 98.1) / 200.0, abs=1e-12)


def test_the_upright_float_capsizes_in_roll_where_the_closed_form_has_it(upright):
    (point,) = upright.special_points
    assert point.kind == "BP"
    assert point["B"] == pytest.approx(capsize_load(), rel=1e-11)
    assert point.coefficients["type"] == "subcritical pitchfork"


def test_above_that_buoyancy_the_float_is_stable_and_below_it_is_not(upright):
    rows = np.array([not label for label in upright.labels])
    expected = np.where(upright["B"] > capsize_load(), "stable", "unstable")
    assert np.array_equal(upright.stability[rows], expected[rows])


@pytest.mark.slow
def test_the_capsized_branch_rolls_right_over_to_the_float_upside_down(upright):
    (rolled,) = [b for b in mc.switch_branches(upright.point("BP1")) if b["upright"].min() < 0.9]
    assert rolled.status == "closed"
    assert rolled["upright"].min() == pytest.approx(-1.0, abs=1e-9)
    for i in range(0, len(rolled), 10):
        x, p = rolled.states[i], {**VALUES, "B": rolled["B"][i]}
        assert np.abs(forces(x[:3], rotation(x).as_matrix(), p)).max() < 1e-6


# -- the float under load --------------------------------------------------------------------------------------

CURRENTS = [(200.0, 10.0, 2.0), (300.0, 0.0, 0.0), (180.0, -15.0, 5.0), (350.0, 40.0, -20.0)]


@pytest.mark.parametrize(("b", "f_x", "f_y"), CURRENTS)
def test_the_float_rests_where_its_energy_is_least(tethered, b, f_x, f_y):
    load = {"B": b, "F_x": f_x, "F_y": f_y}
    found = mc.find_equilibrium(tethered, load, keyframe="upright")
    # from a pose nearby, not from the answer
    turned = rotation(found.state) * Rotation.from_rotvec([0.05, -0.08, 0.06])
    r, turn = least_energy({**VALUES, **load}, found.state[:3] + [0.05, 0.03, -0.04], turned.as_matrix())
    assert found.stability == "stable"
    assert found.state[:3] == pytest.approx(r, abs=1e-8)
    assert rotation(found.state).as_matrix() == pytest.approx(turn, abs=1e-8)


def test_a_branch_passes_through_the_poses_of_least_energy(loaded):
    for b in (180.0, 220.0, 350.0):
        p = {**VALUES, "B": b, "F_x": 10.0, "F_y": 2.0}
        r, turn = least_energy(p, np.array([0.0, 0.0, 3.0]), np.eye(3))
        distances = [np.abs(q.state[:3] - r).max() + np.abs(rotation(q.state).as_matrix() - turn).max()
                     for q in loaded.at(B=b) if q.stability == "stable"]
        assert min(distances) < 1e-8


def test_every_point_of_a_branch_balances_the_hand_written_forces(loaded):
    for x, b in zip(loaded.states, loaded["B"], strict=True):
        p = {**VALUES, "B": b, "F_x": 10.0, "F_y": 2.0}
        assert np.abs(forces(x[:3], rotation(x).as_matrix(), p)).max() < 1e-7


def test_unstable_directions_are_the_negative_eigenvalues_of_the_hand_written_hessian(loaded):
    for x, b, count, label in zip(loaded.states, loaded["B"], loaded.n_unstable, loaded.labels, strict=True):
        p = {**VALUES, "B": b, "F_x": 10.0, "F_y": 2.0}
        hessian = stiffness(x[:3], rotation(x).as_matrix(), p)
        assert label or count == np.count_nonzero(np.linalg.eigvalsh(0.5 * (hessian + hessian.T)) < 0)


def test_at_equilibrium_the_stiffness_is_symmetric_and_elsewhere_it_is_not(tethered, loaded):
    for i in range(0, len(loaded), 20):
        jac = tethered.linearize(loaded.states[i], loaded.row(i).parameters, []).jac
        assert np.abs(jac - jac.T).max() < 1e-8 * np.abs(jac).max()
    away = tethered.retract(loaded.states[0], 0.3 * np.ones(6))
    jac = tethered.linearize(away, loaded.row(0).parameters, []).jac
    assert np.abs(jac - jac.T).max() > 1e-2 * np.abs(jac).max()


def test_quaternions_have_unit_length_along_a_branch(loaded):
    assert np.linalg.norm(loaded.states[:, 3:], axis=1) == pytest.approx(np.ones(len(loaded)), abs=1e-14)


def test_the_current_turns_the_branch_point_into_folds(loaded):
    assert [p.kind for p in loaded.special_points] == ["LP", "LP"]
    words = [s for s, label in zip(loaded.stability, loaded.labels, strict=True) if not label]
    assert [word for word, _ in itertools.groupby(words)] == ["stable", "unstable", "stable"]


def test_at_a_fold_the_hand_written_stiffness_is_singular_along_its_null_vector(loaded):
    for fold in loaded.of_kind("LP"):
        p = {**VALUES, "B": fold["B"], "F_x": 10.0, "F_y": 2.0}
        hessian = stiffness(fold.state[:3], rotation(fold.state).as_matrix(), p)
        assert np.linalg.norm(hessian @ fold.vectors["v"]) < 1e-8 * np.abs(hessian).max()


def test_folds_of_the_float_lie_where_the_hand_written_equations_have_them(loaded):
    # forces, stiffness times v and |v| = 1, in position, rotation vector, B and v
    def defining(u):
        p = {**VALUES, "B": u[6], "F_x": 10.0, "F_y": 2.0}
        pose = u[:3], Rotation.from_rotvec(u[3:6]).as_matrix()
        return np.concatenate([forces(*pose, p), stiffness(*pose, p) @ u[7:], [u[7:] @ u[7:] - 1.0]])

    for fold in loaded.of_kind("LP"):
        start = np.concatenate([fold.state[:3], rotation(fold.state).as_rotvec(), [fold["B"]], fold.vectors["v"]])
        found = optimize.root(defining, start + 1e-3, tol=1e-13)
        assert fold["B"] == pytest.approx(found.x[6], rel=1e-9)


@pytest.mark.slow
def test_folds_under_a_side_current_meet_in_a_cusp_where_the_upright_float_capsizes(tethered):
    start = {"B": 200.0, "F_y": 1.0}
    branch = mc.continue_equilibria(tethered, "B", bounds=(105.0, 400.0), start=start, keyframe="upright")
    fold = min(branch.of_kind("LP"), key=lambda p: abs(p["B"] - capsize_load()))
    locus = mc.continue_special(fold, "F_y", bounds=(-3.0, 3.0))
    cusp = min(locus.of_kind("CP"), key=lambda p: abs(p["F_y"]))
    assert cusp["F_y"] == pytest.approx(0.0, abs=1e-8)
    assert cusp["B"] == pytest.approx(capsize_load(), rel=1e-8)


@pytest.fixture(scope="module")
def slackening():
    """The float at B = 350 N while its first tether is paid out."""
    tethered = mc.Mechanism.from_xml("tethered_body")
    tethered.declare("l_1", "tendon:tether_1.springlength[1]", unit="m", bounds=(1.5, 6.0))
    return mc.continue_equilibria(tethered, "l_1", start={"B": 350.0}, keyframe="upright")


def balance_without_tether_1(u, p):
    """Forces on the float by its other three tethers, (6,), at a position and rotation vector."""
    r, turn = u[:3], Rotation.from_rotvec(u[3:]).as_matrix()
    d, lengths, tension = pulls(r, turn, p)
    pull = -tension[0] * d[0] / lengths[0]
    return forces(r, turn, p) - np.concatenate([pull, np.cross(CORNERS[0], turn.T @ pull)])


def test_paid_out_a_tether_falls_slack_where_the_other_three_hold_the_float_alone(slackening):
    (corner,) = slackening.of_kind("CO")
    start = np.concatenate([corner.state[:3], rotation(corner.state).as_rotvec()]) + 1e-2
    alone = optimize.root(balance_without_tether_1, start, args=({**VALUES, "B": 350.0},), tol=1e-13).x
    length = pulls(alone[:3], Rotation.from_rotvec(alone[3:]).as_matrix(), {**VALUES, "B": 350.0})[1][0]
    assert corner.note == "tendon tether_1 goes slack"
    assert corner["l_1"] == pytest.approx(length, abs=1e-6)
    assert corner["length_1"] == pytest.approx(length, abs=1e-6)


def test_beyond_that_the_float_hangs_on_three_tethers_and_is_stable(slackening):
    (corner,) = slackening.of_kind("CO")
    beyond = [slackening.row(i) for i in np.flatnonzero(slackening["l_1"] > corner["l_1"] + 1e-6)]
    assert beyond[-1]["l_1"] == pytest.approx(6.0)
    for point in beyond:
        assert point["length_1"] < point["l_1"]
        assert point.stability == "stable"
        u = np.concatenate([point.state[:3], rotation(point.state).as_rotvec()])
        assert np.abs(balance_without_tether_1(u, {**VALUES, "B": 350.0})).max() < 1e-6


# -- files -----------------------------------------------------------------------------------------------------


def test_a_branch_of_a_free_body_is_the_same_after_saving_and_loading(loaded, tmp_path):
    again = mc.load(loaded.save(tmp_path / "float.h5"))
    assert np.array_equal(again.states, loaded.states)
    assert list(again.state_labels) == list(loaded.state_labels)
    assert [p.label for p in again.special_points] == [p.label for p in loaded.special_points]
    for a, b in zip(again.at(B=220.0), loaded.at(B=220.0), strict=True):
        assert a.state == pytest.approx(b.state, abs=1e-12)
        assert a.stability == b.stability


def test_a_fold_of_a_free_body_can_be_followed_from_a_file(loaded, tmp_path):
    again = mc.load(loaded.save(tmp_path / "float.h5"))
    locus = mc.continue_special(again.point("LP1"), "F_x", bounds=(9.0, 11.0))
    assert locus["F_x"][[0, -1]] == pytest.approx([9.0, 11.0])
