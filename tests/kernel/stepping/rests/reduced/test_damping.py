"""Reduced models with dashpots, undamped parts and moving supports, against the whole one."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
from references.soil_block import soil_block
from references.whole_and_reduced import both, check, relative

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark_of
from ssilang.kernel.stepping.problem.constraints import EliminatedConstraints
from ssilang.kernel.stepping.problem.problem import closed_stiffness
from ssilang.kernel.stepping.rests.reduced.basis import Basis
from ssilang.kernel.stepping.rests.reduced.damping import States, split, square_roots
from ssilang.kernel.stepping.rests.reduced.loop import Reduced, reduced_step
from ssilang.kernel.stepping.rests.reduced.run import _PAIRS, GROWTH, integrate_reduced
from ssilang.kernel.stepping.run import integrate

RHO, YOUNG = 1900.0, 8e7  # of the soil of `soil_block`, Poisson's ratio 0.3
VS = np.sqrt(YOUNG / 2.6 / RHO)
VP = VS * np.sqrt(3.5)


@pytest.fixture(autouse=True)
def no_bases_of_other_tests():
    _PAIRS.clear()


def with_edges(problem, width=28):
    """Dashpots of an absorbing edge on both sides of the soil."""
    numbering = problem.numbering
    x = numbering.table.coordinates[numbering.nodes, 0]
    edge = np.abs(np.abs(x) - width / 2) < 1e-9
    c = np.zeros(numbering.size)
    for name, speed in (("UX", VP), ("UY", VS)):
        at = numbering.where(name)
        c[at[edge[at]]] = RHO * speed
    return replace(problem, C=sp.csr_array(problem.C + sp.diags_array(c)))


def with_block_damped(problem, share):
    """Rayleigh damping of the soil; a share of it on the upper part of the block."""
    numbering = problem.numbering
    above = numbering.table.coordinates[numbering.nodes, 1] > 0.5
    size = sp.diags_array(np.where(above, np.sqrt(share), 1.0))
    return replace(problem, C=sp.csr_array(size @ problem.C @ size))


def shaken(problem, height=0.06, start=0.0):
    """The base moves by a curve from where all starts; the forces that shook it are taken off."""
    loading = problem.loading
    t = loading.curves[1][0]
    forces, imposed = loading.forces.copy(), np.zeros((problem.constraints.C.shape[0], 2))
    forces[:, 1] = 0.0
    rows = abs(problem.constraints.C)[:, problem.numbering.where("UX")].sum(axis=1)
    imposed[np.asarray(rows).ravel() > 0, 1] = 1.0
    if start:  # one of its nodes follows the soil in part
        tied, C = int(np.argmax(imposed[:, 1])), problem.constraints.C.tolil()
        C[tied, problem.numbering.where("UX")[-1]] = -0.3 * C[tied].sum()
        imposed[tied] *= 0.7
        problem = replace(problem, constraints=EliminatedConstraints(sp.csr_array(C)))
    motion = start * (1.0 + t) + height * np.sin(4 * np.pi * t) * np.minimum(1.0, 2 * t) ** 3
    curves = (loading.curves[0], (t, motion))
    loading, u = replace(loading, forces=forces, imposed=imposed, curves=curves), problem.u.copy()
    at, v = problem.numbering.where("UX"), problem.v.copy()
    u[at] += start
    v[at] += start
    return replace(problem, loading=loading, u=u, v=v)


MODELS = {
    "absorbing edges": lambda scheme: with_edges(soil_block(scheme=scheme)),
    "two dampings": lambda scheme: with_block_damped(soil_block(scheme=scheme), 0.4),
    "a shaken base": lambda scheme: shaken(soil_block(scheme=scheme), start=0.03),
    "a shaken base between edges": lambda scheme: shaken(with_edges(soil_block(scheme=scheme))),
}
SCHEMES = {"average": Scheme(), "HHT": hht(0.1), "generalised alpha": generalised_alpha(0.8)}


# each scheme with a damping, and with a base that moves
PAIRS = [
    *(("average", model) for model in MODELS),
    ("HHT", "two dampings"), ("HHT", "a shaken base between edges"),
    ("generalised alpha", "absorbing edges"), ("generalised alpha", "a shaken base"),
]  # fmt: skip


@pytest.mark.parametrize(("scheme", "model"), PAIRS)
def test_true_error_is_below_the_estimate_and_the_tolerance(model, scheme):
    check(MODELS[model](SCHEMES[scheme]), 1e-4)


@pytest.mark.parametrize("model", ["two dampings", "a shaken base"])
def test_the_estimate_holds_down_to_one_in_a_million(model):
    check(MODELS[model](Scheme()), 1e-6)


def test_edges_reach_one_in_a_million_with_a_short_rayleigh_damping():
    problem = with_edges(soil_block(damping=(0.5, 8e-3), dt=1e-2, steps=200))
    check(problem, 1e-6)


def test_an_undamped_block():
    check(with_block_damped(soil_block(), 0.0), 2e-3)


def test_edges_alone_on_a_longer_step():
    """Two seconds on a step that leaves the basis room: it needs less than half of its vectors.

    On half this step joints chatter up to twice the frequency, and the vectors needed for it are
    about those allowed (half of the unknowns): rounding decides which are more.
    """
    check(with_edges(soil_block(damping=None, dt=4e-2, steps=50)), 1e-2)


def test_all_vectors_allowed_are_tried_before_the_whole_model_runs(monkeypatch):
    """The last two models are nested as all are, whatever room was left for growing."""
    problem = with_edges(soil_block(damping=None, dt=4e-2, steps=50, size=(12, 4, 4)), 12)
    unknowns, block = problem.constraints.T.shape[1], 12
    for share in (0.6, 0.7, 0.8):
        _PAIRS.clear()
        monkeypatch.setattr("ssilang.kernel.stepping.rests.reduced.run.MOST_VECTORS", share)
        assert integrate_reduced(problem, 1e-10).loop == "condensed"
        (pair,) = _PAIRS.values()
        assert share * unknowns - block <= pair.rich.size <= share * unknowns
        assert pair.rich.size >= GROWTH * pair.poor.size


def test_basis_of_one_scheme_serves_another():
    motion = shaken(soil_block())
    integrate_reduced(motion, 1e-4)
    check(replace(motion, scheme=hht(0.1)), 1e-4)


def test_two_step_lengths_and_instants_kept_apart():
    problem = shaken(with_edges(soil_block(steps=400)))
    times = problem.times
    late = times[149] + 0.5 * (times[1] - times[0]) * np.arange(1, 200)
    check(replace(problem, times=np.concatenate([times[:150], late])), 1e-3)


def test_reactions_of_moving_supports():
    problem = shaken(soil_block(steps=100))
    whole, _, reduced, _ = both(problem, 1e-6)
    exact = np.array([problem.constraints.multipliers(r) for r in whole.of("reaction")[1:]])
    found = np.array([problem.constraints.multipliers(r) for r in reduced.of("reaction")[1:]])
    assert relative(found, exact) < 1e-3


def test_supports_start_as_their_curve():
    basis = Basis(shaken(soil_block(steps=2), start=0.03), 5e-3, 400)
    np.testing.assert_allclose(basis.supports.start[:, 0], [0.03, 0.03, 0.0], atol=1e-9)


def test_a_motion_that_starts_off_its_supports_runs_whole():
    problem = shaken(soil_block(steps=20))
    loading = problem.loading
    t, motion = loading.curves[1]
    jumped = replace(loading, curves=(loading.curves[0], (t, motion + 0.1)))
    history = integrate_reduced(replace(problem, loading=jumped), 1e-3)
    assert history.loop == "condensed"
    assert "initial motion" in str(history.reduction.refused)


def test_energy_balances_with_edges_and_a_moving_base():
    problem = shaken(with_edges(soil_block(words=("CISAILLEMENT_ELASTIQUE",), steps=400)))
    exact, history = integrate(problem), integrate_reduced(problem, 1e-4)
    assert history.loop == "reduced"
    scale = np.abs(history.energies).max()
    assert np.abs(history.imbalance - exact.imbalance).max() < 1e-3 * scale


def test_damping_is_split_into_rayleigh_and_rows():
    problem = with_edges(soil_block(steps=2))
    T = problem.constraints.T
    K, M, C = (sp.csr_array(T.T @ X @ T) for X in (problem.K, problem.M, problem.C))
    parts = split(C, M, K, 400)
    assert (parts.alpha, parts.beta) == pytest.approx((0.5, 2e-3), rel=1e-9)
    V = np.random.default_rng(1).standard_normal((5, C.shape[0]))
    wanted = V @ (C - parts.alpha * M - parts.beta * K).toarray() @ V.T
    for given in (parts, replace(parts, few=None)):
        rows, sense = given.on(V)
        np.testing.assert_allclose(rows.T @ (sense[:, None] * rows), wanted, rtol=1e-9, atol=1e-6)


def test_square_roots_keep_the_sign():
    A = np.array([[2.0, 1.0, 0.0], [1.0, -3.0, 0.0], [0.0, 0.0, 0.0]])
    rows, sense = square_roots(A)
    assert rows.shape == (2, 3)
    assert sorted(sense) == [-1.0, 1.0]
    np.testing.assert_allclose(rows.T @ (sense[:, None] * rows), A, atol=1e-14)


def test_states_are_orthonormal_and_hold_all_that_was_added():
    """Also one nearly along those before it."""
    random, states, added = np.random.default_rng(4), States(3.0), []

    def whole(u, w):
        return np.concatenate([np.pad(x, ((0, 7 - len(x)), (0, 0))) for x in (u, w)])

    near = np.pad(first := random.normal(size=(4, 2)), ((0, 1), (0, 0)))
    near = near + 1e-7 * random.normal(size=near.shape)
    for u, old in ((first, None), (near, 1e-7 * first), (random.normal(size=(7, 2)), near)):
        states.add(u, old)
        added.append(whole(u, u) - (0.0 if old is None else whole(0.0 * old, old / 3.0)))
    Q = np.hstack([whole(*block) for block in states.blocks])
    np.testing.assert_allclose(Q.T @ Q, np.eye(6), atol=1e-13)
    A = np.hstack(added)
    np.testing.assert_allclose(Q @ (Q.T @ A), A, atol=1e-12)


@pytest.mark.parametrize("seed", [0, 2, 5])
def test_states_that_hang_together_count_once(seed):
    """Squared lengths would have told 1e-8 alone from rounding."""
    random, states = np.random.default_rng(seed), States(2.0)
    u = random.normal(size=(30, 4))
    states.add(np.hstack([u, u @ random.normal(size=(4, 3))]), None)
    Q = np.concatenate(states.last)
    np.testing.assert_allclose(Q.T @ Q, np.eye(4), atol=1e-13)
    states.add(u @ random.normal(size=(4, 2)), None)
    assert states.last.shape == (2, 30, 0)


def test_dashpots_are_eliminated_from_the_interface():
    random = np.random.default_rng(2)
    r, q, d, dt = 7, 2, 3, 0.01
    Rt, sense = random.standard_normal((r, q + d)), np.array([1.0, 1.0, -0.2])
    m, c, k = random.uniform(1, 2, (3, r)) * np.array([[1.0], [0.1], [300.0]])
    scheme = Scheme(0.0, 0.1, 0.3025, 0.6)
    none = np.zeros((0, r))
    step = reduced_step(
        Reduced(m, c, k, Rt, sense, none, np.zeros((q, 0))), newmark_of(scheme, dt), q
    )
    J, B = Rt.T[:q], Rt.T[q:]
    C = np.diag(c) + B.T @ (sense[:, None] * B)
    rate = 0.9 * 0.6 / (0.3025 * dt)
    A = np.diag(m) / (0.3025 * dt**2) + rate * C + 0.9 * np.diag(k)
    np.testing.assert_allclose(step.condensed.S, J @ np.linalg.solve(A, J.T), rtol=1e-10)


@pytest.mark.parametrize("edges", [True, False])
def test_space_matches_the_response_at_its_shift_and_beside(edges):
    """Its vectors are orthonormal; the shift is four times the lowest frequency."""
    problem = with_edges(soil_block(steps=2)) if edges else soil_block(steps=2, damping=None)
    basis = Basis(problem, 5e-3, 441)
    basis.grow()
    model, T = basis.model(), problem.constraints.T
    length = basis.vectors @ (basis.N @ basis.vectors.T)
    np.testing.assert_allclose(length, np.eye(basis.size), atol=1e-13)
    closed = closed_stiffness(problem).toarray()
    squared = la.eigh(closed, basis.M.toarray(), eigvals_only=True, subset_by_index=[0, 0])
    assert basis.shift == pytest.approx(4 * np.sqrt(squared[0]), rel=1e-2)
    K, M, C = (np.asarray((T.T @ X @ T).todense()) for X in (problem.K, problem.M, problem.C))
    J = (problem.interface.J @ T).toarray()
    for s, near in ((basis.shift, 1e-8), (0.95 * basis.shift, 1e-5)):
        exact = J @ np.linalg.solve(K + s * C + s**2 * M, J.T)
        small = np.diag(model.k + s * model.c + s**2 * model.m)
        small += s * model.B.T @ (model.sense[:, None] * model.B)
        found = model.J @ np.linalg.solve(small, model.J.T)
        assert relative(found, exact) < near
