"""Longer branches: `extend` goes on from the ends of a branch, computed just now or loaded from a file."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Progress, build_branch, completed, ordered_rows, reporter
from mjcont.curves.loci import default_ends, locus_detectors
from mjcont.curves.walkers import equilibrium_walker
from mjcont.errors import BoundsError, MjcontError, ParameterError
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings, make_settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.points.events import Located
from mjcont.numerics.points.kinds import conditions_of
from mjcont.numerics.points.on_equilibria import critical_square
from mjcont.numerics.points.on_loci import unfolding_stop
from mjcont.numerics.spectra.spectrum import spectrum
from mjcont.numerics.step.arclength import CurvePoint, first_point
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.trace import Trace, Walker, trace
from mjcont.results.branch import Branch
from mjcont.results.model import check_bounds, model_of
from mjcont.results.orbits import CycleBranch
from mjcont.results.points import Mark

_ENDS = ("first", "last")
_SAME = 1e-4


@checked
@np.errstate(all="ignore")
def extend(
    branch: Branch,
    bounds: tuple[float, float] | Mapping[str, tuple[float, float]] | None = None,
    *,
    ends: Sequence[str] = _ENDS,
    progress: Progress | None = None,
    **options: Any,
) -> Branch:
    """Return the branch continued beyond its ends: after an interrupt, a limit, or within wider bounds.

    Parameters
    ----------
    bounds : (low, high) for a branch in one parameter, or a mapping of free parameters to bounds
        Default the branch's own.
    ends : which of "first" and "last" to go on from.

    Raises
    ------
    MjcontError
        If the branch is closed or was loaded without its problem.
    """
    model_of(branch.problem, "the branch")
    if isinstance(branch, CycleBranch):
        raise MjcontError("extend is for equilibria and their loci: follow orbits on by continue_cycles or "
                          "continue_response from curve[-1]")
    if branch.status == "closed":
        raise MjcontError("the branch is closed: it has no ends to extend")
    for end in ends:
        if end not in _ENDS:
            raise ParameterError(f"ends must be among first, last; got '{end}'")
    settings = make_settings({**_own_options(branch), **options})
    free = _free(branch, bounds)
    result = branch
    with clock.limited(settings.max_seconds):
        for end in ends:
            segment = _segment(result, end, free, settings, progress)
            if segment is not None:
                result = _join(result, segment, end)
    return replace(result, free={p.name: (p.low, p.high) for p in free})


def _own_options(branch: Branch) -> dict[str, Any]:
    limits = ("max_points", "max_arclength", "max_seconds", "zeros")
    kept = {k: v for k, v in branch.settings.items() if k not in limits}
    return {"chord": math.inf, **kept}  # infinite settings are not recorded


def _free(branch: Branch, bounds: Any) -> list[Free]:
    """Return the free parameters within the new bounds, which must hold the branch."""
    if bounds is not None and not isinstance(bounds, Mapping):
        if len(branch.free) > 1:
            raise ParameterError(f"several parameters are free ({', '.join(branch.free)}): give bounds as a mapping")
        bounds = {next(iter(branch.free)): bounds}
    given = dict(bounds or {})
    for name in given:
        if name not in branch.free:
            raise ParameterError(f"'{name}' is not free on this branch. Free: {', '.join(branch.free)}.")
    ranges = {n: check_bounds(branch.model, n, given.get(n, own)) for n, own in branch.free.items()}
    for name, (low, high) in ranges.items():
        column, slack = branch[name], 1e-9 * (high - low)
        if column.min() < low - slack or column.max() > high + slack:
            raise BoundsError(
                f"bounds ({low:g}, {high:g}) of {name} leave out part of the branch, which runs from "
                f"{column.min():g} to {column.max():g}"
            )
    return [Free(n, low, high, branch.unit(n)) for n, (low, high) in ranges.items()]


def _segment(
    branch: Branch, end: str, free: Sequence[Free], settings: Settings, progress: Progress | None
) -> Branch | None:
    """Return what follows an end, walked from a regular row before it so that nothing at the end is missed."""
    if _end(branch, end)[0] == "at special point":
        return None
    values = branch.parameters_at(0 if end == "first" else len(branch) - 1)
    if any(not p.low < values[p.name] < p.high for p in free):
        return None
    labels = branch.labels if end == "first" else branch.labels[::-1]
    keep = next((i for i in range(1, len(labels) - 1) if not labels[i]), None)
    if keep is None:
        return None
    index, before = (keep, keep + 1) if end == "first" else (len(branch) - 1 - keep, len(branch) - 2 - keep)
    with clock.unlimited():  # there is a start: a row of the branch
        system = _system(branch, index, free)
        start = _outward(system, branch, index, before, settings)
    if isinstance(start, Refused):
        return None
    zeros = branch.settings.get("zeros", {})
    if branch.kind == "equilibria":
        walker = equilibrium_walker(system, settings, zeros)
    else:
        kind = branch.kind.removesuffix(" locus")
        stop = unfolding_stop(system) if kind == "BP" else None
        detectors = locus_detectors(kind, system, settings, True, zeros)
        walker = Walker(OneByOne(system, settings, detectors), stop, frozenset(default_ends(kind)))
    run = trace(walker, start, reporter(walker.system, progress))
    return _as_branch(branch, system, run, end, settings, _length(system, branch, index, end))


def _length(system: System, branch: Branch, index: int, end: str) -> float:
    """Return the arclength from a row to the end of the branch, which the new curve runs over again."""
    rows = range(index, 0, -1) if end == "first" else range(index, len(branch) - 1)
    step = -1 if end == "first" else 1
    return sum(float(np.linalg.norm(_chord(system, branch, i, i + step))) for i in rows)


def _chord(system: System, branch: Branch, i: int, j: int) -> Array:
    """Return the scaled step from row i to row j in state and free parameters."""
    problem = branch.model
    step = problem.difference(branch.states[j], branch.states[i]) / problem.state_scale
    columns = [(p, branch[p.name]) for p in system.free]
    return np.concatenate([step, [p.coordinate(float(c[j])) - p.coordinate(float(c[i])) for p, c in columns]])


def _end(branch: Branch, end: str) -> tuple[str, str]:
    return branch.ends[0 if end == "first" else -1]


def _system(branch: Branch, index: int, free: Sequence[Free]) -> System:
    problem = branch.model
    values = problem.values(branch.parameters_at(index))
    plain = System(problem, values, free)
    if branch.kind == "equilibria":
        return plain
    local = Local(problem, branch.states[index], values, plain.names, True, plain.ranges)
    square = critical_square(spectrum(local.pencil))
    conditions = conditions_of(branch.kind.removesuffix(" locus"), local, plain, square)
    return System(problem, values, free, conditions, accurate=True)


def _outward(system: System, branch: Branch, index: int, before: int, settings: Settings) -> CurvePoint | Refused:
    x, y = branch.states[index].copy(), system.start_y()
    reference = np.concatenate([_chord(system, branch, before, index), np.zeros(system.k - len(system.free))])
    point = first_point(system, x, y, 1.0, settings)
    if not isinstance(point, Refused) and point.tangent @ reference < 0:
        point = first_point(system, x, y, -1.0, settings)
    return point


def _as_branch(
    branch: Branch, system: System, run: Trace, end: str, settings: Settings, known: float
) -> Branch | None:
    """Return the rows of a run beyond the arclength that is known."""

    def is_new(s: float, e: Located | None) -> bool:
        if e is None:
            return s > known + _SAME
        return s > known - _SAME and not _has(branch, system, e)

    rows = completed(system, ordered_rows(run), settings, [run])
    new = [i for i in range(1, len(rows)) if is_new(float(rows.s[i]), rows.located[i])]
    if not new:
        return None
    rows = rows.chosen(new[::-1] if end == "first" else new)
    return build_branch(branch.kind, rows, [run], branch.start, 0, settings)


def _has(branch: Branch, system: System, e: Located) -> bool:
    """Whether the branch has a special point of that kind at that place."""
    problem, values = system.problem, system.values(e.point.y)
    for p in branch.of_kind(e.kind):
        moved = np.max(np.abs(problem.difference(e.point.x, p.state)) / problem.state_scale)
        shifted = max(abs(f.coordinate(values[f.name]) - f.coordinate(p.parameters[f.name])) for f in system.free)
        if max(moved, shifted) < _SAME:
            return True
    return False


def _join(branch: Branch, segment: Branch, end: str) -> Branch:
    """Return one branch from a branch and the segment at one of its ends, relabelled."""
    front, back = (segment, branch) if end == "first" else (branch, segment)
    ends = list(branch.ends) if len(branch.ends) == 2 else [*branch.ends, *branch.ends]
    ends[0 if end == "first" else 1] = segment.ends[0]
    return replace(
        branch,
        columns={
            n: replace(c, values=np.concatenate([front.columns[n].values, back.columns[n].values]))
            for n, c in branch.columns.items()
        },
        states=np.concatenate([front.states, back.states]),
        spectra=front.spectra.followed_by(back.spectra),
        stability=np.concatenate([front.stability, back.stability]),
        n_unstable=np.concatenate([front.n_unstable, back.n_unstable]),
        residuals=np.concatenate([front.residuals, back.residuals]),
        marks=_relabelled([*front.marks, *(replace(m, index=m.index + len(front)) for m in back.marks)]),
        ends=ends,
        start_index=branch.start_index + (len(segment) if end == "first" else 0),
        neutral_saddles=[*front.neutral_saddles, *back.neutral_saddles],
        certificate=None,  # its rows have moved
    )


def _relabelled(marks: Sequence[Mark]) -> list[Mark]:
    counts: Counter[str] = Counter()
    found = []
    for m in marks:
        counts[m.kind] += 1
        found.append(replace(m, label=f"{m.kind}{counts[m.kind]}"))
    return found
