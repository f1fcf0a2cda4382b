"""Run the benchmarks, print one table and write a JSON file."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import auto_peer, cases, jobs, peers
from benchmarks.chords import chord_error
from benchmarks.measure import machine, medians, seconds
from benchmarks.points import Floor, growth, per_point, split
from mjcont.saving import write_file

_US = 1e6
# weight of the parameter in AUTO's arclength, and its largest step, of the size that its own demos use
_WEIGHTS = {
    "overcentre": 1 / 60.0,
    "overcentre 1e+06": 1 / 60.0,
    "nose gear": 1 / 8e5,
    "nose gear full": 1 / 60.0,
    "ab": 1.0,
}
_DS_MAX = 0.1
# how fine the diagrams are that are compared, the default among them, and how much finer that is against which their
# chords are measured
_CHORDS, _FINER = (3e-5, 3e-6, 3e-7), 30.0
# the steps tried for AUTO, from the largest on
_STEPS = np.geomspace(0.5, 0.00005, 161).tolist()


def mechanism_points(case: cases.Case, repeats: int, auto: str | None) -> dict[str, Any]:
    """Return what a point of a mechanism costs, beside the floor and, where there is one, AUTO."""
    branch = case.run()
    floor = Floor(case, branch)
    runs: dict[str, Callable[[], float]] = {
        "mjcont": lambda: per_point(case),
        "all eigenvalues": lambda: per_point(case, eigenvalues=True),
        "no rows between": lambda: per_point(case, chord=math.inf),
        "floor": floor.per_point,
    }
    if auto is None and case.name in _WEIGHTS:
        peer = auto_peer.AutoPeer(case, _WEIGHTS[case.name], _DS_MAX)
        runs["AUTO"] = lambda: (run := peer.run()).seconds / run.points
    found = {name: _US * value for name, value in medians(runs, repeats).items()}
    before = case.problem.evaluations
    case.run()
    evaluations = (case.problem.evaluations - before) / len(branch)
    return {**found, "points": len(branch), "evaluations": evaluations, "split": split(case)}


def diagrams(case: cases.Case, repeats: int) -> dict[str, Any]:
    """Compare whole diagrams of a case from coarse to fine; AUTO's steps only become smaller."""
    found: dict[str, Any] = {}
    largest = math.inf
    for chord in _CHORDS:
        found[f"{case.name}, {chord:.0e}"] = row = same_accuracy(case, repeats, chord, largest)
        largest = row["AUTO ds_max"]
    return found


def same_accuracy(case: cases.Case, repeats: int, chord: float, largest: float = math.inf) -> dict[str, Any]:
    """Compare whole diagrams when AUTO's steps are as large as its chord error allows: that of mjcont's diagram."""
    branch, fine = case.run(chord=chord), case.run(chord=chord / _FINER)
    spans = np.array([case.bounds[1] - case.bounds[0], np.ptp(fine[case.watched])])
    reference = np.column_stack([fine[case.parameter], fine[case.watched]])
    ours = chord_error(np.column_stack([branch[case.parameter], branch[case.watched]]), reference, spans)
    for ds_max in (s for s in _STEPS if s <= largest):
        peer = auto_peer.AutoPeer(case, _WEIGHTS[case.name], ds_max)
        run = peer.run()
        theirs = chord_error(run.curve, reference, spans)
        if theirs <= ours:
            break
    times = medians(
        {"mjcont": lambda: seconds(lambda: case.run(chord=chord)), "AUTO": lambda: peer.run().seconds}, repeats
    )
    return {
        **{name: 1e3 * value for name, value in times.items()},
        "chord error": {"mjcont": ours, "AUTO": theirs},
        "points": {"mjcont": len(branch), "AUTO": run.points},
        "AUTO ds_max": ds_max,
    }


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/benchmarks.json"))
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--quick", action="store_true", help="without the largest chains and the whole jobs")
    given = parser.parse_args()
    auto = auto_peer.missing()
    result: dict[str, Any] = {"machine": machine(), "skipped": [s for s in (auto, peers.pycont_missing()) if s]}
    mechanisms = [cases.overcentre(), cases.overcentre(1e6), cases.gear(), cases.full_gear()]
    result["points [us]"] = {c.name: mechanism_points(c, given.repeats, auto) for c in mechanisms}
    result["points [us]"]["ab"] = plain_points(cases.reaction(), given.repeats, auto)
    links = cases.LINKS[:3] if given.quick else cases.LINKS
    result["chain [us]"] = {n: mechanism_points(cases.chain(n), 3, auto) for n in links}
    sizes = [n for n in links if n <= 80]
    result["growth"] = growth(sizes, [result["chain [us]"][n]["mjcont"] for n in sizes])
    if auto is None:
        result["diagram [ms]"] = {k: v for c in mechanisms for k, v in diagrams(c, given.repeats).items()}
    if not given.quick:
        result["memory [MB]"] = jobs.memory(80)
        result["jobs [s]"] = medians(
            {"import": jobs.import_time, "inspect": jobs.inspect, "locus of figure 12": jobs.locus}, 5
        )
        result["jobs [s]"]["reproduce"] = jobs.reproduce()
    given.output.parent.mkdir(parents=True, exist_ok=True)
    write_file(given.output, json.dumps(result, indent=1))
    print(table(result))
    print(f"written: {given.output}")


