"""Long texts on a terminal go through a pager; elsewhere they are written as they are."""

from __future__ import annotations

import pydoc
import shutil
import sys
from typing import TextIO


def show(text: str, out: TextIO) -> None:
    """Write a text with a pager if it is longer than the terminal that `out` is."""
    tall = text.count("\n") + 2 > shutil.get_terminal_size().lines
    if tall and out is sys.stdout and out.isatty() and sys.stdin.isatty():
        pydoc.pager(text)
    else:
        out.write(text + "\n")
