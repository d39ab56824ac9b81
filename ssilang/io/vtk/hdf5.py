"""The few HDF5 structures that a growing file needs, as bytes.

Source: "HDF5 File Format Specification Version 3.0" (The HDF Group): superblock version 0, object
headers version 1, links stored in their group's header, chunks indexed by a version 1 B-tree.
None of these carries a checksum, so that single numbers of them can be changed in place.
"""

import struct
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

UNDEFINED = (1 << 64) - 1
"""Address of what is not there."""
SUPERBLOCK = 96
"""Bytes of the superblock, which begins the file."""
BRANCHES = 64
"""Children of a node of a B-tree of chunks (twice the K of 32 that superblock 0 implies)."""

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_SPACE, _LINK_INFO, _TYPE, _FILL, _LINK, _LAYOUT = 0x1, 0x2, 0x3, 0x5, 0x6, 0x8
_GROUP_INFO, _FILTERS, _ATTRIBUTE, _CONTINUATION = 0xA, 0xB, 0xC, 0x10
_SHUFFLE, _DEFLATE = 2, 1
# class and version, bit fields, size, then bit offset and precision (and the parts of a real)
_TYPES = {
    "<f8": struct.pack("<4BI2H4BI", 0x11, 0x20, 63, 0, 8, 0, 64, 52, 11, 0, 52, 1023),
    "<f4": struct.pack("<4BI2H4BI", 0x11, 0x20, 31, 0, 4, 0, 32, 23, 8, 0, 23, 127),
    "<i8": struct.pack("<4BI2H", 0x10, 0x08, 0, 0, 8, 0, 64),
    "|u1": struct.pack("<4BI2H", 0x10, 0, 0, 0, 1, 0, 8),
}
LEVEL = 1
"""Of deflating: higher ones take several times as long for a few percent."""


