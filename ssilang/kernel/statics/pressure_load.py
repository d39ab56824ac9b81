"""Loads PRES of a calculation: fields of pressure on loaded sides, as nodal forces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.curves.curve import Load, LoadPart
from ssilang.kernel.elements.loads.loads import pressure_vectors, total
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model, Zone

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
