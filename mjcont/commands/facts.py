"""What `--json` prints: results as plain data, numbers in SI units and radians, with their units beside them."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mjcont.numerics.points.kinds import name_of
from mjcont.results.branch import Branch
from mjcont.results.points import Point, SpecialPoint

if TYPE_CHECKING:
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.results.linear.modes import Modes
    from mjcont.studies.answers import Answer
    from mjcont.studies.compare import Comparison


def as_json(facts: Mapping[str, Any]) -> str:
    """Return facts as JSON; what is no number or not finite is null."""
    return json.dumps(_plain(facts), indent=2, ensure_ascii=False, allow_nan=False)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, np.ndarray | list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, complex | np.complexfloating):
        return {"re": _plain(value.real), "im": _plain(value.imag)}
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, int | np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(value) if math.isfinite(value) else None
    return value if value is None or isinstance(value, str) else str(value)


def of_result(result: Any) -> dict[str, Any]:
    """Return what is to be known of a result: of curves their points, of all a summary in words."""
    if isinstance(result, Branch):
        return _branch(result)
    kind = type(result).__name__
    if hasattr(result, "branches"):
        return {"kind": kind, "branches": [_branch(b) for b in result]}
    words = {name: getattr(result, name, None) for name in ("status", "message")}
    facts: dict[str, Any] = {"kind": kind, **{name: text for name, text in words.items() if isinstance(text, str)}}
    points = getattr(result, "points", None)
    if isinstance(points, Sequence) and all(isinstance(p, Point) for p in points):
        facts["points"] = [of_point(p) for p in points]
    return {**facts, "summary": str(result)}


def _branch(branch: Branch) -> dict[str, Any]:
    return {
        "kind": branch.kind,
        "free": {n: {"low": low, "high": high, "unit": branch.unit(n)} for n, (low, high) in branch.free.items()},
        "fixed": {n: {"value": v, "unit": branch.fixed_units.get(n, "")} for n, v in branch.fixed.items()},
        "rows": len(branch),
        "start": of_point(branch.row(branch.start_index)),
        "stability": Counter(str(word) for word in branch.stability),
        "points": [of_point(p) for p in branch.special_points],
        "ends": [{"status": status, "message": message} for status, message in branch.ends],
    }


def of_point(point: Point) -> dict[str, Any]:
    """Return a point's values with their units, and of a special point what it is."""
    named = {**point.parameters, **point.observables}
    known = {**({n: p.unit for n, p in point.problem.parameters.items()} if point.problem else {}), **point.units}
    values = {n: {"value": v, "unit": known.get(n, "")} for n, v in named.items()}
    facts: dict[str, Any] = {"stability": point.stability, "unstable": point.n_unstable, "values": values}
    if not isinstance(point, SpecialPoint):
        return facts
    own = {"label": point.label, "kind": point.kind, "name": name_of(point.kind), "row": point.index}
    located = {"coefficients": point.coefficients, "tolerance": point.tolerance, "converged": point.converged}
    return {**own, "free": list(point.free), **located, **facts}


def of_mechanism(mechanism: Mechanism, modes: Modes | None, files: Sequence[str]) -> dict[str, Any]:
    """Return what `inspect` knows of a model."""
    parameters = {
        p.name: {"value": p.value, "unit": p.unit, "bounds": p.bounds, "kind": p.kind}
        for p in mechanism.parameters.values()
    }
    swinging = [
        {"eigenvalue": m.eigenvalue, "frequency": m.frequency, "damping ratio": m.damping_ratio} for m in modes or ()
    ]
    return {
        "model": mechanism.name,
        "degrees of freedom": mechanism.n,
        "parameters": parameters,
        "observables": {o.name: {"unit": o.unit} for o in mechanism.observables.values()},
        "keyframes": list(mechanism.keyframes),
        "notes": list(mechanism.notes),
        "modes": swinging,
        "files": list(files),
    }


def of_study(study: Any, results: Sequence[tuple[Any, Sequence[Path]]], plots: Sequence[Path]) -> dict[str, Any]:
    """Return what a run gave: each result with its files."""
    told = [
        {"name": plan.name, "files": [str(f) for f in files], **of_result(result)}
        for plan, (result, files) in zip(study.plans, results, strict=False)
    ]
    return {"study": study.file, "model": study.mechanism.name, "results": told, "plots": [str(p) for p in plots]}


def of_answers(study: Any, answers: Sequence[Answer]) -> dict[str, Any]:
    """Return the answers of a study, by what its points mean."""
    return {"study": study.file, "model": study.mechanism.name, "answers": {a.meaning: _answer(a) for a in answers}}


def _answer(answer: Answer) -> dict[str, Any]:
    point, name = answer.point, answer.quantity
    facts = {"point": answer.reference, "quantity": name, "unit": point.units.get(name, ""), "value": point[name],
             "start": answer.here, "margin": answer.margin}
    worst, influence, checked = answer.worst, answer.influence, answer.simulation
    if worst is not None:
        facts["worst case"] = {"unknown": worst} if isinstance(worst, str) else {
            "value": worst.value, "at": worst.parameters, "status": worst.status, "message": worst.message}
    facts["most sensitive to"] = {"unknown": influence} if isinstance(influence, str) else {
        "parameter": influence.name, "tolerance": influence.tolerance, "change": influence.change}
    if checked is not None:
        facts["simulation"] = {"unknown": checked} if isinstance(checked, str) else {
            "points": len(checked), "holds": checked.holds,
            "contradicted": len(checked.of("contradicted")), "message": checked.headline}
    return {**facts, "at": of_point(point)}


def of_comparison(found: Comparison) -> dict[str, Any]:
    """Return what changed between two models and in their answers."""
    curves = [
        {
            "name": c.name,
            "points": [
                {"old": of_point(m.old) if m.old is not None else None,
                 "new": of_point(m.new) if m.new is not None else None}
                for m in c.points
            ],
            "old": _branch(c.old),
            "new": _branch(c.new),
        }
        for c in found.curves
    ]
    old, new = found.names
    return {"old": old, "new": new, "model": list(found.model), "curves": curves, "missing": list(found.missing)}
