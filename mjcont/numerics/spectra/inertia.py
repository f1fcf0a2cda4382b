"""Proof that no eigenvalue reaches the axis along a polynomial of matrices, in the basis of eigenvectors nearby.

With V the eigenvectors of a matrix (real; two columns for a pair), S the signs of their real parts and B = V^-1 J V,

    B S + S B^T > 0

says that J has as many eigenvalues on each side of the imaginary axis as S has signs. Matrices with this property are
a convex set: where the Bernstein coefficients of J(t) have it, all J(t), 0 <= t <= 1, have it. Two products of matrices
and two Cholesky factors a step, where eigenvalues cost a hundred times as much. Source: Ostrowski, Schneider, Some
theorems on the inertia of general matrices (J. Math. Anal. Appl. 4, 1962), theorem 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack

from mjcont.numerics.equations.algebra import inverses
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.spectra.tracks import Modes

# part of its distance from the axis that an eigenvalue is to keep where J(t) is off the polynomial
_KEPT = 0.25
# two real eigenvalues on different sides whose sum is this many times larger than their changes keep its sign
_SUMS = 0.5


@dataclass(frozen=True, slots=True)
class Basis:
    """Eigenvectors of a matrix as a real basis.

    Attributes
    ----------
    vectors, inverse : (n, n) V and its inverse; rows and columns that belong together are of the same length.
    signs : (n,) on which side of the axis the eigenvalue of each vector is.
    pairs : (2, m) the two vectors of each pair.
    real : (k,) the vectors of real eigenvalues.
    kept : (n,) the distance from the axis that each eigenvalue is to keep.
    noise : how near zero the real parts of real eigenvalues, then of one of each pair, say nothing.
    """

    vectors: Array
    inverse: Array
    signs: Array
    pairs: Array
    real: Array
    kept: Array
    noise: Array

    @staticmethod
    def of(modes: Modes) -> Basis | None:
        """Return the basis of a matrix's modes; None where an eigenvalue is on the axis or vectors are not sure."""
        values = modes.values
        if not (modes.sure.all() and (np.abs(values.real) > modes.noise).all()):
            return None
        of_real, above = np.flatnonzero(values.imag == 0.0), np.flatnonzero(values.imag > 0.0)
        k, m = len(of_real), len(above)
        if k + 2 * m != len(values):
            return None
        right = modes.right
        vectors = np.concatenate([right[:, of_real].real, right[:, above].real, right[:, above].imag], axis=1)
        back = inverses(vectors[None])[0]
        columns, rows = (vectors**2).sum(axis=0), (back**2).sum(axis=1)
        for each in (columns, rows):
            each[k : k + m] = each[k + m :] = each[k : k + m] + each[k + m :]
        size = (rows / columns) ** 0.25
        if not np.isfinite(size).all():
            return None
        order = np.concatenate([of_real, above, above])
        rates, kept = values.real[order], np.maximum(_KEPT * np.abs(values.real), modes.noise)[order]
        pairs = np.array([np.arange(k, k + m), np.arange(k + m, k + 2 * m)])
        own = modes.noise[order[: k + m]]
        return Basis(vectors * size, back / size[:, None], np.sign(rates), pairs, np.arange(k), kept, own)

    @property
    def unstable(self) -> int:
        """The number of eigenvalues with positive real part."""
        return int(np.count_nonzero(self.signs > 0.0))

    def seen(self, jac: Array) -> Array:
        """Return V^-1 J V, (n, n)."""
        found: Array = self.inverse @ jac @ self.vectors
        return found

    def keeps(self, seen: Array) -> bool:
        """Whether a matrix, as `seen`, has the same inertia, with what is to be kept to spare."""
        signed = seen * self.signs
        form = signed + signed.T
        form[np.diag_indices(len(form))] -= 2.0 * self.kept
        return bool(np.isfinite(form).all()) and int(lapack.dpotrf(form, lower=1, overwrite_a=1, clean=0)[1]) == 0

    def values(self, seen: Array) -> Array:
        """Return the eigenvalues of a matrix, as `seen`, to first order: real ones, then one of each pair."""
        diagonal, (first, second) = seen.diagonal(), self.pairs
        rates = 0.5 * (diagonal[first] + diagonal[second])
        turns = 0.5 * (seen[first, second] - seen[second, first])
        return np.concatenate([diagonal[self.real].astype(complex), rates + 1j * np.abs(turns)])

    @property
    def complex(self) -> tuple[Array, Array]:
        """Right vectors in columns and left ones, conjugate, in rows: of real eigenvalues, then of one of each pair."""
        first, second = self.pairs
        right = np.concatenate([self.vectors[:, self.real], self.vectors[:, first] + 1j * self.vectors[:, second]], 1)
        rows = np.concatenate([self.inverse[self.real], 0.5 * (self.inverse[first] - 1j * self.inverse[second])])
        return right, rows

    def sums_keep(self, start: Array, end: Array) -> bool:
        """Whether no two real eigenvalues on different sides change the sign of their sum between two `values`."""
        of_real = self.real
        side, a, b = self.signs[of_real], start[of_real].real, end[of_real].real
        up, down = np.flatnonzero(side > 0.0), np.flatnonzero(side < 0.0)
        if not (len(up) and len(down)):
            return True
        change = np.abs(b - a)
        moves = change[up][:, None] + change[down]
        one, two = (v[up][:, None] + v[down] for v in (a, b))
        return bool((one * two > 0.0).all() and (np.minimum(np.abs(one), np.abs(two)) > _SUMS * moves).all())


def slope(place: float, before: Array, start: Array, end: Array) -> Array:
    """Return the derivative at 0 of the parabola through values at a place < 0, at 0 and at 1."""
    found: Array = (place * place * (end - start) - (before - start)) / (place * (place - 1.0))
    return found
