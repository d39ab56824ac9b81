"""A damping is found again as a combination of mass and stiffness with a rest."""

import numpy as np
import pytest
import scipy.sparse as sp
from together import together

from ssilang.kernel.stepping.problem.constraints import split_damping


def chain(n=60):
    K = 3e8 * sp.diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)], offsets=(-1, 0, 1))
    M = sp.diags_array(
        [np.full(n - 1, 1.0), np.full(n, 4.0), np.full(n - 1, 1.0)], offsets=(-1, 0, 1)
    )
    return sp.csr_array(K), sp.csr_array(M)


@together("alpha, beta", [(0.7, 3e-4), (0.7, 0.0), (0.0, 3e-4)])
@together("lumped", [True, False])
@together("dashpots", [0, 9])
def test_shares_and_rest(alpha, beta, lumped, dashpots):
    K, M = chain()
    if lumped:
        M = sp.csr_array(sp.diags_array(M.sum(axis=1)))
    extra = np.zeros(60)
    extra[:dashpots] = 1e4
    C = sp.csr_array(alpha * M + beta * K + sp.diags_array(extra))
    a, b, rest = split_damping(C, M, K)
    assert a == pytest.approx(alpha, rel=1e-11, abs=1e-9)
    assert b == pytest.approx(beta, rel=1e-11, abs=1e-17)
    if alpha or not lumped or dashpots == 0:
        assert rest.nnz == dashpots
    np.testing.assert_allclose(
        (a * M + b * K + rest).toarray(), C.toarray(), atol=1e-12 * abs(C).max()
    )


def test_another_damping_is_all_rest():
    K, M = chain()
    C = sp.csr_array(sp.diags_array(np.random.default_rng(0).uniform(1.0, 2.0, 60)))
    assert split_damping(C, M, K)[:2] == (0.0, 0.0)
    assert split_damping(C, M, K)[2] is C
    assert split_damping(sp.csr_array((60, 60)), M, K)[2].nnz == 0


@together("size", [1e-12, 1e12])
def test_dashpots_do_not_count_in_any_unit(size):
    K, M = chain()
    extra = np.zeros(60)
    extra[:9] = 1e4
    C = sp.csr_array(size * (0.7 * M + 3e-4 * K + sp.diags_array(extra)))
    a, b, rest = split_damping(C, sp.csr_array(size * M), sp.csr_array(size * K))
    assert (a, b, rest.nnz) == (pytest.approx(0.7, rel=1e-9), pytest.approx(3e-4, rel=1e-9), 9)
