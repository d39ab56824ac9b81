"""Cross-sections of beams described by fibres: POJS, TRIS, QUAS.

A section is meshed in its own plane: its x is the local axis y of the beam, its y the local z, its
origin the beam's line. A fibre at (y, z) has the strains

    EPXX = EPS + z CY - y CZ,   GAXY = GXY - z CX,   GAXZ = GXZ + y CX

and its stresses SMXX SMXY SMXZ add up to the forces of the beam. ALPY and ALPZ multiply the shear
stresses, to make up for shear strains that are not constant over a real section.
"""

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError, MaterialError
from ssilang.kernel.elements.catalog import family_name, support_rule
from ssilang.kernel.elements.family import ElementFamily, Layout, StrainOperator
from ssilang.kernel.elements.shapes.reference import shape_functions, shape_gradients
from ssilang.kernel.elements.zone_fields import ZoneField, missing_parameter, n_points, zone_field
from ssilang.kernel.fields.cell_field import CellField, Support
from ssilang.kernel.materials.elasticity import check_isotropic
from ssilang.kernel.materials.model import Model, Zone

STRESSES = ("SMXX", "SMXY", "SMXZ")
STRAINS = ("EPXX", "GAXY", "GAXZ")


def fibre_places(zone: Zone, support: Support) -> tuple[FloatArray, FloatArray]:
    """Coordinates (n_cells, n_points, 2) in the section and areas (n_cells, n_points).

    The area of a point (POJS) counts as 1: its parameter SECT multiplies it.
    """
    rule = support_rule(zone.element, support)
    x = zone.cells.coordinates[..., :2]
    kind = zone.cells.cell_type
    if kind == "POI1":
        return x, np.ones((len(x), 1))
    places = np.einsum("pk,ckd->cpd", shape_functions(kind, rule.points), x)
    J = np.einsum("pki,ckj->cpij", shape_gradients(kind, rule.points), x)
    return places, np.abs(np.linalg.det(J)) * rule.weights


class Fibre(ElementFamily):
    """Cells of a section: they have places, areas and stresses, and no unknowns of their own."""

    strains = STRAINS
    stresses = STRESSES

    def layout(self, zone: Zone) -> Layout:
        """There is none."""
        raise FieldError("kernel.elements.element-describes-section-beam", element=zone.element)

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> StrainOperator:
        """There is none."""
        self.layout(zone)
        raise AssertionError

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """YOUN and the two shear moduli (n_cells or 1, n_points or 1, 3, 3)."""
        E, Gy, Gz = np.broadcast_arrays(*fibre_moduli(parameters, support))
        return np.stack([E, Gy, Gz], axis=-1)[..., None] * np.eye(3)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, Layout]:
        """There is none."""
        self.layout(zone)
        raise AssertionError

    def weights(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """Areas: INTG sums over the section."""
        return fibre_areas(zone, parameters, support)


def fibre_areas(zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
    """Areas (n_cells, n_points), SECT of points."""
    areas = fibre_places(zone, support)[1]
    return areas * parameters.at("SECT", support) if zone.element == "POJS" else areas


def fibre_moduli(
    parameters: ZoneField, support: Support
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """YOUN, ALPY G, ALPZ G (ALPZ is zero where a plane section has none)."""
    E, nu = (parameters.at(n, support) for n in ("YOUN", "NU"))
    check_isotropic(E, nu)
    G = E / (2 * (1 + nu))
    plane = 0.0 if parameters.zone.mode.dimension == 2 else None
    return E, parameters.at("ALPY", support) * G, parameters.at("ALPZ", support, plane) * G


@dataclass(frozen=True, eq=False)
class SectionZone:
    """Fibres of one zone of a section's model; `rows` is where they stand among all."""

    zone: Zone
    parameters: ZoneField
    rows: slice

    def each(self, name: str, default: float | None = None) -> FloatArray:
        """A parameter (n_fibres,) of the zone's fibres."""
        shape = (len(self.zone.cells), n_points(self.zone.element, "STRESSES"))
        return np.broadcast_to(self.parameters.at(name, "STRESSES", default), shape).ravel()


@dataclass(frozen=True, eq=False)
class FibreSection:
    """A section."""

    places: FloatArray  # (n_fibres, 2) local y and z
    areas: FloatArray  # (n_fibres,)
    moduli: FloatArray  # (n_fibres, 3) YOUN, ALPY G, ALPZ G
    zones: tuple[SectionZone, ...]

    @property
    def operator(self) -> FloatArray:
        """Strains (n_fibres, 3, 6) of fibres from EPS GXY GXZ CX CY CZ."""
        y, z = self.places.T
        A = np.zeros((len(y), 3, 6))
        A[:, 0, 0] = A[:, 1, 1] = A[:, 2, 2] = 1.0
        A[:, 0, 4], A[:, 0, 5] = z, -y
        A[:, 1, 3], A[:, 2, 3] = -z, y
        return A

    @property
    def rigidity(self) -> FloatArray:
        """Elastic moduli (6, 6) between the strains of the beam and its forces."""
        A = self.operator
        return np.einsum("f,fs,fsi,fsj->ij", self.areas, self.moduli, A, A)

    @property
    def mass(self) -> FloatArray:
        """Mass per length (6, 6) of translations and rotations about the line."""
        rho = np.concatenate([z.each("RHO") for z in self.zones])
        N = self.operator  # velocities follow as strains do
        return np.einsum("f,fsi,fsj->ij", rho * self.areas, N, N)

    @property
    def squared_radii(self) -> FloatArray:
        """Squared radii (2,) of gyration about y and z, of the areas."""
        total = self.areas.sum()
        return (self.areas @ self.places**2)[::-1] / total


def fibre_section(model: Model, material: CellField) -> FibreSection:
    """The fibres of a section's model.

    Raises
    ------
    MaterialError
        If the model has other elements than POJS, TRIS, QUAS, or a parameter is missing.
    """
    places, areas, moduli, zones, start = [], [], [], [], 0
    for zone in model.zones:
        if family_name(zone) != "fibre":
            raise MaterialError("kernel.elements.section-no-element", element=zone.element)
        given = zone_field(zone, material)
        at, own = fibre_places(zone, "STRESSES")[0], fibre_areas(zone, given, "STRESSES")
        each = [np.broadcast_to(m, own.shape).ravel() for m in fibre_moduli(given, "STRESSES")]
        places.append(at.reshape(-1, 2))
        areas.append(np.broadcast_to(own, at.shape[:2]).ravel())
        moduli.append(np.stack(each, axis=1))
        zones.append(SectionZone(zone, given, slice(start, start + own.size)))
        start += own.size
    return FibreSection(
        np.concatenate(places), np.concatenate(areas), np.concatenate(moduli), tuple(zones)
    )


def section_of_beam(parameters: ZoneField) -> FibreSection:
    """The section that MODS and MATS give to a zone of beams.

    Raises
    ------
    MaterialError
        If the beams of the zone have different sections.
    """
    found = []
    for name in ("MODS", "MATS"):
        if name not in parameters:
            raise missing_parameter(parameters.zone, name, parameters.names)
        values = parameters.raw(name)[0].ravel()
        if any(v is not values[0] for v in values):
            raise MaterialError("kernel.elements.beams-zone-different-sections", name=name)
        found.append(values[0])
    return fibre_section(*found)
