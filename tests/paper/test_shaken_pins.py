"""Elastic pins that oscillate: the rigid linkage they are compared with, in closed form, and the study."""

from __future__ import annotations

import importlib
import math
import sys

import numpy as np
import pytest

import mjcont as mc
from mjcont.paper.reproduce import load_script, scripts_folder

sys.path.insert(0, str(scripts_folder()))
RigidLinkage = importlib.import_module("_rigid_linkage").RigidLinkage
_shaken = importlib.import_module("_shaken")

F, G, LENGTH, K, C, FREE = 30.0, 9.81, 1.0, 10.0, 10.0, 0.5


@pytest.fixture(scope="module")
def linkage():
    """The overcentre mechanism with rigid pins, from its model: links of 1 kg and 1 m."""
    model = mc.Mechanism.from_xml("overcentre")
    return RigidLinkage.of(model, "theta_1", model.start_state(), (-1.4, 1.4), ("F", "load_factor"), {"F": F})


def mass(s):
    """Return twice the kinetic energy per theta_1'^2: link 1 turns about A, link 2 moves and turns."""
    return 1 / 3 + 9 / 4 * math.sin(s) ** 2 + 1 / 4 * math.cos(s) ** 2 + 1 / 12


def moment(s, force):
    """Return the loads' moment on theta_1: F and the weights at half the height of B, the spring along x."""
    stretch = LENGTH * math.cos(s) - FREE
    return 0.5 * math.cos(s) * (force - 2.0 * G) + K * stretch * math.sin(s)


@pytest.mark.parametrize("s", [-1.2, 0.3, 1.1])
def test_the_rigid_linkage_is_lagrange_s_equation(linkage, s):
    y = float(linkage.way(s))
    row, slopes = linkage.table.at(y)
    assert row[0] == pytest.approx(s, abs=1e-9)
    assert slopes[0] == pytest.approx(mass(s) ** -0.5, rel=1e-7)
    assert row[1] == pytest.approx(C * math.sin(s) ** 2 / mass(s), rel=1e-7)
    assert linkage.force(y) == pytest.approx(moment(s, F) / math.sqrt(mass(s)), rel=1e-7)
    assert linkage.force(y, F=25.0) == pytest.approx(moment(s, 25.0) / math.sqrt(mass(s)), rel=1e-7)


def test_its_small_swings_are_those_of_a_damped_oscillator(linkage):
    y = linkage.rest(0.7, 1.39)
    s, h, w = float(linkage.angle([y])[0]), 1e-5, 2.0 * math.pi * 0.7
    assert moment(s, F) == pytest.approx(0.0, abs=1e-8)
    stiffness = -(moment(s + h, F) - moment(s - h, F)) / (2.0 * h)
    exact = 0.5 * math.cos(s) / (stiffness + 1j * w * C * math.sin(s) ** 2 - w**2 * mass(s))
    assert linkage.response(y, "F", np.array([0.7]))[0] == pytest.approx(exact, rel=1e-6)


@pytest.fixture(scope="module")
def shaken():
    rest = mc.find_equilibrium(mc.Mechanism.from_xml("overcentre"), {"F": F, "k_j": 1e6})
    return _shaken.Shaken.of("overcentre", rest, "theta_1", (-80.0, 80.0))


@pytest.mark.slow
def test_responses_differ_by_a_part_that_falls_as_the_stiffness_grows(shaken):
    compared = _shaken.compare("overcentre", shaken, "F")
    assert compared.slope == pytest.approx(-1.0, abs=0.01)
    assert 1e3 < compared.needed() < 1e4
    low, high = compared.factor
    assert 0.8 < low < high < 1.25


def test_a_bush_mode_s_damping_ratio_is_what_its_damper_makes(shaken):
    first, _ = _shaken.bush_mode(_shaken.stiffened(shaken, k_j=1e6, c_j=0.0))
    rest = _shaken.stiffened(shaken, k_j=1e6, c_j=2.0 * 0.01 * 1e6 / (2.0 * math.pi * first))
    assert _shaken.bush_mode(rest)[1] == pytest.approx(0.01, rel=0.5)


@pytest.mark.long
def test_what_the_study_says_holds(tmp_path):
    found = load_script(scripts_folder() / "shaken_pins.py").main(tmp_path)
    assert len(found) == 9
    assert [f.claim for f in found if not f.holds] == []
    assert (tmp_path / "shaken_pins.png").is_file()
