"""A classic of elastic stability with closed forms: the column of links and springs.

The column (N links of length l; theta_i their angles from the vertical, springs k between them and 2 k at the clamp):

    k (3 theta_1 - theta_2) = P l sin(theta_1),  k (2 theta_i - theta_(i-1) - theta_(i+1)) = P l sin(theta_i), ...

whose linear form (k A - P l) theta = 0 has the eigenvalues P_j = 4 (k / l) sin^2((2 j - 1) pi / (4 N)): theta_i is
then sin((i - 1/2) (2 j - 1) pi / (2 N)). For large N they tend to L. Euler's loads of the elastica (1744).
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.classics import regular
from scipy import optimize

import mjcont as mc


def column(count, *, stiffness=1.0, length=1.0, mass=0.1, gravity=0.0):
    """The XML of a column of `count` links with dead loads P and H at the tip."""
    hinge = f'type="hinge" axis="0 1 0" damping="{0.01 * stiffness}"'
    bodies = ""
    for i in reversed(range(count)):
        spring = f'stiffness="{stiffness if i else 2.0 * stiffness}"'
        inside = bodies or f'<site name="tip" pos="0 0 {length}"/>'
        bodies = (
            f'<body pos="0 0 {length if i else 0.0}"><joint name="bend_{i + 1}" {hinge} {spring}/>'
            f'<inertial pos="0 0 {length}" mass="{mass}" diaginertia="1e-6 1e-6 1e-6"/>{inside}</body>'
        )
    return f"""
    <mujoco model="column">
      <option gravity="0 0 {-gravity}"/>
      <statistic extent="{count * length}"/>
      <worldbody><site name="ground"/>{bodies}</worldbody>
      <actuator>
        <general name="P" site="tip" refsite="ground" gear="0 0 -1 0 0 0"/>
        <general name="H" site="tip" refsite="ground" gear="1 0 0 0 0 0"/>
      </actuator>
    </mujoco>"""


def bending(count):
    """The matrix A of k A theta, (N, N)."""
    matrix = 2.0 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    matrix[0, 0], matrix[-1, -1] = (3.0, 1.0) if count > 1 else (2.0, 2.0)
    return matrix


def buckling_loads(count, stiffness, length):
    return stiffness / length * np.linalg.eigvalsh(bending(count))


def elastica(count, ratio, guess):
    """Absolute angles of a buckled column, k A theta = P l sin(theta) with ratio = P l / k, (N,)."""
    matrix = bending(count)
    found = optimize.root(
        lambda t: matrix @ t - ratio * np.sin(t), guess, jac=lambda t: matrix - ratio * np.diag(np.cos(t)), tol=1e-14
    )
    assert np.abs(matrix @ found.x - ratio * np.sin(found.x)).max() < 1e-12
    return found.x


COUNT, SPRING, LINK = 8, 8.0, 0.125


@pytest.fixture(scope="module")
def links():
    return mc.Mechanism.from_xml("buckling_column")


@pytest.fixture(scope="module")
def straight(links):
    return mc.continue_equilibria(links, "P", bounds=(0.0, 260.0))


@pytest.fixture(scope="module")
def buckled(links):
    straight = mc.continue_equilibria(links, "P", bounds=(0.0, 12.0))
    (branch,) = [b for b in mc.switch_branches(straight.point("BP1")) if np.abs(b["tip_x"]).max() > 0.1]
    return branch


def test_the_closed_form_of_the_buckling_loads_solves_the_eigenvalue_problem():
    j = np.arange(1, COUNT + 1)
    closed = 4.0 * SPRING / LINK * np.sin((2 * j - 1) * np.pi / (4 * COUNT)) ** 2
    assert closed == pytest.approx(buckling_loads(COUNT, SPRING, LINK), rel=1e-13)


def test_the_straight_column_buckles_at_every_eigenvalue_of_its_linear_equations(straight):
    assert [p.kind for p in straight.special_points] == ["BP"] * COUNT
    loads = [p["P"] for p in straight.special_points]
    assert loads == pytest.approx(buckling_loads(COUNT, SPRING, LINK), rel=1e-11)


def test_each_buckling_load_adds_one_unstable_eigenvalue(straight):
    expected = (straight["P"][:, None] > buckling_loads(COUNT, SPRING, LINK)).sum(axis=1)
    rows = np.array([not label for label in straight.labels])
    assert np.array_equal(straight.n_unstable[rows], expected[rows])


@pytest.mark.parametrize("count", [1, 2, 3, 5, 12, pytest.param(24, marks=pytest.mark.long)])
def test_a_column_of_any_number_of_links_buckles_at_the_closed_form(count):
    critical = 4.0 * math.sin(math.pi / (4 * count)) ** 2
    mechanism = mc.Mechanism.from_xml(column(count))
    branch = mc.continue_equilibria(mechanism, "P", bounds=(0.0, 1.5 * critical))
    (point,) = branch.special_points
    assert point["P"] == pytest.approx(critical, rel=1e-10)
    assert regular(branch) == ["stable", "unstable"]


@pytest.mark.slow
def test_a_branch_point_costs_evaluations_in_proportion_to_the_number_of_links():
    few, many = (mc.Mechanism.from_xml(column(count)) for count in (24, 48))
    for mechanism in (few, many):
        (point,) = mc.continue_equilibria(mechanism, "P", bounds=(0.0, 6.0 / mechanism.n**2)).special_points
        assert point["P"] == pytest.approx(4.0 * math.sin(math.pi / (4 * mechanism.n)) ** 2, rel=1e-10)
    assert many.evaluations < 3.0 * few.evaluations


@pytest.mark.slow
def test_with_many_links_the_buckling_load_tends_to_eulers():
    # EI = k l, L = N l = 1; the relative error is pi^2 / (48 N^2) to leading order
    for count in (8, 16):
        length, stiffness = 1.0 / count, float(count)
        mechanism = mc.Mechanism.from_xml(column(count, stiffness=stiffness, length=length))
        (point,) = mc.continue_equilibria(mechanism, "P", bounds=(0.0, 4.0)).special_points
        euler = math.pi**2 / 4.0
        assert 1.0 - point["P"] / euler == pytest.approx(math.pi**2 / (48.0 * count**2), rel=1e-2)


@pytest.mark.slow
def test_under_its_own_weight_a_column_buckles_at_the_generalised_eigenvalue():
    # masses m at the upper end of each link: link i carries N - i + 1 of them
    count, weight = 4, 0.1 * 9.81
    carried = np.arange(count, 0, -1.0)
    critical = np.linalg.eigvalsh(bending(count) / np.sqrt(np.outer(carried, carried)))[0] / weight
    mechanism = mc.Mechanism.from_xml(column(count, gravity=9.81))
    branch = mc.continue_equilibria(mechanism, "load_factor", bounds=(0.0, 1.5 * critical), start={"load_factor": 0.0})
    (point,) = branch.special_points
    assert point.coefficients["type"] == "supercritical pitchfork"
    assert point["load_factor"] == pytest.approx(critical, rel=1e-10)


def test_the_null_vector_of_the_first_buckling_load_is_the_quarter_sine(straight):
    branch_directions = straight.point("BP1").vectors["tangents"]
    relative = max(branch_directions, key=lambda t: np.abs(t[:COUNT]).max())[:COUNT]
    mode = np.sin((np.arange(1, COUNT + 1) - 0.5) * np.pi / (2 * COUNT))
    angles = np.cumsum(relative)
    assert angles / angles[-1] == pytest.approx(mode / mode[-1], abs=1e-7)


def test_the_pitchfork_is_supercritical_and_as_steep_as_koiters_expansion(links, straight, buckled):
    # 0 = xi (P_1 - P) l + xi^3 P l sum(phi^4) / 6 with theta = xi phi, |phi| = 1
    point = straight.point("BP1")
    assert point.coefficients["type"] == "supercritical pitchfork"
    assert point.coefficients["c"] < 0
    phi = np.linalg.eigh(bending(COUNT))[1][:, 0]
    near = mc.continue_equilibria(
        links, "P", bounds=(0.0, 1.001 * point["P"]), start={"P": 1.001 * point["P"]}, state=_leaning(0.09)
    )
    angles = np.cumsum(near.states[near.start_index])
    xi = phi @ angles
    assert xi**2 == pytest.approx(6.0 * (1.0 - point["P"] / (1.001 * point["P"])) / np.sum(phi**4), rel=2e-3)


def _leaning(amplitude):
    """Relative angles of the first buckling mode."""
    phi = np.linalg.eigh(bending(COUNT))[1][:, 0]
    angles = amplitude * phi * np.sign(phi[-1])
    return np.diff(angles, prepend=0.0)


def test_beyond_the_first_load_the_straight_column_is_unstable_and_the_buckled_one_stable(straight, buckled):
    assert regular(straight) == ["stable", "unstable"]
    assert regular(buckled) == ["stable"]


def test_both_sides_of_the_buckled_column_are_mirror_images(buckled):
    assert "its two halves are mirror images" in buckled.notes
    point = buckled.start_index
    left, right = buckled.states[:point][::-1], buckled.states[point + 1 :]
    assert left == pytest.approx(-right, abs=1e-9)
    assert buckled["P"][:point][::-1] == pytest.approx(buckled["P"][point + 1 :], rel=1e-9)


@pytest.mark.parametrize("load", [2.5, 3.0, 5.0, 10.0])
def test_the_buckled_shape_is_that_of_the_discrete_elastica(buckled, load):
    found = buckled.at(P=load)
    assert len(found) == 2
    for p in found:
        angles = np.cumsum(p.state)
        assert angles == pytest.approx(elastica(COUNT, load * LINK / SPRING, 1.05 * angles), abs=1e-9)


@pytest.mark.parametrize("load", [2.5, 5.0])
def test_the_tip_stands_where_the_angles_of_the_elastica_put_it(buckled, load):
    for p in buckled.at(P=load):
        angles = elastica(COUNT, load * LINK / SPRING, np.cumsum(p.state))
        assert p["tip_x"] == pytest.approx(LINK * np.sin(angles).sum(), abs=1e-9)
        assert p["tip_z"] == pytest.approx(LINK * np.cos(angles).sum(), abs=1e-9)


@pytest.mark.slow
def test_folds_of_the_pushed_column_meet_in_a_cusp_at_the_buckling_load(links):
    start = {"H": 0.01, "P": 10.0}
    branch = mc.continue_equilibria(links, "P", bounds=(0.0, 12.0), start=start, keyframe="leaning_left")
    (fold,) = branch.of_kind("LP")
    locus = mc.continue_special(fold, "H", bounds=(-0.5, 0.5))
    (cusp,) = locus.of_kind("CP")
    assert cusp["P"] == pytest.approx(buckling_loads(COUNT, SPRING, LINK)[0], rel=1e-9)
    assert cusp["H"] == pytest.approx(0.0, abs=1e-9)


def test_the_second_buckled_shape_is_found_and_unstable(links, straight):
    branches = mc.switch_branches(straight.point("BP2"), bounds=(0.0, 40.0))
    (second,) = [b for b in branches if np.abs(b["tip_x"]).max() > 0.05]
    p = second.at(P=30.0)[0]
    angles = np.cumsum(p.state)
    assert angles == pytest.approx(elastica(COUNT, 30.0 * LINK / SPRING, angles), abs=1e-9)
    assert p.stability == "unstable"


@pytest.mark.slow
def test_the_whole_diagram_is_found_from_the_straight_column(links):
    # up to 60 N three pairs of buckled shapes leave the straight column
    diagram = mc.bifurcation_diagram(links, "P", (0.0, 60.0))
    straight = [b for b in diagram if np.abs(b["tip_x"]).max() < 1e-9]
    assert len(straight) == 1
    loads = sorted(p["P"] for p in straight[0].of_kind("BP"))
    assert loads == pytest.approx(buckling_loads(COUNT, SPRING, LINK)[:3], rel=1e-10)
    assert len(diagram) >= 4
