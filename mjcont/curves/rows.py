"""The rows of a branch in order: the points of a curve, its special points, and rows between them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.events import Located
from mjcont.numerics.points.kinds import KINDS
from mjcont.numerics.spectra.spectrum import Spectrum
from mjcont.numerics.spectra.stability import spectra_at, verdicts
from mjcont.numerics.step.arclength import OUTSIDE, CurvePoint
from mjcont.numerics.walk.between import rows_between

# stability and number of unstable eigenvalues of a row, told by its special point, if it is one, and its spectrum
Judged = Callable[[Located | None, Spectrum], tuple[str, int]]


@dataclass(frozen=True, slots=True)
class CurveRows:
    """Rows in order.

    Attributes
    ----------
    states, coordinates : (N, nq) and (N, k), as in `CurvePoint`.
    errors : (N,) scaled residuals.
    s : (N,) arclength from the start of the row's direction.
    points : the curve's point of each row, None for a row between points.
    located : the special point of each row, or None.
    left_out : number of rows between points that were needed and did not settle.
    """

    system: System
    states: Array
    coordinates: Array
    errors: Array
    s: Array
    points: Sequence[CurvePoint | None]
    located: Sequence[Located | None]
    left_out: int = 0

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.points)

    def chosen(self, indices: Sequence[int]) -> CurveRows:
        """Return some of the rows, in the order given."""
        states, coordinates, errors, s = (a[indices] for a in (self.states, self.coordinates, self.errors, self.s))
        points, located = [self.points[i] for i in indices], [self.located[i] for i in indices]
        return CurveRows(self.system, states, coordinates, errors, s, points, located, self.left_out)

    def values(self, index: int) -> dict[str, float]:
        """Return the value of every parameter in a row."""
        return self.system.values(self.coordinates[index])

    def column(self, i: int) -> Array:
        """Return the values of a free parameter, (N,)."""
        return self.system.free[i].values(self.coordinates[:, i])

    def late_spectra(self, indices: Sequence[int]) -> list[Spectrum]:
        """Return the spectra in some rows."""
        if not len(indices):
            return []
        every: list[Values] = [self.values(i) for i in indices]
        free = dict(zip(self.system.names, self.system.ranges, strict=True))
        return spectra_at(self.system.problem, self.states[indices], every, free)

    def stability(self, judged: Judged) -> tuple[list[str], list[int], list[Spectrum | None]]:
        """Return stability, number of unstable eigenvalues, and the spectrum where it was needed, of every row.

        `judged` takes a row's special point, if it is one, and its spectrum. A row between points has the stability of
        those beside it; where they disagree without a special point that explains it, or both are special points, it
        has one of its own.
        """
        own = [i for i, p in enumerate(self.points) if p is not None]
        special = {k for k, i in enumerate(own) if self.located[i] is not None or self.system.conditions}
        words, counts, spectra = verdicts([p for p in self.points if p is not None], special)
        for k, s in enumerate(spectra):
            if s is not None:
                words[k], counts[k] = judged(self.located[own[k]], s)
        if len(own) == len(self):
            return words, counts, spectra
        found: list[tuple[str, int]] = []
        every: list[Spectrum | None] = []
        asked: list[int] = []
        for k, i in enumerate(own):
            beside = {
                (words[j], counts[j]) for j in (k - 1, k) if j >= 0 and not self._passes(own[j])
            }
            between = i - len(found)
            if len(beside) != 1:
                asked += range(len(found), i)
            found += [min(beside, default=("", 0))] * between
            found.append((words[k], counts[k]))
            every += [None] * between
            every.append(spectra[k])
        for i, s in zip(asked, self.late_spectra(asked), strict=True):
            every[i], found[i] = s, judged(None, s)
        return [w for w, _ in found], [c for _, c in found], every

    def _passes(self, index: int) -> bool:
        """Whether eigenvalues pass the axis in a row."""
        special = self.located[index]
        return special is not None and KINDS[special.kind].crosses


def curve_rows(system: System, rows: Sequence[tuple[CurvePoint, Located | None]], chord: float) -> CurveRows:
    """Return the rows of a curve, with rows between them where these are cheap, so that straight lines stay close."""
    states, coordinates = np.array([p.x for p, _ in rows]), np.array([p.y for p, _ in rows])
    errors, s = np.array([p.error for p, _ in rows]), np.array([p.s for p, _ in rows])
    given = CurveRows(system, states, coordinates, errors, s, [p for p, _ in rows], [e for _, e in rows])
    regular = [i for i, (_, e) in enumerate(rows) if e is None]
    curve = [rows[i][0] for i in regular]
    between, left_out = rows_between(system, curve, chord) if _cheap(system, chord) else (None, 0)
    if between is None:
        return given
    outside = np.array([OUTSIDE.known(p) for p in curve])
    between = between.chosen(~(outside[:-1] | outside[1:])[between.after])  # a curve ends at the first point outside
    at = np.array([p.s for p in curve])
    added = CurveRows(
        system,
        np.concatenate([states, between.states]),
        np.concatenate([coordinates, between.coordinates]),
        np.concatenate([errors, between.errors]),
        np.concatenate([s, at[between.after] + between.fraction * np.diff(at)[between.after]]),
        [*given.points, *[None] * len(between.after)],
        [*given.located, *[None] * len(between.after)],
        left_out,
    )
    places = np.concatenate([_places(rows, regular), between.after + between.fraction])
    return added.chosen(np.argsort(places, kind="stable").tolist())


def _cheap(system: System, chord: float) -> bool:
    """Whether many states that differ in the free parameters are evaluated side by side."""
    return not math.isinf(chord) and all(map(system.problem.side_by_side, system.names))


def _places(rows: Sequence[tuple[CurvePoint, Located | None]], regular: Sequence[int]) -> Array:
    """Return for each row its place along the curve: whole numbers for the points, parts of gaps for special points."""
    places = np.empty(len(rows))
    places[regular] = np.arange(len(regular))
    after = -1
    for i, (p, e) in enumerate(rows):
        if e is None:
            after += 1
        elif after < 0 or after + 1 >= len(regular):
            places[i] = after + 0.5
        else:
            a, b = rows[regular[after]][0], rows[regular[after + 1]][0]
            places[i] = after + min(max((p.s - a.s) / (b.s - a.s), 0.0), 1.0) if b.s != a.s else after + 0.5
    return places
