"""Meshes as sets of cells: union, intersection, symmetric difference, duplicates."""

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import BoolArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import POLYGON_SIDES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def join_blocks(blocks: Sequence[CellBlock]) -> CellBlock:
    """One block from several of the same type, cells in order."""
    if len(blocks) == 1:
        return blocks[0]
    return CellBlock.make(
        blocks[0].nodes,
        blocks[0].cell_type,
        np.concatenate([b.connectivity for b in blocks]),
        np.concatenate([b.colours for b in blocks]),
    )


def union(*meshes: Mesh, as_given: bool = False) -> Mesh:
    """Cells of all meshes; those of one type become one block.

    Parameters
    ----------
    as_given : bool
        False: two lines are put in the order in which one continues the other (a line whose end
        is the start of the one before it is put first).
    """
    result = meshes[0]
    for other in meshes[1:]:
        blocks = {b.cell_type: b for b in result.blocks if len(b)}
        for block in other.blocks:
            mine = blocks.get(block.cell_type)
            if mine is None:
                blocks[block.cell_type] = block
            elif mine is not block and len(block):
                pair = (mine, block)
                if not as_given and _continues(block, mine):
                    pair = (block, mine)
                blocks[block.cell_type] = join_blocks(pair)
        made = tuple(b for b in blocks.values() if len(b))
        result = Mesh(result.nodes, made, _outer_sides(result, other) if len(made) == 1 else ())
    return result


def _outer_sides(first: Mesh, second: Mesh) -> tuple[Mesh, ...]:
    """Sides of two surfaces of four sides that have one in common, none of others.

    Side 1 faces the common one in the first, side 3 in the second; the lateral ones go on.
    """
    if not len(first.sides) == len(second.sides) == 4:
        return ()
    mine, other = ([_along(s) for s in m.sides] for m in (first, second))
    for i, j in product(range(4), range(4)):
        if mine[i] and mine[i] in (other[j], other[j][::-1]):
            break
    else:
        return ()
    right, left = (first.sides[(i + k) % 4] for k in (3, 1))
    on = [(j + 1) % 4, (j + 3) % 4]
    if not {mine[(i + 3) % 4][0], mine[(i + 3) % 4][-1]} & {other[on[0]][0], other[on[0]][-1]}:
        on.reverse()
    after, before = (second.sides[k] for k in on)
    facing = first.sides[(i + 2) % 4], second.sides[(j + 2) % 4]
    return facing[0], union(right, after), facing[1], union(before, left)


def _along(side: Mesh) -> list[int]:
    """Nodes of a line of one block in order."""
    if len(side.blocks) != 1:
        return []
    table = side.blocks[0].connectivity
    return [*table[:, :-1].ravel().tolist(), int(table[-1, -1])]


def gathered(meshes: Sequence[Mesh]) -> Mesh:
    """Cells of many meshes in the order given; those of one type become one block."""
    by_type: dict[str, list[CellBlock]] = {}
    for mesh in meshes:
        for block in mesh.blocks:
            by_type.setdefault(block.cell_type, []).append(block)
    return Mesh(meshes[0].nodes, tuple(join_blocks(blocks) for blocks in by_type.values()))


def _continues(line: CellBlock, next_line: CellBlock) -> bool:
    """True when `next_line` starts where `line` ends, and not the other way round as well."""
    if line.cell_type not in ("SEG2", "SEG3"):
        return False
    a, b = line.connectivity, next_line.connectivity
    return bool(a[-1, -1] == b[0, 0] and b[-1, -1] != a[0, 0])


def poi1(nodes: NodeTable, ids: IntArray, colour: int = 0) -> Mesh:
    """A mesh of POI1 on node numbers (m,); no block at all when there are none."""
    if len(ids) == 0:
        return Mesh(nodes, ())
    return Mesh.of(nodes, "POI1", np.asarray(ids)[:, None], colour)


def take(mesh: Mesh, chosen: Callable[[CellBlock], BoolArray | IntArray]) -> Mesh:
    """The cells of each block that `chosen` picks (mask or indices); empty blocks vanish."""
    parts = []
    for block in mesh.blocks:
        pick = chosen(block)
        table, colours = block.connectivity[pick], block.colours[pick]
        if len(table):
            parts.append(CellBlock.make(mesh.nodes, block.cell_type, table, colours))
    return Mesh(mesh.nodes, tuple(parts))


def cell_keys(block: CellBlock, ordered: bool = False) -> NDArray[np.void]:
    """A key for each cell (n,), equal on the same nodes, in the same order too if `ordered`."""
    return row_keys(block.connectivity, ordered)


def row_keys(nodes: IntArray, ordered: bool = False) -> NDArray[np.void]:
    """The same for rows (n, k) of nodes."""
    table = np.ascontiguousarray(nodes if ordered else np.sort(nodes, axis=1))
    return table.view([("", table.dtype)] * table.shape[1]).ravel()


def intersection(first: Mesh, second: Mesh) -> Mesh:
    """Cells of `first` that also are cells of `second` (same type, same nodes)."""
    return take(first, lambda b: _found_in(b, second))


def difference(first: Mesh, second: Mesh) -> Mesh:
    """Cells of `first` that are not cells of `second`."""
    return take(first, lambda b: ~_found_in(b, second))


def symmetric_difference(first: Mesh, second: Mesh) -> Mesh:
    """Cells that belong to one of the meshes only."""
    return union(difference(first, second), difference(second, first))


def without_duplicates(mesh: Mesh, ordered: bool = False) -> Mesh:
    """Each cell once, the first one kept, whatever the colour.

    Parameters
    ----------
    ordered : bool
        Cells on the same nodes in another order are not the same.
    """
    return take(mesh, lambda b: np.sort(np.unique(cell_keys(b, ordered), return_index=True)[1]))


def _found_in(block: CellBlock, other: Mesh) -> BoolArray:
    same = [b for b in other.blocks if b.cell_type == block.cell_type]
    if not same:
        return np.zeros(len(block), dtype=bool)
    return np.isin(cell_keys(block), np.concatenate([cell_keys(b) for b in same]))


def polygons(mesh: Mesh) -> Mesh:
    """The cells of five sides and more.

    Raises
    ------
    MeshError
        If there are none.
    """
    found = tuple(b for b in mesh.blocks if b.cell_type in POLYGON_SIDES)
    if not found:
        raise MeshError("kernel.mesh.no-polygons-five-sides")
    return Mesh(mesh.nodes, found)


def of_type(mesh: Mesh, cell_type: str) -> Mesh:
    """The cells of one type.

    Raises
    ------
    MeshError
        If there are none.
    """
    found = tuple(b for b in mesh.blocks if b.cell_type == cell_type)
    if not found:
        kinds = [b.cell_type for b in mesh.blocks]
        raise MeshError("kernel.mesh.no-mesh-holds", cell_type=cell_type, kinds=kinds)
    return Mesh(mesh.nodes, found)


def recolour(mesh: Mesh, colour: int) -> Mesh:
    """The same mesh in another colour; its sides keep theirs."""
    blocks = tuple(
        CellBlock(b.nodes, b.cell_type, b.raw, np.full(len(b), colour, dtype=np.int8))
        for b in mesh.blocks
    )
    return Mesh(mesh.nodes, blocks, mesh.sides)
