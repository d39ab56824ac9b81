"""Geometric maps as operators read them: rotation, symmetry, scaling, affinity, projection."""

from ssilang.kernel.mesh.changes.transform import PointMap, turn
from ssilang.kernel.mesh.surfaces import analytic
from ssilang.operators.prelude import *

__all__ = [
    "ANGLE", "DIRECTION", "FIXED", "MIRRORS", "RATIO", "RAYS", "SHAPES", "VECTOR", "positions",
    "projection_of", "projection_on", "rotation_matrix", "shape_of",
]  # fmt: skip

RATIO = arg("ratio", "FLOTTANT", en="ratio", usual=NOT_ZERO)
FIXED = arg("fixed", "POINT", en="point that stays")
DIRECTION = arg("towards", "POINT", en="other point of the direction")
ANGLE = arg("angle", "FLOTTANT", en="angle", unit="deg", range=ANY_NUMBER)

_POINT = arg("point", "POINT", en="point there")
_SECOND = arg("second", "POINT", en="second point")
_THIRD = arg("third", "POINT", en="third point")
_CENTRE = arg("centre", "POINT", en="centre")
_AXIS = arg("axis", "POINT", en="point of the axis")
_OTHER = arg("other", "POINT", en="other point of the axis")
_APEX = arg("apex", "POINT", en="apex")
_SMALL = arg("small", "POINT", en="centre of a small circle")

_SHAPES: Mapping[str, tuple[Callable[..., analytic.Shape], tuple[Argument, ...]]] = {
    "DROIT": (analytic.line_shape, (_POINT, _SECOND)),
    "PLAN": (analytic.plane_shape, (_POINT, _SECOND, _THIRD)),
    "SPHERE": (analytic.sphere_shape, (_CENTRE, _POINT)),
    "CYLINDRE": (analytic.cylinder_shape, (_AXIS, _OTHER, _POINT)),
    "CONE": (analytic.cone_shape, (_APEX, _AXIS, _POINT)),
    "CONI": (analytic.cone_shape, (_APEX, _AXIS, _POINT)),
    "TORE": (analytic.torus_shape, (_CENTRE, _AXIS, _SMALL, _POINT)),
    "TORI": (analytic.torus_shape, (_CENTRE, _AXIS, _SMALL, _POINT)),
    "CERC": (analytic.sphere_shape, (_CENTRE, _POINT)),
}
SHAPES = {word: points for word, (_, points) in _SHAPES.items()}
"""Lines and surfaces by word, with the points behind it."""

MIRRORS: Mapping[str, tuple[Argument, ...]] = {
    "POINT": (_CENTRE,),
    "DROIT": SHAPES["DROIT"],
    "PLAN": SHAPES["PLAN"],
}
"""What is mirrored about by word, with the points behind it."""

_SURFACE = group(
    "surface",
    select("shape", SHAPES, optional=False, en="line or surface on which it goes"),
)
RAYS = (
    group(
        "rays",
        key("way", ("CYLI", "CONI"), "POINT", optional=False, en="along a vector, or from a point"),
    ),
    _SURFACE,
)
"""A projection that says how its rays go."""

VECTOR = (arg("vector", "POINT", en="direction", usual=NOT_ZERO), _SURFACE)
"""A projection along a vector."""


def positions(points: Sequence[Point]) -> list[FloatArray]:
    """Copies of the positions of points."""
    return [p.coordinates.copy() for p in points]


def shape_of(chosen: Chosen) -> analytic.Shape:
    """The line or the surface of `SHAPES` that was read."""
    return _SHAPES[chosen.word][0](*positions(list(chosen.values.values())))


def projection_of(way: str, point: Point, surface: Chosen) -> PointMap:
    """The projection along a vector ('CYLI') or from a point ('CONI')."""
    return projection_on(way, point, shape_of(surface))


def projection_on(way: str, point: Point, shape: analytic.Shape) -> PointMap:
    """The projection along a vector ('CYLI') or from a point ('CONI') on a shape."""
    at = point.coordinates.copy()
    if way == "CONI":
        return lambda x: analytic.project(shape, x, None, at)
    return lambda x: analytic.project(shape, x, at, None)


def rotation_matrix(angle: float, axis: FloatArray) -> FloatArray:
    """Matrix (3, 3) that turns vectors by an angle in degrees about an axis."""
    return turn(angle, np.zeros(3), axis)(np.eye(3)).T
