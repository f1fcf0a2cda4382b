"""Rigid pins and loop closures of an MJCF model -> elastic bushes, so that a mechanism becomes an ODE.

A hinge or ball joint of the tree gets slides with stiffness k and damping c before it; a connect or weld becomes one
`general` actuator an axis between two sites, with affine bias: force -k gap - c (rate of the gap). Poses stay as they
are: in an assembled pose every bush is relaxed. The text itself is edited (`mjcf`), so that it stays readable.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np

from mjcont.arguments import checked
from mjcont.errors import ModelError, ModelWarning, ParameterError, unknown_name, warn
from mjcont.models import assets, loading
from mjcont.models.bushsections import (
    BUSH_CLASS,
    SLIDE_CLASS,
    TURN_CLASS,
    Made,
    actuator_names,
    add_classes,
    declare,
    free_class,
    rewrite_keys,
)
from mjcont.models.equalities import equality_name, springs_of
from mjcont.models.impedance import impedance
from mjcont.models.mjcf import Document, Element, elements, exact_text, included, numbers
from mjcont.models.quiet import quiet_data
from mjcont.models.states import keyframes
from mjcont.models.topology import Closure, Frame, constraint_closures, gap, plane_normal

FRAMES = ("world", "parent")
_JOINT = mujoco.mjtJoint


@dataclass(frozen=True, slots=True)
class Axis:
    """A direction in which a bush gives way: the end of its element's name, and a unit vector in the ground's frame."""

    suffix: str
    vector: np.ndarray


class _NotInText(Exception):
    """An element that the compiled model has and the text has not: made by include, replicate or attach."""


@checked
def add_bushes(
    model: str | Path | mujoco.MjSpec,
    joints: Sequence[str] | None = None,
    connects: Sequence[str] | None = None,
    stiffness: float = 1e6,
    damping: float | None = None,
    frame: str = "world",
) -> mujoco.MjSpec:
    """Replace rigid pins by elastic ones and return the new model's spec; see `bushed_xml`."""
    text = bushed_xml(model, joints, connects, stiffness, damping, frame)
    spec, notes = loading.parse_present(text, _source(model)[1], "with bushes")
    return _noted(spec, notes)


@checked
def bushed_xml(
    model: str | Path | mujoco.MjSpec,
    joints: Sequence[str] | None = None,
    connects: Sequence[str] | None = None,
    stiffness: float = 1e6,
    damping: float | None = None,
    frame: str = "world",
) -> str:
    """Replace rigid pins by elastic ones and return the new model's MJCF.

    Parameters
    ----------
    model : path, shipped model's name, XML text, or mujoco.MjSpec
    joints : sequence of str, optional
        Hinge and ball joints of the tree to make elastic; default none.
    connects : sequence of str, optional
        Connect and weld constraints to replace; default all that are active, as an ODE needs. An unnamed one is
        called equality0, equality1, ... by its place.
    stiffness : float
        Of every bush, in N/m; for the rotations of a weld the same number in N m/rad times its torquescale squared.
    damping : float, optional
        In N s/m; default about critical for the lightest pair of bodies.
    frame : {"world", "parent"}
        Whether axes are parallel to the ground's or to the parent body's in the pose qpos0. They turn with the parent
        body (a constraint's second) either way; with equal stiffness along all axes the forces are the same.

    Returns
    -------
    str
        The MJCF, with parameters k_bush and c_bush (k_turn and c_turn for welds). What names files that are not
        there stays in it as it is written.

    Raises
    ------
    MjcontError
        For a name that the model has not, a joint or constraint that cannot be replaced, a bad option. A constraint
        that is open at qpos0 or at a keyframe gives a UserWarning, a file that is not there a ModelWarning.
    """
    if frame not in FRAMES:
        raise unknown_name("frame", frame, FRAMES)
    if not (math.isfinite(stiffness) and stiffness > 0 and (damping is None or 0 <= damping < math.inf)):
        raise ParameterError("the bushes' stiffness must be a positive number, their damping not negative")
    text, folder = _source(model)
    spec, compiled, _ = _present(text, folder, "to be given bushes")
    pins = [_joint(compiled, name) for name in joints or ()]
    closures = _chosen(compiled, connects)
    if not pins and not closures:
        raise ModelError("nothing to make elastic: the model has no active connect or weld, and no joint was named")
    if damping is None:
        damping = _default_damping(compiled, pins, closures, stiffness)
    constants = (float(stiffness), float(damping))
    for closure in closures:
        _warn_if_open(compiled, closure)
    try:
        edited = _edit(Document(text), folder, compiled, pins, closures, constants, frame)
    except (_NotInText, ElementTree.ParseError):
        edited = _edit(Document(exact_text(spec)), folder, compiled, pins, closures, constants, frame)
    return str(edited)


