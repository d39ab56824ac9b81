"""Nested dissection and its Cholesky factors, against dense solves and SuperLU."""

import itertools

import numpy as np
import pytest
import scipy.sparse as sp
import scipy.sparse.linalg as spla
from together import together

from ssilang.kernel.base.errors import SingularFactorError
from ssilang.kernel.solvers.backends import factorise
from ssilang.kernel.solvers.cholesky import triangular
from ssilang.kernel.solvers.cholesky.dissected import DissectedFactor
from ssilang.kernel.solvers.cholesky.dissection import dissection
from ssilang.kernel.solvers.cholesky.inverse import invert
from ssilang.kernel.solvers.cholesky.multifrontal import NotPositiveError
from ssilang.kernel.solvers.factor import Ordering


def grid(*shape, unknowns=1, seed=0):
    """A positive matrix on the nodes of a grid, all neighbours linked, and the coordinates."""
    points = np.stack(np.meshgrid(*(np.arange(n) for n in shape), indexing="ij"), -1)
    points = points.reshape(-1, len(shape)).astype(float)
    pattern = sp.csr_array(np.ones((1, 1)))
    for n in shape:
        line = sp.diags_array([np.ones(n - 1), np.ones(n), np.ones(n - 1)], offsets=(-1, 0, 1))
        pattern = sp.kron(pattern, line, format="csr")
    pattern = sp.kron(pattern, np.ones((unknowns, unknowns)), format="coo")
    random = np.random.default_rng(seed)
    upper = sp.coo_array((random.standard_normal(pattern.nnz), pattern.coords)).tocsr()
    A = upper + upper.T
    A = A + sp.diags_array(np.asarray(abs(A).sum(axis=1)) + 0.1)
    return sp.csr_array(A), np.repeat(points, unknowns, axis=0)


@together("shape, unknowns", [((300,), 1), ((3, 2), 2), ((40, 23), 2), ((9, 8, 7), 3), ((1, 1), 3)])
@together("ending", [0, 5, 41])
def test_solves(shape, unknowns, ending):
    A, points = grid(*shape, unknowns=unknowns)
    n = A.shape[0]
    random = np.random.default_rng(1)
    last = random.permutation(n)[: min(ending, n)]
    factor = DissectedFactor(A, points, last)
    assert set(factor.tree.order[n - len(last) :]) == set(last)
    for columns in ((), (3,), (20,)):
        b = random.standard_normal((n, *columns))
        np.testing.assert_allclose(A @ factor.solve(b), b, atol=1e-11)


def test_terms_stored_on_one_side_alone_are_links_all_the_same():
    A, points = grid(40, 23)
    tiny, far = 1e-300, A.shape[0] - 1
    for row, column in ((0, far), (far, 0)):
        one = sp.coo_array(([tiny], ([row], [column])), shape=A.shape)
        factor = DissectedFactor(sp.csr_array(A + one), points)
        b = np.arange(A.shape[0], dtype=float)
        np.testing.assert_allclose(A @ factor.solve(b), b, atol=1e-9)


def test_rows_of_the_panels_are_those_of_a_dense_factor():
    A, points = grid(15, 14, unknowns=2)
    factor = DissectedFactor(A, points, np.arange(9))
    L = np.linalg.cholesky(A.toarray()[np.ix_(factor.tree.order, factor.tree.order)])
    first, ptr, rows = factor.panels.first, factor.panels.ptr, factor.panels.rows
    for s, (begin, end) in enumerate(itertools.pairwise(first)):
        found = np.flatnonzero((L[end:, begin:end] != 0.0).any(axis=1)) + end
        np.testing.assert_array_equal(rows[ptr[s] : ptr[s + 1]], found)


def test_large_fronts_take_blas():
    A, points = grid(500, 1)
    dense = np.random.default_rng(3).standard_normal((500, 500))
    A = sp.csr_array(dense @ dense.T + 500 * np.eye(500))
    factor = DissectedFactor(A, points, np.arange(100, 400))
    b = dense[0]
    np.testing.assert_allclose(A @ factor.solve(b), b, atol=1e-10)


@pytest.mark.parametrize("parts", [1, 3, 16])
def test_many_columns_are_solved_by_supernodes_in_parts(monkeypatch, parts):
    """Of a grid in space and of a full matrix, in two precisions: no row below the last ones."""
    monkeypatch.setattr(triangular, "TOGETHER", parts)
    dense = np.random.default_rng(3).standard_normal((250, 250))
    full = sp.csr_array(dense @ dense.T + 250 * np.eye(250))
    for A, points in (grid(9, 8, 7, unknowns=3), (full, grid(250, 1)[1])):
        factor = DissectedFactor(A, points, np.arange(140))
        A = A[factor.tree.order][:, factor.tree.order]
        for kind, error in ((np.float64, 1e-12), (np.float32, 1e-5)):
            L = list(triangular.supernodes(factor.panels, kind))
            widest = np.diff(factor.panels.first).max()
            assert max(s.end - s.begin for s in L) == min(widest, 32 * parts)
            b = np.random.default_rng(1).standard_normal((A.shape[0], 5)).astype(kind)
            x = b.copy()
            triangular.solve_together(L, x)
            np.testing.assert_allclose(A @ x.astype(float), b, atol=error * np.abs(b).max())


def test_order_is_a_permutation_with_children_first():
    A, points = grid(30, 20, unknowns=2)
    tree = dissection(A, points, np.arange(7))
    assert np.array_equal(np.sort(tree.order), np.arange(A.shape[0]))
    has_parent = tree.parent >= 0
    assert (tree.parent[has_parent] > np.flatnonzero(has_parent)).all()
    assert tree.first[0] == 0
    assert tree.first[-1] == A.shape[0]


def test_fill_in_is_less_than_with_minimum_degree_on_a_large_grid():
    A, points = grid(120, 120)
    factor = DissectedFactor(A, points)
    options = {"SymmetricMode": True}
    other = spla.splu(
        sp.csc_array(A), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options
    )
    sizes, below = np.diff(factor.panels.first), np.diff(factor.panels.ptr)
    assert (sizes * (sizes + 1) // 2 + sizes * below).sum() < 1.1 * other.L.nnz


def test_points_at_one_place_and_separate_bodies():
    A, points = grid(12, 11)
    both = sp.csr_array(sp.block_diag([A, 2 * A]))
    factor = DissectedFactor(both, np.vstack([points, points]))
    b = np.arange(both.shape[0], dtype=float)
    np.testing.assert_allclose(both @ factor.solve(b), b, atol=1e-10)


def test_a_matrix_that_is_not_positive_is_refused():
    A, points = grid(8, 8)
    A = sp.csr_array(A - 50 * sp.eye_array(64))
    with pytest.raises(NotPositiveError):
        DissectedFactor(A, points)
    with pytest.raises(SingularFactorError):
        factorise(A, True, ordering=Ordering(points, np.zeros(0, np.int64)))


def test_an_indefinite_or_singular_matrix_is_inverted_all_the_same():
    A, points = grid(8, 8)
    order = Ordering(points, np.arange(3))
    indefinite = sp.csr_array(A - 12 * sp.eye_array(64))
    assert (np.linalg.eigvalsh(indefinite.toarray()) < 0).any()
    b = np.arange(64.0)
    np.testing.assert_allclose(
        indefinite @ invert(indefinite, True, ordering=order).solve(b), b, atol=1e-9
    )
    loose = sp.csr_array(A - sp.diags_array(np.asarray(A.sum(axis=1))))  # constants are free
    inverse = invert(sp.csr_array(-loose @ loose), True, ordering=order)
    assert inverse.singular
