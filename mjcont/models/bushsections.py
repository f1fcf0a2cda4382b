"""The sections of an MJCF text that go with its bushes: default classes, keyframes, declared parameters."""

from __future__ import annotations

import fnmatch
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import mujoco

from mjcont.models import loading
from mjcont.models.mjcf import Document, elements, number

SLIDE_CLASS, BUSH_CLASS, TURN_CLASS = "bush_slide", "bush", "bush_turn"
# what a model's own defaults must not do to a bush
_PLAIN_JOINT = {
    "ref": "0",
    "springref": "0",
    "armature": "0",
    "frictionloss": "0",
    "limited": "false",
    "actuatorfrclimited": "false",
    "springdamper": "0 0",
    "pos": "0 0 0",
}
_PLAIN_ACTUATOR = {"dyntype": "none", "ctrllimited": "false", "forcelimited": "false", "actlimited": "false"}


@dataclass(frozen=True, slots=True)
class Made:
    """Names of the elements that were added."""

    slides: tuple[str, ...]
    bushes: tuple[str, ...]
    turns: tuple[str, ...]


def add_classes(document: Document, made: Made, constants: tuple[float, float], turning: tuple[float, ...]) -> None:
    """Add default classes that say all there is to a bush, whatever the model's own defaults are."""
    document.section("default", before="worldbody")
    main = document.sections("default")[0]
    own = {e.tag: set(e.attrib) for e in elements(main) if e.tag != "default"}
    joint = {k: v for k, v in _PLAIN_JOINT.items() if k in own.get("joint", set())}
    others = {"joint", "geom", "site", "mesh", "material", "camera", "light", "pair", "equality", "tendon"}
    plain = _PLAIN_ACTUATOR if set(own) - others else {}
    if made.slides:
        group = document.add(main, "default", {"class": free_class(document, SLIDE_CLASS)})
        stiffness, damping = (number(c) for c in constants)
        document.add(group, "joint", {"type": "slide", "stiffness": stiffness, "damping": damping} | joint)
    for name, added, (k, c) in ((BUSH_CLASS, made.bushes, constants), (TURN_CLASS, made.turns, turning)):
        if added:
            group = document.add(main, "default", {"class": free_class(document, name)})
            bias = {
                "gaintype": "fixed",
                "gainprm": "0",
                "biastype": "affine",
                "biasprm": f"0 {number(-k)} {number(-c)}",
            }
            document.add(group, "general", bias | plain)


def free_class(document: Document, name: str) -> str:
    """Return the name, or with a number where the model has a class of that name."""
    taken = {d.get("class") for d in document.root.iter("default")}
    return next(n for n in (name, *(f"{name}_{i}" for i in range(2, 1000))) if n not in taken)


def actuator_names(model: mujoco.MjModel) -> list[str]:
    """Return the names of all actuators, empty where unnamed."""
    return [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_ACTUATOR, a) or "" for a in range(model.nactuator)]


def rewrite_keys(document: Document, folder: Path | None, model: mujoco.MjModel, made: Made) -> None:
    """Give every keyframe zeros for the new slides and controls; a stale one compiles onto the wrong joints."""
    keys = [k for section in document.sections("keyframe") for k in section.findall("key")]
    stated = [(k.attrib.pop("qpos", None), k.attrib.pop("ctrl", None)) for k in keys]
    new = loading.compile_spec(loading.parse_present(str(document), folder, "with bushes")[0])
    kept = [j for j in range(new.njnt) if new.joint(j).name not in made.slides]
    ends = [*model.jnt_qposadr, model.nq]
    for key, (qpos, ctrl) in zip(keys, stated, strict=True):
        if qpos is not None:
            old, merged = qpos.split(), ["0"] * new.nq
            for i, j in enumerate(kept):
                start, width = int(new.jnt_qposadr[j]), int(ends[i + 1] - ends[i])
                merged[start : start + width] = old[ends[i] : ends[i + 1]]
            key.set("qpos", " ".join(merged))
        if ctrl is not None:
            key.set("ctrl", " ".join([*ctrl.split(), *["0"] * (new.nu - model.nu)]))


def declare(document: Document, new: mujoco.MjModel, made: Made) -> None:
    """Declare the parameters that set all bushes at once, under names that are free."""
    custom = document.section("custom", before="default")
    taken = {e.get("name") for section in document.sections("custom") for e in elements(section)}
    joints = _covering([new.joint(j).name for j in range(new.njnt)], made.slides, "bush_*_?")
    actuators = actuator_names(new)
    bushes = _covering(actuators, made.bushes, "bush_*_?")
    turns = _covering(actuators, made.turns, "bush_*_r?")
    stiffnesses = [f"joint:{p}.stiffness" for p in joints] + [f"actuator:{p}.biasprm[1]*-1" for p in bushes]
    dampings = [f"joint:{p}.damping" for p in joints] + [f"actuator:{p}.biasprm[2]*-1" for p in bushes]
    table = {
        "k_bush": ("unit=N/m bounds=1,1e12", stiffnesses),
        "c_bush": ("unit=N*s/m bounds=0,1e6", dampings),
        "k_turn": ("unit=N*m/rad bounds=1,1e12", [f"actuator:{p}.biasprm[1]*-1" for p in turns]),
        "c_turn": ("unit=N*m*s/rad bounds=0,1e6", [f"actuator:{p}.biasprm[2]*-1" for p in turns]),
    }
    document.comment(custom, "elastic pins, in place of rigid ones: stiffness and damping of all their bushes")
    for name, (about, paths) in table.items():
        if paths:
            free = next(n for n in (name, *(f"{name}_{i}" for i in range(2, 1000))) if f"mjcont/{n}" not in taken)
            document.add(custom, "text", {"name": f"mjcont/{free}", "data": f"{about} : {' '.join(paths)}"})


def _covering(every: Sequence[str], wanted: Sequence[str], pattern: str) -> list[str]:
    """Return the pattern if it matches the wanted names alone, else the names."""
    if not wanted:
        return []
    matched = {n for n in every if fnmatch.fnmatchcase(n, pattern)}
    return [pattern] if matched == set(wanted) else list(wanted)