@checked
def set_constraint_stiffness(
    model: str | Path | mujoco.MjSpec,
    stiffness: float = 1e6,
    equalities: Sequence[str] | None = None,
    damping_ratio: float = 1.0,
) -> mujoco.MjSpec:
    """Return the model's spec with equality constraints that are springs of one stiffness, whatever their gap.

    Nothing is replaced: solref and solimp alone are set. `equality:NAME.stiffness` is then a parameter.

    Parameters
    ----------
    model : path, shipped model's name, XML text, or mujoco.MjSpec
    stiffness : float
        In N/m (for a weld of its translation), or N*m/rad where the constraint's error is an angle.
    equalities : sequence of str, optional
        Names of equalities; default every active connect and weld.
    damping_ratio : float, optional
        1 is critical for the bodies that the constraint joins.

    Raises
    ------
    MjcontError
        For a name that the model has not, or numbers that are not positive.
    """
    if not (math.isfinite(stiffness) and stiffness > 0 and 0 <= damping_ratio < math.inf):
        raise ParameterError("a constraint's stiffness must be a positive number, its damping ratio not negative")
    spec, compiled, notes = _present(*_source(model), "to be given stiffness")
    names = {equality_name(compiled, e): e for e in range(compiled.neq)}
    if equalities is None:
        equalities = [c.name for c in constraint_closures(compiled)]
    if not equalities:
        raise ModelError("nothing to give stiffness: the model has no active connect or weld, and no name was given")
    for name in equalities:
        if name not in names:
            raise unknown_name("equality", name, names)
        springs = springs_of(compiled, names[name])
        if not springs or springs[0].depends_on_pose:
            raise ModelError(f"equality '{name}' has no stiffness of its own: flex equalities and diagexact have none")
        d = impedance(springs[0].solimp, 0.0)
        direct = stiffness * springs[0].weight * (1.0 - d)
        element = spec.equalities[names[name]]
        element.solref = [-direct, -2.0 * damping_ratio * math.sqrt(direct)]
        element.solimp = [d, d, *springs[0].solimp[2:]]
    return _noted(spec, notes)


def _source(model: str | Path | mujoco.MjSpec) -> tuple[str, Path | None]:
    """Return a model's text, with the texts that it includes in their places, and its folder."""
    if not isinstance(model, mujoco.MjSpec):
        text, folder = loading.read_source(model)
        return (included(text, folder) if folder is not None else text), folder
    folder, spec = Path(model.modelfiledir) if model.modelfiledir else None, model.copy()
    assets.drop_missing(spec, (folder or Path()).resolve())
    return exact_text(spec), folder


def _present(
    text: str, folder: Path | None, label: str
) -> tuple[mujoco.MjSpec, mujoco.MjModel, tuple[str, ...]]:
    """Return the spec of a text without what needs missing files, compiled, and what is missing, of which it warns."""
    spec, notes = loading.parse_present(text, folder, label)
    compiled = loading.compile_spec(spec)
    for note in notes:
        warn(note, ModelWarning)
    return spec, compiled, notes


def _noted(spec: mujoco.MjSpec, notes: Sequence[str]) -> mujoco.MjSpec:
    """Return a spec that keeps notes beside those that it has."""
    assets.write_notes(spec, [*assets.read_notes(spec), *notes])
    return spec


# -- what to replace --------------------------------------------------------------------------------------------


