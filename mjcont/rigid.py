"""Rigid-body zero modes: motions of the whole model that no force opposes, such as a free body's translations.

Along such a motion every equilibrium is one of a continuum and K is singular everywhere. The modes are named, and
held by a stiffness and a damping of their own in K and C, so that they spoil neither Newton's method nor folds nor
stability; the residual is untouched, since it has no component along them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from mjcont.numerics.problem import Values

TWISTS = {
    "translation along x": (0, 0),
    "translation along y": (0, 1),
    "translation along z": (0, 2),
    "rotation about x": (1, 0),
    "rotation about y": (1, 1),
    "rotation about z": (1, 2),
}
_RIGID = 1e-9
_NOTHING = 1e-12


def twist_directions(model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, np.ndarray]:
    """Return the tangent vectors (nv,) that move the whole model as one rigid body, by name.

    `data` holds positions after `mj_kinematics` and `mj_comPos`. A twist that the joints do not allow is left out.
    """
    rows: list[np.ndarray] = []
    targets: dict[str, list[np.ndarray]] = {name: [] for name in TWISTS}
    jacp, jacr = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    for body in range(1, model.nbody):
        mujoco.mj_jacBodyCom(model, data, jacp, jacr, body)
        rows += [jacp.copy(), jacr.copy()]
        for name, (kind, axis) in TWISTS.items():
            unit = np.eye(3)[axis]
            linear = unit if kind == 0 else np.cross(unit, data.xipos[body])
            targets[name] += [linear, np.zeros(3) if kind == 0 else unit]
    stacked = np.concatenate(rows)
    found = {}
    for name, target in targets.items():
        wanted = np.concatenate(target)
        z = np.linalg.lstsq(stacked, wanted, rcond=None)[0]
        z[np.abs(z) < _NOTHING * np.abs(z).max()] = 0.0
        if np.linalg.norm(stacked @ z - wanted) < _RIGID * np.linalg.norm(wanted) and z.any():
            found[name] = z
    return found


def zero_modes(mechanism: Any, x: np.ndarray, values: Any) -> tuple[str, ...]:
    """Return the names of the rigid motions that no generalised force opposes anywhere near a state."""
    candidates = mechanism.rigid_directions(x)
    if not candidates:
        return ()
    jac = mechanism.linearize(x, values, ()).jac
    size = np.abs(jac).max() or 1.0
    generic = np.cos(1.0 + np.arange(mechanism.n))
    away = mechanism.retract(x, 0.1 * mechanism.state_scale * generic)
    found = []
    for name, z in candidates.items():
        unopposed = np.abs(jac @ z).max() <= 1e-7 * size * np.abs(z).max()
        far = mechanism.rigid_directions(away).get(name)
        if unopposed and far is not None:
            force = mechanism.residual(away, values)
            unopposed = abs(force @ far) <= 1e-9 * np.abs(force).max() * np.abs(far).max()
            if unopposed:
                found.append(name)
    return tuple(found)


def rate(jac: np.ndarray, mass: np.ndarray) -> float:
    """Return the frequency with which rigid modes are held, in rad/s: of the stiffest motion."""
    return float(np.sqrt(np.abs(jac).max() / np.abs(mass).max()))


def holding(mass: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return M Z (Z' M Z)^-1 Z' M for modes Z (nv, k): a stiffness that leaves all other modes as they are."""
    mz = mass @ z
    return mz @ np.linalg.solve(z.T @ mz, mz.T)


def without_modes(step: np.ndarray, mass: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return a tangent step (nv,) without its part along modes Z, orthogonal in the mass."""
    return step - z @ np.linalg.solve(z.T @ mass @ z, z.T @ (mass @ step))


def columns(directions: Mapping[str, np.ndarray], modes: Sequence[str], n: int) -> np.ndarray:
    """Return the tangent vectors of the modes that the joints allow, (n, number of them)."""
    found = [directions[m] for m in modes if m in directions]
    return np.column_stack(found) if found else np.zeros((n, 0))


def full_turns(problem: Any, x: np.ndarray, values: Values) -> np.ndarray:
    """Return a full turn for each coordinate in which one changes no force, infinity for the others, (nv,)."""
    found = np.full(problem.n, np.inf)
    hinges = [j for j, (_, unit) in enumerate(problem.state_labels) if unit == "rad" and problem.nq == problem.n]
    beside = problem.retract(x, 0.1 * problem.state_scale * np.cos(1.0 + np.arange(problem.n)))
    turns = 2.0 * np.pi * np.eye(problem.n)[hinges]
    rows = problem.residuals(beside, values, np.concatenate([np.zeros((1, problem.n)), turns]))
    change = np.abs(rows[1:] - rows[0]).max(axis=1, initial=0.0)
    for j, c in zip(hinges, change, strict=True):
        if c <= 1e-9 * np.abs(rows[0]).max():
            found[j] = 2.0 * np.pi
    return found
