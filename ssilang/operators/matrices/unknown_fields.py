"""CHPO XXT CMCT CABL MFIL DIMN ORTH: fields and matrices made from a matrix or for one."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.kernel.fields import node_algebra
from ssilang.kernel.fields.node_field import NodeField, NodeValues
from ssilang.kernel.matrices.assembly import numbering_of
from ssilang.kernel.matrices.cables import cable_stiffness
from ssilang.kernel.matrices.condensation import condensed_by_relations, condensed_on_multipliers
from ssilang.kernel.matrices.filtering import filter_weights
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.matrices.outer import sum_of_outer_products
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.modal.basis import work
from ssilang.kernel.statics.linear import linear_system, product
from ssilang.language.registry import Chosen, Help, arg, flag, operator, opt, select
from ssilang.language.run.call import Call
from ssilang.language.values import ListChpo, ListReel
from ssilang.operators.numbers.noise import session_generator
from ssilang.operators.workspace import workspace

_TWO = "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ; K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ; "


@operator(
    "CHPO",
    select(
        "values",
        {
            "ALEATOIRE": [],
            "UNIFORME": [arg("value", "FLOTTANT", en="value", fr="valeur")],
        },
        en="random, or the same everywhere",
        fr="aléatoires, ou la même partout",
    ),
    arg("matrix", "RIGIDITE", en="matrix", fr="rigidité"),
    family="fields",
    full_name="CHPOINT",
    help=Help(
        en="Nodal field on the unknowns of a matrix: the same value everywhere ('UNIFORME'), or "
        "random values between 0 and 1 ('ALEATOIRE').",
        fr="Champ par points sur les inconnues d'une rigidité : la même valeur partout "
        "('UNIFORME'), ou des valeurs aléatoires entre 0 et 1 ('ALEATOIRE').",
        syntax="CHPO1 = CHPO 'ALEATOIRE' | 'UNIFORME' X1 RIG1 ;",
        examples=(
            _TWO + "LIST (CHPO 'UNIFORME' 2. K) ;",
            (
                "OPTI DIME 2 ; P = 0. 0. ;\n"
                "C = CHPO 'ALEA' (APPU 'UX' 1. P) ; LIST (EXTR C 'COMP') ;"
            ),
        ),
    ),
)
def chpo(call: Call, values: Chosen | None, matrix: Matrix) -> NodeField:
    """Field on the unknowns of a matrix."""
    if values is None:
        raise call.error("operators.matrices.which-values")
    value = values["value"] if values.word == "UNIFORME" else None
    numbering = numbering_of(matrix)
    generator = session_generator(call, None)
    made = {}
    for name in numbering.unknowns:
        nodes = numbering.nodes[numbering.where(name)]
        n = len(nodes)
        made[name] = NodeValues(nodes, generator.random(n) if value is None else np.full(n, value))
    return NodeField(numbering.table, made, "DIFFUS")


@operator(
    "XXT",
    arg("field", "CHPOINT", en="v", fr="v"),
    opt("factor", "FLOTTANT", default=1.0, en="a", fr="a"),
    family="matrix",
    help=Help(
        en="Stiffness a v v^T of a nodal field v (forces, or displacements): one full element on "
        "all its nodes.",
        fr="Rigidité a v v^T d'un champ par points v (forces, ou déplacements) : un seul "
        "superélément plein sur tous ses noeuds.",
        syntax="RIG1 = XXT CHPO1 (X1) ;",
        examples=(
            "OPTI DIME 2 ; V = MANU 'CHPO' (0. 0.) 2 'FX' 1. 'FY' 2. 'NATURE' 'DISCRET' ; "
            "LIST (EXTR (XXT V 3.) 'DIAG') ;",
        ),
    ),
)
def xxt(field: NodeField, factor: float) -> Matrix:
    """Outer product."""
    return sum_of_outer_products([field], [factor], "RIGIDITE")


@operator(
    "CMCT",
    arg("matrix", "RIGIDITE", en="relations C", fr="relations C"),
    arg("diagonal", "CHPOINT", en="M^-1", fr="M^-1"),
    family="matrix",
    help=Help(
        en="Condensation. With relations C and a field holding the inverse of a diagonal M: the "
        "matrix C M^-1 C^T on the multipliers LX. With a matrix K and relations: the matrix "
        "without the unknowns that the relations give by the others.",
        fr="Condensation. Avec des relations C et un champ contenant l'inverse d'une diagonale "
        "M : la matrice C M^-1 C^T sur les multiplicateurs LX. Avec une matrice K et des "
        "relations : la matrice sans les inconnues que les relations donnent par les autres.",
        syntax="RIG3 = CMCT RIG1 CHPO1 ; RIG3 = CMCT RIG1 RIG2 ;",
        examples=(
            _TWO + "C = RELA 2. 'UX' P '+' 3. 'UX' Q ; "
            "D = MANU 'CHPO' (P ET Q) 1 'UX' 0.5 ; LIST (EXTR (CMCT C D) 'DIAG') ;",
            (
                "OPTI DIME 2 ; P = 0. 0. ; Q = 1. 0. ;\n"
                "K = (APPU 'UX' 4. P) ET (APPU 'UX' 5. Q) ;\n"
                "C = RELA 2. 'UX' P '+' 3. 'UX' Q ;\n"
                "LIST (EXTR (CMCT K C) 'DIAG') ;"
            ),
        ),
    ),
)
def cmct(matrix: Matrix, diagonal: NodeField) -> Matrix:
    """On the multipliers."""
    return condensed_on_multipliers(matrix, diagonal)


@cmct.form(
    arg("matrix", "RIGIDITE", en="matrix", fr="rigidité"),
    arg("relations", "RIGIDITE", en="relations", fr="relations"),
)
def cmct_of_matrix(matrix: Matrix, relations: Matrix) -> Matrix:
    """On the unknowns that stay."""
    return condensed_by_relations(matrix, relations)


@operator(
    "CABL",
    arg("mesh", "MAILLAGE", en="cables", fr="câbles"),
    arg("force", "FLOTTANT", en="force", fr="force", unit="N"),
    arg("percent", "FLOTTANT", en="lengthening under it", fr="son allongement", unit="%"),
    family="matrix",
    full_name="CABLE",
    help=Help(
        en="Stiffness of cables (SEG2) whose force is X1 at a lengthening of X2 percent.",
        fr="Rigidité de câbles (SEG2) dont la force est X1 à un allongement de X2 pour cent.",
        syntax="RIG1 = CABL GEO1 X1 X2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 1 (0. 0.) (2. 0.) ; "
            "LIST (EXTR (CABL L 10. 1.) 'DIAG') ;",
        ),
    ),
)
def cabl(call: Call, mesh: Mesh, force: float, percent: float) -> Matrix:
    """Cables."""
    if percent == 0.0:
        raise call.error("operators.matrices.force-without-lengthening")
    return cable_stiffness(mesh, workspace(call.session).dimension, force, percent)


@operator(
    "MFIL",
    arg("weights", "CHPOINT", en="weight of each node", fr="poids de chaque noeud"),
    opt("radius", "FLOTTANT", default=0.0, en="radius", fr="rayon", unit="m"),
    opt("power", "FLOTTANT", default=1.0, en="power", fr="puissance"),
    opt("least", "FLOTTANT", default=0.0, en="least weight kept", fr="plus petit poids gardé"),
    opt("unknown", "MOT", kind="component", en="unknown, else SCAL", fr="inconnue, sinon SCAL"),
    opt("dual", "MOT", kind="component", en="dual, else the same", fr="duale, sinon la même"),
    family="matrix",
    help=Help(
        en="Matrix whose product with a nodal field smooths it: each node takes the mean of its "
        "neighbours nearer than X1, weighed by (1 - d / X1) ** X2 and by the field CHPO1 (the "
        "nodes' volumes, say); weights not above X3 are dropped. The words name the unknown "
        "(SCAL) and the dual (the same).",
        fr="Rigidité dont le produit par un champ par points le lisse : chaque noeud prend la "
        "moyenne de ses voisins à moins de X1, pondérée par (1 - d / X1) ** X2 et par le champ "
        "CHPO1 (les volumes des noeuds, par exemple) ; les poids non supérieurs à X3 sont omis. "
        "Les mots nomment l'inconnue (SCAL) et la duale (la même).",
        syntax="RIG1 = MFIL CHPO1 (X1 (X2 (X3))) (MOT1 (MOT2)) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (4. 0.) ; X = COOR 1 L ; "
            "W = MANU 'CHPO' L 1 'SCAL' 1. ; LIST ((MFIL W 1.5) * (X * X)) ;",
        ),
    ),
)
def mfil(
    call: Call,
    weights: NodeField,
    radius: float,
    power: float,
    least: float,
    unknown: str | None,
    dual: str | None,
) -> Matrix:
    """Weights of a filter."""
    if radius < 0.0:
        raise call.error("operators.matrices.filter-radius-negative", radius, radius=radius)
    name = "SCAL" if unknown is None else unknown.rstrip()
    return filter_weights(
        weights, radius, power, least, name, name if dual is None else dual.rstrip()
    )


@operator(
    "DIMN",
    arg("matrix", "RIGIDITE", en="matrix", fr="rigidité"),
    family="matrix",
    full_name="DIMNOYAU",
    help=Help(
        en="Dimension of the kernel of a matrix with its relations: the number of free motions.",
        fr="Dimension du noyau d'une rigidité avec ses relations : le nombre de mouvements libres.",
        syntax="N1 = DIMN RIG1 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 1 (0. 0.) (1. 0.) ; S = TRAN 1 L (0. 1.) ; "
            "M = MODE S MECANIQUE ELASTIQUE ; K = RIGI M (MATE M 'YOUN' 1. 'NU' 0.3) ; "
            "LIST (DIMN K) ;",
        ),
    ),
)
def dimn(matrix: Matrix) -> int:
    """Dimension of the kernel."""
    return int(linear_system(matrix).free_motions.shape[1])


@operator(
    "ORTH",
    flag(
        "alike",
        "SEMBLABLE",
        en="the fields have the same nodes and components",
        fr="les champs ont les mêmes noeuds et composantes",
    ),
    arg("field", "CHPOINT", en="field X", fr="champ X"),
    arg("shapes", "LISTCHPO", en="fields U", fr="champs U"),
    arg("norms", "LISTREEL", en="products U K U", fr="produits U K U"),
    opt("loaded", "LISTCHPO", en="fields K U", fr="champs K U"),
    arg("matrix", "RIGIDITE", en="matrix K", fr="rigidité K"),
    opt("precision", "FLOTTANT", en="precision", fr="précision"),
    opt("passes", "ENTIER", default=2, en="passes at most", fr="passages au plus"),
    family="matrix",
    full_name="ORTHOGONALISER",
    help=Help(
        en="Field made orthogonal, for a matrix K, to fields U of a list that are so among "
        "themselves: X - sum (X K U) / (U K U) U. The list of reals holds the U K U; a second "
        "list of fields may hold the K U. A precision asks for further passes, N1 at most.",
        fr="Champ rendu orthogonal, au sens d'une rigidité K, aux champs U d'une liste qui le sont "
        "entre eux : X - somme (X K U) / (U K U) U. La liste de réels contient les U K U ; une "
        "seconde liste de champs peut contenir les K U. Une précision demande d'autres passages, "
        "N1 au plus.",
        syntax="CHPO1 = ORTH ('SEMBLABLE') CHPO2 LCHPO1 LREEL1 (LCHPO2) RIG1 (X1 (N1)) ;",
        examples=(
            _TWO + "U = MANU 'CHPO' (P ET Q) 1 'UX' 1. ; X = MANU 'CHPO' (P ET Q) 1 'UX' "
            "(PROG 1. 2.) ; Y = ORTH X (SUIT U) (PROG 9.) K ; LIST (YTMX Y U K) ;",
        ),
    ),
)
def orth(
    call: Call,
    alike: bool,
    field: NodeField,
    shapes: ListChpo,
    norms: ListReel,
    loaded: ListChpo | None,
    matrix: Matrix,
    precision: float | None,
    passes: int,
) -> NodeField:
    """Gram and Schmidt's step."""
    fields: list[Any] = list(shapes.values)
    forces: list[Any] = (
        [product(matrix, u) for u in fields] if loaded is None else list(loaded.values)
    )
    if not len(fields) == len(norms) == len(forces):
        raise call.error(
            "operators.matrices.products-do-not-match",
            n_shapes=len(fields),
            n_norms=len(norms),
            n_forces=len(forces),
        )
    if (norms.values == 0.0).any():
        raise call.error("operators.matrices.product-is-zero")
    for turn in range(max(passes, 1)):
        worst = 0.0
        for u, k, f in zip(fields, norms.values, forces, strict=True):
            share = work(f, field) / k
            worst = max(worst, abs(share))
            field = node_algebra.added(field, u, -share)
        if precision is None or (turn and worst <= precision):
            break
    return field
