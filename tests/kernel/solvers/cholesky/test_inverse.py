"""Singular matrices: free motions, and solutions for loads that do no work on them."""

import numpy as np
import scipy.sparse as sp
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.solvers.cholesky import inverse
from ssilang.kernel.solvers.cholesky.inverse import free_motions, invert
from ssilang.kernel.solvers.factor import Ordering


def chain(n):
    """Springs of 2 between n points, free at both ends."""
    ends = np.r_[2.0, np.full(n - 2, 4.0), 2.0]
    return sp.diags_array([ends, np.full(n - 1, -2.0), np.full(n - 1, -2.0)], offsets=[0, 1, -1])


def test_unknowns_that_meet_nothing_are_free_beside_the_other_free_motions():
    n, idle = 12, np.array([0, 3, 4, 11, 13])
    used = np.setdiff1d(np.arange(n + len(idle)), idle)
    A = np.zeros((17, 17))
    A[np.ix_(used, used)] = chain(n).toarray()
    points = np.arange(17.0)[:, None]
    found = invert(sp.csr_array(A), True, None, Ordering(points, np.array([5, 13])))
    exact = np.zeros((17, 6))
    exact[used, 0] = 1.0  # the chain as a whole
    exact[idle, np.arange(1, 6)] = 1.0
    assert found.kernel.shape == (17, 6)
    assert np.linalg.matrix_rank(np.hstack([found.kernel, exact]), tol=1e-9) == 6
    assert set(idle) < set(found.pinned)
    b = np.zeros(17)
    b[used[[0, -1]]] = 3.0, -3.0
    assert np.abs(found.work(b)).max() < 1e-12
    x = found.solve(b)
    np.testing.assert_allclose(np.diff(x[used]), -1.5, rtol=1e-12)  # 3 over 2, each spring
    b[idle[0]] = 1.0
    assert np.abs(found.work(b)).max() > 0.1


def test_work_on_free_motions_is_the_same_in_any_units():
    units, b = sp.diags_array(2.0 ** np.arange(-12, 13, 3)), np.arange(9.0)
    plain = invert(sp.csr_array(chain(9)), True)
    other = invert(sp.csr_array(units @ chain(9) @ units), True)
    assert np.abs(plain.work(b)) > 0.1
    np.testing.assert_allclose(np.abs(other.work(units @ b)), np.abs(plain.work(b)), rtol=1e-9)


@together("count", [1, 11])
def test_free_motions_without_symmetry(count):
    """More than are looked for at first, too."""
    rng, n = np.random.default_rng(6), 40
    free = np.linalg.qr(rng.standard_normal((n, count)))[0]
    A = (np.eye(n) + 0.05 * rng.standard_normal((n, n))) @ (np.eye(n) - free @ free.T)
    found = free_motions(sp.csr_array(A), False)
    assert found.shape == (n, count)
    np.testing.assert_allclose(found.T @ found, np.eye(count), atol=1e-12)
    np.testing.assert_allclose(found @ (found.T @ free), free, atol=1e-9)


def test_a_matrix_of_zeros_has_as_many_free_motions_as_unknowns():
    found = invert(sp.csr_array((4, 4)), True)
    np.testing.assert_allclose(found.kernel.T @ found.kernel, np.eye(4), atol=1e-15)
    assert len(found.kept) == 0
    assert not found.solve(np.zeros(4)).any()


def test_more_idle_unknowns_than_memory_should_take_are_counted(monkeypatch):
    monkeypatch.setattr(inverse, "MOST", 20)
    A = sp.block_diag([chain(4), sp.csr_array((3, 3))]).tocsr()
    with refusal(KernelError, "kernel.solvers.unknowns-without-stiffness") as refused:
        invert(sp.csr_array(A), True)
    assert refused.value.data == {"idle": 3, "count": 7}
