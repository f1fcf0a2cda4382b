"""Orbits of motions that keep an energy E: they come in families, one for each energy, and no equation tells which.

A damping that vanishes at every solution unfolds them, and one more equation chooses an orbit of the family,

    u' = f(u) + delta g(u),  grad E . g > 0 along the orbit,      E(s_0) = energy,  or  1 / T = frequency,

so that delta joins the unknowns and an orbit is a regular solution. Source: Munoz-Almaraz, Freire, Galan, Doedel and
Vanderbauwhede, Continuation of periodic orbits in conservative and Hamiltonian systems (Physica D 181, 2003).

The multiplier 1 is there twice: with the velocity to the right and the gradient of E to the left. Both are deflated,
which leaves the multipliers within the energy's level, beside the motion along the orbit.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.linalg import eig, qr

from mjcont.numerics.equations.problem import Array, Matrix, Ranges, Values
from mjcont.numerics.orbits.collocation import Blocks, OrbitLinearization, Orbits
from mjcont.numerics.orbits.fast import fast_modes
from mjcont.numerics.orbits.floquet import Multipliers, condensed, transfers
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.path import Path

ENERGY, FREQUENCY = "energy", "frequency"
# how far from the unit circle a multiplier is off it, and how many times what the product of all is from 1
_CERTAIN, _TIMES = 1e-6, 10.0


class ConservativeFlow(Flow):
    """A motion that keeps an energy; to implement beside what `Flow` asks for.

    Attributes
    ----------
    chosen_by : "energy" or "frequency", the parameter (J, or Hz) that tells an orbit of the family.
    """

    chosen_by: str
    forced = False

    @abstractmethod
    def energies(self, states: Array, values: Values) -> Array:
        """Return the energy at states (m, d), (m,)."""

    @abstractmethod
    def energy_slopes(self, states: Array, values: Values) -> Array:
        """Return the derivatives of the energy in the state at states (m, d), (m, d)."""

    @abstractmethod
    def energy_rate(self, state: Array, values: Values, name: str) -> float:
        """Return the derivative of the energy at a state (d,) in a parameter."""

    @abstractmethod
    def unfolding(self, states: Array, values: Values) -> Array:
        """Return g, rates (m, c) by which the energy would grow, at states (m, d)."""


class ConservedOrbits(Orbits):
    """The equations of the periodic orbits of a conservative flow on one mesh; delta stands before the period."""

    flow: ConservativeFlow

    def __init__(
        self, flow: ConservativeFlow, scheme: Any, mesh: Array, reference: Array, shift: Array, sizes: Array,
        period_scale: float,
    ) -> None:
        super().__init__(flow, scheme, mesh, reference, shift, sizes, period_scale)
        self.n += 1

    @property
    def last_scales(self) -> list[float]:
        """Scales of delta and of the period."""
        return [1.0 / self.period_scale, self.period_scale]

    def joined(self, p: Path) -> Array:
        """Return an orbit put together, without damping, (n,)."""
        found = Orbits.joined(self, p)
        return np.insert(found, len(found) - 1, 0.0)

    def _chosen(self, p: Path, values: Values) -> float:
        """Return by how much the orbit is not the one that is asked for."""
        wanted = values[self.flow.chosen_by]
        if self.flow.chosen_by == FREQUENCY:
            return 1.0 / p.period - wanted
        return float(self.flow.energies(p.s[:1], values)[0]) - wanted

    def _driven(self, p: Path, values: Values) -> Array:
        """Return the derivative of the equations at the points in delta, (N, m, c)."""
        g = self.flow.unfolding(self.stages(p).reshape(-1, self.flow.d), values).reshape(self.w_shape)
        found: Array = -((p.period * self.lengths)[:, None, None] ** self.flow.order) * g
        return found

    def _equations(self, p: Path, rates: Array) -> Array:
        found = Orbits._equations(self, p, rates)
        return np.insert(found, len(found) - 1, 0.0)

    def _completed(self, f: Array, p: Path, delta: float, driven: Array | None, values: Values) -> None:
        """Add what delta does to the equations' values and what chooses the orbit, in place."""
        if delta != 0.0:
            f[: self.inside] += delta * (self._driven(p, values) if driven is None else driven).ravel()
        f[-2] = self._chosen(p, values)

    def residual(self, x: Array, values: Values) -> Array:
        """Return the equations' values, (n,)."""
        found = Orbits.residual(self, x, values)
        self._completed(found, self.path(x, values), float(x[-2]), None, values)
        return found

    def linearize(
        self, x: Array, values: Values, wrt: Sequence[str], *, accurate: bool = False, ranges: Ranges = ()
    ) -> OrbitLinearization:
        """Return the equations with their derivatives; those of g are left out, since delta vanishes."""
        plain = Orbits.linearize(self, x, values, wrt, accurate=accurate, ranges=ranges)
        p = self.path(x, values)
        driven, row = self._driven(p, values), np.zeros(self.n)
        self._completed(plain.f, p, float(x[-2]), driven, values)
        if self.flow.chosen_by == FREQUENCY:
            row[-1] = -1.0 / p.period**2
        else:
            row[: self.flow.d] = self.flow.energy_slopes(p.s[:1], values)[0]
        par = plain.par
        for k, name in enumerate(wrt):
            if name == self.flow.chosen_by:
                par[-2, k] = -1.0
            elif self.flow.chosen_by == ENERGY:
                par[-2, k] = self.flow.energy_rate(p.s[0], values, name)
        jac = self._widened(plain.jac, driven.ravel(), row)
        return OrbitLinearization(plain.f, jac, par, blocks=plain.blocks)

    @cached_property
    def _places(self) -> tuple[Array, Array, Array]:
        """Return the column pointers and row indices of the whole matrix, and the order in which entries fill it."""
        pointers, rows, _ = self._pattern
        columns, own = np.repeat(np.arange(self.n), np.diff(pointers)), self.n - 2
        chosen = np.append(np.arange(self.flow.d), self.n - 1)
        kept = rows != own  # that row's entry in the period is among `chosen`
        row = np.concatenate([rows[kept], np.arange(self.inside), np.full(len(chosen), own)])
        column = np.concatenate([columns[kept], np.full(self.inside, own), chosen])
        order = np.lexsort((row, column))
        counts = np.concatenate([[0], np.cumsum(np.bincount(column, minlength=self.n))])
        return counts, row[order], order

    def _widened(self, plain: Matrix, column: Array, row: Array) -> Matrix:
        """Return the matrix with delta's column (inside,) and the row (n,) of what chooses the orbit."""
        found: Any = sparse.csc_matrix(plain)
        counts, rows, order = self._places
        kept = found.data[found.indices != self.n - 2]
        entries = np.concatenate([kept, column, row[: self.flow.d], row[-1:]])
        whole: Any = sparse.csc_matrix((entries[order], rows, counts), shape=(self.n, self.n))
        return whole


