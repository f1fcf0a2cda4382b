"""Readers of keys: plain values, and names and values of the model."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

from mjcont.errors import MjcontError, RangeWarning, unknown_name, warn
from mjcont.numerics.equations.settings import Settings, make_settings
from mjcont.results.model import check_bounds, units, warn_outside
from mjcont.results.quantities import column_of, far_angle, meant
from mjcont.studies import forms as f
from mjcont.studies.forms import FILE_STEM
from mjcont.studies.keys import Context, Reader, about, check_keys, takes
from mjcont.studies.schema import Table, shown

_SETTING_UNITS = {"angle": "rad", "angle_max": "rad", "max_seconds": "s"}
# settings that may be infinite
_ENDLESS = frozenset({"chord", "max_arclength", "max_seconds"})

# -- plain values ------------------------------------------------------------------------------------------


@takes(f.TEXT)
def text(table: Table, key: str, context: Context) -> str:
    """Read a string."""
    return table.text(key)


@takes(f.FLAG)
def flag(table: Table, key: str, context: Context) -> bool:
    """Read true or false."""
    return table.flag(key)


def whole(least: int) -> Reader:
    """Return a reader of whole numbers from `least` on."""

    def reader(table: Table, key: str, context: Context) -> int:
        value = table.integer(key, least)
        if value < least:
            raise table.error(key, f"expected a whole number from {least} on, got {value}")
        return value

    return Reader(reader, f.whole(least))


def positive(unit: str) -> Reader:
    """Return a reader of positive quantities."""

    def reader(table: Table, key: str, context: Context) -> float:
        value = table.quantity(key, unit)
        if not value > 0:
            raise table.error(key, f"expected a positive value, got {shown(table.data[key])}")
        return value

    return Reader(reader, f.POSITIVE)


def choice(what: str, *valid: str) -> Reader:
    """Return a reader of one of several strings."""

    def reader(table: Table, key: str, context: Context) -> str:
        value = table.text(key)
        if value not in valid:
            raise table.error(key, unknown_name(what, value, valid))
        return value

    return Reader(reader, f.choice(*valid))


@takes(f.NAME)
def result_name(table: Table, key: str, context: Context) -> str:
    """Read a name that files are called by."""
    name = table.text(key)
    if not FILE_STEM.fullmatch(name):
        raise table.error(key, f"'{name}' names a file: use letters, digits, '-', '_' and '.' only")
    return name


@takes(f.DIRECTION)
def direction(table: Table, key: str, context: Context) -> int:
    """Read 1 or -1."""
    value = table.integer(key, 1)
    if value not in (1, -1):
        raise table.error(key, f"expected 1 or -1 (leave it out for both directions), got {value}")
    return value


@takes(f.settings())
def settings(table: Table, key: str, context: Context) -> dict[str, Any]:
    """Read fields of `Settings`."""
    inner, before = table.table(key), len(context.problems)
    defaults = {s.name: s.default for s in fields(Settings)}
    check_keys(inner, defaults, (), context)
    found: dict[str, Any] = {}
    for name in inner.data:
        with context.noting():
            if name in _ENDLESS and inner.data[name] == math.inf:
                found[name] = math.inf
            elif name in defaults:
                is_whole = isinstance(defaults[name], int)
                unit = _SETTING_UNITS.get(name, "1")
                found[name] = inner.integer(name, 0) if is_whole else inner.quantity(name, unit)
    if len(context.problems) == before:
        with about(inner, ""):
            make_settings(found)
    return found


# -- names and values of the model -------------------------------------------------------------------------


@takes(f.TEXT)
def parameter(table: Table, key: str, context: Context) -> str:
    """Read the name of a parameter that can vary."""
    name = table.text(key)
    with about(table, key):
        context.mechanism.parameter(name)
        check_bounds(context.mechanism, name, None)
    return name


@takes(f.TEXTS)
def parameters(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read names of parameters."""
    names = table.texts(key)
    for i, name in enumerate(names):
        with context.noting(), about(table, f"{key}[{i}]"):
            context.mechanism.parameter(name)
    return names


@takes(f.VALUES)
def values(table: Table, key: str, context: Context) -> dict[str, float]:
    """Read a table of parameter values, each known to the model and inside its control's range."""
    return value_table(table.table(key), context)


def value_table(inner: Table, context: Context) -> dict[str, float]:
    """Return the parameter values in a table."""
    found: dict[str, float] = {}
    for name in inner.data:
        with context.noting(), about(inner, name):
            found[name] = inner.quantity(name, context.mechanism.parameter(name).unit)
            context.mechanism.values({name: found[name]})
            warn_outside(context.mechanism, {name: found[name]})
    return found


def pair(table: Table, key: str, unit: str) -> tuple[float, float]:
    """Return two quantities, the first the smaller."""
    low, high = table.quantities(key, (unit, unit), "two numbers such as [-50, 50]") or (0.0, 0.0)
    if not low < high:
        raise table.error(key, f"expected low < high, got [{low:g}, {high:g}]")
    return low, high


@takes(f.PAIR)
def bounds(table: Table, key: str, context: Context) -> tuple[float, float]:
    """Read bounds of the table's own parameter."""
    name = table.data.get("parameter")
    found = pair(table, key, context.unit(name))
    try:
        context.mechanism.parameter(name)
    except (MjcontError, TypeError):  # the parameter's own key says so
        return found
    with about(table, key):
        return check_bounds(context.mechanism, str(name), found)


