"""Cells picked from a mesh: ELEM, INCL; meshes as sets: ET DIFF INTE UNIQ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.plots.palette import NAMES as COLOURS
from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.mesh.boundary import chained, contour
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.changes.local_refinement import TIE, is_tie, parted
from ssilang.kernel.mesh.combine import (
    intersection,
    of_type,
    points_mesh,
    polygons,
    symmetric_difference,
    take,
    union,
    without_duplicates,
)
from ssilang.kernel.mesh.lines.paths import network_of_lines, shortest_line
from ssilang.kernel.mesh.mesh import CellBlock, Mesh, Point
from ssilang.kernel.mesh.queries.select import (
    containing,
    inside_contour,
    inside_volume,
    resting_on,
    stretch,
)
from ssilang.kernel.mesh.surfaces.surface_crossing import crossed
from ssilang.language.registry import Help, arg, choice, flag, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.values import ListEnti, ListMots
from ssilang.operators.dispatch import DIFF, INTE, UNIQ, union_with_call, union_words
from ssilang.operators.mesh.crossings import drawn_crossing, draws_a_curve
from ssilang.operators.mesh.points import picked

_EXTREMES = ("MAXI", "MINI", "SUPERIEUR", "EGSUPE", "EGALE", "EGINFE", "INFERIEUR", "DIFFERENT")


@operator(
    "ELEM",
    family="mesh",
    full_name="ELEMENT",
    help=Help(
        en="Picks cells: by type, by colour, by number or list of numbers among those; 'CONT' the "
        "cell that holds a point ('TOUS': all of them); 'APPU' those on given points ('STRI' with "
        "all nodes, the default, 'LARG' with one at least); 'COMP' the part of a line between two "
        "points, described from the first to the second; of a network such as ARET's the shortest "
        "way. 'TYPE' and 'COUL' alone list the cell "
        "types and colours. From a cell field: cells whose values are extreme or compare. 'NOVE' "
        "allows an empty result.",
        fr="Choisit des éléments : par type, par couleur, par numéro ou liste de numéros parmi "
        "ceux-ci ; 'CONT' l'élément contenant un point ('TOUS' : tous) ; 'APPU' ceux qui "
        "s'appuient sur des points ('STRI' par tous leurs noeuds, par défaut, 'LARG' par un au "
        "moins) ; 'COMP' la partie d'une ligne entre deux points, décrite du premier au second ; "
        "d'un réseau comme celui d'ARET le plus court chemin. "
        "'TYPE' et 'COUL' seuls listent types et couleurs. D'un champ par éléments : éléments de "
        "valeurs extrêmes ou vérifiant une comparaison. 'NOVE' permet un résultat vide.",
        syntax="GEO1 = GEO2 ELEM (TYPE) (COUL1) (N1|LENTI1) | 'COUL' I1 | 'CONT' P1 ('TOUS') "
        "('NOVE') | 'APPU' ('STRI'|'LARG') GEO3 ('NOVE') | 'COMP' P1 P2 ;\n"
        "LMOTS1 = GEO2 ELEM 'TYPE'|'COUL' ;\n"
        "GEO1 = CHAM1 ELEM 'MAXI'|'MINI'|'SUPE' X1|'COMP' X1 X2 ('ABS') ('LARG'|'STRI') "
        "('AVEC'|'SANS' LMOTS1) ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; P = 0.25 0. ; L = (DROI 2 (0. 0.) P) ET (DROI 3 P (1. 0.)) ;"
            " M = L ELEM 'APPU' 'LARG' P ; LIST (NBEL M) ;",
        ),
    ),
    reads_itself=True,
)
def elem(call: Call) -> Any:
    """Pick cells."""
    source = call.optional("MAILLAGE", "MCHAML")
    if isinstance(source, CellField):
        return _of_field(call, source)
    way = call.keyword(("CONTENANT", "APPUYE", "COMPRIS", "TYPE"))
    if way == "APPUYE":
        return _resting(call, source)
    if way == "CONTENANT":
        return _containing(call, source)
    mesh = source or call.required("MAILLAGE")
    if way == "COMPRIS":
        first, second = call.required("POINT"), call.required("POINT")
        return _part_of_line(mesh, first.node, second.node)
    if way == "TYPE":
        names = [TIE if is_tie(b.cell_type) else b.cell_type for b in mesh.blocks]
        return ListMots(list(dict.fromkeys(names)))
    return _by_type_and_colour(call, mesh)


def _part_of_line(mesh: Mesh, first: int, second: int) -> Mesh:
    """The part of a line between two nodes; of a network, the shortest way."""
    try:
        return stretch(chained(mesh), first, second)
    except MeshError:
        if not network_of_lines(mesh):
            raise
    return shortest_line(mesh, first, second)


def _by_type_and_colour(call: Call, mesh: Mesh) -> Any:
    chosen = mesh
    while True:
        word = call.keyword((TIE, *CELL_TYPES, "POLY", "COUL", *COLOURS))
        if word is None:
            break
        if word == "COUL":
            number = call.optional("ENTIER")
            if number is None:
                shades = np.concatenate([b.colours for b in mesh.blocks])
                _, first = np.unique(shades, return_index=True)
                return ListMots([COLOURS[shades[k]] for k in np.sort(first)])
            chosen = _of_colour(chosen, max(number - 1, 0))
        elif word == TIE:
            chosen = Mesh(chosen.nodes, parted(chosen)[1])
        elif word in CELL_TYPES:
            chosen = of_type(chosen, word)
        elif word == "POLY":
            chosen = polygons(chosen)
        else:
            chosen = _of_colour(chosen, COLOURS.index(word))
    which = call.optional("ENTIER", "LISTENTI")
    left = call.peek_word()
    if left is not None:
        raise call.bad(f"'{left.rstrip()}' is no element type, colour or keyword of ELEM")
    if which is None:
        return chosen
    numbers = which.values if isinstance(which, ListEnti) else np.array([which])
    return _numbered(call, chosen, numbers, which)


def _of_colour(mesh: Mesh, colour: int) -> Mesh:
    made = take(mesh, lambda b: b.colours == colour)
    if not made.blocks:
        raise MeshError(f"no element has colour {COLOURS[colour]}", "see OPTI COUL and COUL")
    return made


def _numbered(call: Call, mesh: Mesh, numbers: IntArray, said: object) -> Mesh:
    if (numbers < 1).any() or (numbers > mesh.n_cells).any():
        wrong = numbers[(numbers < 1) | (numbers > mesh.n_cells)][0]
        raise call.bad(f"element {wrong} is asked of {mesh.n_cells}", said)
    blocks, start = [], 0
    for block in mesh.blocks:
        rows = numbers[(numbers > start) & (numbers <= start + len(block))] - 1 - start
        start += len(block)
        if len(rows):
            blocks.append(
                CellBlock.make(
                    mesh.nodes, block.cell_type, block.connectivity[rows], block.colours[rows]
                )
            )
    return Mesh(mesh.nodes, tuple(blocks))


def _resting(call: Call, mesh: Mesh | None) -> Mesh:
    how = call.keyword(("STRICTEMENT", "LARGEMENT"))
    support = call.all("MAILLAGE", "POINT")
    allowed = call.keyword(("NOVERIF",)) is not None
    support += call.all("MAILLAGE", "POINT")
    if mesh is None:
        if len(support) < 2 or not isinstance(support[-1], Mesh):
            raise call.missing(("MAILLAGE",))
        mesh, support = support[-1], support[:-1]
    if not support:
        raise call.missing(("MAILLAGE", "POINT"))
    ids = np.concatenate(
        [np.array([s.node]) if isinstance(s, Point) else s.node_ids for s in support]
    )
    made = resting_on(mesh, ids, how != "LARGEMENT")
    if not made.blocks and not allowed:
        raise MeshError(
            "no element of the mesh rests on these points",
            "check that they belong to the mesh (ELIM), or use 'LARG'; 'NOVE' allows none",
        )
    return made


def _containing(call: Call, mesh: Mesh | None) -> Mesh:
    point: Point = call.required("POINT", after=call.keyword_end)
    mesh = mesh or call.required("MAILLAGE")
    every = allowed = False
    while (word := call.keyword(("TOUS", "NOVERIF"))) is not None:
        every |= word == "TOUS"
        allowed |= word == "NOVERIF"
    made = containing(mesh, point.coordinates, every)
    if not made.blocks and not allowed:
        raise MeshError("the point is outside of all elements of the mesh", "'NOVE' allows that")
    return made


def _of_field(call: Call, field: CellField) -> Mesh:
    """Cells by their values."""
    word = call.keyword((*_EXTREMES, "COMPRIS"))
    if word is None:
        raise call.bad("what is sought in the field is not said", hint=" ".join(_EXTREMES))
    count = {"MAXI": 0, "MINI": 0, "COMPRIS": 2}.get(word, 1)
    limits = [call.required("FLOTTANT", after=call.keyword_end) for _ in range(count)]
    absolute = strict = False
    names: tuple[str, set[str]] | None = None
    options = ("ABS", "LARG", "STRI", "AVEC", "SANS")
    while (option := call.keyword(options)) is not None:
        absolute |= option == "ABS"
        strict |= option == "STRI"
        if option in ("AVEC", "SANS"):
            listed = call.required("LISTMOTS", after=call.keyword_end)
            names = option, {str(n).rstrip() for n in listed.values}
    values = [_values(b, names, absolute) for b in field.blocks]
    if word in ("MAXI", "MINI"):
        return _extreme_cell(field, values, word)
    blocks: list[CellBlock] = []
    for block, table in zip(field.blocks, values, strict=True):
        good = picked(table, word, limits)
        keep = np.asarray((np.all if strict else np.any)(good, axis=1))
        blocks += _rows(block.cells, keep).blocks
    parts = [Mesh(b.nodes, (b,)) for b in blocks]
    return union(*parts, as_given=True) if parts else Mesh(field.blocks[0].cells.nodes, ())


def _rows(cells: CellBlock, keep: NDArray[np.bool_]) -> Mesh:
    return take(Mesh(cells.nodes, (cells,)), lambda _: keep)


def _values(
    block: CellFieldBlock, names: tuple[str, set[str]] | None, absolute: bool
) -> FloatArray:
    """All values (n_cells, m) of the chosen components of a block."""
    chosen = [
        np.asarray(v, dtype=float).reshape(len(block.cells), -1)
        for k, v in block.components.items()
        if names is None or (k in names[1]) == (names[0] == "AVEC")
    ]
    if not chosen:
        raise MeshError("the field has none of these components")
    table = np.hstack(chosen)
    return np.abs(table) if absolute else table


def _extreme_cell(field: CellField, values: Sequence[FloatArray], word: str) -> Mesh:
    sense = 1.0 if word == "MAXI" else -1.0
    best = [float((sense * t).max(initial=-np.inf)) for t in values]
    where = int(np.argmax(best))
    cells, table = field.blocks[where].cells, values[where]
    row = int((sense * table).max(axis=1).argmax())
    picked_row: NDArray[np.int64] = np.array([row])
    return take(Mesh(cells.nodes, (cells,)), lambda _: picked_row)


@operator(
    "INCL",
    flag("volume", "VOLU"),
    arg("mesh", "MAILLAGE"),
    arg("outer", "MAILLAGE"),
    choice("how", ("STRI", "LARG", "BARY")),
    flag("allowed", "NOID"),
    opt("margin", "FLOTTANT"),
    family="mesh",
    full_name="INCLUS",
    help=Help(
        en="Cells of a mesh that lie inside a closed plane line ('LARG', the default: nodes on the "
        "line count; 'STRI': they do not; 'BARY': by the cells' centres), or with 'VOLU' inside "
        "volume cells ('STRI', the default: all nodes; 'LARG': one at least; 'BARY'). 'NOID' "
        "allows an empty result.",
        fr="Eléments d'un maillage intérieurs à une ligne plane fermée ('LARG', par défaut : les "
        "noeuds de la ligne comptent ; 'STRI' : ils ne comptent pas ; 'BARY' : par les centres) "
        "ou, avec 'VOLU', à des éléments volumiques ('STRI', par défaut : tous les noeuds ; 'LARG' "
        ": un au moins ; 'BARY'). 'NOID' permet un résultat vide.",
        syntax="GEO1 = INCL GEO2 GEO3 ('VOLU') ('STRI'|'LARG'|'BARY') ('NOID') (FLOT1) ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; S = (DROI 4 (0. 0.) (4. 0.)) TRAN 4 (0. 4.) ;"
            " C = CONT ((DROI 2 (0.5 0.5) (2.5 0.5)) TRAN 2 (0. 2.)) ;"
            " LIST (NBEL (INCL S C)) ;",
        ),
    ),
)
def incl(
    volume: bool, mesh: Mesh, outer: Mesh, how: str | None, allowed: bool, margin: float | None
) -> Mesh:
    """Cells inside a contour (or the contour of a surface), or inside a volume."""
    border = contour(outer) if not volume and outer.dimension == 2 else outer

    def inside(at: FloatArray) -> NDArray[np.bool_]:
        if volume:
            return inside_volume(at, outer, 1e-2 if margin is None else margin)
        return inside_contour(at, border, how == "STRI")

    def chosen(block: CellBlock) -> NDArray[np.bool_]:
        if how == "BARY":
            return inside(block.coordinates.mean(axis=1))
        good = inside(block.coordinates.reshape(-1, 3)).reshape(len(block), -1)
        return np.asarray((np.any if volume and how == "LARG" else np.all)(good, axis=1))

    made = take(mesh, chosen)
    if not made.blocks and not allowed:
        raise MeshError("no element lies inside", "'NOID' allows an empty result")
    return made


def as_mesh(item: Mesh | Point) -> Mesh:
    """The mesh itself, or a point as a mesh of one POI1."""
    return points_mesh([item], item.nodes) if isinstance(item, Point) else item


@union_with_call(
    ("MAILLAGE", "MAILLAGE"), ("POINT", "MAILLAGE"), ("MAILLAGE", "POINT"), ("POINT", "POINT")
)
def unite_meshes(call: Call, left: Mesh | Point, right: Mesh | Point) -> Mesh:
    """Cells of both; lines are put in the order in which they continue unless TELQ is said."""
    return union(as_mesh(left), as_mesh(right), as_given="TELQ" in union_words(call))


@DIFF.on(
    "MAILLAGE",
    syntax="GEO3 = GEO1 DIFF GEO2 ;",
    en="Of meshes: cells (same type, same nodes) of one only.",
    fr="De maillages : éléments (mêmes type et noeuds) de l'un seulement.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; A = DROI 2 (0. 0.) (1. 0.) ; B = A ET (DROI 3 (0. 1.) (1. 1.)) ;"
        " LIST (NBEL (A DIFF B)) ;",
    ),
)
def difference_of_meshes(call: Call, first: Mesh) -> Mesh:
    """Symmetric difference of two meshes."""
    return symmetric_difference(first, as_mesh(call.required("MAILLAGE", "POINT")))


@INTE.on(
    "MAILLAGE",
    syntax="GEO3 = GEO1 INTE GEO2 ;\nGEO1B GEO2B LIG1 LIG2 = INTE 'GEOM' GEO1 GEO2 ('NOVERIF') ;\n"
    "LIG1 = POIN1 | LIG2 INTE (N1) ('DINI' D1) ('DFIN' D2) ('LONG' X1) 'PLAN' P1 | 'SPHE' C1 | "
    "'CYLI' A1 A2 | 'CONI' S1 A1 | 'TORI' C1 A1 C2 (again) POIN2 ;",
    en="Of meshes: cells (same type, same nodes) that both hold. With 'GEOM', of two surfaces of "
    "TRI3 in space: both surfaces with their triangles cut where the surfaces cross, then the "
    "lines where they cross, by nodes of the first surface and by nodes of the second. Parts "
    "where the surfaces lie in one plane give no line. 'NOVERIF' allows an empty result. With two "
    "simple surfaces: the curve along which they cross, the shortest way from POIN1 to POIN2. The "
    "surfaces pass through POIN1: a plane (through POIN2 too), a sphere by its centre, a cylinder "
    "by its axis, a cone by its apex and a point of its axis, a torus by its centre, a point of "
    "its axis and the centre of a small circle. 'LONG' gives the length instead of the end, "
    "towards POIN2.",
    fr="De maillages : éléments (mêmes type et noeuds) communs. Avec 'GEOM', de deux surfaces de "
    "TRI3 dans l'espace : les deux surfaces, leurs triangles coupés là où elles se croisent, puis "
    "les lignes où elles se croisent, par des noeuds de la première surface et par des noeuds de "
    "la seconde. Les parties situées dans un même plan ne donnent pas de ligne. 'NOVERIF' permet "
    "un résultat vide. Avec deux surfaces simples : la courbe où elles se croisent, par le plus "
    "court chemin de POIN1 à POIN2. Les surfaces passent par POIN1 : un plan (aussi par POIN2), "
    "une sphère par son centre, un cylindre par son axe, un cône par son sommet et un point de son "
    "axe, un tore par son centre, un point de son axe et le centre d'un petit cercle. 'LONG' "
    "impose la longueur au lieu de l'extrémité, vers POIN2.",
    examples=(
        "OPTI DIME 2 ELEM SEG2 ; A = DROI 2 (0. 0.) (1. 0.) ; B = A ET (DROI 3 (0. 1.) (1. 1.)) ;"
        " LIST (NBEL (A INTE B)) ;",
        "OPTI DIME 3 ELEM TRI3 ; A = (DROI 2 (0. 0. 0.) (2. 0. 0.)) TRAN 2 (0. 2. 0.) ;"
        " B = (DROI 2 (-1. 1.1 -1.) (3. 1.1 -1.)) TRAN 2 (0. 0. 2.) ;"
        " C D L M = INTE 'GEOM' A B ; MESS (NBEL C) (NBEL D) (MESU L) ;",
        "OPTI DIME 3 ELEM SEG2 ; A = 1. 0. 0. ; B = 0. 1. 0. ;"
        " L = A INTE 16 'CYLI' (0. 0. -1.) (0. 0. 1.) 'PLAN' (-1. 0. 0.) B ; MESS (MESU L) ;",
    ),
)
def intersection_of_meshes(call: Call, first: Mesh) -> Mesh | tuple[Mesh, ...]:
    """Common cells of two meshes, or surfaces cut along their common lines."""
    if draws_a_curve(call):
        return drawn_crossing(call, first)
    geometric = call.keyword(("GEOM",)) is not None
    second = as_mesh(call.required("MAILLAGE", "POINT"))
    allowed = call.keyword(("NOVERIF",)) is not None
    if geometric:
        cut = crossed(first, second)
        if not cut[2].blocks and not allowed:
            raise MeshError("the two surfaces do not cross", "'NOVE' allows that")
        return cut
    made = intersection(first, second)
    if not made.blocks and not allowed:
        raise MeshError("the two meshes have no element in common", "'NOVE' allows that")
    return made


@INTE.on("POINT")
def _curve_between(call: Call, first: Point) -> Mesh:
    return drawn_crossing(call, first)


@UNIQ.on(
    "MAILLAGE",
    en="Of a mesh: each cell once, whatever the order of its nodes and its colour.",
    fr="D'un maillage : chaque élément une fois, quels que soient l'ordre de ses noeuds et sa "
    "couleur.",
)
def unique_cells(call: Call, mesh: Mesh) -> Mesh:
    """Each cell once."""
    return without_duplicates(mesh)
