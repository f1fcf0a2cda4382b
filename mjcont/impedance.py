"""MuJoCo's constraint parameters solref and solimp as numbers: reference stiffness k and impedance d.

Formulae of the chapter "Modeling" of MuJoCo's manual, section "Solver parameters".
"""

from __future__ import annotations

import mujoco
import numpy as np

_LEAST, _MOST = mujoco.mjMINIMP, mujoco.mjMAXIMP


def reference_stiffness(model: mujoco.MjModel, solref: np.ndarray, solimp: np.ndarray) -> float:
    """Return k of the reference acceleration -b v - k d r, in 1/s^2; a time constant is clamped as MuJoCo does."""
    first, second = solref
    d_w = float(np.clip(solimp[1], _LEAST, _MOST))
    if first <= 0:
        return float(-first) / d_w**2
    if not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_REFSAFE:
        first = max(first, 2.0 * model.opt.timestep)
    return 1.0 / (d_w * first * second) ** 2


def impedance(solimp: np.ndarray, opening: float) -> float:
    """Return the impedance d for a position error (modeling chapter of MuJoCo's manual)."""
    d_0, d_w = np.clip(solimp[:2], _LEAST, _MOST)
    width, middle, power = max(float(solimp[2]), 0.0), np.clip(solimp[3], _LEAST, _MOST), solimp[4]
    if d_0 == d_w or width <= mujoco.mjMINVAL:
        return float(0.5 * (d_0 + d_w))
    x = min(abs(opening) / width, 1.0)
    power = max(1.0, power)
    if power == 1.0 or x in (0.0, 1.0):
        y = x
    elif x <= middle:
        y = middle * (x / middle) ** power
    else:
        y = 1.0 - (1.0 - middle) * ((1.0 - x) / (1.0 - middle)) ** power
    return float(d_0 + y * (d_w - d_0))
