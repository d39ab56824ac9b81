"""DEFO and VECT: deformed shapes and arrows for TRAC; their unions."""

from __future__ import annotations

from typing import Any

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.io.plots.palette import index_of
from ssilang.kernel.fields.arrows import (
    arrows_at_nodes,
    arrows_in_cells,
    principal_strokes,
)
from ssilang.kernel.fields.cell_field import CellField
from ssilang.kernel.fields.deformed import Arrows, Deformed, DeformedPart
from ssilang.kernel.fields.node_field import NodeField
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.language.values import ListMots, Mot, register_type
from ssilang.operators.dispatch import union
from ssilang.operators.workspace import workspace

register_type(Deformed, "DEFORME")
register_type(Arrows, "VECTEUR")


@union(("DEFORME", "DEFORME"))
def _deformed_union(left: Deformed, right: Deformed) -> Deformed:
    return Deformed(left.parts + right.parts)


@union(("VECTEUR", "VECTEUR"))
def _arrows_union(left: Arrows, right: Arrows) -> Arrows:
    return Arrows(left.parts + right.parts)


def is_colour(word: str) -> bool:
    """Whether a word names a colour."""
    return word.strip().upper()[:4] in COLOURS


@operator(
    "DEFO",
    family="drawing",
    full_name="DEFORME",
    help=Help(
        en="A deformed shape for TRAC: a mesh moved by an amplified displacement (the "
        "amplification is chosen by the picture if it is not given), with a colour, arrows and a "
        "field to show on it. ET puts several shapes into one picture.",
        fr="Une déformée pour TRAC : un maillage déplacé, avec un coefficient d'amplification "
        "(choisi par le tracé s'il manque), une couleur, des vecteurs et un champ à montrer "
        "dessus. ET réunit plusieurs déformées dans un tracé.",
        syntax="DEF1 = DEFO MAIL1 CHPO1 (FLOT1) (VEC1) (COUL1) (CHPO2 | MCHAML1 MODEL1) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
            "U = MANU 'CHPO' L 2 'UX' 0. 'UY' 0.1 ; D = DEFO L U 1. 'ROUG' ; TRAC D ;",
        ),
    ),
    reads_itself=True,
)
def defo(call: Call) -> Deformed:
    """Read mesh, displacement and what goes with them, in any order."""
    found: dict[str, list[Any]] = {}
    colour: int | None = None
    kinds = ("MAILLAGE", "CHPOINT", "FLOTTANT", "VECTEUR", "MCHAML", "MMODEL")
    while True:
        word = call.keyword(COLOURS)
        if word is not None:
            colour = index_of(word)
            continue
        operand = call.read(*kinds)
        if operand is None:
            break
        found.setdefault(_kind(operand.value), []).append(operand.value)
    for kind, type_word in (("mesh", "MAILLAGE"), ("nodal", "CHPOINT")):
        if kind not in found:
            raise call.missing((type_word,))

    def first(kind: str) -> Any:
        return found.get(kind, [None])[0]

    nodal = found["nodal"]
    return Deformed(
        (
            DeformedPart(
                first("mesh"),
                nodal[0],
                first("scale"),
                colour,
                first("arrows"),
                first("cells") if "cells" in found else (nodal[1] if len(nodal) > 1 else None),
                first("model"),
            ),
        )
    )


def _kind(value: object) -> str:
    table = {"Mesh": "mesh", "NodeField": "nodal", "float": "scale", "Arrows": "arrows",
             "CellField": "cells", "Model": "model"}  # fmt: skip
    return table[type(value).__name__]


_FAMILIES = {
    "DEPL": (("UX", "UY", "UZ"), ("UR", "UZ", "")),
    "FORC": (("FX", "FY", "FZ"), ("FR", "FZ", "")),
}


