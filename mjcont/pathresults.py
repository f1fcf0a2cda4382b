"""Results of following a load: the pieces of branches on which a mechanism rests, and its jumps between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from mjcont.branch import KIND_NAMES, Branch, Column, Point, show
from mjcont.errors import unknown_name
from mjcont.numerics.problem import Array

_SHOWN = 2


@dataclass(frozen=True, slots=True)
class Segment:
    """A piece of a stable branch along which the load moves the rest.

    Attributes
    ----------
    branch : its points; a column is in order of travel for direction 1, in reverse for -1.
    direction : 1 or -1.
    leg : index of the leg of the path, from 0.
    """

    branch: Branch
    direction: int
    leg: int

    def rows(self) -> Array:
        """Return the branch's row numbers in order of travel."""
        return np.arange(len(self.branch))[:: self.direction]

    def __getitem__(self, name: str) -> Array:
        """Return a column in order of travel."""
        return self.branch[name][:: self.direction]


@dataclass(frozen=True, slots=True)
class Jump:
    """What happens where a rest is lost.

    Attributes
    ----------
    label : of the point at which it is lost, such as "LP1", counted along the whole path.
    kind : "LP", "HB", "BP", "CO", or "lost" where an eigenvalue passed the axis unlocated.
    before : that point.
    after : the rest at which the motion landed, None if there is none.
    index : row of the path's columns before the jump.
    energy : potential energy released at fixed load, in J; None where it is not defined.
    energy_note : why not, a sentence.
    time : duration of the escape, in s, from a little way down it; NaN for creep.
    steps : forward evaluations that it took.
    status, message : "rest", "no rest", "diverged" or "interrupted", and a sentence.
    states : (m, nq) samples of the motion.
    """

    label: str
    kind: str
    before: Point
    after: Point | None
    index: int
    energy: float | None
    energy_note: str
    time: float
    steps: int
    status: str
    message: str
    states: Array = field(repr=False)

    def __str__(self) -> str:
        """Return a sentence: where, from, to, energy, time."""
        what = KIND_NAMES.get(self.kind, "unstable")
        names = list(self.before.observables)[:_SHOWN]
        units = self.before.units

        def shown(name: str) -> str:
            old = show(self.before[name], units.get(name, ""), 5)
            if self.after is None:
                return f"{name} = {old}"
            return f"{name} {old} -> {show(self.after[name], units.get(name, ''), 5)}"

        changes = ", ".join(shown(n) for n in names)
        energy = f"; releases {self.energy:.6g} J" if self.energy is not None else ""
        return f"{self.label} ({what}): {changes}{energy}; {self.message}"


