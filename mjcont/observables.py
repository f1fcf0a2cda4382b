"""Observables: named scalars read from a model at rest - its sensors, its joint positions, and Python functions.

Sensor cut-off, noise and delay are ignored: the raw value is read from a copy of the model without them.
"""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np

from mjcont.errors import unknown_name
from mjcont.parameters import declarations
from mjcont.quantities import Observable

_SENSOR = mujoco.mjtSensor
_UNITS = {
    _SENSOR.mjSENS_FRAMEPOS: "m",
    _SENSOR.mjSENS_SUBTREECOM: "m",
    _SENSOR.mjSENS_RANGEFINDER: "m",
    _SENSOR.mjSENS_GEOMDIST: "m",
    _SENSOR.mjSENS_FORCE: "N",
    _SENSOR.mjSENS_TOUCH: "N",
    _SENSOR.mjSENS_TORQUE: "N*m",
    _SENSOR.mjSENS_E_POTENTIAL: "J",
    _SENSOR.mjSENS_E_KINETIC: "J",
}


def _entry(name: str, unit: str, field: str, index: int, of: str) -> Observable:
    """Return the observable that is an entry of a field of MuJoCo's data."""
    return Observable(name, unit, lambda model, data: float(getattr(data, field)[index]), (field, index), of)


def joint_unit(model: mujoco.MjModel, joint: int) -> str:
    """Return m for a slide, rad for a hinge."""
    return "m" if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE else "rad"


def _tendon_unit(model: mujoco.MjModel, tendon: int) -> str:
    """Return rad for a fixed tendon over hinges only, else m."""
    first = model.tendon_adr[tendon]
    wraps = range(first, first + model.tendon_num[tendon])
    kinds = {mujoco.mjtWrap(model.wrap_type[w]) for w in wraps}
    if kinds == {mujoco.mjtWrap.mjWRAP_JOINT} and all(joint_unit(model, model.wrap_objid[w]) == "rad" for w in wraps):
        return "rad"
    return "m"


def _force_unit(model: mujoco.MjModel, actuator: int) -> str:
    target = model.actuator_trnid[actuator, 0]
    joints = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
    if mujoco.mjtTrn(model.actuator_trntype[actuator]) in joints:
        return "N" if joint_unit(model, target) == "m" else "N*m"
    return "N" if model.actuator_gear[actuator, :3].any() else "N*m"


def sensor_unit(model: mujoco.MjModel, sensor: int) -> str:
    """Return the SI unit of a sensor by its type; empty where MuJoCo defines none."""
    kind, obj = _SENSOR(model.sensor_type[sensor]), model.sensor_objid[sensor]
    if kind in (_SENSOR.mjSENS_JOINTPOS, _SENSOR.mjSENS_JOINTLIMITPOS):
        return joint_unit(model, obj)
    if kind in (_SENSOR.mjSENS_TENDONPOS, _SENSOR.mjSENS_TENDONLIMITPOS):
        return _tendon_unit(model, obj)
    if kind == _SENSOR.mjSENS_ACTUATORFRC:
        return _force_unit(model, obj)
    if kind == _SENSOR.mjSENS_JOINTACTFRC:
        return "N" if joint_unit(model, obj) == "m" else "N*m"
    return _UNITS.get(kind, "")


def model_observables(model: mujoco.MjModel) -> dict[str, Observable]:
    """Return declared names first, then sensors, then joint positions (a sensor of the same name comes first)."""
    found: dict[str, Observable] = {}
    for s in range(model.nsensor):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_SENSOR, s) or f"sensor{s}"
        unit, start, size = sensor_unit(model, s), int(model.sensor_adr[s]), int(model.sensor_dim[s])
        for k in range(size):
            label = name if size == 1 else f"{name}[{k}]"
            found[label] = _entry(label, unit, "sensordata", start + k, "sensor")
    aliases: dict[str, Observable] = {}
    for declaration in declarations(model):
        source = declaration.paths[0]
        if source.startswith("sensor:"):
            sensor = source.removeprefix("sensor:")
            if sensor not in found:
                raise unknown_name("sensor", sensor, found)
            unit = declaration.unit or found[sensor].unit
            aliases[declaration.name] = replace(found[sensor], name=declaration.name, unit=unit)
    found = aliases | found
    for j in range(model.njnt):
        if mujoco.mjtJoint(model.jnt_type[j]) in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
            name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, j) or f"joint{j}"
            if name not in found:
                found[name] = _entry(name, joint_unit(model, j), "qpos", int(model.jnt_qposadr[j]), "joint")
    return found


def without_sensor_filters(model: mujoco.MjModel) -> None:
    """Remove cut-off, noise and delay from a model of our own."""
    for field in ("sensor_cutoff", "sensor_noise", "sensor_delay"):
        if hasattr(model, field):
            np.asarray(getattr(model, field))[...] = 0.0
