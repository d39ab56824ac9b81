"""MANU 'RIGI': matrices written by hand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.build import field_diagonal, repeated_matrix
from ssilang.kernel.matrices.by_hand import column, from_columns, square
from ssilang.kernel.matrices.matrix import Matrix, dual_of
from ssilang.kernel.mesh.cells import CELL_TYPES, many_noded
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.language.registry import Keyword, arg, choice, flag, key, many, said
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListMots, ListReel
from ssilang.language.vocabulary.terms import ANY_NUMBER
from ssilang.operators.dispatch import MANU
from ssilang.operators.matrices.supports import nodes_of

_SIGN = {"SYME": 1.0, "ANTI": -1.0, "QUEL": None}


_KIND = key("kind", "TYPE", arg("word", "MOT"), en="kind, such as RIGIDITE (default) or MASSE")


def _sign(words: Sequence[str]) -> Keyword:
    return choice("sign", words, en="symmetric, antisymmetric or any")


@MANU.form(
    said("RIGIDITE"),
    _KIND,
    arg("support", "MAILLAGE", "POINT", en="cells"),
    key("dual", "DUAL", many("names", "LISTMOTS", at_least=1), en="names of the equations"),
    _sign(("ANTI", "QUEL")),
    many(
        "primal",
        "LISTMOTS",
        at_least=1,
        kind="component",
        en="unknowns of a node, or one list a node",
    ),
    many(
        "rows",
        "LISTREEL",
        at_least=1,
        en="terms row by row, all or the lower triangle",
        range=ANY_NUMBER,
    ),
    syntax="RIG1 = MANU 'RIGI' ('TYPE' MOT1) GEO1 LMOT1 ... ('DUAL' LMOT2 ...) ('ANTI' | 'QUEL') "
    "LREEL1 ... ;",
    en="Matrix by hand. The same element matrix on all cells of a mesh: names of the unknowns of a "
    "node (or one list a node), then its terms row by row, all or the lower triangle, in one list "
    "or one a row. A field gives a diagonal, or the column (row) of one unknown. A list of fields "
    "gives the columns of a matrix on modal unknowns.",
    examples=(
        "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ;"
        " M1 = MANU 'RIGI' 'TYPE' 'MASSE' P1 (MOTS 'UX' 'UY') (PROG 3. 0. 3.) ;"
        " LIST (EXTR M1 'DIAG') ;",
    ),
)
def repeated(
    call: Call,
    kind: str | None,
    support: Mesh | Point,
    dual: tuple[ListMots, ...] | None,
    sign: str | None,
    primal: tuple[ListMots, ...],
    rows: tuple[ListReel, ...],
) -> Matrix:
    """The same matrix on all cells of a mesh."""
    mesh = support
    if isinstance(mesh, Point):
        mesh = Mesh.of(mesh.nodes, "POI1", np.array([[mesh.number]]))
    if not mesh.blocks:
        raise call.error("operators.matrices.matrix-mesh-empty", support)
    unknowns = _names(primal)
    nodes = CELL_TYPES[mesh.blocks[0].cell_type].n_nodes if len(unknowns) == 1 else 1
    size = sum(len(n) for n in unknowns) * nodes
    factor = _SIGN[sign or "SYME"]
    terms = square([r.values for r in rows], size, factor)
    equations = None if dual is None else _names(dual)
    return repeated_matrix(mesh, unknowns, equations, terms, _kind(kind), factor == 1.0)


@MANU.form(
    said("RIGIDITE"),
    choice("shape", ("COLO", "LIGN"), optional=False, en="column or row"),
    _KIND,
    _sign(tuple(_SIGN)),
    key(
        "partner",
        ("DUAL", "PRIM"),
        arg("name", "MOT", kind="component"),
        en="its equation, or its unknown",
    ),
    arg("field", "CHPOINT", en="terms"),
    arg("point", "POINT", en="node of the unknown"),
    arg("name", "MOT", kind="component", en="unknown or equation"),
    many("lists", "LISTMOTS", en="other names of the field"),
    of=("CHPOINT",),
    syntax="RIG1 = MANU 'RIGI' CHPO1 'COLO' | 'LIGN' ('SYME' | 'ANTI' | 'QUEL') P1 MOT2 "
    "('DUAL' | 'PRIM' MOT3) (LMOT1 LMOT2) ('TYPE' MOT1) ;",
)
def one_column(
    shape: str,
    kind: str | None,
    sign: str | None,
    partner: tuple[str, str] | None,
    field: NodeField,
    point: Point,
    name: str,
    lists: tuple[ListMots, ...],
) -> Matrix:
    """The column, or the row, of one unknown."""
    told = name.upper().rstrip()
    other = "" if partner is None else partner[1].upper().rstrip()
    if shape == "COLO":
        unknown, dual = told, other or dual_of(told)
    else:
        unknown, dual = other or told, told if other else dual_of(told)
    pairs = _names(lists)
    names = dict(zip(*pairs, strict=True)) if len(pairs) == 2 else None
    factor = _SIGN[sign or "QUEL"]
    return column(field, point.node, unknown, dual, _kind(kind), factor, shape == "LIGN", names)


@MANU.form(
    said("RIGIDITE"),
    _KIND,
    flag("diagonal", "DIAG", en="a diagonal"),
    arg("field", "CHPOINT", en="terms of the diagonal"),
    of=("CHPOINT",),
    syntax="RIG1 = MANU 'RIGI' CHPO1 ('DIAG') ('TYPE' MOT1) ;",
)
def diagonal(kind: str | None, diagonal: bool, field: NodeField) -> Matrix:
    """A diagonal matrix."""
    return field_diagonal(field, _kind(kind))


@MANU.form(
    said("RIGIDITE"),
    _KIND,
    arg("fields", "LISTCHPO", en="columns"),
    arg("mesh", "MAILLAGE", en="points of the modes"),
    of=("LISTCHPO",),
    syntax="RIG1 = MANU 'RIGI' LCHPO1 GEO1 ('TYPE' MOT1) ;",
)
def modal_matrix(kind: str | None, fields: ListChpo, mesh: Mesh) -> Matrix:
    """A matrix on modal unknowns, from its columns."""
    columns = [f for f in fields.values if isinstance(f, NodeField)]
    return from_columns(mesh.nodes, mesh.node_ids, columns, _kind(kind, "MONODROM"))


@MANU.form(
    said("SUPE", "MULT"),
    many("places", "POINT", "MAILLAGE", at_least=1, en="points"),
    syntax="GEO1 = MANU 'SUPE' | 'MULT' P1 (P2 ...) | GEO2 ;",
    en="'SUPE' and 'MULT' make one cell of all the points given, to carry a matrix by hand.",
    examples=(
        "OPTI DIME 2 ; G1 = MANU 'SUPE' (0. 0.) (1. 0.) (2. 0.) ; LIST (NBEL G1) ;"
        " R1 = MANU 'RIGI' G1 (MOTS 'ALFA') (PROG 1. 0. 2. 0. 0. 3.) ;",
    ),
)
def one_cell(call: Call, word: str, places: tuple[Mesh | Point, ...]) -> Mesh:
    """One cell of all the points."""
    nodes = np.concatenate([nodes_of(p) for p in places])
    if len(np.unique(nodes)) != len(nodes):
        raise call.error("operators.matrices.point-twice-in-cell")
    return Mesh.of(places[0].nodes, many_noded(word, len(nodes)), nodes[None, :])


def _kind(word: str | None, default: str = "RIGIDITE") -> str:
    return default if word is None else word.upper().rstrip()


def _names(lists: Iterable[ListMots]) -> list[tuple[str, ...]]:
    return [tuple(str(w).upper().rstrip() for w in names.values) for names in lists]
