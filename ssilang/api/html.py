"""Objects of scripts as HTML, for notebooks: tables, lists, curves, fields; long ones in short."""

import base64
from collections.abc import Callable, Sequence, Sized
from html import escape
from typing import Any

import numpy as np

from ssilang.kernel.base.arrays import IntArray
from ssilang.kernel.curves.curve import Curve
from ssilang.kernel.fields.node_field import NodeField
from ssilang.kernel.matrices.assembly import MULTIPLIER
from ssilang.language import values

AXES = ("x", "y", "z")
ENDS = 8
"""Rows that are shown at the beginning and at the end of what has many."""


def html_of(value: Any) -> str:
    """A value as an HTML table, '' for what has none."""
    make = _MADE.get(type(value))
    if make is None and isinstance(value, values.Table):
        make = _table
    return "" if make is None else make(value)


def rows_html(heads: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """A table with a row of heads; of many rows the first and the last."""
    cells = ["".join(f"<td>{escape(_cell(c))}</td>" for c in row) for row in rows]
    shown = [f"<tr>{row}</tr>" for row in cells]
    if len(rows) > 2 * ENDS:
        left = f'<tr><td colspan="{len(heads)}">... {len(rows) - 2 * ENDS} ...</td></tr>'
        shown = [*shown[:ENDS], left, *shown[-ENDS:]]
    head = "".join(f"<th>{escape(h)}</th>" for h in heads)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(shown)}</tbody></table>"


def _cell(value: object) -> str:
    if isinstance(value, bool | np.bool_):
        return "VRAI" if value else "FAUX"
    if isinstance(value, float | np.floating):
        return "" if np.isnan(value) else f"{value:.6g}"
    return str(value).rstrip()


def _table(table: values.Table) -> str:
    """Indices with what stands there; what is not made yet stays so."""
    rows = []
    indices = table.indices()
    ends = indices if len(indices) <= 2 * ENDS else [*indices[:ENDS], *indices[-ENDS:]]
    for index in indices:
        inside = len(indices) == len(ends) or any(index is e for e in ends)
        rows.append((_index(index), _brief(table, index) if inside else ""))
    return rows_html((table.subtype or "TABLE", ""), rows)


def _index(index: object) -> str:
    if isinstance(index, str):
        return f"'{index.rstrip()}'"
    return str(index) if isinstance(index, bool | int | float) else values.type_of(index)


def _brief(table: values.Table, index: object) -> str:
    """What a value of a table is, in a few words."""
    value = table.waiting(index)
    if value is values.PENDING:
        return "..."
    kind = values.type_of(value)
    if isinstance(value, bool | int | float | str):
        return f"{_cell(value)}"
    size = f" ({len(value)})" if isinstance(value, Sized) else ""
    return f"{kind}{size}"


def _list(value: values.ListReel | values.ListEnti | values.ListMots) -> str:
    return rows_html(("", values.type_of(value)), list(enumerate(value.values, 1)))


def _curve(value: Curve) -> str:
    """Its picture, and its points."""
    if not value.parts:
        return ""
    picture = base64.b64encode(picture_of(value)).decode("ascii")
    tables = []
    for part in value.parts:
        heads = (part.abscissa_name or "x", part.legend or part.ordinate_name or "y")
        tables.append(rows_html(heads, list(zip(part.abscissas, part.ordinates, strict=True))))
    beside = "".join(f'<td style="vertical-align: top">{table}</td>' for table in tables)
    image = f'<img alt="EVOLUTION" style="max-width: 100%" src="data:image/png;base64,{picture}">'
    points = f"<table><tr>{beside}</tr></table>"
    return f"{image}<details><summary>x, y</summary>{points}</details>"


def picture_of(curve: Curve) -> bytes:
    """The picture that DESS draws of a curve, a PNG."""
    from ssilang.io.plots.figure import figure_bytes
    from ssilang.io.plots.graphs.curves import CurveOptions, draw_curves

    return figure_bytes(draw_curves(curve, CurveOptions()), "png")


def components_shown(field: NodeField) -> tuple[str, ...]:
    """Components of a field; multipliers, on nodes of their own, are left out beside others."""
    names = tuple(field.components)
    return tuple(n for n in names if n != MULTIPLIER) or names


def nodes_shown(field: NodeField) -> IntArray:
    """Nodes (n,), from 0, where one of these is."""
    parts = [field.components[name].nodes for name in components_shown(field)]
    return np.unique(np.concatenate([np.zeros(0, np.int64), *parts]))


def _field(value: NodeField) -> str:
    nodes, names = nodes_shown(value), components_shown(value)
    columns = [value.values_at(name, nodes, np.nan) for name in names]
    rows = list(zip(nodes + 1, *value.table.coordinates[nodes].T, *columns, strict=True))
    return rows_html(("", *AXES, *names), rows)


_MADE: dict[type, Callable[[Any], str]] = {
    values.ListReel: _list,
    values.ListEnti: _list,
    values.ListMots: _list,
    Curve: _curve,
    NodeField: _field,
}
