"""Histories of all runs of a sweep in one table: what each run wrote under the same name, joined.

A row of a run's CSV or Parquet table is a row of the joined one, behind the number of the run and
the values that it was given. Units stay where they are: in the titles, or in the metadata.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ssilang.cli.sweeping.worker import Row
from ssilang.io.atomic import inside, replacing
from ssilang.kernel.base.arrays import FloatArray
from ssilang.report.records import read_json
from ssilang.report.results import tables_of

FOLDER = "histories"
MOST_BYTES = 2_000_000_000
"""Of the runs' tables of one name; more of them are not joined."""


@dataclass
class Joined:
    """Joined tables, and what was left: runs with other columns, names with too much."""

    files: list[Path] = field(default_factory=list)
    others: int = 0
    large: list[str] = field(default_factory=list)


def join_histories(rows: Sequence[Row], swept: Sequence[str], folder: Path) -> Joined:
    """Join the tables that runs wrote under the same names, into `histories` of the sweep's folder.

    Parameters
    ----------
    rows : sequence of Row
        Runs that failed are left out.
    swept : sequence of str
        Names that were given values.
    """
    found: dict[str, list[tuple[Row, Path]]] = {}
    for row in rows:
        if row["exit_code"] == 0:
            for path in _tables_of_run(folder / "runs" / str(row["folder"])):
                found.setdefault(path.name, []).append((row, path))
    joined = Joined()
    for name, runs in sorted(found.items()):
        if sum(path.stat().st_size for _, path in runs) > MOST_BYTES:
            joined.large.append(name)
            continue
        target = folder / FOLDER / name
        write = _parquet if target.suffix == ".parquet" else _csv
        count = write(target, runs, swept)
        if count is not None:
            joined.files.append(target)
            joined.others += count
    return joined


def _tables_of_run(folder: Path) -> list[Path]:
    """Tables that a run itself wrote beside its summary."""
    try:
        path = inside(folder, "summary.json")
        names = [str(f["path"]) for f in read_json(path)["files"]] if path else []
    except (OSError, ValueError, KeyError, TypeError):
        return []
    names = [n for n in names if n.endswith((".csv", ".parquet")) and "/" not in n]
    return [path for n in names if (path := inside(folder, n))]


def _columns(path: Path) -> dict[str, FloatArray]:
    """Columns of numbers of a table; none of one that is no history."""
    return tables_of([path], []).get(path.name, {})


def _heads(columns: Sequence[str], swept: Sequence[str]) -> list[str]:
    """Titles of what stands before a run's own columns."""
    return [f"{n} (sweep)" if n in columns else n for n in ("run", *swept)]


def _csv(target: Path, runs: list[tuple[Row, Path]], swept: Sequence[str]) -> int | None:
    """Write a joined CSV file; how many runs have other columns, None if there is no history."""
    titles, others = [name for _, path in runs[:1] for name in _columns(path)], 0
    if not titles:
        return None
    target.parent.mkdir(parents=True, exist_ok=True)
    with replacing(target) as stream:
        stream.write((";".join([*_heads(titles, swept), *titles]) + "\n").encode())
        for row, path in runs:
            columns = _columns(path)
            others += bool(columns) and list(columns) != titles
            if list(columns) == titles:
                head = ";".join(_cell(row[n]) for n in ("run", *swept))
                for values in zip(*(c.tolist() for c in columns.values()), strict=True):
                    stream.write((head + ";" + ";".join(map(_number, values)) + "\n").encode())
    return others


def _cell(value: Any) -> str:
    text = ("VRAI" if value else "FAUX") if isinstance(value, bool) else str(value)
    return f'"{text}"' if ";" in text else text


def _number(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.9g}"


def _parquet(target: Path, runs: list[tuple[Row, Path]], swept: Sequence[str]) -> int | None:
    """The same as Parquet, a group of rows a run; units stay in the columns' metadata."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    schemas = [pq.read_schema(path) for _, path in runs]
    if not schemas[0].names:
        return None
    heads = _heads(schemas[0].names, swept)
    kinds = [_type(pa, [row[n] for row, _ in runs]) for n in ("run", *swept)]
    fields = [pa.field(n, k) for n, k in zip(heads, kinds, strict=True)]
    schema = pa.schema([*fields, *schemas[0]])
    target.parent.mkdir(parents=True, exist_ok=True)
    others = 0
    with replacing(target) as stream, pq.ParquetWriter(stream, schema, compression="zstd") as out:
        for (row, path), own in zip(runs, schemas, strict=True):
            if own.names != schemas[0].names:
                others += 1
                continue
            table = pq.read_table(path)
            first = [
                pa.array([str(row[n]) if kind == pa.string() else row[n]] * len(table), kind)
                for n, kind in zip(("run", *swept), kinds, strict=True)
            ]
            arrays = [*first, *(table[name].cast(own.field(name).type) for name in own.names)]
            out.write_table(pa.table(arrays, schema=schema))
    return others


def _type(pa: Any, values: list[Any]) -> Any:
    """Type of a column of swept values."""
    kinds = {type(v) for v in values}
    if kinds == {bool}:
        return pa.bool_()
    if kinds == {int}:
        return pa.int64()
    return pa.float64() if kinds <= {int, float} else pa.string()
