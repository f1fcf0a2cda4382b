"""Steps of a walk along a curve, and how it ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from mjcont.numerics.points.events import Located
from mjcont.numerics.step.arclength import CurvePoint


class Status(Enum):
    """Why a curve ends."""

    AT_BOUND = "at bound"
    CLOSED = "closed"
    STEP_TOO_SMALL = "step too small"
    BREAKS_OFF = "breaks off"
    MAX_POINTS = "max points"
    MAX_ARCLENGTH = "max arclength"
    MAX_TIME = "max time"
    RUNS_OFF = "runs off"
    STOPPED = "stopped"
    AT_SPECIAL_POINT = "at special point"
    INTERRUPTED = "interrupted"
    AT_REST = "rest"
    PERIOD = "period"
    MESH = "mesh"
    CORNER = "corner"
    NO_START = "no start"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class End:
    """The end of a curve: a status and a sentence; `full_turns` where it closes on itself but for these."""

    status: Status
    message: str
    full_turns: bool = False


@dataclass(frozen=True, slots=True)
class Step:
    """A step of the walk.

    Attributes
    ----------
    items : points and special points in order, the step's end last.
    next : length of the step after it.
    ending : the end of the curve, if a bound is met at the step's end.
    neutral : neutral saddles within.
    """

    items: list[CurvePoint | Located]
    next: float
    ending: End | None = None
    neutral: Sequence[Located] = ()


@dataclass(frozen=True, slots=True)
class Neutral:
    """A neutral saddle that a walk passes: two real eigenvalues of opposite sign, no special point."""

    located: Located


Item = CurvePoint | Located | Neutral | End


@dataclass(frozen=True, slots=True)
class Leap:
    """A step that was predicted and corrected, and not yet looked at.

    Attributes
    ----------
    old, new : its ends.
    h : length with which it was tried.
    ending : the end of the curve, if a bound is met at `new`.
    """

    old: CurvePoint
    new: CurvePoint
    h: float
    ending: End | None
