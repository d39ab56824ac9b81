"""Colours of messages on a terminal, and a pager for long texts; files and pipes get neither."""

import os
import pydoc
import re
import shutil
import sys
from typing import TextIO

_RED, _YELLOW, _BLUE, _CYAN, _END = "\x1b[1;31m", "\x1b[1;33m", "\x1b[1;34m", "\x1b[36m", "\x1b[0m"
_WARNING = ("warning", "avertissement")
_LABEL = re.compile(r"^([\wéè]+(?: \d+)?)(?= ?:)")


def coloured(message: str, stream: TextIO) -> str:
    """A rendered message with ANSI colours if `stream` is a terminal that wants them."""
    if not stream.isatty() or os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return message
    return "\n".join(_line(text, i) for i, text in enumerate(message.split("\n")))


def _line(text: str, number: int) -> str:
    if number == 0:
        strong = _YELLOW if text.startswith(_WARNING) else _RED
        return _LABEL.sub(lambda m: f"{strong}{m.group()}{_END}", text, count=1)
    if re.match(r"\s*(-->|\|\s*\^)", text):
        return f"{_BLUE}{text}{_END}"
    return f"{_CYAN}{text}{_END}" if text.startswith("  = ") else text


def show(text: str, out: TextIO) -> None:
    """Write a text with a pager if it is longer than the terminal that `out` is."""
    tall = text.count("\n") + 2 > shutil.get_terminal_size().lines
    if tall and out is sys.stdout and out.isatty() and sys.stdin.isatty():
        pydoc.pager(text)
    else:
        out.write(text + "\n")
