"""Contact, friction and sliding cables of PASAPAS's model: conditions, least values, limits."""

from ssilang.kernel.contact.cable import Bars, CableRelations, cable_relations
from ssilang.kernel.contact.rows import Friction
from ssilang.kernel.elements.catalog import family_name
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.solids.kinematics import NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import cell_rows, zone_field
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix
from ssilang.kernel.plasticity.points import is_plastic
from ssilang.operators.models.contact import FROCABLE, model_relations
from ssilang.operators.prelude import *
from ssilang.operators.statics.pasapas_results import Stresses
from ssilang.operators.tables.entries import Entries


@dataclass(frozen=True, eq=False)
class Sides:
    """Conditions of the sides in contact, the values that they stay above, their friction."""

    matrix: Matrix | None = None
    gaps: NodeField | None = None
    friction: tuple[Friction, ...] = ()


def sides_of(
    model: Model | None, material: CellField | None, offsets: Mapping[int, CellFieldBlock]
) -> Sides:
    """What the zones CONTACT of a model ask for.

    Parameters
    ----------
    offsets : dict
        Stresses at zero displacement by identity of their zone: tensions of cables.
    """
    zones = () if model is None else model.zones
    if model is None or all(z.formulation != "CONTACT" for z in zones):
        return Sides()
    found = model_relations(model, material)
    cables = [_cable(z, model, material, offsets) for z in zones if z.behaviour == FROCABLE]
    table = model.mesh.nodes
    relations = (*(c.relations for c in found), *(c.ties for c in cables))
    friction = (
        *(c.friction for c in found if c.friction is not None),
        *(c.friction for c in cables),
    )
    if len({f.width for f in friction}) > 1:
        raise MaterialError("operators.statics.friction-of-sides-and-cables")
    gaps = None
    if found:
        nodes = np.concatenate([c.relations.multipliers for c in found])
        values = np.concatenate([c.distances for c in found])
        order = np.argsort(nodes, kind="stable")
        gaps = NodeField(table, {"FLX": NodeValues(nodes[order], values[order])}, "DISCRET")
    return Sides(Matrix(table, (), relations) if relations else None, gaps, friction)


def _cable(
    zone: Zone, model: Model, material: CellField | None, offsets: Mapping[int, CellFieldBlock]
) -> CableRelations:
    body = zone.options["body"]
    assert isinstance(body, Mesh)
    given = zone_field(zone, material)
    n = len(zone.cells)
    angular, linear = (
        np.broadcast_to(given.at(name, "GRAVITE").mean(axis=1), n) for name in ("FF", "PHIF")
    )
    stiffness, tension = _of_bars(zone, model, material, offsets)
    bars = Bars(zone.cells.connectivity, stiffness, tension, angular, linear)
    line = Mesh(zone.cells.nodes, (zone.cells,))
    return cable_relations(line, bars, body, NODE_TRANSLATIONS[zone.mode])


def _of_bars(
    zone: Zone, model: Model, material: CellField | None, offsets: Mapping[int, CellFieldBlock]
) -> tuple[FloatArray, FloatArray]:
    """E S / L of the bars on a cable's cells, and their tensions at zero displacement."""
    named = zone.options.get("cables")
    zones = named.zones if isinstance(named, Model) else model.zones
    cells = zone.cells
    x = cells.nodes.coordinates[cells.connectivity][..., : zone.mode.dimension]
    length = np.linalg.norm(x[:, 1] - x[:, 0], axis=1)
    stiffness, tension = np.zeros(len(cells)), np.zeros(len(cells))
    known = np.zeros(len(cells), bool)
    for bar in zones:
        if bar.formulation != "MECANIQUE" or family_name(bar) != "bar":
            continue
        rows = cell_rows(bar.cells, cells)
        on = np.flatnonzero(rows >= 0)
        if len(on) == 0:
            continue
        if is_plastic(bar):
            raise MaterialError("operators.statics.cable-not-elastic")
        given = zone_field(bar, material)
        section = given.at("YOUN", "GRAVITE") * given.at("SECT", "GRAVITE")
        stiffness[on] = _by_cell(section, rows[on]) / length[on]
        start = offsets.get(id(bar))
        if start is not None:
            tension[on] = _by_cell(np.asarray(start.components["EFFX"], dtype=float), rows[on])
        known[on] = True
    if not known.all():
        raise MaterialError("operators.statics.cable-without-bars")
    return stiffness, tension


