"""Stepping models through MuJoCo's own integrators: many runs at once, their inputs held at mid-step values.

Controls, and gravity as a function of time, ride along in `Batch.rollout`: a change of gravity is applied as a force
at every body's centre of mass, which is the same to rounding. An input that changes other fields of the model is
written before each step, one run after the other.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from mjcont.curves.collect import Amount
from mjcont.errors import ParameterError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.mechanism.parameters import GRAVITY_ANGLE, LOAD_FACTOR
from mjcont.mechanism.writer import FieldWriter, Gravity
from mjcont.models.quiet import quiet
from mjcont.motion.signals import Controller, Observed, Signal, check_range, controlled
from mjcont.numerics.equations.problem import Array

INTEGRATORS = {
    "discrete": mujoco.mjtIntegrator.mjINT_DISCRETE,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}
REST_TIME = 1.0
_NUMBERS = 2_000_000
_FASTEST = 1e8
_TIME = int(mujoco.mjtState.mjSTATE_TIME)
_CONTROL = int(mujoco.mjtState.mjSTATE_CTRL)
_FORCE = int(mujoco.mjtState.mjSTATE_XFRC_APPLIED)


@dataclass(frozen=True, slots=True)
class Case:
    """One run: parameter values at its beginning, inputs by parameter, and where it begins."""

    values: Mapping[str, float]
    signals: Mapping[str, Signal]
    controllers: Mapping[str, Controller]
    x: Array
    v: Array

    def at(self, time: float) -> dict[str, float]:
        """Return all values at a time, controllers' apart."""
        return {**self.values, **{n: s.at(time) for n, s in self.signals.items() if not s.constant}}


@dataclass(frozen=True, slots=True)
class Grid:
    """Steps of one length; every so many are recorded, and every so many controllers are sampled."""

    step: float
    count: int
    every: int
    hold: int

    def halved(self) -> Grid:
        """Return the grid with half the step, recorded and sampled at the same times."""
        return Grid(self.step / 2.0, 2 * self.count, 2 * self.every, 2 * self.hold)


@dataclass(slots=True)
class Track:
    """What one run left: states at the recorded times, controllers' outputs then, and why it ended early."""

    states: list[Array]
    velocities: list[Array]
    outputs: dict[str, list[float]]
    ended: str = ""
    held: dict[str, float] = field(default_factory=dict)

    @classmethod
    def of(cls, case: Case) -> Track:
        """Begin at a case's start."""
        return cls([case.x.copy()], [case.v.copy()], {n: [] for n in case.controllers})

    def record(self, x: Array, v: Array) -> None:
        """Keep a sample, with what the controllers put out during the step before it."""
        self.states.append(x.copy())
        self.velocities.append(v.copy())
        for name, series in self.outputs.items():
            series.append(self.held.get(name, 0.0))


def run(
    mechanism: Mechanism,
    cases: Sequence[Case],
    grid: Grid,
    integrator: str,
    *,
    nthread: int = 1,
    rest: float | None = None,
    progress: Amount | None = None,
) -> list[Track]:
    """Step every case over the grid and return its track.

    `rest` is the scaled speed below which a run may end; `progress(time, end)` hears how far the runs are.
    """
    model = mechanism.simulation_model()
    if integrator in INTEGRATORS:
        model.opt.integrator = INTEGRATORS[integrator]
    model.opt.timestep = grid.step
    tracks = [Track.of(c) for c in cases]
    late = bool(model.actuator_delay.any())
    slow = [i for i, c in enumerate(cases) if late or _changes_fields(mechanism, c)]
    fast = [i for i in range(len(cases)) if i not in set(slow)]
    with quiet:
        if fast:
            batched = _Batched(mechanism, model, [cases[i] for i in fast], [tracks[i] for i in fast], grid, nthread)
            _until_interrupted(partial(batched.run, rest, progress), batched.tracks)
        for i in slow:
            case, track = cases[i], tracks[i]
            _until_interrupted(partial(_step_singly, mechanism, model, case, track, grid, rest, progress), [track])
    return tracks


def _until_interrupted(work: Callable[[], None], tracks: Sequence[Track]) -> None:
    try:
        work()
    except KeyboardInterrupt:
        for track in tracks:
            track.ended = track.ended or "interrupted"


def _changes_fields(mechanism: Mechanism, case: Case) -> bool:
    """Whether inputs change more than controls and gravity, or reach their actuators late: not for a batch."""
    kinds = [mechanism.parameter(n).kind for n, s in case.signals.items() if not s.constant]
    others = any(kind not in ("control", "gravity") for kind in kinds)
    return others or any(mechanism.parameter(n).kind != "control" for n in case.controllers)


def _at_rest(mechanism: Mechanism, track: Track, grid: Grid, rest: float | None) -> bool:
    """Whether the scaled speed has stayed below `rest` over the last second."""
    window = max(int(np.ceil(REST_TIME / (grid.step * grid.every))), 2)
    if rest is None or len(track.velocities) <= window:
        return False
    return bool(np.abs(np.array(track.velocities[-window:]) / mechanism.state_scale).max() < rest)


