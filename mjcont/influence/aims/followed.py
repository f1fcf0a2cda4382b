"""Points that follow a design: each at its own load case, moved from the nearest design known, with derivatives.

X(p) solves G(X; p) = 0. Close by it is predicted by dX/dp = -G_X^-1 G_p, which gives the gradients of its quantities as
well, and corrected by Newton's method; where prediction and solution disagree it is walked there (`critical.Walk`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mjcont.curves.collect import make_point
from mjcont.errors import MjcontError
from mjcont.influence.critical import Solution, Walk, located_point
from mjcont.influence.sensitivities import Quantity, quantity_at
from mjcont.mechanism.energy import potential_energy
from mjcont.numerics.equations.adjoint import Adjoint
from mjcont.numerics.equations.differences import PARAMETER
from mjcont.numerics.equations.newton import Corrected, solve
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System
from mjcont.results.points import Point, SpecialPoint

# farthest prediction (scaled) that is taken without a walk, and by what part of it and how much the solution may differ
_REACH, _AGREE, _CLOSE = 0.2, 0.1, 1e-6
# chord steps: how they must contract, and their sizes at the end, without and with rounding
_CHORDS, _CONTRACTS, _DONE, _NOISE = 15, 0.4, 1e-13, 1e-8
_SHORTEST, _STEPS, _NEWTON, _KEPT = 1e-3, 200, 6, 40


class Lost(MjcontError):
    """A point does not exist at a design."""


@dataclass(slots=True)
class Solved:
    """A point at one design: its solution, and its derivatives once they are asked for."""

    p: Array
    solution: Solution
    corrected: Corrected | None
    adjoint: Adjoint | None = None
    moves: Array | None = None  # (n + k, parameters)
    quantities: dict[str, tuple[float, Array]] = field(default_factory=dict)


class Followed:
    """A point of a design in one load case.

    Parameters
    ----------
    point : Point
    names : parameters of the design.
    load : values of other parameters, in which the point is followed before all else.
    """

    def __init__(self, point: Point, names: Sequence[str], load: Mapping[str, float]) -> None:
        self.point, self.names, self.load = point, list(names), dict(load)
        values = point.model.values(point.parameters)
        start = np.array([values[n] for n in names])
        walk = Walk(point, {n: values[n] for n in load}, load)
        if load and any(values[n] != v for n, v in load.items()):
            status, message = walk.run(_SHORTEST, _STEPS)
            if status != "reached":
                raise Lost(f"{message} (load case {', '.join(f'{n} = {v:g}' for n, v in load.items())})")
        self.known = [Solved(start, (walk.system, walk.x, walk.y), None)]

    def at(self, p: Array) -> Solved:
        """Return the point at a design; Lost where it does not exist."""
        distance = [float(np.linalg.norm((s.p - p) / np.maximum(np.abs(p), 1e-12))) for s in self.known]
        nearest = self.known[int(np.argmin(distance))]
        if np.array_equal(nearest.p, p):
            return nearest
        found = self._predicted(nearest, p) or self._walked(nearest, p)
        self.known.append(found)
        if len(self.known) > _KEPT:
            self.known.pop(1)
        return found

    def _system(self, like: Solved, p: Array) -> System:
        s, values = like.solution[0], dict(zip(self.names, p.tolist(), strict=True))
        return System(s.problem, {**s.base, **values}, s.free, s.conditions, True)

    @staticmethod
    def _renew(solved: Solved) -> None:
        """Give the conditions, which solutions share, the borders of one solution."""
        system, x, y = solved.solution
        system.update(system.local(x, y), y)

    def _predicted(self, near: Solved, p: Array) -> Solved | None:
        """Return the point if a Newton step from a design nearby, predicted, leads where it was said to."""
        if near.moves is None or near.adjoint is None:
            return None
        step = near.moves @ (p - near.p)
        size = float(np.linalg.norm(step))
        if not size <= _REACH:
            return None
        self._renew(near)
        system = self._system(near, p)
        x, y = system.move(near.solution[1], near.solution[2], step)
        with np.errstate(all="ignore"):
            found = _by_chords(system, near.adjoint, x, y)
            if found is None:
                c = solve(system, x, y, most=_NEWTON)
                found = (c.x, c.y) if c.failure is None and np.all(np.isfinite(c.y)) else None
        if found is None or not float(np.linalg.norm(system.difference(*found, x, y))) <= _AGREE * size + _CLOSE:
            return None
        return Solved(p.copy(), (system, *found), None)

    def _walked(self, near: Solved, p: Array) -> Solved:
        self._renew(near)
        start, aim = (dict(zip(self.names, q.tolist(), strict=True)) for q in (near.p, p))
        walk = Walk(self.point, start, aim, near.solution)
        status, message = walk.run(_SHORTEST, _STEPS)
        if status != "reached":
            raise Lost(message)
        return Solved(p.copy(), (walk.system, walk.x, walk.y), walk.corrected)

    def linear(self, solved: Solved) -> Adjoint:
        """Return the linearisation at a solution, with `moves` filled in."""
        if solved.adjoint is None:
            system, x, y = solved.solution
            solved.adjoint = Adjoint(system, x, y)
            slopes = np.column_stack([solved.adjoint.equations_slope(n, bool(system.conditions)) for n in self.names])
            solved.moves = solved.adjoint.moves(slopes)
        return solved.adjoint

    def value(self, solved: Solved, name: str) -> float:
        """Return a quantity at a solution."""
        system, x, y = solved.solution
        values = system.values(y)
        if name in values:
            return values[name]
        problem: Any = system.problem
        if name in problem.observables:
            return float(problem.measure(x[None], values, [name])[0, 0])
        return quantity_at(self.linear(solved), name).value

    def quantity(self, solved: Solved, name: str) -> tuple[float, Array]:
        """Return a quantity at a solution, and its gradient in the design's parameters."""
        if name not in solved.quantities:
            adjoint = self.linear(solved)
            assert solved.moves is not None
            if name in self.names:
                gradient = np.array([float(n == name) for n in self.names])
            elif name in solved.solution[0].base and name not in solved.solution[0].names:
                gradient = np.zeros(len(self.names))
            else:
                q: Quantity = quantity_at(adjoint, name)
                gradient = np.array([q.direct(n) for n in self.names]) + q.gradient @ solved.moves
            solved.quantities[name] = self.value(solved, name), gradient
        return solved.quantities[name]

    def energy(self, solved: Solved) -> tuple[float, Array]:
        """Return the potential energy of an equilibrium, loads included, and its gradient in the parameters.

        It is stationary in the state there, so that its gradient is that at a fixed state.
        """
        system, x, y = solved.solution
        here, found = system.values(y), []
        for name in self.names:
            p = self.point.model.parameters[name]
            h = PARAMETER.step * max(abs(here[name]), 1e-2 * (p.bounds[1] - p.bounds[0]))
            ends = [self._energy(x, {**here, name: here[name] + o * h}) for o in PARAMETER.offsets]
            found.append(float(np.asarray(PARAMETER.weights) @ np.array(ends)) / h)
        return self._energy(x, here), np.array(found)

    def _energy(self, x: Array, values: Mapping[str, float]) -> float:
        return float(potential_energy(self.point.model, x[None], values, loads=True)[0])

    def located(self, solved: Solved) -> Point:
        """Return the point as results have it."""
        system, x, y = solved.solution
        if not isinstance(self.point, SpecialPoint) or not system.conditions:
            return make_point(self.point.model, x, system.values(y))
        c = solved.corrected or solve(system, x, y, most=_NEWTON)
        return located_point(self.point, system, c)


def _by_chords(system: System, near: Adjoint, x: Array, y: Array) -> tuple[Array, Array] | None:
    """Return the solution by steps with the derivatives of one nearby, None where they contract too slowly."""
    last = np.inf
    for _ in range(_CHORDS):
        step = near.correction(system.residual(system.local(x, y), y))
        size = float(np.linalg.norm(step))
        if not size <= _CONTRACTS * last and not size <= _NOISE:
            return None
        x, y = system.move(x, y, step)
        if size <= _DONE or (size <= _NOISE and size > _CONTRACTS * last):
            return x, y
        last = size
    return None

