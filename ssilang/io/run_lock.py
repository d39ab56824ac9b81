"""One run at a time in an output folder.

A run holds the file `.running` of its output folder, which says who runs there. The system lets go
of it when the process ends, however it ends: what a run that was killed leaves behind is taken over
by the next one, which also removes the files that it had begun. Another machine's run is known by
what it wrote there alone; whether it goes on cannot be seen from here.
"""

from __future__ import annotations

import json
import os
import re
import socket
import stat
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ssilang.io.errors import OutputError
from ssilang.system import AT_ONCE, GUARDED, POSIX, lock, read_at, write_at

NAME = ".running"
_PART = re.compile(r"\..+\.[a-z0-9_]{8}\.part")
_TRIES = 20


@dataclass
class RunLock:
    """A run's hold on its output folder, until `release`."""

    path: Path
    handle: int

    def is_held(self) -> bool:
        """Whether the folder is still the one in which the run began."""
        try:
            there = self.path.stat()
        except OSError:
            return False
        return os.path.samestat(there, os.fstat(self.handle))

    def release(self) -> None:
        """Let another run have the folder."""
        held = self.is_held()
        with suppress(OSError):
            if held:
                self.path.unlink()
        os.close(self.handle)
        if held and not POSIX:  # Windows removes no file that is open: not ours, nor the next run's
            with suppress(OSError):
                self.path.unlink()


def hold(folder: Path) -> RunLock | None:
    """Hold an output folder; None where that cannot be done, such as where nothing can be written.

    Raises
    ------
    OutputError
        If another run holds it.
    """
    path = folder / NAME
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
    for _ in range(_TRIES):
        try:
            handle = os.open(path, os.O_RDWR | os.O_CREAT | GUARDED | AT_ONCE, 0o666)
        except OSError:
            return None
        found = RunLock(path, handle)
        try:
            lock(handle)
        except BlockingIOError:
            who = _who(handle)
            os.close(handle)
            raise _refused(path, who) from None
        except OSError:  # a system or a file system without locks
            os.close(handle)
            return None
        if found.is_held():  # else the run before removed it just now
            return _taken(found)
        os.close(handle)
    return None


def _taken(held: RunLock) -> RunLock:
    """The lock with our name in it; what a killed run has left is removed."""
    before = _who(held.handle)
    if before.get("host", socket.gethostname()) != socket.gethostname():
        os.close(held.handle)
        raise _refused(held.path, before)
    if before:
        _remove_parts(held.path.parent)
    text = json.dumps({"pid": os.getpid(), "host": socket.gethostname()}) + "\n"
    with suppress(OSError):  # a full disk: it is held all the same
        os.ftruncate(held.handle, 0)
        write_at(held.handle, text.encode(), 0)
    return held


def _who(handle: int) -> dict[str, Any]:
    """Process and host that a lock names; nothing if it names none."""
    try:
        made = json.loads(read_at(handle, 1000, 0))
        return {"pid": int(made["pid"]), "host": str(made["host"])}
    except (OSError, ValueError, LookupError, TypeError):
        return {}


def _refused(path: Path, who: dict[str, Any]) -> OutputError:
    host = who.get("host", "")
    return OutputError(
        "io.folder-in-use",
        folder=path.parent,
        pid=who.get("pid", "?"),
        host=host,
        elsewhere=path if host not in ("", socket.gethostname()) else "",
    )


def _remove_parts(folder: Path) -> None:
    """Remove the files that a killed run had begun, but not those of runs in folders below."""
    for place, folders, files in os.walk(folder):
        folders[:] = [d for d in folders if not os.path.lexists(os.path.join(place, d, NAME))]
        for name in filter(_PART.fullmatch, files):
            path = os.path.join(place, name)
            with suppress(OSError):
                if stat.S_ISREG(os.lstat(path).st_mode):
                    os.unlink(path)
