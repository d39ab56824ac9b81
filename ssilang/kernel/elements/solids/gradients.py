"""Displacement gradients of continuous elements and what second-order strains take from them."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements.family import node_major_layout
from ssilang.kernel.elements.shapes.geometry import chunks
from ssilang.kernel.elements.solids.kinematics import as_components, harmonic
from ssilang.kernel.elements.solids.solid import REVOLUTION, kinematics, radius, zone_geometry
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone


def gradient_names(zone: Zone) -> tuple[str, ...]:
    """Components that GRAD gives: UX,X UX,Y ...; in axisymmetry UT,T = UR / R besides."""
    names = kinematics(zone).gradient
    return (*names, "UT,T") if zone.mode is Mode.AXISYMMETRIC else names


def gradient_values(zone: Zone, displacement: NodeField) -> FloatArray:
    """Displacement gradients (n_cells, n_components, n_points) at the points of 'STRESSES'."""
    table = kinematics(zone)
    nu, d = len(table.unknowns), table.dimension
    vectors = node_major_layout(zone.cells, table.unknowns).gather(displacement)
    parts = []
    for cells in chunks(len(zone.cells)):
        geometry = zone_geometry(zone, "STRESSES", cells)
        u = vectors[cells].reshape(-1, zone.cells.kind.n_nodes, nu)
        G = np.einsum("cpdk,cku->cudp", geometry.gradients, u)
        flat = G.reshape(len(u), nu * d, -1)
        if zone.mode is Mode.AXISYMMETRIC:
            hoop = (u[..., 0] @ geometry.shapes.T) / radius(zone, geometry.shapes, cells)
            flat = np.concatenate([flat, hoop[:, None]], axis=1)
        parts.append(flat)
    return np.concatenate(parts)


def scalar_gradient(zone: Zone, field: NodeField, name: str) -> FloatArray:
    """Gradient (n_cells, dim, n_points) of one nodal component."""
    values = field.values_at(name, zone.cells.connectivity)
    parts = []
    for cells in chunks(len(zone.cells)):
        geometry = zone_geometry(zone, "STRESSES", cells)
        parts.append(np.einsum("cpdk,ck->cdp", geometry.gradients, values[cells]))
    return np.concatenate(parts)


def gradient_tensor(zone: Zone, flat: FloatArray) -> FloatArray:
    """Gradients (n_cells, n_points, 3, 3) from components in the order of `gradient_names`."""
    table = kinematics(zone)
    d = table.dimension
    n, _, p = flat.shape
    H = np.zeros((n, p, 3, 3))
    for row, _ in enumerate(table.unknowns):
        for axis in range(d):
            H[..., row, axis] = flat[:, row * d + axis]
    if zone.mode is Mode.AXISYMMETRIC:
        H[..., 2, 2] = flat[:, -1]
    return H


def transformation(zone: Zone, flat: FloatArray, of_displacement: bool) -> FloatArray:
    """F (n_cells, n_points, 3, 3) from components of F, or of F - 1, in `gradient_names`' order.

    Directions that the hypothesis has no gradient for are not stretched.
    """
    F = gradient_tensor(zone, flat)
    if of_displacement:
        return F + np.eye(3)
    first = len(kinematics(zone).unknowns) + (zone.mode is Mode.AXISYMMETRIC)
    for axis in range(first, 3):
        F[..., axis, axis] = 1.0
    return F


def second_order_strain(zone: Zone, displacement: NodeField) -> FloatArray:
    """Quadratic terms of the Green-Lagrange strain, (n_cells, n_strains, n_points)."""
    if zone.mode in REVOLUTION and harmonic(zone):
        raise FieldError("kernel.elements.second-order-strains-not")
    H = gradient_tensor(zone, gradient_values(zone, displacement))
    Q = 0.5 * np.einsum("cpki,cpkj->cpij", H, H)
    return as_components(Q, len(kinematics(zone).strains), strains=True)


def logarithmic_strain(zone: Zone, gradient: FloatArray, of_displacement: bool) -> FloatArray:
    """Strains ln(F^T F) / 2, (n_cells, n_strains, n_points).

    Parameters
    ----------
    gradient : array (n_cells, n_components, n_points)
        F itself, or the displacement gradient F - I.
    """
    F = transformation(zone, gradient, of_displacement)
    C = np.einsum("cpki,cpkj->cpij", F, F)
    values, vectors = np.linalg.eigh(C)
    E = np.einsum("cpik,cpk,cpjk->cpij", vectors, 0.5 * np.log(values), vectors)
    return as_components(E, len(kinematics(zone).strains), strains=True)
