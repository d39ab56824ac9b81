"""Free motions of a system with conditions, and the number of its negative eigenvalues."""

from __future__ import annotations

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import is_symmetric, vector_to_field
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.modal.reduced import reduced_problem
from ssilang.kernel.solvers.inertia import count_negative
from ssilang.kernel.statics.linear import SolveOptions, linear_system


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
