"""Free motions of parts: a wheel on its axle, a rod between two balls, a block on a rail, that no force opposes.

They are found and held as those of the whole model are (`whole`). A part is a body, or a body with all that it carries;
its motions are twists in its own frame, since an axle moves with what bears it. What hangs from a ball joint, or
floats, may also turn about an axis of the ground, such as the vertical, wherever its bearer goes.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, Self

import mujoco
import numpy as np

from mjcont.mechanism.core import Core
from mjcont.mechanism.zeromodes import whole as rigid
from mjcont.mechanism.zeromodes.trees import condensed, fitted, trees, turning
from mjcont.numerics.equations.algebra import least_squares, singular
from mjcont.numerics.equations.problem import Array, Values

_MODE = re.compile(
    r"(rotation|translation) of (.*) (?:about|along) (the ground's )?\(([^()]*)\)(?: through \(([^()]*)\))?"
)
_CARRIES, _GROUND = " and what it carries", "the ground's "
_ROUND = (mujoco.mjtJoint.mjJNT_BALL, mujoco.mjtJoint.mjJNT_FREE)
_RIGID, _SAME = 1e-9, 1e-6
_STATES = 12


@dataclass(slots=True)
class _Part:
    """A part of a model, and what opposes its six twists, as far as states have told.

    Attributes
    ----------
    name : of its first body, with `_CARRIES` where it is more than that.
    root : its first body.
    inside : (nbody,) whether a body belongs to it.
    bodies : its first body, and those that hang from it without belonging to it: their joints alone can give way.
    joint : the ball or free joint of its first body, if its twists are about that in the axes of the ground; else -1.
    barred, work : for each state, velocities that the joints do not allow (k, 6), and power of the forces (6,).
    """

    name: str
    root: int
    inside: Array
    bodies: Array
    joint: int = -1
    barred: list[Array] = field(default_factory=list)
    work: list[Array] = field(default_factory=list)

    def opposed(self, largest: float) -> Array:
        """Return what opposes it, velocities that are barred and forces, for forces of a largest size."""
        return condensed(np.concatenate([*self.barred, np.array(self.work) / (largest or 1.0)]))


def zero_modes(
    mechanism: Any,
    model: mujoco.MjModel,
    position: Any,
    x: Array,
    values: Values,
    whole: Sequence[str],
    among: Iterable[str] | None = None,
) -> tuple[str, ...]:
    """Return the names of the motions of parts that no generalised force opposes near a state.

    Arguments are those of `rigid.zero_modes`; `whole` are the zero modes of the whole model.
    """
    found = _parts(model) if among is None else [p for p in _parts(model) if any(_of(p, name) for name in among)]
    largest = 0.0
    for k in range(_STATES):
        if not found:
            return ()
        step = 0.1 * mechanism.state_scale * np.cos(1.0 + k + (1 + k) * np.arange(mechanism.n))
        beside = mechanism.retract(x, step) if k else x
        force = mechanism.residual(beside, values)
        largest = max(largest, float(np.abs(force).max()))
        found = _look(model, position(beside), force, found, largest)
    modes: list[str] = []
    for part in found:
        opposed = part.opposed(largest)
        if among is None:
            _, sizes, vh = singular(opposed)
            names = _named(part, vh[sizes <= _RIGID])
        else:
            names = [n for n in among if _of(part, n) and np.linalg.norm(opposed @ _twist(n)) <= _SAME]
        for name in names:
            z = _direction(model, position(x), [*whole, *modes], name)
            if z is not None and rigid.leaves_forces(mechanism, x, values, z):
                modes.append(name)
    return tuple(modes)


def directions(model: mujoco.MjModel, data: mujoco.MjData, names: Iterable[str]) -> dict[str, Array]:
    """Return the tangent vectors (nv,) along motions of parts, by name; what the joints do not allow is left out."""
    if not (wanted := list(names)):
        return {}
    every, found = trees(model, data), {}
    parts = _parts(model)
    for name in wanted:
        part = next(p for p in parts if _of(p, name))
        moved = _moved(model, data, part) @ _twist(name)[:, None]
        fit, left = fitted(every, moved, model.nv)
        z = fit[:, 0]
        z[np.abs(z) < 1e-12 * np.abs(z).max(initial=0.0)] = 0.0
        if z.any() and np.linalg.norm(left) < _SAME * np.linalg.norm(moved):
            found[name] = z
    return found


def divided(names: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the modes of parts, and those of the whole model."""
    own = [name for name in names if _MODE.fullmatch(name)]
    return own, [name for name in names if name not in own]


