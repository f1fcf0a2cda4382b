"""A mechanism in motion: q'' = qacc(q, v) with inputs that may be periodic, and what it must not have for that."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.mechanism.moving import Moving, unfit_for_orbits
from mjcont.numerics.equations.problem import Array, Ranges, Values
from mjcont.numerics.orbits.flow import Rates
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.forced import Forcing
from mjcont.results.model import Model


class MechanismFlow(ModelFlow):
    """The motion of a mechanism whose forces are smooth."""

    order = 2

    def __init__(self, mechanism: Mechanism, forcing: Forcing | None = None) -> None:
        self.model, self.forcing = mechanism, forcing
        self.mechanism, self._moving = mechanism, Moving(mechanism)
        self.c, self.forced = mechanism.n, forcing is not None
        self.scale = np.concatenate([mechanism.state_scale, mechanism.state_scale])

    @property
    def touches(self) -> str:
        """What a motion touched last, a clause."""
        return self._moving.failure

    @property
    def failure(self) -> str:
        """Why the motion had no value, a clause."""
        return self.touches or self.mechanism.failure

    def turns(self, state: Array, values: Values) -> Array:
        """Return a full turn for each angle in which one changes no force, infinity for the others, (2 nv,)."""
        places = self.mechanism.periods(state[: self.c], self.theirs(values))
        return np.concatenate([places, np.full(self.c, np.inf)])

    def repeated(self) -> MechanismFlow:
        """Return the same motion with twice the period of the forcing."""
        f = self.forcing
        return MechanismFlow(self.mechanism, None if f is None else Forcing(f.inputs, f.parameters, 2 * f.periods))

    def rates(self, states: Array, phases: Array, values: Values) -> Array:
        """Return qacc at states (m, 2 nv) and phases (m,), shape (m, nv)."""
        return self._moving.accelerations(states, self.theirs(values), self.driven(phases, values))

    def derivatives(
        self, states: Array, phases: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> Rates:
        """Return qacc with its derivatives: second order in position, or fourth where `accurate`."""
        value, jac = self._moving.derivatives(states, self.theirs(values), self.driven(phases, values), accurate)
        par = np.zeros((len(states), self.c, len(wrt)))
        for k, name in enumerate(wrt):
            if not self.acts(name):
                continue
            rule, h = self.parameter_stencil(name, values[name], ranges[k] if ranges else None)
            at = [self.rates(states, phases, {**values, name: values[name] + o * h}) if o else value
                  for o in rule.offsets]
            par[:, :, k] = np.tensordot(rule.weights, np.array(at), axes=1) / h
        return Rates(value, jac, par)

    def measured(self, states: Array, phases: Array, values: Values) -> Array:
        """Return all observables at states (k, 2 nv) and phases (k,), shape (k, number of observables)."""
        theirs, driven = self.theirs(values), self.driven(phases, values)
        rows = [{**theirs, **{n: float(column[i]) for n, column in driven.items()}} for i in range(len(states))]
        return self.mechanism.measure(states[:, : self.c], rows, None, states[:, self.c :])


def mechanism_flow(problem: Model, forcing: Forcing | None = None) -> MechanismFlow:
    """Return the motion of a mechanism.

    Raises
    ------
    MjcontError
        If it has what the equations of smooth motion do not know.
    """
    assert isinstance(problem, Mechanism)
    unfit = unfit_for_orbits(problem)
    if unfit:
        raise MjcontError(f"periodic motion of {problem.name} cannot be followed: {unfit}")
    return MechanismFlow(problem, forcing)
