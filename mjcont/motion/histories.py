"""Time histories: `simulate`, `simulate_many` and the step control behind them.

A history is MuJoCo's own stepping under inputs that vary with time. With a tolerance the run is repeated at half the
step until halving changes it by less than that; the change is the error's estimate.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves.collect import Amount
from mjcont.curves.continuation import start_from
from mjcont.errors import MjcontError, ParameterError, unknown_name
from mjcont.mechanism.mechanism import Mechanism
from mjcont.motion.fields import simulate_field
from mjcont.motion.signals import Input, read_inputs
from mjcont.motion.stepping import INTEGRATORS, Case, Grid, Track, run
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import check_numbers
from mjcont.results.histories import History
from mjcont.results.model import Model, model_of
from mjcont.results.orbits import Orbit, OrbitPoint, SpecialOrbit, orbit_of
from mjcont.results.points import Column, Point
from mjcont.results.quantities import finite_array
from mjcont.vectorfield import VectorField

MODEL, _DEFAULT = "model", "discrete"
_CASE_KEYS = ("inputs", "start", "keyframe", "state", "velocity")
_MAX_STEPS = 20_000_000
_MAX_HALVINGS = 12
# more steps than a computer takes in a lifetime, few enough to be counted, and halved, in 64 bits
_COUNTED = 1e12
_SECONDS, _PERIODS = 10.0, 10.0
# motion below this part of the model's size counts as none in a relative change
_NO_MOTION = 1e-6


@dataclass(frozen=True, slots=True)
class _Plan:
    """How runs are stepped."""

    grid: Grid
    integrator: str
    duration: float
    tol: float | None
    rest: float | None
    max_steps: int
    nthread: int
    progress: Amount | None = None


@dataclass(slots=True)
class _Outcome:
    """A run as it stands: its finest track so far, the grid of that, and what halving changed."""

    track: Track
    grid: Grid
    error: float = math.nan
    stalled: str = ""


@checked
def simulate(
    problem: Model | Orbit | OrbitPoint | SpecialOrbit,
    inputs: Mapping[str, Input] | None = None,
    duration: float | None = None,
    start: Mapping[str, float] | Point | None = None,
    *,
    keyframe: str | None = None,
    state: Any = None,
    velocity: Any = None,
    timestep: float | None = None,
    integrator: str = _DEFAULT,
    tol: float | None = None,
    control_step: float | None = None,
    until_rest: float | None = None,
    samples: int = 2000,
    max_steps: int = _MAX_STEPS,
    progress: Amount | None = None,
) -> History:
    """Return the motion of a model under inputs that vary with time.

    Parameters
    ----------
    problem : Mechanism, VectorField, Orbit or a point of a curve of orbits
        An orbit begins the motion on itself, under its forcing and the inputs given.
    inputs : mapping of parameter to number, function f(t), (times, values), or controller u(t, observables)
        Values between given times are interpolated linearly, and held before the first and after the last. A
        controller is any callable of two arguments: it sees observables by name, in SI and radians, with attributes
        `state` and `velocity`; its output saturates at the actuator's range. An object is copied for every run.
    duration : in s, optional; default 10 s, or 10 periods of an orbit.
    start : dict of parameter values, or a point
        With `keyframe` or `state` it says where the motion begins; at rest unless `velocity` (nv,) is given.
    timestep : float, optional
        In s; default the model's own. With `tol` the first and largest. A vector field has its integrator's (LSODA).
    integrator : {"discrete", "implicitfast", "implicit", "Euler", "RK4", "model"}
        "discrete" is implicit in the stiffness of bushes and stable with any of it, of first order; "RK4" is the most
        accurate where the step resolves the fastest bush mode; "model" is the one that the model names.
    tol : float, optional
        Halve the step until that changes the positions, at every sample, by less than `tol` times the largest
        excursion of the motion (rotations in rad, lengths in sizes of the model). Without it the step is as given.
    control_step : in s, optional, between samples of controllers; default the model's own time step.
    until_rest : float, optional
        End when every speed (rad/s, or sizes of the model per s) has stayed below this over 1 s.
    samples, max_steps : int
        About how many samples are recorded, evenly spaced; steps that a run may take, a longer one is "stalled".
    progress : called as progress(time, duration); with `tol` anew for each step that is tried.

    Returns
    -------
    History
        Motion that diverges ends it early, with a status that says so.

    Raises
    ------
    NameLookupError, ParameterError, BoundsError
    """
    given = {"inputs": inputs, "start": start, "keyframe": keyframe, "state": state, "velocity": velocity}
    model, case, length = _begun(problem, given)
    steps = {"timestep": timestep, "integrator": integrator, "control_step": control_step}
    ends = {"tol": tol, "until_rest": until_rest, "samples": samples, "max_steps": max_steps, "progress": progress}
    return _simulated(model, case, duration if duration is not None else length, steps, ends)


def _simulated(
    model: Model, case: Mapping[str, Any], duration: float, steps: Mapping[str, Any], ends: Mapping[str, Any]
) -> History:
    """Return the motion of a model in a case."""
    if isinstance(model, Mechanism):
        return simulate_many(model, [case], duration, **steps, **ends)[0]
    own = {"keyframe": case.get("keyframe"), "velocity": case.get("velocity"), **steps}
    for name, value in own.items():
        if value is not None and (name, value) != ("integrator", _DEFAULT):
            raise ParameterError(f"{name} is for a Mechanism: {model.name} is a vector field")
    assert isinstance(model, VectorField)
    return simulate_field(model, case["inputs"], duration, case["start"], state=case["state"], **ends)


def _begun(problem: Any, case: dict[str, Any]) -> tuple[Model, dict[str, Any], float]:
    """Return the model, how its motion begins, and how long it goes unless told: of an orbit, ten periods on it."""
    if isinstance(problem, Model):
        return problem, case, _SECONDS
    orbit = orbit_of(problem)
    for name in ("start", "keyframe", "state", "velocity"):
        if case[name] is not None:
            raise ParameterError(f"{name}= says where a model's motion begins: an orbit begins on itself")
    if orbit.activated:
        raise MjcontError("a motion begins with activations at rest, which are not those of this orbit: give simulate "
                          "the model, its inputs, and the orbit's states and velocities, and let it settle")
    model = model_of(orbit.problem, "the orbit")
    forced = {name: _driven(orbit, name) for name in orbit.inputs(np.zeros(1))}
    begin = {"inputs": {**forced, **(case["inputs"] or {})}, "start": orbit.constants(), "state": orbit.states[0]}
    if isinstance(model, Mechanism):
        begin["velocity"] = orbit.velocities[0]
    return model, begin, _PERIODS * orbit.period


def _driven(orbit: Orbit, name: str) -> Callable[[float], float]:
    """Return an input of an orbit as a function of time."""
    return lambda t: float(orbit.inputs(np.array([t]))[name][0])


@checked
def simulate_many(
    mechanism: Mechanism,
    cases: Sequence[Mapping[str, Any]],
    duration: float = 10.0,
    *,
    timestep: float | None = None,
    integrator: str = "discrete",
    tol: float | None = None,
    control_step: float | None = None,
    until_rest: float | None = None,
    samples: int = 2000,
    max_steps: int = _MAX_STEPS,
    nthread: int | None = None,
    progress: Amount | None = None,
) -> list[History]:
    """Return the motions of many cases, stepped together on all processors.

    Parameters
    ----------
    cases : sequence of dicts with any of inputs, start, keyframe, state, velocity
        Each as `simulate` takes it; parameter values may differ from case to case. A controller with an attribute
        `vectorised` is called once for all cases that share it, with arrays, one entry a case.
    nthread : int, optional
        Default the number of processors.

    The other parameters are those of `simulate`. With `tol` only the cases that need it are repeated at finer steps.
    Inputs that are controls, gravity_angle and load_factor run in one batch; a case in which another field of the
    model varies with time is stepped by itself, many times slower.

    Returns
    -------
    list of History
        In the order of the cases.
    """
    if isinstance(cases, Mapping) or not all(isinstance(c, Mapping) for c in cases):
        raise ParameterError("cases must be a sequence of dicts with any of " + ", ".join(_CASE_KEYS))
    if integrator not in INTEGRATORS and integrator != MODEL:
        raise unknown_name("integrator", integrator, [*INTEGRATORS, MODEL])
    optional = {"tol": tol, "until_rest": until_rest, "control_step": control_step, "timestep": timestep}
    numbers = {"duration": duration, **{name: value for name, value in optional.items() if value is not None}}
    check_numbers({**numbers, "samples": samples, "max_steps": max_steps})
    for label, value in numbers.items():
        if not (value > 0 and math.isfinite(value)):
            raise ParameterError(f"{label} must be a positive number, got {value}")
    made = [_make_case(mechanism, c) for c in cases]
    own = float(mechanism.simulation_model().opt.timestep)
    controlled = any(c.controllers for c in made)
    grid = _grid(duration, timestep or own, (control_step or own) if controlled else None, samples)
    threads = nthread or os.cpu_count() or 1
    plan = _Plan(grid, integrator, float(duration), tol, until_rest, max_steps, threads, progress)
    outcomes = _run(mechanism, made, plan) if made else []
    return [_history(mechanism, c, o, plan, controlled) for c, o in zip(made, outcomes, strict=True)]


def _make_case(mechanism: Mechanism, given: Mapping[str, Any]) -> Case:
    for key in given:
        if key not in _CASE_KEYS:
            raise unknown_name("key of a case", key, _CASE_KEYS)
    x, values = start_from(mechanism, given.get("start"), given.get("keyframe"), given.get("state"))
    signals, controllers = read_inputs(given.get("inputs"))
    for name in controllers:
        mechanism.parameter(name)
    values = mechanism.values({**values, **{n: s.at(0.0) for n, s in signals.items()}})
    velocity = given.get("velocity")
    v = np.zeros(mechanism.n) if velocity is None else finite_array("velocity", velocity, (mechanism.n,))
    return Case(values, signals, controllers, x, v)


def _grid(duration: float, step: float, control_step: float | None, samples: int) -> Grid:
    hold = 1
    for label, length in (("duration", duration), ("control_step", control_step)):
        if length is not None and length > _COUNTED * step:
            raise ParameterError(f"{label} ({length:g} s) is more than {_COUNTED:.0e} time steps of {step:g} s")
    if control_step is not None:
        hold = max(math.ceil(control_step / step - 1e-9), 1)
        step = control_step / hold
    if duration < step:
        raise ParameterError(f"duration ({duration:g} s) must be at least one time step ({step:g} s)")
    count = round(duration / step)
    return Grid(step, count, max(count // max(samples, 1), 1), hold)


def _run(mechanism: Mechanism, cases: Sequence[Case], plan: _Plan) -> list[_Outcome]:
    """Run all cases, and again at half the step those that it still changes."""

    def stepped(rows: Sequence[int], grid: Grid) -> list[Track]:
        chosen = [cases[i] for i in rows]
        return run(
            mechanism, chosen, grid, plan.integrator, nthread=plan.nthread, rest=plan.rest, progress=plan.progress
        )

    grid, rows = plan.grid, list(range(len(cases)))
    if grid.count > plan.max_steps:
        short = Grid(grid.step, plan.max_steps, grid.every, grid.hold)
        why = f"max_steps = {plan.max_steps} steps do not reach the end: allow more, or take a larger timestep"
        return [_Outcome(t, short, stalled=why) for t in stepped(rows, short)]
    outcomes = [_Outcome(t, grid) for t in stepped(rows, grid)]
    if plan.tol is None:
        return outcomes
    for halvings in range(1, _MAX_HALVINGS + 2):
        if any(o.track.ended == "interrupted" for o in outcomes):
            return outcomes
        grid = grid.halved()
        if halvings > _MAX_HALVINGS or grid.count > plan.max_steps:
            break
        finer = stepped(rows, grid)
        for i, track in zip(rows, finer, strict=True):
            change = _change(mechanism, outcomes[i].track, track)
            outcomes[i] = _Outcome(track, grid, change)
        rows = [i for i in rows if not outcomes[i].error <= plan.tol]
        if not rows:
            return outcomes
    for i in rows:
        o = outcomes[i]
        o.stalled = (
            f"the tolerance {plan.tol:g} was not reached: halving the step to {o.grid.step:g} s still changes the "
            f"motion by {o.error:.1e}; a shorter duration, a larger tol or another integrator may do"
        )
    return outcomes


def _change(mechanism: Mechanism, coarse: Track, fine: Track) -> float:
    """Return the largest change of position, relative to the largest excursion; infinity if either diverged."""
    if "diverged" in (coarse.ended, fine.ended):
        return math.inf
    scale = mechanism.state_scale
    both = list(zip(coarse.states, fine.states, strict=False))
    change = max(float(np.abs(mechanism.difference(b, a) / scale).max()) for a, b in both)
    size = max(float(np.abs(mechanism.difference(b, fine.states[0]) / scale).max()) for _, b in both)
    return change / max(size, _NO_MOTION)


def _status(outcome: _Outcome, plan: _Plan, last: float) -> tuple[str, str]:
    ended = outcome.track.ended
    if ended == "diverged":
        advice = "take a smaller timestep, give tol, or integrator='discrete'"
        if plan.tol is not None or plan.integrator == "discrete":
            advice = "speeds grew beyond all bounds, or MuJoCo stopped the run"
        return ended, f"the motion diverged after t = {last:g} s: {advice}"
    if ended == "interrupted":
        return ended, f"interrupted at t = {last:g} s"
    if outcome.stalled:
        return "stalled", outcome.stalled
    if ended == "at rest":
        return ended, f"at rest at t = {last:g} s"
    if plan.tol is None:
        return "done", "done"
    return "done", f"done: halving the step to {outcome.grid.step:g} s changed the motion by {outcome.error:.1e}"


def _history(mechanism: Mechanism, case: Case, outcome: _Outcome, plan: _Plan, controlled: bool) -> History:
    from mjcont.results.model import provenance

    track, grid = outcome.track, outcome.grid
    states, velocities = np.array(track.states), np.array(track.velocities)
    times = np.arange(len(states)) * grid.every * grid.step
    series: dict[str, Array] = {n: s.series(times) for n, s in case.signals.items()}
    for name, outputs in track.outputs.items():
        series[name] = np.array([*outputs[:1], *outputs]) if outputs else np.array([case.values[name]])
    values = [{**case.values, **{n: float(s[i]) for n, s in series.items()}} for i in range(len(times))]
    measured = mechanism.measure(states, values, velocities=velocities)
    columns = {"time": Column("time", "s", "time", times)}
    for name, s in series.items():
        columns[name] = Column(name, mechanism.parameter(name).unit, "parameter", s)
    for k, o in enumerate(mechanism.observables.values()):
        columns.setdefault(o.name, Column(o.name, o.unit, "observable", measured[:, k]))
    status, message = _status(outcome, plan, float(times[-1]))
    settings = {
        "integrator": plan.integrator,
        "timestep": grid.step,
        "duration": plan.duration,
        "steps": (len(times) - 1) * grid.every,
        "control_step": grid.step * grid.hold if controlled else None,
        "tol": plan.tol,
        "error": None if math.isnan(outcome.error) else outcome.error,
    }
    fixed = {n: v for n, v in case.values.items() if n not in series}
    return History(
        columns, states, velocities, status, message, settings, mechanism.name, mechanism, provenance(mechanism), fixed
    )
