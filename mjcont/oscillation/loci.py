"""The verb `continue_special`: a special point followed in one more parameter, of equilibria or of orbits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from mjcont.arguments import checked
from mjcont.curves import loci
from mjcont.curves.collect import Progress
from mjcont.curves.continuation import check_direction
from mjcont.curves.walkers import Zeros
from mjcont.errors import MjcontError
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import System
from mjcont.numerics.orbits.follow import laid
from mjcont.numerics.orbits.loci import held_system, locus_detectors
from mjcont.numerics.step.arclength import tangent_at
from mjcont.oscillation.onward import flow_at, orbit_at
from mjcont.oscillation.walks import Entry, Special, read_options, run
from mjcont.results.branch import Branch
from mjcont.results.orbits import CycleBranch, SpecialOrbit
from mjcont.results.points import SpecialPoint

FOLLOWED = ("LPC", "PD", "NS")
Bounds = tuple[float, float] | Mapping[str, tuple[float, float]] | None


@checked
def continue_special(
    point: SpecialPoint,
    parameter: str,
    bounds: Bounds = None,
    *,
    direction: int | None = None,
    end_at: Sequence[str] | None = None,
    zeros: Zeros | None = None,
    lyapunov: bool = True,
    progress: Progress | None = None,
    **options: Any,
) -> Branch:
    """Follow a special point in one more parameter; the parameters of its own curve stay free.

    Parameters
    ----------
    point : SpecialPoint
        An LP, HB or BP of a branch gives its curve in two parameters; a CP, BT or ZH of such a curve its own curve
        in three. An LPC, PD or NS of a curve of orbits gives its curve in two.
    parameter : str
        The parameter that is freed.
    bounds : (low, high), or a mapping of free parameters to bounds
        Range of `parameter`; the others keep the bounds of the point's curve unless given here.
    direction : {None, +1, -1}
        Both directions, or that in which `parameter` first grows or falls.
    end_at : kinds of points that end the locus; default BT on a Hopf locus (beyond it lie neutral saddles), R1 and R2
        on one of NS.
    zeros : columns whose passing of a value, or of several, is located and labelled UZ; not along orbits.
    lyapunov : whether l1 is computed along a Hopf locus (needed for GH).

    Returns
    -------
    Branch
        Its `kind` says which locus. On a fold locus CP, BT, ZH and BP (w . f_p = 0) are located, on a Hopf locus
        BT, ZH, HH and GH; on loci of orbits CPC, GPD, CH, R1 to R4, LPPD, LPNS, PDNS and NSNS.

    Raises
    ------
    MjcontError, BoundsError, NameLookupError, ParameterError
        See their messages.
    """
    if isinstance(point, SpecialOrbit):
        if zeros:
            raise MjcontError("zeros= are not located along curves of orbits")
        return _of_orbits(point, parameter, bounds, direction, end_at, progress, options)
    return loci.continue_special(
        point, parameter, bounds, direction=direction, end_at=end_at, zeros=zeros, lyapunov=lyapunov,
        progress=progress, **options,
    )


@np.errstate(all="ignore")
def _of_orbits(
    point: SpecialOrbit,
    parameter: str,
    bounds: Bounds,
    direction: int | None,
    end_at: Sequence[str] | None,
    progress: Progress | None,
    options: Mapping[str, Any],
) -> CycleBranch:
    kind = point.kind
    if kind not in FOLLOWED:
        raise MjcontError(
            f"a point of kind {kind} on a curve of orbits has no curve to follow. Valid kinds: {', '.join(FOLLOWED)}."
        )
    if not point.converged:
        raise MjcontError(f"{point.label}: {point.note}; no one curve goes through it")
    orbit = orbit_at(point)
    flow = flow_at(orbit)
    own = {"scheme": orbit.path.scheme.name, "degree": orbit.path.scheme.degree}
    read = read_options(flow, {**own, **options})
    free = loci.free_parameters(point, parameter, bounds, flow)
    orbits = laid(flow, orbit.path, orbit.shift)
    plain = System(orbits, orbit.parameters, free)
    aux = [float(point.coefficients["theta"])] if kind == "NS" else []
    x, y = orbits.joined(orbit.path), np.append(plain.start_y(), aux)
    system = held_system(kind, plain, x, y)
    entries = [Entry(sign, x, y, _along(system, x, y, sign)) for sign in check_direction(direction)]
    ends = loci.ends_at(end_at, ("R1", "R2") if kind == "NS" else ())
    special = Special(locus_detectors(kind), partial(held_system, kind), ends)
    where = ", ".join(f"{p.name} = {p.show(system.base[p.name])}" for p in free)
    return run(f"{kind} locus", system, entries, read, f"from {point.label} at {where}", None, progress, (), special)


def _along(system: System, x: Array, y: Array, direction: float) -> Array:
    """Return the unit tangent (n + k,) in which the freed parameter grows (direction > 0) or falls."""
    tangent = tangent_at(system, system.local(x, y), y)
    lead = system.n + len(system.free) - 1
    return tangent if tangent[lead] * direction >= 0.0 else -tangent

