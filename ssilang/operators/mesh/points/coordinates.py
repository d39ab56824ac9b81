"""Points and coordinates: COOR NOEU CONF BARY."""

from ssilang.kernel.mesh.boundary import chained
from ssilang.kernel.mesh.combine import poi1
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.operators.dispatch import COOR
from ssilang.operators.prelude import *

_AXIS = arg(
    "axis",
    "ENTIER",
    en="number of the coordinate; the dimension + 1 stands for the density",
    range=POSITIVE,
)
_POINT = main("support", "POINT", en="point")
_MESH = main("support", "MAILLAGE", en="mesh")
_NODE_FIELD = main("support", "CHPOINT", en="field at nodes")
_MODEL = main("support", "MMODEL", en="model")

Support = Point | Mesh | NodeField | Model


@COOR.form(_MODEL, _AXIS, gives="MCHAML")
@COOR.form(_NODE_FIELD, _AXIS, gives="CHPOINT")
@COOR.form(_MESH, _AXIS, gives="CHPOINT")
@COOR.form(_POINT, _AXIS, gives="FLOTTANT")
def one_coordinate(call: Call, support: Support, axis: int) -> float | NodeField | CellField:
    """One coordinate, or the density."""
    dimension = max(workspace(call.session).dimension, 1)
    if not 1 <= axis <= dimension + 1:
        raise call.error("operators.mesh.no-such-coordinate", axis, axis=axis, dimension=dimension)
    return _coordinate(support, axis - 1, axis > dimension)


@COOR.form(_MODEL, gives=ANY)
@COOR.form(_NODE_FIELD, gives=ANY)
@COOR.form(_MESH, gives=ANY)
@COOR.form(_POINT, gives=ANY)
def all_coordinates(
    session: Session, support: Support
) -> tuple[float | NodeField | CellField, ...]:
    """All coordinates."""
    axes = range(max(workspace(session).dimension, 1))
    return tuple(_coordinate(support, axis, False) for axis in axes)


@COOR.form(said("CURV"))
def curvilinear_coordinate(
    line: Mesh = Arg("MAILLAGE", en="line"),
    axis: int | None = Opt("ENTIER", en="accepted, without effect", range=ANY_NUMBER),
) -> NodeField:
    """Length along a line."""
    return curvilinear(line)


def _coordinate(support: Support, axis: int, density: bool) -> float | NodeField | CellField:
    """One coordinate, from 0, or the density, of what an object stands on."""
    if isinstance(support, Model):
        blocks = tuple(
            z.block({"SCAL": _column(c.nodes, axis, density)[c.connectivity]}, "NOEUD")
            for z, c in ((z, z.cells) for z in support.zones)
        )
        return CellField(blocks, "SCALAIRE")
    nodes = support.table if isinstance(support, NodeField) else support.nodes
    column = _column(nodes, axis, density)
    if isinstance(support, Point):
        return float(column[support.node])
    ids = support.sorted_node_ids if isinstance(support, Mesh) else support.node_ids
    return NodeField.of(nodes, ids, {"SCAL": column[ids]}, "DIFFUS")


def _column(nodes: NodeTable, axis: int, density: bool) -> FloatArray:
    return nodes.density if density else nodes.coordinates[:, axis]


def curvilinear(line: Mesh) -> NodeField:
    """Length along a line from its start, at its nodes; a closed line starts with its first cell.

    Raises
    ------
    MeshError
        If the mesh is not one line.
    """
    chain = line_chain(chained(line))
    xyz = line.nodes.coordinates[chain]
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(xyz, axis=0), axis=1))])
    if chain[0] == chain[-1]:
        chain, length = chain[:-1], length[:-1]
    return NodeField.of(line.nodes, chain, {"SCAL": length}, "DIFFUS")


@operator("NOEU", family="mesh", full_name="NOEUD")
def noeu(point: Point = Arg("POINT", en="point")) -> int:
    """The number of a point's node."""
    return point.node + 1


@noeu.form()
def numbered(
    session: Session, call: Call, number: int = Arg("ENTIER", en="number of a node", range=POSITIVE)
) -> Point:
    """The point of a node."""
    nodes = workspace(session).nodes
    if not 1 <= number <= len(nodes):
        raise call.error("operators.mesh.no-such-node", number, number=number, n_nodes=len(nodes))
    return Point(nodes, number - 1)


@operator("CONF", family="mesh", full_name="CONFONDRE")
def conf(
    first: Point = Arg("POINT", en="point that goes"),
    second: Point = Arg("POINT", en="point that it becomes"),
) -> None:
    """Merge two points."""
    if first.node != second.node:
        first.nodes.merge(np.array([second.node]), np.array([first.node]))


@operator("BARY", family="mesh", full_name="BARYCENTRE")
def bary(
    session: Session, mesh: Mesh | Point = Arg("MAILLAGE", "POINT", en="mesh, or point")
) -> Point:
    """Mean position of the nodes."""
    if isinstance(mesh, Point):
        return mesh
    ws = workspace(session)
    _not_empty(mesh)
    centre = ws.nodes.coordinates[mesh.node_ids].mean(axis=0)
    return Point(ws.nodes, int(ws.nodes.add(centre[None], ws.density)[0]))


@bary.form(said("ELEM"))
def centres_of_cells(session: Session, mesh: Mesh = Arg("MAILLAGE", en="cells")) -> Mesh:
    """Mean position of each cell's nodes."""
    ws = workspace(session)
    _not_empty(mesh)
    centres = np.concatenate([b.coordinates.mean(axis=1) for b in mesh.blocks])
    return poi1(ws.nodes, ws.nodes.add(centres, ws.density), ws.colour)


def _not_empty(mesh: Mesh) -> None:
    if not mesh.n_cells:
        raise MeshError("operators.mesh.no-barycentre")
