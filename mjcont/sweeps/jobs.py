"""A sweep's job as plain data, and the cases of it that a worker computes.

A job is one JSON text: the model's MJCF, the parameters declared beside it, the points at the nominal case. Nothing is
pickled but texts and numbers, and nothing is read from files. A case depends on its job, its parameter values and
its parent's points alone, not on what its worker did before.
"""

from __future__ import annotations

import json
import math
import threading
import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mjcont.curves.collect import make_point
from mjcont.curves.continuation import continue_equilibria
from mjcont.curves.loci import continue_special
from mjcont.errors import MjcontError, ParameterError
from mjcont.influence.alongside import Fellows, Place
from mjcont.influence.critical import follow_point
from mjcont.mechanism.mechanism import Mechanism
from mjcont.results.branch import Branch
from mjcont.results.model import provenance
from mjcont.results.points import Mark, SpecialPoint

METHODS = ("follow", "trace")
NOMINAL = -1
_MARK = ("kind", "label", "index", "tolerance", "converged", "coefficients", "note")
_HERE = threading.local()  # a Mechanism is not shared between threads


@dataclass(frozen=True, slots=True)
class PointPlan:
    """A named point: `label` on a branch of the study, or on the curve of the point `of` in one more parameter."""

    name: str
    label: str
    branch: str = ""
    of: str = ""
    parameter: str = ""
    bounds: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class Item:
    """A case to be computed: its values, the case it starts from and, unless that is in the same task, its points."""

    case: int
    values: tuple[float, ...]
    parent: int = NOMINAL
    points: Mapping[str, Any] | None = None


def plain_point(point: SpecialPoint) -> dict[str, Any]:
    """Return what a special point is continued from, as JSON has it; floats survive to the bit."""
    return {**_placed(point), **{n: getattr(point, n) for n in (*_MARK, "curve")}}


def _placed(point: SpecialPoint | Place) -> dict[str, Any]:
    return {
        "parameters": dict(point.parameters),
        "state": point.state.tolist(),
        "free": {n: list(b) for n, b in point.free.items()},
    }


def point_of(plain: Mapping[str, Any], mechanism: Mechanism) -> SpecialPoint:
    """Return the special point again, on a mechanism."""
    row = make_point(mechanism, np.array(plain["state"]), mechanism.values(plain["parameters"]), plain["kind"])
    mark = Mark(**{n: plain[n] for n in _MARK})
    return mark.on(row, {n: (b[0], b[1]) for n, b in plain["free"].items()}, plain["curve"])


def describe_model(mechanism: Any, names: Sequence[str], friction: str) -> dict[str, Any]:
    """Return a mechanism as plain data.

    Raises
    ------
    ParameterError
        If it cannot be rebuilt from text: made from a compiled model, a plain vector field, or with Python functions.
    """
    if getattr(mechanism, "mjcf", None) is None:
        raise ParameterError("a sweep needs a Mechanism made from XML or a spec: its workers build the model from text")
    for name in names:
        mechanism.parameter(name)
    for name, given in mechanism.declared.items():
        if "function" in given:
            raise ParameterError(
                f"parameter '{name}' is the Python function {given['function']}, which a sweep cannot ship to its "
                "workers: declare it by paths, such as spec:geom:rod.size[0]"
            )
    return {"mjcf": mechanism.mjcf, "friction": friction, "declared": dict(mechanism.declared)}


