"""Orbits of mechanisms whose actuators have states of their own: closed forms of linear ones, a known cycle."""

from __future__ import annotations

import cmath
import math
from functools import lru_cache

import numpy as np
import pytest

import mjcont as mc
from mjcont.models.loading import models_folder

MASS, STIFFNESS, DAMPING, LAG, GAIN = 2.0, 4.0, 0.3, 0.7, 1.5
MEAN, AMPLITUDE, PHASE = 1.0, 0.5, 0.3


def filtered(actuator=f'<general name="F" joint="x" dyntype="filter" dynprm="{LAG}" gainprm="{GAIN}"/>'):
    """A mass on a spring that a force drives through an actuator with a state."""
    return mc.Mechanism.from_xml(f"""
    <mujoco model="filtered">
      <option gravity="0 0 0"/>
      <worldbody>
        <body name="mass">
          <joint name="x" type="slide" axis="1 0 0" stiffness="{STIFFNESS}" damping="{DAMPING}"/>
          <geom size="0.1" mass="{MASS}"/>
        </body>
      </worldbody>
      <actuator>{actuator}</actuator>
      <sensor><actuatorfrc name="force" actuator="F"/></sensor>
    </mujoco>""")


@lru_cache(maxsize=1)
def response():
    forcing = {"F": mc.Harmonic(AMPLITUDE, phase=PHASE)}
    return mc.continue_response(filtered(), "frequency", (0.2, 0.3), forcing, {"F": MEAN}, chord=0.05)


def lagging(frequency):
    """Return the complex amplitude of the activation, a' = (ctrl - a) / LAG."""
    return AMPLITUDE * np.exp(1j * PHASE) / (1.0 + 2j * math.pi * LAG * np.asarray(frequency))


def moved(frequency):
    """Return the complex amplitude of the mass's place."""
    w = 2.0 * math.pi * np.asarray(frequency)
    return GAIN * lagging(frequency) / (STIFFNESS - MASS * w**2 + 1j * DAMPING * w)


def turned(orbit):
    """Return exp(i w t) at an orbit's times."""
    return np.exp(2j * math.pi * orbit.frequency * orbit.times)


@pytest.mark.slow
def test_a_force_through_a_filter_moves_a_mass_as_two_linear_systems_in_series_do():
    x = moved(response()["frequency"])
    assert response()["x.h1"] == pytest.approx(np.abs(x), rel=1e-7)
    assert response()["x.phase"] == pytest.approx(np.angle(x), abs=1e-7)
    assert response()["x.mean"] == pytest.approx(np.full(len(x), GAIN * MEAN / STIFFNESS), rel=1e-8)


@pytest.mark.slow
def test_activations_along_an_orbit_are_those_of_the_filter():
    orbit = response()[0].orbit
    assert orbit.activations[:, 0] == pytest.approx(MEAN + (lagging(orbit.frequency) * turned(orbit)).real, abs=1e-8)
    assert (orbit.states.shape[1], orbit.velocities.shape[1]) == (1, 1)
    w = 2.0 * math.pi * orbit.frequency
    assert orbit.velocities[:, 0] == pytest.approx((1j * w * moved(orbit.frequency) * turned(orbit)).real, abs=1e-7)


@pytest.mark.slow
def test_a_sensor_of_the_force_reads_the_activation_in_motion():
    assert response()["force.h1"] == pytest.approx(GAIN * np.abs(lagging(response()["frequency"])), rel=1e-8)


def test_multipliers_are_those_of_the_mass_and_of_the_filter():
    orbit = response()[0].orbit
    rates = [*np.roots([MASS, DAMPING, STIFFNESS]), -1.0 / LAG]
    expected = sorted((cmath.exp(orbit.period * s) for s in rates), key=lambda m: (abs(m), m.imag))
    found = sorted(orbit.multipliers.tolist(), key=lambda m: (round(abs(m), 6), m.imag))
    assert found == pytest.approx(expected, abs=1e-7)


def test_motions_beside_confirm_it():
    assert mc.verify_stability(response(), n=2).certificate.holds


def test_activations_are_in_the_file(tmp_path):
    loaded = mc.load(response().save(tmp_path / "filtered.h5"))
    assert np.array_equal(loaded[0].orbit.activations, response()[0].orbit.activations)
    assert np.array_equal(loaded[0].orbit.velocities, response()[0].orbit.velocities)


def rods(actuator):
    """Ziegler's two rods under a load that follows them, through another actuator."""
    text = (models_folder() / "ziegler_rods.xml").read_text(encoding="utf-8")
    plain = '<general name="P" site="tip" gear="-1 0 0 0 0 0"/>'
    assert plain in text
    return mc.Mechanism.from_xml(text.replace(plain, plain.replace("/>", f" {actuator}/>")))


@pytest.mark.slow
def test_a_filter_before_a_constant_load_adds_a_multiplier_to_a_cycle_and_changes_nothing_else():
    flutter = mc.find_cycle(rods(f'dyntype="filter" dynprm="{LAG}"'), {"P": 1.822089}, state=[0.3, 0.2])
    assert flutter.period == pytest.approx(7.480310949944562, rel=1e-9)
    own = np.delete(flutter.multipliers, flutter.trivial)
    assert own[0] == pytest.approx(0.9003618235242208, abs=1e-6)
    assert np.abs(own - math.exp(-flutter.period / LAG)).min() < 1e-6


def test_a_muscle_that_switches_time_constants_at_once_is_refused():
    with pytest.raises(mc.MjcontError, match="tausmooth"):
        mc.continue_response(pulled(0.0), "frequency", (0.2, 0.3), {"F": mc.Harmonic(0.1)}, {"F": 0.5})


def pulled(smooth):
    """The mass pulled by a muscle whose time constants change over a width of `smooth`."""
    return filtered(f'<muscle name="F" joint="x" timeconst="0.1 0.3" tausmooth="{smooth}" range="0.75 1.05" '
                    'lengthrange="-1 1" force="3"/>')


@pytest.mark.slow
def test_a_response_of_a_muscle_is_where_its_motion_comes_back_to():
    curve = mc.continue_response(pulled(0.5), "frequency", (0.2, 0.3), {"F": mc.Harmonic(0.1)}, {"F": 0.5}, chord=0.05)
    assert mc.verify_stability(curve, n=2).certificate.holds


def test_a_motion_does_not_begin_on_an_orbit_with_activations():
    with pytest.raises(mc.MjcontError, match="activations at rest"):
        mc.simulate(response()[0].orbit)
