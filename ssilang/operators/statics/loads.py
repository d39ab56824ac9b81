"""FORC MOME PRES FSUR CNEQ: nodal forces of loads."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.elements.loads.line_loads import line_load
from ssilang.kernel.elements.loads.loads import (
    body_force,
    loaded_faces,
    on_sides,
    pipe_pressure,
    pressure,
    shell_load,
    traction,
)
from ssilang.kernel.elements.results.reduction import model_on_mesh
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Mode, Model
from ssilang.kernel.matrices.matrix import dual_of
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import Table
from ssilang.operators.matrices.element import joined, nodes_of
from ssilang.operators.matrices.supports import static_links
from ssilang.operators.workspace import workspace

FORCES = ("FX", "FY", "FZ", "FR", "FT")
MOMENTS = ("MX", "MY", "MZ", "MT", "MR")


def _shared(call: Call, usual: tuple[str, ...], allowed: tuple[str, ...]) -> NodeField:
    """A vector, or named values, shared equally by the nodes of a place."""
    values: dict[str, float] = {}
    while (name := call.keyword(allowed)) is not None:
        values[name] = float(call.required("FLOTTANT", after=call.keyword_end))
    if not values:
        if not usual:
            raise call.error("operators.statics.no-moment-by-vector")
        vector: Point = call.required("POINT")
        values = dict(zip(usual, vector.coordinates[: len(usual)], strict=True))
    place: Mesh | Point = call.required("MAILLAGE", "POINT")
    nodes = nodes_of(place)
    if not len(nodes):
        raise call.error("operators.statics.empty-mesh-for-force", place)
    parts = {n: np.full(len(nodes), v / len(nodes)) for n, v in values.items()}
    return NodeField.of(place.nodes, nodes, parts, "DISCRET")


@operator(
    "FORC",
    family="load",
    full_name="FORCE",
    help=Help(
        en="Nodal field of a force, shared equally by the nodes of a place: a vector (its "
        "coordinates are the components, given before the place) or named components FX FY FZ "
        "(FR FZ FT in axisymmetry).",
        fr="Champ par points d'une force, répartie également sur les noeuds d'un lieu : un "
        "vecteur (ses coordonnées sont les composantes, donné avant le lieu) ou des composantes "
        "nommées FX FY FZ (FR FZ FT en axisymétrie).",
        syntax="FOR1 = FORC | VEC1 | MOT1 VAL1 ... GEO1 ;\nFORC TAB1 ;  (LIAISONS_STATIQUES)",
        examples=("OPTI DIME 2 ; P = 0. 0. ; F = FORC (0. -3.) P ; LIST (EXTR F 'FY' P) ;",),
    ),
    reads_itself=True,
)
def forc(call: Call) -> NodeField | None:
    """Point forces."""
    table = call.read("TABLE")
    if table is not None:
        _unit_forces(call, table.value)
        return None
    names = NODE_TRANSLATIONS[workspace(call.session).mode]
    return _shared(call, tuple(dual_of(n) for n in names), FORCES)


def _unit_forces(call: Call, table: Table) -> None:
    """FORCE in each entry of a table LIAISONS_STATIQUES: one, at its point."""
    nodes = workspace(call.session).nodes
    links = static_links(table)
    for entry, point, component in links:
        if not isinstance(point, Point) or not component:
            raise call.error("operators.statics.entry-wants-point-and-unknown", table)
        at, one = np.array([point.node]), np.ones(1)
        entry.set("FORCE", NodeField.of(nodes, at, {component: one}, "DISCRET"))
    if not links:
        raise call.error("operators.statics.no-numbered-entry", table)


@operator(
    "MOME",
    family="load",
    full_name="MOMENT",
    help=Help(
        en="Nodal field of a moment, shared equally by the nodes of a place: a vector in space, "
        "or named components MX MY MZ (MT in axisymmetry).",
        fr="Champ par points d'un moment, réparti également sur les noeuds d'un lieu : un "
        "vecteur dans l'espace, ou des composantes nommées MX MY MZ (MT en axisymétrie).",
        syntax="FOR1 = MOME | VEC1 | MOT1 VAL1 ... GEO1 ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; F = MOME 'MZ' 5. P ; LIST (EXTR F 'MZ' P) ;",),
    ),
    reads_itself=True,
)
def mome(call: Call) -> NodeField:
    """Point moments."""
    mode = workspace(call.session).mode
    names = NODE_ROTATIONS[mode] if mode is Mode.THREE_DIMENSIONAL else ()
    return _shared(call, tuple(dual_of(n) for n in names), MOMENTS)


@operator(
    "PRES",
    family="load",
    full_name="PRESSION",
    help=Help(
        en="Nodal forces of a pressure on sides of continuous elements, pushing into them when "
        "positive. The pressure is a number on a mesh of sides, a nodal field with one component "
        "(on the outer sides of the model whose nodes all have a value), or a field in cells "
        "over sides. On shells ('COQU') it pushes along their normal ('NORM') or to the side that "
        "a vector shows. On shells of bricks ('SHB8') it pushes into the face of the first four "
        "nodes ('INTERNE') or of the last four ('EXTERNE'). In pipes ('TUYA') the parameter PRES "
        "pushes on closed ends. With a model CHARGEMENT PRESSION: the field of pressure, "
        "whose forces BSIG gives along the sides' own normals.",
        fr="Forces nodales d'une pression sur des faces d'éléments massifs, dirigée vers "
        "l'intérieur quand elle est positive. La pression est un nombre sur un maillage de "
        "faces, un champ par points à une composante (sur les faces extérieures du modèle dont "
        "tous les noeuds ont une valeur), ou un champ par éléments sur des faces. Sur les coques "
        "('COQU') elle pousse selon la normale ('NORM') ou du côté que montre un vecteur. Sur les "
        "coques de cubes ('SHB8') elle pousse sur la face des quatre premiers noeuds ('INTERNE') "
        "ou des quatre derniers ('EXTERNE'). Dans les tuyaux ('TUYA') le paramètre PRES pousse "
        "sur les bouts fermés. Avec un modèle CHARGEMENT PRESSION : le champ de "
        "pression, dont BSIG donne les forces selon les normales propres des faces.",
        syntax="FOR1 = PRES 'MASS' MODL1 | VAL1 GEO1 | CHPO1 | CHAM1 ;\n"
        "FOR1 = PRES 'COQU' MODL1 | VAL1 | CHPO1 | CHAM1 'NORM' | VEC1 ;\n"
        "FOR1 = PRES 'SHB8' MODL1 | VAL1 | CHPO1 'INTERNE' | 'EXTERNE' ;\n"
        "FOR1 = PRES 'TUYA' MODL1 CAR1 ;\n"
        "CHAM2 = PRES MODL1 | MOT1 VAL1 (GEO1) | CHAM1 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; P = 0. 0. ; Q = 2. 0. ; L = DROI 2 P Q ; "
            "S = TRAN 1 L (0. 1.) ; M = MODE S MECANIQUE ELASTIQUE ; "
            "F = PRES 'MASS' M 3. L ; LIST (MAXI (RESU F)) ;",
        ),
    ),
    reads_itself=True,
)
def pres(call: Call) -> NodeField | CellField:
    """Pressure on sides."""
    if (loaded := _of_loads(call)) is not None:
        return loaded
    kind = _kind(call, ("FISS",), ("SHB8",))
    model: Model = call.required("MMODEL")
    if kind == "TUYA":
        return pipe_pressure(model, joined((call.required("MCHAML"), *call.all("MCHAML"))))
    operand = call.read("CHPOINT", "MCHAML", "FLOTTANT")
    if operand is None:
        raise call.missing(("FLOTTANT", "CHPOINT", "MCHAML"))
    value = operand.value
    if kind == "COQU":
        if call.keyword(["POIN"]):
            raise call.error("operators.statics.pressure-by-point")
        along = call.optional("POINT") if call.keyword(["NORM"]) is None else None
        return shell_load(model, value, None if along is None else along.coordinates)
    faces = _brick_faces(call, model) if kind == "SHB8" else call.optional("MAILLAGE")
    if isinstance(value, CellField):
        value = on_sides(model, value)
    if faces is None:
        if not isinstance(value, NodeField | CellField):
            raise call.missing(("MAILLAGE",))
        faces = loaded_faces(model, value)
    return pressure(model, faces, value)


def _of_loads(call: Call) -> CellField | None:
    """The field of pressure of a model of loads: a number or a field in cells."""
    first = call.operands[0].value if call.operands else None
    if not isinstance(first, Model) or any(z.formulation != "CHARGEMENT" for z in first.zones):
        return None
    model: Model = call.required("MMODEL")
    given = call.read("MCHAML")
    name = None if given is not None else call.word()
    value = given.value if given is not None else call.required("FLOTTANT", "MCHAML")
    faces = call.optional("MAILLAGE")
    if faces is not None:
        model = model_on_mesh(model, faces)
    label = (name or "PRES").rstrip()
    blocks = []
    for zone in model.zones:
        if isinstance(value, CellField):
            seen = zone_field(zone, value)
            if len(seen.names) != 1:
                raise call.error("operators.statics.pressure-has-one-component", value)
            values = seen.raw(seen.names[0])[0]
        else:
            values = np.full((len(zone.cells), 1), float(value))
        blocks.append(
            CellFieldBlock(zone.cells, {label: values}, "NOEUD", zone.element, zone.constituent)
        )
    return CellField(tuple(blocks), "PRESSION")


def _brick_faces(call: Call, model: Model) -> Mesh | None:
    """The inner or outer face of shells of bricks: first or last four nodes."""
    if any(z.element != "SHB8" for z in model.zones):
        raise call.error("operators.statics.not-shb8", model)
    side = call.keyword(["INTE", "EXTE"])
    if side is None:
        return None
    nodes = slice(0, 4) if side == "INTE" else slice(4, 8)
    blocks = [CellBlock.make(z.cells.nodes, "QUA4", z.cells.raw[:, nodes]) for z in model.zones]
    return Mesh(model.mesh.nodes, tuple(blocks))


def _kind(call: Call, others: tuple[str, ...], known: tuple[str, ...] = ()) -> str:
    """MASS, or a refusal of the elements that are not here."""
    found = call.keyword(["MASS", "POUT", "COQU", "TUYA", *known, *others])
    if found in others:
        raise call.error("operators.statics.load-not-available", found=found)
    return found or "MASS"


@operator(
    "FSUR",
    family="load",
    help=Help(
        en="Nodal forces of a force per area on sides of continuous elements ('MASS'), or per "
        "length of beams and bars ('POUT'; with 'PROJ' per length projected on the plane normal "
        "to a vector). The density is a vector or a nodal field FX FY FZ (with moments MX MY MZ "
        "along beams). CAR1 gives the thickness DIM3 in plane stress.",
        fr="Forces nodales d'une force par unité de surface sur des faces de massifs ('MASS'), "
        "ou de longueur de poutres et barres ('POUT' ; avec 'PROJ' par unité de longueur "
        "projetée sur le plan normal à un vecteur). La densité est un vecteur ou un champ par "
        "points FX FY FZ (avec des moments MX MY MZ sur les poutres). CAR1 donne l'épaisseur "
        "DIM3 en contraintes planes.",
        syntax="FOR1 = FSUR 'MASS' MODL1 | VEC1 GEO1 | CHPO1 (CAR1) ;\n"
        "FOR1 = FSUR 'COQU' MODL1 | VEC1 | CHPO1 ;\n"
        "FOR1 = FSUR 'POUT' MODL1 | VEC1 | CHPO1 ('PROJ' VEC2) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0 0) (2 0) ; M = MODE L MECANIQUE ELASTIQUE POUT "
            "; F = FSUR 'POUT' M (0. -3.) ; LIST (MAXI (RESU F)) ;",
        ),
    ),
    reads_itself=True,
)
def fsur(call: Call) -> NodeField:
    """Surface and line forces."""
    kind = _kind(call, ())
    model: Model = call.required("MMODEL")
    operand = call.read("CHPOINT", "POINT")
    if operand is None:
        raise call.missing(("POINT", "CHPOINT"))
    density = operand.value if isinstance(operand.value, NodeField) else operand.value.coordinates
    if kind == "COQU":
        return shell_load(model, density)
    if kind == "POUT":
        projected = call.keyword(["PROJ"])
        normal = call.required("POINT", after=call.keyword_end) if projected else None
        return line_load(model, density, None if normal is None else normal.coordinates)
    faces = call.optional("MAILLAGE")
    fields = call.all("MCHAML")
    if faces is None:
        if not isinstance(density, NodeField):
            raise call.missing(("MAILLAGE",))
        faces = loaded_faces(model, density)
    return traction(model, faces, density, joined(tuple(fields)) if fields else None)


@operator(
    "CNEQ",
    family="load",
    help=Help(
        en="Nodal forces of a force per volume in continuous elements: nodal field or field in "
        "cells with components FX FY FZ (weight, centrifugal force ...). CAR1 gives the "
        "thickness DIM3 in plane stress.",
        fr="Forces nodales d'une force par unité de volume dans des massifs : champ par points "
        "ou par éléments de composantes FX FY FZ (poids, force centrifuge ...). CAR1 donne "
        "l'épaisseur DIM3 en contraintes planes.",
        syntax="FOR1 = CNEQ MODL1 | CHPO1 | CHAM1 (CAR1) ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0 0) (2 0) ; S = TRAN 1 L (0. 1.) ; "
            "M = MODE S MECANIQUE ELASTIQUE ; G = MANU 'CHPO' S 1 'FY' -9.81 ; "
            "F = CNEQ M G ; LIST (MAXI 'ABS' (RESU F)) ;",
        ),
    ),
    reads_itself=True,
)
def cneq(call: Call) -> NodeField:
    """Volume forces."""
    model: Model = call.required("MMODEL")
    operand = call.read("CHPOINT", "MCHAML")
    if operand is None:
        raise call.missing(("CHPOINT", "MCHAML"))
    fields = call.all("MCHAML")
    return body_force(model, operand.value, joined(tuple(fields)) if fields else None)
