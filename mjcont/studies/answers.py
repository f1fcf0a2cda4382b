"""What a study's points mean: `[answer]` gives them names such as locks and unlocks, and asks how sure they are.

Of each: its value, how far the start is from it, its worst case over a box, what it depends on most, and whether
simulations beside its curve do what stability says.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

from mjcont.errors import MjcontError
from mjcont.influence.extremes import worst_case
from mjcont.influence.sensitivities import sensitivities
from mjcont.motion.certificates import verify_stability
from mjcont.results.certificates import Certificate
from mjcont.results.maps import WorstCase
from mjcont.results.model import units
from mjcont.results.points import SpecialPoint, show
from mjcont.studies import forms as f
from mjcont.studies import keys as k
from mjcont.studies import values as v
from mjcont.studies.references import refer
from mjcont.studies.schema import Table

_CURVES = ("branch", "locus")
_OWN: Mapping[str, f.Form] = {
    "worst": {**f.RANGES, "description": "Parameters with [low, high]: the box of the worst case."},
    "smallest": {**f.FLAG, "description": "Whether the worst is the smallest value, not the largest."},
    "tolerances": {**f.VALUES, "description": "Changes that parameters may have, such as { m_1 = \"50 g\" }."},
    "simulations": {**f.whole(0), "description": "How many points of a curve are simulated beside; 0 for none."},
}
ANSWER: f.Form = {"type": "object", "description": "What points mean, such as locks = \"above:LP1\".",
                  "properties": _OWN, "additionalProperties": f.POINT}
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class AnswerPlan:
    """The points that have a meaning, by it; ranges for their worst case; how many simulations confirm them.

    `tolerances` are those of the table itself, over those of the study's `[[sensitivities]]`.
    """

    points: Mapping[str, k.Reference]
    worst: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    smallest: bool = False
    simulations: int = 6
    tolerances: Mapping[str, float] = field(default_factory=dict)


def read_answer(root: Table, context: k.Context) -> AnswerPlan | None:
    """Return what the table [answer] asks, None if there is none or it has mistakes, which are noted."""
    if "answer" not in root.data or context.mechanism is None:
        return None
    before, points = len(context.problems), {}
    with context.noting():
        table = root.table("answer")
        for key in table.data:
            if key not in _OWN:
                with context.noting():
                    points[key] = refer(table, key, table.text(key), _CURVES, None, context)
        worst = v.ranges(table, "worst", context) if "worst" in table.data else {}
        count = v.whole(0)(table, "simulations", context) if "simulations" in table.data else 6
        own = v.tolerances(table, "tolerances", context) if "tolerances" in table.data else {}
        plan = AnswerPlan(points, worst, table.flag("smallest"), count, own)
        if not points:
            raise table.error("", 'expected at least one point with its meaning, such as locks = "equilibria:LP1"')
    return plan if len(context.problems) == before else None


@dataclass(frozen=True, slots=True)
class Influence:
    """The parameter that moves a point most within its tolerance, and by how much either way."""

    name: str
    tolerance: float
    change: float
    unit: str


@dataclass(frozen=True, slots=True)
class Answer:
    """A point with a meaning, and how sure it is: where something cannot be told, the reason stands in its place.

    Attributes
    ----------
    meaning, reference : what the study calls it, and the point that it is.
    quantity, here : what is read, and its value where the curve starts.
    worst, influence, simulation : None where nobody asked.
    """

    meaning: str
    reference: str
    point: SpecialPoint
    quantity: str
    here: float
    worst: WorstCase | str | None
    influence: Influence | str
    simulation: Certificate | str | None

    @property
    def margin(self) -> float:
        """How far the start is from the point."""
        return abs(float(self.point[self.quantity]) - self.here)

    def __str__(self) -> str:
        """Return the answer, a line for each question."""
        point, name = self.point, self.quantity
        unit = point.units.get(name, "")
        where = ", ".join(f"{n} = {show(point[n], point.units.get(n, ''), 5)}" for n in point.free)
        asked = {"worst case": self.worst, "most sensitive to": self.influence, "simulation": self.simulation}
        return "\n".join([
            f"{self.meaning} at {where}   ({self.reference})",
            f"  margin: {show(self.margin, unit, 5)} from {name} = {show(self.here, unit, 5)}",
            *(f"  {what}: not known: {found}" if isinstance(found, str) else f"  {what}: {self._told(found)}"
              for what, found in asked.items() if found is not None),
        ])

    def _told(self, found: WorstCase | Influence | Certificate) -> str:
        name, unit_of = self.quantity, units(self.point.model)
        unit = unit_of.get(name, "")
        if isinstance(found, Influence):
            return (f"{found.name}: +-{show(found.tolerance, found.unit, 3)} moves {name} by "
                    f"+-{show(found.change, unit, 3)}")
        if isinstance(found, WorstCase):
            where = ", ".join(f"{n} = {show(v, unit_of.get(n, ''), 4)}" for n, v in found.parameters.items())
            return f"{name} = {show(found.value, unit, 5)} at {where}; {found.message}"
        return found.headline.removeprefix("stability by simulation: ")


def answers(study: Any, results: Sequence[Any], say: Callable[[str], None] = lambda what: None) -> list[Answer]:
    """Return the answers that a study asks for; `results` are those of `run_study`, `say` hears what is being done.

    Raises
    ------
    MjcontError
        If a result has no such point.
    """
    done: dict[str, Any] = {}
    for plan, result in zip(study.plans, results, strict=False):
        done[plan.name] = result
        if hasattr(result, "branches"):
            done |= {f"{plan.name}_{i}": b for i, b in enumerate(result, 1)}
    found = []
    checked: dict[str, Certificate | str | None] = {}
    for meaning, reference in study.answer.points.items():
        curve = done.get(reference.result)
        if curve is None:
            raise MjcontError(f"study '{study.file}': answer.{meaning}: '{reference.result}' was not computed")
        try:
            point = curve.point(reference.label)
        except MjcontError as error:
            raise type(error)(f"study '{study.file}': answer.{meaning}: {error}") from error
        if reference.result not in checked:
            checked[reference.result] = _simulated(reference.result, curve, study.answer.simulations, say)
        found.append(_answer(meaning, str(reference), study.answer, curve, point, checked[reference.result],
                             _tolerances(study, reference), say))
    return found


def _tolerances(study: Any, reference: k.Reference) -> dict[str, float]:
    """Return what the study says of how much parameters may change, for the sensitivities of one point."""
    asked = [task.given for task in study.tasks if task.kind == "sensitivity" and task.given["point"] == reference]
    return {n: t for given in [*(a["tolerances"] for a in asked), study.answer.tolerances] for n, t in given.items()}


def _answer(
    meaning: str, reference: str, plan: AnswerPlan, curve: Any, point: SpecialPoint,
    simulation: Certificate | str | None, tolerances: Mapping[str, float], say: Callable[[str], None],
) -> Answer:
    """Return how sure a point is."""
    quantity = next(iter(point.free))
    ranges = {n: r for n, r in plan.worst.items() if n not in point.free}
    worst: WorstCase | str | None = None
    if ranges:
        say(f"worst case of {reference}")
        worst = _tried(lambda: worst_case(point, ranges, quantity=quantity, maximise=not plan.smallest))
    say(f"what {reference} depends on")
    influence = _tried(lambda: _influence(point, quantity, tolerances))
    return Answer(meaning, reference, point, quantity, float(curve[quantity][curve.start_index]), worst, influence,
                  simulation)


def _simulated(name: str, curve: Any, count: int, say: Callable[[str], None]) -> Certificate | str | None:
    """Return what simulations beside a curve say; None where none are asked for, or its rows have no stability."""
    if not (count and curve.rated):
        return None
    say(f"simulations beside {name}")
    return _tried(lambda: verify_stability(curve, n=count).certificate)


def _tried(question: Callable[[], T]) -> T | str:
    """Return an answer; where it cannot be given, the reason."""
    try:
        return question()
    except MjcontError as error:
        return str(error)


def _influence(point: SpecialPoint, quantity: str, tolerances: Mapping[str, float]) -> Influence:
    own = {n: t for n, t in tolerances.items() if n not in point.free}
    found = sensitivities(point, quantities=quantity, tolerances=own)
    name = found.ordered(quantity)[0]
    change = float(found.changes[found.parameters.index(name), 0])
    return Influence(name, float(found.tolerances[name]), abs(change), found.units[name])
