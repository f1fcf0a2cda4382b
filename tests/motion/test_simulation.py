"""Time histories against independent integrations of equations of motion written out by hand, and their contract."""

from __future__ import annotations

import math

import numpy as np
import pytest
from problems import reference
from problems.gears import FIRST
from scipy.integrate import solve_ivp

import mjcont as mc

DURATION = 2.0


def overcentre_motion(force, times, start):
    """Integrate the overcentre's energies from tests/problems/reference.py, (samples, 6)."""
    p = reference.PARAMETERS
    inverse = np.linalg.inv(reference.mass(p))

    def rate(t, y):
        q, v = y[:6], y[6:]
        return np.concatenate([v, inverse @ (reference.forces(q, {**p, "F": force(t)}) - reference.damping(q, p) @ v)])

    found = solve_ivp(rate, (0, times[-1]), np.concatenate([start, np.zeros(6)]), "DOP853", times, rtol=1e-11,
                      atol=1e-12)
    return found.y[:6].T


def gear_motion(gear, force, times, start):
    """Integrate the 5-DOF gear's hand-derived equations of motion, implicitly: its bushes are stiff and damped."""
    values = gear.values()

    def rate(t, y):
        q, v = y[:5], y[5:]
        p = {**values, "F_ret": force(t)}
        zero = np.zeros(5)
        centripetal = FIRST.inertial_forces(q, v, zero, p)
        mass = np.column_stack([FIRST.inertial_forces(q, zero, e, p) for e in np.eye(5)])
        forces = FIRST.forces_at_rest(q, p) + FIRST.damping_forces(q, v, p)
        return np.concatenate([v, np.linalg.solve(mass, forces - centripetal)])

    y0 = np.concatenate([start, np.zeros(5)])
    return solve_ivp(rate, (0, times[-1]), y0, "Radau", times, rtol=1e-7, atol=1e-10).y[:5].T


def relative_error(found, expected):
    return np.abs(found - expected).max() / np.abs(expected - expected[0]).max()


@pytest.fixture
def pushed(overcentre):
    """The overcentre at rest under F = 50 N, and a smooth force that swings it."""
    return overcentre, mc.find_equilibrium(overcentre, {"F": 50.0}), lambda t: 50.0 - 15.0 * math.sin(math.pi * t) ** 2


def overcentre_state(mechanism, history):
    names = ("x_1", "z_1", "theta_1", "x_2", "z_2", "theta_2")
    return np.column_stack([history[n] for n in names])


@pytest.mark.slow
@pytest.mark.parametrize(("integrator", "step"), [("RK4", 1e-3), ("discrete", 1e-4)])
def test_the_overcentres_motion_is_that_of_an_independent_integration(pushed, integrator, step):
    mechanism, rest, force = pushed
    history = mc.simulate(
        mechanism, {"F": force}, DURATION, rest, integrator=integrator, timestep=step, tol=1e-4, samples=200
    )
    found = overcentre_state(mechanism, history)
    assert history.status == "done"
    assert history.settings["error"] <= 1e-4
    assert relative_error(found, overcentre_motion(force, history["time"], found[0])) < 1e-4


@pytest.mark.long
def test_the_gears_motion_is_that_of_an_independent_integration():
    gear = mc.Mechanism.from_xml("nose_gear")
    rest = mc.find_equilibrium(gear, {"F_ret": 4e5}, keyframe="uplock_above")

    def force(t):
        return 4e5 + 4e4 * math.sin(math.pi * t / 2) ** 2

    history = mc.simulate(gear, {"F_ret": force}, 1.0, rest, integrator="RK4", tol=1e-5, samples=40)
    assert history.status == "done"
    expected = gear_motion(gear, force, history["time"], rest.state)
    assert relative_error(history.states, expected) < 1e-4
    implicit = mc.simulate(gear, {"F_ret": force}, 1.0, rest, tol=1e-4, samples=40)
    assert relative_error(implicit.states, expected) < 2e-4


