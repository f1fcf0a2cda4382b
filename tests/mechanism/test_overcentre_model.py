"""The overcentre model in MuJoCo is the paper's: equations (1)-(4), with the signs that deriving them gives.

Knowles et al., "A Bifurcation Study of a Dynamic Model of a Landing Gear Mechanism", Section II. The last
line of equation (1) is printed with the moments of joint A of the opposite sign.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems import reference
from problems.reference import GRAVITY, PARAMETERS, gaps

import mjcont as mc
from mjcont.models.loading import models_folder

XML = (models_folder() / "overcentre.xml").read_text(encoding="utf-8")


def newton_euler(q, v, p):
    """Return the accelerations (6,) of equations (1)-(4); bushes have a damper, and gravity may be tilted."""
    x1, z1, t1, x2, z2, t2 = q
    dx1, dz1, w1, dx2, dz2, w2 = v
    k, c, m1, m2, h = p["k_j"], p["c_j"], p["m_1"], p["m_2"], 0.5
    c1, s1, c2, s2 = math.cos(t1), math.sin(t1), math.cos(t2), math.sin(t2)
    gx = -p["load_factor"] * GRAVITY * math.sin(p["gravity_angle"])
    gz = -p["load_factor"] * GRAVITY * math.cos(p["gravity_angle"])

    rax = k * (x1 - h * c1) + c * (dx1 + h * s1 * w1)
    raz = k * (z1 - h * s1) + c * (dz1 - h * c1 * w1)
    rbx = k * (x2 - h * c2 - x1 - h * c1) + c * (dx2 + h * s2 * w2 - dx1 + h * s1 * w1)
    rbz = k * (z2 - h * s2 - z1 - h * s1) + c * (dz2 - h * c2 * w2 - dz1 - h * c1 * w1)
    rcz = -k * (z2 + h * s2) - c * (dz2 + h * c2 * w2)
    spring = p["c_sp"] * (dx2 - dx1) + p["k_sp"] * (x2 - x1 - p["l_us"])

    return np.array(
        [
            (-rax + rbx + spring) / m1 + gx,
            (-raz + rbz + p["F"]) / m1 + gz,
            h * (c1 * (raz + rbz) - s1 * (rax + rbx)) / (m1 / 12.0),
            (-rbx - spring) / m2 + gx,
            (-rbz + rcz) / m2 + gz,
            h * (c2 * (rbz + rcz) - s2 * rbx) / (m2 / 12.0),
        ]
    )


def random_motions(count):
    """Yield states, velocities and parameters: any angles up to full turns, pins open by about 5 cm."""
    rng = np.random.default_rng(2014)
    for _ in range(count):
        t1, t2 = rng.uniform(-2.0 * np.pi, 2.0 * np.pi, 2)
        c1, s1, c2, s2 = np.cos(t1), np.sin(t1), np.cos(t2), np.sin(t2)
        closed = np.array([0.5 * c1, 0.5 * s1, t1, c1 + 0.5 * c2, s1 + 0.5 * s2, t2])
        q = closed + rng.normal(0.0, 0.05, 6)
        p = {
            "F": rng.uniform(-100.0, 100.0),
            "k_j": 10.0 ** rng.uniform(0.0, 7.0),
            "c_j": 10.0 ** rng.uniform(-2.0, 4.0),
            "k_sp": 10.0 ** rng.uniform(-1.0, 3.0),
            "c_sp": 10.0 ** rng.uniform(-3.0, 3.0),
            "l_us": rng.uniform(0.0, 2.0),
            "m_1": 10.0 ** rng.uniform(-1.0, 1.0),
            "m_2": 10.0 ** rng.uniform(-1.0, 1.0),
            "gravity_angle": rng.uniform(-np.pi, np.pi),
            "load_factor": rng.uniform(0.0, 3.0),
        }
        yield q, rng.normal(0.0, 2.0, 6), p


def relative(found, expected):
    return np.abs(found - expected).max() / np.abs(expected).max()


def test_accelerations_equal_newton_and_euler_at_a_hundred_random_motions(overcentre):
    errors = [
        relative(overcentre.acceleration(q, v, p), newton_euler(q, v, p)) for q, v, p in random_motions(100)
    ]
    assert max(errors) < 1e-9


def test_dampers_of_the_bushes_act_on_the_velocity_between_the_pin_points(overcentre):
    for q, v, p in random_motions(20):
        undamped = {**p, "c_j": 0.0}
        found = overcentre.acceleration(q, v, p) - overcentre.acceleration(q, v, undamped)
        expected = -p["c_j"] * np.linalg.solve(
            reference.mass(p), reference.gap_jacobian(q).T @ (reference.gap_jacobian(q) @ v)
        )
        noise = 1e-12 * np.abs(overcentre.acceleration(q, v, undamped)).max()
        assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max() + noise


@pytest.mark.parametrize("integrator", ["Euler", "RK4", "implicit", "implicitfast", "discrete"])
def test_accelerations_do_not_depend_on_the_integrator_in_the_xml(integrator):
    assert XML.count('integrator="discrete"') == 1
    mechanism = mc.Mechanism.from_xml(XML.replace('integrator="discrete"', f'integrator="{integrator}"'))
    errors = [
        relative(mechanism.acceleration(q, v, p), newton_euler(q, v, p)) for q, v, p in random_motions(5)
    ]
    assert max(errors) < 1e-9


def test_defaults_are_those_of_the_reference(overcentre):
    assert overcentre.values() == pytest.approx(PARAMETERS, rel=1e-15)


def test_it_has_six_degrees_of_freedom_and_five_bush_elements(overcentre):
    assert overcentre.n == 6
    assert overcentre.bushes == ["bush_A_x", "bush_A_z", "bush_B_x", "bush_B_z", "bush_C_z"]


def test_the_initial_pose_is_assembled_at_sixty_degrees(overcentre):
    assert overcentre.qpos0 == pytest.approx(reference.assembled_pose(math.radians(60.0)), abs=1e-15)


def test_observables_are_the_angles_the_height_of_b_and_the_spring(overcentre):
    q = next(random_motions(1))[0]
    names = ["theta_1", "theta_2", "height", "spring_length"]
    expected = [q[2], q[5], q[1] + 0.5 * math.sin(q[2]), q[3] - q[0]]
    assert overcentre.measure(q[None], overcentre.values(), names)[0] == pytest.approx(expected, rel=1e-13)


def test_bush_force_sensors_read_minus_stiffness_times_gap(overcentre):
    q = next(random_motions(1))[0]
    found = overcentre.measure(q[None], overcentre.values({"k_j": 250.0}), ["R_A_x", "R_A_z"])[0]
    assert found == pytest.approx(-250.0 * gaps(q)[:2], rel=1e-12)


@pytest.mark.parametrize("k_j", reference.ELASTIC_FOLDS)
def test_the_table_of_folds_holds_for_the_hand_written_energies(k_j):
    for force, degrees in reference.ELASTIC_FOLDS[k_j]:
        found, angle = reference.fold_near(math.radians(degrees), {**PARAMETERS, "k_j": k_j})
        assert found == pytest.approx(force, abs=0.6e-9)
        assert math.degrees(angle) == pytest.approx(degrees, abs=0.6e-7)
