"""MANU 'RIGI': matrices written by hand."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.build import field_diagonal, repeated_matrix
from ssilang.kernel.matrices.by_hand import column, from_columns, square
from ssilang.kernel.matrices.matrix import Matrix, dual_of
from ssilang.kernel.mesh.cells import CELL_TYPES, many_noded
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListMots
from ssilang.operators.dispatch import MANU
from ssilang.operators.matrices.supports import nodes_of

_SIGN = {"SYME": 1.0, "ANTI": -1.0, "QUEL": None}


@MANU.on(
    "RIGIDITE",
    syntax="RIG1 = MANU 'RIGI' ('TYPE' MOT1) GEO1 LMOT1 ... ('DUAL' LMOT2 ...) ('ANTI' | 'QUEL') "
    "LREEL1 ... ;\n"
    "RIG1 = MANU 'RIGI' CHPO1 ('DIAG') ('TYPE' MOT1) ;\n"
    "RIG1 = MANU 'RIGI' CHPO1 'COLO' | 'LIGN' ('SYME' | 'ANTI' | 'QUEL') P1 MOT2 "
    "('DUAL' | 'PRIM' MOT3) (LMOT1 LMOT2) ('TYPE' MOT1) ;\n"
    "RIG1 = MANU 'RIGI' LCHPO1 GEO1 ('TYPE' MOT1) ;",
    en="Matrix by hand. The same element matrix on all cells of a mesh: names of the unknowns of a "
    "node (or one list a node), then its terms row by row, all or the lower triangle, in one list "
    "or one a row. A field gives a diagonal, or the column (row) of one unknown. A list of fields "
    "gives the columns of a matrix on modal unknowns.",
    fr="Rigidité fabriquée à la main. La même matrice sur tous les éléments d'un maillage : noms "
    "des inconnues d'un nœud (ou une liste par nœud), puis ses termes ligne par ligne, tous ou le "
    "triangle inférieur, en une liste ou une par ligne. Un champ donne une diagonale, ou la "
    "colonne (ligne) d'une inconnue. Une liste de champs donne les colonnes d'une matrice sur des "
    "inconnues modales.",
    examples=(
        "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ;"
        " M1 = MANU 'RIGI' 'TYPE' 'MASSE' P1 (MOTS 'UX' 'UY') (PROG 3. 0. 3.) ;"
        " LIST (EXTR M1 'DIAG') ;",
    ),
)
def _rigidity(call: Call, word: str) -> Matrix:
    kind = _kind(call, "RIGIDITE")
    field = call.read("CHPOINT")
    if field is not None:
        return _from_field(call, field.value, kind)
    several = call.read("LISTCHPO")
    if several is not None:
        return _from_list(call, several.value, kind)
    return _repeated(call, kind)


@MANU.on(
    "SUPE",
    "MULT",
    syntax="GEO1 = MANU 'SUPE' | 'MULT' P1 (P2 ...) | GEO2 ;",
    en="'SUPE' and 'MULT' make one cell of all the points given, to carry a matrix by hand.",
    fr="'SUPE' et 'MULT' font un seul élément de tous les points donnés, support d'une rigidité "
    "manuelle.",
    examples=(
        "OPTI DIME 2 ; G1 = MANU 'SUPE' (0. 0.) (1. 0.) (2. 0.) ; LIST (NBEL G1) ;"
        " R1 = MANU 'RIGI' G1 (MOTS 'ALFA') (PROG 1. 0. 2. 0. 0. 3.) ;",
    ),
)
def _one_cell(call: Call, word: str) -> Mesh:
    places = [call.required("POINT", "MAILLAGE"), *call.all("POINT", "MAILLAGE")]
    nodes = np.concatenate([nodes_of(p) for p in places])
    if len(np.unique(nodes)) != len(nodes):
        raise call.error("operators.matrices.point-twice-in-cell")
    return Mesh.of(places[0].nodes, many_noded(word, len(nodes)), nodes[None, :])


def _kind(call: Call, default: str) -> str:
    if call.keyword(("TYPE",)) is None:
        return default
    return str(call.required("MOT", after=call.keyword_end)).upper().rstrip()


def _names(lists: list[ListMots]) -> list[tuple[str, ...]]:
    return [tuple(str(w).upper().rstrip() for w in names.values) for names in lists]


def _repeated(call: Call, kind: str) -> Matrix:
    support = call.required("MAILLAGE", "POINT")
    mesh = support
    if isinstance(support, Point):
        mesh = Mesh.of(support.nodes, "POI1", np.array([[support.number]]))
    primal = _names(call.all("LISTMOTS"))
    kind = _kind(call, kind)
    dual = _names(call.all("LISTMOTS")) if call.keyword(("DUAL",)) else None
    sign = _SIGN[call.keyword(("ANTI", "QUEL")) or "SYME"]
    if not primal:
        raise call.missing(("LISTMOTS",))
    rows = [r.values for r in (call.required("LISTREEL"), *call.all("LISTREEL"))]
    kind = _kind(call, kind)
    if not mesh.blocks:
        raise call.error("operators.matrices.matrix-mesh-empty", support)
    nodes = CELL_TYPES[mesh.blocks[0].cell_type].n_nodes if len(primal) == 1 else 1
    size = sum(len(n) for n in primal) * nodes
    return repeated_matrix(mesh, primal, dual, square(rows, size, sign), kind, sign == 1.0)


def _from_field(call: Call, field: NodeField, kind: str) -> Matrix:
    shape = call.keyword(("DIAG", "COLO", "LIGN"))
    kind = _kind(call, kind)
    if shape not in ("COLO", "LIGN"):
        return field_diagonal(field, kind)
    sign = _SIGN[call.keyword(tuple(_SIGN)) or "QUEL"]
    point: Point = call.required("POINT")
    said = str(call.required("MOT")).upper().rstrip()
    other = call.keyword(("DUAL", "PRIM"))
    partner = str(call.required("MOT", after=call.keyword_end)).upper().rstrip() if other else ""
    if shape == "COLO":
        unknown, dual = said, partner or dual_of(said)
    else:
        unknown, dual = partner or said, said if partner else dual_of(said)
    lists = _names(call.all("LISTMOTS"))
    names = dict(zip(*lists, strict=True)) if len(lists) == 2 else None
    return column(field, point.node, unknown, dual, _kind(call, kind), sign, shape == "LIGN", names)


def _from_list(call: Call, fields: ListChpo, kind: str) -> Matrix:
    mesh: Mesh = call.required("MAILLAGE")
    columns = [f for f in fields.values if isinstance(f, NodeField)]
    return from_columns(mesh.nodes, mesh.node_ids, columns, _kind(call, "MONODROM"))