@pytest.mark.slow
@pytest.mark.parametrize(("integrator", "order"), [("discrete", 1), ("implicitfast", 1), ("RK4", 4)])
def test_the_error_falls_with_the_order_of_the_integrator(pushed, integrator, order):
    mechanism, rest, _ = pushed
    errors = []
    for step in np.array([4.0, 2.0, 1.0]) * (1e-3 if order == 4 else 5e-5):
        history = mc.simulate(mechanism, {"F": 45.0}, 1.0, rest, integrator=integrator, timestep=step, samples=50)
        found = overcentre_state(mechanism, history)
        errors.append(relative_error(found, overcentre_motion(lambda t: 45.0, history["time"], found[0])))
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(slopes - order) < 0.15)


@pytest.mark.slow
def test_halving_reaches_the_tolerance_it_is_given(pushed):
    mechanism, rest, force = pushed
    loose, tight = (mc.simulate(mechanism, {"F": force}, 1.0, rest, tol=tol) for tol in (1e-2, 1e-3))
    assert tight.settings["timestep"] < loose.settings["timestep"]
    found = overcentre_state(mechanism, tight)
    assert relative_error(found, overcentre_motion(force, tight["time"], found[0])) < 2e-3
    assert "changed the motion by" in tight.message


def test_a_tolerance_out_of_reach_stalls_and_keeps_what_was_computed(pushed):
    mechanism, rest, force = pushed
    history = mc.simulate(mechanism, {"F": force}, 1.0, rest, tol=1e-9, max_steps=4000)
    assert history.status == "stalled"
    assert "the tolerance 1e-09 was not reached" in history.message
    assert history["time"][-1] == pytest.approx(1.0)


def test_a_run_of_too_many_steps_stalls_where_they_end(pushed):
    mechanism, rest, force = pushed
    history = mc.simulate(mechanism, {"F": force}, 1.0, rest, max_steps=400)
    assert history.status == "stalled"
    assert history["time"][-1] == pytest.approx(0.4)


def test_motion_that_an_explicit_integrator_cannot_follow_diverges_with_a_sentence(capfd):
    gear = mc.Mechanism.from_xml("nose_gear")
    history = mc.simulate(gear, {"F_ret": 4e5}, 5.0, keyframe="uplock_above", integrator="Euler", timestep=0.01)
    assert history.status == "diverged"
    assert "diverged after t =" in history.message
    assert np.all(np.isfinite(history.states))
    assert "WARNING" not in "".join(capfd.readouterr())


# -- inputs ----------------------------------------------------------------------------------------------------------


def pendulum(pendulum_xml, option=""):
    """An inverted pendulum of 1 kg and 1 m under a moment M, without friction."""
    text = pendulum_xml(actuator='<motor name="M" joint="hip" ctrllimited="true" ctrlrange="-30 30"/>',
                        sensor='<jointvel name="speed" joint="hip"/>', option=option)
    return mc.Mechanism.from_xml(text)


@pytest.mark.slow
def test_a_controller_of_proportional_and_derivative_feedback_makes_a_damped_oscillator(pendulum_xml):
    mechanism = pendulum(pendulum_xml)
    inertia, stiffness, damping = 1.01, 4.0, 2.0

    def hold_upright(t, seen):
        # cancels gravity, so that inertia x'' + damping x' + stiffness x = 0 remains
        return -9.81 * math.sin(seen["hip"]) - stiffness * seen["hip"] - damping * seen.velocity[0]

    history = mc.simulate(
        mechanism, {"M": hold_upright}, 3.0, state=[0.1], integrator="RK4", timestep=1e-3, control_step=1e-3
    )
    decay, k = damping / (2 * inertia), stiffness / inertia
    omega = math.sqrt(k - decay**2)
    t = history["time"]
    expected = 0.1 * np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
    np.testing.assert_allclose(history["hip"], expected, atol=3e-4)


