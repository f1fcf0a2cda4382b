"""Named parameters of a MuJoCo model: how one scalar acts on the fields of an `MjModel`.

A parameter is a list of targets, each affine: field = offset + factor * value. Paths have the grammar

    object:pattern.attribute[index]*factor+offset

with `object` one of joint, body, site, geom, tendon, actuator, equality, option, control, sensor.
"""

from __future__ import annotations

import fnmatch
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from mjcont.errors import ParameterError, unknown_name

GRAVITY_ANGLE, LOAD_FACTOR = "gravity_angle", "load_factor"
DECLARATION_PREFIX = "mjcont/"
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
    "actuator": ("actuator_", mujoco.mjtObj.mjOBJ_ACTUATOR, "nu"),
    "equality": ("eq_", mujoco.mjtObj.mjOBJ_EQUALITY, "neq"),
}
_PER_DOF = {"damping", "armature", "frictionloss"}
_RENAMED = {
    ("tendon", "springlength"): "tendon_lengthspring",
    ("joint", "springref"): "qpos_spring",
}
# fields in which the forces are affine, so that two points give an exact derivative
_AFFINE = frozenset(
    {
        "ctrl",
        "jnt_stiffness",
        "dof_damping",
        "qpos_spring",
        "tendon_stiffness",
        "tendon_damping",
        "actuator_biasprm",
        "actuator_gainprm",
    }
)
_PRODUCTS = ({"jnt_stiffness", "qpos_spring"}, {"ctrl", "actuator_gainprm"})
_SETTINGS = frozenset({"gravity_axis"})
_DERIVED_CONSTANTS = frozenset(mujoco.MjModel._setconst_inputs)


@dataclass(frozen=True, slots=True)
class Target:
    """Entries `index` of the flattened model field `field`, set to offset + factor * value."""

    field: str
    index: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0
    path: str = ""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A named scalar that acts on the model.

    Attributes
    ----------
    name, unit : str
    value : float
        Its value in the loaded model (SI, radians).
    bounds : tuple of float
        Where the parameter makes sense; the default range of a continuation.
    kind : {"control", "gravity", "field"}
    targets : tuple of Target
        Empty for gravity_angle and load_factor, which act together on the gravity vector.
    hard_bounds : tuple of float
        A control's range in MuJoCo, outside which it would be clamped.
    """

    name: str
    unit: str
    value: float
    bounds: tuple[float, float]
    kind: str
    targets: tuple[Target, ...] = ()
    hard_bounds: tuple[float, float] = (-math.inf, math.inf)

    @property
    def affine(self) -> bool:
        """Whether the generalised forces are affine in the parameter."""
        fields = {t.field for t in self.targets}
        return bool(fields) and fields <= _AFFINE and not any(pair <= fields for pair in _PRODUCTS)

    @property
    def entries(self) -> frozenset[tuple[str, int]]:
        """The entries of model fields on which it acts."""
        if self.kind == "gravity":
            return frozenset({("opt.gravity", i) for i in range(3)})
        found = {(t.field, i) for t in self.targets for i in t.index}
        scaled = {("body_inertia", 3 * i + k) for field, i in found if field == "body_mass" for k in range(3)}
        return frozenset(found | scaled)

    @property
    def needs_constants(self) -> bool:
        """Whether MuJoCo must recompute derived constants when the parameter changes."""
        return any(t.field in _DERIVED_CONSTANTS for t in self.targets)


@dataclass(frozen=True, slots=True)
class Declaration:
    """What a `mjcont/NAME` text says: unit, bounds and the paths of the targets."""

    name: str
    unit: str
    bounds: tuple[float, float] | None
    paths: tuple[str, ...]


def parse_declaration(name: str, text: str) -> Declaration:
    """Read `unit=N/m bounds=1,1e10 : path path ...`.

    Raises
    ------
    ParameterError
        If a key is unknown, bounds are not two increasing numbers, or no target is given.
    """
    head, colon, tail = text.partition(" : ")
    if not colon:
        raise ParameterError(f"parameter '{name}': expected 'unit=... bounds=lo,hi : targets', got '{text}'")
    unit, bounds = "", None
    for item in head.split():
        key, _, value = item.partition("=")
        if key == "unit":
            unit = value
        elif key == "bounds":
            try:
                low, high = (float(v) for v in value.split(","))
            except ValueError:
                low, high = 1.0, 0.0
            if not low < high:
                raise ParameterError(f"parameter '{name}': bounds must be 'low,high' with low < high, got '{value}'")
            bounds = (low, high)
        else:
            raise ParameterError(f"parameter '{name}': unknown key '{key}'. Valid: unit, bounds.")
    paths = tuple(tail.split())
    if not paths:
        raise ParameterError(f"parameter '{name}': no target after ':'")
    return Declaration(name, unit, bounds, paths)


def declarations(model: mujoco.MjModel) -> list[Declaration]:
    """Return the declarations in the model's custom texts, in their order."""
    found = []
    for i in range(model.ntext):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_TEXT, i) or ""
        if name.startswith(DECLARATION_PREFIX):
            start, size = model.text_adr[i], model.text_size[i]
            text = bytes(model.text_data[start : start + size]).rstrip(b"\0").decode()
            if name.removeprefix(DECLARATION_PREFIX) not in _SETTINGS:
                found.append(parse_declaration(name.removeprefix(DECLARATION_PREFIX), text))
    return found


