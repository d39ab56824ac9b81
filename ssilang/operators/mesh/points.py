"""Points picked from meshes and fields, or made from coordinates: POIN, NOEU, CONF, BARY."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.zone_fields import carry
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.lines.lines import line_ends
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.queries.select import junctions, nearest_node
from ssilang.language.registry import Help, arg, flag, operator
from ssilang.language.run.call import Call
from ssilang.language.run.session import Session
from ssilang.language.values import ListReel
from ssilang.operators.mesh.maps import SHAPES, read_shape
from ssilang.operators.workspace import Workspace, workspace

_COMPARISONS: dict[str, Callable[[FloatArray, float], NDArray[np.bool_]]] = {
    "SUPERIEUR": np.greater,
    "EGSUPE": np.greater_equal,
    "EGALE": lambda v, x: np.isclose(v, x, rtol=1e-12, atol=0.0),
    "EGINFE": np.less_equal,
    "INFERIEUR": np.less,
    "DIFFERENT": lambda v, x: ~np.isclose(v, x, rtol=1e-12, atol=0.0),
}
_SELECTORS = ("MAXI", "MINI", *_COMPARISONS, "COMPRIS")


def tolerance_of(ws: Workspace, given: float | None, positions: FloatArray) -> float:
    """The given distance, else a tenth of the density, else a hair of the extent."""
    if given is not None:
        return abs(given)
    if ws.density > 0.0:
        return 0.1 * ws.density
    return 1e-9 * float(np.ptp(positions, axis=0).max(initial=0.0))


@operator(
    "POIN",
    family="mesh",
    full_name="POINT",
    help=Help(
        en="Picks points. From a mesh: by number (of points, or of cells of SEG2), by number in a "
        "cell, 'INIT' and 'FINA' of a line, 'JONC' (junctions), 'PROC' (nearest to a point), all "
        "on a line, plane, cylinder, cone, sphere or torus within a distance (a tenth of the "
        "density by default). From a field: where values are largest, smallest or compare with "
        "given ones (none: an empty mesh, and SOUC is raised). "
        "From numbers or lists of coordinates: makes a point or a mesh of points.",
        fr="Désigne des points. D'un maillage : par numéro (de point, ou d'élément SEG2), par "
        "numéro dans un élément, 'INIT' et 'FINA' d'une ligne, 'JONC' (jonctions), 'PROC' (le plus "
        "proche d'un point), tous ceux d'une droite, d'un plan, cylindre, cône, sphère ou tore à "
        "une distance près (le dixième de la densité par défaut). D'un champ : là où les valeurs "
        "sont extrêmes ou vérifient une comparaison (aucune : un maillage vide, et SOUC est levé). "
        "De nombres ou listes : crée point ou points.",
        syntax="POIN1 = GEO1 POIN N1 | I1 I2 | 'INIT' | 'FINA' | 'JONC' | 'PROC' P1 | "
        "'DROIT' P1 P2 (D1) | 'PLAN' P1 P2 P3 (D1) | 'CYLI' | 'CONE' | 'SPHE' | 'TORE' ... ;\n"
        "GEO1 = CHPO1 POIN 'MAXI'|'MINI'|'SUPE' X1|'COMP' X1 X2 ('ABS') ('AVEC'|'SANS' LMOTS1) ;\n"
        "POIN1 = POIN X1 (Y1 (Z1)) ('DENS' D1) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; P = L POIN 'PROC' (0.3 1.) ;"
            " LIST (COOR 1 P) ;",
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (1. 0.)) TRAN 2 (0. 1.) ;"
            " Q = S POIN 'DROI' (0. 0.) (0. 1.) 1E-3 ; LIST (NBNO Q) ;",
        ),
    ),
    reads_itself=True,
)
def poin(call: Call) -> Any:
    """Pick or make points."""
    support = call.optional("MAILLAGE", "CHPOINT", "MCHAML")
    if isinstance(support, NodeField):
        return _doubted_if_empty(call, _of_field(call, support))
    if isinstance(support, CellField):
        return _doubted_if_empty(call, _of_cell_field(call, support))
    ws = workspace(call.session)
    if support is None and call.peek_word() in (None, "DENS"):
        made = _from_coordinates(call, ws)
        if made is not None:
            return made
    return _of_mesh(call, ws, support)


def _from_coordinates(call: Call, ws: Workspace) -> Any:
    if any(isinstance(o.value, Mesh) for o in call.operands):
        return None
    lists: list[ListReel] = call.all("LISTREEL")
    size = None
    numbers = [] if lists else call.all("FLOTTANT")
    if call.keyword(("DENS",)) is not None:
        size = call.required("FLOTTANT", "LISTREEL", after=call.keyword_end)
    size = ws.density if size is None else size
    if lists:
        if len({len(v) for v in lists}) > 1:
            raise call.bad("the lists of coordinates have different lengths", lists[-1])
        table = np.column_stack([v.values for v in lists])
        ids = ws.nodes.add(table, size.values if isinstance(size, ListReel) else size)
        return poi1(ws.nodes, ids, ws.colour)
    if not numbers:
        return None
    return Point(ws.nodes, int(ws.nodes.add(np.array([numbers]), size)[0]))


def _of_mesh(call: Call, ws: Workspace, mesh: Mesh | None) -> Any:
    shape = read_shape(call, tuple(w for w in SHAPES if w not in ("CERC", "CONI", "TORI")))
    if shape is not None:
        mesh = mesh or call.required("MAILLAGE")
        given = call.optional("FLOTTANT")
        ids = mesh.node_ids
        at = ws.nodes.coordinates[ids]
        near = np.abs(shape[1].distance(at)) <= tolerance_of(ws, given, at)
        if not near.any():
            raise MeshError(
                f"no point of the mesh lies there ({shape[0]})", "give a larger distance"
            )
        return poi1(ws.nodes, ids[near])
    word = call.keyword(("INITIAL", "FINAL", "JONC", "PROC"))
    if word == "PROC":
        target = call.required("POINT", after=call.keyword_end)
        mesh = mesh or call.required("MAILLAGE")
        return Point(ws.nodes, nearest_node(mesh, target.coordinates))
    numbers = [] if word else call.all("ENTIER")
    mesh = mesh or call.required("MAILLAGE")
    if word == "JONC":
        ids = junctions(mesh)
        if len(ids) == 0:
            raise MeshError("no point of the mesh joins more than two elements")
        return poi1(ws.nodes, ids)
    if word is not None:
        return Point(ws.nodes, line_ends(mesh)[0 if word == "INITIAL" else 1])
    numbers = numbers or call.all("ENTIER")
    if not numbers:
        raise call.missing(("ENTIER", "MOT"))
    return Point(ws.nodes, _numbered(call, mesh, numbers))


def _numbered(call: Call, mesh: Mesh, numbers: Sequence[int]) -> int:
    """Node by number in a mesh of points or SEG2, or by numbers in a cell and of the cell."""
    if len(numbers) > 1:
        local, cell = numbers[0], numbers[1]
        for block in mesh.blocks:
            if 1 <= cell <= len(block) and 1 <= local <= block.kind.n_nodes:
                return int(block.connectivity[cell - 1, local - 1])
            cell -= len(block)
        raise call.bad(f"the mesh has no node {local} of element {numbers[1]}", numbers[0])
    number = numbers[0]
    if any(b.kind.dimension > 1 for b in mesh.blocks):
        ids = mesh.node_ids
    else:
        if not mesh.n_cells:
            raise MeshError("the mesh is empty: it has no points")
        starts = [b.connectivity[:, 0] for b in mesh.blocks]
        ends = [b.connectivity[-1:, -1] for b in mesh.blocks if b.kind.dimension == 1]
        ids = np.concatenate([*starts, *ends])
    if not 1 <= number <= len(ids):
        raise call.bad(f"point {number} is asked of {len(ids)}", number)
    return int(ids[number - 1])


@dataclass
class _Search:
    """What is sought in a field: a word, its limits, absolute values, components."""

    word: str
    limits: list[float]
    absolute: bool
    wanted: list[str]

    def picks(self, values: FloatArray) -> NDArray[np.bool_]:
        """Which values (n,) fit."""
        return picked(np.abs(values) if self.absolute else values, self.word, self.limits)


def _read_search(call: Call, components: Sequence[str]) -> _Search:
    word = call.keyword(_SELECTORS)
    if word is None:
        raise call.bad("what is sought in the field is not said", hint=" ".join(_SELECTORS))
    limits = []
    for _ in range({"MAXI": 0, "MINI": 0, "COMPRIS": 2}.get(word, 1)):
        limits.append(call.required("FLOTTANT", after=call.keyword_end))
    absolute, wanted = False, list(components)
    while (option := call.keyword(("ABS", "AVEC", "SANS"))) is not None:
        if option == "ABS":
            absolute = True
            continue
        names = {str(n).rstrip() for n in call.required("LISTMOTS", after=call.keyword_end).values}
        wanted = [n for n in wanted if (n in names) == (option == "AVEC")]
    return _Search(word, limits, absolute, wanted)


def _doubted_if_empty(call: Call, found: Mesh) -> Mesh:
    """The points found; none raise the flag that SOUC reads."""
    if not found.n_cells:
        options = call.session.options
        options["SOUC"] = max(int(options.get("SOUC", 0)), 1)
    return found


def _of_field(call: Call, field: NodeField) -> Mesh:
    """Nodes where values are extreme or compare."""
    search = _read_search(call, list(field.components))
    parts = [field.components[n] for n in search.wanted]
    if not parts:
        return Mesh(field.table, ())
    nodes = np.concatenate([p.nodes for p in parts])
    values = np.concatenate([p.values for p in parts])
    return poi1(field.table, _once(nodes[search.picks(values)]))


def _of_cell_field(call: Call, field: CellField) -> Mesh:
    """Nodes, or new points at integration points, where values are extreme or compare."""
    names = list(dict.fromkeys(n for b in field.blocks for n in b.components))
    search = _read_search(call, names)
    nodes = field.blocks[0].cells.nodes
    values, places, ids = [], [], []
    for block in field.blocks:
        x, numbers = _support_points(block)
        for name in search.wanted:
            if name in block.components:
                part = np.asarray(block.components[name], dtype=float)
                values.append(np.broadcast_to(part, numbers.shape).ravel())
                places.append(x.reshape(-1, 3))
                ids.append(numbers.ravel())
    if not values:
        return Mesh(nodes, ())
    chosen = search.picks(np.concatenate(values))
    numbers = np.concatenate(ids)[chosen]
    fresh = numbers < 0
    if fresh.any():
        at = np.concatenate(places)[chosen][fresh]  # in the order of the cells
        first = np.sort(np.unique(at, axis=0, return_index=True)[1])
        return poi1(nodes, nodes.add(at[first], workspace(call.session).density))
    return poi1(nodes, _once(numbers))


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


@operator(
    "NOEU",
    arg("which", "ENTIER", "POINT"),
    family="mesh",
    full_name="NOEUD",
    help=Help(
        en="The point with a node number, or the node number of a point.",
        fr="Le point d'un numéro de noeud, ou le numéro de noeud d'un point.",
        syntax="POIN1 = NOEU N1 ; N1 = NOEU POIN1 ;",
        examples=("OPTI DIME 2 ; P = 1. 0. ; Q = NOEU (NOEU P) ; LIST (COOR 1 Q) ;",),
    ),
)
def noeu(session: Session, call: Call, which: Any) -> Any:
    """Node number and point."""
    ws = workspace(session)
    if isinstance(which, Point):
        return which.node + 1
    if not 1 <= which <= len(ws.nodes):
        raise call.bad(f"there is no node {which}, numbers go from 1 to {len(ws.nodes)}", which)
    return Point(ws.nodes, which - 1)


@operator(
    "CONF",
    arg("first", "POINT"),
    arg("second", "POINT"),
    family="mesh",
    full_name="CONFONDRE",
    help=Help(
        en="Makes the first point the same node as the second, wherever it is.",
        fr="Confond le premier point avec le second, où qu'il soit.",
        syntax="CONF POIN1 POIN2 ;",
        examples=("OPTI DIME 2 ; P = 1. 0. ; Q = 2. 0. ; CONF P Q ; LIST (COOR 1 P) ;",),
    ),
)
def conf(first: Point, second: Point) -> None:
    """Merge two points."""
    if first.node != second.node:
        first.nodes.merge(np.array([second.node]), np.array([first.node]))


@operator(
    "BARY",
    arg("mesh", "MAILLAGE", "POINT"),
    flag("each", "ELEM"),
    family="mesh",
    full_name="BARYCENTRE",
    help=Help(
        en="Mean position of a mesh's nodes, or with 'ELEM' of each cell's nodes.",
        fr="Position moyenne des noeuds d'un maillage ou, avec 'ELEM', des noeuds de chaque "
        "élément.",
        syntax="POIN1 = BARY GEO1 ('ELEM') ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; LIST (COOR 1 (BARY L)) ;",),
    ),
)
def bary(session: Session, mesh: Mesh | Point, each: bool) -> Any:
    """Mean positions."""
    ws = workspace(session)
    if isinstance(mesh, Point):
        return mesh
    if not mesh.n_cells:
        raise MeshError("the mesh is empty: it has no barycentre")
    if each:
        centres = np.concatenate([b.coordinates.mean(axis=1) for b in mesh.blocks])
        return poi1(ws.nodes, ws.nodes.add(centres, ws.density), ws.colour)
    centre = ws.nodes.coordinates[mesh.node_ids].mean(axis=0)
    return Point(ws.nodes, int(ws.nodes.add(centre[None], ws.density)[0]))
