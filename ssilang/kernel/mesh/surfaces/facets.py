"""A mesh as a surface (a line in the plane) of flat facets, for projections on it."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import envelope
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.surfaces.analytic import Shape

_EDGE = 1e-9  # how far outside of a facet a hit still counts, relative to the facet
_AT_ONCE = 2_000_000  # pairs of a ray and a facet looked at together


def facet_shape(mesh: Mesh) -> Shape:
    """The skin of volumes, the surfaces and the lines of a mesh; distances are not known.

    A cell with more than three nodes is a fan of triangles around the mean of its nodes, a
    quadratic line its two halves.

    Raises
    ------
    MeshError
        If the mesh has only points.
    """
    blocks = (*mesh.blocks, *envelope(mesh).blocks)
    flat = [_triangles(b.coordinates) for b in blocks if b.kind.dimension == 2]
    lines = [_segments(b.coordinates) for b in blocks if b.kind.dimension == 1]
    if not flat and not lines:
        raise MeshError("kernel.mesh.no-facets-to-project-on")
    corners = np.concatenate([*flat, *lines])

    def hit(x: FloatArray, rays: FloatArray) -> FloatArray:
        count = max(1, _AT_ONCE // len(corners))
        parts = [
            _nearest_hit(x[k : k + count], rays[k : k + count], corners)
            for k in range(0, len(x), count)
        ]
        return np.concatenate(parts) if parts else x

    return Shape(lambda x: np.full(len(x), np.nan), hit)


def _triangles(nodes: FloatArray) -> FloatArray:
    """Triangles (t, 3, 3) of cells (n, k, 3) whose nodes go round them."""
    if nodes.shape[1] == 3:
        return nodes
    following = np.roll(nodes, -1, axis=1)
    middle = np.broadcast_to(nodes.mean(axis=1, keepdims=True), nodes.shape)
    return np.stack([nodes, following, middle], axis=2).reshape(-1, 3, 3)


def _segments(nodes: FloatArray) -> FloatArray:
    """Lines of the plane as triangles (t, 3, 3) that stand on it: what crosses them in it."""
    ends = np.stack([nodes[:, :-1], nodes[:, 1:]], axis=2).reshape(-1, 2, 3)
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    above = ends[:, 0] + length[:, None] * np.array([0.0, 0.0, 1.0])
    return np.concatenate([ends, above[:, None]], axis=1)


def _nearest_hit(x: FloatArray, rays: FloatArray, corners: FloatArray) -> FloatArray:
    """Where lines through positions (m, 3) along rays (m, 3) meet triangles (t, 3, 3), or NaN.

    T. Moeller, B. Trumbore, Fast minimum storage ray-triangle intersection, 1997.
    """
    origin = corners[:, 0]
    one, two = corners[:, 1] - origin, corners[:, 2] - origin
    across = np.cross(rays[:, None], two[None])  # (m, t, 3)
    volume = np.einsum("td,mtd->mt", one, across)
    size = np.linalg.norm(np.cross(one, two), axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        arm = x[:, None] - origin[None]
        first = np.einsum("mtd,mtd->mt", arm, across) / volume
        turned = np.cross(arm, one[None])
        second = np.einsum("md,mtd->mt", rays, turned) / volume
        way = np.einsum("td,mtd->mt", two, turned) / volume
        inside = (first >= -_EDGE) & (second >= -_EDGE) & (first + second <= 1 + _EDGE)
    inside &= np.abs(volume) > 1e-12 * size
    away = np.where(inside, np.abs(way), np.inf)
    best = np.argmin(away, axis=1)
    rows = np.arange(len(x))
    made: FloatArray = x + way[rows, best, None] * rays
    made[~np.isfinite(away[rows, best])] = np.nan
    return made
