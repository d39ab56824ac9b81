"""Iterators that are drained side by side."""

import threading

import pytest

from ssilang.kernel.base.threads import side_by_side


@pytest.fixture(params=["1", "2"])
def threads(request, monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    monkeypatch.setenv("OMP_NUM_THREADS", request.param)


def test_all_that_iterators_give_comes_in_their_order(threads):
    assert side_by_side([iter(range(k)) for k in (3, 0, 5, 1)]) == [
        [*range(k)] for k in (3, 0, 5, 1)
    ]
    assert side_by_side([]) == []


def test_two_go_on_at_once(monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    monkeypatch.setattr("ssilang.kernel.base.threads.cores", lambda: 2)
    meet = threading.Barrier(2, timeout=5)
    assert side_by_side([(meet.wait() * 0 for _ in range(2)) for _ in range(2)]) == [[0, 0], [0, 0]]


def test_an_error_ends_the_others(threads):
    def endless():
        while True:
            yield 0

    def failing():
        yield 1
        raise KeyError("broken")

    with pytest.raises(KeyError, match="broken"):
        side_by_side([failing(), endless()])
