"""Links and ground of a planar model as shapes in its plane of motion, from MuJoCo's kinematics at a pose.

`picture` adds pins, springs and forces; `sketch` draws all of it. Lengths in metres.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.errors import MjcontError
from mjcont.mechanism.paths import element_names
from mjcont.numerics.equations.problem import Array

Color = tuple[float, ...]
_JOINT, _GEOM = mujoco.mjtJoint, mujoco.mjtGeom
GREY = (0.45, 0.47, 0.50, 1.0)
_UNPAINTED = np.array([0.5, 0.5, 0.5, 1.0])
# MuJoCo's viewer, too, shows the groups below this one; the others hold collision geoms
HIDDEN_GROUP = 3


@dataclass(frozen=True, slots=True)
class Shape:
    """All that lies within `radius` of a point (1, 2), a segment (2, 2) or a polygon (N, 2); `flat` cuts the ends.

    `depth` grows towards the viewer.
    """

    body: str
    points: Array
    radius: float
    color: Color
    ground: bool
    depth: float
    flat: bool = False

    @property
    def outline(self) -> Array:
        """The boundary, (N, 2)."""
        if len(self.points) > 2:
            return self.points
        start, end = self.points[0], self.points[-1]
        angle = np.arctan2(*(end - start)[::-1]) + np.pi / 2
        turn = angle + (np.array([0.0, np.pi]) if self.flat and len(self.points) == 2 else np.linspace(0.0, np.pi, 25))
        cap = self.radius * np.column_stack([np.cos(turn), np.sin(turn)])
        return np.concatenate([start + cap, end - cap])


@dataclass(frozen=True, slots=True)
class Scene:
    """A model and its data at a pose, with the horizontal and vertical unit vectors of the picture."""

    model: mujoco.MjModel
    data: mujoco.MjData
    right: Array
    up: Array

    @property
    def toward(self) -> Array:
        """The direction to the viewer."""
        return np.cross(self.right, self.up)

    @property
    def size(self) -> float:
        """The model's own statement of its size."""
        return float(self.model.stat.extent)

    def flat(self, vectors: Array) -> Array:
        """Project vectors (..., 3) to the plane, (..., 2)."""
        return np.asarray(vectors) @ np.column_stack([self.right, self.up])

    def names(self, kind: str) -> list[str]:
        """Return the names of all joints, bodies, ..."""
        return element_names(self.model, kind)

    def on_ground(self, body: int) -> bool:
        """Whether a body is the world or fixed to it."""
        return bool(self.model.body_weldid[body] == 0)

    def anchor(self, joint: int) -> Array:
        """Where a joint sits, (3,), once all joints of its body have moved."""
        body = self.model.jnt_bodyid[joint]
        turn = self.data.xmat[body].reshape(3, 3)
        return np.asarray(self.data.xpos[body] + turn @ self.model.jnt_pos[joint])

    def joints(self, body: int, kind: int) -> list[int]:
        """Return a body's joints of one type."""
        start = int(self.model.body_jntadr[body])
        every = range(start, start + int(self.model.body_jntnum[body]))
        return [j for j in every if int(self.model.jnt_type[j]) == kind]


def painted(rgba: Array, other: Color) -> Color:
    """Return a colour, or the other where the model leaves it at MuJoCo's default."""
    return other if np.all(np.abs(rgba - _UNPAINTED) < 1e-6) else tuple(float(c) for c in rgba)


# -- the plane ---------------------------------------------------------------------------------------------


def plane_axes(model: mujoco.MjModel, data: mujoco.MjData, plane: str | None, name: str) -> tuple[Array, Array]:
    """Return the horizontal and vertical unit vectors of the plane in which every joint moves.

    Raises
    ------
    MjcontError
        If a joint does not move in the plane given, or in any that suits the others.
    """
    hinges = data.xaxis[model.jnt_type == _JOINT.mjJNT_HINGE]
    slides = data.xaxis[model.jnt_type == _JOINT.mjJNT_SLIDE]
    if plane is not None:
        right, up = _parse_plane(plane)
    elif len(hinges):
        right, up = _upright(hinges[0])
    else:
        # y, that is x-z with z up, where the slides leave a choice
        across = [a for a in np.eye(3)[[1, 2, 0]] if np.abs(slides @ a).max(initial=0.0) < 1e-6]
        right, up = _upright(across[0] if across else np.linalg.svd(slides)[2][-1])
    toward = np.cross(right, up)
    for j, kind in enumerate(model.jnt_type.tolist()):
        along = abs(float(data.xaxis[j] @ toward))
        fits = along > 1 - 1e-6 if kind == _JOINT.mjJNT_HINGE else along < 1e-6
        if not fits or kind in (_JOINT.mjJNT_BALL, _JOINT.mjJNT_FREE):
            joint = element_names(model, "joint")[j] or f"joint{j}"
            where = "one plane" if plane is None else f"the plane '{plane}'"
            raise MjcontError(
                f"draw shows planar models, and '{name}' does not move in {where}: see joint '{joint}'. "
                "All hinges must have one direction and slides lie across it; 'mjcont view' shows any model."
            )
    return right, up


def _parse_plane(plane: str) -> tuple[Array, Array]:
    match = re.fullmatch(r"(-?)([xyz])(-?)([xyz])", plane)
    if match is None or match[2] == match[4]:
        raise MjcontError(f"plane must name the horizontal and the vertical axis, such as 'xz' or '-xz', got '{plane}'")
    right, up = (np.eye(3)["xyz".index(axis)] for axis in (match[2], match[4]))
    return (-right if match[1] else right), (-up if match[3] else up)


