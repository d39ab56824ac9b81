"""Nodes moved in place: DEPL."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.mesh.changes.transform import (
    PointMap,
    affine_through,
    from_cylindrical,
    move,
    shift,
    straighten_middles,
    to_cylindrical,
)
from ssilang.kernel.mesh.generators.sweep import rotate
from ssilang.kernel.mesh.mesh import Mesh, Point
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.language.registry import Help, operator
from ssilang.language.run.call import Call
from ssilang.operators.mesh.maps import (
    read_affinity,
    read_axis,
    read_points,
    read_projection,
    read_scaling,
    read_symmetry,
    read_turn,
)
from ssilang.operators.workspace import workspace

Move = Callable[[Call, Mesh | Point], None]


def _ids(moved: Mesh | Point) -> IntArray:
    return np.array([moved.node]) if isinstance(moved, Point) else moved.node_ids


def _by_map(read: Callable[[Call], PointMap]) -> Move:
    def run(call: Call, moved: Mesh | Point) -> None:
        move(moved.nodes, _ids(moved), read(call))

    return run


def displacements(field: NodeField, ids: IntArray) -> FloatArray:
    """Displacements (n, 3) of nodes (n,) from components UX UY UZ or UR UZ, zero where absent."""
    names = ("UR", "UZ") if "UR" in field.components else ("UX", "UY", "UZ")
    step = np.zeros((len(ids), 3))
    for k, name in enumerate(names):
        step[:, k] = field.values_at(name, ids)
    return step


def _translate(sign: float) -> Move:
    def run(call: Call, moved: Mesh | Point) -> None:
        by = call.required("POINT", "CHPOINT", after=call.keyword_end)
        if isinstance(by, Point):
            move(moved.nodes, _ids(moved), shift(sign * by.coordinates.copy()))
            return
        ids = np.unique(_ids(moved))
        moved.nodes.coordinates[ids] += sign * displacements(by, ids)

    return run


def _turn(call: Call, moved: Mesh | Point) -> None:
    angles: NodeField | None = call.optional("CHPOINT")
    if angles is None:
        image, _ = read_turn(call)
        move(moved.nodes, _ids(moved), image)
        return
    origin, axis = read_axis(call)
    size = float(np.linalg.norm(axis))
    if size == 0.0:
        raise MeshError("the two points of the axis of rotation coincide")
    ids = np.unique(_ids(moved))
    degrees = angles.values_at(next(iter(angles.components)), ids)
    place = moved.nodes.coordinates
    for angle in np.unique(degrees):
        rows = ids[degrees == angle]
        place[rows] = rotate(place[rows].copy(), float(np.radians(angle)), origin, axis / size)


def _mirror(call: Call, moved: Mesh | Point) -> None:
    word = call.keyword(("POINT", "DROIT", "PLAN"))
    if word is None:
        raise call.bad("what is mirrored about is not said", hint="'POIN', 'DROIT' or 'PLAN'")
    move(moved.nodes, _ids(moved), read_symmetry(call, word))


def _coordinates(call: Call, moved: Mesh | Point) -> None:
    word = call.keyword(("CYLI", "CART"))
    if word is None:
        raise call.bad("the coordinates are not said", hint="'CYLI' or 'CART'")
    if word == "CART":
        move(moved.nodes, _ids(moved), from_cylindrical)
        return
    if workspace(call.session).dimension < 3:
        origin, second = read_points(call, 2)
        axis, zero = np.array([0.0, 0.0, 1.0]), second - origin
    else:
        origin, second, third = read_points(call, 3)
        axis, zero = second - origin, third - origin
    move(moved.nodes, _ids(moved), to_cylindrical(origin, axis, zero))


def _middles(call: Call, moved: Mesh | Point) -> None:
    if isinstance(moved, Mesh):
        straighten_middles(moved)


def _deduce(call: Call, moved: Mesh | Point) -> None:
    by = call.required("MAILLAGE", "CHPOINT", "POINT", after=call.keyword_end)
    if isinstance(by, NodeField):
        ids = by.node_ids
        old = by.table.coordinates[ids].copy()
        new = old + displacements(by, ids)
    else:
        goal = call.required("MAILLAGE", "POINT")
        old, new = (_positions(m.nodes, _ids(m)) for m in (by, goal))
    image = affine_through(old, new, workspace(call.session).dimension)
    move(moved.nodes, _ids(moved), image)


def _positions(nodes: NodeTable, ids: IntArray) -> FloatArray:
    return nodes.coordinates[ids].copy()


_MOVES: dict[str, Move] = {
    "PLUS": _translate(1.0),
    "MOINS": _translate(-1.0),
    "TOUR": _turn,
    "HOMO": _by_map(read_scaling),
    "AFFI": _by_map(read_affinity),
    "SYME": _mirror,
    "PROJ": _by_map(read_projection),
    "COOR": _coordinates,
    "MILI": _middles,
    "DEDU": _deduce,
}


@operator(
    "DEPL",
    family="mesh",
    full_name="DEPLACER",
    help=Help(
        en="Moves the nodes of a mesh or a point in place: all objects that hold them follow. "
        "'PLUS' and 'MOIN' a vector or a field of displacements; 'TOUR' an angle (or a field of "
        "angles) in degrees about a point or an axis; 'HOMO', 'AFFI', 'SYME', 'PROJ' as the "
        "operators of those names; 'COOR' to cylindrical coordinates and back; 'MILI' middle nodes "
        "onto the mediator planes of their edges; 'DEDU' the affine map between two sets of "
        "points.",
        fr="Déplace sur place les noeuds d'un maillage ou un point : tous les objets qui les "
        "portent suivent. 'PLUS' et 'MOIN' un vecteur ou un champ de déplacements ; 'TOUR' un "
        "angle (ou un champ d'angles) en degrés autour d'un point ou d'un axe ; 'HOMO', 'AFFI', "
        "'SYME', 'PROJ' comme les opérateurs de ces noms ; 'COOR' en coordonnées cylindriques et "
        "retour ; 'MILI' noeuds milieux sur les plans médiateurs ; 'DEDU' l'application affine "
        "entre deux ensembles de points.",
        syntax="DEPL GEO1 'PLUS'|'MOIN' VEC1|CHPO1 ;\n"
        "DEPL GEO1 'TOUR' ANGL1|CHPO1 POIN1 (POIN2) ;\n"
        "DEPL GEO1 'HOMO' RAPP1 POIN1 ; DEPL GEO1 'AFFI' RAPP1 POIN1 POIN2 ;\n"
        "DEPL GEO1 'SYME' 'POIN' P1 | 'DROIT' P1 P2 | 'PLAN' P1 P2 P3 ;\n"
        "DEPL GEO1 'PROJ' ('CYLI') VEC1 | 'CONI' SOMM1 'PLAN' P1 P2 P3 ... ;\n"
        "DEPL GEO1 'COOR' 'CYLI' P1 P2 (P3) | 'CART' ; DEPL GEO1 'MILI' ;\n"
        "DEPL GEO1 'DEDU' GEO2 GEO3 | CHP1 ;",
        examples=("OPTI DIME 2 ; P = 1. 0. ; DEPL P 'PLUS' (0. 2.) ; LIST (COOR 2 P) ;",),
    ),
    reads_itself=True,
)
def depl(call: Call) -> None:
    """Move nodes."""
    # points behind the keyword belong to the motion, the object comes before it
    moved = call.optional("MAILLAGE", "POINT")
    word = call.keyword(tuple(_MOVES))
    if word is None:
        raise call.bad("the motion is not said", hint=" ".join(_MOVES))
    if moved is None:
        moved = call.required("MAILLAGE", "POINT", after=call.keyword_end)
    _MOVES[word](call, moved)
