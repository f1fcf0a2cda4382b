"""Mass and dampers of a model as sparse matrices, from MuJoCo's own rows."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from scipy import sparse

from mjcont.numerics.equations.problem import Array


def mass(model: mujoco.MjModel, data: mujoco.MjData) -> Any:
    """Return the mass matrix, (nv, nv), from data in which everything that depends on position is computed."""
    lower = _rows(data.M, model.M_rownnz, model.M_rowadr, model.M_colind, model.nv)
    return (lower + sparse.tril(lower, -1).T).tocsc()


def dampers(model: mujoco.MjModel, data: mujoco.MjData, along: Array, on: Array) -> Any:
    """Return C, (nv, nv), of dampers at joints, along actuators (nactuator,) and on tendons (ntendon,)."""
    found = sparse.diags(model.dof_damping)
    if along.any():
        moments = _rows(
            data.actuator_moment, data.moment_rownnz, data.moment_rowadr, data.moment_colind, model.nv
        )
        found = found + moments.T @ sparse.diags(along) @ moments
    if on.any():
        moments = _rows(data.ten_J, model.ten_J_rownnz, model.ten_J_rowadr, model.ten_J_colind, model.nv)
        found = found + moments.T @ sparse.diags(on) @ moments
    return found.tocsc()


def _rows(values: Array, counts: Array, starts: Array, columns: Array, width: int) -> Any:
    """Return MuJoCo's rows, one after the other but not always without gaps, as a matrix of a number of columns."""
    counts = counts.ravel()
    places = np.repeat(starts.ravel() - np.cumsum(counts) + counts, counts) + np.arange(int(counts.sum()))
    pointers = np.concatenate([[0], np.cumsum(counts)])
    entries, where = values.ravel()[places], columns.ravel()[places]
    return sparse.csr_matrix((entries, where, pointers), shape=(len(counts), width))
