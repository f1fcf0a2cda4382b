"""Settings of a continuation, with the cross-checks between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from numbers import Real
from typing import Any

from mjcont.errors import ParameterError, unknown_name

SMALLEST_CHORD = 1e-9


def check_numbers(options: Mapping[str, Any]) -> None:
    """Raise a ParameterError unless all values are numbers."""
    for name, value in options.items():
        if isinstance(value, bool) or not isinstance(value, Real) or math.isnan(value):
            raise ParameterError(f"{name} must be a number, got {value!r}")


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
        Largest distance of straight lines between the rows of a branch, a locus or a load path from the curve, where
        rows between its points are cheap: along controls of a mechanism without contacts, limits or friction, and of a
        vectorized field. Infinity adds none.
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
        check_numbers(asdict(self))
        if not 0 < self.ds_min <= self.ds <= self.ds_max:
            raise ParameterError(
                f"steps must satisfy 0 < ds_min <= ds <= ds_max, got {self.ds_min:g}, {self.ds:g}, {self.ds_max:g}"
            )
        if not 0 < self.angle < self.angle_max < math.pi / 2:
            raise ParameterError("angles must satisfy 0 < angle < angle_max < pi/2 (radians)")
        if self.max_points < 2 or self.max_corrections < 2:
            raise ParameterError("max_points and max_corrections must be at least 2")
        if not (self.tol > 0 and self.max_size > 0):
            raise ParameterError(f"tol and max_size must be positive, got {self.tol:g}, {self.max_size:g}")
        if not (self.max_points < math.inf and self.max_seconds >= 0 and self.max_arclength >= 0):
            raise ParameterError(
                f"max_points must be finite, max_seconds and max_arclength not negative, got {self.max_points:g}, "
                f"{self.max_seconds:g} and {self.max_arclength:g}"
            )
        if math.isinf(self.ds_max) or math.isinf(self.tol):
            raise ParameterError("ds_max and tol must be finite")
        if not self.chord >= SMALLEST_CHORD:
            raise ParameterError(f"chord must be {SMALLEST_CHORD:g} or more (inf adds no rows), got {self.chord:g}")


def make_settings(options: Mapping[str, Any]) -> Settings:
    """Return Settings from keyword options.

    Raises
    ------
    NameLookupError, ParameterError
        If an option does not exist (the message lists those that do) or does not fit.
    """
    valid = [f.name for f in fields(Settings)]
    for name in options:
        if name not in valid:
            raise unknown_name("option", name, valid)
    given = dict(options)
    check_numbers(given)
    if "ds" not in given and "ds_max" in given:
        given["ds"] = min(Settings().ds, given["ds_max"])
    if "ds_min" not in given and "ds" in given:
        given["ds_min"] = min(Settings().ds_min, given["ds"])
    return Settings(**given)
