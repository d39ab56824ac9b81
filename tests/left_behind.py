"""What of the process a test may not leave changed, nor a file open in the temporary folder."""

import gc
import os
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

MEANT = {"PYTEST_CURRENT_TEST", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"}
"""Of the environment: a sweep lets all processes that come later have one thread."""
SIGNALS = signal.SIGINT, signal.SIGTERM
USUAL = {signal.SIG_DFL, signal.SIG_IGN, signal.default_int_handler}
"""What answers them elsewhere; a mesher changes the one for the other."""


def state() -> dict[str, Any]:
    """What code must put back that has changed it."""
    return {
        "folder": Path.cwd(),
        "environment": {k: v for k, v in os.environ.items() if k not in MEANT},
        "faults of numbers": np.geterr(), "print of arrays": np.get_printoptions(),
        "search for garbage": (gc.isenabled(), gc.get_threshold()), "modules": list(sys.path),
        "signals": [h for h in map(signal.getsignal, SIGNALS) if h not in USUAL],
        "errors": sys.excepthook, "closed pipes end it": closed_pipes_end_it(),
    }  # fmt: skip


def closed_pipes_end_it() -> bool:
    """Whether the process ends where it writes to a pipe that nobody reads, as the system tells."""
    status = Path("/proc/self/status")
    ignored = status.read_text().partition("SigIgn:")[2].split()[0] if status.exists() else "ffff"
    return not int(ignored, 16) >> (13 - 1) & 1


def open_files() -> set[str]:
    """Files of the temporary folder that the process holds open, where the system tells.

    Those of an environment that stands there are its own: drawing keeps fonts open.
    """
    found, shown = set(), Path("/proc/self/fd")
    for place in shown.iterdir() if shown.is_dir() else ():
        with suppress(OSError):
            found.add(os.readlink(place))
    found = {name for name in found if not name.startswith(sys.prefix)}
    return {name for name in found if name.startswith(tempfile.gettempdir())}


@pytest.fixture(autouse=True, scope="module")
def nothing_is_left_behind() -> Iterator[None]:
    before, held = state(), open_files()
    yield
    now = state()
    changed = {k: (before[k], v) for k, v in now.items() if v != before[k]}
    assert changed == {}, changed
    if open_files() - held:
        gc.collect()  # what circles of objects hold is closed with them
    assert open_files() - held == set()
