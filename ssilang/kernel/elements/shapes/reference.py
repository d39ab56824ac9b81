"""Reference cells: node positions and shape functions, as data.

A cell's shape functions span a list of monomials; their coefficients are the inverse of the
Vandermonde matrix of the nodes. One function then serves every cell type. Pyramids add rational
functions to their monomials (x y / (1 - z)), complete cells sums of monomials that vanish on the
other faces (bubbles).
"""

from dataclasses import dataclass, field
from functools import cache

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.shapes import polygons


@dataclass(frozen=True, eq=False)
class ReferenceCell:
    """One cell type on its reference domain.

    Attributes
    ----------
    shape : str
        Domain: 'point', 'line' [-1, 1], 'triangle' (unit), 'quadrangle' [-1, 1]^2, 'tetrahedron'
        (unit), 'polygon5' (regular, in the unit circle) ..., 'prism' (triangle times [-1, 1]),
        'pyramid' (base [-1, 1]^2, apex z = 1), 'hexahedron' [-1, 1]^3.
    nodes : array (n_nodes, dim)
        In Cast3M's order.
    exponents : array (n_monomials, dim) of int
    sums : array (n_monomials, n_sums), or None
        The functions that monomials make; None: they are the functions themselves.
    over : array (n, 3) of int
        Exponents of monomials that count divided by 1 - z, beside the others.
    """

    shape: str
    nodes: FloatArray
    exponents: IntArray
    sums: FloatArray | None = None
    over: IntArray = field(default_factory=lambda: np.zeros((0, 3), np.int64))


def _corners_and_middles(corners: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    """Contour of a polygon with the middle of each side between its ends."""
    out: list[tuple[float, ...]] = []
    for here, following in zip(corners, corners[1:] + corners[:1], strict=True):
        out.append(here)
        out.append(tuple((a + b) / 2 for a, b in zip(here, following, strict=True)))
    return out


def _lift(points: list[tuple[float, ...]], z: float) -> list[tuple[float, ...]]:
    return [(*p, z) for p in points]


_TRIANGLE: list[tuple[float, ...]] = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]
_SQUARE: list[tuple[float, ...]] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
_TRIANGLE_2 = _corners_and_middles(_TRIANGLE)
_SQUARE_2 = _corners_and_middles(_SQUARE)

_P1 = [(0, 0), (1, 0), (0, 1)]
_P2 = [*_P1, (2, 0), (1, 1), (0, 2)]
_SERENDIPITY = [*_P2, (2, 1), (1, 2)]
_P1_3D = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
_P2_3D = [*_P1_3D, (2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 1, 0), (0, 1, 1), (1, 0, 1)]
_WEDGE_2 = [(i, j, k) for i, j in _P2 for k in (0, 1)] + [(i, j, 2) for i, j in _P1]
_BRICK = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
_BRICK_2 = [
    *_BRICK,
    *((2, j, k) for j in (0, 1) for k in (0, 1)),
    *((i, 2, k) for i in (0, 1) for k in (0, 1)),
    *((i, j, 2) for i in (0, 1) for j in (0, 1)),
]
_TETRA = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
_TETRA_2 = [
    *_lift(_TRIANGLE_2, 0.0), (0.0, 0.0, 0.5), (0.5, 0.0, 0.5), (0.0, 0.5, 0.5), (0.0, 0.0, 1.0)
]  # fmt: skip


# on the base the 8 functions of QUA8, on the other faces quadratic (Bedrosian, Int. J. Numer.
# Methods Eng. 35, 1992)
_PYRAMID_2 = [
    *_lift(_SQUARE_2, 0.0), *_lift([(x / 2, y / 2) for x, y in _SQUARE], 0.5), (0.0, 0.0, 1.0)
]  # fmt: skip


def _cell(
    shape: str,
    nodes: list[tuple[float, ...]],
    exponents: list[tuple[int, ...]],
    over: tuple[tuple[int, ...], ...] = (),
) -> ReferenceCell:
    places, powers = np.array(nodes, float), np.array(exponents, np.int64)
    return ReferenceCell(shape, places, powers, over=np.array(over, np.int64).reshape(-1, 3))


_Polynomial = dict[tuple[int, ...], int]  # coefficients by the exponents of monomials


def _bubbled(
    cell: ReferenceCell, nodes: list[tuple[float, ...]], bubbles: list[_Polynomial]
) -> ReferenceCell:
    """A cell with further nodes and a function, coefficients of monomials, for each."""
    new = sorted({e for b in bubbles for e in b} - {tuple(e) for e in cell.exponents.tolist()})
    exponents = [*map(tuple, cell.exponents.tolist()), *new]
    columns = [[float(b.get(e, 0)) for e in exponents] for b in bubbles]
    sums = np.column_stack([np.eye(len(exponents), len(cell.exponents)), *columns])
    places = np.vstack([cell.nodes, np.array(nodes)])
    return ReferenceCell(cell.shape, places, np.array(exponents, np.int64), sums)


