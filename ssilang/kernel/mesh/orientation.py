"""Sense of description of cells: reversing, orienting, checking."""

import numpy as np

from ssilang.kernel.base.arrays import BoolArray, FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.cells import CELL_TYPES, LINEAR_CELLS, POLYGON_SIDES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


def _polygon_flip(n: int) -> tuple[int, ...]:
    return (0, *range(n - 1, 0, -1))


# node order of each cell turned inside out, the first node kept where it can be
_FLIPS: dict[str, tuple[int, ...]] = {
    "SEG2": (1, 0),
    "SEG3": (2, 1, 0),
    "TRI3": _polygon_flip(3),
    "TRI6": _polygon_flip(6),
    "QUA4": _polygon_flip(4),
    "QUA8": _polygon_flip(8),
    **{name: _polygon_flip(n) for name, n in POLYGON_SIDES.items()},
    "TET4": (0, 2, 1, 3),
    "TE10": (*_polygon_flip(6), 6, 8, 7, 9),
    "PYR5": (0, 3, 2, 1, 4),
    "PRI6": (0, 2, 1, 3, 5, 4),
    "PR15": (*_polygon_flip(6), 6, 8, 7, 9, 14, 13, 12, 11, 10),
    "CUB8": (0, 3, 2, 1, 4, 7, 6, 5),
    "CU20": (*_polygon_flip(8), 8, 11, 10, 9, 12, 19, 18, 17, 16, 15, 14, 13),
    "PY13": (*_polygon_flip(8), 8, 11, 10, 9, 12),
    "TRI7": (*_polygon_flip(6), 6),
    "QUA9": (*_polygon_flip(8), 8),
}
# complete volumes: the nodes in the middles of the faces follow these, the last one stays
for _name, _whole in (("TE10", "TE15"), ("PY13", "PY19"), ("PR15", "PR21"), ("CU20", "CU27")):
    _order, _faces = _FLIPS[_name], [set(face) for _, face in CELL_TYPES[_name].faces]
    _turned = [len(_order) + _faces.index({_order[i] for i in face}) for face in _faces]
    _FLIPS[_whole] = (*_order, *_turned, len(_order) + len(_faces))


def flipped_order(cell_type: str) -> tuple[int, ...]:
    """Places of the nodes of a cell turned inside out, () for one without an orientation."""
    return _FLIPS.get(cell_type, ())


def flip(block: CellBlock, which: BoolArray | None = None) -> CellBlock:
    """The block with the cells of `which` (n,) turned inside out (all when None).

    Cells that have no orientation are left alone; the order of cells is kept.
    """
    order = _FLIPS.get(block.cell_type)
    if order is None:
        return block
    table = block.connectivity[:, list(order)]
    if which is not None:
        table = np.where(which[:, None], table, block.connectivity)
    return CellBlock.make(block.nodes, block.cell_type, table, block.colours)


def reversed_line(mesh: Mesh) -> Mesh:
    """The mesh turned inside out; cells of lines are also put in reverse order."""
    blocks = []
    for block in mesh.blocks:
        turned = flip(block)
        if block.kind.dimension == 1 and not block.kind.joint:
            turned = turned.some(slice(None, None, -1))
        blocks.append(turned)
    return Mesh(mesh.nodes, tuple(blocks))


def surface_normals(block: CellBlock) -> FloatArray:
    """Mean normals of triangles and quadrangles, as long as the area, shape (n, 3).

    Right-hand rule round the nodes; exact area vector of the polygon of corners.
    """
    corners = block.coordinates[:, list(block.kind.corners)]
    origin = corners[:, :1]
    rays = corners - origin
    return 0.5 * np.cross(rays[:, 1:-1], rays[:, 2:]).sum(axis=1)


def signed_volumes(block: CellBlock) -> FloatArray:
    """Volumes enclosed by the faces of linear 3D cells (corners only), shape (n,).

    Positive when the faces of `CELL_TYPES` point outwards.
    """
    points = block.coordinates[:, list(block.kind.corners)]
    points = points - points[:, :1]
    total = np.zeros(len(block))
    for _, face in CELL_TYPES[LINEAR_CELLS[block.cell_type]].faces:
        part = points[:, list(face)]
        centre = part.mean(axis=1)
        following = np.roll(part, -1, axis=1)
        triple = np.einsum("nij,nij->n", np.cross(part, following), centre[:, None] + 0 * part)
        total += triple / 6.0
    return total


