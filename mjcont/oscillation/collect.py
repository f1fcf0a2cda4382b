"""From traced curves of orbits to results: rows, columns, stability by multipliers, labelled special points."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from mjcont.curves.collect import Found, Progress, ordered_rows
from mjcont.errors import StartError
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.settings import Settings
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.conserved import ENERGY, blur
from mjcont.numerics.orbits.follow import MeshSettings
from mjcont.numerics.orbits.points import error_at, multipliers_at, orbits_at, path_at
from mjcont.numerics.points.events import Located
from mjcont.numerics.spectra.spectrum import MARGINAL, STABLE, UNSTABLE
from mjcont.numerics.step.arclength import CurvePoint
from mjcont.numerics.walk.steps import Item
from mjcont.numerics.walk.trace import Trace
from mjcont.oscillation.conserving import Conserving
from mjcont.oscillation.flows import ModelFlow
from mjcont.results.model import provenance
from mjcont.results.orbits import CycleBranch, Orbit, readings
from mjcont.results.points import Column, Mark, show
from mjcont.results.spectra import Spectra

Row = tuple[CurvePoint, Located | None]
# how far from the unit circle a multiplier cannot be told from it; times the error of the trivial one
_ON_CIRCLE, _TRUST = 1e-7, 10.0
# multipliers that a kind of special point holds on the circle
_HELD = {"LPC": 1, "BPC": 1, "PD": 1, "NS": 2}


def flow_at(point: CurvePoint) -> ModelFlow:
    """Return the motion that a point's orbit belongs to."""
    found = orbits_at(point).flow
    assert isinstance(found, ModelFlow)
    return found


def make_orbit(point: CurvePoint) -> Orbit:
    """Return the orbit of a point of a curve."""
    flow, path, m, values = flow_at(point), path_at(point), multipliers_at(point), point.local.values
    return Orbit(
        path, flow.reading(path, values), dict(values), flow.units(), m.values, m.resolved, m.trivial,
        error_at(point), flow.model.name, flow.model, orbits_at(point).shift, flow.record(), flow.activated,
        float(flow.energies(path.s[:1], values)[0]) if isinstance(flow, Conserving) else None,
        flow.chart,
    )


def verdict(orbit: Orbit, kind: str = "") -> tuple[str, int]:
    """Return stability and the number of multipliers outside the unit circle, beside those that a kind holds on it.

    Where energy is kept the multipliers of a stable orbit are on the circle, and those of modes too fast for the mesh
    tell nothing.
    """
    sizes = np.abs(orbit.multipliers[orbit.own if orbit.energy is None else orbit.own & orbit.resolved])
    if not np.isfinite(sizes).all():
        return MARGINAL, 0
    off = abs(orbit.multipliers[orbit.trivial] - 1.0) if orbit.trivial >= 0 else 0.0
    noise = max(_ON_CIRCLE, _TRUST * float(off))
    if orbit.energy is not None:
        noise = max(noise, blur(sizes))
    if kind in _HELD:
        nearest = np.argsort(np.abs(np.log(np.maximum(sizes, 1e-300))), kind="stable")[_HELD[kind] :]
        return MARGINAL, int(np.count_nonzero(sizes[nearest] > 1.0 + noise))
    if (sizes > 1.0 + noise).any():
        return UNSTABLE, int(np.count_nonzero(sizes > 1.0 + noise))
    return (MARGINAL if orbit.energy is None and (sizes > 1.0 - noise).any() else STABLE), 0


def reporter(progress: Progress | None) -> Callable[[Item], None] | None:
    """Return what a trace calls for each item, so that `progress` hears of points and special points."""
    if progress is None:
        return None
    count = 0

    def report(item: Item) -> None:
        nonlocal count
        if isinstance(item, CurvePoint | Located):
            count += isinstance(item, CurvePoint)
            kind, local = ("", item.local) if isinstance(item, CurvePoint) else (item.kind, item.point.local)
            progress(count, Found(kind, {n: local.values[n] for n in local.wrt}, {}))

    return report


def joined(traces: Sequence[Trace], directions: Sequence[float]) -> tuple[list[Row], int]:
    """Return the rows of a curve from the end at which the parameter first falls, and where its start is."""
    rows: list[Row] = []
    start = 0
    for run, direction in zip(traces, directions, strict=False):
        ordered = ordered_rows(run)
        if direction < 0:
            rows, start = ordered[::-1], max(len(ordered) - 1, 0)
        else:
            same = rows and ordered and _same(rows[-1][0], ordered[0][0])
            rows += ordered[1:] if same else ordered
    return rows, start


def _same(one: CurvePoint, other: CurvePoint) -> bool:
    """Whether the two directions of a curve begin at the same orbit."""
    return one.x.shape == other.x.shape and bool(np.allclose(one.x, other.x, rtol=1e-9, atol=1e-9))


