"""Files: branches as HDF5 that other tools read, and as CSV. Nothing read from a file is executed.

Layout of an HDF5 file (format version 2; behind it stands the seal of `sealing`)::

    /                     attributes: format, format_version, kind, name, start, start_index, settings (JSON),
                          declared (JSON: parameters by path; of a Python function only the name), ...
    /model                the MJCF text (absent for a VectorField)
    /columns/KEY          (N,) float64, attributes name, unit, role; KEY is the name as `hdf5names` writes it
    /states               (N, nq) float64, attributes names, units
    /eigenvalues/real, /eigenvalues/imag   (N, m) float64
    /stability            (N,) int8: 1 stable, 0 marginal, -1 unstable
    /n_unstable           (N,) int32
    /residuals            (N,) float64, scaled
    /fixed                attributes: the other parameters' values, by the keys of their names
    /special_points/LABEL attributes: kind, index, tolerance, converged, note, coefficients (JSON); vectors/NAME

A load path (kind "load path") holds such a group for each of its segments: see `pathfiles`. In version 1 names stood
for themselves, as paths, and nothing was sealed.
"""

from __future__ import annotations

import json
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.branch import Branch, Column, Point, SpecialPoint
from mjcont.csvfiles import write_table
from mjcont.errors import MjcontError, ModelWarning, ResultFileError, ResultWarning
from mjcont.hdf5names import key
from mjcont.saving import write_file
from mjcont.sealing import Damaged, opened, refuse_broken_seal, sealed_file
from mjcont.travel import declare_again

FORMAT_VERSION = 2
# What h5py, json and our own reading raise on files with parts missing or overwritten.
_DAMAGED = (
    LookupError, ValueError, TypeError, AttributeError, ArithmeticError, AssertionError, OSError, RuntimeError,
    MemoryError, MjcontError,
)
_CODES = {"stable": 1, "marginal": 0, "unstable": -1}


def save_hdf5(path: str | Path, fill: Callable[[h5py.File], None]) -> Path:
    """Write what `fill` puts into an HDF5 file, sealed, whole or not at all."""
    return write_file(path, sealed_file(fill))


def save(branch: Branch, path: str | Path) -> Path:
    """Write a branch as HDF5."""
    return save_hdf5(path, lambda f: write_branch(branch, f))


def write_branch(branch: Branch, f: h5py.Group, *, model: bool = True) -> None:
    """Write a branch into a file or a group of one, with its model unless the file has that elsewhere."""
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
    )
    write_common(f, branch, model=model)
    f["states"] = branch.states
    f["states"].attrs.update(
        names=json.dumps([n for n, _ in branch.state_labels]), units=json.dumps([u for _, u in branch.state_labels])
    )
    f["eigenvalues/real"], f["eigenvalues/imag"] = branch.eigenvalues.real, branch.eigenvalues.imag
    f["stability"] = np.array([_CODES[s] for s in branch.stability], dtype=np.int8)
    f["stability"].attrs["meaning"] = "1 stable, 0 marginal, -1 unstable"
    f["n_unstable"] = branch.n_unstable.astype(np.int32)
    f["residuals"] = branch.residuals
    write_values(f, "fixed", branch.fixed)
    f.attrs["fixed_units"] = json.dumps(dict(branch.fixed_units))
    if branch.certificate is not None:
        f.attrs["certificate"] = branch.certificate.to_json()
    group = f.create_group("special_points")
    for p in branch.special_points:
        _write_special(group.create_group(p.label), p)


def write_common(f: h5py.Group, result: Any, *, model: bool = True) -> None:
    """Write what every result has: its columns, where it comes from, its model unless the file has that elsewhere."""
    f.attrs.update({f"provenance_{k}": v for k, v in result.provenance.items()})
    mjcf = getattr(result.problem, "mjcf", None)
    if mjcf is not None and model:
        f["model"] = mjcf
    f.attrs["declared"] = json.dumps(getattr(result.problem, "declared", {}))
    write_columns(f, result.columns)


def write_columns(f: h5py.Group, columns: Mapping[str, Column]) -> None:
    """Write columns, any names."""
    group = f.create_group("columns")
    for name, c in columns.items():
        dataset = group.create_dataset(key(name), data=c.values, track_order=True)
        dataset.attrs.update(name=json.dumps(name), unit=c.unit, role=c.role)
    group.attrs.update(order=json.dumps(list(columns)), keys=json.dumps([key(name) for name in columns]))


