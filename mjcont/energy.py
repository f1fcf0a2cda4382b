"""Potential energy of a mechanism at rest: gravity, the springs of joints and tendons, and the bushes.

Controls are left out: a retraction force may follow the motion, and then has no potential.
"""

from __future__ import annotations

import copy
import math
from typing import Any

import mujoco
import numpy as np

from mjcont.numerics.problem import Array, Values
from mjcont.paths import is_bush
from mjcont.quantities import Observable


def _energy(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    mujoco.mj_energyPos(model, data)
    total = float(data.energy[0])
    for i in range(model.nactuator):
        if is_bush(model, i):
            if model.actuator_biastype[i] != mujoco.mjtBias.mjBIAS_AFFINE:
                return math.nan
            constant, slope = model.actuator_biasprm[i, :2]
            length = data.actuator_length[i]
            total -= float(constant * length + 0.5 * slope * length**2)
    return total


def potential_energy(problem: Any, states: Array, values: Values) -> Array:
    """Return the potential energy at states (m, nq), in J; NaN for a problem that is no mechanism."""
    if not hasattr(problem, "simulation_model"):
        return np.full(len(states), math.nan)
    reader = copy.copy(problem)
    reader.observables = {"energy": Observable("energy", "J", _energy)}
    return reader.measure(states, values)[:, 0]
