"""Escapes: the motion, in time, of a mechanism or vector field that has lost its rest, until it rests elsewhere.

A Mechanism moves by MuJoCo's own stepping with the damping it has, a vector field by u' = f(u, p). How long a load
lingers at a fold depends on how fast it changes, and is infinite in the quasi-static limit: the motion is timed from a
little way down the escape, to where it has crept.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import mujoco
import numpy as np
from mujoco.batch import Batch
from scipy.integrate import solve_ivp

from mjcont.curves.collect import make_point
from mjcont.models.quiet import quiet
from mjcont.numerics.equations.clock import check
from mjcont.numerics.equations.newton import solve
from mjcont.numerics.equations.problem import Array, Values
from mjcont.numerics.equations.system import System
from mjcont.numerics.search.creep import creep
from mjcont.results.points import Point

_CHUNK = 200
_LONGEST_CHUNK = 5000
_GROWTH = 1.2
_CALM = 0.3
# a motion whose oscillation, in scaled coordinates, is smaller than this has come to rest
_AMPLITUDE = 1e-2
_DISTINCT = 3e-3
_LEAD = 2e-2
_BEYOND = 100.0
_SAMPLES = 200


@dataclass(frozen=True, slots=True)
class Landing:
    """Where an escape ended.

    Attributes
    ----------
    point : the equilibrium it rests at, corrected by Newton's method; None if it does not rest.
    status : "rest", "no rest", "diverged" or "interrupted".
    message : a sentence.
    time : duration of the motion in s; NaN for creep.
    steps : forward evaluations that it took.
    stepped : those among them that the problem did not count: MuJoCo's own steps.
    states : (m, nq) samples of the motion, from its beginning to its end.
    """

    point: Point | None
    status: str
    message: str
    time: float
    steps: int
    stepped: int
    states: Array


class _Motion(Protocol):
    """A motion that goes on in chunks."""

    time: float
    x: Array
    v: Array

    def advance(self) -> tuple[Array, float]: ...


class _MujocoMotion:
    """Stepping in MuJoCo's own loop, in chunks that grow."""

    def __init__(self, mechanism: Any, x: Array, values: Values) -> None:
        model = mechanism.simulation_model()
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
        writer = mechanism.writer(model)
        writer.write(mechanism.parameters, values)
        self._batch, self._ctrl = Batch(model, 1, nthread=1), writer.inputs.ctrl.copy()
        self.x, self.v = x.copy(), np.zeros(mechanism.n)
        writer.inputs.put_rows(writer.inputs.bound(self._batch))
        self._batch.qpos, self._batch.qvel = x, self.v
        self._step, self._chunk, self._scale = float(model.opt.timestep), float(_CHUNK), mechanism.state_scale
        self.time, self.steps = 0.0, 0

    def advance(self) -> tuple[Array, float]:
        """Go on for a chunk; return its states and its largest scaled speed."""
        length = int(self._chunk)
        self._chunk = min(_GROWTH * self._chunk, _LONGEST_CHUNK)
        with quiet:
            out = self._batch.rollout(length, control=np.tile(self._ctrl, (1, length, 1)), record=("qpos", "qvel"))
        states, velocities = out["qpos"][0].copy(), out["qvel"][0].copy()
        self.x, self.v = states[-1], velocities[-1]
        self.time += length * self._step
        self.steps += length
        return states, float(np.abs(velocities / self._scale).max())


class _FieldMotion:
    """Integration of u' = f(u, p) over intervals that grow."""

    def __init__(self, problem: Any, x: Array, values: Values) -> None:
        self._problem, self._values, self._limit = problem, values, _limit(problem, x)
        rates = np.abs(make_point(problem, x, values).eigenvalues)
        self._span = 1.0 / max(float(rates.max()), 1e-9)
        self.x, self.v, self.time = x.copy(), np.zeros(0), 0.0

    def advance(self) -> tuple[Array, float]:
        """Go on for an interval; return its states and its largest scaled speed."""
        problem, values = self._problem, self._values

        def room(t: float, u: Array) -> float:
            return 2.0 * self._limit - float(np.abs(u / problem.state_scale).max())

        room.terminal = True  # type: ignore[attr-defined]  # a solution may run to infinity in finite time
        with np.errstate(all="ignore"):
            run = solve_ivp(
                lambda t, u: problem.residual(u, values), (0.0, self._span), self.x, "LSODA", rtol=1e-8,
                atol=1e-10 * problem.state_scale, events=room,
            )
        states = run.y.T if run.success else np.full((1, problem.n), np.nan)
        self.x, self.time = states[-1].copy(), self.time + float(run.t[-1])
        self._span *= _GROWTH
        speeds = np.array([problem.residual(u, values) for u in states]) / problem.state_scale
        return states, float(np.abs(speeds).max())


