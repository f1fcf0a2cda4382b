"""Several parameters that change together, seen as one: a problem in the fraction of the way from one load to the next.

Along a leg p(t) = (1 - t) p_0 + t p_1, so that df/dt is the sum of df/dp_i (p_1 - p_0)_i.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.errors import ParameterError
from mjcont.numerics.equations.differences import CENTRED, PARAMETER, kept_within
from mjcont.numerics.equations.problem import Array, Linearization, Pencil, Range, Ranges, Stencil, Values
from mjcont.results.branch import Branch
from mjcont.results.model import Model
from mjcont.results.points import Column, Point
from mjcont.results.quantities import Parameter, check_values, finite

FRACTION = "leg"


class Leg(Model):
    """A model whose parameter `leg` leads from one set of parameter values, at 0, to another, at 1."""

    def __init__(self, problem: Model, first: Values, last: Values) -> None:
        self.problem = problem
        self.first = {n: first[n] for n in last if last[n] != first[n]}
        self.last = {n: last[n] for n in self.first}
        self.parameters = {**problem.parameters, FRACTION: Parameter(FRACTION, "1", 0.0, (0.0, 1.0), "field")}
        self.n, self.second_order, self.state_scale = problem.n, problem.second_order, problem.state_scale
        self.name, self.observables, self.keyframes = problem.name, problem.observables, problem.keyframes
        self.mjcf, self.declared, self.constrained = problem.mjcf, problem.declared, problem.constrained

    # -- what no parameter touches is the model's own ----------------------------------------------------------

    @property
    def evaluations(self) -> int:
        """Number of evaluations of f so far."""
        return self.problem.evaluations

    @property
    def passive(self) -> bool:
        """Whether the model is passive."""
        return self.problem.passive

    @property
    def nonsmooth(self) -> bool:
        """Whether the model is smooth in pieces only."""
        return self.problem.nonsmooth

    @property
    def pieces(self) -> Sequence[bytes]:
        """On which smooth piece of f each row of the last evaluation lies."""
        return self.problem.pieces

    @property
    def failure(self) -> str:
        """Why f had no value where it was evaluated last."""
        return self.problem.failure

    @property
    def held(self) -> tuple[str, ...]:
        """The rigid-body modes that are held."""
        return self.problem.held

    @property
    def state_labels(self) -> list[tuple[str, str]]:
        """Name and unit of each entry of the state."""
        return self.problem.state_labels

    def start_state(self, keyframe: str | None = None, state: Any = None) -> Array:
        """Return a start of the model."""
        return self.problem.start_state(keyframe, state)

    def rigid_directions(self, x: Array) -> dict[str, Array]:
        """Return the tangent vectors along the held rigid-body modes."""
        return self.problem.rigid_directions(x)

    def retract(self, x: Array, step: Array) -> Array:
        """Return x moved by a tangent step (n,)."""
        return self.problem.retract(x, step)

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return states moved by the rows of tangent steps (m, n)."""
        return self.problem.retract_each(states, steps)

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step (n,) that takes x0 to x1."""
        return self.problem.difference(x1, x0)

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return the tangent steps (m, n) that take states to others."""
        return self.problem.difference_each(ends, starts)

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a tangent step without motions that the model holds."""
        return self.problem.admissible(x, step)

    # -- what the fraction moves -------------------------------------------------------------------------------

    def at(self, values: Values) -> dict[str, float]:
        """Return the parameter values that a fraction of the way stands for."""
        t = values[FRACTION]
        moved = {n: (1.0 - t) * self.first[n] + t * self.last[n] for n in self.first}
        return {**{n: v for n, v in values.items() if n != FRACTION}, **moved}

    def parameter(self, name: str) -> Parameter:
        """Return a parameter, the fraction among them."""
        return self.parameters[FRACTION] if name == FRACTION else self.problem.parameter(name)

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter."""
        given = dict(given or {})
        return {FRACTION: given.pop(FRACTION, 0.0), **self.problem.values(given)}

    def residual(self, x: Array, values: Values) -> Array:
        """Return f, (n,)."""
        return self.problem.residual(x, self.at(values))

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x moved by each row of steps, (m, n)."""
        return self.problem.residuals(x, self.at(values), steps)

    def side_by_side(self, name: str) -> bool:
        """Whether many states that differ in the fraction cost hardly more than one."""
        return name == FRACTION and all(map(self.problem.side_by_side, self.first))

    def residuals_along(self, states: Array, values: Values, columns: Mapping[str, Array]) -> Array:
        """Return f at states (m, nq), the fraction having a value of its own in each, shape (m, n)."""
        t = columns[FRACTION]
        moved = {n: (1.0 - t) * self.first[n] + t * self.last[n] for n in self.first}
        return self.problem.residuals_along(states, self.at({FRACTION: 0.0, **values}), moved)

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> Linearization:
        """Return f, df/dx and df/dp, for the fraction by the chain rule."""
        names = tuple(self.first) if FRACTION in wrt else tuple(wrt)
        own = dict(zip(wrt, ranges or [None] * len(wrt), strict=True))
        along = {n: (min(self.first[n], self.last[n]), max(self.first[n], self.last[n])) for n in self.first}
        within = [along.get(n, own.get(n)) for n in names]
        lin = self.problem.linearize(x, self.at(values), names, accurate=accurate, ranges=within)
        if FRACTION not in wrt:
            return lin
        slope = lin.par @ np.array([self.last[n] - self.first[n] for n in names])
        return Linearization(lin.f, lin.jac, slope[:, None], lin.piece)

    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        if name != FRACTION:
            return self.problem.parameter_stencil(name, value, bounds)
        affine = all(self.problem.parameter(n).affine for n in self.first)
        return kept_within(*((CENTRED, 1e-2) if affine else (PARAMETER, PARAMETER.step)), value, (0.0, 1.0))

    def pencil(self, x: Array, values: Values, jac: Any) -> Pencil:
        """Return the matrices whose eigenvalues tell stability."""
        return self.problem.pencil(x, self.at(values), jac)

    def pencils(self, states: Array, values: Sequence[Values], jacs: Sequence[Any]) -> list[Pencil]:
        """Return the matrices at many equilibria of a passive problem."""
        return self.problem.pencils(states, [self.at(v) for v in values], jacs)

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the right-hand side of the first-order form."""
        return self.problem.first_order(x, self.at(values), steps)

    def derivative_along(self, x: Array, values: Values, *vectors: Array) -> Array | None:
        """Return a derivative along vectors where the problem computes it itself."""
        return self.problem.derivative_along(x, self.at(values), *vectors)

    def periods(self, x: Array, values: Values) -> Array:
        """Return the coordinates' periods; infinity where there are none."""
        return self.problem.periods(x, self.at(values))

    def active(self, x: Array, values: Values) -> frozenset[str]:
        """Return the limits and contacts that carry load."""
        return self.problem.active(x, self.at(values))

    def measure(self, states: Array, values: Sequence[Values] | Values, names: Sequence[str] | None = None) -> Array:
        """Return observables."""
        at = self.at(values) if isinstance(values, Mapping) else [self.at(v) for v in values]
        return self.problem.measure(states, at, names)


