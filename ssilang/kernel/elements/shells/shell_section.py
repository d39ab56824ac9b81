"""Elastic law of a thin shell's section: forces N11 N22 N12 and moments M11 M22 M12."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_gradients
from ssilang.kernel.elements.solids.kinematics import cross_matrix
from ssilang.kernel.elements.solids.solid_moduli import symmetry_of
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.elasticity import check_isotropic
from ssilang.kernel.materials.model import Zone

DRILLING = 1e-5
"""Stiffness of the rotation about the normal, relative to the bending stiffness of the section."""
SHEAR_FACTOR = 5 / 6


def isotropic(parameters: ZoneField, support: Support) -> FloatArray:
    """Moduli (n_cells, n_points or 1, 3, 3) of plane stress."""
    young, poisson = (parameters.at(n, support) for n in ("YOUN", "NU"))
    check_isotropic(young, poisson)
    E, nu = np.broadcast_arrays(young, poisson)
    Q = np.zeros((*E.shape, 3, 3))
    k = E / (1 - nu**2)
    Q[..., 0, 0] = Q[..., 1, 1] = k
    Q[..., 0, 1] = Q[..., 1, 0] = nu * k
    Q[..., 2, 2] = E / (2 * (1 + nu))
    return Q


def _orthotropic(parameters: ZoneField, support: Support) -> FloatArray:
    """V1X, V1Y are the cosines of the first axis in the element's own frame."""
    names = ("YG1", "YG2", "NU12", "G12", "V1X", "V1Y")
    return _along_axes(*(parameters.at(n, support) for n in names))


def _unidirectional(parameters: ZoneField, support: Support) -> FloatArray:
    """A layer that is stiff along its first axis only."""
    young, c, s = (parameters.at(n, support) for n in ("YOUN", "V1X", "V1Y"))
    return _along_axes(young, 0.0 * young, 0.0 * young, 0.0 * young, c, s)


def _along_axes(*given: FloatArray) -> FloatArray:
    E1, E2, n12, G, c, s = np.broadcast_arrays(*given)
    Q = np.zeros((*E1.shape, 3, 3))
    k = 1 / (1 - n12**2 * E2 / E1)
    Q[..., 0, 0], Q[..., 1, 1], Q[..., 2, 2] = k * E1, k * E2, G
    Q[..., 0, 1] = Q[..., 1, 0] = k * n12 * E2
    T = np.empty_like(Q)  # strains in the element's frame to strains along the axes
    T[..., 0, :] = np.stack([c * c, s * s, c * s], axis=-1)
    T[..., 1, :] = np.stack([s * s, c * c, -c * s], axis=-1)
    T[..., 2, :] = np.stack([-2 * c * s, 2 * c * s, c * c - s * s], axis=-1)
    return np.swapaxes(T, -1, -2) @ Q @ T


_LAWS = {
    "ISOTROPE": isotropic, "ORTHOTROPE": _orthotropic, "UNIDIRECTIONNEL": _unidirectional
}  # fmt: skip


def _law_of(zone: Zone) -> Callable[[ZoneField, Support], FloatArray]:
    """Moduli of plane stress of a zone's elasticity."""
    kind = symmetry_of(zone)
    if kind not in _LAWS:
        raise MaterialError(
            "kernel.elements.elasticity-not-available-shells", kind=kind, element=zone.element
        )
    return _LAWS[kind]


