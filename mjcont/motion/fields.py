"""Time histories of vector fields: u' = f(u, p(t), t) by LSODA, which is explicit or implicit as the motion asks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.curves.collect import Amount
from mjcont.curves.continuation import start_from
from mjcont.errors import ParameterError
from mjcont.motion.integrating import Followed, follow
from mjcont.motion.signals import Input, Signal, check_range, read_inputs
from mjcont.numerics.equations.problem import Array
from mjcont.results.histories import History
from mjcont.results.model import provenance
from mjcont.results.points import Column
from mjcont.vectorfield import VectorField

# of each step, relative; the finest that rounding leaves room for, and what it is made smaller by
_RTOL, _FINEST, _FINER = 1e-9, 1e-13, 0.1
# part of a component's scale below which its error counts as none, relative to the tolerance
_SMALL = 1e-2


@dataclass(frozen=True, slots=True)
class _Motion:
    """A motion to be followed: the field, parameter values, inputs, and where and when it goes."""

    field: VectorField
    values: Mapping[str, float]
    signals: Mapping[str, Signal]
    state: Array
    times: Array
    rest: float | None
    max_steps: int
    progress: Amount | None

    def at(self, t: float) -> dict[str, float]:
        return {**self.values, **{n: s.at(t) for n, s in self.signals.items()}}

    def rate(self, t: float, u: Array) -> Array:
        return self.field.rate(u, self.at(t), t)

    def followed(self, rtol: float) -> Followed:
        scale, rest = self.field.typical, self.rest

        def calm(t: float, u: Array) -> bool:
            return rest is not None and float(np.abs(self.rate(t, u) / scale).max()) < rest

        with np.errstate(all="ignore"):
            return follow(self.rate, self.state, self.times, rtol, _SMALL * rtol * scale, self.max_steps,
                          calm=calm if rest is not None else None, progress=self.progress)


def simulate_field(
    field: VectorField,
    inputs: Mapping[str, Input] | None,
    duration: float,
    start: Any,
    *,
    state: Any,
    tol: float | None,
    until_rest: float | None,
    samples: int,
    max_steps: int,
    progress: Amount | None = None,
) -> History:
    """Return the motion of a vector field, as `simulate` says.

    Raises
    ------
    ParameterError
        If an input is a controller, or a number is none that will do.
    """
    for label, value in (("tol", tol), ("until_rest", until_rest), ("duration", duration)):
        if value is not None and not 0.0 < value < np.inf:
            raise ParameterError(f"{label} must be a positive number, got {value}")
    x, values = start_from(field, start, None, state)
    signals, controllers = read_inputs(inputs)
    for name in controllers:
        raise ParameterError(f"input '{name}' is a controller u(t, observables): a vector field takes numbers, "
                             "functions of time and (times, values); write the law into its function")
    times = np.linspace(0.0, duration, max(samples, 2))
    for name, signal in signals.items():
        check_range(field.parameter(name), signal.series(times), times)
    motion = _Motion(field, field.values(values), signals, x, times, until_rest, max_steps, progress)
    run, rtol, error = motion.followed(tol or _RTOL), tol or _RTOL, None
    while tol is not None and run.ended in ("done", "at rest") and rtol > _FINEST:
        rtol *= _FINER
        finer = motion.followed(rtol)
        error, run = _change(run, finer, field.typical), finer
        if error <= tol:
            break
    return _history(motion, run, rtol, tol, error)


def _change(coarse: Followed, fine: Followed, scale: Array) -> float:
    """Return the largest change of a state, relative to the largest excursion; infinity if one ended early."""
    m = min(len(coarse.states), len(fine.states))
    if {coarse.ended, fine.ended} & {"diverged", "stalled"} or m < 2:
        return float("inf")
    size = float(np.abs((fine.states[:m] - fine.states[0]) / scale).max())
    return float(np.abs((fine.states[:m] - coarse.states[:m]) / scale).max() / max(size, 1e-6))


def _history(motion: _Motion, run: Followed, rtol: float, tol: float | None, error: float | None) -> History:
    field, times = motion.field, run.times
    series = {n: s.series(times) for n, s in motion.signals.items()}
    rows = [{**motion.values, **{n: float(c[i]) for n, c in series.items()}} for i in range(len(times))]
    columns = {"time": Column("time", "s", "time", times)}
    columns |= {n: Column(n, field.parameter(n).unit, "parameter", c) for n, c in series.items()}
    measured = field.measure(run.states, rows)
    for k, o in enumerate(field.observables.values()):
        columns.setdefault(o.name, Column(o.name, o.unit, "observable", measured[:, k]))
    velocities = np.array([field.rate(u, p, t) for u, p, t in zip(run.states, rows, times.tolist(), strict=True)])
    last = float(times[-1])
    sentences = {
        "done": "done" if error is None else f"done: steps ten times more exact changed the motion by {error:.1e}",
        "at rest": f"at rest at t = {last:g} s",
        "interrupted": f"interrupted at t = {last:g} s",
        "stalled": f"max_steps = {motion.max_steps} steps do not reach the end: allow more",
        "diverged": f"the motion diverged after t = {last:g} s, or the function has no value there",
    }
    ended, sentence = run.ended, sentences[run.ended]
    if tol is not None and error is not None and error > tol and ended == "done":
        ended, sentence = "stalled", f"the tolerance {tol:g} was not reached: the motion still changes by {error:.1e}"
    settings = {"integrator": "LSODA", "timestep": last / max(run.steps, 1), "duration": float(motion.times[-1]),
                "steps": run.steps, "control_step": None, "tol": tol, "rtol": rtol, "error": error}
    fixed = {n: v for n, v in motion.values.items() if n not in series}
    return History(columns, run.states, velocities, ended, sentence, settings, field.name, field, provenance(field),
                   fixed)
