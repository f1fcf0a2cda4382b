"""Numbers in a model with which one cannot compute: NaN, infinity, a mass that is zero; named as a user knows them."""

from __future__ import annotations

from functools import cache

import mujoco
import numpy as np

from mjcont.errors import ModelError
from mjcont.models.quiet import quiet, quiet_data
from mjcont.models.states import element_name, field_array
from mjcont.results.quantities import LARGEST

_OBJ = mujoco.mjtObj
_ELEMENTS = {
    "jnt": _OBJ.mjOBJ_JOINT, "body": _OBJ.mjOBJ_BODY, "geom": _OBJ.mjOBJ_GEOM, "site": _OBJ.mjOBJ_SITE,
    "tendon": _OBJ.mjOBJ_TENDON, "actuator": _OBJ.mjOBJ_ACTUATOR, "eq": _OBJ.mjOBJ_EQUALITY, "key": _OBJ.mjOBJ_KEY,
    "pair": _OBJ.mjOBJ_PAIR,
}  # fmt: skip
_ACTING = ("qpos0", "qpos_spring", "key_qpos", *(f"{e}_" for e in _ELEMENTS if e != "key"), "dof_")


def invalid_number(model: mujoco.MjModel) -> str:
    """Return a clause on the first number of the model with which one cannot compute; empty if there is none."""
    for field in (*_numbers(), "opt.gravity", "opt.wind", "opt.density", "opt.viscosity", "opt.timestep"):
        values = np.atleast_1d(field_array(model, field))
        wrong = ~(np.abs(values) <= LARGEST)
        if wrong.any():
            first = tuple(int(i) for i in np.argwhere(wrong)[0])
            return f"{_place(model, field, first)} is {values[first]:g}: it must be a number within +-{LARGEST:g}"
    return ""


@cache
def _numbers() -> tuple[str, ...]:
    """Return the names of a model's arrays of numbers that act on it."""
    model = mujoco.MjModel.from_xml_string("<mujoco/>")
    every = [f for p in _ACTING for f in dir(model) if f.startswith(p) and not f.endswith(("_user", "_rgba"))]
    found = (f for f in every if getattr(getattr(model, f), "dtype", None) == np.float64)
    return tuple(sorted(found, key=lambda f: f.endswith("0") and f != "qpos0"))  # what MuJoCo derives comes last


def _place(model: mujoco.MjModel, field: str, index: tuple[int, ...]) -> str:
    """Return an entry of a field as a user knows it."""
    prefix, _, attribute = field.partition("_")
    kind, row = _ELEMENTS.get(prefix, _OBJ.mjOBJ_JOINT), index[0]
    if prefix.startswith("opt."):
        return f"{field.removeprefix('opt.')}[{row}]"
    if prefix == "dof":
        row = int(model.dof_jntid[row])
    elif prefix in ("qpos0", "qpos"):
        row, attribute = int(np.searchsorted(model.jnt_qposadr, row, "right")) - 1, attribute or field
    inside = f"[{index[-1]}]" if len(index) > 1 else ""
    return f"{attribute}{inside} of {kind.name.removeprefix('mjOBJ_').lower()} '{element_name(model, kind, row)}'"


def refuse_invalid(model: mujoco.MjModel) -> None:
    """Raise a ModelError for numbers in the model with which one cannot compute, and for inertias that are zero."""
    wrong = invalid_number(model)
    if wrong:
        raise ModelError(wrong)
    data = quiet_data(model)
    with quiet:
        mujoco.mj_fwdPosition(model, data)
    mass = np.empty((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    for dof in np.flatnonzero(~(np.diag(mass) >= mujoco.mjMINVAL)):
        joint = element_name(model, _OBJ.mjOBJ_JOINT, int(model.dof_jntid[dof]))
        raise ModelError(f"joint '{joint}' moves nothing that has mass or inertia: give its body some, or remove it")
