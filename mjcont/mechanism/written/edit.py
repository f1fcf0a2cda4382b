"""Parameter values written into the attributes of an MJCF text, and held against the model that it then is."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import ModelError, ParameterError
from mjcont.mechanism.geometry import acting_fields
from mjcont.mechanism.mechanism import Mechanism
from mjcont.mechanism.paths import split_path
from mjcont.mechanism.specpaths import PREFIX, resolve_spec_path
from mjcont.mechanism.written.places import Edits, Element, find
from mjcont.models import loading
from mjcont.models.mjcf import number
from mjcont.models.states import element_name, field_array
from mjcont.results.quantities import Parameter, Target

_OBJECTS = {
    "jnt_": ("joint", mujoco.mjtObj.mjOBJ_JOINT), "dof_": ("joint", mujoco.mjtObj.mjOBJ_JOINT),
    "body_": ("body", mujoco.mjtObj.mjOBJ_BODY), "geom_": ("geom", mujoco.mjtObj.mjOBJ_GEOM),
    "site_": ("site", mujoco.mjtObj.mjOBJ_SITE), "tendon_": ("tendon", mujoco.mjtObj.mjOBJ_TENDON),
    "actuator_": ("actuator", mujoco.mjtObj.mjOBJ_ACTUATOR),
}
# fields whose attribute is called otherwise
_ATTRIBUTES = {"tendon_lengthspring": "springlength", "dof_frictionloss": "frictionloss"}
_GENERAL = ("actuator_gainprm", "actuator_biasprm")
_SAME = 1e-9
# ends of the names of fields that MuJoCo computes from others
_DERIVED = ("acc0", "length0", "invweight0", "subtreemass", "lengthrange", "rbound", "M0")


def rewritten(mechanism: Any, values: Mapping[str, float], source: str | Path | None = None) -> str:
    """Return the MJCF with other parameter values in it; comments and everything else stay to the letter.

    Parameters
    ----------
    mechanism : Mechanism
    values : parameter values; names that are left out keep the model's.
    source : path or text, optional
        The MJCF to edit; default the text that the mechanism was loaded from.

    Raises
    ------
    ModelError
        If there is no text, or the model that it becomes is not the one that is meant.
    ParameterError
        If a parameter has no attribute of its own in the text.
    """
    if not isinstance(mechanism, Mechanism):
        raise ModelError(f"'{mechanism.name}' is no mechanism: it has no MJCF")
    text = loading.read_source(source)[0] if source is not None else mechanism.mjcf
    if text is None:
        raise ModelError("a mechanism made from a compiled model has no MJCF: name the file, source=...")
    wanted = mechanism.values(values)
    changed = [p for n, p in mechanism.parameters.items() if wanted[n] != p.value]
    edits = Edits(text)
    for p in changed:
        _write(mechanism, edits, p, wanted)
    new = str(edits)
    _check(mechanism, wanted, changed, new, source)
    return new


def _write(mechanism: Mechanism, edits: Edits, p: Parameter, wanted: Mapping[str, float]) -> None:
    value = wanted[p.name]
    if p.kind == "spec" and not p.is_function:
        for path in p.source.split():
            _write_spec(mechanism, edits, p, path, wanted)
        return
    if p.kind != "field" or p.springs:
        why = {
            "control": "a control is no part of a model", "input": "it is no part of a model",
            "switch": "it switches an equality constraint", "gravity": "gravity's turn and factor are no attributes",
            "spec": "a Python function makes the edit",
        }.get(p.kind, "the stiffness of a constraint")
        raise ParameterError(f"{p.name} = {value:g} cannot be written into the MJCF: {why}")
    for target in p.targets:
        _write_field(mechanism, edits, p, target, value)


def _element(edits: Edits, p: Parameter, kind: str, name: str) -> Element:
    found = find(edits.text, kind, name)
    if len(found) != 1:
        many = "no element" if not found else f"{len(found)} elements"
        raise ParameterError(f"{p.name} cannot be written into the MJCF: its text has {many} <{kind}> called '{name}'")
    return found[0]


def _put(edits: Edits, element: Element, attribute: str, index: int, value: float, whole: np.ndarray) -> None:
    """Write one entry of an attribute; `whole` is the attribute as the model has it, in the text's units."""
    words = edits.words(element, attribute)
    if words is None or len(words) <= index:
        known = words or []
        words = known + [number(v) for v in whole[len(known) : index + 1]]
    words[index] = number(value)
    edits.put(element, attribute, words)


