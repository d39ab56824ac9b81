"""Cells of meshes: CHAN MANU, colours by COUL AFCO, and RAFF to sizes wanted."""

from ssilang.io.plots.palette import COLOURS, index_of
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.matrices.relations import joined, rows_from_table
from ssilang.kernel.mesh.boundary import edges, faces
from ssilang.kernel.mesh.changes import degree
from ssilang.kernel.mesh.changes.local_refinement import divided_to_sizes, parted
from ssilang.kernel.mesh.changes.split import split_quadrangles, tetrahedra
from ssilang.kernel.mesh.combine import poi1, recolour, union
from ssilang.operators.dispatch import CHAN, COUL, MANU
from ssilang.operators.matrices.supports import as_matrix
from ssilang.operators.prelude import *

_SIMPLEX = {"TRI3": "QUA4", "TRI6": "QUA8"}


def changed(mesh: Mesh, target: str) -> Mesh:
    """The mesh made of cells of another type.

    Points from any mesh; lines as edges; quadrangles cut into triangles, volumes into
    tetrahedra; quadratic cells from linear ones and the reverse.

    Raises
    ------
    MeshError
        If there is no way from a cell of the mesh to the type.
    """
    if target == "POI1":
        return poi1(mesh.nodes, mesh.node_ids)
    parts = [_changed_block(b, target) for b in mesh.blocks]
    return union(*parts, as_given=True) if parts else mesh


def _changed_block(block: CellBlock, target: str) -> Mesh:
    alone = Mesh(block.nodes, (block,))
    kind = CELL_TYPES[target]
    if block.cell_type == target:
        return alone
    whole = block.cell_type in degree.COMPLETE.values() and kind.degree == 1
    if whole and kind.dimension >= block.kind.dimension:
        return degree.taken_apart(block, target)
    if target in degree.COMPLETE.values():
        return degree.complete(alone)
    if kind.degree == 2 and block.kind.degree == 1:
        return degree.quadratic(_changed_block(block, degree.LINEAR[target]))
    if (block.cell_type, target) == ("SEG3", "SEG2"):
        halves = block.connectivity[:, [0, 1, 1, 2]].reshape(-1, 2)
        return Mesh.of(block.nodes, "SEG2", halves, np.repeat(block.colours, 2))
    if kind.degree == 1 and block.kind.degree == 2 and not whole:
        return _changed_block(degree.linear(alone).single_block(), target)
    if kind.dimension == 1 and block.kind.dimension > 1:
        return edges(alone)
    if target in _SIMPLEX and block.cell_type == _SIMPLEX[target]:
        return split_quadrangles(alone)
    if target == "TET4" and block.kind.dimension == 3:
        return Mesh(block.nodes, (tetrahedra(block),))
    if target == "TE10" and block.kind.dimension == 3:
        return degree.quadratic(Mesh(block.nodes, (tetrahedra(block),)))
    if kind.dimension == 2 and block.kind.dimension == 3:
        return changed(faces(alone), target)
    if (target, block.cell_type) in (("QUA4", "TRI3"), ("QUA8", "TRI6")):
        return alone  # triangles among quadrangles stay as they are
    raise MeshError("operators.mesh.no-change-of-cells", cell_type=block.cell_type, target=target)


def _by_hand(mesh: Mesh, target: str, order: IntArray) -> Mesh:
    """Cells on the points of a mesh, by a list of their numbers in it."""
    ids = mesh.node_ids
    size = CELL_TYPES[target].n_nodes
    if len(order) % size or not len(order):
        raise MeshError("operators.mesh.no-whole-cells", n_order=len(order), size=size)
    if order.min() < 1 or order.max() > len(ids):
        raise MeshError("operators.mesh.numbers-beyond-points", n_ids=len(ids))
    return Mesh.of(mesh.nodes, target, ids[order - 1].reshape(-1, size))


_NUMBERS = opt(
    "numbers",
    "LISTENTI",
    en="numbers of the points of each cell, in a mesh of points",
    range=POSITIVE,
)


@CHAN.form(said(*CELL_TYPES))
def change_cells(
    word: str, mesh: Mesh = Arg("MAILLAGE", en="mesh"), numbers: ListEnti | None = _NUMBERS
) -> Mesh:
    """Mesh of another cell type."""
    return changed(mesh, word) if numbers is None else _by_hand(mesh, word, numbers.values)


@CHAN.form()
def change_to_current(
    session: Session, mesh: Mesh = Main("MAILLAGE", en="mesh"), numbers: ListEnti | None = _NUMBERS
) -> Mesh:
    """Mesh of the cell type of OPTI ELEM."""
    target = workspace(session).element
    if not target:
        raise MeshError("operators.mesh.no-target-type")
    return changed(mesh, target) if numbers is None else _by_hand(mesh, target, numbers.values)


