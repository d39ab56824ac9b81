"""Ctrl-C and the end that others ask for, also where a library swallows the interruption.

Python delivers a signal as KeyboardInterrupt in whatever Python code runs next. Behind compiled
code that may be a function which the compiled code calls back, and from there no exception gets
out: it is printed as ignored, and the library fails later over what is missing, or goes on. The
arrival of a signal is therefore kept until somebody has seen it.
"""

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from ssilang.system import ENDS

ENDED_BY_CLOSED_PIPE = 141  # what a shell gives for a tool that SIGPIPE ended: 128 + 13

# signals belong to the process, not to a session
# no locks: a handler would wait for the one that it broke into
_arrived: list[int] = []
_held: list[None] = []  # a first signal waits until somebody looks


def take() -> bool:
    """Whether a signal came since the last call (which counts as having been seen)."""
    seen = bool(_arrived)
    if seen:  # one that comes between these lines stays
        _arrived.clear()
    return seen


@contextmanager
def listening(own: bool = True) -> Iterator[None]:
    """Turn SIGINT, SIGTERM and SIGHUP into KeyboardInterrupt: a run told to end writes its files.

    A hang-up that was ignored before (nohup) is ignored still. In a process that is not our `own`,
    SIGINT alone is listened to.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = [signal.SIGINT]
    for number in ENDS if own else ():
        if number == signal.SIGTERM or signal.getsignal(number) is not signal.SIG_IGN:
            numbers.append(number)
    before = [signal.signal(n, interrupt) for n in numbers]
    ignored, sys.unraisablehook = sys.unraisablehook, _quiet_about_interruptions
    try:
        yield
    finally:
        sys.unraisablehook = ignored
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)


@contextmanager
def holding() -> Iterator[None]:
    """Keep an interruption out while something changes that must be whole: `take` tells of it.

    Whoever insists is heard: a second signal ends what goes on.
    """
    _held.append(None)
    try:
        yield
    finally:
        _held.pop()


def interrupt(number: int, frame: FrameType | None) -> None:
    """A signal's handler."""
    first = not _arrived
    _arrived.append(number)
    if first and _held:
        return
    raise KeyboardInterrupt


def _quiet_about_interruptions(lost: "sys.UnraisableHookArgs") -> None:
    if not issubclass(lost.exc_type, KeyboardInterrupt):  # that one is not lost: see `take`
        sys.__unraisablehook__(lost)
