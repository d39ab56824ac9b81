"""Motions that advance side by side are those of runs of their own."""

from dataclasses import replace

import numpy as np
import pytest
from references.recorder import Recorder
from references.rocking_beam import rocking
from references.soil_block import FRICTION, soil_block

from ssilang.kernel.base.errors import ConvergenceError
from ssilang.kernel.solvers.factor import Solver
from ssilang.kernel.stepping import run_many as together
from ssilang.kernel.stepping.newmark import generalised_alpha, hht
from ssilang.kernel.stepping.problem.loading import Loading
from ssilang.kernel.stepping.problem.sharing import grouped
from ssilang.kernel.stepping.rests.sparse import interleaved_batch as interleaved_together
from ssilang.kernel.stepping.run import integrate

SIZE = (16, 8, 4)
ROUNDING = 1e-11  # sums in another order, over the steps


def scaled(problem, factor):
    """The same problem, its shaking (the last load) by a factor."""
    given = problem.loading
    curves = (*given.curves[:-1], (given.curves[-1][0], factor * given.curves[-1][1]))
    return replace(problem, loading=Loading(given.forces, given.imposed, curves))


def assert_as_alone(problems, side_by_side=True):
    recorders = [Recorder(len(p.times)) for p in problems]
    found = together.integrate_together(problems, [[r] for r in recorders])
    for problem, history, recorder in zip(problems, found, recorders, strict=True):
        other = Recorder(len(problem.times))
        truth = integrate(problem, [other])
        assert history.together == (len(problems) if side_by_side else 1)
        assert (history.loop, history.solver) == (truth.loop, truth.solver)
        assert recorder.closed
        assert [s.step for s in recorder.snapshots] == [s.step for s in other.snapshots]
        for name in ("u", "v", "a", "reaction", "w", "t", "state"):
            a, b = recorder.of(name), other.of(name)
            assert np.abs(a - b).max() <= ROUNDING * np.abs(b).max(), name
        size = np.abs(truth.energies).max()
        assert np.abs(history.energies - truth.energies).max() <= ROUNDING * size
    return recorders


def test_small_models_run_one_after_another():
    whole = rocking(hht(0.1), 250)
    kept = assert_as_alone([scaled(whole, f) for f in (0.2, 1.3)], side_by_side=False)
    open_points = {int((r.of("t")[..., -1] == 0.0).sum()) for r in kept}
    assert len(open_points) == len(kept)  # each has its own open springs


@pytest.mark.parametrize("count", [2, 5, 8])
def test_large_models_with_friction(count):
    whole = soil_block(steps=80, size=SIZE, joint=FRICTION, damping=(0.5, 2e-3), acceleration=6.0)
    kept = assert_as_alone([scaled(whole, f) for f in np.linspace(0.4, 1.2, count)])
    openings = [r.of("w")[..., -1].max() for r in kept]
    assert max(openings) > 1e-6
    assert len(set(openings)) == count


def test_large_models_by_another_scheme_and_with_consistent_mass():
    whole = soil_block(steps=70, size=SIZE, scheme=generalised_alpha(0.6), damping=(0.5, 2e-3))
    assert_as_alone([scaled(whole, f) for f in (0.5, 1.0, 1.1)])


def test_steps_of_two_lengths():
    whole = soil_block(steps=40, size=SIZE)
    times = np.concatenate([whole.times[:21], whole.times[20] + 0.6 * whole.times[1:15]])
    whole = replace(whole, times=times)
    assert_as_alone([scaled(whole, f) for f in (0.5, 1.0)])


def test_initial_states_and_load_vectors_may_differ():
    one = soil_block(steps=70, size=SIZE)
    given = one.loading
    other = replace(
        one,
        u=1.5 * one.u,
        loading=Loading(given.forces[:, ::-1].copy(), given.imposed, given.curves[::-1]),
    )
    third = replace(one, loading=Loading(0.8 * given.forces, given.imposed, given.curves))
    assert_as_alone([one, other, third])


