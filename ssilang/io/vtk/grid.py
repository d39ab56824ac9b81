"""Meshes and fields as the arrays that an unstructured VTK grid holds."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssilang.io.errors import OutputError
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.cells import POLYGON_SIDES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.remembered import tables_of


@dataclass(frozen=True)
class DataArray:
    """One named array: values (n,) or (n, k), and the names of its k columns if known."""

    values: NDArray[np.generic]
    columns: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Grid:
    """An unstructured grid in VTK's numbering."""

    nodes: IntArray  # (n,) node numbers of the rows of `points`, increasing
    points: FloatArray  # (n, 3)
    connectivity: IntArray  # rows of `points` of all cells, one after the other, in VTK's order
    offsets: IntArray  # (n_cells,) end of each cell in `connectivity`
    types: NDArray[np.uint8]  # (n_cells,) of uint8
    point_data: dict[str, DataArray] = field(default_factory=dict)
    cell_data: dict[str, DataArray] = field(default_factory=dict)


@dataclass(frozen=True)
class _Family:
    """Components that belong to one array: label, components by column."""

    label: str
    columns: Sequence[str]
    key: str = ""  # component that must be there


_TABLES = tables_of(Path(__file__).with_suffix(".toml"))
_VECTORS, _AXIAL, _TENSORS, _LOCAL = (
    [_Family(**row) for row in _TABLES[name]] for name in ("vectors", "axial", "tensors", "local")
)
ORDERS: dict[str, tuple[int, tuple[int, ...]]] = {
    **{name: (number, tuple(order)) for name, (number, order) in _TABLES["orders"].items()},
    **{name: (7, tuple(range(n))) for name, n in POLYGON_SIDES.items()},
}
"""VTK's number of each cell type, and its local nodes in VTK's order."""

# one component of these is shown as a number, under its own name
_NEVER_ALONE = ("rotation", "moment", "section_force", "section_moment")


def grid_of(
    mesh: Mesh,
    point_fields: Mapping[str, NodeField] | None = None,
    cell_fields: Mapping[str, CellField] | None = None,
) -> Grid:
    """The grid of a mesh with its fields.

    Parameters
    ----------
    point_fields, cell_fields : mapping of str to field
        Name under which a field appears; '' takes the name from its components
        ('displacement', 'stress', 'TEMP' ...). Values in several points of a cell are averaged.

    Raises
    ------
    OutputError
        For a cell type that VTK has no cell for.
    """
    return with_fields(bare_grid(mesh), mesh, point_fields, cell_fields)


def bare_grid(mesh: Mesh) -> Grid:
    """The grid of a mesh without fields.

    Raises
    ------
    OutputError
        For a cell type that VTK has no cell for.
    """
    nodes = mesh.sorted_node_ids
    rows, types, sizes = [], [], []
    for block in mesh.blocks:
        if block.cell_type not in ORDERS:
            raise OutputError("io.cells-no-vtk-counterpart", cell_type=block.cell_type)
        number, order = ORDERS[block.cell_type]
        rows.append(np.searchsorted(nodes, block.connectivity[:, list(order)]).ravel())
        types.append(np.full(len(block), number, dtype=np.uint8))
        sizes.append(np.full(len(block), len(order), dtype=np.int64))
    empty = np.empty(0, dtype=np.int64)
    return Grid(
        nodes,
        mesh.nodes.coordinates[nodes],
        np.concatenate([empty, *rows]),
        np.cumsum(np.concatenate([empty, *sizes])),
        np.concatenate([np.empty(0, dtype=np.uint8), *types]),
    )


def with_fields(
    bare: Grid,
    mesh: Mesh,
    point_fields: Mapping[str, NodeField] | None = None,
    cell_fields: Mapping[str, CellField] | None = None,
) -> Grid:
    """The grid of a mesh where its nodes are now, with these fields: see `grid_of`."""
    points: dict[str, DataArray] = {}
    cells: dict[str, DataArray] = {}
    for name, node_field in (point_fields or {}).items():
        points |= point_arrays(node_field, bare.nodes, name)
    for name, cell_field in (cell_fields or {}).items():
        cells |= cell_arrays(cell_field, mesh, name)
    here = mesh.nodes.coordinates[bare.nodes]
    return replace(bare, points=here, point_data=points, cell_data=cells)


