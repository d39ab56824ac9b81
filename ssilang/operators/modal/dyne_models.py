"""Tables PASAPAS for DYNE: models MODAL and LIAISON with their parameters, read as its tables."""

from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.modal.shape_models import is_shape, shape_points
from ssilang.operators.prelude import *
from ssilang.operators.tables.entries import Entries

_LONG = {
    "NORM": "NORMALE", "RAID": "RAIDEUR", "JEU": "JEU", "GLIS": "COEFFICIENT_GLISSEMENT",
    "ADHE": "COEFFICIENT_ADHERENCE", "RTAN": "RAIDEUR_TANGENTIELLE",
    "ATAN": "AMORTISSEMENT_TANGENTIEL", "AMOR": "AMORTISSEMENT", "LOIC": "LOI_DE_COMPORTEMENT",
    "PERM": "LIAISON_PERMANENTE", "SPLA": "SEUIL_PLASTIQUE", "POIB": "POINT_B",
    "ECRO": "ECROUISSAGE", "ELAS": "COMPORTEMENT_ELASTIQUE", "PCER": "CERCLE", "RAYO": "RAYON",
    "CINT": "CONTACT_INTERIEUR", "EXCE": "EXCENTRATION", "RAYS": "RAYON_SUPPORT",
    "RAYB": "RAYON_BUTEE", "LIMA": "LIGNE_MAITRE", "LIES": "LIGNE_ESCLAVE", "RECH": "RECHERCHE",
    "SYME": "SYMETRIE", "ACTN": "ACTNOR", "INVE": "INVERSION", "ORIG": "ORIGINE",
    "COEF": "COEFFICIENT",
}  # fmt: skip
"""Parameters of MATE and the entries of a link's table that they stand for."""
_LOGICAL = ("PERM", "ELAS", "CINT", "ACTN", "INVE")
_WORDS = {"RECH": ("LOCALE", "GLOBALE"), "SYME": (None, "GLOBALE")}
_SUPPORTS = {"POINT_POINT": "POINT_A", "POINT_CERCLE_MOBILE": "POINT"}
"""Index of the cell's point, where it is not SUPPORT."""


def is_link(zone: Zone) -> bool:
    """Whether a zone is a link of DYNE."""
    return zone.formulation == "LIAISON"


def modal_table(model: Model, material: CellField) -> tuple[Table, dict[int, float]]:
    """Zones MODAL as a table BASE_MODALE, and dampings (N s/m) by the node that marks each."""
    shapes = shape_points(model.zones, material)
    modes = Table("BASE_DE_MODES")
    zones = (z for z in model.zones if is_shape(z))
    for number, (shape, zone) in enumerate(zip(shapes, zones, strict=True), start=1):
        entries: dict[str, Any] = {
            "POINT_REPERE": Point(shape.field.table, shape.node),
            "FREQUENCE": shape.frequency,
            "MASSE_GENERALISEE": shape.mass,
            "DEFORMEE_MODALE" if shape.unknown == "ALFA" else "DEFORMEE": shape.field,
        }
        given = zone_field(zone, material).own()
        if "CGRA" in given:
            entries |= {"CORPS_RIGIDE": True, "CENTRE_DE_GRAVITE": given.raw("CGRA")[0][0, 0]}
        modes.set(number, Table.of(entries, "MODE"))
    return Table.of({"MODES": modes}, "BASE_MODALE"), {s.node: s.damping for s in shapes}


def links_table(model: Model, material: CellField) -> tuple[Table, list[tuple[Zone, Table]]]:
    """Zones LIAISON as a table LIAISON, and the table of each with what it is asked for (SORT)."""
    numbered = Table("LIAISON_B")
    found = []
    for number, zone in enumerate((z for z in model.zones if is_link(z)), start=1):
        table = _link(zone, material)
        numbered.set(number, table)
        found.append((zone, table))
    return Table.of({"LIAISON_B": numbered}, "LIAISON"), found


def _parameters(zone: Zone, material: CellField) -> dict[str, Any]:
    given = zone_field(zone, material).own()
    return {n: given.raw(n)[0].ravel()[0] for n in given.names}


def _link(zone: Zone, material: CellField) -> Table:
    """One link as its table."""
    kind = "_".join(zone.behaviour)
    lines = kind.startswith("LIGNE")
    node = int(zone.cells.connectivity[0, 0])
    support = next((v for k, v in _SUPPORTS.items() if kind.startswith(k)), "SUPPORT")
    entries: dict[str, Any] = {"TYPE_LIAISON": Mot(kind), support: Point(zone.cells.nodes, node)}
    given = _parameters(zone, material)
    for name, value in given.items():
        if name in _LOGICAL:
            value = bool(value)
        elif name in _WORDS:
            value = _WORDS[name][int(value)]
        if name in _LONG and value is not None:
            plural = "S" if lines and name in ("RAID", "AMOR") else ""
            entries[_LONG[name] + plural] = value if isinstance(value, bool) else _plain(value)
    table = Table.of(entries, "LIAISON_ELEMENTAIRE")
    for number in range(1, 10):  # of POLYNOMIALE
        if f"PCO{number}" in given and f"TCO{number}" in given:
            table.set(given[f"PCO{number}"], given[f"TCO{number}"])
    return table


def _plain(value: Any) -> Any:
    """A number of an array as a number of a script."""
    return value.item() if hasattr(value, "item") else value


def wanted_of(zone: Zone, entries: Entries, material: CellField) -> tuple[Model | None, object]:
    """What is asked for of a link, and the model that names it.

    It stands in SORTIE at the link's model, in LIAISON_A or LIAISON_B there, or in its SORT.
    """
    output = entries.get("SORTIE")
    tables = [output, *(output.get(Mot(n)) for n in ("LIAISON_A", "LIAISON_B"))] if output else []
    tables.append(_parameters(zone, material).get("SORT"))
    for table in tables:
        if isinstance(table, Table):
            for index, value in table.items():
                if isinstance(index, Model) and any(z is zone for z in index.zones):
                    return index, value
    return None, False
