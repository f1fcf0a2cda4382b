"""What walks along curves of equilibria: detectors, the user's stops and zeros, long steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from mjcont.curves.collect import make_point
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.corner import CornerDetector
from mjcont.numerics.points.events import Detector
from mjcont.numerics.points.on_equilibria import (
    BranchPointDetector,
    HopfDetector,
    fold_detector,
    zero_detector,
)
from mjcont.numerics.spectra.stability import SPECTRUM
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.walk.filled import Filled
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.trace import Walker
from mjcont.results.model import Model, model_of
from mjcont.results.points import Point
from mjcont.results.quantities import finite

# columns, each with the value, or the values, whose passing is located
Zeros = Mapping[str, float | Sequence[float]]


def point_stop(
    problem: Model,
    system: System,
    stop: Callable[[Point], str | None] | None,
    limits: Mapping[str, tuple[float, float]],
) -> Callable[[CurvePoint], str | None] | None:
    """Return the function that ends a curve where the user's `stop` or a limit on a column says so."""
    if stop is None and not limits:
        return None
    names = [n for n in limits if n not in problem.parameters]

    def check(p: CurvePoint) -> str | None:
        values = system.values(p.y)
        measured = dict(zip(names, problem.measure(p.x[None], values, names)[0], strict=True)) if names else {}
        for name, (low, high) in limits.items():
            value = float(measured.get(name, values.get(name, 0.0)))
            if not low <= value <= high:
                return f"{name} = {value:.6g} left its limits {low:g} .. {high:g}"
        return stop(make_point(problem, p.x, values, s=SPECTRUM.get(p))) if stop is not None else None

    return check


def equilibrium_detectors(
    system: System, settings: Settings, zeros: Zeros
) -> list[Detector]:
    """Return the detectors of a curve of equilibria, the one that guards against other branches first."""
    detectors: list[Detector] = [
        BranchPointDetector(system, settings),
        fold_detector(system, settings),
        HopfDetector(system, settings),
    ]
    if system.problem.nonsmooth:
        detectors.append(CornerDetector(system, settings))
    return [*detectors, *zero_detectors(system, settings, zeros)]


def zero_values(zeros: Zeros | None) -> list[tuple[str, float]]:
    """Return columns and values, one pair for each value; a MjcontError where one is not a finite number."""
    return [
        (name, finite(f"zeros: the value of {name}", value))
        for name, given in (zeros or {}).items()
        for value in (given if isinstance(given, Sequence) else [given])
    ]


def zero_detectors(system: System, settings: Settings, zeros: Zeros | None) -> list[Detector]:
    """Return what finds where columns pass the values that the user asks for."""
    problem = model_of(system.problem)
    return [
        zero_detector(system, monitor_of(problem, name, value), f"{name} = {value:g}", settings)
        for name, value in zero_values(zeros)
    ]


def equilibrium_walker(
    system: System,
    settings: Settings,
    zeros: Zeros,
    stop: Callable[[CurvePoint], str | None] | None = None,
) -> Walker:
    """Return what walks along a curve of equilibria, with long steps where points inside them are cheap.

    They are where points that differ in the parameter are evaluated together, and only dampers resist velocity, if
    anything does.
    """
    problem = system.problem
    cheap = (problem.passive or not problem.second_order) and problem.side_by_side(system.names[0])
    detectors = equilibrium_detectors(system, settings, zeros)
    return Walker((Filled if cheap else OneByOne)(system, settings, detectors), stop)


def monitor_of(problem: Model, name: str, value: float) -> Callable[[Array, Values], float]:
    """Return the function (x, p) -> column - value for an observable or parameter."""
    if name in problem.parameters:
        return lambda x, values: values[name] - value
    problem.observable(name)
    return lambda x, values: float(problem.measure(x[None], values, [name])[0, 0]) - value
