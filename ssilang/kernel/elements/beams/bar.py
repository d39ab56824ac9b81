"""Bars, lines that resist only lengthening, and points that stand for rings (CERC)
or, in generalised plane strain, for bars across the plane (POI1).
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import family
from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.shapes.geometry import line_geometry
from ssilang.kernel.elements.shapes.reference import shape_gradients
from ssilang.kernel.elements.solids.kinematics import NODE_TRANSLATIONS, harmonic
from ssilang.kernel.elements.solids.solid import circumference, section_strain, with_section
from ssilang.kernel.elements.zone_fields import ZoneField
from ssilang.kernel.fields.cell_field import Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Zone


def _geometry(
    zone: Zone, support: Support, cells: slice = slice(None)
) -> tuple[FloatArray, FloatArray, FloatArray]:
    dim = zone.mode.dimension
    xyz = zone.cells.nodes.coordinates[zone.cells.connectivity[cells]][..., :dim]
    return line_geometry(zone.cells.cell_type, xyz, support_rule(zone.element, support))


class Bar(family.ElementFamily):
    """Normal force EFFX = YOUN SECT EPSS along the line."""

    strains = ("EPSS",)
    stresses = ("EFFX",)

    def moduli(self, zone: Zone, parameters: ZoneField, support: Support) -> FloatArray:
        """YOUN SECT."""
        value = parameters.at("YOUN", support) * parameters.at("SECT", support)
        return value[..., None, None]

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Derivative of the displacement along the line, projected on the line."""
        _, gradients, lengths = _geometry(zone, support, cells)
        n, p, d, k = gradients.shape
        matrix = gradients.transpose(0, 1, 3, 2).reshape(n, 1, p, k * d)
        return family.StrainOperator(matrix, lengths)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """Integral of RHO SECT N N^T in every direction."""
        shapes, _, lengths = _geometry(zone, "MASSE")
        density = parameters.at("RHO", "MASSE") * parameters.at("SECT", "MASSE")
        scalar = np.einsum("cp,pi,pj->cij", lengths * density, shapes, shapes)
        return family.spread(scalar, zone.mode.dimension), self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """Integral of EFFX N' N'^T in every direction (second-order strain of a line)."""
        _, gradients, lengths = _geometry(zone, "STRESSES")
        scalar = np.einsum("cp,cpdi,cpdj->cij", lengths * stress[:, 0], gradients, gradients)
        return family.spread(scalar, zone.mode.dimension)


def bar_stretch(zone: Zone, displacement: NodeField) -> FloatArray:
    """Length of the derivative of the displacement along the line, (n_cells, n_points)."""
    rule = support_rule(zone.element, "STRESSES")
    reference = shape_gradients(zone.cells.cell_type, rule.points)[:, :, 0]
    d = zone.mode.dimension
    x = zone.cells.coordinates[..., :d]
    speed = np.linalg.norm(np.einsum("pk,ckd->cpd", reference, x), axis=-1)
    layout = family.node_major_layout(zone.cells, NODE_TRANSLATIONS[zone.mode])
    u = layout.gather(displacement).reshape(len(zone.cells), -1, d)
    slopes = np.einsum("pk,ckd->cpd", reference, u) / speed[..., None]
    return np.linalg.norm(slopes, axis=-1)


def _radii(zone: Zone, cells: slice = slice(None)) -> FloatArray:
    """Radii (n, 1) of the rings."""
    nodes = zone.cells.connectivity[cells]
    radii: FloatArray = zone.cells.nodes.coordinates[nodes][..., 0]
    if (radii <= 0.0).any():
        here = int(zone.cells.nodes.resolve(nodes)[radii <= 0.0][0])
        raise MeshError("kernel.elements.hoop-on-axis", node=zone.cells.nodes.told(here))
    return radii


def _slopes_around(zone: Zone) -> FloatArray:
    """Change of a displacement along, out of and across a ring, times its radius, (3, d)."""
    n, d = harmonic(zone), len(NODE_TRANSLATIONS[zone.mode])
    return np.array([[1.0, 0.0, n], [-n, 0.0, -1.0], [0.0, -n, 0.0]])[:, :d]


class Hoop(Bar):
    """Normal force EFFX = YOUN SECT EPSS along the ring, EPSS = (UR + n UT) / r of harmonic n.

    Whole turns are summed. Rings do not bend.
    """

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """Lengthening over the radius: radial displacement and change along the ring."""
        radii = _radii(zone, cells)
        slopes = _slopes_around(zone)[0] / radii
        return family.StrainOperator(slopes[:, None, None], circumference(zone) * radii)

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """RHO SECT times the ring's length, in every direction."""
        density = parameters.at("RHO", "MASSE") * parameters.at("SECT", "MASSE")
        scalar = (circumference(zone) * _radii(zone) * density)[..., None]
        return family.spread(scalar, len(NODE_TRANSLATIONS[zone.mode])), self.layout(zone)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """EFFX / r^2 on what changes along the ring: the second-order part of its strain."""
        slopes = _slopes_around(zone)
        factors = circumference(zone) * stress[:, 0] / _radii(zone)
        return factors[..., None] * (slopes.T @ slopes)


class Across(Bar):
    """Normal force EFFX = YOUN SECT EPSS of bars across the plane, EPSS the section's EPZZ."""

    def layout(self, zone: Zone) -> family.Layout:
        """What the section's node has, its displacement and rotations."""
        return with_section(zone, family.node_major_layout(zone.cells, ()))

    def strain_operator(
        self, zone: Zone, parameters: ZoneField, support: Support, cells: slice
    ) -> family.StrainOperator:
        """The section's strain at the point, for a length of 1."""
        x, y = np.moveaxis(zone.cells.coordinates[cells], 2, 0)[:2]
        strain = section_strain(zone, x, y)
        return family.StrainOperator(strain[:, None], np.ones(strain.shape[:2]))

    def mass_values(self, zone: Zone, parameters: ZoneField) -> tuple[FloatArray, family.Layout]:
        """RHO SECT in the plane, for a length of 1."""
        density = parameters.at("RHO", "MASSE") * parameters.at("SECT", "MASSE")
        scalar = np.broadcast_to(density[..., None], (len(zone.cells), 1, 1))
        names = NODE_TRANSLATIONS[zone.mode]
        return family.spread(scalar, 2), family.node_major_layout(zone.cells, names)

    def geometric_values(self, zone: Zone, stress: FloatArray, parameters: ZoneField) -> FloatArray:
        """None: the bar stays straight."""
        return np.zeros((len(zone.cells), 3, 3))
