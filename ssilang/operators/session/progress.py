"""A progress line for long loops: on terminals only, after two seconds."""

import sys
import time
from typing import TextIO

from ssilang.messages.message import Teller

PATIENCE = 2.0  # seconds before anything shows
REFRESH = 0.2
WIDTH = 30


class ProgressLine:
    """Shows steps done and the time left; silent when `stream` is not a terminal."""

    def __init__(self, title: str, told: Teller, stream: TextIO | None = None) -> None:
        self.title = title
        self._told = told
        self.stream = stream or sys.stderr
        self._started = self._shown = time.monotonic()
        self._visible = False
        # the first report: what came before it is start-up, or other steps
        self._first = (0.0, 0)
        self._last = sys.maxsize

    def __call__(self, done: int, total: int) -> None:
        """Show that `done` of `total` steps are done."""
        now = time.monotonic()
        if 2 * done < self._last:
            self._first = (now, done)
        (since, before), self._last = self._first, done
        if not self.stream.isatty() or now - self._started < PATIENCE:
            return
        if done < total and now - self._shown < REFRESH:
            return
        self._shown = now
        share = done / total if total else 1.0
        left = ""
        if done > before:
            seconds = (now - since) * (total - done) / (done - before)
            left = ", " + self._told("operators.session.time-left", seconds=seconds)
        bar = ("#" * round(share * WIDTH)).ljust(WIDTH, ".")
        self.stream.write(f"\r{self.title} [{bar}] {done}/{total}{left}".ljust(80))
        self._visible = True
        self.stream.flush()

    def note(self, code: str) -> None:
        """Say at once, on the line, what takes time before the first step."""
        if self.stream.isatty():
            self.stream.write(f"\r{self.title}: {self._told(code)} ")
            self._visible = True
            self.stream.flush()

    def close(self) -> None:
        """Wipe the line."""
        if self._visible:
            self.stream.write("\r" + " " * 80 + "\r")
            self.stream.flush()
