"""Two mechanisms whose special points are known in closed form: a pendulum on a torsion spring, a Ziegler column.

Inverted pendulum, m = l = k = 1: theta = g sin(theta). The upright pose loses its stability in a pitchfork at g = 1.

Ziegler column: two rods of unit length on hinges with unit springs and dampers b, point masses 2 and 1 at their ends,
and a follower load P at the tip. With absolute angles its linear equations have

    M = [[3, 1], [1, 1]],  C = b [[2, -1], [-1, 1]],  K = [[2 - P, P - 1], [-1, 1]],

so that det(s^2 M + s C + K) = 2 s^4 + 7 b s^3 + (7 + b^2 - 2 P) s^2 + 2 b s + 1 has a root i omega at
omega^2 = 2/7, P = 41/28 + b^2 / 2; without damping the frequencies meet at P = 7/2 - sqrt(2).

Sources: Ziegler, Ingenieur-Archiv 20 (1952); Herrmann and Jong, J. Appl. Mech. 32 (1965), for the effect of damping.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.ziegler import column_branch, ziegler

import mjcont as mc

GRAVITY = 9.81
# theta = 2 sin(theta), solved with 30 digits
SIDE_ANGLE = 1.89549426703398
RANGE = (0.0, 2.0 / GRAVITY)


@pytest.fixture
def pendulum(pendulum_xml):
    return mc.Mechanism.from_xml(pendulum_xml(joint='stiffness="1" damping="1"'))


@pytest.fixture
def upright(pendulum):
    return mc.continue_equilibria(pendulum, "load_factor", bounds=RANGE, start={"load_factor": 0.0})


@pytest.fixture
def side(pendulum):
    """Return the branch through the pendulum's leaning pose at g = 2, entered there."""
    start = {"load_factor": RANGE[1]}
    return mc.continue_equilibria(pendulum, "load_factor", bounds=RANGE, start=start, state=[1.8])


# -- pendulum -------------------------------------------------------------------------------------------------


def test_the_upright_pendulum_has_one_branch_point_at_g_1_and_nothing_else(upright):
    (point,) = upright.special_points
    assert point.kind == "BP"
    assert point["load_factor"] * GRAVITY == pytest.approx(1.0, rel=1e-10)


def test_the_branch_point_of_the_pendulum_is_a_supercritical_pitchfork(upright):
    (point,) = upright.special_points
    assert point.coefficients["type"] == "supercritical pitchfork"
    assert point.coefficients["c"] == pytest.approx(-1.0 / 6.0, rel=1e-6)


def test_the_upright_pendulum_is_stable_below_g_1_and_unstable_above(upright):
    g = upright["load_factor"] * GRAVITY
    assert set(upright.stability[g < 0.9999]) == {"stable"}
    assert set(upright.stability[g > 1.0001]) == {"unstable"}


def test_the_leaning_pendulum_rests_at_the_known_angle_at_g_2(side):
    assert side["load_factor"][[0, -1]] * GRAVITY == pytest.approx([2.0, 2.0], rel=1e-12)
    assert sorted(side["hip"][[0, -1]]) == pytest.approx([-SIDE_ANGLE, SIDE_ANGLE], rel=1e-10)


def test_the_leaning_pendulum_obeys_theta_equals_g_sin_theta(side):
    theta, g = side["hip"], side["load_factor"] * GRAVITY
    assert theta == pytest.approx(g * np.sin(theta), abs=1e-9)


def test_the_branch_point_is_found_along_the_side_branch_and_nothing_else(side):
    (point,) = side.special_points
    assert point.kind == "BP"
    assert point["load_factor"] * GRAVITY == pytest.approx(1.0, rel=1e-10)
    assert point["hip"] == pytest.approx(0.0, abs=1e-10)


def test_the_leaning_pendulum_is_stable(side):
    regular = [s for s, label in zip(side.stability, side.labels, strict=True) if not label]
    assert set(regular) == {"stable"}


def test_the_diagram_of_the_pendulum_has_the_upright_and_the_leaning_branch(pendulum):
    diagram = mc.bifurcation_diagram(pendulum, "load_factor", bounds=RANGE, starts={"load_factor": 0.0})
    assert len(diagram) == 2
    assert [[p.label for p in branch.special_points] for branch in diagram] == [["BP1"], ["BP1"]]


def test_the_leaning_branch_of_the_diagram_has_both_sides(pendulum):
    diagram = mc.bifurcation_diagram(pendulum, "load_factor", bounds=RANGE, starts={"load_factor": 0.0})
    assert sorted(diagram[1]["hip"][[0, -1]]) == pytest.approx([-SIDE_ANGLE, SIDE_ANGLE], rel=1e-10)
    assert diagram[1].notes == ("its two halves are mirror images",)


