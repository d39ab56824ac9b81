"""Elimination of conditions: the admissible motions, particular solutions, multipliers."""

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from ssilang.kernel.solvers.cholesky import elimination
from ssilang.kernel.solvers.cholesky.elimination import eliminate


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
