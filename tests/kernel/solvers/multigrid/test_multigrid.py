"""Multigrid gives the answers of the direct solvers, where memory holds no factor or if asked."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from script_runs import ran

from ssilang.kernel.base import memory
from ssilang.kernel.base.errors import KernelError, SingularFactorError
from ssilang.kernel.base.sparse import sp
from ssilang.kernel.elements import families
from ssilang.kernel.fields.cell_field import CellField, CellFieldBlock
from ssilang.kernel.materials.model import Mode, Zone
from ssilang.kernel.matrices.assembly import assemble, numbering_of
from ssilang.kernel.matrices.matrix import Matrix
from ssilang.kernel.mesh.mesh import CellBlock
from ssilang.kernel.mesh.nodes import NodeTable
from ssilang.kernel.solvers import backends
from ssilang.kernel.solvers.backends import MULTIGRID, factorise
from ssilang.kernel.solvers.cholesky.inverse import invert
from ssilang.kernel.solvers.factor import Ordering
from ssilang.kernel.solvers.multigrid import hierarchy, products, rows
from ssilang.kernel.solvers.multigrid.multigrid import MultigridFactor
from ssilang.kernel.statics.linear_motion import rigid_motions


@pytest.fixture(autouse=True)
def nothing_kept():
    """Factors that runs before this one have kept are not taken."""
    backends.keep_factors(0)


def bar(long=24, wide=4, held=True):
    """Stiffness of a slender block of bricks, held at one end or free, points, rigid motions."""
    table, n = NodeTable(), np.array([long, wide, wide])
    axes = [np.linspace(0.0, k, k + 1) for k in n]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    ids = table.add(points).reshape(n + 1)

    def corner(i, j, k):
        return ids[i : long + i, j : wide + j, k : wide + k].ravel()

    bottom = [corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)]
    top = [corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)]
    block = CellBlock.make(table, "CUB8", np.stack(bottom + top, axis=-1))
    one = np.ones((len(block), 1))
    field = CellField((CellFieldBlock(block, {"YOUN": 1e9 * one, "NU": 0.3 * one}, "STRESSES"),))
    zone = Zone(block, "MECANIQUE", ("ELASTIQUE", "ISOTROPE"), "CUB8", Mode.THREE_DIMENSIONAL)
    matrix = Matrix(table, (families.stiffness(zone, field),))
    numbering = numbering_of(matrix)
    at = numbering.table.coordinates[numbering.nodes]
    kept = np.flatnonzero(at[:, 0] > 0.0) if held else np.arange(numbering.size)
    K = sp.csr_array(assemble(matrix, numbering)[kept][:, kept])
    nodes, motions = numbering.nodes[kept], rigid_motions(numbering)[kept]
    return K, Ordering(at[kept], np.zeros(0, np.int64), motions, nodes)


@pytest.mark.long
@pytest.mark.parametrize("columns", [(), (3,)])
def test_a_slender_cantilever_bends_as_by_a_direct_solver(columns):
    K, order = bar()
    b = np.random.default_rng(0).standard_normal((K.shape[0], *columns))
    exact, found = invert(K, True, "SuperLU"), invert(K, True, MULTIGRID, order)
    assert found.factor.name == MULTIGRID
    x = exact.solve(b)
    np.testing.assert_allclose(found.solve(b), x, atol=1e-8 * np.abs(x).max())


@pytest.mark.long
def test_rigid_motions_make_it_fast(monkeypatch):
    K, order = bar(long=40)
    monkeypatch.setattr("ssilang.kernel.solvers.multigrid.multigrid.MOST_TURNS", 40)
    b = np.random.default_rng(0).standard_normal(K.shape[0])
    MultigridFactor(K, True, order.rigid).solve(b)
    with pytest.raises(KernelError, match="did not converge within 40 turns"):
        MultigridFactor(K, True).solve(b)


def test_a_factor_beyond_memory_gives_way_to_multigrid(monkeypatch):
    K, order = bar(12)
    b = np.random.default_rng(0).standard_normal(K.shape[0])
    direct = invert(K, True, ordering=order)
    monkeypatch.setattr(memory, "available_bytes", lambda: 1e5)
    other = invert(K, True, ordering=order)
    assert (direct.factor.name, other.factor.name) == (backends.DISSECTION, MULTIGRID)
    x = direct.solve(b)
    np.testing.assert_allclose(other.solve(b), x, atol=1e-8 * np.abs(x).max())


def test_motions_of_a_free_body_are_found_and_pinned():
    K, order = bar(8, held=False)
    found = invert(K, True, MULTIGRID, order)
    assert found.kernel.shape == (K.shape[0], 6)
    exact = invert(K, True, "SuperLU")
    b = exact.without_work(np.random.default_rng(0).standard_normal(K.shape[0]))
    assert np.abs(found.work(b)).max() < 1e-12
    forces = K @ found.solve(b)
    np.testing.assert_allclose(forces, b, atol=1e-9 * np.abs(b).max())


def test_a_matrix_that_is_not_positive_ends_with_its_residual():
    K, order = bar(6)
    shifted = sp.csr_array(K - 0.3 * sp.diags_array(K.diagonal()))
    b = np.random.default_rng(0).standard_normal(K.shape[0])
    with pytest.raises(KernelError, match="multigrid did not converge") as caught:
        MultigridFactor(shifted, True, order.rigid, order.nodes).solve(b)
    assert caught.value.data["residual"] > caught.value.data["tolerance"] == 1e-12


def test_conditions_in_a_saddle_point_are_refused():
    K, _ = bar(3)
    row = sp.csr_array(np.eye(1, K.shape[0]))
    saddle = sp.csr_array(sp.block_array([[K, row.T], [row, None]]))
    with pytest.raises(KernelError, match="positive matrices only"):
        invert(saddle, True, MULTIGRID)
    with pytest.raises(KernelError, match="positive matrices only"):
        factorise(K, False, MULTIGRID)
    with pytest.raises(SingularFactorError):
        factorise(saddle, True, MULTIGRID)


def test_free_memory_is_known_here_or_unlimited(monkeypatch, tmp_path):
    assert memory.available_bytes() > 1e6
    (tmp_path / "memory.max").write_text("3000000\n")
    (tmp_path / "memory.current").write_text("1000000\n")
    monkeypatch.setattr(memory, "_GROUP", tmp_path)
    assert memory.available_bytes() <= 2e6
    (tmp_path / "memory.max").write_text("max\n")
    monkeypatch.setattr(memory, "_MACHINE", tmp_path / "none")
    assert memory.fits(1e18)


SCRIPT = """
OPTI DIME 3 MODE TRID ELEM CUB8 ;
P1 = 0. 0. 0. ;
V1 = ((DROI 10 P1 (5. 0. 0.)) TRAN 2 (0. 1. 0.)) VOLU 'TRAN' 2 (0. 0. 1.) ;
MO1 = MODE V1 'MECANIQUE' 'ELASTIQUE' ;
MA1 = MATE MO1 'YOUN' 1.E9 'NU' 0.3 ;
FA1 = V1 POIN 'PLAN' P1 (0. 1. 0.) (0. 0. 1.) ;
P2 = V1 POIN 'PROC' (5. 0. 0.) ;
P3 = V1 POIN 'PROC' (5. 1. 1.) ;
CL1 = (BLOQ 'DEPL' FA1) ET (RELA 'UZ' P2 - 'UZ' P3) ;
U1 = RESO ((RIGI MO1 MA1) ET CL1) (FORC (0. 0. 1.E3) P2) ;
X1 = EXTR U1 'UZ' P3 ;
"""


def test_reso_takes_it_with_its_conditions_eliminated_and_reports_it(monkeypatch, tmp_path):

    monkeypatch.setattr("ssilang.kernel.statics.linear.dissection_pays", lambda n: True)
    found, names = [], []
    for free in (1e12, 1e4):
        monkeypatch.setattr(memory, "available_bytes", lambda free=free: free)
        result = ran(SCRIPT, output_directory=tmp_path)
        found.append(result.session.root.find("X1"))
        names.append(result.session.statistics["systems"][-1]["solver"])
    assert names == [backends.DISSECTION, MULTIGRID]
    assert found[1] == pytest.approx(found[0], rel=1e-9)


def test_a_script_asks_for_it_with_a_tolerance(tmp_path):

    found = {}
    for said in ("'AUTO'", "'MULTIGRILLE'", "'MULTIGRILLE' 1.E-5"):
        result = ran(f"OPTI 'SOLVEUR' {said} ; {SCRIPT}", output_directory=tmp_path)
        found[said] = result.session.root.find("X1")
        name = result.session.statistics["systems"][-1]["solver"]
        assert (name == MULTIGRID) == (said != "'AUTO'")
    exact, fine, coarse = found.values()
    assert fine == pytest.approx(exact, rel=1e-9)
    assert 0.0 < abs(coarse / exact - 1.0) < 1e-3


def test_threads_change_no_bit(monkeypatch):
    K, order = bar(20)
    b = np.random.default_rng(0).standard_normal(K.shape[0])
    found = []
    for count in (1, 3):
        monkeypatch.setattr("ssilang.kernel.base.threads.thread_count", lambda count=count: count)
        monkeypatch.setattr("ssilang.kernel.base.threads.LEAST", 1)
        found.append(MultigridFactor(K, True, order.rigid, order.nodes).solve(b))
    assert np.array_equal(*found)


def test_a_size_and_a_shape_that_multigrid_finds_hard_are_factorised(monkeypatch):
    K, order = bar(12)
    once = replace(order, once=True)
    assert factorise(K, True, ordering=once).name == backends.DISSECTION
    monkeypatch.setattr(backends, "ONCE", 1e4)
    assert factorise(K, True, ordering=once).name == MULTIGRID
    assert factorise(K, True, ordering=order).name == backends.DISSECTION
    monkeypatch.setattr("ssilang.kernel.solvers.multigrid.multigrid.FEW_TURNS", 2)
    assert factorise(K, True, ordering=once).name == backends.DISSECTION


def dense(A, columns):
    """The whole matrix of rows by groups."""
    found = np.zeros((A.first[-1], columns))
    for g, (low, high) in enumerate(pairwise(A.first)):
        own = A.columns[A.ptr[g] : A.ptr[g + 1]]
        assert len(np.unique(own)) == len(own)
        found[low:high, own] = A.values[A.at[g] : A.at[g + 1]].reshape(-1, len(own))
    return found


@pytest.mark.parametrize(("kind", "threads"), [(float, 3), (np.float32, 1)])
def test_rows_of_uneven_groups_act_as_their_dense_matrices(kind, threads, monkeypatch):
    monkeypatch.setattr("ssilang.kernel.base.threads.thread_count", lambda: threads)
    monkeypatch.setattr("ssilang.kernel.base.threads.LEAST", 1)
    rng, k, count = np.random.default_rng(3), 2, 4
    first = np.array([0, 1, 4, 6, 9, 10, 12, 15])
    group = np.repeat(np.arange(7), np.diff(first))
    A = np.where(rng.random((15, 15)) < 0.4, rng.standard_normal((15, 15)), 0) + 4 * np.eye(15)
    A[7], A[:, 7] = 0.0, 0.0  # without stiffness
    D = np.where(group[:, None] == group, A, 0.0) + np.diag(np.arange(15) == 7)
    D = np.linalg.inv(D) - np.diag(np.arange(15) == 7)
    met = np.repeat(rng.random((7, count)) < 0.5, k, axis=1)[group]
    start, wide = (np.where(met, rng.standard_normal(met.shape), 0.0) for _ in range(2))
    R, P, Q = (rows.grouped(sp.csr_array(x), first, kind) for x in (A, start, wide))
    own = rows.diagonal_of(R)
    x, b, d = rng.standard_normal((3, 15)).astype(kind)
    moved = 0.3 * d + 0.7 * D @ (b - A @ x)
    smooth = products.smoothed(R, own, P, k, count, 0.4)
    back, whole = products.Backwards(Q, k, count), dense(smooth, k * count)
    pairs = [
        (dense(R, 15), A), (rows.rest_of(R, x, b), b - A @ x),
        (rows.relaxed(R, own, x, b, d, 0.3, 0.7), x + moved), (d, moved),
        (rows.divided(R, own, b, 3.0), 3.0 * D @ b),
        (whole, start - 0.4 * D @ A @ start),
        (dense(products.product(R, P, k, count), k * count), A @ start),
        (dense(products.galerkin(Q, back, smooth, k), k * count), wide.T @ whole),
        (products.restricted(Q, back, b, k), wide.T @ b),
    ]  # fmt: skip
    for found, wanted in pairs:
        np.testing.assert_allclose(found, wanted, atol=100 * np.finfo(kind).eps)


def test_a_level_is_smoothed_by_chebyshevs_polynomials_of_the_fourth_kind():
    own, largest = np.array([0.1, 0.7, 1.3, 2.4, 2.9]), 3.0
    A = rows.grouped(sp.csr_array(np.diag(own)), np.arange(6), float)
    level = hierarchy.Level(A, rows.Diagonal(np.ones(5), np.arange(6)), largest)
    angle = np.arccos(1.0 - 2.0 * own / largest)
    x, wanted = np.array([[3.0, -1.0, 2.0, 5.0, 4.0], [1.0, 2.0, 3.0, 4.0, -2.0]])
    for degree in (1, 2, 3):
        left = np.sin((degree + 0.5) * angle) / np.sin(angle / 2) / (2 * degree + 1)
        for begun in (None, x):
            found = hierarchy._polynomial(level, begun, own * wanted, degree)
            before = wanted - (0.0 if begun is None else begun)
            np.testing.assert_allclose(wanted - found, left * before, atol=1e-13)


def test_a_coupling_counts_from_a_fiftieth_of_both_own_matrices():
    """Of the geometric mean of their norms, sqrt(13) and 5."""
    A = np.diag([2.0, 3.0, 3.0, 4.0, 1.0])
    for share, joined in ((0.8, False), (1.2, True)):
        size = share * np.sqrt(5.0 * np.sqrt(13.0)) / 50.0
        A[[0, 2], [2, 0]], A[[1, 3], [3, 1]] = 0.6 * size, 0.8 * size
        R = rows.grouped(sp.csr_array(A), np.array([0, 2, 4, 5]), float)
        found, count = hierarchy.aggregates_of(R)
        assert (found.tolist(), count) == (([0, 0, -1], 1) if joined else ([-1, -1, -1], 0))


def test_unknowns_of_one_node_go_together():
    K, order = bar(6)
    turned = MultigridFactor(K, True, order.rigid, order.nodes)
    apart = MultigridFactor(K, True, order.rigid)
    assert np.diff(turned.hierarchy.levels[0].A.first).max() == 3
    b = np.random.default_rng(0).standard_normal(K.shape[0])
    x = invert(K, True, "SuperLU").solve(b)
    for found in (turned, apart):
        np.testing.assert_allclose(found.solve(b), x, atol=1e-9 * np.abs(x).max())
    assert turned.turns <= apart.turns
    A = turned.hierarchy.levels[0].A
    start, motions = hierarchy.tentative(A, *hierarchy.aggregates_of(A), order.rigid)
    whole = dense(start, len(motions))
    np.testing.assert_allclose(whole @ motions, order.rigid, atol=1e-5)
    np.testing.assert_allclose(whole.T @ whole, np.diag(motions.any(axis=1)), atol=1e-5)