def write_values(f: h5py.Group, name: str, values: Mapping[str, float]) -> None:
    """Write numbers by any names, as attributes of a group."""
    f.create_group(name).attrs.update({key(n): v for n, v in values.items()})
    f.attrs[f"{name}_keys"] = json.dumps({key(n): n for n in values})


def read_values(f: h5py.Group, name: str) -> dict[str, float]:
    """Return what `write_values` wrote."""
    names = json.loads(f.attrs.get(f"{name}_keys", "{}"))
    return {names.get(k, k): float(v) for k, v in f[name].attrs.items()}


def _write_special(g: h5py.Group, p: SpecialPoint) -> None:
    g.attrs.update(
        kind=p.kind,
        index=p.index,
        tolerance=p.tolerance,
        converged=p.converged,
        note=p.note,
        curve=p.curve,
        coefficients=json.dumps(dict(p.coefficients)),
    )
    for name, vector in p.vectors.items():
        g[f"vectors/{name}"] = vector


def load(path: str | Path, problem: Any = None) -> Any:
    """Read a result; a Mechanism is rebuilt from the MJCF in the file unless `problem` is given.

    Raises
    ------
    ResultFileError
        If the file does not exist, is no mjcont result, or has a newer format.
    """
    path = Path(path)
    if not path.is_file():
        raise ResultFileError(f"result file '{path}': no such file")
    try:
        data = path.read_bytes()
    except OSError as error:
        raise ResultFileError(f"result file '{path}' cannot be read: {error.strerror or error}") from error
    try:
        f, sealed = opened(data)
    except OSError as error:
        raise ResultFileError(f"result file '{path}' is not an HDF5 file") from error
    except Damaged as error:
        raise ResultFileError(f"result file '{path}' is incomplete or damaged: {error}") from error
    with f:
        try:
            found = _read(f, problem, sealed)
        except (*_DAMAGED, Damaged, _Unfit) as error:
            what = error if isinstance(error, _Unfit) else f" is incomplete or damaged: {error}"
            raise ResultFileError(f"result file '{path}'{what}") from error
    if not sealed:
        warnings.warn(
            f"result file '{path}' has no checksums (an older mjcont wrote it): damaged numbers would not be noticed",
            ResultWarning, stacklevel=2,
        )
    return found


class _Unfit(Exception):
    """A file that is what it should be, but not for us; the sentence goes on after its name."""


def _read(f: h5py.File, problem: Any, sealed: bool) -> Any:
    if f.attrs.get("format") != "mjcont":
        raise _Unfit(" was not written by mjcont")
    version = int(f.attrs["format_version"])
    if version > FORMAT_VERSION:
        raise _Unfit(f" has format version {version}; this mjcont reads up to {FORMAT_VERSION}: upgrade mjcont")
    if not sealed:
        refuse_broken_seal(f)
    if f.attrs["kind"] == "history":
        from mjcont.historyfiles import read

        return read(f, problem)
    if f.attrs["kind"] == "sweep":
        from mjcont.sweeptable import read_table

        return read_table(f)
    if f.attrs["kind"] == "load path":
        from mjcont.pathfiles import read_path

        return read_path(f, read_problem(f, problem))
    return read_branch(f, read_problem(f, problem))


def read_problem(f: h5py.File, problem: Any) -> Any:
    """Return the problem given, or the Mechanism rebuilt from the file's MJCF, or None."""
    if problem is None and "model" in f:
        from mjcont.mechanism import Mechanism

        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ModelWarning)  # said when the result was computed
            problem = Mechanism.from_xml(f["model"].asstr()[()])
        declared = json.loads(f.attrs["declared"])
        for name, given in declared.items():
            if "function" in given:
                raise _Unfit(
                    f": its parameter '{name}' is the Python function {given['function']}, which a file cannot carry: "
                    "declare it on a Mechanism again and load with problem=mechanism"
                )
        declare_again(problem, declared)
    return problem


def read_columns(f: h5py.Group) -> dict[str, Column]:
    """Return the columns in their order."""
    found = {}
    group = f["columns"]
    names = json.loads(group.attrs["order"])
    stored = json.loads(group.attrs["keys"]) if "keys" in group.attrs else names
    for name, place in zip(names, stored, strict=True):
        d = group[place]
        found[name] = Column(name, d.attrs["unit"], d.attrs["role"], frozen(d[()]))
    return found


