"""Stability of an equilibrium from its pencil s^2 M + s C + K.

When K and C are symmetric and C is positive semidefinite, the number of unstable eigenvalues is the number of
negative eigenvalues of K and no Hopf point can exist (Kelvin-Tait-Chetaev); modes that the damping does not reach
make a point marginal, not unstable. Otherwise the whole spectrum decides, with a margin for the noise of the
difference derivatives.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import ArpackError, LinearOperator, eigs, splu

from mjcont.numerics.equations.algebra import (
    cholesky,
    eigenvalues,
    full,
    inverses,
    singular,
    solve,
    symmetric_eigenvalues,
)
from mjcont.numerics.equations.differences import SECOND_ORDER
from mjcont.numerics.equations.problem import Array, Pencil
from mjcont.numerics.spectra.large import NEAREST, NOISE, SMALL, positive_count, rightmost

STABLE, UNSTABLE, MARGINAL = "stable", "unstable", "marginal"
# what differences leave of symmetry, in parts of the largest entry, and rounding, in parts of an entry itself
_SYMMETRY_NOISE, _SAME = 1e-8, 1e-12
DIFFERENCE_NOISE = 1e-10
_ROUNDING = 1e-13
_EIGENSOLVER = 1e-15
# noise of eigenvalues of a first-order system, in parts of the largest entry and of themselves
_FIRST_ORDER, _RELATIVE = 1e-11, 1e-12
# entries of the stiffness matrices whose spectra are computed together
_ENTRIES = 2**17
# a shift beside zero in parts of the slowest rate that n equal springs and masses in a row have
_BESIDE = 1e-3


@dataclass(frozen=True, slots=True)
class Spectrum:
    """Eigenvalues and what they say.

    Attributes
    ----------
    eigenvalues : (N,) complex, in 1/s, by falling real part (for large sparse problems those that decide).
    stability : "stable", "unstable" or "marginal".
    n_unstable : number of eigenvalues with positive real part beyond the noise.
    noise : (N,) how far from the axis each eigenvalue must be to be told from it.
    conservative : whether symmetric K and C exclude Hopf points.
    complete : whether `eigenvalues` has all of them.
    proven : whether `n_unstable` is known to count all that are unstable, not only those among `eigenvalues`.
    """

    eigenvalues: Array
    stability: str
    n_unstable: int
    noise: Array
    conservative: bool
    complete: bool = True
    proven: bool = True

    def pair_count(self) -> int:
        """Return how many pairs of eigenvalues have a positive sum (complex pairs, and pairs of real ones).

        It changes by one at a Hopf point or a neutral saddle and nowhere else. Pairs whose sum is zero within the
        noise are left out: undamped oscillations, and the real pairs into which they turn at a fold.
        """
        return int(pair_counts(self.eigenvalues, self.noise))

    def oscillations(self) -> int:
        """Return how many complex pairs are unstable."""
        return int(np.count_nonzero((self.eigenvalues.imag > 0) & (self.eigenvalues.real > self.noise)))

    def pairs_passing(self, other: Spectrum) -> int:
        """Return how many pairs, at least, pass the axis between two spectra of a curve.

        As `pair_count` tells; where only the unstable ones are known for certain, as many as their number tells: a fold
        beside changes it by one, and unstable pairs that meet become real without passing.
        """
        change = abs(self.n_unstable - other.n_unstable)
        if self.complete and other.complete:
            return abs(self.pair_count() - other.pair_count())
        return change // 2 + int(change == 1 and self.oscillations() != other.oscillations())


def pair_counts(ev: Array, noise: Array) -> Array:
    """Return `Spectrum.pair_count` for eigenvalues (..., N) and their noise."""
    of_real, above = ev.imag == 0, ev.real > noise
    sums = (ev.real[..., :, None] + ev.real[..., None, :]) > (noise[..., :, None] + noise[..., None, :])
    both = np.triu(sums & of_real[..., :, None] & of_real[..., None, :], 1)
    found: Array = np.count_nonzero((ev.imag > 0) & above, axis=-1) + np.count_nonzero(both, axis=(-2, -1))
    return found


def spectrum(pencil: Pencil, scatter: Callable[[], Array] | None = None) -> Spectrum:
    """Return eigenvalues and stability of the pencil.

    Parameters
    ----------
    scatter : callable, optional
        Returns samples of f that differ by rounding only, (m, n). With them the noise of an eigenvalue near the axis
        is measured instead of bounded: stiff bushes make f noisy, but hardly along the mechanism's own mode.
    """
    if sparse.issparse(pencil.stiffness):
        return _sparse_spectrum(pencil.stiffness) if pencil.mass is None else _sparse_motion(pencil)
    if pencil.mass is None or pencil.damping is None:
        jac = -pencil.stiffness[None]
        return first_order_spectra(jac, eigenvalues(jac))[0]
    k, c = pencil.stiffness, pencil.damping
    if symmetric(k) and symmetric(c) and symmetric_eigenvalues(0.5 * (c + c.T))[0] >= -_ROUNDING * np.abs(c).max():
        return _conservative(pencil.mass[None], c[None], 0.5 * (k + k.T)[None])[0]
    ev = quadratic_eigenvalues(pencil.mass, c, k)
    if np.isnan(ev).any():
        return _undefined(len(ev))
    noise, zero = _noise_bound(pencil.mass, k, ev)
    close = np.flatnonzero(((np.abs(ev.real) <= noise) | zero) & (ev.imag >= 0))
    if scatter is not None and len(close):
        samples = scatter()
        for i in close:
            measured = _measured_noise(pencil.mass, c, k, ev[i], samples)
            settled = measured if zero[i] else min(measured, noise[i])
            noise[np.abs(ev - ev[i]) == 0] = noise[np.abs(ev - ev[i].conj()) == 0] = settled
    return _classify(ev, noise)


def _noise_bound(mass: Array, stiffness: Array, ev: Array) -> tuple[Array, Array]:
    """Return a bound on the error of each eigenvalue from the noise of a difference K, and whether it may be zero.

    The bound ignores the structure of K. A motion that nothing opposes or damps is a double eigenvalue 0, which the
    noise splits into a pair s with s^2 of the order of its error over the mass.
    """
    lightest = float(np.abs(np.diag(mass)).min())
    rate = np.maximum(np.abs(ev), max(np.sqrt(np.median(np.abs(ev))), 1e-300))
    square = DIFFERENCE_NOISE * np.abs(stiffness).max() / max(lightest, 1e-300)
    return np.minimum(square / rate, 1e-2 * np.abs(ev) + 1e-12), np.abs(ev) ** 2 <= square


def _measured_noise(mass: Array, damping: Array, stiffness: Array, s: complex, samples: Array) -> float:
    """Return the error of an eigenvalue from the scatter of p . f, p and q its left and right vectors.

    A column of K is a difference over the step of the stencil, so its error is the scatter over that step; the
    eigenvalue moves by p . dK q / p . P'(s) q (first-order perturbation); the eigensolver adds its backward error.
    """
    u, _, vh = singular(s**2 * mass + s * damping + stiffness)
    p, q = u[:, -1], vh[-1].conj()
    slope = abs(np.vdot(p, (2.0 * s * mass + damping) @ q))
    spread = float(np.std(samples @ p.conj()))
    size = abs(s) ** 2 * np.abs(mass).max() + abs(s) * np.abs(damping).max() + np.abs(stiffness).max()
    error = 4.0 * spread / SECOND_ORDER.step * float(np.linalg.norm(q)) + _EIGENSOLVER * size
    return float(error / max(slope, 1e-300))


def symmetric(matrix: Array) -> bool:
    """Return whether a difference matrix is symmetric as far as its noise tells."""
    return bool(np.abs(matrix - matrix.T).max() <= _SYMMETRY_NOISE * max(np.abs(matrix).max(), 1e-300))


def quadratic_eigenvalues(mass: Array, damping: Array, stiffness: Array) -> Array:
    """Return the 2 n eigenvalues of s^2 M + s C + K, scaled by the frequency of the largest stiffness.

    The matrices are (n, n), or stacks (N, n, n) that give (N, 2 n). NaN where the mass is singular.
    """
    n = mass.shape[-1]
    both = solve(mass, np.concatenate([stiffness, damping], axis=-1))
    k, c = both[..., :n], both[..., n:]
    rate = np.sqrt(np.maximum(np.abs(k).max(axis=(-2, -1)), 1e-300))[..., None, None]
    block = np.zeros((*mass.shape[:-2], 2 * n, 2 * n))
    block[..., :n, n:] = np.eye(n)
    block[..., n:, :n], block[..., n:, n:] = -k / rate**2, -c / rate
    found: Array = eigenvalues(block) * rate[..., 0]
    return found


def companion(mass: Array, damping: Array, stiffness: Array) -> Array:
    """Return the matrix of the first-order form of s^2 M + s C + K, (2 n, 2 n)."""
    n = len(mass)
    both = solve(mass, np.concatenate([stiffness, damping], axis=-1))
    out = np.zeros((2 * n, 2 * n))
    out[:n, n:], out[n:] = np.eye(n), -both
    return out


def conservative_spectra(pencils: Sequence[Pencil]) -> list[Spectrum]:
    """Return the spectra of pencils that are known to have a symmetric K and a symmetric, semidefinite C."""
    if any(sparse.issparse(p.stiffness) for p in pencils):
        return [spectrum(p) for p in pencils]
    found: list[Spectrum] = []
    many = max(_ENTRIES // max(len(pencils[0].stiffness), 1) ** 2, 1) if pencils else 1
    for first in range(0, len(pencils), many):
        part = pencils[first : first + many]
        mass, damping, k = (np.array([getattr(p, name) for p in part]) for name in ("mass", "damping", "stiffness"))
        found += _conservative(mass, damping, 0.5 * (k + k.transpose(0, 2, 1)))
    return found


def settles(pencil: Pencil, softest: float) -> bool:
    """Whether a pencil of full matrices is stable beyond doubt, without its eigenvalues.

    K and C are symmetric, C semidefinite, and `softest` is K's least eigenvalue. With a = x*Mx, b = x*Cx, c = x*Kx an
    eigenvalue solves a s^2 + b s + c = 0: -Re s is at least b / 2 a or c / b, and |s| at most b / a + (c / a)^1/2.
    """
    mass, damping, stiffness = pencil.mass, pencil.damping, pencil.stiffness
    if mass is None or damping is None or not softest > 0.0:
        return False
    largest, most, stiffest = (float(np.abs(m).sum(axis=1).max()) for m in (mass, damping, stiffness))
    lightest, least = float(symmetric_eigenvalues(mass)[0]), float(symmetric_eigenvalues(damping)[0])
    if not (lightest > 0.0 and least > 0.0):
        return False
    decay = min(least / (2.0 * largest), softest / most)
    fastest = most / lightest + float(np.sqrt(stiffest / lightest))
    noise = DIFFERENCE_NOISE * float(np.abs(stiffness).max()) / float(np.diag(mass).max())
    return bool(softest / largest > noise and decay > _ROUNDING * fastest)


def _conservative(mass: Array, damping: Array, stiffness: Array) -> list[Spectrum]:
    """Classify by the inertia of K; the damping only decides whether a mode with positive K is damped."""
    every = quadratic_eigenvalues(mass, damping, stiffness).astype(complex)
    order = np.lexsort((every.imag, -every.real))
    all_values = np.take_along_axis(every, order, axis=-1)
    lower = inverses(cholesky(mass))
    all_squares = symmetric_eigenvalues(lower @ stiffness @ lower.transpose(0, 2, 1))
    found = []
    for m, k, ev, squares in zip(mass, stiffness, all_values, all_squares, strict=True):
        if np.isnan(squares).any() or np.isnan(ev).any():
            found.append(_undefined(len(ev)))
            continue
        noise = DIFFERENCE_NOISE * np.abs(k).max() / np.diag(m).max()
        negative = int(np.count_nonzero(squares < -noise))
        rounding = _ROUNDING * float(np.abs(ev).max(initial=0.0))
        margin = np.full(len(ev), rounding)
        touching = np.any(np.abs(squares) <= noise) or np.any(np.abs(ev.real) <= rounding)
        state = UNSTABLE if negative else MARGINAL if touching else STABLE
        found.append(Spectrum(ev, state, negative, margin, True))
    return found


def _undefined(count: int) -> Spectrum:
    """Return the spectrum of a pencil that has none, such as one that is not finite or whose mass is singular."""
    return Spectrum(np.full(count, complex(np.nan, np.nan)), MARGINAL, 0, np.full(count, np.inf), False)


def first_order_spectra(jacs: Array, ev: Array) -> list[Spectrum]:
    """Return the spectra of first-order systems with matrices J (m, n, n), given their eigenvalues (m, n)."""
    size = np.abs(jacs).max(axis=(1, 2), initial=0.0)[:, None]
    return _classified(ev, _FIRST_ORDER * size + _RELATIVE * np.abs(ev))


def _classify(ev: Array, noise: Array) -> Spectrum:
    return _classified(ev[None], noise[None])[0]


def _classified(ev: Array, noise: Array) -> list[Spectrum]:
    """Return the spectra with eigenvalues (m, N) that are to be told from the axis by more than their noise (m, N)."""
    order = np.lexsort((ev.imag, -ev.real))
    ev, noise = (np.take_along_axis(a, order, axis=1) for a in (ev.astype(complex), noise))
    counts = np.count_nonzero(ev.real > noise, axis=1).tolist()
    touching: list[bool] = np.any(np.abs(ev.real) <= noise, axis=1).tolist()
    undefined: list[bool] = np.any(np.isnan(ev), axis=1).tolist()
    found = []
    for i, count in enumerate(counts):
        state = UNSTABLE if count else MARGINAL if touching[i] else STABLE
        found.append(_undefined(ev.shape[1]) if undefined[i] else Spectrum(ev[i], state, count, noise[i], False))
    return found


def _sparse_spectrum(stiffness: Any) -> Spectrum:
    """Return the spectrum of J = -K, sparse: all of it where J is small, else what decides on stability."""
    jac = -stiffness
    size = float(abs(jac).max())
    # entry by entry: beside one stiff unknown all others would pass for symmetric
    same = bool((abs(jac - jac.T) - _SAME * (abs(jac) + abs(jac.T))).max() <= 0.0)
    if jac.shape[0] <= SMALL:
        dense = jac.toarray()
        if not (same and np.isfinite(size)):
            return spectrum(Pencil(None, None, -dense))
        values = symmetric_eigenvalues(0.5 * (dense + dense.T))
        return replace(_classify(values, np.full(len(values), NOISE * size)), conservative=True)
    found = rightmost(jac, same)
    s = _classify(found.values, np.full(len(found.values), found.noise))
    if not np.isfinite(found.noise):
        return replace(s, complete=False, proven=False)
    state = UNSTABLE if found.unstable else s.stability if found.proven and not found.touching else MARGINAL
    return replace(s, stability=state, n_unstable=found.unstable, conservative=found.symmetric, complete=False,
                   proven=found.proven)


def _sparse_motion(pencil: Pencil) -> Spectrum:
    """Count by the inertia of K where that decides, with the slowest eigenvalues; else take the matrices in full."""
    mass, damping, stiffness = pencil.mass, pencil.damping, pencil.stiffness
    assert mass is not None and damping is not None
    size, n = abs(stiffness).max(), stiffness.shape[0]
    if not np.isfinite(size):
        return _undefined(min(NEAREST, 2 * n))
    if n <= SMALL:
        return spectrum(full(pencil))
    slight = _ROUNDING * abs(damping).max()
    drained = not slight or positive_count(-damping - slight * sparse.identity(n, format="csc")) == 0
    if drained and symmetric(stiffness) and symmetric(damping):
        noise = DIFFERENCE_NOISE * size / mass.diagonal().max() * mass
        k = 0.5 * (stiffness + stiffness.T)
        negative, below = positive_count(-k - noise), positive_count(noise - k)
        ev = _slowest(mass, damping, k)
        if negative is not None and below is not None and ev is not None:
            rounding = np.full(len(ev), _ROUNDING * float(np.abs(ev).max()))
            touching = below > negative or np.any(np.abs(ev.real) <= rounding)
            state = UNSTABLE if negative else MARGINAL if touching else STABLE
            return Spectrum(ev, state, negative, rounding, True, complete=False)
    return spectrum(full(pencil))


def _slowest(mass: Any, damping: Any, stiffness: Any) -> Array | None:
    """Return the eigenvalues of s^2 M + s C + K nearest zero, by inverse iteration of its first-order form.

    With z = (x, s x) the form is (A - s B) z = 0, and (A - r B)^-1 B (a, b) = (u, a + r u), where u solves
    P(r) u = -M b - (C + r M) a. None where that fails.
    """
    n = stiffness.shape[0]
    shift = _BESIDE * float(np.sqrt(abs(stiffness).max() / mass.diagonal().max())) / n
    inner = (damping + shift * mass).tocsr()
    try:
        factors = splu((stiffness + shift * damping + shift**2 * mass).tocsc())

        def inverse(z: Array) -> Array:
            u = -factors.solve(mass @ z[n:] + inner @ z[:n])
            return np.concatenate([u, z[:n] + shift * u])

        start = np.cos(np.arange(2.0 * n))
        found = eigs(
            LinearOperator((2 * n, 2 * n), inverse, dtype=float), k=NEAREST, v0=start, return_eigenvectors=False
        )
    except (ArpackError, RuntimeError):  # no convergence, or exactly singular
        return None
    ev: Array = shift + 1.0 / found
    order = np.lexsort((ev.imag, -ev.real))
    return np.asarray(ev[order])
