"""Which controls hold a pose: the equilibrium with its stability, or what is left over."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.results.model import Model
from mjcont.results.points import Point, show
from mjcont.results.text import Cells, Shown, Tabular


@dataclass(frozen=True, slots=True, repr=False)
class Hold(Tabular, Shown):
    """The controls that hold a pose, or the reason why none do; SI and radians.

    Attributes
    ----------
    held : bool
    status : {"held", "beyond range", "not held", "not converged"}
    message : str
        A sentence.
    controls : mapping of parameter to its value: of least norm; where nothing holds the pose, the nearest to it.
    wanted : mapping of parameter to the value of least norm without ranges.
    at_limit : mapping of parameter to "low" or "high", for those at an end of their range.
    point : Point or None
        The equilibrium, with stability: the pose after what connects its parts has yielded to the load.
    state : (nq,) that pose.
    pose : (nq,) the one asked for.
    shift : mapping of coordinate to how far it moved between them, m and rad.
    left : mapping of coordinate to the generalised force (N, N m) that nothing balances; empty where the pose is held.
    problem : the Mechanism or VectorField.
    evaluations : int
    """

    held: bool
    status: str
    message: str
    controls: Mapping[str, float]
    wanted: Mapping[str, float]
    at_limit: Mapping[str, str]
    point: Point | None
    state: Array = field(repr=False)
    pose: Array = field(repr=False)
    shift: Mapping[str, float] = field(repr=False)
    left: Mapping[str, float]
    problem: Model = field(repr=False)
    evaluations: int = 0

    @property
    def norm(self) -> float:
        """The Euclidean norm of the controls."""
        return float(np.linalg.norm(list(self.controls.values())))

    @property
    def stability(self) -> str:
        """The equilibrium's stability, empty where there is none."""
        return self.point.stability if self.point is not None else ""

    def plot(self, *, ax: Any = None) -> Any:
        """Draw the controls, each in the unit of its own, beside those without ranges; return the axes."""
        from mjcont.drawing.charts import draw_controls

        return draw_controls(self, ax)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        del degrees
        names = list(self.controls)
        yield "control", "", names
        yield "unit", "", [self.problem.parameters[n].unit or "1" for n in names]
        yield "value", "", np.array([self.controls[n] for n in names])
        yield "without ranges", "", np.array([self.wanted[n] for n in names])
        yield "at", "", [self.at_limit.get(n, "") for n in names]

    def __str__(self) -> str:
        """Return the sentence, the controls and the equilibrium."""
        lines = [f"{self.message} ({self.evaluations} evaluations)"]
        for name, value in self.controls.items():
            limit = f" ({self.at_limit[name]} end of its range)" if name in self.at_limit else ""
            lines.append(f"  {name} = {show(value, self.problem.parameters[name].unit)}{limit}")
        lines += [f"  {self.point}"] if self.point is not None else []
        return "\n".join(lines)
