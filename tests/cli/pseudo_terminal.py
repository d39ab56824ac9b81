"""A program on a pseudo-terminal: what it writes, what is typed, keys included."""

import os
import pty
import re
import select
import signal
import sys
import time
from pathlib import Path

PATIENCE = 30.0  # seconds; a busy machine starts slowly
_ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b[=>]|\x07")


class Terminal:
    """`ssilang` with the arguments given, its three streams on a terminal of 24 lines."""

    def __init__(self, *arguments: str, folder: Path, plain: bool = True) -> None:
        environment = {
            **os.environ,
            "TERM": "xterm",
            "LINES": "24",
            "COLUMNS": "80",
            "XDG_STATE_HOME": str(folder / "state"),
            "PAGER": "cat" if plain else "more",
        }
        self.seen = ""  # without escapes
        self._raw = ""
        self._at = 0
        self.pid, self._end = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            command = [sys.executable, "-m", "ssilang.cli.main", *arguments]
            os.execvpe(sys.executable, command, environment)

    def __enter__(self) -> "Terminal":
        return self

    def __exit__(self, *_: object) -> None:
        try:
            os.kill(self.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        else:
            os.waitpid(self.pid, 0)
        os.close(self._end)

    def type(self, text: str) -> None:
        """Type characters; \\n is the return key, \\x03 is Ctrl-C."""
        os.write(self._end, text.replace("\n", "\r").encode())

    def wait_for(self, pattern: str, seconds: float = PATIENCE) -> str:
        """Read until a pattern shows behind what was waited for before; what came until then."""
        until = time.monotonic() + seconds
        while True:
            found = re.search(pattern, self.seen[self._at :])
            if found:
                text = self.seen[self._at : self._at + found.end()]
                self._at += found.end()
                return text
            if time.monotonic() > until or not self._read(until):
                raise AssertionError(f"no {pattern!r} in {self.seen[self._at :]!r}")

    def press_until(self, key: str, pattern: str) -> str:
        """Press a key, again each two seconds (the line editor may not listen yet)."""
        for _ in range(int(PATIENCE / 2)):
            self.type(key)
            try:
                return self.wait_for(pattern, 2.0)
            except AssertionError:
                continue
        return self.wait_for(pattern, 0.0)

    def _read(self, until: float) -> bool:
        ready, _, _ = select.select([self._end], [], [], max(0.0, until - time.monotonic()))
        if not ready:
            return False
        try:
            data = os.read(self._end, 65536)
        except OSError:  # the other end is closed
            return False
        if b"\x1b[6n" in data:  # asks where the cursor is
            os.write(self._end, b"\x1b[1;1R")
        text = data.decode("utf-8", "replace")
        self._raw += text
        self.seen += _ESCAPES.sub("", text)
        return bool(data)

    def raw_before(self, word: str) -> str:
        """What came before the first `word`, escapes included, colours left out."""
        return re.sub(r"\x1b\[[0-9;]*m", "", self._raw).partition(word)[0]

    def exit_code(self) -> int:
        """Wait for the end; a program that does not end in time is killed."""
        until = time.monotonic() + PATIENCE
        while self._read(until):
            pass
        if time.monotonic() > until:
            os.kill(self.pid, signal.SIGKILL)
        _, status = os.waitpid(self.pid, 0)
        return os.waitstatus_to_exitcode(status)
