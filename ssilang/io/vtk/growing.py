"""An HDF5 file that only grows, and that is whole at every moment.

What has been said once stays where it is: values, chunks and the nodes of their index go to the
file's end; a commit puts a few headers there too and then makes the superblock point at them, in
one write within a page. A process that is killed leaves the file as of its last commit, and who
reads the file meanwhile goes on seeing what was there when it opened it. What is written in place
is only ever more of the same: a dataset's length, a further child of a node. It waits for the
commit too, which first says that the file is longer, then changes these, then the root.

HDF5's own library promises neither: it writes several structures anew at each flush, so that most
of its writes leave a file that cannot be read, and it locks the file for readers.
"""

import os
import zlib
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ssilang.io.atomic import cannot_write, neighbour, put
from ssilang.io.errors import OutputError
from ssilang.io.vtk import hdf5
from ssilang.system import GUARDED, usual_rights, write_at

_PAGE = 4096
_COMPRESSED_FROM = 8192  # bytes; an index and filters cost some 3 kB


class GrowingFile:
    """The bytes of the file: places at its end, commits.

    It is made beside `path` and takes its place at the first commit.

    Raises
    ------
    OutputError
        If the place cannot be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.end = self._known = hdf5.SUPERBLOCK
        self._root = hdf5.UNDEFINED
        self._changes: list[tuple[int, bytes]] = []
        self._aside: Path | None
        self._handle, self._aside = neighbour(path)
        self._closed = False

    def place(self, size: int, *, in_page: bool = False) -> int:
        """Address of new room; `in_page`: that no boundary of a page cuts."""
        self.end += -self.end % 8
        if in_page and self.end % _PAGE + size > _PAGE:
            self.end += -self.end % _PAGE
        address = self.end
        self.end += size
        return address

    def add(self, data: bytes, *, in_page: bool = False) -> int:
        """Put bytes at the end; returns their address."""
        address = self.place(len(data), in_page=in_page)
        self.put(address, data)
        return address

    def change(self, address: int, data: bytes) -> None:
        """Write bytes where there is room for them, at the next commit if that is in use."""
        if address < self._known:
            self._changes.append((address, data))
        else:
            self.put(address, data)

    def put(self, address: int, data: bytes) -> None:
        """Write bytes now."""
        try:
            left = memoryview(data)
            while left:
                written = write_at(self._handle, left, address)
                left, address = left[written:], address + written
        except OSError as error:
            raise cannot_write(self.path, error) from error

    def commit(self, root: int) -> None:
        """Let the file be what the root group's header at that address says."""
        try:
            if self._changes:
                self.put(0, hdf5.superblock(self._root, self.end))
                for address, data in self._changes:
                    self.put(address, data)
            self.put(0, hdf5.superblock(root, self.end))
            self._root, self._known, self._changes = root, self.end, []
            if self._aside is not None:
                os.chmod(self._aside, usual_rights())
                os.close(self._handle)  # Windows moves no file that is open
                try:
                    put(self._aside, self.path, keep=False)
                except (OSError, OutputError):
                    self._handle = os.open(self._aside, os.O_RDWR | GUARDED)
                    raise
                self._aside = None
                self._handle = os.open(self.path, os.O_RDWR | GUARDED)
        except OSError as error:
            raise cannot_write(self.path, error) from error

    @property
    def is_there(self) -> bool:
        """Whether the file still stands at its place, if it has been put there."""
        if self._aside is not None:
            return True
        try:
            return os.path.samestat(os.stat(self.path), os.fstat(self._handle))
        except OSError:
            return False

    def close(self) -> None:
        """Let the file go; one that was never committed disappears."""
        if self._closed:
            return
        self._closed = True
        os.close(self._handle)
        if self._aside is not None:
            with suppress(OSError):
                self._aside.unlink()


class Column:
    """A dataset of one dimension that gets a value at a time.

    Parameters
    ----------
    kept : bool
        Its header stays at one place, where its length grows; else `header` is made anew.
    """

    def __init__(self, file: GrowingFile, dtype: str, *, kept: bool = True) -> None:
        self.values: NDArray[np.generic] = np.zeros(0, dtype=dtype)
        self._file, self._length, self._room = file, 0, 0
        self.address = file.place(len(self.header()), in_page=True) if kept else 0
        self._kept = kept

    def __len__(self) -> int:
        return self._length

    @property
    def last(self) -> float:
        """The value added last."""
        return float(self.values[self._length - 1])

    def append(self, value: float) -> None:
        """Add a value."""
        if self._length == len(self.values):
            grown = np.zeros(max(64, 2 * self._length), dtype=self.values.dtype)
            grown[: self._length] = self.values
            self.values = grown
            self._room = self._file.add(grown.tobytes())
        self.values[self._length] = value
        where = self._room + self._length * self.values.itemsize
        self._file.change(where, self.values[self._length : self._length + 1].tobytes())
        self._length += 1
        if self._kept:
            self._file.change(self.address, self.header())

    def header(self) -> bytes:
        """The dataset's header of now."""
        size = self.values.nbytes
        return hdf5.header(
            hdf5.contiguous((self._length,), self.values.dtype, self._room or hdf5.UNDEFINED, size)
        )