def point_arrays(chpoint: NodeField, nodes: IntArray, name: str = "") -> dict[str, DataArray]:
    """The arrays that show a nodal field at `nodes` (n,).

    Translations, rotations, forces ... become 3-vectors (0 where a node has no value), other
    components scalars (NaN where a node has none). With a `name` the first vector, or the only
    component, is called so and the rest `name_label`.
    """

    def column(component: str, absent: float) -> FloatArray:
        return chpoint.values_at(component, nodes, absent)

    axial = "UR" in chpoint.components or "FR" in chpoint.components
    families = (*_AXIAL, *_VECTORS[1:]) if axial else _VECTORS
    # a component without a value here (multipliers LX of conditions) makes no array
    here = (k for k, part in chpoint.components.items() if np.isin(part.nodes, nodes).any())
    return _arrays(tuple(here), families, column, name)


def cell_arrays(mchaml: CellField, mesh: Mesh, name: str = "") -> dict[str, DataArray]:
    """The arrays that show a field in cells over the cells of `mesh`, NaN in cells without one.

    Components that are objects (curves, points) are left out.
    """
    values = cell_means(mchaml, mesh)
    nothing = np.isnan(np.array(list(values.values()) or [np.empty(0)])).all(axis=0)

    def column(component: str, absent: float) -> FloatArray:
        found = values.get(component)
        return np.where(nothing, np.nan, absent) if found is None else found

    return _arrays(tuple(values), (*_TENSORS, *_LOCAL), column, name)


def cell_means(mchaml: CellField, mesh: Mesh) -> dict[str, FloatArray]:
    """Mean of each component in each cell of `mesh`: component to (n_cells,), NaN if absent."""
    means: dict[str, FloatArray] = {}
    start = 0
    for block in mesh.blocks:
        for part in mchaml.blocks:
            place = matching_cells(block, part.cells)
            found = place >= 0
            if not found.any():
                continue
            for component, values in _numeric(part):
                row = means.setdefault(component, np.full(mesh.n_cells, np.nan))
                row[start : start + len(block)][found] = values.mean(axis=1)[place[found]]
        start += len(block)
    return means


def _numeric(part: CellFieldBlock) -> Iterable[tuple[str, FloatArray]]:
    for component, values in part.components.items():
        if values.dtype != object:
            yield (
                component,
                np.broadcast_to(values, (len(part.cells), values.shape[-1])).astype(float),
            )


def matching_cells(block: CellBlock, other: CellBlock) -> IntArray:
    """Row of `other` that holds the same cell, for each cell of `block` (n,); -1 if none."""
    if block is other or block.raw is other.raw:
        return np.arange(len(block), dtype=np.int64)
    if block.cell_type != other.cell_type or len(other) == 0:
        return np.full(len(block), -1, dtype=np.int64)
    return matching_rows(block.connectivity, other.connectivity)


def matching_rows(wanted: IntArray, held: IntArray) -> IntArray:
    """Row of `held` (m, k) on the same nodes, in any order, for each of `wanted` (n, k); or -1."""
    wanted, held = np.sort(wanted, axis=1), np.sort(held, axis=1)
    factors = np.random.default_rng(0).integers(1, 1 << 63, held.shape[1], dtype=np.uint64)
    # a number for each row: equal rows have equal ones
    own, keys = (
        (t.astype(np.uint64) * (factors | np.uint64(1))).sum(axis=1) for t in (wanted, held)
    )
    order = np.argsort(keys, kind="stable")
    rows = order[np.minimum(np.searchsorted(keys[order], own), len(keys) - 1)]
    return np.where((held[rows] == wanted).all(axis=1), rows, -1)


def _arrays(
    components: tuple[str, ...],
    families: Sequence[_Family],
    column: object,
    name: str,
) -> dict[str, DataArray]:
    assert callable(column)
    left = list(components)
    found: list[tuple[str, DataArray]] = []
    for family in families:
        held = [c for c in family.columns if c in left]
        lonely = len(held) == 1 and family.label in _NEVER_ALONE
        if not held or lonely or (family.key and family.key not in held):
            continue
        stacked = np.column_stack([column(c, 0.0) for c in family.columns])
        found.append((family.label, DataArray(stacked, tuple(family.columns))))
        left = [c for c in left if c not in held]
    found += [(c, DataArray(column(c, np.nan))) for c in left]
    if not name:
        return dict(found)
    bare = len(found) == 1 or (found and found[0][1].columns)
    return {
        name if bare and i == 0 else f"{name}_{label}": array
        for i, (label, array) in enumerate(found)
    }
