"""Evaluations of many states of one model: batched where nothing constrains it, one by one where something does."""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np
from mujoco.batch import Batch

from mjcont.numerics.problem import Array
from mjcont.writer import FieldWriter


class Rows:
    """A batch of a fixed number of rows, evaluated on one thread (waking a second costs more than it gives)."""

    def __init__(self, model: mujoco.MjModel, count: int) -> None:
        self._model = model
        self._batch = Batch(model, count, nthread=1)
        self._version = -1
        self._qpos = self._batch.bind("qpos")
        self._qvel = self._batch.bind("qvel")
        self._ctrl = self._batch.bind("ctrl")
        self._forces = self._batch.bind("qfrc_smooth")
        self._acceleration = self._batch.bind("qacc")

    def forward(self, qpos: Array, qvel: Array | None, writer: FieldWriter) -> Array:
        """Evaluate the rows' states with the writer's controls and return qfrc_smooth, a live view (m, nv)."""
        if self._version != writer.version:
            self._batch.set_models(self._model)
            self._version = writer.version
        self._qpos[:] = qpos
        self._qvel[:] = 0.0 if qvel is None else qvel
        self._ctrl[:] = writer.ctrl
        self._batch.forward()
        return self._forces

    def acceleration(self) -> Array:
        """Return qacc of the last evaluation, a live view (m, nv)."""
        return self._acceleration


class ConstrainedRows:
    """Evaluations of a model with constraints: the forces at zero acceleration, constraint forces among them.

    MuJoCo's constraint forces depend on the acceleration; at rest and in equilibrium it is zero, so equilibria are
    where the inverse dynamics at zero acceleration ask for no force. One row after the other: the batch has no
    inverse dynamics.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._data = mujoco.MjData(model)
        self.sides: list[bytes] = []

    def forward(self, qpos: Array, qvel: Array | None, writer: FieldWriter, qacc: Array | None = None) -> Array:
        """Return the forces for every row, (m, nv); `qacc` (m, nv) is zero unless given."""
        m, d = self._model, self._data
        out = np.empty((len(qpos), m.nv))
        self.sides = []
        d.ctrl[:] = writer.ctrl
        for i, x in enumerate(qpos):
            d.qpos[:] = x
            d.qvel[:] = 0.0 if qvel is None else qvel[i]
            d.qacc[:] = 0.0 if qacc is None else qacc[i]
            mujoco.mj_inverse(m, d)
            self.sides.append(load_side(d))
            mujoco.mj_fwdActuation(m, d)
            out[i] = d.qfrc_actuator - d.qfrc_inverse
        return out

    def accelerations(self, qpos: Array, qvel: Array, writer: FieldWriter) -> Array:
        """Return qacc for every row, (m, nv)."""
        m, d = self._model, self._data
        out = np.empty((len(qpos), m.nv))
        d.ctrl[:] = writer.ctrl
        for i, x in enumerate(qpos):
            d.qpos[:], d.qvel[:], d.qacc_warmstart[:] = x, qvel[i], 0.0
            mujoco.mj_forward(m, d)
            out[i] = d.qacc
        return out

    def active(self, x: Array, writer: FieldWriter) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load at rest."""
        m, d = self._model, self._data
        d.ctrl[:] = writer.ctrl
        d.qpos[:], d.qvel[:], d.qacc[:] = x, 0.0, 0.0
        mujoco.mj_inverse(m, d)
        return frozenset(_loaded(m, d))


def load_side(d: mujoco.MjData) -> bytes:
    """Return what tells apart the smooth pieces of the forces: the constraints that carry load."""
    loaded = d.efc_force != 0.0
    return d.efc_type[loaded].tobytes() + d.efc_id[loaded].tobytes()


def one_sided(jac: Array, rows: Array, sides: list[bytes], steps: Array) -> Array:
    """Return a difference Jacobian whose columns do not straddle a limit or contact.

    Parameters
    ----------
    jac : (n, n) from centred differences.
    rows : (1 + m, n) forces at the state and at the state moved by `steps`.
    sides : of each row, as `ConstrainedRows` leaves them.
    steps : (m, n), each along one coordinate.
    """
    straddling = {j for r, step in enumerate(steps, 1) if sides[r] != sides[0] for j in np.flatnonzero(step)}
    out = jac.copy()
    for j in straddling:
        same = [r for r, step in enumerate(steps, 1) if step[j] != 0.0 and sides[r] == sides[0]]
        if same:
            r = min(same, key=lambda r: abs(steps[r - 1][j]))
            out[:, j] = (rows[r] - rows[0]) / steps[r - 1][j]
    return out


def _loaded(m: mujoco.MjModel, d: mujoco.MjData) -> Iterator[str]:
    kinds = mujoco.mjtConstraint
    for r in range(d.nefc):
        kind, index = kinds(d.efc_type[r]), int(d.efc_id[r])
        if d.efc_force[r] <= 0.0:
            continue
        if kind == kinds.mjCNSTR_LIMIT_JOINT:
            side = "lower" if d.qpos[m.jnt_qposadr[index]] < np.mean(m.jnt_range[index]) else "upper"
            yield f"{side} limit of {_name(m, mujoco.mjtObj.mjOBJ_JOINT, index)}"
        elif kind == kinds.mjCNSTR_LIMIT_TENDON:
            side = "lower" if d.ten_length[index] < np.mean(m.tendon_range[index]) else "upper"
            yield f"{side} limit of {_name(m, mujoco.mjtObj.mjOBJ_TENDON, index)}"
        elif kind.name.startswith("mjCNSTR_CONTACT"):
            pair = [_name(m, mujoco.mjtObj.mjOBJ_GEOM, int(g)) for g in d.contact[index].geom]
            yield f"contact of {pair[0]} and {pair[1]}"


def _name(m: mujoco.MjModel, kind: mujoco.mjtObj, index: int) -> str:
    return mujoco.mj_id2name(m, kind, index) or f"{kind.name.removeprefix('mjOBJ_').lower()}{index}"
