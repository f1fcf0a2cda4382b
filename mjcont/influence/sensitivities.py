"""The verb `sensitivities`: how a special point moves with every parameter of its model, by adjoints."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, ParameterError, unknown_name
from mjcont.influence.critical import check_alone, check_not_own, defining_kind, point_names, point_system
from mjcont.numerics.equations.adjoint import Adjoint
from mjcont.numerics.equations.defining import Hopf
from mjcont.numerics.equations.differences import FOURTH_ORDER, PARAMETER, jacobian_from_rows, jacobian_steps
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System, equation_scale
from mjcont.results.points import Point
from mjcont.results.quantities import Parameter
from mjcont.results.sensitivities import Sensitivities, checked_tolerances

PER_CENT = 0.01
DEGREE = math.radians(1.0)
# parts of what a parameter could do at most, and of the equations' size over the parameter's range: less is rounding
_BREAKS, _NOTHING = 1e-6, 1e-9


def default_tolerance(value: float, unit: str, bounds: tuple[float, float]) -> float:
    """Return 1 deg for an angle, else 1 % of the value, or where that is zero of half the width of its bounds."""
    if unit == "rad":
        return DEGREE
    return PER_CENT * abs(value) if value else 0.5 * PER_CENT * (bounds[1] - bounds[0])


@checked
@np.errstate(all="ignore")
def sensitivities(
    point: Point,
    parameters: str | Sequence[str] | None = None,
    *,
    quantities: str | Sequence[str] | None = None,
    tolerances: Mapping[str, float] | None = None,
) -> Sensitivities:
    """Return how a point moves with parameters: derivatives by the adjoint of its defining system.

    Parameters
    ----------
    point : SpecialPoint or Point
        An LP, HB, CP, BT, ZH, BP or user zero; or an equilibrium, whose observables then move.
    parameters : names or paths, optional
        Whatever `mechanism.parameter(...)` takes; default all parameters but those that the point determines.
    quantities : names, optional
        The point's own parameters (default), observables, or "omega" at a Hopf point.
    tolerances : mapping of parameter to change, optional
        For the table's and the chart's changes; default 1 deg for angles, 1 % of other values, or of half the
        width of its bounds for a parameter that is zero.

    Returns
    -------
    Sensitivities

    Raises
    ------
    MjcontError, NameLookupError, ParameterError
        If the point has no regular defining system or did not converge, a name is unknown, a parameter is one that
        the point determines, or shares its field with another that has been changed.
    """
    defining_kind(point)
    before = point.model.evaluations
    names = _parameters(point, parameters)
    system = point_system(point)
    values, parameters_of = system.base, point.model.parameters
    adjoint = Adjoint(system, point.state, system.start_y())
    targets = [quantity_at(adjoint, name) for name in _names(point, system, quantities)]
    weights = [adjoint.weights(q.gradient) for q in targets]
    unfolding = _unfolding(adjoint)
    conditions = any(np.any(w[system.n :]) for w in weights) or unfolding is not None
    table = np.zeros((len(names), len(targets)))
    notes: list[str] = []
    for i, name in enumerate(names):
        slope = adjoint.equations_slope(name, conditions)
        table[i] = [q.direct(name) - w @ slope for q, w in zip(targets, weights, strict=True)]
        if unfolding is not None and _breaks(adjoint, unfolding, slope, parameters_of[name]):
            table[i] = math.nan
            notes.append(f"{name} breaks the branch point: it unfolds, there is no derivative")
    given = {q.name: q.value for q in targets}
    units = {n: parameters_of[n].unit for n in names} | {q.name: q.unit for q in targets}
    own = {n: default_tolerance(values[n], units[n], parameters_of[n].bounds) for n in names}
    table.flags.writeable = False
    return Sensitivities(
        point, tuple(names), tuple(given), table, {n: values[n] for n in names} | given, units,
        {**own, **checked_tolerances(tolerances or {}, names)}, point.model.evaluations - before, tuple(notes),
    )


def _parameters(point: Point, wanted: str | Sequence[str] | None) -> list[str]:
    problem, own = point.model, point_names(point)
    if wanted is None:
        return [n for n in problem.parameters if n not in own]
    names = list(dict.fromkeys([wanted] if isinstance(wanted, str) else wanted))
    if not names:
        raise ParameterError("name at least one parameter")
    for name in names:
        check_not_own(point, name)
    for name in names:
        check_alone(point, name)
    return names


def _names(point: Point, system: System, wanted: str | Sequence[str] | None) -> list[str]:
    if wanted is None:
        return list(system.names or point.model.observables)
    names = list(dict.fromkeys([wanted] if isinstance(wanted, str) else wanted))
    known = [*system.names, *point.model.observables]
    known += ["omega"] if any(isinstance(c, Hopf) for c in system.conditions) else []
    for name in names:
        if name not in known:
            raise unknown_name("quantity", name, known)
    if not names:
        raise MjcontError("name at least one quantity")
    return names


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity at a point: its gradient in scaled (x, y), and its derivative in a parameter at a fixed state."""

    name: str
    value: float
    unit: str
    gradient: Array
    direct: Callable[[str], float]


