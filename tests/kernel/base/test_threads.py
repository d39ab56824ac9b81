"""Parts of arrays side by side: all rows once, and what one thread finds."""

import os
import signal
import threading

import numpy as np
import pytest

from ssilang.kernel.base import threads


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
