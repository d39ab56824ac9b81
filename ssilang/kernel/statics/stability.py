"""Free motions of a system with conditions, its negative eigenvalues, springs below zero.

Number of negative eigenvalues of a sparse symmetric matrix, by Sylvester's law of inertia.
"""

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.scientific import la, sp
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import is_symmetric, vector_to_field
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, imaginary
from ssilang.kernel.modal.basis import reduced_problem
from ssilang.kernel.solvers.backends import SuperLUFactor
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


DENSE = 1500  # unknowns up to which eigenvalues are computed where the pivots say nothing
NUDGE = 1e-10  # relative shift tried when a pivot vanishes


def count_negative(A: sp.csr_array) -> int:
    """Number of negative eigenvalues of a symmetric A (n, n).

    Signs of the pivots of a factorisation without row exchanges; eigenvalues of a small matrix
    where that fails; else a matrix shifted by a relative 1e-10 (so that zero counts as positive).
    """
    n = A.shape[0]
    if n == 0:
        return 0
    size = float(np.abs(A.diagonal()).max()) or 1.0
    if n <= 60:
        return _by_eigenvalues(A, size)
    for shift in (0.0, NUDGE * size, 100.0 * NUDGE * size):
        try:
            shifted = sp.csr_array(A + shift * sp.eye_array(n))
            return SuperLUFactor(shifted, True).negative_pivots()
        except SingularFactorError:
            continue
    if n <= DENSE:
        return _by_eigenvalues(A, size)
    raise KernelError("kernel.solvers.number-negative-eigenvalues-cannot")


def _by_eigenvalues(A: sp.csr_array, size: float) -> int:
    return int(np.sum(la.eigvalsh(A.toarray()) < -1e-12 * size))
