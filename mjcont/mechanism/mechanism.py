"""`Mechanism`: the sole owner of an MjModel/MjData pair, seen as an equilibrium problem.

The residual is M(q) qacc at zero velocity (`qfrc_smooth`), the equations of motion near an equilibrium are

    M dq'' + C dq' + K dq = 0,   K = -d tau/dq,  C = -d tau/dv,

with centred differences in the tangent space, all columns in one batched call. A Mechanism never remembers
parameter values: they are arguments of every method.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from mjcont.arguments import checked
from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.mechanism.core import copy_model, evaluation_copy, is_constrained, owned_copy
from mjcont.mechanism.declarations import Declaration
from mjcont.mechanism.geometry import Geometry, refuse_overlap
from mjcont.mechanism.observables import Observed, model_observables
from mjcont.mechanism.parameters import collect_parameters, declared_parameter
from mjcont.mechanism.sharing import Shareable
from mjcont.mechanism.summary import describe
from mjcont.mechanism.zeromodes import whole as rigid
from mjcont.mechanism.zeromodes.parts import Held
from mjcont.models import features, loading
from mjcont.models.actuators import bush_names
from mjcont.models.manifold import Manifold
from mjcont.models.states import (
    checked_state,
    coordinate_labels,
    keyframes,
    model_name,
    state_labels,
    state_scale,
)
from mjcont.numerics.equations.problem import Array, Linearization, Pencil, Range, Ranges, Stencil, Values, Variants
from mjcont.results.model import Model
from mjcont.results.quantities import Parameter, check_name, check_values, told_apart
from mjcont.results.text import ParameterTable


class Mechanism(Shareable, Observed, Held, Model):
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
        Every sensor and joint position. One that is called like a parameter is `joint:NAME` or `sensor:NAME`.
    declared : dict
        Parameters declared in Python or by path, as results store them.
    keyframes : dict of str to (nq,) array
    state_scale : (nv,) array
        1 rad for rotations, the model's size in metres for translations.
    mjcf : str or None
        The model's text; None for a Mechanism made from a compiled model.
    notes : tuple of str
        What its user should know of: files that are not there, friction that is left out, activations.
    """

    second_order = True
    parameters: ParameterTable
    declared: dict[str, Any]

    @checked
    def __init__(
        self,
        model: mujoco.MjModel,
        mjcf: str | None = None,
        friction: str = "frictionless",
        notes: Sequence[str] = (),
        geometry: Geometry | None = None,
    ) -> None:
        features.refuse_unsupported(model)
        self.notes = (*notes, *features.friction_notes(model, friction), *features.activation_notes(model))
        model = owned_copy(model)
        self.mjcf = mjcf
        self.name = model_name(model)
        self.nq, self.n = model.nq, model.nv
        self.qpos0 = model.qpos0.copy()
        self._manifold = Manifold(model)
        self.state_scale = state_scale(model)
        geometry = geometry or Geometry(None)
        self.parameters = collect_parameters(evaluation_copy(copy_model(model)), geometry)
        self.observables = told_apart(model_observables(model), self.parameters)
        self.declared = {}
        self.keyframes = keyframes(model)
        self.constrained = is_constrained(model)
        self._passive = features.passive(model) and all(map(features.stays_passive, self.parameters.values()))
        self._held: tuple[str, ...] = ()
        self._friction = friction
        self._own(model, geometry)

    # -- making one ----------------------------------------------------------------------------------------

    @classmethod
    def from_xml(cls, source: str | Path, *, friction: str = "frictionless") -> Mechanism:
        """Load MJCF from a path, from XML text, or by the name of a model that ships with mjcont.

        Friction carries no load at rest in MuJoCo, where it creeps. With `friction` "frictionless" it is left out of
        equilibria and their stability, with a ModelWarning for dry friction; with "refuse" it is an error.

        Raises
        ------
        ModelError
            If the file does not exist, MuJoCo rejects it, or the model has a feature that cannot be treated.
        """
        loaded = loading.load(source)
        geometry = Geometry(loaded.spec, loaded.folder)
        return cls(loaded.model, loaded.text, friction, loaded.notes, geometry)

    @classmethod
    @checked
    def from_spec(cls, spec: mujoco.MjSpec, *, friction: str = "frictionless") -> Mechanism:
        """Take an `MjSpec` (copied), without what needs files that are not there."""
        loaded = loading.load_spec(spec)
        return cls(loaded.model, loaded.text, friction, loaded.notes, Geometry(loaded.spec))

    @classmethod
    @checked
    def from_model(cls, model: mujoco.MjModel, *, friction: str = "frictionless") -> Mechanism:
        """Take a compiled model (copied). Its results cannot carry the MJCF: load them with `problem=`."""
        return cls(model, friction=friction)

    # -- parameters ----------------------------------------------------------------------------------------

    @checked
    def declare(
        self,
        name: str,
        *paths: str,
        unit: str = "",
        bounds: tuple[float, float] | None = None,
        function: Callable[[Any, float], None] | None = None,
        value: float | None = None,
    ) -> Parameter:
        """Declare a named parameter and return it.

        Parameters
        ----------
        paths : str
            Fields such as `joint:hip.stiffness`, or `spec:geom:rod.size[0]`, with which the model is compiled anew. An
            actuator's control gets a unit and bounds under its own name with the path `control:NAME`.
        function : callable, optional
            Instead of paths: `function(spec, value)` edits a copy of the `MjSpec`; `value` is the parameter's own.

        Raises
        ------
        ParameterError
            If the name is in use, a path matches nothing, or its targets disagree with each other in the loaded model.
        """
        with self._cores.lock:
            known = self.parameters.get(name)
            own = known.targets[0].path if known is not None and known.kind == "control" else ""
            if known is not None and (name in self.declared or not own or paths != (own,)):
                said = f': its control may get a unit and bounds with the path "{own}"' if own else ""
                raise ParameterError(f"parameter '{name}' is declared twice{said}")
            if bounds is not None and np.shape(bounds) != (2,):
                raise BoundsError(f"bounds of {name} must be two numbers (low, high), got {bounds!r}")
            given, core = Declaration(name, unit, bounds, tuple(paths), function, value), self._core
            parameter = declared_parameter(core.as_loaded(), core.geometry, given)
            self.parameters[name] = parameter
            self._passive = self._passive and features.stays_passive(parameter)
            renamed = told_apart(self.observables, self.parameters)
            self.observables.clear()
            self.observables.update(renamed)
            self.declared[name] = given.record(parameter)
            if parameter.kind == "spec":
                self._cores.relayout()
        return parameter

    def parameter(self, name: str) -> Parameter:
        """Return the parameter called `name`; a path such as `joint:hip.stiffness` is one, too."""
        check_name(name)
        with self._cores.lock:
            if ":" in name and name not in self.parameters:
                self.declare(name, name)
        return Model.parameter(self, name)

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the model's own for the others.

        Raises
        ------
        NameLookupError
            If a name is unknown; close matches and all valid names are listed.
        BoundsError, ParameterError
            If MuJoCo would clamp a control there, or the model does not compile.
        """
        given = {} if given is None else given
        check_values(given)
        for name, value in given.items():
            self.parameter(name).check(value)
        merged = {name: p.value for name, p in list(self.parameters.items())}
        merged.update({name: float(v) for name, v in given.items()})
        if any(self.parameters[name].kind == "spec" for name in given):
            self._core.geometry.model(self.parameters, merged)
        return merged

    # -- residual and derivatives ----------------------------------------------------------------------------

    def residual(self, x: Array, values: Values) -> Array:
        """Return the generalised forces M qacc at rest, (nv,), in N and N m."""
        core = self._core
        core.writer.write(self.parameters, values)
        return core.evaluator.forces(x[None])[0].copy()

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the residual at x moved by each row of `steps` (m, nv), shape (m, nv)."""
        core = self._core
        core.writer.write(self.parameters, values)
        return core.evaluator.forces(self.retract_each(x, steps)).copy()

    @property
    def pieces(self) -> list[bytes]:
        """On which smooth piece of the forces each row of the last evaluation lies; empty where they are smooth."""
        return self._core.evaluator.sides

    def side_by_side(self, name: str) -> bool:
        """Whether states that differ in a parameter are evaluated in one batch: the forces are smooth, it a control."""
        return not self._held and self._core.derivatives.side_by_side(name)

    def residuals_along(self, states: Array, values: Values, columns: Mapping[str, Array]) -> Array:
        """Return the residual at states (m, nq), parameters having values of their own in each (m,), shape (m, nv)."""
        return self._core.derivatives.along(states, values, columns)

    def linearize_along(
        self, states: Array, values: Values, name: str, column: Array, bounds: Range | None = None
    ) -> tuple[Array, Array, Array] | None:
        """Return the residual and its derivatives in the state and in a parameter that differs between the states."""
        return None if self._held else self._core.derivatives.linearize_along(states, values, name, column, bounds)

    def together(self, names: Sequence[str]) -> int:
        """Return how many variants are evaluated in one batch: 1 unless forces are smooth and `names` are controls."""
        return self._core.variants.most if all(self.side_by_side(name) for name in names) else 1

    def variants(self, values: Sequence[Values], names: Sequence[str]) -> Variants:
        """Return the residuals of variants with these values, for use until the next call."""
        if self.together(names) == 1:
            return Model.variants(self, values, names)
        variants = self._core.variants
        variants.take(values, names)
        return variants

    def acceleration(self, qpos: Array, qvel: Array, values: Values | None = None) -> Array:
        """Return qacc at a state of motion, (nv,), in m/s^2 and rad/s^2."""
        every = self.values(values)
        core = self._core
        core.writer.write(self.parameters, every)
        return core.evaluator.accelerations(np.asarray(qpos)[None], np.asarray(qvel)[None])[0].copy()

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> Linearization:
        """Return the residual with its derivatives in the state and in the parameters `wrt`."""
        core = self._core
        refuse_overlap(self.parameters, values, tuple(wrt))
        found = core.derivatives.linearize(x, values, wrt, accurate, ranges)
        if not self._held:
            return found
        mass = core.evaluator.mass(x)
        held = rigid.rate(found.jac, mass) ** 2 * rigid.holding(mass, self._held_directions(x))
        return Linearization(found.f, found.jac - held, found.par, found.piece)

    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        return self._core.derivatives.rule(name, value, bounds)

    def pencil(self, x: Array, values: Values, jac: Array) -> Pencil:
        """Return mass, damping and stiffness matrices, (nv, nv) each; `jac` is the residual's Jacobian there."""
        core = self._core
        core.writer.write(self.parameters, values)
        mass, damping = core.evaluator.mass(x), core.evaluator.damping(x, self.state_scale)
        if self._held:
            # critical damping: a held mode decays and can never look unstable or marginal
            damping = damping + 2.0 * rigid.rate(jac, mass) * rigid.holding(mass, self._held_directions(x))
        return Pencil(mass, damping, -jac)

    @property
    def passive(self) -> bool:
        """Whether damping at rest is symmetric and positive semidefinite in every state (`features.passive`)."""
        return self._passive and not self.nonsmooth

    def pencils(self, states: Array, values: Sequence[Values], jacs: Sequence[Array]) -> list[Pencil]:
        """Return `pencil` at many equilibria of a passive mechanism."""
        core = self._core
        loads = {n for n, p in self.parameters.items() if p.kind in ("control", "gravity")}
        first = values[0]
        if self._held or any(v[n] != first[n] for v in values for n in first.keys() - loads):
            return [self.pencil(x, v, j) for x, v, j in zip(states, values, jacs, strict=True)]
        core.writer.write(self.parameters, first)
        evaluator, scale = core.evaluator, self.state_scale
        return [Pencil(evaluator.mass(x), evaluator.damping(x, scale), -j) for x, j in zip(states, jacs, strict=True)]

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return (v, qacc) at steps (m, 2 nv) of position and velocity around rest at x, shape (m, 2 nv)."""
        core = self._core
        core.writer.write(self.parameters, values)
        velocity = steps[:, self.n :]
        moved = self.retract_each(x, steps[:, : self.n])
        return np.hstack([velocity, core.evaluator.accelerations(moved, velocity)])

    def periods(self, x: Array, values: Values) -> Array:
        """Return a full turn for each coordinate in which one changes no force, infinity for the others, (nv,)."""
        return rigid.full_turns(self, x, values)

    # -- the manifold ----------------------------------------------------------------------------------------

    def retract(self, x: Array, step: Array) -> Array:
        """Return qpos moved by a tangent step, quaternions normalised."""
        return self._manifold.retract(x, step)

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step (nv,) from x0 to x1."""
        return self._manifold.difference(x1, x0)

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return the tangent steps (m, nv) that take states (m, nq), or one (nq,), to others."""
        return self._manifold.difference_each(ends, starts)

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return states (m, nq), or one (nq,), moved by the rows of tangent steps (m, nv)."""
        return self._manifold.retract_each(states, steps)

    def active(self, x: Array, values: Values) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load at rest."""
        core = self._core
        core.writer.write(self.parameters, values)
        return core.evaluator.active(x)

    # -- states ----------------------------------------------------------------------------------------------

    @checked
    def start_state(self, keyframe: str | None = None, state: Array | None = None) -> Array:
        """Return a start: the state given, or a keyframe's, or qpos0.

        Raises
        ------
        NameLookupError, ParameterError
            If there is no such keyframe, or `state` has the wrong shape.
        """
        if state is not None:
            return checked_state(self._core.model, state)
        if keyframe is None:
            return np.array(self.qpos0)
        if keyframe not in self.keyframes:
            raise unknown_name("keyframe", keyframe, self.keyframes)
        return np.array(self.keyframes[keyframe])

    @property
    def state_labels(self) -> list[tuple[str, str]]:
        """Name and unit of each entry of qpos."""
        return state_labels(self._core.model)

    @property
    def coordinates(self) -> list[tuple[str, str]]:
        """Name and unit of each tangent coordinate, (nv,)."""
        return coordinate_labels(self._core.model)

    def connections(self, x: Array, values: Values) -> Array:
        """Return gradients (r, nv) of what yields to carry load in a state: bushes, constraints, stops, contacts."""
        core = self._core
        core.writer.write(self.parameters, values)
        return core.evaluator.connections(x)

    @property
    def bushes(self) -> list[str]:
        """Names of the bush actuators."""
        return bush_names(self._core.model)

    def __str__(self) -> str:
        """List what can be continued, what can be read, and where to start."""
        values = self.measure(self.qpos0[None], self.values())[0]
        readings = zip(self.observables.values(), values.tolist(), strict=True)
        return describe(self.simulation_model(), self.constrained, self.parameters, readings, self.notes)

    def __repr__(self) -> str:
        """Return a one-line description."""
        return f"<Mechanism '{self.name}': {self.n} DOF, {len(self.parameters)} parameters>"
