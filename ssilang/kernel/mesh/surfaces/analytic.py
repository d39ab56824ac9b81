"""Simple surfaces and lines given by points: distance to them and projection on them.

Surfaces `P(u, v) = sum P_ij u^i v^j` meshed over a rectangle of their parameters.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.curves import Polynomial, plane_normal, unit_vector
from ssilang.kernel.mesh.lines.lines import chain_mesh
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.mesh.surfaces.grid import grid_cells

# positions (m, 3) -> signed or unsigned distances (m,)
Level = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Shape:
    """A surface (or a line) known by a function that vanishes on it.

    Attributes
    ----------
    distance : function
        Distance of positions (m, 3); signed where a projection needs it.
    project_along : function
        (positions (m, 3), unit directions (m, 3)) -> positions on the shape, the nearest along
        the direction, NaN where the direction misses it.
    """

    distance: Level
    project_along: Callable[[FloatArray, FloatArray], FloatArray]


def line_shape(a: FloatArray, b: FloatArray) -> Shape:
    """The line through two points (3,); projections are for plane (2D) problems."""
    unit = unit_vector(b - a, "kernel.mesh.two-points-line-coincide")
    normal = np.array([-unit[1], unit[0], 0.0])

    def distance(x: FloatArray) -> FloatArray:
        arm = x - a
        return np.linalg.norm(arm - (arm @ unit)[:, None] * unit, axis=1)

    return Shape(distance, lambda x, d: _plane_hit(x, d, a, normal))


def plane_shape(a: FloatArray, b: FloatArray, c: FloatArray) -> Shape:
    """The plane through three points (3,)."""
    normal = plane_normal(a, b, c)
    return Shape(lambda x: (x - a) @ normal, lambda x, d: _plane_hit(x, d, a, normal))


def sphere_shape(centre: FloatArray, on: FloatArray) -> Shape:
    """The sphere (circle in 2D) of a centre through a point (3,)."""
    radius = float(np.linalg.norm(on - centre))

    def hit(x: FloatArray, d: FloatArray) -> FloatArray:
        arm = x - centre
        b = (arm * d).sum(axis=1)
        return _quadratic_hit(x, d, np.ones(len(x)), b, (arm * arm).sum(axis=1) - radius**2)

    return Shape(lambda x: np.linalg.norm(x - centre, axis=1) - radius, hit)


def cylinder_shape(a: FloatArray, b: FloatArray, on: FloatArray) -> Shape:
    """The cylinder of axis a-b through a point (3,)."""
    unit = unit_vector(b - a, "kernel.mesh.two-points-axis-coincide")
    radius = float(np.linalg.norm(_across((on - a)[None], unit)))

    def hit(x: FloatArray, d: FloatArray) -> FloatArray:
        arm, way = _across(x - a, unit), _across(d, unit)
        c = (arm * arm).sum(axis=1) - radius**2
        return _quadratic_hit(x, d, (way * way).sum(axis=1), (arm * way).sum(axis=1), c)

    return Shape(lambda x: np.linalg.norm(_across(x - a, unit), axis=1) - radius, hit)


def cone_shape(apex: FloatArray, axis_point: FloatArray, on: FloatArray) -> Shape:
    """The (double) cone of an apex and an axis through a point (3,)."""
    unit = unit_vector(axis_point - apex, "kernel.mesh.apex-axis-point-coincide")
    along = float((on - apex) @ unit)
    away = float(np.linalg.norm(_across((on - apex)[None], unit)))
    size = float(np.hypot(along, away))
    if abs(along) <= 1e-12 * size:
        raise MeshError("kernel.mesh.point-opens-cone-lies")
    cosine, sine = abs(along) / size, away / size
    tangent2 = (away / along) ** 2

    def distance(x: FloatArray) -> FloatArray:
        arm = x - apex
        radial = np.linalg.norm(_across(arm, unit), axis=1)
        return radial * cosine - np.abs(arm @ unit) * sine

    def hit(x: FloatArray, d: FloatArray) -> FloatArray:
        arm, way = x - apex, d
        r, w = _across(arm, unit), _across(way, unit)
        h, g = arm @ unit, way @ unit
        a = (w * w).sum(axis=1) - tangent2 * g * g
        b = (r * w).sum(axis=1) - tangent2 * h * g
        c = (r * r).sum(axis=1) - tangent2 * h * h
        return _quadratic_hit(x, d, a, b, c)

    return Shape(distance, hit)


def torus_shape(
    centre: FloatArray, axis_point: FloatArray, small_centre: FloatArray, on: FloatArray
) -> Shape:
    """The torus of a centre and an axis, with a small circle's centre, through a point (3,)."""
    unit = unit_vector(axis_point - centre, "kernel.mesh.two-points-torus-axis")
    large = float(np.linalg.norm(_across((small_centre - centre)[None], unit)))

    def to_ring(x: FloatArray) -> FloatArray:
        arm = x - centre
        return np.hypot(np.linalg.norm(_across(arm, unit), axis=1) - large, arm @ unit)

    small = float(to_ring(on[None])[0])

    def distance(x: FloatArray) -> FloatArray:
        return to_ring(x) - small

    return Shape(distance, lambda x, d: _march(x, d, distance))