def _upright(normal: Array) -> tuple[Array, Array]:
    """Return axes across a normal: z up where possible, else y, and x or y to the right."""
    normal = normal / max(float(np.linalg.norm(normal)), 1e-12)
    vertical = np.eye(3)[1 if abs(normal[2]) > 0.9 else 2]
    up = vertical - (vertical @ normal) * normal
    up /= np.linalg.norm(up)
    right = np.cross(normal, up)
    return (right if right[np.abs(right).argmax()] > 0 else -right), up


# -- the shapes --------------------------------------------------------------------------------------------


def shapes_of(scene: Scene) -> list[Shape]:
    """Return the visible geoms from back to front, and plain links for moving bodies that have none."""
    kept: list[Shape] = []
    # of equal shapes of a body, such as the left and right plate of a link, the one in front is enough
    for shape in sorted([*_geoms(scene), *_sticks(scene)], key=lambda s: -s.depth):
        alike = [k for k in kept if (k.body, k.color, k.points.shape) == (shape.body, shape.color, shape.points.shape)]
        if not any(k.radius == shape.radius and np.allclose(k.points, shape.points, atol=1e-9) for k in alike):
            kept.append(shape)
    return kept[::-1]


def _geoms(scene: Scene) -> Iterator[Shape]:
    m = scene.model
    bodies = scene.names("body")
    for g in range(m.ngeom):
        body, material = int(m.geom_bodyid[g]), int(m.geom_matid[g])
        color = painted(m.geom_rgba[g], painted(m.mat_rgba[material], GREY) if material >= 0 else GREY)
        if m.geom_group[g] >= HIDDEN_GROUP or color[3] == 0:
            continue
        found = _projected(scene, g)
        if found is not None:
            points, radius, depth, flat = found
            yield Shape(bodies[body], points, radius, color, scene.on_ground(body), depth, flat)


def _projected(scene: Scene, g: int) -> tuple[Array, float, float, bool] | None:
    """Return points, radius, depth of the front, and whether the ends are flat; None for what cannot be drawn."""
    m, d = scene.model, scene.data
    kind, size = int(m.geom_type[g]), m.geom_size[g]
    centre, turn = d.geom_xpos[g], d.geom_xmat[g].reshape(3, 3)
    axis, toward = turn[:, 2], scene.toward
    if kind == _GEOM.mjGEOM_SPHERE:
        return scene.flat(centre)[None], float(size[0]), float(centre @ toward + size[0]), False
    if kind in (_GEOM.mjGEOM_CAPSULE, _GEOM.mjGEOM_CYLINDER):
        ends = centre + np.outer([1.0, -1.0], size[1] * axis)  # as in fromto
        depth, flat = float((ends @ toward).max()), kind == _GEOM.mjGEOM_CYLINDER
        seen_end_on = abs(axis @ toward) > 0.9
        points = scene.flat(centre)[None] if seen_end_on else scene.flat(ends)
        return points, float(size[0]), depth if seen_end_on and flat else depth + float(size[0]), flat
    if kind == _GEOM.mjGEOM_PLANE:
        return _slab(scene, centre, axis, float(size[0]))
    corners = _solid(m, g)
    if corners is None:
        return None
    corners = centre + corners @ turn.T
    return _hull(scene.flat(corners)), 0.0, float((corners @ toward).max()), False


def _solid(m: mujoco.MjModel, g: int) -> Array | None:
    """Return points whose hull is the geom, (N, 3), in its frame."""
    kind, size = int(m.geom_type[g]), m.geom_size[g]
    if kind == _GEOM.mjGEOM_BOX:
        return size * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    if kind == _GEOM.mjGEOM_ELLIPSOID:
        u, v = (a.ravel() for a in np.meshgrid(np.linspace(0, 2 * np.pi, 49)[:-1], np.linspace(0, np.pi, 25)))
        return size * np.column_stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    if kind == _GEOM.mjGEOM_MESH:
        mesh = m.geom_dataid[g]
        return np.asarray(m.mesh_vert[m.mesh_vertadr[mesh] : m.mesh_vertadr[mesh] + m.mesh_vertnum[mesh]])
    return None


def _hull(points: Array) -> Array:
    from scipy.spatial import ConvexHull

    return points[ConvexHull(points).vertices]


def _slab(scene: Scene, centre: Array, normal: Array, half: float) -> tuple[Array, float, float, bool] | None:
    """Return a plane seen from its edge as the ground below it; nothing for a plane that is seen from above."""
    if abs(normal @ scene.toward) > 1e-6:
        return None
    along, down = scene.flat(np.cross(normal, scene.toward)), -0.05 * scene.size * scene.flat(normal)
    end, middle = min(half or scene.size, scene.size) * along, scene.flat(centre)
    return np.array([middle - end, middle + end, middle + end + down, middle - end + down]), 0.0, -np.inf, False


def _sticks(scene: Scene) -> Iterable[Shape]:
    """Yield links from a bare body's first hinge to its sites, the next bodies and its centre of gravity."""
    m, d = scene.model, scene.data
    clothed = {int(b) for b, group in zip(m.geom_bodyid, m.geom_group, strict=True) if group < HIDDEN_GROUP}
    for body, name in enumerate(scene.names("body")):
        if body in clothed or scene.on_ground(body):
            continue
        hinges = scene.joints(body, _JOINT.mjJNT_HINGE)
        start = d.xanchor[hinges[0]] if hinges else d.xpos[body]
        for end in [*d.site_xpos[m.site_bodyid == body], *d.xpos[m.body_parentid == body], d.xipos[body]]:
            points = scene.flat(np.array([start, end]))
            if np.linalg.norm(points[1] - points[0]) > 1e-9:
                yield Shape(name, points, 0.008 * scene.size, GREY, False, float(end @ scene.toward))
