"""Time histories, and their files.

Layout of a file beside what `files` says (format version 3)::

    /               attributes: format, format_version, kind "history", name, status, message, settings (JSON), ...
    /model          the MJCF text (absent for a Mechanism made from a compiled model)
    /columns/KEY    (N,) float64, attributes name, unit, role
    /fixed          attributes: the other parameters' values (absent in older files)
    /states         (N, nq) float64
    /velocities     (N, nv) float64
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.outside.hdf5text import Attributes
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
from mjcont.results.points import Column
from mjcont.results.quantities import column_of
from mjcont.results.text import Cells, Shown, Tabular, to_xarray

KIND = "history"
# columns that are drawn without being named
_SHOWN = 4


@dataclass(frozen=True, slots=True, repr=False)
class History(Tabular, Shown):
    """A time history.

    Attributes
    ----------
    columns : mapping of name to Column: "time", the inputs, every observable; each (N,), SI and radians.
    states, velocities : (N, nq) and (N, nv) arrays.
    status : "done", "at rest", "stalled" (the tolerance was not reached), "diverged" or "interrupted".
    message : a sentence.
    settings : integrator, timestep, duration, steps, control_step, tol, and error: by how much halving the step
        changed the history, relative to the motion's size (None without tol).
    provenance : versions and the model's hash.
    problem : the Mechanism, or None for a loaded file without one.
    fixed : mapping of the other parameters to their values.
    """

    columns: Mapping[str, Column]
    states: Array
    velocities: Array
    status: str
    message: str
    settings: Mapping[str, Any]
    name: str = ""
    problem: Model | None = field(repr=False, default=None)
    provenance: Mapping[str, str] = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict, repr=False)

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.states)

    def __getitem__(self, name: str) -> Array:
        """Return a column, (N,)."""
        if (own := column_of(name, self.columns)) is not None:
            return self.columns[own].values
        if name in self.fixed:
            return np.full(len(self), self.fixed[name])
        raise unknown_name("column", name, [*self.columns, *self.fixed])

    def unit(self, name: str) -> str:
        """Return the unit of a column or of a fixed parameter."""
        if (own := column_of(name, self.columns)) is not None:
            return self.columns[own].unit
        if name in self.fixed:
            return str(self.problem.parameter(name).unit) if self.problem is not None else ""
        raise unknown_name("column", name, [*self.columns, *self.fixed])

    @property
    def units(self) -> dict[str, str]:
        """Units of all columns."""
        return {c.name: c.unit for c in self.columns.values()}

    def plot(self, *columns: str) -> Any:
        """Draw columns against time, one below the other, and return the figure; by default the first few observables.

        Raises
        ------
        NameLookupError
            If there is no such column.
        """
        from mjcont.drawing.charts import draw_history

        own = [c.name for c in self.columns.values() if c.role == "observable"][:_SHOWN]
        return draw_history(self, columns or own or [n for n in self.columns if n != "time"])

    def save(self, path: str | Path) -> Path:
        """Write the history to an HDF5 file (replacing it whole or not at all) and return the path."""
        return save_hdf5(path, self._write)

    def _write(self, f: h5py.File) -> None:
        Attributes(f).update(
            format="mjcont",
            format_version=FORMAT_VERSION,
            kind=KIND,
            name=self.name,
            status=self.status,
            message=self.message,
            settings=json.dumps(dict(self.settings)),
        )
        write_common(f, self)
        f["states"], f["velocities"] = self.states, self.velocities
        write_values(f, "fixed", self.fixed)

    def to_xarray(self) -> Any:
        """Return the columns over time as an xarray Dataset, SI and radians, units in `attrs`.

        Raises
        ------
        MjcontError
            If xarray is not installed.
        """
        columns = {c.name: (c.unit, c.values) for c in self.columns.values()}
        return to_xarray({"time": columns.pop("time")}, columns)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        return ((c.name, c.unit, c.values) for c in self.columns.values())

    def __str__(self) -> str:
        """Return a one-line summary."""
        s = self.settings
        error = s.get("error")
        known = "no error estimate (tol= asks for one)" if error is None else f"error about {error:.1e}"
        return (
            f"{self.name}: time history of {self['time'][-1]:g} s, {len(self)} samples, "
            f"{s['integrator']} with a step of {s['timestep']:g} s, {known}: {self.message}"
        )


def read(f: h5py.File, problem: Model | None) -> History:
    """Return the history in a file."""
    columns = read_columns(f)
    states, velocities = frozen(f["states"][()]), frozen(f["velocities"][()])
    if {len(velocities)} | {len(c.values) for c in columns.values()} != {len(states)}:
        raise ValueError("its columns differ in length")
    return History(
        columns=columns,
        states=states,
        velocities=velocities,
        status=str(Attributes(f)["status"]),
        message=str(Attributes(f)["message"]),
        settings=json.loads(Attributes(f)["settings"]),
        name=str(Attributes(f)["name"]),
        problem=problem,
        fixed=read_values(f, "fixed") if "fixed" in f else {},
        provenance=Attributes(f).beginning("provenance_"),
    )
