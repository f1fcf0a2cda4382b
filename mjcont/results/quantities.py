"""What parameters and observables are, apart from any model: names, units, values, and what they act on."""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from mjcont.errors import BoundsError, NameLookupError, ParameterError
from mjcont.results.units import displayed, mistaken

Given = TypeVar("Given")
FRICTION = ("frictionless", "refuse")
# products of a few larger numbers overflow
LARGEST = 1e100

# fields in which the forces are affine, so that two points give an exact derivative
_AFFINE = frozenset(
    {
        "ctrl",
        "act",
        "jnt_stiffness",
        "dof_damping",
        "qpos_spring",
        "tendon_stiffness",
        "tendon_damping",
        "actuator_biasprm",
        "actuator_gainprm",
    }
)
_PRODUCTS = ({"jnt_stiffness", "qpos_spring"}, {"ctrl", "actuator_gainprm"}, {"act", "actuator_gainprm"})


@dataclass(frozen=True, slots=True)
class Target:
    """Entries `index` of the flattened model field `field`, set to scale * (offset + factor * value)^power.

    `derives` says whether MuJoCo must recompute derived constants when they change, `loaded` what offset + factor *
    value is in the loaded model where the entries do not tell.
    """

    field: str
    index: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0
    path: str = ""
    derives: bool = False
    scale: float = 1.0
    power: float = 1.0
    loaded: float | None = None
    unit: str = ""

    def entry(self, value: float) -> float:
        """Return what the entries are at a parameter's value."""
        plain = self.offset + self.factor * value
        if self.loaded is None:
            return plain
        # a prediction may leave the domain: forces that are no number fail its step
        return self.scale * plain**self.power if plain > 0 else math.nan


def far_angle(name: str, unit: str, *values: float) -> str:
    """Return a sentence about the first angle beyond a turn, likely one in degrees; empty if there is none."""
    turn = 2.0 * math.pi
    far = next((v for v in values if unit == "rad" and abs(v) > turn * (1.0 + 1e-9)), None)
    return "" if far is None else _outside(name, unit, far, -turn, turn, "a turn")


def _outside(name: str, unit: str, value: float, low: float, high: float, what: str) -> str:
    """Return the sentence that a value lies outside a range, and what may have been meant."""
    shown_in, factor = displayed(unit)
    shown, start, end = (f"{v * factor:.7g} {shown_in}".rstrip() for v in (value, low, high))
    hint = mistaken(value, unit, low, high)
    return f"{name} = {shown} lies outside {what}, {start} to {end}" + (f': did you mean "{hint}"?' if hint else "")


