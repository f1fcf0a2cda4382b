"""Many states of a vectorized field side by side: f, and its derivatives by differences in one call of its function."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.differences import FOURTH_ORDER, jacobian_steps, jacobians_from_rows
from mjcont.numerics.equations.problem import Array, Linearization, Range, Ranges, Stencil, Values
from mjcont.results.model import Model

# values beside a parameter's own at which its derivative asks for f
_BESIDE = 4
# unknowns up to which matrices of many points are held, and numbers that are asked for in one call at most
_MOST, _NUMBERS = 200, 2**21

# f (m, n) at states (m, n), values of parameters being numbers or (m,)
Rates = Callable[[Array, Mapping[str, Any]], Array]
# the difference rule and step for a parameter's value within a range
Rule = Callable[[str, float, Range | None], tuple[Stencil, float]]


def linearized(
    rates: Rates, rule: Rule, scale: Array, states: Array, values: Values, columns: Mapping[str, Array],
    ranges: Mapping[str, Range | None],
) -> tuple[Array, Array, Array]:
    """Return f (m, n), df/du (m, n, n) and df/dp (m, n, k) at states (m, n).

    The k parameters have values of their own in each state, `columns` (m,), and move within `ranges`. The rules and
    steps are those of a single state, so that what is found is, too.
    """
    m, n = states.shape
    steps = jacobian_steps(scale, FOURTH_ORDER)
    first = 1 + len(steps)
    moved = np.repeat(states[:, None], first + _BESIDE * len(columns), axis=1)
    moved[:, 1:first] += steps
    given: dict[str, Any] = dict(values)
    weights = np.zeros((len(columns), m, 1 + _BESIDE))
    for k, (name, column) in enumerate(columns.items()):
        rows = np.repeat(column[:, None], moved.shape[1], axis=1)
        beside = rows[:, first + _BESIDE * k :]
        for i, value in enumerate(column.tolist()):
            stencil, h = rule(name, value, ranges[name])
            own = len(stencil.offsets) > _BESIDE  # a one-sided rule begins with f itself
            beside[i, :_BESIDE] += np.array(stencil.offsets[own:]) * h
            weights[k, i, 1 - own :] = np.array(stencil.weights) / h
        given[name] = rows.ravel()
    found = rates(moved.reshape(-1, n), given).reshape(m, -1, n)
    f, par = found[:, 0], np.empty((m, n, len(columns)))
    for k in range(len(columns)):
        beside = found[:, first + _BESIDE * k : first + _BESIDE * (k + 1)]
        par[:, :, k] = weights[k, :, :1] * f + (weights[k, :, 1:, None] * beside).sum(axis=1)
    return f, jacobians_from_rows(found[:, 1:first], scale, FOURTH_ORDER), par


class SideBySide(Model):
    """A model whose function may take many states at once, as columns.

    Attributes
    ----------
    vectorized : whether it does.
    """

    vectorized: bool

    @property
    @abstractmethod
    def differenced(self) -> bool:
        """Whether all derivatives are differences of a vectorized function: one call has them."""

    @abstractmethod
    def rates_together(self, states: Array, values: Mapping[str, Any], times: float | Array = 0.0) -> Array:
        """Return f at states (m, n), (m, n); parameter values and times are numbers, or (m,) where they differ."""

    def side_by_side(self, name: str) -> bool:
        """Whether the function takes many states at once, and matrices are dense and not too large."""
        del name
        return self.vectorized and self.n <= _MOST and not self._sparse

    @cached_property
    def _sparse(self) -> bool:
        """Whether df/du is sparse, as it is at the start."""
        return self.own_jacobian and sparse.issparse(self.linearize(self.start_state(), self.values(), ()).jac)

    def residuals_along(self, states: Array, values: Values, columns: Mapping[str, Array]) -> Array:
        """Return f at states (m, n), parameters having values of their own in each (m,), by name, shape (m, n)."""
        if not self.vectorized:
            return super().residuals_along(states, values, columns)
        return self.rates_together(states, {**values, **columns})

    def linearize_along(
        self, states: Array, values: Values, name: str, column: Array, bounds: Range | None = None
    ) -> tuple[Array, Array, Array] | None:
        """Return f (m, n), df/du (m, n, n) and df/dp (m, n) at such states; None where side by side gains nothing."""
        if not self.side_by_side(name):
            return None
        if self.differenced:
            many, parts = max(_NUMBERS // (self.n * (5 + 4 * self.n)), 1), list[tuple[Array, Array, Array]]()
            for first in range(0, len(states), many):
                part = slice(first, first + many)
                parts.append(self._linearized(states[part], values, {name: column[part]}, {name: bounds}))
            f, jac, par = (np.concatenate(each) for each in zip(*parts, strict=True))
            return f, jac, par[:, :, 0]
        every = [
            self.linearize(x, {**values, name: v}, (name,), ranges=(bounds,))
            for x, v in zip(states, column.tolist(), strict=True)
        ]
        return np.array([e.f for e in every]), np.array([e.jac for e in every]), np.array([e.par[:, 0] for e in every])

    def by_one_call(self, x: Array, values: Values, wrt: Sequence[str], ranges: Ranges) -> Linearization:
        """Return f, df/du and df/dp where all are differences of a vectorized function."""
        columns = {name: np.array([values[name]]) for name in wrt}
        within = dict(zip(wrt, ranges or [None] * len(wrt), strict=True))
        return Linearization(*(part[0] for part in self._linearized(x[None], values, columns, within)))

    def _linearized(
        self, states: Array, values: Values, columns: Mapping[str, Array], ranges: Mapping[str, Range | None]
    ) -> tuple[Array, Array, Array]:
        given = self.rates_together, self.parameter_stencil, self.state_scale
        return linearized(*given, states, values, columns, ranges)
