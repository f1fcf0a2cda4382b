"""Points of a curve of equilibria at which a column has a value: bracketed by its rows, and corrected to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mjcont.curves.collect import make_point
from mjcont.curves.continuation import hold_rigid_modes
from mjcont.curves.walkers import monitor_of
from mjcont.errors import MjcontError
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.newton import Corrected, solve
from mjcont.numerics.equations.system import System
from mjcont.numerics.points.events import ScalarZero
from mjcont.numerics.points.on_equilibria import square_system
from mjcont.results.branch import Branch
from mjcont.results.model import model_of
from mjcont.results.points import Point
from mjcont.results.quantities import column_of


@np.errstate(all="ignore")
def points_at(branch: Branch, name: str, value: float) -> list[Point]:
    """Return the points of a branch of equilibria at which a column has a value, corrected to it."""
    model_of(branch.problem, "the branch")
    if branch.kind != "equilibria":
        raise MjcontError("at() works on branches of equilibria; on a locus use its special points or rows")
    name = column_of(name, branch.columns) or name
    column = branch[name] - value
    held, _ = hold_rigid_modes(branch.model, branch.states[0], branch.parameters_at(0))
    branch = replace(branch, problem=held)
    found: list[Point] = []
    for i in range(len(branch) - 1):
        a, b = column[i], column[i + 1]
        if a == 0.0 or a * b < 0:
            point = _point_between(branch, i, a / (a - b) if a else 0.0, name, value)
            if point is not None:
                found.append(point)
    if len(branch) and column[-1] == 0.0:
        found.append(branch.row(len(branch) - 1))
    return found


def _point_between(branch: Branch, i: int, fraction: float, name: str, value: float) -> Point | None:
    problem = branch.model
    step = problem.difference(branch.states[i + 1], branch.states[i])
    x = problem.retract(branch.states[i], fraction * step)
    free = [Free(n, *b) for n, b in branch.free.items()]
    between = {n: float((1 - fraction) * branch[n][i] + fraction * branch[n][i + 1]) for n in branch.free}
    base = {**branch.fixed, **between}
    if name in branch.free:
        system, y = System(problem, {**base, name: value}, ()), np.zeros(0)
    else:
        equilibria = System(problem, base, free)
        at = Corrected(x, equilibria.start_y(), equilibria.local(x, equilibria.start_y()), None, 0, 0.0, 0.0, 0.0)
        system, y = square_system(equilibria, [ScalarZero(monitor_of(problem, name, value))], at)
    c = solve(system, x, y)
    return None if c.failure is not None else make_point(problem, c.x, system.values(c.y))
