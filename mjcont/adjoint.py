"""The verb `sensitivities`: how a special point moves with every parameter of its model, by adjoints."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.branch import Point
from mjcont.critical import check_alone, check_not_own, defining_kind, point_names, point_system
from mjcont.errors import MjcontError, ParameterError, unknown_name
from mjcont.numerics.adjoint import Adjoint
from mjcont.numerics.defining import Hopf
from mjcont.numerics.differences import FOURTH_ORDER, PARAMETER, jacobian_from_rows, jacobian_steps
from mjcont.numerics.problem import Array
from mjcont.numerics.system import System, equation_scale
from mjcont.quantities import Parameter

PER_CENT = 0.01
DEGREE = math.radians(1.0)
# parts of what a parameter could do at most, and of the equations' size over the parameter's range: less is rounding
_BREAKS, _NOTHING = 1e-6, 1e-9


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """Derivatives of a point's quantities in parameters, SI and radians.

    Attributes
    ----------
    point : Point
    parameters, quantities : names of the rows and columns of `derivatives`.
    derivatives : (number of parameters, number of quantities) array.
    values : mapping of every name to its value at the point.
    units : mapping of every name to its unit.
    tolerances : mapping of parameter to the change that `changes` and the chart are for.
    evaluations : int
        Evaluations of the forces that it took; observables are measured beside that.
    notes : sentences.
    """

    point: Point
    parameters: tuple[str, ...]
    quantities: tuple[str, ...]
    derivatives: Array
    values: Mapping[str, float] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    tolerances: Mapping[str, float] = field(repr=False)
    evaluations: int = 0
    notes: Sequence[str] = ()

    def __getitem__(self, key: str | tuple[str, str]) -> Any:
        """Return d quantity / d parameter for (quantity, parameter); for one name its derivatives by name."""
        if isinstance(key, tuple):
            return float(self.derivatives[self._row(key[1]), self._column(key[0])])
        if key in self.quantities:
            return dict(zip(self.parameters, (float(v) for v in self.derivatives[:, self._column(key)]), strict=True))
        if key in self.parameters:
            return dict(zip(self.quantities, (float(v) for v in self.derivatives[self._row(key)]), strict=True))
        raise unknown_name("quantity or parameter", key, [*self.quantities, *self.parameters])

    def _row(self, name: str) -> int:
        if name not in self.parameters:
            raise unknown_name("parameter", name, self.parameters)
        return self.parameters.index(name)

    def _column(self, name: str) -> int:
        if name not in self.quantities:
            raise unknown_name("quantity", name, self.quantities)
        return self.quantities.index(name)

    @property
    def elasticities(self) -> Array:
        """Relative change of each quantity per relative change of each parameter; NaN where either is zero."""
        p = np.array([self.values[n] for n in self.parameters])[:, None]
        q = np.array([self.values[n] for n in self.quantities])
        return self.derivatives * np.where(p == 0.0, np.nan, p) / np.where(q == 0.0, np.nan, q)

    @property
    def changes(self) -> Array:
        """First-order change of each quantity for each parameter's tolerance."""
        return self.derivatives * np.array([self.tolerances[n] for n in self.parameters])[:, None]

    def predict(self, changes: Mapping[str, float]) -> dict[str, float]:
        """Return the quantities, to first order, after parameters change by the amounts given."""
        moved = np.array([self.values[n] for n in self.quantities])
        for name, change in changes.items():
            moved = moved + self.derivatives[self._row(name)] * change
        return dict(zip(self.quantities, (float(v) for v in moved), strict=True))

    def ordered(self, quantity: str | None = None) -> list[str]:
        """Return the parameters by falling influence on a quantity (default the first) within their tolerances."""
        column = self._column(quantity or self.quantities[0])
        size = np.abs(self.changes[:, column])
        return [self.parameters[i] for i in np.lexsort((np.arange(len(size)), -size))]

    def with_tolerances(self, tolerances: Mapping[str, float]) -> Sensitivities:
        """Return the same derivatives with other tolerances for some parameters."""
        return Sensitivities(
            self.point, self.parameters, self.quantities, self.derivatives, self.values, self.units,
            {**self.tolerances, **checked_tolerances(tolerances, self.parameters)}, self.evaluations, self.notes,
        )

    def to_csv(self, path: str | Path) -> Path:
        """Write a row a parameter: value, tolerance, derivatives, elasticities and changes; SI and radians."""
        from mjcont.tornado import write_table

        return write_table(self, path)

    def plot(
        self, quantity: str | None = None, tolerances: Mapping[str, float] | None = None, *, most: int = 15,
        ax: Any = None,
    ) -> Any:
        """Draw a tornado chart: how far a quantity moves within each parameter's tolerance; return the axes.

        Parameters
        ----------
        quantity : str, optional
            Default the first.
        tolerances : mapping of parameter to change, optional
            In place of those that the changes are for.
        most : int
            The most influential parameters only.
        ax : matplotlib Axes, optional
        """
        from mjcont.tornado import draw_tornado

        shown = self.with_tolerances(tolerances or {})
        return draw_tornado(shown, self.quantities[self._column(quantity or self.quantities[0])], most, ax)

    def __str__(self) -> str:
        """Return a table, the most influential parameter first."""
        from mjcont.tornado import table

        return table(self)


