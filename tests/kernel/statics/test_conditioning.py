"""Condition numbers against numpy's, and joints of the wrong unit found by them."""

import numpy as np
import pytest
from references.assembled import Bench
from together import together

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.statics import conditioning
from ssilang.kernel.statics.conditioning import (
    condition_number,
    joint_conditioning,
    system_extremes,
)
from ssilang.kernel.statics.linear import linear_system


def chain(n, k):
    """Stiffness of n springs in a row, the first on the ground, with spring i of k[i]."""
    A = np.zeros((n, n))
    for i, value in enumerate(k):
        A[i, i] += value
        if i:
            A[i - 1, i - 1] += value
            A[i, i - 1] -= value
            A[i - 1, i] -= value
    return A


@together("n", [1, 3, 40])
def test_estimate_is_the_condition_of_the_matrix_with_unit_diagonal(n):
    A = chain(n, np.random.default_rng(3).uniform(1, 1e3, n))
    scale = np.diag(A) ** -0.5
    exact = np.linalg.cond(scale[:, None] * A * scale, 1)
    assert condition_number(sp.csr_array(A)) == pytest.approx(exact, rel=0.05)


def test_units_of_the_unknowns_do_not_count():
    A = chain(5, np.ones(5))
    S = np.diag([1.0, 1e6, 1e-4, 1.0, 1e3])
    assert condition_number(sp.csr_array(S @ A @ S)) == pytest.approx(
        condition_number(sp.csr_array(A))
    )


def test_a_singular_matrix_has_an_infinite_number():
    A = np.array([[1.0, -1.0], [-1.0, 1.0]])
    assert condition_number(sp.csr_array(A)) > 1e15


def stack(kn, times=(0.0, 1.0), mass=0.0):
    """Two springs with a joint between them, the upper one carrying a further mass."""
    bench = Bench()
    low, high, top = (bench.node(0.0, float(y)) for y in (-1, 0, 1))
    for a in (low, high, top):
        bench.fix(a, "UX")
        bench.mass(mass, a)
    bench.spring(1e7, low)
    bench.spring(1e7, high, top)
    bench.joint("SEG2", [low, high], "JOI1", KN=kn, KS=0.0)
    return bench.problem(np.array(times), mass=bench.mass_matrix if mass else None)


@together("kn, blamed", [(1e7, False), (1e15, False), (1e22, True), (1e-8, True)])
def test_a_joint_of_the_wrong_unit_is_blamed_and_the_stiffness_named(kn, blamed):
    found = joint_conditioning(stack(kn))
    assert found.joints_are_to_blame is blamed
    assert found.wanted_kn == pytest.approx(1e7, rel=1e-9)
    if blamed:
        assert found.number > 1e13
        assert found.balanced < 1e3
        assert found.digits <= 3


def test_mass_makes_short_steps_well_conditioned():
    long, short = (joint_conditioning(stack(1e-8, (0.0, dt), 100.0)).number for dt in (1e9, 1e-3))
    assert long > 1e12
    assert short < 1e3


@together("kn", [1e3, 1e9])
def test_a_mass_on_each_unknown_bounds_the_number_without_a_factor(kn, monkeypatch):
    problem = stack(kn, (0.0, 1e-3), 100.0)
    J, T = problem.interface.J.toarray(), problem.constraints.T.toarray()
    A = (problem.K + 4 / 1e-3**2 * problem.M).toarray()
    A = T.T @ (A + J.T @ problem.interface.closed_stiffness() @ J) @ T
    scale = np.diag(A) ** -0.5
    exact = np.linalg.cond(scale[:, None] * A * scale, 1)
    monkeypatch.setattr(conditioning, "condition_number", lambda A: pytest.fail("factorised"))
    found = joint_conditioning(problem)
    assert exact <= found.number < 1e3 * exact
    assert not found.joints_are_to_blame


def test_the_stiffest_and_the_softest_part_are_named():
    bench = Bench()
    a, b = bench.node(0.0, 0.0), bench.node(1.0, 0.0)
    for n in (a, b):
        bench.fix(n, "UX")
    bench.spring(1.0, a)
    bench.spring(1e13, a, b)
    matrix = bench.stiffness
    found = system_extremes(linear_system(matrix), matrix)
    assert found.number == pytest.approx(4e13, rel=0.05)
    assert found.stiffest[1] == pytest.approx(1e13)
    assert found.softest == ("UY at node 1", 1.0)


def test_what_multigrid_solves_and_what_is_free_has_no_number(monkeypatch):
    bench = Bench()
    a, b = bench.node(0.0, 0.0), bench.node(1.0, 0.0)
    bench.spring(1.0, a)
    bench.spring(3.0, a, b)
    system = linear_system(bench.stiffness)
    assert system_extremes(system, bench.stiffness).number > 1.0
    monkeypatch.setattr(conditioning, "MULTIGRID", system.inverse.factor.name)
    assert system_extremes(system, bench.stiffness) is None
