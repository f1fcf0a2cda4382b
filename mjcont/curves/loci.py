"""The verb `continue_special`: a special point followed in one more parameter."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.curves.collect import Progress, collect, run_directions
from mjcont.curves.continuation import check_direction, hold_rigid_modes
from mjcont.curves.walkers import Zeros, zero_detectors
from mjcont.errors import BoundsError, MjcontError, ParameterError, unknown_name
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.settings import Settings, make_settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.points.events import Detector
from mjcont.numerics.points.kinds import CONTINUABLE, KINDS, conditions_of
from mjcont.numerics.points.on_loci import fold_locus_detectors, hopf_locus_detectors, unfolding_stop
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.trace import Walker
from mjcont.results.branch import Branch
from mjcont.results.model import Valued, check_bounds, model_of
from mjcont.results.points import SpecialPoint, show
from mjcont.results.quantities import meant_each

CODIMENSION = {code: KINDS[code].codimension for code in CONTINUABLE}


@np.errstate(all="ignore")
def continue_special(
    point: SpecialPoint,
    parameter: str,
    bounds: tuple[float, float] | Mapping[str, tuple[float, float]] | None = None,
    *,
    direction: int | None = None,
    end_at: Sequence[str] | None = None,
    zeros: Zeros | None = None,
    lyapunov: bool = True,
    progress: Progress | None = None,
    **options: Any,
) -> Branch:
    """Follow a special point of equilibria: `mjcont.oscillation.loci.continue_special`, which says what is what."""
    kind = _continued_as(point)
    settings = make_settings(options)
    free = _freed(point, kind, free_parameters(point, parameter, bounds))
    system = locus_system(point, kind, free)
    stop: Callable[[Any], str | None] | None = unfolding_stop(system) if kind == "BP" else None
    zeros = meant_each(zeros, system.names, point.model.observables)
    detectors = locus_detectors(kind, system, settings, lyapunov, zeros)
    walker = Walker(OneByOne(system, settings, detectors), stop, ends_at(end_at, default_ends(kind)))
    directions = check_direction(direction)
    lead = len(free) - 1
    with clock.limited(settings.max_seconds):
        traces = run_directions(walker, point.state, system.start_y(), directions, progress, lead)
    where = ", ".join(f"{p.name} = {show(system.base[p.name], p.unit)}" for p in free)
    locus = collect(f"{kind} locus", system, traces, directions, f"from {point.label} at {where}", settings)
    return replace(locus, settings={**locus.settings, "zeros": dict(zeros)}) if zeros else locus


def _continued_as(point: SpecialPoint) -> str:
    """Return the kind of locus that goes through a point.

    Raises
    ------
    MjcontError
        If there is none, or the point came without its problem.
    """
    kind = followed_as(point)
    if kind not in CONTINUABLE:
        raise MjcontError(
            f"a point of kind {point.kind or 'regular'} has no curve to follow. Valid kinds: {', '.join(CONTINUABLE)}."
        )
    model_of(point.problem)
    return kind


def _freed(point: SpecialPoint, kind: str, free: Sequence[Free]) -> list[Free]:
    """Return the free parameters of the locus; a point on a locus is followed with the one fixed that led to it."""
    found = [p for p in free if kind == point.kind or p.name != list(point.free)[-1]]
    if len(found) != CODIMENSION[kind] + 1:
        raise MjcontError(
            f"{point.label} lies on a curve in {len(found) - 1} parameters: a {KINDS[kind].continues_as} curve has "
            f"{CODIMENSION[kind] + 1} free parameters, this would have {len(found)}"
        )
    return found


def default_ends(kind: str) -> tuple[str, ...]:
    """Return the kinds of points that end a locus unless asked otherwise."""
    return ("BT",) if kind == "HB" else ()


def followed_as(point: SpecialPoint) -> str:
    """Return the kind as which a point is followed: its own, or on a locus of folds (...) a fold (...)."""
    on_locus = point.curve.endswith(" locus")
    if on_locus and (point.kind == "UZ" or (point.kind == "BP" and point.curve == "LP locus")):
        return point.curve.removesuffix(" locus")
    return point.kind


def ends_at(end_at: Sequence[str] | None, default: Iterable[str]) -> frozenset[str]:
    """Return the kinds of special points at which a locus ends: those asked for, or the default ones.

    Raises
    ------
    NameLookupError
        If there is no such kind.
    """
    for name in end_at or ():
        if name not in KINDS:
            raise unknown_name("kind of special point", name, KINDS)
    return frozenset(default if end_at is None else end_at)


def free_parameters(
    point: SpecialPoint,
    parameter: str,
    bounds: tuple[float, float] | Mapping[str, tuple[float, float]] | None,
    moving: Valued | None = None,
) -> list[Free]:
    """Return the parameters of the point's curve and the new one, each with its bounds.

    They are those of the point's model, or of what is `moving` with more parameters than that.
    """
    problem: Valued = point.model if moving is None else moving
    given = dict(bounds) if isinstance(bounds, Mapping) else ({} if bounds is None else {parameter: bounds})
    if parameter in point.free:
        raise ParameterError(f"{parameter} is already free on the curve of {point.label}: name another parameter")
    names = [*point.free, parameter]
    for name in given:
        if name not in names:
            raise ParameterError(f"bounds are given for '{name}', which is not free here. Free: {', '.join(names)}.")
    free = []
    for name in names:
        low, high = check_bounds(problem, name, given.get(name, point.free.get(name)))
        value, unit = problem.values(point.parameters)[name], problem.parameter(name).unit
        if not low <= value <= high:
            raise BoundsError(
                f"{point.label} has {name} = {show(value, unit)}, outside the bounds "
                f"{show(low, unit)} .. {show(high, unit)}"
            )
        free.append(Free(name, low, high, problem.parameter(name).unit))
    return free


def locus_system(point: SpecialPoint, kind: str, free: Sequence[Free]) -> System:
    """Return the system whose solutions are the curve through a special point."""
    problem = point.model
    values = problem.values(point.parameters)
    held, _ = hold_rigid_modes(problem, point.state, values)
    plain = System(held, values, free)
    local = Local(held, point.state, values, plain.names, True, plain.ranges)
    square = float(point.coefficients["omega"]) ** 2 if "omega" in point.coefficients else None
    return System(held, values, free, conditions_of(kind, local, plain, square), accurate=True)


def locus_detectors(
    kind: str, system: System, settings: Settings, lyapunov: bool, zeros: Zeros
) -> list[Detector]:
    """Return the detectors of a locus of special points of a kind."""
    found: list[Detector] = []
    if kind == "LP":
        found += fold_locus_detectors(system, system.conditions[0], settings)  # type: ignore[arg-type]
    elif kind == "HB":
        found += hopf_locus_detectors(system, system.conditions[0], settings, lyapunov=lyapunov)  # type: ignore[arg-type]
    return [*found, *zero_detectors(system, settings, zeros)]