def setting(model: mujoco.MjModel, name: str) -> str | None:
    """Return the text `mjcont/name` of the model, or None."""
    text_id = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, DECLARATION_PREFIX + name)
    if text_id < 0:
        return None
    start, size = model.text_adr[text_id], model.text_size[text_id]
    return bytes(model.text_data[start : start + size]).rstrip(b"\0").decode()


def is_bush(model: mujoco.MjModel, actuator: int) -> bool:
    """Whether an actuator is a passive bush element: prefix `bush_` and no gain."""
    name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_ACTUATOR, actuator) or ""
    return name.startswith("bush_") and not model.actuator_gainprm[actuator].any()


def controls(model: mujoco.MjModel) -> dict[str, int]:
    """Return the names of the actuators that a user can command, with their control index."""
    found = {}
    for i in range(model.nu):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_ACTUATOR, i) or f"actuator{i}"
        if not is_bush(model, i):
            found[name] = int(model.actuator_ctrladr[i])
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
        raise unknown_name(f"attribute of a {kind}", attr, valid)
    assert array is not None
    if field.startswith("dof_"):
        rows = [[d for d in range(model.nv) if model.dof_jntid[d] == j] for j in ids]
        return field, np.array([i for row in rows for i in row], dtype=int).reshape(-1, 1)
    if field == "qpos_spring":
        return field, np.array([model.jnt_qposadr[j] for j in ids], dtype=int).reshape(-1, 1)
    width = array.size // array.shape[0]
    return field, np.array([np.arange(i * width, (i + 1) * width) for i in ids], dtype=int)


def resolve_path(model: mujoco.MjModel, path: str) -> list[Target]:
    """Turn a path into targets of this model.

    Raises
    ------
    ParameterError
        If the path does not parse, or matches nothing in the model.
    NameLookupError
        If the object kind or attribute does not exist; the message lists the valid ones.
    """
    match = _PATH.fullmatch(path)
    if match is None:
        raise ParameterError(f"cannot read target '{path}': expected object:name.attribute[index]*factor+offset")
    kind, pattern, attr = match["object"], match["pattern"], match["attr"]
    factor, offset = float(match["factor"] or 1.0), float(match["offset"] or 0.0)
    if factor == 0.0:
        raise ParameterError(f"target '{path}': the factor must not be zero")
    if kind == "control":
        known = controls(model)
        names = [n for n in known if fnmatch.fnmatchcase(n, pattern)]
        if not names:
            raise unknown_name("control", pattern, known)
        return [Target("ctrl", tuple(known[n] for n in names), factor, offset, path)]
    if kind == "option":
        return [Target("opt." + pattern, _option_index(model, pattern, match["index"]), factor, offset, path)]
    if kind not in _OBJECTS:
        raise unknown_name("object in a target path", kind, [*_OBJECTS, "option", "control"])
    if attr is None:
        raise ParameterError(f"target '{path}': an attribute is missing, as in {kind}:{pattern}.stiffness")
    names = element_names(model, kind)
    ids = [i for i, n in enumerate(names) if n and fnmatch.fnmatchcase(n, pattern)]
    if not ids:
        listing = ", ".join(n for n in names if n) or "none"
        raise ParameterError(f"target '{path}' matches no {kind} of the model. Its {kind} names: {listing}.")
    field, entries = _field_entries(model, kind, attr, ids)
    if match["index"] is not None:
        index = int(match["index"])
        if index >= entries.shape[1]:
            raise ParameterError(f"target '{path}': index {index} is outside 0..{entries.shape[1] - 1}")
        entries = entries[:, index : index + 1]
    return [Target(field, tuple(int(i) for i in entries.ravel()), factor, offset, path)]


def _is_continuous(field: object) -> bool:
    return isinstance(field, float) or (isinstance(field, np.ndarray) and field.dtype.kind == "f")


