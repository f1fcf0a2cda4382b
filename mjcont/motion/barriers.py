"""Margins: the energy that lifts a mechanism from its rest over the lowest pass that leads away from it.

The pass is an equilibrium with one unstable direction (a saddle of the potential energy) from which one of the two
descents ends at the rest; the descents are followed to where they end (`numerics.creep`), nothing is taken for granted.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, pairwise
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Amount
from mjcont.curves.continuation import continue_equilibria, hold_rigid_modes
from mjcont.curves.search import find_equilibria
from mjcont.errors import MjcontError, ParameterError
from mjcont.mechanism.energy import potential_energy, total_energy
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import Local
from mjcont.numerics.search.creep import creep, rates
from mjcont.results.barriers import Barrier, BarrierCurve, BarrierMap
from mjcont.results.branch import Branch, sliced
from mjcont.results.model import check_bounds
from mjcont.results.points import Point

Saddles = Branch | Point | Sequence[Any]
_ASIDE = 1e-2
_SAME = 1e-4
_EQUAL = 1e-9
_STARTS = 100
# distance of rests along a branch, in its largest steps
_APART = 0.25
# so many of the lowest passes found by a search are followed
_PASSES = 2


@checked
def energy_barrier(point: Point, saddles: Saddles | None = None) -> Barrier:
    """Return the energy barrier between a rest and the lowest pass that leads away from it.

    Parameters
    ----------
    point : Point
        A stable equilibrium.
    saddles : branch or point, or a sequence of them, optional
        Where to look for the pass: branches that hold the other parameters at the rest's values. By default every
        equilibrium is searched for.

    Raises
    ------
    MjcontError
        If the point is unstable, or its loads have no potential (a follower force).
    """
    problem, values = _problem(point), point.parameters
    if point.n_unstable:
        raise MjcontError(f"an energy barrier guards a rest, but this point is unstable: {point}")
    total_energy(problem, point.state[None], values)
    return _barrier(problem, point, _candidates(problem, point, saddles))


@checked
def barrier_along(
    branch: Branch, saddles: Saddles | None = None, *, search: bool = True, progress: Amount | None = None
) -> BarrierCurve:
    """Return the energy barriers along the stable points of a branch.

    Rows closer to the last than a quarter of the branch's largest step are passed over, but for the branch's start,
    special points and the last one.
    Passes are taken from the branch itself, from `saddles`, and from a search over all equilibria at the ends and in
    the middle of the range, whose passes are followed from there. A pass that is on none of these is missed.
    `progress(done, all)` hears of every rest.

    Raises
    ------
    MjcontError
        If nothing on the branch is stable, or its loads have no potential.
    """
    (name, *others) = branch.free
    if branch.kind != "equilibria" or others:
        raise MjcontError(f"barrier_along takes a branch of equilibria in one parameter, not a {branch.kind}")
    labels = branch.labels
    rows = [i for i in range(len(branch)) if branch.stability[i] == "stable" or labels[i].startswith("LP")]
    if not any(branch.stability[i] == "stable" for i in rows):
        raise MjcontError("nothing on the branch is stable")
    rows = _spaced(branch, rows, labels)
    rests = [branch.row(i) for i in rows]
    folds = [labels[i].startswith("LP") for i in rows]
    barriers = _along(branch, rests, folds, _listed(saddles), search, progress)
    energy = np.array([b.energy for b in barriers])
    values = np.array([p[name] for p in rests])
    pieces = _pieces(branch.stability, rows, folds)
    return BarrierCurve(name, branch.unit(name), values, energy, np.array(rows), tuple(barriers), pieces)


def _pieces(stability: Sequence[str] | Array, rows: Sequence[int], folds: Sequence[bool]) -> Array:
    """Return the number of the stable piece that each of some rows belongs to; between two pieces rows are unstable."""
    cut = [(folds[k] and folds[k + 1]) or any(s == "unstable" for s in stability[i + 1 : j])
           for k, (i, j) in enumerate(pairwise(rows))]
    return np.concatenate([[0], np.cumsum(cut, dtype=int)])


def _spaced(branch: Branch, rows: Sequence[int], labels: Sequence[str]) -> list[int]:
    """Return those of some rows that lie some way apart along the branch, with start, special points and the last."""
    problem: Any = branch.model
    if problem is None:
        return list(rows)
    ((name, (low, high)),) = branch.free.items()
    steps = problem.difference_each(branch.states[1:], branch.states[:-1]) / problem.state_scale
    lengths = np.sqrt((steps**2).sum(axis=1) + (np.diff(branch[name]) / (high - low)) ** 2)
    s = np.concatenate([[0.0], np.cumsum(lengths)])
    apart = _APART * branch.settings.get("ds_max", Settings().ds_max)
    kept = [rows[0]]
    for i in rows[1:]:
        if s[i] - s[kept[-1]] >= apart or labels[i] or i in (branch.start_index, rows[-1]):
            kept.append(i)
    return kept


@checked
def barrier_map(point: Point, grid: Mapping[str, Any], *, search: bool = True) -> BarrierMap:
    """Return the energy barriers of a rest over a grid of two parameters.

    The rest is followed in the second parameter, and from each of its values in the first, as far as it is stable.

    Parameters
    ----------
    point : Point
        A stable equilibrium; its second parameter is followed to the values of the grid.
    grid : mapping of two parameters to values
    search : bool
        Whether the lowest passes from the point itself are searched for and followed, too. A pass that is neither on
        these nor on the branches of the rest is missed.

    Raises
    ------
    ParameterError, MjcontError
        See their messages.
    """
    if len(grid) != 2:
        raise ParameterError(f"barrier_map takes two parameters with their values, got {', '.join(grid) or 'none'}")
    (x, xs), (y, ys) = ((n, np.unique(np.asarray(v, dtype=float))) for n, v in grid.items())
    if len(xs) < 2 or len(ys) < 2:
        raise ParameterError("each parameter of a barrier_map needs at least two values")
    problem = _problem(point)
    bounds = min(ys[0], point[y]), max(ys[-1], point[y])
    across = continue_equilibria(problem, y, bounds, point)
    passes = _lowest(problem, point) if search else []
    passages = [continue_equilibria(problem, y, bounds, p) for p in passes]
    energy = np.full((len(ys), len(xs)), math.nan)
    units = (problem.parameter(x).unit, problem.parameter(y).unit)
    for j, value in enumerate(ys):
        rest = _rest_at(across, y, float(value))
        if rest is None:
            continue
        low, high = check_bounds(problem, x, None)
        line = continue_equilibria(problem, x, (min(low, xs[0]), max(high, xs[-1])), rest)
        found = [(i, _rest_at(line, x, float(v))) for i, v in enumerate(xs)]
        rests = [(i, p) for i, p in found if p is not None]
        others = [p for b in passages for p in b.at(**{y: float(value)}) if p.n_unstable == 1]
        lines = [continue_equilibria(problem, x, line.free[x], p) for p in others]
        barriers = _along(line, [p for _, p in rests], [False] * len(rests), lines, False)
        for (i, _), b in zip(rests, barriers, strict=True):
            energy[j, i] = b.energy
    return BarrierMap((x, y), units, xs, ys, energy)


def _problem(point: Point) -> Any:
    if point.problem is None:
        raise MjcontError("the point was loaded without its problem: mc.load(path, problem=...)")
    return hold_rigid_modes(point.model, point.state, point.parameters)[0]


def _listed(saddles: Saddles | None) -> list[Any]:
    if saddles is None:
        return []
    return [saddles] if isinstance(saddles, Branch | Point) else list(saddles)


def _rest_at(branch: Branch, name: str, value: float) -> Point | None:
    """Return the point at a value on the stable run of a branch that holds its start."""
    i = j = branch.start_index
    while i > 0 and branch.n_unstable[i - 1] == 0 and not branch.labels[i].startswith("LP"):
        i -= 1
    while j < len(branch) - 1 and branch.n_unstable[j + 1] == 0 and not branch.labels[j].startswith("LP"):
        j += 1
    if j == i:
        return branch.row(i) if branch[name][i] == value else None
    stable = [p for p in sliced(branch, i, j).at(**{name: value}) if p.n_unstable == 0]
    return stable[0] if stable else None


def _along(
    branch: Branch, rests: Sequence[Point], folds: Sequence[bool], saddles: Sequence[Any], search: bool,
    progress: Amount | None = None,
) -> list[Barrier]:
    """Return the barriers of rests of a branch; passes found by a search are followed for the rests that come after."""
    if not rests:
        return []
    problem = _problem(rests[0])
    (name,) = branch.free
    total_energy(problem, np.array([rests[0].state, rests[-1].state]), rests[0].parameters)
    known: list[Any] = [branch, *saddles]
    if search:
        for i in dict.fromkeys((0, len(rests) // 2, len(rests) - 1)):
            known += _further(problem, branch, rests[i], known)
    found = []
    for rest, fold in zip(rests, folds, strict=True):
        if fold:
            found.append(Barrier(0.0, rest, rest, None, 0, "a fold: the rest meets its pass"))
        else:
            found.append(_barrier(problem, rest, _candidates(problem, rest, known)))
        if progress is not None:
            progress(len(found), len(rests))
    return found


def _further(problem: Any, branch: Branch, rest: Point, known: Sequence[Any]) -> list[Branch]:
    """Return branches through the lowest passes from a rest that are on none of the known ones."""
    found: list[Branch] = []
    (name,) = branch.free
    for p in _lowest(problem, rest):
        there = _candidates(problem, rest, [*known, *found])
        if not any(_same(problem, p.state, q.state, rest.parameters) for q in there):
            found.append(continue_equilibria(problem, name, branch.free[name], p))
    return found


def _lowest(problem: Any, rest: Point) -> list[Point]:
    """Return the lowest passes that lead from a rest elsewhere, found by a search over all equilibria."""
    barriers = _barriers(problem, rest, _candidates(problem, rest, None))
    return [b.saddle for b in islice(barriers, _PASSES) if b.saddle is not None]


def _candidates(problem: Any, rest: Point, saddles: Saddles | None) -> list[Point]:
    """Return the equilibria with one unstable direction at the rest's parameters."""
    if saddles is None:
        points: list[Point] = list(find_equilibria(problem, rest.parameters, starts=_STARTS).points)
        return [p for p in points if p.n_unstable == 1]
    points = []
    for item in _listed(saddles):
        if isinstance(item, Branch):
            (name, *others) = item.free
            if others:
                raise ParameterError("a pass is looked for on branches of equilibria in one parameter, not on loci")
            _same_load(item.fixed, rest.parameters)
            points += item.at(**{name: rest.parameters[name]})
        elif isinstance(item, Point):
            _same_load(item.parameters, rest.parameters)
            points.append(item)
        else:
            raise ParameterError(f"saddles must be branches or points, got a {type(item).__name__}")
    return [p for p in points if p.n_unstable == 1]


