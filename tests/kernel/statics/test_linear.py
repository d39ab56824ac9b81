"""Linear statics with conditions, against dense systems and closed forms; dissected; prestress."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from refusing import refusal
from scipy.optimize import brentq
from scipy.sparse import csr_array
from together import together

from ssilang.cli.run import run_text
from ssilang.kernel.base.errors import ConvergenceError, KernelError, MeshError, SingularMatrixError
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import (
    assemble,
    constraint_matrix,
    field_to_vector,
    imposed_values,
    numbering_of,
)
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.solvers import backends
from ssilang.kernel.statics import linear
from ssilang.kernel.statics.linear import (
    SolveOptions,
    linear_system,
    product,
    reactions,
    solve,
    stabilised,
)
from ssilang.kernel.statics.prestress import NO_LOSSES, Cable, Losses, cables_of, tensions

SADDLE = SolveOptions(eliminate=False)


def whole(K, C=None, sense=None, table=None, D=None):
    """One element of all unknowns (UX at each node) and rows C given densely."""
    n = len(K)
    table = table or NodeTable()
    ids = table.add(np.arange(n, dtype=float)[:, None])
    symmetric = bool(np.allclose(K, K.T))
    names = (("UX",) * n, ("FX",) * n)
    block = ElementMatrices(
        table, ids[None, :], np.arange(n), *names, np.asarray(K, float)[None], symmetric=symmetric
    )
    if C is None:
        return Matrix(table, (block,))
    multipliers = table.add(np.zeros((len(C), 1)))
    sense = np.zeros(len(C), np.int8) if sense is None else np.asarray(sense, np.int8)
    dual = None if D is None else _rows(table, ids, D, multipliers, sense, None)
    return Matrix(table, (block,), (_rows(table, ids, C, multipliers, sense, dual),))


def _rows(table, ids, C, multipliers, sense, dual):
    r, c = np.nonzero(C)
    start = np.concatenate([[0], np.cumsum(np.count_nonzero(C, axis=1))])
    return Relations(table, start, ids[c], ("UX",) * len(c), C[r, c], multipliers, sense, dual)


def load(matrix, f, d=None):
    """Second member with forces f at the unknowns and values d at the rows."""
    parts = dict(NodeField.of(matrix.table, np.arange(len(f)), {"FX": np.asarray(f)}).components)
    if d is not None:
        nodes = matrix.relations[0].multipliers
        parts |= NodeField.of(matrix.table, nodes, {"FLX": np.asarray(d, float)}).components
    return NodeField(matrix.table, parts, "DISCRET")


def vectors(matrix, field):
    u = field_to_vector(field, numbering_of(matrix), dual=False)
    return u, field.values_at("LX", constraint_matrix(matrix).multipliers)


def spd(rng, n):
    A = rng.normal(size=(n, n))
    return A @ A.T + n * np.eye(n)


def chain(n, k=1.0):
    """n nodes in a row joined by springs."""
    K = k * (2.0 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    K[0, 0] = K[-1, -1] = k
    return K


@settings(max_examples=80, deadline=None)
@given(st.integers(2, 12), st.integers(0, 10**6), st.sampled_from([0.2, 0.5, 1.0]))
def test_elimination_and_saddle_point_agree_with_the_dense_kkt_system(n, seed, density):
    rng = np.random.default_rng(seed)
    K, m = spd(rng, n), int(rng.integers(1, n))
    C = rng.normal(size=(m, n)) * (rng.random((m, n)) < density)
    C[np.arange(m), rng.permutation(n)[:m]] += 1.0
    if np.linalg.matrix_rank(C) < m:
        return
    f, d = rng.normal(size=n), rng.normal(size=m)
    exact = np.linalg.solve(np.block([[K, C.T], [C, np.zeros((m, m))]]), np.concatenate([f, d]))
    matrix = whole(K, C)
    for options in (SolveOptions(), SADDLE):
        u, multipliers = vectors(matrix, *solve(matrix, [load(matrix, f, d)], options))
        np.testing.assert_allclose(u, exact[:n], atol=1e-7 * np.abs(exact).max())
        np.testing.assert_allclose(multipliers, exact[n:], atol=1e-6 * np.abs(exact).max())


@settings(max_examples=60, deadline=None)
@given(st.integers(2, 8), st.integers(0, 10**6))
def test_unilateral_rows_meet_signs_and_complementarity(n, seed):
    rng = np.random.default_rng(seed)
    m = int(rng.integers(1, n + 1))
    K, C, sense = spd(rng, n), rng.normal(size=(m, n)), rng.choice([-1, 0, 1], m)
    f, d = rng.normal(size=n) * n, rng.normal(size=m)
    matrix = whole(K, C, sense)
    u, multipliers = vectors(matrix, *solve(matrix, [load(matrix, f, d)]))
    gap, side = C @ u - d, np.where(sense == 0, 1, sense)
    # rows that nearly depend on one another carry great forces: all bounds are shares of them
    pushed = max(1.0, np.abs(K @ u).max(), np.abs(multipliers).max())
    moved = max(1.0, np.abs(u).max())
    np.testing.assert_allclose(K @ u + C.T @ multipliers, f, rtol=0, atol=1e-9 * pushed)
    assert np.abs(gap[sense == 0]).max(initial=0.0) < 1e-8 * moved
    assert (side * gap)[sense != 0].min(initial=0.0) > -1e-8 * moved
    assert (side * multipliers)[sense != 0].max(initial=0.0) < 1e-8 * pushed
    assert np.abs(gap * multipliers).max() < 1e-9 * moved * pushed


def test_support_settlement_of_two_springs():
    matrix = whole(chain(3, 6.0), np.array([[1.0, 0, 0], [0, 0, 1.0]]))
    field = solve(matrix, [load(matrix, [0.0, 0.0, 0.0], [0.0, 2.0])])[0]
    u, multipliers = vectors(matrix, field)
    np.testing.assert_allclose(u, [0.0, 1.0, 2.0], atol=1e-14)
    support = reactions(matrix, field)
    np.testing.assert_allclose(support.values_at("FX", np.array([0, 2])), [-6.0, 6.0])
    assert len(support.components["FX"].nodes) == 2
    np.testing.assert_allclose(multipliers, [6.0, -6.0])


def test_product_gives_back_the_second_member():
    rng = np.random.default_rng(4)
    matrix = whole(spd(rng, 5), rng.normal(size=(2, 5)))
    given_load = load(matrix, rng.normal(size=5), rng.normal(size=2))
    back = product(matrix, solve(matrix, [given_load])[0])
    for name, part in given_load.components.items():
        np.testing.assert_allclose(back.values_at(name, part.nodes), part.values, atol=1e-10)


def test_several_second_members_use_one_factor():
    matrix = whole(chain(4), np.array([[1.0, 0, 0, 0]]))
    fields = solve(matrix, [load(matrix, [0, 0, 0, 1.0]), load(matrix, [0, 0, 0, 2.0])])
    assert len([k for k in matrix.cache if k.startswith("linear")]) == 1
    np.testing.assert_allclose(vectors(matrix, fields[1])[0], [0, 2, 4, 6], atol=1e-12)


def test_loaded_free_body_is_refused_by_name():
    matrix = whole(chain(4))
    with pytest.raises(SingularMatrixError, match="translation along X") as caught:
        solve(matrix, [load(matrix, [0, 0, 0, 1.0])])
    assert "UX at node" in caught.value.hint


def test_an_unknown_without_stiffness_is_named():
    K = chain(3)
    K[2, :] = K[:, 2] = 0.0
    K[1, 1] = 1.0
    matrix = whole(K, np.array([[1.0, 0, 0]]))
    with pytest.raises(SingularMatrixError) as caught:
        solve(matrix, [load(matrix, [0, 0, 1.0])])
    assert "UX at node 3" in caught.value.hint


def test_balanced_loads_on_a_free_body_are_solved_and_others_projected_on_demand():
    matrix = whole(chain(3))
    u = vectors(matrix, *solve(matrix, [load(matrix, [-1.0, 0, 1.0])]))[0]
    np.testing.assert_allclose(np.diff(u), [1.0, 1.0], atol=1e-12)
    free = solve(matrix, [load(matrix, [0.0, 0, 3.0])], SolveOptions(project=True))
    u = vectors(matrix, *free)[0]
    np.testing.assert_allclose(np.diff(u), [1.0, 2.0], atol=1e-10)


def test_a_cantilever_of_a_thousand_beams_is_not_taken_for_singular():
    n, length = 1000, 1.0
    k = np.array(
        [[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]], dtype=float
    ) * np.outer([1, length] * 2, [1, length] * 2)
    table = NodeTable()
    ids = table.add(np.arange(n + 1, dtype=float)[:, None])
    pairs = np.column_stack([ids[:-1], ids[1:]])
    names = ("UY", "RZ", "UY", "RZ"), ("FY", "MZ", "FY", "MZ")
    values = np.broadcast_to(k, (n, 4, 4)).copy()
    block = ElementMatrices(table, pairs, np.array([0, 0, 1, 1]), *names, values)
    held = Relations(
        table,
        np.array([0, 1, 2]),
        ids[[0, 0]],
        ("UY", "RZ"),
        np.ones(2),
        table.add(np.zeros((2, 1))),
        np.zeros(2, np.int8),
    )
    matrix = Matrix(table, (block,), (held,))
    tip = NodeField.of(table, ids[-1:], {"FY": np.ones(1)})
    u = solve(matrix, [tip])[0]
    assert u.values_at("UY", ids[-1:])[0] == pytest.approx(n**3 / 3.0, rel=1e-3)


def test_contradicting_values_are_refused_and_equal_ones_accepted():
    matrix = whole(chain(2), np.array([[1.0, 0], [1.0, 0]]))
    with pytest.raises(KernelError, match="contradict"):
        solve(matrix, [load(matrix, [0, 1.0], [0.0, 1.0])])
    u = vectors(matrix, *solve(matrix, [load(matrix, [0, 1.0], [1.0, 1.0])]))[0]
    np.testing.assert_allclose(u, [1.0, 2.0])


def test_a_mean_value_condition_holds_a_free_body():
    n = 300
    matrix = whole(chain(n), np.ones((1, n)))
    f = np.zeros(n)
    f[0], f[-1] = -1.0, 1.0
    u, multipliers = vectors(matrix, *solve(matrix, [load(matrix, f)]))
    assert abs(u.mean()) < 1e-10
    np.testing.assert_allclose(np.diff(u), 1.0, atol=1e-8)
    np.testing.assert_allclose(multipliers, 0.0, atol=1e-9)


def test_a_block_resting_on_stops_lifts_off_where_it_is_pulled():
    # two nodes joined by a spring, each above a stop; nothing else holds them
    matrix = whole(chain(2, 10.0), np.eye(2), [1, 1])
    u, multipliers = vectors(matrix, *solve(matrix, [load(matrix, [-3.0, 1.0])]))
    np.testing.assert_allclose(u, [0.0, 0.1], atol=1e-12)
    np.testing.assert_allclose(multipliers, [-2.0, 0.0], atol=1e-12)
    with pytest.raises(
        ConvergenceError, check=lambda e: e.code == "kernel.statics.held-by-contact-alone"
    ):
        solve(matrix, [load(matrix, [-1.0, 3.0])])
    taken = SolveOptions(unilateral=False)
    u = vectors(matrix, *solve(matrix, [load(matrix, [-1.0, 3.0])], taken))[0]
    np.testing.assert_allclose(u, 0.0, atol=1e-14)


def test_a_remote_force_controls_a_displacement():
    # non-associated relation: u1 <= 1 is kept by a force at node 2 (bars of stiffness 1 and 0.5)
    K = np.array([[1.0, -1, 0], [-1, 1.5, -0.5], [0, -0.5, 0.5]])
    C, D = np.array([[0.0, 1, 0], [1, 0, 0]]), np.array([[0.0, 0, 1], [1, 0, 0]])
    matrix = whole(K, C, [-1, 0], D=D)
    u, multipliers = vectors(matrix, *solve(matrix, [load(matrix, [0, 0, 2.0], [1.0, 0.0])]))
    np.testing.assert_allclose(u, [0.0, 1.0, 3.0], atol=1e-12)
    assert multipliers[0] == pytest.approx(1.0)
    exact = whole(K, C, [0, 0], D=D)
    u = vectors(exact, *solve(exact, [load(exact, [0, 0, 0.5], [1.0, 0.0])]))[0]
    np.testing.assert_allclose(u, [0.0, 1.0, 3.0], atol=1e-12)


def test_unsymmetric_matrix_with_a_stop():
    K, C = np.array([[2.0, 0.0], [1.0, 3.0]]), np.array([[0.0, 1.0]])
    matrix = whole(K, C, [1])
    f = K @ [1.0, 2.0]
    for stop, expected in ((1.9, [1.0, 2.0]), (2.2, [1.0, 2.2])):
        u = vectors(matrix, *solve(matrix, [load(matrix, f, [stop])]))[0]
        np.testing.assert_allclose(u, expected, atol=1e-12)


def test_stabilised_solution_of_an_indefinite_matrix_is_positive():
    K = np.array([[1.0, 0.0], [0.0, -1.0]])
    matrix = whole(K)
    u = vectors(matrix, *solve(matrix, [load(matrix, [1.0, 1.0])], SolveOptions(stabilise=True)))
    assert (u[0] > 0.0).all()
    plain = vectors(matrix, *solve(matrix, [load(matrix, [1.0, 1.0])]))[0]
    np.testing.assert_allclose(plain, [1.0, -1.0])
    bordered = np.array([[1.0, 0, 1], [0, -1, 0], [1, 0, 0]])  # the row of a multiplier stays
    added = stabilised(csr_array(bordered), 2).toarray() - bordered
    np.testing.assert_allclose(added, np.diag([10.0, 10.0, 0.0]))


def test_reused_values_of_conditions_come_from_the_field():
    matrix = whole(chain(3), np.array([[1.0, 0, 0]]))
    d = imposed_values(load(matrix, [0, 0, 0], [0.5]), constraint_matrix(matrix).multipliers)
    np.testing.assert_allclose(d, [0.5])
    assert assemble(matrix).shape == (3, 3)


def test_what_was_prepared_is_made_anew_when_nodes_were_merged():
    """Two pairs of springs, then the end of one pair on the foot of the other."""
    matrix = whole(np.kron(np.eye(2), [[3.0, -2.0], [-2.0, 2.0]]))
    push = NodeField.of(matrix.table, np.array([1]), {"FX": np.ones(1)})
    for exact in ([1.0, 1.5], [0.4, 0.6]):
        (found,) = solve(matrix, [push])
        np.testing.assert_allclose(found.values_at("UX", np.array([0, 1])), exact)
        matrix.table.merge(np.array([1]), np.array([2]))


def test_rows_whose_force_is_their_own_are_eliminated_beside_others():
    """u1 = 0 is an ordinary row; u2 = d is kept by a force at node 3."""
    K = np.diag([4.0, 4.0, 4.0]) - np.diag([1.0, 1.0], 1) - np.diag([1.0, 1.0], -1)
    C, D = np.eye(3)[:2], np.eye(3)[[0, 2]]
    matrix = whole(K, C, D=D)
    assert list(linear_system(matrix, SolveOptions()).saddle) == [1]
    (found,) = solve(matrix, [load(matrix, [0.0, 0.0, 0.0], [0.0, 0.5])])
    u, _ = vectors(matrix, found)
    np.testing.assert_allclose(u, [0.0, 0.5, 2.0], rtol=1e-12, atol=1e-15)  # row 2: 4 u2 = u3


def test_of_loads_that_are_not_finite_one_is_named():
    matrix = whole(np.eye(3))
    with refusal(KernelError, "kernel.statics.load-not-finite") as refused:
        solve(matrix, [load(matrix, [1.0, np.inf, np.nan])])
    (at,) = refused.value.data["at"]
    assert "UX" in str(at)
    assert "(1." in str(at)


BEAM = """
OPTI DIME 2 MODE PLAN DEFO ELEM QUA4 ;
L = DROI 3 (0. 0.) (0. 1.) ; S = L TRAN 12 (6. 0.) ; P = S POIN 'PROC' (6. 1.) ;
MO = MODE S 'MECANIQUE' 'ELASTIQUE' ; MA = MATE MO 'YOUN' 2.E9 'NU' 0.3 ;
CL = {conditions} ;
U = RESO ((RIGI MO MA) ET CL) (FORC (0. -1.E4) P) ;
MESS (EXTR U 'UY' P) (EXTR U 'UX' P) (MAXI (REAC CL U)) ;
"""


@together(
    "conditions",
    ["BLOQ 'DEPL' L", "(BLOQ 'DEPL' L) ET (RELA 'UX' P - 'UX' (S POIN 'PROC' (6. 0.)))"],
)
def test_a_beam(conditions, monkeypatch):
    found = []
    for least in (1, 10**9):
        monkeypatch.setattr(backends, "DISSECTED", least)
        used = []
        real = linear.invert

        def spy(*given, used=used, real=real):
            inverse = real(*given)
            used.append(inverse.factor.name)
            return inverse

        monkeypatch.setattr(linear, "invert", spy)
        result = run_text(BEAM.format(conditions=conditions))
        monkeypatch.setattr(linear, "invert", real)
        assert result.exit_code == 0, result.output
        assert used == [backends.DISSECTION if least == 1 else "SuperLU"]
        found.append([float(x) for x in re.findall(r"-?\d\.\d+E?[-+]?\d*", result.output)])
    assert len(found[0]) >= 3
    assert found[0] == pytest.approx(found[1], rel=1e-5)


X = np.cumsum([[0, 0, 0], [2, 0.1, 0], [1.5, 0.4, 0.3], [1, 0.9, 0.2], [2.5, 0.2, -0.4]], axis=0)
CABLE = Cable(np.array([3, 1, 0, 2]), np.array([0, 1, 2, 3, 4]))
STIFF = np.array([2e8, 1.5e8, 2.2e8, 1.8e8])
SECTION = np.array([1e-3, 8e-4, 1.1e-3, 9e-4])


def march(x, force, losses, stiffness):
    """Tensions from the first end: friction bar by bar, then the slip by its definition."""
    legs = np.diff(x, axis=0)
    length = np.linalg.norm(legs, axis=1)
    alpha, s, h = 0.0, 0.0, []
    for k in range(len(legs)):
        if k:
            turn = legs[k] @ legs[k - 1] / (length[k] * length[k - 1])
            alpha += np.arccos(turn)
        h.append(losses.angular * alpha + losses.linear * (s + length[k] / 2))
        s += length[k]
    h = np.array(h)
    T = force * np.exp(-h)
    if not losses.slip:
        return T

    def after(d):
        return np.where(h < d, force * np.exp(-2 * d) * np.exp(h), T)

    def slipped(d):
        return ((T - after(d)) * length / stiffness).sum() - losses.slip

    if slipped(h[-1] + 1e-12) > 0:
        return after(brentq(slipped, 0, h[-1]))
    level = brentq(
        lambda c: ((T - c * np.exp(h)) * length / stiffness).sum() - losses.slip, -force, force
    )
    return np.maximum(level * np.exp(h), 0.0)


@together("slip", [0.0, 5e-4, 5e-3, 0.02, 0.06])
@together("pulled", [(True, False), (False, True), (True, True)])
def test_tensions_are_those_of_the_march_from_each_end_that_is_pulled(slip, pulled):
    losses = Losses(0.2, 0.01, slip, 0.5, 1.6e9, 2.0)
    found = tensions(CABLE, X, pulled, 1.2e6, STIFF, SECTION, losses)
    parts = []
    if pulled[0]:
        parts.append(march(X, 1.2e6, losses, STIFF))
    if pulled[1]:
        parts.append(march(X[::-1], 1.2e6, losses, STIFF[::-1])[::-1])
    T = np.max(parts, axis=0)
    stress = T / SECTION
    loss = 6 * 2.0 / 100 * np.maximum(stress / 1.6e9 - 0.5, 0) * stress
    np.testing.assert_allclose(found, (stress - loss) * SECTION, rtol=1e-9)
    assert (loss > 0).any() or slip > 0.01


def test_without_losses_all_bars_have_the_force():
    found = tensions(CABLE, X, (True, False), 7.0, STIFF, SECTION, NO_LOSSES)
    np.testing.assert_allclose(found, 7.0)


def test_bars_in_any_order_and_sense_are_strung_into_cables():
    nodes = NodeTable()
    nodes.add(np.arange(27.0).reshape(9, 3) ** 1.1)
    cells = np.array([[5, 2], [7, 5], [0, 1], [3, 2], [1, 8]])
    found = {tuple(c.nodes): tuple(c.bars) for c in cables_of(nodes, cells)}
    assert found == {(7, 5, 2, 3): (1, 0, 3), (0, 1, 8): (2, 4)}
    turned = CABLE.turned()
    assert (turned.bars.tolist(), turned.nodes.tolist()) == ([2, 0, 1, 3], [4, 3, 2, 1, 0])
    for bad, match in (([[0, 1], [1, 2], [1, 3]], "branch"), ([[0, 1], [1, 2], [2, 0]], "ring")):
        with pytest.raises(MeshError, match=match):
            cables_of(nodes, np.array(bad))
