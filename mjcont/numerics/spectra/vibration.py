"""Eigenvalues with their vectors of a pencil s^2 M + s C + K: its modes, slowest first, each vector normalised.

Without damping and with symmetric K they are those of K phi = w^2 M phi, else those of the companion matrix
[[0, I], [-M^-1 K, -M^-1 C]] (F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43, 2001).
"""

from __future__ import annotations

import numpy as np

from mjcont.numerics.equations.algebra import cholesky, eigenvectors, inverses, solve
from mjcont.numerics.equations.problem import Array, Pencil
from mjcont.numerics.spectra.spectrum import symmetric

# below this part of the largest, damping is none; entries within this part of the largest count as equally large
_NONE, _AS_LARGE = 1e-14, 1e-6
# an imaginary part below this part of the size belongs to a real eigenvalue
_REAL = 1e-9


def vibration(pencil: Pencil) -> tuple[Array, Array]:
    """Return eigenvalues (m,) with imaginary part >= 0, by rising size, and their vectors as rows (m, n).

    Of a conjugate pair one is returned. A vector has phi^H M phi = 1 (length 1 without a mass), is turned in the
    complex plane until it is as real as possible, and its largest entry, weighted by its mass, is positive. NaN
    where the pencil has no eigenvalues.
    """
    mass, damping, stiffness = pencil.mass, pencil.damping, np.asarray(pencil.stiffness)
    if mass is None or damping is None:
        s, shapes = eigenvectors(-stiffness)
        mass = np.eye(len(stiffness))
    elif np.abs(damping).max(initial=0.0) == 0.0 and symmetric(stiffness):
        s, shapes = _undamped(mass, stiffness)
    else:
        s, shapes = _damped(mass, damping, stiffness)
    s, shapes = np.asarray(s, complex), np.asarray(shapes, complex)
    s = np.where(np.abs(s.imag) <= _REAL * np.abs(s), s.real, s)
    kept = np.flatnonzero(~(s.imag < 0))
    order = kept[np.lexsort((s[kept].real, np.abs(s[kept])))]
    return s[order], np.array([_normalised(shapes[:, i], mass) for i in order]).reshape(len(order), len(mass))


def frequency_response(pencil: Pencil, omega: Array, load: Array) -> Array:
    """Return x of (K + i w C - w^2 M) x = load for each w of `omega` (m,), (m, n); NaN where it is singular."""
    k, c = np.asarray(pencil.stiffness), pencil.damping
    c = np.eye(len(k)) if c is None else c
    m = np.zeros_like(k) if pencil.mass is None else pencil.mass
    # one by one: where one is singular, only that one has no answer
    return np.array([solve(k + 1j * w * c - w**2 * m, load) for w in omega], dtype=complex).reshape(-1, len(k))


def _undamped(mass: Array, stiffness: Array) -> tuple[Array, Array]:
    """Solve K phi = w^2 M phi in the coordinates in which M is the identity: s = i w, or +-sqrt(-w^2)."""
    lower = inverses(cholesky(mass))
    reduced = lower @ (0.5 * (stiffness + stiffness.T)) @ lower.T
    if not np.isfinite(reduced).all():
        return np.full(len(mass), complex(np.nan, np.nan)), np.full(mass.shape, np.nan)
    squares, vectors = np.linalg.eigh(reduced)
    shapes, growing = lower.T @ vectors, squares < 0
    rates = np.sqrt(np.abs(squares))
    s = np.concatenate([np.where(growing, rates, 1j * rates), -rates[growing]])
    return s, np.hstack([shapes, shapes[:, growing]])


def _damped(mass: Array, damping: Array, stiffness: Array) -> tuple[Array, Array]:
    """Solve by the companion matrix, time scaled by the fastest rate."""
    n = len(mass)
    both = solve(mass, np.hstack([stiffness, damping]))
    rate = max(float(np.sqrt(np.abs(both[:, :n]).max())), float(np.abs(both[:, n:]).max()), 1e-150)
    block = np.zeros((2 * n, 2 * n))
    block[:n, n:], block[n:, :n], block[n:, n:] = np.eye(n), -both[:, :n] / rate**2, -both[:, n:] / rate
    s, vectors = eigenvectors(block)
    return s * rate, vectors[:n]


def _normalised(shape: Array, mass: Array) -> Array:
    size = float(np.sqrt(max(np.vdot(shape, mass @ shape).real, 0.0)))
    if not size > 0.0:
        return shape
    turn = shape @ mass @ shape  # its phase is twice that by which the vector is turned from the real axis
    shape = shape / size * np.exp(-0.5j * np.angle(turn))
    weight = np.abs(shape) * np.sqrt(np.abs(np.diag(mass)))
    largest = shape[np.flatnonzero(weight >= (1.0 - _AS_LARGE) * weight.max())[0]]
    return np.asarray(-shape if largest.real < 0 else shape)
