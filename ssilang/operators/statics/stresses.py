"""SIGM EPSI BSIG ELAS EPTH THET: strains, stresses and the forces that balance them."""

from __future__ import annotations

from collections.abc import Callable

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.family import cell_block
from ssilang.kernel.elements.loads.loads import pressure_vectors, total
from ssilang.kernel.elements.loads.thermal import thermal_strain
from ssilang.kernel.elements.results.second_order import green_strain, green_stress
from ssilang.kernel.elements.solids.gradients import gradient_names, logarithmic_strain
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model, Zone
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.matrices.element import joined, present

_BAR = (
    "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; L = DROI 1 P Q ; "
    "M = MODE L MECANIQUE ELASTIQUE BARR ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 0.01 ; "
    "U = MANU 'CHPO' L 1 'UX' (PROG 0. 1.E-3) ; "
)


PARAMETERS = ("CARACTERISTIQUES", "MATRICE DE HOOKE")
"""Types of fields in cells that hold parameters."""


class Reading:
    """What an operator with a model and fields in any order says.

    Attributes
    ----------
    words : list of str
        Keywords found, in full.
    model : Model; nodal : tuple of NodeField; cells : tuple of CellField
    """

    def __init__(self, call: Call, words: tuple[str, ...] = ()) -> None:
        self.call = call
        self.words: list[str] = []
        models: list[Model] = []
        nodal: list[NodeField] = []
        cells: list[CellField] = []
        while True:
            if words and (word := call.keyword(words)) is not None:
                self.words.append(word)
                continue
            operand = call.read("CHPOINT", "MCHAML", *(() if models else ("MMODEL",)))
            if operand is None:
                break
            value = operand.value
            if isinstance(value, Model):
                models.append(value)
            else:
                (nodal if isinstance(value, NodeField) else cells).append(value)
        if not models:
            raise call.missing(("MMODEL",))
        self.model = present(call, models[0])
        self.loads = tuple(z for z in models[0].zones if z.formulation == "CHARGEMENT")
        self.nodal, self.cells = tuple(nodal), tuple(cells)

    def displacement(self) -> NodeField:
        """The nodal field, mandatory."""
        if not self.nodal:
            raise self.call.missing(("CHPOINT",))
        return self.nodal[0]

    def field(self) -> CellField:
        """All fields in cells as one, at least one."""
        if not self.cells:
            raise self.call.missing(("MCHAML",))
        return joined(self.cells)

    def state_and_rest(self) -> tuple[CellField, CellField | None]:
        """The field of stresses or strains, in whatever order, and the parameters as one."""
        if not self.cells:
            raise self.call.missing(("MCHAML",))
        state = next((f for f in self.cells if f.title not in PARAMETERS), self.cells[0])
        rest = tuple(f for f in self.cells if f is not state)
        return state, joined(rest) if rest else None


def on_zones(model: Model, title: str, make: Callable[[Zone], CellFieldBlock]) -> CellField:
    """A field in cells, zone by zone."""
    return CellField(tuple(make(z) for z in model.zones), title)


@operator(
    "SIGM",
    family="stress",
    full_name="SIGMA",
    help=Help(
        en="Elastic stresses of a displacement field, at the points of 'STRESSES': SMXX SMYY SMZZ "
        "SMXY ... in continuous elements (global axes), EFFX in bars, EFFX EFFY ... MOMZ in beams "
        "(local axes), SMSN SMN in joints. 'QUAD' adds the strains of second order. Hooke "
        "matrices may stand for the parameters.",
        fr="Contraintes élastiques d'un champ de déplacements, aux points de 'STRESSES' : SMXX "
        "SMYY SMZZ SMXY ... dans les massifs (repère général), EFFX dans les barres, EFFX EFFY "
        "... MOMZ dans les poutres (repère local), SMSN SMN dans les joints. 'QUAD' ajoute les "
        "déformations du second ordre. Des matrices de Hooke peuvent remplacer les paramètres.",
        syntax="SIG1 = SIGM ('NOER') ('LINE' | 'QUAD') MODL1 MAT1 (CAR1) DEP1 ;",
        examples=(_BAR + "LIST (MAXI (SIGM M A U)) ;",),
    ),
    reads_itself=True,
)
def sigm(call: Call) -> CellField:
    """Stresses."""
    said = Reading(call, ("NOER", "LINE", "QUAD"))
    u, material = said.displacement(), said.field()
    compute = green_stress if "QUAD" in said.words else families.stress
    return on_zones(said.model, "CONTRAINTES", lambda z: compute(z, material, u))


