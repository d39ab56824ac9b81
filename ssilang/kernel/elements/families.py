"""The families of elements by name, and the quantities of a zone computed through them."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MaterialError, MeshError
from ssilang.kernel.elements import zone_fields
from ssilang.kernel.elements.beams.bar import Across, Bar, Hoop
from ssilang.kernel.elements.beams.beam import Beam, FibreBeam, Timoshenko
from ssilang.kernel.elements.beams.fibre_section import Fibre
from ssilang.kernel.elements.beams.pipe import Pipe
from ssilang.kernel.elements.catalog import ELEMENTS, family_name
from ssilang.kernel.elements.family import (
    ElementFamily,
    apply_moduli,
    cell_block,
    element_matrices,
)
from ssilang.kernel.elements.shells.meridian_shell import MeridianShell
from ssilang.kernel.elements.shells.plate import Mindlin, Plate
from ssilang.kernel.elements.shells.solid_shell import SolidShell
from ssilang.kernel.elements.shells.thick_shell import ThickShell
from ssilang.kernel.elements.solids import solid_moduli
from ssilang.kernel.elements.solids.solid import Incompressible, OnePoint, Solid
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Zone, same_elements
from ssilang.kernel.matrices.matrix import ElementMatrices, diagonal_matrices

_OTHER = 1e-3  # of a stiffness: what differs more was given otherwise

FAMILIES: dict[str, ElementFamily] = {
    "solid": Solid(),
    "incompressible": Incompressible(),
    "one point": OnePoint(),
    "bar": Bar(),
    "hoop": Hoop(),
    "across": Across(),
    "beam": Beam(),
    "timoshenko": Timoshenko(),
    "pipe": Pipe(),
    "mindlin": Mindlin(),
    "thick": ThickShell(),
    "plate": Plate(),
    "meridian": MeridianShell(),
    "solid shell": SolidShell(),
    "fibre": Fibre(),
    "fibre beam": FibreBeam(),
}


def register_family(name: str, family: ElementFamily) -> None:
    """Add a family of elements (used by packages that bring their own)."""
    FAMILIES[name] = family


def family_of(zone: Zone) -> ElementFamily:
    """The family of a zone's element.

    Raises
    ------
    MeshError
        If the element only carries fields and pressures.
    """
    if "SECTION" in zone.behaviour:
        return FAMILIES["fibre beam"]
    family = FAMILIES.get(family_name(zone))
    if family is None:
        alike = [k for k in ELEMENTS.values() if k.cell_type == zone.cells.cell_type]
        others = [k.name for k in alike if k.family in FAMILIES and zone.mode in k.modes]
        raise MeshError(
            "kernel.elements.element-carries-fields-pressures", element=zone.element, others=others
        )
    return family


def moduli_of(zone: Zone, material: zone_fields.ZoneField, support: Support) -> FloatArray:
    """Moduli from a field of Hooke matrices if there is one, else from parameters."""
    given = solid_moduli.moduli_from_field(material, support)
    return family_of(zone).moduli(zone, material, support) if given is None else given


def stiffness(zone: Zone, material: CellField) -> ElementMatrices:
    """Elastic stiffness of a zone.

    Parameters
    ----------
    material : CellField
        Parameters (YOUN, NU ...) or Hooke matrices (MAHO), with the geometric ones (SECT ...).

    Raises
    ------
    MaterialError
        For a missing or inadmissible parameter.
    """
    family, parameters = family_of(zone), zone_fields.zone_field(zone, material)
    whole = family.whole_matrices(zone, parameters, "RIGIDITE")
    if whole is not None:
        return element_matrices(zone, whole[1], whole[0], "RIGIDITE")
    moduli = moduli_of(zone, parameters, "RIGIDITE")
    values = family.stiffness_values(zone, moduli, parameters)
    made = element_matrices(zone, family.layout(zone), values, "RIGIDITE")
    dense = "RHO" in parameters and bool(np.any(parameters.raw("RHO")[0]))
    return replace(made, viscous="VISQ" in parameters, dense=dense)


def unlike(given: Iterable[ElementMatrices], zone: Zone, material: CellField) -> float:
    """How far the stiffness that a zone has is from what a material gives, of its largest entry.

    0. below a thousandth, or where the zone has none or one of another form. A zone of the same
    law on the same cells is the zone, whatever model it stands in.
    """
    laws = ((b.values, b.zone) for b in given if same_elements(b.zone, zone))
    mine = [values for values, z in laws if z and z.behaviour == zone.behaviour]
    own = stiffness(zone, material).values if mine else np.zeros(0)
    if not mine or mine[0].shape != own.shape or not (most := np.abs(own).max(initial=0.0)):
        return 0.0
    off = float(np.abs(sum(mine) - own).max()) / most
    return off if off > _OTHER else 0.0


def viscosity(zone: Zone, material: CellField) -> ElementMatrices:
    """Viscous damping of a zone: its stiffness with VISQ in the place of YOUN, or dashpots."""
    family, given = family_of(zone), zone_fields.zone_field(zone, material)
    whole = family.whole_matrices(zone, given, "AMORTISSEMENT")
    if whole is not None:
        return element_matrices(zone, whole[1], whole[0], "AMORTISSEMENT", keep_zone=False)
    if "VISQ" not in given and "MATS" not in given:
        raise zone_fields.missing_parameter(zone, "VISQ", given.names)
    parameters = renamed(given, {"VISQ": "YOUN"})
    moduli = family.moduli(zone, parameters, "RIGIDITE")
    values = family.stiffness_values(zone, moduli, parameters)
    return element_matrices(zone, family.layout(zone), values, "AMORTISSEMENT", keep_zone=False)


def mass(zone: Zone, material: CellField, lumped: bool = False) -> ElementMatrices:
    """Mass of a zone: consistent, or lumped on the diagonal.

    Lumping sums rows for linear continuous elements and bars; elsewhere it scales the diagonal
    so that the total mass in each direction is kept (Hinton, Rock, Zienkiewicz 1976).
    """
    family, parameters = family_of(zone), zone_fields.zone_field(zone, material)
    values, layout = family.mass_values(zone, parameters)
    if lumped:
        turning = any(u.startswith("R") for u in layout.unknowns)
        if zone.cells.kind.degree > 1 or turning:
            values = scaled_diagonal(values, layout.unknowns)
        else:
            values = diagonal_matrices(values.sum(axis=2))
    return element_matrices(zone, layout, values, "MASSE", keep_zone=False)


def scaled_diagonal(values: FloatArray, unknowns: tuple[str, ...]) -> FloatArray:
    """Diagonal matrices in proportion to the diagonal, keeping the mass of each translation."""
    diagonal = np.einsum("cii->ci", values)
    out = np.empty_like(diagonal)
    moving = [u for u in dict.fromkeys(unknowns) if u[0] == "U"]
    ratios = {}
    for name in moving:
        columns = [i for i, u in enumerate(unknowns) if u == name]
        block = values[:, columns][:, :, columns]
        ratios[name] = block.sum(axis=(1, 2)) / diagonal[:, columns].sum(axis=1)
    mean = np.mean(list(ratios.values()), axis=0)
    for i, name in enumerate(unknowns):
        out[:, i] = diagonal[:, i] * ratios.get(name, mean)
    return diagonal_matrices(out)


def geometric_stiffness(
    zone: Zone, stress: CellField, material: CellField | None = None
) -> ElementMatrices:
    """Geometric stiffness of a stress field."""
    family = family_of(zone)
    values = components_of(zone, stress, family.stress_names(zone))
    matrices = family.geometric_values(zone, values, zone_fields.zone_field(zone, material))
    return element_matrices(zone, family.layout(zone), matrices, "RIGIDITE", keep_zone=False)


def strain(
    zone: Zone, displacement: NodeField, material: CellField | None = None
) -> CellFieldBlock:
    """Strains at the points of 'STRESSES'."""
    family = family_of(zone)
    values = family.strain_values(zone, displacement, zone_fields.zone_field(zone, material))
    return cell_block(zone, family.strain_names(zone), values)


def stress(zone: Zone, material: CellField, displacement: NodeField) -> CellFieldBlock:
    """Elastic stresses (section forces for bars and beams) at the points of 'STRESSES'."""
    family, parameters = family_of(zone), zone_fields.zone_field(zone, material)
    moduli = moduli_of(zone, parameters, "STRESSES")
    values = family.stress_values(zone, displacement, moduli, parameters)
    return cell_block(zone, family.stress_names(zone), values)


def elastic_stress(zone: Zone, material: CellField, strains: CellField) -> CellFieldBlock:
    """Stresses of given strains."""
    family, parameters = family_of(zone), zone_fields.zone_field(zone, material)
    moduli = moduli_of(zone, parameters, "STRESSES")
    values = apply_moduli(moduli, components_of(zone, strains, family.strain_names(zone)))
    return cell_block(zone, family.stress_names(zone), values)


def elastic_strain(zone: Zone, material: CellField, stresses: CellField) -> CellFieldBlock:
    """Strains of given stresses.

    Raises
    ------
    MaterialError
        If the moduli cannot be inverted (a beam whose shear is neglected).
    """
    family, parameters = family_of(zone), zone_fields.zone_field(zone, material)
    compliance = compliance_of(zone, parameters)
    values = apply_moduli(compliance, components_of(zone, stresses, family.stress_names(zone)))
    return cell_block(zone, family.strain_names(zone), values)


def compliance_of(zone: Zone, parameters: zone_fields.ZoneField) -> FloatArray:
    """Compliance (n_cells or 1, n_points or 1, s, s) at the points of 'STRESSES'."""
    family = family_of(zone)
    if isinstance(family, Solid) and "MAHO" not in parameters:
        return solid_moduli.solid_compliance(zone, parameters, "STRESSES")
    if isinstance(family, Solid) and zone.mode is Mode.PLANE_STRESS:
        raise MaterialError("kernel.elements.hooke-matrix-of-plane-stress", element=zone.element)
    return solid_moduli.inverted(zone, moduli_of(zone, parameters, "STRESSES"))


def internal_forces(
    zone: Zone, stresses: CellField, material: CellField | None = None
) -> NodeField:
    """Nodal forces in balance with a stress field (BSIG)."""
    family = family_of(zone)
    values = components_of(zone, stresses, family.stress_names(zone))
    vectors = family.force_vectors(zone, values, zone_fields.zone_field(zone, material))
    return family.layout(zone).scatter(vectors)


def integration_weights(
    zone: Zone, support: Support, material: CellField | None = None
) -> FloatArray:
    """Weights (n_cells, n_points) that integrate over a zone (thickness or 2 pi r included)."""
    return family_of(zone).weights(zone, zone_fields.zone_field(zone, material), support)


def plastic_strain_names(zone: Zone) -> tuple[str, ...]:
    """EIXX EIYY EIZZ GIXY ..., EISS in bars, GIXY CIX ... of beams."""
    return inelastic(family_of(zone).strain_names(zone))


def inelastic(names: tuple[str, ...]) -> tuple[str, ...]:
    """Names of inelastic strains of those of strains: EIXX of EPXX, FRN DRN, FEPS EPS, FFCX CX."""
    return tuple(map(_inelastic, names))


def _inelastic(name: str) -> str:
    if name[0] == "D":
        return "F" + name[1:]
    return "F" + name.rjust(3, "F") if len(name) < 4 else name[0] + "I" + name[2:]


def components_of(zone: Zone, field: CellField, names: tuple[str, ...]) -> FloatArray:
    """Components (n_cells, n_names, n_points) at 'STRESSES', zero where absent."""
    seen = zone_fields.zone_field(zone, field)
    if not any(name in seen for name in names):
        raise zone_fields.none_of(names, zone, seen)
    return seen.matrix(names, "STRESSES")


def renamed(parameters: zone_fields.ZoneField, names: dict[str, str]) -> zone_fields.ZoneField:
    """The same field with some components under other names (others of that name are dropped)."""
    parts = tuple((_renamed(block, names), rows) for block, rows in parameters.parts)
    return zone_fields.ZoneField(parameters.zone, parts)


def _renamed(block: CellFieldBlock, names: dict[str, str]) -> CellFieldBlock:
    """The same block under other names, in the sections of its beams (MATS) as well."""
    kept = {names.get(n, n): v for n, v in block.components.items() if n not in names.values()}
    if "MATS" in kept:
        inside = kept["MATS"].flat[0]
        section = replace(inside, blocks=tuple(_renamed(b, names) for b in inside.blocks))
        kept["MATS"] = np.full(kept["MATS"].shape, section, dtype=object)
    return replace(block, components=kept)
