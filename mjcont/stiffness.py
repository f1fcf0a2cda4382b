"""Convergence in joint stiffness: from which stiffness on a special point is that of the rigid mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.branch import Branch, SpecialPoint, show
from mjcont.errors import MjcontError
from mjcont.escapes import for_picture
from mjcont.loci import continue_special
from mjcont.numerics.problem import Array


@dataclass(frozen=True, slots=True)
class StiffnessStudy:
    """How a special point converges as bushes stiffen.

    Attributes
    ----------
    locus : Branch
        The special point's locus in its own parameter and the stiffness.
    parameter, quantity : str
        The stiffness, and the column that is watched.
    tol : float
        Relative deviation from the limit that counts as converged.
    limit : float
        The column's value for rigid joints, extrapolated in 1 / stiffness.
    converged_from : float or None
        The smallest stiffness from which on the deviation stays within `tol`; None if it never does.
    turns : labelled points at which the locus is not single valued in the stiffness (CP and BP).
    """

    locus: Branch
    parameter: str
    quantity: str
    tol: float
    limit: float
    converged_from: float | None
    turns: Sequence[SpecialPoint]

    @property
    def deviation(self) -> Array:
        """Relative deviation from the limit at every point of the locus."""
        return np.abs(self.locus[self.quantity] - self.limit) / max(abs(self.limit), 1e-300)

    def __str__(self) -> str:
        """Return the answer in a sentence."""
        unit = self.locus.unit(self.parameter)
        limit = show(self.limit, self.locus.unit(self.quantity))
        head = f"{self.quantity} -> {limit} for rigid joints"
        if self.converged_from is None:
            return f"{head}; not converged to {self.tol:g} within the bounds of {self.parameter}"
        return f"{head}; within {self.tol:g} of it from {self.parameter} = {show(self.converged_from, unit, 3)} on"

    def plot(self, ax: Any = None) -> Any:
        """Draw the deviation against the stiffness, both logarithmic, and return the axes."""
        from mjcont.pathplots import axis_label
        from mjcont.plotting import new_figure

        axes = new_figure()[1] if ax is None else ax
        k, deviation = self.locus[self.parameter], self.deviation
        axes.loglog(k, np.maximum(deviation, 1e-16), color="black")
        axes.axhline(self.tol, color="0.6", linestyle="--", linewidth=0.8)
        if self.converged_from is not None:
            axes.axvline(self.converged_from, color="0.6", linestyle=":", linewidth=1.0)
        axes.set_xlabel(axis_label(self.parameter, self.locus.unit(self.parameter), degrees=False))
        axes.set_ylabel(f"relative deviation of {for_picture(self.quantity)} from its limit")
        return axes


def stiffness_study(
    mechanism: Any,
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
    if getattr(point.problem, "mjcf", None) != getattr(mechanism, "mjcf", None):
        raise MjcontError(f"{point.label} belongs to another model than '{mechanism.name}'")
    own = mechanism.parameter(parameter).bounds
    value = point.parameters.get(parameter, mechanism.parameter(parameter).value)  # a path may be new to the point
    span = bounds or (max(own[0], value * 1e-3), min(own[1], value * 1e3))
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
