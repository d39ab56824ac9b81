"""Surfaces `P(u, v) = sum P_ij u^i v^j` meshed over a rectangle of their parameters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.curves import Polynomial
from ssilang.kernel.mesh.lines.lines import chain_mesh
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.surfaces.grid import grid_cells


@dataclass(frozen=True, slots=True)
class PolynomialSurface:
    """A parametrised polynomial surface.

    Attributes
    ----------
    coefficients : array (n_rows, n_columns, 3)
        Row j, column i: the coefficient of `u**i v**j`.
    u, v : (float, float)
        Limits of the parameters.
    """

    coefficients: FloatArray
    u: tuple[float, float] = (0.0, 1.0)
    v: tuple[float, float] = (0.0, 1.0)

    def at(self, u: FloatArray, v: FloatArray) -> FloatArray:
        """Positions (..., 3) at parameters of the same shape."""
        rows, columns = self.coefficients.shape[:2]
        powers_u = u[..., None] ** np.arange(columns)
        powers_v = v[..., None] ** np.arange(rows)
        position: FloatArray = np.einsum(
            "...j,...i,jik->...k", powers_v, powers_u, self.coefficients
        )
        return position

    def along_u(self, v: float, regular: bool) -> Polynomial:
        """The curve of constant v."""
        table = np.tensordot(v ** np.arange(len(self.coefficients)), self.coefficients, 1)
        return Polynomial(table, *self.u, regular=regular)

    def along_v(self, u: float, regular: bool) -> Polynomial:
        """The curve of constant u."""
        powers = u ** np.arange(self.coefficients.shape[1])
        return Polynomial(
            np.einsum("i,jik->jk", powers, self.coefficients), *self.v, regular=regular
        )


def mesh_polynomial_surface(
    nodes: NodeTable,
    surface: PolynomialSurface,
    size: float,
    cell_type: str = "QUA4",
    regular: bool = False,
    colour: int = 0,
) -> Mesh:
    """A grid of QUA4, QUA8, TRI3 or TRI6 on a polynomial surface; its sides are kept.

    Parameters
    ----------
    size : float
        Wanted length of the cells along the sides, which says how many there are.
    regular : bool
        True: nodes evenly spaced in space along the sides; False: in the parameters.

    Raises
    ------
    MeshError
        If the size is not positive, or a side has no length.
    """
    if size <= 0.0:
        raise MeshError("kernel.mesh.mesh-size-not-set")
    quadratic = cell_type in ("QUA8", "TRI6")
    flat = [surface.along_u(v, regular) for v in surface.v]
    upright = [surface.along_v(u, regular) for u in surface.u]
    step = 2 if quadratic else 1
    across, up = (step * _cuts(pair, size) for pair in (flat, upright))
    s, t = np.meshgrid(np.linspace(0.0, 1.0, across + 1), np.linspace(0.0, 1.0, up + 1))
    u = _blended([c.parameter(s[0]) for c in flat], t)
    v = _blended([c.parameter(t[:, 0]) for c in upright], s.T).T
    wanted = np.ones(s.shape, bool)
    if cell_type == "QUA8":
        wanted[1::2, 1::2] = False
    ids = np.full(s.shape, -1, dtype=np.int64)
    ids[wanted] = nodes.add(surface.at(u[wanted], v[wanted]), size)
    sides = (ids[0], ids[:, -1], ids[-1, ::-1], ids[::-1, 0])
    lines = tuple(chain_mesh(nodes, side, quadratic, colour) for side in sides)
    cells = grid_cells(ids, step)
    if cell_type.startswith("TRI"):
        cells = _halved(cells, ids[1::2, 1::2].ravel() if quadratic else None)
    return Mesh.of(nodes, cell_type, cells, colour, lines)


def _halved(cells: IntArray, centres: IntArray | None) -> IntArray:
    """Two triangles a cell (n, 4) or (n, 8); of quadratic ones the centre is on the diagonal."""
    if centres is None:
        pair = cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]
    else:
        whole = np.column_stack([cells, centres])
        pair = whole[:, [0, 1, 2, 3, 4, 8]], whole[:, [0, 8, 4, 5, 6, 7]]
    return np.stack(pair, axis=1).reshape(-1, pair[0].shape[1])


def _cuts(pair: list[Polynomial], size: float) -> int:
    """Number of cells along two opposite sides: that of the longer one."""
    length = max(curve.length for curve in pair)
    if length == 0.0:
        raise MeshError("kernel.mesh.two-opposite-sides-surface")
    return subdivide(length, size, size).count


def _blended(ends: list[FloatArray], across: FloatArray) -> FloatArray:
    """Parameters (m, n) between those on two opposite sides (n,), `across` (m, n) the way."""
    return (1.0 - across) * ends[0] + across * ends[1]
