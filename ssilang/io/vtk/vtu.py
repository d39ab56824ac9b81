"""The XML file of one unstructured grid (.vtu).

Source: "VTK XML file formats", docs.vtk.org. A compressed array is one header (number of blocks,
block size, size of the last block, compressed sizes) and the deflated blocks, each in base64.
"""

import base64
import zlib
from collections.abc import Iterator, Mapping
from enum import Enum
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ssilang.io.atomic import replacing
from ssilang.io.vtk.grid import DataArray, Grid

_BLOCK = 1 << 16
_TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


class Encoding(Enum):
    """How numbers are written: text, binary, or binary and deflated."""

    TEXT = "FORM"
    BINARY = "BINA"
    ZIP = "ZIP"


def write_vtu(
    path: Path,
    grid: Grid,
    encoding: Encoding = Encoding.ZIP,
    time: float | None = None,
    constants: Mapping[str, float] | None = None,
) -> None:
    """Write `grid` to `path`, whole or not at all.

    Parameters
    ----------
    time : float, optional
        Stored as the field datum 'TimeValue', which ParaView shows.
    constants : mapping of str to float, optional
        Further field data, numbers by name (readers other than VTK's know no texts there).

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    with replacing(path) as stream:
        stamp = {} if time is None else {"TimeValue": time}
        for line in _lines(grid, encoding, {**stamp, **(constants or {})}):
            stream.write(line.encode("utf-8"))
            stream.write(b"\n")


def _lines(grid: Grid, encoding: Encoding, constants: Mapping[str, float]) -> Iterator[str]:
    compressor = ' compressor="vtkZLibDataCompressor"' if encoding is Encoding.ZIP else ""
    yield '<?xml version="1.0"?>'
    yield (
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"'
        f' header_type="UInt64"{compressor}>'
    )
    yield "<UnstructuredGrid>"
    if constants:
        one = ' NumberOfTuples="1"'
        told = (_element(n, DataArray(np.array([v])), encoding, one) for n, v in constants.items())
        yield f"<FieldData>{''.join(told)}</FieldData>"
    yield f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(grid.types)}">'
    yield from _section("PointData", grid.point_data, encoding)
    yield from _section("CellData", grid.cell_data, encoding)
    yield from _geometry(grid, encoding)
    yield "</Piece></UnstructuredGrid></VTKFile>"


def _section(tag: str, arrays: dict[str, DataArray], encoding: Encoding) -> Iterator[str]:
    yield f"<{tag}>"
    for name, array in arrays.items():
        yield _element(name, array, encoding)
    yield f"</{tag}>"


def _geometry(grid: Grid, encoding: Encoding) -> Iterator[str]:
    yield "<Points>"
    yield _element("Points", DataArray(grid.points), encoding, kept=True)
    yield "</Points><Cells>"
    for name in ("connectivity", "offsets", "types"):
        yield _element(name, DataArray(getattr(grid, name)), encoding, kept=True)
    yield "</Cells>"


def _element(
    name: str, array: DataArray, encoding: Encoding, extra: str = "", *, kept: bool = False
) -> str:
    values = _native(array.values)
    width = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    columns = "".join(
        f" ComponentName{i}={quoteattr(column)}" for i, column in enumerate(array.columns)
    )
    form = "ascii" if encoding is Encoding.TEXT else "binary"
    return (
        f'<DataArray type="{_TYPES[values.dtype.str[1:]]}" Name={quoteattr(name)}'
        f'{width}{columns}{extra} format="{form}">'
        f"{_encoded(values, encoding, kept)}</DataArray>"
    )


def _native(values: NDArray[Any]) -> NDArray[Any]:
    if values.dtype.kind == "f":
        return np.ascontiguousarray(values, dtype="<f8" if values.dtype.itemsize == 8 else "<f4")
    if values.dtype == np.uint8:
        return np.ascontiguousarray(values)
    return np.ascontiguousarray(values, dtype="<i8")


def _encoded(values: NDArray[Any], encoding: Encoding, kept: bool) -> str:
    if encoding is Encoding.TEXT:
        return "\n" + "\n".join(" ".join(map(repr, np.atleast_1d(row).tolist())) for row in values)
    pack = _packed_once if kept else _packed
    return pack(values.tobytes(), encoding is Encoding.ZIP)


def _packed(raw: bytes, deflate: bool) -> str:
    if not deflate:
        return base64.b64encode(_header(len(raw)) + raw).decode("ascii")
    blocks = [raw[i : i + _BLOCK] for i in range(0, len(raw), _BLOCK)]
    packed = [zlib.compress(block, 1) for block in blocks]
    last = len(raw) % _BLOCK
    head = _header(len(blocks), _BLOCK, last, *map(len, packed))
    return (base64.b64encode(head) + base64.b64encode(b"".join(packed))).decode("ascii")


# connectivity and reference points are the same at each step of a series
_packed_once = lru_cache(maxsize=16)(_packed)


def _header(*numbers: int) -> bytes:
    return np.array(numbers, dtype="<u8").tobytes()


# XML attributes, without the imports that the standard library's quoting brings along.

_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


def quoteattr(text: str) -> str:
    """The text as an XML attribute's value, quotes around it."""
    return f'"{text.translate(_ENTITIES)}"'