def _option_index(model: mujoco.MjModel, attr: str, index: str | None) -> tuple[int, ...]:
    if not _is_continuous(getattr(model.opt, attr, None)):
        names = [a for a in dir(model.opt) if not a.startswith("_")]
        raise unknown_name("option", attr, [a for a in names if _is_continuous(getattr(model.opt, a))])
    size = np.size(getattr(model.opt, attr))
    if index is None:
        return tuple(range(size))
    if int(index) >= size:
        raise ParameterError(f"target 'option:{attr}[{index}]': index {index} is outside 0..{size - 1}")
    return (int(index),)


def read_target(model: mujoco.MjModel, target: Target) -> np.ndarray:
    """Return the parameter values that the target's entries imply, (len(index),)."""
    if target.field == "ctrl":
        return np.full(len(target.index), -target.offset / target.factor)
    array = np.ravel(_field(model, target.field))
    return (array[list(target.index)] - target.offset) / target.factor


def _field(model: mujoco.MjModel, field: str) -> np.ndarray:
    owner = model.opt if field.startswith("opt.") else model
    return np.asarray(getattr(owner, field.removeprefix("opt.")))


def make_parameter(model: mujoco.MjModel, declaration: Declaration) -> Parameter:
    """Resolve a declaration against a model, checking that all its targets agree on one value."""
    targets = tuple(t for path in declaration.paths for t in resolve_path(model, path))
    values = np.concatenate([read_target(model, t) for t in targets])
    spread = np.ptp(values)
    if spread > 1e-9 * max(1.0, np.abs(values).max()):
        raise ParameterError(
            f"parameter '{declaration.name}': its targets disagree in this model "
            f"(values from {values.min():g} to {values.max():g}); give each its own parameter, "
            "or factors and offsets that make them agree"
        )
    kind = "control" if all(t.field == "ctrl" for t in targets) else "field"
    value = float(values[0]) + 0.0
    bounds = declaration.bounds or default_bounds(value, declaration.unit)
    hard = _control_range(model, targets) if kind == "control" else (-math.inf, math.inf)
    return Parameter(declaration.name, declaration.unit, value, bounds, kind, targets, hard)


def default_bounds(value: float, unit: str = "") -> tuple[float, float]:
    """Return a range for a parameter that states none: a decade around a positive value."""
    if unit == "rad":
        return (-math.pi, math.pi)
    if value > 0:
        return (0.1 * value, 10.0 * value)
    return (-1.0, 1.0) if value == 0 else (10.0 * value, 0.1 * value)


def _control_range(model: mujoco.MjModel, targets: Sequence[Target]) -> tuple[float, float]:
    """Return the range of values that no limited control would clamp."""
    low, high = -math.inf, math.inf
    for target in targets:
        for i in target.index:
            if model.actuator_ctrllimited[i]:
                ends = sorted((model.actuator_ctrlrange[i] - target.offset) / target.factor)
                low, high = max(low, ends[0]), min(high, ends[1])
    return float(low), float(high)


def control_parameter(model: mujoco.MjModel, name: str, index: int) -> Parameter:
    """Return the parameter that every actuator's control is, by the actuator's name."""
    target = Target("ctrl", (index,), path=f"control:{name}")
    hard = _control_range(model, [target])
    bounds = hard if np.all(np.isfinite(hard)) else (-1.0, 1.0)
    return Parameter(name, "", 0.0, bounds, "control", (target,), hard)


def gravity_parameters() -> list[Parameter]:
    """Return gravity_angle and load_factor, which every model has."""
    return [
        Parameter(GRAVITY_ANGLE, "rad", 0.0, (-math.pi, math.pi), "gravity"),
        Parameter(LOAD_FACTOR, "1", 1.0, (0.0, 10.0), "gravity"),
    ]


@dataclass(frozen=True, slots=True)
class Gravity:
    """gravity = n R(angle) g0, with R about `axis` (right-handed; the default turns -z towards -x)."""

    g0: np.ndarray
    axis: np.ndarray

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Gravity:
        """Read gravity and, from the text `mjcont/gravity_axis`, the axis it turns about."""
        text = setting(model, "gravity_axis")
        try:
            axis = np.array([float(v) for v in text.split()]) if text else np.array([0.0, 1.0, 0.0])
        except ValueError:
            axis = np.zeros(0)
        if axis.shape != (3,) or not axis.any():
            raise ParameterError(f"mjcont/gravity_axis must be three numbers, not all zero; got '{text}'")
        return cls(model.opt.gravity.copy(), axis / np.linalg.norm(axis))

    def vector(self, angle: float, factor: float) -> np.ndarray:
        """Return the gravity vector, (3,), by Rodrigues' formula."""
        a, g = self.axis, self.g0
        c, s = math.cos(angle), math.sin(angle)
        return factor * (c * g + s * np.cross(a, g) + (1.0 - c) * np.dot(a, g) * a)


