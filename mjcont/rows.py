"""Batched forward evaluations: many states of one model in one call."""

from __future__ import annotations

import mujoco
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
