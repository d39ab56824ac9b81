"""Where the runs of a sweep go: the cores of this machine, or a Dask cluster."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Any

from ssilang.cli.sweeping.worker import Task, run_task

Row = dict[str, Any]


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


def run_here(
    tasks: Sequence[Task], jobs: int, work: Callable[[Task], Row] = run_task
) -> Iterator[Row]:
    """Rows as they come, from `jobs` processes; a process that dies costs its own run alone."""
    waiting = list(tasks)
    while waiting:
        with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
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
