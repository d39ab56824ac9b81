"""POIN: points picked from meshes and fields, or made from coordinates."""

from itertools import permutations

from ssilang.kernel.elements.zone_fields import carry
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.lines.lines import line_ends
from ssilang.kernel.mesh.queries.select import junctions, nearest_node
from ssilang.operators.mesh.copies.maps import SHAPES, shape_of
from ssilang.operators.mesh.tolerance import DISTANCE, tolerance_of
from ssilang.operators.prelude import *

_COMPARISONS: dict[str, Callable[[FloatArray, float], NDArray[np.bool_]]] = {
    "SUPERIEUR": np.greater,
    "EGSUPE": np.greater_equal,
    "EGALE": lambda v, x: np.isclose(v, x, rtol=1e-12, atol=0.0),
    "EGINFE": np.less_equal,
    "INFERIEUR": np.less,
    "DIFFERENT": lambda v, x: ~np.isclose(v, x, rtol=1e-12, atol=0.0),
}
_FLAT = 1e-9  # of a mesh's size: across, it has none
_BESIDE = 0.5  # of a cell: farther out, a corner is asked for, or no point of the mesh
_LIMIT = arg("limit", "FLOTTANT", en="value", range=ANY_NUMBER)
EXTREMES = select(
    "what",
    {
        "MAXI": (),
        "MINI": (),
        **dict.fromkeys(_COMPARISONS, (_LIMIT,)),
        "COMPRIS": (
            arg("low", "FLOTTANT", en="one limit", range=ANY_NUMBER),
            arg("high", "FLOTTANT", en="other limit", range=ANY_NUMBER),
        ),
    },
    optional=False,
    en="largest or smallest values, or how they compare",
)
ABSOLUTE = flag("absolute", "ABS", en="of absolute values")
NAMED = key(
    "named",
    ("AVEC", "SANS"),
    "LISTMOTS",
    kind="component",
    repeated=True,
    en="only these components, or all but these",
)
Named = Sequence[tuple[str, ListMots]]


def chosen_components(names: Iterable[str], named: Named) -> list[str]:
    """The names that `NAMED` leaves."""
    left = list(names)
    for word, listed in named:
        said = {str(n).rstrip() for n in listed.values}
        left = [n for n in left if (n in said) == (word == "AVEC")]
    return left


_MESH = main("mesh", "MAILLAGE", en="mesh to pick from")


@operator("POIN", family="mesh", full_name="POINT")
def poin(
    session: Session,
    call: Call,
    mesh: Mesh = _MESH,
    number: int = Arg("ENTIER", en="number of a point, or in the cell", range=POSITIVE),
    cell: int | None = Opt("ENTIER", en="number of the cell", range=POSITIVE),
) -> Point:
    """Pick a point by number."""
    nodes = workspace(session).nodes
    if cell is None:
        return Point(nodes, _numbered(call, mesh, number))
    place = cell
    for block in mesh.blocks:
        if 1 <= place <= len(block) and 1 <= number <= block.kind.n_nodes:
            return Point(nodes, int(block.connectivity[place - 1, number - 1]))
        place -= len(block)
    raise call.error("operators.mesh.no-such-node-of-cell", number, number=number, cell=cell)


def _numbered(call: Call, mesh: Mesh, number: int) -> int:
    """Node by number in a mesh of points or SEG2."""
    if any(b.kind.dimension > 1 for b in mesh.blocks):
        ids = mesh.node_ids
    else:
        if not mesh.n_cells:
            raise MeshError("operators.mesh.no-points")
        starts = [b.connectivity[:, 0] for b in mesh.blocks]
        ends = [b.connectivity[-1:, -1] for b in mesh.blocks if b.kind.dimension == 1]
        ids = np.concatenate([*starts, *ends])
    if not 1 <= number <= len(ids):
        raise call.error("operators.mesh.no-such-point", number, number=number, n_ids=len(ids))
    return int(ids[number - 1])


@poin.form(said("INITIAL", "FINAL"))
def end_of_line(session: Session, word: str, mesh: Mesh = _MESH) -> Point:
    """The first or the last point of a line."""
    return Point(workspace(session).nodes, line_ends(mesh)[0 if word == "INITIAL" else 1])


