"""Flat maps of simple surfaces, in which meshes are made before they are put in space."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.curves import unit_vector
from ssilang.kernel.mesh.queries.select import plane_axes

Map = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Chart:
    """A surface seen flat.

    Attributes
    ----------
    flatten : function of array (m, 3) to array (m, 2)
    lift : function of array (m, 2) to array (m, 3)
    """

    flatten: Map
    lift: Map


def plane_chart(boundary: FloatArray, loops: FloatArray, tolerance: float = 1e-3) -> Chart:
    """The plane of a closed contour.

    Parameters
    ----------
    boundary : array (m, 3)
        Positions of its nodes.
    loops : array (n, 2, 3)
        Its directed segments; the contour turns anticlockwise in the chart.
    tolerance : float
        Allowed distance to the plane, relative to the contour's size.

    Raises
    ------
    MeshError
        If the contour has no area or is not plane.
    """
    origin = boundary.mean(axis=0)
    area = np.cross(loops[:, 0] - origin, loops[:, 1] - origin).sum(axis=0)
    size = float(np.linalg.norm(area))
    extent = float(np.ptp(boundary, axis=0).max())
    if size <= 1e-12 * extent**2:
        raise MeshError("kernel.mesh.contour-encloses-no-area")
    normal = area / size
    off = float(np.abs((boundary - origin) @ normal).max())
    if off > tolerance * extent:
        raise MeshError("kernel.mesh.contour-not-plane-point", off=off)
    first, second = plane_axes(normal)
    frame = np.column_stack([first, second])
    return Chart(lambda x: (x - origin) @ frame, lambda p: origin + p @ frame.T)


def _frame(
    boundary: FloatArray, origin: FloatArray, axis: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit axis and two radial unit vectors, the first towards the middle of the boundary."""
    up = unit_vector(axis, "kernel.mesh.points-surface-axis-coincide")
    arm = boundary - origin
    across = arm - (arm @ up)[:, None] * up
    radii = np.linalg.norm(across, axis=1)
    if (radii <= 1e-12 * max(1.0, float(np.abs(boundary).max()))).any():
        raise MeshError("kernel.mesh.contour-goes-through-axis")
    towards = (across / radii[:, None]).mean(axis=0)
    if float(np.linalg.norm(towards)) < 1e-6:
        raise MeshError("kernel.mesh.contour-goes-round-axis")
    first = towards / np.linalg.norm(towards)
    return up, first, np.cross(up, first)


def cylinder_chart(boundary: FloatArray, origin: FloatArray, end: FloatArray) -> Chart:
    """The cylinder of an axis through the contour; flat coordinates are arc length and height."""
    up, first, second = _frame(boundary, origin, end - origin)
    arm = boundary - origin
    radius = float(np.linalg.norm(arm - (arm @ up)[:, None] * up, axis=1).mean())

    def flatten(x: FloatArray) -> FloatArray:
        a = x - origin
        return np.column_stack([radius * np.arctan2(a @ second, a @ first), a @ up])

    def lift(p: FloatArray) -> FloatArray:
        angle = p[:, :1] / radius
        ring = np.cos(angle) * first + np.sin(angle) * second
        return origin + radius * ring + p[:, 1:] * up

    return Chart(flatten, lift)


def cone_chart(boundary: FloatArray, apex: FloatArray, axis_point: FloatArray) -> Chart:
    """The cone of an apex and an axis through the contour, developed."""
    up, first, second = _frame(boundary, apex, axis_point - apex)
    arm = boundary - apex
    height = arm @ up
    if (height <= 0).any() and (height >= 0).any():
        raise MeshError("kernel.mesh.contour-both-sides-apex")
    up = up if height[0] > 0 else -up
    second = np.cross(up, first)
    slant = np.linalg.norm(arm, axis=1)
    cosine = float(np.abs(height / slant).mean())
    sine = float(np.sqrt(1.0 - cosine**2))

    def flatten(x: FloatArray) -> FloatArray:
        a = x - apex
        far = np.linalg.norm(a, axis=1)
        angle = sine * np.arctan2(a @ second, a @ first)
        return np.column_stack([far * np.sin(angle), far * np.cos(angle)])

    def lift(p: FloatArray) -> FloatArray:
        far = np.hypot(p[:, 0], p[:, 1])[:, None]
        angle = np.arctan2(p[:, :1], p[:, 1:]) / sine
        ring = np.cos(angle) * first + np.sin(angle) * second
        return apex + far * (cosine * up + sine * ring)

    return Chart(flatten, lift)


def sphere_chart(boundary: FloatArray, centre: FloatArray) -> Chart:
    """The sphere of a centre through the contour, by stereographic projection."""
    arm = boundary - centre
    radii = np.linalg.norm(arm, axis=1)
    radius = float(radii.mean())
    towards = (arm / radii[:, None]).mean(axis=0)
    if float(np.linalg.norm(towards)) < 1e-6:
        raise MeshError("kernel.mesh.contour-goes-right-round")
    up = towards / np.linalg.norm(towards)
    first, second = plane_axes(up)

    def flatten(x: FloatArray) -> FloatArray:
        a = (x - centre) / np.linalg.norm(x - centre, axis=1)[:, None]
        scale = 2.0 * radius / (1.0 + a @ up)
        return np.column_stack([scale * (a @ first), scale * (a @ second)])

    def lift(p: FloatArray) -> FloatArray:
        q = p / (2.0 * radius)
        square = (q * q).sum(axis=1)[:, None]
        flat = 2.0 * (q[:, :1] * first + q[:, 1:] * second)
        return centre + radius * (flat + (1.0 - square) * up) / (1.0 + square)

    return Chart(flatten, lift)


def torus_chart(
    boundary: FloatArray, centre: FloatArray, axis_point: FloatArray, small_centre: FloatArray
) -> Chart:
    """The torus of a centre, an axis and a small circle's centre, through the contour."""
    up, first, second = _frame(boundary, centre, axis_point - centre)
    reach = small_centre - centre
    large = float(np.linalg.norm(reach - (reach @ up) * up))

    def ring(x: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        a = x - centre
        out, high = np.hypot(a @ first, a @ second) - large, a @ up
        return np.arctan2(a @ second, a @ first), np.arctan2(high, out), np.hypot(out, high)

    _, around, small = ring(boundary)
    radius = float(small.mean())
    middle = float(np.arctan2(np.sin(around).mean(), np.cos(around).mean()))

    def flatten(x: FloatArray) -> FloatArray:
        turn, tilt, _ = ring(x)
        tilt = (tilt - middle + np.pi) % (2 * np.pi) - np.pi
        return np.column_stack([large * turn, radius * tilt])

    def lift(p: FloatArray) -> FloatArray:
        turn, tilt = p[:, :1] / large, p[:, 1:] / radius + middle
        out = np.cos(turn) * first + np.sin(turn) * second
        return centre + (large + radius * np.cos(tilt)) * out + radius * np.sin(tilt) * up

    return Chart(flatten, lift)
