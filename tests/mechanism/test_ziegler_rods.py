"""The column of two rods that ships: its equations of motion written out by hand, and its Hopf point."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.motions import ziegler_rods

import mjcont as mc
from mjcont.mechanism.moving import Moving


@pytest.fixture(scope="module")
def rods():
    return mc.Mechanism.from_xml("ziegler_rods")


def test_its_accelerations_are_those_of_the_equations(rods):
    states = np.random.default_rng(7).uniform(-1.5, 1.5, (6, 4))
    found = Moving(rods).accelerations(states, rods.values({"P": 1.9}), {})
    expected = [ziegler_rods().residual(u, {"P": 1.9})[2:] for u in states]
    assert found == pytest.approx(np.array(expected), rel=1e-10, abs=1e-10)


def test_it_flutters_where_the_closed_form_says(rods):
    hopf = mc.continue_equilibria(rods, "P", (1.5, 2.0), start={"P": 1.5}).point("HB1")
    assert hopf["P"] == pytest.approx(1.656444444444449, rel=1e-9)
    assert hopf.coefficients["omega"] == pytest.approx(math.sqrt(2.0 / 3.0), rel=1e-9)
    assert hopf.coefficients["type"] == "supercritical"
