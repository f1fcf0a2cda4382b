"""The structure of a mechanism: what closes its loops, how many freedoms are left, what to soften.

A model is a tree of joints plus *closures*: `connect` and `weld` constraints, or bush actuators between two sites. With
J the Jacobian of all closures at a pose (and of the slides of elastic pins), the mobility is n - rank J. A closure that
is a constraint is stiff at rest, not rigid: it is a spring (see `equalities`).
"""

from __future__ import annotations

import copy
import re
from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.models.actuators import is_bush
from mjcont.models.equalities import KINDS, equality_name
from mjcont.models.quiet import quiet, quiet_data

_JOINT, _EQ, _OBJ = mujoco.mjtJoint, mujoco.mjtEq, mujoco.mjtObj
_DISABLE = mujoco.mjtDisableBit
_AXIS_SUFFIX = re.compile(r"_r?[xyzuv]$")


@dataclass(frozen=True, slots=True)
class Frame:
    """A frame fixed to a body: position (3,) in m and quaternion (4,) in the body's frame."""

    body: int
    pos: np.ndarray
    quat: np.ndarray
    site: int = -1


@dataclass(frozen=True, slots=True)
class Closure:
    """A pair of frames, on two bodies, that a constraint or a bush holds together.

    Attributes
    ----------
    name : str
        Of the equality, or of the bush without prefix and axis.
    kind : {"connect", "weld", "bush"}
    index : int
        The equality's number, or that of the bush's first actuator.
    frames : tuple of Frame
        In the order of the MJCF's body1, body2 (site, refsite for a bush).
    """

    name: str
    kind: str
    index: int
    frames: tuple[Frame, Frame]

    @property
    def elastic(self) -> bool:
        """Whether it is a bush, not a constraint."""
        return self.kind == "bush"


@dataclass(frozen=True, slots=True)
class Loop:
    """A closed chain: bodies from one side of a closure round to the other, and the joints between them."""

    closure: Closure
    bodies: tuple[str, ...]
    joints: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Freedom:
    """How many ways a mechanism can move at a pose.

    Attributes
    ----------
    coordinates : int
        Degrees of freedom of the tree, slides of elastic pins apart.
    elastic_pins : int
        Slides of elastic pins.
    constraint_rows, constraint_rank : int
        Of the equality constraints.
    bush_rows : int
        Elastic elements between two sites.
    mobility : int
        What is left to the mechanism with rigid pins.
    """

    coordinates: int
    elastic_pins: int
    constraint_rows: int
    constraint_rank: int
    bush_rows: int
    mobility: int


def _name(model: mujoco.MjModel, kind: mujoco.mjtObj, index: int, default: str = "") -> str:
    return mujoco.mj_id2name(model, kind, index) or default


def body_name(model: mujoco.MjModel, body: int) -> str:
    """Return a body's name; the world's is ground."""
    return "ground" if body == 0 else _name(model, _OBJ.mjOBJ_BODY, body, f"body{body}")


# -- closures and loops -----------------------------------------------------------------------------------------


def equality_frames(model: mujoco.MjModel, equality: int) -> tuple[Frame, Frame]:
    """Return the two frames that a connect or weld holds together."""
    ids = int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality])
    if model.eq_objtype[equality] == _OBJ.mjOBJ_SITE:
        return site_frame(model, ids[0]), site_frame(model, ids[1])
    data, straight = model.eq_data[equality], np.array([1.0, 0.0, 0.0, 0.0])
    if model.eq_type[equality] == _EQ.mjEQ_CONNECT:
        return Frame(ids[0], data[0:3].copy(), straight), Frame(ids[1], data[3:6].copy(), straight)
    return Frame(ids[0], data[3:6].copy(), data[6:10].copy()), Frame(ids[1], data[0:3].copy(), straight)


def site_frame(model: mujoco.MjModel, site: int) -> Frame:
    """Return a site's frame."""
    return Frame(int(model.site_bodyid[site]), model.site_pos[site].copy(), model.site_quat[site].copy(), site)


