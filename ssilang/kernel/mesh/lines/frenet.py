"""Tangents, normals and binormals along lines."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.mesh.mesh import Mesh

_STRAIGHT = 1e-9  # bends (in radians) below which a line counts as straight


def frenet_frames(line: Mesh) -> tuple[IntArray, FloatArray]:
    """Nodes (n,) of one or several lines and their frames (n, 3, 3): rows t, n, b.

    At inner nodes the tangent and the normal are those of the circle through a node and its two
    neighbours; at a free end the tangent is that of the circle through the last three nodes.
    Where a line is straight the binormal is as near as can be to the z axis.

    Raises
    ------
    MeshError
        If cells are no lines, or a node has more than one cell before or after it.
    """
    before, after = _neighbours(line)
    ids = np.flatnonzero((before >= 0) | (after >= 0))
    xyz = line.nodes.coordinates
    both = (before[ids] >= 0) & (after[ids] >= 0)
    frames = np.zeros((len(ids), 3, 3))
    u, v = xyz[ids] - xyz[before[ids]], xyz[after[ids]] - xyz[ids]
    tangent, bend = _circle(u[both], v[both])
    frames[both, 0], frames[both, 1] = tangent, bend
    _ends(frames, ids, before, after, xyz, ~both)
    return ids, _completed(frames)


def _neighbours(line: Mesh) -> tuple[IntArray, IntArray]:
    """Node before and node after each node of the table, -1 where there is none."""
    if not line.n_cells:
        raise MeshError("kernel.mesh.mesh-empty-no-line")
    pairs = []
    for block in line.blocks:
        if block.cell_type not in ("SEG2", "SEG3"):
            raise MeshError("kernel.mesh.line-needed-mesh-holds", cell_type=block.cell_type)
        table = block.connectivity
        pairs += [table[:, k : k + 2] for k in range(table.shape[1] - 1)]
    table = np.concatenate(pairs)
    for column, ending in ((0, False), (1, True)):
        ids, times = np.unique(table[:, column], return_counts=True)
        if (times > 1).any():
            node = line.nodes.told(ids[times > 1][0])
            raise MeshError("kernel.mesh.several-cells-node-line", ending=ending, node=node)
    before = np.full(len(line.nodes), -1, dtype=np.int64)
    after = before.copy()
    after[table[:, 0]], before[table[:, 1]] = table[:, 1], table[:, 0]
    return before, after


def _circle(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit tangents and bends at the middle of two chords (m, 3) each."""
    h, k = (np.linalg.norm(x, axis=1, keepdims=True) for x in (u, v))
    tangent = u / h**2 + v / k**2
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    return tangent, v / k - u / h


def _ends(
    frames: FloatArray,
    ids: IntArray,
    before: IntArray,
    after: IntArray,
    xyz: FloatArray,
    free: np.ndarray,
) -> None:
    """Fill the frames of free ends: tangents mirrored in the chord, the neighbour's bend."""
    for row in np.flatnonzero(free).tolist():
        node = ids[row]
        first = before[node] < 0
        other = after[node] if first else before[node]
        chord = (xyz[other] - xyz[node]) * (1.0 if first else -1.0)
        chord /= np.linalg.norm(chord)
        near = frames[np.searchsorted(ids, other)]
        if not near[0].any():  # a line of one cell
            frames[row, 0] = chord
            continue
        frames[row, 0] = 2.0 * (near[0] @ chord) * chord - near[0]
        frames[row, 1] = near[1]


def _completed(frames: FloatArray) -> FloatArray:
    """Normals made orthogonal and unit, binormals from them."""
    t, n = frames[:, 0], frames[:, 1]
    n -= (n * t).sum(axis=1, keepdims=True) * t
    size = np.linalg.norm(n, axis=1)
    straight = size < _STRAIGHT
    along_z = np.abs(t[:, 2]) > 1.0 - 1e-9
    up = np.where(along_z[:, None], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0])
    n[straight] = np.cross(up[straight], t[straight])
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    frames[:, 2] = np.cross(t, n)
    return frames
