"""Matrices that are positive but for small negative groups."""

import numpy as np
import pytest
from together import together

from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers.cholesky.elimination import SmallGroupsFactor
from ssilang.kernel.solvers.cholesky.inverse import invert


def mixed(sizes, rest=9, seed=3):
    """Symmetric, `rest` positive unknowns among negative groups of these sizes, shuffled."""
    random = np.random.default_rng(seed)
    n = rest + sum(sizes)
    A = random.standard_normal((n, n))
    A = A + A.T
    first = random.standard_normal((rest, rest))
    A[:rest, :rest] = first @ first.T + np.eye(rest)
    A[rest:, rest:] = 0.0
    at = rest
    for size in sizes:
        own = random.standard_normal((size, size))
        A[at : at + size, at : at + size] = -own @ own.T - 0.1 * np.eye(size)
        at += size
    order = random.permutation(n)
    return A[np.ix_(order, order)]


@together("sizes", [(3, 3, 1), (1,), (12, 2)])
@together("columns", [(), (4,)])
def test_solution_is_that_of_the_whole_matrix(sizes, columns):
    A = mixed(sizes)
    b = np.random.default_rng(1).standard_normal((len(A), *columns))
    negative = np.flatnonzero(A.diagonal() < 0)
    factor = SmallGroupsFactor(sp.csr_array(A), negative)
    assert factor.solve(b) == pytest.approx(np.linalg.solve(A, b), rel=1e-8)
    found = invert(sp.csr_array(A), symmetric=True)
    assert found.factor.name == "SuperLU + 3 x 3"
    assert found.solve(b) == pytest.approx(np.linalg.solve(A, b), rel=1e-8)


def test_large_groups_and_others_are_left_to_pivoting():
    large = mixed((13,))
    with pytest.raises(SingularFactorError):
        SmallGroupsFactor(sp.csr_array(large), np.flatnonzero(large.diagonal() < 0))
    saddle = np.array([[-1.0, 2.0, 0.0], [2.0, -1.0, 1.0], [0.0, 1.0, 3.0]])  # not negative
    with pytest.raises(SingularFactorError):
        SmallGroupsFactor(sp.csr_array(saddle), np.array([0, 1]))
    for A in (large, saddle):
        found = invert(sp.csr_array(A), symmetric=True)
        assert found.factor.name == "SuperLU"
        assert A @ found.solve(np.ones(len(A))) == pytest.approx(np.ones(len(A)))
