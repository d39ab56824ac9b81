"""LIRE 'MESH' and SORT 'MESH': meshes of other programs, with their named parts."""

from ssilang.io.mesh_files.file_mesh import NONE, FileMesh, Part
from ssilang.io.mesh_files.reading import ENDINGS, Asked, read_mesh_file
from ssilang.io.mesh_files.writing import WRITTEN, write_mesh_file
from ssilang.kernel.mesh.changes.local_refinement import parted
from ssilang.kernel.mesh.changes.merge import regenerate, repeated_nodes
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.orientation import orient
from ssilang.language.search import nearest
from ssilang.operators.files.outputs import input_path, option_name, run_output
from ssilang.operators.files.reading import LIRE, warn_flat, warn_repeated_cells, warn_without_cells
from ssilang.operators.files.writing import SORT, target_path
from ssilang.operators.prelude import *

PLANE = {Mode.PLANE_STRESS: "CPS", Mode.AXISYMMETRIC: "CAX", Mode.FOURIER: "CAX"}
"""What Abaqus calls plane solids, by the mode; CPE in all others."""

_FILE = lead("file", "MOT", en="file")


@LIRE.form(said("MESH"))
def _mesh(call: Call, file: str = _FILE) -> Table:
    return mesh_table(call, str(file))


_BY_WORD = {
    "GMSH": "GMSH", "MED": "MED", "VTU": "VTU", "VTK": "VTK", "ABAQUS": "ABAQUS",
    "NAS": "NASTRAN", "FEM": "NASTRAN", "MEDIT": "MEDIT", "UNV": "UNV",
}  # fmt: skip


@LIRE.form(said("GMSH", "MED", "VTU", "VTK", "ABAQUS", "NAS", "FEM", "MEDIT", "UNV"))
def _by_word(call: Call, word: str, file: str = _FILE) -> Table:
    return mesh_table(call, str(file), _BY_WORD[word])


@LIRE.form(lead("word", "MOT"), lead("file", "MOT"), gives="TABLE")
def _no_format(call: Call, word: str, file: str) -> NoReturn:
    raise call.error("operators.files.no-such-format", word, **_formats(str(word)))


def mesh_table(call: Call, name: str, kind: str = "") -> Table:
    """The mesh of a file as a table of its parts.

    Raises
    ------
    SsiError, InputError
        Where the file cannot be read, or its format is not known.
    """
    path = input_path(call, name)
    kind = kind or ENDINGS.get(path.suffix.lower(), "")
    if not kind:
        raise call.error(
            "operators.files.no-such-ending", name, ending=path.suffix, endings=list(ENDINGS),
            near=nearest(path.suffix, ENDINGS, 0.5),
        )  # fmt: skip
    asked = Asked(workspace(call.session).dimension or 3, lambda name: input_path(call, name))
    read = read_mesh_file(path, kind, asked)
    for remark in read.remarks:
        call.warn("operators.files.reader-says", name=path.name, remark=remark)
    warn_without_cells(call, path.name, len(read.points), any(map(len, read.cells.values())))
    if read.left_out:
        told = [f"{count} {cell}" for cell, count in sorted(read.left_out.items())]
        call.warn("operators.files.cells-left-out", name=path.name, told=told)
    if kind == "STL":
        warn_flat(call, path.name, read.points)
    return _table(call, read, path.name, kind)


def _formats(word: str) -> dict[str, Any]:
    known = ("MESH", "CSV", "PEER", "AVS", "PROC", "STL", *_BY_WORD)
    return {"word": word, "near": nearest(word, known, 0.5), "known": known}


def _table(call: Call, read: FileMesh, name: str, kind: str) -> Table:
    ws = workspace(call.session)
    dimension = ws.dimension
    outside = np.abs(read.points[:, dimension:]).max(axis=1, initial=0.0)
    beyond = dimension and (outside > 1e-9 * np.abs(read.points).max(initial=0.0)).any()
    if beyond and kind == "UNV":
        ws.dimension, ws.mode, dimension = 3, Mode.THREE_DIMENSIONAL, 3
    elif beyond:
        raise call.error(
            "operators.files.mesh-not-of-dimension", name=name, dimension=dimension,
            count=int((outside > 0).sum()),
        )  # fmt: skip
    ids = ws.nodes.add(read.points[:, : dimension or 3])
    whole = Mesh(
        ws.nodes, tuple(CellBlock.make(ws.nodes, k, ids[t]) for k, t in read.cells.items())
    )
    blocks = {b.cell_type: b for b in orient(whole, max(dimension, 1)).blocks}
    warn_repeated_cells(call, name, whole)
    collapsed = repeated_nodes(whole)
    simpler = _sound(whole)
    if collapsed:
        left = repeated_nodes(simpler)
        call.warn("operators.files.cells-collapsed", name=name, count=collapsed, left=left)
    made = Table()
    made.set(Mot("NOEUDS"), poi1(ws.nodes, ids))
    shown = [b for k, b in blocks.items() if k != "POI1"] or list(blocks.values())
    made.set(Mot("MAILLAGE"), _sound(Mesh(ws.nodes, tuple(shown))))
    for block in _sound(Mesh(ws.nodes, tuple(blocks.values()))).blocks:
        made.set(Mot("@" + block.cell_type), Mesh(ws.nodes, (block,)))
    taken = {str(index) for index, _ in made.items()}
    for title, part in read.parts.items():
        index = f"{title}_G" if title in taken else title
        cells = tuple(
            CellBlock.make(ws.nodes, k, blocks[k].connectivity[rows])
            for k, rows in part.cells.items()
        )
        if cells:
            made.set(Mot(index), _sound(Mesh(ws.nodes, cells)))
        if len(part.nodes):
            made.set(Mot(f"{index}_GN" if cells else index), poi1(ws.nodes, ids[part.nodes]))
    if kind == "NASTRAN":
        parts = {i: v for i, v in made.items() if str(i) in read.parts}
        made.set(Mot("MAILLAGES"), Table.of(parts))
    return made


