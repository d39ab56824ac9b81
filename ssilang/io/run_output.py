"""What one run reads and writes: its folders, its pictures, its series, the list of its files."""

import errno
import json
import os
import re
import socket
import stat
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

from ssilang.io import atomic
from ssilang.io.errors import OutputError
from ssilang.io.plots.figure import Pictures
from ssilang.io.recording import Recording
from ssilang.messages.message import Sentence
from ssilang.system import AT_ONCE, GUARDED, POSIX, lock, read_at, system_reason, write_at

if TYPE_CHECKING:
    from ssilang.io.checkpoint import Checkpoints, Deck
    from ssilang.io.vtk.series import Series

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


def link_to(folder: Path) -> Path | None:
    """The first link on the way to a folder whose name the user has not given; None without."""
    return next((p for p in (*reversed(folder.parents), folder) if p.is_symlink()), None)


def hold(folder: Path) -> RunLock | None:
    """Hold an output folder; None where that cannot be done, such as where nothing can be written.

    Raises
    ------
    OutputError
        If another run holds it, or a link has taken its place.
    """
    path = folder / NAME
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
    if not _is_no_link(folder):
        raise OutputError("io.output-folder-gone", folder=folder)
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


_SHOWN = 60  # letters of a name in a message
_FLUSH_EVERY = 1.0  # seconds: a loop that adds lines does not rewrite the file at each turn


