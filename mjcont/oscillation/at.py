"""The orbits of a curve at a value of its free parameter, corrected to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mjcont.errors import MjcontError
from mjcont.numerics.orbits.follow import MeshSettings, orbit_near
from mjcont.numerics.orbits.path import Path
from mjcont.oscillation.collect import make_orbit, verdict
from mjcont.oscillation.flows import ModelFlow
from mjcont.oscillation.walks import flow_for
from mjcont.results.orbits import CycleBranch, Orbit, OrbitPoint, point_of


@np.errstate(all="ignore")
def orbits_at_value(branch: CycleBranch, name: str, value: float) -> list[OrbitPoint]:
    """Return the orbits of a curve at which its free parameter has a value.

    Raises
    ------
    MjcontError
        If `name` is not the curve's free parameter.
    """
    if name not in branch.free:
        raise MjcontError(f"at() of a curve of orbits takes a free parameter: {', '.join(branch.free)}; got '{name}'")
    column, found = branch[name] - value, []
    for i in range(len(branch)):
        a, j = float(column[i]), min(i + 1, len(branch) - 1)
        b = float(column[j])
        if a == 0.0 or a * b < 0.0:
            flow = flow_for(branch.model, branch.forcing, branch.orbits[i].chart)
            near = between(flow, branch.orbits[i], branch.orbits[j], a / (a - b) if a else 0.0)
            point = settled(flow, near, {**branch.parameters_at(i), name: value}, branch.orbits[i].shift, branch)
            found += [point] if point is not None else []
    return found

# an orbit that is asked for is known to this part of the walk's tolerance: its multipliers err more than it does
_SHARPER = 0.01


def between(flow: ModelFlow, one: Orbit, other: Orbit, fraction: float) -> Path:
    """Return what lies between two orbits of a curve, in the coordinates of the first."""
    theirs = flow_for(flow.model, other.forcing, other.chart)
    a, b = one.path, flow.taken(other.path.carried(one.path.mesh), theirs)
    s, w = ((1.0 - fraction) * x + fraction * y for x, y in ((a.s, b.s), (a.w, b.w)))
    return replace(a, s=s, w=w, period=(1.0 - fraction) * a.period + fraction * b.period)


def settled(
    flow: ModelFlow, path: Path, values: dict[str, float], shift: np.ndarray, branch: CycleBranch
) -> OrbitPoint | None:
    """Return the orbit near a path at parameter values, on a mesh that resolves it; None where there is none."""
    tol, most = float(branch.settings["orbit_tol"]), int(branch.settings["mesh_max"])
    point = orbit_near(flow, path, values, shift, MeshSettings(path.scheme, most=most, tol=_SHARPER * tol))
    if point is None:
        return None
    orbit = make_orbit(point)
    word, count = verdict(orbit)
    return point_of(orbit, flow.state(orbit.path.s[0]), word, count)
