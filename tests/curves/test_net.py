"""A net of 1,000 masses, 3,000 degrees of freedom, hangs where its strings carry it."""

from __future__ import annotations

import numpy as np
import pytest
from problems.nets import Net

import mjcont as mc

pytestmark = pytest.mark.long


@pytest.fixture(scope="module", params=[0.04, 0.05], ids=["taut", "just long enough"])
def hanging(request):
    net = Net(25, 40, rest=request.param, string_damper=0.0)
    mechanism = mc.Mechanism.from_xml(net.xml())
    return net, mechanism, mc.find_equilibrium(mechanism)


def test_no_force_is_left_of_its_weight(hanging):
    net, _, point = hanging
    assert np.linalg.norm(net.forces(point.state)) < 1e-10 * net.weight


def test_it_sags_most_in_the_middle_and_alike_on_both_sides(hanging):
    net, _, point = hanging
    sag = point.state.reshape(net.rows, net.columns, 3)[:, :, 2]
    assert sag.min() == pytest.approx(sag[12, 19], rel=1e-9)
    assert sag == pytest.approx(sag[::-1], abs=1e-10) and sag == pytest.approx(sag[:, ::-1], abs=1e-10)


def test_it_is_found_in_evaluations_that_do_not_grow_with_the_net(hanging):
    assert hanging[1].evaluations < 5_000


def test_it_is_stable_and_its_slowest_modes_are_those_of_its_matrices(hanging):
    net, _, point = hanging
    assert point.stability == "stable"
    # s^2 + s c / m + w^2 = 0 for every mode, its frequency w without damping
    squares = np.linalg.eigvalsh(net.stiffness(point.state) / net.mass)[:3]
    for square in squares:
        expected = np.roots([1.0, net.damper / net.mass, square])
        assert min(abs(point.eigenvalues - expected[0])) < 1e-8 * abs(expected[0])
