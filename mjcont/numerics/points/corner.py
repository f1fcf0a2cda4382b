"""Corners: points at which a limit, contact, cable or saturation begins or ceases to act and a curve turns sharply.

Equilibria are continuous there but their derivatives are not. A corner is crossed by leaving it along the tangent of
the other side, in the direction in which the new set of loaded constraints persists.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.newton import correct, with_row
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.events import Found, Located
from mjcont.numerics.step.arclength import CurvePoint, advance, point_from, tangent_at
from mjcont.numerics.step.notes import Note

Piece = Callable[[Array, Array], Hashable]

_LOADED = Note[frozenset[str]]()
NEAR = 1e-4
_LEAVE = 1e-4
_SHARP = 1e-8
_EXACT = 1e-13
_SMALL = 3e-17
# how much of the way to a corner is gone along the curve, where the way is so long that the tangent strays from it
_APPROACH, _CURVED, _ROUGH = 0.97, 1e-7, 1e-2
# chord steps from the tangent to the curve, and how far before a corner they may start
_CHORDS, _SHORT = 2, (1e-13, 3e-12, 3e-11, 1e-9)
# scaled residuals: of points on a tangent that may lie beyond a jump of the forces, and a hair beyond one
_BROKEN, _JUMP = 1e-6, 1e-9
# a tangent turns clearly by more than this angle, and at a corner if it does within this distance of it
_CLEAR = 0.1
_AT = 1e-5
# names such as "tendon cable taut" end in a state, which begins and ends
_BEARERS = ("tendon ", "actuator ", "actuation ")
_STATES = {
    "taut": ("goes taut", "goes slack"),
    "compressed": ("is compressed", "goes slack"),
    "saturated": ("saturates", "leaves saturation"),
}


def loaded(system: System, x: Array, y: Array) -> frozenset[str]:
    """Return the names of the limits and contacts that carry load at (x, y)."""
    return system.problem.active(x, system.values(y))


def loaded_at(system: System, point: CurvePoint) -> frozenset[str]:
    """Return the loaded constraints of a curve point, computed once."""
    return _LOADED.of(point, lambda: loaded(system, point.x, point.y))


def describe(before: frozenset[str], after: frozenset[str]) -> str:
    """Return a sentence on what changes."""
    parts = [_becomes(name, 0) for name in sorted(after - before)]
    parts += [_becomes(name, 1) for name in sorted(before - after)]
    return ", ".join(parts)


def _becomes(name: str, ends: int) -> str:
    subject, _, state = name.rpartition(" ")
    if state in _STATES and name.startswith(_BEARERS):
        return f"{subject} {_STATES[state][ends]}"
    return f"{name} {('engages', 'releases')[ends]}"


@dataclass(slots=True)
class CornerDetector:
    """Changes of the loaded constraints that a step passes without being refused."""

    structural = False

    system: System
    settings: Settings

    def value(self, point: CurvePoint) -> frozenset[str]:
        """Return the names of what carries load."""
        return loaded_at(self.system, point)

    def crossed(self, old: CurvePoint, new: CurvePoint) -> bool:
        """Whether another set of constraints carries load."""
        return loaded_at(self.system, old) != loaded_at(self.system, new)

    def locate(self, old: CurvePoint, new: CurvePoint, found: Sequence[Located]) -> Found:
        """Return the corner, by halving the step along the curve."""
        before, after = loaded_at(self.system, old), loaded_at(self.system, new)
        while new.s - old.s > _SHARP:
            middle = advance(self.system, old, 0.5 * (new.s - old.s), self.settings)
            if isinstance(middle, Refused) or not old.s < middle.s < new.s:
                break
            old, new = (middle, new) if loaded_at(self.system, middle) == before else (old, middle)
        return Found([Located("CO", new, new.s - old.s, True, {}, describe(before, after))])


def cross(system: System, point: CurvePoint, settings: Settings) -> tuple[CurvePoint, Located] | None:
    """Return the first point beyond a corner just ahead of `point`, and the corner; None if there is none."""
    before = loaded_at(system, point)
    crossed = _cross(system, point, settings, lambda x, y: loaded(system, x, y))
    if crossed is not None or not system.problem.nonsmooth:
        return crossed
    # no element tells: a contact that passes from a face to an edge keeps its load and its name
    crossed = _cross(system, point, settings, lambda x, y: _turned(system, point, x, y))
    if crossed is None or not _sudden(system, point, crossed[1].point):
        return None
    names = ", ".join(sorted(before))
    crossed[1].tolerance = _AT  # no better than the differences that see it
    crossed[1].note = "the stiffness jumps" + (f" under {names}" if names else "") + crossed[1].note
    return crossed


def _cross(system: System, point: CurvePoint, settings: Settings, piece: Piece) -> tuple[CurvePoint, Located] | None:
    point, reach = _approached(system, point, settings, piece)
    if reach is None:
        return None
    x, y = system.move(point.x, point.y, reach * point.tangent)
    beyond = system.move(x, y, _LEAVE * point.tangent)
    after = piece(*beyond)
    tangent = tangent_at(system, system.local(*beyond), beyond[1])
    # no model there carries no load: an edge, not a corner; nor is a place where forces jump
    if np.any(np.isnan(tangent)) or _jumps(system, point, x, y):
        return None
    # stiff stops hardly yield: a probe must move the state by more than the corner is known to
    moves = float(np.linalg.norm(tangent[: system.n]))
    probe = min(max(_LEAVE, 100.0 * _EXACT / max(moves, 1e-300)), 0.5)
    sides = [s for s in (1.0, -1.0) if piece(*system.move(x, y, s * probe * tangent)) == after]
    sign = sides[0] if len(sides) == 1 else float(np.sign(tangent @ point.tangent)) or 1.0
    guess = system.move(x, y, sign * _LEAVE * tangent)
    c = correct(system, *guess, sign * tangent, None, settings)
    if c.failure is not None or piece(c.x, c.y) != after:
        return None
    new = point_from(c, sign * tangent, point.s + reach + _LEAVE)
    note = describe(loaded_at(system, point), loaded(system, c.x, c.y))
    if new.tangent[system.n] * point.tangent[system.n] < 0:
        note += f"; {system.names[0]} turns back: a non-smooth fold"
    corner = _corrected(system, point, reach)
    return new, Located("CO", corner, _SHARP, True, {}, note)


def break_off(system: System, point: CurvePoint) -> Located | None:
    """Return the place just ahead of `point` at which forces jump, so that no equilibria follow; None if there is none.

    It is where adhesion lets go, or a contact with a margin of its own is lost under load.
    """
    if not system.problem.nonsmooth:
        return None
    reach = _distance(system, point, lambda x, y: _imbalance(system, point, x, y) > _BROKEN, _EXACT)
    if reach is None:
        return None
    x, y = system.move(point.x, point.y, reach * point.tangent)
    if not _jumps(system, point, x, y):
        return None
    changes = describe(loaded_at(system, point), loaded(system, x, y))
    note = (f"{changes}: " if changes else "") + "forces jump, and no equilibria follow"
    return Located("CO", _corrected(system, point, reach), _SHARP, True, {}, note)


def _imbalance(system: System, point: CurvePoint, x: Array, y: Array) -> float:
    """Return the largest scaled residual at (x, y), by the sizes of the equations at a point beside it."""
    return system.error(point.local, x, y)


def _jumps(system: System, point: CurvePoint, x: Array, y: Array) -> bool:
    """Whether forces at (x, y), a hair beyond a kink, are out of balance by more than any stiffness there tells."""
    beyond = system.local(x, y)
    return min(_imbalance(system, point, x, y), system.error(beyond, x, y)) > _JUMP


def _approached(
    system: System, point: CurvePoint, settings: Settings, piece: Piece
) -> tuple[CurvePoint, float | None]:
    """Return a point of the curve almost all of the way to the corner ahead, and how far the corner is from there.

    The tangent strays from the curve with the square of the distance: from there it leads to the corner itself. None is
    the distance where there is no corner.
    """
    reach = _distance(system, point, piece, _ROUGH)
    if reach is None:
        return point, None
    if reach > _CURVED:
        near = advance(system, point, _APPROACH * reach, settings)
        if not isinstance(near, Refused) and piece(near.x, near.y) == piece(point.x, point.y):
            found = _distance(system, near, piece, _EXACT, 3.0 * (1.0 - _APPROACH) * reach)
            return near, found
    return point, _distance(system, point, piece, _EXACT, reach)


def _corrected(system: System, point: CurvePoint, ahead: float) -> CurvePoint:
    """Return the point of the curve at a corner a little ahead, by derivatives of a point on this side of it.

    Where these do not lead to the curve the corner has been passed, and a point a hair before it is taken.
    """
    lu, best = Factored(with_row(point.jac, point.tangent)), point
    for k, short in enumerate(_SHORT):
        s = max(ahead - short, 0.0)
        x, y = system.move(point.x, point.y, s * point.tangent)
        for _ in range(_CHORDS):
            x, y = system.move(x, y, -lu.solve(np.append(system.residual(system.local(x, y), y), 0.0)))
        error = system.error(point.local, x, y)
        if not k or error < best.error:
            best = CurvePoint(x, y, point.tangent, point.sign, point.local, point.jac, point.s + s, error)
        if error <= max(10.0 * point.error, _SMALL):
            break
    return best


def _turn(system: System, tangent: Array, x: Array, y: Array) -> float:
    """Return the angle between a tangent and the line along which the curve through (x, y) runs, rad."""
    other = tangent_at(system, system.local(x, y), y)
    return float(np.arccos(np.clip(abs(other @ tangent), 0.0, 1.0)))


def _turned(system: System, point: CurvePoint, x: Array, y: Array) -> bool:
    return _turn(system, point.tangent, x, y) > _CLEAR


def _sudden(system: System, point: CurvePoint, corner: CurvePoint) -> bool:
    """Whether the tangent turns at a corner rather than steadily on the way."""
    turns = [_turn(system, point.tangent, *system.move(corner.x, corner.y, d * point.tangent)) for d in (-_AT, _AT)]
    return turns[0] < 0.2 * turns[1]


def _distance(
    system: System, point: CurvePoint, piece: Piece, exact: float, within: float | None = None
) -> float | None:
    """Return how far along the tangent the curve passes to another piece, at most `NEAR`; None if it does not.

    It is known to `exact`, or to a part of itself if that is `_ROUGH`; `within` is a distance at which it has passed.
    """
    before = piece(point.x, point.y)

    def passed(distance: float) -> bool:
        return piece(*system.move(point.x, point.y, distance * point.tangent)) != before

    low, high = 0.0, within or 0.0
    if within is None or not passed(within):
        for high in np.geomspace(1e-8, NEAR, 9).tolist():
            if passed(high):
                break
            low = high
        else:
            return None
    while high - low > (_ROUGH * high if exact == _ROUGH else exact):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if passed(middle) else (middle, high)
    return high
