"""Meshes cut by a plane: what lies behind it (COUP), what it crosses (SECT)."""

import numpy as np

from ssilang.io.plots.patches import Faces
from ssilang.io.plots.values import values_on
from ssilang.io.plots.view import Plane, View
from ssilang.io.vtk.grid import bare_grid
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.combine import take
from ssilang.kernel.mesh.mesh import Mesh


def behind(mesh: Mesh, plane: Plane, view: View, positions: FloatArray) -> Mesh:
    """Cells whose middle lies behind the plane, seen from the eye.

    `positions` (all nodes of the table, 3) says where the nodes are drawn.
    """
    side = np.sign(plane.normal @ view.axes[2]) or 1.0
    return take(mesh, lambda b: side * plane.height(positions[b.connectivity].mean(axis=1)) <= 0)


def section_of(
    mesh: Mesh, plane: Plane, positions: FloatArray, values: FloatArray | None, dimension: int = 3
) -> tuple[FloatArray, FloatArray | None, IntArray]:
    """Triangles in which a plane cuts the volumes of a mesh, or segments of its surfaces.

    Parameters
    ----------
    values : array (n_table,), optional
        Values at the nodes.
    dimension : 3 or 2
        Of the cells that are cut.

    Returns
    -------
    points : array (m, dimension, 3)
    values : array (m, dimension) or None
    colours : array (m,)
        Colour index of the cell that is cut.
    """
    import pyvista

    blocks = [b for b in mesh.blocks if b.kind.dimension == dimension and not b.kind.joint]
    nothing = None if values is None else np.empty((0, dimension))
    if not blocks:
        return np.empty((0, dimension, 3)), nothing, np.empty(0, int)
    grid = bare_grid(Mesh(mesh.nodes, tuple(blocks)))
    counts = np.diff(grid.offsets, prepend=0)
    cells = np.insert(grid.connectivity, grid.offsets - counts, counts)
    whole = pyvista.UnstructuredGrid(cells, grid.types, positions[grid.nodes])
    whole.cell_data["colour"] = np.concatenate([b.colours for b in blocks])
    if values is not None:
        whole.point_data["value"] = values[grid.nodes]
    cut = whole.slice(normal=plane.normal, origin=plane.origin, generate_triangles=True)
    if not cut.n_cells:
        return np.empty((0, dimension, 3)), nothing, np.empty(0, int)
    flat = cut.faces if dimension == 3 else cut.lines
    corners = flat.reshape(-1, dimension + 1)[:, 1:]
    found = None if values is None else np.asarray(cut.point_data["value"])[corners]
    return np.asarray(cut.points)[corners], found, np.asarray(cut.cell_data["colour"], dtype=int)


def nodal_means(
    faces: list[Faces], field: NodeField | CellField, component: str, size: int
) -> FloatArray:
    """Values of a field at all nodes of a table (size,): means over the cells, NaN elsewhere."""
    if isinstance(field, NodeField):
        return field.values_at(component, np.arange(size), np.nan)
    total, count = np.zeros(size), np.zeros(size)
    for f in faces:
        values = values_on(f, field, component)
        known = np.isfinite(values)
        np.add.at(total, f.nodes[known], values[known])
        np.add.at(count, f.nodes[known], 1.0)
    return np.where(count > 0, total / np.maximum(count, 1.0), np.nan)