def read_branch(f: h5py.Group, problem: Any) -> Branch:
    """Return the branch in a file or a group of one."""
    columns = read_columns(f)
    words = {v: k for k, v in _CODES.items()}
    labels = list(zip(json.loads(f["states"].attrs["names"]), json.loads(f["states"].attrs["units"]), strict=True))
    branch = Branch(
        kind=str(f.attrs["kind"]),
        name=str(f.attrs["name"]),
        columns=columns,
        states=frozen(f["states"][()]),
        state_labels=labels,
        eigenvalues=frozen(f["eigenvalues/real"][()] + 1j * f["eigenvalues/imag"][()]),
        stability=frozen(np.array([words[int(c)] for c in f["stability"][()]], dtype="U8")),
        n_unstable=frozen(f["n_unstable"][()].astype(int)),
        residuals=frozen(f["residuals"][()]),
        special_points=(),
        free={k: tuple(v) for k, v in json.loads(f.attrs["free"]).items()},
        fixed=read_values(f, "fixed"),
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
    rows = {len(branch.states), len(branch.eigenvalues), len(branch.stability), len(branch.n_unstable)}
    if rows | {len(branch.residuals)} | {len(c.values) for c in columns.values()} != {len(branch.states)}:
        raise ValueError("its columns differ in length")
    points = [_read_special(f["special_points"][label], label, branch) for label in f["special_points"]]
    object.__setattr__(branch, "special_points", tuple(sorted(points, key=lambda p: p.index)))
    return branch


def _read_certificate(f: h5py.File) -> Any:
    if "certificate" not in f.attrs:
        return None
    from mjcont.certificates import Certificate

    return Certificate.from_json(str(f.attrs["certificate"]))


def frozen(array: np.ndarray) -> np.ndarray:
    """Return an array made read-only."""
    array.flags.writeable = False
    return array


def _read_special(g: h5py.Group, label: str, branch: Branch) -> SpecialPoint:
    index = int(g.attrs["index"])
    vectors = {k: v[()] for k, v in g["vectors"].items()} if "vectors" in g else {}
    return special_from_row(
        branch.row(index),
        kind=str(g.attrs["kind"]),
        label=label,
        index=index,
        tolerance=float(g.attrs["tolerance"]),
        converged=bool(g.attrs["converged"]),
        coefficients=json.loads(g.attrs["coefficients"]),
        vectors=vectors,
        note=str(g.attrs["note"]),
        free=branch.free,
        curve=str(g.attrs["curve"]),
    )


def special_from_row(row: Point, **details: Any) -> SpecialPoint:
    """Return a special point from its row of a branch and what is known beside it."""
    return SpecialPoint(
        row.parameters,
        row.observables,
        row.state,
        row.eigenvalues,
        row.stability,
        row.n_unstable,
        row.problem,
        row.units,
        **details,
    )


def write_csv(branch: Branch, path: str | Path, *, degrees: bool = True) -> Path:
    """Write the columns of a branch with units in the header; angles in degrees on request."""
    extra = list(zip(branch.stability, (int(n) for n in branch.n_unstable), branch.labels, strict=True))
    return csv_columns(branch.columns, path, ("stability", "unstable eigenvalues", "label"), extra, degrees=degrees)


def csv_columns(
    columns: Mapping[str, Column],
    path: str | Path,
    more: Sequence[str] = (),
    extra: Sequence[Sequence[Any]] = (),
    *,
    degrees: bool = True,
) -> Path:
    """Write columns as CSV, with further cells `extra` under the headings `more`."""
    units = {c.name: c.unit for c in columns.values()}
    turn = [degrees and u == "rad" for u in units.values()]
    header = [f"{n} [{'deg' if t else u}]" if u else n for (n, u), t in zip(units.items(), turn, strict=True)]
    rows = np.column_stack([c.values for c in columns.values()])
    rows[:, turn] = np.degrees(rows[:, turn])

    body = ([*(v if math.isfinite(v) else "" for v in row), *(extra[i] if extra else ())]
            for i, row in enumerate(rows.tolist()))
    return write_table(path, [*header, *more], body)
