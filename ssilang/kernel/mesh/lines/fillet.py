"""Circular arcs that round the corner between two lines."""

from __future__ import annotations

import math

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.lines.curves import Arc
from ssilang.kernel.mesh.lines.lines import chain_mesh, line_chain, mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh


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
    one, two = line_chain(first), line_chain(second)
    x, y = nodes.coordinates[one].copy(), nodes.coordinates[two].copy()
    u, v = _unit(x[-1] - x[-2]), _unit(y[1] - y[0])
    corner, angle = _corner(x[-1], u, y[0], v)
    reach = radius * math.tan(angle / 2)
    start, end = corner - reach * u, corner + reach * v
    head = _trimmed(nodes.density, x, one, start, u)
    tail = _trimmed(nodes.density, y[::-1], two[::-1], end, -v)
    ids = nodes.add(np.array([start, end]), nodes.density[[one[-1], two[0]]])
    inwards = _unit(v - (v @ u) * u)
    arc = Arc(start + radius * inwards, -radius * inwards, radius * u, angle)
    sizes = float(nodes.density[one[-1]]), float(nodes.density[two[0]])
    parts = subdivide(arc.length, *sizes, count)
    middle = mesh_curve(nodes, arc, int(ids[0]), int(ids[1]), parts, quadratic, colour)
    before = _line(first, np.append(head, ids[0]), quadratic, colour)
    after = _line(first, np.append(tail, ids[1])[::-1], quadratic, colour)
    return before, middle, after


def _line(like: Mesh, corners: IntArray, quadratic: bool, colour: int) -> Mesh:
    """A line through corner nodes; middles are new when quadratic."""
    if not quadratic:
        return chain_mesh(like.nodes, corners, False, colour)
    xyz, size = like.nodes.coordinates, like.nodes.density
    pairs = np.column_stack([corners[:-1], corners[1:]])
    made = like.nodes.add(xyz[pairs].mean(axis=1), size[pairs].mean(axis=1))
    return Mesh.of(like.nodes, "SEG3", np.column_stack([pairs[:, 0], made, pairs[:, 1]]), colour)


def _unit(vector: FloatArray) -> FloatArray:
    unit: FloatArray = vector / np.linalg.norm(vector)
    return unit


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
    density: FloatArray, x: FloatArray, chain: IntArray, end: FloatArray, way: FloatArray
) -> IntArray:
    """Nodes of a chain that stand before `end` along the way, the last one not too near."""
    left = (end - x) @ way
    step = float(np.linalg.norm(x[-1] - x[-2]))
    if left[0] <= 0.0:
        raise MeshError("kernel.mesh.radius-too-large-lines")
    keep = left > 0.3 * step
    keep[0] = True
    return chain[keep]
