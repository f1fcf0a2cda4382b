"""A mechanism in motion: accelerations and their derivatives at many states, inputs differing from state to state.

M(q) q'' = tau(q, v, a),  a' = g(a, input),   derivatives by centred differences, in batches of a fixed number of rows

with activations a of actuators that follow their control (filters, muscles) where there are any. Where there are ball
or free joints, q is a chart's coordinates.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.actuators import actuator_name, actuator_of, follower, integrator
from mjcont.models.manifold import chart_of
from mjcont.models.resistance import resistances
from mjcont.numerics.equations.differences import FOURTH_ORDER, SECOND_ORDER
from mjcont.numerics.equations.problem import Array, Values
from mjcont.results.model import Model
from mjcont.results.orbits import charts
from mjcont.results.orbits.charts import EDGE, Chart

# rows of a batch; a step in velocity, relative to the state's scale in 1/s: accelerations are quadratic in it
_ROWS, _SPEED = 100, 1e-2

_FAR = ("{} turns by almost a full turn, as far as its rotation vector tells it: begin amid its motion, or use hinges "
        "for a joint that goes round")
_TURNED_OVER = "the spring of {} turns over half a turn from where it is at rest"
_DISABLE = mujoco.mjtDisableBit
Driven = Mapping[str, Array]


class Moving:
    """Accelerations of a mechanism; its parameters have the values given, but for those that are driven.

    `driven` maps names of parameters to values of their own in each state, (m,). Where a limit or contact carries load,
    a cable is slack or an actuator saturates, or a rotation leaves its chart, there is no value, and `failure` is a
    clause that names it.

    Attributes
    ----------
    chart : coordinates of the poses, by default about qpos0; None where poses are vectors.
    n, na : numbers of coordinates, and of activations that follow a control.
    activation_scale : (na,) their typical sizes.
    """

    def __init__(self, mechanism: Mechanism, chart: Chart | None = None) -> None:
        self._mechanism, self._core, self.n = mechanism, mechanism._core, mechanism.n
        self._scale = mechanism.state_scale
        m, following = self._core.model, self._core.writer.inputs.following
        self.chart = chart or chart_of(m)
        self.na = len(following)
        self.activation_scale = np.array([_activation_size(m, actuator_of(m, "act", int(i))) for i in following])
        self.failure = ""

    def accelerations(self, states: Array, values: Values, driven: Driven) -> Array:
        """Return qacc and rates of activations at states (m, 2 nv + na) of position, velocity, activations."""
        return self._each(states[:, None, :], values, driven)[:, 0]

    def derivatives(self, states: Array, values: Values, driven: Driven, accurate: bool) -> tuple[Array, Array]:
        """Return qacc and rates of activations (m, nv + na) and their derivatives (m, nv + na, 2 nv + na)."""
        rule, n, d = FOURTH_ORDER if accurate else SECOND_ORDER, self.n, 2 * self.n + self.na
        parts = [  # where each group of entries stands, its rule, its step and its sizes
            (slice(0, n), rule, rule.step, self._scale),
            (slice(n, 2 * n), SECOND_ORDER, _SPEED, self._scale),
            (slice(2 * n, d), FOURTH_ORDER, FOURTH_ORDER.step, self.activation_scale),
        ]
        steps = [np.zeros((1, d))]
        for at, own, step, sizes in parts:
            moved = np.zeros((len(own.offsets) * len(sizes), d))
            moved[:, at] = np.concatenate([o * step * np.diag(sizes) for o in own.offsets])
            steps.append(moved)
        rows = self._each(states[:, None, :] + np.concatenate(steps), values, driven)
        found, first = [], 1
        for (_, own, step, sizes), moved in zip(parts, steps[1:], strict=True):
            here = rows[:, first : first + len(moved)].reshape(len(states), len(own.offsets), len(sizes), n + self.na)
            found.append(np.einsum("o,mokf->mfk", np.array(own.weights), here) / (step * sizes))
            first += len(moved)
        return rows[:, 0], np.concatenate(found, axis=2)

    def resting(self, values: Values) -> Array:
        """Return the activations at rest, (na,)."""
        self._core.writer.write(self._mechanism.parameters, values)
        return self._core.writer.inputs.resting.copy()

    def _each(self, states: Array, values: Values, driven: Driven) -> Array:
        """Return rates at states (m, k, 2 nv + na), the k of one m sharing its inputs, (m, k, nv + na)."""
        m, k, _ = states.shape
        core, parameters = self._core, self._mechanism.parameters
        flat = states.reshape(m * k, -1)
        together = not core.evaluator.one_by_one
        if not driven or (together and all(core.writer.alone(parameters, name) for name in driven)):
            core.writer.write(parameters, values)
            controls = np.repeat(core.writer.controls(parameters, values, driven), k, axis=0) if driven else None
            return self._rows(flat, controls).reshape(m, k, -1)
        found = np.empty((m, k, self.n + self.na))
        for i in range(m):
            core.writer.write(parameters, {**values, **{name: float(column[i]) for name, column in driven.items()}})
            found[i] = self._rows(states[i], None)
        return found

    def _rows(self, states: Array, controls: Array | None) -> Array:
        """Return rates at states (m, 2 nv + na)."""
        chart, n = self.chart, self.n
        x, v = states[:, :n], states[:, n : 2 * n]
        act = states[:, 2 * n :] if self.na else None
        if chart is None:
            return self._batched(x, v, act, controls)
        moving = chart.moving(x, v)
        found = self._batched(moving.poses, moving.speeds, act, controls)
        found[:, :n] = moving.bends(found[:, :n])
        self._leave_chart(found, chart, moving)
        return found

    def _batched(self, poses: Array, speeds: Array, activations: Array | None, controls: Array | None) -> Array:
        """Return qacc and rates of activations in batches of one size, the last filled up with its last row."""
        states, evaluator = poses, self._core.evaluator
        found = np.empty((len(states), self.n + self.na))
        size = min(_ROWS, len(states))
        for first in range(0, len(states), size):
            here = np.minimum(np.arange(first, first + size), len(states) - 1)
            count = min(size, len(states) - first)
            ctrl = None if controls is None else controls[here]
            act = None if activations is None else activations[here]
            rows = evaluator.accelerations(poses[here], speeds[here], ctrl, act)
            evaluator.count -= size - count
            found[first : first + count] = rows[:count]
            if evaluator.nonsmooth:
                self._leave_out(found[first : first + count], evaluator.touched(count))
        return found

    def _leave_out(self, rows: Array, touched: Sequence[frozenset[str]]) -> None:
        """Let rows in which something carries load have no value: motion is smooth where nothing does."""
        for row, names in zip(rows, touched, strict=True):
            if names:
                row[:] = np.nan
                self.failure = f"the orbit touches {', '.join(sorted(names))}"

    def _leave_chart(self, rows: Array, chart: Chart, moving: charts.Moving) -> None:
        """Let rows in which a rotation leaves its chart, or its spring turns over, have no value."""
        m = self._core.model
        own = m.dof_jntid[chart.places[:, 1]]
        beyond = [(_FAR, moving.angles > EDGE)]
        sprung = (m.jnt_stiffness[own] != 0.0) | m.jnt_stiffnesspoly[own].any(axis=1)
        if sprung.any():
            beyond.append((_TURNED_OVER, sprung & moving.past(m.qpos_spring[chart.places[:, :1] + np.arange(4)])))
        for clause, at in beyond:
            if at.any():
                rows[at.any(axis=1)] = np.nan
                self.failure = clause.format(", ".join(np.array(chart.joints)[at.any(axis=0)]))


def _activation_size(model: mujoco.MjModel, actuator: int) -> float:
    """Return the typical size of an activation: that of the range its control has, or one."""
    if not model.actuator_ctrllimited[actuator]:
        return 1.0
    return float(np.abs(model.actuator_ctrlrange[actuator]).max()) or 1.0


def _unfit_activation(model: mujoco.MjModel) -> str:
    """Return why an actuator's state is none that an orbit may have, with what to do; empty where all are."""
    for a in range(model.nactuator):
        if not model.actuator_actnum[a] or integrator(model, a):  # an integrator's setpoint is a parameter
            continue
        name = actuator_name(model, a)
        if not follower(model, a):
            return f"actuator {name} has a state that follows no control: make it a motor, a filter or a muscle"
        if model.actuator_actearly[a]:
            return f"actuator {name} acts early, by a time step: set actearly to false"
        muscle = model.actuator_dyntype[a] == int(mujoco.mjtDyn.mjDYN_MUSCLE)
        if muscle and model.actuator_dynprm[a, 0] != model.actuator_dynprm[a, 1] and model.actuator_dynprm[a, 2] <= 0.0:
            return f"muscle {name} switches between two time constants at once: give it a tausmooth"
    return ""


