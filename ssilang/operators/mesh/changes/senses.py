"""How cells are described: INVE ORIE VERS ORDO."""

from ssilang.kernel.mesh import orientation
from ssilang.kernel.mesh.boundary import (
    chained,
    walked,
)
from ssilang.kernel.mesh.queries.partition import by_neighbours
from ssilang.operators.dispatch import INVE, ORDO
from ssilang.operators.prelude import *


@INVE.form()
def inverted(mesh: Mesh = Main("MAILLAGE", en="mesh")) -> Mesh:
    """Mesh turned inside out."""
    return orientation.reversed_line(mesh)


@operator("ORIE", family="mesh", full_name="ORIENTER")
def orie(
    call: Call,
    towards: str | None = Choice(
        ("DIRECTION", "POINT"), en="normals go in a direction, the default, or towards a point"
    ),
    mesh: Mesh = Arg("MAILLAGE", en="cells"),
    target: Point | None = Opt("POINT", en="direction, or point"),
) -> Mesh:
    """Orient cells."""
    if target is not None:
        return orientation.orient_towards(mesh, target.coordinates.copy(), towards == "POINT")
    if towards is not None:
        raise call.missing(("POINT",))
    return orientation.orient(mesh, max(workspace(call.session).dimension, 1))


@operator("VERS", family="mesh", full_name="VERSENS")
def vers(mesh: Mesh = Arg("MAILLAGE", en="lines or surfaces")) -> Mesh:
    """Check the sense of description."""
    return orientation.check_consistent(mesh)


@ORDO.form()
def ordered_cells(mesh: Mesh = Main("MAILLAGE", en="mesh")) -> Mesh:
    """Mesh with its cells in order."""
    return Mesh(mesh.nodes, tuple(_ordered_block(b) for b in mesh.blocks))


def _ordered_block(block: CellBlock) -> CellBlock:
    if block.kind.dimension == 0:
        at = block.coordinates[:, 0]
        order = np.argsort(np.linalg.norm(at - at[0], axis=1), kind="stable")
        return CellBlock.make(block.nodes, "POI1", block.raw[order], block.colours[order])
    if block.kind.joint:
        return block
    if block.kind.dimension > 1:
        return by_neighbours(block)
    return chained(Mesh(block.nodes, (_in_one_sense(block),))).blocks[0]


def _in_one_sense(block: CellBlock) -> CellBlock:
    """Segments turned so that each chain runs in the sense of its first cell."""
    table = block.connectivity
    nodes, times = np.unique(table[:, [0, -1]], return_counts=True)
    corners = nodes[times != 2]
    found, places = walked(table, np.concatenate([corners, table[:, 0]]))
    parts = (found[1:, 0] != found[:-1, -1]) | np.isin(found[1:, 0], corners)
    chain = np.cumsum(np.append(0, parts))
    back = found[:, 0] != table[places, 0]
    order = np.lexsort((places, chain))
    first = back[order[np.unique(chain[order], return_index=True)[1]]]
    turned = np.zeros(len(table), dtype=bool)
    turned[places] = back ^ first[chain]
    return orientation.flip(block, turned)
