"""The contract of a problem: what numerics ask of equations f(x, p) = 0, and what they are given.

The state x lies on a manifold of tangent dimension n, and p are named scalars. Motion near an equilibrium is governed
by the quadratic pencil

    P(s) = s^2 M + s C + K,   K = -df/dx,

where a first-order system x' = f has M = 0 and C = I. Everything in `mjcont.numerics` is written for `Equations`, and
nothing there asks a problem for more.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]
# a matrix as LAPACK or SuperLU takes it: (n, n) array or scipy.sparse, which has no types
Matrix: TypeAlias = Any
Values = Mapping[str, float]
Range = tuple[float, float]
Ranges = Sequence[Range | None]


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
    jac: Matrix
    par: Array
    piece: bytes = b""


@dataclass(frozen=True, slots=True)
class Pencil:
    """Matrices of s^2 M + s C + K at one equilibrium; `mass` is None for a first-order system (then C = I)."""

    mass: Array | None
    damping: Array | None
    stiffness: Matrix


@dataclass(frozen=True, slots=True)
class Stencil:
    """A first derivative: sum(weights * f(x + offsets * step)) / step."""

    offsets: tuple[float, ...]
    weights: tuple[float, ...]
    step: float


class Varied(Protocol):
    """What numerics know of a parameter: where it may be moved, and whether f is affine in it."""

    @property
    def bounds(self) -> Range:
        """Where it makes sense."""
        ...

    @property
    def hard_bounds(self) -> Range:
        """Outside this range f is not defined."""
        ...

    @property
    def affine(self) -> bool:
        """Whether f is affine in it."""
        ...


class Variants(ABC):
    """f of several variants of a problem, each with parameter values of its own: many states of many in one call."""

    @abstractmethod
    def residuals(self, chosen: Array, states: Array, columns: Array) -> Array:
        """Return f of the variants `chosen` (K,), each once, at states (K, m, nq), shape (K, m, n).

        The parameters that the variants were made for have values of their own in every state, `columns` (K, m, k).
        What is found for a variant does not depend on which others are asked for. NaN where f has no value.
        """


class OneByOne(Variants):
    """Variants that are evaluated one after the other, whatever the problem."""

    def __init__(self, problem: Equations, values: Sequence[Values], names: Sequence[str]) -> None:
        self._problem, self._values, self._names = problem, values, tuple(names)

    def residuals(self, chosen: Array, states: Array, columns: Array) -> Array:
        """Return f of the variants chosen."""
        found = np.empty((*states.shape[:2], self._problem.n))
        for k, variant in enumerate(chosen.tolist()):
            for i, x in enumerate(states[k]):
                own = dict(zip(self._names, columns[k, i].tolist(), strict=True))
                found[k, i] = self._problem.residual(x, {**self._values[variant], **own})
        return found


class Equations(ABC):
    """Base class for problems f(x, p) = 0.

    To implement one, follow these steps:

    1. Set the attributes below in the constructor. `n` and `state_scale` never change afterwards.
    2. Implement the abstract methods. States are arrays (nq,), where nq may exceed n on a curved manifold; steps are
       tangent vectors (n,) in physical units. No argument is written to, and what is returned is the caller's own.
    3. Where f has no value return NaN, and say why in `failure` until the next evaluation; never raise for it.
    4. Count every evaluation of f in `evaluations`, each row of a batch as one.
    5. On a curved manifold override `retract`, `difference`, `retract_each` and `difference_each`, together.
    6. Override capabilities only where they hold; each default says what the numerics do without it:

       - `passive` (and `pencils`): stability by the inertia of K, eigenvalues when they are read;
       - `one_pattern`: a sparse df/dx is extrapolated to the next point;
       - `side_by_side`, `linearize_along`: long steps with points inside, rows between points;
       - `together` and `variants`: points of variants are corrected side by side;
       - `nonsmooth`, `pieces` and `active`: corners are found and crossed;
       - `periods`: curves that close full turns apart end there;
       - `admissible`: predictions leave out motions that the problem holds;
       - `derivative_along`: derivatives along vectors are those, not differences of f.

    Attributes
    ----------
    n : tangent dimension of the state.
    second_order : whether the pencil has a mass matrix.
    state_scale : (n,) typical size of each tangent coordinate, for arclength and difference steps.
    """

    n: int
    second_order: bool
    state_scale: Array

    # -- what must be there ----------------------------------------------------------------------------------

    @property
    @abstractmethod
    def evaluations(self) -> int:
        """Number of evaluations of f so far (every row of a batch counts as one)."""

    @abstractmethod
    def parameter(self, name: str) -> Varied:
        """Return a parameter by its name."""

    @abstractmethod
    def values(self, given: Values | None = None) -> dict[str, float]:
        """Return a value for every parameter: those given, the defaults for the others."""

    @abstractmethod
    def residual(self, x: Array, values: Values) -> Array:
        """Return f, (n,)."""

    @abstractmethod
    def residuals(self, x: Array, values: Values, steps: Array) -> Array:
        """Return f at x moved by each row of `steps` (m, n), shape (m, n)."""

    @abstractmethod
    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> Linearization:
        """Return f, df/dx and df/dp; `accurate` asks for the error that locating special points needs.

        `ranges` are those in which the parameters `wrt` move: differences do not leave them, and their widths tell
        the steps where a value is near zero.
        """

    @abstractmethod
    def parameter_stencil(self, name: str, value: float, bounds: Range | None = None) -> tuple[Stencil, float]:
        """Return the difference rule and step for derivatives in a parameter."""

    @abstractmethod
    def pencil(self, x: Array, values: Values, jac: Matrix) -> Pencil:
        """Return the matrices whose eigenvalues tell stability; `jac` is df/dx there."""

    @abstractmethod
    def first_order(self, x: Array, values: Values, steps: Array) -> Array:
        """Return the right-hand side of the first-order form at steps (m, N) of its state, shape (m, N)."""

    # -- the manifold: flat unless it says otherwise -----------------------------------------------------------

    def retract(self, x: Array, step: Array) -> Array:
        """Return x moved by a tangent step (n,)."""
        return x + step

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return states (m, nq), or one (nq,), moved by the rows of tangent steps (m, n)."""
        return states + steps

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step (n,) that takes x0 to x1."""
        return x1 - x0

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return the tangent steps (m, n) that take states (m, nq), or one (nq,), to others."""
        return ends - starts

    # -- capabilities, with what holds without them --------------------------------------------------------------

    @property
    def passive(self) -> bool:
        """Whether damping is symmetric and semidefinite in every state, so that the inertia of K tells stability."""
        return False

    @property
    def one_pattern(self) -> bool:
        """Whether a sparse df/dx has the same entries everywhere, so that it is extrapolated along a curve."""
        return False

    @property
    def nonsmooth(self) -> bool:
        """Whether f is smooth in pieces only."""
        return False

    @property
    def pieces(self) -> Sequence[bytes]:
        """On which smooth piece of f each row of the last evaluation lies; empty where f is smooth."""
        return ()

    @property
    def failure(self) -> str:
        """Why f had no value where it was evaluated last, a clause; empty where nothing is known."""
        return ""

    def active(self, x: Array, values: Values) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load: one set is one smooth piece of f."""
        del x, values
        return frozenset()

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a tangent step without motions that the problem holds."""
        del x
        return step

    def periods(self, x: Array, values: Values) -> Array:
        """Return a full turn for each coordinate in which one changes nothing, infinity for the others, (n,)."""
        del x, values
        return np.full(self.n, np.inf)

    def pencils(self, states: Array, values: Sequence[Values], jacs: Sequence[Matrix]) -> list[Pencil]:
        """Return `pencil` at many equilibria of a passive problem."""
        return [self.pencil(x, v, j) for x, v, j in zip(states, values, jacs, strict=True)]

    def side_by_side(self, name: str) -> bool:
        """Whether many states that differ in a parameter cost hardly more than one."""
        del name
        return False

    def residuals_along(self, states: Array, values: Values, columns: Mapping[str, Array]) -> Array:
        """Return f at states (m, nq), parameters having values of their own in each (m,), by name, shape (m, n)."""
        each = ({name: float(column[i]) for name, column in columns.items()} for i in range(len(states)))
        found = [self.residual(x, {**values, **own}) for x, own in zip(states, each, strict=True)]
        return np.array(found).reshape(len(states), self.n)

    def linearize_along(
        self, states: Array, values: Values, name: str, column: Array, bounds: Range | None = None
    ) -> tuple[Array, Array, Array] | None:
        """Return f (m, n), df/dx (m, n, n) and df/dp (m, n) at such states; None where side by side gains nothing."""
        del states, values, name, column, bounds
        return None

    def together(self, names: Sequence[str]) -> int:
        """Return how many variants, which differ in parameters, are best evaluated in one call; 1 where none gain.

        More than one says that f is smooth, and affine in the parameters `names`, which differ between the states of a
        variant, too.
        """
        del names
        return 1

    def variants(self, values: Sequence[Values], names: Sequence[str]) -> Variants:
        """Return f of variants with these values, for use until the next call; `names` are given for every state."""
        return OneByOne(self, values, names)

    @property
    def own_jacobian(self) -> bool:
        """Whether df/dx is computed by the problem itself, not by differences of f."""
        return False

    def derivative_along(self, x: Array, values: Values, *vectors: Array) -> Array | None:
        """Return the derivative of f along one, two or three vectors, (n,), that the problem computes itself.

        None where differences of f are to be taken.
        """
        del x, values, vectors
        return None

    # -- motions that nothing opposes ----------------------------------------------------------------------------

    @property
    def held(self) -> tuple[str, ...]:
        """The rigid-body modes that are held."""
        return ()

    def rigid_modes(self, x: Array, values: Values, among: Sequence[str] | None = None) -> tuple[str, ...]:
        """Return the names of the rigid-body motions that no force opposes near a state, of all or `among` some."""
        del x, values, among
        return ()

    def holds_straight(self) -> bool:
        """Whether modes are held along which coordinates change in proportion, and no others."""
        return False

    def rigid_directions(self, x: Array) -> dict[str, Array]:
        """Return the tangent vectors (n,) along the held rigid-body modes, by name."""
        del x
        return {}

    def holding(self, modes: Sequence[str]) -> Self:
        """Return this problem with rigid-body modes held by a stiffness and damping of their own."""
        del modes
        return self
