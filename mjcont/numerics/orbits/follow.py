"""A curve of orbits, piece by piece: each piece on one mesh, walked by the driver; a new mesh where the old one fails.

Points on a mesh that no longer resolves its orbits end a piece. The last orbit is carried to a mesh that does,
corrected again, and the next piece begins there in the same direction.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from mjcont.numerics.equations.clock import TimeUp
from mjcont.numerics.equations.newton import Corrected, correct, solve
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.collocation import Orbits
from mjcont.numerics.orbits.conserved import orbits_on
from mjcont.numerics.orbits.flow import Flow
from mjcont.numerics.orbits.linger import SMALL, deviation, lingering, may_linger, shrinks_slowly, shrunk_to
from mjcont.numerics.orbits.mesh import count_for, equidistributed, error_of
from mjcont.numerics.orbits.passing import cycle_detectors
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.points import error_at, multipliers_at, orbits_at, path_at
from mjcont.numerics.orbits.scheme import Scheme
from mjcont.numerics.points.events import Detector, Located, approximate, point_at
from mjcont.numerics.step.arclength import CurvePoint, point_from
from mjcont.numerics.walk.guard import guarded
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.steps import End, Item, Leap, Neutral, Status
from mjcont.numerics.walk.trace import Trace, Walker, time_up

# a new mesh is to have this part of the tolerance, so that it lasts
_LASTS = 0.1
_MOST_MESHES = 8
# on the largest mesh intervals are moved as long as the error falls below this part of itself
_BETTER = 0.5
# an orbit that turned to its opposite has shrunk to a point between
_OPPOSITE = -0.5
# places at which an orbit's periods are compared
_COMPARED = 200
# where they are this much alike, relative to sizes, a walk that stands still has arrived where they are one
_ALIKE = 0.1
# the phase condition is renewed where the orbit's velocity has turned from the reference's by more than this cosine
_STALE = 0.8
# orbits before a step from which derivatives are extrapolated
_ENOUGH = 3
# where the multiplier 1 has this error and the period has grown so much, it grows without bound
_BLURRED, _LONGER = 1e-5, 2.0
_SLOW = "the orbit shrinks to a Bogdanov-Takens point (BT), where its period grows without bound"
# scales are renewed where a free period has changed by this
_OTHER_PERIOD = 2.0


@dataclass(frozen=True, slots=True)
class MeshSettings:
    """How orbits are resolved.

    Attributes
    ----------
    scheme : Scheme
    first, most : int
        Intervals to begin with, and at most.
    tol : float
        Error of the states at the mesh, relative, beyond which a finer mesh is laid.
    period_max : float
        Times the first period at which a curve ends.
    fixed : bool
        Whether the mesh stays as it is laid first.
    """

    scheme: Scheme
    first: int = 20
    most: int = 320
    tol: float = 1e-9
    period_max: float = 1e3
    fixed: bool = False


def laid(flow: Flow, path: Path, shift: Array) -> Orbits:
    """Return the equations on an orbit's mesh, with that orbit as reference.

    Sizes are its root mean squares, no less than the flow's scales; those of velocities follow the period.
    """
    squares, scale = 0.5 * (path.s[1:] ** 2 + path.s[:-1] ** 2), flow.scale.copy()
    if flow.order == 2:
        scale[flow.c :] = scale[: flow.c] * 2.0 * math.pi / path.period
    sizes = np.maximum(np.sqrt(path.lengths @ squares), scale)
    return orbits_on(flow, path.scheme, path.mesh, path.slopes(path.mesh), shift, sizes, path.period)


def carried_tangent(old: System, point: CurvePoint, new: Orbits) -> Array:
    """Return a curve's tangent at a point as a direction (n + k,) on another mesh of the same orbit."""
    orbits = orbits_at(point)
    step = 1e-6 / max(float(np.abs(point.tangent).max()), 1e-300)
    ends = []
    for sign in (1.0, -1.0):
        x, y = old.move(point.x, point.y, sign * step * point.tangent)
        moved = orbits.path(x, old.values(y)).carried(new.mesh)
        ends.append(new.joined(new.flow.taken(moved, orbits.flow)))
    direction = np.concatenate([(ends[0] - ends[1]) / (2.0 * step) / new.state_scale, point.tangent[old.n :]])
    found: Array = direction / np.linalg.norm(direction)
    return found


