"""Where the files that come with the program are: in the wheel or in the source tree."""

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def resource(folder: str, name: str = "") -> Path:
    """Path of `folder/name` ('grammar', 'stdlib', 'cases', 'docs'), installed or in the tree."""
    for root in (_PACKAGE, _PACKAGE.parent):
        if (root / folder).is_dir():
            return root / folder / name if name else root / folder
    raise FileNotFoundError(folder)
