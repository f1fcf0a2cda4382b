"""Conditions on a fold, with its null vectors v and w: points of codimension two.

    cusp             fold and w . B(v, v) = 0
    Bogdanov-Takens  fold and w . C v = 0  (w . v for a first-order system)
    transversality   fold and w . f_p = 0

The null vectors turn with the unknowns: with A the fold's bordered matrix, dv = -A^-1 [dJ v; 0] and dw likewise, so
that d(a . v) = -(A^-T a)' dJ v and d(w . b) = -w' dJ (A^-1 b) for any a and b.
"""

from __future__ import annotations

import numpy as np

from mjcont.numerics.equations.bends import bend, bends_itself
from mjcont.numerics.equations.defining import Fold, pencil_of
from mjcont.numerics.equations.differences import second_form
from mjcont.numerics.equations.frozen import parameter_slope
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Condition, Local, System


class _OnFold(Condition):
    """What is asked of the null vectors of a `Fold` of the same system."""

    weight: float

    def __init__(self, fold: Fold) -> None:
        self.fold = fold

    def _right(self, local: Local, b: Array) -> Array:
        """Return A^-1 [b; 0] for a vector over the equations, scaled, (n,)."""
        return self.fold.factored(local).solve(np.append(self.fold.rows * b, 0.0))[:-1]

    def _left(self, local: Local, a: Array) -> Array:
        """Return A^-T [a; 0] for a vector over scaled unknowns, over the equations, (n,)."""
        return self.fold.factored(local).solve_transposed(np.append(a, 0.0))[:-1] * self.fold.rows

    def _turns(self, local: Local, system: System, y: Array, a: Array | None, b: Array) -> Array:
        """Return d(a . v) + d(w . b) as v and w turn, over (x, free parameters), (n + number free,).

        `a` is over scaled unknowns, None for nothing.
        """
        v, w = self.fold.vectors(local)[0], self.fold.physical(local)[1]
        found = -bend(local, system, y, w, self._right(local, b))
        return found if a is None else found - bend(local, system, y, self._left(local, a), v)


class FoldCoefficient(_OnFold):
    """Cusp: w . B(v, v) / 2 = 0."""

    def __init__(self, fold: Fold, local: Local) -> None:
        super().__init__(fold)
        v, w, _ = fold.vectors(local)
        self.weight = float(np.linalg.norm(v) ** 2 * np.linalg.norm(w))

    def value(self, local: Local, aux: Array) -> Array:
        """Return the coefficient with the borders' normalisation."""
        v, w = self.fold.physical(local)
        return np.array([0.5 * w @ second_form(local.problem, local.x, local.values, v, v)]) / self.weight

    def gradient(self, local: Local, system: System, y: Array) -> Array:
        """Return the gradient over (x, free parameters), (1, n + number free).

        Centred differences are wrong by about k step^2 with stiff bushes, which cancels only in part along the null
        vector v, where the coefficient itself changes little; along v they are replaced by a fourth-order difference.
        """
        v = self.fold.vectors(local)[0]
        if bends_itself(local):
            w = self.fold.physical(local)[1]
            along = bend(local, system, y, w, v)[: system.n]
            along_v = v * local.problem.state_scale
            half = 0.5 * second_form(local.problem, local.x, local.values, along_v, along_v)
            found = 0.5 * bend(local, system, y, w, v, order=2) + self._turns(local, system, y, along, half)
            return found[None] / self.weight
        gradient = system.gradients([self], local, y)[:, : system.n + len(system.free)]
        ahead = np.append(v, np.zeros(system.k))
        off = system.slope(self, local, y, ahead) - gradient[:, : system.n] @ v
        gradient[:, : system.n] += off[:, None] * v / (v @ v)
        return gradient


class DoubleZero(_OnFold):
    """Bogdanov-Takens: w . C v = 0 (C = I for a first-order system)."""

    def __init__(self, fold: Fold, local: Local) -> None:
        super().__init__(fold)
        v, w = fold.physical(local)
        self.weight = float(np.abs(w) @ (abs(pencil_of(local)[1]) @ np.abs(v))) or 1.0

    def value(self, local: Local, aux: Array) -> Array:
        """Return w . C v."""
        v, w = self.fold.physical(local)
        return np.array([w @ (pencil_of(local)[1] @ v)]) / self.weight

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return the gradient over (x, free parameters), (1, n + number free); None where it is by differences."""
        if not bends_itself(local):
            return None
        v, w = self.fold.physical(local)
        return self._turns(local, system, y, w * local.problem.state_scale, v)[None] / self.weight


class Transversality(_OnFold):
    """w . f_p = 0, p the first parameter of a fold locus: the locus turns in the second without a cusp."""

    def __init__(self, fold: Fold, local: Local) -> None:
        super().__init__(fold)
        _, w = fold.physical(local)
        self.weight = float(np.abs(w) @ np.abs(local.par[:, 0])) or 1.0

    def value(self, local: Local, aux: Array) -> Array:
        """Return w . f_p."""
        _, w = self.fold.physical(local)
        return np.array([w @ local.par[:, 0]]) / self.weight

    def gradient(self, local: Local, system: System, y: Array) -> Array | None:
        """Return the gradient over (x, free parameters), (1, n + number free); None where it is by differences."""
        if not bends_itself(local):
            return None
        _, w = self.fold.physical(local)
        found = self._turns(local, system, y, None, local.par[:, 0])
        lead = parameter_slope(lambda at: np.append(at.jac.T @ w, w @ at.par), local, system.names[0])
        slopes = [p.slope(float(u)) for p, u in zip(system.free, y, strict=False)]
        found += lead * np.append(np.ones(system.n), slopes)
        return found[None] / self.weight
