"""Where eigenvalues reach the axis between two points of a curve, as the matrices of the points around tell.

    zero           det J(t) = 0 for the polynomial J(t) through the Jacobians of up to three points
    oscillations   lambda' = w* A' v / w* v: complex eigenvalues are cubics through both points with their slopes,
                   matched by them

with the matrix A of the linearised motion, its left and right vectors w, v, and A' by differences of the matrices that
the points have anyway. Source: Tisseur, Meerbergen, The quadratic eigenvalue problem (SIAM Review 43, 2001), section
3.4; Kato, Perturbation Theory for Linear Operators, section II.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import linalg

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.spectra.abreast import DIPS, ERRS, Tracks, coefficients, singular_at, within
from mjcont.numerics.spectra.spectrum import companion, first_order_spectra, symmetric
from mjcont.numerics.spectra.stability import SPECTRUM, negative_stiffness, spectrum_of
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.step.notes import Note

# noise of eigenvalues in parts of the matrix: of differences of fourth order, of second order, and of eigenvalues
_FOURTH, _SECOND, _OWN = 1e-11, 1e-10, 1e-12
# no eigenvalue vanishes where the inverse is that small, in parts of the matrix
_FAR = 1e-8
# eigenvectors more nearly orthogonal to their left ones than this give no slope
DEFECTIVE = 1e-5
# unknowns up to which eigenvalues are followed, and from which on they are where nothing else proves that none passes
MANY, FEW = 128, 24
_GRID = np.linspace(0.0, 1.0, 17)[1:-1]
_GRID_ERRORS = 16.0 * (_GRID * (1.0 - _GRID)) ** 2
# a root of det J(t) this near to a point that holds the eigenvalue is that point's
_OWN_ROOT = 1e-3


@dataclass(frozen=True, slots=True)
class Modes:
    """Eigenvalues (N,) of a matrix, its right and left vectors (N, N) in columns, w* v = 1, and the noise (N,).

    `sure` tells those whose vectors can be told apart: the others have no slope.
    """

    matrix: Array
    values: Array
    right: Array
    left: Array
    noise: Array
    sure: Array


@dataclass(frozen=True, slots=True)
class Motion:
    """What is known of small motions at a point.

    Attributes
    ----------
    jac : (n, n) df/dx.
    own : (n,) its eigenvalues, or a number that none is smaller than.
    noise : what is nothing in parts of the largest entry of J.
    modes : those of the first-order form, None where no oscillation can gain energy.
    """

    jac: Array
    own: Array
    noise: float
    modes: Modes | None

    @property
    def size(self) -> float:
        """The largest entry of J."""
        return float(np.abs(self.jac).max())

    @property
    def held(self) -> int:
        """How many eigenvalues of J are zero as far as can be told."""
        return self.vanishing(self.size)

    def vanishing(self, size: float) -> int:
        """Return how many eigenvalues of J are nothing beside matrices whose largest entries are `size`."""
        return int(np.count_nonzero(np.abs(self.own) <= self.noise * size))

    @property
    def oscillating(self) -> int:
        """How many oscillations neither grow nor decay as far as can be told."""
        if self.modes is None:
            return 0
        values, noise = self.modes.values, self.modes.noise
        return int(np.count_nonzero((np.abs(values.real) <= noise) & (values.imag > noise)))


_MOTION = Note[Motion | None]()


def motion_at(point: CurvePoint) -> Motion | None:
    """Return the motion at a point, computed once; None where matrices are sparse, too large or undefined."""
    return _MOTION.of(point, lambda: _motion(point))


def _motion(point: CurvePoint) -> Motion | None:
    jac = point.local.raw_jac
    if not isinstance(jac, np.ndarray) or len(jac) > MANY or not np.all(np.isfinite(jac)):
        return None
    second = point.local.problem.second_order
    noise = _SECOND if second else _FOURTH
    if negative_stiffness(point) is not None or (second and symmetric(jac) and spectrum_of(point).conservative):
        squares = np.linalg.eigvalsh(0.5 * (jac + jac.T))
        return Motion(jac, squares, noise, None)
    matrix = jac
    if second:
        pencil = point.local.pencil
        assert pencil.mass is not None and pencil.damping is not None
        matrix = companion(pencil.mass, pencil.damping, pencil.stiffness)
    if not np.all(np.isfinite(matrix)):
        return None
    try:
        values, left, right = linalg.eig(matrix, left=True, right=True)
        own = _smallest(jac) if second else values
    except (linalg.LinAlgError, ValueError):
        return None
    if not second and not SPECTRUM.known(point):
        SPECTRUM.put(point, first_order_spectra(jac[None], values[None])[0])
    products = np.einsum("ij,ij->j", left.conj(), right)
    sure = np.abs(products) > DEFECTIVE
    left = left / np.where(sure, products, 1.0).conj()
    unsure = _unsure(values, float(np.abs(matrix).max()), noise)
    return Motion(jac, own, noise, Modes(matrix, values, right, left, unsure, sure))


def _unsure(values: Array, size: float | Array, noise: float) -> Array:
    """Return how near to the axis eigenvalues cannot be told from it, for matrices of a size."""
    found: Array = noise * size + _OWN * np.abs(values)
    return found


def eigenvalue_noise(values: Array, jacs: Array) -> Array:
    """Return the noise of the eigenvalues (m, n) of first-order systems with matrices (m, n, n)."""
    return _unsure(values, np.abs(jacs).max(axis=(1, 2))[:, None], _FOURTH)


def vanishes(values: Array, jacs: Array) -> Array:
    """Return which eigenvalues (m, n) of first-order systems are nothing beside their matrices (m, n, n)."""
    found: Array = np.abs(values) <= _FOURTH * np.abs(jacs).max(axis=(1, 2))[:, None]
    return found


def _smallest(matrix: Array) -> Array:
    """Return the eigenvalues of a matrix, or 1 / |inverse| where it is not small: none is below that."""
    try:
        least = 1.0 / float(np.linalg.norm(np.linalg.inv(matrix)))
        if least > _FAR * float(np.abs(matrix).max()):
            return np.array([least])
    except (np.linalg.LinAlgError, ZeroDivisionError):
        pass
    found: Array = linalg.eigvals(matrix)
    return found


@dataclass(frozen=True, slots=True)
class Meeting:
    """Where an eigenvalue reaches the axis: the part of the step, whether for certain, and whether it oscillates."""

    at: float
    crosses: bool
    oscillates: bool


def meetings(nodes: Sequence[CurvePoint], i: int, parts: Sequence[Array], followed: Tracks | None) -> list[Meeting]:
    """Return where eigenvalues reach the axis between points i and i + 1 of a curve, or may, in order.

    As the matrices `interpolated` between them and the eigenvalues followed by `tracks` tell. Eigenvalues on the axis
    at one end are left out: what lies on a point belongs to the steps on both sides.
    """
    oscillations = [] if followed is None else _oscillations(followed)
    return sorted([*_zeros(nodes, i, parts), *oscillations], key=lambda m: m.at)


def _around(nodes: Sequence[CurvePoint], i: int) -> list[CurvePoint]:
    """Return points i and i + 1, and the one before, or else after, where it has a motion."""
    return list(nodes[max(i - 1, 0) : max(i - 1, 0) + 3])


def interpolated(nodes: Sequence[CurvePoint], i: int) -> list[Array]:
    """Return the coefficients of J(t) = A0 + A1 t + A2 t^2 between points i and i + 1, t from 0 to 1.

    None where there is no motion at these or they coincide.
    """
    a, b = nodes[i], nodes[i + 1]
    every = [(p, m) for p in _around(nodes, i) if (m := motion_at(p)) is not None]
    if not b.s > a.s or len(every) < 2:
        return []
    places = np.array([(p.s - a.s) / (b.s - a.s) for p, _ in every])
    return list(coefficients(places[None], np.array([m.jac for _, m in every])[None])[0])


def _zeros(nodes: Sequence[CurvePoint], i: int, parts: Sequence[Array]) -> list[Meeting]:
    """Return where det J(t) vanishes between points i and i + 1, or nearly does."""
    a, b = motion_at(nodes[i]), motion_at(nodes[i + 1])
    if a is None or b is None or (a.held and b.held):
        return []
    if not (len(parts) > 1 and all(np.isfinite(p).all() for p in parts)):
        return []
    roots = singular_at(np.array(parts)[None])[0]
    inside = [complex(r) for r in roots[within(roots)]]
    for held, end in ((a.held, 0.0), (b.held, 1.0)):
        own = sorted((r for r in inside if abs(r - end) < _OWN_ROOT), key=lambda r: abs(r - end))[:held]
        inside = [r for r in inside if r not in own]
    crossing = [Meeting(r.real, True, False) for r in inside if r.imag == 0.0]
    return crossing + [Meeting(r.real, False, False) for r in inside if r.imag > 0.0]


def _oscillations(followed: Tracks) -> list[Meeting]:
    """Return where oscillations reach the axis, or come so near that they may."""
    real = [np.real(a) for a in (followed.start, followed.start_slope, followed.end, followed.end_slope)]
    found: list[Meeting] = []
    for k in np.flatnonzero(followed.near).tolist():
        found += _of_cubic(*(float(a[k]) for a in (*real, followed.errors)))
    return found


def _of_cubic(y0: float, d0: float, y1: float, d1: float, error: float) -> list[Meeting]:
    """Return the zeros of a cubic in (0, 1), or where it dips towards zero, or may reach it as far as it is known."""
    c3, c2 = 2.0 * (y0 - y1) + d0 + d1, 3.0 * (y1 - y0) - 2.0 * d0 - d1
    if not np.isfinite([c3, c2, d0, y0]).all():
        return []
    roots = np.roots([c3, c2, d0, y0])
    inside = sorted(float(r.real) for r in roots if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0)
    if inside and len(inside) % 2 == (y0 * y1 < 0.0):
        return [Meeting(t, True, True) for t in inside]
    if y0 * y1 < 0.0:
        return [Meeting(y0 / (y0 - y1), True, True)]
    turns = np.roots([3.0 * c3, 2.0 * c2, d0])
    lowest = [float(t.real) for t in turns if abs(t.imag) < 1e-12 and 0.0 < t.real < 1.0]
    away = np.abs(y0 + _GRID * (d0 + _GRID * (c2 + _GRID * c3))) - ERRS * error * _GRID_ERRORS
    unsure = [float(_GRID[away.argmin()])] if away.min() < 0.0 else []
    dips = [t for t in lowest if abs(y0 + t * (d0 + t * (c2 + t * c3))) < DIPS * min(abs(y0), abs(y1))]
    return [Meeting(t, False, True) for t in (dips or unsure)[:1]]


def tracks(nodes: Sequence[CurvePoint], i: int) -> Tracks | None:
    """Return the eigenvalues between points i and i + 1 of a curve; None where no oscillation can gain energy."""
    one, two = motion_at(nodes[i]), motion_at(nodes[i + 1])
    a, b = (None if m is None else m.modes for m in (one, two))
    h = nodes[i + 1].s - nodes[i].s
    if a is None or b is None or len(a.values) != len(b.values) or not h > 0.0:
        return None
    start_slope, end_slope = h * _slopes(nodes, i, i), h * _slopes(nodes, i, i + 1)
    first, last = (
        (m.values[None], slope[None], m.sure[None], m.noise[None]) for m, slope in ((a, start_slope), (b, end_slope))
    )
    return Tracks.matched(first, last).chosen(0)


def _slopes(nodes: Sequence[CurvePoint], i: int, at: int) -> Array:
    """Return the slopes of the eigenvalues of point `at` along the curve, from the matrices around points i, i + 1."""
    every = [(p.s, m.modes) for p in _around(nodes, i) if (m := motion_at(p)) is not None and m.modes is not None]
    motion = motion_at(nodes[at])
    assert motion is not None and motion.modes is not None
    own, s = motion.modes, nodes[at].s
    change = np.zeros_like(own.matrix)
    others = [(q, modes) for q, modes in every if q != s and modes.matrix.shape == change.shape]
    for q, modes in others:
        weight = 1.0 / (q - s)
        for r, _ in others:
            weight *= (s - r) / (q - r) if r != q else 1.0
        change = change + weight * (modes.matrix - own.matrix)
    found: Array = np.einsum("ij,ij->j", own.left.conj(), change @ own.right)
    return np.where(np.isfinite(found), found, 0.0)
