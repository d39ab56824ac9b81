"""Meshes as sets: ET DIFF INTE UNIQ, and VISA for nodes at the same place."""

from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh import combine
from ssilang.kernel.mesh.surfaces.surface_crossing import crossed
from ssilang.operators.dispatch import DIFF, INTE, worded_union
from ssilang.operators.mesh.selection.boundaries import not_empty
from ssilang.operators.mesh.tolerance import DISTANCE
from ssilang.operators.prelude import *

_SECOND = arg("second", "MAILLAGE", "POINT", en="mesh, or point")
_ALLOWED = flag("allowed", "NOVERIF", en="the result may be empty")


def as_mesh(item: Mesh | Point) -> Mesh:
    """The mesh itself, or a point as a mesh of one POI1."""
    return item.mesh if isinstance(item, Point) else item


@worded_union(
    ("MAILLAGE", "MAILLAGE"), ("POINT", "MAILLAGE"), ("MAILLAGE", "POINT"), ("POINT", "POINT")
)
def unite_meshes(words: Collection[str], left: Mesh | Point, right: Mesh | Point) -> Mesh:
    """Cells of both, in the order given if TELQ is said.

    Else lines are put in the order in which they continue, and the cells of a mesh of several
    types come before those of a mesh of one.
    """
    first, second = as_mesh(left), as_mesh(right)
    as_given = "TELQ" in words
    if not as_given and len(first.blocks) == 1 < len(second.blocks):
        first, second = second, first
    return combine.side_by_side(first, second, as_given)


@DIFF.form()
def difference_of_meshes(
    first: Mesh = Main("MAILLAGE", en="mesh"), second: Mesh | Point = _SECOND
) -> Mesh:
    """Symmetric difference of two meshes."""
    return combine.symmetric_difference(first, as_mesh(second))


@INTE.form()
def intersection_of_meshes(
    first: Mesh = Main("MAILLAGE", en="mesh"),
    second: Mesh | Point = _SECOND,
    allowed: bool = _ALLOWED,
) -> Mesh:
    """Common cells of two meshes."""
    made = combine.intersection(first, as_mesh(second))
    return not_empty(made, allowed, "operators.mesh.no-common-cell")


@INTE.form(said("GEOM"))
def surfaces_that_cross(
    first: Mesh = Arg("MAILLAGE", en="surface of TRI3"),
    second: Mesh = Arg("MAILLAGE", en="surface of TRI3"),
    allowed: bool = _ALLOWED,
) -> tuple[Mesh, Mesh, Mesh, Mesh]:
    """Surfaces cut along their common lines, and these lines."""
    cut = crossed(first, second)
    not_empty(cut[2], allowed, "operators.mesh.no-crossing")
    return cut


_NONE = np.empty(0, dtype=np.int64)


@operator("VISA", family="mesh", full_name="VISAVIS")
def visa(
    call: Call,
    distance: float | None = DISTANCE,
    first: Mesh = Arg("MAILLAGE", en="mesh"),
    second: Mesh | None = Opt(
        "MAILLAGE", en="mesh whose nodes may face them; without it the first itself"
    ),
) -> tuple[Mesh, Mesh]:
    """Pairs of nodes."""
    ws = workspace(call.session)
    reach = ws.density / 10 if distance is None else distance
    if not first.n_cells or (second is not None and not second.n_cells):
        return combine.poi1(ws.nodes, _NONE), combine.poi1(ws.nodes, _NONE)
    if reach <= 0:
        raise call.error("operators.mesh.no-distance")
    here = first.sorted_node_ids
    there = here if second is None else second.sorted_node_ids
    a, b = facing(ws.nodes, here, there, reach)
    return combine.poi1(ws.nodes, a), combine.poi1(ws.nodes, b)


def facing(
    nodes: NodeTable, here: IntArray, there: IntArray, distance: float
) -> tuple[IntArray, IntArray]:
    """Each node of `here` with the nearest other node of `there` not farther than `distance`.

    Within one set each pair is given once.
    """
    xyz = nodes.coordinates
    gaps, places = spatial.cKDTree(xyz[there]).query(xyz[here], k=min(2, len(there)))
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
