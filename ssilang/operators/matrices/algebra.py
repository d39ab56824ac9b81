"""Signs, ET, EXTR, REDU, CHAN, LIST, XTMX, YTMX on matrices (RIGIDITE)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices import submatrices as parts
from ssilang.kernel.matrices.assembly import assemble, field_to_vector, numbering_of
from ssilang.kernel.matrices.matrix import Matrix, dual_of, imaginary
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.statics.linear import product
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots
from ssilang.operators.dispatch import CHAN, EXTR, REDU, listing, union
from ssilang.operators.numbers.arithmetic import rule

# --- signs -----------------------------------------------------------------------------------


@rule("* /", "RIGIDITE", "FLOTTANT")
@rule("* /", "RIGIDITE", "ENTIER")
def _scale(sign: str, matrix: Matrix, number: float) -> Matrix:
    return matrix.scaled(float(number) if sign == "*" else 1.0 / number)


@rule("*", "FLOTTANT", "RIGIDITE")
@rule("*", "ENTIER", "RIGIDITE")
def _scale_left(_sign: str, number: float, matrix: Matrix) -> Matrix:
    return matrix.scaled(float(number))


@rule("**", "RIGIDITE", "FLOTTANT")
@rule("**", "RIGIDITE", "ENTIER")
def _power(_sign: str, matrix: Matrix, power: float) -> Matrix:
    """Terms of the elements' matrices, each to a power; terms that are zero stay."""
    made = []
    for block in matrix.blocks:
        v = block.values
        if power != int(power) and (v < 0).any():
            raise FieldError(
                "operators.matrices.negative-terms-have-no-power", smallest=v.min(), power=power
            )
        raised = np.where(v == 0.0, 0.0, np.where(v == 0.0, 1.0, v) ** float(power))
        made.append(replace(block, values=raised, zone=None))
    return Matrix(matrix.table, tuple(made), matrix.relations, matrix.kind)


@rule("*", "RIGIDITE", "CHPOINT")
def _times_field(_sign: str, matrix: Matrix, field: NodeField) -> NodeField:
    return product(matrix, field)


@rule("*", "CHPOINT", "RIGIDITE")
def _field_times(_sign: str, field: NodeField, matrix: Matrix) -> NodeField:
    return product(matrix, field)


@rule("+", "RIGIDITE", "RIGIDITE")
def _sum(_sign: str, left: Matrix, right: Matrix) -> Matrix:
    return parts.together(left, right)


@rule("-", "RIGIDITE", "RIGIDITE")
def _difference(_sign: str, left: Matrix, right: Matrix) -> Matrix:
    return parts.together(left, right.scaled(-1.0))


@union(("RIGIDITE", "RIGIDITE"))
def _both(left: Matrix, right: Matrix) -> Matrix:
    return parts.together(left, right)


# --- parts -----------------------------------------------------------------------------------


def _points(matrix: Matrix, nodes: IntArray) -> Mesh:
    return Mesh.of(matrix.table, "POI1", nodes[:, None])


def _mesh_of(call: Call, matrix: Matrix) -> Mesh:
    word = call.keyword(("NOMU", "MULT", "UNIL"))
    if word == "NOMU":
        return parts.support_mesh(matrix)
    if word is not None:
        return _points(matrix, parts.multiplier_nodes(matrix, word == "UNIL"))
    whole = parts.support_mesh(matrix)
    points = parts.multiplier_nodes(matrix)
    if len(points) == 0:
        return whole
    return Mesh(matrix.table, (*whole.blocks, *_points(matrix, points).blocks))


def _rigi_of(call: Call, matrix: Matrix) -> Matrix:
    word = call.keyword(("NOMU", "MULT", "UNIL"))
    if word is None:
        raise call.error("operators.matrices.extr-rigi-wants-word")
    if word == "NOMU":
        return Matrix(matrix.table, matrix.blocks, (), matrix.kind)
    if word == "MULT":
        return Matrix(matrix.table, (), matrix.relations)
    kept = [parts.chosen_rows(r, r.sense != 0) for r in matrix.relations]
    return Matrix(matrix.table, (), tuple(r for r in kept if len(r)))


def _names_of(call: Call, matrix: Matrix) -> ListMots:
    return ListMots(parts.unknown_names(matrix, call.keyword(("DUAL",)) is not None))


_EXTRACTED: dict[str, Callable[[Call, Matrix], Any]] = {
    "MAIL": _mesh_of,
    "RIGI": _rigi_of,
    "COMP": _names_of,
    "DIAG": lambda _, matrix: parts.diagonal(matrix),
    "SYME": lambda _, matrix: parts.symmetric_part(matrix, 1.0),
    "ANTI": lambda _, matrix: parts.symmetric_part(matrix, -1.0),
}


