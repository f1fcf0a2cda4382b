"""What computes the tables of a study, one function a kind: a plan and the results so far give a result and its files.

An interrupt that a computation turns into a shorter result is stored like any other; `interrupted` tells.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from mjcont.errors import MjcontError, unknown_name
from mjcont.results.branch import Branch
from mjcont.results.model import units
from mjcont.results.points import show
from mjcont.results.text import Tabular
from mjcont.studies.choices.runs import run_design, run_hold
from mjcont.studies.keys import Reference
from mjcont.studies.plans import Task
from mjcont.studies.reporter import Reporter


@dataclass(frozen=True, slots=True)
class Running:
    """What a computation works with: the model, the folder for files, the results so far, who hears of it.

    Without a folder nothing is stored or drawn.
    """

    mechanism: Any
    folder: Path | None
    done: Mapping[str, Any]
    reporter: Reporter


Outcome = tuple[Any, list[Path]]


def point_of(done: Mapping[str, Any], reference: Reference) -> Any:
    """Return a point of a result.

    Raises
    ------
    MjcontError
        If the result has no such point; the message lists those it has.
    """
    if reference.result not in done:
        stem = reference.result.rpartition("_")[0]
        raise unknown_name("branch", reference.result, [n for n in done if n.rpartition("_")[0] == stem])
    result, label = done[reference.result], reference.label
    if hasattr(result, "jumps"):
        return result.final
    if label in ("start", "first", "last"):
        return result.row({"start": result.start_index, "first": 0, "last": len(result) - 1}[label])
    try:
        return result.point(label)
    except MjcontError as error:
        raise type(error)(f"'{reference}': {error}") from error


def interrupted(result: Any) -> bool:
    """Whether the user stopped a computation that gave a shorter result."""
    if hasattr(result, "branches"):
        return any(b.interrupted for b in result.branches)
    return bool(getattr(result, "interrupted", False) or getattr(result, "status", "") == "interrupted")


def start_of(given: Mapping[str, Any], done: Mapping[str, Any]) -> dict[str, Any]:
    """Return the start that a table asks for, as functions take it."""
    if given.get("from") is not None:
        return {"start": point_of(done, given["from"])}
    return {key: given[key] for key in ("start", "keyframe", "state")}


def task_line(mechanism: Any, plan: Task) -> str:
    """Return what a task is, in a line."""
    g, unit_of = plan.given, units(mechanism)

    def span(name: str, ends: tuple[float, float]) -> str:
        own = {"frequency": "Hz", "energy": "J"}
        unit = unit_of.get(name, own.get(name, unit_of.get(name.removesuffix(".amplitude"), "")))
        return f"{name} from {show(ends[0], unit, 6)} to {show(ends[1], unit, 6)}"

    def orbits() -> str:
        parts = [f"from {of}"] if of else []
        parts += [span(g["parameter"], g["bounds"])] if g["parameter"] and g["bounds"] else []
        return ", ".join([*parts, *(f"{n} moving" for n in g.get("forcing") or ())])

    of = str(g["point"] or "") if "point" in g else str(g["branch"]) if "branch" in g else ""
    details: dict[str, Callable[[], str]] = {
        "search": lambda: ", ".join(span(n, b) if n in unit_of else n for n, b in g["region"].items()) or "everywhere",
        "diagram": lambda: span(g["parameter"], g["bounds"]),
        "cycles": orbits,
        "response": orbits,
        "nonlinear mode": orbits,
        "locus": lambda: f"{of}, {span(g['parameter'], g['bounds'])}",
        "path": lambda: g["parameter"] + " " + " -> ".join(show(v, unit_of[g["parameter"]], 6) for v in g["values"])
        if g["parameter"] else f"{len(g['loads'])} loads",
        "history": lambda: ", ".join([*([f"{g['duration']:g} s"] if g["duration"] else []),
                                      *(g["inputs"] or ["no inputs"])]),
        "worst case": lambda: f"{of}, " + ", ".join(span(n, b) for n, b in g["ranges"].items()),
        "hold": lambda: g["pose"] if isinstance(g["pose"], str) else ", ".join(g["pose"]),
        "design": lambda: ", ".join(g["targets"]),
        "map": lambda: f"{of}, " + ", ".join(f"{span(n, (a[0], a[-1]))} ({len(a)})" for n, a in g["grid"].items()),
    }
    return f"{plan.kind}: {details[plan.kind]() if plan.kind in details else of}"


def compute(plan: Task, at: Running) -> Outcome:
    """Compute a task and store what it gives."""
    return _RUNS[plan.kind](plan, at)


def _search(plan: Task, at: Running) -> Outcome:
    from mjcont.curves.search import find_equilibria

    g = plan.given
    found = find_equilibria(
        at.mechanism, g["start"], region=g["region"] or None, starts=g["starts"], seed=g["seed"],
        max_solutions=g["max_solutions"], keyframes=g["keyframes"], progress=at.reporter.point,
        **_given(g, "max_seconds"),
    )
    return found, _table(found, plan, at)


def _diagram(plan: Task, at: Running) -> Outcome:
    from mjcont.curves.diagram import bifurcation_diagram

    g = plan.given
    starts: Any = g["start"] or None
    if g["from"]:
        starts = [p for r in g["from"] for p in ([point_of(at.done, r)] if r.label else at.done[r.result])]
        low, high = g["bounds"]
        starts = [p for p in starts if low <= p.parameters[g["parameter"]] <= high]
        if not starts:
            raise MjcontError(f"none of the points in 'from' lies in the bounds of {g['parameter']}")
    if g["keyframes"] and starts is None:
        starts = {}
    found = bifurcation_diagram(
        at.mechanism, g["parameter"], g["bounds"], starts, keyframes=g["keyframes"], max_branches=g["max_branches"],
        progress=at.reporter.point, **g["settings"],
    )
    files = []
    for i, branch in enumerate(found, 1):
        files += store_curve(branch, f"{plan.name}_{i}", g["csv"], at.folder)
    return found, files


def _locus(plan: Task, at: Running) -> Outcome:
    from mjcont.oscillation.loci import continue_special

    g = plan.given
    found = continue_special(
        point_of(at.done, g["point"]), g["parameter"], g["bounds"], direction=g["direction"], zeros=g["zeros"],
        progress=at.reporter.point, **g["settings"],
    )
    return found, store_curve(found, plan.name, g["csv"], at.folder)


def _cycles(plan: Task, at: Running) -> Outcome:
    from mjcont.oscillation.cycles import continue_cycles

    g = plan.given
    common = {"direction": g["direction"], "progress": at.reporter.point, **g["settings"]}
    if g["point"] is not None:
        found = continue_cycles(point_of(at.done, g["point"]), g["parameter"], g["bounds"], **common)
    else:
        pose = {key: g[key] for key in ("start", "keyframe", "state")}
        found = continue_cycles(at.mechanism, g["parameter"], g["bounds"], **pose, **common)
    return found, store_curve(found, plan.name, g["csv"], at.folder)


def _response(plan: Task, at: Running) -> Outcome:
    from mjcont.oscillation.responses import continue_response

    g = plan.given
    common = {"direction": g["direction"], "progress": at.reporter.point, **g["settings"]}
    if g["point"] is not None:
        found = continue_response(point_of(at.done, g["point"]), g["parameter"], g["bounds"], **common)
    else:
        rest = {key: g[key] for key in ("forcing", "start", "frequency", "keyframe", "state")}
        found = continue_response(at.mechanism, g["parameter"], g["bounds"], **rest, **common)
    return found, store_curve(found, plan.name, g["csv"], at.folder)


def _nonlinear(plan: Task, at: Running) -> Outcome:
    from mjcont.oscillation.nonlinear import continue_modes

    g = plan.given
    common = {"resonances": g["resonances"], "progress": at.reporter.point, **g["settings"]}
    if g["point"] is not None:
        found = continue_modes(point_of(at.done, g["point"]), g["parameter"], g["bounds"], **common)
    else:
        rest = {key: g[key] for key in ("mode", "start", "keyframe", "state")}
        found = continue_modes(at.mechanism, g["parameter"], g["bounds"], **rest, **common)
    return found, store_curve(found, plan.name, g["csv"], at.folder)


def _path(plan: Task, at: Running) -> Outcome:
    from mjcont.motion.loadpaths import load_path

    g = plan.given
    way = (g["parameter"], g["values"]) if g["parameter"] else (g["loads"], None)
    options = {**start_of(g, at.done), **{key: g[key] for key in ("landing", "max_time", "max_jumps")}, **g["settings"]}
    found = load_path(at.mechanism, way[0], way[1], progress=at.reporter.step, **options)
    return found, store_curve(found, plan.name, g["csv"], at.folder)


def _history(plan: Task, at: Running) -> Outcome:
    from mjcont.motion.histories import simulate
    from mjcont.results.orbits import OrbitPoint, SpecialOrbit

    g = plan.given
    begin: dict[str, Any] = {"problem": at.mechanism, **start_of(g, at.done)}
    if isinstance(begin["start"], OrbitPoint | SpecialOrbit):
        begin = {"problem": begin["start"]}
    found = simulate(
        **begin, inputs=g["inputs"], duration=g["duration"], progress=at.reporter.step,
        **{key: g[key] for key in ("timestep", "integrator", "tol", "until_rest", "samples")},
    )
    files = store_curve(found, plan.name, g["csv"], at.folder)
    return found, [*files, *(_drawn(partial(found.plot, *g["columns"]), plan, at) if g["columns"] else [])]


def _sensitivity(plan: Task, at: Running) -> Outcome:
    from mjcont.influence.sensitivities import sensitivities

    g = plan.given
    found = sensitivities(
        point_of(at.done, g["point"]), g["parameters"], quantities=g["quantities"], tolerances=g["tolerances"]
    )
    return found, [*_table(found, plan, at), *(_drawn(found.plot, plan, at) if g["png"] else [])]


def _worst(plan: Task, at: Running) -> Outcome:
    from mjcont.influence.extremes import worst_case

    g = plan.given
    found = worst_case(
        point_of(at.done, g["point"]), g["ranges"], progress=at.reporter.step,
        **{key: g[key] for key in ("quantity", "maximise", "grid", "tol")},
    )
    return found, _table(found, plan, at)


def _map(plan: Task, at: Running) -> Outcome:
    from mjcont.influence.maps import special_map

    g = plan.given
    found = special_map(point_of(at.done, g["point"]), g["grid"], progress=at.reporter.step)
    files = _table(found, plan, at)
    if g["png"] and found.exists.any():
        options = {"kind": g["kind"]} if len(found.axes) == 2 else {}
        files += _drawn(partial(found.plot, g["quantity"] or next(iter(found.point.free)), **options), plan, at)
    return found, files


def _hold(plan: Task, at: Running) -> Outcome:
    found = run_hold(plan.given, at.mechanism)
    return found, _table(found, plan, at)


def _design(plan: Task, at: Running) -> Outcome:
    points = {name: point_of(at.done, reference) for name, reference in plan.given["points"].items()}
    found = run_design(plan.given, points, at.reporter.step)
    files = [*_table(found, plan, at), *(_drawn(found.plot, plan, at) if plan.given["png"] else [])]
    if plan.given["xml"] and at.folder is not None:
        files.append(found.to_xml(at.folder / f"{plan.name}.xml"))
    return found, files


def _certificate(plan: Task, at: Running) -> Outcome:
    from mjcont.motion.certificates import verify_stability

    g = plan.given
    found = verify_stability(
        curve_of(at.done, g["branch"]), g["n"], progress=at.reporter.step,
        **{key: g[key] for key in ("amplitude", "tolerance", "max_steps")},
    )
    certificate = found.certificate
    files = store_curve(found, plan.name, False, at.folder)
    return certificate, [*files, *(_table(certificate, plan, at) if certificate is not None else [])]


def _barrier(plan: Task, at: Running) -> Outcome:
    from mjcont.motion.barriers import barrier_along

    g = plan.given
    saddles = [b for name in g["saddles"] for b in curves_of(at.done, name)]
    found = barrier_along(curve_of(at.done, g["branch"]), saddles, search=g["search"], progress=at.reporter.step)
    return found, [*_table(found, plan, at), *(_drawn(found.plot, plan, at) if g["png"] else [])]


def _modes(plan: Task, at: Running) -> Outcome:
    from mjcont.oscillation.modes import modes

    g = plan.given
    found = modes(point_of(at.done, g["point"]))
    files = store_curve(found, plan.name, g["csv"], at.folder)
    return found, [*files, *(_drawn(found.plot, plan, at) if g["png"] else [])]


def _transfer(plan: Task, at: Running) -> Outcome:
    import numpy as np

    from mjcont.oscillation.transfer import transfer

    g = plan.given
    hertz = np.geomspace(g["frequencies"][0], g["frequencies"][1], g["count"]) if g["frequencies"] else None
    found = transfer(point_of(at.done, g["point"]), g["input"], g["output"] or None, hertz)
    files = store_curve(found, plan.name, g["csv"], at.folder)
    return found, [*files, *(_drawn(found.plot, plan, at) if g["png"] else [])]


_RUNS: Mapping[str, Callable[[Task, Running], Outcome]] = {
    "search": _search, "diagram": _diagram, "cycles": _cycles, "response": _response, "locus": _locus, "path": _path,
    "history": _history, "sensitivity": _sensitivity, "worst case": _worst, "map": _map, "hold": _hold,
    "design": _design, "certificate": _certificate,
    "barrier": _barrier, "modes": _modes, "transfer": _transfer,
    "nonlinear mode": _nonlinear,
}


def _given(values: Mapping[str, Any], *keys: str) -> dict[str, Any]:
    return {key: values[key] for key in keys if values[key] is not None}


def _table(found: Tabular, plan: Task, at: Running) -> list[Path]:
    return [found.to_csv(at.folder / f"{plan.name}.csv")] if plan.given["csv"] and at.folder is not None else []


def _drawn(draw: Callable[[], Any], plan: Task, at: Running) -> list[Path]:
    from mjcont.drawing.plotting import save_figure

    return [save_figure(draw().figure, at.folder / f"{plan.name}.png")] if at.folder is not None else []


def store_curve(result: Any, name: str, csv: bool, folder: Path | None) -> list[Path]:
    """Store what has a file of its own, such as a branch, a locus, a load path or a history."""
    if folder is None:
        return []
    files = [result.save(folder / f"{name}.h5")]
    return [*files, result.to_csv(folder / f"{name}.csv")] if csv else files


def curve_of(done: Mapping[str, Any], name: str) -> Branch:
    """Return one branch by name."""
    if name not in done:
        stem = name.rpartition("_")[0]
        raise unknown_name("branch", name, [n for n in done if n.rpartition("_")[0] == stem])
    branch: Branch = done[name]
    return branch


def curves_of(done: Mapping[str, Any], name: str) -> list[Any]:
    """Return the curves that a name in a plot stands for: those of a diagram, or one."""
    return list(done[name].branches) if name in done and hasattr(done[name], "branches") else [curve_of(done, name)]
