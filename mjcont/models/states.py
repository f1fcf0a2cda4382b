"""The states of a model: names and units of their entries, typical sizes, keyframes."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from mjcont.results.quantities import finite_array

_JOINT = mujoco.mjtJoint


def model_name(model: mujoco.MjModel) -> str:
    """Return the name in the MJCF's root element."""
    return bytes(model.names[: model.names.index(b"\0")]).decode() or "model"


def coordinates_are_flat(model: mujoco.MjModel) -> bool:
    """Whether qpos is a vector space: slides and hinges only."""
    return bool(np.all(np.isin(model.jnt_type, [_JOINT.mjJNT_SLIDE, _JOINT.mjJNT_HINGE])))


def state_scale(model: mujoco.MjModel) -> np.ndarray:
    """Return the typical size of each tangent coordinate: 1 rad, or the model's size in metres, (nv,)."""
    size = float(model.stat.extent)
    if not math.isfinite(size) or size <= 0:
        size = 1.0
    scale = np.ones(model.nv)
    for j in range(model.njnt):
        start = model.jnt_dofadr[j]
        if model.jnt_type[j] == _JOINT.mjJNT_SLIDE:
            scale[start] = size
        elif model.jnt_type[j] == _JOINT.mjJNT_FREE:
            scale[start : start + 3] = size
    return scale


def keyframes(model: mujoco.MjModel) -> dict[str, np.ndarray]:
    """Return the positions of the model's keyframes by name."""
    names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_KEY, k) or f"key{k}" for k in range(model.nkey)]
    return {name: model.key_qpos[k].copy() for k, name in enumerate(names)}


def checked_state(model: mujoco.MjModel, state: Any) -> np.ndarray:
    """Return a state that a user gives as an array, (nq,)."""
    labels = [name for name, _ in state_labels(model)]
    return finite_array("state", state, (model.nq,), labels=labels, owner=f"for model '{model_name(model)}'")


def state_labels(model: mujoco.MjModel) -> list[tuple[str, str]]:
    """Return name and unit of each entry of qpos."""
    parts = {
        _JOINT.mjJNT_SLIDE: [("", "m")],
        _JOINT.mjJNT_HINGE: [("", "rad")],
        _JOINT.mjJNT_BALL: [(f".q{i}", "") for i in range(4)],
        _JOINT.mjJNT_FREE: [(f".{c}", "m") for c in "xyz"] + [(f".q{i}", "") for i in range(4)],
    }
    labels = []
    for j in range(model.njnt):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, j) or f"joint{j}"
        labels += [(name + suffix, unit) for suffix, unit in parts[_JOINT(model.jnt_type[j])]]
    return labels


def coordinate_labels(model: mujoco.MjModel) -> list[tuple[str, str]]:
    """Return name and unit of each tangent coordinate, (nv,): where qpos has a quaternion, rotations about x, y, z."""
    turns = [(f".r{c}", "rad") for c in "xyz"]
    parts = {
        _JOINT.mjJNT_SLIDE: [("", "m")],
        _JOINT.mjJNT_HINGE: [("", "rad")],
        _JOINT.mjJNT_BALL: turns,
        _JOINT.mjJNT_FREE: [(f".{c}", "m") for c in "xyz"] + turns,
    }
    names = [element_name(model, mujoco.mjtObj.mjOBJ_JOINT, j) for j in range(model.njnt)]
    return [(n + s, u) for n, kind in zip(names, model.jnt_type, strict=True) for s, u in parts[_JOINT(kind)]]


def field_array(model: mujoco.MjModel, field: str) -> np.ndarray:
    """Return a model's (or its options') field by name."""
    owner = model.opt if field.startswith("opt.") else model
    return np.asarray(getattr(owner, field.removeprefix("opt.")))


def element_name(model: mujoco.MjModel, kind: mujoco.mjtObj, index: int) -> str:
    """Return an element's name, made up if it has none."""
    return mujoco.mj_id2name(model, kind, index) or f"{kind.name.removeprefix('mjOBJ_').lower()}{index}"
