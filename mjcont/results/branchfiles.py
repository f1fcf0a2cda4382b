"""Branches as HDF5 that other tools read.

Layout beside what `files` says (format version 2)::

    /                     attributes: start, start_index, settings, free, ends, neutral_saddles, notes, held (JSON), ...
    /states               (N, nq) float64, attributes names, units
    /eigenvalues/real, /eigenvalues/imag   (N, m) float64: NaN where a row has fewer, and all of a row whose eigenvalues
                          were not known; a loaded branch computes these where they are read
    /stability            (N,) int8: 1 stable, 0 marginal, -1 unstable
    /n_unstable           (N,) int32
    /residuals            (N,) float64, scaled
    /fixed                attributes: the other parameters' values, by the keys of their names
    /special_points/LABEL attributes: kind, index, tolerance, converged, note, coefficients (JSON); vectors/NAME

A load path holds such a group for each of its segments.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.results.branch import Branch
from mjcont.results.certificates import Certificate
from mjcont.results.files import (
    FORMAT_VERSION,
    frozen,
    read_columns,
    read_values,
    save_hdf5,
    write_common,
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
    f.attrs.update(
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
    f["states"].attrs.update(
        names=json.dumps([n for n, _ in branch.state_labels]), units=json.dumps([u for _, u in branch.state_labels])
    )
    f["eigenvalues/real"], f["eigenvalues/imag"] = eigenvalues.real, eigenvalues.imag
    f["stability"] = np.array([_CODES[s] for s in branch.stability], dtype=np.int8)
    f["stability"].attrs["meaning"] = "1 stable, 0 marginal, -1 unstable"
    f["n_unstable"] = branch.n_unstable.astype(np.int32)
    f["residuals"] = branch.residuals
    write_values(f, "fixed", branch.fixed)
    f.attrs["fixed_units"] = json.dumps(dict(branch.fixed_units))
    if branch.certificate is not None:
        f.attrs["certificate"] = branch.certificate.to_json()
    group = f.create_group("special_points")
    for mark in branch.marks:
        _write_mark(group.create_group(mark.label), mark, branch.kind)


def _write_mark(g: h5py.Group, mark: Mark, curve: str) -> None:
    g.attrs.update(
        kind=mark.kind,
        index=mark.index,
        tolerance=mark.tolerance,
        converged=mark.converged,
        note=mark.note,
        curve=curve,
        coefficients=json.dumps(dict(mark.coefficients)),
    )
    for name, vector in mark.vectors.items():
        g[f"vectors/{name}"] = vector


def read_branch(f: h5py.Group, problem: Model | None) -> Branch:
    """Return the branch in a file or a group of one."""
    columns = read_columns(f)
    words = {v: k for k, v in _CODES.items()}
    labels = list(zip(json.loads(f["states"].attrs["names"]), json.loads(f["states"].attrs["units"]), strict=True))
    free = {k: tuple(v) for k, v in json.loads(f.attrs["free"]).items()}
    fixed = read_values(f, "fixed")
    states, eigenvalues = frozen(f["states"][()]), f["eigenvalues/real"][()] + 1j * f["eigenvalues/imag"][()]
    held = json.loads(f.attrs.get("held", "[]"))
    problem = problem.holding(held) if problem is not None and held else problem
    late = Late(problem, states, fixed, {n: columns[n].values for n in free}, free)
    branch = Branch(
        kind=str(f.attrs["kind"]),
        name=str(f.attrs["name"]),
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
        fixed_units=json.loads(f.attrs["fixed_units"]),
        ends=[tuple(e) for e in json.loads(f.attrs["ends"])],
        start=str(f.attrs["start"]),
        settings=json.loads(f.attrs["settings"]),
        provenance={
            k.removeprefix("provenance_"): str(v) for k, v in f.attrs.items() if k.startswith("provenance_")
        },
        problem=problem,
        start_index=int(f.attrs["start_index"]),
        neutral_saddles=json.loads(f.attrs["neutral_saddles"]),
        notes=json.loads(f.attrs["notes"]),
        certificate=_read_certificate(f),
    )
    rows = {len(branch.states), len(branch.spectra), len(branch.stability), len(branch.n_unstable)}
    if rows | {len(branch.residuals)} | {len(c.values) for c in columns.values()} != {len(branch.states)}:
        raise ValueError("its columns differ in length")
    if any(not 0 <= m.index < len(branch) for m in branch.marks):
        raise ValueError("a special point is on no row")
    return branch


def _read_certificate(f: h5py.File) -> Any:
    if "certificate" not in f.attrs:
        return None
    return Certificate.from_json(str(f.attrs["certificate"]))


def _read_mark(g: h5py.Group, label: str) -> Mark:
    return Mark(
        kind=str(g.attrs["kind"]),
        label=label,
        index=int(g.attrs["index"]),
        tolerance=float(g.attrs["tolerance"]),
        converged=bool(g.attrs["converged"]),
        coefficients=json.loads(g.attrs["coefficients"]),
        vectors={k: v[()] for k, v in g["vectors"].items()} if "vectors" in g else {},
        note=str(g.attrs["note"]),
    )
