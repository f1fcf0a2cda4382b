"""Points and special points of curves, named columns, and values as they are shown. Immutable once made."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import name_of
from mjcont.results.model import Model, model_of
from mjcont.results.quantities import check_name, column_of
from mjcont.results.text import Shown
from mjcont.results.units import displayed, sized

# observables that a summary line shows; all are in the columns
_SHOWN = 5
# what rounding leaves of an angle or a length, and of anything else, is shown as 0
_NOTHING, _TINY = 1e-13, 1e-30


def show(value: float, unit: str, digits: int = 7) -> str:
    """Return a value with its unit; radians in degrees, and kN, MN or mm where digits alone would take an exponent."""
    value = 0.0 if abs(value) < (_NOTHING if unit in ("rad", "m") else _TINY) else value
    shown, factor = displayed(unit)
    text = f"{value * factor:.{digits}g}"
    if "e" in text:
        shown, larger = sized(shown, abs(value))
        text = f"{value * factor * larger:.{digits}g}"
    return f"{text} {shown}".rstrip().removesuffix(" 1")


@dataclass(frozen=True, slots=True, repr=False)
class Point(Shown):
    """One equilibrium.

    Attributes
    ----------
    parameters, observables : mappings of name to value, SI and radians.
    state : (nq,) array; a VectorField's u.
    eigenvalues : complex array, in 1/s.
    stability : "stable", "unstable" or "marginal".
    n_unstable : number of eigenvalues with positive real part; at a special point, beside those held on the axis.
    problem : the Mechanism or VectorField.
    units : mapping of name to unit, for parameters and observables.
    doubt : what is not known of its stability, a sentence; empty where all is known.
    """

    parameters: Mapping[str, float]
    observables: Mapping[str, float]
    state: Array
    eigenvalues: Array
    stability: str
    n_unstable: int
    problem: Model | None = field(repr=False)
    units: Mapping[str, str] = field(repr=False, default_factory=dict)
    doubt: str = ""

    def __getitem__(self, name: str) -> float:
        """Return a parameter's or observable's value."""
        check_name(name)
        if name in self.parameters:
            return self.parameters[name]
        if (own := column_of(name, self.observables)) is not None:
            return self.observables[own]
        raise unknown_name("parameter or observable", name, [*self.parameters, *self.observables])

    @property
    def model(self) -> Model:
        """The problem; an MjcontError where the point was loaded from a file without it."""
        return model_of(self.problem, "the point")

    def __str__(self) -> str:
        """Return stability and observables."""
        shown = ", ".join(f"{k} = {show(v, self.units.get(k, ''))}" for k, v in self.observables.items())
        return f"{self.stability} ({self.n_unstable} unstable): {shown}" + (f" ({self.doubt})" if self.doubt else "")


@dataclass(frozen=True, slots=True, repr=False)
class SpecialPoint(Point):
    """A located special point.

    Attributes
    ----------
    kind, label : such as "LP" and "LP1".
    index : row of the branch that holds it.
    tolerance : the last Newton step on its defining system, or the noise of that, in scaled unknowns.
    converged : False for a guess from its bracket.
    coefficients : normal-form coefficients by name.
    vectors : null vectors by name, in physical units.
    note : a sentence, where there is something to say.
    free : the free parameters of the curve it was found on, with their bounds.
    curve : the kind of that curve.
    """

    kind: str = ""
    label: str = ""
    index: int = 0
    tolerance: float = math.nan
    converged: bool = True
    coefficients: Mapping[str, Any] = field(default_factory=dict)
    vectors: Mapping[str, Array] = field(default_factory=dict, repr=False)
    note: str = ""
    free: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    curve: str = "equilibria"

    def __str__(self) -> str:
        """Return kind, parameters, observables, coefficients and the tolerance reached."""
        head = f"{self.label} ({name_of(self.kind)})"
        names = [*self.free, *list(self.observables)[:_SHOWN]]
        shown = ", ".join(f"{n} = {show(self[n], self.units.get(n, ''))}" for n in names)
        extra = "".join(f", {k} = {_short(v)}" for k, v in self.coefficients.items())
        state = f"located to {self.tolerance:.1e}" if self.converged else "not converged: a guess"
        return f"{head}: {shown}{extra}; {state}" + (f" ({self.note})" if self.note else "")


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


@dataclass(frozen=True, slots=True)
class Column:
    """A named column of a branch: its unit, whether parameter or observable, and its values."""

    name: str
    unit: str
    role: str
    values: Array


@dataclass(frozen=True, slots=True)
class Mark:
    """What makes a row of a branch a special point; the attributes are those of `SpecialPoint`."""

    kind: str
    label: str
    index: int
    tolerance: float
    converged: bool = True
    coefficients: Mapping[str, Any] = field(default_factory=dict)
    vectors: Mapping[str, Array] = field(default_factory=dict, repr=False)
    note: str = ""

    def on(self, row: Point, free: Mapping[str, tuple[float, float]], curve: str) -> SpecialPoint:
        """Return the special point that a row is, on a kind of curve in parameters that are free."""
        seen, own = ({f.name: getattr(x, f.name) for f in fields(x)} for x in (row, self))
        return SpecialPoint(**seen, **own, free=free, curve=curve)
