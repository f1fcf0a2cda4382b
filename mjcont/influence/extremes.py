"""The verb `worst_case`: the largest or smallest value of a special point's quantity over a box of parameters."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Amount
from mjcont.errors import BoundsError, ParameterError, unknown_name
from mjcont.influence.critical import check_targets, follow_point
from mjcont.influence.maps import special_map
from mjcont.influence.sensitivities import sensitivities
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Why
from mjcont.numerics.search.box import Minimum, minimise
from mjcont.results.maps import FollowedPoint, SpecialMap, WorstCase
from mjcont.results.model import units as unit_of
from mjcont.results.points import SpecialPoint, show
from mjcont.results.quantities import check_values

_TOL = 1e-7
_CORNERS = 4  # parameters up to which every corner of the box is a start
_SAME = 1e-7
_SHORTEST = 1e-3
_AT_BOUND = 1e-9


@checked
def worst_case(
    point: SpecialPoint,
    ranges: Mapping[str, tuple[float, float]],
    *,
    quantity: str | None = None,
    maximise: bool = True,
    starts: Sequence[Mapping[str, float]] | None = None,
    grid: int | None = None,
    tol: float = _TOL,
    progress: Amount | None = None,
) -> WorstCase:
    """Return the largest (or smallest) value of a quantity of a special point over a box of parameters.

    The point is followed from one set of values to the next, the gradient is that of `sensitivities`, and steps are
    those of a projected quasi-Newton method; values at which the point does not exist are stepped back from.

    Parameters
    ----------
    point : SpecialPoint
    ranges : mapping of parameter to (low, high), SI and radians
    quantity : str, optional
        The point's own parameter or an observable; default its first parameter.
    maximise : bool
        False for the smallest: an unlock force is largest where it is most negative.
    starts : parameter values to start from, optional
        Default the point itself and the corners of the box (with more than four parameters, the two along the
        gradient).
    grid : int, optional
        Values a parameter of a grid that confirms the extreme; for one or two parameters. If a node of it is better,
        another run starts there.
    tol : float
        Projected gradient, relative to the quantity, at which a run has converged.
    progress : called as progress(done, all), a run or a node of the grid each.

    Returns
    -------
    WorstCase

    Raises
    ------
    MjcontError, NameLookupError, ParameterError, BoundsError
        If the point cannot be followed, or a range, start or name is wrong.
    """
    box = _Box(point, _checked(point, ranges), quantity, maximise)
    if grid is not None and (len(ranges) > 2 or grid < 2):
        raise ParameterError("a confirming grid needs one or two parameters and at least two values of each")
    return _searched(box, box.starts(starts), grid, tol, progress or (lambda done, total: None))


def _searched(
    box: _Box, starts: Sequence[Mapping[str, float]], grid: int | None, tol: float, tell: Amount
) -> WorstCase:
    """Run from every start, and from the best node of the grid that confirms where that is better."""
    total = len(starts) + (grid ** len(box.ranges) if grid is not None else 0)
    runs = []
    for start in starts:
        runs.append(box.run(start, tol))
        tell(len(runs), total)
    found = [r for r in runs if r is not None]
    if grid is None:
        return _result(box, found, len(runs), None)
    nodes = special_map(box.point, box.grid(grid), progress=lambda done, nodes: tell(len(starts) + done, total))
    if nodes.exists.any():
        top = nodes.largest(box.quantity, smallest=not box.maximise)
        best = min((r.minimum.value for r in found), default=math.inf)
        if box.sign * top[box.quantity] / box.size < best - _SAME:
            box.known.append((box.unit(top.parameters), top))
            again = box.run({n: top[n] for n in box.ranges}, tol)
            runs.append(again)
            found += [again] if again is not None else []
    return _result(box, found, len(runs), nodes)


def _result(box: _Box, found: Sequence[_Run], tried: int, grid: SpecialMap | None) -> WorstCase:
    if not found:  # nothing in the box was reached: what there is, is the point itself
        reason = box.failures[0].message if box.failures else "no start was reached"
        return WorstCase(
            box.point, box.quantity, box.point[box.quantity], box.maximise,
            {n: box.point.model.values(box.point.parameters)[n] for n in box.ranges}, {}, math.nan, "not converged",
            f"nothing in the box was reached: {reason}", box.evaluations, (), (0, tried), grid,
        )
    run = min(found, key=lambda r: r.minimum.value)
    m, values = run.minimum, box.values(run.minimum.u)
    same = sum(abs(r.minimum.value - m.value) <= _SAME for r in found)
    active = {}
    for name, u, g in zip(box.ranges, m.u, m.gradient, strict=True):
        if (u <= _AT_BOUND and g > 0) or (u >= 1.0 - _AT_BOUND and g < 0):
            active[name] = "low" if u <= _AT_BOUND else "high"
    status = "stationary"
    if m.failure is not None:
        status = "at the edge" if m.failure.why is Why.UNDEFINED else "not converged"
    lost = [f for f in box.failures if f.status == "ceased"] or box.failures
    edge = lost[-1].message if lost else ""
    words = [{
        "stationary": "at bounds of the box" if len(active) == len(m.u) else "stationary in the box",
        "at the edge": f"beside it the point is lost: {edge}",
        "not converged": str(m.failure),
    }[status]]
    words.append(f"{same} of {tried} runs end here")
    if status == "stationary" and box.failures:
        words.append(f"parts of the box were not reached: {box.failures[0].message}")
    if grid is not None:
        words.append(_confirmed(box, m.value, grid))
    return WorstCase(
        run.point, box.quantity, run.point[box.quantity], box.maximise, values, active,
        m.kkt, status, "; ".join(words), box.evaluations,
        tuple(run.path), (same, tried), grid,
    )


def _confirmed(box: _Box, value: float, grid: SpecialMap) -> str:
    there = grid.exists
    shape = " x ".join(str(n) for n in there.shape)
    if not there.any():
        return f"a grid of {shape} reached no node"
    top = grid.largest(box.quantity, smallest=not box.maximise)[box.quantity]
    word = "none better" if box.sign * top / box.size >= value - _SAME else "a better one, which no run could keep"
    missing = f", {int((~there).sum())} nodes without the point" if not there.all() else ""
    return f"a grid of {shape} has {word}, {show(top, unit_of(box.point.model)[box.quantity])} at best{missing}"


@dataclass(frozen=True, slots=True)
class _Run:
    """One minimisation: its end, the special point there, and the improvements on the way."""

    minimum: Minimum
    point: SpecialPoint
    path: Sequence[Mapping[str, float]]


class _Box:
    """The quantity over the box in coordinates that run from 0 to 1, signed so that it is minimised."""

    def __init__(
        self, point: SpecialPoint, ranges: Mapping[str, tuple[float, float]], quantity: str | None, maximise: bool
    ) -> None:
        self.point, self.ranges, self.maximise = point, dict(ranges), maximise
        known = [*point.free, *point.observables]
        self.quantity = quantity or next(iter(point.free))
        if self.quantity not in known:
            raise unknown_name("quantity", self.quantity, known)
        self.sign = -1.0 if maximise else 1.0
        self.low = np.array([r[0] for r in ranges.values()])
        self.width = np.array([r[1] - r[0] for r in ranges.values()])
        self.size = abs(point[self.quantity]) or 1.0
        self.failures: list[FollowedPoint] = []
        self.known: list[tuple[Array, SpecialPoint]] = [(self.unit(point.parameters), point)]
        self._before = point.model.evaluations

    @property
    def evaluations(self) -> int:
        """Evaluations so far."""
        return int(self.point.model.evaluations - self._before)

    def unit(self, values: Mapping[str, float]) -> Array:
        """Return parameter values as coordinates of the box."""
        here = self.point.model.values(values) if not self.ranges.keys() <= values.keys() else values
        u: Array = (np.array([here[n] for n in self.ranges]) - self.low) / self.width
        return u

    def values(self, u: Array) -> dict[str, float]:
        """Return the parameter values at coordinates, exactly those of the bounds at 0 and 1."""
        ends = zip(self.ranges.items(), u, self.low + self.width * u, strict=True)
        return {n: (r[0] if c <= 0.0 else r[1] if c >= 1.0 else float(v)) for (n, r), c, v in ends}

    def locate(self, u: Array) -> SpecialPoint | None:
        """Return the special point at u, followed from the nearest known one, or None where it does not exist."""
        distance = [float(np.linalg.norm(v - u)) for v, _ in self.known]
        for i in np.argsort(distance, kind="stable")[:2]:
            if distance[i] == 0.0:
                return self.known[i][1]
            found = follow_point(self.known[i][1], self.values(u), shortest=_SHORTEST)
            if found.reached:
                self.known.append((u.copy(), found.point))
                return found.point
            if found.status == "ceased":
                break
        self.failures.append(found)
        return None

    def function(self, u: Array) -> tuple[float, Array] | None:
        """Return the signed quantity, relative to its size, and its gradient in the box's coordinates."""
        p = self.locate(u)
        if p is None:
            return None
        s = sensitivities(p, list(self.ranges), quantities=self.quantity)
        scale = self.sign / self.size
        return scale * p[self.quantity], scale * s.derivatives[:, 0] * self.width

    def starts(self, given: Sequence[Mapping[str, float]] | None) -> list[Mapping[str, float]]:
        """Return the parameter values to start from, the point's own first."""
        if given is not None:
            if not len(given):
                raise ParameterError("name at least one start")
            for start in given:
                check_values(start)
                _inside(self.ranges, start)
            return list(given)
        own = np.clip(self.unit(self.point.parameters), 0.0, 1.0)
        d = len(self.ranges)
        if d <= _CORNERS:
            corners = [np.array(c) for c in itertools.product((0.0, 1.0), repeat=d)]
        else:
            here = self.function(own)
            downhill = own < 0.5 if here is None else here[1] > 0.0
            corners = [np.where(downhill, 0.0, 1.0), np.where(downhill, 1.0, 0.0)]
        return [self.values(own), *(self.values(c) for c in corners)]

    def run(self, start: Mapping[str, float], tol: float) -> _Run | None:
        """Minimise from a start; None if the point does not exist there."""
        path: list[dict[str, float]] = []

        def recorded(u: Array) -> tuple[float, Array] | None:
            found = self.function(u)
            if found is not None:
                value = self.sign * self.size * found[0]
                if not path or self.sign * value < self.sign * path[-1][self.quantity]:
                    path.append({**self.values(u), self.quantity: value})
            return found

        end = minimise(recorded, self.unit(start), tol=tol)
        if end is None:
            return None
        at = self.locate(end.u)
        assert at is not None
        return _Run(end, at, path)

    def grid(self, count: int) -> dict[str, Array]:
        """Return a grid over the box."""
        return {n: np.linspace(low, high, count) for n, (low, high) in self.ranges.items()}


def _checked(point: SpecialPoint, ranges: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    if not ranges:
        raise ParameterError("name at least one parameter with its range, such as {'load_factor': (0.5, 2.5)}")
    checked = {}
    for name, given in ranges.items():
        try:
            low, high = (float(v) for v in given)
        except (TypeError, ValueError) as error:
            raise BoundsError(f"the range of {name} must be two numbers (low, high), got {given!r}") from error
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise BoundsError(f"the range of {name} must be finite with low < high, got ({low:g}, {high:g})")
        checked[name] = (low, high)
    for end in (0, 1):
        check_targets(point, {n: r[end] for n, r in checked.items()})
    return checked


def _inside(ranges: Mapping[str, tuple[float, float]], start: Mapping[str, float]) -> None:
    for name, (low, high) in ranges.items():
        if name not in start:
            raise ParameterError(f"a start needs a value of every parameter of the box; {name} is missing")
        if not low <= start[name] <= high:
            raise BoundsError(f"a start has {name} = {start[name]:g}, outside its range {low:g} .. {high:g}")