def _same_load(given: Values, wanted: Values) -> None:
    for n, v in given.items():
        if n in wanted and not math.isclose(v, wanted[n], rel_tol=_EQUAL, abs_tol=1e-12):
            raise ParameterError(f"the pass is at {n} = {v:g}, the rest at {n} = {wanted[n]:g}: their loads must agree")


def _barrier(problem: Any, rest: Point, passes: Sequence[Point]) -> Barrier:
    """Return the barrier over the lowest pass from which a descent ends at the rest."""
    return next(_barriers(problem, rest, passes), Barrier(math.inf, rest, None, None, len(passes), "no pass is known"))


def _barriers(problem: Any, rest: Point, passes: Sequence[Point]) -> Iterator[Barrier]:
    """Yield the barriers over the passes that lead from the rest elsewhere, from the lowest up."""
    if not passes:
        return
    values = rest.parameters
    states = np.array([rest.state, *(p.state for p in passes)])
    energies = potential_energy(problem, states, values, loads=True)
    heights = energies[1:] - energies[0]
    order = [i for i in np.argsort(heights) if heights[i] > 0.0]
    for tried, i in enumerate(order, 1):
        ends = _descents(problem, passes[i], rest)
        back = [_same(problem, e, rest.state, values) for e in ends]
        if any(back) and not _same(problem, ends[0], ends[1]):
            beyond = ends[1] if back[0] else ends[0]
            sentence = "its descents end at the rest" + (", full turns apart" if all(back) else " and elsewhere")
            yield Barrier(float(heights[i]), rest, passes[i], beyond, tried, sentence)


def _descents(problem: Any, saddle: Point, rest: Point) -> tuple[Array, Array]:
    """Return where the descents from a pass along both its unstable directions end."""
    values, scale = rest.parameters, problem.state_scale
    s, vectors, _ = rates(Local(problem, saddle.state, values, (), False))
    v = vectors[:, np.argmax(s.real)].real
    v = v / np.max(np.abs(v) / scale)
    distance = float(np.max(np.abs(problem.difference(saddle.state, rest.state)) / scale))
    aside = min(_ASIDE, 0.1 * distance)
    first, second = (
        creep(problem, problem.retract(saddle.state, sign * aside * v), values).x for sign in (1.0, -1.0)
    )
    return first, second


def _same(problem: Any, a: Array, b: Array, values: Values | None = None) -> bool:
    """Whether two states are the same; with parameter values also if they are full turns apart."""
    step = problem.difference(a, b)
    if values is not None:
        periods = problem.periods(b, values)
        turning = np.isfinite(periods)
        step[turning] -= periods[turning] * np.round(step[turning] / periods[turning])
    return bool(np.max(np.abs(step) / problem.state_scale) < _SAME)
