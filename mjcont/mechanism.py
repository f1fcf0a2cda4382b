"""`Mechanism`: the sole owner of an MjModel/MjData pair, seen as an equilibrium problem.

The residual is M(q) qacc at zero velocity (`qfrc_smooth`), the equations of motion near an equilibrium are

    M dq'' + C dq' + K dq = 0,   K = -d tau/dq,  C = -d tau/dv,

with centred differences in the tangent space, all columns in one batched call. A Mechanism never remembers
parameter values: they are arguments of every method.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from mjcont import loading, rigid
from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.evaluation import Evaluator
from mjcont.mjcf import exact_text
from mjcont.numerics.differences import CENTRED, PARAMETER, Stencil, jacobian_from_rows, jacobian_steps, stencil
from mjcont.numerics.problem import Array, Linearization, Pencil, Values
from mjcont.observables import model_observables
from mjcont.parameters import Declaration, collect_parameters, make_parameter
from mjcont.paths import is_bush
from mjcont.quantities import Observable, Parameter
from mjcont.rows import one_sided
from mjcont.writer import FieldWriter, Gravity


class Mechanism:
    """A MuJoCo model as an equilibrium problem f(q, p) = 0 with named parameters and observables.

    Use `Mechanism.from_xml`, `from_spec` or `from_model` to make one.

    Attributes
    ----------
    name : str
    n : int
        Degrees of freedom (nv).
    parameters : dict of str to Parameter
        Declared in the model, every control, gravity_angle and load_factor.
    observables : dict of str to Observable
        Every sensor and joint position.
    declared : dict
        Parameters declared in Python or by path, as results store them.
    keyframes : dict of str to (nq,) array
    state_scale : (nv,) array
        1 rad for rotations, the model's size in metres for translations.
    mjcf : str or None
        The model's text; None for a Mechanism made from a compiled model.
    """

    second_order = True

    def __init__(self, model: mujoco.MjModel, mjcf: str | None = None) -> None:
        loading.refuse_unsupported(model)
        self.mjcf = mjcf
        self.name = loading.model_name(model)
        self.nq, self.n = model.nq, model.nv
        self.qpos0 = model.qpos0.copy()
        self._loaded = loading.copy_model(model)
        self._observed = model
        self._model = loading.evaluation_copy(model)
        self._flat = loading.coordinates_are_flat(model)
        self.state_scale = loading.state_scale(model)
        self.parameters = collect_parameters(self._model)
        self.observables = model_observables(model)
        self.declared: dict[str, Any] = {}
        self.keyframes = loading.keyframes(model)
        gravity = Gravity.of(model)
        self._writer = FieldWriter(self._model, self.parameters, gravity)
        self._sensor_writer = FieldWriter(self._observed, self.parameters, gravity)
        self._sensor_data = mujoco.MjData(self._observed)
        self.constrained = loading.is_constrained(model)
        self._evaluator = Evaluator(self._model, self._writer, self.constrained)
        self._held: tuple[str, ...] = ()

    # -- making one ----------------------------------------------------------------------------------------

    @classmethod
    def from_xml(cls, source: str | Path) -> Mechanism:
        """Load MJCF from a path, from XML text, or by the name of a model that ships with mjcont.

        Raises
        ------
        ModelError
            If the file does not exist, MuJoCo rejects it, or the model has a feature that cannot be treated.
        """
        text, folder = loading.read_source(source)
        spec = loading.parse(text, folder, str(source) if "<" not in str(source) else "XML text")
        return cls(loading.compile_spec(spec), loading.portable_text(spec, text))

    @classmethod
    def from_spec(cls, spec: mujoco.MjSpec) -> Mechanism:
        """Take an `MjSpec`; the spec itself is not kept."""
        model = loading.compile_spec(spec)
        return cls(model, exact_text(spec))

    @classmethod
    def from_model(cls, model: mujoco.MjModel) -> Mechanism:
        """Take a compiled model (copied). Its results cannot carry the MJCF: load them with `problem=`."""
        return cls(loading.copy_model(model))

    # -- parameters ----------------------------------------------------------------------------------------

    def declare(self, name: str, *paths: str, unit: str = "", bounds: tuple[float, float] | None = None) -> Parameter:
        """Declare a named parameter that acts on the fields given by `paths` and return it.

        Raises
        ------
        ParameterError
            If the name is in use, a path matches nothing, or its targets disagree with each other in the loaded model.
        """
        if name in self.parameters:
            raise ParameterError(f"parameter '{name}' is declared twice")
        parameter = make_parameter(self._model_as_loaded(), Declaration(name, unit, bounds, tuple(paths)))
        self.parameters[name] = parameter
        self.declared[name] = {"paths": list(paths), "unit": parameter.unit, "bounds": list(parameter.bounds)}
        return parameter

    def parameter(self, name: str) -> Parameter:
        """Return the parameter called `name`; a path such as `joint:hip.stiffness` is one, too."""
        if name not in self.parameters:
            if ":" not in name:
                raise unknown_name("parameter", name, self.parameters)
            self.declare(name, name)
        return self.parameters[name]

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the model's own for the others.

        Raises
        ------
        NameLookupError
            If a name is unknown; close matches and all valid names are listed.
        BoundsError
            If a control lies outside its range in the model, where MuJoCo would clamp it.
        """
        given = given or {}
        for name, value in given.items():
            parameter = self.parameter(name)
            if not np.isfinite(value):
                raise ParameterError(f"parameter '{name}': the value must be a finite number, got {value}")
            low, high = parameter.hard_bounds
            if not low <= value <= high:
                raise BoundsError(
                    f"{name} = {value:g} lies outside the actuator's ctrlrange [{low:g}, {high:g}], "
                    "where MuJoCo would clamp it"
                )
        merged = {name: p.value for name, p in self.parameters.items()}
        merged.update({name: float(v) for name, v in given.items()})
        return merged

    def _model_as_loaded(self) -> mujoco.MjModel:
        self._writer.write(self.parameters, self.values())
        return self._model

    # -- residual and derivatives ----------------------------------------------------------------------------

    def residual(self, x: Array, values: Values) -> Array:
        """Return the generalised forces M qacc at rest, (nv,), in N and N m."""
        self._writer.write(self.parameters, values)
        return self._evaluator.forces(x[None])[0].copy()

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the residual at x moved by each row of `steps` (m, nv), shape (m, nv)."""
        self._writer.write(self.parameters, values)
        return self._evaluator.forces(self._moved(x, steps)).copy()

    def acceleration(self, qpos: Array, qvel: Array, values: Values | None = None) -> Array:
        """Return qacc at a state of motion, (nv,), in m/s^2 and rad/s^2."""
        self._writer.write(self.parameters, self.values(values))
        return self._evaluator.accelerations(np.asarray(qpos)[None], np.asarray(qvel)[None])[0].copy()

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, spans: Sequence[float] = ()
    ) -> Linearization:
        """Return the residual with its derivatives in the state and in the parameters `wrt`."""
        rule = stencil(accurate)
        steps = jacobian_steps(self.state_scale, rule)
        self._writer.write(self.parameters, values)
        moved = np.concatenate([x[None], self._moved(x, steps)])
        rows = self._evaluator.forces(moved)
        f = rows[0].copy()
        jac = jacobian_from_rows(rows[1:], self.state_scale, rule)
        if self.constrained:
            jac = one_sided(jac, rows, self._evaluator.sides, steps)
        par = np.empty((self.n, len(wrt)))
        for k, name in enumerate(wrt):
            par[:, k] = self._parameter_derivative(x, values, name, f, spans[k] if spans else None)
        self._writer.write(self.parameters, values)
        if self._held:
            mass = self._evaluator.mass(x)
            jac = jac - rigid.rate(jac, mass) ** 2 * rigid.holding(mass, self._held_directions(x))
        return Linearization(f, jac, par)

    def parameter_stencil(self, name: str, value: float, span: float | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter.

        Forces are affine in controls, stiffnesses and the like, where two points are exact for any step.
        """
        parameter = self.parameters[name]
        size = max(abs(value), 1e-2 * (span or parameter.bounds[1] - parameter.bounds[0]))
        if parameter.affine:
            return CENTRED, max(1.0, abs(value)) if parameter.kind == "control" else 0.1 * size
        if parameter.unit == "rad":
            return PARAMETER, min(PARAMETER.step, PARAMETER.step * size * 100.0)
        return PARAMETER, PARAMETER.step * size

    def _parameter_derivative(self, x: Array, values: Values, name: str, f: Array, span: float | None) -> Array:
        """Return d tau/dp, (nv,); `f` is the residual at x, where affine forces need one more point only."""
        rule, h = self.parameter_stencil(name, values[name], span)
        if self.parameters[name].affine:
            self._writer.write(self.parameters, {**values, name: values[name] + h})
            return (self._evaluator.forces(x[None])[0] - f) / h
        total = np.zeros(self.n)
        for offset, weight in zip(rule.offsets, rule.weights, strict=True):
            self._writer.write(self.parameters, {**values, name: values[name] + offset * h})
            total += weight * self._evaluator.forces(x[None])[0]
        return total / h

    def pencil(self, x: Array, values: Values, jac: Array) -> Pencil:
        """Return mass, damping and stiffness matrices, (nv, nv) each; `jac` is the residual's Jacobian there."""
        self._writer.write(self.parameters, values)
        mass, damping = self._evaluator.mass(x), self._evaluator.damping(x, self.state_scale)
        if self._held:
            # critical damping: a held mode decays and can never look unstable or marginal
            damping = damping + 2.0 * rigid.rate(jac, mass) * rigid.holding(mass, self._held_directions(x))
        return Pencil(mass, damping, -jac)

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return (v, qacc) at steps (m, 2 nv) of position and velocity around rest at x, shape (m, 2 nv)."""
        self._writer.write(self.parameters, values)
        velocity = steps[:, self.n :]
        return np.hstack([velocity, self._evaluator.accelerations(self._moved(x, steps[:, : self.n]), velocity)])

    def periods(self, x: Array, values: Values) -> Array:
        """Return a full turn for each coordinate in which one changes no force, infinity for the others, (nv,)."""
        found = np.full(self.n, np.inf)
        self._writer.write(self.parameters, values)
        hinges = [j for j, (_, unit) in enumerate(self.state_labels) if unit == "rad" and self._flat]
        beside = self.retract(x, 0.1 * self.state_scale * np.cos(1.0 + np.arange(self.n)))
        turned = beside + 2.0 * np.pi * np.eye(self.nq)[hinges]
        rows = self._evaluator.forces(np.concatenate([beside[None], turned])).copy()
        change = np.abs(rows[1:] - rows[0]).max(axis=1, initial=0.0)
        for j, c in zip(hinges, change, strict=True):
            if c <= 1e-9 * np.abs(rows[0]).max():
                found[j] = 2.0 * np.pi
        return found

    # -- rigid-body zero modes -------------------------------------------------------------------------------

    def rigid_modes(self, x: Array, values: Values) -> tuple[str, ...]:
        """Return the names of the rigid-body motions that no force opposes near a state."""
        return rigid.zero_modes(self, x, values)

    @property
    def held(self) -> tuple[str, ...]:
        """The rigid-body modes that are held."""
        return self._held

    def rigid_directions(self, x: Array) -> dict[str, Array]:
        """Return the tangent vectors (nv,) that move the whole model as a rigid body, by name."""
        return rigid.twist_directions(self._model, self._evaluator.position(x))

    def holding(self, modes: Sequence[str]) -> Mechanism:
        """Return this mechanism with rigid-body modes held by a stiffness and damping of their own."""
        held = copy.copy(self)
        held._held = tuple(modes)
        return held

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a tangent step without its part along held rigid-body modes, which nothing else would correct."""
        if not self._held:
            return step
        return rigid.without_modes(step, self._evaluator.mass(x), self._held_directions(x))

    def _held_directions(self, x: Array) -> Array:
        directions = self.rigid_directions(x)
        found = [directions[m] for m in self._held if m in directions]
        return np.column_stack(found) if found else np.zeros((self.n, 0))

    # -- the manifold ----------------------------------------------------------------------------------------

    def retract(self, x: Array, step: Array) -> Array:
        """Return qpos moved by a tangent step, quaternions normalised."""
        if self._flat:
            return x + step
        moved = x.copy()
        mujoco.mj_integratePos(self._model, moved, step, 1.0)
        return moved

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step (nv,) from x0 to x1."""
        if self._flat:
            return x1 - x0
        step = np.empty(self.n)
        mujoco.mj_differentiatePos(self._model, step, 1.0, x0, x1)
        return step

    def _moved(self, x: Array, steps: Array) -> Array:
        if self._flat:
            return x + steps
        return np.array([self.retract(x, s) for s in steps])

    def active(self, x: Array, values: Values) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load at rest."""
        self._writer.write(self.parameters, values)
        return self._evaluator.active(x)

    @property
    def evaluations(self) -> int:
        """Forward evaluations so far; every row of a batch counts as one."""
        return self._evaluator.count

    # -- observables -----------------------------------------------------------------------------------------

    def observe(self, name: str, function: Callable[[Any, Any], float], unit: str = "") -> None:
        """Add an observable computed by `function(model, data)` from MuJoCo's model and data."""
        self.observables[name] = Observable(name, unit, function)

    def observable(self, name: str) -> Observable:
        """Return the observable called `name`."""
        if name not in self.observables:
            raise unknown_name("observable", name, self.observables)
        return self.observables[name]

    def measure(
        self,
        states: Array,
        values: Sequence[Values] | Values,
        names: Sequence[str] | None = None,
        velocities: Array | None = None,
    ) -> Array:
        """Return observables for states (m, nq), at rest unless velocities (m, nv) are given; default all of them."""
        chosen = [self.observable(n) for n in (names if names is not None else self.observables)]
        out = np.empty((len(states), len(chosen)))
        data = self._sensor_data
        for i, x in enumerate(states):
            self._sensor_writer.write(self.parameters, values if isinstance(values, Mapping) else values[i])
            data.qpos[:] = x
            data.qvel[:] = 0.0 if velocities is None else velocities[i]
            data.ctrl[:] = self._sensor_writer.ctrl
            mujoco.mj_forward(self._observed, data)
            out[i] = [o.function(self._observed, data) for o in chosen]
        return out

    # -- states ----------------------------------------------------------------------------------------------

    def simulation_model(self) -> mujoco.MjModel:
        """Return a copy of the model as loaded, for time histories; diverging motion is not reset silently."""
        return loading.simulation_copy(self._loaded)

    def start_state(self, keyframe: str | None = None, state: Array | None = None) -> Array:
        """Return a start: the state given, or a keyframe's, or qpos0.

        Raises
        ------
        NameLookupError
            If there is no such keyframe.
        ParameterError
            If `state` has the wrong shape.
        """
        if state is not None:
            x = np.array(state, dtype=float)
            if x.shape != (self.nq,):
                raise ParameterError(f"state must have shape ({self.nq},) for model '{self.name}', got {x.shape}")
            return x
        if keyframe is None:
            return self.qpos0.copy()
        if keyframe not in self.keyframes:
            raise unknown_name("keyframe", keyframe, self.keyframes)
        return self.keyframes[keyframe].copy()

    @property
    def state_labels(self) -> list[tuple[str, str]]:
        """Name and unit of each entry of qpos."""
        return loading.state_labels(self._model)

    @property
    def bushes(self) -> list[str]:
        """Names of the bush actuators."""
        names = [mujoco.mj_id2name(self._model, mujoco.mjtObj.mjOBJ_ACTUATOR, i) for i in range(self._model.nu)]
        return [n for i, n in enumerate(names) if is_bush(self._model, i)]

    def __str__(self) -> str:
        """List what can be continued, what can be read, and where to start."""
        return loading.describe(self)

    def __repr__(self) -> str:
        """Return a one-line description."""
        return f"<Mechanism '{self.name}': {self.n} DOF, {len(self.parameters)} parameters>"
