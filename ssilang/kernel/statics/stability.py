"""Free motions of a system with conditions, its negative eigenvalues, springs below zero."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import is_symmetric, vector_to_field
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, imaginary
from ssilang.kernel.modal.reduced import reduced_problem
from ssilang.kernel.solvers.inertia import count_negative
from ssilang.kernel.statics.linear import SolveOptions, linear_system
from ssilang.kernel.waves.matched_layer import HISTORIES


def free_motion_fields(
    matrix: Matrix,
    options: SolveOptions = SolveOptions(),  # noqa: B008
) -> tuple[list[NodeField], IntArray]:
    """Motions that meet no stiffness, largest value 1, and the nodes (p,) that pin them."""
    system = linear_system(matrix, options)
    motions = system.free_motions
    masters = system.elimination.masters
    pins = system.inverse.pinned
    nodes = system.numbering.nodes[masters[pins[pins < len(masters)]]]
    fields = []
    for motion in motions.T:
        top = motion[abs(motion).argmax()]
        fields.append(vector_to_field(motion / top, system.numbering))
    return fields, nodes


def negative_eigenvalues(matrix: Matrix) -> int:
    """Negative eigenvalues of a symmetric matrix on the motions that its conditions allow.

    Unilateral conditions count as equalities.

    Raises
    ------
    KernelError
        If the matrix is not symmetric.
    """
    if not is_symmetric(matrix):
        raise KernelError("kernel.statics.matrix-not-symmetric-eigenvalues")
    problem = reduced_problem(matrix, matrix)
    return count_negative(problem.bordered(problem.K)) - problem.S.shape[0]


def negative_unknowns(matrix: Matrix) -> list[tuple[int, str, float]]:
    """Node, name and stiffness of unknowns where springs make the diagonal negative.

    A spring below zero beside a stiffer one, or a condition, is meant (a weight that leans), and so
    are the diagonals of stresses of a matched layer. Impedances, which have real and imaginary
    parts of the same unknowns, are below zero above a frequency.
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
