"""The tables of a study on periodic motion: `[[cycles]]`, `[[responses]]`, and what plots may show of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.numerics.equations.settings import Settings
from mjcont.oscillation.forced import FREQUENCY, Harmonic, check_forcing, check_inputs, forcing_parameter, make_forcing
from mjcont.oscillation.walks import flow_of, read_options
from mjcont.results.model import check_bounds, units
from mjcont.results.points import show
from mjcont.studies import forms as f
from mjcont.studies import keys as k
from mjcont.studies import references as r
from mjcont.studies import values as v
from mjcont.studies.keys import Context, Key, Kind, takes
from mjcont.studies.schema import Table

FAMILY = "nonlinear mode"
ORBITS = ("cycles", "response", FAMILY)
# what columns say of an observable, and of a response besides
_NUMBERS, _FIRST = ("max", "min", "amplitude", "mean", "rms"), ("h1", "phase")
_MESH: Mapping[str, f.Form] = {
    "mesh": f.whole(1), "degree": f.whole(1), "scheme": f.TEXT, "tol": f.QUANTITY, "mesh_max": f.whole(1),
    "period_max": f.QUANTITY,
}
_FORCING: f.Form = {"type": "object", "minProperties": 1, "additionalProperties": {"anyOf": [
    f.QUANTITY, f.table({"amplitude": f.QUANTITY, "phase": f.QUANTITY, "harmonic": f.whole(1)}, "amplitude"),
]}}


@takes(f.settings(_MESH, "tol"))
def _settings(table: Table, key: str, context: Context) -> dict[str, Any]:
    """Read fields of `Settings` and those of meshes."""
    inner = table.table(key)
    k.check_keys(inner, [*_MESH, *(s.name for s in fields(Settings) if s.name != "tol")], (), context)
    own = {name: given for name, given in inner.data.items() if name in _MESH}
    plain = {name: given for name, given in inner.data.items() if name not in _MESH}
    found = v.settings(Table(table.file, {key: plain}, table.where), key, context) if plain else {}
    with k.about(table, key):
        read_options(flow_of(context.mechanism), own)
    return {**found, **own}


@takes(_FORCING)
def _forcing(table: Table, key: str, context: Context) -> dict[str, Harmonic]:
    """Read inputs: an amplitude each, or a table of amplitude, phase and harmonic."""
    inner, found = table.table(key), {}
    for name, given in inner.data.items():
        with context.noting(), k.about(inner, name):
            unit = context.mechanism.parameter(name).unit
            if isinstance(given, Mapping):
                one = inner.table(name)
                one.only("amplitude", "phase", "harmonic")
                one.require("amplitude")
                phase = one.quantity("phase", "rad") if "phase" in given else 0.0
                found[name] = Harmonic(one.quantity("amplitude", unit), phase, one.integer("harmonic", 1))
            else:
                found[name] = Harmonic(inner.quantity(name, unit))
            check_forcing(context.mechanism, {name: found[name]})
    if not inner.data:
        raise table.error(key, "expected at least one input with its amplitude, such as { F = 5 }")
    return found


def _unit(name: Any, context: Context) -> str:
    """Return the unit of a parameter of a forced model; empty, which any unit fits, for what there is not."""
    if name in (FREQUENCY, "energy"):
        return "Hz" if name == FREQUENCY else "J"
    stem, _, what = str(name).rpartition(".")
    if what == "phase":
        return "rad"
    return context.unit(stem if what == "amplitude" else name)


@takes(f.PAIR)
def _bounds(table: Table, key: str, context: Context) -> tuple[float, float]:
    return v.pair(table, key, _unit(table.data.get("parameter"), context))


@takes(f.POSITIVE)
def _frequency(table: Table, key: str, context: Context) -> float:
    return v.positive("Hz")(table, key, context)


@takes(f.TEXT)
def _name(table: Table, key: str, context: Context) -> str:
    return table.text(key)


def _check_point(found: dict[str, Any], table: Table, context: Context, others: tuple[str, ...]) -> bool:
    """Whether the curve begins at a point; if so, refuse a start of its own, and points at which none begins."""
    if found["point"] is None:
        if found["parameter"] is None:
            raise table.error("parameter", "this key is missing: the parameter that varies, or point = \"NAME:LABEL\"")
        return False
    for key in others:
        if found[key]:
            raise table.error(key, "'point' says where it starts: leave this key out")
    label, kind = found["point"].label, context.known[found["point"].result].kind
    if kind not in ORBITS and not label.startswith("HB"):
        raise table.error("point", f"'{label}': limit cycles begin at Hopf points (HB1, ...) of a branch")
    return True


def _check_cycles(found: dict[str, Any], table: Table, context: Context) -> None:
    with k.about(table, ""):
        flow_of(context.mechanism)
    begins = _check_point(found, table, context, ("start", "keyframe", "state"))
    name = found["parameter"]
    if name is not None:
        with k.about(table, "parameter"):
            context.mechanism.parameter(name)
        if found["bounds"] is not None or not begins:
            with k.about(table, "bounds"):
                found["bounds"] = check_bounds(context.mechanism, name, found["bounds"])
    if not begins:
        found["start"] = {**context.common, **found["start"]}


def _check_response(found: dict[str, Any], table: Table, context: Context) -> None:
    if _check_point(found, table, context, ("start", "keyframe", "state", "forcing", "frequency")):
        return
    name, model = found["parameter"], context.mechanism
    if found["forcing"] is None:
        raise table.error("forcing", "this key is missing: what moves in time, such as { F = 5 }")
    with k.about(table, "forcing"):
        forcing = make_forcing(model, found["forcing"], found["frequency"])
        flow = flow_of(model, forcing)
    with k.about(table, "parameter"):
        forcing_parameter(model, forcing, name)
    with k.about(table, "bounds"):
        low, high = found["bounds"] = check_bounds(flow, name, found["bounds"])
    found["start"] = {**context.common, **found["start"]}
    if found["frequency"] is None and name != FREQUENCY:
        raise table.error("frequency", "this key is missing: the frequency of the forcing, in Hz")
    values = flow.values({**found["start"], FREQUENCY: found["frequency"] or low})
    if not low <= values[name] <= high:
        unit = flow.parameter(name).unit
        raise table.error("start", f"{name} = {show(values[name], unit)} at the start lies outside the bounds "
                                   f"{show(low, unit)} .. {show(high, unit)}")
    try:
        for end in (low, high):
            check_inputs(model, forcing, {**values, name: end})
    except (BoundsError, ParameterError) as error:
        raise table.error("forcing", error) from error


def orbit_settings() -> Key:
    """Return the key for settings of curves of orbits."""
    return Key(_settings, "`mesh`, `degree`, `scheme`, `tol`, `mesh_max`, `period_max`, and fields of "
                          "`mjcont.Settings` but its `tol`.", {}, otherwise="their defaults")


POSED = {
    "start": Key(v.values, "Parameter values at the start, over those of `[parameters]`.", {}, otherwise="none"),
    "keyframe": Key(v.keyframe, "The keyframe near which the motion begins.", otherwise="the initial pose"),
    "state": Key(v.state, "The same, as an array of all position coordinates.", otherwise="the initial pose"),
}
_ENDING = {
    "direction": Key(v.direction, "`1` or `-1`: only that way, in which the parameter first grows or falls.",
                     otherwise="both"),
    "csv": Key(v.flag, "Whether to write NAME.csv: a row an orbit, angles in degrees.", False),
    "settings": orbit_settings(),
}
RESULT = Key(v.result_name, "Names its files, and the result elsewhere in the study.", needed=True)

CYCLES = Kind("cycles", "A curve of limit cycles (`continue_cycles`).", {
    "name": RESULT,
    "point": Key(r.reference("branch", "cycles", "response"),
                 "Where it begins: a Hopf point, such as `\"equilibria:HB1\"`; a PD, a BPC or another orbit of cycles.",
                 otherwise="the cycle on which the motion from the start settles"),
    "parameter": Key(v.parameter, "The parameter that varies.", otherwise="that of the point's curve"),
    "bounds": Key(_bounds, "`[low, high]`.", otherwise="those of the point's curve, or the parameter's own"),
    **POSED, **_ENDING,
}, _check_cycles)

RESPONSES = Kind("responses", "Periodic motion under periodic inputs (`continue_response`).", {
    "name": RESULT,
    "parameter": Key(_name, "What varies: `\"frequency\"`, `\"F.amplitude\"`, `\"F.phase\"` or a parameter of the "
                            "model; that of an input is its mean.", otherwise="that of the point's curve"),
    "bounds": Key(_bounds, "`[low, high]`; of the frequency in Hz.",
                  otherwise="those of the point's curve, or the parameter's own"),
    "forcing": Key(_forcing, "Inputs with their amplitudes, such as `{ F = 5 }` or `{ F = { amplitude = 5, "
                             "phase = \"90 deg\", harmonic = 2 } }`.", otherwise="needed, but for a point"),
    "frequency": Key(_frequency, "Of the forcing, in Hz.", otherwise="where its bounds begin, if it varies"),
    "point": Key(r.reference("response"), "A PD, a BPC or another orbit of an earlier response at which it begins.",
                 otherwise="the motion settled from its start"),
    **POSED, **_ENDING,
}, _check_response)


# -- plots ----------------------------------------------------------------------------------------------------


def own_columns(context: Context) -> dict[str, str]:
    """Return the columns that the study's curves of orbits have beside the model's names, with their units."""
    kinds = {known.kind for known in context.known.values()} & set(ORBITS)
    if not kinds or context.mechanism is None:
        return {}
    found = {"period": "s", FREQUENCY: "Hz"} | ({"energy": "J"} if FAMILY in kinds else {})
    for o in context.mechanism.observables.values():
        found |= {f"{o.name}.{what}": o.unit for what in _NUMBERS}
        if "response" in kinds:
            found |= dict(zip((f"{o.name}.{what}" for what in _FIRST), (o.unit, "rad"), strict=True))
    free = {n for known in context.known.values() for n in known.free if known.kind in ORBITS}
    return found | {n: _unit(n, context) for n in free if n not in units(context.mechanism)}


@takes(f.TEXT)
def plotted(table: Table, key: str, context: Context) -> str:
    """Read the name of a column: a parameter, an observable, or what curves of orbits have besides."""
    name, valid = table.text(key), {**units(context.mechanism), **own_columns(context)}
    if name not in valid:
        raise table.error(key, unknown_name("column", name, valid))
    return name


def check_plotted(found: Mapping[str, Any], table: Table, context: Context) -> None:
    """Refuse curves of rests where a column belongs to orbits."""
    own = set(own_columns(context)) - set(units(context.mechanism))
    for key in ("x", "y"):
        for name in found["branches"] if found[key] in own else ():
            if context.known[name].kind not in ORBITS:
                raise table.error(key, f"'{found[key]}' is a column of periodic motion, which '{name}' is not: name "
                                       "only [[cycles]] and [[responses]] in branches")


def default_curves(found: Mapping[str, Any], context: Context, plain: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a plot shows unless told: rests and orbits, but only orbits where a column is theirs."""
    own = set(own_columns(context)) - set(units(context.mechanism))
    orbits = tuple(n for n, known in context.known.items() if known.kind in ORBITS)
    return orbits if {found["x"], found["y"]} & own else (*plain, *orbits)