def test_an_initial_motion_that_the_supports_do_not_allow():
    one = soil_block(steps=30, size=SIZE)
    moved = one.u.copy()
    held = np.flatnonzero(np.abs(one.constraints.C).sum(axis=0) > 0)
    moved[held] += 1e-4
    assert_as_alone([one, replace(one, u=moved)])


def test_other_models_run_one_after_another():
    one = soil_block(steps=40, size=SIZE)
    other = replace(one, K=1.01 * one.K)
    recorders = [Recorder(len(one.times)) for _ in range(3)]
    found = together.integrate_together([one, other, one], [[r] for r in recorders])
    assert [h.together for h in found] == [2, 1, 2]
    assert not np.allclose(recorders[0].of("u")[-1], recorders[1].of("u")[-1], rtol=1e-6)
    assert np.array_equal(recorders[0].of("u"), recorders[2].of("u"))


def test_problems_of_other_solvers_and_those_of_servers_stay_apart():
    one = soil_block(steps=2, size=SIZE)
    named, served = Solver("SuperLU"), Solver("PETSC")
    problems = [one, replace(one, solver=named), one, *[replace(one, solver=served)] * 2]
    assert grouped(problems) == [[0, 2], [1], [3], [4]]


def test_loops_without_a_passage_for_several_run_one_after_another():
    one = soil_block(steps=10, size=SIZE)
    assert_as_alone([replace(one, scheme=replace(one.scheme, conserving=True))] * 2, False)


class Full:
    """An observer whose disk is full at a step."""

    def __init__(self, n_times, step):
        self.wanted, self.step = np.ones(n_times, bool), step

    def receive(self, snapshot):
        """Fails at its step."""
        if snapshot.step == self.step:
            raise OSError("no space left")

    def close(self):
        """Nothing to close."""


def test_an_observer_that_fails_stops_its_own_motion():
    one = soil_block(steps=90, size=SIZE)
    n = len(one.times)
    seen = Recorder(n)
    found = together.integrate_together([one, scaled(one, 0.5)], [[Full(n, 30)], [seen]])
    assert isinstance(found[0], OSError)
    assert len(seen.snapshots) == n
    assert found[1].together == 2


def beyond_all_numbers(problem):
    given = problem.loading
    t, y = given.curves[-1]
    burst = np.where(np.arange(len(problem.times)) < 40, 0.0, 1e308)
    curves = (*given.curves[:-1], (problem.times, np.interp(problem.times, t, y) + burst))
    return replace(problem, loading=Loading(given.forces, given.imposed, curves))


def test_a_motion_that_fails_leaves_the_others_as_they_are():
    one = soil_block(steps=150, size=SIZE)
    n = len(one.times)
    recorders = [Recorder(n) for _ in range(3)]
    problems = [one, beyond_all_numbers(one), scaled(one, 0.5)]
    with np.errstate(all="ignore"):
        found = together.integrate_together(problems, [[r] for r in recorders])
    assert isinstance(found[1], ConvergenceError)
    assert recorders[1].closed
    assert 30 < len(recorders[1].snapshots) < n
    for i in (0, 2):
        other = Recorder(n)
        integrate(problems[i], [other])
        a, b = recorders[i].of("u"), other.of("u")
        assert np.abs(a - b).max() <= ROUNDING * np.abs(b).max()


def test_progress_and_memory_in_pieces(monkeypatch):
    """Saved steps come in pieces when they do not fit."""
    monkeypatch.setattr(together, "CHUNK_VALUES", 40_000)
    monkeypatch.setattr(interleaved_together, "BLOCK", 7)
    one = soil_block(steps=40, size=SIZE)
    said: list[tuple[int, int]] = []
    recorder = Recorder(len(one.times))
    together.integrate_together(
        [one, scaled(one, 0.3)], [[recorder], []], [lambda a, b: said.append((a, b)), None]
    )
    assert len(recorder.snapshots) == len(one.times)
    assert said[-1] == (40, 40)
    assert [a for a, _ in said] == sorted({a for a, _ in said})
    other = Recorder(len(one.times))
    integrate(one, [other])
    assert np.abs(recorder.of("u") - other.of("u")).max() <= ROUNDING * np.abs(other.of("u")).max()
