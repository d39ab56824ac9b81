"""Nodes of two lines, or of a line and a rigid projectile, that touch as they lie now.

A possible link is a cell: the node of a multiplier, then either the ends of a segment of the master
and a node of the slave, or the projectile's point and a node of the master. Of those whose nodes
touch, or have gone into each other, come relations

    n . (sum_i M_i u_i - u_s) <= 0,    n . (u_P - u_m) <= 0

of what goes in, so that multipliers are positive where they push; M are the segment's shape
functions at the foot of the slave's node, n the outer normal there: of the segment, or of the
projectile's nose.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.contact.unilateral import BEHIND, FACING, NOTHING, OUTSIDE, side_of
from ssilang.kernel.matrices.matrix import Relations
from ssilang.kernel.matrices.relations import joined, rows_from_table
from ssilang.kernel.mesh.cells import many_noded
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

OF_LINES, OF_PROJECTILE = "MULT4", "MULT3"
"""Cells of possible links, whose types are made with the first of them."""


@dataclass(frozen=True, eq=False)
class Nose:
    """Front of a rigid projectile, whose foremost point is its node."""

    shape: str  # 'HEMI', 'PLAT' or 'CONE'
    axis: FloatArray  # (2,) unit vector out of the nose
    size: float  # radius ('HEMI'), or width
    angle: float = 0.0  # of a cone, from its axis to its side, radians

    def touched(self, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Outer normals (n, 2) and gaps (n,) at places `away` (n, 2) from the point.

        Gaps are infinite beside the nose.
        """
        ahead = away @ self.axis
        side = away - ahead[:, None] * self.axis
        width = np.linalg.norm(side, axis=1)
        beside = width > 0.5 * self.size * (1 + OUTSIDE)
        normals, gaps = np.broadcast_to(self.axis, away.shape), ahead
        if self.shape == "HEMI":
            normals = away + self.size * self.axis
            gaps, beside = np.linalg.norm(normals, axis=1) - self.size, ahead < -self.size
        elif self.shape == "CONE":
            c, s = np.cos(self.angle), np.sin(self.angle)
            normals = c * side / np.where(width > 0.0, width, 1.0)[:, None] + s * self.axis
            gaps = c * width + s * ahead
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        return normals / np.where(length > 0.0, length, 1.0), np.where(beside, np.inf, gaps)


def possible_links(master: Mesh, slave: Mesh) -> Mesh:
    """All links of a line (SEG2, the other on its right) with another or with projectiles (POI1).

    Relations of one node of the slave line share a multiplier: it touches one segment at a time.

    Raises
    ------
    MeshError
        For other cells, or if no segments of the lines face each other.
    """
    line, table = side_of(master, 2), master.nodes
    if all(b.cell_type == "POI1" for b in slave.blocks):
        links = _pairs(slave.node_ids[:, None], np.unique(line.cells))
        unlike = links
    else:
        other = side_of(slave, 2)
        if (line.normals @ other.normals.T > FACING).all():
            raise MeshError("kernel.contact.lines-do-not-face")
        links = _pairs(line.cells, np.unique(other.cells))
        unlike = links[:, -1:]
    _, first, place = np.unique(unlike, axis=0, return_index=True, return_inverse=True)
    multipliers = table.add(table.coordinates[links[first, -1]])
    cells = np.column_stack([multipliers[place.ravel()], links])
    return Mesh.of(table, many_noded("MULT", cells.shape[1]), cells)


def within(one: Mesh, other: Mesh, reach: float) -> tuple[Mesh, Mesh]:
    """Cells of two sides with a node no farther than `reach` from one of the other's.

    Raises
    ------
    MeshError
        If there are none.
    """

    def near(mesh: Mesh, side: Mesh) -> Mesh:
        nodes, points = mesh.node_ids, mesh.nodes.coordinates
        apart = np.asarray(spatial.cKDTree(points[side.node_ids]).query(points[nodes])[0])
        if (nearest := float(apart.min())) > reach:
            raise MeshError("kernel.contact.sides-out-of-reach", reach=reach, nearest=nearest)
        close = nodes[apart <= reach]
        return take(mesh, lambda b: np.asarray(np.isin(b.connectivity, close).any(axis=1)))

    return near(one, other), near(other, one)


def _pairs(cells: IntArray, nodes: IntArray) -> IntArray:
    """Each of the cells (n, k) with each node (m,) that is not its own: (links, k + 1)."""
    found = np.column_stack([np.repeat(cells, len(nodes), axis=0), np.tile(nodes, len(cells))])
    return found[(found[:, :-1] != found[:, -1:]).all(axis=1)]


def touching(links: Mesh, unknowns: tuple[str, str], nose: Nose | None = None) -> Relations | None:
    """Relations of the possible links whose nodes touch now; None where none do.

    Parameters
    ----------
    unknowns : tuple of str
        Displacements along the axes.
    nose : Nose, optional
        Of the projectile; for links of lines it is not asked.
    """
    parts = [_rows(b, unknowns, nose) for b in links.blocks]
    kept = [p for p in parts if p is not None]
    return joined(kept) if kept else None


def _rows(block: CellBlock, unknowns: tuple[str, str], nose: Nose | None) -> Relations | None:
    multipliers, nodes = block.connectivity[:, 0], block.connectivity[:, 1:]
    x = block.nodes.coordinates[nodes][..., :2]
    away = x[:, -1] - x[:, 0]
    if block.cell_type == OF_PROJECTILE:
        assert nose is not None
        normals, gaps = nose.touched(away)
        size, weights = np.full(len(x), nose.size), np.tile([1.0, -1.0], (len(x), 1))
    else:
        along = x[:, 1] - x[:, 0]
        size = np.linalg.norm(along, axis=1)
        normals = np.stack([along[:, 1], -along[:, 0]], axis=1) / size[:, None]
        foot = np.einsum("nd,nd->n", away, along) / size**2
        off = np.maximum(-foot, foot - 1.0) > OUTSIDE
        gaps = np.where(off, np.inf, np.einsum("nd,nd->n", away, normals))
        weights = np.column_stack([1.0 - foot, foot, -np.ones(len(x))])
    touched = np.flatnonzero((gaps <= OUTSIDE * size) & (gaps >= -BEHIND * size))
    nearest = touched[np.argsort(np.abs(gaps[touched]), kind="stable")]
    kept = np.sort(nearest[np.unique(multipliers[nearest], return_index=True)[1]])
    if len(kept) == 0:
        return None
    values = (weights[kept, :, None] * normals[kept, None, :]).reshape(len(kept), -1)
    values[np.abs(values) <= NOTHING] = 0.0
    columns = np.repeat(nodes[kept], 2, axis=1)
    names = unknowns * nodes.shape[1]
    return rows_from_table(block.nodes, columns, names, values, -1, multipliers[kept])
