"""Workers that go on from the first run: what it left in memory is theirs, and held once.

The first run of a long sweep is made in a process of its own, the trunk. It leaves imported
modules, compiled code and the factors of the model's matrices, which are found again by content.
The other runs are made in forks of it, that share this memory until they write to it.
"""

import gc
import os
from collections.abc import Iterator, Sequence
from multiprocessing.connection import wait
from typing import Any

from ssilang.cli.sweeping.pool import FreshContext, run_here
from ssilang.cli.sweeping.worker import Row, Task, Work, lost_row, row_anyhow, run_task
from ssilang.system import CAN_FORK

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
    if rest:
        yield from run_here(rest, jobs, work)


def _received(receiver: Any, sentinel: int) -> Iterator[Row]:
    """What the trunk sends, until it says that it is done or is no more."""
    while receiver in wait([receiver, sentinel]):
        try:
            row = receiver.recv()
        except EOFError:
            return
        if row is None:
            return
        yield row


def _grow(tasks: list[Task], jobs: int, work: Work, sender: Any) -> None:
    """The trunk: one run, then the others in forks."""
    try:
        sender.send(row_anyhow(tasks[0], work))
        gc.freeze()  # collections in a fork would copy the memory that it shares
        for row in run_here(tasks[1:], jobs, work, "fork"):
            sender.send(row)
        sender.send(None)
    except (BrokenPipeError, KeyboardInterrupt):
        os._exit(1)
