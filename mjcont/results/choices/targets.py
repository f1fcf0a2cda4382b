"""A design that meets targets with the least change: before and after, what holds it there and what that costs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.errors import MjcontError, unknown_name
from mjcont.results.branch import Branch
from mjcont.results.model import Model
from mjcont.results.points import Point, SpecialPoint, show
from mjcont.results.text import Cells, Shown, Tabular, table
from mjcont.results.units import displayed, sized


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a target or limit in one load case; SI and radians.

    Attributes
    ----------
    text : as it was written.
    point, quantity, relation, value, unit : what it says.
    load : parameter values of the load case; empty for those of the point itself.
    before, after : the quantity at today's design and at the new one.
    met : bool
    active : whether it holds the design where it is.
    multiplier : change of the objective with the value that is asked for.
    cost : in words, such as "1 kN less costs 3 mm of L_3"; empty unless active.
    """

    text: str
    point: str
    quantity: str
    relation: str
    value: float
    unit: str
    load: Mapping[str, float]
    before: float
    after: float
    met: bool
    active: bool
    multiplier: float
    cost: str = ""

    @property
    def name(self) -> str:
        """The quantity with its point."""
        return f"{self.point}.{self.quantity}"

    def __str__(self) -> str:
        """Return the statement with its value as shown."""
        return f"{self.name} {self.relation} {in_size(self.value, self.unit)}"


