"""Where smooth steps end: across a corner of the forces, at the edge where they break off, on a bound."""

from __future__ import annotations

import numpy as np

from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.corner import NEAR, break_off, cross
from mjcont.numerics.points.events import Located
from mjcont.numerics.step.arclength import CurvePoint, land_beside
from mjcont.numerics.walk.steps import End, Status, Step


def across(system: System, point: CurvePoint, h: float, settings: Settings) -> Step | None:
    """Return the step across a corner right ahead, None where there is none; over a bound it ends there."""
    crossed = cross(system, point, settings) if h < NEAR and not system.conditions else None
    if crossed is None:
        return None
    new, corner = crossed
    met = np.flatnonzero((new.y <= system.lowest) | (new.y >= system.highest))
    if not len(met):
        return Step([corner, new], settings.ds)
    index = int(met[0])
    bound = float(system.lowest[index] if new.y[index] <= system.lowest[index] else system.highest[index])
    landed = land_beside(system, new, index, bound, settings)
    items: list[CurvePoint | Located] = [corner] if isinstance(landed, Refused) else [corner, landed]
    return Step(items, 0.0, at_bound(system, index, bound))


def broken_off(system: System, point: CurvePoint) -> Step | None:
    """Return the last step of a curve that ends where forces jump, None where they do not."""
    broken = None if system.conditions else break_off(system, point)
    if broken is None:
        return None
    return Step([broken], 0.0, End(Status.BREAKS_OFF, f"{broken.note} at {system.where(broken.point.y)}"))


def at_bound(system: System, index: int, bound: float) -> End:
    """Return the end of a curve on a bound of its free parameter number `index`."""
    p = system.free[index]
    return End(Status.AT_BOUND, f"{p.name} reached its bound {p.show(p.value(bound))}")
