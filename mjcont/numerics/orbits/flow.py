"""What collocation asks of a problem in motion: u' = f(u, t, p), or q'' = a(q, v, t, p), t = tau T."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from mjcont.numerics.equations.problem import Array, Range, Ranges, Stencil, Values, Varied
from mjcont.numerics.orbits.path import Path


@dataclass(frozen=True, slots=True)
class Rates:
    """Rates and their derivatives at states (m, d).

    Attributes
    ----------
    value : (m, c) the highest derivatives: u', or q''.
    jac : (m, c, d) over the state.
    par : (m, c, k) over the k parameters asked for, at a fixed phase.
    """

    value: Array
    jac: Array
    par: Array


class Flow(ABC):
    """Base class for motions of which periodic ones are sought.

    To implement one:

    1. Set the attributes; a state is u (d = c), or (q, v) one after the other (d = 2 c) where `order` is 2.
    2. `rates` and `derivatives` take many states side by side, each with its own phase tau = t / T. Return NaN where
       there is no value; never raise for it. Count every evaluation.
    3. A forced motion has a `period` that its parameters tell; otherwise it is unknown, and phases mean nothing.

    Attributes
    ----------
    order : 1 or 2.
    c : number of coordinates.
    forced : whether the period is known.
    scale : (d,) typical sizes of the state's entries.
    """

    order: int
    c: int
    forced: bool
    scale: Array

    @property
    def d(self) -> int:
        """Number of entries of a state."""
        return self.order * self.c

    @property
    @abstractmethod
    def evaluations(self) -> int:
        """Number of evaluations so far."""

    @abstractmethod
    def rates(self, states: Array, phases: Array, values: Values) -> Array:
        """Return the highest derivatives at states (m, d) and phases (m,), shape (m, c)."""

    @abstractmethod
    def derivatives(
        self, states: Array, phases: Array, values: Values, wrt: Sequence[str], accurate: bool, ranges: Ranges = ()
    ) -> Rates:
        """Return the rates with their derivatives; `accurate` asks for what locating special points needs."""

    @abstractmethod
    def parameter(self, name: str) -> Varied:
        """Return a parameter by its name."""

    @abstractmethod
    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""

    @abstractmethod
    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""

    def period(self, values: Values) -> float:
        """Return the period of a forced motion."""
        raise NotImplementedError

    def period_rate(self, values: Values, name: str) -> float:
        """Return the derivative of the period of a forced motion in a parameter."""
        del values, name
        return 0.0

    def centred(self, path: Path) -> Flow:
        """Return the same motion in coordinates that suit an orbit better, or itself where its own ones do."""
        del path
        return self

    def taken(self, path: Path, flow: Flow) -> Path:
        """Return an orbit in the coordinates of `flow`, the same motion in others, as one in these."""
        del flow
        return path

    def shown(self, state: Array) -> Array:
        """Return a state (d,) in coordinates that a user knows."""
        return state

    @property
    def failure(self) -> str:
        """Why there was no value where it was evaluated last, a clause; empty where nothing is known."""
        return ""

    @property
    def touches(self) -> str:
        """What a motion touched last that it is not smooth at, a clause; empty where it touched nothing."""
        return ""
