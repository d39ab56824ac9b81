"""SIGM EPSI BSIG ELAS EPTH THET: strains, stresses and the forces that balance them."""

from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.loads.loads import pressure_vectors, total
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.elements.results.integrals import green_strain, green_stress
from ssilang.kernel.elements.solids.gradients import gradient_names, logarithmic_strain
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.language.vocabulary import meanings
from ssilang.operators.matrices.element import NO_ERROR, joined, numbered, present
from ssilang.operators.prelude import *
from ssilang.operators.statics.solve import tell_other_stiffness
from ssilang.operators.statics.temperatures import EXPANDS, without

PARAMETERS = ("CARACTERISTIQUES", "MATRICE DE HOOKE")
"""Types of fields in cells that hold parameters."""


MODEL = arg("model", "MMODEL", en="model")
_of_folded = numbered("kernel.elements.jacobian-vanishes-changes-sign")
_FIELD = by("silent", {True: "MCHAML|ENTIER"}, default="MCHAML")
_FORCES = by("silent", {True: "CHPOINT|ENTIER"}, default="CHPOINT")
Fields = tuple[NodeField | CellField, ...]


def nodal_of(fields: Fields) -> tuple[NodeField, ...]:
    """The nodal ones of fields, in their order."""
    return tuple(f for f in fields if isinstance(f, NodeField))


def cells_of(fields: Fields) -> tuple[CellField, ...]:
    """Those in cells of fields, in their order."""
    return tuple(f for f in fields if isinstance(f, CellField))


def displacement_of(call: Call, fields: Fields, model: Model) -> NodeField:
    """The first nodal field, mandatory."""
    nodal = nodal_of(fields)
    if not nodal:
        raise call.missing(("CHPOINT",))
    tell_no_unknown(call, nodal[0], model)
    return nodal[0]


def tell_no_unknown(call: Call, field: NodeField, model: Model) -> None:
    """Warn of a field for displacements that has other components alone, or not all nodes."""
    known = {n: p.nodes for n, p in field.components.items() if n != "LX"}
    meant = (w for n in known for w in meanings("component", n))
    if not known or not model.zones:
        return
    if not any(w.kind == "unknown" for w in meant):
        call.warn("operators.statics.no-displacements", field, names=[*known])
        return
    wanted, nodes = model.mesh.sorted_node_ids, np.concatenate([*known.values()])
    if len(lost := np.setdiff1d(wanted, field.table.resolve(nodes))):
        told = {"count": len(lost), "wanted": len(wanted), "node": field.table.told(int(lost[0]))}
        call.warn("operators.statics.displacements-in-part", field, **told)


def joined_cells(call: Call, fields: Fields) -> CellField:
    """All fields in cells as one, at least one."""
    cells = cells_of(fields)
    if not cells:
        raise call.missing(("MCHAML",))
    return joined(cells)


def state_and_rest(fields: tuple[CellField, ...]) -> tuple[CellField, CellField | None]:
    """The field of stresses or strains, in whatever order, and the parameters as one."""
    state = next((f for f in fields if f.title not in PARAMETERS), fields[0])
    rest = tuple(f for f in fields if f is not state)
    return state, joined(rest) if rest else None


def on_zones(model: Model, title: str, make: Callable[[Zone], CellFieldBlock]) -> CellField:
    """A field in cells, zone by zone."""
    return CellField(tuple(make(z) for z in model.zones), title)


@operator(
    "SIGM",
    MODEL,
    many(
        "fields",
        "CHPOINT",
        "MCHAML",
        at_least=1,
        en="displacements, and parameters or Hooke matrices",
    ),
    NO_ERROR,
    choice(
        "order",
        ("LINE", "QUAD"),
        default="LINE",
        en="strains of first order (default), or of second order too",
    ),
    family="stress",
    full_name="SIGMA",
    gives=_FIELD,
)
@_of_folded
def sigm(call: Call, model: Model, fields: Fields, silent: bool, order: str) -> CellField:
    """Stresses."""
    u, material = displacement_of(call, fields, model), joined_cells(call, fields)
    compute = green_stress if order == "QUAD" else families.stress
    zones = present(call, model)
    if order == "LINE":
        tell_other_stiffness(call, u, zones, material)
    return on_zones(zones, "CONTRAINTES", lambda z: compute(z, material, u))


