"""Faces of a model: their cells and outward areas; viscous boundaries on them.

These absorb normally incident waves (Lysmer and Kuhlemeyer 1969).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements.catalog import BODY_FAMILIES, family_name
from ssilang.kernel.elements.family import element_matrices, node_major_layout
from ssilang.kernel.elements.shapes.geometry import SurfaceGeometry, surface_geometry
from ssilang.kernel.elements.shapes.quadrature import Rule, quadrature
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS
from ssilang.kernel.elements.solids.kinematics import NODE_TRANSLATIONS, harmonic
from ssilang.kernel.elements.zone_fields import rows_of, zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Model, Zone
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.changes.merge import regenerate
from ssilang.kernel.mesh.mesh import CellBlock, Mesh

# points that integrate two shape functions of the face times a linear field
_POINTS = {"POI1": 1, "SEG2": 2, "SEG3": 3, "TRI3": 7, "TRI6": 7, "QUA4": 4, "QUA8": 9}


@dataclass(frozen=True, eq=False)
class Parents:
    """For each face: zone (n,) and cell (n,) it lies on, -1 where there is none."""

    zone: IntArray
    cell: IntArray


def face_rule(cell_type: str) -> Rule:
    """Quadrature of a face."""
    if cell_type not in _POINTS:
        raise MeshError("kernel.elements.cells-cannot-carry-surface", cell_type=cell_type)
    return quadrature(REFERENCE_CELLS[cell_type].shape, _POINTS[cell_type])


def parents(faces: CellBlock, model: Model) -> Parents:
    """Cells of a model on which faces lie (the first found)."""
    zone = np.full(len(faces), -1, dtype=np.int64)
    cell = np.full(len(faces), -1, dtype=np.int64)
    for number, part in enumerate(model.zones):
        sides = [s for kind, s in part.cells.kind.faces if kind == faces.cell_type]
        if not sides or not len(part.cells):
            continue
        table = np.concatenate([part.cells.connectivity[:, list(s)] for s in sides])
        owner = np.tile(np.arange(len(part.cells)), len(sides))
        rows = rows_of(table, faces.connectivity)
        found = (rows >= 0) & (zone < 0)
        zone[found], cell[found] = number, owner[rows[found]]
    return Parents(zone, cell)


def require_parents(faces: CellBlock, model: Model) -> Parents:
    """The same, refusing faces that lie on no cell."""
    found = parents(faces, model)
    lost = int((found.zone < 0).sum())
    if lost:
        inside = any(zone.cells.cell_type == faces.cell_type for zone in model.zones)
        told = {"lost": lost, "n_faces": len(faces), "cell_type": faces.cell_type, "inside": inside}
        raise MeshError("kernel.elements.cells-no-side-cell", **told)
    return found


def face_geometry(
    faces: CellBlock, mode: Mode, harmonic: int = 0, rule: Rule | None = None
) -> SurfaceGeometry:
    """Area vectors of faces (times 2 pi r in axisymmetry, pi r for a harmonic > 0)."""
    x = faces.coordinates[..., : mode.dimension]
    geometry = surface_geometry(faces.cell_type, x, rule or face_rule(faces.cell_type))
    if mode not in (Mode.AXISYMMETRIC, Mode.FOURIER):
        return geometry
    ring = (np.pi if harmonic else 2 * np.pi) * (x[..., 0] @ geometry.shapes.T)
    return SurfaceGeometry(
        geometry.shapes, geometry.normals * ring[..., None], geometry.measures * ring
    )


def outward(faces: CellBlock, geometry: SurfaceGeometry, model: Model, of: Parents) -> FloatArray:
    """Area vectors (n, points, dim) that point out of the cells on which the faces lie."""
    dim = geometry.normals.shape[-1]
    centre = np.zeros((len(faces), dim))
    for number, part in enumerate(model.zones):
        mine = of.zone == number
        if mine.any():
            centre[mine] = part.cells.coordinates[of.cell[mine]].mean(axis=1)[:, :dim]
    out = faces.coordinates.mean(axis=1)[:, :dim] - centre
    side = np.sign(np.einsum("cd,cpd->c", out, geometry.normals))
    return geometry.normals * side[:, None, None]


def sides_of_zones(
    faces: Mesh, model: Model
) -> Iterator[tuple[Zone, CellBlock, SurfaceGeometry, Parents]]:
    """The faces on each zone of continuous elements, with the cells that they bound."""
    for block in regenerate(faces).blocks:
        of = require_parents(block, model)
        for number, zone in enumerate(model.zones):
            rows = np.flatnonzero(of.zone == number)
            if len(rows):
                part = block.some(rows)
                geometry = face_geometry(part, zone.mode, harmonic(zone))
                yield zone, part, geometry, Parents(of.zone[rows], of.cell[rows])


def is_solid(zone: Zone) -> bool:
    """True for continuous elements."""
    return family_name(zone) in BODY_FAMILIES


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
        _damping(zone, part, geometry, of.cell, material)
        for zone, part, geometry, of in sides_of_zones(boundary, model)
    ]
    return Matrix(boundary.nodes, tuple(blocks), (), "AMORTISSEMENT")


def wave_speeds(zone: Zone, material: CellField) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Speeds of pressure and of shear waves, and density, of each cell of a zone (n,)."""
    parameters = zone_field(zone, material)
    young, poisson, density = (parameters.each(name) for name in ("YOUN", "NU", "RHO"))
    shear = young / (2 * (1 + poisson))
    primary = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
    return np.sqrt(primary / density), np.sqrt(shear / density), density


def _damping(
    zone: Zone, part: CellBlock, geometry: SurfaceGeometry, cells: IntArray, material: CellField
) -> ElementMatrices:
    primary, shear, density = (of[cells] for of in wave_speeds(zone, material))
    normal = geometry.normals / geometry.measures[..., None]
    names = NODE_TRANSLATIONS[zone.mode]
    d, k = len(names), part.kind.n_nodes
    full = np.zeros((*normal.shape[:2], d))
    full[..., : normal.shape[-1]] = normal
    outer = np.einsum("cpi,cpj->cpij", full, full)
    along, across = density * primary, density * shear
    D = across[:, None, None, None] * (np.eye(d) - outer) + along[:, None, None, None] * outer
    N = geometry.shapes
    values = np.einsum("cp,pa,pb,cpij->caibj", geometry.measures, N, N, D, optimize=True)
    layout = node_major_layout(part, names)
    flat = values.reshape(len(part), k * d, k * d)
    return element_matrices(zone, layout, flat, "AMORTISSEMENT", keep_zone=False)