@EXTR.on(
    "RIGIDITE",
    syntax="GEO1 = EXTR RIG1 'MAIL' ('NOMU' | 'MULT' | 'UNIL') ;\n"
    "RIG2 = EXTR RIG1 'RIGI' 'NOMU' | 'MULT' | 'UNIL' ;\nRIG2 = EXTR RIG1 'SYME' | 'ANTI' ;\n"
    "LISTMOTS1 = EXTR RIG1 'COMP' ('DUAL') ;\nCHPO1 = EXTR RIG1 'DIAG' ;\n"
    "RIG2 = EXTR RIG1 MOT1 MOT2 | LISTMOTS1 LISTMOTS2 ;",
    en="Of a matrix: its mesh (without or with only the nodes of multipliers), its element "
    "matrices or its conditions, its symmetric or antisymmetric part, the names of its unknowns, "
    "its diagonal, or the terms of some unknowns and equations.",
    fr="D'une rigidité : son maillage (sans les multiplicateurs, ou eux seuls), ses matrices "
    "élémentaires ou ses conditions, sa partie symétrique ou antisymétrique, les noms de ses "
    "inconnues, sa diagonale, ou les termes de certaines inconnues et équations.",
    examples=("OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; LIST (EXTR (APPU UX 2. P1) 'DIAG') ;",),
)
def _extract(call: Call, matrix: Matrix) -> Any:
    word = call.keyword(tuple(_EXTRACTED))
    if word is not None:
        return _EXTRACTED[word](call, matrix)
    lists = call.all("LISTMOTS")
    names = lists if len(lists) == 2 else [ListMots([w]) for w in (call.word(), call.word()) if w]
    if len(names) != 2:
        raise call.error("operators.matrices.extr-wants-word-or-names", matrix, words=_EXTRACTED)
    primal, dual = ({str(w).upper().rstrip() for w in n.values} for n in names)
    return parts.named_part(matrix, primal, dual)


@REDU.on(
    "RIGIDITE",
    syntax="RIG2 = REDU RIG1 GEO1 ;",
    en="A matrix keeps the element matrices of the cells of the mesh, and the conditions on its "
    "nodes.",
    fr="Une rigidité garde les matrices des éléments du maillage, et les conditions portant sur "
    "ses nœuds.",
)
def _reduced(call: Call, matrix: Matrix) -> Matrix:
    return parts.on_mesh(matrix, call.required("MAILLAGE"))


@CHAN.on(
    "TYPE",
    of=("RIGIDITE",),
    syntax="RIG2 = CHAN 'TYPE' RIG1 MOT1 ;",
    en="The same matrix of another kind ('RIGIDITE', 'MASSE', 'AMORTISS').",
    fr="La même matrice avec un autre sous-type ('RIGIDITE', 'MASSE', 'AMORTISS').",
)
def _kind(call: Call, word: str) -> Matrix:
    matrix: Matrix = call.required("RIGIDITE")
    kind = call.required("MOT").upper().rstrip()
    blocks = tuple(replace(b, kind=kind, zone=None) for b in matrix.blocks)
    return Matrix(matrix.table, blocks, matrix.relations, kind)


@CHAN.on(
    "DEPE",
    of=("RIGIDITE",),
    syntax="RIG2 = CHAN 'DEPE' RIG1 ;",
    en="Relations to be eliminated by RESO: RESO eliminates all it can, so they stay as they are.",
    fr="Relations à éliminer par RESO : RESO les élimine toujours quand il le peut, elles restent "
    "telles quelles.",
)
def _dependent(call: Call, word: str) -> Matrix:
    return call.required("RIGIDITE")  # type: ignore[no-any-return]


