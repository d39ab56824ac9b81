"""Joints as a family of elements: layout, jump operator, moduli, mass (RIGI, EPSI, SIGM, MASS).

The strain is the jump in local axes, the stress the traction. JOI1 has relative rotations too,
with springs QS (2D) or QN, QS1, QS2 (3D), unless its law is JOINT_SDM or a bearing's.
"""

from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.families import register_family
from ssilang.kernel.elements.family import (
    ElementFamily,
    Layout,
    StrainOperator,
    cell_block,
    element_matrices,
    node_major_layout,
)
from ssilang.kernel.elements.shapes.reference import shape_functions
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.interface.bed import twisting_stiffness, yields
from ssilang.kernel.interface.elements import joint_element
from ssilang.kernel.interface.kinematics import JointCells, joint_cells, point_values
from ssilang.kernel.interface.laws.columns import Parameter
from ssilang.kernel.interface.laws.law_table import elastic_tangent, law_of
from ssilang.kernel.interface.laws.parameter_table import joint_parameters
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices

_SPRINGS = {2: (("QS",),), 3: (("QN",), ("QS1", "QS"), ("QS2", "QS"))}
_CURVATURES = {2: ("CXZ",), 3: ("CXX", "CXY", "CXZ")}
_MOMENTS = {2: ("MOMZ",), 3: ("MOMX", "MOMY", "MOMZ")}
ROTATIONS = {2: ("RZ",), 3: ("RX", "RY", "RZ")}
"""Primal names by the number of dimensions."""


def displacement_names(zone: Zone) -> tuple[str, ...]:
    """Primal names of the displacements of a joint."""
    if zone.mode is Mode.AXISYMMETRIC:
        return ("UR", "UZ")
    return ("UX", "UY", "UZ")[: zone.mode.dimension]


def has_rotations(zone: Zone) -> bool:
    """True for a joint of two points with rotational springs."""
    if zone.element != "JOI1" or "JOINT_SDM" in zone.behaviour:
        return False
    return not law_of(zone.behaviour).two_points


def rotational_stiffness(zone: Zone, given: CellField) -> ElementMatrices | None:
    """Springs of the relative rotations alone, None for joints without.

    A law of the displacements stands beside them.
    """
    if not has_rotations(zone):
        return None
    family, parameters = JointFamily(), zone_field(zone, given)
    moduli = family.moduli(zone, parameters, "RIGIDITE")
    d = joint_element(zone).dimension
    if law_of(zone.behaviour).macro:  # shear and torsion stay, rocking and opening do not
        keep = np.zeros(moduli.shape[-1], bool)
        keep[1:d] = True
        keep[d] = d == 3
        moduli[..., ~keep, :] = 0.0
    else:
        moduli[..., :d, :d] = 0.0
    values = family.stiffness_values(zone, moduli, parameters)
    return element_matrices(zone, family.layout(zone), values, "RIGIDITE", keep_zone=False)


def jump_gradient(zone: Zone, displacement: NodeField, given: ZoneField) -> CellFieldBlock:
    """Jumps in local axes by names of gradients: UX,X UY,X (UZ,X) of JOI1, normal first; US,N UN,N
    or U1,N U2,N UN,N of others.
    """
    d = joint_element(zone).dimension
    names = ("UX,X", "UY,X", "UZ,X")[:d]
    if zone.element != "JOI1":
        names = ("US,N", "UN,N") if d == 2 else ("U1,N", "U2,N", "UN,N")
    return cell_block(zone, names, JointFamily().strain_values(zone, displacement, given))


def component_order(zone: Zone) -> list[int]:
    """Order in which results list the local components: JOI1 starts with the normal."""
    d = joint_element(zone).dimension
    return [d - 1, *range(d - 1)] if zone.element == "JOI1" else list(range(d))


