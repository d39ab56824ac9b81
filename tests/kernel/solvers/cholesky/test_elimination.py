"""Elimination, free motions, small negative groups, products of panels: against dense algebra."""

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from refusing import refusal
from together import together

from ssilang.kernel.base.arrays import FloatArray
from ssilang.kernel.base.compiled import UNCOMPILED
from ssilang.kernel.base.compiled.compiler import compiled
from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.solvers.cholesky import elimination, inverse
from ssilang.kernel.solvers.cholesky import panel_products as products
from ssilang.kernel.solvers.cholesky.elimination import eliminate
from ssilang.kernel.solvers.cholesky.inverse import free_motions, invert
from ssilang.kernel.solvers.factor import Ordering


@st.composite
def conditions(draw):
    """Rows of any density, some of them combinations of others."""
    n = draw(st.integers(2, 14))
    m = draw(st.integers(1, n))
    density = draw(st.sampled_from([0.1, 0.3, 0.9]))
    rng = np.random.default_rng(draw(st.integers(0, 10**6)))
    C = rng.normal(size=(m, n)) * (rng.random((m, n)) < density)
    if m > 2 and draw(st.booleans()):
        C[1] = 2.0 * C[0] - C[2]
    return C


@settings(max_examples=150, deadline=None)
@given(conditions(), st.integers(0, 10**6))
def test_any_rows_are_met_exactly_and_spanned_fully(C, seed):
    rng = np.random.default_rng(seed)
    found = eliminate(sp.csr_array(C))
    T = found.T.toarray()
    assert found.eliminated.all()
    assert T.shape[1] == C.shape[1] - np.linalg.matrix_rank(C)
    assert T.size == 0 or np.linalg.matrix_rank(T) == T.shape[1]
    np.testing.assert_allclose(C @ T, 0.0, atol=1e-9)
    d = C @ rng.normal(size=C.shape[1])
    np.testing.assert_allclose(C @ found.particular(d), d, atol=1e-8)
    residual = C.T @ rng.normal(size=C.shape[0])
    np.testing.assert_allclose(C.T @ found.multipliers(residual), residual, atol=1e-8)


def test_many_ties_to_one_node_keep_the_transformation_sparse():
    n = 2000
    ties = sp.hstack([sp.eye_array(n), -np.ones((n, 1))], format="csr")
    found = eliminate(sp.csr_array(ties))
    assert found.T.shape == (n + 1, 1)
    assert found.T.nnz == n + 1


def test_a_row_over_all_unknowns_is_left_out_because_it_would_fill_the_matrix():
    mean = sp.csr_array(np.ones((1, 5000)))
    assert not eliminate(mean).eliminated[0]


def test_a_group_that_is_too_large_is_left_to_the_caller(monkeypatch):
    monkeypatch.setattr(elimination, "LARGEST_GROUP", 3)
    rng = np.random.default_rng(3)
    found = eliminate(sp.csr_array(rng.normal(size=(5, 9))))
    assert not found.eliminated.any()
    assert found.T.shape == (9, 9)


def test_contradicting_supports_show_as_mismatch():
    twice = sp.csr_array(np.array([[2.0, 0.0], [1.0, 0.0]]))
    found = eliminate(twice)
    u = found.particular(np.array([2.0, 5.0]))
    assert found.mismatch(u, np.array([2.0, 5.0])).max() == pytest.approx(4.0)
    assert found.mismatch(u, np.array([2.0, 1.0])).max() == pytest.approx(0.0)


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


@compiled
def lower(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.times_lower(values, pos, w, x, at)


@compiled
def upper(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.times_upper(values, pos, w, x, at)


@compiled
def rows(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.subtract(values, pos, w, m, x, at, to)


@compiled
def columns(values: FloatArray, pos: int, w: int, m: int, x: FloatArray, at: int, to: int) -> None:
    products.subtract_transposed(values, pos, w, m, x, at, to)


EXPECTED = {
    lower: lambda L, P, b, y: (L @ b, y),
    upper: lambda L, P, b, y: (L.T @ b, y),
    rows: lambda L, P, b, y: (b, y - P.T @ b),
    columns: lambda L, P, b, y: (b - P @ y, y),
}


@pytest.mark.parametrize("product", EXPECTED)
@given(
    w=st.integers(1, 33), m=st.integers(0, 70), pos=st.integers(0, 9), at=st.integers(0, 9),
    between=st.integers(0, 9), seed=st.integers(0, 2**32 - 1),
)  # fmt: skip
def test_products_are_numpy_s_and_leave_the_rest(product, w, m, pos, at, between, seed):
    random = np.random.default_rng(seed)
    square, P = np.tril(random.normal(size=(w, w))), random.normal(size=(w, m))
    held = P if product in (rows, columns) else square
    # what is not a number would spread if it were read
    values = np.full(pos + held.size + 9, np.nan)
    values[pos : pos + held.size] = held.ravel()
    b, y, to = random.normal(size=w), random.normal(size=m), at + w + between
    x = np.full(to + m + 9, np.nan)
    x[at : at + w], x[to : to + m] = b, y
    product(values, pos, w, m, x, at, to)
    new_b, new_y = EXPECTED[product](square, P, b, y)
    np.testing.assert_allclose(x[at : at + w], new_b, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(x[to : to + m], new_y, rtol=1e-12, atol=1e-12)
    assert np.isnan(np.delete(x, [*range(at, at + w), *range(to, to + m)])).all()


@pytest.mark.skipif(UNCOMPILED, reason="without compilation they are plain functions")
def test_called_from_python_they_are_their_text():
    x = np.array([1.0, 2.0, 5.0])
    products.subtract(np.array([3.0, 4.0]), 0, 2, 1, x, 0, 2)
    np.testing.assert_array_equal(x, [1.0, 2.0, 5.0 - 3.0 - 8.0])