def _wild(x: Array, v: Array) -> bool:
    return not (np.all(np.isfinite(x)) and np.all(np.isfinite(v)) and np.abs(v).max(initial=0.0) < _FASTEST)


class _Laws:
    """The controllers of several cases, sampled together."""

    def __init__(self, mechanism: Mechanism, cases: Sequence[Case], tracks: Sequence[Track]) -> None:
        self._mechanism, self._cases, self._tracks = mechanism, cases, tracks
        groups: dict[tuple[str, int], list[int]] = {}
        for i, case in enumerate(cases):
            for name, controller in case.controllers.items():
                shared = id(controller.law) if controller.vectorised else -1 - i
                groups.setdefault((name, shared), []).append(i)
        self._groups = [(name, rows, cases[rows[0]].controllers[name]) for (name, _), rows in groups.items()]
        self._fresh = [controller.fresh() for _, _, controller in self._groups]
        self.any = bool(groups)

    def sample(self, time: float, states: Array, velocities: Array, alive: Sequence[int]) -> None:
        """Call every controller at the cases' states (m, nq) and leave its output in the tracks."""
        values = {i: {**self._cases[i].at(time), **self._tracks[i].held} for i in alive} if self.any else {}
        seen = {i: Observed(self._mechanism, states[i], velocities[i], [v]) for i, v in values.items()}
        for (name, rows, controller), law in zip(self._groups, self._fresh, strict=True):
            bounds = self._mechanism.parameter(name).hard_bounds
            if controller.vectorised:
                many = Observed(self._mechanism, states[rows], velocities[rows], [
                    values.get(i, self._cases[i].values) for i in rows])
                outputs = controlled(name, law(time, many), len(rows), bounds)
            elif rows[0] in seen:
                outputs = controlled(name, law(time, seen[rows[0]]), 1, bounds)
            else:
                continue
            for i, output in zip(rows, outputs, strict=True):
                if i in seen:
                    self._tracks[i].held[name] = float(output)


