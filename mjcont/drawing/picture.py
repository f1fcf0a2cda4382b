"""What a picture of a planar mechanism shows at a pose: links, pins, springs and forces, in its plane of motion.

`picture` reads MuJoCo's kinematics and returns plain dataclasses, in metres; `sketch` draws them.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import mujoco
import numpy as np

from mjcont.drawing.shapes import Color, Scene, Shape, painted, plane_axes, shapes_of
from mjcont.drawing.viewer import posed
from mjcont.errors import MjcontError
from mjcont.mechanism.mechanism import Mechanism
from mjcont.models.actuators import is_bush
from mjcont.numerics.equations.problem import Array
from mjcont.results.points import Point

Pose = Point | Array | str | None
_JOINT, _TRANSMISSION, _WRAP = mujoco.mjtJoint, mujoco.mjtTrn, mujoco.mjtWrap
# "B" in pin_B, bush_B_x, x_B, angle_B, B_1 or B itself: how the elements at a pin name it
_LETTER = re.compile(r"(?:(?:bush|pin|joint|hinge|angle|[xyz])_)?([A-Z][a-z0-9]?)(?:_\w{1,2})?")
SPRING_COLOR: Color = (0.90, 0.45, 0.10, 1.0)
_NEAR = 0.01  # of the model's size: what counts as one place


@dataclass(frozen=True, slots=True)
class Pin:
    """A rigid pin, or a bush where `elastic`; `other` is the far side of the bush's gap, `fixed` whether on ground."""

    name: str
    at: Array
    other: Array
    elastic: bool
    fixed: bool


@dataclass(frozen=True, slots=True)
class Spring:
    """A spring along a path (N, 2) whose leg number `coil` is coiled; a cable where that is None."""

    name: str
    path: Array
    color: Color
    coil: int | None


@dataclass(frozen=True, slots=True)
class Force:
    """A force at a point along a unit vector, which ends there if `into`; where `turn` is not 0, a moment.

    `turn` is +1 counter-clockwise, -1 clockwise.
    """

    name: str
    at: Array
    direction: Array
    into: bool = False
    turn: int = 0


@dataclass(frozen=True, slots=True)
class Picture:
    """All that there is to draw at one pose, in plane coordinates; shapes from back to front."""

    shapes: Sequence[Shape]
    pins: Sequence[Pin]
    springs: Sequence[Spring]
    forces: Sequence[Force]

    @property
    def box(self) -> Array:
        """Lower left and upper right corner, (2, 2)."""
        points = [s.outline for s in self.shapes] + [s.path for s in self.springs]
        points += [p.at[None] for p in self.pins] + [f.at[None] for f in self.forces]
        every = np.concatenate(points) if points else np.zeros((1, 2))
        return np.array([every.min(axis=0), every.max(axis=0)])


def picture(
    mechanism: Mechanism,
    pose: Pose = None,
    *,
    plane: str | None = None,
    inputs: Mapping[str, float] | None = None,
) -> Picture:
    """Return what a planar mechanism looks like at a pose.

    Parameters
    ----------
    mechanism : Mechanism
    pose : Point, (nq,) array, keyframe name or None
        A point brings its parameters; None is the model's initial pose.
    plane : str, optional
        The horizontal and the vertical axis, such as "xz" or "-xz"; default from the model's joints.
    inputs : mapping of parameter to value, optional
        Values that decide which way the forces point. A force of unknown size points in its positive direction; one
        that is known to be zero is left out.

    Raises
    ------
    MjcontError
        If the model does not move in a plane, or not in the one given.
    ParameterError, NameLookupError
        If the state has the wrong shape, or there is no such keyframe or input.
    """
    if not isinstance(mechanism, Mechanism):
        raise MjcontError(f"only a Mechanism can be drawn, got a {type(mechanism).__name__}")
    given = {**(pose.parameters if isinstance(pose, Point) else {}), **(inputs or {})}
    if isinstance(pose, str) or pose is None:
        state = mechanism.start_state(keyframe=pose)
    elif isinstance(pose, Point | np.ndarray | list | tuple):
        state = mechanism.start_state(state=pose.state if isinstance(pose, Point) else np.asarray(pose))
    else:
        raise MjcontError(f"a pose is a point, a state or a keyframe's name, got a {type(pose).__name__}")
    model, data = posed(mechanism, state, given)
    return pictured(Scene(model, data, *plane_axes(model, data, plane, mechanism.name)), given)


