"""The cycle that a motion settles on: it is followed in time until it comes back to where it was.

The motion's last state lies on a section across it; the last passage before, in the same direction and close by, is a
period earlier. Where none is close the motion goes on, each time for twice as long. Full turns of an angle are no
distance.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from mjcont.errors import StartError
from mjcont.numerics.equations.algebra import root
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.follow import MeshSettings, orbit_near
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.points import path_at
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.starts import sampled_path

# a passage this near, relative to the motion's extent, is a return; a motion that small, relative to scales, is rest
_RETURNED, _PERHAPS, _AT_REST = 1e-3, 0.1, 1e-7
# an orbit that is found this much smaller than the motion is another one
_SHRUNK = 0.1
# evaluations, and times that the motion is followed for twice as long
_MOST, _DOUBLINGS = 300_000, 24
_FINE, _FINEST = 1e-8, 1e-10
# a motion that reaches so many times its first size diverges
_AWAY = 1e6


class _LostError(Exception):
    """A motion that diverges, or takes too many steps."""


@dataclass(frozen=True, slots=True)
class Motion:
    """A piece of a motion.

    Attributes
    ----------
    times : (n,) the integrator's steps.
    dense : states (d, k) at times (k,).
    turns : (d,) a full turn for each angle, infinity for other entries.
    """

    times: Array
    dense: Callable[[Array], Array]
    turns: Array

    @property
    def end(self) -> Array:
        """The last state, (d,)."""
        found: Array = self.dense(self.times[-1:])[:, 0]
        return found

    def apart(self, times: Array) -> Array:
        """Return states less the last one and full turns, (k, d)."""
        change = self.dense(times).T - self.end
        return change - turned(change, self.turns)

    def extent(self, flow: ModelFlow) -> Array:
        """Return how far each entry ranges, full turns aside, no less than rounding lets it, (d,)."""
        return np.maximum(np.ptp(self.apart(self.times), axis=0), 1e-9 * flow.scale)


def turned(change: Array, turns: Array) -> Array:
    """Return the full turns in changes of a state (..., d)."""
    finite = np.isfinite(turns)
    found = np.zeros_like(change)
    found[..., finite] = np.round(change[..., finite] / turns[finite]) * turns[finite]
    return found


def cycle_of(
    flow: ModelFlow, state: Array, values: dict[str, float], meshes: MeshSettings, duration: float | None = None
) -> tuple[Path, Array]:
    """Return the cycle on which the motion from a state (d,) settles, and what it gains in a period, (d,).

    Raises
    ------
    StartError
        If the motion comes to rest, diverges, or does not come back to where it was.
    """
    turns, length = flow.turns(state, values), duration or _first_length(flow, state, values)
    began = flow.evaluations
    for _ in range(_DOUBLINGS):
        motion = moved(flow, state, values, length, turns)
        extent = motion.extent(flow)
        last = flow.evaluations - began > _MOST
        if (extent / flow.scale).max() <= _AT_REST:
            if not flow.at_rest(motion.end, values):
                length, state = 4.0 * length, motion.end
                continue
            raise StartError("the motion from the start comes to rest: there is no cycle on which it settles")
        found = _cycle_in(flow, motion, extent, values, meshes, _PERHAPS if last else _RETURNED)
        if found is not None:
            return found
        if last:
            break
        state, length = motion.end, 2.0 * length
    raise StartError(
        f"the motion from the start does not come back to where it was within {length:.4g} s: it settles too slowly, "
        "or on no cycle; give a state nearer to one"
    )


def _first_length(flow: ModelFlow, state: Array, values: dict[str, float]) -> float:
    """Return the time that the fastest linear motion at a state takes."""
    rates = flow.derivatives(state[None], np.zeros(1), values, (), False).jac[0]
    size = float(np.abs(rates).sum(axis=1).max()) ** (1.0 / flow.order)
    return 10.0 / size if 0.0 < size < np.inf else 1.0


def moved(flow: ModelFlow, state: Array, values: dict[str, float], length: float, turns: Array) -> Motion:
    """Return the motion of an unforced flow from a state (d,) over a time.

    Raises
    ------
    StartError
        If it diverges.
    """
    size, began = np.maximum(np.abs(state), flow.scale), flow.evaluations

    def field(t: float, u: Array) -> Array:
        if not np.all(np.abs(u) < _AWAY * size.max()) or flow.evaluations - began > _MOST:
            raise _LostError
        rates = flow.rates(u[None], np.zeros(1), values)[0]
        return rates if flow.order == 1 else np.concatenate([u[flow.c :], rates])

    def lost() -> StartError:
        why = flow.touches or "it diverges or has no value there"
        return StartError(f"the motion from the start could not be followed: {why}")

    try:
        run = solve_ivp(field, (0.0, length), state, method="LSODA", dense_output=True, rtol=_FINE, atol=_FINEST * size)
    except _LostError:
        raise lost() from None
    if not run.success or not np.isfinite(run.y).all():
        raise lost()
    return Motion(run.t, run.sol, turns)


def _cycle_in(
    flow: ModelFlow, motion: Motion, extent: Array, values: dict[str, float], meshes: MeshSettings, near: float
) -> tuple[Path, Array] | None:
    """Return the cycle that a motion goes through last, None where it does not come back nearer than `near`."""
    begin = _return(flow, motion, extent, values, near)
    if begin is None:
        return None
    period = float(motion.times[-1]) - begin
    change = motion.end - motion.dense(np.array([begin]))[:, 0]
    shift = turned(change, motion.turns)
    whole = turned(motion.dense(np.array([begin]))[:, 0], motion.turns)

    def states(tau: Array) -> Array:
        found: Array = motion.dense(begin + tau * period).T - whole
        return found

    steps = (motion.times[motion.times > begin] - begin) / period
    point = None
    for count in (meshes.first, 4 * meshes.first, meshes.most):  # a stiff cycle's jumps want more intervals
        path = sampled_path(flow, meshes.scheme, min(count, meshes.most), states, period, values, steps)
        point = orbit_near(flow, path, values, shift, meshes)
        if point is not None or count >= meshes.most or meshes.fixed:
            break
    if point is None:
        return None
    found = path_at(point)
    small = np.ptp(found.s, axis=0) < _SHRUNK * np.ptp(path.s, axis=0)
    return None if small[np.argmax(np.ptp(path.s, axis=0) / extent)] else (found, shift)


def _return(
    flow: ModelFlow, motion: Motion, extent: Array, values: dict[str, float], near: float
) -> float | None:
    """Return the last time before the end at which a motion passes its last state nearby in the same direction."""
    rates = flow.rates(motion.end[None], np.zeros(1), values)[0]
    velocity = rates if flow.order == 1 else np.concatenate([motion.end[flow.c :], rates])
    normal = velocity / extent**2

    def ahead(times: Array) -> Array:
        found: Array = motion.apart(times) @ normal
        return found

    sides = ahead(motion.times)
    for i in np.flatnonzero((sides[:-2] < 0.0) & (sides[1:-1] >= 0.0))[::-1].tolist():
        a, b = motion.times[i], motion.times[i + 1]
        time = root(lambda t: float(ahead(np.array([t]))[0]), a, b) if sides[i + 1] > 0.0 else float(b)
        if np.abs(motion.apart(np.array([time]))[0] / extent).max() < near:
            return time
    return None
