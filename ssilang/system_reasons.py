"""Why the system refused a file, in the reader's language: the system itself speaks its own."""

from __future__ import annotations

import errno

from ssilang.messages.message import Sentence

_REASONS = {
    errno.ENOENT: "io.reason-missing",
    errno.EACCES: "io.reason-forbidden",
    errno.EPERM: "io.reason-forbidden",
    errno.EISDIR: "io.reason-folder",
    errno.ENOTDIR: "io.reason-no-folder",
    errno.EEXIST: "io.reason-there-already",
    errno.ENAMETOOLONG: "io.reason-name-too-long",
    errno.ELOOP: "io.reason-links-in-a-ring",
    errno.ENOSPC: "io.reason-disk-full",
    errno.EDQUOT: "io.reason-disk-full",
    errno.EROFS: "io.reason-read-only",
    errno.EFBIG: "io.reason-file-too-large",
    errno.EMFILE: "io.reason-many-files-open",
    errno.ENFILE: "io.reason-many-files-open",
    errno.EIO: "io.reason-device",
    errno.EBADF: "io.reason-stream-closed",
}


def system_reason(error: Exception) -> Sentence | str:
    """The reason of an OSError, or of a ValueError for a name; the system's words if rare."""
    number = getattr(error, "errno", None)
    if number in _REASONS:
        return Sentence(_REASONS[number])
    if isinstance(error, ValueError) and "null" in str(error):
        return Sentence("io.reason-nought-in-a-name")
    return str(getattr(error, "strerror", None) or error)
