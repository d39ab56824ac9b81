"""Files that truly stand below a folder: what somebody else has left there leads nowhere else."""

from __future__ import annotations

from pathlib import Path


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
