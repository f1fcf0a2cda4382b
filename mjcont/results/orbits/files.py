"""Curves of orbits in files: a branch as `branchfiles` writes it, and its orbits, one after the other in arrays.

Layout beside what `branchfiles` says::

    /                     attribute forcing (JSON)
    /orbits               attributes scheme, degree, order, names, units (JSON: of observables), activated (how many
                          of a state's last entries are activations)
    /orbits/intervals     (R,) int32: intervals of each orbit's mesh; their sum is K
    /orbits/period, error (R,) float64, s and relative
    /orbits/mesh          (K + R,) float64: each mesh from 0 to 1
    /orbits/states        (K + R, d) float64: at the mesh
    /orbits/rates         (K, degree, c) float64: at the collocation points, times the interval's length^order
    /orbits/points, ends  (K degree, o), (K + R, o) float64: observables at the collocation points and at the mesh
    /orbits/resolved      (R, d) int8
    /orbits/trivial       (R,) int32: which multiplier is the 1 of a free period, -1 where none is
    /orbits/shift         (R, d) float64: what a state gains in a period
    /orbits/chart         of models with ball and free joints: attribute joints (JSON), places (r, 2) and reference
                          (R, r, 4), as `Chart` has them; states are its coordinates

Multipliers are the branch's eigenvalues.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path as File
from typing import Any

import h5py
import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.numerics.orbits.path import Path
from mjcont.numerics.orbits.scheme import SCHEMES, scheme
from mjcont.outside.hdf5text import Attributes
from mjcont.results.branch import Branch
from mjcont.results.branchfiles import read_branch, write_branch
from mjcont.results.files import frozen, read_complex, save_hdf5
from mjcont.results.model import Model
from mjcont.results.orbits.charts import Chart
from mjcont.results.orbits.curve import CycleBranch, with_orbits
from mjcont.results.orbits.orbit import Orbit
from mjcont.results.orbits.readings import Reading
from mjcont.results.spectra import Spectra

GROUP = "orbits"


def save(branch: CycleBranch, path: str | File) -> File:
    """Write a curve of orbits as HDF5."""
    return save_hdf5(path, lambda f: write_cycles(branch, f))


def write_cycles(branch: CycleBranch, f: h5py.Group) -> None:
    """Write a curve of orbits into a file or a group of one."""
    write_branch(branch, f)
    Attributes(f)["forcing"] = json.dumps(branch.forcing)
    orbits, g = branch.orbits, f.create_group(GROUP)
    first = orbits[0]
    Attributes(g).update(
        scheme=first.path.scheme.name, degree=first.path.scheme.degree, order=first.path.order,
        names=json.dumps(list(first.reading.names)), units=json.dumps(list(first.reading.units)),
        activated=first.activated,
    )
    g["intervals"] = np.array([len(o.path.w) for o in orbits], dtype=np.int32)
    g["period"], g["error"] = np.array([o.period for o in orbits]), np.array([o.error for o in orbits])
    g["mesh"] = np.concatenate([o.path.mesh for o in orbits])
    g["states"] = np.concatenate([o.path.s for o in orbits])
    g["rates"] = np.concatenate([o.path.w for o in orbits])
    g["points"] = np.concatenate([o.reading.points for o in orbits])
    g["ends"] = np.concatenate([o.reading.ends for o in orbits])
    g["resolved"] = np.array([o.resolved for o in orbits], dtype=np.int8)
    g["trivial"] = np.array([o.trivial for o in orbits], dtype=np.int32)
    g["shift"] = np.array([np.broadcast_to(o.shift, first.path.s.shape[1]) if len(o.shift) else
                           np.zeros(first.path.s.shape[1]) for o in orbits])
    if first.chart is not None:
        chart = g.create_group("chart")
        Attributes(chart)["joints"] = json.dumps(first.chart.joints)
        chart["places"] = first.chart.places
        chart["reference"] = np.array([o.chart.reference for o in orbits if o.chart is not None])


def read_cycles(f: h5py.File, problem: Model | None) -> CycleBranch:
    """Return the curve of orbits in a file."""
    branch = read_branch(f, problem)
    multipliers = [frozen(row) for row in read_complex(f["eigenvalues"])]
    forcing = json.loads(Attributes(f)["forcing"])
    orbits = _read_orbits(f[GROUP], branch, multipliers, forcing)
    return with_orbits(replace(branch, spectra=Spectra(multipliers)), orbits, forcing)


def _read_orbits(g: h5py.Group, branch: Branch, multipliers: Sequence[Array], forcing: dict[str, Any]) -> list[Orbit]:
    """Return the orbits of the rows.

    Raises
    ------
    ValueError
        If arrays do not fit each other.
    """
    name, degree, order = str(Attributes(g)["scheme"]), int(Attributes(g)["degree"]), int(Attributes(g)["order"])
    if name not in SCHEMES or not 1 <= degree <= g["rates"].shape[1] or order not in (1, 2):
        raise ValueError("its orbits are polynomials of a kind that is not known")
    activated = int(Attributes(g).get("activated", 0))  # files of before had none
    if activated and (order != 1 or not 0 < activated < g["states"].shape[1]):
        raise ValueError("its orbits have activations that do not fit their states")
    rule = scheme(name, degree)
    names, units = (tuple(json.loads(Attributes(g)[key])) for key in ("names", "units"))
    a = {key: frozen(g[key][()]) for key in ("intervals", "period", "error", "mesh", "states", "rates", "points",
                                             "ends", "resolved", "trivial", "shift")}
    count, k = len(branch), int(a["intervals"].sum())
    charts = _read_charts(g["chart"], count, a["states"].shape[1]) if "chart" in g else [None] * count
    lengths = {"mesh": k + count, "states": k + count, "rates": k, "points": k * rule.degree, "ends": k + count}
    if any(len(v) != lengths.get(key, count) for key, v in a.items()) or (a["intervals"] < 1).any():
        raise ValueError("the arrays of its orbits do not fit each other")
    all_units = {**dict(branch.fixed_units), **{n: branch.unit(n) for n in branch.free},
                 **dict(zip(names, units, strict=True))}
    found = []
    for i, last in enumerate(np.cumsum(a["intervals"]).tolist()):
        first = last - int(a["intervals"][i])
        inner, ends = slice(first, last), slice(first + i, last + i + 1)
        path = Path(rule, order, a["mesh"][ends], a["states"][ends], a["rates"][inner], float(a["period"][i]))
        reading = Reading(names, units, a["points"][first * rule.degree : last * rule.degree], a["ends"][ends])
        found.append(Orbit(
            path, reading, branch.parameters_at(i), all_units, multipliers[i], a["resolved"][i].astype(bool),
            int(a["trivial"][i]), float(a["error"][i]), branch.name, branch.problem, a["shift"][i], forcing, activated,
            float(branch["energy"][i]) if "conserves" in forcing else None,
            charts[i],
        ))
    return found


def _read_charts(g: h5py.Group, count: int, d: int) -> list[Chart]:
    """Return the charts of the rows, whose states have d entries.

    Raises
    ------
    ValueError
        If they do not fit.
    """
    joints = tuple(json.loads(Attributes(g)["joints"]))
    places, reference = (frozen(g[k][()]) for k in ("places", "reference"))
    fits = places.shape == (len(joints), 2) and reference.shape == (count, len(joints), 4)
    highest = d // 2 + len(joints) - 4, d // 2 - 3
    if not fits or (places < 0).any() or (places > highest).any() or not np.isfinite(reference).all():
        raise ValueError("the charts of its orbits do not fit their states")
    return [Chart(joints, places, row) for row in reference]
