"""Time histories: MuJoCo's own stepping under inputs that vary with time, as named columns with units."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from mjcont.branch import Column, Point
from mjcont.continuation import start_from
from mjcont.errors import ParameterError, unknown_name
from mjcont.mechanism import Mechanism
from mjcont.numerics.problem import Array
from mjcont.writer import FieldWriter

Input = float | Callable[[float], float] | tuple[Any, Any]

INTEGRATORS = {
    "discrete": mujoco.mjtIntegrator.mjINT_DISCRETE,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}
_CHUNK = 20000


@dataclass(frozen=True, slots=True)
class History:
    """A time history.

    Attributes
    ----------
    columns : mapping of name to Column: "time", the inputs, every observable; each (N,), SI and radians.
    states, velocities : (N, nq) and (N, nv) arrays.
    status, message : "done" or "diverged", and a sentence.
    settings : integrator, time step, duration.
    problem : the Mechanism.
    """

    columns: Mapping[str, Column]
    states: Array
    velocities: Array
    status: str
    message: str
    settings: Mapping[str, Any]
    name: str = ""
    problem: Any = field(repr=False, default=None)

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.states)

    def __getitem__(self, name: str) -> Array:
        """Return a column, (N,)."""
        if name not in self.columns:
            raise unknown_name("column", name, self.columns)
        return self.columns[name].values

    def unit(self, name: str) -> str:
        """Return the unit of a column."""
        if name not in self.columns:
            raise unknown_name("column", name, self.columns)
        return self.columns[name].unit

    @property
    def units(self) -> dict[str, str]:
        """Units of all columns."""
        return {c.name: c.unit for c in self.columns.values()}

    def to_csv(self, path: str | Path, *, degrees: bool = True) -> Path:
        """Write the columns as CSV with units in the header."""
        from mjcont.storage import write_columns

        return write_columns(self.columns, path, degrees=degrees)

    def __str__(self) -> str:
        """Return a one-line summary."""
        s = self.settings
        return (
            f"{self.name}: time history of {s['duration']:g} s, {len(self)} samples, "
            f"{s['integrator']} with a step of {s['timestep']:g} s: {self.message}"
        )


def simulate(
    mechanism: Mechanism,
    inputs: Mapping[str, Input] | None = None,
    duration: float = 10.0,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    velocity: Any = None,
    timestep: float | None = None,
    integrator: str = "discrete",
    samples: int = 2000,
) -> History:
    """Return the motion of a mechanism under inputs that vary with time.

    Parameters
    ----------
    inputs : mapping of parameter to number, function of time, or (times, values)
        Values between given times are interpolated linearly.
    duration : float
        In s.
    start : dict of parameter values, or a point
        With `keyframe` or `state` it says where the motion begins; at rest unless `velocity` (nv,) is given.
    timestep : float, optional
        In s; default the model's own.
    integrator : {"discrete", "implicitfast", "implicit", "Euler", "RK4"}
        "discrete" is implicit in the stiffness of bushes and stable with any of it; "RK4" is the most accurate where
        the step resolves the fastest bush mode.
    samples : int
        About how many samples are recorded, evenly spaced in time.

    Returns
    -------
    History
        Motion that diverges ends it early, with a status that says so.

    Raises
    ------
    NameLookupError, ParameterError, BoundsError
        See their messages.
    """
    if integrator not in INTEGRATORS:
        raise unknown_name("integrator", integrator, INTEGRATORS)
    x, values = start_from(mechanism, start, keyframe, state)
    functions = {name: _as_function(name, given) for name, given in (inputs or {}).items()}
    values = mechanism.values({**values, **{n: f(0.0) for n, f in functions.items()}})
    model = mechanism.simulation_model()
    model.opt.integrator = INTEGRATORS[integrator]
    model.opt.timestep = timestep or model.opt.timestep
    step = float(model.opt.timestep)
    if not (duration > 0 and step > 0 and duration >= step):
        raise ParameterError(f"duration ({duration:g} s) must be at least one time step ({step:g} s)")
    count = round(duration / step)
    every = max(count // max(samples, 1), 1)
    v = np.zeros(mechanism.n) if velocity is None else np.array(velocity, dtype=float)
    if v.shape != (mechanism.n,):
        raise ParameterError(f"velocity must have shape ({mechanism.n},), got {v.shape}")
    run = _Run(mechanism, model, values, functions, x, v, count, every)
    controls_only = all(mechanism.parameter(n).kind == "control" for n in functions) and not model.actuator_delay.any()
    states, velocities = run.by_rollout() if controls_only else run.by_steps()
    return _history(mechanism, run, states, velocities, duration, integrator, step)


def _as_function(name: str, given: Input) -> Callable[[float], float]:
    if callable(given):
        return given
    if isinstance(given, tuple):
        times, table = (np.asarray(a, dtype=float) for a in given)
        if times.ndim != 1 or times.shape != table.shape or np.any(np.diff(times) <= 0):
            raise ParameterError(f"input '{name}': (times, values) must be two equal vectors, times increasing")
        return lambda t: float(np.interp(t, times, table))
    constant = float(given)
    return lambda t: constant


@dataclass(slots=True)
class _Run:
    """One integration: the model, its inputs and where it begins."""

    mechanism: Mechanism
    model: mujoco.MjModel
    values: dict[str, float]
    functions: Mapping[str, Callable[[float], float]]
    x: Array
    v: Array
    count: int
    every: int

    def _writer(self) -> FieldWriter:
        writer = self.mechanism.writer(self.model)
        writer.write(self.mechanism.parameters, self.values)
        return writer

    def by_rollout(self) -> tuple[Array, Array]:
        """Step in MuJoCo's own loop, for inputs that are controls."""
        writer = self._writer()
        batch = Batch(self.model, 1, nthread=1)
        writer.inputs.put_rows(writer.inputs.bound(batch))
        batch.qpos, batch.qvel = self.x, self.v
        states, velocities = [self.x[None]], [self.v[None]]
        chunk = max(self.every, _CHUNK // self.every * self.every)
        for begin in range(0, self.count, chunk):
            length = min(chunk, self.count - begin)
            control = self._controls(writer, begin, length)
            out = batch.rollout(length, control=control[None], record=("qpos", "qvel"))
            keep = slice(self.every - 1, None, self.every)
            states.append(out["qpos"][0][keep].copy())
            velocities.append(out["qvel"][0][keep].copy())
            if not np.all(np.isfinite(states[-1])):
                break
        return np.concatenate(states), np.concatenate(velocities)

    def _controls(self, writer: FieldWriter, begin: int, length: int) -> Array:
        """Return the control vector at every step, (length, nu): inputs are taken at mid-step."""
        table = np.tile(writer.inputs.ctrl, (length, 1))
        times = (begin + 0.5 + np.arange(length)) * self.model.opt.timestep
        for name, function in self.functions.items():
            series = np.array([function(t) for t in times])
            for target in self.mechanism.parameter(name).targets:
                for index in target.index:
                    table[:, index] = target.offset + target.factor * series
        return table

    def by_steps(self) -> tuple[Array, Array]:
        """Step one by one, writing the inputs' model fields before each step."""
        writer, data = self._writer(), mujoco.MjData(self.model)
        writer.inputs.begin(data)
        data.qpos[:], data.qvel[:] = self.x, self.v
        states, velocities = [self.x.copy()], [self.v.copy()]
        for k in range(self.count):
            t = (k + 0.5) * self.model.opt.timestep
            writer.write(self.mechanism.parameters, {**self.values, **{n: f(t) for n, f in self.functions.items()}})
            if writer.failure:
                raise ParameterError(f"at t = {t:g} s {writer.failure}")
            writer.inputs.drive(data)
            mujoco.mj_step(self.model, data)
            if (k + 1) % self.every == 0:
                states.append(data.qpos.copy())
                velocities.append(data.qvel.copy())
                if not np.all(np.isfinite(states[-1])):
                    break
        return np.array(states), np.array(velocities)


def _history(
    mechanism: Mechanism, run: _Run, states: Array, velocities: Array, duration: float, integrator: str, step: float
) -> History:
    finite = np.all(np.isfinite(states), axis=1) & (np.abs(velocities).max(axis=1, initial=0.0) < 1e8)
    good = len(states) if finite.all() else int(np.argmin(finite))
    states, velocities = states[:good], velocities[:good]
    times = np.arange(good) * run.every * step
    status, message = "done", "done"
    if not finite.all():
        status = "diverged"
        message = f"the motion diverged after t = {times[-1]:g} s: take a smaller timestep"
    series = {n: np.array([f(t) for t in times]) for n, f in run.functions.items()}
    values: Sequence[Mapping[str, float]] = [
        {**run.values, **{n: float(s[i]) for n, s in series.items()}} for i in range(good)
    ]
    measured = mechanism.measure(states, values, velocities=velocities)
    columns = {"time": Column("time", "s", "time", times)}
    for name, s in series.items():
        columns[name] = Column(name, mechanism.parameter(name).unit, "parameter", s)
    for k, o in enumerate(mechanism.observables.values()):
        columns.setdefault(o.name, Column(o.name, o.unit, "observable", measured[:, k]))
    settings = {"integrator": integrator, "timestep": step, "duration": float(duration)}
    return History(columns, states, velocities, status, message, settings, mechanism.name, mechanism)