_WHOLE = {
    "LIGNE": edges,
    "SURFACE": faces,
    "LINEAIRE": degree.linear,
    "QUADRATIQUE": degree.quadratic,
    "QUAF": degree.complete,
}


@CHAN.form(said(*_WHOLE))
def change_whole(word: str, mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> Mesh:
    """Edges, faces, linear or quadratic cells."""
    return _WHOLE[word](mesh)


@MANU.form(said(*CELL_TYPES))
def by_hand(
    session: Session,
    word: str,
    given: Sequence[Point | Mesh] = Many(
        "POINT", "MAILLAGE", at_least=1, en="points, cell after cell"
    ),
    colour: str | None = Choice(COLOURS, en="colour, that of OPTI COUL by default"),
) -> Mesh:
    """Cells given node by node."""
    ws = workspace(session)
    ids = np.concatenate([[g.node] if isinstance(g, Point) else g.node_ids for g in given])
    size = CELL_TYPES[word].n_nodes
    if len(ids) % size:
        raise MeshError("operators.mesh.points-of-cells", word=word, size=size, n_ids=len(ids))
    shade = ws.colour if colour is None else COLOURS.index(colour)
    return Mesh.of(ws.nodes, word, ids.astype(np.int64).reshape(-1, size), shade)


def refined(mesh: Mesh, sizes: NodeField) -> Mesh:
    """The mesh divided to the sizes of a field of one component.

    Raises
    ------
    MeshError
        If the field has several components, lacks at a node, or for cells that are not divided.
    """
    if len(sizes.components) != 1:
        raise MeshError("operators.mesh.one-size-wanted", n_components=len(sizes.components))
    cells, ties = parted(mesh)
    wanted = sizes.values_at(next(iter(sizes.components)), cells.node_ids, np.nan)
    if np.isnan(wanted).any():
        node = mesh.nodes.told(cells.node_ids[np.isnan(wanted)][0])
        raise MeshError("operators.mesh.no-size-at-node", node=node)
    return divided_to_sizes(cells, wanted, ties)


def tie_relations(model: Model, table: NodeTable) -> Matrix:
    """Each hanging node moves as the mean of the nodes that it follows, unknown by unknown."""
    names = dict.fromkeys(u for z in model.zones for u in family_of(z).layout(z).unknowns)
    parts = []
    for block in model.ties:
        nodes = block.connectivity
        masters = nodes.shape[1] - 1
        row = np.concatenate([[1.0], np.full(masters, -1.0 / masters)])
        coefficients = np.broadcast_to(row, nodes.shape)
        parts += [
            rows_from_table(table, nodes, (name,) * nodes.shape[1], coefficients) for name in names
        ]
    return as_matrix(joined(parts)) if parts else Matrix(table)


# other cells are white
_COLOURS = {
    "BLEU": "SEG2 TRI3 CUB8 TET4 LIA3", "ROUG": "QUA4 PRI6 PYR5 RAC2 LIA4",
    "ROSE": "SEG3 TRI6 CU20 TE10 LIA6", "VERT": "QUA8 PR15 PY13 RAC3 LIA8", "JAUN": "TRI7 QUA9",
}  # fmt: skip
_COLOUR_OF = {cell: colour for colour, cells in _COLOURS.items() for cell in cells.split()}


@operator("AFCO", family="mesh")
def afco(mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> Mesh:
    """Colour each block by its type of cell."""
    shades = [index_of(_COLOUR_OF.get(b.cell_type, "BLAN")) for b in mesh.blocks]
    blocks = tuple(
        replace(b, colours=np.full(len(b), shade, dtype=np.int8))
        for b, shade in zip(mesh.blocks, shades, strict=True)
    )
    return replace(mesh, blocks=blocks)


@COUL.form(
    main("mesh", "MAILLAGE", en="mesh"),
    either(
        "colour",
        group("number", arg("number", "ENTIER", en="its number", usual=Range(high=len(COLOURS)))),
        group("name", arg("name", "MOT", en="its name", kind="colour")),
        optional=True,
        en="colour, that of OPTI COUL by default",
    ),
)
def coloured(session: Session, mesh: Mesh, colour: Chosen | None) -> Mesh:
    """Mesh in another colour."""
    if colour is None:
        return recolour(mesh, workspace(session).colour)
    if colour.word == "number":
        return recolour(mesh, min(max(colour["number"] - 1, 0), len(COLOURS) - 1))
    return recolour(mesh, index_of(colour["name"]))
