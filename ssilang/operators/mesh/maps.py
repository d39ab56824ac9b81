"""Geometric maps as operators read them: rotation, symmetry, scaling, affinity, projection."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.changes.transform import (
    PointMap,
    affinity,
    mirror_line,
    mirror_plane,
    mirror_point,
    scaling,
    turn,
)
from ssilang.kernel.mesh.surfaces.analytic import (
    Shape,
    cone_shape,
    cylinder_shape,
    line_shape,
    plane_shape,
    project,
    sphere_shape,
    torus_shape,
)
from ssilang.language.run.call import Call
from ssilang.operators.workspace import workspace

# word -> number of points, shape through them
SHAPES: dict[str, tuple[int, Callable[..., Shape]]] = {
    "DROIT": (2, line_shape),
    "PLAN": (3, plane_shape),
    "SPHERE": (2, sphere_shape),
    "CYLINDRE": (3, cylinder_shape),
    "CONE": (3, cone_shape),
    "CONI": (3, cone_shape),
    "TORE": (4, torus_shape),
    "TORI": (4, torus_shape),
    "CERC": (2, sphere_shape),
}
_MIRRORS: dict[str, tuple[int, Callable[..., PointMap]]] = {
    "POINT": (1, mirror_point),
    "DROIT": (2, mirror_line),
    "PLAN": (3, mirror_plane),
}


def read_points(call: Call, count: int, after: int = -1) -> list[FloatArray]:
    """Positions of the next points."""
    return [call.required("POINT", after=after).coordinates.copy() for _ in range(count)]


def read_turn(call: Call) -> tuple[PointMap, FloatArray]:
    """A rotation: angle in degrees, then its centre (2D) or axis (3D); and its matrix (3, 3)."""
    angle = call.required("FLOTTANT")
    origin, axis = read_axis(call)
    return turn(angle, origin, axis), rotation_matrix(angle, axis)


def rotation_matrix(angle: float, axis: FloatArray) -> FloatArray:
    """Matrix (3, 3) that turns vectors by an angle in degrees about an axis."""
    return turn(angle, np.zeros(3), axis)(np.eye(3)).T


def read_axis(call: Call) -> tuple[FloatArray, FloatArray]:
    """Origin and direction: a point and the normal of the plane (2D), or two points (3D)."""
    if workspace(call.session).dimension < 3:
        return read_points(call, 1)[0], np.array([0.0, 0.0, 1.0])
    origin, second = read_points(call, 2)
    return origin, second - origin


def read_symmetry(call: Call, word: str) -> PointMap:
    """The symmetry that a word names."""
    count, make = _MIRRORS[word]
    return make(*read_points(call, count, call.keyword_end))


def read_scaling(call: Call) -> PointMap:
    """A ratio and a centre."""
    ratio = call.required("FLOTTANT")
    return scaling(ratio, *read_points(call, 1))


def read_affinity(call: Call) -> PointMap:
    """A ratio and two points."""
    ratio = call.required("FLOTTANT")
    return affinity(ratio, *read_points(call, 2))


def read_shape(call: Call, words: tuple[str, ...]) -> tuple[str, Shape] | None:
    """A word that names a surface or a line, and its points; None if no such word stands next."""
    word = call.keyword(words)
    if word is None:
        return None
    count, make = SHAPES[word]
    return word, make(*read_points(call, count, call.keyword_end))


def read_projection(call: Call) -> PointMap:
    """('CYLI') vector or 'CONI' apex, then the surface (a line or a circle in 2D)."""
    words = sum(isinstance(o.value, str) for o in call.operands)
    way = call.keyword(("CYLI", "CONI")) if words > 1 else None
    first = read_points(call, 1, call.keyword_end if way else -1)[0]
    found = read_shape(call, tuple(SHAPES))
    if found is None:
        raise call.bad(
            "what is projected on is not said", hint="'PLAN', 'SPHE', 'CYLI', 'CONI', 'DROI' ..."
        )
    shape = found[1]
    if way == "CONI":
        return lambda x: project(shape, x, None, first)
    return lambda x: project(shape, x, first, None)