@poin.form(said("JONC"))
def junctions_of(session: Session, mesh: Mesh = _MESH) -> Mesh:
    """Points that join more than two cells."""
    ids = junctions(mesh)
    if len(ids) == 0:
        raise MeshError("operators.mesh.no-junction")
    return poi1(workspace(session).nodes, ids)


@poin.form(
    select(
        "near",
        {"PROC": [arg("point", "POINT", en="point")]},
        optional=False,
        en="the nearest to a point",
    )
)
def nearest(session: Session, call: Call, near: Chosen, mesh: Mesh = _MESH) -> Point:
    """The point of a mesh that is nearest to another one."""
    given, nodes = near["point"], workspace(session).nodes
    found = nearest_node(mesh, given.coordinates)
    if given.node == len(nodes) - 1:  # a place, and no point of another mesh
        points = nodes.coordinates[mesh.node_ids]
        low, high = points.min(axis=0), points.max(axis=0)
        flat = high - low < _FLAT * (high - low).max()
        ways = [*permutations(given.coordinates[~flat])]
        others = np.tile(given.coordinates, (len(ways), 1))
        others[:, ~flat] = ways
        beside = np.where(flat, 0.0, np.maximum(low - others, others - high)).max(axis=1)
        size = _size_at(mesh, found)
        if beside[0] > _BESIDE * size > 0.0 and beside.min() <= _BESIDE * size:
            within = others[beside.argmin(), : workspace(session).dimension]
            told = {"found": nodes.told(found), "off": float(beside[0]), "size": size}
            other = "(" + " ".join(f"{x:g}" for x in within) + ")"
            call.warn("operators.mesh.place-beside-mesh", other=other, **told)
    return Point(nodes, found)


def _size_at(mesh: Mesh, node: int) -> float:
    """The shortest way from a node to others of its cells, nought without."""
    blocks = [b.connectivity[(b.connectivity == node).any(axis=1)] for b in mesh.blocks]
    others = np.concatenate([b.ravel() for b in blocks])
    ways = np.linalg.norm(mesh.nodes.coordinates[others] - mesh.nodes.coordinates[node], axis=1)
    return float(ways[ways > 0.0].min(initial=np.inf)) if (ways > 0.0).any() else 0.0


@poin.form(
    select(
        "shape",
        {w: points for w, points in SHAPES.items() if w not in ("CERC", "CONI", "TORI")},
        optional=False,
        en="points on a line or a surface",
    )
)
def on_shape(
    session: Session, shape: Chosen, mesh: Mesh = _MESH, distance: float | None = DISTANCE
) -> Mesh:
    """The points of a mesh on a line or a surface."""
    ws = workspace(session)
    ids = mesh.node_ids
    at = ws.nodes.coordinates[ids]
    near = np.abs(shape_of(shape).distance(at)) <= tolerance_of(ws, distance, at)
    if not near.any():
        raise MeshError("operators.mesh.no-point-there", word=shape.word)
    return poi1(ws.nodes, ids[near])


@poin.form(main("field", "CHPOINT", en="field at nodes"), EXTREMES, ABSOLUTE, NAMED)
def of_field(
    session: Session, field: NodeField, what: Chosen, absolute: bool, named: Named
) -> Mesh:
    """Nodes where values are extreme or compare."""
    parts = [field.components[n] for n in chosen_components(field.components, named)]
    if not parts:
        return _doubted_if_empty(session, Mesh(field.table, ()))
    nodes = np.concatenate([p.nodes for p in parts])
    values = np.concatenate([p.values for p in parts])
    found = nodes[_fitting(values, what, absolute)]
    return _doubted_if_empty(session, poi1(field.table, _once(found)))


