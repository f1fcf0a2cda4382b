"""What resists a model's motion, by name."""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.models.actuators import actuator_name
from mjcont.models.states import element_name

_OBJ = mujoco.mjtObj
_SHOWN = 6


def resistances(model: mujoco.MjModel) -> list[str]:
    """Return what takes energy from a model's motion, a phrase each."""
    m = model
    on_joints = (m.dof_damping != 0.0) | (m.dof_dampingpoly != 0.0).any(axis=1)
    joints = [element_name(m, _OBJ.mjOBJ_JOINT, int(j)) for j in np.unique(m.dof_jntid[on_joints])]
    on_tendons = (m.tendon_damping != 0.0) | (m.tendon_dampingpoly != 0.0).any(axis=1)
    tendons = [element_name(m, _OBJ.mjOBJ_TENDON, int(t)) for t in np.flatnonzero(on_tendons)]
    actuators = [actuator_name(m, a) for a in range(m.nactuator) if _resists(m, a)]
    named = (("joint", joints), ("tendon", tendons), ("actuator", actuators))
    found = [_phrase(kind, names) for kind, names in named if names]
    if m.opt.density or m.opt.viscosity:
        found.append("the resistance of the medium")
    return found


def _resists(model: mujoco.MjModel, actuator: int) -> bool:
    """Whether an actuator's force depends on its velocity."""
    affine = model.actuator_biastype[actuator] == int(mujoco.mjtBias.mjBIAS_AFFINE)
    gains = model.actuator_gaintype[actuator] == int(mujoco.mjtGain.mjGAIN_AFFINE)
    return bool(
        model.actuator_damping[actuator]
        or model.actuator_dampingpoly[actuator].any()
        or (affine and model.actuator_biasprm[actuator, 2])
        or (gains and model.actuator_gainprm[actuator, 2])
    )


def _phrase(kind: str, names: list[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"the damping of {kind}{'s' if len(names) > 1 else ''} {', '.join(names[:_SHOWN])}{more}"
