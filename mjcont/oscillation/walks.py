"""What the verbs share: options, and walks along a curve of orbits from where it is entered."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mjcont.curves.collect import Progress
from mjcont.errors import ParameterError, StartError, unknown_name
from mjcont.numerics.equations import clock
from mjcont.numerics.equations.bordered import oriented
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.refusals import Refused
from mjcont.numerics.equations.settings import Settings, make_settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.follow import Follower, MeshSettings, entered, trace_orbits
from mjcont.numerics.orbits.scheme import GAUSS, RADAU, SCHEMES, scheme
from mjcont.numerics.points.events import Detector
from mjcont.numerics.step.arclength import CurvePoint, tangent_at
from mjcont.numerics.walk.steps import End, Status
from mjcont.numerics.walk.trace import Trace, time_up
from mjcont.oscillation.collect import collect, flow_at, make_orbit, reporter, verdict
from mjcont.oscillation.conserving import flow_as_recorded
from mjcont.oscillation.fields import FieldFlow
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.forced import Forcing, Harmonic, make_forcing
from mjcont.results.model import Model
from mjcont.results.orbits import Chart, CycleBranch, OrbitPoint, point_of
from mjcont.vectorfield import VectorField

# the corrector's: multipliers are read off derivatives at its last iterate
_CORRECTED = 1e-8
_INTERVALS = 20
# a parameter that moves by less along the tangent turns there
_TURNS, _AT_FOLD = 1e-3, 1e-6
_OWN = ("mesh", "degree", "scheme", "tol", "period_max", "mesh_max")
Stop = Callable[[OrbitPoint], str | None]


@dataclass(frozen=True, slots=True)
class Options:
    """Settings of a walk along a curve of orbits, and of its meshes."""

    settings: Settings
    meshes: MeshSettings


def read_options(flow: ModelFlow, given: Mapping[str, Any]) -> Options:
    """Return the settings that keyword options say.

    `mesh` fixes the number of intervals; without it there are 20 to begin with and up to `mesh_max` (320) where the
    error asks for them. `degree` 5, `scheme` "radau" for mechanisms and "gauss" for vector fields, `tol` 1e-9 the
    orbit's error, relative, `period_max` 1000 times the first period. The others are fields of `Settings`.

    Raises
    ------
    NameLookupError, ParameterError
        If an option does not exist or does not fit.
    """
    own = {k: v for k, v in given.items() if k in _OWN}
    name = own.get("scheme", GAUSS if isinstance(flow, FieldFlow) else RADAU)
    if name not in SCHEMES:
        raise unknown_name("scheme", str(name), SCHEMES)
    degree = _whole("degree", own.get("degree", 5), 2, 9)
    mesh = _whole("mesh", own.get("mesh", _INTERVALS), 2, 10000)
    most = max(_whole("mesh_max", own.get("mesh_max", 320), 2, 10000), mesh)
    tol, longest = own.get("tol", 1e-9), own.get("period_max", 1e3)
    for what, value in (("tol", tol), ("period_max", longest)):
        if isinstance(value, bool) or not isinstance(value, int | float) or not value > 0.0:
            raise ParameterError(f"{what} must be a positive number, got {value!r}")
    rest = {k: v for k, v in given.items() if k not in _OWN}
    settings = make_settings({**rest, "tol": _CORRECTED})
    meshes = MeshSettings(scheme(name, degree), mesh, most, float(tol), float(longest), "mesh" in own)
    return Options(settings, meshes)


def _whole(what: str, value: Any, low: int, high: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        raise ParameterError(f"{what} must be a whole number from {low} to {high}, got {value!r}")
    return value


def flow_of(problem: Model, forcing: Forcing | None = None, chart: Chart | None = None) -> ModelFlow:
    """Return the motion of a model; `chart` as `ModelFlow` has it, by default about the model's own state.

    Raises
    ------
    MjcontError
        If the model has features for which periodic motion cannot be followed.
    """
    if isinstance(problem, VectorField):
        return FieldFlow(problem, forcing)
    from mjcont.oscillation.mechanisms import mechanism_flow  # MuJoCo is imported only where there is a Mechanism

    return mechanism_flow(problem, forcing, chart)


def flow_for(model: Model, record: Mapping[str, Any], chart: Chart | None = None) -> ModelFlow:
    """Return the motion of a model under forcing as files keep it, in the coordinates of one of its orbits."""
    if "conserves" in record:
        return flow_as_recorded(flow_of(model, None, chart), record["conserves"])
    periods = int(record.get("periods", 1))
    if not record.get("inputs"):
        return FieldFlow(model, None, periods) if isinstance(model, VectorField) else flow_of(model, None, chart)
    inputs = {n: Harmonic(a, p, h) for n, (a, p, h) in record["inputs"].items()}
    return flow_of(model, make_forcing(model, inputs, None, periods), chart)


def point_stop(stop: Stop | None) -> Callable[[System, CurvePoint], str | None] | None:
    """Return what asks the user's `stop` at a point of a curve."""
    if stop is None:
        return None

    def ask(system: System, point: CurvePoint) -> str | None:
        del system
        orbit = make_orbit(point)
        word, count = verdict(orbit)
        return stop(point_of(orbit, flow_at(point).state(orbit.path.s[0]), word, count))

    return ask


