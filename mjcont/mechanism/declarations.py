"""Declarations of parameters: what the texts `mjcont/NAME` of a model say, or a user in Python."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from mjcont.errors import ParameterError
from mjcont.results.quantities import Parameter

DECLARATION_PREFIX = "mjcont/"
_SETTINGS = frozenset({"gravity_axis", "notes"})


@dataclass(frozen=True, slots=True)
class Declaration:
    """What a `mjcont/NAME` text says: unit, bounds and the paths of the targets. Python may give a function.

    Attributes
    ----------
    function, value : in place of paths, `function(spec, value)` and the parameter's value in the model.
    """

    name: str
    unit: str
    bounds: tuple[float, float] | None
    paths: tuple[str, ...]
    function: Callable[[Any, float], None] | None = None
    value: float | None = None

    def record(self, made: Parameter) -> dict[str, Any]:
        """Return what a result file keeps of it; of a function, its name."""
        what = {"paths": list(self.paths)} if self.function is None else {"function": made.source, "value": made.value}
        return what | {"unit": made.unit, "bounds": list(made.bounds)}


def parse_declaration(name: str, text: str) -> Declaration:
    """Read `unit=N/m bounds=1,1e10 : path path ...`.

    Raises
    ------
    ParameterError
        If a key is unknown, bounds are not two increasing numbers, or no target is given.
    """
    head, colon, tail = text.partition(" : ")
    if not colon:
        raise ParameterError(f"parameter '{name}': expected 'unit=... bounds=lo,hi : targets', got '{text}'")
    unit, bounds = "", None
    for item in head.split():
        key, _, value = item.partition("=")
        if key == "unit":
            unit = value
        elif key == "bounds":
            try:
                low, high = (float(v) for v in value.split(","))
            except ValueError:
                low, high = 1.0, 0.0
            if not low < high:
                raise ParameterError(f"parameter '{name}': bounds must be 'low,high' with low < high, got '{value}'")
            bounds = (low, high)
        else:
            raise ParameterError(f"parameter '{name}': unknown key '{key}'. Valid: unit, bounds.")
    paths = tuple(tail.split())
    if not paths:
        raise ParameterError(f"parameter '{name}': no target after ':'")
    return Declaration(name, unit, bounds, paths)


def declarations(model: mujoco.MjModel) -> list[Declaration]:
    """Return the declarations in the model's custom texts, in their order."""
    found = []
    for i in range(model.ntext):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_TEXT, i) or ""
        if name.startswith(DECLARATION_PREFIX):
            start, size = model.text_adr[i], model.text_size[i]
            text = bytes(model.text_data[start : start + size]).rstrip(b"\0").decode()
            if name.removeprefix(DECLARATION_PREFIX) not in _SETTINGS:
                found.append(parse_declaration(name.removeprefix(DECLARATION_PREFIX), text))
    return found


def setting(model: mujoco.MjModel, name: str) -> str | None:
    """Return the text `mjcont/name` of the model, or None."""
    text_id = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, DECLARATION_PREFIX + name)
    if text_id < 0:
        return None
    start, size = model.text_adr[text_id], model.text_size[text_id]
    return bytes(model.text_data[start : start + size]).rstrip(b"\0").decode()


def agreed_value(name: str, values: np.ndarray) -> float:
    """Return the value that all targets of a parameter imply."""
    spread = np.ptp(values)
    if spread > 1e-9 * max(1.0, np.abs(values).max()):
        raise ParameterError(
            f"parameter '{name}': its targets disagree in this model "
            f"(values from {values.min():g} to {values.max():g}); give each its own parameter, "
            "an index such as [0] where they are one vector, or factors and offsets that make them agree"
        )
    return float(values[0]) + 0.0
