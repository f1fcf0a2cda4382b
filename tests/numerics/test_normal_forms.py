"""Normal-form coefficients of special points, against normal forms built with known coefficients.

Each problem is a normal form seen through a linear change of coordinates, so that nothing is aligned with the axes
and the critical vectors do not have unit length. Coefficients are those of Kuznetsov, Elements of Applied Bifurcation
Theory, 3rd ed. (fold and cusp: section 3; Hopf: 3.5 and 5.4; Bogdanov-Takens: 8.4), with |q| = |v| = 1.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.forms import SHIFT, SPACE, oscillator, seen_through

import mjcont as mc

PLANE = np.array([[1.0, 0.5], [-0.3, 0.8]])


def only(branch, kind):
    (point,) = branch.of_kind(kind)
    return point


# -- fold and cusp --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("curvature", [1.0, -2.5, pytest.param(1e-3, marks=pytest.mark.long)])
def test_fold_coefficient_is_that_of_the_normal_form_over_the_length_of_its_vector(curvature):
    field = seen_through(PLANE, lambda z, p: [p["mu"] + curvature * z[0] ** 2, -z[1]], {"mu": 0.0}, [0.0, 0.0])
    bounds = (-1.0, 0.5) if curvature > 0 else (-0.5, 1.0)
    start = {"mu": -math.copysign(0.25, curvature)}
    state = SHIFT[:2] + PLANE @ [-math.copysign(math.sqrt(0.25 / abs(curvature)), curvature), 0.0]
    fold = only(mc.continue_equilibria(field, "mu", bounds, start, state=state), "LP")
    v = PLANE[:, 0] / np.linalg.norm(PLANE[:, 0])
    direction = math.copysign(1.0, v @ fold.vectors["v"])
    assert fold.coefficients["a"] == pytest.approx(direction * curvature / np.linalg.norm(PLANE[:, 0]), rel=1e-6)


def test_null_vectors_of_a_fold_are_normalised_to_unit_length_and_unit_product():
    field = seen_through(PLANE, lambda z, p: [p["mu"] - z[0] ** 2, -z[1]], {"mu": 0.25}, [0.5, 0.0])
    fold = only(mc.continue_equilibria(field, "mu", (-0.5, 0.5)), "LP")
    v, w = fold.vectors["v"], fold.vectors["w"]
    assert np.linalg.norm(v) == pytest.approx(1.0, rel=1e-12)
    assert w @ v == pytest.approx(1.0, rel=1e-10)
    assert v == pytest.approx(PLANE[:, 0] / np.linalg.norm(PLANE[:, 0]), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("cubic", [-1.0, 2.0])
def test_cusp_coefficient_is_that_of_the_normal_form_over_the_squared_length_of_its_vector(cubic):
    def g(z, p):
        return [p["mu"] + p["la"] * z[0] + cubic * z[0] ** 3, -z[1]]

    sign = -math.copysign(1.0, cubic)
    field = seen_through(PLANE, g, {"mu": 0.0, "la": sign}, [0.0, 0.0])
    branch = mc.continue_equilibria(field, "mu", (-1.0, 1.0))
    locus = mc.continue_special(branch.point("LP1"), "la", (-2.0, 2.0))
    expected = cubic / np.linalg.norm(PLANE[:, 0]) ** 2
    assert only(locus, "CP").coefficients["c"] == pytest.approx(expected, rel=1e-6)


@pytest.mark.slow
def test_cusp_coefficient_includes_what_the_slaved_direction_adds():
    # y relaxes to x^2, so that x y = x^3 on the centre manifold: c = -1 + 3/2
    def g(z, p):
        return [p["mu"] + p["la"] * z[0] - z[0] ** 3 + 1.5 * z[0] * z[1], -z[1] + z[0] ** 2]

    field = seen_through(PLANE, g, {"mu": 0.0, "la": -1.0}, [0.0, 0.0])
    branch = mc.continue_equilibria(field, "mu", (-1.0, 1.0))
    locus = mc.continue_special(branch.point("LP1"), "la", (-2.0, 2.0))
    assert only(locus, "CP").coefficients["c"] == pytest.approx(0.5 / np.linalg.norm(PLANE[:, 0]) ** 2, rel=1e-6)


# -- branch points --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("cubic", "name"), [(-1.5, "supercritical pitchfork"), (0.7, "subcritical pitchfork")])
def test_pitchfork_coefficient_is_that_of_the_normal_form(cubic, name):
    def g(z, p):
        return [p["mu"] * z[0] + cubic * z[0] ** 3, -z[1]]

    field = seen_through(PLANE, g, {"mu": -0.5}, [0.0, 0.0])
    point = only(mc.continue_equilibria(field, "mu", (-0.5, 0.6)), "BP")
    assert point.coefficients["type"] == name
    assert point.coefficients["c"] == pytest.approx(cubic / np.linalg.norm(PLANE[:, 0]) ** 2, rel=1e-6)


def test_a_crossing_of_two_branches_that_both_move_with_the_parameter_is_transcritical():
    field = seen_through(PLANE, lambda z, p: [p["mu"] * z[0] - z[0] ** 2, -z[1]], {"mu": -0.5}, [0.0, 0.0])
    point = only(mc.continue_equilibria(field, "mu", (-0.5, 0.6)), "BP")
    assert point.coefficients["type"] == "transcritical"


# -- Hopf -----------------------------------------------------------------------------------------------------


def amplitude(matrix):
    """Return |z1 + i z2| for the critical vector of unit length in u, squared."""
    q = matrix @ np.array([1.0, -1.0j, 0.0])
    return 4.0 / np.vdot(q, q).real


@pytest.mark.parametrize("omega", [0.05, 1.0, 20.0])
@pytest.mark.parametrize("cubic", [-1.0, 3.0])
def test_first_lyapunov_coefficient_is_that_of_the_normal_form(cubic, omega):
    field = seen_through(SPACE, oscillator(cubic, omega), {"mu": -0.5}, [0.0, 0.0, 0.0])
    hopf = only(mc.continue_equilibria(field, "mu", (-0.5, 0.6)), "HB")
    assert hopf.coefficients["omega"] == pytest.approx(omega, rel=1e-9)
    assert hopf.coefficients["l1"] == pytest.approx(cubic * amplitude(SPACE) / omega, rel=1e-6)


def test_first_lyapunov_coefficient_includes_what_the_slaved_direction_adds():
    field = seen_through(SPACE, oscillator(-1.0, 2.0, slaved=1.5), {"mu": -0.5}, [0.0, 0.0, 0.0])
    hopf = only(mc.continue_equilibria(field, "mu", (-0.5, 0.6)), "HB")
    assert hopf.coefficients["l1"] == pytest.approx(0.5 * amplitude(SPACE) / 2.0, rel=1e-6)
    assert hopf.coefficients["type"] == "subcritical"


def test_a_hopf_point_of_a_linear_system_is_degenerate():
    field = seen_through(SPACE, oscillator(0.0, 2.0), {"mu": -0.5}, [0.0, 0.0, 0.0])
    hopf = only(mc.continue_equilibria(field, "mu", (-0.5, 0.6)), "HB")
    assert hopf.coefficients["type"] == "degenerate"


# -- Bogdanov-Takens ------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(("a", "b"), [(1.0, 1.0), (1.0, -1.0), (0.5, 2.0)])
def test_bogdanov_takens_coefficients_are_those_of_the_normal_form_over_the_length_of_its_vector(a, b):
    def g(z, p):
        return [z[1], p["b1"] + p["b2"] * z[0] + a * z[0] ** 2 + b * z[0] * z[1]]

    field = seen_through(PLANE, g, {"b1": -0.25 / a, "b2": 1.0}, [-1.5 / a, 0.0])
    branch = mc.continue_equilibria(field, "b1", (-1.0, 1.0), state=SHIFT[:2] + PLANE @ [(-1 - 2**0.5) / (2 * a), 0.0])
    locus = mc.continue_special(only(branch, "LP"), "b2", (-2.0, 2.0))
    point = only(locus, "BT")
    length = np.linalg.norm(PLANE[:, 0])
    # both change their sign with the vector's
    sign = math.copysign(1.0, point.coefficients["a"])
    assert sign * point.coefficients["a"] == pytest.approx(a / length, rel=1e-6)
    assert sign * point.coefficients["b"] == pytest.approx(b / length, rel=1e-6)


# -- mechanisms -----------------------------------------------------------------------------------------------


def column_equations(b):
    """Return the Ziegler column of masses 2 and 1 in the angles of its joints, written out by hand: (phi, phi')."""

    def f(u, p):
        first, second = u[0], u[0] + u[1]
        w1, w2 = u[2], u[2] + u[3]
        cosine, sine = math.cos(first - second), math.sin(first - second)
        lower, upper = u[0] + b * u[2], u[1] + b * u[3]
        torques = [upper - lower + p["P"] * sine - sine * w2**2, -upper + sine * w1**2]
        a1, a2 = np.linalg.solve([[3.0, cosine], [cosine, 1.0]], torques)
        return [u[2], u[3], a1, a2 - a1]

    return mc.VectorField(f, np.zeros(4), {"P": 0.0})


def column_mjcf(b):
    hinge = f'type="hinge" axis="0 -1 0" stiffness="1" damping="{b}"'
    inertia = 'diaginertia="1e-13 1e-13 1e-13"'
    return f"""
    <mujoco>
      <option gravity="0 0 0"/>
      <worldbody>
        <body>
          <joint {hinge}/><inertial pos="1 0 0" mass="2" {inertia}/>
          <body pos="1 0 0">
            <joint {hinge}/><inertial pos="1 0 0" mass="1" {inertia}/><site name="tip" pos="1 0 0"/>
          </body>
        </body>
      </worldbody>
      <actuator><general name="P" site="tip" gear="-1 0 0 0 0 0"/></actuator>
    </mujoco>"""


@pytest.mark.slow
@pytest.mark.parametrize("b", [0.1, 1.0])
def test_first_lyapunov_coefficient_of_a_mechanism_is_that_of_unit_positions(b):
    column = mc.Mechanism.from_xml(column_mjcf(b))
    by_mechanism = only(mc.continue_equilibria(column, "P", (0.0, 3.0), {"P": 0.0}), "HB")
    by_hand = only(mc.continue_equilibria(column_equations(b), "P", (0.0, 3.0)), "HB")
    # velocities are i omega times positions: unit positions make the whole vector sqrt(1 + omega^2) long
    expected = by_hand.coefficients["l1"] * (1.0 + by_hand.coefficients["omega"] ** 2)
    assert by_mechanism.coefficients["l1"] == pytest.approx(expected, rel=1e-6)
