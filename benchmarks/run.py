"""Run the benchmarks: a table that is printed, and a JSON file that is written, row by row."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import auto_peer, cases, compiled, dense, jobs, orbits, peers, sweeps
from benchmarks.book import FAILED, MISSING, Book, Job, Missing
from benchmarks.chords import chord_error
from benchmarks.layout import CHAIN, DENSE, DIAGRAM, JOBS, MEMORY, ORBITS, POINTS, SWEEPS, Table
from benchmarks.measure import machine, medians, seconds
from benchmarks.points import Floor, growth, per_point, split

_US = 1e6
# weight of the parameter in AUTO's arclength, and its largest step, of the size that its own demos use
_WEIGHTS = {
    "overcentre": 1 / 60.0,
    "overcentre 1e+06": 1 / 60.0,
    "nose gear": 1 / 8e5,
    "nose gear full": 1 / 60.0,
    "ab": 1.0,
    "ab vectorized": 1.0,
    "ab compiled": 1.0,
}
_DS_MAX = 0.1
# how fine the diagrams are that are compared, the default among them, and how much finer that is against which their
# chords are measured
_CHORDS, _DEFAULT, _FINER = (3e-5, 3e-6, 3e-7), (3e-6,), 30.0
# the steps tried for AUTO, from the largest on, at first in strides
_STEPS, _STRIDE = np.geomspace(0.5, 0.00005, 161).tolist(), 8
_REPEATS, _QUICK_REPEATS = 9, 5
_MECHANISMS = {
    "overcentre": cases.overcentre,
    "overcentre 1e+06": partial(cases.overcentre, 1e6),
    "nose gear": cases.gear,
    "nose gear full": cases.full_gear,
}
Tell = Callable[[str], None]
Runs = dict[str, Callable[[], float]]


@cache
def _case(name: str) -> cases.Case:
    return _MECHANISMS[name]() if name in _MECHANISMS else cases.reaction(name.removeprefix("ab").strip())


def _with_auto(runs: Runs, case: cases.Case) -> dict[str, str]:
    """Add AUTO-07p to the runs of a case; return why it is missing where it is."""
    missing = auto_peer.missing()
    if missing is not None:
        return {"AUTO": missing}
    peer = auto_peer.AutoPeer(case, _WEIGHTS[case.name], _DS_MAX)
    runs["AUTO"] = lambda: (run := peer.run()).seconds / run.points
    return {}


def _microseconds(runs: Runs, repeats: int, missing: dict[str, str], tell: Tell) -> dict[str, Any]:
    """Return the runs' medians in us, with those that failed or are missing."""
    times, failed = medians(runs, repeats, tell)
    found: dict[str, Any] = {name: _US * value for name, value in times.items()}
    return {**found, **({FAILED: failed} if failed else {}), **({MISSING: missing} if missing else {})}


def mechanism_points(case: cases.Case, repeats: int, tell: Tell) -> dict[str, Any]:
    """Return what a point of a mechanism costs, beside the floor and, where there is one, AUTO."""
    branch = case.run()
    floor = Floor(case, branch)
    runs: Runs = {
        "mjcont": lambda: per_point(case),
        "all eigenvalues": lambda: per_point(case, eigenvalues=True),
        "no rows between": lambda: per_point(case, chord=math.inf),
        "floor": floor.per_point,
    }
    missing = _with_auto(runs, case) if case.name in _WEIGHTS else {}
    found = _microseconds(runs, repeats, missing, tell)
    before = case.problem.evaluations
    case.run()
    evaluations = (case.problem.evaluations - before) / len(branch)
    return {**found, "points": len(branch), "evaluations": evaluations, "split": split(case)}


def plain_points(case: cases.Case, repeats: int, tell: Tell) -> dict[str, Any]:
    """Return what a point of the plain problem costs, beside its peers."""
    runs: Runs = {"mjcont": lambda: per_point(case), "root": lambda: peers.root_stepping(case)}
    missing = _with_auto(runs, case)
    if (why := peers.pycont_missing()) is not None:
        missing["PyCont-Lite"] = why
    else:
        runs["PyCont-Lite"] = lambda: peers.pycont(case)
    return {**_microseconds(runs, repeats, missing, tell), "points": len(case.run())}


