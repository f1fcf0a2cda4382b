"""Files beside an MJCF that are not there: what only shows them is left out with a note, what needs them is refused.

A mesh, height field, texture or skin that is drawn changes no equilibrium. A geom that collides is left out, too, and
the note says so, and so is the mass of a part fixed to another; a geom that gives a jointed body its mass cannot be.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import mujoco

from mjcont.errors import ModelError

NOTES = "mjcont/notes"
_BETWEEN = " | "
_SHOWN = 3


def drop_missing(spec: mujoco.MjSpec, folder: Path) -> tuple[str, ...]:
    """Take everything that needs a missing file out of a spec, and return what that means, one sentence each.

    Parameters
    ----------
    spec : mujoco.MjSpec
    folder : Path
        In which the model's relative paths are looked up.

    Raises
    ------
    ModelError
        If a body with joints takes its mass from such a geom.
    """
    meshes, heights, skins = (_missing(spec, e, folder, "meshdir") for e in (spec.meshes, spec.hfields, spec.skins))
    textures = _missing(spec, spec.textures, folder, "texturedir")
    shapes = {e.name: file for e, file in (*meshes, *heights)}
    geoms = [g for g in spec.geoms if (g.meshname or g.hfieldname) in shapes]
    weighing = [g for g in geoms if _weighs(g)]
    _refuse_lost_mass({g.parent.name: shapes[g.meshname or g.hfieldname] for g in weighing if len(g.parent.joints)})
    notes = _drop_geoms(spec, geoms, shapes) + _drop_looks(spec, textures, skins)
    lighter = list(dict.fromkeys(g.parent.name or "a body" for g in weighing))
    if lighter:
        notes.append(f"the mass of these geoms is not there: {_listed(lighter)}; give every such body an <inertial>")
    for element, _ in (*meshes, *heights, *skins, *textures):
        spec.delete(element)
    return tuple(notes)


def files(spec: mujoco.MjSpec, folder: Path) -> list[Path]:
    """Return the files of a spec's meshes, height fields, skins and textures, where they are looked up."""
    elements = [(e, "meshdir") for e in (*spec.meshes, *spec.hfields, *spec.skins)]
    elements += [(e, "texturedir") for e in spec.textures]
    return [place.resolve() for e, directory in elements for place in _places(spec, e, folder, directory).values()]


def anchor_files(spec: mujoco.MjSpec, folder: Path) -> bool:
    """Make the paths to a spec's files absolute, so that its text is understood anywhere; whether there are any."""
    elements = [(e, "meshdir") for e in (*spec.meshes, *spec.hfields, *spec.skins)]
    elements += [(e, "texturedir") for e in spec.textures]
    count = 0
    for element, directory in elements:
        places = _places(spec, element, folder, directory)
        if element.file in places:
            element.file = str(places[element.file])
        for i, file in enumerate(getattr(element, "cubefiles", ())):
            if file in places:
                element.cubefiles[i] = str(places[file])
        count += len(places)
    if count:
        spec.strippath = False
    return count > 0


def write_notes(spec: mujoco.MjSpec, notes: Sequence[str]) -> None:
    """Keep notes in the model's own text, where results carry them."""
    for old in [t for t in spec.texts if t.name == NOTES]:
        spec.delete(old)
    if notes:
        spec.add_text(name=NOTES, data=_BETWEEN.join(notes))


def read_notes(spec: mujoco.MjSpec) -> tuple[str, ...]:
    """Return the notes that `write_notes` wrote."""
    return tuple(note for t in spec.texts if t.name == NOTES for note in t.data.split(_BETWEEN))


def _places(spec: mujoco.MjSpec, element: Any, folder: Path, directory: str) -> dict[str, Path]:
    """Return where the files of an element are looked up; a resource provider's (`name:path`) are not the disk's."""
    base = folder / getattr(element.compiler, directory)
    files = [f for f in (element.file, *getattr(element, "cubefiles", ())) if f and not re.match(r"[A-Za-z]{2,}:", f)]
    return {f: base / (Path(f).name if spec.strippath else f) for f in files}


def _missing(
    spec: mujoco.MjSpec, elements: Iterable[Any], folder: Path, directory: str
) -> list[tuple[Any, str]]:
    """Return the elements that need a file that is not there, with its name."""
    found = []
    for element in elements:
        gone = [place.name for place in _places(spec, element, folder, directory).values() if not place.is_file()]
        if gone:
            found.append((element, gone[0]))
    return found


def _refuse_lost_mass(files: dict[str, str]) -> None:
    if files:
        raise ModelError(
            f"{'a body takes its' if len(files) == 1 else 'bodies take their'} mass from geoms whose files are not "
            f"there: {', '.join(f'{body} ({file})' for body, file in files.items())}. Put the files where the model "
            "looks for them, or give every such body an <inertial>."
        )


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"of {', '.join(names[:_SHOWN])}{more}"


def _weighs(geom: Any) -> bool:
    """Whether the mass of a body that moves depends on a geom."""
    body, compiler = geom.parent, geom.compiler
    low, high = compiler.inertiagrouprange
    always = compiler.inertiafromgeom == mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE
    massive = geom.density > 0 if math.isnan(geom.mass) else geom.mass > 0
    return massive and low <= geom.group <= high and (always or not body.explicitinertial) and _moves(body)


def _moves(body: Any) -> bool:
    while body is not None:
        if len(body.joints):
            return True
        body = body.parent
    return False


def _drop_geoms(spec: mujoco.MjSpec, geoms: Sequence[Any], shapes: dict[str, str]) -> list[str]:
    names = {g.name for g in geoms if g.name}
    pairs = [p for p in spec.pairs if {p.geomname1, p.geomname2} & names]
    paired = {name for p in pairs for name in (p.geomname1, p.geomname2)}
    colliding = [g for g in geoms if g.contype or g.conaffinity or g.name in paired]
    gone = {(mujoco.mjtObj.mjOBJ_GEOM, n) for n in names} | {(mujoco.mjtObj.mjOBJ_MESH, n) for n in shapes}
    sensors = [s for s in spec.sensors if {(s.objtype, s.objname), (s.reftype, s.refname)} & gone]
    notes = []
    if shapes:
        notes.append(f"{_not_there(shapes.values())}; {_count(geoms, 'geom')} left out")
    if colliding and not spec.option.disableflags & mujoco.mjtDisableBit.mjDSBL_CONTACT:
        where = sorted({g.name or f"one of body '{g.parent.name}'" for g in colliding})
        notes.append("contacts of these geoms are not there: " + _some(where))
    if sensors:
        notes.append("sensors of geoms left out are not there: " + _some([s.name or s.objname for s in sensors]))
    for element in (*sensors, *pairs, *geoms):
        spec.delete(element)
    return notes


def _drop_looks(spec: mujoco.MjSpec, textures: list[tuple[Any, str]], skins: list[tuple[Any, str]]) -> list[str]:
    names = {e.name for e, _ in textures}
    for material in spec.materials:
        for i, name in enumerate(material.textures):
            if name in names:
                material.textures[i] = ""
    for light in spec.lights:
        if light.texture in names:
            light.texture = ""
    ends = ((textures, "what they cover is drawn plain"), (skins, f"{_count(skins, 'skin')} left out"))
    return [f"{_not_there(file for _, file in gone)}; {end}" for gone, end in ends if gone]


def _not_there(files: Iterable[str]) -> str:
    names = sorted(set(files))
    return f"{_count(names, 'file')} not there: {_some(names)}"


def _count(items: Sequence[Any], what: str) -> str:
    return f"{len(items)} {what}{' is' if len(items) == 1 else 's are'}"


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more
