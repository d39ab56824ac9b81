"""REMA: simplices changed towards a metric."""

from ssilang.kernel.mesh.changes.remeshing import Remeshing
from ssilang.kernel.mesh.orientation import orient
from ssilang.kernel.mesh.queries.measure import cell_measures
from ssilang.operators.mesh.metrics import METRIC, REPORT, metric_at, report_mesh
from ssilang.operators.prelude import *

_PASSES = 100
INTERPOLATED = flag("interpolated", "IPOL", en="the metric on the new mesh is given too")


@operator("REMA", METRIC, REPORT, INTERPOLATED, family="mesh", full_name="REMAILLER")
def rema(
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="triangles in the plane, or tetrahedra in space"),
    kept: Mesh | None = Opt("MAILLAGE", en="part of its boundary that stays as it is"),
    points: str = Choice(("AJNO", "NOAJ"), default="AJNO", en="with new points, or without"),
    **said: Any,
) -> Mesh | tuple[Mesh, NodeField]:
    """Simplices made better by local changes, towards a metric."""
    return changed(call, mesh, kept, points == "AJNO", said)


def changed(
    call: Call, mesh: Mesh, kept: Mesh | None, adding: bool, said: Mapping[str, Any]
) -> Mesh | tuple[Mesh, NodeField]:
    """A mesh changed towards the metric that was said, with the metric if that was asked for."""
    ws = workspace(call.session)
    metric, d = said["metric"], ws.dimension
    if {b.cell_type for b in mesh.blocks} != {"TRI3" if d == 2 else "TET4"}:
        raise call.error("operators.mesh.simplices-wanted", mesh)
    whole = orient(mesh, d)
    cells = np.concatenate([b.connectivity for b in whole.blocks])
    ids, local = np.unique(cells, return_inverse=True)
    wanted = None if metric is None else metric_at(call, ids, metric)
    faces = np.zeros((0, d), np.int64)
    if kept is not None:
        faces = np.concatenate([b.connectivity[:, :d] for b in kept.blocks])
        faces = np.searchsorted(ids, faces[np.isin(faces, ids).all(axis=1)])
    work = Remeshing(
        mesh.nodes.coordinates[ids, :d], local.reshape(cells.shape), wanted, faces, adding
    )
    work.improve(_PASSES)
    places, wanted, found = work.found()
    fresh = np.zeros((len(places) - len(ids), 3))
    fresh[:, :d] = places[len(ids) :]
    numbers = np.concatenate([ids, mesh.nodes.add(fresh, ws.density)])
    made = Mesh.of(mesh.nodes, mesh.blocks[0].cell_type, numbers[found], ws.colour)
    measure = sum(float(cell_measures(b).sum()) for b in mesh.blocks)
    own = None if wanted is None else wanted[found].mean(axis=1)
    report_mesh(said["report"], made, measure, own)
    if not said["interpolated"] or wanted is None:
        return made
    used = np.unique(found)
    order = used[np.argsort(numbers[used])]
    parts = {f"G{i + 1}{j + 1}": wanted[order, i, j] for i in range(d) for j in range(i + 1)}
    if isinstance(metric, float) or "G" in metric.components:
        parts = {"G": wanted[order, 0, 0]}
    return made, NodeField.of(mesh.nodes, numbers[order], parts, "DIFFUS")