def section_moduli(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Moduli (n_cells or 1, n_points or 1, 6, 6) of membrane and bending.

    Raises
    ------
    MaterialError
        If a parameter is missing.
    """
    Q = _law_of(zone)(parameters, support)
    h = parameters.at("EPAI", support)[..., None, None]
    shape = np.broadcast_shapes(Q.shape[:2], h.shape[:2])
    D = np.zeros((*shape, 6, 6))
    D[..., :3, :3] = Q * h
    D[..., 3:, 3:] = Q * h**3 / 12
    return D


def transverse_moduli(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Moduli (n_cells or 1, n_points or 1, 2, 2) of transverse shear: 5/6 G h."""
    h = parameters.at("EPAI", support)[..., None, None]
    return SHEAR_FACTOR * h * _shear(zone, parameters, support)


def _shear(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Shear moduli (n, p, 2, 2) across, in the element's own frame."""
    if symmetry_of(zone) == "ISOTROPE":
        young, poisson = (parameters.at(n, support) for n in ("YOUN", "NU"))
        G = young / (2 * (1 + poisson))
        return G[..., None, None] * np.eye(2)
    names = ("G13", "G23", "V1X", "V1Y")
    G13, G23, c, s = np.broadcast_arrays(*(parameters.at(n, support) for n in names))
    first, second = np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)
    pair = ((G13, first), (G23, second))
    turned: Any = sum(G[..., None, None] * v[..., :, None] * v[..., None, :] for G, v in pair)
    return np.asarray(turned)


def material_moduli(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Moduli (n_cells or 1, n_points or 1, 5, 5) of plane stress and transverse shear."""
    Q, G = _law_of(zone)(parameters, support), _shear(zone, parameters, support)
    D = np.zeros((*np.broadcast_shapes(Q.shape[:2], G.shape[:2]), 5, 5))
    D[..., :3, :3], D[..., 3:, 3:] = Q, SHEAR_FACTOR * G
    return D


def drilled(zone: Zone, values: FloatArray, bending: FloatArray, normals: FloatArray) -> FloatArray:
    """Stiffness matrices with a small term for the rotation of each node about its normal.

    The rotation counts relative to that of the middle of the cell, so that rigid motions cost
    nothing.

    Parameters
    ----------
    values : array (n, 6 k, 6 k)
    bending : array (n,) or (1,)
        Bending stiffness of the section.
    normals : array (n, k, 3)
    """
    n, k, _ = normals.shape
    scale = (DRILLING * np.broadcast_to(bending, (n,)))[:, None, None]
    slopes, normal = _surface_slopes(zone)
    share = normals - 0.5 * np.einsum("ckj,cj->ck", normals, normal)[..., None] * normal[:, None]
    out = values.copy()
    for node in range(k):
        row = np.zeros((n, k, 6))
        row[:, :, :3] = -np.cross(share[:, node, None], slopes)
        row[:, node, 3:] = normals[:, node]
        flat = row.reshape(n, 6 * k)
        out += scale * flat[:, :, None] * flat[:, None, :]
    return out


def _surface_slopes(zone: Zone) -> tuple[FloatArray, FloatArray]:
    """Gradients (n, k, 3) along the surface of the shapes, and normals (n, 3), at the middles."""
    kind = zone.cells.cell_type
    reference = shape_gradients(kind, REFERENCE_CELLS[kind].nodes.mean(axis=0, keepdims=True))[0]
    tangents = np.einsum("ki,ckj->cij", reference, zone.cells.coordinates)
    normal = np.cross(tangents[:, 0], tangents[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    dual = np.linalg.inv(np.concatenate([tangents, normal[:, None]], axis=1))[:, :, :2]
    slopes: FloatArray = np.einsum("cji,ki->ckj", dual, reference)
    return slopes, normal


def offset(zone: Zone, parameters: ZoneField) -> FloatArray | None:
    """Distance (n,) of the middle surface from the mesh along the normals; None: it lies there."""
    if "EXCE" not in parameters:
        return None
    e = parameters.each("EXCE")
    return e if e.any() else None


def strains_off_mesh(B: FloatArray, zone: Zone, parameters: ZoneField, cells: slice) -> FloatArray:
    """Operator with the membrane strains (first rows) of the middle surface, EXCE off the mesh."""
    e = offset(zone, parameters)
    if e is None:
        return B
    moved = B.copy()
    moved[:, :3] += e[cells][:, None, None, None] * B[:, 3:6]
    return moved


def moduli_on_mesh(D: FloatArray, zone: Zone, parameters: ZoneField) -> FloatArray:
    """Moduli (n, p, s, s) of forces and strains of the mesh from those of the middle surface."""
    e = offset(zone, parameters)
    if e is None:
        return D
    s = D.shape[-1]
    moved = np.eye(s) + e[:, None, None, None] * np.eye(s, k=3) * (np.arange(s) < 3)[:, None]
    return np.asarray(np.swapaxes(moved, -1, -2) @ D @ moved)


def by_node(
    zone: Zone,
    parameters: ZoneField,
    normals: FloatArray,
    scalar: FloatArray,
    turning: FloatArray | float,
) -> FloatArray:
    """Matrices (n, 6 k, 6 k) of translations (n, k, k) and rotations (n, k, 3, k, 3).

    Both are of the middle surface, whose normals (n, k, 3) take them to the mesh.
    """
    n, k, _ = scalar.shape
    values = np.zeros((n, k, 6, k, 6))
    for i in range(3):
        values[:, :, i, :, i] = scalar
    values[:, :, 3:, :, 3:] = turning
    return inertia_off_mesh(values.reshape(n, 6 * k, 6 * k), zone, parameters, normals)


def inertia_off_mesh(
    values: FloatArray, zone: Zone, parameters: ZoneField, normals: FloatArray
) -> FloatArray:
    """Matrices (n, 6 k, 6 k) on the mesh from those on the middle surface, EXCE off it.

    The middle surface moves by `u + EXCE theta x n`, the normals n being (n, k, 3).
    """
    e = offset(zone, parameters)
    if e is None:
        return values
    v = normals * e[:, None, None]
    n, k = v.shape[:2]
    arm = np.broadcast_to(np.eye(6), (n, k, 6, 6)).copy()
    arm[..., :3, 3:] = cross_matrix(-v)
    blocks = values.reshape(n, k, 6, k, 6)
    turned: FloatArray = np.einsum("cari,carbs,cbsj->caibj", arm, blocks, arm, optimize=True)
    return turned.reshape(n, 6 * k, 6 * k)


def own_to_global(B: FloatArray, frames: FloatArray) -> FloatArray:
    """Operator on the global unknowns (n, s, p, 6 k) from that on those of the own frame."""
    n, s, p, m = B.shape
    blocks = B.reshape(n, s, p, m // 3, 3)
    turned: FloatArray = np.einsum("cspbi,cij->cspbj", blocks, frames)
    return turned.reshape(n, s, p, m)
