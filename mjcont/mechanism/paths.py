"""Paths to the fields of a MuJoCo model, as parameters name them.

Their grammar is object:pattern.attribute[index]*factor+offset,

with `object` one of joint, body, site, geom, tendon, actuator, equality, mocap, option, control. What has no name
in the model is called by its place: joint0, tendon1, ... `equality:NAME.stiffness` is no field but the effective
stiffness of a constraint (see `models.equalities`). Paths that begin with `spec:` are read by `specpaths`.
"""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.errors import ParameterError, unknown_name
from mjcont.mechanism.inputs import INPUT_FIELDS, loaded_inputs
from mjcont.models.actuators import actuator_name, integrator, is_bush
from mjcont.models.equalities import stiffness_targets
from mjcont.models.states import field_array
from mjcont.results.quantities import Target

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_PATH = re.compile(
    r"(?P<object>\w+):(?P<pattern>[^.\[\]]+?)(?:\.(?P<attr>\w+))?(?:\[(?P<index>\d+)\])?"
    rf"(?:\*(?P<factor>{_NUMBER}))?(?P<offset>\+{_NUMBER}|-{_NUMBER})?"
)
_OBJECTS = {
    "joint": ("jnt_", mujoco.mjtObj.mjOBJ_JOINT, "njnt"),
    "body": ("body_", mujoco.mjtObj.mjOBJ_BODY, "nbody"),
    "site": ("site_", mujoco.mjtObj.mjOBJ_SITE, "nsite"),
    "geom": ("geom_", mujoco.mjtObj.mjOBJ_GEOM, "ngeom"),
    "tendon": ("tendon_", mujoco.mjtObj.mjOBJ_TENDON, "ntendon"),
    "actuator": ("actuator_", mujoco.mjtObj.mjOBJ_ACTUATOR, "nactuator"),
    "equality": ("eq_", mujoco.mjtObj.mjOBJ_EQUALITY, "neq"),
    "mocap": ("mocap_", mujoco.mjtObj.mjOBJ_BODY, "nbody"),
}
_PER_DOF = {"damping", "armature", "frictionloss"}
_RENAMED = {
    ("tendon", "springlength"): "tendon_lengthspring",
    ("joint", "springref"): "qpos_spring",
}
_MOCAP_WIDTH = {"pos": 3, "quat": 4}
_DERIVED_CONSTANTS = frozenset(mujoco.MjModel._setconst_inputs)


def controls(model: mujoco.MjModel) -> dict[str, tuple[str, int]]:
    """Return what a user can command by name: controls, and the integrated setpoint where a control is integrated."""
    found: dict[str, tuple[str, int]] = {}
    for i in range(model.nactuator):
        name, first = actuator_name(model, i), int(model.actuator_ctrladr[i])
        if is_bush(model, i):
            continue
        if integrator(model, i):
            found[name] = ("act", int(model.actuator_actadr[i]))
        elif model.actuator_ctrlnum[i] == 1:
            found[name] = ("ctrl", first)
        else:
            for k in range(model.actuator_ctrlnum[i]):
                found[f"{name}.{mujoco.mj_actuatorInputName(model, i, k)}"] = ("ctrl", first + k)
    return found


def element_names(model: mujoco.MjModel, kind: str) -> list[str]:
    """Return the names of all joints, bodies, ... of the model (empty string where unnamed)."""
    _, obj, count = _OBJECTS[kind]
    return [mujoco.mj_id2name(model, obj, i) or "" for i in range(getattr(model, count))]


def _field_entries(model: mujoco.MjModel, kind: str, attr: str, ids: Sequence[int]) -> tuple[str, np.ndarray]:
    """Return the field's name and the flat indices of the elements' entries, shape (n elements, width)."""
    prefix, _, _ = _OBJECTS[kind]
    field = _RENAMED.get((kind, attr), prefix + attr)
    if kind == "joint" and attr in _PER_DOF:
        field = "dof_" + attr
    array = getattr(model, field, None)
    if not _is_continuous(array):
        starts = (prefix, "dof_") if kind == "joint" else (prefix,)
        fields = [f for f in dir(model) if f.startswith(starts) and _is_continuous(getattr(model, f))]
        valid = {f.split("_", 1)[1] for f in fields} | {a for k, a in _RENAMED if k == kind}
        valid |= {"stiffness"} if kind == "equality" else set()
        raise unknown_name(f"attribute of a {kind}", attr, valid)
    assert array is not None
    if field.startswith("dof_"):
        rows = [[d for d in range(model.nv) if model.dof_jntid[d] == j] for j in ids]
        return field, np.array([i for row in rows for i in row], dtype=int).reshape(-1, 1)
    if field == "qpos_spring":
        return field, np.array([model.jnt_qposadr[j] for j in ids], dtype=int).reshape(-1, 1)
    width = array.size // array.shape[0]
    return field, np.array([np.arange(i * width, (i + 1) * width) for i in ids], dtype=int)


