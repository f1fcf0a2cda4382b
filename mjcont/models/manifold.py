"""The poses of a model as a manifold: a pose moved by a tangent step, and the step between two poses."""

from __future__ import annotations

import mujoco
import numpy as np

from mjcont.models.states import coordinates_are_flat, element_name
from mjcont.numerics.equations.problem import Array
from mjcont.results.orbits.charts import Chart

# joints with a quaternion, and how many entries stand before it in a pose and before its rotation in a tangent step
_TURNING = {int(mujoco.mjtJoint.mjJNT_BALL): 0, int(mujoco.mjtJoint.mjJNT_FREE): 3}


def chart_of(model: mujoco.MjModel) -> Chart | None:
    """Return coordinates for the poses of a model, with qpos0 as reference; None where poses are vectors."""
    joints = [j for j in range(model.njnt) if model.jnt_type[j] in _TURNING]
    if not joints:
        return None
    before = [_TURNING[model.jnt_type[j]] for j in joints]
    places = np.column_stack([model.jnt_qposadr[joints] + before, model.jnt_dofadr[joints] + before])
    names = tuple(element_name(model, mujoco.mjtObj.mjOBJ_JOINT, j) for j in joints)
    return Chart(names, places, np.zeros((len(joints), 4))).about(model.qpos0)


class Manifold:
    """Poses (nq,) of a model and tangent steps (nv,): vectors, but for the quaternions of ball and free joints."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model, self._nq, self._n = model, int(model.nq), int(model.nv)
        self._flat = coordinates_are_flat(model)

    def retract(self, x: Array, step: Array) -> Array:
        """Return a pose moved by a tangent step, quaternions normalised."""
        if self._flat:
            return x + step
        moved = x.copy()
        mujoco.mj_integratePos(self._model, moved, step, 1.0)
        return moved

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step from x0 to x1."""
        if self._flat:
            return x1 - x0
        step = np.empty(self._n)
        mujoco.mj_differentiatePos(self._model, step, 1.0, x0, x1)
        return step

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return the tangent steps (m, nv) that take poses (m, nq), or one (nq,), to others."""
        if self._flat:
            return ends - starts
        ends, starts = np.broadcast_arrays(ends, starts)
        steps = [self.difference(b, a) for b, a in zip(ends, starts, strict=True)]
        return np.array(steps).reshape(len(steps), self._n)

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return poses (m, nq), or one (nq,), moved by the rows of tangent steps (m, nv)."""
        if self._flat:
            return states + steps
        every = np.broadcast_to(states, (len(steps), self._nq))
        moved = [self.retract(x, s) for x, s in zip(every, steps, strict=True)]
        return np.array(moved).reshape(len(moved), self._nq)


class OnManifold:
    """A problem whose states are poses of a model."""

    _manifold: Manifold

    def retract(self, x: Array, step: Array) -> Array:
        """Return qpos moved by a tangent step, quaternions normalised."""
        return self._manifold.retract(x, step)

    def difference(self, x1: Array, x0: Array) -> Array:
        """Return the tangent step (nv,) from x0 to x1."""
        return self._manifold.difference(x1, x0)

    def difference_each(self, ends: Array, starts: Array) -> Array:
        """Return the tangent steps (m, nv) that take states (m, nq), or one (nq,), to others."""
        return self._manifold.difference_each(ends, starts)

    def retract_each(self, states: Array, steps: Array) -> Array:
        """Return states (m, nq), or one (nq,), moved by the rows of tangent steps (m, nv)."""
        return self._manifold.retract_each(states, steps)