REFERENCE_CELLS: dict[str, ReferenceCell] = {
    "POI1": ReferenceCell("point", np.zeros((1, 0)), np.zeros((1, 0), np.int64)),
    "SEG2": _cell("line", [(-1.0,), (1.0,)], [(0,), (1,)]),
    "SEG3": _cell("line", [(-1.0,), (0.0,), (1.0,)], [(0,), (1,), (2,)]),
    "TRI3": _cell("triangle", _TRIANGLE, [*_P1]),
    "TRI6": _cell("triangle", _TRIANGLE_2, [*_P2]),
    "QUA4": _cell("quadrangle", _SQUARE, [*_P1, (1, 1)]),
    "QUA8": _cell("quadrangle", _SQUARE_2, [*_SERENDIPITY]),
    "TET4": _cell("tetrahedron", [*_TETRA], [*_P1_3D]),
    "TE10": _cell("tetrahedron", _TETRA_2, [*_P2_3D]),
    "PRI6": _cell(
        "prism",
        _lift(_TRIANGLE, -1.0) + _lift(_TRIANGLE, 1.0),
        [(i, j, k) for i, j in _P1 for k in (0, 1)],
    ),
    "PR15": _cell(
        "prism",
        _lift(_TRIANGLE_2, -1.0) + _lift(_TRIANGLE, 0.0) + _lift(_TRIANGLE_2, 1.0),
        [*_WEDGE_2],
    ),
    "PYR5": _cell("pyramid", [*_lift(_SQUARE, 0.0), (0.0, 0.0, 1.0)], [*_P1_3D], over=((1, 1, 0),)),
    "PY13": _cell("pyramid", _PYRAMID_2, [*_P2_3D], over=((1, 1, 0), (2, 1, 0), (1, 2, 0))),
    "CUB8": _cell("hexahedron", _lift(_SQUARE, -1.0) + _lift(_SQUARE, 1.0), [*_BRICK]),
    "CU20": _cell(
        "hexahedron",
        _lift(_SQUARE_2, -1.0) + _lift(_SQUARE, 0.0) + _lift(_SQUARE_2, 1.0),
        [*_BRICK_2],
    ),
}


_THIRD = 1.0 / 3.0
_XYZ: _Polynomial = {(1, 1, 1): 1}
_XYW: _Polynomial = {(1, 1, 0): 1, (2, 1, 0): -1, (1, 2, 0): -1, (1, 1, 1): -1}
_YZW: _Polynomial = {(0, 1, 1): 1, (1, 1, 1): -1, (0, 2, 1): -1, (0, 1, 2): -1}
_XZW: _Polynomial = {(1, 0, 1): 1, (2, 0, 1): -1, (1, 1, 1): -1, (1, 0, 2): -1}
_XYZW: _Polynomial = {(1, 1, 1): 1, (2, 1, 1): -1, (1, 2, 1): -1, (1, 1, 2): -1}
_SQUARES = (0, 1, 2)
_WEDGE_BUBBLES: list[_Polynomial] = [{(i, j, 2): 1} for i, j in _P2[3:]]
_WEDGE_BUBBLES += [{(1, 1, k): 1, (2, 1, k): -1, (1, 2, k): -1} for k in _SQUARES]
_BRICK_FACES: list[tuple[float, ...]] = [
    (0.0, 0.0, -1.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0),
    (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0),
]  # fmt: skip
_WEDGE_FACES: list[tuple[float, ...]] = [
    (_THIRD, _THIRD, -1.0), (_THIRD, _THIRD, 1.0),
    (0.5, 0.0, 0.0), (0.5, 0.5, 0.0), (0.0, 0.5, 0.0),
]  # fmt: skip

# complete cells: nodes in the middles of the faces, in the faces' order, and of the cell
REFERENCE_CELLS |= {
    "TRI7": _bubbled(
        REFERENCE_CELLS["TRI6"], [(_THIRD, _THIRD)], [{(1, 1): 1, (2, 1): -1, (1, 2): -1}]
    ),
    "QUA9": _cell(
        "quadrangle", [*_SQUARE_2, (0.0, 0.0)], [(i, j) for i in _SQUARES for j in _SQUARES]
    ),
    "TE15": _bubbled(
        REFERENCE_CELLS["TE10"],
        [
            (_THIRD, _THIRD, 0.0), (_THIRD, 0.0, _THIRD),
            (_THIRD, _THIRD, _THIRD), (0.0, _THIRD, _THIRD), (0.25, 0.25, 0.25),
        ],
        [_XYW, _XZW, _XYZ, _YZW, _XYZW],
    ),
    "PR21": _bubbled(
        REFERENCE_CELLS["PR15"],
        [*_WEDGE_FACES, (_THIRD, _THIRD, 0.0)],
        _WEDGE_BUBBLES,
    ),
    "CU27": _cell(
        "hexahedron",
        [*map(tuple, REFERENCE_CELLS["CU20"].nodes.tolist()), *_BRICK_FACES, (0.0, 0.0, 0.0)],
        [(i, j, k) for i in _SQUARES for j in _SQUARES for k in _SQUARES],
    ),
}  # fmt: skip

