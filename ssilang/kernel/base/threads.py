"""Work on parts of arrays, on all processors that the process may use.

Each part is calculated as if it were alone, so that the number of threads changes no number.
"""

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import takewhile
from threading import Event
from typing import TypeVar

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.system import after_fork, cores

T = TypeVar("T")
LEAST = 200_000  # numbers that a thread must have to read before it is worth waking


def thread_count() -> int:
    """Processors of the process; OMP_NUM_THREADS limits them, as it does the libraries'."""
    own = cores()
    said = os.environ.get("OMP_NUM_THREADS", "").split(",")[0]
    return max(1, min(own, int(said))) if said.isdigit() else own


@cache
def _threads(count: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(count, "ssilang")


after_fork(_threads.cache_clear)  # a forked process has none of these threads


def in_parts(work: Callable[[int, int], None], ends: IntArray) -> None:
    """Call `work(low, high)` until all rows are covered, side by side if there is enough to do.

    Parameters
    ----------
    work : callable
        Must leave other threads running: a function of `compiled_threaded`.
    ends : array (n_rows + 1,)
        Where the numbers of each row start, so that parts are of the same size.
    """
    n, size = len(ends) - 1, int(ends[-1])
    count = min(thread_count(), size // LEAST)
    if count <= 1:
        work(0, n)
        return
    cuts = np.searchsorted(ends, np.linspace(0.0, size, count + 1))[1:-1].tolist()
    list(_threads(count).map(work, [0, *cuts], [*cuts, n]))


def begun(work: Callable[[], T]) -> Callable[[], T]:
    """What gives the result of some work: begun on another processor, if there is one."""
    count = thread_count()
    return work if count == 1 else _threads(count).submit(work).result


def side_by_side(iterators: Sequence[Iterator[T]]) -> list[list[T]]:
    """All that each iterator gives, several at once where BLAS leaves processors to them.

    An error or an interruption ends all of them.
    """
    ended = Event()

    def drained(iterator: Iterator[T]) -> list[T]:
        return list(takewhile(lambda _: not ended.is_set(), iterator))

    count = thread_count() if os.environ.get("OPENBLAS_NUM_THREADS") == "1" else 1
    jobs = [_threads(count).submit(drained, iterator) for iterator in iterators]
    try:
        return [job.result() for job in jobs]
    finally:
        ended.set()