def _by_cell(values: FloatArray, rows: IntArray) -> FloatArray:
    mean = values.mean(axis=1)
    return mean[rows] if len(mean) > 1 else np.full(len(rows), mean[0])


# Initial stresses of PASAPAS that displacements do not explain; matrices of linear zones.

NEGLIGIBLE = 1e-12  # of the largest stress: rounding of a calculation that goes on

Zones = list[tuple[Zone, CellField]]


def stress_offsets(
    zones: Zones, stresses: Stresses, given: CellField, displacement: object, time: float
) -> dict[int, CellFieldBlock]:
    """Given stresses less those of the displacement, by identity of the zone."""
    found: dict[int, CellFieldBlock] = {}
    for zone, material in zones:
        seen = zone_field(zone, given)
        names = family_of(zone).stress_names(zone)
        if not any(n in seen for n in names):
            continue
        still = NodeField(zone.cells.nodes, {})
        field = displacement if isinstance(displacement, NodeField) else still
        now = Stresses([(zone, material)], stresses.thermal).at(field, time)[0]
        rest = {
            n: np.broadcast_to(seen.at(n, "STRESSES", 0.0), now.components[n].shape)
            - now.components[n]
            for n in names
        }
        size = max(float(np.abs(now.components[n]).max(initial=0.0)) for n in names)
        left = max(float(np.abs(v).max(initial=0.0)) for v in rest.values())
        if left > NEGLIGIBLE * max(size, left):
            found[id(zone)] = replace(now, components=rest)
    return found


def offset_load(offsets: dict[int, CellFieldBlock], zones: Zones) -> list[NodeField]:
    """Nodal forces that stand for the offsets, on the side of the loads."""
    forces: list[NodeField] = []
    for zone, material in zones:
        block = offsets.get(id(zone))
        if block is None:
            continue
        family = family_of(zone)
        names = family.stress_names(zone)
        values = -np.stack([block.components[n] for n in names], axis=1)
        vectors = family.force_vectors(zone, values, zone_field(zone, material))
        forces.append(family.layout(zone).scatter(vectors))
    return forces


def linear_blocks(
    zones: list[tuple[Zone, CellField]],
    kind: str,
    make: Callable[[Zone, CellField], ElementMatrices],
) -> list[ElementMatrices]:
    """What `make` gives for each zone, and one block for all MODAL and STATIQUE ones.

    Parameters
    ----------
    kind : str
        'RIGIDITE', 'MASSE' or 'AMORTISSEMENT'.
    """
    blocks = [make(z, m) for z, m in zones if not is_shape(z)]
    if any(is_shape(z) for z, _ in zones):
        shapes = shape_matrix(tuple(z for z, _ in zones), zones[0][1], kind)
        blocks += [] if shapes is None else [shapes]
    return blocks


def joined_matrix(
    entries: Entries, blocks: list[ElementMatrices], parts: tuple[Matrix | None, ...], kind: str
) -> Matrix:
    """The blocks of a model's zones and the matrices that a table gives, as one matrix."""
    given = [m for m in parts if m is not None]
    if not blocks and not given:
        return Matrix(entries.needed("MODELE").mesh.nodes, (), (), kind)
    table = blocks[0].table if blocks else given[0].table
    all_blocks = (*blocks, *(b for m in given for b in m.blocks))
    return Matrix(table, all_blocks, tuple(r for m in given for r in m.relations), kind)