def _joint(model: mujoco.MjModel, name: str) -> int:
    names = {model.joint(j).name: j for j in range(model.njnt) if model.joint(j).name}
    if name not in names:
        raise unknown_name("joint", name, names)
    if _JOINT(model.jnt_type[names[name]]) not in (_JOINT.mjJNT_HINGE, _JOINT.mjJNT_BALL):
        raise ModelError(f"joint '{name}' is neither a hinge nor a ball joint: only those can be made elastic")
    return names[name]


def _chosen(model: mujoco.MjModel, connects: Sequence[str] | None) -> list[Closure]:
    active = {c.name: c for c in constraint_closures(model)}
    if connects is None:
        return list(active.values())
    for name in connects:
        if name not in active:
            every = [equality_name(model, e) for e in range(model.neq)]
            if name in every:
                raise ModelError(f"equality '{name}' is not an active connect or weld: only those can be made elastic")
            raise unknown_name("connect or weld", name, active)
    return [active[name] for name in connects]


def _default_damping(model: mujoco.MjModel, pins: list[int], closures: list[Closure], stiffness: float) -> float:
    """Return sqrt(k m) for the lightest pair of bodies, to two digits."""
    pairs = [(model.jnt_bodyid[j], model.body_parentid[model.jnt_bodyid[j]]) for j in pins]
    pairs += [(c.frames[0].body, c.frames[1].body) for c in closures]
    weight = max(float(model.body_invweight0[list(pair), 0].sum()) for pair in pairs)
    return float(f"{math.sqrt(stiffness / weight):.2g}") if weight > 0 else 1e-3 * stiffness


def _warn_if_open(model: mujoco.MjModel, closure: Closure) -> None:
    """Say where a closure is open: its bush will be loaded there."""
    small = 1e-6 * max(float(model.stat.extent), 1e-3)
    poses = {"qpos0": None, **{f"keyframe '{name}'": q for name, q in keyframes(model).items()}}
    found = [
        f"by {gap(model, closure, q):.3g} m at {name}" for name, q in poses.items() if gap(model, closure, q) > small
    ]
    if found:
        between = closure.frames[0].site < 0
        why = (
            " A constraint between bodies takes its second point at qpos0: is the model assembled there?"
            if between
            else ""
        )
        warn(f"{closure.kind} '{closure.name}' is open {', '.join(found)}.{why}", UserWarning)


def _axes(basis: np.ndarray, normal: np.ndarray | None) -> tuple[list[Axis], list[Axis]]:
    """Return the axes of translation and of rotation along a basis (columns): 2 + 1 in a plane, 3 + 3 in space."""
    whole = [Axis(s, basis[:, k]) for k, s in enumerate("xyz")]
    if normal is None:
        return whole, whole
    along = np.abs(basis.T @ normal)
    k = int(np.argmax(along))
    if along[k] > 1.0 - 1e-12:
        return [a for i, a in enumerate(whole) if i != k], [whole[k]]
    u = np.cross(basis[:, int(np.argmin(along))], normal)
    u /= np.linalg.norm(u)
    return [Axis("u", u), Axis("v", np.cross(normal, u))], [Axis("w", normal)]


# -- editing ----------------------------------------------------------------------------------------------------


def _edit(
    document: Document,
    folder: Path | None,
    model: mujoco.MjModel,
    pins: list[int],
    closures: list[Closure],
    constants: tuple[float, float],
    frame: str,
) -> Document:
    data = quiet_data(model)
    mujoco.mj_kinematics(model, data)
    made = Made(
        tuple(n for joint in pins for n in _add_slides(document, model, data, joint, frame)),
        tuple(n for c in closures for n in _add_elements(document, model, data, c, frame, turning=False)),
        tuple(n for c in closures for n in _add_elements(document, model, data, c, frame, turning=True)),
    )
    clash = set(made.slides) & {model.joint(j).name for j in range(model.njnt)}
    clash |= {*made.bushes, *made.turns} & set(actuator_names(model))
    if clash:
        raise ModelError(f"the model has elements called {', '.join(sorted(clash))} already")
    for closure in sorted(closures, key=lambda c: -c.index):
        document.remove(_equality_element(document, model, closure.index))
    scale = {float(model.eq_data[c.index, 10]) for c in closures if c.kind == "weld"}
    if len(scale) > 1:
        raise ModelError("welds of different torquescale need bushes of their own: replace them one at a time")
    turning = tuple(constant * max(scale, default=1.0) ** 2 for constant in constants)
    add_classes(document, made, constants, turning)
    if not any(o.get("integrator") for o in document.sections("option")):
        document.section("option", before="worldbody").set("integrator", "discrete")
    rewrite_keys(document, folder, model, made)
    declare(document, loading.compile_spec(loading.parse_present(str(document), folder, "with bushes")[0]), made)
    return document


