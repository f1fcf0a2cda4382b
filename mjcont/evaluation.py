"""Evaluating a model: forces, accelerations, mass and damping at many states, counted."""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.numerics.problem import Array
from mjcont.rows import ConstrainedRows, Rows, one_sided
from mjcont.writer import FieldWriter

_MAX_BATCHES = 32
_ACCELERATION_STEP = 1e-3
_VELOCITY_STEPS = (1.0, 1e-2, 1e-4, 1e-6)
_SHORT_STEPS = (1e-3, 1e-5)


class Evaluator:
    """Evaluates one model with the parameter values that its writer wrote last.

    Attributes
    ----------
    count : evaluations so far; every row of a batch is one.
    """

    def __init__(self, model: mujoco.MjModel, writer: FieldWriter, constrained: bool) -> None:
        self.model, self.writer = model, writer
        self.count = 0
        self._constrained = ConstrainedRows(model) if constrained else None
        self._batches: dict[int, Rows] = {}
        self._data = mujoco.MjData(model)

    def _rows(self, count: int) -> Rows:
        rows = self._batches.get(count)
        if rows is None:
            if len(self._batches) >= _MAX_BATCHES:
                self._batches.clear()
            rows = self._batches[count] = Rows(self.model, count)
        return rows

    def forces(self, qpos: Array, qvel: Array | None = None) -> Array:
        """Return the generalised forces at zero acceleration for every row, (m, nv)."""
        self.count += len(qpos)
        if self._constrained is not None:
            return self._constrained.forward(qpos, qvel, self.writer)
        return self._rows(len(qpos)).forward(qpos, qvel, self.writer)

    @property
    def sides(self) -> list[bytes]:
        """What tells apart the smooth pieces of the forces in the last evaluation (see `rows.one_sided`)."""
        return self._constrained.sides if self._constrained is not None else []

    def accelerations(self, qpos: Array, qvel: Array) -> Array:
        """Return qacc for every row, (m, nv)."""
        self.count += len(qpos)
        if self._constrained is not None:
            return self._constrained.accelerations(qpos, qvel, self.writer)
        rows = self._rows(len(qpos))
        rows.forward(qpos, qvel, self.writer)
        return rows.acceleration()

    def active(self, x: Array) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load at rest."""
        if self._constrained is None:
            return frozenset()
        self.count += 1
        return self._constrained.active(x, self.writer)

    def position(self, x: Array) -> mujoco.MjData:
        """Return data of our own with everything that depends on position computed."""
        self._data.qpos[:] = x
        mujoco.mj_fwdPosition(self.model, self._data)
        return self._data

    def mass(self, x: Array) -> Array:
        """Return the mass matrix, (nv, nv); a soft constraint adds to it, since its force depends on acceleration."""
        n = self.model.nv
        if self._constrained is not None:
            self.count += 2 * n
            steps = np.concatenate([np.eye(n), -np.eye(n)])
            many = np.broadcast_to(x, (2 * n, len(x)))
            rows = self._constrained.forward(many, None, self.writer, _ACCELERATION_STEP * steps)
            return (rows[n:] - rows[:n]).T / (2.0 * _ACCELERATION_STEP)
        dense = np.empty((n, n))
        mujoco.mj_fullM(self.model, self.position(x), dense)
        return dense

    def damping(self, x: Array, scale: Array) -> Array:
        """Return -d forces/dv at rest, (nv, nv), centred with the steps `scale`: exact for linear dampers.

        A limit or contact that the steps would make or break, by its own damping, asks for shorter ones. So do
        dampers and drag with terms in |v| v, which half the step and the whole cancel between them.
        """
        linear = not self._damps_nonlinearly()
        for part in _VELOCITY_STEPS if linear else _SHORT_STEPS:
            found, one_piece = self._damping_over(x, part * scale)
            if one_piece:
                break
        return found if linear else 2.0 * self._damping_over(x, 0.5 * part * scale)[0] - found

    def _damping_over(self, x: Array, scale: Array) -> tuple[Array, bool]:
        """Return -d forces/dv over given steps, and whether the same limits and contacts bear in all of them."""
        n = self.model.nv
        steps = np.concatenate([np.diag(scale), -np.diag(scale)])
        if self._constrained is None:
            rows = self.forces(np.broadcast_to(x, (2 * n, len(x))), steps)
            return ((rows[n:] - rows[:n]) / (2.0 * scale)[:, None]).T, True
        rows = self.forces(np.broadcast_to(x, (1 + 2 * n, len(x))), np.concatenate([np.zeros((1, n)), steps]))
        centred = ((rows[1 + n :] - rows[1 : 1 + n]) / (2.0 * scale)[:, None]).T
        one_piece = all(side == self.sides[0] for side in self.sides)
        return -one_sided(-centred, rows, self.sides, steps), one_piece

    def _damps_nonlinearly(self) -> bool:
        """Whether dampers or a fluid oppose motion with more than its first power."""
        m = self.model
        fluid = m.opt.density > 0 or m.opt.viscosity > 0
        return bool(fluid or any(np.any(p) for p in (m.dof_dampingpoly, m.tendon_dampingpoly, m.actuator_dampingpoly)))
