"""Characteristics of PASAPAS that depend on temperature, or on other fields of the load.

Each time has the characteristics of its own fields. Elastic strains stay while moduli change:
stresses are D(T) (strain - thermal strain - plastic strain) at all times.
"""

from ssilang.kernel.elements.catalog import support_rule
from ssilang.kernel.elements.families import family_of, moduli_of
from ssilang.kernel.elements.family import apply_moduli, cell_block
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.interface.elements import is_joint
from ssilang.kernel.interface.laws.law_table import law_of
from ssilang.kernel.statics.thermal_load import split_strains
from ssilang.operators.fields.cell_extraction import depended_on
from ssilang.operators.fields.cell_supports import placed
from ssilang.operators.fields.variation import beyond_laws, evaluated
from ssilang.operators.prelude import *
from ssilang.operators.statics.loads_in_time import tire_by_names
from ssilang.operators.statics.pasapas_contact import Zones, stress_offsets
from ssilang.operators.statics.pasapas_results import Stresses

ACTING = ("", "MECA", "FORC", "DIMP", "DEFI", "PRES")
"""Parts of a load that no characteristic depends on."""


class Varying:
    """Characteristics as laws of the fields that a load gives in time.

    Attributes
    ----------
    outer : Load
        Fields that they may depend on, none where all are numbers.
    acting : tuple of LoadPart
        The load without those that serve them alone: temperatures also strain.
    """

    def __init__(self, model: Model | None, material: CellField | None, parts: "Parts") -> None:
        zones = () if model is None else model.zones
        self.model = Model(tuple(z for z in zones if z.formulation == "MECANIQUE"))
        self.material = material
        wanted = () if material is None else depended_on(material).values
        self.outer = Load(tuple(p for p in parts if wanted and p.name.strip() not in ACTING))
        self.acting = tuple(p for p in parts if p not in self.outer.parts or p.name.strip() == "T")

    def fields(self, time: float) -> list[Any]:
        """The fields at a time."""
        return [value for _, value in tire_by_names(self.outer, time).items()]

    def at(self, fields: list[Any]) -> CellField | None:
        """The characteristics where fields are so."""
        if self.material is None or not fields:
            return self.material
        blocks = (b for f in fields for b in placed(self.model, f, "STRESSES").blocks)
        return evaluated(self.material, CellField(tuple(blocks)), "STRESSES")

    def beyond(self, fields: list[Any]) -> Iterator[dict[str, Any]]:
        """Characteristics that fields ask for outside of their law."""
        blocks = (b for f in fields for b in placed(self.model, f, "STRESSES").blocks)
        if self.material is not None:
            yield from beyond_laws(self.material, CellField(tuple(blocks)))

    def reference(self) -> tuple[LoadPart, ...]:
        """Less the strains ALPH (TREF - TALP): at TREF there is none."""
        blocks = []
        for zone in self.model.zones:
            seen = zone_field(zone, self.material)
            if "TREF" not in seen or (is_joint(zone) and not law_of(zone.behaviour).linear):
                continue
            shape = (len(zone.cells), len(support_rule(zone.element, "STRESSES")))
            free = {"T": np.broadcast_to(seen.at("TREF", "STRESSES"), shape)}
            cold = CellField((zone.block(free),))
            alone = Varying(Model((zone,)), self.material, self.outer.parts)
            material = alone.at([cold] if self.outer.parts else [])
            assert material is not None
            strain = -thermal_strain(zone, material, cold)
            if strain.any():
                blocks.append(cell_block(zone, family_of(zone).strain_names(zone), strain))
        return (LoadPart("DEFI", CellField(tuple(blocks), "DEFORMATIONS")),) if blocks else ()


Parts = tuple[LoadPart, ...]


def same_fields(first: list[Any], second: list[Any]) -> bool:
    """Whether fields have the same values at the same places."""
    return [_values(f) for f in first] == [_values(f) for f in second]


def _values(field: NodeField | CellField) -> list[bytes]:
    if isinstance(field, NodeField):
        return [a.tobytes() for v in field.components.values() for a in (v.nodes, v.values)]
    return [np.asarray(v).tobytes() for b in field.blocks for v in b.components.values()]


def offsets_of(
    zones: Zones, before: Zones, loads: tuple[Load | None, Load | None], given: CellField,
    displacement: object, time: float,
) -> dict[int, CellFieldBlock]:  # fmt: skip
    """Stresses that displacements and expansion do not explain, by identity of the zone.

    Parameters
    ----------
    zones, before : the same zones, with characteristics from this time on and up to it
    loads : with the free strains after and before
    """
    found: dict[int, CellFieldBlock] = {}
    for pair, old in zip(zones, before, strict=True):
        zone, material = pair
        same = old[1] is material or not _covered(zone, old[1])
        told, load = (pair, loads[0]) if same else (old, loads[1])
        thermal = split_strains(load, [told])[1]
        offset = stress_offsets([told], Stresses([told], thermal), given, displacement, time)
        if offset and not same:
            names, block = family_of(zone).stress_names(zone), offset[id(zone)]
            values = np.stack([block.components[n] for n in names], axis=1)
            old_moduli, moduli = (
                moduli_of(zone, zone_field(zone, m), "STRESSES") for m in (old[1], material)
            )
            change = (moduli - old_moduli) @ np.linalg.pinv(old_moduli, hermitian=True)
            offset = {id(zone): cell_block(zone, names, values + apply_moduli(change, values))}
        found |= offset
    return found


def _covered(zone: Zone, material: CellField) -> bool:
    """Whether all cells of a zone have characteristics."""
    known = np.zeros(len(zone.cells), bool)
    for _, rows in zone_field(zone, material).parts:
        known |= True if rows is None else rows >= 0
    return bool(known.all())
