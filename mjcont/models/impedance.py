"""MuJoCo's constraint parameters solref and solimp as numbers: reference constants k and b, and the impedance d.

Formulae of the chapter "Modeling" of MuJoCo's manual, section "Solver parameters".
"""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

_LEAST, _MOST = mujoco.mjMINIMP, mujoco.mjMAXIMP
_DEFAULT_SOLREF = (0.02, 1.0)


def standard_form(solref: Sequence[float]) -> tuple[float, float, bool]:
    """Return solref as MuJoCo reads it, and true if it is time constant and damping ratio, not the direct form."""
    first, second = float(solref[0]), float(solref[1])
    if (first > 0) != (second > 0):  # mixed signs: MuJoCo warns and takes its default
        first, second = _DEFAULT_SOLREF
    return first, second, first > 0


def least_time_constant(model: mujoco.MjModel) -> float:
    """Return the time constant below which MuJoCo clamps that of an equality: two timesteps, or 0 for no clamp."""
    safe = not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_REFSAFE
    clamps = safe and model.opt.integrator != mujoco.mjtIntegrator.mjINT_DISCRETE
    return 2.0 * float(model.opt.timestep) if clamps else 0.0


def reference_constants(model: mujoco.MjModel, solref: Sequence[float], solimp: Sequence[float]) -> tuple[float, float]:
    """Return k in 1/s^2 and b in 1/s of an equality's reference acceleration -b v - k d r."""
    first, second, standard = standard_form(solref)
    d_w = float(np.clip(solimp[1], _LEAST, _MOST))
    if not standard:
        return -first / d_w**2, -second / d_w
    first = max(first, least_time_constant(model))
    return 1.0 / (d_w * first * second) ** 2, 2.0 / (d_w * first)


def impedance(solimp: Sequence[float], opening: float) -> float:
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


def is_constant(solimp: Sequence[float]) -> bool:
    """Return whether the impedance is the same at every position error."""
    return impedance(solimp, 0.0) == impedance(solimp, np.inf)