def plain_points(case: cases.Case, repeats: int, auto: str | None) -> dict[str, Any]:
    """Return what a point of the plain problem costs, beside its peers."""
    runs: dict[str, Callable[[], float]] = {
        "mjcont": lambda: per_point(case),
        "root": lambda: peers.root_stepping(case),
    }
    if auto is None:
        peer = auto_peer.AutoPeer(case, _WEIGHTS[case.name], _DS_MAX)
        runs["AUTO"] = lambda: (run := peer.run()).seconds / run.points
    if peers.pycont_missing() is None:
        runs["PyCont-Lite"] = lambda: peers.pycont(case)
    return {**{k: _US * v for k, v in medians(runs, repeats).items()}, "points": len(case.run())}


def table(result: dict[str, Any]) -> str:
    """Return the figures as text."""
    lines = [", ".join(f"{k} {v}" for k, v in result["machine"].items()), *result["skipped"], ""]
    head = f"{'a point [us]':<18}{'mjcont':>9}{'floor':>9}{'ratio':>7}{'AUTO':>9}{'ratio':>7}"
    lines.append(f"{head}   mujoco/algebra/python   all eigenvalues   no rows between")
    named = [*result["points [us]"].items(), *((f"chain {n}", row) for n, row in result["chain [us]"].items())]
    for name, row in named:
        ours, cells = row["mjcont"], []
        for peer in ("floor", "AUTO"):
            cells.append(f"{row[peer]:9.1f}{ours / row[peer]:7.2f}" if peer in row else f"{'-':>9}{'-':>7}")
        shares = "/".join(f"{100 * v:.0f} %" for v in row.get("split", {}).values())
        every = "".join(f"{row[k]:18.1f}" for k in ("all eigenvalues", "no rows between") if k in row)
        lines.append(f"{name:<18}{ours:9.1f}{''.join(cells)}   {shares:<21}{every}".rstrip())
        lines += [f"{'':<18}{peer}: {row[peer]:.1f}" for peer in ("root", "PyCont-Lite") if peer in row]
    lines.append(f"the chain's cost per point grows as nv^{result['growth']:.2f}")
    if "diagram [ms]" in result:
        lines += ["", f"{'a diagram, chord':<26}{'mjcont':>9}{'AUTO':>9}{'ratio':>7}   points   chord error"]
        for name, row in result["diagram [ms]"].items():
            points, error = row["points"], row["chord error"]
            lines.append(
                f"{name:<26}{row['mjcont']:9.2f}{row['AUTO']:9.2f}{row['mjcont'] / row['AUTO']:7.2f}   "
                f"{points['mjcont']}/{points['AUTO']}   {error['mjcont']:.1e}/{error['AUTO']:.1e}"
            )
    for key in ("memory [MB]", "jobs [s]"):
        if key in result:
            value = result[key]
            cells = {"chain 80": value} if isinstance(value, float) else value
            lines += ["", key, *(f"  {name:<20}{v:9.3f}" for name, v in cells.items())]
    return "\n".join(lines)
