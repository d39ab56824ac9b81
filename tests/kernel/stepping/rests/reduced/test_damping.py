"""Reduced models with dashpots and undamped parts against the whole one."""

from dataclasses import replace

import numpy as np
import pytest
from references.recorder import Recorder
from references.soil_block import soil_block

from ssilang.kernel.base.sparse import sp
from ssilang.kernel.stepping.newmark import Scheme, generalised_alpha, hht, newmark_of
from ssilang.kernel.stepping.rests.reduced.damping import split, square_roots
from ssilang.kernel.stepping.rests.reduced.loop import Reduced, reduced_step
from ssilang.kernel.stepping.rests.reduced.run import _PAIRS, integrate_reduced
from ssilang.kernel.stepping.run import integrate

RHO, YOUNG = 1900.0, 8e7  # of the soil of `soil_block`, Poisson's ratio 0.3
VS = np.sqrt(YOUNG / 2.6 / RHO)
VP = VS * np.sqrt(3.5)


@pytest.fixture(autouse=True)
def no_bases_of_other_tests():
    _PAIRS.clear()


def relative(found, exact):
    return float(np.abs(found - exact).max() / np.abs(exact).max())


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


def shaken(problem, height=0.06):
    """The base moves by a curve; the inertia forces that shook it are taken off."""
    loading = problem.loading
    t = loading.curves[1][0]
    forces, imposed = loading.forces.copy(), np.zeros((problem.constraints.C.shape[0], 2))
    forces[:, 1] = 0.0
    rows = abs(problem.constraints.C)[:, problem.numbering.where("UX")].sum(axis=1)
    imposed[np.asarray(rows).ravel() > 0, 1] = 1.0
    motion = height * np.sin(4 * np.pi * t) * np.minimum(1.0, 2 * t) ** 3
    curves = (loading.curves[0], (t, motion))
    return replace(problem, loading=replace(loading, forces=forces, imposed=imposed, curves=curves))


def both(problem, tolerance):
    whole, reduced = Recorder(len(problem.times)), Recorder(len(problem.times))
    exact = integrate(problem, [whole])
    return whole, exact, reduced, integrate_reduced(problem, tolerance, [reduced])


def check(problem, tolerance, energy=10.0):
    whole, exact, reduced, history = both(problem, tolerance)
    found = history.reduction
    assert found.refused is None
    assert history.loop == "reduced"
    assert 0 < found.vectors <= 0.5 * len(whole.of("u")[0])
    assert found.estimate <= tolerance
    assert whole.of("w")[..., 1].max() > 1e-4  # it lifts off
    errors = [relative(reduced.of(x), whole.of(x)) for x in ("u", "w")]
    assert max(errors) <= tolerance
    assert max(errors) <= 2 * found.estimate
    scale = np.abs(exact.energies).max()
    assert np.abs(history.energies - exact.energies).max() <= energy * tolerance * scale


MODELS = {"two dampings": lambda scheme: with_block_damped(soil_block(scheme=scheme), 0.4)}
SCHEMES = {"average": Scheme(), "HHT": hht(0.1), "generalised alpha": generalised_alpha(0.8)}


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("scheme", SCHEMES)
def test_true_error_is_below_the_estimate_and_the_tolerance(model, scheme):
    check(MODELS[model](SCHEMES[scheme]), 1e-4)


def test_an_undamped_block():
    check(with_block_damped(soil_block(), 0.0), 2e-3)


def test_supports_that_move_run_whole():
    problem = shaken(soil_block(steps=20))
    off = soil_block(steps=20)
    off.u[:] = off.constraints.particular(np.full(off.constraints.C.shape[0], 1e-3))
    for given in (problem, off):
        history = integrate_reduced(given, 1e-3)
        assert history.loop == "condensed"
        assert "supports move" in str(history.reduction.refused)


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


def test_dashpots_are_eliminated_from_the_interface():
    random = np.random.default_rng(2)
    r, q, d, dt = 7, 2, 3, 0.01
    Rt, sense = random.standard_normal((r, q + d)), np.array([1.0, 1.0, -0.2])
    m, c, k = random.uniform(1, 2, (3, r)) * np.array([[1.0], [0.1], [300.0]])
    scheme = Scheme(0.0, 0.1, 0.3025, 0.6)
    none = np.zeros((0, r))
    step = reduced_step(Reduced(m, c, k, Rt, sense, none), newmark_of(scheme, dt), q)
    J, B = Rt.T[:q], Rt.T[q:]
    C = np.diag(c) + B.T @ (sense[:, None] * B)
    rate = 0.9 * 0.6 / (0.3025 * dt)
    A = np.diag(m) / (0.3025 * dt**2) + rate * C + 0.9 * np.diag(k)
    np.testing.assert_allclose(step.condensed.S, J @ np.linalg.solve(A, J.T), rtol=1e-10)
