"""A contour cut in two by the shortest segment between two sets of its nodes."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.boundary import chained
from ssilang.kernel.mesh.mesh import Mesh


def split_contour(contour: Mesh, first: Mesh, second: Mesh) -> tuple[Mesh, Mesh, Mesh]:
    """The segment from `first` to `second`, the contour that holds it and the one that holds its
    inverse, both in the sense of the contour given.

    A line that is not closed (one that an axis of revolution closes) gives a line and a contour.

    Raises
    ------
    MeshError
        If the contour is no single line of SEG2, if one of the sets has no node on it, or the two
        nodes are neighbours on it.
    """
    nodes = contour.nodes
    ring = _in_order(contour)
    closed = ring[0] == ring[-1]
    chain = ring[:-1] if closed else ring
    a, b = _nearest(nodes.coordinates, _on(chain, first, "second"), _on(chain, second, "third"))
    i, j = int(np.flatnonzero(chain == a)[0]), int(np.flatnonzero(chain == b)[0])
    if abs(i - j) == 1 or (closed and abs(i - j) == len(chain) - 1):
        raise MeshError("kernel.mesh.nearest-nodes-neighbours-contour", a=a + 1, b=b + 1)
    if closed:
        chain = np.roll(chain, -i)
        j = (j - i) % len(chain)
        away, home = np.append(chain[: j + 1], a), np.append(chain[j:], [a, b])
        parts = (_line(home), _line(away))
    elif i < j:
        parts = (_line(np.concatenate([chain[: i + 1], chain[j:]])),
                 _line(np.append(chain[i : j + 1], a)))  # fmt: skip
    else:
        parts = (_line(np.append(chain[j : i + 1], b)),
                 _line(np.concatenate([chain[: j + 1], chain[i:]])))  # fmt: skip
    colour = contour.blocks[0].colours[0]
    made = [Mesh.of(nodes, "SEG2", cells, int(colour)) for cells in (np.array([[a, b]]), *parts)]
    return made[0], made[1], made[2]


def _line(chain: IntArray) -> IntArray:
    return np.column_stack([chain[:-1], chain[1:]])


def _in_order(contour: Mesh) -> IntArray:
    """Nodes along the line, the first again at the end of a closed one."""
    if any(b.cell_type != "SEG2" for b in contour.blocks) or not contour.n_cells:
        raise MeshError("kernel.mesh.contour-seg2-needed")
    cells = chained(contour).single_block().connectivity
    if not np.array_equal(cells[1:, 0], cells[:-1, 1]):
        raise MeshError("kernel.mesh.contour-not-line")
    return np.append(cells[:, 0], cells[-1, 1])


def _on(chain: IntArray, mesh: Mesh, which: str) -> IntArray:
    found = np.intersect1d(chain, mesh.sorted_node_ids)
    if not len(found):
        raise MeshError("kernel.mesh.mesh-no-node-contour", which=which)
    return found


def _nearest(x: np.ndarray, first: IntArray, second: IntArray) -> tuple[int, int]:
    """The two different nodes of smallest distance."""
    away = np.linalg.norm(x[first][:, None] - x[second][None], axis=2)
    away[first[:, None] == second[None]] = np.inf
    if not np.isfinite(away).any():
        raise MeshError("kernel.mesh.two-meshes-same-node")
    i, j = np.unravel_index(int(away.argmin()), away.shape)
    return int(first[i]), int(second[j])
