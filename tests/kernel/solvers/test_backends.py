"""Every solver that is installed gives the same answer; one that is not says how to get it."""

import numpy as np
import pytest
import scipy.sparse as sp
from together import together

from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.solvers import backends
from ssilang.kernel.solvers.backends import BACKENDS, factorise

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
    missing = backends.Backend(
        backends.PardisoFactor, "no_such_package", "pip install 'ssilang[pardiso]'", lambda n, p: 1
    )
    monkeypatch.setitem(BACKENDS, "PARDISO", missing)
    with pytest.raises(KernelError, match="no_such_package") as caught:
        factorise(positive(), True, "PARDISO")
    assert "pip install" in caught.value.hint
    assert backends.choose(10**6, True) != "PARDISO"


def test_an_unknown_solver_is_refused():
    with pytest.raises(KernelError, match="no solver is called"):
        factorise(positive(), True, "MAGIC")
