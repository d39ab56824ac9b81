"""What takes long to find out and is the same at each start, kept in a private folder."""

import json
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any
from zlib import crc32

from ssilang import __version__
from ssilang.private import first_private, places

_PACKAGE = str(Path(__file__).parent)


def remembered(name: str, state: str, make: Callable[[], Any]) -> Any:
    """What `make` finds, or found at an earlier start in the same state.

    Parameters
    ----------
    name : str
        Of the file; each place where the program is installed has its own.
    state : str
        What it depends on besides the versions of the program and of Python.
    make : function
        Gives what JSON can hold: lists, strings and numbers.
    """
    state = f"{__version__} {sys.version} {state}"
    folder = first_private(*places("started"))
    path = folder and folder / f"{name}-{crc32(_PACKAGE.encode()):08x}.json"
    with suppress(OSError, ValueError):  # missing, damaged, or of another state
        kept_state, data = json.loads(path.read_text(encoding="utf-8") if path else "")
        if kept_state == state:
            return data
    text = json.dumps([state, make()], separators=(",", ":"))
    if path:
        _keep(path, text)
    return json.loads(text)[1]  # as it will be read: tuples are lists


@cache
def tables_of(path: Path) -> Any:
    """What a file of TOML holds; only the first start after a change of it takes the text apart."""

    def read() -> Any:
        import tomllib

        return tomllib.loads(path.read_text(encoding="utf-8"))

    found = path.stat()
    return remembered(path.name, f"{found.st_mtime_ns} {found.st_size}", read)


def _keep(path: Path, text: str) -> None:
    """Write the file whole or not at all; where that fails it is made each time."""
    part = path.with_suffix(f".{os.getpid()}")
    with suppress(OSError):
        with open(part, "x", encoding="utf-8") as stream:
            stream.write(text)
        part.replace(path)