class JointFamily(ElementFamily):
    """Joints with closed, elastic faces."""

    def layout(self, zone: Zone) -> Layout:
        """Rows of the element vectors."""
        names = displacement_names(zone)
        if has_rotations(zone):
            names += ROTATIONS[zone.mode.dimension]
        return node_major_layout(zone.cells, names)

    def strain_names(self, zone: Zone) -> tuple[str, ...]:
        """DRSN DRN; DRS1 DRS2 DRN; EXX GXY [GXZ] and CXX CXY CXZ for JOI1."""
        names = joint_element(zone).strains
        turning = _CURVATURES[zone.mode.dimension] if has_rotations(zone) else ()
        return tuple(names[i] for i in component_order(zone)) + turning

    def stress_names(self, zone: Zone) -> tuple[str, ...]:
        """SMSN SMN; SMS1 SMS2 SMN; EFFX EFFY [EFFZ] and MOMX MOMY MOMZ for JOI1."""
        names = joint_element(zone).stresses
        turning = _MOMENTS[zone.mode.dimension] if has_rotations(zone) else ()
        return tuple(names[i] for i in component_order(zone)) + turning

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """Jump operator at the joint's own points, or at those of 'NOEUD' and 'GRAVITE'."""
        joints = _at(joint_cells(zone, parameters), support)
        G = joints.operator[cells][:, :, component_order(zone)].transpose(0, 2, 1, 3)
        one_side = -G if zone.element == "JOI1" else G
        matrix = np.concatenate([one_side, -one_side], axis=-1)
        if has_rotations(zone):
            matrix = _with_rotations(joints, matrix, cells)
        return StrainOperator(matrix, joints.weights[cells])

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Diagonal stiffness (n, g, s, s) at the joint's points."""
        joints = joint_cells(zone, parameters)
        if "ANISOTROPE" in zone.behaviour:
            return _full_moduli(joints, parameters, len(self.stress_names(zone)))
        n, g = joints.weights.shape
        order = component_order(zone)
        tangent = elastic_tangent(joint_parameters(joints, parameters), len(order))
        D = tangent.reshape(n, g, len(order), -1)[:, :, order][..., order]
        if not has_rotations(zone):
            return D
        springs, d = _SPRINGS[zone.mode.dimension], len(order)
        full = np.zeros((n, g, len(order) + len(springs), len(order) + len(springs)))
        full[..., : len(order), : len(order)] = D
        for i, names in enumerate(springs, start=len(order)):
            full[..., i, i] = _first_given(joints, parameters, names)
        law = law_of(zone.behaviour)
        if law.rocking is not None:
            rocking = law.turning(joint_parameters(joints, parameters), zone.mode.dimension)
            for i, values in enumerate(rocking[: len(springs)]):
                place = len(order) + i + (len(springs) == 3)
                full[..., place, place] = values[:, None]
            if len(springs) == 3:
                # against twist of macro-elements whose ground yields the bed has a spring
                table = joint_parameters(joints, parameters)
                for row, value in zip(table, full[..., d, d], strict=True):
                    if yields(row) and (row[Parameter.LONG] > 0.0 or row[Parameter.RAYO] > 0.0):
                        if value.any():
                            raise MaterialError("kernel.interface.bed-has-its-own-twist")
                        value[:] = twisting_stiffness(law_of(joints.zone.behaviour).code, row)
        return full

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """Mass of the joint's own matter: RHO (kg/m2) on the mid-surface, MASS (kg) of JOI1."""
        joints = joint_cells(zone, parameters)
        layout = self.layout(zone)
        n = len(zone.cells)
        name = "MASS" if zone.element == "JOI1" else "RHO"
        density = _first_given(joints, parameters, (name,)) * joints.weights
        if zone.element == "JOI1":
            scalar = np.einsum("ng,ij->nij", density, np.eye(2) / 2)
        else:
            N = np.concatenate([joints.shape, joints.shape], axis=1) / 2
            scalar = np.einsum("ng,gi,gj->nij", density, N, N)
        values = np.zeros((n, len(layout.unknowns), len(layout.unknowns)))
        for unknown in displacement_names(zone):
            rows = [i for i, u in enumerate(layout.unknowns) if u == unknown]
            values[:, np.array(rows)[:, None], rows] = scalar
        return values, layout


def _full_moduli(joints: JointCells, given: ZoneField, size: int) -> FloatArray:
    """Symmetric moduli (n, g, size, size) of a joint of two points, term by term (D11 D21 ...).

    The components stand in the order of the stresses: normal force, shear, moments.
    """
    full = np.zeros((*joints.weights.shape, size, size))
    for i in range(size):
        for j in range(i + 1):
            value = _first_given(joints, given, (f"D{i + 1}{j + 1}",))
            full[..., i, j] = full[..., j, i] = value
    if (np.linalg.eigvalsh(full)[..., 0] < -1e-9 * np.abs(full).max()).any():
        raise MaterialError("kernel.interface.moduli-not-positive")
    return full


def _first_given(joints: JointCells, given: ZoneField, names: tuple[str, ...]) -> FloatArray:
    """The first of these parameters that is given, at the points (n, g); zero if none is."""
    n, g = joints.weights.shape
    for name in names:
        found = point_values(given, name, n, joints.shape)
        if found is not None:
            return found
    return np.zeros((n, g))


def _at(joints: JointCells, support: Support) -> JointCells:
    """The joints seen at the points of another support (frames of the nearest own point)."""
    if joints.element.face == "POI1" or support not in ("NOEUD", "GRAVITE"):
        return joints
    rule = support_rule(joints.zone.element, support)
    shape = shape_functions(joints.element.face, rule.points)
    spread = np.linalg.pinv(joints.shape)
    nearest = np.argmax(shape @ spread, axis=1)
    total = joints.weights.sum(axis=1, keepdims=True)
    weights = total * rule.weights / rule.weights.sum()
    return replace(joints, shape=shape, frames=joints.frames[:, nearest], weights=weights)


def _with_rotations(joints: JointCells, matrix: FloatArray, cells: slice) -> FloatArray:
    """Operator of two points (n, d, 1, 2 d) with the relative rotations added."""
    d = joints.element.dimension
    axes = np.ones((len(matrix), 1, 1)) if d == 2 else joints.frames[cells, 0][:, [2, 0, 1]]
    r = axes.shape[1]
    full = np.zeros((len(matrix), d + r, 1, 2 * (d + r)))
    for node, sign in enumerate((-1.0, 1.0)):
        start = node * (d + r)
        full[:, :d, :, start : start + d] = matrix[..., node * d : (node + 1) * d]
        full[:, d:, 0, start + d : start + d + r] = sign * axes
    return full


register_family("joint", JointFamily())
