"""The protocol that a Mechanism and a VectorField both satisfy, and what they return.

An equilibrium problem is f(x, p) = 0, with x on a manifold of tangent dimension n and p named scalars. Its
motion is governed near an equilibrium by the quadratic pencil

    P(s) = s^2 M + s C + K,   K = -df/dx,

where a first-order system x' = f has M = 0 and C = I. Everything in `mjcont.numerics` is written for this
protocol; it never imports MuJoCo.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

Array = np.ndarray
Values = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Linearization:
    """f and its derivatives at one point.

    Attributes
    ----------
    f : (n,) residual.
    jac : (n, n) df/dx, dense or scipy.sparse.
    par : (n, k) df/dp for the k parameters asked for.
    piece : the smooth piece of f on which the point lies.
    """

    f: Array
    jac: Any
    par: Array
    piece: bytes = b""


@dataclass(frozen=True, slots=True)
class Pencil:
    """Matrices of s^2 M + s C + K at one equilibrium; `mass` is None for a first-order system (then C = I)."""

    mass: Array | None
    damping: Array | None
    stiffness: Any


class Problem(Protocol):
    """What the numerics need to know of a problem.

    Attributes
    ----------
    n : tangent dimension of the state.
    second_order : whether the pencil has a mass matrix.
    state_scale : (n,) typical size of each tangent coordinate, for arclength and difference steps.
    evaluations : number of evaluations of f so far (every row of a batch counts as one).
    """

    n: int
    second_order: bool
    state_scale: Array
    evaluations: int

    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""
        ...

    def residual(self, x: Array, values: Values) -> Array:
        """Return f, (n,)."""
        ...

    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x moved by each row of `steps` (m, n), shape (m, n)."""
        ...

    def residuals_along(self, states: Array, values: Values, name: str, column: Array) -> Array:
        """Return f at states (m, nq), a parameter having a value of its own in each (m,), shape (m, n)."""
        ...

    def linearize_along(
        self, states: Array, values: Values, name: str, column: Array
    ) -> tuple[Array, Array, Array] | None:
        """Return f (m, n), df/dx (m, n, n) and df/dp (m, n) at such states; None where side by side gains nothing."""
        ...

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, spans: Sequence[float] = ()
    ) -> Linearization:
        """Return f, df/dx and df/dp; `accurate` asks for the error that locating special points needs.

        `spans` are the widths of the ranges in which the parameters `wrt` move, for difference steps where a value
        is near zero.
        """
        ...

    def parameter_stencil(self, name: str, value: float, span: float | None = None) -> tuple[Any, float]:
        """Return the difference rule (see `differences.Stencil`) and step for derivatives in a parameter."""
        ...

    def pencil(self, x: Array, values: Values, jac: Any) -> Pencil:
        """Return the matrices whose eigenvalues tell stability; `jac` is df/dx there."""
        ...

    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the right-hand side of the first-order form at steps (m, N) of its state, shape (m, N)."""
        ...

    def retract(self, x: Array, step: Array) -> Array:
        """Return x moved by a tangent step (n,)."""
        ...

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return states (m, nq), or one (nq,), moved by the rows of tangent steps (m, n)."""
        ...

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return the tangent steps (m, n) that take states (m, nq), or one (nq,), to others."""
        ...

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step (n,) that takes x0 to x1."""
        ...

