"""The verb `design`: parameters, changed least, so that special points meet targets and limits."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Amount
from mjcont.errors import BoundsError, MjcontError, ParameterError, unknown_name
from mjcont.influence.aims.followed import Lost
from mjcont.influence.aims.optimise import Ended, optimise
from mjcont.influence.aims.outcome import design_of
from mjcont.influence.aims.program import Program
from mjcont.influence.aims.statements import BARRIER, Statement, quantities_of, quantity_of, read_statements
from mjcont.influence.critical import called, check_alone, check_not_own
from mjcont.influence.extremes import worst_case
from mjcont.numerics.equations.problem import Array
from mjcont.results.choices.targets import Design
from mjcont.results.points import Point, SpecialPoint
from mjcont.results.quantities import check_values, finite, finite_pair

Points = Point | Sequence[Point] | Mapping[str, Any]
# conditions hold to this part of their value; rounds in which the worst of a box becomes a load case of its own
_TOL, _ROUNDS = 1e-9, 6
# corners of a box that are load cases from the start: of boxes with so many parameters at most
_CORNERS = 4


@checked
def design(
    points: Points,
    change: Mapping[str, tuple[float, float]],
    targets: str | Sequence[str],
    *,
    objective: str | Mapping[str, float] | Callable[..., float] | None = None,
    cases: Mapping[str, Any] | None = None,
    scales: Mapping[str, float] | None = None,
    starts: Sequence[Mapping[str, float]] | None = None,
    tol: float = _TOL,
    progress: Amount | None = None,
) -> Design:
    """Return the design, changed least from today's, at which special points meet targets and limits.

    Points are followed as the design moves, with exact gradients by adjoints; where one ceases to exist a step is cut.

    Parameters
    ----------
    points : special points or equilibria of one model, called by their labels or by the names of a dict
    change : mapping of parameter to (low, high), SI and radians
    targets : statements
        "LP1.F == 14 N", "CP1.F_ul >= -400", "|CP1.F_ul| <= 400 over gusts", "rest.barrier >= 2 J".
    objective : optional
        What is least: by default the sum of the squares of the changes in their scales; a quantity "LP1.F", its
        negative, a parameter, weights of several of these, or a function of a dict of the parameters.
    cases : mapping of name to load cases, optional
        For "over NAME": a list of dicts of parameter values, or a box, a dict of parameter to (low, high).
    scales : mapping of parameter to the change that counts as one, optional
        Default the parameter's size, or half the width of its bounds where that is zero.
    starts : designs to start from, optional
        Default today's.
    tol : float
        Of the conditions, relative to their values.
    progress : called as progress(starts done, all).

    Returns
    -------
    Design

    Raises
    ------
    MjcontError, NameLookupError, ParameterError, BoundsError
        If a name is unknown, a statement does not read so, a point cannot be followed, or bounds do not fit.
    """
    named = _named(points)
    before = next(iter(named.values())).model.evaluations
    names, today, low, high = _changed(named, change)
    sizes = _scales(names, today, low, high, scales)
    loads = _loads(named, names, cases or {})
    begin = _starts(names, starts, low, high, today)
    known = {name: quantities_of(p) for name, p in named.items()}
    statements = read_statements([targets] if isinstance(targets, str) else list(targets), known, loads)
    program = Program(named, names, today, sizes, low, high, _objective(objective, known, names))
    boxes = _stated(program, statements, loads)
    ended: list[Ended] = []
    for p in begin:
        ended.append(_from(program, (p - today) / sizes, tol, boxes, loads))
        if progress is not None:
            progress(len(ended), len(begin))
    return design_of(program, ended, tol, before)


def _stated(program: Program, statements: Sequence[Statement], loads: Mapping[str, Any]) -> list[Statement]:
    """Put statements in all their load cases into the program; return those over a box."""
    if not statements:
        raise ParameterError('name at least one target, such as "LP1.F == 14 N"')
    boxes = [s for s in statements if isinstance(loads.get(s.over), Mapping)]
    _refuse_boxes(boxes, program.points)
    for s in statements:
        _add(program, s, loads)
    return boxes


def _from(program: Program, v: Array, tol: float, boxes: Sequence[Statement], loads: Mapping[str, Any]) -> Ended:
    """Return the end of one start; the worst of a box joins the load cases until none is worse."""
    try:
        program.values(v)
    except Lost as lost:
        raise MjcontError(f"the points do not exist at a start: {lost}") from lost
    end = optimise(program, v, tol, lambda: None)
    for _ in range(_ROUNDS if boxes else 0):
        if not any([_worse(program, s, loads[s.over], end.v, tol) for s in boxes]):
            break
        end = optimise(program, end.v, tol, lambda: None)
    return end


def _worse(program: Program, s: Statement, box: Mapping[str, tuple[float, float]], v: Array, tol: float) -> bool:
    """Add the worst of a box as a load case if the limit does not hold there; return whether it was added."""
    at = program.point(s.point, {})
    point = at.located(at.at(program.parameters(v)))
    assert isinstance(point, SpecialPoint)
    middle = {n: 0.5 * (a + b) for n, (a, b) in box.items()}
    found = worst_case(point, box, quantity=s.quantity, maximise=s.relation == "<=", starts=[middle])
    over = (found.value - s.value) * (1.0 if s.relation == "<=" else -1.0)
    if over <= 1e2 * tol * max(abs(s.value), 1e-12) or found.parameters in [dict(c.load) for c in program.conditions]:
        return False
    program.add(s, len(program.conditions), found.parameters)
    return True


def _add(program: Program, s: Statement, loads: Mapping[str, Any]) -> None:
    given = loads.get(s.over, [{}])
    if isinstance(given, Mapping):
        ends = list(given.items())
        if len(ends) <= _CORNERS:
            picked = itertools.product(*(pair for _, pair in ends))
            given = [dict(zip(given, corner, strict=True)) for corner in picked]
        else:
            given = [{n: 0.5 * (a + b) for n, (a, b) in ends}]
    for i, load in enumerate(given):
        try:
            program.add(s, i, load)
        except Lost as lost:
            raise MjcontError(f'"{s.text}": {lost}') from lost


def _named(points: Points) -> dict[str, Point]:
    """Return the points by name, each with its problem, all of one model."""
    given = [points] if isinstance(points, Point) else points
    found: dict[str, Point] = {}
    if isinstance(given, Mapping):
        found = dict(given)
    else:
        for p in given:
            name = called(p) if isinstance(p, SpecialPoint) else ""
            if not name:
                raise ParameterError('an equilibrium has no label: name it, as in points={"rest": point}')
            if name in found:
                raise ParameterError(f'two points are called {name}: name them, as in points={{"first": ..., ...}}')
            found[name] = p
    if not found:
        raise ParameterError("name at least one point")
    for name, p in found.items():
        if not isinstance(p, Point):
            raise ParameterError(f"{name} must be a point, got a {type(p).__name__}")
        if not name.replace("_", "a").isalnum():
            raise ParameterError(f"a point's name consists of letters, digits and '_', got '{name}'")
    first = next(iter(found.values())).model
    others = [n for n, p in found.items() if (p.model.name, p.model.mjcf) != (first.name, first.mjcf)]
    for other in others[:1]:
        raise ParameterError(f"{other} is a point of another model than {next(iter(found))}: a design is of one")
    return found


def _changed(points: Mapping[str, Point], change: Mapping[str, Any]) -> tuple[list[str], Array, Array, Array]:
    """Return the parameters of the design with today's values and bounds."""
    if not change:
        raise ParameterError("name at least one parameter to change, such as {'k_sp': (5, 20)}")
    for point, name in itertools.product(points.values(), change):
        check_not_own(point, name)
    today, low, high = (np.zeros(len(change)) for _ in range(3))
    for i, (name, pair) in enumerate(change.items()):
        low[i], high[i] = finite_pair(f"the bounds of {name}", pair)
        values = {label: p.model.values(p.parameters)[name] for label, p in points.items()}
        (label, value), *others = values.items()
        for other, second in others:
            if not math.isclose(value, second, rel_tol=1e-12, abs_tol=1e-15):
                raise ParameterError(f"{name} is {value:g} at {label} and {second:g} at {other}: today's design is one")
        if not low[i] <= value <= high[i]:
            raise BoundsError(f"{name} is {value:g} today, outside its bounds {low[i]:g} .. {high[i]:g}")
        for point in points.values():
            check_alone(point, name)
            for end in (low[i], high[i]):
                point.model.parameter(name).check(end)
        today[i] = value
    return list(change), today, low, high


