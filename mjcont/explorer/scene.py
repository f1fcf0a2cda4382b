"""What a browser needs to draw a model: its shapes once, and where its bodies are in every row.

A shape stands still on its body, so that a pose is a position and a quaternion (w, x, y, z) a body. Where a parameter
changes the shapes themselves, rows bring those, too; springs and cables bring the path that they take.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from mjcont.drawing.picture import SPRING_COLOR
from mjcont.drawing.shapes import GREY, HIDDEN_GROUP, painted, plane_axes
from mjcont.errors import MjcontError
from mjcont.explorer.meshes import Mesh, lightened, of_height_field, of_mesh
from mjcont.mechanism.mechanism import Mechanism
from mjcont.mechanism.paths import element_names
from mjcont.models.quiet import quiet
from mjcont.numerics.equations.problem import Array

_GEOM = mujoco.mjtGeom
_TYPES = {
    _GEOM.mjGEOM_PLANE: "plane",
    _GEOM.mjGEOM_SPHERE: "sphere",
    _GEOM.mjGEOM_CAPSULE: "capsule",
    _GEOM.mjGEOM_ELLIPSOID: "ellipsoid",
    _GEOM.mjGEOM_CYLINDER: "cylinder",
    _GEOM.mjGEOM_BOX: "box",
    _GEOM.mjGEOM_MESH: "mesh",
    _GEOM.mjGEOM_SDF: "mesh",
    _GEOM.mjGEOM_HFIELD: "mesh",
}
_AXES = np.eye(3)
# thickness of bodies without shapes and of springs, and the side of an endless plane, in parts of the model's size
_STICK, _SPRING, _ENDLESS = 0.012, 0.006, 1.5
# parameters that move nothing by themselves: where they alone vary, the model is written once
_LOADS = ("control", "gravity")


@dataclass(frozen=True, slots=True)
class Poses:
    """Where everything is in rows.

    Attributes
    ----------
    bodies : (N, bodies, 7) positions and quaternions (w, x, y, z) of the bodies but the world.
    shapes : (N, shapes, 10) position, quaternion and size of every shape on its body; None where all are as in the
        scene.
    tendons : (N, points, 3) paths of springs and cables, one after the other as `Scene.tendons` counts them.
    """

    bodies: Array
    shapes: Array | None
    tendons: Array


class Scene:
    """A model as shapes, and a stand on which its rows take their poses, one after the other."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.model = mechanism.simulation_model()
        self._writer = mechanism.writer(self.model)
        self._data = mujoco.MjData(self.model)
        self._place(mechanism.qpos0, mechanism.values())
        self._shown = _shown_geoms(self.model)
        self._own = self._shapes()
        # a straight leg has two ends, one round a shape two more
        self.tendons = [2 * int(n) for n in self.model.tendon_num]
        self._sticks = list(_sticks(self.model, self._shown))

    # -- rows --------------------------------------------------------------------------------------------------

    def poses(self, states: Array, values: Sequence[Mapping[str, float]], varying: Sequence[str]) -> Poses:
        """Return where everything is in states (N, nq) with their parameter values, of which some vary."""
        every = self.mechanism.parameters
        still = all(n in every and every[n].kind in _LOADS for n in varying if self._acts(n))
        bodies, shapes, tendons = [], [], []
        for i, state in enumerate(states):
            if i == 0 or not still:
                self._write(values[i])
            self._move(state)
            bodies.append(self._bodies())
            tendons.append(self._paths())
            if i == 0 or not still:
                shapes.append(self._shapes())
        same = all(np.array_equal(s, self._own) for s in shapes)
        return Poses(np.array(bodies), None if same else np.array(shapes), np.array(tendons))

    def _place(self, state: Array, values: Mapping[str, float]) -> None:
        self._write(values)
        self._move(state)

    def _acts(self, name: str) -> bool:
        """Whether a name is a parameter of the model, or a path of one, and not of a forcing."""
        return name in self.mechanism.parameters or ":" in name

    def _write(self, values: Mapping[str, float]) -> None:
        own = {n: v for n, v in values.items() if self._acts(n)}
        self._writer.write(self.mechanism.parameters, self.mechanism.values(own))
        self._writer.inputs.begin(self._data)

    def _move(self, state: Array) -> None:
        self._data.qpos[:] = state
        with quiet:
            mujoco.mj_kinematics(self.model, self._data)
            if self.model.ntendon:
                mujoco.mj_comPos(self.model, self._data)
                mujoco.mj_tendon(self.model, self._data)

    def _bodies(self) -> Array:
        return np.hstack([self._data.xpos[1:], self._data.xquat[1:]])

    def _shapes(self) -> Array:
        m, g = self.model, self._shown
        return np.hstack([m.geom_pos[g], m.geom_quat[g], m.geom_size[g]])

    def _paths(self) -> Array:
        """Return the points of all tendons, (points, 3), the last one repeated to a number that does not change."""
        d, found = self._data, []
        path = d.wrap_xpos.reshape(-1, 3)
        for k, room in enumerate(self.tendons):
            points = path[d.ten_wrapadr[k] : d.ten_wrapadr[k] + d.ten_wrapnum[k]][:room]
            points = points if len(points) else np.zeros((1, 3))
            found.append(np.concatenate([points, np.repeat(points[-1:], room - len(points), axis=0)]))
        return np.concatenate(found) if found else np.zeros((0, 3))

    # -- the model ---------------------------------------------------------------------------------------------

    def described(self) -> dict[str, Any]:
        """Return the shapes as plain data; arrays stay arrays, lengths in m."""
        m = self.model
        self._place(self.mechanism.qpos0, self.mechanism.values())
        meshes, geoms = self._geoms()
        names = element_names(m, "body")
        return {
            "bodies": [{"name": names[b], "parent": int(m.body_parentid[b]) - 1} for b in range(1, m.nbody)],
            "geoms": geoms + self._sticks,
            "meshes": lightened(meshes),
            "tendons": list(self._tendons()),
            "stick": [[int(m.body_parentid[b]) - 1, b - 1] for b in range(2, m.nbody) if m.body_parentid[b] > 0],
            "pose": Poses(self._bodies(), None, self._paths()),
            **self._view(),
        }

    def _geoms(self) -> tuple[list[Mesh], list[dict[str, Any]]]:
        m, names = self.model, element_names(self.model, "geom")
        meshes: list[Mesh] = []
        known: dict[tuple[int, int], int] = {}
        geoms = []
        for row, g in zip(self._own, self._shown, strict=True):
            kind, data = _GEOM(m.geom_type[g]), int(m.geom_dataid[g])
            size = row[7:]
            if kind == _GEOM.mjGEOM_PLANE:
                size = np.where(size[:3] > 0, size[:3], _ENDLESS * m.stat.extent)
            geom = {
                "name": names[g], "body": int(m.geom_bodyid[g]) - 1, "type": _TYPES[kind], "pos": row[:3].tolist(),
                "quat": row[3:7].tolist(), "size": size.tolist(), "rgba": _color(m, int(g)),
            }
            if _TYPES[kind] == "mesh":
                field = kind == _GEOM.mjGEOM_HFIELD
                if (int(field), data) not in known:
                    known[int(field), data] = len(meshes)
                    meshes.append(of_height_field(m, data) if field else of_mesh(m, data))
                geom["mesh"] = known[int(field), data]
            geoms.append(geom)
        return meshes, geoms

    def _tendons(self) -> Any:
        m, names = self.model, element_names(self.model, "tendon")
        for k, room in enumerate(self.tendons):
            spring = bool(m.tendon_stiffness[k] > 0)
            color = painted(m.tendon_rgba[k], SPRING_COLOR if spring else GREY)
            yield {"name": names[k], "points": room, "width": _SPRING * float(m.stat.extent), "rgba": list(color),
                   "spring": spring}

    def _view(self) -> dict[str, Any]:
        """Return where to look from: across the plane of motion, if there is one; else as MuJoCo's viewer does."""
        m = self.model
        planar = True
        try:
            right, up = plane_axes(m, self._data, None, self.mechanism.name)
            toward = np.cross(right, up)
        except MjcontError:
            planar, toward, up = False, np.array([0.0, -1.0, 0.55]), _AXES[2]
        return {"toward": toward.tolist(), "up": up.tolist(), "planar": planar, "centre": m.stat.center.tolist(),
                "extent": float(m.stat.extent)}