def _sound(mesh: Mesh) -> Mesh:
    """The mesh, cells with nodes that coincide made simpler."""
    return regenerate(mesh) if repeated_nodes(mesh) else mesh


# ---- writing -------------------------------------------------------------------------------------


@SORT.form(said("MESH", "MED"))
def _sort(
    call: Call, word: str, mesh: Any = Arg("MAILLAGE", "TABLE", en="mesh, or a table of its parts")
) -> None:
    path = target_path(call, ".med" if word == "MED" else "")
    ending = path.suffix.lower()
    if ending not in WRITTEN:
        raise call.error(
            "operators.files.ending-not-written", name=option_name(call.session, "SORT", 7),
            endings=list(WRITTEN), word=_OTHER_WORDS.get(ending, ""),
        )  # fmt: skip
    ws = workspace(call.session)
    made = _file_mesh(call, mesh)
    if not made.cells:
        raise call.missing(("MAILLAGE",))
    plane = PLANE.get(ws.mode, "CPE") if ws.dimension == 2 else ""
    write_mesh_file(path, made, max(ws.dimension, 2), plane)
    run_output(call.session).wrote(path)


@SORT.form(main("mesh", "MAILLAGE"), flag("kept", "NOOP"), arg("word", "MOT"), gives=())
def _not_written(call: Call, mesh: Mesh, kept: bool, word: str) -> NoReturn:
    near = nearest(str(word), _WORDS, 0.5)
    raise call.error("operators.files.format-not-written", word, word=word, near=near, known=_WORDS)


_WORDS = ("MESH", "VTK", "AVS", "STL", "MED", "NAS", "ABAQ")
_OTHER_WORDS = {".bdf": "NAS", ".nas": "NAS", ".stl": "STL", ".vtu": "VTK", ".vtk": "VTK"}
"""Words of SORT for other endings."""


def _parts_of(call: Call, given: Any) -> tuple[list[Mesh], dict[str, Any]]:
    """The whole, where there is one, and the named parts."""
    if isinstance(given, Mesh):
        found = call.session.frame.named().items()
        return [given], {n: v for n, v in found if lies_on(v, given)}
    entries = {str(i).strip(): v for i, v in given.items() if isinstance(i, str)}
    whole = [v for n in ("MAILLAGE", "TOTAL") if isinstance(v := entries.get(n), Mesh)]
    skipped = ("MAILLAGE", "TOTAL", "NOEUDS")
    return whole[:1], {
        n: v for n, v in entries.items() if n not in skipped and not n.startswith("@")
        and isinstance(v, Mesh | Point)
    }  # fmt: skip


def lies_on(value: Any, mesh: Mesh) -> bool:
    """Whether a value is a point or a part of a mesh."""
    ids = value.sorted_node_ids if isinstance(value, Mesh | Point) else ()
    return len(ids) > 0 and bool(np.isin(ids, mesh.sorted_node_ids).all())


def _blocks(value: Any) -> Iterator[CellBlock]:
    yield from parted(value.mesh if isinstance(value, Point) else value)[0].blocks


def _file_mesh(call: Call, given: Any) -> FileMesh:
    """The mesh and its parts on the numbers of a file: each cell once, points where cells are."""
    whole, named = _parts_of(call, given)
    blocks: list[tuple[str, CellBlock]] = []
    joints = 0
    for name, value in [*(("", w) for w in whole), *named.items()]:
        for block in _blocks(value):
            if block.kind.joint:
                joints += len(block)
            else:
                blocks.append((name, block))
    if joints:
        call.warn("operators.files.joints-not-written", count=joints)
    nodes = workspace(call.session).nodes
    ids = np.unique(np.concatenate([NONE, *(b.connectivity.ravel() for _, b in blocks)]))
    tables: dict[str, list[tuple[str, IntArray]]] = {}
    parts: dict[str, tuple[dict[str, IntArray], IntArray]] = {name: ({}, NONE) for name in named}
    for name, block in blocks:
        table = np.searchsorted(ids, block.connectivity)
        if block.cell_type != "POI1":
            tables.setdefault(block.cell_type, []).append((name, table))
        elif name:
            parts[name] = parts[name][0], np.union1d(parts[name][1], table[:, 0])
    cells = {}
    for cell_type, found in tables.items():
        cells[cell_type], rows = _each_once([t for _, t in found])
        for (name, _), at in zip(found, rows, strict=True):
            if name:
                parts[name][0][cell_type] = np.union1d(parts[name][0].get(cell_type, NONE), at)
    points: FloatArray = nodes.coordinates[ids]
    held = {name: Part(c, n) for name, (c, n) in parts.items() if c or len(n)}
    return FileMesh(points, cells, held)


def _each_once(tables: list[IntArray]) -> tuple[IntArray, list[IntArray]]:
    """Cells of several tables, those of the same nodes once, and the rows of each table."""
    every = np.concatenate(tables)
    _, first, back = np.unique(
        np.sort(every, axis=1), axis=0, return_index=True, return_inverse=True
    )
    order = np.argsort(first)
    place = np.argsort(order)[back.ravel()]
    ends = np.cumsum([len(t) for t in tables])[:-1]
    return every[first[order]], np.split(place, ends)