def build(model: Mapping[str, Any]) -> Mechanism:
    """Return the mechanism of `describe_model` again."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # said when the sweep was set up
        mechanism = Mechanism.from_xml(model["mjcf"], friction=model["friction"])
    mechanism.declare_again(model["declared"])
    return mechanism


def trace_points(
    mechanism: Mechanism, branches: Sequence[Mapping[str, Any]], plans: Sequence[PointPlan], values: Mapping[str, float]
) -> dict[str, SpecialPoint]:
    """Return the named points, from branches and curves traced with parameter values over those of the plans."""
    traced: dict[str, Branch] = {}
    by_name = {b["name"]: b for b in branches}
    found: dict[str, SpecialPoint] = {}
    for plan in plans:
        key = f"{plan.of} {plan.parameter}" if plan.of else plan.branch
        if key not in traced and plan.of:
            special = found[plan.of]
            traced[key] = continue_special(special, plan.parameter, plan.bounds, chord=math.inf)  # for its points alone
        elif key not in traced:
            traced[key] = _branch(mechanism, by_name[plan.branch], values)
        try:
            found[plan.name] = traced[key].point(plan.label)
        except MjcontError as error:
            raise type(error)(f"point '{plan.name}': {error}") from error
    return found


def _branch(mechanism: Mechanism, b: Mapping[str, Any], values: Mapping[str, float]) -> Branch:
    state = None if b["state"] is None else np.array(b["state"])
    low, high = b["bounds"]
    return continue_equilibria(
        mechanism, b["parameter"], (low, high), {**b["start"], **values}, keyframe=b["keyframe"], state=state,
        direction=b["direction"], zeros=b["zeros"], **b["settings"],
    )


def read_quantity(points: Mapping[str, SpecialPoint] | Mapping[str, SpecialPoint | Place], quantity: str) -> float:
    """Return a quantity such as "cusp.F_ul": a parameter, observable or coefficient of a point; NaN where it is not.

    Raises
    ------
    NameLookupError
        If the point has nothing of that name.
    """
    name, _, column = quantity.partition(".")
    point = points.get(name)
    if point is None:
        return math.nan
    coefficient = point.coefficients.get(column)
    return float(coefficient) if isinstance(coefficient, float) else float(point[column])


class Worker:
    """A job made ready in a worker: its model is compiled, its points are on it."""

    def __init__(self, job: str) -> None:
        self.text, self.job = job, json.loads(job)
        here = json.loads(json.dumps(provenance(None)))
        if here != self.job["versions"]:
            raise MjcontError(f"a worker has other versions, {here}, than the sweep, {self.job['versions']}")
        self.names: list[str] = self.job["names"]
        self._make()

    def _make(self) -> None:
        self.mechanism = build(self.job["model"])
        self.points = {n: point_of(p, self.mechanism) for n, p in self.job["points"].items()}
        self.fellows: dict[str, Fellows] = {}
        if self.job["method"] == "follow":
            for name, point in self.points.items():
                columns = [q.partition(".")[2] for q in self.job["record"] if q.partition(".")[0] == name]
                if (fellows := Fellows.of(point, columns)) is not None:
                    self.fellows[name] = fellows
        self.nominal = {n: Place(p.parameters, p.state, p.free) for n, p in self.points.items()}

    def run(self, items: Sequence[Item], points: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
        """Return the records of cases whose parents' points are known, side by side where that pays."""
        began = time.monotonic()
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            side_by_side = self._side_by_side(items, points)
            share = (time.monotonic() - began) / len(items)
            return [self._case(i, p, s, share) for i, p, s in zip(items, points, side_by_side, strict=True)]

    def _side_by_side(self, items: Sequence[Item], points: Sequence[Mapping[str, Any]]) -> list[dict[str, Place]]:
        """Return for each case the points that were moved to it from its parent beside those of the others."""
        found: list[dict[str, Place]] = [{} for _ in items]
        if not self.fellows:
            return found
        values = [dict(zip(self.names, item.values, strict=True)) for item in items]
        sound = [i for i, v in enumerate(values) if self._is_sound(v)]
        for name, fellows in self.fellows.items():
            places: dict[int, Place] = {}
            starts = [places.setdefault(items[i].parent, self._place(name, points[i])) for i in sound]
            for i, place in zip(sound, fellows.moved(starts, [values[i] for i in sound]), strict=True):
                if place is not None:
                    found[i][name] = place
        return found

    def _case(
        self, item: Item, points: Mapping[str, Any], known: Mapping[str, Place], seconds: float
    ) -> dict[str, Any]:
        """Return the record of a case; whatever goes wrong in it is a sentence there."""
        began = time.monotonic() - seconds
        if self.mechanism.constrained:
            self._make()  # MuJoCo's constraint solver starts from its last solution
        before = self.mechanism.evaluations - sum(p.evaluations for p in known.values())
        values = dict(zip(self.names, item.values, strict=True))
        found: dict[str, SpecialPoint | Place] = dict(known)
        sentences: list[str] = []
        try:
            self._check(values)
            if self.job["method"] == "follow":
                self._follow(values, points, found, sentences)
            else:
                plans = [PointPlan(**p) for p in self.job["plans"]]
                found |= trace_points(self.mechanism, self.job["branches"], plans, values)
        except Exception as error:
            sentences.append(_sentence(error))
        record = {q: read_quantity(found, q) for q in self.job["record"]}
        return {
            "case": item.case,
            "from": item.parent if points else NOMINAL,
            "status": "failed" if sentences else "ok",
            "message": "; ".join(sentences),
            "values": {q: v if math.isfinite(v) else None for q, v in record.items()},
            "points": {n: self._plain(n, p) for n, p in found.items()} if self.job["method"] == "follow" else {},
            "evaluations": self.mechanism.evaluations - before,
            "seconds": round(time.monotonic() - began, 4),
        }

    def _place(self, name: str, points: Mapping[str, Any]) -> Place:
        """Return where a point of the parent is, the nominal one where it has none."""
        p = points.get(name)
        if p is None:
            return self.nominal[name]
        free = {n: (b[0], b[1]) for n, b in p["free"].items()}
        return Place(p["parameters"], np.array(p["state"]), free)

    def _plain(self, name: str, point: SpecialPoint | Place) -> dict[str, Any]:
        """Return what a point is continued from; one that was moved differs from the nominal one in its place alone."""
        if isinstance(point, SpecialPoint):
            return plain_point(point)
        return {
            **self.job["points"][name], **_placed(point), "tolerance": point.tolerance,
            "coefficients": dict(point.coefficients),
        }

    def _is_sound(self, values: Mapping[str, float]) -> bool:
        """Whether there is a model at these values; why there is none is found when the case is computed alone."""
        try:
            self._check(values)
        except Exception:
            return False
        return True

    def _check(self, values: Mapping[str, float]) -> None:
        for name, value in values.items():
            p = self.mechanism.parameter(name)
            if value < 0 <= p.bounds[0]:
                low, high = p.bounds
                raise ParameterError(f"{name} = {value:g} is negative, and its bounds are [{low:g}, {high:g}]")
        self.mechanism.values(values)

    def _follow(
        self, values: Mapping[str, float], starts: Mapping[str, Any], found: dict[str, SpecialPoint | Place],
        said: list[str],
    ) -> None:
        """Follow each point that is not found yet from its parent, and where that fails from the nominal case."""
        for name, nominal in self.points.items():
            if name in found:
                continue
            for start in ([point_of(starts[name], self.mechanism)] if name in starts else []) + [nominal]:
                try:
                    moved = follow_point(start, values)
                except MjcontError as error:
                    reason = _sentence(error)
                    continue
                if moved.reached:
                    found[name] = moved.point
                    break
                reason = moved.message
            else:
                said.append(f"{name}: {reason}")


