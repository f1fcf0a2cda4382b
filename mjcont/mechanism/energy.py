"""Energy of a mechanism: gravity, the springs of joints and tendons, bushes, loads that have a potential, and motion.

A load has a potential where it acts along a coordinate of the mechanism: on a joint, or along a tendon. A force that
turns with a body (a follower force) has none; that is found out by comparing the energy's gradient with the forces.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import MjcontError
from mjcont.models.actuators import is_bush
from mjcont.numerics.equations.problem import Array, Values
from mjcont.results.quantities import Observable

_BESIDE = 1e-3
_STEP = 1e-6
_AGREES = 1e-5
_ROUNDING = 1e-8
_SAMPLES = 3


def _energy(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    return _sum(model, data, loads=False)


def _energy_with_loads(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    return _sum(model, data, loads=True)


def _energy_in_motion(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    mujoco.mj_energyVel(model, data)
    return _energy_with_loads(model, data) + float(data.energy[1])


def _sum(model: mujoco.MjModel, data: mujoco.MjData, *, loads: bool) -> float:
    mujoco.mj_energyPos(model, data)
    total = float(data.energy[0])
    for i in range(model.nactuator):
        if loads or is_bush(model, i):
            total -= _work(model, data, i)
    return total


def _work(model: mujoco.MjModel, data: mujoco.MjData, i: int) -> float:
    """Return the integral over its length of an actuator's force at rest; NaN where that is no simple function."""
    bias = mujoco.mjtBias(int(model.actuator_biastype[i]))
    plain = model.actuator_gaintype[i] == mujoco.mjtGain.mjGAIN_FIXED
    if not plain or bias not in (mujoco.mjtBias.mjBIAS_NONE, mujoco.mjtBias.mjBIAS_AFFINE):
        return math.nan
    constant, slope = (0.0, 0.0) if bias == mujoco.mjtBias.mjBIAS_NONE else model.actuator_biasprm[i, :2]
    constant = constant + model.actuator_gainprm[i, 0] * _command(model, data, i)
    length = data.actuator_length[i]
    return float(constant * length + 0.5 * slope * length**2)


def _command(model: mujoco.MjModel, data: mujoco.MjData, i: int) -> float:
    """Return what an actuator's gain multiplies: its activation, or its control; NaN where it has several."""
    if model.actuator_actnum[i]:
        return float(data.act[model.actuator_actadr[i]]) if model.actuator_actnum[i] == 1 else math.nan
    return float(data.ctrl[model.actuator_ctrladr[i]]) if model.actuator_ctrlnum[i] == 1 else math.nan


def potential_energy(problem: Any, states: Array, values: Values, *, loads: bool = False) -> Array:
    """Return the potential energy at states (m, nq), in J; NaN for a problem that is no mechanism.

    `loads` counts the potential of the controls' forces, too, as if each acted along its actuator's length.
    """
    if not hasattr(problem, "simulation_model"):
        return np.full(len(states), math.nan)
    return _read(problem, _energy_with_loads if loads else _energy, states, values)


def energy_in_motion(mechanism: Any, states: Array, speeds: Array, values: Values) -> Array:
    """Return the energy of motion and position, loads included, at states (m, nq) and velocities (m, nv), in J."""
    return _read(mechanism, _energy_in_motion, states, values, speeds)


def _read(
    problem: Any, function: Callable[[Any, Any], float], states: Array, values: Values, speeds: Array | None = None
) -> Array:
    reader = copy.copy(problem)
    reader.observables = {"energy": Observable("energy", "J", function)}
    found: Array = reader.measure(states, values, None, speeds)[:, 0]
    return found


def without_potential(problem: Any, x: Array, values: Values) -> str:
    """Return why the forces near a state have no potential that is known here, a sentence; empty if they have.

    The gradient of the energy is compared with the forces beside the state, where no stop carries load.
    """
    if not hasattr(problem, "simulation_model"):
        return "a vector field has no potential energy"
    loaded = "a stop or a contact carries load there, whose energy is not counted"
    if problem.active(x, values):
        return loaded
    compared = False
    for k in range(_SAMPLES):
        beside = problem.retract(x, _BESIDE * problem.state_scale * np.cos(1.0 + k + np.arange(problem.n)))
        if problem.active(beside, values):
            continue
        f = problem.residual(beside, values)
        steps = np.concatenate([sign * _STEP * np.diag(problem.state_scale) for sign in (1.0, -1.0)])
        energies = potential_energy(problem, np.array([problem.retract(beside, s) for s in steps]), values, loads=True)
        work = (energies[: problem.n] - energies[problem.n :]) / (2.0 * _STEP)
        scaled = f * problem.state_scale
        floor = _ROUNDING * float(np.max(np.abs(energies)))
        if not np.max(np.abs(work + scaled)) <= _AGREES * np.max(np.abs(scaled)) + floor:
            return "its loads have no potential: a force that follows the motion, or depends on it, is among them"
        compared = True
    return "" if compared else loaded


def total_energy(problem: Any, states: Array, values: Values) -> Array:
    """Return the potential energy with that of the loads at equilibria (m, nq), in J.

    Raises
    ------
    MjcontError
        If the loads have no potential.
    """
    for x in states:
        reason = without_potential(problem, x, values)
        if reason:
            raise MjcontError(f"{problem.name}: energy barriers are not defined here: {reason}")
    return potential_energy(problem, states, values, loads=True)
