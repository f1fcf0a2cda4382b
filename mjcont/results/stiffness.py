"""How a special point converges as the bushes of a mechanism stiffen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.results.branch import Branch
from mjcont.results.points import SpecialPoint, show
from mjcont.results.text import Shown


@dataclass(frozen=True, slots=True, repr=False)
class StiffnessStudy(Shown):
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
        from mjcont.drawing.charts import draw_stiffness

        return draw_stiffness(self, ax)
