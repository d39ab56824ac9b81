"""Cell types: names, sizes, faces. Names and node orders are those of Cast3M.

Quadratic cells number their nodes along the contour (corner, middle, corner, middle ...), not
corners first as VTK does; `ssilang.io` converts.
"""

import re
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CellType:
    """One kind of cell.

    Attributes
    ----------
    name : str
        Gibiane's name, such as 'QUA4'.
    dimension : int
        Of the cell itself: 0 point, 1 line, 2 surface, 3 volume; joints have that of their faces.
    degree : int
        1 linear, 2 quadratic.
    corners : tuple of int
        Local numbers of the corner nodes, in order.
    faces : tuple of (str, tuple of int)
        Cells of the boundary: type and local nodes, oriented outwards (2D cells: anticlockwise).
    joint : bool
        True for two facing sides (RAC2, RAC3, LIA3, LIA4, LIA6, LIA8): first half of the nodes
        on one face, second half on the other, in the same order.
    """

    name: str
    dimension: int
    n_nodes: int
    degree: int
    corners: tuple[int, ...]
    faces: tuple[tuple[str, tuple[int, ...]], ...] = ()
    joint: bool = False


POLYGON_SIDES: dict[str, int] = {f"POL{n}": n for n in range(5, 10)} | {
    f"PO{n}": n for n in (10, 11, 12)
}
"""Sides of the cells of a mesh of polygons (ELEM POLY) that are no triangles or quadrangles."""


def _polygon(name: str, corners: int, degree: int) -> CellType:
    n = corners * degree
    side = "SEG2" if degree == 1 else "SEG3"
    faces = tuple(
        (side, tuple((degree * i + j) % n for j in range(degree + 1))) for i in range(corners)
    )
    return CellType(name, 2, n, degree, tuple(range(0, n, degree)), faces)


COMPLETE = {
    "TRI6": "TRI7", "QUA8": "QUA9", "CU20": "CU27", "PR15": "PR21", "TE10": "TE15", "PY13": "PY19",
}  # fmt: skip
"""Complete cells by the quadratic ones."""


def _complete(quadratic: CellType) -> CellType:
    """The cell with a node in the middle of each face of three or four sides, and in its own."""
    n, faces = quadratic.n_nodes, quadratic.faces
    if quadratic.dimension == 3:
        faces = tuple((COMPLETE[k], (*local, n + i)) for i, (k, local) in enumerate(faces))
        n += len(faces)
    name = COMPLETE[quadratic.name]
    return CellType(name, quadratic.dimension, n + 1, 2, quadratic.corners, faces)


def _linear(name: str, quadratic: CellType) -> CellType:
    """The cell on the corners of one, whose faces begin with a corner and go round."""
    place = {corner: i for i, corner in enumerate(quadratic.corners)}
    faces = ((kind, tuple(place[i] for i in local[::2])) for kind, local in quadratic.faces)
    named = tuple(({"TRI6": "TRI3", "QUA8": "QUA4"}[kind], local) for kind, local in faces)
    n = len(place)
    return CellType(name, quadratic.dimension, n, 1, tuple(range(n)), named)


def _volume(name: str, *faces: tuple[int, ...]) -> CellType:
    """The quadratic cell of faces, which begin with a corner and go round."""
    corners = tuple(sorted({node for face in faces for node in face[::2]}))
    named = tuple(("TRI6" if len(face) == 6 else "QUA8", face) for face in faces)
    return CellType(name, 3, 1 + max(map(max, faces)), 2, corners, named)


# CU20: bottom contour of 8 (corner, middle, ...), 4 middles of the vertical edges, top of 8
_CU20 = _volume(
    "CU20",
    (0, 7, 6, 5, 4, 3, 2, 1),
    (12, 13, 14, 15, 16, 17, 18, 19),
    (0, 1, 2, 9, 14, 13, 12, 8),
    (2, 3, 4, 10, 16, 15, 14, 9),
    (4, 5, 6, 11, 18, 17, 16, 10),
    (6, 7, 0, 8, 12, 19, 18, 11),
)

