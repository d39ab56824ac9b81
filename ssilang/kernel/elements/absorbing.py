"""Viscous boundaries that absorb normally incident waves (Lysmer and Kuhlemeyer 1969)."""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.elements.boundary import (
    face_geometry,
    require_parents,
    zones_of_faces,
)
from ssilang.kernel.elements.solids.kinematics import NODE_TRANSLATIONS, harmonic
from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, dual_of
from ssilang.kernel.mesh.mesh import CellBlock, Mesh


def absorbing_boundary(model: Model, boundary: Mesh, material: CellField) -> Matrix:
    """Damping of a boundary: RHO VP along the normal, RHO VS along the tangents.

    Parameters
    ----------
    model : Model
        Of the medium that goes on beyond the boundary.
    boundary : Mesh
        Sides of its cells.
    material : CellField
        YOUN, NU, RHO.
    """
    blocks = [
        _damping(zone, faces, rows, of_cells, zone_field(zone, material))
        for faces in boundary.blocks
        for of in (require_parents(faces, model),)
        for zone, rows in zones_of_faces(of, model)
        for of_cells in (of.cell[rows],)
    ]
    return Matrix(boundary.nodes, tuple(blocks), (), "AMORTISSEMENT")


def _at_cells(parameters: ZoneField, name: str, cells: IntArray) -> FloatArray:
    values = parameters.at(name, "GRAVITE")
    n = len(parameters.zone.cells)
    return np.broadcast_to(values.mean(axis=1), (n,))[cells]


def _damping(
    zone: Zone, faces: CellBlock, rows: IntArray, cells: IntArray, parameters: ZoneField
) -> ElementMatrices:
    young, poisson, density = (_at_cells(parameters, n, cells) for n in ("YOUN", "NU", "RHO"))
    shear = young / (2 * (1 + poisson))
    primary = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
    part = CellBlock.make(faces.nodes, faces.cell_type, faces.raw[rows])
    geometry = face_geometry(part, zone.mode, harmonic(zone))
    normal = geometry.normals / geometry.measures[..., None]
    names = NODE_TRANSLATIONS[zone.mode]
    d, k = len(names), part.kind.n_nodes
    full = np.zeros((*normal.shape[:2], d))
    full[..., : normal.shape[-1]] = normal
    outer = np.einsum("cpi,cpj->cpij", full, full)
    along, across = np.sqrt(density * primary), np.sqrt(density * shear)
    D = across[:, None, None, None] * (np.eye(d) - outer) + along[:, None, None, None] * outer
    N = geometry.shapes
    values = np.einsum("cp,pa,pb,cpij->caibj", geometry.measures, N, N, D, optimize=True)
    return ElementMatrices(
        part.nodes,
        part.raw,
        np.repeat(np.arange(k), d),
        names * k,
        tuple(dual_of(n) for n in names) * k,
        values.reshape(len(part), k * d, k * d),
        "AMORTISSEMENT",
    )
