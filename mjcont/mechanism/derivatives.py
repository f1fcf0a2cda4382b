"""Derivatives of a model's forces by differences: all columns of df/dx in one batch, loads riding along."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.mechanism.evaluation import Evaluator
from mjcont.mechanism.sides import difference_rule, on_one_side, parameter_rate
from mjcont.mechanism.writer import FieldWriter
from mjcont.numerics.equations.differences import FORWARD, jacobian_from_rows, jacobian_steps, stencil
from mjcont.numerics.equations.problem import Array, Linearization, Range, Ranges, Stencil, Values
from mjcont.results.quantities import Parameter

# states whose derivatives share a batch, where they have few degrees of freedom
_TOGETHER, _SMALL = 4, 40
# numbers of states in a batch
_SIZES = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)


@dataclass(slots=True)
class Derivatives:
    """Differences of the forces that an evaluator computes.

    Attributes
    ----------
    scale : (nv,) typical size of each tangent coordinate.
    moved : from a state and tangent steps (m, nv) to states (m, nq).
    failure : why the model does not compile at a point of the last stencil; empty if it does.
    """

    evaluator: Evaluator
    writer: FieldWriter
    parameters: Mapping[str, Parameter]
    scale: Array
    moved: Callable[[Array, Array], Array]
    failure: str = ""

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges
    ) -> Linearization:
        """Return the forces with their derivatives in the state and in the parameters `wrt`."""
        rule, self.failure = stencil(accurate), ""
        steps = jacobian_steps(self.scale, rule)
        self.writer.write(self.parameters, values)
        smooth = not self.evaluator.nonsmooth
        within = dict(zip(wrt, ranges or [None] * len(wrt), strict=True))
        riders = [n for n in wrt if smooth and self.writer.alone(self.parameters, n)]
        rows, rates = self._with_riders(x, values, self.moved(x, steps), {n: within[n] for n in riders})
        f, sides = rows[0].copy(), self.evaluator.sides
        jac = jacobian_from_rows(rows[1:], self.scale, rule)
        if sides and not self.writer.failure:
            jac = on_one_side(jac, rows, sides, steps, lambda finer: self._pieces(x, finer), accurate)
        piece = b"".join(sides[:1])
        if len(riders) == len(wrt):
            return Linearization(f, jac, rates.T, piece)
        par = np.empty((len(f), len(wrt)))
        for k, name in enumerate(wrt):
            if name in riders:
                par[:, k] = rates[riders.index(name)]
            else:
                par[:, k] = self._in_parameter(x, values, name, f, within[name], piece)
        self.writer.write(self.parameters, values)
        return Linearization(f, jac, par, piece)

    def _with_riders(
        self, x: Array, values: Values, moved: Array, riders: Mapping[str, Range | None]
    ) -> tuple[Array, Array]:
        """Return forces at x and at `moved`, and their rates (len(riders), nv) in controls that ride in the batch."""
        count = 1 + len(moved)
        states = np.empty((count + len(riders), len(x)))
        states[:], states[1:count] = x, moved
        if not riders:
            return self.evaluator.forces(states), np.empty((0, len(self.scale)))
        ctrl = np.empty((len(states), self.evaluator.model.nu))
        ctrl[:] = self.writer.inputs.ctrl
        steps = []
        for k, name in enumerate(riders, count):
            steps.append(self.rule(name, values[name], riders[name])[1])
            for target in self.parameters[name].targets:
                for i in target.index:
                    ctrl[k, i] += target.factor * steps[-1]
        rows = self.evaluator.forces(states, ctrl=ctrl)
        return rows[:count], (rows[count:] - rows[0]) / np.array(steps)[:, None]

    def side_by_side(self, name: str) -> bool:
        """Whether rows of one batch may differ in a parameter."""
        return not self.evaluator.nonsmooth and self.writer.alone(self.parameters, name)

    def along(self, states: Array, values: Values, columns: Mapping[str, Array]) -> Array:
        """Return forces at states (m, nq), parameters having values of their own in each (m,), shape (m, nv)."""
        found = np.empty((len(states), len(self.scale)))
        if not all(map(self.side_by_side, columns)):
            for i in range(len(states)):
                own = {name: float(column[i]) for name, column in columns.items()}
                self.writer.write(self.parameters, {**values, **own})
                found[i] = self.evaluator.forces(states[i][None])[0]
            return found
        controls, first, count = self.writer.controls(self.parameters, values, columns), 0, len(states)
        while first < count:  # in batches of few sizes, so that they are kept
            size = next((s for s in _SIZES if s >= count - first), _SIZES[-1])
            rows = np.minimum(np.arange(first, first + size), count - 1)
            found[first : first + size] = self.evaluator.forces(states[rows], ctrl=controls[rows])[: count - first]
            first += size
        return found

    def linearize_along(
        self, states: Array, values: Values, name: str, column: Array, bounds: Range | None
    ) -> tuple[Array, Array, Array] | None:
        """Return forces (m, nv) and their derivatives in the state (m, nv, nv) and in a parameter (m, nv).

        The parameter has a value of its own in each state (m, nq). None where a batch cannot tell.
        """
        if not self.side_by_side(name):
            return None
        rule, n = stencil(False), len(self.scale)
        h = np.array([self.rule(name, value, bounds)[1] for value in column.tolist()])
        steps = np.zeros((2 * n + 2, n))
        steps[1:-1] = jacobian_steps(self.scale, rule)
        controls = self.writer.controls(self.parameters, values, {name: np.repeat(column, len(steps))})
        for target in self.parameters[name].targets:
            controls[len(steps) - 1 :: len(steps), target.index] += target.factor * h[:, None]
        moved = self.moved(np.repeat(states, len(steps), axis=0), np.tile(steps, (len(states), 1)))
        rows, at = np.empty((len(states), len(steps), n)), 0
        together = _TOGETHER if n <= _SMALL else 1
        while at < len(states):  # batches of few sizes only
            count = together if len(states) - at >= together else 1
            part = slice(at * len(steps), (at + count) * len(steps))
            rows[at : at + count] = self.evaluator.forces(moved[part], ctrl=controls[part]).reshape(count, -1, n)
            at += count
        f = rows[:, 0]
        jac = (rows[:, 1 : n + 1] - rows[:, n + 1 : -1]) * (rule.weights[0] / (rule.step * self.scale))[:, None]
        return f, jac.transpose(0, 2, 1), (rows[:, -1] - f) / h[:, None]

    def rule(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        return difference_rule(self.parameters[name], value, bounds)

    def _in_parameter(
        self, x: Array, values: Values, name: str, f: Array, bounds: Range | None, side: bytes
    ) -> Array:
        """Return d forces/dp, (nv,); `f` are the forces at x, on the smooth piece `side`."""

        def at(offset: float) -> tuple[Array, bytes]:
            self.writer.write(self.parameters, {**values, name: values[name] + offset})
            self.failure = self.failure or self.writer.failure
            return self.evaluator.forces(x[None])[0], b"".join(self.evaluator.sides)

        rule, h = self.rule(name, values[name], bounds)
        return parameter_rate(at, f, side, FORWARD if self.parameters[name].affine else rule, h)

    def _pieces(self, x: Array, steps: Array) -> tuple[Array, list[bytes]]:
        return self.evaluator.forces(self.moved(x, steps)).copy(), self.evaluator.sides
