"""Reading observables: at one state after the other, or at many side by side where sensors and positions are all."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import unknown_name
from mjcont.numerics.problem import Array, Values
from mjcont.quantities import Observable, Parameter
from mjcont.rows import Rows
from mjcont.writer import FieldWriter

# rows of a batch, and the number of states from which on it pays
_ROWS, _MANY = 32, 8


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
        self._data = mujoco.MjData(model)
        self._rows: Rows | None = None

    def read(
        self,
        chosen: Sequence[Observable],
        states: Array,
        values: Sequence[Values] | Values,
        velocities: Array | None = None,
    ) -> Array:
        """Return observables for states (m, nq), at rest unless velocities (m, nv) are given, shape (m, chosen)."""
        out = np.full((len(states), len(chosen)), np.nan)
        data = self._data
        for i, x in enumerate(states):
            self._writer.write(self._parameters, values if isinstance(values, Mapping) else values[i])
            if self._writer.failure:
                continue
            data.qpos[:] = x
            data.qvel[:] = 0.0 if velocities is None else velocities[i]
            self._writer.inputs.put(data)
            mujoco.mj_forward(self._model, data)
            out[i] = [o.function(self._model, data) for o in chosen]
        return out

    def read_along(
        self, chosen: Sequence[Observable], states: Array, values: Values, name: str, column: Array
    ) -> Array:
        """Return observables at rest in states (m, nq), a parameter having a value of its own in each (m,)."""
        plain = all(o.source is not None for o in chosen) and not self._constrained
        if len(states) < _MANY or not plain or not self._writer.alone(self._parameters, name):
            return self.read(chosen, states, [{**values, name: v} for v in column.tolist()])
        controls = self._writer.controls(self._parameters, values, name, column)
        if self._rows is None:
            self._rows = Rows(self._model, _ROWS, None)
        sources = [o.source for o in chosen if o.source is not None]
        columns = [self._rows.field(field)[:, index] for field, index in sources]
        out = np.empty((len(states), len(chosen)))
        for first in range(0, len(states), _ROWS):
            here = np.minimum(np.arange(first, first + _ROWS), len(states) - 1)
            self._rows.forward(states[here], None, self._writer, controls[here])
            count = min(_ROWS, len(states) - first)
            for k, read in enumerate(columns):
                out[first : first + count, k] = read[:count]
        return out


class Observed:
    """What a Mechanism knows of its observables.

    Attributes
    ----------
    observables : dict of str to Observable
    """

    observables: dict[str, Observable]

    @property
    def _readings(self) -> Readings:
        raise NotImplementedError

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
        return self._readings.read(chosen, states, values, velocities)

    def measure_along(self, states: Array, values: Values, name: str, column: Array) -> Array:
        """Return all observables at rest in states (m, nq), a parameter having a value of its own in each (m,)."""
        return self._readings.read_along(list(self.observables.values()), states, values, name, column)
