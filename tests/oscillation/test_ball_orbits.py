"""Orbits of mechanisms with ball and free joints, against the same on hinges, closed forms and SciPy's motions."""

from __future__ import annotations

import math
from functools import lru_cache

import mujoco
import numpy as np
import pytest
from problems.balls import Cone, floating, lively, matrix, moved, rod, rotation, turned
from scipy.integrate import solve_ivp

import mjcont as mc

SPRUNG = 'stiffness="2" damping="0.3"'


@lru_cache(maxsize=2)
def swung(ball):
    """A rod swung in a plane, at 0.55 Hz."""
    forcing = {"F": mc.Harmonic(2.0)}
    curve = mc.continue_response(rod(ball, joint=SPRUNG), "frequency", (0.54, 0.56), forcing, chord=0.5, direction=1)
    (point,) = curve.at(frequency=0.55)
    return point


def among(found, wanted, tol):
    """Whether every wanted number is among those found."""
    return all(np.abs(np.asarray(found) - w).min() <= tol for w in wanted)


@pytest.mark.slow
def test_a_rod_on_a_ball_joint_swings_in_a_plane_as_one_on_a_hinge_does():
    ball, hinge = swung(True), swung(False)
    for name in ("tip[0].max", "tip[0].h1", "tip[0].phase", "tip[2].max", "tip[2].mean"):
        assert ball[name] == pytest.approx(hinge[name], rel=1e-9)
    assert among(ball.orbit.multipliers, hinge.orbit.multipliers, 1e-9)
    times = np.linspace(0.0, 1.8, 7)
    assert ball.orbit.rate("tip[0]", times) == pytest.approx(hinge.orbit.rate("tip[0]", times), abs=1e-7)


@pytest.mark.slow
def test_states_are_unit_quaternions_and_velocities_those_of_the_hinge():
    ball, hinge = swung(True).orbit, swung(False).orbit
    angle = np.interp(0.3, hinge.times, hinge.states[:, 0])
    assert (ball.states.shape[1], ball.velocities.shape[1]) == (4, 3)
    assert np.linalg.norm(ball.states, axis=1) == pytest.approx(1.0, abs=1e-14)
    assert ball.at(0.3)[:4] == pytest.approx([math.cos(angle / 2), 0.0, math.sin(angle / 2), 0.0], abs=1e-3)
    assert ball.at(0.3)[4:] == pytest.approx([0.0, hinge.at(0.3)[1], 0.0], abs=1e-8)


@pytest.mark.slow
def test_multipliers_are_those_of_the_period_map():
    orbit, mechanism, h, columns = swung(True).orbit, rod(True, joint=SPRUNG), 1e-5, []
    pose, velocity = orbit.states[0], orbit.velocities[0]
    for step in h * np.eye(6):
        ends = [moved(mechanism, orbit, mechanism.retract(pose, s * step[:3]), velocity + s * step[3:])
                for s in (1.0, -1.0)]
        turned_by = mechanism.difference(ends[0][0], ends[1][0])
        columns.append(np.concatenate([turned_by, ends[0][1] - ends[1][1]]) / (2.0 * h))
    assert among(orbit.multipliers, np.linalg.eigvals(np.array(columns).T), 1e-7)


# -- a cone ------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=1)
def coned():
    """A rod driven round by two forces in quadrature, up to its cones' first fold."""
    forcing = {"F": mc.Harmonic(2.0), "G": mc.Harmonic(2.0, phase=-math.pi / 2)}
    mechanism = rod(True, joint=SPRUNG, inertia=(0.11, 0.11, 0.02))
    return mc.continue_response(mechanism, "frequency", (0.5, 0.6), forcing, chord=0.1)


@pytest.mark.slow
def test_a_rod_driven_round_moves_on_a_cone():
    orbit = coned()[-1].orbit
    w = 2.0 * math.pi * orbit.frequency
    x = Cone(w, 2.0).rest(np.array([0.0, -0.4, 0.0]))
    for time, pose in list(zip(orbit.times, orbit.states, strict=True))[::20]:
        turn = rotation(np.array([0.0, 0.0, w * time]))
        assert matrix(pose) == pytest.approx(turn @ rotation(x) @ turn.T, abs=1e-9)
    assert orbit.read("tip[2]", orbit.times) == pytest.approx(-rotation(x)[2, 2], abs=1e-9)


@pytest.mark.slow
def test_multipliers_of_a_cone_are_those_of_rest_in_turning_axes():
    orbit = coned()[-1].orbit
    cone = Cone(2.0 * math.pi * orbit.frequency, 2.0)
    exponents = cone.exponents(cone.rest(np.array([0.0, -0.4, 0.0])))
    assert among(orbit.multipliers, np.exp(orbit.period * exponents), 1e-8)


