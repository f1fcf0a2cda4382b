"""Array parameters: (k,) under one name for functions, k parameters `name[0]`, `name[1]`, ... for everything else."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.errors import ParameterError, unknown_name
from mjcont.results.quantities import Parameter, default_bounds, finite, finite_pair


@dataclass(frozen=True, slots=True)
class Arrays:
    """Which parameters are entries of which arrays: names of entries, by the name of their array."""

    entries: Mapping[str, tuple[str, ...]]

    def seen(self, values: Mapping[str, Any], states: int | None = None) -> Mapping[str, Any]:
        """Return parameter values as functions see them; arrays are (k,), or (k, states) for many states at once."""
        if not self.entries:
            return values
        inside = {entry for entries in self.entries.values() for entry in entries}
        found: dict[str, Any] = {name: value for name, value in values.items() if name not in inside}
        for name, entries in self.entries.items():
            parts = [values[entry] for entry in entries]
            found[name] = np.array(parts if states is None else [np.broadcast_to(part, states) for part in parts])
        return found

    def spread(self, given: Mapping[str, Any], names: Mapping[str, Any]) -> dict[str, Any]:
        """Return what is given by names of arrays, such as a unit, for their entries; their own come first."""
        each = {e: given[name] for name, entries in self.entries.items() if name in given for e in entries}
        return {**each, **{name: value for name, value in given.items() if name in names or name not in self.entries}}

    def whole(self, function: Callable[..., Any] | None) -> Callable[..., Any] | None:
        """Return a function that takes parameter values last, let it see arrays."""
        if function is None or not self.entries:
            return function
        return lambda *args: function(*args[:-1], self.seen(args[-1]))


def flattened(parameters: Mapping[str, Any]) -> tuple[dict[str, float], Arrays]:
    """Return the numbers among parameters by name, each entry of an array under its own, and which those are.

    Raises
    ------
    ParameterError
        If a value is no finite number and no array (k,) of them, or two parameters have one name.
    """
    values, arrays = dict[str, float](), dict[str, tuple[str, ...]]()
    for name, value in parameters.items():
        shape = _shape(value)
        if shape == ():
            own = {name: finite(f"parameter '{name}': the value", value)}
        else:
            if shape is None or len(shape) != 1 or shape[0] == 0:
                got = "rows of several lengths" if shape is None else f"shape {shape}"
                raise ParameterError(f"parameter '{name}' must be a number or have shape (k,), got {got}")
            own = {f"{name}[{i}]": finite(f"parameter '{name}[{i}]': the value", v) for i, v in enumerate(value)}
            arrays[name] = tuple(own)
        for entry, number in own.items():
            if entry in values:
                raise ParameterError(f"two parameters are called '{entry}': rename one, or leave it in the array")
            values[entry] = number
    return values, Arrays(arrays)


def declared(
    default: Mapping[str, float], units: Mapping[str, str], bounds: Mapping[str, tuple[float, float]]
) -> dict[str, Parameter]:
    """Return the parameters with these values, by name; ranges that are not given are a guess.

    Raises
    ------
    ParameterError, BoundsError, NameLookupError
        If a value or range is none, or there is a range for no parameter.
    """
    for name in bounds:
        if name not in default:
            raise unknown_name("parameter", name, default)
    own = {name: finite_pair(f"bounds of {name}", pair) for name, pair in bounds.items()}
    ranges = {name: own.get(name, default_bounds(value)) for name, value in default.items()}
    found = {n: Parameter(n, units.get(n, ""), value, ranges[n], "field") for n, value in default.items()}
    for parameter in found.values():
        parameter.check(parameter.value)
    return found


def _shape(value: Any) -> tuple[int, ...] | None:
    """Return the shape of a number or an array, None if it has none."""
    try:
        return np.shape(value)
    except ValueError:
        return None
