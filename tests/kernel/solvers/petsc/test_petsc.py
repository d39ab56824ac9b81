"""PETSc on two processes gives the answers of the other solvers."""

import shutil

import numpy as np
import pytest
from petsc_there import COMMAND, environment

from ssilang.kernel.base import memory
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.solvers import backends
from ssilang.kernel.solvers.backends import PETSC, factorise
from ssilang.kernel.solvers.cholesky.inverse import invert
from ssilang.kernel.solvers.factor import Ordering, Solver
from ssilang.kernel.solvers.petsc.client import COLUMNS, PetscServer

pytestmark = pytest.mark.usefixtures("petsc_is_there")


@pytest.fixture(scope="module", autouse=True)
def _mpi():
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment().items():
            patch.setenv(name, value)
        yield


@pytest.fixture(scope="module")
def server(_mpi):
    made = PetscServer(COMMAND)
    yield made
    made.close()


@pytest.fixture
def petsc(server):
    return Solver(PETSC, server)


def laplacian(n, held=True):
    """Seven-point stiffness of a grid of n^3 springs, held or free, with its places."""
    line = sp.diags_array([-np.ones(n - 1), 2.0 * np.ones(n), -np.ones(n - 1)], offsets=(-1, 0, 1))
    line = sp.csr_array(line)
    if not held:
        line[0, 0] = line[n - 1, n - 1] = 1.0
    one = sp.eye_array(n)
    parts = [
        sp.kron(sp.kron(line, one), one),
        sp.kron(sp.kron(one, line), one),
        sp.kron(sp.kron(one, one), line),
    ]
    axes = np.arange(float(n))
    points = np.stack(np.meshgrid(axes, axes, axes, indexing="ij"), -1).reshape(-1, 3)
    order = Ordering(points, np.zeros(0, np.int64), np.ones((n**3, 1)))
    return sp.csr_array(sum(parts)), order


def right_side(n, *columns):
    return np.random.default_rng(0).standard_normal((n, *columns))


@pytest.mark.parametrize("columns", [(), (1,), (3,), (COLUMNS + 5,)])
def test_a_positive_matrix(petsc, columns):
    A, order = laplacian(7)
    b = right_side(343, *columns)
    factor = factorise(A, True, petsc, order)
    assert factor.name == "PETSc MUMPS"
    np.testing.assert_allclose(factor.solve(b), factorise(A, True, "SuperLU").solve(b), atol=1e-12)


def test_fewer_unknowns_than_processes(petsc):
    x = factorise(sp.csr_array([[4.0]]), True, petsc).solve(np.array([[2.0, 8.0]]))
    np.testing.assert_allclose(x, [[0.5, 2.0]], rtol=1e-15)


def test_a_matrix_without_symmetry(petsc):
    A = sp.csr_array(laplacian(5)[0] + sp.diags_array(np.full(124, 0.7), offsets=1))
    b = right_side(125, 2)
    x = factorise(A, False, petsc).solve(b)
    np.testing.assert_allclose(x, np.linalg.solve(A.toarray(), b), atol=1e-12)


def test_lagrange_multipliers_stand_in_a_saddle_point(petsc):
    A, _ = laplacian(6)
    rows = sp.csr_array(right_side(4, 216))
    saddle = sp.csr_array(sp.block_array([[A, rows.T], [rows, None]]))
    b = right_side(220, 3)
    inverse = invert(saddle, True, petsc)
    assert not inverse.singular
    exact = np.linalg.solve(saddle.toarray(), b)
    np.testing.assert_allclose(inverse.solve(b), exact, atol=1e-10 * np.abs(exact).max())


def test_a_matrix_that_is_not_positive_is_factorised_again_as_it_is(petsc):
    A, order = laplacian(6)
    A = sp.csr_array(A - 3.0 * sp.eye_array(216))  # the diagonal stays positive
    with pytest.raises(SingularFactorError):
        factorise(A, True, petsc, order)
    b = right_side(216)
    exact = np.linalg.solve(A.toarray(), b)
    found = invert(A, True, petsc, order).solve(b)
    np.testing.assert_allclose(found, exact, atol=1e-10 * np.abs(exact).max())


@pytest.mark.parametrize("positive", [True, False])
def test_a_matrix_of_zeros_is_singular(petsc, positive):
    A = sp.csr_array((np.zeros(3), (range(3), range(3))))
    with pytest.raises(SingularFactorError):
        factorise(A, positive, petsc)


def test_the_free_motion_of_a_singular_matrix_is_found(petsc):
    A, order = laplacian(5, held=False)
    inverse = invert(A, True, petsc, order)
    assert inverse.kernel.shape == (125, 1)
    motion = inverse.kernel[:, 0]
    np.testing.assert_allclose(motion, motion[0], rtol=1e-9)
    b = right_side(125)
    b -= b.mean()
    np.testing.assert_allclose(A @ inverse.solve(b), b, atol=1e-10)