def orbit_near(
    flow: Flow, path: Path, values: Values, shift: Array, meshes: MeshSettings
) -> CurvePoint | None:
    """Return the orbit near a path at parameter values, as a point; None where there is none."""
    none, found, before = np.zeros(0), None, math.inf
    for _ in range(_MOST_MESHES):
        orbits: Orbits = laid(flow, path, shift)
        system = System(orbits, values, ())
        c = solve(system, orbits.joined(path), none, tol=1e-12, reach=10.0)
        if c.failure is not None:
            return found
        path = orbits.path(c.x, values)
        error, count = error_of(path, orbits.sizes), len(path.w)
        if error < before:
            found = CurvePoint(c.x, none, none, 1.0, c.local, None, error=c.error)
        if error <= meshes.tol or meshes.fixed or (count >= meshes.most and not error < _BETTER * before):
            return found
        before = error
        count = min(max(count_for(path, error, _LASTS * meshes.tol), count), meshes.most, 2 * count)
        path = path.carried(equidistributed(path, orbits.sizes, count))
    return found


def entered(system: System, x: Array, y: Array, row: Array, settings: Settings, s: float = 0.0) -> CurvePoint | Refused:
    """Return the point of a curve at which it is entered, in the direction `row` (n + k,)."""
    c: Corrected = correct(system, x, y, row, None, settings)
    return c.failure if c.failure is not None else point_from(c, row, s)


class OrbitByOrbit(OneByOne):
    """Steps in which derivatives are taken once, at the orbit itself: they cost as much as dozens of corrections.

    Those at the prediction are extrapolated from the orbits before, as soon as there are enough of them.
    """

    def begin(self, start: CurvePoint) -> float:
        """Return the length of the first step from a start, whose derivatives tell little of the next orbit's."""
        self._fresh = True
        return OneByOne.begin(self, start)

    def learn(self, leap: Leap) -> None:
        """Go on with derivatives at the prediction until there are orbits enough to extrapolate from."""
        self._fresh = len(leap.new.past) < _ENOUGH


