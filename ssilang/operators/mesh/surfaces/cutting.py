"""Cuts: COUP by a plane, FUIT of a contour by a segment, ISOV where a field takes a value."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.fields.isovalue import isovalue
from ssilang.kernel.mesh.changes.degree import linear
from ssilang.kernel.mesh.surfaces.contour_split import split_contour
from ssilang.operators.prelude import *


@operator(
    "COUP",
    arg("mesh", "MAILLAGE", en="mesh in space"),
    arg("p1", "POINT", en="point of the plane"),
    arg("p2", "POINT", en="second point of the plane"),
    arg("p3", "POINT", en="third point of the plane"),
    family="mesh",
    full_name="COUPER",
)
def coup(call: Call, mesh: Mesh, p1: Point, p2: Point, p3: Point) -> Mesh:
    """Section by a plane."""
    a, b, c = (p.coordinates for p in (p1, p2, p3))
    normal = np.cross(b - a, c - a)
    size = float(np.linalg.norm(normal))
    if size <= 1e-12 * max(float((b - a) @ (b - a)), float((c - a) @ (c - a))):
        raise call.error("operators.mesh.no-plane", p3)
    flat = linear(mesh)
    blocks = []
    for cells in flat.blocks:
        height = (cells.coordinates - a) @ (normal / size)
        blocks.append(CellFieldBlock(cells, {"SCAL": height}, "NOEUD"))
    return isovalue(CellField(tuple(blocks), ""), 0.0)


@operator(
    "FUIT",
    arg("contour", "MAILLAGE", en="closed contour of SEG2"),
    arg("first", "MAILLAGE", "POINT", en="where the segment may begin"),
    arg("second", "MAILLAGE", "POINT", en="where it may end"),
    family="mesh",
)
def fuit(contour: Mesh, first: Mesh | Point, second: Mesh | Point) -> tuple[Mesh, Mesh, Mesh]:
    """Cut a contour in two."""
    return split_contour(contour, _nodes(first), _nodes(second))


def _nodes(given: Mesh | Point) -> Mesh:
    if isinstance(given, Mesh):
        return given
    return Mesh.of(given.nodes, "POI1", np.array([[given.node]]))


_SIDES = {"EGAL": 0, "EGINFE": -1, "EGSUPE": 1}


@operator(
    "ISOV",
    arg("field", "MCHAML", en="field at nodes, one component"),
    choice(
        "side",
        tuple(_SIDES),
        default="EGAL",
        en="places of the value, the default, or of smaller or larger ones",
    ),
    arg("value", "FLOTTANT", en="value", range=ANY_NUMBER),
    family="mesh",
    full_name="ISOVALEUR",
)
def isov(field: CellField, side: str, value: float) -> Mesh:
    """Isovalue, or part on one side of it."""
    return isovalue(field, value, _SIDES[side])
