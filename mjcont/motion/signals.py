"""What drives a simulation: numbers, functions of time, tables, and controllers. Knows nothing of MuJoCo."""

from __future__ import annotations

import copy
import inspect
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.errors import BoundsError, ParameterError
from mjcont.numerics.equations.problem import Array
from mjcont.results.quantities import Parameter

Input = float | Callable[[float], float] | tuple[Any, Any] | Callable[[float, Mapping[str, float]], float]


@dataclass(frozen=True, slots=True)
class Signal:
    """A parameter as a function of time: `at` one time, or a `series` at many.

    Attributes
    ----------
    constant : whether it never changes.
    """

    name: str
    function: Callable[[float], float] | None = None
    table: tuple[Array, Array] | None = None
    value: float = 0.0

    @property
    def constant(self) -> bool:
        """Whether it never changes."""
        return self.function is None and self.table is None

    def at(self, time: float) -> float:
        """Return the value at a time."""
        return float(self.series(np.array([time]))[0])

    def series(self, times: Array) -> Array:
        """Return the values at times (m,), (m,).

        Raises
        ------
        ParameterError
            If the function returns something that is no finite number.
        """
        if self.table is not None:
            return np.interp(times, *self.table)
        if self.function is None:
            return np.full(len(times), self.value)
        try:
            values = np.array([self.function(t) for t in times.tolist()], dtype=float)
        except (TypeError, ValueError) as error:
            raise ParameterError(f"input '{self.name}': the function must take a time and return a number: {error}"
                                 ) from error
        if values.shape != times.shape or not np.all(np.isfinite(values)):
            raise ParameterError(f"input '{self.name}': the function must return a finite number at every time")
        return values


@dataclass(frozen=True, slots=True)
class Controller:
    """A law u(t, observables) for a control, sampled every control step and held between.

    An object is copied before every run, so that whatever it remembers starts afresh; `vectorised` (an attribute of
    the law) asks for one call for all runs that share it, with an array for every observable.
    """

    name: str
    law: Callable[[float, Mapping[str, Any]], Any]

    @property
    def vectorised(self) -> bool:
        """Whether the law takes and returns arrays, one entry a run."""
        return bool(getattr(self.law, "vectorised", False))

    def fresh(self) -> Callable[[float, Mapping[str, Any]], Any]:
        """Return the law for one run: a copy of an object, a function as it is."""
        return copy.deepcopy(self.law)


def read_inputs(given: Mapping[str, Input] | None) -> tuple[dict[str, Signal], dict[str, Controller]]:
    """Return what is given as functions of time and as controllers.

    Raises
    ------
    ParameterError
        If an input is none of number, function of time, (times, values) and controller.
    """
    if given is not None and not isinstance(given, Mapping):
        raise ParameterError(f"inputs must be a dict of parameter to input, got {type(given).__name__}")
    signals: dict[str, Signal] = {}
    controllers: dict[str, Controller] = {}
    for name, item in (given or {}).items():
        function: Any = item
        if callable(item):
            if _arguments(name, item) == 2:
                controllers[name] = Controller(name, function)
            else:
                signals[name] = Signal(name, function=function)
        elif isinstance(item, tuple | list):
            signals[name] = Signal(name, table=_table(name, item))
        else:
            signals[name] = Signal(name, value=_number(name, item))
    return signals, controllers


def _arguments(name: str, function: Callable[..., Any]) -> int:
    """Return how many arguments a function must be given: one makes a function of time, two a controller."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return 1
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    taken = [p for p in parameters if p.kind in positional]
    count = sum(p.default is p.empty for p in taken) or min(len(taken), 1)
    if count not in (1, 2):
        raise ParameterError(f"input '{name}': expected a function f(t) or a controller u(t, observables); "
                             f"this one needs {count} arguments")
    return count


def _table(name: str, given: Sequence[Any]) -> tuple[Array, Array]:
    message = f"input '{name}': (times, values) must be two equal vectors of finite numbers, times increasing"
    if len(given) != 2:
        raise ParameterError(message)
    try:
        times, table = (np.asarray(a, dtype=float) for a in given)
    except (TypeError, ValueError) as error:
        raise ParameterError(message) from error
    finite = np.all(np.isfinite(times)) and np.all(np.isfinite(table))
    if times.ndim != 1 or not len(times) or times.shape != table.shape or not finite or np.any(np.diff(times) <= 0):
        raise ParameterError(message)
    return times, table


def _number(name: str, item: Any) -> float:
    try:
        value = float(item)
    except (TypeError, ValueError) as error:
        raise ParameterError(
            f"input '{name}': expected a number, a function of time, (times, values) or a controller "
            f"u(t, observables), got {type(item).__name__}"
        ) from error
    if not math.isfinite(value):
        raise ParameterError(f"input '{name}': the value must be a finite number, got {value}")
    return value


def check_range(parameter: Parameter, series: Array, times: Array) -> None:
    """Raise a BoundsError where an input leaves a control's range, in which MuJoCo would clamp it silently."""
    low, high = parameter.hard_bounds
    outside = (series < low) | (series > high)
    if outside.any():
        i = int(np.argmax(outside))
        raise BoundsError(
            f"input '{parameter.name}' is {series[i]:g} at t = {times[i]:g} s, outside {parameter.limits}"
        )


@dataclass(slots=True)
class Observed(Mapping[str, Any]):
    """What a controller sees: observables by name, computed when asked for; SI and radians.

    Attributes
    ----------
    state, velocity : (nq,) and (nv,), or (m, nq) and (m, nv) for a vectorised controller.
    """

    problem: Any
    state: Array
    velocity: Array
    parameters: Sequence[Mapping[str, float]]
    _known: dict[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        """Return the current value of an observable: a number, or (m,) for a vectorised controller."""
        if name not in self._known:
            single = self.state.ndim == 1
            states, velocities = (self.state[None], self.velocity[None]) if single else (self.state, self.velocity)
            column = self.problem.measure(states, self.parameters, [name], velocities)[:, 0]
            self._known[name] = float(column[0]) if single else column
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        """Iterate over the names."""
        return iter(self.problem.observables)

    def __len__(self) -> int:
        """Return the number of observables."""
        return len(self.problem.observables)


def controlled(name: str, output: Any, count: int, bounds: tuple[float, float]) -> Array:
    """Return a controller's output as (count,), saturated at the actuator's range.

    Raises
    ------
    ParameterError
        If it is not finite, or has the wrong shape.
    """
    try:
        values = np.broadcast_to(np.asarray(output, dtype=float), (count,))
    except (TypeError, ValueError) as error:
        what = "a number" if count == 1 else f"a number or an array of shape ({count},)"
        raise ParameterError(f"controller of '{name}' must return {what}, got {output!r}") from error
    if not np.all(np.isfinite(values)):
        raise ParameterError(f"controller of '{name}' returned {output!r}, which is not finite")
    return np.clip(values, *bounds)
