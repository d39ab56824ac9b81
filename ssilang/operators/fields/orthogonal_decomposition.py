"""MAX1 DFOU PSIP POD: fields brought to one, Fourier sums, distances, orthogonal decomposition."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.fields import node_algebra
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.fields.proper_orthogonal import as_fields, modes, stacked
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.queries.signed_distance import beyond_front, beyond_tip, signed_distance
from ssilang.language.registry import (
    Chosen,
    Help,
    Like,
    arg,
    by,
    choice,
    flag,
    many,
    operator,
    opt,
    select,
)
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListEnti, ListMots, ListReel, Mot, Table
from ssilang.operators.workspace import workspace

_LINE = "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (2. 0.) ; X = COOR 1 L ; "


@operator(
    "MAX1",
    arg("field", "CHPOINT", en="field", fr="champ"),
    choice(
        "which",
        ("AVEC", "SANS"),
        en="the components of the list, or all but them",
        fr="les composantes de la liste, ou toutes sauf elles",
    ),
    opt("names", "LISTMOTS", kind="component", en="components", fr="composantes"),
    family="fields",
    help=Help(
        en="Nodal field divided by its value of largest size, which becomes 1; among the "
        "components named ('AVEC', may be left out) or not named ('SANS') by a list.",
        fr="Champ par points divisé par sa valeur de plus grande taille, qui devient 1 ; parmi "
        "les composantes nommées ('AVEC', facultatif) ou non nommées ('SANS') par une liste.",
        syntax="CHP1 = MAX1 CHP2 (('AVEC') | 'SANS' LMOTS1) ;",
        examples=(_LINE + "LIST (MINI (MAX1 (X - 4.))) ;",),
    ),
)
def max1(call: Call, field: NodeField, which: str | None, names: ListMots | None) -> NodeField:
    """Bring a field to one."""
    chosen = list(field.components)
    if names is not None:
        words = {str(w).rstrip() for w in names.values}
        chosen = [n for n in chosen if (n in words) != (which == "SANS")]
    values = [field.components[n].values for n in chosen]
    every = np.concatenate(values) if values else np.zeros(0)
    largest = float(every[np.argmax(np.abs(every))]) if len(every) else 0.0
    if largest == 0.0:
        raise call.error("operators.fields.field-is-zero", field)
    return node_algebra.applied(field, lambda v: v / largest)


_ODD = {
    "UT", "FT", "SMRT", "SMZT", "GART", "GAZT", "EPRT", "EPZT", "GAST", "RTST", "NSST", "MSST",
    "NST", "MST", "RR", "RZ", "MR", "MZ",
}  # fmt: skip
"""Components that go with the sine of a symmetric harmonic; the others go with the cosine."""


@operator(
    "DFOU",
    arg("field", "CHPOINT", "MCHAML", en="field of a harmonic", fr="champ d'une harmonique"),
    arg("angle", "FLOTTANT", en="angle", fr="angle", unit="deg"),
    gives=Like("field"),
    family="fields",
    full_name="DFOURIER",
    help=Help(
        en="Values at an angle (degrees) of a field of the Fourier harmonic n that OPTI says: "
        "cos(n a) for UR UZ, their forces, the stresses and strains of the meridian plane and the "
        "hoop ones, sin(n a) for UT and the shears RT ZT; for a negative n sin(|n| a) and "
        "cos(|n| a).",
        fr="Valeurs à un angle (degrés) d'un champ de l'harmonique de Fourier n que dit OPTI : "
        "cos(n a) pour UR UZ, leurs forces, les contraintes et déformations du plan méridien et "
        "orthoradiales, sin(n a) pour UT et les cisaillements RT ZT ; pour n négatif sin(|n| a) "
        "et cos(|n| a).",
        syntax="CH2 = DFOU CH1 X1 ;",
        examples=(
            "OPTI DIME 2 MODE FOUR 2 ; P = 1. 0. ; "
            "U = MANU 'CHPO' P 2 'UR' 3. 'UT' 4. ; LIST (DFOU U 90.) ;",
        ),
    ),
)
def dfou(call: Call, field: NodeField | CellField, angle: float) -> NodeField | CellField:
    """Sum a harmonic."""
    n = workspace(call.session).fourier
    turn = np.radians(abs(n) * angle)
    even, odd = (np.cos(turn), np.sin(turn)) if n >= 0 else (np.sin(turn), np.cos(turn))
    if n == 0:
        odd = 1.0  # harmonic 0: uniform stretching and uniform torsion, uncoupled

    def factor(name: str) -> float:
        return float(odd if name in _ODD else even)

    if isinstance(field, NodeField):
        made = {k: NodeValues(v.nodes, factor(k) * v.values) for k, v in field.components.items()}
        return replace(field, components=made)
    blocks = tuple(
        replace(b, components={k: factor(k) * v for k, v in b.components.items()})
        for b in field.blocks
    )
    return replace(field, blocks=blocks)


_ENDS = many(
    "ends",
    "POINT",
    "MAILLAGE",
    en="ends of the line (2D) or front of the surface (3D)",
    fr="bouts de la ligne (2D) ou front de la surface (3D)",
)


@operator(
    "PSIP",
    arg("place", "MAILLAGE", "POINT", en="where", fr="où"),
    arg("mesh", "MAILLAGE", en="line or surface", fr="ligne ou surface"),
    opt(
        "reach",
        "FLOTTANT",
        en="nodes farther away (largest coordinate) are left out",
        fr="les noeuds plus loin (plus grande coordonnée) sont exclus",
        unit="m",
    ),
    select(
        "ahead",
        {"DEUX": [_ENDS], "TROI": [_ENDS]},
        en="distances ahead of the ends too, and the abscissa along a front",
        fr="aussi les distances en avant des bouts, et l'abscisse le long d'un front",
    ),
    gives=by("ahead", {"DEUX": ("CHPOINT",) * 2, "TROI": ("CHPOINT",) * 3}, "CHPOINT"),
    family="fields",
    help=Help(
        en="Signed distance PHI of the nodes of a mesh to a line (SEG2, in 2D) or a surface (TRI3, "
        "QUA4, in 3D), positive on the side of its normals (to the left of a line); nodes farther "
        "than a number (largest coordinate) are left out. 'DEUX' adds the signed distance PSI "
        "ahead of the line's ends given as points, or of the surface's front given as a mesh of "
        "SEG2; 'TROI' (3D) the abscissa TAU along the front besides.",
        fr="Distance signée PHI des noeuds d'un maillage à une ligne (SEG2, en 2D) ou une surface "
        "(TRI3, QUA4, en 3D), positive du côté de ses normales (à gauche d'une ligne) ; les "
        "noeuds plus loin qu'un nombre (plus grande coordonnée) sont exclus. 'DEUX' ajoute la "
        "distance signée PSI en avant des bouts de la ligne donnés en points, ou du front de la "
        "surface donné en maillage de SEG2 ; 'TROI' (3D) de plus l'abscisse TAU le long du front.",
        syntax="CHP1 = PSIP MAIL1 MAIL2 (X1) ;\nCHP1 CHP2 = PSIP MAIL1 MAIL2 (X1) 'DEUX' P1 (P2) "
        "| MAIL3 ; CHP1 CHP2 CHP3 = PSIP MAIL1 MAIL2 (X1) 'TROI' MAIL3 ;",
        examples=(
            _LINE + "P = (0.5 2.) ET (3. -1.) ; LIST (PSIP P L) ;",
            (
                "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; B = 2. 0. ; L = DROI 2 A B ;\n"
                "P = MANU 'POI1' (0.5 2.) ;\n"
                "D1 D2 = PSIP P L 'DEUX' B ; MESS (MAXI D1) (MAXI D2) ;"
            ),
            (
                "OPTI DIME 3 ELEM QUA4 ; L = DROI 2 (0 0 0) (2 0 0) ; S = L TRAN 2 (0 1 0) ;\n"
                "P = MANU 'POI1' (0.5 0.5 2) ;\n"
                "D1 D2 D3 = PSIP P S 'TROI' L ; MESS (MAXI D1) (MAXI D2) (MAXI D3) ;"
            ),
        ),
    ),
)
def psip(
    call: Call, place: Mesh | Point, mesh: Mesh, reach: float | None, ahead: Chosen | None
) -> NodeField | tuple[NodeField, ...]:
    """Signed distances."""
    ws = workspace(call.session)
    nodes = np.array([place.node]) if isinstance(place, Point) else place.sorted_node_ids
    points = ws.nodes.coordinates[nodes]
    phi = signed_distance(points, mesh, ws.dimension)
    rows = {"PHI": phi}
    if ahead is not None:
        rows |= _ahead(call, ahead.word, points, mesh, ahead["ends"])
    kept = np.ones(len(nodes), bool) if reach is None else _near(points, mesh, reach)
    made = [NodeField.of(ws.nodes, nodes[kept], {k: v[kept]}, "DIFFUS") for k, v in rows.items()]
    return made[0] if len(made) == 1 else tuple(made)


def _near(points: Any, mesh: Mesh, reach: float) -> Any:
    """Points within a reach (largest coordinate) of a node of the mesh."""
    from scipy.spatial import cKDTree

    tree = cKDTree(mesh.nodes.coordinates[mesh.sorted_node_ids])
    return tree.query(points, p=np.inf)[0] <= reach


def _ahead(call: Call, word: str, points: Any, mesh: Mesh, ends: tuple[Any, ...]) -> dict[str, Any]:
    if workspace(call.session).dimension == 2:
        fits = word == "DEUX" and len(ends) in (1, 2)
        if not fits or not all(isinstance(e, Point) for e in ends):
            raise call.error("operators.fields.ends-are-points")
        return {"PSI": beyond_tip(points, mesh, tuple(e.node for e in ends))}
    if len(ends) != 1 or not isinstance(ends[0], Mesh):
        raise call.error("operators.fields.front-is-a-line-mesh", word=word)
    ahead, along = beyond_front(points, mesh, ends[0])
    return {"PSI": ahead} | ({"TAU": along} if word == "TROI" else {})


_METHOD = choice(
    "method",
    ("SNAPSHOTS", "CLASSIQUE"),
    en="for few fields, or for few unknowns",
    fr="pour peu de champs, ou pour peu d'inconnues",
)
_TABLE = flag(
    "table",
    "TBAS",
    en="the result is a table BASE_MODALE",
    fr="le résultat est une table BASE_MODALE",
)
_OPTIONS = (
    opt("numbers", "LISTENTI", en="fields to take, by number", fr="champs à prendre, par numéro"),
    opt("names", "LISTMOTS", kind="component", en="components", fr="composantes"),
    opt("matrix", "RIGIDITE", en="scalar product, a mass", fr="produit scalaire, une masse"),
    arg("count", "ENTIER", en="number of modes", fr="nombre de modes"),
    opt("support", "MAILLAGE", en="mesh told by the table", fr="maillage mis dans la table"),
)


@operator(
    "POD",
    _METHOD,
    _TABLE,
    arg("fields", "LISTCHPO", en="fields", fr="champs"),
    *_OPTIONS,
    gives=by("table", {True: "TABLE"}, ("LISTCHPO", "LISTREEL")),
    family="modal",
    full_name="POD",
    help=Help(
        en="Proper orthogonal decomposition of a list of fields, or of a result of PASAPAS or "
        "DYNAMIC (entry DEPLACEMENTS, DEPL, or the one named): the first modes (largest value 1) "
        "and their eigenvalues, decreasing. A list of integers chooses fields (from 1; of a table "
        "its indices), a list of words components, a matrix (a mass) the scalar product. "
        "'SNAPSHOTS' for few fields, 'CLASSIQUE' for few unknowns. 'TBAS': a table BASE_MODALE.",
        fr="Décomposition orthogonale aux valeurs propres d'une liste de champs, ou d'un résultat "
        "de PASAPAS ou DYNAMIC (indice DEPLACEMENTS, DEPL, ou celui nommé) : les premiers modes "
        "(plus grande valeur 1) et leurs valeurs propres, décroissantes. Une liste d'entiers "
        "choisit les champs (à partir de 1 ; d'une table ses indices), une liste de mots les "
        "composantes, une matrice (masse) le produit scalaire. 'SNAPSHOTS' pour peu de champs, "
        "'CLASSIQUE' pour peu d'inconnues. 'TBAS' : une table BASE_MODALE.",
        syntax="LPOD1 LVAL1 = POD LCHPO1 | TAB1 (MOT1) (LENTI1) (LMOTS1) 'SNAPSHOTS' | 'CLASSIQUE' "
        "(MASS1) N1 ;\nTPOD1 = POD ... N1 'TBAS' (MAIL1) ;",
        examples=(
            _LINE + "LC = (SUIT X) ET (2. * X) ET (X - 1.) ; M V = POD LC 'CLASSIQUE' 2 ; LIST V ;",
            (
                "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ;\n"
                "U = NOMC 'UX' (COOR 1 L) ;\n"
                "S = SUIT U (2. * U) (U ** 2) ; M V = POD S 'SNAPSHOTS' 2 ; LIST V ;\n"
                "T = POD S (LECT 1 2 3) (MOTS 'UX') 'SNAPSHOTS' 2 'TBAS' L ; LIST (TYPE T) ;"
            ),
            (
                "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ;\n"
                "U = NOMC 'UX' (COOR 1 L) ;\n"
                "T = TABL ; T . 'DEPLACEMENTS' = TABL ;\n"
                "T . 'DEPLACEMENTS' . 0 = U ; T . 'DEPLACEMENTS' . 1 = U ** 2 ;\n"
                "M V = POD T 'CLASSIQUE' 1 ; LIST V ;"
            ),
        ),
    ),
)
def pod(call: Call, fields: ListChpo, **said: Any) -> Table | tuple[ListChpo, ListReel]:
    """Orthogonal decomposition of a list of fields."""
    pairs = {i: f for i, f in enumerate(fields.values, 1) if isinstance(f, NodeField)}
    return _decomposed(call, fields, pairs, **said)


@pod.form(
    _METHOD,
    _TABLE,
    arg("result", "TABLE", en="result of a calculation", fr="résultat d'un calcul"),
    opt("entry", "MOT", en="entry that holds the fields", fr="entrée qui contient les champs"),
    *_OPTIONS,
    gives=by("table", {True: "TABLE"}, ("LISTCHPO", "LISTREEL")),
)
def pod_of_table(
    call: Call, result: Table, entry: str | None, **said: Any
) -> Table | tuple[ListChpo, ListReel]:
    """Orthogonal decomposition of the fields of a result."""
    return _decomposed(call, result, _of_table(call, result, entry), **said)


def _decomposed(
    call: Call,
    held: ListChpo | Table,
    fields: dict[int, NodeField],
    method: str | None,
    table: bool,
    numbers: ListEnti | None,
    names: ListMots | None,
    matrix: Matrix | None,
    count: int,
    support: Mesh | None,
) -> Table | tuple[ListChpo, ListReel]:
    if not fields:
        raise call.error("operators.fields.no-field-to-decompose", held)
    if count < 1 or method is None:
        raise call.error("operators.fields.pod-method-and-count")
    if numbers is not None:
        missing = [int(i) for i in numbers.values if int(i) not in fields]
        if missing:
            raise call.error("operators.fields.no-field-number", numbers, number=missing[0])
        fields = {int(i): fields[int(i)] for i in numbers.values}
    wanted = None if names is None else [str(n).rstrip() for n in names.values]
    given = list(fields.values())
    series, places = stacked(given, wanted)
    metric = None if matrix is None else _metric(matrix, places)
    rows, values = modes(series, count, method == "SNAPSHOTS", metric)
    made = as_fields(rows, places, given[0])
    if not table:
        return ListChpo(list(made)), ListReel(values)
    return _basis(call, made, values, support)


def _of_table(call: Call, table: Table, named: str | None) -> dict[int, NodeField]:
    if named is not None:
        names = [named.rstrip().upper()]
    else:
        names = ["DEPLACEMENTS"] if table.has(Mot("DEPLACEMENTS")) else ["DEPL"]
    inner = table.get(Mot(names[0]))
    source = inner if isinstance(inner, Table) else table
    found = {}
    for index, value in source.items():
        item = value.get(Mot(names[0])) if isinstance(value, Table) else value
        if type(index) is int and isinstance(item, NodeField):
            found[index] = item
    if not found:
        raise call.error("operators.fields.table-has-no-fields", table, name=names[0])
    return dict(sorted(found.items()))


def _metric(matrix: Matrix, places: Any) -> sp.csr_array:
    """The matrix on the unknowns of the fields, in their order."""
    numbering = numbering_of(matrix)
    index = np.concatenate([numbering.index(nodes, numbering.code(n)) for n, nodes in places])
    inside = index >= 0
    n, rows = len(index), np.flatnonzero(inside)
    pick = sp.coo_array(
        (np.ones(len(rows)), (rows, index[inside])), shape=(n, numbering.size)
    ).tocsr()
    return sp.csr_array(pick @ assemble(matrix, numbering) @ pick.T)


def _basis(call: Call, fields: list[NodeField], values: Any, support: Mesh | None) -> Table:
    ws = workspace(call.session)
    inner = Table("BASE_DE_MODES")
    if support is not None:
        inner.set(Mot("MAILLAGE"), support)
    for number, (field, value) in enumerate(zip(fields, values, strict=True), 1):
        mode = Table("MODE")
        mode.set(Mot("POINT_REPERE"), ws.point([0.0] * max(ws.dimension, 1)))
        mode.set(Mot("NUMERO_MODE"), number)
        mode.set(Mot("VALEUR_PROPRE"), float(value))
        mode.set(Mot("FREQUENCE"), float(np.sqrt(max(value, 0.0)) / (2.0 * np.pi)))
        mode.set(Mot("DEFORMEE_MODALE"), field)
        inner.set(number, mode)
    made = Table("BASE_MODALE")
    made.set(Mot("MODES"), inner)
    return made