def _write_field(mechanism: Mechanism, edits: Edits, p: Parameter, target: Target, value: float) -> None:
    model = mechanism.simulation_model()
    entry = target.entry(value)
    if target.field.startswith("opt."):
        option = target.field.removeprefix("opt.")
        element = _element(edits, p, "option", "")
        for i in target.index:
            _put(edits, element, option, i, entry, np.ravel(field_array(model, target.field)))
        return
    prefix = next((k for k in _OBJECTS if target.field.startswith(k)), None)
    if prefix is None and target.field != "qpos_spring":
        raise ParameterError(f"{p.name} cannot be written into the MJCF: {target.field} is no attribute")
    kind, obj = _OBJECTS[prefix or "jnt_"]
    array = field_array(model, target.field)
    width = array.size // array.shape[0]
    rows = array.reshape(array.shape[0], -1)
    for i in target.index:
        owner, at = divmod(i, width)
        owner = int(model.dof_jntid[owner]) if prefix == "dof_" else owner
        if target.field == "qpos_spring":
            owner = int(np.flatnonzero(model.jnt_qposadr == i)[0])
        name = element_name(model, obj, owner)
        if target.field == "body_mass":
            _write_mass(edits, p, name, entry, entry / float(model.body_mass[owner]))
            continue
        attribute = _ATTRIBUTES.get(target.field) or (
            "springref" if target.field == "qpos_spring" else target.field.removeprefix(prefix or ""))
        element = _element(edits, p, kind, name)
        if target.field in _GENERAL and element.tag != "general":
            raise ParameterError(f"{p.name} cannot be written into the MJCF: <{element.tag} name=\"{name}\"> has no "
                                 f"{attribute}; write the actuator as <general>")
        if target.field == "tendon_lengthspring" and len(element.values.get(attribute, "").split()) < 2:
            edits.put(element, attribute, [number(entry)])
            continue
        degrees = _degrees(edits.text) if attribute == "springref" and model.jnt_type[owner] == 3 else 1.0
        _put(edits, element, attribute, at, entry * degrees, rows[i if width == 1 else owner] * degrees)


def _degrees(text: str) -> float:
    """Return the text's units of angle in a radian."""
    radian = 'angle="radian"' in text or "angle='radian'" in text
    return 1.0 if radian else 180.0 / math.pi


def _write_mass(edits: Edits, p: Parameter, body: str, mass: float, ratio: float) -> None:
    """Write a body's mass; its inertia scales along."""
    found = find(edits.text, "inertial", body)
    if len(found) != 1:
        raise ParameterError(f"{p.name} cannot be written into the MJCF: body '{body}' has no <inertial>; declare the "
                             "density of its geoms, as in spec:geom:NAME.density")
    edits.put(found[0], "mass", [number(mass)])
    for attribute in ("diaginertia", "fullinertia"):
        words = edits.words(found[0], attribute)
        if words is not None:
            edits.put(found[0], attribute, [number(float(w) * ratio) for w in words])


def _write_spec(
    mechanism: Mechanism, edits: Edits, p: Parameter, path: str, wanted: Mapping[str, float]
) -> None:
    """Write what a path of the spec makes of its elements' attributes, in the XML's own units."""
    parts = split_path(path.removeprefix(PREFIX), path)
    spec = loading.parse(mechanism.mjcf or "", None, mechanism.name)
    target = resolve_spec_path(spec, path)
    target.write(spec, wanted[p.name])
    for name, array in zip(target.names, target.arrays(spec), strict=True):
        element = _element(edits, p, target.kind, name)
        if parts.index is not None:
            _put(edits, element, target.attr, parts.index, float(array[parts.index]), array)
            continue
        count = len(edits.words(element, target.attr) or array)
        edits.put(element, target.attr, [number(v) for v in array[:count]])


def _check(
    mechanism: Mechanism, wanted: Mapping[str, float], changed: list[Parameter], text: str, source: str | Path | None
) -> None:
    """Raise unless the text is the model with the values wanted, in every field that acts."""
    folder = loading.read_source(source)[1] if source is not None else None
    spec, _ = loading.parse_present(text, folder, mechanism.name)
    new, meant = loading.compile_spec(spec), mechanism.simulation_model()
    mechanism.writer(meant).write(mechanism.parameters, wanted)
    differing = [f for f in acting_fields() if not _alike(f, new, meant)]
    if not differing:
        return
    stated = [f for f in differing if not f.endswith(_DERIVED)] or differing
    placed = any(t.field.endswith(("_pos", "_quat")) for p in changed for t in p.targets)
    hint = "; inside a <frame> places count from the frame: declare them as in spec:site:NAME.pos[0]" if placed else ""
    names = ", ".join(p.name for p in changed)
    raise ModelError(f"the MJCF with {names} written into it is another model than the one that is meant: "
                     f"its {stated[0]} differs (something else in the text decides there{hint})")


def _alike(field: str, a: mujoco.MjModel, b: mujoco.MjModel) -> bool:
    """Whether a field is the same in two models but for rounding; how matrices are laid out does not count."""
    if "simple" in field:
        return True
    x, y = (np.ravel(getattr(m, field)) for m in (a, b))
    floor = _SAME * max(1.0, float(np.abs(y).max(initial=0)))
    return x.shape == y.shape and bool(np.allclose(x, y, rtol=_SAME, atol=floor))
