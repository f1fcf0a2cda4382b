"""What an animation shows at every frame: states and parameter values evenly along a history, a branch or a load path.

No MuJoCo and no matplotlib here: a result becomes a `Track` of rows, a track `Frame`s between its rows.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.drawing.axes import readable
from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import KINDS
from mjcont.results.branch import Branch
from mjcont.results.histories import History
from mjcont.results.loadpaths import Jump, LoadPath
from mjcont.results.orbits import CycleBranch
from mjcont.results.points import show

Result = History | Branch | LoadPath
# how far a jump counts at least, in parts of the diagram: shorter ones would pass unseen
_SHORTEST_JUMP = 0.25


@dataclass(frozen=True, slots=True)
class Track:
    """Rows of a result in the order in which they are shown.

    Attributes
    ----------
    problem : the mechanism.
    states : (N, nq).
    values : a mapping of all known parameters for each row.
    x, y : (N,) columns of the diagram, SI and radians.
    clock : (N,) what frames are evenly spaced in: time in s, or arclength in the diagram.
    notes : what to say between a row and the next, such as "jump at a fold".
    named : the parameters that captions show, with their units; none where they show the clock's time.
    """

    problem: Mechanism
    states: Array
    values: Sequence[Mapping[str, float]]
    x: Array
    y: Array
    clock: Array
    notes: Sequence[str]
    named: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Frame:
    """One frame: a pose, its place in the diagram in SI and radians, the last row passed, a caption."""

    state: Array
    values: Mapping[str, float]
    x: float
    y: float
    row: int
    caption: str


def default_columns(result: Result) -> tuple[str, str]:
    """Return what a diagram shows unless told otherwise."""
    if isinstance(result, Branch):
        free = list(result.free)
        first = next((c.name for c in result.columns.values() if c.role == "observable"), free[-1])
        return free[0], free[1] if len(free) > 1 else first
    if isinstance(result, LoadPath):
        return result.names[0], next(iter(result.final.observables), result.names[-1])
    return "time", next((c.name for c in result.columns.values() if c.role == "observable"), "time")


def track_of(result: Result, x: str, y: str) -> Track:
    """Return the rows of a result.

    Raises
    ------
    MjcontError
        If it is no result with poses, has no Mechanism, or less than two rows.
    NameLookupError
        If it has no such column.
    """
    if isinstance(result, CycleBranch):
        raise MjcontError("animate shows one orbit of a curve of orbits: animate(curve[12].orbit, ...)")
    if not isinstance(result, Result):
        raise MjcontError(f"animate shows a History, a Branch or a LoadPath, got a {type(result).__name__}")
    mechanism_of(result)
    if len(result) < 2:
        raise MjcontError(f"an animation needs at least two rows, and this {type(result).__name__} has {len(result)}")
    if isinstance(result, History):
        return _of_history(result, x, y)
    return _of_branch(result, x, y) if isinstance(result, Branch) else _of_path(result, x, y)


def mechanism_of(result: Result) -> Mechanism:
    """Return the mechanism of a result; an MjcontError where it has none."""
    if not isinstance(result.problem, Mechanism):
        raise MjcontError("a result without a Mechanism has no pose to show: load its file with its model")
    return result.problem


def frames_of(track: Track, count: int) -> list[Frame]:
    """Return frames evenly spaced on the track's clock, from its first row to its last."""
    frames = []
    digits = max(0, 2 - math.floor(math.log10(max(float(track.clock[-1] - track.clock[0]), 1e-9))))
    for now in np.linspace(track.clock[0], track.clock[-1], count):
        i = int(np.clip(np.searchsorted(track.clock, now, side="right") - 1, 0, len(track.clock) - 2))
        span = track.clock[i + 1] - track.clock[i]
        part = float((now - track.clock[i]) / span) if span > 0 else 0.0
        a, b = track.values[i], track.values[i + 1]
        values = {n: a[n] + part * (b[n] - a[n]) for n in a}
        step = track.problem.difference(track.states[i + 1], track.states[i])
        place = [float(c[i] + part * (c[i + 1] - c[i])) for c in (track.x, track.y)]
        state = track.problem.retract(track.states[i], part * step)
        shown = ", ".join(f"{readable(n)} = {show(values[n], u, 6)}" for n, u in track.named.items())
        shown = shown or f"time = {now:.{digits}f} s"
        note = f", {track.notes[i]}" if track.notes[i] else ""
        frames.append(Frame(state, values, place[0], place[1], i, shown + note))
    return frames


