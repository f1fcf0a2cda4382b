"""Settings of a continuation, with the cross-checks between them."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mjcont.errors import ParameterError

SMALLEST_CHORD = 1e-9


@dataclass(frozen=True, slots=True)
class Settings:
    """How a curve is followed. Arclength is measured in scaled unknowns (see `System`).

    Attributes
    ----------
    ds, ds_min, ds_max : float
        First, smallest and largest step.
    angle, angle_max : float
        Turning of the tangent per step aimed at, and never exceeded, in rad.
    tol : float
        Size of a corrector step at which it has converged (one more Newton step always follows).
    max_corrections : int
        Corrector iterations before a step is given up.
    max_points, max_arclength : limits of one direction; rows between points do not count.
    max_seconds : limit of all that is computed, the start (if it is not near) and both directions together.
    chord : float
        Largest distance of straight lines between the rows of a branch from the curve, where rows between its points
        are cheap: along a control of a mechanism without contacts, limits or friction. Infinity adds none. It has no
        effect on loci and load paths.
    max_size : float
        Largest scaled state coordinate, relative to the start's if that exceeds one: where a curve runs off.
    """

    ds: float = 0.01
    ds_min: float = 1e-9
    ds_max: float = 0.05
    angle: float = math.radians(5.0)
    angle_max: float = math.radians(15.0)
    tol: float = 1e-8
    max_corrections: int = 12
    max_points: int = 5000
    max_arclength: float = math.inf
    max_seconds: float = math.inf
    max_size: float = 100.0
    chord: float = 3e-6

    def __post_init__(self) -> None:
        if not 0 < self.ds_min <= self.ds <= self.ds_max:
            raise ParameterError(
                f"steps must satisfy 0 < ds_min <= ds <= ds_max, got {self.ds_min:g}, {self.ds:g}, {self.ds_max:g}"
            )
        if not 0 < self.angle < self.angle_max < math.pi / 2:
            raise ParameterError("angles must satisfy 0 < angle < angle_max < pi/2 (radians)")
        if self.max_points < 2 or self.max_corrections < 2:
            raise ParameterError("max_points and max_corrections must be at least 2")
        if not self.chord >= SMALLEST_CHORD:
            raise ParameterError(f"chord must be {SMALLEST_CHORD:g} or more (inf adds no rows), got {self.chord:g}")
