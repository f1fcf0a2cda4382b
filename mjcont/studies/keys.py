"""Tables of a study file as data: which keys each has, how they are read, what they default to.

A key's reader checks its value against the model and what the study names before; every problem is noted, not only the
first. `references` has the keys that name other results, `tables` the tables themselves.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from typing import Any

from mjcont.errors import MjcontError, StudyError, unknown_name
from mjcont.numerics.equations.settings import Settings, make_settings
from mjcont.results.model import check_bounds, units, warn_outside
from mjcont.results.quantities import column_of, meant
from mjcont.studies.schema import Table, shown

FILE_STEM = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")
_SETTING_UNITS = {"angle": "rad", "angle_max": "rad", "max_seconds": "s"}
# settings that may be infinite
_ENDLESS = frozenset({"chord", "max_arclength", "max_seconds"})


@dataclass(frozen=True, slots=True)
class Known:
    """A result that the study will have: its kind, and what of it is known before it is computed."""

    kind: str
    free: tuple[str, ...] = ()
    zeros: bool = False


@dataclass(frozen=True, slots=True)
class Reference:
    """A point of another result: "equilibria:LP1"; without a label all of them."""

    result: str
    label: str = ""

    def __str__(self) -> str:
        """Return it as a study writes it."""
        return f"{self.result}:{self.label}" if self.label else self.result


@dataclass(slots=True)
class Context:
    """What keys are read against, and the problems met so far; without a mechanism only keys themselves are checked."""

    mechanism: Any
    common: Mapping[str, float] = field(default_factory=dict)
    known: dict[str, Known] = field(default_factory=dict)
    problems: list[StudyError] = field(default_factory=list)

    @contextmanager
    def noting(self) -> Iterator[None]:
        """Note a problem and go on."""
        try:
            yield
        except StudyError as error:
            self.problems.append(error)

    def unit(self, name: Any) -> str:
        """Return the unit of a parameter; empty, which any unit fits, if there is none of this name."""
        try:
            return str(self.mechanism.parameter(name).unit) if isinstance(name, str) else ""
        except MjcontError:
            return ""


@contextmanager
def about(table: Table, key: str) -> Iterator[None]:
    """Let an error about the model name the file and the key."""
    try:
        yield
    except StudyError:
        raise
    except MjcontError as error:
        raise table.error(key, error) from error


Reader = Callable[[Table, str, Context], Any]


@dataclass(frozen=True, slots=True)
class Key:
    """A key: its reader, what docs/studies.md says of it, its value when left out, and how that is said."""

    read: Reader
    text: str
    default: Any = None
    needed: bool = False
    otherwise: str = ""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of table: its key at top level, what it is, its keys, and a check of them together."""

    table: str
    title: str
    keys: Mapping[str, Key]
    check: Callable[[dict[str, Any], Table, Context], None] | None = None


def read(table: Table, kind: Kind, context: Context) -> dict[str, Any] | None:
    """Return the values of a table, or None if anything in it is wrong; problems are noted."""
    before = len(context.problems)
    check_keys(table, kind.keys, [k for k, v in kind.keys.items() if v.needed], context)
    if context.mechanism is None:
        return None
    found: dict[str, Any] = {}
    for key, spec in kind.keys.items():
        with context.noting():
            found[key] = spec.read(table, key, context) if key in table.data else spec.default
    if len(context.problems) > before:
        return None
    with context.noting():
        if kind.check is not None:
            kind.check(found, table, context)
    return found if len(context.problems) == before else None


def check_keys(table: Table, valid: Mapping[str, Any] | Sequence[str], needed: Sequence[str], context: Context) -> None:
    """Note every key that is not among the valid ones, and every one that is missing."""
    for key in table.data:
        with context.noting():
            if key not in valid:
                raise table.error(key, unknown_name("key", key, valid))
    for key in needed:
        with context.noting():
            if key not in table.data:
                raise table.error(key, f"this key is missing. Needed here: {', '.join(needed)}.")


# -- plain values ------------------------------------------------------------------------------------------


def text(table: Table, key: str, context: Context) -> str:
    """Read a string."""
    return table.text(key)


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

    return reader


def positive(unit: str) -> Reader:
    """Return a reader of positive quantities."""

    def reader(table: Table, key: str, context: Context) -> float:
        value = table.quantity(key, unit)
        if not value > 0:
            raise table.error(key, f"expected a positive value, got {shown(table.data[key])}")
        return value

    return reader


def choice(what: str, *valid: str) -> Reader:
    """Return a reader of one of several strings."""

    def reader(table: Table, key: str, context: Context) -> str:
        value = table.text(key)
        if value not in valid:
            raise table.error(key, unknown_name(what, value, valid))
        return value

    return reader


def result_name(table: Table, key: str, context: Context) -> str:
    """Read a name that files are called by."""
    name = table.text(key)
    if not FILE_STEM.fullmatch(name):
        raise table.error(key, f"'{name}' names a file: use letters, digits, '-', '_' and '.' only")
    return name


def direction(table: Table, key: str, context: Context) -> int:
    """Read 1 or -1."""
    value = table.integer(key, 1)
    if value not in (1, -1):
        raise table.error(key, f"expected 1 or -1 (leave it out for both directions), got {value}")
    return value


def settings(table: Table, key: str, context: Context) -> dict[str, Any]:
    """Read fields of `Settings`."""
    inner, before = table.table(key), len(context.problems)
    defaults = {f.name: f.default for f in fields(Settings)}
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


def parameter(table: Table, key: str, context: Context) -> str:
    """Read the name of a parameter that can vary."""
    name = table.text(key)
    with about(table, key):
        context.mechanism.parameter(name)
        check_bounds(context.mechanism, name, None)
    return name


def parameters(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read names of parameters."""
    names = table.texts(key)
    for i, name in enumerate(names):
        with context.noting(), about(table, f"{key}[{i}]"):
            context.mechanism.parameter(name)
    return names


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
    return found


def keyframe(table: Table, key: str, context: Context) -> str:
    """Read the name of a keyframe."""
    name = table.text(key)
    with about(table, key):
        context.mechanism.start_state(name)
    return name


def keyframes(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read names of keyframes."""
    names = table.texts(key)
    for i, name in enumerate(names):
        with context.noting(), about(table, f"{key}[{i}]"):
            context.mechanism.start_state(name)
    return names


def state(table: Table, key: str, context: Context) -> tuple[float, ...] | None:
    """Read all position coordinates."""
    labels = context.mechanism.state_labels
    names = ", ".join(name for name, _ in labels)
    return table.quantities(key, [unit for _, unit in labels], f"{len(labels)} numbers ({names})")


def column(table: Table, key: str, context: Context) -> str:
    """Read the name of a parameter or an observable."""
    name, valid = table.text(key), units(context.mechanism)
    if name not in valid:
        raise table.error(key, unknown_name("column", name, valid))
    return name


def columns(table: Table, key: str, context: Context) -> tuple[str, ...]:
    """Read names of parameters or observables."""
    names, valid = table.texts(key), units(context.mechanism)
    for i, name in enumerate(names):
        with context.noting():
            if name not in valid:
                raise table.error(f"{key}[{i}]", unknown_name("column", name, valid))
    return names


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
    return found


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
