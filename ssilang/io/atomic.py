"""Files that appear whole or not at all: write aside, then rename."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path
from typing import IO

from ssilang.io.errors import OutputError
from ssilang.system import replace, usual_rights
from ssilang.system_reasons import system_reason


@contextmanager
def replacing(path: Path) -> Iterator[IO[bytes]]:
    """Open a temporary neighbour of `path`; it takes the place of `path` on a clean exit.

    Parent directories are made. After an exception inside the block nothing is left behind and
    an older file at `path` is untouched.

    Raises
    ------
    OutputError
        If the place cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    except OSError as error:
        raise cannot_write(path, error) from error
    aside = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
        os.chmod(aside, usual_rights())
        put(aside, path)
    except OSError as error:
        raise cannot_write(path, error) from error
    finally:
        with suppress(OSError):
            aside.unlink()


def put(aside: Path, path: Path, keep: bool = True) -> None:
    """Put a file that is whole in its place.

    Parameters
    ----------
    keep : bool
        Whether what cannot take the place of a file that another program holds stays beside it,
        under another name.

    Raises
    ------
    OSError
        If it cannot be put there.
    OutputError
        If another program holds the file that is there.
    """
    try:
        replace(aside, path)
    except PermissionError as error:
        if not path.is_file():
            raise
        other = path
        if keep:
            tried = (path.with_name(f"{path.stem}.new{n}{path.suffix}") for n in count(1))
            other = next(p for p in tried if not os.path.lexists(p))
            os.replace(aside, other)
        raise OutputError("io.file-held", path=path, other=other if keep else "") from error


def write_text(path: Path, text: str) -> None:
    """Write `text` (UTF-8) to `path`, whole or not at all."""
    with replacing(path) as stream:
        stream.write(text.encode("utf-8"))


def cannot_write(path: Path, error: OSError) -> OutputError:
    """The error of a place that cannot be written."""
    return OutputError("io.cannot-written", path=path, strerror=system_reason(error))
