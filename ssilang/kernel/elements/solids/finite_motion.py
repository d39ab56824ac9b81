"""Continuous elements in finite motion: polar decomposition, stresses and strains of two
configurations, work on gradients.

F = dx/dX = R U. Stresses: S = J F^-1 sigma F^-T (second Piola-Kirchhoff of Cauchy); strains:
E = F^T e F (Green-Lagrange of Almansi).
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.family import node_major_layout
from ssilang.kernel.elements.results.tensors import components_at_home
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.solids import gradients, solid
from ssilang.kernel.elements.solids.kinematics import as_components, as_tensor, harmonic
from ssilang.kernel.elements.zone_fields import ZoneField, n_points, zone_field
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone


def transformation(zone: Zone, flat: FloatArray, of_displacement: bool) -> FloatArray:
    """`gradients.transformation`; refuses harmonics of bodies of revolution."""
    if zone.mode in solid.REVOLUTION and harmonic(zone):
        raise FieldError("kernel.elements.finite-motions-not-exist")
    return gradients.transformation(zone, flat, of_displacement)


def gradient_components(zone: Zone, tensor: FloatArray) -> FloatArray:
    """Components (n_cells, n_components, n_points) in `gradient_names`' order of (n, p, 3, 3)."""
    table = solid.kinematics(zone)
    rows = [tensor[..., i, j] for i in range(len(table.unknowns)) for j in range(table.dimension)]
    if zone.mode is Mode.AXISYMMETRIC:
        rows.append(tensor[..., 2, 2])
    return np.stack(rows, axis=1)


def polar(F: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rotation R and right stretch U, both (..., 3, 3), of F = R U.

    Raises
    ------
    FieldError
        If F turns a volume inside out, or has terms that are no finite numbers.
    """
    if not np.isfinite(F).all() or not (np.linalg.det(F) > 0.0).all():
        raise FieldError("kernel.elements.gradient-motion-determinant-not")
    left, stretch, right = np.linalg.svd(F)
    U = np.swapaxes(right, -1, -2) @ (stretch[..., None] * right)
    return left @ right, U


def motion_of(zone: Zone, displacement: NodeField, support: Support) -> FloatArray:
    """F (n_cells, n_points, 3, 3) of a displacement, from the present mesh, at a support."""
    if support != "STRESSES" and n_points(zone.element, support) != n_points(
        zone.element, "STRESSES"
    ):
        raise FieldError("kernel.elements.field-stands-wanted-stresses", support=support)
    return transformation(zone, gradients.gradient_values(zone, displacement), True)


def carried(
    zone: Zone, field: CellField, displacement: NodeField, forward: bool, turn_only: bool
) -> tuple[tuple[str, ...], FloatArray, Support]:
    """Stresses or strains of the reference configuration in the present one, or back.

    Parameters
    ----------
    forward : bool
        True: from Piola-Kirchhoff to Cauchy, from Green-Lagrange to Almansi.
    turn_only : bool
        Only the rotation: from the frame that turns with the matter to the general one, or back.

    Returns
    -------
    names, values (n_cells, n_names, n_points), support
    """
    table = solid.kinematics(zone)
    seen = zone_field(zone, field)
    strains = any(n in seen for n in table.strains)
    names = table.strains if strains else table.stresses
    flat, support = components_at_home(zone, field, names)
    F = motion_of(zone, displacement, support)
    n_at = np.broadcast_to(flat, (*flat.shape[:2], F.shape[1]))
    T = as_tensor(n_at, strains)
    A = polar(F)[0] if turn_only else F
    if turn_only:
        A = A if forward else np.swapaxes(A, -1, -2)
        made = A @ T @ np.swapaxes(A, -1, -2)
    elif strains:
        B = np.linalg.inv(A) if forward else A
        made = np.swapaxes(B, -1, -2) @ T @ B
    else:
        J = np.linalg.det(A)[..., None, None]
        B = A if forward else np.linalg.inv(A)
        made = B @ T @ np.swapaxes(B, -1, -2) * (1.0 / J if forward else J)
    return names, as_components(made, len(names), strains), support


def work(zone: Zone, stress: CellField, gradient: CellField) -> tuple[FloatArray, Support]:
    """Trace of stress times gradient (n_cells, n_points)."""
    sigma, support = components_at_home(zone, stress, solid.kinematics(zone).stresses)
    G, other = components_at_home(zone, gradient, gradients.gradient_names(zone))
    if sigma.shape[2] != G.shape[2] and 1 not in (sigma.shape[2], G.shape[2]):
        raise FieldError("kernel.elements.stresses-stand-gradients", support=support, other=other)
    H = gradients.gradient_tensor(zone, G)
    if zone.mode is Mode.FOURIER:
        raise FieldError("kernel.elements.work-no-gradients-fourier")
    return np.einsum("npij,npij->np", as_tensor(sigma, False), H), support


def gradient_forces(
    zone: Zone, stress: CellField, gradient: CellField, parameters: ZoneField
) -> NodeField:
    """Nodal forces whose work in v is the integral of S_ij du_k/dx_i dv_k/dx_j (FOFI)."""
    table = solid.kinematics(zone)
    sigma = as_tensor(zone_field(zone, stress).matrix(table.stresses, "STRESSES"), False)
    H = gradients.gradient_tensor(
        zone, zone_field(zone, gradient).matrix(gradients.gradient_names(zone), "STRESSES")
    )
    P = np.einsum("npij,npki->npkj", sigma, H)
    nu, d = len(table.unknowns), table.dimension
    layout = node_major_layout(zone.cells, table.unknowns)
    vectors = np.zeros((len(zone.cells), zone.cells.kind.n_nodes, nu))
    for cells in chunks(len(zone.cells)):
        geometry = solid.zone_geometry(zone, "STRESSES", cells)
        w = solid.integration_weights(zone, geometry, parameters, "STRESSES", cells)
        part = P[cells] * w[..., None, None]
        vectors[cells] = np.einsum("npkj,npjm->nmk", part[:, :, :nu, :d], geometry.gradients)
        if zone.mode is Mode.AXISYMMETRIC:
            hoop = part[..., 2, 2] / solid.radius(zone, geometry.shapes, cells)
            vectors[cells, :, 0] += hoop @ geometry.shapes
    return layout.scatter(vectors.reshape(len(vectors), -1))
