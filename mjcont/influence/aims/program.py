"""A design as a program: objective and conditions with gradients, in parameters scaled so that today's design is 0."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mjcont.errors import ParameterError
from mjcont.influence.aims.followed import Followed
from mjcont.influence.aims.statements import BARRIER, Statement
from mjcont.motion.barriers import energy_barrier
from mjcont.numerics.equations.problem import Array
from mjcont.results.points import Point
from mjcont.results.quantities import finite

# a value: of a parameter, or of a quantity "POINT.QUANTITY"
Weights = Mapping[str, float]
Function = Callable[[Mapping[str, float]], float]
# step of differences of a user's objective, in scales
_STEP = 1e-4


@dataclass(frozen=True, slots=True)
class Condition:
    """A statement in one load case: c = sign (q - value) / size, zero for a target, not negative for a limit."""

    statement: Statement
    case: int
    load: Mapping[str, float]
    size: float

    @property
    def equal(self) -> bool:
        """Whether it is a target."""
        return self.statement.relation == "=="

    @property
    def sign(self) -> float:
        """-1 for an upper limit."""
        return -1.0 if self.statement.relation == "<=" else 1.0


class Program:
    """Objective and conditions over scaled changes v of the parameters.

    Parameters
    ----------
    points : mapping of name to Point
    names, today, scales, low, high : the parameters, their values today, their scales and bounds.
    objective : None for the change from today, weights of parameters and quantities, or a function of parameters.
    """

    def __init__(
        self, points: Mapping[str, Point], names: Sequence[str], today: Array, scales: Array, low: Array, high: Array,
        objective: Weights | Function | None,
    ) -> None:
        self.points, self.names, self.today, self.scales = dict(points), list(names), today, scales
        self.low, self.high = (low - today) / scales, (high - today) / scales
        self.objective = objective
        self.conditions: list[Condition] = []
        self._followed: dict[tuple[str, tuple[tuple[str, float], ...]], Followed] = {}
        self._calls: dict[tuple[bytes, str], tuple[float, Array]] = {}
        self.unit = 1.0  # of an objective that is a quantity
        if isinstance(objective, Mapping):
            self.unit = max(abs(self.objective_at(np.zeros(len(self.names)))[0]), 1e-12)

    def add(self, statement: Statement, case: int, load: Mapping[str, float]) -> Condition:
        """Add a statement in a load case; its size is that of the value, or of the quantity where that is zero."""
        size = abs(statement.value)
        if size == 0.0:
            size = abs(self._read(statement.point, statement.quantity, load, self.today)[0]) or 1.0
        made = Condition(statement, case, dict(load), size)
        self.conditions.append(made)
        return made

    def parameters(self, v: Array) -> Array:
        """Return the parameters at scaled changes; exactly the bounds at these."""
        p: Array = self.today + v * self.scales
        p = np.where(v <= self.low, self.today + self.low * self.scales, p)
        return np.where(v >= self.high, self.today + self.high * self.scales, p)

    def point(self, name: str, load: Mapping[str, float]) -> Followed:
        """Return a point that follows the design in a load case."""
        key = name, tuple(load.items())
        if key not in self._followed:
            self._followed[key] = Followed(self.points[name], self.names, load)
        return self._followed[key]

    def _read(self, name: str, quantity: str, load: Mapping[str, float], p: Array) -> tuple[float, Array]:
        """Return a quantity of a point and its gradient in the parameters."""
        at = self.point(name, load)
        if quantity != BARRIER:
            return at.quantity(at.at(p), quantity)
        over = self._pass(name, load)
        (rest, a), (saddle, b) = (f.energy(f.at(p)) for f in (at, over))
        return saddle - rest, b - a

    def _pass(self, name: str, load: Mapping[str, float]) -> Followed:
        """Return the lowest pass that leads from a rest, which follows the design."""
        key = f"{name}.{BARRIER}", tuple(load.items())
        if key not in self._followed:
            at = self.point(name, load)
            barrier = energy_barrier(at.located(at.known[0]))
            if barrier.saddle is None:
                raise ParameterError(f"{name} has no barrier: {barrier.message}")
            self._followed[key] = Followed(barrier.saddle, self.names, {})
        return self._followed[key]

    def value(self, c: Condition, v: Array) -> tuple[float, Array]:
        """Return a condition and its gradient in v."""
        q, gradient = self._read(c.statement.point, c.statement.quantity, c.load, self.parameters(v))
        return c.sign * (q - c.statement.value) / c.size, c.sign * gradient * self.scales / c.size

    def quantity(self, c: Condition, v: Array) -> float:
        """Return the quantity of a condition."""
        return self._read(c.statement.point, c.statement.quantity, c.load, self.parameters(v))[0]

    def values(self, v: Array) -> tuple[Array, Array]:
        """Return all conditions (m,) and their gradients (m, d); Lost where a point does not exist."""
        rows = [self.value(c, v) for c in self.conditions]
        return np.array([r[0] for r in rows]), np.array([r[1] for r in rows]).reshape(len(rows), len(v))

    def objective_at(self, v: Array) -> tuple[float, Array]:
        """Return the objective, in its own size, and its gradient in v."""
        if self.objective is None:
            return float(v @ v), 2.0 * v
        p = self.parameters(v)
        if isinstance(self.objective, Mapping):
            value, gradient = 0.0, np.zeros(len(v))
            for name, weight in self.objective.items():
                point, _, quantity = name.partition(".")
                if name in self.names:
                    i = self.names.index(name)
                    q, g = float(p[i]), np.eye(len(v))[i]
                else:
                    q, g = self._read(point, quantity, {}, p)
                value, gradient = value + weight * q, gradient + weight * g * self.scales
            return value / self.unit, gradient / self.unit
        steps = _STEP * np.eye(len(v))
        slopes = [(8.0 * (self._own(v + s) - self._own(v - s)) - self._own(v + 2 * s) + self._own(v - 2 * s))
                  / (12.0 * _STEP) for s in steps]
        return self._own(v), np.array(slopes)

    def _own(self, v: Array) -> float:
        assert callable(self.objective)
        given = dict(zip(self.names, (self.today + v * self.scales).tolist(), strict=True))
        return finite("the objective", self.objective(given))

    @property
    def equal(self) -> Array:
        """Which conditions are targets, (m,) of bool."""
        return np.array([c.equal for c in self.conditions], dtype=bool)

    def missing(self, c: Array) -> Array:
        """Return by how much conditions of values (m,) are not met, with its sign, (m,)."""
        return np.where(self.equal, c, np.minimum(c, 0.0))

    @property
    def evaluations(self) -> int:
        """Evaluations of the forces so far."""
        return int(next(iter(self.points.values())).model.evaluations)

