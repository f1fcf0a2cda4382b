"""The tables of a study file, in the order in which they are computed; docs/studies.md has them as `Key` says them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mjcont.errors import MjcontError, unknown_name
from mjcont.motion.loadpaths import LANDINGS
from mjcont.motion.stepping import INTEGRATORS
from mjcont.numerics.points import kinds
from mjcont.numerics.points.kinds import CONTINUABLE
from mjcont.oscillation.loci import FOLLOWED
from mjcont.results.model import check_bounds, units
from mjcont.results.points import show
from mjcont.results.quantities import column_of
from mjcont.studies import forms as f
from mjcont.studies import keys as k
from mjcont.studies import references as r
from mjcont.studies import values as v
from mjcont.studies.choices.tables import DESIGN, HOLD
from mjcont.studies.families import NONLINEAR
from mjcont.studies.keys import Context, Key, Kind, takes
from mjcont.studies.linear import MODES, TRANSFER
from mjcont.studies.orbits import CYCLES, FAMILY, LOSING, ORBITS, RESPONSES
from mjcont.studies.schema import Table
from mjcont.studies.waveforms import INPUTS, read_input

SPECIAL = ("branch", "locus")
_POSED = ("start", "keyframe", "state")
_LOCATED = (*CONTINUABLE, "UZ")


def _own_bounds(found: dict[str, Any], context: Context) -> tuple[float, float]:
    return found["bounds"] or check_bounds(context.mechanism, found["parameter"], None)


def _one_start(found: Mapping[str, Any], table: Table, others: tuple[str, ...] = _POSED) -> None:
    """Refuse a point of another result together with a start of one's own."""
    if found.get("keyframe") and found.get("state"):
        raise table.error("state", "give a keyframe or a state, not both")
    for key in others:
        if found["from"] and found[key]:
            raise table.error(key, "'from' says where it starts, with all parameter values: leave this key out")


def _check_branch(found: dict[str, Any], table: Table, context: Context) -> None:
    _one_start(found, table)
    name = found["parameter"]
    low, high = found["bounds"] = _own_bounds(found, context)
    found["start"] = {**context.common, **found["start"]}
    value, unit = found["start"].get(name, context.mechanism.parameter(name).value), context.unit(name)
    if not found["from"] and not low <= value <= high:
        raise table.error(
            "start",
            f"{name} = {show(value, unit)} lies outside the bounds {show(low, unit)} .. {show(high, unit)}: "
            f"give start = {{ {name} = ... }} inside them",
        )


def _check_search(found: dict[str, Any], table: Table, context: Context) -> None:
    found["start"] = {**context.common, **found["start"]}


def _check_diagram(found: dict[str, Any], table: Table, context: Context) -> None:
    _one_start(found, table, ("start", "keyframes"))
    _check_branch({**found, "keyframe": None, "state": None}, table, context)
    found["bounds"] = _own_bounds(found, context)
    found["start"] = {**context.common, **found["start"]}


def _free_at(reference: k.Reference, context: Context) -> tuple[str, ...]:
    stem = reference.result if reference.result in context.known else reference.result.rpartition("_")[0]
    return context.known[stem].free


def _check_locus(found: dict[str, Any], table: Table, context: Context) -> None:
    if found["parameter"] in _free_at(found["point"], context):
        raise table.error("parameter", f"{found['parameter']} is free already on the curve of {found['point']}: "
                                       "name another parameter")
    found["bounds"] = _own_bounds(found, context)


@takes(f.tables(f.VALUES, 2))
def _loads(table: Table, key: str, context: Context) -> tuple[dict[str, float], ...]:
    return tuple(v.value_table(inner, context) for inner in table.tables(key))


@takes({**f.QUANTITIES, "minItems": 2})
def _values(table: Table, key: str, context: Context) -> tuple[float, ...]:
    name, given = table.data.get("parameter"), table.data[key]
    unit, count = context.unit(name), max(len(given), 2) if isinstance(given, list) else 2
    found = table.quantities(key, [unit] * count, "at least two numbers such as [0, 30, 0]") or ()
    if isinstance(name, str) and name in context.mechanism.parameters:
        with k.about(table, key):
            for value in found:
                context.mechanism.values({name: value})
    return found


def _check_path(found: dict[str, Any], table: Table, context: Context) -> None:
    _one_start(found, table)
    if (found["parameter"] is None) == (found["loads"] is None) or (found["parameter"] is None) != (
        found["values"] is None
    ):
        raise table.error("parameter", "give parameter and values, or loads: an array of tables of parameter values")
    rows = found["loads"] if found["values"] is None else [{found["parameter"]: v} for v in found["values"]]
    if len(rows) < 2 or all(row == rows[0] for row in rows):
        raise table.error("values" if found["loads"] is None else "loads", "a path needs at least two different loads")
    found["start"] = {**context.common, **found["start"]}


