"""ELEM: cells picked from a mesh, or by the values of a field in cells."""

from ssilang.io.plots.palette import COLOURS
from ssilang.kernel.mesh import combine
from ssilang.kernel.mesh.boundary import chained
from ssilang.kernel.mesh.changes.local_refinement import TIE, is_tie, parted
from ssilang.kernel.mesh.lines.lines import network_of_lines, shortest_line
from ssilang.kernel.mesh.queries.select import containing, resting_on, stretch
from ssilang.language.registry import find_operator
from ssilang.operators.dispatch import COMP
from ssilang.operators.mesh.points import picking
from ssilang.operators.mesh.selection.boundaries import not_empty
from ssilang.operators.prelude import *

_MESH = main("mesh", "MAILLAGE", en="cells to pick from")
_ALLOWED = flag("allowed", "NOVERIF", en="the result may be empty")
_FILTERS = key(
    "filters", (TIE, *CELL_TYPES, "POLY", *COLOURS), repeated=True, en="type or colour of the cells"
)
_NUMBERS = opt("which", "ENTIER", "LISTENTI", en="number, or numbers, among those", range=POSITIVE)


@operator("ELEM", family="mesh", full_name="ELEMENT")
def elem(
    call: Call,
    mesh: Mesh = _MESH,
    filters: Sequence[str] = _FILTERS,
    which: int | ListEnti | None = _NUMBERS,
) -> Mesh:
    """Pick cells by type, colour and number."""
    return _numbered(call, _filtered(mesh, filters), which)


@elem.form()
def of_numbered_colour(
    call: Call,
    colour: Chosen = Cases(
        {
            "COUL": [
                opt("number", "ENTIER", en="number of a colour", range=NOT_NEGATIVE),
            ]
        },
        optional=False,
        en="cells of a colour; without number the colours that there are",
    ),
    mesh: Mesh = _MESH,
    filters: Sequence[str] = _FILTERS,
    which: int | ListEnti | None = _NUMBERS,
) -> Mesh | ListMots:
    """Pick cells of a colour, or list the colours."""
    chosen = _filtered(mesh, filters)
    number = colour["number"]
    if number is not None:
        return _numbered(call, _of_colour(chosen, max(number - 1, 0)), which)
    shades = np.concatenate([b.colours for b in chosen.blocks])
    _, first = np.unique(shades, return_index=True)
    return ListMots([COLOURS[shades[k]] for k in np.sort(first)])


@elem.form(said("TYPE"))
def types(call: Call, mesh: Mesh = _MESH) -> ListMots:
    """List the types of the cells; of a mesh without any, that of OPTI ELEM."""
    if not mesh.n_cells:
        return ListMots([workspace(call.session).element])
    names = [TIE if is_tie(b.cell_type) else b.cell_type for b in mesh.blocks]
    return ListMots(list(dict.fromkeys(names)))


@COMP.form(of=("MAILLAGE",))
@elem.form(said("COMPRIS"), of=("MAILLAGE",))  # type: ignore[no-redef]  # the name of its page
def between(
    mesh: Mesh = _MESH,
    first: Point = Arg("POINT", en="where the part begins"),
    second: Point = Arg("POINT", en="where it ends"),
) -> Mesh:
    """The part of a line between two points; of a network, the shortest way."""
    try:
        return stretch(chained(mesh), first.node, second.node)
    except MeshError:
        if not network_of_lines(mesh):
            raise
    return shortest_line(mesh, first.node, second.node)


@elem.form()
def holding_point(
    holding: Chosen = Cases(
        {"CONTENANT": [arg("point", "POINT", en="point")]},
        optional=False,
        en="cell that holds a point",
    ),
    mesh: Mesh = _MESH,
    every: bool = Flag("TOUS", en="all cells that hold it"),
    allowed: bool = _ALLOWED,
) -> Mesh:
    """Pick the cells that hold a point."""
    made = containing(mesh, holding["point"].coordinates, every)
    return not_empty(made, allowed, "operators.mesh.point-outside")


