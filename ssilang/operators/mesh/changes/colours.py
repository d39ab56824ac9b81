"""Colours of meshes: COUL AFCO."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.io.plots.palette import index_of
from ssilang.kernel.mesh.combine import recolour
from ssilang.language.registry import either
from ssilang.language.vocabulary.terms import between
from ssilang.operators.dispatch import COUL
from ssilang.operators.prelude import *

# other cells are white
_COLOURS = {
    "BLEU": "SEG2 TRI3 CUB8 TET4 LIA3", "ROUG": "QUA4 PRI6 PYR5 RAC2 LIA4",
    "ROSE": "SEG3 TRI6 CU20 TE10 LIA6", "VERT": "QUA8 PR15 PY13 RAC3 LIA8", "JAUN": "TRI7 QUA9",
}  # fmt: skip
_COLOUR_OF = {cell: colour for colour, cells in _COLOURS.items() for cell in cells.split()}


@operator("AFCO", arg("mesh", "MAILLAGE", en="mesh"), family="mesh")
def afco(mesh: Mesh) -> Mesh:
    """Colour each block by its type of cell."""
    shades = [index_of(_COLOUR_OF.get(b.cell_type, "BLAN")) for b in mesh.blocks]
    blocks = tuple(
        replace(b, colours=np.full(len(b), shade, dtype=np.int8))
        for b, shade in zip(mesh.blocks, shades, strict=True)
    )
    return replace(mesh, blocks=blocks)


@COUL.form(
    main("mesh", "MAILLAGE", en="mesh"),
    either(
        "colour",
        group("number", arg("number", "ENTIER", en="its number", usual=between(0, len(COLOURS)))),
        group("name", arg("name", "MOT", en="its name", kind="colour")),
        optional=True,
        en="colour, that of OPTI COUL by default",
    ),
)
def coloured(session: Session, mesh: Mesh, colour: Chosen | None) -> Mesh:
    """Mesh in another colour."""
    if colour is None:
        return recolour(mesh, workspace(session).colour)
    if colour.word == "number":
        return recolour(mesh, min(max(colour["number"] - 1, 0), len(COLOURS) - 1))
    return recolour(mesh, index_of(colour["name"]))
