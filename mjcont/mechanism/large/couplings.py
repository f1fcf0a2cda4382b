"""Which degrees of freedom of a model can act on which, by its structure: kinematic trees, tendons, actuators.

The force in coordinate i depends on coordinate j where both move one body, or bodies that one tendon or actuator joins:
what acts on a body acts through the coordinates that move it, along directions that these alone turn.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from scipy import sparse

from mjcont.numerics.equations.coloured import Coloured
from mjcont.numerics.equations.problem import Array

_TRANSMISSION, _WRAP = mujoco.mjtTrn, mujoco.mjtWrap
# matrices are sparse from so many degrees of freedom on, if no more than this part of their entries can be anything
MANY, _PART = 300, 0.05


def couplings(model: mujoco.MjModel) -> Coloured | None:
    """Return where K of a model without constraints can have entries; None where full matrices serve as well."""
    if model.nv < MANY or model.nflex or model.nplugin:
        return None
    moved = _moved(model)
    joined = _joined(model, moved) if moved is not None else None
    if joined is None:
        return None
    whole = sparse.vstack([moved, joined]).astype(np.int32).tocsr()
    pattern = (whole.T @ whole).tocsc()
    return Coloured.of(pattern) if pattern.nnz <= _PART * model.nv**2 else None


def _moved(model: mujoco.MjModel) -> Any | None:
    """Return which coordinates move each body, (nbody, nv); None where most move most, as in a chain."""
    moving = np.zeros(model.nbody, dtype=int)
    for body in range(1, model.nbody):
        moving[body] = moving[model.body_parentid[body]] + model.body_dofnum[body]
    if moving.sum() > _PART * model.nbody * model.nv:
        return None
    own: list[list[int]] = [[]]
    for body in range(1, model.nbody):
        first, count = int(model.body_dofadr[body]), int(model.body_dofnum[body])
        own.append([*own[model.body_parentid[body]], *range(first, first + count)])
    return _incidence(own, model.nv)


def _joined(model: mujoco.MjModel, moved: Any) -> Any | None:
    """Return which coordinates each tendon and actuator depends on, (elements, nv); None where that is not known."""
    tendons = _incidence([_tendon(model, t) for t in range(model.ntendon)], model.nbody) @ moved
    tendons = (tendons + _incidence([_joints(model, t) for t in range(model.ntendon)], model.nv)).tocsr()
    bodies, coordinates, pulled = [], [], []
    for a in range(model.nactuator):
        kind, (first, second) = _TRANSMISSION(model.actuator_trntype[a]), model.actuator_trnid[a].tolist()
        sites = [s for s in (first, second) if s >= 0]
        joint = kind in (_TRANSMISSION.mjTRN_JOINT, _TRANSMISSION.mjTRN_JOINTINPARENT)
        if not joint and kind not in (
            _TRANSMISSION.mjTRN_TENDON, _TRANSMISSION.mjTRN_SITE, _TRANSMISSION.mjTRN_SLIDERCRANK
        ):
            return None
        by_sites = not joint and kind != _TRANSMISSION.mjTRN_TENDON
        bodies.append(model.site_bodyid[sites].tolist() if by_sites else [])
        coordinates.append(_of_joint(model, first) if joint else [])
        pulled.append([first] if kind == _TRANSMISSION.mjTRN_TENDON else [])
    actuators = _incidence(bodies, model.nbody) @ moved + _incidence(coordinates, model.nv)
    if model.ntendon:
        actuators = actuators + _incidence(pulled, model.ntendon) @ tendons
    return sparse.vstack([tendons, actuators])


def _tendon(model: mujoco.MjModel, tendon: int) -> list[int]:
    """Return the bodies that a tendon runs along."""
    found = []
    for w in range(model.tendon_adr[tendon], model.tendon_adr[tendon] + model.tendon_num[tendon]):
        kind, index = model.wrap_type[w], int(model.wrap_objid[w])
        if kind == int(_WRAP.mjWRAP_SITE):
            found.append(int(model.site_bodyid[index]))
        elif kind in (int(_WRAP.mjWRAP_SPHERE), int(_WRAP.mjWRAP_CYLINDER)):
            found.append(int(model.geom_bodyid[index]))
    return found


def _joints(model: mujoco.MjModel, tendon: int) -> list[int]:
    """Return the coordinates that a tendon over joints adds up."""
    path = slice(model.tendon_adr[tendon], model.tendon_adr[tendon] + model.tendon_num[tendon])
    over = model.wrap_objid[path][model.wrap_type[path] == int(_WRAP.mjWRAP_JOINT)]
    return [i for j in over.tolist() for i in _of_joint(model, j)]


def _of_joint(model: mujoco.MjModel, joint: int) -> list[int]:
    first = int(model.jnt_dofadr[joint])
    last = int(model.jnt_dofadr[joint + 1]) if joint + 1 < model.njnt else model.nv
    return list(range(first, last))


def _incidence(rows: list[list[int]], width: int) -> Any:
    """Return a matrix with ones in the columns that each row lists."""
    pointers = np.cumsum([0, *map(len, rows)])
    columns: Array = np.array([c for row in rows for c in row], dtype=np.int32)
    return sparse.csr_matrix((np.ones(len(columns), np.int32), columns, pointers), shape=(len(rows), width))
