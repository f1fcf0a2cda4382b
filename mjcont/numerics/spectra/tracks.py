"""Eigenvalues followed between two points of a curve: values and slopes at both, matched, and where they reach the axis.

    lambda' = w* A' v / w* v

with the matrix A of the linearised motion, its left and right vectors w, v, and A' along the curve by differences of
the matrices that the points have anyway. Between the points an eigenvalue is the cubic through both with its slopes.
Source: Kato, Perturbation Theory for Linear Operators, section II.2 (simple eigenvalues).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import linalg
from scipy.optimize import linear_sum_assignment

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.spectra.spectrum import companion
from mjcont.numerics.spectra.stability import negative_stiffness
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note

# noise of eigenvalues in parts of the matrix: of differences of fourth order, of second order, and of eigenvalues
_FOURTH, _SECOND, _OWN = 1e-11, 1e-10, 1e-12
# eigenvectors more nearly orthogonal to their left ones than this give no slope
_DEFECTIVE = 1e-7
# unknowns up to which eigenvalues are followed
_MANY = 80
# a cubic whose smallest value is below this part of those at its ends may touch zero; one errs by less than this part
# of how far straight lines along its slopes miss its ends
_DIPS, _ERRS = 0.5, 0.25


@dataclass(frozen=True, slots=True)
class Modes:
    """Eigenvalues (N,) of a point's matrix, its right and left vectors (N, N) in columns, w* v = 1, and the noise (N,).

    `sure` tells those whose vectors can be told apart: the others have no slope.
    """

    matrix: Array
    values: Array
    right: Array
    left: Array
    noise: Array
    sure: Array


_MODES = Note[Modes | None]()


def modes_at(point: CurvePoint) -> Modes | None:
    """Return the modes at a point, computed once; None where there are too many, or none."""
    return _MODES.of(point, lambda: _modes(point))


def _modes(point: CurvePoint) -> Modes | None:
    jac = point.local.raw_jac
    if not isinstance(jac, np.ndarray) or len(jac) > _MANY or not np.all(np.isfinite(jac)):
        return None
    if negative_stiffness(point) is not None:
        values, right = np.linalg.eigh(0.5 * (jac + jac.T))
        floor = _SECOND * np.abs(jac).max() + 0.0 * values
        return Modes(jac, values.astype(complex), right, right, floor, np.ones(len(values), dtype=bool))
    pencil, noise = point.local.pencil, _FOURTH
    if pencil.mass is not None and pencil.damping is not None:
        jac, noise = companion(pencil.mass, pencil.damping, pencil.stiffness), _SECOND
        if not np.all(np.isfinite(jac)):
            return None
    try:
        values, left, right = linalg.eig(jac, left=True, right=True)
    except (linalg.LinAlgError, ValueError):
        return None
    products = np.einsum("ij,ij->j", left.conj(), right)
    sure = np.abs(products) > _DEFECTIVE
    left = left / np.where(sure, products, 1.0).conj()
    return Modes(jac, values, right, left, noise * np.abs(jac).max() + _OWN * np.abs(values), sure)


@dataclass(frozen=True, slots=True)
class Tracks:
    """Eigenvalues between two points: values (N,) and slopes over the step (N,) at both, one index for one eigenvalue.

    Attributes
    ----------
    errors : (N,) how far the straight line along an eigenvalue's slope at one end misses it at the other.
    noise : (N,) how near zero a real part says nothing.
    """

    start: Array
    end: Array
    start_slope: Array
    end_slope: Array
    errors: Array
    noise: Array

    def at(self, index: int, t: float) -> complex:
        """Return an eigenvalue at a fraction of the step, on its cubic."""
        square, rest = t * t, 1.0 - t
        return complex(
            (1.0 + 2.0 * t) * rest * rest * self.start[index]
            + t * rest * rest * self.start_slope[index]
            + square * (3.0 - 2.0 * t) * self.end[index]
            - square * rest * self.end_slope[index]
        )


def tracks(nodes: Sequence[CurvePoint], i: int) -> Tracks | None:
    """Return the eigenvalues between points i and i + 1 of a curve in order, the points beside helping with slopes."""
    a, b = modes_at(nodes[i]), modes_at(nodes[i + 1])
    h = nodes[i + 1].s - nodes[i].s
    if a is None or b is None or len(a.values) != len(b.values) or not h > 0.0:
        return None
    start_slope, end_slope = h * _slopes(nodes, i), h * _slopes(nodes, i + 1)
    forwards = np.abs((a.values + start_slope)[:, None] - b.values[None, :])
    backwards = np.abs(a.values[:, None] - (b.values - end_slope)[None, :])
    rows, columns = linear_sum_assignment(forwards + backwards)
    start, end = a.values[rows], b.values[columns]
    secant = end - start
    sure = a.sure[rows] & b.sure[columns]
    one, two = start_slope[rows], end_slope[columns]
    one, two = np.where(sure, one, secant), np.where(sure, two, secant)
    errors = np.maximum(np.abs(one - secant), np.abs(two - secant))
    return Tracks(start, end, one, two, errors, np.maximum(a.noise[rows], b.noise[columns]))


def _slopes(nodes: Sequence[CurvePoint], i: int) -> Array:
    """Return the slopes of the eigenvalues of point i along the curve, from the matrices of the points around it."""
    own = modes_at(nodes[i])
    assert own is not None
    first = max(min(i - 1, len(nodes) - 3), 0)
    near = [p for p in nodes[first : first + 3] if p is nodes[i] or modes_at(p) is not None]
    change = np.zeros_like(own.matrix)
    for p in near:
        if p is nodes[i]:
            continue
        weight, others = 1.0 / (p.s - nodes[i].s), [q for q in near if q is not p and q is not nodes[i]]
        for q in others:
            weight *= (nodes[i].s - q.s) / (p.s - q.s)
        modes = modes_at(p)
        assert modes is not None
        if modes.matrix.shape == change.shape:
            change = change + weight * (modes.matrix - own.matrix)
    found: Array = np.einsum("ij,ij->j", own.left.conj(), change @ own.right)
    return np.where(np.isfinite(found), found, 0.0)


@dataclass(frozen=True, slots=True)
class Meeting:
    """Where an eigenvalue reaches the axis: its index, the part of the step, and whether it passes for certain."""

    index: int
    at: float
    crosses: bool


def meetings(found: Tracks) -> list[Meeting]:
    """Return where eigenvalues pass the axis between two points, or come so near that they may, in order.

    Eigenvalues at the axis at one end are left out: what lies on a point belongs to the steps on both sides.
    """
    y0, y1, d0, d1 = (np.real(a) for a in (found.start, found.end, found.start_slope, found.end_slope))
    away = (np.abs(y0) > found.noise) & (np.abs(y1) > found.noise)
    upper = (np.imag(found.start) >= 0.0) & (np.imag(found.end) >= 0.0)
    hull = np.array([y0, y0 + d0 / 3.0, y1 - d1 / 3.0, y1]) * np.sign(y0)
    floor = np.maximum(_DIPS * np.minimum(np.abs(y0), np.abs(y1)), _ERRS * found.errors)
    near = away & upper & (hull.min(axis=0) < floor)
    every: list[Meeting] = []
    for k in np.flatnonzero(near).tolist():
        every += _of_cubic(k, *(float(a[k]) for a in (y0, d0, y1, d1, floor, found.errors)))
    return sorted(every, key=lambda m: m.at)


def _of_cubic(k: int, y0: float, d0: float, y1: float, d1: float, floor: float, error: float) -> list[Meeting]:
    """Return the zeros of a cubic in (0, 1), or where it comes nearest to zero if that is below a floor."""
    c3, c2 = 2.0 * (y0 - y1) + d0 + d1, 3.0 * (y1 - y0) - 2.0 * d0 - d1
    roots = np.roots([c3, c2, d0, y0]) if np.isfinite([c3, c2, d0, y0]).all() else np.zeros(0)
    inside = sorted(float(r.real) for r in roots if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0)
    if inside and len(inside) % 2 == (y0 * y1 < 0.0):
        return [Meeting(k, t, True) for t in inside]
    if y0 * y1 < 0.0:
        return [Meeting(k, y0 / (y0 - y1), True)]
    turns = np.roots([3.0 * c3, 2.0 * c2, d0])
    places = [float(t.real) for t in turns if abs(t.imag) < 1e-12 and 0.0 < t.real < 1.0]
    lowest = min(places, key=lambda t: abs(y0 + t * (d0 + t * (c2 + t * c3))), default=None)
    if lowest is not None and abs(y0 + lowest * (d0 + lowest * (c2 + lowest * c3))) < floor:
        return [Meeting(k, lowest, False)]
    return [Meeting(k, 0.5, False)] if min(abs(y0), abs(y1)) < _ERRS * error else []
