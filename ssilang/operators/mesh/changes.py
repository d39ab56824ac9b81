"""Meshes made of other cells, by hand, or coloured: CHAN, MANU, COUL on meshes; REGE, DEDO."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.io.plots.palette import index_of
from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import edges, faces
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes.complete import COMPLETE, complete, taken_apart
from ssilang.kernel.mesh.changes.cut_open import cut_open
from ssilang.kernel.mesh.changes.degree import LINEAR, linear, quadratic
from ssilang.kernel.mesh.changes.merge import regenerate, repeated_nodes
from ssilang.kernel.mesh.changes.split import split_quadrangles, tetrahedra
from ssilang.kernel.mesh.combine import poi1, recolour, union
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.language.registry import Help, arg, flag, operator
from ssilang.language.run.call import Call
from ssilang.language.run.session import Session
from ssilang.language.values import ListEnti
from ssilang.operators.dispatch import CHAN, COUL, MANU
from ssilang.operators.workspace import workspace

_SIMPLEX = {"TRI3": "QUA4", "TRI6": "QUA8"}


def changed(mesh: Mesh, target: str) -> Mesh:
    """The mesh made of cells of another type.

    Points from any mesh; lines as edges; quadrangles cut into triangles, volumes into
    tetrahedra; quadratic cells from linear ones and the reverse.

    Raises
    ------
    MeshError
        If there is no way from a cell of the mesh to the type.
    """
    if target == "POI1":
        return poi1(mesh.nodes, mesh.node_ids)
    parts = [_changed_block(b, target) for b in mesh.blocks]
    return union(*parts, as_given=True) if parts else mesh


def _changed_block(block: CellBlock, target: str) -> Mesh:
    alone = Mesh(block.nodes, (block,))
    kind = CELL_TYPES[target]
    if block.cell_type == target:
        return alone
    whole = block.cell_type in COMPLETE.values() and kind.degree == 1
    if whole and kind.dimension >= block.kind.dimension:
        return taken_apart(block, target)
    if target in COMPLETE.values():
        return complete(alone)
    if kind.degree == 2 and block.kind.degree == 1:
        return quadratic(_changed_block(block, LINEAR[target]))
    if (block.cell_type, target) == ("SEG3", "SEG2"):
        halves = block.connectivity[:, [0, 1, 1, 2]].reshape(-1, 2)
        return Mesh.of(block.nodes, "SEG2", halves, np.repeat(block.colours, 2))
    if kind.degree == 1 and block.kind.degree == 2 and not whole:
        return _changed_block(linear(alone).single_block(), target)
    if kind.dimension == 1 and block.kind.dimension > 1:
        return edges(alone)
    if target in _SIMPLEX and block.cell_type == _SIMPLEX[target]:
        return split_quadrangles(alone)
    if target == "TET4" and block.kind.dimension == 3:
        return Mesh.of(block.nodes, "TET4", tetrahedra(block))
    if target == "TE10" and block.kind.dimension == 3:
        return quadratic(Mesh.of(block.nodes, "TET4", tetrahedra(block)))
    if kind.dimension == 2 and block.kind.dimension == 3:
        return changed(faces(alone), target)
    if (target, block.cell_type) in (("QUA4", "TRI3"), ("QUA8", "TRI6")):
        return alone  # triangles among quadrangles stay as they are
    raise MeshError(f"cells of type {block.cell_type} cannot be changed into {target}")


def _by_hand(mesh: Mesh, target: str, order: IntArray) -> Mesh:
    """Cells on the points of a mesh, by a list of their numbers in it."""
    ids = mesh.node_ids
    size = CELL_TYPES[target].n_nodes
    if len(order) % size or not len(order):
        raise MeshError(f"{len(order)} numbers do not make whole cells of {size} points")
    if order.min() < 1 or order.max() > len(ids):
        raise MeshError(f"the numbers go beyond the {len(ids)} points of the mesh")
    return Mesh.of(mesh.nodes, target, ids[order - 1].reshape(-1, size))


@CHAN.on(
    *CELL_TYPES,
    syntax="GEO2 = CHAN (TYPE) GEO1 (LENTI1) ;",
    en="A cell type: the mesh made of such cells (the type of OPTI ELEM when none is said). From "
    "points, a list of numbers gives the connectivity.",
    fr="Un type d'élément : le maillage formé de tels éléments (par défaut celui d'OPTI ELEM). A "
    "partir de points, une liste de numéros donne la connectivité.",
    examples=(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (1. 0.)) TRAN 3 (0. 1.) ;"
        " LIST (NBEL (CHAN 'POI1' S)) ; LIST (NBEL (CHAN 'TRI3' S)) ;",
    ),
)
def change_type(call: Call, word: str) -> Mesh:
    """Mesh of another cell type."""
    mesh: Mesh = call.required("MAILLAGE")
    numbers: ListEnti | None = call.optional("LISTENTI")
    return changed(mesh, word) if numbers is None else _by_hand(mesh, word, numbers.values)


@CHAN.on_type("MAILLAGE")
def change_to_current(call: Call, mesh: Mesh) -> Mesh:
    """Mesh of the cell type of OPTI ELEM."""
    target = workspace(call.session).element
    if not target:
        raise MeshError("no element type is chosen yet", "set it: OPTI ELEM, or name the type")
    numbers: ListEnti | None = call.optional("LISTENTI")
    return changed(mesh, target) if numbers is None else _by_hand(mesh, target, numbers.values)


_WHOLE = {
    "LIGNE": edges,
    "SURFACE": faces,
    "LINEAIRE": linear,
    "QUADRATIQUE": quadratic,
    "QUAF": complete,
}


@CHAN.on(
    *_WHOLE,
    syntax="GEO2 = CHAN 'LIGNE'|'SURFACE'|'LINEAIRE'|'QUADRATIQUE'|'QUAF' GEO1 ;",
    en="'LIGN': all edges of the cells, each once; 'SURF': all faces; 'LINE', 'QUAD': linear or "
    "quadratic cells in place of the others; 'QUAF': complete ones, with nodes in the middle of "
    "faces and cells, that linear types then take apart (TRI7 into 6 TRI3 or 3 QUA4, CU27 into 8 "
    "CUB8).",
    fr="'LIGN' : toutes les arêtes des éléments, une fois chacune ; 'SURF' : toutes les faces ; "
    "'LINE', 'QUAD' : éléments linéaires ou quadratiques à la place des autres ; 'QUAF' : éléments "
    "complets, à noeuds au milieu des faces et des éléments, que les types linéaires découpent "
    "ensuite (TRI7 en 6 TRI3 ou 3 QUA4, CU27 en 8 CUB8).",
    examples=(
        "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (1. 0.)) TRAN 3 (0. 1.) ;"
        " LIST (NBNO (CHAN 'QUAD' S)) ; LIST (NBEL (CHAN 'LIGN' S)) ;",
    ),
)
def change_whole(call: Call, word: str) -> Mesh:
    """Edges, faces, linear or quadratic cells."""
    return _WHOLE[word](call.required("MAILLAGE"))


@MANU.on(
    *CELL_TYPES,
    syntax="GEO1 = MANU TYPE POIN1 POIN2 ...|GEO2 (COUL1) ;",
    en="A cell type: cells of that type on points, or on the points of a mesh.",
    fr="Un type d'élément : éléments de ce type sur des points, ou sur ceux d'un maillage.",
    examples=("OPTI DIME 2 ; T = MANU 'TRI3' (0. 0.) (1. 0.) (0. 1.) ROUG ; LIST (MESU T) ;",),
)
def by_hand(call: Call, word: str) -> Mesh:
    """Cells given node by node."""
    ws = workspace(call.session)
    colour = call.keyword(COLOURS)
    given: list[Any] = call.all("POINT", "MAILLAGE")
    colour = colour or call.keyword(COLOURS)
    given += call.all("POINT", "MAILLAGE")
    if not given:
        raise call.missing(("POINT", "MAILLAGE"))
    ids = np.concatenate([[g.node] if isinstance(g, Point) else g.node_ids for g in given])
    size = CELL_TYPES[word].n_nodes
    if len(ids) % size:
        raise MeshError(f"a cell {word} needs {size} points, {len(ids)} are given")
    shade = ws.colour if colour is None else COLOURS.index(colour)
    return Mesh.of(ws.nodes, word, ids.astype(np.int64).reshape(-1, size), shade)


@COUL.on(
    "MAILLAGE",
    syntax="OBJ2 = OBJ1 COUL (MOT1|ENT1) ;",
    en="Of a mesh: the same cells in another colour, by name or number (that of OPTI COUL when "
    "none is said).",
    fr="D'un maillage : les mêmes éléments dans une autre couleur, par nom ou numéro (celle "
    "d'OPTI COUL par défaut).",
    examples=("OPTI DIME 2 ELEM SEG2 ; L = (DROI 2 (0. 0.) (1. 0.)) COUL ROUG ;",),
)
def coloured(call: Call, mesh: Mesh) -> Mesh:
    """Mesh in another colour."""
    number = call.optional("ENTIER")
    if number is not None:
        return recolour(mesh, min(max(number - 1, 0), len(COLOURS) - 1))
    word = call.word()
    return recolour(mesh, workspace(call.session).colour if word is None else index_of(word))


@operator(
    "REGE",
    arg("mesh", "MAILLAGE"),
    flag("check", "VERI"),
    family="mesh",
    full_name="REGENERER",
    help=Help(
        en="Cells in which nodes coincide after ELIM replaced by simpler ones: QUA4 by TRI3, CUB8 "
        "by PRI6 ... 'VERI' warns when some are left.",
        fr="Eléments dont des noeuds sont confondus après ELIM remplacés par de plus simples : "
        "QUA4 par TRI3, CUB8 par PRI6 ... 'VERI' avertit s'il en reste.",
        syntax="GEO1 = REGE GEO2 ('VERI') ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 2 (0. 0.) (1. 0.)) ROTA 4 90. (1E-4 0.) ;"
            " ELIM S 0.01 ; T = REGE S ; LIST (NBEL (T ELEM TRI3)) ;",
        ),
    ),
)
def rege(session: Session, mesh: Mesh, check: bool) -> Mesh:
    """Replace degenerate cells."""
    made = regenerate(mesh)
    left = repeated_nodes(made) if check else 0
    if left:
        session.print(f"REGENERER : {left} element(s) ont encore un noeud double")
    return made


@operator(
    "DEDO",
    arg("surface", "MAILLAGE"),
    arg("line", "MAILLAGE"),
    family="mesh",
    full_name="DEDOUBLER",
    help=Help(
        en="Opens a surface along a line of its edges: the nodes of the line are doubled, except a "
        "tip inside the surface. Gives the new surface and the line on the new nodes.",
        fr="Ouvre une surface le long d'une ligne de ses arêtes : les noeuds de la ligne sont "
        "dédoublés, sauf une pointe intérieure. Rend la nouvelle surface et la ligne sur les "
        "nouveaux noeuds.",
        syntax="GEO3 GEO4 = DEDO GEO1 GEO2 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 2 (0. 0.) (1. 0.) ;"
            " S = (L TRAN 1 (0. 1.)) ET (L TRAN 1 (0. -1.)) ; T M = DEDO S L ; LIST (NBNO T) ;",
        ),
    ),
)
def dedo(surface: Mesh, line: Mesh) -> tuple[Mesh, Mesh]:
    """Double the nodes of a line."""
    return cut_open(surface, line)
