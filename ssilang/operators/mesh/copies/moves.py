"""Nodes moved in place: DEPL, which gives back what it has moved."""

from ssilang.kernel.fields.deformed import displacements
from ssilang.kernel.mesh.changes import transform
from ssilang.kernel.mesh.generators.sweep import rotate
from ssilang.operators.mesh.copies.maps import *
from ssilang.operators.mesh.lines.ends import AXIS, axis_of
from ssilang.operators.prelude import *

_MIRRORS: Mapping[str, Callable[..., transform.PointMap]] = {
    "POINT": transform.mirror_point,
    "DROIT": transform.mirror_line,
    "PLAN": transform.mirror_plane,
}
_MOVED_MESH = arg("moved", "MAILLAGE", en="what is moved")
_MOVED = arg("moved", "MAILLAGE", "POINT", en="what is moved")


_Moved = Mesh | Point


def _move(moved: _Moved, image: transform.PointMap) -> _Moved:
    transform.move(moved.nodes, moved.node_ids, image)
    return moved


@operator("DEPL", said("PLUS", "MOINS"), family="mesh", full_name="DEPLACER")
def depl(
    word: str,
    moved: _Moved = _MOVED,
    by: Point | NodeField = Arg("POINT", "CHPOINT", en="vector, or displacements", unit="m"),
) -> _Moved:
    """Move nodes by a vector or by displacements."""
    sign = 1.0 if word == "PLUS" else -1.0
    if isinstance(by, Point):
        return _move(moved, transform.shift(sign * by.coordinates.copy()))
    ids = moved.sorted_node_ids
    moved.nodes.coordinates[ids] += sign * displacements(by, ids)
    return moved


@depl.form(said("TOUR"))
def turned(
    call: Call,
    moved: _Moved = _MOVED,
    angle: NodeField | float = Arg(
        "CHPOINT", "FLOTTANT", en="angle, or one for each node", unit="deg", range=ANY_NUMBER
    ),
    axis: Sequence[Point] = AXIS,
) -> _Moved:
    """Turn nodes."""
    origin, direction = axis_of(call, axis)
    if not isinstance(angle, NodeField):
        return _move(moved, transform.turn(angle, origin, direction))
    size = float(np.linalg.norm(direction))
    if size == 0.0:
        raise MeshError("operators.mesh.axis-without-length")
    ids = moved.sorted_node_ids
    degrees = angle.values_at(next(iter(angle.components)), ids)
    place = moved.nodes.coordinates
    for value in np.unique(degrees):
        rows = ids[degrees == value]
        place[rows] = rotate(place[rows].copy(), float(np.radians(value)), origin, direction / size)
    return moved


@depl.form(said("HOMO"))
def scaled(moved: _Moved = _MOVED, ratio: float = RATIO, fixed: Point = FIXED) -> _Moved:
    """Scale about a point."""
    return _move(moved, transform.scaling(ratio, fixed.coordinates.copy()))


@depl.form(said("AFFI"))
def stretched(
    moved: _Moved = _MOVED,
    ratio: float = RATIO,
    fixed: Point = FIXED,
    towards: Point = DIRECTION,
) -> _Moved:
    """Stretch along a direction."""
    return _move(moved, transform.affinity(ratio, *positions((fixed, towards))))


@depl.form(said("SYME"))
def mirrored(
    call: Call,
    about: str = Choice(tuple(MIRRORS), optional=False, en="what is mirrored about"),
    moved: _Moved = _MOVED,
    points: Sequence[Point] = Many("POINT", en="its points"),
) -> _Moved:
    """Mirror about a point, a line or a plane."""
    return _move(moved, _MIRRORS[about](*_exactly(call, points, len(MIRRORS[about]))))


def _exactly(call: Call, points: Sequence[Point], count: int) -> list[FloatArray]:
    """Positions of points, as many as are needed."""
    if len(points) < count:
        raise call.missing(("POINT",))
    if len(points) > count:
        raise call.error(
            "operators.mesh.points-in-excess", points[-1], count=count, n_points=len(points)
        )
    return positions(points)


@depl.form(said("PROJ"), _MOVED, *RAYS)
def projected(moved: _Moved, rays: tuple[str, Point], surface: Chosen) -> _Moved:
    """Project, as it is said how the rays go."""
    return _move(moved, projection_of(*rays, surface))


@depl.form(said("PROJ"), _MOVED, *VECTOR)
def projected_along(moved: _Moved, vector: Point, surface: Chosen) -> _Moved:
    """Project along a vector."""
    return _move(moved, projection_of("CYLI", vector, surface))


@depl.form(said("COOR"))
def changed_coordinates(
    call: Call,
    coordinates: str = Choice(
        ("CYLI", "CART"), optional=False, en="to cylindrical coordinates, or back"
    ),
    moved: _Moved = _MOVED,
    points: Sequence[Point] = Many(
        "POINT",
        en="origin (in space another point of the axis) and a point of angle 0, with 'CYLI'",
    ),
) -> _Moved:
    """Take cylindrical coordinates for cartesian ones, or the reverse."""
    if coordinates == "CART":
        _exactly(call, points, 0)
        return _move(moved, transform.from_cylindrical)
    if workspace(call.session).dimension < 3:
        origin, second = _exactly(call, points, 2)
        axis, zero = np.array([0.0, 0.0, 1.0]), second - origin
    else:
        origin, second, third = _exactly(call, points, 3)
        axis, zero = second - origin, third - origin
    return _move(moved, transform.to_cylindrical(origin, axis, zero))


@depl.form(said("MILI"))
def straightened(moved: _Moved = _MOVED) -> _Moved:
    """Put middle nodes onto the mediator planes of their edges."""
    if isinstance(moved, Mesh):
        transform.straighten_middles(moved)
    return moved


@depl.form(said("BARS"))
def quartered(
    moved: Mesh = _MOVED_MESH,
    tip: Mesh | Point = Arg("POINT", "MAILLAGE", en="tip or front of the crack"),
    at: float = Opt(
        "FLOTTANT",
        range=Range(0.0, 1.0, open_high=True),
        default=0.495,
        en="place of the middle node, 0 in the middle, 1 at the tip",
    ),
) -> _Moved:
    """Put middle nodes of cells at a crack near the quarter of their sides."""
    transform.quarter_middles(moved, tip.node_ids, at)
    return moved


@depl.form(said("DEDU"))
def deduced(
    call: Call,
    moved: _Moved = _MOVED,
    by: Mesh | NodeField | Point = Arg(
        "MAILLAGE", "CHPOINT", "POINT", en="points before, or displacements of some"
    ),
    goal: Mesh | Point | None = Opt("MAILLAGE", "POINT", en="points after"),
) -> _Moved:
    """Move by the affine map between two sets of points."""
    if isinstance(by, NodeField):
        ids = by.node_ids
        old = by.table.coordinates[ids].copy()
        new = old + displacements(by, ids)
    else:
        if goal is None:
            raise call.missing(("MAILLAGE", "POINT"))
        old, new = (m.nodes.coordinates[m.node_ids].copy() for m in (by, goal))
    return _move(moved, transform.affine_through(old, new, workspace(call.session).dimension))
