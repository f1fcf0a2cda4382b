"""Named parameters of a MuJoCo model: declarations in its custom texts, its controls, and gravity."""

from __future__ import annotations

import math
from collections.abc import Sequence

import mujoco
import numpy as np

from mjcont.errors import NameLookupError, ParameterError
from mjcont.mechanism.declarations import Declaration, agreed_value, declarations
from mjcont.mechanism.geometry import Geometry
from mjcont.mechanism.inputs import INPUT_FIELDS, limits, parameter_kind
from mjcont.mechanism.paths import controls, read_target, resolve_path
from mjcont.models.actuators import actuator_of, setpoint_unit
from mjcont.results.quantities import Parameter, Target, default_bounds
from mjcont.results.text import ParameterTable

GRAVITY_ANGLE, LOAD_FACTOR = "gravity_angle", "load_factor"


def make_parameter(model: mujoco.MjModel, declaration: Declaration) -> Parameter:
    """Resolve a declaration against a model, checking that all its targets agree on one value."""
    targets = tuple(t for path in declaration.paths for t in resolve_path(model, path))
    value = agreed_value(declaration.name, np.concatenate([read_target(model, t) for t in targets]))
    kind = parameter_kind({t.field for t in targets})
    units = {t.unit for t in targets}
    unit = declaration.unit or (units.pop() if len(units) == 1 else "")
    low, high, words = _input_range(model, targets)
    springs = any(t.loaded is not None for t in targets)
    several_decades = (1e-4 * value, 1e4 * value) if springs and value > 0 else None
    bounds = declaration.bounds or several_decades or default_bounds(value, unit)
    if kind == "switch":
        bounds = (0.0, 1.0)
    if springs:
        low, high = _positive(targets)
    elif not words:
        low, high, words = _inertial_range(model, targets)
    return Parameter(declaration.name, unit, value, bounds, kind, targets, (low, high), words)


def declared_parameter(model: mujoco.MjModel, geometry: Geometry, declaration: Declaration) -> Parameter:
    """Return the parameter that paths declare, to fields or through the spec, or that a function of the spec is."""
    if declaration.function is not None:
        return geometry.function_parameter(declaration, declaration.function, declaration.value)
    if declaration.value is not None:
        raise ParameterError(
            f"parameter '{declaration.name}': value= goes with function=; the value of a path is the model's own"
        )
    if not declaration.paths:
        raise ParameterError(f"parameter '{declaration.name}': give at least one target, such as joint:hip.stiffness")
    if any(path.startswith("spec:") for path in declaration.paths):
        return geometry.path_parameter(declaration)
    return make_parameter(model, declaration)


def _positive(targets: Sequence[Target]) -> tuple[float, float]:
    """Return the range of values that keeps every constraint's stiffness positive."""
    low, high = -math.inf, math.inf
    for t in targets:
        if t.loaded is not None:
            end = (float(np.finfo(float).tiny) - t.offset) / t.factor
            low, high = (max(low, end), high) if t.factor > 0 else (low, min(high, end))
    return low, high


def _inertial_range(model: mujoco.MjModel, targets: Sequence[Target]) -> tuple[float, float, str]:
    """Return the range of values that keeps masses and moments of inertia positive, and the words for it."""
    low, high, words = -math.inf, math.inf, ""
    for t in targets:
        width = {"body_mass": 1, "body_inertia": 3, "dof_armature": 0}.get(t.field)
        if width is None:
            continue
        # MuJoCo's compiler wants as much of a body with joints; others may weigh nothing
        moved = width and any(model.body_dofnum[i // width] for i in t.index)
        end = ((float(mujoco.mjMINVAL) if moved else 0.0) - t.offset) / t.factor
        low, high = (max(low, end), high) if t.factor > 0 else (low, min(high, end))
        words = "the range {range} in which masses and inertias are positive"
    return low, high, words


def _input_range(model: mujoco.MjModel, targets: Sequence[Target]) -> tuple[float, float, str]:
    """Return the range of values that MuJoCo would not clamp, and the words for it."""
    low, high, words = -math.inf, math.inf, ""
    for target in (t for t in targets if t.field in INPUT_FIELDS):
        for i in target.index:
            start, end, name = limits(model, target.field, i)
            ends = sorted(((start - target.offset) / target.factor, (end - target.offset) / target.factor))
            if name and (not words or ends[0] > low or ends[1] < high):
                words = name
            low, high = max(low, ends[0]), min(high, ends[1])
    return low, high, words


def control_parameter(model: mujoco.MjModel, name: str, field: str, index: int) -> Parameter:
    """Return the parameter that every actuator's control, or integrated setpoint, is by the actuator's name."""
    target = Target(field, (index,), path=f"control:{name}")
    low, high, words = _input_range(model, [target])
    unit = setpoint_unit(model, actuator_of(model, "act", index)) if field == "act" else ""
    stated = max(-low, high) < mujoco.mjMAXVAL
    bounds = (low, high) if stated else default_bounds(0.0, unit)
    value = float(read_target(model, target)[0])
    return Parameter(name, unit, value, bounds, parameter_kind({field}), (target,), (low, high), words)


def gravity_parameters() -> list[Parameter]:
    """Return gravity_angle and load_factor, which every model has."""
    return [
        Parameter(GRAVITY_ANGLE, "rad", 0.0, (-math.pi, math.pi), "gravity"),
        Parameter(LOAD_FACTOR, "1", 1.0, (0.0, 10.0), "gravity"),
    ]


def collect_parameters(model: mujoco.MjModel, geometry: Geometry) -> ParameterTable:
    """Return declared parameters first, then controls, then gravity."""
    found = ParameterTable()
    reserved = {p.name for p in gravity_parameters()}
    for declaration in declarations(model):
        if any(path.startswith("sensor:") for path in declaration.paths):
            continue
        if declaration.name in found or declaration.name in reserved:
            raise ParameterError(f"parameter '{declaration.name}' is declared twice")
        try:
            found[declaration.name] = declared_parameter(model, geometry, declaration)
        except NameLookupError as error:
            raise ParameterError(f"parameter '{declaration.name}': {error}") from error
    for name, (field, index) in controls(model).items():
        if name not in found:
            found[name] = control_parameter(model, name, field, index)
    for parameter in gravity_parameters():
        found[parameter.name] = parameter
    return found
