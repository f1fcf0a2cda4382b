"""What all result files share: a header, columns, the model, a seal. Nothing read from a file is executed.

Every HDF5 file begins with (format version 3; behind it stands the seal of `outside/sealing.py`)::

    /                     attributes: format "mjcont", format_version, kind, name, provenance_..., declared (JSON:
                          parameters by path; of a Python function only the name)
    /model                the MJCF text (absent for a VectorField)
    /columns/KEY          (N,) float64, attributes name, unit, role; their order is an attribute of /columns; KEY is the
                          name as `outside/hdf5names.py` writes it

Texts are of fixed length (`outside/hdf5text.py`), complex arrays are two real ones: any program that reads HDF5 reads
all of it. The rest is written beside each result: `branchfiles`, `loadpaths`, `histories`, `sweeps`; `formats` reads
them all. In version 2 texts were of variable length, in version 1 names stood for themselves, as paths, and nothing was
sealed.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.errors import ModelWarning
from mjcont.outside.hdf5names import key
from mjcont.outside.hdf5text import Attributes, put_text, read_text
from mjcont.outside.saving import write_file
from mjcont.outside.sealing import sealed_file
from mjcont.results.model import Model
from mjcont.results.points import Column

RESULT_SUFFIXES = (".h5", ".hdf5")
FORMAT_VERSION = 3


class Unfit(Exception):
    """A file that is what it should be, but not for us; the sentence goes on after its name."""


def save_hdf5(path: str | Path, fill: Callable[[h5py.File], None]) -> Path:
    """Write what `fill` puts into an HDF5 file, sealed, whole or not at all."""
    return write_file(path, sealed_file(fill))


def write_common(f: h5py.Group, result: Any, *, model: bool = True) -> None:
    """Write what every result has: its columns, where it comes from, its model unless the file has that elsewhere."""
    Attributes(f).update({f"provenance_{k}": v for k, v in result.provenance.items()})
    write_model(f, result.problem, text=model)
    write_columns(f, result.columns)


def write_model(f: h5py.Group, problem: Model | None, *, text: bool = True) -> None:
    """Write the model's text, if it has one, and what was declared in Python."""
    if problem is not None and problem.mjcf is not None and text:
        put_text(f, "model", problem.mjcf)
    Attributes(f)["declared"] = json.dumps(dict(problem.declared) if problem is not None else {})


def write_columns(f: h5py.Group, columns: Mapping[str, Column]) -> None:
    """Write columns, any names."""
    group = f.create_group("columns")
    for name, c in columns.items():
        dataset = group.create_dataset(key(name), data=c.values, track_order=True)
        Attributes(dataset).update(name=json.dumps(name), unit=c.unit, role=c.role)
    Attributes(group).update(order=json.dumps(list(columns)), keys=json.dumps([key(name) for name in columns]))


def write_values(f: h5py.Group, name: str, values: Mapping[str, float]) -> None:
    """Write numbers by any names, as attributes of a group."""
    Attributes(f.create_group(name)).update({key(n): v for n, v in values.items()})
    Attributes(f)[f"{name}_keys"] = json.dumps({key(n): n for n in values})


def read_values(f: h5py.Group, name: str) -> dict[str, float]:
    """Return what `write_values` wrote."""
    names = json.loads(Attributes(f).get(f"{name}_keys", "{}"))
    return {names.get(k, k): float(v) for k, v in Attributes(f[name]).beginning("").items()}


def read_problem(f: h5py.File, problem: Model | None) -> Model | None:
    """Return the problem given, or the Mechanism rebuilt from the file's MJCF, or None."""
    if problem is not None or "model" not in f:
        return problem
    from mjcont.mechanism.mechanism import Mechanism

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)  # said when the result was computed
        mechanism = Mechanism.from_xml(read_text(f["model"]))
    declared = json.loads(Attributes(f)["declared"])
    for name, given in declared.items():
        if "function" in given:
            raise Unfit(
                f": its parameter '{name}' is the Python function {given['function']}, which a file cannot carry: "
                "declare it on a Mechanism again and load with problem=mechanism"
            )
    mechanism.declare_again(declared)
    return mechanism


def read_columns(f: h5py.Group) -> dict[str, Column]:
    """Return the columns in their order."""
    found = {}
    group = f["columns"]
    names = json.loads(Attributes(group)["order"])
    stored = json.loads(Attributes(group)["keys"]) if "keys" in Attributes(group) else names
    for name, place in zip(names, stored, strict=True):
        d = group[place]
        found[name] = Column(name, Attributes(d)["unit"], Attributes(d)["role"], frozen(d[()]))
    return found


def write_complex(f: h5py.Group, name: str, values: np.ndarray) -> None:
    """Write a complex array as two real ones."""
    f[f"{name}/real"], f[f"{name}/imag"] = values.real, values.imag


def read_complex(f: h5py.Group) -> np.ndarray:
    """Return what `write_complex` wrote."""
    found: np.ndarray = f["real"][()] + 1j * f["imag"][()]
    return frozen(found)


def frozen(array: np.ndarray) -> np.ndarray:
    """Return an array made read-only."""
    array.flags.writeable = False
    return array