def unwrapped(branch: Branch) -> Branch:
    """Return a branch followed in `leg` as one of the problem itself, in the parameters that changed."""
    leg = branch.problem
    assert isinstance(leg, Leg)
    fractions = branch.columns[FRACTION].values
    values = [leg.at({**branch.fixed, FRACTION: float(t)}) for t in fractions]
    columns = {
        n: Column(n, leg.problem.parameter(n).unit, "parameter", np.array([v[n] for v in values])) for n in leg.first
    }
    columns |= {n: c for n, c in branch.columns.items() if n != FRACTION}
    return replace(
        branch,
        columns=columns,
        free={n: tuple(sorted((leg.first[n], leg.last[n]))) for n in leg.first},  # type: ignore[misc]
        fixed={n: v for n, v in branch.fixed.items() if n not in leg.first},
        problem=leg.problem,
    )


def loads_of(problem: Any, parameter: Any, path: Any, start: Any) -> list[dict[str, float]]:
    """Return the parameter values between which the path runs, each with every parameter that changes."""
    if isinstance(parameter, str):
        if path is None:
            raise ParameterError(f"load_path needs the values of {parameter} to follow, such as [0, 30, 0]")
        rows: list[Mapping[str, float]] = [{parameter: v} for v in (path if np.ndim(path) else [path])]
    else:
        if path is not None:
            raise ParameterError("give a parameter's name and its values, or a list of dicts")
        rows = list(parameter)
    if any(not isinstance(r, Mapping) for r in rows):
        raise ParameterError("a path in several parameters is a list of dicts, such as [{'F': 0}, {'F': 3, 'G': 1}]")
    names = list(dict.fromkeys(n for r in rows for n in r))
    known = start.parameters if isinstance(start, Point) else (start or {})
    check_values(known)
    current = {n: finite(n, known.get(n, problem.parameter(n).value)) for n in names}
    found: list[dict[str, float]] = []
    for row in rows:
        try:
            current = {**current, **{n: float(v) for n, v in row.items()}}
        except (TypeError, ValueError) as error:
            raise ParameterError(f"the loads of a path must be numbers, got {dict(row)}") from error
        problem.values(current)
        found.append(current)
    if len(found) < 2 or all(v == found[0] for v in found):
        raise ParameterError("a path needs at least two different loads, such as [0, 30]")
    return found
