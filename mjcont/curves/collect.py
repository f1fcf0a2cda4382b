"""From traced curves to results: rows in order, spectra, labelled special points, provenance."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass, field
from functools import partial
from typing import Any

import numpy as np

from mjcont.curves.rows import CurveRows, curve_rows
from mjcont.errors import StartError
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.points.events import Located
from mjcont.numerics.points.kinds import KINDS, holds_eigenvalues
from mjcont.numerics.spectra.spectrum import Spectrum
from mjcont.numerics.spectra.stability import local_spectrum, verdict_at
from mjcont.numerics.step.arclength import CurvePoint, first_point
from mjcont.numerics.walk.steps import End, Item, Status
from mjcont.numerics.walk.trace import Trace, Walker, time_up, trace
from mjcont.results.branch import Branch
from mjcont.results.model import Model, model_of, provenance, units
from mjcont.results.points import Column, Mark, Point, show
from mjcont.results.spectra import Late, Spectra


@dataclass(frozen=True, slots=True)
class Found:
    """A point as it is found, while its curve is still being followed: no label yet, and no kind unless special.

    Observables are those of special points only; of others they can be read from the state and the values of all
    parameters. The state is None where there is none to tell: of starts, and of orbits. `direction` counts the
    directions followed before.
    """

    kind: str
    parameters: Mapping[str, float]
    observables: Mapping[str, float]
    state: Array | None = None
    values: Values = field(default_factory=dict)
    direction: int = 0


Progress = Callable[[int, Found], None]
# of work whose amount is known: done, all
Amount = Callable[[float, float], None]
# scaled distance from a special point within which a row is that point
_SAME = 1e-9


def make_point(problem: Model, x: Array, values: Values, kind: str = "", s: Spectrum | None = None) -> Point:
    """Return the Point of an equilibrium, or of a special point of a kind, with observables, eigenvalues, stability.

    `s` is its spectrum, where that is known.
    """
    s = local_spectrum(Local(problem, x, values, (), False)) if s is None else s
    word, count = verdict_at(KINDS[kind].holds, s) if holds_eigenvalues(kind) else (s.stability, s.n_unstable)
    measured = problem.measure(x[None], values)[0]
    observables = dict(zip(problem.observables, (float(v) for v in measured), strict=True))
    return Point(dict(values), observables, x.copy(), s.eigenvalues, word, count, problem, units(problem), doubt(s))


def doubt(s: Spectrum) -> str:
    """Return what is not known of stability, a sentence; empty where all is known."""
    if s.proven:
        return ""
    return f"stability is known for the nearest {len(s.eigenvalues)} eigenvalues: others may be unstable"


def _found(system: System, item: CurvePoint | Located, direction: int) -> Found:
    values = system.values(item.y if isinstance(item, CurvePoint) else item.point.y)
    free = {n: values[n] for n in system.names}
    if isinstance(item, CurvePoint):
        return Found("", free, {}, item.x, values, direction)
    problem = model_of(system.problem)
    measured = problem.measure(item.point.x[None], values)[0]
    observables = dict(zip(problem.observables, (float(v) for v in measured), strict=True))
    return Found(item.kind, free, observables, item.point.x, values, direction)


def reporter(system: System, progress: Progress | None) -> Callable[[Item], None] | None:
    """Return what a trace calls for each item, so that `progress` hears of points and special points."""
    if progress is None:
        return None
    count = direction = 0

    def report(item: Item) -> None:
        nonlocal count, direction
        direction += isinstance(item, End)
        if isinstance(item, CurvePoint | Located):
            count += isinstance(item, CurvePoint)
            progress(count, _found(system, item, direction))

    return report


def run_directions(
    walker: Walker, x: Array, y: Array, directions: Sequence[float], progress: Progress | None, lead: int = 0
) -> list[Trace]:
    """Walk from a start in the directions given; a closed curve or an interrupt ends after the first.

    The direction is that in which the free parameter `lead` first moves.
    """
    traces: list[Trace] = []
    report = reporter(walker.system, progress)
    for direction in directions:
        if traces and clock.expired():
            traces.append(Trace([], end=time_up(walker.settings)))
            continue
        if traces and traces[-1].end.status in (Status.CLOSED, Status.INTERRUPTED):
            break
        with np.errstate(all="ignore"):  # a state that overflows fails its step; that is reported as such
            try:
                first: CurvePoint | Refused | None = walker.stepper.other_way(traces[0].points) if traces else None
                if first is None:  # there is always a start to tell of
                    with clock.unlimited() if not traces else nullcontext():
                        first = first_point(walker.system, x, y, direction, walker.settings, lead)
            except clock.TimeUp:
                traces.append(Trace([], end=time_up(walker.settings)))
                continue
            if isinstance(first, Refused):
                traces.append(Trace([], end=End(Status.NO_START, f"the curve could not be entered: {first}")))
                continue
            known = [e for t in traces for e in t.special]
            traces.append(trace(walker, first, report, known))
    return traces


def collect(
    kind: str,
    system: System,
    traces: Sequence[Trace],
    directions: Sequence[float],
    origin: str,
    settings: Settings,
    notes: Sequence[str] = (),
) -> Branch:
    """Join the directions of a curve into a branch, special points in their places.

    The branch is stored from the end reached when the parameter first falls, so labels count along it.
    """
    rows: list[tuple[CurvePoint, Located | None]] = []
    start_index = 0
    for run, direction in zip(traces, directions, strict=False):
        ordered = ordered_rows(run)
        if direction < 0:
            rows = ordered[::-1]
            start_index = max(len(rows) - 1, 0)
        else:
            rows += ordered[1:] if rows else ordered
    if not rows:
        name = model_of(system.problem).name
        raise StartError(f"{name}: " + "; ".join(t.end.message for t in traces))
    start = rows[start_index][0]
    table = completed(system, rows, settings, traces)
    start_index = next(i for i, p in enumerate(table.points) if p is start)
    return build_branch(kind, table, traces, origin, start_index, settings, notes)


def completed(
    system: System,
    rows: Sequence[tuple[CurvePoint, Located | None]],
    settings: Settings,
    traces: Sequence[Trace],
) -> CurveRows:
    """Return the rows of a curve, with rows between its points unless the user stopped it.

    An interrupt meanwhile keeps the points, and ends the last of the curve's traces.
    """
    if not any(t.end.status in (Status.INTERRUPTED, Status.MAX_TIME) for t in traces):
        try:
            return curve_rows(system, rows, settings.chord)
        except clock.TimeUp:
            traces[-1].end = time_up(settings)
        except KeyboardInterrupt:
            traces[-1].end = End(Status.INTERRUPTED, "stopped by the user before rows were laid between the points")
    with clock.unlimited():
        return curve_rows(system, rows, math.inf)


def ordered_rows(run: Trace) -> list[tuple[CurvePoint, Located | None]]:
    """Return points and special points of a run in order; a closed curve ends where it began."""
    rows: list[tuple[CurvePoint, Located | None]] = [(p, None) for p in run.points]
    rows += [(e.point, e) for e in run.special]
    rows = sorted(rows, key=lambda r: r[0].s)
    closed = run.end.status is Status.CLOSED and not run.end.full_turns
    return [*rows, rows[0]] if closed else rows


@clock.unlimited()
def build_branch(
    kind: str,
    rows: CurveRows,
    traces: Sequence[Trace],
    origin: str,
    start_index: int,
    settings: Settings,
    notes: Sequence[str] = (),
) -> Branch:
    """Return the branch of ordered rows: columns, spectra, labelled special points, provenance."""
    system, states = rows.system, rows.states
    problem = model_of(system.problem)
    words, counts, spectra = rows.stability(partial(_judged, kind))
    stability, n_unstable = np.array(words, dtype="U8"), np.array(counts)
    known = np.array([e is not None for e in rows.located])
    for special, same in _same_points(rows, any(t.end.status is Status.CLOSED for t in traces)):
        if known[special] and not known[same]:  # rounding would decide on it
            stability[same], n_unstable[same], known[same] = stability[special], n_unstable[special], True
    base, unit_of = rows.values(0), units(problem)
    columns = _columns(rows, problem, unit_of)
    free = {p.name: (p.low, p.high) for p in system.free}
    fixed = {k: v for k, v in base.items() if k not in system.names}
    late = Late(problem, states, fixed, {n: columns[n].values for n in free}, free)
    return Branch(
        kind=kind,
        name=problem.name,
        columns=columns,
        states=_frozen(states),
        state_labels=problem.state_labels,
        spectra=Spectra([None if s is None else s.eigenvalues for s in spectra], late),
        stability=_frozen(stability),
        n_unstable=_frozen(n_unstable),
        residuals=_frozen(rows.errors),
        marks=_marks(rows.located),
        free=free,
        fixed=fixed,
        ends=[(t.end.status.value, t.end.message) for t in traces],
        start=_describe_start(columns, start_index, f"{stability[start_index]} ({origin})"),
        settings={k: v for k, v in asdict(settings).items() if v != math.inf},
        provenance=provenance(problem),
        problem=problem,
        start_index=start_index,
        neutral_saddles=[
            {n: v for n, v in system.values(e.point.y).items() if n in system.names}
            for t in traces
            for e in t.neutral
        ],
        notes=(*notes, *_springs(rows), *_left_out(rows), *_on_stability(kind, rows, stability, n_unstable, spectra)),
        fixed_units={k: u for k, u in unit_of.items() if k in base and k not in system.names},
    )


def _columns(rows: CurveRows, problem: Model, unit_of: Mapping[str, str]) -> dict[str, Column]:
    """Return the columns of a branch: the free parameters, and the observables that have another name."""
    system, base, lead = rows.system, rows.values(0), rows.system.names[0]
    if len(system.free) == 1 and lead in problem.parameters:
        measured = problem.measure_along(rows.states, base, {lead: rows.column(0)})
    else:
        measured = problem.measure(rows.states, [rows.values(i) for i in range(len(rows))])
    columns = {
        p.name: Column(p.name, unit_of[p.name], "parameter", _frozen(rows.column(i))) for i, p in enumerate(system.free)
    }
    for k, name in enumerate(problem.observables):
        if name not in columns:
            columns[name] = Column(name, unit_of[name], "observable", _frozen(measured[:, k]))
    return columns


def _same_points(rows: CurveRows, closed: bool) -> Iterator[tuple[int, int]]:
    """Yield special rows and rows beside them that are the same point: a start may be one, and curves close there."""
    for i, e in enumerate(rows.located):
        for k in (i - 1, i + 1) if e is not None else ():
            if 0 <= k < len(rows):
                at, beside = ((rows.states[m], rows.coordinates[m]) for m in (i, k))
                if np.linalg.norm(rows.system.difference(*beside, *at)) <= _SAME:
                    yield i, k
    if closed:
        yield from ((0, len(rows) - 1), (len(rows) - 1, 0))


def _judged(kind: str, special: Located | None, s: Spectrum) -> tuple[str, int]:
    """Return stability and number of unstable eigenvalues of a row of a curve of a kind."""
    at = _kind_at(kind, special) if special is not None or kind != "equilibria" else ""
    return verdict_at(KINDS[at].holds, s) if at else (s.stability, s.n_unstable)


def _kind_at(curve: str, special: Located | None) -> str:
    """Return the kind of special point that a row is, on a curve of a kind, if such points hold eigenvalues."""
    kinds = (special.kind if special is not None else "", curve.removesuffix(" locus"))
    return next((kind for kind in kinds if holds_eigenvalues(kind)), "")


def _springs(rows: CurveRows) -> list[str]:
    """Return the notes on the stiffness of a mechanism's constraints, over the range of the free parameters."""
    if not model_of(rows.system.problem).constrained:
        return []
    from mjcont.models.springnotes import notes_on  # MuJoCo is imported only where there is a Mechanism

    columns = [rows.column(i) for i in range(len(rows.system.free))]
    ends = [int(pick(c)) for c in columns for pick in (np.argmin, np.argmax)]
    return notes_on(rows.system.problem, [rows.values(i) for i in ends])


