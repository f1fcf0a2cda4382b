"""Geometry as a parameter: edits of a model's spec, which is compiled anew at each value.

A longer rod has another mass, inertia and centre of mass, which no field of a compiled model changes together. Such a
parameter edits a copy of the spec, by a Python function or by paths spec:object:pattern.attribute[index]*factor+offset;
the compiled arrays are then copied in place into the models that a Mechanism owns, and its other parameters are
written on top of them.
"""

from __future__ import annotations

import copy
import dataclasses
import math
import threading
from collections import OrderedDict
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import MjcontError, ModelError, ParameterError, leaves_domain
from mjcont.mechanism.declarations import Declaration, agreed_value
from mjcont.mechanism.specpaths import PREFIX, SpecTarget, resolve_spec_path
from mjcont.models.numbers import invalid_number
from mjcont.models.quiet import heard
from mjcont.results.quantities import Parameter, default_bounds

_CACHED, _CACHED_BYTES = 16, 2e8
_SAME = 1e-6  # XML is often written with six or seven digits
# What the private copies of a Mechanism have of their own, and what no geometry changes.
_KEPT = ("sensor_", "actuator_ctrllimited", "actuator_delay", "key_", "text_", "tuple_", "name", "tex_", "paths")
_OPTIONS = ("gravity", "wind", "magnetic", "density", "viscosity", "impratio")
_STATISTICS = ("meaninertia", "meanmass", "meansize", "extent", "center")
_ACTING = ("body_", "geom_", "site_", "jnt_", "dof_", "qpos", "tendon_", "actuator_", "eq_", "wrap_")
_FIRST_SIZES = ("nq", "nv", "nbody", "njnt", "ngeom", "nsite", "ntendon", "nu", "neq", "nsensor", "nkey")
_STRUCTURE = (
    "body_parentid", "jnt_type", "jnt_bodyid", "jnt_limited", "geom_bodyid", "geom_contype", "geom_conaffinity",
    "site_bodyid", "tendon_limited", "wrap_type", "wrap_objid", "eq_type", "eq_obj1id", "eq_obj2id", "eq_active0",
    "actuator_trntype", "actuator_trnid", "sensor_type", "sensor_objid",
)  # fmt: skip
_FLAGS = ("disableflags", "enableflags", "disableactuator", "integrator")


class NotCompiled(ParameterError):
    """Values at which the spec gives no model, such as a rod without length."""


