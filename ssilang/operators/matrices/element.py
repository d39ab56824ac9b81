"""RIGI, MASS, LUMP, AMOR, HOOK, KSIG: matrices of the elements of a model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.elements import families
from ssilang.kernel.elements.absorbing import absorbing_boundary
from ssilang.kernel.elements.beams.rotating import corotational
from ssilang.kernel.elements.loads.follower import pressure_stiffness
from ssilang.kernel.elements.solids.hooke import hooke_block
from ssilang.kernel.elements.solids.kinematics import NODE_ROTATIONS, NODE_TRANSLATIONS
from ssilang.kernel.elements.zone_fields import zone_field
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.materials.model import Mode, Model
from ssilang.kernel.matrices.build import nodal_diagonal
from ssilang.kernel.matrices.lumping import lumped_matrix
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.modal.shape_models import is_shape, shape_matrix
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.models.contact import model_relations
from ssilang.operators.workspace import workspace

UNKNOWNS = ("UX", "UY", "UZ", "UR", "UT", "RX", "RY", "RZ", "RT", "P", "PI", "T", "ALFA", "BETA")


def joined(fields: tuple[CellField, ...]) -> CellField:
    """Several fields of characteristics as one."""
    if len(fields) == 1:
        return fields[0]
    return CellField(tuple(b for f in fields for b in f.blocks), fields[0].title)


def present(call: Call, model: Model, pressures: bool = False) -> Model:
    """The mechanical zones of a model, Fourier ones with the harmonic that OPTI says now.

    With `pressures` the zones of loads are kept too.
    """
    harmonic = workspace(call.session).fourier
    zones = []
    for zone in model.zones:
        if zone.formulation != "MECANIQUE" and not pressures:
            continue
        if zone.mode is Mode.FOURIER and zone.options.get("harmonic") != harmonic:
            zone = replace(zone, options={**zone.options, "harmonic": harmonic})
        zones.append(zone)
    return Model(tuple(zones))


def _assembled(model: Model, blocks: list[ElementMatrices], kind: str) -> Matrix:
    if not blocks:
        raise MeshError("operators.matrices.no-mechanical-zone")
    return Matrix(model.mesh.nodes, tuple(blocks), (), kind)


def nodes_of(place: Mesh | Point) -> IntArray:
    """Node numbers of a point or mesh, each once."""
    return np.array([place.node]) if isinstance(place, Point) else place.sorted_node_ids


def additional(call: Call, kind: str) -> Matrix:
    """Values added at nodes: words DEPL, ROTA or names of unknowns, a number, a place."""
    mode = workspace(call.session).mode
    names: list[str] = []
    value = call.read("FLOTTANT")
    place = call.read("MAILLAGE", "POINT")
    while call.peek_word() is not None:
        if call.keyword(["DEPL"]):
            names += NODE_TRANSLATIONS[mode]
        elif call.keyword(["ROTA"]):
            names += NODE_ROTATIONS[mode]
        elif (name := call.keyword(UNKNOWNS)) is not None:
            names.append(name)
        else:
            break
    amount = value.value if value is not None else call.required("FLOTTANT")
    where = place.value if place is not None else call.required("MAILLAGE", "POINT")
    nodes = nodes_of(where)
    chosen = dict.fromkeys(names or NODE_TRANSLATIONS[mode])
    values = {n: np.full(len(nodes), float(amount)) for n in chosen}
    return nodal_diagonal(where.nodes, nodes, values, kind)


@operator(
    "RIGI",
    family="matrix",
    full_name="RIGIDITE",
    help=Help(
        en="Stiffness matrix: of a model with its parameters (or Hooke matrices and geometric "
        "parameters), or springs added at nodes: 'DEPL' on all translations, 'ROTA' on all "
        "rotations, or on the named unknowns; every node gets the whole value.",
        fr="Matrice de rigidité : d'un modèle avec ses paramètres (ou des matrices de Hooke et "
        "les caractéristiques géométriques), ou raideurs ajoutées aux noeuds : 'DEPL' sur toutes "
        "les translations, 'ROTA' sur toutes les rotations, ou sur les inconnues nommées ; "
        "chaque noeud reçoit toute la valeur.",
        syntax="RIG1 = RIGI MODL1 MAT1 (CAR1) ;\n"
        "RIG1 = RIGI ('DEPL') ('ROTA') | NOM1 ... VAL1 GEO1 ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; K = RIGI 'DEPL' 1.E6 P ; LIST (TYPE K) ;",),
    ),
    reads_itself=True,
)
def rigi(call: Call) -> Matrix:
    """Elastic stiffness of a model, or springs at nodes."""
    operand = call.read("MMODEL")
    if operand is None:
        return additional(call, "RIGIDITE")
    if any(z.formulation == "CONTACT" for z in operand.value.zones):
        return _contact(call, operand.value)
    model, material = present(call, operand.value), _fields(call)
    blocks = [families.stiffness(z, material) for z in model.zones if not is_shape(z)]
    return _assembled(model, [*blocks, *_shapes(model, material, "RIGIDITE")], "RIGIDITE")


def _contact(call: Call, model: Model) -> Matrix:
    """Stiffness of the bodies of a model and the unilateral relations of its sides."""
    fields = call.all("MCHAML")
    material = joined(tuple(fields)) if fields else None
    rubbing = next((z for z in model.zones if z.behaviour[:1] == ("FROTTANT",)), None)
    if rubbing is not None:
        raise call.error("operators.matrices.friction-is-no-matrix")
    relations = tuple(c.relations for c in model_relations(model, material))
    zones = present(call, model).zones
    if zones and material is None:
        raise call.missing(("MCHAML",))
    blocks = [families.stiffness(z, material) for z in zones if material is not None]
    return Matrix(model.mesh.nodes, tuple(blocks), relations, "RIGIDITE")


def _shapes(model: Model, material: CellField, kind: str) -> list[ElementMatrices]:
    """The block of the modes and static shapes of a model, if it has any."""
    block = shape_matrix(model.zones, material, kind)
    return [] if block is None else [block]


def _fields(call: Call) -> CellField:
    """The fields of characteristics that follow, at least one, as one."""
    first: CellField = call.required("MCHAML")
    found = (first, *call.all("MCHAML"))
    while call.keyword(["NOER", "REFE"]):
        found = (*found, *call.all("MCHAML"))
    return joined(found)


@operator(
    "MASS",
    family="matrix",
    full_name="MASSE",
    help=Help(
        en="Mass matrix: consistent one of a model with its parameters (RHO), or masses added at "
        "nodes: 'DEPL' on all translations, 'ROTA' inertia on all rotations, or on the named "
        "unknowns; every node gets the whole value.",
        fr="Matrice de masse : cohérente d'un modèle avec ses paramètres (RHO), ou masses "
        "ajoutées aux noeuds : 'DEPL' sur toutes les translations, 'ROTA' inertie sur toutes les "
        "rotations, ou sur les inconnues nommées ; chaque noeud reçoit toute la valeur.",
        syntax="MAS1 = MASS MODL1 MAT1 (CAR1) ;\n"
        "MAS1 = MASS ('DEPL') ('ROTA') | NOM1 ... VAL1 GEO1 ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; M = MASS 'DEPL' 3. P ; LIST (TYPE M) ;",),
    ),
    reads_itself=True,
)
def mass(call: Call) -> Matrix:
    """Consistent mass of a model, or masses at nodes."""
    operand = call.read("MMODEL")
    if operand is None:
        return additional(call, "MASSE")
    model, material = present(call, operand.value), _fields(call)
    blocks = [families.mass(z, material) for z in model.zones if not is_shape(z)]
    return _assembled(model, [*blocks, *_shapes(model, material, "MASSE")], "MASSE")


@operator(
    "LUMP",
    family="matrix",
    help=Help(
        en="Diagonal mass matrix: of a model (rows summed for linear elements, diagonal scaled "
        "to keep the mass for the others), or of a full matrix (rows summed; the unknowns of the "
        "list keep their diagonal term).",
        fr="Matrice de masse diagonale : d'un modèle (somme des lignes pour les éléments "
        "linéaires, diagonale mise à l'échelle de la masse pour les autres), ou d'une matrice "
        "pleine (somme des lignes ; les inconnues de la liste gardent leur terme diagonal).",
        syntax="MAS1 = LUMP MODL1 MAT1 (CAR1) ;\nMAS2 = LUMP MAS1 (LMOT1) ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; M = LUMP (MASS 'DEPL' 3. P) ; LIST (TYPE M) ;",),
    ),
    reads_itself=True,
)
def lump(call: Call) -> Matrix:
    """Diagonal mass."""
    operand = call.read("MMODEL")
    if operand is None:
        full = call.required("RIGIDITE")
        kept = call.optional("LISTMOTS")
        return lumped_matrix(full, () if kept is None else tuple(m.rstrip() for m in kept.values))
    model, material = present(call, operand.value), _fields(call)
    return _assembled(model, [families.mass(z, material, True) for z in model.zones], "MASSE")


@operator(
    "AMOR",
    family="matrix",
    full_name="AMORTISSEMENT",
    help=Help(
        en="Damping matrix: of a model whose parameters hold the viscosity VISQ (a stiffness "
        "with VISQ for modulus); of the absorbing boundary GEO1 of a model (Lysmer: RHO VP along "
        "the normal, RHO VS across, from YOUN NU RHO); or dashpots added at nodes: 'DEPL' on all "
        "translations, 'ROTA' on all rotations, or on the named unknowns. 'COROTATIF': damping "
        "that turns with beams at OMEG about their axis, with the circulatory stiffness beside it.",
        fr="Matrice d'amortissement : d'un modèle dont les paramètres ont la viscosité VISQ "
        "(rigidité dont VISQ est le module) ; de la frontière absorbante GEO1 d'un modèle "
        "(Lysmer : RHO VP selon la normale, RHO VS en travers, d'après YOUN NU RHO) ; ou "
        "amortisseurs ajoutés aux noeuds : 'DEPL' sur toutes les translations, 'ROTA' sur "
        "toutes les rotations, ou sur les inconnues nommées. 'COROTATIF' : amortissement qui "
        "tourne avec des poutres à OMEG autour de leur axe, avec la raideur circulatoire.",
        syntax="AMO1 = AMOR MODL1 MAT1 ; AMO1 RIG1 = AMOR MODL1 MAT1 'COROTATIF' ;\n"
        "AMO1 = AMOR MODL1 GEO1 MAT1 ;\n"
        "AMO1 = AMOR ('DEPL') ('ROTA') | NOM1 ... VAL1 GEO1 ;",
        examples=("OPTI DIME 2 ; P = 0. 0. ; C = AMOR 'DEPL' 3. P ; LIST (TYPE C) ;",),
    ),
    reads_itself=True,
)
def amor(call: Call) -> Matrix | tuple[Matrix, Matrix]:
    """Viscous damping of a model, absorbing boundary, or dashpots at nodes."""
    operand = call.read("MMODEL")
    if operand is None:
        return additional(call, "AMORTISSEMENT")
    model = present(call, operand.value)
    boundary = call.optional("MAILLAGE")
    material = _fields(call)
    boundary = call.optional("MAILLAGE") if boundary is None else boundary
    if boundary is not None:
        return absorbing_boundary(model, boundary, material)
    blocks = [families.viscosity(z, material) for z in model.zones if not is_shape(z)]
    kind = "AMORTISSEMENT"
    if call.keyword(["COROTATIF"]) is not None:
        pairs = zip(model.zones, blocks, strict=True)
        turned = [corotational(z, b, material) for z, b in pairs]
        return _assembled(model, blocks, kind), _assembled(model, turned, "RIGIDITE")
    return _assembled(model, [*blocks, *_shapes(model, material, kind)], kind)


@operator(
    "HOOK",
    family="matrix",
    full_name="HOOKE",
    help=Help(
        en="Field of the elastic (Hooke) matrices of a model, component MAHO; RIGI, SIGM and ELAS "
        "take it in the place of the parameters.",
        fr="Champ des matrices de Hooke d'un modèle, composante MAHO ; RIGI, SIGM et ELAS "
        "l'acceptent à la place des paramètres.",
        syntax="HOO1 = HOOK MODL1 MAT1 (CAR1) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0 0) (1 0) ; M = MODE L MECANIQUE ELASTIQUE BARR "
            "; H = HOOK M (MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 0.01) ; LIST (TYPE H) ;",
        ),
    ),
    reads_itself=True,
)
def hook(call: Call) -> CellField:
    """Elastic matrices at the integration points."""
    model = present(call, call.required("MMODEL"))
    material = _fields(call)
    blocks = []
    for zone in model.zones:
        parameters = zone_field(zone, material)
        moduli = families.family_of(zone).moduli(zone, parameters, "RIGIDITE")
        blocks.append(hooke_block(zone, moduli, "RIGIDITE"))
    return CellField(tuple(blocks), "MATRICE DE HOOKE")


@operator(
    "KSIG",
    family="matrix",
    full_name="KSIGMA",
    help=Help(
        en="Geometric stiffness of a stress field; with 'FLAM' it has the type MASSE that VIBR "
        "wants: made from the opposite stresses, its eigenvalues are the critical load factors.",
        fr="Rigidité géométrique d'un champ de contraintes ; avec 'FLAM' elle a le type MASSE que "
        "veut VIBR : faite avec les contraintes opposées, ses valeurs propres sont les facteurs "
        "de charge critique.",
        syntax="RIG1 = KSIG MODL1 SIG1 (CAR1) ('FLAM') ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; P = 0. 0. ; Q = 1. 0. ; L = DROI 2 P Q ; "
            "M = MODE L MECANIQUE ELASTIQUE BARR ; A = MATE M 'YOUN' 2.E11 'NU' 0.3 'SECT' 0.01 ; "
            "U = MANU 'CHPO' L 1 'UX' 1.E-3 ; K = KSIG M (SIGM M A U) ; LIST (TYPE K) ;",
        ),
    ),
    reads_itself=True,
)
def ksig(call: Call) -> Matrix:
    """Geometric stiffness."""
    fields: list[CellField] = call.all("MCHAML")
    model = present(call, call.required("MMODEL"))
    fields += call.all("MCHAML")
    buckling = call.keyword(["FLAM"]) is not None
    fields += call.all("MCHAML")
    if not fields:
        raise call.missing(("MCHAML",))
    stress = next((f for f in fields if f.title != "CARACTERISTIQUES"), fields[0])
    rest = tuple(f for f in fields if f is not stress)
    material = joined(rest) if rest else None
    blocks = [families.geometric_stiffness(z, stress, material) for z in model.zones]
    return _assembled(model, blocks, "MASSE" if buckling else "RIGIDITE")


@operator(
    "KP",
    family="matrix",
    help=Help(
        en="How the forces of a pressure change when the sides that carry it move and turn "
        "(follower pressure): derivative of the nodal forces, symmetric part unless 'ASYM'. The "
        "pressure, a nodal field or a field in cells, is positive along the sides' own normals. "
        "'FLAM' gives the type MASSE for a buckling analysis with VIBR.",
        fr="Variation des forces d'une pression quand les faces qui la portent bougent et tournent "
        "(pression suiveuse) : dérivée des forces nodales, partie symétrique sauf avec 'ASYM'. La "
        "pression, champ par points ou par éléments, est positive selon les normales propres des "
        "faces. 'FLAM' donne le type MASSE pour une analyse de flambage avec VIBR.",
        syntax="RIG1 = KP MODL1 | CHPO1 | CHAM1 ('FLAM') ('ASYM') ;",
        examples=(
            "OPTI DIME 2 MODE AXIS ELEM SEG2 ; L = DROI 2 (1. 0.) (1. 1.) ; "
            "M = MODE L MECANIQUE COQ2 ; K = KP M (MANU 'CHPO' L 1 'P' 2.) ; LIST (TYPE K) ;",
        ),
    ),
    reads_itself=True,
)
def kp(call: Call) -> Matrix:
    """Follower pressure."""
    model = present(call, call.required("MMODEL"), pressures=True)
    operand = call.read("CHPOINT", "MCHAML")
    if operand is None:
        raise call.missing(("CHPOINT", "MCHAML"))
    words = [call.keyword(["FLAM", "ASYM"]) for _ in range(2)]
    blocks = [pressure_stiffness(z, operand.value, "ASYM" in words) for z in model.zones]
    return _assembled(model, blocks, "MASSE" if "FLAM" in words else "RIGIDITE")