REFERENCE_CELLS |= {
    # Wachspress' functions are no polynomials: polygons have no exponents
    name: ReferenceCell(f"polygon{n}", polygons.regular_polygon(n), np.zeros((0, 2), np.int64))
    for name, n in polygons.SIDES.items()
}


def _monomials(cell: ReferenceCell, points: FloatArray) -> FloatArray:
    """Values (n_points, n_functions) of the spanning functions."""
    values = _powers(points, cell.exponents)
    if cell.sums is not None:
        return values @ cell.sums
    if not len(cell.over):
        return values
    return np.column_stack([values, _powers(points, cell.over) / _below_apex(points)])


def reference_cell(cell_type: str) -> ReferenceCell:
    """The reference cell of a type.

    Raises
    ------
    MeshError
        For cells without shape functions: joints, PY19.
    """
    found = REFERENCE_CELLS.get(cell_type)
    if found is None:
        raise MeshError("kernel.elements.no-shape-functions", cell_type=cell_type)
    return found


def _powers(points: FloatArray, exponents: IntArray) -> FloatArray:
    """Monomials (n_points, n_monomials)."""
    return (points[:, None, :] ** exponents[None]).prod(axis=2)


def _power_gradients(points: FloatArray, exponents: IntArray) -> FloatArray:
    """Derivatives (n_points, n_monomials, dim) of monomials."""
    columns = []
    for axis in range(exponents.shape[1]):
        lowered = exponents.copy()
        lowered[:, axis] = np.maximum(lowered[:, axis] - 1, 0)
        columns.append(exponents[:, axis] * _powers(points, lowered))
    return np.stack(columns, axis=2) if columns else np.zeros((len(points), 1, 0))


def _below_apex(points: FloatArray) -> FloatArray:
    """1 - z (n_points, 1); 1 at the apex, where x and y are 0."""
    depth = 1 - points[:, 2]
    return np.where(np.abs(depth) < 1e-12, 1.0, depth)[:, None]


def _monomial_gradients(cell: ReferenceCell, points: FloatArray) -> FloatArray:
    """Derivatives (n_points, n_functions, dim) of the spanning functions."""
    gradients = _power_gradients(points, cell.exponents)
    if cell.sums is not None:
        return np.einsum("pmd,mf->pfd", gradients, cell.sums)
    if not len(cell.over):
        return gradients
    depth = _below_apex(points)
    divided = _power_gradients(points, cell.over) / depth[..., None]
    divided[..., 2] += _powers(points, cell.over) / depth**2
    return np.concatenate([gradients, divided], axis=1)


@cache
def _coefficients(cell_type: str) -> FloatArray:
    """Coefficients (n_functions, n_nodes) of the shape functions."""
    cell = REFERENCE_CELLS[cell_type]
    inverse = np.linalg.inv(_monomials(cell, cell.nodes)).astype(np.float64)
    return np.where(np.abs(inverse) < 1e-13, 0.0, inverse)


def shape_functions(cell_type: str, points: FloatArray) -> FloatArray:
    """Shape functions at reference points.

    Parameters
    ----------
    cell_type : str
        A key of `REFERENCE_CELLS`.
    points : array (n_points, dim)

    Returns
    -------
    array (n_points, n_nodes)
    """
    if cell_type in polygons.SIDES:
        return polygons.polygon_functions(polygons.SIDES[cell_type], points)
    return _monomials(REFERENCE_CELLS[cell_type], points) @ _coefficients(cell_type)


def shape_gradients(cell_type: str, points: FloatArray) -> FloatArray:
    """Derivatives of the shape functions by the reference coordinates.

    Returns
    -------
    array (n_points, n_nodes, dim)
    """
    if cell_type in polygons.SIDES:
        return polygons.polygon_gradients(polygons.SIDES[cell_type], points)
    gradients = _monomial_gradients(REFERENCE_CELLS[cell_type], points)
    return np.einsum("pfd,fn->pnd", gradients, _coefficients(cell_type))