@takes(f.RANGES)
def ranges(table: Table, key: str, context: Context) -> dict[str, tuple[float, float]]:
    """Read a table of parameters with [low, high]."""
    inner = table.table(key)
    found = {}
    for name in inner.data:
        with context.noting(), about(inner, name):
            unit = context.mechanism.parameter(name).unit
            found[name] = check_bounds(context.mechanism, name, pair(inner, name, unit))
    if not inner.data:
        raise table.error(key, "expected at least one parameter with its range, such as { F = [0, 50] }")
    return found


@takes(f.RANGES)
def region(table: Table, key: str, context: Context) -> dict[str, tuple[float, float]]:
    """Read a table of coordinates, observables or parameters with [low, high]."""
    inner, unit_of = table.table(key), {**dict(context.mechanism.state_labels), **units(context.mechanism)}
    found = {}
    for name in inner.data:
        with context.noting():
            own = meant(name, (), context.mechanism.observables)
            if own not in unit_of:
                raise inner.error(name, unknown_name("observable, joint or parameter", name, unit_of))
            found[own] = pair(inner, name, unit_of[own])
            _note_far(own, unit_of[own], *found[own])
    return found


@takes(f.TEXT)
def keyframe(table: Table, key: str, context: Context) -> str:
    """Read the name of a keyframe."""
    name = table.text(key)
    with about(table, key):
        context.mechanism.start_state(name)
    return name


@takes(f.TEXTS)
def keyframes(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read names of keyframes."""
    names = table.texts(key)
    for i, name in enumerate(names):
        with context.noting(), about(table, f"{key}[{i}]"):
            context.mechanism.start_state(name)
    return names


@takes(f.QUANTITIES)
def state(table: Table, key: str, context: Context) -> tuple[float, ...] | None:
    """Read all position coordinates."""
    labels = context.mechanism.state_labels
    names = ", ".join(name for name, _ in labels)
    return table.quantities(key, [unit for _, unit in labels], f"{len(labels)} numbers ({names})")


@takes(f.TEXT)
def column(table: Table, key: str, context: Context) -> str:
    """Read the name of a parameter or an observable."""
    name, valid = table.text(key), units(context.mechanism)
    if name not in valid:
        raise table.error(key, unknown_name("column", name, valid))
    return name


@takes(f.TEXTS)
def columns(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read names of parameters or observables."""
    names, valid = table.texts(key), units(context.mechanism)
    for i, name in enumerate(names):
        with context.noting():
            if name not in valid:
                raise table.error(f"{key}[{i}]", unknown_name("column", name, valid))
    return names


@takes(f.ZEROS)
def zeros(table: Table, key: str, context: Context) -> dict[str, float | tuple[float, ...]]:
    """Read observables, or the table's own parameter, each with a value or several."""
    inner, unit_of = table.table(key), units(context.mechanism)
    varied = table.data.get("parameter")
    valid = [*context.mechanism.observables, *([varied] if isinstance(varied, str) and varied in unit_of else [])]
    found: dict[str, float | tuple[float, ...]] = {}
    for name, given in inner.data.items():
        with context.noting():
            own = column_of(name, valid)
            if own is None:
                raise inner.error(name, unknown_name("column", name, valid))
            several = [unit_of[own]] * len(given) if isinstance(given, list) else []
            values = inner.quantities(name, several, "a value or several") if several else None
            found[own] = values or inner.quantity(name, unit_of[own])
            _note_far(own, unit_of[own], *(values or (found[own],)))
    return found


def _note_far(name: str, unit: str, *values: Any) -> None:
    """Warn of angles beyond a turn: degrees, without saying so."""
    said = far_angle(name, unit, *values)
    if said:
        warn(said, RangeWarning)


@takes(f.GRID)
def grid(table: Table, key: str, context: Context) -> dict[str, tuple[float, ...]]:
    """Read one or two parameters with increasing values, or with { from, to, count }."""
    inner = table.table(key)
    if len(inner.data) not in (1, 2):
        raise table.error(key, f"expected one or two parameters with their values, got {len(inner.data)}")
    found = {}
    for name in inner.data:
        with context.noting(), about(inner, name):
            unit = context.mechanism.parameter(name).unit
            axis = _axis(inner, name, unit, context)
            for value in (axis[0], axis[-1]):
                context.mechanism.values({name: value})
            found[name] = axis
    return found


def _axis(inner: Table, name: str, unit: str, context: Context) -> tuple[float, ...]:
    if isinstance(inner.data[name], dict):
        span = inner.table(name)
        span.only("from", "to", "count")
        span.require("from", "to", "count")
        low, high = span.quantity("from", unit), span.quantity("to", unit)
        count = whole(2)(span, "count", context)
        axis = tuple(low + (high - low) * i / (count - 1) for i in range(count))
    else:
        given = inner.data[name] if isinstance(inner.data[name], list) else ()
        axis = inner.quantities(name, [unit] * max(len(given), 2), "at least two numbers, or { from, to, count }") or ()
    if not all(a < b and math.isfinite(b) for a, b in zip(axis, axis[1:], strict=False)):
        raise inner.error(name, "expected increasing values")
    return axis


@takes(f.VALUES)
def tolerances(table: Table, key: str, context: Context) -> dict[str, float]:
    """Read changes of parameters, by name."""
    inner, found = table.table(key), {}
    for name in inner.data:
        with context.noting(), about(inner, name):
            found[name] = positive(context.mechanism.parameter(name).unit)(inner, name, context)
    return found