def constraint_closures(model: mujoco.MjModel) -> list[Closure]:
    """Return the active connects and welds."""
    kinds = (_EQ.mjEQ_CONNECT, _EQ.mjEQ_WELD)
    active = [e for e in range(model.neq) if _EQ(model.eq_type[e]) in kinds and model.eq_active0[e]]
    return [
        Closure(equality_name(model, e), KINDS[_EQ(model.eq_type[e])], e, equality_frames(model, e)) for e in active
    ]


def bush_elements(model: mujoco.MjModel) -> list[int]:
    """Return the bush actuators that act between two sites."""
    site = mujoco.mjtTrn.mjTRN_SITE
    return [
        a
        for a in range(len(model.actuator_trntype))
        if is_bush(model, a) and model.actuator_trntype[a] == site and model.actuator_trnid[a, 1] >= 0
    ]


def bush_closures(model: mujoco.MjModel) -> list[Closure]:
    """Return the pairs of sites that bush actuators join."""
    found: dict[tuple[int, int], Closure] = {}
    for a in bush_elements(model):
        site, ref = (int(i) for i in model.actuator_trnid[a])
        name = _AXIS_SUFFIX.sub("", _name(model, _OBJ.mjOBJ_ACTUATOR, a)).removeprefix("bush_")
        found.setdefault((site, ref), Closure(name, "bush", a, (site_frame(model, site), site_frame(model, ref))))
    return list(found.values())


def couplings(model: mujoco.MjModel) -> list[str]:
    """Return the active equalities between joints or tendons: they take a freedom but close no loop of bodies."""
    kinds = (_EQ.mjEQ_JOINT, _EQ.mjEQ_TENDON)
    chosen = [e for e in range(model.neq) if _EQ(model.eq_type[e]) in kinds and model.eq_active0[e]]
    return [f"{KINDS[_EQ(model.eq_type[e])]} {equality_name(model, e)}" for e in chosen]


def joints_of(model: mujoco.MjModel, body: int) -> range:
    """Return a body's joints."""
    first = int(model.body_jntadr[body])
    return range(first, first + int(model.body_jntnum[body])) if first >= 0 else range(0)


def chain(model: mujoco.MjModel, body: int) -> list[int]:
    """Return the moving bodies from `body` to the ground, the ground last."""
    bodies = []
    body = int(model.body_weldid[body])
    while body:
        bodies.append(body)
        body = int(model.body_weldid[model.body_parentid[body]])
    return [*bodies, 0]


def _is_pin(model: mujoco.MjModel, body: int) -> bool:
    """Whether a body's joints are a pair: not a free joint, nor unsprung slides and a hinge that leave it free."""
    joints = joints_of(model, body)
    kinds = [_JOINT(model.jnt_type[j]) for j in joints]
    slides = [j for j in joints if model.jnt_type[j] == _JOINT.mjJNT_SLIDE]
    loose = len(slides) > 1 and len(joints) > len(slides) and not model.jnt_stiffness[slides].any()
    return _JOINT.mjJNT_FREE not in kinds and not loose


def loops(model: mujoco.MjModel) -> list[Loop]:
    """Return a basis of the kinematic loops, one for each closure that closes one."""
    links: dict[int, list[tuple[int, int]]] = {}  # body -> (neighbour, the body whose joints lie between or -1)

    def link(a: int, b: int, via: int) -> None:
        links.setdefault(a, []).append((b, via))
        links.setdefault(b, []).append((a, via))

    for body in range(1, model.nbody):
        if model.body_weldid[body] == body and _is_pin(model, body):
            link(body, int(model.body_weldid[model.body_parentid[body]]), body)
    found = []
    for closure in [*constraint_closures(model), *bush_closures(model)]:
        start, end = (int(model.body_weldid[f.body]) for f in closure.frames)
        path = _path(links, start, end) if start != end else None
        if path is None:
            link(start, end, -1)
            continue
        bodies = [start, *(b for b, _ in path)]
        joints = [j for _, via in path if via >= 0 for j in joints_of(model, via)]
        names = [_name(model, _OBJ.mjOBJ_JOINT, j, f"joint{j}") for j in joints if not is_elastic_slide(model, j)]
        found.append(Loop(closure, tuple(body_name(model, b) for b in bodies), tuple(names)))
    return found