@dataclass(frozen=True, slots=True)
class LoadPath:
    """The quasi-static response to a load that follows a path.

    Attributes
    ----------
    name : the model's name.
    vertices : parameter values between which the legs run.
    segments, jumps : in order of travel.
    status : "done", or why the path ends early: "no rest", "diverged", "interrupted", or the status of a branch.
    message : a sentence.
    evaluations : forward evaluations that it took, those of the escapes among them.
    problem : the Mechanism or VectorField.
    """

    name: str
    vertices: Sequence[Mapping[str, float]]
    segments: Sequence[Segment]
    jumps: Sequence[Jump]
    status: str
    message: str
    evaluations: int = 0
    problem: Any = field(repr=False, default=None)

    @property
    def names(self) -> tuple[str, ...]:
        """The parameters that the path changes."""
        return tuple(self.vertices[0])

    @property
    def done(self) -> bool:
        """Whether the end of the path was reached."""
        return self.status == "done"

    def __len__(self) -> int:
        """Return the number of rows."""
        return sum(len(s.branch) for s in self.segments)

    def __getitem__(self, name: str) -> Array:
        """Return a column along the whole path, SI and radians; a jump lies between two rows."""
        valid = [*self.segments[0].branch.columns, *self.segments[0].branch.fixed]
        if name not in valid:
            raise unknown_name("column", name, valid)
        return np.concatenate([s[name] for s in self.segments])

    def unit(self, name: str) -> str:
        """Return the unit of a column."""
        return self.segments[0].branch.unit(name)

    @property
    def states(self) -> Array:
        """States along the whole path, (N, nq)."""
        return np.concatenate([s.branch.states[:: s.direction] for s in self.segments])

    @property
    def final(self) -> Point:
        """The last rest on the path."""
        last = self.segments[-1]
        return last.branch.row(int(last.rows()[-1]))

    def jump(self, label: str) -> Jump:
        """Return the jump with a label such as "LP1"."""
        for j in self.jumps:
            if j.label == label:
                return j
        raise unknown_name("jump", label, [j.label for j in self.jumps])

    def to_csv(self, path: str | Path, *, degrees: bool = True) -> Path:
        """Write the columns along the whole path as CSV with units in the header; a jump lies between two rows."""
        from mjcont.storage import csv_columns

        names = [*self.names, *(n for n in self.segments[0].branch.columns if n not in self.names)]
        columns = {n: Column(n, self.unit(n), "path", self[n]) for n in names}
        return csv_columns(columns, path, degrees=degrees)

    def save(self, path: str | Path) -> Path:
        """Write the path to an HDF5 file (replacing it whole or not at all) and return the file's path."""
        from mjcont.pathfiles import save_path

        return save_path(self, path)

    def plot(self, x: str | None = None, y: str | None = None, **options: Any) -> Any:
        """Draw the path with arrows; default the parameter against the first observable. See `mjcont.plot`."""
        from mjcont.plotting import plot

        return plot(self, x=x or self.names[0], y=y or next(iter(self.final.observables)), **options)

    def __str__(self) -> str:
        """Return a readable summary: the way, the pieces, the jumps, how it ended."""
        way = " -> ".join(_vertex(v, self) for v in self.vertices)
        lines = [f"{self.name}: load path {way}: {len(self)} rows, {len(self.segments)} segments, "
                 f"{len(self.jumps)} jumps"]
        at, jumps = 0, {j.index: j for j in self.jumps}
        for s in self.segments:
            lines.append("  " + _segment(s))
            at += len(s.branch)
            if at - 1 in jumps:
                lines.append(f"  jump at {_values(self.names, jumps[at - 1].before)}: {jumps[at - 1]}")
        return "\n".join([*lines, f"  {self.status}: {self.message}"])


def _vertex(vertex: Mapping[str, float], path: LoadPath) -> str:
    return ", ".join(f"{n} = {show(v, path.unit(n), 6)}" for n, v in vertex.items())


def _values(names: Sequence[str], point: Point) -> str:
    return ", ".join(f"{n} = {show(point[n], point.units.get(n, ''), 10)}" for n in names)


def _segment(s: Segment) -> str:
    names = list(s.branch.free) + [c.name for c in s.branch.columns.values() if c.role == "observable"][:_SHOWN]
    spans = [f"{n} {show(s[n][0], s.branch.unit(n), 6)} -> {show(s[n][-1], s.branch.unit(n), 6)}" for n in names]
    return f"leg {s.leg + 1}: {', '.join(spans)} ({len(s.branch)} rows)"


def sliced(branch: Branch, first: int, last: int) -> Branch:
    """Return rows first .. last of a branch, its special points among them kept under their labels."""
    rows = slice(first, last + 1)
    return replace(
        branch,
        columns={n: replace(c, values=c.values[rows]) for n, c in branch.columns.items()},
        states=branch.states[rows],
        eigenvalues=branch.eigenvalues[rows],
        stability=branch.stability[rows],
        n_unstable=branch.n_unstable[rows],
        residuals=branch.residuals[rows],
        start_index=min(max(branch.start_index - first, 0), last - first),
        special_points=[
            replace(p, index=p.index - first) for p in branch.special_points if first <= p.index <= last
        ],
    )
