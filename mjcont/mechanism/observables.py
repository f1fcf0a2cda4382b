"""Observables: named scalars read from a model at rest - its sensors, its joint positions, and Python functions.

They are read at one state after the other, or at many side by side where sensors and positions are all.

Sensor cut-off, noise and delay are ignored: the raw value is read from a copy of the model without them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import mujoco
import numpy as np

from mjcont.arguments import checked
from mjcont.errors import unknown_name
from mjcont.mechanism.batches import Rows
from mjcont.mechanism.declarations import declarations
from mjcont.mechanism.writer import FieldWriter
from mjcont.models.quiet import quiet, quiet_data
from mjcont.numerics.equations.problem import Array, Values
from mjcont.results.quantities import Observable, Parameter, column_of, own_observable

_SENSOR = mujoco.mjtSensor
# rows of a batch, and the number of states from which on it pays
_ROWS, _MANY = 32, 8
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


class Readings:
    """A model of its own from which observables are read.

    `constrained` says that constraints act: their forces depend on what was evaluated before, so that states are
    read one after the other.
    """

    def __init__(
        self, model: mujoco.MjModel, parameters: Mapping[str, Parameter], writer: FieldWriter, constrained: bool
    ) -> None:
        self._model, self._parameters, self._writer = model, parameters, writer
        self._constrained = constrained
        self._data = quiet_data(model)
        self._rows: Rows | None = None

    def read(
        self,
        chosen: Sequence[Observable],
        states: Array,
        values: Sequence[Values] | Values,
        velocities: Array | None = None,
        activations: Array | None = None,
    ) -> Array:
        """Return observables for states (m, nq), at rest unless velocities (m, nv) are given, shape (m, chosen).

        `activations` (m, followers) take the place of those at rest.
        """
        out = np.full((len(states), len(chosen)), np.nan)
        data = self._data
        for i, x in enumerate(states):
            self._writer.write(self._parameters, values if isinstance(values, Mapping) else values[i])
            if self._writer.failure:
                continue
            data.qpos[:] = x
            data.qvel[:] = 0.0 if velocities is None else velocities[i]
            self._writer.inputs.put(data)
            if activations is not None:
                data.act[self._writer.inputs.following] = activations[i]
            with quiet:
                mujoco.mj_forward(self._model, data)
            out[i] = [o.function(self._model, data) for o in chosen]
        return out

    def read_along(
        self,
        chosen: Sequence[Observable],
        states: Array,
        values: Values,
        driven: Mapping[str, Array],
        velocities: Array | None = None,
        activations: Array | None = None,
    ) -> Array:
        """Return observables as `read` does, parameters having values of their own in each state (m,), by name."""
        plain = all(o.source is not None for o in chosen) and not self._constrained
        if len(states) < _MANY or not plain or not all(self._writer.alone(self._parameters, n) for n in driven):
            each = [{**values, **{n: float(column[i]) for n, column in driven.items()}} for i in range(len(states))]
            return self.read(chosen, states, each, velocities, activations)
        self._writer.write(self._parameters, values)
        if self._writer.failure:
            return np.full((len(states), len(chosen)), np.nan)
        sources = [o.source for o in chosen if o.source is not None]
        if all(field == "qpos" for field, _ in sources):
            return states[:, [index for _, index in sources]].copy()
        controls = self._writer.controls(self._parameters, values, driven) if driven else None
        if self._rows is None:
            self._rows = Rows(self._model, _ROWS, None)
        columns = [self._rows.field(field)[:, index] for field, index in sources]
        out = np.empty((len(states), len(chosen)))
        for first in range(0, len(states), _ROWS):
            here = np.minimum(np.arange(first, first + _ROWS), len(states) - 1)
            speeds, acts = (None if given is None else given[here] for given in (velocities, activations))
            self._rows.forward(states[here], speeds, self._writer, None if controls is None else controls[here], acts)
            count = min(_ROWS, len(states) - first)
            for k, read in enumerate(columns):
                out[first : first + count, k] = read[:count]
        return out


class _Reading(Protocol):
    readings: Readings


class Observed:
    """What a Mechanism knows of its observables.

    Attributes
    ----------
    observables : dict of str to Observable
    """

    observables: dict[str, Observable]
    parameters: Any

    @property
    def _core(self) -> _Reading:
        raise NotImplementedError

    @checked
    def observe(self, name: str, function: Callable[[Any, Any], float], unit: str = "") -> None:
        """Add an observable computed by `function(model, data)` from MuJoCo's model and data.

        Raises
        ------
        ParameterError
            If a parameter has this name.
        """
        self.observables[name] = own_observable(name, unit, function, self.parameters)

    def observable(self, name: str) -> Observable:
        """Return the observable called `name`; a parameter may have the same name (see `told_apart`)."""
        own = column_of(name, self.observables)
        if own is None:
            raise unknown_name("observable", name, self.observables)
        return self.observables[own]

    def measure(
        self,
        states: Array,
        values: Sequence[Values] | Values,
        names: Sequence[str] | None = None,
        velocities: Array | None = None,
        activations: Array | None = None,
    ) -> Array:
        """Return observables for states (m, nq), at rest unless velocities (m, nv) are given; default all of them.

        `activations` (m, followers) are those of filters and muscles in motion; by default they are at rest.
        """
        chosen = [self.observable(n) for n in (names if names is not None else self.observables)]
        return self._core.readings.read(chosen, states, values, velocities, activations)

    def measure_along(
        self,
        states: Array,
        values: Values,
        driven: Mapping[str, Array],
        velocities: Array | None = None,
        activations: Array | None = None,
    ) -> Array:
        """Return all observables as `measure` does, parameters having values of their own in each state (m,)."""
        chosen = list(self.observables.values())
        return self._core.readings.read_along(chosen, states, values, driven, velocities, activations)