@takes(INPUTS)
def _inputs(table: Table, key: str, context: Context) -> dict[str, Any]:
    inner, found = table.table(key), {}
    for name in inner.data:
        with context.noting(), k.about(inner, name):
            unit = context.mechanism.parameter(name).unit
            found[name], extremes = read_input(inner, name, unit)
            for value in extremes:
                context.mechanism.values({name: value})
    return found


def _check_history(found: dict[str, Any], table: Table, context: Context) -> None:
    _one_start(found, table)
    valid = [*found["inputs"], *context.mechanism.observables]
    for i, name in enumerate(found["columns"]):
        if column_of(name, valid) is None:
            raise table.error(f"columns[{i}]", unknown_name("input or observable", name, valid))
    found["start"] = {**context.common, **found["start"]}


@takes(f.TEXTS)
def _quantities(table: Table, key: str, context: Context) -> tuple[str, ...]:
    names, valid = table.texts(key), [*units(context.mechanism), "omega"]
    for i, name in enumerate(names):
        if name not in valid:
            raise table.error(f"{key}[{i}]", unknown_name("quantity", name, valid))
    return names


def _not_own(found: Mapping[str, Any], key: str, table: Table, context: Context) -> None:
    """Refuse parameters that the point's own equations determine."""
    reference = found["point"]
    free = _free_at(reference, context)
    kind = kinds.KINDS.get(reference.label[:2])
    own = free if kind is not None and kind.codimension > 1 else free[:1]
    for name in found[key] or ():
        if name in own and reference.label[:2] != "UZ":
            raise table.error(key, f"{name} is free at {reference}, which determines it: name other parameters")


def _check_sensitivity(found: dict[str, Any], table: Table, context: Context) -> None:
    _not_own(found, "parameters", table, context)
    for name in found["tolerances"] or ():
        if found["parameters"] and name not in found["parameters"]:
            raise table.error("tolerances", unknown_name("parameter", name, found["parameters"]))


def _check_worst(found: dict[str, Any], table: Table, context: Context) -> None:
    _not_own(found, "ranges", table, context)
    if found["grid"] and len(found["ranges"]) > 2:
        raise table.error("grid", "a confirming grid needs one or two parameters in ranges")


def _check_map(found: dict[str, Any], table: Table, context: Context) -> None:
    _not_own(found, "grid", table, context)
    if found["kind"] == "surface" and len(found["grid"]) == 1:
        raise table.error("kind", "a surface needs two parameters in grid")


_NAME = Key(v.result_name, "Names its files, and the result elsewhere in the study. Letters, digits, `-`, `_`, `.`.",
            needed=True)
_PARAMETER = Key(v.parameter, "The parameter that varies.", needed=True)
_BOUNDS = Key(v.bounds, "`[low, high]`.", otherwise="the parameter's own")
_START = Key(v.values, "Parameter values at the start, over those of `[parameters]`.", {}, otherwise="none")
_KEYFRAME = Key(v.keyframe, "The keyframe where the first equilibrium is looked for.", otherwise="the initial pose")
_STATE = Key(v.state, "The same, as an array of all position coordinates.", otherwise="the initial pose")
_FROM = Key(r.reference("search", "branch", "locus", "path"),
            "A point of an earlier result, such as `\"found:E1\"`, in place of start, keyframe and state.",
            otherwise="none")
_DIRECTION = Key(v.direction, "`1` or `-1`: only that way, in which the parameter first grows or falls.",
                 otherwise="both")
_ZEROS = Key(
    v.zeros,
    "Columns and values whose passing is labelled UZ, such as `{ theta_1 = \"10 deg\" }`; "
    "or several values, `[0, \"10 deg\"]`.",
    {},
    otherwise="none",
)
_SETTINGS = Key(v.settings, "Fields of `mjcont.Settings`: `ds`, `ds_max`, `angle`, `chord`, `max_points`, ...", {},
                otherwise="its defaults")
_POINT = Key(r.reference(*SPECIAL, labels=_LOCATED),
             "The special point, such as `\"equilibria:LP1\"`, or `\"D_1:LP1\"` on the first branch of a diagram `D`.",
             needed=True)
_BRANCH = Key(r.curve("branch"), "The branch; the first of a diagram `D` is `D_1`.", needed=True)


def _csv(text: str, default: bool) -> Key:
    return Key(v.flag, f"Whether to write NAME.csv: {text}.", default)


def _png(text: str) -> Key:
    return Key(v.flag, f"Whether to draw NAME.png: {text}.", True)


