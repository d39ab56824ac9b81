"""The table of a sweep, CSV and Parquet, and a picture of each figure against what was swept."""

from __future__ import annotations

import importlib.util
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ssilang.cli.sweeping.given import MOTION

Row = dict[str, Any]
RESERVED = ("run", "exit_code", "seconds", "error", "warnings", "folder")


def can_write() -> bool:
    """Whether the library that writes Parquet is installed."""
    return importlib.util.find_spec("pyarrow") is not None


def columns_of(rows: Sequence[Row]) -> list[str]:
    """All names, those of the first rows first."""
    return list(dict.fromkeys(name for row in rows for name in row))


def write_table(rows: Sequence[Row], path: Path) -> None:
    """Write rows as Parquet; a column whose values have different types becomes text."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    from ssilang.io.atomic import replacing

    columns = {}
    for name in columns_of(rows):
        values = [row.get(name) for row in rows]
        kinds = {type(v) for v in values if v is not None}
        if kinds == {int, float}:
            values = [None if v is None else float(v) for v in values]
        elif len(kinds) > 1:
            values = [None if v is None else str(v) for v in values]
        columns[name] = pa.array(values)
    with replacing(path) as stream:
        pq.write_table(pa.table(columns), stream)


def write_plain_table(rows: Sequence[Row], path: Path) -> None:
    """Write rows as CSV between semicolons, titles first; what a run does not have is empty."""
    import csv
    import io

    from ssilang.io.atomic import write_text

    text = io.StringIO()
    writer = csv.DictWriter(text, columns_of(rows), delimiter=";", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())


def idle_names(rows: Sequence[Row], swept: Sequence[str]) -> list[str]:
    """Names of several numbers or motions of which no figure depends, to the last digit."""
    figures = [n for n in columns_of(rows) if n not in (*RESERVED, *swept)]
    found = []
    for name in swept:
        if name == MOTION or _numbers(rows, name):
            others, known = [n for n in swept if n != name], dict[str, dict[str, str]]()
            for row in rows:
                same = known.setdefault(repr([row[n] for n in others]), {})
                same[repr(row[name])] = repr([row.get(n) for n in figures])
            alike = [len({*same.values()}) == 1 < len(same) for same in known.values()]
            found += [name] if alike and all(alike) and figures else []
    return found


def draw_figures(rows: Sequence[Row], swept: Sequence[str], folder: Path) -> list[Path]:
    """One picture a figure, over the first parameter that is a number; a curve a combination."""
    axis = next((n for n in swept if n != MOTION and _numbers(rows, n)), None)
    if axis is None:
        return []
    figures = [n for n in columns_of(rows) if n not in (*RESERVED, *swept) and _numbers(rows, n)]
    return [_draw(rows, axis, swept, figure, folder) for figure in figures]


def _numbers(rows: Sequence[Row], name: str) -> bool:
    values = [row[name] for row in rows if row.get(name) is not None]
    return bool(values) and all(type(v) in (int, float) for v in values)


def _draw(rows: Sequence[Row], axis: str, swept: Sequence[str], figure: str, folder: Path) -> Path:
    import numpy as np

    from ssilang.io.plots.figure import save_figure, slug
    from ssilang.io.plots.graphs.curves import CurveOptions, draw_curves
    from ssilang.kernel.curves.curve import Curve, CurvePart

    groups: dict[str, list[tuple[float, float]]] = {}
    others = [n for n in swept if n != axis]
    for row in rows:
        value = row.get(figure)
        if value is not None and math.isfinite(value):
            groups.setdefault(_label(row, others), []).append((row[axis], value))
    parts = []
    for label, points in groups.items():
        x, y = np.array(sorted(points), dtype=float).T
        parts.append(CurvePart(x, y, axis, figure, label))
    drawn = draw_curves(Curve(tuple(parts), figure), CurveOptions(x_title=axis, y_title=figure))
    return save_figure(drawn, folder / f"{slug(figure)}.png")


def _label(row: Row, names: Sequence[str]) -> str:
    parts = [Path(row[n]).stem if n == MOTION else f"{n} = {row[n]}" for n in names]
    return ", ".join(parts)
