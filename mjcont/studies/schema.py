"""TOML tables and quantities with units: checked reading, whose messages name the file and the key; and writing.

Knows nothing of mechanisms: what a study consists of is in `study`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mjcont.errors import MjcontError, StudyError, unknown_name
from mjcont.results.units import conversion, fitting, measured

_QUANTITY = re.compile(r"\s*(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(?P<unit>.*?)\s*")
_LARGEST = 1e300
_BARE_KEY = re.compile(r"[\w-]+(\[\d+\])*")
_BARE = re.compile(r"[A-Za-z0-9_-]+")


def quantity(value: Any, unit: str) -> float:
    """Return a number, or a string such as "20 deg", in `unit` (any unit will do where it is empty).

    Raises
    ------
    ValueError
        If it is neither, the unit is unknown, or it does not measure the same thing as `unit`.
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        number = float(value) if abs(value) < _LARGEST else math.inf
    else:
        match = _QUANTITY.fullmatch(value) if isinstance(value, str) else None
        if match is None:
            raise ValueError(f"expected a number or a quantity such as {_example(unit)}, got {shown(value)}")
        number = float(match["number"]) * _size(match["unit"], unit, value)
    if not math.isfinite(number):
        raise ValueError(f"expected a finite number below {_LARGEST:g}, got {shown(value)}")
    return number


def _example(unit: str) -> str:
    examples = {"rad": '"20 deg"', "m": '"20 mm"', "1": "20", "": '"20 N"'}
    return examples.get(unit, f'"20 {unit}"')


def _size(given: str, own: str, value: str) -> float:
    """Return the size of the unit given in the parameter's own unit."""
    try:
        return conversion(given, own)
    except MjcontError as error:
        raise ValueError(f'"{value}" does not fit a quantity in {own}. Valid units: {", ".join(fitting(own))}.'
                         if measured(given) is not None else str(error)) from error


def shown(value: Any) -> str:
    """Return a TOML value as a message shows it, with its type."""
    kinds: dict[type, str] = {str: "string", bool: "true/false", int: "number", float: "number", list: "array"}
    kind = "table" if isinstance(value, Mapping) else kinds.get(type(value), "date or time")
    text = f'"{value}"' if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)
    text = " ".join(text.split())
    return f"the {kind} {text if len(text) <= 60 else text[:57] + '...'}"


