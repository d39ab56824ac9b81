"""Solvers that are installed give the same answer; factors kept; convex shares of asymptotes."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.optimize import minimize
from together import together

from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.solvers import backends
from ssilang.kernel.solvers.asymptotes import least, least_linear, shares
from ssilang.kernel.solvers.backends import BACKENDS, MULTIGRID, factorise, keep_factors
from ssilang.kernel.solvers.factor import Solver

INSTALLED = [name for name, backend in BACKENDS.items() if backend.installed]


def positive(n=60):
    line = sp.diags_array([-np.ones(n - 1), 2.5 * np.ones(n), -np.ones(n - 1)], offsets=(-1, 0, 1))
    return sp.csr_array(line)


@together("name", INSTALLED)
@together("columns", [(), (4,)])
def test_solves(name, columns):
    A = positive()
    b = np.random.default_rng(0).standard_normal((60, *columns))
    factor = factorise(A, True, name)
    assert factor.name == name
    np.testing.assert_allclose(A @ factor.solve(b), b, atol=1e-12)


@pytest.mark.parametrize("name", INSTALLED)
def test_a_matrix_of_zeros_is_singular(name):
    with pytest.raises(SingularFactorError):
        factorise(sp.csr_array((np.zeros(3), (range(3), range(3)))), True, name)


def test_a_solver_that_is_not_installed_says_how_to_get_it(monkeypatch):
    remedy = "pip install 'ssilang[pardiso]'"
    missing = backends.Backend(backends.PardisoFactor, "no_such_package", remedy)
    monkeypatch.setitem(BACKENDS, "PARDISO", missing)
    with pytest.raises(KernelError, match="no_such_package") as caught:
        factorise(positive(), True, "PARDISO")
    assert "pip install" in caught.value.hint
    assert backends.choose(10**6) != "PARDISO"


def test_an_unknown_solver_is_refused():
    with pytest.raises(KernelError, match="no solver is called"):
        factorise(positive(), True, "MAGIC")


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


X = np.array([0.4, -1.1, 2.0, 0.7, 0.1])
BOUNDS = (np.array([-1.0, -2.0, 1.5, 0.0, -1.0]), np.array([0.9, -0.9, 4.0, 3.0, 1.0]))
ASYMPTOTES = (X - np.array([1.0, 2.0, 0.9, 1.3, 2.0]), X + np.array([0.7, 1.5, 2.4, 3.0, 1.0]))
VALUES = np.array([3.0, 0.3, -0.2])
# rows and columns of either sign alone, of both, and a variable without influence
SLOPES = np.array(
    [[2.0, -1.0, -0.5, 1.0, 0.0], [-3.0, 0.2, 1.0, 0.0, 0.0], [-0.5, 0.7, -0.1, -2.0, 0.0]]
)
FREE = np.full(2, np.inf)


def test_shares_have_value_slope_and_convexity_of_the_functions():
    problem = shares(X, VALUES, SLOPES, BOUNDS, ASYMPTOTES)
    np.testing.assert_allclose(problem.values(X), VALUES)
    for i, e in enumerate(1e-6 * np.eye(5)):
        ends = problem.values(X + e), problem.values(X - e)
        np.testing.assert_allclose((ends[0] - ends[1]) / 2e-6, SLOPES[:, i], atol=1e-7)
        further = problem.values(X + 1e4 * e) + problem.values(X - 1e4 * e) - 2 * VALUES
        assert (further[SLOPES[:, i] != 0] > 1e-6).all()
    assert (problem.low >= BOUNDS[0]).all()
    assert (problem.high <= BOUNDS[1]).all()
    assert (problem.low > ASYMPTOTES[0]).all()
    assert (problem.high < ASYMPTOTES[1]).all()
    assert (problem.low == BOUNDS[0]).any()
    assert (problem.high == BOUNDS[1]).any()


@together("count", [0, 1, 2])
def test_the_least_is_that_of_a_general_method(count):
    rows = slice(None, count + 1)
    problem = shares(X, VALUES[rows], SLOPES[rows], BOUNDS, ASYMPTOTES)
    found = least(problem, X, FREE[:count])
    conditions = [{"type": "ineq", "fun": lambda x: -problem.values(x)[1:]}] if count else []
    wanted = minimize(
        lambda x: problem.values(x)[0], X, method="SLSQP", constraints=conditions,
        bounds=[*zip(problem.low, problem.high, strict=True)],
        options={"ftol": 1e-14, "maxiter": 500},
    )  # fmt: skip
    assert wanted.success
    np.testing.assert_allclose(found, wanted.x, atol=1e-4)
    assert found[4] == X[4]
    assert (problem.values(found)[1:] <= 1e-5).all()


def test_a_condition_of_a_low_cost_is_missed():
    problem = shares(X, VALUES, SLOPES, BOUNDS, ASYMPTOTES)
    cheap = least(problem, X, np.array([1e-3, np.inf]))
    held = least(problem, X, FREE)
    assert problem.values(cheap)[1] > 1e-2 > problem.values(held)[1]
    assert problem.values(cheap)[0] < problem.values(held)[0]
    dear = least_linear(X, VALUES, SLOPES, BOUNDS, np.array([1e3, np.inf]))
    np.testing.assert_allclose(dear, least_linear(X, VALUES, SLOPES, BOUNDS, FREE), atol=1e-9)
    given_up = least_linear(X, VALUES, SLOPES, BOUNDS, np.array([1e-3, np.inf]))
    free = least_linear(X, VALUES[[0, 2]], SLOPES[[0, 2]], BOUNDS, FREE[:1])
    assert ((VALUES + SLOPES @ (dear - X))[1:] <= 1e-9).all()
    assert SLOPES[0] @ given_up == pytest.approx(SLOPES[0] @ free, abs=1e-2)
