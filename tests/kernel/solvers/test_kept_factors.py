"""Factors kept for matrices that come back."""

import numpy as np
import pytest
import scipy.sparse as sp

from ssilang.kernel.solvers.backends import MULTIGRID, factorise, keep_factors
from ssilang.kernel.solvers.factor import Solver


@pytest.fixture
def keeping():
    keep_factors(2)
    yield
    keep_factors(0)


def matrix(seed):
    A = sp.random_array((20, 20), density=0.2, rng=np.random.default_rng(seed))
    return sp.csr_array(A @ A.T + 20 * sp.eye_array(20))


def test_an_equal_matrix_finds_its_factor(keeping):
    first = factorise(matrix(1), True)
    assert factorise(matrix(1), True) is first
    b = np.arange(20.0)
    assert matrix(1) @ first.solve(b) == pytest.approx(b)


def test_another_matrix_gets_its_own_and_what_rested_longest_is_dropped(keeping):
    first, second = factorise(matrix(1), True), factorise(matrix(2), True)
    assert second is not first
    assert factorise(matrix(1), True) is first
    factorise(matrix(3), True)
    assert factorise(matrix(1), True) is first
    assert factorise(matrix(2), True) is not second


def test_a_factor_of_another_tolerance_is_not_taken(keeping):
    fine, coarse = (
        factorise(matrix(1), True, Solver(MULTIGRID, tolerance=t)) for t in (1e-12, 1e-4)
    )
    assert fine is not coarse
    assert factorise(matrix(1), True, Solver(MULTIGRID, tolerance=1e-4)) is coarse


def test_nothing_is_kept_unless_asked():
    assert factorise(matrix(1), True) is not factorise(matrix(1), True)