@dataclass(frozen=True, slots=True)
class Parameter:
    """A named scalar that acts on the model.

    Attributes
    ----------
    name, unit : str
    value : float
        Its value in the loaded model (SI, radians).
    bounds : tuple of float
        Where the parameter makes sense; the default range of a continuation.
    kind : {"control", "input", "switch", "gravity", "field", "spec"}
        A control; another input that lives in MuJoCo's data (an integrated setpoint, a mocap pose); equality
        constraints on or off; gravity; a field of the model; or geometry, by an edit of the model's spec.
    targets : tuple of Target
        Empty for gravity_angle and load_factor, which act together on the gravity vector, and for "spec".
    hard_bounds : tuple of float
        Outside this range there is no such model, or MuJoCo would take another value.
    limit : str
        The words for that range, {range} in the place of its numbers.
    edit : callable, optional
        Of kind "spec": writes a value into a copy of the model's spec, which is then compiled.
    source : str
        Of kind "spec": its paths, or its function's name.
    is_function : bool
        Whether `edit` is a user's function, not made from paths.
    touched : frozenset
        Of kind "spec": the entries of the compiled model that change with it.
    """

    name: str
    unit: str
    value: float
    bounds: tuple[float, float]
    kind: str
    targets: tuple[Target, ...] = ()
    hard_bounds: tuple[float, float] = (-math.inf, math.inf)
    limit: str = ""
    edit: Callable[[Any, float], None] | None = None
    source: str = ""
    is_function: bool = False
    touched: frozenset[tuple[str, int]] = frozenset()

    @property
    def cost(self) -> str:
        """What a change of value costs: "nothing", "field", "field + constants" or "recompile"."""
        if self.kind == "spec":
            return "recompile"
        if self.kind in ("control", "input", "switch"):
            return "nothing"
        return "field + constants" if self.needs_constants else "field"

    @property
    def acts_on(self) -> str:
        """What it acts on, in words or as paths."""
        if self.kind in ("control", "gravity"):
            return self.kind
        return self.source or " ".join(t.path for t in self.targets)

    @property
    def limits(self) -> str:
        """The hard bounds in words."""
        if self.springs:
            return "the positive numbers, where a constraint is a spring"
        low, high = self.hard_bounds
        return self.limit.format(range=f"[{low:g}, {high:g}]")

    @property
    def springs(self) -> bool:
        """Whether it sets the stiffness of constraints."""
        return any(t.loaded is not None for t in self.targets)

    @property
    def affine(self) -> bool:
        """Whether the generalised forces are affine in the parameter."""
        fields = {t.field for t in self.targets if t.loaded is None}
        if self.springs and not fields:
            return True
        return bool(fields) and fields <= _AFFINE and not any(pair <= fields for pair in _PRODUCTS)

    @property
    def entries(self) -> frozenset[tuple[str, int]]:
        """The entries of model fields on which it acts."""
        if self.kind == "gravity":
            return frozenset({("opt.gravity", i) for i in range(3)})
        if self.kind == "spec":
            return self.touched
        found = {(t.field, i) for t in self.targets for i in t.index}
        scaled = {("body_inertia", 3 * i + k) for field, i in found if field == "body_mass" for k in range(3)}
        return frozenset(found | scaled)

    def check(self, value: float) -> None:
        """Raise unless the model can have this value: ParameterError, or BoundsError where MuJoCo would clamp it."""
        value = finite(f"parameter '{self.name}': the value", value)
        if self.kind == "switch" and value not in (0.0, 1.0):
            raise ParameterError(f"parameter '{self.name}' is a switch: its value must be 0 or 1, got {value:g}")
        low, high = self.hard_bounds
        if not low <= value <= high:
            raise BoundsError(f"{self.name} = {value:g} lies outside {self.limits}")

    def outside(self, *values: float) -> str:
        """Return a sentence about the first value that leaves the range that the parameter declares; empty if none.

        A range that nobody declared says nothing, but of an angle: beyond a turn it is likely one in degrees.
        """
        low, high = self.bounds
        guesses = (default_bounds(self.value, self.unit), default_bounds(self.value))
        stated = self.kind not in ("switch", "gravity") and not self.springs and self.bounds not in guesses
        if not stated:
            return far_angle(self.name, self.unit, *values)
        slack = 1e-9 * max(abs(low), abs(high))
        far = next((v for v in values if not low - slack <= v <= high + slack), None)
        if far is None:
            return ""
        return _outside(self.name, self.unit, far, low, high, "its range")

    @property
    def needs_constants(self) -> bool:
        """Whether MuJoCo must recompute derived constants when the parameter changes."""
        return any(t.derives for t in self.targets)


@dataclass(frozen=True, slots=True)
class Observable:
    """A named scalar read from a state: `function(model, data)` for a Mechanism, in `unit`.

    `source` is the field of MuJoCo's data, or the state of a plain field, and the entry in it, where the observable is
    no more than that, `of` what it belongs to, one of `OWNERS`.
    """

    name: str
    unit: str
    function: Callable[[Any, Any], float]
    source: tuple[str, int] | None = None
    of: str = ""


# Two names that are one: an actuator is often called like its joint. The parameter keeps the bare name, the observable
# is `joint:NAME` (`sensor:NAME`, `state:NAME`). Where the parameter has no column, the bare name means the observable.
OWNERS = ("sensor", "joint", "state")


