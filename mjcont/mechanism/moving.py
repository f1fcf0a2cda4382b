"""A mechanism in motion: accelerations and their derivatives at many states, inputs differing from state to state.

M(q) q'' = tau(q, v),   derivatives by centred differences in q and v, in batches of a fixed number of rows
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

from mjcont.mechanism.mechanism import Mechanism
from mjcont.numerics.equations.differences import FOURTH_ORDER, SECOND_ORDER, jacobian_steps
from mjcont.numerics.equations.problem import Array, Values

# rows of a batch; a step in velocity, relative to the state's scale in 1/s: accelerations are quadratic in it
_ROWS, _SPEED = 100, 1e-2

_DISABLE = mujoco.mjtDisableBit
Driven = Mapping[str, Array]


class Moving:
    """Accelerations of a mechanism; its parameters have the values given, but for those that are driven.

    `driven` maps names of parameters to values of their own in each state, (m,). Where a limit or contact carries load,
    a cable is slack or an actuator saturates, there is no value, and `failure` is a clause that names it.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        self._mechanism, self._core, self.n = mechanism, mechanism._core, mechanism.n
        self._scale = mechanism.state_scale
        self.failure = ""

    def accelerations(self, states: Array, values: Values, driven: Driven) -> Array:
        """Return qacc at states (m, 2 nv) of position and velocity, (m, nv)."""
        return self._each(states[:, None, :], values, driven)[:, 0]

    def derivatives(self, states: Array, values: Values, driven: Driven, accurate: bool) -> tuple[Array, Array]:
        """Return qacc (m, nv) and its derivatives in position and velocity (m, nv, 2 nv)."""
        rule, n = FOURTH_ORDER if accurate else SECOND_ORDER, self.n
        in_place = jacobian_steps(self._scale, rule)
        in_speed = np.concatenate([o * _SPEED * np.diag(self._scale) for o in SECOND_ORDER.offsets])
        steps = np.zeros((1 + len(in_place) + len(in_speed), 2 * n))
        steps[1 : 1 + len(in_place), :n], steps[1 + len(in_place) :, n:] = in_place, in_speed
        rows = self._each(states[:, None, :] + steps, values, driven)
        places = rows[:, 1 : 1 + len(in_place)].reshape(len(states), len(rule.offsets), n, n)
        speeds = rows[:, 1 + len(in_place) :].reshape(len(states), 2, n, n)
        over_q = np.einsum("o,mokf->mfk", np.array(rule.weights), places) / (rule.step * self._scale)
        over_v = np.einsum("o,mokf->mfk", np.array(SECOND_ORDER.weights), speeds) / (_SPEED * self._scale)
        return rows[:, 0], np.concatenate([over_q, over_v], axis=2)

    def _each(self, states: Array, values: Values, driven: Driven) -> Array:
        """Return qacc at states (m, k, 2 nv), the k of one m sharing its inputs, (m, k, nv)."""
        m, k, _ = states.shape
        core, parameters = self._core, self._mechanism.parameters
        flat = states.reshape(m * k, -1)
        together = not core.evaluator.one_by_one
        if not driven or (together and all(core.writer.alone(parameters, name) for name in driven)):
            core.writer.write(parameters, values)
            controls = None
            if driven:
                controls = np.empty((m, core.model.nu))
                controls[:] = core.writer.inputs.ctrl
                for name, column in driven.items():
                    for target in parameters[name].targets:
                        for i in target.index:
                            controls[:, i] += target.factor * (column - values[name])
                controls = np.repeat(controls, k, axis=0)
            return self._rows(flat, controls).reshape(m, k, self.n)
        found = np.empty((m, k, self.n))
        for i in range(m):
            core.writer.write(parameters, {**values, **{name: float(column[i]) for name, column in driven.items()}})
            found[i] = self._rows(states[i], None)
        return found

    def _rows(self, states: Array, controls: Array | None) -> Array:
        """Return qacc at states (m, 2 nv), in batches of one size, the last one filled up with its last row."""
        found, evaluator = np.empty((len(states), self.n)), self._core.evaluator
        size = min(_ROWS, len(states))
        for first in range(0, len(states), size):
            here = np.minimum(np.arange(first, first + size), len(states) - 1)
            count = min(size, len(states) - first)
            ctrl = None if controls is None else controls[here]
            rows = evaluator.accelerations(states[here, : self.n], states[here, self.n :], ctrl)
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
    if m.na:
        return "an actuator has a state of its own (a filter, muscle or integrator): make it a motor"
    if m.nq != m.nv:
        return "it has ball or free joints, whose rotations need charts: use hinges and slides"
    return ""
