"""What computes `[[holds]]` and `[[designs]]`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any


def run_hold(given: Mapping[str, Any], mechanism: Any) -> Any:
    """Return the controls that hold a pose."""
    from mjcont.influence.holds import hold

    return hold(mechanism, given["pose"], controls=given["controls"] or None, start=given["start"],
                keyframe=given["keyframe"])


def run_design(given: Mapping[str, Any], points: Mapping[str, Any], progress: Callable[[float, float], None]) -> Any:
    """Return the design that meets a table's targets."""
    from mjcont.influence.targets import design

    return design(
        points, given["change"], given["targets"], objective=given["objective"], cases=given["cases"],
        scales=given["scales"], starts=given["starts"] or None, tol=given["tol"], progress=progress,
    )
