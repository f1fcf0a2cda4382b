"""Time histories as HDF5, in the layout of `storage.py`.

Layout (format version 2)::

    /               attributes: format, format_version, kind "history", name, status, message, settings (JSON), ...
    /model          the MJCF text (absent for a Mechanism made from a compiled model)
    /columns/KEY    (N,) float64, attributes name, unit, role
    /fixed          attributes: the other parameters' values (absent in older files)
    /states         (N, nq) float64
    /velocities     (N, nv) float64
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py

from mjcont.histories import History
from mjcont.storage import (
    FORMAT_VERSION,
    frozen,
    read_columns,
    read_problem,
    read_values,
    save_hdf5,
    write_common,
    write_values,
)

KIND = "history"


def save(history: History, path: str | Path) -> Path:
    """Write a history as HDF5."""
    return save_hdf5(path, lambda f: _write(history, f))


def _write(history: History, f: h5py.File) -> None:
    f.attrs.update(
        format="mjcont",
        format_version=FORMAT_VERSION,
        kind=KIND,
        name=history.name,
        status=history.status,
        message=history.message,
        settings=json.dumps(dict(history.settings)),
    )
    write_common(f, history)
    f["states"], f["velocities"] = history.states, history.velocities
    write_values(f, "fixed", history.fixed)


def read(f: h5py.File, problem: Any) -> History:
    """Read a history from an open file whose kind is "history"."""
    columns = read_columns(f)
    states, velocities = frozen(f["states"][()]), frozen(f["velocities"][()])
    if {len(velocities)} | {len(c.values) for c in columns.values()} != {len(states)}:
        raise ValueError("its columns differ in length")
    prefix = "provenance_"
    return History(
        columns=columns,
        states=states,
        velocities=velocities,
        status=str(f.attrs["status"]),
        message=str(f.attrs["message"]),
        settings=json.loads(f.attrs["settings"]),
        name=str(f.attrs["name"]),
        problem=read_problem(f, problem),
        fixed=read_values(f, "fixed") if "fixed" in f else {},
        provenance={k.removeprefix(prefix): str(v) for k, v in f.attrs.items() if k.startswith(prefix)},
    )
