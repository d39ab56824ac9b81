"""PROI and ZERO: fields in cells projected on other supports, fields of zeros."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

import numpy as np

from ssilang.kernel.elements.boundary import is_solid
from ssilang.kernel.elements.families import family_of
from ssilang.kernel.elements.results.projection import by_least_squares, on_mesh, on_model
from ssilang.kernel.elements.results.structural_gradients import is_structural, structural_names
from ssilang.kernel.elements.results.tensors import PRINCIPAL
from ssilang.kernel.elements.solids.gradients import gradient_names
from ssilang.kernel.elements.solids.hooke import hooke_block
from ssilang.kernel.elements.zone_fields import n_points
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock, Support
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.materials.model import Model, Zone
from ssilang.kernel.materials.parameters import geometric_names, material_names
from ssilang.kernel.materials.plastic.laws import plastic_law
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.plasticity.points import is_plastic
from ssilang.language.registry import Chosen, Help, arg, choice, many, operator, opt, select
from ssilang.language.run.call import Call
from ssilang.operators.statics.stresses import on_zones

_FIELDS = many("fields", "MCHAML", at_least=1, en="field at nodes", fr="champ aux noeuds")
_WAY = select(
    "way",
    {
        "NOEUDS": [],
        "GRAVITE": [],
        "RIGIDITE": [],
        "MASSE": [],
        "STRESSES": [],
        "MINI": [
            opt(
                "count",
                "ENTIER",
                default=3,
                en="integration points in each direction",
                fr="points d'intégration par direction",
            )
        ],
        "POLY": [],
    },
    en="points of the result on a model, or least squares",
    fr="points du résultat sur un modèle, ou moindres carrés",
)
_TOLERANCE = opt(
    "tolerance",
    "FLOTTANT",
    default=1e-5,
    en="how far outside of a cell a point counts, relative to the cell",
    fr="distance à un élément à laquelle un point compte encore, relative à l'élément",
)


@operator(
    "PROI",
    arg("place", "MMODEL", en="where to", fr="où"),
    _FIELDS,
    _WAY,
    _TOLERANCE,
    family="fields",
    help=Help(
        en="Projection of a field in cells, given at nodes, by its shape functions: on a mesh (a "
        "nodal field, where the nodes lie inside), or on a model (a field in cells at the nodes "
        "or at the points of a support). 'MINI': nodal values in each cell of the model with the "
        "least integral of squared differences, by N1 points in each direction (3). The tolerance "
        "is relative to the cells (1.E-5).",
        fr="Projection d'un champ par éléments, donné aux noeuds, par ses fonctions de forme : sur "
        "un maillage (un champ par points, là où les noeuds sont à l'intérieur), ou sur un modèle "
        "(un champ par éléments aux noeuds ou aux points d'un support). 'MINI' : valeurs nodales, "
        "dans chaque élément du modèle, qui rendent minimale l'intégrale du carré de l'écart, par "
        "N1 points par direction (3). La tolérance est relative aux éléments (1.E-5).",
        syntax="CHPO1 = PROI GEO1 CHAM1 (TOL1) ;\nCHAM2 = PROI MODL1 CHAM1 (MOT1) (TOL1) ;\n"
        "CHAM2 = PROI MODL1 CHAM1 'MINI' (N1) ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0. 0.) (2. 0.) ; S = TRAN 1 L (0. 1.) ; "
            "P = 0.3 0.4 ; C = CHAN 'CHAM' (NOMC 'SCAL' (COOR 1 S)) S ; "
            "LIST (EXTR (PROI (MANU 'POI1' P) C) 'SCAL' P) ;",
            (
                "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
                "S = (DROI 4 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ;\n"
                "T = (DROI 3 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ;\n"
                "M = MODE S 'MECANIQUE' 'ELASTIQUE' ; N = MODE T 'MECANIQUE' 'ELASTIQUE' ;\n"
                "C = CHAN 'CHAM' (NOMC 'SCAL' (COOR 1 S)) M ;\n"
                "LIST (MAXI (PROI N C)) ; LIST (MAXI (PROI N C 'NOEU')) ;\n"
                "LIST (MAXI (PROI N C 'GRAV')) ;\n"
                "LIST (MAXI (PROI N C 'RIGI')) ; LIST (MAXI (PROI N C 'MASS')) ;\n"
                "LIST (MAXI (PROI N C 'STRE')) ; LIST (MAXI (PROI N C 'MINI' 3)) ;"
            ),
            (
                "OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;\n"
                "S = (DROI 4 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ;\n"
                "T = (DROI 3 (0. 0.) (2. 0.)) TRAN 2 (0. 1.) ;\n"
                "C = CHAN 'CHAM' (NOMC 'SCAL' (COOR 1 S)) S ;\n"
                "LIST (MAXI (PROI T C 'NOEU')) ; LIST (MAXI (PROI T C 'GRAV')) ;\n"
                "LIST (MAXI (PROI T C 'RIGI')) ; LIST (MAXI (PROI T C 'MASS')) ;\n"
                "LIST (MAXI (PROI T C 'STRE')) ;"
            ),
        ),
    ),
)
def proi(
    call: Call, place: Model, fields: tuple[CellField, ...], way: Chosen | None, tolerance: float
) -> CellField:
    """Projection on a model."""
    word = _meant(call, way)
    if word == "MINI" and way is not None:
        points = way["count"]
        if points < 1:
            raise call.error("operators.fields.integration-points-none", points, points=points)
        return by_least_squares(fields[-1], place, points, tolerance)
    support = cast(Support, "NOEUD" if word in ("", "NOEUDS") else word)
    return on_model(fields[-1], place, support, tolerance)


@proi.form(arg("place", "MAILLAGE", en="where to", fr="où"), _FIELDS, _WAY, _TOLERANCE)
def proi_on_mesh(
    call: Call, place: Mesh, fields: tuple[CellField, ...], way: Chosen | None, tolerance: float
) -> NodeField:
    """Projection on a mesh."""
    if _meant(call, way) == "MINI":
        raise call.error("operators.fields.mini-needs-a-model", place)
    return on_mesh(fields[-1], place, tolerance)


def _meant(call: Call, way: Chosen | None) -> str:
    word = "" if way is None else way.word
    if word == "POLY":
        raise call.error("operators.fields.poly-not-available")
    return word


def _scalar(support: Support) -> tuple[str, Support]:
    return "SCALAIRE", support


_TITLES: dict[str, tuple[str, Support]] = {
    "NOEUD": _scalar("NOEUD"),
    "GRAVITE": _scalar("GRAVITE"),
    "RIGIDITE": _scalar("RIGIDITE"),
    "MASSE": _scalar("MASSE"),
    "STRESSES": _scalar("STRESSES"),
    "DEPLACEM": ("DEPLACEMENTS", "NOEUD"),
    "FORCES": ("FORCES", "NOEUD"),
    "TEMPERAT": ("TEMPERATURES", "NOEUD"),
    "GRADIENT": ("GRADIENT", "STRESSES"),
    "CONTRAIN": ("CONTRAINTES", "STRESSES"),
    "DEFORMAT": ("DEFORMATIONS", "STRESSES"),
    "PRINCIPA": ("PRINCIPALE", "STRESSES"),
    "MATERIAU": ("CARACTERISTIQUES", "STRESSES"),
    "CARACTER": ("CARACTERISTIQUES", "STRESSES"),
    "DEFINELA": ("DEFORMATIONS INELASTIQUES", "STRESSES"),
    "VARINTER": ("VARIABLES INTERNES", "STRESSES"),
    "MAHOOKE": ("MATRICE DE HOOKE", "RIGIDITE"),
    "HOTANGEN": ("MATRICE DE HOOKE TANGENTE", "RIGIDITE"),
}


def _gradient_names(zone: Zone) -> tuple[str, ...]:
    if is_structural(zone):
        return structural_names(zone)
    return gradient_names(zone) if is_solid(zone) else ()


def _variable_names(zone: Zone) -> tuple[str, ...]:
    """Those of a plastic law of bodies, EPSE for other laws."""
    found = plastic_law(zone.behaviour) if is_plastic(zone) else None
    return ("EPSE",) if found is None else found.variables


def _names(zone: Zone, what: str) -> tuple[str, ...]:
    family = family_of(zone)
    tables: dict[str, Callable[[], tuple[str, ...]]] = {
        "DEPLACEM": lambda: tuple(dict.fromkeys(family.layout(zone).unknowns)),
        "FORCES": lambda: tuple(dict.fromkeys(family.layout(zone).duals)),
        "TEMPERAT": lambda: ("T",),
        "GRADIENT": lambda: _gradient_names(zone),
        "CONTRAIN": lambda: family.stress_names(zone),
        "DEFORMAT": lambda: family.strain_names(zone),
        "DEFINELA": lambda: family.strain_names(zone),
        "PRINCIPA": lambda: PRINCIPAL,
        "MATERIAU": lambda: material_names(zone).all,
        "CARACTER": lambda: geometric_names(zone).all,
        "VARINTER": lambda: _variable_names(zone),
    }
    return tables[what]() if what in tables else ("SCAL",)


@operator(
    "ZERO",
    arg("model", "MMODEL", en="model", fr="modèle"),
    choice(
        "word",
        tuple(_TITLES),
        length=8,
        en="points of a scalar, or kind of field",
        fr="points d'un scalaire, ou type de champ",
    ),
    family="fields",
    help=Help(
        en="Field of zeros on a model: a scalar at the points of a support (NOEUD GRAVITE RIGIDITE "
        "MASSE STRESSES), or the components of a kind of field (CONTRAIN, DEFORMAT, DEPLACEM, "
        "FORCES, GRADIENT, MATERIAU, CARACTER, TEMPERAT, PRINCIPA, DEFINELA, VARINTER, MAHOOKE, "
        "HOTANGEN).",
        fr="Champ nul sur un modèle : un scalaire aux points d'un support (NOEUD GRAVITE RIGIDITE "
        "MASSE STRESSES), ou les composantes d'un type de champ (CONTRAIN, DEFORMAT, DEPLACEM, "
        "FORCES, GRADIENT, MATERIAU, CARACTER, TEMPERAT, PRINCIPA, DEFINELA, VARINTER, MAHOOKE, "
        "HOTANGEN).",
        syntax="CHAM1 = ZERO MODL1 MOT1 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0. 0.) (2. 0.) ; S = TRAN 1 L (0. 1.) ; "
            "M = MODE S MECANIQUE ELASTIQUE ; LIST (MAXI (ZERO M 'CONTRAIN')) ;",
        ),
    ),
)
def zero(call: Call, model: Model, word: str | None) -> CellField:
    """Zeros."""
    if word is None:
        raise call.error("operators.fields.which-zeros", titles=_TITLES)
    title, support = _TITLES[word]

    def make(zone: Zone) -> CellFieldBlock:
        if word in ("MAHOOKE", "HOTANGEN"):
            s = len(family_of(zone).strain_names(zone))
            return hooke_block(zone, np.zeros((1, n_points(zone.element, support), s, s)), support)
        shape = (len(zone.cells), n_points(zone.element, support))
        components = {n: np.zeros(shape) for n in _names(zone, word)}
        return CellFieldBlock(zone.cells, components, support, zone.element, zone.constituent)

    return on_zones(model, title, make)
