"""Velocities of a model's bodies by kinematic trees: coordinates of one move no body of another."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.numerics.equations.algebra import least_squares
from mjcont.numerics.equations.problem import Array


@dataclass(frozen=True, slots=True)
class Tree:
    """A tree's bodies (m,), its coordinates, and the velocities (6 m, n) of their centres of mass and rotations."""

    bodies: Array
    coordinates: slice
    jac: Array


def trees(model: mujoco.MjModel, data: mujoco.MjData) -> list[Tree]:
    """Return the trees of a model; `data` holds positions after `mj_kinematics` and `mj_comPos`."""
    found, whole = [], np.zeros((6, model.nv))
    for tree in range(model.ntree):
        bodies = np.flatnonzero(model.body_treeid == tree)
        own = np.flatnonzero(model.dof_treeid == tree)
        coordinates = slice(int(own[0]), int(own[-1]) + 1)
        jac = np.empty((len(bodies), 6, len(own)))
        for k, body in enumerate(bodies.tolist()):
            mujoco.mj_jacBodyCom(model, data, whole[:3], whole[3:], body)
            jac[k] = whole[:, coordinates]
        found.append(Tree(bodies, coordinates, jac.reshape(-1, len(own))))
    return found


def fitted(every: list[Tree], wanted: Array, count: int) -> tuple[Array, Array]:
    """Return tangent vectors (count, r) that move bodies most nearly as velocities (nbody, 6, r) ask, and the rest."""
    z, left = np.zeros((count, wanted.shape[2])), []
    for tree in every:
        moved = wanted[tree.bodies].reshape(len(tree.jac), -1)
        z[tree.coordinates] = least_squares(tree.jac, moved)
        left.append(tree.jac @ z[tree.coordinates] - moved)
    return z, np.concatenate([np.zeros((0, wanted.shape[2])), *left])


def turning(model: mujoco.MjModel, data: mujoco.MjData, origin: Array, axes: Array) -> Array:
    """Return the velocities of all bodies per twist about an origin along axes, the columns (3, 3), (nbody, 6, 6)."""
    moved = np.zeros((model.nbody, 6, 6))
    x, y, z = (data.xipos - origin).T
    arms = np.zeros((model.nbody, 3, 3))
    arms[:, 0, 1], arms[:, 0, 2], arms[:, 1, 0] = -z, y, z
    arms[:, 1, 2], arms[:, 2, 0], arms[:, 2, 1] = -x, -y, x
    moved[:, :3, :3] = moved[:, 3:, 3:] = axes
    moved[:, :3, 3:] = -arms @ axes
    return moved


def condensed(rows: Array) -> Array:
    """Return at most as many rows as there are columns, with the singular values and right vectors of all of them."""
    return rows if len(rows) <= rows.shape[1] else np.asarray(np.linalg.qr(rows, mode="r"))
