"""How df/dx and df/dp bend: their derivatives along one direction, seen through left vectors.

Second derivatives do not depend on the order in which they are taken, so that the gradient of w . J v over all unknowns
is the derivative of w'[J f_p] along v: a few evaluations of the Jacobian, whatever the number of unknowns.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse

from mjcont.numerics.equations.differences import CENTRED, FIRST, NODES, SECOND
from mjcont.numerics.equations.problem import Array
from mjcont.numerics.equations.system import Local, System

# step of the differences, in scaled unknowns
_STEP = 1e-2
_RULES = {1: (NODES[NODES != 0.0], FIRST[NODES != 0.0]), 2: (NODES, SECOND)}
_CENTRED = np.array(CENTRED.offsets), np.array(CENTRED.weights)


def bends_itself(local: Local) -> bool:
    """Whether Jacobians are cheap beside 4 n evaluations of f, and accurate enough to take differences of them."""
    return not local.problem.second_order and (local.problem.own_jacobian or sparse.issparse(local.jac))


def reach_of(local: Local, along: Array) -> float:
    """Return the largest component of a scaled direction in units of its typical size."""
    return float(np.abs(along * local.problem.state_scale / local.problem.typical).max())


def bend(
    local: Local, system: System, y: Array, left: Array, along: Array, *, order: int = 1, step: float | None = None
) -> Array:
    """Return a derivative along a direction of left' [J f_p] over scaled unknowns, (..., n + number free).

    Parameters
    ----------
    left : (n,) or (r, n), over the equations of f.
    along : (n,) scaled direction.
    order : 1 or 2, by differences of sixth order.
    step : the length of one centred difference instead, in parts of `along`, which may be (n + number free,) then.
    """
    n, count = system.n, len(system.free)
    whole = np.zeros(n + system.k)
    whole[: len(along)] = along
    nodes, weights = _RULES[order] if step is None else _CENTRED
    h = _STEP / max(reach_of(local, along), 1e-300) if step is None else step
    total = np.zeros((*left.shape[:-1], n + count), dtype=left.dtype)
    for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
        x, moved = system.move(local.x, y, node * h * whole)
        beside = Local(system.problem, x, system.values(moved), system.names, False, system.ranges)
        slopes = np.array([p.slope(u) for p, u in zip(system.free, moved, strict=False)])
        total[..., :n] += weight * (beside.jac.T @ left.T).T
        total[..., n:] += weight * (left @ beside.par) * slopes
    return total / np.float64(h) ** order
