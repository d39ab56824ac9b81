"""Elastic law of a thin shell's section: forces N11 N22 N12 and moments M11 M22 M12."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.solid_moduli import symmetry_of
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.errors import MaterialError
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.materials.elasticity import check_isotropic
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.model import Zone


def _isotropic(parameters: ZoneField, support: Support) -> FloatArray:
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
    E1, E2, n12, G, c, s = np.broadcast_arrays(*(parameters.at(n, support) for n in names))
    Q = np.zeros((*E1.shape, 3, 3))
    k = 1 / (1 - n12**2 * E2 / E1)
    Q[..., 0, 0], Q[..., 1, 1], Q[..., 2, 2] = k * E1, k * E2, G
    Q[..., 0, 1] = Q[..., 1, 0] = k * n12 * E2
    T = np.empty_like(Q)  # strains in the element's frame to strains along the axes
    T[..., 0, :] = np.stack([c * c, s * s, c * s], axis=-1)
    T[..., 1, :] = np.stack([s * s, c * c, -c * s], axis=-1)
    T[..., 2, :] = np.stack([-2 * c * s, 2 * c * s, c * c - s * s], axis=-1)
    turned: FloatArray = np.swapaxes(T, -1, -2) @ Q @ T
    return turned


_LAWS = {"ISOTROPE": _isotropic, "ORTHOTROPE": _orthotropic}


def section_moduli(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Moduli (n_cells or 1, n_points or 1, 6, 6) of membrane and bending.

    Raises
    ------
    MaterialError
        If a parameter is missing, or the middle surface is off the mesh (EXCE).
    """
    kind = symmetry_of(zone)
    if kind not in _LAWS:
        raise MaterialError(f"elasticity {kind} is not available for shells ({zone.element})")
    if "EXCE" in parameters and np.any(parameters.at("EXCE", support) != 0):
        raise MaterialError("shells off their mesh (EXCE) are not available")
    Q = _LAWS[kind](parameters, support)
    h = parameters.at("EPAI", support)[..., None, None]
    shape = np.broadcast_shapes(Q.shape[:2], h.shape[:2])
    D = np.zeros((*shape, 6, 6))
    D[..., :3, :3] = Q * h
    D[..., 3:, 3:] = Q * h**3 / 12
    return D
