"""Nodes that stand at one place: ELIM merges them, REGE clears cells of them, DEDO makes them."""

from ssilang.kernel.mesh.changes import merge
from ssilang.operators.mesh.tolerance import DISTANCE, tolerance_of
from ssilang.operators.prelude import *


@operator("ELIM", family="mesh", full_name="ELIMINATION")
def elim(
    call: Call,
    first: Mesh | Point = Arg("MAILLAGE", "POINT", en="mesh, or point"),
    second: Mesh | Point | None = Opt(
        "MAILLAGE", "POINT", en="mesh whose nodes are merged with those of the first"
    ),
    distance: float | None = DISTANCE,
) -> Mesh | Point:
    """Merge close nodes; gives the first object back."""
    ws = workspace(call.session)
    ids = first.node_ids
    near = max(tolerance_of(ws, distance, ws.nodes.coordinates[ids]), 1e-300)
    meshes = [m for m in (first, second) if isinstance(m, Mesh)]
    before = sum(map(merge.repeated_nodes, meshes))
    if second is None:
        merge.merge_close(ws.nodes, ids, near)
    else:
        others = second.node_ids
        apart = not np.isin(ids, others).any()
        merge.merge_between(ws.nodes, ids, others, near)
        if apart and not np.isin(first.node_ids, second.node_ids).any():
            call.warn("operators.mesh.nothing-merged", distance=near)
    if (count := sum(map(merge.repeated_nodes, meshes)) - before) > 0:
        call.warn("operators.mesh.cells-closed", distance=near, count=count)
    return first


@operator("REGE", family="mesh", full_name="REGENERER")
def rege(
    session: Session,
    mesh: Mesh = Arg("MAILLAGE", en="mesh"),
    check: bool = Flag("VERI", en="warn of what is left"),
) -> Mesh:
    """Replace degenerate cells."""
    made = merge.regenerate(mesh)
    left = merge.repeated_nodes(made) if check else 0
    if left:
        session.print(session.told("operators.mesh.doubles-left", count=left))
    return made


@operator("DEDO", family="mesh", full_name="DEDOUBLER")
def dedo(
    surface: Mesh = Arg("MAILLAGE", en="surface"),
    line: Mesh = Arg("MAILLAGE", en="line of its edges"),
) -> tuple[Mesh, Mesh]:
    """Double the nodes of a line."""
    return merge.cut_open(surface, line)