def test_what_is_dropped_leaves_the_server(server, petsc):
    A, order = laplacian(4)
    first = factorise(A, True, petsc, order)  # the server starts with it
    before = _count(server)
    kept = [factorise(A, True, petsc, order) for _ in range(3)]
    assert _count(server) == before + 3
    del kept[1:]
    assert _count(server) == before + 1
    b = right_side(64)
    for factor in (first, kept[0]):
        np.testing.assert_allclose(A @ factor.solve(b), b, atol=1e-12)


def _count(server):
    return server._line.ask({"do": "hosts"})["factors"]


def test_the_report_names_machines_with_ranks_and_memory(server, petsc):
    factorise(laplacian(4)[0], True, petsc)
    report = server.report()
    assert report["command"] == COMMAND
    assert report["ranks"] == sum(host["ranks"] for host in report["hosts"]) == 2
    assert all(host["peak_memory_mb"] > 10.0 for host in report["hosts"])


@pytest.fixture
def cramped(server, monkeypatch):
    monkeypatch.setattr(server, "room", 5e6)  # MUMPS wants more for 8 000 unknowns
    return Solver(PETSC, server)


def test_multigrid_takes_a_matrix_whose_factor_has_no_room(cramped):
    A, order = laplacian(20)
    factor = factorise(A, True, cramped, order)
    assert factor.name == "PETSc GAMG"
    b = right_side(8000, 2)
    x = factor.solve(b)
    assert np.linalg.norm(A @ x - b) <= 2e-12 * np.linalg.norm(b)
    assert not factor.solve(np.zeros(8000)).any()


def test_a_matrix_that_is_not_positive_and_has_no_room_is_refused(cramped):
    A = sp.csr_array(laplacian(20)[0] - 3.0 * sp.eye_array(8000))
    with pytest.raises(KernelError, match=r"factor of 8000 unknowns takes .* 0.01 GB") as caught:
        factorise(A, False, cramped)
    assert caught.value.code == "kernel.solvers.petsc-memory"
    b = right_side(27)  # the server goes on
    x = factorise(laplacian(3)[0], True, cramped).solve(b)
    np.testing.assert_allclose(laplacian(3)[0] @ x, b, atol=1e-12)


def test_multigrid_that_finds_no_end_says_so(cramped):
    A, order = laplacian(20, held=False)
    factor = factorise(A, True, cramped, order)
    assert factor.name == "PETSc GAMG"
    with pytest.raises(KernelError, match="multigrid did not converge"):
        factor.solve(right_side(8000) + 1.0)  # pushes on the free motion


def test_size_alone_hands_a_system_to_a_server_that_is_there(server, monkeypatch):
    A, order = laplacian(6)
    assert factorise(A, True, Solver(None, server), order).name == backends.DISSECTION
    monkeypatch.setattr(backends, "DISTRIBUTED", 216)
    assert factorise(A, True, Solver(None, server), order).name == "PETSc MUMPS"
    assert factorise(A, True, Solver(), order).name == backends.DISSECTION


def test_memory_that_holds_no_factor_hands_a_system_to_a_server_that_is_there(server, monkeypatch):
    backends.keep_factors(0)  # nor one that a test before this one has kept
    A, order = laplacian(6)
    free = memory.available_bytes()
    # the arrays on their way are small, the factor is not
    monkeypatch.setattr("ssilang.kernel.solvers.cholesky.multifrontal.fits", lambda n: False)
    assert free > 0.0
    assert factorise(A, True, Solver(None, server), order).name == "PETSc MUMPS"


def test_factors_of_a_server_are_not_kept_from_run_to_run(petsc):
    backends.keep_factors(2)
    try:
        A, order = laplacian(4)
        assert factorise(A, True, petsc, order) is not factorise(A, True, petsc, order)
    finally:
        backends.keep_factors(0)


# the last one: what a test is given lives until fixtures of the module are gone
def test_a_system_that_promises_little_memory_gives_what_a_factor_needs_at_each_start():
    there = shutil.which("prlimit") is not None
    bounded = f"prlimit --as={3 << 30} " if there else ""  # less than is free
    server = PetscServer(bounded + COMMAND)
    A, order = laplacian(12)
    try:
        factor = factorise(A, True, Solver(PETSC, server), order)
        assert factor.name == "PETSc MUMPS"
        b = right_side(1728)
        np.testing.assert_allclose(A @ factor.solve(b), b, atol=1e-11)
        server.close()
        assert factor.lost
        with pytest.raises(KernelError, match="ended in the middle"):
            factor.solve(b)
        again = server.factorise(A, True)
        np.testing.assert_allclose(A @ again.solve(b), b, atol=1e-11)
    finally:
        server.close()
