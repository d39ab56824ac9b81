"""Where the runs of a sweep go: the cores of this machine, or a Dask cluster."""

from __future__ import annotations

import importlib.util
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context, parent_process
from multiprocessing.connection import wait
from typing import Any

from ssilang.cli.sweeping.worker import Task, run_task

Row = dict[str, Any]
Work = Callable[[Task], Row]

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def one_thread() -> None:
    """Processes started from now on use one thread for linear algebra, if nothing else is asked."""
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")


def lost_row(task: Task, reason: str) -> Row:
    """The row of a run whose process died."""
    return {
        "run": task.number,
        **task.values,
        "exit_code": 1,
        "seconds": None,
        "error": f"the run was lost: {reason}",
        "folder": task.folder.name,
    }


def _end_with_parent() -> None:
    """Let this process end when the one that gives it work is no more."""
    parent = parent_process()
    if parent is None:
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def run_here(
    tasks: Sequence[Task], jobs: int, work: Work = run_task, start: str = "spawn"
) -> Iterator[Row]:
    """Rows as they come, from `jobs` processes; a process that dies costs its own run alone.

    Parameters
    ----------
    start : str
        How processes begin: empty ('spawn') or with the memory of this one ('fork').
    """
    waiting, context = list(tasks), get_context(start)
    while waiting:
        with ProcessPoolExecutor(jobs, context, _end_with_parent) as pool:
            futures = {pool.submit(work, task): task for task in waiting}
            broken: list[Task] = []
            try:
                for future in as_completed(futures):
                    task = futures[future]
                    try:
                        yield future.result()
                    except BrokenProcessPool:
                        broken.append(task)
                    except Exception as problem:
                        yield lost_row(task, str(problem))
            except (KeyboardInterrupt, GeneratorExit):
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        if not broken:
            return
        if len(broken) == 1 or jobs == 1:  # alone in its pool: this run is the one that dies
            yield lost_row(broken[0], "its process was killed (memory?)")
            waiting = broken[1:]
        else:
            jobs = 1
            waiting = broken


def dask_installed() -> bool:
    """Whether dask.distributed can be used."""
    return importlib.util.find_spec("distributed") is not None


def run_on_cluster(tasks: Sequence[Task], address: str) -> Iterator[Row]:
    """Rows as they come, from the workers of a Dask scheduler that see the same files."""
    import distributed

    cluster: Any = distributed
    with cluster.Client(address) as client:
        futures = {client.submit(run_task, task, pure=False): task for task in tasks}
        for future in cluster.as_completed(futures):
            problem = future.exception()
            yield lost_row(futures[future], str(problem)) if problem else future.result()