def _path(links: dict[int, list[tuple[int, int]]], start: int, end: int) -> list[tuple[int, int]] | None:
    """Return the shortest path from start to end as (body, joints' body), without the start."""
    before: dict[int, tuple[int, int]] = {start: (start, -1)}
    queue = [start]
    for body in queue:
        for neighbour, via in links.get(body, []):
            if neighbour not in before:
                before[neighbour] = (body, via)
                queue.append(neighbour)
    if end not in before:
        return None
    path: list[tuple[int, int]] = []
    while end != start:
        previous, via = before[end]
        path.insert(0, (end, via))
        end = previous
    return path


def plane_normal(model: mujoco.MjModel, bodies: Sequence[int]) -> np.ndarray | None:
    """Return the unit normal (3,) of the plane in which bodies and all that carries them move, or None.

    They do if every hinge is parallel to it and every slide at right angles to it, in the pose qpos0.
    """
    carriers = {b for body in bodies for b in chain(model, body)}
    joints = [j for b in carriers for j in joints_of(model, b)]
    kinds = {_JOINT(model.jnt_type[j]) for j in joints}
    if not joints or kinds & {_JOINT.mjJNT_BALL, _JOINT.mjJNT_FREE} or _JOINT.mjJNT_HINGE not in kinds:
        return None
    data = quiet_data(model)
    mujoco.mj_kinematics(model, data)
    hinges = [data.xaxis[j] for j in joints if model.jnt_type[j] == _JOINT.mjJNT_HINGE]
    slides = [data.xaxis[j] for j in joints if model.jnt_type[j] == _JOINT.mjJNT_SLIDE]
    normal = hinges[0] * np.sign(hinges[0][np.argmax(np.abs(hinges[0]))])
    parallel = all(np.linalg.norm(np.cross(normal, h)) < 1e-9 for h in hinges)
    return normal.copy() if parallel and all(abs(normal @ s) < 1e-9 for s in slides) else None


# -- freedom ----------------------------------------------------------------------------------------------------


def is_elastic_slide(model: mujoco.MjModel, joint: int) -> bool:
    """Whether a joint is a slide with stiffness beside a hinge or ball joint: the translation of an elastic pin."""
    turning = (_JOINT.mjJNT_HINGE, _JOINT.mjJNT_BALL)
    beside = any(_JOINT(model.jnt_type[j]) in turning for j in joints_of(model, model.jnt_bodyid[joint]))
    return bool(model.jnt_type[joint] == _JOINT.mjJNT_SLIDE and beside and model.jnt_stiffness[joint] > 0)


def freedom(model: mujoco.MjModel, qpos: np.ndarray | None = None) -> Freedom:
    """Count degrees of freedom, constraints and mobility at a pose, default qpos0."""
    data = _posed(model, qpos)
    equality = data.efc_J.reshape(-1, model.nv)[: data.ne] if data.nefc else np.zeros((0, model.nv))
    elastic = [int(model.jnt_dofadr[j]) for j in range(model.njnt) if is_elastic_slide(model, j)]
    bushes = np.array([_bush_row(model, data, a) for a in bush_elements(model)]).reshape(-1, model.nv)
    everything = np.vstack([equality, bushes, np.eye(model.nv)[elastic]])
    return Freedom(
        model.nv - len(elastic), len(elastic), len(equality), _rank(equality), len(bushes), model.nv - _rank(everything)
    )


def _rank(rows: np.ndarray) -> int:
    return int(np.linalg.matrix_rank(rows, tol=1e-8 * max(1.0, np.abs(rows).max()))) if rows.size else 0


