"""Matrices and eigenvalues of many pieces of curves side by side: between two points each, as those around tell.

The first index of every array is the piece; the place t runs from 0 to 1 along each. See `tracks`, where one piece is
looked at closely.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from mjcont.numerics.equations.algebra import eigenvalues, inverses, solve
from mjcont.numerics.equations.problem import Array

# a cubic whose smallest value is below this part of those at its ends may touch zero; one errs by less than this part
# of how far straight lines along its slopes miss its ends
DIPS, ERRS = 0.5, 0.25
# a polynomial of matrices is singular at 1 / an eigenvalue, nowhere for one that is smaller
_NOWHERE = 1e-12
# what an assignment costs that is not defined
_UNLIKELY = 1e150
# a change of an eigenvalue counts from this part of its distance from the axis on, or of its values at the ends where
# it passes; and from so many times its noise on
CHANGES, _STEEPENS, _NOISE = 0.3, 0.1, 1e2

# values (m, N) of eigenvalues at one end, their slopes, whether these are known, and the noise
Ends = tuple[Array, Array, Array, Array]


def coefficients(places: Array, stack: Array) -> Array:
    """Return the coefficients of the polynomials in t, (m, k, a, b), through matrices (m, k, a, b) at places (m, k)."""
    powers = places[:, :, None] ** np.arange(places.shape[1])
    found: Array = inverses(powers) @ stack.reshape(*places.shape, math.prod(stack.shape[2:]))
    return found.reshape(stack.shape)


def singular_at(parts: Array) -> Array:
    """Return the t for which polynomials with coefficients (m, k, n, n) are singular, (m, (k - 1) n), NaN for infinity.

    As eigenvalues 1 / t of the companion matrix of A0^-1 A1, A0^-1 A2; A0 is the matrix at a point of the curve.
    """
    m, k, n, _ = parts.shape
    matrix = np.zeros((m, (k - 1) * n, (k - 1) * n))
    matrix[:, :n] = -solve(parts[:, 0], parts[:, 1:].transpose(0, 2, 1, 3).reshape(m, n, (k - 1) * n))
    matrix[:, n:, : (k - 2) * n] = np.eye((k - 2) * n)
    inverse = eigenvalues(matrix)
    found = np.full(inverse.shape, complex(np.nan, np.nan))
    np.divide(1.0, inverse, out=found, where=np.abs(inverse) > _NOWHERE)
    return found


def within(roots: Array) -> Array:
    """Return which roots are places between 0 and 1, or so near to one that a matrix nearly vanishes there."""
    real = roots.real
    found: Array = (real > 0.0) & (real < 1.0) & (np.abs(roots.imag) < np.minimum(real, 1.0 - real))
    return found


@dataclass(frozen=True, slots=True)
class Tracks:
    """Eigenvalues along pieces: values and slopes at both ends, (m, N), one index for one eigenvalue; (N,) of one.

    Attributes
    ----------
    errors : how far straight lines along the slopes at one end miss the real parts at the other.
    noise : how near zero a real part says nothing.
    """

    start: Array
    end: Array
    start_slope: Array
    end_slope: Array
    errors: Array
    noise: Array

    @staticmethod
    def matched(first: Ends, last: Ends) -> Tracks:
        """Return the eigenvalues of both ends, each with that at the other end to which its slope leads.

        Those whose slope is not known are taken to move evenly.
        """
        (a, slope_a, sure_a, noise_a), (b, slope_b, sure_b, noise_b) = first, last
        forwards = np.abs((a + slope_a)[:, :, None] - b[:, None, :])
        backwards = np.abs(a[:, :, None] - (b - slope_b)[:, None, :])
        chosen = _assigned(forwards + backwards)
        end, slope_b, sure_b, noise_b = (np.take_along_axis(v, chosen, axis=1) for v in (b, slope_b, sure_b, noise_b))
        secant, sure = end - a, sure_a & sure_b
        start_slope, end_slope = np.where(sure, slope_a, secant), np.where(sure, slope_b, secant)
        errors = np.maximum(np.abs((start_slope - secant).real), np.abs((end_slope - secant).real))
        return Tracks(a, end, start_slope, end_slope, errors, np.maximum(noise_a, noise_b))

    def chosen(self, pieces: Array | int | None) -> Tracks:
        """Return those of some pieces, in the order given, or of one; None: of the one as the only one."""
        return Tracks(*(getattr(self, name)[pieces] for name in Tracks.__slots__))

    def at(self, t: float | Array) -> Array:
        """Return the eigenvalues at a place, on their cubics."""
        square, rest = t * t, 1.0 - t
        found: Array = (1.0 + 2.0 * t) * rest * rest * self.start + t * rest * rest * self.start_slope
        found = found + square * (3.0 - 2.0 * t) * self.end - square * rest * self.end_slope
        return found

    @property
    def away(self) -> Array:
        """Which are told from the axis at both ends."""
        found: Array = (np.abs(self.start.real) > self.noise) & (np.abs(self.end.real) > self.noise)
        return found

    @property
    def near(self) -> Array:
        """Which oscillate, and reach the axis or come so near to it that they may."""
        y0, y1, d0, d1 = (np.real(a) for a in (self.start, self.end, self.start_slope, self.end_slope))
        oscillates = (np.imag(self.start) > self.noise) & (np.imag(self.end) > self.noise)
        hull = np.array([y0, y0 + d0 / 3.0, y1 - d1 / 3.0, y1]) * np.sign(y0)
        floor = np.maximum(DIPS * np.minimum(np.abs(y0), np.abs(y1)), ERRS * self.errors)
        found: Array = self.away & oscillates & (hull.min(axis=0) < floor)
        return found


def _assigned(costs: Array) -> Array:
    """Return the columns that rows of matrices (m, N, N) are assigned to, (m, N), at the least sum of their costs."""
    chosen: Array = costs.argmin(axis=2)
    clear = (np.sort(chosen, axis=1) == np.arange(costs.shape[1])).all(axis=1)
    for i in np.flatnonzero(~clear).tolist():
        chosen[i] = linear_sum_assignment(np.nan_to_num(costs[i], nan=_UNLIKELY, posinf=_UNLIKELY))[1]
    return chosen


@dataclass(frozen=True, slots=True)
class Probe:
    """The product J r along pieces: r the sum of the eigenvectors at their starts, so that each eigenvalue shows in it.

    Attributes
    ----------
    vector : (m, n) r.
    left : (m, N, n) takes each eigenvalue's share out of a product.
    along : (m, k, n) coefficients of the polynomial for J r that the points tell.
    """

    vector: Array
    left: Array
    along: Array

    @staticmethod
    def of(right: Array, rows: Array, mass: Array | None, scale: Array, parts: Array) -> Probe:
        """Return the probe for right vectors in columns (m, N, N), left ones conjugate in rows, masses (m, n, n).

        `parts` (m, k, n, n) are the coefficients of the polynomials for J.
        """
        n = len(scale)
        size = np.abs(right[:, :n] / scale[:, None]).max(axis=1)
        unit = right / np.where(size > 0.0, size, 1.0)[:, None]
        whole = (unit.real + unit.imag).sum(axis=2)
        left = rows[:, :, -n:]
        left = left if mass is None else solve(mass.transpose(0, 2, 1), left.transpose(0, 2, 1)).transpose(0, 2, 1)
        shares = np.abs((rows @ whole[:, :, None])[:, :, 0])
        length = np.abs(whole[:, :n] / scale).max(axis=1)
        length = np.where(length > 0.0, length, 1.0)[:, None]
        left = left / np.where(shares > 0.0, shares, 1.0)[:, :, None] * length[:, :, None]
        vector = whole[:, :n] / length
        return Probe(vector, left, (parts @ vector[:, None, :, None])[..., 0])

    def strays(self, product: Array, t: Array, followed: Tracks) -> Array:
        """Return by how much an eigenvalue strays where J r (m, n) is a `product` at places t, one where it counts."""
        expected = (self.along * (t[:, None] ** np.arange(self.along.shape[1]))[:, :, None]).sum(axis=1)
        off = np.abs((self.left @ (product - expected)[:, :, None])[:, :, 0])
        ends = np.maximum(np.abs(followed.start), np.abs(followed.end))
        passes = followed.start.real * followed.end.real < 0.0
        floor = np.maximum(CHANGES * np.abs(followed.at(t[:, None]).real), np.where(passes, _STEEPENS * ends, 0.0))
        parts = np.where(followed.away, off / np.maximum(floor, _NOISE * followed.noise), 0.0)
        found: Array = np.where(np.isfinite(off).all(axis=1), parts.max(axis=1, initial=0.0), 0.0)
        return found
