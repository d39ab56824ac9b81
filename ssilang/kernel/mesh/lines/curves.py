"""Shapes of curves: circular arcs, parabolas, polynomial curves, cubics.

Circular arcs that round the corner between two lines.
"""

import math
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.lines import chain_mesh, line_chain, mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable

_IN_LINE = "kernel.mesh.three-points-plane-line"
_GAUSS_X, _GAUSS_W = np.polynomial.legendre.leggauss(16)


def unit_vector(vector: FloatArray, code: str) -> FloatArray:
    """A vector (3,) of length 1; an error of this code where it has none."""
    size = float(np.linalg.norm(vector))
    if size == 0.0:
        raise MeshError(code)
    return vector / size


def plane_normal(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Unit normal of the plane through three points (3,); an error where they are in line."""
    normal = np.cross(unit_vector(b - a, _IN_LINE), unit_vector(c - a, _IN_LINE))
    return unit_vector(normal * (np.linalg.norm(normal) > 1e-12), _IN_LINE)


@dataclass(frozen=True, slots=True)
class Arc:
    """A circular arc.

    Attributes
    ----------
    centre, first, second : array (3,)
        Centre, radius vector of the start, and the vector of the same length a quarter turn on.
    angle : float
        Opening in radians.
    """

    centre: FloatArray
    first: FloatArray
    second: FloatArray
    angle: float

    @property
    def length(self) -> float:
        """Length of the arc."""
        return abs(self.angle) * float(np.linalg.norm(self.first))

    def __call__(self, s: FloatArray) -> FloatArray:
        turn = self.angle * s[:, None]
        return self.centre + np.cos(turn) * self.first + np.sin(turn) * self.second


def arc_about_centre(start: FloatArray, centre: FloatArray, end: FloatArray) -> Arc:
    """The shorter arc from `start` to `end` around `centre` (3,), which is moved onto the
    mediator of the two points when it is off.

    Raises
    ------
    MeshError
        If one radius is twice the other or more, or the three points are in line.
    """
    chord = unit_vector(end - start, "kernel.mesh.two-ends-arc-coincide")
    middle = centre + ((start + end) / 2 - centre) @ chord * chord
    r1, r2 = np.linalg.norm(start - centre), np.linalg.norm(end - centre)
    first, last = start - middle, end - middle
    if not 0.5 < r1 / max(float(r2), 1e-300) < 2.0:
        raise MeshError("kernel.mesh.ends-not-same-distance", r1=r1, r2=r2)
    normal = np.cross(first, last)
    sine = float(np.linalg.norm(normal))
    if sine <= 1e-10 * float(first @ first):
        raise MeshError("kernel.mesh.centre-two-ends-line")
    angle = math.atan2(sine, float(first @ last))
    return Arc(middle, first, np.cross(normal / sine, first), angle)


def arc_through(start: FloatArray, between: FloatArray, end: FloatArray) -> Arc:
    """The arc from `start` through `between` to `end` (3,).

    Raises
    ------
    MeshError
        If the points are in line.
    """
    a, b = between - start, end - start
    normal = np.cross(a, end - between)
    square = float(normal @ normal)
    if square <= 1e-20 * float(a @ a) * float(b @ b):
        raise MeshError("kernel.mesh.three-points-line-no")
    centre = start + np.cross(a @ a * b - b @ b * a, np.cross(a, b)) / (2.0 * square)
    axis = normal / math.sqrt(square)
    first, last = start - centre, end - centre
    angle = math.atan2(float(np.cross(first, last) @ axis), float(first @ last))
    return Arc(centre, first, np.cross(axis, first), angle if angle > 0 else angle + 2 * math.pi)


def arc_about_axis(start: FloatArray, origin: FloatArray, axis: FloatArray, angle: float) -> Arc:
    """The arc that `start` describes in a rotation by `angle` (radians) about an axis.

    Raises
    ------
    MeshError
        If the axis has no length or goes through the point.
    """
    unit = unit_vector(axis, "kernel.mesh.two-points-axis-coincide")
    centre = origin + (start - origin) @ unit * unit
    first = start - centre
    if float(np.linalg.norm(first)) <= 1e-12 * float(np.abs([start, origin]).max()):
        raise MeshError("kernel.mesh.point-turn-lies-axis")
    return Arc(centre, first, np.cross(unit, first), angle)


@dataclass(frozen=True, slots=True)
class Polynomial:
    """A polynomial curve `P(u) = sum c_i u^i`, u from `begin` to `finish`.

    Attributes
    ----------
    coefficients : array (n, 3)
    regular : bool
        True: fractions are of the length; False: of the parameter.
    """

    coefficients: FloatArray
    begin: float = 0.0
    finish: float = 1.0
    regular: bool = False

    def at(self, u: FloatArray) -> FloatArray:
        """Positions (m, 3) at parameters (m,)."""
        powers = u[:, None] ** np.arange(len(self.coefficients))
        return powers @ self.coefficients

    @property
    def length(self) -> float:
        """Length of the curve."""
        return float(self._lengths(np.linspace(self.begin, self.finish, 65))[-1])

    def __call__(self, s: FloatArray) -> FloatArray:
        return self.at(self.parameter(s))

    def parameter(self, s: FloatArray) -> FloatArray:
        """Parameters at fractions (m,) of the way."""
        if not self.regular:
            return self.begin + (self.finish - self.begin) * s
        # a table of lengths, then Newton on each
        grid = np.linspace(self.begin, self.finish, 257)
        along = self._lengths(grid)
        target = s * along[-1]
        u: FloatArray = np.interp(target, along, grid)
        sign = 1.0 if self.finish >= self.begin else -1.0
        for _ in range(8):
            cell = np.clip(np.searchsorted(along, target, side="right") - 1, 0, len(grid) - 2)
            base = grid[cell]
            half = 0.5 * (u - base)
            inner = base[:, None] + half[:, None] * (1.0 + _GAUSS_X)
            reached = along[cell] + sign * half * (self._speed(inner) @ _GAUSS_W)
            u += sign * (target - reached) / np.maximum(self._speed(u), 1e-300)
        return u

    def _speed(self, u: FloatArray) -> FloatArray:
        order = np.arange(1, len(self.coefficients))
        slope = (u[..., None] ** (order - 1)) @ (order[:, None] * self.coefficients[1:])
        return np.linalg.norm(slope, axis=-1)

    def _lengths(self, u: FloatArray) -> FloatArray:
        """Length from the first to each of the parameters (m,), by Gauss in each interval."""
        half = 0.5 * np.diff(u)
        inner = u[:-1, None] + half[:, None] * (1.0 + _GAUSS_X)
        pieces = np.abs(half) * (self._speed(inner) @ _GAUSS_W)
        return np.concatenate([[0.0], np.cumsum(pieces)])


def parabola(
    start: FloatArray, corner: FloatArray, end: FloatArray, regular: bool = True
) -> Polynomial:
    """The parabola from `start` to `end` whose end tangents meet at `corner` (3,)."""
    return Polynomial(
        np.array([start, 2.0 * (corner - start), start - 2.0 * corner + end]), regular=regular
    )


def cubic_through(
    start: FloatArray, second: FloatArray, third: FloatArray, end: FloatArray, regular: bool
) -> Polynomial:
    """The cubic through four points at parameters 0, 1/3, 2/3, 1."""
    u = np.array([0.0, 1 / 3, 2 / 3, 1.0])
    points = np.array([start, second, third, end])
    return Polynomial(
        np.asarray(np.linalg.solve(u[:, None] ** np.arange(4), points), float), regular=regular
    )


def cubic_tangents(
    start: FloatArray, tangent: FloatArray, last_tangent: FloatArray, end: FloatArray
) -> Polynomial:
    """The cubic with given ends and end derivatives (Hermite)."""
    gap = end - start
    return Polynomial(
        np.array(
            [
                start,
                tangent,
                3 * gap - 2 * tangent - last_tangent,
                -2 * gap + tangent + last_tangent,
            ]
        )
    )


def parabolic_middles(arc: Arc, fractions: FloatArray) -> FloatArray:
    """Middles (n, 3) of parabolas that touch an arc at their ends, tangentially.

    Parameters
    ----------
    fractions : array (n + 1,)
        Ends of the parabolas, as parts of the arc.

    Raises
    ------
    MeshError
        If one of them opens by a half turn or more: its end tangents do not meet.
    """
    half = 0.5 * arc.angle * np.diff(fractions)
    if (np.abs(half) >= 0.5 * math.pi).any():
        raise MeshError("kernel.mesh.parabola-covers-half-turn")
    centred = arc(0.5 * (fractions[:-1] + fractions[1:])) - arc.centre
    reach = 0.5 * (np.cos(half) + 1.0 / np.cos(half))
    return arc.centre + reach[:, None] * centred


def fillet(
    first: Mesh, second: Mesh, radius: float, count: int = 0, colour: int = 0
) -> tuple[Mesh, Mesh, Mesh]:
    """The first line cut short, the arc, the second line cut short.

    The lines are continued straight from the end of the first and the start of the second; the
    arc is tangent to both.

    Raises
    ------
    MeshError
        If they are parallel or do not meet, or the arc would start before the first line (or
        end behind the second).
    """
    nodes = first.nodes
    quadratic = first.single_block().cell_type == "SEG3"
    degree = 1 + quadratic
    one, two = line_chain(first), line_chain(second)
    x, y = nodes.coordinates[one].copy(), nodes.coordinates[two].copy()
    u, v = _unit(x[-1] - x[-2]), _unit(y[1] - y[0])
    corner, angle = _corner(x[-1], u, y[0], v)
    reach = radius * math.tan(angle / 2)
    start, end = corner - reach * u, corner + reach * v
    head = _trimmed(x, one, start, u, degree)
    tail = _trimmed(y[::-1], two[::-1], end, -v, degree)
    ids = nodes.add(np.array([start, end]), nodes.density[[one[-1], two[0]]])
    inwards = _unit(v - (v @ u) * u)
    arc = Arc(start + radius * inwards, -radius * inwards, radius * u, angle)
    sizes = float(nodes.density[one[-1]]), float(nodes.density[two[0]])
    parts = subdivide(arc.length, *sizes, count)
    middle = mesh_curve(nodes, arc, int(ids[0]), int(ids[1]), parts, quadratic, colour)
    chains = _ended(nodes, head, ids[0], degree), _ended(nodes, tail, ids[1], degree)[::-1]
    before, after = (chain_mesh(nodes, chain, quadratic, colour) for chain in chains)
    return before, middle, after


def _ended(nodes: NodeTable, chain: IntArray, end: int, degree: int) -> IntArray:
    """A chain that goes on straight to a node; the middle of its last element is new."""
    pair = np.array([chain[-1], end])
    made = nodes.add_between(pair[None]) if degree == 2 else pair[:0]
    return np.concatenate([chain, made, pair[1:]])


def _unit(vector: FloatArray) -> FloatArray:
    return vector / np.linalg.norm(vector)


def _corner(a: FloatArray, u: FloatArray, b: FloatArray, v: FloatArray) -> tuple[FloatArray, float]:
    """Where the line from a along u meets the line through b along v, and the angle it turns."""
    normal = np.cross(u, v)
    sine = float(np.linalg.norm(normal))
    if sine < 1e-9:
        raise MeshError("kernel.mesh.two-lines-parallel-no")
    gap = b - a
    along = float(np.cross(gap, v) @ normal) / sine**2
    meeting: FloatArray = a + along * u
    off = abs(float(gap @ normal)) / sine
    if off > 1e-6 * (1.0 + float(np.linalg.norm(gap))):
        raise MeshError("kernel.mesh.two-lines-not-meet", off=off)
    return meeting, math.atan2(sine, float(u @ v))


def _trimmed(
    x: FloatArray, chain: IntArray, end: FloatArray, way: FloatArray, degree: int
) -> IntArray:
    """Nodes of a chain up to the last corner before `end` along the way that is not too near."""
    left = ((end - x) @ way)[::degree]
    step = float(np.linalg.norm(x[-1] - x[-1 - degree]))
    if left[0] <= 0.0:
        raise MeshError("kernel.mesh.radius-too-large-lines")
    last = int(np.flatnonzero(left > 0.3 * step).max(initial=0))
    return chain[: degree * last + 1]
