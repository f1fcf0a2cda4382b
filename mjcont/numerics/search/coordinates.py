"""The coordinates in which a search draws its starts and tells states apart: lines, angles with full turns, rotations.

A state's entries are grouped into slots: a line or angle is one entry of x and one tangent coordinate, a rotation is
a unit quaternion of four entries and three tangent coordinates.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mjcont.numerics.equations.problem import Array, Equations

_TURN = 2.0 * math.pi
_EDGE = 1e-9
_QUATERNION = 4


@dataclass(frozen=True, slots=True)
class Slot:
    """One joint coordinate: its name, its first entry in x and in the tangent space, and where starts are drawn.

    Attributes
    ----------
    low, high : range of the starts; unused for a rotation.
    period : a full turn where one changes nothing, inf elsewhere.
    width : number of entries of x: 1, or 4 for a rotation.
    """

    name: str
    column: int
    tangent: int
    low: float
    high: float
    period: float = math.inf
    width: int = 1


@dataclass(frozen=True, slots=True)
class Coordinates:
    """All slots of a problem's state."""

    problem: Equations
    slots: tuple[Slot, ...]

    @property
    def flat(self) -> bool:
        """Whether states are vectors, so that steps add."""
        return all(s.width == 1 for s in self.slots)

    @property
    def turning(self) -> tuple[Slot, ...]:
        """The angles whose full turns change nothing."""
        return tuple(s for s in self.slots if math.isfinite(s.period))

    @property
    def periods(self) -> Array:
        """Period of each scaled tangent coordinate, inf where it has none, (n,)."""
        found = np.full(self.problem.n, math.inf)
        for s in self.turning:
            found[s.tangent] = s.period / self.problem.state_scale[s.tangent]
        return found

    def limits(self, factor: float) -> tuple[Array, Array]:
        """Return centre and reach of the entries of x: `factor` times the range of the starts, (nq,) each."""
        size = sum(s.width for s in self.slots)
        centre, reach = np.zeros(size), np.full(size, math.inf)
        for s in self.slots:
            if s.width == 1 and not math.isfinite(s.period):
                centre[s.column] = 0.5 * (s.low + s.high)
                reach[s.column] = factor * max(0.5 * (s.high - s.low), self.problem.typical[s.tangent])
        return centre, reach

    def draw(self, cube: Array) -> Array:
        """Return states for points (m, n) of the unit cube, evenly spread over ranges and rotations, (m, nq)."""
        out = np.empty((len(cube), sum(s.width for s in self.slots)))
        for s in self.slots:
            t = cube[:, s.tangent]
            if s.width == 1:
                out[:, s.column] = s.low + t * (s.high - s.low)
                continue
            # Shoemake, Uniform random rotations, Graphics Gems III (1992)
            a, b = _TURN * cube[:, s.tangent + 1], _TURN * cube[:, s.tangent + 2]
            p, q = np.sqrt(1.0 - t), np.sqrt(t)
            columns = [p * np.sin(a), p * np.cos(a), q * np.sin(b), q * np.cos(b)]
            out[:, s.column : s.column + _QUATERNION] = np.column_stack(columns)
        return out

    def mix(self, states: Array, count: int, generator: np.random.Generator) -> Array:
        """Return states each of whose slots is taken from one of `states` by chance, (count, nq)."""
        out = np.empty((count, states.shape[1]))
        for s in self.slots:
            which = generator.integers(0, len(states), count)
            out[:, s.column : s.column + s.width] = states[which, s.column : s.column + s.width]
        return out

    def wrap(self, states: Array) -> Array:
        """Return states with every turning angle within half a turn of the middle of its range."""
        out = states.copy()
        for s in self.turning:
            low = 0.5 * (s.low + s.high) - 0.5 * s.period + _EDGE
            u = out[:, s.column] - low
            out[:, s.column] = low + u - s.period * np.floor(u / s.period)
        return out

    def steps(self, states: Array, origins: Array) -> Array:
        """Return the scaled steps from every origin to every state, full turns left out, (m, r, n)."""
        if self.flat:
            raw = states[:, None] - origins[None]
        else:
            raw = np.array([[self.problem.difference(x, o) for o in origins] for x in states])
            raw = raw.reshape(len(states), len(origins), self.problem.n)
        for s in self.turning:
            u = raw[:, :, s.tangent]
            raw[:, :, s.tangent] = u - s.period * np.round(u / s.period)
        return raw / self.problem.state_scale


def layout(labels: Sequence[tuple[str, str]], scale: Array, home: Array, ranges: Mapping[str, tuple[float, float]]) -> (
    tuple[Slot, ...]
):
    """Return the slots of a state from the name and unit of each entry.

    Angles range half a turn to either side of zero, lengths their scale to either side of `home`, other entries three
    times their scale or twice their value at `home` to either side of zero; `ranges` replaces these by name.
    """
    slots: list[Slot] = []
    column = tangent = 0
    while column < len(labels):
        name, unit = labels[column]
        if name.endswith(".q0") and len(labels) != len(scale):
            slots.append(Slot(name.removesuffix(".q0"), column, tangent, 0.0, 1.0, math.inf, _QUATERNION))
            column, tangent = column + _QUATERNION, tangent + 3
            continue
        at, size = float(home[column]), float(scale[tangent])
        if unit == "rad":
            low, high = -math.pi, math.pi
        elif unit == "m":
            low, high = at - size, at + size
        else:
            low, high = -max(3.0 * size, 2.0 * abs(at)), max(3.0 * size, 2.0 * abs(at))
        slots.append(Slot(name, column, tangent, *ranges.get(name, (low, high))))
        column, tangent = column + 1, tangent + 1
    return tuple(slots)


def with_turns(
    slots: Sequence[Slot],
    labels: Sequence[tuple[str, str]],
    states: Array,
    residuals: Callable[[Array], Array],
) -> tuple[Slot, ...]:
    """Return the slots with a period where a full turn of an angle leaves f as it is at all of `states`.

    Their largest f must be more than rounding, so they are not to be equilibria all.
    """
    base = residuals(states)
    found = []
    for s in slots:
        if s.width == 1 and labels[s.column][1] == "rad":
            turned = states.copy()
            turned[:, s.column] += _TURN
            if np.max(np.abs(residuals(turned) - base)) <= 1e-8 * np.max(np.abs(base)):
                s = replace(s, period=_TURN)  # noqa: PLW2901
        found.append(s)
    return tuple(found)

