"""The damping matrix of a model whose dampers are known in closed form: C = sum of c J'J, without differences.

Dampers sit on joints, on tendons and along actuators. An actuator's force g(l, v) u + b(l, v), of the length l, its
velocity v and the input u, resists with c = -(dg/dv u + db/dv). An affine gain or bias says so itself. A muscle's gain
is -F_0 FL(l) FV(V), with V = v / (L_0 v_max), FV(0) = 1 and FV'(0) = 2 on either side of rest, whatever its fvmax.
"""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.features import explicit_damping
from mjcont.numerics.problem import Array

_DISABLE = mujoco.mjtDisableBit
# MuJoCo's own guard of a denominator
_SHORTEST = mujoco.mjMINVAL


class Dampers:
    """Dampers on joints, on tendons and along actuators of one model, read from it whenever the matrix is asked for."""

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
