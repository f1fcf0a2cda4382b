"""Keys of `[[holds]]` and `[[designs]]`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mjcont.errors import MjcontError
from mjcont.influence.aims.statements import BARRIER, quantity_of, read_statements
from mjcont.results.model import units
from mjcont.results.quantities import meant
from mjcont.studies import forms as f
from mjcont.studies import references as r
from mjcont.studies import values as v
from mjcont.studies.keys import Context, Key, Kind, Reader, Reference, about, takes
from mjcont.studies.schema import Table

_NAME = Key(v.result_name, "Names its files, and the result elsewhere in the study.", needed=True)
_CASES: f.Form = {
    "type": "object", "additionalProperties": {"anyOf": [f.tables(f.VALUES, 1), f.RANGES]}, "minProperties": 1,
}
_POINTS: f.Form = {"type": "object", "additionalProperties": f.POINT, "minProperties": 1}


@takes(_POINTS)
def _points(table: Table, key: str, context: Context) -> dict[str, Reference]:
    inner, found = table.table(key), {}
    for name in inner.data:
        with context.noting():
            if not name.replace("_", "a").isalnum():
                raise inner.error(name, "a point's name consists of letters, digits and '_'")
            found[name] = r.refer(inner, name, inner.text(name), ("search", "branch", "locus"), None, context)
    if not inner.data:
        raise table.error(key, 'expected at least one point, such as { LP1 = "equilibria:LP1" }')
    return found


@takes(_CASES)
def _cases(table: Table, key: str, context: Context) -> dict[str, Any]:
    inner, found = table.table(key), dict[str, Any]()
    for name, given in inner.data.items():
        with context.noting():
            if isinstance(given, Mapping):
                found[name] = v.ranges(inner, name, context)
            else:
                found[name] = [v.value_table(case, context) for case in inner.tables(name)]
    return found


@takes(f.VALUES)
def _scales(table: Table, key: str, context: Context) -> dict[str, float]:
    inner, found = table.table(key), {}
    for name in inner.data:
        with context.noting(), about(inner, name):
            found[name] = v.positive(context.mechanism.parameter(name).unit)(inner, name, context)
    return found


@takes(f.tables(f.VALUES, 1))
def _starts(table: Table, key: str, context: Context) -> tuple[dict[str, float], ...]:
    return tuple(v.value_table(inner, context) for inner in table.tables(key))


@takes({"anyOf": [f.TEXT, f.VALUES]})
def _pose(table: Table, key: str, context: Context) -> str | dict[str, float]:
    if isinstance(table.data[key], str):
        name: str = v.keyframe(table, key, context)
        return name
    inner, unit_of = table.table(key), units(context.mechanism)
    found = {}
    for name in inner.data:
        with context.noting(), about(inner, name):
            own = meant(name, (), context.mechanism.observables)
            context.mechanism.observable(own)
            found[own] = inner.quantity(name, unit_of[own])
    if not inner.data:
        raise table.error(key, 'expected a keyframe, or joints such as { theta_1 = "30 deg" }')
    return found


def _check_hold(found: dict[str, Any], table: Table, context: Context) -> None:
    found["start"] = {**context.common, **found["start"]}
    if found["keyframe"] and isinstance(found["pose"], str):
        raise table.error("keyframe", "it goes with a pose of joints; this pose is a keyframe itself")


def _check_design(found: dict[str, Any], table: Table, context: Context) -> None:
    unit_of = {**units(context.mechanism), "omega": "rad/s", BARRIER: "J"}
    known = dict.fromkeys(found["points"], unit_of)
    for i, text in enumerate(found["targets"]):
        with context.noting(), about(table, f"targets[{i}]"):
            read_statements([text], known, found["cases"])
    if not found["targets"]:
        raise table.error("targets", 'expected at least one target, such as "LP1.F == 14 N"')
    aim = found["objective"]
    if aim and aim.lstrip("- ") not in found["change"]:
        with about(table, "objective"):
            quantity_of(aim.lstrip("- "), known)
    for key in ("scales", "starts"):
        for name in {n for given in ([found[key]] if key == "scales" else found[key]) for n in given}:
            if name not in found["change"]:
                raise table.error(key, MjcontError(f"{name} is not among the parameters of change"))


HOLD = Kind("holds", "Which controls hold a pose (`hold`).", {
    "name": _NAME,
    "pose": Key(_pose, "A keyframe's name, or joints and observables such as `{ theta_1 = \"30 deg\" }`.", needed=True),
    "controls": Key(v.parameters, "Names of the controls, or of other parameters.", (), otherwise="all controls"),
    "start": Key(v.values, "Values of other parameters, over those of `[parameters]`.", {}, otherwise="none"),
    "keyframe": Key(v.keyframe, "Where the rest of a pose of joints is looked for.", otherwise="the initial pose"),
    "csv": Key(v.flag, "Whether to write NAME.csv: a row a control.", True),
}, _check_hold)

DESIGN = Kind("designs", "Parameters changed least so that special points meet targets (`design`).", {
    "name": _NAME,
    "points": Key(_points, "What the targets call points, such as `{ LP1 = \"equilibria:LP1\" }`.", needed=True),
    "change": Key(v.ranges, "The parameters with their bounds, such as `{ k_sp = [5, 20] }`.", needed=True),
    "targets": Key(Reader(lambda t, k, c: t.texts(k), {**f.TEXTS, "minItems": 1}),
                   "`\"LP1.F == 14 N\"`, `\"|CP1.F_ul| <= 400 over gusts\"`, `\"rest.barrier >= 2 J\"`.", needed=True),
    "cases": Key(_cases, "Load cases for `over`: `{ gusts = [{ load_factor = 1 }, { load_factor = 2.5 }] }`, or a box, "
                         "`{ gusts = { load_factor = [0.5, 2.5] } }`.", {}, otherwise="none"),
    "objective": Key(v.text, "What is least: a quantity `\"LP1.F\"`, its negative, or a parameter.",
                     otherwise="the change"),
    "scales": Key(_scales, "Changes that count as one, such as `{ k_sp = 1 }`.", {}, otherwise="the parameters' sizes"),
    "starts": Key(_starts, "Designs to start from, `[{ k_sp = 12 }]`; `[{}]` is today's.", (), otherwise="today's"),
    "tol": Key(v.positive("1"), "To which part of their values conditions hold.", 1e-9),
    "csv": Key(v.flag, "Whether to write NAME.csv: a row a parameter.", True),
    "png": Key(v.flag, "Whether to draw NAME.png: the changes.", True),
    "xml": Key(v.flag, "Whether to write NAME.xml: the MJCF with the new numbers, comments kept.", False),
}, _check_design)
