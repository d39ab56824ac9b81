"""Meshes and fields as the arrays that an unstructured VTK grid holds."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ssilang.io.errors import OutputError
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.cells import POLYGON_SIDES
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


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
    """Components that belong to one array: label, components by column, value where absent."""

    label: str
    columns: tuple[str, ...]
    absent: float
    key: str = ""  # component that must be there


# 3-vectors: nodes without the component stay in place (0), so that a warped shape is whole
_VECTORS = (
    _Family("displacement", ("UX", "UY", "UZ"), 0.0),
    _Family("rotation", ("RX", "RY", "RZ"), 0.0),
    _Family("force", ("FX", "FY", "FZ"), 0.0),
    _Family("moment", ("MX", "MY", "MZ"), 0.0),
    _Family("velocity", ("VX", "VY", "VZ"), 0.0),
    _Family("acceleration", ("AX", "AY", "AZ"), 0.0),
)
# axisymmetric names: r and z are the first two coordinates
_AXIAL = (
    _Family("displacement", ("UR", "UZ", "UT"), 0.0),
    _Family("force", ("FR", "FZ", "FT"), 0.0),
)
# symmetric tensors in ParaView's order XX YY ZZ XY YZ XZ
_TENSORS = (
    _Family("stress", ("SMXX", "SMYY", "SMZZ", "SMXY", "SMYZ", "SMXZ"), 0.0),
    _Family("stress", ("SMRR", "SMZZ", "SMTT", "SMRZ", "SMZT", "SMRT"), 0.0),
    _Family("strain", ("EPXX", "EPYY", "EPZZ", "GAXY", "GAYZ", "GAXZ"), 0.0),
    _Family("strain", ("EPRR", "EPZZ", "EPTT", "GARZ", "GAZT", "GART"), 0.0),
)
# joints and bars, in their own axes: normal (or axial) first, then the tangents
_LOCAL = (
    _Family("traction", ("SMN", "SMSN", "SMS2"), 0.0, "SMSN"),
    _Family("traction", ("SMN", "SMS1", "SMS2"), 0.0, "SMS1"),
    _Family("opening", ("DRN", "DRSN", "DRS2"), 0.0, "DRSN"),
    _Family("opening", ("DRN", "DRS1", "DRS2"), 0.0, "DRS1"),
    _Family("opening", ("EXX", "GXY", "GXZ"), 0.0, "EXX"),  # of two points
    _Family("section_force", ("EFFX", "EFFY", "EFFZ"), 0.0),
    _Family("section_moment", ("MOMX", "MOMY", "MOMZ"), 0.0),
)
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
    families: tuple[_Family, ...],
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
        stacked = np.column_stack([column(c, family.absent) for c in family.columns])
        found.append((family.label, DataArray(stacked, family.columns)))
        left = [c for c in left if c not in held]
    found += [(c, DataArray(column(c, np.nan))) for c in left]
    if not name:
        return dict(found)
    bare = len(found) == 1 or (found and found[0][1].columns)
    return {
        name if bare and i == 0 else f"{name}_{label}": array
        for i, (label, array) in enumerate(found)
    }


# VTK's cell numbers and node orders for Cast3M's cell types.
#
# `ORDERS[name]` is (VTK cell type, local nodes in VTK's order). VTK lists corners first, then
# middles; Cast3M walks along the contour. Joints become the flat cell between their two faces: it
# has no thickness as long as the joint is closed and opens with the displacement in ParaView's
# "Warp By Vector". The sixteen-node joint has no VTK cell of its own: its corners are written.
#
# Source: the VTK file formats and `vtkCellType.h` (numbers 1 to 31).

VtkOrder = tuple[int, tuple[int, ...]]

ORDERS: dict[str, VtkOrder] = {
    "POI1": (1, (0,)),
    "SEG2": (3, (0, 1)),
    "SEG3": (21, (0, 2, 1)),
    "TRI3": (5, (0, 1, 2)),
    "TRI6": (22, (0, 2, 4, 1, 3, 5)),
    "TRI7": (34, (0, 2, 4, 1, 3, 5, 6)),
    "QUA4": (9, (0, 1, 2, 3)),
    "QUA8": (23, (0, 2, 4, 6, 1, 3, 5, 7)),
    "QUA9": (28, (0, 2, 4, 6, 1, 3, 5, 7, 8)),
    **{name: (7, tuple(range(n))) for name, n in POLYGON_SIDES.items()},
    "TET4": (10, (0, 1, 2, 3)),
    "TE10": (24, (0, 2, 4, 9, 1, 3, 5, 6, 7, 8)),
    "PRI6": (13, (0, 1, 2, 3, 4, 5)),
    "PR15": (26, (0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8)),
    "PYR5": (14, (0, 1, 2, 3, 4)),
    "PY13": (27, (0, 2, 4, 6, 12, 1, 3, 5, 7, 8, 9, 10, 11)),
    "CUB8": (12, (0, 1, 2, 3, 4, 5, 6, 7)),
    "CU20": (25, (0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11)),
    # complete cells without VTK counterpart, or with other inner nodes, are written without them
    "TE15": (24, (0, 2, 4, 9, 1, 3, 5, 6, 7, 8)),
    "PY19": (27, (0, 2, 4, 6, 12, 1, 3, 5, 7, 8, 9, 10, 11)),
    "PR21": (26, (0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8)),
    "CU27": (25, (0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11)),
    "RAC2": (9, (0, 1, 3, 2)),
    "RAC3": (30, (0, 2, 5, 3, 1, 4)),
    "LIA3": (13, (0, 1, 2, 3, 4, 5)),
    "LIA4": (12, (0, 1, 2, 3, 4, 5, 6, 7)),
    "LIA6": (31, (0, 2, 4, 6, 8, 10, 1, 3, 5, 7, 9, 11)),
    "LIA8": (12, (0, 2, 4, 6, 8, 10, 12, 14)),
}
