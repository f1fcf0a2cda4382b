"""How well a mesh resolves an orbit, and a mesh that does better.

On each interval the derivative is a polynomial; its Legendre coefficients c_0 .. c_{m-1} decay by about a factor rho
each. The states at the ends of the intervals err like the rule that integrates it, by c_0 rho^order, and the mesh is
laid so that the last coefficients are of one size everywhere. Source: Russell and Christiansen, Adaptive mesh
selection strategies for solving boundary value problems (SIAM J. Numer. Anal. 15, 1978), with Legendre coefficients
for differences.
"""

from __future__ import annotations

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.path import Path

# part of a mesh that is laid evenly whatever the orbit, and parts of neighbours that an interval takes on
_EVEN, _SHARED = 0.2, 0.25
# a coefficient counts as no smaller than this part of the largest of its interval: rounding
_ROUNDING = 1e-15
# measured on orbits that are known: decay is quicker than the coefficients at hand tell
_QUICKER = 1e-2
_MARGIN = 1.3
# what the number of samples counts beside the length of their way in a first mesh
_COUNTED = 2.0


def _coefficients(path: Path, sizes: Array) -> Array:
    """Return the sizes of the Legendre coefficients of h u', relative to the state's sizes, (N, m)."""
    rates = path.w
    if path.order == 2:
        h = (path.period * path.lengths)[:, None, None]
        velocities = path.s[:-1, None, path.c :] + (path.scheme.a @ path.w) / h
        rates = np.concatenate([h * velocities, path.w / h], axis=2)
    found: Array = np.abs(path.scheme.coefficients @ rates / sizes).max(axis=2)
    return found


def _decay(sizes: Array) -> tuple[Array, Array, Array]:
    """Return the largest and the last coefficient, and the factor by which they decay, (N,) each."""
    top = np.maximum(sizes.max(axis=1), 1e-300)
    last = np.maximum(sizes[:, -1], np.sqrt(_ROUNDING) * sizes[:, -2] if sizes.shape[1] > 1 else 0.0)
    last = np.maximum(last, _ROUNDING * top)
    power = max(sizes.shape[1] - 1, 1)
    return top, last, (last / top) ** (1.0 / power)


def error_of(path: Path, sizes: Array) -> float:
    """Return an estimate of the discretisation's error in the states at the mesh, relative to their sizes (d,)."""
    top, _, rho = _decay(_coefficients(path, sizes))
    each = top * np.minimum(rho, 1.0) ** path.scheme.order
    return float(_QUICKER * np.sqrt(len(each)) * np.linalg.norm(each))


def equidistributed(path: Path, sizes: Array, count: int) -> Array:
    """Return a mesh of `count` intervals on which the last coefficients are about equal, (count + 1,)."""
    _, last, _ = _decay(_coefficients(path, sizes))
    density = last ** (1.0 / path.scheme.degree) / path.lengths
    density = (1.0 - 2.0 * _SHARED) * density + _SHARED * (np.roll(density, 1) + np.roll(density, -1))
    density = density + _EVEN / (1.0 - _EVEN) * (density @ path.lengths)
    return _levelled(path.mesh, density * path.lengths, count)


def first_mesh(samples: Array, tau: Array, count: int) -> Array:
    """Return a mesh of `count` intervals on which samples (k, d) at tau (k,) move by about equal lengths.

    Samples count themselves, too: an integrator took more of them where the motion bends.
    """
    spread = np.linalg.norm(np.diff(samples, axis=0) / np.maximum(np.ptp(samples, axis=0), 1e-300), axis=1)
    whole = spread.sum() or 1.0  # rest moves nowhere
    return _levelled(tau, spread + whole * (0.5 * np.diff(tau) + _COUNTED / len(spread)), count)


def _levelled(mesh: Array, shares: Array, count: int) -> Array:
    """Return the mesh on whose intervals the sum of `shares`, one for each interval of `mesh`, is the same."""
    grown = np.concatenate([[0.0], np.cumsum(shares)])
    found = np.interp(np.linspace(0.0, grown[-1], count + 1), grown, mesh)
    found[0], found[-1] = 0.0, 1.0
    return found


def count_for(path: Path, error: float, tol: float) -> int:
    """Return how many intervals bring an error below a tolerance."""
    wanted = len(path.w) * _MARGIN * (max(error, 1e-300) / tol) ** (1.0 / path.scheme.order)
    return int(min(np.ceil(wanted), 1e6))
