"""SORT of meshes, fields and matrices in others' formats; of named meshes in ssilang's own."""

from contextlib import closing

from ssilang.io.archive import Archive, Decoder, Encoder, Record, read_archive, write_archive
from ssilang.io.atomic import replacing, write_text
from ssilang.io.matrix_market import market_text, node_lines, system_of, unknown_lines
from ssilang.io.mesh_files.avs import avs_lines, structure_of
from ssilang.io.mesh_files.decks import abaqus_lines, nastran_lines
from ssilang.io.mesh_files.unv_stl import stl_lines
from ssilang.kernel.mesh.changes.local_refinement import parted
from ssilang.kernel.mesh.combine import poi1
from ssilang.operators.files.meshes import PLANE, lies_on, mesh_table
from ssilang.operators.files.outputs import input_path, option_name, run_output
from ssilang.operators.files.reading import LIRE
from ssilang.operators.files.saving import check_settings
from ssilang.operators.files.writing import SORT, target_path
from ssilang.operators.prelude import *


@SORT.form(said("AVS"))
def _avs(
    call: Call,
    mesh: Mesh | None = Opt("MAILLAGE", en="mesh"),
    nodal: NodeField | None = Opt("CHPOINT", en="nodal field"),
    cells: CellField | None = Opt("MCHAML", en="field in cells"),
    follows: bool = Flag("SUIT", en="behind what is written"),
    time: float | None = Key("TEMP", "FLOTTANT", range=ANY_NUMBER, en="time, in s"),
) -> None:
    support = _support(call, mesh, nodal, cells)
    lines = avs_lines(structure_of(support, nodal, cells, time))
    _write(call, lines, ".inp", follows=follows)


def _write(call: Call, lines: list[str], suffix: str, *also: str, follows: bool = False) -> None:
    """Put lines into the file of OPTI SORT, in place of what it holds or behind it."""
    output = run_output(call.session)
    if not follows:
        output.reopen("SORT")
    output.add_lines("SORT", target_path(call, suffix, also), lines)


def _support(
    call: Call, mesh: Mesh | None, nodal: NodeField | None, cells: CellField | None
) -> Mesh:
    if mesh is not None:
        return parted(mesh)[0]
    if cells is not None and cells.blocks:
        blocks: dict[int, CellBlock] = {id(b.cells): b.cells for b in cells.blocks}
        return Mesh(cells.blocks[0].cells.nodes, tuple(blocks.values()))
    if nodal is not None:
        return poi1(nodal.table, nodal.node_ids)
    raise call.missing(("MAILLAGE", "CHPOINT", "MCHAML"))


@SORT.form(said("STL"))
def _stl(call: Call, mesh: Mesh = Arg("MAILLAGE", en="surface of TRI3")) -> None:
    _write(call, stl_lines(mesh), ".stl")


_MESH = arg("mesh", "MAILLAGE", en="mesh")


@SORT.form(said("ABAQ"))
def _abaq(call: Call, mesh: Mesh = _MESH) -> None:
    ws = workspace(call.session)
    plane = PLANE.get(ws.mode, "CPE") if ws.dimension == 2 else ""
    _write(call, abaqus_lines(parted(mesh)[0], plane), ".inp")


@SORT.form(said("NAS"))
def _nas(call: Call, mesh: Mesh = _MESH) -> None:
    _write(call, nastran_lines(parted(mesh)[0]), ".bdf", ".nas")


@SORT.form(said("MAT"))
def _mat(
    call: Call,
    form: str | None = Choice(
        ("MM", "MATRIX_MARKET", "RB", "RUTHERFORD_BOEING"), en="format, only MM is made"
    ),
    storage: str | None = Choice(("ASSEMBLEE", "ELEMENTAIRE"), en="assembled, the only one made"),
    title: str = Key("TITR", "MOT", default="", en="title"),
    unknowns: bool = Flag("INCO", en="a file of the unknowns too"),
    places: bool = Flag("GEOM", en="a file of the nodes too"),
    matrix: Matrix = Arg("RIGIDITE", en="matrix"),
) -> None:
    if form not in ("MM", "MATRIX_MARKET") or storage != "ASSEMBLEE":
        raise call.error("operators.files.only-matrix-market")
    system = system_of(matrix)
    path = target_path(call, ".mm")
    output = run_output(call.session)
    with replacing(path) as stream:
        stream.write(market_text(system, str(title)))
    output.wrote(path)
    texts = {}
    if unknowns:
        texts[path.with_suffix(".inco")] = unknown_lines(system)
    if places:
        texts[path.with_suffix(".geom")] = node_lines(system, matrix.table.coordinates)
    for target, lines in texts.items():
        write_text(target, "".join(line + "\n" for line in lines))
        output.wrote(target)


@SORT.form()
def _sort_mesh(
    call: Call,
    mesh: Mesh = Main("MAILLAGE", en="mesh"),
    kept: bool = Flag("NOOP", en="changes nothing"),
) -> None:
    frame = call.session.frame
    encoder = Encoder()
    held = {n: v for n, v in frame.named().items() if v is mesh or lies_on(v, mesh)}
    names = {name: encoder.encode(value) for name, value in held.items()}
    if not any(frame.find(name) is mesh for name in names):
        names["MAILLAGE"] = encoder.encode(mesh)
    path = target_path(call)
    ws = workspace(call.session)
    write_archive(
        path, encoder.objects, encoder.arrays, [Record("", names)], {"DIME": ws.dimension}
    )
    run_output(call.session).wrote(path)


@LIRE.form(gives="TABLE|")
def _lire_file(
    call: Call, file: str = Lead("MOT", en="file, or mesh that must be there")
) -> Table | None:
    if "." in file:  # which no name has
        return mesh_table(call, str(file))
    _lire_own(call, file.strip().upper())
    return None


@LIRE.form()
def _lire_own(call: Call, wanted: str = Name(optional=True, en="mesh that must be there")) -> None:
    path = input_path(call, option_name(call.session, "LECT", 4))
    with closing(read_archive(path)) as archive:
        _restore(call, archive, wanted)


def _restore(call: Call, archive: Archive, wanted: str) -> None:
    names = archive.records[0].names if archive.records else {}
    if wanted and wanted not in names:
        known = ", ".join(names)
        raise InputError(
            "operators.files.no-such-mesh", name=archive.path.name, wanted=wanted, known=known
        )
    check_settings(archive, archive.path.name)
    ws = workspace(call.session)
    decoder = Decoder(archive, ws.nodes)
    for name, value in decoder.named(archive.records[:1]):
        call.session.frame.assign(name, value)
    ws.dimension = ws.dimension or int(archive.settings.get("DIME", 0))