def superblock(root: int, end: int) -> bytes:
    """The superblock: address of the root group's header, and of the end of all that counts."""
    versions = struct.pack("<8BHHI", 0, 0, 0, 0, 0, 8, 8, 0, 4, BRANCHES // 4, 0)
    addresses = struct.pack("<4Q", 0, UNDEFINED, end, UNDEFINED)
    return _SIGNATURE + versions + addresses + struct.pack("<QQ24x", 0, root)


def header(messages: Sequence[bytes], more: tuple[int, Sequence[bytes]] | None = None) -> bytes:
    """An object's header of these messages.

    Parameters
    ----------
    more : (int, messages), optional
        Further messages, which stand at that address: one behind the other.
    """
    count = len(messages)
    if more is not None:
        address, others = more
        length = sum(map(len, others))
        messages = [*messages, _message(_CONTINUATION, struct.pack("<QQ", address, length))]
        count += 1 + len(others)
    body = b"".join(messages)
    return struct.pack("<BxHII4x", 1, count, 1, len(body)) + body


def group(links: Sequence[bytes], count: int = 0) -> list[bytes]:
    """Messages of a group with these links (`count` with those that stand further on)."""
    most = count or len(links)
    info = struct.pack("<BBQQQQ", 0, 3, most, UNDEFINED, UNDEFINED, UNDEFINED)
    return [_message(_LINK_INFO, info), _message(_GROUP_INFO, b"\0\0"), *links]


def hard_link(name: str, order: int, address: int) -> bytes:
    """Link to the object at an address, the `order`-th of its group."""
    return _link(name, order, 0, struct.pack("<Q", address))


def soft_link(name: str, order: int, path: str) -> bytes:
    """Link to a path."""
    text = path.encode()
    return _link(name, order, 1, struct.pack("<H", len(text)) + text)


def _link(name: str, order: int, kind: int, value: bytes) -> bytes:
    text = name.encode()
    # type, creation order and character set (UTF-8) are given; two bytes of length
    head = struct.pack("<BBBQBH", 1, 0b11101, kind, order, 1, len(text))
    return _message(_LINK, head + text + value)


def attribute(name: str, value: str | int | Sequence[int]) -> bytes:
    """A text, an integer or a list of integers that belongs to an object."""
    if isinstance(value, str):
        data = value.encode("ascii")
        kind, space = struct.pack("<4BI", 0x13, 1, 0, 0, len(data)), _space(())
    else:
        array = np.atleast_1d(np.array(value, dtype="<i8"))
        kind, data = _TYPES["<i8"], array.tobytes()
        space = _space(() if isinstance(value, int) else array.shape)
    text = name.encode() + b"\0"
    head = struct.pack("<BxHHHB", 3, len(text), len(kind), len(space), 0)
    return _message(_ATTRIBUTE, head + text + kind + space + data)


def contiguous(
    shape: Sequence[int], dtype: np.dtype[np.generic], address: int, size: int
) -> list[bytes]:
    """Messages of a dataset whose values stand one behind the other, `size` bytes from there."""
    layout = struct.pack("<BBQQ", 3, 1, address, size)
    return _dataset(shape, dtype, layout)


def repeated(shape: Sequence[int], value: int) -> list[bytes]:
    """Messages of a dataset of integers that are all the same and stand nowhere."""
    layout = struct.pack("<BBQQ", 3, 1, UNDEFINED, 8 * int(np.prod(shape)))
    return _dataset(shape, np.dtype("<i8"), layout, np.int64(value).tobytes())


def compact(values: NDArray[np.generic]) -> list[bytes]:
    """Messages of a small dataset that has its values in its header."""
    data = values.tobytes()
    return _dataset(values.shape, values.dtype, struct.pack("<BBH", 3, 0, len(data)) + data)


def chunked(
    shape: Sequence[int], dtype: np.dtype[np.generic], chunk: Sequence[int], tree: int
) -> list[bytes]:
    """Messages of a dataset in shuffled and deflated chunks; `tree` is their index's address.

    Whole rows are shuffled, not single numbers: a vector's components stay apart from each other.
    """
    layout = struct.pack(
        f"<BBBQ{len(chunk) + 1}I", 3, 2, len(chunk) + 1, tree, *chunk, dtype.itemsize
    )
    filters = struct.pack("<BB", 2, 2)
    filters += struct.pack("<HHHI", _SHUFFLE, 1, 1, row_size(chunk, dtype))
    filters += struct.pack("<HHHI", _DEFLATE, 1, 1, LEVEL)
    return [*_dataset(shape, dtype, layout), _message(_FILTERS, filters)]


def row_size(shape: Sequence[int], dtype: np.dtype[np.generic]) -> int:
    """Bytes of a row."""
    return dtype.itemsize * int(np.prod(shape[1:], dtype=np.int64))


def _dataset(
    shape: Sequence[int],
    dtype: np.dtype[np.generic],
    layout: bytes,
    fill: bytes = b"",
) -> list[bytes]:
    # memory late, fill value written if it was set, defined (zero if nothing is said)
    filled = struct.pack("<4BI", 2, 2, 2, 1, len(fill)) + fill
    return [
        _message(_SPACE, _space(shape)),
        _message(_TYPE, _TYPES[dtype.newbyteorder("<").str], constant=True),
        _message(_FILL, filled),
        _message(_LAYOUT, layout),
    ]


def _space(shape: Sequence[int]) -> bytes:
    # without largest sizes: chunked arrays may grow all the same
    return struct.pack(f"<BBB5x{len(shape)}Q", 1, len(shape), 0, *shape)


def _message(kind: int, body: bytes, *, constant: bool = False) -> bytes:
    padded = body + bytes(-len(body) % 8)
    return struct.pack("<HHB3x", kind, len(padded), constant) + padded


# ---- nodes of the index of chunks ------------------------------------------------------------

NODE_HEAD = 24
"""Bytes before a node's first key."""
NODE_USED = 6
"""Where a node says how many children it has (two bytes)."""


def key_size(rank: int) -> int:
    """Bytes of a key of chunks of that rank."""
    return 8 + 8 * (rank + 1)


def node_size(rank: int) -> int:
    """Bytes of a node."""
    return NODE_HEAD + BRANCHES * 8 + (BRANCHES + 1) * key_size(rank)


def node_head(level: int, used: int) -> bytes:
    """A node's first bytes; its neighbours are only looked for by who changes the tree."""
    return b"TREE" + struct.pack("<BBHQQ", 1, level, used, UNDEFINED, UNDEFINED)


def node_entry(rank: int, first: int, last: int, size: int, address: int) -> bytes:
    """A child between its keys: from row `first`, to row `last` of the dataset, where it stands."""
    rest = bytes(8 * rank)
    left = struct.pack("<IIQ", size, 0, first) + rest
    right = struct.pack("<IIQ", 0, 0, last) + rest
    return left + struct.pack("<Q", address) + right