def collect(
    kind: str,
    system: System,
    traces: Sequence[Trace],
    directions: Sequence[float],
    origin: str,
    settings: Settings,
    meshes: MeshSettings,
    notes: Sequence[str] = (),
) -> CycleBranch:
    """Join the directions of a curve of orbits into a branch.

    Raises
    ------
    StartError
        If there is no orbit at all.
    """
    rows, start = joined(traces, directions)
    if not rows:
        raise StartError("; ".join(t.end.message for t in traces))
    flow = flow_at(rows[0][0])
    orbits = [make_orbit(p) for p, _ in rows]
    always = kind.removesuffix(" locus") if kind.endswith(" locus") else ""
    kinds = [e.kind if e else always for _, e in rows]
    words, counts = zip(*(verdict(o, k) for o, k in zip(orbits, kinds, strict=True)), strict=True)
    free = {p.name: (p.low, p.high) for p in system.free}
    base = dict(orbits[0].parameters)
    return CycleBranch(
        kind=kind,
        name=flow.model.name,
        columns=_columns(flow, orbits, system),
        states=_frozen(np.array([flow_at(p).state(path_at(p).s[0]) for p, _ in rows])),
        state_labels=flow.model.state_labels,
        spectra=Spectra([o.multipliers for o in orbits]),
        stability=_frozen(np.array(words, dtype="U8")),
        n_unstable=_frozen(np.array(counts)),
        residuals=_frozen(np.array([p.error for p, _ in rows])),
        marks=_marks(rows),
        free=free,
        fixed={k: v for k, v in base.items() if k not in free},
        ends=[(t.end.status.value, t.end.message) for t in traces],
        start=_describe(orbits[start], words[start], system, origin),
        settings=_settings(settings, meshes),
        provenance=provenance(flow.model),
        problem=flow.model,
        start_index=start,
        notes=(*notes, *_unresolved(orbits)),
        fixed_units={k: u for k, u in orbits[0].units.items() if k in base and k not in free},
        orbits=tuple(orbits),
        forcing=flow.record(),
    )


def _settings(settings: Settings, meshes: MeshSettings) -> dict[str, Any]:
    found = {k: v for k, v in asdict(settings).items() if v != math.inf}
    scheme = meshes.scheme
    return found | {"scheme": scheme.name, "degree": scheme.degree, "orbit_tol": meshes.tol, "mesh": meshes.first,
                    "mesh_max": meshes.most, "period_max": meshes.period_max}


def _columns(flow: ModelFlow, orbits: Sequence[Orbit], system: System) -> dict[str, Column]:
    units = orbits[0].units
    found = {
        p.name: Column(p.name, units.get(p.name, ""), "parameter", _frozen([o.parameters[p.name] for o in orbits]))
        for p in system.free
    }
    own = set(flow.model.parameters) | set(found)  # a model's parameter keeps its name
    for name, unit in (("period", "s"), ("frequency", "Hz")):
        if name not in own:
            found[name] = Column(name, unit, "orbit", _frozen([getattr(o, name) for o in orbits]))
    if isinstance(flow, Conserving) and ENERGY not in found:
        found[ENERGY] = Column(ENERGY, flow.energy_unit, "orbit", _frozen([o.energy for o in orbits]))
    read = [readings(o.path, o.reading, flow.forced) for o in orbits]
    for k, (name, o) in enumerate(flow.model.observables.items()):
        for what in read[0]:
            unit = "rad" if what == "phase" else o.unit
            column = _frozen([r[what][k] for r in read])
            found[f"{name}.{what}"] = Column(f"{name}.{what}", unit, "observable", column)
    return found


def _marks(rows: Sequence[Row]) -> tuple[Mark, ...]:
    """Return what makes rows special points, labelled in their order."""
    counts: dict[str, int] = {}
    found = []
    for i, (_, e) in enumerate(rows):
        if e is not None:
            counts[e.kind] = counts.get(e.kind, 0) + 1
            scalars = {k: v for k, v in e.data.items() if isinstance(v, float | str)}
            vectors = {k: v for k, v in e.data.items() if isinstance(v, np.ndarray)}
            label = f"{e.kind}{counts[e.kind]}"
            found.append(Mark(e.kind, label, i, e.tolerance, e.converged, scalars, vectors, e.note))
    return tuple(found)


def _unresolved(orbits: Sequence[Orbit]) -> list[str]:
    """Return a sentence on modes that are too fast for the mesh, and on those among them that grow."""
    if all(o.resolved.all() for o in orbits):
        return []
    most = max(int(np.count_nonzero(~o.resolved)) for o in orbits)
    found = [f"up to {most} multipliers belong to modes too fast for the mesh: theirs are adiabatic (resolved=False)"]
    growing = sum(bool((np.abs(o.multipliers[~o.resolved]) > 1.0 + _ON_CIRCLE).any()) for o in orbits)
    if growing:
        found.append(f"in {growing} rows a mode too fast for the mesh grows: the orbit is unstable there")
    return found


def _describe(orbit: Orbit, word: str, system: System, origin: str) -> str:
    shown = ", ".join(f"{p.name} = {show(orbit.parameters[p.name], p.unit, 6)}" for p in system.free)
    return f"{shown}, period = {orbit.period:.6g} s; {word} ({origin})"


def _frozen(data: Any) -> Array:
    array = np.array(data)
    array.flags.writeable = False
    return array


