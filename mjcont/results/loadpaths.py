"""Results of following a load: the pieces of branches on which a mechanism rests, and its jumps between them.

Layout of a file beside what `files` says (format version 2)::

    /                 attributes: format, format_version, kind "load path", name, vertices (JSON), status, message
    /model            the MJCF text
    /segments/I       a branch (see `branchfiles`), attributes direction, leg
    /jumps/I          attributes: label, kind, index, energy (absent if not defined), energy_note, time, steps, ...;
                      at folds parameter, load, passage (inertia, damping, slope, curvature)
    /jumps/I/states   (m, nq) samples of the motion; the points on both sides are rows of the segments
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import astuple, dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mjcont.arguments import checked
from mjcont.errors import MjcontError, ParameterError, unknown_name
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.points.kinds import KINDS
from mjcont.numerics.points.passage import Passage
from mjcont.outside.hdf5text import Attributes
from mjcont.results.branch import Branch
from mjcont.results.branchfiles import read_branch, write_branch
from mjcont.results.files import FORMAT_VERSION, save_hdf5, write_model
from mjcont.results.model import Model
from mjcont.results.points import Point, show
from mjcont.results.quantities import check_name
from mjcont.results.text import Cells, Shown, Tabular

KIND = "load path"
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
class Delay:
    """How late a jump is under a load that changes at a finite rate.

    Attributes
    ----------
    time : s between the fold and the jump.
    shift : how far the load is then beyond the fold, as a positive number.
    inertial : part of inertia in it: 0 where damping alone delays (shift ~ rate^(2/3)), 1 inertia (rate^(4/5)).
    """

    time: float
    shift: float
    inertial: float


@dataclass(frozen=True, slots=True, repr=False)
class Jump(Shown):
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
    parameter : what the load changes first, in whose unit the rates and shifts below are.
    load : its magnitude there, or, where that is zero, of the way left.
    passage : normal form of the fold for a load that moves at a finite rate; None where it is no fold.
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
    parameter: str = ""
    load: float = math.nan
    passage: Passage | None = None

    @checked
    def delay(self, rate: float) -> Delay:
        """Return how late the jump is under a load that changes at a rate, per s, that is, how slow is slow.

        Raises
        ------
        MjcontError
            If the rest is not lost at a fold.
        ParameterError
            If the rate is not a positive number, of either sign.
        """
        form = self._form()
        if not (math.isfinite(rate) and rate != 0.0):
            raise ParameterError(f"the rate of {self.parameter} must be a number other than zero, got {rate!r}")
        return Delay(form.time(rate), form.shift(rate), form.inertial(rate))

    @checked
    def slow(self, part: float = 0.01) -> float:
        """Return the rate, per s, at which the jump is late by a part of the load.

        Raises
        ------
        MjcontError
            If the rest is not lost at a fold.
        ParameterError
            If the part is not positive.
        """
        form = self._form()
        if not (math.isfinite(part) and part > 0.0):
            raise ParameterError(f"the part of the load must be a positive number, got {part!r}")
        return form.rate(part * self.load)

    def _form(self) -> Passage:
        if self.passage is None:
            what = KINDS[self.kind].name if self.kind in KINDS else "a loss of stability that was not located"
            raise MjcontError(f"{self.label} is {what}: how slow is slow is known at folds (LP) with curvature alone")
        return self.passage

    def __str__(self) -> str:
        """Return a sentence: where, from, to, energy, time."""
        what = KINDS[self.kind].name if self.kind in KINDS else "unstable"
        names = list(self.before.observables)[:_SHOWN]
        units = self.before.units

        def shown(name: str) -> str:
            old = show(self.before[name], units.get(name, ""), 5)
            if self.after is None:
                return f"{name} = {old}"
            return f"{name} {old} -> {show(self.after[name], units.get(name, ''), 5)}"

        changes = ", ".join(shown(n) for n in names)
        energy = f"; releases {self.energy:.6g} J" if self.energy is not None else ""
        late = f"; {self._late()}" if self.passage is not None else ""
        return f"{self.label} ({what}): {changes}{energy}; {self.message}{late}"

    def _late(self) -> str:
        """Return a clause: at which rate the jump is late by 1 % of the load."""
        rate, unit = self.slow(), self.before.units.get(self.parameter, "")
        return f"late by {show(0.01 * self.load, unit, 3)} under a load of {show(rate, unit, 3)}/s"


@dataclass(frozen=True, slots=True, repr=False)
class LoadPath(Tabular, Shown):
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
    problem: Model | None = field(repr=False, default=None)

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
        check_name(name)
        return np.concatenate([s[name] for s in self.segments])

    def _ipython_key_completions_(self) -> list[str]:
        """Return the names that [...] takes."""
        return self.segments[0].branch._ipython_key_completions_()

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

    @checked
    def jump(self, label: str) -> Jump:
        """Return the jump with a label such as "LP1"."""
        for j in self.jumps:
            if j.label == label:
                return j
        raise unknown_name("jump", label, [j.label for j in self.jumps])

    def _cells(self, degrees: bool) -> Iterable[Cells]:
        names = [*self.names, *(n for n in self.segments[0].branch.columns if n not in self.names)]
        return ((n, self.unit(n), self[n]) for n in names)

    def save(self, path: str | Path) -> Path:
        """Write the path to an HDF5 file (replacing it whole or not at all) and return the file's path."""
        return save_hdf5(path, self._write)

    def _write(self, f: h5py.File) -> None:
        Attributes(f).update(
            format="mjcont",
            format_version=FORMAT_VERSION,
            kind=KIND,
            name=self.name,
            vertices=json.dumps([dict(v) for v in self.vertices]),
            status=self.status,
            message=self.message,
            evaluations=self.evaluations,
        )
        write_model(f, self.problem)
        for i, s in enumerate(self.segments):
            g = f.create_group(f"segments/{i}")
            write_branch(s.branch, g, model=False)
            Attributes(g).update(direction=s.direction, leg=s.leg)
        for i, j in enumerate(self.jumps):
            g = f.create_group(f"jumps/{i}")
            Attributes(g).update(
                label=j.label, kind=j.kind, index=j.index, energy_note=j.energy_note, time=j.time, steps=j.steps,
                status=j.status, message=j.message, landed=j.after is not None,
            )
            if j.energy is not None:
                Attributes(g)["energy"] = j.energy
            if j.passage is not None:
                Attributes(g).update(parameter=j.parameter, load=j.load, passage=astuple(j.passage))
            g["states"] = j.states

    @property
    def axes(self) -> tuple[str, str]:
        """The columns that a picture shows unless told otherwise: the parameter, and an observable."""
        return self.names[0], next(iter(self.final.observables), self.names[0])

    def plot(self, x: str = "", y: str = "", **options: Any) -> Any:
        """Draw the path with arrows; by default an observable over the parameter. `options` as for `mjcont.plot`."""
        from mjcont.drawing.plotting import plot

        return plot(self, x=x, y=y, **options)

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


