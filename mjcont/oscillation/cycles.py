"""The verb `continue_cycles`: limit cycles from a Hopf point."""

from __future__ import annotations

from typing import Any

import numpy as np

from mjcont.curves.collect import Progress
from mjcont.errors import MjcontError, ParameterError
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.system import System
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.starts import harmonic_orbit, hopf_vector
from mjcont.oscillation.walks import Options, Stop, flow_of, read_options, run
from mjcont.results.model import check_bounds
from mjcont.results.orbits import CYCLES, CycleBranch
from mjcont.results.points import SpecialPoint

# size of the first orbit beside a Hopf point, relative to the state's scales
_FIRST = 1e-2


@np.errstate(all="ignore")
def continue_cycles(
    point: SpecialPoint,
    parameter: str | None = None,
    bounds: tuple[float, float] | None = None,
    *,
    stop: Stop | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> CycleBranch:
    """Follow a curve of limit cycles in one parameter, with their Floquet multipliers and special points.

    Parameters
    ----------
    point : SpecialPoint
        A Hopf point of a branch, or any special point of a Hopf locus. Its cycles are followed towards larger ones.
    parameter : str, optional
        The parameter to vary; default that of the point's curve (of a locus its first).
    bounds : (low, high), optional
        Its range; default that of the point's curve.
    stop : callable, optional
        `stop(point)` returns a sentence to end the curve there; `point.orbit` is its orbit.
    progress : callable, optional
        `progress(count, special)` after each orbit and special point.
    **options
        `mesh`, `degree`, `scheme`, `tol`, `mesh_max`, `period_max`, and fields of `Settings` (ds, ds_max, ...).

    Returns
    -------
    CycleBranch

    Raises
    ------
    MjcontError, NameLookupError, BoundsError, ParameterError, StartError
        See their messages. Failure of the continuation itself is no exception but the branch's status.
    """
    flow = flow_of(point.model)
    read = read_options(flow, options)
    name = parameter if parameter is not None else next(iter(point.free))
    low, high = check_bounds(flow, name, bounds if bounds is not None else point.free.get(name))
    free = Free(name, low, high, flow.parameter(name).unit)
    if point.kind != "HB" and point.curve != "HB locus":
        raise MjcontError(f"{point.label or 'the point'} is of kind {point.kind or 'regular'}: limit cycles begin at "
                          "points of kind HB")
    return _from_hopf(flow, point, free, read, stop, progress)


def _from_hopf(
    flow: ModelFlow, point: SpecialPoint, free: Free, options: Options, stop: Stop | None, progress: Progress | None
) -> CycleBranch:
    values = flow.values({k: v for k, v in point.parameters.items() if k in flow.values()})
    if not free.low <= values[free.name] <= free.high:
        raise ParameterError(f"{point.label} has {free.name} = {free.show(values[free.name])}, outside the bounds "
                             f"{free.show(free.low)} .. {free.show(free.high)}")
    mean, vector, omega = hopf_vector(flow, point)
    orbits, x, along = harmonic_orbit(flow, options.meshes.scheme, options.meshes.first, mean, vector, omega, _FIRST)
    system = System(orbits, values, [free])
    row = np.concatenate([along / orbits.state_scale, [0.0]])
    entry = (1.0, x, system.start_y(), row / np.linalg.norm(row))
    origin = f"small orbits at {point.label}, {free.name} = {free.show(values[free.name])}"
    return run(CYCLES, system, [entry], options, origin, stop, progress)
