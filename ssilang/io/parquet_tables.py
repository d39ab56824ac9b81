"""Columns of numbers as a Parquet file (extra `sweep`: pyarrow)."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from pathlib import Path

from ssilang.io.atomic import replacing
from ssilang.kernel.base.arrays import FloatArray


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