@dataclass(frozen=True, slots=True)
class Table:
    """A TOML table with the file and the dotted path that lead to it."""

    file: str
    data: Mapping[str, Any]
    where: str = ""

    def path(self, key: str = "") -> str:
        """Return the dotted path of a key."""
        written = key if _BARE_KEY.fullmatch(key) else f'"{key}"'
        return ".".join(part for part in (self.where, written if key else "") if part)

    def error(self, key: str, message: object) -> StudyError:
        """Return the error for a key."""
        place = self.path(key)
        return StudyError(f"study '{self.file}': {place}: {message}" if place else f"study '{self.file}': {message}")

    def only(self, *valid: str) -> None:
        """Refuse keys that are not among `valid`."""
        for key in self.data:
            if key not in valid:
                raise self.error(key, unknown_name("key", key, valid))

    def require(self, *keys: str) -> None:
        """Refuse a table that lacks one of the keys."""
        for key in keys:
            if key not in self.data:
                raise self.error(key, f"this key is missing. Needed here: {', '.join(keys)}.")

    def _typed(self, key: str, kind: type, expected: str, default: Any) -> Any:
        value = self.data.get(key, default)
        if key in self.data and (not isinstance(value, kind) or (kind is int and isinstance(value, bool))):
            raise self.error(key, f"expected {expected}, got {shown(value)}")
        return value

    def text(self, key: str, default: str = "") -> str:
        """Return a string."""
        return str(self._typed(key, str, "a string", default))

    def flag(self, key: str, default: bool = False) -> bool:
        """Return true or false."""
        return bool(self._typed(key, bool, "true or false", default))

    def integer(self, key: str, default: int) -> int:
        """Return a whole number."""
        return int(self._typed(key, int, "a whole number", default))

    def table(self, key: str) -> Table:
        """Return a table; empty if the key is left out."""
        return Table(self.file, self._typed(key, dict, "a table", {}), self.path(key))

    def tables(self, key: str) -> list[Table]:
        """Return an array of tables; empty if the key is left out."""
        items = self._typed(key, list, f"tables, each under [[{self.path(key)}]]", [])
        for i, item in enumerate(items):
            if not isinstance(item, dict):
                raise self.error(f"{key}[{i}]", f"expected a table, got {shown(item)}")
        return [Table(self.file, item, self.path(f"{key}[{i}]")) for i, item in enumerate(items)]

    def texts(self, key: str) -> tuple[str, ...]:
        """Return an array of strings; empty if the key is left out."""
        items = self._typed(key, list, "an array of strings", [])
        for i, item in enumerate(items):
            if not isinstance(item, str):
                raise self.error(f"{key}[{i}]", f"expected a string, got {shown(item)}")
        return tuple(items)

    def quantity(self, key: str, unit: str) -> float:
        """Return a quantity in `unit`."""
        try:
            return quantity(self.data[key], unit)
        except ValueError as error:
            raise self.error(key, error) from error

    def quantities(self, key: str, units: Sequence[str], expected: str) -> tuple[float, ...] | None:
        """Return an array of quantities, one for each of `units`, or None if the key is left out."""
        if key not in self.data:
            return None
        items = self.data[key]
        if not isinstance(items, list) or len(items) != len(units):
            raise self.error(key, f"expected {expected}, got {shown(items)}")
        self._refuse_mixture(key, items, units)
        inner = Table(self.file, {f"{key}[{i}]": item for i, item in enumerate(items)}, self.where)
        return tuple(inner.quantity(place, unit) for place, unit in zip(inner.data, units, strict=True))

    def _refuse_mixture(self, key: str, items: Sequence[Any], units: Sequence[str]) -> None:
        """Refuse a bare number, radians, beside degrees: nobody means ["-30 deg", 7]; 0 is the same in both."""
        plain = [item for item in items if not isinstance(item, str) and item != 0]
        words = {match["unit"] for item in items if isinstance(item, str) and (match := _QUANTITY.fullmatch(item))}
        if plain and set(units) == {"rad"} and any(word and measured(word) != measured("rad") for word in words):
            raise self.error(key, f"{shown(plain[0])} has no unit, as others beside it have: say the unit of each")


def quoted(text: str) -> str:
    """Return a TOML string."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\U{ord(c):08x}" for c in escaped) + '"'


def key_text(name: str) -> str:
    """Return a TOML key, in quotes where it needs them."""
    return name if _BARE.fullmatch(name) else quoted(name)


def value_text(value: Any) -> str:
    """Return a value as TOML has it, tables within braces; numbers are read back to the bit."""
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        inner = ", ".join(f"{key_text(k)} = {value_text(v)}" for k, v in value.items())
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(value_text(v) for v in value)}]"
    return repr(float(value)) if isinstance(value, float) else str(value)


def toml_text(data: Mapping[str, Any]) -> str:
    """Return tables of a study as the text of its file: plain keys, then tables, then arrays of tables."""
    lines = [f"{key_text(k)} = {value_text(v)}" for k, v in data.items() if not isinstance(v, Mapping | list)]
    for key, value in data.items():
        if isinstance(value, Mapping):
            lines += ["", f"[{key_text(key)}]", *(f"{key_text(k)} = {value_text(v)}" for k, v in value.items())]
    for key, value in data.items():
        for table in value if isinstance(value, list) else ():
            lines += ["", f"[[{key_text(key)}]]", *(f"{key_text(k)} = {value_text(v)}" for k, v in table.items())]
    return "\n".join(lines) + "\n"
