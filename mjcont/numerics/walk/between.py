"""Rows between the points of a curve of equilibria, laid so that straight lines from row to row stay close to it.

They start on Hermite's polynomial through the four points around with their tangents, are corrected side by side with
matrices interpolated likewise, and are kept where they settle. Points are dense enough for an error of the
interpolation that one correction takes to the noise floor, so that a row costs two evaluations in a batch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.algebra import inverses
from mjcont.numerics.equations.newton import correct, length
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System, equation_sizes
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.hermite import arc, lagrange_each, mixed, node_windows

_NODES = 8
# points nearer to each other than this part of a gap are a cluster
_CLUSTER = 0.2
# gaps shorter than this, or with ends whose tangents differ by more (as a length), stay as they are
_SHORT, _TURNED = 1e-7, 0.6
# entries of the matrices of rows that are corrected together at most, unless they are so few
_ENTRIES, _FEW = 2**19, 4
_ROUNDS = 4
# rows of those that are corrected together for which derivatives are taken where they do not settle without
_RENEWED = 16
# corrections: the largest first one in parts of the gap, the contraction at worst, the largest last one, what may
# remain after it, and below what size corrections that no longer contract are noise; scaled residuals at last
_FIRST, _CONTRACTION, _LAST, _REMAINS, _NOISE, _ERROR = 0.02, 0.3, 1e-11, 1e-13, 1e-9, 5e-13


@dataclass(frozen=True, slots=True)
class Between:
    """Rows between points of a curve.

    Attributes
    ----------
    after : (m,) index of the point before each row.
    fraction : (m,) part of the arclength from that point to the next.
    states, coordinates : (m, nq) and (m, 1), as in `CurvePoint`.
    errors : (m,) scaled residuals, before the last correction.
    """

    after: Array
    fraction: Array
    states: Array
    coordinates: Array
    errors: Array

    def chosen(self, rows: Array) -> Between:
        """Return some of the rows, in the order given or by a mask."""
        return Between(*(getattr(self, name)[rows] for name in Between.__slots__))


@dataclass(slots=True)
class _Nodes:
    """Points of a curve side by side: arclengths (N,), states, coordinates, ways along it, tangents, matrices."""

    s: Array
    states: Array
    coordinates: Array
    ways: Array
    tangents: Array
    jacs: Array


def rows_between(system: System, points: Sequence[CurvePoint], chord: float) -> tuple[Between | None, int]:
    """Return rows between the points of a curve of equilibria, in order, and how many more were needed.

    `chord` is the largest distance of the straight lines between rows from the curve, in scaled unknowns. Rows that do
    not settle between the points on both sides are left out. None where none are needed.
    """
    if len(points) < 2:
        return None, 0
    nodes = _gathered(system, points)
    counts = _counts(nodes, chord)
    after = np.repeat(np.arange(len(counts)), counts)
    if not len(after):
        return None, 0
    firsts = np.repeat(np.cumsum(counts) - counts, counts)
    fraction = (np.arange(len(after)) - firsts + 1.0) / (counts[after] + 1.0)
    windows, sizes = node_windows(nodes.s, np.flatnonzero(counts), _NODES, _CLUSTER)
    parts: list[Between] = []
    together = max(_ENTRIES // (system.n + 1) ** 2, _FEW)
    for size in np.unique(sizes[after]).tolist():
        chosen = np.flatnonzero(sizes[after] == size)
        for first in range(0, len(chosen), together):
            rows = chosen[first : first + together]
            parts.append(_settled(system, nodes, windows[after[rows], :size], after[rows], fraction[rows]))
    found = Between(*(np.concatenate([getattr(p, name) for p in parts]) for name in Between.__slots__))
    return found.chosen(np.lexsort((found.fraction, found.after))), len(after) - len(found.after)


def _gathered(system: System, points: Sequence[CurvePoint]) -> _Nodes:
    """Return the points side by side, with tangents along the order in which they are given."""
    states, coordinates = np.array([p.x for p in points]), np.array([p.y for p in points])
    chords = system.chords(states, coordinates)
    tangents = np.array([p.tangent for p in points])
    ahead = np.concatenate([chords, chords[-1:]])
    tangents *= np.where((tangents * ahead).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
    cosines = (tangents[1:] * tangents[:-1]).sum(axis=1)
    straight = np.sqrt((chords * chords).sum(axis=1))
    lengths = [arc(d, c) for d, c in zip(straight.tolist(), cosines.tolist(), strict=True)]
    return _Nodes(
        np.concatenate([[0.0], np.cumsum(lengths)]),
        states,
        coordinates,
        np.concatenate([np.zeros((1, chords.shape[1])), np.cumsum(chords, axis=0)]),
        tangents,
        np.array([p.jac for p in points]),
    )


def _counts(nodes: _Nodes, chord: float) -> Array:
    """Return how many rows each gap needs, (N - 1,): an arc of length h and curvature k is k h^2 / 8 off its chord."""
    lengths = np.diff(nodes.s)
    turns = np.sqrt((np.diff(nodes.tangents, axis=0) ** 2).sum(axis=1))
    bends = np.where(lengths > _SHORT, turns / np.maximum(lengths, _SHORT), 0.0)
    largest = bends.copy()
    for mine, other in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
        near = lengths[other] >= _CLUSTER * lengths[mine]  # curvature grows towards a neighbour that bends more
        largest[mine] = np.maximum(largest[mine], np.where(near, 0.5 * (bends[mine] + bends[other]), 0.0))
    pieces = np.ceil(lengths * np.sqrt(largest / (8.0 * chord)))
    pieces[(lengths <= _SHORT) | (turns > _TURNED)] = 1
    found: Array = np.maximum(pieces.astype(int), 1) - 1
    return found


def _settled(system: System, nodes: _Nodes, windows: Array, after: Array, fraction: Array) -> Between:
    """Return those of some rows that settle, given the points (m, k) each is interpolated through."""
    n = system.n
    gaps = nodes.s[after + 1] - nodes.s[after]
    weights = lagrange_each(nodes.s[windows] - nodes.s[after][:, None], fraction * gaps)
    steps = (weights[:, :, None] * (nodes.ways[windows] - nodes.ways[after][:, None])).sum(axis=1)
    states, coordinates = system.move_each(nodes.states[after], nodes.coordinates[after], steps)
    matrix = np.empty((len(after), n + 1, n + 1))
    matrix[:, n], matrix[:, :n] = nodes.tangents[after], mixed(weights, nodes.jacs, windows)
    inverse = inverses(matrix)[:, :, :n]
    begun = states.copy(), coordinates.copy()
    errors, kept = _corrected(system, states, coordinates, inverse, equation_sizes(matrix[:, :n]), _FIRST * gaps)
    for i in np.flatnonzero(~kept)[:_RENEWED].tolist():  # interpolated matrices are too far off: derivatives there
        x, y = begun[0][i], begun[1][i]
        c = correct(system, x, y, nodes.tangents[after[i]], None, Settings())
        near = length(system.difference(c.x, c.y, x, y)) <= _FIRST * gaps[i]
        if c.failure is None and c.error <= _ERROR and near:
            states[i], coordinates[i], errors[i], kept[i] = c.x, c.y, c.error, True
    return Between(after[kept], fraction[kept], states[kept], coordinates[kept], errors[kept])


def _corrected(
    system: System, states: Array, coordinates: Array, inverse: Array, scale: Array, reach: Array
) -> tuple[Array, Array]:
    """Correct rows in place with inverse matrices (m, n + 1, n); return their errors and which settle within a reach.

    Errors are residuals over `scale` (m, n) before the last correction, which leaves less than the noise of f.
    """
    errors, kept = np.empty(len(states)), np.zeros(len(states), dtype=bool)
    last, rows = np.empty(len(states)), np.arange(len(states))
    for turn in range(_ROUNDS + 1):
        residuals = system.residuals_at(states[rows], coordinates[rows])
        errors[rows] = np.max(np.abs(residuals) / scale[rows], axis=1)
        moves = (inverse[rows] @ residuals[:, :, None])[:, :, 0]
        sizes = np.sqrt((moves * moves).sum(axis=1))
        ratios = sizes / last[rows] if turn else np.ones(len(rows))  # of the first correction nothing is known
        slow = (ratios > _CONTRACTION) & (turn > 0)
        settled = (sizes <= _LAST) & (sizes * np.minimum(ratios, 1.0) <= _REMAINS) | slow & (sizes <= _NOISE)
        kept[rows] = settled & (errors[rows] <= _ERROR)
        moved = ~slow & (sizes <= reach[rows])
        last[rows], changed = sizes, rows[moved]
        states[changed], coordinates[changed] = system.move_each(states[changed], coordinates[changed], -moves[moved])
        rows = rows[moved & ~kept[rows]]
        if not len(rows):
            break
    return errors, kept
