"""The loop of large problems gives what Newton's method on all unknowns gives, at every step."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from references.recorder import assert_alike, recorded
from references.soil_block import soil_block

from ssilang.kernel.interface.interface import interface_of
from ssilang.kernel.stepping import effective
from ssilang.kernel.stepping.rests.sparse import interleaved as interleaved_loop

BONDED = {"KN": 2e8, "KS": 1e8, "FU": 1e6, "GF": 1e6}
SIZE = (16, 8, 4)


def assert_same(problem, tolerance=1e-9):
    fast, full = recorded(problem, every=3), recorded(problem, every=3, full_newton=True)
    assert (fast[1].loop, fast[1].solver) == ("condensed", "nested dissection")
    assert full[1].loop == "full Newton"
    assert len(full[0].snapshots) > 10
    assert_alike(fast, full, ("u", "v", "reaction", "w", "t", "state"), tolerance)


def test_damping_that_is_a_diagonal_matrix():
    problem = soil_block(steps=60, size=SIZE)
    lumped = sparse.diags_array(problem.M.sum(axis=1)).tocsr()
    assert_same(replace(problem, M=lumped, C=0.8 * lumped))


def test_without_joints():
    problem = soil_block(steps=60, size=SIZE)
    none = interface_of((), None, problem.numbering)
    assert_same(replace(problem, interface=none, state=none.initial_state()))


def test_a_body_without_mass_that_joints_alone_hold():
    problem = soil_block(
        steps=60, size=SIZE, damping=None, joint=BONDED, words=("CISAILLEMENT_ELASTIQUE",)
    )
    block = problem.numbering.table.coordinates[problem.numbering.nodes, 1] > 0.0
    base = np.zeros(problem.numbering.size, bool)
    base[problem.interface.J.indices] = True
    coordinates = problem.numbering.table.coordinates[problem.numbering.nodes]
    lower = problem.interface.J.toarray().max(axis=0) > 0.0  # the joints' upper faces
    body = block | (lower & base & (coordinates[:, 1] == 0.0))
    keep = sparse.diags_array(np.where(body, 0.0, 1.0))
    light = replace(problem, M=sparse.csr_array(keep @ problem.M @ keep))
    dt = float(light.times[1])
    e = effective.effective_of(light, effective.effective_matrix(light, dt), dt, 1.0)
    assert e.R.any()
    assert_same(light)


@pytest.mark.parametrize("block", [1, 7, 64])
def test_length_of_the_blocks_of_steps_changes_nothing(block, monkeypatch):
    problem = soil_block(steps=100, size=SIZE)
    expected = recorded(problem)[0].snapshots[-1]
    monkeypatch.setattr(interleaved_loop, "BLOCK", block)
    found = recorded(problem)[0].snapshots[-1]
    assert np.abs(found.u - expected.u).max() <= 1e-10 * np.abs(expected.u).max()


@pytest.mark.parametrize("many", [1, 3])
def test_number_of_columns_solved_together_changes_nothing(many, monkeypatch):
    problem = soil_block(steps=50, size=SIZE)
    expected = recorded(problem)[0].snapshots[-1]
    monkeypatch.setattr(effective, "MANY", many)
    found = recorded(problem)[0].snapshots[-1]
    assert np.abs(found.u - expected.u).max() <= 1e-11 * np.abs(expected.u).max()


@pytest.mark.parametrize("branch", [0, 300, 10**9])
def test_size_of_the_branches_changes_nothing(branch, monkeypatch):
    """Nor where loads act on a few unknowns, of some branches alone."""
    problem = soil_block(steps=50, size=SIZE)
    forces = problem.loading.forces * (np.arange(problem.numbering.size) % 50 == 0)[:, None]
    problem = replace(problem, loading=replace(problem.loading, forces=forces))
    expected = recorded(problem)[0].snapshots[-1]
    monkeypatch.setattr(interleaved_loop, "BRANCH", branch)
    found = recorded(problem)[0].snapshots[-1]
    assert np.abs(found.u - expected.u).max() <= 1e-11 * np.abs(expected.u).max()


def test_energy_of_bonded_bodies_is_kept():
    problem = soil_block(
        steps=200, size=SIZE, damping=None, acceleration=0.1,
        joint=BONDED, words=("CISAILLEMENT_ELASTIQUE",),
    )  # fmt: skip
    _, history = recorded(problem)
    assert np.abs(history.imbalance).max() <= 1e-10 * np.abs(history.energies).max()


def test_a_first_motion_that_the_supports_do_not_allow():
    problem = soil_block(steps=60, size=SIZE)
    rng = np.random.default_rng(3)
    u, v = (1e-4 * rng.standard_normal(problem.numbering.size) for _ in range(2))
    assert_same(replace(problem, u=u, v=v), 1e-8)