@operator(
    "VECT",
    family="drawing",
    full_name="VECTEUR",
    help=Help(
        en="Arrows for TRAC. Of a nodal field: its displacements (DEPL), forces (FORC) or the "
        "components named, times an amplification (chosen by the picture if it is not given; "
        "negative: the arrow points at its node), in a colour. Of a field in cells: with a "
        "LISTMOTS, the vector of these components in each cell; without, the strokes of its "
        "principal stresses, or of the one named, with a LISTMOTS of colours.",
        fr="Des flèches pour TRAC. D'un champ par points : ses déplacements (DEPL), ses forces "
        "(FORC) ou les composantes nommées, avec une amplification (choisie par le tracé si elle "
        "manque ; négative : la flèche pointe vers son noeud) et une couleur. D'un champ par "
        "éléments : avec un LISTMOTS, le vecteur de ces composantes dans chaque élément ; sans, "
        "les traits de ses contraintes principales, ou de celle qui est nommée, et un LISTMOTS "
        "de couleurs.",
        syntax="VEC1 = VECT CHPO1 (FLOT1) ('DEPL' | 'FORC' | LISTMOTS1 | MOT1 MOT2 (MOT3)) "
        "(COUL1) ;\nVEC1 = VECT MCHAML1 (MCHAML2) MODEL1 (FLOT1) (MOT1 | LISTMOTS1) (LISTMOTS2) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; "
            "F = MANU 'CHPO' L 2 'FX' 0. 'FY' -1. ; V = VECT F 'FORC' 'ROUG' ; TRAC V L ;",
        ),
    ),
    reads_itself=True,
)
def vect(call: Call) -> Arrows:
    """Arrows of a nodal field or of a field in cells."""
    first = call.read("CHPOINT", "MCHAML")
    if first is None:
        raise call.missing(("CHPOINT", "MCHAML"))
    if isinstance(first.value, NodeField):
        return _nodal(call, first.value)
    return _in_cells(call, first.value)


def _nodal(call: Call, chpoint: NodeField) -> Arrows:
    words: list[str] = []
    scale: float | None = None
    colour = 0
    while (operand := call.read("FLOTTANT", "LISTMOTS") or call.read("MOT")) is not None:
        value = operand.value
        if isinstance(value, float):
            scale = value
        elif not isinstance(value, str):
            words += [str(v) for v in value.values]
        elif is_colour(value) and value.strip() not in chpoint.components:
            colour = index_of(value)
        else:
            words.append(str(value))
    columns = _columns(call, chpoint, words)
    made = arrows_at_nodes(chpoint, columns, scale, colour)
    if not any(c in chpoint.components for c in columns):
        known = ", ".join(chpoint.components) or "none"
        raise call.error(
            "operators.drawing.component-missing", chpoint, columns=columns, known=known
        )
    return made


def _columns(call: Call, chpoint: NodeField, words: list[str]) -> tuple[str, str, str]:
    said = [w.strip() for w in words]
    family = said[0].upper()[:4] if len(said) == 1 else ""
    if family in _FAMILIES and said[0] not in chpoint.components:
        plain, axial = _FAMILIES[family]
        return axial if axial[0] in chpoint.components else plain
    if said:
        return tuple([*said, "", "", ""][:3])  # type: ignore[return-value]
    for plain, axial in _FAMILIES.values():
        for columns in (axial, plain):
            if columns[0] in chpoint.components:
                return columns
            if columns is plain and any(c in chpoint.components for c in columns):
                return columns
    size = max(workspace(call.session).dimension, 1)
    return tuple([*list(chpoint.components)[:size], "", "", ""][:3])  # type: ignore[return-value]


def _in_cells(call: Call, mchaml: CellField) -> Arrows:
    scale: float | None = None
    words: list[str] = []
    lists: list[list[str]] = []
    kinds = ("MCHAML", "MMODEL", "FLOTTANT", "LISTMOTS")
    while (operand := call.read(*kinds) or call.read("MOT")) is not None:
        value = operand.value
        if isinstance(value, float):
            scale = value
        elif isinstance(value, Mot):
            words.append(str(value).strip())
        elif isinstance(value, ListMots):
            lists.append([str(v).strip() for v in value.values])
        # characteristics and model are read, but arrows stand in the middle of the cells
    names = {c for block in mchaml.blocks for c in block.components}
    columns = next((x for x in lists if any(c in names for c in x)), None)
    colours = [index_of(c) for x in lists if x is not columns for c in x]
    colours += [index_of(w) for w in words if is_colour(w) and w not in names]
    if columns is not None:
        shade = colours[0] if colours else 0
        return arrows_in_cells(mchaml, tuple([*columns, "", "", ""][:3]), scale, shade)  # type: ignore[arg-type]
    chosen = [w for w in words if w in names]
    return principal_strokes(mchaml, scale, tuple(chosen), tuple(colours))
