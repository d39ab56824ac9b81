"""Source texts from files."""

from pathlib import Path

from ssilang.language.say.errors import SsiError
from ssilang.language.text.source import Source
from ssilang.system import system_reason


def read_source(path: Path) -> Source:
    """Read a file, UTF-8 or else Latin-1.

    Raises
    ------
    SsiError
        'missing-file' if it cannot be read, 'notebook' for one of Jupyter.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise SsiError("missing-file", None, path=str(path), reason=system_reason(error)) from None
    if path.suffix.lower() == ".ipynb":
        raise SsiError("notebook", None, path=str(path))
    return Source.decode(str(path), data, path)
