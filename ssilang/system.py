"""What systems do and say each in their own way: the one module with names of POSIX alone.

Where a name is missing its substitute stands beside it: Windows' locks for `flock`, a seek and a
write for `pwrite`. Modules and functions that a system may lack are looked up when this module is
loaded, so that a type checker accepts them for every system.
"""

import errno
import faulthandler
import importlib
import os
import re
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ssilang.messages.message import Sentence

if TYPE_CHECKING:
    import socket
    import subprocess


def _module(name: str) -> Any:
    """A module of the standard library; None where the system has none of that name."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


_os: Any = os

POSIX = hasattr(os, "geteuid")
"""Whether files have owners and rights."""
GUARDED = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
"""For `os.open`: no link is followed, no other program gets the file, bytes stay as they are."""
AT_ONCE: int = getattr(os, "O_NONBLOCK", 0)
"""For `os.open`: a pipe that nobody reads is not waited for."""
ENDS = tuple(
    getattr(signal, n) for n in ("SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, n)
)  # fmt: skip
"""Signals by which others let a process end: told to, its terminal gone, its window closed."""
CAN_FORK = hasattr(os, "fork") and sys.platform != "darwin"
"""Whether a process can go on as two; libraries of macOS do not bear it."""

_LOCKED_BYTE = 1 << 30  # far behind what a lock's file holds: Windows lets nobody read it
_PATIENCE, _LOOK = 2.0, 0.05  # s that a file may be held by another program; between two tries


def user_number() -> int:
    """Number of the user as whom the process runs (0 where the system has none)."""
    return int(_os.geteuid()) if POSIX else 0


def cores() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(_os.sched_getaffinity(0))
    return os.cpu_count() or 1


def keep_from_closed_pipes() -> None:
    """Have SIGPIPE answered as Python knows it: ignored, unless a script has said otherwise.

    A library in C (Gmsh, in the caller's process) lets it end the process behind Python's back.
    """
    closed = getattr(signal, "SIGPIPE", None)
    if closed is not None and threading.current_thread() is threading.main_thread():
        signal.signal(closed, signal.getsignal(closed))


def after_fork(function: Callable[[], object]) -> None:
    """Call a function in each process that begins with the memory of this one."""
    if hasattr(os, "register_at_fork"):
        _os.register_at_fork(after_in_child=function)


# ---- files ---------------------------------------------------------------------------------------


def lock(handle: int) -> None:
    """Lock an open file for this process, until it is closed or the process ends.

    Raises
    ------
    BlockingIOError
        If another process has locked it.
    OSError
        If files cannot be locked there.
    """
    fcntl, msvcrt = _module("fcntl"), _module("msvcrt")
    if fcntl is not None:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return
    if msvcrt is None:
        raise OSError("no locks")
    os.lseek(handle, _LOCKED_BYTE, os.SEEK_SET)
    try:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
    except PermissionError as error:
        raise BlockingIOError(*error.args) from error


def write_at(handle: int, data: bytes | memoryview, address: int) -> int:
    """Write bytes at a place of an open file; how many were written."""
    if hasattr(os, "pwrite"):
        return int(_os.pwrite(handle, data, address))
    os.lseek(handle, address, os.SEEK_SET)
    return os.write(handle, data)


def read_at(handle: int, count: int, address: int) -> bytes:
    """Read at most so many bytes at a place of an open file."""
    if hasattr(os, "pread"):
        return bytes(_os.pread(handle, count, address))
    os.lseek(handle, address, os.SEEK_SET)
    return os.read(handle, count)


def replace(made: Path, path: Path) -> None:
    """Put a file in the place of another, which may be held for a short time by another program.

    Windows replaces no file that is open: a scanner, a search, a table in a spreadsheet.

    Raises
    ------
    OSError
        If it cannot be done; PermissionError where the file is held for longer.
    """
    limit = time.monotonic() + _PATIENCE
    while True:
        try:
            os.replace(made, path)
        except PermissionError:
            if time.monotonic() > limit or not path.is_file():
                raise
            time.sleep(_LOOK)
        else:
            return


def usual_rights() -> int:
    """Rights of a file that is made in the usual way."""
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


# ---- memory --------------------------------------------------------------------------------------


def limit_memory(n_bytes: int) -> bool:
    """Let the process hold at most so much; whether the system can."""
    resource = _module("resource")
    if resource is None:
        return False
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    try:
        resource.setrlimit(resource.RLIMIT_DATA, (n_bytes, hard))
    except (OSError, ValueError):  # macOS refuses some
        return False
    return True


def in_bounds(
    work: Callable[[], Any], more: int, longest: float | None, *told: type[Exception]
) -> Any:
    """What a function answers in a process that holds at most so many bytes more than at its start.

    None where it ends, or lasts so many seconds; what it raises of some classes is raised here.
    Libraries make what a file declares, or end. Where there are no forks, the function (one of a
    module, and values that can be pickled) goes to a new Python; some systems bound no memory.
    """
    way = "fork" if CAN_FORK else "spawn"
    context: Any = importlib.import_module("multiprocessing").get_context(way)
    receiver, sender = context.Pipe(duplex=False)
    worker = context.Process(target=_answer, args=(sender, work, more, told), daemon=True)
    with warnings.catch_warnings():  # threads: the fork starts no other of this process
        warnings.simplefilter("ignore", DeprecationWarning)
        worker.start()
    sender.close()
    try:
        found = receiver.recv() if receiver.poll(longest) else None
    except EOFError:
        found = None
    worker.kill()
    worker.join()
    receiver.close()
    if isinstance(found, told):
        raise found
    return found


def _answer(
    sender: Any, work: Callable[[], Any], more: int, told: tuple[type[Exception], ...]
) -> None:
    """Send what a function answers, as another process."""
    faulthandler.disable()
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # what a library says when it ends
    status = Path("/proc/self/status")
    held = re.search(r"VmData:\s*(\d+) kB", status.read_text() if status.is_file() else "")
    limit_memory((1024 * int(held[1]) if held else 0) + more)
    try:
        sender.send(work())
    except told as problem:
        sender.send(problem)


def peak_memory() -> float | None:
    """The most bytes that this process has held; None where the system does not tell."""
    resource = _module("resource")
    if resource is None:
        return None
    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)


def shared_memory(size: int) -> int:
    """A descriptor of so many bytes of memory without a name, which this user alone may open."""
    if hasattr(os, "memfd_create"):
        descriptor = int(_os.memfd_create("ssilang"))
        _os.fchmod(descriptor, 0o600)
    else:  # not on macOS
        import tempfile

        with tempfile.TemporaryFile() as file:
            descriptor = os.dup(file.fileno())
    os.ftruncate(descriptor, size)
    return descriptor


# ---- processes of this machine -------------------------------------------------------------------


def local_socket() -> "socket.socket | None":
    """A socket by which processes of this machine hand each other open files, if it has such."""
    net = _module("socket")
    if not hasattr(net, "AF_UNIX") or not hasattr(net, "send_fds"):
        return None
    return net.socket(net.AF_UNIX, net.SOCK_STREAM)


def is_of_user(connection: "socket.socket") -> bool:
    """Whether this user's process is at the other end, as far as the system tells."""
    net = _module("socket")
    if not hasattr(net, "SO_PEERCRED"):  # not on macOS; the folder keeps others out
        return True
    told = connection.getsockopt(net.SOL_SOCKET, net.SO_PEERCRED, 12)
    return int.from_bytes(told[4:8], sys.byteorder) == user_number()


def end_group(process: "subprocess.Popen[bytes]") -> None:
    """End a process that was started in a session of its own, and those that it started."""
    if hasattr(os, "killpg"):
        with suppress(ProcessLookupError):
            _os.killpg(process.pid, signal.Signals["SIGKILL"])
    else:
        process.kill()


_REASONS = {
    errno.ENOENT: "io.reason-missing",
    errno.EACCES: "io.reason-forbidden",
    errno.EPERM: "io.reason-forbidden",
    errno.EISDIR: "io.reason-folder",
    errno.ENOTDIR: "io.reason-no-folder",
    errno.EEXIST: "io.reason-there-already",
    errno.ENAMETOOLONG: "io.reason-name-too-long",
    errno.ELOOP: "io.reason-links-in-a-ring",
    errno.ENOSPC: "io.reason-disk-full",
    errno.EDQUOT: "io.reason-disk-full",
    errno.EROFS: "io.reason-read-only",
    errno.EFBIG: "io.reason-file-too-large",
    errno.EMFILE: "io.reason-many-files-open",
    errno.ENFILE: "io.reason-many-files-open",
    errno.EIO: "io.reason-device",
    errno.EBADF: "io.reason-stream-closed",
}


def system_reason(error: Exception) -> Sentence | str:
    """The reason of an OSError, or of a ValueError for a name; the system's words if rare."""
    number = getattr(error, "errno", None)
    if number in _REASONS:
        return Sentence(_REASONS[number])
    if isinstance(error, ValueError) and "null" in str(error):
        return Sentence("io.reason-nought-in-a-name")
    return str(getattr(error, "strerror", None) or error)
