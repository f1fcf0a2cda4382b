"""Keys of a study file that name other results or points of them, such as "equilibria:LP1"."""

from __future__ import annotations

import re
import string
from collections.abc import Sequence

from mjcont.errors import did_you_mean, unknown_name
from mjcont.numerics.points.kinds import KINDS, found_on
from mjcont.studies import forms as f
from mjcont.studies.keys import Context, Known, Reader, Reference
from mjcont.studies.schema import Table

# a point, or a search with all its points; or several of them
_POINTS: f.Form = {"anyOf": [f.TEXT, {**f.TEXTS, "minItems": 1}]}
_LABEL = re.compile(r"([A-Z]+)([1-9]\d*)")
# labels of points: by kind of result those that it can have, and the names that it has for sure
_ROWS = ("start", "first", "last")
PLACES = {"search": (), "branch": _ROWS, "locus": (), "diagram": (), "path": ("final",), "cycles": _ROWS,
          "response": _ROWS, "nonlinear mode": _ROWS}
# the curves, as kinds of special points know them, that are not called like their kind of result
_CURVES = {"diagram": "branch", "response": "cycles", "nonlinear mode": "cycles"}


def known_result(table: Table, key: str, name: str, kinds: Sequence[str], context: Context) -> Known:
    """Return what is known of a result that comes before; a branch of diagram D is D_1, D_2, ..."""
    stem, _, number = name.rpartition("_")
    if context.known.get(stem, Known("")).kind == "diagram" and number.isdecimal() and int(number) > 0:
        name = stem
        if "branch" in kinds:
            return Known("branch", context.known[stem].free)
    valid = {n: k for n, k in context.known.items() if k.kind in kinds}
    if name not in valid:
        choices = [f"{n}_1" if k.kind == "diagram" and "branch" in kinds else n for n, k in valid.items()]
        choices += [f"{n}_1" for n, k in context.known.items() if k.kind == "diagram" and "diagram" not in kinds]
        raise table.error(key, unknown_name(" or ".join(", ".join(kinds).rsplit(", ", 1)), name, choices))
    return valid[name]


def reference(*kinds: str, labels: Sequence[str] | None = None) -> Reader:
    """Return a reader of a point of another result; `labels` are the kinds of special points that will do."""

    def reader(table: Table, key: str, context: Context) -> Reference:
        return refer(table, key, table.text(key), kinds, labels, context)

    return Reader(reader, f.POINT)


def references(*kinds: str) -> Reader:
    """Return a reader of points of other results, of which a search may stand for all its points."""

    def reader(table: Table, key: str, context: Context) -> tuple[Reference, ...]:
        given = table.texts(key) if isinstance(table.data[key], list) else (table.text(key),)
        if not given:
            raise table.error(key, 'expected at least one point, such as ["found:E1"]')
        found = []
        for i, written in enumerate(given):
            with context.noting():
                place = f"{key}[{i}]" if isinstance(table.data[key], list) else key
                if ":" not in written and context.known.get(written, Known("")).kind == "search":
                    found.append(Reference(written))
                else:
                    found.append(refer(table, place, written, kinds, None, context))
        return tuple(found)

    return Reader(reader, _POINTS)


def refer(
    table: Table, key: str, written: str, kinds: Sequence[str], labels: Sequence[str] | None, context: Context
) -> Reference:
    """Return a checked reference to a point."""
    name, colon, label = written.rpartition(":")
    if not (colon and name and label):
        raise table.error(key, f"expected a result and a point of it, such as \"equilibria:LP1\", got \"{written}\"")
    known = known_result(table, key, name, kinds, context)
    places = PLACES[known.kind] if labels is None else ()
    if label in places:
        return Reference(name, label)
    valid = {"search": ("E",), "path": ()}.get(known.kind, found_on(_CURVES.get(known.kind, known.kind)))
    valid = tuple(v for v in valid if labels is None or v in labels)
    match = _LABEL.fullmatch(label)
    if match is None or match[1] not in valid:
        choices = ", ".join([*(f"{v}1" for v in valid), *places]) + (", ..." if valid else "")
        what = f", a {KINDS[match[1]].name}," if match is not None and match[1] in KINDS else ""
        meant = did_you_mean(label, [*(v + label.lstrip(string.ascii_letters) for v in valid), *places])
        raise table.error(key, f"'{label}'{what} is no point of '{name}' that will do here.{meant} Valid: {choices}.")
    if match[1] == "UZ" and not known.zeros:
        raise table.error(key, f"'{label}': '{name}' asks for no zeros, so it will have no UZ points")
    return Reference(name, label)


def curve(*kinds: str) -> Reader:
    """Return a reader of the name of one curve."""

    def reader(table: Table, key: str, context: Context) -> str:
        name = table.text(key)
        known_result(table, key, name, kinds, context)
        return name

    return Reader(reader, f.TEXT)


def curves(*kinds: str) -> Reader:
    """Return a reader of names of curves."""

    def reader(table: Table, key: str, context: Context) -> tuple[str, ...]:
        names = table.texts(key)
        for i, name in enumerate(names):
            with context.noting():
                known_result(table, f"{key}[{i}]", name, kinds, context)
        if not names:
            raise table.error(key, "expected at least one branch; leave the key out for all of them")
        return names

    return Reader(reader, {**f.TEXTS, "minItems": 1})