@operator(
    "EPSI",
    family="stress",
    full_name="EPSILON",
    help=Help(
        en="Strains of a displacement field, at the points of 'STRESSES': EPXX EPYY EPZZ GAXY ... "
        "in continuous elements (shears are engineering strains), EPSS in bars, EPS GXY ... CZ in "
        "beams, jumps DRSN DRN in joints. 'QUAD' adds the terms of second order. With a field of "
        "gradients F ('GEOM') or F - 1 ('DEPL') instead: the strain ln(F^T F) / 2.",
        fr="Déformations d'un champ de déplacements, aux points de 'STRESSES' : EPXX EPYY EPZZ "
        "GAXY ... dans les massifs (GAXY est la distorsion), EPSS dans les barres, EPS GXY ... CZ "
        "dans les poutres, sauts DRSN DRN dans les joints. 'QUAD' ajoute les termes du second "
        "ordre. Avec un champ de gradients F ('GEOM') ou F - 1 ('DEPL') : la déformation "
        "ln(F^T F) / 2.",
        syntax="EPS1 = EPSI ('LINE' | 'QUAD') MODL1 DEP1 (CAR1) ('NOER') ;\n"
        "EPS1 = EPSI MODL1 GRAD1 ('GEOM' | 'DEPL') ;",
        examples=(_BAR + "LIST (MAXI (EPSI M U)) ;",),
    ),
    reads_itself=True,
)
def epsi(call: Call) -> CellField:
    """Strains."""
    said = Reading(call, ("NOER", "LINE", "QUAD", "GEOM", "DEPL", "TRUE", "JAUM", "UTIL"))
    for word in ("TRUE", "JAUM", "UTIL"):
        if word in said.words:
            raise call.error("operators.statics.strain-not-available", word=word)
    if not said.nodal:
        gradient, by_displacement = said.field(), "DEPL" in said.words
        return on_zones(
            said.model, "DEFORMATIONS", lambda z: _logarithmic(z, gradient, by_displacement)
        )
    material = joined(said.cells) if said.cells else None
    u = said.displacement()
    compute = green_strain if "QUAD" in said.words else families.strain
    return on_zones(said.model, "DEFORMATIONS", lambda z: compute(z, u, material))


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
    family="stress",
    full_name="BSIGMA",
    help=Help(
        en="Nodal forces in balance with a field of stresses: the integral of B^T sigma; on a "
        "model CHARGEMENT PRESSION, the forces of a field of pressure along the sides' normals.",
        fr="Forces nodales en équilibre avec un champ de contraintes : l'intégrale de B^T sigma ; "
        "sur un modèle CHARGEMENT PRESSION, les forces d'un champ de pression selon les normales "
        "des faces.",
        syntax="FOR1 = BSIG ('NOER') MODL1 SIG1 (CAR1) ;",
        examples=(_BAR + "F = BSIG M (SIGM M A U) ; LIST (EXTR F 'FX' Q) ;",),
    ),
    reads_itself=True,
)
def bsig(call: Call) -> NodeField:
    """Internal forces."""
    said = Reading(call, ("NOER",))
    stress, material = said.state_and_rest()
    forces = [families.internal_forces(z, stress, material) for z in said.model.zones]
    forces += [pressure_vectors(z, stress) for z in said.loads]
    return total(forces[0].table, forces)