def _parts(model: mujoco.MjModel) -> list[_Part]:
    """Return every body that a joint moves, alone and with what it carries, but not all that moves at once."""
    moving, number, last = model.body_treeid >= 0, np.arange(model.nbody), _carried(model)
    found, hung = list[_Part](), list[_Part]()
    held = np.where(model.body_dofnum > 0, model.body_weldid[model.body_parentid], -1)
    for body in np.flatnonzero(model.body_dofnum > 0).tolist():
        alone = model.body_weldid == model.body_weldid[body]  # what is welded to a body is part of it
        carried = (number >= body) & (number < last[body])
        name = _body_name(model, body)
        hanging = np.append(body, np.flatnonzero(held == body))
        for inside, label, bodies in ((alone, name, hanging), (carried, name + _CARRIES, hanging[:1])):
            if not np.array_equal(inside & moving, moving) and not (label != name and np.array_equal(alone, carried)):
                found.append(_Part(label, body, inside, bodies))
                joint = int(model.body_jntadr[body])
                if mujoco.mjtJoint(model.jnt_type[joint]) in _ROUND:
                    hung.append(_Part(label, body, inside, bodies, joint))
    return [*found, *hung]


def _carried(model: mujoco.MjModel) -> Array:
    """Return the number after that of the last body that each body carries, (nbody,): a body comes before those."""
    last = np.arange(1, model.nbody + 1)
    for body in range(model.nbody - 1, 0, -1):
        bearer = model.body_parentid[body]
        last[bearer] = max(last[bearer], last[body])
    return last


def _body_name(model: mujoco.MjModel, body: int) -> str:
    """Return a body's name, or that of its only joint, or its number."""
    joint = int(model.body_jntadr[body])
    named = model.joint(joint).name if model.body_jntnum[body] == 1 else ""
    return str(model.body(body).name or named or f"body{body}")


def _moved(model: mujoco.MjModel, data: mujoco.MjData, part: _Part) -> Array:
    """Return the velocities of all bodies per twist of a part in its frame, (nbody, 6, 6)."""
    own = part.joint < 0
    turn = data.xmat[part.root].reshape(3, 3) if own else np.eye(3)
    moved = turning(model, data, data.xpos[part.root] if own else data.xanchor[part.joint], turn)
    moved[~(part.inside & (model.body_treeid >= 0))] = 0.0
    return moved


def _look(
    model: mujoco.MjModel, data: mujoco.MjData, force: Array, parts: list[_Part], largest: float
) -> list[_Part]:
    """Return the parts that may still be free after one more state.

    Whatever bears a part rests, so that its own joints, and those of what hangs from it, allow its motion or none do.
    """
    every, left = trees(model, data), []
    for part in parts:
        tree = every[int(model.body_treeid[part.root])]
        first, count = model.body_dofadr[part.bodies], model.body_dofnum[part.bodies]
        own = np.concatenate([np.arange(f, f + c) for f, c in zip(first.tolist(), count.tolist(), strict=True)])
        rows = tree.jac.reshape(len(tree.bodies), 6, -1)[np.searchsorted(tree.bodies, part.bodies)]
        jac = rows[:, :, own - tree.coordinates.start].reshape(-1, len(own))
        moved = _moved(model, data, part)[part.bodies].reshape(-1, 6)
        z = least_squares(jac, moved)
        part.barred.append((jac @ z - moved) / np.abs(moved).max())
        part.work.append(force[own] @ z / (np.abs(z).max() or 1.0))
        if singular(part.opposed(10.0 * largest))[1][-1] <= _RIGID:
            left.append(part)
    return left


def _of(part: _Part, name: str) -> bool:
    """Whether a mode is one of a part."""
    match = _MODE.fullmatch(name)
    return match is not None and match[2] == part.name and bool(match[3]) == (part.joint >= 0)


def _twist(name: str) -> Array:
    """Return the velocity of a part's origin and its angular velocity, (6,), in its frame, of a named motion."""
    match = _MODE.fullmatch(name)
    assert match is not None
    axis = np.array([float(c) for c in match[4].split(",")])
    if match[1] == "translation":
        return np.concatenate([axis, np.zeros(3)])
    point = np.array([float(c) for c in match[5].split(",")]) if match[5] else np.zeros(3)
    return np.concatenate([np.cross(point, axis), axis])


