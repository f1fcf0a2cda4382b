"""Plain vector fields u' = f(u, p) as equilibrium problems: no MuJoCo involved."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from scipy import sparse

from mjcont.errors import ParameterError, leaves_domain, unknown_name
from mjcont.numerics.differences import (
    FOURTH_ORDER,
    PARAMETER,
    Stencil,
    jacobian_from_rows,
    jacobian_steps,
)
from mjcont.numerics.problem import Array, Linearization, Pencil, Values
from mjcont.quantities import Observable, Parameter, default_bounds


class VectorField:
    """The first-order system u' = f(u, p) with named parameters.

    Parameters
    ----------
    function : callable
        `function(u, p)` returns (n,); `u` is (n,), `p` a mapping of parameter names to floats.
    u0 : array_like, (n,)
        Default start.
    parameters : mapping of str to float
        Names and default values.
    jacobian : callable, optional
        `jacobian(u, p)` returns df/du, (n, n), dense or scipy.sparse; centred differences otherwise.
    names : sequence of str, optional
        Names of the components of u, by which they are observables; default u[0], u[1], ...
    units : mapping of str to str, optional
        Units of parameters and components, by name.
    scale : array_like, (n,), optional
        Typical size of each component, for arclength and difference steps; default 1.
    bounds : mapping of str to (low, high), optional
        Default range of each parameter.
    """

    second_order = False
    mjcf = None

    def __init__(
        self,
        function: Callable[[Array, Values], Any],
        u0: Any,
        parameters: Mapping[str, float],
        *,
        jacobian: Callable[[Array, Values], Any] | None = None,
        names: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
        scale: Any = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        name: str = "vector field",
    ) -> None:
        self.name = name
        self.u0 = np.atleast_1d(np.array(u0, dtype=float))
        self.n = len(self.u0)
        self.function, self.jacobian = function, jacobian
        self.state_scale = np.ones(self.n) if scale is None else np.array(scale, dtype=float)
        self._counts: dict[int, int] = {}  # by thread: what one computes costs what that one evaluates
        units, bounds = units or {}, bounds or {}
        self.parameters = {
            k: Parameter(k, units.get(k, ""), float(v), bounds.get(k, default_bounds(float(v))), "field")
            for k, v in parameters.items()
        }
        labels = list(names) if names is not None else [f"u[{i}]" for i in range(self.n)]
        if len(labels) != self.n:
            raise ParameterError(f"names: expected {self.n} names for the components of u, got {len(labels)}")
        self.state_labels = [(label, units.get(label, "")) for label in labels]
        self.observables = {
            label: Observable(label, unit, _component(i)) for i, (label, unit) in enumerate(self.state_labels)
        }
        self.keyframes: dict[str, Array] = {}

    def parameter(self, name: str) -> Parameter:
        """Return the parameter called `name`."""
        if name not in self.parameters:
            raise unknown_name("parameter", name, self.parameters)
        return self.parameters[name]

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""
        for name, value in (given or {}).items():
            self.parameter(name)
            if not np.isfinite(value):
                raise ParameterError(f"parameter '{name}': the value must be a finite number, got {value}")
        return {n: p.value for n, p in self.parameters.items()} | {n: float(v) for n, v in (given or {}).items()}

    def start_state(self, keyframe: str | None = None, state: Array | None = None) -> Array:
        """Return the state given, or u0."""
        if keyframe is not None:
            raise unknown_name("keyframe", keyframe, self.keyframes)
        x = self.u0.copy() if state is None else np.array(state, dtype=float)
        if x.shape != (self.n,):
            raise ParameterError(f"state must have shape ({self.n},), got {x.shape}")
        return x

    @property
    def evaluations(self) -> int:
        """Evaluations of the function so far, by this thread."""
        return self._counts.get(threading.get_ident(), 0)

    # -- the problem -----------------------------------------------------------------------------------------

    def residual(self, x: Array, values: Values) -> Array:
        """Return f, (n,); NaN where the function overflows or leaves its domain."""
        thread = threading.get_ident()
        self._counts[thread] = self._counts.get(thread, 0) + 1
        try:
            return np.array(self.function(x, values), dtype=float).reshape(self.n)
        except (ArithmeticError, ValueError) as error:
            if leaves_domain(error):  # ends a curve there, with what came before
                return np.full(self.n, np.nan)
            raise

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x plus each row of `steps`, (m, n)."""
        return np.array([self.residual(x + s, values) for s in steps])

    def residuals_along(self, states: Array, values: Values, name: str, column: Array) -> Array:
        """Return f at states (m, n), a parameter having a value of its own in each (m,), shape (m, n)."""
        at = dict(values)
        found = np.empty((len(states), self.n))
        for i, value in enumerate(column.tolist()):
            at[name] = value
            found[i] = self.residual(states[i], at)
        return found

    def linearize_along(self, states: Array, values: Values, name: str, column: Array) -> None:
        """Return None: functions are evaluated one state after the other."""
        del states, values, name, column

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, spans: Sequence[float] = ()
    ) -> Linearization:
        """Return f, df/du and df/dp (always by fourth-order differences where no Jacobian is given)."""
        del accurate
        f = self.residual(x, values)
        if self.jacobian is not None:
            jac = self.jacobian(x, values)
            jac = sparse.csc_matrix(jac) if sparse.issparse(jac) else np.array(jac, dtype=float)
        else:
            steps = jacobian_steps(self.state_scale, FOURTH_ORDER)
            jac = jacobian_from_rows(self.residuals(x, values, steps), self.state_scale, FOURTH_ORDER)
        par = np.empty((self.n, len(wrt)))
        for k, name in enumerate(wrt):
            rule, h = self.parameter_stencil(name, values[name], spans[k] if spans else None)
            rows = [self.residual(x, {**values, name: values[name] + o * h}) for o in rule.offsets]
            par[:, k] = np.asarray(rule.weights) @ np.array(rows) / h
        return Linearization(f, jac, par)

    def parameter_stencil(self, name: str, value: float, span: float | None = None) -> tuple[Stencil, float]:
        """Return the fourth-order rule and a step relative to the parameter's value, or to its span near zero."""
        low, high = self.parameters[name].bounds
        return PARAMETER, PARAMETER.step * max(abs(value), 1e-2 * (span or high - low))

    def pencil(self, x: Array, values: Values, jac: Any) -> Pencil:
        """Return the pencil of a first-order system: M = 0, C = I, K = -df/du."""
        del x, values
        return Pencil(None, None, -jac)

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x plus each row of `steps`."""
        return self.residuals(x, values, steps)

    def retract(self, x: Array, step: Array) -> Array:
        """Return x + step."""
        return x + step

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return states + steps, (m, n)."""
        return states + steps

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return x1 - x0."""
        return x1 - x0

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return ends - starts, (m, n)."""
        return ends - starts

    # -- observables -----------------------------------------------------------------------------------------

    def observe(self, name: str, function: Callable[[Array, Values], float], unit: str = "") -> None:
        """Add an observable computed by `function(u, p)`."""
        self.observables[name] = Observable(name, unit, lambda values, x: function(x, values))

    def observable(self, name: str) -> Observable:
        """Return the observable called `name`."""
        if name not in self.observables:
            raise unknown_name("observable", name, self.observables)
        return self.observables[name]

    def measure(self, states: Array, values: Sequence[Values] | Values, names: Sequence[str] | None = None) -> Array:
        """Return observables for states (m, n), shape (m, number of names)."""
        chosen = [self.observable(n) for n in (names if names is not None else self.observables)]
        per_row = [values] * len(states) if isinstance(values, Mapping) else values
        return np.array([[o.function(v, x) for o in chosen] for x, v in zip(states, per_row, strict=True)])

    def measure_along(self, states: Array, values: Values, name: str, column: Array) -> Array:
        """Return all observables for states (m, n), a parameter having a value of its own in each (m,)."""
        return self.measure(states, [{**values, name: v} for v in column.tolist()])

    def __str__(self) -> str:
        """List parameters and components."""
        names = ", ".join(f"{p.name} = {p.value:g}" for p in self.parameters.values())
        return f"{self.name}: {self.n} unknowns; parameters {names}"


def _component(i: int) -> Callable[[Any, Any], float]:
    return lambda values, x: float(x[i])
