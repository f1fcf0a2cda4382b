"""Meshes for a browser: as they are while they are light, with vertices nearby made one where they are not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from mjcont.numerics.equations.problem import Array

# triangles of all meshes of a page together: about 1 MB of it, and what a phone still turns smoothly
MOST_FACES = 50_000
# of a mesh, whatever the others take
_FEWEST = 100
# rows and columns of a height field
_MOST_NODES = 64


@dataclass(frozen=True, slots=True)
class Mesh:
    """Vertices (N, 3) in m, and triangles (M, 3) of their numbers."""

    vertices: Array
    faces: Array


def of_mesh(m: mujoco.MjModel, k: int) -> Mesh:
    """Return one of a model's meshes."""
    v, f = int(m.mesh_vertadr[k]), int(m.mesh_faceadr[k])
    vertices = np.array(m.mesh_vert[v : v + m.mesh_vertnum[k]], dtype=float)
    return Mesh(vertices, np.array(m.mesh_face[f : f + m.mesh_facenum[k]], dtype=int))


def of_height_field(m: mujoco.MjModel, k: int) -> Mesh:
    """Return the surface of a height field, at no more nodes than can be seen."""
    rows, cols, at = int(m.hfield_nrow[k]), int(m.hfield_ncol[k]), int(m.hfield_adr[k])
    heights = np.asarray(m.hfield_data[at : at + rows * cols]).reshape(rows, cols)
    r, c = (np.unique(np.linspace(0, n - 1, min(n, _MOST_NODES)).round().astype(int)) for n in (rows, cols))
    width, depth, high, _ = m.hfield_size[k]
    x, y = np.meshgrid(np.linspace(-width, width, cols)[c], np.linspace(-depth, depth, rows)[r])
    vertices = np.column_stack([x.ravel(), y.ravel(), high * heights[np.ix_(r, c)].ravel()])
    corner = (np.arange(len(r) - 1)[:, None] * len(c) + np.arange(len(c) - 1)).ravel()
    near, far = corner + 1, corner + len(c)
    return Mesh(vertices, np.concatenate([np.column_stack([corner, near, far]),
                                          np.column_stack([near, far + 1, far])]))


def lightened(meshes: Sequence[Mesh], most: int = MOST_FACES) -> list[Mesh]:
    """Return meshes that have at most `most` triangles together; of those that are light themselves nothing is lost."""
    counts = np.array([len(m.faces) for m in meshes])
    if counts.sum() <= most:
        return list(meshes)
    # the number of triangles that no mesh may exceed, such that they fit together
    ordered, left = np.sort(counts), np.arange(len(counts), 0, -1)
    room = most - np.concatenate([[0], np.cumsum(ordered)[:-1]])
    first = int(np.count_nonzero(room >= ordered * left))
    each = int(room[first] // left[first])
    return [m if len(m.faces) <= each else _lighter(m, max(each, _FEWEST)) for m in meshes]


def _lighter(mesh: Mesh, most: int) -> Mesh:
    """Return a mesh of at most so many triangles: the vertices in each cell of a grid made one, at their mean."""
    cells = max(4, int(4.0 * np.sqrt(most)))
    while cells > 1:
        found = _clustered(mesh, cells)
        if 0 < len(found.faces) <= most:
            return found
        cells = int(0.85 * cells)
    return mesh


def _clustered(mesh: Mesh, cells: int) -> Mesh:
    low, span = mesh.vertices.min(axis=0), float(np.ptp(mesh.vertices, axis=0).max()) or 1.0
    place = np.floor((mesh.vertices - low) / span * cells).astype(int)
    _, own = np.unique(place, axis=0, return_inverse=True)
    own = own.ravel()
    count = np.bincount(own)
    vertices = np.column_stack([np.bincount(own, mesh.vertices[:, k]) / count for k in range(3)])
    faces = own[mesh.faces]
    flat = (faces[:, 0] == faces[:, 1]) | (faces[:, 1] == faces[:, 2]) | (faces[:, 0] == faces[:, 2])
    faces = faces[~flat]
    _, first = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    faces = faces[np.sort(first)]
    used, renumbered = np.unique(faces, return_inverse=True)
    return Mesh(vertices[used], renumbered.reshape(-1, 3))
