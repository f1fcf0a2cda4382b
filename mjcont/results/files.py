"""What all result files share: written whole or not at all, a header, columns, the model; CSV. Nothing is executed.

Every HDF5 file begins with (format version 1)::

    /                     attributes: format "mjcont", format_version, kind, name, provenance_..., declared (JSON:
                          parameters by path; of a Python function only the name)
    /model                the MJCF text (absent for a VectorField)
    /columns/NAME         (N,) float64, attributes unit, role; their order is an attribute of /columns

The rest is written beside each result: `branchfiles`, `loadpaths`, `histories`, `sweeps`; `formats` reads them all.
"""

from __future__ import annotations

import csv
import json
import math
import os
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.errors import MjcontError, ModelWarning, ResultFileError
from mjcont.results.model import Model
from mjcont.results.points import Column

FORMAT_VERSION = 1


def write_atomically(path: str | Path, write: Callable[[Path], None]) -> Path:
    """Let `write` fill a temporary file beside `path`, then put it in place in one step."""
    path = Path(path)
    if not path.parent.is_dir():
        raise MjcontError(f"cannot write {path}: the folder {path.parent} does not exist")
    try:
        handle, name = tempfile.mkstemp(prefix=f".{path.name}.", suffix=path.suffix, dir=path.parent)
    except OSError as error:
        raise MjcontError(f"cannot write {path}: {error.strerror}") from error
    os.close(handle)
    try:
        write(Path(name))
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return path


def write_common(f: h5py.Group, result: Any, *, model: bool = True) -> None:
    """Write what every result has: its columns, where it comes from, its model unless the file has that elsewhere."""
    f.attrs.update({f"provenance_{k}": v for k, v in result.provenance.items()})
    problem: Model | None = result.problem
    if problem is not None and problem.mjcf is not None and model:
        f["model"] = problem.mjcf
    f.attrs["declared"] = json.dumps(dict(problem.declared) if problem is not None else {})
    for c in result.columns.values():
        f.create_dataset(f"columns/{c.name}", data=c.values, track_order=True).attrs.update(unit=c.unit, role=c.role)
    f["columns"].attrs["order"] = json.dumps(list(result.columns))


def read_problem(f: h5py.File, problem: Model | None) -> Model | None:
    """Return the problem given, or the Mechanism rebuilt from the file's MJCF, or None."""
    if problem is not None or "model" not in f:
        return problem
    from mjcont.mechanism.mechanism import Mechanism

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)  # said when the result was computed
        mechanism = Mechanism.from_xml(f["model"].asstr()[()])
    for name, given in json.loads(f.attrs["declared"]).items():
        if "function" in given:
            raise ResultFileError(
                f"result file '{f.filename}': its parameter '{name}' is the Python function {given['function']}, "
                "which a file cannot carry: declare it on a Mechanism again and load with problem=mechanism"
            )
        mechanism.declare(name, *given["paths"], unit=given["unit"], bounds=given["bounds"])
    return mechanism


def read_columns(f: h5py.Group) -> dict[str, Column]:
    """Return the columns in their order."""
    found = {}
    for name in json.loads(f["columns"].attrs["order"]):
        d = f["columns"][name]
        found[name] = Column(name, d.attrs["unit"], d.attrs["role"], frozen(d[()]))
    return found


def frozen(array: np.ndarray) -> np.ndarray:
    """Return an array made read-only."""
    array.flags.writeable = False
    return array


def write_columns(
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

    def write(temporary: Path) -> None:
        with temporary.open("w", newline="", encoding="utf-8") as f:
            out = csv.writer(f)
            out.writerow([*header, *more])
            for i, row in enumerate(rows):
                out.writerow([*(_csv_number(v) for v in row), *(extra[i] if extra else ())])

    return write_atomically(path, write)


def _csv_number(value: float) -> str:
    return repr(float(value)) if math.isfinite(value) else ""


def output_folder(path: str | Path) -> Path:
    """Return a folder, made if it is missing, after trying to write to it."""
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = "it is a file" if folder.is_file() else error.strerror
        raise MjcontError(f"cannot write to the output folder '{path}': {reason}") from error
    return folder
