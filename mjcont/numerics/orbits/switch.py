"""From one curve of orbits to another: doubled orbits at a PD, the other branch at a BPC, orbits of k periods at an IR.

At a PD the null vector v of K(-1) changes its sign over a period: the orbits of twice the period begin as u + e v over
two periods. At a BPC the kernel of [J f_p] has two dimensions. With its second derivatives in the direction of the left
null vector w, q(t, t) = 0 on the curve's own tangent t, and for a vector n across it in the kernel

    q(a t + b n) = 2 a b q(t, n) + b^2 q(n, n) = 0,   so that the other branch leaves along 2 q(t, n) n - q(n, n) t.

At an IR with a multiplier exp(2 pi i p / k) of a family that keeps an energy, and v(t + T) = exp(2 pi i p / k) v(t),
the orbits of k periods begin as u + e Re(exp(i phi) v) for the phases phi at which the other equations can be solved:
two in a k-th part of a turn, the sides of one family at k = 3, two families at k = 4 (Meyer, Hall and Offin,
Introduction to Hamiltonian Dynamical Systems and the N-Body Problem, 2009). They are sought among phases all around.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.defining import CycleBranch, PeriodDoubling, Torus, bend, orbits_of
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.follow import entered, laid
from mjcont.numerics.orbits.path import Path

# size of the first orbit beside a special one, relative to the state's sizes
FIRST = 1e-2
# size of the first orbit of several periods, which small ones do not tell from others nearby; phases that are tried
# within the k-th part of a turn, and how near in phase, of that part, two orbits are that are the same
APART = 0.03
_PHASES, _SAME = 16, 0.05
# how far, of that part, a solution is from the phase at which it was sought that is one of its own
_SLID = 0.04


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
    deviation = Path(path.scheme, path.order, path.mesh, s, w, 0.0).repeated(np.zeros(orbits.flow.d), (1.0, -1.0))
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


def departures(
    flow: Flow, path: Path, shift: Array, system: System, x: Array, y: Array, root: tuple[int, int], settings: Settings
) -> list[Departure]:
    """Return where curves of orbits of k periods are entered beside an IR (x, y) of `system`: two at most.

    `root` (k, p) says which root of one a multiplier is, exp(2 pi i p / k). They are neighbours in phase: the sides of
    one family, or two families.
    """
    local = system.local(x, y)
    orbits, order, theta = orbits_of(local), root[0], 2.0 * math.pi / root[0]
    angle = theta * root[1]
    v = Torus(local, angle).vectors(local, np.array([angle]))[0] * orbits.state_scale[: orbits.ends + orbits.inside]
    s, w = v[: orbits.ends].reshape(-1, orbits.flow.d), v[orbits.ends :].reshape(orbits.w_shape)
    turns = np.exp(1j * angle * np.arange(order)).tolist()
    turning = Path(path.scheme, path.order, path.mesh, s, w, 0.0).repeated(np.zeros(orbits.flow.d), turns)
    whole = path.repeated(shift, [1.0] * order)
    many = laid(flow, whole, order * shift)
    wide, at = System(many, system.base, system.free), many.joined(whole)
    parts = [many.joined(replace(turning, s=f(turning.s), w=f(turning.w))) for f in (np.real, np.imag)]
    wave = (parts[0] + 1j * parts[1]) / many.state_scale / float(np.abs(turning.s / many.sizes).max())
    found: dict[float, Departure] = {}
    for phase in theta * np.arange(_PHASES) / _PHASES:
        row = np.append(np.real(np.exp(1j * phase) * wave), 0.0)
        near, beside = wide.move(at, y, APART * row)
        first = entered(wide, near, beside, row / np.linalg.norm(row), settings)
        if not isinstance(first, Refused):
            z = np.vdot(wave, many.difference(first.x, at) / many.state_scale)
            told = float(np.angle(z)) % theta
            slid = abs(math.remainder(told - float(phase), theta)) > _SLID * theta
            if not slid and not any(abs(math.remainder(told - other, theta)) < _SAME * theta for other in found):
                found[told] = Departure(wide, first.x, first.y, row / np.linalg.norm(row))
    return [found[told] for told in sorted(found)[:2]]
