"""Shape of cells (INDI) and what is wrong with a mesh (VERM)."""

from ssilang.kernel.mesh.combine import without_duplicates
from ssilang.kernel.mesh.queries import quality
from ssilang.operators.prelude import *

_MEASURES: dict[str, tuple[tuple[str, ...], Callable[[FloatArray], FloatArray]]] = {
    "PLAN": (("QUA4",), quality.flatness),
    "ASPE": (("TRI3", "TET4"), quality.aspect_ratio),
    "SKEW": (("TRI3", "TET4"), quality.skewness),
}


@operator("INDI", family="mesh", full_name="INDICATEUR")
def indi(
    call: Call,
    measures: list[str] = Key(
        tuple(_MEASURES),
        optional=False,
        repeated=True,
        en="flatness of QUA4, aspect ratio, skewness of TRI3 and TET4",
    ),
    mesh: Mesh = Arg("MAILLAGE", en="cells"),
) -> CellField:
    """Shape of cells."""
    blocks = tuple(_block(call, b, measures) for b in mesh.blocks)
    return CellField(blocks, "SCALAIRE")


@indi.form(said("TOPO"))
def topological(
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="triangles or tetrahedra"),
    metric: float | NodeField | None = Opt(
        "FLOTTANT",
        "CHPOINT",
        en="length wanted, or metric G (G11 G21 G22 ...) in length^-2",
        range=POSITIVE,
    ),
    listed: bool = Flag("LISTREEL", en="a list is given"),
) -> CellField | ListReel:
    """Quality of cells, in a metric."""
    kinds = {b.cell_type for b in mesh.blocks}
    if len(mesh.blocks) != 1 or not kinds <= {"TRI3", "TET4"}:
        raise call.error("operators.mesh.simplices-wanted", mesh)
    cells = mesh.blocks[0]
    wanted: FloatArray | None = None
    if isinstance(metric, NodeField):
        wanted = _metric(call, cells, metric, workspace(call.session).mode.dimension)
    elif metric is not None:
        wanted = np.broadcast_to(np.eye(3) / metric**2, (len(cells), 3, 3))
    values = quality.quality_in_metric(cells.coordinates, wanted)
    if listed:
        return ListReel(values)
    block = CellFieldBlock(cells, {"SCAL": values[:, None]}, "GRAVITE")
    return CellField((block,), "SCALAIRE")


def _metric(call: Call, cells: CellBlock, field: NodeField, dimension: int) -> FloatArray:
    """Mean over the nodes of each cell of the metric (n, 3, 3)."""
    names = {(i, j): f"G{i + 1}{j + 1}" for i in range(dimension) for j in range(i + 1)}
    if "G" in field.components:
        names = {(i, i): "G" for i in range(dimension)}
    missing = [n for n in names.values() if n not in field.components]
    if missing:
        raise call.error("operators.mesh.metric-incomplete", field, missing=missing)
    nodes = cells.connectivity
    M = np.zeros((len(nodes), 3, 3))
    for (i, j), name in names.items():
        values = field.values_at(name, nodes.ravel()).reshape(nodes.shape).mean(axis=1)
        M[:, i, j] = M[:, j, i] = values
    return M


def _block(call: Call, cells: CellBlock, words: list[str]) -> CellFieldBlock:
    made = {}
    for word in words:
        kinds, measure = _MEASURES[word]
        if cells.cell_type not in kinds:
            told = {"word": word, "kinds": kinds, "cell_type": cells.cell_type}
            raise call.error("operators.mesh.measure-of-other-cells", **told)
        made[word] = measure(cells.coordinates)[:, None]
    return CellFieldBlock(cells, made, "GRAVITE")


_CHECKS = (
    ("MESH", quality.repeated_cells, "operators.mesh.repeated-cells"),
    ("NODE", quality.unmatched_middles, "operators.mesh.unmatched-middles"),
    ("MESH", quality.unfit_faces, "operators.mesh.unfit-faces"),
)


@operator("VERM", family="mesh")
def verm(session: Session, mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> None:
    """Check a mesh."""
    _tell(session, mesh)


@verm.form(said("CORR"))
def corrected(session: Session, mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> Mesh:
    """Check a mesh, and take doubled cells out of it."""
    _tell(session, mesh)
    return without_duplicates(mesh)


def _tell(session: Session, mesh: Mesh) -> None:
    count = {"MESH": 0, "NODE": 0}
    for kind, check, code in _CHECKS:
        found = check(mesh)
        if found.n_cells:
            nodes = found.blocks[0].connectivity[:, 0].tolist()
            held = [found] if kind == "MESH" else [Point(mesh.nodes, n) for n in nodes]
            names = [f"{kind}{count[kind] + i + 1}" for i in range(len(held))]
            count[kind] += len(held)
            for name, value in zip(names, held, strict=True):
                session.frame.assign(name, value)
            name = " ... ".join(dict.fromkeys((names[0], names[-1])))
            session.print(" " + session.told(code, count=found.n_cells, name=name))
