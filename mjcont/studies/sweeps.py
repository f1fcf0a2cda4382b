"""What the table [sweep] of a study file asks for: docs/sweeps.md describes its keys."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.errors import MjcontError, StudyError, unknown_name
from mjcont.mechanism.mechanism import Mechanism
from mjcont.studies import forms as f
from mjcont.studies.schema import Table, shown
from mjcont.sweeps.designs import DESIGNS, DISTRIBUTIONS, Spread
from mjcont.sweeps.jobs import METHODS, PointPlan
from mjcont.sweeps.plan import DEEPEST, SweepPlan

_WIDTH: f.Form = {"anyOf": [f.QUANTITY, {"type": "string", "pattern": "%"}]}
_POINT = f.table({"name": f.TEXT, "label": f.TEXT, "branch": f.TEXT, "of": f.TEXT, "parameter": f.TEXT,
                  "bounds": f.PAIR}, "name", "label")
_VARY = f.table({**dict.fromkeys(DISTRIBUTIONS, _WIDTH), "centre": f.QUANTITY, "cut": f.QUANTITY,
                 "values": f.QUANTITIES, "range": f.PAIR, "count": f.whole(1)})
SWEEP = f.table({
    "design": f.choice(*DESIGNS), "cases": f.whole(1), "seed": f.whole(0), "record": f.TEXTS,
    "method": f.choice(*METHODS), "depth": f.whole(1), "point": f.tables(_POINT, 1),
    "vary": {"type": "object", "additionalProperties": _VARY, "minProperties": 1},
}, "point", "vary", text="Many variants of the model, for mjcont sweep.")
_NAME = re.compile(r"[A-Za-z_]\w*")
_PERCENT = re.compile(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*%\s*")


def read_sweep(root: Table, mechanism: Mechanism, branches: Sequence[Any]) -> SweepPlan | None:
    """Return the plan of a study's [sweep], checked; None where it has none.

    Raises
    ------
    StudyError
    """
    if "sweep" not in root.data:
        return None
    table = root.table("sweep")
    table.only(*SWEEP["properties"])
    table.require(*SWEEP["required"])
    choices = {"design": DESIGNS, "method": METHODS}
    for key, valid in choices.items():
        if key in table.data and table.text(key) not in valid:
            raise table.error(key, unknown_name(key, table.text(key), valid))
    cases, seed, depth = table.integer("cases", 0), table.integer("seed", 0), table.integer("depth", DEEPEST)
    for key, value, least in (("cases", cases, 1), ("seed", seed, 0), ("depth", depth, 1)):
        if key in table.data and value < least:
            raise table.error(key, f"expected a whole number from {least} on, got {value}")
    points = _points(table, mechanism, {b.name: b for b in branches})
    record = table.texts("record")
    for i, quantity in enumerate(record):
        name = quantity.partition(".")[0]
        if name not in {p.name for p in points}:
            raise table.error(f"record[{i}]", unknown_name("point", name, [p.name for p in points]))
    vary = table.table("vary")
    if not vary.data:
        raise table.error("vary", "name at least one parameter that varies")
    return SweepPlan(
        points, {name: _vary(vary, name, mechanism) for name in vary.data}, table.text("design", DESIGNS[0]),
        cases or None, seed, record, table.text("method", METHODS[0]), depth,
    )


def _points(table: Table, mechanism: Mechanism, branches: Mapping[str, Any]) -> tuple[PointPlan, ...]:
    found: dict[str, PointPlan] = {}
    for t in table.tables("point"):
        t.only(*_POINT["properties"])
        t.require("name", "label")
        name = t.text("name")
        if not _NAME.fullmatch(name) or name in found:
            raise t.error("name", f"'{name}': a new name of letters, digits and '_' is needed")
        if ("branch" in t.data) == ("of" in t.data):
            raise t.error("", "give a branch that the point lies on, or a point 'of' whose curve it lies on")
        branch, of, parameter = t.text("branch"), t.text("of"), t.text("parameter")
        bounds = None
        if branch:
            t.only("name", "label", "branch")
            if branch not in branches:
                raise t.error("branch", unknown_name("branch", branch, branches))
        else:
            t.require("name", "label", "of", "parameter")
            if of not in found:
                raise t.error("of", unknown_name("point", of, found))
            try:
                unit = mechanism.parameter(parameter).unit
            except MjcontError as error:
                raise t.error("parameter", error) from error
            pair = t.quantities("bounds", (unit, unit), "two numbers such as [-50, 50]")
            bounds = None if pair is None else (pair[0], pair[1])
        found[name] = PointPlan(name, t.text("label"), branch, of, parameter, bounds)
    if not found:
        raise table.error("point", "a sweep needs at least one [[sweep.point]]")
    return tuple(found.values())


def _vary(vary: Table, name: str, mechanism: Mechanism) -> Spread | tuple[float, ...]:
    table = vary.table(name)
    try:
        unit = mechanism.parameter(name).unit
    except MjcontError as error:
        raise vary.error(name, error) from error
    table.only(*_VARY["properties"])
    kinds = [k for k in (*DISTRIBUTIONS, "values", "range") if k in table.data]
    if len(kinds) != 1:
        raise vary.error(name, f"give one of {', '.join((*DISTRIBUTIONS, 'values', 'range'))}")
    (kind,) = kinds
    try:
        if kind == "values":
            items = table.data["values"]
            if not isinstance(items, list) or not items:
                raise table.error("values", f"expected an array of numbers, got {shown(items)}")
            found = table.quantities("values", (unit,) * len(items), "numbers")
            assert found is not None
            return found
        if kind == "range":
            table.require("count")
            ends = table.quantities("range", (unit, unit), "two numbers such as [-50, 50]")
            count = table.integer("count", 0)
            if count < 1:
                raise table.error("count", f"expected a whole number from 1 on, got {count}")
            assert ends is not None
            return tuple(float(v) for v in np.linspace(ends[0], ends[1], count))
        width, relative = _width(table, kind, unit)
        centre = table.quantity("centre", unit) if "centre" in table.data else None
        cut = table.quantity("cut", "1") if "cut" in table.data else 3.0
        return Spread(kind, width, relative, centre, cut)
    except StudyError:
        raise
    except MjcontError as error:
        raise vary.error(name, error) from error


def _width(table: Table, kind: str, unit: str) -> tuple[float, bool]:
    value = table.data[kind]
    percent = _PERCENT.fullmatch(value) if isinstance(value, str) else None
    if percent is not None:
        return float(percent[1]) / 100.0, True
    if kind == "lognormal":
        raise table.error(kind, f'expected a percentage such as "5 %", got {shown(value)}')
    return table.quantity(kind, unit), False
