"""The overcentre mechanism as a joint tree against the same mechanism of free links: a check of the modelling."""

import numpy as np
import pytest

import mjcont as mc

PARAMETERS = {"F", "k_j", "c_j", "k_sp", "c_sp", "l_us", "m_1", "m_2", "gravity_angle", "load_factor"}


@pytest.fixture(scope="module")
def tree():
    return mc.Mechanism.from_xml("overcentre_tree")


@pytest.fixture(scope="module")
def free():
    return mc.Mechanism.from_xml("overcentre")


def turned(angle, along, across=0.0):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([along * c - across * s, along * s + across * c])


def free_coordinates(q):
    """x, z and angle of both centres of gravity for a state of the tree: x_A z_A theta_1 x_B z_B angle_B."""
    # the slides' axes lie along the link at qpos0, and turn with the link before
    a = turned(np.deg2rad(60.0), q[0], q[1])
    theta_1, theta_2 = q[2], q[2] + q[5]
    b = a + turned(theta_1, 1.0) + turned(theta_1 - np.deg2rad(120.0), q[3], q[4])
    cg_1, cg_2 = a + turned(theta_1, 0.5), b + turned(theta_2, 0.5)
    return np.concatenate([cg_1, [theta_1], cg_2, [theta_2]])


def projected(forces, q):
    """Forces on the free links as generalised forces of the tree (complex-step Jacobian)."""
    return np.array([np.imag(free_coordinates(q + 1e-30j * e)) / 1e-30 for e in np.eye(6)]) @ forces


def random_states(count):
    rng = np.random.default_rng(7)
    for _ in range(count):
        slides, angles = rng.uniform(-0.1, 0.1, 4), rng.uniform(-1.5, 1.5, 2)
        yield np.array([*slides[:2], angles[0], *slides[2:], angles[1]]), rng


def test_parameters_have_the_same_names_values_and_units_in_both_models(tree, free):
    described = [{(p.name, p.unit, p.value) for p in m.parameters.values()} for m in (tree, free)]
    assert described[0] == described[1]
    assert set(tree.parameters) == PARAMETERS


def test_both_models_start_from_the_same_pose(tree, free):
    np.testing.assert_allclose(free_coordinates(tree.qpos0), free.qpos0, rtol=0, atol=1e-14)
    for name in ("theta_1", "theta_2", "height", "spring_length"):
        at = [m.measure(m.qpos0[None], m.values(), [name])[0, 0] for m in (tree, free)]
        assert at[0] == pytest.approx(at[1], abs=1e-14)


def test_without_the_spring_both_models_have_the_same_forces(tree, free):
    for q, rng in random_states(20):
        p = tree.values({"k_sp": 0.0, "F": rng.uniform(-50, 50), "k_j": 10 ** rng.uniform(2, 6)})
        p |= {"gravity_angle": rng.uniform(-1, 1), "load_factor": rng.uniform(0, 3), "m_1": 1.7, "m_2": 0.6}
        expected = projected(free.residual(free_coordinates(q), p), q)
        assert np.abs(tree.residual(q, p) - expected).max() <= 1e-12 * np.abs(expected).max()


def test_with_centres_of_gravity_at_one_height_both_springs_have_the_same_forces(tree, free):
    for angle in np.deg2rad([70.0, 40.0, 10.0, -25.0, -60.0]):
        q = np.array([0.0, 0.0, angle, 0.0, 0.0, -2 * angle])
        p = tree.values({"k_j": 1.0})
        expected = projected(free.residual(free_coordinates(q), p), q)
        np.testing.assert_allclose(tree.residual(q, p), expected, rtol=0, atol=1e-12)


def folds(mechanism, k_j):
    """F at the lower and upper fold."""
    start = {"F": 50.0, "k_j": k_j}
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start=start)
    found = {point.observables["theta_1"] > 0: point.parameters["F"] for point in branch.of_kind("LP")}
    assert len(branch.of_kind("LP")) == 2
    return np.array([found[False], found[True]])


@pytest.mark.slow
def test_the_folds_of_both_models_approach_each_other_as_the_square_of_the_compliance(tree, free):
    # The heights of the two centres of gravity differ by O(1/k_j), the spring's energy by the square of that.
    differences = [np.abs(folds(tree, k) - folds(free, k)) for k in (1e3, 1e4, 1e5)]
    assert np.all(differences[0] < 1e-3)
    np.testing.assert_allclose(differences[0] / differences[1], 100.0, rtol=0.03)
    np.testing.assert_allclose(differences[1] / differences[2], 100.0, rtol=0.03)


def test_the_folds_of_the_stiff_tree_are_those_of_rigid_links(tree):
    # Closed form for rigid links: folds at cos(theta_1)^3 = l_us, F = 2 g - 2 k_sp (cos(theta_1) - l_us) tan(theta_1).
    theta = np.arccos(0.5 ** (1 / 3)) * np.array([-1.0, 1.0])
    rigid = 2 * 9.81 - 2 * 10.0 * (np.cos(theta) - 0.5) * np.tan(theta)
    np.testing.assert_allclose(folds(tree, 1e9), rigid, rtol=0, atol=1e-7)
