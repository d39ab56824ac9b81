"""MODE ... 'CONTACT': two sides that must not go into each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ssilang.kernel.elements.catalog import ElementKind, register_element
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.model import Mode, Model, Zone
from ssilang.language.call import Call
from ssilang.operators.workspace import Workspace

if TYPE_CHECKING:
    from ssilang.kernel.contact.unilateral import ContactRelations
    from ssilang.kernel.fields.cell_field import CellField

METHODS = ("MESC", "SYME", "FAIB", "MORT")
ELEMENTS = {"SEG2": "COS2", "TRI3": "COT3", "QUA4": "COQU"}
"""Names under which fields in cells know the sides."""

for _cell, _name in ELEMENTS.items():
    _points = {"SEG2": 2, "TRI3": 1, "QUA4": 4}[_cell]
    register_element(
        ElementKind(_name, _cell, "contact", tuple(Mode), {"RIGIDITE": _points}, default=False)
    )


def take_contact(call: Call, options: dict[str, Any]) -> bool:
    """Read one thing that stands behind CONTACT; False if none is next."""
    if call.keyword(["FROTTANT", "COULOMB", "FROCABLE"]) is not None:
        raise call.bad(
            "contact with friction between two meshes is not available",
            hint="joints (JOINT_SDM with FROT, COULOMB) rub; CONTACT UNILATERAL does not",
        )
    if call.keyword(["UNILATERAL"]) is not None:
        return True
    method = call.keyword(METHODS)
    if method is not None:
        options["method"] = method
        return True
    return False


def contact_model(call: Call, master: Mesh, options: dict[str, Any], ws: Workspace) -> Model:
    """A model of two sides, the first mesh read and the one that follows."""
    slave: Mesh = call.required("MAILLAGE")
    while call.peek_word() is not None and take_contact(call, options):
        pass
    if ws.mode.dimension < 2:
        raise call.bad("contact needs the plane or space", slave)
    bad = next((b.cell_type for b in master.blocks if b.cell_type not in ELEMENTS), None)
    if bad is not None:
        raise call.bad(
            f"a side of contact is made of SEG2 (plane), TRI3 or QUA4 (space), not {bad}", master
        )
    whole = {"method": "MESC", **options, "master": master, "slave": slave}
    return Model(
        tuple(
            Zone(b, "CONTACT", ("UNILATERAL",), ELEMENTS[b.cell_type], ws.mode, "", dict(whole))
            for b in master.blocks
        )
    )


def model_relations(model: Model, material: CellField | None) -> list[ContactRelations]:
    """Relations of all pairs of sides of a model, each pair once."""
    from ssilang.kernel.contact.unilateral import contact_relations
    from ssilang.kernel.elements.kinematics import NODE_TRANSLATIONS

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
            _distance(zone, material),
        )  # fmt: skip
        if made is not None:
            found.append(made)
    return found


def _distance(zone: Zone, material: CellField | None) -> float:
    """JEU, the least distance to keep; one value for a pair of sides."""
    from ssilang.kernel.elements.zone_fields import zone_field
    from ssilang.kernel.errors import MaterialError

    given = zone_field(zone, material)
    if "JEU" not in given:
        return 0.0
    values = given.raw("JEU")[0].astype(float)
    if float(values.max() - values.min()) > 1e-12 * abs(float(values.max())):
        raise MaterialError("JEU varies along a side of contact", "one value for a pair of sides")
    return float(values.flat[0])
