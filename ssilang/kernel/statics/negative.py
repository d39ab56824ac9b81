"""Springs below zero that nothing outweighs: the sum of stiffnesses at an unknown is negative."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, imaginary
from ssilang.kernel.waves.histories import HISTORIES


def negative_unknowns(matrix: Matrix) -> list[tuple[int, str, float]]:
    """Node, name and stiffness of unknowns where springs make the diagonal negative.

    A spring below zero beside a stiffer one, or a condition, is meant (a weight that leans), and so
    are the diagonals of stresses of a matched layer. Impedances, which have real and imaginary parts
    of the same unknowns, are below zero above a frequency.
    """
    names = {n for b in matrix.blocks for n in b.unknowns}
    if any(imaginary(n) in names for n in names):
        return []
    looked = [b for b in matrix.blocks if b.zone is None and (_diagonal(b) < 0.0).any()]
    if not looked:
        return []
    nodes = np.unique(np.concatenate([b.nodes.ravel() for b in looked]))
    found = []
    for name in dict.fromkeys(n for b in looked for n in b.unknowns if n not in HISTORIES):
        total = np.zeros(len(nodes))
        for block in matrix.blocks:
            for row in np.flatnonzero([n == name for n in block.unknowns]):
                at = block.nodes[:, block.local[row]]
                mine = np.isin(at, nodes)
                np.add.at(total, np.searchsorted(nodes, at[mine]), _diagonal(block)[mine, row])
        for relation in matrix.relations:
            named = relation.nodes[[n == name for n in relation.unknowns]]
            total[np.isin(nodes, named)] = 0.0
        found += [(int(nodes[i]), name, float(total[i])) for i in np.flatnonzero(total < 0.0)]
    return found


def _diagonal(block: ElementMatrices) -> FloatArray:
    """Diagonals (n_cells, n_unknowns) of the cells."""
    return np.asarray(np.diagonal(block.values, axis1=1, axis2=2), dtype=float)
