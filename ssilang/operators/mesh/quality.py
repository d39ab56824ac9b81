"""INDI REFE: shape of cells, named meshes within another one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.queries.quality import aspect_ratio, flatness, quality_in_metric, skewness
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, ListReel
from ssilang.operators.workspace import workspace

_MEASURES: dict[str, tuple[tuple[str, ...], Callable[[FloatArray], FloatArray]]] = {
    "PLAN": (("QUA4",), flatness),
    "ASPE": (("TRI3", "TET4"), aspect_ratio),
    "SKEW": (("TRI3", "TET4"), skewness),
}


@operator(
    "INDI",
    family="mesh",
    full_name="INDICATEUR",
    help=Help(
        en="Field in cells of indicators of their shape. 'PLAN' of quadrangles: 100 for a plane "
        "one, less by the angle between its two normals (0 at 180 degrees). 'ASPE' of TRI3 and "
        "TET4: longest edge over shortest height, 1 for an equilateral cell. 'SKEW' of TRI3 and "
        "TET4: share of the measure of the equilateral cell in the same circumscribed sphere that "
        "is lacking, 0 to 1. 'TOPO': quality of TRI3 or TET4, 0 for a cell without measure to 1 "
        "for an equilateral one, of edges of the length wanted where METR1 gives it: a number (the "
        "length), or a field at nodes of metric tensors (G, or G11 G21 G22 (G31 G32 G33), in "
        "length^-2): the mean ratio of the cell times the smaller of s and 1/s, s being the root "
        "of the mean square of the edges over the length wanted. 'LISTREEL' gives a list.",
        fr="Champ par éléments d'indicateurs de leur forme. 'PLAN' des quadrangles : 100 pour un "
        "élément plan, moins selon l'angle de ses deux normales (0 à 180 degrés). 'ASPE' des TRI3 "
        "et TET4 : plus grande arête sur plus petite hauteur, 1 pour un élément équilatéral. "
        "'SKEW' des TRI3 et TET4 : part manquante de la mesure de l'élément équilatéral de même "
        "sphère circonscrite, de 0 à 1. 'TOPO' : qualité des TRI3 ou TET4, de 0 (sans mesure) à 1 "
        "(équilatéral, d'arêtes de la longueur voulue si METR1 la donne : un nombre, la longueur, "
        "ou un champ aux noeuds de métriques G, ou G11 G21 G22 (G31 G32 G33), en longueur^-2) : "
        "rapport moyen de l'élément fois le plus petit de s et 1/s, s étant la moyenne quadratique "
        "des arêtes sur la longueur voulue. 'LISTREEL' donne une liste.",
        syntax="CHAM1 = INDI GEO1 'PLAN' | 'ASPE' | 'SKEW' ... ;\n"
        "CHAM1 = INDI 'TOPO' GEO1 (METR1) ('LISTREEL') ;",
        examples=(
            "OPTI DIME 2 ELEM TRI3 ; T = MANU 'TRI3' (0. 0.) (1. 0.) (0. 1.) ; "
            "LIST (MAXI (INDI T 'ASPE')) ;",
        ),
    ),
    reads_itself=True,
)
def indi(call: Call) -> CellField | ListReel:
    """Shape of cells."""
    words: list[str] = []
    first = call.keyword(("TOPO", *_MEASURES))
    if first == "TOPO":
        return _in_metric(call)
    words += [first] if first else []
    mesh: Mesh = call.required("MAILLAGE")
    while (word := call.keyword(tuple(_MEASURES))) is not None:
        words.append(word)
    if not words:
        raise call.bad("which indicator?", hint="'PLAN' 'ASPE' 'SKEW'")
    blocks = tuple(_block(call, b, words) for b in mesh.blocks)
    return CellField(blocks, "SCALAIRE")


def _in_metric(call: Call) -> CellField | ListReel:
    """INDI 'TOPO'."""
    mesh: Mesh = call.required("MAILLAGE")
    listed = call.keyword(("LISTREEL",)) is not None
    size, field = call.optional("FLOTTANT"), call.optional("CHPOINT")
    listed = listed or call.keyword(("LISTREEL",)) is not None
    kinds = {b.cell_type for b in mesh.blocks}
    if len(mesh.blocks) != 1 or not kinds <= {"TRI3", "TET4"}:
        raise call.bad("'TOPO' is for a mesh of TRI3 or of TET4 alone", mesh)
    cells = mesh.blocks[0]
    metric: FloatArray | None = None
    if size is not None:
        if size <= 0:
            raise call.bad("the length wanted must be > 0", size)
        metric = np.broadcast_to(np.eye(3) / size**2, (len(cells), 3, 3))
    elif field is not None:
        metric = _metric(call, cells, field, workspace(call.session).mode.dimension)
    values = quality_in_metric(cells.coordinates, metric)
    if listed:
        return ListReel(values)
    block = CellFieldBlock(cells, {"SCAL": values[:, None]}, "GRAVITE")
    return CellField((block,), "SCALAIRE")


def _metric(call: Call, cells: CellBlock, field: NodeField, dimension: int) -> FloatArray:
    """Mean over the nodes of each cell of the metric (n, 3, 3)."""
    names = {(i, j): f"G{i + 1}{j + 1}" for i in range(dimension) for j in range(i + 1)}
    if "G" in field.components:
        names = {(i, i): "G" for i in range(dimension)}
    missing = [n for n in names.values() if n not in field.components]
    if missing:
        raise call.bad(
            f"the metric lacks {' '.join(missing)}", field, hint="G, or G11 G21 G22 (G31 G32 G33)"
        )
    nodes = cells.connectivity
    M = np.zeros((len(nodes), 3, 3))
    for (i, j), name in names.items():
        values = field.values_at(name, nodes.ravel()).reshape(nodes.shape).mean(axis=1)
        M[:, i, j] = M[:, j, i] = values
    return M


def _block(call: Call, cells: CellBlock, words: list[str]) -> CellFieldBlock:
    made = {}
    for word in words:
        kinds, measure = _MEASURES[word]
        if cells.cell_type not in kinds:
            raise call.bad(f"'{word}' is for {' '.join(kinds)}, not for {cells.cell_type}")
        made[word] = measure(cells.coordinates)[:, None]
    return CellFieldBlock(cells, made, "GRAVITE")


@operator(
    "REFE",
    family="mesh",
    help=Help(
        en="Names of the meshes whose nodes all belong to a mesh; or, with two meshes, whether all "
        "nodes of the first belong to the second.",
        fr="Noms des maillages dont tous les noeuds sont dans un maillage ; ou, avec deux "
        "maillages, si tous les noeuds du premier sont dans le second.",
        syntax="LMOT1 = REFE MAIL2 ; LOG1 = MAIL1 REFE MAIL2 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; A = 0. 0. ; L1 = DROI 2 A (1. 0.) ; L2 = DROI 2 A (0. 1.) ; "
            "L3 = L1 ET L2 ; LIST (REFE L3) ; LIST (L1 REFE L2) ;",
        ),
    ),
    reads_itself=True,
)
def refe(call: Call) -> bool | ListMots:
    """Meshes within a mesh."""
    first: Mesh = call.required("MAILLAGE")
    second = call.optional("MAILLAGE")
    if second is not None:
        return _inside(first, second)
    frame = call.session.frame
    names = []
    for name in sorted(frame.names()):
        value = frame.find(name)
        if isinstance(value, Mesh) and value is not first and _inside(value, first):
            names.append(name)
    return ListMots(names)


def _inside(small: Mesh, large: Mesh) -> bool:
    return bool(np.isin(small.sorted_node_ids, large.sorted_node_ids).all())