def pictured(scene: Scene, given: Collection[str]) -> Picture:
    """Return what a scene looks like; `given` are the parameters whose values are known."""
    return Picture(
        shapes=shapes_of(scene),
        pins=_merged(_pins(scene), _NEAR * scene.size),
        springs=list(_springs(scene)),
        forces=[*_forces(scene, given), *_tilted_weight(scene)],
    )


# -- pins --------------------------------------------------------------------------------------------------


def _pins(scene: Scene) -> Iterator[Pin]:
    """Yield the hinges that hold a body to its parent, then the pins that bush actuators close."""
    m, d = scene.model, scene.data
    names = scene.names("joint")
    for body in range(1, m.nbody):
        slides = scene.joints(body, _JOINT.mjJNT_SLIDE)
        elastic = [j for j in slides if _stiff(m.jnt_stiffness[j], m.jnt_stiffnesspoly[j])]
        if len(slides) - len(elastic) >= 2:
            continue  # free in the plane: its hinge is no pin
        gap = np.zeros(3)
        for i in elastic:
            gap += (d.qpos[m.jnt_qposadr[i]] - m.qpos_spring[m.jnt_qposadr[i]]) * d.xaxis[i]
        parent = int(m.body_parentid[body])
        for j in scene.joints(body, _JOINT.mjJNT_HINGE):
            at, other = scene.flat(np.array([scene.anchor(j), scene.anchor(j) - gap]))
            letter = _letter(scene, [*(names[i] for i in slides), names[j]], at, (body, parent))
            yield Pin(letter or names[j], at, other, bool(elastic), scene.on_ground(parent))
    pairs: dict[tuple[int, int], list[int]] = {}
    for i in range(m.nactuator):
        if is_bush(m, i) and m.actuator_trntype[i] == _TRANSMISSION.mjTRN_SITE:
            pairs.setdefault((int(m.actuator_trnid[i, 0]), int(m.actuator_trnid[i, 1])), []).append(i)
    for (site, refsite), actuators in pairs.items():
        yield _bush(scene, site, refsite, actuators)


def _bush(scene: Scene, site: int, refsite: int, actuators: Sequence[int]) -> Pin:
    """Return the pin that bush actuators between two sites make; its gap is along their axes only."""
    m, d = scene.model, scene.data
    sites = [s for s in (site, refsite) if s >= 0]
    apart = d.site_xpos[site] - d.site_xpos[sites[-1]]
    gap = np.zeros(3)
    for i in actuators:
        axis = d.site_xmat[sites[-1]].reshape(3, 3) @ m.actuator_gear[i, :3]
        gap += (apart @ axis) / max(float(axis @ axis), 1e-12) * axis
    names = [scene.names("actuator")[i] for i in actuators]
    bodies = [int(m.site_bodyid[s]) for s in sites]
    at, other = scene.flat(np.array([d.site_xpos[site], d.site_xpos[site] - gap]))
    letter = _letter(scene, names, at, bodies)
    # along one axis only it guides, and holds no place on the ground
    fixed = len(actuators) > 1 and any(scene.on_ground(b) for b in bodies)
    return Pin(letter or names[0].removeprefix("bush_"), at, other, True, fixed)


def _letter(scene: Scene, names: Iterable[str], at: Array, bodies: Collection[int]) -> str:
    """Return the letter that names, or else geoms and sites of the bodies at the place, give a pin."""
    m, d = scene.model, scene.data
    candidates = list(names)
    for kind, owners, places in (("geom", m.geom_bodyid, d.geom_xpos), ("site", m.site_bodyid, d.site_xpos)):
        away = np.linalg.norm(scene.flat(places) - at, axis=-1)
        here = [b in bodies and a < _NEAR * scene.size for b, a in zip(owners, away, strict=True)]
        candidates += [n for n, h in zip(scene.names(kind), here, strict=True) if h]
    return next((match[1] for n in candidates if (match := _LETTER.fullmatch(n))), "")


