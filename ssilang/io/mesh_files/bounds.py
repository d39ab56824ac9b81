"""What meshio's readers may take of a file: no lines behind its end, no more than it may hold.

A few bytes may say that thousands of millions of lines follow, or unpack to all memory.
"""

import io
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.archive.container import most_unpacked
from ssilang.io.errors import InputError

_ENDS = 9  # times that a reader may ask for a line behind the last one


class _Ending:
    """Of a stream: lines behind its end are refused; meshio would count them as empty ones."""

    _ends = 0

    def readline(self, *size: Any) -> Any:
        """The next line."""
        line = super().readline(*size)  # type: ignore[misc]
        if not line:
            self._ends += 1
            if self._ends > _ENDS:
                raise EOFError("end of the file")
        return line


class Text(_Ending, io.StringIO):
    """A text with an end."""


class _Bytes(_Ending, io.BufferedReader):
    """A file of bytes with an end."""


class _Lines(_Ending, io.TextIOWrapper):
    """A file of text with an end."""


def opened(path: Path, binary: bool) -> Any:
    """A file that refuses to be read on behind its end."""
    stream = _Bytes(io.FileIO(path))
    return stream if binary else _Lines(stream)


class _Unpacking:
    """What unpacks the blocks of a file, up to its bound; stands for `zlib` and `lzma`."""

    def __init__(self, path: Path) -> None:
        self.path, self.left = path, most_unpacked(path)

    def taken(self, size: int) -> None:
        """Count bytes that were unpacked.

        Raises
        ------
        InputError
            If they are more than the file may hold.
        """
        self.left -= size
        if self.left < 0:
            most = most_unpacked(self.path) / 1e6
            raise InputError("io.mesh-file-too-large", name=self.path.name, most=most)

    def decompress(self, block: bytes) -> bytes:
        """The bytes of a block."""
        import lzma

        packed = zlib.decompressobj() if block[:1] == b"\x78" else lzma.LZMADecompressor()
        found: bytes = packed.decompress(block, self.left + 1)
        self.taken(len(found))
        return found


@contextmanager
def unpacked(path: Path) -> Iterator[None]:
    """A .vtu is read meanwhile: its blocks unpack up to its bound."""
    from meshio.vtu import _vtu

    before = _vtu.zlib, _vtu.lzma
    _vtu.zlib = _vtu.lzma = _Unpacking(path)
    try:
        yield
    finally:
        _vtu.zlib, _vtu.lzma = before


class _Rows(np.ndarray[Any, Any]):
    """Rows of nodes by their numbers: Python would count those below 0 from the last."""

    def __getitem__(self, numbers: Any) -> Any:
        counts = isinstance(numbers, np.ndarray) and numbers.dtype.kind in "iu" and numbers.size
        if counts and not (numbers.min() >= 0 and numbers.max() < len(self)):
            raise _NoNode
        return super().__getitem__(numbers)


class _NoNode(Exception):
    """A file's cell names a node that the file does not hold."""


class _Numpy:
    """numpy for meshio's readers of Gmsh, whose tables of nodes come from `ones` and `full`."""

    def __getattr__(self, name: str) -> Any:
        made = getattr(np, name)
        return (lambda *a, **k: made(*a, **k).view(_Rows)) if name in ("ones", "full") else made


@contextmanager
def nodes_held(path: Path) -> Iterator[None]:
    """A .msh is read meanwhile: its cells name nodes that it holds.

    Raises
    ------
    InputError
        If they do not.
    """
    from meshio.gmsh import _gmsh22, _gmsh40, _gmsh41

    readers = (_gmsh22, _gmsh40, _gmsh41)
    for reader in readers:
        reader.np = _Numpy()
    try:
        yield
    except _NoNode:
        raise InputError("io.mesh-file-names-no-node", name=path.name, kind="GMSH") from None
    finally:
        for reader in readers:
            reader.np = np


def check_hdf5(path: Path) -> None:
    """Check what the arrays of an HDF5 file would take.

    Raises
    ------
    InputError
        If that is more than the file may hold.
    """
    import h5py

    bound = _Unpacking(path)

    def counted(_: str, part: Any) -> None:
        if isinstance(part, h5py.Dataset):
            bound.taken(part.size * part.dtype.itemsize)

    with h5py.File(path) as file:
        file.visititems(counted)
