"""Folders that nobody but the user can have written to.

What is kept from run to run is taken as it is found: code is run, and the words of the language
are what a file says. Who can write to its folder, put a folder of his own in its
place, or rename one on the way to it, runs what he likes as the user. A folder is therefore trusted
if it is no link, belongs to the user, is closed to all others (mode 700), and if nobody else can
change an entry on the way to it: each parent belongs to the user or to the system, and is written
to by others only under a sticky bit, as /tmp is.
"""

import os
import stat
from contextlib import suppress
from pathlib import Path

from ssilang.system import POSIX, user_number

_OTHERS = stat.S_IWGRP | stat.S_IWOTH
_PASSING = stat.S_IXGRP | stat.S_IXOTH
_SYSTEM = 0  # the user number of root

REFUSED: list[tuple[Path, Path]] = []
"""Folders that others could have written to, with what opens each: nothing was read from them."""


def places(name: str) -> list[Path]:
    """Where what is kept may stand: below the user's caches, and below a temporary folder.

    A user without a home, or with a relative one, has the second alone.
    """
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    above = [Path(home) / "ssilang"] if os.path.isabs(home) else []
    return [p / name for p in (*above, Path(temporary()) / f"ssilang-{user_number()}")]


def temporary() -> str:
    """The system's folder for what does not last; `tempfile` takes time to load."""
    given = os.environ.get("TMPDIR")
    if POSIX:
        return given if given and os.path.isabs(given) else "/tmp"
    import tempfile

    return tempfile.gettempdir()


def first_private(*folders: Path, closed: int = 0o077) -> Path | None:
    """The first folder that nobody else can have written to, made if it is missing; else None."""
    for folder in folders:
        fault = private_folder(folder, closed)
        if fault is None:
            return folder.resolve()
        if os.path.lexists(folder) and (folder, fault) not in REFUSED:
            REFUSED.append((folder, fault))  # not only a place where nothing can be made
    return None


def opened_to_others(folder: Path, closed: int = 0o077) -> Path | None:
    """What lets others write to a folder: itself or one above it; None if it is private.

    Parameters
    ----------
    closed : int
        Bits of the mode that the folder must not have: all that others could do, or their writing
        alone (0o022) where the user has named it.

    Notes
    -----
    Elsewhere than on POSIX systems folders of a user are closed to others by the system.
    """
    if not POSIX:
        return None if folder.is_dir() else folder
    try:
        found = folder.lstat()
        if not _is_own(found) or found.st_mode & closed:
            return folder
        # from here on the way without links: these may be the user's own, in front of the folder
        nearest = folder.parent.resolve(strict=True)
        for parent in reversed((nearest, *nearest.parents)):
            found = parent.lstat()
            if not _is_safe(found):
                return parent
            if not found.st_mode & _PASSING:  # others do not get here, whatever stands below
                break
    except (OSError, RuntimeError):  # not there, closed, or a loop of links
        return folder
    return None


def _is_own(folder: os.stat_result) -> bool:
    return stat.S_ISDIR(folder.st_mode) and folder.st_uid == user_number()


def _is_safe(parent: os.stat_result) -> bool:
    """Whether others cannot exchange what the user owns in a folder."""
    if parent.st_uid not in (user_number(), _SYSTEM):
        return False
    return not parent.st_mode & _OTHERS or bool(parent.st_mode & stat.S_ISVTX)


def private_folder(folder: Path, closed: int = 0o077) -> Path | None:
    """Make a folder for the user alone if there is none; what keeps it from being used, or None."""
    missing = [p for p in (folder, *folder.parents) if not os.path.lexists(p)]
    try:
        for part in reversed(missing):
            part.mkdir(mode=0o700, exist_ok=True)
    except OSError:
        return folder
    return opened_to_others(folder, closed) or (None if os.access(folder, os.W_OK) else folder)


def fresh_folder() -> Path | None:
    """A new folder for this process alone, which ends with it; None if no place is safe."""
    import atexit
    import tempfile

    for place in (None, "/tmp", "/var/tmp"):
        try:
            made = Path(tempfile.mkdtemp(prefix="ssilang-", dir=place)).resolve()
        except OSError:
            continue
        atexit.register(_remove, made, os.getpid())
        if opened_to_others(made) is None:
            return made
    return None


def _remove(folder: Path, owner: int) -> None:
    if os.getpid() == owner:  # a process forked from it ends earlier
        import shutil

        with suppress(OSError):
            shutil.rmtree(folder)
