"""Surfaces inside contours and between lines: DALL, SURF, COUT; sides: COTE."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.changes.split import split_quadrangles
from ssilang.kernel.mesh.combine import union
from ssilang.kernel.mesh.generators.stitch import cone, stitch
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.surfaces.charts import (
    Chart,
    cone_chart,
    cylinder_chart,
    plane_chart,
    sphere_chart,
    torus_chart,
)
from ssilang.kernel.mesh.surfaces.grid import grid_surface, matching_sides, sides_in_order
from ssilang.kernel.mesh.surfaces.polynomial_surface import (
    PolynomialSurface,
    mesh_polynomial_surface,
)
from ssilang.kernel.mesh.surfaces.surface import contour_chart_data, fill_surface
from ssilang.language.registry import Help, arg, operator, opt
from ssilang.language.run.call import Call
from ssilang.language.run.session import Session
from ssilang.operators.mesh.ends import chosen_family
from ssilang.operators.workspace import workspace

_POLYNOMIAL_EN = (
    "'POLY': the surface P(U,V), sum of P1 P2 P3 ... times 1 U U**2 ..., and of the further rows "
    "times V V**2 ..., N1 columns and N2 rows of points; U and V go from 0 to 1 or between the "
    "values behind 'PARA'. OPTI DENS says the size of the cells; 'REGU' spaces the nodes evenly "
    "along the sides, else they are even in U and V."
)
_POLYNOMIAL_FR = (
    "'POLY' : la surface P(U,V), somme de P1 P2 P3 ... fois 1 U U**2 ... et des lignes suivantes "
    "fois V V**2 ..., N1 colonnes et N2 lignes de points ; U et V vont de 0 à 1 ou entre les "
    "valeurs données derrière 'PARA'. OPTI DENS dit la taille des éléments ; 'REGU' répartit les "
    "noeuds régulièrement le long des côtés, sinon ils le sont en U et V."
)
_POLYNOMIAL_SYNTAX = (
    "SURF1 = {} 'POLY' N1 N2 P1 P2 (P3 ...) P11 P12 (P13 ...) (...) ('PARA' U1 U2 V1 V2) ('REGU') ;"
)
_SHAPES = ("PLANE", "SPHERIQUE", "CYLINDRIQUE", "CONIQUE", "TORIQUE")
# word -> number of points that follow, chart of the contour's positions and those points
_CHARTS: dict[str, tuple[int, Callable[..., Chart]]] = {
    "SPHERIQUE": (1, sphere_chart),
    "CYLINDRIQUE": (2, cylinder_chart),
    "CONIQUE": (2, cone_chart),
    "TORIQUE": (3, torus_chart),
}


def _polynomial(call: Call) -> Mesh:
    """Behind 'POLYNOME': numbers of columns and rows, the points row by row, the limits."""
    ws = workspace(call.session)
    columns, rows = (int(call.required("ENTIER")) for _ in range(2))
    if columns < 1 or rows < 1 or columns * rows < 2:
        raise call.bad(f"{columns} columns and {rows} rows make no surface", columns)
    points = [call.required("POINT") for _ in range(columns * rows)]
    limits, regular = [0.0, 1.0, 0.0, 1.0], False
    while (word := call.keyword(("PARAMETRE", "REGULIER"))) is not None:
        regular = regular or word == "REGULIER"
        if word == "PARAMETRE":
            place = call.keyword_end
            limits = [call.required("FLOTTANT", after=place) for _ in range(4)]
    table = np.array([p.coordinates for p in points]).reshape(rows, columns, 3)
    shape = PolynomialSurface(table, (limits[0], limits[1]), (limits[2], limits[3]))
    surface = chosen_family(ws).need_surface()
    return mesh_polynomial_surface(ws.nodes, shape, ws.density, surface, regular, ws.colour)


def _curved_chart(call: Call, word: str, boundary: FloatArray) -> Chart:
    count, make = _CHARTS[word]
    place = call.keyword_end
    points = [call.required("POINT", after=place).coordinates.copy() for _ in range(count)]
    return make(boundary, *points)


@operator(
    "SURF",
    family="mesh",
    full_name="SURFACE",
    help=Help(
        en="Mesh inside closed lines (holes run the other way): in their plane (the default), on a "
        "sphere, cylinder, cone or torus. OPTI ELEM decides between triangles, quadrangles with "
        "some triangles, and (POLY) polygons with some triangles. A nodal "
        "field of one component gives the mesh sizes to respect. " + _POLYNOMIAL_EN,
        fr="Maillage intérieur à des lignes fermées (les trous tournent en sens inverse) : dans "
        "leur plan (par défaut), sur une sphère, un cylindre, un cône ou un tore. OPTI ELEM "
        "choisit triangles, quadrangles avec quelques triangles, ou (POLY) polygones avec quelques "
        "triangles. Un champ par points à une "
        "composante donne les tailles de maille à respecter. " + _POLYNOMIAL_FR,
        syntax="SURF1 = SURF (CHPO1) LIG1 'PLANE' (CRIT) | 'SPHE' CENTR1 | 'CYLI' AXE1 AXE2 | "
        "'CONI' SOMM1 AXE1 | 'TORI' CENTR1 AXE1 CENTR2 ;\n" + _POLYNOMIAL_SYNTAX.format("SURF"),
        examples=(
            "OPTI DIME 2 ELEM TRI3 ; A = 0. 0. ; B = 1. 0. ; C = 0. 1. ;"
            " L = A DROI 5 B DROI 5 C DROI 5 A ; S = SURF L 'PLANE' ;",
        ),
    ),
    reads_itself=True,
)
def surf(call: Call) -> Mesh:
    """Mesh the inside of a contour."""
    if call.keyword(("POLYNOME",)) is not None:
        return _polynomial(call)
    field: NodeField | None = call.optional("CHPOINT")
    contour: Mesh | None = call.optional("MAILLAGE")
    field = field or call.optional("CHPOINT")
    word = call.keyword(_SHAPES)
    contour = contour or call.required("MAILLAGE")
    boundary, segments = contour_chart_data(contour)
    if word is None or word == "PLANE":
        criterion = call.optional("FLOTTANT")
        chart = plane_chart(boundary, segments, 1e-3 if criterion is None else abs(criterion))
    else:
        chart = _curved_chart(call, word, boundary)
    ws = workspace(call.session)
    surface = chosen_family(ws).need_surface()
    return fill_surface(contour, chart, surface, ws.colour, _wanted_sizes(field))


def _wanted_sizes(field: NodeField | None) -> tuple[FloatArray, FloatArray] | None:
    if field is None:
        return None
    part = next(iter(field.components.values()))
    return field.table.coordinates[part.nodes].copy(), part.values


@operator(
    "DALL",
    family="mesh",
    full_name="DALLER",
    help=Help(
        en="Surface on four lines that form a contour: a grid when opposite sides have the same "
        "number of cells. 'PLAN', 'SPHE', 'CYLI', 'CONI', 'TORI' say on what it lies; 'QUEL' "
        "interpolates between the sides. Cells turn as the contour does. COTE gives the sides. "
        + _POLYNOMIAL_EN,
        fr="Surface sur quatre lignes formant un contour : une grille si les côtés opposés ont le "
        "même nombre d'éléments. 'PLAN', 'SPHE', 'CYLI', 'CONI', 'TORI' disent sur quoi elle "
        "s'appuie ; 'QUEL' interpole entre les côtés. COTE rend les côtés. " + _POLYNOMIAL_FR,
        syntax="SURF1 = DALL COTE1 COTE2 COTE3 COTE4 'PLAN' | 'SPHE' CENTR1 | 'CYLI' POIN1 POIN2 | "
        "'CONI' POIN1 POIN2 | 'TORI' CENTR1 POIN1 CENTR2 | 'QUELCONQUE' ;\n"
        + _POLYNOMIAL_SYNTAX.format("DALL"),
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; A = 0. 0. ; B = 1. 0. ; C = 1. 1. ; D0 = 0. 1. ;"
            " S = DALL (DROI 3 A B) (DROI 2 B C) (DROI 3 C D0) (DROI 2 D0 A) 'PLAN' ;"
            " LIST (NBEL S) ;",
        ),
    ),
    reads_itself=True,
)
def dall(call: Call) -> Mesh:
    """Make a grid on four sides."""
    if call.keyword(("POLYNOME",)) is not None:
        return _polynomial(call)
    ws = workspace(call.session)
    sides: list[Mesh] = call.all("MAILLAGE")
    word = call.keyword((*_SHAPES, "QUELCONQUE"))
    sides += [call.required("MAILLAGE") for _ in range(4 - len(sides))]
    ordered = sides_in_order(sides)
    chart = None
    if word in _CHARTS:
        boundary, _ = contour_chart_data(union(*ordered, as_given=True))
        chart = _curved_chart(call, word, boundary)
    surface = chosen_family(ws).need_surface()
    if matching_sides(ordered):
        made = grid_surface(ordered, chart, ws.colour)
        return split_quadrangles(made) if surface.startswith("TRI") else made
    contour = union(*ordered, as_given=True)
    if chart is None:
        chart = plane_chart(*contour_chart_data(contour))
    made = fill_surface(contour, chart, surface, ws.colour)
    return Mesh(made.nodes, made.blocks, ordered)


@operator(
    "COUT",
    arg("first", "MAILLAGE"),
    arg("second", "MAILLAGE", "POINT"),
    family="mesh",
    full_name="COUTURE",
    help=Help(
        en="Triangles between two lines described in the same sense, whatever their numbers of "
        "cells; or the cells of a mesh joined to a point (POI1 give SEG2, SEG2 TRI3, TRI3 TET4, "
        "QUA4 PYR5), those that hold the point being left out.",
        fr="Triangles entre deux lignes décrites dans le même sens, quels que soient leurs nombres "
        "d'éléments ; ou éléments d'un maillage joints à un point (POI1 donnent SEG2, SEG2 TRI3, "
        "TRI3 TET4, QUA4 PYR5), sauf ceux qui touchent le point.",
        syntax="SURF1 = COUT LIG1 LIG2 ;\nMAIL2 = COUT MAIL1 POIN1 ;",
        examples=(
            "OPTI DIME 2 ELEM SEG2 ; L = DROI 4 (0. 0.) (1. 0.) ; M = DROI 2 (0. 1.) (1. 1.) ;"
            " LIST (NBEL (COUT L M)) ;",
        ),
    ),
)
def cout(session: Session, first: Mesh, second: Mesh | Point) -> Mesh:
    """Stitch lines together, or join cells to a point."""
    if isinstance(second, Point):
        return cone(first, second.node)
    return stitch(first, second, workspace(session).colour)


@operator(
    "COTE",
    opt("number", "ENTIER"),
    arg("mesh", "MAILLAGE"),
    family="mesh",
    help=Help(
        en="Side of a surface kept from its making: 1 initial, 2 right, 3 final, 4 left; all of "
        "them without a number. They run round the surface in the sense of side 1.",
        fr="Côté d'une surface gardé de sa construction : 1 initial, 2 droit, 3 final, 4 gauche ; "
        "tous sans numéro. Ils tournent autour de la surface dans le sens du côté 1.",
        syntax="GEO1 = COTE (I1) GEO2 ;",
        examples=(
            "OPTI DIME 2 ELEM QUA4 ; L = DROI 4 (0. 0.) (1. 0.) ; S = L TRAN 3 (0. 1.) ;"
            " LIST (NBEL (COTE 2 S)) ;",
        ),
    ),
)
def cote(call: Call, number: int | None, mesh: Mesh) -> Any:
    """Give back sides."""
    return _reference(call, number, mesh, "side")


@operator(
    "FACE",
    opt("number", "ENTIER"),
    arg("mesh", "MAILLAGE"),
    family="mesh",
    help=Help(
        en="Face of a volume kept from its making: 1 start, 2 end, 3 around; all of them without a "
        "number.",
        fr="Face d'un volume gardée de sa construction : 1 initiale, 2 finale, 3 latérale ; toutes "
        "sans numéro.",
        syntax="GEO1 = FACE (N1) GEO2 ;",
        examples=(
            "OPTI DIME 3 ELEM CUB8 ; L = DROI 2 (0. 0. 0.) (1. 0. 0.) ; S = L TRAN 2 (0. 1. 0.) ;"
            " V = S VOLU 2 'TRAN' (0. 0. 1.) ; LIST (NBEL (FACE 3 V)) ;",
        ),
    ),
)
def face(call: Call, number: int | None, mesh: Mesh) -> Any:
    """Give back faces."""
    return _reference(call, number, mesh, "face")


def _reference(call: Call, number: int | None, mesh: Mesh, word: str) -> Any:
    if not mesh.sides:
        raise call.bad(f"this mesh keeps no {word}", mesh, hint="pick its cells with ELEM")
    if number is None:
        return mesh.sides if len(mesh.sides) > 1 else mesh.sides[0]
    if not 1 <= number <= len(mesh.sides):
        raise call.bad(f"{word} {number} is asked of a mesh that has {len(mesh.sides)}", number)
    return mesh.sides[number - 1]