def _left_out(rows: CurveRows) -> list[str]:
    """Return a sentence on rows between points that are missing."""
    if not rows.left_out:
        return []
    return [f"{rows.left_out} rows between points did not settle and are left out: chords are longer there"]


def _on_stability(
    kind: str, rows: CurveRows, stability: Array, n_unstable: Array, spectra: Sequence[Spectrum | None]
) -> list[str]:
    """Return a sentence on rows of whose eigenvalues not all that may be unstable are known, else on `_unexplained`."""
    unsure = [s for s in spectra if s is not None and not s.proven]
    if not unsure:
        return _unexplained(kind, rows, stability, n_unstable)
    return [f"in {len(unsure)} of {len(spectra)} rows {doubt(min(unsure, key=lambda s: len(s.eigenvalues)))}"]


def _unexplained(kind: str, rows: CurveRows, stability: Array, n_unstable: Array) -> list[str]:
    """Return a sentence for each change of stability without a special point: several eigenvalues pass zero at once."""
    if kind != "equilibria":
        return []
    found, p = [], rows.system.free[0]
    for i in np.flatnonzero(np.diff(n_unstable)).tolist():
        if rows.located[i] is rows.located[i + 1] is None and "marginal" not in stability[i : i + 2]:
            between = " and ".join(p.show(p.value(float(rows.coordinates[k, 0]))) for k in (i, i + 1))
            count, where = abs(n_unstable[i + 1] - n_unstable[i]), f"between {p.name} = {between}"
            if count == 1:
                found.append(f"an eigenvalue passes the axis {where}: a point that was not located")
            else:
                found.append(f"{count} eigenvalues pass the axis together {where}: a point of higher multiplicity, "
                             "not located")
    return found


def _frozen(data: Any) -> Array:
    array = np.array(data)
    array.flags.writeable = False
    return array


def _marks(located: Sequence[Located | None]) -> list[Mark]:
    """Return the marks of the rows that are special points, labelled in order."""
    counts: Counter[str] = Counter()
    found = []
    for i, e in enumerate(located):
        if e is not None:
            counts[e.kind] += 1
            found.append(mark_of(e, f"{e.kind}{counts[e.kind]}", i))
    return found


def mark_of(e: Located, label: str = "", index: int = 0) -> Mark:
    """Return the mark of a located point: scalars among its data are coefficients, arrays vectors."""
    return Mark(
        kind=e.kind,
        label=label,
        index=index,
        tolerance=e.tolerance,
        converged=e.converged,
        coefficients={k: v for k, v in e.data.items() if isinstance(v, float | str)},
        vectors={k: v for k, v in e.data.items() if isinstance(v, np.ndarray)},
        note=e.note,
    )


def _describe_start(columns: Mapping[str, Column], i: int, how: str) -> str:
    shown = [f"{c.name} = {show(float(c.values[i]), c.unit, 6)}" for c in list(columns.values())[:4]]
    return f"{', '.join(shown)}; {how}"
