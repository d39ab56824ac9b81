"""How many digits a stiffness leaves: condition numbers, and whether joints are to blame.

The matrix is scaled to a unit diagonal first, so that metres, radians and elements of different
sizes compare; what is left is the contrast of stiffnesses that act on one another. The number is
that of the 1-norm, its inverse part estimated from a few solutions (Hager and Higham).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.scientific import sp, spla
from ssilang.kernel.interface.laws.columns import Parameter
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.solvers.backends import MULTIGRID
from ssilang.kernel.statics.linear import LinearSystem
from ssilang.kernel.stepping.effective import effective_matrix
from ssilang.kernel.stepping.newmark import newmark_of
from ssilang.kernel.stepping.problem.plausibility import stiffness_contrast
from ssilang.kernel.stepping.problem.problem import Problem

LARGEST = 20_000  # unknowns for which a factorisation of its own costs little
FEW_DIGITS = 1e12  # condition number that leaves four digits of sixteen
STRANGE_JOINTS = 1e10  # the same for joints, whose stiffness is a free choice
BLAME = 1e4  # fall of the condition number that makes joints its cause


@dataclass(frozen=True)
class JointConditioning:
    """Condition number with closed joints, and with joints as stiff as the bodies there.

    Attributes
    ----------
    number, balanced : float
        Where a bound above them is small enough to clear the joints, that bound.
    contrast : float
        Stiffness of the joints over that of the bodies at the same unknowns.
    kn : float
        Median KN given (Pa/m; N/m for JOI1).
    """

    number: float
    balanced: float
    contrast: float
    kn: float

    @property
    def joints_are_to_blame(self) -> bool:
        """True if few digits are left and the joints' stiffness takes them."""
        return self.number > STRANGE_JOINTS and self.balanced < self.number / BLAME

    @property
    def digits(self) -> int:
        """Digits of sixteen that are left."""
        return max(0, round(16 - float(np.log10(self.number))))

    @property
    def wanted_kn(self) -> float:
        """KN with which the joints are as stiff as the bodies."""
        return self.kn / self.contrast


def condition_number(A: sp.csr_array) -> float:
    """Estimate of the 1-norm condition number of A (n, n) scaled to a unit diagonal.

    Infinite if A is singular.
    """
    if A.shape[0] == 0:
        return 1.0
    size = np.abs(A.diagonal())
    scale = sp.diags_array(1.0 / np.sqrt(np.where(size > 0.0, size, 1.0)))
    scaled = sp.csr_array(scale @ A @ scale)
    try:
        factor: Any = spla.splu(sp.csc_array(scaled))
    except RuntimeError:
        return np.inf

    def solve(b: FloatArray) -> FloatArray:
        return np.asarray(factor.solve(np.asarray(b, dtype=float)))

    def solve_transposed(b: FloatArray) -> FloatArray:
        return np.asarray(factor.solve(np.asarray(b, dtype=float), "T"))

    return _product(scaled, solve, solve_transposed)


def _product(
    A: sp.csr_array,
    solve: Callable[[FloatArray], FloatArray],
    solve_transposed: Callable[[FloatArray], FloatArray],
) -> float:
    n = A.shape[0]
    norm = _norm(A)
    if n < 4:
        return norm * float(np.abs(solve(np.eye(n))).sum(axis=0).max())
    inverse = spla.LinearOperator((n, n), matvec=solve, rmatvec=solve_transposed, dtype=float)
    return norm * float(spla.onenormest(inverse))


def joint_conditioning(problem: Problem) -> JointConditioning | None:
    """Condition of a problem's matrix with closed joints; None without joints to compare.

    Not computed above `LARGEST` unknowns.
    """
    joints, contrast = problem.interface, stiffness_contrast(problem)
    if not joints or contrast is None or problem.numbering.size > LARGEST:
        return None
    T, V = problem.constraints.T, problem.constraints.V
    dt = float(np.diff(problem.times).max())
    A = effective_matrix(problem, dt) if problem.M.nnz else problem.K
    closed = joints.J.T @ joints.closed_stiffness() @ joints.J
    reduced = sp.csr_array(V.T @ (A + closed) @ T)
    number = balanced = _bound_by_mass(problem, dt, reduced)
    if number > STRANGE_JOINTS:
        number = balanced = condition_number(reduced)
    if number > STRANGE_JOINTS:
        balanced = condition_number(sp.csr_array(V.T @ (A + closed / contrast) @ T))
    return JointConditioning(
        number, balanced, contrast, float(np.median(joints.parameters[:, Parameter.KN]))
    )


def _bound_by_mass(problem: Problem, dt: float, A: sp.csr_array) -> float:
    """A bound above the condition number of A (n, n) scaled to a unit diagonal, without a factor.

    Stiffness and damping take no energy, so that all eigenvalues of the scaled matrix stand above
    the least share r of a diagonal mass in its diagonal: |A^-1|_1 <= sqrt(n)/r. Infinite where
    unknowns have no mass, or coupled ones. (A geometric stiffness may take energy; bodies that
    buckle are as badly conditioned with other joints, which are not to blame.)
    """
    T = problem.constraints.T
    diagonal = A.diagonal()
    if not problem.constraints.associated or not len(diagonal) or diagonal.min() <= 0.0:
        return np.inf
    mass = sp.csr_array(T.T @ problem.M @ T)
    own = mass.diagonal()
    if own.min() <= 0.0 or np.count_nonzero(mass.data) != len(own):
        return np.inf
    share = newmark_of(problem.scheme, dt).mass * float((own / diagonal).min())
    scale = sp.diags_array(1.0 / np.sqrt(diagonal))
    return _norm(sp.csr_array(scale @ A @ scale)) * float(np.sqrt(len(own))) / share


def _norm(A: sp.csr_array) -> float:
    """The 1-norm: the largest sum of a column."""
    return float(abs(A).sum(axis=0).max())


@dataclass(frozen=True)
class Extremes:
    """Condition number of a linear system; where its stiffest and softest elements stand."""

    number: float
    stiffest: tuple[str, float]
    softest: tuple[str, float]


def system_extremes(system: LinearSystem, matrix: Matrix) -> Extremes | None:
    """Condition of a matrix that is factorised; None if it is singular, or has saddle rows.

    None by multigrid too: its residual is known, and an estimate is twenty iterations.
    """
    inverse = system.inverse
    if inverse.singular or len(system.saddle) or system.n_masters == 0:
        return None
    if inverse.factor.name == MULTIGRID:
        return None
    T = system.elimination.T
    A = sp.csr_array(T.T @ system.K @ T)
    scale = sp.diags_array(inverse.scale)

    def solve(b: FloatArray) -> FloatArray:
        return inverse.factor.solve(np.asarray(b, dtype=float))

    number = _product(sp.csr_array(scale @ A @ scale), solve, solve)
    parts = [p for p in (_largest_term(block) for block in matrix.blocks) if p[1] > 0.0]
    return Extremes(number, max(parts, key=_value), min(parts, key=_value))


def _value(part: tuple[str, float]) -> float:
    return part[1]


def _largest_term(block: ElementMatrices) -> tuple[str, float]:
    """'UX at node 3' and the largest diagonal term of the elements of a block."""
    terms = np.abs(np.diagonal(block.values, axis1=1, axis2=2))
    if terms.size == 0:
        return "", 0.0
    cell, row = np.unravel_index(int(np.argmax(terms)), terms.shape)
    node = int(block.nodes[cell, block.local[row]])
    return f"{block.unknowns[row]} at node {node + 1}", float(terms[cell, row])
