"""Boundaries and senses of meshes: CONT ENVE ARET INVE ORIE VERS ORDO."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import (
    chained,
    contour,
    envelope,
    inner_contour,
    sharp_edges,
)
from ssilang.kernel.mesh.combine import join_blocks
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.kernel.mesh.orientation import (
    check_consistent,
    flip,
    orient,
    orient_towards,
    reversed_line,
)
from ssilang.language.registry import Help, arg, flag, operator
from ssilang.language.run.call import Call
from ssilang.operators.dispatch import INVE, ORDO
from ssilang.operators.workspace import workspace


def _whole_lines(mesh: Mesh) -> Mesh:
    """The cells of lines put end to end, one block a type."""
    groups: dict[str, list[CellBlock]] = {}
    for block in mesh.blocks:
        groups.setdefault(block.cell_type, []).append(block)
    return chained(Mesh(mesh.nodes, tuple(join_blocks(b) for b in groups.values())))


@operator(
    "CONT",
    family="mesh",
    full_name="CONTOUR",
    help=Help(
        en="Contour of a surface: edges of one cell only ('EXTE', the default), of three or more "
        "('INTE'), or both ('TOUT'). The lines are put end to end. 'NOID' allows an empty result.",
        fr="Contour d'une surface : arêtes d'un seul élément ('EXTE', par défaut), de trois ou "
        "plus ('INTE'), ou les deux ('TOUT'). Les lignes sont mises bout à bout. 'NOID' permet un "
        "résultat vide.",
        syntax="GEO1 = CONT ('NOID') ('EXTE'|'INTE'|'TOUT') GEO2 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (1. 0.)) TRAN 3 (0. 1.) ;"
            " LIST (NBEL (CONT S)) ;",
        ),
    ),
    reads_itself=True,
)
def cont(call: Call) -> Mesh:
    """Contour of a surface."""
    which, allowed = "EXTE", False
    mesh: Mesh | None = None
    before = -1
    while before != len(call.operands):
        before = len(call.operands)
        word = call.keyword(("NOID", "EXTE", "INTE", "TOUT"))
        if word == "NOID":
            allowed = True
        elif word is not None:
            which = word
        mesh = mesh or call.optional("MAILLAGE")
    if mesh is None:
        raise call.missing(("MAILLAGE",))
    parts: list[CellBlock] = []
    if which in ("EXTE", "TOUT"):
        parts += contour(mesh).blocks
    if which in ("INTE", "TOUT"):
        parts += inner_contour(mesh).blocks
    if not parts and not allowed:
        raise MeshError("the mesh has no contour", "'NOID' allows an empty result")
    return _whole_lines(Mesh(mesh.nodes, tuple(parts)))


@operator(
    "ENVE",
    arg("mesh", "MAILLAGE"),
    flag("inwards", "ORIE"),
    flag("allowed", "NOID"),
    family="mesh",
    full_name="ENVELOPPE",
    help=Help(
        en="Skin of a volume: the faces of one cell only, described inwards where the volume's "
        "cells are in the direct sense ('ORIE': in any case). 'NOID' allows an empty result.",
        fr="Enveloppe d'un volume : les faces d'un seul élément, décrites vers l'intérieur là "
        "où les éléments du volume sont de sens direct ('ORIE' : toujours). 'NOID' permet un "
        "résultat vide.",
        syntax="SURF1 = ENVE VOLU1 ('ORIE') ('NOID') ;",
        examples=(
            "OPTI DIME 3 ELEM CUB8 ; S = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 2 (0. 1. 0.) ;"
            " V = S VOLU 2 'TRAN' (0. 0. 1.) ; LIST (NBEL (ENVE V)) ;",
        ),
    ),
)
def enve(mesh: Mesh, inwards: bool, allowed: bool) -> Mesh:
    """Skin of a volume."""
    skin = envelope(orient(mesh, 3) if inwards else mesh)
    if not skin.blocks and not allowed:
        raise MeshError("the mesh has no envelope", "it holds no volume cells; 'NOID' allows that")
    return Mesh(skin.nodes, tuple(flip(b) for b in skin.blocks))


@operator(
    "ARET",
    arg("mesh", "MAILLAGE"),
    family="mesh",
    full_name="ARETE",
    help=Help(
        en="Sharp edges, as SEG2: where the skin turns by more than 20 degrees, or ends.",
        fr="Arêtes vives, en SEG2 : là où la peau tourne de plus de 20 degrés, ou finit.",
        syntax="GEO1 = ARET GEO2 ;",
        examples=(
            "OPTI DIME 3 ELEM CUB8 ; S = (DROI 2 (0. 0. 0.) (1. 0. 0.)) TRAN 2 (0. 1. 0.) ;"
            " V = S VOLU 2 'TRAN' (0. 0. 1.) ; LIST (NBEL (ARET V)) ;",
        ),
    ),
)
def aret(mesh: Mesh) -> Mesh:
    """Sharp edges."""
    return sharp_edges(mesh)


@INVE.on(
    "MAILLAGE",
    syntax="GEO2 = INVE GEO1 ;",
    en="Of a mesh: cells turned inside out; the cells of lines also in reverse order.",
    fr="D'un maillage : éléments retournés ; ceux des lignes aussi dans l'ordre inverse.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; L = INVE (DROI 2 (0. 0.) (1. 0.)) ;"
        " LIST (COOR 1 (L POIN 'INIT')) ;",
    ),
)
def inverted(call: Call, mesh: Mesh) -> Mesh:
    """Mesh turned inside out."""
    return reversed_line(mesh)


@operator(
    "ORIE",
    family="mesh",
    full_name="ORIENTER",
    help=Help(
        en="Cells described so that their Jacobian is positive (lines in 1D, surfaces in 2D, "
        "volumes in 3D); with a direction or towards a 'POINT', surface cells in space turned so "
        "that their normals go that way, and bricks of 8 nodes (shells SHB8) so that they go from "
        "their first four nodes to their last four, FACE 1 and FACE 2 of the result.",
        fr="Eléments décrits de sorte que leur jacobien soit positif (lignes en 1D, surfaces en "
        "2D, volumes en 3D) ; avec une direction ou vers un 'POINT', éléments de surface dans "
        "l'espace retournés pour que leurs normales aillent dans ce sens, et cubes à 8 noeuds "
        "(coques SHB8) pour qu'ils aillent de leurs quatre premiers noeuds aux quatre derniers, "
        "FACE 1 et FACE 2 du résultat.",
        syntax="GEO1 = ORIE GEO2 (('DIRE') VEC1 | 'POINT' POIN1) ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; S = ORIE ((DROI 4 (0. 0.) (1. 0.)) TRAN 3 (0. -1.)) ;"
            " LIST (MESU S) ;",
        ),
    ),
    reads_itself=True,
)
def orie(call: Call) -> Mesh:
    """Orient cells."""
    mesh: Mesh = call.required("MAILLAGE")
    word = call.keyword(("DIRECTION", "POINT"))
    target: Point | None = call.optional("POINT")
    if target is None:
        if word is not None:
            raise call.missing(("POINT",))
        return orient(mesh, max(workspace(call.session).dimension, 1))
    return orient_towards(mesh, target.coordinates.copy(), word == "POINT")


@operator(
    "VERS",
    arg("mesh", "MAILLAGE"),
    family="mesh",
    full_name="VERSENS",
    help=Help(
        en="The same mesh, or an error if two adjacent cells are described in opposite senses.",
        fr="Le même maillage, ou une erreur si deux éléments jointifs sont décrits en sens "
        "opposés.",
        syntax="GEO2 = VERS GEO1 ;",
        examples=("OPTI DIME 2 ELEM SEG2 ; L = VERS (DROI 4 (0. 0.) (1. 0.)) ;",),
    ),
)
def vers(mesh: Mesh) -> Mesh:
    """Check the sense of description."""
    return check_consistent(mesh)


@ORDO.on(
    "MAILLAGE",
    syntax="MAIL2 = ORDO MAIL1 ;",
    en="Of a mesh: lines put end to end, points by distance from the first one.",
    fr="D'un maillage : lignes mises bout à bout, points par distance au premier.",
)
def ordered(call: Call, mesh: Mesh) -> Mesh:
    """Mesh with its cells in order."""
    return Mesh(mesh.nodes, tuple(_ordered_block(b) for b in mesh.blocks))


def _ordered_block(block: CellBlock) -> CellBlock:
    if block.kind.dimension == 0:
        at = block.coordinates[:, 0]
        order = np.argsort(np.linalg.norm(at - at[0], axis=1), kind="stable")
        return CellBlock.make(block.nodes, "POI1", block.raw[order], block.colours[order])
    if block.kind.dimension > 1 or block.kind.joint:
        return block
    return chained(Mesh(block.nodes, (_in_one_sense(block),))).blocks[0]


def _in_one_sense(block: CellBlock) -> CellBlock:
    """Segments turned so that each chain runs in the sense of its first cell."""
    table = block.connectivity.copy()
    touching: dict[int, list[int]] = {}
    for i, (a, b) in enumerate(table[:, [0, -1]].tolist()):
        touching.setdefault(a, []).append(i)
        touching.setdefault(b, []).append(i)
    turned = np.zeros(len(table), dtype=bool)
    seen = np.zeros(len(table), dtype=bool)
    for first in range(len(table)):
        todo = [] if seen[first] else [first]
        seen[first] = True
        while todo:
            cell = todo.pop()
            tail, head = table[cell, [0, -1]] if not turned[cell] else table[cell, [-1, 0]]
            for node, at_start in ((int(head), True), (int(tail), False)):
                for other in touching[node]:
                    if not seen[other] and len(touching[node]) == 2:
                        seen[other] = True
                        starts_here = int(table[other, 0]) == node
                        turned[other] = starts_here != at_start
                        todo.append(other)
    return flip(block, turned)
