"""Several parameters that change together, seen as one: a problem in the fraction of the way from one load to the next.

Along a leg p(t) = (1 - t) p_0 + t p_1, so that df/dt is the sum of df/dp_i (p_1 - p_0)_i.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mjcont.branch import Branch, Column
from mjcont.numerics.differences import CENTRED, PARAMETER, Stencil
from mjcont.numerics.problem import Array, Linearization, Pencil, Values
from mjcont.quantities import Parameter
from mjcont.storage import special_from_row

FRACTION = "leg"


class Leg:
    """A problem whose parameter `leg` leads from one set of parameter values, at 0, to another, at 1."""

    def __init__(self, problem: Any, first: Values, last: Values) -> None:
        self.problem = problem
        self.first = {n: first[n] for n in last if last[n] != first[n]}
        self.last = {n: last[n] for n in self.first}
        self.parameters = {**problem.parameters, FRACTION: Parameter(FRACTION, "1", 0.0, (0.0, 1.0), "field")}

    def __getattr__(self, name: str) -> Any:
        """Leave everything that no parameter touches to the problem itself."""
        if name == "problem":  # not there yet while a copy is made
            raise AttributeError(name)
        return getattr(self.problem, name)

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
        """Return False: a fraction moves several parameters."""
        del name
        return False

    def residuals_along(self, states: Array, values: Values, name: str, column: Array) -> Array:
        """Return f at states (m, nq), a parameter having a value of its own in each (m,), shape (m, n)."""
        return np.array([self.residual(x, {**values, name: v}) for x, v in zip(states, column.tolist(), strict=True)])

    def linearize_along(self, states: Array, values: Values, name: str, column: Array) -> None:
        """Return None: a fraction moves several parameters."""
        del states, values, name, column

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, spans: Sequence[float] = ()
    ) -> Linearization:
        """Return f, df/dx and df/dp, for the fraction by the chain rule."""
        del spans
        names = tuple(self.first) if FRACTION in wrt else tuple(wrt)
        widths = [abs(self.last[n] - self.first[n]) if n in self.first else 1.0 for n in names]
        lin = self.problem.linearize(x, self.at(values), names, accurate=accurate, spans=widths)
        if FRACTION not in wrt:
            return lin
        slope = lin.par @ np.array([self.last[n] - self.first[n] for n in names])
        return Linearization(lin.f, lin.jac, slope[:, None], lin.piece)

    def parameter_stencil(self, name: str, value: float, span: float | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""
        if name != FRACTION:
            return self.problem.parameter_stencil(name, value, span)
        affine = all(getattr(self.problem.parameter(n), "affine", False) for n in self.first)
        return (CENTRED, 1e-2) if affine else (PARAMETER, PARAMETER.step)

    def pencil(self, x: Array, values: Values, jac: Any) -> Pencil:
        """Return the matrices whose eigenvalues tell stability."""
        return self.problem.pencil(x, self.at(values), jac)

    def pencils(self, states: Sequence[Array], values: Sequence[Values], jacs: Sequence[Any]) -> list[Pencil]:
        """Return the matrices at many equilibria of a passive problem."""
        return self.problem.pencils(states, [self.at(v) for v in values], jacs)

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the right-hand side of the first-order form."""
        return self.problem.first_order(x, self.at(values), steps)

    def periods(self, x: Array, values: Values) -> Array:
        """Return the coordinates' periods; infinity where there are none."""
        periods = getattr(self.problem, "periods", None)
        return periods(x, self.at(values)) if periods else np.full(self.problem.n, np.inf)

    def active(self, x: Array, values: Values) -> frozenset[str]:
        """Return the limits and contacts that carry load."""
        active = getattr(self.problem, "active", None)
        return active(x, self.at(values)) if active else frozenset()

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a tangent step without motions that the problem holds."""
        admissible = getattr(self.problem, "admissible", None)
        return admissible(x, step) if admissible else step

    def measure(self, states: Array, values: Sequence[Values] | Values, names: Sequence[str] | None = None) -> Array:
        """Return observables."""
        at = self.at(values) if isinstance(values, Mapping) else [self.at(v) for v in values]
        return self.problem.measure(states, at, names)

    def measure_along(self, states: Array, values: Values, name: str, column: Array) -> Array:
        """Return all observables, a parameter having a value of its own in each state (m,)."""
        return self.measure(states, [{**values, name: v} for v in column.tolist()])


def unwrapped(branch: Branch) -> Branch:
    """Return a branch followed in `leg` as one of the problem itself, in the parameters that changed."""
    leg: Leg = branch.problem
    fractions = branch.columns[FRACTION].values
    values = [leg.at({**branch.fixed, FRACTION: float(t)}) for t in fractions]
    columns = {
        n: Column(n, leg.problem.parameter(n).unit, "parameter", np.array([v[n] for v in values])) for n in leg.first
    }
    columns |= {n: c for n, c in branch.columns.items() if n != FRACTION}
    plain = replace(
        branch,
        columns=columns,
        free={n: tuple(sorted((leg.first[n], leg.last[n]))) for n in leg.first},  # type: ignore[misc]
        fixed={n: v for n, v in branch.fixed.items() if n not in leg.first},
        problem=leg.problem,
        special_points=(),
    )
    points = [
        special_from_row(
            plain.row(p.index), kind=p.kind, label=p.label, index=p.index, tolerance=p.tolerance,
            converged=p.converged, coefficients=p.coefficients, vectors=p.vectors, note=p.note, free=plain.free,
        )
        for p in branch.special_points
    ]
    object.__setattr__(plain, "special_points", tuple(points))
    return plain