@operator(
    "ELAS",
    family="stress",
    full_name="ELASTICITE",
    help=Help(
        en="Elastic stresses of strains, or strains of stresses, whichever the first field holds.",
        fr="Contraintes élastiques de déformations, ou déformations de contraintes, selon ce que "
        "contient le premier champ.",
        syntax="CHAM2 = ELAS MODL1 CHAM1 MAT1 (CAR1) ;",
        examples=(_BAR + "LIST (MAXI (ELAS M (EPSI M U) A)) ;",),
    ),
    reads_itself=True,
)
def elas(call: Call) -> CellField:
    """Hooke's law, either way."""
    said = Reading(call)
    state = next((f for f in said.cells if _state(said.model, f)), None)
    if state is None:
        raise call.error("operators.statics.no-stress-no-strain")
    rest = tuple(f for f in said.cells if f is not state)
    if not rest:
        raise call.missing(("MCHAML",))
    material = joined(rest)
    if _state(said.model, state) == "strains":
        return on_zones(
            said.model, "CONTRAINTES", lambda z: families.elastic_stress(z, material, state)
        )
    return on_zones(
        said.model, "DEFORMATIONS", lambda z: families.elastic_strain(z, material, state)
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


@operator(
    "EPTH",
    family="stress",
    help=Help(
        en="Thermal strains ALPH (T - TALP) of a temperature T (nodal field, or field in cells).",
        fr="Déformations thermiques ALPH (T - TALP) d'une température T (champ par points ou par "
        "éléments).",
        syntax="EPS1 = EPTH MODL1 MAT1 | CHPO1 | CHAM1 ;",
        examples=(
            _BAR + "B = A ET (MATE M 'ALPH' 1.E-5) ; T = MANU 'CHPO' L 1 'T' 100. ; "
            "LIST (MAXI (EPTH M B T)) ;",
        ),
    ),
    reads_itself=True,
)
def epth(call: Call) -> CellField:
    """Thermal strains."""
    said = Reading(call)
    material, field = _thermal(said)
    return on_zones(said.model, "DEFORMATIONS", lambda z: _thermal_block(z, material, field))


def _thermal(said: Reading) -> tuple[CellField, NodeField | CellField]:
    if said.nodal:
        return said.field(), said.nodal[0]
    if len(said.cells) < 2:
        raise said.call.missing(("CHPOINT", "MCHAML"))
    return joined(said.cells[:-1]), said.cells[-1]


def _thermal_block(zone: Zone, material: CellField, field: NodeField | CellField) -> CellFieldBlock:
    values = thermal_strain(zone, material, field)
    return cell_block(zone, families.family_of(zone).strain_names(zone), values)


@operator(
    "THET",
    family="stress",
    full_name="THETA",
    help=Help(
        en="Stresses D ALPH (T - TALP) of the thermal strains of a temperature T: to be taken off "
        "the stresses of SIGM; BSIG of them gives the thermal load.",
        fr="Contraintes D ALPH (T - TALP) des déformations thermiques d'une température T : à "
        "soustraire des contraintes de SIGM ; leur BSIG est le chargement thermique.",
        syntax="SIG1 = THET MODL1 MAT1 | CHPO1 | CHAM1 ;",
        examples=(
            _BAR + "B = A ET (MATE M 'ALPH' 1.E-5) ; T = MANU 'CHPO' L 1 'T' 100. ; "
            "F = BSIG M (THET M B T) ; LIST (EXTR F 'FX' Q) ;",
        ),
    ),
    reads_itself=True,
)
def thet(call: Call) -> CellField:
    """Thermal stresses."""
    said = Reading(call)
    material, field = _thermal(said)
    strains = CellField(
        tuple(_thermal_block(z, material, field) for z in said.model.zones), "DEFORMATIONS"
    )
    return on_zones(
        said.model, "CONTRAINTES", lambda z: families.elastic_stress(z, material, strains)
    )
