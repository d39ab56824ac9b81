"""INDI REFE: shape of cells, named meshes within another one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.mesh.quality import aspect_ratio, flatness, skewness
from ssilang.language.call import Call
from ssilang.language.registry import Help, operator
from ssilang.language.values import ListMots

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
        "is lacking, 0 to 1.",
        fr="Champ par éléments d'indicateurs de leur forme. 'PLAN' des quadrangles : 100 pour un "
        "élément plan, moins selon l'angle de ses deux normales (0 à 180 degrés). 'ASPE' des TRI3 "
        "et TET4 : plus grande arête sur plus petite hauteur, 1 pour un élément équilatéral. "
        "'SKEW' des TRI3 et TET4 : part manquante de la mesure de l'élément équilatéral de même "
        "sphère circonscrite, de 0 à 1.",
        syntax="CHAM1 = INDI GEO1 'PLAN' | 'ASPE' | 'SKEW' ... ;",
        examples=(
            "OPTI DIME 2 ELEM TRI3 ; T = MANU 'TRI3' (0. 0.) (1. 0.) (0. 1.) ; "
            "LIST (MAXI (INDI T 'ASPE')) ;",
        ),
    ),
    reads_itself=True,
)
def indi(call: Call) -> CellField:
    """Shape of cells."""
    words: list[str] = []
    first = call.keyword(("TOPO", *_MEASURES))
    if first == "TOPO":
        raise call.bad("'TOPO' is not available in INDI", hint="'ASPE' and 'SKEW' are")
    words += [first] if first else []
    mesh: Mesh = call.required("MAILLAGE")
    while (word := call.keyword(tuple(_MEASURES))) is not None:
        words.append(word)
    if not words:
        raise call.bad("which indicator?", hint="'PLAN' 'ASPE' 'SKEW'")
    blocks = tuple(_block(call, b, words) for b in mesh.blocks)
    return CellField(blocks, "SCALAIRE")


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
