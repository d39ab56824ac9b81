"""Assembly: against dense sums written out by hand, and the triplet list."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from together import together

from ssilang.kernel.base.errors import FieldError
from ssilang.kernel.base.sparse import assemble_triplets
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import (
    assemble,
    constraint_matrix,
    field_to_vector,
    is_symmetric,
    may_be_positive,
    numbering_of,
    outside,
    vector_to_field,
)
from ssilang.kernel.matrices.gathered_rows import assemble_rows
from ssilang.kernel.matrices.matrix import ElementMatrices, Matrix, Relations
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
    with pytest.raises(
        FieldError, check=lambda e: e.code == "kernel.matrices.matrix-unknowns-numbering-lacks"
    ):
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


@pytest.mark.parametrize("copies", [1, 2])
def test_rows_that_push_elsewhere_stay_so_beside_others_and_their_copies(table, copies):
    def rows(node, name, value, mark):
        return Relations(table, np.array([0, 1]), np.array([node]), (name,), np.array([value]),
                         np.array([mark]), np.array([0], np.int8))  # fmt: skip

    plain, second = rows(0, "UX", 2.0, 4), rows(2, "UX", 3.0, 5)
    turned = replace(second, dual=rows(1, "UX", -7.0, 5))
    chained = chain(table, np.array([0, 1, 2]), 1.0)
    again = tuple(replace(r) for r in (turned, plain)) * (copies - 1)
    whole = Matrix(table, chained.blocks, (plain, turned, *again))
    C, multipliers, _, D = constraint_matrix(whole)
    np.testing.assert_allclose(C.toarray(), [[2, 0, 0], [0, 0, 3]])
    np.testing.assert_allclose(D.toarray(), [[2, 0, 0], [0, -7, 0]])
    assert list(multipliers) == [4, 5]
    assert not is_symmetric(whole)
    assert is_symmetric(Matrix(table, chained.blocks, (plain, second, replace(plain))))
    C, _, _, D = constraint_matrix(Matrix(table, chained.blocks, (plain, second, replace(plain))))
    assert D is C
    np.testing.assert_allclose(C.toarray(), [[2, 0, 0], [0, 0, 3]])


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
