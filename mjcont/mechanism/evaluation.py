"""Evaluating a model: forces, accelerations, mass and damping at many states, counted."""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.mechanism.batches import ConstrainedRows, Rows
from mjcont.mechanism.kinks import Kinks
from mjcont.mechanism.writer import FieldWriter
from mjcont.models.features import passive
from mjcont.models.quiet import Warned, quiet
from mjcont.numerics.equations.problem import Array

_DISABLE = mujoco.mjtDisableBit
_MAX_BATCHES = 32
_ACCELERATION_STEPS = (1e-3, 1e-6)
_VELOCITY_STEPS = (1.0, 1e-3, 1e-6)
# at unit speed drag counts that is not there at rest
_DRAG_STEPS = (1e-4, 1e-6)


class Evaluator:
    """Evaluates one model with the parameter values that its writer wrote last.

    Attributes
    ----------
    count : evaluations so far; every row of a batch is one.
    """

    def __init__(self, model: mujoco.MjModel, writer: FieldWriter, constrained: bool, count: int = 0) -> None:
        self.model, self.writer = model, writer
        self.count = count
        self._kinks = Kinks.of(model)
        self._constrained = ConstrainedRows(model, self._kinks) if constrained else None
        self._last: Rows | ConstrainedRows | None = self._constrained
        self._dampers = None if self.nonsmooth else Dampers.of(model)
        self._batches: dict[int, Rows] = {}
        self._data = mujoco.MjData(model)
        self._warned = Warned(self._data)
        self._forces = self._data.qfrc_smooth[None]

    def _rows(self, count: int) -> Rows:
        rows = self._batches.get(count)
        if rows is None:
            if len(self._batches) >= _MAX_BATCHES:
                self._batches.clear()
            rows = self._batches[count] = Rows(self.model, count, self._kinks)
        return rows

    def forces(self, qpos: Array, qvel: Array | None = None, ctrl: Array | None = None) -> Array:
        """Return the generalised forces at zero acceleration for every row, (m, nv).

        `ctrl` (m, nu) gives smooth models rows with controls of their own.
        """
        self.count += len(qpos)
        if self.writer.failure:  # no model there: a curve ends, as one does where a function leaves its domain
            return np.full((len(qpos), self.model.nv), np.nan)
        if self._constrained is not None:
            return self._constrained.forward(qpos, qvel, self.writer)
        if len(qpos) == 1 and qvel is None and self._kinks is None and ctrl is None:
            return self._single(qpos[0])
        rows = self._last = self._rows(len(qpos))
        return rows.forward(qpos, qvel, self.writer, ctrl)

    def _single(self, x: Array) -> Array:
        """Return the forces at rest in one state, (1, nv): a batch of one costs more than MuJoCo's own call."""
        self.writer.inputs.put(self._data)
        self._data.qpos[:] = x
        mujoco.mj_forward(self.model, self._data)
        return self._forces if self._warned.spoilt() is None else np.full_like(self._forces, np.nan)

    @property
    def sides(self) -> list[bytes]:
        """What tells apart the smooth pieces of the forces in the last evaluation (see `sides.one_sided`)."""
        return self._last.sides if self.nonsmooth and self._last is not None else []

    @property
    def nonsmooth(self) -> bool:
        """Whether the forces are smooth in pieces only."""
        return self._constrained is not None or self._kinks is not None

    def accelerations(self, qpos: Array, qvel: Array, ctrl: Array | None = None) -> Array:
        """Return qacc for every row, (m, nv); `ctrl` (m, nu) gives smooth models rows with controls of their own."""
        self.count += len(qpos)
        if self.writer.failure:
            return np.full((len(qpos), self.model.nv), np.nan)
        if self._constrained is not None:
            return self._constrained.accelerations(qpos, qvel, self.writer)
        rows = self._rows(len(qpos))
        rows.forward(qpos, qvel, self.writer, ctrl)
        return rows.acceleration()

    def active(self, x: Array) -> frozenset[str]:
        """Return the names of the limits and contacts that carry load at rest, and of what `kinks` finds busy."""
        if self.writer.failure:
            return frozenset()
        if self._constrained is not None:
            self.count += 1
            return self._constrained.active(x, self.writer)
        if self._kinks is None:
            return frozenset()
        self.forces(x[None])
        return self._kinks.names(self.model, self._rows(1).codes[0])

    def position(self, x: Array) -> mujoco.MjData:
        """Return data of our own with everything that depends on position computed."""
        self.writer.inputs.put(self._data)
        self._data.qpos[:] = x
        with quiet:
            mujoco.mj_fwdPosition(self.model, self._data)
        return self._data

    def mass(self, x: Array) -> Array:
        """Return the mass matrix, (nv, nv); a soft constraint adds to it, since its force depends on acceleration."""
        n = self.model.nv
        if self.writer.failure:
            return np.full((n, n), np.nan)
        if self._constrained is not None:
            many = np.broadcast_to(x, (2 * n, len(x)))
            for h in _ACCELERATION_STEPS:
                self.count += 2 * n
                rows = self._constrained.forward(many, None, self.writer, h * np.concatenate([np.eye(n), -np.eye(n)]))
                if len(set(self._constrained.sides)) == 1:
                    break
            return (rows[n:] - rows[:n]).T / (2.0 * h)
        dense = np.empty((n, n))
        mujoco.mj_fullM(self.model, self.position(x), dense)
        return dense

    def damping(self, x: Array, scale: Array) -> Array:
        """Return -d forces/dv at rest, (nv, nv), centred: exact for linear dampers, and for drag that is quadratic.

        Where such a velocity releases a contact or saturates an actuator, smaller ones are taken. Of a model with
        nothing but dampers on joints, on tendons and along actuators the matrix is computed without differences.
        """
        if self._dampers is not None and not self.writer.failure:
            return self._dampers.matrix(self.position(x))
        for size in _DRAG_STEPS if self._drag else _VELOCITY_STEPS:
            found, smooth = self._damping(x, size * scale)
            if self._drag:
                found = 2.0 * found - self._damping(x, 2.0 * size * scale)[0]
            if smooth:
                break
        return found

    @property
    def _drag(self) -> bool:
        """Whether forces depend on velocity otherwise than linearly."""
        m = self.model
        return bool(m.opt.density) or any(
            p.any() for p in (m.dof_dampingpoly, m.tendon_dampingpoly, m.actuator_dampingpoly)
        )

    def _damping(self, x: Array, h: Array) -> tuple[Array, bool]:
        """Return -d forces/dv by steps `h`, and whether they stay on one smooth piece of the forces."""
        n = self.model.nv
        steps = np.concatenate([np.diag(h), -np.diag(h)])
        rows = self.forces(np.broadcast_to(x, (2 * n, len(x))), steps)
        return ((rows[n:] - rows[:n]) / (2.0 * h)[:, None]).T, len(set(self.sides)) <= 1


