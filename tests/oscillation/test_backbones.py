"""Backbones of responses: resonance told by phase, against linear oscillators and nonlinear modes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.conservative import TWO_PI, period_of_duffing

import mjcont as mc

OSCILLATOR = """
<mujoco model="oscillator">
  <option gravity="0 0 0"/>
  <worldbody>
    <body>
      <joint name="x" type="slide" axis="1 0 0" stiffness="4" damping="0.3"/>
      <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
    </body>
  </worldbody>
  <actuator><motor name="F" joint="x"/></actuator>
</mujoco>
"""


def damped_duffing(damping):
    return mc.VectorField(
        lambda u, p: [u[1], p["F"] - p["d"] * u[1] - u[0] - u[0] ** 3], [0.0, 0.0], {"d": damping, "F": 0.0},
        names=["x", "v"],
    )


@pytest.mark.slow
def test_a_linear_oscillator_resonates_at_its_undamped_frequency_whatever_the_force(tmp_path):
    path = tmp_path / "oscillator.xml"
    path.write_text(OSCILLATOR)
    forcing = {"F": mc.Harmonic(1.0, phase=0.4)}
    response = mc.continue_response(mc.Mechanism.from_xml(path), "frequency", (0.1, 0.5), forcing=forcing)
    curve = mc.backbone(response, bounds=(0.1, 3.0))
    assert curve.kind == "backbone" and {status for status, _ in curve.ends} == {"at bound"}
    assert TWO_PI * curve["frequency"] == pytest.approx(math.sqrt(2.0), rel=1e-9)
    assert curve["x.phase"] == pytest.approx(0.4 - 0.5 * math.pi, abs=1e-9)
    assert curve["x.h1"] == pytest.approx(curve["F.amplitude"] / (0.3 * math.sqrt(2.0)), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("damping", [0.02, pytest.param(0.01, marks=pytest.mark.long)])
def test_the_backbone_of_a_lightly_damped_response_is_its_nonlinear_mode(damping):
    """The input has one harmonic, damping all: they differ by squares of damping."""
    response = mc.continue_response(
        damped_duffing(damping), "frequency", (0.8 / TWO_PI, 2.0 / TWO_PI), forcing={"F": mc.Harmonic(damping)}
    )
    curve = mc.backbone(response, "F.amplitude", (0.3 * damping, 3.0 * damping))
    a = curve["x.max"]
    exact = np.array([period_of_duffing(e) for e in 0.5 * a**2 + 0.25 * a**4])
    assert np.abs(curve["period"] / exact - 1.0).max() < 0.1 * damping**2
    assert a.max() > 1.7


@pytest.mark.slow
def test_a_response_that_does_not_resonate_has_no_backbone():
    response = mc.continue_response(damped_duffing(0.1), "frequency", (0.05, 0.1), forcing={"F": mc.Harmonic(0.1)})
    with pytest.raises(mc.StartError, match="follow it through its resonance"):
        mc.backbone(response)


@pytest.mark.slow
def test_a_backbone_belongs_to_a_response():
    field = damped_duffing(0.0)
    with pytest.raises(mc.MjcontError, match="continue_response"):
        mc.backbone(mc.continue_modes(field, "energy", (0.1, 0.2)))