@elem.form(gives="MAILLAGE")
def resting_on_points(
    call: Call,
    resting: Chosen = Cases(
        {
            "APPUYE": [
                choice(
                    "how",
                    ("STRICTEMENT", "LARGEMENT"),
                    default="STRICTEMENT",
                    en="by all nodes, the default, or by one at least",
                ),
                _ALLOWED,
                many("support", "MAILLAGE", "POINT", behind=True, en="points"),
            ]
        },
        optional=False,
        en="cells that rest on points",
    ),
    mesh: Mesh | None = Opt("MAILLAGE", en="cells to pick from"),
    more: Sequence[Mesh | Point] = Many("MAILLAGE", "POINT", en="further points"),
) -> Mesh:
    """Pick the cells that rest on points; the mesh stands first, or last behind the word."""
    support = [*resting["support"], *more]
    mesh = support.pop() if mesh is None and support else mesh  # type: ignore[assignment]
    if not isinstance(mesh, Mesh):
        raise call.missing(("MAILLAGE",))
    if not support:
        raise call.missing(("MAILLAGE", "POINT"))
    ids = np.concatenate([s.node_ids for s in support])
    made = resting_on(mesh, ids, resting["how"] != "LARGEMENT")
    return not_empty(made, resting["allowed"], "operators.mesh.no-cell-rests")


def _filtered(mesh: Mesh, filters: Sequence[str]) -> Mesh:
    for word in filters:
        if word == TIE:
            mesh = Mesh(mesh.nodes, parted(mesh)[1])
        elif word in CELL_TYPES:
            mesh = combine.of_type(mesh, word)
        elif word == "POLY":
            mesh = combine.polygons(mesh)
        else:
            mesh = _of_colour(mesh, COLOURS.index(word))
    return mesh


def _of_colour(mesh: Mesh, colour: int) -> Mesh:
    made = combine.take(mesh, lambda b: b.colours == colour)
    if not made.blocks:
        raise MeshError("operators.mesh.no-cell-of-colour", colour=COLOURS[colour])
    return made


def _numbered(call: Call, mesh: Mesh, which: int | ListEnti | None) -> Mesh:
    left = call.peek_word()
    if left is not None and find_operator(left) is None:
        raise call.error("operators.mesh.unknown-filter", left=left.rstrip())
    if which is None:
        return mesh
    numbers = which.values if isinstance(which, ListEnti) else np.array([which])
    if (numbers < 1).any() or (numbers > mesh.n_cells).any():
        wrong = numbers[(numbers < 1) | (numbers > mesh.n_cells)][0]
        raise call.error("operators.mesh.no-such-cell", which, wrong=wrong, n_cells=mesh.n_cells)
    blocks, start = [], 0
    for block in mesh.blocks:
        rows = numbers[(numbers > start) & (numbers <= start + len(block))] - 1 - start
        start += len(block)
        if len(rows):
            blocks.append(
                CellBlock.make(
                    mesh.nodes, block.cell_type, block.connectivity[rows], block.colours[rows]
                )
            )
    return Mesh(mesh.nodes, tuple(blocks))


def _rows(cells: CellBlock, keep: NDArray[np.bool_]) -> Mesh:
    return combine.take(Mesh(cells.nodes, (cells,)), lambda _: keep)


def _values(block: CellFieldBlock, named: picking.Named, absolute: bool) -> FloatArray:
    """All values (n_cells, m) of the chosen components of a block."""
    chosen = [
        np.asarray(block.components[n], dtype=float).reshape(len(block.cells), -1)
        for n in picking.chosen_components(block.components, named)
    ]
    if not chosen:
        raise MeshError("operators.mesh.none-of-the-components")
    table = np.hstack(chosen)
    return np.abs(table) if absolute else table


@elem.form(picking.EXTREMES, of=("MCHAML",))
def by_values(
    what: Chosen,
    field: CellField = Main("MCHAML", en="field in cells"),
    absolute: bool = picking.ABSOLUTE,
    how: str = Choice(
        ("LARG", "STRI"),
        default="LARG",
        en="one value of the cell fits, the default, or all do; a single cell where extreme",
    ),
    named: picking.Named = picking.NAMED,
) -> Mesh:
    """Pick cells whose values are extreme or compare."""
    values = [_values(b, named, absolute) for b in field.blocks]
    good = picking.picked(
        np.hstack([t.ravel() for t in values]), what.word, list(what.values.values())
    )
    every = how == "STRI"
    if every and what.word in ("MAXI", "MINI"):
        good, every = np.arange(len(good)) == good.argmax(), False
    blocks: list[CellBlock] = []
    for block, table in zip(field.blocks, values, strict=True):
        fits, good = good[: table.size].reshape(table.shape), good[table.size :]
        keep = np.asarray((np.all if every else np.any)(fits, axis=1))
        blocks += _rows(block.cells, keep).blocks
    parts = [Mesh(b.nodes, (b,)) for b in blocks]
    return combine.union(*parts, as_given=True) if parts else Mesh(field.blocks[0].cells.nodes, ())