def told_apart(observables: Mapping[str, Observable], taken: Container[str]) -> dict[str, Observable]:
    """Return observables under names of their own: one that is called like a parameter says what it belongs to."""
    own = [replace(o, name=f"{o.of}:{n}") if n in taken and o.of else o for n, o in observables.items()]
    return {o.name: o for o in own}


def own_observable(
    name: str, unit: str, function: Callable[[Any, Any], float], taken: Container[str]
) -> Observable:
    """Return an observable of a user's own; ParameterError if a parameter has its name."""
    if name in taken:
        raise ParameterError(f"observable '{name}': a parameter has this name; choose another")
    return Observable(name, unit, function)


def column_of(name: str, columns: Container[str]) -> str | None:
    """Return the one of `columns` that a name means, None if it means none."""
    check_name(name)
    return next((n for n in (name, *(f"{owner}:{name}" for owner in OWNERS)) if n in columns), None)


def check_values(given: object) -> None:
    """Raise a ParameterError unless parameter values are given by names."""
    if not isinstance(given, Mapping):
        raise ParameterError(f'parameter values are a dict such as {{"F": 20.0}}, got a {type(given).__name__}')


def check_name(name: object) -> None:
    """Raise a NameLookupError unless a name is a string."""
    if not isinstance(name, str):
        raise NameLookupError(f'a name is a string such as "F", got the {type(name).__name__} {str(name):.40}')


def meant(name: str, varying: Container[str], observables: Container[str]) -> str:
    """Return the column that a name means along a curve in the parameters `varying`."""
    return name if name in varying else column_of(name, observables) or name


def meant_each(given: Mapping[str, Given] | None, varying: Container[str], observables: Container[str]) -> (
    dict[str, Given]
):
    """Return what is given by names, by the columns that they mean; nothing for None."""
    return {meant(name, varying, observables): entry for name, entry in (given or {}).items()}


def finite(what: str, value: Any) -> float:
    """Return a number as a float; ParameterError unless it is one with which one can compute. `what` begins it."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not abs(number) <= LARGEST:
        size = f", larger than {LARGEST:g} (products of such numbers overflow)" if math.isfinite(number) else ""
        raise ParameterError(f"{what} must be a finite number, got {value}{size}")
    return number


def finite_array(
    what: str, value: Any, shape: tuple[int, ...], *, labels: Sequence[str] = (), owner: str = ""
) -> np.ndarray:
    """Return an array of a shape as floats; ParameterError unless one can compute with all its numbers.

    `labels` name its entries, and `owner` says what it belongs to, a clause.
    """
    try:
        found = np.array(value, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        raise ParameterError(f"{what} must be an array of numbers: {error}") from error
    if found.shape != shape:
        single = found.ndim == 0 and len(shape) == 1
        more = f": a number for each entry, such as np.full({shape[0]}, {found:g})" if single else ""
        raise ParameterError(f"{what} must have shape {shape}{owner and ' ' + owner}, got {found.shape}{more}")
    for label, number in zip(labels, found.tolist(), strict=False):
        finite(f"{what}: {label}", number)
    if not (np.abs(found) <= LARGEST).all():
        raise ParameterError(f"{what} must hold finite numbers within +-{LARGEST:g}, got {found}")
    return found


def finite_pair(what: str, bounds: Any) -> tuple[float, float]:
    """Return two numbers low < high with which one can compute; BoundsError otherwise."""
    try:
        low, high = (float(b) for b in bounds)
    except (TypeError, ValueError, OverflowError) as error:
        raise BoundsError(f"{what} must be two numbers (low, high), got {bounds!r}") from error
    if not -LARGEST <= low < high <= LARGEST:
        raise BoundsError(f"{what} must be finite with low < high, within +-{LARGEST:g}, got ({low:g}, {high:g})")
    return low, high


def default_bounds(value: float, unit: str = "") -> tuple[float, float]:
    """Return a range for a parameter that states none: a decade around a positive value."""
    if unit == "rad":
        return (-math.pi, math.pi)
    if value > 0:
        return (0.1 * value, 10.0 * value)
    return (-1.0, 1.0) if value == 0 else (10.0 * value, 0.1 * value)
