"""The damping matrix of a passive model from its dampers: C = sum of c J'J, without differences."""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.models.features import passive
from mjcont.numerics.equations.problem import Array

_DISABLE = mujoco.mjtDisableBit


class Dampers:
    """Dampers on joints, on tendons and along actuators of one model, read from it whenever the matrix is asked for."""

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
