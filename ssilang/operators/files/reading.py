"""LIRE: tables of numbers, procedures and meshes from files."""

from ssilang.io.mesh_files.avs import Structure, read_avs
from ssilang.io.mesh_files.unv_stl import read_stl
from ssilang.io.tables import as_columns, read_csv
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.queries.quality import repeated_cells
from ssilang.language.text.source_files import read_source
from ssilang.language.text.structure import parse
from ssilang.language.text.tree import Definition
from ssilang.operators.files.outputs import file_to_read, input_path, option_name, run_output
from ssilang.operators.prelude import *

LIRE = shared("LIRE", "files")


_FILE = lead("file", "MOT", en="file")


@LIRE.form(said("CSV"))
def _csv(
    call: Call,
    file: str = _FILE,
    first: int = Key("DEBU", "ENTIER", range=POSITIVE, default=1, en="first line"),
    separator: str = Key("SEPA", "MOT", default=";", en="separator"),
    by: str = Choice(("COLO", "LIGN"), default="COLO", en="columns or lines"),
) -> Table:
    sign = str(separator) or ";"
    if len(sign) > 1:
        sign = sign.strip()[:1] or " "
    rows = read_csv(file_to_read(call, str(file), ".csv"), sign, first)
    return Table.numbered(ListReel(v) for v in (rows if by == "LIGN" else as_columns(rows)))


@LIRE.form(said("PROC"))
def _proc(
    call: Call, file: str = _FILE, name: str = Opt("MOT", default="", en="the only one wanted")
) -> None:
    path = input_path(call, file)
    wanted = str(name).strip().upper()
    script = parse(read_source(path))
    frame = call.session.frame
    found = {n.name: n for n in script.body if isinstance(n, Definition)}
    if not found and wanted:
        body = Definition(wanted, (), script.body, (), False, script.span)
        frame.assign(wanted, Procedure(wanted, body, str(path)))
        return
    if wanted and wanted not in found:
        raise call.error(
            "operators.files.no-such-procedure", file, name=path.name, wanted=wanted, found=found
        )
    for one, node in found.items():
        if not wanted or one == wanted:
            frame.assign(one, Procedure(one, node, str(path)))


@LIRE.form(said("AVS"))
def _avs(call: Call) -> Table:
    name = option_name(call.session, "LECT", 4)
    output = run_output(call.session)
    path = output.source(name + ".inp")
    if path is None or not path.is_file():
        path = input_path(call, name)
    done = output.opened.get("LECT", 0)
    structure = read_avs(path, done)
    if structure is None:
        raise call.error("operators.files.all-structures-read", name=path.name, done=done)
    output.opened["LECT"] = done + 1
    warn_without_cells(call, path.name, len(structure.points), bool(structure.cells))
    return _avs_table(call, structure)


def warn_without_cells(call: Call, name: str, count: int, cells: bool) -> None:
    """Warn of a file that has nodes alone: cut off inside them, most often."""
    if not cells:
        call.warn("operators.files.mesh-without-cells", name=name, count=count)


def warn_repeated_cells(call: Call, name: str, mesh: Mesh) -> None:
    """Warn of cells that a file has twice: they count double."""
    cells = Mesh(mesh.nodes, tuple(b for b in mesh.blocks if b.cell_type != "POI1"))
    if count := repeated_cells(cells).n_cells:
        call.warn("operators.files.cells-repeated", name=name, count=count)


def warn_flat(call: Call, name: str, points: FloatArray) -> None:
    """Warn of a surface in space, meant as the skin of a body, that lies in a plane."""
    sizes = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    if workspace(call.session).dimension == 3 and sizes[-1] <= 1e-6 * sizes[0]:
        call.warn("operators.files.surface-flat", name=name)


def _avs_table(call: Call, structure: Structure) -> Table:
    nodes = workspace(call.session).nodes
    ids = nodes.add(structure.points)
    blocks = [CellBlock.make(nodes, kind, ids[t]) for kind, _, t in structure.cells]
    whole = Mesh(nodes, tuple(blocks))
    warn_repeated_cells(call, option_name(call.session, "LECT", 4), whole)
    parts = Table.numbered(Mesh(nodes, (block,)) for block in blocks)
    found: dict[str, Any] = {"MAILSUPP": poi1(nodes, ids), "LEMAILLA": whole, "SOUMAILA": parts}
    if structure.node_values:
        found["LECHPOIN"] = NodeField.of(nodes, ids, structure.node_values)
    if structure.cell_values:
        found["LEMCHAML"] = CellField(_cell_parts(structure, blocks), "SCALAIRE")
    return Table.of(found | dict(structure.model_values))


def _cell_parts(structure: Structure, blocks: list[CellBlock]) -> tuple[CellFieldBlock, ...]:
    ends = np.cumsum([len(b) for b in blocks])
    made = []
    for block, end in zip(blocks, ends, strict=True):
        rows = slice(end - len(block), end)
        values = {n: v[rows, None] for n, v in structure.cell_values.items()}
        made.append(CellFieldBlock(block, values, "GRAVITE"))
    return tuple(made)


@LIRE.form(said("STL"))
def _stl(call: Call, file: str = _FILE) -> Mesh:
    corners = read_stl(file_to_read(call, str(file), ".stl"))
    warn_flat(call, str(file), corners.reshape(-1, 3))
    nodes = workspace(call.session).nodes
    return Mesh.of(nodes, "TRI3", nodes.add(corners.reshape(-1, 3)).reshape(-1, 3))
