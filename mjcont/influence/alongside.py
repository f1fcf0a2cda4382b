"""Special points of many variants of a model moved side by side, where that pays: folds and cusps of smooth models.

What is not reached in one step is left to `follow_point`, which takes shorter ones and says what is in the way.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mjcont.influence.critical import around, point_names, within
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.points.alongside import move
from mjcont.numerics.points.kinds import KINDS
from mjcont.results.points import SpecialPoint

_MOVED = ("LP", "CP")
# states of all variants in one evaluation, at most, of so many for each and each degree of freedom
_STATES, _PER_DEGREE = 2**14, 20


@dataclass(frozen=True, slots=True)
class Place:
    """Where a special point is: what another one of its kind is continued from.

    Attributes
    ----------
    parameters : a value for every parameter.
    state : (nq,) array.
    free : the parameters of the curve it was found on, with their bounds.
    coefficients, tolerance : as those of a SpecialPoint.
    observables : those that were asked for.
    evaluations : of the forces, to come here.
    """

    parameters: Values
    state: Array
    free: Mapping[str, tuple[float, float]]
    coefficients: Mapping[str, float] = field(default_factory=dict)
    observables: Mapping[str, float] = field(default_factory=dict)
    tolerance: float = 0.0
    evaluations: int = 0

    def __getitem__(self, name: str) -> float:
        """Return the value of a parameter, or of an observable that was read."""
        return self.parameters[name] if name in self.parameters else self.observables[name]


class Fellows:
    """Variants of a special point that can be moved side by side; of their observables, `columns` are read."""

    def __init__(self, point: SpecialPoint, columns: Sequence[str]) -> None:
        self._problem, self._names = point.model, point_names(point)
        self._coefficient = KINDS[point.kind].coefficients[0]
        self._read = [c for c in columns if c not in point.parameters and c != self._coefficient]
        self._most = max(1, min(self._problem.together(self._names), _STATES // (_PER_DEGREE * self._problem.n)))

    @classmethod
    def of(cls, point: SpecialPoint, columns: Sequence[str] = ()) -> Fellows | None:
        """Return the fellows of a point; None where its variants are moved one after the other."""
        if point.kind not in _MOVED or not point.converged:
            return None
        problem, names = point.model, point_names(point)
        if problem.together(names) == 1:
            return None
        held = problem.rigid_modes(point.state, problem.values(point.parameters))
        return None if held else cls(point, columns)

    def moved(self, starts: Sequence[Place], targets: Sequence[Values]) -> list[Place | None]:
        """Return where points come to at other parameter values; None for those that are to be moved alone."""
        for name in {name for t in targets for name in t}:
            self._problem.parameter(name)  # a path becomes one
        parts = [slice(first, first + self._most) for first in range(0, len(starts), self._most)]
        return [place for part in parts for place in self._bundle(starts[part], targets[part])]

    def _bundle(self, starts: Sequence[Place], targets: Sequence[Values]) -> Iterator[Place | None]:
        """Yield what becomes of each of a few points."""
        problem, names = self._problem, self._names
        firsts = {id(s): i for i, s in reversed(list(enumerate(starts)))}
        like = np.array([firsts[id(s)] for s in starts])
        before = [s.parameters for s in starts]
        after = [{**s.parameters, **t} for s, t in zip(starts, targets, strict=True)]
        free = [[Free(n, *s.free[n], bounded=False) for n in names] for s in starts]
        values = np.array([[s.parameters[n] for n in names] for s in starts])
        variants = problem.variants([*before, *after], names)
        m = move(problem, variants, np.array([s.state for s in starts]), free, values, like)
        for i, (start, own) in enumerate(zip(starts, m.values.tolist(), strict=True)):
            known = dict(zip(names, own, strict=True))
            if not m.reached[i] or not all(within(problem.parameters[n], v) for n, v in known.items()):
                yield None
                continue
            bounds = {n: around(problem.parameters[n], b, known[n]) if n in known else b for n, b in start.free.items()}
            coefficients = {self._coefficient: float(m.coefficient[i])}
            here, x = {**after[i], **known}, m.x[i].copy()
            read = problem.measure(x[None], here, self._read)[0].tolist() if self._read else []
            observables = dict(zip(self._read, read, strict=True))
            yield Place(here, x, bounds, coefficients, observables, float(m.tolerance[i]), int(m.evaluations[i]))
