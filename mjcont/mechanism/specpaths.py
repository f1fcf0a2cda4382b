"""Paths to the attributes of a model's spec: spec:object:pattern.attribute[index]*factor+offset.

The attributes are those of MuJoCo's `MjSpec` elements, in the XML's own frames; angles are radians here whatever the
XML's compiler says.
"""

from __future__ import annotations

import fnmatch
import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import ParameterError, unknown_name
from mjcont.mechanism.paths import split_path

PREFIX = "spec:"
_OBJECTS = {
    "body": "bodies",
    "geom": "geoms",
    "site": "sites",
    "joint": "joints",
    "tendon": "tendons",
    "actuator": "actuators",
    "equality": "equalities",
}
_ORIENTATIONS = {
    "euler": mujoco.mjtOrientation.mjORIENTATION_EULER,
    "axisangle": mujoco.mjtOrientation.mjORIENTATION_AXISANGLE,
    "xyaxes": mujoco.mjtOrientation.mjORIENTATION_XYAXES,
    "zaxis": mujoco.mjtOrientation.mjORIENTATION_ZAXIS,
}
_INSTEAD = {
    ("geom", "fromto"): "pos, size[1] (half the length) and euler",
    ("site", "fromto"): "pos and size",
    ("geom", "mass"): "density",
    ("body", "ipos"): "the body's geoms: their pos, size and density",
    ("body", "fullinertia"): "inertia of an <inertial>, or the body's geoms",
    ("tendon", "springlength"): "springlength in the XML (MuJoCo takes the length at qpos0 now)",
}
_JOINT_ANGLES = ("ref", "springref", "range")


@dataclass(frozen=True, slots=True)
class SpecTarget:
    """Entries of one attribute of elements of a spec, set to offset + factor * value.

    Attributes
    ----------
    kind, names, attr : what, which ones, and their attribute.
    index : the entry of a vector; None for a number, or all entries.
    """

    kind: str
    names: tuple[str, ...]
    attr: str
    index: int | None
    factor: float
    offset: float

    def read(self, spec: mujoco.MjSpec) -> np.ndarray:
        """Return the parameter values that the entries imply."""
        entries = [self._chosen(self._array(e) * self._unit(e)) for e in self._elements(spec)]
        return (np.concatenate(entries) - self.offset) / self.factor

    def write(self, spec: mujoco.MjSpec, value: float) -> None:
        """Write a parameter's value into the entries."""
        for element in self._elements(spec):
            array, unit = self._array(element), self._unit(element)
            at = slice(None) if self.index is None else self.index
            array[at] = (self.offset + self.factor * value) / unit[at]
            holder = _holder(element, self.attr)
            setattr(holder, self.attr, float(array[0]) if np.ndim(getattr(holder, self.attr)) == 0 else array)

    def arrays(self, spec: mujoco.MjSpec) -> list[np.ndarray]:
        """Return the whole attribute of every element, in the XML's own units."""
        return [self._array(element) for element in self._elements(spec)]

    def _elements(self, spec: mujoco.MjSpec) -> list[Any]:
        return [getattr(spec, self.kind)(name) for name in self.names]

    def _chosen(self, array: np.ndarray) -> np.ndarray:
        return array if self.index is None else array[[self.index]]

    def _array(self, element: Any) -> np.ndarray:
        return np.atleast_1d(np.array(getattr(_holder(element, self.attr), self.attr), dtype=float))

    def _unit(self, element: Any) -> np.ndarray:
        """Return radians per unit of the XML for the entries that are angles, 1 for the others."""
        unit = np.ones(self._array(element).shape)
        if element.compiler.degree:
            turning = self.kind == "joint" and element.type != mujoco.mjtJoint.mjJNT_SLIDE
            if self.attr == "euler" or (turning and self.attr in _JOINT_ANGLES):
                unit[:] = math.pi / 180.0
            elif self.attr == "axisangle":
                unit[3] = math.pi / 180.0
        return unit


