"""What an actuator is to an equilibrium: a bush, a follower of its control, an integrator; its name and unit."""

from __future__ import annotations

import mujoco
import numpy as np

_DYN = mujoco.mjtDyn
_JOINTS = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
_TURNING = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_BALL))
_FOLLOWS = (_DYN.mjDYN_FILTER, _DYN.mjDYN_FILTEREXACT, _DYN.mjDYN_MUSCLE)


def follower(model: mujoco.MjModel, actuator: int) -> bool:
    """Whether the actuator's activation comes to rest at its control."""
    return bool(model.actuator_actnum[actuator] == 1 and _DYN(model.actuator_dyntype[actuator]) in _FOLLOWS)


def integrator(model: mujoco.MjModel, actuator: int) -> bool:
    """Whether the actuator's activation is the integral of its control."""
    integrates = _DYN(model.actuator_dyntype[actuator]) == _DYN.mjDYN_INTEGRATOR
    return bool(model.actuator_actnum[actuator] == 1 and integrates)


def actuator_name(model: mujoco.MjModel, actuator: int) -> str:
    """Return an actuator's name, made up if it has none."""
    return mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_ACTUATOR, actuator) or f"actuator{actuator}"


def actuator_of(model: mujoco.MjModel, field: str, index: int) -> int:
    """Return the actuator that a control or an activation belongs to."""
    first = model.actuator_ctrladr if field == "ctrl" else model.actuator_actadr
    count = model.actuator_ctrlnum if field == "ctrl" else model.actuator_actnum
    return int(np.flatnonzero((first >= 0) & (first <= index) & (index < first + count))[0])


def setpoint_unit(model: mujoco.MjModel, actuator: int) -> str:
    """Return the unit of an integrated setpoint: that of the joint it positions, else none."""
    joint = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
    servo = model.actuator_gainprm[actuator, 0] == -model.actuator_biasprm[actuator, 1] != 0.0
    if not (servo and mujoco.mjtTrn(model.actuator_trntype[actuator]) in joint):
        return ""
    kind = mujoco.mjtJoint(model.jnt_type[model.actuator_trnid[actuator, 0]])
    return {mujoco.mjtJoint.mjJNT_SLIDE: "m", mujoco.mjtJoint.mjJNT_HINGE: "rad"}.get(kind, "")


def is_bush(model: mujoco.MjModel, actuator: int) -> bool:
    """Whether an actuator is a passive bush element: prefix `bush_` and no gain."""
    name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_ACTUATOR, actuator) or ""
    return name.startswith("bush_") and not model.actuator_gainprm[actuator].any()


def pin_slides(model: mujoco.MjModel) -> list[int]:
    """Return the freedoms of elastic pins: slides with stiffness, beside a joint that turns, that nothing drives."""
    driven = model.actuator_trnid[np.isin(model.actuator_trntype, _JOINTS), 0]
    turning = model.jnt_bodyid[np.isin(model.jnt_type, _TURNING)]
    slides = (model.jnt_type == int(mujoco.mjtJoint.mjJNT_SLIDE)) & (np.ravel(model.jnt_stiffness) > 0)
    pins = slides & np.isin(model.jnt_bodyid, turning) & ~np.isin(np.arange(model.njnt), driven)
    return [int(model.jnt_dofadr[j]) for j in np.flatnonzero(pins)]


def bush_names(model: mujoco.MjModel) -> list[str]:
    """Return the names of the bush actuators."""
    return [actuator_name(model, i) for i in range(model.nactuator) if is_bush(model, i)]
