"""A straight line between two nodes."""

import numpy as np

from ssilang.kernel.mesh.lines.lines import end_sizes, mesh_curve
from ssilang.kernel.mesh.lines.subdivision import subdivide
from ssilang.kernel.mesh.mesh import Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def straight_line(
    nodes: NodeTable, start: int, end: int, count: int = 0,
    sizes: tuple[float, float] | None = None, quadratic: bool = False,
) -> Mesh:  # fmt: skip
    """Cut by `count`, and `sizes` at the ends (those of the nodes), as `subdivide` takes them."""
    a, b = nodes.coordinates[start].copy(), nodes.coordinates[end].copy()
    first, last = sizes or end_sizes(nodes, start, end)
    cuts = subdivide(float(np.linalg.norm(b - a)), first, last, count)
    return mesh_curve(nodes, lambda s: a + s[:, None] * (b - a), start, end, cuts, quadratic)


def line_between(nodes: NodeTable, a: object, b: object, n: int, quadratic: bool = False) -> Mesh:
    """A line of n cells between two new nodes."""
    ids = nodes.add(np.array([a, b], dtype=float))
    return straight_line(nodes, int(ids[0]), int(ids[1]), n, quadratic=quadratic)
