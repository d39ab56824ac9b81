"""Stiffness of straight cables of a given force."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import MeshError
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.mesh import Mesh


def cable_stiffness(mesh: Mesh, dimension: int, force: float, percent: float) -> Matrix:
    """Stiffness of straight cables whose force is `force` at a lengthening of `percent`.

    Raises
    ------
    MeshError
        If a cell is not a segment of two nodes, or has no length.
    """
    if {b.cell_type for b in mesh.blocks} != {"SEG2"}:
        raise MeshError("kernel.matrices.cable-made-segments-two")
    rigidity = 100.0 * force / percent
    blocks = []
    for b in mesh.blocks:
        d = dimension
        along = (b.coordinates[:, 1] - b.coordinates[:, 0])[:, :d]
        length = np.linalg.norm(along, axis=1)
        if (length == 0.0).any():
            raise MeshError("kernel.matrices.segment-cable-no-length")
        row = np.concatenate([-along, along], axis=1) / length[:, None]
        values = (rigidity / length)[:, None, None] * row[:, :, None] * row[:, None, :]
        names = ("UX", "UY", "UZ")[:d] * 2
        duals = ("FX", "FY", "FZ")[:d] * 2
        local = np.repeat([0, 1], d)
        blocks.append(ElementMatrices(b.nodes, b.raw, local, names, duals, values, "RIGIDITE"))
    return Matrix(mesh.nodes, tuple(blocks), (), "RIGIDITE")
