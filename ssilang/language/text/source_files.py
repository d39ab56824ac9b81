"""Source texts from files."""

import stat
from pathlib import Path

from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source
from ssilang.messages.message import Sentence
from ssilang.system import system_reason

_LARGEST = 2**26  # bytes: no script has as many


def read_source(path: Path) -> Source:
    """Read a file, UTF-8 or else Latin-1.

    Raises
    ------
    SsiError
        'missing-file' if it cannot be read or is no text that ends, 'notebook' for one of Jupyter.
    """
    try:
        found, fault = path.stat(), ""
        if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):
            fault = "io.reason-no-text"
        elif found.st_size > _LARGEST:
            fault = "io.reason-file-too-large"
        if fault:
            raise SsiError("missing-file", None, path=str(path), reason=Sentence(fault))
        data = path.read_bytes()
    except OSError as error:
        raise SsiError("missing-file", None, path=str(path), reason=system_reason(error)) from None
    if path.suffix.lower() == ".ipynb":
        raise SsiError("notebook", None, path=str(path))
    return Source.decode(str(path), data, path)