@CHAN.on(
    "INCO",
    of=("RIGIDITE",),
    syntax="RIG2 = CHAN 'INCO' RIG1 LISTMOTS1 LISTMOTS2 LISTMOTS3 LISTMOTS4 | MOT1 MOT2 MOT3 MOT4 "
    "| 'COMP' ('SYME' | 'ANTI' | 'QUEL') ('DUPL') ;",
    en="Gives the unknowns (first two lists: old, new names) and equations (last two) of a matrix "
    "other names (or old names in the first two lists, new ones in the last two);"
    " 'COMP' puts an I (imaginary part) before all of them, if there are no "
    "conditions. The result counts as unsymmetric unless 'SYME' is said. 'DUPL' gives each "
    "condition a multiplier of its own, so that it stands beside that from which it is made.",
    fr="Change les noms des inconnues (deux premières listes : anciens, nouveaux) et des équations "
    "(deux dernières) d'une rigidité (ou anciens noms dans les deux premières listes, nouveaux "
    "dans les deux dernières) ; 'COMP' met un I (partie imaginaire) devant tous, s'il n'y a "
    "pas de condition. Le résultat est quelconque sauf si 'SYME' est dit. 'DUPL' donne à chaque "
    "condition son propre multiplicateur, pour qu'elle s'ajoute à celle dont elle vient.",
)
def _other_names(call: Call, word: str) -> Matrix:
    matrix: Matrix = call.required("RIGIDITE")
    primal, dual = _name_changes(call, matrix)
    shape = own = None
    while (said := call.keyword(("SYME", "ANTI", "QUEL", "DUPL"))) is not None:
        shape, own = (shape, said) if said == "DUPL" else (said, own)
    made = parts.renamed(matrix, primal, dual, shape == "SYME")
    return parts.with_own_multipliers(made) if own else made


def _name_changes(call: Call, matrix: Matrix) -> tuple[dict[str, str], dict[str, str]]:
    """Old names of unknowns and of equations with the new ones."""
    lists = [[str(w).rstrip() for w in v.values] for v in call.all("LISTMOTS")]
    if not lists and call.keyword(("COMP",)) is not None:
        if matrix.relations:
            raise call.error("operators.matrices.conditions-not-imaginary", matrix)
        return (
            {u: imaginary(u) for b in matrix.blocks for u in b.unknowns},
            {d: imaginary(d) for b in matrix.blocks for d in b.duals},
        )
    if not lists:
        lists = [[w.upper().rstrip()] for w in (call.word() for _ in range(4)) if w]
    if len(lists) != 4 or len(lists[0]) != len(lists[1]) or len(lists[2]) != len(lists[3]):
        raise call.error("operators.matrices.inco-wants-four-lists")
    equations = {d for b in matrix.blocks for d in b.duals}
    equations |= {dual_of(u) for r in matrix.relations for u in (*r.unknowns, "LX")}
    if set(lists[1]) <= equations and len(lists[0]) == len(lists[2]):
        # the notice's example: old unknowns, old equations, new unknowns, new equations
        lists[1], lists[2] = lists[2], lists[1]
    primal = dict(zip(lists[0], lists[1], strict=True))
    if primal.get("LX", "LX") != "LX":
        raise call.error("operators.matrices.multiplier-keeps-its-name")
    return primal, dict(zip(lists[2], lists[3], strict=True))


@listing("RIGIDITE")
def _listed(matrix: Matrix, detail: str) -> str:
    return "\n".join(parts.listed(matrix, not detail))


# --- quadratic forms -------------------------------------------------------------------------


def _form(left: NodeField, matrix: Matrix, right: NodeField) -> float:
    numbering = numbering_of(matrix)
    y = field_to_vector(left, numbering, dual=False)
    x = field_to_vector(right, numbering, dual=False)
    return float(y @ (assemble(matrix, numbering) @ x))


@operator(
    "XTMX",
    arg("field", "CHPOINT"),
    arg("matrix", "RIGIDITE"),
    family="matrix",
    help=Help(
        "Quadratic form X^T M X of a field and a matrix.",
        "Forme quadratique X^T M X d'un champ et d'une rigidité.",
        "X1 = XTMX CHPO1 RIG1 ;",
        (
            "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; U1 = MANU 'CHPO' P1 1 'UX' 3. ;"
            " LIST (XTMX U1 (APPU 'UX' 2. P1)) ;",
        ),
    ),
)
def xtmx(field: NodeField, matrix: Matrix) -> float:
    return _form(field, matrix, field)


@operator(
    "YTMX",
    arg("right", "CHPOINT"),
    arg("left", "CHPOINT"),
    arg("matrix", "RIGIDITE"),
    family="matrix",
    help=Help(
        "Bilinear form Y^T M X of two fields (X first) and a matrix.",
        "Forme bilinéaire Y^T M X de deux champs (X d'abord) et d'une rigidité.",
        "X1 = YTMX CHPO1 CHPO2 RIG1 ;",
        (
            "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; U1 = MANU 'CHPO' P1 1 'UX' 3. ;"
            " LIST (YTMX U1 U1 (APPU 'UX' 2. P1)) ;",
        ),
    ),
)
def ytmx(right: NodeField, left: NodeField, matrix: Matrix) -> float:
    return _form(left, matrix, right)
