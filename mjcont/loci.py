"""The verb `continue_special`: a special point followed in one more parameter."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from mjcont.branch import KIND_NAMES, Branch, SpecialPoint, show
from mjcont.collect import Progress, collect, run_directions
from mjcont.continuation import check_bounds, check_direction, hold_rigid_modes, make_settings
from mjcont.errors import BoundsError, MjcontError, ParameterError, unknown_name
from mjcont.numerics import clock
from mjcont.numerics.equilibria import zero_detector
from mjcont.numerics.events import Detector
from mjcont.numerics.loci import conditions_of, fold_locus_detectors, hopf_locus_detectors, unfolding_stop
from mjcont.numerics.settings import Settings
from mjcont.numerics.system import Free, Local, System
from mjcont.numerics.trace import Walker
from mjcont.quantities import meant_each
from mjcont.walkers import monitor_of

CONTINUABLE = ("LP", "HB", "BP", "CP", "BT", "ZH")
_NAMES = {"LP": "fold", "HB": "Hopf", "BP": "branch-point", "CP": "cusp", "BT": "Bogdanov-Takens", "ZH": "zero-Hopf"}
CODIMENSION = {"LP": 1, "HB": 1, "BP": 1, "CP": 2, "BT": 2, "ZH": 2}


def continue_special(
    point: SpecialPoint,
    parameter: str,
    bounds: tuple[float, float] | Mapping[str, tuple[float, float]] | None = None,
    *,
    direction: int | None = None,
    end_at: Sequence[str] | None = None,
    zeros: Mapping[str, float] | None = None,
    lyapunov: bool = True,
    progress: Progress | None = None,
    **options: Any,
) -> Branch:
    """Follow a special point in one more parameter; the parameters of its own curve stay free.

    Parameters
    ----------
    point : SpecialPoint
        An LP, HB or BP of a branch gives its curve in two parameters; a CP, BT or ZH of such a curve its own curve
        in three.
    parameter : str
        The parameter that is freed.
    bounds : (low, high), or a mapping of free parameters to bounds
        Range of `parameter`; the others keep the bounds of the point's curve unless given here.
    direction : {None, +1, -1}
        Both directions, or that in which `parameter` first grows or falls.
    end_at : kinds of points that end the locus; default BT on a Hopf locus (beyond it lie neutral saddles).
    zeros : columns whose passing of a value is located and labelled UZ.
    lyapunov : whether l1 is computed along a Hopf locus (needed for GH).

    Returns
    -------
    Branch
        Its `kind` says which locus. On a fold locus CP, BT, ZH and BP (w . f_p = 0) are located, on a Hopf locus
        BT, ZH, HH and GH.

    Raises
    ------
    MjcontError, BoundsError, NameLookupError, ParameterError
        See their messages.
    """
    problem = point.problem
    if followed_as(point) not in CONTINUABLE:
        raise MjcontError(
            f"a point of kind {point.kind or 'regular'} has no curve to follow. Valid kinds: {', '.join(CONTINUABLE)}."
        )
    if problem is None:
        raise MjcontError("the point was loaded without its problem: mc.load(path, problem=...)")
    settings = make_settings(options)
    free = free_parameters(point, parameter, bounds)
    kind = followed_as(point)
    if kind != point.kind:  # a point on a locus is followed with the parameter fixed that led to it
        free = [p for p in free if p.name != list(point.free)[-1]]
    if len(free) != CODIMENSION[kind] + 1:
        raise MjcontError(
            f"{point.label} lies on a curve in {len(free) - 1} parameters: a {_NAMES[kind]} curve has "
            f"{CODIMENSION[kind] + 1} free parameters, this would have {len(free)}"
        )
    system = locus_system(point, kind, free)
    stop: Callable[[Any], str | None] | None = unfolding_stop(system) if kind == "BP" else None
    zeros = meant_each(zeros, system.names, problem.observables)
    detectors = locus_detectors(kind, system, settings, lyapunov, zeros)
    for name in end_at or ():
        if name not in KIND_NAMES:
            raise unknown_name("kind of special point", name, KIND_NAMES)
    ends = frozenset(end_at if end_at is not None else default_ends(kind))
    walker = Walker(system, settings, detectors, stop, ends)
    directions = check_direction(direction)
    lead = len(free) - 1
    with clock.limited(settings.max_seconds):
        traces = run_directions(walker, point.state, system.start_y(), directions, progress, lead)
    where = ", ".join(f"{p.name} = {show(system.base[p.name], p.unit)}" for p in free)
    locus = collect(f"{kind} locus", system, traces, directions, f"from {point.label} at {where}", settings)
    return replace(locus, settings={**locus.settings, "zeros": dict(zeros)}) if zeros else locus


def default_ends(kind: str) -> tuple[str, ...]:
    """Return the kinds of points that end a locus unless asked otherwise."""
    return ("BT",) if kind == "HB" else ()


def followed_as(point: SpecialPoint) -> str:
    """Return the kind as which a point is followed: its own, or on a locus of folds (...) a fold (...)."""
    on_locus = point.curve.endswith(" locus")
    if on_locus and (point.kind == "UZ" or (point.kind == "BP" and point.curve == "LP locus")):
        return point.curve.removesuffix(" locus")
    return point.kind


def free_parameters(
    point: SpecialPoint, parameter: str, bounds: tuple[float, float] | Mapping[str, tuple[float, float]] | None
) -> list[Free]:
    """Return the parameters of the point's curve and the new one, each with its bounds."""
    problem: Any = point.problem
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
    problem: Any = point.problem
    values = problem.values(point.parameters)
    problem, _ = hold_rigid_modes(problem, point.state, values)
    plain = System(problem, values, free)
    local = Local(problem, point.state, values, plain.names, True)
    square = float(point.coefficients["omega"]) ** 2 if "omega" in point.coefficients else None
    return System(problem, values, free, conditions_of(kind, local, plain, square), accurate=True)


def locus_detectors(
    kind: str, system: System, settings: Settings, lyapunov: bool, zeros: Mapping[str, float]
) -> list[Detector]:
    """Return the detectors of a locus of special points of a kind."""
    found: list[Detector] = []
    if kind == "LP":
        found += fold_locus_detectors(system, system.conditions[0], settings)  # type: ignore[arg-type]
    elif kind == "HB":
        found += hopf_locus_detectors(system, system.conditions[0], settings, lyapunov=lyapunov)  # type: ignore[arg-type]
    for name, value in zeros.items():
        found.append(zero_detector(system, monitor_of(system.problem, name, value), f"{name} = {value:g}", settings))
    return found


