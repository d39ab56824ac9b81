"""A progress line for long loops: on terminals only, after two seconds."""

from __future__ import annotations

import sys
import time
from typing import TextIO

PATIENCE = 2.0  # seconds before anything shows
REFRESH = 0.2
WIDTH = 30


class ProgressLine:
    """Shows steps done and the time left; silent when `stream` is not a terminal."""

    def __init__(self, title: str, stream: TextIO | None = None) -> None:
        self.title = title
        self.stream = stream or sys.stderr
        self._started = self._shown = time.monotonic()
        self._visible = False

    def __call__(self, done: int, total: int) -> None:
        """Show that `done` of `total` steps are done."""
        now = time.monotonic()
        if not self.stream.isatty() or now - self._started < PATIENCE:
            return
        if done < total and now - self._shown < REFRESH:
            return
        self._shown = now
        share = done / total if total else 1.0
        left = (now - self._started) * (1 - share) / max(share, 1e-9)
        bar = ("#" * round(share * WIDTH)).ljust(WIDTH, ".")
        self.stream.write(f"\r{self.title} [{bar}] {done}/{total}, {left:.0f} s left ")
        self._visible = True
        self.stream.flush()

    def close(self) -> None:
        """Wipe the line."""
        if self._visible:
            self.stream.write("\r" + " " * (len(self.title) + WIDTH + 40) + "\r")
            self.stream.flush()
