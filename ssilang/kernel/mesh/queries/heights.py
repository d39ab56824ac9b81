"""Smallest distances in cells: between nodes, and from nodes to the sides they are not on."""

from __future__ import annotations

import itertools

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.mesh.cells import CELL_TYPES
from ssilang.kernel.mesh.mesh import CellBlock


def smallest_lengths(block: CellBlock) -> FloatArray:
    """Smallest length (n_cells,) of each cell: line, surface or volume.

    The least of the distances between two nodes, and from a node to the line or plane of a side
    that does not hold it (the mean plane of a side of four corners).
    """
    x = block.coordinates
    pairs = itertools.combinations(range(x.shape[1]), 2)
    found = [np.linalg.norm(x[:, a] - x[:, b], axis=-1) for a, b in pairs]
    for name, local in block.kind.faces if block.kind.dimension > 1 else ():
        corners = [local[k] for k in CELL_TYPES[name].corners]
        others = [k for k in range(x.shape[1]) if k not in local]
        if block.kind.dimension == 2:
            found += [_to_line(x[:, k], x[:, corners[0]], x[:, corners[1]]) for k in others]
        else:
            found += [_to_plane(x[:, k], x[:, corners]) for k in others]
    smallest: FloatArray = np.min(found, axis=0)
    return smallest


def _to_line(p: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    along = (b - a) / np.linalg.norm(b - a, axis=-1)[:, None]
    across = (p - a) - ((p - a) * along).sum(axis=-1)[:, None] * along
    return np.asarray(np.linalg.norm(across, axis=-1))


def _to_plane(p: FloatArray, corners: FloatArray) -> FloatArray:
    """Distances (n,) of points (n, 3) to the mean planes of faces (n, k, 3)."""
    middle = corners.mean(axis=1)
    turning = corners - middle[:, None]
    normal = np.cross(turning, np.roll(turning, -1, axis=1)).sum(axis=1)
    unit = normal / np.linalg.norm(normal, axis=-1)[:, None]
    return np.asarray(np.abs(((p - middle) * unit).sum(axis=-1)))