def _scales(
    names: Sequence[str], today: Array, low: Array, high: Array, given: Mapping[str, float] | None
) -> Array:
    found = np.where(today != 0.0, np.abs(today), 0.5 * (high - low))
    for name, value in (given or {}).items():
        if name not in names:
            raise unknown_name("parameter of the design", name, names)
        if not finite(f"the scale of {name}", value) > 0.0:
            raise ParameterError(f"the scale of {name} must be positive, got {value:g}")
        found[list(names).index(name)] = value
    return found


def _loads(points: Mapping[str, Point], names: Sequence[str], cases: Mapping[str, Any]) -> dict[str, Any]:
    """Return the load cases by name, checked: lists of values, or boxes."""
    model, found = next(iter(points.values())).model, dict[str, Any]()
    for name, given in cases.items():
        if isinstance(given, Mapping):
            found[name] = {n: finite_pair(f"the box of {n}", pair) for n, pair in given.items()}
        elif isinstance(given, Sequence) and not isinstance(given, str) and given:
            for load in given:
                check_values(load)
            found[name] = [dict(load) for load in given]
        else:
            raise ParameterError(f"cases '{name}' are a list of dicts of parameter values, or a dict of ranges")
        for n in {n for load in ([found[name]] if isinstance(given, Mapping) else found[name]) for n in load}:
            model.parameter(n)
            if n in names:
                raise ParameterError(f"{n} is changed by the design: it cannot differ between load cases")
    return found


