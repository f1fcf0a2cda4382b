"""The document: all that a page shows, plain data that JSON carries, with a version of its own.

::

    format      "mjcont explorer"
    version     1; a page carries the script that draws it, so that what an older page shows stays in it
    title, made the model's name, and the versions of what computed it
    scene       shapes of the model (see `scene`); null for a plain vector field
    quantities  by name: label (parts with what stands below and behind), unit and scale as shown, role
    study       TOML that reproduces it; may be empty
    files       texts of the files that the study names, by name: its model
    sliders     the model's own parameters, their values and ranges
    keyframes   names of the model's poses
    curves      see `curves`; each `parent` is the `id` of another

Arrays are `{"dtype", "shape", "data"}` (see `arrays`), in SI and radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from mjcont.drawing.axes import symbol
from mjcont.errors import MjcontError
from mjcont.explorer.arrays import indices, packed, plain, unpacked
from mjcont.explorer.curves import Curve, Stage, curve_of
from mjcont.results.branch import Branch, Diagram
from mjcont.results.model import Model, provenance
from mjcont.results.units import displayed, sized

FORMAT, VERSION = "mjcont explorer", 1
# of a name as it is shown
_LONGEST = 60


def document_of(
    results: Mapping[str, Any],
    *,
    title: str = "",
    study: str = "",
    files: Mapping[str, str] | None = None,
    parents: Mapping[str, str] | None = None,
    spectra: bool = True,
) -> dict[str, Any]:
    """Return results by name as a document.

    Parameters
    ----------
    results : mapping of name to result
        As `curve_of` takes them; of a Diagram each branch is a curve.
    title : str
        Default the first result's model.
    study : str
        TOML that reproduces them.
    files : mapping of name to text, optional
        The files that the study names.
    parents : mapping of name to name, optional
        Which curve each began on; default the first branch of the same model for what begins on one.
    spectra : bool
        Whether eigenvalues that are not known are computed.

    Raises
    ------
    MjcontError
        If there is no result, the explorer shows none of its kind, or they are of several models.
    """
    flat = dict(_flat(results))
    if not flat:
        raise MjcontError("a page needs at least one result")
    _refuse_mixed(flat)
    stage = Stage(next((p for p in map(problem_of, flat.values()) if p is not None), None))
    given = parents or {}
    curves: list[Curve] = []
    for name, result in flat.items():
        curves.append(curve_of(result, name, stage, given.get(name) or _parent(result, flat), spectra=spectra))
    return assembled(stage, curves, title=title or next((c["model"] for c in curves if c["model"]), next(iter(flat))),
                     study=study, files=files)


def assembled(
    stage: Stage, curves: Sequence[Curve], *, title: str, study: str, files: Mapping[str, str] | None = None,
    values: Mapping[str, float] | None = None,
) -> dict[str, Any]:
    """Return curves as a document; `values` are those of the model's parameters, default the first curve's."""
    return {
        "format": FORMAT,
        "version": VERSION,
        "title": title,
        "made": provenance(None),
        "scene": scene_of(stage),
        "quantities": quantities_of(curves),
        "study": study,
        "files": dict(files or {}),
        "sliders": sliders_of(stage.problem, curves, values),
        "keyframes": [] if stage.problem is None else [*stage.problem.keyframes],
        "curves": list(curves),
    }


def _flat(results: Mapping[str, Any]) -> Iterable[tuple[str, Any]]:
    for name, result in results.items():
        if isinstance(result, Diagram):
            yield from ((f"{name}_{i}", b) for i, b in enumerate(result.branches, 1))
        else:
            yield name, result


def _refuse_mixed(results: Mapping[str, Any]) -> None:
    """Raise an error unless all results are of one model."""
    (first, one), *others = results.items()
    for name, other in others:
        texts = [getattr(problem_of(r), "mjcf", None) for r in (one, other)]
        models = [str(getattr(problem_of(r), "name", "") or getattr(r, "name", "")) for r in (one, other)]
        told = texts if all(texts) else models  # a field has no text, and some results do not know their model
        if all(told) and told[0] != told[1]:
            alike = ", another version of it" if models[0] == models[1] else ""
            raise MjcontError(f"a page shows one model, but '{first}' is of {models[0]} and '{name}' of "
                              f"{models[1]}{alike}: write a page for each")


def problem_of(result: Any) -> Model | None:
    """Return the model of a result, None if it was loaded without."""
    for owner in (result, getattr(result, "point", None), *getattr(result, "barriers", ())[:1]):
        found = getattr(owner, "problem", None) or getattr(getattr(owner, "rest", None), "problem", None)
        if found is not None:
            return found
    return None


def _parent(result: Any, results: Mapping[str, Any]) -> str | None:
    """Return the first curve of equilibria, for what is none itself."""
    plainly = (n for n, r in results.items() if isinstance(r, Branch) and r.rated and r is not result)
    return None if isinstance(result, Branch) and result.kind == "equilibria" else next(plainly, None)


def scene_of(stage: Stage) -> dict[str, Any] | None:
    """Return the shapes of a stage's model as plain data."""
    if stage.scene is None:
        return None
    found = stage.scene.described()
    meshes = [{"vertices": packed(m.vertices, "f4"), "faces": indices(m.faces)} for m in found["meshes"]]
    pose = {"bodies": packed(found["pose"].bodies, "f4"), "tendons": packed(found["pose"].tendons, "f4")}
    return {**plain({k: v for k, v in found.items() if k not in ("meshes", "pose")}), "meshes": meshes, "pose": pose}