@dataclass
class RunOutput:
    """Files of one run.

    Parameters
    ----------
    directory : Path
        Output folder (`--out`); everything is written below it. It is made by the first file.
    inputs : Path
        Folder of the script; files are read below it or below `directory`.
    allowed : tuple of Path
        Further folders that may be read and written (`--allow`).

    Attributes
    ----------
    files : list of Path
        Files written so far, each once, in order.
    pictures : Pictures
        Numbers and writes DESS's and TRAC's pictures.
    series : dict of Path to Series
        VTK series that the run has begun, by their path without extension.
    opened : dict of str to object
        What an option's file holds since OPTI named it ('SORT': lines, 'ACQU': values left);
        forgotten when OPTI names it again.
    lock : RunLock or None
        Keeps other runs out of `directory`.
    deck : function or None
        Says whose run it is, if it runs a deck.
    resume : bool
        Whether it goes on from what an earlier run of the deck kept.
    read : list of Path
        Files that were read and that the run has not written, each once.
    recording : Recording or None
        What is taken down for a report, if one was asked for.
    """

    directory: Path
    inputs: Path
    allowed: tuple[Path, ...] = ()
    files: list[Path] = field(default_factory=list)
    series: "dict[Path, Series]" = field(default_factory=dict)
    opened: dict[str, Any] = field(default_factory=dict)
    lock: RunLock | None = None
    deck: "Callable[[], Deck] | None" = None
    resume: bool = False
    read: list[Path] = field(default_factory=list)
    recording: Recording | None = None
    _pending: dict[Path, list[str]] = field(default_factory=dict, repr=False)
    _flushed_at: float = 0.0

    def __post_init__(self) -> None:
        self.directory, self.inputs = atomic.resolved(self.directory), atomic.resolved(self.inputs)
        self.allowed = tuple(map(atomic.resolved, self.allowed))
        self.pictures = Pictures(self.directory)

    def target(self, name: str) -> Path | None:
        """Where a file of that name is written; None if that place is forbidden.

        Raises
        ------
        OutputError
            For a name that no file can have, or if the output folder is gone.
        """
        path = _place(self.directory, name)
        if not POSIX and (reason := atomic.fault_on_windows(name)):
            raise OutputError("io.no-such-place", name=_shown(name), reason=reason)
        self.check()
        return path if self._within(path, (self.directory, *self.allowed)) else None

    def source(self, name: str) -> Path | None:
        """The file of that name to read; None if that place is forbidden.

        A file that this run has written is preferred to one of the same name beside the script;
        failing both, one that another case has left in its own folder beside the output folder
        (a deck that goes on from the SAUV of the deck before).

        Raises
        ------
        OutputError
            For a name that no file can have.
        """
        self.flush()
        written = _place(self.directory, name)
        path = _place(self.inputs, name)
        roots = (self.directory, self.inputs, *self.allowed)
        if written in self.files or (not path.exists() and written.exists()):
            path = written
        if not self._within(path, roots):
            return None
        if not path.exists():
            path = self._of_another_case(name.strip()) or path
        if path not in self.files and path not in self.read:
            self.read.append(path)
        return path

    def is_foreign(self, path: Path) -> bool:
        """Whether a file that may be read is another case's output."""
        return not self._within(path, (self.directory, self.inputs, *self.allowed))

    def _of_another_case(self, name: str) -> Path | None:
        """The latest file of that name in the output folder of another run."""
        results = self.directory.parent
        places = [s.parent for s in results.glob("*/summary.json")]
        paths = [(place, _place(place, name)) for place in places]
        found = [p for place, p in paths if p.is_file() and p.is_relative_to(place)]
        return max(found, key=lambda p: p.stat().st_mtime, default=None)

    @staticmethod
    def _within(path: Path, roots: tuple[Path, ...]) -> bool:
        return any(path.is_relative_to(root) for root in roots)

    @cached_property
    def checkpoints(self) -> "Checkpoints | None":
        """Where the run keeps calculations on their way; None if it runs no deck."""
        from ssilang.io.checkpoint import FOLDER, Checkpoints

        if self.deck is None:
            return None
        return Checkpoints(self.directory / FOLDER, self.deck(), self.resume)

    def forget_checkpoints(self) -> None:
        """The deck has come to its end: what was kept on the way is needed no more."""
        if "checkpoints" in vars(self) and self.checkpoints is not None:
            self.checkpoints.forget()

    def reopen(self, option: str) -> None:
        """OPTI names the file of an option: what was begun there is finished."""
        self.flush()
        self.opened.pop(option, None)

    def add_lines(self, option: str, path: Path, lines: list[str]) -> None:
        """Append lines to a text file that begins empty after each OPTI.

        The file is written whole, at once if the last writing is some time ago, else later.
        """
        text = self.opened.setdefault(option, [])
        text += lines
        self._pending[path] = text
        self.wrote(path)
        if monotonic() - self._flushed_at > _FLUSH_EVERY:
            self.flush()

    def flush(self) -> None:
        """Write the text files that have grown."""
        for path in list(self._pending):
            atomic.write_text(path, "".join(line + "\n" for line in self._pending.pop(path)))
        self._flushed_at = monotonic()

    def begin_series(
        self, path: Path, constants: Mapping[str, float], *, one_file: bool = False
    ) -> "Series":
        """A new VTK series, finished when the run ends: one .vtkhdf, or .vtu files and a list."""
        from ssilang.io.vtk.series import SeriesWriter
        from ssilang.io.vtk.vtkhdf import VtkHdfWriter

        kind: type[Series] = VtkHdfWriter if one_file else SeriesWriter
        writer = kind(path, constants=constants)
        self.keep_series(writer)
        return writer

    def keep_series(self, writer: "Series") -> None:
        """Let a series be finished when the run ends, in place of one of that name."""
        before = self.series.get(writer.base)
        if before is not None and before is not writer:
            before.release()
        self.series[writer.base] = writer

    def wrote(self, *paths: Path) -> None:
        """Add files to the list of those written (those that are never written drop out)."""
        self.files += [p for p in dict.fromkeys(paths) if p not in self.files]

    def hold(self) -> None:
        """Keep other runs out of the output folder until `close`.

        Raises
        ------
        OutputError
            If one runs there.
        """
        self.lock = hold(self.directory)

    def check(self) -> None:
        """Check that the output folder is still there.

        Raises
        ------
        OutputError
            If somebody has removed or exchanged it, or put a link in its place.
        """
        if self.lock is not None and not (self.lock.is_held() and _is_no_link(self.directory)):
            raise OutputError("io.output-folder-gone", folder=self.directory)

    def close(self) -> None:
        """Finish what is open: text files and the lists of series.

        Raises
        ------
        OutputError
            If the output folder is gone, or cannot be written to.
        """
        self.check()
        self.flush()
        for writer in self.series.values():
            writer.close()
            self.wrote(*writer.files)

    def release(self) -> None:
        """Let other runs have the output folder, and give the window of pictures back."""
        self.pictures.close()
        if self.lock is not None:
            self.lock.release()
            self.lock = None


def _is_no_link(folder: Path) -> bool:
    return atomic.resolved(folder) == folder


def _place(folder: Path, name: str) -> Path:
    """Where a name leads, through all links."""
    if atomic.names_foreign_drive(name):
        raise OutputError("io.no-such-place", name=_shown(name), reason=Sentence("io.reason-drive"))
    try:
        path = (folder / atomic.portable(name)).resolve()
        with suppress(FileNotFoundError, NotADirectoryError):
            os.lstat(path)
        if any(map(os.path.islink, (path, *path.parents))):  # what resolve leaves is a loop
            raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    except (OSError, ValueError, RuntimeError) as error:
        reason = system_reason(error)
        raise OutputError("io.no-such-place", name=_shown(name), reason=reason) from error
    return path


def _shown(name: str) -> str:
    plain = name.strip().replace("\0", "\\0")
    return plain if len(plain) <= _SHOWN else plain[:_SHOWN] + "..."
