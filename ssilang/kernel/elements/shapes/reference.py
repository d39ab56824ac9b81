"""Reference cells: node positions and shape functions, as data.

A cell's shape functions span a list of monomials; their coefficients are the inverse of the
Vandermonde matrix of the nodes. One function then serves every cell type. The pyramid adds one
rational function to its monomials (x y / (1 - z)).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.elements.shapes.polygons import (
    SIDES,
    polygon_functions,
    polygon_gradients,
    regular_polygon,
)


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
    rational : bool
        True if x y / (1 - z) completes the monomials.
    """

    shape: str
    nodes: FloatArray
    exponents: IntArray
    rational: bool = False


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


def _cell(
    shape: str,
    nodes: list[tuple[float, ...]],
    exponents: list[tuple[int, ...]],
    rational: bool = False,
) -> ReferenceCell:
    return ReferenceCell(shape, np.array(nodes, float), np.array(exponents, np.int64), rational)


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
    "PYR5": _cell("pyramid", [*_lift(_SQUARE, 0.0), (0.0, 0.0, 1.0)], [*_P1_3D], rational=True),
    "CUB8": _cell("hexahedron", _lift(_SQUARE, -1.0) + _lift(_SQUARE, 1.0), [*_BRICK]),
    "CU20": _cell(
        "hexahedron",
        _lift(_SQUARE_2, -1.0) + _lift(_SQUARE, 0.0) + _lift(_SQUARE_2, 1.0),
        [*_BRICK_2],
    ),
}


REFERENCE_CELLS |= {
    # Wachspress' functions are no polynomials: polygons have no exponents
    name: ReferenceCell(f"polygon{n}", regular_polygon(n), np.zeros((0, 2), np.int64))
    for name, n in SIDES.items()
}


def _monomials(cell: ReferenceCell, points: FloatArray) -> FloatArray:
    """Values (n_points, n_functions) of the spanning functions."""
    powers = points[:, None, :] ** cell.exponents[None]
    values: FloatArray = powers.prod(axis=2)
    if not cell.rational:
        return values
    x, y, z = points.T
    gap = np.where(np.abs(1 - z) < 1e-12, 1.0, 1 - z)
    return np.column_stack([values, x * y / gap])


def _monomial_gradients(cell: ReferenceCell, points: FloatArray) -> FloatArray:
    """Derivatives (n_points, n_functions, dim) of the spanning functions."""
    dim = cell.nodes.shape[1]
    columns = []
    for axis in range(dim):
        lowered = cell.exponents.copy()
        lowered[:, axis] = np.maximum(lowered[:, axis] - 1, 0)
        powers = (points[:, None, :] ** lowered[None]).prod(axis=2)
        columns.append(cell.exponents[:, axis] * powers)
    gradients: FloatArray = np.stack(columns, axis=2) if dim else np.zeros((len(points), 1, 0))
    if not cell.rational:
        return gradients
    x, y, z = points.T
    gap = np.where(np.abs(1 - z) < 1e-12, 1.0, 1 - z)
    extra = np.stack([y / gap, x / gap, x * y / gap**2], axis=1)
    return np.concatenate([gradients, extra[:, None, :]], axis=1)


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
    if cell_type in SIDES:
        return polygon_functions(SIDES[cell_type], points)
    return _monomials(REFERENCE_CELLS[cell_type], points) @ _coefficients(cell_type)


def shape_gradients(cell_type: str, points: FloatArray) -> FloatArray:
    """Derivatives of the shape functions by the reference coordinates.

    Returns
    -------
    array (n_points, n_nodes, dim)
    """
    if cell_type in SIDES:
        return polygon_gradients(SIDES[cell_type], points)
    gradients = _monomial_gradients(REFERENCE_CELLS[cell_type], points)
    out: FloatArray = np.einsum("pfd,fn->pnd", gradients, _coefficients(cell_type))
    return out
