"""f and its derivatives at many states of a vectorized field, all differences in one call of its function."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.differences import FOURTH_ORDER, jacobian_steps, jacobians_from_rows
from mjcont.numerics.equations.problem import Array, Range, Stencil, Values

# values beside a parameter's own at which its derivative asks for f
_BESIDE = 4

# f (m, n) at states (m, n), values of parameters being numbers or (m,)
Rates = Callable[[Array, Mapping[str, Any]], Array]
# df/dp of those parameters, among some, for which the user gave it
Slopes = Callable[[Array, Values, Sequence[str]], Mapping[str, Array]]
# the difference rule and step for a parameter's value within a range
Rule = Callable[[str, float, Range | None], tuple[Stencil, float]]


def linearized(
    rates: Rates, rule: Rule, scale: Array, slopes: Slopes, jacobian: Callable[[Array, Values], Any] | None,
    states: Array, values: Values, columns: Mapping[str, Array], ranges: Mapping[str, Range | None],
) -> tuple[Array, Any, Array]:
    """Return f (m, n), df/du (m, n, n), a list where it is sparse, and df/dp (m, n, k) at states (m, n).

    The k parameters have values of their own in each state, `columns` (m,), and move within `ranges`. The rules and
    steps are those of a single state, so that what is found is, too. The user's own `jacobian` and `slopes` are asked
    state by state.
    """
    m, n = states.shape
    every = [{**values, **{name: float(c[i]) for name, c in columns.items()}} for i in range(m)]
    own = [slopes(x, v, tuple(columns)) for x, v in zip(states, every, strict=True)]
    sought = {name: column for name, column in columns.items() if name not in own[0]}
    steps = np.empty((0, n)) if jacobian else jacobian_steps(scale, FOURTH_ORDER)
    first = 1 + len(steps)
    moved = np.repeat(states[:, None], first + _BESIDE * len(sought), axis=1)
    moved[:, 1:first] += steps
    given: dict[str, Any] = {**values, **{name: np.repeat(c, moved.shape[1]) for name, c in columns.items()}}
    weights = np.zeros((len(sought), m, 1 + _BESIDE))
    for k, (name, column) in enumerate(sought.items()):
        beside = given[name].reshape(m, -1)[:, first + _BESIDE * k :]
        for i, value in enumerate(column.tolist()):
            stencil, h = rule(name, value, ranges[name])
            inside = len(stencil.offsets) > _BESIDE  # a one-sided rule begins with f itself
            beside[i, :_BESIDE] += np.array(stencil.offsets[inside:]) * h
            weights[k, i, 1 - inside :] = np.array(stencil.weights) / h
    found = rates(moved.reshape(-1, n), given).reshape(m, -1, n)
    f = found[:, 0]
    par = {name: np.array([each[name] for each in own]) for name in own[0]}
    for k, name in enumerate(sought):
        beside = found[:, first + _BESIDE * k : first + _BESIDE * (k + 1)]
        par[name] = weights[k, :, :1] * f + (weights[k, :, 1:, None] * beside).sum(axis=1)
    slope = np.stack([par[name] for name in columns], axis=2) if columns else np.empty((m, n, 0))
    if jacobian is None:
        return f, jacobians_from_rows(found[:, 1:first], scale, FOURTH_ORDER), slope
    jacs = [jacobian(x, v) for x, v in zip(states, every, strict=True)]
    return f, jacs if sparse.issparse(jacs[0]) else np.array(jacs), slope