@dataclass(slots=True)
class Follower:
    """Follows a curve of orbits in one direction.

    Attributes
    ----------
    settings, meshes : of the walk, and of the meshes.
    stop : ends the curve with a sentence where a user says so.
    detectors : what makes the detectors of a curve on a mesh.
    held : from plain equations and a point to those of a curve of special orbits on another mesh.
    end_at : kinds of points that end the curve.
    periods : how many periods of others its orbits have where it begins; it ends where they are alike again.
    """

    settings: Settings
    meshes: MeshSettings
    stop: Callable[[System, CurvePoint], str | None] | None = None
    detectors: Callable[[System, Settings], list[Detector]] = cycle_detectors
    held: Callable[[System, Array, Array], System] | None = None
    end_at: frozenset[str] = frozenset()
    periods: int = 1
    _wants: str = field(default="", init=False)
    _ending: End | None = field(default=None, init=False)
    _before: CurvePoint | None = field(default=None, init=False)

    def follow(self, system: System, start: CurvePoint) -> Iterator[Item]:
        """Yield the points after `start`, special points in their places, and the end."""
        count, h = 1, self.settings.ds
        longest = self.meshes.period_max * _period(start)
        fresh = self._resolved(system, start)
        if isinstance(fresh, End):
            yield fresh
            return
        system, point = fresh
        if point is not start:
            yield point
        while True:
            self._wants, self._ending, self._before = "", None, point
            left = replace(
                self.settings, ds=h, ds_min=min(self.settings.ds_min, h),
                max_points=max(self.settings.max_points - count + 1, 2),
            )
            first = point
            walker = Walker(
                OrbitByOrbit(system, left, self.detectors(system, left)),
                lambda p, system=system, first=first: self._look(system, p, first, longest),  # type: ignore[misc]
                self.end_at,
            )
            end: End | None = None
            for item in walker.walk(point):
                if isinstance(item, End):
                    end = item
                elif isinstance(item, CurvePoint):
                    h, point, count = min(max(item.s - point.s, left.ds_min), left.ds_max), item, count + 1
                    yield item
                else:
                    yield item
            assert end is not None
            if not self._wants:
                yield self._ended(system, end, point)
                return
            again = self._resolved(system, point)
            if isinstance(again, End):
                yield again
                return
            system, point = again
            yield point

    def _ended(self, system: System, end: End, point: CurvePoint) -> End:
        """Return the end that was noticed on the way, or how the walk says it: at a stop where one is named."""
        touches = orbits_at(point).flow.touches
        if self._ending is not None or end.status is not Status.STEP_TOO_SMALL:
            return self._ending or end
        if touches:
            return End(Status.CORNER, f"{touches}: its motion is followed no farther")
        if self.periods > 1 and float(np.abs(_apart(point, self.periods)).max()) < _ALIKE:
            return self._alike(system, point)
        return end

    def _alike(self, system: System, point: CurvePoint) -> End:
        where = f"the {self.periods} periods of an orbit become alike near {system.where(point.y)}"
        return End(Status.AT_REST, f"{where}: it is one of a single period there")

    def _look(self, system: System, p: CurvePoint, first: CurvePoint, longest: float) -> str | None:
        """Return why a piece ends at a point, None where it goes on."""
        if p is first:
            return None
        before, self._before = self._before, p
        sentence = self.stop(system, p) if self.stop is not None else None
        if sentence:
            self._ending = End(Status.STOPPED, sentence)
        elif before is not None and _shrunk(before, p):
            small = _smallest(system, before, p, self.settings)
            at_end = shrunk_to(orbits_at(small), path_at(small), small.local.values, self.held is not None)
            self._ending = End(Status.AT_REST, at_end)
        elif before is not None and self.periods > 1 and _merged(before, p, self.periods):
            self._ending = self._alike(system, p)
        elif self.held is not None and orbits_at(p).own_period and shrinks_slowly(
            orbits_at(p), path_at(p), p.local.values, longest / self.meshes.period_max
        ):
            self._ending = End(Status.AT_REST, _SLOW)
        elif orbits_at(p).own_period and (_period(p) > longest or _blurred(p, longest / self.meshes.period_max)):
            self._ending = End(Status.PERIOD, _without_bound(p))
        elif error_at(p) > self.meshes.tol and not self.meshes.fixed:
            self._wants = "mesh"
        elif _stale(p):
            self._wants = "phase"
        elif _centred(p) is not orbits_at(p).flow:
            self._wants = "coordinates"
        return (self._ending.message if self._ending else self._wants) or None

    def _resolved(self, system: System, point: CurvePoint) -> tuple[System, CurvePoint] | End:
        """Return the point on a mesh that resolves it, with its system; itself where it is resolved."""
        for _ in range(_MOST_MESHES):
            error, orbits = error_at(point), orbits_at(point)
            flow = _centred(point)
            if flow is orbits.flow and (self.meshes.fixed or (error <= self.meshes.tol and not _stale(point))):
                return system, point
            path, count = path_at(point), orbits.intervals
            if error > self.meshes.tol and not self.meshes.fixed:
                if count >= self.meshes.most:
                    return End(Status.MESH, f"the orbit's error {error:.1e} exceeds {self.meshes.tol:g} on the largest "
                               f"mesh ({count} intervals)")
                trial = path.carried(equidistributed(path, orbits.sizes, count))
                wanted = count_for(trial, error_of(trial, orbits.sizes), _LASTS * self.meshes.tol)
                count = min(max(wanted, self.meshes.first), 2 * count, self.meshes.most)
            mesh = path.mesh if self.meshes.fixed else equidistributed(path, orbits.sizes, count)
            carried = flow.taken(path.carried(mesh), orbits.flow)
            other = laid(flow, carried, orbits.shift)
            moved = System(other, system.base, system.free)
            if self.held is not None:
                moved = self.held(moved, other.joined(carried), point.y)
            row = carried_tangent(system, point, other)
            found = entered(moved, other.joined(carried), point.y, row, self.settings, point.s)
            if isinstance(found, Refused):
                return End(Status.MESH, f"the orbit was lost where its mesh was laid anew: {found}")
            system, point = moved, found
        return system, point


def _blurred(p: CurvePoint, first: float) -> bool:
    """Whether an orbit takes so much longer than the first that its multipliers have lost their digits."""
    m = multipliers_at(p)
    if _period(p) <= _LONGER * first or abs(m.values[m.trivial] - 1.0) <= _BLURRED:
        return False
    orbits = orbits_at(p)  # a multiplier of a million blurs the others, too
    return may_linger(orbits.flow, path_at(p), p.local.values, orbits.sizes)