# PR15: triangle contour of 6, 3 middles of the vertical edges, triangle contour of 6
_PR15 = _volume(
    "PR15",
    (0, 5, 4, 3, 2, 1),
    (9, 10, 11, 12, 13, 14),
    (0, 1, 2, 7, 11, 10, 9, 6),
    (2, 3, 4, 8, 13, 12, 11, 7),
    (4, 5, 0, 6, 9, 14, 13, 8),
)

# TE10: triangle contour of 6, 3 middles of the edges to the apex, apex
_TE10 = _volume(
    "TE10",
    (0, 5, 4, 3, 2, 1),
    (0, 1, 2, 7, 9, 6),
    (2, 3, 4, 8, 9, 7),
    (4, 5, 0, 6, 9, 8),
)

# PY13: base contour of 8, 4 middles of the edges to the apex, apex
_PY13 = _volume(
    "PY13",
    (0, 7, 6, 5, 4, 3, 2, 1),
    (0, 1, 2, 9, 12, 8),
    (2, 3, 4, 10, 12, 9),
    (4, 5, 6, 11, 12, 10),
    (6, 7, 0, 8, 12, 11),
)

CELL_TYPES: dict[str, CellType] = {
    c.name: c
    for c in (
        CellType("POI1", 0, 1, 1, (0,)),
        CellType("SEG2", 1, 2, 1, (0, 1), (("POI1", (0,)), ("POI1", (1,)))),
        CellType("SEG3", 1, 3, 2, (0, 2), (("POI1", (0,)), ("POI1", (2,)))),
        _polygon("TRI3", 3, 1),
        _polygon("TRI6", 3, 2),
        _polygon("QUA4", 4, 1),
        _polygon("QUA8", 4, 2),
        *(_polygon(name, n, 1) for name, n in POLYGON_SIDES.items()),
        _linear("TET4", _TE10),
        _linear("PRI6", _PR15),
        _linear("PYR5", _PY13),
        _linear("CUB8", _CU20),
        _CU20,
        _PR15,
        _TE10,
        _PY13,
        # complete cells: the quadratic ones, a node in the middle of each face of theirs (not those
        # of plane cells, which are lines), then one in the middle of the cell
        _complete(_polygon("TRI6", 3, 2)),
        _complete(_polygon("QUA8", 4, 2)),
        *map(_complete, (_CU20, _PR15, _TE10, _PY13)),
        CellType("RAC2", 1, 4, 1, (0, 1, 2, 3), joint=True),
        CellType("RAC3", 1, 6, 2, (0, 2, 3, 5), joint=True),
        CellType("LIA3", 2, 6, 1, (0, 1, 2, 3, 4, 5), joint=True),
        CellType("LIA4", 2, 8, 1, (0, 1, 2, 3, 4, 5, 6, 7), joint=True),
        CellType("LIA6", 2, 12, 2, (0, 2, 4, 6, 8, 10), joint=True),
        CellType("LIA8", 2, 16, 2, (0, 2, 4, 6, 8, 10, 12, 14), joint=True),
    )
}


LINEAR_CELLS: dict[str, str] = {
    c.name: linear.name
    for c in CELL_TYPES.values()
    for linear in CELL_TYPES.values()
    if linear.degree == 1 and linear.dimension == c.dimension and not (linear.joint or c.joint)
    and linear.n_nodes == len(c.corners)
}  # fmt: skip
"""The linear cell on the corners of each cell but joints."""


def many_noded(family: str, n_nodes: int) -> str:
    """Name of a cell of any number of nodes that only carries matrices ('SUPE5', 'MULT2').

    Such cells have no shape; their types are made when they are first asked for.
    """
    if n_nodes == 1:
        return "POI1"
    name = f"{family}{n_nodes}"
    CELL_TYPES.setdefault(name, CellType(name, 0, n_nodes, 1, tuple(range(n_nodes))))
    return name


def find_cell_type(name: str) -> CellType | None:
    """The type of a name, those of many nodes that are not made yet included; None if none is."""
    if (match := re.fullmatch("(SUPE|MULT|SURE)([1-9][0-9]{0,5})", name)) is not None:
        many_noded(match[1], int(match[2]))
    return CELL_TYPES.get(name)
