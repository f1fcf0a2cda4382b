"""The overcentre mechanism of figures 2 to 5: longer links and spring, with which the paper's sentences hold.

Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Section II. The values of
folds and distances were computed apart from any MuJoCo model, from the energies of tests/problems/reference.py.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from problems import reference
from problems.reference import PAPER, PAPER_FOLDS, PARAMETERS

import mjcont as mc
from mjcont.paper.reproduce import distances

MODEL = "overcentre_paper"
FOLDS = [(k_j, label) for k_j in PAPER_FOLDS for label in ("LP2", "LP1")]
STIFFNESSES = [8.0, 100.0, 1e3, 1e6]
AXES = np.array([100.0, np.pi])  # what the axes of figures 4 and 5 span: N, rad


@pytest.fixture
def mechanism():
    return mc.Mechanism.from_xml(MODEL)


@pytest.fixture
def branch(overcentre_branch):
    """Return a function: the branch in F for some parameter values."""
    return lambda **values: overcentre_branch(model=MODEL, **values)


def expected_fold(k_j, label):
    return PAPER_FOLDS[k_j][0 if label == "LP2" else 1]


# -- the model -----------------------------------------------------------------------------------------------


def test_it_has_the_parameters_of_the_first_set_with_another_spring(mechanism, overcentre):
    assert mechanism.values() == pytest.approx({name: PAPER[name] for name in PARAMETERS}, rel=1e-15)
    ours, first = mechanism.parameters, overcentre.parameters
    assert {n: p.unit for n, p in ours.items()} == {n: p.unit for n, p in first.items()}
    longer = replace(first["l_us"], value=2.25, bounds=(0.0, 6.0))
    assert ours == {**first, "k_sp": replace(first["k_sp"], value=9.0), "l_us": longer}


def test_its_links_are_three_metres_long_and_assembled_at_sixty_degrees(mechanism):
    assert mechanism.qpos0 == pytest.approx(reference.assembled_pose(math.radians(60.0), 3.0), abs=1e-14)


def motions(count, k_j):
    """Yield states with open pins, velocities and parameters at random; gravity tilted and scaled."""
    rng = np.random.default_rng(1973)
    for _ in range(count):
        q = reference.assembled_pose(rng.uniform(-np.pi, np.pi), 3.0) + rng.normal(0.0, 0.1, 6)
        loads = {"F": rng.uniform(-100.0, 100.0), "gravity_angle": rng.uniform(-1.0, 1.0)}
        yield q, rng.normal(0.0, 1.0, 6), PAPER | loads | {"k_j": k_j, "load_factor": rng.uniform(0.0, 3.0)}


def relative(found, expected):
    return np.abs(found - expected).max() / np.abs(expected).max()


def named(p):
    return {name: p[name] for name in PARAMETERS}


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_generalised_forces_equal_those_of_the_hand_written_energies(mechanism, k_j):
    for q, _, p in motions(20, k_j):
        assert relative(mechanism.residual(q, named(p)), reference.forces(q, p)) < 1e-12


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_stiffness_is_the_hessian_of_the_hand_written_energies(mechanism, k_j):
    for q, _, p in motions(10, k_j):
        found = mechanism.linearize(q, named(p), (), accurate=True).jac
        assert relative(found, -reference.stiffness(q, p)) < 1e-9


@pytest.mark.parametrize("k_j", STIFFNESSES)
def test_in_motion_it_accelerates_as_rods_of_three_metres_do(mechanism, k_j):
    for q, v, p in motions(20, k_j):
        expected = np.linalg.solve(reference.mass(p), reference.forces(q, p) - reference.damping(q, p) @ v)
        assert relative(mechanism.acceleration(q, v, named(p)), expected) < 1e-9


# -- folds ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("k_j", "label"), FOLDS)
def test_folds_equal_the_reference(branch, k_j, label):
    found = branch(k_j=k_j).point(label)
    force, degrees = expected_fold(k_j, label)
    assert found["F"] == pytest.approx(force, rel=1e-9)
    assert math.degrees(found["theta_1"]) == pytest.approx(degrees, abs=1e-6)


@pytest.mark.parametrize(("k_j", "label"), FOLDS)
def test_the_table_of_folds_holds_for_the_hand_written_energies(k_j, label):
    force, degrees = expected_fold(k_j, label)
    found, angle = reference.fold_near(math.radians(degrees), PAPER | {"k_j": k_j})
    assert found == pytest.approx(force, abs=0.6e-9)
    assert math.degrees(angle) == pytest.approx(degrees, abs=0.6e-7)


@pytest.mark.slow
@pytest.mark.parametrize(("which", "label"), [(0, "LP2"), (1, "LP1")])
def test_folds_tend_to_those_of_the_closed_form_as_one_over_the_stiffness(branch, which, label):
    force, angle = reference.rigid_folds(PAPER)[which]
    soft, stiff, rigid = (branch(k_j=k).point(label) for k in (1e4, 1e5, 1e8))
    for name, limit in (("F", force), ("theta_1", angle)):
        assert soft[name] - limit == pytest.approx(10.0 * (stiff[name] - limit), rel=5e-3)
    assert rigid["F"] == pytest.approx(force, abs=1e-6)
    assert rigid["theta_1"] == pytest.approx(angle, abs=1e-7)


def test_rigid_folds_are_the_published_ones():
    (upper, angle), (lower, below) = reference.rigid_folds(PAPER)
    assert (upper, lower) == pytest.approx((15.683096, 23.556904), abs=5e-7)
    assert np.degrees([angle, below]) == pytest.approx([24.692853, -24.692853], abs=5e-7)


# -- along the branch ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("c_sp", [0.01, 10.0])
@pytest.mark.parametrize("k_j", PAPER_FOLDS)
def test_one_eigenvalue_is_unstable_between_the_folds_and_there_is_nothing_else(branch, k_j, c_sp):
    found = branch(k_j=k_j, c_sp=c_sp)
    assert [p.label for p in found.special_points] == ["LP1", "LP2"]
    lower, upper = (p.index for p in found.special_points)
    row = np.arange(len(found))
    regular = (row != lower) & (row != upper)
    between = (row > lower) & (row < upper)
    assert np.array_equal(found.n_unstable[regular], between[regular].astype(int))
    assert set(found.stability[regular]) == {"stable", "unstable"}


@pytest.mark.slow
@pytest.mark.parametrize("points", [6, pytest.param(16, marks=pytest.mark.long)])
def test_simulations_beside_the_branch_grow_and_decay_as_the_eigenvalues_say(branch, points):
    checked = mc.verify_stability(branch(), points).certificate
    assert checked.holds
    assert len(checked.of("confirmed")) >= points - 1  # one may lie at a fold, where nothing grows or decays
    assert {c.stability for c in checked.of("confirmed")} == {"stable", "unstable"}


def curve(branch):
    """F and theta_1 over the range of the figures, in units of what their axes span."""
    points = np.column_stack([branch["F"], branch["theta_1"]])
    return points[np.abs(branch["F"]) <= 50.0] / AXES


def closed_form():
    theta = np.linspace(-1.3, 1.3, 8001)
    return np.column_stack([reference.rigid_force(theta, PAPER), theta]) / AXES


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k_j", "other", "expected", "digit"),
    [(200.0, 1000.0, 0.0036, 1e-4), (100.0, None, 0.0076, 1e-4), (10.0, None, 0.043, 1e-3)],
)
def test_curves_lie_as_far_apart_as_the_reference_says(branch, k_j, other, expected, digit):
    line = closed_form() if other is None else curve(branch(k_j=other))
    assert distances(curve(branch(k_j=k_j)), line).max() == pytest.approx(expected, abs=0.5 * digit)