def _merged(pins: Iterable[Pin], near: float) -> list[Pin]:
    """Return the pins with those at one place made one: B and Bb are B, other names are listed."""
    merged: list[Pin] = []
    for pin in pins:
        k = next((k for k, p in enumerate(merged) if np.linalg.norm(p.at - pin.at) < near), None)
        if k is None:
            merged.append(pin)
            continue
        first = merged[k]
        names = first.name.split(", ")
        names += [] if any(pin.name.startswith(n) for n in names) else [pin.name]
        elastic, fixed = first.elastic or pin.elastic, first.fixed or pin.fixed
        merged[k] = replace(first, name=", ".join(names), elastic=elastic, fixed=fixed)
    return merged


# -- springs -----------------------------------------------------------------------------------------------


def _springs(scene: Scene) -> Iterator[Spring]:
    """Yield tendons with stiffness, cables, and slides with stiffness that are not the bush of a hinge."""
    m, d = scene.model, scene.data
    for t, name in enumerate(scene.names("tendon")):
        joints = [j for j, _ in _joints_of(m, t)]
        stiff, color = _stiff(m.tendon_stiffness[t], m.tendon_stiffnesspoly[t]), painted(m.tendon_rgba[t], SPRING_COLOR)
        if not joints and (stiff or not _shows_another(m, t)):
            path = _path(scene, t)
            longest = int(np.linalg.norm(np.diff(path, axis=0), axis=1).argmax())
            yield Spring(name, path, color, longest if stiff else None)
        elif joints and stiff and len(joints) <= 2 and np.all(m.jnt_type[joints] == _JOINT.mjJNT_SLIDE):
            yield Spring(name, _between(scene, joints, float(d.qpos[m.jnt_qposadr[joints[0]]])), color, 1)
    for j, name in enumerate(scene.names("joint")):
        bush = scene.joints(int(m.jnt_bodyid[j]), _JOINT.mjJNT_HINGE)
        if m.jnt_type[j] == _JOINT.mjJNT_SLIDE and not bush and _stiff(m.jnt_stiffness[j], m.jnt_stiffnesspoly[j]):
            stretch = float(d.qpos[m.jnt_qposadr[j]] - m.qpos_spring[m.jnt_qposadr[j]])
            yield Spring(name, _between(scene, [j], 0.2 * scene.size + stretch), SPRING_COLOR, 1)


def _shows_another(m: mujoco.MjModel, tendon: int) -> bool:
    """Whether a line without force is there to show a fixed tendon between its bodies, which is drawn itself."""
    driven = np.any((m.actuator_trntype == _TRANSMISSION.mjTRN_TENDON) & (m.actuator_trnid[:, 0] == tendon))
    sites = [m.wrap_objid[w] for w in _wraps(m, tendon) if m.wrap_type[w] == _WRAP.mjWRAP_SITE]
    bodies = {int(m.site_bodyid[s]) for s in sites}
    fixed = ({int(m.jnt_bodyid[j]) for j, _ in _joints_of(m, t)} for t in range(m.ntendon))
    return not driven and any(bodies - {0} == f for f in fixed)


def _stiff(linear: float, polynomial: Array) -> bool:
    return bool(linear or polynomial.any())


def _wraps(m: mujoco.MjModel, tendon: int) -> range:
    return range(int(m.tendon_adr[tendon]), int(m.tendon_adr[tendon] + m.tendon_num[tendon]))


def _joints_of(m: mujoco.MjModel, tendon: int) -> list[tuple[int, float]]:
    """Return the joints and coefficients of a fixed tendon; none for a spatial one."""
    found = [w for w in _wraps(m, tendon) if m.wrap_type[w] == _WRAP.mjWRAP_JOINT]
    return [(int(m.wrap_objid[w]), float(m.wrap_prm[w])) for w in found]


