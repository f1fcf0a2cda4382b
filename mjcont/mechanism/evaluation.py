"""Evaluating a model: forces, accelerations, mass and damping at many states, counted."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
from scipy import sparse

from mjcont.mechanism.batches import ConstrainedRows, Rows
from mjcont.mechanism.kinks import Kinks
from mjcont.mechanism.large import matrices
from mjcont.mechanism.large.stages import LARGE, Stages
from mjcont.mechanism.writer import FieldWriter
from mjcont.models.actuators import is_bush, pin_slides
from mjcont.models.features import explicit_damping, linear_in_velocity
from mjcont.models.quiet import Warned, quiet
from mjcont.numerics.equations.clock import check
from mjcont.numerics.equations.problem import Array

_DISABLE = mujoco.mjtDisableBit
# MuJoCo's own guard of a denominator
_SHORTEST = mujoco.mjMINVAL
_MAX_BATCHES = 32
_ACCELERATION_STEPS = (1e-3, 1e-6)
_VELOCITY_STEPS = (1.0, 1e-3, 1e-6)
# after unit speed, for forces that are curved in velocity: until each entry of C is known to this part of the dampers
# of its row and column
_FINER_SPEEDS, _KNOWN = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7), 1e-7


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
        self._own_dampers = Dampers.of(model)
        self._dampers = None if self.nonsmooth else self._own_dampers
        self._stages = None if self.nonsmooth else Stages(model)
        self._large = None if model.nv < LARGE else self._stages
        self._batches: dict[int, Rows] = {}
        self._data = mujoco.MjData(model)
        self._warned = Warned(self._data)
        self._forces = self._data.qfrc_smooth[None]

    def counted(self, count: int) -> None:
        """Count evaluations made elsewhere."""
        self.count += count

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
        check()
        self.count += len(qpos)
        if self.writer.failure:  # no model there: a curve ends, as one does where a function leaves its domain
            return np.full((len(qpos), self.model.nv), np.nan)
        if self._constrained is not None:
            return self._constrained.forward(qpos, qvel, self.writer)
        if self._large is not None:
            return self._large.forces(qpos, qvel, self.writer, ctrl)
        if len(qpos) == 1 and qvel is None and self._kinks is None and ctrl is None:
            return self._single(qpos[0])
        rows = self._last = self._rows(len(qpos))
        return rows.forward(qpos, qvel, self.writer, ctrl)

    def left_forces(self, qpos: Array, qvel: Array, qacc: Array) -> Array:
        """Return f - M a of a model whose forces are smooth, for motions with velocities and accelerations, (m, nv)."""
        check()
        self.count += len(qpos)
        if self.writer.failure or self._stages is None:
            return np.full((len(qpos), self.model.nv), np.nan)
        return self._stages.forces(qpos, qvel, self.writer, qacc=qacc)

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
    def structured(self) -> bool:
        """Whether what can act on what is known as long as no constraint is near."""
        return self._kinks is None and not self.model.neq

    @property
    def unconstrained(self) -> bool:
        """Whether no constraint was near in any row of the last evaluation."""
        return self._constrained is None or self._constrained.idle

    @property
    def one_by_one(self) -> bool:
        """Whether rows are evaluated one after the other, all with the writer's inputs."""
        return self._constrained is not None

    @property
    def nonsmooth(self) -> bool:
        """Whether the forces are smooth in pieces only."""
        return self._constrained is not None or self._kinks is not None

    def accelerations(
        self, qpos: Array, qvel: Array, ctrl: Array | None = None, act: Array | None = None
    ) -> Array:
        """Return qacc for every row, (m, nv); `ctrl` (m, nu) gives smooth models rows with controls of their own.

        `act` (m, followers) are activations that follow a control: their rates then stand beside qacc.
        """
        self.count += len(qpos)
        if self.writer.failure:
            return np.full((len(qpos), self.model.nv + (0 if act is None else act.shape[1])), np.nan)
        if self._constrained is not None:
            return self._constrained.accelerations(qpos, qvel, self.writer, act)
        if self._large is not None and act is None:
            return self._large.accelerations(qpos, qvel, self.writer, ctrl)
        rows = self._last = self._rows(len(qpos))
        if act is None:
            rows.forward(qpos, qvel, self.writer, ctrl)
            return rows.acceleration()
        changes = rows.field("act_dot")
        rows.forward(qpos, qvel, self.writer, ctrl, act)
        return np.hstack([rows.acceleration(), changes[:, self.writer.inputs.following]])

    def touched(self, count: int) -> list[frozenset[str]]:
        """Return the names of what was busy in each of the first `count` rows of the last accelerations."""
        if self._constrained is not None:
            return self._constrained.touched[:count]
        if self._kinks is None or not isinstance(self._last, Rows):
            return []
        kinks, codes = self._kinks, self._last.codes[:count]
        return [kinks.names(self.model, row) for row in codes]

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

    def connections(self, x: Array) -> Array:
        """Return gradients (r, nv): of every bush, equality, and limit or contact that carries load at rest."""
        m, data = self.model, self.position(x)
        moments = np.zeros((m.nactuator, m.nv))
        if m.nactuator:
            where = data.moment_rownnz, data.moment_rowadr, data.moment_colind
            mujoco.mju_sparse2dense(moments, data.actuator_moment, *where)
        bushes = [i for i in range(m.nactuator) if is_bush(m, i)]
        carrying = self._constrained.connections(x, self.writer) if self._constrained is not None else []
        return np.vstack([moments[bushes], np.eye(m.nv)[pin_slides(m)], *carrying])

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

    def sparse_matrices(self, x: Array, scale: Array) -> tuple[Any, Any]:
        """Return mass and damping as sparse matrices, (nv, nv) each: the model's own while no constraint is near."""
        if self._constrained is not None:
            self.forces(x[None])
        if self.writer.failure or not self.unconstrained:
            return sparse.csc_matrix(self.mass(x)), sparse.csc_matrix(self.damping(x, scale))
        data = self.position(x)
        inertia = matrices.mass(self.model, data)
        if self._own_dampers is not None:
            return inertia, self._own_dampers.sparse_matrix(data)
        return inertia, sparse.csc_matrix(self.damping(x, scale))

    def damping(self, x: Array, scale: Array) -> Array:
        """Return -d forces/dv at rest, (nv, nv).

        It is computed without differences where dampers on joints, on tendons and along actuators are all, by unit
        steps where forces are linear in velocity (smaller ones where those release a contact or saturate an actuator),
        and by extrapolation elsewhere.
        """
        if self._dampers is not None and not self.writer.failure:
            return self._dampers.matrix(self.position(x))
        if linear_in_velocity(self.model):
            for size in _VELOCITY_STEPS:
                found, smooth = self._damping(x, size * scale)
                if smooth:
                    break
            return found
        return settled(lambda size: self._damping(x, size * scale))

    def _damping(self, x: Array, h: Array) -> tuple[Array, bool]:
        """Return -d forces/dv by steps `h`, and whether they stay on one smooth piece of the forces."""
        n = self.model.nv
        steps = np.concatenate([np.diag(h), -np.diag(h)])
        rows = self.forces(np.broadcast_to(x, (2 * n, len(x))), steps)
        return ((rows[n:] - rows[:n]) / (2.0 * h)[:, None]).T, len(set(self.sides)) <= 1


