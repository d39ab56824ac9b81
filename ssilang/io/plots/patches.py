"""Faces of cells that a picture shows, and the pieces into which a face is cut for colouring."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.elements.shapes.polygons import regular_polygon
from ssilang.kernel.elements.shapes.reference import shape_functions
from ssilang.kernel.mesh.boundary import sharing
from ssilang.kernel.mesh.cells import CELL_TYPES, POLYGON_SIDES, CellType
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


@dataclass(frozen=True, eq=False)
class Faces:
    """Faces of one kind that belong to one block of cells."""

    kind: str  # POI1, SEG2, SEG3, TRI3, TRI6, QUA4 or QUA8; nodes along the contour
    nodes: IntArray  # (n, k)
    cells: IntArray  # (n,) row of the owner in its block
    local: IntArray  # (k,) local numbers of the nodes in the owner
    block: CellBlock

    @property
    def colours(self) -> NDArray[np.int8]:
        """Colour index of each face, shape (n,)."""
        return self.block.colours[self.cells]


# joints: the cell between two lines and these lines (all that is seen of a closed one), or the
# two faces of a surface joint
_JOINT_FACES: dict[str, tuple[tuple[str, tuple[int, ...]], ...]] = {
    "RAC2": (("QUA4", (0, 1, 3, 2)), ("SEG2", (0, 1)), ("SEG2", (2, 3))),
    "RAC3": (("QUA4", (0, 2, 5, 3)), ("SEG3", (0, 1, 2)), ("SEG3", (3, 4, 5))),
    "LIA3": (("TRI3", (0, 1, 2)), ("TRI3", (3, 4, 5))),
    "LIA4": (("QUA4", (0, 1, 2, 3)), ("QUA4", (4, 5, 6, 7))),
    "LIA6": (("TRI6", (0, 1, 2, 3, 4, 5)), ("TRI6", (6, 7, 8, 9, 10, 11))),
    "LIA8": (("QUA8", tuple(range(8))), ("QUA8", tuple(range(8, 16)))),
}


def visible_faces(mesh: Mesh) -> list[Faces]:
    """The faces to draw: cells of lines and surfaces, outer faces of volumes."""
    found = [f for block in mesh.blocks for f in _faces_of(block)]
    outer = _outer([f for f in found if _is_volume(f.block.kind)])
    return [f for f in found if not _is_volume(f.block.kind)] + outer


def all_faces(mesh: Mesh) -> list[Faces]:
    """Faces of all cells, inner ones too."""
    return [f for block in mesh.blocks for f in _faces_of(block)]


def _is_volume(kind: CellType) -> bool:
    return kind.dimension == 3 and not kind.joint


def _faces_of(block: CellBlock) -> Iterator[Faces]:
    kind = block.kind
    every = np.arange(len(block), dtype=np.int64)
    if kind.joint:
        faces = _JOINT_FACES[kind.name]
    elif _is_volume(kind):
        faces = kind.faces
    else:
        faces = ((kind.name, tuple(range(kind.n_nodes))),)
    for face, local in faces:
        columns = np.array(local)
        yield Faces(face, block.connectivity[:, columns], every, columns, block)


def _outer(faces: list[Faces]) -> list[Faces]:
    """Those faces whose corners occur once."""
    if not faces:
        return []
    keys = np.full((sum(len(f.nodes) for f in faces), 4), -1, dtype=np.int64)
    start = 0
    for f in faces:
        corners = f.nodes[:, list(CELL_TYPES[f.kind].corners)]
        keys[start : start + len(f.nodes), : corners.shape[1]] = corners
        start += len(f.nodes)
    single = sharing(keys)[0] == 1
    kept, start = [], 0
    for f in faces:
        mine = single[start : start + len(f.nodes)]
        start += len(f.nodes)
        if mine.any():
            kept.append(Faces(f.kind, f.nodes[mine], f.cells[mine], f.local, f.block))
    return kept


@lru_cache(maxsize=64)
def pieces(kind: str, n: int) -> tuple[FloatArray, IntArray]:
    """A face cut into n pieces along each side.

    Returns
    -------
    shape : array (p, k)
        Shape functions at the p sample points; `shape @ nodal` interpolates.
    parts : array (t, 3) or (t, 2)
        Triangles, or segments of a line, over the sample points.
    """
    if kind in ("SEG2", "SEG3"):
        rows = np.arange(n)
        points = np.linspace(-1.0, 1.0, n + 1)[:, None]
        parts = np.column_stack([rows, rows + 1])
    elif kind in ("TRI3", "TRI6"):
        points, parts = _cut_triangle(n)
    elif kind in POLYGON_SIDES:
        points, parts = _cut_polygon(POLYGON_SIDES[kind])
    else:
        points, parts = _cut_quadrangle(n)
    return shape_functions(kind, points), parts


def _cut_polygon(sides: int) -> tuple[FloatArray, IntArray]:
    """Triangles between the centre and the sides."""
    rows = np.arange(sides)
    parts = np.column_stack([rows, (rows + 1) % sides, np.full(sides, sides)])
    return np.vstack([regular_polygon(sides), np.zeros((1, 2))]), parts


def _cut_triangle(n: int) -> tuple[FloatArray, IntArray]:
    points = [(i / n, j / n) for j in range(n + 1) for i in range(n + 1 - j)]
    index = {(round(x * n), round(y * n)): row for row, (x, y) in enumerate(points)}
    parts = []
    for i, j in index:
        if i + j < n:
            parts.append((index[i, j], index[i + 1, j], index[i, j + 1]))
        if i + j < n - 1:
            parts.append((index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]))
    return np.array(points), np.array(parts)


def _cut_quadrangle(n: int) -> tuple[FloatArray, IntArray]:
    line = np.linspace(-1.0, 1.0, n + 1)
    s, r = (a.ravel() for a in np.meshgrid(line, line, indexing="ij"))
    ids = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b = ids[:-1, :-1].ravel(), ids[:-1, 1:].ravel()
    c, d = ids[1:, 1:].ravel(), ids[1:, :-1].ravel()
    # diagonals meet in the middle of the face, so that symmetric data look symmetric
    row, col = np.divmod(np.arange(n * n), n)
    rising = (row < n / 2) == (col < n / 2)
    first = np.where(rising[:, None], np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    second = np.where(rising[:, None], np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    return np.column_stack([r, s]), np.concatenate([first, second])
