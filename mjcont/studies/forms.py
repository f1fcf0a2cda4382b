"""What keys of a study take, in the words of JSON Schema (draft 7): the forms that readers name, for editors.

A form says less than the reader, which knows the model; it never refuses what the reader takes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from mjcont.numerics.equations.settings import Settings

Form = Mapping[str, Any]
FILE_STEM = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*")
_NUMBER = r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?"

TEXT: Form = {"type": "string"}
TEXTS: Form = {"type": "array", "items": TEXT}
FLAG: Form = {"type": "boolean"}
NAME: Form = {"type": "string", "pattern": f"^{FILE_STEM.pattern}$"}
DIRECTION: Form = {"enum": [1, -1]}
# what many keys take is written once, in `definitions`
QUANTITY: Form = {"$ref": "#/definitions/quantity"}
POSITIVE: Form = {"$ref": "#/definitions/positive"}
VALUES: Form = {"type": "object", "additionalProperties": QUANTITY}
QUANTITIES: Form = {"type": "array", "items": QUANTITY}
PAIR: Form = {"type": "array", "items": QUANTITY, "minItems": 2, "maxItems": 2}
RANGES: Form = {"type": "object", "additionalProperties": PAIR, "minProperties": 1}
ZEROS: Form = {"type": "object", "additionalProperties": {"anyOf": [QUANTITY, {**QUANTITIES, "minItems": 1}]}}
PLOT_SUFFIXES = (".png", ".pdf", ".svg")
PLOT_FILE: Form = {
    "type": "string", "pattern": f"^{FILE_STEM.pattern}({'|'.join(re.escape(s) for s in PLOT_SUFFIXES)})$",
}
POINT: Form = {"type": "string", "pattern": "^.+:.+$"}
DEFINITIONS: Mapping[str, Form] = {
    "quantity": {
        "title": "A quantity",
        "description": "A number in SI units and radians, or a string with a unit, such as \"20 deg\".",
        "anyOf": [{"type": "number"}, {"type": "string", "pattern": rf"^\s*{_NUMBER}\s*.*$"}],
    },
    "positive": {
        "title": "A positive quantity",
        "description": "A number in SI units and radians, or a string with a unit, such as \"20 mm\".",
        "anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"type": "string", "pattern": rf"^\s*{_NUMBER}\s*.*$"}],
    },
}


def whole(least: int) -> Form:
    """Return the form of whole numbers from `least` on."""
    return {"type": "integer", "minimum": least}


def choice(*valid: str) -> Form:
    """Return the form of one of several strings."""
    return {"enum": list(valid)}


def table(properties: Mapping[str, Form], *needed: str, text: str = "") -> Form:
    """Return the form of a table with keys of its own and no others."""
    said = {"description": text} if text else {}
    required = {"required": list(needed)} if needed else {}
    return {"type": "object", **said, "properties": dict(properties), **required, "additionalProperties": False}


def tables(inner: Form, least: int = 0) -> Form:
    """Return the form of an array of tables."""
    return {"type": "array", "items": inner, **({"minItems": least} if least else {})}


def settings(others: Mapping[str, Form] | None = None, leave_out: str = "") -> Form:
    """Return the form of fields of `Settings`, and others beside them."""
    taken = [s for s in fields(Settings) if s.name != leave_out]
    own = {s.name: whole(0) if isinstance(s.default, int) else QUANTITY for s in taken}
    return table({**own, **(others or {})})


AXIS: Form = {"anyOf": [
    {**QUANTITIES, "minItems": 2}, table({"from": QUANTITY, "to": QUANTITY, "count": whole(2)}, "from", "to", "count"),
]}
GRID: Form = {"type": "object", "additionalProperties": AXIS, "minProperties": 1, "maxProperties": 2}
