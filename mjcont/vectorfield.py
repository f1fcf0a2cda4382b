"""Plain vector fields u' = f(u, p) as equilibrium problems: no MuJoCo involved."""

from __future__ import annotations

import copy
import inspect
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self

import numpy as np
from scipy import sparse

from mjcont.arguments import checked
from mjcont.errors import FunctionError, MjcontError, ParameterError, leaves_domain, unknown_name
from mjcont.numerics.equations.clock import TimeUp, check
from mjcont.numerics.equations.differences import (
    FOURTH_ORDER,
    PARAMETER,
    jacobian_from_rows,
    jacobian_steps,
    kept_within,
)
from mjcont.numerics.equations.problem import Array, Linearization, Pencil, Range, Ranges, Stencil, Values
from mjcont.results.model import Model
from mjcont.results.quantities import (
    Observable,
    Parameter,
    check_values,
    default_bounds,
    finite,
    finite_array,
    finite_pair,
    own_observable,
    told_apart,
)

# a scale is far from the sizes of components by this factor; no component's is below this part of the largest
_FAR, _LEAST = 20.0, 1e-3
# components all below this part of the scale are zero, as far as equations without a scale can tell
_NOTHING = 1e-8
# more components than this are those of a function on a grid
_GRID = 50


class VectorField(Model):
    """The first-order system u' = f(u, p), or u' = f(u, p, t) with a period in t, with named parameters.

    Parameters
    ----------
    function : callable
        `function(u, p)` returns (n,); `u` is (n,), `p` a mapping of parameter names to floats. It may take the time
        as a third argument, in s: with a `period` it is forced, without one t is 0 wherever it is evaluated.
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
        Typical size of each component, for arclength and difference steps. Without it the verbs that follow curves
        start from 1 and take the sizes that the components are found to have, where these are far from it; and more
        than 50 components count in arclength by the root of their mean square, as values of a function on a grid.
    bounds : mapping of str to (low, high), optional
        Default range of each parameter.
    period : callable, optional
        `period(p)` returns the period of the forcing, in s. Such a field has responses (`continue_response`), no
        equilibria.
    energy : callable, optional
        `energy(u, p)` returns what the motion keeps, where it keeps it: its orbits are then nonlinear normal modes
        (`continue_modes`).

    Raises
    ------
    ParameterError, BoundsError, NameLookupError
        If a start, scale, value or bound is not finite or does not fit; see the message. A function that raises (but
        for overflow, or outside its domain) or returns no n numbers is a FunctionError where it is called.
    """

    second_order = False
    state_labels: list[tuple[str, str]] = []

    @checked
    def __init__(
        self,
        function: Callable[..., Any],
        u0: Any,
        parameters: Mapping[str, float],
        *,
        jacobian: Callable[[Array, Values], Any] | None = None,
        names: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
        scale: Any = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        name: str = "vector field",
        period: Callable[[Values], float] | None = None,
        energy: Callable[[Array, Values], float] | None = None,
    ) -> None:
        self.name, self.period, self.energy = name, period, energy
        self.timed = _takes_time(function)
        self.n = np.size(u0)
        if self.n == 0:
            raise ParameterError("u0 is empty: a vector field needs at least one unknown")
        self.u0 = finite_array("u0", np.atleast_1d(u0), (self.n,))
        self.function, self.jacobian = function, jacobian
        self.follows_scale = scale is None
        self._typical = np.ones(self.n) if scale is None else finite_array("scale", scale, (self.n,))
        if not np.all(self._typical > 0.0):
            raise ParameterError(f"scale must be positive, got {self._typical}")
        self.state_scale = self._unit(self._typical)
        # by thread: what one computes costs what that one evaluates; shared with copies of another scale
        self._counts: dict[int, int] = {}
        units, bounds = units or {}, bounds or {}
        for k in bounds:
            if k not in parameters:
                raise unknown_name("parameter", k, parameters)
        default = {k: finite(f"parameter '{k}': the value", v) for k, v in parameters.items()}
        own = {k: finite_pair(f"bounds of {k}", b) for k, b in bounds.items()}
        self.parameters = {
            k: Parameter(k, units.get(k, ""), v, own.get(k, default_bounds(v)), "field") for k, v in default.items()
        }
        for parameter in self.parameters.values():
            parameter.check(parameter.value)
        labels = list(names) if names is not None else [f"u[{i}]" for i in range(self.n)]
        if len(labels) != self.n:
            raise ParameterError(f"names: expected {self.n} names for the components of u, got {len(labels)}")
        self.state_labels = [(label, units.get(label, "")) for label in labels]
        components = {
            label: Observable(label, unit, _component(i), of="state")
            for i, (label, unit) in enumerate(self.state_labels)
        }
        self.observables = told_apart(components, self.parameters)
        self.keyframes: dict[str, Array] = {}

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""
        given = {} if given is None else given
        check_values(given)
        for name, value in given.items():
            self.parameter(name).check(value)
        return {n: p.value for n, p in self.parameters.items()} | {n: float(v) for n, v in given.items()}

    def rescaled(self, sizes: Array, *, grow: bool = False) -> Self | None:
        """Return this field with the scale that sizes of its components (n,) tell, unless one was given."""
        top = float(sizes.max())
        if not (self.follows_scale and 0.0 < top < np.inf):
            return None
        ratio = sizes / self.typical
        if not np.any(ratio > _NOTHING):  # rest at zero, but for rounding
            return None
        if not (np.any(ratio > _FAR) or (not grow and np.all(ratio < 1.0 / _FAR))):
            return None
        field = copy.copy(self)
        # to two digits: no last bit decides; a component that hardly moves tells nothing
        field._typical = np.array([float(f"{max(s, _LEAST * top):.1e}") for s in sizes.tolist()])
        field.state_scale = self._unit(field._typical)
        return field

    @property
    def typical(self) -> Array:
        """Typical size of each component, (n,), for difference steps."""
        return self._typical

    def _unit(self, typical: Array) -> Array:
        """Return the unit of each component in arclength, (n,): a scale that was given, as it stands.

        Many components are a function on a grid: their norm is the root of the mean square, whatever their number.
        """
        return typical * np.sqrt(self.n) if self.follows_scale and self.n > _GRID else typical

    def start_state(self, keyframe: str | None = None, state: Array | None = None) -> Array:
        """Return the state given, or u0."""
        if keyframe is not None:
            raise unknown_name("keyframe", keyframe, self.keyframes)
        labels = [name for name, _ in self.state_labels]
        return self.u0.copy() if state is None else finite_array("state", state, (self.n,), labels=labels)

    @property
    def evaluations(self) -> int:
        """Evaluations of the function so far, by this thread."""
        return self._counts.get(threading.get_ident(), 0)

    # -- the problem -----------------------------------------------------------------------------------------

    def residual(self, x: Array, values: Values) -> Array:
        """Return f, (n,); NaN where the function overflows or leaves its domain."""
        return self.rate(x, values, 0.0)

    def rate(self, x: Array, values: Values, time: float) -> Array:
        """Return f at a time, in s, (n,), as `residual`."""
        check()
        thread = threading.get_ident()
        self._counts[thread] = self._counts.get(thread, 0) + 1
        try:
            found = np.array(self.function(x, values, time) if self.timed else self.function(x, values), dtype=float)
        except MjcontError:
            raise
        except Exception as error:
            if leaves_domain(error):  # ends a curve there, with what came before
                return np.full(self.n, np.nan)
            raise FunctionError(f"the function of {self.name} raised {type(error).__name__}: {error}") from error
        if found.size != self.n:
            raise FunctionError(f"the function of {self.name} returned shape {found.shape} for {self.n} unknowns")
        return found.reshape(self.n)

    def rates(self, states: Array, values: Sequence[Values], times: Sequence[float]) -> Array:
        """Return f at states (m, n), each with its own parameter values and time in s, (m, n), as `rate` does."""
        function, timed, found = self.function, self.timed, []
        try:
            for u, p, t in zip(states, values, times, strict=True):
                check()
                value = function(u, p, t) if timed else function(u, p)
                # the user may fill one array, or one list, again and again
                found.append(value.copy() if isinstance(value, np.ndarray) else tuple(value))
            rows = np.array(found, dtype=float)
        except TimeUp:
            raise
        except Exception:  # one by one, to see which has no value
            rows = np.empty(0)
        if rows.shape != states.shape:
            return np.array([self.rate(u, p, t) for u, p, t in zip(states, values, times, strict=True)])
        thread = threading.get_ident()
        self._counts[thread] = self._counts.get(thread, 0) + len(states)
        return rows

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x plus each row of `steps`, (m, n)."""
        return self.rates(x + steps, [values] * len(steps), [0.0] * len(steps))

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> Linearization:
        """Return f, df/du and df/dp (always by fourth-order differences where no Jacobian is given)."""
        del accurate
        f = self.residual(x, values)
        if self.jacobian is not None:
            jac = self._own_jacobian(self.jacobian, x, values)
        else:
            steps = jacobian_steps(self.typical, FOURTH_ORDER)
            jac = jacobian_from_rows(self.residuals(x, values, steps), self.typical, FOURTH_ORDER)
        par = np.empty((self.n, len(wrt)))
        for k, name in enumerate(wrt):
            rule, h = self.parameter_stencil(name, values[name], ranges[k] if ranges else None)
            rows = [self.residual(x, {**values, name: values[name] + o * h}) if o else f for o in rule.offsets]
            par[:, k] = np.asarray(rule.weights) @ np.array(rows) / h
        return Linearization(f, jac, par)

    def _own_jacobian(self, function: Callable[[Array, Values], Any], x: Array, values: Values) -> Any:
        """Return the user's df/du, NaN where it overflows or leaves its domain."""
        try:
            jac = function(x, values)
            jac = sparse.csc_matrix(jac, dtype=float) if sparse.issparse(jac) else np.array(jac, dtype=float)
        except MjcontError:
            raise
        except Exception as error:
            if leaves_domain(error):  # of many unknowns its diagonal says as much
                many = self.n > _GRID
                nothing = np.full(self.n, np.nan)
                return sparse.diags(nothing, format="csc") if many else np.tile(nothing, (self.n, 1))
            raise FunctionError(f"the jacobian of {self.name} raised {type(error).__name__}: {error}") from error
        if jac.shape != (self.n, self.n):
            raise FunctionError(f"the jacobian of {self.name} returned shape {jac.shape} for {self.n} unknowns")
        return jac

    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return a fourth-order rule within bounds and a step relative to the value, or to the bounds near zero."""
        low, high = self.parameters[name].bounds if bounds is None else bounds
        step = PARAMETER.step * max(abs(value), 1e-2 * (high - low))
        return (PARAMETER, step) if bounds is None else kept_within(PARAMETER, step, value, bounds)

    def pencil(self, x: Array, values: Values, jac: Any) -> Pencil:
        """Return the pencil of a first-order system: M = 0, C = I, K = -df/du."""
        del x, values
        return Pencil(None, None, -jac)

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x plus each row of `steps`."""
        return self.residuals(x, values, steps)

    @property
    def own_jacobian(self) -> bool:
        """Whether the user gave one."""
        return self.jacobian is not None

    # -- observables -----------------------------------------------------------------------------------------

    @checked
    def observe(self, name: str, function: Callable[[Array, Values], float], unit: str = "") -> None:
        """Add an observable computed by `function(u, p)`."""
        self.observables[name] = own_observable(name, unit, lambda values, x: function(x, values), self.parameters)

    def measure(self, states: Array, values: Sequence[Values] | Values, names: Sequence[str] | None = None) -> Array:
        """Return observables for states (m, n), shape (m, number of names)."""
        chosen = list(self.observables.values()) if names is None else [self.observable(n) for n in names]
        per_row = [values] * len(states) if isinstance(values, Mapping) else values
        return np.array([[_measured(o, v, x) for o in chosen] for x, v in zip(states, per_row, strict=True)])

    def __str__(self) -> str:
        """List parameters and components."""
        names = ", ".join(f"{p.name} = {p.value:g}" for p in self.parameters.values())
        return f"{self.name}: {self.n} unknowns; parameters {names}"


def _measured(observable: Observable, values: Values, x: Array) -> float:
    try:
        return float(observable.function(values, x))
    except MjcontError:
        raise
    except Exception as error:
        if leaves_domain(error):
            return np.nan
        raise FunctionError(f"observable '{observable.name}' raised {type(error).__name__}: {error}") from error


def _takes_time(function: Callable[..., Any]) -> bool:
    """Whether a function must be given three arguments."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return False
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(p.kind in positional and p.default is p.empty for p in parameters) == 3


def _component(i: int) -> Callable[[Any, Any], float]:
    return lambda values, x: float(x[i])