def test_a_controller_is_sampled_every_control_step_and_held_between(pendulum_xml):
    mechanism, times = pendulum(pendulum_xml), []
    history = mc.simulate(mechanism, {"M": lambda t, seen: times.append(t) or len(times)}, 1.0, control_step=0.1)
    np.testing.assert_allclose(times, 0.1 * np.arange(10), atol=1e-12)
    assert history.settings["control_step"] == pytest.approx(0.1)
    assert sorted(set(history["M"])) == list(range(1, 11))


@pytest.mark.slow
def test_a_controller_with_a_memory_starts_afresh_in_every_run(pendulum_xml):
    class Integral:
        total = 0.0

        def __call__(self, t, seen):
            self.total += 0.01 * (0.3 - seen["hip"])
            return 20.0 * self.total

    mechanism, law = pendulum(pendulum_xml), Integral()
    first, second = (mc.simulate(mechanism, {"M": law}, 1.0) for _ in range(2))
    np.testing.assert_array_equal(first.states, second.states)
    assert law.total == 0.0


def test_a_controller_saturates_at_the_actuators_range(pendulum_xml):
    history = mc.simulate(pendulum(pendulum_xml), {"M": lambda t, seen: 1e3}, 0.1)
    assert np.all(history["M"] == 30.0)


@pytest.mark.slow
def test_gravity_that_turns_with_time_in_a_batch_is_gravity_written_before_every_step():
    gear = mc.Mechanism.from_xml("nose_gear")
    rest = mc.find_equilibrium(gear, {"F_ret": 4e5}, keyframe="uplock_above")
    gust = {"gravity_angle": lambda t: 0.1 * math.sin(3 * t), "load_factor": ((0.0, 1.0), (1.0, 1.5))}
    batched = mc.simulate(gear, gust, 1.0, rest)
    # an input that acts on a field of the model has each step written; this one does not change it
    written = mc.simulate(gear, {**gust, "k_sp": lambda t: 2000.0}, 1.0, rest)
    assert np.abs(np.diff(batched["theta_1"])).max() > 1e-6
    np.testing.assert_allclose(batched.states, written.states, atol=1e-12)


@pytest.mark.slow
def test_a_spring_that_stiffens_with_time_moves_the_mechanism_as_its_equilibria_move(overcentre):
    rest = mc.find_equilibrium(overcentre, {"F": 50.0})
    history = mc.simulate(overcentre, {"k_sp": lambda t: 10.0 + 0.1 * t}, 20.0, rest)
    there = mc.find_equilibrium(overcentre, {"F": 50.0, "k_sp": 12.0}, state=rest.state)
    assert abs(there["theta_1"] - rest["theta_1"]) > 1e-2
    assert history["theta_1"][-1] == pytest.approx(there["theta_1"], abs=2e-3)


# -- many ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_many_runs_at_once_are_the_runs_one_by_one(overcentre):
    rest = mc.find_equilibrium(overcentre, {"F": 50.0})
    cases = [
        {"inputs": {"F": 48.0}, "start": rest},
        {"inputs": {"F": lambda t: 50 + t}, "start": rest, "velocity": 0.01 * np.ones(6)},
        {"inputs": {"gravity_angle": ((0, 1), (0, 0.1))}, "start": {"F": 50.0, "k_j": 500.0}, "state": rest.state},
        {"inputs": {"F": lambda t, seen: 50 + seen["theta_1"]}, "start": rest},
        {"inputs": {"k_sp": lambda t: 10 + t}, "start": rest},
    ]
    together = mc.simulate_many(overcentre, cases, 1.0)
    for case, found in zip(cases, together, strict=True):
        np.testing.assert_allclose(found.states, mc.simulate(overcentre, duration=1.0, **case).states, atol=1e-13)


@pytest.mark.slow
def test_only_the_cases_that_need_it_are_repeated_at_finer_steps(overcentre):
    rest = mc.find_equilibrium(overcentre, {"F": 50.0})
    cases = [{"start": rest}, {"inputs": {"F": 40.0}, "start": rest}]
    still, moving = mc.simulate_many(overcentre, cases, 0.5, tol=2e-3)
    assert still.status == moving.status == "done"
    assert moving.settings["timestep"] < still.settings["timestep"]


