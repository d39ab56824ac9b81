"""What temperatures of a load or of EPTH leave open: where there are none, from what they rise."""

from ssilang.kernel.elements.zone_fields import ZoneField, zone_field
from ssilang.operators.prelude import *
from ssilang.operators.statics.loads_in_time import part_at
from ssilang.operators.tables.entries import Entries

EXPANDS = frozenset(
    ["ALPH", "ALP1", "ALP2", "ALP3", "ALPN", "ALPS", "ALQS", "ALQN", "ALQ1", "ALQ2", "ALQ3"]
)
_COLD = ("TALP", "TREF")  # temperatures from which bodies expand
NOUGHT = 1e-3  # of the largest temperature: less is none


def warn_of_temperatures(entries: Entries, times: FloatArray) -> None:
    """Warn of temperatures that bodies lack, that are not used, that rise from nought at once."""
    load, model, material = (entries.get(w) for w in ("CHARGEMENT", "MODELE", "CARACTERISTIQUES"))
    parts = [p for p in load.parts if p.name.strip() == "T"] if load else []
    fields = [part_at(p, float(times[0])) for p in parts]
    begun = entries.at("TEMPERATURES", 0)
    if isinstance(begun, NodeField) and all(isinstance(f, NodeField) for f in fields):
        said, used = (_total(fs, begun.node_ids) for fs in ([begun], fields))
        if (most := np.abs(said).max(initial=0.0)) * NOUGHT < np.abs(said - used).max(initial=0.0):
            entries.warn("operators.statics.temperatures-unused", most=most)
    if not (fields and model and material) or any(not isinstance(f, NodeField) for f in fields):
        return
    given = {n: v.dtype for b in material.blocks for n, v in b.components.items()}
    if not EXPANDS & given.keys() and np.dtype(object) not in given.values():
        entries.warn("operators.statics.no-expansion")
    nodes = np.concatenate([f.node_ids for f in fields])
    if len(lost := without(model, material, nodes)):
        told = {"count": len(lost), "node": fields[0].table.told(int(lost[0]))}
        entries.warn("operators.statics.temperature-missing", **told)
    later = [part_at(p, float(times[-1])) for p in parts]
    risen = _risen(model, material)
    first, last = (float(np.abs(_total(fs, risen)).max(initial=0.0)) for fs in (fields, later))
    if first > NOUGHT * max(first, last) and first != last:
        entries.warn("operators.statics.warm-from-the-start", first=first, last=last)


def without(model: Model, material: CellField, nodes: IntArray) -> IntArray:
    """Nodes (n,) of bodies that expand from another temperature than nought, beside `nodes`."""
    found = [nodes[:0]]
    for zone, seen in _expanding(model, material):
        if any(np.any(seen.at(n, "STRESSES", 0.0)) for n in _COLD):
            own = np.unique(zone.cells.connectivity)
            found.append(np.setdiff1d(own, zone.cells.nodes.resolve(nodes)))
    return np.unique(np.concatenate(found))


def _risen(model: Model, material: CellField) -> IntArray:
    """Nodes (n,) of bodies whose expansion counts from nought, that of no parameter."""
    cold = [z for z, s in _expanding(model, material) if not {*_COLD} & {*s.names}]
    return np.unique(
        np.concatenate([np.zeros(0, int), *(z.cells.connectivity.ravel() for z in cold)])
    )


def _expanding(model: Model, material: CellField) -> Iterable[tuple[Zone, ZoneField]]:
    for zone in model.zones:
        seen = zone_field(zone, material)
        rates = [seen.raw(n)[0] for n in EXPANDS.intersection(seen.names)]
        if any(r.dtype == object or r.any() for r in rates):
            yield zone, seen


def _total(fields: list[NodeField], nodes: IntArray) -> FloatArray:
    """The sums of temperatures at nodes (n,)."""
    return sum((f.values_at("T", nodes) for f in fields), np.zeros(len(nodes)))
