"""How cells are described: INVE ORIE VERS ORDO."""

from ssilang.kernel.mesh import orientation
from ssilang.kernel.mesh.boundary import (
    chained,
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
    table = block.connectivity.copy()
    touching: dict[int, list[int]] = {}
    for i, (a, b) in enumerate(table[:, [0, -1]].tolist()):
        touching.setdefault(a, []).append(i)
        touching.setdefault(b, []).append(i)
    turned = np.zeros(len(table), dtype=bool)
    seen = np.zeros(len(table), dtype=bool)
    for first in range(len(table)):
        todo = [] if seen[first] else [first]
        seen[first] = True
        while todo:
            cell = todo.pop()
            tail, head = table[cell, [0, -1]] if not turned[cell] else table[cell, [-1, 0]]
            for node, at_start in ((int(head), True), (int(tail), False)):
                for other in touching[node]:
                    if not seen[other] and len(touching[node]) == 2:
                        seen[other] = True
                        starts_here = int(table[other, 0]) == node
                        turned[other] = starts_here != at_start
                        todo.append(other)
    return orientation.flip(block, turned)
