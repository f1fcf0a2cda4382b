"""What acts on a model through MuJoCo's data: controls, activations at rest, mocap poses, equality switches.

At rest an activation is no unknown. A filter or muscle, act' = (ctrl - act) / tau, has act = ctrl; an integrator,
act' = ctrl, rests at any value under zero control, and that value is its parameter.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
from mujoco.batch import Batch

from mjcont.models.actuators import _DYN, actuator_of, follower, integrator

_MOST = float(mujoco.mjMAXVAL)
_CLAMPED = "{range}, where MuJoCo would clamp it"
INPUT_FIELDS = frozenset({"ctrl", "act", "mocap_pos", "mocap_quat", "eq_active"})


def limits(model: mujoco.MjModel, field: str, index: int) -> tuple[float, float, str]:
    """Return the range of an input outside which MuJoCo would take another value, and the words for that range."""
    if field == "eq_active":
        return 0.0, 1.0, f"the switch's range {_CLAMPED}"
    if field not in ("ctrl", "act"):
        return -math.inf, math.inf, ""
    a = actuator_of(model, field, index)
    ranges = []
    if field == "ctrl" and model.actuator_ctrllimited[index]:
        ranges.append((*model.actuator_ctrlrange[index], "ctrlrange"))
    if (field == "act" or follower(model, a)) and model.actuator_actlimited[a]:
        ranges.append((*model.actuator_actrange[a], "actrange"))
    if field == "ctrl" and _DYN(model.actuator_dyntype[a]) == _DYN.mjDYN_MUSCLE:
        ranges.append((0.0, 1.0, "muscle range"))
    if not ranges:
        return -_MOST, _MOST, "the numbers {range}: MuJoCo would take zero instead"
    low, high = max(float(r[0]) for r in ranges), min(float(r[1]) for r in ranges)
    named = dict.fromkeys(str(r[2]) for r in ranges)
    return low, high, f"the actuator's {' and '.join(named)} {_CLAMPED}"


def loaded_inputs(model: mujoco.MjModel) -> dict[str, np.ndarray]:
    """Return the inputs of the model as loaded: no control, clamped as MuJoCo would, at rest."""
    mocap = np.flatnonzero(model.body_mocapid >= 0)[np.argsort(model.body_mocapid[model.body_mocapid >= 0])]
    found = {
        "ctrl": np.array([np.clip(0.0, *limits(model, "ctrl", i)[:2]) for i in range(model.nu)]),
        "act": np.zeros(model.na),
        "mocap_pos": model.body_pos[mocap].copy(),
        "mocap_quat": model.body_quat[mocap].copy(),
        "eq_active": model.eq_active0.astype(float),
    }
    for a in range(model.nactuator):
        if integrator(model, a):
            i = int(model.actuator_actadr[a])
            found["ctrl"][model.actuator_ctrladr[a]] = 0.0
            found["act"][i] = np.clip(0.0, *limits(model, "act", i)[:2])
    return found


class DataInputs:
    """The inputs of one model, and the one place that puts them into MuJoCo's data."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self.loaded = loaded_inputs(model)
        self._fields = {name: array.copy() for name, array in self.loaded.items()}
        self._present = [(name, array) for name, array in self._fields.items() if array.size]
        followers = [a for a in range(model.nactuator) if follower(model, a)]
        self._follow = model.actuator_actadr[followers], model.actuator_ctrladr[followers]
        held = [a for a in range(model.nactuator) if integrator(model, a)]
        self._held = model.actuator_actadr[held]
        self._delayed = [a for a in range(model.nactuator) if model.actuator_delay[a] > 0]
        self.settle()

    @property
    def ctrl(self) -> np.ndarray:
        """The controls, (nu,)."""
        return self._fields["ctrl"]

    @property
    def followed(self) -> bool:
        """Whether an activation follows a control."""
        return bool(len(self._follow[0]))

    @property
    def following(self) -> np.ndarray:
        """Addresses of the activations that follow a control, and in motion have a course of their own."""
        return self._follow[0]

    @property
    def resting(self) -> np.ndarray:
        """What these activations are at rest."""
        found: np.ndarray = self._fields["act"][self._follow[0]]
        return found

    def reset(self, base: mujoco.MjModel) -> None:
        """Go back to the inputs of a model as loaded."""
        self.loaded = loaded_inputs(base)
        for name, array in self.loaded.items():
            self._fields[name][:] = array
        self.settle()

    def write(self, field: str, index: list[int], entry: float | np.ndarray) -> None:
        """Set entries of a flattened field."""
        self._fields[field].reshape(-1)[index] = entry

    def settle(self) -> None:
        """Let activations follow their controls, as they do at rest."""
        activations, controls = self._follow
        self._fields["act"][activations] = self.ctrl[controls]

    def copies(self) -> dict[str, np.ndarray]:
        """Return copies of all inputs by field."""
        return {name: array.copy() for name, array in self._fields.items()}

    def put(self, data: mujoco.MjData) -> None:
        """Put the inputs into data, activations at rest."""
        for name, array in self._present:
            getattr(data, name)[:] = array

    def bound(self, batch: Batch) -> list[tuple[np.ndarray, np.ndarray]]:
        """Return where in a batch each input belongs, with the input: `put_rows` needs it, and a loop keeps it."""
        return [(batch.bind(name), array) for name, array in self._present]

    def put_rows(self, bound: list[tuple[np.ndarray, np.ndarray]]) -> None:
        """Put the inputs into every row of a batch, activations at rest."""
        for view, array in bound:
            view[:] = array

    def begin(self, data: mujoco.MjData) -> None:
        """Put the inputs into data from which a motion begins: they have been so for long."""
        self.put(data)
        for a in self._delayed:
            first, count = int(self._model.actuator_ctrladr[a]), int(self._model.actuator_ctrlnum[a])
            samples = int(self._model.actuator_history[a, 0])
            steady = np.tile(self.ctrl[first : first + count], (samples, 1))
            mujoco.mj_initCtrlHistory(self._model, data, a, None, steady)

    def drive(self, data: mujoco.MjData) -> None:
        """Put the inputs into data in motion: activations that follow a control keep their own course."""
        for name, array in self._present:
            if name == "act":
                data.act[self._held] = array[self._held]
            else:
                getattr(data, name)[:] = array


def parameter_kind(fields: set[str]) -> str:
    """Return the kind of a parameter that acts on these fields."""
    if "eq_active" in fields:
        return "switch"
    if fields == {"ctrl"}:
        return "control"
    return "input" if fields <= INPUT_FIELDS else "field"