def quantities_of(curves: Sequence[Curve]) -> dict[str, Any]:
    """Return how each quantity of curves is called and shown: degrees, and kN, MN or mm where numbers ask for them."""
    units: dict[str, tuple[str, str]] = {}
    largest: dict[str, float] = {}
    for curve in curves:
        motion = curve["orbit"] or {"columns": {}, "units": {}}
        for name, unit in {**motion["units"], **curve["units"]}.items():
            units.setdefault(name, (unit, curve["roles"].get(name, "parameter")))
        for name, column in [*curve["columns"].items(), *motion["columns"].items()]:
            values = np.abs(unpacked(column))
            largest[name] = max(largest.get(name, 0.0), float(np.max(values[np.isfinite(values)], initial=0.0)))
    for curve in curves:
        for name, value in curve["fixed"].items():
            largest.setdefault(name, abs(value or 0.0))
            units.setdefault(name, (curve["fixed_units"].get(name, ""), "parameter"))
    return {name: quantity(name, unit, role, largest.get(name, 0.0)) for name, (unit, role) in units.items()}


def quantity(name: str, unit: str, role: str, largest: float) -> dict[str, Any]:
    """Return how a quantity is called and shown."""
    shown, factor = displayed(unit)
    shown, larger = sized(shown, largest) if shown == unit else (shown, 1.0)
    tidy = shown.replace("*", " ") if shown != "1" else ""
    half = (_LONGEST - 1) // 2
    called = name if len(name) <= _LONGEST else f"{name[:half]}…{name[-half:]}"
    return {"label": [list(part) for part in symbol(called)], "unit": "°" if tidy == "deg" else tidy,
            "scale": factor * larger, "role": role, "si": unit}


def sliders_of(
    problem: Model | None, curves: Sequence[Curve], values: Mapping[str, float] | None = None
) -> list[dict[str, Any]]:
    """Return the parameters of a model that have a range, at the values given, or those of the first curve."""
    if problem is None:
        return []
    fixed: dict[str, float] = next((c["fixed"] for c in curves if c["fixed"]), {})
    free = {n for c in curves for n in c["free"]}
    found = []
    for p in problem.parameters.values():
        low, high = max(p.bounds[0], p.hard_bounds[0]), min(p.bounds[1], p.hard_bounds[1])
        if p.kind == "switch" or not (math.isfinite(low) and math.isfinite(high) and low < high):
            continue
        value = (values or fixed).get(p.name, p.value)
        entry = quantity(p.name, p.unit, "parameter", abs(value))
        found.append({"name": p.name, "unit": p.unit, "value": value, "lower": low, "upper": high,
                      "shown": entry, "free": p.name in free})
    return found
