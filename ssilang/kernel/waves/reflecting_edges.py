"""Edges of a ground that send back what comes to them: those without dampers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.materials.model import Model
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import Mesh

#: a face whose middle lies so far above its cell's, as a share of the way, is the surface's
UPWARDS = 0.5


@dataclass(frozen=True)
class Reflecting:
    """The nearest node of an edge without dampers, its way from a mesh, and how many there are."""

    place: FloatArray
    distance: float
    count: int


def reflecting_edges(model: Model, near: Mesh, dampers: Matrix | None) -> Reflecting | None:
    """Sides and bottom of a ground without dampers, None if all have some.

    Parameters
    ----------
    model : Model
        Of the ground alone.
    near : Mesh
        What the distance is taken from.
    """
    outline = _sides_and_bottom(model)
    blocks = () if dampers is None else dampers.blocks
    damped = [b.nodes.ravel() for b in blocks]
    bare = np.setdiff1d(outline, np.concatenate([np.empty(0, np.int64), *damped]))
    if not len(bare):
        return None
    xyz = model.zones[0].cells.nodes.coordinates
    of_near = xyz[near.sorted_node_ids]
    distances = np.array([np.linalg.norm(of_near - xyz[n], axis=1).min() for n in bare])
    i = int(np.argmin(distances))
    return Reflecting(xyz[bare[i]], float(distances[i]), len(bare))


def _sides_and_bottom(model: Model) -> IntArray:
    """Nodes of faces of one cell only that do not look up."""
    faces: dict[bytes, tuple[int, IntArray]] = {}
    axis = model.zones[0].mode.dimension - 1
    for cells in (zone.cells for zone in model.zones):
        xyz = cells.coordinates
        middles = xyz.mean(axis=1)
        for _, local in CELL_TYPES[cells.cell_type].faces:
            way = xyz[:, local].mean(axis=1) - middles
            up = way[:, axis] > UPWARDS * np.linalg.norm(way, axis=1)
            for nodes, rises in zip(cells.connectivity[:, local], up, strict=True):
                key = np.sort(nodes).tobytes()
                seen = faces.get(key, (0, nodes))[0]
                faces[key] = (seen + 1 + int(rises) * 2, nodes)
    outer = [nodes for count, nodes in faces.values() if count == 1]
    return np.unique(np.concatenate([np.empty(0, np.int64), *outer]))
