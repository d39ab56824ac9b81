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
from ssilang.language.registry import Help, arg, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListReel, Mot, Table
from ssilang.operators.workspace import workspace

_LINE = "OPTI DIME 2 ELEM SEG2 ; L = DROI 2 (0. 0.) (2. 0.) ; X = COOR 1 L ; "


@operator(
    "MAX1",
    family="fields",
    help=Help(
        en="Nodal field divided by its value of largest size, which becomes 1; among the "
        "components named ('AVEC', may be left out) or not named ('SANS') by a list.",
        fr="Champ par points divisé par sa valeur de plus grande taille, qui devient 1 ; parmi "
        "les composantes nommées ('AVEC', facultatif) ou non nommées ('SANS') par une liste.",
        syntax="CHP1 = MAX1 CHP2 (('AVEC') | 'SANS' LMOTS1) ;",
        examples=(_LINE + "LIST (MINI (MAX1 (X - 4.))) ;",),
    ),
    reads_itself=True,
)
def max1(call: Call) -> NodeField:
    """Bring a field to one."""
    field: NodeField = call.required("CHPOINT")
    without = call.keyword(("AVEC", "SANS")) == "SANS"
    listed = call.optional("LISTMOTS")
    names = list(field.components)
    if listed is not None:
        words = {str(w).rstrip() for w in listed.values}
        names = [n for n in names if (n in words) != without]
    values = [field.components[n].values for n in names]
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
    arg("field", "CHPOINT", "MCHAML"),
    arg("angle", "FLOTTANT"),
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


@operator(
    "PSIP",
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
        examples=(_LINE + "P = (0.5 2.) ET (3. -1.) ; LIST (PSIP P L) ;",),
    ),
    reads_itself=True,
)
def psip(call: Call) -> Any:
    """Signed distances."""
    ws = workspace(call.session)
    place = call.required("MAILLAGE", "POINT")
    mesh: Mesh = call.required("MAILLAGE")
    reach = call.optional("FLOTTANT")
    word = call.keyword(("DEUX", "TROI"))
    ends = [e.value for _ in range(2) if word and (e := call.read("POINT", "MAILLAGE")) is not None]
    reach = call.optional("FLOTTANT") if reach is None else reach
    nodes = np.array([place.node]) if isinstance(place, Point) else place.sorted_node_ids
    points = ws.nodes.coordinates[nodes]
    phi = signed_distance(points, mesh, ws.dimension)
    rows = {"PHI": phi}
    if word:
        rows |= _ahead(call, word, points, mesh, ends)
    kept = np.ones(len(nodes), bool) if reach is None else _near(points, mesh, reach)
    made = [NodeField.of(ws.nodes, nodes[kept], {k: v[kept]}, "DIFFUS") for k, v in rows.items()]
    return made[0] if len(made) == 1 else tuple(made)


def _near(points: Any, mesh: Mesh, reach: float) -> Any:
    """Points within a reach (largest coordinate) of a node of the mesh."""
    from scipy.spatial import cKDTree

    tree = cKDTree(mesh.nodes.coordinates[mesh.sorted_node_ids])
    return tree.query(points, p=np.inf)[0] <= reach


def _ahead(call: Call, word: str, points: Any, mesh: Mesh, ends: list[Any]) -> dict[str, Any]:
    if workspace(call.session).dimension == 2:
        if word == "TROI" or not ends or not all(isinstance(e, Point) for e in ends):
            raise call.error("operators.fields.ends-are-points")
        return {"PSI": beyond_tip(points, mesh, tuple(e.node for e in ends))}
    if len(ends) != 1 or not isinstance(ends[0], Mesh):
        raise call.error("operators.fields.front-is-a-line-mesh", word=word)
    ahead, along = beyond_front(points, mesh, ends[0])
    return {"PSI": ahead} | ({"TAU": along} if word == "TROI" else {})


@operator(
    "POD",
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
        ),
    ),
    reads_itself=True,
)
def pod(call: Call) -> Any:
    """Orthogonal decomposition."""
    keys = ("SNAP", "CLAS", "TBAS")
    fields = _series(call, keys)
    chosen, names = call.optional("LISTENTI"), call.optional("LISTMOTS")
    said = []
    while (word := call.keyword(keys)) is not None:
        said.append(word)
    matrix, count = call.optional("RIGIDITE"), call.required("ENTIER")
    while (word := call.keyword(keys)) is not None:
        said.append(word)
    support = call.optional("MAILLAGE")
    if count < 1 or not {"SNAP", "CLAS"} & set(said):
        raise call.error("operators.fields.pod-method-and-count")
    if chosen is not None:
        missing = [int(i) for i in chosen.values if int(i) not in fields]
        if missing:
            raise call.error("operators.fields.no-field-number", chosen, number=missing[0])
        fields = {int(i): fields[int(i)] for i in chosen.values}
    wanted = None if names is None else [str(n).rstrip() for n in names.values]
    held = list(fields.values())
    series, places = stacked(held, wanted)
    metric = None if matrix is None else _metric(matrix, places)
    rows, values = modes(series, count, "SNAP" in said, metric)
    made = as_fields(rows, places, held[0])
    if "TBAS" not in said:
        return ListChpo(list(made)), ListReel(values)
    return _basis(call, made, values, support)


def _series(call: Call, keys: tuple[str, ...]) -> dict[int, NodeField]:
    """Fields by number."""
    operand = call.read("LISTCHPO", "TABLE")
    if operand is None:
        raise call.missing(("LISTCHPO", "TABLE"))
    held = operand.value
    if isinstance(held, ListChpo):
        pairs = {i: f for i, f in enumerate(held.values, 1) if isinstance(f, NodeField)}
    else:
        named = None if call.peek_word() is None or call.keyword(keys) else call.word()
        pairs = _of_table(call, held, named)
    if not pairs:
        raise call.error("operators.fields.no-field-to-decompose", held)
    return pairs


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
