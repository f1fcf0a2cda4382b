"""A model: equations whose parameters, observables and states have names. A Mechanism and a VectorField are models."""

from __future__ import annotations

import hashlib
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from functools import cache
from html import escape
from importlib import metadata
from typing import Any, Protocol, Self

import numpy as np

from mjcont.errors import BoundsError, MjcontError, RangeWarning, unknown_name, warn
from mjcont.numerics.equations.problem import Array, Equations, Values
from mjcont.results.quantities import Observable, Parameter, check_name, column_of, finite_pair

# what numerics and verbs ask of a model, and no user needs
NOT_FOR_USERS = frozenset(
    """
    active admissible connections constrained coordinates declare_again
    by_one_call derivative_along difference_each differenced failure first_order follows_scale held holding
    holds_straight left_forces linearize_along measure_along nonsmooth one_pattern own_jacobian parameter_stencil
    passive pencils periods pieces rates_together rescaled residuals residuals_along retract_each rigid_directions
    rigid_modes second_order side_by_side timed together typical variants vectorized writer
    """.split()
)


class Model(Equations):
    """Base class for problems that verbs take and results remember.

    To implement one, follow the steps of `Equations`, and these:

    1. Set the attributes below in the constructor; `parameters` and `observables` may gain entries later.
    2. Implement the abstract methods.
    3. Where observables of many states that differ in a parameter are read side by side, override `measure_along`.

    Attributes
    ----------
    name : what messages and plots call it.
    parameters, observables : mappings of name to Parameter and Observable.
    state_labels : name and unit of each entry of the state.
    keyframes : mapping of name to state (nq,).
    mjcf : its MJCF text, which results carry, or None.
    declared : parameters declared in Python, as results store them.
    constrained : whether springs stand for constraints, of which results carry notes.
    follows_scale : whether its `typical` sizes were not given, so that curves tell it (see `rescaled`).
    """

    name: str
    parameters: dict[str, Parameter]
    observables: dict[str, Observable]
    keyframes: dict[str, Array]
    mjcf: str | None = None
    declared: Mapping[str, Any] = {}
    constrained: bool = False
    follows_scale: bool = False

    @property
    @abstractmethod
    def state_labels(self) -> list[tuple[str, str]]:
        """Name and unit of each entry of the state."""

    @abstractmethod
    def start_state(self, keyframe: str | None = None, state: Any = None) -> Array:
        """Return the state given, or a keyframe's, or the model's own, (nq,)."""

    @abstractmethod
    def measure(self, states: Array, values: Sequence[Values] | Values, names: Sequence[str] | None = None) -> Array:
        """Return observables, by default all, for states (m, nq), shape (m, number of names)."""

    def measure_along(self, states: Array, values: Values, driven: Mapping[str, Array]) -> Array:
        """Return all observables for states (m, nq), parameters having values of their own in each (m,), by name."""
        rows = [{**values, **{n: float(column[i]) for n, column in driven.items()}} for i in range(len(states))]
        return self.measure(states, rows)

    @property
    def coordinates(self) -> list[tuple[str, str]]:
        """Name and unit of each tangent coordinate, (n,)."""
        return self.state_labels

    def connections(self, x: Array, values: Values) -> Array:
        """Return gradients (r, n), a row for everything that yields to carry load in a state, such as a bush."""
        del x, values
        return np.zeros((0, self.n))

    def rescaled(self, sizes: Array, *, grow: bool = False) -> Self | None:
        """Return this model with a scale that fits sizes of its state (n,); None where it fits or was given.

        With `grow` a scale only becomes larger: what is seen at one point is no more than a part.
        """
        del sizes, grow
        return None

    def __dir__(self) -> list[str]:
        """List what a user may use; the rest of the public methods is what the numerics ask for."""
        return sorted(set(super().__dir__()) - NOT_FOR_USERS)

    def _repr_html_(self) -> str:
        """Return the summary as a notebook shows it."""
        return f"<pre>{escape(str(self))}</pre>"

    def parameter(self, name: str) -> Parameter:
        """Return the parameter called `name`."""
        check_name(name)
        if name not in self.parameters:
            raise unknown_name("parameter", name, self.parameters)
        return self.parameters[name]

    def observable(self, name: str) -> Observable:
        """Return the observable called `name`; a parameter may have the same name (see `told_apart`)."""
        own = column_of(name, self.observables)
        if own is None:
            raise unknown_name("observable", name, self.observables)
        return self.observables[own]


def model_of(problem: Equations | None, what: str = "the point") -> Model:
    """Return the model that a result or a system belongs to.

    Raises
    ------
    MjcontError
        If there is none: the result was loaded from a file without its problem.
    """
    if problem is None:
        raise MjcontError(f"{what} was loaded without its problem: mc.load(path, problem=...)")
    assert isinstance(problem, Model)
    return problem


def units(problem: Model) -> dict[str, str]:
    """Return the units of all parameters and observables."""
    found = {p.name: p.unit for p in problem.parameters.values()}
    return found | {o.name: o.unit for o in problem.observables.values()}


class Parametrised(Protocol):
    """What has named parameters: a model, or a motion of one."""

    def parameter(self, name: str) -> Parameter:
        """Return a parameter by its name."""
        ...


class Valued(Parametrised, Protocol):
    """The same, with a value for each of them."""

    def values(self, given: Mapping[str, float] | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""
        ...


def check_bounds(problem: Parametrised, name: str, bounds: tuple[float, float] | None) -> tuple[float, float]:
    """Return the bounds of a parameter: those given, or its own.

    Raises
    ------
    BoundsError
        If they are not two increasing finite numbers, or lie outside a control's range.
    """
    parameter = problem.parameter(name)
    if parameter.kind == "switch":
        raise BoundsError(f"'{name}' is a switch, 0 or 1, and cannot vary along a curve: give it as a start value")
    if bounds is None:
        own, hard = parameter.bounds, parameter.hard_bounds
        return finite_pair(f"bounds of {name}", (max(own[0], hard[0]), min(own[1], hard[1])))
    low, high = finite_pair(f"bounds of {name}", bounds)
    hard_low, hard_high = parameter.hard_bounds
    if low < hard_low or high > hard_high:
        raise BoundsError(
            f"bounds ({low:g}, {high:g}) of {name} leave {parameter.limits}: narrow the bounds"
            + ("" if parameter.springs else " or widen the range in the XML")
        )
    warn_outside(problem, {name: (low, high)})
    return low, high


def warn_outside(problem: Parametrised, given: Mapping[str, Sequence[float] | float]) -> None:
    """Give a RangeWarning for each value outside the range that its parameter declares."""
    for name, values in given.items():
        said = problem.parameter(name).outside(*(values if isinstance(values, Sequence) else (values,)))
        if said:
            warn(said, RangeWarning)


@cache
def _versions() -> tuple[tuple[str, str], ...]:
    """Return the versions of what results depend on."""
    found = [(name, metadata.version(name)) for name in ("mujoco", "numpy", "scipy")]
    try:
        return (*found, ("mjcont", metadata.version("mjcont")))
    except metadata.PackageNotFoundError:
        return (*found, ("mjcont", "not installed"))


def provenance(problem: Model | None) -> dict[str, str]:
    """Return versions and the model's hash."""
    versions = dict(_versions())
    if problem is not None and problem.mjcf is not None:
        versions["model_sha256"] = hashlib.sha256(problem.mjcf.encode()).hexdigest()
    return versions
