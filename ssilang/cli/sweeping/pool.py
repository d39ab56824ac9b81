"""Where the runs of a sweep go: the cores of this machine, forks of the first run, a Dask cluster.

A long sweep makes runs in a process of its own, the trunk, until one ends well. It leaves imported
modules, compiled code and the factors of the model's matrices, which are found again by content.
The other runs are made in forks of it, that share this memory until they write to it.
"""

import gc
import importlib.util
import os
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from itertools import islice
from multiprocessing import get_context, parent_process, resource_tracker
from multiprocessing.connection import wait
from multiprocessing.context import SpawnContext, SpawnProcess
from types import ModuleType
from typing import Any

from ssilang.cli.sweeping.worker import Row, Task, Work, lost_row, row_anyhow, run_task
from ssilang.system import CAN_FORK, keep_from_closed_pipes

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def one_thread() -> None:
    """Processes started from now on use one thread for linear algebra, if nothing else is asked."""
    for name in ONE_THREAD:
        os.environ.setdefault(name, "1")


def _end_with_parent() -> None:
    """Let this process end when the one that gives it work is no more."""
    parent = parent_process()
    if parent is None:
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


@contextmanager
def elsewhere() -> Iterator[None]:
    """Processes of Python started here import nothing from the working folder."""
    name = "PYTHONSAFEPATH"
    before = os.environ.get(name)
    os.environ[name] = "1"
    try:
        with suppress(AttributeError):  # the one that counts what is shared; not on Windows
            resource_tracker.ensure_running()
        yield
    finally:
        if before is None:
            del os.environ[name]
        else:
            os.environ[name] = before


class _FreshProcess(SpawnProcess):
    """A process that begins empty and does not import the caller's own script.

    Python would import it again in each process: a sweep that stands in a script without a guard
    (`if __name__ == "__main__"`) would begin anew there.
    """

    def start(self) -> None:
        """Start it."""
        main = sys.modules["__main__"]
        sys.modules["__main__"] = ModuleType("__main__")
        try:
            with elsewhere():
                super().start()
        finally:
            sys.modules["__main__"] = main


class FreshContext(SpawnContext):
    """How processes begin empty."""

    Process = _FreshProcess


def can_share() -> bool:
    """Whether processes can wait for each other: a system without /dev/shm has no semaphores."""
    try:
        with elsewhere():  # it starts what counts them
            get_context("spawn").Lock()
    except (ImportError, OSError):
        return False
    return True


def run_alone(tasks: Sequence[Task]) -> Iterator[Row]:
    """Rows as they come, made in this process one after the other."""
    return map(row_anyhow, tasks)


def run_here(
    tasks: Sequence[Task], jobs: int, work: Work = run_task, start: str = "spawn"
) -> Iterator[Row]:
    """Rows as they come, from `jobs` processes; a process that dies costs its own run alone.

    Parameters
    ----------
    start : str
        How processes begin: empty ('spawn') or with the memory of this one ('fork').
    """
    keep_from_closed_pipes()  # the pool writes to processes that may have died
    waiting = list(tasks)
    context = FreshContext() if start == "spawn" else get_context(start)
    with elsewhere():  # the pool's own queues would start what counts them
        pass
    while waiting:
        with ProcessPoolExecutor(jobs, context, _end_with_parent) as pool:
            futures = {pool.submit(row_anyhow, task, work): task for task in waiting}
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
            yield lost_row(broken.pop(0), "its process was killed (memory?)")
        jobs, waiting = 1, broken


def dask_installed() -> bool:
    """Whether dask.distributed can be used."""
    return importlib.util.find_spec("distributed") is not None


def run_on_cluster(tasks: Sequence[Task], address: str) -> Iterator[Row]:
    """Rows as they come, from the workers of a Dask scheduler that see the same files."""
    import distributed

    cluster: Any = distributed
    with cluster.Client(address) as client:
        futures = {client.submit(row_anyhow, task, pure=False): task for task in tasks}
        for future in cluster.as_completed(futures):
            problem = future.exception()
            lost = problem is not None
            yield lost_row(futures[future], str(problem)) if lost else future.result()


ROUNDS = 4
"""Runs for each job from which the others may wait for the first one."""


def run_all(tasks: Sequence[Task], jobs: int, work: Work = run_task) -> Iterator[Row]:
    """Rows as they come, the way that takes least: forks of the first run, or all at once."""
    if len(tasks) < ROUNDS * jobs or not CAN_FORK:
        return run_here(tasks, jobs, work)
    return run_grown(tasks, jobs, work)


def run_grown(tasks: Sequence[Task], jobs: int, work: Work = run_task) -> Iterator[Row]:
    """Rows of the first run, then of the others from forks of its process.

    If the trunk dies in the first run, that run is lost and the others are made without it.
    """
    spawn = FreshContext()
    receiver, sender = spawn.Pipe(duplex=False)
    trunk = spawn.Process(target=_grow, args=(list(tasks), jobs, work, sender))
    trunk.start()
    sender.close()
    waiting = {task.number: task for task in tasks}
    try:
        for row in _received(receiver, trunk.sentinel):
            del waiting[row["run"]]
            yield row
    finally:
        receiver.close()
        trunk.terminate()  # its forks end with it
        trunk.join()
    rest = list(waiting.values())
    if len(rest) == len(tasks):
        yield lost_row(rest.pop(0), "its process was killed (memory?)")
    yield from run_here(rest, jobs, work)


def _received(receiver: Any, sentinel: int) -> Iterator[Row]:
    """What the trunk sends, until it says that it is done or is no more."""
    with suppress(EOFError):
        while receiver in wait([receiver, sentinel]) and (row := receiver.recv()) is not None:
            yield row


def _grow(tasks: list[Task], jobs: int, work: Work, sender: Any) -> None:
    """The trunk: runs until one ends well, a few at most, then the others in forks."""
    rest = iter(tasks)
    try:
        for row in (row_anyhow(task, work) for task in islice(rest, ROUNDS)):
            sender.send(row)
            if row["exit_code"] == 0:
                break
        gc.freeze()  # collections in a fork would copy the memory that it shares
        for row in run_here(list(rest), jobs, work, "fork"):
            sender.send(row)
        sender.send(None)
    except (BrokenPipeError, KeyboardInterrupt):
        os._exit(1)
