"""Shape of cells (INDI) and what is wrong with a mesh (VERM)."""

from ssilang.kernel.mesh.combine import without_duplicates
from ssilang.kernel.mesh.queries import quality
from ssilang.operators.mesh.metrics import METRIC, metric_at
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


@indi.form(said("TOPO"), METRIC)
def topological(
    call: Call,
    mesh: Mesh = Arg("MAILLAGE", en="triangles or tetrahedra"),
    listed: bool = Flag("LISTREEL", en="a list is given"),
    **read: Any,
) -> CellField | ListReel:
    """Quality of cells, in a metric."""
    kinds = {b.cell_type for b in mesh.blocks}
    if len(mesh.blocks) != 1 or not kinds <= {"TRI3", "TET4"}:
        raise call.error("operators.mesh.simplices-wanted", mesh)
    cells = mesh.blocks[0]
    wanted, x = None, cells.coordinates
    if read["metric"] is not None:
        wanted = metric_at(call, cells.connectivity, read["metric"]).mean(axis=1)
        x = x[..., : wanted.shape[-1]]
    values = quality.quality_in_metric(x, wanted)
    if listed:
        return ListReel(values)
    block = CellFieldBlock(cells, {"SCAL": values[:, None]}, "GRAVITE")
    return CellField((block,), "SCALAIRE")


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
