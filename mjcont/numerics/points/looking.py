"""What lies between two points of a curve: every detector looks, and what is one point to several of them is one."""

from __future__ import annotations

from collections.abc import Sequence

from mjcont.numerics.equations.refusals import Refused, Why
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.balance import Balance, Piece, multiple
from mjcont.numerics.points.calm import calm
from mjcont.numerics.points.events import Detector, Found, Located
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note
from mjcont.numerics.step.turning import may_turn_beyond

# below this step a pair of folds, or a fold beyond a bound, is not looked for between two points
SMALL_FOLDS = 1e-5
# a fold this near to a branch point is the same point: a pitchfork's turning side branch
_SAME_AS_BRANCH = 1e-5
# kinds of points that hold eigenvalues on the axis
_HOLDING = ("BP", "LP", "HB")
# the point before one between which and it nothing changes that structural detectors look for
CALM: Note[CurvePoint] = Note()


def look(
    system: System, old: CurvePoint, new: CurvePoint, detectors: Sequence[Detector], settings: Settings
) -> Found | Refused:
    """Return the special points between two points of the curve in order, or why the step is to be shorter."""
    structural = any(d.structural for d in detectors)
    if structural and (CALM.get(new) is old or calm(system, old, new, settings)):
        detectors, structural = [d for d in detectors if not d.structural], False
        if not detectors:
            return Found()
    located, neutral = list[Located](), list[Located]()
    for piece in Balance(system, settings).pieces(old, new) if structural else [Piece(old, new)]:
        found = _inside(piece, detectors)
        if isinstance(found, Refused):
            return found
        located += found.located
        neutral += found.neutral
    if not located and new.s - old.s > SMALL_FOLDS and may_turn_beyond(system, old, new):
        return Refused(Why.TURNS_TWICE, "a parameter may turn beyond its bound")
    return Found(located, neutral)


def _inside(piece: Piece, detectors: Sequence[Detector]) -> Found | Refused:
    """Return the special points in a piece of a step in order, or why the step is to be shorter."""
    located, neutral = list[Located](), list[Located]()
    for detector in detectors:
        crossed = not (piece.quiet and detector.structural) and detector.crossed(piece.old, piece.new)
        found = detector.locate(piece.old, piece.new, located) if crossed else Found()
        if isinstance(found, Refused):
            return found
        located += found.located
        neutral += found.neutral
    branch_points = [e.point.s for e in located if e.kind == "BP"]
    if branch_points:
        folds = [e for e in located if e.kind == "LP"]
        same = [e for e in folds if any(abs(e.point.s - s) <= _SAME_AS_BRANCH for s in branch_points)]
        located = [e for e in located if e not in same]
    if piece.together > sum(e.kind in _HOLDING for e in located):
        located.append(multiple(piece))
    return Found(sorted(located, key=lambda e: e.point.s), neutral)
