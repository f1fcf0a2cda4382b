"""Every branch through a point at which several eigenvalues vanish: where curves pierce a small sphere around it.

The quadratic form that gives the two tangents of a simple branch point decides nothing there. On the sphere the curves
are isolated roots of f = 0, |z - z0| = r, which Newton's method finds from directions in the kernel of [J f_p].
"""

from __future__ import annotations

from itertools import product

import numpy as np

from mjcont.numerics.equations.algebra import dense, singular
from mjcont.numerics.equations.bordered import Factored
from mjcont.numerics.equations.newton import length, matrix_with_row
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System

_DIRECTIONS, _MOST_ZEROS = 60, 4
_ITERATIONS, _CLOSE = 30, 1e-10
# directions nearer to each other than this are one; a direction and its opposite bend apart by as much at the radius
_SAME, _OPPOSITE = 1e-3, 0.1


def ways_through(system: System, x: Array, y: Array, vanishing: int, radius: float) -> list[tuple[Array, Array | None]]:
    """Return where the branches through a point pierce a sphere: steps (n + 1,) from it, scaled, in pairs.

    The second of a pair lies opposite the first, on the same branch; it is None where nothing does.

    Parameters
    ----------
    x, y : the point, and its parameter as a coordinate.
    vanishing : how many eigenvalues vanish there.
    radius : of the sphere, scaled.
    """
    found = list[Array]()
    for direction in _around(system, x, y, vanishing):
        z = _pierced(system, x, y, radius * direction)
        if z is not None and all(length(z - other) > _SAME * radius for other in found):
            found.append(z)
    return _paired(found)


def _around(system: System, x: Array, y: Array, vanishing: int) -> Array:
    """Return unit vectors in the kernel of [J f_p] in all directions, (m, n + 1)."""
    jac = system.jacobian(system.local(x, y), y)
    matrix = dense(jac)
    if not np.isfinite(matrix).all():
        return np.zeros((0, matrix.shape[1]))
    kernel = singular(matrix)[2][-(min(vanishing, _MOST_ZEROS) + 1) :]
    k = len(kernel)
    corners = np.array([c for c in product((-1.0, 0.0, 1.0), repeat=k) if any(c)])
    every = np.vstack([corners, np.random.default_rng(0).normal(size=(_DIRECTIONS * (k - 1), k))])
    found: Array = (every / np.linalg.norm(every, axis=1)[:, None]) @ kernel
    return found


def _pierced(system: System, x: Array, y: Array, z: Array) -> Array | None:
    """Return where Newton's method ends on the sphere on which it begins, None where it does not settle."""
    radius = length(z)
    for _ in range(_ITERATIONS):
        x1, y1 = system.move(x, y, z)
        local = system.local(x1, y1)
        r = np.append(system.residual(local, y1), 0.5 * (z @ z - radius**2) / radius)
        if not np.isfinite(r).all():
            return None
        step = -Factored(matrix_with_row(system, local, y1, z / radius)).solve(r)
        size = length(step)
        if not np.isfinite(size):
            return None
        z = z + step * min(1.0, 0.5 * radius / size) if size > 0.0 else z
        if size <= _CLOSE * max(radius, 1e-3):
            return z if abs(length(z) - radius) < 1e-3 * radius else None
    return None


def _paired(found: list[Array]) -> list[tuple[Array, Array | None]]:
    """Return each two steps that are nearly opposite, that along which the parameter grows first, and those alone."""
    left, pairs = list(found), list[tuple[Array, Array | None]]()
    while left:
        one = left.pop(0)
        j = min(range(len(left)), key=lambda j: length(one + left[j]), default=None)
        if j is None or length(one + left[j]) > _OPPOSITE * length(one):
            pairs.append((one, None))
            continue
        other = left.pop(j)
        pairs.append((other, one) if other[-1] > one[-1] else (one, other))
    return pairs