def _input_entries(
    model: mujoco.MjModel, kind: str, attr: str, ids: Sequence[int]
) -> tuple[str, np.ndarray] | None:
    """Return what `_field_entries` does for inputs that live in MuJoCo's data, None for fields of the model."""
    if kind == "equality" and attr == "active":
        return "eq_active", np.array(ids, dtype=int).reshape(-1, 1)
    if kind == "mocap":
        if attr not in _MOCAP_WIDTH:
            raise unknown_name("attribute of a mocap body", attr, _MOCAP_WIDTH)
        width = _MOCAP_WIDTH[attr]
        rows = [np.arange(width) + width * model.body_mocapid[i] for i in ids]
        return f"mocap_{attr}", np.array(rows, dtype=int)
    if kind == "body" and attr in _MOCAP_WIDTH and any(model.body_mocapid[i] >= 0 for i in ids):
        names = [n for i, n in enumerate(element_names(model, "body")) if i in ids and model.body_mocapid[i] >= 0]
        raise ParameterError(f"the {attr} of mocap body '{names[0]}' lives elsewhere: use mocap:{names[0]}.{attr}")
    return None


def _commands(model: mujoco.MjModel, pattern: str, factor: float, offset: float, path: str) -> list[Target]:
    known = controls(model)
    names = [n for n in known if fnmatch.fnmatchcase(n, pattern)]
    if not names:
        raise unknown_name("control", pattern, known)
    by_field: dict[str, list[int]] = {}
    for name in names:
        field, index = known[name]
        by_field.setdefault(field, []).append(index)
    return [Target(field, tuple(index), factor, offset, path) for field, index in by_field.items()]


@dataclass(frozen=True, slots=True)
class PathParts:
    """What a path says, before it is looked up in a model."""

    kind: str
    pattern: str
    attr: str | None
    index: int | None
    factor: float
    offset: float


def split_path(path: str, shown: str | None = None) -> PathParts:
    """Read a path; an error shows it as `shown`."""
    shown = shown or path
    match = _PATH.fullmatch(path)
    if match is None:
        raise ParameterError(f"cannot read target '{shown}': expected object:name.attribute[index]*factor+offset")
    factor, offset = float(match["factor"] or 1.0), float(match["offset"] or 0.0)
    if factor == 0.0:
        raise ParameterError(f"target '{shown}': the factor must not be zero")
    index = None if match["index"] is None else int(match["index"])
    return PathParts(match["object"], match["pattern"], match["attr"], index, factor, offset)


def resolve_path(model: mujoco.MjModel, path: str) -> list[Target]:
    """Turn a path into targets of this model.

    Raises
    ------
    ParameterError
        If the path does not parse, or matches nothing in the model.
    NameLookupError
        If the object kind or attribute does not exist; the message lists the valid ones.
    """
    parts = split_path(path)
    kind, pattern, attr, factor, offset = parts.kind, parts.pattern, parts.attr, parts.factor, parts.offset
    if kind == "control":
        return _commands(model, pattern + (f".{attr}" if attr else ""), factor, offset, path)
    if kind == "option":
        return [Target("opt." + pattern, _option_index(model, pattern, parts.index), factor, offset, path)]
    if kind not in _OBJECTS:
        raise unknown_name("object in a target path", kind, [*_OBJECTS, "option", "control"])
    if attr is None:
        raise ParameterError(f"target '{path}': an attribute is missing, as in {kind}:{pattern}.stiffness")
    names = [n or f"{kind}{i}" for i, n in enumerate(element_names(model, kind))]
    ids = [i for i, n in enumerate(names) if fnmatch.fnmatchcase(n, pattern)]
    if kind == "mocap":
        ids = [i for i in ids if model.body_mocapid[i] >= 0]
        names = [n for i, n in enumerate(names) if model.body_mocapid[i] >= 0]
    if not ids:
        listing = ", ".join(names) or "none"
        raise ParameterError(f"target '{path}' matches no {kind} of the model. Its {kind} names: {listing}.")
    if (kind, attr) == ("equality", "stiffness"):
        if parts.index is not None:
            raise ParameterError(f"target '{path}': equality:NAME.stiffness has no index")
        return stiffness_targets(model, ids, factor, offset, path)
    field, entries = _input_entries(model, kind, attr, ids) or _field_entries(model, kind, attr, ids)
    index = parts.index
    if index is not None:
        if index >= entries.shape[1]:
            raise ParameterError(f"target '{path}': index {index} is outside 0..{entries.shape[1] - 1}")
        entries = entries[:, index : index + 1]
    return [Target(field, tuple(int(i) for i in entries.ravel()), factor, offset, path, field in _DERIVED_CONSTANTS)]


def _is_continuous(field: object) -> bool:
    return isinstance(field, float) or (isinstance(field, np.ndarray) and field.dtype.kind == "f")


def _option_index(model: mujoco.MjModel, attr: str, index: int | None) -> tuple[int, ...]:
    if not _is_continuous(getattr(model.opt, attr, None)):
        names = [a for a in dir(model.opt) if not a.startswith("_")]
        raise unknown_name("option", attr, [a for a in names if _is_continuous(getattr(model.opt, a))])
    size = np.size(getattr(model.opt, attr))
    if index is None:
        return tuple(range(size))
    if index >= size:
        raise ParameterError(f"target 'option:{attr}[{index}]': index {index} is outside 0..{size - 1}")
    return (index,)


def read_target(model: mujoco.MjModel, target: Target) -> np.ndarray:
    """Return the parameter values that the target's entries imply, (len(index),)."""
    if target.loaded is not None:
        return np.full(len(target.index), (target.loaded - target.offset) / target.factor)
    owned = target.field in INPUT_FIELDS
    array = np.ravel(loaded_inputs(model)[target.field] if owned else field_array(model, target.field))
    return (array[list(target.index)] - target.offset) / target.factor
