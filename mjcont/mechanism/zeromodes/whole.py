"""Rigid-body zero modes: motions of the whole model that no force opposes, such as a free body's translations.

Along such a motion every equilibrium is one of a continuum and K is singular everywhere. The modes are named, and
held by a stiffness and a damping of their own in K and C, so that they spoil neither Newton's method nor folds nor
stability; the residual is untouched, since it has no component along them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from itertools import islice
from typing import Any

import mujoco
import numpy as np

from mjcont.mechanism.zeromodes.trees import condensed, fitted, trees, turning
from mjcont.numerics.equations.algebra import least_squares, singular, solve
from mjcont.numerics.equations.problem import Values

_AXES = "xyz"
NAMES = [f"translation along {a}" for a in _AXES] + [f"rotation about {a}" for a in _AXES]
_THROUGH = re.compile(r"(rotation about [xyz]) through \((.*)\)")
_RIGID = 1e-9
_NOTHING = 1e-12
_SAME = 1e-6
# components of a unit twist that are rounding
_ROUNDS = 1e-9
_STATES, _TURNED = 12, 2
# states after which it may be plain already that something opposes every motion
_EARLY = (0, 3, 6)
_STIFF = 1e-5  # a soft constraint stiffens with its violation, which differences see as a force


def twist(name: str) -> np.ndarray:
    """Return the velocity of the origin and the angular velocity of a named motion, (6,)."""
    through = _THROUGH.fullmatch(name)
    unit = np.eye(6)[NAMES.index(through[1] if through else name)]
    if through:
        unit[:3] = np.cross([float(c) for c in through[2].split(",")], unit[3:])
    return unit


def directions(model: mujoco.MjModel, data: mujoco.MjData, names: Iterable[str]) -> dict[str, np.ndarray]:
    """Return the tangent vectors (nv,) that move all moving bodies as one rigid body, by name.

    `data` holds positions after `mj_kinematics` and `mj_comPos`. A motion that the joints do not allow is left out.
    """
    every, moved, found = trees(model, data), _rigid(model, data), {}
    for name in names:
        wanted = moved @ twist(name)[:, None]
        fit, left = fitted(every, wanted, model.nv)
        z = fit[:, 0]
        z[np.abs(z) < _NOTHING * np.abs(z).max()] = 0.0
        size = np.linalg.norm(wanted[model.body_treeid >= 0])
        if np.linalg.norm(left) < _RIGID * size and z.any():
            found[name] = z
    return found


def _rigid(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """Return the velocities of all bodies per twist of the whole model, (nbody, 6, 6)."""
    return turning(model, data, np.zeros(3), np.eye(3))


def _stacked(barred: list[np.ndarray], work: list[np.ndarray], largest: float) -> np.ndarray:
    """Return what opposes the six rigid motions: velocities that the joints bar, and forces."""
    return condensed(np.concatenate([*barred, np.array(work) / (largest or 1.0)]))


def _least(barred: list[np.ndarray], work: list[np.ndarray], largest: float) -> float:
    """Return a lower bound of the least singular value of what opposes rigid motions, for forces ten times as large."""
    return float(singular(_stacked(barred, work, 10.0 * largest))[1][-1])


def zero_modes(
    mechanism: Any,
    model: mujoco.MjModel,
    position: Any,
    x: np.ndarray,
    values: Any,
    among: Iterable[str] | None = None,
) -> tuple[str, ...]:
    """Return the names of the rigid motions that no generalised force opposes anywhere near a state.

    With J z = B t the bodies move by the twist t. Zero modes are the twists that the joints allow, (1 - J J+) B t = 0,
    and along which no force acts, f . J+ B t = 0, in all of a number of states.

    Parameters
    ----------
    position : callable that returns MuJoCo's data at a state.
    among : names of motions to try, instead of all.
    """
    barred, work, largest = [], [], 0.0
    for k in range(_STATES):
        step = 0.1 * mechanism.state_scale * np.cos(1.0 + k + (1 + k) * np.arange(mechanism.n)) if k else None
        beside = x if step is None else mechanism.retract(x, step)
        force = mechanism.residual(beside, values)
        data = position(beside)
        if not model.ntree:
            return ()
        moved = _rigid(model, data)
        z, left = fitted(trees(model, data), moved, model.nv)
        barred.append(condensed(left / np.abs(moved[model.body_treeid >= 0]).max()))
        work.append(force @ z / (np.abs(z).max() or 1.0))
        largest = max(largest, np.abs(force).max())
        if among is None and k in _EARLY and _least(barred, work, largest) > _RIGID:
            return ()  # what opposes every motion here does so whatever other states add
    opposed = _stacked(barred, work, largest)
    if among is None:
        _, sizes, vh = singular(opposed)
        names = _named(vh[sizes <= _RIGID])
    else:
        names = [n for n in among if np.linalg.norm(opposed @ twist(n)) <= _SAME]
    return tuple(name for name in names if _unopposed(mechanism, model, position, x, values, name))


def _named(free: np.ndarray) -> list[str]:
    """Return names of motions that span the twists `free` (k, 6), orthonormal rows: about points where need be."""
    found: list[str] = []
    free = np.where(np.abs(free) > _ROUNDS, free, 0.0)  # a translation is no rotation about a point far away
    for i, name in enumerate(NAMES):
        unit = np.eye(6)[i]
        if np.linalg.norm(unit - free.T @ (free @ unit)) < _SAME:
            found.append(name)
        elif i >= 3 and len(found) < len(free):
            weights = least_squares(free[:, 3:].T, unit[3:])
            whole = free.T @ weights
            point = np.cross(unit[3:], whole[:3])
            if np.linalg.norm(np.concatenate([np.cross(point, unit[3:]), unit[3:]]) - whole) < _SAME:
                found.append(f"{name} through ({', '.join(f'{c + 0.0:.9g}' for c in np.round(point, 9))})")
    return found


def _unopposed(mechanism: Any, model: mujoco.MjModel, position: Any, x: np.ndarray, values: Any, name: str) -> bool:
    """Whether the forces do not change along a motion, but for turning with it."""
    z = directions(model, position(x), [name]).get(name)
    return z is not None and leaves_forces(mechanism, x, values, z)


def leaves_forces(mechanism: Any, x: np.ndarray, values: Any, z: np.ndarray) -> bool:
    """Whether forces do not change along a tangent vector z, (nv,), but for turning with it."""
    local = mechanism.linearize(x, values, ())
    turned = 2.0 * np.abs(local.f).max()
    return bool(np.abs(local.jac @ z).max() <= (_STIFF * (np.abs(local.jac).max() or 1.0) + turned) * np.abs(z).max())


def rate(jac: np.ndarray, mass: np.ndarray) -> float:
    """Return the frequency with which rigid modes are held, in rad/s: of the stiffest motion."""
    return float(np.sqrt(np.abs(jac).max() / np.abs(mass).max()))


def holding(mass: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return M Z (Z' M Z)^-1 Z' M for modes Z (nv, k): a stiffness that leaves all other modes as they are."""
    mz = mass @ z
    return mz @ solve(z.T @ mz, mz.T)


