"""A model in motion, as the verbs for periodic motion see it: a `Flow` with names, observables and forcing."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import numpy as np

from mjcont.numerics.equations.differences import PARAMETER, kept_within
from mjcont.numerics.equations.problem import Array, Range, Stencil, Values
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.path import Path
from mjcont.oscillation.forced import FREQUENCY, Forcing, forcing_parameter, split
from mjcont.results.model import Model
from mjcont.results.orbits import CYCLES, RESPONSES, Chart, Reading
from mjcont.results.quantities import Parameter, finite

# speed, relative to what a state's own size would bring about, that counts as none
_AT_REST = 1e-6
# states at which damping is looked for, and the part of stiffness that counts as none
_BESIDE, _NONE = 3, 1e-9


class ModelFlow(Flow):
    """The motion of a model.

    Attributes
    ----------
    model : the Mechanism or VectorField.
    forcing : what drives it, or None.
    chart : what the coordinates are of, where a model's state is no vector; None where states are the model's own.
    """

    model: Model
    forcing: Forcing | None
    chart: Chart | None = None

    def about(self, state: Array) -> ModelFlow:
        """Return the same motion in coordinates about a state of the model (nq,), or one with velocities."""
        del state
        return self

    @property
    def curve(self) -> str:
        """What a curve of its orbits is called."""
        return RESPONSES if self.forced else CYCLES

    @abstractmethod
    def measured(self, states: Array, phases: Array, values: Values) -> Array:
        """Return all observables at states (k, d) and phases (k,), shape (k, number of observables)."""

    @abstractmethod
    def repeated(self) -> ModelFlow:
        """Return the same motion with twice the period, where that is known."""

    @abstractmethod
    def turns(self, state: Array, values: Values) -> Array:
        """Return a full turn for each entry of a state that is an angle, infinity for the others, (d,)."""

    def at_rest(self, state: Array, values: Values) -> bool:
        """Whether a state (d,) is one of rest, but for rounding, and stays one nearby."""
        rates = self.derivatives(state[None], np.zeros(1), values, (), False)
        speed = rates.value[0] if self.order == 1 else np.concatenate([state[self.c :], rates.value[0]])
        size = np.abs(rates.jac[0]) @ self.scale
        size = size if self.order == 1 else np.concatenate([self.scale[self.c :], size])
        return bool(np.all(np.abs(speed) <= _AT_REST * np.maximum(size, 1e-300)))

    def undamped(self, state: Array, values: Values) -> bool:
        """Whether no rate depends on velocities at rest, near a state (d,): a mechanism that loses no energy."""
        if self.order == 1:
            return False
        states = np.tile(state, (_BESIDE, 1))
        states[:, : self.c] += self.scale[: self.c] * 0.1 * np.cos(np.arange(_BESIDE)[:, None] + np.arange(self.c))
        states[:, self.c :] = 0.0
        jac = self.derivatives(states, np.zeros(_BESIDE), values, (), False).jac
        sizes = self.scale[self.c :]
        return bool(np.abs(jac[..., self.c :] * sizes).max() <= _NONE * np.abs(jac[..., : self.c] * sizes).max())

    def resting(self, state: Array, values: Values) -> Array:
        """Return a whole state (d,) from a model's (nq,), or from one with velocities, at rest in what is not given."""
        del values
        return np.concatenate([state, np.zeros(self.d - len(state))])

    @property
    def activated(self) -> int:
        """How many of a state's last entries are activations of actuators."""
        return 0

    def state(self, state: Array) -> Array:
        """Return the model's state (nq,) of a state (d,)."""
        return state[: self.c].copy()

    @property
    def evaluations(self) -> int:
        """Number of evaluations of the model so far."""
        return self.model.evaluations

    @property
    def failure(self) -> str:
        """Why the model had no value, a clause."""
        return self.model.failure

    def parameter(self, name: str) -> Parameter:
        """Return a parameter by its name: of the forcing, or the model's own."""
        return forcing_parameter(self.model, self.forcing, name)

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""
        numbers = {n: finite(f"parameter '{n}': the value", v) for n, v in (given or {}).items()}
        theirs, own = split(numbers, self.forcing)
        found = self.model.values(theirs)
        for name, p in (self.forcing.parameters if self.forcing is not None else {}).items():
            found[name] = own.get(name, p.value)
            p.check(found[name])
        return found

    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        if self.forcing is None or name not in self.forcing.parameters:
            return self.model.parameter_stencil(name, value, bounds)
        low, high = bounds if bounds is not None else self.forcing.parameters[name].bounds
        step = PARAMETER.step * max(abs(value), 1e-2 * (high - low))
        return kept_within(PARAMETER, step, value, (low, high))

    def period(self, values: Values) -> float:
        """Return the period of the forcing, s."""
        assert self.forcing is not None
        return self.forcing.period(values)

    def period_rate(self, values: Values, name: str) -> float:
        """Return the derivative of the period in a parameter."""
        assert self.forcing is not None
        return self.forcing.period_rate(values, name)

    def acts(self, name: str) -> bool:
        """Whether the rates at a phase depend on a parameter: on a frequency they do not."""
        return self.forcing is None or name != FREQUENCY

    def driven(self, phases: Array, values: Values) -> dict[str, Array]:
        """Return the values of driven parameters at phases (m,), (m,) each."""
        return {} if self.forcing is None else self.forcing.driven(phases, values)

    def theirs(self, values: Values) -> dict[str, float]:
        """Return the values of the model's own parameters."""
        return split(values, self.forcing)[0]

    def record(self) -> dict[str, Any]:
        """Return what files keep of the forcing."""
        return {} if self.forcing is None else self.forcing.record()

    def reading(self, path: Path, values: Values) -> Reading:
        """Return the observables along an orbit."""
        names = tuple(self.model.observables)
        units = tuple(o.unit for o in self.model.observables.values())
        points = self.measured(path.states(path.points), path.points, values)
        return Reading(names, units, points, self.measured(path.s, path.mesh, values))

    def units(self) -> dict[str, str]:
        """Return the units of all parameters and observables."""
        found = {n: self.parameter(n).unit for n in self.values()}
        return found | {o.name: o.unit for o in self.model.observables.values()}
