"""A model's motion without what takes energy from it or brings it in, as nonlinear modes ask for.

What is left is the part of the rates that is the same when a motion is run backwards: (a(q, v) + a(q, -v)) / 2.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.errors import FunctionError, MjcontError, ParameterError, StartError, leaves_domain
from mjcont.numerics.equations.differences import FOURTH_ORDER, SECOND_ORDER, jacobian_steps
from mjcont.numerics.equations.problem import Array, Range, Ranges, Stencil, Values
from mjcont.numerics.equations.starts import find_start
from mjcont.numerics.orbits.conserved import ENERGY, FREQUENCY, ConservativeFlow
from mjcont.numerics.orbits.flow import Flow, Rates
from mjcont.numerics.orbits.path import Path
from mjcont.oscillation.fields import FieldFlow
from mjcont.oscillation.flows import ModelFlow
from mjcont.results.orbits import MODES
from mjcont.results.quantities import Parameter
from mjcont.vectorfield import VectorField

CHOICES = (ENERGY, FREQUENCY)
_POSITIVE = (1e-300, 1e300)
# states in which laws are looked for, how far from rest, and what counts as none of the largest
_SAMPLES, _BESIDE, _NONE = 4, (0.1, 1e-2, 1e-3, 1e-4), 1e-9
# what remains of the energy's rate, of the largest of its terms, by rounding of differences
_KEPT = 1e-6
# points of the quadrature of a field's work
_QUADRATURE = 24
Energy = Callable[[Array, Values], Array]


class Conserving(ModelFlow, ConservativeFlow):
    """The motion of a model that keeps its energy.

    Parameters
    ----------
    inner : the motion with all there is.
    energy : from states (m, d) to energies (m,).
    chosen_by : "energy" or "frequency".
    even : whether what depends on the direction of motion is taken out.
    rest : (d,) the state from which energy counts.
    """

    forced = False

    def __init__(self, inner: ModelFlow, energy: Energy, chosen_by: str, even: bool, rest: Array) -> None:
        self.inner, self.model, self.forcing = inner, inner.model, None
        self.chosen_by, self.even, self.rest = chosen_by, even, rest
        self.order, self.c, self.scale, self.chart = inner.order, inner.c, inner.scale, inner.chart
        self._energy, self._moves = energy, has_velocities(inner, rest)
        self.energy_unit = "" if isinstance(inner, FieldFlow) else "J"
        unit = "Hz" if chosen_by == FREQUENCY else self.energy_unit
        self._own = Parameter(chosen_by, unit, 1.0, _POSITIVE, "forcing", hard_bounds=_POSITIVE,
                              limit="the positive numbers")

    def chosen(self, by: str) -> Conserving:
        """Return the same motion with orbits told by another number."""
        return type(self)(self.inner, self._energy, by, self.even, self.rest)

    @property
    def curve(self) -> str:
        """What a curve of its orbits is called."""
        return MODES

    # -- rates -------------------------------------------------------------------------------------------------

    @property
    def _back(self) -> Array:
        """What running backwards multiplies a state by, (d,)."""
        return np.repeat([1.0, -1.0], self.d // 2)

    def rates(self, states: Array, phases: Array, values: Values) -> Array:
        """Return the rates at states (m, d), shape (m, c)."""
        theirs = self.theirs(values)
        found = self.inner.rates(states, phases, theirs)
        if not self.even:
            return found
        back = self._back
        return 0.5 * (found - back[-self.c :] * self.inner.rates(back * states, phases, theirs))

    def derivatives(
        self, states: Array, phases: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> Rates:
        """Return these rates with their derivatives, always accurate: multipliers are to stay on the unit circle."""
        del accurate
        theirs, names = self.theirs(values), [n for n in wrt if n != self.chosen_by]
        kept = tuple(r for r, n in zip(ranges, wrt, strict=True) if n != self.chosen_by) if ranges else ()
        found = self.inner.derivatives(states, phases, theirs, names, True, kept)
        if self.even:
            back = self._back
            other = self.inner.derivatives(back * states, phases, theirs, names, True, kept)
            turned = back[-self.c :]
            found = Rates(
                0.5 * (found.value - turned * other.value),
                0.5 * (found.jac - turned[:, None] * other.jac * back),
                0.5 * (found.par - turned[:, None] * other.par),
            )
        par = np.zeros((len(states), self.c, len(wrt)))
        par[:, :, [k for k, n in enumerate(wrt) if n != self.chosen_by]] = found.par
        return replace(found, par=par)

    def unfolding(self, states: Array, values: Values) -> Array:
        """Return the velocity as an acceleration, or the energy's gradient over squares of scales."""
        if self.order == 2:
            return states[:, self.c :]
        if self._moves:
            half = self.c // 2
            return np.hstack([np.zeros((len(states), half)), states[:, half:]])
        return self.scale**2 * self._slopes(states, values, SECOND_ORDER)

    # -- coordinates -------------------------------------------------------------------------------------------

    def state(self, state: Array) -> Array:
        """Return the model's state (nq,) of a state (d,)."""
        return self.inner.state(state)

    def shown(self, state: Array) -> Array:
        """Return a state (d,) in coordinates that a user knows."""
        return self.inner.shown(state)

    def centred(self, path: Path) -> Flow:
        """Return the same motion in coordinates that suit an orbit better, or itself."""
        other = self.inner.centred(path)
        if other is self.inner:
            return self
        assert isinstance(other, ModelFlow)
        return conserving(other, self.chosen_by, self.even, other.resting(self.state(self.rest), {}))

    def taken(self, path: Path, flow: Flow) -> Path:
        """Return an orbit in the coordinates of `flow` as one in these."""
        assert isinstance(flow, Conserving)
        return self.inner.taken(path, flow.inner)

    # -- energy ------------------------------------------------------------------------------------------------

    def energies(self, states: Array, values: Values) -> Array:
        """Return the energy beyond that at rest, (m,)."""
        found = self._energy(np.vstack([states, self.rest]), self.theirs(values))
        return found[:-1] - found[-1]

    def energy_slopes(self, states: Array, values: Values) -> Array:
        """Return its derivatives in the state, (m, d)."""
        return self._slopes(states, values, FOURTH_ORDER)

    def _slopes(self, states: Array, values: Values, rule: Stencil) -> Array:
        sizes = np.maximum(self.scale, np.sqrt((states**2).mean(axis=0)))
        steps = jacobian_steps(sizes, rule)
        moved = (states[:, None, :] + steps).reshape(-1, self.d)
        rows = self._energy(moved, self.theirs(values)).reshape(len(states), len(rule.offsets), self.d)
        found: Array = np.einsum("o,mod->md", np.array(rule.weights), rows) / (rule.step * sizes)
        return found

    def energy_rate(self, state: Array, values: Values, name: str) -> float:
        """Return its derivative in a parameter, at a state (d,)."""
        rule, h = self.parameter_stencil(name, values[name])
        at = [float(self.energies(state[None], {**values, name: values[name] + o * h})[0]) for o in rule.offsets]
        return float(np.dot(rule.weights, at) / h)

    # -- names -------------------------------------------------------------------------------------------------

    def theirs(self, values: Values) -> dict[str, float]:
        """Return the values of the model's own parameters."""
        return {n: v for n, v in values.items() if n != self.chosen_by}

    def parameter(self, name: str) -> Parameter:
        """Return a parameter of the model, or what tells orbits apart."""
        return self._own if name == self.chosen_by else self.inner.parameter(name)

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter."""
        own = float((given or {}).get(self.chosen_by, self._own.value))
        self._own.check(own)
        return {**self.inner.values(self.theirs(given or {})), self.chosen_by: own}

    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        if name == self.chosen_by:
            return SECOND_ORDER, 1e-4 * abs(value)
        return self.inner.parameter_stencil(name, value, bounds)

    def measured(self, states: Array, phases: Array, values: Values) -> Array:
        """Return all observables at states (k, d), shape (k, number of observables)."""
        return self.inner.measured(states, phases, self.theirs(values))

    def repeated(self) -> Conserving:
        """Return the same motion: its orbits have whatever period they have."""
        return self

    def turns(self, state: Array, values: Values) -> Array:
        """Return a full turn for each angle, infinity for other entries, (d,)."""
        return self.inner.turns(state, self.theirs(values))

    @property
    def touches(self) -> str:
        """What a motion touched last, a clause."""
        return self.inner.touches

    @property
    def failure(self) -> str:
        """Why the motion had no value, a clause."""
        return self.inner.failure

    def record(self) -> dict[str, Any]:
        """Return what files keep of it."""
        return {"conserves": {"chosen_by": self.chosen_by, "even": self.even, "rest": self.state(self.rest).tolist()}}


# -- from a model ----------------------------------------------------------------------------------------------


def conserving(inner: ModelFlow, chosen_by: str, even: bool, rest: Array) -> Conserving:
    """Return a model's motion that keeps energy.

    Raises
    ------
    ParameterError
        If a parameter of the model has the name of what tells orbits apart.
    MjcontError
        If no energy is known.
    """
    model = inner.model
    if chosen_by in model.parameters:
        raise ParameterError(f"the model has a parameter '{chosen_by}', which modes need for themselves: rename it "
                             f"where it is declared, such as to '{chosen_by}_0'")
    energy = _energy_of_field(inner, rest) if isinstance(inner, FieldFlow) else _energy_of_mechanism(inner)
    return Conserving(inner, energy, chosen_by, even, rest)


def _energy_of_mechanism(inner: ModelFlow) -> Energy:
    from mjcont.mechanism.energy import energy_in_motion  # MuJoCo is imported only where there is a Mechanism

    n, model, chart = inner.c, inner.model, inner.chart

    def energy(states: Array, values: Values) -> Array:
        places, speeds = states[:, :n], states[:, n:]
        if chart is None:
            return energy_in_motion(model, places, speeds, values)
        moving = chart.moving(places, speeds)
        return energy_in_motion(model, moving.poses, moving.speeds, values)

    return energy


def _energy_of_field(inner: FieldFlow, rest: Array) -> Energy:
    """Return a field's energy: as its user gave it, or kinetic energy of unit masses and the work of their forces."""
    field = inner.field
    if field.energy is not None:
        return lambda states, values: _given_energy(field, states, values)
    if not has_velocities(inner, rest):
        raise MjcontError(f"the energy of {field.name} is not known: give it, VectorField(..., energy=lambda u, p: ..)")
    at, weights = np.polynomial.legendre.leggauss(_QUADRATURE)
    at, weights, n = 0.5 * (1.0 + at), 0.5 * weights, inner.c // 2

    def energy(states: Array, values: Values) -> Array:
        way = states[:, :n] - rest[:n]
        between = np.zeros((len(states), len(at), 2 * n))
        between[:, :, :n] = rest[:n] + at[:, None] * way[:, None, :]
        forces = inner.rates(between.reshape(-1, 2 * n), np.zeros(between.shape[0] * len(at)), values)[:, n:]
        work = np.einsum("k,mkc,mc->m", weights, forces.reshape(len(states), len(at), n), way)
        found: Array = 0.5 * (states[:, n:] ** 2).sum(axis=1) - work
        return found

    return energy


