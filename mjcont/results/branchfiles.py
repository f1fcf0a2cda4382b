"""Branches as HDF5 that other tools read.

Layout beside what `files` says (format version 3)::

    /                     attributes: start, start_index, settings, free, ends, neutral_saddles, notes, held (JSON), ...
    /states               (N, nq) float64, attributes names, units
    /eigenvalues/real, /eigenvalues/imag   (N, m) float64: NaN where a row has fewer, and all of a row whose eigenvalues
                          were not known; a loaded branch computes these where they are read
    /stability            (N,) int8: 1 stable, 0 marginal, -1 unstable
    /n_unstable           (N,) int32
    /residuals            (N,) float64, scaled
    /fixed                attributes: the other parameters' values, by the keys of their names
    /special_points/LABEL attributes: kind, index, tolerance, converged, note, coefficients (JSON); vectors/NAME,
                          complex ones as vectors/NAME/real and .../imag
    /special_table        the same as a table, (P,) each: label, kind, row (from 0), tolerance, converged, values/KEY of
                          each column, coefficients/NAME (NaN where a point has none)

A load path holds such a group for each of its segments.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.numerics.equations.problem import Array
from mjcont.outside.hdf5names import key
from mjcont.outside.hdf5text import Attributes, put_text
from mjcont.results.branch import Branch
from mjcont.results.certificates import Certificate
from mjcont.results.files import (
    FORMAT_VERSION,
    frozen,
    read_columns,
    read_complex,
    read_values,
    save_hdf5,
    write_common,
    write_complex,
    write_values,
)
from mjcont.results.model import Model
from mjcont.results.points import Mark
from mjcont.results.spectra import Late, Spectra

_CODES = {"stable": 1, "marginal": 0, "unstable": -1}


def save(branch: Branch, path: str | Path) -> Path:
    """Write a branch as HDF5."""
    return save_hdf5(path, lambda f: write_branch(branch, f))


def write_branch(branch: Branch, f: h5py.Group, *, model: bool = True) -> None:
    """Write a branch into a file or a group of one, with its model unless the file has that elsewhere."""
    if branch.problem is not None and branch.problem.mjcf is None:
        branch.spectra.complete()  # the file does not carry what could compute them later
    eigenvalues = branch.spectra.table()
    Attributes(f).update(
        format="mjcont",
        format_version=FORMAT_VERSION,
        kind=branch.kind,
        name=branch.name,
        start=branch.start,
        start_index=branch.start_index,
        settings=branch.settings_json(),
        free=json.dumps(branch.free),
        ends=json.dumps(list(branch.ends)),
        neutral_saddles=json.dumps(list(branch.neutral_saddles)),
        notes=json.dumps(list(branch.notes)),
        held=json.dumps(list(branch.problem.held) if branch.problem is not None else []),
    )
    write_common(f, branch, model=model)
    f["states"] = branch.states
    Attributes(f["states"]).update(
        names=json.dumps([n for n, _ in branch.state_labels]), units=json.dumps([u for _, u in branch.state_labels])
    )
    write_complex(f, "eigenvalues", eigenvalues)
    f["stability"] = np.array([_CODES[s] for s in branch.stability], dtype=np.int8)
    Attributes(f["stability"])["meaning"] = "1 stable, 0 marginal, -1 unstable"
    f["n_unstable"] = branch.n_unstable.astype(np.int32)
    f["residuals"] = branch.residuals
    write_values(f, "fixed", branch.fixed)
    Attributes(f)["fixed_units"] = json.dumps(dict(branch.fixed_units))
    if branch.certificate is not None:
        Attributes(f)["certificate"] = branch.certificate.to_json()
    group = f.create_group("special_points")
    for mark in branch.marks:
        _write_mark(group.create_group(mark.label), mark, branch.kind)
    if branch.marks:
        _write_table(f.create_group("special_table"), branch)


def _write_mark(g: h5py.Group, mark: Mark, curve: str) -> None:
    Attributes(g).update(
        kind=mark.kind,
        index=mark.index,
        tolerance=mark.tolerance,
        converged=mark.converged,
        note=mark.note,
        curve=curve,
        coefficients=json.dumps(dict(mark.coefficients)),
    )
    for name, vector in mark.vectors.items():
        if np.iscomplexobj(vector):
            write_complex(g, f"vectors/{name}", vector)
        else:
            g[f"vectors/{name}"] = vector


def _write_table(g: h5py.Group, branch: Branch) -> None:
    """Write what the special points are as columns."""
    marks = branch.marks
    put_text(g, "label", [m.label for m in marks])
    put_text(g, "kind", [m.kind for m in marks])
    rows = np.array([m.index for m in marks], dtype=np.int32)
    g["row"], g["tolerance"] = rows, np.array([m.tolerance for m in marks])
    g["converged"] = np.array([m.converged for m in marks], dtype=np.int8)
    for name, column in branch.columns.items():
        g[f"values/{key(name)}"] = column.values[rows]
        Attributes(g[f"values/{key(name)}"]).update(name=json.dumps(name), unit=column.unit)
    for name in dict.fromkeys(n for m in marks for n, v in m.coefficients.items() if isinstance(v, float)):
        given = [m.coefficients.get(name) for m in marks]
        g[f"coefficients/{key(name)}"] = np.array([v if isinstance(v, float) else math.nan for v in given])


def read_branch(f: h5py.Group, problem: Model | None) -> Branch:
    """Return the branch in a file or a group of one."""
    columns = read_columns(f)
    words = {v: k for k, v in _CODES.items()}
    a, of_states = Attributes(f), Attributes(f["states"])
    labels = list(zip(json.loads(of_states["names"]), json.loads(of_states["units"]), strict=True))
    free = {k: tuple(v) for k, v in json.loads(a["free"]).items()}
    fixed = read_values(f, "fixed")
    states, eigenvalues = frozen(f["states"][()]), read_complex(f["eigenvalues"])
    held = json.loads(a.get("held", "[]"))
    problem = problem.holding(held) if problem is not None and held else problem
    late = Late(problem, states, fixed, {n: columns[n].values for n in free}, free)
    branch = Branch(
        kind=str(a["kind"]),
        name=str(a["name"]),
        columns=columns,
        states=states,
        state_labels=labels,
        spectra=Spectra.of(eigenvalues, late),
        stability=frozen(np.array([words[int(c)] for c in f["stability"][()]], dtype="U8")),
        n_unstable=frozen(f["n_unstable"][()].astype(int)),
        residuals=frozen(f["residuals"][()]),
        marks=sorted((_read_mark(g, label) for label, g in f["special_points"].items()), key=lambda m: m.index),
        free=free,
        fixed=fixed,
        fixed_units=json.loads(a["fixed_units"]),
        ends=[tuple(e) for e in json.loads(a["ends"])],
        start=str(a["start"]),
        settings=json.loads(a["settings"]),
        provenance=a.beginning("provenance_"),
        problem=problem,
        start_index=int(a["start_index"]),
        neutral_saddles=json.loads(a["neutral_saddles"]),
        notes=json.loads(a["notes"]),
        certificate=_read_certificate(f),
    )
    rows = {len(branch.states), len(branch.spectra), len(branch.stability), len(branch.n_unstable)}
    if rows | {len(branch.residuals)} | {len(c.values) for c in columns.values()} != {len(branch.states)}:
        raise ValueError("its columns differ in length")
    if any(not 0 <= m.index < len(branch) for m in branch.marks):
        raise ValueError("a special point is on no row")
    return branch


def _read_certificate(f: h5py.File) -> Any:
    if "certificate" not in Attributes(f):
        return None
    return Certificate.from_json(str(Attributes(f)["certificate"]))


def _read_vector(item: h5py.Group | h5py.Dataset) -> Array:
    found: Array = item[()] if isinstance(item, h5py.Dataset) else read_complex(item)
    return found


def _read_mark(g: h5py.Group, label: str) -> Mark:
    a = Attributes(g)
    return Mark(
        kind=str(a["kind"]),
        label=label,
        index=int(a["index"]),
        tolerance=float(a["tolerance"]),
        converged=bool(a["converged"]),
        coefficients=json.loads(a["coefficients"]),
        vectors={k: _read_vector(v) for k, v in g["vectors"].items()} if "vectors" in g else {},
        note=str(a["note"]),
    )