@poin.form()
def of_cell_field(
    session: Session,
    field: CellField = Main("MCHAML", en="field in cells"),
    what: Chosen = EXTREMES,
    absolute: bool = ABSOLUTE,
    named: Named = NAMED,
) -> Mesh:
    """Nodes, or new points at integration points, where values are extreme or compare."""
    names = dict.fromkeys(n for b in field.blocks for n in b.components)
    wanted = chosen_components(names, named)
    nodes = field.blocks[0].cells.nodes
    values, places, ids = [], [], []
    for block in field.blocks:
        x, numbers = _support_points(block)
        for name in wanted:
            if name in block.components:
                part = np.asarray(block.components[name], dtype=float)
                values.append(np.broadcast_to(part, numbers.shape).ravel())
                places.append(x.reshape(-1, 3))
                ids.append(numbers.ravel())
    if not values:
        return _doubted_if_empty(session, Mesh(nodes, ()))
    chosen = _fitting(np.concatenate(values), what, absolute)
    numbers = np.concatenate(ids)[chosen]
    fresh = numbers < 0
    if fresh.any():
        at = np.concatenate(places)[chosen][fresh]  # in the order of the cells
        first = np.sort(np.unique(at, axis=0, return_index=True)[1])
        return poi1(nodes, nodes.add(at[first], workspace(session).density))
    return _doubted_if_empty(session, poi1(nodes, _once(numbers)))


@poin.form()
def made(
    session: Session,
    coordinates: Sequence[float] = Many(
        "FLOTTANT", at_least=1, en="coordinates", unit="m", range=ANY_NUMBER
    ),
    density: float | None = Key(
        "DENS",
        "FLOTTANT",
        unit="m",
        range=POSITIVE,
        en="mesh size there, that of OPTI DENS by default",
    ),
) -> Point:
    """Make a point."""
    ws = workspace(session)
    size = ws.density if density is None else density
    return Point(ws.nodes, int(ws.nodes.add(np.array([coordinates]), size)[0]))


@poin.form()
def made_of_lists(
    session: Session,
    call: Call,
    lists: Sequence[ListReel] = Many(
        "LISTREEL", at_least=1, en="first coordinates, second ones ...", unit="m", range=ANY_NUMBER
    ),
    density: float | ListReel | None = Key(
        "DENS",
        "FLOTTANT",
        "LISTREEL",
        unit="m",
        range=POSITIVE,
        en="mesh size there, that of OPTI DENS by default",
    ),
) -> Mesh:
    """Make a mesh of points."""
    ws = workspace(session)
    if len({len(v) for v in lists}) > 1:
        raise call.error("operators.mesh.coordinate-lists-differ", lists[-1])
    size = ws.density if density is None else density
    table = np.column_stack([v.values for v in lists])
    ids = ws.nodes.add(table, size.values if isinstance(size, ListReel) else size)
    return poi1(ws.nodes, ids, ws.colour)


def _doubted_if_empty(session: Session, found: Mesh) -> Mesh:
    """The points found; none raise the flag that SOUC reads."""
    if not found.n_cells:
        session.doubt()
    return found


def _fitting(values: FloatArray, what: Chosen, absolute: bool) -> NDArray[np.bool_]:
    """Which values (n,) are sought."""
    return picked(np.abs(values) if absolute else values, what.word, list(what.values.values()))


def _support_points(block: CellFieldBlock) -> tuple[FloatArray, IntArray]:
    """Positions (n_cells, p, 3) that carry a field, and their node numbers, -1 off nodes."""
    x, table = block.cells.coordinates, block.cells.connectivity
    if block.support == "NOEUD":
        return x, table
    columns = [carry(x[..., k], block.element, "NOEUD", block.support) for k in range(3)]
    at = np.stack(columns, axis=-1)
    return at, np.full(at.shape[:2], -1, dtype=np.int64)


def picked(values: FloatArray, word: str, limits: Sequence[float]) -> NDArray[np.bool_]:
    """Which values (n,) are extreme, or compare with the limits as the word says."""
    if not len(values):
        return np.zeros(0, dtype=bool)
    if word in ("MAXI", "MINI"):
        extreme = values.max() if word == "MAXI" else values.min()
        hair = 1e-12 * float(np.abs(values).max())
        return np.asarray(np.abs(values - extreme) <= hair)
    if word == "COMPRIS":
        low, high = sorted(limits)
        return np.asarray((values >= low) & (values <= high))
    return np.asarray(_COMPARISONS[word](values, limits[0]))


def _once(ids: IntArray) -> IntArray:
    first = np.sort(np.unique(ids, return_index=True)[1])
    return ids[first]