class Dampers:
    """Dampers on joints, on tendons and along actuators of one model, read from it whenever the matrix is asked for.

    The damping matrix of a passive model is the sum of c J'J over its dampers, without differences.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._moments = np.zeros((model.nactuator + model.ntendon, model.nv))

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Dampers | None:
        """Return the dampers of a model in which nothing else depends on velocity, or None."""
        off = int(model.opt.disableflags) & (int(_DISABLE.mjDSBL_ACTUATION) | int(_DISABLE.mjDSBL_DAMPER))
        return None if off or model.opt.disableactuator or not passive(model) else cls(model)

    def matrix(self, data: mujoco.MjData) -> Array:
        """Return C, (nv, nv), from data in which everything that depends on position is computed."""
        m, found = self._model, np.diag(self._model.dof_damping)
        along, on = m.actuator_damping - m.actuator_biasprm[:, 2], m.tendon_damping
        if along.any():
            moments = self._moments[: m.nactuator]
            where = data.moment_rownnz, data.moment_rowadr, data.moment_colind
            mujoco.mju_sparse2dense(moments, data.actuator_moment, *where)
            found += (moments.T * along) @ moments
        if on.any():
            moments = self._moments[m.nactuator :]
            mujoco.mju_sparse2dense(moments, data.ten_J, m.ten_J_rownnz, m.ten_J_rowadr, m.ten_J_colind)
            found += (moments.T * on) @ moments
        return found