SEARCH = Kind("searches", "Every equilibrium in a region (`find_equilibria`). Its points are E1, E2, ...", {
    "name": _NAME,
    "start": Key(v.values, "Parameter values, over those of `[parameters]`.", {}, otherwise="none"),
    "region": Key(v.region, "Ranges of joints or observables, such as `{ theta_1 = [\"-90 deg\", 0] }`.", {},
                  otherwise="everywhere"),
    "starts": Key(v.whole(1), "Starts in each round.", 200),
    "seed": Key(v.whole(0), "Seed of the starts.", 0),
    "max_solutions": Key(v.whole(1), "Equilibria after which the search ends.", 200),
    "max_seconds": Key(v.positive("s"), "Time after which the search ends.", otherwise="no limit"),
    "keyframes": Key(v.flag, "Whether the model's keyframes are further starts.", True),
    "csv": _csv("a row an equilibrium", True),
}, _check_search)

BRANCH = Kind("branch", "A curve of equilibria in one parameter.", {
    "name": _NAME, "parameter": _PARAMETER, "bounds": _BOUNDS, "start": _START, "keyframe": _KEYFRAME,
    "state": _STATE, "from": _FROM, "direction": _DIRECTION, "zeros": _ZEROS,
    "csv": _csv("a row a point, angles in degrees", False), "settings": _SETTINGS,
}, _check_branch)

DIAGRAM = Kind("diagrams", "Every branch that the starts reach through branch points (`bifurcation_diagram`). "
                           "They are NAME_1, NAME_2, ..., each with a file.", {
    "name": _NAME, "parameter": _PARAMETER, "bounds": _BOUNDS, "start": _START,
    "keyframes": Key(v.keyframes, "Keyframes to start from as well.", (), otherwise="none"),
    "from": Key(r.references("search", "branch", "locus", "path"),
                "Points of earlier results to start from; a search's name stands for all its points.",
                otherwise="none"),
    "max_branches": Key(v.whole(1), "Branches after which the diagram ends.", 50),
    "csv": _csv("a file a branch", False), "settings": _SETTINGS,
}, _check_diagram)

LOCUS = Kind("loci", "A special point followed in one more parameter (`continue_special`).", {
    "name": _NAME,
    "point": Key(r.reference(*SPECIAL, *LOSING, labels=(*CONTINUABLE, *FOLLOWED)), _POINT.text, needed=True),
    "parameter": Key(v.parameter, "The parameter that is freed.", needed=True),
    "bounds": _BOUNDS, "direction": _DIRECTION, "zeros": _ZEROS,
    "csv": _csv("a row a point", False), "settings": _SETTINGS,
}, _check_locus)

PATH = Kind("paths", "The response to a load that changes slowly, with its jumps (`load_path`).", {
    "name": _NAME,
    "parameter": Key(v.parameter, "The parameter that changes; with `values`.", otherwise="see `loads`"),
    "values": Key(_values, "Its values along the path, such as `[0, 30, 0]`.", otherwise="see `loads`"),
    "loads": Key(_loads, "Where several parameters change: `[{ F = 0 }, { F = 3, k_sp = 12 }]`.",
                 otherwise="see `values`"),
    "start": _START, "keyframe": _KEYFRAME, "state": _STATE, "from": _FROM,
    "landing": Key(v.choice("landing", *LANDINGS), "Where an escape lands: `\"motion\"`, or `\"creep\"` (no inertia).",
                   "motion"),
    "max_time": Key(v.positive("s"), "Time after which a motion counts as not coming to rest.", 1000.0),
    "max_jumps": Key(v.whole(0), "Jumps after which the path ends.", 50),
    "csv": _csv("a row a point, in order of travel", False), "settings": _SETTINGS,
}, _check_path)

HISTORY = Kind("histories", "A motion in time (`simulate`).", {
    "name": _NAME,
    "inputs": Key(_inputs, "Parameters that vary with time: a number, a table or a [shape](#inputs).", {},
                  otherwise="none"),
    "duration": Key(v.positive("s"), "How long.", otherwise="10, or ten periods of an orbit"),
    "start": _START, "keyframe": _KEYFRAME, "state": _STATE,
    "from": Key(r.reference("search", "branch", "locus", "path", "cycles", "response"),
                "A point of an earlier result, such as `\"found:E1\"`, in place of start, keyframe and state; an "
                "orbit, such as `\"response:PD1\"`, under its forcing.", otherwise="none"),
    "timestep": Key(v.positive("s"), "The step; with `tol` the first and largest.", otherwise="the model's"),
    "integrator": Key(v.choice("integrator", *INTEGRATORS, "model"),
                      "One of " + ", ".join(f'`"{name}"`' for name in INTEGRATORS) + ", or `\"model\"`: its own.",
                      "discrete"),
    "tol": Key(v.positive("1"), "Halve the step until that changes the motion by less.", otherwise="no control"),
    "until_rest": Key(v.positive("1"), "End when every speed has stayed below this over 1 s.", otherwise="no"),
    "samples": Key(v.whole(2), "About how many samples are stored.", 2000),
    "csv": _csv("a row a sample", False),
    "columns": Key(v.columns, "Inputs and observables to draw against time in NAME.png.", (), otherwise="no picture"),
}, _check_history)

