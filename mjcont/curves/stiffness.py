"""Convergence in joint stiffness: from which stiffness on a special point is that of the rigid mechanism."""

from __future__ import annotations

from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.loci import continue_special
from mjcont.errors import MjcontError
from mjcont.numerics.equations.problem import Array
from mjcont.results.model import Model
from mjcont.results.points import SpecialPoint
from mjcont.results.stiffness import StiffnessStudy


@checked
def stiffness_study(
    mechanism: Model,
    point: SpecialPoint,
    parameter: str = "k_j",
    tol: float = 1e-3,
    *,
    bounds: tuple[float, float] | None = None,
    quantity: str | None = None,
    **options: Any,
) -> StiffnessStudy:
    """Follow a special point in a stiffness and tell from which value on it has converged.

    Parameters
    ----------
    mechanism : Mechanism
        The one that `point` belongs to.
    point : SpecialPoint
        An LP, HB or BP of a branch of equilibria.
    parameter : str
        The stiffness.
    tol : float
        Relative deviation from the rigid limit that counts as converged.
    bounds : (low, high), optional
        Range of the stiffness; default three decades to both sides, within the parameter's own bounds.
    quantity : str, optional
        The column that is watched; default the first free parameter of the point.

    Raises
    ------
    MjcontError
        If the point belongs to another mechanism, or the locus does not reach stiff joints.
    """
    if point.model.mjcf != mechanism.mjcf:
        raise MjcontError(f"{point.label} belongs to another model than '{mechanism.name}'")
    own = mechanism.parameter(parameter).bounds
    value = point.parameters.get(parameter, mechanism.parameter(parameter).value)  # a path may be new to the point
    span = bounds if bounds is not None else (max(own[0], value * 1e-3), min(own[1], value * 1e3))
    locus = continue_special(point, parameter, bounds=span, **options)
    column = quantity or next(iter(point.free))
    rows = _stiffening(locus[parameter], locus.start_index)
    k, q = locus[parameter][rows], locus[column][rows]
    if k[0] <= value:
        raise MjcontError(f"the locus of {point.label} does not reach larger {parameter}: {locus.message}")
    limit = _extrapolated(k, q)
    deviation = np.abs(q - limit) / max(abs(limit), 1e-300)
    outside = deviation > tol
    turns = [p for p in locus.special_points if p.kind in ("CP", "BP")]
    converged: float | None
    if not outside.any():
        converged = float(k.min())
    else:
        converged = _crossing(k, deviation, tol)
    return StiffnessStudy(locus, parameter, column, tol, limit, converged, tuple(turns))


def _stiffening(k: Array, start: int) -> Array:
    """Return the rows of the run through `start` in which k changes monotonically, the stiffest first.

    A locus that turns may have other runs, with another limit.
    """
    low = high = start
    up = bool(np.argmax(k[[max(start - 1, 0), min(start + 1, len(k) - 1)]]) == 1)
    sign = 1.0 if up else -1.0
    while high + 1 < len(k) and sign * (k[high + 1] - k[high]) > 0:
        high += 1
    while low > 0 and sign * (k[low] - k[low - 1]) > 0:
        low -= 1
    rows = np.arange(low, high + 1)
    return rows[::-1] if up else rows


def _extrapolated(k: Array, q: Array) -> float:
    """Return the limit of q = limit + c / k from the stiffest point and one at half its stiffness or less."""
    other = int(np.argmax(k <= 0.5 * k[0]))
    a, b = 1.0 / k[0], 1.0 / k[other]
    return float((q[0] * b - q[other] * a) / (b - a))


def _crossing(k: Array, deviation: Array, tol: float) -> float | None:
    """Return the largest k at which the deviation crosses tol, interpolated on logarithms."""
    best: float | None = None
    for i in range(len(k) - 1):
        a, b = deviation[i] - tol, deviation[i + 1] - tol
        if a * b < 0:
            u, w = np.log(max(deviation[i], 1e-300)), np.log(max(deviation[i + 1], 1e-300))
            t = (np.log(tol) - u) / (w - u)
            at = float(np.exp((1 - t) * np.log(k[i]) + t * np.log(k[i + 1])))
            best = at if best is None else max(best, at)
    return best
