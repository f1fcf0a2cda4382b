"""What a click means as a table of a study: a row becomes a start and a state, a nudge a state beside it.

A study's `from` takes labelled points only, and a table only results that are computed before it; a start with a state
stands by itself. Whatever a page may ask for is bounded here.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from typing import Any

import numpy as np

from mjcont.errors import MjcontError, NameLookupError, ParameterError, unknown_name
from mjcont.mechanism.mechanism import Mechanism
from mjcont.numerics.equations.problem import Array
from mjcont.oscillation.modes import modes
from mjcont.results.branch import Branch
from mjcont.results.loadpaths import LoadPath
from mjcont.results.orbits import CycleBranch
from mjcont.results.points import Point

# the tables that a page may add, and what their results are called
TABLES = {
    "branch": "equilibria", "diagrams": "diagram", "loci": "locus", "cycles": "cycles", "responses": "response",
    "paths": "path", "histories": "history", "sensitivities": "sensitivities", "maps": "map", "barriers": "barrier",
}
# of what a page may ask for: the largest values, by key; and the finest chord, which adds rows
LARGEST = {"max_points": 10_000, "samples": 10_000, "duration": 1e4, "max_branches": 50, "max_jumps": 50,
           "max_time": 1e4}
FINEST = 1e-6
_NODES = 2500
# of a nudge: in rad and sizes of the model
NUDGE = 0.01
# coordinates as large as the largest but for rounding: the first of them gives a mode its sign and phase
_AS_LARGE = 1.0 - 1e-6


def table_of(
    table: str, args: Mapping[str, Any], results: Mapping[str, Any], mechanism: Mechanism, common: Mapping[str, float],
    given: Container[str] = (),
) -> dict[str, Any]:
    """Return the table of a study that a click stands for, but for its name.

    Parameters
    ----------
    table : one of `TABLES`.
    args : the table's keys, and of these, where they are, made plain: `row`, {"curve", "row"}, the row of a result at
        which it begins; `nudge`, a disturbance of that along its critical mode, in rad and sizes of the model.
    results : those that there are, by name.
    common : the study's values for all results.
    given : names of results that no table of the study computes.

    Raises
    ------
    MjcontError
        If there is no such table, result or row, or more is asked for than a page may.
    """
    if table not in TABLES:
        raise unknown_name("table", table, TABLES)
    found = {key: value for key, value in args.items() if value is not None and key not in ("row", "nudge")}
    for key in ("name", "csv", "png"):
        if key in found:
            raise ParameterError(f"'{key}' is not for a page to say")
    _check_size(found)
    if args.get("row") is not None:
        curve, index = _row_of(args["row"])
        if curve not in results:
            raise unknown_name("curve", curve, results)
        if isinstance(results[curve], CycleBranch) and curve in given:
            raise ParameterError(f"'{curve}' is of a file: a study goes on from orbits of its own curves only")
        found |= _begun(table, found, curve, index, args.get("nudge"), results, mechanism, common)
    return found


def _check_size(found: Mapping[str, Any]) -> None:
    """Refuse what would take a browser or this machine too long."""
    settings = found.get("settings")
    given = {**found, **(settings if isinstance(settings, Mapping) else {})}
    for key, most in LARGEST.items():
        if isinstance(given.get(key), int | float) and not given[key] <= most:
            raise ParameterError(f"{key} = {given[key]} is more than a page may ask for: up to {most:g}")
    chord = given.get("chord", FINEST)
    if isinstance(chord, int | float) and not chord >= FINEST:
        raise ParameterError(f"chord = {chord} is less than a page may ask for: from {FINEST:g} on")
    grid = found.get("grid")
    counts = [a.get("count", 1) if isinstance(a, Mapping) else len(a) if isinstance(a, list) else 1
              for a in (grid.values() if isinstance(grid, Mapping) else ())]
    if all(isinstance(n, int) for n in counts) and int(np.prod([float(n) for n in counts])) > _NODES:
        raise ParameterError(f"{' x '.join(map(str, counts))} nodes are more than a page may ask for: {_NODES}")


def _begun(
    table: str, found: Mapping[str, Any], curve: str, index: int, nudge: Any, results: Mapping[str, Any],
    mechanism: Mechanism, common: Mapping[str, float],
) -> dict[str, Any]:
    """Return the keys that let a table begin at a row."""
    result = results[curve]
    if isinstance(result, CycleBranch):
        return {"from": f"{curve}:{_orbit_label(result, index)}"}
    point, state = point_at(result, index), None
    own = {n: v for n, v in point.parameters.items() if n in mechanism.parameters or ":" in n}
    if table == "paths":
        point = _resting(result, index, point)
        name = found.get("parameter")
        if isinstance(name, str) and name in point.parameters and isinstance(found.get("values"), list):
            own.pop(name, None)
            first = float(point.parameters[name])
            return {"values": [first, *found["values"]], **_start(point.state, own, mechanism, common)}
    if table == "histories" and (nudge is not None or point.n_unstable):
        state = nudged(point, NUDGE if nudge is None else nudge)
    return _start(point.state if state is None else state, own, mechanism, common)


def _start(
    state: Array, own: Mapping[str, float], mechanism: Mechanism, common: Mapping[str, float]
) -> dict[str, Any]:
    """Return a start and a state; values that all results have go without saying."""
    usual = mechanism.values(common)
    start = {n: float(v) for n, v in own.items() if n not in usual or v != usual[n]}
    return {**({"start": start} if start else {}), "state": [float(x) for x in state]}


def _row_of(row: Any) -> tuple[str, int]:
    if not isinstance(row, Mapping) or not isinstance(row.get("curve"), str) or type(row.get("row")) is not int:
        raise ParameterError('a row is given as {"curve": its name, "row": its number}')
    return row["curve"], row["row"]


def _orbit_label(result: CycleBranch, index: int) -> str:
    """Return what a study calls an orbit of a curve."""
    places = {result.start_index: "start", len(result) - 1: "last", 0: "first"}
    label = dict(enumerate(result.labels)).get(index) or places.get(index)
    if not label:
        raise ParameterError("of orbits take a labelled one, the first or the last: a study can name no other")
    return label


def point_at(result: Any, index: int) -> Point:
    """Return a row of a curve or of a load path as a point.

    Raises
    ------
    MjcontError
        If there is no such row, or the result has none.
    """
    if isinstance(result, LoadPath):
        rows = [(s.branch, int(i)) for s in result.segments for i in s.rows()]
        if not 0 <= index < len(rows):
            raise NameLookupError(f"row {index} of {len(rows)}: rows are 0 to {len(rows) - 1}")
        return rows[index][0].row(rows[index][1])
    if isinstance(result, Branch):
        if index < 0:
            raise NameLookupError(f"row {index} of {len(result)}: rows are 0 to {len(result) - 1}")
        return result.row(index)
    raise MjcontError("this has no rows to begin at: choose a row of a branch, a locus or a load path")


def _resting(result: Any, index: int, point: Point) -> Point:
    """Return the point, or the stable one beside a fold: nothing rests at an unstable one."""
    beside: Iterable[int] = ()
    if isinstance(result, Branch) and result.labels[index]:
        beside = (i for i in (index - 1, index + 1) if 0 <= i < len(result))
    stable = next((result.row(i) for i in beside if result.stability[i] == "stable"), None)
    if stable is not None:
        return stable
    if point.n_unstable:
        raise ParameterError("nothing rests at an unstable row: choose a stable one for a load to begin at")
    return point


def nudged(point: Point, amplitude: float) -> Array:
    """Return a state beside an equilibrium, along the mode that grows fastest, or where none does along the slowest.

    Parameters
    ----------
    point : Point
    amplitude : of the largest coordinate, in rad and sizes of the model; of either sign.
    """
    if not isinstance(amplitude, int | float) or not 0.0 < abs(amplitude) <= 1.0:
        raise ParameterError(f"a nudge is a number other than 0, up to 1 rad or size of the model, got {amplitude!r}")
    model, found = point.model, modes(point)
    growing = [m for m in found if m.growing]
    mode = max(growing, key=lambda m: m.eigenvalue.real) if growing else found[0]  # the slowest
    shape = mode.shape / model.typical
    largest = shape[int(np.flatnonzero(np.abs(shape) >= _AS_LARGE * np.abs(shape).max())[0])]
    return model.retract(point.state, amplitude * model.typical * (shape / largest).real)
