"""Change of the forces of a pressure when the sides that carry it move and turn.

The force on a side is p times its vector area; its derivative by the displacements is exact for
the interpolated geometry, straight and without moments in COQ2. In a Fourier series UR and UZ go
with cos, UT with sin.
"""

from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.boundary import face_geometry, face_rule
from ssilang.kernel.elements.family import element_matrices, node_major_layout
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.solids.kinematics import NODE_TRANSLATIONS, harmonic
from ssilang.kernel.elements.solids.solid import REVOLUTION, circumference
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone
from ssilang.kernel.matrices.matrix import ElementMatrices


def pressure_stiffness(
    zone: Zone, pressure: NodeField | CellField, unsymmetric: bool = False
) -> ElementMatrices:
    """Derivative of the nodal forces by the displacements, its symmetric part by default.

    Parameters
    ----------
    pressure : field with one component, at nodes or in cells (at nodes or constant)
        Positive along the sides' own normals (a quarter turn from a line).

    Raises
    ------
    MeshError
        For cells that are no sides.
    """
    dim = _dimension(zone)
    p = _at_points(zone, pressure)
    build = _in_space if dim == 3 else _of_revolution if zone.mode in REVOLUTION else _in_plane
    return _matrices(zone, build(zone, p), unsymmetric)


def gradient_stiffness(
    zone: Zone, modulus: float, direction: FloatArray | None, unsymmetric: bool = False
) -> ElementMatrices:
    """Change of the forces of a pressure that grows along a direction, as the sides move in it.

    The pressure of a side grows by `modulus * (u . direction)`; its forces point along the side's
    own normal. Without a direction it is that normal: springs of `modulus` for each unit of area.

    Parameters
    ----------
    direction : array (3,), of any length

    Raises
    ------
    MeshError
        For cells that are no sides.
    """
    dim = _dimension(zone)
    face = face_geometry(zone.cells, zone.mode, harmonic(zone))
    N, area = face.shapes, face.normals if dim == 3 else -face.normals  # a quarter turn from a line
    unit = area / face.measures[..., None]
    along = unit if direction is None else direction[:dim] / np.linalg.norm(direction[:dim])
    along = np.broadcast_to(along, area.shape)
    k, d = N.shape[1], len(NODE_TRANSLATIONS[zone.mode])
    values = np.zeros((len(area), k, d, k, d))
    values[:, :, :dim, :, :dim] = np.einsum("pa,cpi,pb,cpj->caibj", N, modulus * area, N, along)
    return _matrices(zone, _joined(values), unsymmetric)


def _dimension(zone: Zone) -> int:
    dim = zone.mode.dimension
    if zone.cells.kind.dimension != dim - 1 or zone.cells.kind.joint:
        raise MeshError("kernel.elements.cells-carry-no-pressure", cell_type=zone.cells.cell_type)
    return dim


def _matrices(zone: Zone, values: FloatArray, unsymmetric: bool) -> ElementMatrices:
    if not unsymmetric:
        values = 0.5 * (values + np.swapaxes(values, 1, 2))
    layout = node_major_layout(zone.cells, NODE_TRANSLATIONS[zone.mode])
    made = element_matrices(zone, layout, values, "RIGIDITE", keep_zone=False)
    return replace(made, symmetric=not unsymmetric)


def _at_points(zone: Zone, pressure: NodeField | CellField) -> FloatArray:
    """Pressure times quadrature weight (n, points)."""
    rule = face_rule(zone.cells.cell_type)
    shapes = shape_functions(zone.cells.cell_type, rule.points)
    nodes = zone.cells.connectivity
    if isinstance(pressure, NodeField):
        name = next(iter(pressure.components), "")
        values = pressure.values_at(name, nodes) @ shapes.T
    else:
        seen = zone_field(zone, pressure)
        raw = seen.raw(seen.names[0] if seen.names else "")[0].astype(float)
        values = raw @ shapes.T if raw.shape[1] == nodes.shape[1] else raw[:, :1]
    return np.broadcast_to(values, (len(nodes), len(rule))) * rule.weights


def _shapes(zone: Zone) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Shapes (p, k), derivatives (p, k, d - 1), coordinates (n, k, 3)."""
    rule = face_rule(zone.cells.cell_type)
    kind = zone.cells.cell_type
    return (
        shape_functions(kind, rule.points),
        shape_gradients(kind, rule.points),
        zone.cells.coordinates,
    )


def _joined(blocks: FloatArray) -> FloatArray:
    """(n, k, d, k, d) to (n, k d, k d)."""
    n, k, d = blocks.shape[:3]
    return blocks.reshape(n, k * d, k * d)


def _in_space(zone: Zone, p: FloatArray) -> FloatArray:
    """p (u,1 x x,2 + x,1 x u,2)."""
    N, dN, x = _shapes(zone)
    t = np.einsum("pki,ckj->cpij", dN, x)
    epsilon = np.zeros((3, 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        epsilon[i, j, k], epsilon[i, k, j] = 1.0, -1.0
    first = np.einsum("ijk,pb,cpk->cpibj", epsilon, dN[:, :, 0], t[:, :, 1])
    second = np.einsum("ijk,cpj,pb->cpibk", epsilon, t[:, :, 0], dN[:, :, 1])
    return _joined(np.einsum("cp,pa,cpibj->caibj", p, N, first + second))


def _in_plane(zone: Zone, p: FloatArray) -> FloatArray:
    """p times the quarter turn of u,s."""
    N, dN, _ = _shapes(zone)
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    return _joined(np.einsum("cp,pa,pb,ij->caibj", p, N, dN[:, :, 0], turn))


def _of_revolution(zone: Zone, p: FloatArray) -> FloatArray:
    """The same on a ring, with the circumferential derivatives of harmonic n."""
    N, dN, x = _shapes(zone)
    n = harmonic(zone)
    slope = dN[:, :, 0]
    r = x[..., 0] @ N.T
    tr, tz = (np.einsum("pk,ck->cp", slope, x[..., i]) for i in (0, 1))
    w = p * circumference(zone)
    names = NODE_TRANSLATIONS[zone.mode]
    d, k = len(names), zone.cells.kind.n_nodes
    out = np.zeros((len(x), k, d, k, d))

    def add(row: int, column: int, factor: FloatArray, base: FloatArray) -> None:
        out[:, :, row, :, column] += np.einsum("cp,pa,pb->cab", factor, N, base)

    add(0, 1, -w * r, slope)
    add(0, 0, -w * tz, N)
    add(1, 0, w * r, slope)
    add(1, 0, w * tr, N)
    if d == 3:
        add(0, 2, -n * w * tz, N)
        add(1, 2, n * w * tr, N)
        add(2, 0, -n * w * tz, N)
        add(2, 2, -w * tz, N)
        add(2, 1, n * w * tr, N)
    return _joined(out)
