"""Forces of a model that nothing constrains, in MuJoCo's stages, one state at a time.

`mj_forward` makes and factorises the mass matrix, which costs a chain of n links n^3 and each row of a batch n^2 of
memory. Forces need neither, and the forces that a given motion leaves, f - M a, need no factors.
"""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.mechanism.writer import FieldWriter
from mjcont.models.quiet import Warned
from mjcont.numerics.equations.problem import Array

# from so many degrees of freedom on, calls from Python cost less than the mass matrix does
LARGE = 64


class Stages:
    """Evaluates states one after the other, with data of its own."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model, self._data = model, mujoco.MjData(model)
        self._warned = Warned(self._data)

    def forces(
        self,
        qpos: Array,
        qvel: Array | None,
        writer: FieldWriter,
        ctrl: Array | None = None,
        qacc: Array | None = None,
    ) -> Array:
        """Return f - M a for every row, (m, nv), with the writer's inputs.

        Velocities (m, nv) and accelerations a (m, nv) are zero unless given, controls (m, nu) the writer's. Rows that
        MuJoCo cannot evaluate so are NaN.
        """
        m, d = self._model, self._data
        out, inertial = np.empty((len(qpos), m.nv)), np.zeros(m.nv)
        writer.inputs.put(d)
        for i, x in enumerate(qpos):
            d.qpos[:] = x
            d.qvel[:] = 0.0 if qvel is None else qvel[i]
            if ctrl is not None:
                d.ctrl[:] = ctrl[i]
            self._locate(qacc is not None)
            mujoco.mj_fwdVelocity(m, d)
            mujoco.mj_fwdActuation(m, d)
            np.subtract(d.qfrc_passive, d.qfrc_bias, out=out[i])  # in the order in which mj_forward adds them
            out[i] += d.qfrc_actuator
            if qacc is not None:
                mujoco.mj_mulM(m, d, inertial, qacc[i])
                out[i] -= inertial
            if self._warned.spoilt() is not None:
                out[i] = np.nan
        return out

    def _locate(self, with_mass: bool) -> None:
        """Compute what forces need of the position, and the mass matrix where it is asked for."""
        m, d = self._model, self._data
        mujoco.mj_kinematics(m, d)
        mujoco.mj_comPos(m, d)
        if m.nflex:
            mujoco.mj_flex(m, d)
        mujoco.mj_tendon(m, d)
        if with_mass:
            mujoco.mj_makeM(m, d)
        mujoco.mj_transmission(m, d)

    def accelerations(self, qpos: Array, qvel: Array, writer: FieldWriter, ctrl: Array | None = None) -> Array:
        """Return qacc for every row, (m, nv), with the writer's controls or those given, (m, nu)."""
        m, d = self._model, self._data
        out = np.empty((len(qpos), m.nv))
        writer.inputs.put(d)
        for i, x in enumerate(qpos):
            d.qpos[:], d.qvel[:] = x, qvel[i]
            if ctrl is not None:
                d.ctrl[:] = ctrl[i]
            mujoco.mj_forward(m, d)
            out[i] = d.qacc if self._warned.spoilt() is None else np.nan
        return out