def checked_tolerances(tolerances: Mapping[str, float], names: Sequence[str]) -> dict[str, float]:
    """Return tolerances as positive floats.

    Raises
    ------
    NameLookupError, ParameterError
        If a name is none of `names` or a tolerance is not positive.
    """
    for name, value in tolerances.items():
        if name not in names:
            raise unknown_name("parameter", name, names)
        if not (math.isfinite(value) and value > 0):
            raise ParameterError(f"the tolerance of {name} must be positive, got {value:g}")
    return {name: float(value) for name, value in tolerances.items()}


def default_tolerance(value: float, unit: str, bounds: tuple[float, float]) -> float:
    """Return 1 deg for an angle, else 1 % of the value, or where that is zero of half the width of its bounds."""
    if unit == "rad":
        return DEGREE
    return PER_CENT * abs(value) if value else 0.5 * PER_CENT * (bounds[1] - bounds[0])


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
    before = point.problem.evaluations
    names = _parameters(point, parameters)
    system = point_system(point)
    values, parameters_of = system.base, point.problem.parameters
    adjoint = Adjoint(system, point.state, system.start_y())
    targets = [_quantity(adjoint, name) for name in _names(point, system, quantities)]
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
        {**own, **checked_tolerances(tolerances or {}, names)}, point.problem.evaluations - before, tuple(notes),
    )


def _parameters(point: Point, wanted: str | Sequence[str] | None) -> list[str]:
    problem, own = point.problem, point_names(point)
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
        return list(system.names or point.problem.observables)
    names = list(dict.fromkeys([wanted] if isinstance(wanted, str) else wanted))
    known = [*system.names, *point.problem.observables]
    known += ["omega"] if any(isinstance(c, Hopf) for c in system.conditions) else []
    for name in names:
        if name not in known:
            raise unknown_name("quantity", name, known)
    if not names:
        raise MjcontError("name at least one quantity")
    return names


@dataclass(frozen=True, slots=True)
class _Quantity:
    """A quantity at a point: its gradient in scaled (x, y), and its derivative in a parameter at a fixed state."""

    name: str
    value: float
    unit: str
    gradient: Array
    direct: Callable[[str], float]


def _quantity(adjoint: Adjoint, name: str) -> _Quantity:
    system, y = adjoint.system, adjoint.y
    gradient = np.zeros(system.n + system.k)
    if name in system.names:
        i = system.names.index(name)
        p = system.free[i]
        gradient[system.n + i] = p.slope(float(y[i]))
        return _Quantity(name, p.value(float(y[i])), p.unit, gradient, lambda other: 0.0)
    problem: Any = system.problem
    if name in problem.observables:
        return _observable(adjoint, name, gradient)
    at = len(system.free)
    conditions: Sequence[Any] = system.conditions
    for c in conditions:
        if isinstance(c, Hopf):
            omega = math.sqrt(c.square(y[at : at + 1]))
            gradient[system.n + at] = math.cosh(float(y[at])) * c.rate**2 / (2.0 * omega)
            return _Quantity(name, omega, "rad/s", gradient, lambda other: 0.0)
        at += len(c.aux)
    raise unknown_name("quantity", name, [*system.names, *problem.observables])


def _observable(adjoint: Adjoint, name: str, gradient: Array) -> _Quantity:
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
    return _Quantity(name, value, problem.observables[name].unit, gradient, along)


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
    if not any(c.unfolds for c in system.conditions):
        return None
    gradient = np.zeros(system.n + system.k)
    gradient[system.n + len(system.free)] = 1.0
    return adjoint.weights(gradient)
