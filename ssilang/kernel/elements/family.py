"""What every family of elements provides, and what follows from it for all of them.

A family gives its strain operator and its elastic moduli at integration points; stiffness,
strain, stress, internal forces are then the same few lines for all. Arrays are
(n_cells, n_strains, n_points, ...): one strain component is a contiguous (n_cells, n_points).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import ZoneField, n_points
from ssilang.kernel.fields.cell_field import CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, dual_of
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable


@dataclass(frozen=True, eq=False)
class Layout:
    """Rows of a zone's element vectors: row i is `unknowns[i]` at local node `local[i]`."""

    table: NodeTable
    raw_nodes: IntArray
    local: NDArray[np.int64]
    unknowns: tuple[str, ...]

    @property
    def duals(self) -> tuple[str, ...]:
        """Dual names of the rows."""
        return tuple(dual_of(u) for u in self.unknowns)

    def gather(self, field: NodeField) -> FloatArray:
        """Element vectors (n_cells, n_rows) of a nodal field; absent values count as zero."""
        nodes = self.table.resolve(self.raw_nodes)
        out = np.zeros((len(nodes), len(self.unknowns)))
        for name in dict.fromkeys(self.unknowns):
            columns = [i for i, u in enumerate(self.unknowns) if u == name]
            out[:, columns] = field.values_at(name, nodes[:, self.local[columns]])
        return out

    def scatter(self, vectors: FloatArray) -> NodeField:
        """Sum of element vectors (n_cells, n_rows) at nodes, as forces (duals, DISCRET)."""
        nodes = self.table.resolve(self.raw_nodes)
        components: dict[str, NodeValues] = {}
        duals = self.duals
        for name in dict.fromkeys(duals):
            columns = [i for i, u in enumerate(duals) if u == name]
            at = nodes[:, self.local[columns]]
            components[name] = NodeValues.summed(at, vectors[:, columns])
        return NodeField(self.table, components, "DISCRET")


@dataclass(frozen=True, eq=False)
class StrainOperator:
    """Strain operator of some cells of a zone.

    Attributes
    ----------
    matrix : array (n_cells, n_strains, n_points, n_rows)
        strain[c, s, p] = sum_m matrix[c, s, p, m] u[c, m].
    weights : array (n_cells, n_points)
        Integration weights: volume, times thickness or circumference where that applies.
    forces : array as `matrix`, or None
        The operator that stresses have forces by, where it is another.
    """

    matrix: FloatArray
    weights: FloatArray
    forces: FloatArray | None = None


