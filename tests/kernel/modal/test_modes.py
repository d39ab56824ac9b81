"""Natural modes against chains of masses and springs, whose frequencies are known exactly."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.linalg as la
from refusing import refusal
from script_runs import ran

from ssilang.kernel.base.errors import KernelError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.matrices.relations import Term, blocked, relation_rows
from ssilang.kernel.matrices.submatrices import together
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.modal import eigen
from ssilang.kernel.modal.modes import (
    _eigenpairs,
    complex_modes,
    eigenvalue,
    modes_between,
    modes_near,
)
from ssilang.kernel.statics import stability
from ssilang.kernel.statics.stability import NUDGE, count_negative, negative_eigenvalues


def springs(table, pairs, k):
    """Springs along UX between pairs of points."""
    values = np.tile(k * np.array([[1.0, -1.0], [-1.0, 1.0]]), (len(pairs), 1, 1))
    return ElementMatrices(table, pairs, np.arange(2), ("UX",) * 2, ("FX",) * 2, values)


def at_points(table, nodes, values, kind="RIGIDITE", names=("UX",)):
    """A matrix (or one number, for UX) at each point by itself."""
    values = np.asarray(values, float).reshape(len(nodes), len(names), len(names))
    duals = tuple("F" + name[1:] for name in names)
    zero = np.zeros(len(names), np.int64)
    return ElementMatrices(table, np.array(nodes)[:, None], zero, names, duals, values, kind)


def chain(n, k=1.0, m=1.0):
    """n masses on a line joined by springs, both ends free; table, stiffness, mass."""
    table = NodeTable()
    ids = table.add(np.column_stack([np.arange(n), np.zeros(n)]))
    stiffness = springs(table, np.column_stack([ids[:-1], ids[1:]]), k)
    mass = at_points(table, ids, np.full(n, m), "MASSE")
    return table, Matrix(table, (stiffness,)), Matrix(table, (mass,), (), "MASSE")


def with_masses(mass, values):
    """The same points with other masses (n, 1, 1)."""
    return Matrix(mass.table, (replace(mass.blocks[0], values=values),), (), "MASSE")


def held(table, stiffness, nodes):
    return together(stiffness, Matrix(table, (), (blocked(table, np.array(nodes), ["UX"]),)))


def fixed_free(n, count, k=1.0, m=1.0):
    """Frequencies of n free masses after a held one, the last one free."""
    j = np.arange(1, count + 1)
    return np.sqrt(k / m) * 2.0 * np.sin((2 * j - 1) * np.pi / (4 * n + 2)) / (2.0 * np.pi)


@pytest.mark.parametrize("n", [12, 700])  # all eigenvalues, and the nearest only
def test_chain_held_at_one_end(n):
    table, K, M = chain(n + 1, 3.0, 0.5)
    modes = modes_near(held(table, K, [0]), M, [(0.0, 4)])
    exact = fixed_free(n, 4, 3.0, 0.5)
    np.testing.assert_allclose([m.frequency for m in modes], exact, rtol=1e-9)
    x = np.arange(1, n + 1)
    for j, mode in enumerate(modes, start=1):
        shape = np.sin((2 * j - 1) * np.pi * x / (2 * n + 1))
        found = mode.shape.values_at("UX", x)
        assert np.abs(found).max() == pytest.approx(1.0)
        cosine = found @ shape / np.linalg.norm(found) / np.linalg.norm(shape)
        assert abs(cosine) == pytest.approx(1.0, abs=1e-9)
        assert mode.mass == pytest.approx(0.5 * found @ found)
        assert mode.along[0] == pytest.approx(0.5 * found.sum())
        assert mode.along[1:] == (0.0, 0.0)


def test_multiplier_of_a_mode_is_the_reaction_at_the_support():
    table, K, M = chain(9, 3.0)
    K = held(table, K, [0])
    mode = modes_near(K, M, [(0.0, 1)])[0]
    # the support pulls the first mass back with -k u1: LX = k u1
    multiplier = mode.shape.values_at("LX", K.relations[0].multipliers)
    np.testing.assert_allclose(multiplier, 3.0 * mode.shape.values_at("UX", np.array([1])))


def test_terms_that_cancel_leave_a_low_frequency_its_value():
    n, soft = 700, 1e-14
    table, K, M = chain(n)
    ground = replace(M.blocks[0], values=np.full((n, 1, 1), soft))
    mode = modes_near(Matrix(table, (*K.blocks, ground)), M, [(1e-4, 1)])[0]
    # 2 + 1E-14 is rounded by up to 2E-16, so the springs by 2 % of the soft ones
    assert eigenvalue(mode.frequency) == pytest.approx(soft, rel=0.05, abs=0.0)


@pytest.mark.parametrize("n", [8, 700])
def test_free_chain_has_its_rigid_motion_first(n):
    _, K, M = chain(n, 3.0, 0.5)
    modes = modes_near(K, M, [(0.0, 3)])
    exact = 2.0 * np.sqrt(6.0) * np.sin(np.arange(3) * np.pi / (2 * n)) / (2.0 * np.pi)
    assert abs(modes[0].frequency) < 1e-4 * exact[1]
    np.testing.assert_allclose([m.frequency for m in modes[1:]], exact[1:], rtol=1e-7)
    np.testing.assert_allclose(modes[0].shape.components["UX"].values, 1.0, rtol=1e-6)


def test_modes_near_several_frequencies_come_sorted_and_are_the_nearest():
    table, K, M = chain(31)
    exact = fixed_free(30, 30)
    modes = modes_near(held(table, K, [0]), M, [(exact[20], 3), (exact[4], 1)])
    np.testing.assert_allclose([m.frequency for m in modes], exact[[4, 19, 20, 21]], rtol=1e-10)


def test_interval_gives_all_modes_inside_and_no_other():
    table, K, M = chain(601)
    exact = fixed_free(600, 600)
    low, high = 0.5 * (exact[9] + exact[10]), 0.5 * (exact[49] + exact[50])
    modes = modes_between(held(table, K, [0]), M, low, high)
    np.testing.assert_allclose([m.frequency for m in modes], exact[10:50], rtol=1e-9)


def test_massless_nodes_follow_statically():
    table, K, M = chain(4, 6.0, 2.0)
    values = M.blocks[0].values.copy()
    values[1:3] = 0.0  # a mass at the end of three springs in series
    light = with_masses(M, values)
    modes = modes_near(held(table, K, [0]), light, [(0.0, 3)])
    assert len(modes) == 1
    assert modes[0].frequency == pytest.approx(np.sqrt(2.0 / 2.0) / (2.0 * np.pi))
    np.testing.assert_allclose(modes[0].shape.values_at("UX", np.array([1, 2])), [1 / 3, 2 / 3])


@pytest.mark.parametrize("limit", [400, 5])  # dense, ARPACK
def test_double_frequencies_are_both_found(limit, monkeypatch):
    monkeypatch.setattr(eigen, "DENSE", limit)
    table, K, M = chain(24)
    ends = relation_rows(table, [Term(1.0, "UX", np.array([0])), Term(-1.0, "UX", np.array([23]))])
    ring = together(K, Matrix(table, (), (ends,)))  # 23 masses in a ring, one of them twice heavy
    values = M.blocks[0].values.copy()
    values[[0, 23]] = 0.5
    even = with_masses(M, values)
    modes = modes_near(ring, even, [(0.0, 5)])
    exact = 2.0 * np.sin(np.pi * np.array([0, 1, 1, 2, 2]) / 23) / (2.0 * np.pi)
    np.testing.assert_allclose([m.frequency for m in modes], exact, rtol=1e-7, atol=1e-5)


def test_a_condition_on_all_masses_is_kept_where_it_cannot_be_eliminated():
    n = 300
    table, K, M = chain(n)
    mean = relation_rows(table, [Term(1.0, "UX", np.array([i])) for i in range(n)])
    modes = modes_near(together(K, Matrix(table, (), (mean,))), M, [(0.0, 2)])
    exact = 2.0 * np.sin(np.arange(1, 3) * np.pi / (2 * n)) / (2.0 * np.pi)
    np.testing.assert_allclose([m.frequency for m in modes], exact, rtol=1e-8)


def test_unstable_system_has_a_negative_frequency():
    table, K, M = chain(2)
    push = at_points(table, [1], [-3.0])
    matrix = together(held(table, K, [0]), Matrix(table, (push,)))
    assert negative_eigenvalues(matrix) == 1
    mode = modes_near(matrix, M, [(0.0, 1)])[0]
    assert mode.frequency == pytest.approx(-np.sqrt(2.0) / (2.0 * np.pi))
    assert eigenvalue(mode.frequency) == pytest.approx(-2.0)


@pytest.mark.parametrize("n", [40, 80])
@pytest.mark.parametrize("shift", [0.5, 2.0])
def test_negative_eigenvalues_of_a_chain_are_counted(n, shift):
    """They are 2 - 2 cos(k pi / (n + 1)) - shift; with a shift of 2 the first pivot is zero."""
    beside = -np.ones(n - 1)
    A = sp.diags_array([beside, np.full(n, 2.0 - shift), beside], offsets=(-1, 0, 1))
    exact = 2.0 - 2.0 * np.cos(np.arange(1, n + 1) * np.pi / (n + 1)) - shift
    assert count_negative(sp.csr_array(A)) == np.count_nonzero(exact < 0.0)


@pytest.mark.parametrize(("pairs", "few"), [(40, True), (41, False)])
def test_pivots_that_vanish_whatever_is_added_leave_the_eigenvalues(monkeypatch, pairs, few):
    """Pairs [[d, 1], [1, d]] have one eigenvalue below zero; d is what each trial takes away."""
    monkeypatch.setattr(stability, "DENSE", 81)
    A = sp.kron(sp.eye_array(pairs), [[0.0, 1.0], [1.0, 0.0]]).tolil()
    A.setdiag(np.tile(np.repeat([0.0, -NUDGE, -100.0 * NUDGE], 2), pairs)[: 2 * pairs])
    A = sp.csr_array(sp.block_diag([A, [[1.0]]]))
    if few:
        assert count_negative(A) == pairs
        return
    with pytest.raises(KernelError, match="without row exchanges"):
        count_negative(A)


def test_nothing_to_vibrate_is_said():
    table, K, M = chain(3)
    with pytest.raises(KernelError, match="hold every unknown"):
        modes_near(held(table, K, [0, 1, 2]), M, [(0.0, 1)])
    with pytest.raises(KernelError, match="mass"):
        modes_near(K, M.scaled(0.0), [(0.0, 1)])


@pytest.mark.parametrize("n", [2, 500])
def test_damped_modes_of_proportional_damping(n):
    table, K, M = chain(n + 1)
    K = held(table, K, [0])
    alpha, beta = 0.02, 0.05
    damping = together(M.scaled(alpha), Matrix(table, K.blocks).scaled(beta))
    exact = fixed_free(n, 2)
    modes = complex_modes(K, M, damping, complex(exact[0]), 2)
    w = 2.0 * np.pi * exact
    xi = 0.5 * (alpha / w + beta * w)
    for mode, wi, x in zip(modes, w, xi, strict=True):
        if x < 1.0:
            assert mode.frequency.real == pytest.approx(wi * np.sqrt(1 - x**2) / 2 / np.pi)
            assert mode.frequency.imag == pytest.approx(wi * x / (2 * np.pi))


def test_damped_modes_under_a_condition_that_is_kept_are_in_balance_and_meet_it():
    """Matrices of no symmetry in common: (mu^2 M + mu C + K) x is a multiple of the condition."""
    random = np.random.default_rng(5)
    K, M, C = (A @ A.T + np.eye(5) for A in random.normal(size=(3, 5, 5)))
    S = random.normal(size=(1, 5))
    given = {k: sp.csr_array(A) for k, A in {"K": K, "M": M, "C": C, "S": S}.items()}
    values, shapes = _eigenpairs(SimpleNamespace(size=5, **given), 0.0, 5)
    assert shapes.shape == (5, 8)
    for mu, x in zip(values, shapes.T, strict=True):
        x = x / np.abs(x).max()
        rest, size = (mu**2 * M + mu * C + K) @ x, np.abs(mu) ** 2 * np.abs(M).max()
        assert np.abs(la.null_space(S).T @ rest).max() < 1e-10 * size
        assert np.abs(S @ x).max() < 1e-10


def test_motions_without_stiffness_and_mass_are_left_out():
    table, K, M = chain(8, 3.0, 0.5)
    slanted = np.array([[0.36, 0.48], [0.48, 0.64]])  # stiff along (0.6, 0.8), idle across
    parts = [
        at_points(table, [3, 4, 5], factor * np.tile(slanted, (3, 1, 1)), kind, ("UY", "UZ"))
        for factor, kind in ((8.0, "RIGIDITE"), (2.0, "MASSE"))
    ]
    K2 = together(held(table, K, [0]), Matrix(table, (parts[0],)))
    M2 = Matrix(table, (*M.blocks, parts[1]), (), "MASSE")
    found = [m.frequency for m in modes_near(K2, M2, [(0.0, 20)])]
    exact = np.sort(np.concatenate([fixed_free(7, 7, 3.0, 0.5), np.full(3, 1.0 / np.pi)]))
    np.testing.assert_allclose(found, exact, rtol=1e-9)


def test_idle_motions_are_told_from_massless_ones_whatever_the_units():
    """A mass that weighs along (0.6, 0.8) alone, held both ways, beside an idle unknown.

    Masses of 1e9 on springs of 1: what tells motions that meet nothing must weigh K and M alike.
    """
    table = NodeTable()
    table.add(np.zeros((2, 3)))
    along = np.array([[0.36, 0.48], [0.48, 0.64]])
    across = np.array([[0.64, -0.48], [-0.48, 0.36]])
    held_both, idle = 2.0 * along + across, np.zeros((2, 2))
    K, M = (
        Matrix(table, (at_points(table, [0, 1], [there, idle], kind, ("UY", "UZ")),), (), kind)
        for there, kind in ((held_both, "RIGIDITE"), (1e9 * along, "MASSE"))
    )
    (mode,) = modes_near(K, M, [(0.0, 5)])
    assert eigenvalue(mode.frequency) == pytest.approx(2e-9, rel=1e-9)


@pytest.mark.parametrize("shift", [0.0, 0.05, 0.12])  # below all modes, and among them
def test_a_grid_of_springs_finds_its_modes_near_any_frequency(shift):
    n, k, m = 40, 3.0, 0.5  # 1600 masses moving across a net, clamped all around
    table = NodeTable()
    x, y = np.meshgrid(np.arange(n + 2.0), np.arange(n + 2.0), indexing="ij")
    ids = table.add(np.column_stack([x.ravel(), y.ravel()])).reshape(x.shape)
    pairs = np.concatenate(
        [np.column_stack([ids[:-1].ravel(), ids[1:].ravel()]),
         np.column_stack([ids[:, :-1].ravel(), ids[:, 1:].ravel()])]
    )  # fmt: skip
    mass = at_points(table, ids.ravel(), np.full(ids.size, m), "MASSE")
    rim = np.setdiff1d(ids, ids[1:-1, 1:-1])
    K = held(table, Matrix(table, (springs(table, pairs, k),)), rim)
    one = 2.0 - 2.0 * np.cos(np.arange(1, n + 1) * np.pi / (n + 1))
    exact = np.sort(np.sqrt(k / m * (one[:, None] + one).ravel())) / (2.0 * np.pi)
    wanted = np.sort(exact[np.argsort(np.abs(exact**2 - shift**2), kind="stable")[:9]])
    found = [
        mode.frequency for mode in modes_near(K, Matrix(table, (mass,), (), "MASSE"), [(shift, 9)])
    ]
    np.testing.assert_allclose(found, wanted, rtol=1e-8)


def test_masses_that_are_all_negative_are_refused_by_their_place():
    table, K, M = chain(3)
    M = with_masses(M, np.array([0.0, -0.25, 0.0]).reshape(3, 1, 1))
    with refusal(KernelError, "kernel.matrices.mass-negative") as caught:
        modes_near(held(table, K, [0]), M, [(0.0, 1)])
    assert caught.value.data["mass"] == -0.25


@pytest.mark.parametrize("limit", [eigen.DENSE, 2], ids=["all", "some"])
@pytest.mark.parametrize("frequency", [0.0, 0.3, 0.62, 1.5])
def test_loads_that_buckle_are_found_below_and_above_the_first(limit, frequency, monkeypatch):
    monkeypatch.setattr(eigen, "DENSE", limit)
    n = 24
    table, stiffness, _ = chain(n, k=0.0)
    stiff, loads = 2.0 + np.arange(n), np.where(np.arange(n) % 3 == 0, -1.0, 1.0)
    ground = at_points(table, np.unique(stiffness.blocks[0].nodes), stiff)
    load = replace(ground, values=loads[:, None, None])  # not a mass, though of its kind
    K, G = Matrix(table, (ground,)), Matrix(table, (load,), (), "MASSE")
    exact = stiff / loads
    nearest = exact[np.argsort(np.abs(exact - eigenvalue(frequency)))][:3]
    found = [eigenvalue(m.frequency) for m in modes_near(K, G, [(frequency, 3)])]
    assert found == pytest.approx(sorted(nearest))


def test_a_load_that_is_negative_throughout_is_no_mistaken_mass():
    table, stiffness, _ = chain(3)
    K = held(table, stiffness, [0])
    pull = Matrix(table, (stiffness.scaled(-1.0).blocks[0],), (), "MASSE")
    (mode,) = modes_near(K, pull, [(0.1, 1)])
    assert eigenvalue(mode.frequency) == pytest.approx(-1.0)


@pytest.mark.parametrize("points", [1, 2])
def test_motions_without_stiffness_and_mass_do_not_hide_the_others(points):
    """An idle rotation at each point: K - s M is singular whatever the shift."""
    text = (
        "OPTI DIME 2 MODE PLAN DEFO ; P1 = 0. 0. ; P2 = 1. 0. ;"
        "K = (RIGI 'DEPL' 8. P1) ET (0. * (RIGI 'ROTA' 1. P1)) ;"
        "M = MASS 'DEPL' 2. P1 ;"
    )
    if points == 2:
        text += (
            "K = K ET (RIGI 'DEPL' 32. P2) ET (0. * (RIGI 'ROTA' 1. P2)) ;"
            "M = M ET (MASS 'DEPL' 2. P2) ;"
        )
    text += "V = VIBR 'PROCHE' (PROG 0.3) K M ; F = V . 'MODES' . 1 . 'FREQUENCE' ;"
    result = ran(text)
    assert result.session.root.find("F") == pytest.approx(2.0 / (2.0 * np.pi), rel=1e-12)
