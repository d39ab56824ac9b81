"""Nodal forces of forces and moments spread along beams and bars."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.beams.beam_frame import beam_frame
from ssilang.kernel.elements.catalog import ELEMENTS
from ssilang.kernel.elements.family import node_major_layout
from ssilang.kernel.elements.loads.loads import total
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.matrices.matrix import dual_of

LINES = ("beam", "timoshenko", "bar")

# forces (v1 m1 v2 m2) of a linear density q1, q2 on the cubic deflection, times L and L^2
_CUBIC = np.array([[7 / 20, 3 / 20], [1 / 20, 1 / 30], [3 / 20, 7 / 20], [-1 / 30, -1 / 20]])
# forces of a moment density m1, m2 on the slope of the cubic deflection
_CUBIC_MOMENT = np.array([[-1 / 2, -1 / 2], [1 / 12, -1 / 12], [1 / 2, 1 / 2], [-1 / 12, 1 / 12]])
_LINEAR = np.array([[1 / 3, 1 / 6], [1 / 6, 1 / 3]])


def line_load(
    model: Model, value: FloatArray | NodeField, plane_normal: FloatArray | None = None
) -> NodeField:
    """Forces of a density along lines, linear between the nodes of each.

    Parameters
    ----------
    value : array (3,) or NodeField
        Force per length (FX FY FZ, with moments per length MX MY MZ in a field).
    plane_normal : array (3,), optional
        The density counts per length projected on the plane normal to this vector.

    Raises
    ------
    MeshError
        If the model holds other elements than beams and bars.
    """
    return total(model.mesh.nodes, [_on_zone(z, value, plane_normal) for z in model.zones])


def _densities(zone: Zone, names: tuple[str, ...], value: FloatArray | NodeField) -> FloatArray:
    """Values (n_cells, 2, 3) at both ends, zero where absent."""
    nodes = zone.cells.connectivity[:, [0, -1]]
    out = np.zeros((*nodes.shape, 3))
    for i, name in enumerate(names):
        axis = "XYZ".index(name[1]) if name[1] in "XYZ" else i
        if isinstance(value, NodeField):
            out[..., axis] = value.values_at(name, nodes.ravel()).reshape(nodes.shape)
        elif name[0] == "F":
            out[..., axis] = value[axis]
    return out


def _on_zone(
    zone: Zone, value: FloatArray | NodeField, plane_normal: FloatArray | None
) -> NodeField:
    family = ELEMENTS[zone.element].family
    if family not in LINES or zone.cells.kind.n_nodes != 2:
        raise MeshError("kernel.elements.load-along-lines-beams", element=zone.element)
    frame = beam_frame(zone, zone_field(zone, None))
    translations = NODE_TRANSLATIONS[zone.mode]
    rotations = NODE_ROTATIONS[zone.mode] if family != "bar" else ()
    forces = _densities(zone, tuple(dual_of(u) for u in translations), value)
    moments = _densities(zone, tuple(dual_of(u) for u in rotations), value)
    if plane_normal is not None:
        unit = plane_normal / np.linalg.norm(plane_normal)
        ratio = np.linalg.norm(np.cross(frame.axes[:, 0], unit), axis=1)[:, None, None]
        forces, moments = forces * ratio, moments * ratio
    local = np.stack(
        [np.einsum("cij,caj->cai", frame.axes, v) for v in (forces, moments)], axis=2
    )  # (n, end, force or moment, axis)
    out = _equivalent(local, frame.lengths, family == "beam")
    turned = np.einsum("cij,cnti->cntj", frame.axes, out)
    columns = [(0, "XYZ".index(u[1])) for u in translations]
    columns += [(1, "XYZ".index(u[1])) for u in rotations]
    vectors = np.stack([turned[:, :, t, axis] for t, axis in columns], axis=2)
    layout = node_major_layout(zone, translations + rotations)
    return layout.scatter(vectors.reshape(len(vectors), -1))


def _equivalent(local: FloatArray, lengths: FloatArray, cubic: bool) -> FloatArray:
    """Forces and moments (n, 2, 2, 3) at the ends from their densities, in local axes."""
    L = lengths[:, None, None, None]
    out: FloatArray = np.einsum("ab,cbti->cati", _LINEAR, local) * L
    if not cubic:
        return out
    one, L1 = np.ones(len(lengths)), lengths
    of_forces = np.stack([L1, L1**2, L1, L1**2], axis=1)
    of_moments = np.stack([one, L1, one, L1], axis=1)
    # bending planes: deflection y with moment z, deflection z with moment -y
    for axis, turning, sign in ((1, 2, 1.0), (2, 1, -1.0)):
        q, m = local[:, :, 0, axis], local[:, :, 1, turning] * sign
        ends = q @ _CUBIC.T * of_forces + m @ _CUBIC_MOMENT.T * of_moments
        out[:, :, 0, axis] = ends[:, 0::2]
        out[:, :, 1, turning] = sign * ends[:, 1::2]
    return out