def orient(mesh: Mesh, space_dimension: int) -> Mesh:
    """Cells described so that their Jacobian is positive: lines in 1D (x increasing), surfaces in
    2D (anticlockwise), volumes in 3D; other cells are left alone."""
    return Mesh(mesh.nodes, tuple(_oriented(b, space_dimension) for b in mesh.blocks), mesh.sides)


def _oriented(block: CellBlock, space_dimension: int) -> CellBlock:
    if block.kind.dimension != space_dimension or block.kind.joint:
        return block
    if space_dimension == 1:
        x = block.coordinates[:, :, 0]
        return flip(block, x[:, -1] < x[:, 0])
    if space_dimension == 2:
        return flip(block, surface_normals(block)[:, 2] < 0)
    return flip(block, signed_volumes(block) < 0)


def orient_towards(mesh: Mesh, target: FloatArray, is_point: bool) -> Mesh:
    """Cells turned so that their normals go along a vector, or towards a point (3,).

    Surface cells, and bricks of 8 nodes as shells have them: from the first face to the second,
    which become the sides of a mesh of nothing else.
    """
    blocks = []
    for block in mesh.blocks:
        brick = block.cell_type == "CUB8"
        if (block.kind.dimension != 2 and not brick) or block.kind.joint:
            blocks.append(block)
            continue
        aim = target - block.coordinates.mean(axis=1) if is_point else target
        if brick:
            # Bricks that go from their first four nodes to their last four along `aim`.
            x = block.coordinates
            through = x[:, 4:].mean(axis=1) - x[:, :4].mean(axis=1)
            back = (through * aim).sum(axis=1) < 0
            nodes = np.where(back[:, None], block.raw[:, _OTHER_FACE], block.raw)
            blocks.append(CellBlock(block.nodes, block.cell_type, nodes, block.colours))
            continue
        sense = (surface_normals(block) * aim).sum(axis=1)
        blocks.append(flip(block, sense < 0))
    bricks = blocks and all(b.cell_type == "CUB8" for b in blocks)
    return Mesh(mesh.nodes, tuple(blocks), _skins(blocks) if bricks else mesh.sides)


_OTHER_FACE = [4, 7, 6, 5, 0, 3, 2, 1]
"""Nodes of a brick from its second face on, its Jacobian keeping its sign."""


def _skins(blocks: list[CellBlock]) -> tuple[Mesh, Mesh]:
    """First and second face of bricks of 8 nodes."""
    nodes = blocks[0].nodes
    first, second = (
        Mesh(nodes, tuple(CellBlock.make(nodes, "QUA4", b.raw[:, part]) for b in blocks))
        for part in (slice(0, 4), slice(4, 8))
    )
    return first, second


def check_consistent(mesh: Mesh) -> Mesh:
    """The mesh itself, if no two adjacent cells of one dimension are described in opposite senses.

    Raises
    ------
    MeshError
        With the nodes where two cells disagree.
    """
    for dimension in (1, 2):
        clash = _opposed(mesh, dimension)
        if len(clash):
            told = [mesh.nodes.told(n) for n in clash[:4]]
            raise MeshError("kernel.mesh.adjacent-cells-described-opposite", nodes=told)
    return mesh


def _opposed(mesh: Mesh, dimension: int) -> IntArray:
    """Nodes of a boundary (end or directed edge) that two cells run in the same sense."""
    keys: list[IntArray] = []
    for block in mesh.blocks_of(dimension):
        table = block.connectivity
        if dimension == 1:
            one = np.ones(len(table), dtype=np.int64)
            keys += [np.column_stack([table[:, 0], one]), np.column_stack([table[:, -1], 2 * one])]
        else:
            keys += [table[:, [face[0], face[-1]]] for _, face in block.kind.faces]
    if not keys:
        return np.empty(0, dtype=np.int64)
    rows, times = np.unique(np.concatenate(keys), axis=0, return_counts=True)
    nodes: IntArray = rows[times > 1][:, 0]
    if dimension == 1:  # a node where three or more lines meet tells nothing
        ends, met = np.unique(np.concatenate(keys)[:, 0], return_counts=True)
        nodes = nodes[np.isin(nodes, ends[met == 2])]
    return nodes
