"""Folds under a contact that is never lost, however stiff it is.

A sphere slides on a frictionless incline and is snapped over by a tendon spring. At each place x along the incline its
height follows from the balance across it, the motor's force M(x) from that along it, and folds are the extrema of M.
"""

from __future__ import annotations

import math
from functools import cache

import mujoco
import numpy as np
import pytest
from problems.marks import long
from scipy.optimize import brentq, minimize_scalar

import mjcont as mc

SLOPE = math.radians(20.0)
XML = """<mujoco><compiler angle="degree"/><option gravity="0 0 -9.81"/><worldbody>
  <geom name="incline" type="plane" size="5 5 .1" euler="0 20 0" friction="0" condim="1"/><site name="a" pos="0 0 .9"/>
  <body pos="0 0 .11"><joint name="x" type="slide" axis="1 0 0" damping="1"/>
    <joint name="z" type="slide" axis="0 0 1" damping="1"/>
    <geom name="ball" type="sphere" size=".1" mass="8" friction="0" condim="1" solref="-{k} -{b}" solimp=".9 .9 .001"/>
    <site name="s"/></body></worldbody>
  <tendon><spatial stiffness="120" springlength="1.1"><site site="a"/><site site="s"/></spatial></tendon>
  <actuator><motor name="M" joint="x"/></actuator></mujoco>"""


def model(exponent):
    return XML.format(k=10.0**exponent, b=2.0 * 10.0 ** (exponent / 2.0))


@cache
def extrema(exponent):
    """Return the extrema of M by MuJoCo's inverse dynamics at rest, without any continuation."""
    m = mujoco.MjModel.from_xml_string(model(exponent))
    d = mujoco.MjData(m)

    def force(x, z):
        d.qpos[:], d.qvel[:], d.qacc[:] = (x, z), 0.0, 0.0
        mujoco.mj_inverse(m, d)
        return -d.qfrc_inverse

    def drive(x):
        touching = -math.tan(SLOPE) * x + 0.1 / math.cos(SLOPE) - 0.11
        z = brentq(lambda z: force(x, z)[1], touching - 0.06, touching, xtol=1e-16, rtol=1e-15)
        return -force(x, z)[0]

    high = minimize_scalar(lambda x: -drive(x), bounds=(-0.8, -0.5), method="bounded", options={"xatol": 1e-7})
    low = minimize_scalar(drive, bounds=(0.0, 0.3), method="bounded", options={"xatol": 1e-7})
    return drive(high.x), drive(low.x)


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [3.0, 5.5, *map(long, (4.0, 6.0, 6.5, 7.0, 8.0))])
def test_both_folds_are_found_at_any_stiffness_of_the_contact(exponent):
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(model(exponent)), "M", bounds=(-60, 60))
    assert [word for word, _ in branch.ends] == ["at bound", "at bound"]
    assert [p.kind for p in branch.special_points] == ["LP", "LP"]
    # the contact's 72 N/m times 10^e turn the rounding of a height of 0.2 m into a force
    rounding = 72.0 * 10.0**exponent * np.spacing(0.2)
    np.testing.assert_allclose([p["M"] for p in branch.special_points], extrema(exponent), rtol=0, atol=1e-9 + rounding)
    assert branch.residuals.max() < 1e-12


@pytest.mark.slow
def test_folds_tend_to_those_of_a_rigid_incline():
    # on a rigid incline M'(x) = 0 is one equation in x; the yield of the contact moves M by the order of 1 / k
    soft, stiff = (np.array(extrema(e)) for e in (5.0, 7.0))
    rigid = stiff + (stiff - soft) / 99.0
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(model(8.0)), "M", bounds=(-60, 60))
    np.testing.assert_allclose([p["M"] for p in branch.special_points], rigid, atol=2e-6)


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [long(4.0), 6.0])
def test_a_fold_under_contact_can_be_followed(exponent):
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(model(exponent)), "M", bounds=(-60, 60))
    locus = mc.continue_special(branch.point("LP1"), "load_factor", bounds=(0.9, 1.1))
    assert [word for word, _ in locus.ends] == ["at bound", "at bound"]
    assert locus.residuals.max() < 1e-10