@pytest.mark.long
def test_folds_of_cones_lie_where_rest_folds_in_turning_axes():
    mechanism = rod(True, joint='stiffness="2" damping="0.1"', inertia=(0.11, 0.11, 0.02))
    mechanism.declare("k", "joint:hip.stiffness", bounds=(0.5, 5.0))
    forcing = {"F": mc.Harmonic(0.5), "G": mc.Harmonic(0.5, phase=-math.pi / 2)}
    response = mc.continue_response(mechanism, "frequency", (0.75, 0.9), forcing, chord=0.5)
    curve = mc.continue_special(response.point("LPC1"), "k", {"frequency": (0.7, 1.0), "k": (1.0, 3.0)})
    for frequency, k, orbit in list(zip(curve["frequency"], curve["k"], curve.orbits, strict=True))[::4]:
        cosine, axis = orbit.states[0, 0], orbit.states[0, 1:]
        x = 2.0 * math.atan2(np.linalg.norm(axis), cosine) * axis / np.linalg.norm(axis)
        w = 2.0 * math.pi * frequency
        known = Cone(w, 0.5, stiffness=k, damping=0.1).folding(np.append(x, w))
        assert frequency == pytest.approx(known / (2.0 * math.pi), abs=1e-7)
    assert curve.special_points == ()


# -- a free body ----------------------------------------------------------------------------------------------------


@pytest.mark.long
def test_a_free_body_on_springs_answers_little_torques_as_its_transfer_function_says():
    body, size = floating(), 1e-4
    curve = mc.continue_response(body, "frequency", (0.3, 0.31), {"torque": mc.Harmonic(size)}, chord=0.5)
    names = ["mark[0]", "mark[2]", "gyro[1]"]
    linear = mc.transfer(mc.find_equilibrium(body), "torque", names, curve["frequency"])
    for name in names:
        found = curve[f"{name}.h1"] * np.exp(1j * curve[f"{name}.phase"]) / size
        assert found == pytest.approx(linear[name], rel=1e-7)


@lru_cache(maxsize=1)
def tumbling():
    forcing = {"torque": mc.Harmonic(0.5), "force": mc.Harmonic(0.5, phase=0.4)}
    return mc.continue_response(floating(), "torque.amplitude", (0.5, 30.0), forcing, frequency=0.4, chord=0.1)


@pytest.mark.long
def test_a_free_body_that_turns_far_moves_as_scipy_says():
    orbit = tumbling()[-1].orbit
    pose, velocity = moved(floating(), orbit, orbit.states[0], orbit.velocities[0], "Radau", 1e-9)
    assert 2.0 * np.arccos(orbit.states[:, 3]).max() > 1.0
    assert pose == pytest.approx(orbit.states[0], abs=1e-7)
    assert velocity == pytest.approx(orbit.velocities[0], abs=1e-6)


@pytest.mark.slow
def test_a_rod_that_nothing_keeps_from_spinning_is_not_driven_round():
    loose = rod(True, joint='damping="0.3"')
    forcing = {"F": mc.Harmonic(1.0), "G": mc.Harmonic(1.0, phase=-math.pi / 2)}
    with pytest.raises(mc.StartError, match="nothing opposes rotation about z"):
        mc.continue_response(loose, "frequency", (0.5, 0.56), forcing)


# -- cycles ------------------------------------------------------------------------------------------------------------


@lru_cache(maxsize=2)
def cycles(ball):
    rest = mc.continue_equilibria(lively(ball), "push", (0.1, 0.4), {"push": 0.1})
    return mc.continue_cycles(rest.point("HB1"), chord=0.1)


@pytest.mark.slow
def test_cycles_from_a_hopf_point_are_those_on_a_hinge():
    ball, hinge = (cycles(b).at(push=0.35)[0] for b in (True, False))
    assert ball["period"] == pytest.approx(hinge["period"], rel=1e-9)
    assert ball["tip[1].max"] == pytest.approx(hinge["tip[1].max"], rel=1e-9)
    assert among(ball.orbit.multipliers, hinge.orbit.multipliers, 1e-7)


ASIDE = [math.cos(0.3), math.sin(0.3), 0.0, 0.0]


@pytest.mark.long
def test_a_cycle_is_found_from_a_pose():
    known = cycles(False).at(push=0.35)[0]["period"]
    assert mc.find_cycle(lively(True), {"push": 0.35}, state=ASIDE).period == pytest.approx(known, rel=1e-9)


@pytest.mark.slow
def test_a_cycle_is_found_from_the_end_of_a_history():
    known = cycles(False).at(push=0.35)[0]["period"]
    history = mc.simulate(lively(True), duration=10.0, start={"push": 0.35}, state=ASIDE)
    assert mc.find_cycle(lively(True), history).period == pytest.approx(known, rel=1e-9)


@pytest.mark.slow
def test_files_keep_poses_and_charts(tmp_path):
    loaded, curve = mc.load(cycles(True).save(tmp_path / "cycles.h5")), cycles(True)
    assert np.array_equal(loaded.states, curve.states)
    for one, other in zip(loaded.orbits[::5], curve.orbits[::5], strict=True):
        assert np.array_equal(one.states, other.states)
        assert np.array_equal(one.velocities, other.velocities)
    again = mc.load(tmp_path / "cycles.h5", problem=lively(True))
    assert again.at(push=0.35)[0]["period"] == pytest.approx(curve.at(push=0.35)[0]["period"], rel=1e-12)