class Geometry:
    """The spec behind a Mechanism, and the models compiled from it at values of the parameters that edit it.

    Parameters
    ----------
    spec : MjSpec or None
        Never changed; None for a Mechanism made from a compiled model, which has no such parameters.
    folder : Path, optional
        Where the files that the model names are looked up.
    """

    def __init__(self, spec: mujoco.MjSpec | None, folder: Path | None = None) -> None:
        self._given, self._folder = spec, folder
        self._spec: mujoco.MjSpec | None = None
        self._reference: mujoco.MjModel | None = None
        self._models: OrderedDict[tuple[tuple[str, float], ...], mujoco.MjModel | NotCompiled] = OrderedDict()
        self._most = _CACHED
        self._lock = threading.RLock()  # threads share the spec and what was compiled from it

    def anew(self) -> Geometry:
        """Return the same spec for another Mechanism, whose names mean what it declares."""
        return Geometry(self._given, self._folder)

    def _open(self, name: str) -> mujoco.MjSpec:
        """Return the spec, prepared when the first parameter asks for it."""
        if self._given is None:
            raise ParameterError(
                f"parameter '{name}' edits the model's spec, which a compiled model does not carry: "
                "make the mechanism with Mechanism.from_xml or Mechanism.from_spec"
            )
        if self._spec is None:
            spec = self._given.copy()
            if self._folder is not None:
                spec.modelfiledir = str(self._folder)
            for body in spec.bodies:
                body.simple = 0  # a body that stops being "simple" would change the layout of the mass matrix
            with heard():
                self._reference = spec.compile()
            self._most = max(2, min(_CACHED, int(_CACHED_BYTES // mujoco.mj_sizeModel(self._reference))))
            self._spec = spec
        return self._spec

    @property
    def reference(self) -> mujoco.MjModel:
        """The model that the unedited spec compiles to, with the layout of all others."""
        assert self._reference is not None
        return self._reference

    def model(self, parameters: Mapping[str, Parameter], values: Mapping[str, float]) -> mujoco.MjModel:
        """Return the model compiled at `values` (the parameters' own where left out); not to be changed.

        Functions edit one copy of the spec in the order of their declaration, then the paths whose value is not the
        model's own.

        Raises
        ------
        NotCompiled
            If MuJoCo cannot compile the spec there, or a function leaves its domain.
        ModelError
            If the structure of the model would change.
        """
        with self._lock:
            return self._found(parameters, values)

    def _found(self, parameters: Mapping[str, Parameter], values: Mapping[str, float]) -> mujoco.MjModel:
        edits = [(p, values.get(n, p.value)) for n, p in list(parameters.items()) if p.kind == "spec"]
        functions = [(p, v) for p, v in edits if p.is_function]
        edits = functions + [(p, v) for p, v in edits if not p.is_function and v != p.value]
        if not edits:
            return self.reference
        key = tuple((p.name, v) for p, v in edits)
        found = self._models.get(key)
        if found is None:
            try:
                found = self._compile(edits)
            except NotCompiled as error:
                found = error
            self._models[key] = found
            while len(self._models) > self._most:
                self._models.popitem(last=False)
        self._models.move_to_end(key)
        if isinstance(found, NotCompiled):
            raise NotCompiled(str(found))
        return found

    def _compile(self, edits: list[tuple[Parameter, float]]) -> mujoco.MjModel:
        where = ", ".join(f"{p.name} = {v:g}" for p, v in edits)
        spec = self._open(edits[0][0].name).copy()
        for parameter, value in edits:
            assert parameter.edit is not None
            try:
                parameter.edit(spec, value)
            except MjcontError:
                raise
            except Exception as error:
                if leaves_domain(error):
                    raise NotCompiled(f"the function of '{parameter.name}' has no value at {where}: {error}") from error
                what = f"{type(error).__name__}: {error}"
                raise ParameterError(f"parameter '{parameter.name}': its function failed at {where}: {what}") from error
        try:
            with heard():
                model = spec.compile()
        except (ValueError, mujoco.FatalError) as error:
            sentence = " ".join(str(error).split())
            raise NotCompiled(f"the model does not compile at {where}: {sentence}") from error
        wrong = invalid_number(model)
        if wrong:
            raise NotCompiled(f"the model is no model at {where}: {wrong}")
        change = _structure_change(self.reference, model)
        if change:
            names = " and ".join(f"'{p.name}'" for p, _ in edits)
            raise ModelError(
                f"parameter {names} changes the structure of the model at {where}: {change}. "
                "A parameter may move, resize and weigh what is there, not add, remove or rename it"
            )
        return model

    def with_layout(self, model: mujoco.MjModel, parameters: Mapping[str, Parameter]) -> mujoco.MjModel:
        """Return the model, or one of the layout that all compiled ones have, if a parameter needs them."""
        if model.body_simple.any() and any(p.kind == "spec" for p in parameters.values()):
            return copy.copy(self.reference)
        return model

    # -- making parameters -----------------------------------------------------------------------------------

    def path_parameter(self, declaration: Declaration) -> Parameter:
        """Return the parameter that `spec:` paths declare; its value is read from the spec."""
        name = declaration.name
        others = [p for p in declaration.paths if not p.startswith(PREFIX)]
        if others:
            raise ParameterError(
                f"parameter '{name}' mixes targets in the spec with others ({', '.join(others)}): "
                f"write {PREFIX} before each, or declare two parameters"
            )
        spec = self._open(name)
        targets = [resolve_spec_path(spec, path) for path in declaration.paths]
        value = agreed_value(name, np.concatenate([t.read(spec) for t in targets]))
        made = self._parameter(declaration, value, _writer_of(targets), " ".join(declaration.paths))
        return self._tried(made)

    def function_parameter(
        self, declaration: Declaration, function: Callable[[Any, float], None], value: float | None
    ) -> Parameter:
        """Return the parameter whose values a Python function writes into the spec."""
        name = declaration.name
        self._open(name)
        if declaration.paths:
            raise ParameterError(f"parameter '{name}': give either paths or a function, not both")
        if value is None:
            raise ParameterError(f"parameter '{name}': a function needs value=, what the parameter is in the model")
        if not callable(function):
            raise ParameterError(f"parameter '{name}': function must take (spec, value), got {function!r}")
        if not math.isfinite(value):
            raise ParameterError(f"parameter '{name}': the value must be a finite number, got {value}")
        label = getattr(function, "__name__", type(function).__name__)
        return self._tried(self._parameter(declaration, float(value), function, f"{label}(spec, value)", True))

    @staticmethod
    def _parameter(
        d: Declaration, value: float, edit: Callable[[Any, float], None], source: str, is_function: bool = False
    ) -> Parameter:
        bounds = d.bounds or default_bounds(value, d.unit)
        return Parameter(d.name, d.unit, value, bounds, "spec", edit=edit, source=source, is_function=is_function)

    def _tried(self, p: Parameter) -> Parameter:
        """Return the parameter with the entries that it touches, after a trial beside its value and at its bounds."""
        self._models.clear()  # a declaration that failed may have used the name for another edit
        alone = {p.name: p}
        own = self.model(alone, {})
        if p.is_function:
            _refuse_other_model(p, self.reference, own)
        step = 1e-3 * max(abs(p.value), 1e-2 * (p.bounds[1] - p.bounds[0]))
        for beside in (p.value + step, p.value - step):
            try:
                touched = _touched(own, self.model(alone, {p.name: beside}))
            except NotCompiled:
                continue
            if not touched:
                raise ParameterError(
                    f"parameter '{p.name}' ({p.source}) changes nothing in the compiled model: something else in the "
                    "XML decides (fromto over size[1]; a geom's mass over its density; <inertial> over the geoms; "
                    "geoms over a body's mass without <inertial>)"
                )
            p = dataclasses.replace(p, touched=touched)
            break
        for end in p.bounds:
            try:
                self.model({p.name: p}, {p.name: end})
            except NotCompiled:
                continue
        return p


def _writer_of(targets: list[SpecTarget]) -> Callable[[Any, float], None]:
    def edit(spec: mujoco.MjSpec, value: float) -> None:
        for target in targets:
            target.write(spec, value)

    return edit


def refuse_overlap(parameters: Mapping[str, Parameter], values: Mapping[str, float], free: tuple[str, ...]) -> None:
    """Raise where a free field parameter acts on what a spec parameter has changed.

    At its own value a field parameter leaves the model as compiled, at others it overrides it: a jump.
    """
    for spec in list(parameters.values()):
        if spec.kind != "spec" or (spec.name not in free and values.get(spec.name, spec.value) == spec.value):
            continue
        for name in free:
            common = parameters[name].entries & spec.entries if parameters[name].kind == "field" else None
            if common:
                field, index = min(common)
                raise ParameterError(
                    f"'{name}' cannot be varied while '{spec.name}' has another value than the model's: both act on "
                    f"{field}[{index}]. Declare '{name}' through the spec, too, as in spec:geom:rod.density"
                )


def copy_geometry(base: mujoco.MjModel, model: mujoco.MjModel) -> None:
    """Copy what a spec parameter may change into a model of the same layout, in place."""
    if model.body_simple.any() or model.nC != base.nC:
        raise ParameterError(
            "this copy of the model was made before a parameter of its spec was declared: make it anew, "
            "with simulation_model()"
        )
    for field in _fields():
        np.copyto(getattr(model, field), getattr(base, field))
    for owner, source, names in ((model.opt, base.opt, _OPTIONS), (model.stat, base.stat, _STATISTICS)):
        for name in names:
            setattr(owner, name, getattr(source, name))


@cache
def _fields() -> tuple[str, ...]:
    """Return the names of the arrays of any model that a spec parameter may change."""
    model = mujoco.MjModel.from_xml_string("<mujoco/>")
    every = (f for f in dir(model) if not f.startswith(("_", *_KEPT)))
    return tuple(f for f in every if isinstance(getattr(model, f), np.ndarray))


def acting_fields() -> tuple[str, ...]:
    """Return the names of the arrays of any model on which forces depend."""
    return tuple(f for f in _fields() if f.startswith(_ACTING))


@cache
def _sizes() -> tuple[str, ...]:
    """Return the names of a model's sizes, those that a user knows first."""
    model = mujoco.MjModel.from_xml_string("<mujoco/>")
    every = (s for s in dir(model) if s.startswith("n") and isinstance(getattr(model, s), int))
    return (*_FIRST_SIZES, *(s for s in every if s not in ("narena", "nbuffer")))


def _touched(a: mujoco.MjModel, b: mujoco.MjModel) -> frozenset[tuple[str, int]]:
    """Return the entries of acting fields and options in which two models differ."""
    pairs = [(f, getattr(a, f), getattr(b, f)) for f in _fields() if f.startswith(_ACTING)]
    pairs += [(f"opt.{f}", getattr(a.opt, f), getattr(b.opt, f)) for f in _OPTIONS]
    return frozenset((f, int(i)) for f, x, y in pairs for i in np.flatnonzero(np.ravel(x) != np.ravel(y)))


def _structure_change(a: mujoco.MjModel, b: mujoco.MjModel) -> str:
    """Say in what the structure of two models differs; empty if in nothing."""
    for size in _sizes():
        if getattr(a, size) != getattr(b, size):
            return f"{size} is {getattr(b, size)}, not {getattr(a, size)}"
    if a.names != b.names:
        return "names of elements differ"
    for field in _STRUCTURE:
        if not np.array_equal(getattr(a, field), getattr(b, field)):
            return f"{field} differs"
    return next((f"option {f} differs" for f in _FLAGS if getattr(a.opt, f) != getattr(b.opt, f)), "")


def _refuse_other_model(p: Parameter, loaded: mujoco.MjModel, own: mujoco.MjModel) -> None:
    """Raise unless a function gives, at the parameter's own value, the model as loaded."""
    for field in _fields():
        a, b = (np.ravel(getattr(m, field)).astype(float) for m in (loaded, own))
        if field.startswith(_ACTING) and a.size and np.abs(a - b).max() > _SAME * max(np.abs(a).max(), 1e-3):
            i = int(np.argmax(np.abs(a - b)))
            raise ParameterError(
                f"parameter '{p.name}': at its value {p.value:g} the function must give the model as loaded, "
                f"but {field}[{i}] becomes {b[i]:g} from {a[i]:g}"
            )
