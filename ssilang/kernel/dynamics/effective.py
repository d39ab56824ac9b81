"""The linear system of one step, factorised once for each dt, and the interface's compliance.

`A du + c J^T (f_1 - f_0) = r` with

    A = (1 - alpha_m)/(beta dt^2) M + (1 - alpha_f) gamma/(beta dt) C + (1 - alpha_f) K

on the motions `du = T q + particular(dd)` that the conditions leave. Where A alone is singular
(bodies without mass held by joints alone) the closed joints' stiffness R is added to it, and
`solve_interface` takes it back exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ssilang.kernel.dynamics.constraints import Constraints
from ssilang.kernel.dynamics.problem import Problem
from ssilang.kernel.errors import SingularMatrixError
from ssilang.kernel.mesh.nodes import FloatArray
from ssilang.kernel.solvers.inverse import Inverse, invert
from ssilang.kernel.sparse import sp
from ssilang.kernel.statics.linear_motion import describe_motions

COLUMNS = 64  # right-hand sides solved together


@dataclass(frozen=True, eq=False)
class Effective:
    """A step's linear system.

    Attributes
    ----------
    dt : float
    A : csr array (n, n)
        With the closed joints' stiffness if R is not zero.
    inverse : Inverse
        Of `V^T A T` (V is T but for non-associated relations).
    Y : array (n, q)
        `A^-1 J^T` on the admissible motions, q interface unknowns.
    S : array (q, q)
        Compliance `J Y`.
    R : array (q, q)
        Stiffness of the joints that A holds.
    """

    dt: float
    A: sp.csr_array
    constraints: Constraints
    inverse: Inverse
    Y: FloatArray
    S: FloatArray
    R: FloatArray

    def solve(self, r: FloatArray) -> FloatArray:
        """Admissible motion (n,) or (n, k) under r, for `C du = 0`."""
        c = self.constraints
        found: FloatArray = c.T @ self.inverse.solve(c.V.T @ r)
        return found

    def imposed(self, dd: FloatArray) -> FloatArray:
        """Motion (n,) for `C du = dd` and no force."""
        start = self.constraints.particular(dd)
        return start - self.solve(self.A @ start)


def effective_matrix(problem: Problem, dt: float) -> sp.csr_array:
    """A without the joints, for a step dt; the stiffness alone for a static problem."""
    s = problem.scheme
    mass = (1 - s.alpha_m) / (s.beta * dt**2)
    damping = (1 - s.alpha_f) * s.gamma / (s.beta * dt)
    A = mass * problem.M + damping * problem.C + (1 - s.alpha_f) * problem.K
    return sp.csr_array(A)


def effective_of(
    problem: Problem, A: sp.csr_array, dt: float, share: float, free: bool = False
) -> Effective:
    """Factorise A (n, n) and condense it on the interface.

    Parameters
    ----------
    share : float
        c in `c J^T f`: the stiffness of closed joints enters with it.
    free : bool
        True leaves motions free that unilateral relations may hold (statics).

    Raises
    ------
    SingularMatrixError
        If bodies stay free with all joints closed; it names the motions.
    """
    T, V, joints = problem.constraints.T, problem.constraints.V, problem.interface
    symmetric = problem.constraints.associated
    q = joints.size if joints else 0
    R = np.zeros((q, q))
    inverse = invert(sp.csr_array(V.T @ A @ T), symmetric)
    if inverse.singular and joints is not None:
        R = share * joints.closed_stiffness()
        A = sp.csr_array(A + joints.J.T @ sp.csr_array(R) @ joints.J)
        inverse = invert(sp.csr_array(V.T @ A @ T), symmetric)
    if inverse.singular and not (free and joints is None):
        message, hint = describe_motions(problem.numbering, T @ inverse.kernel)
        raise SingularMatrixError(
            message.replace(" that the loads drive", ""),
            hint + ", or give it mass (MASS)",
        )
    Y = np.zeros((problem.numbering.size, q))
    if joints is not None:
        right = sp.csc_array(V.T @ joints.J.T)
        for start in range(0, q, COLUMNS):
            part = right[:, start : start + COLUMNS].toarray()
            Y[:, start : start + COLUMNS] = T @ inverse.solve(part)
    S = np.ascontiguousarray(joints.J @ Y) if joints is not None else R
    return Effective(dt, A, problem.constraints, inverse, Y, S, R)
