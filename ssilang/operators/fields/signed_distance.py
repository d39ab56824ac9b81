"""PSIP: signed distances to lines and surfaces."""

from ssilang.kernel.base.scientific import spatial
from ssilang.kernel.mesh.queries.signed_distance import beyond_front, beyond_tip, signed_distance
from ssilang.operators.prelude import *

_ENDS = many("ends", "POINT", "MAILLAGE", en="ends of the line (2D) or front of the surface (3D)")


@operator(
    "PSIP",
    gives=by("ahead", {"DEUX": ("CHPOINT",) * 2, "TROI": ("CHPOINT",) * 3}, "CHPOINT"),
    family="fields",
)
def psip(
    call: Call,
    place: Mesh | Point = Arg("MAILLAGE", "POINT", en="where"),
    mesh: Mesh = Arg("MAILLAGE", en="line or surface"),
    reach: float | None = Opt(
        "FLOTTANT",
        range=NOT_NEGATIVE,
        en="nodes farther away (largest coordinate) are left out",
        unit="m",
    ),
    ahead: Chosen | None = Cases(
        {"DEUX": [_ENDS], "TROI": [_ENDS]},
        en="distances ahead of the ends too, and the abscissa along a front",
    ),
) -> NodeField | tuple[NodeField, ...]:
    """Signed distances."""
    ws = workspace(call.session)
    nodes = place.sorted_node_ids
    points = ws.nodes.coordinates[nodes]
    phi = signed_distance(points, mesh, ws.dimension)
    rows = {"PHI": phi}
    if ahead is not None:
        rows |= _ahead(call, ahead.word, points, mesh, ahead["ends"])
    kept = np.ones(len(nodes), bool) if reach is None else _near(points, mesh, reach)
    made = [NodeField.of(ws.nodes, nodes[kept], {k: v[kept]}, "DIFFUS") for k, v in rows.items()]
    return made[0] if len(made) == 1 else tuple(made)


def _near(points: Any, mesh: Mesh, reach: float) -> Any:
    """Points within a reach (largest coordinate) of a node of the mesh."""
    tree = spatial.cKDTree(mesh.nodes.coordinates[mesh.sorted_node_ids])
    return tree.query(points, p=np.inf)[0] <= reach


def _ahead(call: Call, word: str, points: Any, mesh: Mesh, ends: tuple[Any, ...]) -> dict[str, Any]:
    if workspace(call.session).dimension == 2:
        fits = word == "DEUX" and len(ends) in (1, 2)
        if not fits or not all(isinstance(e, Point) for e in ends):
            raise call.error("operators.fields.ends-are-points")
        return {"PSI": beyond_tip(points, mesh, tuple(e.node for e in ends))}
    if len(ends) != 1 or not isinstance(ends[0], Mesh):
        raise call.error("operators.fields.front-is-a-line-mesh", word=word)
    ahead, along = beyond_front(points, mesh, ends[0])
    return {"PSI": ahead} | ({"TAU": along} if word == "TROI" else {})
