"""Equilibria of the overcentre mechanism as F varies: figures 3 to 5 of the paper, in numbers.

Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Section II.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from problems import reference
from problems.reference import BOUNDS, ELASTIC_FOLDS, PARAMETERS, START

import mjcont as mc

UPPER, LOWER = 0, 1
# A branch is stored from the end reached when F falls: the fold below overcentre comes first.
LABELS = {UPPER: "LP2", LOWER: "LP1"}
STIFFNESSES = [1000.0, 1e6]


def runs(words):
    return [word for word, _ in itertools.groupby(words)]


# -- folds ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("fold", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", ELASTIC_FOLDS)
def test_force_at_a_fold_equals_the_reference_to_1e_9(overcentre_branch, k_j, fold):
    found = overcentre_branch(k_j=k_j).point(LABELS[fold])
    assert found["F"] == pytest.approx(ELASTIC_FOLDS[k_j][fold][0], rel=1e-9)


@pytest.mark.parametrize("fold", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", ELASTIC_FOLDS)
def test_angle_at_a_fold_equals_the_reference_to_a_millionth_of_a_degree(overcentre_branch, k_j, fold):
    found = overcentre_branch(k_j=k_j).point(LABELS[fold])
    assert math.degrees(found["theta_1"]) == pytest.approx(ELASTIC_FOLDS[k_j][fold][1], abs=1e-6)


@pytest.mark.long
@pytest.mark.parametrize("fold", [UPPER, LOWER])
def test_folds_of_very_stiff_bushes_lie_where_equation_5_has_them(overcentre_branch, fold):
    found = overcentre_branch(k_j=1e10).point(LABELS[fold])
    force, angle = reference.rigid_folds()[fold]
    assert found["F"] == pytest.approx(force, abs=1e-6)
    assert found["theta_1"] == pytest.approx(angle, abs=1e-5)


@pytest.mark.parametrize("fold", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", ELASTIC_FOLDS)
def test_a_fold_says_how_well_it_is_located(overcentre_branch, k_j, fold):
    found = overcentre_branch(k_j=k_j).point(LABELS[fold])
    assert found.converged
    assert found.tolerance < 1e-9


@pytest.mark.parametrize("fold", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", ELASTIC_FOLDS)
def test_stiffness_is_singular_along_the_null_vector_of_a_fold(overcentre_branch, k_j, fold):
    found = overcentre_branch(k_j=k_j).point(LABELS[fold])
    stiffness = reference.stiffness(found.state, {**PARAMETERS, "k_j": k_j, "F": found["F"]})
    vector = found.vectors["v"]
    assert np.linalg.norm(vector) == pytest.approx(1.0, rel=1e-12)
    assert np.linalg.norm(stiffness @ vector) < 1e-8 * k_j


@pytest.mark.parametrize("fold", [UPPER, LOWER])
@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_fold_coefficient_is_half_the_second_derivative_of_the_force_along_the_null_vector(
    overcentre_branch, k_j, fold
):
    found = overcentre_branch(k_j=k_j).point(LABELS[fold])
    v, p, h = found.vectors["v"], {**PARAMETERS, "k_j": k_j, "F": found["F"]}, 1e-4
    curvature = [v @ reference.stiffness(found.state + t * v, p) @ v for t in (-2 * h, -h, h, 2 * h)]
    slope = np.array([1.0, -8.0, 8.0, -1.0]) @ curvature / (12.0 * h)
    assert found.coefficients["a"] == pytest.approx(-0.5 * slope, rel=1e-5)


@pytest.mark.slow
def test_folds_do_not_depend_on_the_spring_damper(overcentre_branch):
    light, heavy = overcentre_branch(c_sp=0.01), overcentre_branch(c_sp=10.0)
    for a, b in zip(light.of_kind("LP"), heavy.of_kind("LP"), strict=True):
        assert a["F"] == pytest.approx(b["F"], rel=1e-10)
        assert a["theta_1"] == pytest.approx(b["theta_1"], abs=1e-10)


def test_labels_and_folds_do_not_depend_on_the_step(overcentre):
    fine, coarse = (
        mc.continue_equilibria(overcentre, "F", bounds=BOUNDS, start={"F": START}, ds_max=d, chord=np.inf)
        for d in (0.02, 0.05)
    )
    assert len(fine) > 2 * len(coarse)
    for a, b in zip(fine.special_points, coarse.special_points, strict=True):
        assert a.label == b.label
        assert a["F"] == pytest.approx(b["F"], rel=1e-10)


# -- what else is on the branch ------------------------------------------------------------------------------


@pytest.mark.parametrize("c_sp", [0.01, 10.0])
@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_no_special_point_but_the_two_folds_is_reported(overcentre_branch, k_j, c_sp):
    branch = overcentre_branch(k_j=k_j, c_sp=c_sp)
    assert [p.label for p in branch.special_points] == ["LP1", "LP2"]


@pytest.mark.parametrize("c_sp", [0.01, 10.0])
@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_the_branch_is_stable_then_unstable_then_stable(overcentre_branch, k_j, c_sp):
    branch = overcentre_branch(k_j=k_j, c_sp=c_sp)
    regular = [s for s, label in zip(branch.stability, branch.labels, strict=True) if not label]
    assert runs(regular) == ["stable", "unstable", "stable"]


@pytest.mark.parametrize("k_j", [8.0, 1000.0, 1e6])
def test_one_eigenvalue_is_unstable_between_the_folds_and_none_beyond(overcentre_branch, k_j):
    branch = overcentre_branch(k_j=k_j)
    lower, upper = (branch.point(label).index for label in ("LP1", "LP2"))
    row = np.arange(len(branch))
    regular = (row != lower) & (row != upper)
    between = (row > lower) & (row < upper)
    assert np.array_equal(branch.n_unstable[regular], between[regular].astype(int))


@pytest.mark.parametrize("k_j", [1000.0, 1e6])
def test_every_point_balances_the_hand_written_forces(overcentre_branch, k_j):
    branch = overcentre_branch(k_j=k_j)
    for q, force in zip(branch.states, branch["F"], strict=True):
        assert np.abs(reference.forces(q, {**PARAMETERS, "k_j": k_j, "F": force})).max() < 1e-12 * k_j + 1e-11


@pytest.mark.slow
def test_stiff_bushes_follow_equation_5_along_the_whole_branch(overcentre_branch):
    branch = overcentre_branch(k_j=1e8)
    assert np.abs(branch["F"] - reference.rigid_force(branch["theta_1"])).max() < 1e-3


def test_the_branch_ends_at_its_bounds_with_the_lower_one_first(overcentre_branch):
    branch = overcentre_branch()
    assert branch["F"][[0, -1]] == pytest.approx(BOUNDS, abs=1e-12)
    assert branch.status == "at bound"


@pytest.mark.slow
def test_the_same_run_gives_the_same_numbers_to_the_bit(overcentre_branch):
    once = overcentre_branch()
    again = mc.continue_equilibria(
        mc.Mechanism.from_xml("overcentre"), "F", bounds=BOUNDS, start={"F": START}
    )
    assert np.array_equal(once.states, again.states)
    assert np.array_equal(once["F"], again["F"])
    assert np.array_equal(once.eigenvalues, again.eigenvalues)


# -- points at a value ---------------------------------------------------------------------------------------


def test_three_equilibria_exist_between_the_folds(overcentre_branch):
    found = overcentre_branch().at(F=20.0)
    assert [p.stability for p in found] == ["stable", "unstable", "stable"]
    assert [p["F"] for p in found] == [20.0, 20.0, 20.0]


def test_the_force_at_overcentre_equals_that_of_the_hand_written_equations(overcentre_branch):
    (found,) = overcentre_branch().at(theta_1=0.0)
    _, force, _ = reference.equilibrium_at(0.0, PARAMETERS)
    assert found["F"] == pytest.approx(force, rel=1e-10)
    assert found["theta_1"] == pytest.approx(0.0, abs=1e-10)


# -- starts --------------------------------------------------------------------------------------------------


def turned(theta_1, theta_2):
    """Return the XML's initial pose with only the links' angles changed (deg): the pins come open."""
    q = reference.assembled_pose(math.radians(60.0))
    q[[2, 5]] += np.radians([theta_1, theta_2])
    return q


def assembled(degrees):
    return reference.assembled_pose(math.radians(degrees))


STARTS = {
    "initial pose": None,
    "assembled at 40 deg": assembled(40.0),
    "assembled at 80 deg": assembled(80.0),
    "link 1 turned by +20 deg": turned(20.0, 0.0),
    "link 1 turned by -20 deg": turned(-20.0, 0.0),
    "link 2 turned by +20 deg": turned(0.0, 20.0),
    "link 2 turned by -20 deg": turned(0.0, -20.0),
    "both turned by +20 deg": turned(20.0, 20.0),
    "both turned by -20 deg": turned(-20.0, -20.0),
    "turned by -20 and +20 deg": turned(-20.0, 20.0),
    "turned by +20 and -20 deg": turned(20.0, -20.0),
}


@pytest.mark.parametrize("state", STARTS.values(), ids=STARTS.keys())
@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_the_whole_branch_is_found_from_poses_within_20_degrees(overcentre, overcentre_branch, k_j, state):
    start = {"F": START, "k_j": k_j}
    branch = mc.continue_equilibria(overcentre, "F", bounds=BOUNDS, start=start, state=state)
    expected = overcentre_branch(k_j=k_j)
    assert branch["F"][[0, -1]] == pytest.approx(BOUNDS, abs=1e-12)
    assert branch["theta_1"][[0, -1]] == pytest.approx(expected["theta_1"][[0, -1]], abs=1e-10)
    for label in ("LP1", "LP2"):
        assert branch.point(label)["F"] == pytest.approx(expected.point(label)["F"], rel=1e-10)


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_upwards_only_the_branch_leads_from_the_start_to_the_upper_bound(overcentre, k_j):
    start = {"F": START, "k_j": k_j}
    branch = mc.continue_equilibria(overcentre, "F", bounds=BOUNDS, start=start, direction=1)
    assert branch["F"][[0, -1]] == pytest.approx([START, BOUNDS[1]], abs=1e-12)
    assert np.all(np.diff(branch["F"]) > 0)
    assert not branch.special_points


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_downwards_only_the_branch_leads_over_both_folds_to_the_lower_bound(overcentre, k_j):
    start = {"F": START, "k_j": k_j}
    branch = mc.continue_equilibria(overcentre, "F", bounds=BOUNDS, start=start, direction=-1)
    assert sorted(branch["F"][[0, -1]]) == pytest.approx([BOUNDS[0], START], abs=1e-12)
    assert [p.kind for p in branch.special_points] == ["LP", "LP"]


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_the_summary_names_the_equilibrium_from_which_the_branch_starts(overcentre_branch, k_j):
    branch = overcentre_branch(k_j=k_j)
    angle = math.degrees(branch["theta_1"][branch.start_index])
    assert f"theta_1 = {angle:.6g} deg" in branch.start
    assert "F = 50 N" in branch.start
    assert "stable" in branch.start
    assert "the model's initial pose" in branch.start
    assert branch.start in str(branch)


def test_the_start_lies_above_overcentre_on_the_hand_written_branch(overcentre_branch):
    branch = overcentre_branch()
    angle = branch["theta_1"][branch.start_index]
    _, force, _ = reference.equilibrium_at(angle, PARAMETERS)
    assert angle > 0
    assert force == pytest.approx(START, rel=1e-10)


def test_the_summary_lists_stability_folds_and_both_ends(overcentre_branch):
    lines = str(overcentre_branch()).splitlines()
    assert any("stability: stable (" in line and "unstable (" in line for line in lines)
    assert any(line.startswith("  LP1 (fold): F = 24.07741 N") for line in lines)
    assert any(line.startswith("  LP2 (fold): F = 15.1626 N") for line in lines)
    assert any("first end: at bound: F reached its bound -50" in line for line in lines)
    assert any("last end: at bound: F reached its bound 60" in line for line in lines)


def test_a_start_outside_the_bounds_is_refused(overcentre):
    with pytest.raises(mc.BoundsError, match=r"the start has F = 70 N, outside the bounds -50 N \.\. 60 N"):
        mc.continue_equilibria(overcentre, "F", bounds=BOUNDS, start={"F": 70.0})


# -- cost ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_a_point_costs_at_most_sixty_evaluations_on_average_with_stability_and_folds(overcentre, k_j):
    start = mc.find_equilibrium(overcentre, {"F": START, "k_j": k_j})
    before = overcentre.evaluations
    branch = mc.continue_equilibria(overcentre, "F", bounds=BOUNDS, start=start)
    assert overcentre.evaluations - before <= 60 * len(branch)