def _posed(model: mujoco.MjModel, qpos: np.ndarray | None) -> mujoco.MjData:
    """Return data at rest at a pose, with equality constraints alone."""
    private = copy.copy(model)
    private.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    private.opt.disableflags &= ~int(_DISABLE.mjDSBL_CONSTRAINT | _DISABLE.mjDSBL_EQUALITY)
    for flag in (_DISABLE.mjDSBL_CONTACT, _DISABLE.mjDSBL_LIMIT, _DISABLE.mjDSBL_FRICTIONLOSS):
        private.opt.disableflags |= int(flag)
    data = quiet_data(private)
    if qpos is not None:
        data.qpos[:] = qpos
    with quiet:
        mujoco.mj_forward(private, data)
    return data


def _bush_row(model: mujoco.MjModel, data: mujoco.MjData, actuator: int) -> np.ndarray:
    """Return the derivative of a bush's length, for closed pins, (nv,)."""
    total = np.zeros(model.nv)
    site, ref = (int(i) for i in model.actuator_trnid[actuator])
    gear = model.actuator_gear[actuator].reshape(2, 3) @ data.site_xmat[ref].reshape(3, 3).T
    for which, sign in ((site, 1.0), (ref, -1.0)):
        jacobian = np.zeros((2, 3, model.nv))
        mujoco.mj_jacSite(model, data, jacobian[0], jacobian[1], which)
        total += sign * np.einsum("ij,ijn->n", gear, jacobian)
    return total


def gap(model: mujoco.MjModel, closure: Closure, qpos: np.ndarray | None = None) -> float:
    """Return how far a closure's points are apart at a pose, in m: in their plane, or along a bush's elements."""
    data = quiet_data(model)
    if qpos is not None:
        data.qpos[:] = qpos
    with quiet:
        mujoco.mj_fwdPosition(model, data)
    if closure.elastic:
        sites = model.actuator_trnid[closure.index]
        elements = [a for a in bush_elements(model) if np.array_equal(model.actuator_trnid[a], sites)]
        return float(np.linalg.norm([data.actuator_length[a] for a in elements if model.actuator_gear[a, :3].any()]))
    a, b = (data.xpos[f.body] + data.xmat[f.body].reshape(3, 3) @ f.pos for f in closure.frames)
    normal = plane_normal(model, [f.body for f in closure.frames])
    apart = a - b if normal is None else (a - b) - ((a - b) @ normal) * normal
    return float(np.linalg.norm(apart))


# -- summary ----------------------------------------------------------------------------------------------------


def softening(model: mujoco.MjModel) -> list[str]:
    """Return the constraints to replace by bushes so that the mechanism is an ordinary differential equation.

    In a tree of joints every connect or weld closes one loop: one each, and no joint of the tree.
    """
    return [c.name for c in constraint_closures(model)]


def describe_topology(model: mujoco.MjModel) -> list[str]:
    """Return the lines on freedom and loops that `mjcont inspect` prints."""
    count, found = freedom(model), loops(model)
    redundant = count.constraint_rows - count.constraint_rank
    lines = [f"  {count.coordinates} coordinates, mobility {count.mobility} at qpos0"]
    if count.elastic_pins or count.bush_rows:
        lines.append(f"  {count.elastic_pins} slides of elastic pins, {count.bush_rows} bush elements between sites")
    if count.constraint_rows:
        lines.append(f"  {count.constraint_rows} constraint rows, {redundant} of them redundant")
    for number, loop in enumerate(found, 1):
        c = loop.closure
        lines.append(f"  loop {number}: {' - '.join(loop.bodies)}, closed by {c.kind} {c.name}")
    if not found:
        lines.append("  no loops")
    lines += [f"  coupling: {c}" for c in couplings(model)]
    for closure in (loop.closure for loop in found):
        if (opening := gap(model, closure)) > 1e-6 * max(1.0, float(model.stat.extent)):
            lines.append(f"  {closure.kind} {closure.name} is open by {opening:.3g} m at qpos0")
    if names := softening(model):
        lines.append(f"  an ODE with elastic {', '.join(names)}: mjcont bush MODEL -o OUT.xml")
    return lines