class Dampers:
    """Dampers of one model where they are known in closed form: C = sum of c J'J, without differences.

    They sit on joints, on tendons and along actuators. An actuator's force g(l, v) u + b(l, v), of the length l, its
    velocity v and the input u, resists with c = -(dg/dv u + db/dv). An affine gain or bias says so itself. A muscle's
    gain is -F_0 FL(l) FV(V), with V = v / (L_0 v_max), FV(0) = 1 and FV'(0) = 2 on either side of rest, whatever its
    fvmax. All is read from the model whenever the matrix is asked for.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._moments = np.zeros((model.nactuator + model.ntendon, model.nv))
        self._varying = np.flatnonzero(model.actuator_gaintype != int(mujoco.mjtGain.mjGAIN_FIXED))

    @classmethod
    def of(cls, model: mujoco.MjModel) -> Dampers | None:
        """Return the dampers of a model in which nothing else depends on velocity, or None."""
        off = int(model.opt.disableflags) & (int(_DISABLE.mjDSBL_ACTUATION) | int(_DISABLE.mjDSBL_DAMPER))
        return None if off or model.opt.disableactuator or not explicit_damping(model) else cls(model)

    def matrix(self, data: mujoco.MjData) -> Array:
        """Return C, (nv, nv), from data in which everything that depends on position is computed."""
        m, found = self._model, np.diag(self._model.dof_damping)
        along, on = m.actuator_damping + self._laws(data), m.tendon_damping
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

    def sparse_matrix(self, data: mujoco.MjData) -> Any:
        """Return C as `matrix` does, sparse."""
        along = self._model.actuator_damping + self._laws(data)
        return matrices.dampers(self._model, data, along, self._model.tendon_damping)

    def _laws(self, data: mujoco.MjData) -> Array:
        """Return the damping constants of actuators from their gains and biases, (nactuator,)."""
        m = self._model
        found = np.where(m.actuator_biastype == int(mujoco.mjtBias.mjBIAS_AFFINE), -m.actuator_biasprm[:, 2], 0.0)
        for a in self._varying:
            prm, at = m.actuator_gainprm[a], int(m.actuator_actadr[a])
            slope = prm[2]
            if m.actuator_gaintype[a] == int(mujoco.mjtGain.mjGAIN_MUSCLE):
                reach, acc0 = m.actuator_lengthrange[a], m.actuator_acc0[a]
                gain = mujoco.mju_muscleGain(data.actuator_length[a], 0.0, reach, acc0, prm[:9])
                slope = 2.0 * gain * (prm[1] - prm[0]) / (max(reach[1] - reach[0], _SHORTEST) * max(prm[6], _SHORTEST))
            found[a] -= slope * (data.act[at] if at >= 0 else data.ctrl[m.actuator_ctrladr[a]])
        return found


def settled(matrix: Callable[[float], tuple[Array, bool]]) -> Array:
    """Return the limit for small steps of a difference matrix, entry by entry where its error is least.

    An entry that a unit step tells exactly (a linear damper, however stiff) is taken from that, any other one from
    steps tenfold finer each time, whose first-order error (a muscle's force is curved otherwise on either side of
    rest) is taken out by extrapolation. The change from one estimate to the next is the error of both.

    Parameters
    ----------
    matrix : from the size of a step to the matrix, and whether the step stays on one smooth piece of the forces.
    """
    unit, smooth = matrix(1.0)
    last, fine = matrix(_FINER_SPEEDS[0])
    best, error = (unit, np.abs(unit - last)) if smooth else (last, np.full(last.shape, np.inf))
    estimate = None
    for size in _FINER_SPEEDS[1:]:
        here, smooth = matrix(size)
        finer = (10.0 * here - last) / 9.0 if fine else here
        change = np.abs(finer - (last if estimate is None else estimate))
        better = change < error if fine else np.full(here.shape, True)
        best, error = np.where(better, finer, best), np.where(better, change if fine else np.inf, error)
        last, fine, estimate = here, smooth, finer
        dampers = np.sqrt(np.abs(np.diag(best)))
        if fine and np.all(error <= _KNOWN * np.outer(dampers, dampers)):
            break
    return best
