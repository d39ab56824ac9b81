"""The linear system of one step, factorised once for each dt, and the interface's compliance.

`A du + c J^T (f_1 - f_0) = r` with

    A = (1 - alpha_m)/(beta dt^2) M + (1 - alpha_f) gamma/(beta dt) C + (1 - alpha_f) K

on the motions `du = T q + particular(dd)` that the conditions leave. Where A alone is singular
(bodies without mass held by joints alone) the closed joints' stiffness R is added to it, and
`interface.condensed` takes it back exactly.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray, IntArray
from ssilang.kernel.base.sparse import for_products, sp
from ssilang.kernel.base.threads import side_by_side
from ssilang.kernel.solvers.backends import DISSECTION
from ssilang.kernel.solvers.cholesky.inverse import Inverse, invert
from ssilang.kernel.solvers.factor import Ordering
from ssilang.kernel.statics.linear_motion import rigid_motions, singular
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.constraints import Constraints
from ssilang.kernel.stepping.problem.problem import SMALL, Problem

COLUMNS, MANY = 64, 128  # right-hand sides solved together: of all unknowns, of a root


@dataclass(frozen=True, eq=False)
class Effective:
    """A step's linear system."""

    dt: float
    A: sp.csr_array  # (n, n) with the closed joints' stiffness if R is not zero
    constraints: Constraints
    inverse: Inverse  # of `V^T A T` (V is T but for non-associated relations)
    right: sp.csc_array  # (r, q) `V^T J^T`, q interface unknowns
    S: FloatArray  # (q, q) compliance `J Y`, `Y = A^-1 J^T` on the admissible motions
    R: FloatArray  # (q, q) stiffness of the joints that A holds
    root: "RootResponse | None" = None  # the interface as the root of a dissected factor, if so

    @cached_property
    def Y(self) -> FloatArray:  # noqa: N802
        """Motions (n, q) under forces on the interface's jumps."""
        return _responses(self.constraints, self.inverse, self.right)

    def solve(self, r: FloatArray) -> FloatArray:
        """Admissible motion (n,) or (n, k) under r, for `C du = 0`."""
        to, back = self._conditions
        return back @ self.inverse.solve(to @ r)

    @cached_property
    def _conditions(self) -> tuple[Any, Any]:
        """`V^T` and T, for products."""
        return for_products(self.constraints.V.T), for_products(self.constraints.T)

    def imposed(self, dd: FloatArray) -> FloatArray:
        """Motion (n,) for `C du = dd` and no force."""
        start = self.constraints.particular(dd)
        return start - self.solve(self.A @ start)


def effective_matrix(problem: Problem, dt: float) -> sp.csr_array:
    """A without the joints, for a step dt; the stiffness alone for a static problem."""
    n = newmark_of(problem.scheme, dt)
    A = n.mass * problem.M + n.damping * problem.C + n.end * problem.K
    return sp.csr_array(A)


def effective_of(
    problem: Problem, A: sp.csr_array, dt: float, share: float, free: bool = False,
    least: int = SMALL,
) -> Effective:  # fmt: skip
    """Factorise A (n, n) and condense it on the interface.

    Parameters
    ----------
    share : float
        c in `c J^T f`: the stiffness of closed joints enters with it.
    free : bool
        True leaves motions free that unilateral relations may hold (statics).
    least : int
        Unknowns beyond which the factor has the interface at its root.

    Raises
    ------
    SingularMatrixError
        If bodies stay free with all joints closed; it names the motions.
    """
    T, V, joints = problem.constraints.T, problem.constraints.V, problem.interface
    symmetric = problem.constraints.associated
    q = joints.size
    R = np.zeros((q, q))
    right = sp.csc_array(V.T @ joints.J.T)
    order = ordering_of(problem, right, least)
    inverse = invert(sp.csr_array(V.T @ A @ T), symmetric, problem.solver, order)
    if inverse.singular and joints:
        held = share * joints.closed_stiffness()
        A, R = sp.csr_array(A + joints.J.T @ held @ joints.J), held.toarray()
        inverse = invert(sp.csr_array(V.T @ A @ T), symmetric, problem.solver, order)
    if inverse.singular and (joints or not free):
        motions = T @ inverse.kernel
        raise singular("kernel.stepping.motions-without-mass", problem.numbering, motions)
    root = root_response(inverse, right)
    if root is None:
        S = joints.J @ _responses(problem.constraints, inverse, right)
    else:
        S = np.asarray(root.J @ root.Y)
    return Effective(dt, A, problem.constraints, inverse, right, np.ascontiguousarray(S), R, root)


def _responses(constraints: Constraints, inverse: Inverse, right: sp.csc_array) -> FloatArray:
    """`T A^-1 right`, some columns at a time."""
    q = right.shape[1]
    Y = np.zeros((constraints.T.shape[0], q))
    for start in range(0, q, COLUMNS):
        part = right[:, start : start + COLUMNS].toarray()
        Y[:, start : start + COLUMNS] = constraints.T @ inverse.solve(part)
    return Y


def ordering_of(problem: Problem, right: sp.csc_array, least: int = SMALL) -> Ordering | None:
    """Places of the unknowns of a large symmetric problem, its interface last."""
    if problem.numbering.size <= least or not problem.constraints.associated:
        return None
    own = _heaviest_rows(problem.constraints.T)
    nodes = problem.numbering.nodes[own]
    points = problem.numbering.table.coordinates[nodes]
    rigid = rigid_motions(problem.numbering)[own]  # for what has no memory for a factor
    return Ordering(points, np.unique(right.indices).astype(np.int64), rigid, nodes)


def _heaviest_rows(T: sp.csr_array) -> IntArray:
    """The row (r,) of the largest entry of each column of T (n, r), the first of equal ones."""
    columns = sp.csc_array(T)
    columns.sort_indices()
    count = np.diff(columns.indptr)
    column = np.repeat(np.arange(len(count)), count)
    order = np.lexsort((-np.abs(columns.data), column))
    own = np.zeros(len(count), dtype=np.int64)
    own[count > 0] = columns.indices[order[columns.indptr[:-1][count > 0]]]
    return own


@dataclass(frozen=True, eq=False)
class RootResponse:
    """The interface seen from the root of the elimination tree, r unknowns."""

    J: sp.csr_array  # (q, r) jumps of the root's scaled unknowns
    Y: FloatArray  # (r, q) scaled motions under forces on the jumps


def root_response(inverse: Inverse, right: sp.csc_array) -> RootResponse | None:
    """Response of the interface, None if it is not the root of a dissected factor."""
    factor = inverse.factor
    if factor.name != DISSECTION or inverse.singular or right.shape[1] == 0:
        return None
    from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
    from ssilang.kernel.solvers.cholesky.triangular import solve_columns

    assert isinstance(factor, DissectedFactor)
    begin = int(factor.panels.first[-2])
    order = factor.tree.order
    loads = sp.csr_array(sp.diags_array(inverse.scale[order]) @ sp.csr_array(right)[order])
    if loads[:begin].count_nonzero():
        return None
    own = sp.csr_array(loads[begin:])
    count, q = len(factor.panels.first) - 1, own.shape[1]

    def solved(part: FloatArray) -> Iterator[FloatArray]:
        Y = np.ascontiguousarray(part)
        solve_columns(factor.panels, Y, count - 1, count, begin)
        yield Y

    parts = np.array_split(own.toarray(), -(-q // MANY), axis=1)
    Y = np.hstack([found[0] for found in side_by_side([solved(part) for part in parts])])
    return RootResponse(sp.csr_array(own.T), Y)