def read(f: h5py.File, problem: Model | None) -> LoadPath:
    """Return the load path in a file."""
    groups = [f[f"segments/{i}"] for i in range(len(f["segments"]))]
    segments = [
        Segment(read_branch(g, problem), int(Attributes(g)["direction"]), int(Attributes(g)["leg"])) for g in groups
    ]
    jumps = [_read_jump(f[f"jumps/{i}"], segments) for i in range(len(f["jumps"]) if "jumps" in f else 0)]
    a = Attributes(f)
    return LoadPath(
        str(a["name"]), json.loads(a["vertices"]), tuple(segments), tuple(jumps), str(a["status"]),
        str(a["message"]), int(a["evaluations"]), problem,
    )


def _read_jump(g: h5py.Group, segments: list[Segment]) -> Jump:
    a, index = Attributes(g), int(Attributes(g)["index"])
    rows = [(s, int(i)) for s in segments for i in s.rows()]
    before, at = rows[index]
    special = [p for p in before.branch.special_points if p.index == at]
    after = rows[index + 1] if a["landed"] and index + 1 < len(rows) else None
    return Jump(
        str(a["label"]), str(a["kind"]), special[0] if special else before.branch.row(at),
        after[0].branch.row(after[1]) if after else None, index,
        float(a["energy"]) if "energy" in a else None, str(a["energy_note"]), float(a["time"]), int(a["steps"]),
        str(a["status"]), str(a["message"]), g["states"][()], str(a.get("parameter", "")),
        float(a.get("load", math.nan)), Passage(*map(float, a["passage"])) if "passage" in a else None,
    )
