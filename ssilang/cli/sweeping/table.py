"""The table of a sweep, CSV and Parquet, and a picture of each figure against what was swept."""

import csv
from collections.abc import Sequence
from pathlib import Path

from ssilang.cli.sweeping.worker import Row
from ssilang.io.atomic import replacing, write_text
from ssilang.report.sweep_table import MOTION, RESERVED, grouped, is_still


def columns_of(rows: Sequence[Row]) -> list[str]:
    """All names, those of the first rows first."""
    return list(dict.fromkeys(name for row in rows for name in row))


def figures_in(rows: Sequence[Row], swept: Sequence[str]) -> list[str]:
    """Names of what runs report."""
    return [n for n in columns_of(rows) if n not in (*RESERVED, *swept)]


def write_table(rows: Sequence[Row], path: Path) -> None:
    """Write rows as Parquet; a column whose values have different types becomes text."""
    import pyarrow as pa
    import pyarrow.parquet as pq

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
    import io

    text = io.StringIO()
    writer = csv.DictWriter(text, columns_of(rows), delimiter=";", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())


def idle_names(rows: Sequence[Row], swept: Sequence[str]) -> list[str]:
    """Names of several numbers or motions of which no figure depends, to nine digits."""
    figures = figures_in(rows, swept)
    return [
        name
        for name in swept
        if figures
        and is_still(rows, swept, name, figures)
        and (name == MOTION or _numbers(rows, name))
    ]


def draw_figures(rows: Sequence[Row], swept: Sequence[str], folder: Path) -> list[Path]:
    """One picture a figure, over the first parameter that is a number; a curve a combination."""
    axis = next((n for n in swept if n != MOTION and _numbers(rows, n)), None)
    if axis is None:
        return []
    figures = [n for n in figures_in(rows, swept) if _numbers(rows, n)]
    return [_draw(rows, axis, swept, figure, folder) for figure in figures]


def _numbers(rows: Sequence[Row], name: str) -> bool:
    values = [row[name] for row in rows if row.get(name) is not None]
    return bool(values) and all(type(v) in (int, float) for v in values)


def _draw(rows: Sequence[Row], axis: str, swept: Sequence[str], figure: str, folder: Path) -> Path:
    from ssilang.io.plots.figure import save_figure, slug
    from ssilang.io.plots.graphs.curves import CurveOptions, draw_curves
    from ssilang.kernel.curves.curve import Curve, CurvePart

    others = [n for n in swept if n != axis]
    groups = grouped(rows, axis, figure, others).items()
    parts = [CurvePart(x, y, axis, figure, label) for label, (x, y) in groups]
    drawn = draw_curves(Curve(tuple(parts), figure), CurveOptions(x_title=axis, y_title=figure))
    return save_figure(drawn, folder / f"{slug(figure)}.png")
