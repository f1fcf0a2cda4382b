"""What periodic motion is not followed for, and the sentence that says so; how curves end."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems.motions import brusselator, duffing, van_der_pol

import mjcont as mc
from mjcont.oscillation.forced import make_forcing
from mjcont.oscillation.walks import flow_of


def pendulum(joint="", damping=0.5, motor='<motor name="torque" joint="pivot"/>'):
    return mc.Mechanism.from_xml(f"""
    <mujoco model="pendulum">
      <option gravity="0 0 -1"/>
      <worldbody>
        <body name="bob">
          <joint name="pivot" type="hinge" axis="0 -1 0" damping="{damping}" {joint}/>
          <inertial pos="0 0 -1" mass="1" diaginertia="1e-13 1e-13 1e-13"/>
        </body>
      </worldbody>
      <actuator>{motor}</actuator>
    </mujoco>""")


def swung(mechanism, bounds=(0.05, 0.6), amplitude=0.05):
    forcing = {"torque": mc.Harmonic(amplitude)}
    return mc.continue_response(mechanism, "torque.amplitude", bounds, forcing, frequency=0.16, direction=1)


@pytest.mark.long
def test_a_response_ends_where_it_touches_a_stop():
    response = swung(pendulum('range="-30 30" limited="true"'))
    assert response.status == "corner"
    assert "limit of pivot" in response.ends[-1][1]
    assert math.degrees(response["pivot.max"][-1]) == pytest.approx(30.0, abs=3.0)


@pytest.mark.slow
def test_a_response_that_touches_a_stop_from_the_start_is_refused():
    with pytest.raises(mc.StartError, match="touches .*limit of pivot"):
        swung(pendulum('range="-1 1" limited="true"'), (0.3, 0.6), 0.3)


def test_dry_friction_is_refused():
    with pytest.raises(mc.MjcontError, match="dry friction"), pytest.warns(mc.ModelWarning):
        swung(pendulum('frictionloss="0.1"'))


def test_a_motor_that_acts_a_time_step_early_is_refused():
    motor = '<general name="torque" joint="pivot" dyntype="filter" dynprm="0.1" actearly="true"/>'
    with pytest.raises(mc.MjcontError, match="set actearly to false"):
        swung(pendulum(motor=motor))


def test_a_pendulum_without_damping_has_no_limit_cycle():
    free = pendulum(damping=0.0)
    with pytest.raises(mc.MjcontError, match="one for each energy"):
        mc.find_cycle(free, state=[0.5])


@pytest.mark.slow
def test_a_motion_that_comes_to_rest_has_no_cycle():
    with pytest.raises(mc.StartError, match="comes to rest"):
        mc.find_cycle(brusselator(), {"B": 1.2}, state=[1.1, 1.3])


def test_a_motion_that_diverges_is_told():
    field = mc.VectorField(lambda u, p: [u[0] ** 2 + 1.0], [0.0], {"p": 0.0})
    with pytest.raises(mc.StartError, match="diverges"):
        mc.find_cycle(field)


def test_a_forced_field_has_no_limit_cycles():
    with pytest.raises(mc.MjcontError, match="continue_response follows"):
        mc.find_cycle(duffing())


def test_a_model_needs_a_parameter_to_vary():
    with pytest.raises(mc.MjcontError, match="Valid: mu"):
        mc.continue_cycles(van_der_pol())


def test_what_cycles_begin_at_is_named():
    with pytest.raises(mc.MjcontError, match="an OrbitPoint, an Orbit, a Mechanism or a VectorField, got the int 3"):
        mc.continue_cycles(3)


@pytest.mark.slow
def test_an_orbit_is_its_own_start():
    response = mc.continue_response(duffing(), "w", (0.8, 0.9))
    with pytest.raises(mc.MjcontError, match="is its own start"):
        mc.continue_response(response[0], "w", (0.8, 0.9), frequency=0.1)


@pytest.mark.slow
def test_an_interrupt_keeps_the_orbits():
    def stop(count, special):
        if count == 5:
            raise KeyboardInterrupt

    curve = mc.continue_cycles(van_der_pol(), "mu", (1.0, 3.0), progress=stop)
    assert curve.interrupted
    assert len(curve) >= 4


@pytest.mark.slow
def test_a_users_own_frequency_keeps_its_name():
    def f(u, p):
        r2 = u[0] ** 2 + u[1] ** 2
        return [u[0] * (1.0 - r2) - p["frequency"] * u[1], u[1] * (1.0 - r2) + p["frequency"] * u[0]]

    curve = mc.continue_cycles(mc.VectorField(f, [1.0, 0.0], {"frequency": 1.0}), "frequency", (1.0, 2.0), direction=1)
    assert curve["frequency"][-1] == 2.0
    assert curve["period"][-1] == pytest.approx(math.pi, rel=1e-9)


def test_a_trial_parameter_that_is_no_number_is_no_error():
    mechanism = pendulum()
    flow = flow_of(mechanism, make_forcing(mechanism, {"torque": mc.Harmonic(0.1)}, 0.2))
    values = {**flow.values(), "torque.amplitude": math.nan}
    assert np.isnan(flow.rates(np.zeros((1, 2)), np.zeros(1), values)).all()
