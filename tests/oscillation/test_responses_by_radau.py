"""Forced responses against SciPy's Radau on MuJoCo's own accelerations, which know nothing of meshes."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import mjcont as mc

GEAR = {"F_ret": 4e5, "k_j": 1e5}
# what moves, about which mean, and over which frequencies in Hz; how many responses of each are compared
SHAKEN = {
    "overcentre, soft pins": ("overcentre", {"F": 5.0}, {"F": 30.0, "k_j": 1e3}, None, (0.2, 1.0), 20),
    "overcentre, large": ("overcentre", {"F": 12.0}, {"F": 36.0, "k_j": 1e3}, None, (0.1, 0.6), 24),
    "overcentre, stiff pins": ("overcentre", {"F": 5.0}, {"F": 30.0, "k_j": 1e6, "c_j": 100.0}, None, (1.0, 1.4), 4),
    "nose gear, unlock force": ("nose_gear", {"F_ul": 100.0}, GEAR, "uplock_below", (1.0, 3.0), 16),
    "nose gear, gusts": ("nose_gear", {"load_factor": 0.2}, GEAR, "uplock_below", (2.0, 4.0), 8),
    "truss": ("von_mises_truss", {"P": 20.0}, {"P": 50.0}, "unloaded", (0.5, 3.0), 28),
}


def response(name):
    model, forcing, start, keyframe, bounds, _ = SHAKEN[name]
    harmonics = {n: mc.Harmonic(a, phase=0.3) for n, a in forcing.items()}
    return mc.continue_response(
        mc.Mechanism.from_xml(model), "frequency", bounds, harmonics, start, frequency=bounds[0], keyframe=keyframe
    )


def apart(mechanism, orbit):
    """Return the largest distance between an orbit and Radau's motion from its start, relative to the excursion."""
    model, n, period, values = mechanism.simulation_model(), mechanism.n, orbit.period, dict(orbit.parameters)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4  # "discrete" would make qacc the step of an implicit map
    driven = {k.removesuffix(".amplitude"): (a, values[f"{k.removesuffix('.amplitude')}.phase"])
              for k, a in values.items() if k.endswith(".amplitude")}
    own, writer = {k: v for k, v in values.items() if k in mechanism.parameters}, mechanism.writer(model)
    own, writer = {k: v for k, v in values.items() if k in mechanism.parameters}, mechanism.writer(model)
    data = mujoco.MjData(model)

    def field(t, u):
        now = {k: own[k] + a * np.cos(2.0 * np.pi * t / period + phase) for k, (a, phase) in driven.items()}
        writer.write(mechanism.parameters, {**own, **now})
        data.qpos, data.qvel, data.ctrl = u[:n], u[n:], writer.inputs.ctrl
        mujoco.mj_forward(model, data)
        return np.concatenate([data.qvel, data.qacc])

    times, begin, sizes = np.linspace(0.0, period, 33), orbit.at(0.0), np.ptp(orbit.path.s, axis=0)
    fine = {"rtol": 1e-10, "atol": 1e-10 * np.maximum(sizes, 1e-6 * sizes.max())}
    run = solve_ivp(field, (0.0, period), begin, method="Radau", t_eval=times, **fine)
    assert run.success
    away = run.y[:n].T - np.array([orbit.at(t)[:n] for t in times])
    return float(np.abs(away).max() / sizes[:n].max())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["overcentre, soft pins", "nose gear, unlock force", "truss"])
def test_a_response_is_the_motion_that_radau_computes(name):
    curve = response(name)
    assert apart(curve.model, curve.orbits[-1]) < 1e-6


@pytest.mark.long
@pytest.mark.parametrize("name", SHAKEN)
def test_a_hundred_responses_are(name):
    curve, count = response(name), SHAKEN[name][-1]
    chosen = np.unique(np.linspace(0, len(curve) - 1, count).astype(int))
    assert len(chosen) == count
    assert max(apart(curve.model, curve.orbits[i]) for i in chosen) < 1e-6


def test_they_are_a_hundred_of_three_mechanisms():
    assert sum(count for *_, count in SHAKEN.values()) >= 100
    assert len({model for model, *_ in SHAKEN.values()}) == 3