def without_modes(step: np.ndarray, mass: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Return a tangent step (nv,) without its part along modes Z, orthogonal in the mass."""
    return step - z @ solve(z.T @ mass @ z, z.T @ (mass @ step))


def _hinges(labels: Sequence[tuple[str, str]]) -> list[int]:
    """Return the tangent coordinates of hinges from the name and unit of each entry of a state."""
    found, tangent, entries = [], 0, iter(labels)
    for name, unit in entries:
        if name.endswith(".q0"):  # a quaternion: four entries, three coordinates
            tangent += 3
            list(islice(entries, 3))
            continue
        if unit == "rad":
            found.append(tangent)
        tangent += 1
    return found


def full_turns(problem: Any, x: np.ndarray, values: Values) -> np.ndarray:
    """Return a full turn for each coordinate in which one changes no force, infinity for the others, (nv,)."""
    found = np.full(problem.n, np.inf)
    hinges = _hinges(problem.state_labels)
    turns = 2.0 * np.pi * np.eye(problem.n)[hinges]
    change, largest = np.zeros(len(hinges)), 0.0
    for k in range(_TURNED):  # one of several states: f may vanish in any one of them
        beside = problem.retract(x, (0.1 + 0.3 * k) * problem.state_scale * np.cos(1.0 + k + np.arange(problem.n)))
        rows = problem.residuals(beside, values, np.concatenate([np.zeros((1, problem.n)), turns]))
        change = np.maximum(change, np.abs(rows[1:] - rows[0]).max(axis=1, initial=0.0))
        largest = max(largest, float(np.abs(rows[0]).max()))
    found[[j for j, c in zip(hinges, change, strict=True) if c <= 1e-9 * largest]] = 2.0 * np.pi
    return found
