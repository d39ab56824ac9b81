"""Where a session in a notebook prints: text as it comes, and the progress of long runs."""

from __future__ import annotations

import io
import re
import time
from collections.abc import Callable

EVERY = 0.1  # seconds between texts that are sent, at least
_CONTROL = re.compile(r"\x1b\[[0-9;]*[A-Za-z]|\r")


class SentText(io.TextIOBase):
    """A stream that sends what is written, gathered for a moment.

    Parameters
    ----------
    send : function
        Sends a text.
    """

    def __init__(self, send: Callable[[str], object]) -> None:
        self._send = send
        self._waiting: list[str] = []
        self._sent = 0.0

    def write(self, text: str) -> int:
        """Take a text."""
        self._waiting.append(text)
        if time.monotonic() - self._sent > EVERY:
            self.flush()
        return len(text)

    def flush(self) -> None:
        """Send what waits."""
        text = "".join(self._waiting)
        self._waiting.clear()
        self._sent = time.monotonic()
        if text:
            self._send(text)


class SentProgress(io.TextIOBase):
    """A terminal of one line, on which loops and calculations say how far they are.

    Parameters
    ----------
    show : function
        Shows a line in place of the one before; '' takes it away.
    """

    def __init__(self, show: Callable[[str], object]) -> None:
        self._show = show
        self._shown = ""

    def isatty(self) -> bool:
        """Yes: lines of progress appear on terminals alone."""
        return True

    def write(self, text: str) -> int:
        """Show a line; one of blanks wipes it."""
        line = _CONTROL.sub("", text).strip()
        if line != self._shown:
            self._shown = line
            self._show(line)
        return len(text)
