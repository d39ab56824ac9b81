"""PREC: tensions of prestressing cables. IMPF: kept for old scripts."""

from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.zone_fields import n_points, zone_field
from ssilang.kernel.statics.prestress import NO_LOSSES, Cable, Losses, cables_of, tensions
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

_ENTRIES = {
    "FF": "angular",
    "PHIF": "linear",
    "GANC": "slip",
    "RMU0": "threshold",
    "FPRG": "strength",
    "RH10": "relaxation",
}

PULLED = between(0.02, 1.0)
"""Of its strength: what cables are pulled to."""


@operator("PREC", family="model", full_name="PRECONTRAINTE")
def prec(
    call: Call,
    model: Model = Arg("MMODEL", en="cables, bars"),
    material: CellField = Arg("MCHAML", en="their parameters"),
    table: Table | None = Opt("TABLE", en="losses"),
    force: float = Arg("FLOTTANT", en="tension at the end", unit="N", usual=POSITIVE),
    ends: Mesh | Point | None = Opt(
        "MAILLAGE", "POINT", en="points that are pulled, else the last of each cable"
    ),
    before: CellField | None = Opt("MCHAML", en="not built"),
) -> CellField:
    """Tensions of all cables of a model."""
    if before is not None:
        raise call.error("operators.models.tensions-before-not-built")
    losses = None if table is None else _losses(call, table)
    chosen = None if ends is None else ends.sorted_node_ids
    return CellField(
        tuple(_zone(call, z, material, force, losses, chosen) for z in model.zones), "CONTRAINTES"
    )


def _losses(call: Call, table: Table) -> Losses:
    entries = Entries(call, table, "PREC")
    entries.check()
    return Losses(**{name: entries.get(index) for index, name in _ENTRIES.items()})


def _zone(
    call: Call,
    zone: Zone,
    material: CellField,
    force: float,
    losses: Losses | None,
    ends: IntArray | None,
) -> CellFieldBlock:
    if family_name(zone) != "bar" or zone.cells.cell_type != "SEG2":
        raise call.error("operators.models.cables-are-bars", element=zone.element)
    cells = zone.cells.connectivity
    x = zone.cells.nodes.coordinates[:, : zone.mode.dimension]
    seen = zone_field(zone, material)
    if losses is None:  # those of an ARMATURE
        own = {
            n: float(seen.at(w, "GRAVITE").flat[0]) for w, n in _ENTRIES.items() if w in seen.names
        }
        losses = Losses(**own) if own else NO_LOSSES
    section = seen.each("SECT")
    stiffness = section * seen.each("YOUN")
    share = force / float(section.min()) / losses.strength
    if losses.relaxation and force > 0.0 and share not in PULLED:
        call.warn("operators.models.cable-strength", force, share=share, strength=losses.strength)
    found = np.zeros(len(cells))
    for cable in cables_of(zone.cells.nodes, cells):
        b = cable.bars
        pulled = _pulled(call, zone.cells.nodes, cable, ends)
        found[b] = tensions(cable, x, pulled, force, stiffness[b], section[b], losses)
    points = n_points(zone.element, "STRESSES")
    values: FloatArray = np.repeat(found[:, None, None], points, axis=2)
    return cell_block(zone, ("EFFX",), values)


def _pulled(call: Call, nodes: NodeTable, cable: Cable, ends: IntArray | None) -> tuple[bool, bool]:
    if ends is None:
        return False, True
    found = (int(cable.nodes[0]) in ends, int(cable.nodes[-1]) in ends)
    if not any(found):
        told = {"first": nodes.told(cable.nodes[0]), "last": nodes.told(cable.nodes[-1])}
        raise call.error("operators.models.cable-end-not-pulled", **told)
    return found


@operator("IMPF", family="model", full_name="IMPF")
def impf(mesh: Mesh = Arg("MAILLAGE", en="mesh")) -> Mesh:
    """The mesh, unchanged."""
    return mesh