class Diagrams:
    """Whole diagrams of a case beside AUTO's, from coarse to fine; AUTO's steps only become smaller."""

    def __init__(self, name: str, repeats: int) -> None:
        self.name, self.repeats, self.first = name, repeats, 0

    def compare(self, chord: float, tell: Tell) -> dict[str, Any]:
        """Compare when AUTO's steps are as large as its chord error allows: that of mjcont's diagram."""
        why = auto_peer.missing() or (compiled.missing() if self.name == "ab compiled" else None)
        if why is not None:
            raise Missing(why)
        case = _case(self.name)
        branch, fine = case.run(chord=chord), case.run(chord=chord / _FINER)
        spans = np.array([case.bounds[1] - case.bounds[0], np.ptp(fine[case.watched])])
        reference = np.column_stack([fine[case.parameter], fine[case.watched]])
        ours = chord_error(np.column_stack([branch[case.parameter], branch[case.watched]]), reference, spans)

        @cache
        def auto(step: int) -> tuple[auto_peer.AutoPeer, auto_peer.AutoRun, float]:
            tell(f"step {step} of AUTO")
            peer = auto_peer.AutoPeer(case, _WEIGHTS[case.name], _STEPS[step])
            run = peer.run()
            return peer, run, chord_error(run.curve, reference, spans)

        last = len(_STEPS) - 1
        strides = [*range(self.first, last, _STRIDE), last]
        fits = next((i for i, step in enumerate(strides) if auto(step)[2] <= ours), len(strides) - 1)
        before = strides[fits - 1] + 1 if fits else self.first
        self.first = next((k for k in range(before, strides[fits]) if auto(k)[2] <= ours), strides[fits])
        peer, run, theirs = auto(self.first)
        runs = {"mjcont": lambda: seconds(lambda: case.run(chord=chord)), "AUTO": lambda: peer.run().seconds}
        times, failed = medians(runs, self.repeats, tell)
        if failed:
            raise RuntimeError("; ".join(f"{name}: {why}" for name, why in failed.items()))
        return {
            **{name: 1e3 * value for name, value in times.items()},
            "chord error": {"mjcont": ours, "AUTO": theirs},
            "points": {"mjcont": len(branch), "AUTO": run.points},
            "AUTO ds_max": _STEPS[self.first],
        }


def plan(quick: bool, repeats: int) -> Iterator[Job]:
    """Yield the rows, in order."""
    for name in _MECHANISMS:
        yield Job(POINTS, name, lambda tell, name=name: mechanism_points(_case(name), repeats, tell))
    yield Job(POINTS, "ab", lambda tell: plain_points(_case("ab"), repeats, tell))
    for links in cases.LINKS[:3] if quick else cases.LINKS:
        measure = partial(_chain, links)
        yield Job(CHAIN, f"chain {links}", measure)
    for name in (*_MECHANISMS, "ab vectorized", "ab compiled"):
        diagrams = Diagrams(name, repeats)
        for chord in _DEFAULT if quick else _CHORDS:
            yield Job(DIAGRAM, f"{name}, {chord:.0e}", partial(diagrams.compare, chord))
    for name in (*orbits.CASES, orbits.FIELD):
        if not (quick and name == "nose gear full"):
            yield Job(ORBITS, name, partial(orbits.compare, name, min(repeats, 5)))
    for name, job in (("nose gear, cusp", sweeps.cusps), ("overcentre, fold", sweeps.folds)):
        yield Job(SWEEPS, name, lambda tell, job=job: _median(job, 1 if quick else 3, tell))
    for name, many in (("100 cells", False), ("100, vectorized", True)):
        yield Job(DENSE, name, lambda tell, many=many: _median(partial(dense.factors_a_row, 100, many), 3, tell))
    if quick:
        return
    yield Job(MEMORY, "chain 80", lambda tell: jobs.memory(80))
    for name, job in (("import", jobs.import_time), ("inspect", jobs.inspect), ("locus of figure 12", jobs.locus)):
        yield Job(JOBS, name, lambda tell, job=job: _median(job, 5, tell))
    yield Job(JOBS, "reproduce", lambda tell: jobs.reproduce())


def _chain(links: int, tell: Tell) -> dict[str, Any]:
    return mechanism_points(cases.chain(links), 3, tell)


def _median(job: Callable[[], float], repeats: int, tell: Tell) -> float:
    times, failed = medians({"": job}, repeats, tell)
    if failed:
        raise RuntimeError(failed[""])
    return times[""]


def main(arguments: list[str] | None = None) -> int:
    """Measure, print, write; return 1 where a row failed, 130 after an interrupt."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path("out/benchmarks.json"))
    parser.add_argument("--repeats", type=int, help=f"default {_REPEATS}, with --quick {_QUICK_REPEATS}")
    parser.add_argument(
        "--quick", action="store_true", help="a few minutes: diagrams at the default chord, short chains, no whole jobs"
    )
    given = parser.parse_args(arguments)
    repeats = given.repeats or (_QUICK_REPEATS if given.quick else _REPEATS)
    book = Book(given.output, {"machine": machine()}, Table())
    print(", ".join(f"{k} {v}" for k, v in book.result["machine"].items()), flush=True)
    try:
        book.run(list(plan(given.quick, repeats)))
    except KeyboardInterrupt:
        print(f"\ninterrupted; written so far: {given.output}", file=sys.stderr)
        return 130
    finally:
        _grown(book)
    print(f"\nwritten: {given.output}")
    if book.broken:
        print(f"{len(book.broken)} rows failed: {', '.join(book.broken)}", file=sys.stderr)
    return 1 if book.broken else 0


def _grown(book: Book) -> None:
    """Add how the cost of a chain's point grows with its links, of those that were measured."""
    rows = {int(name.split()[1]): row.get("mjcont") for name, row in book.result.get(CHAIN, {}).items()}
    known = {n: time for n, time in rows.items() if time is not None and n <= 80}
    if len(known) > 1:
        book.result["growth"] = growth(list(known), list(known.values()))
        print(f"\nthe chain's cost per point grows as nv^{book.result['growth']:.2f}")
        book.write()
