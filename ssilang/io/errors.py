"""Errors of reading and writing files."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ssilang.kernel.base.errors import KernelError
from ssilang.system import system_reason


class OutputError(KernelError):
    """A file or picture cannot be written: wrong objects, forbidden or full place."""


class NoGraphicsError(OutputError):
    """This system has no library that draws in space."""


class InputError(KernelError):
    """A file cannot be read: absent, of another format, or damaged."""


@contextmanager
def readable(path: Path) -> Iterator[None]:
    """What the system refuses meanwhile is an `InputError`: the file cannot be read."""
    try:
        yield
    except OSError as error:
        raise InputError("io.cannot-read", path=path, strerror=system_reason(error)) from error


def text_of(path: Path, encoding: str = "utf-8") -> str:
    """A file's text, whatever bytes are in it.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    with readable(path):
        return path.read_text(encoding=encoding, errors="replace")
