"""What a sweep found: one row a case, and its files.

Layout of an HDF5 file (format version 3)::

    /                 attributes: format, format_version, kind "sweep", name, what, nominal (JSON), provenance_...
    /study            the text of the study file, if there was one
    /columns/KEY      (N,) float64, attributes name, unit, role: "parameter" (varied) or "quantity" (recorded)
    /cases, /starts   (N,) int64: the case's number in the design, the case it was continued from (-1: the nominal one)
    /status, /message (N,) strings: "ok" or "failed", and what went wrong
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.errors import unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.outside.hdf5text import Attributes, put_text, read_text, read_texts
from mjcont.results.files import FORMAT_VERSION, frozen, read_columns, save_hdf5, write_columns
from mjcont.results.model import Model
from mjcont.results.points import Column, show
from mjcont.results.text import Cells, Shown, Tabular

KIND = "sweep"
_SHOWN_FAILURES = 5


@dataclass(frozen=True, slots=True, repr=False)
class SweepTable(Tabular, Shown):
    """Quantities of special points over many variants of a model; SI and radians.

    Attributes
    ----------
    name : the model's name.
    what : the design in words.
    columns : mapping of name to Column; the parameters that vary, then the quantities recorded (NaN where not found).
    cases : (N,) int array, numbers in the design.
    starts : (N,) int array, the case each was continued from, -1 for the nominal one.
    status : (N,) array of "ok" and "failed".
    messages : sentence of each failed case, else empty.
    nominal : mapping of column to its value at the nominal case.
    provenance : mapping: versions, the model's hash, the seed.
    study : the text of the study file, or "".
    """

    name: str
    what: str
    columns: Mapping[str, Column]
    cases: Array
    starts: Array
    status: Array
    messages: Sequence[str]
    nominal: Mapping[str, float]
    provenance: Mapping[str, str]
    study: str = field(repr=False, default="")

    def __len__(self) -> int:
        """Return the number of cases."""
        return len(self.cases)

    def __getitem__(self, name: str) -> Array:
        """Return a column, (N,)."""
        return self._column(name).values

    def _column(self, name: str) -> Column:
        if name not in self.columns:
            raise unknown_name("column", name, self.columns)
        return self.columns[name]

    @property
    def varied(self) -> list[str]:
        """Names of the parameters that vary."""
        return [n for n, c in self.columns.items() if c.role == "parameter"]

    @property
    def recorded(self) -> list[str]:
        """Names of the quantities recorded."""
        return [n for n, c in self.columns.items() if c.role == "quantity"]

    @property
    def failed(self) -> list[tuple[int, str]]:
        """Number and sentence of each case that failed."""
        return [(int(c), m) for c, s, m in zip(self.cases, self.status, self.messages, strict=True) if s == "failed"]

    def correlations(self, quantity: str) -> dict[str, float]:
        """Return the rank correlation of a quantity with each parameter, the strongest first."""
        from scipy import stats

        y = self[quantity]
        good = np.isfinite(y)
        found = {}
        for name in self.varied:
            x = self[name][good]
            constant = len(x) < 3 or np.ptp(x) == 0 or np.ptp(y[good]) == 0
            found[name] = math.nan if constant else float(stats.spearmanr(x, y[good]).statistic)
        return dict(sorted(found.items(), key=lambda item: -abs(item[1]) if math.isfinite(item[1]) else 0.0))

    def plot(self, quantity: str | None = None, against: str | None = None, *, ax: Any = None) -> Any:
        """Draw the distribution of a quantity (default the first), or scatter it against a column; return the axes."""
        from mjcont.drawing.charts import draw_histogram, draw_scatter

        name = quantity or self.recorded[0]
        if against is None:
            return draw_histogram(self, self._column(name), ax)
        return draw_scatter(self, self._column(against), self._column(name), ax)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        yield from ((c.name, c.unit, c.values) for c in self.columns.values())
        yield "case", "", self.cases
        yield "continued from", "", self.starts
        yield "status", "", self.status
        yield "message", "", self.messages

    def save(self, path: str | Path) -> Path:
        """Write the table as HDF5, whole or not at all; `mjcont.load` reads it."""
        return save_hdf5(path, self._write)

    def _write(self, f: h5py.File) -> None:
        Attributes(f).update(format="mjcont", format_version=FORMAT_VERSION, kind=KIND, name=self.name, what=self.what)
        Attributes(f)["nominal"] = json.dumps(dict(self.nominal))
        Attributes(f).update({f"provenance_{k}": v for k, v in self.provenance.items()})
        write_columns(f, self.columns)
        f["cases"], f["starts"] = self.cases, self.starts
        put_text(f, "study", self.study)
        put_text(f, "status", [str(s) for s in self.status])
        put_text(f, "message", self.messages)

    def __str__(self) -> str:
        """Return how each quantity is distributed, what it goes with, and the first failures."""
        lines = [f"{self.name}: {self.what}; {len(self)} cases, {len(self.failed)} failed"]
        for name in self.recorded:
            column = self.columns[name]
            good = column.values[np.isfinite(column.values)]
            if not len(good):
                lines.append(f"  {name}: in no case")
                continue
            unit = column.unit
            mean, low, middle, high = (show(float(v), unit, 5) for v in (
                good.mean(), *np.percentile(good, (2.5, 50.0, 97.5))))
            lines.append(
                f"  {name}: nominal {show(self.nominal[name], unit, 5)}, mean {mean}, standard deviation "
                f"{show(float(good.std(ddof=1)) if len(good) > 1 else 0.0, unit, 3)}, 95 % in {low} .. {high}, "
                f"median {middle}"
            )
            strongest = [(n, r) for n, r in self.correlations(name).items() if math.isfinite(r)][:3]
            if strongest:
                lines.append("    goes with " + ", ".join(f"{n} ({r:+.2f})" for n, r in strongest))
        lines += [f"  case {c} failed: {m}" for c, m in self.failed[:_SHOWN_FAILURES]]
        return "\n".join(lines)


def read(f: h5py.File, problem: Model | None = None) -> SweepTable:
    """Return the sweep in a file."""
    return SweepTable(
        str(Attributes(f)["name"]),
        str(Attributes(f)["what"]),
        read_columns(f),
        frozen(f["cases"][()]),
        frozen(f["starts"][()]),
        frozen(np.array(read_texts(f["status"]), dtype="U8")),
        tuple(read_texts(f["message"])),
        json.loads(Attributes(f)["nominal"]),
        Attributes(f).beginning("provenance_"),
        read_text(f["study"]),
    )
