"""Assembly: against dense sums by hand and the triplet list; points found in their cells."""

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from refusing import refusal
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.sparse import assemble_triplets
from ssilang.kernel.elements.shapes.reference import REFERENCE_CELLS, shape_functions
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import (
    assemble,
    field_to_vector,
    may_be_positive,
    numbering_of,
    outside,
    vector_to_field,
)
from ssilang.kernel.matrices.gathered_rows import assemble_rows
from ssilang.kernel.matrices.location import locate
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix
from ssilang.kernel.mesh.mesh import CellBlock, Mesh
from ssilang.kernel.mesh.nodes import NodeTable


def chain(table, nodes, stiffness, unknown="UX", dual="FX"):
    """Springs between successive nodes."""
    pairs = np.column_stack([nodes[:-1], nodes[1:]])
    k = np.broadcast_to(np.asarray(stiffness, float), (len(pairs),))
    values = k[:, None, None] * np.array([[1.0, -1.0], [-1.0, 1.0]])
    block = ElementMatrices(table, pairs, np.array([0, 1]), (unknown,) * 2, (dual,) * 2, values)
    return Matrix(table, (block,))


@pytest.fixture
def table():
    t = NodeTable()
    t.add(np.arange(6.0)[:, None])
    return t


def test_springs_in_series_assemble_to_the_textbook_matrix(table):
    matrix = chain(table, np.array([2, 0, 4]), [3.0, 5.0])
    numbering = numbering_of(matrix)
    assert list(numbering.nodes) == [0, 2, 4]
    K = assemble(matrix).toarray()
    np.testing.assert_allclose(K, [[8, -3, -5], [-3, 3, 0], [-5, 0, 5]])
    assert assemble(matrix) is assemble(matrix)


def test_one_numbering_serves_matrices_with_different_unknowns(table):
    k = chain(table, np.array([0, 1]), 2.0)
    m = chain(table, np.array([1, 2]), 7.0, "UY", "FY")
    numbering = numbering_of(k, m)
    assert [str(numbering.label(i)) for i in range(4)] == [
        "UX at node 1 (0. 0.)",
        "UX at node 2 (1. 0.)",
        "UY at node 2 (1. 0.)",
        "UY at node 3 (2. 0.)",
    ]
    assert assemble(k, numbering).shape == (4, 4)
    assert assemble(m, numbering).toarray()[2, 3] == -7.0
    with refusal(FieldError, "kernel.matrices.matrix-unknowns-numbering-lacks"):
        assemble(m, numbering_of(k))


def test_merging_nodes_afterwards_joins_their_unknowns(table):
    matrix = chain(table, np.array([0, 1]), 2.0)
    other = chain(table, np.array([3, 4]), 5.0)
    both = Matrix(table, matrix.blocks + other.blocks)
    assert numbering_of(both).size == 4
    table.merge(np.array([1]), np.array([3]))
    assert numbering_of(both).size == 3
    np.testing.assert_allclose(assemble(both).toarray(), [[2, -2, 0], [-2, 7, -5], [0, -5, 5]])


def test_vector_and_field_are_inverse_of_each_other(table):
    matrix = chain(table, np.array([0, 1, 2]), 1.0)
    numbering = numbering_of(matrix)
    forces = NodeField.of(table, np.array([2, 0, 5]), {"FX": np.array([3.0, 1.0, 9.0])})
    f = field_to_vector(forces, numbering)
    np.testing.assert_allclose(f, [1.0, 0.0, 3.0])
    assert [str(o) for o in outside(forces, numbering)] == ["FX at node 6 (5. 0.)"]
    back = vector_to_field(f, numbering)
    assert back.nature == "DIFFUS"
    np.testing.assert_allclose(field_to_vector(back, numbering, dual=False), f)


@together("own", [[[2.0, 1.0], [1.0, 3.0]], [[1.0, -1.0], [-1.0, 1.0]], [[4.0, 0.0], [0.0, 0.0]]])
def test_matrices_without_a_negative_direction_may_be_positive(own):
    assert np.linalg.eigvalsh(own).min() > -1e-12
    assert may_be_positive(sp.csr_array(np.array(own)))


@together("own", [[[2.0, 3.0], [3.0, 2.0]], [[1.0, 0.0], [0.0, -1.0]], [[0.0, 1.0], [1.0, 5.0]]])
def test_matrices_of_both_signs_are_seen_by_a_minor_or_the_diagonal(own):
    assert np.linalg.eigvalsh(own).min() < -0.1
    assert not may_be_positive(sp.csr_array(np.array(own)))


def compare(places: list[np.ndarray], values: list[np.ndarray], n: int) -> None:
    gathered = assemble_rows(places, values, n)
    triplets = assemble_triplets(places, values, n)
    assert gathered.has_sorted_indices
    assert (gathered.indptr == triplets.indptr).all()
    assert (gathered.indices == triplets.indices).all()
    assert gathered.data == pytest.approx(triplets.data, abs=1e-12)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.lists(st.integers(1, 6), max_size=3))
def test_rows_gathered_equal_triplets(seed: int, n: int, widths: list[int]) -> None:
    random = np.random.default_rng(seed)
    places = [random.integers(0, n, (random.integers(0, 12), m)).astype(np.int32) for m in widths]
    values = [random.standard_normal((len(p), p.shape[1], p.shape[1])) for p in places]
    compare(places, values, n)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([2, 3, 6]), st.integers(1, 4), st.booleans())
