"""`load_path`: what a mechanism does under a load that changes slowly: it follows a stable branch, and jumps.

A rest is lost at a fold, a Hopf point, a branch point or a non-smooth fold. There the load is taken a hair further, the
state a little way along the branch's unstable continuation, and let move until it rests (`escape`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Amount, Progress, collect, run_directions
from mjcont.curves.continuation import find_equilibrium, hold_rigid_modes
from mjcont.curves.walkers import equilibrium_detectors
from mjcont.errors import BoundsError, MjcontError, ParameterError, StartError
from mjcont.mechanism.energy import potential_energy, without_potential
from mjcont.motion.escape import Landing, escape
from mjcont.motion.legs import FRACTION, Leg, loads_of, unwrapped
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.algebra import eigenvectors, singular, solve
from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.free import Free
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.settings import Settings, check_numbers, make_settings
from mjcont.numerics.equations.system import Local, System
from mjcont.numerics.points.passage import Passage, passage
from mjcont.numerics.spectra.spectrum import quadratic_eigenvalues
from mjcont.numerics.spectra.stability import spectrum_of
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.walk.onebyone import OneByOne
from mjcont.numerics.walk.trace import Walker
from mjcont.results.branch import Branch, sliced
from mjcont.results.loadpaths import Jump, LoadPath, Segment
from mjcont.results.model import Model
from mjcont.results.points import Point, SpecialPoint, show

LANDINGS = ("motion", "creep")
# how far beyond the point of loss the load is taken, relative to the leg: where another rest may be near, farther
_HAIR = 1e-6
_BEYOND = 1e-3
_ASIDE = 1e-3
_TURNED = -1e-6
# a load is zero below this part of the way left
_NO_LOAD = 1e-6


@checked
def load_path(
    source: Branch | Model,
    parameter: str | Sequence[Mapping[str, float]],
    path: Sequence[float] | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    landing: str = "motion",
    max_time: float = 1000.0,
    max_jumps: int = 50,
    progress: Amount | None = None,
    **options: Any,
) -> LoadPath:
    """Return the quasi-static response to a load that follows a path.

    Parameters
    ----------
    source : Branch, Mechanism or VectorField
        A branch starts the path at its stable point at the path's first value.
    parameter : str, or sequence of dicts
        The parameter, or the path itself where several change: each leg runs straight from one dict to the next.
    path : sequence of float
        Values of the parameter, such as [0, 30, 0].
    start : dict of parameter values, or a point
        With `keyframe` or `state` it says where the path begins; the values of the path come first.
    landing : {"motion", "creep"}
        Where an escape lands: by motion in time with the damping the model has, or without inertia, the limit of
        large damping: quick, and never short of damping.
    max_time : in s, after which a motion counts as not coming to rest.
    max_jumps : number of jumps after which the path ends.
    progress : called as progress(legs done, all), with the part of the present leg that is behind.
    **options : fields of `Settings`: ds, ds_max, ...

    Returns
    -------
    LoadPath
        A rest that is lost for good ends it early, with a status and all that came before.

    Raises
    ------
    NameLookupError, BoundsError, ParameterError, StartError
        See their messages.
    """
    problem, given = _sourced(source)
    _check_landing(landing, max_time, max_jumps)
    settings = make_settings(options)
    vertices = loads_of(problem, parameter, path, start)
    before = problem.evaluations
    first = _first(problem, given, vertices[0], start, keyframe, state)
    held, _ = hold_rigid_modes(problem, first.state, first.parameters)
    if first.n_unstable:
        raise StartError(f"the path begins at an unstable equilibrium, at which nothing rests: {first}")
    follower = _Follower(held, settings, landing == "motion", max_time, max_jumps, [], [], progress)
    status, message = follower.run(first, vertices)
    count = problem.evaluations - before + follower.stepped
    done = tuple(follower.segments), tuple(follower.jumps)
    return LoadPath(problem.name, vertices, *done, status, message, count, problem)


def _check_landing(landing: str, max_time: float, max_jumps: int) -> None:
    if landing not in LANDINGS:
        raise ParameterError(f"landing must be one of {', '.join(LANDINGS)}; got {landing!r}")
    check_numbers({"max_time": max_time, "max_jumps": max_jumps})
    if not (max_time > 0 and max_jumps >= 0):
        raise ParameterError(f"max_time must be positive and max_jumps not negative, got {max_time:g} and {max_jumps}")


def _sourced(source: Any) -> tuple[Any, Branch | None]:
    """Return the problem of a source, and the branch if it is one."""
    problem, given = (source.problem, source) if isinstance(source, Branch) else (source, None)
    if problem is None:
        raise MjcontError("the branch was loaded without its problem: mc.load(path, problem=...)")
    return problem, given


def _first(
    problem: Any, branch: Branch | None, vertex: Values, start: Any, keyframe: str | None, state: Any
) -> Point:
    """Return the equilibrium at which the path begins."""
    if branch is None or start is not None or keyframe is not None or state is not None:
        if start is None and branch is not None:
            start = branch.fixed
        if isinstance(start, Point):
            state = start.state if state is None else state
            start = {k: v for k, v in start.parameters.items() if k in problem.parameters or ":" in k}
        return find_equilibrium(problem, {**(start or {}), **vertex}, keyframe=keyframe, state=state)
    if set(vertex) - set(branch.free) - set(branch.fixed):
        raise ParameterError("the path changes a parameter that the branch does not know")
    (name, *_) = branch.free
    if len(branch.free) != 1 or name not in vertex:
        raise ParameterError(f"the branch is in {', '.join(branch.free)}: the path must change that, or give start=")
    if any(vertex[n] != branch.fixed[n] for n in vertex if n != name):
        raise BoundsError("the path begins off the branch: its first values are not those that the branch holds fixed")
    low, high = branch[name].min(), branch[name].max()
    at = [p for p in branch.at(**{name: vertex[name]}) if p.n_unstable == 0]
    unit = branch.unit(name)
    if not at:
        raise StartError(
            f"the branch has no stable point at {name} = {show(vertex[name], unit)}, where the path begins; it runs "
            f"from {show(low, unit)} to {show(high, unit)}"
        )
    if len(at) > 1:
        listed = "; ".join(str(p) for p in at)
        raise StartError(f"the branch has {len(at)} stable points where the path begins; give one as start=: {listed}")
    return at[0]


@dataclass(slots=True)
class _Lost:
    """Where a rest is lost: the point, its kind, the direction of the escape and why the walk ended there."""

    point: Point
    kind: str
    along: Array


@dataclass(slots=True)
class _Follower:
    """A load on its way: what has been followed, and how."""

    problem: Any
    settings: Settings
    inertia: bool
    max_time: float
    max_jumps: int
    segments: list[Segment]
    jumps: list[Jump]
    progress: Amount | None = None
    stepped: int = 0
    legs: int = 0

    def run(self, first: Point, vertices: Sequence[Values]) -> tuple[str, str]:
        """Follow all legs, as far as the time allows; return status and sentence."""
        try:
            with clock.limited(self.settings.max_seconds):
                return self._legs(first, vertices)
        except clock.TimeUp:
            return "max time", f"the limit of {self.settings.max_seconds:g} s was reached"

    def _legs(self, first: Point, vertices: Sequence[Values]) -> tuple[str, str]:
        at, rows, self.legs = first, 0, len(vertices) - 1
        for leg, target in enumerate(vertices[1:]):
            while any(target[n] != at.parameters[n] for n in target):
                segment, ended, lost = self._follow(at, target, leg)
                if segment is None:
                    return ended
                self.segments.append(segment)
                rows += len(segment.branch)
                if lost is None:
                    if ended[0] != "at bound":
                        return ended
                    at = segment.branch.row(int(segment.rows()[-1]))
                    at = replace(at, parameters={**at.parameters, **target})  # without the rounding of a scaled unknown
                    break
                if len(self.jumps) == self.max_jumps:
                    return "max jumps", f"{self.max_jumps} jumps were made"
                jump = self._jump(lost, target, rows - 1)
                self.jumps.append(jump)
                if jump.after is None:
                    return jump.status, f"the rest is lost at {jump.label}: {jump.message}"
                at = jump.after
        if not self.segments:
            return "done", "the path does not change the load"
        return "done", "the end of the path was reached"

    def _follow(self, at: Point, target: Values, leg: int) -> tuple[Segment | None, tuple[str, str], _Lost | None]:
        changing = [n for n in target if target[n] != at.parameters[n]]
        problem, name, high = self.problem, changing[0], target[changing[0]]
        values, low = dict(at.parameters), at.parameters[name]
        if len(changing) > 1:
            problem, name, low, high = Leg(self.problem, values, target), FRACTION, 0.0, 1.0
            values = {**values, FRACTION: 0.0}
        forward = 1 if high > low else -1
        free = Free(name, min(low, high), max(low, high), problem.parameter(name).unit)
        system = System(problem, values, [free])
        detectors = equilibrium_detectors(system, self.settings, {})
        stepper = OneByOne(system, self.settings, detectors)
        walker = Walker(stepper, _unstable(system, forward), frozenset({"LP", "HB", "BP"}))
        heard = self._hearing(leg, name, (low, high))
        traces = run_directions(walker, at.state, system.start_y(), (float(forward),), heard)
        if not traces[0].points:
            return None, (traces[0].end.status.value, traces[0].end.message), None
        branch = collect("equilibria", system, traces, (float(forward),), "along the load path", self.settings)
        branch, lost = _cut(branch, forward, high if name != FRACTION else 1.0, name)
        if name == FRACTION:
            branch = unwrapped(branch)
            if lost is not None:
                end = len(branch) - 1
                there = [p for p in branch.special_points if p.index == end]
                lost = replace(lost, point=there[0] if there else branch.row(end))
        return Segment(branch, forward, leg), branch.ends[0], lost

    def _hearing(self, leg: int, name: str, ends: tuple[float, float]) -> Progress | None:
        """Return what hears of the points of a leg whose parameter runs from one end to the other."""
        progress = self.progress
        if progress is None:
            return None
        (begin, end) = ends
        return lambda count, found: progress(leg + (found.parameters[name] - begin) / (end - begin), self.legs)

    def _jump(self, lost: _Lost, target: Values, index: int) -> Jump:
        """Let the state at which the rest is lost move, and return the jump."""
        problem, point = self.problem, lost.point
        near = lost.kind in ("BP", "HB")
        beyond = _toward(point.parameters, target, _BEYOND if near else _HAIR)
        rest_values = beyond if near else point.parameters
        x = problem.retract(point.state, lost.along)
        landing = escape(
            problem, x, beyond, rest_values=rest_values, left=point.state, max_time=self.max_time, inertia=self.inertia
        )
        self.stepped += landing.stepped
        count = sum(j.kind == lost.kind for j in self.jumps) + 1
        label = f"{lost.kind}{count}"
        energy, note = _released(problem, point, landing, lost.kind)
        message = landing.message
        if landing.point is None and lost.kind == "HB":
            message += ": the rest gives way to an oscillation"
        elif landing.status == "no rest" and self.inertia:
            message += '; landing="creep" lands without inertia, and max_time= waits longer'
        if lost.kind == "BP":
            message += "; which way it goes is decided by imperfections, one was chosen"
        return Jump(label, lost.kind, point, landing.point, index, energy, note, landing.time, landing.steps,
                    landing.status, message, landing.states, *_passage(problem, point, target))


def _toward(values: Values, target: Values, fraction: float) -> dict[str, float]:
    """Return parameter values a fraction of the rest of the way further."""
    return {**values, **{n: values[n] + fraction * (target[n] - values[n]) for n in target}}


def _passage(problem: Any, point: Point, target: Values) -> tuple[str, float, Passage | None]:
    """Return what the load changes first, its size there, and how a load that moves on to a target passes a fold."""
    ways = {n: target[n] - point.parameters[n] for n in target if target[n] != point.parameters[n]}
    vectors = point.vectors if isinstance(point, SpecialPoint) and point.kind == "LP" else {}
    if not ways or not {"v", "w"} <= set(vectors):
        return next(iter(target)), math.nan, None
    first, way = next(iter(ways.items()))
    local = Local(problem, point.state, point.parameters, tuple(ways), True)
    slopes = local.par @ np.array([w / way for w in ways.values()])
    size = abs(point.parameters[first])
    size = size if size > _NO_LOAD * abs(way) else abs(way)
    return first, size, passage(local, vectors["v"], vectors["w"], slopes)


def _unstable(system: System, forward: int) -> Any:
    """Return the function that ends a walk where stability is lost or the load would turn back."""

    def check(p: CurvePoint) -> str | None:
        if spectrum_of(p).n_unstable > 0:
            return "the rest is lost"
        if p.tangent[system.n] * forward < _TURNED:
            return "the load would have to turn back"
        return None

    return check


def _cut(branch: Branch, forward: int, target: float, name: str) -> tuple[Branch, _Lost | None]:
    """Return the stable part of a branch just walked, and where its rest is lost, or None."""
    order = np.arange(len(branch))[::forward]
    status, sentence = branch.ends[0]
    (low, high) = branch.free[name]
    if status == "at bound" and abs(branch[name][order[-1]] - target) < 1e-9 * (high - low):
        return branch, None
    special = {p.index: p for p in branch.special_points}
    if status == "at special point":
        last = len(order) - 1
    elif status in ("stopped", "at bound", "breaks off"):
        corners = [k for k, i in enumerate(order) if i in special and special[int(i)].kind in ("CO", "BP")]
        calm = [k for k, i in enumerate(order) if branch.n_unstable[i] == 0]
        last = corners[-1] if corners and corners[-1] >= len(order) - 2 else max(calm[-1] if calm else 0, 0)
    else:
        return branch, None
    at = int(order[last])
    before = int(order[max(last - 1, 0)])
    travel = branch.model.difference(branch.states[at], branch.states[before])
    point: Point = special.get(at, branch.row(at))
    kind = point.kind if isinstance(point, SpecialPoint) else "lost"
    if kind == "CO" and last + 1 < len(order):
        along = branch.model.difference(branch.states[int(order[last + 1])], branch.states[at])
    else:
        along = _critical(branch.model, point, kind, travel)
    along = along * _ASIDE / max(float(np.max(np.abs(along) / branch.model.state_scale)), 1e-300)
    cut = sliced(branch, *sorted((int(order[0]), at)))
    return replace(cut, ends=[(status, sentence)]), _Lost(point, kind, along)


def _critical(problem: Any, point: Any, kind: str, travel: Array) -> Array:
    """Return the direction in which a rest gives way: its null vector the way of travel, or the real part of a mode."""
    vector = getattr(point, "vectors", {}).get("v")
    if vector is None:
        local = Local(problem, point.state, point.parameters, (), False)
        vector = _mode(problem, local, kind)
    scale = problem.state_scale
    onward = float((vector / scale) @ (travel / scale))
    size = float(np.linalg.norm(vector / scale) * np.linalg.norm(travel / scale))
    if abs(onward) > 0.1 * size:
        return vector * np.sign(onward)
    return oriented(vector)


def _mode(problem: Any, local: Local, kind: str) -> Array:
    jac: Any = local.raw_jac
    jac = jac.toarray() if hasattr(jac, "toarray") else jac
    pencil = local.pencil
    if kind == "HB" and pencil.mass is not None and pencil.damping is not None:
        ev = quadratic_eigenvalues(pencil.mass, pencil.damping, -jac)
        s = ev[np.argmax(np.where(ev.imag > 0, ev.real, -np.inf))]
        _, _, vh = singular(s**2 * pencil.mass + s * pencil.damping - jac)
        return oriented(vh[-1].conj()).real
    values, vectors = eigenvectors(jac if pencil.mass is None else solve(pencil.mass, jac))
    return vectors[:, np.argmax(values.real)].real


def _released(problem: Any, point: Point, landing: Landing, kind: str) -> tuple[float | None, str]:
    """Return the potential energy released at fixed load, or None and why it is not defined."""
    if landing.point is None:
        return None, "the motion does not rest"
    values = landing.point.parameters
    states = (landing.point.state,) if kind == "CO" else (point.state, landing.point.state)
    for x in states:
        reason = without_potential(problem, x, values)
        if reason:
            return None, reason
    energies = potential_energy(problem, np.array([point.state, landing.point.state]), values, loads=True)
    return float(energies[0] - energies[1]), ""
