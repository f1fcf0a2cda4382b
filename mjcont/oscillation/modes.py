"""The verb `modes`: small motions about an equilibrium, from its mass, damping and stiffness matrices."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import sparse

from mjcont.arguments import checked
from mjcont.errors import MjcontError
from mjcont.numerics.equations.algebra import full
from mjcont.numerics.equations.problem import Array, Pencil
from mjcont.numerics.spectra.spectrum import DIFFERENCE_NOISE, spectrum
from mjcont.numerics.spectra.vibration import vibration
from mjcont.results.linear import Mode, Modes
from mjcont.results.points import Point


def check_point(point: object) -> None:
    """Refuse what is no equilibrium."""
    if not isinstance(point, Point) or getattr(point, "orbit", None) is not None:
        raise MjcontError("modes belong to an equilibrium: a point of a branch, a search or find_equilibrium, got a "
                          f"{type(point).__name__}")


def linearized(point: Point, wrt: Sequence[str] = ()) -> tuple[Pencil, Array]:
    """Return the matrices of small motions about an equilibrium and df/dp of parameters, (n, len(wrt)).

    Raises
    ------
    MjcontError
        If the point is no equilibrium, has no model, or that is a sparse vector field.
    """
    check_point(point)
    model = point.model
    local = model.linearize(point.state, point.parameters, tuple(wrt), accurate=True)
    if sparse.issparse(local.jac) and not model.second_order:
        raise MjcontError(f"{model.name} has a sparse Jacobian: modes need a dense one")
    return full(model.pencil(point.state, point.parameters, local.jac)), local.par


@checked
@np.errstate(all="ignore")
def modes(point: Point) -> Modes:
    """Return frequencies, damping ratios and shapes of the modes at an equilibrium, stable or not.

    They solve (s^2 M + s C + K) shape = 0; a first-order vector field u' = f has M = 0, C = I, K = -df/du.

    Parameters
    ----------
    point : Point or SpecialPoint
        An equilibrium: a point of a branch or a search, or what `find_equilibrium` returns.

    Returns
    -------
    Modes
        By rising |s|; two real eigenvalues are two modes.

    Raises
    ------
    MjcontError
        If the point is no equilibrium, or its model has no dense matrices or no modes there.
    """
    pencil, _ = linearized(point)
    s, shapes = vibration(pencil)
    if not np.isfinite(s).all():
        raise MjcontError(f"{point.model.name} has no modes here: its matrices are not finite, or the mass is singular")
    told = spectrum(pencil)
    slow = _slow(pencil.mass, np.asarray(pencil.stiffness)) if told.conservative and pencil.mass is not None else 0.0
    found = []
    for i, (value, shape) in enumerate(zip(s, shapes, strict=True), 1):
        shape.flags.writeable = False
        noise = told.noise[int(np.argmin(np.abs(told.eigenvalues - value)))]
        swings = bool(value.imag != 0)
        # where symmetry excludes flutter K alone decides, and its noise is one of squares of rates
        unsure = abs(value) ** 2 <= slow if slow else abs(value.real) <= noise
        grows = bool(value.real > 0 and not unsure and not (slow and swings))
        found.append(Mode(i, complex(value), shape, grows, bool(unsure and (slow or not swings)), point))
    n = point.model.n
    mass = pencil.mass if pencil.mass is not None else np.zeros((n, n))
    damping = pencil.damping if pencil.damping is not None else np.eye(n)
    return Modes(point, tuple(found), mass, damping, np.asarray(pencil.stiffness), notes_of(point))


def _slow(mass: Array, stiffness: Array) -> float:
    """Return the square of a rate, in 1/s^2, below which differences do not tell a mode from a neutral one."""
    return float(DIFFERENCE_NOISE * np.abs(stiffness).max() / np.diag(mass).max())


def notes_of(point: Point) -> tuple[str, ...]:
    """Return what a reader of small motions about a point should know of its model."""
    held = tuple(getattr(point.model, "held", ()))
    own = (f"held, not free: {', '.join(held)}; such a motion shows as critically damped",) if held else ()
    return (*own, *getattr(point.model, "notes", ()))
