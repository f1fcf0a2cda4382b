"""Plain vector fields u' = f(u, p) as equilibrium problems: no MuJoCo involved."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, ParameterError, leaves_domain, unknown_name
from mjcont.fields.checks import Held
from mjcont.fields.derivatives import Derivatives
from mjcont.fields.foreign import offered
from mjcont.fields.functions import Evaluated, raised, takes_time
from mjcont.fields.parameters import declared, flattened
from mjcont.fields.together import SideBySide
from mjcont.numerics.equations.differences import (
    FOURTH_ORDER,
    PARAMETER,
    jacobian_from_rows,
    jacobian_steps,
    kept_within,
)
from mjcont.numerics.equations.problem import Array, Linearization, Pencil, Range, Ranges, Stencil, Values
from mjcont.results.quantities import (
    Observable,
    check_values,
    finite_array,
    own_observable,
    told_apart,
)

# a scale is far from the sizes of components by this factor; no component's is below this part of the largest
_FAR, _LEAST = 20.0, 1e-3
# components all below this part of the scale are zero, as far as equations without a scale can tell
_NOTHING = 1e-8


class VectorField(SideBySide):
    """The first-order system u' = f(u, p), or u' = f(u, p, t) with a period in t, with named parameters.

    Parameters
    ----------
    function : callable
        `function(u, p)` returns (n,); `u` is (n,), `p` a mapping of parameter names to numbers. It may take the time
        as a third argument, in s: with a `period` it is forced, without one t is 0 wherever it is evaluated. A
        `vectorized` one also takes many states at once, as the columns of u (n, m), and returns (n, m); a parameter or
        the time is then a number, or (m,) where it differs between the states. A function of CasADi or one that
        `jax.jit` returns brings all that follows, `vectorized` included (docs/fields.md).
    u0 : array_like, (n,)
        Default start.
    parameters : mapping of str to float or (k,) array
        Names and default values. An array stands for k parameters, `name[0]`, `name[1]`, ...; the function sees it
        whole, `p[name]` (k,), or (k, m) for many states at once.
    jacobian : callable, optional
        `jacobian(u, p)` returns df/du, (n, n), dense, scipy.sparse, or an operator with `matvec`, whose products are
        put into a dense matrix; centred differences otherwise. It is given one state, (n,), at a time.
    dfdp : callable, optional
        `dfdp(u, p)` returns df/dp: a mapping of names to (n,), (n, k) for an array, or an array (n, number of
        parameters) in their order. Those that a mapping leaves out are differences.
    second, third : callable, optional
        `second(u, p, v, w)` returns D2f[v, w], `third(u, p, v, w, z)` D3f[v, w, z], both (n,): normal forms, gradients
        of defining systems and sensitivities use them instead of differences. All derivatives are held against
        differences at the first point (see `check_derivatives`).
    vectorized : bool, optional
        Whether `function` takes states as columns. The first time that it is given some, three are also evaluated one
        by one, and compared.
    names : sequence of str, optional
        Names of the components of u, by which they are observables; default u[0], u[1], ...
    units : mapping of str to str, optional
        Units of parameters and components, by name; an array's for all its entries.
    scale : array_like, (n,), optional
        Typical size of each component, for arclength and difference steps. Without it the verbs that follow curves
        start from 1 and take the sizes that the components are found to have, where these are far from it.
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
        parameters: Mapping[str, Any],
        *,
        jacobian: Callable[[Array, Values], Any] | None = None,
        dfdp: Callable[[Array, Values], Any] | None = None,
        second: Callable[[Array, Values, Array, Array], Any] | None = None,
        third: Callable[[Array, Values, Array, Array, Array], Any] | None = None,
        names: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
        scale: Any = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        name: str = "vector field",
        period: Callable[[Values], float] | None = None,
        energy: Callable[[Array, Values], float] | None = None,
        vectorized: bool = False,
    ) -> None:
        self.name, self.n = name, np.size(u0)
        if self.n == 0:
            raise ParameterError("u0 is empty: a vector field needs at least one unknown")
        self.u0 = finite_array("u0", np.atleast_1d(u0), (self.n,))
        default, self._arrays = flattened(parameters)
        self.period, self.energy = self._arrays.whole(period), self._arrays.whole(energy)
        timed = takes_time(function)
        own = {"jacobian": jacobian, "dfdp": dfdp, "second": second, "third": third}
        foreign = offered(function, name, self.n, tuple(default), self._arrays, timed)
        if foreign is not None:
            function, timed, vectorized = foreign.function, foreign.timed, True
            own = {what: getattr(foreign, what) if each is None else each for what, each in own.items()}
        self._given = Derivatives(name, self.n, tuple(default), self._arrays, **own)
        self.timed, self.vectorized = timed, vectorized
        # which derivatives were held against differences already; shared with copies of another scale
        self._held_against = set[str]()
        self.state_scale = np.ones(self.n) if scale is None else finite_array("scale", scale, (self.n,))
        if not np.all(self.state_scale > 0.0):
            raise ParameterError(f"scale must be positive, got {self.state_scale}")
        self.follows_scale = scale is None
        self._f = Evaluated(name, function, self.n, timed, vectorized, self._arrays, self.state_scale)
        units = self._arrays.spread(units or {}, default)
        self.parameters = declared(default, units, self._arrays.spread(bounds or {}, default))
        labels = list(names) if names is not None else [f"u[{i}]" for i in range(self.n)]
        if len(labels) != self.n:
            raise ParameterError(f"names: expected {self.n} names for the components of u, got {len(labels)}")
        self.state_labels = [(label, units.get(label, "")) for label in labels]
        components = {
            label: Observable(label, unit, _component(i), ("u", i), of="state")
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
        ratio = sizes / self.state_scale
        if not np.any(ratio > _NOTHING):  # rest at zero, but for rounding
            return None
        if not (np.any(ratio > _FAR) or (not grow and np.all(ratio < 1.0 / _FAR))):
            return None
        field = copy.copy(self)
        # to two digits: no last bit decides; a component that hardly moves tells nothing
        field.state_scale = np.array([float(f"{max(s, _LEAST * top):.1e}") for s in sizes.tolist()])
        return field

    def start_state(self, keyframe: str | None = None, state: Array | None = None) -> Array:
        """Return the state given, or u0."""
        if keyframe is not None:
            raise unknown_name("keyframe", keyframe, self.keyframes)
        labels = [name for name, _ in self.state_labels]
        return self.u0.copy() if state is None else finite_array("state", state, (self.n,), labels=labels)

    @property
    def evaluations(self) -> int:
        """Evaluations of the function so far, by this thread."""
        return self._f.count

    # -- the problem -----------------------------------------------------------------------------------------

    def residual(self, x: Array, values: Values) -> Array:
        """Return f, (n,); NaN where the function overflows or leaves its domain."""
        return self.rate(x, values, 0.0)

    def rate(self, x: Array, values: Values, time: float) -> Array:
        """Return f at a time, in s, (n,), as `residual`."""
        return self._f.rate(x, values, time)

    def rates(self, states: Array, values: Sequence[Values], times: Sequence[float]) -> Array:
        """Return f at states (m, n), each with its own parameter values and time in s, (m, n), as `rate` does."""
        return self._f.rates(states, values, times)

    def rates_together(self, states: Array, values: Mapping[str, Any], times: float | Array = 0.0) -> Array:
        """Return f at states (m, n) by one call of a vectorized function, (m, n), as `rate` does."""
        return self._f.together(states, values, times)

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x plus each row of `steps`, (m, n)."""
        if self.vectorized and len(steps):
            return self.rates_together(x + steps, values)
        return self.rates(x + steps, [values] * len(steps), [0.0] * len(steps))

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> Linearization:
        """Return f, df/du and df/dp (always by fourth-order differences where no Jacobian is given)."""
        del accurate
        if self.differenced:
            return self.by_one_call(x, values, wrt, ranges)
        f = self.residual(x, values)
        if self.jacobian is not None:
            jac = self._own_jacobian(x, values)
        else:
            steps = jacobian_steps(self.state_scale, FOURTH_ORDER)
            jac = jacobian_from_rows(self.residuals(x, values, steps), self.state_scale, FOURTH_ORDER)
        own, par = self._own_slopes(x, values, wrt), np.empty((self.n, len(wrt)))
        for k, name in enumerate(wrt):
            if name in own:
                par[:, k] = own[name]
                continue
            rule, h = self.parameter_stencil(name, values[name], ranges[k] if ranges else None)
            rows = [self.residual(x, {**values, name: values[name] + o * h}) if o else f for o in rule.offsets]
            par[:, k] = np.asarray(rule.weights) @ np.array(rows) / h
        return Linearization(f, jac, par)

    # -- derivatives of the user's own -------------------------------------------------------------------------

    @property
    def function(self) -> Callable[..., Any]:
        """The user's f, as it was given or as another package's is called."""
        return self._f.function

    @property
    def jacobian(self) -> Callable[..., Any] | None:
        """The user's df/du, as it was given."""
        return self._given.jacobian

    def _own_jacobian(self, x: Array, values: Values) -> Any:
        """Return the user's df/du, NaN where it overflows or leaves its domain."""
        matrix = self._given.matrix(x, self._arrays.seen(values))
        if self._first("jacobian"):
            self._held(x, values).jacobian(matrix)
        return matrix

    def _own_slopes(self, x: Array, values: Values, wrt: Sequence[str]) -> dict[str, Array]:
        """Return df/dp for those parameters for which the user gave it."""
        if self._given.dfdp is None or not wrt:
            return {}
        slopes = self._given.slopes(x, self._arrays.seen(values))
        for name in wrt:
            if name in slopes and self._first(f"dfdp {name}"):
                self._check_slope(x, values, name, slopes[name])
        return slopes

    def derivative_along(self, x: Array, values: Values, *vectors: Array) -> Array | None:
        """Return the derivative of f along one, two or three vectors, (n,), where the user gave it."""
        if len(vectors) == 1:
            return None if self.jacobian is None else self._given.product(x, self._arrays.seen(values), vectors[0])
        found = self._given.form(x, self._arrays.seen(values), *vectors)
        if found is not None and self._first(f"form {len(vectors)}"):
            self._held(x, values).form(len(vectors))
        return found

    @checked
    def check_derivatives(self, u: Any = None, values: Mapping[str, float] | None = None) -> None:
        """Hold every derivative that was given against differences of f: each column and parameter, and two forms.

        At the first point of a curve products alone are looked at, which cost a few evaluations.

        Parameters
        ----------
        u : array_like, (n,), optional
            The state; u0 if it is not given.
        values : mapping of str to float, optional
            Parameter values; the defaults for the others.

        Raises
        ------
        FunctionError
            If an entry is off by more than differences leave open; the message names it, with both values.
        """
        x, p = self.start_state(state=u), self.values(values)
        with np.errstate(all="ignore"):
            held = self._held(x, p)
            if self.jacobian is not None:
                matrix = self._given.matrix(x, held.p)
                for j in range(self.n):
                    held.column(matrix, j)
            for name, slope in (self._given.slopes(x, held.p) if self._given.dfdp is not None else {}).items():
                self._check_slope(x, p, name, slope)
            for order, turn in ((2, 0), (2, 1), (3, 0), (3, 1)):
                held.form(order, turn)

    def _first(self, what: str) -> bool:
        """Whether a derivative is not yet held against differences; it counts as such from now on."""
        first = what not in self._held_against
        self._held_against.add(what)
        return first

    def _held(self, x: Array, values: Values) -> Held:
        labels = [label for label, _ in self.state_labels]
        seen = self._arrays.seen(values)
        return Held(self._given, x, seen, labels, self.state_scale, lambda steps: self.residuals(x, values, steps))

    def _check_slope(self, x: Array, values: Values, name: str, slope: Array) -> None:
        def ray(changes: Array) -> Array:
            rows = [{**values, name: values[name] + float(t)} for t in changes]
            return self.rates(np.tile(x, (len(rows), 1)), rows, [0.0] * len(rows))

        self._held(x, values).slope(name, slope, ray, self.parameter_stencil(name, values[name])[1])

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
    def differenced(self) -> bool:
        """Whether all derivatives are differences of a vectorized function."""
        return self.vectorized and self.jacobian is None and self._given.dfdp is None

    @property
    def own_jacobian(self) -> bool:
        """Whether the user gave one."""
        return self._given.jacobian is not None

    # -- observables -----------------------------------------------------------------------------------------

    @checked
    def observe(self, name: str, function: Callable[[Array, Values], float], unit: str = "") -> None:
        """Add an observable computed by `function(u, p)`."""
        seen = self._arrays.seen
        self.observables[name] = own_observable(
            name, unit, lambda values, x: function(x, seen(values)), self.parameters
        )

    def measure(self, states: Array, values: Sequence[Values] | Values, names: Sequence[str] | None = None) -> Array:
        """Return observables for states (m, n), shape (m, number of names)."""
        chosen = [self.observable(n) for n in (names if names is not None else self.observables)]
        found = np.empty((len(states), len(chosen)))
        per_row = [values] * len(states) if isinstance(values, Mapping) else values
        for k, o in enumerate(chosen):
            own = [] if o.source else [_measured(o, v, x) for x, v in zip(states, per_row, strict=True)]
            found[:, k] = states[:, o.source[1]] if o.source else own
        return found

    def measure_along(self, states: Array, values: Values, driven: Mapping[str, Array]) -> Array:
        """Return all observables for states (m, n), parameters having values of their own in each (m,), by name."""
        if all(o.source is not None for o in self.observables.values()):  # no parameter counts
            return self.measure(states, values)
        return super().measure_along(states, values, driven)

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
        raise raised(f"observable '{observable.name}'", error) from error


def _component(i: int) -> Callable[[Any, Any], float]:
    return lambda values, x: float(x[i])