def _given_energy(field: VectorField, states: Array, values: Values) -> Array:
    assert field.energy is not None
    found = np.full(len(states), np.nan)
    for i, u in enumerate(states):
        try:
            found[i] = float(field.energy(u, values))
        except MjcontError:
            raise
        except Exception as error:
            if not leaves_domain(error):
                what = f"the energy of {field.name} raised {type(error).__name__}: {error}"
                raise FunctionError(what) from error
    return found


def samples(flow: ModelFlow, rest: Array) -> list[Array]:
    """Return states around rest in motion, (k, d) each, nearer and nearer to it."""
    waves = np.cos(1.0 + np.arange(_SAMPLES)[:, None] + 1.7 * np.arange(flow.d))
    return [rest + size * flow.scale * waves for size in _BESIDE]


def has_velocities(flow: ModelFlow, rest: Array) -> bool:
    """Whether a state is places and velocities, one after the other, q' = v."""
    if flow.order == 2:
        return True
    states, values = samples(flow, rest)[0], flow.values()
    if flow.c % 2:
        return False
    half = flow.c // 2
    found = flow.rates(states, np.zeros(len(states)), values)[:, :half]
    return bool(np.abs(found - states[:, half:]).max() <= _NONE * np.abs(states[:, half:]).max())


def loses(flow: ModelFlow, rest: Array, values: Values) -> bool:
    """Whether motions run backwards are no motions: something resists them."""
    if not has_velocities(flow, rest):
        return False
    back = np.repeat([1.0, -1.0], flow.d // 2)
    for states in samples(flow, rest):
        phases = np.zeros(len(states))
        ahead = flow.rates(states, phases, values)
        odd = ahead + back[-flow.c :] * flow.rates(back * states, phases, values)
        if np.isfinite(ahead).all() and np.isfinite(odd).all():
            return bool(np.abs(odd).max() > _NONE * np.abs(ahead).max())
    return False


def keeps_energy(flow: Conserving, values: Values) -> bool:
    """Whether the energy does not change along motions around rest."""
    for states in samples(flow, flow.rest):
        rates = flow.rates(states, np.zeros(len(states)), values)
        if flow.order == 2:
            rates = np.hstack([states[:, flow.c :], rates])
        powers = flow.energy_slopes(states, values) * rates
        if np.isfinite(powers).all():
            return bool((np.abs(powers.sum(axis=1)) <= _KEPT * np.abs(powers).sum(axis=1)).all())
    return False


def flow_as_recorded(inner: ModelFlow, record: Mapping[str, Any]) -> Conserving:
    """Return the motion as files keep it."""
    rest = inner.resting(np.array(record["rest"], dtype=float), {})
    return conserving(inner, record["chosen_by"], bool(record["even"]), rest)


# -- what is left out ------------------------------------------------------------------------------------------


def without_losses(
    inner: ModelFlow, x: Array, values: Values, chosen_by: str
) -> tuple[Conserving, dict[str, float], list[str]]:
    """Return the motion that keeps energy, its parameter values, and sentences on what is left out.

    Raises
    ------
    MjcontError, StartError
        If none does, or nothing rests.
    """
    flow, even = _conserving(inner, x, values, chosen_by)
    left = _names_of_losses(inner, values) if even else []
    if not keeps_energy(flow, values):
        controls = [n for n, p in inner.model.parameters.items() if p.kind == "control" and values[n] != 0.0]
        still = {**values, **dict.fromkeys(controls, 0.0)}
        bad = [n for n in controls if not _keeps(inner, x, {**still, n: values[n]}, chosen_by)]
        values = {**values, **dict.fromkeys(bad, 0.0)}
        left += [f"input {n}, which has no potential" for n in bad]
        flow, _ = _conserving(inner, x, values, chosen_by)
        if not bad or not keeps_energy(flow, values):
            raise MjcontError(f"the energy of {inner.model.name} changes along its motions, also without what resists "
                              "them: modes want forces with a potential")
    notes = [f"left out: {'; '.join(left)}"] if left else []
    return flow, dict(values), notes


def _keeps(inner: ModelFlow, x: Array, values: Values, chosen_by: str) -> bool:
    try:
        return keeps_energy(_conserving(inner, x, values, chosen_by)[0], values)
    except StartError:
        return False


def _conserving(inner: ModelFlow, x: Array, values: Values, chosen_by: str) -> tuple[Conserving, bool]:
    found = find_start(inner.model, x, values)
    if found.failure is not None:
        raise StartError(f"no equilibrium found at which modes could begin: {found.failure}")
    inner = inner.about(found.x)
    rest = inner.resting(found.x, values)
    even = loses(inner, rest, values)
    return conserving(inner, chosen_by, even, rest), even


def _names_of_losses(inner: ModelFlow, values: Values) -> list[str]:
    otherwise = ["what depends on the direction of motion"]
    if isinstance(inner, FieldFlow):
        return otherwise
    from mjcont.mechanism.moving import losses  # MuJoCo is imported only where there is a Mechanism

    return losses(inner.model, values) or otherwise
