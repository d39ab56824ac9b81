"""Parts of graphs and arrays: against scipy's, all rows once, side by side."""

import os
import signal
import threading

import numpy as np
import pytest
from scipy.sparse.csgraph import connected_components
from together import together

from ssilang.kernel.base import graph, threads
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


def test_parts_cover_all_rows_once_and_are_of_one_size(monkeypatch):
    monkeypatch.setattr(threads, "thread_count", lambda: 3)
    monkeypatch.setattr(threads, "LEAST", 10)
    ends = np.concatenate([[0], np.cumsum([1] * 50 + [10] * 10)])
    seen, sizes = np.zeros(60, int), []

    def part(low, high):
        seen[low:high] += 1
        sizes.append(ends[high] - ends[low])

    threads.in_parts(part, ends)
    assert (seen == 1).all()
    assert len(sizes) == 3
    assert max(sizes) <= 60


def test_little_work_stays_where_it_is():
    where = []
    threads.in_parts(lambda low, high: where.append(threading.get_ident()), np.arange(100))
    assert where == [threading.get_ident()]


def test_what_goes_wrong_in_a_part_is_told(monkeypatch):
    monkeypatch.setattr(threads, "thread_count", lambda: 2)
    monkeypatch.setattr(threads, "LEAST", 1)

    def part(low, high):
        raise ValueError(f"{low}")

    with pytest.raises(ValueError, match="0"):
        threads.in_parts(part, np.arange(9))


def test_the_environment_limits_them(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    assert threads.thread_count() == 1
    monkeypatch.setenv("OMP_NUM_THREADS", "1000000")
    assert 1 <= threads.thread_count() < 1000000
    monkeypatch.setenv("OMP_NUM_THREADS", "many")
    assert threads.thread_count() >= 1


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no processes are forked here")
def test_a_forked_process_has_threads_of_its_own(monkeypatch):
    monkeypatch.setattr(threads, "thread_count", lambda: 2)
    monkeypatch.setattr(threads, "LEAST", 1)
    threads.in_parts(lambda low, high: None, np.arange(9))
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        threads.in_parts(lambda low, high: None, np.arange(9))
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0