def test_a_run_that_diverges_does_not_harm_its_neighbours():
    gear = mc.Mechanism.from_xml("nose_gear")
    soft = {"F_ret": 4e5, "k_j": 1e4, "c_j": 20.0}
    cases = [{"start": {"F_ret": 4e5, "k_j": 1e10}, "keyframe": "uplock_above"},
             {"start": soft, "keyframe": "uplock_above"}]
    wild, tame = mc.simulate_many(gear, cases, 0.5, integrator="implicitfast")
    assert (wild.status, tame.status) == ("diverged", "done")
    alone = mc.simulate(gear, None, 0.5, soft, keyframe="uplock_above", integrator="implicitfast")
    np.testing.assert_array_equal(tame.states, alone.states)


@pytest.mark.slow
def test_a_vectorised_controller_is_called_once_for_all_runs_with_arrays(overcentre):
    class Law:
        vectorised = True

        def __call__(self, t, seen):
            assert seen["theta_1"].shape == (3,)
            return 50.0 - 5.0 * seen["theta_1"]

    rest = mc.find_equilibrium(overcentre, {"F": 50.0})
    law, speeds = Law(), (0.0, 0.05, 0.1)
    cases = [{"inputs": {"F": law}, "start": rest, "velocity": s * np.ones(6)} for s in speeds]
    single = [{**c, "inputs": {"F": lambda t, seen: 50.0 - 5.0 * seen["theta_1"]}} for c in cases]
    for one, other in zip(*(mc.simulate_many(overcentre, c, 0.2) for c in (cases, single)), strict=True):
        np.testing.assert_allclose(one.states, other.states, atol=1e-13)


# -- rest and files --------------------------------------------------------------------------------------------------


def test_a_history_ends_at_rest_when_asked_to(overcentre):
    rest = mc.find_equilibrium(overcentre, {"F": 50.0, "c_j": 20.0})
    history = mc.simulate(overcentre, {"F": 49.0}, 1000.0, rest, until_rest=1e-5)
    assert history.status == "at rest"
    assert history["time"][-1] < 500.0
    there = mc.find_equilibrium(overcentre, {"F": 49.0, "c_j": 20.0}, state=rest.state)
    assert history["theta_1"][-1] == pytest.approx(there["theta_1"], abs=1e-4)


def test_a_saved_history_loads_with_columns_settings_and_model(overcentre, tmp_path):
    overcentre.declare("stiff", "actuator:bush_*.biasprm[1]*-1", unit="N/m")
    history = mc.simulate(overcentre, {"F": lambda t: 50 + t}, 0.2, tol=0.1)
    loaded = mc.load(history.save(tmp_path / "motion.h5"))
    assert isinstance(loaded, mc.History)
    assert (loaded.units, loaded.settings, loaded.status) == (history.units, history.settings, history.status)
    assert loaded.provenance == history.provenance
    assert str(loaded) == str(history)
    for name in history.columns:
        np.testing.assert_array_equal(loaded[name], history[name])
    np.testing.assert_array_equal(loaded.velocities, history.velocities)
    again = mc.simulate(loaded.problem, {"F": lambda t: 50 + t}, 0.2, tol=0.1)
    np.testing.assert_array_equal(again.states, history.states)


@pytest.mark.slow
def test_a_damaged_history_is_refused(overcentre, tmp_path):
    import h5py

    path = mc.simulate(overcentre, {"F": 50.0}, 0.1).save(tmp_path / "motion.h5")
    with h5py.File(path, "a") as f:
        del f["velocities"]
    with pytest.raises(mc.ResultFileError, match="incomplete or damaged"):
        mc.load(path)