SENSITIVITY = Kind("sensitivities", "How a special point moves with every parameter (`sensitivities`).", {
    "name": _NAME, "point": _POINT,
    "parameters": Key(v.parameters, "Names or paths such as `\"body:link_1.mass\"`.",
                      otherwise="all that the model declares"),
    "quantities": Key(_quantities, "What moves: the point's parameters, observables, `omega`.",
                      otherwise="the point's parameters"),
    "tolerances": Key(v.tolerances, "Changes that the chart is for, such as `{ m_1 = \"50 g\" }`.", {},
                      otherwise="1 deg, or 1 %"),
    "csv": _csv("a row a parameter", True), "png": _png("a tornado chart"),
}, _check_sensitivity)

WORST = Kind("worst_cases", "The extreme of a special point over a box of parameters (`worst_case`).", {
    "name": _NAME, "point": _POINT,
    "ranges": Key(v.ranges, "The box, such as `{ k_sp = [8, 12] }`.", needed=True),
    "quantity": Key(v.column, "What is extreme.", otherwise="the point's first parameter"),
    "maximise": Key(v.flag, "`false` for the smallest.", True),
    "grid": Key(v.whole(2), "Values a parameter of a grid that confirms the extreme.", otherwise="no grid"),
    "tol": Key(v.positive("1"), "Projected gradient at which it has converged.", 1e-7),
    "csv": _csv("the way to the extreme", True),
}, _check_worst)

MAP = Kind("maps", "A special point over a grid of one or two parameters (`special_map`).", {
    "name": _NAME, "point": _POINT,
    "grid": Key(v.grid, "Values, or `{ from, to, count }`, such as `{ k_sp = { from = 8, to = 12, count = 5 } }`.",
                needed=True),
    "quantity": Key(v.column, "What is drawn.", otherwise="the point's first parameter"),
    "kind": Key(v.choice("kind of picture", "contour", "surface"),
                "For two parameters: `\"contour\"` or `\"surface\"`.", "contour"),
    "csv": _csv("a row a node", True), "png": _png("a line, contours or a surface"),
}, _check_map)

CERTIFICATE = Kind("certificates", "Stability held against simulations beside points of a branch (`verify_stability`). "
                                   "NAME.h5 is the branch with its certificate.", {
    "name": _NAME,
    "branch": Key(r.curve("branch", *LOSING), "The branch, or a curve of orbits; the first of a diagram `D` is `D_1`.",
                  needed=True),
    "n": Key(v.whole(1), "Number of points.", 20),
    "amplitude": Key(v.positive("1"), "Of the disturbance.", 1e-7),
    "tolerance": Key(v.positive("1"), "Relative difference of rate and eigenvalue that confirms.", 0.05),
    "max_steps": Key(v.whole(1), "Steps a point.", 200_000),
    "csv": _csv("a row a point checked", True),
})

BARRIER = Kind("barriers", "The energy that dislodges a rest, along a branch (`barrier_along`).", {
    "name": _NAME, "branch": _BRANCH,
    "saddles": Key(r.curves("branch", "diagram"), "Branches on which to look for passes, too.", (), otherwise="none"),
    "search": Key(v.flag, "Whether passes are searched for.", True),
    "csv": _csv("a row a rest", True), "png": _png("the barrier against the parameter"),
})

# by kind of result, in the order in which they are computed
KINDS = {
    "search": SEARCH, "branch": BRANCH, "diagram": DIAGRAM, "cycles": CYCLES, "response": RESPONSES, "locus": LOCUS,
    "path": PATH, "history": HISTORY, "sensitivity": SENSITIVITY, "worst case": WORST, "map": MAP,
    "hold": HOLD, "design": DESIGN,
    "certificate": CERTIFICATE, "barrier": BARRIER, "modes": MODES, "transfer": TRANSFER, FAMILY: NONLINEAR,
}


def known(kind: str, found: Mapping[str, Any], data: Mapping[str, Any], context: Context) -> k.Known:
    """Return what later tables may know of a result, also where its own table has mistakes."""
    name = data.get("parameter")
    free = (name,) if isinstance(name, str) else ()
    point = found.get("point")
    if point is not None and (kind == "locus" or (kind in ORBITS and not free)):
        try:
            free = (*_free_at(point, context), *free)
        except (MjcontError, KeyError):
            free = ()
    return k.Known(kind, free, bool(data.get("zeros")))