def _refuse_boxes(boxes: Sequence[Statement], points: Mapping[str, Point]) -> None:
    for s in boxes:
        if s.relation == "==" or s.quantity == BARRIER or not isinstance(points[s.point], SpecialPoint):
            said = "over a box there are limits on special points only; give a list of load cases"
            raise ParameterError(f'"{s.text}": {said}')


def _objective(given: Any, known: Mapping[str, Mapping[str, str]], names: Sequence[str]) -> Any:
    """Return what is least: None for the change, weights, or a function."""
    if given is None or (callable(given) and not isinstance(given, str | Mapping)):
        return given
    weights = {given.lstrip("- "): -1.0 if given.strip().startswith("-") else 1.0} if isinstance(given, str) else given
    found = {}
    for name, weight in weights.items():
        own = name
        if name not in names:
            point, quantity, _ = quantity_of(name, known)
            own = f"{point}.{quantity}"
        found[own] = finite(f"the weight of {name}", weight)
    if not found:
        raise ParameterError("name what is to be least, such as 'LP1.F'")
    return found


def _starts(
    names: Sequence[str], given: Sequence[Mapping[str, float]] | None, low: Array, high: Array, today: Array
) -> list[Array]:
    if given is None:
        return [today]
    if not len(given):
        raise ParameterError("name at least one start")
    found = []
    for start in given:
        check_values(start)
        for name in start:
            if name not in names:
                raise unknown_name("parameter of the design", name, names)
        p = np.array([start.get(n, float(v)) for n, v in zip(names, today, strict=True)])
        if np.any(p < low) or np.any(p > high):
            i = int(np.argmax((p < low) | (p > high)))
            raise BoundsError(f"a start has {names[i]} = {p[i]:g}, outside its bounds {low[i]:g} .. {high[i]:g}")
        found.append(p)
    return found