# -- errors ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"inputs": {"F": lambda a, b, c: 0.0}}, "this one needs 3 arguments"),
        ({"inputs": {"F": ((0, 0), (1, 2))}}, "times increasing"),
        ({"inputs": {"F": ((0, 1), (1, np.nan))}}, "finite numbers"),
        ({"inputs": {"F": "much"}}, "expected a number, a function of time"),
        ({"inputs": {"F": lambda t: math.nan}}, "a finite number at every time|must be a finite number"),
        ({"inputs": {"F": lambda t, seen: math.inf}}, "controller of 'F' returned inf"),
        ({"inputs": {"F": lambda t, seen: "left"}}, "controller of 'F' must return a number"),
        ({"inputs": [1.0]}, "inputs must be a dict"),
        ({"tol": -1.0}, "tol must be a positive number"),
        ({"duration": 0.0}, "duration must be a positive number"),
        ({"duration": 1e300}, r"duration \(1e\+300 s\) is more than 1e\+12 time steps"),
        ({"timestep": 1e-300}, r"duration \(0.1 s\) is more than 1e\+12 time steps"),
        ({"inputs": {"F": lambda t, seen: 0.0}, "control_step": 1e300}, "control_step .* more than 1e.12 time steps"),
        ({"duration": "5"}, "duration must be a number"),
        ({"samples": math.nan}, "samples must be a whole number"),
        ({"max_steps": math.nan}, "max_steps must be a whole number"),
        ({"velocity": [math.nan] * 6}, "velocity must hold finite numbers"),
        ({"velocity": [1.0]}, r"velocity must have shape \(6,\)"),
    ],
)
def test_a_wrong_call_is_told_what_is_wrong(overcentre, given, message):
    with pytest.raises(mc.ParameterError, match=message):
        mc.simulate(overcentre, **{"duration": 0.1, **given})


def test_unknown_names_are_answered_with_the_valid_ones(overcentre):
    with pytest.raises(mc.NameLookupError, match="unknown integrator 'Heun'.*RK4"):
        mc.simulate(overcentre, integrator="Heun")
    with pytest.raises(mc.NameLookupError, match="unknown key of a case 'begin'.*start"):
        mc.simulate_many(overcentre, [{"begin": 1}])
    with pytest.raises(mc.NameLookupError, match="unknown observable 'theta_9'"):
        mc.simulate(overcentre, {"F": lambda t, seen: seen["theta_9"]}, 0.1)
    with pytest.raises(mc.NameLookupError, match="unknown parameter 'G'"):
        mc.simulate(overcentre, {"G": lambda t, seen: 1.0}, 0.1)


def test_an_input_that_leaves_its_actuators_range_on_the_way_is_refused(pendulum_xml):
    with pytest.raises(mc.BoundsError, match=r"input 'M' is 30.* at t = 0.3.* outside the actuator's ctrlrange"):
        mc.simulate(pendulum(pendulum_xml), {"M": lambda t: 100 * t}, 1.0)


def test_an_interrupted_run_keeps_what_was_computed(pendulum_xml):
    def interrupting(t, seen):
        if t > 0.5:
            raise KeyboardInterrupt
        return 0.0

    history = mc.simulate(pendulum(pendulum_xml), {"M": interrupting}, 1.0, tol=1e-2, control_step=0.01)
    assert history.status == "interrupted"
    assert history["time"][-1] == pytest.approx(0.51)


def test_the_command_line_shows_and_exports_a_history_and_says_why_it_cannot_plot_it(overcentre, tmp_path, capsys):
    from mjcont.commands.cli import main

    path = mc.simulate(overcentre, {"F": 50.0}, 0.1).save(tmp_path / "motion.h5")
    assert main(["inspect", str(path)]) == 0
    assert "time history of 0.1 s" in capsys.readouterr().out
    assert main(["export", str(path)]) == 0
    assert (tmp_path / "motion.csv").read_text().startswith("time [s],F [N],")
    assert main(["plot", str(path), "-x", "time", "-y", "theta_1"]) == 2
    assert "holds a time history" in capsys.readouterr().err
