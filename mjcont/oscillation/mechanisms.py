"""A mechanism in motion: q'' = qacc(q, v) with inputs that may be periodic, and what it must not have for that.

Where there are ball or free joints q and v are a chart's coordinates and their rates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.mechanism.moving import Moving, unfit_for_orbits
from mjcont.numerics.equations.problem import Array, Ranges, Values
from mjcont.numerics.orbits.flow import Flow, Rates
from mjcont.numerics.orbits.path import Path
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.forced import Forcing
from mjcont.results.model import Model
from mjcont.results.orbits import Chart


class MechanismFlow(ModelFlow):
    """The motion of a mechanism whose forces are smooth."""

    order = 2

    def __init__(self, mechanism: Mechanism, forcing: Forcing | None = None, chart: Chart | None = None) -> None:
        self.model, self.forcing = mechanism, forcing
        self.mechanism, self._moving = mechanism, Moving(mechanism, chart)
        self.chart = self._moving.chart
        self.c, self.forced = mechanism.n, forcing is not None
        self.scale = np.concatenate([mechanism.state_scale, mechanism.state_scale])

    @property
    def follows(self) -> bool:
        """Whether actuators have activations that follow their controls."""
        return self._moving.na > 0

    def _split(self, states: Array) -> tuple[Array, Array, Array | None]:
        """Return poses, velocities and activations (None where there are none) of states (k, d)."""
        n = self.mechanism.n
        places, speeds = states[:, :n], states[:, n : 2 * n]
        activations = states[:, 2 * n :] if self.activated else None
        if self.chart is None:
            return places, speeds, activations
        moving = self.chart.moving(places, speeds)
        return moving.poses, moving.speeds, activations

    # -- the chart's coordinates, where the mechanism's poses are no vectors ---------------------------------------

    def about(self, state: Array) -> MechanismFlow:
        """Return the same motion in coordinates about a pose (nq,), or one with velocities."""
        return self if self.chart is None else self._in(self.chart.about(state))

    def _in(self, chart: Chart) -> MechanismFlow:
        return type(self)(self.mechanism, self.forcing, chart)

    def centred(self, path: Path) -> Flow:
        """Return the same motion in a chart laid in the middle of an orbit, if the orbit comes near this one's edge."""
        other = self.chart and self.chart.centred(path.s[:, : self.mechanism.n])
        return self if other is self.chart or other is None else self._in(other)

    def taken(self, path: Path, flow: Flow) -> Path:
        """Return an orbit in the chart of `flow` as one in this one's."""
        assert isinstance(flow, MechanismFlow)
        chart, theirs = self.chart, flow.chart
        if chart is None or theirs is None or chart.same(theirs):
            return path
        n, places, lengths = self.mechanism.n, path.points, path.period * path.lengths

        def moved(states: Array) -> Array:
            x = states[:, :n]
            xi = chart.taken(x, theirs)
            slopes = chart.slopes(xi, theirs.speeds(x, states[:, n : 2 * n]))
            return np.hstack([xi, slopes, states[:, 2 * n :]])

        states, rates = path.states(places), path.rates(places)
        own, last = moved(states), slice(rates.shape[1] - n - self.activated, rates.shape[1] - self.activated)
        qacc = theirs.accelerations(states[:, :n], states[:, n : 2 * n], rates[:, last])
        rates[:, last] = chart.moving(own[:, :n], own[:, n : 2 * n]).bends(qacc)
        if path.order == 1:
            rates[:, :n] = own[:, n : 2 * n]
        w = rates.reshape(path.w.shape) * lengths[:, None, None] ** path.order
        return replace(path, s=moved(path.s), w=w)

    def _laid(self, state: Array) -> Array:
        """Return coordinates of a pose (nq,), with their rates where it has velocities beside it."""
        if self.chart is None:
            return state
        nq = self.mechanism.nq
        xi = self.chart.coordinates(state[None, :nq])
        given = len(state) > nq
        return np.concatenate([xi[0], *(self.chart.slopes(xi, state[None, nq:]) if given else ())])

    def resting(self, state: Array, values: Values) -> Array:
        """Return a whole state (d,) from a pose, or from one with velocities, at rest in what is not given."""
        return super().resting(self._laid(state), values)

    def state(self, state: Array) -> Array:
        """Return the mechanism's state (nq,) of a state (d,)."""
        return self._split(state[None])[0][0].copy()

    def shown(self, state: Array) -> Array:
        """Return pose, velocities and activations of a state (d,)."""
        return np.concatenate([part[0] for part in self._split(state[None]) if part is not None])

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
        places = self.mechanism.periods(self.state(state), self.theirs(values))
        return np.concatenate([places, np.full(self.d - len(places), np.inf)])

    def repeated(self) -> MechanismFlow:
        """Return the same motion with twice the period of the forcing."""
        f = self.forcing
        forcing = None if f is None else Forcing(f.inputs, f.parameters, 2 * f.periods)
        return type(self)(self.mechanism, forcing, self.chart)

    def rates(self, states: Array, phases: Array, values: Values) -> Array:
        """Return qacc at states (m, 2 nv) and phases (m,), shape (m, nv)."""
        return self._moving.accelerations(states, self.theirs(values), self.driven(phases, values))

    def derivatives(
        self, states: Array, phases: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> Rates:
        """Return qacc with its derivatives: second order in position, or fourth where `accurate`."""
        value, jac = self._moving.derivatives(states, self.theirs(values), self.driven(phases, values), accurate)
        par = self._over_parameters(states, phases, values, value, wrt, ranges)
        return Rates(value, jac, par)

    def _over_parameters(
        self, states: Array, phases: Array, values: Values, value: Array, wrt: Sequence[str], ranges: Ranges
    ) -> Array:
        """Return derivatives of the rates, whose value is given, in parameters, (m, c, k)."""
        par = np.zeros((len(states), self.c, len(wrt)))
        for k, name in enumerate(wrt):
            if not self.acts(name):
                continue
            rule, h = self.parameter_stencil(name, values[name], ranges[k] if ranges else None)
            at = [self.rates(states, phases, {**values, name: values[name] + o * h}) if o else value
                  for o in rule.offsets]
            par[:, :, k] = np.tensordot(rule.weights, np.array(at), axes=1) / h
        return par

    def measured(self, states: Array, phases: Array, values: Values) -> Array:
        """Return all observables at states (k, d) and phases (k,), shape (k, number of observables)."""
        places, speeds, activations = self._split(states)
        driven = self.driven(phases, values)
        return self.mechanism.measure_along(places, self.theirs(values), driven, speeds, activations)


class ActuatedFlow(MechanismFlow):
    """The motion of a mechanism with filters or muscles, whose activations join the state.

    q' = v,  v' = qacc(q, v, a),  a' = g(a, input)
    """

    order = 1

    def __init__(self, mechanism: Mechanism, forcing: Forcing | None = None, chart: Chart | None = None) -> None:
        super().__init__(mechanism, forcing, chart)
        self.c = 2 * mechanism.n + self._moving.na
        self.scale = np.concatenate([self.scale, self._moving.activation_scale])

    @property
    def activated(self) -> int:
        """How many of a state's last entries are activations of actuators."""
        return self._moving.na

    def resting(self, state: Array, values: Values) -> Array:
        """Return a whole state (d,), its activations at rest, from a pose or from one with velocities."""
        laid = self._laid(state)
        moving = np.concatenate([laid, np.zeros(2 * self.mechanism.n - len(laid))])
        return np.concatenate([moving, self._moving.resting(self.theirs(values))])

    def rates(self, states: Array, phases: Array, values: Values) -> Array:
        """Return velocities, qacc and rates of activations at states (m, d) and phases (m,), shape (m, d)."""
        n = self.mechanism.n
        return np.hstack([states[:, n : 2 * n], super().rates(states, phases, values)])

    def derivatives(
        self, states: Array, phases: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> Rates:
        """Return these rates with their derivatives."""
        n, m = self.mechanism.n, len(states)
        rates, jac = self._moving.derivatives(states, self.theirs(values), self.driven(phases, values), accurate)
        value = np.hstack([states[:, n : 2 * n], rates])
        upper = np.broadcast_to(np.eye(n, self.c, k=n), (m, n, self.c))
        par = self._over_parameters(states, phases, values, value, wrt, ranges)
        return Rates(value, np.concatenate([upper, jac], axis=1), par)


def mechanism_flow(problem: Model, forcing: Forcing | None = None, chart: Chart | None = None) -> MechanismFlow:
    """Return the motion of a mechanism, in a chart's coordinates where its poses are no vectors.

    Raises
    ------
    MjcontError
        If it has what the equations of smooth motion do not know.
    """
    assert isinstance(problem, Mechanism)
    unfit = unfit_for_orbits(problem)
    if unfit:
        raise MjcontError(f"periodic motion of {problem.name} cannot be followed: {unfit}")
    found = MechanismFlow(problem, forcing, chart)
    return ActuatedFlow(problem, forcing, chart) if found.follows else found
