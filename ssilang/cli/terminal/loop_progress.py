"""Where a long REPE loop is, on the last line of a terminal; nothing elsewhere."""

import io
import os
import shutil
import time
from dataclasses import dataclass, field
from typing import TextIO, cast

from ssilang.language.run.session import Session
from ssilang.messages.message import Teller

PATIENCE = 2.0  # seconds that a loop may run before anything shows
REFRESH = 0.2


@dataclass(slots=True)
class _Loop:
    name: str
    limit: int | None
    started: float
    turn: int = 0

    def __str__(self) -> str:
        return f"{self.name} {self.turn}" + (f"/{self.limit}" if self.limit is not None else "")


@dataclass
class LoopProgress:
    """Follows the open loops of a run; every text that is printed wipes the line first.

    Parameters
    ----------
    stream : text stream
        The terminal.
    told : function
        Makes texts of codes.
    """

    stream: TextIO
    told: Teller
    _open: list[_Loop] = field(default_factory=list)
    _shown: float = 0.0
    _visible: bool = False

    def enter(self, name: str, limit: int | None) -> None:
        """A loop begins."""
        self._open.append(_Loop(name, limit, time.monotonic()))

    def turn(self, number: int) -> None:
        """The innermost loop begins a turn."""
        self._open[-1].turn = number
        now = time.monotonic()
        if now - self._shown < REFRESH or now - self._open[0].started < PATIENCE:
            return
        self._shown = now
        line = " > ".join(str(loop) for loop in self._open) + self._left(self._open[0], now)
        width = min(shutil.get_terminal_size().columns, 80) - 1
        self.wipe()
        self._visible = True  # before it is: Ctrl-C may come between
        self.stream.write("\r" + line[:width])
        self.stream.flush()

    def leave(self) -> None:
        """The innermost loop ends."""
        self._open.pop()
        if not self._open:
            self.wipe()

    def _left(self, loop: _Loop, now: float) -> str:
        """The time that the outermost loop still needs, if it says how many turns it makes."""
        done = loop.turn - 1
        spent = now - loop.started
        if loop.limit is None or not done:
            return f", {spent:.0f} s"
        seconds = spent * (loop.limit - done) / done
        return ", " + self.told("operators.session.time-left", seconds=seconds)

    def wipe(self) -> None:
        """Take the line away."""
        if self._visible:
            self.stream.write("\r\x1b[K")
            self.stream.flush()
            self._visible = False


class _Wiping(io.TextIOBase):
    """A text stream that takes the progress line away before it writes."""

    def __init__(self, stream: TextIO, progress: LoopProgress) -> None:
        self._stream = stream
        self._progress = progress

    def write(self, text: str) -> int:
        self._progress.wipe()
        return self._stream.write(text)

    def flush(self) -> None:
        self._stream.flush()

    def isatty(self) -> bool:
        return self._stream.isatty()


def follow_loops(session: Session, terminal: TextIO) -> None:
    """Show the loops of a session on `terminal`, if it is one."""
    if not terminal.isatty() or os.environ.get("TERM") == "dumb":
        return
    progress = LoopProgress(terminal, session.told)
    session.loops = progress
    session.out = cast(TextIO, _Wiping(session.out, progress))
    tell = session.on_warning
    if tell is not None:

        def warn(warning: object) -> None:
            progress.wipe()
            tell(warning)

        session.on_warning = warn
