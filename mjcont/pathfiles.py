"""Load paths in HDF5 files.

Layout (format version 2)::

    /                 attributes: format, format_version, kind "load path", name, vertices (JSON), status, message
    /model            the MJCF text
    /segments/I       a branch (see `storage`), attributes direction, leg
    /jumps/I          attributes: label, kind, index, energy (absent if not defined), energy_note, time, steps, ...
    /jumps/I/states   (m, nq) samples of the motion; the points on both sides are rows of the segments
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py

from mjcont.pathresults import Jump, LoadPath, Segment
from mjcont.storage import FORMAT_VERSION, read_branch, save_hdf5, write_branch


def save_path(path: LoadPath, file: str | Path) -> Path:
    """Write a load path as HDF5."""
    return save_hdf5(file, lambda f: _write(path, f))


def _write(path: LoadPath, f: h5py.File) -> None:
    f.attrs.update(
        format="mjcont",
        format_version=FORMAT_VERSION,
        kind="load path",
        name=path.name,
        vertices=json.dumps([dict(v) for v in path.vertices]),
        status=path.status,
        message=path.message,
        evaluations=path.evaluations,
        declared=json.dumps(getattr(path.problem, "declared", {})),
    )
    mjcf = getattr(path.problem, "mjcf", None)
    if mjcf is not None:
        f["model"] = mjcf
    for i, s in enumerate(path.segments):
        g = f.create_group(f"segments/{i}")
        write_branch(s.branch, g, model=False)
        g.attrs.update(direction=s.direction, leg=s.leg)
    for i, j in enumerate(path.jumps):
        g = f.create_group(f"jumps/{i}")
        g.attrs.update(
            label=j.label, kind=j.kind, index=j.index, energy_note=j.energy_note, time=j.time, steps=j.steps,
            status=j.status, message=j.message, landed=j.after is not None,
        )
        if j.energy is not None:
            g.attrs["energy"] = j.energy
        g["states"] = j.states


def read_path(f: h5py.File, problem: Any) -> LoadPath:
    """Return the load path in a file."""
    groups = [f[f"segments/{i}"] for i in range(len(f["segments"]))]
    segments = [
        Segment(read_branch(g, problem), int(g.attrs["direction"]), int(g.attrs["leg"])) for g in groups
    ]
    jumps = [_read_jump(f[f"jumps/{i}"], segments) for i in range(len(f["jumps"]) if "jumps" in f else 0)]
    a = f.attrs
    return LoadPath(
        str(a["name"]), json.loads(a["vertices"]), tuple(segments), tuple(jumps), str(a["status"]),
        str(a["message"]), int(a["evaluations"]), problem,
    )


def _read_jump(g: h5py.Group, segments: list[Segment]) -> Jump:
    a, index = g.attrs, int(g.attrs["index"])
    rows = [(s, int(i)) for s in segments for i in s.rows()]
    before, at = rows[index]
    special = [p for p in before.branch.special_points if p.index == at]
    after = rows[index + 1] if a["landed"] and index + 1 < len(rows) else None
    return Jump(
        str(a["label"]), str(a["kind"]), special[0] if special else before.branch.row(at),
        after[0].branch.row(after[1]) if after else None, index,
        float(a["energy"]) if "energy" in a else None, str(a["energy_note"]), float(a["time"]), int(a["steps"]),
        str(a["status"]), str(a["message"]), g["states"][()],
    )