def escape(
    problem: Any, x: Array, values: Values, *, rest_values: Values, left: Array, max_time: float, inertia: bool = True
) -> Landing:
    """Let a state move until it rests, and return where.

    Parameters
    ----------
    x : where it starts from, at rest: a little beside the equilibrium `left` that it has lost.
    values, rest_values : parameters of the motion, and those at which the rest found is corrected.
    max_time : in s, after which it counts as not coming to rest.
    inertia : False for creep, the limit of very large damping.
    """
    if not inertia:
        return _by_creep(problem, x, values, rest_values, left)
    before = problem.evaluations
    with np.errstate(all="ignore"):
        x = creep(problem, x, values, reach=0.5 * _LEAD, away=_LEAD).x
    motion = (_MujocoMotion if hasattr(problem, "simulation_model") else _FieldMotion)(problem, x, values)
    kept, peak, point = [x[None]], 0.0, None
    status, message = "no rest", ""
    limit = _limit(problem, x)
    try:
        while motion.time < max_time:
            check()
            states, speed = motion.advance()
            far = np.abs(motion.x[: problem.n] / problem.state_scale).max()
            if not far < limit:
                status, message = "diverged", f"the motion diverged after t = {motion.time:.4g} s"
                break
            kept.append(states[:: max(len(states) // 20, 1)])
            peak = max(peak, speed)
            if speed <= _CALM * peak:
                point = resting(problem, motion.x, motion.v, rest_values, left)
                if point is not None:
                    status, message = "rest", f"at rest after {motion.time:.4g} s"
                    break
        else:
            message = f"not at rest after {motion.time:.4g} s: it oscillates or drifts"
    except KeyboardInterrupt:
        status, message = "interrupted", f"stopped by the user after t = {motion.time:.4g} s of the escape"
    stepped = motion.steps if isinstance(motion, _MujocoMotion) else 0
    steps = stepped + problem.evaluations - before
    return Landing(point, status, message, motion.time, steps, stepped, _thinned(np.concatenate(kept)))


def resting(problem: Any, x: Array, v: Array, values: Values, left: Array) -> Point | None:
    """Return the stable equilibrium that a state of motion is about to rest at, or None.

    The oscillation left, by its distance and by its speed over the slowest rate there, must be small.
    """
    c = solve(System(problem, values, ()), x, np.zeros(0), most=10, reach=0.1)
    if c.failure or _apart(problem, c.x, left) < _DISTINCT:
        return None
    point = make_point(problem, c.x, values)
    if point.n_unstable:
        return None
    rates = np.abs(point.eigenvalues)
    slowest = float(rates[rates > 1e-9 * rates.max()].min(initial=np.inf))
    speed = float(np.abs(v / problem.state_scale).max(initial=0.0)) if len(v) else 0.0
    return point if _apart(problem, c.x, x) + speed / slowest < _AMPLITUDE else None


def _limit(problem: Any, x: Array) -> float:
    """Return the scaled coordinate beyond which a motion that begins at x counts as diverging."""
    return _BEYOND * max(1.0, float(np.abs(x[: problem.n] / problem.state_scale).max()))


def _apart(problem: Any, a: Array, b: Array) -> float:
    return float(np.max(np.abs(problem.difference(a, b)) / problem.state_scale))


def _by_creep(problem: Any, x: Array, values: Values, rest_values: Values, left: Array) -> Landing:
    before = problem.evaluations
    with np.errstate(all="ignore"):
        end = creep(problem, x, values)
    point = None if end.failure else resting(problem, end.x, np.zeros(0), rest_values, left)
    steps = problem.evaluations - before
    if point is None:
        message = str(end.failure or "the creeping motion ended where nothing rests stably")
        return Landing(None, "no rest", message, float("nan"), steps, 0, np.array([x, end.x]))
    return Landing(point, "rest", f"at rest after {end.steps} steps of creep", float("nan"), steps, 0,
                   np.array([x, point.state]))


def _thinned(states: Array) -> Array:
    return states[np.unique(np.linspace(0, len(states) - 1, min(_SAMPLES, len(states))).astype(int))]