def _add_slides(document: Document, model: mujoco.MjModel, data: mujoco.MjData, joint: int, frame: str) -> list[str]:
    """Put slides before a joint of the tree and return their names."""
    name, body = model.joint(joint).name, int(model.jnt_bodyid[joint])
    element = document.named("worldbody", name, "joint")
    if element is None:
        raise _NotInText(name)
    parents = document.parents()
    while parents[element].tag == "frame":  # axes below are in the body's own frame
        element = parents[element]
    parent = parents[element]
    tree = [b for b in range(1, model.nbody) if model.body_rootid[b] == model.body_rootid[body]]
    basis = np.eye(3) if frame == "world" else data.xmat[model.body_parentid[body]].reshape(3, 3)
    added = []
    for axis in _axes(basis, plane_normal(model, tree))[0]:
        added.append(f"bush_{name}_{axis.suffix}")
        local = numbers(data.xmat[body].reshape(3, 3).T @ axis.vector)
        index = list(parent).index(element)
        slide = {"name": added[-1], "class": free_class(document, SLIDE_CLASS), "axis": local}
        document.add(parent, "joint", slide, index)
    return added


def _add_elements(
    document: Document, model: mujoco.MjModel, data: mujoco.MjData, closure: Closure, frame: str, *, turning: bool
) -> list[str]:
    """Add a closure's sites and its elements along (or, turning, about) each axis; return the elements' names."""
    if turning and closure.kind != "weld":
        return []
    first, second = closure.frames
    flipped = first.body == 0 and second.body != 0
    point, reference = (second, first) if flipped else (first, second)
    rotation = data.xmat[reference.body].reshape(3, 3)
    axes = _axes(np.eye(3) if frame == "world" else rotation, plane_normal(model, [first.body, second.body]))
    local = np.empty(9)
    mujoco.mju_quat2Mat(local, reference.quat)
    to_reference = (rotation @ local.reshape(3, 3)).T
    sites = [
        _site(document, model, f, f"bush_{closure.name}_{k}", add=not turning)
        for k, f in enumerate((point, reference), start=1)
    ]
    added = []
    for axis in axes[turning]:
        gear, zero = numbers(to_reference @ axis.vector), "0 0 0"
        added.append(f"bush_{closure.name}_{'r' if turning else ''}{axis.suffix}")
        attributes = {
            "name": added[-1],
            "class": free_class(document, TURN_CLASS if turning else BUSH_CLASS),
            "site": sites[0],
            "refsite": sites[1],
            "gear": f"{zero} {gear}" if turning else f"{gear} {zero}",
        }
        document.add(document.section("actuator"), "general", attributes)
    return added


def _site(document: Document, model: mujoco.MjModel, frame: Frame, name: str, *, add: bool) -> str:
    """Return the name of the site at a closure's frame, added where there is none."""
    if frame.site >= 0:
        return str(model.site(frame.site).name)
    if add:
        body_name = model.body(frame.body).name
        body = document.section("worldbody") if frame.body == 0 else document.named("worldbody", body_name, "body")
        if body is None:
            raise _NotInText(body_name)
        turned = {} if frame.quat[0] == 1.0 else {"quat": numbers(frame.quat)}
        children = [k for k, c in enumerate(body) if c.tag == "body"]
        index = children[0] if children and frame.body else None
        document.add(body, "site", {"name": name, "pos": numbers(frame.pos), "size": "0.01"} | turned, index)
    return name


def _equality_element(document: Document, model: mujoco.MjModel, equality: int) -> Element:
    every = [e for section in document.sections("equality") for e in elements(section)]
    name = model.equality(equality).name
    if name:
        every = [e for e in every if e.get("name") == name]
        if len(every) == 1:
            return every[0]
    elif len(every) == model.neq:
        return every[equality]
    raise _NotInText(name)
