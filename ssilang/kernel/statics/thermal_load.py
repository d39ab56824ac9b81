"""Free strains and pressures in a load, as nodal forces; the stresses to take off."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Curve, CurvePart, Load, LoadPart
from ssilang.kernel.elements.families import elastic_stress, family_of
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.loads.loads import pressure_vectors, total
from ssilang.kernel.elements.loads.thermal import given_strain, thermal_strain
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.kinematics import joint_cells
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.stepping.problem.loading import TimeCurve, terms_of

FREE = ("T", "DEFI")
"""Loads that strain bodies without stress: temperatures, and strains as they are given."""


@dataclass(frozen=True, eq=False)
class ThermalStress:
    """Stress of a fully restrained free strain of one zone, times a curve in time."""

    zone: Zone
    block: CellFieldBlock
    curve: TimeCurve

    def taken_off(self, given: CellFieldBlock, time: float) -> CellFieldBlock:
        """`given` less this stress at a time."""
        factor = float(np.interp(time, *self.curve))
        components = {k: v - factor * self.block.components[k] for k, v in given.components.items()}
        return replace(given, components=components)


def check_strains(load: Load | None, zones: tuple[Zone, ...], moving: bool) -> None:
    """Free strains are fields of strains that the bodies have, in small displacements.

    Joints take given ones where their law is linear.

    Parameters
    ----------
    zones : all bodies and joints
    moving : bool
        Whether they are in finite displacements, whose laws take no free strains.

    Raises
    ------
    FieldError
        If a strain stands on no body, or on joints whose law is not linear, or bodies move far.
    """
    for part in load.parts if load is not None else ():
        name = part.name.strip()
        if name not in FREE:
            continue
        if moving:
            raise FieldError("kernel.statics.free-strains-in-large-displacements", name=name)
        if name == "DEFI":
            _check_names([field for field, _ in terms_of(part)], zones)


def _check_names(fields: list[object], zones: tuple[Zone, ...]) -> None:
    taking = [z for z in zones if not is_joint(z) or law_of(z.behaviour).linear]
    wanted = {n for z in taking for n in family_of(z).strain_names(z)}
    for field in fields:
        if not isinstance(field, CellField):
            raise FieldError("kernel.statics.given-strain-is-no-field-in-cells")
        if any(given_strain(z, field).any() for z in zones if z not in taking):
            raise FieldError("kernel.statics.given-strain-of-joints")
        found = {n for z in taking for n in zone_field(z, field).names}
        if not found or not found <= wanted:
            told = {"given": sorted(found - wanted), "wanted": sorted(wanted)}
            raise FieldError("kernel.statics.given-strain-names", **told)


def split_strains(
    load: Load | None, zones: list[tuple[Zone, CellField]]
) -> tuple[Load | None, list[ThermalStress]]:
    """The load with its free strains (T, DEFI) turned into forces, and their stresses.

    Strains of T are ALPH (T - TALP); `zones` are those that strain, with their characteristics.
    """
    if load is None or not any(p.name.strip() in FREE for p in load.parts):
        return load, []
    kept = [p for p in load.parts if p.name.strip() not in FREE]
    stresses = [
        ThermalStress(zone, _restrained(zone, material, strain), curve)
        for zone, material in zones
        for strain, curve in free_terms(load, zone, material)
    ]
    parts = [_force(s, next(material for z, material in zones if z is s.zone)) for s in stresses]
    return Load((*kept, *parts)), stresses


def free_terms(
    load: Load | None, zone: Zone, material: CellField
) -> list[tuple[FloatArray, TimeCurve]]:
    """Strains (n_cells, n_strains, n_points) without stress, each with its curve in time.

    Those of T = 0, what each field of temperatures changes them by, and given ones (DEFI).
    """
    found: list[tuple[FloatArray, TimeCurve]] = []
    warm = _terms(load, "T")
    if warm:
        nodes = np.unique(zone.cells.connectivity)
        cold = NodeField(zone.cells.nodes, {"T": NodeValues(nodes, np.zeros(len(nodes)))})
        reference = thermal_strain(zone, material, _between_sides(zone, material, cold))
        found.append((reference, (np.zeros(1), np.ones(1))))
    for field, curve in warm:
        if not isinstance(field, NodeField | CellField):
            raise FieldError("kernel.statics.load-needs-field-temperatures")
        seen = _between_sides(zone, material, field)
        found.append((thermal_strain(zone, material, seen) - reference, curve))
    given = [(f, c) for f, c in _terms(load, "DEFI") if isinstance(f, CellField)]  # checked before
    return [*found, *((given_strain(zone, field), curve) for field, curve in given)]


def _between_sides(
    zone: Zone, material: CellField, field: NodeField | CellField
) -> NodeField | CellField:
    """Temperatures as a zone takes them: those of a joint are the mean of its two sides."""
    if not is_joint(zone) or isinstance(field, CellField):
        return field
    joints = joint_cells(zone, zone_field(zone, material))
    sides = field.values_at("T", joints.upper) + field.values_at("T", joints.lower)
    mean = sides / 2 @ joints.shape.T
    block = zone.block({"T": mean})
    return CellField((block,))


def _terms(load: Load | None, name: str) -> list[tuple[object, TimeCurve]]:
    parts = () if load is None else load.parts
    return [t for p in parts if p.name.strip() == name for t in terms_of(p)]


def _restrained(zone: Zone, material: CellField, strain: FloatArray) -> CellFieldBlock:
    """Stress of a strain that is held back."""
    block = cell_block(zone, family_of(zone).strain_names(zone), strain)
    return elastic_stress(zone, material, CellField((block,), "DEFORMATIONS"))


def _force(stress: ThermalStress, material: CellField) -> LoadPart:
    zone = stress.zone
    family = family_of(zone)
    names = family.stress_names(zone)
    values = np.stack([stress.block.components[n] for n in names], axis=1)
    vectors = family.force_vectors(zone, values, zone_field(zone, material))
    curve = Curve((CurvePart(*stress.curve),))
    return LoadPart("MECA", family.layout(zone).scatter(vectors), curve)


PRESSURE = "PRES"


def loaded_sides(model: Model) -> tuple[Zone, ...]:
    """Zones of loads of a model."""
    return tuple(z for z in model.zones if z.formulation == "CHARGEMENT")


def with_pressures(load: Load | None, sides: Sequence[Zone], moving: bool = False) -> Load | None:
    """The load with the forces of its pressures (along the sides' own normals) in their place.

    Parameters
    ----------
    sides : zones of the formulation CHARGEMENT
    moving : bool
        Whether the sides turn as they move: pressures then follow, and are left out here.

    Raises
    ------
    FieldError
        If there are no such sides.
    """
    if load is None or all(p.name.strip() != PRESSURE for p in load.parts):
        return load
    if not sides:
        raise FieldError("kernel.statics.pressure-without-sides")
    if moving:
        kept = tuple(p for p in load.parts if p.name.strip() != PRESSURE)
        return Load(kept) if kept else None
    return Load(tuple(_forces(p, sides) if p.name.strip() == PRESSURE else p for p in load.parts))


def pressures(load: Load | None) -> tuple[LoadPart, ...]:
    """Parts of a loading that are pressures."""
    return () if load is None else tuple(p for p in load.parts if p.name.strip() == PRESSURE)


def _forces(part: LoadPart, sides: Sequence[Zone]) -> LoadPart:
    """One loading with forces for pressures."""
    steps = tuple((t, along_normals(f, sides)) for t, f in part.steps)
    space = None if part.space is None else along_normals(part.space, sides)
    return replace(part, name="MECA", space=space, steps=steps)


def along_normals(field: object, sides: Sequence[Zone]) -> NodeField:
    """Forces of a field of pressure on sides, along their normals where they stand."""
    if not isinstance(field, CellField):
        raise FieldError("kernel.statics.pressure-is-no-field-in-cells")
    forces = [pressure_vectors(z, field) for z in sides]
    return total(forces[0].table, forces)
