"""A vector field in motion: u' = f(u, p, t), its rates and their derivatives at many points of an orbit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mjcont.errors import MjcontError, ParameterError
from mjcont.numerics.equations.algebra import dense
from mjcont.numerics.equations.differences import FOURTH_ORDER, PARAMETER, jacobian_steps
from mjcont.numerics.equations.problem import Array, Ranges, Values
from mjcont.numerics.orbits.flow import Rates
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.forced import Forcing
from mjcont.vectorfield import VectorField

# states in which an angle is told, and the change that counts as none
_BESIDE, _SAME = 4, 1e-9


class FieldFlow(ModelFlow):
    """The motion of a vector field, forced where it has a period."""

    order = 1

    def __init__(self, field: VectorField, forcing: Forcing | None = None, periods: int = 1) -> None:
        self.field = self.model = field
        self.forcing, self._periods = forcing, periods
        self.c, self.scale = field.n, field.typical
        self.forced = field.period is not None or forcing is not None

    def turns(self, state: Array, values: Values) -> Array:
        """Return a full turn for each component in which one changes nothing, though parts of one do, (n,)."""
        beside = state + self.scale * np.cos(1.0 + np.arange(_BESIDE)[:, None] + np.arange(self.c))
        phases, found = np.linspace(0.0, 1.0, _BESIDE), np.full(self.c, np.inf)
        here = self.rates(beside, phases, values)
        size = np.abs(here).max()
        for i in range(self.c):
            whole, part = (self.rates(beside + a * np.eye(self.c)[i], phases, values) for a in (2.0 * np.pi, 1.0))
            if np.abs(whole - here).max() <= _SAME * size and np.abs(part - here).max() > _SAME * size:
                found[i] = 2.0 * np.pi
        return found

    def repeated(self) -> FieldFlow:
        """Return the same motion with twice the period of the forcing."""
        f = self.forcing
        forcing = None if f is None else Forcing(f.inputs, f.parameters, 2 * f.periods)
        return FieldFlow(self.field, forcing, 2 * self._periods)

    def period(self, values: Values) -> float:
        """Return the period of the forcing, in s.

        Raises
        ------
        ParameterError
            If the user's function returns no positive number.
        """
        if self.field.period is None:
            return ModelFlow.period(self, values)
        try:
            found = float(self.field.period(values))
        except MjcontError:
            raise
        except Exception as error:
            raise ParameterError(f"the period of {self.field.name} raised {type(error).__name__}: {error}") from error
        if not 0.0 < found < np.inf:
            raise ParameterError(f"the period of {self.field.name} must be a positive number, got {found:g}")
        return self._periods * found

    def period_rate(self, values: Values, name: str) -> float:
        """Return the derivative of the period in a parameter."""
        if self.field.period is None:
            return ModelFlow.period_rate(self, values, name)
        rule, h = PARAMETER, PARAMETER.step * max(abs(values[name]), 1e-2)
        at = [self.period({**values, name: values[name] + o * h}) for o in rule.offsets]
        return float(np.dot(rule.weights, at) / h)

    def record(self) -> dict[str, Any]:
        """Return what files keep of the forcing."""
        return ModelFlow.record(self) or {"periods": self._periods}

    def _rows(self, phases: Array, values: Values) -> list[Values]:
        """Return the parameters at phases (m,)."""
        theirs, driven = self.theirs(values), self.driven(phases, values)
        if not driven:
            return [theirs] * len(phases)
        return [{**theirs, **{n: float(c[i]) for n, c in driven.items()}} for i in range(len(phases))]

    def rates(self, states: Array, phases: Array, values: Values) -> Array:
        """Return f at states (m, n) and phases (m,), shape (m, n)."""
        times = phases * self.period(values) if self.forced else np.zeros(len(states))
        rows = self._rows(phases, values)
        return self.field.rates(states, rows, times.tolist())

    def derivatives(
        self, states: Array, phases: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> Rates:
        """Return f with its derivatives, by fourth-order differences where the user gave none."""
        value = self.rates(states, phases, values)
        par = np.empty((len(states), self.c, len(wrt)))
        for k, name in enumerate(wrt):
            if not self.acts(name):
                par[:, :, k] = 0.0
                continue
            rule, h = self.parameter_stencil(name, values[name], ranges[k] if ranges else None)
            at = [self.rates(states, phases, {**values, name: values[name] + o * h}) if o else value
                  for o in rule.offsets]
            par[:, :, k] = np.tensordot(rule.weights, np.array(at), axes=1) / h
        return Rates(value, self._jacobians(states, phases, values), par)

    def _jacobians(self, states: Array, phases: Array, values: Values) -> Array:
        if self.field.jacobian is not None and not self.field.timed and self.forcing is None:
            found: list[Any] = [self.field.linearize(u, values, ()).jac for u in states]
            return np.array([dense(j) for j in found])
        rule, sizes = FOURTH_ORDER, np.maximum(self.scale, np.sqrt((states**2).mean(axis=0)))
        steps = jacobian_steps(sizes, rule)
        moved = (states[:, None, :] + steps).reshape(-1, self.c)
        rows = self.rates(moved, np.repeat(phases, len(steps)), values)
        rows = rows.reshape(len(states), len(rule.offsets), self.c, self.c)
        return np.einsum("o,mokf->mfk", np.array(rule.weights), rows) / (rule.step * sizes)

    def measured(self, states: Array, phases: Array, values: Values) -> Array:
        """Return all observables at states (k, n), shape (k, number of observables)."""
        return self.field.measure(states, self._rows(phases, values))