def _sentence(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text if isinstance(error, MjcontError) else f"{type(error).__name__}: {text}"


def run_items(job: str, items: Sequence[Item]) -> list[dict[str, Any]]:
    """Compute cases in this process and return their records."""
    worker: Worker | None = getattr(_HERE, "worker", None)
    if worker is None or worker.text != job:
        worker = _HERE.worker = Worker(job)
    done: dict[int, dict[str, Any]] = {}
    left = list(items)
    while left:  # what hangs on cases of the task waits for them
        waiting = {item.case for item in left}
        ready = [item for item in left if item.parent not in waiting]
        left = [item for item in left if item.parent in waiting]
        starts = [(done[i.parent]["points"] if i.parent in done else i.points) or {} for i in ready]
        done.update({record["case"]: record for record in worker.run(ready, starts)})
    return list(done.values())


def write_job(
    model: Mapping[str, Any], names: Sequence[str], points: Mapping[str, SpecialPoint], record: Sequence[str],
    method: str = "follow", plans: Sequence[PointPlan] = (), branches: Sequence[Any] = (),
) -> str:
    """Return a job as one text."""
    return json.dumps({
        "model": model,
        "names": list(names),
        "points": {n: plain_point(p) for n, p in points.items()},
        "record": list(record),
        "method": method,
        "plans": [asdict(p) for p in plans] if method == "trace" else [],
        "branches": [asdict(b) for b in branches] if method == "trace" else [],
        "versions": provenance(None),
    }, sort_keys=True)
