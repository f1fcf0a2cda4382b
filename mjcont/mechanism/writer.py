"""Writing parameter values into the fields of a model."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.errors import ParameterError, unknown_name
from mjcont.mechanism.declarations import setting
from mjcont.mechanism.geometry import Geometry, NotCompiled, copy_geometry
from mjcont.mechanism.inputs import INPUT_FIELDS, DataInputs
from mjcont.mechanism.parameters import GRAVITY_ANGLE, LOAD_FACTOR
from mjcont.models.quiet import quiet
from mjcont.models.states import field_array
from mjcont.results.quantities import Parameter


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
    """Writes parameter values into one model and into `inputs` (what lives in its data), touching only what changed.

    What is written depends on the values alone, not on what was written before: a parameter at the model's own value
    leaves its entries as loaded, and where several act on one entry, the last declared of the others decides.
    Parameters of the spec come first: "as loaded" is then what the spec compiles to at their values.

    Attributes
    ----------
    failure : why the model cannot be compiled at the values written last; empty where it can.
    """

    def __init__(self, model: mujoco.MjModel, parameters: Mapping[str, Parameter], geometry: Geometry) -> None:
        self.model = model
        self.gravity = Gravity.of(model)
        self.failure = ""
        self._geometry = geometry
        self._base: dict[str, float] = {}
        self.inputs = DataInputs(model)
        self.version = 0
        self._data = mujoco.MjData(model)
        self._loaded: dict[str, np.ndarray] = {
            "body_mass": model.body_mass.copy(),
            "body_inertia": model.body_inertia.copy(),
        }
        self._written: dict[str, float] = {}
        self._known = len(parameters)
        self._last: dict[str, float] | None = None
        self._groups: dict[str, tuple[str, ...]] = {}
        self._grouped = 0
        self._alone: dict[str, bool] = {}
        self._torn = False  # whether an interrupt came half-way: everything is written anew next time

    def write(self, parameters: Mapping[str, Parameter], values: Mapping[str, float]) -> None:
        """Make the model have `values`; names that are left out have the model's own."""
        known = len(parameters) == self._known and self._last is not None and not self._torn
        if known and self._moves_a_control(parameters, values):
            return
        if not values.keys() <= parameters.keys():
            raise unknown_name("parameter", next(n for n in values if n not in parameters), parameters)
        written = self._written
        new = {n: values.get(n, p.value) for n, p in list(parameters.items())}  # others may declare meanwhile
        if not self._rebase(parameters, new):
            return
        changed = [n for n, v in new.items() if self._torn or written.get(n, parameters[n].value) != v]
        if not changed:
            return
        self._torn = True
        self._rewrite(parameters, changed, new)
        self._last = dict(values)
        self._torn = False

    def _moves_a_control(self, parameters: Mapping[str, Parameter], values: Mapping[str, float]) -> bool:
        """Do the least where nothing has changed, or one control that is alone; return whether that was it."""
        last = self._last
        assert last is not None
        if values == last:
            return True
        if values.keys() != last.keys():
            return False
        changed = [n for n, v in values.items() if last[n] != v]
        if len(changed) != 1:
            return False
        name = changed[0]
        if not self.alone(parameters, name):
            return False
        self._torn = True
        last[name] = self._written[name] = value = values[name]
        parameter = parameters[name]
        if value == parameter.value:
            self._restore(parameter)
        else:
            for target in parameter.targets:
                self.inputs.write("ctrl", list(target.index), target.entry(value))
        self._torn = False
        return True

    def alone(self, parameters: Mapping[str, Parameter], name: str) -> bool:
        """Whether a parameter is a control that nothing else depends on."""
        if name not in self._alone:
            alone = parameters[name].kind == "control" and self._group(parameters, name) == (name,)
            self._alone[name] = alone and not self.inputs.followed
        return self._alone[name]

    def controls(
        self, parameters: Mapping[str, Parameter], values: Mapping[str, float], driven: Mapping[str, np.ndarray]
    ) -> np.ndarray:
        """Write `values` and return controls (m, nu) in which those `driven`, each `alone`, have values of their own.

        `driven` maps names to these, (m,) each.
        """
        self.write(parameters, values)
        ctrl = np.empty((len(next(iter(driven.values()))), self.model.nu))
        ctrl[:] = self.inputs.ctrl
        for name, column in driven.items():
            for target in parameters[name].targets:
                for i in target.index:
                    ctrl[:, i] += target.factor * (column - values[name])
        return ctrl

    def _forget(self) -> None:
        self._written.clear()
        self._last, self._base = None, {}

    def _rebase(self, parameters: Mapping[str, Parameter], new: Mapping[str, float]) -> bool:
        """Give the model the geometry that the spec compiles to; return whether it does compile."""
        wanted = {n: v for n, v in new.items() if parameters[n].kind == "spec"}
        if self._known != len(parameters):
            self._known, self._alone = len(parameters), {}
        if wanted == self._base:
            return True
        self._forget()
        self.failure = ""
        self.version += 1
        try:
            base = self._geometry.model(parameters, wanted)
        except NotCompiled as error:
            self.failure = str(error)
            return False
        copy_geometry(base, self.model)
        self.gravity = Gravity.of(base)
        self._loaded = {"body_mass": base.body_mass.copy(), "body_inertia": base.body_inertia.copy()}
        self.inputs.reset(base)
        self._base = wanted
        return True

    def _rewrite(self, parameters: Mapping[str, Parameter], changed: list[str], new: Mapping[str, float]) -> None:
        written = self._written
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
            model_changed |= any(p.kind in ("field", "switch", "gravity") for p in members)
        self.inputs.settle()
        if constants:
            with quiet:
                mujoco.mj_setConst(self.model, self._data)
        self.version += model_changed

    def _group(self, parameters: Mapping[str, Parameter], name: str) -> tuple[str, ...]:
        """Return the parameters that share entries with `name`, directly or through others, as declared."""
        if self._grouped != len(parameters):
            self._groups, self._grouped, self._alone = {}, len(parameters), {}
        if name not in self._groups:
            entries, group, grown = set(parameters[name].entries), {name}, True
            while grown:
                new = {n for n, p in list(parameters.items()) if n not in group and not entries.isdisjoint(p.entries)}
                entries |= {e for n in new for e in parameters[n].entries}
                group |= new
                grown = bool(new)
            self._groups[name] = tuple(n for n in list(parameters) if n in group)
        return self._groups[name]

    def _restore(self, parameter: Parameter) -> None:
        """Give the parameter's entries the values they had in the loaded model."""
        if parameter.kind == "gravity":
            self.model.opt.gravity[:] = self.gravity.g0
        for target in parameter.targets:
            index = list(target.index)
            if target.field in INPUT_FIELDS:
                self.inputs.write(target.field, index, self.inputs.loaded[target.field].reshape(-1)[index])
                continue
            array = field_array(self.model, target.field)
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
            entry = target.entry(written[parameter.name])
            if target.field in INPUT_FIELDS:
                self.inputs.write(target.field, index, entry)
                continue
            self._put(target.field, index, entry)
            if target.field == "body_mass":
                for body in index:
                    if self._loaded["body_mass"][body] > 0:
                        scale = entry / self._loaded["body_mass"][body]
                        self.model.body_inertia[body] = scale * self._loaded["body_inertia"][body]

    def _put(self, field: str, index: list[int], entry: float | np.ndarray) -> None:
        array = field_array(self.model, field)
        if array.ndim == 0:
            setattr(self.model.opt, field.removeprefix("opt."), float(np.squeeze(entry)))
        else:
            array.reshape(-1)[index] = entry
