"""Modes and transfer functions in files.

Layout beside what `files` says (format version 3)::

    /                     attributes: format, format_version, kind "modes" or "transfer", notes (JSON), held (JSON), ...
    /point                the equilibrium: attributes stability, n_unstable, units (JSON), kind, label (empty where it
                          is not special); groups parameters and observables; state (nq,), eigenvalues/real and .../imag

    modes: /eigenvalues/real, /eigenvalues/imag (m,) 1/s; /shapes/real, /shapes/imag (m, nv); /growing, /neutral (m,)
        int8; /mass, /damping, /stiffness (nv, nv); /table/COLUMN (m,) as in CSV
    transfer: attributes input, outputs (JSON), units (JSON), stable; /frequencies (m,) Hz;
        /responses/real, /responses/imag (m, number of outputs), SI and radians
"""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np

from mjcont.outside.hdf5names import key
from mjcont.outside.hdf5text import Attributes, put_text
from mjcont.results.files import (
    FORMAT_VERSION,
    Unfit,
    frozen,
    read_complex,
    read_values,
    save_hdf5,
    write_complex,
    write_model,
    write_values,
)
from mjcont.results.linear.modes import Mode, Modes
from mjcont.results.linear.transfer import Transfer
from mjcont.results.model import Model, provenance
from mjcont.results.points import Point, SpecialPoint

MODES, TRANSFER = "modes", "transfer"


def save(result: Modes | Transfer, path: str | Path) -> Path:
    """Write modes or transfer functions as HDF5."""
    return save_hdf5(path, lambda f: _write(result, f))


def _write(result: Modes | Transfer, f: h5py.File) -> None:
    point = result.point
    kind = MODES if isinstance(result, Modes) else TRANSFER
    Attributes(f).update(
        format="mjcont", format_version=FORMAT_VERSION, kind=kind, name=point.model.name,
        notes=json.dumps(list(result.notes)), held=json.dumps(list(point.model.held)),
    )
    Attributes(f).update({f"provenance_{k}": v for k, v in provenance(point.model).items()})
    write_model(f, point.model)
    _write_point(point, f.create_group("point"))
    if isinstance(result, Modes):
        _write_modes(result, f)
    else:
        Attributes(f).update(input=result.input, outputs=json.dumps(list(result.outputs)), stable=result.stable,
                             units=json.dumps(dict(result.units)))
        f["frequencies"] = result.frequencies
        write_complex(f, "responses", result.responses)


def _write_modes(result: Modes, f: h5py.File) -> None:
    write_complex(f, "eigenvalues", result.eigenvalues)
    write_complex(f, "shapes", result.shapes)
    for name in ("growing", "neutral"):
        f[name] = np.array([getattr(m, name) for m in result], dtype=np.int8)
    f["mass"], f["damping"], f["stiffness"] = result.mass, result.damping, result.stiffness
    for name, unit, values in result._cells(False):
        place = f"table/{key(name)}"
        if any(isinstance(v, str) for v in values):
            put_text(f, place, [str(v) for v in values])
        else:
            f[place] = np.asarray(values)
        Attributes(f[place])["unit"] = unit


def _write_point(point: Point, g: h5py.Group) -> None:
    Attributes(g).update(stability=point.stability, n_unstable=point.n_unstable, units=json.dumps(dict(point.units)))
    Attributes(g).update(kind=getattr(point, "kind", ""), label=getattr(point, "label", ""))
    write_values(g, "parameters", point.parameters)
    write_values(g, "observables", point.observables)
    g["state"] = point.state
    write_complex(g, "eigenvalues", point.eigenvalues)


def _read_point(g: h5py.Group, problem: Model | None) -> Point:
    a = Attributes(g)
    common = (
        read_values(g, "parameters"), read_values(g, "observables"), frozen(g["state"][()]),
        read_complex(g["eigenvalues"]), str(a["stability"]), int(a["n_unstable"]), problem, json.loads(a["units"]),
    )
    return SpecialPoint(*common, kind=str(a["kind"]), label=str(a["label"])) if a["kind"] else Point(*common)


def _begun(f: h5py.File, problem: Model | None) -> tuple[Point, tuple[str, ...]]:
    """Return the equilibrium and the notes of a file."""
    a = Attributes(f)
    if problem is None:
        raise Unfit(": it does not carry its model, which its modes need: mc.load(path, problem=...)")
    held = json.loads(a["held"])
    problem = problem.holding(held) if held else problem
    return _read_point(f["point"], problem), tuple(json.loads(a["notes"]))


def read_modes(f: h5py.File, problem: Model | None) -> Modes:
    """Return the modes in a file."""
    point, notes = _begun(f, problem)
    values, shapes = read_complex(f["eigenvalues"]), read_complex(f["shapes"])
    each = zip(values.tolist(), shapes, f["growing"][()], f["neutral"][()], strict=True)
    found = tuple(Mode(i, s, frozen(v), bool(g), bool(n), point) for i, (s, v, g, n) in enumerate(each, 1))
    mass, damping, stiffness = (frozen(f[name][()]) for name in ("mass", "damping", "stiffness"))
    return Modes(point, found, mass, damping, stiffness, notes)


def read_transfer(f: h5py.File, problem: Model | None) -> Transfer:
    """Return the transfer functions in a file."""
    point, notes = _begun(f, problem)
    a, responses, hertz = Attributes(f), read_complex(f["responses"]), frozen(f["frequencies"][()])
    outputs = tuple(json.loads(a["outputs"]))
    if responses.shape != (len(hertz), len(outputs)):
        raise ValueError("its frequencies and responses do not fit each other")
    return Transfer(point, str(a["input"]), outputs, hertz, responses, bool(a["stable"]), json.loads(a["units"]), notes)
