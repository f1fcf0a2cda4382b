"""Beck's column: a cantilever of n links under a load that follows its tip.

Links of length l = mass m = 1 / n, hinge stiffness n, damping 0.01 n. With absolute angles theta_i and small motions

    M theta'' + 0.01 S theta' + (S - P l (1 - e 1_n')) theta = 0,   S = n D'D,   M = m A'A + I,

D the differences of neighbours (theta_0 = 0), A_ij = l for j < i and l / 2 for j = i, e = (1, ..., 1): a load along the
last link turns link i by P l (theta_i - theta_n). It flutters where two of its eigenvalues reach the axis: without
damping, for many links, at 20.05 EI / L^2 (M. Beck, Z. angew. Math. Phys. 3 (1952) 225), with it at about half.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy import linalg, optimize

import mjcont as mc


def beck(count):
    """The XML of the column; it lies along x, its links are capsules of radius 0.05 / n."""
    length, links = 1.0 / count, ""
    for i in reversed(range(count)):
        inside = links or f'<site name="tip" pos="{length} 0 0"/>'
        links = (
            f'<body pos="{length if i else 0.0} 0 0"><joint axis="0 1 0" stiffness="{count}" damping="{0.01 * count}"/>'
            f'<geom type="capsule" fromto="0 0 0 {length} 0 0" size="{0.05 * length}" mass="{length}"/>{inside}</body>'
        )
    return f"""
    <mujoco model="beck">
      <option gravity="0 0 0"><flag contact="disable"/></option>
      <worldbody>{links}</worldbody>
      <actuator><general name="P" site="tip" gear="-1 0 0 0 0 0"/></actuator>
    </mujoco>"""


def inertia(mass, length, radius):
    """Of a capsule about an axis across it through its middle."""
    ends = mass * 4.0 / 3.0 * radius / (length + 4.0 / 3.0 * radius)
    whole = (mass - ends) * (3.0 * radius**2 + length**2) / 12.0
    return whole + ends * (0.4 * radius**2 + 0.25 * length**2 + 0.375 * length * radius)


def flutter_load(count):
    length = mass = 1.0 / count
    arms = length * np.tri(count, k=-1) + 0.5 * length * np.eye(count)
    m = mass * arms.T @ arms + inertia(mass, length, 0.05 * length) * np.eye(count)
    differences = np.eye(count) - np.eye(count, k=-1)
    springs = count * differences.T @ differences
    follower = length * (np.eye(count) - np.outer(np.ones(count), np.eye(count)[-1]))

    def growth(load):
        zero, one = np.zeros((count, count)), np.eye(count)
        block = np.block([[zero, one], [-(springs - load * follower), -0.01 * springs]])
        values = linalg.eigvals(block, np.block([[one, zero], [zero, m]]))
        return values.real.max()

    return optimize.brentq(growth, 5.0, 12.0, xtol=1e-12, rtol=1e-14)


def flutter(count):
    """The Hopf point below 12 N, and the evaluations that the branch took."""
    mechanism = mc.Mechanism.from_xml(beck(count))
    branch = mc.continue_equilibria(mechanism, "P", bounds=(0.0, 12.0), start={"P": 0.0})
    (point,) = branch.special_points
    assert point.kind == "HB" and point.converged
    return point, mechanism.evaluations


@pytest.mark.parametrize("count", [3, 5, 20])
def test_the_column_flutters_where_its_linear_equations_do(count):
    assert flutter(count)[0]["P"] == pytest.approx(flutter_load(count), rel=1e-10)


def test_the_column_of_20_links_flutters_at_its_known_load():
    assert flutter(20)[0]["P"] == pytest.approx(10.4267900834, abs=6e-11)


@pytest.mark.long
def test_a_hopf_point_costs_evaluations_in_proportion_to_the_number_of_links():
    few, many = flutter(50)[1], flutter(100)[1]
    assert many < 2.2 * few


@pytest.mark.long
def test_the_column_of_100_links_is_located_in_20000_evaluations():
    point, evaluations = flutter(100)
    assert evaluations < 20_000
    assert point["P"] == pytest.approx(flutter_load(100), rel=1e-10)
