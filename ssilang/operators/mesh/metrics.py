"""Metrics of cells, as operators read them: a length, or tensors at nodes."""

from ssilang.kernel.mesh.queries import quality
from ssilang.kernel.mesh.queries.measure import cell_measures
from ssilang.operators.prelude import *

METRIC = opt(
    "metric",
    "FLOTTANT",
    "CHPOINT",
    en="length wanted, or metric G (G11 G21 G22 ...) in length^-2",
    range=POSITIVE,
)
REPORT = opt("report", "TABLE", en="gets 'curtopo', 'dvol', 'nnul', 'miq', 'moq' and 'maq'")


def metric_at(call: Call, nodes: IntArray, metric: float | NodeField) -> FloatArray:
    """The metric (..., d, d) at nodes (...)."""
    dimension = workspace(call.session).mode.dimension
    if not isinstance(metric, NodeField):
        return np.broadcast_to(np.eye(dimension) / metric**2, (*nodes.shape, dimension, dimension))
    names = {(i, j): f"G{i + 1}{j + 1}" for i in range(dimension) for j in range(i + 1)}
    if "G" in metric.components:
        names = {(i, i): "G" for i in range(dimension)}
    missing = [n for n in names.values() if n not in metric.components]
    if missing:
        raise call.error("operators.mesh.metric-incomplete", metric, missing=missing)
    M = np.zeros((*nodes.shape, dimension, dimension))
    for (i, j), name in names.items():
        values = metric.values_at(name, nodes.ravel()).reshape(nodes.shape)
        M[..., i, j] = M[..., j, i] = values
    return M


def report_mesh(
    table: Table | None, made: Mesh, wanted: float, metric: FloatArray | None = None
) -> None:
    """Write how good a mesh is into a table: metric (n_cells, d, d), its measure wanted."""
    if table is None:
        return
    (block,) = made.blocks
    x = block.coordinates if metric is None else block.coordinates[..., : metric.shape[-1]]
    measures, found = cell_measures(block), quality.quality_in_metric(x, metric)
    told: dict[str, Any] = {
        "curtopo": made,
        "dvol": float(measures.sum()) - abs(wanted),
        "nnul": int((measures <= _FLAT * measures.mean()).sum()),
        "miq": float(found.min()),
        "moq": float(found.mean()),
        "maq": float(found.max()),
    }
    for name, value in told.items():
        table.set(Mot(name), value)


_FLAT = 1e-11
"""Share of the mean cell below which one counts as flat."""