@operator(
    "EPSI",
    MODEL,
    many(
        "fields", "CHPOINT", "MCHAML", at_least=1, en="displacements and parameters, or gradients"
    ),
    NO_ERROR,
    choice(
        "measure",
        ("LINE", "QUAD", "TRUE", "JAUM", "UTIL"),
        default="LINE",
        en="first order (default), or of second order too; the other measures are not available",
    ),
    choice(
        "gradient",
        ("GEOM", "DEPL"),
        default="GEOM",
        en="what a field of gradients is: F (default), or F - 1 as GRAD gives it",
    ),
    family="stress",
    full_name="EPSILON",
    gives=_FIELD,
)
@_of_folded
def epsi(
    call: Call, model: Model, fields: Fields, silent: bool, measure: str, gradient: str
) -> CellField:
    """Strains."""
    if measure not in ("LINE", "QUAD"):
        raise call.error("operators.statics.strain-not-available", word=measure)
    zones, nodal, cells = present(call, model), nodal_of(fields), cells_of(fields)
    if not nodal:
        grad, by_displacement = joined(cells), gradient == "DEPL"
        return on_zones(zones, "DEFORMATIONS", lambda z: _logarithmic(z, grad, by_displacement))
    tell_no_unknown(call, nodal[0], model)
    material = joined(cells) if cells else None
    compute = green_strain if measure == "QUAD" else families.strain
    return on_zones(zones, "DEFORMATIONS", lambda z: compute(z, nodal[0], material))


def _logarithmic(zone: Zone, gradient: CellField, by_displacement: bool) -> CellFieldBlock:
    names = gradient_names(zone)
    seen = zone_field(zone, gradient)
    if not any(n in seen for n in names):
        raise FieldError(
            "operators.statics.no-displacement-no-gradient", names=names, seen=seen.names
        )
    values = seen.matrix(names, "STRESSES")
    strains = logarithmic_strain(zone, values, by_displacement)
    return cell_block(zone, families.family_of(zone).strain_names(zone), strains)


@operator(
    "BSIG",
    MODEL,
    many("fields", "MCHAML", at_least=1, en="stresses, or pressure, and parameters"),
    NO_ERROR,
    family="stress",
    full_name="BSIGMA",
    gives=_FORCES,
)
@_of_folded
def bsig(call: Call, model: Model, fields: tuple[CellField, ...], silent: bool) -> NodeField:
    """Internal forces."""
    stress, material = state_and_rest(fields)
    forces = [families.internal_forces(z, stress, material) for z in present(call, model).zones]
    loads = [z for z in model.zones if z.formulation == "CHARGEMENT"]
    forces += [pressure_vectors(z, stress, material) for z in loads]
    return total(forces[0].table, forces)


@operator("ELAS", family="stress", full_name="ELASTICITE")
def elas(
    call: Call,
    model: Model = MODEL,
    fields: tuple[CellField, ...] = Many(
        "MCHAML", at_least=1, en="stresses or strains, and parameters"
    ),
) -> CellField:
    """Hooke's law, either way."""
    zones = present(call, model)
    state = next((f for f in fields if _state(zones, f)), None)
    if state is None:
        raise call.error("operators.statics.no-stress-no-strain")
    rest = tuple(f for f in fields if f is not state)
    if not rest:
        raise call.missing(("MCHAML",))
    material = joined(rest)
    if _state(zones, state) == "strains":
        return on_zones(zones, "CONTRAINTES", lambda z: families.elastic_stress(z, material, state))
    return on_zones(zones, "DEFORMATIONS", lambda z: families.elastic_strain(z, material, state))


_THERMAL = many(
    "fields",
    "CHPOINT",
    "MCHAML",
    at_least=1,
    en="parameters, and the temperature, last of the fields in cells",
)


def _state(model: Model, field: CellField) -> str:
    """'strains', 'stresses' or '' for what a field holds on a model."""
    for zone in model.zones:
        family, seen = families.family_of(zone), zone_field(zone, field)
        if any(n in seen for n in family.strain_names(zone)):
            return "strains"
        if any(n in seen for n in family.stress_names(zone)):
            return "stresses"
    return ""


@operator("EPTH", family="stress")
def epth(call: Call, model: Model = MODEL, fields: Fields = _THERMAL) -> CellField:
    """Thermal strains."""
    return _thermal(call, model, fields)[1]


def _thermal(call: Call, model: Model, fields: Fields) -> tuple[CellField, CellField]:
    """The parameters, and the strains that the temperature gives."""
    nodal, cells = nodal_of(fields), cells_of(fields)
    if not nodal and len(cells) < 2:
        raise call.missing(("CHPOINT", "MCHAML"))
    material = joined_cells(call, fields if nodal else cells[:-1])
    if not any(EXPANDS.intersection(b.components) for b in material.blocks):
        call.warn("operators.statics.no-expansion", cells[0])
    if nodal and len(lost := without(model, material, nodal[0].node_ids)):
        told = {"count": len(lost), "node": nodal[0].table.told(int(lost[0]))}
        call.warn("operators.statics.temperature-missing", nodal[0], **told)
    field = nodal[0] if nodal else cells[-1]

    def make(zone: Zone) -> CellFieldBlock:
        values = thermal_strain(zone, material, field)
        return cell_block(zone, families.family_of(zone).strain_names(zone), values)

    return material, on_zones(present(call, model), "DEFORMATIONS", make)


@operator("THET", family="stress", full_name="THETA")
def thet(call: Call, model: Model = MODEL, fields: Fields = _THERMAL) -> CellField:
    """Thermal stresses."""
    material, strains = _thermal(call, model, fields)
    zones = present(call, model)
    return on_zones(zones, "CONTRAINTES", lambda z: families.elastic_stress(z, material, strains))
