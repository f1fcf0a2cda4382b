"""What a sweep is before its first case: its model, what varies, and how its points at the nominal case are had."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Protocol, runtime_checkable

from mjcont.errors import MjcontError, ParameterError
from mjcont.influence.critical import point_names
from mjcont.results.points import SpecialPoint
from mjcont.sweeps.designs import DESIGNS, Spread, Vary
from mjcont.sweeps.jobs import (
    METHODS,
    PointPlan,
    trace_points,
)

# cases between one that is continued and the nominal one
DEEPEST = 12


@dataclass(frozen=True, slots=True)
class SweepPlan:
    """A sweep as a study file asks for it."""

    points: tuple[PointPlan, ...]
    vary: Mapping[str, Spread | tuple[float, ...]]
    design: str
    cases: int | None = None
    seed: int = 0
    record: tuple[str, ...] = ()
    method: str = METHODS[0]
    deepest: int = DEEPEST


@dataclass(frozen=True, slots=True)
class Setup:
    """A sweep before its first case: the model, what varies, how the points at the nominal case are had."""

    mechanism: Any
    plan: SweepPlan
    friction: str
    nominal: Mapping[str, float]
    own: frozenset[str]
    record: tuple[str, ...]
    branches: tuple[Any, ...]
    given: Mapping[str, SpecialPoint] | None
    text: str = ""

    def points(self) -> Mapping[str, SpecialPoint]:
        """Return the points at the nominal case."""
        if self.given is not None:
            return self.given
        return trace_points(self.mechanism, [asdict(b) for b in self.branches], self.plan.points, {})


def of_points(points: Mapping[str, SpecialPoint], vary: Vary | None) -> Setup:
    """Return the sweep of special points that are known.

    Raises
    ------
    MjcontError, ParameterError
        If something in the arguments does not fit.
    """
    if not points or vary is None:
        raise ParameterError("name at least one special point, and say what varies")
    for name, p in points.items():
        if not name.isidentifier():
            raise ParameterError(f"'{name}': a point's name consists of letters, digits and '_'")
        if not point_names(p):
            raise MjcontError(f"{name}: only special points can be followed, this is an equilibrium")
    first = next(iter(points.values()))
    for name, p in points.items():
        if p.problem is not first.problem:
            raise ParameterError(f"{name} belongs to another Mechanism: the points of a sweep share one")
    nominal = first.model.values(first.parameters)
    for n in vary:
        first.model.parameter(n)
        if len({p.model.values(p.parameters)[n] for p in points.values()}) > 1:
            raise ParameterError(f"the nominal value of {n} differs between the points")
    record = tuple(f"{n}.{q}" for n, p in points.items() for q in point_names(p))
    plan = SweepPlan((), {}, DESIGNS[0])
    own = frozenset(q for p in points.values() for q in point_names(p))
    friction = "frictionless"
    return Setup(first.problem, plan, friction, nominal, own, record, (), points)


@runtime_checkable
class Sweepable(Protocol):
    """What says of itself how it is swept: a study with a table [sweep]."""

    def sweep_setup(self) -> Setup:
        """Return the sweep before its first case."""