def quantity_at(adjoint: Adjoint, name: str) -> Quantity:
    """Return a quantity at a solution: a parameter that it solves for, an observable, or "omega" at a Hopf point."""
    system, y = adjoint.system, adjoint.y
    gradient = np.zeros(system.n + system.k)
    if name in system.names:
        i = system.names.index(name)
        p = system.free[i]
        gradient[system.n + i] = p.slope(float(y[i]))
        return Quantity(name, p.value(float(y[i])), p.unit, gradient, lambda other: 0.0)
    problem: Any = system.problem
    if name in problem.observables:
        return _observable(adjoint, name, gradient)
    at = len(system.free)
    conditions: Sequence[Any] = system.conditions
    for c in conditions:
        if isinstance(c, Hopf):
            omega = math.sqrt(c.square(y[at : at + 1]))
            gradient[system.n + at] = math.cosh(float(y[at])) * c.rate**2 / (2.0 * omega)
            return Quantity(name, omega, "rad/s", gradient, lambda other: 0.0)
        at += len(c.aux)
    raise unknown_name("quantity", name, [*system.names, *problem.observables])


def _observable(adjoint: Adjoint, name: str, gradient: Array) -> Quantity:
    system, x, here = adjoint.system, adjoint.x, adjoint.local.values
    problem: Any = system.problem

    def along(other: str) -> float:
        p, value = problem.parameters[other], here[other]
        h = PARAMETER.step * max(abs(value), 1e-2 * (p.bounds[1] - p.bounds[0]))
        values = [{**here, other: value + o * h} for o in PARAMETER.offsets]
        many = np.broadcast_to(x, (len(values), len(x)))
        return float(np.asarray(PARAMETER.weights) @ problem.measure(many, values, [name])[:, 0] / h)

    scale = problem.state_scale
    states = np.array([problem.retract(x, s) for s in jacobian_steps(scale, FOURTH_ORDER)])
    rows = problem.measure(states, here, [name])
    gradient[: system.n] = jacobian_from_rows(rows, scale, FOURTH_ORDER)[0] * scale
    for i, p in enumerate(system.free):
        gradient[system.n + i] = along(p.name) * p.slope(float(adjoint.y[i]))
    value = float(problem.measure(x[None], here, [name])[0, 0])
    return Quantity(name, value, problem.observables[name].unit, gradient, along)


def _breaks(adjoint: Adjoint, unfolding: Array, slope: Array, parameter: Parameter) -> bool:
    """Whether a parameter unfolds a branch point, beyond the rounding of both vectors.

    They are compared as wholes, in units of each equation's size: where one vanishes by symmetry the products of the
    components are rounding times rounding. A parameter that acts on no equation breaks nothing.
    """
    size = np.ones(len(slope))
    size[: adjoint.system.n] = equation_scale(adjoint.local)
    weights, acts = float(np.linalg.norm(unfolding / size)), float(np.linalg.norm(slope * size))
    by = abs(float(unfolding @ slope))
    width = max(abs(parameter.value), parameter.bounds[1] - parameter.bounds[0])
    return by > _BREAKS * weights * acts and by * width > _NOTHING * weights


def _unfolding(adjoint: Adjoint) -> Array | None:
    """Return the adjoint of a branch point's unfolding: where it is not zero, the branch point does not persist."""
    system = adjoint.system
    if not any(c.direction is not None for c in system.conditions):
        return None
    gradient = np.zeros(system.n + system.k)
    gradient[system.n + len(system.free)] = 1.0
    return adjoint.weights(gradient)
