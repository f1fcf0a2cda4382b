"""From where optimisations ended to a result: the best, what became of every condition, what it costs in words."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mjcont.influence.aims.followed import Lost
from mjcont.influence.aims.optimise import Ended
from mjcont.influence.aims.program import Condition, Program
from mjcont.numerics.equations.problem import Array
from mjcont.results.choices.targets import Design, Outcome, in_size
from mjcont.results.points import Point, show
from mjcont.results.units import displayed, sized

# designs that differ by less (scaled) are one; a multiplier or a share of what is missing below this is none
_SAME, _NOTHING = 1e-5, 1e-9
_SHARE = 1e-3
# what is missing by less is no conflict
_ROUNDING = 1e-6


def design_of(program: Program, ended: Sequence[Ended], tol: float, before: int) -> Design:
    """Return the best of some ends as a result."""
    missing = [program.missing(program.values(e.v)[0]) for e in ended]
    objectives = [program.objective_at(e.v)[0] for e in ended]
    order = sorted(range(len(ended)), key=lambda i: (not ended[i].met, objectives[i] if ended[i].met else float(
        missing[i] @ missing[i])))
    best = order[0]
    end, d = ended[best], program.parameters(ended[best].v)
    same = sum(bool(np.abs(e.v - end.v).max() <= _SAME) and e.met == end.met for e in ended)
    names = program.names
    at_bound = {n: "low" if v <= a else "high" for n, v, a, b in zip(
        names, end.v, program.low + _NOTHING, program.high - _NOTHING, strict=True) if v <= a or v >= b}
    conditions = _outcomes(program, end, missing[best], tol)
    status, message = _said(program, end, conditions, missing[best], at_bound, (same, len(ended)))
    today = np.zeros(len(names))
    after, then = _points(program, end.v), _points(program, today)

    def values(v: Array) -> dict[str, float]:
        return dict(zip(names, program.parameters(v).tolist(), strict=True))

    objective = objectives[best] * program.unit
    ranges = {n: (float(t + a * s), float(t + b * s)) for n, t, s, a, b in zip(
        names, program.today, program.scales, program.low, program.high, strict=True)}
    return Design(
        status, end.met, message, dict(zip(names, d.tolist(), strict=True)), values(today), ranges,
        dict(zip(names, program.scales.tolist(), strict=True)), objective, conditions, at_bound, end.kkt,
        (same, len(ended)), tuple(dict.fromkeys(s for e in ended for s in e.cuts)), after, then,
        tuple(values(v) for v in end.path), next(iter(program.points.values())).model, program.evaluations - before,
    )


def _points(program: Program, v: Array) -> dict[str, Point]:
    """Return the points at a design; one that no condition names may not exist there."""
    found = {}
    for name in program.points:
        try:
            at = program.point(name, {})
            found[name] = at.located(at.at(program.parameters(v)))
        except Lost:
            continue
    return found


def _outcomes(program: Program, end: Ended, missing: Array, tol: float) -> list[Outcome]:
    today, found = np.zeros(len(end.v)), []
    for i, c in enumerate(program.conditions):
        s = c.statement
        active = end.met and abs(end.multipliers[i]) > _NOTHING
        multiplier = float(end.multipliers[i]) * c.sign / c.size * program.unit
        found.append(Outcome(
            s.text, s.point, s.quantity, s.relation, s.value, s.unit, c.load, program.quantity(c, today),
            program.quantity(c, end.v), bool(abs(missing[i]) <= max(tol, _NOTHING)), active, multiplier,
            _cost(program, end, i) if active else "",
        ))
    return found


def _cost(program: Program, end: Ended, i: int) -> str:
    """Return what a little more of a condition costs: the change of the parameter that changes most, to first order."""
    c = program.conditions[i]
    step = _step(c)
    dt = step if end.multipliers[i] * c.sign > 0 else -step
    active = np.flatnonzero(np.abs(end.multipliers) > _NOTHING)
    free = (end.v > program.low + _NOTHING) & (end.v < program.high - _NOTHING)
    _, gradient = program.values(end.v)
    asked = np.where(active == i, c.sign * dt / c.size, 0.0)
    moved = np.zeros(len(end.v))
    moved[free] = np.linalg.lstsq(gradient[active][:, free], asked, rcond=1e-10)[0]
    if not moved.any():
        return ""
    most = int(np.argmax(np.abs(moved)))
    name = program.names[most]
    unit = next(iter(program.points.values())).model.parameters[name].unit
    word = "more" if dt > 0 else "less"
    price = in_size(float(f"{abs(moved[most] * program.scales[most]):.3g}"), unit)
    return f"{in_size(step, c.statement.unit, c.size)} {word} costs {price} of {name}"


def _step(c: Condition) -> float:
    """Return a round hundredth or so of a condition's value, in the unit in which it is shown."""
    unit, factor = displayed(c.statement.unit)
    _, larger = sized(unit, c.size)
    shown = c.size * factor * larger
    step: float = 10.0 ** (math.floor(math.log10(shown)) - 2) / (factor * larger)
    return step


def _said(
    program: Program, end: Ended, conditions: Sequence[Outcome], missing: Array, at_bound: dict[str, str],
    starts: tuple[int, int],
) -> tuple[str, str]:
    """Return status and sentence."""
    count, (same, tried) = len(conditions), starts
    ends = f"; {same} of {tried} starts end here" if tried > 1 else ""
    least = "changed least" if program.objective is None else "at the least objective"
    bounds = ", ".join(f"{n} at its {word} bound" for n, word in at_bound.items())
    if end.met and end.stationary:
        what = "the condition is met" if count == 1 else f"all {count} conditions are met"
        return "met", f"{what}, {least}{f', with {bounds}' if bounds else ''}{ends}"
    if end.met:
        lost = f": {end.cuts[-1]}" if end.cuts else ""
        return "at the edge" if lost else "not converged", (
            f"the conditions are met, but a design that changes less may exist (gradient {end.kkt:.1e}){lost}{ends}")
    most = float(np.abs(missing).max())
    if most <= _ROUNDING:
        why = "stiff connections round forces, or tol is too small"
        return "not converged", f"the conditions hold to {most:.0e} of their values only: {why}{ends}"
    share = np.abs(missing) / most
    left = [c for c, s in zip(conditions, share, strict=True) if s > _SHARE]
    said = " and ".join(dict.fromkeys(str(c) for c in left))
    reached = ", ".join(dict.fromkeys(f"{c.name} = {show(c.after, c.unit)}" for c in left))
    if not end.stationary and end.cuts:
        return "at the edge", f"{said} is not reached: beside the nearest design a point is lost ({end.cuts[-1]}){ends}"
    several = len({str(c) for c in left}) > 1
    within = f" within the bounds ({bounds})" if bounds else ""
    if several:
        message = f"{said} exclude each other{within}: the nearest design has {reached}"
    else:
        message = f"{said} cannot be met{within}: the nearest design has {reached}"
    return "conflict" if end.kkt <= 1e-5 else "not converged", message + ends