def _named(part: _Part, free: Array) -> list[str]:
    """Return names of motions that span the twists `free` (k, 6), orthonormal rows; screws have none."""
    if not len(free):
        return []
    name, ground = part.name, _GROUND if part.joint >= 0 else ""
    u, sizes, vh = singular(free[:, 3:])
    rank = int(np.count_nonzero(sizes > _SAME))
    sliding = u[:, rank:].T @ free[:, :3]  # combinations that do not turn
    found = [f"translation of {name} along {ground}({_shown(axis)})" for axis in _tidy(sliding)]
    for axis in _tidy(vh[:rank]):
        weights = least_squares(free[:, 3:].T, axis)
        velocity = weights @ free[:, :3]
        velocity = velocity - sliding.T @ (sliding @ velocity)
        if abs(velocity @ axis) > _SAME:
            continue
        point = np.cross(axis, velocity)
        through = f" through ({_shown(point)})" if np.linalg.norm(point) > _RIGID else ""
        found.append(f"rotation of {name} about {ground}({_shown(axis)}){through}")
    return found


def _tidy(rows: Array) -> list[Array]:
    """Return unit vectors that span the same space as orthonormal rows (k, 3), axes of the frame where these do."""
    axes = [e for e in np.eye(3) if np.linalg.norm(e - rows.T @ (rows @ e)) < _SAME] if len(rows) else []
    if len(axes) == len(rows):
        return axes
    return [row * np.sign(row[np.argmax(np.abs(row))]) / np.linalg.norm(row) for row in rows]


def _shown(vector: Array) -> str:
    return ", ".join(f"{c + 0.0:.9g}" for c in np.round(vector, 12))


def _direction(model: mujoco.MjModel, data: mujoco.MjData, known: Sequence[str], name: str) -> Array | None:
    """Return the tangent vector along a motion, None if the joints do not allow it or known motions make it up."""
    z = directions(model, data, [name]).get(name)
    own, whole = divided(known)
    others = list({**rigid.directions(model, data, whole), **directions(model, data, own)}.values())
    return z if z is not None and _independent(z, others) else None


def _independent(z: Array, others: Sequence[Array]) -> bool:
    """Whether no combination of other tangent vectors makes one up."""
    if not others:
        return True
    basis = np.column_stack(others)
    rest = z - basis @ least_squares(basis, z)
    return bool(np.linalg.norm(rest) > _SAME * np.linalg.norm(z))


class Held:
    """What a Mechanism knows of motions, of the whole model or of its parts, that nothing opposes."""

    n: int
    _held: tuple[str, ...]

    @property
    def _core(self) -> Core:
        raise NotImplementedError

    def periods(self, x: Array, values: Values) -> Array:
        """Return a full turn for each coordinate in which one changes no force, infinity for the others, (nv,)."""
        return rigid.full_turns(self, x, values)

    def rigid_modes(self, x: Array, values: Values, among: Sequence[str] | None = None) -> tuple[str, ...]:
        """Return the names of the motions that no force opposes near a state, of all or `among` some."""
        free, model, position = self.holding(()), self._core.model, self._core.evaluator.position
        own, rest = (None, None) if among is None else divided(among)
        whole = rigid.zero_modes(free, model, position, x, values, rest) if rest is None or rest else ()
        return (*whole, *zero_modes(free, model, position, x, values, whole, own))

    @property
    def held(self) -> tuple[str, ...]:
        """The modes that are held."""
        return self._held

    def rigid_directions(self, x: Array) -> dict[str, Array]:
        """Return the tangent vectors (nv,) along the held modes, by name."""
        data = self._core.evaluator.position(x)
        own, rest = divided(self._held)
        return rigid.directions(self._core.model, data, rest) | directions(self._core.model, data, own)

    def holds_straight(self) -> bool:
        """Whether all modes that are held are those of parts in their own frames: coordinates change in proportion."""
        return bool(self._held) and not any(_GROUND in name for name in self._held) and not divided(self._held)[1]

    def holding(self, modes: Sequence[str]) -> Self:
        """Return this mechanism with modes held by a stiffness and damping of their own."""
        held = copy.copy(self)
        held._held = tuple(modes)
        return held

    def admissible(self, x: Array, step: Array) -> Array:
        """Return a tangent step without its part along held modes, which nothing else would correct."""
        return rigid.without_modes(step, self._core.evaluator.mass(x), self._held_directions(x)) if self._held else step

    def _held_directions(self, x: Array) -> Array:
        found = list[Array]()
        for z in self.rigid_directions(x).values():  # a rod that hangs down turns about itself and about the vertical
            found += [z] if _independent(z, found) else []
        return np.column_stack(found) if found else np.zeros((self.n, 0))