def test_the_diagram_is_the_same_from_a_leaning_start(pendulum):
    leaning = mc.find_equilibrium(pendulum, {"load_factor": RANGE[1]}, state=[1.8])
    diagram = mc.bifurcation_diagram(pendulum, "load_factor", bounds=RANGE, starts=leaning)
    assert len(diagram) == 2
    assert sorted(diagram[0]["hip"][[0, -1]]) == pytest.approx([-SIDE_ANGLE, SIDE_ANGLE], rel=1e-10)
    assert diagram[1]["hip"] == pytest.approx(np.zeros(len(diagram[1])), abs=1e-12)


# -- Ziegler column -------------------------------------------------------------------------------------------


def test_the_column_has_the_matrices_of_its_linear_equations():
    b, load = 0.5, 1.2
    column = ziegler(b)
    x, values = np.zeros(2), column.values({"P": load})
    pencil = column.pencil(x, values, column.linearize(x, values, (), accurate=True).jac)
    # absolute angles from those of the joints, which count from the lower rod
    to_joints = np.array([[1.0, 0.0], [-1.0, 1.0]])
    mass, damping, stiffness = (to_joints.T @ a @ to_joints for a in (pencil.mass, pencil.damping, pencil.stiffness))
    assert mass == pytest.approx(np.array([[3.0, 1.0], [1.0, 1.0]]), abs=1e-12)
    assert damping == pytest.approx(b * np.array([[2.0, -1.0], [-1.0, 1.0]]), abs=1e-12)
    assert stiffness == pytest.approx(np.array([[2.0 - load, load - 1.0], [-1.0, 1.0]]), abs=1e-10)


@pytest.mark.parametrize("b", [0.1, 0.5, 1.0])
def test_the_damped_column_flutters_at_41_28ths_plus_half_b_squared_and_nothing_else_happens(b):
    (hopf,) = column_branch(b).special_points
    assert hopf.kind == "HB"
    assert hopf["P"] == pytest.approx(41.0 / 28.0 + b**2 / 2.0, rel=1e-10)


@pytest.mark.parametrize("b", [0.1, 0.5, 1.0])
def test_the_flutter_frequency_does_not_depend_on_damping(b):
    (hopf,) = column_branch(b).special_points
    assert hopf.coefficients["omega"] == pytest.approx(math.sqrt(2.0 / 7.0), rel=1e-10)


@pytest.mark.parametrize("b", [0.1, 0.5, 1.0])
def test_the_damped_column_is_stable_below_flutter_and_has_an_unstable_pair_above(b):
    branch = column_branch(b)
    (hopf,) = branch.special_points
    assert set(branch.n_unstable[: hopf.index]) == {0}
    assert set(branch.n_unstable[hopf.index + 1 :]) == {2}


def test_the_undamped_column_is_marginal_below_its_flutter_load_and_unstable_above():
    branch = column_branch(0.0)
    regular = np.array([not label for label in branch.labels])
    below = branch["P"] < 7.0 / 2.0 - math.sqrt(2.0)
    assert set(branch.stability[regular & below]) == {"marginal"}
    assert set(branch.stability[regular & ~below]) == {"unstable"}


def test_no_hopf_point_is_reported_where_nothing_damps_the_column_and_no_frequencies_meet():
    flutter = 7.0 / 2.0 - math.sqrt(2.0)
    elsewhere = [p["P"] for p in column_branch(0.0).of_kind("HB") if abs(p["P"] - flutter) > 1e-6]
    assert elsewhere == []


def test_a_pendulum_that_turns_all_the_way_round_closes_a_full_turn_apart():
    # M = m g l sin q: folds at a quarter turn and at three quarters, and then the same again
    mechanism = mc.Mechanism.from_xml(
        """<mujoco model="turning"><option gravity="0 0 -9.81"/><worldbody><body>
        <joint name="q" axis="0 1 0" damping="0.1"/><inertial pos="0 0 -1" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
        </body></worldbody><actuator><general name="M" joint="q"/></actuator></mujoco>"""
    )
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-100.0, 100.0))
    assert branch.status == "closed"
    assert branch.message.endswith("full turns apart")
    assert sorted(p["M"] for p in branch.special_points) == pytest.approx([-19.62, 19.62], rel=1e-10)
    assert np.ptp(branch["q"]) == pytest.approx(2.0 * math.pi, abs=0.2)