class Repeated:
    """A dataset of one integer, as often as asked for."""

    def __init__(self, file: GrowingFile, value: int, width: int = 0) -> None:
        self._file, self._value, self._width = file, value, width
        self.address = file.place(len(self._header(0)), in_page=True)

    def lengthen(self, length: int) -> None:
        """Let it have that many rows."""
        self._file.change(self.address, self._header(length))

    def _header(self, length: int) -> bytes:
        shape = (length, self._width) if self._width else (length,)
        return hdf5.header(hdf5.repeated(shape, self._value))


class Stack:
    """A dataset of rows that grows by a block of the same shape at a time, each deflated.

    Parameters
    ----------
    shape : tuple of int
        Of a block: (n,) or (n, k).
    """

    def __init__(
        self, file: GrowingFile, shape: tuple[int, ...], dtype: np.dtype[np.generic]
    ) -> None:
        self.shape, self.dtype = shape, dtype
        self.count = 0
        self._file, self._index = file, _Index(file, len(shape), shape[0])
        self.address = file.place(len(self._header()), in_page=True)

    def append(self, block: NDArray[np.generic]) -> int:
        """Add a block; returns the row with which it begins."""
        rows = np.ascontiguousarray(block)  # deflated: first bytes of all rows, then second ones
        width = hdf5.row_size(rows.shape, rows.dtype)
        if width > 1:
            rows = np.ascontiguousarray(rows.view(np.uint8).reshape(-1, width).T)
        packed = zlib.compress(rows.data, hdf5.LEVEL)
        self._index.append(self._file.add(packed), len(packed))
        self.count += 1
        self._file.change(self.address, self._header())
        return (self.count - 1) * self.shape[0]

    def _header(self) -> bytes:
        shape = (self.count * self.shape[0], *self.shape[1:])
        return hdf5.header(hdf5.chunked(shape, self.dtype, self.shape, self._index.root))


def write_once(file: GrowingFile, values: NDArray[np.generic]) -> int:
    """Write a dataset that will not change; returns its header's address."""
    values = np.ascontiguousarray(values)
    if values.nbytes >= _COMPRESSED_FROM:
        stack = Stack(file, values.shape, values.dtype)
        stack.append(values)
        return stack.address
    where = file.add(values.tobytes()) if values.size else hdf5.UNDEFINED
    messages = hdf5.contiguous(values.shape, values.dtype, where, values.nbytes)
    return file.add(hdf5.header(messages))


class _Node:
    """A node that is not full yet: its place, its children, the first chunk below it."""

    def __init__(self, address: int, first: int) -> None:
        self.address, self.first, self.used = address, first, 0


class _Index:
    """Where the chunks of a dataset stand: a B-tree to which children are added at its right edge.

    A node is whole before its parent knows it, and what an older root leads to stays right.
    """

    def __init__(self, file: GrowingFile, rank: int, rows: int) -> None:
        self._file, self._rank, self._rows = file, rank, rows
        self._edge: list[_Node] = []
        self.root = hdf5.UNDEFINED

    def append(self, child: int, size: int, level: int = 0) -> None:
        """Add the next chunk; on higher levels, the next node."""
        if level == len(self._edge):
            self._edge.append(self._node(level, 0))
            if level:  # what was the root is its first child
                self._enter(self._edge[level], level, self.root, 0)
            self._enter(self._edge[level], level, child, size)
            self.root = self._edge[level].address
        elif self._edge[level].used < hdf5.BRANCHES:
            self._enter(self._edge[level], level, child, size)
        else:
            full = self._edge[level]
            self._edge[level] = self._node(level, full.first + hdf5.BRANCHES ** (level + 1))
            self._enter(self._edge[level], level, child, size)
            self.append(self._edge[level].address, 0, level + 1)

    def _node(self, level: int, first: int) -> _Node:
        blank = hdf5.node_head(level, 0).ljust(hdf5.node_size(self._rank), b"\0")
        return _Node(self._file.add(blank, in_page=True), first)

    def _enter(self, node: _Node, level: int, child: int, size: int) -> None:
        """Write a child behind the others, then that there is one more."""
        span = hdf5.BRANCHES**level
        first = node.first + node.used * span
        entry = hdf5.node_entry(
            self._rank, first * self._rows, (first + span) * self._rows, size, child
        )
        width = hdf5.key_size(self._rank) + 8
        self._file.change(node.address + hdf5.NODE_HEAD + node.used * width, entry)
        node.used += 1
        self._file.change(node.address + hdf5.NODE_USED, node.used.to_bytes(2, "little"))


def group_header(file: GrowingFile, links: dict[str, int], extra: Sequence[bytes] = ()) -> int:
    """Write a group with links to the objects at these addresses; returns its header's address."""
    made = [hdf5.hard_link(name, i, address) for i, (name, address) in enumerate(links.items())]
    return file.add(hdf5.header([*extra, *hdf5.group(made)]))
