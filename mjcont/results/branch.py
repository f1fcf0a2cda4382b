"""Results: points, special points, and branches with named columns. Immutable once made."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, overload

import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, NameLookupError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.results.certificates import Certificate
from mjcont.results.model import Model, model_of
from mjcont.results.points import Column, Mark, Point, SpecialPoint, show
from mjcont.results.quantities import column_of
from mjcont.results.spectra import Spectra
from mjcont.results.text import Cells, Shown, Tabular


@dataclass(frozen=True, repr=False)
class Branch(Tabular, Shown):
    """A curve of equilibria, or a locus of special points.

    Attributes
    ----------
    kind : "equilibria", "LP locus", "HB locus", ...
    name : the model's name.
    columns : mapping of name to Column; every free parameter and observable.
    states : (N, nq) array.
    spectra : the eigenvalues of the rows, those that stability could do without computed where they are read.
    stability : (N,) array of "stable", "unstable", "marginal".
    n_unstable : (N,) int array.
    marks : what makes rows special points, in order along the branch.
    free : mapping of free parameter to its bounds.
    fixed, fixed_units : mappings of the other parameters to their values and units.
    ends : status and sentence of both ends, in the order of storage.
    start : how the first equilibrium was reached, a sentence.
    settings, provenance : mappings.
    problem : the Mechanism or VectorField, or None for a loaded file without one.
    start_index : row of the start.
    neutral_saddles : where two real eigenvalues of opposite sign were seen, by free parameter: no Hopf points.
    notes : sentences on the branch as a whole.
    certificate : what `verify_stability` found, or None.
    """

    kind: str
    name: str
    columns: Mapping[str, Column]
    states: Array
    state_labels: Sequence[tuple[str, str]]
    spectra: Spectra
    stability: Array
    n_unstable: Array
    residuals: Array
    marks: Sequence[Mark]
    free: Mapping[str, tuple[float, float]]
    fixed: Mapping[str, float]
    ends: Sequence[tuple[str, str]]
    start: str
    settings: Mapping[str, Any]
    provenance: Mapping[str, str]
    problem: Model | None = field(repr=False, default=None)
    start_index: int = 0
    neutral_saddles: Sequence[Mapping[str, float]] = ()
    notes: Sequence[str] = ()
    fixed_units: Mapping[str, str] = field(default_factory=dict)
    certificate: Certificate | None = field(repr=False, default=None)

    def __len__(self) -> int:
        """Return the number of rows: the points reached in turn, special points, and rows between (see `Settings`)."""
        return len(self.states)

    def __iter__(self) -> Iterator[Point]:
        """Iterate over the rows as points."""
        return (self.row(i) for i in range(len(self)))

    @overload
    def __getitem__(self, name: str) -> Array: ...

    @overload
    def __getitem__(self, name: int) -> Point: ...

    def __getitem__(self, name: Any) -> Any:
        """Return a column, SI and radians, (N,); for a whole number that row, a Point."""
        if isinstance(name, int | np.integer):
            return self.row(int(name))
        if not isinstance(name, str):
            raise NameLookupError(f"a branch has columns by name and rows by whole numbers, got {name!r}")
        if (own := column_of(name, self.columns)) is not None:
            return self.columns[own].values
        if name in self.fixed:
            return np.full(len(self), self.fixed[name])
        raise unknown_name("column", name, [*self.columns, *self.fixed])

    def drawn(self, name: str) -> list[str]:
        """Return the columns that a diagram shows for a name: that of the name."""
        return [name]

    def unit(self, name: str) -> str:
        """Return the unit of a column or of a fixed parameter."""
        if (own := column_of(name, self.columns)) is not None:
            return self.columns[own].unit
        if name in self.fixed:
            return self.fixed_units.get(name, "")
        raise unknown_name("column", name, [*self.columns, *self.fixed])

    @property
    def eigenvalues(self) -> Array:
        """Eigenvalues of all rows, (N, m), NaN where a row has fewer; those that are not known are computed."""
        return self.spectra.complete()

    @cached_property
    def special_points(self) -> Sequence[SpecialPoint]:
        """The rows that are special points, in order along the branch."""
        return tuple(m.on(self.row(m.index), self.free, self.kind) for m in self.marks)

    @property
    def model(self) -> Model:
        """The problem; an MjcontError where the branch was loaded from a file without it."""
        return model_of(self.problem, "the branch")

    @property
    def status(self) -> str:
        """One word for how the branch ended: the least regular of its two ends."""
        words = [word for word, _ in self.ends]
        regular = ("at bound", "closed")
        return next((w for w in words if w not in regular), words[0] if words else "not started")

    @property
    def message(self) -> str:
        """The sentences of both ends."""
        return "; ".join(dict.fromkeys(m for _, m in self.ends))

    @property
    def interrupted(self) -> bool:
        """Whether the user stopped the run."""
        return any(word == "interrupted" for word, _ in self.ends)

    @property
    def rated(self) -> bool:
        """Whether the stability of rows says something: along curves of equilibria and of orbits, not along loci."""
        return not self.kind.endswith("locus")

    @checked
    def of_kind(self, kind: str) -> list[SpecialPoint]:
        """Return the special points of one kind, in order along the branch."""
        return [p for p in self.special_points if p.kind == kind]

    @checked
    def point(self, label: str) -> SpecialPoint:
        """Return the special point with a label such as "LP1"."""
        for p in self.special_points:
            if p.label == label:
                return p
        raise unknown_name("special point", label, [p.label for p in self.special_points])

    @checked
    def row(self, index: int) -> Point:
        """Return a point of the branch by its row (-1 is the last), its eigenvalues computed if they are not known.

        Raises
        ------
        NameLookupError
            If there is no such row.
        """
        if not -len(self) <= index < len(self):
            raise NameLookupError(f"row {index} of {len(self)}: rows are 0 to {len(self) - 1}, or -1 for the last")
        index %= len(self)
        return Point(
            self.parameters_at(index),
            {c.name: float(c.values[index]) for c in self.columns.values() if c.role == "observable"},
            self.states[index].copy(),
            self.spectra.row(index),
            str(self.stability[index]),
            int(self.n_unstable[index]),
            self.problem,
            self.units,
        )

    @property
    def units(self) -> dict[str, str]:
        """Units of all columns."""
        return {c.name: c.unit for c in self.columns.values()}

    def parameters_at(self, index: int) -> dict[str, float]:
        """Return the values of all parameters in a row."""
        free = {n: float(self.columns[n].values[index]) for n in self.free}
        return {**self.fixed, **free}

    @checked
    def at(self, **target: float) -> list[Point]:
        """Return the points of the branch at which one column has a value, corrected to it (there may be several).

        Raises
        ------
        MjcontError
            If not exactly one column is given, or the branch was loaded without its problem.
        """
        from mjcont.curves.at import points_at

        if len(target) != 1:
            raise MjcontError("Branch.at takes exactly one column and value, such as at(F=20.0)")
        ((name, value),) = target.items()
        return points_at(self, name, value)

    @property
    def axes(self) -> tuple[str, str]:
        """The columns that a picture shows unless told otherwise: the parameter, and an observable."""
        (name, *_), observables = self.free, (n for n, c in self.columns.items() if c.role == "observable")
        return name, next(observables, name)

    @checked
    def plot(self, x: str = "", y: str = "", **options: Any) -> Any:
        """Draw the branch and return the axes; by default an observable over the parameter. `options` as for `plot`."""
        from mjcont.drawing.plotting import plot

        return plot(self, x=x, y=y, **options)

    def save(self, path: str | Path) -> Path:
        """Write the branch to an HDF5 file (replacing it whole or not at all) and return the path.

        Eigenvalues are written as far as they are known: a loaded branch computes the others where they are read. To
        have all of them in the file, read `eigenvalues` before. Only where the file does not carry the problem
        (a Mechanism made from a compiled model) are they computed now.
        """
        from mjcont.results.branchfiles import save

        return save(self, path)

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        yield from ((c.name, c.unit, c.values) for c in self.columns.values())
        yield "stability", "", self.stability
        yield "unstable eigenvalues", "", self.n_unstable
        yield "label", "", self.labels

    @property
    def labels(self) -> list[str]:
        """Label of each row, empty where it is no special point."""
        labels = [""] * len(self)
        for m in self.marks:
            labels[m.index] = m.label
        return labels

    def __str__(self) -> str:
        """Return a readable summary: rows, stability, special points with values, status."""
        free = ", ".join(self.free)
        lines = [f"{self.name}: {self.kind} in {free}, {len(self)} rows"]
        for name, (low, high) in self.free.items():
            values, unit = self[name], self.unit(name)
            span = f"{show(values.min(), unit)} .. {show(values.max(), unit)}"
            lines.append(f"  {name}: {span} (bounds {show(low, unit)} .. {show(high, unit)})")
        lines.append(f"  start: {self.start}")
        if self.rated:
            lines.append("  stability: " + self._stability_runs())
        lines += [f"  {p}" for p in self.special_points] or ["  no special points"]
        lines += [f"  note: {n}" for n in self.notes]
        lines += [f"  {self.certificate.headline}"] if self.certificate is not None else []
        lines += [f"  {which} end: {word}: {sentence}" for which, (word, sentence) in zip(
            ("first", "last"), self.ends, strict=False)]
        return "\n".join(lines)

    def _stability_runs(self) -> str:
        runs: list[list[Any]] = []
        for s in self.stability:
            if runs and runs[-1][0] == s:
                runs[-1][1] += 1
            else:
                runs.append([s, 1])
        return ", ".join(f"{word} ({count})" for word, count in runs)

    def settings_json(self) -> str:
        """Return the settings as JSON."""
        return json.dumps(dict(self.settings), sort_keys=True)


def sliced(branch: Branch, first: int, last: int) -> Branch:
    """Return rows first .. last of a branch, its special points among them kept under their labels."""
    rows = slice(first, last + 1)
    return replace(
        branch,
        columns={n: replace(c, values=c.values[rows]) for n, c in branch.columns.items()},
        states=branch.states[rows],
        spectra=branch.spectra.part(first, last),
        stability=branch.stability[rows],
        n_unstable=branch.n_unstable[rows],
        residuals=branch.residuals[rows],
        start_index=min(max(branch.start_index - first, 0), last - first),
        marks=[replace(m, index=m.index - first) for m in branch.marks if first <= m.index <= last],
    )


@dataclass(frozen=True, slots=True, repr=False)
class Diagram(Shown):
    """The branches of a bifurcation diagram, in the order in which they were found."""

    branches: Sequence[Branch]
    notes: Sequence[str] = ()

    def __len__(self) -> int:
        """Return the number of branches."""
        return len(self.branches)

    def __iter__(self) -> Iterator[Branch]:
        """Iterate over the branches."""
        return iter(self.branches)

    @checked
    def __getitem__(self, index: int) -> Branch:
        """Return a branch."""
        return self.branches[index]

    @checked
    def plot(self, x: str = "", y: str = "", **options: Any) -> Any:
        """Draw all branches and return the axes; by default an observable over the parameter."""
        from mjcont.drawing.plotting import plot

        if not self.branches:
            raise MjcontError("the diagram has no branches to draw")
        return plot(*self.branches, x=x, y=y, **options)

    @property
    def special_points(self) -> list[SpecialPoint]:
        """Return the special points of all branches; a branch point stands on each of its branches."""
        return [p for b in self.branches for p in b.special_points]

    def __str__(self) -> str:
        """Return the summaries of all branches."""
        lines = [f"{len(self.branches)} branches"]
        for i, b in enumerate(self.branches, 1):
            lines += [f"[{i}] {b}"]
        return "\n".join([*lines, *self.notes])
