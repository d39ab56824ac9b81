"""Volumes inside closed surfaces: tetrahedra, with pyramids on the quadrangles of the skin."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.changes.degree import quadratic
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.volumes.tetrahedralize import ray_inside, tetrahedralize

_HEIGHTS = (0.35, 0.2, 0.1)  # of the pyramids, in sides of their base, tried in turn


def fill_volume(skin: Mesh, colour: int = 0) -> Mesh:
    """The mesh inside a closed surface, which keeps the surface's cells as its faces.

    Triangles carry tetrahedra, quadrangles carry pyramids; TRI6 and QUA8 give TE10 and PY13.

    Raises
    ------
    MeshError
        If the skin is open, holds other cells, mixes degrees, or cannot be filled.
    """
    kinds = {b.cell_type for b in skin.blocks}
    if not kinds or not (kinds <= {"TRI3", "QUA4"} or kinds <= {"TRI6", "QUA8"}):
        raise MeshError("kernel.mesh.volume-filled-tri3-qua4", kinds=sorted(kinds))
    triangles = _corners(skin, ("TRI3", "TRI6"))
    quads = _corners(skin, ("QUA4", "QUA8"))
    if not len(quads):
        return _filled(skin, triangles, None, colour)
    for height in _HEIGHTS:
        try:
            return _filled(skin, triangles, _apexes(skin, triangles, quads, height), colour)
        except MeshError as problem:
            last = problem
    raise last


def _corners(skin: Mesh, kinds: tuple[str, ...]) -> IntArray:
    """Corner nodes of the cells of some types."""
    parts = [b.connectivity[:, list(b.kind.corners)] for b in skin.blocks if b.cell_type in kinds]
    width = 4 if "QUA4" in kinds else 3
    return np.concatenate(parts) if parts else np.empty((0, width), dtype=np.int64)


def _filled(
    skin: Mesh, triangles: IntArray, pyramids: tuple[IntArray, FloatArray] | None, colour: int
) -> Mesh:
    nodes = skin.nodes
    quads = np.empty((0, 4), dtype=np.int64) if pyramids is None else pyramids[0]
    ids, local = np.unique(np.concatenate([triangles.ravel(), quads.ravel()]), return_inverse=True)
    points = nodes.coordinates[ids].copy()
    faces = local[: triangles.size].reshape(-1, 3).astype(np.int64)
    bases = local[triangles.size :].reshape(-1, 4).astype(np.int64)
    apexes = np.empty((0, 3))
    if pyramids is not None:
        apexes = pyramids[1]
        tips = len(points) + np.arange(len(bases))
        around = [np.column_stack([bases[:, k], bases[:, (k + 1) % 4], tips]) for k in range(4)]
        faces = np.vstack([faces, *around])
        points = np.vstack([points, apexes])
    every, cells = tetrahedralize(points, faces)
    inner = every[len(ids) :]
    density = float(skin.nodes.density[skin.node_ids].mean())
    made = nodes.add(inner, np.full(len(inner), density))
    table = np.concatenate([ids, made])
    volume = Mesh.of(nodes, "TET4", table[cells], colour)
    if pyramids is not None:
        tips = table[len(ids) + np.arange(len(bases))]
        shells = Mesh.of(nodes, "PYR5", np.column_stack([quads, tips]), colour)
        volume = union(volume, shells, as_given=True)
    if any(b.kind.degree == 2 for b in skin.blocks):
        return quadratic(volume, skin)
    return volume


def _apexes(
    skin: Mesh, triangles: IntArray, quads: IntArray, height: float
) -> tuple[IntArray, FloatArray]:
    """Bases turned so that their normals go inside, and apexes (q, 3) of their pyramids."""
    x = skin.nodes.coordinates[quads]
    centre = x.mean(axis=1)
    normal = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    side = np.linalg.norm(np.roll(x, -1, axis=1) - x, axis=2).mean(axis=1)[:, None]
    closed = np.vstack([triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    inside = ray_inside(centre + 1e-3 * side * normal, skin.nodes.coordinates, closed)
    turned = np.where(inside[:, None], quads, quads[:, [0, 3, 2, 1]])
    sign = np.where(inside, 1.0, -1.0)[:, None]
    # apexes in one plane on one circle would give tetrahedra without volume between them
    disorder = np.random.default_rng(1).uniform(-0.03, 0.03, centre.shape) * side
    return turned, centre + sign * height * side * normal + disorder
