"""Parts of graphs against scipy's, and links of rows and entries."""

import numpy as np
from scipy.sparse.csgraph import connected_components
from together import together

from ssilang.kernel.base import graph
from ssilang.kernel.base.graph import chains, entries, parts_of
from ssilang.kernel.base.sparse import sp


@together("links", [0, 20, 60, 400])
@together("at_once", [7, 1 << 21])
def test_parts_are_those_of_scipy_numbered_as_they_appear(links, at_once, monkeypatch):
    monkeypatch.setattr(graph, "AT_ONCE", at_once)
    ends = np.random.default_rng(links).integers(0, 100, (2, links))
    found = parts_of(100, ends)
    matrix = sp.coo_array((np.ones(links), (ends[0], ends[1])), shape=(100, 100))
    count, exact = connected_components(matrix, directed=False)
    assert found.max() + 1 == count
    assert len(set(zip(found, exact, strict=True))) == count
    _, first = np.unique(found, return_index=True)
    assert (np.diff(first) > 0).all()


def test_a_chain_in_any_order_is_one_part():
    order = np.random.default_rng(1).permutation(5000)
    assert (parts_of(5000, (order[1:], order[:-1])) == 0).all()
    assert parts_of(0).shape == (0,)


def test_links_are_added_up():
    assert parts_of(5, (np.array([3]), np.array([1])), np.array([[1], [4]])).tolist() == [
        0, 1, 2, 1, 1,
    ]  # fmt: skip


def test_rows_chain_what_they_couple_and_zeros_couple_nothing():
    A = sp.csr_array(np.array([[1.0, 0.0, 2.0, 3.0], [0.0, 5.0, 0.0, 0.0], [0.0, 4.0, 0.0, 1.0]]))
    A.data[1] = 0.0
    assert [tuple(link) for link in zip(*chains(A), strict=True)] == [(0, 3), (1, 3)]
    assert parts_of(4, chains(A)).tolist() == [0, 0, 1, 0]
    row, column = entries(A)
    assert row.tolist() == [0, 0, 1, 2, 2]
    assert column.tolist() == [0, 3, 1, 1, 3]
