"""Curves that begin at an orbit of another: its own curve, the doubled orbits at a PD, the other branch at a BPC."""

from __future__ import annotations

import numpy as np

from mjcont.errors import BoundsError, MjcontError, StartError
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.follow import laid
from mjcont.numerics.orbits.switch import Departure, crossing, doubled, system_at
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.walks import Entry, flow_for
from mjcont.results.model import check_bounds, model_of
from mjcont.results.orbits import Orbit, OrbitPoint, SpecialOrbit

# kinds of special orbits from which another curve begins
SWITCHES = ("PD", "BPC")


def orbit_at(point: OrbitPoint | SpecialOrbit | Orbit) -> Orbit:
    """Return the orbit of a point.

    Raises
    ------
    MjcontError
        If it came from a file that keeps none.
    """
    orbit = point if isinstance(point, Orbit) else point.orbit
    if orbit is None:
        raise MjcontError("the point was loaded without its orbit: continue a point of the curve as it was computed")
    return orbit


def flow_at(orbit: Orbit) -> ModelFlow:
    """Return the motion that an orbit is one of."""
    return flow_for(model_of(orbit.problem, "the orbit"), orbit.forcing, orbit.chart)


def parameter_at(point: OrbitPoint | SpecialOrbit | Orbit, parameter: str | None) -> str:
    """Return the parameter that is to vary: as given, or that of the point's curve.

    Raises
    ------
    MjcontError
        If neither says.
    """
    if parameter is not None:
        return parameter
    if isinstance(point, SpecialOrbit):
        return next(iter(point.free))
    raise MjcontError("name the parameter to vary: a regular orbit belongs to no curve of its own")


def bounded(
    flow: ModelFlow, point: OrbitPoint | SpecialOrbit | Orbit, name: str, bounds: tuple[float, float] | None
) -> Free:
    """Return the free parameter: in bounds as given, or those of the point's curve.

    Raises
    ------
    BoundsError
        If the orbit's own value lies outside.
    """
    known = point.free.get(name) if isinstance(point, SpecialOrbit) else None
    low, high = check_bounds(flow, name, bounds if bounds is not None else known)
    free, value = Free(name, low, high, flow.parameter(name).unit), orbit_at(point).parameters[name]
    if not low <= value <= high:
        raise BoundsError(f"the orbit has {name} = {free.show(value)}, outside the bounds {free.show(low)} .. "
                          f"{free.show(high)}")
    return free


def entries_at(
    flow: ModelFlow, point: OrbitPoint | SpecialOrbit | Orbit, free: Free
) -> tuple[System, list[Entry], str]:
    """Return the equations of the curve that begins at an orbit, where it is entered, and how that is told.

    Raises
    ------
    StartError
        If several multipliers pass together, so that no one curve begins there.
    """
    orbit = orbit_at(point)
    kind = point.kind if isinstance(point, SpecialOrbit) else ""
    path, values = orbit.path, dict(orbit.parameters)
    where = f"{free.name} = {free.show(values[free.name])}"
    if kind in SWITCHES and isinstance(point, SpecialOrbit):
        if not point.converged:
            raise StartError(f"{point.label}: {point.note}; no one curve begins there")
        system, x, y = system_at(flow, path, orbit.shift, values, (free,))
        origin = f"from {point.label} at {where}"
        if kind == "PD":
            begin = doubled(flow.repeated(), path, orbit.shift, system, x, y)
            return begin.system, [_entry(begin, 1.0)], origin
        sides = crossing(system, x, y, _tangent(point, system))
        return system, [_entry(side, sign) for side, sign in zip(sides, (-1.0, 1.0), strict=True)], origin
    orbits = laid(flow, path, orbit.shift)
    system = System(orbits, values, (free,))
    x, y = orbits.joined(path), system.start_y()
    return system, [Entry(sign, x, y, None) for sign in (-1.0, 1.0)], f"from an orbit at {where}"


def _entry(begin: Departure, sign: float) -> Entry:
    return Entry(sign, begin.x, begin.y, begin.row)


def _tangent(point: SpecialOrbit, system: System) -> Array:
    """Return the tangent (n + 1,) of the curve that a BPC was found on, scaled."""
    found = np.asarray(point.vectors["tangent"])
    slope = system.free[0].slope(float(system.start_y()[0]))
    return np.append(found[:-1] / system.problem.state_scale, found[-1] / slope)
