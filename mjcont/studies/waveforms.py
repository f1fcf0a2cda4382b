"""Inputs of time histories as study files write them: numbers, tables and named shapes. Knows nothing of MuJoCo."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from mjcont.errors import unknown_name
from mjcont.studies import forms as f
from mjcont.studies.schema import Table


@dataclass(frozen=True, slots=True)
class Shape:
    """A named function of time with values between `lowest` and `highest`."""

    name: str
    given: Mapping[str, float]

    def __call__(self, t: float) -> float:
        """Return the value at a time in s."""
        return SHAPES[self.name].function(t, self.given)

    @property
    def extremes(self) -> tuple[float, float]:
        """The least and the largest value that it can have."""
        g = self.given
        if "from" in g:
            return min(g["from"], g["to"]), max(g["from"], g["to"])
        low = g["base"] - (abs(g["amplitude"]) if self.name == "sine" else max(-g["amplitude"], 0.0))
        return low, g["base"] + (abs(g["amplitude"]) if self.name == "sine" else max(g["amplitude"], 0.0))


def _ramp(t: float, g: Mapping[str, float]) -> float:
    return g["from"] + (g["to"] - g["from"]) * min(max((t - g["start"]) / g["duration"], 0.0), 1.0)


def _step(t: float, g: Mapping[str, float]) -> float:
    return g["to"] if t >= g["start"] else g["from"]


def _one_minus_cos(t: float, g: Mapping[str, float]) -> float:
    fraction = (t - g["start"]) / g["duration"]
    inside = 0.0 <= fraction <= 1.0
    return g["base"] + (0.5 * g["amplitude"] * (1.0 - math.cos(2.0 * math.pi * fraction)) if inside else 0.0)


def _sine(t: float, g: Mapping[str, float]) -> float:
    return g["base"] + g["amplitude"] * math.sin(2.0 * math.pi * (t - g["start"]) / g["period"])


@dataclass(frozen=True, slots=True)
class _Form:
    """A shape: its function, and its keys with their defaults (None: needed)."""

    function: Callable[[float, Mapping[str, float]], float]
    keys: Mapping[str, float | None]
    text: str


SHAPES = {
    "ramp": _Form(_ramp, {"from": None, "to": None, "duration": None, "start": 0.0},
                  "straight from `from` to `to`, in `duration` from `start` on, constant before and after"),
    "step": _Form(_step, {"from": None, "to": None, "start": 0.0}, "`from` before `start`, `to` from then on"),
    "one_minus_cos": _Form(_one_minus_cos, {"amplitude": None, "duration": None, "base": 0.0, "start": 0.0},
                           "`base`, with a pulse of height `amplitude` that lasts `duration` from `start` on (a gust)"),
    "sine": _Form(_sine, {"amplitude": None, "period": None, "base": 0.0, "start": 0.0},
                  "about `base`, of amplitude `amplitude` and period `period`, upwards through `base` at `start`"),
}
_TIMES = ("start", "duration", "period")


def _inputs() -> f.Form:
    """Return what inputs are: numbers, tables or shapes."""
    given = {"times": f.QUANTITIES, "values": f.QUANTITIES}
    shapes = [
        f.table({"shape": {"const": name}, **dict.fromkeys(form.keys, f.QUANTITY)}, "shape",
                *(k for k, default in form.keys.items() if default is None), text=form.text)
        for name, form in SHAPES.items()
    ]
    any_of = [f.QUANTITY, f.table(given, "times", "values"), *shapes]
    return {"type": "object", "additionalProperties": {"anyOf": any_of}}


INPUTS = _inputs()
_EXPECTED = "a number, { times, values } or { shape, ... }"


def read_input(table: Table, name: str, unit: str) -> tuple[Any, tuple[float, float]]:
    """Return an input as `simulate` takes it, and the range of its values.

    Raises
    ------
    StudyError
        If a key is wrong; the message names it and the valid choices.
    """
    if not isinstance(table.data[name], dict):
        value = table.quantity(name, unit)
        return value, (value, value)
    inner = table.table(name)
    if "shape" in inner.data:
        shape = _shape(inner, unit)
        return shape, shape.extremes
    if not {"times", "values"} & set(inner.data):
        raise table.error(name, f"expected {_EXPECTED}; shapes: {', '.join(SHAPES)}")
    inner.only("times", "values")
    inner.require("times", "values")
    count = max(len(inner.data["times"]) if isinstance(inner.data["times"], list) else 1, 1)
    times = inner.quantities("times", ["s"] * count, "an array of times") or ()
    levels = inner.quantities("values", [unit] * count, f"an array of {count} values, one a time") or ()
    if any(b <= a for a, b in zip(times, times[1:], strict=False)):
        raise inner.error("times", "expected increasing times")
    return (times, levels), (min(levels), max(levels))


def _shape(inner: Table, unit: str) -> Shape:
    kind = inner.text("shape")
    if kind not in SHAPES:
        raise inner.error("shape", unknown_name("shape", kind, SHAPES))
    keys = SHAPES[kind].keys
    inner.only("shape", *keys)
    inner.require(*(k for k, default in keys.items() if default is None))
    given = {k: inner.quantity(k, "s" if k in _TIMES else unit) if k in inner.data else float(d or 0.0)
             for k, d in keys.items()}
    for key in ("duration", "period"):
        if key in given and not given[key] > 0:
            raise inner.error(key, f"expected a positive time, got {given[key]:g} s")
    return Shape(kind, given)