def resolve_spec_path(spec: mujoco.MjSpec, path: str) -> SpecTarget:
    """Turn a `spec:` path into a target.

    Raises
    ------
    ParameterError
        If the path does not parse, matches nothing, or the XML does not give the attribute.
    NameLookupError
        If the kind of object or the attribute does not exist; the message lists the valid ones.
    """
    parts = split_path(path.removeprefix(PREFIX), path)
    kind, attr = parts.kind, parts.attr
    if kind not in _OBJECTS:
        raise unknown_name("object in a spec path", kind, _OBJECTS)
    if attr is None:
        raise ParameterError(f"target '{path}': an attribute is missing, as in {PREFIX}{kind}:{parts.pattern}.pos[0]")
    elements = [e for e in getattr(spec, _OBJECTS[kind]) if e.name and e.name != "world"]
    matched = [e for e in elements if fnmatch.fnmatchcase(e.name, parts.pattern)]
    if not matched:
        listing = ", ".join(e.name for e in elements) or "none"
        raise ParameterError(f"target '{path}' matches no {kind} of the model. Its {kind} names: {listing}.")
    target = SpecTarget(kind, tuple(e.name for e in matched), attr, parts.index, parts.factor, parts.offset)
    for element in matched:
        _check_attribute(element, target, path)
    return target


def _check_attribute(element: Any, target: SpecTarget, path: str) -> None:
    """Raise unless the element has the attribute, with that index, and the XML gives it."""
    kind, attr, index = target.kind, target.attr, target.index
    valid = _attributes(element)
    if attr not in valid:
        raise unknown_name(f"attribute of a {kind} in the spec", attr, valid)
    value = getattr(_holder(element, attr), attr)
    size = int(np.size(value))
    if index is not None and np.ndim(value) == 0:
        raise ParameterError(f"target '{path}': {attr} is a number, without an index")
    if index is not None and index >= size:
        raise ParameterError(f"target '{path}': index {index} is outside 0..{size - 1}")
    if not _is_given(element, kind, attr):
        placed = hasattr(element, "fromto") and not np.isnan(element.fromto[0])
        instead = _INSTEAD.get((kind, attr)) or _other_orientation(element) or ("fromto" if placed else "quat")
        raise ParameterError(f"target '{path}': the XML of {kind} '{element.name}' gives no {attr}; use {instead}")
    if kind == "geom" and attr in ("pos", "quat") and not np.isnan(element.fromto[0]):
        raise ParameterError(f"target '{path}': geom '{element.name}' is placed by fromto; use fromto[0] .. fromto[5]")


def _holder(element: Any, attr: str) -> Any:
    return element.alt if attr in _ORIENTATIONS and not hasattr(element, attr) else element


def _attributes(element: Any) -> list[str]:
    """Return the names of the continuous attributes of a spec's element."""
    names = [a for a in dir(element) if not a.startswith("_") and _is_continuous(getattr(element, a))]
    return [*names, *_ORIENTATIONS] if hasattr(element, "alt") else names


def _is_continuous(value: object) -> bool:
    return isinstance(value, float) or (isinstance(value, np.ndarray) and value.dtype == np.float64)


def _is_given(element: Any, kind: str, attr: str) -> bool:
    if attr in _ORIENTATIONS and not hasattr(element, attr):
        return bool(element.alt.type == _ORIENTATIONS[attr])
    if kind == "tendon" and attr == "springlength":
        return bool(element.springlength[0] >= 0)
    if attr == "quat" and hasattr(element, "alt") and _other_orientation(element):
        return False
    return not np.isnan(np.ravel(getattr(element, attr))[0])


def _other_orientation(element: Any) -> str:
    """Return the attribute by which an element's orientation is given, empty if by none but its quat."""
    kind = getattr(getattr(element, "alt", None), "type", None)
    return next((name for name, value in _ORIENTATIONS.items() if value == kind), "")