@dataclass(frozen=True, slots=True)
class Entry:
    """Where a curve is entered.

    Attributes
    ----------
    direction : of the free parameter.
    x, y : near the first orbit.
    row : (n + k,) to correct along and to go; None takes the curve's own tangent there.
    """

    direction: float
    x: Array
    y: Array
    row: Array | None


@dataclass(frozen=True, slots=True)
class Special:
    """What a curve of special orbits has beside a curve of orbits; the attributes are those of `Follower`."""

    detectors: Callable[[System, Settings], list[Detector]]
    held: Callable[[System, Array, Array], System] | None
    end_at: frozenset[str]


def run(
    kind: str,
    system: System,
    entries: Sequence[Entry],
    options: Options,
    origin: str,
    stop: Stop | None = None,
    progress: Progress | None = None,
    notes: Sequence[str] = (),
    special: Special | None = None,
    periods: int = 1,
) -> CycleBranch:
    """Walk from each entry and collect the curve; `special` where it is one of special orbits, `periods` of several."""
    traces: list[Trace] = []
    report = reporter(progress)
    follower = Follower(options.settings, options.meshes, point_stop(stop), periods=periods)
    if special is not None:
        follower = replace(follower, detectors=special.detectors, held=special.held, end_at=special.end_at)
    within = clock.allowance(options.settings.max_seconds)
    for entry in entries:
        if traces and traces[-1].end.status in (Status.CLOSED, Status.INTERRUPTED):
            break
        with np.errstate(all="ignore"), within():
            traces.append(_walked(follower, system, entry, report))
    if not any(t.points for t in traces):
        raise StartError("; ".join(t.end.message for t in traces))
    directions = [e.direction for e in entries]
    return collect(kind, system, traces, directions, origin, options.settings, options.meshes, notes)


def _walked(follower: Follower, system: System, entry: Entry, report: Callable[[Any], None] | None) -> Trace:
    """Return the walk from an entry, as far as time allows."""
    x, y = entry.x, entry.y
    try:
        way = along_parameter(system, x, y, entry.direction) if entry.row is None else entry.row
        first = entered(system, x, y, way, follower.settings)
    except clock.TimeUp:
        return Trace([], end=time_up(follower.settings))
    if isinstance(first, Refused):
        return Trace([], end=End(Status.NO_START, f"the curve could not be entered: {first}"))
    return trace_orbits(follower, system, first, report)


def along_parameter(system: System, x: Array, y: Array, direction: float) -> Array:
    """Return the row (n + k,) along which a curve is entered so that the free parameter grows (direction > 0) or falls.

    It keeps the parameter where it is, unless the curve turns there: then it is the tangent.
    """
    tangent = tangent_at(system, system.local(x, y), y)
    if abs(tangent[system.n]) <= _TURNS:
        rises = float(tangent[system.n])
        if abs(rises) <= _AT_FOLD:  # it does neither: rounding must not say which way is first
            return oriented(tangent) * direction
        return tangent if rises * direction >= 0.0 else -tangent
    row = np.zeros_like(tangent)
    row[system.n] = direction
    return row
