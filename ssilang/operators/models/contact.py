"""MODE ... 'CONTACT': two sides that must not go into each other, cables that slide in a body."""

from ssilang.kernel.contact.unilateral import ContactRelations, Rubbing, contact_relations
from ssilang.kernel.elements.catalog import by_cells
from ssilang.kernel.elements.solids.kinematics import NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import missing_parameter, zone_field
from ssilang.operators.prelude import *

METHODS = ("MESC", "SYME", "FAIB", "MORT")
COULOMB = ("FROTTANT", "COULOMB")
FROCABLE = ("FROTTANT", "FROCABLE")
ELEMENTS = by_cells("contact")
"""Names under which fields in cells know the sides."""


def contact_model(
    call: Call, sides: Iterable[tuple[Mesh, Mesh, str]], rubbing: bool, ws: Workspace
) -> Model:
    """A model of pairs of sides, each with its method."""
    zones: list[Zone] = []
    for master, slave, method in sides:
        if ws.mode.dimension < 2:
            raise call.error("operators.models.contact-needs-dimensions", slave)
        bad = next((b.cell_type for b in master.blocks if b.cell_type not in ELEMENTS), None)
        if bad is not None:
            raise call.error("operators.models.contact-side-cells", master, bad=bad)
        whole = {"method": method, "master": master, "slave": slave}
        behaviour = COULOMB if rubbing else ("UNILATERAL",)
        zones += (
            Zone(b, "CONTACT", behaviour, ELEMENTS[b.cell_type], ws.mode, "", dict(whole))
            for b in master.blocks
        )
    return Model(tuple(zones))


_Pair = tuple[set[tuple[object, ...]], set[tuple[object, ...]]]


def sides_in(call: Call, mesh: Mesh) -> list[tuple[Mesh, Mesh, str]]:
    """Sides and methods of the contact meshes of IMPO 'MAIL' that a mesh holds.

    Two sides touch once: what was said of them last counts, of the whole before a part.
    """
    held, found, taken = _cells(mesh), list[tuple[Mesh, Mesh, str]](), list[_Pair]()
    last_first = reversed(workspace(call.session).sides)
    for sides in sorted(last_first, key=lambda s: -s[0].n_cells - s[1].n_cells):
        a, b = _cells(sides[0]), _cells(sides[1])
        of_others = any((a <= c and b <= d) or (a <= d and b <= c) for c, d in taken)
        if a | b <= held and not of_others:
            found.append(sides)
            taken.append((a, b))
    if not found:
        raise call.error("operators.models.no-sides-in-mesh", mesh)
    return found


def _cells(mesh: Mesh) -> set[tuple[object, ...]]:
    return {(b.cell_type, *cell) for b in mesh.blocks for cell in b.connectivity.tolist()}


def cable_model(call: Call, line: Mesh, cables: Model | None, body: Mesh, ws: Workspace) -> Model:
    """A cable (its mechanical model may be named) and the body that it slides in."""
    if ws.mode.dimension < 2 or ws.mode.value in ("AXIS", "FOUR"):
        raise call.error("operators.models.cable-friction-needs-dimensions", body)
    bad = next((b.cell_type for b in line.blocks if b.cell_type != "SEG2"), None)
    if bad is not None:
        raise call.error("operators.models.cable-is-a-line", line, bad=bad)
    whole = {"body": body, "cables": cables}
    return Model(
        tuple(
            Zone(b, "CONTACT", FROCABLE, ELEMENTS["SEG2"], ws.mode, "", dict(whole))
            for b in line.blocks
        )
    )


def model_relations(model: Model, material: CellField | None) -> list[ContactRelations]:
    """Relations of all pairs of sides of a model, each pair once."""
    found, seen = [], set()
    for zone in model.zones:
        master, slave = zone.options.get("master"), zone.options.get("slave")
        if zone.formulation != "CONTACT" or not isinstance(master, Mesh):
            continue
        assert isinstance(slave, Mesh)
        key = (id(master), id(slave), zone.options["method"])
        if key in seen:
            continue
        seen.add(key)
        names = NODE_TRANSLATIONS[zone.mode]
        made = contact_relations(
            zone.cells.nodes, names, master, slave, str(zone.options["method"]),
            uniform(zone, material, "JEU", 0.0), _rubbing(zone, material),
        )  # fmt: skip
        if made is not None:
            found.append(made)
    return found


def _rubbing(zone: Zone, material: CellField | None) -> Rubbing | None:
    """Coulomb's friction of a pair of sides, None where they are smooth."""
    if zone.behaviour != COULOMB:
        return None
    coefficient = uniform(zone, material, "MU", None)
    cohesion = uniform(zone, material, "COHE", 0.0)
    if coefficient < 0.0 or cohesion < 0.0:
        raise MaterialError("operators.models.friction-not-negative")
    return Rubbing(coefficient, cohesion, zone.mode is Mode.AXISYMMETRIC)


def uniform(zone: Zone, material: CellField | None, name: str, default: float | None) -> float:
    """The one value of a parameter for a pair of sides.

    Raises
    ------
    MaterialError
        If it varies, or is missing without a default.
    """
    given = zone_field(zone, material)
    if name not in given:
        if default is None:
            raise missing_parameter(zone, name, given.names)
        return default
    values = given.numbers(name)[0]
    if float(values.max() - values.min()) > 1e-12 * abs(float(values.max())):
        raise MaterialError("operators.models.contact-parameter-varies", name=name)
    return float(values.flat[0])