class ElementFamily(ABC):
    """Behaviour shared by the elements of one family.

    Attributes
    ----------
    strains, stresses : tuple of str
        Names of the components, in the order of the strain operator's rows.
    """

    strains: ClassVar[tuple[str, ...]] = ()
    stresses: ClassVar[tuple[str, ...]] = ()

    def layout(self, zone: Zone) -> Layout:
        """Rows of the element vectors: translations, node by node."""
        return node_major_layout(zone.cells, NODE_TRANSLATIONS[zone.mode])

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """Components that EPSI gives."""
        return self.strains

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """Components that SIGM gives."""
        return self.stresses

    @abstractmethod
    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Strain operator at the points of a support, for some cells."""

    @abstractmethod
    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Elastic moduli (n_cells or 1, n_points or 1, n_strains, n_strains)."""

    @abstractmethod
    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Consistent mass matrices (n_cells, n_rows, n_rows) and their rows."""

    def whole_matrices(
        self, zone: Zone, parameters: ZoneField, kind: str
    ) -> tuple[FloatArray, Layout] | None:
        """Stiffness ('RIGIDITE') or damping ('AMORTISSEMENT') of elements that have no moduli.

        None: they follow from the strains.
        """
        return None

    def stiffness_values(self, zone: Zone, moduli: FloatArray, parameters: ZoneField) -> FloatArray:
        """Stiffness matrices (n_cells, n_rows, n_rows)."""
        n, m = len(zone.cells), len(self.layout(zone).unknowns)
        values = np.empty((n, m, m))
        for cells in chunks(n):
            operator = self.strain_operator(zone, parameters, "RIGIDITE", cells)
            values[cells] = contract(operator, per_cell(moduli, cells))
        return self.held_about_normals(zone, values, moduli, parameters)

    def held_about_normals(
        self, zone: Zone, values: FloatArray, moduli: FloatArray, parameters: ZoneField
    ) -> FloatArray:
        """Stiffness matrices with a small term about the normals of shells, which they lack."""
        return values

    def strain_values(
        self, zone: Zone, displacement: NodeField, parameters: ZoneField
    ) -> FloatArray:
        """Strains (n_cells, n_strains, n_points) at the points of 'STRESSES'."""
        vectors = self.layout(zone).gather(displacement)
        shape = (len(zone.cells), len(self.strain_names(zone)), n_points(zone.element, "STRESSES"))
        values = np.empty(shape)
        for cells in chunks(len(zone.cells)):
            operator = self.strain_operator(zone, parameters, "STRESSES", cells)
            values[cells] = np.matmul(operator.matrix, vectors[cells][:, None, :, None])[..., 0]
        return values

    def stress_values(
        self, zone: Zone, displacement: NodeField, moduli: FloatArray, parameters: ZoneField
    ) -> FloatArray:
        """Stresses (n_cells, n_stresses, n_points) at the points of 'STRESSES'."""
        return apply_moduli(moduli, self.strain_values(zone, displacement, parameters))

    def force_vectors(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Element vectors (n_cells, n_rows) in balance with a stress field."""
        n = len(zone.cells)
        vectors = np.empty((n, len(self.layout(zone).unknowns)))
        for cells in chunks(n):
            operator = self.strain_operator(zone, parameters, "STRESSES", cells)
            weighted = stress[cells] * operator.weights[:, None, :]
            n_rows = operator.matrix.shape[-1]
            B = operator.matrix.reshape(len(weighted), -1, n_rows)
            vectors[cells] = np.matmul(weighted.reshape(len(weighted), 1, -1), B)[:, 0]
        return vectors

    def weights(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Integration weights (n_cells, n_points) of a support (INTG)."""
        parts = [
            self.strain_operator(zone, parameters, support, cells).weights
            for cells in chunks(len(zone.cells))
        ]
        return np.concatenate(parts) if parts else np.empty((0, 1))

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Geometric stiffness matrices (n_cells, n_rows, n_rows) of a stress field (KSIG)."""
        raise FieldError("kernel.elements.element-no-geometric-stiffness", element=zone.element)


def per_cell(array: FloatArray, cells: slice) -> FloatArray:
    """Rows of some cells, or the single row that serves all."""
    return array if len(array) == 1 else array[cells]


def apply_moduli(moduli: FloatArray, strain: FloatArray) -> FloatArray:
    """Stresses from strains (n_cells, n_strains, n_points), moduli (n or 1, p or 1, s, s)."""
    if moduli.shape[:2] == (1, 1):
        return np.einsum("st,ctp->csp", moduli[0, 0], strain)
    n, _, p = strain.shape
    full = np.broadcast_to(moduli, (n, p, *moduli.shape[2:]))
    return np.einsum("cpst,ctp->csp", full, strain)


def contract(operator: StrainOperator, moduli: FloatArray) -> FloatArray:
    """Sum over points of weight B^T D B, shape (n_cells, n_rows, n_rows)."""
    B = operator.matrix
    dual = B if operator.forces is None else operator.forces
    n, s, p, m = B.shape
    if moduli.shape[1] == 1:
        DB = np.matmul(moduli[:, 0], B.reshape(n, s, p * m)).reshape(n, s, p, m)
    else:
        DB = np.zeros_like(B)
        used = np.abs(moduli).max(axis=(0, 1)) > 0
        for i, j in zip(*np.nonzero(used), strict=True):
            DB[:, i] += moduli[..., i, j, None] * B[:, j]
    DB *= operator.weights[:, None, :, None]
    left, right = dual.reshape(n, s * p, m), DB.reshape(n, s * p, m)
    return np.matmul(left.transpose(0, 2, 1), right)


def spread(scalar: FloatArray, n_unknowns: int) -> FloatArray:
    """Matrices (n, k, k) of one unknown repeated for each of several unknowns of a node."""
    n, k, _ = scalar.shape
    values = np.zeros((n, k * n_unknowns, k * n_unknowns))
    for i in range(n_unknowns):
        values[:, i::n_unknowns, i::n_unknowns] = scalar
    return values


def node_major_layout(cells: CellBlock, unknowns: tuple[str, ...]) -> Layout:
    """Rows node by node, the same unknowns at each."""
    k = cells.kind.n_nodes
    return Layout(cells.nodes, cells.raw, np.repeat(np.arange(k), len(unknowns)), unknowns * k)


def element_matrices(
    zone: Zone, layout: Layout, values: FloatArray, kind: str, keep_zone: bool = True
) -> ElementMatrices:
    """The block of a matrix that a zone contributes."""
    rows = layout.table, layout.raw_nodes, layout.local, layout.unknowns, layout.duals
    return ElementMatrices(*rows, values, kind, zone if keep_zone else None)


def cell_block(
    zone: Zone, names: tuple[str, ...], values: FloatArray, support: Support = "STRESSES"
) -> CellFieldBlock:
    """A block of a field in cells from values (n_cells, n_components, n_points)."""
    components = {name: np.ascontiguousarray(values[:, i]) for i, name in enumerate(names)}
    return zone.block(components, support)


class TurningFamily(ElementFamily):
    """Beams and shells, whose nodes carry translations and rotations."""

    def layout(self, zone: Zone) -> Layout:
        """Translations then rotations, node by node."""
        unknowns = NODE_TRANSLATIONS[zone.mode] + NODE_ROTATIONS[zone.mode]
        return node_major_layout(zone.cells, unknowns)
