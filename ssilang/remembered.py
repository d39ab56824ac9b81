"""What takes long to find out and is the same at each start, kept in the user's cache folder."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any
from zlib import crc32

from ssilang import __version__

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
    path = _folder() / f"{name}-{crc32(_PACKAGE.encode()):08x}.json"
    with suppress(OSError, ValueError):  # missing, damaged, or of another state
        total, _, text = path.read_text(encoding="utf-8").partition("\n")
        if int(total) == crc32(text.encode()):
            kept_state, data = json.loads(text)
            if kept_state == state:
                return data
    text = json.dumps([state, make()], separators=(",", ":"))
    _keep(path, f"{crc32(text.encode())}\n{text}")
    return json.loads(text)[1]  # as it will be read: tuples are lists


def _folder() -> Path:
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    return Path(home) / "ssilang"


def _keep(path: Path, text: str) -> None:
    """Write the file whole or not at all; without a writable folder it is made each time."""
    part = path.with_suffix(f".{os.getpid()}")
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        part.write_text(text, encoding="utf-8")
        part.replace(path)
