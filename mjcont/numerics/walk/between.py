"""Rows between the points of a curve, laid so that straight lines from row to row stay close to it.

They start on the polynomial through the eight points around, are corrected side by side with matrices interpolated
likewise, and are kept where they settle. Points are dense enough for an error of the interpolation that one correction
takes to the noise floor, so that a row costs two evaluations in a batch.

Along a locus of special points f = 0 alone is solved for, by the shortest way to its surface. How far the row is from
the locus on that surface the interpolation tells, for which the tangents count, too: by what the point farthest away
changes, of which less is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.algebra import inverses, kernels
from mjcont.numerics.equations.newton import correct, length
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System, equation_sizes
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.hermite import arc, hermite_each, lagrange_each, mixed, node_windows

_NODES = 8
# points nearer to each other than this part of a gap are a cluster
_CLUSTER = 0.2
# gaps shorter than this, or with ends whose tangents differ by more (as a length), stay as they are
_SHORT, _TURNED = 1e-7, 0.6
# rows that are corrected together at least, and entries of their matrices at most
_TOGETHER, _ENTRIES = 32, 2**19
_ROUNDS = 4
# rows of those that are corrected together for which derivatives are taken where they do not settle without
_RENEWED = 16
# corrections: the largest first one in parts of the gap, the contraction at worst, the largest last one, what may
# remain after it, and below what size corrections that no longer contract are noise; scaled residuals at last
_FIRST, _CONTRACTION, _LAST, _REMAINS, _NOISE, _ERROR = 0.02, 0.3, 1e-11, 1e-13, 1e-9, 5e-13
# points through which loci are interpolated, and by what length the one farthest away may move a row
_NODES_OF_LOCI, _FARTHEST = 6, 1e-8
_TINY = 1e-300


@dataclass(frozen=True, slots=True)
class Between:
    """Rows between points of a curve.

    Attributes
    ----------
    after : (m,) index of the point before each row.
    fraction : (m,) part of the arclength from that point to the next.
    states, coordinates : (m, nq) and (m, k), as in `CurvePoint`.
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
    """Points of a curve side by side: arclengths (N,), states, coordinates, ways along it, tangents, matrices.

    The matrices (N, n, n + free) are those of f over states and free parameters; `across` (N, free, n + free) spans,
    for each, the directions in which f does not change.
    """

    s: Array
    states: Array
    coordinates: Array
    ways: Array
    tangents: Array
    jacs: Array
    across: Array


def rows_between(system: System, points: Sequence[CurvePoint], chord: float) -> tuple[Between | None, int]:
    """Return rows between the points of a curve, in order, and how many more were needed.

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
    most = _NODES_OF_LOCI if system.conditions else _NODES
    windows, sizes = node_windows(nodes.s, np.flatnonzero(counts), most, _CLUSTER)
    parts: list[Between] = []
    together = max(_ENTRIES // (system.n + 1) ** 2, _TOGETHER)
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
    width = system.n + len(system.free)
    jacs = np.array([p.jac[: system.n, :width] for p in points])
    return _Nodes(
        np.concatenate([[0.0], np.cumsum(lengths)]),
        states,
        coordinates,
        np.concatenate([np.zeros((1, chords.shape[1])), np.cumsum(chords, axis=0)]),
        tangents,
        jacs,
        kernels(jacs) if system.conditions else tangents[:, None],
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
    n, width = system.n, nodes.jacs.shape[2]
    gaps = nodes.s[after + 1] - nodes.s[after]
    weights = lagrange_each(nodes.s[windows] - nodes.s[after][:, None], fraction * gaps)
    ways = nodes.ways[windows] - nodes.ways[after][:, None]
    if system.conditions:
        steps, known = _with_tangents(nodes, windows, after, fraction, ways)
    else:
        steps, known = (weights[:, :, None] * ways).sum(axis=1), np.ones(len(after), dtype=bool)
    states, coordinates = system.move_each(nodes.states[after], nodes.coordinates[after], steps)
    matrix = np.empty((len(after), width, width))
    matrix[:, n:], matrix[:, :n] = nodes.across[after], mixed(weights, nodes.jacs, windows)
    inverse = inverses(matrix)[:, :, :n]
    begun = states.copy(), coordinates.copy()
    rows = matrix[:, :n]  # along a locus df/dx is singular, and alone tells no sizes
    scale = np.maximum(np.abs(rows).max(axis=2), _TINY) if system.conditions else equation_sizes(rows)
    errors, kept = _corrected(system, states, coordinates, inverse, scale, _FIRST * gaps)
    kept &= known
    for i in np.flatnonzero(~kept)[:_RENEWED].tolist():  # what is interpolated is too far off: derivatives there
        x, y = begun[0][i], begun[1][i]
        c = correct(system, x, y, nodes.tangents[after[i]], None, Settings())
        near = length(system.difference(c.x, c.y, x, y)) <= _FIRST * gaps[i]
        if c.failure is None and c.error <= _ERROR and near:
            states[i], coordinates[i], errors[i], kept[i] = c.x, c.y, c.error, True
    return Between(after[kept], fraction[kept], states[kept], coordinates[kept], errors[kept])


def _with_tangents(nodes: _Nodes, windows: Array, after: Array, fraction: Array, ways: Array) -> tuple[Array, Array]:
    """Return the steps to rows from the points before them, (m, n + k), and whether they are known well enough, (m,).

    On Hermite's polynomial over the way along the tangent at the point before, of which values and slopes are exact.
    """
    along = nodes.tangents[after]
    places, slopes = (ways * along[:, None]).sum(axis=2), nodes.tangents[windows]
    slopes = slopes / (slopes * along[:, None]).sum(axis=2)[:, :, None]
    at = fraction * ((nodes.ways[after + 1] - nodes.ways[after]) * along).sum(axis=1)

    def steps(chosen: Array) -> Array:
        values, rates, _ = hermite_each(np.take_along_axis(places, chosen, axis=1), at)
        mine, theirs = (np.take_along_axis(a, chosen[:, :, None], axis=1) for a in (ways, slopes))
        found: Array = (values[:, :, None] * mine + rates[:, :, None] * theirs).sum(axis=1)
        return found

    nearest = np.argsort(np.abs(places - at[:, None]), axis=1, kind="stable")
    found = steps(nearest)
    off = found - steps(nearest[:, :-1])
    return found, np.sqrt((off * off).sum(axis=1)) <= _FARTHEST


def _corrected(
    system: System, states: Array, coordinates: Array, inverse: Array, scale: Array, reach: Array
) -> tuple[Array, Array]:
    """Correct rows in place with inverse matrices (m, n + free, n); return errors and which settle within a reach.

    Errors are residuals over `scale` (m, n) before the last correction, which leaves less than the noise of f.
    """
    auxiliary = np.zeros((len(states), system.n + system.k - inverse.shape[1]))
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
        steps = np.concatenate([-moves[moved], auxiliary[changed]], axis=1)
        states[changed], coordinates[changed] = system.move_each(states[changed], coordinates[changed], steps)
        rows = rows[moved & ~kept[rows]]
        if not len(rows):
            break
    return errors, kept
