"""What happens between two points of a curve of equilibria, in pieces: at most one eigenvalue reaches the axis in each.

Eigenvalues are followed from one point to the next (`tracks`). Where two reach the axis within a step, in the same
direction or in opposite ones, or one that turns there, the step is halved between them until each is alone, or until
they cannot be told apart: they are one multiple point then. What the ends of a step do not show, a bump between them,
is looked for by the product of the Jacobian with one vector, at one evaluation a place.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.corner import loaded_at
from mjcont.numerics.points.events import Located, cubic
from mjcont.numerics.spectra.abreast import Probe, Tracks
from mjcont.numerics.spectra.stability import spectrum_of
from mjcont.numerics.spectra.tracks import Meeting, interpolated, meetings, motion_at, tracks
from mjcont.numerics.step.arclength import BEFORE, CurvePoint, advance

# the type of a point at which several eigenvalues reach the axis
MULTIPLE = "multiple"
# pieces shorter than this are not halved, nor more often than this in a step
_ALONE, _MOST = 2e-8, 80
# no piece ends nearer to another's end than this part; near a point that is found already nothing is looked for
_EDGE, _NEAR = 0.02, 1e-4
# where no point can be taken, another one is, aside by this part of the way to the nearer end
_ASIDE = 0.1
# products with the Jacobian are taken this many times the longest step
PLACES = 0.25
# difference step of such a product, in scaled unknowns
PROBE = 1e-3


@dataclass(frozen=True, slots=True)
class Piece:
    """A part of a step.

    Attributes
    ----------
    old, new : its ends.
    together : how many eigenvalues reach the axis together at `new`; zero where none do, or one alone.
    oscillate : whether these are pairs.
    quiet : whether nothing is left to be looked for.
    """

    old: CurvePoint
    new: CurvePoint
    together: int = 0
    oscillate: bool = False
    quiet: bool = False


@dataclass(frozen=True, slots=True)
class _Cut:
    """Where a piece is to be halved, as a part of it, and what may be found on the axis there, if anything."""

    at: float
    met: Sequence[Meeting] = ()


@dataclass(slots=True)
class Balance:
    """Takes the steps of a curve of equilibria to pieces."""

    system: System
    settings: Settings
    _made: int = field(default=0, init=False)

    def pieces(self, old: CurvePoint, new: CurvePoint) -> list[Piece]:
        """Return the pieces of a step in order."""
        if self.system.conditions or motion_at(old) is None or motion_at(new) is None or not new.s > old.s:
            return [Piece(old, new)]
        if self.system.problem.nonsmooth and loaded_at(self.system, old) != loaded_at(self.system, new):
            return [Piece(old, new)]  # a corner: eigenvalues jump there
        before = BEFORE.get(old)
        known = before is not None and before.s < old.s and motion_at(before) is not None
        nodes = [before, old, new] if before is not None and known else [old, new]
        self._made = 0
        found, i = list[Piece](), len(nodes) - 2
        multiple = list[CurvePoint]()
        while i < len(nodes) - 1:
            a, b = nodes[i], nodes[i + 1]
            judged = self._judged(nodes, i)
            middle = None if isinstance(judged, Piece) else self._middle(a, b, judged)
            if middle is None or isinstance(judged, Piece):
                piece = judged if isinstance(judged, Piece) else Piece(a, b)
                beside = piece.together > 1 or any(a is m for m in multiple)
                found.append(replace(piece, quiet=piece.quiet and beside))
                i += 1
                continue
            nodes.insert(i + 1, middle)
            held = _held(a, middle, b, judged.met)
            if held > 1 or (held and not judged.met[0].crosses):  # nothing lies before it in this piece
                found.append(Piece(a, middle, held, judged.met[0].oscillates, True))
                middle.sign = b.sign
                multiple.append(middle)
                i += 1
        return found

    def _middle(self, a: CurvePoint, b: CurvePoint, cut: _Cut) -> CurvePoint | None:
        """Return the point of the curve at a cut, or near it, None where there is none.

        At a multiple point itself there is no tangent. Where some of those that meet there are on the axis and others
        are not, rounding decides between them.
        """
        kind = [m for m in cut.met if m.oscillates == cut.met[0].oscillates]
        for aside in (0.0, -_ASIDE, _ASIDE):
            self._made += 1
            place = cut.at + aside * min(cut.at, 1.0 - cut.at)
            middle = advance(self.system, a, place * (b.s - a.s), self.settings)
            if isinstance(middle, Refused) or not a.s < middle.s < b.s or motion_at(middle) is None:
                continue
            if not 0 < _held(a, middle, b, cut.met) < len(kind):
                return middle
        return None

    def _judged(self, nodes: Sequence[CurvePoint], i: int) -> Piece | _Cut:
        """Return a piece that is not to be halved any further, or where it is to be."""
        a, b = nodes[i], nodes[i + 1]
        parts, followed = interpolated(nodes, i), tracks(nodes, i)
        met, last = meetings(nodes, i, parts, followed), self._made >= _MOST
        if len(met) > 1 or (met and not met[0].crosses and not self._turns(a, b)):
            if b.s - a.s < _ALONE or last:
                kind = met[0].oscillates
                together = max(sum(m.crosses for m in met), _passed(a, b, kind))
                alike = together > 1 and all(m.oscillates == kind for m in met)  # none is a point of its own
                return Piece(a, b, together if together > 1 else 0, kind, alike)
            at = met[0].at if len(met) == 1 else 0.5 * (met[0].at + met[1].at)
            return _Cut(min(max(at, _EDGE), 1.0 - _EDGE), met)
        strays = None if last or met and b.s - a.s < _NEAR else self._strays(a, b, parts, followed)
        return Piece(a, b, quiet=not met) if strays is None else _Cut(strays)

    def _turns(self, a: CurvePoint, b: CurvePoint) -> bool:
        """Whether parameter and orientation turn: on the side branch of a pitchfork an eigenvalue touches zero."""
        n = self.system.n
        return a.sign * b.sign < 0.0 and a.tangent[n] * b.tangent[n] <= 0.0

    def _strays(self, a: CurvePoint, b: CurvePoint, parts: Sequence[Array], followed: Tracks | None) -> float | None:
        """Return where an eigenvalue strays so far from what the points tell that it may reach the axis, or None."""
        count = int(places_between(b.s - a.s, self.settings.ds_max))
        if count < 1 or followed is None:
            return None
        motion, alone = motion_at(a), followed.chosen(None)
        assert motion is not None and motion.modes is not None
        modes, mass = motion.modes, a.local.pencil.mass
        probe = Probe.of(
            modes.right[None], modes.left.conj().T[None], None if mass is None else mass[None],
            self.system.problem.state_scale, np.array(parts)[None],
        )
        t = (np.arange(count) + 1.0) / (count + 1.0)
        shares = strays_at(aside(self.system, a, b, probe.vector[0], t), probe, t, alone)
        return float(t[shares.argmax()]) if shares.max() > 1.0 else None


def aside(system: System, a: CurvePoint, b: CurvePoint, vector: Array, t: Array) -> Callable[[float], Array]:
    """Return what gives f at parts t (m,) of a piece, moved by a multiple of a vector (n,) there, (m, n)."""
    problem, length = system.problem, b.s - a.s
    steps = cubic(t[:, None], system.difference(b.x, b.y, a.x, a.y), length * a.tangent, length * b.tangent)
    states, coordinates = system.move_each(a.x, np.tile(a.y, (len(t), 1)), steps)
    values = [system.values(y) for y in coordinates]

    def beside(step: float) -> Array:
        moved = problem.retract_each(states, np.tile(step * vector, (len(t), 1)))
        return np.array([problem.residual(x, v) for x, v in zip(moved, values, strict=True)])

    return beside


def strays_at(beside: Callable[[float], Array], probe: Probe, t: Array, followed: Tracks) -> Array:
    """Return by how much an eigenvalue strays at parts of a piece (m,), one where it is worth a point there."""
    ahead = beside(PROBE)
    shares = probe.strays(ahead / PROBE, t, followed)
    if (shares > 1.0).any():  # f is nearly zero at the place itself; the other side makes sure
        shares = np.minimum(shares, probe.strays((ahead - beside(-PROBE)) / (2.0 * PROBE), t, followed))
    return shares


def places_between(length: float | Array, longest: float) -> Array:
    """Return at how many places in pieces of a length products with the Jacobian are taken, for the longest step."""
    found: Array = np.ceil(length / (PLACES * longest) - 0.1) - 1.0
    return found


def _held(a: CurvePoint, middle: CurvePoint, b: CurvePoint, met: Sequence[Meeting]) -> int:
    """Return how many of the eigenvalues that meet the axis a point between two others holds there."""
    if not met:
        return 0
    every = [m for p in (a, middle, b) if (m := motion_at(p)) is not None]
    size = max((m.size for m in every), default=0.0)
    counts = [m.oscillating if met[0].oscillates else m.vanishing(size) for m in every]
    return max(counts[1] - max(counts[0], counts[2]), 0)


def _passed(a: CurvePoint, b: CurvePoint, oscillates: bool) -> int:
    """Return how many eigenvalues, or pairs, are on the other side of the axis at the second of two points."""
    one, two = spectrum_of(a), spectrum_of(b)
    return abs(one.pair_count() - two.pair_count()) if oscillates else abs(one.n_unstable - two.n_unstable)


def multiple(piece: Piece) -> Located:
    """Return a point at which eigenvalues reach the axis together: bracketed, not solved for."""
    kind, what = ("HB", "pairs of eigenvalues reach the axis") if piece.oscillate else ("BP", "eigenvalues vanish")
    count = f"{piece.together} {what} together" if piece.together > 1 else "an eigenvalue touches the axis"
    note = f"{count}: a point of higher multiplicity, bracketed only"
    data = {"type": MULTIPLE, **({"vanishing": max(piece.together, 1)} if kind == "BP" else {})}
    return Located(kind, piece.new, _known_to(piece), False, data, note)


def _known_to(piece: Piece) -> float:
    """Return to what the end of a piece is a multiple point: all of the piece, or what lies within the noise there.

    What vanishes does so linearly, or quadratically where it only touches the axis.
    """
    before, at = motion_at(piece.old), motion_at(piece.new)
    length, share = piece.new.s - piece.old.s, 1.0
    if before is not None and at is not None and not piece.oscillate and at.vanishing(before.size):
        share = before.noise * before.size / max(float(np.abs(before.own).min()), 1e-300)
    return length * min(math.sqrt(share), 1.0)