def test_unknowns_of_nodes_are_gathered_together(
    seed: int, run: int, nodes: int, by_unknown: bool
) -> None:
    """Some unknowns belong to no node of the block, so that runs start anywhere."""
    random = np.random.default_rng(seed)
    heads = np.cumsum(run + random.integers(0, 3, 9))
    cells = np.stack([random.permutation(heads)[:nodes] for _ in range(random.integers(1, 12))])
    cells = np.sort(cells, axis=1)[:, random.permutation(nodes)]
    rows = [cells + i for i in range(run)]
    places = (
        np.concatenate(rows, axis=1) if by_unknown else np.stack(rows, 2).reshape(len(cells), -1)
    )
    places = places.astype(np.int32)
    values = random.standard_normal((len(cells), run * nodes, run * nodes))
    compare([places], [values], int(heads[-1]) + run + 2)


def test_runs_that_overlap_are_gathered_row_by_row() -> None:
    places = np.array([[0, 1, 2, 3], [1, 2, 3, 4]], dtype=np.int32)
    values = np.arange(32.0).reshape(2, 4, 4)
    compare([places], [values], 5)


KINDS = ("SEG2", "SEG3", "TRI3", "TRI6", "QUA4", "QUA8", "TET4", "TE10", "PYR5", "PRI6", "PR15",
         "CUB8", "CU20")  # fmt: skip
R = np.linalg.qr(np.random.default_rng(2).standard_normal((3, 3)))[0]


def inner(shape, n, rng):
    """Reference points inside a cell."""
    d = {"line": 1, "triangle": 2, "quadrangle": 2}.get(shape, 3)
    x = rng.uniform(-0.95, 0.95, (n, d))
    if shape in ("triangle", "tetrahedron"):
        x = rng.dirichlet(np.ones(d + 1), n)[:, :d]
    elif shape == "prism":
        x[:, :2] = rng.dirichlet(np.ones(3), n)[:, :2]
    elif shape == "pyramid":
        x[:, 2] = rng.uniform(0.05, 0.9, n)
        x[:, :2] *= (1 - x[:, 2:]) * 0.95
    return x


@together("kind", KINDS)
def test_a_point_is_where_the_shape_functions_put_it(kind):
    rng = np.random.default_rng(1)
    cell, table = REFERENCE_CELLS[kind], NodeTable()
    d = cell.nodes.shape[1]
    turn = R if d < 3 else np.eye(3)  # lines and surfaces stand anywhere in space
    corners = []
    for far in (0.0, 6.0):
        x = cell.nodes + rng.uniform(-0.05, 0.05, cell.nodes.shape) * (cell.nodes.shape[0] > 2)
        x = np.column_stack([x, np.zeros((len(x), 3 - d))])
        corners.append((x + np.array([far, 0, 0])) @ turn.T)
    ids = table.add(np.concatenate(corners)).reshape(2, -1)
    block = CellBlock.make(table, kind, ids)
    at = inner(cell.shape, 8, rng)
    shapes = shape_functions(kind, at)
    which = np.array([0, 1] * 4)
    points = np.einsum("pk,pkd->pd", shapes, np.array(corners)[which])
    lost = np.array([[3.2, 0.0, 0.0], [-20.0, 0.0, 0.0]]) @ turn.T
    if d < 3:  # beside its line or surface
        lost = np.concatenate([lost, points[:1] + 0.05 * turn[:, 2]])
    if cell.shape in ("triangle", "tetrahedron", "prism", "pyramid"):  # in the corner of its box
        lost = np.concatenate([lost, [turn @ np.pad(np.full(d, 0.8), (0, 3 - d))]])
    ((cells, found),) = locate(Mesh(table, (block,)), np.concatenate([points, lost]))
    assert cells.tolist() == [*which.tolist(), *[-1] * len(lost)]
    back = np.einsum("pk,pkd->pd", found[:8], np.array(corners)[which])
    np.testing.assert_allclose(back, points, atol=1e-9)
    np.testing.assert_allclose(found[:8], shapes, atol=1e-7)


def test_the_first_block_that_holds_a_point_has_it():
    table = NodeTable()
    x = np.array([[0, 0], [2, 0], [2, 2], [0, 2], [4, 0.0], [4, 2]])
    ids = table.add(x)
    quads = CellBlock.make(table, "QUA4", ids[[[0, 1, 2, 3]]])
    tris = CellBlock.make(table, "TRI3", ids[[[1, 4, 5], [1, 5, 2], [0, 1, 2]]])
    points = np.array([[1, 0.5, 0], [3.5, 0.5, 0], [2.5, 1.5, 0], [2.0, 1.0, 0], [5, 5, 0.0]])
    first, second = locate(Mesh(table, (quads, tris)), points)
    assert first[0].tolist() == [0, -1, -1, 0, -1]
    assert second[0].tolist() == [-1, 0, 1, -1, -1]
    only = locate(Mesh(table, (tris,)), points)[0]
    assert only[0][0] == 2
    assert locate(Mesh(table, (quads,)), points[:0])[0][0].tolist() == []
    near = np.array([[2.0 + 1e-7, 1.0, 0.0], [2.001, 1.0, 0.0]])
    assert locate(Mesh(table, (quads,)), near)[0][0].tolist() == [0, -1]
    assert locate(Mesh(table, (quads,)), near, 0.01)[0][0].tolist() == [0, 0]
