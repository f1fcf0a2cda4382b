"""Functions of the user's own: how they are called, what they may return, and what is said when they do not.

A vectorized function takes states as columns, (n, m), as `scipy.integrate.solve_ivp` gives them, and parameters that
are numbers or, where they differ between the states, (m,).
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mjcont.errors import FunctionError
from mjcont.numerics.equations.problem import Array, Values

# states that tell whether a function takes them as columns, as parts of the scale beside one, and how well f agrees
_ASIDE, _AGREES = 1e-2, 1e-6


def raised(what: str, error: Exception, given: str = "") -> FunctionError:
    """Return the error for a function of the user's own that raised one; `what` names it, `given` what it was given."""
    return FunctionError(f"{what} raised {type(error).__name__}{given}: {error}")


def takes_time(function: Callable[..., Any]) -> bool:
    """Whether a function must be given three arguments."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return False
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(p.kind in positional and p.default is p.empty for p in parameters) == 3


def merged(values: Sequence[Values]) -> dict[str, Any]:
    """Return the parameters of many states as one mapping: a number where they agree, else (m,)."""
    first = values[0]
    if all(each is first for each in values):
        return dict(first)
    columns = {name: [each[name] for each in values] for name in first}
    return {n: c[0] if all(v == c[0] for v in c) else np.array(c, dtype=float) for n, c in columns.items()}


def as_columns(what: str, found: Any, n: int, m: int) -> Array:
    """Return what a vectorized function found for m states as rows, (m, n); entries of a list may be numbers.

    Raises
    ------
    FunctionError
        If it has another shape.
    """
    if isinstance(found, list | tuple) and len(found) == n:
        found = [np.broadcast_to(entry, m) if np.ndim(entry) == 0 else entry for entry in found]
    try:
        columns = np.array(found, dtype=float)
    except ValueError as error:
        shapes = ", ".join(str(np.shape(entry)) for entry in found)
        raise FunctionError(f"{what} returned entries of shapes {shapes} for {m} states at once: each must be a number "
                            f"or ({m},)") from error
    if columns.shape != (n, m):
        raise FunctionError(f"{what} is declared vectorized and returned shape {columns.shape} for u of shape "
                            f"{(n, m)}: expected {(n, m)}, a column for each state")
    return np.ascontiguousarray(columns.T)


def beside(x: Array, scale: Array) -> Array:
    """Return three states near one, (3, n), by which `check_columns` tells what a function makes of columns."""
    apart = np.cos(np.arange(3)[:, None] * (1.0 + np.arange(len(x))))
    states: Array = x + _ASIDE * scale * apart
    return states


def check_columns(what: str, together: Array, single: Array) -> None:
    """Raise a FunctionError if f of states together, (m, n), is not what it is of each by itself, (m, n)."""
    with np.errstate(invalid="ignore"):
        off = np.abs(together - single)
        off[(together == single) | np.isnan(together) & np.isnan(single)] = 0.0  # infinite ones, too
        allowed = _AGREES * max(np.nanmax(np.abs(single), initial=0.0), np.nanmax(np.abs(together), initial=0.0))
        wrong = np.argwhere(~(off <= allowed))
    if len(wrong):
        k, i = wrong[0].tolist()
        raise FunctionError(f"{what} is declared vectorized, but its columns are not what it returns for each state by "
                            f"itself: f[{i}] of column {k} is {together[k, i]:g}, by itself {single[k, i]:g}")
