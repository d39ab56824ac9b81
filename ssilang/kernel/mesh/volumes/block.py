"""Bricks inside six faces meshed as grids (transfinite interpolation)."""

from collections.abc import Sequence

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.changes.degree import linear, quadratic
from ssilang.kernel.mesh.mesh import Mesh


def fill_block(faces: Sequence[Mesh], colour: int = 0) -> Mesh:
    """CUB8 (faces of QUA4) or CU20 (faces of QUA8) inside six faces.

    Raises
    ------
    MeshError
        If a face is no grid of quadrangles, or the faces do not close a block with the same
        numbers of cells on opposite sides.
    """
    kinds = {b.cell_type for f in faces for b in f.blocks}
    if kinds not in ({"QUA4"}, {"QUA8"}):
        raise MeshError("kernel.mesh.six-faces-qua4-qua8", kinds=sorted(kinds))
    flat = [linear(f).single_block().connectivity for f in faces]
    flat[1:] = sorted(flat[1:], key=lambda t: bool(np.isin(t, flat[0]).any()))  # opposite first
    bottom = _grid(flat[0])
    sides = [_grid(t) for t in flat[2:]]
    layers = _rim_layers(bottom, sides, set(flat[1].ravel().tolist()))
    ids = _filled(bottom, _grid(flat[1]), layers)
    nodes = faces[0].nodes
    known = set(ids[ids >= 0].tolist())
    for grid in sides:
        if not set(grid.ravel().tolist()) <= known:
            raise MeshError("kernel.mesh.side-face-numbers-cells")
    inner = ids < 0
    position = _transfinite(nodes.coordinates[np.where(inner, 0, ids)].copy())
    sizes = float(nodes.density[ids[~inner]].mean())
    ids[inner] = nodes.add(position[inner], sizes)
    made = Mesh.of(nodes, "CUB8", brick_cells(ids), colour, tuple(faces))
    if kinds == {"QUA8"}:
        skin = Mesh(nodes, tuple(b for f in faces for b in f.blocks))
        made = Mesh(nodes, quadratic(made, skin).blocks, tuple(faces))
    return made


def _grid(quads: IntArray) -> IntArray:
    """Node numbers (n, m) of a grid of quadrangles in any order."""
    ids, times = np.unique(quads, return_counts=True)
    corners = ids[times == 1]
    if len(corners) != 4:
        raise MeshError("kernel.mesh.face-no-grid-quadrangles", n_corners=len(corners))
    cells, used = quads.tolist(), set[int]()
    owners: dict[frozenset[int], list[int]] = {}
    for row, cell in enumerate(cells):
        for pair in zip(cell, cell[1:] + cell[:1], strict=True):
            owners.setdefault(frozenset(pair), []).append(row)

    def beyond(a: int, b: int) -> list[int]:
        """The cell on a side that is not met yet, from a by b on; empty where there is none."""
        for row in owners.get(frozenset((a, b)), ()):
            if row not in used:
                used.add(row)
                k, step = cells[row].index(a), 1
                if cells[row][(k + 1) % 4] != b:
                    step = -1
                return [cells[row][(k + step * i) % 4] for i in range(4)]
        return []

    cell = next(c for c in cells if corners[0] in c)
    k, table = cell.index(int(corners[0])), list[list[int]]()
    start = beyond(cell[k], cell[(k + 1) % 4])
    while start:
        low, high = start[:2], start[:1:-1]
        while cell := beyond(low[-1], high[-1]):
            low.append(cell[3])
            high.append(cell[2])
        table += [high] if table else [low, high]
        start = beyond(*high[:2])
    if len({len(r) for r in table}) > 1 or len(used) != len(quads):
        raise MeshError("kernel.mesh.face-strips-differ")
    return np.array(table, dtype=np.int64)


def _rim(grid: IntArray) -> list[int]:
    """Nodes round a grid, each once."""
    return [*grid[0, :-1], *grid[:-1, -1], *grid[-1, :0:-1], *grid[:0:-1, 0]]


def _rim_layers(bottom: IntArray, sides: Sequence[IntArray], top: set[int]) -> list[list[int]]:
    """Rims of all layers from the bottom to the top, node over node."""
    up: dict[int, set[int]] = {}
    for grid in sides:
        for first, second in ((grid[:-1], grid[1:]), (grid[:, :-1], grid[:, 1:])):
            for a, b in zip(first.ravel().tolist(), second.ravel().tolist(), strict=True):
                up.setdefault(a, set()).add(b)
                up.setdefault(b, set()).add(a)
    layers = [_rim(bottom)]
    seen = set(layers[0])
    while not set(layers[-1]) <= top:
        following = []
        for node in layers[-1]:
            free = up.get(node, set()) - seen
            if len(free) != 1:
                raise MeshError("kernel.mesh.four-side-faces-not")
            following.append(free.pop())
        layers.append(following)
        seen |= set(following)
    return layers


def _filled(bottom: IntArray, top: IntArray, layers: list[list[int]]) -> IntArray:
    """Node numbers (k, n, m), -1 where there is none yet: bottom, rims and top."""
    n, m = bottom.shape
    ids = np.full((len(layers), n, m), -1, dtype=np.int64)
    rows, columns = np.divmod(np.array(_rim(np.arange(n * m).reshape(n, m))), m)
    for k, rim in enumerate(layers):
        ids[k, rows, columns] = rim
    ids[0] = bottom
    ways = (top, top[::-1], top[:, ::-1], top[::-1, ::-1])
    for grid in (*ways, *(w.T for w in ways)):
        if grid.shape == (n, m) and _rim(grid) == layers[-1]:
            ids[-1] = grid
            return ids
    raise MeshError("kernel.mesh.first-two-faces-not")


def _transfinite(x: FloatArray) -> FloatArray:
    """Positions (k, n, m, 3) inside from those of the six faces."""
    shares = [
        _fractions(np.moveaxis(x, axis, 0)).reshape([-1 if a == axis else 1 for a in range(4)])
        for axis in range(3)
    ]

    def along(value: FloatArray, axis: int) -> FloatArray:
        t = shares[axis]
        return (1 - t) * np.take(value, [0], axis) + t * np.take(value, [-1], axis)

    one = along(x, 0) + along(x, 1) + along(x, 2)
    two = along(along(x, 0), 1) + along(along(x, 0), 2) + along(along(x, 1), 2)
    return one - two + along(along(along(x, 0), 1), 2)


def _fractions(x: FloatArray) -> FloatArray:
    """Mean fractions of the length along the four edges of the first axis."""
    edges = x[:, [0, 0, -1, -1], [0, -1, 0, -1]]
    steps = np.linalg.norm(np.diff(edges, axis=0), axis=2)
    length = np.vstack([np.zeros(4), np.cumsum(steps, axis=0)])
    return (length / length[-1]).mean(axis=1)


def brick_cells(ids: IntArray) -> IntArray:
    """Connectivity (n, 8) of a grid of node numbers (layers, rows, columns)."""
    low, high = ids[:-1], ids[1:]
    corners = []
    for layer in (low, high):
        corners += [layer[:, :-1, :-1], layer[:, :-1, 1:], layer[:, 1:, 1:], layer[:, 1:, :-1]]
    return np.stack(corners, axis=-1).reshape(-1, 8)
