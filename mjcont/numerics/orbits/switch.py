"""From one curve of orbits to another: the doubled orbits at a PD, the other branch at a BPC.

At a PD the null vector v of K(-1) changes its sign over a period: the orbits of twice the period begin as u + e v over
two periods. At a BPC the kernel of [J f_p] has two dimensions. With its second derivatives in the direction of the left
null vector w, q(t, t) = 0 on the curve's own tangent t, and for a vector n across it in the kernel

    q(a t + b n) = 2 a b q(t, n) + b^2 q(n, n) = 0,   so that the other branch leaves along 2 q(t, n) n - q(n, n) t.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.defining import CycleBranch, PeriodDoubling, bend, orbits_of
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.follow import laid
from mjcont.numerics.orbits.path import Path

# size of the first orbit beside a special one, relative to the state's sizes
FIRST = 1e-2


@dataclass(frozen=True, slots=True)
class Departure:
    """Where a curve of orbits is entered beside another one.

    Attributes
    ----------
    system : of the curve that is entered.
    x, y : near its first orbit.
    row : (n + k,) unit direction in which it is entered, scaled.
    """

    system: System
    x: Array
    y: Array
    row: Array


def doubled(flow: Flow, path: Path, shift: Array, system: System, x: Array, y: Array) -> Departure:
    """Return where the orbits of twice the period begin; `flow` has the doubled period, (x, y) is the PD."""
    local = system.local(x, y)
    orbits = orbits_of(local)
    v = PeriodDoubling(local).vectors(local, np.zeros(0))[0] * orbits.state_scale[: orbits.ends + orbits.inside]
    s, w = v[: orbits.ends].reshape(-1, orbits.flow.d), v[orbits.ends :].reshape(orbits.w_shape)
    deviation = Path(path.scheme, path.order, path.mesh, s, w, 0.0).repeated(np.zeros(orbits.flow.d), -1.0)
    twice = laid(flow, path.repeated(shift), 2.0 * shift)
    along = twice.joined(deviation)
    along = along / float(np.abs(deviation.s / twice.sizes).max())
    at = twice.joined(path.repeated(shift))
    return _entered(System(twice, system.base, system.free), at, y, along / twice.state_scale, 0.0)


def crossing(system: System, x: Array, y: Array, tangent: Array) -> tuple[Departure, Departure]:
    """Return where the other branch begins, to both sides of a BPC; `tangent` (n + 1,) is the own one, scaled."""
    local = system.local(x, y)
    kernel, w = CycleBranch(local, system.free[0]).null(local)
    own = kernel.T @ tangent
    own = own / np.linalg.norm(own)
    t, across = kernel @ own, kernel @ np.array([-own[1], own[0]])
    bent = bend(local, system, y, w, across)
    way = 2.0 * float(bent @ t) * across - float(bent @ across) * t
    n = system.n
    sides = [_entered(system, x, y, sign * way[:n], sign * float(way[n])) for sign in (-1.0, 1.0)]
    return sides[0], sides[1]


def _entered(system: System, x: Array, y: Array, along: Array, over: float) -> Departure:
    """Return the entry a little along a scaled direction: unknowns and parameter."""
    orbits = system.problem
    assert isinstance(orbits, Orbits)
    moved = (along * orbits.state_scale)[: orbits.ends].reshape(-1, orbits.flow.d)
    size = float(np.abs(moved / orbits.sizes).max())
    step = np.append(along, over)
    near, beside = system.move(x, y, FIRST / max(size, abs(over), 1e-300) * step)
    return Departure(system, near, beside, step / np.linalg.norm(step))


def system_at(flow: Flow, path: Path, shift: Array, values: Values, free: tuple) -> tuple[System, Array, Array]:  # type: ignore[type-arg]
    """Return the equations of the curve that goes through an orbit, and the orbit in them."""
    orbits = laid(flow, path, shift)
    system = System(orbits, values, free, accurate=True)
    return system, orbits.joined(path), system.start_y()
