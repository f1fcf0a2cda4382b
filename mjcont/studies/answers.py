"""What a study's points mean: `[answer]` gives them names such as locks and unlocks, and asks how sure they are.

Of each: its value, how far the start is from it, its worst case over a box, what it depends on most, and whether
simulations beside its curve do what stability says.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mjcont.errors import MjcontError
from mjcont.influence.extremes import worst_case
from mjcont.influence.sensitivities import sensitivities
from mjcont.motion.certificates import verify_stability
from mjcont.results.points import SpecialPoint, show
from mjcont.studies import keys as k
from mjcont.studies.references import refer
from mjcont.studies.schema import Table

_CURVES = ("branch", "locus")
_RESERVED = ("worst", "smallest", "simulations")


@dataclass(frozen=True, slots=True)
class AnswerPlan:
    """The points that have a meaning, by it; ranges for their worst case; how many simulations confirm them."""

    points: Mapping[str, k.Reference]
    worst: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    smallest: bool = False
    simulations: int = 6


def read_answer(root: Table, context: k.Context) -> AnswerPlan | None:
    """Return what the table [answer] asks, None if there is none or it has mistakes, which are noted."""
    if "answer" not in root.data or context.mechanism is None:
        return None
    before, points = len(context.problems), {}
    with context.noting():
        table = root.table("answer")
        for key in table.data:
            if key not in _RESERVED:
                with context.noting():
                    points[key] = refer(table, key, table.text(key), _CURVES, None, context)
        worst = k.ranges(table, "worst", context) if "worst" in table.data else {}
        count = k.whole(0)(table, "simulations", context) if "simulations" in table.data else 6
        plan = AnswerPlan(points, worst, table.flag("smallest"), count)
        if not points:
            raise table.error("", 'expected at least one point with its meaning, such as locks = "equilibria:LP1"')
    return plan if len(context.problems) == before else None


def answers(study: Any, results: Sequence[Any]) -> list[str]:
    """Return the answer to a study as lines; `results` are those of `run_study`.

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
    lines = [f"{study.mechanism.name}, {study.file}"]
    for meaning, reference in study.answer.points.items():
        curve = done.get(reference.result)
        if curve is None:
            raise MjcontError(f"study '{study.file}': answer.{meaning}: '{reference.result}' was not computed")
        try:
            point = curve.point(reference.label)
        except MjcontError as error:
            raise type(error)(f"study '{study.file}': answer.{meaning}: {error}") from error
        lines.append(f"{meaning} at {_where(point)}   ({reference})")
        lines += [f"  {line}" for line in _sure(study, curve, point)]
    return lines


def _where(point: SpecialPoint) -> str:
    return ", ".join(f"{n} = {show(point[n], point.units.get(n, ''), 5)}" for n in point.free)


def _sure(study: Any, curve: Any, point: SpecialPoint) -> list[str]:
    """Return how sure a point is: margin, worst case, what it depends on, what simulations say."""
    quantity = next(iter(point.free))
    unit, here = point.units.get(quantity, ""), float(curve[quantity][curve.start_index])
    lines = [f"margin: {show(abs(point[quantity] - here), unit, 5)} from {quantity} = {show(here, unit, 5)}"]
    plan: AnswerPlan = study.answer
    ranges = {n: r for n, r in plan.worst.items() if n not in point.free}
    if ranges:
        lines.append(_tried("worst case", lambda: _worst(point, ranges, quantity, plan.smallest)))
    lines.append(_tried("most sensitive to", lambda: _influence(point, quantity)))
    if plan.simulations and curve.rated:
        lines.append(_tried("simulation", lambda: _simulated(curve, plan.simulations)))
    return lines


def _tried(what: str, question: Callable[[], str]) -> str:
    """Return an answer with what was asked; where it cannot be given, the reason."""
    try:
        return f"{what}: {question()}"
    except MjcontError as error:
        return f"{what}: not known: {error}"


def _worst(point: SpecialPoint, ranges: Mapping[str, tuple[float, float]], quantity: str, smallest: bool) -> str:
    found = worst_case(point, ranges, quantity=quantity, maximise=not smallest)
    units = point.units
    where = ", ".join(f"{n} = {show(v, units.get(n, ''), 4)}" for n, v in found.parameters.items())
    return f"{quantity} = {show(found.value, units.get(quantity, ''), 5)} at {where}; {found.message}"


def _simulated(curve: Any, count: int) -> str:
    found = verify_stability(curve, n=count).certificate
    return found.headline if found is not None else "nothing was simulated"


def _influence(point: SpecialPoint, quantity: str) -> str:
    found = sensitivities(point, quantities=quantity)
    name = found.ordered(quantity)[0]
    change = found.changes[found.parameters.index(name), 0]
    unit = found.units[name]
    return (f"{name}: +-{show(found.tolerances[name], unit, 3)} moves {quantity} by "
            f"+-{show(abs(float(change)), found.units[quantity], 3)}")
