"""Columns written as CSV, and CSV files read into columns.

Columns of numbers as a Parquet file (extra `sweep`: pyarrow).
"""

import importlib.util
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.io.atomic import replacing
from ssilang.io.errors import InputError, text_of
from ssilang.kernel.base.arrays import FloatArray

_TITLE_WIDTH = 12
_GAP = 3  # blank lines between two groups of columns
MOST_COLUMNS = 1_000_000


@dataclass(frozen=True)
class Column:
    """A column: title ('' for none), values, numbers or words, and unit ('' for none)."""

    title: str
    values: Sequence[Any]
    unit: str = ""

    @property
    def head(self) -> str:
        """Its title, cut to its width, with its unit."""
        title = self.title.strip()[:_TITLE_WIDTH]
        return f"{title} ({self.unit})".lstrip() if self.unit else title


def csv_lines(
    columns: Sequence[Column],
    separator: str = ";",
    width: int | None = None,
    digits: int | None = None,
) -> list[str]:
    """The lines of a table: titles if there are any, then rows up to the longest column.

    Parameters
    ----------
    width : int, optional
        Columns side by side; further ones follow below, three blank lines apart.
    digits : int, optional
        Decimals of real numbers; without it all digits that matter are written.
    """
    width = width or len(columns)
    lines: list[str] = []
    for start in range(0, len(columns), width):
        group = columns[start : start + width]
        if start:
            lines += [""] * _GAP
        if any(c.head for c in group):
            lines.append(separator.join(c.head for c in group))
        for row in range(max((len(c.values) for c in group), default=0)):
            lines.append(separator.join(_cell(c.values, row, digits) for c in group))
    return lines


def _cell(values: Sequence[Any], row: int, digits: int | None) -> str:
    if row >= len(values):
        return ""
    value = values[row]
    if isinstance(value, str):
        return value
    if isinstance(value, int | np.integer):
        return str(int(value))
    return repr(float(value)) if digits is None else f"{float(value):.{digits}E}"


Rows = list[list[float]] | FloatArray
"""Rows of numbers: an array if all have as many."""


def read_csv(path: Path, separator: str = ";", first_line: int = 1) -> Rows:
    """Numbers of a CSV file, row by row, from line `first_line` (1 is the first).

    Empty cells at the end of a row are left out; an empty line ends nothing.

    Raises
    ------
    InputError
        If the file cannot be read, a line is too wide, or a cell is no number.
    """
    text = text_of(path)
    for number, line in enumerate(text.splitlines(), start=1):
        if line.count(separator) >= MOST_COLUMNS and number >= first_line:
            raise InputError("io.line-too-wide", name=path.name, line=number, most=MOST_COLUMNS)
    regular = _regular(text, separator, first_line)
    if regular is not None:
        return regular
    rows = []
    for number, line in enumerate(text.splitlines(), start=1):
        if number < first_line or not line.strip():
            continue
        cells = line.split() if separator == " " else line.split(separator)
        while cells and not cells[-1].strip():
            cells.pop()
        rows.append([_number(c, path, number) for c in cells])
    return rows


def _regular(text: str, separator: str, first_line: int) -> FloatArray | None:
    """The rows of a text that has plain numbers alone, as many in each; None of any other."""
    lines = text.splitlines()[first_line - 1 :]
    if not any(line.strip() for line in lines):
        return None
    delimiter = None if separator == " " else separator
    try:
        found = np.loadtxt(lines, delimiter=delimiter, comments=None, ndmin=2)
    except ValueError:
        return None
    return found if np.isfinite(found).all() else None


def _number(cell: str, path: Path, line: int) -> float:
    text = cell.strip().strip('"')
    try:
        value = float(text.replace("D", "E").replace("d", "e").replace("_", "?"))
    except ValueError:
        raise InputError("io.line-no-number", name=path.name, line=line, text=text) from None
    if not math.isfinite(value):
        raise InputError("io.line-no-finite-number", name=path.name, line=line, text=text)
    return value


def as_columns(rows: Rows) -> list[FloatArray]:
    """Columns of rows; a short row ends the columns that it does not reach."""
    if isinstance(rows, np.ndarray):
        return list(np.ascontiguousarray(rows.T))
    columns: list[list[float]] = [[] for _ in range(max(map(len, rows), default=0))]
    for row in rows:
        for column, value in zip(columns, row, strict=False):
            column.append(value)
    return list(map(np.array, columns))


def is_there() -> bool:
    """Whether pyarrow is installed."""
    return importlib.util.find_spec("pyarrow") is not None


def write_parquet(path: Path, columns: Mapping[str, FloatArray], units: Mapping[str, str]) -> None:
    """Write columns of one length, whole or not at all.

    Parameters
    ----------
    units : mapping
        Unit of a column by its name, into the column's metadata under `unit`; those without stay
        without.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    fields = [
        pa.field(name, pa.float64(), metadata={"unit": units[name]} if units.get(name) else None)
        for name in columns
    ]
    table = pa.table(list(columns.values()), schema=pa.schema(fields))
    with replacing(path) as stream:
        pq.write_table(table, stream, compression="zstd")
