"""Names of files that every system takes, and files that truly stand below a folder."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ssilang.messages.message import Sentence
from ssilang.system import POSIX

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