def losses(mechanism: Model, values: Values) -> list[str]:
    """Return what takes energy from a mechanism's motion at parameter values, a phrase each."""
    assert isinstance(mechanism, Mechanism)
    core = mechanism._core
    core.writer.write(mechanism.parameters, values)
    return resistances(core.model)


def has_activations(mechanism: Mechanism) -> bool:
    """Whether an actuator has a state of its own, which at rest follows its control."""
    return bool(mechanism._core.loaded.na)


def unfit_for_orbits(mechanism: Mechanism) -> str:
    """Return why a mechanism's periodic motion cannot be followed, with what to do; empty where it can."""
    m = mechanism._core.loaded
    off = int(m.opt.disableflags)
    constrained = not off & _DISABLE.mjDSBL_CONSTRAINT
    if constrained and m.neq and not off & _DISABLE.mjDSBL_EQUALITY:
        return "equality constraints are springs that its motion passes through: replace them by bushes (mjcont bush)"
    if constrained and m.dof_frictionloss.any() and not off & _DISABLE.mjDSBL_FRICTIONLOSS:
        return "dry friction (frictionloss) makes its motion smooth in pieces only: remove it, or use damping"
    if m.actuator_delay.any():
        return "an actuator acts with a delay: set delay to 0"
    if m.na and _unfit_activation(m):
        return _unfit_activation(m)
    return ""