def _path(scene: Scene, tendon: int) -> Array:
    """Return the path of a spatial tendon, (N, 2)."""
    d = scene.data
    rows = slice(int(d.ten_wrapadr[tendon]), int(d.ten_wrapadr[tendon] + d.ten_wrapnum[tendon]))
    pulley = -2
    return scene.flat(d.wrap_xpos.reshape(-1, 3)[rows][d.wrap_obj.reshape(-1)[rows] != pulley])


def _between(scene: Scene, slides: Sequence[int], length: float) -> Array:
    """Return a path (4, 2) along a slide's axis from one body to the next, or to a single one from `length` before."""
    m, d = scene.model, scene.data
    along = scene.flat(d.xaxis[slides[0]])
    centres = scene.flat(d.xipos[m.jnt_bodyid[slides]])
    if len(slides) == 1:
        centres = np.array([centres[0] - length * along, centres[0]])
    level = centres.mean(axis=0)
    start, end = (level + (c - level) @ along * along for c in centres)
    return np.array([centres[0], start, end, centres[1]])


# -- forces ------------------------------------------------------------------------------------------------


def _forces(scene: Scene, known: Collection[str]) -> Iterator[Force]:
    """Yield what the actuators do; a zero that is not `known` counts as positive."""
    m, d = scene.model, scene.data
    for i, given in enumerate(scene.names("actuator")):
        name, force = given or f"actuator{i}", float(d.actuator_force[i])
        if is_bush(m, i) or (force == 0.0 and name in known):
            continue
        gear = (1.0 if force >= 0.0 else -1.0) * m.actuator_gear[i]
        kind, (target, reference) = int(m.actuator_trntype[i]), m.actuator_trnid[i].tolist()
        if kind in (_TRANSMISSION.mjTRN_JOINT, _TRANSMISSION.mjTRN_JOINTINPARENT):
            yield from _on_joint(scene, name, target, gear[0])
        elif kind == _TRANSMISSION.mjTRN_SITE:
            frame = d.site_xmat[reference if reference >= 0 else target].reshape(3, 3)
            yield from _wrench(scene, name, d.site_xpos[target], frame @ gear[:3], frame @ gear[3:])
        elif kind == _TRANSMISSION.mjTRN_TENDON and gear[0]:
            for joint, factor in _joints_of(m, target):
                yield from _on_joint(scene, name, joint, gear[0] * factor)
            if not _joints_of(m, target):
                yield from _along(name, _path(scene, target), gear[0])


def _tilted_weight(scene: Scene) -> Iterator[Force]:
    """Yield gravity, at the centre of gravity, where it does not point straight down in the picture."""
    gravity = scene.flat(scene.model.opt.gravity)
    size = float(np.linalg.norm(gravity))
    if size > 1e-9 and abs(gravity[0]) > 1e-6 * size:
        yield Force("g", scene.flat(scene.data.subtree_com[0]), gravity / size)


def _on_joint(scene: Scene, name: str, joint: int, size: float) -> Iterator[Force]:
    """Yield a force along a slide or a moment about a hinge."""
    turns = scene.model.jnt_type[joint] == _JOINT.mjJNT_HINGE
    axis, none = size * scene.data.xaxis[joint], np.zeros(3)
    force, moment = (none, axis) if turns else (axis, none)
    yield from _wrench(scene, name, scene.anchor(joint), force, moment)


def _wrench(scene: Scene, name: str, at: Array, force: Array, moment: Array) -> Iterator[Force]:
    place, direction, turn = scene.flat(at), scene.flat(force), float(moment @ scene.toward)
    if np.linalg.norm(direction) > 1e-9:
        yield Force(name, place, direction / np.linalg.norm(direction))
    if abs(turn) > 1e-9:
        yield Force(name, place, np.zeros(2), turn=1 if turn > 0 else -1)


def _along(name: str, path: Array, size: float) -> Iterator[Force]:
    """Yield the pair of forces of a tendon on its ends: apart where positive, towards each other where negative."""
    for end, beside in ((path[0], path[1]), (path[-1], path[-2])):
        away = (end - beside) / max(float(np.linalg.norm(end - beside)), 1e-12)
        yield Force(name, end, away if size > 0 else -away, into=size < 0)