def _without_bound(p: CurvePoint) -> str:
    """Return the sentence on a curve that ends where its period grows without bound."""
    orbits, values = orbits_at(p), p.local.values
    where = lingering(orbits.flow, path_at(p), values, orbits.sizes)
    return f"the period grows without bound, to {_period(p):.6g} s: {where} (homoclinic, or a saddle-node on a cycle)"


def _centred(p: CurvePoint) -> Flow:
    """Return the motion of an orbit in coordinates that suit it."""
    return orbits_at(p).flow.centred(path_at(p))


def _period(p: CurvePoint) -> float:
    return path_at(p).period


def _deviation(p: CurvePoint) -> Array:
    return deviation(orbits_at(p), path_at(p))


def _shrunk(before: CurvePoint, after: CurvePoint) -> bool:
    """Whether an orbit of a free period passed through a point: it comes out opposite to what it went in."""
    if not orbits_at(after).own_period or orbits_at(after).shift.any():
        return False
    a, b = _deviation(before), _deviation(after)
    if a.shape != b.shape:
        return False
    sizes = float(np.linalg.norm(a) * np.linalg.norm(b))
    return bool(np.abs(b).max() < SMALL) or float((a * b).sum()) < _OPPOSITE * sizes


def _smallest(system: System, before: CurvePoint, after: CurvePoint, settings: Settings) -> CurvePoint:
    """Return the orbit where it shrinks to a point between two others, as nearly as it is found."""
    a, b = (float(np.linalg.norm(_deviation(p))) for p in (before, after))
    near = approximate(system, before, after, a / (a + b) if a + b > 0.0 else 0.5, settings)
    return after if near.failure is not None else point_at(system, before, after, near, after.s)


def _apart(p: CurvePoint, periods: int) -> Array:
    """Return how a part of an orbit differs from the next one, relative to the states' sizes."""
    tau, path = (1.0 - 1.0 / periods) * np.linspace(0.0, 1.0, _COMPARED), path_at(p)
    found: Array = (path.states(tau + 1.0 / periods) - path.states(tau)) / orbits_at(p).sizes
    return found


def _merged(before: CurvePoint, after: CurvePoint, periods: int) -> bool:
    """Whether what tells an orbit's periods apart vanished: it comes out opposite to what it went in."""
    a, b = _apart(before, periods), _apart(after, periods)
    sizes = float(np.linalg.norm(a) * np.linalg.norm(b))
    return bool(np.abs(b).max() < SMALL) or float((a * b).sum()) < _OPPOSITE * sizes


def _stale(p: CurvePoint) -> bool:
    """Whether the reference of the phase condition no longer tells the phase, or the period has become another."""
    orbits = orbits_at(p)
    if not orbits.own_period:
        return False
    if not 1.0 / _OTHER_PERIOD <= _period(p) / orbits.period_scale <= _OTHER_PERIOD:
        return True
    slopes = path_at(p).slopes(orbits.mesh[:-1]) / orbits.sizes
    reference = orbits.reference[:-1] / orbits.sizes
    size = float(np.linalg.norm(slopes) * np.linalg.norm(reference))
    return float((slopes * reference).sum()) < _STALE * size


def trace_orbits(
    follower: Follower, system: System, start: CurvePoint, progress: Callable[[Item], None] | None = None
) -> Trace:
    """Collect a curve of orbits in one direction; an interrupt (Ctrl-C) ends it and keeps what there is."""
    result = Trace([start])
    try:
        for item in guarded(follower.follow(system, start)):
            if isinstance(item, End):
                result.end = item
                if item.status is Status.AT_REST and len(result.points) > 1:  # the orbit beyond is one seen before
                    result.points.pop()
                    result.special = [e for e in result.special if e.point.s <= result.points[-1].s]
            elif isinstance(item, Located):
                result.special.append(item)
            elif not isinstance(item, Neutral):
                if item.s == result.points[-1].s:  # the same orbit on a better mesh
                    result.points.pop()
                result.points.append(item)
            if progress is not None:
                progress(item)
    except TimeUp:
        result.end = time_up(follower.settings)
    except KeyboardInterrupt:
        result.end = End(Status.INTERRUPTED, f"stopped by the user after {len(result.points)} points")
    return result