def _shown_geoms(m: mujoco.MjModel) -> Array:
    """Return the numbers of the geoms that MuJoCo's viewer, too, shows."""
    return np.array(
        [g for g in range(m.ngeom) if m.geom_group[g] < HIDDEN_GROUP and _color(m, g)[3] > 0
         and _GEOM(m.geom_type[g]) in _TYPES], dtype=int,
    )


def _color(m: mujoco.MjModel, g: int) -> list[float]:
    material = int(m.geom_matid[g])
    return [float(c) for c in painted(m.geom_rgba[g], painted(m.mat_rgba[material], GREY) if material >= 0 else GREY)]


def _sticks(m: mujoco.MjModel, shown: Array) -> Any:
    """Yield plain links for moving bodies without shapes: from their origin to what hangs on them."""
    clothed = {int(m.geom_bodyid[g]) for g in shown}
    thick = _STICK * float(m.stat.extent)
    for b in range(1, m.nbody):
        if b in clothed or m.body_weldid[b] == 0:
            continue
        ends = [*m.site_pos[m.site_bodyid == b], *m.body_pos[m.body_parentid == b], m.body_ipos[b]]
        base = {"name": "", "body": b - 1, "rgba": list(GREY)}
        ball = {"type": "sphere", "pos": [0.0] * 3, "quat": [1.0, 0.0, 0.0, 0.0], "size": [1.4 * thick, 0.0, 0.0]}
        yield {**base, **ball}
        for end in np.unique(np.round(ends, 9), axis=0):
            length = float(np.linalg.norm(end))
            if length > 1e-9:
                quat = np.zeros(4)
                mujoco.mju_quatZ2Vec(quat, end / length)
                yield {**base, "type": "capsule", "pos": (0.5 * end).tolist(), "quat": quat.tolist(),
                       "size": [thick, 0.5 * length, 0.0]}