class FieldWriter:
    """Writes parameter values into one model (and the control vector), touching only what changed.

    What is written depends on the values alone, not on what was written before: a parameter at the model's own value
    leaves its entries as loaded, and where several act on one entry, the last declared of the others decides.
    """

    def __init__(self, model: mujoco.MjModel, parameters: Mapping[str, Parameter], gravity: Gravity) -> None:
        self.model = model
        self.gravity = gravity
        self.ctrl = np.zeros(model.nu)
        self.version = 0
        self._data = mujoco.MjData(model)
        self._loaded: dict[str, np.ndarray] = {
            "body_mass": model.body_mass.copy(),
            "body_inertia": model.body_inertia.copy(),
        }
        self._written = {name: p.value for name, p in parameters.items()}
        self._groups: dict[str, tuple[str, ...]] = {}
        self._grouped = 0

    def write(self, parameters: Mapping[str, Parameter], values: Mapping[str, float]) -> None:
        """Make the model have `values`; names that are left out have the model's own."""
        if not values.keys() <= parameters.keys():
            raise unknown_name("parameter", next(n for n in values if n not in parameters), parameters)
        written = self._written
        new = {n: values.get(n, p.value) for n, p in parameters.items()}
        changed = [n for n, v in new.items() if written.get(n, parameters[n].value) != v]
        if not changed:
            return
        constants = model_changed = False
        written.update(new)
        for group in dict.fromkeys(self._group(parameters, name) for name in changed):
            members = [parameters[n] for n in group]
            for parameter in members:
                self._restore(parameter)
            for parameter in members:
                if written.get(parameter.name, parameter.value) != parameter.value:
                    self._apply(parameter)
            constants |= any(p.needs_constants for p in members)
            model_changed |= any(p.kind != "control" for p in members)
        if constants:
            mujoco.mj_setConst(self.model, self._data)
        self.version += model_changed

    def _group(self, parameters: Mapping[str, Parameter], name: str) -> tuple[str, ...]:
        """Return the parameters that share entries with `name`, directly or through others, as declared."""
        if self._grouped != len(parameters):
            self._groups, self._grouped = {}, len(parameters)
        if name not in self._groups:
            entries, group, grown = set(parameters[name].entries), {name}, True
            while grown:
                new = {n for n, p in parameters.items() if n not in group and not entries.isdisjoint(p.entries)}
                entries |= {e for n in new for e in parameters[n].entries}
                group |= new
                grown = bool(new)
            self._groups[name] = tuple(n for n in parameters if n in group)
        return self._groups[name]

    def _restore(self, parameter: Parameter) -> None:
        """Give the parameter's entries the values they had in the loaded model."""
        if parameter.kind == "gravity":
            self.model.opt.gravity[:] = self.gravity.g0
        for target in parameter.targets:
            index = list(target.index)
            if target.field == "ctrl":
                self.ctrl[index] = 0.0
                continue
            array = _field(self.model, target.field)
            if target.field not in self._loaded:
                self._loaded[target.field] = array.copy()
            self._put(target.field, index, self._loaded[target.field].reshape(-1)[index])
            if target.field == "body_mass":
                self.model.body_inertia[index] = self._loaded["body_inertia"][index]

    def _apply(self, parameter: Parameter) -> None:
        """Write the parameter's value into its entries."""
        written = self._written
        if parameter.kind == "gravity":
            self.model.opt.gravity[:] = self.gravity.vector(written[GRAVITY_ANGLE], written[LOAD_FACTOR])
        for target in parameter.targets:
            index = list(target.index)
            entry = target.offset + target.factor * written[parameter.name]
            if target.field == "ctrl":
                self.ctrl[index] = entry
                continue
            self._put(target.field, index, entry)
            if target.field == "body_mass":
                for body in index:
                    if self._loaded["body_mass"][body] > 0:
                        scale = entry / self._loaded["body_mass"][body]
                        self.model.body_inertia[body] = scale * self._loaded["body_inertia"][body]

    def _put(self, field: str, index: list[int], entry: float | np.ndarray) -> None:
        array = _field(self.model, field)
        if array.ndim == 0:
            setattr(self.model.opt, field.removeprefix("opt."), float(np.squeeze(entry)))
        else:
            array.reshape(-1)[index] = entry


def with_unit(parameter: Parameter, unit: str) -> Parameter:
    """Return the parameter with another unit."""
    return replace(parameter, unit=unit)