@pytest.mark.slow
def test_a_motion_begins_on_an_orbit_and_stays_there():
    orbit = swung(True).orbit
    history = mc.simulate(orbit, duration=orbit.period, timestep=1e-4)
    assert history.states[-1] == pytest.approx(orbit.at(history["time"][-1])[:4], abs=1e-4)
    assert orbit.history().states.shape == (len(orbit.times), 4)


@pytest.mark.long
def test_motions_beside_confirm_the_stability_of_cones_and_of_tumbling():
    for curve in (coned(), tumbling()):
        assert mc.verify_stability(curve, n=2).certificate.holds


@pytest.mark.long
def test_a_nonlinear_mode_on_a_ball_joint_is_that_on_a_hinge(tmp_path):
    found = []
    for ball in (True, False):
        curve = mc.continue_modes(rod(ball, joint='stiffness="2"'), "energy", (1e-3, 3.0), chord=0.5)
        again = mc.load(curve.save(tmp_path / f"mode{ball}.h5"), problem=rod(ball, joint='stiffness="2"'))
        found.append(again.at(energy=2.0)[0])
    assert found[0]["period"] == pytest.approx(found[1]["period"], rel=1e-10)
    assert found[0]["tip[0].max"] == pytest.approx(found[1]["tip[0].max"], rel=1e-9)


# -- how far a rotation is told --------------------------------------------------------------------------------------


def torqued(ball, most, joint='damping="0.5"', **options):
    forcing = {"torque": mc.Harmonic(1.0)}
    return mc.continue_response(turned(ball, joint), "torque.amplitude", (1.0, most), forcing, frequency=0.16,
                                direction=1, chord=0.5, **options)


@pytest.mark.long
def test_an_orbit_that_comes_near_the_edge_of_its_chart_goes_on_in_another():
    aside = torqued(True, 5.3, state=[math.cos(0.5), math.sin(0.5), 0.0, 0.0])
    hinge = torqued(False, 5.3)
    charts = [o.chart.reference[0, 1] for o in aside.orbits]
    assert charts[0] == pytest.approx(math.sin(0.5))
    assert abs(charts[-1]) < 0.1
    turning = next(i for i, c in enumerate(charts) if c != charts[0])
    middle = aside["torque.amplitude"][turning - 1 : turning + 1].mean()
    for amplitude in (middle, 5.0):
        ((one,), (other,)) = (c.at(**{"torque.amplitude": amplitude}) for c in (aside, hinge))
        assert one["tip[1].rms"] == pytest.approx(other["tip[1].rms"], rel=1e-9)
        assert among(one.orbit.multipliers, other.orbit.multipliers, 1e-6)


@pytest.mark.long
def test_a_curve_ends_where_a_ball_joint_turns_by_almost_a_full_turn():
    curve = torqued(True, 40.0)
    assert curve.status == "corner"
    assert "hip turns by almost a full turn" in curve.ends[-1][1]


@pytest.mark.long
def test_a_curve_ends_where_the_spring_of_a_ball_joint_turns_over():
    curve = torqued(True, 40.0, 'stiffness="0.5" damping="0.5"')
    assert curve.status == "corner"
    assert "the spring of hip turns over" in curve.ends[-1][1]


@pytest.mark.slow
def test_a_weight_pushed_round_an_ellipse_comes_back_though_nothing_is_observed():
    """The motion is that of MuJoCo's accelerations: q' = q (0, w) / 2 with w in the body's own axes."""
    text = """<mujoco><worldbody><site name="w"/><body><joint type="ball" damping="0.1" stiffness="0.3"/>
      <geom type="sphere" size=".1" pos="0 0 -.8" mass="1.2"/><site name="s" pos="0 0 -.8"/></body></worldbody>
      <actuator><general name="x" site="s" refsite="w" gear="1 0 0 0 0 0"/>
      <general name="y" site="s" refsite="w" gear="0 1 0 0 0 0"/></actuator></mujoco>"""
    inputs = {"x": mc.Harmonic(0.6), "y": mc.Harmonic(0.4, phase=1.0)}
    response = mc.continue_response(mc.Mechanism.from_xml(text), "frequency", (0.5, 0.6), inputs, max_points=3)
    orbit, model = response[-1].orbit, mujoco.MjModel.from_xml_string(text)
    data, turn = mujoco.MjData(model), 2.0 * math.pi / orbit.period

    def rates(t, u):
        data.qpos[:], data.qvel[:] = u[:4] / np.linalg.norm(u[:4]), u[4:]
        data.ctrl[:] = 0.6 * math.cos(turn * t), 0.4 * math.cos(turn * t + 1.0)
        mujoco.mj_forward(model, data)
        spun = np.zeros(4)
        mujoco.mju_mulQuat(spun, data.qpos, np.append(0.0, u[4:]))
        return np.append(0.5 * spun, data.qacc)

    begin = np.append(orbit.states[0], orbit.velocities[0])
    run = solve_ivp(rates, (0.0, orbit.period), begin, method="DOP853", rtol=1e-11, atol=1e-13)
    assert run.y[:, -1] == pytest.approx(begin, abs=1e-9)
