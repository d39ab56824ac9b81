"""VORO: Voronoi partition of a plane domain."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.surfaces.surface import contour_cells
from ssilang.kernel.mesh.surfaces.voronoi import OUTSIDE, VoronoiPartition, voronoi_partition
from ssilang.language.registry import Help, arg, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, Mot, Table
from ssilang.operators.workspace import workspace


@operator(
    "VORO",
    arg("germs", "MAILLAGE", en="points of the cells"),
    arg("contour", "MAILLAGE", en="closed line of SEG2"),
    opt("weights", "CHPOINT", en="weights of the points", unit="m"),
    family="mesh",
    full_name="VORONOI",
    help=Help(
        en="Voronoi partition of the inside of a closed line of SEG2 (2D): each cell holds what is "
        "nearest to one point of a mesh of POI1. Weights w at the points make it a partition by "
        "the least d^2 - w^2. The table has 'VISU', all edges; 'POND', the weights; 'ARTS', the "
        "edges 1, 2 ...; 'CELL', indexed by point: 'VISU', the edges round it, 'ARTS', their "
        "numbers, 'VOIS', the points of the cells beside it.",
        syntax="TAB1 = VORO MAIL1 MAIL2 (CHPO1) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; L = A D 1 (2. 0.) D 1 (2. 1.) D 1 (0. 1.) D 1 A ; "
            "P = 0.5 0.5 ; T = VORO (P ET (1.5 0.5)) L ; LIST (MESU (T . 'CELL' . P . 'VISU')) ;",
        ),
    ),
)
def voro(call: Call, germs: Mesh, contour: Mesh, weights: NodeField | None) -> Table:
    """Cells, edges and neighbours."""
    ws = workspace(call.session)
    if ws.dimension != 2:
        raise call.error("operators.mesh.plane-only")
    if any(b.cell_type != "POI1" for b in germs.blocks) or not germs.n_cells:
        raise call.error("operators.mesh.germs-are-points", germs)
    if any(b.cell_type != "SEG2" for b in contour.blocks):
        raise call.error("operators.mesh.contour-of-segments", contour)
    nodes = germs.nodes
    places = np.concatenate([b.connectivity[:, 0] for b in germs.blocks])
    sides = contour_cells(contour)
    corners, local = np.unique(sides, return_inverse=True)
    sizes = np.zeros(len(places))
    if weights is not None:
        sizes = weights.values_at(next(iter(weights.components)), places, 0.0)
    x = nodes.coordinates
    found = voronoi_partition(
        x[places, :2].copy(), sizes, x[corners, :2].copy(), local.reshape(sides.shape)
    )
    fresh = nodes.add(found.points[len(corners) :], ws.density)
    edges = np.concatenate([corners, fresh])[found.edges]
    return _Told(germs, places, sizes, found, edges, ws.colour).table()


class _Told:
    """The partition in the language's objects."""

    def __init__(
        self,
        germs: Mesh,
        places: IntArray,
        weights: FloatArray,
        found: VoronoiPartition,
        edges: IntArray,
        colour: int,
    ) -> None:
        self.nodes, self.colour = germs.nodes, colour
        self.places, self.weights = places, weights
        self.owners, self.edges = found.owners, edges

    def table(self) -> Table:
        arcs, cells, told = Table(), Table(), Table()
        for number, edge in enumerate(self.edges, 1):
            arcs.set(number, self._lines(edge[None]))
        for germ, place in enumerate(self.places):
            cells.set(Point(self.nodes, int(place)), self._cell(germ))
        order = np.argsort(self.places)
        values = NodeValues(self.places[order], self.weights[order])
        told.set(Mot("VISU"), self._lines(self.edges))
        told.set(Mot("POND"), NodeField(self.nodes, {"SCAL": values}, "DIFFUS"))
        told.set(Mot("CELL"), cells)
        told.set(Mot("ARTS"), arcs)
        return told

    def _cell(self, germ: int) -> Table:
        """Edges with the germ's cell on their left, their numbers, and the cells beside it."""
        left, right = self.owners[:, 0] == germ, self.owners[:, 1] == germ
        rows = np.flatnonzero(left | right)
        lines = np.where(left[rows, None], self.edges[rows], self.edges[rows][:, ::-1])
        beside = np.where(left[rows], self.owners[rows, 1], self.owners[rows, 0])
        beside = np.unique(beside[beside != OUTSIDE])
        cell = Table()
        cell.set(Mot("VISU"), self._lines(lines))
        cell.set(Mot("ARTS"), ListEnti(rows + 1))
        cell.set(Mot("VOIS"), poi1(self.nodes, self.places[beside], self.colour))
        return cell

    def _lines(self, table: IntArray) -> Mesh:
        return Mesh.of(self.nodes, "SEG2", table, self.colour)
