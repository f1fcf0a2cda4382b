"""Refusals: why a point, a step or a special point is not had. They are returned like any other value, never raised."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto


class Why(Enum):
    """Reasons for which numerics refuse what was asked for; what a user reads is the refusal's sentence."""

    UNDEFINED = auto()  # f has no value or no derivatives there
    DIVERGED = auto()  # corrections grow
    UNSETTLED = auto()  # corrections do not become small, or not quickly enough
    STALLED = auto()  # corrections become small, and the residual does not
    WANDERED = auto()  # a solution far from where it was looked for
    TURNED = auto()  # the tangent turns too far
    MISSED = auto()  # a bound is not met along the curve
    SWINGS = auto()  # the polynomial through the points around a step leaves its chord
    CROWDED = auto()  # a step needs too many points inside
    TURNS_TWICE = auto()  # a parameter may turn, or leave its bounds, and come back within the step
    OTHER_BRANCH = auto()  # the orientation changes without a branch point
    CROWDED_POINTS = auto()  # several special points lie in one step, or one that is seen is not found
    POLE = auto()  # a test changes sign by growing beyond bounds: there is no zero


@dataclass(frozen=True, slots=True)
class Refused:
    """What was asked for is not had.

    Attributes
    ----------
    why : the reason.
    message : a clause that a sentence on the curve's end takes up.
    shorter : the length to try instead of that of a refused step, where one may do.
    """

    why: Why
    message: str
    shorter: float | None = None

    def __str__(self) -> str:
        """Return the message."""
        return self.message