def _of_history(history: History, x: str, y: str) -> Track:
    inputs = [c.name for c in history.columns.values() if c.role == "parameter"]
    values = [{**history.fixed, **{n: float(history[n][i]) for n in inputs}} for i in range(len(history))]
    notes = [""] * len(history)
    return Track(mechanism_of(history), history.states, values, history[x], history[y], history["time"], notes, {})


def _of_branch(branch: Branch, x: str, y: str) -> Track:
    values = [branch.parameters_at(i) for i in range(len(branch))]
    notes = [str(s) for s in branch.stability] if branch.rated else [""] * len(branch)
    named = {n: branch.unit(n) for n in branch.free}
    xs, ys = branch[x], branch[y]
    return Track(mechanism_of(branch), branch.states, values, xs, ys, _arclength(xs, ys, xs, ys), notes, named)


def _of_path(path: LoadPath, x: str, y: str) -> Track:
    """Return the rows of a path with the motions of its jumps between them."""
    xs, ys, states = path[x], path[y], path.states
    values = [s.branch.parameters_at(int(i)) for s in path.segments for i in s.rows()]
    notes, clock = [""] * len(path), _arclength(xs, ys, xs, ys)
    # from the last row on, so that those before keep their numbers
    for jump in sorted(path.jumps, key=lambda j: -j.index):
        i = jump.index
        motion = _motion(path, jump)
        if len(motion) < 2:
            continue
        here = {n: float(jump.before[n]) for n in values[i]}
        seen = [_seen(mechanism_of(path), motion, here, n) for n in (x, y)]
        step = _state_arclength(mechanism_of(path), motion)
        length = max(float(_arclength(seen[0][[0, -1]], seen[1][[0, -1]], xs, ys)[-1]), _SHORTEST_JUMP)
        after = clock[i + 1 :] - (clock[i + 1] if i + 1 < len(clock) else 0.0)
        ticks = clock[i] + length * step / max(float(step[-1]), 1e-300)
        clock = np.concatenate([clock[: i + 1], ticks, ticks[-1] + after])
        xs, ys = (np.concatenate([c[: i + 1], s, c[i + 1 :]]) for c, s in ((xs, seen[0]), (ys, seen[1])))
        states = np.concatenate([states[: i + 1], motion, states[i + 1 :]])
        values[i + 1 : i + 1] = [here] * len(motion)
        notes[i + 1 : i + 1] = [_said(jump)] * len(motion)
    return Track(mechanism_of(path), states, values, xs, ys, clock, notes, {n: path.unit(n) for n in path.names})


def _said(jump: Jump) -> str:
    # by kind: a path counts its labels along itself, a branch beside it along the branch
    return f"jump at a {KINDS[jump.kind].name}" if jump.kind in KINDS else "jump"


def _motion(path: LoadPath, jump: Jump) -> Array:
    """Return the states of a jump from the rest that is lost to the one where it lands, (m, nq)."""
    parts = [jump.before.state[None], np.reshape(jump.states, (-1, path.states.shape[1]))]
    motion = np.concatenate(parts + ([jump.after.state[None]] if jump.after is not None else []))
    return motion[np.isfinite(motion).all(axis=1)]


def _seen(problem: Mechanism, states: Array, values: Mapping[str, float], name: str) -> Array:
    """Return a column for states at fixed parameter values."""
    if name in values:
        return np.full(len(states), values[name])
    return problem.measure(states, problem.values(values), [name])[:, 0]


def _arclength(xs: Array, ys: Array, all_x: Array, all_y: Array) -> Array:
    """Return the length along a curve whose axes are both scaled to the diagram's."""
    parts = [np.diff(c) / (float(np.ptp(every)) or 1.0) for c, every in ((xs, all_x), (ys, all_y))]
    return _accumulated(np.hypot(*parts))


def _state_arclength(problem: Any, states: Array) -> Array:
    steps = [problem.difference(b, a) / problem.state_scale for a, b in zip(states, states[1:], strict=False)]
    return _accumulated(np.linalg.norm(steps, axis=1))


def _accumulated(lengths: Array) -> Array:
    return np.concatenate([[0.0], np.cumsum(np.nan_to_num(lengths))])
