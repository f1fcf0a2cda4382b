"""Points at which several eigenvalues vanish: every branch through them is found."""

import numpy as np
import pytest
from problems.marks import long

import mjcont as mc

A, B = 0.5, 0.25
MIXED = np.sqrt([(1.0 - A) / (1.0 - A * B), (1.0 - B) / (1.0 - A * B)])
PITCHFORKS = {(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), tuple(MIXED), (MIXED[0], -MIXED[1])}


def two_pitchforks(z, p):
    return [z[0] * (p - z[0] ** 2 - A * z[1] ** 2), z[1] * (p - z[1] ** 2 - B * z[0] ** 2)]


def triangle(z, p):
    """The equations of a system with the symmetry of a triangle."""
    return [p * z[0] + z[0] ** 2 - z[1] ** 2, p * z[1] - 2.0 * z[0] * z[1]]


def lines(z, p):
    return [z[0] * (z[0] - p) * (z[0] - 3.0 * p)]


def field(form, n, size=1.0, seed=None):
    """Return a form in the first of `n` unknowns, the others slaved to them and rotated, in units of a size."""
    rotation = np.eye(n) if seed is None else np.linalg.qr(np.random.default_rng(seed).normal(size=(n, n)))[0]
    own = len(form(np.zeros(2), 0.0))

    def f(u, p):
        z = rotation.T @ (np.asarray(u) / size)
        return size * rotation @ np.array([*form(z, p["p"]), *(0.3 * z[0] ** 2 - z[own:])])

    return mc.VectorField(f, np.zeros(n), {"p": -1.0}, scale=np.full(n, size)), rotation


def ends(branches, rotation, size, own):
    """Return where the branches are at p = 1, one of two that the parameter has from the same branch."""
    found = []
    for branch in branches:
        at = branch.at(p=1.0)
        assert at
        found.append((rotation.T @ at[0].state / size)[:own])
    return found


@pytest.mark.slow
@pytest.mark.parametrize(("n", "size", "seed"), [(2, 1.0, None), long(5, 1.0, 1), long(4, 1e-3, 2), (4, 1e3, 3)])
def test_two_pitchforks_in_one_place_have_five_branches(n, size, seed):
    problem, rotation = field(two_pitchforks, n, size, seed)
    point = mc.continue_equilibria(problem, "p", (-1.0, 1.0)).point("BP1")
    assert point["p"] == pytest.approx(0.0, abs=1e-6)
    found = ends(mc.switch_branches(point), rotation, size, 2)
    assert len(found) == len(PITCHFORKS)
    for expected in PITCHFORKS:
        assert min(min(np.abs(z - expected).max(), np.abs(z + expected).max()) for z in found) < 1e-6
    assert len(mc.bifurcation_diagram(problem, "p", (-1.0, 1.0))) == len(PITCHFORKS)


@pytest.mark.slow
def test_a_triangle_s_branches_are_three_that_turn_into_each_other():
    problem, _ = field(triangle, 2)
    (point,) = mc.continue_equilibria(problem, "p", (-1.0, 1.0)).special_points
    found = ends(mc.switch_branches(point), np.eye(2), 1.0, 2)
    expected = [(0.0, 0.0), (-1.0, 0.0), (0.5, np.sqrt(0.75)), (0.5, -np.sqrt(0.75))]
    assert len(found) == 4
    for z in expected:
        assert min(np.abs(np.subtract(z, other)).max() for other in found) < 1e-6


@pytest.mark.slow
def test_three_lines_through_one_point_are_found_though_no_eigenvalue_changes_its_sign():
    problem, _ = field(lines, 1)
    diagram = mc.bifurcation_diagram(problem, "p", (-1.0, 1.0))
    assert sorted(round(float(b.at(p=1.0)[0].state[0]), 9) for b in diagram) == [0.0, 1.0, 3.0]


MAST = """
<mujoco><worldbody><body><joint name="a" axis="0 1 0" stiffness="9.81"/><joint name="b" axis="1 0 0" stiffness="9.81"/>
<inertial pos="0 0 1" mass="1" diaginertia=".1 .1 .1"/></body></worldbody></mujoco>"""


@pytest.mark.slow
def test_a_mast_buckles_in_both_directions_and_between_them():
    """On a joint of two equal springs: load a / sin a about one axis, 2 a / sin 2 a where both angles are equal."""
    mast = mc.Mechanism.from_xml(MAST)
    diagram = mc.bifurcation_diagram(mast, "load_factor", (0.5, 1.4), {"load_factor": 0.5})
    assert len(diagram) == 5
    shares = {"upright": 0, "one axis": 0, "both": 0}
    for branch in diagram:
        state = np.abs(branch.at(load_factor=1.3)[0].state)
        if state.max() < 1e-9:
            shares["upright"] += 1
        elif state.min() < 1e-9:
            shares["one axis"] += 1
            assert state.max() / np.sin(state.max()) == pytest.approx(1.3, abs=1e-9)
        else:
            shares["both"] += 1
            assert 2.0 * state / np.sin(2.0 * state) == pytest.approx([1.3, 1.3], abs=1e-9)
    assert shares == {"upright": 1, "one axis": 2, "both": 2}