def own_multipliers(
    orbits: ConservedOrbits, blocks: Blocks, period: float, velocity: Array, slope: Array
) -> Multipliers:
    """Return the multipliers of an orbit; `velocity` and `slope` (d,) are u' and grad E at its beginning."""
    matrices, scale, d = transfers(blocks), orbits.sizes, orbits.flow.d
    if not np.isfinite(matrices).all():
        return Multipliers(np.full(d, complex(np.nan, np.nan)), np.ones(d, dtype=bool), 0, 2)
    left, right = condensed(matrices * scale[None, None, :] / scale[None, :, None])
    along, across = velocity / scale, slope * scale
    basis = qr(np.column_stack([along, across]))[0]
    own = basis[:, 2:]  # within the level, beside the motion
    ends = qr(np.column_stack([right @ basis[:, :1], right @ own]), mode="economic")[0]
    values, vectors = eig(-ends[:, 1:].T @ left @ own, ends[:, 1:].T @ right @ own)
    values = np.where(np.isfinite(values), values, complex(np.inf))
    first, second = _trivial(left, right, along, across)
    fast, resolved = fast_modes(orbits, blocks, period), np.ones(len(values), dtype=bool)
    if fast is not None:
        slow = fast.least(scale[:, None] * (own @ vectors), max(len(values) - fast.count, 0))
        values = np.concatenate([values[slow], fast.adiabatic[: len(values) - len(slow)]])
        resolved = np.arange(len(values)) < len(slow)
    order = np.argsort(-np.abs(values), kind="stable")
    values, resolved = values[order], resolved[order]
    at = int(np.count_nonzero(np.abs(values) > 1.0))
    return Multipliers(np.insert(values, [at, at], [first, second]), np.insert(resolved, [at, at], True), at, 2)


def blur(multipliers: Array) -> float:
    """Return how far from the unit circle errors may have taken the multipliers of an orbit that keeps an energy."""
    sizes = np.log(np.maximum(np.abs(multipliers), 1e-300))
    return float(max(_CERTAIN, _TIMES * abs(sizes.sum()))) if len(sizes) else _CERTAIN


def _trivial(left: Array, right: Array, along: Array, across: Array) -> tuple[complex, complex]:
    """Return the multiplier 1 as it is found from the velocity, and from the energy's gradient."""
    image = right @ along
    first = -(image @ (left @ along)) / (image @ image)
    try:
        back = np.linalg.solve(right.T, across)
    except np.linalg.LinAlgError:
        back = np.full(len(across), np.nan)
    return complex(first), complex(-(back @ (left @ across)) / (across @ across))


def orbits_on(
    flow: Flow, scheme: Any, mesh: Array, reference: Array, shift: Array, sizes: Array, period_scale: float
) -> Orbits:
    """Return the equations of a flow's orbits on a mesh, as it loses energy or keeps it."""
    if isinstance(flow, ConservativeFlow):
        return ConservedOrbits(flow, scheme, mesh, reference, shift, sizes, period_scale)
    return Orbits(flow, scheme, mesh, reference, shift, sizes, period_scale)
