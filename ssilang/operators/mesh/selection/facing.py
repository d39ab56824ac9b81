"""VISA: nodes of two meshes that stand at the same place."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.language.registry import Help, arg, operator, opt
from ssilang.language.run.call import Call
from ssilang.operators.mesh.tolerance import DISTANCE
from ssilang.operators.workspace import workspace

_NONE = np.empty(0, dtype=np.int64)


@operator(
    "VISA",
    DISTANCE,
    arg("first", "MAILLAGE", en="mesh"),
    opt("second", "MAILLAGE", en="mesh whose nodes may face them; without it the first itself"),
    family="mesh",
    full_name="VISAVIS",
    help=Help(
        en="Nodes of a mesh that have a node of a second one at their place, and these nodes, as "
        "two meshes of POI1 in the same order; of one mesh alone, its double nodes. Places are the "
        "same within the distance given, else within a tenth of the density in force.",
        syntax="MAIL1 MAIL2 = VISA (FLOT1) GEO1 (GEO2) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; A = DROI 2 (0. 0.) (1. 0.) ; B = DROI 2 (0. 0.) (1. 0.) ; "
            "M N = VISA 1.E-6 A B ; MESS (NBNO M) ;",
        ),
    ),
)
def visa(call: Call, distance: float | None, first: Mesh, second: Mesh | None) -> tuple[Mesh, Mesh]:
    """Pairs of nodes."""
    ws = workspace(call.session)
    reach = ws.density / 10 if distance is None else distance
    if not first.n_cells or (second is not None and not second.n_cells):
        return poi1(ws.nodes, _NONE), poi1(ws.nodes, _NONE)
    if reach <= 0:
        raise call.error("operators.mesh.no-distance")
    here = first.sorted_node_ids
    there = here if second is None else second.sorted_node_ids
    a, b = facing(ws.nodes, here, there, reach)
    return poi1(ws.nodes, a), poi1(ws.nodes, b)


def facing(
    nodes: NodeTable, here: IntArray, there: IntArray, distance: float
) -> tuple[IntArray, IntArray]:
    """Each node of `here` with the nearest other node of `there` not farther than `distance`.

    Within one set each pair is given once.
    """
    from scipy.spatial import cKDTree

    xyz = nodes.coordinates
    gaps, places = cKDTree(xyz[there]).query(xyz[here], k=min(2, len(there)))
    gaps, places = (np.reshape(a, (len(here), -1)) for a in (gaps, places))
    # a node of both meshes is its own counterpart only if there is no other
    own = there[places[:, 0]] == here
    column = np.where(own & (gaps.shape[1] > 1), 1, 0)
    rows = np.arange(len(here))
    partner, gap = there[places[rows, column]], gaps[rows, column]
    found = (gap < distance) & (partner != here)
    if np.array_equal(here, there):
        found &= here < partner
    return here[found], partner[found]
