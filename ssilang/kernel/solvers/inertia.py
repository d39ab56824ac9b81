"""Number of negative eigenvalues of a sparse symmetric matrix, by Sylvester's law of inertia."""

from __future__ import annotations

import numpy as np

from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.backends import SuperLUFactor

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
    from ssilang.kernel.base.errors import KernelError

    raise KernelError("kernel.solvers.number-negative-eigenvalues-cannot")


def _by_eigenvalues(A: sp.csr_array, size: float) -> int:
    import scipy.linalg as la

    return int(np.sum(la.eigvalsh(A.toarray()) < -1e-12 * size))
