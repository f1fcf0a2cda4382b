"""The verb `sweep`: special points of many variants of a model, stored case by case."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import ParameterError
from mjcont.influence.critical import check_alone, check_not_own
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.search.spanning import heights, spanning_tree
from mjcont.outside.saving import output_folder
from mjcont.outside.sealing import digest
from mjcont.results.files import frozen
from mjcont.results.model import provenance, units
from mjcont.results.points import Column, SpecialPoint
from mjcont.results.sweeps import SweepTable
from mjcont.sweeps.cluster import make_crew
from mjcont.sweeps.designs import Spread, Vary, describe_design, make_design, scales
from mjcont.sweeps.engine import Run, Tree
from mjcont.sweeps.jobs import (
    NOMINAL,
    describe_model,
    plain_point,
    read_quantity,
    write_job,
)
from mjcont.sweeps.journal import Journal
from mjcont.sweeps.plan import Setup, Sweepable, SweepPlan, of_points

Progress = Callable[[int, int, int], None]


@checked
def sweep(
    what: Sweepable | Mapping[str, SpecialPoint],
    vary: Vary | None = None,
    *,
    out: str | Path,
    design: str | None = None,
    cases: int | None = None,
    seed: int | None = None,
    record: Sequence[str] | None = None,
    limit: int | None = None,
    workers: int | None = None,
    executor: Executor | None = None,
    scheduler: str | None = None,
    progress: Progress | None = None,
) -> SweepTable:
    """Compute special points of many variants of a model, each with other parameter values.

    A sweep that was stopped goes on where it was when it is called again with the same arguments.

    Parameters
    ----------
    what : Study, or mapping of str to SpecialPoint
        A study with a table [sweep], or points by names of your own; all have the same model and nominal values.
    vary : mapping of str to Spread or values
        Which parameters (names or paths) vary, and how. Of a study: instead of its own; so are the next four.
    out : path
        A folder for sweep.jsonl (the journal), sweep.csv and sweep.h5.
    design : {"latin hypercube", "monte carlo", "quasi-random", "grid", "list"}
    cases, seed : of the first three designs; the second and third go on to more cases when there are more.
    record : sequence of str
        Quantities such as "cusp.F_ul"; default the parameters that each point's defining system solves for.
    limit : int, optional
        Only so many cases, the first of the design; with a larger one later the sweep goes on.
    workers : int, optional
        Processes on this machine; default one a processor. With 1, this process itself.
    executor, scheduler : concurrent.futures.Executor, and address of a Dask scheduler, optional
        One of them instead.
    progress : called as progress(done, all, failed).

    Returns
    -------
    SweepTable

    Raises
    ------
    MjcontError
        If something in the arguments does not fit, the folder holds another sweep, or all workers are lost.
    """
    setup = what.sweep_setup() if isinstance(what, Sweepable) else of_points(what, vary)
    setup, model = _changed(setup, {"vary": vary, "design": design, "cases": cases, "seed": seed}, record)
    values = _values(setup, limit)
    folder = output_folder(out)
    header, earlier = _header(setup, model, values), _earlier(setup, values)
    with Journal(folder / "sweep.jsonl", header, lambda: _begin(setup, model), earlier) as journal:
        _compute(setup, values, journal, lambda: make_crew(executor, scheduler, workers), progress)
        table = _table(setup, values, journal)
    table.to_csv(folder / "sweep.csv")
    table.save(folder / "sweep.h5")
    return table


# -- setting up ----------------------------------------------------------------------------------------------


def _changed(
    setup: Setup, given: Mapping[str, Any], record: Sequence[str] | None
) -> tuple[Setup, dict[str, Any]]:
    """Return the sweep with what was given in place of its own, and its model as plain data."""
    plan = replace(setup.plan, **{k: v for k, v in given.items() if v is not None})
    wanted = setup.record if record is None else tuple(record)
    if len(set(wanted)) != len(wanted) or not wanted:
        raise ParameterError(f"name at least one quantity to record, each once; got {', '.join(wanted) or 'none'}")
    names = list(plan.vary)
    model = describe_model(setup.mechanism, names, setup.friction)
    nominal = {**setup.mechanism.values(), **setup.nominal}
    setup = replace(setup, plan=plan, record=wanted, nominal={n: nominal[n] for n in names})
    _check_names(setup)
    return setup, model


def _values(setup: Setup, limit: int | None) -> Array:
    """Return the parameter values of the cases, (N, number of parameters): the first of the design, if limited."""
    plan = setup.plan
    values = make_design(plan.design, plan.vary, setup.nominal, cases=plan.cases, seed=plan.seed)
    if limit is not None and limit < 1:
        raise ParameterError(f"limit must be a whole number from 1 on, got {limit}")
    return values[:limit]


def _check_names(setup: Setup) -> None:
    """Refuse parameters that the points solve for, and pairs that act on the same field."""
    parameters = {n: setup.mechanism.parameter(n) for n in setup.plan.vary}
    for name in parameters:
        if name in setup.own:
            raise ParameterError(f"{name} is what the points are solved for: it cannot vary, record it")
    plain = [p for p in parameters.values() if p.kind not in ("gravity", "spec")]
    for i, one in enumerate(plain):
        for other in plain[:i]:
            if not one.entries.isdisjoint(other.entries):
                raise ParameterError(f"{one.name} and {other.name} act on the same field of the model: name one")


def _what(plan: SweepPlan, values: Array) -> str:
    seeded = f", seed {plan.seed}" if any(isinstance(s, Spread) for s in plan.vary.values()) else ""
    return f"{plan.design} of {len(values)} cases over {', '.join(plan.vary)}{seeded}"


def _earlier(setup: Setup, values: Array) -> dict[str, tuple[str, ...]]:
    """Return the hash that older versions took of a design: of the values themselves, as many as were asked for."""
    plan = setup.plan
    return {"design": (digest([list(plan.vary), values.tolist(), plan.deepest, dict(setup.nominal)]),)}


def _header(setup: Setup, model: Mapping[str, Any], values: Array) -> dict[str, Any]:
    plan = setup.plan
    design = describe_design(plan.design, plan.vary, setup.nominal, plan.cases, plan.seed)
    where = {n: plain_point(p) for n, p in setup.given.items()} if setup.given is not None else [
        [asdict(p) for p in plan.points], [asdict(b) for b in setup.branches]]
    return {
        "what": _what(plan, values),
        "identity": {
            "model": digest(model),
            "design": digest([design, plan.deepest]),
            "points": digest([where, list(setup.record), plan.method]),
            "versions": digest(provenance(None)),
        },
    }


def _begin(setup: Setup, model: Mapping[str, Any]) -> dict[str, Any]:
    """Compute the nominal case and return it with the job that the workers get."""
    points = setup.points()
    for p in points.values():
        for name in setup.plan.vary:
            check_not_own(p, name)
            check_alone(p, name)
    nominal = {}
    for quantity in setup.record:
        name = quantity.partition(".")[0]
        if name not in points:
            raise ParameterError(f"'{quantity}': a quantity is POINT.NAME, with a point among {', '.join(points)}")
        nominal[quantity] = read_quantity(points, quantity)
    wanted = {q.partition(".")[0] for q in setup.record}
    kept = {n: p for n, p in points.items() if n in wanted}
    plan, names = setup.plan, list(setup.plan.vary)
    job = write_job(model, names, kept, setup.record, plan.method, plan.points, setup.branches)
    return {"nominal": {**setup.nominal, **nominal}, "job": job, "provenance": provenance(setup.mechanism),
            "study": setup.text}


# -- computing -----------------------------------------------------------------------------------------------


def _compute(
    setup: Setup, values: Array, journal: Journal, crew_of: Callable[[], Any], progress: Progress | None
) -> None:
    """Compute the cases that the journal does not have; it may have more than are asked for."""
    count = len(values)
    done = {case: record for case, record in journal.records.items() if case < count}
    failed = sum(r["status"] == "failed" for r in done.values())
    tell: Progress = progress or (lambda done, total, failed: None)
    tell(len(done), count, failed)
    if len(done) == count:
        return

    def store(records: Sequence[Mapping[str, Any]]) -> None:
        nonlocal failed
        journal.add(records)
        done.update({r["case"]: dict(r) for r in records})
        failed += sum(r["status"] == "failed" for r in records)
        tell(len(done), count, failed)

    parents = np.full(count, NOMINAL)
    if setup.plan.method == "follow":
        apart = values - np.array(list(setup.nominal.values()))
        parents = spanning_tree(apart / scales(setup.plan.vary, setup.nominal), setup.plan.deepest)
    tree = Tree(parents.tolist(), heights(parents).tolist(), done)
    crew = crew_of()
    try:
        Run(journal.header["job"], values.tolist(), tree, done, crew, store).go()
    finally:
        crew.close()


def _table(setup: Setup, values: Array, journal: Journal) -> SweepTable:
    rows = [journal.records[i] for i in range(len(values))]
    unit_of = units(setup.mechanism)
    columns = {
        n: Column(n, unit_of[n], "parameter", frozen(values[:, k].copy())) for k, n in enumerate(setup.plan.vary)
    }
    for q in setup.record:
        found = [r["values"].get(q) for r in rows]
        column = np.array([math.nan if v is None else v for v in found])
        columns[q] = Column(q, unit_of.get(q.partition(".")[2], ""), "quantity", frozen(column))
    seed = {"seed": str(setup.plan.seed), "method": setup.plan.method}
    return SweepTable(
        setup.mechanism.name,
        _what(setup.plan, values),
        columns,
        frozen(np.arange(len(rows))),
        frozen(np.array([r["from"] for r in rows])),
        frozen(np.array([r["status"] for r in rows], dtype="U8")),
        tuple(r["message"] for r in rows),
        json.loads(json.dumps(journal.header["nominal"])),
        {**journal.header["provenance"], **seed},
        journal.header["study"],
    )