def _across(vectors: FloatArray, unit: FloatArray) -> FloatArray:
    """Parts of vectors (m, 3) orthogonal to a unit vector."""
    return vectors - (vectors @ unit)[:, None] * unit


def _plane_hit(x: FloatArray, d: FloatArray, a: FloatArray, normal: FloatArray) -> FloatArray:
    slope = d @ normal
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(np.abs(slope) > 1e-12, ((a - x) @ normal) / slope, np.nan)
    return x + t[:, None] * d


def _quadratic_hit(
    x: FloatArray, d: FloatArray, a: FloatArray, b: FloatArray, c: FloatArray
) -> FloatArray:
    """x + t d with a t^2 + 2 b t + c = 0, the root nearest to zero; NaN when there is none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(b * b - a * c)
        far = -(b + np.copysign(root, b))
        one = far / a
        two = np.where(far == 0.0, 0.0, c / far)
    one = np.where(np.abs(a) < 1e-14, np.inf, one)
    t = np.where(np.abs(one) < np.abs(two), one, two)
    t = np.where(np.isfinite(t), t, np.nan)
    return x + t[:, None] * d


def _march(x: FloatArray, d: FloatArray, distance: Level) -> FloatArray:
    """First zero of a distance function along +-d: sphere tracing both ways, the nearer kept."""
    best = np.full(len(x), np.nan)
    inside = np.sign(distance(x))
    for sense in (1.0, -1.0):
        t = np.zeros(len(x))
        for _ in range(400):
            t += inside * distance(x + sense * t[:, None] * d)
        hit = np.abs(distance(x + sense * t[:, None] * d)) < 1e-9 * (1.0 + np.abs(t))
        closer = hit & ~(np.abs(t) >= np.abs(best))
        best = np.where(closer, sense * t, best)
    return x + best[:, None] * d


def project(
    shape: Shape, x: FloatArray, direction: FloatArray | None, apex: FloatArray | None
) -> FloatArray:
    """Positions (m, 3) projected on a shape along a direction, or from an apex (3,).

    Raises
    ------
    MeshError
        If the direction has no length, a point is the apex, or a ray misses the shape.
    """
    if direction is not None:
        rays = np.broadcast_to(
            unit_vector(direction, "kernel.mesh.direction-projection-zero"), x.shape
        )
    else:
        assert apex is not None
        arm = x - apex
        size = np.linalg.norm(arm, axis=1)
        if (size == 0.0).any():
            raise MeshError("kernel.mesh.point-project-apex-projection")
        rays = arm / size[:, None]
    image = shape.project_along(x, rays)
    lost = np.flatnonzero(np.isnan(image).any(axis=1))
    if len(lost):
        raise MeshError("kernel.mesh.point-no-projection-surface", n_lost=len(lost), x=x[lost[0]])
    return image


@dataclass(frozen=True, slots=True)
class PolynomialSurface:
    """A parametrised polynomial surface.

    Attributes
    ----------
    coefficients : array (n_rows, n_columns, 3)
        Row j, column i: the coefficient of `u**i v**j`.
    u, v : (float, float)
        Limits of the parameters.
    """

    coefficients: FloatArray
    u: tuple[float, float] = (0.0, 1.0)
    v: tuple[float, float] = (0.0, 1.0)

    def at(self, u: FloatArray, v: FloatArray) -> FloatArray:
        """Positions (..., 3) at parameters of the same shape."""
        rows, columns = self.coefficients.shape[:2]
        powers_u = u[..., None] ** np.arange(columns)
        powers_v = v[..., None] ** np.arange(rows)
        return np.einsum("...j,...i,jik->...k", powers_v, powers_u, self.coefficients)

    def along_u(self, v: float, regular: bool) -> Polynomial:
        """The curve of constant v."""
        table = np.tensordot(v ** np.arange(len(self.coefficients)), self.coefficients, 1)
        return Polynomial(table, *self.u, regular=regular)

    def along_v(self, u: float, regular: bool) -> Polynomial:
        """The curve of constant u."""
        powers = u ** np.arange(self.coefficients.shape[1])
        return Polynomial(
            np.einsum("i,jik->jk", powers, self.coefficients), *self.v, regular=regular
        )


def mesh_polynomial_surface(
    nodes: NodeTable,
    surface: PolynomialSurface,
    size: float,
    cell_type: str = "QUA4",
    regular: bool = False,
    colour: int = 0,
) -> Mesh:
    """A grid of QUA4, QUA8, TRI3 or TRI6 on a polynomial surface; its sides are kept.

    Parameters
    ----------
    size : float
        Wanted length of the cells along the sides, which says how many there are.
    regular : bool
        True: nodes evenly spaced in space along the sides; False: in the parameters.

    Raises
    ------
    MeshError
        If the size is not positive, or a side has no length.
    """
    if size <= 0.0:
        raise MeshError("kernel.mesh.mesh-size-not-set")
    quadratic = cell_type in ("QUA8", "TRI6")
    flat = [surface.along_u(v, regular) for v in surface.v]
    upright = [surface.along_v(u, regular) for u in surface.u]
    step = 2 if quadratic else 1
    across, up = (step * _cuts(pair, size) for pair in (flat, upright))
    s, t = np.meshgrid(np.linspace(0.0, 1.0, across + 1), np.linspace(0.0, 1.0, up + 1))
    u = _blended([c.parameter(s[0]) for c in flat], t)
    v = _blended([c.parameter(t[:, 0]) for c in upright], s.T).T
    wanted = np.ones(s.shape, bool)
    if cell_type == "QUA8":
        wanted[1::2, 1::2] = False
    ids = np.full(s.shape, -1, dtype=np.int64)
    ids[wanted] = nodes.add(surface.at(u[wanted], v[wanted]), size)
    sides = (ids[0], ids[:, -1], ids[-1, ::-1], ids[::-1, 0])
    lines = tuple(chain_mesh(nodes, side, quadratic, colour) for side in sides)
    cells = grid_cells(ids, step)
    if cell_type.startswith("TRI"):
        cells = _halved(cells, ids[1::2, 1::2].ravel() if quadratic else None)
    return Mesh.of(nodes, cell_type, cells, colour, lines)


def _halved(cells: IntArray, centres: IntArray | None) -> IntArray:
    """Two triangles a cell (n, 4) or (n, 8); of quadratic ones the centre is on the diagonal."""
    if centres is None:
        pair = cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]
    else:
        whole = np.column_stack([cells, centres])
        pair = whole[:, [0, 1, 2, 3, 4, 8]], whole[:, [0, 8, 4, 5, 6, 7]]
    return np.stack(pair, axis=1).reshape(-1, pair[0].shape[1])


def _cuts(pair: list[Polynomial], size: float) -> int:
    """Number of cells along two opposite sides: that of the longer one."""
    length = max(curve.length for curve in pair)
    if length == 0.0:
        raise MeshError("kernel.mesh.two-opposite-sides-surface")
    return subdivide(length, size, size).count


def _blended(ends: list[FloatArray], across: FloatArray) -> FloatArray:
    """Parameters (m, n) between those on two opposite sides (n,), `across` (m, n) the way."""
    return (1.0 - across) * ends[0] + across * ends[1]