class _Batched:
    """Many runs in one batch, whose inputs are controls and gravity."""

    def __init__(
        self,
        mechanism: Mechanism,
        model: mujoco.MjModel,
        cases: Sequence[Case],
        tracks: Sequence[Track],
        grid: Grid,
        nthread: int,
    ) -> None:
        self.mechanism, self.cases, self.tracks, self.grid = mechanism, cases, tracks, grid
        self.alive = list(range(len(cases)))
        self.laws = _Laws(mechanism, cases, tracks)
        self.states, self.velocities = np.array([c.x for c in cases]), np.array([c.v for c in cases])
        self.models, inputs = self._write(model)
        self.ctrl = inputs["ctrl"]
        rule = Gravity.of(model)
        self.gravity = rule.g0, np.cross(rule.axis, rule.g0), np.dot(rule.axis, rule.g0) * rule.axis
        self.batch = Batch(self.models[0], len(cases), nthread=min(nthread, len(cases)))
        if any(m is not self.models[0] for m in self.models):
            self.batch.set_models(self.models)
        for name, rows in inputs.items():
            if rows.size:
                self.batch.bind(name)[:] = rows
        self.batch.qpos, self.batch.qvel = self.states, self.velocities
        gravity = (GRAVITY_ANGLE, LOAD_FACTOR)
        self.gusts = any(n in c.signals and not c.signals[n].constant for c in cases for n in gravity)
        self.width = model.nu + (6 * model.nbody if self.gusts else 0)

    def _write(self, model: mujoco.MjModel) -> tuple[list[mujoco.MjModel], dict[str, Array]]:
        """Return a model for each case (shared where only controls differ), and the inputs in MuJoCo's data."""
        parameters = self.mechanism.parameters
        written: dict[tuple[float, ...], FieldWriter] = {}
        models, inputs = [], []
        for case in self.cases:
            key = tuple(v for n, v in case.values.items() if parameters[n].kind != "control")
            if key not in written:
                own = mujoco.MjModel.__copy__(model)
                written[key] = self.mechanism.writer(own)
            written[key].write(parameters, case.values)
            models.append(written[key].model)
            inputs.append(written[key].inputs.copies())
        return models, {name: np.array([i[name] for i in inputs]) for name in inputs[0]}

    def run(self, rest: float | None, progress: Amount | None) -> None:
        """Step all cases to the end, dropping those that end early."""
        grid = self.grid
        size = len(self.cases) * (self.width + 2 * self.states.shape[1])
        piece = max(_NUMBERS // size, 64)
        if rest is not None:
            piece = min(piece, max(int(REST_TIME / grid.step), 1000))
        for begin in range(0, grid.count, piece):
            length = min(piece, grid.count - begin)
            control = self._table(begin, length)
            first = 0
            while first < length and self.alive:
                here = length - first
                if self.laws.any:
                    here = min(here, grid.hold - (begin + first) % grid.hold)
                    if (begin + first) % grid.hold == 0:
                        time = (begin + first) * grid.step
                        self.laws.sample(time, self.states, self.velocities, self.alive)
                    self._hold(control[:, first : first + here])
                self._advance(begin + first, control[:, first : first + here])
                first += here
            for i in list(self.alive):
                if _at_rest(self.mechanism, self.tracks[i], grid, rest):
                    self.tracks[i].ended = "at rest"
                    self.alive.remove(i)
            if not self.alive:
                return
            if progress is not None:
                progress((begin + length) * grid.step, grid.count * grid.step)

    def _advance(self, begin: int, control: Array) -> None:
        """Step the runs that are still alive and record them."""
        rows, grid, length = np.array(self.alive), self.grid, control.shape[1]
        spec = _CONTROL | (_FORCE if self.gusts else 0)
        given = control[rows] if self.width else None
        out = self.batch.rollout(length, control=given, control_spec=spec, record=("qpos", "qvel", _TIME), ids=rows)
        done = begin + 1 + np.arange(length)
        kept = np.flatnonzero(done % grid.every == 0)
        for r, i in enumerate(rows.tolist()):
            x, v, times = out["qpos"][r], out["qvel"][r], out[_TIME][r, :, 0]
            for k in kept:
                # a run that MuJoCo has stopped repeats its last record
                if _wild(x[k], v[k]) or times[k] < (done[k] - 0.5) * grid.step:
                    break
                self.tracks[i].record(x[k], v[k])
            self.states[i], self.velocities[i] = x[-1], v[-1]
            if _wild(x[-1], v[-1]) or times[-1] < (done[-1] - 0.5) * grid.step:
                self.tracks[i].ended = "diverged"
                self.alive.remove(i)

    def _table(self, begin: int, length: int) -> Array:
        """Return controls and forces at every step, (cases, length, width), from the inputs at mid-step."""
        times = (begin + 0.5 + np.arange(length)) * self.grid.step
        table = np.zeros((len(self.cases), length, self.width))
        nu = self.ctrl.shape[1]
        for i in self.alive:
            case = self.cases[i]
            table[i, :, :nu] = self.ctrl[i]
            series = {n: s.series(times) for n, s in case.signals.items() if not s.constant}
            for name, values in series.items():
                parameter = self.mechanism.parameter(name)
                check_range(parameter, values, times)
                for target in parameter.targets:
                    for index in target.index:
                        table[i, :, index] = target.offset + target.factor * values
            if self.gusts:
                table[i, :, nu:] = self._weights(i, series, length)
        return table

    def _weights(self, i: int, series: Mapping[str, Array], length: int) -> Array:
        """Return the forces (length, 6 nbody) that turn the case's own gravity into gravity at every step."""
        model, values = self.models[i], self.cases[i].values
        if model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_GRAVITY:
            return np.zeros((length, 6 * model.nbody))
        angle = series.get(GRAVITY_ANGLE, np.full(length, values[GRAVITY_ANGLE]))
        factor = series.get(LOAD_FACTOR, np.full(length, values[LOAD_FACTOR]))
        g, turned, along = self.gravity
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        change = factor[:, None] * (c * g + s * turned + (1.0 - c) * along) - model.opt.gravity
        forces = np.zeros((length, model.nbody, 6))
        forces[:, :, :3] = (model.body_mass * (1.0 - model.body_gravcomp))[:, None] * change[:, None, :]
        return forces.reshape(length, -1)

    def _hold(self, control: Array) -> None:
        for i in self.alive:
            for name, output in self.tracks[i].held.items():
                for target in self.mechanism.parameter(name).targets:
                    control[i][:, list(target.index)] = target.offset + target.factor * output


def _step_singly(
    mechanism: Mechanism, model: mujoco.MjModel, case: Case, track: Track, grid: Grid, rest: float | None,
    progress: Amount | None,
) -> None:
    """Step one case, writing the model's fields before each step."""
    own = mujoco.MjModel.__copy__(model)
    writer, data = mechanism.writer(own), mujoco.MjData(own)
    laws = _Laws(mechanism, [case], [track])
    writer.write(mechanism.parameters, case.at(0.0))
    writer.inputs.begin(data)
    data.qpos[:], data.qvel[:] = case.x, case.v
    for k in range(grid.count):
        time = (k + 0.5) * grid.step
        values: dict[str, Any] = case.at(time)
        for name in case.signals:
            check_range(mechanism.parameter(name), np.array([values[name]]), np.array([time]))
        if laws.any and k % grid.hold == 0:
            laws.sample(k * grid.step, data.qpos[None], data.qvel[None], [0])
        writer.write(mechanism.parameters, {**values, **track.held})
        if writer.failure:
            raise ParameterError(f"at t = {time:g} s {writer.failure}")
        writer.inputs.drive(data)
        mujoco.mj_step(own, data)
        if _wild(data.qpos, data.qvel):
            track.ended = "diverged"
            return
        if (k + 1) % grid.every == 0:
            track.record(data.qpos, data.qvel)
            if progress is not None:
                progress((k + 1) * grid.step, grid.count * grid.step)
            if _at_rest(mechanism, track, grid, rest):
                track.ended = "at rest"
                return
