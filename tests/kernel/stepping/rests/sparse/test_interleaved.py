"""The loop of large problems gives what Newton's method on all unknowns gives, at every step."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from references.soil_block import FRICTION, soil_block

from ssilang.kernel.stepping import effective
from ssilang.kernel.stepping.problem.constraints import EliminatedConstraints
from ssilang.kernel.stepping.rests.sparse import interleaved as interleaved_loop
from ssilang.kernel.stepping.run import integrate

SOFTENING = {"KN": 2e8, "KS": 1e8, "FU": 2e4, "GF": 200.0, "FC": -1e4}
BONDED = {"KN": 2e8, "KS": 1e8, "FU": 1e6, "GF": 1e6}
SIZE = (16, 8, 4)


class Instants:
    """Keeps chosen instants."""

    def __init__(self, problem, every=3):
        self.wanted = np.arange(len(problem.times)) % every == 0
        self.kept = []

    def receive(self, snapshot):
        """One more."""
        self.kept.append(snapshot)

    def close(self):
        """Nothing to close."""


def motions(problem, full):
    instants = Instants(problem)
    history = integrate(problem, [instants], full_newton=full)
    return history, instants.kept


def assert_same(problem, tolerance=1e-9):
    (fast, kept), (full, expected) = motions(problem, False), motions(problem, True)
    assert (fast.loop, fast.solver) == ("condensed", "nested dissection")
    assert full.loop == "full Newton"
    assert len(kept) == len(expected) > 10
    for name in ("u", "v", "reaction", "w", "t", "state"):
        a, b = (np.array([getattr(s, name) for s in k]) for k in (kept, expected))
        if b.size:
            assert np.abs(a - b).max() <= tolerance * np.abs(b).max(), name
    size = np.abs(full.energies).max()
    assert np.abs(fast.energies - full.energies).max() <= tolerance * size
    return expected


@pytest.mark.parametrize(
    ("joint", "words"),
    [(FRICTION, ()), (SOFTENING, ()), ({"KN": 2e8, "KS": 1e8}, ("CISAILLEMENT_ELASTIQUE",))],
)
@pytest.mark.parametrize("damping", [None, (0.5, 2e-3)])
def test_laws_of_the_joint(joint, words, damping):
    problem = soil_block(
        steps=150, size=SIZE, joint=joint, words=words, damping=damping, acceleration=6.0
    )
    kept = assert_same(problem)
    openings = np.array([s.w[:, -1] for s in kept])
    assert (openings > 1e-6).any()  # it rocks
    assert (openings < 0.0).any()


def test_damping_that_is_a_diagonal_matrix():
    problem = soil_block(steps=60, size=SIZE)
    lumped = sparse.diags_array(problem.M.sum(axis=1)).tocsr()
    assert_same(replace(problem, M=lumped, C=0.8 * lumped))


def test_without_joints():
    problem = soil_block(steps=60, size=SIZE)
    assert_same(replace(problem, interface=None, state=np.zeros((0, 0))))


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


def test_supports_of_the_joints_themselves_move():
    problem = soil_block(steps=100, size=SIZE, damping=None)
    up = problem.numbering.table.coordinates[problem.numbering.nodes, 1] < -0.5
    rows = np.flatnonzero(up | (problem.interface.J.toarray().min(axis=0) < 0.0))
    C = sparse.csr_array(
        (np.ones(len(rows)), (np.arange(len(rows)), rows)), shape=(len(rows), len(up))
    )
    imposed = np.zeros((len(rows), 2))
    imposed[:, 1] = 2e-4
    moving = replace(
        problem, constraints=EliminatedConstraints(C),
        loading=replace(problem.loading, imposed=imposed),
    )  # fmt: skip
    kept = assert_same(moving)
    assert (np.array([s.w[:, -1] for s in kept]) > 1e-6).any()


def footing_made_rigid(problem):
    """The upper sides of the joints move as one rigid body, told by relations."""
    places = problem.numbering.table.coordinates[problem.numbering.nodes]
    above = np.flatnonzero(problem.interface.J.toarray().max(axis=0) > 0.0)
    assert (places[above, 1] == 0.0).all()
    across, up = (np.intersect1d(above, problem.numbering.where(n)) for n in ("UX", "UY"))
    left, right = up[places[up, 0].argmin()], up[places[up, 0].argmax()]
    rows = []
    for i in across[1:]:
        rows.append({i: 1.0, across[0]: -1.0})
    for i in up:
        if i not in (left, right):
            s = (places[i, 0] - places[left, 0]) / (places[right, 0] - places[left, 0])
            rows.append({i: 1.0, left: s - 1.0, right: -s})
    assert len(rows) > 5
    ties = sparse.lil_array((len(rows), problem.numbering.size))
    for k, row in enumerate(rows):
        for i, factor in row.items():
            ties[k, i] = factor
    old = problem.constraints.C
    return replace(
        problem, constraints=EliminatedConstraints(sparse.csr_array(sparse.vstack([old, ties]))),
        loading=replace(problem.loading, imposed=np.vstack(
            [problem.loading.imposed, np.zeros((len(rows), problem.loading.imposed.shape[1]))]
        )),
    )  # fmt: skip


@pytest.mark.parametrize("moving", [False, True])
@pytest.mark.parametrize("damping", [None, (0.5, 2e-3)])
def test_a_footing_tied_to_a_rigid_body_on_joints(moving, damping):
    problem = soil_block(steps=100, size=SIZE, damping=damping, moving=moving)
    tied = footing_made_rigid(problem)
    kept = assert_same(tied)
    assert (np.array([s.w[:, -1] for s in kept]) > 1e-6).any()
    rng = np.random.default_rng(5)
    u, v = (tied.constraints.T @ (1e-4 * rng.standard_normal(tied.constraints.T.shape[1]))
            for _ in range(2))  # fmt: skip
    assert_same(replace(tied, u=tied.u + u, v=tied.v + v), 1e-8)


def test_a_first_motion_that_the_supports_do_not_allow():
    problem = soil_block(steps=60, size=SIZE)
    rng = np.random.default_rng(3)
    u, v = (1e-4 * rng.standard_normal(problem.numbering.size) for _ in range(2))
    assert_same(replace(problem, u=u, v=v), 1e-8)


@pytest.mark.parametrize("block", [1, 7, 64])
def test_length_of_the_blocks_of_steps_changes_nothing(block, monkeypatch):
    problem = soil_block(steps=100, size=SIZE)
    expected = motions(problem, False)[1][-1]
    monkeypatch.setattr(interleaved_loop, "BLOCK", block)
    found = motions(problem, False)[1][-1]
    assert np.abs(found.u - expected.u).max() <= 1e-10 * np.abs(expected.u).max()


@pytest.mark.parametrize("branch", [0, 300, 10**9])
def test_size_of_the_branches_changes_nothing(branch, monkeypatch):
    problem = soil_block(steps=50, size=SIZE)
    expected = motions(problem, False)[1][-1]
    monkeypatch.setattr(interleaved_loop, "BRANCH", branch)
    found = motions(problem, False)[1][-1]
    assert np.abs(found.u - expected.u).max() <= 1e-11 * np.abs(expected.u).max()


def test_energy_of_bonded_bodies_is_kept():
    problem = soil_block(
        steps=200, size=SIZE, damping=None, acceleration=0.1,
        joint=BONDED, words=("CISAILLEMENT_ELASTIQUE",),
    )  # fmt: skip
    history, _ = motions(problem, False)
    assert np.abs(history.imbalance).max() <= 1e-10 * np.abs(history.energies).max()
