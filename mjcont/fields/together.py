"""f and its derivatives at many states of a vectorized field, all differences in one call of its function."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.differences import FOURTH_ORDER, jacobian_steps, jacobians_from_rows
from mjcont.numerics.equations.problem import Array, Range, Stencil, Values

# values beside a parameter's own at which its derivative asks for f
_BESIDE = 4

# f (m, n) at states (m, n), values of parameters being numbers or (m,)
Rates = Callable[[Array, Mapping[str, Any]], Array]
# the difference rule and step for a parameter's value within a range
Rule = Callable[[str, float, Range | None], tuple[Stencil, float]]


def linearized(
    rates: Rates, rule: Rule, scale: Array, states: Array, values: Values, columns: Mapping[str, Array],
    ranges: Mapping[str, Range | None], jacobian: Callable[[Array, Values], Any] | None = None,
) -> tuple[Array, Any, Array]:
    """Return f (m, n), df/du (m, n, n), a list where it is sparse, and df/dp (m, n, k) at states (m, n).

    The k parameters have values of their own in each state, `columns` (m,), and move within `ranges`. The rules and
    steps are those of a single state, so that what is found is, too. A `jacobian` of the user's is asked state by
    state.
    """
    m, n = states.shape
    steps = np.empty((0, n)) if jacobian else jacobian_steps(scale, FOURTH_ORDER)
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
    if jacobian is None:
        return f, jacobians_from_rows(found[:, 1:first], scale, FOURTH_ORDER), par
    every = [{**values, **{name: float(c[i]) for name, c in columns.items()}} for i in range(m)]
    jacs = [jacobian(x, v) for x, v in zip(states, every, strict=True)]
    return f, jacs if sparse.issparse(jacs[0]) else np.array(jacs), par
