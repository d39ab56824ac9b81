"""Meshes as sets of cells: union, intersection, symmetric difference, duplicates."""

from collections.abc import Callable, Sequence

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
        result = Mesh(result.nodes, tuple(b for b in blocks.values() if len(b)))
    return result


def side_by_side(first: Mesh, second: Mesh, as_given: bool = False) -> Mesh:
    """Two meshes as one, with the sides that both keep together.

    Two surfaces of four sides, one of which they share: 1 and 3 face it in the first and in the
    second, 2 and 4 go along both. Two volumes, the first's face 2 the second's face 1.
    """
    made, old, new = union(first, second, as_given=as_given), first.sides, second.sides
    sides: tuple[Mesh, ...] = ()
    if made.dimension == 2 and len(old) == len(new) == 4:
        shared = next(((i, j) for i in (2, 1, 3, 0) for j in range(4) if _same(old[i], new[j])), ())
        if shared:
            i, j = shared
            before, after = old[i - 1], old[(i + 1) % 4]
            right, left = new[(j + 1) % 4], new[j - 1]
            if not np.isin(before.node_ids, right.node_ids).any():
                right, left = left, right
            along = (union(before, right, as_given=True), union(left, after, as_given=True))
            sides = (old[i - 2], along[0], new[j - 2], along[1])
    elif made.dimension == 3 and min(len(old), len(new)) > 1 and _same(old[1], new[0]):
        around = [m.sides[2] for m in (first, second) if len(m.sides) > 2]
        sides = (old[0], new[1], *((union(*around, as_given=True),) if around else ()))
    return Mesh(made.nodes, made.blocks, sides)


def _same(first: Mesh, second: Mesh) -> bool:
    """Whether two meshes have the same cells."""
    return first.n_cells == second.n_cells and not difference(first, second).blocks


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
    parts = (block.some(chosen(block)) for block in mesh.blocks)
    return Mesh(mesh.nodes, tuple(p for p in parts if len(p)))


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
    """The cells of five sides and more; an error if there are none."""
    found = tuple(b for b in mesh.blocks if b.cell_type in POLYGON_SIDES)
    if not found:
        raise MeshError("kernel.mesh.no-polygons-five-sides")
    return Mesh(mesh.nodes, found)


def of_type(mesh: Mesh, cell_type: str) -> Mesh:
    """The cells of one type; an error if there are none."""
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
