"""How far two sides face each other with cells that do not fit together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.mesh.mesh import CellBlock

_POINTS = 8  # looked at on a segment; 16 on a triangle
_ALIGNED = 0.7  # cosine between the normals of cells that face each other
_FLAT = 1e-20  # squared sine of the angle between edges of a simplex without surface


@dataclass(frozen=True)
class Simplices:
    """Straight segments or triangles of cells: corners (m, 2 or 3, 3), the cell of each (m,)."""

    corners: FloatArray
    cell: IntArray

    @classmethod
    def of(cls, blocks: Iterable[tuple[CellBlock, IntArray]]) -> Simplices:
        """Those of the given rows of blocks of lines, or of facets (quadrangles are halved)."""
        made = list(_straight(blocks))
        cells, before = [], 0
        for _, rows in made:
            cells.append(np.unique(rows, return_inverse=True)[1] + before)
            before = int(cells[-1].max()) + 1
        return cls(np.concatenate([x for x, _ in made]), np.concatenate(cells))

    def vectors(self) -> FloatArray:
        """Along a segment, or normal to a triangle, (m, 3): as long as the measure."""
        edges = self.corners[:, 1:] - self.corners[:, :1]
        return edges[:, 0] if edges.shape[1] == 1 else np.cross(edges[:, 0], edges[:, 1]) / 2.0

    def measures(self) -> FloatArray:
        """Lengths or areas (m,)."""
        return np.asarray(np.linalg.norm(self.vectors(), axis=1))


def _straight(
    blocks: Iterable[tuple[CellBlock, IntArray]],
) -> Iterator[tuple[FloatArray, IntArray]]:
    for block, rows in blocks:
        corners = block.coordinates[rows][:, list(block.kind.corners)]
        if corners.shape[1] < 4:
            yield corners, rows
        else:
            halves = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
            yield halves, np.concatenate([rows, rows])


def _samples(corners: int) -> FloatArray:
    """Barycentric coordinates (p, corners) of points that stand for equal parts."""
    if corners == 2:
        t = (np.arange(_POINTS) + 0.5) / _POINTS
        return np.column_stack([1.0 - t, t])
    n = 4
    up = [(i + 1 / 3, j + 1 / 3) for i in range(n) for j in range(n - i)]
    down = [(i + 2 / 3, j + 2 / 3) for i in range(n) for j in range(n - 1 - i)]
    xy = np.array(up + down) / n
    return np.column_stack([1.0 - xy.sum(axis=1), xy])


def facing_parts(ours: Simplices, theirs: Simplices, tolerance: float) -> FloatArray:
    """Part (m,) of each of our simplices that one of theirs faces within a distance, 0 to 1.

    A point faces a simplex if its foot lies inside of it, not beyond its edges, and the two are
    nearly parallel: neighbours in one line, or round a corner, do not face each other.
    """
    from scipy.spatial import cKDTree

    weights = _samples(ours.corners.shape[1])
    points = np.einsum("pk,mkx->mpx", weights, ours.corners)
    centres = theirs.corners.mean(axis=1)
    radius = np.linalg.norm(theirs.corners - centres[:, None], axis=2).max() + tolerance
    found = cKDTree(centres).query_ball_point(points.reshape(-1, 3), radius)
    rows = np.repeat(np.arange(len(found)), [len(f) for f in found])
    met = np.zeros(len(found), dtype=bool)
    if len(rows):
        partner = np.concatenate([np.asarray(f, dtype=np.int64) for f in found])
        faces = _faces(points.reshape(-1, 3)[rows], theirs.corners[partner], tolerance)
        own, other = _unit(ours.vectors())[rows // len(weights)], _unit(theirs.vectors())[partner]
        faces &= np.abs((own * other).sum(axis=1)) > _ALIGNED
        np.logical_or.at(met, rows, faces)
    return np.asarray(met.reshape(len(points), -1).mean(axis=1))


def _unit(vectors: FloatArray) -> FloatArray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0.0, length, 1.0)


def _faces(points: FloatArray, corners: FloatArray, tolerance: float) -> BoolArray:
    """Whether the foot of each point (n, 3) lies in its simplex (n, k, 3), near enough.

    A flat simplex faces nothing.
    """
    edges = corners[:, 1:] - corners[:, :1]
    gram = np.einsum("nix,njx->nij", edges, edges)
    lengths = np.einsum("nii->ni", gram)
    flat = np.linalg.det(gram) <= _FLAT * lengths.prod(axis=1)
    gram[flat] = np.eye(edges.shape[1])
    away = points - corners[:, 0]
    foot = np.linalg.solve(gram, np.einsum("nix,nx->ni", edges, away)[..., None])[..., 0]
    inside = (foot >= 0.0).all(axis=1) & (foot.sum(axis=1) <= 1.0)
    distance = np.linalg.norm(away - np.einsum("ni,nix->nx", foot, edges), axis=1)
    return np.asarray(inside & (distance <= tolerance) & ~flat)
