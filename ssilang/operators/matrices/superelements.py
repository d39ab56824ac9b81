"""SUPE: super-elements, static condensation of a body onto some of its unknowns."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.submatrices import support_mesh
from ssilang.kernel.matrices.superelement import (
    SuperElement,
    condense,
    condensed_load,
    condensed_mass,
    inner_displacement,
    shape_fields,
)
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, register_type
from ssilang.operators.dispatch import EXTR, listing

register_type(SuperElement, "SUPERELE")


@operator(
    "SUPE",
    family="matrix",
    full_name="SUPER",
    help=Help(
        "Super-elements. 'RIGIDITE': the stiffness of a body condensed onto master unknowns: those "
        "of all unknowns at the nodes of a mesh, of another matrix, or of a field's components. "
        "The "
        "conditions in the matrix stay on the condensed one, their unknowns being masters too, so "
        "that they can be loaded by DEPI and may be unilateral; with 'NOMU' they hold inside. "
        "EXTR SUP1 'RIGI' gives the condensed stiffness. 'CHARGE': the loads on the masters "
        "that do "
        "what the loads on the body do. 'DEPLA': the displacement of the whole body from that of "
        "the masters and its loads ('NOER' is accepted). 'MASSE': the mass that the masters feel; "
        "with 'LCHP' the displacement of the body for a unit of each master comes first.",
        "Super-éléments. 'RIGIDITE' : la rigidité d'un corps condensée sur des inconnues "
        "maîtresses "
        ": toutes les inconnues aux noeuds d'un maillage, celles d'une autre matrice, ou les "
        "composantes d'un champ. Les conditions que contient la matrice restent sur la matrice "
        "condensée, leurs inconnues étant aussi maîtresses : on peut donc les charger par DEPI et "
        "elles peuvent être unilatérales ; avec 'NOMU' elles jouent à l'intérieur. EXTR SUP1 "
        "'RIGI' "
        "donne la rigidité condensée. 'CHARGE' : les efforts sur les maîtres équivalents aux "
        "efforts sur le corps. 'DEPLA' : le déplacement de tout le corps à partir de celui des "
        "maîtres et de ses efforts ('NOER' est accepté). 'MASSE' : la masse vue par les maîtres ; "
        "avec 'LCHP' vient d'abord le déplacement du corps pour une unité de chaque maître.",
        "SUP1 = SUPE 'RIGIDITE' ('NOMU') RIG1 | GEO1 | RIG2 | CHPO1 ;\n"
        "CHPO2 = SUPE 'CHARGE' SUP1 CHPO1 ;\nCHPO3 = SUPE 'DEPLA' SUP1 CHPO1 (CHPO2) ('NOER') ;\n"
        "(LCHP1) MAS2 = SUPE 'MASSE' SUP1 MAS1 ('LCHP') ;",
        (
            "OPTI DIME 2 MODE PLAN CONT ELEM QUA4 ; S = ((0. 0.) DROI 8 (4. 0.)) TRAN 2 (0. 1.) ; "
            "MO = MODE S MECANIQUE ELASTIQUE ; L = COTE 2 S ; R = (RIGI MO (MATE MO YOUN 1.E3 NU "
            "0.3)) ET (BLOQ 'DEPL' (COTE 4 S)) ; SU = SUPE 'RIGI' 'NOMU' R L ; F = FORC (0. "
            "-1.) L ; "
            "U = RESO (EXTR SU 'RIGI') (SUPE 'CHAR' SU F) ; V = SUPE 'DEPL' SU U F ; "
            "LIST (MAXI (ABS (V - (RESO R F))) 'AVEC' (MOTS 'UX' 'UY')) ;",
        ),
    ),
    reads_itself=True,
)
def supe(call: Call) -> Any:
    """Dispatch on the keyword."""
    word = call.keyword(tuple(_FORMS))
    if word is None:
        raise call.error("operators.matrices.supe-wants-word")
    return _FORMS[word](call)


def _stiffness(call: Call) -> SuperElement:
    inside = call.keyword(("NOMU",)) is not None
    matrix: Matrix = call.required("RIGIDITE")
    inside = inside or call.keyword(("NOMU",)) is not None
    chosen = call.required("MAILLAGE", "RIGIDITE", "CHPOINT", "POINT")
    if isinstance(chosen, Matrix | NodeField):
        return condense(matrix, chosen, inside)
    nodes = chosen.node_ids if isinstance(chosen, Mesh) else np.array([chosen.node])
    return condense(matrix, nodes, inside)


def _load(call: Call) -> NodeField:
    element: SuperElement = call.required("SUPERELE")
    return condensed_load(element, call.required("CHPOINT"))


def _displacement(call: Call) -> NodeField:
    call.keyword(("NOER",))
    element: SuperElement = call.required("SUPERELE")
    masters = call.required("CHPOINT")
    load = call.optional("CHPOINT")
    call.keyword(("NOER",))
    return inner_displacement(element, masters, load)


def _mass(call: Call) -> Any:
    shapes = call.keyword(("LCHP",)) is not None
    element: SuperElement = call.required("SUPERELE")
    made = condensed_mass(element, call.required("RIGIDITE"))
    if shapes or call.keyword(("LCHP",)) is not None:
        return ListChpo(tuple(shape_fields(element))), made
    return made


_FORMS = {"RIGIDITE": _stiffness, "CHARGE": _load, "DEPLA": _displacement, "MASSE": _mass}


_PARTS: dict[str, Callable[[SuperElement], Matrix | Mesh]] = {
    "RIGI": lambda element: element.stiffness,
    "RIGT": lambda element: element.source,
    "BLOQ": lambda element: Matrix(element.source.table, (), element.source.relations),
    "ELEM": lambda element: support_mesh(element.stiffness),
}


@EXTR.on(
    "SUPERELE",
    syntax="RIG1 = EXTR SUP1 'RIGI' | 'RIGT' | 'BLOQ' ;\nGEO1 = EXTR SUP1 'ELEM' ;",
    en="Of a super-element: its condensed stiffness, the stiffness of the whole body, the "
    "conditions in it, or the mesh of its masters.",
    fr="D'un super-élément : sa rigidité condensée, la rigidité du corps entier, les conditions "
    "qu'elle contient, ou le maillage de ses maîtres.",
)
def _extract(call: Call, element: SuperElement) -> Matrix | Mesh:
    word = call.keyword(tuple(_PARTS))
    if word is None:
        raise call.error("operators.matrices.extr-of-superele-wants-word", element, words=_PARTS)
    return _PARTS[word](element)


@listing("SUPERELE")
def _listed(element: SuperElement, detail: str) -> str:
    inner = element.numbering.size - len(element.masters)
    return f"Super-element: {len(element.masters)} master unknowns, {inner} inside"
