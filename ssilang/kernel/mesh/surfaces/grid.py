"""Grids of quadrangles on four sides (transfinite interpolation)."""

from collections.abc import Sequence
from itertools import permutations, product

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.lines import line_chain
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.orientation import reversed_line
from ssilang.kernel.mesh.surfaces.charts import Chart


def sides_in_order(sides: Sequence[Mesh]) -> tuple[Mesh, Mesh, Mesh, Mesh]:
    """Four lines, turned and put in order until each starts where the one before ends, or refused.

    The first line keeps its sense, and the others their order, unless only others fit.
    """
    firsts = sides[0], reversed_line(sides[0])
    for others, first in product(permutations(sides[1:]), firsts):
        made = [first]
        for line in others:
            end = line_chain(made[-1])[-1]
            chain = line_chain(line)
            if chain[0] == end:
                made.append(line)
            elif chain[-1] == end:
                made.append(reversed_line(line))
            else:
                break
        if len(made) == 4 and line_chain(made[3])[-1] == line_chain(made[0])[0]:
            return made[0], made[1], made[2], made[3]
    raise MeshError("kernel.mesh.four-sides-not-form")


def matching_sides(sides: Sequence[Mesh]) -> bool:
    """Whether opposite sides have the same number of cells."""
    return all(sides[k].n_cells == sides[k + 2].n_cells for k in (0, 1))


def grid_surface(
    sides: Sequence[Mesh], chart: Chart | None, colour: int = 0, *, rings: bool = False
) -> Mesh:
    """A grid of QUA4 (sides of SEG2) or QUA8 (SEG3) on four sides in order.

    Parameters
    ----------
    sides : four lines
        As `sides_in_order` gives them; opposite ones with the same number of cells.
    chart : Chart or None
        Surface on which the inner nodes are put; None interpolates in space.
    rings : bool
        Number the inner nodes of QUA4 ring after ring from the sides inwards, as one who fills a
        contour makes them, and not row after row.
    """
    kinds = {s.single_block().cell_type for s in sides}
    if len(kinds) > 1:
        raise MeshError("kernel.mesh.four-sides-must-same")
    step = 2 if "SEG3" in kinds else 1
    nodes = sides[0].nodes
    bottom, right, top, left = (line_chain(s) for s in sides)
    top, left = top[::-1], left[::-1]
    n, m = len(bottom), len(right)
    ids = np.full((m, n), -1, dtype=np.int64)
    ids[0], ids[-1], ids[:, 0], ids[:, -1] = bottom, top, left, right
    rim = [nodes.coordinates[c].copy() for c in (bottom, right, top, left)]
    if chart is not None:
        rim = [chart.flatten(x) for x in rim]
    inside = _transfinite(*rim)
    wanted = ids < 0
    if step == 2:  # sides inside are straight
        wanted[1::2, 1::2] = False
        inside[2:-2:2, 1::2] = 0.5 * (inside[2:-2:2, :-1:2] + inside[2:-2:2, 2::2])
        inside[1::2, 2:-2:2] = 0.5 * (inside[:-1:2, 2:-2:2] + inside[2::2, 2:-2:2])
    i, j = np.nonzero(wanted)
    if rings and step == 1:
        order = _ring_order(i, j, m, n)
        i, j = i[order], j[order]
    positions = inside[i, j]
    density = _sizes(nodes.density, bottom, right, top, left)[i, j]
    ids[i, j] = nodes.add(positions if chart is None else chart.lift(positions), density)
    return Mesh.of(
        nodes, "QUA8" if step == 2 else "QUA4", grid_cells(ids, step), colour, tuple(sides)
    )


def _ring_order(i: IntArray, j: IntArray, m: int, n: int) -> IntArray:
    """Order of nodes of a grid (m, n) by their distance from the sides, round from the first."""
    ring = np.minimum(np.minimum(i, m - 1 - i), np.minimum(j, n - 1 - j))
    up, along = i - ring, j - ring
    width, height = n - 1 - 2 * ring, m - 1 - 2 * ring
    forth = (up == 0) | (along == width)
    return np.lexsort((np.where(forth, along + up, 2 * (width + height) - along - up), ring))


def grid_cells(ids: IntArray, step: int) -> IntArray:
    """Connectivity, row after row, of a grid of node numbers; step 2 leaves QUA8 middles out."""
    a, b = ids[:-1:step, :-1:step], ids[:-1:step, step::step]
    c, d = ids[step::step, step::step], ids[step::step, :-1:step]
    if step == 1:
        return np.stack([a, b, c, d], axis=-1).reshape(-1, 4)
    low, high = ids[:-1:2, 1::2], ids[2::2, 1::2]
    west, east = ids[1::2, :-1:2], ids[1::2, 2::2]
    return np.stack([a, low, b, east, c, high, d, west], axis=-1).reshape(-1, 8)


def _along(line: FloatArray) -> FloatArray:
    """Fractions of the length at the nodes (m, d) of a line."""
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    if length[-1] == 0.0:
        raise MeshError("kernel.mesh.side-surface-no-length")
    return length / length[-1]


def _transfinite(
    bottom: FloatArray, right: FloatArray, top: FloatArray, left: FloatArray
) -> FloatArray:
    """Positions (m, n, d) inside four lines; bottom and top (n, d), left and right (m, d)."""
    ub, ut, vl, vr = (_along(x) for x in (bottom, top, left, right))
    du, dv = (ut - ub)[None, :], (vr - vl)[:, None]
    u = (ub[None, :] + vl[:, None] * du) / (1.0 - du * dv)
    v = vl[:, None] + u * dv
    u, v = u[..., None], v[..., None]
    across = (1 - v) * bottom[None] + v * top[None] + (1 - u) * left[:, None] + u * right[:, None]
    corners = (1 - v) * ((1 - u) * bottom[0] + u * bottom[-1])
    corners = corners + v * ((1 - u) * top[0] + u * top[-1])
    return across - corners


def _sizes(
    density: FloatArray, bottom: IntArray, right: IntArray, top: IntArray, left: IntArray
) -> FloatArray:
    """Mesh sizes (m, n): mean of the two linear interpolations between opposite sides."""
    u = np.linspace(0.0, 1.0, len(bottom))[None, :]
    v = np.linspace(0.0, 1.0, len(right))[:, None]
    upright = (1 - v) * density[bottom][None] + v * density[top][None]
    flat = (1 - u) * density[left][:, None] + u * density[right][:, None]
    return 0.5 * (upright + flat)
