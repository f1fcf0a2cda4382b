"""Functions of the user's own: how they are called, what they may return, and what is said when they do not.

A vectorized function takes states as columns, (n, m), as `scipy.integrate.solve_ivp` gives them, and parameters that
are numbers or, where they differ between the states, (m,).
"""

from __future__ import annotations

import inspect
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.errors import FunctionError, MjcontError, leaves_domain
from mjcont.fields.parameters import Arrays
from mjcont.numerics.equations.clock import TimeUp, check
from mjcont.numerics.equations.problem import Array, Values
from mjcont.results.quantities import Observable

# states that tell whether a function takes them as columns, as parts of the scale beside one, and how well f agrees
_ASIDE, _AGREES = 1e-2, 1e-6


def raised(what: str, error: Exception, given: str = "") -> FunctionError:
    """Return the error for a function of the user's own that raised one; `what` names it, `given` what it was given."""
    return FunctionError(f"{what} raised {type(error).__name__}{given}: {error}")


def numbers(what: str, found: Any) -> Array:
    """Return what a function of the user's own returned as floats, of any shape.

    Raises
    ------
    FunctionError
        If it is nothing, complex, or has fewer digits than doubles have.
    TypeError, ValueError
        If it is no array of numbers.
    """
    if found is None:
        raise FunctionError(f"{what} returned nothing: a `return` may be missing")
    given = np.asarray(found)
    kind, digits = given.dtype.kind, given.dtype.itemsize
    if kind == "c":
        raise FunctionError(f"{what} returned complex numbers: return real ones, and NaN where it has no value")
    if kind == "f" and digits < 8:
        raise FunctionError(f"{what} returned {given.dtype}, whose digits are too few: return float64")
    if kind == "O" and any(entry is None for entry in given.flat):
        raise FunctionError(f"{what} returned None among its numbers")
    return np.array(given, dtype=float)


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
        columns = numbers(what, found)
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


def measured(observable: Observable, values: Values, x: Array) -> float:
    """Return the value of an observable of the user's own, NaN where it overflows or leaves its domain."""
    try:
        return float(observable.function(values, x))
    except MjcontError:
        raise
    except Exception as error:
        if leaves_domain(error):
            return np.nan
        raise raised(f"observable '{observable.name}'", error) from error


@dataclass(slots=True)
class Evaluated:
    """A user's f(u, p) or f(u, p, t): called, held against its shape, and counted.

    Attributes
    ----------
    owner : what messages call the field.
    n, scale : number of unknowns, and their typical sizes (n,).
    timed, vectorized : whether it takes the time, and states as columns.
    counts : evaluations by thread: what one computes costs what that one evaluates.
    compared : whether its columns are known to be what they should.
    """

    owner: str
    function: Callable[..., Any]
    n: int
    timed: bool
    vectorized: bool
    arrays: Arrays
    scale: Array
    counts: dict[int, int] = field(default_factory=dict)
    compared: bool = False

    @property
    def count(self) -> int:
        """Evaluations so far, by this thread."""
        return self.counts.get(threading.get_ident(), 0)

    def rate(self, x: Array, values: Values, time: float) -> Array:
        """Return f at a time, in s, (n,); NaN where f overflows or leaves its domain."""
        check()
        self._counted(1)
        try:
            p = self.arrays.seen(values)
            value = self.function(x, p, time) if self.timed else self.function(x, p)
            found = numbers(f"the function of {self.owner}", value)
        except MjcontError:
            raise
        except Exception as error:
            if leaves_domain(error):  # ends a curve there, with what came before
                return np.full(self.n, np.nan)
            raise raised(f"the function of {self.owner}", error) from error
        if found.size != self.n:
            raise FunctionError(f"the function of {self.owner} returned shape {found.shape} for {self.n} unknowns: "
                                f"expected ({self.n},)")
        return found.reshape(self.n)

    def _counted(self, evaluations: int) -> None:
        thread = threading.get_ident()
        self.counts[thread] = self.counts.get(thread, 0) + evaluations

    def rates(self, states: Array, values: Sequence[Values], times: Sequence[float]) -> Array:
        """Return f at states (m, n), each with its own parameter values and time in s, (m, n), as `rate` does."""
        if self.vectorized and len(states):
            at = np.array(times, dtype=float)
            return self.together(states, merged(values), at if np.ptp(at) else float(at[0]))
        function, timed, seen, found = self.function, self.timed, self.arrays.seen, []
        try:
            for u, own, t in zip(states, values, times, strict=True):
                check()
                p = seen(own)
                value = function(u, p, t) if timed else function(u, p)
                # the user may fill one array, or one list, again and again
                found.append(value.copy() if isinstance(value, np.ndarray) else tuple(value))
            rows = numbers(f"the function of {self.owner}", found)
        except TimeUp:
            raise
        except Exception:  # one by one, to see which has no value
            rows = np.empty(0)
        if rows.shape != states.shape:
            return np.array([self.rate(u, p, t) for u, p, t in zip(states, values, times, strict=True)])
        self._counted(len(states))
        return rows

    def together(self, states: Array, values: Mapping[str, Any], times: float | Array = 0.0) -> Array:
        """Return f at states (m, n) by one call of a vectorized function, (m, n), as `rate` does.

        Parameter values and times are numbers, or (m,) where they differ.
        """
        if not self.compared:
            self._compare(states[0], values, times)
            self.compared = True
        return self._columns(states, values, times)

    def _columns(self, states: Array, values: Mapping[str, Any], times: float | Array) -> Array:
        check()
        what, m = f"the function of {self.owner}", len(states)
        columns = np.array(states.T, order="C")  # the user's own
        try:
            p = self.arrays.seen(values, m)
            found = self.function(columns, p, times) if self.timed else self.function(columns, p)
        except MjcontError:
            raise
        except Exception as error:
            if not leaves_domain(error):
                raise raised(f"{what}, declared vectorized,", error, f" for u of shape {columns.shape}") from error
            return np.array([
                self.rate(u, {k: _entry(v, i) for k, v in values.items()}, _entry(times, i))
                for i, u in enumerate(states)
            ])
        self._counted(m)
        return as_columns(what, found, self.n, m)

    def _compare(self, x: Array, values: Mapping[str, Any], times: float | Array) -> None:
        """Raise a FunctionError if a function that is said to be vectorized is not."""
        states, own = beside(x, self.scale), {k: _entry(v, 0) for k, v in values.items()}
        try:
            single = np.array([self.rate(u, own, _entry(times, 0)) for u in states])
        except FunctionError:  # it may refuse states that are not asked for
            states = np.tile(x, (len(states), 1))
            single = np.array([self.rate(u, own, _entry(times, 0)) for u in states])
        many = {k: np.full(len(states), v) for k, v in own.items()}
        check_columns(f"the function of {self.owner}", self._columns(states, many, _entry(times, 0)), single)


def _entry(value: Any, i: int) -> float:
    """Return a number, or entry i of one for each state."""
    return float(value[i]) if np.ndim(value) else float(value)