@dataclass(frozen=True, slots=True, repr=False)
class Design(Tabular, Shown):
    """Parameters chosen so that targets are met; SI and radians.

    Attributes
    ----------
    status : {"met", "conflict", "at the edge", "not converged"}
    met : bool
        Whether every condition holds.
    message : str
        A sentence; where conditions exclude each other it names them.
    parameters, before : mapping of parameter to its value, new and today's.
    ranges, scales : mapping of parameter to its bounds, and to the change that counts as one.
    objective : float
        The sum of the squares of the changes in their scales, or what was to be least.
    conditions : sequence of Outcome
        Every target and limit, in each load case.
    at_bound : mapping of parameter to "low" or "high", for those at a bound.
    kkt : float
        Largest component of the gradient of the Lagrangian, projected on the bounds: zero at a best design.
    starts : number of starts that end at this design, and number of starts.
    cuts : sentences on where points ceased to exist, so that steps were cut.
    points, points_before : mapping of name to Point, at the new design and at today's, as far as they exist there.
    path : parameters at each box in which the optimiser worked.
    problem : the Mechanism or VectorField.
    evaluations : int
    """

    status: str
    met: bool
    message: str
    parameters: Mapping[str, float]
    before: Mapping[str, float]
    ranges: Mapping[str, tuple[float, float]] = field(repr=False)
    scales: Mapping[str, float] = field(repr=False)
    objective: float
    conditions: Sequence[Outcome]
    at_bound: Mapping[str, str]
    kkt: float
    starts: tuple[int, int]
    cuts: Sequence[str]
    points: Mapping[str, Point] = field(repr=False)
    points_before: Mapping[str, Point] = field(repr=False)
    path: Sequence[Mapping[str, float]] = field(repr=False)
    problem: Model = field(repr=False)
    evaluations: int = 0

    @property
    def active(self) -> list[Outcome]:
        """The conditions that hold the design where it is."""
        return [c for c in self.conditions if c.active]

    def __getitem__(self, name: str) -> float:
        """Return a parameter of the new design."""
        if name not in self.parameters:
            raise unknown_name("parameter", name, self.parameters)
        return self.parameters[name]

    def diagrams(self, point: str | None = None, **options: Any) -> tuple[Branch, Branch]:
        """Return the curves of equilibria through a point, before and after, in its first free parameter.

        Parameters
        ----------
        point : str, optional
            One of `points`, a special point; default the first.
        **options
            Of `continue_equilibria`.
        """
        from mjcont.curves.continuation import continue_equilibria

        name = point or next(iter(self.points))
        if name not in self.points:
            raise unknown_name("point", name, self.points)
        old, new = self.points_before[name], self.points[name]
        if not isinstance(old, SpecialPoint) or not isinstance(new, SpecialPoint) or not old.free:
            raise MjcontError(f"{name} is no special point of a curve: no parameter is free there")
        free, (low, high) = next(iter(old.free.items()))
        reach = low, max(high, new[free] + 0.1 * (high - low))
        reach = min(reach[0], new[free] - 0.1 * (high - low)) if new[free] < low else low, reach[1]
        return (
            continue_equilibria(self.problem, free, reach, old, **options),
            continue_equilibria(self.problem, free, reach, new, **options),
        )

    def plot(self, point: str | None = None, y: str | None = None, *, ax: Any = None) -> Any:
        """Draw the changes of the parameters; with `y` the diagrams through a point, before and after; return the axes.

        Parameters
        ----------
        point : str, optional
            One of `points`; default the first.
        y : str, optional
            The observable to draw against the point's free parameter.
        ax : matplotlib Axes, optional
        """
        from mjcont.drawing.charts import draw_changes
        from mjcont.drawing.plotting import plot

        if y is None and point is None:
            return draw_changes(self, ax)
        before, after = self.diagrams(point)
        return plot(before, after, x=next(iter(before.free)), y=y or next(iter(self.problem.observables)), ax=ax)

    def to_xml(self, path: str | Path, *, source: str | Path | None = None) -> Path:
        """Write the model's MJCF with the new numbers, everything else in it as it is, comments too; return the path.

        Parameters
        ----------
        source : path or text, optional
            The MJCF to edit; default what the mechanism was loaded from.

        Raises
        ------
        ModelError, ParameterError
            If a parameter has no attribute of its own in the text: which, and why.
        """
        from mjcont.mechanism.written.edit import rewritten
        from mjcont.outside.saving import write_file

        text = rewritten(self.problem, self.parameters, source)
        write_file(Path(path), text)
        return Path(path)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        del degrees
        names = list(self.parameters)
        units = [self.problem.parameters[n].unit for n in names]
        yield "parameter", "", names
        yield "unit", "", [u or "1" for u in units]
        yield "before", "", np.array([self.before[n] for n in names])
        yield "after", "", np.array([self.parameters[n] for n in names])
        yield "lowest", "", np.array([self.ranges[n][0] for n in names])
        yield "highest", "", np.array([self.ranges[n][1] for n in names])
        yield "at", "", [self.at_bound.get(n, "") for n in names]

    def __str__(self) -> str:
        """Return the sentence, parameters and conditions before and after, and what the active ones cost."""
        unit_of = self.problem.parameters
        rows = [["parameter", "before", "after", "change"]]
        for n, v in self.parameters.items():
            unit, moved = unit_of[n].unit, v - self.before[n]
            bound = f" ({self.at_bound[n]} bound)" if n in self.at_bound else ""
            rows.append([n, show(self.before[n], unit, 6), show(v, unit, 6) + bound, _signed(moved, unit)])
        lines = [self.message, *table(rows)]
        rows = [["condition", "before", "after", ""]]
        for c in _nearer(self.conditions):
            load = ", ".join(f"{n} = {show(v, unit_of[n].unit, 4)}" for n, v in c.load.items())
            word = "not met" if not c.met else "active" if c.active else ""
            rows.append([f"{c}{' at ' if load else ''}{load}", show(c.before, c.unit), show(c.after, c.unit), word])
        lines += table(rows)
        lines += [f"  {c}: {c.cost}" for c in self.conditions if c.cost]
        lines += [f"  {sentence}" for sentence in self.cuts]
        kkt = f"gradient of the Lagrangian {self.kkt:.1e}; " if self.met else ""
        return "\n".join([*lines, f"  {kkt}{self.evaluations} evaluations"])


def in_size(value: float, unit: str, size: float | None = None) -> str:
    """Return a value with the unit in which its size, or another one, reads well: kN, mm, deg."""
    shown, factor = displayed(unit)
    shown, larger = sized(shown, abs(value if size is None else size))
    return f"{value * factor * larger:.7g} {shown}".rstrip().removesuffix(" 1")


def _nearer(conditions: Sequence[Outcome]) -> list[Outcome]:
    """Return the conditions, of the two that a limit on |...| is the one that is nearer to its value."""
    found: dict[tuple[str, str], Outcome] = {}
    for c in conditions:
        key = c.text, repr(dict(c.load))
        other = found.get(key)
        if other is None or abs(c.after - c.value) < abs(other.after - other.value):
            found[key] = c
    return list(found.values())


def _signed(value: float, unit: str) -> str:
    text = show(abs(value), unit, 4)
    return text if value == 0.0 else f"{'-' if value < 0 else '+'}{text}"
