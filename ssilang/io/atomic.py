"""Files that appear whole or not at all, under names that every system takes, below one folder."""

import os
import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path
from typing import IO

from ssilang.io.errors import OutputError
from ssilang.messages.message import Sentence
from ssilang.system import POSIX, replace, system_reason, usual_rights


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
    handle, aside = neighbour(path)
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


def neighbour(path: Path) -> tuple[int, Path]:
    """A new file beside `path`, open, and where it is.

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
    return handle, Path(name)


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
        stream.write(text.encode("utf-8", "replace"))


def cannot_write(path: Path, error: OSError) -> OutputError:
    """The error of a place that cannot be written."""
    return OutputError("io.cannot-written", path=path, strerror=system_reason(error))


_DRIVE = re.compile(r"[A-Za-z]:[/\\]")
_DEVICE = re.compile(
    r"(?i:con|prn|aux|nul|conin\$|conout\$|(?:com|lpt)[0-9\u00b9\u00b2\u00b3]) *(\.|\Z)"
)
_SIGN = re.compile(r'[<>:"|?*\x00-\x1f]')


def portable(name: str) -> str:
    """The name as all systems read it: folders are parted by /."""
    return name.strip().replace("\\", "/")


def names_foreign_drive(name: str) -> bool:
    """Whether a name begins with a drive of Windows (`C:`) on a system that has none."""
    return POSIX and _DRIVE.match(name.strip()) is not None


def fault_on_windows(name: str) -> Sentence | None:
    """Why Windows refuses a name or writes elsewhere: to a device, or beside the file."""
    for part in os.path.splitdrive(portable(name))[1].split("/"):
        if part in ("", ".", ".."):
            continue
        if _DEVICE.match(part):
            return Sentence("io.reason-named-device", part=part)
        if found := _SIGN.findall(part):
            return Sentence("io.reason-sign", signs=sorted(set(found)))
        if part[-1] in ". ":
            return Sentence("io.reason-end", part=part)
    return None


def resolved(path: Path) -> Path:
    """The place that a path leads to, through links; `Path.resolve` raises where they go round."""
    return Path(os.path.realpath(path))


def inside(folder: Path, name: str) -> Path | None:
    """The file of this name below a folder; None for one elsewhere, a link that leads out, no file.

    Pipes and devices, which would never end, are no files. A name with a root or a drive is refused
    before the system is asked: that alone would tell another machine who asks.
    """
    if Path(name).anchor or "\\" in name or name.startswith("//"):
        return None
    path = folder / name
    try:
        true = path.resolve(strict=True)
        sound = true.is_file() and true.is_relative_to(folder.resolve())
    except (OSError, ValueError, RuntimeError):  # gone, a name with a zero, a circle of links
        return None
    return path if sound else None
