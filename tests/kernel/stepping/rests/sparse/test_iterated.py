"""Steps by multigrid give what the condensed interface gives; linear ones the exact answer."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from references.recorder import assert_alike, recorded
from references.soil_block import FRICTION, soil_block

from ssilang.kernel.base.errors import ConvergenceError, SingularMatrixError
from ssilang.kernel.interface.interface import interface_of
from ssilang.kernel.solvers.factor import FIRST_FIT, Solver
from ssilang.kernel.solvers.multigrid import multigrid
from ssilang.kernel.stepping import choose
from ssilang.kernel.stepping.problem import initial
from ssilang.kernel.stepping.problem.constraints import EliminatedConstraints
from ssilang.kernel.stepping.rests.sparse import iterated
from ssilang.kernel.stepping.run import integrate

BY_MULTIGRID = Solver("multigrid")


@pytest.fixture(autouse=True)
def several_levels(monkeypatch):
    monkeypatch.setattr("ssilang.kernel.solvers.multigrid.hierarchy.COARSEST", 20)


def run(problem, solver=FIRST_FIT):
    return recorded(replace(problem, solver=solver), every=5)


def assert_same(problem, tolerance=1e-9):
    found, exact = run(problem, BY_MULTIGRID), run(problem)
    assert (found[1].loop, found[1].solver) == ("multigrid", "multigrid")
    assert exact[1].solver != "multigrid"
    assert_alike(found, exact, ("u", "v", "reaction", "w", "t", "state"), tolerance)
    return found[0].snapshots


@pytest.mark.long
def test_steps_begin_where_the_last_ones_lead(monkeypatch):
    """The same motion by fewer turns of the linear iterations, joints and supports moving."""

    def turns():
        made = []
        begin = iterated.IteratedSolver.__init__
        with monkeypatch.context() as patch:
            patch.setattr(
                iterated.IteratedSolver, "__init__",
                lambda self, *given: (begin(self, *given), made.append(self))[0],
            )  # fmt: skip
            kept, _ = run(problem, BY_MULTIGRID)
        return made[0].turns, kept.of("u")

    problem = soil_block(
        steps=30, size=(16, 8, 4), joint=FRICTION, damping=(0.5, 2e-3), moving=True
    )
    led, u = turns()
    monkeypatch.setattr(iterated, "COURSE", np.zeros(10**6))  # never so many steps
    alone, exact = turns()
    assert led < 0.9 * alone
    assert np.abs(u - exact).max() < 1e-9 * np.abs(exact).max()


def test_without_joints_the_energy_of_each_step_is_in_balance():
    problem = soil_block(steps=20, size=(16, 8, 4), damping=None)
    none = interface_of((), None, problem.numbering)
    linear = replace(problem, interface=none, state=none.initial_state())
    kept = assert_same(linear)
    assert len(kept) == 5
    kinetic, elastic, stored, lost, _, external = run(linear, BY_MULTIGRID)[1].energies.T
    balance = kinetic + elastic + stored + lost - external
    assert np.abs(balance - balance[0]).max() < 1e-9 * np.abs(external).max()


def test_a_coarser_tolerance_takes_fewer_turns_and_is_met(monkeypatch):
    turns, kept = {}, {}
    problem = soil_block(steps=10, size=(16, 8, 4), acceleration=6.0)
    solve = iterated.IteratedSolver.solve
    for tolerance in (1e-12, 1e-6):

        def counted(self, *given, tolerance=tolerance):
            outcome = solve(self, *given)
            assert outcome.residual <= tolerance
            turns[tolerance] = self.turns
            return outcome

        monkeypatch.setattr(iterated.IteratedSolver, "solve", counted)
        kept[tolerance] = run(problem, Solver("multigrid", tolerance=tolerance))[0].snapshots
    assert turns[1e-6] < 0.7 * turns[1e-12]
    fine, coarse = (kept[t][-1].u for t in (1e-12, 1e-6))
    assert 0.0 < np.abs(coarse - fine).max() < 1e-4 * np.abs(fine).max()


def test_multigrid_makes_a_few_steps_of_a_large_model_and_a_factor_many(monkeypatch):
    problem = soil_block(steps=200)
    dt, few = float(problem.times[1]), replace(problem, times=problem.times[:3])

    def name_of(problem):
        return choose.rule_of(choose.Case(problem, None, dt)).name

    assert name_of(problem) == name_of(few) == "dissection"
    monkeypatch.setattr(iterated, "MANY", 100)
    monkeypatch.setattr("ssilang.kernel.solvers.backends.DISSECTED", 100)
    monkeypatch.setattr("ssilang.kernel.solvers.backends.FACTOR", 1e-9)
    assert (name_of(few), name_of(problem)) == ("multigrid", "dissection")
    monkeypatch.setattr("ssilang.kernel.base.memory.available_bytes", lambda: 1e4)
    assert name_of(problem) == "multigrid"
    server = Solver(None, petsc=object())  # it takes what memory does not hold
    assert not choose.Case(replace(problem, solver=server), None, dt).iterated


def same(_, rest):
    """A cycle that does nothing for a rest."""
    return rest.copy()


def test_an_iteration_that_ends_nowhere_says_its_residual(monkeypatch):
    monkeypatch.setattr(multigrid, "MOST_TURNS", 1)
    monkeypatch.setattr(iterated, "TURNS", 3)
    problem = replace(soil_block(steps=3, size=(16, 8, 4)), solver=BY_MULTIGRID)
    for turns in (3, 2):  # of Newton: all, and up to the first that does not halve the rest
        with pytest.raises(ConvergenceError, match="residual") as caught:
            integrate(problem)
        assert caught.value.data["residual"] > 1e-12
        assert caught.value.data["turns"] == turns
        monkeypatch.setattr("ssilang.kernel.solvers.multigrid.hierarchy.Hierarchy.cycle", same)


@pytest.mark.long
def test_a_model_that_nothing_holds_is_named():
    problem = soil_block(steps=3, size=(16, 8, 4))
    none = EliminatedConstraints(sparse.csr_array((0, problem.numbering.size)))
    free = replace(problem, solver=BY_MULTIGRID, constraints=none)
    with pytest.raises(SingularMatrixError) as caught:
        iterated.iterated_system(free, free.K, 1.0)
    assert caught.value.data["count"] == 3


def test_accelerations_of_many_unknowns_with_a_consistent_mass(monkeypatch):
    problem = soil_block(steps=2)
    whole = abs(problem.K - sparse.diags_array(problem.K.diagonal()))
    consistent = problem.M + 1e-2 * problem.M.max() / whole.max() * whole  # diagonally dominant
    problem = replace(problem, M=sparse.csr_array(consistent))
    force = np.random.default_rng(0).standard_normal((problem.numbering.size, 2))
    exact = initial.accelerated(problem, force)
    monkeypatch.setattr(initial, "SOME", 10)
    monkeypatch.setattr("scipy.sparse.linalg.splu", None)  # one force needs no factor
    found = initial.accelerated(problem, force[:, 0])
    assert np.abs(found - exact[:, 0]).max() < 1e-11 * np.abs(exact).max()
    monkeypatch.setattr(initial, "MANY", 10)
    found = initial.accelerated(problem, force)
    assert np.abs(found - exact).max() < 1e-11 * np.abs(exact).max()


def test_accelerations_of_masses_that_hardly_resist_some_motions():
    # a ten-thousandth of the largest mass resists the motion that alternates, as of a curved
    # shell's rotations about its normal
    n = 4000
    along = sparse.diags_array([np.full(n - 1, 0.4999)] * 2, offsets=(-1, 1), shape=(n, n))
    mass = sparse.csc_array(sparse.eye_array(n) + along)
    exact = np.random.default_rng(0).standard_normal((n, 2)) * [1.0, 1e-8]
    found = initial._of_heavy(mass, mass @ exact)
    assert (np.abs(found - exact).max(axis=0) < [1e-10, 1e-18]).all()
